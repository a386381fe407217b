"""Names that do not exist, and the nearest that do."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from gudgeon.errors import Location, UnknownNameError
from gudgeon.language.names import odd_characters


def near(name: str, known: Iterable[str], most: int = 3, cutoff: float = 0.6) -> list[str]:
    """The known names that `name` may stand for, the likeliest first; an address may lack its first parts."""
    ends: dict[str, list[str]] = {}
    for candidate in sorted(known, key=lambda name: (name.count("."), name)):
        parts = candidate.lower().split(".")
        for k in range(max(1, len(parts) - name.count("."))):
            ends.setdefault(".".join(parts[k:]), []).append(candidate)
    found = difflib.get_close_matches(name.lower(), ends, n=2 * most, cutoff=cutoff)
    return list(dict.fromkeys(candidate for end in found for candidate in ends[end]))[:most]


def nearest(name: str, known: Iterable[str], cutoff: float = 0.5) -> str | None:
    """The known name that `name` most likely stands for."""
    return next(iter(near(name, known, 1, cutoff)), None)


def known_hint(name: str, known: Iterable[str], most: int = 12) -> str:
    """ "did you mean 'mass'? expected one of: …" for an error about `name`."""
    candidates = list(known)
    guess = nearest(name, candidates)
    listed = ", ".join(candidates[:most]) + (", …" if len(candidates) > most else "")
    expected = f"expected one of: {listed}" if candidates else "none is defined"
    odd = odd_characters(name)
    if candidates == [guess]:
        return f"{odd}did you mean {guess!r}?"
    return f"{odd}did you mean {guess!r}? {expected}" if guess else odd + expected


def unknown_name(what: str, name: str, known: Iterable[str], where: Location | None) -> UnknownNameError:
    """The error for a name that nothing defines."""
    return UnknownNameError(f"unknown {what} {str(name)[:200]!r}", where, known_hint(name, known))


def unknown(message: str, name: str, known: tuple[str, ...]) -> UnknownNameError:
    """An error for a name that does not exist; it tells the nearest ones, or all if they are few.

    Of many names those without a dot: the parameters, not every number of every body.
    """
    if found := near(name, known):
        return UnknownNameError(message, hint=f"nearest: {', '.join(found)}")
    if len(known) <= 12:
        return UnknownNameError(message, hint=f"there are: {', '.join(known)}")
    short, addresses = [n for n in known if "." not in n], [n for n in known if "." in n]
    there = [*short[:20], "and addresses such as " * bool(short) + ", ".join(addresses[: 1 if short else 6])]
    return UnknownNameError(message, hint=f"there are: {', '.join(there)}{'' if short else ' and more'}")

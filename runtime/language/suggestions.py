"""Names that do not exist, and the nearest that do."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from gudgeon.errors import Location, UnknownNameError


def nearest(name: str, known: Iterable[str], cutoff: float = 0.5) -> str | None:
    """The known name that `name` most likely stands for."""
    candidates = sorted(known)
    by_lower = {candidate.lower(): candidate for candidate in reversed(candidates)}
    found = difflib.get_close_matches(name.lower(), by_lower, n=1, cutoff=cutoff)
    return by_lower[found[0]] if found else None


def known_hint(name: str, known: Iterable[str], most: int = 12) -> str:
    """ "did you mean 'mass'? expected one of: …" for an error about `name`."""
    candidates = list(known)
    guess = nearest(name, candidates)
    listed = ", ".join(candidates[:most]) + (", …" if len(candidates) > most else "")
    expected = f"expected one of: {listed}" if candidates else "none is defined"
    if candidates == [guess]:
        return f"did you mean {guess!r}?"
    return f"did you mean {guess!r}? {expected}" if guess else expected


def unknown_name(what: str, name: str, known: Iterable[str], where: Location | None) -> UnknownNameError:
    """The error for a name that nothing defines."""
    return UnknownNameError(f"unknown {what} {str(name)[:200]!r}", where, known_hint(name, known))


def unknown(message: str, name: str, known: tuple[str, ...]) -> UnknownNameError:
    """An error for a name that does not exist; it tells the nearest ones, or all if they are few.

    Of many names those without a dot: the parameters, not every number of every body.
    """
    import difflib

    near = difflib.get_close_matches(name, known, n=3, cutoff=0.5)
    if near:
        return UnknownNameError(message, hint=f"nearest: {', '.join(near)}")
    if len(known) <= 12:
        return UnknownNameError(message, hint=f"there are: {', '.join(known)}")
    short, address = [n for n in known if "." not in n], next((n for n in known if "." in n), "")
    return UnknownNameError(message, hint=f"there are: {', '.join(short[:20])}, and addresses such as {address}")

"""Check names of a file's items, and find existing names nearest to a mistyped one."""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Iterable

from gudgeon.errors import BadNameError, Location, UnknownNameError
from gudgeon.language.functions import FUNCTIONS

MAX_LENGTH = 64
LABEL = "[A-Za-z_][A-Za-z0-9_]{0,63}"  # pattern of names in studies: windows, measures, parts, claims
IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*", re.ASCII)
YAML_NULL = ("", "~", "null", "Null", "NULL")  # plain texts that YAML reads as no value

# Names that are ambiguous in expressions, with the reason.
RESERVED: dict[str, str] = {
    "t": "it is time in expressions",
    "pi": "it is a number in expressions",
    "ground": "it is the frame",
    "energy": "it heads names of results",
    "work": "it heads names of results",
}
# Words of YAML and Python that look like values or operators: not names in expressions.
WORDS = frozenset(
    ("true", "false", "null", "yes", "no", "on", "off", "inf", "nan", "True", "False", "None")
    + ("and", "or", "not", "in", "is", "if", "else", "lambda", "for", "await", "yield")
)


def check_name(name: str, what: str, where: Location | None) -> None:
    """Raise BadNameError unless `name` can name a thing: a free identifier of at most 64 characters."""
    check_label(name, what, where)
    reason = RESERVED.get(name) if what not in ("point", "mechanism") else None  # no expression has these alone
    if what in ("parameter", "output", "curve", "expression"):  # the others stand in expressions with a dot only
        reason = "it is a function of expressions" if name in FUNCTIONS else reason
        reason = "an expression takes it for no name" if name in WORDS else reason
    if what == "output" and name == "time":
        reason = "it is the axis of results"
    other = ""
    if "__" in name:
        reason, other = "names that hold '__' are kept for emitted code", re.sub("__+", "_", name)
    if reason:
        raise BadNameError(f"{name!r} cannot name this {what}: {reason}", where, another_name(name, other))


def another_name(name: str, other: str = "") -> str:
    """Return the hint that proposes `other`, or `name` followed by a digit."""
    return f"expected another name, such as {other or f'{name}1'}"


def check_not_null(name: str, what: str, where: Location | None) -> None:
    """Raise BadNameError if YAML reads `name` as no value; what: "this body"."""
    if name in YAML_NULL:
        reason = "YAML reads it as no value where the name is used"
        raise BadNameError(f"{str(name)!r} cannot name {what}: {reason}", where, another_name(name))


def check_label(name: str, what: str, where: Location | None) -> None:
    """Raise BadNameError unless `name` is an identifier of at most 64 characters.

    It is enough for what no expression and no C identifier is called by alone: scenes, materials, bearings, contacts.
    """
    if not IDENTIFIER.fullmatch(name):
        hint = "expected a letter, then letters, digits or '_', in ASCII"
        plain = re.sub(r"[-_ ]+", "_", name).strip("_")
        if IDENTIFIER.fullmatch(plain) and len(plain) <= MAX_LENGTH:
            hint += f", such as {plain}"
        if "=" in name and IDENTIFIER.fullmatch(plain := name.partition("=")[0].strip()):
            hint = f"a value stands behind a colon: {plain}:{name.partition('=')[2].partition('=')[0].rstrip()}"
        hint = odd_characters(name) + hint
        raise BadNameError(f"{name[:MAX_LENGTH]!r} cannot name this {what}: it is no identifier", where, hint)
    check_not_null(name, f"this {what}", where)
    if len(name) > MAX_LENGTH:
        raise BadNameError(
            f"the name of this {what} has {len(name)} characters", where, f"expected at most {MAX_LENGTH}"
        )


def character_text(character: str) -> str:
    """Return a character as a message shows it: "'$'", "U+00A0 (no-break space)"."""
    if character.isascii() and character.isprintable():
        return repr(character)
    name = unicodedata.name(character, "").lower()
    shown = f", {character!r}" if character.isprintable() else ""
    return f"U+{ord(character):04X}" + (f" ({name}{shown})" if name else "")


def advice_on(character: str) -> str:
    """Return what to write in place of a character that looks like another one; "" where that is not known."""
    kind = unicodedata.category(character)
    if character.isascii():
        return ""
    if kind in ("Zs", "Zl", "Zp"):
        return "write an ordinary space"
    if kind in ("Cf", "Cc"):
        return "remove it: it is not visible"
    plain = unicodedata.normalize("NFKC", character)
    if kind == "Pd" or character in "\u2212\ufe63\uff0d":
        return "write '-'"
    return f"write {plain!r}" if plain.isascii() and plain.isprintable() and len(plain) == 1 else ""


def odd_characters(name: str) -> str:
    """Return "it contains U+00A0 (no-break space): …; " for a name with characters that look like others, or ""."""
    odd = next((one for one in name if not one.isascii() and advice_on(one)), "")
    return f"it contains {character_text(odd)}: {advice_on(odd)}; " if odd else ""


def near(name: str, known: Iterable[str], most: int = 3, cutoff: float = 0.6) -> list[str]:
    """Return the known names that `name` may stand for, the most similar first; addresses may lack their first
    parts.
    """
    ends: dict[str, list[str]] = {}
    for candidate in sorted(known, key=lambda name: (name.count("."), name)):
        parts = candidate.lower().split(".")
        for k in range(max(1, len(parts) - name.count("."))):
            ends.setdefault(".".join(parts[k:]), []).append(candidate)
    found = difflib.get_close_matches(name.lower(), ends, n=2 * most, cutoff=cutoff)
    return list(dict.fromkeys(candidate for end in found for candidate in ends[end]))[:most]


def nearest(name: str, known: Iterable[str], cutoff: float = 0.5) -> str | None:
    """Return the known name that `name` most likely stands for, or None."""
    return next(iter(near(name, known, 1, cutoff)), None)


def known_hint(name: str, known: Iterable[str], most: int = 12) -> str:
    """Return a hint on an unknown `name`: "did you mean 'mass'? expected one of: …"."""
    candidates = list(known)
    guess = nearest(name, candidates)
    listed = ", ".join(candidates[:most]) + (", …" if len(candidates) > most else "")
    expected = f"expected one of: {listed}" if candidates else "none is defined"
    odd = odd_characters(name)
    if candidates == [guess]:
        return f"{odd}did you mean {guess!r}?"
    return f"{odd}did you mean {guess!r}? {expected}" if guess else odd + expected


def unknown_name(what: str, name: str, known: Iterable[str], where: Location | None) -> UnknownNameError:
    """Return the error for a name that nothing defines, with the nearest known names."""
    return UnknownNameError(f"unknown {what} {str(name)[:200]!r}", where, known_hint(name, known))


def unknown(message: str, name: str, known: tuple[str, ...]) -> UnknownNameError:
    """Return the error for a name that does not exist, with the nearest names, or all if they are few.

    If there are many names, only those without a dot are listed: parameters, not addresses.
    """
    if found := near(name, known):
        return UnknownNameError(message, hint=f"nearest: {', '.join(found)}")
    if len(known) <= 12:
        return UnknownNameError(message, hint=f"there are: {', '.join(known)}")
    short, addresses = [n for n in known if "." not in n], [n for n in known if "." in n]
    there = [*short[:20], "and addresses such as " * bool(short) + ", ".join(addresses[: 1 if short else 6])]
    return UnknownNameError(message, hint=f"there are: {', '.join(there)}{'' if short else ' and more'}")

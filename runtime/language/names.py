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
    "energy": "names of results begin with it",
    "work": "names of results begin with it",
}
# Words of YAML and Python that look like values or operators: not names in expressions.
WORDS = frozenset(
    ("true", "false", "null", "yes", "no", "on", "off", "inf", "nan", "True", "False", "None")
    + ("and", "or", "not", "in", "is", "if", "else", "lambda", "for", "await", "yield")
)


def check_name(name: str, item_kind: str, location: Location | None) -> None:
    """Raise BadNameError unless `name` can name an item of a file: a free identifier of at most 64 characters.

    item_kind: of the item, such as "parameter"; names that stand alone in expressions must not be functions or reserved
    words. location: for the error; None if there is no file.
    """
    check_label(name, item_kind, location)
    reason = RESERVED.get(name) if item_kind not in ("point", "mechanism") else None  # no expression has these alone
    if item_kind in ("parameter", "output", "curve", "expression"):  # the others stand in expressions with a dot only
        reason = "it is a function of expressions" if name in FUNCTIONS else reason
        reason = "it is not a name in expressions" if name in WORDS else reason
    if item_kind == "output" and name == "time":
        reason = "it is the axis of results"
    alternative = ""
    if "__" in name:
        reason, alternative = "names that contain '__' are reserved for emitted code", re.sub("__+", "_", name)
    if reason:
        raise BadNameError(
            f"{name!r} cannot name this {item_kind}: {reason}", location, suggest_another_name(name, alternative)
        )


def suggest_another_name(name: str, alternative: str = "") -> str:
    """Return a hint that proposes `alternative`, or `name` followed by the digit 1 if that is empty."""
    return f"expected another name, such as {alternative or f'{name}1'}"


def check_not_null(name: str, item: str, location: Location | None) -> None:
    """Raise BadNameError if YAML would read `name` as no value; `item` names it in the message, such as "this body".

    `location`: for the error, None if there is no file.
    """
    if name in YAML_NULL:
        reason = "YAML reads it as no value where the name is used"
        raise BadNameError(f"{str(name)!r} cannot name {item}: {reason}", location, suggest_another_name(name))


def check_label(name: str, item_kind: str, location: Location | None) -> None:
    """Raise BadNameError with a hint unless `name` is an ASCII identifier of at most 64 characters that YAML reads as
    text.

    This is enough for items that no expression and no C identifier names alone: scenes, materials, bearings, contacts.
    item_kind: noun for the message, such as "scene". location: for the error; None if there is no file.
    """
    if not IDENTIFIER.fullmatch(name):
        hint = "expected a letter, then letters, digits or '_', in ASCII"
        plain = re.sub(r"[-_ ]+", "_", name).strip("_")
        if IDENTIFIER.fullmatch(plain) and len(plain) <= MAX_LENGTH:
            hint += f", such as {plain}"
        if "=" in name and IDENTIFIER.fullmatch(plain := name.partition("=")[0].strip()):
            hint = f"a value follows a colon: {plain}:{name.partition('=')[2].partition('=')[0].rstrip()}"
        hint = describe_lookalike(name) + hint
        message = f"{name[:MAX_LENGTH]!r} cannot name this {item_kind}: it is not an identifier"
        raise BadNameError(message, location, hint)
    check_not_null(name, f"this {item_kind}", location)
    if len(name) > MAX_LENGTH:
        raise BadNameError(
            f"the name of this {item_kind} has {len(name)} characters", location, f"expected at most {MAX_LENGTH}"
        )


def format_character(character: str) -> str:
    """Return a character as a message shows it: "'$'" or "U+00A0 (no-break space)"."""
    if character.isascii() and character.isprintable():
        return repr(character)
    name = unicodedata.name(character, "").lower()
    shown = f", {character!r}" if character.isprintable() else ""
    return f"U+{ord(character):04X}" + (f" ({name}{shown})" if name else "")


def suggest_replacement(character: str) -> str:
    """Return advice on a character that looks like another one, such as "write '-'"; "" for ASCII and unknown ones.

    Spaces, invisible characters, dashes, and characters with an ASCII equivalent (NFKC) are known.
    """
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


def describe_lookalike(name: str) -> str:
    """Return "it contains U+00A0 (no-break space): …; " for the first character of a name that looks like another;
    else "".
    """
    lookalike = next(
        (character for character in name if not character.isascii() and suggest_replacement(character)), ""
    )
    return f"it contains {format_character(lookalike)}: {suggest_replacement(lookalike)}; " if lookalike else ""


def find_near_names(name: str, known_names: Iterable[str], max_names: int = 3, cutoff: float = 0.6) -> list[str]:
    """Return at most `max_names` known names that a mistyped `name` may stand for, the most similar first.

    The beginning of a dotted address may be missing. cutoff: smallest similarity, 0 to 1.
    """
    names_by_ending: dict[str, list[str]] = {}
    for candidate in sorted(known_names, key=lambda name: (name.count("."), name)):
        parts = candidate.lower().split(".")
        for k in range(max(1, len(parts) - name.count("."))):
            names_by_ending.setdefault(".".join(parts[k:]), []).append(candidate)
    matches = difflib.get_close_matches(name.lower(), names_by_ending, n=2 * max_names, cutoff=cutoff)
    return list(dict.fromkeys(candidate for end in matches for candidate in names_by_ending[end]))[:max_names]


def find_nearest_name(name: str, known_names: Iterable[str], cutoff: float = 0.5) -> str | None:
    """Return the known name that a mistyped `name` most likely stands for; None below the similarity `cutoff` (0 to
    1).
    """
    return next(iter(find_near_names(name, known_names, 1, cutoff)), None)


def format_name_hint(name: str, known_names: Iterable[str], max_names: int = 12) -> str:
    """Return a hint on an unknown `name`: "did you mean 'mass'? expected one of: …", with at most `max_names` names."""
    candidates = list(known_names)
    guess = find_nearest_name(name, candidates)
    name_list = ", ".join(candidates[:max_names]) + (", …" if len(candidates) > max_names else "")
    expected = f"expected one of: {name_list}" if candidates else "none is defined"
    lookalike_text = describe_lookalike(name)
    if candidates == [guess]:
        return f"{lookalike_text}did you mean {guess!r}?"
    return f"{lookalike_text}did you mean {guess!r}? {expected}" if guess else lookalike_text + expected


def make_unknown_name_error(
    kind: str, name: str, known_names: Iterable[str], location: Location | None
) -> UnknownNameError:
    """Return the UnknownNameError for a `name` that nothing defines, with the nearest known names as hint.

    kind: of the name, such as "body". location: for the error; None if there is no file.
    """
    return UnknownNameError(f"unknown {kind} {str(name)[:200]!r}", location, format_name_hint(name, known_names))


def make_missing_name_error(message: str, name: str, known_names: tuple[str, ...]) -> UnknownNameError:
    """Return an UnknownNameError with this message; the hint has the nearest known names, or all if they are few.

    If there are many and none is near, parameters are listed first and addresses (with a dot) as examples.
    """
    if near_names := find_near_names(name, known_names):
        return UnknownNameError(message, hint=f"nearest: {', '.join(near_names)}")
    if len(known_names) <= 12:
        return UnknownNameError(message, hint=f"there are: {', '.join(known_names)}")
    short, addresses = [n for n in known_names if "." not in n], [n for n in known_names if "." in n]
    shown_names = [*short[:20], "and addresses such as " * bool(short) + ", ".join(addresses[: 1 if short else 6])]
    return UnknownNameError(message, hint=f"there are: {', '.join(shown_names)}{'' if short else ' and more'}")

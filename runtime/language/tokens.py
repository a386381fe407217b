"""Split an expression into tokens: numbers with their units, names and operators, each with its position."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Container
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn

from gudgeon.errors import ExpressionError, InputError, Location, UnitError
from gudgeon.language.argument_checks import IN_RANGE
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.names import WORDS, find_nearest_name, format_character, suggest_replacement
from gudgeon.language.tree import Number
from gudgeon.language.units import OTHER_WORDS, UNITS, Unit, find_symbol_dimension, find_unit, list_factors, parse_unit

_MAX_EXPONENT = 400  # decimal: beyond it no number is finite, and exact fractions grow without bound
_MAX_LENGTH = 1000  # characters of a number: Python reads no integer of more than 4300 digits
_TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z0-9_]*(?:\.[A-Za-z_][A-Za-z0-9_]*)*)"
    r"|(?P<operator>\*\*|[<>]=?|[-+*/(),])"
)
_HALF = r"-?[0-9]\.5|\(-?[1-9]/2\)"
_POWER = re.compile(  # the first power in a unit that is not as units.py reads it
    r"(?:1/)?(?:[A-Za-z\u00b5\u03bc]+(?:\^(?:-?(?:[1-9](?:\.5)?|0\.5)|\(-?[1-9]/2\))(?![\w.])|[\u00b2\u00b3])?"
    r"(?: *[*/\u00b7\u22c5] *| ))*"
    r"(?P<symbol>[A-Za-z\u00b5\u03bc]+) *\^ *(?P<power>\([^()]*\)|[-+]? ?[\w.]*)"
)
_BRACKETED = re.compile(r"\(([^()]*)\) *\^")
_NEGATIVE = re.compile(r"(-[1-9])(?:[*/ ][A-Za-z]+(?:\^?-?[1-9])?)*")  # after `3 s`: the power of `3 s-1`
COMPARISON_HINT = "comparisons (<, <=, >, >=) are allowed only in where(a < b, then, otherwise)"
NESTED_WHERE_HINT = "a where has one comparison; write a < b and c < d as where(a < b, where(c < d, x, y), y)"
_EITHER_HINT = "a where has one comparison; write a < b or c < d as where(a < b, x, where(c < d, x, y))"
_CHOICE_HINT = "a conditional value is written where(a < b, then, otherwise)"
# hints by character or word that expressions do not allow
_CHARACTER_HINTS = {
    "^": "a power is written with **",
    "%": "a percentage is written as a number, 90 % as 0.9; a remainder as mod(a, b)",
    "=": COMPARISON_HINT,
    "!": COMPARISON_HINT,
    "[": "expressions have no subscripts",
    "]": "expressions have no subscripts",
    "'": "expressions have no strings",
    '"': "expressions have no strings",
    "\t": "write a space, not a tab",
    "\u00b7": "write '*'",
    "\u00d7": "write '*'",
    "\u00b0": "write deg after a space",
    "{": "expressions have no braces",
    ";": "only one expression is allowed",
    ":": "expressions have no ':'",
    ".": "a name continues with a letter after '.'; .nan and .inf are not allowed",
    "&": NESTED_WHERE_HINT,
    "|": _EITHER_HINT,
    "and": NESTED_WHERE_HINT,
    "or": _EITHER_HINT,
    "if": _CHOICE_HINT,
    "else": _CHOICE_HINT,
    "?": _CHOICE_HINT,
    "not": "write a >= b for not a < b, or exchange the two values of where",
    "\u2264": "write '<='",
    "\u2265": "write '>='",
    "\u00b2": "a power is written with **: x**2",
    "\u00b3": "a power is written with **: x**3",
}


def offset_location(location: Location, offset: int) -> Location:
    """Return the location `offset` characters after `location` on the same line."""
    return Location(location.file, location.line, location.column + offset)


@dataclass(frozen=True)
class Token:
    """A token of an expression with its position in the text."""

    kind: str  # "number", "name", "operator" or "end"
    text: str
    offset: int
    number: Number | None = None

    def __str__(self) -> str:
        """Return the token as messages show it: quoted, or "the end"."""
        return repr(self.text) if self.text else "the end"


class Tokenizer:
    """Split text into tokens; a unit is part of its number.

    `parameters`: names of the file that may stand alone. In a product or a quotient they take precedence over units.
    """

    def __init__(self, text: str, where: Location, parameters: Container[str] = ()) -> None:
        self.text, self.where, self.position, self.parameters = text, where, 0, parameters

    def raise_error(
        self, message: str, offset: int, hint: str = "", error_class: type[InputError] = ExpressionError
    ) -> NoReturn:
        """Raise an error of the class `error_class` at an offset of the text."""
        raise error_class(message, offset_location(self.where, offset), hint)

    def read_token(self) -> Token:
        """Return the next token and advance; at the end a token of kind "end".

        A number includes its unit. Raises ExpressionError for characters and words that expressions lack, UnitError
        for unknown units.
        """
        text = self.text
        while text.startswith(" ", self.position):
            self.position += 1
        start = self.position
        if start == len(text):
            return Token("end", "", start)
        match = _TOKEN.match(text, start)
        if match is None:
            character = text[start]
            hint = _CHARACTER_HINTS.get(character) or suggest_replacement(character)
            self.raise_error(f"unexpected character {format_character(character)}", start, hint)
        self.position = match.end()
        kind = str(match.lastgroup)
        if kind == "number" or match[0] == "pi":
            return self._parse_number(match[0], start)
        if kind == "name":
            self._check_name(match[0], start)
        return Token(kind, match[0], start)

    def is_at_end(self) -> bool:
        """Return whether only spaces follow the last token that was read."""
        return not self.text[self.position :].strip(" ")

    def _check_name(self, name: str, start: int) -> None:
        """Raise ExpressionError for reserved words, and for parts of a dotted name with leading or double underscores.

        start: offset of the name in the text.
        """
        if name in WORDS:
            hint = _CHARACTER_HINTS.get(name, "expected a number, a name or an expression")
            self.raise_error(f"{name!r} is not a number", start, hint)
        offset = start
        for part in name.split("."):
            if part.startswith("_") or "__" in part:
                self.raise_error(
                    f"{part!r} is not a valid name",
                    offset,
                    "attributes of Python objects are not accessible: use names of the file",
                )
            offset += len(part) + 1

    def _parse_number(self, literal: str, start: int) -> Token:
        """Return the token of a number or pi in SI, including the unit that follows it, and advance.

        literal: its text at offset `start`. Raises ExpressionError for values out of range or below the smallest normal
        double, UnitError for unknown units.
        """
        value = Fraction(math.pi) if literal == "pi" else self._parse_literal(literal, start)
        unit, end = self._parse_following_unit(start)
        self.position = end
        word = re.sub(r" *([*/]) *", r"\1", self.text[start + len(literal) : end].removeprefix(" "))
        text = f"{literal} {word}" if unit else literal
        try:
            si = unit.to_si(value) if unit else float(value)
        except OverflowError:
            self.raise_error(f"{text!r} is too large", start, "expected a number below 1.8e308")
        if value and not sys.float_info.min <= abs(si) < math.inf:  # below it digits are lost
            self.raise_error(f"{text!r} is out of range", start, IN_RANGE)
        return Token("number", text, start, Number(si, text, unit is not None, start))

    def _parse_literal(self, literal: str, start: int) -> Fraction:
        """Return the exact value of a decimal literal at offset `start`.

        Raises ExpressionError with a hint for other notations, a letter directly after it that is no unit, or too many
        digits.
        """
        next_character = self.text[self.position : self.position + 1]
        has_unit = next_character.isalpha() and parse_unit(self.text, self.position) is not None
        has_base_prefix = literal == "0" and next_character in ("x", "o", "b", "X", "O", "B") and not has_unit
        if re.match(r"0[0-9]", literal) or has_base_prefix:
            self.raise_error(
                f"{literal + next_character!r} does not begin a number",
                start,
                "expected a decimal number, such as 12 or 1e-4",
            )
        if next_character == "_":
            self.raise_error("'_' in a number", self.position, "expected digits without separators")
        if next_character.isalpha() and not has_unit:
            word = re.match(r"\w*", self.text[self.position :])
            other = OTHER_WORDS.get(word[0]) if word else None
            guess = find_nearest_name(word[0], UNITS, 0.6) if word and word[0] not in self.parameters else None
            hint = f"a unit follows its number ({literal} mm), a product is written {literal} * name"
            hint = f"did you mean '{literal} {guess}'? A product is written {literal} * name" if guess else hint
            hint = f"write {literal} {other}" if other else hint
            hint = f"write {literal}*pi" if word and word[0] == "pi" else hint
            if sign := re.match(r"[eE]([^\x00-\x7f])[0-9]", self.text[self.position :]):
                hint = f"{format_character(sign[1])} is not a sign of an exponent: {suggest_replacement(sign[1])}"
            self.raise_error(f"{next_character!r} directly after the number {literal}", self.position, hint)
        _, _, exponent = literal.lower().partition("e")
        if exponent and (len(exponent) > 5 or abs(int(exponent)) > _MAX_EXPONENT):
            self.raise_error(f"{literal!r} is out of range", start, IN_RANGE)
        if len(literal) > _MAX_LENGTH:
            self.raise_error(f"a number of {len(literal)} characters", start, f"expected at most {_MAX_LENGTH}")
        return Fraction(literal)

    def _parse_following_unit(self, start: int) -> tuple[Unit | None, int]:
        """Return the unit after the number at `start`, with one space or none before it, and the offset where it ends.

        The unit is None if none follows. Raises UnitError for an unknown unit, ExpressionError for an ambiguous power.
        """
        text, end = self.text, self.position
        has_space = text[end : end + 1] == " "
        self._check_unit_power(end + has_space)
        if not has_space and not text[end : end + 1].isalpha():
            return None, end
        unit = parse_unit(text, end + has_space, self.parameters)
        if unit:
            after = unit[1]
            if re.match(r" *\*\*", text[after:]):
                written, power = text[start:after], re.match(r" *\*\* *(\(-?[1-9]/2\)|-?[0-9.]+)", text[after:])
                power_text = power[1] if power and find_unit(f"m^{power[1]}") else "2"
                hint = f"a power of the unit is {written}^{power_text}, of the quantity ({written})**{power_text}"
                self.raise_error(f"a power after {written!r} can mean two things", after, hint)
            if start == 0 and (power := _NEGATIVE.fullmatch(text, after)):
                written = text[:after]
                hint = f"write {written}^{power[1]} for the power, {written} - {power[1][1:]} for the difference"
                self.raise_error(f"{text[: after + 2]!r} can mean two things", after, hint)
            self._refuse_ambiguous_unit(start, end + has_space, after)
            return unit
        spaces = len(text) - end - len(text[end:].lstrip(" "))
        word = re.match(r"[A-Za-z\u00b5\u03bc_][\w*/^.-]*", text[end + spaces :])
        if word and has_space:
            self._raise_unknown_unit(word[0], end + spaces, spaces)
        return None, end

    def _check_unit_power(self, start: int) -> None:
        """Raise UnitError if the unit text at offset `start` is in brackets or has a power that is not allowed.

        Powers are 1 to 9, −1 to −9 and halves of these, without spaces. The hint gives the accepted form. Called before
        a unit is parsed.
        """
        if (bracketed := _BRACKETED.match(self.text, start)) and find_unit(bracketed[1]):
            hint = "each unit has its own power: m^2/s^2 for (m/s)^2"
            self.raise_error(f"brackets around the unit {bracketed[1]}", start, hint, UnitError)
        match = _POWER.match(self.text, start)
        if not match or not find_symbol_dimension(match["symbol"]):
            return
        symbol, power = match["symbol"], match["power"].replace(" ", "")
        written = f"{symbol}^{power}"
        if find_unit(written) and self.text.startswith(written, match.start("symbol")):
            return
        hint = f"expected 1 to 9 or -1 to -9, or a half of these: {symbol}^2, {symbol}^(-1/2)"
        if find_unit(written):
            hint = f"write {written} without spaces"
        elif find_unit(power):
            hint = f"a product of units is written {symbol}*{power}, a power {symbol}^2"
        elif re.fullmatch(_HALF, power):
            hint = f"a unit that contains pi has no roots: write rad for {symbol}"
        message = (
            f"{power!r} is not a power of the unit {symbol}" if power else f"the unit {symbol} has ^ without a power"
        )
        self.raise_error(message, match.start("symbol"), hint, UnitError)

    def _refuse_ambiguous_unit(self, number_start: int, unit_start: int, end: int) -> None:
        """Raise ExpressionError for `2m` and `3 N m` if m is a name of the file, since a factor may be meant.

        number_start, unit_start: offsets of the number and of its unit. end: offset after both.
        """
        written, spaced = self.text[number_start:end], self.text[unit_start - 1] == " "
        for before, symbol in list_factors(self.text[unit_start:end]):
            doubtful = before == " " if before else not spaced
            if doubtful and symbol in self.parameters:
                number, word = self.text[number_start:unit_start], self.text[unit_start:end]
                hint = f"write '… * {symbol}' for the parameter, '… * (1 {symbol})' for the unit"
                if not before:
                    hint = f"write '{number} {word}' for the unit, '{number} * {symbol}' for the parameter"
                self.raise_error(
                    f"{written!r} can mean two things: {symbol} is a unit, and a parameter here", unit_start, hint
                )

    def _raise_unknown_unit(self, word: str, offset: int, n_spaces: int) -> NoReturn:
        """Raise UnitError for a word after a number that is not a unit, with the most likely remedy.

        offset: of the word. n_spaces: number of spaces before it.
        """
        if parse_unit(word):
            self.raise_error(f"{n_spaces} spaces before the unit {word!r}", offset, "expected exactly one")
        guess, powers = find_nearest_name(word, UNITS, 0.6), re.sub(r"(?<=[A-Za-z])([2-9])(?!\w)", r"^\1", word)
        if word == "Hz":
            hint = "write rev/s or 1/s: they differ by 2*pi"
        elif word in OTHER_WORDS or find_unit(powers):
            hint = f"{word} is written {OTHER_WORDS.get(word, powers)} here"
        elif word in ("pi", "t") or word in FUNCTIONS or guess is None:
            hint = f"a product is written with '*'; units are {', '.join(list(UNITS)[:12])}, …"
        else:
            hint = f"did you mean {guess!r}? A product is written with '*'"
        self.raise_error(f"unknown unit {word!r}", offset, hint, UnitError)

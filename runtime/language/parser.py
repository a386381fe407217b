"""Expressions of a mechanism file: text to tree, parsed by precedence and never evaluated as Python.

    sum     = product {("+" | "-") product}
    product = signed {("*" | "/") signed}
    signed  = ("-" | "+") signed | power
    power   = atom ["**" signed]                       right-associative, binds tighter than a sign
    atom    = number [" " unit] | "pi" [" " unit] | name | function "(" sum {"," sum} ")" | "(" sum ")"

A unit follows a numeric literal or `pi` after exactly one space and holds none (units.py). The tree
holds SI numbers; `check_dimension` (dimensions.py) says whether they fit together.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn

from gudgeon.errors import ExpressionError, InputError, LimitError, Location, UnitError
from gudgeon.language.dimension_check import check_dimension
from gudgeon.language.suggestions import nearest
from gudgeon.language.tree import FUNCTIONS, Binary, Call, Expr, Name, Number, Unary
from gudgeon.language.units import DIMENSIONLESS, UNITS, Unit, parse_unit, unit

__all__ = ["MAX_DEPTH", "MAX_LENGTH", "MAX_NODES", "MAX_WEIGHT", "at", "check_dimension", "parse"]

MAX_LENGTH = 1000  # characters
MAX_DEPTH = 50  # levels of the tree
MAX_NODES = 300
MAX_WEIGHT = 400  # nodes once functions are written out: nested smooth steps grow by powers
_MAX_EXPONENT = 400  # decimal: beyond it no number is finite, and exact fractions grow without bound

_TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z0-9_]*(?:\.[A-Za-z_][A-Za-z0-9_]*)*)"
    r"|(?P<operator>\*\*|[-+*/(),])"
)
_COPIES = {"smooth_step": 3}  # of its arguments in the formula
# words of YAML and Python that look like values or operators; nobody's parameter has such a name
_WORDS = frozenset(
    ("true", "false", "null", "yes", "no", "on", "off", "inf", "nan", "True", "False", "None")
    + ("and", "or", "not", "in", "is", "if", "else", "lambda", "for", "await", "yield")
)
_ADVICE = {
    "^": "a power is written with **", "%": "there is no remainder", "=": "there are no comparisons",
    "<": "there are no comparisons", ">": "there are no comparisons", "!": "there are no comparisons",
    "[": "there are no subscripts", "]": "there are no subscripts", "'": "there are no strings",
    '"': "there are no strings", "\t": "write a space, not a tab", "\u2212": "write '-'", "\u00b7": "write '*'",
    "\u00d7": "write '*'", "\u00b0": "write deg after a space", "{": "there are no braces", ";": "one expression only",
    ":": "there is no ':' in an expression", ".": "a name continues with a letter after '.'",
}  # fmt: skip


def at(where: Location, offset: int) -> Location:
    """The place `offset` characters behind `where`."""
    return Location(where.file, where.line, where.column + offset)


@dataclass(frozen=True)
class _Token:
    kind: str  # "number", "name", "operator" or "end"
    text: str
    offset: int
    number: Number | None = None

    def __str__(self) -> str:
        return repr(self.text) if self.text else "the end"


def parse(text: str, where: Location) -> Expr:
    """The tree of `text`, whose first character stands at `where`.

    Raises ExpressionError (syntax), UnitError (unknown unit) or LimitError (too long, deep or large),
    each at the exact column.
    """
    if len(text) > MAX_LENGTH:
        raise LimitError(f"an expression of {len(text)} characters", where, f"expected at most {MAX_LENGTH}")
    return _Parser(text, where).whole()


class _Tokenizer:
    """Cuts text into tokens; a unit is part of its number."""

    def __init__(self, text: str, where: Location) -> None:
        self.text, self.where, self.position = text, where, 0

    def fail(self, message: str, offset: int, hint: str = "", kind: type[InputError] = ExpressionError) -> NoReturn:
        raise kind(message, at(self.where, offset), hint)

    def next(self) -> _Token:
        """The next token."""
        text = self.text
        while text.startswith(" ", self.position):
            self.position += 1
        start = self.position
        if start == len(text):
            return _Token("end", "", start)
        match = _TOKEN.match(text, start)
        if match is None:
            self.fail(f"unexpected character {text[start]!r}", start, _ADVICE.get(text[start], ""))
        self.position = match.end()
        kind = str(match.lastgroup)
        if kind == "number" or match[0] == "pi":
            return self._number(match[0], start)
        if kind == "name":
            self._check_name(match[0], start)
        return _Token(kind, match[0], start)

    def _check_name(self, name: str, start: int) -> None:
        if name in _WORDS:
            self.fail(f"{name!r} is no number", start, "expected a number, a name or an expression")
        offset = start
        for part in name.split("."):
            if part.startswith("_") or "__" in part:
                self.fail(f"{part!r} is no name", offset, "attributes of Python objects cannot be reached from here")
            offset += len(part) + 1

    def _number(self, literal: str, start: int) -> _Token:
        """A number or pi, with its unit if one follows."""
        value = Fraction(math.pi) if literal == "pi" else self._value(literal, start)
        unit, end = self._unit(start)
        self.position = end
        text = self.text[start:end]
        try:
            si = unit.to_si(value) if unit else float(value)
        except OverflowError:
            self.fail(f"{text!r} is too large", start, "expected a number below 1.8e308")
        if value and (not si or math.isinf(si)):
            self.fail(f"{text!r} is out of range", start, "expected a magnitude from 1e-308 to 1e308")
        return _Token("number", text, start, Number(si, text, unit is not None, start))

    def _value(self, literal: str, start: int) -> Fraction:
        following = self.text[self.position : self.position + 1]
        if re.match(r"0[0-9]", literal) or (literal == "0" and following in ("x", "o", "b", "X", "O", "B")):
            self.fail(
                f"{literal + following!r} does not begin a number",
                start,
                "expected a decimal number, such as 12 or 1e-4",
            )
        if following == "_":
            self.fail("'_' in a number", self.position, "expected digits without separators")
        if following.isalpha():
            self.fail(
                f"{following!r} right behind the number {literal}", self.position,
                f"a unit follows after one space ({literal} mm), a product is written {literal} * name",
            )  # fmt: skip
        _, _, exponent = literal.lower().partition("e")
        if exponent and (len(exponent) > 5 or abs(int(exponent)) > _MAX_EXPONENT):
            self.fail(f"{literal!r} is out of range", start, "expected a magnitude from 1e-308 to 1e308")
        return Fraction(literal)

    def _unit(self, start: int) -> tuple[Unit | None, int]:
        text, end = self.text, self.position
        if text[end : end + 1] != " ":
            return None, end
        found = parse_unit(text, end + 1)
        if found:
            after = found[1]
            if re.match(r" *\*\*", text[after:]):
                hint = "a power of the unit is m^2; a power of the quantity is (3 m)**2"
                self.fail(f"a power behind {text[start:after]!r} can mean two things", after, hint)
            return found
        spaces = len(text) - end - len(text[end:].lstrip(" "))
        word = re.match(r"[A-Za-z\u00b5\u03bc_][\w*/^.-]*", text[end + spaces :])
        if word:
            self._unknown_unit(word[0], end + spaces, spaces)
        return None, end

    def _unknown_unit(self, word: str, offset: int, spaces: int) -> NoReturn:
        if parse_unit(word):
            self.fail(f"{spaces} spaces before the unit {word!r}", offset, "expected exactly one")
        guess = nearest(word, UNITS, 0.6)
        if word == "Hz":
            hint = "write rev/s or 1/s: they differ by 2*pi"
        elif word in ("pi", "t") or word in FUNCTIONS or guess is None:
            hint = f"a product is written with '*'; units are {', '.join(list(UNITS)[:12])}, …"
        else:
            hint = f"did you mean {guess!r}? A product is written with '*'"
        self.fail(f"unknown unit {word!r}", offset, hint, UnitError)


class _Parser:
    """Precedence climbing over the tokens; counts depth and nodes as it builds."""

    def __init__(self, text: str, where: Location) -> None:
        self.tokens, self.where = _Tokenizer(text, where), where
        self.token = self.tokens.next()
        self.depths: dict[int, int] = {}  # id of a node -> levels below it
        self.weights: dict[int, int] = {}  # id of a node -> nodes below it, functions written out
        self.kept: list[Expr] = []  # keeps the ids alive

    def whole(self) -> Expr:
        """The one expression that is all of the text."""
        expr = self.sum(0)
        if self.token.kind != "end":
            self.fail(
                f"unexpected {self.token}",
                self.token.offset,
                "expected an operator (a product is written with '*') or the end",
            )
        return expr

    def fail(self, message: str, offset: int, hint: str) -> NoReturn:
        raise ExpressionError(message, at(self.where, offset), hint)

    def advance(self) -> _Token:
        token, self.token = self.token, self.tokens.next()
        return token

    def make(self, expr: Expr, *children: Expr) -> Expr:
        """Every node passes here, so that no tree grows beyond the bounds."""
        depth = 1 + max((self.depths[id(child)] for child in children), default=0)
        self.depths[id(expr)] = depth
        weight = 1 + sum(self.weights[id(child)] for child in children) * _COPIES.get(getattr(expr, "function", ""), 1)
        self.weights[id(expr)] = weight
        self.kept.append(expr)
        self.bound(depth, expr.offset)
        if len(self.kept) > MAX_NODES or weight > MAX_WEIGHT:
            hint = f"expected at most {MAX_NODES}; smooth steps in each other count by powers of three"
            raise LimitError("an expression of too many parts", at(self.where, expr.offset), hint)
        return expr

    def bound(self, depth: int, offset: int) -> None:
        if depth > MAX_DEPTH:
            hint = f"expected at most {MAX_DEPTH} levels; name a part of it as a parameter"
            raise LimitError("an expression nested too deeply", at(self.where, offset), hint)

    def sum(self, level: int) -> Expr:
        return self.chain(("+", "-"), level)

    def chain(self, operators: tuple[str, str], level: int) -> Expr:
        """Left-associative operators: sums of products, products of signed powers."""
        below = self.signed if operators == ("*", "/") else lambda n: self.chain(("*", "/"), n)
        self.bound(level, self.token.offset)
        left = below(level)
        while self.token.kind == "operator" and self.token.text in operators:
            operator = self.advance()
            self.refuse_ambiguous_angle(operator)
            right = below(level)
            left = self.make(Binary(operator.text, left, right, operator.offset), left, right)
        return left

    def refuse_ambiguous_angle(self, operator: _Token) -> None:
        """`pi/4 deg` is pi/(4 deg) = 45, and no dimension check can see that it was meant as 45 deg."""
        number = self.token.number
        if operator.text != "/" or number is None or not number.has_unit:
            return
        word = number.text.partition(" ")[2]
        known = unit(word)
        if word != "rad" and known and known.dimension == DIMENSIONLESS:
            hint = f"a unit belongs to the number before it: write 1 {word} * …, or …/({self.token.text})"
            self.fail(f"a division by {self.token.text} can mean two things", self.token.offset, hint)

    def signed(self, level: int) -> Expr:
        self.bound(level, self.token.offset)
        if self.token.kind == "operator" and self.token.text in ("-", "+"):
            sign = self.advance()
            operand = self.signed(level + 1)
            return self.make(Unary("-", operand, sign.offset), operand) if sign.text == "-" else operand
        base = self.atom(level)
        if self.token.kind == "operator" and self.token.text == "**":
            operator = self.advance()
            exponent = self.signed(level + 1)
            return self.make(Binary("**", base, exponent, operator.offset), base, exponent)
        return base

    def atom(self, level: int) -> Expr:
        token = self.token
        if token.number is not None:
            self.advance()
            return self.make(token.number)
        if token.kind == "name":
            self.advance()
            return self.name(token, level)
        if token.text != "(":
            what = f"got {token}" if token.text or token.offset else "got nothing"
            self.fail(
                f"expected a number, a name or '(', {what}", token.offset, "an expression such as 80 mm or 2*pi * t"
            )
        self.advance()
        inner = self.sum(level + 1)
        self.close(token.offset)
        return inner

    def close(self, opened: int) -> None:
        if self.token.text != ")":
            hint = f"the '(' at column {self.where.column + opened} is open"
            self.fail(f"expected ')', got {self.token}", self.token.offset, hint)
        self.advance()

    def name(self, token: _Token, level: int) -> Expr:
        called = self.token.text == "("
        if token.text not in FUNCTIONS:
            if called:
                guess = nearest(token.text, FUNCTIONS)
                hint = (f"did you mean {guess!r}? " if guess else "") + f"expected one of: {', '.join(FUNCTIONS)}"
                self.fail(f"unknown function {token.text!r}", token.offset, hint)
            return self.make(Name(token.text, token.offset))
        if not called:
            self.fail(f"{token.text!r} is a function", token.offset, f"expected {token.text}(…)")
        opened = self.advance().offset
        arguments = [self.sum(level + 1)]
        while self.token.text == ",":
            self.advance()
            arguments.append(self.sum(level + 1))
        self.close(opened)
        wanted = FUNCTIONS[token.text][0]
        if len(arguments) != wanted:
            hint = "smooth_step(t, start, duration) goes from 0 to 1" if token.text in ("smooth_step", "ramp") else ""
            self.fail(
                f"{token.text} takes {wanted} argument{'s' * (wanted > 1)}, got {len(arguments)}", token.offset, hint
            )
        return self.make(Call(token.text, tuple(arguments), token.offset), *arguments)

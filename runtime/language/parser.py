"""Expressions of a mechanism file: text to tree, parsed by precedence and never evaluated as Python.

    sum     = product {("+" | "-") product}
    product = signed {("*" | "/") signed}
    signed  = ("-" | "+") signed | power
    power   = atom ["**" signed]                       right-associative, binds tighter than a sign
    atom    = number [[" "] unit] | "pi" [" " unit] | name | function "(" sum {"," sum} ")" | curve "(" sum ")"
            | "where(" sum ("<" | "<=" | ">" | ">=") sum "," sum "," sum ")" | "(" sum ")"

A unit follows a numeric literal after one space or none, `pi` after one (units.py). The tree holds SI numbers;
`check_dimension` (dimension_check.py) says whether they fit together.
"""

from __future__ import annotations

import re
from collections.abc import Container, Mapping
from typing import NoReturn, TypeAlias

from gudgeon.errors import ExpressionError, LimitError, Location
from gudgeon.language.curves import Curve
from gudgeon.language.dimension_check import check_dimension
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.names import nearest
from gudgeon.language.tokens import COMPARED, NESTED, Token, Tokenizer, at
from gudgeon.language.tree import Binary, Call, CurveCall, Expr, Name, Unary
from gudgeon.language.units import DIMENSIONLESS, unit

__all__ = ["MAX_DEPTH", "MAX_LENGTH", "MAX_NODES", "at", "check_dimension", "parse"]

MAX_LENGTH = 50_000  # characters
MAX_DEPTH = 50  # levels of brackets, calls, powers and signs
MAX_TREE = 100  # levels of the tree, after long sums and products are balanced
MAX_NODES = 10_000
MAX_WRITTEN_OUT = 1000  # nodes more once functions are written out: nested smooth steps grow by powers
COPIES = {function.name: function.copies for function in FUNCTIONS.values()}  # of its arguments in the formula
Operand: TypeAlias = tuple[str, int, Expr]  # operator before it, its offset, the operand
_COMPARISONS = ("<", "<=", ">", ">=")


def parse(
    text: str, where: Location, parameters: Container[str] = (), curves: Mapping[str, Curve] | None = None
) -> Expr:
    """Return the tree of `text`, whose first character is at `where`.

    `parameters`: names that take precedence over units; `curves` may be called by their names. Raises ExpressionError
    (syntax), UnitError (unknown unit) or LimitError (too long, deep or large), each at the exact column.
    """
    if len(text) > MAX_LENGTH:
        raise LimitError(f"an expression of {len(text)} characters", where, f"expected at most {MAX_LENGTH}")
    tokens = Tokenizer(text, where, parameters)
    first = tokens.next()
    if first.number is not None and tokens.at_end():
        return first.number
    return _Parser(tokens, first, curves or {}).whole()


class _Parser:
    """Parse an expression by precedence climbing over its tokens, and count depth and nodes."""

    def __init__(self, tokens: Tokenizer, first: Token, curves: Mapping[str, Curve]) -> None:
        self.tokens, self.token, self.where, self.curves = tokens, first, tokens.where, curves
        self.depths: dict[int, int] = {}  # id of a node → levels below it
        self.weights: dict[int, int] = {}  # id of a node → nodes below it, with functions written out
        self.kept: list[Expr] = []  # nodes whose ids are in use

    def whole(self) -> Expr:
        """Parse the whole text as one expression. Raise ExpressionError if anything follows it."""
        expr = self.sum(0)
        if self.token.kind != "end":
            self.fail(
                f"unexpected {self.token}",
                self.token.offset,
                self.compared() or self.decimal() or "expected an operator (a product is written with '*') or the end",
            )
        return expr

    def decimal(self) -> str:
        """Return a hint if a decimal comma was used in a number; else ""."""
        text, at_comma = self.tokens.text, self.token.offset
        before, after = re.search(r"[0-9]+$", text[:at_comma]), re.match(r"[0-9]+", text[at_comma + 1 :])
        is_decimal = self.token.text == "," and before and after
        return f"a number is written with a point: {before[0]}.{after[0]}" if is_decimal and before and after else ""

    def fail(self, message: str, offset: int, hint: str) -> NoReturn:
        """Raise ExpressionError at an offset of the text."""
        raise ExpressionError(message, at(self.where, offset), hint)

    def advance(self) -> Token:
        """Return the present token and move to the next one."""
        token, self.token = self.token, self.tokens.next()
        return token

    def make(self, expr: Expr, *children: Expr) -> Expr:
        """Register a new node with its children. Raise LimitError if the tree exceeds the limits."""
        depth = 1 + max((self.depths[id(child)] for child in children), default=0)
        self.depths[id(expr)] = depth
        weight = 1 + sum(self.weights[id(child)] for child in children) * COPIES.get(getattr(expr, "function", ""), 1)
        self.weights[id(expr)] = weight
        self.kept.append(expr)
        self.bound(depth, expr.offset, MAX_TREE)
        if len(self.kept) > MAX_NODES or weight > len(self.kept) + MAX_WRITTEN_OUT:
            hint = f"expected at most {MAX_NODES}; smooth steps count six more each, in each other by powers of three"
            raise LimitError("an expression of too many parts", at(self.where, expr.offset), hint)
        return expr

    def bound(self, depth: int, offset: int, most: int = MAX_DEPTH) -> None:
        """Raise LimitError if the depth exceeds `most` levels."""
        if depth > most:
            hint = f"expected at most {most} levels; name a part of it, as a parameter or in expressions:"
            raise LimitError("an expression nested too deeply", at(self.where, offset), hint)

    def sum(self, level: int) -> Expr:
        """Parse a sum of products."""
        return self.chain(("+", "-"), level)

    def chain(self, operators: tuple[str, str], level: int) -> Expr:
        """Parse left-associative operators: sums of products, or products of signed powers."""
        below = self.signed if operators == ("*", "/") else lambda n: self.chain(("*", "/"), n)
        self.bound(level, self.token.offset)
        first, rest = below(level), list[Operand]()
        while self.token.kind == "operator" and self.token.text in operators:
            operator = self.advance()
            self.refuse_ambiguous_angle(operator)
            rest.append((operator.text, operator.offset, below(level)))
        depth = self.depths[id(first)]
        for *_, operand in rest:
            depth = 1 + max(depth, self.depths[id(operand)])
        if depth <= MAX_DEPTH or len(rest) < 2:
            return self.joined(first, rest, len(rest))
        if operators == ("+", "-"):
            return self.joined(first, rest)
        above = self.joined(first, [one for one in rest if one[0] == "*"])
        under = [("*", offset, operand) for operator, offset, operand in rest if operator == "/"]
        return self.joined(above, [("/", under[0][1], self.joined(under[0][2], under[1:]))]) if under else above

    def joined(self, first: Expr, rest: list[Operand], left: int = 1) -> Expr:
        """Join the operands: up to `left` operators from left to right, more as a balanced tree of few levels."""
        if len(rest) <= left:
            for operator, offset, operand in rest:
                first = self.make(Binary(operator, first, operand, offset), first, operand)
            return first
        half = len(rest) // 2
        operator, offset, operand = rest[half]
        opposite = {"+": "-", "-": "+"} if operator == "-" else {}  # a - (b + c) for a - b - c
        after = [(opposite.get(sign, sign), place, term) for sign, place, term in rest[half + 1 :]]
        return self.joined(self.joined(first, rest[:half]), [(operator, offset, self.joined(operand, after))])

    def refuse_ambiguous_angle(self, operator: Token) -> None:
        """Raise ExpressionError for divisions such as `pi/4 deg`, which means pi/(4 deg) = 45.

        No dimension check could find that 45 deg was meant.
        """
        number = self.token.number
        if operator.text != "/" or number is None or not number.has_unit:
            return
        word = number.text.partition(" ")[2]
        known = unit(word)
        if word != "rad" and known and known.dimension == DIMENSIONLESS:
            hint = f"a unit belongs to the number before it: write 1 {word} * …, or …/({self.token.text})"
            self.fail(f"a division by {self.token.text} can mean two things", self.token.offset, hint)

    def signed(self, level: int) -> Expr:
        """Parse an operand with its signs and an optional power."""
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
        """Parse a number, a name, a call or an expression in brackets."""
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
        """Consume the ")" of the bracket that was opened at an offset. Raise ExpressionError without one."""
        if self.token.text != ")":
            hint = f"the '(' at column {self.where.column + opened} is open"
            self.fail(f"expected ')', got {self.token}", self.token.offset, self.compared() or hint)
        self.advance()

    def compared(self) -> str:
        """Return a hint if the present token is a comparison outside of where; else ""."""
        return COMPARED if self.token.text in _COMPARISONS else ""

    def name(self, token: Token, level: int) -> Expr:
        """Parse a name, or the call of a function or curve."""
        called, known = self.token.text == "(", (*self.curves, *FUNCTIONS)
        if token.text not in known:
            if called:
                guess = nearest(token.text, known)
                hint = (f"did you mean {guess!r}? " if guess else "") + f"expected one of: {', '.join(known)}"
                self.fail(f"unknown function {token.text!r}", token.offset, hint)
            return self.make(Name(token.text, token.offset))
        if not called:
            what = "curve" if token.text in self.curves else "function"
            self.fail(f"{token.text!r} is a {what}", token.offset, f"expected {token.text}(…)")
        arguments = self.arguments(token, level + 1)
        call = Call(token.text, arguments, token.offset)
        if token.text in self.curves:
            call = CurveCall(call.function, call.arguments, call.offset, curve=self.curves[token.text])
        return self.make(call, *arguments)

    def arguments(self, function: Token, level: int) -> tuple[Expr, ...]:
        """Parse the arguments in brackets and check their number; for where, the compared values come first."""
        opened, compares = self.advance().offset, function.text == "where"
        left = self.sum(level)
        operator = self.token.text
        found: list[Expr] = []
        if compares:
            if operator not in _COMPARISONS:
                self.fail(f"expected a comparison, got {self.token}", self.token.offset, FUNCTIONS["where"].usage)
            self.advance()
            found.append(self.sum(level))
            if self.token.text in _COMPARISONS:
                self.fail(f"expected ',', got {self.token}", self.token.offset, NESTED)
        while self.token.text == ",":
            self.advance()
            found.append(self.sum(level))
        self.close(opened)
        known = None if function.text in self.curves else FUNCTIONS[function.text]
        expected = len(known.arguments) if known else 1
        if len(found) + 1 != expected:
            expected, got = expected - compares, len(found) + 1 - compares
            message = f"{function.text} takes {expected} argument{'s' * (expected > 1)}, got {got}"
            self.fail(message, function.offset, known.usage if known else "")
        return _ordered_arguments(left, operator, *found) if compares else (left, *found)


def _ordered_arguments(left: Expr, operator: str, right: Expr, then: Expr, otherwise: Expr) -> tuple[Expr, ...]:
    """Return the arguments of where as if `<` had been written."""
    compared = (left, right) if operator in ("<", ">=") else (right, left)
    return (*compared, then, otherwise) if operator in ("<", ">") else (*compared, otherwise, then)

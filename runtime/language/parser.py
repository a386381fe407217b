"""Parse the expressions of a mechanism file into syntax trees by recursive descent; they are never run as Python.

    sum     = product {("+" | "-") product}
    product = signed {("*" | "/") signed}
    signed  = ("-" | "+") signed | power
    power   = atom ["**" signed]                       right-associative, binds tighter than a sign
    atom    = number [[" "] unit] | "pi" [" " unit] | name | function "(" sum {"," sum} ")" | curve "(" sum ")"
            | "where(" sum ("<" | "<=" | ">" | ">=") sum "," sum "," sum ")" | "(" sum ")"

A unit follows a numeric literal after one space or none, `pi` after one (units.py). The tree contains SI numbers;
`check_dimension` (dimension_check.py) checks their dimensions.
"""

from __future__ import annotations

import re
from collections.abc import Container, Mapping
from typing import NoReturn, TypeAlias

from gudgeon.errors import ExpressionError, LimitError, Location
from gudgeon.language.curves import Curve
from gudgeon.language.dimension_check import check_dimension
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.names import find_nearest_name
from gudgeon.language.tokens import COMPARISON_HINT, NESTED_WHERE_HINT, Token, Tokenizer, offset_location
from gudgeon.language.tree import Binary, Call, CurveCall, Expr, Name, Unary
from gudgeon.language.units import DIMENSIONLESS, find_unit

__all__ = ["MAX_DEPTH", "MAX_LENGTH", "MAX_NODES", "offset_location", "check_dimension", "parse"]

MAX_LENGTH = 50_000  # characters
MAX_DEPTH = 50  # levels of brackets, calls, powers and signs
MAX_TREE = 100  # levels of the tree, after long sums and products are balanced
MAX_NODES = 10_000
MAX_EXPANDED_NODES = 1000  # additional nodes after expansion of functions: nested smooth steps grow exponentially
ARGUMENT_COPIES = {function.name: function.copies for function in FUNCTIONS.values()}  # of its arguments in the formula
Operand: TypeAlias = tuple[str, int, Expr]  # operator before it, its offset, the operand
_COMPARISONS = ("<", "<=", ">", ">=")


def parse(
    text: str, location: Location, parameters: Container[str] = (), curves: Mapping[str, Curve] | None = None
) -> Expr:
    """Return the tree of an expression, whose first character is at `location`; it is never evaluated as Python.

    parameters: names that take precedence over units. curves: may be called by their names. Raises ExpressionError
    (syntax), UnitError (unknown unit) or LimitError (too long, deep or large), each at the exact column. None: no
    curves.
    """
    if len(text) > MAX_LENGTH:
        raise LimitError(f"an expression of {len(text)} characters", location, f"expected at most {MAX_LENGTH}")
    tokens = Tokenizer(text, location, parameters)
    first = tokens.read_token()
    if first.number is not None and tokens.is_at_end():
        return first.number
    return _Parser(tokens, first, curves or {}).parse_all()


class _Parser:
    """Recursive-descent parser of the tokens of an expression, which limits depth and number of nodes."""

    def __init__(self, tokens: Tokenizer, first: Token, curves: Mapping[str, Curve]) -> None:
        """Begin at the token `first`, which has been read from `tokens`; `curves` may be called by their names."""
        self.tokens, self.token, self.where, self.curves = tokens, first, tokens.where, curves
        self.depths: dict[int, int] = {}  # id of a node → levels below it
        self.node_counts: dict[int, int] = {}  # id of a node → nodes below it, with functions written out
        self.registered: list[Expr] = []  # nodes whose ids are in use

    def parse_all(self) -> Expr:
        """Return the tree of the whole text. Raises ExpressionError if anything follows the expression.

        The hint proposes a comparison or a decimal point if that may be meant.
        """
        expr = self.parse_sum(0)
        if self.token.kind != "end":
            self.raise_error(
                f"unexpected {self.token}",
                self.token.offset,
                self.suggest_comparison()
                or self.suggest_decimal_point()
                or "expected an operator (a product is written with '*') or the end",
            )
        return expr

    def suggest_decimal_point(self) -> str:
        """Return a hint if the current token is the decimal comma of a number such as 0,3; else ""."""
        text, at_comma = self.tokens.text, self.token.offset
        before, after = re.search(r"[0-9]+$", text[:at_comma]), re.match(r"[0-9]+", text[at_comma + 1 :])
        is_decimal = self.token.text == "," and before and after
        return f"a number is written with a point: {before[0]}.{after[0]}" if is_decimal and before and after else ""

    def raise_error(self, message: str, offset: int, hint: str) -> NoReturn:
        """Raise ExpressionError with a hint at an offset of the text."""
        raise ExpressionError(message, offset_location(self.where, offset), hint)

    def advance(self) -> Token:
        """Return the current token and read the next one."""
        token, self.token = self.token, self.tokens.read_token()
        return token

    def register_node(self, expr: Expr, *children: Expr) -> Expr:
        """Register a new node with its depth and number of nodes, and return it.

        children: its direct operands. Arguments of functions that are expanded later count several times
        (ARGUMENT_COPIES). Raises LimitError if the tree exceeds the limits.
        """
        depth = 1 + max((self.depths[id(child)] for child in children), default=0)
        self.depths[id(expr)] = depth
        node_count = 1 + sum(self.node_counts[id(child)] for child in children) * ARGUMENT_COPIES.get(
            getattr(expr, "function", ""), 1
        )
        self.node_counts[id(expr)] = node_count
        self.registered.append(expr)
        self.check_depth(depth, expr.offset, MAX_TREE)
        if len(self.registered) > MAX_NODES or node_count > len(self.registered) + MAX_EXPANDED_NODES:
            hint = f"expected at most {MAX_NODES}; a smooth step counts six more, nested ones three times as many each"
            raise LimitError("an expression of too many parts", offset_location(self.where, expr.offset), hint)
        return expr

    def check_depth(self, depth: int, offset: int, max_depth: int = MAX_DEPTH) -> None:
        """Raise LimitError at an offset of the text if `depth` exceeds `max_depth` levels."""
        if depth > max_depth:
            hint = f"expected at most {max_depth} levels; define a part as a parameter or in expressions:"
            raise LimitError("an expression nested too deeply", offset_location(self.where, offset), hint)

    def parse_sum(self, level: int) -> Expr:
        """Return the tree of a sum of products that begins at the current token; `level`: depth of nesting."""
        return self.parse_operator_chain(("+", "-"), level)

    def parse_operator_chain(self, operators: tuple[str, str], level: int) -> Expr:
        """Return the tree of left-associative operators: sums of products, or products of signed powers.

        operators: ("+", "-") or ("*", "/"). level: depth of nesting. Chains that would make the tree too deep are
        balanced.
        """
        parse_operand = (
            self.parse_signed if operators == ("*", "/") else lambda n: self.parse_operator_chain(("*", "/"), n)
        )
        self.check_depth(level, self.token.offset)
        first, operands = parse_operand(level), list[Operand]()
        while self.token.kind == "operator" and self.token.text in operators:
            operator = self.advance()
            self.refuse_ambiguous_angle(operator)
            operands.append((operator.text, operator.offset, parse_operand(level)))
        depth = self.depths[id(first)]
        for *_, operand in operands:
            depth = 1 + max(depth, self.depths[id(operand)])
        if depth <= MAX_DEPTH or len(operands) < 2:
            return self.join_operands(first, operands, len(operands))
        if operators == ("+", "-"):
            return self.join_operands(first, operands)
        numerator = self.join_operands(
            first, [signed_operand for signed_operand in operands if signed_operand[0] == "*"]
        )
        divisors = [("*", offset, operand) for operator, offset, operand in operands if operator == "/"]
        return (
            self.join_operands(numerator, [("/", divisors[0][1], self.join_operands(divisors[0][2], divisors[1:]))])
            if divisors
            else numerator
        )

    def join_operands(self, first: Expr, further_operands: list[Operand], n_left: int = 1) -> Expr:
        """Return the tree that joins operands: up to `n_left` operators from left to right, more as a balanced tree.

        first: operand before all operators. further_operands: operator, offset and operand of each further one. For
        subtraction the signs within the second half are inverted.
        """
        if len(further_operands) <= n_left:
            for operator, offset, operand in further_operands:
                first = self.register_node(Binary(operator, first, operand, offset), first, operand)
            return first
        half = len(further_operands) // 2
        operator, offset, operand = further_operands[half]
        opposite = {"+": "-", "-": "+"} if operator == "-" else {}  # a - (b + c) for a - b - c
        after = [(opposite.get(sign, sign), position, term) for sign, position, term in further_operands[half + 1 :]]
        return self.join_operands(
            self.join_operands(first, further_operands[:half]), [(operator, offset, self.join_operands(operand, after))]
        )

    def refuse_ambiguous_angle(self, operator: Token) -> None:
        """Raise ExpressionError for a division by a number with an angle unit, such as `pi/4 deg`, which means pi/(4
        deg).

        operator: the token before the current one. No dimension check could detect that 45 deg was meant.
        """
        number = self.token.number
        if operator.text != "/" or number is None or not number.has_unit:
            return
        word = number.text.partition(" ")[2]
        unit = find_unit(word)
        if word != "rad" and unit and unit.dimension == DIMENSIONLESS:
            hint = f"a unit belongs to the number before it: write 1 {word} * …, or …/({self.token.text})"
            self.raise_error(f"a division by {self.token.text} can mean two things", self.token.offset, hint)

    def parse_signed(self, level: int) -> Expr:
        """Return the tree of an operand with its signs and an optional power, which binds tighter than a sign.

        level: depth of nesting, here and in the next methods.
        """
        self.check_depth(level, self.token.offset)
        if self.token.kind == "operator" and self.token.text in ("-", "+"):
            sign = self.advance()
            operand = self.parse_signed(level + 1)
            return self.register_node(Unary("-", operand, sign.offset), operand) if sign.text == "-" else operand
        base = self.parse_atom(level)
        if self.token.kind == "operator" and self.token.text == "**":
            operator = self.advance()
            exponent = self.parse_signed(level + 1)
            return self.register_node(Binary("**", base, exponent, operator.offset), base, exponent)
        return base

    def parse_atom(self, level: int) -> Expr:
        """Return the tree of a number, a name, a call or an expression in brackets, and advance after it.

        level: depth of nesting. Raises ExpressionError for anything else.
        """
        token = self.token
        if token.number is not None:
            self.advance()
            return self.register_node(token.number)
        if token.kind == "name":
            self.advance()
            return self.parse_name(token, level)
        if token.text != "(":
            found_text = f"got {token}" if token.text or token.offset else "got nothing"
            self.raise_error(
                f"expected a number, a name or '(', {found_text}",
                token.offset,
                "an expression such as 80 mm or 2*pi * t",
            )
        self.advance()
        inner = self.parse_sum(level + 1)
        self.consume_bracket(token.offset)
        return inner

    def consume_bracket(self, open_offset: int) -> None:
        """Consume the ")" of the "(" at the offset `open_offset`. Raises ExpressionError if it is missing."""
        if self.token.text != ")":
            hint = f"the '(' at column {self.where.column + open_offset} is open"
            self.raise_error(f"expected ')', got {self.token}", self.token.offset, self.suggest_comparison() or hint)
        self.advance()

    def suggest_comparison(self) -> str:
        """Return a hint if the current token is a comparison operator, which only `where` allows; else ""."""
        return COMPARISON_HINT if self.token.text in _COMPARISONS else ""

    def parse_name(self, token: Token, level: int) -> Expr:
        """Return the tree of a name, or of the call of a function or curve; `token` is the name.

        Raises ExpressionError for an unknown function, or a function without brackets.
        """
        is_call, callables = self.token.text == "(", (*self.curves, *FUNCTIONS)
        if token.text not in callables:
            if is_call:
                guess = find_nearest_name(token.text, callables)
                hint = (f"did you mean {guess!r}? " if guess else "") + f"expected one of: {', '.join(callables)}"
                self.raise_error(f"unknown function {token.text!r}", token.offset, hint)
            return self.register_node(Name(token.text, token.offset))
        if not is_call:
            kind = "curve" if token.text in self.curves else "function"
            self.raise_error(f"{token.text!r} is a {kind}", token.offset, f"expected {token.text}(…)")
        arguments = self.parse_arguments(token, level + 1)
        call = Call(token.text, arguments, token.offset)
        if token.text in self.curves:
            call = CurveCall(call.function, call.arguments, call.offset, curve=self.curves[token.text])
        return self.register_node(call, *arguments)

    def parse_arguments(self, function: Token, level: int) -> tuple[Expr, ...]:
        """Return the trees of the arguments in brackets after checking their number.

        function: token of the function or curve. The first argument of `where` is a comparison, which gives two trees.
        They are ordered as if `<` had been written. Raises ExpressionError.
        """
        opened, is_where = self.advance().offset, function.text == "where"
        left = self.parse_sum(level)
        operator = self.token.text
        others: list[Expr] = []
        if is_where:
            if operator not in _COMPARISONS:
                self.raise_error(
                    f"expected a comparison, got {self.token}", self.token.offset, FUNCTIONS["where"].usage
                )
            self.advance()
            others.append(self.parse_sum(level))
            if self.token.text in _COMPARISONS:
                self.raise_error(f"expected ',', got {self.token}", self.token.offset, NESTED_WHERE_HINT)
        while self.token.text == ",":
            self.advance()
            others.append(self.parse_sum(level))
        self.consume_bracket(opened)
        function_info = None if function.text in self.curves else FUNCTIONS[function.text]
        expected = len(function_info.arguments) if function_info else 1
        if len(others) + 1 != expected:
            expected, got = expected - is_where, len(others) + 1 - is_where
            message = f"{function.text} takes {expected} argument{'s' * (expected > 1)}, got {got}"
            self.raise_error(message, function.offset, function_info.usage if function_info else "")
        return _order_where_arguments(left, operator, *others) if is_where else (left, *others)


def _order_where_arguments(left: Expr, operator: str, right: Expr, then: Expr, otherwise: Expr) -> tuple[Expr, ...]:
    """Return the arguments of `where` as for the operator `<`: `a > b` becomes `b < a`, `a >= b` exchanges the values.

    left, right: compared values. then, otherwise: values if the comparison is true or not.
    """
    compared_values = (left, right) if operator in ("<", ">=") else (right, left)
    return (*compared_values, then, otherwise) if operator in ("<", ">") else (*compared_values, otherwise, then)

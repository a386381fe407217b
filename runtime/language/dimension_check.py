"""Check the dimensions of expression trees: terms that are added, compared or used must have equal dimensions.

A bare number is SI and fits any dimension. In a sum or as a whole value it takes the expected dimension. In a product
with a quantity it is a pure number (`2 * 3 mm`). With `t` alone it may be a rate (`sin(2*pi*t)`). A parameter that is
defined without a unit fits anywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from gudgeon.errors import Location, UnitError
from gudgeon.language.functions import FUNCTIONS, Units
from gudgeon.language.tree import Binary, Call, CurveCall, Expr, Name, Number, Unary, evaluate, names
from gudgeon.language.units import DIMENSIONLESS, Dimension, describe, symbol_dimension, unit

_MOST = 24  # largest exponent of a dimension: mechanics needs no larger one


@dataclass(frozen=True)
class _Flexible:
    """Mark a value without a dimension of its own: a bare number (`pure`), or a product with a unitless parameter."""

    pure: bool


_BARE, _ANY = _Flexible(True), _Flexible(False)
_DimensionOrFlexible = Dimension | _Flexible


def check_dimension(
    expr: Expr, expected: Dimension | None, dimension_of: Callable[[str], Dimension | None], location: Location
) -> Dimension | None:
    """Return the dimension of an expression after checking it: `expected` if the expression fits, None if it fits any.

    expected: None for any dimension. dimension_of(path): dimension of a name, None for one that fits any; it may
    raise. location: of the first character. Raises UnitError with what was found and expected, and hints on names that
    hide units.
    """
    try:
        found = _Checker(dimension_of, location).of(expr)
        if expected is not None and isinstance(found, Dimension) and found != expected:
            message = f"expected {describe(expected)}, got {describe(found)}"
            raise UnitError(message, location, _suggest_divisor(expr, expected))
    except UnitError as error:
        if not (shadowed := dict.fromkeys(names_over_units(expr))):
            raise
        are = [f"{name} is a name of this file here: the unit is written {name}^1" for name in shadowed]
        raise UnitError(error.message, error.where, "; ".join([error.hint, *are] if error.hint else are)) from None
    return expected if isinstance(found, _Flexible) else found


def names_over_units(expr: Expr) -> Iterator[str]:
    """Yield names that are also symbols of units and are factors after a number with a unit: `m` in `3 N/m`."""
    match expr:
        case Unary(operand=operand):
            yield from names_over_units(operand)
        case Binary(operator=operator, left=left, right=right):
            yield from names_over_units(left)
            yield from names_over_units(right)
            if operator in ("*", "/") and isinstance(right, Name) and symbol_dimension(right.path) is not None:
                while isinstance(left, Unary) or isinstance(left, Binary) and left.operator in ("*", "/"):
                    of_name = isinstance(left, Binary) and isinstance(left.right, Name)
                    left = left.operand if isinstance(left, Unary) else left.left if of_name else left.right
                if isinstance(left, Number) and left.has_unit:
                    yield right.path
        case Call(arguments=arguments):
            for argument in arguments:
                yield from names_over_units(argument)


def _suggest_divisor(expr: Expr, expected: Dimension) -> str:
    """Return a hint for expressions such as `1/12 kg*m^2`, which is read as 1/(12 kg*m^2); "" for all others."""
    if not (isinstance(expr, Binary) and expr.operator == "/" and isinstance(expr.right, Number)):
        return ""
    number, _, word = expr.right.text.partition(" ")
    known = unit(word) if expr.right.has_unit else None
    if known is None or known.dimension != expected:
        return ""
    return f"a unit belongs to the number before it: write 1 {word} * …, or (…)/{number} * 1 {word}"


def _is_of_time_alone(expr: Expr) -> bool:
    """Return whether an expression consists of `t`, numbers without unit and operators only."""
    match expr:
        case Number(has_unit=has_unit):
            return not has_unit
        case Name(path=path):
            return path == "t"
        case Unary(operand=operand):
            return _is_of_time_alone(operand)
        case Binary(left=left, right=right):
            return _is_of_time_alone(left) and _is_of_time_alone(right)
    return False


class _Checker:
    """Compute the dimension of a tree. `where`: location of its first character, for errors."""

    def __init__(self, dimension_of: Callable[[str], Dimension | None], location: Location) -> None:
        self._dimension_of, self._where = dimension_of, location

    def of(self, expr: Expr) -> _DimensionOrFlexible:
        """Return the dimension of an expression, computed from its leaves up, or that it is flexible (fits any
        dimension).

        Raises UnitError at the location of the first part that does not fit.
        """
        match expr:
            case Number(text=text, has_unit=has_unit):
                known = unit(text.partition(" ")[2]) if has_unit else None
                return known.dimension if known else _BARE
            case Name(path=path):
                return self._dimension_of(path) or _ANY
            case Unary(operand=operand):
                return self.of(operand)
            case CurveCall():
                return self._check_curve(expr)
            case Call():
                return self._check_call(expr)
        if expr.operator in ("+", "-"):
            word = "add" if expr.operator == "+" else "subtract"
            return self._find_common_dimension(f"cannot {word}", expr.left, expr.right)
        if expr.operator == "**":
            return self._check_power(expr)
        return self._check_product(expr)

    def _location(self, expr: Expr) -> Location:
        """Return the location where an expression begins; a Binary's own offset is that of its operator."""
        while isinstance(expr, Binary):
            expr = expr.left
        return Location(self._where.file, self._where.line, self._where.column + expr.offset)

    def _find_common_dimension(self, problem: str, *parts: Expr) -> _DimensionOrFlexible:
        """Return the common dimension of all parts, or that all are flexible. Raises UnitError if two differ.

        problem: beginning of the message, such as "cannot add".
        """
        result: _DimensionOrFlexible = _BARE
        for part in parts:
            found = self.of(part)
            if isinstance(found, _Flexible):
                result = result if isinstance(result, Dimension) or found.pure else found
            elif isinstance(result, Dimension) and found != result:
                message = f"{problem}: {describe(result)} and {describe(found)}"
                raise UnitError(message, self._location(part), f"expected {describe(result)}")
            else:
                result = found
        return result

    def _check_call(self, call: Call) -> _DimensionOrFlexible:
        """Return the dimension of a function's value, after checking those of its arguments. Raises UnitError."""
        units, unlike = FUNCTIONS[call.function].units, f"{call.function} of unlike quantities"
        if units is Units.SAME:
            return self._find_common_dimension(unlike, *call.arguments)
        if units is Units.CHOICE:
            self._find_common_dimension("cannot compare", *call.arguments[:2])
            return self._find_common_dimension(unlike, *call.arguments[2:])
        if units is Units.RATIO:
            self._find_common_dimension(unlike, *call.arguments)
            return DIMENSIONLESS
        argument = call.arguments[0]
        found = self.of(argument)
        if units is Units.ROOT:
            return found if isinstance(found, _Flexible) else found ** Fraction(1, 2)
        if isinstance(found, Dimension) and found != DIMENSIONLESS:
            message = f"{call.function} expected {describe(DIMENSIONLESS)}, got {describe(found)}"
            raise UnitError(message, self._location(argument))
        return DIMENSIONLESS if isinstance(found, Dimension) else _BARE  # `0.1 * sin(2*pi*t)` may still be a length

    def _check_curve(self, call: CurveCall) -> _DimensionOrFlexible:
        """Return the dimension of a curve's value, after checking that of its argument. Raises UnitError."""
        (argument,), over = call.arguments, call.curve.argument
        found = self.of(argument)
        if isinstance(found, Dimension) and over is not None and found != over:
            message = f"curve {call.function} is over {describe(over)}, got {describe(found)}"
            raise UnitError(message, self._location(argument))
        return _ANY if call.curve.value is None else call.curve.value

    def _check_product(self, expr: Binary) -> _DimensionOrFlexible:
        """Return the dimension of a product or quotient; it is flexible with a unitless parameter, or for numbers
        times `t`.
        """
        left, right = self.of(expr.left), self.of(expr.right)
        if _ANY in (left, right):
            return _ANY
        if left == right == _BARE:
            return _BARE
        if _BARE in (left, right) and _is_of_time_alone(expr):
            return _ANY
        a = left if isinstance(left, Dimension) else DIMENSIONLESS
        b = right if isinstance(right, Dimension) else DIMENSIONLESS
        return self._check_bounds(a * b if expr.operator == "*" else a / b, expr)

    def _check_power(self, expr: Binary) -> _DimensionOrFlexible:
        """Return the dimension of a power; raise UnitError unless the exponent is a pure number.

        With a dimensional base the exponent must be constant, rational and at most _MOST.
        """
        base, exponent = self.of(expr.left), self.of(expr.right)
        if isinstance(exponent, Dimension) and exponent != DIMENSIONLESS:
            message = f"an exponent is a pure number, got {describe(exponent)}"
            raise UnitError(message, self._location(expr.right))
        if isinstance(base, _Flexible) or base == DIMENSIONLESS:
            return base
        value = float("nan") if any(True for _ in names(expr.right)) else float(evaluate(expr.right, lambda _: np.nan))
        if (
            not abs(value) <= _MOST
            or (power := Fraction(value).limit_denominator(12)) != value
            and abs(power - value) > 1e-12
        ):
            message = f"the exponent of {describe(base)} is a plain number such as 2 or 1/2"
            raise UnitError(message, self._location(expr.right))
        return self._check_bounds(base**power, expr)

    def _check_bounds(self, dimension: Dimension, expr: Binary) -> Dimension:
        """Return the dimension unchanged. Raises UnitError at the expression if an exponent exceeds _MOST."""
        if max(abs(dimension.length), abs(dimension.mass), abs(dimension.time)) > _MOST:
            raise UnitError(f"a unit with an exponent above {_MOST}", self._location(expr))
        return dimension

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
from gudgeon.language.tree import Binary, Call, CurveCall, Expr, Name, Number, Unary, evaluate, iterate_names
from gudgeon.language.units import DIMENSIONLESS, Dimension, describe_dimension, find_symbol_dimension, find_unit

_MAX_EXPONENT = 24  # largest exponent of a dimension: mechanics needs no larger one


@dataclass(frozen=True)
class _Flexible:
    """Dimension of a value that fits any dimension.

    `is_unitless_number`: a number without unit, or numbers combined; it is a pure number in a product with a quantity.
    Else it is a product with a parameter without unit, whose dimension stays open.
    """

    is_unitless_number: bool


_UNITLESS_NUMBER, _ANY_DIMENSION = _Flexible(True), _Flexible(False)
_DimensionOrFlexible = Dimension | _Flexible


def check_dimension(
    expr: Expr, expected: Dimension | None, get_dimension: Callable[[str], Dimension | None], location: Location
) -> Dimension | None:
    """Return the dimension of an expression, and check that it is `expected` unless that is None.

    A flexible expression, such as a number without unit, fits any dimension: `expected` is returned then, also if that
    is None. get_dimension(path): dimension of a name, None for one that fits any; it may raise. location: of the first
    character. Raises UnitError with what was found and expected, and hints on names that hide units.
    """
    try:
        dimension = _DimensionChecker(get_dimension, location).find_dimension(expr)
        if expected is not None and isinstance(dimension, Dimension) and dimension != expected:
            message = f"expected {describe_dimension(expected)}, got {describe_dimension(dimension)}"
            raise UnitError(message, location, _suggest_explicit_division(expr, expected))
    except UnitError as error:
        if not (shadowed := dict.fromkeys(find_unit_shadowing_names(expr))):
            raise
        are = [f"{name} is a name of this file: the unit is written {name}^1" for name in shadowed]
        raise UnitError(error.message, error.where, "; ".join([error.hint, *are] if error.hint else are)) from None
    return expected if isinstance(dimension, _Flexible) else dimension


def find_unit_shadowing_names(expr: Expr) -> Iterator[str]:
    """Yield names of the file that may be meant as units: factors after a number with a unit, as `m` in `3 N/m`.

    Only names that are also symbols of units are yielded.
    """
    match expr:
        case Unary(operand=operand):
            yield from find_unit_shadowing_names(operand)
        case Binary(operator=operator, left=left, right=right):
            yield from find_unit_shadowing_names(left)
            yield from find_unit_shadowing_names(right)
            if operator in ("*", "/") and isinstance(right, Name) and find_symbol_dimension(right.path) is not None:
                while isinstance(left, Unary) or isinstance(left, Binary) and left.operator in ("*", "/"):
                    of_name = isinstance(left, Binary) and isinstance(left.right, Name)
                    left = left.operand if isinstance(left, Unary) else left.left if of_name else left.right
                if isinstance(left, Number) and left.has_unit:
                    yield right.path
        case Call(arguments=arguments):
            for argument in arguments:
                yield from find_unit_shadowing_names(argument)


def _suggest_explicit_division(expr: Expr, expected: Dimension) -> str:
    """Return a hint for expressions such as `1/12 kg*m^2`, which is read as 1/(12 kg*m^2); "" for all others."""
    if not (isinstance(expr, Binary) and expr.operator == "/" and isinstance(expr.right, Number)):
        return ""
    number, _, word = expr.right.text.partition(" ")
    unit = find_unit(word) if expr.right.has_unit else None
    if unit is None or unit.dimension != expected:
        return ""
    return f"a unit belongs to the number before it: write 1 {word} * …, or (…)/{number} * 1 {word}"


def _depends_on_time_only(expr: Expr) -> bool:
    """Return whether an expression consists of `t`, numbers without unit and operators only."""
    match expr:
        case Number(has_unit=has_unit):
            return not has_unit
        case Name(path=path):
            return path == "t"
        case Unary(operand=operand):
            return _depends_on_time_only(operand)
        case Binary(left=left, right=right):
            return _depends_on_time_only(left) and _depends_on_time_only(right)
    return False


class _DimensionChecker:
    """Compute the dimension of a tree. `where`: location of its first character, for errors."""

    def __init__(self, get_dimension: Callable[[str], Dimension | None], location: Location) -> None:
        self._get_dimension, self._where = get_dimension, location

    def find_dimension(self, expr: Expr) -> _DimensionOrFlexible:
        """Return the dimension of an expression, computed from its leaves up, or that it is flexible (fits any
        dimension).

        A number without unit and a name without dimension are flexible. Raises UnitError at the location of the first
        part that does not fit.
        """
        match expr:
            case Number(text=text, has_unit=has_unit):
                unit = find_unit(text.partition(" ")[2]) if has_unit else None
                return unit.dimension if unit else _UNITLESS_NUMBER
            case Name(path=path):
                return self._get_dimension(path) or _ANY_DIMENSION
            case Unary(operand=operand):
                return self.find_dimension(operand)
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

    def _find_location(self, expr: Expr) -> Location:
        """Return the location where an expression begins; a Binary's own offset is that of its operator."""
        while isinstance(expr, Binary):
            expr = expr.left
        return Location(self._where.file, self._where.line, self._where.column + expr.offset)

    def _find_common_dimension(self, message_start: str, *parts: Expr) -> _DimensionOrFlexible:
        """Return the common dimension of the parts of a sum or comparison. Raises UnitError if two dimensions differ.

        Flexible parts take the dimension of the others. If all are flexible, the result is flexible: a unitless number
        only if all are. message_start: beginning of the message, such as "cannot add".
        """
        result: _DimensionOrFlexible = _UNITLESS_NUMBER
        for part in parts:
            part_dimension = self.find_dimension(part)
            if isinstance(part_dimension, _Flexible):
                result = (
                    result if isinstance(result, Dimension) or part_dimension.is_unitless_number else part_dimension
                )
            elif isinstance(result, Dimension) and part_dimension != result:
                message = f"{message_start}: {describe_dimension(result)} and {describe_dimension(part_dimension)}"
                raise UnitError(message, self._find_location(part), f"expected {describe_dimension(result)}")
            else:
                result = part_dimension
        return result

    def _check_call(self, call: Call) -> _DimensionOrFlexible:
        """Return the dimension of a function's value, after checking those of its arguments. Raises UnitError.

        By the `units` of the function: SAME and CHOICE give the common dimension of the arguments (of the two results
        of `where`), RATIO a pure number from equal dimensions, ROOT half the exponents. Other functions need a pure
        number and give one, or a unitless number if the argument is flexible.
        """
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
        dimension = self.find_dimension(argument)
        if units is Units.ROOT:
            return dimension if isinstance(dimension, _Flexible) else dimension ** Fraction(1, 2)
        if isinstance(dimension, Dimension) and dimension != DIMENSIONLESS:
            message = (
                f"{call.function} expected {describe_dimension(DIMENSIONLESS)}, got {describe_dimension(dimension)}"
            )
            raise UnitError(message, self._find_location(argument))
        return (
            DIMENSIONLESS if isinstance(dimension, Dimension) else _UNITLESS_NUMBER
        )  # `0.1 * sin(2*pi*t)` may still be a length

    def _check_curve(self, call: CurveCall) -> _DimensionOrFlexible:
        """Return the dimension of a curve's value, after checking that of its argument. Raises UnitError."""
        (argument,), over = call.arguments, call.curve.argument
        dimension = self.find_dimension(argument)
        if isinstance(dimension, Dimension) and over is not None and dimension != over:
            message = f"curve {call.function} is over {describe_dimension(over)}, got {describe_dimension(dimension)}"
            raise UnitError(message, self._find_location(argument))
        return _ANY_DIMENSION if call.curve.value is None else call.curve.value

    def _check_product(self, expr: Binary) -> _DimensionOrFlexible:
        """Return the dimension of a product or quotient.

        It is flexible if a factor is of any dimension, for two unitless numbers, and for unitless numbers times `t`,
        which may be a rate. In other products a unitless number is a pure number. Raises UnitError for too large
        exponents.
        """
        left, right = self.find_dimension(expr.left), self.find_dimension(expr.right)
        if _ANY_DIMENSION in (left, right):
            return _ANY_DIMENSION
        if left == right == _UNITLESS_NUMBER:
            return _UNITLESS_NUMBER
        if _UNITLESS_NUMBER in (left, right) and _depends_on_time_only(expr):
            return _ANY_DIMENSION
        a = left if isinstance(left, Dimension) else DIMENSIONLESS
        b = right if isinstance(right, Dimension) else DIMENSIONLESS
        return self._check_exponent_bounds(a * b if expr.operator == "*" else a / b, expr)

    def _check_power(self, expr: Binary) -> _DimensionOrFlexible:
        """Return the dimension of a power; raise UnitError unless the exponent is a pure number.

        A flexible or dimensionless base is returned as it is. With a dimensional base the exponent must be constant,
        rational and at most _MAX_EXPONENT.
        """
        base, exponent = self.find_dimension(expr.left), self.find_dimension(expr.right)
        if isinstance(exponent, Dimension) and exponent != DIMENSIONLESS:
            message = f"an exponent must be a pure number, got {describe_dimension(exponent)}"
            raise UnitError(message, self._find_location(expr.right))
        if isinstance(base, _Flexible) or base == DIMENSIONLESS:
            return base
        value = (
            float("nan")
            if any(True for _ in iterate_names(expr.right))
            else float(evaluate(expr.right, lambda _: np.nan))
        )
        if (
            not abs(value) <= _MAX_EXPONENT
            or (power := Fraction(value).limit_denominator(12)) != value
            and abs(power - value) > 1e-12
        ):
            message = f"the exponent of {describe_dimension(base)} must be a number such as 2 or 1/2"
            raise UnitError(message, self._find_location(expr.right))
        return self._check_exponent_bounds(base**power, expr)

    def _check_exponent_bounds(self, dimension: Dimension, expr: Binary) -> Dimension:
        """Return the dimension unchanged. Raises UnitError at the expression if an exponent exceeds _MAX_EXPONENT."""
        if max(abs(dimension.length), abs(dimension.mass), abs(dimension.time)) > _MAX_EXPONENT:
            raise UnitError(f"a unit with an exponent above {_MAX_EXPONENT}", self._find_location(expr))
        return dimension

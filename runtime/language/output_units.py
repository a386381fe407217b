"""Derive the unit of an output from the units of the names in its expression, for labels of plots.

The generator has checked the dimensions when it read the file. A unit that cannot be derived is "".
"""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from typing import TypeAlias

from gudgeon.language.functions import FUNCTIONS, Function, Units
from gudgeon.language.tree import Binary, Call, CurveCall, Expr, Name, Number, Unary

# exponents of m, kg, s, rad; None: a bare number, which fits any dimension
Exponents: TypeAlias = tuple[Fraction, Fraction, Fraction, Fraction]
_BASES = ("m", "kg", "s", "rad")
# derived units in base units
_DERIVED = {"N": "m*kg/s^2", "J": "m^2*kg/s^2", "W": "m^2*kg/s^3", "Pa": "kg/m/s^2", "Hz": "1/s"}
_TURNS = ("rad", "mrad", "deg", "rev", "rpm")  # units of angles and of rates of angles
_PLAIN = (Fraction(0),) * 4  # exponents of a pure number
# preferred units
_NAMES = ("N", "J", "N/m", "N*s/m", "Pa", "Pa*s", "W", "m", "m/s", "m/s^2", "rad", "rad/s", "rad/s^2")


def derive_unit(expression: Expr, get_unit: Callable[[str], str | None]) -> str:
    """Return the SI unit of an expression from the units of its names; "" if it cannot be derived.

    get_unit(name): unit of a name, None if it has none.
    """
    try:
        return _format_exponents(_derive_exponents(expression, get_unit) or _PLAIN)
    except (ValueError, ZeroDivisionError):
        return ""


def parse_exponents(unit: str) -> Exponents:
    """Return the exponents of m, kg, s, rad of an SI unit such as "kg*m^2/s"; derived units such as N count too.

    "1" has no exponents; a "/" inverts the next factor only. Raises ValueError for any other text.
    """
    total = list(_PLAIN)
    sign = 1
    for part in unit.replace("*", " * ").replace("/", " / ").split():
        if part in "*/":
            sign = 1 if part == "*" else -1
            continue
        name, _, power = part.partition("^")
        exponent = sign * Fraction(power.strip("()") or "1")
        if name in _BASES:
            total[_BASES.index(name)] += exponent
        elif name in _DERIVED:
            total = [a + exponent * b for a, b in zip(total, parse_exponents(_DERIVED[name]), strict=True)]
        elif name != "1":
            raise ValueError(f"not an SI unit: {unit!r}")
    return total[0], total[1], total[2], total[3]


def _derive_exponents(expression: Expr, get_unit: Callable[[str], str | None]) -> Exponents | None:
    """Return the exponents of an expression's unit; None for a number without unit, which fits any unit.

    get_unit(path): unit of a name, None for one without. A power needs a literal exponent; other expressions count as
    pure numbers. Raises ValueError for a unit that is not SI.
    """
    match expression:
        case Number():
            return None
        case Name(path=path):
            text = get_unit(path)
            return None if text is None else parse_exponents(text)
        case Unary(operand=operand):
            return _derive_exponents(operand, get_unit)
        case Binary(operator="+" | "-", left=left, right=right):
            return _merge_exponents(_derive_exponents(left, get_unit), _derive_exponents(right, get_unit))
        case Binary(operator="**", left=left, right=Number(value=power)):
            return _scale_exponents(_derive_exponents(left, get_unit), Fraction(power).limit_denominator(12))
        case Binary(operator="*" | "/" as operator, left=left, right=right):
            factor = _scale_exponents(
                _derive_exponents(right, get_unit) or _PLAIN, Fraction(1 if operator == "*" else -1)
            )
            return _add_exponents(_derive_exponents(left, get_unit) or _PLAIN, factor or _PLAIN)
        case CurveCall(curve=curve):
            return None if curve.unit is None else parse_exponents(curve.unit)
        case Call(function=function, arguments=arguments):
            return _derive_call_exponents(
                FUNCTIONS[function], [_derive_exponents(argument, get_unit) for argument in arguments]
            )
    return _PLAIN


def _derive_call_exponents(function: Function, arguments: list[Exponents | None]) -> Exponents | None:
    """Return the exponents of a function's value from those of its arguments; None if it fits any unit.

    A square root halves them. Functions such as max, and both branches of `where`, keep them. The value of all other
    functions is an angle in rad or a pure number.
    """
    if function.units is Units.ROOT:
        return _scale_exponents(arguments[0], Fraction(1, 2))
    if function.units in (Units.SAME, Units.CHOICE):
        first, *rest = arguments[2:] if function.units is Units.CHOICE else arguments
        return _merge_exponents(first, rest[0] if rest else None)
    return parse_exponents("rad") if function.is_angle else _PLAIN


def _merge_exponents(a: Exponents | None, b: Exponents | None) -> Exponents | None:
    """Return the exponents of a sum: those of a, or those of b if a is a bare number or dimensionless."""
    return b if a is None or (a == _PLAIN and b is not None) else a


def _add_exponents(a: Exponents, b: Exponents) -> Exponents:
    """Return the exponents of the product of two units."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]


def _scale_exponents(exponents: Exponents | None, power: Fraction) -> Exponents | None:
    """Return the exponents of a unit that is raised to a power; None for None."""
    return (
        None
        if exponents is None
        else (exponents[0] * power, exponents[1] * power, exponents[2] * power, exponents[3] * power)
    )


def _format_exponents(exponents: Exponents) -> str:
    """Return a unit as text: a preferred name, else a product of powers; "" for a pure number.

    Angles in compound units are left out: "m/s", not "m*rad/s".
    """
    if any(exponents[:2]):
        exponents = (*exponents[:3], Fraction(0))
    for name in _NAMES:
        if parse_exponents(name) == exponents:
            return name
    powers = [(base, power) for base, power in zip(_BASES, exponents, strict=True) if power]
    above = "*".join(base if power == 1 else f"{base}^{power}" for base, power in powers if power > 0)
    below = "".join(f"/{base}" if power == -1 else f"/{base}^{-power}" for base, power in powers if power < 0)
    return (above or "1") + below if powers else ""


def find_angle_power(expression: Expr) -> int:
    """Return the power of angle units in an expression of a file: 1 for pi/6, 20 deg or 90 rpm, −1 for N*m/deg.

    Products add, quotients subtract; of the terms of a sum and of equal arguments the largest counts. A function that
    returns an angle gives 1. Names, powers and curves give 0.
    """
    match expression:
        case Number(text=text, has_unit=has_unit):
            above, *below = text.removeprefix("pi").split("/") if has_unit else [""]
            powers = [
                sum(word in _TURNS for word in re.findall(r"[A-Za-z]+", part)) for part in (above, "/".join(below))
            ]
            return text.startswith("pi") or powers[0] - powers[1]
        case Unary(operand=operand):
            return find_angle_power(operand)
        case Binary(operator="*" | "/" as operator, left=left, right=right):
            return find_angle_power(left) + (1 if operator == "*" else -1) * find_angle_power(right)
        case Binary(operator="+" | "-", left=left, right=right):
            return max(find_angle_power(left), find_angle_power(right))
        case Call(function=function, arguments=arguments) if not isinstance(expression, CurveCall):
            function_info = FUNCTIONS[function]
            return (
                max(map(find_angle_power, arguments))
                if function_info.units is Units.SAME
                else int(function_info.is_angle)
            )
    return 0

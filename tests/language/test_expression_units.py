"""Units and dimensions of expressions: what fits, what is refused at its column, what could mean two things."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from gudgeon.errors import ExpressionError, InputError, Location, UnitError
from gudgeon.language.parser import check_dimension, parse
from gudgeon.language.quantities import parse_quantity
from gudgeon.language.tree import to_json
from gudgeon.language.units import DIMENSIONLESS, LENGTH, MASS, RATE, TIME, VELOCITY, Dimension, make_dimension

HERE = Location("file.yaml", 3, 10)
NAMES = {"t": TIME, "l": LENGTH, "m1": MASS, "omega": RATE, "free": None}


def dimension_of(text: str, expected: Dimension | None = None) -> Dimension | None:
    return check_dimension(parse(text, HERE), expected, NAMES.__getitem__, HERE)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("80 mm", LENGTH),
        ("l * omega", VELOCITY),
        ("2 * l + 3", LENGTH),
        ("l**2", make_dimension(2)),
        ("sqrt(l**2 + (3 mm)**2)", LENGTH),
        ("l**(1/2)", Dimension(Fraction(1, 2))),
        ("l**-1", make_dimension(-1)),
        ("atan2(l, 3 mm) + 5 deg", DIMENSIONLESS),
        ("omega * t + 10 deg", DIMENSIONLESS),
        ("smooth_step(t, 0, 0.5 s) * 90 deg", DIMENSIONLESS),
        ("10 mm * sin(omega * t)", LENGTH),
        ("min(l, 3 mm)", LENGTH),
        ("abs(-m1)", MASS),
        ("5", None),
        ("free * l", None),
        ("10 mm + free", LENGTH),
        ("2*pi*t", None),  # a bare number beside t alone may be a rate
    ],
)
def test_dimension(text: str, expected: Dimension | None) -> None:
    assert dimension_of(text) == expected


@pytest.mark.parametrize("text", ["3", "free", "free * l", "-3 * 2", "2*pi*t", "sin(2*pi*t) * 10 mm", "3 + 2 mm"])
def test_bare_numbers_fit(text: str) -> None:
    assert dimension_of(text, LENGTH) == LENGTH


@pytest.mark.parametrize(
    ("text", "expected", "message", "offset"),
    [
        ("142 mm", MASS, "expected a mass (kg), got a length (m)", 0),
        ("2 * 3 mm", MASS, "expected a mass (kg), got a length (m)", 0),
        ("omega", LENGTH, "expected a length (m), got a rate or an angular velocity (rad/s)", 0),
        ("1 + l + m1", LENGTH, "cannot add: a length (m) and a mass (kg)", 8),
        ("l - 2 * m1", LENGTH, "cannot subtract: a length (m) and a mass (kg)", 4),
        ("l * sin(omega)", LENGTH, "sin expected a pure number or an angle (rad), got a rate", 8),
        ("max(l, 3 kg)", LENGTH, "max of unlike quantities: a length (m) and a mass (kg)", 7),
        ("2**(3 mm)", None, "an exponent must be a pure number, got a length (m)", 4),
        ("l**free", None, "the exponent of a length (m) must be a number", 3),
        ("l**0.123456", None, "the exponent of a length (m) must be a number", 3),
        ("l**1e300", None, "the exponent of a length (m) must be a number", 3),
    ],
)
def test_wrong_dimension(text: str, expected: Dimension | None, message: str, offset: int) -> None:
    with pytest.raises(UnitError) as caught:
        dimension_of(text, expected)
    assert message in caught.value.message
    assert caught.value.where == Location("file.yaml", 3, 10 + offset)


@pytest.mark.parametrize(("text", "offset"), [("2m", 1), ("0.1m/s", 3), ("3 N m", 2), ("1 + 3 kg m", 6)])
def test_a_unit_that_may_be_a_parameter_is_refused(text: str, offset: int) -> None:
    parse(text, HERE)
    with pytest.raises(ExpressionError, match="can mean two things") as caught:
        parse(text, HERE, ("m", "ft"))
    assert caught.value.where == Location("file.yaml", 3, 10 + offset)


def test_a_name_precedes_a_unit_in_a_product() -> None:
    named = {"3 N*m": "(3 N)*m", "2 N * ft": "(2 N)*ft", "6 kg/m": "(6 kg)/m", "2 N*m*ft": "(2 N)*m*ft"}
    for text, by_name in named.items():
        assert to_json(parse(text, HERE, ("m", "ft"))) == to_json(parse(by_name, HERE))
    for text in ("2 m", "3 N*m^1", "3 N·m", "3 N m^2", "3 N*m*s"):
        assert to_json(parse(text, HERE, ("m", "ft"))) == to_json(parse(text, HERE))


def test_white_space_around_operators_of_units_has_no_meaning() -> None:
    for text in ("3 N * m", "3 N *m", "3 N* m", "3 N  *  m", "3 kg * m^2 / s^2", "3N * m"):
        assert to_json(parse(text, HERE)) == 3.0


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("3 Nm", r"written N\*m here"),
        ("2 lbs", "written lb"),
        ("2 degrees", "written deg"),
        ("3 mm2", r"written mm\^2"),
        ("3Nm", r"write 3 N\*m"),
        ("2 feet", "written ft"),
        ("3 kgm2", r"written kg\*m\^2"),
        ("a²", r"\*\*: x\*\*2"),
    ],
)
def test_units_called_otherwise(text: str, hint: str) -> None:
    with pytest.raises(InputError, match=hint):
        parse(text, HERE)


def test_number_of_text() -> None:
    assert parse_quantity(" 0.5 mm ", "bearings.pin.clearance", (1, 0, 0)) == 0.0005
    assert parse_quantity("2*pi rad/s", "parameters.omega", (0, 0, -1)) == math.tau
    assert parse_quantity("-3e-4", "parameters.c", (1, 0, 0)) == -3e-4
    assert parse_quantity("0.5mm", "parameters.c", (1, 0, 0)) == 0.0005
    for text in ("1 kg", "c", "", "0.5mmm", "2 * omega"):
        with pytest.raises(InputError, match="value of parameters.c:1:"):
            parse_quantity(text, "parameters.c", (1, 0, 0))

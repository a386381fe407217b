"""The table of units against pint, the converter of record."""

from __future__ import annotations

import math
import re
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gudgeon.errors import InputError, Location
from gudgeon.language.parser import parse
from gudgeon.language.units import (
    DIMENSIONLESS,
    LENGTH,
    UNITS,
    VISCOSITY,
    Dimension,
    describe_dimension,
    find_si_unit,
    find_unit,
    make_dimension,
    parse_unit,
)

pint = pytest.importorskip("pint")
BASES = {"[length]": 0, "[mass]": 1, "[time]": 2}
WRITTEN = {"P": "poise", "cP": "centipoise", "rev": "revolution", "in": "inch"}  # where pint's symbol is another


@pytest.fixture(scope="module")
def registry():  # type: ignore[no-untyped-def]
    return pint.UnitRegistry()


@pytest.mark.parametrize("token", UNITS)
def test_unit_is_pints(token: str, registry) -> None:  # type: ignore[no-untyped-def]
    factor, of = UNITS[token]
    written = re.sub(r"[A-Za-z]+", lambda symbol: WRITTEN.get(symbol[0], symbol[0]), token)
    quantity = registry.Quantity(1.0, written).to_base_units()
    assert factor == pytest.approx(quantity.magnitude, rel=1e-15)
    exponents = [0, 0, 0]
    for base, exponent in quantity.dimensionality.items():
        exponents[BASES[base]] = exponent
    assert of == make_dimension(*exponents)


def test_the_list_is_closed() -> None:
    for token in (
        "t",
        "c",
        "k",
        "h",
        "e",
        "G",
        "R",
        "Hz",
        "tonne",
        "",
        "mm ",
        " mm",
        "1",
        "1/",
        "m**2",
        "m^0",
        "m^10",
    ):
        assert find_unit(token) is None


def test_rounding_is_done_once() -> None:
    found = find_unit("mm")
    assert found is not None
    for micrometres in range(1, 2000):
        assert found.to_si(Fraction(micrometres, 1000)) == float(f"{micrometres}e-6")
    degree = find_unit("deg")
    assert degree is not None
    assert [degree.to_si(Fraction(n)) for n in (90, 180, -360)] == [math.pi / 2, math.pi, -2 * math.pi]


@given(
    st.lists(st.tuples(st.sampled_from(["m", "kg", "s", "N", "mm", "deg"]), st.integers(-3, 3)), min_size=1, max_size=4)
)
def test_products_multiply(factors: list[tuple[str, int]]) -> None:
    factors = [(symbol, power or 1) for symbol, power in factors]
    token = "*".join(f"{symbol}^{power}" if power != 1 else symbol for symbol, power in factors)
    found = find_unit(token)
    assert found is not None
    expected, of = 1.0, DIMENSIONLESS
    for symbol, power in factors:
        expected *= UNITS[symbol][0] ** power
        of = of * UNITS[symbol][1] ** power
    assert found.to_si(Fraction(1)) == pytest.approx(expected, rel=1e-14)
    assert found.dimension == of


def test_a_unit_ends_where_the_expression_goes_on() -> None:
    for text, token in (("mm*c", "mm"), ("m/s)", "m/s"), ("m/c", "m"), ("N*m*sin(t)", "N*m"), ("kg*m^2 * 3", "kg*m^2")):
        found = parse_unit(text)
        assert found is not None and text[: found[1]] == token
    assert parse_unit("m_x") is None and parse_unit("mm3") is None
    whole = (("mm*min(1, 2)", "mm"), ("m/min(t, 2)", "m"), ("N/m s", "N/m"), ("m t", "m"), ("kg m²)", "kg m²"))
    for text, token in whole:
        found = parse_unit(text)
        assert found is not None and text[: found[1]] == token


@pytest.mark.parametrize(
    ("token", "same"),
    [
        ("mm²", "mm^2"),
        ("m³", "m^3"),
        ("kg m²", "kg*m^2"),
        ("N·m", "N*m"),
        ("N⋅s/m", "N*s/m"),
        ("kg m/s^2", "kg*m/s^2"),
        ("N/m^(3/2)", "N/m^1.5"),
        ("kg/m^(1/2)/s^2", "N/m^1.5"),
        ("inch", "in"),
        ("grams", "g"),
        ("gram", "g"),
    ],
)
def test_units_as_people_write_them(token: str, same: str) -> None:
    found, other = find_unit(token), find_unit(same)
    assert found is not None and found == other


def test_halves_of_powers() -> None:
    stiff = find_unit("N/mm^1.5")
    assert stiff is not None and stiff.dimension == make_dimension(1, 1, -2) * LENGTH ** Fraction(-3, 2)
    assert stiff.to_si(Fraction(1)) == pytest.approx(1000.0**1.5, rel=1e-15)
    assert find_unit("deg^1.5") is None and find_unit("m^1.3") is None and find_unit("m^(2/3)") is None


@given(st.builds(make_dimension, st.integers(-4, 4), st.integers(-4, 4), st.integers(-4, 4)))
def test_si_unit_reads_back(of: Dimension) -> None:
    written = find_si_unit(of)
    if of == DIMENSIONLESS:
        assert written == ""
        return
    found = find_unit(written)
    assert found is not None and found.dimension == of and found.to_si(Fraction(1)) == 1.0


def test_words() -> None:
    assert describe_dimension(LENGTH) == "a length (m)"
    assert describe_dimension(VISCOSITY) == "a viscosity (Pa*s)"
    assert describe_dimension(make_dimension(1, 1, 1)) == "a quantity (kg*m*s)"


def test_a_divisor_with_the_wanted_unit_is_told_how_to_write_it() -> None:
    from gudgeon.errors import Location, UnitError
    from gudgeon.language.dimension_check import check_dimension
    from gudgeon.language.parser import parse
    from gudgeon.language.units import INERTIA

    where = Location("f", 1, 1)
    with pytest.raises(UnitError, match=r"write 1 kg\*m\^2 \* …, or \(…\)/12 \* 1 kg\*m\^2"):
        check_dimension(parse("1/12 kg*m^2", where), INERTIA, lambda _: None, where)


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("1 N^m", 3, "'m' is not a power of the unit N"),
        ("1 mm^1.5/s^x", 10, "'x' is not a power of the unit s"),
        ("1 m^99", 3, "'99'"),
        ("1 m^0", 3, "'0'"),
        ("1 m^(1/3)", 3, "(1/3)"),
        ("1 m^-", 3, "'-'"),
        ("1 m^", 3, "without"),
        ("1 m ^2", 3, "'2'"),
        ("1 (m/s)^2", 3, "brackets around the unit m/s"),
        ("1 kg**2", 5, "two things"),
        ("3 N*m**3", 6, "two things"),
        ("1 deg^0.5", 3, "'0.5'"),
        ("2 kg*m^n", 6, "'n'"),
    ],
)
def test_a_power_that_is_none_has_a_remedy(text: str, column: int, message: str) -> None:
    """The message names the place; what its hint proposes is accepted."""
    with pytest.raises(InputError) as caught:
        parse(text, Location("f", 1, 1))
    error, _, hint = str(caught.value).partition("\n")
    assert caught.value.where == Location("f", 1, column) and message in error
    proposed = re.findall(r"\([\w *]+\)\*\*\d|\d [\w*]+\^\d|[a-zA-Z]+\^\(-1/2\)|[a-zA-Z]+[*^]\w+", hint)
    assert proposed or "rad" in hint
    for one in proposed:
        parse(one if one[0] in "(0123456789" else f"1 {one}", Location("f", 1, 1))


@pytest.mark.parametrize("character", ["\u00a0", "\u2009", "\u202f", "\u3000", "\u200b", "\ufeff"])
@pytest.mark.parametrize("text", ["2{}mm", "{}2 mm", "2 mm{}", "a{}+ b", "2 N{}m"])
def test_spaces_that_are_none_are_named(text: str, character: str) -> None:
    with pytest.raises(InputError, match=f"unexpected character U\\+{ord(character):04X} ") as caught:
        parse(text.format(character), Location("f", 1, 1))
    assert caught.value.where == Location("f", 1, 1 + text.index("{"))
    assert "write an ordinary space" in str(caught.value) or "remove it" in str(caught.value)


@pytest.mark.parametrize("sign", ["\u2212", "\u2010", "\u2013", "\uff0d", "\ufe63"])
@pytest.mark.parametrize("text", ["{}2 mm", "a {} b", "5e{}3 m"])
def test_signs_that_look_like_a_minus_are_named(text: str, sign: str) -> None:
    with pytest.raises(InputError, match=f"U\\+{ord(sign):04X} .*(\n  )?.*write '-'"):
        parse(text.format(sign), Location("f", 1, 1))


def test_both_signs_of_micro_are_one() -> None:
    assert find_unit("\u00b5m") == find_unit("\u03bcm") == find_unit("um")

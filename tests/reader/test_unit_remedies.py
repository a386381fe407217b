"""A wrong unit has a remedy, and what a message proposes is accepted where it stands and means the same."""

from __future__ import annotations

import random
import re

import pytest

from gudgeon.errors import InputError, InputErrors
from gudgeon.generator.mechanism import Mechanism
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.tree import evaluate

TEXT = """
format: gudgeon/1
name: m
parameters: {free: PARAMETER, w: 3 rad/s, L: 0.5 m}
bodies: {a: {length: LENGTH, mass: MASS, inertia: INERTIA}}
ground: {O: [0, 0]}
joints: {J: {revolute: [ground.O, a.tail]}}
drives: {D: {angle: a, value: "ANGLE"}}
forces:
  F: {torque: [ground, a], value: "TORQUE"}
  K: {spring_damper: [ground.O, a.head], stiffness: STIFFNESS, damping: DAMPING}
"""
RIGHT = {
    "PARAMETER": "1 m/s",
    "LENGTH": "1 m",
    "MASS": "1 kg",
    "INERTIA": "1 kg*m^2",
    "ANGLE": "1 rad/s * t",
    "TORQUE": "1 N*m",
    "STIFFNESS": "1 N/m",
    "DAMPING": "1 N*s/m",
}


def read(place: str, value: str) -> Mechanism:
    values = RIGHT | {place: value}
    return read_mechanism(re.sub("|".join(values), lambda found: values[found[0]], TEXT).encode(), "m.yaml")


def free(value: str) -> float:
    """The value of a parameter in SI."""
    return float(evaluate(read("PARAMETER", value).parameters["free"].value, lambda _: 0.0))


def hint_of(place: str, value: str) -> str:
    with pytest.raises(InputError) as caught:
        read(place, value)
    assert not isinstance(caught.value, InputErrors) and caught.value.where is not None
    return caught.value.hint


def proposed(hint: str, value: str) -> list[str]:
    """What a hint proposes to write in place of the number with its unit that `value` is or begins with."""
    number = re.match(r"[\d.]+(e-?\d+)?|pi", value)
    assert number is not None, value
    if found := re.fullmatch(r"write (.*?)(: they differ by 2\*pi)?", hint):
        return [one for one in found[1].split(" or ") if re.match(r"[(\d.]|pi", one)]
    if found := re.match(r"did you mean '(.*?)'\?", hint):
        return [found[1] if found[1][0].isdigit() else f"{number[0]} {found[1]}"]
    found = re.match(r"units that fit here: (.*)", hint)
    return [f"{number[0]} {one}" for one in found[1].split(", ")] if found else []


@pytest.mark.parametrize(
    ("value", "remedy", "si"),
    [
        ("36 km/h", "36 km/(60 min)", 10.0),
        ("3 µs", "3 us", 3e-6),
        ("3 1/h", "3/(60 min)", 3 / 3600),
        ("2 h", "120 min", 7200.0),
        ("3 s-1", "3 1/s", 3.0),
        ("3 kg m2", "3 kg*m^2", 3.0),
        ("3 m s⁻²", "3 m/s^2", 3.0),
        ("3 (m/s)^3", "3 m^3/s^3", 3.0),
        ("3 kg.m2/s2", "3 kg*m^2/s^2", 3.0),
        ("2 kph", "2 km/(60 min)", 2 / 3.6),
        ("90 °/sec", "90 deg/s", 1.5707963267948966),
        ("3 N-mm", "3 N*mm", 3e-3),
        ("2 mPas", "2 mPa*s", 2e-3),
        ("5 kN/µm^2", None, 5e15),
        ("2 daN", "20 N", 20.0),
        ("2pi", "2*pi", 6.283185307179586),
        ("4 m^10", "4 * (1 m)**10", 4.0),
        ("2 rpm^0.5", "2 * (1 rpm)**0.5", 2 * (3.141592653589793 / 30) ** 0.5),
        ("4 kg/m**3", "4 kg/m^3", 4.0),
        ("4 1/mm**3", "4 1/mm^3", 4e9),
        ("3 m**-1", "3 1/m", 3.0),
        ("3 per s", "3 1/s", 3.0),
        ("1 mile/hour", "1609.344 m/(60 min)", 0.44704),
        ("3 ns", "3e-9 s", 3e-9),
        ("3 m/ns", "3 m/(1E-9 s)", 3e9),
        ("3 MJ", "3000000 J", 3e6),
        ("3 KN", "3 kN", 3e3),
        ("3 g0", "29.41995 m/s^2", 29.41995),
        ("3 gn", "29.41995 m/s^2", 29.41995),
        ("3 g_0", "29.41995 m/s^2", 29.41995),
        ("3 kg*gn", "29.41995 kg*m/s^2", 29.41995),
        ("5 kg µm2", "5 kg*µm^2", 5e-12),
        ("30 U/min", "30 rev/min", 3.141592653589793),
    ],
)
def test_the_first_proposal_means_the_same(value: str, remedy: str | None, si: float) -> None:
    if remedy is not None:
        first = proposed(hint_of("PARAMETER", value), value)[0]
        assert first == remedy
        assert free(first) == pytest.approx(si, rel=1e-7)
    else:
        assert free(value) == pytest.approx(si, rel=1e-12)


@pytest.mark.parametrize(
    ("place", "wrong", "rest", "remedy"),
    [
        ("INERTIA", "3 kg*mm^", "", "3 kg*mm^2"),
        ("LENGTH", "3 µm^10", "", "3 µm"),
        ("TORQUE", "3 N^m", "", "3 N*m"),
        ("STIFFNESS", "3 kg/s^x", "", "3 kg/s^2"),
        ("DAMPING", "3 kg*s^", "", "3 kg/s"),
        ("TORQUE", "3 kg*m^2/s^3.7", "", "3 kg*m^2/s^2"),
        ("TORQUE", "2 kgf*m", "", "19.6133 N*m"),
        ("ANGLE", "2pi", "*t*1 rad/s", "2*pi"),
        ("ANGLE", "3 rad/sec", "*t", "3 rad/s"),
        ("ANGLE", "2w", "*t", "2*w"),
        ("INERTIA", "3 kg*m**2", "", "3 kg*m^2"),
    ],
)
def test_a_remedy_has_the_dimension_of_its_place(place: str, wrong: str, rest: str, remedy: str) -> None:
    found = proposed(hint_of(place, wrong + rest), wrong)
    assert found[0] == remedy
    for one in found:
        read(place, one + rest)


SYMBOLS = re.split(
    " ",
    "m mm µm µs s ms h hr min sec kg g t tonne lb N kN µN kgf lbf J Wh W hp Pa psi rad deg ° rpm"
    " Hz kHz rev foo Nm KG mpa MM mile yd dm in kph cSt Ohm",
)
POWERS = re.split(" ", "    ^2 ² 2 -1 ⁻¹ ^-2 **2 ^ ^x ^(1/2) ^1.3 ^10 **-1")  # some are empty


def test_a_prefix_is_read_before_another_case() -> None:
    """Newton seconds were proposed for 3 ns, grams and giganewtons for standard gravity, millijoules for 3 MJ."""
    for value in ("3 ns", "3 g0", "3 gn", "3 MJ"):
        assert len(proposed(hint_of("PARAMETER", value), value)) == 1, value


def wrong_unit(rng: random.Random) -> str:
    """A number with a unit that is not, or not quite, of the format."""
    unit = rng.choice(("", "", "", "1/", "(")) + rng.choice(SYMBOLS) + rng.choice(POWERS)
    for _ in range(rng.choice((0, 1, 1, 2))):
        between = ("*", "/", "/", " ", "·", " per ", " / ", *(".-" if unit[-1].isalpha() else ""))
        unit += rng.choice(between) + rng.choice(SYMBOLS)
        unit += rng.choice(POWERS)
    unit += rng.choice((")^2", ")^-1", ")^(1/2)")) if unit[0] == "(" else ""
    return rng.choice(("3", "0.5", "2e-3", "pi", "36")) + rng.choice((" ", " ", " ", "")) + unit


@pytest.mark.parametrize("seed", range(4))
def test_every_proposal_is_accepted(seed: int) -> None:
    rng, tried = random.Random(seed), 0
    for _ in range(80):
        place, value = rng.choice(list(RIGHT)), wrong_unit(rng)
        after = " * t" if place == "ANGLE" else ""
        if re.search("-1[*/]", value):  # the 1 may begin a quantity, too
            continue
        try:
            read(place, value + after)
        except InputErrors:
            continue
        except InputError as error:
            for one in proposed(error.hint, value):
                tried += 1
                read(place, one + after)  # whatever follows the number is its unit
    assert tried > 40

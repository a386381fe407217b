"""Every mistake has an error class and an exact place: the rows of `tests/mechanisms/invalid.py`."""

from __future__ import annotations

import re

import pytest

from gudgeon.errors import BadValueError, ExpressionError, InputError, Location
from gudgeon.generator.reader.read import read_mechanism
from tests.mechanisms.invalid import BASE, MISTAKES, Mistake


@pytest.mark.parametrize("mistake", MISTAKES, ids=[mistake.name for mistake in MISTAKES])
def test_mistake(mistake: Mistake) -> None:
    with pytest.raises(InputError) as caught:
        read_mechanism(mistake.data, mistake.file)
    error = caught.value
    assert type(error) is mistake.error  # one mistake, one error
    line, column = map(int, mistake.place.split(":"))
    assert error.where == Location(mistake.file, line, column)
    assert error.exit_code == 2
    assert str(error).startswith(f"{mistake.file}:{mistake.place}: ")
    assert mistake.message in str(error)
    assert re.search("expected|did you mean|write|use |there are no|indent|cannot be reached", str(error))


def test_the_file_without_a_patch_is_valid() -> None:
    assert read_mechanism(BASE.encode(), "base.yaml").name == "double_pendulum"


def test_each_mistake_has_its_own_name() -> None:
    assert len({mistake.name for mistake in MISTAKES}) == len(MISTAKES)


CONSTANT = """format: gudgeon/1
name: m
parameters: {{d: 0, e: 1, a: {value}}}
bodies: {{b: {{length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{A: {{revolute: [ground.O, b.tail]}}}}
drives: {{m: {{angle: b, value: 1 rad/s * t}}}}
"""


@pytest.mark.parametrize(
    "value",
    [
        "ramp(1, 0, 0)",
        "smooth_step(1 s, 0 s, 0 s)",
        "smooth_step(1, 0, d)",
        "smooth_step(1, 0, e-e)",
        "min(1/0, 1)",
        "max(1, log(0))",
        "where(sqrt(-1) < 1, 2, 3)",
        "1/(1/0)",
        "atan(1/d)",
        "exp(-1/d)",
        "sign(1/0)",
        "(1/0)**0",
        "smooth_step(1, 0, 1/0)",
        "2 - 3*atan(e + 1/d)",
        "where(e < 0, sqrt(-1), 3)",
        "where(e < 0, 1/0, 3)",
    ],
)
def test_a_constant_has_no_part_that_is_not_finite(value: str) -> None:
    """SymPy raised ValueError for extremes of 1/0, and the others had values such as atan(1/0) = pi/2."""
    with pytest.raises(BadValueError, match=r"m\.yaml:3:\d+: parameters\.a (has a part that )?is (-?inf|nan)"):
        read_mechanism(CONSTANT.format(value=value).encode(), "m.yaml")


@pytest.mark.parametrize("value", ["where(0 < d, 1/d, 7)", "smooth_step(1, 0, e)", "where(e < 2, atan(e), log(d))"])
def test_a_branch_that_is_not_picked_may_be_infinite(value: str) -> None:
    assert read_mechanism(CONSTANT.format(value=value).encode(), "m.yaml").parameters["a"]


@pytest.mark.parametrize("number", ["0." + "3" * 5000, "1" * 5000, "0" * 20 + "." + "1" * 5000 + "e-3 m"])
def test_a_number_has_at_most_so_many_characters(number: str) -> None:
    """Python raised ValueError from 4300 digits on."""
    with pytest.raises(ExpressionError, match=r"m\.yaml:3:\d+: "):
        read_mechanism(CONSTANT.format(value=number).encode(), "m.yaml")
    long = read_mechanism(CONSTANT.format(value="0." + "3" * 900).encode(), "m.yaml")
    assert long.parameters["a"]

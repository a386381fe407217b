"""The section `expressions:`: a name stands for its tree; what may not stand at a place may not by a name either."""

from __future__ import annotations

import re

import pytest

from gudgeon.errors import (
    BadNameError,
    CycleError,
    ExpressionError,
    InputError,
    LimitError,
    UnitError,
    UnknownNameError,
)
from gudgeon.generator.pipeline import generate
from gudgeon.generator.reader.expressions import DEEPEST, MOST
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.tree import names

LED = """\
format: gudgeon/1
name: led
gravity: [0, -9.81 m/s^2]
parameters: {reach: 2 rad, pace: 3 rad/s, K: 4 N*m*s, k: 2 1/s, h: 20 mm}
curves: {ease: {points: [[0, 0], [1, 1], [2, 1.5]], extrapolate: hold}}
expressions:
  s: rod.omega - rate + k*error
  error: rod.theta - target
  target: reach*sin(pace*t) * ease(t/(1 s))
  rate: reach*pace*cos(pace*t)
  lift: h*ease(t/(2 s))
bodies:
  rod: {length: 1 m, mass: 1 kg, inertia: auto}
  block: {mass: 1 kg, inertia: 1 kg*m^2}
ground: {O: [0, 0], P: [1 m, 0]}
joints:
  O: {revolute: [ground.O, rod.tail]}
  P: {translational: [ground.P, block.origin], axis: [0, 1]}
drives: {up: {coordinate: block.y, value: 2*lift}}
freedoms: 1
forces: {u: {torque: rod, value: -K*s}}
events: {met: {zero: error}}
outputs: {miss: error, both: error/2 + O.F * lift * 1 1/J}
"""
TARGET = "(reach*sin(pace*t) * ease(t/(1 s)))"
ERROR = f"(rod.theta - {TARGET})"
RATE = "(reach*pace*cos(pace*t))"
WRITTEN_OUT = {
    "-K*s": f"-K*(rod.omega - {RATE} + k*{ERROR})",
    "zero: error": f"zero: {ERROR}",
    "2*lift": "2*(h*ease(t/(2 s)))",
    "miss: error": f"miss: {ERROR}",
    "error/2 + O.F * lift": f"{ERROR}/2 + O.F * (h*ease(t/(2 s)))",
}


def written_out() -> str:
    text = re.sub(r"expressions:\n(  .*\n)+?(?=bodies)", "", LED)
    for name, tree in WRITTEN_OUT.items():
        assert text.count(name) == 1
        text = text.replace(name, tree)
    return text


def test_the_c_is_that_of_the_expressions_written_out() -> None:
    """Line by line, but for the two that tell which bytes it was made from."""
    named = generate(LED.encode(), "led.yaml", "ideal")
    plain = generate(written_out().encode(), "led.yaml", "ideal")
    assert named.files.keys() == plain.files.keys()
    different = [
        (name, a, b)
        for name in named.files
        for a, b in zip(named.files[name].splitlines(), plain.files[name].splitlines(), strict=True)
        if a != b and named.sha256 not in a and named.sha256[:12] not in a
    ]
    assert different == []
    assert named.outputs == plain.outputs and len(named.outputs) == 2


def test_a_name_is_one_tree_wherever_it_stands() -> None:
    mechanism = read_mechanism(LED.encode(), "led.yaml")
    error = mechanism.expressions["error"].value
    assert mechanism.outputs["miss"].value is error
    assert {name.path for name in names(mechanism.forces["u"].quantities["value"].value)} == {
        "K", "rod.omega", "reach", "pace", "t", "k", "rod.theta",
    }  # fmt: skip


MISTAKES: list[tuple[str, str, type[InputError], str, str]] = [  # text, instead, error, what it tells, at which text
    ("value: 2*lift", "value: h*error", ExpressionError, "'error' reads rod.theta", "error"),
    ("mass: 1 kg, inertia: auto", "mass: lift*1 kg, inertia: auto", ExpressionError, "this number is constant", "lift"),
    ("rate: reach*pace*cos(pace*t)", "rate: reach*cos(pace*t) + s", CycleError, "expressions defined through", ""),
    ("value: -K*s", "value: -K*rate*k", UnitError, "expected a torque", "-K*rate*k"),
    ("error: rod.theta - target", "error: rod.theta - 1 m", UnitError, "angle", "1 m"),
    ("error: rod.theta - target", "error: rod.thet - target", UnknownNameError, "theta", "thet - target"),
    ("error: rod.theta - target", "error: rod.theta - targt", UnknownNameError, "target", "targt"),
    ("error: rod.theta - target", "error: rod.alpha*(1 s)**2", ExpressionError, "follows from the forces", "rod.alpha"),
    ("  lift: h*", "  sin: t\n  lift: h*", BadNameError, "function", "sin: t"),
    ("  lift: h*", "  h: t\n  lift: h*", BadNameError, "a parameter", "h: t"),
    ("  lift: h*", "  ease: t\n  lift: h*", BadNameError, "a curve", "ease: t"),
    ("miss: error", "rate: error", BadNameError, "an output", ""),
    ("lift: h*ease(t/(2 s))", "lift: [1, 2]", InputError, "lift", "[1, 2]"),
    ("lift: h*ease(t/(2 s))", "lift: ", InputError, "no value", ""),
    ("lift: h*ease(t/(2 s))", "lift: h*ease(t/(2 s)", ExpressionError, "expected ')'", ""),
]  # fmt: skip


@pytest.mark.parametrize(("text", "by", "error", "told", "at"), MISTAKES)
def test_mistakes_are_told_where_they_are(text: str, by: str, error: type[InputError], told: str, at: str) -> None:
    assert LED.count(text) == 1
    wrong = LED.replace(text, by)
    with pytest.raises(InputError) as raised:
        read_mechanism(wrong.encode(), "led.yaml")
    assert isinstance(raised.value, error) and told in str(raised.value)  # alone: who uses the name is not told
    where = raised.value.where
    assert where is not None
    if at:
        assert wrong.splitlines()[where.line - 1][where.column - 1 :].startswith(at)


def chain(links: list[str]) -> str:
    text = "".join(f"  a{k + 1}: {link.format(f'a{k}')}\n" for k, link in enumerate(links))
    return LED.replace("  lift:", f"  a0: t/(1 s)\n{text}  last: a{len(links)}\n  lift:")


def test_what_names_hold_together_is_bounded() -> None:
    read_mechanism(chain(["sin({0})"] * (DEEPEST - 2)).encode(), "led.yaml")
    with pytest.raises(LimitError, match=f"expected at most {MOST} in {DEEPEST}"):
        read_mechanism(chain(["sin({0})"] * (DEEPEST - 1)).encode(), "led.yaml")
    with pytest.raises(LimitError, match=r"a10 has 4095 parts in 12 levels"):
        read_mechanism(chain(["{0}*{0}"] * 12 + ["{0} + {0}*1"]).encode(), "led.yaml")


@pytest.mark.slow
def test_the_deepest_and_the_largest_are_derived() -> None:
    """With their slopes, which Newton's matrix takes."""
    text = chain(["sin({0})"] * (DEEPEST - 3)).replace("value: -K*s", "value: -K*s*sin(last)")
    large = chain(["({0} + rod.theta)*{0}"] * 9).replace("value: -K*s", "value: -K*s*cos(last)")
    for one in (text, large):
        generate(one.encode(), "led.yaml", "ideal")

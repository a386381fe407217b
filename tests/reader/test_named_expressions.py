"""The section `expressions:`: a name stands for its tree; what may not stand at a place may not by a name either."""

from __future__ import annotations

import re

import numpy as np
import pytest

from gudgeon.commands.common import check_addresses
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import (
    BadNameError,
    BadValueError,
    CycleError,
    ExpressionError,
    InputError,
    InputErrors,
    LimitError,
    Location,
    UnitError,
    UnknownNameError,
)
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.reader.expressions import MAX_LEVELS, MAX_PARTS
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.tree import iterate_names
from gudgeon.model.file_expressions import explain_undefined_value_after
from gudgeon.model.parameters import explain_address
from tests.scenes import patched

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
    named = generate_kernel_source(LED.encode(), "led.yaml", "ideal")
    plain = generate_kernel_source(written_out().encode(), "led.yaml", "ideal")
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
    assert {name.path for name in iterate_names(mechanism.forces["u"].quantities["value"].value)} == {
        "K",
        "rod.omega",
        "reach",
        "pace",
        "t",
        "k",
        "rod.theta",
    }


MISTAKES: list[tuple[str, str, type[InputError], str, str]] = [  # text, instead, error, what it tells, at which text
    ("value: 2*lift", "value: h*error", ExpressionError, "'error' depends on rod.theta", "error"),
    (
        "mass: 1 kg, inertia: auto",
        "mass: lift*1 kg, inertia: auto",
        ExpressionError,
        "this number must be constant",
        "lift",
    ),
    ("rate: reach*pace*cos(pace*t)", "rate: reach*cos(pace*t) + s", CycleError, "expressions depend on each other", ""),
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
    (
        "error: rod.theta - target",
        "error: rod.theta - target/(K - K)",
        BadValueError,
        "expressions.error has a part that is inf, and forces.u.value and 3 more use it",
        "rod.theta",
    ),
    (
        "lift: h*ease(t/(2 s))",
        "lift: h*ease(pace/(-1 rad/s^1))*0 + h*sqrt(h - 30 mm)/sqrt(h)",
        BadValueError,
        "expressions.lift is nan, and drives.up.value and 1 more use it",
        "h*ease",
    ),
    (
        "k: 2 1/s",
        "k: 2 1/s + rate/(1 rad)",
        ExpressionError,
        "'rate' is a named expression, and this number",
        "rate/(1",
    ),
    ("lift: h*ease(t/(2 s))", "lift:", BadValueError, "expressions.lift has no value", ""),
]


@pytest.mark.parametrize(("text", "by", "error", "message", "at"), MISTAKES)
def test_mistakes_are_told_where_they_are(text: str, by: str, error: type[InputError], message: str, at: str) -> None:
    wrong = patched(LED, (text, by))
    with pytest.raises(InputError) as raised:
        read_mechanism(wrong.encode(), "led.yaml")
    assert isinstance(raised.value, error) and message in str(raised.value)  # alone: who uses the name is not told
    where = raised.value.where
    assert where is not None
    if at:
        assert wrong.splitlines()[where.line - 1][where.column - 1 :].startswith(at)


def test_every_cycle_is_told_and_a_long_one_is_cut() -> None:
    names = [f"a{k}" for k in range(40)]
    ring = "".join(f"  {name}: {after}\n" for name, after in zip(names, [*names[1:], names[0]], strict=True))
    with pytest.raises(InputErrors) as raised:
        read_mechanism(LED.replace("  lift:", f"{ring}  b: 2*c\n  c: b + 1\n  lift:").encode(), "led.yaml")
    assert [(type(e), e.message) for e in raised.value.errors] == [
        (CycleError, "expressions depend on each other: a0 → a1 → a2 → a3 → a4 → a5 → a6 → … (33 more) → a0"),
        (CycleError, "expressions depend on each other: b → c → b"),
    ]


def test_nothing_in_a_line_of_its_own_is_told_in_that_line() -> None:
    wrong = LED.replace("  lift: h*ease(t/(2 s))\n", "  lift:\n")
    with pytest.raises(BadValueError) as raised:
        read_mechanism(wrong.encode(), "led.yaml")
    where = raised.value.where
    assert where is not None
    assert wrong.splitlines()[where.line - 1] == "  lift:" and where.column == len("  lift:") + 1


def test_what_is_no_number_in_a_run_is_told_where_it_stands() -> None:
    bad = LED.replace("reach*sin(pace*t)", "sqrt(0.1 s - t)/sqrt(1 s)*reach*sin(pace*t)")
    source = generate_kernel_source(bad.encode(), "led.yaml", "ideal")
    p, n = np.array([slot.default for slot in source.parameters]), np.zeros(len(source.coordinates))
    place = re.escape(f"(line {line_of(bad, 'target:')}, column 11)")
    message = f"forces.u.value .* is not finite at t = 0.2 s, nan: in expressions.target {place}, sqrt of -0.1$"
    assert re.match(message, explain_undefined_value_after(source, p, 0.2, n, n))


def test_an_expression_is_no_number_that_can_be_set() -> None:
    source = KernelSource.from_json(generate_kernel_source(LED.encode(), "led.yaml", "ideal").to_json())
    for name in ("expressions.rate", "rate"):
        message, hint = explain_address(source, name)
        assert message == "expressions.rate is a compiled expression: it is not a parameter that can be set"
        assert hint.startswith("set its parameters: reach, pace;")
    with pytest.raises(UnknownNameError) as raised:
        check_addresses(["expressions.rate"], "led.yaml", [source])
    assert raised.value.where == Location("led.yaml", line_of(LED, "rate:"), 9)


def line_of(text: str, begins: str) -> int:
    return next(k for k, line in enumerate(text.splitlines(), 1) if line.strip().startswith(begins))


def chain(links: list[str]) -> str:
    text = "".join(f"  a{k + 1}: {link.format(f'a{k}')}\n" for k, link in enumerate(links))
    return LED.replace("  lift:", f"  a0: t/(1 s)\n{text}  last: a{len(links)}\n  lift:")


def test_what_names_hold_together_is_bounded() -> None:
    read_mechanism(chain(["sin({0})"] * (MAX_LEVELS - 2)).encode(), "led.yaml")
    with pytest.raises(LimitError, match=f"expected at most {MAX_PARTS} parts in {MAX_LEVELS} levels"):
        read_mechanism(chain(["sin({0})"] * (MAX_LEVELS - 1)).encode(), "led.yaml")
    with pytest.raises(LimitError, match=r"a10 has 4095 parts in 12 levels"):
        read_mechanism(chain(["{0}*{0}"] * 12 + ["{0} + {0}*1"]).encode(), "led.yaml")


@pytest.mark.slow
def test_the_deepest_and_the_largest_are_derived() -> None:
    """With their slopes, which Newton's matrix takes."""
    text = chain(["sin({0})"] * (MAX_LEVELS - 3)).replace("value: -K*s", "value: -K*s*sin(last)")
    large = chain(["({0} + rod.theta)*{0}"] * 9).replace("value: -K*s", "value: -K*s*cos(last)")
    for one in (text, large):
        generate_kernel_source(one.encode(), "led.yaml", "ideal")

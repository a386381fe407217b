"""Drives whose rate jumps, however that is written, and drives and forces that are no numbers at some time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import AssemblyError, NonFiniteError, SolverError

PAIR = """format: gudgeon/1
name: n
gravity: [0, -9.81 m/s^2]
bodies: {a: {length: 0.1 m, mass: 0.3 kg, inertia: 1e-3 kg*m^2}, b: {length: 0.2 m, mass: 0.3 kg, inertia: 2e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, a.tail]}, A: {revolute: [a.head, b.tail]}}
"""
ONE = "\n".join(["format: gudgeon/1", "name: n", "bodies: {a: {length: 1, mass: 1, inertia: 1}}", "ground: {O: [0, 0]}",
                 "joints: {O: {revolute: [ground.O, a.tail]}}", ""])  # fmt: skip


def driven(text: str, value: str, folder: Path) -> gudgeon.Simulation:
    file = folder / "driven.yaml"
    file.write_text(f'{text}drives: {{d: {{angle: a, value: "{value}"}}}}\n', encoding="utf-8")
    return gudgeon.load(file)


@pytest.mark.parametrize("value", ["hypot(t - 0.5 s, 0)", "((t - 0.5 s)**2)**0.5", "sqrt(t**2 - t * 1 s + 0.25 s^2)"])
def test_a_root_of_a_square_gives_the_impulse_of_abs(value: str, tmp_path: Path) -> None:
    ends = [
        driven(PAIR, f"5 rad/s * {of}", tmp_path).simulate(0.6, output=[0.4999, 0.5001, 0.6])["b.omega"]
        for of in ("abs(t - 0.5 s)", value)
    ]
    assert abs(ends[0][2] - ends[0][1]) > 1.0
    np.testing.assert_allclose(ends[1], ends[0], rtol=1e-7)


def test_a_jump_that_no_form_shows_ends_the_run_with_a_word(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match=r"drive d: its rate jumps by about 2 at t = 0\.5 s") as caught:
        driven(PAIR, "acos(cos(t / (1 s) - 0.5))", tmp_path).simulate(0.8, output=80)
    assert caught.value.partial.t[-1] == pytest.approx(0.49)


@pytest.mark.parametrize("value", ["min(2 rad/s * t, 0.8 + 0.3 rad/s * t)", "abs(t - 0.5137 s) * 9 rad/s"])
def test_the_work_of_a_jump_is_counted_where_nothing_is_free(value: str, tmp_path: Path) -> None:
    run = driven(ONE, value, tmp_path).simulate(1.0, output=100)
    assert run.diagnostics.method == "kinematic"
    assert run.diagnostics.energy_residual < 1e-9


@pytest.mark.parametrize(("value", "why"), [
    ("(0.5 - t/(1 s))**(1/3)", "the power 0.333"), ("log(0.5 - t/(1 s))", "log of 0"), ("asin(2*t/(1 s))", "asin of 1"),
])  # fmt: skip
def test_a_drive_that_is_no_number_is_named_with_its_time(value: str, why: str, tmp_path: Path) -> None:
    with pytest.raises(NonFiniteError, match=rf"drives\.d\.value \(line 6, column \d+\) is .* at t = 0\.5 s: {why}"):
        driven(ONE, value, tmp_path).simulate(1.0, output=10)


def test_at_the_start_too(tmp_path: Path) -> None:
    told = r"drives\.d\.value .* is not finite at t = 0 s, nan: the power 0\.333\d* of -0\.5"
    with pytest.raises(AssemblyError, match=told):
        driven(ONE, "(t/(1 s)-0.5)**(1/3)", tmp_path).simulate(1.0, output=10)

"""Dry friction whose slip jumps: by a jump of a drive's rate, or of a surface speed at which a run is resumed."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from scipy.optimize import brentq

import gudgeon
from tests.programs import needs_compiler

pytestmark = needs_compiler
PLATE = """
format: gudgeon/1
name: plate
parameters: {before: 0 m/s, after: 0.1 m/s}
bodies: {plate: {mass: 1 kg, inertia: 1e-3 kg*m^2}, block: {mass: 1 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints:
  guide: {translational: [ground.O, plate.origin], axis: [1, 0], angle: 0}
  slide: {translational: [GUIDE, block.origin], axis: [1, 0], angle: 0}
drives: {shake: {coordinate: plate.x, value: "before*t + (after - before)*max(t - 0.1 s, 0 s)"}}
forces: {rub: {dry_friction: [plate.origin, block.origin], direction: [1, 0], static: 3 N, kinetic: 2 N}}
start: {set: {block.x: 0.1 m}, rates: {block.vx: before}}
"""
METHODS: list[tuple[str, dict[str, Any]]] = [("dop853", {}), ("rk4", {"step": 1e-4}), ("rodas5p", {})]


@pytest.mark.parametrize("guide", ["plate.origin", "ground.O"])
def test_a_block_slips_after_a_jump_of_its_plate(guide: str, tmp_path: Path) -> None:
    """It sticks until t = 0.1 s, slips with the acceleration 2 m/s², sticks again; also at small jumps of the speed."""
    (tmp_path / "plate.yaml").write_text(PLATE.replace("GUIDE", guide), encoding="utf-8")
    scene = gudgeon.load(tmp_path / "plate.yaml")
    for before, after in ((0.0, 0.1), (0.0, 0.01), (0.05, -0.05), (0.05, 0.0501), (0.1, 0.0)):
        t_slip, a = 0.5 * abs(after - before), math.copysign(2.0, after - before)
        x = 0.1 + before * 0.1 + before * t_slip + 0.5 * a * t_slip**2 + after * (0.2 - t_slip)
        for method, options in METHODS:
            run = scene.simulate(
                0.3, output=30, method=method, parameters={"before": before, "after": after}, **options
            )
            assert run["block.x"][-1] == pytest.approx(x, abs=1e-11), (before, after, method)


@pytest.mark.parametrize("speed", [0.1001, 0.11, 0.2, 0.09, 0.05])
def test_a_block_slips_where_a_run_is_resumed_with_another_belt_speed(speed: float) -> None:
    """On a spring, x = x_f + a cos(ω t) + b sin(ω t) with the kinetic force, until it has the belt's speed."""
    scene = gudgeon.load("belt_block")
    first = scene.simulate(0.1)
    assert first["rub.mode"][-1] == 0.0
    x, v = float(first["block.x"][-1]), float(first["block.vx"][-1])
    omega, x_f = 10.0, math.copysign(3.924, speed - v) / 100.0
    a, b = x - x_f, v / omega

    def relative_speed(t: float) -> float:
        return omega * (b * math.cos(omega * t) - a * math.sin(omega * t)) - speed

    sticks = relative_speed(0.0) * relative_speed(0.005) < 0.0
    t_slip = brentq(relative_speed, 0.0, 0.005, xtol=1e-15) if sticks else 0.005
    expected = x_f + a * math.cos(omega * t_slip) + b * math.sin(omega * t_slip) + speed * (0.005 - t_slip)
    second = scene.simulate(0.105, start=first.final, parameters={"belt_speed": speed}, output=4)
    assert second["block.x"][-1] == pytest.approx(expected, abs=1e-10)

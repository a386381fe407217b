"""Bounces of surfaces that do not give end closed with the force m g, however small the threshold is."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
BALL = """\
gravity: [0, -9.81 m/s^2]
parameters: {h: 0.1 m, en: 0.8, v0: 1e-4}
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies: {ball: {mass: 0.1 kg, inertia: 1e-5 kg*m^2}}
ground: {release: [0, 0]}
joints: {fall: {revolute: [ground.release, ball.origin]}}
bearings:
  floor: {radius: h + 14 mm, clearance: h, length: 10 mm, bearing_material: steel, journal_material: steel}
contacts: {hard: {normal: {law: newton_restitution, restitution: en, threshold: v0 * 1 m/s}}}
start: {play: {fall: {e: [0, 0], rate: [0, 0]}}}
scenes: {hard: {play: {fall: {bearing: floor, contact: hard}}}}
"""


@pytest.mark.parametrize(
    "h, e, g, v0",
    [
        (1e-3, 0.5, 9.81, 1e-8),
        (1e-3, 0.5, 9.81, 1e-13),
        (1e-4, 0.9, 1e5, 1e-4),
        (1e-4, 0.9, 1e6, 1e-4),
        (0.3, 0.99, 1e6, 1e-6),
        (1e-6, 0.95, 0.01, 1e-9),
        (0.1, 0.8, 9.81, 1e-4),
    ],
)
def test_bounces_pile_up_to_a_closed_contact(tmp_path: Path, h: float, e: float, g: float, v0: float) -> None:
    """After falls of g, heights e² times as high each, and speeds that are no larger than v0, or rounding."""
    ball = loader(tmp_path)(BALL, "hard")
    fall = math.sqrt(2.0 * h / g)
    t_end = 1.1 * fall * (1.0 + 2.0 * e / (1.0 - e))
    run = ball.simulate(t_end, output=50, parameters={"h": h, "en": e, "v0": v0, "gravity.y": -g})
    assert run["fall.F"][-1] == pytest.approx(0.1 * g, rel=1e-9)
    bounces = math.log(v0 / math.sqrt(2.0 * g * h)) / math.log(e)  # the last one of which is slower than v0
    assert len(run.impacts["t_on"]) <= 1.02 * bounces + 3

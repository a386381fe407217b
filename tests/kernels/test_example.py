"""Example: a function of a scene is evaluated by NumPy and compared with a formula on paper."""

from __future__ import annotations

import numpy as np
import pytest

from gudgeon.generator.pipeline import derive_scene

FALLING = b"""
format: gudgeon/1
name: falling
gravity: [0, -10 m/s^2]
bodies: {stone: {mass: 2 kg, inertia: 3 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, stone.origin], axis: [0, 1]}}
"""


def test_a_body_on_a_vertical_rail_falls_freely() -> None:
    """The x axis of the body lies along the rail."""
    model = derive_scene(FALLING, "falling.yaml", "ideal").numpy()
    q, v = np.array([0.0, -1.0, np.pi / 2]), np.array([0.0, 3.0, 0.0])
    assert model.dynamics(0.0, q, v, model.prepare()).a == pytest.approx([0.0, -10.0, 0.0])

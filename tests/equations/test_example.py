"""Example: a derived expression is compared with a formula on paper, as SymPy expressions."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.pipeline import derive_scene

DISC = b"""
format: gudgeon/1
name: disc
bodies: {disc: {mass: 2 kg, inertia: 3 kg*m^2}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, disc.origin]}}
"""


def test_rows_of_a_pin() -> None:
    """Phi = (x, y) of the pin, so Phi_q = (I 0)."""
    model = derive_scene(DISC, "disc.yaml", "ideal")
    x, y, theta = model.q
    phi = sp.Matrix([row.phi for row in model.all_rows])
    assert phi.jacobian([x, y, theta]) in (sp.Matrix([[1, 0, 0], [0, 1, 0]]), sp.Matrix([[-1, 0, 0], [0, -1, 0]]))

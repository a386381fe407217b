"""Runs that begin, or go on, where a film does not act yet: deep in the metal, beyond the transition."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = [needs_compiler, pytest.mark.plain]
BALL = """
format: gudgeon/1
name: film
gravity: [0, -9.81]
materials: {steel: {E: 207 GPa, nu: 0.3}}
parameters: {ey: -0.304 mm, vy: 0, e0: 0.01 mm, mu: 0.01 Pa*s}
bodies: {ball: {mass: 0.4 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {a: {revolute: [ground.O, ball.origin]}}
bearings:
  pin: {radius: 10 mm, clearance: 0.3 mm, length: 20 mm, bearing_material: steel, journal_material: steel}
contacts:
  oil:
    normal: {law: hunt_crossley, stiffness: 1e10, restitution: 0.6}
    film: {law: pinkus_sternlicht, viscosity: mu}
    transition: e0
start: {play: {a: {e: [0, ey], rate: [0, vy]}}}
scenes: {oil: {play: {a: {bearing: pin, contact: oil}}, simulate: {t_end: 2 ms, output: 20}}}
"""


@pytest.fixture(scope="module")
def ball(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    file = tmp_path_factory.mktemp("film") / "film.yaml"
    file.write_text(BALL, encoding="utf-8")
    return gudgeon.load(file, "oil")


@pytest.mark.parametrize("method", slow_but(["auto", "dop853"], ["auto", "dop853", "scipy:Radau"]))
def test_out_of_the_metal_into_the_film(method: str, ball: Simulation) -> None:
    """The cap of ε was held as it was never looked at: no number, when the film began to act. rk4 holds nothing."""
    for ey in ("-0.312 mm", "-0.315 mm"):
        fixed = ball.simulate(1e-3, output=10, parameters={"ey": ey}, method="rk4", step=1e-7)
        run = ball.simulate(1e-3, output=10, parameters={"ey": ey}, method=method)
        np.testing.assert_allclose(run["ball.vy"], fixed["ball.vy"], rtol=2e-4, atol=2e-5)


def test_a_run_cut_in_the_metal_goes_on(ball: Simulation) -> None:
    """Thrown through a film of nearly no oil; both cuts lie beyond c + e0."""
    thrown: dict[str, Any] = {"ey": 0.0, "vy": -1.0, "mu": 1e-6, "e0": "0.002 mm"}
    whole = ball.simulate(2e-3, parameters=thrown)
    for cut in (3.5e-4, 4.5e-4):
        first = ball.simulate(cut, parameters=thrown)
        assert first["a.e"][-1] > 0.302e-3
        for method in ("auto", "dop853"):
            run = ball.simulate(2e-3, start=first.final, method=method, output=2)
            assert run["ball.vy"][-1] == pytest.approx(whole["ball.vy"][-1], rel=2e-6)

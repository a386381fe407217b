"""Starts far from the origin, for so a drive, the start's set or its guess asks: in C and in Python."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.assembly import linkage, start
from gudgeon.assembly.closure import AssemblyProblem
from gudgeon.assembly.start import search_start
from gudgeon.errors import AssemblyError, SingularError
from gudgeon.model.parameters import compute_parameter_values
from tests.scenes import loader

CART = """
parameters: {{x: {x} m}}
bodies:
  cart: {{mass: 1 kg, inertia: 1e-3 kg*m^2}}
{bob}
ground: {{O: [0, 0]}}
joints:
  rail: {{translational: [ground.O, cart.origin], axis: [1, 0]}}
{pin}
{ask}
"""
BOB = "  bob: {length: 0.4 m, mass: 0.5 kg, inertia: 7e-3 kg*m^2}"
PIN = "  pin: {revolute: [cart.origin, bob.tail]}"
ASKS = (
    'drives: {push: {coordinate: cart.x, value: "x + t*1 m/s"}}',
    "start: {set: {cart.x: x}}",
    "start: {guess: {cart.x: x}}",
)


@pytest.mark.parametrize("hangs", [pytest.param(False, marks=pytest.mark.slow), True])
@pytest.mark.parametrize("ask", ASKS)
@pytest.mark.parametrize(
    ("written", "x"),
    [
        (-1e3, -1e3),
        (-1e3, 1e5),
        (-1e3, 1e8),
        *(pytest.param(x, x, marks=pytest.mark.slow) for x in (1e5, 1e8)),
    ],
)
def test_a_start_far_away_assembles(written: float, x: float, ask: str, hangs: bool, tmp_path: Path) -> None:
    """1000 m was too far for a cart without a length: it was said that a row stays open, by 0."""
    text, given = CART.format(x=written, bob=BOB * hangs, pin=PIN * hangs, ask=ask), {"x": x}
    simulation, near = loader(tmp_path)(text), 1e-7 if "guess" in ask else 1e-14  # a guess is no more than one
    for scene in (simulation, simulation.full):
        compiled, p = scene.compiled, compute_parameter_values(scene.compiled, given)[0]
        assert compiled.close_linkage(0.0, p, linkage.compute_mechanism_size(compiled, p)) is not None
        found, sought = start.assemble_start(compiled, p), search_start(compiled, p)
        assert found.q[0] == pytest.approx(x, rel=near)
        assert sought.q == pytest.approx(found.q, rel=near, abs=1e-7)
        assert sought.v == pytest.approx(found.v, rel=1e-9, abs=1e-9)
    run = simulation.simulate(0.1, output=1, parameters=given)
    assert np.isfinite(run.q).all() and run["cart.x"][0] == pytest.approx(x, rel=near)


def test_what_cannot_be_met_far_away_is_told(tmp_path: Path) -> None:
    ask = 'drives: {push: {coordinate: cart.x, value: "1000 m"}}\nstart: {set: {cart.x: 999 m}}'
    with pytest.raises(
        AssemblyError, match=r"cannot be assembled: constraint equations set cart.x .500 mm., push .-500 mm, line 12."
    ):
        loader(tmp_path)(CART.format(x=0, bob="", pin="", ask=ask)).start()


ENGINE = """
bodies:
  crank: {{length: 0.05 m, mass: {mass} kg, inertia: 1e-4 kg*m^2}}
  rod: {{length: 0.12 m, mass: 0.2 kg, inertia: 1e-4 kg*m^2}}
  piston: {{mass: 0.1 kg, inertia: 1e-4 kg*m^2}}
ground: {{O: [0, 0]}}
joints:
  shaft: {{revolute: [ground.O, crank.tail]}}
  crankpin: {{revolute: [crank.head, rod.tail]}}
  wristpin: {{revolute: [rod.head, piston.origin]}}
  cylinder: {{translational: [ground.O, piston.origin], axis: [1, 0]}}
drives: {{motor: {{angle: crank, value: 30 deg + 10 rad/s * t}}}}
start: {{guess: {{piston.x: 0.16 m}}}}
"""


def test_masses_that_no_double_holds_together_are_told(tmp_path: Path) -> None:
    """Velocities at the start are those of least energy: with 1e20 kg beside 0.1 a dead centre was told of a drive."""
    angle, r, rod = np.pi / 6, 0.05, 0.12
    speed = -10.0 * r * np.sin(angle) * (1.0 + r * np.cos(angle) / np.sqrt(rod**2 - (r * np.sin(angle)) ** 2))
    heavy, heaviest = (loader(tmp_path)(ENGINE.format(mass=mass)) for mass in (1e10, 1e20))
    assert [each.start().v[6] for each in (heavy, heaviest)] == pytest.approx([speed, speed], rel=1e-9)
    heavier = r"rod \(1e\+100 .* and crank"
    with pytest.raises(AssemblyError, match=rf"the inertias of {heavier}.*have too large a ratio"):
        heavy.start({"bodies.crank.mass": 1.0, "bodies.rod.inertia": 1e100})
    p = compute_parameter_values(heavy.compiled, {"bodies.crank.mass": 1.0, "bodies.rod.inertia": 1e-20})[0]
    with pytest.raises(SingularError, match=r"(?s)vanished.*the inertias of crank .* and rod .* too large a ratio"):
        heavy.compiled.check_pivot(1, 0.0, p=p)


@pytest.mark.parametrize("l5", [0.1, 0.15, 0.45, 0.6, 0.8])
def test_the_nearest_configuration_of_random_starts_is_that_of_a_search_in_python(
    l5: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Lengths at which the press begins far from its guess, or cannot close: C closes the random starts, or Python."""
    simulation = gudgeon.load("nine_bar_press", "ideal")
    p = compute_parameter_values(simulation.compiled, {"l5": l5})[0]
    by_c = AssemblyProblem(simulation.compiled, p, 0.0).find_nearest_configuration()
    monkeypatch.setattr(type(simulation.compiled), "close_configuration", lambda *_: None)
    by_python = AssemblyProblem(simulation.compiled, p, 0.0).find_nearest_configuration()
    assert by_c[1] == by_python[1]
    if by_c[1]:
        np.testing.assert_allclose(by_c[0], by_python[0], atol=1e-9)

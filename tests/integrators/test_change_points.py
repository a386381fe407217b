"""Driven linkages that pass a change point, where two branches meet: on the smooth one, on every grid.

A parallelogram has r.theta = c.theta; beyond links in one line it might go on as an antiparallelogram as well.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gudgeon
from gudgeon.errors import SingularError
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
PARALLELOGRAM = """format: gudgeon/1
name: parallelogram
parameters: {s: 1 s, w: %(w)s}
bodies: {c: {length: %(a)s m%(mass)s}, k: {length: %(d)s m%(mass)s}, r: {length: %(a)s m%(mass)s}}
ground: {A: [0, 0], D: [%(d)s m, 0]}
joints:
  A: {revolute: [ground.A, c.tail]}
  B: {revolute: [c.head, k.tail]}
  C: {revolute: [k.head, r.head]}
  D: {revolute: [ground.D, r.tail]}
drives: {m: {angle: c, value: %(value)s}}
start: {%(rates)sguess: {k.theta: 0, r.theta: %(begin)s deg}}
"""
FREE = """format: gudgeon/1
name: free
gravity: [0, -9.81]
bodies:
  a: {length: 100 mm, mass: 0.3 kg, inertia: 3e-4 kg*m^2}
  b: {length: 200 mm, mass: 0.5 kg, inertia: 2e-3 kg*m^2}
  d: {length: 100 mm, mass: 0.3 kg, inertia: 3e-4 kg*m^2}
ground: {A: [0, 0], D: [200 mm, 0]}
joints:
  A: {revolute: [ground.A, a.tail]}
  B: {revolute: [a.head, b.tail]}
  C: {revolute: [b.head, d.head]}
  D: {revolute: [ground.D, d.tail]}
start: {set: {a.theta: 60 deg}, guess: {b.theta: 0, d.theta: 60 deg}, rates: {a.omega: 20}}
"""
MASS = ", mass: 1 kg, inertia: 0.02 kg*m^2"
FORMULATIONS = slow_but(("reduced",), ("reduced", "full"))


def load(
    tmp_path: Path,
    value: str = "40 deg + 360 deg/s*t",
    begin: float = 40.0,
    rates: str = "",
    mass: str = "",
    a: float = 0.35,
    d: float = 0.9,
    formulation: str = "reduced",
    more: str = "",
) -> gudgeon.Simulation:
    numbers = {"value": value, "begin": begin, "rates": rates, "mass": mass, "a": a, "d": d, "w": 1.0}
    file = tmp_path / "parallelogram.yaml"
    file.write_text(PARALLELOGRAM % numbers + more, encoding="utf-8")
    return gudgeon.load(file, formulation=formulation)


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("n", [18, 36, 90, 359, 360, 361, 500, 720, 1000])
def test_a_parallelogram_on_every_grid(tmp_path: Path, n: int, formulation: str) -> None:
    """Samples at 180° and 360° are as exact as their neighbours."""
    run = load(tmp_path, formulation=formulation).simulate(1.0, output=n)
    assert np.abs(run["r.theta"] - run["c.theta"]).max() < 1e-12
    assert np.abs(run["r.omega"] - run["c.omega"]).max() < 1e-7
    assert np.abs(run["r.alpha"] - run["c.alpha"]).max() < 1e-3
    assert run.diagnostics.phi_max < 1e-13


@pytest.mark.parametrize("seed", range(4))
def test_random_parallelograms(tmp_path: Path, seed: int) -> None:
    """Other lengths, speeds that change, works, events: the mass makes the drive do work."""
    rng = np.random.default_rng(seed)
    a, more = float(rng.uniform(0.1, 0.5)), "events: {e: {zero: r.theta - 200 deg}}\ngravity: [0, -9.81]\n"
    value = "150 deg + 40 deg/s*t + 20 deg*(t/s)**2" if seed % 2 else "150 deg + 60 deg/s*t"
    run = load(tmp_path, value, 150.0, "", MASS, a, a + float(rng.uniform(0.1, 1.0)), more=more).simulate(
        1.0, output=60
    )
    assert np.abs(run["r.theta"] - run["c.theta"]).max() < 1e-12
    assert run.diagnostics.energy_residual < 1e-7
    assert len(run.events) == 1


def test_forces_at_a_change_point_are_noted(tmp_path: Path) -> None:
    scene = load(tmp_path, mass=MASS)
    specified = [[x for x in scene.simulate(1.0, output=n).diagnostics.notes if "change point" in x] for n in (36, 37)]
    assert "2 samples" in specified[0][0] and "t = 0.388888889 s" in specified[0][0]
    assert not specified[1]


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_start_at_a_change_point_names_its_branches(tmp_path: Path, formulation: str) -> None:
    """Each rate that it names is accepted, and leads on along its branch."""
    value = "180 deg + 360 deg/s*t"
    with pytest.raises(SingularError, match="two branches") as error:
        load(tmp_path, value, 180.0, formulation=formulation).simulate(0.4, output=40)
    rates = sorted(float(x) for x in re.findall(r"r\.omega = (\S+) rad/s", str(error.value)))
    crank, coupler = 0.35, 0.9
    assert np.allclose(rates, [-2.0 * math.pi * (coupler - crank) / (coupler + crank), 2.0 * math.pi], rtol=1e-5)
    for rate in rates:
        given = f"rates: {{r.omega: {rate} rad/s^1}}, "
        run = load(tmp_path, value, 180.0, given, formulation=formulation).simulate(0.4, output=40)
        closed = np.hypot(
            0.9 + 0.35 * np.cos(run["r.theta"]) - 0.35 * np.cos(run["c.theta"]),
            0.35 * np.sin(run["r.theta"]) - 0.35 * np.sin(run["c.theta"]),
        )
        assert np.abs(closed - 0.9).max() < 1e-12
        assert (np.diff(run["r.theta"]) * rate > 0.0).all()
        assert (np.abs(run["r.theta"] - run["c.theta"]).max() < 1e-12) == (rate > 0.0)


def test_a_dead_centre_has_no_branches(tmp_path: Path) -> None:
    """The crank of a linkage that reaches no further."""
    text = (
        (
            PARALLELOGRAM
            % {"value": "40 deg + 360 deg/s*t", "begin": 40, "rates": "", "mass": "", "a": 0.35, "d": 0.9, "w": 1}
        )
        .replace("r: {length: 0.35", "r: {length: 0.3")
        .replace("k: {length: 0.9", "k: {length: 0.85")
    )  # noqa: E501
    file = tmp_path / "dead.yaml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(SingularError, match="dead centre") as error:
        gudgeon.load(file).simulate(1.0, output=36)
    assert "branches" not in str(error.value)


@pytest.mark.parametrize("method", ["auto", "radau5", "radau9", "rodas5p"])
def test_a_free_parallelogram_passes_change_points_by_every_method(tmp_path: Path, method: str) -> None:
    """One freedom with a closed equation of motion: I omega' = -m g cos theta, over seven half turns.

    Near links in one line the Jacobian of the reduced equations is large, and filters Radau's estimate of the error.
    """
    file = tmp_path / "free.yaml"
    file.write_text(FREE, encoding="utf-8")
    run = gudgeon.load(file).simulate(1.0, method=method, rtol=1e-8, output=100)
    inertia, moment = 2.0 * (3e-4 + 0.3 * 0.05**2) + 0.5 * 0.1**2, (0.3 * 0.1 + 0.5 * 0.1) * 9.81
    exact = solve_ivp(
        lambda t, y: [y[1], -moment * np.cos(y[0]) / inertia],
        (0.0, 1.0),
        [np.pi / 3.0, 20.0],
        method="DOP853",
        rtol=1e-13,
        atol=1e-13,
        t_eval=run.t,
    )
    assert run["a.theta"] == pytest.approx(exact.y[0], abs=1e-5)

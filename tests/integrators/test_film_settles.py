"""A rotor on a film: where it settles under a constant load, how it whirls, and from which mass on it does for ever."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq

import gudgeon
from gudgeon.generator.kinds.laws.law import find_laws_of_role
from gudgeon.model.parameters import compute_parameter_values
from gudgeon.reynolds import Bearing
from gudgeon.reynolds.deviations import make_law_force
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
ROTOR = """
format: gudgeon/1
name: rotor
materials: {{steel: {{E: 207 GPa, nu: 0.3}}}}
parameters: {{omega: 200 rad/s, mass: 2 kg, load: 900 N, x: 0.01 mm, y: -0.015 mm}}
bodies: {{rotor: {{mass: mass, inertia: 1 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{a: {{revolute: [ground.O, rotor.origin]}}}}
forces: {{weight: {{force: rotor.origin, value: [0, -load]}}}}
drives: {{spin: {{angle: rotor, value: omega*t}}}}
bearings:
  pin: {{radius: 10 mm, clearance: 0.03 mm, length: 8 mm, bearing_material: steel, journal_material: steel}}
contacts: {{oil: {{film: {{law: {law}, viscosity: 0.05 Pa*s}}}}}}
start: {{play: {{a: {{e: [x, y], rate: [0, 0]}}}}}}
scenes: {{oil: {{play: {{a: {{bearing: pin, contact: oil}}}}, simulate: {{t_end: 1 s, output: 20}}}}}}
"""
C, OMEGA, LENGTH, VISCOSITY = 0.03e-3, 200.0, 8e-3, 0.05
RADIUS = 10e-3 - C
Rotor = Callable[[str], Simulation]


@pytest.fixture(scope="module")
def rotor(tmp_path_factory: pytest.TempPathFactory) -> Rotor:
    folder = tmp_path_factory.mktemp("rotor")

    def load(law: str) -> Simulation:
        file = folder / f"{law}.yaml"
        file.write_text(ROTOR.format(law=law), encoding="utf-8")
        return gudgeon.load(file, "oil")

    return cache(load)


def long_film(eps: float) -> tuple[float, float]:
    """Steady half film without leakage at the sides (physics.md, section 4), N."""
    unit, root = VISCOSITY * RADIUS**3 * LENGTH / C**2 * OMEGA, np.sqrt(1.0 - eps**2)
    return -12.0 * unit * eps**2 / ((2.0 + eps**2) * root**2), 6.0 * np.pi * unit * eps / ((2.0 + eps**2) * root)


def short_film(eps: float) -> tuple[float, float]:
    """Ocvirk's steady half film, N."""
    unit, square = VISCOSITY * RADIUS * LENGTH**3 / C**2 * OMEGA, 1.0 - eps**2
    return -unit * eps**2 / square**2, np.pi * unit * eps / (4.0 * square**1.5)


def fitted(law: str) -> Callable[[float], tuple[float, float]]:
    """Of a law without a closed form at rest: its own force there."""
    force = make_law_force(law, Bearing(RADIUS, LENGTH, C, VISCOSITY), {})

    def steady(eps: float) -> tuple[float, float]:
        radial, tangential = force(*(np.array([x]) for x in (eps, 0.0, -0.5 * eps * OMEGA)))[0]
        return float(radial), float(tangential)

    return steady


STEADY = {"pinkus_sternlicht": long_film, "ocvirk": short_film}


def equilibrium(steady: Callable[[float], tuple[float, float]], load: float) -> tuple[float, np.ndarray]:
    """ε that carries the load, and where the journal is then, m."""
    eps = float(brentq(lambda x: np.hypot(*steady(x)) - load, 1e-3, 0.99, xtol=1e-15))
    radial, tangential = steady(eps)  # on the journal: radial n + tangential t = (0, load)
    return eps, C * eps * np.array([tangential, radial]) / load


@pytest.mark.parametrize("load", [300.0, pytest.param(900.0, marks=pytest.mark.slow)])
@pytest.mark.parametrize("law", sorted(find_laws_of_role("film")))
def test_eccentricity_and_attitude_under_a_constant_load(rotor: Rotor, law: str, load: float) -> None:
    eps, place = equilibrium(STEADY.get(law) or fitted(law), load)
    mass = min(2.0, 2e-5 * load / C / OMEGA**2)  # light enough to be at rest in the end
    run = rotor(law).simulate(1.0, output=20, method="rodas5p", rtol=1e-9, parameters={"load": load, "mass": mass})
    at = np.array([run["rotor.x"][-1], run["rotor.y"][-1]])
    assert np.hypot(*at) / C == pytest.approx(eps, rel=1e-6)
    assert np.arctan2(at[1], at[0]) == pytest.approx(np.arctan2(place[1], place[0]), abs=1e-6)


def textbook(eps: float, load: float) -> tuple[np.ndarray, np.ndarray]:
    """K (N/m) and C (N·s/m) of the short half film, the load along −y, turning as ω > 0 does.

    M. I. Friswell, J. E. T. Penny, S. D. Garvey, A. W. Lees, Dynamics of Rotating Machines, Cambridge (2010), 5.5.
    """
    square, two = 1.0 - eps**2, np.pi**2
    h = 1.0 / (two * square + 16.0 * eps**2) ** 1.5
    a_xx, a_yy = (
        4.0 * (two * (2.0 - eps**2) + 16.0 * eps**2),
        4.0 * (two * (1.0 + 2.0 * eps**2) + 32.0 * eps**2 * (1.0 + eps**2) / square),
    )
    a_xy = np.pi * (two * square**2 - 16.0 * eps**4) / (eps * np.sqrt(square))
    a_yx = -np.pi * (two * square * (1.0 + 2.0 * eps**2) + 32.0 * eps**2 * (1.0 + eps**2)) / (eps * np.sqrt(square))
    b_xx = 2.0 * np.pi * np.sqrt(square) * (two * (1.0 + 2.0 * eps**2) - 16.0 * eps**2) / eps
    b_xy = -8.0 * (two * (1.0 + 2.0 * eps**2) - 16.0 * eps**2)
    b_yy = 2.0 * np.pi * (two * square**2 + 48.0 * eps**2) / (eps * np.sqrt(square))
    stiffness, damping = np.array([[a_xx, a_xy], [a_yx, a_yy]]), np.array([[b_xx, b_xy], [b_xy, b_yy]])
    return h * load / C * stiffness, h * load / (C * OMEGA) * damping


def eigenvalues(mass: float, stiffness: np.ndarray, damping: np.ndarray) -> np.ndarray:
    below = np.hstack([-stiffness / mass, -damping / mass])
    return np.sort_complex(np.linalg.eigvals(np.vstack([np.hstack([np.zeros((2, 2)), np.eye(2)]), below])))


def limit(load: float) -> tuple[float, complex]:
    """The largest mass (kg) that the film of this load holds at rest, and its eigenvalue there, 1/s."""
    film = textbook(equilibrium(short_film, load)[0], load)
    critical = float(brentq(lambda m: eigenvalues(m, *film).real.max(), 1e-4, 1e6, xtol=1e-12))
    found = eigenvalues(critical, *film)
    return critical, complex(found[np.argmax(found.real + 1e-9 * found.imag)])


@pytest.mark.parametrize("load", [5.0, 20.0, 60.0])
def test_the_linearized_rotor_is_the_textbooks(rotor: Rotor, load: float) -> None:
    """K, C and eigenvalues of the exact Jacobian where the rotor rests."""
    eps, place = equilibrium(short_film, load)
    mass, (stiffness, damping) = limit(load)[0], textbook(eps, load)
    full, y = rotor("ocvirk").full, np.array([*place, 0.0, 0.0, 0.0, OMEGA])
    J = full.compiled.jacobian(0.0, y, compute_parameter_values(full.compiled, {"load": load, "mass": mass})[0])[0]
    for columns, want in ((slice(0, 2), stiffness), (slice(3, 5), damping)):
        np.testing.assert_allclose(-mass * J[3:5, columns], want, rtol=0, atol=1e-9 * abs(want).max())


def whirl(rotor: Rotor, load: float, mass: float, turns: int, nudge: float) -> tuple[np.ndarray, np.ndarray]:
    """From beside its place of rest: t (n,) and the way from there (2, n) in shares of c."""
    _, place = equilibrium(short_film, load)
    start = {"load": load, "mass": mass, "x": float(place[0] + nudge * C), "y": float(place[1])}
    run = rotor("ocvirk").simulate(
        turns * 2.0 * np.pi / OMEGA, output=40 * turns, method="rodas5p", rtol=1e-9, parameters=start
    )
    return run.t, np.stack([run["rotor.x"] - place[0], run["rotor.y"] - place[1]]) / C


@pytest.mark.parametrize("load", [5.0, 20.0, 60.0])
def test_the_limit_of_stability_is_the_textbooks(rotor: Rotor, load: float) -> None:
    """A percent below the mass at which an eigenvalue crosses the axis the whirl dies, a percent above it grows."""
    critical, film = limit(load)[0], textbook(equilibrium(short_film, load)[0], load)
    for share in (0.99, 1.01):
        expected = eigenvalues(share * critical, *film).real.max()
        t, way = whirl(rotor, load, share * critical, 200, 1e-4)
        late = slice(len(t) // 2, None)
        growth = float(np.polyfit(t[late], np.log(np.hypot(*way))[late], 1)[0])
        assert np.sign(expected) == np.sign(share - 1.0)
        assert growth == pytest.approx(expected, rel=0.05)


def test_a_light_load_whirls_at_half_the_frequency(rotor: Rotor) -> None:
    """At its limit by the textbook, and as it whirls round the bearing beyond that."""
    load = 2.0
    mass, rate = limit(load)
    assert rate.imag == pytest.approx(0.5 * OMEGA, rel=0.01)
    t, way = whirl(rotor, load, 4.0 * mass, 120, 1e-3)
    angle, late = np.unwrap(np.arctan2(way[1], way[0])), len(t) // 2
    assert np.hypot(*way)[late:].min() > 0.05  # it does not come back
    assert (angle[-1] - angle[late]) / (t[-1] - t[late]) == pytest.approx(0.5 * OMEGA, rel=0.01)

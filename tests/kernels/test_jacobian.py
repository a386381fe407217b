"""The emitted Jacobian against the complex step of the model's own equations; the emitted solve against NumPy's."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import gudgeon
from gudgeon.assembly.start import Start
from gudgeon.errors import SingularError
from gudgeon.loading.generated_scenes import read_scenes
from gudgeon.loading.shipped import GENERATED, find_shipped_file, list_generated_scenes
from gudgeon.simulation.simulation import Simulation
from tests.equations.subjects import GAINS, NAN, Subject, make, shipped_subject
from tests.oracles.linkage_yaml import to_yaml
from tests.oracles.random_mechanism import random_mechanism
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = [needs_compiler, pytest.mark.plain]

# What shipped mechanisms do not have: corners in forces and drives, powers, a slip between two turning bodies.
CORNERS = b"""
format: gudgeon/1
name: corners
gravity: [0, -9.81 m/s^2]
parameters: {n: 1.5, drag: 0.3 N, slope: 2, w: 3 rad/s}
bodies:
  a: {length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}
  b: {length: 0.7 m, mass: 2 kg, inertia: 0.2 kg*m^2, points: {eye: [0.2 m, 0.1 m]}}
  c: {mass: 0.5 kg, inertia: 0.05 kg*m^2}
ground: {O: [0, 0], P: [0.3 m, 1 m]}
joints:
  pivot: {revolute: [ground.O, a.tail]}
  elbow: {revolute: [a.head, b.tail]}
drives:
  turn: {angle: [b, a], value: 0.3 + max(0.2*w*t, 0.1 + 0.5*sin(w*t)) + ramp(t, 0.5 s, 1 s) + abs(t*w - 2)**3}
forces:
  push: {force: b.eye, value: [5 N/m * max(a.theta, 0) * b.eye.x, 2 N * min(w*t, max(b.theta, -0.3))], axes: body}
  wind: {force: c.com, value: [-drag * abs(c.vx / (2 m/s))**n * sign(c.vx), 1 N * atan2(c.y, c.x + 2 m)], axes: ground}
  motor: {torque: [a, c], value: 1 N*m * sin(slope * a.theta) * exp(-(a.omega/w)**2) + 2 N * hypot(c.x, c.y)/(1 + w*t)}
  coil: {spring_damper: [b.head, c.com], stiffness: 70 N/m, free_length: 0.4 m, damping: 3 N*s/m}
  band: {spring_damper: [ground.P, c.com], stiffness: 20 N/m}
  twist: {rotational_spring_damper: [a, b], stiffness: 2 N*m/rad, free_angle: 0.1 rad, damping: 0.2 N*m*s/rad}
  rub: {dry_friction: [b.eye, c.com], direction: [1, 2], static: 2 N, kinetic: 1 N, speed: 0.2 m/s}
  brake: {dry_friction: [ground.O, b.head], direction: [0, 1], static: 3 N, kinetic: 2 N}
start: {guess: {a.theta: 0.4 rad, c.x: 0.8 m}}
"""

INTEGRATED = [  # read, not loaded: a file that is collected compiles nothing
    (name, source.scene)
    for name in list_generated_scenes()
    for source in read_scenes(GENERATED / name)
    if "rk4" in source.methods
]
APART = [("slider_crank", "dry"), ("shaker", "ideal"), ("belt_block", "ideal"), ("bouncing_ball", "elastic")]


@cache
def start_of(name: str, scene: str) -> Start:
    return gudgeon.load(name, scene).start()


def near_start(name: str, scene: str, subject: Subject, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """y near the start, off the constraints; a memory with contacts that are latched or not, all modes."""
    rng, source = np.random.default_rng(seed), subject.library.source
    start = start_of(name, scene)
    reach = 2e-4 if source.clearances else 0.05
    y = np.concatenate([start.q, start.v]) + np.repeat([reach, 0.1], subject.n) * rng.standard_normal(2 * subject.n)
    latched = rng.choice([NAN, 0.05], len(source.clearances))
    return y, np.concatenate([latched, rng.integers(-1, 3, len(source.frictions)).astype(float), [NAN]])


@pytest.mark.parametrize("gains", [50.0, 0.0])
@pytest.mark.parametrize("of", slow_but(APART, INTEGRATED), ids="-".join)
def test_every_shipped_scene(of: tuple[str, str], gains: float) -> None:
    name, scene = of
    subject = shipped_subject(name, scene, gains)
    for seed in range(5):
        y, memory = near_start(name, scene, subject, seed)
        subject.compare(0.1 + seed, y, memory[: max(subject.library.n_discrete_states, 1)])


@pytest.mark.parametrize("seed", slow_but([3, 4, 5], range(12)))  # every kind of joint, drive and element
def test_random_linkages(seed: int) -> None:
    """Every joint, drive and element; states on the constraints, and near them."""
    case = random_mechanism(seed)
    subject = make(to_yaml(case).encode(), f"random_{seed}", "ideal")
    if not subject.library.source.degrees_of_freedom:
        pytest.skip("nothing is integrated")
    rng = np.random.default_rng(seed)
    y = np.concatenate([case.q, case.v])
    for reach in (0.0, 0.01):
        subject.compare(0.0, y + reach * rng.standard_normal(y.size), np.array([NAN]), 1e-9)


@pytest.mark.parametrize("gains", [50.0, 0.0])
@pytest.mark.parametrize("modes", [(0.0, 0.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 1.0), (2.0, 0.0), (2.0, 2.0)])
def test_corners_and_friction_between_bodies(modes: tuple[float, float], gains: float) -> None:
    """Min, max, abs, sign and ramps on both sides; stick, slip and held friction."""
    subject = corners(gains)
    for seed in range(6):
        rng = np.random.default_rng(seed)
        y = np.concatenate([rng.uniform(-1.0, 1.0, subject.n), rng.uniform(-2.0, 2.0, subject.n)])
        subject.compare(0.31 * seed, y, np.array(modes))


@cache
def corners(gains: float) -> Subject:
    return make(CORNERS, "corners", "ideal", dict.fromkeys(GAINS, gains))


@pytest.mark.parametrize("of", slow_but(APART, INTEGRATED), ids="-".join)
def test_the_solve_against_a_dense_one(of: tuple[str, str]) -> None:
    """u/η − J u = r + s f_t from where nothing matters but 1/η to where it matters no more."""
    name, scene = of
    subject = shipped_subject(name, scene)
    rng = np.random.default_rng(7)
    y, memory = near_start(name, scene, subject, 3)
    check_solve(subject, 0.2, y, memory[: max(subject.library.n_discrete_states, 1)], rng)


def test_the_solve_where_friction_sticks_and_slips() -> None:
    subject, rng = corners(50.0), np.random.default_rng(8)
    for modes in ((0.0, 0.0), (1.0, 0.0), (0.0, -1.0), (2.0, 1.0)):
        y = np.concatenate([rng.uniform(-1.0, 1.0, subject.n), rng.uniform(-2.0, 2.0, subject.n)])
        check_solve(subject, 0.2, y, np.array(modes), rng)


def check_solve(subject: Subject, t: float, y: np.ndarray, memory: np.ndarray, rng: np.random.Generator) -> None:
    """Small backward error, row by row of the matrix that is solved."""
    library, p = subject.library, subject.p
    J, f_t = library.jacobian(t, y, p, memory)
    for eta in (1e-8, 1e-5, 1e-3, 0.1):
        for s in (0.0, 0.7):
            r = rng.standard_normal(len(f_t))
            u = library.solve_newton_system(t, y, p, eta, s, r, memory)
            matrix, b = np.eye(len(f_t)) / eta - J, r + s * f_t
            size = np.abs(matrix) @ np.abs(u) + np.abs(b)
            assert (np.abs(matrix @ u - b) <= 1e-11 * size.max()).all()
            well = np.linalg.cond(matrix) < 1e6
            assert not well or np.allclose(u, np.linalg.solve(matrix, b), rtol=1e-9, atol=1e-12 * np.abs(u).max())


def simulation(name: str, scene: str) -> Simulation:
    return Simulation(shipped_subject(name, scene).library, find_shipped_file(name))


def test_simulation_and_errors() -> None:
    crank = simulation("slider_crank", "dry")
    start = crank.start()
    y = np.concatenate([start.q, start.v])
    J = crank.jacobian(0.0, y)
    n = len(start.q)
    assert J.shape == (2 * n, 2 * n)
    assert (J[:n] == np.eye(n, 2 * n, n)).all()
    with pytest.raises(ValueError, match="nothing is integrated"):
        gudgeon.load("slider_crank", "ideal").jacobian(0.0, y)
    pendulum = simulation("pendulum", "ideal")
    state = np.full(2 * pendulum.compiled.n, NAN)
    with pytest.raises(SingularError):
        pendulum.jacobian(0.0, state)

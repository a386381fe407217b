"""Bodies that only touch each other: momentum under every law and option; and smooth motion, where the order shows."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gudgeon
from gudgeon.generator.kinds.laws.law import Law, find_all_laws
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler

PAIRS = """\
format: gudgeon/1
name: free_pairs
materials: {{aluminium: {{E: 70 GPa, nu: 0.3}}, steel: {{E: 206 GPa, nu: 0.28}}}}
bodies:
{bodies}
joints: {{{joints}}}
start:
  guess: {{{guess}}}
  rates: {{{rates}}}
bearings:
  pin: {{radius: 15 mm, clearance: 0.3 mm, length: 40 mm, bearing_material: aluminium, journal_material: steel}}
contacts:
{contacts}
scenes: {{play: {{play: {{{play}}}}}}}
"""
ONE = "  one#: {mass: 0.3 kg, inertia: 1.1e-3 kg*m^2, com: [10 mm, -20 mm], points: {hole: [60 mm, 35 mm]}}"
TWO = "  two#: {mass: 0.2 kg, inertia: 0.7e-3 kg*m^2, com: [-15 mm, 5 mm], points: {pin: [-40 mm, 55 mm]}}"
RATES = "one#.vx: 0.4, one#.vy: -0.1, one#.omega: 9, two#.omega: -14"
MASS = np.array([0.3, 0.3, 1.1e-3, 0.2, 0.2, 0.7e-3])
NAN = float("nan")


ROLES = ("normal", "friction", "film")
FORCE = '"1e6 N/m * delta + 1e15 N/m^3 * delta**3"'


def values(law: Law) -> dict[str, float]:
    """A number for every parameter that has no default, inside its bounds."""
    selected: dict[str, float] = {}
    for parameter in law.parameters:
        low, high = 0.0, math.inf
        for relation, bound, _ in parameter.bounds:
            number = selected[bound] if isinstance(bound, str) else bound
            low, high = (max(low, number), high) if relation.startswith(">") else (low, min(high, number))
        if parameter.accepts_any_dimension:  # a stiffness, in its own unit
            low = 1e8
        inside = low + 0.1 if math.isinf(high) else low + 0.9 * (high - low)
        selected[parameter.name] = inside if parameter.default is None else float(parameter.default)
    return selected


def variants(role: str) -> dict[str, bool]:
    """Every law of a role with every combination of its options, as YAML; whether any is not the usual one."""
    found = {}
    for law in find_all_laws().values():
        if law.role == role:
            for choice in itertools.product(*(option.values for option in law.options)):
                options = {o.name: str(v).lower() for o, v in zip(law.options, choice, strict=True)}
                numbers = {k: repr(v) for k, v in values(law).items()} | {f.name: FORCE for f in law.expressions}
                default = {o.name: str(o.default_option).lower() for o in law.options}
                for selected, number in law.instead.items():  # the number, or a choice other than the default
                    left_out = options if options[selected] == default[selected] else numbers
                    left_out.pop(selected if left_out is options else number)
                entries = {"law": law.name} | options | numbers
                text = "{" + ", ".join(f"{k}: {v}" for k, v in entries.items()) + "}"
                found[text] = any(options[name] != default[name] for name in options)
    return found


def contacts() -> list[str]:
    """Contact entries: each normal law, each friction law, each film, with all their options."""
    normal, friction, film = (list(variants(role)) for role in ROLES)
    found = [f"{{normal: {n}}}" for n in normal]
    found += [f"{{normal: {normal[0]}, friction: {f}}}" for f in friction]
    found += [f"{{normal: {normal[0]}, friction: {friction[0]}, film: {x}, transition: 5 um}}" for x in film]
    found += [f"{{film: {film[0]}}}", f"{{normal: {normal[0]}, friction: {friction[0]}, clip_ratio: true}}"]
    return found


def pairs(touching: Sequence[str], folder: Path) -> Simulation:
    """A pair of bodies for each contact, in one file: they have nothing to do with each other."""

    def each(text: str, between: str = ", ") -> str:
        return between.join(text.replace("#", str(k)) for k in range(len(touching)))

    text = PAIRS.format(
        bodies=each(f"{ONE}\n{TWO}", "\n"),
        joints=each("J#: {revolute: [one#.hole, two#.pin]}"),
        guess=each("one#.theta: 20 deg, two#.theta: -70 deg"),
        rates=each(RATES),
        contacts="\n".join(f"  touch{k}: {contact}" for k, contact in enumerate(touching)),
        play=each("J#: {bearing: pin, contact: touch#}"),
    )
    file = folder / "free_pairs.yaml"
    file.write_text(text, encoding="utf-8")
    return gudgeon.load(file, scene="play")


def states(q0: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Eccentricities from the centre to far inside the bearing, any velocities."""
    rng = np.random.default_rng(17)
    q, v = np.tile(q0, (count, 1)), rng.normal(0.0, 1.0, (count, 6)) * [0.05, 0.05, 5.0, 0.05, 0.05, 5.0]
    inside, rim = np.geomspace(1e-9, 0.29e-3, count // 2), np.linspace(0.298e-3, 0.33e-3, count - count // 2)
    size, angle = rng.permutation(np.r_[inside, rim]), rng.uniform(0.0, 2.0 * np.pi, count)
    q[:, 3] += size * np.cos(angle)
    q[:, 4] += size * np.sin(angle)
    v[: count // 3] *= 0.01
    return q, v


RARE = [law for role in ROLES for law, rare in variants(role).items() if rare]


USUAL = [contact for contact in contacts() if not any(law in contact for law in RARE)]


def few(several: Sequence[str], most: int = 12) -> list[Sequence[str]]:
    return [several[k : k + most] for k in range(0, len(several), most)]


@pytest.mark.parametrize(
    "touching",
    [
        *few(USUAL),
        *(pytest.param(rare, marks=pytest.mark.slow) for rare in few(sorted({*contacts()} - {*USUAL}))),
    ],
)
def test_momentum_of_free_pairs(touching: Sequence[str], tmp_path: Path) -> None:
    """The forces of a joint with play add up to nothing, and turn nothing, whatever the law."""
    scene = pairs(touching, tmp_path)
    start, n = scene.start(), len(touching)
    assert start.q == pytest.approx(np.tile(start.q[:6], n), abs=1e-15)  # all of them begin at the same place
    q, v = (np.tile(one, n) for one in states(start.q[:6], 60))
    touched = np.zeros(n, int)
    for stored in (NAN, 0.03):
        bent = np.full((60, len(scene.source.internal_states)), 7e-6)  # internal states of the laws
        got = scene.compiled.evaluate(np.zeros(60), q, v, np.c_[np.full((60, n), stored), bent], scene.p)
        for k, contact in enumerate(touching):
            at, a = q[:, 6 * k : 6 * k + 6], got.a[:, 6 * k : 6 * k + 6]
            force = MASS * a
            size = np.abs(force).max(axis=1) + 1e-12
            assert np.all(np.abs(force[:, 0] + force[:, 3]) < 1e-13 * size), contact
            assert np.all(np.abs(force[:, 1] + force[:, 4]) < 1e-13 * size), contact
            torque = force[:, 2] + force[:, 5]
            for i in (0, 3):
                torque = torque + at[:, i] * force[:, i + 1] - at[:, i + 1] * force[:, i]
            assert np.all(np.abs(torque) < 1e-13 * size), contact
            assert np.isfinite(a).all(), contact
            touched[k] += int((np.hypot(got.clearance[:, k, 0], got.clearance[:, k, 1]) > 1e-6).sum())
    assert touched.min() > 10


@pytest.mark.parametrize(
    "index",
    [
        0,
        len(variants("normal")),
        pytest.param(len(variants("normal")) + len(variants("friction")), marks=pytest.mark.slow),
    ],
)
def test_momentum_of_a_run(index: int, tmp_path: Path) -> None:
    """The same over a whole motion with impacts: what is left is RK4's own error."""
    run = pairs([contacts()[index]], tmp_path).simulate(0.02, output=40, step=1e-6)
    linear = np.array([(MASS * run.v)[:, [0, 3]].sum(axis=1), (MASS * run.v)[:, [1, 4]].sum(axis=1)])
    spin = (MASS * run.v)[:, [2, 5]].sum(axis=1)
    for k in (0, 3):
        spin = spin + MASS[k] * (run.q[:, k] * run.v[:, k + 1] - run.q[:, k + 1] * run.v[:, k])
    assert np.ptp(linear, axis=1) == pytest.approx([0.0, 0.0], abs=1e-12 * np.abs(linear).max())
    assert np.ptp(spin) < 1e-7 * np.abs(MASS * run.v)[:, [2, 5]].max()
    kinetic = 0.5 * (MASS * run.v**2).sum(axis=1)
    assert np.ptp(kinetic - run.work.sum(axis=1)) < 1e-6 * kinetic[0]
    assert kinetic[-1] < kinetic[0] * (1.0 + 1e-8)  # one of the laws has no dissipation
    assert np.hypot(run["J0.ex"], run["J0.ey"]) == pytest.approx(run["J0.e"], abs=1e-15)


PENDULUM = """\
format: gudgeon/1
name: double_pendulum
gravity: [0, -9.81 m/s^2]
bodies:
  upper: {length: 300 mm, mass: 0.4 kg, inertia: 3e-3 kg*m^2}
  lower: {length: 200 mm, mass: 0.3 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0.1, 0.2]}
joints:
  top: {revolute: [ground.O, upper.tail]}
  elbow: {revolute: [upper.head, lower.tail]}
start: {set: {upper.theta: -20 deg, lower.theta: 40 deg}, rates: {upper.omega: 1 rad/s, lower.omega: -2 rad/s}}
"""


@pytest.fixture(scope="module")
def pendulum(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    file = tmp_path_factory.mktemp("pendulum") / "double_pendulum.yaml"
    file.write_text(PENDULUM, encoding="utf-8")
    return gudgeon.load(file)


def minimal(_: float, y: np.ndarray) -> list[float]:
    """The double pendulum in its two angles from the x axis (Lagrange's equations by hand)."""
    (m1, m2), (j1, j2), g = (0.4, 0.3), (3e-3, 1e-3), 9.81
    l1, a1, a2 = 0.3, 0.15, 0.1
    th1, th2, w1, w2 = y
    c, s = math.cos(th1 - th2), math.sin(th1 - th2)
    m11, m12, m22 = j1 + m1 * a1**2 + m2 * l1**2, m2 * l1 * a2 * c, j2 + m2 * a2**2
    b1 = -m2 * l1 * a2 * s * w2**2 - (m1 * a1 + m2 * l1) * g * math.cos(th1)
    b2 = m2 * l1 * a2 * s * w1**2 - m2 * a2 * g * math.cos(th2)
    det = m11 * m22 - m12**2
    return [w1, w2, (b1 * m22 - b2 * m12) / det, (m11 * b2 - m12 * b1) / det]


def test_double_pendulum_against_lagranges_equations(pendulum: Simulation) -> None:
    run = pendulum.simulate(1.5, output=30, step=2e-4)
    start = [math.radians(-20.0), math.radians(40.0), 1.0, -2.0]
    want = solve_ivp(minimal, (0.0, 1.5), start, "DOP853", t_eval=run.t, rtol=1e-12, atol=1e-13).y
    assert run["upper.theta"] == pytest.approx(want[0], abs=1e-9)
    assert run["lower.theta"] == pytest.approx(want[1], abs=1e-9)
    assert run["lower.omega"] == pytest.approx(want[3], abs=1e-8)
    assert run.diagnostics.energy_residual < 1e-8 * run.diagnostics.energy_turned_over + 1e-9


def test_observed_order_of_rk4(pendulum: Simulation) -> None:
    """Three runs, each with half the step: their differences shrink by 2⁴."""
    ends = [pendulum.simulate(1.0, output=1, step=step).q[-1] for step in (4e-3, 2e-3, 1e-3)]
    coarse, fine = (np.linalg.norm(b - a) for a, b in itertools.pairwise(ends))
    assert math.log2(coarse / fine) == pytest.approx(4.0, abs=0.1)
    exact = pendulum.simulate(1.0, output=1, step=1e-4).q[-1]
    errors = [np.linalg.norm(end - exact) for end in ends]
    slope = np.polyfit(np.log([4e-3, 2e-3, 1e-3]), np.log(errors), 1)[0]
    assert slope == pytest.approx(4.0, abs=0.1)

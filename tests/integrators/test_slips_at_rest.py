"""Friction that sticks holds its slip at exactly zero, so that rounding neither decides its mode nor makes events."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gudgeon
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
METHODS = ("auto", "dop853", "rodas5p", "radau5", "radau9")
STACK = """
format: gudgeon/1
name: stack
parameters:
  {A: 3 N, w: 7 rad/s, B: 1 N, w2: 11 rad/s, S1: 2 N, S2: 1 N, S3: 0.5 N, vb: 0.3 m/s, v1: 0 m/s, v2: 0 m/s, k1: 40 N/m,
   k2: 10 N/m}
bodies:
  b1: {mass: 0.5 kg, inertia: 1e-4 kg*m^2}
  b2: {mass: 0.3 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  g: {translational: [ground.O, b1.origin], axis: [1, 0]}
  h: {translational: [b1.origin, b2.origin], axis: [1, 0]}
forces:
  f: {force: b1.origin, value: ["A*sin(w*t) - k1*b1.x", 0]}
  f2: {force: b2.origin, value: ["B*sin(w2*t) - k2*b2.x", 0]}
  d1: {dry_friction: [ground.O, b1.origin], direction: [1, 0], static: S1, kinetic: S1}
  d2: {dry_friction: [b1.origin, b2.origin], direction: [1, 0], static: S2, kinetic: S2}
  d3: {dry_friction: [ground.O, b2.origin], direction: [1, 0], static: S3, kinetic: S3, speed: vb}
start:
  set: {b1.x: 0, b2.x: 0.01}
  rates: {b1.vx: v1, b2.vx: v2}
"""
TURNING = """
format: gudgeon/1
name: turning
parameters: {S: 1 N, Kn: 0.8 N, a: 1 rad, wa: 3 rad/s, k: 20 N/m}
gravity: [0, -9.81]
bodies:
  r: {mass: 1 kg, inertia: 0.01 kg*m^2}
  b: {mass: 0.5 kg, inertia: 1e-9 kg*m^2}
ground: {O: [0, 0]}
joints:
  ro: {revolute: [ground.O, r.origin]}
  sl: {translational: [r.origin, b.origin], axis: [1, 0]}
drives:
  d: {angle: r, value: a*sin(wa*t)}
forces:
  sp: {spring_damper: [r.origin, b.origin], stiffness: k, free_length: 0.1 m}
  dr: {dry_friction: [r.origin, b.origin], direction: [1, 0], static: S, kinetic: Kn}
start:
  set: {b.x: 0.1}
  rates: {b.vx: 0}
outputs:
  slip: b.vx*cos(r.theta) + b.vy*sin(r.theta)
events:
  slips: {zero: b.vx*cos(r.theta) + b.vy*sin(r.theta)}
"""
BLOCK = """
format: gudgeon/1
name: block
parameters: {A: 3 N, w: 7 rad/s, S: 2 N, Kn: 2 N, k: 40 N/m, v0: 0.2 m/s}
bodies:
  b: {mass: 0.5 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  g: {translational: [ground.O, b.origin], axis: [1, 0]}
forces:
  f: {force: b.origin, value: ["A*sin(w*t) - k*b.x", 0]}
  dr: {dry_friction: [ground.O, b.origin], direction: [1, 0], static: S, kinetic: Kn}
start:
  set: {b.x: 0}
  rates: {b.vx: v0}
events:
  rest: {zero: b.vx}
  rises: {zero: b.vx, direction: rising}
  falls: {zero: b.vx, direction: falling}
  back: {zero: b.x}
"""


def loaded(text: str, tmp_path_factory: pytest.TempPathFactory, formulation: str = "reduced") -> Simulation:
    file = tmp_path_factory.mktemp("scene") / "scene.yaml"
    file.write_text(text, encoding="utf-8")
    return gudgeon.load(file, formulation=formulation)


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    return loaded(BLOCK, tmp_path_factory)


def stacked(rng: np.random.Generator) -> dict[str, float]:
    values = {
        "A": rng.uniform(0.5, 6),
        "w": 10 ** rng.uniform(0.3, 1.5),
        "B": rng.uniform(0, 3),
        "w2": 10 ** rng.uniform(0.3, 1.5),
        "S1": rng.uniform(0.1, 2),
        "S2": rng.uniform(0.1, 2),
        "S3": rng.uniform(0.05, 0.8),
        "vb": rng.choice([0.3, -0.1, 0.05]),
        "v1": rng.choice([0, rng.uniform(-0.5, 0.5)]),
        "v2": rng.choice([0, rng.uniform(-0.5, 0.5)]),
        "k1": 10 ** rng.uniform(0, 2.5),
        "k2": 10 ** rng.uniform(0, 2),
    }
    return {name: float(value) for name, value in values.items()}


@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_equal_static_and_kinetic_friction_change_modes_without_end(
    tmp_path_factory: pytest.TempPathFactory, formulation: str
) -> None:
    """Where S = K accelerations are unique: forces that are exactly at their limit stick or slip by rounding alone.

    Of 1,250 such runs 55 ended with the error that friction changes its side without end; methods agree to their
    tolerance otherwise.
    """
    rng, stack = np.random.default_rng(1), loaded(STACK, tmp_path_factory, formulation)
    for _ in range(40):
        values, t_end = stacked(rng), float(rng.uniform(0.2, 1.0))
        right = stack.simulate(t_end, parameters=values, method="dop853", rtol=1e-10, output=1, audit=False)
        for method in METHODS:
            run = stack.simulate(t_end, parameters=values, method=method, rtol=1e-7, output=1, audit=False)
            for name in ("b1.x", "b2.x"):
                assert run[name][-1] == pytest.approx(right[name][-1], abs=1e-5), (method, values, t_end)


@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_a_slip_that_is_curved_in_the_coordinates_is_held_at_zero(
    tmp_path_factory: pytest.TempPathFactory, formulation: str
) -> None:
    """In a guide that turns the slip is no coordinate: steps let it drift by their tolerance (1e-5 of 1 m/s)."""
    turning = loaded(TURNING, tmp_path_factory, formulation)
    for method in METHODS:
        run = turning.simulate(0.15, parameters={"S": 8.0}, method=method, rtol=1e-5, output=40)
        assert abs(run["slip"]).max() < 1e-14, method
        assert not len(run.events_of("slips")), method


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("rtol", [1e-4, 1e-5, 1e-8])
@pytest.mark.parametrize(("stiffness", "kinetic"), [(291.0, 1.49), (0.0, 1.2)])
def test_rest_at_zero_is_left_without_an_event(
    block: Simulation, method: str, rtol: float, stiffness: float, kinetic: float
) -> None:
    """A block at rest at x = 0 begins to slip at t = asin(S/A)/w and comes to no zero before it returns.

    With S = K the velocity grows like (t - t_slip)^2 at first, less than the tolerance of any step.
    """
    values = {"A": 2.55, "w": 21.3, "S": 1.49, "Kn": kinetic, "k": stiffness, "v0": 0.0}
    run = block.simulate(0.1, parameters=values, method=method, rtol=rtol, output=[0.02, 0.1])
    assert max(abs(run["b.x"][0]), abs(run["b.vx"][0])) < 1e-15
    assert run["b.x"][-1] > 1e-3
    for name in ("rest", "rises", "falls", "back"):
        assert not len(run.events_of(name)), name


def test_velocities_come_to_rest_once(block: Simulation) -> None:
    """Each arrival of the velocity at zero is one event, falling or rising, whether friction then sticks or not.

    The same in one run as in parts that are cut anywhere, and at the end of a slip that is one step. The right number
    follows from samples of the velocity: signs that end.
    """
    rng = np.random.default_rng(5)
    for k in range(60):
        static = rng.uniform(0.2, 2.5)
        values = {
            "A": rng.uniform(1, 5),
            "w": 10 ** rng.uniform(0.3, 1.6),
            "S": static,
            "Kn": static * rng.choice([1, rng.uniform(0.3, 1)]),
            "k": 10 ** rng.uniform(1, 3),
            "v0": rng.uniform(0.05, 0.5),
        }
        given = {name: float(value) for name, value in values.items()}
        t_end, method = float(rng.uniform(1, 3) * 2 * np.pi / values["w"]), METHODS[k % len(METHODS)]
        whole = block.simulate(t_end, parameters=given, method=method, rtol=1e-9, output=4000)
        signs = np.sign(np.where(abs(whole["b.vx"]) < 1e-14, 0.0, whole["b.vx"]))
        moving = signs[:-1] != 0
        falls, rises = ((signs[:-1] == side) & moving & (signs[1:] != side) for side in (1, -1))
        found = {name: whole.events_of(name) for name in ("rest", "falls", "rises")}
        assert len(found["rest"]) == len(found["falls"]) + len(found["rises"]), (method, given)
        assert (len(found["falls"]), len(found["rises"])) == (falls.sum(), rises.sum()), (method, given, t_end)
        parts, state = [], None
        for cut in [*np.sort(rng.uniform(0, t_end, 3)), t_end]:
            start: dict[str, Any] = {"parameters": given} if state is None else {"start": state}
            run = block.simulate(float(cut), method=method, rtol=1e-9, output=1, **start)
            parts += list(run.events_of("rest"))
            state = run.final
        assert len(parts) == len(found["rest"]), given
        assert np.allclose(parts, found["rest"], rtol=0, atol=1e-6), given


BAR = """
format: gudgeon/1
name: bar
gravity: [0, -9.81]
parameters: {{F: {force} N}}
bodies: {{a: {{length: 0.6 m, mass: 1 kg, inertia: 0.02 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{O: {{revolute: [ground.O, a.tail]}}}}
freedoms: 1
forces: {{f1: {{dry_friction: [ground.O, a.head], direction: {direction}, static: F, kinetic: F}}}}
start: {{set: {{a.theta: {angle} deg}}}}
"""


@pytest.mark.parametrize("formulation", ["reduced", "full"])
@pytest.mark.parametrize("angle", [0, 20, 180, -45])
def test_friction_whose_arm_vanishes_takes_no_velocity(
    tmp_path_factory: pytest.TempPathFactory, formulation: str, angle: float
) -> None:
    """A bar falls from where the arm of friction is 0: its moment F L |sin| stops nothing there, though nothing slips.

    I theta'' = -m g L/2 cos(theta) - F L |sin(theta - theta_0)| sign(omega), integrated by SciPy. The bar was held for
    a moment at 180 and -45 deg: 2.2e-4 rad late after 0.05 s.
    """
    along = np.radians(angle)
    direction = f"[{np.cos(along)!r}, {np.sin(along)!r}]".replace("np.float64(", "").replace(")", "")
    scene = loaded(BAR.format(force=5, direction=direction, angle=angle), tmp_path_factory, formulation)
    inertia = 0.02 + 0.3**2

    def rates(_: float, y: np.ndarray) -> list[float]:
        friction = 5.0 * 0.6 * abs(np.sin(y[0] - along)) * np.sign(y[1])
        return [y[1], (-9.81 * 0.3 * np.cos(y[0]) - friction) / inertia]

    right = solve_ivp(rates, (0.0, 0.05), [along, 0.0], method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    for method in ("auto", "rodas5p", "radau5"):
        run = scene.simulate(0.05, method=method, output=1)
        assert run["a.theta"][-1] == pytest.approx(right[0], abs=1e-7), method
        assert run["a.omega"][-1] == pytest.approx(right[1], rel=1e-6), method

"""A stepper moves a scene as runs do that resume from each other with the parameters of each step, bit for bit."""

from __future__ import annotations

import pickle
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import ArrayError, AssemblyError, BadValueError, InputError
from gudgeon.integrators.reusable_run import ReusableRun
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.simulation.stepper import Stepper
from tests.audit_mutants import mutant
from tests.programs import needs_compiler

pytestmark = needs_compiler
CART = """\
format: gudgeon/1
name: cart_pole
gravity: [0, -9.81 m/s^2]
parameters: {push: 0 N, l: 0.5 m, angle: 3 deg}
ground: {O: [0, 0]}
bodies:
  cart: {mass: 1 kg, inertia: 0.1 kg*m^2}
  pole: {mass: 0.1 kg, inertia: 0.01 kg*m^2, points: {foot: [0, -l]}}
joints:
  rail: {translational: [ground.O, cart.origin], axis: [1, 0]}
  hinge: {revolute: [cart.origin, pole.foot]}
forces:
  motor: {force: cart.origin, value: [push, 0]}
freedoms: 2
start: {set: {cart.x: 0 m, pole.theta: angle}, rates: {cart.vx: 0 m/s, pole.omega: 0 rad/s}}
events: {fallen: {zero: pole.theta - 60 deg, action: stop}}
scenes: {ideal: {}}
"""
# mechanism, scene, inputs, series, options, length of a step in s
CASES: list[tuple[str, str, tuple[str, ...], tuple[str, ...], dict[str, Any], float]] = [
    ("nine_bar_press", "dry", ("bodies.S9.mass",), ("S9.y", "A.F", "A.deltadot_minus"), {}, 1e-3),
    ("nine_bar_press", "lubricated", ("bodies.S9.mass",), ("S9.ay", "A.e"), {"rtol": 1e-6}, 2e-4),
    ("slider_crank", "dry", ("bodies.rod.mass",), ("slider.x",), {"method": "rk4", "step": 2e-5}, 1e-3),
    ("slider_crank", "dry", ("bodies.rod.mass",), ("slider.x",), {"method": "rk4"}, 1e-4),
    ("andrews_squeezer", "ideal", ("bodies.OF.mass",), ("OF.theta", "OF.alpha"), {}, 1e-4),
    ("bouncing_ball", "damped", ("bodies.ball.mass",), ("ball.y", "fall.F"), {}, 0.05),
    ("belt_block", "ideal", ("bodies.block.mass",), ("block.x", "block.vx"), {}, 0.05),
    ("slider_crank", "ideal", ("bodies.rod.mass",), ("slider.x", "motor.torque"), {}, 1e-3),
]


@cache
def load(mechanism: str, scene: str) -> Simulation:
    return gudgeon.load(mechanism, scene)


@pytest.fixture
def cart(tmp_path: Path) -> Simulation:
    (tmp_path / "cart.yaml").write_text(CART)
    return gudgeon.load(tmp_path / "cart.yaml", "ideal")


def default(sim: Simulation, name: str) -> float:
    return next(slot.default for slot in sim.source.parameters if slot.address in (name, f"parameters.{name}"))


def last(run: Result, names: tuple[str, ...]) -> bytes:
    return np.array([run[name][-1] for name in names]).tobytes()


@pytest.mark.parametrize(("mechanism", "scene", "inputs", "series", "options", "dt"), CASES)
def test_the_same_bits_as_runs_that_resume(
    mechanism: str, scene: str, inputs: Any, series: Any, options: dict[str, Any], dt: float
) -> None:
    """Steps of different length, with inputs that change or stay."""
    sim, rng = load(mechanism, scene), np.random.default_rng(3)
    base = np.array([default(sim, name) for name in inputs])
    stepper, run, t = sim.stepper(inputs, series, **options), None, 0.0
    begin = stepper.reset(base)
    first = sim.simulate(dt, output=1, parameters=dict(zip(inputs, base.tolist(), strict=True)), **options, peaks=())
    assert begin.tobytes() == np.array([first[name][0] for name in series]).tobytes()
    x = base
    for k in range(25):
        h = dt * float(rng.uniform(0.5, 1.5))
        x = base * rng.uniform(0.9, 1.1) if k % 3 else x
        values = stepper.step(h, x)
        t = t + h
        parameters, start = dict(zip(inputs, x.tolist(), strict=True)), run and run.final
        run = sim.simulate(t, output=1, parameters=parameters, start=start, **options, peaks=())
        assert values.tobytes() == last(run, series) and stepper.t == t
        end = stepper.final
        for name in ("t", "q", "v", "state", "memory"):
            assert np.asarray(getattr(end, name)).tobytes() == np.asarray(getattr(run.final, name)).tobytes(), name
        assert dict(end.parameters) == dict(run.final.parameters) and end.sha256 == run.final.sha256


def test_most_scenes_are_run_in_reused_memory() -> None:
    for mechanism, scene, inputs, series, options, _ in CASES[:7]:
        assert isinstance(load(mechanism, scene).stepper(inputs, series, **options)._run, ReusableRun)


def test_held_inputs_are_those_of_one_run(cart: Simulation) -> None:
    """Many steps with equal inputs differ from one run by their errors alone."""
    stepper = cart.stepper("push", ["cart.x", "pole.theta"], rtol=1e-11, stop=False)
    stepper.reset([0.3])
    for _ in range(50):
        values = stepper.step(0.01)
    run = cart.simulate(0.5, output=1, rtol=1e-11, stop=False, parameters={"push": 0.3})
    np.testing.assert_allclose(values, [run["cart.x"][-1], run["pole.theta"][-1]], rtol=1e-8)


def test_a_controller_balances(cart: Simulation) -> None:
    """State feedback at 100 Hz holds what falls without it."""
    stepper = cart.stepper("push", ["cart.x", "cart.vx", "pole.theta", "pole.omega"])
    state = stepper.reset([0.0])
    while not stepper.ended:
        state = stepper.step(0.01)
    assert stepper.t < 2.0 and abs(np.degrees(state[2]) - 60.0) < 1e-6
    state = stepper.reset([0.0])
    for _ in range(1000):
        state = stepper.step(0.01, [state @ [1.0, 2.0, -40.0, -8.0]])
    assert not stepper.ended and abs(state[2]) < 1e-3


def test_errors_leave_the_state(cart: Simulation) -> None:
    stepper = cart.stepper(["push", "l"], "pole.theta")
    with pytest.raises(BadValueError, match="reset"):
        stepper.step(0.01)
    with pytest.raises(BadValueError, match="reset"):
        _ = stepper.final
    with pytest.raises(ArrayError):
        stepper.reset()
    stepper.reset([0.1, 0.5])
    before = stepper.step(0.01).copy(), stepper.t
    for wrong in ([np.nan, 0.5], [np.inf, 0.5], [0.1]):
        with pytest.raises(InputError):
            stepper.step(0.01, wrong)
    with pytest.raises(AssemblyError, match="violates constraint equations"):  # another length
        stepper.step(0.01, [0.1, 0.6])
    for dt in (0.0, -1.0, np.nan, np.inf, 1e-30):
        with pytest.raises(InputError, match="dt is" if not dt > 0.0 else "t_end"):
            stepper.step(dt)
    assert stepper.t == before[1]
    other = cart.stepper(["push", "l"], "pole.theta")
    other.reset([0.1, 0.5])
    other.step(0.01)
    assert other.step("10 ms").tobytes() == stepper.step(0.01).tobytes()


def test_a_failed_audit_is_an_error(tmp_path: Path) -> None:
    edit = ("engine/scalar_simd/dop853.h", "step->k[0][i] = run->dy[i];", "step->k[0][i] = 0.9 * run->dy[i];")
    stepper = mutant(load("pendulum", "ideal"), tmp_path, edit).stepper("g", "bob.x", method="dop853", audit="full")
    stepper.reset([9.81])
    with pytest.raises(gudgeon.AuditError):
        for _ in range(500):
            stepper.step(0.01)


def test_from_a_state_and_back(cart: Simulation) -> None:
    """As model predictive control needs it: several futures of one state."""
    stepper, other = (cart.stepper("push", ["cart.x", "pole.theta"], fixed={"angle": "5 deg"}) for _ in range(2))
    stepper.reset([0.2])
    stepper.step(0.02, [0.4])
    state = stepper.final
    futures = []
    for push in (0.0, 1.0, 0.0):
        begin = other.reset([push], start=state)
        futures.append(other.step(0.05).tobytes())
        run = cart.simulate(state.t + 0.05, output=1, start=state, parameters={"push": push})
        assert futures[-1] == last(run, other.series) and begin[1] == run["pole.theta"][0]
    assert futures[0] == futures[2] != futures[1]
    with pytest.raises(BadValueError, match="angle"):
        cart.stepper("push", "cart.x").reset([0.0], start=state)
    with pytest.raises(BadValueError, match="State"):
        other.reset([0.0], start=1)  # type: ignore[arg-type]


@pytest.mark.parametrize(("scene", "mechanism"), [("ideal", "slider_crank"), ("dry", "slider_crank")])
def test_it_can_be_pickled(scene: str, mechanism: str) -> None:
    sim = load(mechanism, scene)
    stepper = sim.stepper("bodies.rod.mass", "slider.ax")
    mass = [default(sim, "bodies.rod.mass")]
    assert pickle.loads(pickle.dumps(stepper)).series == ("slider.ax",)
    stepper.reset(mass)
    for _ in range(3):
        stepper.step(1e-3)
    copy: Stepper = pickle.loads(pickle.dumps(stepper))
    assert copy.t == stepper.t and copy.step(1e-3).tobytes() == stepper.step(1e-3).tobytes()
    assert "t = 0.004 s" in repr(copy) and copy.inputs == ("bodies.rod.mass",)


DRIVEN = (
    CART.replace(
        "freedoms: 2", "freedoms: 1\ndrives: {d: {coordinate: cart.x, value: 0.01 m*acos(cos(10 rad/s*t + 1))}}"
    )
    .replace("cart.x: 0 m, ", "")
    .replace("cart.vx: 0 m/s, ", "")
    .replace("pole.theta - 60 deg", "cart.x - 0.015 m")
)


def test_inputs_of_the_first_step_do_not_change_the_start(tmp_path: Path, cart: Simulation) -> None:
    """After a reset the state stays, also in scenes that `simulate` runs: here a drive whose jumps are searched."""
    (tmp_path / "driven.yaml").write_text(DRIVEN)
    driven = gudgeon.load(tmp_path / "driven.yaml", "ideal")
    three, ten = np.deg2rad(3.0), np.deg2rad(10.0)
    for simulation in (cart, driven):
        stepper = simulation.stepper(["angle", "l"], ["pole.theta"], stop=False)
        at_start = float(stepper.reset([three, 0.5])[0])
        np.testing.assert_allclose(at_start, three, rtol=1e-12)
        assert abs(float(stepper.step(1e-3, [ten, 0.5])[0]) - three) < 0.01 * three
        stepper.reset([three, 0.5])
        with pytest.raises(AssemblyError):
            stepper.step(1e-3, [three, 0.6])


def test_an_event_at_the_end_of_a_step_ends_it(tmp_path: Path) -> None:
    """The event lies at t = 0.05 s, where the drive has moved the cart by 0.015 m."""
    (tmp_path / "driven.yaml").write_text(DRIVEN)
    stepper = gudgeon.load(tmp_path / "driven.yaml", "ideal").stepper([], ["cart.x"])
    stepper.reset()
    stepper.step(0.05)
    assert stepper.ended and abs(stepper.t - 0.05) < 1e-9


def test_fixed_steps_of_rk4_fit_the_times(cart: Simulation) -> None:
    """Without `step` the step of rk4 follows from the duration between two rounded times, as in `simulate`."""
    stepper = cart.stepper(["push"], ["cart.x", "pole.theta"], method="rk4", stop=False)
    stepper.reset([0.3])
    run: Result | None = None
    t = 0.0
    for _ in range(12):
        t += 0.05
        start = run.final if run else None
        run = cart.simulate(t, output=1, method="rk4", stop=False, parameters={"push": 0.3}, start=start)
        assert stepper.step(0.05).tobytes() == last(run, stepper.series)

"""rk4 where the rate of a drive jumps: a step ends there, with the impulse, its work and its events."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.loading.engine import parse_sizes
from tests.slow import slow_but, slow_rows_but

HEAD = "format: gudgeon/1\nname: j\ngravity: [0, -9.81 m/s^2]\n"
SLIDER = (
    HEAD
    + """bodies:
  slider: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  arm: {length: 0.4 m, mass: 0.5 kg, inertia: 7e-3 kg*m^2}
ground: {O: [0, 0]}
parameters: {w: 7 rad/s, late: 0.3 s}
joints:
  G: {translational: [ground.O, slider.origin], axis: [1, 0]}
  T: {revolute: [slider.origin, arm.tail]}
start: {set: {arm.theta: -60 deg}}
"""
)
CRANK = (
    HEAD
    + """bodies:
  crank: {length: 0.2 m, mass: 1 kg, inertia: 1e-2 kg*m^2}
  arm: {length: 0.4 m, mass: 0.5 kg, inertia: 7e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  T: {revolute: [crank.head, arm.tail]}
start: {set: {arm.theta: -60 deg}}
"""
)
ON_SLIDER = "drives: {{d: {{coordinate: slider.x, value: {}}}}}\n"
ON_CRANK = "drives: {{d: {{angle: crank, value: {}}}}}\n"
JUMPING = {
    "max": SLIDER + ON_SLIDER.format("max(0 s, t - 0.5137 s) * 1 m/s"),
    "abs": SLIDER + ON_SLIDER.format("abs(t/(1 s) - 0.5) * 1 m"),  # at an end of a step, or the number next to it
    "many": SLIDER + ON_SLIDER.format("abs(sin(t * 2 rad/s)) * 1 m"),
    "nested": CRANK + ON_CRANK.format("abs(abs(t - 0.8 s) - 0.3137 s) * 3 rad/s"),
    "crank": CRANK + ON_CRANK.format("max(0 s, t - 0.5137 s) * 4 rad/s"),
}


def scene(text: str, folder: Path, formulation: str = "reduced") -> gudgeon.Simulation:
    file = folder / "jump.yaml"
    file.write_text(text, encoding="utf-8")
    return gudgeon.load(file, formulation=formulation)


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", slow_but(["abs", "nested"], JUMPING))
def test_the_order_is_four_past_a_jump(name: str, formulation: str, tmp_path: Path) -> None:
    """It was one, and the work of the impulse was missing: 1.3 J of 6.9 J, whatever the step."""
    simulation = scene(JUMPING[name], tmp_path, formulation)
    reference = simulation.simulate(1.7, output=2, rtol=1e-12)
    errors = []
    for step in (5e-3, 2.5e-3, 1.25e-3):
        run = simulation.simulate(1.7, output=2, method="rk4", step=step)
        assert 0 <= run.diagnostics.steps - round(1.7 / step) < 8  # one more at each corner
        errors.append(np.hypot(*(run[name][-1] - reference[name][-1] for name in ("arm.theta", "arm.omega"))))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders.min() > 3.4, (errors, orders)
    assert run.diagnostics.energy_residual < 1e-7 * run.diagnostics.energy_turned_over


def test_many_jumps_in_a_step_with_an_event_at_each(tmp_path: Path) -> None:
    """More events in a step than their list holds; each jump turns the slider round."""
    text = SLIDER + ON_SLIDER.format("abs(sin(t * 700 rad/s)) * 0.3 mm") + "events: {turn: {zero: slider.vx}}\n"
    simulation = scene(text, tmp_path)
    run = simulation.simulate(2.0, output=2, method="rk4", step=1.0)
    np.testing.assert_allclose(run.events_of("turn"), np.arange(1, 892) * np.pi / 1400, rtol=0, atol=1e-11)
    assert run.diagnostics.steps >= 2 + 891


@pytest.mark.parametrize("step", [1e-3, 0.1])
def test_a_batch_is_that_of_single_runs(step: float, tmp_path: Path) -> None:
    """Jumps at other times in each run, also several in a step; lanes leave these steps to the runs themselves."""
    text = SLIDER + ON_SLIDER.format("abs(sin(w*t)) * 0.3 m + max(0 s, t - late) * 1 m/s")
    text += "events: {a: {zero: arm.theta + 100 deg}, v: {zero: slider.vx - 1 m/s}}\n"
    simulation, numbers = scene(text, tmp_path), np.random.default_rng(1)
    columns = {"w": numbers.uniform(3.0, 200.0, 11), "late": numbers.uniform(0.0, 1.5, 11)}
    batch = simulation.simulate_many(columns, 1.2, output=40, method="rk4", step=step)
    for i in range(11):
        selected = {name: float(values[i]) for name, values in columns.items()}
        run = simulation.simulate(1.2, output=40, method="rk4", step=step, parameters=selected)
        for name in ("q", "v", "work", "events"):
            assert getattr(batch[i], name).tobytes() == getattr(run, name).tobytes()


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_a_jump_tears_off_what_sticks(formulation: str, tmp_path: Path) -> None:
    """The plate lies on the cart; at 0.2137 s that jumps to 1 m/s, and friction speeds the plate up by 2 m/s^2."""
    text = """format: gudgeon/1
name: j
bodies:
  cart: {mass: 0.5 kg, inertia: 1e-3 kg*m^2}
  plate: {mass: 0.2 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  rail: {translational: [ground.O, cart.origin], axis: [1, 0]}
  top: {translational: [cart.origin, plate.origin], axis: [1, 0]}
drives: {pull: {coordinate: cart.x, value: "max(0 s, t - .2137 s)*1 m/s - max(0 s, t - .4137 s)*1.5 m/s"}}
forces: {rub: {dry_friction: [cart.origin, plate.origin], direction: [1, 0], static: 0.5 N, kinetic: 0.4 N}}
"""
    run = scene(text, tmp_path, formulation).simulate(output=[0.2, 0.3, 0.4, 0.5, 2.0], method="rk4", step=1e-3)
    np.testing.assert_allclose(run["plate.vx"], [0.0, 0.1726, 0.3726, 0.2274, -0.5], atol=1e-9)


def test_only_scenes_whose_drives_jump_look_for_it(tmp_path: Path) -> None:
    for value, has in (("2 m/s * t", False), ("smooth_step(t, 0.1 s, 0.3 s) * 1 m", False), ("abs(t)*1 m/s", True)):
        source = scene(SLIDER + ON_SLIDER.format(value), tmp_path).source
        assert parse_sizes(source)["DRIVE_IMPULSES"] == has


BRANCHES = [(f"{pick}(late, t) * 1 m/s", formulation) for pick in ("min", "max") for formulation in ("reduced", "full")]


@pytest.mark.parametrize(("value", "formulation"), slow_rows_but([BRANCHES[0], BRANCHES[3]], BRANCHES))
def test_a_corner_at_a_parameter_exactly(value: str, formulation: str, tmp_path: Path) -> None:
    """Value and rate of the drive picked a branch each at the zero of `late - t`: "the motion is no longer finite"."""
    simulation = scene(SLIDER.replace("0.3 s", "0.2 s") + ON_SLIDER.format(value), tmp_path, formulation)
    reference = simulation.simulate(0.6, output=2, rtol=1e-12)
    run = simulation.simulate(0.6, output=2, method="rk4", step=1e-3)
    np.testing.assert_allclose(run["arm.omega"][-1], reference["arm.omega"][-1], rtol=0, atol=1e-8)
    assert run.diagnostics.energy_residual < 1e-7 * run.diagnostics.energy_turned_over


def test_a_jump_right_behind_a_step_that_is_rounded_beyond_it(tmp_path: Path) -> None:
    """0.28 + 0.02 is beyond 0.3: the last stage saw the other branch, and 0.47 J were missing from the work."""
    simulation = scene(SLIDER + ON_SLIDER.format("max(late, t) * 1 m/s"), tmp_path, "full")
    run = simulation.simulate(0.6, output=[0.0, 0.28, 0.6], method="rk4", step=0.02)
    reference = simulation.simulate(0.6, output=[0.0, 0.28, 0.6], rtol=1e-12)
    np.testing.assert_allclose(run.work[-1], reference.work[-1], rtol=0, atol=3e-3)
    assert run.diagnostics.energy_residual < 3e-3


LAWS = [
    (law, phase)
    for law in ("where(PHASE < T/2, PHASE/T, 1 - PHASE/T)", "PHASE*(T - PHASE)/T**2")
    for phase in ("mod(t, T)", "mod(-t, T)")
]


@pytest.mark.parametrize(("law", "phase"), slow_rows_but(LAWS[:1], LAWS))
def test_periods_that_begin_on_the_grid(law: str, phase: str, tmp_path: Path) -> None:
    """Bounds were rounded beyond the corner, or that belonged to the period before: 0.08 J of 0.3 J were wrong."""
    value = f'"0.05 m * {law.replace("PHASE", phase)}"'
    text = SLIDER.replace("late: 0.3 s", "T: 0.3 s") + ON_SLIDER.format(value)
    simulation = scene(text, tmp_path, "full")
    periods = np.array([0.3, 0.18, 0.097, 0.232, 0.12, 0.1, 0.11694381, 0.25])
    batch = simulation.simulate_many({"T": periods}, 1.2, output=2, method="rk4", step=1e-3)
    reference = simulation.simulate_many({"T": periods}, 1.2, output=2, method="dop853", rtol=1e-10)
    for run, exact in ((batch[i], reference[i]) for i in range(len(periods))):
        assert run.diagnostics.energy_residual < 1e-5 * run.diagnostics.energy_turned_over
        np.testing.assert_allclose(run.work[-1], exact.work[-1], rtol=0, atol=1e-6)
        np.testing.assert_allclose(run["slider.vx"], exact["slider.vx"], rtol=0, atol=1e-6)

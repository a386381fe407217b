"""The reduced formulation: driven chains beside what is free, drives' work, corners of drives, batches."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gudgeon
from tests.scenes import Load, loader


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


# A driven slider-crank; the arm hangs on its table or on the ground.
SHAKER = """
gravity: [0, -9.81 m/s^2]
parameters: {{w: 9 rad/s, l: 0.3 m}}
bodies:
  crank: {{length: 0.1 m, mass: 0.5 kg, inertia: 1e-3 kg*m^2}}
  rod: {{length: l, mass: 0.6 kg, inertia: 4e-3 kg*m^2}}
  table: {{mass: 0.8 kg, inertia: 1e-3 kg*m^2}}
  arm: {{length: 0.4 m, mass: 0.2 kg, inertia: 3e-3 kg*m^2}}
ground: {{O: [0, 0], P: [2 m, 0]}}
joints:
  O: {{revolute: [ground.O, crank.tail]}}
  A: {{revolute: [crank.head, rod.tail]}}
  B: {{revolute: [rod.head, table.origin]}}
  G: {{translational: [ground.O, table.origin], axis: [1, 0]}}
  T: {{revolute: [{pivot}, arm.tail]}}
drives: {{motor: {{angle: crank, value: {value}}}}}
start: {{guess: {{rod.theta: -10 deg, table.x: 0.38 m}}, set: {{arm.theta: -60 deg}}}}
"""
# A driven parallelogram; it is flat where the crank lies along the ground.
PARALLELOGRAM = """
gravity: [0, -9.81 m/s^2]
bodies:
  a: {{length: 0.1 m, mass: 0.5 kg, inertia: 1e-3 kg*m^2}}
  b: {{length: 0.3 m, mass: 0.5 kg, inertia: 3e-3 kg*m^2}}
  c: {{length: 0.1 m, mass: 0.5 kg, inertia: 1e-3 kg*m^2}}
  arm: {{length: 0.2 m, mass: 0.2 kg, inertia: 7e-4 kg*m^2}}
ground: {{O: [0, 0], P: [0.3 m, 0]}}
joints:
  O: {{revolute: [ground.O, a.tail]}}
  A: {{revolute: [a.head, b.tail]}}
  B: {{revolute: [b.head, c.head]}}
  C: {{revolute: [c.tail, ground.P]}}
  E: {{revolute: [b.com, arm.tail]}}
drives: {{turn: {{angle: a, value: {start} + 60 rpm * t}}}}
start: {{guess: {{b.theta: 0 deg, c.theta: {start}, arm.theta: -80 deg}}}}
"""


@pytest.mark.parametrize(("turns", "allowed"), [(20, 1e-5), (50, 1e-3)])  # J, of 0.2 and 1.3 J of motion
def test_work_of_a_drive_whose_chain_nothing_free_feels(load: Load, turns: int, allowed: float) -> None:
    """After whole revolutions at one speed the chain has the energy that it began with; the arm keeps its own."""
    text = SHAKER.format(pivot="ground.P", value="0.4 rad + w * t")
    run = load(text).simulate(output=np.arange(1, 6) * 2 * np.pi / turns, parameters={"w": float(turns)})
    assert run["work.drives"] == pytest.approx(0.0, abs=allowed)


def test_sample_where_a_chain_is_flat(load: Load) -> None:
    """At t = 1/4 s and 3/4 s the bars lie in a line: the sample closes, or the run says that it does not."""
    scene = load(PARALLELOGRAM.format(start="90 deg"))
    run = scene.simulate(1.0)
    assert np.sin(run["c.theta"] - run["a.theta"]) == pytest.approx(0.0, abs=1e-5)
    assert max(np.abs(scene.phi(t, q)).max() for t, q in zip(run.t, run.q, strict=True)) < 1e-6


def test_event_where_a_chain_is_flat(load: Load) -> None:
    """The crank's head falls through the line of the ground once a revolution, at 120/360 s and 480/360 s."""
    text = PARALLELOGRAM.format(start="60 deg") + "events: {down: {zero: a.head.y, direction: falling}}\n"
    run = load(text).simulate(2.0, output=37)
    assert run.events_of("down") == pytest.approx([1 / 3, 4 / 3], abs=1e-9)


def test_work_of_a_drive_that_carries_friction(load: Load) -> None:
    """A cart at 1 m/s drags a plate along that is slower: 0.1 N hold it back while they slide."""
    text = """
    bodies:
      cart: {mass: 0.5 kg, inertia: 1e-3 kg*m^2}
      plate: {mass: 0.2 kg, inertia: 1e-3 kg*m^2}
    ground: {O: [0, 0]}
    joints:
      rail: {translational: [ground.O, cart.origin], axis: [1, 0]}
      top: {translational: [cart.origin, plate.origin], axis: [1, 0]}
    drives: {pull: {coordinate: cart.x, value: 1 m/s * t}}
    forces: {rub: {dry_friction: [cart.origin, plate.origin], direction: [1, 0], static: 0.1 N, kinetic: 0.1 N}}
    start: {rates: {plate.vx: 0.5 m/s}}
    """
    run = load(text).simulate(0.5, output=5)
    assert run["work.drives"] == pytest.approx(0.1 * run.t, abs=1e-9)


def test_corner_of_a_drive_at_the_start(load: Load) -> None:
    """From t = 0 on |t| is t: the start has the rate that the motion goes on with."""
    runs = [
        load(SHAKER.format(pivot="table.origin", value=f"0.5 rad + w*t + 3 rad/s*{t}")).simulate(0.3, output=3)
        for t in ("t", "abs(t)")
    ]
    assert runs[1]["crank.omega"] == pytest.approx(runs[0]["crank.omega"], abs=1e-12)
    assert runs[1]["arm.theta"] == pytest.approx(runs[0]["arm.theta"], abs=1e-6)


def test_rk4_agrees_in_both_formulations_where_a_drive_jumps(tmp_path: Path) -> None:
    """The jump of 3 rad/s moves the arm by an impulse, whatever the coordinates."""
    file = tmp_path / "jump.yaml"
    text = SHAKER.format(pivot="table.origin", value="0.5 rad + w*t + 3 rad/s*abs(t - 0.11 s)")
    file.write_text("format: gudgeon/1\nname: jump\n" + text, encoding="utf-8")
    ends = [
        gudgeon.load(file, formulation=kind).simulate(0.2, output=2, method="rk4", step=1e-4)["arm.omega"][-1]
        for kind in ("reduced", "full")
    ]
    assert ends[0] == pytest.approx(ends[1], abs=1e-8)


def arm_beside(t_end: float, omega: float) -> float:
    """The arm's angle by its own equation: table on x = r cos φ + √(l² − r² sin² φ), φ = ½ + 9 t + 20 ⟨t − .31⟩²."""
    r, long, mass, inertia, half = 0.1, 0.3, 0.2, 3e-3, 0.2

    def rates(t: float, y: np.ndarray) -> list[float]:
        late = max(0.0, t - 0.31)
        phi, rate, second = 0.5 + 9 * t + 20 * late**2, 9 + 40 * late, 40.0 * (t > 0.31)
        sin, cos = np.sin(phi), np.cos(phi)
        root = np.sqrt(long**2 - (r * sin) ** 2)
        slope = -r * sin - r * r * sin * cos / root
        bend = -r * cos - r * r * np.cos(2 * phi) / root - (r * r * sin * cos) ** 2 / root**3
        pushed = slope * second + bend * rate**2
        turn = mass * half * (pushed * np.sin(y[0]) - 9.81 * np.cos(y[0]))
        return [y[1], turn / (inertia + mass * half**2)]

    y = np.array([-np.pi / 3, omega])
    for span in ((0.0, 0.31), (0.31 + 1e-15, t_end)):
        y = solve_ivp(rates, span, y, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    return float(y[0])


# A drive whose corners lie in parameters alone; no acceleration hangs on them.
STILL_CORNERS = """
gravity: [0, -9.81 m/s^2]
parameters: {w: 2.1 rad/s}
bodies:
  arm: {length: 0.4 m, mass: 0.2 kg, inertia: 3e-3 kg*m^2}
  table: {mass: 0.8 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  G: {translational: [ground.O, table.origin], axis: [1, 0]}
  T: {revolute: [table.origin, arm.tail]}
drives: {motor: {coordinate: table.x, value: VALUE}}
forces: {drag: {torque: arm, value: 'abs(arm.theta)*1e-3 N*m'}}
"""


@pytest.mark.parametrize("guided", [True, False])  # a coordinate of the tree, or a closure of its own
@pytest.mark.parametrize("method", ["auto", "dop853", "rodas5p", "rk4"])
def test_corners_of_a_drive_in_parameters_alone(load: Load, method: str, guided: bool) -> None:
    text, value = STILL_CORNERS, "'max(((w*0.1 m*s)**2)**0.5, 1e-3 m/(1.5 + abs(w)*1 s)) + t*0.5 m/s'"
    if not guided:
        text = text.replace("  G: {translational: [ground.O, table.origin], axis: [1, 0]}\n", "")
    options: dict[str, Any] = {"step": 1e-3} if method == "rk4" else {}
    run = load(text.replace("VALUE", value)).simulate(0.5, output=6, method=method, **options)
    np.testing.assert_allclose(
        run.q[:, run.source.coordinates.index("table.x")], 0.21 + 0.5 * run.t, rtol=0.0, atol=1e-12
    )


@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
def test_arm_on_a_driven_table_whose_acceleration_jumps(load: Load, method: str) -> None:
    """Against the arm's own equation in one coordinate; the drive's corner lies within a chain."""
    value = "0.5 rad + w*t + 20 rad/s^2 * max(0 s, t - 0.31 s)**2"
    run = load(SHAKER.format(pivot="table.origin", value=value)).simulate(1.0, output=3, method=method)
    assert run["arm.theta"][-1] == pytest.approx(arm_beside(1.0, run["arm.omega"][0]), abs=2e-7)
    assert run.diagnostics.energy_residual < 1e-6 * run.diagnostics.energy_turned_over


@pytest.mark.parametrize("options", [{}, {"method": "rk4", "step": 1e-3}])
def test_batch_whose_chains_jump_is_that_of_single_runs(load: Load, options: dict[str, Any]) -> None:
    """Lengths and speeds by run, a drive with corners, an event that ends some: the same bits, also of works."""
    value = "0.4 rad + w*t + 3 rad/s*abs(t - 0.13 s) + 0.1*max(sin(30*t), 0.2)"
    text = SHAKER.format(pivot="table.origin", value=value) + "events: {near: {zero: table.x - 0.28 m, action: stop}}\n"
    scene, numbers = load(text), np.random.default_rng(3)
    columns = {"w": numbers.uniform(-15, 15, 9), "l": numbers.uniform(0.25, 0.35, 9)}
    batch = scene.simulate_many(columns, 0.4, output=20, **options)
    for i in range(9):
        one = scene.simulate(0.4, output=20, parameters={k: float(v[i]) for k, v in columns.items()}, **options)
        for name in ("t", "q", "v", "a", "work"):
            assert np.array_equal(getattr(batch[i], name), getattr(one, name))
        assert np.array_equal(batch[i].events_of("near"), one.events_of("near"))

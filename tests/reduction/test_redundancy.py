"""Constraints that say the same, contradict each other, or come to do so; starts at singular positions."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.assembly.mobility import find_mobility
from gudgeon.errors import AssemblyError, SingularError, SolverError
from gudgeon.mechanisms import n_four_bar
from tests.scenes import Load, loader
from tests.slow import slow_but


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


PARALLELOGRAM = """
gravity: [0, -9.81 m/s^2]
bodies:
  a: {{length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}}
  b: {{length: 2 m, mass: 1 kg, inertia: 0.1 kg*m^2}}
  c: {{length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}}
  {bodies}
ground: {{o: [0, 0], p: [2 m, 0], m: [1 m, 0]}}
joints:
  O: {{revolute: [ground.o, a.tail]}}
  A: {{revolute: [a.head, b.tail]}}
  B: {{revolute: [b.head, c.head]}}
  P: {{revolute: [ground.p, c.tail]}}
  {joints}
{rest}
"""
THIRD_CRANK = {
    "bodies": "e: {length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}",
    "joints": "M: {revolute: [ground.m, e.tail]}\n  E: {revolute: [b.com, e.head]}",
    "rest": "start: {set: {a.theta: 50 deg}, guess: {b.theta: 0, c.theta: 50 deg, e.theta: 50 deg}}",
}


def energy(theta: float) -> float:
    """Potential energy with the third crank: three cranks at half their height, the coupler at its own."""
    return 9.81 * (3 * 0.5 + 1.0) * math.sin(theta)


def test_third_crank_swings_like_two(load: Load) -> None:
    """One row says nothing new; by energy, ½ J ω² = V(50°) − V(θ), with J of three cranks and the coupler's mass."""
    run = load(PARALLELOGRAM.format(**THIRD_CRANK)).simulate(1.0, step=1e-3, output=100)
    assert len(run.source.equations) == 11
    inertia = 3 * (0.1 + 0.25) + 1.0
    omega = run["a.omega"]
    want = [2 * (energy(math.radians(50)) - energy(theta)) / inertia for theta in run["a.theta"].tolist()]
    assert omega**2 == pytest.approx(want, abs=1e-5)
    assert np.abs(run["a.theta"] - run["e.theta"]).max() < 1e-7
    assert np.isnan(run["E.Fx"]).all()


def test_left_out_row_that_counts_with_other_lengths_is_an_error(load: Load) -> None:
    """The third crank, moved and shortened so that it fits at the start only: the linkage would be locked."""
    scene = load(PARALLELOGRAM.format(**THIRD_CRANK))
    theta = math.radians(50)
    length = math.hypot(math.cos(theta) - 0.05, math.sin(theta))
    with pytest.raises(AssemblyError, match=r"E\.y"):
        scene.simulate(1.0, step=1e-3, parameters={"ground.m.x": 1.05, "bodies.e.length": length})


TWO_DRIVES = """
bodies: {{a: {{length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}}, b: {{length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}}}}
ground: {{o: [0, 0]}}
joints: {{O: {{revolute: [ground.o, a.tail]}}, W: {{rigid: [a.head, b.tail]}}}}
drives: {{one: {{angle: a, value: 1 rad/s * t}}, two: {{angle: b, value: {value}}}}}
"""


def test_two_drives_that_agree(load: Load) -> None:
    run = load(TWO_DRIVES.format(value="1 rad/s * t")).simulate(1.0, output=10)
    assert run["b.theta"] == pytest.approx(run.t)
    assert np.isnan(run["one.torque"]).all()


@pytest.mark.parametrize(
    ("value", "error"),
    [
        ("1 rad/s * t + 0.1", AssemblyError),
        ("2 rad/s * t", AssemblyError),
        ("1 rad/s * t + 1 rad/s^2 * t**2", SolverError),  # agrees with its rate at the start, parts later
        ("1 rad/s * t + 0.5 * smooth_step(t, 0.5 s, 0.1 s)", SolverError),
    ],
)
def test_two_drives_that_contradict_each_other_are_named(load: Load, value: str, error: type[Exception]) -> None:
    with pytest.raises(error) as caught:
        load(TWO_DRIVES.format(value=value)).simulate(1.0, output=10)
    for name in ("W", "one", "two"):
        assert name in str(caught.value)


def test_hinges_that_do_not_fit_are_named(load: Load) -> None:
    """A door whose hinges are 200 mm apart, on one pin."""
    text = """
    bodies: {door: {mass: 1 kg, inertia: 0.1 kg*m^2, points: {low: [0, 0], high: [0, 200 mm]}}}
    ground: {o: [0, 0]}
    joints: {lower: {revolute: [ground.o, door.low]}, upper: {revolute: [ground.o, door.high]}}
    """
    with pytest.raises(AssemblyError, match=r"joints (upper, lower|lower, upper)"):
        load(text).simulate(1.0)


def test_door_on_two_hinges_of_one_axis_is_a_pendulum(load: Load) -> None:
    text = """
    gravity: [0, -9.81 m/s^2]
    bodies: {{door: {{mass: 1 kg, inertia: 0.1 kg*m^2, com: [0.5 m, 0]}}}}
    ground: {{o: [0.1 m, 0.3 m]}}
    joints: {{{joints}}}
    start: {{set: {{door.theta: 20 deg}}}}
    """
    one = "lower: {revolute: [ground.o, door.origin]}"
    single = load(text.format(joints=one)).simulate(1.0, step=1e-3, output=10)
    both = load(text.format(joints=one + ", upper: {revolute: [ground.o, door.origin]}")).simulate(
        1.0, step=1e-3, output=10
    )
    assert both.q == pytest.approx(single.q, abs=1e-12)


@pytest.mark.parametrize("driven", [False, True])
def test_flat_parallelogram_goes_on_as_its_rates_say(load: Load, driven: bool) -> None:
    """Started in the singular position itself: no row is lost, and the cranks stay parallel."""
    drive = "drives: {d: {angle: a, value: 8 rad/s * t}}\n" if driven else ""
    held = "" if driven else "set: {a.theta: 0}, "
    rates = "{c.omega: 8 rad/s}" if driven else "{a.omega: 8 rad/s, c.omega: 8 rad/s}"
    rest = f"{drive}start: {{{held}guess: {{b.theta: 0, c.theta: 0}}, rates: {rates}}}"
    run = load(PARALLELOGRAM.format(bodies="", joints="", rest=rest)).simulate(2.0, step=1e-3, output=200)
    assert len(run.source.equations) == 8 + driven
    assert np.abs(run["a.theta"] - run["c.theta"]).max() < 1e-9
    assert run["a.theta"][-1] > 10.0


# A parallelogram with a pendulum on its coupler; all its bars lie in one line twice a turn, at 30 degrees.
SLANTING = """
gravity: [0, -9.81 m/s^2]
bodies:
  a: {length: 0.1 m, mass: 0.5 kg, inertia: 1e-3 kg*m^2}
  b: {length: 0.3 m, mass: 0.5 kg, inertia: 3e-3 kg*m^2}
  c: {length: 0.1 m, mass: 0.9 kg, inertia: 2e-3 kg*m^2}
  arm: {length: 0.2 m, mass: 0.2 kg, inertia: 7e-4 kg*m^2}
parameters: {angle: 30 deg}
ground: {O: [0, 0], P: [0.3 m * cos(angle), 0.3 m * sin(angle)]}
joints:
  O: {revolute: [ground.O, a.tail]}
  A: {revolute: [a.head, b.tail]}
  B: {revolute: [b.head, c.head]}
  C: {revolute: [c.tail, ground.P]}
  E: {revolute: [b.com, arm.tail]}
start:
  set: {a.theta: 90 deg, arm.theta: -80 deg}
  guess: {b.theta: 30 deg, c.theta: 90 deg}
  rates: {a.omega: -20 rad/s}
"""


def slanting(formulation: str, folder: Path) -> gudgeon.Simulation:
    file = folder / "slanting.yaml"
    file.write_text("format: gudgeon/1\nname: slanting\n" + SLANTING, encoding="utf-8")
    return gudgeon.load(file, formulation=formulation)


def test_two_freedoms_through_singular_positions(tmp_path: Path) -> None:
    """Six of them, which do not look symmetric to any row: both formulations, every method, energy and cost."""
    found = {}
    for formulation in ("reduced", "full"):
        scene = slanting(formulation, tmp_path)
        for method, rtol in (("auto", 1e-12), ("rodas5p", 1e-9)):
            run = scene.simulate(1.0, output=50, method=method, rtol=rtol)
            assert run.diagnostics.energy_residual < 100.0 * rtol, (formulation, method)  # of 2 J
            assert np.ptp(run["a.theta"]) > 6.0 * np.pi
            assert run["a.theta"] == pytest.approx(run["c.theta"], abs=1e-12)
            found[formulation, method] = run
        assert found[formulation, "auto"].diagnostics.right_hand_sides < 10_000
    exact = found["reduced", "auto"]["arm.theta"]
    # where steps fall beside such a position decides what it costs: 1e-11 to 6e-10 in coordinates of the tree
    assert found["full", "auto"]["arm.theta"] == pytest.approx(exact, abs=2e-9)
    for formulation in ("reduced", "full"):
        assert found[formulation, "rodas5p"]["arm.theta"] == pytest.approx(exact, abs=1e-7)


def test_rk4_has_its_order_through_singular_positions(tmp_path: Path) -> None:
    """Steps of which some lie across them."""
    scene = slanting("reduced", tmp_path)
    exact = slanting("full", tmp_path).simulate(0.6, output=4, rtol=1e-13)["arm.theta"]
    runs = [scene.simulate(0.6, output=4, method="rk4", step=h)["arm.theta"] for h in (4e-4, 2e-4)]
    coarse, fine = (np.abs(run - exact).max() for run in runs)
    assert fine < 1e-8 and np.log2(coarse / fine) > 3.5


SLIDER_CRANK = """
bodies:
  crank: {{length: 1 m, mass: 1 kg, inertia: 0.01 kg*m^2}}
  rod: {{length: 2 m, mass: 1 kg, inertia: 0.01 kg*m^2}}
  slider: {{mass: 1 kg, inertia: 0.01 kg*m^2}}
ground: {{o: [0, 0]}}
joints:
  O: {{revolute: [ground.o, crank.tail]}}
  A: {{revolute: [crank.head, rod.tail]}}
  B: {{revolute: [rod.head, slider.origin]}}
  G: {{translational: [ground.o, slider.origin], axis: [1, 0]}}
{rest}
"""


def test_dead_centre_loses_no_row(load: Load) -> None:
    """Free, with the crank spinning: it runs through; energy says how fast."""
    rest = "start: {set: {crank.theta: 0}, rates: {crank.omega: 3 rad/s}, guess: {rod.theta: 0, slider.x: 3 m}}"
    run = load(SLIDER_CRANK.format(rest=rest)).simulate(1.0, step=1e-3, output=10)
    assert len(run.source.equations) == 8
    assert run.diagnostics.energy_residual < 1e-7
    assert run["crank.theta"][-1] > 1.0


@pytest.mark.parametrize(
    ("value", "error"), [("3 m - 1 m/s * t", AssemblyError), ("3 m - 1 m/s^2 * t**2", SingularError)]
)
def test_slider_cannot_drive_away_from_dead_centre(load: Load, value: str, error: type[Exception]) -> None:
    rest = f"""
drives: {{push: {{coordinate: slider.x, value: {value}}}}}
start: {{guess: {{crank.theta: 0, rod.theta: 0, slider.x: 3 m}}}}"""
    with pytest.raises(error, match="dead centre"):
        load(SLIDER_CRANK.format(rest=rest)).simulate(1.0)


@pytest.mark.parametrize("formulation", slow_but(["reduced"], ["reduced", "full"]))
@pytest.mark.parametrize("rtol", [1e-8, 1e-10, 1e-12])
def test_through_singular_positions_at_any_tolerance(formulation: str, rtol: float) -> None:
    """The closer a step's error is looked at, the nearer its stages come to where all bars lie in one line.

    There rows of the closures vanish in a tree's angles, and what rounding leaves of them must not be solved for.
    """
    simulation = gudgeon.load("n_four_bar", formulation=formulation)
    for gravity in (-3.0, -7.8, -9.0, -9.81, -10.9):
        run = simulation.simulate(8.0, output=[0.0, 7.9, 8.0], rtol=rtol, parameters={"gravity.y": gravity})
        cranks = np.stack([run[f"crank{i}.theta"] for i in range(3)])
        assert np.ptp(cranks[0]) > 2.0 * np.pi
        assert np.abs(cranks - cranks[0]).max() < 1e-10
        assert run.diagnostics.energy_residual < 1e-5


@pytest.mark.slow
@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_many_loops_pass_singular_positions_in_as_many_steps_as_few(formulation: str, tmp_path: Path) -> None:
    """All squares are flat at once, whatever their number: what a passage costs grows as the right-hand side does."""
    evaluations = []
    for n in (5, 20):
        file = tmp_path / f"{n}.yaml"
        file.write_text(n_four_bar.text(n), encoding="utf-8")
        run = gudgeon.load(file, formulation=formulation).simulate(20.0, output=2, rtol=1e-12)
        assert run.diagnostics.energy_residual < 1e-7  # of 10 (2 n + 1) J
        evaluations.append(run.diagnostics.right_hand_sides)
    assert evaluations[1] < 1.05 * evaluations[0]


@pytest.mark.parametrize("length", [1e-12, 1e-9, 1e6])
def test_ranks_do_not_depend_on_the_unit_of_length(load: Load, length: float) -> None:
    """A parallelogram with a third crank has one freedom and redundant rows; a four-bar and a slider crank have none.

    Rows of lengths and of angles stand side by side.
    """
    third = PARALLELOGRAM.format(**THIRD_CRANK)
    rest = "start: {set: {a.theta: 50 deg}, guess: {b.theta: 0.1, c.theta: 60 deg}}"
    open_pin = PARALLELOGRAM.format(bodies="", joints="", rest=rest).replace("p: [2 m", "p: [2.2 m")
    slider = open_pin.replace("length: 1 m", "length: 1.5 m").replace(
        "B: {revolute: [b.head, c.head]}\n  P: {revolute: [ground.p, c.tail]}",
        "B: {revolute: [b.head, c.com]}\n  P: {translational: [ground.o, c.com], axis: [1, 0]}",
    )
    drive = "\ndrives: {D: {angle: a, value: 50 deg + 1 rad/s * t}}"
    for text, freedoms, redundant in ((third, 1, 1), (open_pin, 1, 0), (slider, 1, 0), (slider + drive, 0, 0)):
        text = text.replace(", set: {a.theta: 50 deg}", "") if drive in text else text
        scene = load(re.sub(r"([\d.]+) m\b(?!/)", lambda found: f"{float(found[1]) * length:.9g} m", text))
        found = find_mobility(scene.compiled, scene.p, scene.start().q)
        assert (found.freedoms, found.redundant, found.unconnected_bodies) == (freedoms, redundant, ()), text
        assert scene.source.degrees_of_freedom == freedoms and bool(scene.source.indeterminate) == bool(redundant)

"""Runs of rk4 side by side in vector registers: bit for bit what each is alone, whatever happens in other lanes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import GudgeonError
from gudgeon.integrators import lanes
from gudgeon.integrators.batch import Runs
from gudgeon.integrators.times import Times
from gudgeon.results.batch import Batch
from tests.programs import needs_compiler
from tests.simulation.test_many import assert_same
from tests.slow import slow_but

pytestmark = needs_compiler
HERE = Path(__file__).parent.parent / "mechanisms"
COUNT = 11  # divisible by no number of lanes
# mechanism, scene, column (address, from, to), end and step in s
Case = tuple[str | Path, str, tuple[str, float, float], float, float]
EVERY_KIND = HERE / "valid" / "every_kind.yaml"
CASES: list[Case] = [
    ("andrews_squeezer", "ideal", ("bodies.OF.mass", 0.02, 0.06), 0.01, 1e-5),
    ("nine_bar_press", "lubricated", ("c", 0.3e-3, 0.8e-3), 0.01, 2e-5),
    ("nine_bar_press", "dry", ("omega", 6.0, 30.0), 0.03, 2e-5),
    ("bouncing_ball", "damped", ("parameters.height", 0.2, 1.0), 0.7, 1e-5),
    ("car_axis", "ideal", ("parameters.r", 0.05, 0.2), 0.3, 1e-3),
    ("n_four_bar", "ideal", ("gravity.y", -12.0, -3.0), 0.5, 1e-3),
    ("slider_crank_spring", "ideal", ("forces.coil.stiffness", 100.0, 5000.0), 0.1, 1e-4),
    ("slider_crank", "dry", ("c", 0.1e-3, 0.5e-3), 0.02, 1e-5),
    ("pendulum", "ideal", ("g", 3.0, 12.0), 0.5, 1e-3),  # starts that C cannot close
    (HERE / "methods" / "swing.yaml", "ideal", ("forces.twist.stiffness", 1.0, 3.0), 0.5, 1e-3),
    (HERE / "valid" / "double_pendulum.yaml", "fast", ("c", 0.1e-3, 0.4e-3), 0.02, 1e-5),
    (EVERY_KIND, "ideal", ("parameters.k", 3000.0, 5000.0), 0.2, 1e-3),
]
APART = [case for case in CASES if case[0] in ("nine_bar_press", "pendulum", EVERY_KIND) or case[1] == "fast"]


class Seen:
    """What went side by side: groups, and of them the runs that came to the last sample there."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.groups: list[list[int]] = []
        self.arrived: list[int] = []
        plain = lanes.Lanes.together

        def together(own: lanes.Lanes, runs: Runs, group: list[int], memories: np.ndarray) -> None:
            plain(own, runs, group, memories)
            self.groups.append(group)
            self.arrived += [i for i in group if runs.arrays["done"][i] == runs.times.count[i]]

        monkeypatch.setattr(lanes.Lanes, "together", together)


def both(simulation: gudgeon.Simulation, sets: Any, t_end: float, **options: Any) -> tuple[Batch, Batch]:
    """The batch as it is, and with its runs one after the other."""
    options = {"method": "rk4", "output": 7, **options}
    return tuple(simulation.simulate_many(sets, t_end, side_by_side=side, **options) for side in (True, False))  # type: ignore[return-value]


def assert_same_batches(one: Batch, other: Batch) -> None:
    for name in ("q", "v", "work", "state", "samples", "t_last"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    assert [str(failure) for failure in one.failures] == [str(failure) for failure in other.failures]
    for i in range(len(one)):
        got, wanted = one.partial(i), other.partial(i)
        assert (got is None) == (wanted is None)
        if got is not None and wanted is not None:
            assert_same(got, wanted)


def without_chain(folder: Path) -> Path:
    """Every kind, but for the drive that leaves a loop of it no freedom: driven chains go one by one.

    Its guess is nearly closed: from the file's own, far from where the loop closes, each of some hundred runs would
    search for a third of a second.
    """
    file = folder / EVERY_KIND.name
    text = EVERY_KIND.read_text(encoding="utf-8")
    closer = {
        "S9.y: -290 mm": "S9.y: -263.067 mm", "L3.theta: 20 deg": "L3.theta: 10.3284 deg",
        "rod.theta: 60 deg": "rod.theta: 30.2961 deg", "crank.theta: 5 deg": "crank.theta: -2.78625 deg",
    }  # fmt: skip
    for far, near in closer.items():
        assert far in text
        text = text.replace(far, near)
    lines = text.splitlines(keepends=True)
    file.write_text("".join(line for line in lines if not line.lstrip().startswith("lift")), encoding="utf-8")
    return file


@pytest.mark.parametrize("case", slow_but(APART[:-2], CASES), ids=[f"{Path(case[0]).stem}-{case[1]}" for case in CASES])
def test_each_run_is_bit_for_bit_that_made_alone(case: Case, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    mechanism, scene, (address, low, high), t_end, step = case
    if mechanism == EVERY_KIND:
        mechanism = without_chain(tmp_path)
    seen, simulation = Seen(monkeypatch), gudgeon.load(mechanism, scene=scene)
    values = np.linspace(low, high, COUNT)
    batch, singly = both(simulation, {address: values}, t_end, step=step)
    assert not batch.failures and len({q.tobytes() for q in batch.q}) > 1
    assert_same_batches(batch, singly)
    for i in (0, COUNT - 1):
        alone = simulation.simulate(t_end, output=7, method="rk4", step=step, parameters={address: values[i]})
        assert_same(batch[i], alone)
    assert sum(map(len, seen.groups)) >= COUNT - 1
    if not (simulation.source.events or simulation.source.clearances):  # nothing that could be rare
        assert set(seen.arrived) >= set(range(COUNT - 1))


def test_samples_between_steps_are_those_made_alone() -> None:
    """Some in every step, in steps with contacts and without: the cubic of each run, whoever made the step."""
    press = gudgeon.load("nine_bar_press", "dry")
    sets = {"omega": np.linspace(6.0, 30.0, COUNT)}
    together, _ = both(press, sets, 0.02, step=2e-5, output=2347)
    for i in (0, 4, COUNT - 1):
        alone = press.simulate(0.02, output=2347, method="rk4", step=2e-5, parameters={"omega": sets["omega"][i]})
        assert (together.q[i] == alone.q).all() and (together.v[i] == alone.v).all()
        assert (together.work[i] == alone.work).all() and (together.state[i] == alone.state).all()
    assert sum(map(len, together.impacts)) > COUNT


def test_any_number_of_runs_and_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    simulation = gudgeon.load("andrews_squeezer")
    masses = np.linspace(0.02, 0.06, 17)
    options: dict[str, Any] = {"step": 1e-5, "output": 3, "method": "rk4"}
    whole = simulation.simulate_many({"bodies.OF.mass": masses}, 2e-3, side_by_side=False, **options)
    for n in (1, 2, 3, 4, 5, 7, 8, 9, 16, 17):
        for threads in (1, 3):
            batch = simulation.simulate_many({"bodies.OF.mass": masses[:n]}, 2e-3, threads=threads, **options)
            assert batch.q.tobytes() == whole.q[:n].tobytes() and batch.v.tobytes() == whole.v[:n].tobytes()


def test_a_lane_that_fails_leaves_the_others() -> None:
    """The film's damping asks for steps shorter than these; not at the larger clearances."""
    simulation = gudgeon.load("nine_bar_press", scene="lubricated")
    clearances: list[float] = [0.8e-3, 0.3e-3, 0.75e-3, -1.0, 0.7e-3, 0.25e-3, 0.8e-3, 0.72e-3, 0.78e-3]
    sets: list[dict[str, float | str]] = [{"c": c} for c in clearances]
    sets[7] |= {"bodies.L2.length": "5 m"}
    batch, singly = both(simulation, sets, 5e-3, step=1e-4)
    assert [failure.run for failure in batch.failures] == [1, 3, 5, 7]
    assert_same_batches(batch, singly)
    with pytest.raises(GudgeonError) as alone:
        simulation.simulate(5e-3, output=7, method="rk4", step=1e-4, parameters=sets[1])
    assert str(alone.value) == str(batch.failures[0].error)


def test_links_in_line() -> None:
    """Where rows depend on each other the single runs solve. One that starts there is lost to a fixed step."""
    simulation = gudgeon.load("n_four_bar")
    angles = np.array([1.0, 0.0, 2.0, 1e-3, 0.5, 0.05, 1.5])
    sets = {"start.set.crank0.theta": angles, "start.guess.crank1.theta": angles, "start.guess.crank2.theta": angles}
    batch, singly = both(simulation, sets, 0.1, step=1e-4)
    assert [failure.run for failure in batch.failures] == [1]
    assert_same_batches(batch, singly)


@pytest.mark.parametrize(("least", "step"), [(1e-7, 2e-6), (3e-5, 1e-5)])
def test_contacts_through_a_thin_film(least: float, step: float) -> None:
    """Film and contact blended; with the longer step and some of these films runs leave the model."""
    simulation = gudgeon.load("nine_bar_press", scene="lubricated")
    viscosities = np.linspace(least, 10.0 * least, COUNT)
    sets = {"contacts.oil.film.viscosity": viscosities, "omega": 30.0, "contacts.oil.normal.restitution": 0.6}
    batch, singly = both(simulation, sets, 0.03, step=step)
    assert batch.onsets.sum() > 10 and len(batch.failures) < COUNT and (step < 1e-5 or batch.failures)
    assert_same_batches(batch, singly)


@pytest.mark.parametrize("options", [{"method": "rk4", "step": 1e-5}, {"method": "dop853", "step": None}])
def test_a_run_that_leaves_the_model_is_told_as_alone(options: dict[str, Any]) -> None:
    """A journal deep in a bearing that is too soft: the run is over and is not begun anew."""
    simulation = gudgeon.load("nine_bar_press", scene="dry")
    sets = {"materials.aluminium.E": [70e9, 1e5, 50e9], "omega": 30.0}
    batch, singly = both(simulation, sets, 0.1, **options)
    assert [failure.run for failure in batch.failures] == [1]
    assert_same_batches(batch, singly)
    with pytest.raises(GudgeonError) as alone:
        simulation.simulate(0.1, output=7, parameters={"materials.aluminium.E": 1e5, "omega": 30.0}, **options)
    assert str(alone.value) == str(batch.failures[0].error) and "deep" in str(alone.value)


FALL = """\
format: gudgeon/1
name: fall
gravity: [0, -g]
parameters: {g: 10 m/s^2}
bodies: {ball: {mass: 1 kg, inertia: 1 kg*m^2}}
start: {set: {ball.x: 0, ball.y: 5 m, ball.theta: 0}, rates: {ball.vx: 1 m/s}}
events: {floor: {zero: ball.y, action: stop}, way: {zero: ball.x - 0.4 m}}
"""


def test_events_are_found_and_end_only_their_own_run(tmp_path: Path) -> None:
    file = tmp_path / "fall.yaml"
    file.write_text(FALL, encoding="utf-8")
    batch, singly = both(gudgeon.load(file), {"g": [1.0, 10.0, 40.0, 2.0, 160.0]}, 2.0, step=1e-3)
    assert batch.t_last == pytest.approx([2.0, 1.0, 0.5, 2.0, 0.25], abs=1e-9) and not batch.failures
    assert [len(events) for events in batch.events] == [1, 2, 2, 1, 1]
    assert_same_batches(batch, singly)


SPIN = """\
format: gudgeon/1
name: spin
parameters: {torque: 1 N*m, first: 0 rad}
bodies: {arm: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
gravity: [0, -10 m/s^2]
joints: {O: {revolute: [ground.O, arm.tail]}}
forces:
  motor: {torque: arm, value: torque}
  wind: {force: arm.head, value: [0.3 N * abs(sin(arm.theta)), min(arm.vx * 1 kg/s, 1 N)]}
start: {set: {arm.theta: first}, rates: {arm.omega: 1 rad/s}}
"""


def test_angles_that_the_library_turns_and_corners(tmp_path: Path) -> None:
    """Beyond 1e5 rad sines come from the library, in these lanes only (trigonometry.c)."""
    file = tmp_path / "spin.yaml"
    file.write_text(SPIN, encoding="utf-8")
    sets: list[dict[str, float | str]] = [
        {"torque": float(k), "first": angle} for k, angle in enumerate((0.0, 2e5, 99999.5, 1.0, -1e5, 3.0, 1e4))
    ]
    batch, singly = both(gudgeon.load(file), sets, 2.0, step=1e-3)
    assert not batch.failures and batch.q[2, -1, 2] > 1e5
    assert_same_batches(batch, singly)


def test_only_runs_with_the_same_step_share_a_vector() -> None:
    own = lanes.Lanes.__new__(lanes.Lanes)
    own.count = 4
    steps = np.array([1.0, 1.0, 2.0, 2.0, 2.0, 2.0, 2.0, 1.0])
    same = Times(np.linspace(0.0, 1.0, 3), np.full(8, 3), np.zeros(8, dtype=np.int_))
    assert own.groups([0, 1, 2, 3, 4, 5, 6, 7], steps, same) == [[0, 1], [2, 3, 4, 5], [6], [7]]
    times = Times.of_runs({k: (np.linspace(0.0, 1.0 + (k == 3), 3), True) for k in range(8)}, 8)
    assert own.groups([0, 1, 2, 3, 4, 5, 6, 7], steps, times) == [[0, 1], [2], [3], [4, 5, 6], [7]]
    assert own.groups([0, 1, 7], steps, same) == [[0, 1, 7]]


@pytest.mark.slow
def test_runs_with_steps_of_their_own_go_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a step rk4 takes one from each film and contact."""
    seen, simulation = Seen(monkeypatch), gudgeon.load(HERE / "valid" / "slider_crank.yaml", scene="oiled")
    stiffnesses = {"materials.bronze.E": [50e9, 100e9, 200e9]}
    batch, singly = both(simulation, stiffnesses, 2e-2)
    assert not seen.groups and not batch.failures
    assert_same_batches(batch, singly)


def test_nobody_else_pays(monkeypatch: pytest.MonkeyPatch) -> None:
    """The library of lanes is not even looked for in single runs, with other methods, or where friction may stick."""

    def refuse(*_: Any) -> None:
        raise AssertionError("lanes were asked for")

    monkeypatch.setattr(lanes.Lanes, "__init__", refuse)
    press, belt = gudgeon.load("nine_bar_press", scene="dry"), gudgeon.load("belt_block")
    press.simulate(1e-3, method="rk4", step=1e-5, output=2)
    press.simulate_many({"c": [3e-4, 4e-4]}, 1e-3, output=2)
    press.simulate_many({"c": [3e-4]}, 1e-3, method="rk4", step=1e-5, output=2)
    address = belt.source.slots[0].address
    belt.simulate_many({address: [belt.source.slots[0].default] * 3}, 0.01, method="rk4", step=1e-3, output=2)
    full = gudgeon.load("pendulum", formulation="full")
    slot = full.source.slots[0]
    full.simulate_many({slot.address: [slot.default] * 2}, 1e-4, method="rk4", step=1e-5, output=2)
    assert not belt.source.lanes and not full.source.lanes

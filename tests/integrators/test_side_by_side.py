"""Runs side by side in vector registers: each bit for bit as alone, whatever others do meanwhile."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import GudgeonError
from gudgeon.integrators import lanes, steps
from gudgeon.results.batch import Batch
from tests.programs import needs_compiler
from tests.simulation.test_many import assert_same
from tests.slow import slow_but

pytestmark = needs_compiler
HERE = Path(__file__).parent.parent / "mechanisms"
COUNT = lanes.MAX_LANES + 3  # more than are under way at once, divisible by no number of lanes
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
    """Runs that lanes have taken."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.used: list[int] = []
        plain = lanes.yield_waiting_runs

        def numbers_of(*arguments: Any) -> Any:
            for i in plain(*arguments):
                self.used.append(i)
                yield i

        monkeypatch.setattr("gudgeon.integrators.threads.yield_waiting_runs", numbers_of)


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """However short a batch is."""
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    monkeypatch.setattr(lanes, "MIN_RUNS", 2)


def both(simulation: gudgeon.Simulation, sets: Any, t_end: float, **options: Any) -> tuple[Batch, Batch]:
    """The batch as it is, and with its runs one after the other."""
    options = {"output": 7, "threads": 1, **options}
    return tuple(simulation.simulate_many(sets, t_end, side_by_side=side, **options) for side in (True, False))  # type: ignore[return-value]


def assert_same_batches(one: Batch, other: Batch) -> None:
    for name in ("q", "v", "work", "state", "samples", "t_last"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    assert [str(failure) for failure in one.failures] == [str(failure) for failure in other.failures]
    for i in range(len(one)):
        got, expected = one.partial(i), other.partial(i)
        assert (got is None) == (expected is None)
        if got is not None and expected is not None:
            assert_same(got, expected)


def without_chain(folder: Path) -> Path:
    """Every kind, but for the drive that leaves a loop of it no freedom: driven chains go one by one.

    Its guess is nearly closed: from the file's own, far from where the loop closes, each of some hundred runs would
    search for a third of a second.
    """
    file = folder / EVERY_KIND.name
    text = EVERY_KIND.read_text(encoding="utf-8")
    closer = {
        "S9.y: -290 mm": "S9.y: -263.067 mm",
        "L3.theta: 20 deg": "L3.theta: 10.3284 deg",
        "rod.theta: 60 deg": "rod.theta: 30.2961 deg",
        "crank.theta: 5 deg": "crank.theta: -2.78625 deg",
    }
    for far, near in closer.items():
        assert far in text
        text = text.replace(far, near)
    lines = text.splitlines(keepends=True)
    file.write_text("".join(line for line in lines if not line.lstrip().startswith("lift")), encoding="utf-8")
    return file


NAMES = [f"{Path(case[0]).stem}-{case[1]}" for case in CASES]
ALIKE = [case for case in APART if case[1] == "fast"]  # to a press with play


CHOSEN = (("dop853", 1e-6), ("dopri5", 1e-4), ("rodas5p", 1e-5), ("auto", 1e-9))
STAGED = (("radau5", 1e-5), ("radau9", 1e-7))


FALL = """\
format: gudgeon/1
name: fall
gravity: [0, -g]
parameters: {g: 10 m/s^2}
bodies: {ball: {mass: 1 kg, inertia: 1 kg*m^2}}
start: {set: {ball.x: 0, ball.y: 5 m, ball.theta: 0}, rates: {ball.vx: 1 m/s}}
events: {floor: {zero: ball.y, action: stop}, way: {zero: ball.x - 0.4 m}}
"""


@pytest.mark.parametrize("case", slow_but([case for case in APART if case not in ALIKE], CASES), ids=NAMES)
def test_each_run_is_bit_for_bit_that_made_alone(case: Case, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    mechanism, scene, (address, low, high), t_end, step = case
    if mechanism == EVERY_KIND:
        mechanism = without_chain(tmp_path)
    simulation, values = gudgeon.load(mechanism, scene=scene), np.linspace(low, high, COUNT)
    requested: list[dict[str, Any]] = [{"method": "rk4", "step": step}]
    selected = (*CHOSEN, *(STAGED if simulation.source.has_stage_matrices else ()))
    requested += [{"method": method, "rtol": rtol} for method, rtol in selected]
    for options in requested:
        seen = Seen(monkeypatch)
        batch, singly = both(simulation, {address: values}, t_end, **options)
        assert not batch.failures and len({q.tobytes() for q in batch.q}) > 1
        assert_same_batches(batch, singly)
        for name in ("steps", "right_hand_sides", "rejected", "jacobians", "stiff_steps"):
            assert (batch.diagnostics[name] == singly.diagnostics[name]).all(), name
        alone = simulation.simulate(t_end, output=7, **options, parameters={address: values[3]})
        assert_same(batch[3], alone)
        assert set(seen.used) == set(range(COUNT))  # twice where a start is left to Python


@pytest.mark.parametrize(("threads", "keep"), [(1, ["S9.y", "S9.ay", "B.Fx"]), (3, ["S9.y", "S9.ay"]), (3, ["A.F"])])
def test_runs_of_all_lengths_with_series_of_their_own(threads: int, keep: list[str]) -> None:
    """Lanes take the next run where one is over; samples are kept as series alone, so that places are taken again.

    Columns are evaluated for several runs at once, a magnitude (A.F) run by run.
    """
    press = gudgeon.load("nine_bar_press", "dry")
    sets = {"omega": np.linspace(6.0, 30.0, COUNT)}
    ends = np.linspace(0.002, 0.03, COUNT)[::-1]
    batches = both(press, sets, ends, threads=threads, rtol=1e-6, output=23, keep=keep)  # type: ignore[arg-type]
    for name in ("t", *keep):
        assert batches[0][name].tobytes() == batches[1][name].tobytes(), name
    assert sum(map(len, batches[0].impacts)) > COUNT
    assert [x.tobytes() for x in batches[0].impacts] == [x.tobytes() for x in batches[1].impacts]


def test_a_given_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """No error is looked at then; each run may have a step of its own."""
    seen, press = Seen(monkeypatch), gudgeon.load("nine_bar_press", "lubricated")
    steps = np.linspace(1e-4, 2e-4, COUNT)
    batch, singly = both(press, {"c": np.linspace(3e-4, 8e-4, COUNT)}, 0.01, method="rodas5p", step=steps)
    assert_same_batches(batch, singly)
    assert len(seen.used) == COUNT and not batch.failures


OTHERS: list[tuple[str, dict[str, float]]] = [("rodas5p", {}), ("rk4", {"step": 1e-6})]
MIXED = """
format: gudgeon/1
name: mixed
parameters: {load: 300 N}
bodies: {journal: {mass: 0.2 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, journal.origin]}}
forces: {down: {force: journal.origin, value: [0, -load]}}
materials: {steel: {E: 207 GPa, nu: 0.3}}
bearings: {pin: {radius: 10 mm, clearance: 0.1 mm, length: 20 mm, bearing_material: steel, journal_material: steel}}
contacts:
  oil:
    normal: {law: hertz, restitution: 0.7}
    friction: {law: modified_coulomb, mu: 0.1, v0: 1e-4 m/s, v1: 1e-3 m/s}
    film: {law: ocvirk, viscosity: 1e-4 Pa*s}
    mixed: {law: christensen, roughness: 0.5 um}
scenes: {rough: {play: {A: {bearing: pin, contact: oil}}}}
start: {play: {A: {e: [0.08 mm, 0], rate: [0.05, -0.8]}}, rates: {journal.omega: 20}}
"""


@pytest.mark.parametrize(
    ("method", "more"), [("dop853", {}), *(pytest.param(*one, marks=pytest.mark.slow) for one in OTHERS)]
)
def test_film_and_metal_that_share_a_load_by_a_law(method: str, more: dict[str, float], tmp_path: Path) -> None:
    file = tmp_path / "mixed.yaml"
    file.write_text(MIXED, encoding="utf-8")
    loads = np.linspace(100.0, 900.0, COUNT)
    batch, singly = both(gudgeon.load(file, "rough"), {"load": loads}, 0.004, method=method, **more)
    assert_same_batches(batch, singly)
    assert sum(map(len, batch.impacts)) > 0 and not batch.failures


def test_what_fails_leaves_the_others() -> None:
    """A journal deep in a soft bearing, numbers that are none, a start that does not close."""
    press = gudgeon.load("nine_bar_press", scene="dry")
    sets: list[dict[str, Any]] = [{"omega": 30.0 + 0.1 * k} for k in range(COUNT)]
    sets[2] |= {"materials.aluminium.E": 1e5}
    sets[5] |= {"c": -1.0}
    sets[11] |= {"bodies.L2.length": "5 m"}
    batch, singly = both(press, sets, 0.05, rtol=1e-6)
    assert [failure.run for failure in batch.failures] == [2, 5, 11]
    assert_same_batches(batch, singly)


def test_events_are_found_and_end_only_their_own_run(tmp_path: Path) -> None:
    file = tmp_path / "fall.yaml"
    file.write_text(FALL, encoding="utf-8")
    gravity = np.linspace(1.0, 160.0, COUNT)
    batch, singly = both(gudgeon.load(file), {"g": gravity}, 2.0, method="dop853")
    assert batch.t_last == pytest.approx(np.minimum(np.sqrt(10.0 / gravity), 2.0), abs=1e-9) and not batch.failures
    assert_same_batches(batch, singly)


def test_ctrl_c_ends_runs_at_whole_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """What was reached is the beginning of what would have been."""
    press = gudgeon.load("nine_bar_press", "lubricated")
    sets = {"c": np.linspace(3e-4, 8e-4, COUNT)}
    whole = press.simulate_many(sets, 0.1, output=50, rtol=1e-6, threads=1)

    def stop(share: float, _: str) -> None:
        if share > 0.0:
            raise KeyboardInterrupt

    part = press.simulate_many(sets, 0.1, output=50, rtol=1e-6, threads=1, progress=stop)
    assert part.interrupted or not part.failures
    for i, samples in enumerate(part.samples.tolist()):
        k = max(samples - 1, 0)  # the last one is where it was stopped
        assert part.q[i, :k].tobytes() == whole.q[i, :k].tobytes()


def test_the_library_is_made_where_it_is_worth_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not for what is over in a moment, nor for a few runs; from the middle of a batch on, if that takes its time."""
    made: list[bool] = []
    plain = lanes.Lanes.__init__

    def init(own: lanes.Lanes, *arguments: Any, **options: Any) -> None:
        made.append(True)
        plain(own, *arguments, **options)

    monkeypatch.setattr(lanes.Lanes, "__init__", init)
    monkeypatch.setattr(lanes, "_is_compiled", lambda *_: False)
    press = gudgeon.load("nine_bar_press", "lubricated")
    sets = {"c": np.linspace(3e-4, 8e-4, 4 * COUNT)}
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 1e9)
    alone = press.simulate_many(sets, 0.01, output=3, threads=2)
    press.simulate_many({"c": sets["c"][:1]}, 0.01, output=3, threads=2)
    assert not made
    with lanes.announce_later_runs(10**18):  # blocks of a study: what one takes is little, all of them are not
        gudgeon.load("nine_bar_press", "lubricated").simulate_many(sets, 0.01, output=3, threads=2)
    assert made == [True]
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 1e-9)
    for _ in range(2):  # once a library, whatever batches there are
        beside = press.simulate_many(sets, 0.01, output=3, threads=2)
        assert made == [True, True]
    assert_same_batches(beside, alone)


@pytest.mark.parametrize("rows", [pytest.param(4096, marks=pytest.mark.slow), 300])
def test_peaks_of_all_steps_are_those_of_runs_alone(rows: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each lane has a tape of its own, which is fetched where the run alone would stop for it: at 100 rows of 300."""
    monkeypatch.setattr(steps, "N_ROWS_OF_BLOCK", rows)
    seen, press = Seen(monkeypatch), gudgeon.load("nine_bar_press", "dry")
    beside, alone = both(press, {"omega": np.linspace(6.0, 30.0, COUNT)}, 0.02, rtol=1e-6, peaks=["S9.ay", "A.F"])
    assert {*seen.used} == {*range(COUNT)} and len({run[0].max for run in beside.extremes}) > COUNT / 2
    assert beside.extremes == alone.extremes
    assert_same_batches(beside, alone)


def test_a_lane_that_fails_leaves_the_others() -> None:
    """The film's damping asks for steps shorter than these; not at the larger clearances."""
    simulation = gudgeon.load("nine_bar_press", scene="lubricated")
    clearances: list[float] = [0.8e-3, 0.1e-3, 0.75e-3, -1.0, 0.7e-3, 0.05e-3, 0.8e-3, 0.72e-3, 0.78e-3]
    sets: list[dict[str, float | str]] = [{"c": c} for c in clearances]
    sets[7] |= {"bodies.L2.length": "5 m"}
    batch, singly = both(simulation, sets, 5e-3, method="rk4", step=4e-4)
    assert [failure.run for failure in batch.failures] == [1, 3, 5, 7]
    assert_same_batches(batch, singly)
    with pytest.raises(GudgeonError) as alone:
        simulation.simulate(5e-3, output=7, method="rk4", step=4e-4, parameters=sets[1])
    assert str(alone.value) == str(batch.failures[0].error)


def test_links_in_line() -> None:
    """Where rows depend on each other the single runs solve. One that starts there is lost to a fixed step."""
    simulation = gudgeon.load("n_four_bar")
    angles = np.array([1.0, 0.0, 2.0, 1e-3, 0.5, 0.05, 1.5])
    sets = {"start.set.crank0.theta": angles, "start.guess.crank1.theta": angles, "start.guess.crank2.theta": angles}
    batch, singly = both(simulation, sets, 0.1, method="rk4", step=1e-4)
    assert [failure.run for failure in batch.failures] == [1]
    assert_same_batches(batch, singly)


@pytest.mark.parametrize(("least", "step"), [(1e-7, 2e-6), (3e-5, 1e-5)])
def test_contacts_through_a_thin_film(least: float, step: float) -> None:
    """Film and contact blended; with the longer step some of these runs left the model."""
    simulation = gudgeon.load("nine_bar_press", scene="lubricated")
    viscosities = np.linspace(least, 10.0 * least, 11)
    sets = {"contacts.oil.film.viscosity": viscosities, "omega": 30.0, "contacts.oil.normal.restitution": 0.6}
    batch, singly = both(simulation, sets, 0.03, method="rk4", step=step)
    assert batch.onsets.sum() > 5 and not batch.failures
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
    batch, singly = both(gudgeon.load(file), sets, 2.0, method="rk4", step=1e-3)
    assert not batch.failures and batch.q[2, -1, 2] > 1e5
    assert_same_batches(batch, singly)


def test_nobody_else_pays(monkeypatch: pytest.MonkeyPatch) -> None:
    """The library of lanes is not even looked for in single runs, or where friction may stick."""

    def refuse(*_: Any) -> None:
        raise AssertionError("lanes were asked for")

    monkeypatch.setattr(lanes.Lanes, "__init__", refuse)
    press, belt = gudgeon.load("nine_bar_press", scene="dry"), gudgeon.load("belt_block")
    press.simulate(1e-3, method="rk4", step=1e-5, output=2)
    press.simulate_many({"c": [3e-4]}, 1e-3, method="rk4", step=1e-5, output=2)
    address = belt.source.parameters[0].address
    belt.simulate_many({address: [belt.source.parameters[0].default] * 3}, 0.01, method="rk4", step=1e-3, output=2)
    full = gudgeon.load("pendulum", formulation="full")
    slot = full.source.parameters[0]
    full.simulate_many({slot.address: [slot.default] * 2}, 1e-4, method="rk4", step=1e-5, output=2)
    assert not belt.source.lane_file and not full.source.lane_file

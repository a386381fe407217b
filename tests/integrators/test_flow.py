"""Runs by methods that choose their step, side by side: each bit for bit as alone, whatever others do meanwhile."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.integrators import lanes, steps
from gudgeon.results.batch import Batch
from tests.integrators.test_side_by_side import APART, CASES, EVERY_KIND, FALL, Case, assert_same_batches, without_chain
from tests.programs import needs_compiler
from tests.simulation.test_many import assert_same
from tests.slow import slow_but

pytestmark = needs_compiler
COUNT = lanes.MOST + 3  # more than are under way at once, divisible by no number of lanes


class Seen:
    """Runs that lanes have taken."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.taken: list[int] = []
        plain = lanes.numbers_of

        def numbers_of(*arguments: Any) -> Any:
            for i in plain(*arguments):
                self.taken.append(i)
                yield i

        monkeypatch.setattr("gudgeon.integrators.threads.numbers_of", numbers_of)


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """However short a batch is."""
    monkeypatch.setattr(lanes, "WORTH", 0.0)


def both(simulation: gudgeon.Simulation, sets: Any, t_end: float, **options: Any) -> tuple[Batch, Batch]:
    """The batch as it is, and with its runs one after the other."""
    options = {"output": 7, "threads": 1, **options}
    return tuple(simulation.simulate_many(sets, t_end, side_by_side=side, **options) for side in (True, False))  # type: ignore[return-value]


NAMES = [f"{Path(case[0]).stem}-{case[1]}" for case in CASES]
ALIKE = [case for case in APART if case[1] == "fast"]  # to a press with play


@pytest.mark.parametrize("case", slow_but([case for case in APART if case not in ALIKE], CASES), ids=NAMES)
def test_each_run_is_bit_for_bit_that_made_alone(case: Case, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    mechanism, scene, (address, low, high), t_end, _ = case
    if mechanism == EVERY_KIND:
        mechanism = without_chain(tmp_path)
    simulation, values = gudgeon.load(mechanism, scene=scene), np.linspace(low, high, COUNT)
    staged = [("radau5", 1e-5), ("radau9", 1e-7)] if simulation.source.stages else []
    for method, rtol in (("dop853", 1e-6), ("rodas5p", 1e-5), ("auto", 1e-9), *staged):
        seen = Seen(monkeypatch)
        batch, singly = both(simulation, {address: values}, t_end, method=method, rtol=rtol)
        assert not batch.failures and len({q.tobytes() for q in batch.q}) > 1
        assert_same_batches(batch, singly)
        for name in ("steps", "right_hand_sides", "rejected", "jacobians", "stiff_steps", "grazes"):
            assert (batch.diagnostics[name] == singly.diagnostics[name]).all(), name
        alone = simulation.simulate(t_end, output=7, method=method, rtol=rtol, parameters={address: values[3]})
        assert_same(batch[3], alone)
        assert set(seen.taken) == set(range(COUNT))  # twice where a start is left to Python


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
    assert len(seen.taken) == COUNT and not batch.failures


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
    monkeypatch.setattr(lanes, "_is_compiled", lambda _: False)
    press = gudgeon.load("nine_bar_press", "lubricated")
    sets = {"c": np.linspace(3e-4, 8e-4, 4 * COUNT)}
    monkeypatch.setattr(lanes, "WORTH", 1e9)
    alone = press.simulate_many(sets, 0.01, output=3, threads=2)
    press.simulate_many({"c": sets["c"][: lanes.FEW - 1]}, 0.01, output=3, threads=2)
    assert not made
    with lanes.followed_by(10**18):  # blocks of a study: what one takes is little, all of them are not
        gudgeon.load("nine_bar_press", "lubricated").simulate_many(sets, 0.01, output=3, threads=2)
    assert made == [True]
    monkeypatch.setattr(lanes, "WORTH", 1e-9)
    for _ in range(2):  # once a library, whatever batches there are
        beside = press.simulate_many(sets, 0.01, output=3, threads=2)
        assert made == [True, True]
    assert_same_batches(beside, alone)


@pytest.mark.parametrize("rows", [pytest.param(4096, marks=pytest.mark.slow), 300])
def test_peaks_of_all_steps_are_those_of_runs_alone(rows: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each lane has a tape of its own, which is fetched where the run alone would stop for it: at 100 rows of 300."""
    monkeypatch.setattr(steps, "ROWS", rows)
    seen, press = Seen(monkeypatch), gudgeon.load("nine_bar_press", "dry")
    beside, alone = both(press, {"omega": np.linspace(6.0, 30.0, COUNT)}, 0.02, rtol=1e-6, peaks=["S9.ay", "A.F"])
    assert {*seen.taken} == {*range(COUNT)} and len({run[0].max for run in beside.extremes}) > COUNT / 2
    assert beside.extremes == alone.extremes
    assert_same_batches(beside, alone)

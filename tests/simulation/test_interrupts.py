"""Ctrl-C: what was computed is kept, shown and written, and it is told that it is a part."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import gudgeon
from gudgeon.integrators.peers import driver as python_driver
from gudgeon.simulation.predictability_horizon import UNFINISHED
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies import bench as benches
from gudgeon.studies import map as maps
from gudgeon.studies.bench import measure_scene
from gudgeon.studies.box import Range
from gudgeon.studies.map import compute_verdict_box, compute_verdict_map
from gudgeon.studies.verdicts import Status
from tests.programs import needs_compiler
from tests.pump import Gudgeon, written

pytestmark = needs_compiler
PENDULUM = str(Path(__file__).parents[1] / "mechanisms" / "valid" / "double_pendulum.yaml")
C = 0.3e-3


@cache
def press(scene: str) -> Simulation:
    return gudgeon.load("nine_bar_press", scene=scene)


def ctrl_c_at(calls: int, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function; from its call number `calls` on Ctrl-C comes."""
    count = 0

    def called(*arguments: Any, **options: Any) -> Any:
        nonlocal count
        count += 1
        if count >= calls:
            raise KeyboardInterrupt
        return function(*arguments, **options)

    return called


@pytest.fixture
def one_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pieces of work one after the other, so that it is known which are done."""
    monkeypatch.setattr("gudgeon.studies.threads.os.cpu_count", lambda: 1)


def test_the_run_itself_outlives_the_search_for_its_horizon() -> None:
    """Ctrl-C once the run is complete: in each of its repetitions."""
    dry, ended = press("dry"), False

    def progress(fraction: float, text: str) -> None:
        nonlocal ended
        if ended:
            raise KeyboardInterrupt
        ended = fraction >= 1.0

    run = dry.simulate(0.02, output=50, horizon=True, progress=progress)
    assert ended and run.diagnostics.interrupted and math.isnan(run.diagnostics.horizon)
    assert UNFINISHED in run.diagnostics.notes
    assert run.t[-1] == 0.02 and (run.q == dry.simulate(0.02, output=50).q).all()


def test_run_with_horizon_ends_with_130_and_keeps_the_run(
    call: Gudgeon, pump: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    simulate = Simulation.simulate

    def interrupted(self: Simulation, *args: Any, **options: Any) -> Any:
        if options.get("start") is not None:  # a repetition
            raise KeyboardInterrupt
        return simulate(self, *args, **options)

    monkeypatch.setattr(Simulation, "simulate", interrupted)
    done = call("run", pump, "--scene", "worn", "--horizon")
    assert done.exit_code == 130, done.output
    assert "the search for the horizon was not finished" in done.stderr
    assert "Peak error against ideal" in done.stdout and UNFINISHED[:40] in done.stdout
    run = gudgeon.Result.load(tmp_path / "out/pump_worn.nc")
    assert run.t[-1] == 0.02 and UNFINISHED in run.diagnostics.notes


@pytest.mark.parametrize("method", ["scipy:Radau", "sundials:cvode"])
def test_a_cross_check_stores_its_start_first(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C while its package is imported: a partial result, as of any other method."""
    monkeypatch.setattr(python_driver, "_make_stepper", ctrl_c_at(1, python_driver._make_stepper))
    dry = press("dry")
    run = dry.simulate(0.01, method=method)
    assert run.diagnostics.interrupted and len(run.t) == 1 and run.t[0] == 0.0
    assert run.q[0] == pytest.approx(dry.simulate(0.01, output=1).q[0], abs=1e-12)


def test_a_cross_check_keeps_what_it_has() -> None:
    def progress(fraction: float, text: str) -> None:
        if fraction > 0.3:
            raise KeyboardInterrupt

    run = press("lubricated").simulate(1e-4, output=10, method="scipy:Radau", progress=progress)
    assert run.diagnostics.interrupted and 2 <= len(run.t) < 11
    whole = press("lubricated").simulate(1e-4, output=10, method="scipy:Radau")
    kept = len(run.t) - 1  # the last one is where it was when Ctrl-C came
    assert (run.t[:-1] == whole.t[:kept]).all() and (run.q[:-1] == whole.q[:kept]).all()
    assert whole.t[kept - 1] < run.t[-1] <= whole.t[kept]


def test_nothing_computed_is_told_so(call: Gudgeon, pump: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Simulation, "simulate", ctrl_c_at(1, Simulation.simulate))
    done = call("run", pump)
    assert done.exit_code == 130 and "nothing is shown or saved" in done.stderr
    assert not written(tmp_path)


def test_what_a_box_has_judged_is_kept(one_thread: None, monkeypatch: pytest.MonkeyPatch) -> None:
    edges, whole = [Range("omega", 5.0, 20.0)], None
    whole = compute_verdict_box(press("dry"), edges, 2, t_long=0.01)
    monkeypatch.setattr(maps, "judge_point", ctrl_c_at(3, maps.judge_point))
    found = compute_verdict_box(press("dry"), edges, 2, t_long=0.01)
    assert found.interrupted and found.done == (2, 4) and not whole.interrupted
    assert [cell.status for cell in found.cells[:2]] == [cell.status for cell in whole.cells[:2]]
    assert [cell.error for cell in found.cells[:2]] == [cell.error for cell in whole.cells[:2]]
    assert all(cell.status is Status.MISSING for cell in found.cells[2:])
    assert [cell.parameters for cell in found.cells] == [cell.parameters for cell in whole.cells]


def test_where_nothing_was_judged_there_is_nothing_to_keep(one_thread: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(maps, "judge_point", ctrl_c_at(1, maps.judge_point))
    with pytest.raises(KeyboardInterrupt):
        compute_verdict_box(press("dry"), [Range("omega", 5.0, 20.0)], 2, t_long=0.01)


def test_a_box_is_written_as_a_part(
    call: Gudgeon, one_thread: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    judged = maps.judge_point
    arguments = (
        "map",
        "nine_bar_press",
        "--scene",
        "dry",
        "--scene",
        "lubricated",
        "--box",
        "1",
        "--range",
        "omega=5..20",
        "--t-end",
        "5ms",
    )
    monkeypatch.setattr(maps, "judge_point", ctrl_c_at(3, judged))
    done = call(*arguments)
    assert done.exit_code == 130, done.output
    assert "partial (dry: 2 of 3 runs; lubricated: not started)" in done.stderr
    assert "interrupted after 2 of 3 runs" in done.stdout and "1 not judged" in done.stdout
    with open(tmp_path / "out/nine_bar_press_map.csv", encoding="utf-8") as file:
        assert [row["status"] for row in csv.DictReader(file)].count("not judged") == 1
    assert (tmp_path / "out/nine_bar_press_map.png").exists()
    monkeypatch.setattr(maps, "judge_point", ctrl_c_at(3, judged))
    assert json.loads(call(*arguments, "--json").stdout)["interrupted"] is True


def test_a_map_keeps_its_shape(one_thread: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(maps, "judge_point", ctrl_c_at(2, maps.judge_point))
    found = compute_verdict_map(press("lubricated"), t_long=0.005, quick=True)
    assert found.done == (1, 2) and found.interrupted
    assert found.get_cell(1e-8, C).status is Status.STABLE and found.get_cell(1e-6, C).status is Status.MISSING


def test_bench_keeps_its_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """The references, then two rows, then Ctrl-C."""
    monkeypatch.setattr(benches, "_measure_row", ctrl_c_at(3, benches._measure_row))
    pendulum = gudgeon.load(PENDULUM, scene="ideal")
    found = measure_scene(pendulum, [1e-3, 2e-3, 5e-3], [1e-6], t_end=0.1, quick=True)
    assert [row.setting.value for row in found.rows] == [5e-3, 2e-3]
    assert found.interrupted and found.done == (2, 7)


def test_bench_says_that_it_is_a_part(call: Gudgeon, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(benches, "_measure_row", ctrl_c_at(3, benches._measure_row))
    done = call("bench", PENDULUM, "--scene", "ideal", "--quick")
    assert done.exit_code == 130, done.output
    assert "interrupted: the results shown and written are partial (ideal: 2 of" in done.stderr
    assert "partial: interrupted after 2 of" in done.stdout
    assert written(tmp_path) == {"out/double_pendulum_bench.csv", "out/double_pendulum_bench.png"}

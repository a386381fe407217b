"""Run time against error: errors mean what they say, the order is the method's, a step too long is told."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import gudgeon
from gudgeon.cli import app
from gudgeon.contract.methods import STAGED
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.bench import (
    ADAPTIVE,
    REFERENCES,
    RESOLUTION_FACTOR,
    SECOND_REFERENCE_RTOL,
    Row,
    SceneBench,
    find_independent_reference,
    measure_scene,
    select_references,
)
from gudgeon.studies.methods import count_rhs_operations, measure_rhs_time
from gudgeon.studies.runs import (
    N_ONSETS,
    Attempt,
    Error,
    SceneWindow,
    Setting,
    compare_runs,
    compute_differences,
    find_comparison_window,
    find_default_step,
    find_mechanism_size,
    list_round_numbers,
)
from gudgeon.studies.show.bench import describe_bench, list_bench_rows
from tests.programs import needs_compiler

PENDULUM = str(Path(__file__).parents[1] / "mechanisms" / "valid" / "double_pendulum.yaml")
NAN = math.nan
USUAL = tuple(method for method in ADAPTIVE if method not in STAGED)  # of a scene without films


@cache
def press(scene: str) -> Simulation:
    return gudgeon.load("nine_bar_press", scene=scene)


@cache
def smooth() -> SceneBench:
    """A driven crank with a free pendulum: no contact, one degree of freedom."""
    simulation = gudgeon.load(PENDULUM, scene="ideal")
    return measure_scene(simulation, [5e-4, 1e-3, 2e-3, 5e-3], [1e-4, 1e-6, 1e-8, 1e-10], t_end=0.5, quick=True)


def made(errors: list[tuple[float, float]], agreement: float = 1e-12) -> SceneBench:
    rows = tuple(Row(Setting("rk4", h), 1.0 / h, 0, Error(motion=e)) for h, e in errors)
    return SceneBench("made", 1.0, "", rows, REFERENCES, Error(motion=agreement), NAN, ())


@given(st.floats(1e-9, 1e3), st.floats(1.0, 1e5))
def test_round_numbers_lie_between_and_are_as_many_as_there_are(low: float, ratio: float) -> None:
    found = list_round_numbers(low, low * ratio)
    assert all(low * (1 - 1e-8) <= x <= low * ratio * (1 + 1e-8) for x in found)
    assert all(1.9 < b / a < 2.6 for a, b in zip(found, found[1:], strict=False))
    assert len(found) >= math.floor(3 * math.log10(ratio) - 1e-9) - 1
    assert {f"{x:.0e}"[0] for x in found} <= set("125")


@given(st.floats(0.5, 8.0), st.floats(1e-3, 10.0))
def test_order_is_the_slope_of_what_is_neither_rounding_nor_large(order: float, factor: float) -> None:
    steps = [1e-2, 5e-3, 2e-3, 1e-3, 5e-4]
    true = [(h, factor * h**order) for h in steps]
    scene = made([*true, (1e-5, 1e-13), (1.0, 0.9)], agreement=1e-13)
    kept = [e for _, e in true if RESOLUTION_FACTOR * 1e-13 < e < 1e-3]
    if len(kept) >= 3:
        assert scene.estimate_order("motion") == pytest.approx(order, abs=1e-6)
    else:
        assert math.isnan(scene.estimate_order("motion"))


def test_difference_is_scaled_and_takes_common_samples(make: Callable[..., Result]) -> None:
    fine, coarse = make(samples=401), make(samples=201)
    assert compare_runs(coarse, fine) == Error(0.0, 0.0, 0.0)
    q = coarse.q.copy()
    q[7, 4] += 2e-4  # m, S9.y
    q[9, 2] -= 3e-3  # rad, L1.theta
    assert find_mechanism_size(coarse) == pytest.approx(0.08)
    assert compare_runs(replace(coarse, q=q, stored={}), fine).motion == pytest.approx(3e-3)
    q[9, 2] += 3e-3
    assert compare_runs(replace(coarse, q=q, stored={}), fine).motion == pytest.approx(2e-4 / 0.08)


def test_difference_of_peaks_between_the_samples(make: Callable[..., Result]) -> None:
    run = make()
    peak = replace(run.diagnostics.peaks[0], F=run.diagnostics.peaks[0].F * 1.5)
    other = replace(run, diagnostics=replace(run.diagnostics, peaks=(peak,)), stored={})
    assert compare_runs(run, other).force == pytest.approx(0.5 / 1.5 * 40.0 / max(40.0, run["A.F"].max() / 1.5))


def test_common_samples_are_compared_one_by_one(make: Callable[..., Result]) -> None:
    fine, coarse = make(samples=401), make(samples=201)
    q = coarse.q.copy()
    q[7, 2] += 3e-3  # rad, L1.theta
    motion, path, force = compute_differences(replace(coarse, q=q, stored={}), fine)
    assert motion[7] == pytest.approx(3e-3) and not np.delete(motion, 7).any()
    assert not path.any() and not force.any() and len(motion) == 201


def test_run_time_to_an_error_is_the_least_that_has_it() -> None:
    scene = made([(1e-2, 1e-3), (1e-3, 1e-5), (1e-4, 1e-7)], agreement=1e-9)
    assert scene.find_run_time_for_error(1e-4, "rk4") == pytest.approx(1e3)
    assert math.isnan(scene.find_run_time_for_error(1e-8, "rk4"))  # less than what the references leave in doubt


def test_a_run_is_compared_with_another_method() -> None:
    def of(*methods: str) -> Simulation:
        return cast(Simulation, SimpleNamespace(source=SimpleNamespace(methods=methods)))

    first, second = (Attempt(setting, None) for setting in REFERENCES)
    assert select_references(of("rk4", "dop853", "rodas5p"), [Setting("rk4", 1e-3)]) == REFERENCES
    for method in ("rk4", "rodas5p"):
        assert find_independent_reference([method], [first, second]) is first
    assert find_independent_reference(["dop853"], [first, second]) is second
    assert find_independent_reference(["dop853", "rodas5p"], [first, second]) is second
    assert find_independent_reference(["rk4"], []) is None
    assert select_references(of("rk4", "dop853"), []) == (REFERENCES[0], Setting("dop853", SECOND_REFERENCE_RTOL))
    shorter = select_references(of("rk4"), [Setting("rk4", 1e-3), Setting("rk4", 1e-2)])
    assert all(setting.method == "rk4" and setting.value <= 1e-3 / 4 for setting in shorter)


@needs_compiler
def test_bench_observes_the_order_of_runge_and_kutta() -> None:
    scene = smooth()
    assert scene.methods == ("rk4", *USUAL) and not any(row.failure for row in scene.rows)
    assert scene.estimate_order("motion") == pytest.approx(4.0, abs=0.1)
    assert scene.estimate_order("force") == pytest.approx(4.0, abs=0.1)


@needs_compiler
def test_errors_fall_with_the_tolerance_until_the_references_leave_them_in_doubt() -> None:
    scene = smooth()
    assert scene.reference_difference.motion < 1e-10 and scene.reference_difference.force < 1e-8
    for method in USUAL:
        errors = [row.error.motion for row in scene.list_rows(method)]
        assert all(b < a / 3 or not scene.is_resolved("motion", b) for a, b in zip(errors, errors[1:], strict=False))
        assert errors[2] < 1e-6  # rtol 1e-8, over half a second
        assert all(row.reference is not None and row.reference.method != method for row in scene.list_rows(method))
    assert any("another method" in line for line in describe_bench(scene, None))
    assert {row["reference"] for row in list_bench_rows([scene])} == {"dop853 1e-13", "rodas5p 1e-12"}


@needs_compiler
def test_window_holds_the_first_contacts() -> None:
    work = find_comparison_window(press("dry"), 1.0, Setting("rk4", find_default_step(press("dry"))))
    impacts = press("dry").simulate(work.t_end, output=1, step=2e-6).impacts
    assert len(impacts) == N_ONSETS
    assert find_comparison_window(press("lubricated"), 2e-3, Setting("auto", 1e-6)).t_end == pytest.approx(2e-3)


@needs_compiler
@pytest.mark.parametrize("step", [1e-6, 2e-6, 5e-6, 1e-5, 5e-5, 2e-4])
def test_samples_of_every_step_are_samples_of_the_reference(step: float) -> None:
    work = SceneWindow(press("dry"), 3.7e-3)
    coarse, fine = work.run(Setting("rk4", step)).run, work.run(Setting("rk4", 1e-6)).run
    assert coarse is not None and fine is not None
    assert coarse.diagnostics.step == pytest.approx(step, rel=1e-9)
    stride = round((coarse.t[1] - coarse.t[0]) / (fine.t[1] - fine.t[0]))
    assert fine.t[::stride][: len(coarse.t)] == pytest.approx(coarse.t, rel=1e-12)
    assert coarse.t[-1] > 3.7e-3 - max(step, work.sample_interval)


@needs_compiler
def test_paper_step_is_told_to_be_too_long() -> None:
    film = measure_scene(press("lubricated"), [1e-4, 5e-6], [1e-6], t_end=0.02, quick=True)
    late, good = film.find_row(Setting("rk4", 1e-4)), film.find_row(Setting("rk4", 5e-6))
    assert late is not None and (late.failure or late.error.force > 0.01)
    assert good is not None and not good.failure and good.error.force < 1e-6
    assert any(line.startswith("rk4 at 100 µs: ") for line in describe_bench(film, 1e-4))
    dry = measure_scene(press("dry"), [1e-4, 2e-6], [1e-6], t_end=0.0098, quick=True)
    late, good = dry.find_row(Setting("rk4", 1e-4)), dry.find_row(Setting("rk4", 2e-6))
    assert late is not None and good is not None and late.error.force > 30 * good.error.force > 0
    assert 3.0 < dry.contact / 1e-4 < 5.0  # steps of the shortest contact


@needs_compiler
def test_scene_without_freedom_is_measured_by_its_samples() -> None:
    scene = measure_scene(press("ideal"), quick=True)
    assert scene.methods == ("kinematic",) and not scene.references
    assert [row.setting.value * row.samples for row in scene.rows] == pytest.approx([scene.t_end] * len(scene.rows))
    assert all(row.error.motion < 1e-14 for row in scene.rows)


@needs_compiler
def test_operations_grow_by_the_dry_forces_of_the_joints_in_contact() -> None:
    free, closed = measure_rhs_time(press("dry"), 0.01, batch=10, repeats=1)
    assert (free.state, closed.state) == ("start", "A in contact")
    assert free.operations == count_rhs_operations(press("dry")) == press("dry").source.operations["dynamics"]
    added = [press("dry").source.operations[f"{part}_A_force"] for part in ("normal", "friction")]
    assert closed.operations - free.operations == sum(added)
    assert np.hypot(*(closed.q[3:5] - free.q[3:5])) > 0  # the state is that of the peak
    assert count_rhs_operations(press("lubricated")) > count_rhs_operations(press("dry"))


@needs_compiler
def test_command_writes_table_and_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = tmp_path / "found.csv"
    arguments = ["bench", PENDULUM, "--scene", "ideal", "--quick", "--mark-step", "1ms", "--t-end", "0.3"]
    app([*arguments, "--csv", str(table), "--set", "gravity.y=-1"], standalone_mode=False)
    with open(table, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    steps = [float(row["step_s"]) for row in rows if row["method"] == "rk4"]
    assert steps == sorted(steps, reverse=True) and len(steps) >= 4
    assert {row["method"] for row in rows} == {"rk4", *USUAL}
    assert all(float(row["error_coordinates"]) >= 0 for row in rows if not row["failure"])
    assert table.with_suffix(".png").stat().st_size > 10_000
    message = capsys.readouterr().out
    assert "observed order" in message and max(map(len, message.splitlines())) <= 100
    app([*arguments, "--json", "--out", str(tmp_path)], standalone_mode=False)
    document = json.loads(capsys.readouterr().out)
    assert len(document["rows"]) == len(rows) and document["rows"][-1]["step_s"] is None


def test_command_refuses_a_step_that_is_none(tmp_path: Path) -> None:
    with pytest.raises(SystemExit) as caught:
        app(["bench", PENDULUM, "--mark-step", "0", "--out", str(tmp_path)])
    assert caught.value.code == 2
    assert not list(tmp_path.iterdir())

"""A box of parameters: its corners and points, how each is judged, what is told of them."""

from __future__ import annotations

import json
import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import BadValueError
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.box import (
    Range,
    _count_predictable_samples,
    choose_comparison_times,
    judge_point,
    list_corners,
    sample_sobol_points,
)
from gudgeon.studies.map import VerdictBox, compute_verdict_box
from gudgeon.studies.runs import N_ONSETS, Error, SceneWindow, Setting, compare_runs
from gudgeon.studies.show.box import (
    MAX_WORST_POINTS,
    describe_verdict_counts,
    group_cells,
    remove_numbers,
    select_worst_cells,
)
from gudgeon.studies.show.box_figure import draw_box_figure, rank_ranges
from gudgeon.studies.show.map import describe_comparison
from gudgeon.studies.show.tables import format_seconds
from gudgeon.studies.verdicts import STRICT, Cell, Limits, Status, select_limits
from tests.programs import needs_compiler

AUTO = Setting("auto", 1e-8)


@cache
def press(scene: str) -> Simulation:
    return gudgeon.load("nine_bar_press", scene=scene)


def test_corners_and_sobol_points_fill_the_box_and_are_the_same_every_time() -> None:
    edges = [Range("a", 1e-3, 1.0), Range("b", 2.0, 3.0), Range("c", 1.0, 1.0)]
    found = list_corners(edges)
    assert len(found) == 8 and found[0] == {"a": 1e-3, "b": 2.0, "c": 1.0} and found[-1]["b"] == 3.0
    points = sample_sobol_points(edges, 100)
    assert points == sample_sobol_points(edges, 100) and points[:30] == sample_sobol_points(
        edges, 30
    )  # a sample is the beginning of the whole
    logs = np.log10([point["a"] for point in points])
    assert all(-3 <= x <= 0 for x in logs)
    assert np.histogram(logs, 4, (-3, 0))[0] == pytest.approx([25] * 4, abs=3)  # uniform on its scale
    with pytest.raises(BadValueError, match="low"):
        Range("a", 0.0, 1.0)


@needs_compiler
def test_box_judges_every_corner_and_point() -> None:
    dry = press("dry")
    found = compute_verdict_box(dry, [Range("omega", 5.0, 20.0)], 2, t_long=0.02)
    assert [cell.parameters["omega"] for cell in found.cells[:2]] == [5.0, 20.0] and len(found.cells) == 4
    assert not any(cell.failed for cell in found.cells)
    with pytest.raises(BadValueError, match="radius"):
        compute_verdict_box(dry, [Range("c", 1e-3, 0.02)], 0)


@needs_compiler
def test_tolerance_is_held_to_what_it_promises() -> None:
    assert select_limits(Setting("auto", 1e-8)) is STRICT and select_limits(Setting("rk4", 1e-6)) == Limits()
    assert judge_point(press("dry"), {}, 0.02, Setting("dop853", 1e-8)).status is Status.STABLE
    loose = judge_point(press("dry"), {}, 0.02, Setting("dop853", 0.03))  # energy is off by several times its limit
    assert loose.status is Status.INACCURATE and "energy" in loose.reason


@needs_compiler
def test_comparison_ends_between_two_contacts_after_the_fourth() -> None:
    run = press("dry").simulate(0.05, output=10)
    onsets = np.sort(run.impacts["t_on"])
    assert onsets[N_ONSETS - 1] < choose_comparison_times(run)[-1] < onsets[N_ONSETS]
    assert choose_comparison_times(press("lubricated").simulate(0.01, output=10))[-1] == pytest.approx(0.01)


@needs_compiler
def test_errors_are_told_with_the_time_that_was_compared() -> None:
    """Those of the first contacts, not of the run: a reader's own difference over all of it is larger."""
    dry, loose = press("dry"), Setting("rodas5p", 1e-6)
    cell = judge_point(dry, {}, 0.1, loose)
    times = np.linspace(0.0, cell.compared, 1001)
    assert (
        times[-1]
        == choose_comparison_times(dry.simulate(output=np.linspace(0.0, 0.1, 10_001), method="rodas5p", rtol=1e-6))[-1]
    )
    coarse, fine = (dry.simulate(output=times, method="rodas5p", rtol=rtol) for rtol in (1e-6, 1e-8))
    assert cell.error == compare_runs(coarse, fine)
    found = VerdictBox("dry", loose, (), (), (cell,), 0.1)
    assert (
        describe_comparison(found)
        == f"errors over the first {format_seconds(cell.compared)}, against a 100× tighter tolerance"
    )


@needs_compiler
def test_horizon_lies_where_tight_runs_come_apart_by_more_than_their_tolerance_allows() -> None:
    """Dry motion multiplies differences: a late sample says nothing of a run, the first contacts do."""
    work, times = SceneWindow(press("dry"), 0.5), np.linspace(0.0, 0.5, 1001)
    fine = work.run_at_times(Setting("auto", 1e-10), times)
    known = _count_predictable_samples(work, fine, STRICT)
    assert 0.01 < times[known] < 0.45
    work = SceneWindow(press("lubricated"), 0.05)
    assert _count_predictable_samples(work, work.run_at_times(Setting("auto", 1e-10), times[:100]), STRICT) > 100


@needs_compiler
def test_run_that_takes_too_long_is_ended_and_fails() -> None:
    cell = judge_point(press("dry"), {}, 1.0, Setting("auto", 1e-10), cpu_limit=0.0)
    assert cell.status is Status.DIVERGED and "processor time" in cell.reason


@needs_compiler
def test_command_judges_a_box(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = tmp_path / "box.csv"
    app(
        [
            "map",
            "nine_bar_press",
            "--scene",
            "dry",
            "--box",
            "1",
            "--range",
            "c=.1mm..1mm",
            "--range",
            "stiffness=50GPa..100GPa",
            "--t-end",
            "10ms",
            "--csv",
            str(table),
            "--json",
        ],
        standalone_mode=False,
    )
    cells = json.loads(capsys.readouterr().out)["cells"]
    assert len(cells) == 5 and all("materials.aluminium.E=" in cell["parameters"] for cell in cells)
    assert len(table.read_text(encoding="utf-8").splitlines()) == 6


def cell(status: Status, reason: str = "", error: float = math.nan) -> Cell:
    return Cell(AUTO, {}, status, reason, "", Error(motion=error))


def made(verdict: list[tuple[Status, float]], edges: tuple[Range, ...]) -> VerdictBox:
    """Points of a box with given verdicts and errors."""
    points = (*list_corners(edges), *sample_sobol_points(edges, len(verdict) - 2 ** len(edges)))
    return VerdictBox("made", AUTO, edges, points, tuple(cell(s, "why", e) for s, e in verdict), 1.0)


def test_reasons_are_grouped_without_their_numbers() -> None:
    cells = [
        cell(Status.DIVERGED, "no step is small enough at t = 0.31 s"),
        cell(Status.STABLE, error=1e-9),
        cell(Status.DIVERGED, "no step is small enough at t = 2e-05 s"),
        cell(Status.INACCURATE, "joint force differs by 4.9 % of its peak"),
        cell(Status.INACCURATE, "joint force differs by 4e-7 of its peak"),
        cell(Status.DIVERGED, "a journal passed through its bearing: δ = 3 mm"),
    ]
    found = [(status, reason, len(own)) for status, reason, own in group_cells(cells)]
    assert found == [
        (Status.DIVERGED, "no step is small enough", 2),
        (Status.DIVERGED, "a journal passed through its bearing", 1),
        (Status.INACCURATE, "joint force differs by … of its peak", 2),
        (Status.STABLE, "", 1),
    ]
    assert remove_numbers("more than 120 s of processor time") == "more than … s of processor time"
    worst = [c.reason for c in select_worst_cells(cells)]
    assert worst[:3] == [cells[0].reason, cells[5].reason, cells[3].reason] and len(worst) == 5  # one of each first
    assert len(select_worst_cells(cells * 9)) == MAX_WORST_POINTS
    message = describe_verdict_counts([*cells, cell(Status.MISSING)])
    assert message.startswith("7 points: 1 stable, 2 inaccurate, 3 diverged, 1 not judged")


def test_where_nothing_failed_the_largest_errors_are_the_worst() -> None:
    cells = [cell(Status.STABLE, error=e) for e in (1e-9, 1e-5, math.nan, 1e-7)]
    assert [c.error.motion for c in select_worst_cells(cells)] == [1e-5, 1e-7, 1e-9]


def test_the_ranges_that_tell_most_are_those_that_decide() -> None:
    """Runs with a large b fail and nothing else counts; where all are stable the error, which follows c, decides."""
    edges = (Range("a", 1.0, 10.0), Range("b", 1.0, 100.0), Range("c", 1e-3, 1.0))
    points = (*list_corners(edges), *sample_sobol_points(edges, 32))
    failing = made([(Status.DIVERGED if p["b"] > 10 else Status.STABLE, math.nan) for p in points], edges)
    assert rank_ranges(failing)[0] == 1
    stable = made([(Status.STABLE, 1e-9 * p["c"]) for p in points], edges)
    assert rank_ranges(stable)[0] == 2
    lost = made([(Status.MISSING, math.nan)] * len(points), edges)
    assert rank_ranges(lost) == [0, 1, 2]


@pytest.mark.parametrize("count", [1, 2, 3])
def test_every_judged_point_is_in_the_figure(count: int) -> None:
    edges = tuple(Range(name, 1e-3, 1.0, "m") for name in ("a.b.c", "d", "e"))[:count]
    points = (*list_corners(edges), *sample_sobol_points(edges, 5))
    box = made([(list(Status)[k % 4], 1e-6) for k in range(len(points))], edges)
    axes: Any = draw_box_figure("A box", [box, box]).axes
    assert len(axes) == 2 * (2 if count > 2 else 1)
    assert len(axes[0].collections) == len(points)
    assert axes[0].get_xscale() == axes[0].get_yscale() == "log"
    if count > 2:
        assert sum(len(line.get_xdata()) == count for line in axes[1].lines) >= len(points)

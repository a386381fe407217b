"""Forces and paths from the steps: what a picture is drawn from holds every extreme, in bounded room."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.integrators.trajectory import MAX_ENVELOPE_ROWS
from gudgeon.results.figures import joint_curves
from gudgeon.results.figures.plots import draw_run_figure
from gudgeon.results.results import Result
from tests.programs import needs_compiler

pytestmark = needs_compiler


def by_steps(steps: int) -> Result:
    """A run of rk4 whose samples are the ends of its steps."""
    step = 1e-5
    return gudgeon.load("nine_bar_press", "dry").simulate(steps * step, output=steps, method="rk4", step=step)


@pytest.mark.parametrize(("steps", "stride"), [(3000, 1), pytest.param(5000, 2, marks=pytest.mark.slow), (9001, 4)])
def test_rows_tell_the_extremes_of_their_steps(steps: int, stride: int) -> None:
    """Of 1, 2 or 4 steps each, as many as it takes to stay below the bound; none is forgotten."""
    run = by_steps(steps)
    trace = run.trace
    assert trace is not None and -(-(steps + 1) // stride) <= len(trace.t) <= MAX_ENVELOPE_ROWS  # events end steps, too
    ends = np.searchsorted(run.t, trace.t, side="right")  # samples up to a row's end: the ends of the grid
    first = np.concatenate([[0], ends[:-1]])
    some = ends > first
    assert ends[-1] == len(run.t) and some.sum() > 0.6 * len(some)
    for k, joint in enumerate(run.source.clearances):
        F, ex, ey, e = (run[f"{joint.name}.{name}"] for name in ("F", "ex", "ey", "e"))
        low, t_low, high, t_high, x_out, y_out, t_out, x, y = trace.joints[:, k].T
        off = 1e-9 * F.max()
        assert (low[some] <= np.minimum.reduceat(F, first[some]) + off).all()
        assert (high[some] >= np.maximum.reduceat(F, first[some]) - off).all()
        assert high.max() == pytest.approx(run.diagnostics.peaks[k].F, rel=1e-12)
        assert (np.hypot(x_out, y_out)[some] >= np.maximum.reduceat(e, first[some]) - 1e-9 * e.max()).all()
        for times in (t_low, t_high, t_out):
            assert (times <= trace.t).all() and (times[1:] >= trace.t[:-1] - 1e-12).all()
        at = np.isin(trace.t, run.t)
        rows = np.searchsorted(run.t, trace.t[at])
        assert x[at] == pytest.approx(ex[rows], abs=1e-15) and y[at] == pytest.approx(ey[rows], abs=1e-15)


@pytest.mark.parametrize("options", [{}, {"method": "rodas5p"}, {"method": "rk4", "step": 1e-5}])
def test_curve_and_mark_agree(options: dict[str, Any]) -> None:
    """The force is drawn through its peak over all steps, at its time, and through that of every contact."""
    run = gudgeon.load("nine_bar_press", "dry").simulate(0.1, output=100, **options)
    for k, joint in enumerate(run.source.clearances):
        peak = run.diagnostics.peak(joint.name)
        t, F = joint_curves.get_force_curve(run, joint.name)
        assert (np.diff(t) >= 0.0).all()
        assert F.max() == peak.F > run[f"{joint.name}.F"].max()
        assert t[F.argmax()] == peak.t
        for impact in run.impacts[run.impacts["joint"] == k]:
            during = (t >= impact["t_on"]) & ~(t > impact["t_off"])
            assert F[during].max() >= impact["F_peak"] * (1.0 - 1e-12)
    lines = draw_run_figure({"dry": run}, gudgeon.load("nine_bar_press").simulate(0.1, output=100), ["S9.y"])
    axes = [ax for part in lines.subfigs for ax in part.axes if ax.get_ylabel().startswith("force at A")]
    drawn = max(np.nanmax(y) for y in (np.asarray(line.get_ydata()) for line in axes[0].lines) if len(y) > 2)
    assert drawn == run.diagnostics.peak("A").F


def test_the_path_turns_round_where_the_journal_does() -> None:
    """Hundred samples miss how deep contacts go; the steps do not."""
    run = gudgeon.load("nine_bar_press", "dry").simulate(0.1, output=100)
    for joint in ("A", "B"):
        t, x, y = joint_curves.get_journal_path(run, joint)
        deepest, c = run.diagnostics.peak(joint).e_max, run.constants[f"{joint}.c"]
        assert (np.diff(t) >= 0.0).all()
        assert run[f"{joint}.e"].max() - c < 0.9 * (deepest - c)
        assert np.hypot(x, y).max() - c == pytest.approx(deepest - c, rel=1e-6)


def test_without_a_trace_peaks_are_drawn_all_the_same() -> None:
    """A batch keeps none; its curves go through the peaks of the contacts."""
    press = gudgeon.load("nine_bar_press", "dry")
    run = press.simulate_many({"omega": [6.0, 6.2]}, 0.1, output=100)[1]
    assert run.trace is None
    t, F = joint_curves.get_force_curve(run, "A")
    assert F.max() == run.diagnostics.peak("A").F and t[F.argmax()] == run.diagnostics.peak("A").t
    assert len(joint_curves.get_journal_path(run, "A")[0]) == 101


def test_a_file_keeps_the_trace(tmp_path: Path) -> None:
    run = gudgeon.load("nine_bar_press", "dry").simulate(0.03, output=10)
    run.save(tmp_path / "dry.nc")
    again = Result.load(tmp_path / "dry.nc")
    assert run.trace is not None and again.trace is not None
    assert again.trace.t.tobytes() == run.trace.t.tobytes()
    assert again.trace.joints.tobytes() == run.trace.joints.tobytes()
    ideal = gudgeon.load("nine_bar_press").simulate(0.03, output=10)
    ideal.save(tmp_path / "ideal.nc")
    assert Result.load(tmp_path / "ideal.nc").trace is None

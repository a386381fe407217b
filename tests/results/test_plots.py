"""Figures: what is drawn where, in which units, and that a picture is written as a whole."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure  # noqa: E402

from gudgeon.errors import GudgeonError  # noqa: E402
from gudgeon.language.plot_units import PREFIXES, choose_prefix, format_quantity, format_unit  # noqa: E402
from gudgeon.results.figures import plots  # noqa: E402
from gudgeon.results.reports.comparison import compute_scene_report  # noqa: E402
from gudgeon.results.results import Result  # noqa: E402
from tests.slow import slow_but  # noqa: E402


def labels(picture: Any) -> list[str]:
    return [ax.get_ylabel() for ax in picture.get_axes()]


def test_the_picture_has_errors_forces_and_orbits(run: Result, ideal: Result, tmp_path: Path) -> None:
    picture: Any = plots.draw_run_figure({"ideal": ideal, "dry": run}, ideal, ["S9.y"])
    found = labels(picture)
    assert found[:4] == ["error of S9.y [mm]", "error of S9.vy [mm/s]", "error of S9.ay [m/s²]", "force at A [N]"]
    drawn = picture.get_axes()[0].lines[0].get_ydata()
    np.testing.assert_allclose(drawn, (run["S9.y"] - ideal["S9.y"]) * 1e3)
    force = picture.get_axes()[3]
    np.testing.assert_array_equal(force.lines[1].get_ydata(), ideal["A.F"])
    assert force.lines[2].get_xydata().tolist() == [[0.115, 40.0]]  # the peak of all steps
    plots.save_figure(picture, tmp_path / "x.png")
    header = (tmp_path / "x.png").read_bytes()[:24]
    assert (int.from_bytes(header[16:20]), int.from_bytes(header[20:24])) == (1200, 900)


@settings(deadline=None, max_examples=30)
@given(st.floats(-3, 3), st.floats(-1, 1))
def test_an_axis_over_time_has_three_ticks_at_least(power: float, middle: float) -> None:
    ax: Any = Figure(figsize=(4, 2.5)).add_subplot()
    low, high = (10**power * (middle + part) for part in (-0.02, 0.02))
    ax.plot([0.0, 1.0], [low, high])
    plots._format_time_axis(ax, "x [m]", [np.array([0.0, 1.0])], True)
    begin, end = ax.get_ylim()
    assert sum(begin <= tick <= end for tick in ax.get_yticks()) > 2


def test_an_orbit_is_in_units_of_the_clearance_and_stays_in_its_square(run: Result) -> None:
    ax: Any = run.plot.orbit("A")
    x, y = ax.lines[0].get_data()
    np.testing.assert_allclose(np.hypot(x, y), run["A.eps"])
    assert np.abs(x).max() < ax.get_xlim()[1] and np.abs(y).max() < ax.get_ylim()[1]
    circle = ax.patches[0].get_xy()
    np.testing.assert_allclose(np.hypot(circle[:, 0], circle[:, 1]), 1.0)


def test_series_and_forces_of_one_run(run: Result, ideal: Result) -> None:
    assert run.plot.series("S9.y").get_ylabel() == "S9.y [mm]"
    assert [line.get_label() for line in ideal.plot.forces().lines] == ["guide.F", "A.F"]
    assert [line.get_label() for line in run.plot.forces().lines] == ["A.F"]


@pytest.mark.parametrize("scenes", slow_but([("ideal",)], [("ideal",), ("dry",), ("a", "b", "c", "d", "e", "f", "g")]))
def test_any_number_of_scenes_can_be_drawn(
    scenes: tuple[str, ...], make: Callable[..., Result], tmp_path: Path
) -> None:
    runs = {scene: make(scene) for scene in scenes}
    plots.save_figure(plots.draw_run_figure(runs, make("ideal"), ["S9.y", "lift"]), tmp_path / "x.png")
    plots.save_figure(plots.draw_run_figure(runs, {}, ["A.F"]), tmp_path / "y.png")  # nothing to compare with
    assert (tmp_path / "x.png").stat().st_size > 10_000


def test_scenes_of_different_length_share_one_axis(make: Callable[..., Result]) -> None:
    runs = {"dry": make("dry"), "short": make("short", t_end=0.25)}
    references = {scene: make("ideal", t_end=run.t[-1]) for scene, run in runs.items()}
    assert plots.draw_run_figure(runs, references, ["S9.y"]).get_axes()[0].get_xlim() == (0.0, 1.0)


def test_a_series_of_nan_and_a_run_of_one_sample_can_be_drawn(run: Result, make: Callable[..., Result]) -> None:
    lost = replace(run, accelerations=np.full_like(run.a, np.nan), stored={})
    plots.draw_run_figure({"dry": lost}, make("ideal"), ["S9.y"])
    one = make("dry", samples=1)
    plots.draw_run_figure({"dry": one}, make("ideal", samples=1), ["S9.y"])


def test_a_failed_write_leaves_the_older_picture(run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.png"
    path.write_bytes(b"older")
    picture = plots.draw_run_figure({"dry": run}, {}, ["S9.y"])

    def fail(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(GudgeonError, match="No space left"):
        plots.save_figure(picture, path)
    assert path.read_bytes() == b"older" and list(tmp_path.iterdir()) == [path]


@settings(deadline=None)
@given(st.floats(1e-11, 1e11), st.sampled_from(["m", "N", "m/s", "N*m", "J"]))
def test_a_prefix_brings_a_number_near_one_and_does_not_change_it(size: float, unit: str) -> None:
    factor, text = choose_prefix(size, unit)
    prefix = text.removesuffix(format_unit(unit))
    power = next(exponent for exponent, name in PREFIXES.items() if name == prefix)
    assert math.isclose(factor * 10.0**power, 1.0)
    assert 0.099 <= size * factor < 3000


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.3e-3, "m", "0.3 mm"),
        (175.0, "N", "175 N"),
        (9e3, "N", "9 kN"),
        (1e-3, "kg", "0.001 kg"),
        (0.0, "m", "0 m"),
        (math.nan, "m", "–"),
        (math.inf, "N", "inf N"),
        (2e-6, "kg*m^2", "2e-06 kg·m²"),
        (5.0, "", "5"),
        (-0.02, "m/s^2", "-20 mm/s²"),
        (1e-8, "m^2", "1e-08 m²"),
    ],
)
def test_quantities_as_people_write_them(value: float, unit: str, text: str) -> None:
    assert format_quantity(value, unit) == text


def test_long_labels_stay_beside_their_axes(run: Result, ideal: Result) -> None:
    """Names of bodies are up to their owner: a label is folded until it is no taller than its row."""
    name = "the_rocker_of_the_second_stage.theta"
    picture = plots.draw_run_figure({"dry": run}, ideal, ["S9.y"])
    folded = plots._wrap_label(picture.subfigs[0].axes[0], f"error of {name} [mrad]")
    assert folded.replace("\n", " ").replace(". theta", ".theta") == f"error of {name} [mrad]"
    axes = picture.subfigs[0].axes[:3]
    for ax in axes:
        ax.set_ylabel(plots._wrap_label(ax, "error of second_rocker.theta [mrad]"))
    picture.draw_without_rendering()
    spans = sorted((ax.yaxis.label.get_window_extent() for ax in axes), key=lambda box: -box.y1)
    assert all(above.y0 >= below.y1 for above, below in zip(spans, spans[1:], strict=False))
    assert spans[0].y1 <= picture.bbox.y1


def test_a_long_title_leaves_the_legend_its_place(run: Result, ideal: Result) -> None:
    long = replace(run, source=replace(run.source, title="a word and " * 12), stored={})
    picture = plots.draw_run_figure({"dry": long}, ideal, ["S9.y"])
    picture.draw_without_rendering()
    title: Any = picture._suptitle  # type: ignore[attr-defined]
    title, legend = title.get_window_extent(), picture.legends[0].get_window_extent()
    assert title.x1 < legend.x0


def test_what_lies_beyond_the_horizon_is_marked_and_told(run: Result, ideal: Result) -> None:
    """Grey over time with a word in the legend, grey in the orbits; nothing where it holds to the end."""
    short = replace(run, diagnostics=replace(run.diagnostics, horizon=0.4), stored={})
    for shown, marked in ((short, True), (run, False)):
        picture = plots.draw_run_figure({"dry": shown}, ideal, ["S9.y"])
        message = [text.get_text() for text in picture.legends[0].get_texts()]
        assert ("unpredictable" in message) == marked
        lines: Any = picture.subfigs[1].axes[0].lines
        grey = [line for line in lines if line.get_color() == plots.UNPREDICTABLE]
        assert len(grey) == marked
    trusted = lines[0].get_xdata()
    part: Any = short.plot.orbit("A").lines
    known = int((run.t <= 0.4).sum())
    assert len(part[0].get_xdata()) == known < len(trusted)
    assert len(part[2].get_xdata()) == len(run.t) - known + 1  # from the last trusted sample on


def test_numbers_that_cannot_be_drawn_are_told(tmp_path: Path) -> None:
    """matplotlib finds no ticks near the largest number."""
    from matplotlib.figure import Figure

    picture = Figure()
    picture.subplots().plot([0.0, 1.0], [1e308, 1e308])
    with pytest.raises(GudgeonError, match="its values cannot be drawn"):
        plots.save_figure(picture, tmp_path / "x.png")
    assert not list(tmp_path.iterdir())


def test_a_notebook_shows_what_a_run_plots(run: Result, monkeypatch: pytest.MonkeyPatch) -> None:
    """A fresh one, without pyplot: IPython asks the last value of a cell for a picture."""
    monkeypatch.delitem(sys.modules, "matplotlib.pyplot", raising=False)
    for shown in (run.plot(), run.plot("S9.y", "A.F"), run.plot.series("S9.y"), run.plot.orbit("A"), run.plot.forces()):
        picture = shown._repr_png_()  # type: ignore[union-attr]
        assert picture is not None and picture.startswith(b"\x89PNG") and len(picture) > 5000


def test_pyplot_shows_its_own_figures_once(run: Result) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure: Any = run.plot()
    assert pyplot.fignum_exists(figure.number) and figure._repr_png_() is None
    pyplot.close(figure)


def test_a_run_plots_a_panel_for_each_unit(run: Result) -> None:
    panels = run.plot().get_axes()
    assert [ax.get_ylabel() for ax in panels] == ["S9.y [mm]", "crank.torque [N·m]", "A.F [N]"]
    assert len(run.plot("S9.y", "S9.x", "S9.vy").get_axes()) == 2
    drawn = np.asarray(panels[2].lines[0].get_ydata())
    assert drawn.max() >= run.diagnostics.peak("A").F  # the peaks of all steps too
    assert labels(run.plot(["S9.y", "A.F"])) == labels(run.plot("S9.y", "A.F"))


def test_angles_are_in_degrees_for_people(run: Result, ideal: Result) -> None:
    ax: Any = run.plot.series("L1.theta")
    assert ax.get_ylabel() == "L1.theta [°]"
    np.testing.assert_allclose(ax.lines[0].get_ydata(), np.degrees(run["L1.theta"]))
    assert run.plot.series("L1.omega").get_ylabel() == "L1.omega [°/s]"
    assert labels(plots.draw_run_figure({"ideal": ideal}, {}, ["L1.theta"]))[:3] == [
        "L1.theta [°]",
        "L1.omega [°/s]",
        "L1.alpha [°/s²]",
    ]


def test_ten_scenes_are_told_apart(make: Callable[..., Result]) -> None:
    """A colour and a circle each, the legend within the picture and beside nothing."""
    runs = {f"a_scene_{k}": make(f"a_scene_{k}") for k in range(10)}
    picture: Any = plots.draw_run_figure(runs, make("ideal"), ["S9.y"])
    assert len({*plots.choose_colours(10)}) == 10 and len({*plots.choose_colours(20)}) == 20
    assert len(picture.subfigs[1].axes) == 10
    picture.canvas.draw()
    legend = picture.legends[0].get_window_extent()
    assert legend.x0 >= 0 and legend.x1 <= picture.bbox.width
    assert len(picture.legends[0].get_texts()) == 11
    for part in picture.subfigs:
        for ax in part.axes:
            assert not legend.overlaps(ax.get_tightbbox())


def test_a_rate_that_is_watched_too_is_shown_once(run: Result, ideal: Result) -> None:
    found = labels(plots.draw_run_figure({"ideal": ideal, "dry": run}, ideal, ["S9.y", "S9.vy", "S9.y"]))
    shown = [name.removeprefix("error of S9.") for name in found if "S9." in name]
    assert shown == ["y [mm]", "vy [mm/s]", "ay [m/s²]"]
    names = [extreme.name for extreme in compute_scene_report(run, ideal, ("S9.y", "S9.vy")).motion]
    assert names == ["S9.y", "S9.vy", "S9.ay"]


def test_what_turns_by_rounding_alone_is_noise_where_nothing_turns(ideal: Result) -> None:
    """Beside speeds v over an extent r, what turned as far would have ω = v/r; 1e-9 of it is none."""
    report = compute_scene_report(ideal, None, ("S9.y",))
    extent = report.max_magnitudes["m"]
    assert (
        report.max_magnitudes["rad/s"] >= report.max_magnitudes["m/s"] / extent and report.max_magnitudes["rad"] >= 1.0
    )
    assert extent == max(np.abs(ideal.q[:, k]).max() for k in range(ideal.q.shape[1]) if k % 3 < 2)


def test_signs_without_a_font_are_told_once(ideal: Result, tmp_path: Path) -> None:
    named = replace(ideal, source=replace(ideal.source, title="機構"), stored={})
    with pytest.warns(UserWarning) as message:
        plots.save_figure(plots.draw_run_figure({"機": named}, named, ["S9.y"]), tmp_path / "x.png")
    assert len(message) == 1 and "機" in str(message[0].message)

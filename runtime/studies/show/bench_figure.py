"""Draw the work-precision diagram of `gudgeon bench`: error over run time and over right-hand sides, by method."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import matplotlib
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from gudgeon.contract.methods import KINEMATIC, METHODS
from gudgeon.integrators.peers.driver import NAMES
from gudgeon.language.text_output import format_figure_title
from gudgeon.results.figures.plots import COLOURS, IDEAL, STYLE
from gudgeon.studies.bench import RESOLUTION_FACTOR, Row, SceneBench
from gudgeon.studies.runs import Setting
from gudgeon.studies.show.tables import format_fraction, format_seconds

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARKERS = {method.name: method.marker for method in METHODS} | {"auto": "x", KINEMATIC: "D"}
# cross-checks are in the background: thin, dashed, grey or light blue, distinguished by their markers
CROSS_CHECK_MARKERS = dict(zip(NAMES, ("v", "<", ">", "p", "h", "P", "*"), strict=True))
GREY, CROSS_CHECK_COLOURS = "#666666", {"scipy": "#9a9a9a", "sundials": "#56B4E9"}


def draw_bench_figure(title: str, scene_benches: Sequence[SceneBench], marked_step: float | None = None) -> Figure:
    """Return the work-precision diagrams of `gudgeon bench`: a row of two axes for each scene, and a common legend.

    Scenes without references (dof = 0) are left out if another scene has some. Hollow markers and a shaded band show
    errors within the uncertainty of the references. marked_step (s): step of rk4 with a ring; None for none.
    """
    shown = [scene_bench for scene_bench in scene_benches if scene_bench.references] or list(scene_benches)
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(11, 1.2 + 3.6 * len(shown)), dpi=120, layout="constrained")
        axes = figure.subplots(len(shown), 2, squeeze=False, sharey="row")
        for (left, right), scene_bench in zip(axes, shown, strict=True):
            _draw_scene(left, right, scene_bench)
            if marked_step is not None and scene_bench.references:
                _mark_rk4_step(left, right, marked_step, scene_bench)
        used = dict.fromkeys(method for scene_bench in shown for method in scene_bench.methods)
        handles = [
            Line2D(
                [],
                [],
                color=_select_colour(m),
                marker=_select_marker(m),
                ls="--" if m in CROSS_CHECK_MARKERS else "-",
                ms=6,
                label=m,
            )
            for m in used
        ]
        label = "within the uncertainty of the references"
        handles.append(Line2D([], [], color=GREY, marker="o", mfc="white", ls="", ms=5, label=label))
        title_suffix = (
            " (partial: interrupted)" if any(scene_bench.interrupted for scene_bench in scene_benches) else ""
        )
        figure_title = format_figure_title(f"{title}: run time against error{title_suffix}", 110)
        figure.suptitle(figure_title, fontsize=12, fontweight="bold", x=0.012, ha="left")
        figure.legend(handles=handles, loc="outside lower center", ncols=5, fontsize=8.5)
    return figure


def _select_marker(method: str) -> str:
    """Return the matplotlib marker of a method, gudgeon's own or a cross-check such as "scipy:DOP853"."""
    return CROSS_CHECK_MARKERS.get(method) or MARKERS[method]


def _select_colour(method: str) -> str:
    """Return the colour of a method; all cross-checks of a package have the same one."""
    if method in CROSS_CHECK_MARKERS:
        return CROSS_CHECK_COLOURS[method.partition(":")[0]]
    return COLOURS[list(MARKERS).index(method) % len(COLOURS)]


def _draw_scene(time_axes: Axes, rhs_axes: Axes, scene_bench: SceneBench) -> None:
    """Draw the largest errors of one scene over the run time of the window and over right-hand sides, with log scales.

    Without right-hand sides (dof = 0), they are over the number of samples. Failed rows and zero errors are left out.
    Errors that the references do not resolve have hollow markers, below a shaded band.
    """
    for method in scene_bench.methods:
        rows = [row for row in scene_bench.list_rows(method) if not row.failure and row.error.largest > 0]
        errors = [row.error.largest for row in rows]
        colour, marker, check = _select_colour(method), _select_marker(method), method in CROSS_CHECK_MARKERS
        times = [row.seconds * scene_bench.t_end * 1e3 for row in rows]
        for ax, x in ((time_axes, times), (rhs_axes, [row.right_hand_sides or row.samples for row in rows])):
            dashes, width, z = ("--", 0.8, 1.9) if check else ("-", 1.3, 2)
            ax.plot(x, errors, dashes, color=colour, lw=width, zorder=z)
            for x_value, error, row in zip(x, errors, rows, strict=True):
                face = colour if _is_resolved(scene_bench, row) else "white"
                edge = {"c": [colour]} if marker == "x" else {"c": [face], "edgecolors": colour}
                ax.scatter([x_value], [error], s=18 if check else 26, marker=marker, linewidths=1.1, zorder=3, **edge)
    time_axes.set(xscale="log", yscale="log", xlabel="run time of the window [ms]", ylabel="largest error")
    rhs_axes.set(xscale="log", xlabel="right-hand sides" if scene_bench.references else "samples")
    time_axes.set_title(f"{scene_bench.scene}, the first {format_seconds(scene_bench.t_end)}", loc="left", fontsize=9.5)
    unresolved_limit = RESOLUTION_FACTOR * scene_bench.reference_difference.largest
    if math.isfinite(unresolved_limit) and unresolved_limit > time_axes.get_ylim()[0]:
        bottom = time_axes.get_ylim()[0]
        for ax in (time_axes, rhs_axes):
            ax.axhspan(bottom, unresolved_limit, color="#eeeeee", zorder=0)
        time_axes.set_ylim(bottom=bottom)


def _is_resolved(scene_bench: SceneBench, row: Row) -> bool:
    """Return whether the largest error measure of a row is resolved by the references; True without references."""
    return (
        any(
            getattr(row.error, m) == row.error.largest and scene_bench.is_resolved(m, row.error.largest)
            for m in ("motion", "path", "force")
        )
        or not scene_bench.references
    )


def _mark_rk4_step(time_axes: Axes, rhs_axes: Axes, step: float, scene_bench: SceneBench) -> None:
    """Draw a ring around the points of rk4 with this step (s), and write its force error above the right axes.

    A failed row has the time of its failure there, without a ring. A step that was not measured draws nothing.
    """
    row = scene_bench.find_row(Setting("rk4", step))
    if row is None:
        return
    if row.failure or not row.error.largest > 0:
        text = f"rk4, {format_seconds(step)}: failed at {format_seconds(row.failed_at)}"
        rhs_axes.set_title(text, loc="right", fontsize=8.5, color=_select_colour("rk4"))
        return
    for ax, x in ((time_axes, row.seconds * scene_bench.t_end * 1e3), (rhs_axes, row.right_hand_sides)):
        ax.plot([x], [row.error.largest], "o", ms=12, mfc="none", mec=IDEAL, mew=1.2, zorder=4)
    text = f"rk4, {format_seconds(step)}: force error {format_fraction(row.error.force)}"
    text += f", {scene_bench.contact / step:.1f} steps per contact" if math.isfinite(scene_bench.contact) else ""
    rhs_axes.set_title(text, loc="right", fontsize=8.5, color=_select_colour("rk4"))

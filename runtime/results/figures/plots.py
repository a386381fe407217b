"""Draw the figure that compares several scenes, and the parts that figures of one run share (run_plots.py).

matplotlib is imported with this module, hence only for drawing, and pyplot only if the caller uses it: no display is
needed, and no figure stays in memory.
"""

from __future__ import annotations

import io
import os
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.drawing.picture import report_missing_glyphs
from gudgeon.errors import GudgeonError, shorten_path
from gudgeon.files.writing import write_bytes
from gudgeon.language.plot_units import choose_plot_unit, choose_prefix, format_label, format_quantity
from gudgeon.language.text_output import format_figure_title, format_one_line
from gudgeon.results.figures import joint_curves
from gudgeon.results.series import find_rate_names

import matplotlib  # isort: skip  (labels.py says where it is missing)
from matplotlib.figure import Figure  # isort: skip
from matplotlib.ticker import MaxNLocator  # isort: skip

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gudgeon.results.results import Result

# Okabe and Ito's palette: distinguished by readers with any of the common colour deficiencies
COLOURS = ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
IDEAL, UNPREDICTABLE = "#222222", "#888888"  # colours of the ideal scene, and of a run beyond its horizon
MAX_ORBIT_COLUMNS, MAX_LEGEND_ENTRIES = 4, 6  # orbits in a row; entries of a legend that fits next to the title
TITLE_WIDTH = 66  # characters of a line, next to which the legend fits
STYLE = {
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#888888",
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "xtick.color": "#444444",
    "ytick.color": "#444444",
    "agg.path.chunksize": 20000,
    "text.usetex": False,
}


def choose_colours(count: int) -> list[str]:
    """Return `count` colours, as texts "#rrggbb", for curves in one panel; distinct up to twenty, then repeated."""
    if count <= len(COLOURS):
        return list(COLOURS[:count])
    table_colours = [matplotlib.colors.to_hex(matplotlib.colormaps["tab20"](k)) for k in range(20)]
    reordered_colours = [*table_colours[::2], *table_colours[1::2]]  # the strong ones first
    return [reordered_colours[i % len(reordered_colours)] for i in range(count)]


def find_largest_magnitude(values: Any) -> float:
    """Return the largest magnitude of the values, without NaN; 0 if there are no values."""
    return float(np.nanmax(np.abs(values), initial=0.0))


def format_caption(run: Result) -> str:
    """Return mechanism and scene as a caption, as in `gudgeon draw`."""
    return f"{format_one_line(run.source.title or run.source.mechanism)}: {run.source.scene}"


def compute_orbit_half_width(run: Result, joint: str) -> float:
    """Return half the side of a square that contains a journal's orbit and its clearance circle, in units of c.

    It is 1.04 (a margin of 4 %) times the larger of 1 and the largest radius of the orbit divided by c.
    """
    _, x, y = joint_curves.get_journal_path(run, joint)
    return 1.04 * max(1.0, find_largest_magnitude(np.hypot(x, y)) / run.constants[f"{joint}.c"])


def _get_horizon_within_run(run: Result) -> float | None:
    """Return the predictability horizon (s) if it lies within the run, else None."""
    horizon = run.diagnostics.horizon
    return horizon if np.isfinite(horizon) and horizon < run.t[-1] else None


def mark_predictability_horizon(ax: Axes, run: Result, colour: str) -> None:
    """Mark the predictability horizon of a run on a time axis: a dotted line, and a grey background after it.

    Nothing is drawn if the horizon is unknown or beyond the end.
    """
    if (horizon := _get_horizon_within_run(run)) is not None:
        ax.axvspan(horizon, float(run.t[-1]), color=UNPREDICTABLE, alpha=0.1, lw=0, zorder=0)
        ax.axvline(horizon, color=colour, lw=0.8, ls=":", zorder=1)


def draw_orbit(ax: Axes, run: Result, joint: str, colour: str, half_width: float) -> None:
    """Draw the path of a journal, e/c, in its clearance circle, with dots where the surfaces are in contact (e ≥ c).

    A ring marks the start. Beyond the predictability horizon the path is grey. `half_width` is half the side of the
    square, in units of c.
    """
    c = run.constants[f"{joint}.c"]
    t, x, y = joint_curves.get_journal_path(run, joint)
    x, y, angle = x / c, y / c, np.linspace(0.0, 2 * np.pi, 181)
    ax.fill(np.cos(angle), np.sin(angle), facecolor="#f6f6f6", edgecolor="#777777", lw=0.9, zorder=1)
    end_time = _get_horizon_within_run(run) or float(run.t[-1])
    touching, is_reliable = np.hypot(x, y) >= 1.0, t <= end_time
    is_after = t >= t[is_reliable][-1]  # from the last point before the horizon on, so that the path has no gap
    ax.plot(x[is_reliable], y[is_reliable], color=colour, lw=0.7, alpha=0.8, zorder=2)
    ax.plot(x[touching & is_reliable], y[touching & is_reliable], ".", color=colour, ms=1.4, zorder=3)
    if not is_reliable.all():
        ax.plot(x[is_after], y[is_after], color=UNPREDICTABLE, lw=0.5, alpha=0.6, zorder=1.5)
    ax.plot(x[:1], y[:1], "o", ms=4, mfc="white", mec=IDEAL, mew=0.9, zorder=4)
    ax.set(xlim=(-half_width, half_width), ylim=(-half_width, half_width), aspect="equal", xticks=[], yticks=[])
    factor, text = choose_prefix(c, "m")
    ax.set_title(f"{joint}, {run.source.scene}: c = {c * factor:.4g} {text}")
    ax.spines[:].set_visible(False)


def draw_run_figure(
    runs: Mapping[str, Result], reference: Result | Mapping[str, Result], watched_series: Sequence[str]
) -> Figure:
    """Return the figure of `gudgeon run`, the effect of play by scene.

    Left: error of the first two watched series against the ideal scene, with their rates, and the forces at the joints
    with play. Right: the mechanism at its start, and journal orbits. `reference` is the ideal run at the same times and
    parameters, one for all scenes or one for each. Scenes without play are shown without comparison.
    """
    runs_with_play = {scene: run for scene, run in runs.items() if run.source.clearances}
    references = dict(reference) if isinstance(reference, Mapping) else dict.fromkeys(runs_with_play, reference)
    shown_runs = runs_with_play or dict(runs)
    colours = dict(
        zip(
            shown_runs,
            choose_colours(len(shown_runs)) if runs_with_play else [IDEAL, *choose_colours(len(shown_runs) - 1)],
            strict=True,
        )
    )
    force_panels = joint_curves.assign_panels(runs_with_play.values())
    derived_series = {
        name for position_name in watched_series for name in find_rate_names(position_name)
    }  # shown below what they are rates of
    watched_series = [name for name in dict.fromkeys(watched_series) if name not in derived_series][:2]
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(12, 9), dpi=100)
        figure.set_layout_engine("constrained", w_pad=0.06, h_pad=0.05, hspace=0.03, wspace=0.02)
        first_run, available_series = (
            next(iter(runs.values())),
            {name for run in runs_with_play.values() for name in run.names},
        )
        journals = [
            name.removesuffix(".F")
            for name, *_ in force_panels.values()
            if name.count(".") == 1 and f"{name[:-1]}ex" in available_series
        ]
        curves_area, mechanism_area, orbits_area = _split_figure(
            figure, len(runs_with_play) if journals else 0, bool(first_run.source.parts)
        )
        n_rows = 3 + len(force_panels)
        grid = curves_area.add_gridspec(n_rows, max(1, len(watched_series)))
        for column, name in enumerate(watched_series):
            _draw_motion_column(
                curves_area, grid, column, shown_runs, references if runs_with_play else {}, name, colours
            )
        forces = [curves_area.add_subplot(grid[3 + k, :]) for k in range(len(force_panels))]
        _draw_forces(forces, force_panels, runs_with_play, references, colours)
        curves_area.align_ylabels()
        if mechanism_area is not None:
            _draw_mechanism(mechanism_area, first_run)
        if orbits_area is not None:
            _draw_orbits(orbits_area, journals, runs_with_play, colours)
        _draw_title_and_legend(figure, shown_runs, colours, bool(runs_with_play))
    return figure


def _split_figure(figure: Figure, n_orbits: int, has_mechanism: bool) -> tuple[Any, Any, Any]:
    """Return the subfigures for curves over time, for the mechanism and for orbits; None for an empty one.

    `n_orbits` is the number of columns of orbits, 0 for none.
    """
    if not (n_orbits or has_mechanism):
        return figure.subfigures(1, 1), None, None
    areas: Any = figure.subfigures(1, 2, width_ratios=[1.0, 0.5 if n_orbits == 1 and not has_mechanism else 0.9])
    left_area, right_area = areas
    if not (n_orbits and has_mechanism):
        return left_area, right_area if has_mechanism else None, right_area if n_orbits else None
    upper_area, lower_area = right_area.subfigures(2, 1, height_ratios=[0.8, 1.0])
    return left_area, upper_area, lower_area


def _draw_mechanism(subfigure: Any, run: Result) -> None:
    """Draw the mechanism at the start of the run in a subfigure, with the time as title."""
    from gudgeon.drawing.picture import draw_sketch
    from gudgeon.results.figures.mechanism_plots import draw_start_sketch

    ax = subfigure.add_subplot()
    draw_sketch(ax, draw_start_sketch(run))
    ax.set_title(f"t = {format_quantity(float(run.t[0]), 's', 6)}")


def _draw_motion_column(
    subfigure: Any,
    grid: Any,
    column: int,
    runs: Mapping[str, Result],
    references: Mapping[str, Result],
    series_name: str,
    colours: Mapping[str, str],
) -> None:
    """Draw a series, its velocity and its acceleration in three rows of a column of the grid.

    `runs`, `references` and `colours` are by scene. If any scene has a reference with the series, only the differences
    from references are drawn. A series without rates spans the three rows. A series that no scene has is left out.
    """
    names = [series for series in (series_name, *find_rate_names(series_name)) if series]
    for row, series in enumerate(names):
        compared_scenes = [scene for scene in runs if scene in references and series in references[scene]]
        values_by_scene = {scene: runs[scene][series] - references[scene][series] for scene in compared_scenes}
        if not values_by_scene:
            values_by_scene = {scene: run[series] for scene, run in runs.items() if series in run}
        if not values_by_scene:
            continue
        ax = subfigure.add_subplot(grid[row, column] if len(names) > 1 else grid[:3, column])
        factor, text = choose_plot_unit(
            max(map(find_largest_magnitude, values_by_scene.values())), runs[next(iter(values_by_scene))].unit(series)
        )
        for scene, values in values_by_scene.items():
            ax.plot(runs[scene].t, values * factor, color=colours[scene], lw=0.9)
            mark_predictability_horizon(ax, runs[scene], colours[scene])
        quantity_name = f"error of {series}" if compared_scenes else series
        _format_time_axis(
            ax, format_label(quantity_name, text), [runs[scene].t for scene in values_by_scene], row == len(names) - 1
        )


def _draw_forces(
    axes: Sequence[Axes],
    panels: Mapping[str, Sequence[str]],
    runs: Mapping[str, Result],
    references: Mapping[str, Result],
    colours: Mapping[str, str],
) -> None:
    """Draw the force panels: forces in every scene, with their peaks (▾), and the ideal reaction over them, dashed.

    `panels` has the names of the series of each panel by title, in the order of `axes`. `runs`, the ideal runs
    `references` and `colours` are by scene. The ideal reaction is the first series of the panel in the reference that
    ends last. Scenes without a series of the panel are left out.
    """
    for ax, (title, names) in zip(axes, panels.items(), strict=True):
        available = [(scene, run, name) for scene, run in runs.items() for name in names if name in run]
        curves = [(*joint_curves.get_curve(run, name), colours[scene], 0.8, "-") for scene, run, name in available]
        ideal_run = max(
            (reference for reference in references.values() if names[0] in reference),
            key=lambda reference: reference.t[-1],
            default=None,
        )
        if ideal_run is not None:
            curves.append((ideal_run.t, ideal_run[names[0]], IDEAL, 1.0, "--"))
        max_magnitude = max((find_largest_magnitude(values) for _, values, *_ in curves), default=0.0)
        factor, text = choose_prefix(max_magnitude, available[0][1].unit(names[0]))
        for t, values, colour, width, dashes in curves:
            ax.plot(t, values * factor, color=colour, lw=width, ls=dashes)
        for scene, run, name in available:
            mark_predictability_horizon(ax, run, colours[scene])
            for time, peak in joint_curves.find_peaks(run, name):
                ax.plot([time], [peak * factor], "v", color=colours[scene], ms=4, clip_on=False)
        if names[0].endswith(".F"):
            ax.set_ylim(bottom=0)
        _format_time_axis(ax, format_label(title, text), [t for t, *_ in curves], ax is axes[-1])


def _format_time_axis(ax: Axes, y_label: str, times: Sequence[Any], is_last_row: bool) -> None:
    """Set the labels, limits and ticks of axes over time.

    `y_label` is wrapped to the height of the axes. The limits contain all `times`, the time arrays of the curves. Only
    the last row of a column has the label and tick labels of the time.
    """
    ax.set_ylabel(_wrap_label(ax, y_label))
    start, end = min(float(t[0]) for t in times), max(float(t[-1]) for t in times)
    ax.set_xlim(start, end if end > start else start + 1.0)
    ax.tick_params(labelbottom=is_last_row)
    if is_last_row:
        factor, time_unit = choose_prefix(end, "s")
        ax.xaxis.set_major_formatter(lambda t, _: f"{t * factor:g}")
        ax.set_xlabel(format_label("t", time_unit))
    ax.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 2.5, 5, 10], min_n_ticks=3))


def _wrap_label(ax: Axes, label: str) -> str:
    """Return a y label with line breaks, such that its lines are no longer than the height of its axes.

    The length of a line is estimated from the font size and the rows of the grid, without a renderer; at least 8
    characters fit. Too long words are broken before their dots.
    """
    spec = ax.get_subplotspec()
    n_spanned = spec.rowspan.stop - spec.rowspan.start if spec else 1
    n_rows = spec.get_gridspec().nrows if spec else 1
    points = 72 * ax.figure.bbox.height / ax.figure.dpi * 0.85 * n_spanned / n_rows
    width = max(8, int(points / (0.58 * float(ax.yaxis.label.get_fontsize()))))
    tokens = [token if len(token) <= width else token.replace(".", ".\u200b") for token in label.split(" ")]
    lines = textwrap.wrap(" ".join(tokens).replace("\u200b", " \u200b"), width, break_long_words=False)
    return "\n".join(lines).replace(" \u200b", "").replace("\u200b", "")


def _draw_orbits(subfigure: Any, joints: Sequence[str], runs: Mapping[str, Result], colours: Mapping[str, str]) -> None:
    """Draw an orbit for each joint (down) and scene (across, in several rows if needed), all to one scale.

    A row has at most MAX_ORBIT_COLUMNS scenes. Joints without an eccentricity in a scene are left out there.
    """
    scenes = list(runs)
    n_columns = min(len(scenes), MAX_ORBIT_COLUMNS)
    n_rows = -(-len(scenes) // n_columns)
    grid = subfigure.add_gridspec(len(joints) * n_rows, n_columns)
    joint_scenes = [(joint, scene) for joint in joints for scene in scenes if f"{joint}.e" in runs[scene]]
    half_width = max(
        compute_orbit_half_width(runs[scene], joint) for joint, scene in joint_scenes
    )  # one scale: all circles are equally large
    for joint, scene in joint_scenes:
        row, column = divmod(scenes.index(scene), n_columns)
        cell = grid[joints.index(joint) * n_rows + row, column]
        ax = subfigure.add_subplot(cell)
        draw_orbit(ax, runs[scene], joint, colours[scene], half_width)
        if n_rows > 1:  # the title would be wider than its circle
            ax.set_title(f"{joint}, {scene}", fontsize=7.5)
    subfigure.supxlabel(
        "journal in the circle e = c, ○ start\nforces: ▾ peak of all steps", fontsize=9, color="#444444"
    )


def _draw_title_and_legend(
    figure: Figure, runs: Mapping[str, Result], colours: Mapping[str, str], has_reference: bool
) -> None:
    """Draw the title of the mechanism and one legend for all panels.

    It has an entry for each scene in `colours`, for the ideal reference if `has_reference`, and for the time beyond the
    predictability horizon. The legend is next to the title, or below all panels if it has more than MAX_LEGEND_ENTRIES
    entries.
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    run = next(iter(runs.values()))
    title = format_figure_title(run.source.title or run.source.mechanism, TITLE_WIDTH)
    figure.suptitle(title, fontsize=13, fontweight="bold", x=0.012, ha="left")
    labels = {scene: f"{scene}{_format_early_end(scene, runs)}" for scene in colours}
    handles: list[Any] = [Line2D([], [], color=colour, lw=2.2, label=labels[s]) for s, colour in colours.items()]
    if has_reference:
        handles.append(Line2D([], [], color=IDEAL, lw=1.4, ls="--", label="ideal"))
    if any(_get_horizon_within_run(run) is not None for run in runs.values()):
        handles.append(Patch(facecolor=UNPREDICTABLE, alpha=0.25, lw=0, label="unpredictable"))
    if len(handles) > MAX_LEGEND_ENTRIES:  # outside, below all panels
        figure.legend(
            handles=handles, loc="outside lower center", ncols=min(len(handles), MAX_LEGEND_ENTRIES), fontsize=9.5
        )
        return
    figure.legend(handles=handles, loc="upper right", ncols=len(handles), fontsize=9.5, bbox_to_anchor=(0.995, 0.998))


def _format_early_end(scene: str, runs: Mapping[str, Result]) -> str:
    """Return ", to 0.2 s" for a scene whose run ends before the last end of the runs, else ""."""
    run_end, last_end = (float(max(run.t[-1] for run in some_runs)) for some_runs in ([runs[scene]], runs.values()))
    return f", to {run_end:.4g} s" if run_end < (1.0 - 1e-9) * last_end else ""


def save_figure(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure to a file in the format of its suffix, under a temporary name that is then moved into place.

    The file has neither date nor version. Raises GudgeonError if matplotlib cannot draw the numbers, OutputError if
    writing fails.
    """
    path, buffer = Path(path), io.BytesIO()
    suffix = path.suffix.lower().removeprefix(".") or None
    try:
        with report_missing_glyphs():
            figure.savefig(buffer, format=suffix, metadata={"Software": None} if suffix == "png" else None)
    except (ValueError, ArithmeticError) as error:  # matplotlib finds no ticks for numbers near the largest double
        message = f"no figure {shorten_path(path)}: its values cannot be drawn ({error})"
        raise GudgeonError(f"{message}\n  choose other series") from error
    write_bytes(path, buffer.getvalue())

"""Draw the figure of `gudgeon map`: a stability map, with the verdict on each run over two varied quantities."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import matplotlib
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from gudgeon.language.text_output import format_figure_title
from gudgeon.results.figures.plots import IDEAL, STYLE
from gudgeon.studies.map import VerdictMap
from gudgeon.studies.show.map import describe_comparison, explain_labels, format_axis_value
from gudgeon.studies.show.tables import format_seconds
from gudgeon.studies.verdicts import Cell, Status

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FILL = {
    Status.STABLE: "#a8d8c0",
    Status.OUTSIDE: "#c9c9c9",
    Status.INACCURATE: "#f6d48f",
    Status.DIVERGED: "#e79a78",
    Status.MISSING: "#f4f4f4",
}
NAMES = {"step": "step", "rtol": "tolerance", "clearance": "radial clearance"}


def draw_map_figure(title: str, maps: Sequence[VerdictMap], marked_step: float | None = None) -> Figure:
    """Return the figure with a panel for each map (scene), in which a cell has the colour of its verdict and its label.

    title: of the mechanism. marked_step (s): step whose row gets a frame; None for none.
    """
    columns = max(len(verdict_map.columns.values) for verdict_map in maps)
    rows = max(len(verdict_map.rows.values) for verdict_map in maps)
    with matplotlib.rc_context(STYLE):
        width = max(6.5, len(maps) * (1.1 + 0.82 * columns))
        figure = Figure(figsize=(width, 2.0 + 0.42 * rows), dpi=120, layout="constrained")
        axes = figure.subplots(1, len(maps), squeeze=False)[0]
        for ax, verdict_map in zip(axes, maps, strict=True):
            _draw_map(ax, verdict_map, marked_step)
        axes[0].set_ylabel(NAMES.get(maps[0].rows.name, maps[0].rows.name))
        used = {cell.status for verdict_map in maps for cell in verdict_map.cells}
        handles: list[Any] = [Patch(facecolor=FILL[s], label=s.value) for s in Status if s in used]
        if marked_step is not None and any(
            _is_marked(verdict_map, y, marked_step) for verdict_map in maps for y in verdict_map.rows.values
        ):
            handles.append(
                Patch(facecolor="none", edgecolor=IDEAL, lw=1.6, label=f"step {format_seconds(marked_step)}")
            )
        subject = "stable steps" if maps[0].rows.name == "step" else "verdicts on the runs"
        title_suffix = " (partial: interrupted)" if any(verdict_map.interrupted for verdict_map in maps) else ""
        figure_title = format_figure_title(f"{title}: {subject}{title_suffix}", int(10 * width))
        figure.suptitle(figure_title, fontsize=12, fontweight="bold", x=0.012, ha="left")
        descriptions = (
            f"{verdict_map.scene}: checked over {format_seconds(verdict_map.t_long)}, "
            f"{describe_comparison(verdict_map)}"
            for verdict_map in maps
        )
        legend_title = "\n".join([explain_labels(maps), *descriptions])
        figure.legend(
            handles=handles, loc="outside lower center", ncols=5, fontsize=9, title=legend_title, title_fontsize=8
        )
    return figure


def _draw_map(ax: Axes, verdict_map: VerdictMap, marked_step: float | None) -> None:
    """Draw the cells of one map on its axes, with ticks and title, and a frame around the row of the marked step (s).

    marked_step: None for no frame.
    """
    rows, columns = verdict_map.rows.values, verdict_map.columns.values
    for i, y in enumerate(rows):
        for j, x in enumerate(columns):
            _draw_cell(ax, i, j, verdict_map.get_cell(y, x))
        if _is_marked(verdict_map, y, marked_step):
            ax.add_patch(Rectangle((-0.5, i - 0.5), len(columns), 1, fill=False, ec=IDEAL, lw=1.8, zorder=4))
    limits = {"xlim": (-0.5, len(columns) - 0.5), "ylim": (-0.5, len(rows) - 0.5)}
    ax.set(**limits, title=f"{verdict_map.scene}, {verdict_map.setting.method}")
    ax.set_yticks(range(len(rows)), [format_axis_value(verdict_map.rows, y) for y in rows])
    ax.set_xticks(range(len(columns)), [format_axis_value(verdict_map.columns, x) for x in columns])
    ax.set_xlabel(
        NAMES.get(verdict_map.columns.name, verdict_map.columns.name) if verdict_map.columns.ratios else "no play"
    )
    ax.grid(False)
    ax.tick_params(length=0)
    ax.spines[:].set_visible(False)


def _is_marked(verdict_map: VerdictMap, row: float, step: float | None) -> bool:
    """Return whether the rows of a map are steps and `row` equals the marked step to rounding; False for None."""
    return verdict_map.rows.name == "step" and step is not None and math.isclose(row, step)


def _draw_cell(ax: Axes, row: int, column: int, cell: Cell) -> None:
    """Draw one cell as a rectangle of unit size at (column, row), in the colour of its verdict with its label."""
    ax.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, facecolor=FILL[cell.status], edgecolor="white", lw=1.5))
    ax.text(column, row, cell.label, ha="center", va="center", fontsize=7.5, color="#333333", zorder=3)

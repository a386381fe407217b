"""Draw the figure of `gudgeon map --box`: scatter plot and parallel coordinates of the verdicts in a parameter box."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from gudgeon.language.plot_units import format_label, format_quantity, format_unit
from gudgeon.language.text_output import format_figure_title
from gudgeon.model.compiled import Array
from gudgeon.results.figures.plots import IDEAL, STYLE
from gudgeon.studies.box import Range
from gudgeon.studies.map import VerdictBox
from gudgeon.studies.show.box import describe_verdict_counts
from gudgeon.studies.show.tables import format_seconds
from gudgeon.studies.verdicts import SEVERITY, Status

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# colour and marker of each verdict; darker than the fills of a map, since markers are small
MARKER_STYLES = {
    Status.STABLE: ("#009E73", "o"),
    Status.OUTSIDE: ("#8a8a8a", "D"),
    Status.INACCURATE: ("#E69F00", "^"),
    Status.DIVERGED: ("#D55E00", "X"),
    Status.MISSING: ("#cccccc", "."),
}


def draw_box_figure(title: str, boxes: Sequence[VerdictBox]) -> Figure:
    """Return the figure of `gudgeon map --box` with a row of axes for each box (scene).

    The left axes are a scatter plot over the two ranges that correlate most with the verdict. With more than two
    ranges, the right axes show parallel coordinates.
    """
    has_parallel_coordinates = max(len(box.ranges) for box in boxes) > 2
    with matplotlib.rc_context(STYLE):
        figure = Figure(
            figsize=(12.5 if has_parallel_coordinates else 7.5, 1.3 + 3.9 * len(boxes)), dpi=120, layout="constrained"
        )
        axes = figure.subplots(
            len(boxes),
            2 if has_parallel_coordinates else 1,
            squeeze=False,
            width_ratios=[1, 1.25] if has_parallel_coordinates else None,
        )
        for row, box in zip(axes, boxes, strict=True):
            _draw_scatter(row[0], box)
            if has_parallel_coordinates:
                _draw_parallel_coordinates(row[1], box)
        used = [s for s in reversed(SEVERITY) if any(cell.status is s for box in boxes for cell in box.cells)]
        handles = [
            Line2D([], [], color=MARKER_STYLES[s][0], marker=MARKER_STYLES[s][1], ls="", ms=6, label=s.value)
            for s in used
        ]
        handles.append(Line2D([], [], color="white", mec=IDEAL, marker="o", ls="", ms=7, label="a corner of the box"))
        title_suffix = " (partial: interrupted)" if any(box.interrupted for box in boxes) else ""
        figure_title = format_figure_title(
            f"{title}: verdicts in the box{title_suffix}", 125 if has_parallel_coordinates else 75
        )
        figure.suptitle(figure_title, fontsize=12, fontweight="bold", x=0.012, ha="left")
        figure.legend(handles=handles, loc="outside lower center", ncols=6, fontsize=9)
    return figure


def rank_ranges(box: VerdictBox) -> list[int]:
    """Return the indices of the ranges, sorted by the correlation of their logarithm with the verdict, largest first.

    If all verdicts are equal, the logarithm of the largest error is used instead of the verdict. Cells that are not
    judged do not count.
    """
    verdicts = [-SEVERITY.index(cell.status) for cell in box.cells]
    errors = [
        math.log10(max(cell.error.largest, 1e-16)) if cell.error.largest == cell.error.largest else math.nan
        for cell in box.cells
    ]
    is_judged = np.array([cell.status is not Status.MISSING for cell in box.cells])
    response = np.array(verdicts if len(set(np.array(verdicts)[is_judged])) > 1 else errors, dtype=np.float64)
    is_used = is_judged & np.isfinite(response)
    scores = [
        _compute_abs_correlation(np.log([point[range_.name] for point in box.points])[is_used], response[is_used])
        for range_ in box.ranges
    ]
    return sorted(range(len(box.ranges)), key=lambda k: -scores[k])


def _compute_abs_correlation(x: Array, y: Array) -> float:
    """Return the magnitude of the correlation coefficient of two arrays; 0 for fewer than two points or a constant."""
    if len(x) < 2 or not np.ptp(x) or not np.ptp(y):
        return 0.0
    return float(abs(np.corrcoef(x, y)[0, 1]))


def _sort_by_severity(box: VerdictBox) -> list[int]:
    """Return the indices of the points, sorted from the best to the worst verdict, which is thus drawn on top."""
    return sorted(range(len(box.cells)), key=lambda k: -SEVERITY.index(box.cells[k].status))


def _select_marker_style(box: VerdictBox, k: int) -> dict[str, Any]:
    """Return the keyword arguments of `scatter` for point k: colour and marker by its verdict, size and edge.

    Corners of the box, the first 2^n points, are larger and have a dark edge.
    """
    colour, marker = MARKER_STYLES[box.cells[k].status]
    corner = k < 2 ** len(box.ranges)
    return {
        "c": [colour],
        "marker": marker,
        "s": 52 if corner else 26,
        "edgecolors": IDEAL if corner else colour,
        "linewidths": 0.9 if corner else 0.4,
    }


def _draw_scatter(ax: Axes, box: VerdictBox) -> None:
    """Draw a scatter plot of the points of a box over the two first ranges of `rank_ranges`.

    For a box of one range the vertical axis is the largest error.
    """
    order = rank_ranges(box)
    x_range = box.ranges[order[0]]
    y_range = box.ranges[order[1]] if len(order) > 1 else None
    for z, k in enumerate(_sort_by_severity(box)):
        error = max(box.cells[k].error.largest, 1e-16)  # NaN stays NaN, and the point is not drawn
        ax.scatter(
            [box.points[k][x_range.name]],
            [box.points[k][y_range.name] if y_range else error],
            zorder=3 + z / 1e4,
            **_select_marker_style(box, k),
        )
    ax.set(
        xscale="log",
        yscale="log",
        xlabel=_format_range_label(x_range),
        ylabel=_format_range_label(y_range) if y_range else "largest error",
    )
    ax.set_title(
        f"{box.scene}, {box.setting.method} at {box.setting}, {format_seconds(box.t_long)} per point\n"
        f"{describe_verdict_counts(box.cells).partition(';')[0]}",
        loc="left",
    )
    if len(box.ranges) > 2:
        ax.annotate(
            "the two ranges with the largest correlation; the worst verdicts on top",
            (0.0, -0.2),
            xycoords="axes fraction",
            fontsize=8,
            color="#666666",
            annotation_clip=False,
        )


def _draw_parallel_coordinates(ax: Axes, box: VerdictBox) -> None:
    """Draw the parallel coordinates of a box: a vertical axis for each range, and a line across all axes for each
    point.

    A line has the colour of its verdict; failed points have thicker lines.
    """
    logs = [(math.log(range_.low), math.log(range_.high)) for range_ in box.ranges]
    for z, k in enumerate(_sort_by_severity(box)):
        fractions = [
            (math.log(box.points[k][range_.name]) - low) / ((high - low) or 1.0)
            for range_, (low, high) in zip(box.ranges, logs, strict=True)
        ]
        status = box.cells[k].status
        failed = status in (Status.DIVERGED, Status.INACCURATE)
        ax.plot(
            range(len(fractions)),
            fractions,
            color=MARKER_STYLES[status][0],
            lw=1.3 if failed else 0.7,
            alpha=0.9 if failed else 0.35,
            zorder=2 + z / 1e4,
        )
    ax.set(xlim=(-0.3, len(box.ranges) - 0.7), ylim=(-0.04, 1.04), yticks=[])
    names = [f"{format_quantity(range_.low, range_.unit, 3)}\n{_format_range_label(range_)}" for range_ in box.ranges]
    ax.set_xticks(range(len(names)), names)
    for k, range_ in enumerate(box.ranges):
        ax.axvline(k, color="#888888", lw=0.8, zorder=1)
        ax.annotate(
            format_quantity(range_.high, range_.unit, 3), (k, 1.05), ha="center", fontsize=8, annotation_clip=False
        )
    ax.set_title("one line per point, over all ranges\n", loc="left")
    ax.grid(False)
    ax.spines[:].set_visible(False)


def _format_range_label(range_: Range) -> str:
    """Return the label of the axis of a range: the last two parts of its address, with its unit."""
    return format_label(".".join(range_.name.split(".")[-2:]), format_unit(range_.unit))

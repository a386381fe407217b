"""Draw the figure of `gudgeon map --box`: the verdicts over the box."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from gudgeon.language.plot_units import label, pretty, quantity
from gudgeon.language.shown import figure_title
from gudgeon.model.compiled import Array
from gudgeon.results.figures.plots import IDEAL, STYLE
from gudgeon.studies.box import Range
from gudgeon.studies.map import VerdictBox
from gudgeon.studies.show.box import count
from gudgeon.studies.show.tables import seconds
from gudgeon.studies.verdicts import SEVERITY, Status

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# darker than the fills of a map: markers are small
LOOK = {
    Status.STABLE: ("#009E73", "o"),
    Status.OUTSIDE: ("#8a8a8a", "D"),
    Status.INACCURATE: ("#E69F00", "^"),
    Status.DIVERGED: ("#D55E00", "X"),
    Status.MISSING: ("#cccccc", "."),
}


def box_figure(title: str, found: Sequence[VerdictBox]) -> Figure:
    """Return the figure with a row for each scene: verdicts over the two most decisive ranges, and points across all
    ranges.
    """
    wide = max(len(box.ranges) for box in found) > 2
    with matplotlib.rc_context(STYLE):
        picture = Figure(figsize=(12.5 if wide else 7.5, 1.3 + 3.9 * len(found)), dpi=120, layout="constrained")
        axes = picture.subplots(len(found), 2 if wide else 1, squeeze=False, width_ratios=[1, 1.25] if wide else None)
        for row, box in zip(axes, found, strict=True):
            _draw_scatter(row[0], box)
            if wide:
                _draw_parallel_axes(row[1], box)
        used = [s for s in reversed(SEVERITY) if any(cell.status is s for box in found for cell in box.cells)]
        handles = [Line2D([], [], color=LOOK[s][0], marker=LOOK[s][1], ls="", ms=6, label=s.value) for s in used]
        handles.append(Line2D([], [], color="white", mec=IDEAL, marker="o", ls="", ms=7, label="a corner of the box"))
        message = " (partial: interrupted)" if any(box.interrupted for box in found) else ""
        head = figure_title(f"{title}: where does it fail?{message}", 125 if wide else 75)
        picture.suptitle(head, fontsize=12, fontweight="bold", x=0.012, ha="left")
        picture.legend(handles=handles, loc="outside lower center", ncols=6, fontsize=9)
    return picture


def rank_ranges(box: VerdictBox) -> list[int]:
    """Return the indices of the ranges, sorted by the correlation of their logarithms with the verdict.

    If all verdicts agree, the largest error is used instead.
    """
    verdicts = [-SEVERITY.index(cell.status) for cell in box.cells]
    errors = [
        math.log10(max(cell.error.largest, 1e-16)) if cell.error.largest == cell.error.largest else math.nan
        for cell in box.cells
    ]
    judged = np.array([cell.status is not Status.MISSING for cell in box.cells])
    worth = np.array(verdicts if len(set(np.array(verdicts)[judged])) > 1 else errors, dtype=np.float64)
    kept = judged & np.isfinite(worth)
    scores = [
        _abs_correlation(np.log([point[edge.name] for point in box.points])[kept], worth[kept]) for edge in box.ranges
    ]
    return sorted(range(len(box.ranges)), key=lambda k: -scores[k])


def _abs_correlation(x: Array, y: Array) -> float:
    """Return |correlation| of two arrays; 0 if one of them does not vary."""
    if len(x) < 2 or not np.ptp(x) or not np.ptp(y):
        return 0.0
    return float(abs(np.corrcoef(x, y)[0, 1]))


def _paint_order(box: VerdictBox) -> list[int]:
    """Return the points with the worst verdict last, so that it is painted on top."""
    return sorted(range(len(box.cells)), key=lambda k: -SEVERITY.index(box.cells[k].status))


def _marker_style(box: VerdictBox, k: int) -> dict[str, Any]:
    """Return the style of a point by its verdict; corners are larger."""
    colour, marker = LOOK[box.cells[k].status]
    corner = k < 2 ** len(box.ranges)
    return {
        "c": [colour],
        "marker": marker,
        "s": 52 if corner else 26,
        "edgecolors": IDEAL if corner else colour,
        "linewidths": 0.9 if corner else 0.4,
    }


def _draw_scatter(ax: Axes, box: VerdictBox) -> None:
    """Draw the points over the two most decisive ranges."""
    order = rank_ranges(box)
    across = box.ranges[order[0]]
    up = box.ranges[order[1]] if len(order) > 1 else None
    for z, k in enumerate(_paint_order(box)):
        error = max(box.cells[k].error.largest, 1e-16)  # NaN stays: nothing is drawn where there is no error
        ax.scatter(
            [box.points[k][across.name]],
            [box.points[k][up.name] if up else error],
            zorder=3 + z / 1e4,
            **_marker_style(box, k),
        )
    ax.set(xscale="log", yscale="log", xlabel=_range_label(across), ylabel=_range_label(up) if up else "largest error")
    ax.set_title(
        f"{box.scene}, {box.setting.method} at {box.setting}, {seconds(box.t_long)} a point\n"
        f"{count(box.cells).partition(';')[0]}",
        loc="left",
    )
    if len(box.ranges) > 2:
        ax.annotate(
            "the two ranges that tell most; the worst on top",
            (0.0, -0.2),
            xycoords="axes fraction",
            fontsize=8,
            color="#666666",
            annotation_clip=False,
        )


def _draw_parallel_axes(ax: Axes, box: VerdictBox) -> None:
    """Draw a vertical axis for each range and a line across them for each point."""
    logs = [(math.log(edge.low), math.log(edge.high)) for edge in box.ranges]
    for z, k in enumerate(_paint_order(box)):
        shares = [
            (math.log(box.points[k][edge.name]) - low) / ((high - low) or 1.0)
            for edge, (low, high) in zip(box.ranges, logs, strict=True)
        ]
        status = box.cells[k].status
        failed = status in (Status.DIVERGED, Status.INACCURATE)
        ax.plot(
            range(len(shares)),
            shares,
            color=LOOK[status][0],
            lw=1.3 if failed else 0.7,
            alpha=0.9 if failed else 0.35,
            zorder=2 + z / 1e4,
        )
    ax.set(xlim=(-0.3, len(box.ranges) - 0.7), ylim=(-0.04, 1.04), yticks=[])
    names = [f"{quantity(edge.low, edge.unit, 3)}\n{_range_label(edge)}" for edge in box.ranges]
    ax.set_xticks(range(len(names)), names)
    for k, edge in enumerate(box.ranges):
        ax.axvline(k, color="#888888", lw=0.8, zorder=1)
        ax.annotate(quantity(edge.high, edge.unit, 3), (k, 1.05), ha="center", fontsize=8, annotation_clip=False)
    ax.set_title("a line a point, across all ranges\n", loc="left")
    ax.grid(False)
    ax.spines[:].set_visible(False)


def _range_label(edge: Range) -> str:
    """Return the last two parts of an address with the unit as a label."""
    return label(".".join(edge.name.split(".")[-2:]), pretty(edge.unit))

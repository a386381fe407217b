"""Figures of `gudgeon bench` (run time against error) and `gudgeon stress` (a map of verdicts)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from gudgeon.bench import TRUSTED, Row, SceneBench
from gudgeon.measure.cells import Cell, Status
from gudgeon.measure.words import clearance, seconds, share
from gudgeon.plots import COLOURS, IDEAL, STYLE
from gudgeon.stress import StressMap

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MEASURES = {"force": ("joint forces, by their peak", "o", "-"), "motion": ("coordinates, by size or 1 rad", "s", ":")}
FILL = {
    Status.STABLE: "#a8d8c0", Status.OUTSIDE: "#c9c9c9", Status.INACCURATE: "#f6d48f", Status.DIVERGED: "#e79a78",
}  # fmt: skip
GREY = "#666666"
EXPLAIN = (
    "%: largest error against a tenth of the step, or energy residual · at: when the run failed"
    " · energy: it comes from nowhere"
)


def bench_figure(title: str, found: Sequence[SceneBench], mark_step: float | None = None) -> Figure:
    """Left: error over step. Right: error over run time. Crosses on top: the run diverged."""
    with matplotlib.rc_context(STYLE):
        picture = Figure(figsize=(11, 5.4), dpi=120, layout="constrained")
        left, right = picture.subplots(1, 2, sharey=True)
        colours = {scene.scene: COLOURS[i % len(COLOURS)] for i, scene in enumerate(_moving(found))}
        for scene in found:
            if scene.method == "kinematic":
                _draw_kinematic(right, scene)
            else:
                _draw_errors(left, right, scene, colours[scene.scene])
        for ax, text in ((left, "step [s]"), (right, "run time of a simulated second [s]")):
            ax.set(xscale="log", yscale="log", xlabel=text)
        left.set_ylabel("largest error")
        _draw_failures(left, _moving(found), colours)
        _draw_slopes(left, _moving(found))
        if mark_step is not None:
            _mark(left, right, mark_step, _moving(found), colours)
        _bench_head(picture, title, found, colours)
    return picture


def _moving(found: Sequence[SceneBench]) -> list[SceneBench]:
    return [scene for scene in found if scene.method != "kinematic"]


def _draw_errors(left: Axes, right: Axes, scene: SceneBench, colour: str) -> None:
    """Filled markers are trusted; hollow ones are below what the references agree to."""
    for measure, (_, marker, dashes) in MEASURES.items():
        rows = [row for row in scene.rows if not row.failure and getattr(row.error, measure) > 0]
        errors = [getattr(row.error, measure) for row in rows]
        floor = TRUSTED * getattr(scene.agreement, measure)
        faces = [colour if error > floor else "white" for error in errors]
        for ax, x in ((left, [row.step for row in rows]), (right, [row.seconds for row in rows])):
            ax.plot(x, errors, dashes, color=colour, lw=1.3, zorder=2)
            ax.scatter(x, errors, s=26, marker=marker, c=faces, edgecolors=colour, linewidths=1.1, zorder=3)


def _draw_kinematic(ax: Axes, scene: SceneBench) -> None:
    rows = [row for row in scene.rows if not row.failure]
    if rows:
        errors = [max(row.error.motion, 1e-17) for row in rows]
        ax.plot([row.seconds for row in rows], errors, "D-", color=IDEAL, ms=5, lw=1.0, zorder=3)
        text = f"{scene.scene}: {rows[0].samples:,} … {rows[-1].samples:,} samples, |Φ| by size"
        ax.annotate(text, (rows[0].seconds, errors[0]), (0, 9), textcoords="offset points", fontsize=8, color=IDEAL)


def _draw_failures(ax: Axes, found: Sequence[SceneBench], colours: dict[str, str]) -> None:
    """Crosses above the largest error: these steps gave no result."""
    top = ax.get_ylim()[1]
    for k, scene in enumerate(found):
        steps = [row.step for row in scene.rows if row.failure]
        if steps:
            y = top * 4.0 ** (k + 1)
            ax.plot(steps, [y] * len(steps), "x", color=colours[scene.scene], ms=7, mew=1.8, zorder=3)
            ax.annotate(f"{scene.scene}: diverges", (min(steps), y), (-9, 0), textcoords="offset points", ha="right",
                        va="center", fontsize=8.5, color=colours[scene.scene])  # fmt: skip


def _draw_slopes(ax: Axes, found: Sequence[SceneBench]) -> None:
    """What an error of order 4 and one of order 1 do over a decade."""
    steps = [row.step for scene in found for row in scene.rows]
    if not steps:
        return
    low = min(steps) * 1.3
    base = ax.get_ylim()[0] * 30
    for order in (1, 2, 4):
        x = np.array([low, low * 10 ** (3 / max(order, 2))])
        ax.plot(x, base * (x / low) ** order, color="#b0b0b0", lw=1.0, zorder=1)
        ax.annotate(f"{order}", (x[1], base * (x[1] / low) ** order), (3, 1), textcoords="offset points", fontsize=7.5,
                    color=GREY)  # fmt: skip
    ax.annotate("order", (low, base), (0, -11), textcoords="offset points", fontsize=7.5, color=GREY)


def _mark(left: Axes, right: Axes, step: float, found: Sequence[SceneBench], colours: dict[str, str]) -> None:
    """A line at the step; on the right a ring around its rows."""
    left.axvline(step, color=IDEAL, lw=1.1, ls=(0, (5, 3)), zorder=1)
    left.annotate(seconds(step), (step, 0.012), (4, 0), xycoords=("data", "axes fraction"),
                  textcoords="offset points", fontsize=8.5, color=IDEAL)  # fmt: skip
    for scene in found:
        row: Row | None = scene.row(step)
        for ax, x in ((left, step), (right, row.seconds if row else math.nan)):
            if row is not None and not row.failure and row.error.force > 0:
                ax.plot([x], [row.error.force], "o", ms=12, mfc="none", mec=IDEAL, mew=1.2, zorder=4)
        if row is not None and not row.failure and row.error.force > 0:
            text = f"forces off by {share(row.error.force)}"
            text += f",\n{scene.contact / step:.1f} steps a contact" if math.isfinite(scene.contact) else ""
            left.annotate(text, (step, row.error.force), (9, -9), textcoords="offset points", va="top", fontsize=8.5,
                          color=colours[scene.scene])  # fmt: skip


def _bench_head(picture: Figure, title: str, found: Sequence[SceneBench], colours: dict[str, str]) -> None:
    moving = _moving(found)
    handles = [Line2D([], [], color=c, lw=2.2, label=_window(s)) for s, c in zip(moving, colours.values(), strict=True)]
    if moving:
        handles += [Line2D([], [], color=GREY, marker=m, ls=d, ms=5, label=text) for text, m, d in MEASURES.values()]
        doubt = "within the reference's own uncertainty"
        handles.append(Line2D([], [], color=GREY, marker="o", mfc="white", ls="", ms=5, label=doubt))
    picture.suptitle(f"{title}: run time against error", fontsize=12, fontweight="bold", x=0.012, ha="left")
    picture.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=8.5)


def _window(scene: SceneBench) -> str:
    return f"{scene.scene}, {scene.method}, first {seconds(scene.t_end)}"


def stress_figure(title: str, found: Sequence[StressMap], mark_step: float | None = None) -> Figure:
    """A panel a scene: clearances across, steps up, each cell its verdict and the number behind it."""
    columns, rows = max(len(scene.clearances) for scene in found), max(len(scene.steps) for scene in found)
    with matplotlib.rc_context(STYLE):
        width = max(6.5, len(found) * (1.1 + 0.82 * columns))
        picture = Figure(figsize=(width, 2.0 + 0.42 * rows), dpi=120, layout="constrained")
        axes = picture.subplots(1, len(found), squeeze=False)[0]
        for ax, scene in zip(axes, found, strict=True):
            _draw_map(ax, scene, mark_step)
        axes[0].set_ylabel("step")
        used = {cell.status for scene in found for cell in scene.cells}
        handles: list[Any] = [Patch(facecolor=FILL[s], label=s.value) for s in Status if s in used]
        if mark_step is not None:
            handles.append(Patch(facecolor="none", edgecolor=IDEAL, lw=1.6, label=f"step {seconds(mark_step)}"))
        picture.suptitle(f"{title}: which step will do?", fontsize=12, fontweight="bold", x=0.012, ha="left")
        picture.legend(
            handles=handles, loc="outside lower center", ncols=5, fontsize=9, title=EXPLAIN, title_fontsize=8
        )
    return picture


def _draw_map(ax: Axes, scene: StressMap, mark_step: float | None) -> None:
    steps, clearances = scene.steps, scene.clearances
    for row, step in enumerate(steps):
        for column, c in enumerate(clearances):
            _draw_cell(ax, row, column, scene.cell(step, c))
        if mark_step is not None and math.isclose(step, mark_step):
            ax.add_patch(Rectangle((-0.5, row - 0.5), len(clearances), 1, fill=False, ec=IDEAL, lw=1.8, zorder=4))
    ax.set(xlim=(-0.5, len(clearances) - 0.5), ylim=(-0.5, len(steps) - 0.5), title=f"{scene.scene}, rk4")
    ax.set_yticks(range(len(steps)), [seconds(step) for step in steps])
    ax.set_xticks(range(len(clearances)), [clearance(c) for c in clearances])
    ax.set_xlabel("radial clearance" if scene.joint else "no play")
    ax.grid(False)
    ax.tick_params(length=0)
    ax.spines[:].set_visible(False)


def _draw_cell(ax: Axes, row: int, column: int, cell: Cell) -> None:
    ax.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, facecolor=FILL[cell.status], edgecolor="white", lw=1.5))
    ax.text(column, row, cell.label, ha="center", va="center", fontsize=7.5, color="#333333", zorder=3)

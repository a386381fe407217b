"""What pictures of a study draw at places of an axis: medians with quartiles and extremes, words, what others found."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.language.shown import in_figure
from gudgeon.results.figures.plots import IDEAL

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike

QUARTILES = (0.0, 0.25, 0.5, 0.75, 1.0)
AXIS, LINE = 60, 22  # letters that fit side by side under a figure; letters of a line there


def quantiles(rows: ArrayLike, which: tuple[float, ...] = QUARTILES) -> Any:
    """(len(which), …) over the first axis, NaN left out; NaN where there is nothing else."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # all NaN: that is what it says
        return np.nanquantile(np.where(np.isfinite(rows), rows, np.nan), which, axis=0)


def band(ax: Axes, x: Any, five: Any, colour: str, told: str, size: float = 4.0) -> None:
    """Extremes, quartiles and the median; where there is one run alone its line."""
    low, q1, middle, q3, high = five
    order = np.argsort(x, kind="stable")
    if not np.array_equal(low, high, equal_nan=True):
        ax.fill_between(x[order], low[order], high[order], color=colour, alpha=0.12, lw=0)
        ax.fill_between(x[order], q1[order], q3[order], color=colour, alpha=0.28, lw=0)
    ax.plot(x[order], middle[order], "-o" if size else "-", ms=size, color=colour, lw=1.1, label=known(middle, told))


def bars(ax: Axes, x: Any, five: Any, colour: str, told: str) -> None:
    """The same where no line goes from one to the next: the median a dot, bars of quartiles and of extremes."""
    low, q1, middle, q3, high = five
    ax.vlines(x, low, high, color=colour, alpha=0.35, lw=1.2)
    ax.vlines(x, q1, q3, color=colour, alpha=0.6, lw=3.5)
    ax.plot(x, middle, "o", ms=5.0, color=colour, label=known(middle, told))


def known(values: Any, told: str) -> str | None:
    """What a legend calls it; nothing where there is no number to be seen."""
    return told if np.isfinite(values).any() else None


def evenly(n: int, most: int) -> range:
    """Every k-th of n places, so that there are no more than `most`: those that have words at an axis."""
    return range(0, n, -(-n // most))


def ticks_at(ax: Axes, x: Any, ticks: list[str] | None) -> None:
    """Words at an axis, long ones on lines, aslant where they would not fit."""
    if ticks is None:
        return
    lines = [in_figure(word, LINE) for word in ticks]
    ax.set_xticks(x, lines)
    if sum(max(map(len, word.split("\n")), default=0) + 2 for word in lines) > AXIS:
        ax.tick_params(axis="x", rotation=30.0, labelsize=7)
        for word in ax.get_xticklabels():
            word.set(ha="right", rotation_mode="anchor")


def marks(ax: Axes, claimed: list[tuple[float, float, int]], factor: float, colours: list[str]) -> None:
    """What others found: place, value and line of each; −1: of no line."""
    for k, (place, value, line) in enumerate(claimed):
        own = IDEAL if line < 0 else colours[line]
        told = "published" if k == 0 else None
        ax.plot([place], [value * factor], "*", color=own, mec=IDEAL, mew=0.6, ms=9, label=told)


def numbers(ax: Axes, values: Any, image: Any) -> None:
    """In each cell, dark on what is bright."""
    for (row, column), value in np.ndenumerate(values):
        if np.isfinite(value):
            bright = np.dot(image.cmap(image.norm(value))[:3], (0.299, 0.587, 0.114)) > 0.55
            colour = "#111111" if bright else "white"
            word = f"{value:.3g}" if abs(value) < 1000.0 else f"{value:.0f}"
            ax.text(column, row, word, ha="center", va="center", fontsize=7.5, color=colour)

"""The figure of a joint's wear: `gudgeon.wear(…).plot()`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gudgeon.language.plot_units import drawn, label
from gudgeon.language.shown import in_figure
from gudgeon.results.figures.plots import COLOURS, STYLE, TITLE
from gudgeon.results.figures.run_plots import new_axes, plain

import matplotlib  # isort: skip  (labels.py says where it is missing)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gudgeon.results.wear import Wear


def plot(wear: Wear, ax: Axes | None) -> Axes:
    """See Wear.plot."""
    with matplotlib.rc_context(STYLE):
        ax = new_axes(8.0, 3.6) if ax is None else plain(ax)
        sides = {"bearing": wear.bearing, "journal": wear.journal}
        factor, unit = drawn(max(side.deepest for side in sides.values()), "m")
        for (name, side), colour in zip(sides.items(), COLOURS, strict=False):
            told = f"{name}, 90 % on {np.degrees(side.arc()):.3g}°" if side.deepest > 0.0 else f"{name}: not worn"
            ax.plot(np.degrees(wear.angle), side.depth * factor, color=colour, lw=1.0, label=told)
        ax.set(xlabel="angle in the body's own frame [°]", ylabel=label("depth", unit), xlim=(0.0, 360.0))
        ax.set_title(in_figure(f"{wear.title}, {wear.joint}: wear by {wear.law.title()}", TITLE))
        ax.legend(loc="best")
    return ax

"""Own the figures of one run, `run.plot()`, `run.plot.orbit("A")`, and of its wear; notebooks display them.

matplotlib is imported with this module, hence only for drawing, and pyplot only if the caller uses it: no display is
needed, and no figure stays in memory.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.language.argument_checks import flag, message, positive, refuse
from gudgeon.language.argument_checks import names as listed_names
from gudgeon.language.plot_units import drawn, label
from gudgeon.language.shown import figure_title
from gudgeon.results.figures import joint_curves
from gudgeon.results.figures.plots import (
    COLOURS,
    IDEAL,
    STYLE,
    TITLE,
    UNTRUSTED,
    caption_of,
    cycle,
    draw_orbit,
    mark_horizon,
    orbit_half_width,
    peak_of,
)
from gudgeon.results.series import default_watch, drive_series, rates

import matplotlib  # isort: skip  (labels.py says where it is missing)
from matplotlib.axes import Axes  # isort: skip
from matplotlib.figure import Figure  # isort: skip

if TYPE_CHECKING:
    from gudgeon.drawing.shapes import Sketch
    from gudgeon.results.results import Result
    from gudgeon.results.wear import Wear

LEGEND = 1.2  # inches for a legend next to a drawing
SERIES = "the name of a series, or a list of such names"
_OF_A_PAGE = ContextVar("of_a_page", default=False)


class Plot:
    """Figures of one run; every method returns its Axes, `axes.figure.savefig(...)` stores them.

    `run.plot()` is a figure of the main series, `run.plot("S9.y", "A.F")` of these series, with a panel for each unit.
    Notebooks display either.
    """

    def __init__(self, run: Result) -> None:
        """Store the run to plot."""
        self.run = run

    def __call__(self, *names: str | Sequence[str]) -> Figure:
        """Plot series with a panel for each unit; without names the default series (default_watch), drives and
        forces.
        """
        expected = [name for some in names for name in listed_names(some, "names", SERIES)]
        run, panels = self.run, dict[str, list[str]]()
        joints = [joint.name for joint in run.source.clearances or run.source.joints]
        forces = {f"{joint}.F": joint_curves.force(run, joint) for joint in joints}  # with the extremes of all steps
        guides = [f"{guide}.{last}" for guide in run.source.guides for last in "FM"]
        for name in expected or (*default_watch(run), *drive_series(run.source), *forces, *guides):
            panels.setdefault(run.unit(name), []).append(name)
        columns = 1 if len(panels) < 3 else 2
        rows = -(-len(panels) // columns)
        with matplotlib.rc_context(STYLE):
            figure = _new_figure(6.5 * columns + 1.5, 2.6 * rows + 0.6)
            for k, own in enumerate(panels.values()):
                ax = figure.add_subplot(rows, columns, k + 1, axes_class=ShownAxes)
                self._curves({name: forces.get(name, (run.t, run[name])) for name in own}, ax).set_title("")
            figure.suptitle(figure_title(caption_of(run), TITLE), fontsize=10)
        return figure

    def series(self, *names: str | Sequence[str], ax: Axes | None = None) -> Axes:
        """Plot series of one unit over time."""
        every = [name for some in names for name in listed_names(some, "names", SERIES)]
        return self._curves({name: (self.run.t, self.run[name]) for name in every}, ax)

    def _curves(self, curves: Mapping[str, tuple[Any, Any]], ax: Axes | None, over: str = "t [s]") -> Axes:
        """Plot curves by name, each with times (or frequencies) and values; all have one unit."""
        run, names = self.run, list(curves)
        if not names:
            raise BadValueError("plot.series: expected the name of a series at least")
        with matplotlib.rc_context(STYLE):
            ax = new_axes(8.0, 3.6) if ax is None else check_axes(ax)
            factor, text = drawn(max(peak_of(values) for _, values in curves.values()), run.unit(names[0]))
            for (name, (t, values)), colour in zip(curves.items(), cycle(len(names)), strict=True):
                ax.plot(t, values * factor, color=colour, lw=1.0, label=name)
            ax.set(xlabel=over, ylabel=label(names[0] if len(names) == 1 else "", text))
            ax.set_title(figure_title(caption_of(run), TITLE))
            if over == "t [s]":
                mark_horizon(ax, run, IDEAL)
            if len(names) > 1:
                ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))  # outside: it hides no curve
        return ax

    def forces(self, ax: Axes | None = None) -> Axes:
        """Plot the magnitudes of the forces at the joints with play, with the extremes of all steps.

        The sums of a slider's corners are at samples. An ideal scene has the forces at all joints.
        """
        source = self.run.source
        joints = [*(joint.name for joint in source.clearances or source.joints), *source.guides]
        return self._curves({f"{joint}.F": joint_curves.force(self.run, joint) for joint in joints}, ax)

    def orbit(self, joint: str, ax: Axes | None = None) -> Axes:
        """Plot the path of the journal's centre in its clearance circle, in units of the clearance."""
        joints = [each.name for each in self.run.source.clearances if not each.at_wall]
        if not isinstance(joint, str) or joint not in joints:
            hint = f"its journals with play: {', '.join(joints) or 'none'}"
            raise UnknownNameError(f"no orbit of {message(joint)}: expected a journal with play", hint=hint)
        with matplotlib.rc_context(STYLE):
            ax = new_axes(4.2, 4.4) if ax is None else check_axes(ax)
            draw_orbit(ax, self.run, joint, COLOURS[1], orbit_half_width(self.run, joint))
        return ax

    def phase(self, x: str, y: str | None = None, ax: Axes | None = None) -> Axes:
        """Plot one series over another, with a ring at the start; by default the rate of "S9.y" over "S9.y"."""
        y = self._rate_of(x) if y is None else y
        return self._pairs(self.run[x], self.run[y], x, y, ax, "-")

    def section(self, event: str, x: str, y: str | None = None, ax: Axes | None = None) -> Axes:
        """Plot a Poincaré section: the states at the located times of an event, one series over another, by default its
        rate.
        """
        y, at = self._rate_of(x) if y is None else y, self.run.at_events(event)
        if not len(at):
            raise BadValueError(f"plot.section: {event} did not happen in this run")
        return self._pairs(at[x], at[y], x, y, ax, ".", f", at {event}, {len(at)} states")

    def _rate_of(self, name: str) -> str:
        """Return the series that is the rate of a series. Raises BadValueError if there is none."""
        found = next((rate for rate in rates(name) if rate in self.run), "")
        if not found:
            self.run.unit(name)  # UnknownNameError
            raise BadValueError(f"{name} has no rate by name: name the other series too")
        return found

    def _pairs(self, xs: Any, ys: Any, x: str, y: str, ax: Axes | None, style: str, suffix: str = "") -> Axes:
        """Plot values `ys` of the series y over values `xs` of the series x, with units."""
        with matplotlib.rc_context(STYLE):
            ax = new_axes(5.2, 4.4) if ax is None else check_axes(ax)
            (of_x, x_unit), (of_y, y_unit) = (
                drawn(peak_of(values), self.run.unit(name)) for name, values in ((x, xs), (y, ys))
            )
            ax.plot(xs * of_x, ys * of_y, style, color=COLOURS[1], lw=0.8, ms=3.0)
            if style == "-":
                ax.plot(xs[:1] * of_x, ys[:1] * of_y, "o", ms=4, mfc="white", mec=IDEAL, mew=0.9)
            ax.set(xlabel=label(x, x_unit), ylabel=label(y, y_unit))
            ax.set_title(figure_title(caption_of(self.run) + suffix, TITLE))
        return ax

    def spectrum(self, *names: str | Sequence[str], window: str = "hann", ax: Axes | None = None) -> Axes:
        """Plot one-sided amplitudes over frequency (Hz) of series of one unit at even samples, each less its mean.

        window: boxcar, hann, hamming, blackman, blackmanharris or flattop, divided by its mean, so that a sine of
        amplitude A on a line of the spectrum has A (between lines the error of flattop is smallest). Raises
        BadValueError for uneven samples, or values that are not finite.
        """
        from gudgeon.results.series import spectrum

        every = [name for some in names for name in listed_names(some, "names", SERIES)]
        found = {name: spectrum(self.run.t, self.run[name], window) for name in every}
        ax = self._curves(found, ax, "f [Hz]")
        ax.set_title(figure_title(f"{caption_of(self.run)}, window {window}", TITLE))
        return ax

    def low_pass(
        self, name: str, cutoff: float, *, order: int = 2, causal: bool = True, ax: Axes | None = None
    ) -> Axes:
        """Plot a series as an accelerometer shows it, after a Butterworth low-pass, −3 dB at `cutoff` (Hz), over the
        series itself.

        causal: as in an amplifier, with its delay; False: forwards and backwards, without phase. Raises BadValueError
        for uneven samples, or a cutoff above half their rate.
        """
        from gudgeon.results.series import low_pass

        run = self.run
        smoothed = low_pass(run.t, run[name], positive(cutoff, "cutoff"), order, flag(causal, "causal"))
        kind = "causal" if causal else "zero phase"
        filter_text = f"low-pass {cutoff:g} Hz, Butterworth of order {order}, {kind}"
        with matplotlib.rc_context(STYLE):
            ax = new_axes(8.0, 3.6) if ax is None else check_axes(ax)
            factor, text = drawn(max(peak_of(run[name]), peak_of(smoothed)), run.unit(name))
            ax.plot(run.t, run[name] * factor, color=UNTRUSTED, lw=0.6, alpha=0.7, label=name)
            ax.plot(run.t, smoothed * factor, color=COLOURS[1], lw=1.2, label=filter_text)
            ax.set(xlabel="t [s]", ylabel=label(name, text))
            ax.set_title(figure_title(caption_of(run), TITLE))
            ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2)
        return ax

    def mechanism(
        self, t: float | str = 0.0, *, velocities: bool = False, forces: bool = False, ax: Axes | None = None
    ) -> Axes:
        """Draw the mechanism at t (s, or '0.2 s'), with insets that magnify joints with play.

        `velocities`: arrows in m/s at its points, to one scale for the run; `forces`: in N at its joints, on the second
        body. Between samples the position lies on the cubic through both. Raises BadValueError for a time outside the
        run.
        """
        from gudgeon.drawing.picture import draw_on
        from gudgeon.results.figures.mechanism_plots import sketch_at
        from gudgeon.results.figures.postures import time_of

        sketch, caption = sketch_at(self.run, t, velocities, forces), f"t\u00a0=\u00a0{time_of(self.run, t):.6g}\u00a0s"
        return self._drawn(sketch, ax, lambda on: draw_on(on, sketch), f"{caption_of(self.run)}, {caption}")

    def path(self, *points: str | Sequence[str], ax: Axes | None = None) -> Axes:
        """Draw the paths of points over the run ("coupler.tracer"; "S9" is its centre of mass), with the mechanism in
        grey.

        Raises UnknownNameError with the nearest point.
        """
        from gudgeon.results.figures.mechanism_plots import draw_path, path_sketch, points_of

        if not (names := points_of(self.run, points)):
            raise BadValueError("plot.path: expected the name of a point at least", hint='for example "coupler.head"')
        sketch = path_sketch(self.run)
        caption = f"{caption_of(self.run)}, drawn at t\u00a0=\u00a0{float(self.run.t[0]):.6g}\u00a0s"
        return self._drawn(sketch, ax, lambda on: draw_path(self.run, sketch, names, on), caption, LEGEND)

    def _drawn(
        self, sketch: Sketch, ax: Axes | None, draw: Callable[[Axes], None], caption: str, margin: float = 0.0
    ) -> Axes:
        """Draw a sketch with caption and notes on new or given axes."""
        from gudgeon.drawing.picture import PER_INCH, size_of

        with matplotlib.rc_context(STYLE):
            width, height = size_of(sketch, 7.0)
            across = TITLE if ax is not None else min(TITLE, int(PER_INCH * (width + margin)))
            ax = new_axes(width + margin, height) if ax is None else check_axes(ax)
            draw(ax)
            ax.set_title(figure_title(caption, across))
            ax.text(0.0, -0.01, "\n".join(sketch.notes), transform=ax.transAxes, va="top", fontsize=7.5)
        return ax


def plot_wear(wear: Wear, ax: Axes | None) -> Axes:
    """Plot the wear depth over the angle for both surfaces. See Wear.plot."""
    with matplotlib.rc_context(STYLE):
        ax = new_axes(8.0, 3.6) if ax is None else check_axes(ax)
        sides = {"bearing": wear.bearing, "journal": wear.journal}
        factor, unit = drawn(max(side.deepest for side in sides.values()), "m")
        for (name, side), colour in zip(sides.items(), COLOURS, strict=False):
            label_text = f"{name}, 90 % on {np.degrees(side.arc()):.3g}°" if side.deepest > 0.0 else f"{name}: not worn"
            ax.plot(np.degrees(wear.angle), side.depth * factor, color=colour, lw=1.0, label=label_text)
        ax.set(xlabel="angle in the body's own frame [°]", ylabel=label("depth", unit), xlim=(0.0, 360.0))
        ax.set_title(figure_title(f"{wear.title}, {wear.joint}: wear by {wear.law.title()}", TITLE))
        ax.legend(loc="best")
    return ax


class ShownFigure(Figure):
    """Figure that a notebook displays if it is the last value of a cell."""

    def _repr_png_(self) -> bytes | None:
        """Return the figure as PNG; None if pyplot displays it."""
        if self.canvas.manager is not None:  # pyplot shows its own
            return None
        drawn_as = io.BytesIO()
        self.savefig(drawn_as, format="png", metadata={"Software": None})
        return drawn_as.getvalue()


class ShownAxes(Axes):
    """Axes whose figure a notebook displays if they are the last value of a cell."""

    def _repr_png_(self) -> bytes | None:
        """Return the figure of the axes as PNG; None if another program displays it."""
        shown = getattr(self.figure, "_repr_png_", None)
        return shown() if shown is not None else None


@contextmanager
def figures_for_page() -> Iterator[None]:
    """Create figures for a page within this context: neither a window nor a notebook's cell displays them."""
    token = _OF_A_PAGE.set(True)
    try:
        yield
    finally:
        _OF_A_PAGE.reset(token)


def _new_figure(width: float, height: float) -> Figure:
    """Return a new figure; pyplot's if the caller has imported it, so that plt.show() displays it."""
    if (pyplot := sys.modules.get("matplotlib.pyplot")) is not None and not _OF_A_PAGE.get():
        made: Figure = pyplot.figure(figsize=(width, height), layout="constrained", FigureClass=ShownFigure)
        return made
    return ShownFigure(figsize=(width, height), layout="constrained")


def new_axes(width: float, height: float) -> Axes:
    """Return axes on a new figure of the given size, inches."""
    return _new_figure(width, height).add_subplot(axes_class=ShownAxes)


def check_axes(ax: Any) -> Axes:
    """Return the argument if it is matplotlib Axes with x and y; raise BadValueError for polar, map and 3-D axes."""
    if not isinstance(ax, Axes) or ax.name != "rectilinear" or ax.figure is None:
        refuse("ax", ax, "Axes of matplotlib with plain x and y, of a figure, or None")
    return ax

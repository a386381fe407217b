"""Define the figures of one run, `run.plot()`, `run.plot.orbit("A")`, and of its wear; notebooks display them.

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
from gudgeon.language.argument_checks import check_flag, check_names, check_positive, raise_bad_value, shorten_value
from gudgeon.language.plot_units import choose_plot_unit, format_label
from gudgeon.language.text_output import format_figure_title
from gudgeon.results.figures import joint_curves
from gudgeon.results.figures.plots import (
    COLOURS,
    IDEAL,
    STYLE,
    TITLE_WIDTH,
    UNPREDICTABLE,
    choose_colours,
    compute_orbit_half_width,
    draw_orbit,
    find_largest_magnitude,
    format_caption,
    mark_predictability_horizon,
)
from gudgeon.results.series import choose_default_series, find_rate_names, list_drive_series

import matplotlib  # isort: skip  (labels.py says where it is missing)
from matplotlib.axes import Axes  # isort: skip
from matplotlib.figure import Figure  # isort: skip

if TYPE_CHECKING:
    from gudgeon.drawing.shapes import Sketch
    from gudgeon.results.results import Result
    from gudgeon.results.wear import Wear

LEGEND_WIDTH = 1.2  # inches for a legend next to a drawing
SERIES_ARGUMENT = "the name of a series, or a list of such names"
_IS_FOR_PAGE = ContextVar("of_a_page", default=False)


class Plot:
    """Figures of one run; every method returns its Axes, `axes.figure.savefig(...)` stores them.

    `run.plot()` is a figure of the main series, `run.plot("S9.y", "A.F")` of these series, with a panel for each unit.
    Notebooks display either.
    """

    def __init__(self, run: Result) -> None:
        """Store the run to plot."""
        self.run = run

    def __call__(self, *names: str | Sequence[str]) -> Figure:
        """Return a figure of series with a panel for each unit, in one or two columns.

        Without names these are the default series (choose_default_series), torques of drives and joint forces. Forces
        include the extremes of all steps.
        """
        requested_names = [
            name for names_argument in names for name in check_names(names_argument, "names", SERIES_ARGUMENT)
        ]
        run, panels = self.run, dict[str, list[str]]()
        joints = [joint.name for joint in run.source.clearances or run.source.joints]
        forces = {
            f"{joint}.F": joint_curves.get_force_curve(run, joint) for joint in joints
        }  # with the extremes of all steps
        guides = [f"{guide}.{last}" for guide in run.source.guides for last in "FM"]
        for name in requested_names or (*choose_default_series(run), *list_drive_series(run.source), *forces, *guides):
            panels.setdefault(run.unit(name), []).append(name)
        n_columns = 1 if len(panels) < 3 else 2
        n_rows = -(-len(panels) // n_columns)
        with matplotlib.rc_context(STYLE):
            figure = _create_figure(6.5 * n_columns + 1.5, 2.6 * n_rows + 0.6)
            for k, panel_names in enumerate(panels.values()):
                ax = figure.add_subplot(n_rows, n_columns, k + 1, axes_class=ShownAxes)
                self._plot_curves({name: forces.get(name, (run.t, run[name])) for name in panel_names}, ax).set_title(
                    ""
                )
            figure.suptitle(format_figure_title(format_caption(run), TITLE_WIDTH), fontsize=10)
        return figure

    def series(self, *names: str | Sequence[str], ax: Axes | None = None) -> Axes:
        """Plot series of one unit over time in one panel, and return the axes."""
        series_names = [
            name for names_argument in names for name in check_names(names_argument, "names", SERIES_ARGUMENT)
        ]
        return self._plot_curves({name: (self.run.t, self.run[name]) for name in series_names}, ax)

    def _plot_curves(self, curves: Mapping[str, tuple[Any, Any]], ax: Axes | None, x_label: str = "t [s]") -> Axes:
        """Plot curves of one unit by name, each with times (or frequencies) and values, and return the axes.

        `x_label` is the label of the abscissa; over time, the predictability horizon is marked. Several curves have a
        legend on the right. Raises BadValueError without a name. `ax` None: on new axes.
        """
        run, names = self.run, list(curves)
        if not names:
            raise BadValueError("plot.series: expected at least one name of a series")
        with matplotlib.rc_context(STYLE):
            ax = create_axes(8.0, 3.6) if ax is None else check_axes(ax)
            factor, text = choose_plot_unit(
                max(find_largest_magnitude(values) for _, values in curves.values()), run.unit(names[0])
            )
            for (name, (t, values)), colour in zip(curves.items(), choose_colours(len(names)), strict=True):
                ax.plot(t, values * factor, color=colour, lw=1.0, label=name)
            ax.set(xlabel=x_label, ylabel=format_label(names[0] if len(names) == 1 else "", text))
            ax.set_title(format_figure_title(format_caption(run), TITLE_WIDTH))
            if x_label == "t [s]":
                mark_predictability_horizon(ax, run, IDEAL)
            if len(names) > 1:
                ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))  # outside: it hides no curve
        return ax

    def forces(self, ax: Axes | None = None) -> Axes:
        """Plot the magnitudes of the forces at the joints with play, with the extremes of all steps.

        The sums of a slider's corners are at samples. An ideal scene has the forces at all joints. Returns the axes,
        new ones if `ax` is None.
        """
        source = self.run.source
        joints = [*(joint.name for joint in source.clearances or source.joints), *source.guides]
        return self._plot_curves({f"{joint}.F": joint_curves.get_force_curve(self.run, joint) for joint in joints}, ax)

    def orbit(self, joint: str, ax: Axes | None = None) -> Axes:
        """Plot the path of the journal's centre in its clearance circle, in units of the clearance.

        Raises UnknownNameError for a name that is not a journal with play. Returns the axes, new ones if `ax` is None.
        """
        joints = [clearance.name for clearance in self.run.source.clearances if not clearance.is_corner]
        if not isinstance(joint, str) or joint not in joints:
            hint = f"its journals with play: {', '.join(joints) or 'none'}"
            raise UnknownNameError(f"no orbit of {shorten_value(joint)}: expected a journal with play", hint=hint)
        with matplotlib.rc_context(STYLE):
            ax = create_axes(4.2, 4.4) if ax is None else check_axes(ax)
            draw_orbit(ax, self.run, joint, COLOURS[1], compute_orbit_half_width(self.run, joint))
        return ax

    def phase(self, x: str, y: str | None = None, ax: Axes | None = None) -> Axes:
        """Plot one series over another, with a ring at the start; by default the rate of "S9.y" over "S9.y"."""
        y = self._find_rate_name(x) if y is None else y
        return self._plot_series_pair(self.run[x], self.run[y], x, y, ax, "-")

    def section(self, event: str, x: str, y: str | None = None, ax: Axes | None = None) -> Axes:
        """Plot a Poincaré section: one series over another at the located times of an event.

        Without `y` it is the rate of x. Raises BadValueError if the event did not happen. Returns the axes, new ones if
        `ax` is None.
        """
        y, states = self._find_rate_name(x) if y is None else y, self.run.at_events(event)
        if not len(states):
            raise BadValueError(f"plot.section: {event} did not happen in this run")
        return self._plot_series_pair(states[x], states[y], x, y, ax, ".", f", at {event}, {len(states)} states")

    def _find_rate_name(self, name: str) -> str:
        """Return the name of the series that is the rate of a series, such as "S9.vy" for "S9.y".

        Raises BadValueError if there is none, UnknownNameError for an unknown series.
        """
        rate_name = next((rate for rate in find_rate_names(name) if rate in self.run), "")
        if not rate_name:
            self.run.unit(name)  # UnknownNameError
            raise BadValueError(f"{name} has no series of its rate: give the name of the other series too")
        return rate_name

    def _plot_series_pair(
        self, x_values: Any, y_values: Any, x_name: str, y_name: str, ax: Axes | None, style: str, suffix: str = ""
    ) -> Axes:
        """Plot the values of one series over those of another, with their units, and return the axes.

        `x_name` and `y_name` are the names of the series, for labels and units. `style` is a line style of matplotlib:
        "-" adds a ring at the start. `suffix` is added to the caption. `ax` None: on new axes.
        """
        with matplotlib.rc_context(STYLE):
            ax = create_axes(5.2, 4.4) if ax is None else check_axes(ax)
            (x_factor, x_unit), (y_factor, y_unit) = (
                choose_plot_unit(find_largest_magnitude(values), self.run.unit(name))
                for name, values in ((x_name, x_values), (y_name, y_values))
            )
            ax.plot(x_values * x_factor, y_values * y_factor, style, color=COLOURS[1], lw=0.8, ms=3.0)
            if style == "-":
                ax.plot(x_values[:1] * x_factor, y_values[:1] * y_factor, "o", ms=4, mfc="white", mec=IDEAL, mew=0.9)
            ax.set(xlabel=format_label(x_name, x_unit), ylabel=format_label(y_name, y_unit))
            ax.set_title(format_figure_title(format_caption(self.run) + suffix, TITLE_WIDTH))
        return ax

    def spectrum(self, *names: str | Sequence[str], window: str = "hann", ax: Axes | None = None) -> Axes:
        """Plot one-sided amplitudes over frequency (Hz) of series of one unit at even samples, each less its mean.

        window: boxcar, hann, hamming, blackman, blackmanharris or flattop, divided by its mean, so that a sine of
        amplitude A on a line of the spectrum has A (between lines the error of flattop is smallest). Raises
        BadValueError for uneven samples, or values that are not finite. Returns the axes, new ones if `ax` is None.
        """
        from gudgeon.results.signals import compute_spectrum

        series_names = [
            name for names_argument in names for name in check_names(names_argument, "names", SERIES_ARGUMENT)
        ]
        spectra = {name: compute_spectrum(self.run.t, self.run[name], window) for name in series_names}
        ax = self._plot_curves(spectra, ax, "f [Hz]")
        ax.set_title(format_figure_title(f"{format_caption(self.run)}, window {window}", TITLE_WIDTH))
        return ax

    def low_pass(
        self, name: str, cutoff: float, *, order: int = 2, causal: bool = True, ax: Axes | None = None
    ) -> Axes:
        """Plot a series as an accelerometer shows it, after a Butterworth low-pass, −3 dB at `cutoff` (Hz), over the
        series itself.

        causal: as in an amplifier, with its delay; False: forwards and backwards, without phase. Raises BadValueError
        for uneven samples, or a cutoff above half their rate. Returns the axes, new ones if `ax` is None.
        """
        from gudgeon.results.signals import apply_low_pass

        run = self.run
        smoothed = apply_low_pass(
            run.t, run[name], check_positive(cutoff, "cutoff"), order, check_flag(causal, "causal")
        )
        kind = "causal" if causal else "zero phase"
        filter_text = f"low-pass {cutoff:g} Hz, Butterworth of order {order}, {kind}"
        with matplotlib.rc_context(STYLE):
            ax = create_axes(8.0, 3.6) if ax is None else check_axes(ax)
            factor, text = choose_plot_unit(
                max(find_largest_magnitude(run[name]), find_largest_magnitude(smoothed)), run.unit(name)
            )
            ax.plot(run.t, run[name] * factor, color=UNPREDICTABLE, lw=0.6, alpha=0.7, label=name)
            ax.plot(run.t, smoothed * factor, color=COLOURS[1], lw=1.2, label=filter_text)
            ax.set(xlabel="t [s]", ylabel=format_label(name, text))
            ax.set_title(format_figure_title(format_caption(run), TITLE_WIDTH))
            ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2)
        return ax

    def mechanism(
        self, t: float | str = 0.0, *, velocities: bool = False, forces: bool = False, ax: Axes | None = None
    ) -> Axes:
        """Draw the mechanism at t (s, or '0.2 s'), with insets that magnify joints with play.

        `velocities`: arrows in m/s at its points, to one scale for the run; `forces`: in N at its joints, on the second
        body. Between samples the position lies on the cubic through both. Raises BadValueError for a time outside the
        run. Returns the axes, new ones if `ax` is None.
        """
        from gudgeon.drawing.picture import draw_sketch
        from gudgeon.results.figures.configurations import read_time
        from gudgeon.results.figures.mechanism_plots import draw_sketch_at_time

        sketch, caption = (
            draw_sketch_at_time(self.run, t, velocities, forces),
            f"t\u00a0=\u00a0{read_time(self.run, t):.6g}\u00a0s",
        )
        return self._draw_sketch_with_caption(
            sketch, ax, lambda on: draw_sketch(on, sketch), f"{format_caption(self.run)}, {caption}"
        )

    def path(self, *points: str | Sequence[str], ax: Axes | None = None) -> Axes:
        """Draw the paths of points over the run ("coupler.tracer"; "S9" is its centre of mass), with the mechanism in
        grey.

        Raises UnknownNameError with the nearest point, BadValueError without points. Returns the axes, new ones if `ax`
        is None.
        """
        from gudgeon.results.figures.mechanism_plots import check_points, draw_path, draw_path_sketch

        if not (names := check_points(self.run, points)):
            raise BadValueError("plot.path: expected at least one name of a point", hint='for example "coupler.head"')
        sketch = draw_path_sketch(self.run)
        caption = f"{format_caption(self.run)}, drawn at t\u00a0=\u00a0{float(self.run.t[0]):.6g}\u00a0s"
        return self._draw_sketch_with_caption(
            sketch, ax, lambda on: draw_path(self.run, sketch, names, on), caption, LEGEND_WIDTH
        )

    def _draw_sketch_with_caption(
        self, sketch: Sketch, ax: Axes | None, draw_content: Callable[[Axes], None], caption: str, margin: float = 0.0
    ) -> Axes:
        """Draw a sketch on new or given axes, with the caption as title above and its notes below; return the axes.

        `draw_content` paints the sketch on axes. `margin` is space in inches that new axes leave for a legend.
        """
        from gudgeon.drawing.picture import CHARACTERS_PER_INCH, compute_figure_size

        with matplotlib.rc_context(STYLE):
            width, height = compute_figure_size(sketch, 7.0)
            caption_width = (
                TITLE_WIDTH if ax is not None else min(TITLE_WIDTH, int(CHARACTERS_PER_INCH * (width + margin)))
            )
            ax = create_axes(width + margin, height) if ax is None else check_axes(ax)
            draw_content(ax)
            ax.set_title(format_figure_title(caption, caption_width))
            ax.text(0.0, -0.01, "\n".join(sketch.notes), transform=ax.transAxes, va="top", fontsize=7.5)
        return ax


def plot_wear(wear: Wear, ax: Axes | None) -> Axes:
    """Plot the wear depth over the angle for both surfaces, and return the axes; see Wear.plot.

    The legend has the arc with 90 % of the worn volume. `ax` None: on new axes.
    """
    with matplotlib.rc_context(STYLE):
        ax = create_axes(8.0, 3.6) if ax is None else check_axes(ax)
        surfaces = {"bearing": wear.bearing, "journal": wear.journal}
        factor, unit = choose_plot_unit(max(surface.deepest for surface in surfaces.values()), "m")
        for (name, surface), colour in zip(surfaces.items(), COLOURS, strict=False):
            label_text = (
                f"{name}, 90 % on {np.degrees(surface.arc()):.3g}°" if surface.deepest > 0.0 else f"{name}: not worn"
            )
            ax.plot(np.degrees(wear.angle), surface.depth * factor, color=colour, lw=1.0, label=label_text)
        ax.set(xlabel="angle in the body's own frame [°]", ylabel=format_label("depth", unit), xlim=(0.0, 360.0))
        ax.set_title(format_figure_title(f"{wear.title}, {wear.joint}: wear by {wear.law.title()}", TITLE_WIDTH))
        ax.legend(loc="best")
    return ax


class ShownFigure(Figure):
    """Figure that a notebook displays if it is the last value of a cell."""

    def _repr_png_(self) -> bytes | None:
        """Return the figure as PNG bytes; None if pyplot owns it, which then displays it."""
        if self.canvas.manager is not None:  # pyplot displays it
            return None
        buffer = io.BytesIO()
        self.savefig(buffer, format="png", metadata={"Software": None})
        return buffer.getvalue()


class ShownAxes(Axes):
    """Axes whose figure a notebook displays if they are the last value of a cell."""

    def _repr_png_(self) -> bytes | None:
        """Return the figure of the axes as PNG bytes; None if pyplot owns it, or if it is not a ShownFigure."""
        shown = getattr(self.figure, "_repr_png_", None)
        return shown() if shown is not None else None


@contextmanager
def suppress_figure_display() -> Iterator[None]:
    """Return a context in which new figures are not pyplot's, so that nothing displays them; for figures of pages."""
    token = _IS_FOR_PAGE.set(True)
    try:
        yield
    finally:
        _IS_FOR_PAGE.reset(token)


def _create_figure(width: float, height: float) -> Figure:
    """Return a new figure of a size in inches.

    It is managed by pyplot if the caller has imported pyplot, so that plt.show() displays it, except within
    `suppress_figure_display`.
    """
    if (pyplot := sys.modules.get("matplotlib.pyplot")) is not None and not _IS_FOR_PAGE.get():
        figure: Figure = pyplot.figure(figsize=(width, height), layout="constrained", FigureClass=ShownFigure)
        return figure
    return ShownFigure(figsize=(width, height), layout="constrained")


def create_axes(width: float, height: float) -> Axes:
    """Return axes on a new figure of the given size, inches."""
    return _create_figure(width, height).add_subplot(axes_class=ShownAxes)


def check_axes(ax: Any) -> Axes:
    """Return the argument if it is matplotlib Axes with Cartesian x and y on a figure.

    Raises BadValueError for other objects, and for polar, map and 3-D axes.
    """
    if not isinstance(ax, Axes) or ax.name != "rectilinear" or ax.figure is None:
        raise_bad_value("ax", ax, "Axes of matplotlib with plain x and y, of a figure, or None")
    return ax

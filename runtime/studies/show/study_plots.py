"""Draw the figures of a study, `study.plot`: quantile bands, curves, heat maps, Poincaré sections, bifurcation
diagrams.

Each method draws one Axes, new or passed, of the runs that `at` selects: {"scene": "dry", "c": 3e-4}, the nearest value
for a number. Statistics leave out NaN of failed runs. On axes of texts the figures have medians with quartiles and
extremes, and published values.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_flag, check_number, check_positive, raise_bad_value
from gudgeon.language.plot_units import choose_plot_unit, format_label
from gudgeon.language.text_output import format_figure_title, format_one_line
from gudgeon.results.figures.plots import COLOURS, IDEAL, STYLE, TITLE_WIDTH, choose_colours, find_largest_magnitude
from gudgeon.results.figures.run_plots import check_axes, create_axes
from gudgeon.studies.show.study_data import Coords, StudyData
from gudgeon.studies.show.study_signals import compute_spectra, filter_low_pass, resample_over_fractions

import matplotlib  # isort: skip  (without matplotlib, an import above raises an error that names the package)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike

    from gudgeon.studies.ensemble.finished import Study

MAX_LABELLED_CELLS = 80  # maximum number of cells of a heat map with numbers in them
MAX_X_TICKS, MAX_Y_TICKS = 14, 24  # tick labels of a heat map
BAR_GROUP_WIDTH = 0.5  # width of a group of bars, as a fraction of the distance of ticks
FIVE_NUMBER_LEVELS = (0.0, 0.25, 0.5, 0.75, 1.0)  # minimum, quartiles and maximum
MAX_TICK_ROW_LENGTH = 60  # characters of all tick labels that fit below a figure without rotation
MAX_TICK_LINE_LENGTH = 22  # characters of a line of a tick label


class StudyPlot:
    """Figures of one study; every method returns its Axes, `axes.figure.savefig("x.svg")` stores them."""

    def __init__(self, study: Study) -> None:
        """Read the dataset and the titles of a study."""
        self.data = StudyData(study)

    def measure(
        self,
        name: str,
        over: str | None = None,
        by: str | None = None,
        *,
        at: Coords | None = None,
        published: Mapping[Any, float] | bool = False,
        ax: Axes | None = None,
    ) -> Axes:
        """Plot a measure over a varied coordinate `over`, with a line for each value of `by`.

        Defaults: over the first numeric coordinate, by scenes. Lines are medians over all other runs, bands their
        quartiles and extremes; over texts, zips and starts there are dots with bars. published: {coordinate: value, SI}
        is marked; True marks the numbers of the file's claims on these runs. Returns the axes, new ones if `ax` is
        None. `at` selects runs: {name: value}. Raises BadValueError if `over` and `by` are one dimension.
        """
        values = self.data.select_measure(name, at)
        axis = self.data.choose_axis_dimension(values) if over is None else over
        over = self.data.find_dimension(values, axis)
        by = self.data.choose_line_dimension(values, over) if by is None else self.data.find_dimension(values, by)
        if by == over:
            raise BadValueError(f"over and by are both {by}", hint="a line for each value of another dimension")
        if isinstance(published, bool):
            claimed = self.data.find_claimed_numbers(name, over, by, at, axis) if published else []
        else:
            stars = {key: check_number(value, "published") for key, value in _convert_to_dict(published).items()}
            claimed = [(self.data.find_axis_position(axis, key), value, -1) for key, value in stars.items()]
        with matplotlib.rc_context(STYLE):
            ax = create_axes(5.6, 3.6) if ax is None else check_axes(ax)
            x, x_label, ticks = self.data.describe_axis(axis)
            magnitudes = [find_largest_magnitude(values.values), *(abs(value) for _, value, _ in claimed)]
            factor, unit = choose_plot_unit(max(magnitudes), values.attrs.get("units", ""))
            groups, is_ordered = self.data.split_runs(values, by), self.data.is_ordered_number(axis)
            for k, ((label, group_values), colour) in enumerate(zip(groups, choose_colours(len(groups)), strict=True)):
                quantiles = compute_run_quantiles(self.data.flatten_runs(group_values, over)) * factor
                if is_ordered:
                    draw_band(ax, x, quantiles, colour, label)
                else:
                    ax.set_xlim(x.min() - 0.5, x.max() + 0.5)
                    draw_quantile_bars(
                        ax, x + BAR_GROUP_WIDTH * (k - 0.5 * (len(groups) - 1)) / len(groups), quantiles, colour, label
                    )
            draw_published_values(ax, claimed, factor, choose_colours(len(groups)))
            ax.set(xlabel=x_label, ylabel=format_label(self.data.get_title(name), unit))
            set_ticks(ax, x, ticks)
            self._set_title_and_legend(ax, at, len(groups) > 1 or bool(claimed))
        return ax

    def bands(
        self,
        series: str,
        by: str | None = None,
        *,
        share: bool = False,
        at: Coords | None = None,
        ax: Axes | None = None,
    ) -> Axes:
        """Plot a stored series over time: median, quartiles and extremes of all runs, or of each value of `by`.

        share: over fractions of each run's duration, 0 to 1, at the samples of the run with the most samples; other
        runs are interpolated linearly. Raises BadValueError for runs with different times without `share`. Returns the
        axes, new ones if `ax` is None. `at` selects runs: {name: value}.
        """
        t, values = self.data.select_series(series, at)
        if check_flag(share, "share"):
            if (resampled := resample_over_fractions(t, values)) is None:
                raise BadValueError(f"{series}: no run has a duration to resample over")
            t, values = resampled
        if t.ndim > 1:
            label = f"{series}: the runs have different sample times: bands need the same times"
            raise BadValueError(label, hint="select runs with the same times (at=…), share=True, or draw an overlay")
        by = self.data.find_dimension(values, by) if by is not None else None
        with matplotlib.rc_context(STYLE):
            ax = create_axes(8.0, 3.6) if ax is None else check_axes(ax)
            factor, unit = choose_plot_unit(find_largest_magnitude(values.values), values.attrs.get("units", ""))
            for (label, group_values), colour in zip(
                groups := self.data.split_runs(values, by), choose_colours(len(groups)), strict=True
            ):
                draw_band(
                    ax,
                    t,
                    compute_run_quantiles(self.data.flatten_runs(group_values, values.dims[-1])) * factor,
                    colour,
                    label,
                    0.0,
                )
            ax.set(
                xlabel="fraction of the run" if share else "t [s]",
                ylabel=format_label(self.data.get_title(series), unit),
            )
            self._set_title_and_legend(ax, at, len(groups) > 1)
        return ax

    def overlay(self, series: str, by: str | None = None, *, at: Coords | None = None, ax: Axes | None = None) -> Axes:
        """Plot a stored series over time with a curve for every run, in the colour of its value of `by`.

        Returns the axes, new ones if `ax` is None. `at` selects runs: {name: value}. `by` None: one colour.
        """
        t, values = self.data.select_series(series, at)
        return self._plot_run_curves(t, values, "t [s]", series, by, at, ax)

    def spectrum(
        self,
        series: str,
        by: str | None = None,
        *,
        window: str = "hann",
        at: Coords | None = None,
        ax: Axes | None = None,
    ) -> Axes:
        """Plot the amplitude spectrum of a stored series over frequency (Hz), as in `run.plot.spectrum`.

        There is a band (median, quartiles, extremes) of the runs of each value of `by`, or of all runs for None. Raises
        BadValueError for uneven samples, or for runs of one band with different times. Returns the axes, new ones if
        `ax` is None. `at` selects runs: {name: value}.
        """
        t, values = self.data.select_series(series, at)
        by = self.data.find_dimension(values, by) if by is not None else None
        spectra = compute_spectra(t, values, by, series, window)
        with matplotlib.rc_context(STYLE):
            ax = create_axes(8.0, 3.6) if ax is None else check_axes(ax)
            factor, unit = choose_plot_unit(
                max(find_largest_magnitude(rows) for _, rows in spectra), values.attrs.get("units", "")
            )
            labels = [label for label, _ in self.data.split_runs(values, by)]
            for label, (f, rows), colour in zip(labels, spectra, choose_colours(len(labels)), strict=True):
                draw_band(ax, f, compute_run_quantiles(rows) * factor, colour, label, 0.0)
            ax.set(xlabel="f [Hz]", ylabel=format_label(self.data.get_title(series), unit))
            self._set_title_and_legend(ax, at, len(labels) > 1)
        return ax

    def low_pass(
        self,
        series: str,
        cutoff: float,
        by: str | None = None,
        *,
        order: int = 2,
        causal: bool = True,
        at: Coords | None = None,
        ax: Axes | None = None,
    ) -> Axes:
        """Plot a stored series after a Butterworth low-pass filter with −3 dB at `cutoff` (Hz), as of an accelerometer.

        There is a curve for every run, in the colour of its value of `by`. order, causal: as in `run.plot.low_pass`.
        Returns the axes, new ones if `ax` is None. `at` selects runs: {name: value}.
        """
        t, values = self.data.select_series(series, at)
        cutoff = check_positive(cutoff, "cutoff")
        filtered = filter_low_pass(t, values, cutoff, order, check_flag(causal, "causal"))
        ax = self._plot_run_curves(t, filtered, "t [s]", series, by, at, ax)
        message = f"low-pass {cutoff:g} Hz, Butterworth of order {order}, {'causal' if causal else 'zero phase'}"
        ax.set_title(format_figure_title(f"{ax.get_title()}: {message}", TITLE_WIDTH))
        return ax

    def phase(self, x: str, y: str, by: str | None = None, *, at: Coords | None = None, ax: Axes | None = None) -> Axes:
        """Plot a phase portrait: one stored series over another, a curve for every run, coloured by its value of `by`.

        Returns the axes, new ones if `ax` is None. `at` selects runs: {name: value}.
        """
        (_, xs), (_, ys) = self.data.select_series(x, at), self.data.select_series(y, at)
        factor, unit = choose_plot_unit(find_largest_magnitude(xs.values), xs.attrs.get("units", ""))
        return self._plot_run_curves(xs.values * factor, ys, format_label(self.data.get_title(x), unit), y, by, at, ax)

    def _plot_run_curves(
        self,
        x: Any,
        values: Any,
        x_label: str,
        name: str,
        by: str | None,
        at: Coords | None,
        ax: Axes | None,
    ) -> Axes:
        """Plot a curve for every run, in the colour of its value of `by`, and return the axes.

        x: abscissae, (N,) or (…, N). values: ordinates, a DataArray (…, N) of the series `name` in SI. by: None for one
        colour. at: the selected coordinates, for the title. ax: None for new axes.
        """
        by = self.data.find_dimension(values, by) if by is not None else None
        with matplotlib.rc_context(STYLE):
            ax = create_axes(8.0, 3.6) if ax is None else check_axes(ax)
            factor, unit = choose_plot_unit(find_largest_magnitude(values.values), values.attrs.get("units", ""))
            x = np.broadcast_to(x, values.shape)
            groups = self.data.split_runs(values, by)
            for k, ((group_label, group_values), colour) in enumerate(
                zip(groups, choose_colours(len(groups)), strict=True)
            ):
                group_x = x if by is None else np.take(x, k, axis=values.dims.index(by))
                rows = zip(group_x.reshape(-1, x.shape[-1]), group_values.values.reshape(-1, x.shape[-1]), strict=True)
                label = select_legend_label(group_values.values, group_label)
                for j, (xs, ys) in enumerate(rows):
                    ax.plot(xs, ys * factor, color=colour, lw=0.8, alpha=0.8, label=label if j == 0 else None)
            ax.set(xlabel=x_label, ylabel=format_label(self.data.get_title(name), unit))
            self._set_title_and_legend(ax, at, len(groups) > 1)
        return ax

    def section(
        self,
        section: str,
        x: str,
        y: str,
        *,
        level: float = 0.0,
        falling: bool = False,
        after: float = 0.0,
        at: Coords | None = None,
        ax: Axes | None = None,
    ) -> Axes:
        """Plot a Poincaré section: series x and y where a third one rises (or falls) through a level (SI), after a
        time.

        Between samples all series are monotone cubics (PCHIP); `run.plot.section` has the located states of an event.
        Returns the axes, new ones if `ax` is None. `at` selects runs: {name: value}.
        """
        section_values = self.data.find_section_values(section, [x, y], level, falling, after, at)
        xs, ys = (
            np.concatenate([pair[k] for _, pair in section_values]) if section_values else np.zeros(0) for k in range(2)
        )
        with matplotlib.rc_context(STYLE):
            ax = create_axes(5.2, 4.4) if ax is None else check_axes(ax)
            (x_factor, x_unit), (y_factor, y_unit) = (
                choose_plot_unit(find_largest_magnitude(values), self.data.get_unit(name))
                for name, values in ((x, xs), (y, ys))
            )
            ax.plot(xs * x_factor, ys * y_factor, ".", color=COLOURS[1], ms=3.0)
            ax.set(
                xlabel=format_label(self.data.get_title(x), x_unit), ylabel=format_label(self.data.get_title(y), y_unit)
            )
            self._set_title_and_legend(ax, at, False)
        return ax

    def bifurcation(
        self,
        series: str,
        over: str,
        section: str,
        *,
        level: float = 0.0,
        falling: bool = False,
        after: float = 0.0,
        at: Coords | None = None,
        ax: Axes | None = None,
    ) -> Axes:
        """Plot a bifurcation diagram: values of a stored series in a Poincaré section (see `section`) over a parameter.

        Returns the axes, new ones if `ax` is None. `at` selects runs: {name: value}.
        """
        _, values_of_runs = self.data.select_series(series, at)
        dim_index = values_of_runs.dims.index(self.data.find_dimension(values_of_runs, over))
        x, x_label, ticks = self.data.describe_axis(over)
        section_values = self.data.find_section_values(section, [series], level, falling, after, at)
        xs = np.concatenate(
            [np.full(len(values), x[where[dim_index]]) for where, (values,) in section_values] or [np.zeros(0)]
        )
        ys = np.concatenate([values for _, (values,) in section_values] or [np.zeros(0)])
        with matplotlib.rc_context(STYLE):
            ax = create_axes(6.4, 4.0) if ax is None else check_axes(ax)
            factor, unit = choose_plot_unit(find_largest_magnitude(ys), self.data.get_unit(series))
            ax.plot(xs, ys * factor, ".", color=COLOURS[1], ms=2.0)
            ax.set(xlabel=x_label, ylabel=format_label(self.data.get_title(series), unit))
            set_ticks(ax, x, ticks)
            self._set_title_and_legend(ax, at, False)
        return ax

    def heat_map(self, name: str, x: str, y: str, *, at: Coords | None = None, ax: Axes | None = None) -> Axes:
        """Plot the median of a measure over two dimensions as a heat map; a cell without a finite value stays empty.

        Up to MAX_LABELLED_CELLS cells have their values as text. Returns the axes, new ones if `ax` is None. `at`
        selects runs: {name: value}. Raises BadValueError if x and y are one dimension.
        """
        values = self.data.select_measure(name, at)
        x, y = self.data.find_dimension(values, x), self.data.find_dimension(values, y)
        if x == y:
            raise BadValueError(f"heat_map: {x} is both x and y")
        medians = compute_run_quantiles(self.data.flatten_runs(values, y, x), (0.5,))[0]
        with matplotlib.rc_context(STYLE):
            ax = create_axes(5.8, 4.2) if ax is None else check_axes(ax)
            factor, unit = choose_plot_unit(find_largest_magnitude(medians), values.attrs.get("units", ""))
            image = ax.imshow(medians * factor, origin="lower", aspect="auto", cmap="viridis")
            (x_labels, x_label), (y_labels, y_label) = (
                self.data.format_value_labels(dimension) for dimension in (x, y)
            )
            x_ticks, y_ticks = (
                select_tick_indices(len(x_labels), MAX_X_TICKS),
                select_tick_indices(len(y_labels), MAX_Y_TICKS),
            )
            set_ticks(ax, x_ticks, [x_labels[k] for k in x_ticks])
            ax.set_yticks(y_ticks, [format_figure_title(y_labels[k], MAX_TICK_LINE_LENGTH) for k in y_ticks])
            ax.set(xlabel=x_label, ylabel=y_label)
            ax.grid(False)
            ax.figure.colorbar(image, ax=ax, label=format_label(self.data.get_title(name), unit))
            if medians.size <= MAX_LABELLED_CELLS:
                write_cell_values(ax, medians * factor, image)
            self._set_title_and_legend(ax, at, False)
        return ax

    def _set_title_and_legend(self, ax: Axes, coordinates: Coords | None, has_legend: bool) -> None:
        """Set the title (study and selected coordinates) and, with `has_legend`, a legend if any curve has a label.

        coordinates: {name: value}; None: all runs.
        """
        selected = ", ".join(self.data.describe_coordinate(name, value) for name, value in (coordinates or {}).items())
        ax.set_title(
            format_figure_title(": ".join(filter(None, (format_one_line(self.data.title), selected))), TITLE_WIDTH)
        )
        if has_legend and ax.get_legend_handles_labels()[0]:
            ax.legend(fontsize=8)


def _convert_to_dict(published: Any) -> dict[Any, Any]:
    """Return published values, {coordinate: value}, as a dict; empty for None. Raises BadValueError for other types."""
    try:
        return dict(published or {})
    except (TypeError, ValueError):
        raise_bad_value("published", published, "{coordinate: number}, or True")


def compute_run_quantiles(rows: ArrayLike, fractions: tuple[float, ...] = FIVE_NUMBER_LEVELS) -> Any:
    """Return quantiles (len(fractions), …) over the first axis (runs) of `rows`; values that are not finite are
    ignored.

    fractions: levels in [0, 1], by default minimum, quartiles and maximum. NaN where no value is finite.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of a column of NaN, whose quantiles are NaN
        return np.nanquantile(np.where(np.isfinite(rows), rows, np.nan), fractions, axis=0)


def draw_band(ax: Axes, x: Any, quantiles: Any, colour: str, label: str, marker_size: float = 4.0) -> None:
    """Draw median, quartiles and extremes over x, (N,), as a line with bands; the line alone if all extremes are equal.

    quantiles: minimum, quartiles and maximum, (5, N). marker_size: of the line's markers, 0 for none. x need not be
    sorted.
    """
    low, q1, middle, q3, high = quantiles
    order = np.argsort(x, kind="stable")
    if not np.array_equal(low, high, equal_nan=True):
        ax.fill_between(x[order], low[order], high[order], color=colour, alpha=0.12, lw=0)
        ax.fill_between(x[order], q1[order], q3[order], color=colour, alpha=0.28, lw=0)
    ax.plot(
        x[order],
        middle[order],
        "-o" if marker_size else "-",
        ms=marker_size,
        color=colour,
        lw=1.1,
        label=select_legend_label(middle, label),
    )


def draw_quantile_bars(ax: Axes, x: Any, quantiles: Any, colour: str, label: str) -> None:
    """Draw box plots without boxes: medians as dots, quartiles as thick and extremes as thin vertical bars.

    They are for coordinates without an order. quantiles: minimum, quartiles and maximum, (5, N).
    """
    low, q1, middle, q3, high = quantiles
    ax.vlines(x, low, high, color=colour, alpha=0.35, lw=1.2)
    ax.vlines(x, q1, q3, color=colour, alpha=0.6, lw=3.5)
    ax.plot(x, middle, "o", ms=5.0, color=colour, label=select_legend_label(middle, label))


def select_legend_label(values: Any, label: str) -> str | None:
    """Return the label of a curve for the legend; None if none of its values is finite."""
    return label if np.isfinite(values).any() else None


def select_tick_indices(n: int, max_count: int) -> range:
    """Return every k-th index of range(n), from 0 on, with the smallest k that gives at most `max_count` indices."""
    return range(0, n, -(-n // max_count))


def set_ticks(ax: Axes, x: Any, tick_texts: list[str] | None) -> None:
    """Set texts as tick labels of the x axis, wrapped to lines of MAX_TICK_LINE_LENGTH characters; None changes
    nothing.

    They are rotated by 30° if all lines together exceed MAX_TICK_ROW_LENGTH characters.
    """
    if tick_texts is None:
        return
    lines = [format_figure_title(label, MAX_TICK_LINE_LENGTH) for label in tick_texts]
    ax.set_xticks(x, lines)
    if sum(max(map(len, label.split("\n")), default=0) + 2 for label in lines) > MAX_TICK_ROW_LENGTH:
        ax.tick_params(axis="x", rotation=30.0, labelsize=7)
        for label in ax.get_xticklabels():
            label.set(ha="right", rotation_mode="anchor")


def draw_published_values(
    ax: Axes, published: list[tuple[float, float, int]], factor: float, colours: list[str]
) -> None:
    """Draw published values as stars in the colours of their lines, the first with a label for the legend.

    published: (position on the axis, value in SI, index of the line or −1 for none). factor: from SI to the unit of the
    axis. colours: of the lines.
    """
    for k, (coordinate, value, line) in enumerate(published):
        colour = IDEAL if line < 0 else colours[line]
        message = "published" if k == 0 else None
        ax.plot([coordinate], [value * factor], "*", color=colour, mec=IDEAL, mew=0.6, ms=9, label=message)


def write_cell_values(ax: Axes, values: Any, image: Any) -> None:
    """Write each finite value (in the unit of the axes) into its cell of a heat map, dark on bright colours, else
    white.

    image: the AxesImage, whose colours decide.
    """
    for (row, column), value in np.ndenumerate(values):
        if np.isfinite(value):
            bright = np.dot(image.cmap(image.norm(value))[:3], (0.299, 0.587, 0.114)) > 0.55
            colour = "#111111" if bright else "white"
            cell_text = f"{value:.3g}" if abs(value) < 1000.0 else f"{value:.0f}"
            ax.text(column, row, cell_text, ha="center", va="center", fontsize=7.5, color=colour)

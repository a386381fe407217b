"""Select runs of a study's dataset by coordinate values, and describe coordinates, for figures and pages."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gudgeon.errors import BadValueError, GudgeonError, UnknownNameError
from gudgeon.language.argument_checks import check_flag, check_mapping, check_number, check_text, shorten_value
from gudgeon.language.names import make_missing_name_error
from gudgeon.language.plot_units import choose_plot_unit, choose_prefix, format_label
from gudgeon.language.text_output import format_one_line
from gudgeon.studies.show.study_signals import find_values_at_crossings, have_equal_times

if TYPE_CHECKING:
    from gudgeon.studies.ensemble.finished import Study

Coords: TypeAlias = Mapping[str, Any]
SAMPLES, RUN_TIMES = ("time", "sample"), "t"
MAX_WRITTEN_TICKS = 8  # values at an axis that are written as in the file
MAX_ZIP_TEXT_LENGTH = 40  # characters of the values at an index of a zip
MIN_COLUMNS_FOR_CHANGES = 4  # with so many parameters of a zip, only differences are displayed
MAX_CHANGES_LENGTH = 60  # characters of the differences at an index of a zip
POOLED_DIMENSIONS = ("start", "draw", "ensemble")  # dimensions over which statistics are computed


class StudyData:
    """The dataset of a study with titles, accessed by names. Raises UnknownNameError with the nearest known name."""

    def __init__(self, study: Study) -> None:
        """Read the dataset, titles and texts of a study."""
        self.study, self.dataset = study, study.dataset
        self.title = str(self.dataset.attrs.get("title") or self.dataset.attrs.get("mechanism", ""))
        self.names = study.names
        values = self.names.values
        self.texts = values.get(study.folder.name if "" not in values else "", {})  # numbers as the file has them

    def get_title(self, name: Any) -> str:
        """Return the title of a name that the file defines, else the name itself, on one line."""
        return format_one_line(self.names.titles.get(str(name), str(name)))

    @property
    def stored_series(self) -> tuple[str, ...]:
        """Return the names of the stored series: the variables over samples, except the sample times `t`."""
        return tuple(
            str(name)
            for name, variable in self.dataset.data_vars.items()
            if variable.dims and variable.dims[-1] in SAMPLES and name != RUN_TIMES
        )

    def get_unit(self, name: str) -> str:
        """Return the SI unit of a variable or coordinate; "" if it has none."""
        return str(self.dataset[name].attrs.get("units", ""))

    def select_measure(self, name: str, coordinates: Coords | None = None) -> Any:
        """Return a measure as a DataArray, restricted to the runs at these coordinates.

        coordinates: {name: value}, the nearest value for a number; None means all runs. Raises UnknownNameError for an
        unknown measure or coordinate.
        """
        if check_text(name, "a measure", "the name of a measure") not in self.study.measures:
            raise make_missing_name_error(f"the study has no measure {name!r}", name, self.study.measures)
        return self._select_runs(self.dataset[name], coordinates)

    def find_claimed_numbers(
        self, name: str, axis_dimension: str, line_dimension: str | None, coordinates: Coords | None, axis_name: str
    ) -> list[tuple[float, float, int]]:
        """Return the published numbers of a measure as points of a figure: (axis position, value in SI, line index).

        line_dimension: dimension of the lines; None gives the index −1. coordinates: selected runs, {name: value}.
        axis_name: coordinate along `axis_dimension` with the positions. A claim that fixes a coordinate over which the
        figure takes the median is left out. Empty without claims.
        """
        try:
            numbers = self.study.claims.numbers
        except GudgeonError:  # the study file has no claims
            return []
        if "place" not in numbers:  # no numbers, or a folder of an earlier version
            return []
        claims_of_measure = numbers[(numbers["measure"] == name) & numbers["printed"].notna()].drop_duplicates("claim")
        variable, index_by_dimension, positions = self.dataset[name], dict[str, int](), self.describe_axis(axis_name)[0]
        for key, value in (coordinates or {}).items():
            dimension = self.find_dimension(variable, key)
            index_by_dimension[dimension] = self.find_nearest_index(key, value)
        cells_and_values = [
            (json.loads(cell_text), float(value))
            for cell_text, value in zip(claims_of_measure["place"], claims_of_measure["printed"], strict=True)
        ]
        pooled = {
            dim
            for dim, n in variable.sizes.items()
            if n > 1 and dim not in (axis_dimension, line_dimension, *index_by_dimension)
        }
        return [
            (
                float(positions[cell[axis_dimension]]),
                value,
                -1 if line_dimension is None else cell.get(line_dimension, -1),
            )
            for cell, value in cells_and_values
            if axis_dimension in cell
            and not pooled & {*cell}
            and all(cell.get(dim, k) == k for dim, k in index_by_dimension.items())
        ]

    def select_series(self, name: str, coordinates: Coords | None = None) -> tuple[Any, Any]:
        """Return sample times (s) and a stored series, a DataArray (…, N), of the runs at these coordinates.

        Times are (N,) if all selected runs share them, else (…, N). coordinates: None means all runs. Raises
        UnknownNameError for a series that was not stored.
        """
        if check_text(name, "a series", "the name of a stored series") not in self.stored_series:
            raise make_missing_name_error(f"the study stored no series {name!r}", name, self.stored_series)
        values = self._select_runs(self.dataset[name], coordinates)
        if RUN_TIMES not in self.dataset:
            return self.dataset["time"].values, values
        t = self._select_runs(self.dataset[RUN_TIMES], coordinates).values
        rows = t.reshape(-1, t.shape[-1])
        rows = rows[np.isfinite(rows[:, 0])]
        if len(rows) and have_equal_times(rows):
            return rows[0], values
        return t, values

    def _select_runs(self, variable: Any, coordinates: Coords | None) -> Any:
        """Return a variable (DataArray) restricted to the runs at these coordinates, {name: value}; None: all runs.

        A number selects the nearest value of its coordinate. Each selected dimension is removed.
        """
        for name, value in check_mapping(coordinates, "at", "expected {coordinate: value}").items():
            dimension = self.find_dimension(variable, name)
            variable = variable.isel({dimension: self.find_nearest_index(name, value)})
        return variable

    def find_dimension(self, variable: Any, name: str) -> str:
        """Return the dimension of a variable along which the coordinate `name` varies.

        Raises BadValueError for a coordinate that does not vary there, UnknownNameError for an unknown one.
        """
        known_dims = [str(dim) for dim in variable.dims if dim not in SAMPLES]
        if check_text(name, "a dimension") in known_dims:
            return name
        if name in self.dataset.dims or name in self.dataset.coords:
            over = [str(dim) for dim in self.dataset[name].dims if dim in known_dims]
            if len(over) == 1:  # a parameter of a zip or a draw
                return over[0]
            raise BadValueError(f"{name} does not vary over the selected runs")
        raise _make_dimension_error(name, known_dims)

    def find_nearest_index(self, name: str, value: Any) -> int:
        """Return the index at which a coordinate has a value: the equal text, or the nearest number (SI).

        Raises UnknownNameError for a text that the coordinate does not have.
        """
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            texts = [str(coordinate_value) for coordinate_value in values]
            if not isinstance(value, str) or value not in texts:
                raise make_missing_name_error(f"{name} has no {shorten_value(value)}", str(value), tuple(texts))
            return texts.index(value)
        return int(np.abs(values - check_number(value, name)).argmin())

    def choose_axis_dimension(self, variable: Any) -> str:
        """Return the default dimension for the horizontal axis of a measure: the first with numbers, else one of texts.

        Of several dimensions of texts, scenes are the last choice. Starts, draws and ensembles are used only if there
        is no other dimension. Raises BadValueError for a single run.
        """
        dims = [str(dim) for dim in variable.dims]
        numeric_dims = [dim for dim in dims if dim not in POOLED_DIMENSIONS and self._is_number(dim)]
        if not dims:
            raise BadValueError("a single run is selected: a figure over a coordinate needs several")
        other_dims = [dim for dim in dims if dim not in POOLED_DIMENSIONS]
        return next(
            iter(numeric_dims), next((dim for dim in other_dims if dim != "scene"), next(iter(other_dims), dims[0]))
        )

    def is_ordered_number(self, name: str) -> bool:
        """Return whether the values of a coordinate are ordered numbers, so that a line may connect them.

        It is False for texts, starts, draws, ensembles and indices of zips.
        """
        return self._is_number(name) and name not in POOLED_DIMENSIONS and not self._is_zip(name)

    def _is_zip(self, name: str) -> bool:
        """Return whether a coordinate is the index of a `zip`, along which several parameters vary together."""
        return str(self.dataset[name].attrs.get("long_name", "")).startswith("place in zip")

    def _is_number(self, dimension: str) -> bool:
        """Return whether the values of a dimension are numbers, not texts."""
        return self.dataset[dimension].values.dtype.kind in "fiu"

    def choose_line_dimension(self, variable: Any, axis_dimension: str) -> str | None:
        """Return the default dimension whose values are separate lines of a figure over `axis_dimension`.

        It is the scenes, else the first dimension of texts; None if there is neither.
        """
        dims = [str(dim) for dim in variable.dims if dim != axis_dimension]
        text_dims = [dim for dim in dims if not self._is_number(dim)]
        return "scene" if "scene" in dims else next(iter(text_dims), None)

    def split_runs(self, variable: Any, dimension: str | None) -> list[tuple[str, Any]]:
        """Return a pair (label, DataArray of its runs) for each value of a dimension; [("", variable)] for None."""
        if dimension is None:
            return [("", variable)]
        labels, _ = self.format_value_labels(dimension, with_name=True)
        return [(label, variable.isel({dimension: k})) for k, label in enumerate(labels)]

    def flatten_runs(self, variable: Any, *last_dimensions: str) -> Any:
        """Return the values of a variable as an array (runs, …): `last_dimensions` last, all others joined."""
        others = [dim for dim in variable.dims if dim not in last_dimensions]
        values = variable.transpose(*others, *last_dimensions).values
        return values.reshape(-1, *values.shape[len(others) :])

    def describe_axis(self, name: str) -> tuple[Any, str, list[str] | None]:
        """Return the positions of a coordinate's values on an axis, the label of the axis, and tick texts or None.

        Texts have positions 0, 1, …. Numbers are scaled to a suitable unit; they have tick texts if the file writes at
        most MAX_WRITTEN_TICKS values, and for a zip.
        """
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            return np.arange(len(values)), self.get_title(name), [self.get_title(value) for value in values]
        factor, shown = choose_plot_unit(float(np.abs(values).max(initial=0.0)), self.get_unit(name))
        ticks = list(self.get_written_values(name)) if len(values) <= MAX_WRITTEN_TICKS else []
        return (
            values * factor,
            format_label(self.get_title(name), "" if ticks else shown),
            ticks or self._describe_zip(name),
        )

    def find_axis_position(self, name: str, value: Any) -> float:
        """Return the position of a value (a text, or a number in SI) on the axis that `describe_axis` describes.

        Raises UnknownNameError for an unknown text.
        """
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            return float(self.find_nearest_index(name, value))
        return (
            check_number(value, name) * choose_plot_unit(float(np.abs(values).max(initial=0.0)), self.get_unit(name))[0]
        )

    def format_value_labels(self, dimension: str, with_name: bool = False) -> tuple[list[str], str]:
        """Return a text for each value of a dimension, and the label of the dimension with its unit.

        with_name: numbers as "c = 0.3 mm" instead of "0.3". Texts have their titles, indices of a zip the values of its
        parameters. Values are written as in the file if possible.
        """
        values = self.dataset[dimension].values
        if values.dtype.kind in "OU":
            return [self.get_title(text) for text in values], self.get_title(dimension)
        if (words := self._describe_zip(dimension)) is not None:
            return words, self.get_title(dimension)
        if written := self.get_written_values(dimension):
            return [f"{self.get_title(dimension)} = {text}" if with_name else text for text in written], self.get_title(
                dimension
            )
        factor, unit = choose_prefix(float(np.abs(values).max(initial=0.0)), self.get_unit(dimension))
        words = [f"{float(value) * factor:.4g}" for value in values]
        if with_name:
            words = [f"{self.get_title(dimension)} = {word} {unit}".strip() for word in words]
        return words, format_label(self.get_title(dimension), unit)

    def get_written_values(self, name: str) -> tuple[str, ...]:
        """Return the values of a coordinate with units, as in the study file; empty if it does not list them."""
        texts = self.texts.get(name, ())
        return texts if len(texts) == np.size(self.dataset[name].values) else ()

    def describe_coordinate(self, name: str, value: Any) -> str:
        """Return a selected coordinate in words: "scene = without oil", or with the nearest number "c = 0.3 mm"."""
        word = self.format_value_labels(name, with_name=True)[0][self.find_nearest_index(name, value)]
        return word if word.startswith(f"{self.get_title(name)} = ") else f"{self.get_title(name)} = {word}"

    def _describe_zip(self, dimension: str) -> list[str] | None:
        """Return for each index of a zip the values of its parameters in words: "0.1 mm, 300 rpm".

        With MIN_COLUMNS_FOR_CHANGES parameters or texts that are too long, a text has only the parameters that differ
        from their most frequent value (`describe_changes`). None for a dimension that is not a zip, or if the texts are
        too long or not unique.
        """
        if not self._is_zip(dimension):
            return None
        columns: dict[tuple[str, ...], str] = {}
        for name, coordinate in self.dataset.coords.items():
            if coordinate.dims == (dimension,) and name != dimension and len(set(coordinate.values.tolist())) > 1:
                columns.setdefault(
                    tuple(self.get_written_values(str(name)) or map(self.get_title, coordinate.values)),
                    self.get_title(name),
                )
        full_texts = [", ".join(row) for row in zip(*columns, strict=True)]
        for texts, max_length in (
            (full_texts, MAX_ZIP_TEXT_LENGTH if len(columns) < MIN_COLUMNS_FOR_CHANGES else 0),
            (describe_changes(columns), MAX_CHANGES_LENGTH),
        ):
            if texts and max(map(len, texts)) <= max_length and len(set(texts)) == len(texts):
                return texts
        return None

    def describe_cell(self, indices: Mapping[str, int]) -> str:
        """Return a cell in words, from its index along each dimension: "c = 0.3 mm, ω = 2π rad/s"."""
        labelled_indices = ((name, k, self.format_value_labels(name, with_name=True)[0]) for name, k in indices.items())
        return ", ".join(words[k] for _, k, words in labelled_indices)

    def iterate_failures(self) -> Iterator[tuple[str, int, str]]:
        """Yield for each kind of failure (kind, number of runs, coordinates and message of the first failed run).

        The most frequent kind is first. The last text is "" in a folder of an earlier version.
        """
        if not (kinds := self.study.failures):
            return
        failure_array, first = self.dataset["failure"], self.study.first_failures
        words = {str(dim): self.format_value_labels(str(dim), with_name=True)[0] for dim in failure_array.dims}
        for kind, count in kinds.items():
            if (run := first.get(kind)) is None:  # a folder of an earlier version
                yield kind, count, ""
                continue
            coordinates = dict(zip(words, np.unravel_index(run, failure_array.shape), strict=True)) if words else {}
            labels = ((name, words[name][k]) for name, k in coordinates.items())
            location = ", ".join(word if " = " in word else f"{self.get_title(name)} {word}" for name, word in labels)
            message = str(failure_array.isel(coordinates).values).partition("\n")[0]
            yield kind, count, f"{location}: {message}" if location else message

    def find_section_values(
        self,
        section: str,
        names: list[str],
        level: float,
        is_falling: bool,
        min_time: float,
        coordinates: Coords | None,
    ) -> list[tuple[tuple[int, ...], list[Any]]]:
        """Return the Poincaré section of each selected run: pairs of its index and [values (k,) of each other series].

        section: name of the series that rises through `level` (SI); is_falling: falls instead. names: of the other
        series. min_time (s): earlier crossings are left out. coordinates: {name: value}; None means all runs.
        """
        t, section_series = self.select_series(section, coordinates)
        other_arrays = [self.select_series(name, coordinates)[1].values for name in names]
        level, min_time, is_falling = (
            check_number(level, "level"),
            check_number(min_time, "after"),
            check_flag(is_falling, "falling"),
        )
        times, sections = np.broadcast_to(t, section_series.shape), []
        for run_index in np.ndindex(section_series.shape[:-1]):
            values = [series[run_index] for series in other_arrays]
            sections.append(
                (
                    run_index,
                    find_values_at_crossings(
                        times[run_index], section_series.values[run_index], values, level, is_falling, min_time
                    ),
                )
            )
        return sections

    def iterate_spreads(self, name: str) -> Iterator[tuple[dict[str, str], Any]]:
        """Yield for each combination of coordinates ({dimension: text}, values of a measure over POOLED_DIMENSIONS)."""
        variable = self.dataset[name]
        dims = [str(dim) for dim in variable.dims if dim not in POOLED_DIMENSIONS]
        labels = {dim: self.format_value_labels(dim)[0] for dim in dims}
        values = variable.transpose(*dims, *(dim for dim in variable.dims if dim in POOLED_DIMENSIONS)).values
        for index in np.ndindex(values.shape[: len(dims)]):
            yield {dim: labels[dim][k] for dim, k in zip(dims, index, strict=True)}, np.ravel(values[index])


def describe_changes(columns: Mapping[tuple[str, ...], str]) -> list[str]:
    """Return for each index of a zip a text of the parameters that differ from their most frequent value: "c = 1 mm".

    The text is "unchanged" if no parameter differs. columns: texts of a parameter's values → its title. The list is
    empty if a parameter has no value that occurs at more than half of the indices.
    """
    most_frequent = {column: Counter(column).most_common(1)[0] for column in columns}
    if any(2 * count <= len(column) for column, (_, count) in most_frequent.items()):
        return []
    indices = range(len(next(iter(columns), ())))
    changed = [
        [f"{name} = {column[k]}" for column, name in columns.items() if column[k] != most_frequent[column][0]]
        for k in indices
    ]
    return [", ".join(message) or "unchanged" for message in changed]


def _make_dimension_error(name: str, known_names: list[str]) -> UnknownNameError:
    """Return the error for an unknown dimension, with the nearest known name as hint."""
    return make_missing_name_error(f"the selected runs have no dimension {name!r}", name, tuple(known_names))

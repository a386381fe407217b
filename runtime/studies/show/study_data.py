"""Provide the data of a study's dataset for figures and pages: runs by coordinates, axes with units, sections of
series.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gudgeon.errors import BadValueError, GudgeonError, UnknownNameError
from gudgeon.language.argument_checks import flag, mapping, message, number_of, text
from gudgeon.language.names import unknown
from gudgeon.language.plot_units import drawn, label, pretty, scale
from gudgeon.language.shown import one_line
from gudgeon.studies.show.study_signals import alike, crossings

if TYPE_CHECKING:
    from gudgeon.studies.ensemble.finished import Study

Coords: TypeAlias = Mapping[str, Any]
SAMPLES, OWN_TIMES = ("time", "sample"), "t"
MOST_TICKS, MOST_LETTERS = 8, 40  # values at an axis; letters of the text of a zip's index
MANY_COLUMNS, MOST_SAID = 4, 60  # parameters of a zip from which on only differences are shown; their letters
MANY = ("start", "draw", "ensemble")  # dimensions over which statistics are computed


class StudyData:
    """The dataset of a study, accessed by names. Raises UnknownNameError with the nearest name."""

    def __init__(self, study: Study) -> None:
        """Read the dataset, titles and texts of a study."""
        self.study, self.dataset = study, study.dataset
        self.title = str(self.dataset.attrs.get("title") or self.dataset.attrs.get("mechanism", ""))
        self.names = study.names
        values = self.names.values
        self.texts = values.get(study.folder.name if "" not in values else "", {})  # numbers as the file has them

    def shown(self, name: Any) -> str:
        """Return the title of a name that the file defines, else the name itself, on one line."""
        return one_line(self.names.titles.get(str(name), str(name)))

    @property
    def kept(self) -> tuple[str, ...]:
        """Return the names of the stored series."""
        return tuple(
            str(name)
            for name, one in self.dataset.data_vars.items()
            if one.dims and one.dims[-1] in SAMPLES and name != OWN_TIMES
        )

    def unit(self, name: str) -> str:
        """Return the SI unit of a variable or coordinate; "" if it has none."""
        return str(self.dataset[name].attrs.get("units", ""))

    def measure(self, name: str, at: Coords | None = None) -> Any:
        """Return a measure as a DataArray, restricted to the runs at the coordinates `at`. Raises UnknownNameError."""
        if text(name, "a measure", "the name of a measure") not in self.study.measures:
            raise unknown(f"the study has no measure {name!r}", name, self.study.measures)
        return self._select(self.dataset[name], at)

    def claimed(
        self, name: str, over: str, by: str | None, at: Coords | None, axis: str
    ) -> list[tuple[float, float, int]]:
        """Return the printed numbers of a measure that a figure shows: position on the axis, value (SI), index of the
        line.

        over: dimension of the axis. by: dimension of the lines, or None (index −1). at: selected coordinates. axis:
        coordinate of the axis. Claims about fewer runs than a point of the figure pools are left out, since they do
        not compare with its median. Empty without claims.
        """
        try:
            numbers = self.study.claims.numbers
        except GudgeonError:  # it claims nothing
            return []
        if "place" not in numbers:  # nothing, or a folder that an earlier version judged
            return []
        claims_of_measure = numbers[(numbers["measure"] == name) & numbers["printed"].notna()].drop_duplicates("claim")
        found, selected, positions = self.dataset[name], dict[str, int](), self.axis(axis)[0]
        for key, value in (at or {}).items():
            dimension = self.dimension(found, key)
            selected[dimension] = self.nearest(key, value)
        each = [
            (json.loads(place), float(value))
            for place, value in zip(claims_of_measure["place"], claims_of_measure["printed"], strict=True)
        ]
        pooled = {one for one, n in found.sizes.items() if n > 1 and one not in (over, by, *selected)}
        return [
            (float(positions[place[over]]), value, -1 if by is None else place.get(by, -1))
            for place, value in each
            if over in place and not pooled & {*place} and all(place.get(one, k) == k for one, k in selected.items())
        ]

    def series(self, name: str, at: Coords | None = None) -> tuple[Any, Any]:
        """Return times and a stored series (…, N) of the runs at `at`; times are (N,) if all runs share them, else (…,
        N).

        Raises UnknownNameError.
        """
        if text(name, "a series", "the name of a kept series") not in self.kept:
            raise unknown(f"the study kept no series {name!r}", name, self.kept)
        found = self._select(self.dataset[name], at)
        if OWN_TIMES not in self.dataset:
            return self.dataset["time"].values, found
        t = self._select(self.dataset[OWN_TIMES], at).values
        rows = t.reshape(-1, t.shape[-1])
        rows = rows[np.isfinite(rows[:, 0])]
        if len(rows) and alike(rows):
            return rows[0], found
        return t, found

    def _select(self, variable: Any, at: Coords | None) -> Any:
        """Return a variable restricted to the runs at the coordinates `at`, the nearest value for a number."""
        for name, value in mapping(at, "at", "expected {coordinate: value}").items():
            dimension = self.dimension(variable, name)
            variable = variable.isel({dimension: self.nearest(name, value)})
        return variable

    def dimension(self, variable: Any, name: str) -> str:
        """Return the dimension of a variable along which the coordinate `name` varies.

        Raises BadValueError for a coordinate that does not vary there, UnknownNameError for an unknown one.
        """
        known = [str(one) for one in variable.dims if one not in SAMPLES]
        if text(name, "a dimension") in known:
            return name
        if name in self.dataset.dims or name in self.dataset.coords:
            over = [str(one) for one in self.dataset[name].dims if one in known]
            if len(over) == 1:  # a number of a zip or a draw
                return over[0]
            raise BadValueError(f"{name} does not vary over the runs that are shown")
        raise _make_dimension_error(name, known)

    def nearest(self, name: str, value: Any) -> int:
        """Return the index of a value of a coordinate: of the equal text, else UnknownNameError; or of the nearest
        number.
        """
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            words = [str(one) for one in values]
            if not isinstance(value, str) or value not in words:
                raise unknown(f"{name} has no {message(value)}", str(value), tuple(words))
            return words.index(value)
        return int(np.abs(values - number_of(value, name)).argmin())

    def first(self, variable: Any) -> str:
        """Return the default dimension for the axis of a measure: the first with numbers, else one with texts.

        Starts and draws have no order, so they are used only if there is no other dimension. Raises BadValueError for
        a single run.
        """
        dims = [str(one) for one in variable.dims]
        numbers = [one for one in dims if one not in MANY and self._is_number(one)]
        if not dims:
            raise BadValueError("the study has one run here: there is nothing to draw it over")
        words = [one for one in dims if one not in MANY]
        return next(iter(numbers), next((one for one in words if one != "scene"), next(iter(words), dims[0])))

    def is_course(self, name: str) -> bool:
        """Return whether a coordinate is an ordered number, so that a line may connect its values."""
        return self._is_number(name) and name not in MANY and not self._is_zip(name)

    def _is_zip(self, name: str) -> bool:
        """Return whether a coordinate is the index of a zip of parameters."""
        return str(self.dataset[name].attrs.get("long_name", "")).startswith("place in zip")

    def _is_number(self, dimension: str) -> bool:
        """Return whether the values of a dimension are numbers, not texts."""
        return self.dataset[dimension].values.dtype.kind in "fiu"

    def lines(self, variable: Any, over: str) -> str | None:
        """Return the default dimension whose values are separate lines of a figure over `over`: scenes, else the first
        with texts.

        None if there is neither.
        """
        dims = [str(one) for one in variable.dims if one != over]
        words = [one for one in dims if not self._is_number(one)]
        return "scene" if "scene" in dims else next(iter(words), None)

    def split(self, variable: Any, by: str | None) -> list[tuple[str, Any]]:
        """Return pairs of label and runs for each value of the dimension `by`; "" and all runs for None."""
        if by is None:
            return [("", variable)]
        words, _ = self.labels(variable, by, named=True)
        return [(word, variable.isel({by: k})) for k, word in enumerate(words)]

    def rows(self, variable: Any, *last_dimensions: str) -> Any:
        """Return the values of a variable as an array (runs, …), with the dimensions `last_dimensions` last and all
        others joined.
        """
        others = [one for one in variable.dims if one not in last_dimensions]
        values = variable.transpose(*others, *last_dimensions).values
        return values.reshape(-1, *values.shape[len(others) :])

    def axis(self, name: str) -> tuple[Any, str, list[str] | None]:
        """Return the positions of a coordinate's values on an axis, its label, and texts for ticks, or None for plain
        numbers.

        Texts have positions 0, 1, …; numbers are in a suitable unit.
        """
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            return np.arange(len(values)), self.shown(name), [self.shown(one) for one in values]
        factor, shown = drawn(float(np.abs(values).max(initial=0.0)), self.unit(name))
        ticks = list(self.written(name)) if len(values) <= MOST_TICKS else []
        return values * factor, label(self.shown(name), "" if ticks else shown), ticks or self._describe_zip(name)

    def place(self, name: str, value: Any) -> float:
        """Return the position of a value on the axis of a coordinate, as `axis` has them. Raises UnknownNameError for
        a text.
        """
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            return float(self.nearest(name, value))
        return number_of(value, name) * drawn(float(np.abs(values).max(initial=0.0)), self.unit(name))[0]

    def labels(self, variable: Any, dimension: str, named: bool = False) -> tuple[list[str], str]:
        """Return a text for each value of a dimension, and the label of the dimension.

        named: "c = 0.3 mm" instead of "0.3", for numbers. Values are written as in the file if possible. `variable` is
        not used.
        """
        values = self.dataset[dimension].values
        if values.dtype.kind in "OU":
            return [self.shown(one) for one in values], self.shown(dimension)
        if (words := self._describe_zip(dimension)) is not None:
            return words, self.shown(dimension)
        if written := self.written(dimension):
            return [f"{self.shown(dimension)} = {one}" if named else one for one in written], self.shown(dimension)
        factor, unit = scale(float(np.abs(values).max(initial=0.0)), self.unit(dimension))
        words = [f"{float(value) * factor:.4g}" for value in values]
        if named:
            words = [f"{self.shown(dimension)} = {word} {unit}".strip() for word in words]
        return words, label(self.shown(dimension), unit)

    def written(self, name: str) -> tuple[str, ...]:
        """Return the values of a coordinate as the file writes them, with units; empty if the file does not list them.
        """
        own = self.texts.get(name, ())
        return own if len(own) == np.size(self.dataset[name].values) else ()

    def at(self, name: str, value: Any) -> str:
        """Return a selected coordinate in words: "scene = without oil", or the nearest number: "c = 0.3 mm"."""
        word = self.labels(None, name, named=True)[0][self.nearest(name, value)]
        return word if word.startswith(f"{self.shown(name)} = ") else f"{self.shown(name)} = {word}"

    def _describe_zip(self, dimension: str) -> list[str] | None:
        """Return for each index of a zip its parameters in words, or those that differ from most other indices.

        None for another dimension, and if neither text is short and unique.
        """
        if not self._is_zip(dimension):
            return None
        columns: dict[tuple[str, ...], str] = {}
        for name, one in self.dataset.coords.items():
            if one.dims == (dimension,) and name != dimension and len(set(one.values.tolist())) > 1:
                columns.setdefault(tuple(self.written(str(name)) or map(self.shown, one.values)), self.shown(name))
        whole = [", ".join(row) for row in zip(*columns, strict=True)]
        for words, most in (
            (whole, MOST_LETTERS if len(columns) < MANY_COLUMNS else 0),
            (changes(columns), MOST_SAID),
        ):
            if words and max(map(len, words)) <= most and len(set(words)) == len(words):
                return words
        return None

    def where(self, indices: Mapping[str, int]) -> str:
        """Return a cell in words from its indices by dimension: "c = 0.3 mm, ω = 2π rad/s"."""
        own = ((name, k, self.labels(None, name, named=True)[0]) for name, k in indices.items())
        return ", ".join(words[k] for _, k, words in own)

    def failures(self) -> Iterator[tuple[str, int, str]]:
        """Yield each kind of failure, its number of runs, and a text with coordinates and message of the first of
        them.

        The text is "" in a folder of an earlier version.
        """
        if not (kinds := self.study.failures):
            return
        found, first = self.dataset["failure"], self.study.first_failures
        words = {str(one): self.labels(None, str(one), named=True)[0] for one in found.dims}
        for kind, count in kinds.items():
            if (run := first.get(kind)) is None:  # a folder of an earlier version
                yield kind, count, ""
                continue
            place = dict(zip(words, np.unravel_index(run, found.shape), strict=True)) if words else {}
            own = ((name, words[name][k]) for name, k in place.items())
            at = ", ".join(word if " = " in word else f"{self.shown(name)} {word}" for name, word in own)
            message = str(found.isel(place).values).partition("\n")[0]
            yield kind, count, f"{at}: {message}" if at else message

    def sections(
        self, section: str, names: list[str], level: float, falling: bool, after: float, at: Coords | None
    ) -> list[tuple[tuple[int, ...], list[Any]]]:
        """Return for each selected run its index and the values of the series `names` where the series `section`
        crosses a level.

        level: SI. falling: crossings from above instead of from below. after (s): earlier crossings are left out.
        """
        t, section_series = self.series(section, at)
        others = [self.series(name, at)[1].values for name in names]
        level, after, falling = number_of(level, "level"), number_of(after, "after"), flag(falling, "falling")
        times, found = np.broadcast_to(t, section_series.shape), []
        for where in np.ndindex(section_series.shape[:-1]):
            own = [series[where] for series in others]
            found.append((where, crossings(times[where], section_series.values[where], own, level, falling, after)))
        return found

    def spreads(self, name: str) -> Iterator[tuple[dict[str, str], Any]]:
        """Yield for each combination of coordinates their texts, and the values of a measure over starts and draws
        there.
        """
        found = self.dataset[name]
        dims = [str(one) for one in found.dims if one not in MANY]
        words = {one: self.labels(found, one)[0] for one in dims}
        values = found.transpose(*dims, *(one for one in found.dims if one in MANY)).values
        for where in np.ndindex(values.shape[: len(dims)]):
            yield {one: words[one][k] for one, k in zip(dims, where, strict=True)}, np.ravel(values[where])

    def shown_unit(self, name: str) -> str:
        """Return the unit of a variable in typographic form, such as "m/s²"."""
        return pretty(self.unit(name))


def changes(columns: Mapping[tuple[str, ...], str]) -> list[str]:
    """Return for each index of a zip the parameters that differ from the most frequent value, as a text; or
    "unchanged".

    columns: texts of a parameter's values → its title. Empty if a parameter has no value at more than half of the
    indices.
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
    """Return the error for an unknown dimension, with the nearest known name."""
    return unknown(f"the runs that are shown have no dimension {name!r}", name, tuple(known_names))

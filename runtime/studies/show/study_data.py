"""What pictures and pages take of a study's dataset: runs by their coordinates, axes with units, sections of series."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gudgeon.errors import BadValueError, GudgeonError, UnknownNameError
from gudgeon.language.names import unknown
from gudgeon.language.plot_units import drawn, label, pretty, scale
from gudgeon.language.shown import one_line
from gudgeon.language.wanted import flag, mapping, number_of, text, told
from gudgeon.studies.show.study_signals import alike, crossings

if TYPE_CHECKING:
    from gudgeon.studies.ensemble.finished import Study

Coords: TypeAlias = Mapping[str, Any]
SAMPLES, OWN_TIMES = ("time", "sample"), "t"
MOST_TICKS, MOST_LETTERS = 8, 40  # values that stand at an axis; what is told of a place in a zip
MANY_COLUMNS, MOST_SAID = 4, 60  # numbers of a zip of which differences are told in place of all; their letters
MANY = ("start", "draw", "ensemble")  # dimensions of which one asks the spread first


class StudyData:
    """The dataset of a study, asked by names; UnknownNameError names the nearest."""

    def __init__(self, study: Study) -> None:
        self.study, self.dataset = study, study.dataset
        self.title = str(self.dataset.attrs.get("title") or self.dataset.attrs.get("mechanism", ""))
        self.names = study.names
        values = self.names.values
        self.texts = values.get(study.folder.name if "" not in values else "", {})  # numbers as the file has them

    def shown(self, name: Any) -> str:
        """A name, or its title, on one line."""
        return one_line(self.names.titles.get(str(name), str(name)))

    @property
    def kept(self) -> tuple[str, ...]:
        """Names of the series that were kept."""
        return tuple(
            str(name)
            for name, one in self.dataset.data_vars.items()
            if one.dims and one.dims[-1] in SAMPLES and name != OWN_TIMES
        )

    def unit(self, name: str) -> str:
        """SI, of a variable or a coordinate."""
        return str(self.dataset[name].attrs.get("units", ""))

    def measure(self, name: str, at: Coords | None = None) -> Any:
        """A measure as a DataArray, of the runs at some coordinates."""
        if text(name, "a measure", "the name of a measure") not in self.study.measures:
            raise unknown(f"the study has no measure {name!r}", name, self.study.measures)
        return self._picked(self.dataset[name], at)

    def claimed(
        self, name: str, over: str, by: str | None, at: Coords | None, axis: str
    ) -> list[tuple[float, float, int]]:
        """Numbers that the file claims of a measure of the runs at: place on the axis, value (SI), which line.

        None of one that is about fewer runs than are pooled there: beside a median of others it would say nothing.
        """
        try:
            numbers = self.study.claims.numbers
        except GudgeonError:  # it claims nothing
            return []
        if "place" not in numbers:  # nothing, or a folder that an earlier version judged
            return []
        own = numbers[(numbers["measure"] == name) & numbers["printed"].notna()].drop_duplicates("claim")
        found, picked, places = self.dataset[name], dict[str, int](), self.axis(axis)[0]
        for key, value in (at or {}).items():
            dimension = self.dimension(found, key)
            picked[dimension] = self.nearest(key, value)
        each = [(json.loads(place), float(value)) for place, value in zip(own["place"], own["printed"], strict=True)]
        pooled = {one for one, n in found.sizes.items() if n > 1 and one not in (over, by, *picked)}
        return [
            (float(places[place[over]]), value, -1 if by is None else place.get(by, -1))
            for place, value in each
            if over in place and not pooled & {*place} and all(place.get(one, k) == k for one, k in picked.items())
        ]

    def series(self, name: str, at: Coords | None = None) -> tuple[Any, Any]:
        """Times, (N,) where all runs have the same, else (…, N), and a kept series (…, N)."""
        if text(name, "a series", "the name of a kept series") not in self.kept:
            raise unknown(f"the study kept no series {name!r}", name, self.kept)
        found = self._picked(self.dataset[name], at)
        if OWN_TIMES not in self.dataset:
            return self.dataset["time"].values, found
        t = self._picked(self.dataset[OWN_TIMES], at).values
        rows = t.reshape(-1, t.shape[-1])
        rows = rows[np.isfinite(rows[:, 0])]
        if len(rows) and alike(rows):
            return rows[0], found
        return t, found

    def _picked(self, found: Any, at: Coords | None) -> Any:
        for name, value in mapping(at, "at", "expected {coordinate: value}").items():
            dimension = self.dimension(found, name)
            found = found.isel({dimension: self.nearest(name, value)})
        return found

    def dimension(self, found: Any, name: str) -> str:
        """A dimension of runs. BadValueError where it has but the one value."""
        known = [str(one) for one in found.dims if one not in SAMPLES]
        if text(name, "a dimension") in known:
            return name
        if name in self.dataset.dims or name in self.dataset.coords:
            over = [str(one) for one in self.dataset[name].dims if one in known]
            if len(over) == 1:  # a number of a zip or a draw
                return over[0]
            raise BadValueError(f"{name} does not vary over the runs that are shown")
        raise _no_dimension(name, known)

    def nearest(self, name: str, value: Any) -> int:
        """The place of a coordinate's value along its dimension: that word, or the nearest number."""
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            words = [str(one) for one in values]
            if not isinstance(value, str) or value not in words:
                raise unknown(f"{name} has no {told(value)}", str(value), tuple(words))
            return words.index(value)
        return int(np.abs(values - number_of(value, name)).argmin())

    def first(self, found: Any) -> str:
        """What a measure is drawn over if nobody says: the first dimension that is a number's, else one of words.

        Starts and draws have no order: only of a measure that has nothing else.
        """
        dims = [str(one) for one in found.dims]
        numbers = [one for one in dims if one not in MANY and self._is_number(one)]
        if not dims:
            raise BadValueError("the study has one run here: there is nothing to draw it over")
        words = [one for one in dims if one not in MANY]
        return next(iter(numbers), next((one for one in words if one != "scene"), next(iter(words), dims[0])))

    def is_course(self, name: str) -> bool:
        """Whether a coordinate's values follow each other, as those of a number: a line may go through them."""
        return self._is_number(name) and name not in MANY and not self._is_zip(name)

    def _is_zip(self, name: str) -> bool:
        return str(self.dataset[name].attrs.get("long_name", "")).startswith("place in zip")

    def _is_number(self, dimension: str) -> bool:
        return self.dataset[dimension].values.dtype.kind in "fiu"

    def lines(self, found: Any, over: str) -> str | None:
        """What tells lines apart if nobody says: scenes, else the first dimension of words."""
        dims = [str(one) for one in found.dims if one != over]
        words = [one for one in dims if not self._is_number(one)]
        return "scene" if "scene" in dims else next(iter(words), None)

    def split(self, found: Any, by: str | None) -> list[tuple[str, Any]]:
        """What to call it and the runs, for each value of `by`; "" and all for None."""
        if by is None:
            return [("", found)]
        words, _ = self.labels(found, by, named=True)
        return [(word, found.isel({by: k})) for k, word in enumerate(words)]

    def rows(self, found: Any, *kept: str) -> Any:
        """(runs, …): all other dimensions together as the first one, then these."""
        others = [one for one in found.dims if one not in kept]
        values = found.transpose(*others, *kept).values
        return values.reshape(-1, *values.shape[len(others) :])

    def axis(self, name: str) -> tuple[Any, str, list[str] | None]:
        """Places of a coordinate's values, a label, and words for ticks where they are no numbers."""
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            return np.arange(len(values)), self.shown(name), [self.shown(one) for one in values]
        factor, shown = drawn(float(np.abs(values).max(initial=0.0)), self.unit(name))
        ticks = list(self.written(name)) if len(values) <= MOST_TICKS else []
        return values * factor, label(self.shown(name), "" if ticks else shown), ticks or self._together(name)

    def place(self, name: str, value: Any) -> float:
        """Where on that axis a value lies."""
        values = self.dataset[name].values
        if values.dtype.kind in "OU":
            return float(self.nearest(name, value))
        return number_of(value, name) * drawn(float(np.abs(values).max(initial=0.0)), self.unit(name))[0]

    def labels(self, found: Any, dimension: str, named: bool = False) -> tuple[list[str], str]:
        """A word for each value, "0.3" or with `named` "c = 0.3 mm", and the dimension's label."""
        values = self.dataset[dimension].values
        if values.dtype.kind in "OU":
            return [self.shown(one) for one in values], self.shown(dimension)
        if (words := self._together(dimension)) is not None:
            return words, self.shown(dimension)
        if written := self.written(dimension):
            return [f"{self.shown(dimension)} = {one}" if named else one for one in written], self.shown(dimension)
        factor, unit = scale(float(np.abs(values).max(initial=0.0)), self.unit(dimension))
        words = [f"{float(value) * factor:.4g}" for value in values]
        if named:
            words = [f"{self.shown(dimension)} = {word} {unit}".strip() for word in words]
        return words, label(self.shown(dimension), unit)

    def written(self, name: str) -> tuple[str, ...]:
        """Values of a coordinate as the file has them, with their units; none where it has not."""
        own = self.texts.get(name, ())
        return own if len(own) == np.size(self.dataset[name].values) else ()

    def at(self, name: str, value: Any) -> str:
        """The runs that are picked by a coordinate: "scene = without oil", or the nearest number as the file has it."""
        word = self.labels(None, name, named=True)[0][self.nearest(name, value)]
        return word if word.startswith(f"{self.shown(name)} = ") else f"{self.shown(name)} = {word}"

    def _together(self, dimension: str) -> list[str] | None:
        """Of a zip what its numbers are at each place, or what differs there from most of its places.

        None of another dimension, and where neither is short.
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

    def where(self, place: Mapping[str, int]) -> str:
        """A scene by its places: "c = 0.3 mm, ω = 2π rad/s"."""
        own = ((name, k, self.labels(None, name, named=True)[0]) for name, k in place.items())
        return ", ".join(words[k] for _, k, words in own)

    def failures(self) -> Iterator[tuple[str, int, str]]:
        """What runs failed of, how many, and of the first of these where it lies and all that it says."""
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
            told = str(found.isel(place).values).partition("\n")[0]
            yield kind, count, f"{at}: {told}" if at else told

    def sections(
        self, section: str, names: list[str], level: float, falling: bool, after: float, at: Coords | None
    ) -> list[tuple[tuple[int, ...], list[Any]]]:
        """Place of a run among those picked, and values of these series where one goes through a level."""
        t, through = self.series(section, at)
        others = [self.series(name, at)[1].values for name in names]
        level, after, falling = number_of(level, "level"), number_of(after, "after"), flag(falling, "falling")
        times, found = np.broadcast_to(t, through.shape), []
        for where in np.ndindex(through.shape[:-1]):
            own = [series[where] for series in others]
            found.append((where, crossings(times[where], through.values[where], own, level, falling, after)))
        return found

    def spreads(self, name: str) -> Iterator[tuple[dict[str, str], Any]]:
        """Of a measure what its coordinates are, in words, and the numbers over starts and draws there."""
        found = self.dataset[name]
        dims = [str(one) for one in found.dims if one not in MANY]
        words = {one: self.labels(found, one)[0] for one in dims}
        values = found.transpose(*dims, *(one for one in found.dims if one in MANY)).values
        for where in np.ndindex(values.shape[: len(dims)]):
            yield {one: words[one][k] for one, k in zip(dims, where, strict=True)}, np.ravel(values[where])

    def shown_unit(self, name: str) -> str:
        """For people."""
        return pretty(self.unit(name))


def changes(columns: Mapping[tuple[str, ...], str]) -> list[str]:
    """What differs at each place of a zip from what most of its places have; none where a number has no such value."""
    usual = {column: Counter(column).most_common(1)[0] for column in columns}
    if any(2 * count <= len(column) for column, (_, count) in usual.items()):
        return []
    places = range(len(next(iter(columns), ())))
    own = [
        [f"{name} = {column[k]}" for column, name in columns.items() if column[k] != usual[column][0]] for k in places
    ]
    return [", ".join(told) or "unchanged" for told in own]


def _no_dimension(name: str, known: list[str]) -> UnknownNameError:
    return unknown(f"the runs that are shown have no dimension {name!r}", name, tuple(known))

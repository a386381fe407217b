"""Convert the claims of a study file to checks on its runs; each part, coordinate, measure and unit is checked at its
location.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError, InputError, UnknownKeyError, together
from gudgeon.generator.study.spec import ALONG, COUNTS, NumberClaim, Selection, TrendClaim, Trial
from gudgeon.language.names import unknown_name
from gudgeon.language.units import unit
from gudgeon.results.batch import Array
from gudgeon.studies.ensemble.judge import Cell, Check, Look
from gudgeon.studies.ensemble.numbers import real_value
from gudgeon.studies.ensemble.plan import Coordinate, Plan, Plans

if TYPE_CHECKING:
    from gudgeon.generator.yaml import Text


MOST_COMPARED = 100_000  # cells of runs, or pairs of them, that one claim compares: each is judged alone
FEWER = f"expected {MOST_COMPARED} at most: select some with at:, or vary less"
STARTS = ("ensemble", "start")  # dimensions that no claim selects: it is about all of them
SAME = 1e-9  # relative tolerance of a coordinate's value in a claim
MOST_LISTED = 8


def limit_checks(checks: Iterable[Check], name: Text) -> tuple[Check, ...]:
    """Return all checks of a claim. Raises BadValueError at its name if there are too many."""
    found = tuple(itertools.islice(checks, MOST_COMPARED + 1))
    if len(found) > MOST_COMPARED:
        raise BadValueError(f"{name} compares more than {MOST_COMPARED} pairs of runs", name.where, FEWER)
    return found


@dataclass(frozen=True, eq=False)
class Selected:
    """The indices along each dimension of a part that a selection allows, without starts."""

    part: str
    plan: Plan
    places: Mapping[str, tuple[int, ...]]
    where: Text

    def cells(self, fixed: Mapping[str, int]) -> Iterator[tuple[tuple[Any, ...], Cell]]:
        """Yield all selected cells, with the values of the dimensions that vary and are not fixed.

        Raises BadValueError for too many cells.
        """
        if (count := math.prod(len(own) for own in self.places.values())) > MOST_COMPARED:
            raise BadValueError(f"the claim is about {count} values of coordinates", self.where.where, FEWER)
        for index in itertools.product(*([fixed[name]] if name in fixed else own for name, own in self.places.items())):
            free = [(name, k) for name, k in zip(self.places, index, strict=True) if self._is_free(name, fixed)]
            yield tuple((name, self._value(name, k)) for name, k in free), Cell(self.part, index)

    def _is_free(self, name: str, fixed: Mapping[str, int]) -> bool:
        """Return whether a dimension varies and is not fixed."""
        return name not in fixed and len(self.places[name]) > 1

    def _value(self, name: str, k: int) -> Any:
        """Return the value of a dimension at an index, or the index if it has no coordinate."""
        found = next((one for one in self.plan.coordinates if one.name == name and one.over == (name,)), None)
        return k if found is None else found.values[k].item() if hasattr(found.values[k], "item") else found.values[k]


@dataclass(frozen=True, eq=False)
class KnownNumber:
    """A published number and the cell of runs that it describes."""

    claim: NumberClaim
    cell: Cell
    unit: str
    printed: float | None


@dataclass(frozen=True, eq=False)
class KnownTrend:
    """A published trend and its checks."""

    claim: TrendClaim
    checks: tuple[Check, ...]


@dataclass(frozen=True, eq=False)
class Known:
    """All claims of a file."""

    numbers: tuple[KnownNumber, ...] = ()
    trends: tuple[KnownTrend, ...] = ()


def known_claims(plans: Plans) -> Known:
    """Return the claims of a file with their checks. Raises InputErrors with all that do not fit the runs."""
    claims, errors = plans.file.claims, list[InputError]()
    numbers, trends = list[KnownNumber](), list[KnownTrend]()
    for number in claims.numbers:
        try:
            numbers.append(_resolve_number(plans, number))
        except InputError as error:
            errors.append(error)
    for trend in claims.trends:
        try:
            every = (check for one in trend.trials for check in _make_checks(plans, one))
            trends.append(KnownTrend(trend, limit_checks(every, trend.name)))
        except InputError as error:
            errors.append(error)
    if errors:
        raise together(errors)
    return Known(tuple(numbers), tuple(trends))


def _resolve_number(plans: Plans, claim: NumberClaim) -> KnownNumber:
    """Return a published number with its cell and unit."""
    selected = _select(plans, claim.selection)
    cells = [cell for _, cell in selected.cells({})]
    if len(cells) > 1:
        left = [f"{name} ({len(own)})" for name, own in selected.places.items() if len(own) > 1]
        hint = f"say in at: which value of {', '.join(left)}"
        raise BadValueError(f"{claim.name} is about {len(cells)} scenes", claim.name.where, hint)
    message = _unit_of(selected.plan, claim.measure)
    return KnownNumber(claim, cells[0], message, None if claim.value is None else _value_in(claim.value, message))


def _unit_of(plan: Plan, measure: Text) -> str:
    """Return the unit of a measure. Raises an InputError for an unknown measure."""
    known = [one.name for one in plan.expected.measures]
    if measure not in known:
        raise unknown_name("measure", measure, known, measure.where)
    return plan.units[str(measure)]


def _value_in(text: Text, unit_text: str) -> float:
    """Return the value of a text in an SI unit."""
    known_unit = unit(unit_text).dimension if unit_text and unit(unit_text) else None  # type: ignore[union-attr]
    exponents = (
        (float(known_unit.length), float(known_unit.mass), float(known_unit.time)) if known_unit else (0.0, 0.0, 0.0)
    )
    return real_value(text, Slot("value", unit_text, 0.0, False, exponents))


def _select(plans: Plans, selection: Selection) -> Selected:
    """Return the cells of a selection. Raises an InputError at its location."""
    part, where = "", selection.where.where
    if plans.named:
        if selection.part is None:
            raise UnknownKeyError("a claim on no part", where, f"expected part: one of {', '.join(plans.each)}")
        part = str(selection.part)
        if part not in plans.each:
            raise unknown_name("part", part, list(plans.each), selection.part.where)
    elif selection.part is not None:
        raise BadValueError("the file has no parts", selection.part.where, "leave part: out")
    plan = plans.each[part]
    places = {name: tuple(range(length)) for name, length in zip(plan.dims, plan.shape, strict=True)}
    for name, value in selection.at.items():
        one = _find_coordinate(plan, name)
        own = _indices_of(one, value)
        if one.over:
            places[one.over[0]] = tuple(k for k in places[one.over[0]] if k in own)
        if not own or one.over and not places[one.over[0]]:
            raise BadValueError(f"no run has {name} {str(value)[:60]!r}", value.where, _list_values(one))
    return Selected(part, plan, {name: own for name, own in places.items() if name not in STARTS}, selection.where)


def _find_coordinate(plan: Plan, name: Text) -> Coordinate:
    """Return a coordinate over at most one dimension, other than those of starts."""
    known = {one.name: one for one in plan.coordinates if len(one.over) < 2 and not set(one.over) & set(STARTS)}
    found = known.get(str(name)) or known.get(str(name).removeprefix("parameters."))
    if found is None:
        raise unknown_name("coordinate", name, list(known), name.where)
    return found


def _indices_of(one: Coordinate, value: Text) -> set[int]:
    """Return the indices at which a coordinate has a value."""
    values = np.atleast_1d(np.asarray(one.values))
    if values.dtype.kind in "OU":
        return {k for k, own in enumerate(values.tolist()) if str(own) == value.strip()}
    expected = _value_in(value, one.unit)
    return set(np.flatnonzero(np.abs(values - expected) <= SAME * np.abs(values)).tolist())


def _list_values(one: Coordinate) -> str:
    """Return a hint that lists the values of a coordinate."""
    values = [str(value) if isinstance(value, str) else f"{value:.6g}" for value in np.atleast_1d(one.values).tolist()]
    more = ", …" if len(values) > MOST_LISTED else ""
    return f"expected one of: {', '.join(values[:MOST_LISTED])}{more}{f' ({one.unit})' if one.unit else ''}"


def _make_checks(plans: Plans, trial: Trial) -> Iterator[Check]:
    """Yield the checks of one statement of a trend."""
    selected = _select(plans, trial.selection)
    if trial.kind == COUNTS:
        yield _check_counts(selected, trial)
        return
    for measure in (*trial.measures, *trial.others):
        _unit_of(selected.plan, measure)
    if trial.kind in ALONG:
        yield from _checks_along(selected, trial)
    elif trial.than is not None:
        yield from _checks_between(selected, _select(plans, trial.than), trial)
    else:
        yield from _checks_of_cells(selected, trial)


def _fraction_of(trial: Trial, otherwise: float) -> float:
    """Return the fraction in `by` of a statement, or a default."""
    return otherwise if trial.by is None else _value_in(trial.by, "")


def _checks_along(selected: Selected, trial: Trial) -> Iterator[Check]:
    """Yield the checks of a statement along a dimension."""
    one = _find_coordinate(selected.plan, trial.text)
    if not one.over or len(selected.places[one.over[0]]) < 2:
        message = f"nothing to compare along {str(trial.text)[:60]!r}: it has one value here"
        raise BadValueError(message, trial.text.where, "leave it out of at:, or take another dimension")
    (dimension,) = one.over
    order = selected.places[dimension]
    if np.asarray(one.values).dtype.kind not in "OU":
        order = tuple(sorted(order, key=lambda k: float(one.values[k])))
    rows = [dict(selected.cells({dimension: k})) for k in order]
    for key in rows[0]:
        yield from _checks_of_row([row[key] for row in rows], trial)


def _checks_of_row(cells: list[Cell], trial: Trial) -> Iterator[Check]:
    """Yield the checks of neighbouring or all pairs of cells along a dimension."""
    for k, measure in enumerate(map(str, trial.measures)):
        if trial.kind == "grows_along":
            for pair in itertools.pairwise(cells):
                yield Check(pair, (measure,), _is_larger(measure, _fraction_of(trial, 1.0)))
        elif trial.kind == "alike_along":
            for two in itertools.combinations(cells, 2):
                yield Check(two, (measure,), _is_alike(measure, _fraction_of(trial, 0.0)))
        else:
            other = str(trial.others[k])
            yield Check(tuple(cells), (measure, other), _has_larger_range(measure, other, len(cells)))


def _is_larger(measure: str, by: float) -> Callable[[Look], Array]:
    """Return the condition that a measure of the second cell exceeds `by` times that of the first."""
    return lambda x: x(1, measure) > by * x(0, measure)


def _is_alike(measure: str, within: float) -> Callable[[Look], Array]:
    """Return the condition that a measure differs between two cells by at most the fraction `within`."""

    def shows(x: Look) -> Array:
        """Return for each combination of runs whether it meets the condition."""
        a, b = x(0, measure), x(1, measure)
        return np.asarray(np.abs(a - b) <= within * np.maximum(np.abs(a), np.abs(b)))

    return shows


def _has_larger_range(measure: str, other: str, n: int) -> Callable[[Look], Array]:
    """Return the condition that a measure has a larger range over n cells than another measure."""

    def spread(x: Look, name: str) -> Array:
        """Return the range of a measure over the cells."""
        values = [x(k, name) for k in range(n)]
        return np.asarray(reduce(np.maximum, values) - reduce(np.minimum, values))

    return lambda x: spread(x, measure) > spread(x, other)


def _checks_between(first: Selected, second: Selected, trial: Trial) -> Iterator[Check]:
    """Yield the checks that compare two selections cell by cell."""
    for name in (*trial.measures, *trial.others):
        _unit_of(second.plan, name)
    here, there = dict(first.cells({})), dict(second.cells({}))
    if here.keys() != there.keys():
        message = f"{trial.text} and what it is compared with are not about the same runs"
        hint = "what neither selects must have the same values in both"
        raise BadValueError(message, trial.text.where, hint)
    for key, cell in here.items():
        for measure in [str(name) for name in trial.measures]:
            if trial.kind == "larger":
                yield Check((there[key], cell), (measure,), _is_larger(measure, _fraction_of(trial, 1.0)))
            for other in [str(name) for name in trial.others]:
                yield Check((cell, there[key]), (measure, other), _falls_further(measure, other))


def _falls_further(measure: str, other: str) -> Callable[[Look], Array]:
    """Return the condition that a measure falls by a larger factor than another one from the first cell to the
    second.
    """
    return lambda x: np.abs(x(1, measure) * x(0, other)) < np.abs(x(1, other) * x(0, measure))


def _checks_of_cells(selected: Selected, trial: Trial) -> Iterator[Check]:
    """Yield the checks of each cell alone, against another measure of the same run or a number."""
    for _, cell in selected.cells({}):
        for name in trial.measures:
            measure = str(name)
            if trial.others:
                yield Check(
                    (cell,),
                    (measure, str(trial.others[0])),
                    _exceeds_measure(measure, str(trial.others[0]), _fraction_of(trial, 1.0)),
                )
                continue
            number, within = _value_in(trial.text, _unit_of(selected.plan, name)), _fraction_of(trial, 0.0)
            low = {"above": number, "near": number - within * abs(number)}.get(trial.kind, -np.inf)
            high = {"below": number, "near": number + within * abs(number)}.get(trial.kind, np.inf)
            yield Check((cell,), (measure,), _is_inside(measure, low, high, trial.kind == "near"))


def _exceeds_measure(measure: str, other: str, by: float) -> Callable[[Look], Array]:
    """Return the condition that a measure exceeds `by` times another one of the same run."""
    return lambda x: x(0, measure) > by * x(0, other)


def _is_inside(measure: str, low: float, high: float, ends: bool) -> Callable[[Look], Array]:
    """Return the condition that a measure lies between two values; `ends`: bounds included."""

    def shows(x: Look) -> Array:
        """Return for each run whether it meets the condition."""
        own = x(0, measure)
        return np.asarray((own >= low) & (own <= high) if ends else (own > low) & (own < high))

    return shows


def _check_counts(selected: Selected, trial: Trial) -> Check:
    """Return the check of the numbers of components of a scene, the same in every run."""
    structure = [one.length for one in selected.plan.structure]
    places = [cell.index[: len(structure)] for _, cell in selected.cells({})]
    parts = {int(np.ravel_multi_index(place, structure)) if structure else 0 for place in places}
    sources = [selected.plan.parts[k].simulation.source for k in sorted(parts)]
    right = all(
        _count_components(source)[str(name)] == count for source in sources for name, count in trial.counts.items()
    )
    return Check((), (), lambda x: np.array(right))


def _count_components(source: KernelSource) -> dict[str, int]:
    """Return the numbers of components of a scene by their name in claims."""
    return {
        "bodies": len(source.bodies),
        "joints": len(source.joints) + len(source.clearances),
        "drives": len(source.drives),
        "freedoms": source.degrees_of_freedom,
        "rows": len(source.rows),
        "coordinates": len(source.coordinates),
        "play": len(source.clearances),
    }

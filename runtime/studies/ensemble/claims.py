"""Convert the claims of a study file, published numbers and trends, to conditions on groups of its runs."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import BadValueError, InputError, UnknownKeyError, combine_errors
from gudgeon.generator.study.spec import (
    COUNTS,
    TRENDS_ALONG_DIMENSION,
    NumberClaim,
    Selection,
    TrendClaim,
    TrendStatement,
)
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.units import find_unit
from gudgeon.results.batch import Array
from gudgeon.studies.ensemble.judge import Check, ReadMeasure, RunCell
from gudgeon.studies.ensemble.parameter_values import parse_real_value
from gudgeon.studies.ensemble.plan import Coordinate, Plan, Plans

if TYPE_CHECKING:
    from gudgeon.generator.yaml import Text


MAX_COMPARED = 100_000  # maximum number of cells, or of checks, of one claim
TOO_MANY_HINT = f"expected at most {MAX_COMPARED}: select some with at:, or vary fewer parameters"
PERTURBATION_DIMENSIONS = ("ensemble", "start")  # dimensions over which claims have statistics, and select nothing
VALUE_RTOL = 1e-9  # relative tolerance of a coordinate's value in a claim
MAX_LISTED = 8  # values of a coordinate in a hint


def limit_checks(checks: Iterable[Check], claim_name: Text) -> tuple[Check, ...]:
    """Evaluate an iterator of checks of a claim up to MAX_COMPARED, and return them as a tuple.

    Raises BadValueError at the name of the claim if there are more, without evaluating the others.
    """
    first_checks = tuple(itertools.islice(checks, MAX_COMPARED + 1))
    if len(first_checks) > MAX_COMPARED:
        raise BadValueError(
            f"{claim_name} compares more than {MAX_COMPARED} pairs of runs", claim_name.where, TOO_MANY_HINT
        )
    return first_checks


@dataclass(frozen=True, eq=False)
class ResolvedSelection:
    """The indices along each dimension of a part that a selection of a claim allows, without ensembles and starts."""

    part: str
    plan: Plan
    indices_by_dimension: Mapping[str, tuple[int, ...]]
    where: Text

    def iterate_cells(self, fixed_indices: Mapping[str, int]) -> Iterator[tuple[tuple[Any, ...], RunCell]]:
        """Yield all selected cells as pairs (key, cell); a key identifies the same cell in another selection.

        The key has pairs (dimension, value) of all dimensions with several selected values that are not fixed.
        fixed_indices: dimension → index, which restricts the cells. Raises BadValueError for more than MAX_COMPARED
        cells.
        """
        if (count := math.prod(len(indices) for indices in self.indices_by_dimension.values())) > MAX_COMPARED:
            raise BadValueError(
                f"the claim selects {count} combinations of coordinates", self.where.where, TOO_MANY_HINT
            )
        for index in itertools.product(
            *(
                [fixed_indices[name]] if name in fixed_indices else indices
                for name, indices in self.indices_by_dimension.items()
            )
        ):
            free_indices = [
                (name, k)
                for name, k in zip(self.indices_by_dimension, index, strict=True)
                if self._is_free(name, fixed_indices)
            ]
            yield (
                tuple((name, self._get_coordinate_value(name, k)) for name, k in free_indices),
                RunCell(self.part, index),
            )

    def _is_free(self, name: str, fixed: Mapping[str, int]) -> bool:
        """Return whether a dimension has several selected values and is not in `fixed`."""
        return name not in fixed and len(self.indices_by_dimension[name]) > 1

    def _get_coordinate_value(self, name: str, index: int) -> Any:
        """Return the value of the coordinate with the name of a dimension at an index, as a Python number or text.

        name: of the dimension. Without such a coordinate, it is the index itself.
        """
        coordinate = next(
            (candidate for candidate in self.plan.coordinates if candidate.name == name and candidate.over == (name,)),
            None,
        )
        return (
            index
            if coordinate is None
            else coordinate.values[index].item()
            if hasattr(coordinate.values[index], "item")
            else coordinate.values[index]
        )


@dataclass(frozen=True, eq=False)
class ResolvedNumber:
    """A published number with its cell of runs and its printed value (SI); None: the claim has no value."""

    claim: NumberClaim
    cell: RunCell
    unit: str
    printed: float | None


@dataclass(frozen=True, eq=False)
class ResolvedTrend:
    """A published trend with its checks; () for a trend with the key `not_computed`."""

    claim: TrendClaim
    checks: tuple[Check, ...]


@dataclass(frozen=True, eq=False)
class ResolvedClaims:
    """All claims of a study file."""

    numbers: tuple[ResolvedNumber, ...] = ()
    trends: tuple[ResolvedTrend, ...] = ()


def resolve_claims(plans: Plans) -> ResolvedClaims:
    """Resolve the names, units and selections of all claims of a study file, and return them with cells and checks.

    It is called before the runs. Raises one error that combines the errors of all claims, each at its location.
    """
    claims, errors = plans.file.claims, list[InputError]()
    numbers, trends = list[ResolvedNumber](), list[ResolvedTrend]()
    for number in claims.numbers:
        try:
            numbers.append(_resolve_number_claim(plans, number))
        except InputError as error:
            errors.append(error)
    for trend in claims.trends:
        try:
            checks = (check for statement in trend.statements for check in _build_checks(plans, statement))
            trends.append(ResolvedTrend(trend, limit_checks(checks, trend.name)))
        except InputError as error:
            errors.append(error)
    if errors:
        raise combine_errors(errors)
    return ResolvedClaims(tuple(numbers), tuple(trends))


def _resolve_number_claim(plans: Plans, claim: NumberClaim) -> ResolvedNumber:
    """Return a published number with its cell, the SI unit of its measure, and its printed value in SI (or None).

    Raises BadValueError if the claim selects several cells, an InputError for unknown names or a wrong unit.
    """
    selected = _resolve_selection(plans, claim.selection)
    cells = [cell for _, cell in selected.iterate_cells({})]
    if len(cells) > 1:
        varying = [
            f"{name} ({len(indices)})" for name, indices in selected.indices_by_dimension.items() if len(indices) > 1
        ]
        hint = f"select one value in at: of {', '.join(varying)}"
        raise BadValueError(f"{claim.name} selects {len(cells)} cells, expected one", claim.name.where, hint)
    unit_text = _find_measure_unit(selected.plan, claim.measure)
    return ResolvedNumber(
        claim, cells[0], unit_text, None if claim.value is None else _parse_value_with_unit(claim.value, unit_text)
    )


def _find_measure_unit(plan: Plan, measure: Text) -> str:
    """Return the SI unit of a measure in a plan. Raises UnknownNameError at the measure if the plan lacks it."""
    known_names = [candidate.name for candidate in plan.run_settings.measures]
    if measure not in known_names:
        raise make_unknown_name_error("measure", measure, known_names, measure.where)
    return plan.units[str(measure)]


def _parse_value_with_unit(text: Text, unit_text: str) -> float:
    """Return the value in SI of a text such as "157 m/s^2"; `unit_text` is the expected SI unit, "" for a pure number.

    Raises an InputError at the text for another dimension, or a text that is not a number.
    """
    known_dimension = find_unit(unit_text).dimension if unit_text and find_unit(unit_text) else None  # type: ignore[union-attr]
    exponents = (
        (float(known_dimension.length), float(known_dimension.mass), float(known_dimension.time))
        if known_dimension
        else (0.0, 0.0, 0.0)
    )
    return parse_real_value(text, RuntimeParameter("value", unit_text, 0.0, False, exponents))


def _resolve_selection(plans: Plans, selection: Selection) -> ResolvedSelection:
    """Return the part of a selection, and the indices along each dimension that its coordinate values allow.

    A coordinate along several dimensions, or along starts, cannot be selected. Raises an InputError at its location for
    an unknown or missing part, an unknown coordinate, or a value that no run has.
    """
    part, where = "", selection.where.where
    if plans.named:
        if selection.part is None:
            raise UnknownKeyError("the claim has no part", where, f"expected part: one of {', '.join(plans.by_part)}")
        part = str(selection.part)
        if part not in plans.by_part:
            raise make_unknown_name_error("part", part, list(plans.by_part), selection.part.where)
    elif selection.part is not None:
        raise BadValueError("the file has no parts", selection.part.where, "remove part:")
    plan = plans.by_part[part]
    indices_by_dimension = {name: tuple(range(length)) for name, length in zip(plan.dims, plan.shape, strict=True)}
    for name, value in selection.at.items():
        coordinate = _find_coordinate(plan, name)
        matching = _find_value_indices(coordinate, value)
        if coordinate.over:
            indices_by_dimension[coordinate.over[0]] = tuple(
                k for k in indices_by_dimension[coordinate.over[0]] if k in matching
            )
        if not matching or coordinate.over and not indices_by_dimension[coordinate.over[0]]:
            raise BadValueError(f"no run has {name} {str(value)[:60]!r}", value.where, _format_values_hint(coordinate))
    return ResolvedSelection(
        part,
        plan,
        {name: matching for name, matching in indices_by_dimension.items() if name not in PERTURBATION_DIMENSIONS},
        selection.where,
    )


def _find_coordinate(plan: Plan, name: Text) -> Coordinate:
    """Return the coordinate with this name, with or without "parameters.", that varies along at most one dimension.

    Coordinates along PERTURBATION_DIMENSIONS are unknown here. Raises UnknownNameError at the name.
    """
    coordinates = {
        candidate.name: candidate
        for candidate in plan.coordinates
        if len(candidate.over) < 2 and not set(candidate.over) & set(PERTURBATION_DIMENSIONS)
    }
    coordinate = coordinates.get(str(name)) or coordinates.get(str(name).removeprefix("parameters."))
    if coordinate is None:
        raise make_unknown_name_error("coordinate", name, list(coordinates), name.where)
    return coordinate


def _find_value_indices(coordinate: Coordinate, value: Text) -> set[int]:
    """Return the indices at which a coordinate has a value: an equal text, or a number within VALUE_RTOL.

    Empty if there is none. Raises an InputError at the value if it is not a number with the coordinate's dimension.
    """
    values = np.atleast_1d(np.asarray(coordinate.values))
    if values.dtype.kind in "OU":
        return {k for k, text in enumerate(values.tolist()) if str(text) == value.strip()}
    expected = _parse_value_with_unit(value, coordinate.unit)
    return set(np.flatnonzero(np.abs(values - expected) <= VALUE_RTOL * np.abs(values)).tolist())


def _format_values_hint(coordinate: Coordinate) -> str:
    """Return a hint with the first MAX_LISTED values of a coordinate and its unit: "expected one of: 1, 2, … (m)"."""
    values = [
        str(value) if isinstance(value, str) else f"{value:.6g}" for value in np.atleast_1d(coordinate.values).tolist()
    ]
    ellipsis = ", …" if len(values) > MAX_LISTED else ""
    shown = f" ({coordinate.unit})" if coordinate.unit else ""
    return f"expected one of: {', '.join(values[:MAX_LISTED])}{ellipsis}{shown}"


def _build_checks(plans: Plans, statement: TrendStatement) -> Iterator[Check]:
    """Yield the checks of one statement of a trend, by its kind.

    Kinds: counts of components, a trend along a dimension, a comparison of two selections (key `than`), or conditions
    on single cells. Raises an InputError at its location for unknown names, coordinates or units.
    """
    selection = _resolve_selection(plans, statement.selection)
    if statement.kind == COUNTS:
        yield _build_count_check(selection, statement)
        return
    for measure in (*statement.measures, *statement.others):
        _find_measure_unit(selection.plan, measure)
    if statement.kind in TRENDS_ALONG_DIMENSION:
        yield from _build_checks_along_dimension(selection, statement)
    elif statement.than is not None:
        yield from _build_comparison_checks(selection, _resolve_selection(plans, statement.than), statement)
    else:
        yield from _build_checks_of_cells(selection, statement)


def _parse_fraction(statement: TrendStatement, default: float) -> float:
    """Return the pure number `by` (or `within`) of a statement, a factor or fraction; `default` if it has none."""
    return default if statement.by is None else _parse_value_with_unit(statement.by, "")


def _build_checks_along_dimension(selection: ResolvedSelection, statement: TrendStatement) -> Iterator[Check]:
    """Yield the checks of a statement along a dimension, such as `grows_along`, for each combination of the others.

    Cells are sorted by the coordinate if its values are numbers, else in the order of the file. Raises BadValueError if
    fewer than two values are selected.
    """
    coordinate = _find_coordinate(selection.plan, statement.text)
    if not coordinate.over or len(selection.indices_by_dimension[coordinate.over[0]]) < 2:
        message = f"nothing to compare along {str(statement.text)[:60]!r}: it has one value here"
        raise BadValueError(message, statement.text.where, "remove it from at:, or name another dimension")
    (dimension,) = coordinate.over
    order = selection.indices_by_dimension[dimension]
    if np.asarray(coordinate.values).dtype.kind not in "OU":
        order = tuple(sorted(order, key=lambda k: float(coordinate.values[k])))
    cells_by_index = [dict(selection.iterate_cells({dimension: k})) for k in order]
    for key in cells_by_index[0]:
        yield from _build_checks_of_ordered_cells([row[key] for row in cells_by_index], statement)


def _build_checks_of_ordered_cells(cells: list[RunCell], statement: TrendStatement) -> Iterator[Check]:
    """Yield the checks of cells that are ordered along a dimension, for each measure of the statement.

    `grows_along` compares consecutive cells (key `by`: smallest ratio, default 1), `alike_along` all pairs (`by`:
    relative tolerance, default 0), and `spreads_along` the ranges of two measures over all cells.
    """
    for k, measure in enumerate(map(str, statement.measures)):
        if statement.kind == "grows_along":
            for pair in itertools.pairwise(cells):
                yield Check(pair, (measure,), _make_larger_condition(measure, _parse_fraction(statement, 1.0)))
        elif statement.kind == "alike_along":
            for two in itertools.combinations(cells, 2):
                yield Check(two, (measure,), _make_equality_condition(measure, _parse_fraction(statement, 0.0)))
        else:
            other = str(statement.others[k])
            yield Check(tuple(cells), (measure, other), _make_range_condition(measure, other, len(cells)))


def _make_larger_condition(measure: str, factor: float) -> Callable[[ReadMeasure], Array]:
    """Return the condition that a measure of the second cell exceeds `factor` times that of the first.

    A condition is a function of `ReadMeasure` that returns a flag for each combination of runs.
    """
    return lambda read_measure: read_measure(1, measure) > factor * read_measure(0, measure)


def _make_equality_condition(measure: str, tolerance: float) -> Callable[[ReadMeasure], Array]:
    """Return the condition |a − b| ≤ tolerance · max(|a|, |b|) on the values a, b of a measure in two cells."""

    def is_met(read_measure: ReadMeasure) -> Array:
        """Return a flag for each combination of runs: whether both values are equal within the tolerance."""
        a, b = read_measure(0, measure), read_measure(1, measure)
        return np.asarray(np.abs(a - b) <= tolerance * np.maximum(np.abs(a), np.abs(b)))

    return is_met


def _make_range_condition(measure: str, other_measure: str, n_cells: int) -> Callable[[ReadMeasure], Array]:
    """Return the condition that the range (maximum less minimum) of a measure over n cells exceeds that of another."""

    def compute_range(read_measure: ReadMeasure, name: str) -> Array:
        """Return the maximum less the minimum of a measure over the cells, for each combination of runs."""
        values = [read_measure(k, name) for k in range(n_cells)]
        return np.asarray(reduce(np.maximum, values) - reduce(np.minimum, values))

    return lambda read_measure: compute_range(read_measure, measure) > compute_range(read_measure, other_measure)


def _build_comparison_checks(
    first_selection: ResolvedSelection, second_selection: ResolvedSelection, statement: TrendStatement
) -> Iterator[Check]:
    """Yield the checks of a statement that compares two selections cell by cell: `larger` or `most_lowered`.

    Raises BadValueError unless both selections have the same values of all other coordinates, UnknownNameError for a
    measure that the second part lacks.
    """
    for name in (*statement.measures, *statement.others):
        _find_measure_unit(second_selection.plan, name)
    first_cells, second_cells = dict(first_selection.iterate_cells({})), dict(second_selection.iterate_cells({}))
    if first_cells.keys() != second_cells.keys():
        message = f"{statement.text} and the selection that it is compared with select different runs"
        hint = "coordinates that neither selection fixes must have the same values in both"
        raise BadValueError(message, statement.text.where, hint)
    for key, cell in first_cells.items():
        for measure in [str(name) for name in statement.measures]:
            if statement.kind == "larger":
                yield Check(
                    (second_cells[key], cell),
                    (measure,),
                    _make_larger_condition(measure, _parse_fraction(statement, 1.0)),
                )
            for other in [str(name) for name in statement.others]:
                yield Check((cell, second_cells[key]), (measure, other), _make_decrease_condition(measure, other))


def _make_decrease_condition(measure: str, other_measure: str) -> Callable[[ReadMeasure], Array]:
    """Return the condition |b₁/a₁| < |b₂/a₂|: a measure falls by a larger factor than another from cell a to cell b.

    It is evaluated as |b₁ a₂| < |b₂ a₁|, without a division.
    """
    return lambda read_measure: (
        np.abs(read_measure(1, measure) * read_measure(0, other_measure))
        < np.abs(read_measure(1, other_measure) * read_measure(0, measure))
    )


def _build_checks_of_cells(selection: ResolvedSelection, statement: TrendStatement) -> Iterator[Check]:
    """Yield the checks of each selected cell alone: `exceeds` another measure of the same run, or a number.

    The kind for a number is "above", "below" or "near". Key `by`: for `exceeds` the factor (default 1), for "near" the
    relative tolerance (default 0).
    """
    for _, cell in selection.iterate_cells({}):
        for name in statement.measures:
            measure = str(name)
            if statement.others:
                yield Check(
                    (cell,),
                    (measure, str(statement.others[0])),
                    _make_excess_condition(measure, str(statement.others[0]), _parse_fraction(statement, 1.0)),
                )
                continue
            number, within = (
                _parse_value_with_unit(statement.text, _find_measure_unit(selection.plan, name)),
                _parse_fraction(statement, 0.0),
            )
            low = {"above": number, "near": number - within * abs(number)}.get(statement.kind, -np.inf)
            high = {"below": number, "near": number + within * abs(number)}.get(statement.kind, np.inf)
            yield Check((cell,), (measure,), _make_interval_condition(measure, low, high, statement.kind == "near"))


def _make_excess_condition(measure: str, other_measure: str, factor: float) -> Callable[[ReadMeasure], Array]:
    """Return the condition that a measure exceeds `factor` times another one of the same run."""
    return lambda read_measure: read_measure(0, measure) > factor * read_measure(0, other_measure)


def _make_interval_condition(
    measure: str, low: float, high: float, includes_ends: bool
) -> Callable[[ReadMeasure], Array]:
    """Return the condition that a measure lies between `low` and `high`, with the ends if `includes_ends`."""

    def is_met(read_measure: ReadMeasure) -> Array:
        """Return a flag for each run: whether its value lies in the interval."""
        values = read_measure(0, measure)
        return np.asarray((values >= low) & (values <= high) if includes_ends else (values > low) & (values < high))

    return is_met


def _build_count_check(selection: ResolvedSelection, statement: TrendStatement) -> Check:
    """Return the check that all selected scenes have the claimed numbers of components (`counts`).

    It has no cells, since its result is the same in every run and known before the runs.
    """
    structure = [coordinate.length for coordinate in selection.plan.structure_dimensions]
    indices_by_dimension = [cell.index[: len(structure)] for _, cell in selection.iterate_cells({})]
    part_indices = {
        int(np.ravel_multi_index(cell_index, structure)) if structure else 0 for cell_index in indices_by_dimension
    }
    sources = [selection.plan.parts[k].simulation.source for k in sorted(part_indices)]
    is_true = all(
        _count_components(source)[str(name)] == count for source in sources for name, count in statement.counts.items()
    )
    return Check((), (), lambda read_measure: np.array(is_true))


def _count_components(source: KernelSource) -> dict[str, int]:
    """Return the numbers of components of a scene by the keys of `counts`; "rows": constraint equations."""
    return {
        "bodies": len(source.bodies),
        "joints": len(source.joints) + len(source.clearances),
        "drives": len(source.drives),
        "freedoms": source.degrees_of_freedom,
        "rows": len(source.equations),
        "coordinates": len(source.coordinates),
        "play": len(source.clearances),
    }

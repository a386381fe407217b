"""Read the parameters of many runs, from a sequence of mappings or from columns."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError, InputError
from gudgeon.language.argument_checks import mapping, message
from gudgeon.model.arrays import as_c_array
from gudgeon.model.compiled import AT_ONCE, Array, CompiledModel
from gudgeon.model.parameters import RELATIONS, check, conditions, given_slots, number, without_baumgarte
from gudgeon.model.sizes import unresolved_clearances
from gudgeon.model.written import undefined_rows

FLOATS = (float, np.floating)  # types that may hold NaN
Values: TypeAlias = float | str
ParameterSets: TypeAlias = Sequence[Mapping[str, Values]] | Mapping[str, Values | Sequence[Values] | ArrayLike] | Array
Mask: TypeAlias = NDArray[np.bool_]


@dataclass(frozen=True)
class Same:
    """Hold a column with one value for all runs."""

    value: Any


Column: TypeAlias = Array | list[Any] | Same


class Columns(Sequence[Mapping[str, Any]]):
    """Provide the parameter mapping of each of n runs from columns by name, without the values left out."""

    def __init__(self, columns: Mapping[str, Column], n: int) -> None:
        self.columns, self.n = columns, n
        self.left_out: dict[int, list[str]] = {}  # names that are left out, by run

    def __len__(self) -> int:
        """Return the number of runs."""
        return self.n

    def __getitem__(self, key: Any) -> Any:
        """Return the mapping of one run, or the list of those of a slice."""
        at = range(self.n)[key]
        if isinstance(at, range):
            return [self[i] for i in at]
        out = self.left_out.get(at, ())
        return {name: _value_of_run(one, at) for name, one in self.columns.items() if name not in out}

    def leave_out(self) -> dict[int, BadValueError]:
        """Leave out values that are NaN or infinite; return an error for each run that has any, by index."""
        bad: dict[int, BadValueError] = {}
        for name, one in self.columns.items():
            for i in _not_finite_in(one, self.n):
                self.left_out.setdefault(i, []).append(name)
                bad.setdefault(i, BadValueError(f"{name}: {_value_of_run(one, i)} is not a finite number"))
        return dict(sorted(bad.items()))


def _value_of_run(one: Column, i: int) -> Any:
    """Return the value of a column for run i."""
    if isinstance(one, Same):
        return one.value
    return one.item(i) if isinstance(one, np.ndarray) else one[i]


def _not_finite_in(one: Column, n: int) -> Iterable[int]:
    """Return the indices of the runs whose value in a column is NaN or infinite."""
    if isinstance(one, Same):
        return range(n if _is_not_finite(one.value) else 0)
    if isinstance(one, np.ndarray):
        return list[int](np.flatnonzero(~np.isfinite(one)).tolist())
    return [i for i, x in enumerate(one) if _is_not_finite(x)]


def _is_not_finite(x: Any) -> bool:
    """Return whether a value is a float that is NaN or infinite."""
    return isinstance(x, FLOATS) and not math.isfinite(x)


def rows_of(parameters: ParameterSets) -> tuple[Sequence[Mapping[str, Any]], dict[int, BadValueError]]:
    """Return a parameter mapping for each run, and errors of runs with NaN or infinite values, by index.

    `parameters`: a mapping for every run; or {address: one value, or one for every run}, also as a structured array.
    Raises BadValueError.
    """
    rows, bad = _read_rows(parameters), dict[int, BadValueError]()
    if not rows:
        raise BadValueError("parameters: no run is asked for", hint="a mapping for every run, or {address: values}")
    if isinstance(rows, Columns):
        bad = rows.leave_out()
    elif len(rows) > 1:
        floats = [x for row in rows for x in row.values() if isinstance(x, FLOATS)]
        for i, row in enumerate(() if all(map(math.isfinite, floats)) else rows):
            if odd := [name for name, x in row.items() if _is_not_finite(x)]:
                bad[i] = BadValueError(f"{odd[0]}: {row[odd[0]]} is not a finite number")
                rows[i] = {name: value for name, value in row.items() if name not in odd}
    if len(bad) == len(rows):
        raise BadValueError(f"parameters: {bad[0]}")
    return rows, bad


def given_each(source: KernelSource, rows: Sequence[Mapping[str, Any]]) -> tuple[Array, Mask]:
    """Return values and mask (n_runs, n_slots) of the given parameters; raises as `given_slots`."""
    plain = read_uniform_rows(source, rows)
    found: tuple[Array, Mask] = each_of(rows, lambda _, row: given_slots(source, row)) if plain is None else plain
    return found


def read_uniform_rows(source: KernelSource, rows: Sequence[Mapping[str, Any]]) -> tuple[Array, Mask] | None:
    """Return values and mask (n_runs, n_slots) if all runs give the same parameters as floats; else None.

    This is fast: it avoids reading each run by itself. A column with one value for all runs may hold any text of a
    number.
    """
    first, place = rows[0].keys(), source.place
    if not isinstance(rows, Columns):
        if not all(row.keys() == first for row in rows):
            return None
        rows = Columns({name: [row[name] for row in rows] for name in first}, len(rows))
    at = [place.get(name, place.get(f"parameters.{name}", -1)) for name in rows.columns if isinstance(name, str)]
    if len(at) < len(rows.columns) or len({*at, -1}) <= len(at) or any(source.slots[k].words for k in at):
        return None
    shape = (len(place), len(rows))  # memory of parameters that no run gives is never touched
    given, mask = np.zeros(shape).T, np.zeros(shape, dtype=bool).T
    for k, one in zip(at, rows.columns.values(), strict=True):
        numbers = _read_floats(one, source.slots[k])
        if numbers is None:
            return None
        given[:, k], mask[:, k] = numbers, True
    for i, names in rows.left_out.items():
        out = [k for k, name in zip(at, rows.columns, strict=True) if name in names]
        given[i, out], mask[i, out] = 0.0, False
    return (given, mask) if np.isfinite(given[:, at]).all() else None


def _read_floats(one: Column, slot: Slot) -> Array | float | None:
    """Return the numbers of a column, including NaN; None if they must be read one by one."""
    if isinstance(one, Same):
        try:
            return number(one.value, slot)
        except InputError:
            return None
    if isinstance(one, list) and not {*map(type, one)} <= {float, np.float64}:
        return None
    numbers = np.asarray(one, dtype=float)
    size = np.abs(numbers)
    return None if ((size > 0.0) & (size < sys.float_info.min)).any() else numbers


def each_of(rows: Sequence[Mapping[str, Any]], slots: Callable[[int, Mapping[str, Any]], tuple[Array, Array]]) -> Any:
    """Return values and mask (n_runs, n_slots) by calling `slots` for each run. BadValueError names the run."""
    pairs = []
    for i, row in enumerate(rows):
        try:
            pairs.append(slots(i, row))
        except BadValueError as error:
            raise BadValueError(f"run {i}: {error}") from None
    return np.array([given for given, _ in pairs]), np.array([mask for _, mask in pairs])


def _read_rows(parameters: ParameterSets) -> list[Mapping[str, Any]] | Columns:
    """Return the parameters as a list of mappings or as Columns. Raise BadValueError."""
    if isinstance(parameters, np.ndarray) and parameters.dtype.names is not None:
        table: NDArray[Any] = np.atleast_1d(parameters)
        parameters = {name: table[name] for name in parameters.dtype.names}
    if getattr(parameters, "ndim", 0) == 2 and hasattr(parameters, "columns"):  # a table of pandas
        parameters = {str(name): parameters[name] for name in parameters.columns}
    if not isinstance(parameters, Mapping) and not hasattr(parameters, "items"):
        iterable = isinstance(parameters, Iterable) and not isinstance(parameters, (str, bytes, np.ndarray))
        rows: list[Any] = list(parameters) if iterable else [None]
        if not all(issubclass(kind, Mapping) for kind in {*map(type, rows)}):
            raise BadValueError("parameters: expected a mapping for every run, or one of columns: {address: values}")
        return rows
    parameters = mapping(parameters, "parameters", "a mapping for every run, or {address: values}")
    columns = {name: _read_column(f"parameters: {name}", values) for name, values in parameters.items()}
    lengths = {name: len(column) for name, column in columns.items() if not isinstance(column, Same)}
    if len(set(lengths.values())) > 1:
        message = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise BadValueError(
            f"parameters: columns of different lengths: {message}", hint="one value, or one for every run"
        )
    found = Columns(columns, next(iter(lengths.values()), 1))
    return list(found) if len(found) == 1 else found


def column(name: str, values: Any) -> list[Any] | None:
    """Return the values of every run, or None if one holds for all. Raise BadValueError, which begins with `name`."""
    found = _read_column(name, values)
    return None if isinstance(found, Same) else found.tolist() if isinstance(found, np.ndarray) else found


def _read_column(name: str, values: Any) -> Column:
    """Return the values of one name as a column. Raise BadValueError."""
    try:
        shape = () if isinstance(values, (str, bytes, Mapping, type)) else np.shape(values)
    except ValueError:  # rows of different lengths
        raise BadValueError(f"{name} is {message(values)}: expected one value for every run") from None
    if not shape:
        return Same(values)
    if len(shape) != 1:
        raise BadValueError(f"{name} has shape {shape}, expected one value for every run")
    if isinstance(values, np.ndarray):
        return as_c_array(values, name) if values.dtype.kind in "iuf" else list[Any](values.tolist())
    return list(values) if hasattr(values, "__iter__") else _read_column(name, np.asarray(values))  # by __array__ alone


def prepare_sets(
    compiled: CompiledModel, given: Array, is_given: Mask, free: bool
) -> tuple[Array, Array, dict[int, BadValueError]]:
    """Return the values of all runs, (n_runs, n_slots + n_derived), those for the motion, and invalid runs.

    With `free`, the values for the motion have no Baumgarte gains. Runs are invalid if their parameters break a
    condition of the file; their errors are returned by index.
    """
    p = compiled.prepare_each(given, is_given)
    motion = without_baumgarte(compiled, given, is_given) if free else p
    bad = {}
    parts = [slice(k, k + AT_ONCE) for k in range(0, len(p), AT_ONCE)]
    valid = [_satisfies_conditions(compiled.source, p[part], is_given[part]) for part in parts]
    for i in np.flatnonzero(~np.concatenate(valid)).tolist():
        try:
            check(compiled.source, p[i], is_given[i])
        except BadValueError as error:
            bad[i] = error
    return p, motion, bad


def _satisfies_conditions(source: KernelSource, p: Array, is_given: Mask) -> Mask:
    """Return a mask (n_runs,) of the runs that satisfy the conditions of parameters.check."""
    place = source.place
    valid = np.asarray(np.isfinite(p).all(axis=1))
    for condition in conditions(source):
        several = [place[address] for address in condition.addresses]
        bound = p[:, several].sum(axis=1) if several else float(condition.bound)
        valid &= RELATIONS[condition.relation](p[:, place[condition.address]], bound)
    return valid & ~unresolved_clearances(source, p).any(axis=1) & ~undefined_rows(source, p, is_given)

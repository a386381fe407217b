"""The parameters of many runs: rows of slots, from a sequence of mappings or from columns."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError
from gudgeon.language.wanted import mapping, told
from gudgeon.model.arrays import taken
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameters import RELATIONS, check, conditions, given_slots, without_baumgarte
from gudgeon.model.sizes import far_clearances

Values: TypeAlias = float | str
ParameterSets: TypeAlias = Sequence[Mapping[str, Values]] | Mapping[str, Values | Sequence[Values] | ArrayLike] | Array
Mask: TypeAlias = NDArray[np.bool_]


def rows_of(parameters: ParameterSets) -> tuple[list[Mapping[str, Any]], dict[int, BadValueError]]:
    """A mapping for each run, and runs that have none: one of their numbers is NaN or infinite.

    `parameters`: a mapping for every run; or {address: one value, or one for every run}, as which a structured
    array counts too. Raises BadValueError.
    """
    rows, bad = _rows(parameters), dict[int, BadValueError]()
    if not rows:
        raise BadValueError("parameters: no run is asked for", hint="a mapping for every run, or {address: values}")
    for i, row in enumerate(rows):
        odd = [name for name, x in row.items() if isinstance(x, (float, np.floating)) and not math.isfinite(x)]
        if odd and len(rows) > 1:
            bad[i] = BadValueError(f"{odd[0]}: {row[odd[0]]} is not a finite number")
            rows[i] = {name: value for name, value in row.items() if name not in odd}
    if len(bad) == len(rows):
        raise BadValueError(f"parameters: {bad[0]}")
    return rows, bad


def given_each(source: KernelSource, rows: Sequence[Mapping[str, Any]]) -> tuple[Array, Mask]:
    """Values and mask of the slots that are given, (n_runs, n_slots) each; raises as `given_slots`."""
    plain = plain_each(source, rows)
    found: tuple[Array, Mask] = each_of(rows, lambda _, row: given_slots(source, row)) if plain is None else plain
    return found


def plain_each(source: KernelSource, rows: Sequence[Mapping[str, Any]]) -> tuple[Array, Mask] | None:
    """The same at once, where all runs are given the same slots as floats; None where each is to be read by itself."""
    first, place = rows[0].keys(), source.place
    at = [place.get(name, place.get(f"parameters.{name}", -1)) for name in first if isinstance(name, str)]
    alike = all(row.keys() == first for row in rows) and len(at) == len(first)
    if not alike or len({*at, -1}) <= len(at) or any(source.slots[k].words for k in at):
        return None
    values = [[row[name] for name in first] for row in rows]
    if not all(type(x) in (float, np.float64) for row in values for x in row):
        return None
    numbers = np.array(values, dtype=float).reshape(len(rows), len(at))
    size = np.abs(numbers)
    if not ((size == 0.0) | ((size >= sys.float_info.min) & (size < math.inf))).all():
        return None
    given, mask = np.zeros((len(rows), len(place))), np.zeros((len(rows), len(place)), dtype=bool)
    given[:, at], mask[:, at] = numbers, True
    return given, mask


def each_of(rows: Sequence[Mapping[str, Any]], slots: Callable[[int, Mapping[str, Any]], tuple[Array, Array]]) -> Any:
    """Values and mask of the slots that are given, (n_runs, n_slots) each; `slots` of a run. BadValueError names it."""
    pairs = []
    for i, row in enumerate(rows):
        try:
            pairs.append(slots(i, row))
        except BadValueError as error:
            raise BadValueError(f"run {i}: {error}") from None
    return np.array([given for given, _ in pairs]), np.array([mask for _, mask in pairs])


def _rows(parameters: ParameterSets) -> list[Mapping[str, Any]]:
    if isinstance(parameters, np.ndarray) and parameters.dtype.names is not None:
        table: NDArray[Any] = np.atleast_1d(parameters)
        parameters = {name: table[name] for name in parameters.dtype.names}
    if getattr(parameters, "ndim", 0) == 2 and hasattr(parameters, "columns"):  # a table of pandas
        parameters = {str(name): parameters[name] for name in parameters.columns}
    if not isinstance(parameters, Mapping) and not hasattr(parameters, "items"):
        iterable = isinstance(parameters, Iterable) and not isinstance(parameters, (str, bytes, np.ndarray))
        rows: list[Any] = list(parameters) if iterable else [None]
        if not all(isinstance(row, Mapping) for row in rows):
            raise BadValueError("parameters: expected a mapping for every run, or one of columns: {address: values}")
        return rows
    parameters = mapping(parameters, "parameters", "a mapping for every run, or {address: values}")
    columns = {name: column(f"parameters: {name}", values) for name, values in parameters.items()}
    lengths = {name: len(column) for name, column in columns.items() if column is not None}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise BadValueError(f"parameters: columns of different lengths: {told}", hint="one value, or one for every run")
    n = next(iter(lengths.values()), 1)
    whole = {name: [parameters[name]] * n if column is None else column for name, column in columns.items()}
    return [{name: column[i] for name, column in whole.items()} for i in range(n)]


def column(name: str, values: Any) -> list[Any] | None:
    """The values of every run; None where one stands for all. Raises BadValueError, which begins with `name`."""
    try:
        shape = () if isinstance(values, (str, bytes, Mapping, type)) else np.shape(values)
    except ValueError:  # rows of different lengths
        raise BadValueError(f"{name} is {told(values)}: expected one value for every run") from None
    if not shape:
        return None
    if len(shape) != 1:
        raise BadValueError(f"{name} has shape {shape}, expected one value for every run")
    if isinstance(values, np.ndarray):
        return taken(values, name).tolist() if values.dtype.kind in "iuf" else values.tolist()
    return list(values)


def prepare_sets(
    compiled: CompiledModel, given: Array, is_given: Mask, free: bool
) -> tuple[Array, Array, dict[int, BadValueError]]:
    """Parameters of all runs, (n_runs, n_slots + n_derived): as they are, and of the motion.

    With `free` the motion is without Baumgarte's terms. Then the runs, by number, whose parameters break a
    condition of the file.
    """
    p = compiled.prepare_each(given, is_given)
    motion = without_baumgarte(compiled, given, is_given) if free else p
    bad = {}
    for i in np.flatnonzero(~_valid(compiled.source, p)).tolist():
        try:
            check(compiled.source, p[i])
        except BadValueError as error:
            bad[i] = error
    return p, motion, bad


def _valid(source: KernelSource, p: Array) -> Mask:
    """What parameters.check asks for, of all runs at once, (n_runs,)."""
    place = {slot.address: k for k, slot in enumerate(source.slots)}
    valid = np.asarray(np.isfinite(p).all(axis=1))
    for condition in conditions(source):
        several = [place[address] for address in condition.addresses]
        bound = p[:, several].sum(axis=1) if several else float(condition.bound)
        valid &= RELATIONS[condition.relation](p[:, place[condition.address]], bound)
    return valid & ~far_clearances(source, p).any(axis=1)

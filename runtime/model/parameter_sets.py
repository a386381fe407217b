"""Read the parameters of many runs, from a sequence of mappings or from columns."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import BadValueError, InputError
from gudgeon.language.argument_checks import check_mapping, shorten_value
from gudgeon.model.arrays import as_c_array
from gudgeon.model.compiled import RUNS_PER_CALL, Array, CompiledModel
from gudgeon.model.file_expressions import find_undefined_runs
from gudgeon.model.parameters import (
    RELATIONS,
    check_parameter_values,
    compute_values_without_baumgarte,
    list_conditions,
    read_given_parameters,
    read_parameter_value,
)
from gudgeon.model.sizes import find_unresolved_clearances

FLOATS = (float, np.floating)  # types that may hold NaN
Values: TypeAlias = float | str
ParameterSets: TypeAlias = Sequence[Mapping[str, Values]] | Mapping[str, Values | Sequence[Values] | ArrayLike] | Array
Mask: TypeAlias = NDArray[np.bool_]


@dataclass(frozen=True)
class ConstantColumn:
    """Hold a column of parameters with one value for all runs."""

    value: Any


Column: TypeAlias = Array | list[Any] | ConstantColumn


class Columns(Sequence[Mapping[str, Any]]):
    """Provide the parameter mapping of each of n runs from columns by name, without the values left out."""

    def __init__(self, columns: Mapping[str, Column], n: int) -> None:
        self.columns, self.n = columns, n
        self.omitted_values: dict[int, dict[str, Any]] = {}  # values that are left out, by run and name

    def __len__(self) -> int:
        """Return the number of runs."""
        return self.n

    def __getitem__(self, key: Any) -> Any:
        """Return the mapping of one run, or the list of those of a slice; negative indices count from the end."""
        run_index = range(self.n)[key]
        if isinstance(run_index, range):
            return [self[i] for i in run_index]
        omitted_values = self.omitted_values.get(run_index, ())
        return {
            name: _get_value_of_run(column, run_index)
            for name, column in self.columns.items()
            if name not in omitted_values
        }

    def collect_nonfinite_values(self) -> dict[int, BadValueError]:
        """Return an error for each run with values that are NaN or infinite, by index in rising order.

        These values are recorded in `omitted_values`, and readers of the columns skip them. The columns
        stay.
        """
        errors: dict[int, BadValueError] = {}
        for name, column in self.columns.items():
            for i in _find_nonfinite_runs(column, self.n):
                self.omitted_values.setdefault(i, {})[name] = _get_value_of_run(column, i)
                errors.setdefault(i, BadValueError(f"{name}: {_get_value_of_run(column, i)} is not a finite number"))
        return dict(sorted(errors.items()))


def _get_value_of_run(column: Column, run_index: int) -> Any:
    """Return the value of a column for the run `run_index`; a NumPy number becomes a Python number."""
    if isinstance(column, ConstantColumn):
        return column.value
    return column.item(run_index) if isinstance(column, np.ndarray) else column[run_index]


def _find_nonfinite_runs(column: Column, n_runs: int) -> Iterable[int]:
    """Return the indices of the runs, of `n_runs`, whose value in a column is NaN or infinite."""
    if isinstance(column, ConstantColumn):
        return range(n_runs if _is_not_finite(column.value) else 0)
    if isinstance(column, np.ndarray):
        return list[int](np.flatnonzero(~np.isfinite(column)).tolist())
    return [i for i, x in enumerate(column) if _is_not_finite(x)]


def _is_not_finite(x: Any) -> bool:
    """Return whether a value is a float that is NaN or infinite."""
    return isinstance(x, FLOATS) and not math.isfinite(x)


def read_parameter_sets(
    parameters: ParameterSets,
) -> tuple[Sequence[Mapping[str, Any]], dict[int, BadValueError], dict[int, dict[str, Any]]]:
    """Return a parameter mapping for each run; errors of runs with NaN or infinite values, and these values, by index.

    `parameters`: a mapping for every run; or {address: one value, or one for every run}, also as a structured array or
    a pandas table. Values that are not finite are left out of the mappings. A single run is not tested. Raises
    BadValueError if there are no runs or all have such values.
    """
    parameter_sets, errors = _convert_to_parameter_sets(parameters), dict[int, BadValueError]()
    nonfinite_values: dict[int, dict[str, Any]] = {}
    if not parameter_sets:
        raise BadValueError("parameters is empty: expected at least one run", hint="a mapping, or {address: values}")
    if isinstance(parameter_sets, Columns):
        errors, nonfinite_values = parameter_sets.collect_nonfinite_values(), parameter_sets.omitted_values
    elif len(parameter_sets) > 1:
        floats = [x for parameter_set in parameter_sets for x in parameter_set.values() if isinstance(x, FLOATS)]
        for i, parameter_set in enumerate(() if all(map(math.isfinite, floats)) else parameter_sets):
            if nonfinite_names := [name for name, x in parameter_set.items() if _is_not_finite(x)]:
                errors[i] = BadValueError(
                    f"{nonfinite_names[0]}: {parameter_set[nonfinite_names[0]]} is not a finite number"
                )
                nonfinite_values[i] = {name: parameter_set[name] for name in nonfinite_names}
                parameter_sets[i] = {
                    name: value for name, value in parameter_set.items() if name not in nonfinite_names
                }
    if len(errors) == len(parameter_sets):
        raise BadValueError(f"parameters: {errors[0]}")
    return parameter_sets, errors, nonfinite_values


def read_given_parameters_of_runs(
    source: KernelSource, parameter_sets: Sequence[Mapping[str, Any]]
) -> tuple[Array, Mask]:
    """Return values and mask (n_runs, n_parameters) of the given parameters; raises as `read_given_parameters`.

    Runs that give the same parameters as floats are read at once.
    """
    values_and_mask = read_runs_with_equal_names(source, parameter_sets)
    result: tuple[Array, Mask] = (
        read_parameters_of_runs(parameter_sets, lambda _, parameter_set: read_given_parameters(source, parameter_set))
        if values_and_mask is None
        else values_and_mask
    )
    return result


def read_runs_with_equal_names(
    source: KernelSource, parameter_sets: Sequence[Mapping[str, Any]]
) -> tuple[Array, Mask] | None:
    """Return values and mask (n_runs, n_parameters) if all runs give the same parameters as floats; else None.

    This is fast: it avoids reading each run by itself. A column with one value for all runs may hold any text of a
    number. None also for choices, unknown names and parameters given twice.
    """
    names_of_first_run, index_by_address = parameter_sets[0].keys(), source.parameter_indices
    if not isinstance(parameter_sets, Columns):
        if not all(parameter_set.keys() == names_of_first_run for parameter_set in parameter_sets):
            return None
        parameter_sets = Columns(
            {name: [parameter_set[name] for parameter_set in parameter_sets] for name in names_of_first_run},
            len(parameter_sets),
        )
    parameter_indices = [
        index_by_address.get(name, index_by_address.get(f"parameters.{name}", -1))
        for name in parameter_sets.columns
        if isinstance(name, str)
    ]
    if (
        len(parameter_indices) < len(parameter_sets.columns)
        or len({*parameter_indices, -1}) <= len(parameter_indices)
        or any(source.parameters[k].words for k in parameter_indices)
    ):
        return None
    # parameter by parameter: memory of those not given stays untouched
    shape = (len(index_by_address), len(parameter_sets))
    given_values, mask = np.zeros(shape).T, np.zeros(shape, dtype=bool).T
    for k, column in zip(parameter_indices, parameter_sets.columns.values(), strict=True):
        numbers = _read_floats(column, source.parameters[k])
        if numbers is None:
            return None
        given_values[:, k], mask[:, k] = numbers, True
    for i, names in parameter_sets.omitted_values.items():
        omitted_indices = [
            k for k, name in zip(parameter_indices, parameter_sets.columns, strict=True) if name in names
        ]
        given_values[i, omitted_indices], mask[i, omitted_indices] = 0.0, False
    return (given_values, mask) if np.isfinite(given_values[:, parameter_indices]).all() else None


def _read_floats(column: Column, parameter: RuntimeParameter) -> Array | float | None:
    """Return the numbers of a column, including NaN; None if they must be read one by one.

    That is so for other types than floats, for subnormal numbers, and for a constant that is not valid, whose error is
    then reported. A column with one value for all runs gives one float.
    """
    if isinstance(column, ConstantColumn):
        try:
            return read_parameter_value(column.value, parameter)
        except InputError:
            return None
    if isinstance(column, list) and not {*map(type, column)} <= {float, np.float64}:
        return None
    numbers = np.asarray(column, dtype=float)
    magnitudes = np.abs(numbers)
    return None if ((magnitudes > 0.0) & (magnitudes < sys.float_info.min)).any() else numbers


def read_parameters_of_runs(
    parameter_sets: Sequence[Mapping[str, Any]],
    read_parameters: Callable[[int, Mapping[str, Any]], tuple[Array, Array]],
) -> Any:
    """Return the parameters of all runs: values (n_runs, n_parameters), and a mask, True where a value is given.

    `read_parameters`(i, mapping of run i) is called for each run and returns one row of both. Raises BadValueError,
    which names the run.
    """
    pairs = []
    for i, parameter_set in enumerate(parameter_sets):
        try:
            pairs.append(read_parameters(i, parameter_set))
        except BadValueError as error:
            raise BadValueError(f"run {i}: {error}") from None
    return np.array([given_values for given_values, _ in pairs]), np.array([mask for _, mask in pairs])


def _convert_to_parameter_sets(parameters: ParameterSets) -> list[Mapping[str, Any]] | Columns:
    """Return the parameters of runs as a list of mappings or as Columns, from the forms that `read_parameter_sets` has.

    Columns of a single run become a list. Raises BadValueError for other types and for columns of different lengths.
    """
    if isinstance(parameters, np.ndarray) and parameters.dtype.names is not None:
        table: NDArray[Any] = np.atleast_1d(parameters)
        parameters = {name: table[name] for name in parameters.dtype.names}
    if getattr(parameters, "ndim", 0) == 2 and hasattr(parameters, "columns"):  # a table of pandas
        parameters = {str(name): parameters[name] for name in parameters.columns}
    if not isinstance(parameters, Mapping) and not hasattr(parameters, "items"):
        iterable = isinstance(parameters, Iterable) and not isinstance(parameters, (str, bytes, np.ndarray))
        parameter_sets: list[Any] = list(parameters) if iterable else [None]
        if not all(issubclass(kind, Mapping) for kind in {*map(type, parameter_sets)}):
            raise BadValueError("parameters: expected a mapping for every run, or one of columns: {address: values}")
        return parameter_sets
    parameters = check_mapping(parameters, "parameters", "a mapping for every run, or {address: values}")
    columns = {name: _read_column(f"parameters: {name}", values) for name, values in parameters.items()}
    lengths = {name: len(column) for name, column in columns.items() if not isinstance(column, ConstantColumn)}
    if len(set(lengths.values())) > 1:
        message = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise BadValueError(
            f"parameters: columns of different lengths: {message}", hint="one value, or one for every run"
        )
    columns_of_runs = Columns(columns, next(iter(lengths.values()), 1))
    return list(columns_of_runs) if len(columns_of_runs) == 1 else columns_of_runs


def read_column(name: str, values: Any) -> list[Any] | None:
    """Return the values of a column as a list with one for each run; None if one value holds for all runs.

    Raises BadValueError, which begins with `name`.
    """
    read_values = _read_column(name, values)
    return (
        None
        if isinstance(read_values, ConstantColumn)
        else read_values.tolist()
        if isinstance(read_values, np.ndarray)
        else read_values
    )


def _read_column(name: str, values: Any) -> Column:
    """Return the values of one name as a column: one value for all runs, an array, or a list. Raises BadValueError.

    Texts, mappings and scalars are one value; arrays of numbers become arrays, other arrays lists.
    """
    try:
        shape = () if isinstance(values, (str, bytes, Mapping, type)) else np.shape(values)
    except ValueError:  # rows of different lengths
        raise BadValueError(f"{name} is {shorten_value(values)}: expected one value for every run") from None
    if not shape:
        return ConstantColumn(values)
    if len(shape) != 1:
        raise BadValueError(f"{name} has shape {shape}, expected one value for every run")
    if isinstance(values, np.ndarray):
        return as_c_array(values, name) if values.dtype.kind in "iuf" else list[Any](values.tolist())
    return list(values) if hasattr(values, "__iter__") else _read_column(name, np.asarray(values))  # by __array__ alone


def compute_parameter_values_of_runs(
    compiled: CompiledModel, given_values: Array, is_given: Mask, without_baumgarte: bool
) -> tuple[Array, Array, dict[int, BadValueError]]:
    """Return the values of all runs, those for the motion, and the errors of invalid runs by index.

    Both arrays are (n_runs, n_parameters + n_derived). With `without_baumgarte`, the values for the motion have no
    Baumgarte gains; else they are the same array. Runs are invalid if their parameters violate a condition of
    `parameters.check_parameter_values`.
    """
    p = compiled.prepare_parameters_of_runs(given_values, is_given)
    motion_values = compute_values_without_baumgarte(compiled, given_values, is_given) if without_baumgarte else p
    errors = {}
    parts = [slice(k, k + RUNS_PER_CALL) for k in range(0, len(p), RUNS_PER_CALL)]
    valid = [_find_valid_runs(compiled.source, p[part], is_given[part]) for part in parts]
    for i in np.flatnonzero(~np.concatenate(valid)).tolist():
        try:
            check_parameter_values(compiled.source, p[i], is_given[i])
        except BadValueError as error:
            errors[i] = error
    return p, motion_values, errors


def _find_valid_runs(source: KernelSource, p: Array, is_given: Mask) -> Mask:
    """Return a mask (n_runs,) of the runs that satisfy the conditions of `parameters.check_parameter_values`.

    p: (n_runs, n_parameters + n_derived); is_given: (n_runs, n_parameters). Runs with undefined expressions may be
    marked wrongly; `check_parameter_values` decides.
    """
    index_by_address = source.parameter_indices
    valid = np.asarray(np.isfinite(p).all(axis=1))
    for condition in list_conditions(source):
        bound_indices = [index_by_address[address] for address in condition.addresses]
        bound = p[:, bound_indices].sum(axis=1) if bound_indices else float(condition.bound)
        valid &= RELATIONS[condition.relation](p[:, index_by_address[condition.address]], bound)
    return valid & ~find_unresolved_clearances(source, p).any(axis=1) & ~find_undefined_runs(source, p, is_given)

"""Compute the parameter values of single runs from arrays in a fixed order of names, in preallocated arrays.

`parameters.py` reads mappings from names to values and explains errors. Here, names are read once, and each call only
decides whether its values are valid, in C (gudgeon_set_parameters).
"""

from __future__ import annotations

import operator
import sys
from collections.abc import Mapping, Sequence
from itertools import pairwise
from numbers import Number
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.boundary import GREATER, GREATER_OR_EQUAL, LESS, LESS_OR_EQUAL
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import ArrayError, BadValueError
from gudgeon.language.argument_checks import check_mapping, check_names, shorten_value
from gudgeon.model.arrays import FLAG, as_c_array, set_struct_pointers
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.file_expressions import describe_undefined_part, list_possibly_undefined_expressions
from gudgeon.model.parameters import collect_conditions, find_gain_indices, read_given_parameters

UNLABELLED_TYPES = {float, int, np.float64, list, tuple, np.ndarray}  # of rows and values without labels
MAX_DOUBLE, MIN_NORMAL = sys.float_info.max, sys.float_info.min
# codes of the operators of conditions in C
_RELATIONS = {
    operator.gt: GREATER,
    operator.ge: GREATER_OR_EQUAL,
    operator.lt: LESS,
    operator.le: LESS_OR_EQUAL,
}


class ParameterColumns:
    """Compute the values `p` and `p_motion` (n_rows, n_p) of runs whose parameters `names` are given as arrays.

    `p_motion` are the values for the motion, without Baumgarte gains unless `keeps_gains`; see
    `parameters.compute_values_without_baumgarte`. Without such gains it is the same array. `fixed` holds further
    parameters {address or name: value} of all runs. Raises InputError for names and for values of `fixed`.
    """

    def __init__(
        self, compiled: CompiledModel, names: Sequence[str], fixed: Mapping[str, Any], keeps_gains: bool, n_rows: int
    ) -> None:
        source = self.source = compiled.source
        self.compiled, self.names, self.fixed = compiled, names, fixed
        _, is_given = read_given_parameters(source, dict.fromkeys(names, 1.0) | dict(fixed))
        gains = [] if keeps_gains else find_gain_indices(source)
        values, is_fixed = read_given_parameters(source, fixed)
        self._given = np.stack([values, values])  # rows: of the run, and of its motion
        self._is_given = np.stack([is_given, is_given]).astype(FLAG)
        self._given[1, gains], self._is_given[1, gains] = 0.0, 1
        n_parameters = len(source.parameters)
        indices_by_column = [_find_indices_of_name(source, name) for name in names]
        # pairs: a column, and where its value is written, as an offset from the first value given
        targets = [
            (i, offset)
            for i, indices in enumerate(indices_by_column)
            for offset in (*indices, *(n_parameters + k for k in indices if k not in gains))
        ]
        self._has_choices = any(
            parameter.words and mask for parameter, mask in zip(source.parameters, is_given, strict=True)
        )
        self.p = np.tile(compiled.prepare(values, is_fixed), (n_rows, 1))
        self.p_motion = self.p.copy() if gains else self.p
        self._has_possibly_undefined_expressions = bool(list_possibly_undefined_expressions(source))
        self.x = np.zeros(len(names))  # values of the next run
        self.x_pointer = compiled.pointer(self.x)
        self._row_pointers = [
            (compiled.pointer(self.p[k], is_written=True), compiled.pointer(self.p_motion[k], is_written=True))
            for k in range(n_rows)
        ]
        self.struct = self._make_struct(np.array(targets, np.int_).reshape(-1, 2))

    def _make_struct(self, targets: NDArray[np.int_]) -> Any:
        """Return C's struct ParameterTable, whose arrays this object owns.

        `targets` (N, 2): column of a value, and index in the given values at which it is written. The struct also has
        the given values, and the constraints of parameters: bounds of each, and relations to sums of other parameters
        (terms).
        """
        lower, upper, relations = collect_conditions(self.source)
        ends = np.cumsum([0, *(len(terms) for _, terms, _ in relations)]).tolist()
        rows = [
            (_RELATIONS[is_satisfied], k, *range_)
            for (k, _, is_satisfied), range_ in zip(relations, pairwise(ends), strict=True)
        ]
        terms = np.array([term for _, terms, _ in relations for term in terms], np.int_)
        self._arrays: dict[str, NDArray[Any]] = {
            "targets": targets,
            "given_values": self._given,
            "is_given": self._is_given,
            "lower": lower,
            "upper": upper,
            "relations": np.array(rows, np.int_),
            "terms": terms,
        }
        struct = self.compiled.ffi.new("ParameterTable *")
        set_struct_pointers(self.compiled.ffi, struct, self._arrays)
        struct.n_targets, struct.n_relations = len(targets), len(relations)
        struct.n_given, struct.n_parameters = len(self.source.parameters), len(lower)
        return struct

    @property
    def needs_python(self) -> bool:
        """Return whether `compute_values_of_row` needs Python: choices of names, expressions that may be undefined."""
        return self._has_choices or self._has_possibly_undefined_expressions

    def compute_values_of_row(self, x: Array, k: int) -> bool:
        """Compute row k of `p` and `p_motion` from x (n_names,), and return whether the values are valid.

        Parameters without a column keep the values fixed at the construction. NaN, infinite and subnormal values are
        invalid; the row is then not computed. Other values are valid if `parameters.check_parameter_values` accepts
        them; unresolved clearances are not tested here.
        """
        self.x[...] = x
        is_valid = self.compiled.lib.gudgeon_set_parameters(self.struct, self.x_pointer, *self._row_pointers[k])
        if not self.needs_python:
            return bool(is_valid)
        if self._has_choices:
            magnitudes = np.abs(x)
            if not (((magnitudes >= MIN_NORMAL) & (magnitudes <= MAX_DOUBLE)) | (x == 0.0)).all():
                return False
            for array, given, is_given in zip(
                (self.p_motion, self.p), self._given[::-1], self._is_given[::-1], strict=True
            ):
                array[k] = self.compiled.prepare(given, is_given)
            null = self.compiled.ffi.NULL
            is_valid = self.compiled.lib.gudgeon_set_parameters(self.struct, null, *self._row_pointers[k])
        return is_valid and not (
            self._has_possibly_undefined_expressions
            and describe_undefined_part(self.source, self.p[k], self._is_given[0, : len(self.source.parameters)])
        )


def check_parameter_arguments(names: Any, fixed: Any, argument_name: str) -> tuple[tuple[str, ...], dict[str, Any]]:
    """Return the names of parameters that each run sets, in their order, and the mapping `fixed`, both checked.

    `argument_name` is the argument that gives the names: "parameters" of a prepared run, "inputs" of a stepper. Raises
    BadValueError for arguments of another type, and for a name that is given twice.
    """
    checked = tuple(check_names(names, argument_name, "a list of addresses or parameter names"))
    constants = dict(check_mapping(fixed, "fixed", "{address or parameter name: a float in SI, or '0.5 mm'}"))
    for name in checked:
        if name in constants:
            hint = f"give it once, in {argument_name} or in fixed"
            raise BadValueError(f"{argument_name}: {name!r} is given twice", hint=hint)
    return checked, constants


def read_values_in_order(values: ArrayLike, names: Sequence[str], argument_name: str) -> Array:
    """Return parameter values (…, n_names) as C reads them; those of a table with labels are ordered by `names`.

    Tables are those of pandas, polars and xarray, and lists of their rows. Raises ArrayError for labels other than
    `names`, and for values that are not numbers. The shape is not checked.
    """
    if type(values) is np.ndarray:
        return as_c_array(values, argument_name)
    if isinstance(values, (list, tuple)):
        if not {*map(type, values)} <= UNLABELLED_TYPES and any(_find_labels(row) for row in values):
            values = [read_values_in_order(row, names, argument_name) for row in values]
        return as_c_array(values, argument_name)
    array, labels = as_c_array(values, argument_name), _find_labels(values)
    if not labels or labels == [*names]:
        return array
    if len(labels) == len(names) and {*labels} == {*names}:
        return as_c_array(array[..., [labels.index(name) for name in names]], argument_name)
    dims = getattr(values, "dims", ())
    selection = f".sel({dims[-1]}={[*names]})" if dims else f"[{[*names]}]"
    raise ArrayError(
        f"{argument_name} has the labels {shorten_value(labels)}: expected {', '.join(names)}",
        hint=f"{argument_name}{selection}.to_numpy()"
        if {*names} <= {*labels}
        else f"rename the labels, or drop them if the values are in this order: {argument_name}.to_numpy()",
    )


def _find_labels(values: Any) -> list[Any]:
    """Return the labels of the last axis of a table, row or column; [] without labels, or if all are numbers."""
    n_dimensions, labels = getattr(values, "ndim", None), None
    if dims := getattr(values, "dims", ()):  # of xarray
        labels = values.indexes.get(dims[-1])
    elif n_dimensions is not None:  # of pandas or polars
        labels = getattr(values, "index" if n_dimensions == 1 else "columns", None)
    labels = [] if labels is None or callable(labels) else [*labels]
    return [] if all(isinstance(label, Number) for label in labels) else labels


def _find_indices_of_name(source: KernelSource, name: str) -> list[int]:
    """Return the indices of the parameters that a name sets: one, or those of a group such as `gains`.

    Raises UnknownNameError, and BadValueError for a choice, which has no number.
    """
    for address in (name, f"parameters.{name}"):
        k = source.parameter_indices.get(address)
        if k is not None and source.parameters[k].words:
            hint = f"fixed={{{name!r}: {source.parameters[k].words[0]!r}}}"
            raise BadValueError(f"parameters: {name!r} is a choice of a name: expected a number", hint=hint)
    return list[int](np.flatnonzero(read_given_parameters(source, {name: 1.0})[1]).tolist())

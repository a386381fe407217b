"""Compute the parameter values of single runs from arrays in a fixed order of names, in preallocated arrays.

`parameters.py` reads mappings from names to values and explains errors. Here, names are read once, and each call only
decides whether its values are valid.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_mapping, check_names
from gudgeon.model.arrays import FLAG
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.file_expressions import describe_undefined_part, list_possibly_undefined_expressions
from gudgeon.model.parameters import GAINS, collect_conditions, read_given_parameters
from gudgeon.model.sizes import find_length_indices

MAX_DOUBLE, MIN_NORMAL = sys.float_info.max, sys.float_info.min


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
        gains = [
            source.parameter_indices[name] for name in GAINS if name in source.parameter_indices and not keeps_gains
        ]
        values, is_fixed = read_given_parameters(source, fixed)
        self._given = np.stack([values, values])  # rows: of the run, and of its motion
        self._is_given = np.stack([is_given, is_given]).astype(FLAG)
        self._given[1, gains], self._is_given[1, gains] = 0.0, 1
        n_parameters = len(source.parameters)
        indices_by_column = [_find_indices_of_name(source, name) for name in names]
        # where the value of each column is written, as offsets from the first value given
        self._offsets = [
            [*indices, *(n_parameters + k for k in indices if k not in gains)] for indices in indices_by_column
        ]
        self._has_choices = any(
            parameter.words and mask for parameter, mask in zip(source.parameters, is_given, strict=True)
        )
        self.p = np.tile(compiled.prepare(values, is_fixed), (n_rows, 1))
        self.p_motion = self.p.copy() if gains else self.p
        self._given_pointer, self._pointers = compiled.pointer(self._given, is_written=True), self._make_pointers()
        *self._limits, self._relations = collect_conditions(source)
        self._has_partial_expressions = bool(list_possibly_undefined_expressions(source))
        self.length_indices = find_length_indices(source)

    def _make_pointers(self) -> list[tuple[tuple[Any, Any, Any], ...]]:
        """Return for each row k the arguments of gudgeon_prepare: pointers to given values, mask and row k of `p`.

        If `p_motion`, the parameters of the motion without Baumgarte gains, differs from `p`, those of `p_motion`
        follow.
        """
        pointer, n_sets = self.compiled.pointer, 1 if self.p_motion is self.p else 2
        inputs = [(pointer(self._given[i]), pointer(self._is_given[i], "unsigned char *")) for i in range(n_sets)]
        arrays = (self.p, self.p_motion)[:n_sets]
        return [
            tuple((*pair, pointer(array[k], is_written=True)) for pair, array in zip(inputs, arrays, strict=True))
            for k in range(len(self.p))
        ]

    def compute_values_of_row(self, x: Array, k: int) -> bool:
        """Compute row k of `p` and `p_motion` from x (n_names,), and return whether the values are valid.

        Parameters without a column keep the values fixed at the construction. NaN, infinite and subnormal values are
        invalid; the row is then not computed. Other values are valid if `parameters.check_parameter_values` accepts
        them; unresolved clearances are not tested here.
        """
        given = self._given_pointer
        for value, offsets in zip(x.tolist(), self._offsets, strict=True):
            if not MIN_NORMAL <= abs(value) <= MAX_DOUBLE and value != 0.0:  # NaN, infinite or subnormal
                return False
            for offset in offsets:
                given[offset] = value
        if self._has_choices:
            for array, given, is_given in zip(
                (self.p_motion, self.p), self._given[::-1], self._is_given[::-1], strict=True
            ):
                array[k] = self.compiled.prepare(given, is_given)
        else:
            for arguments in self._pointers[k]:
                self.compiled.lib.gudgeon_prepare(*arguments)
        return self._is_valid(self.p[k])

    def _is_valid(self, p: Array) -> bool:
        """Return whether the values p (n_p,) are finite and satisfy the conditions of the file.

        Clearances that doubles cannot resolve are found by `ReusableRun.update_tolerances`.
        """
        lower, upper = self._limits
        if b"\0" in ((lower <= p) & (p <= upper)).tobytes():  # quicker than all()
            return False
        for k, terms, is_satisfied in self._relations:
            if not is_satisfied(p.item(k), sum(map(p.item, terms))):
                return False
        return not (
            self._has_partial_expressions
            and describe_undefined_part(self.source, p, self._is_given[0, : len(self.source.parameters)])
        )


def check_parameter_names(names: Any, fixed: Any) -> tuple[tuple[str, ...], dict[str, Any]]:
    """Return the checked arguments `parameters` and `fixed`: names in their order, and a mapping.

    Raises BadValueError for a name that is given twice.
    """
    checked = tuple(check_names(names, "parameters", "a list of addresses or parameter names"))
    constants = dict(check_mapping(fixed, "fixed", "{address or parameter name: a float in SI, or '0.5 mm'}"))
    for name in checked:
        if checked.count(name) > 1 or name in constants:
            raise BadValueError(f"parameters: {name!r} is given twice", hint="give it once, in parameters or in fixed")
    return checked, constants


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

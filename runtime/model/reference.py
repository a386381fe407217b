"""Check a compiled library against values of the same functions that NumPy computed when the C was generated.

The values are stored with the emitted C (generator/targets/numpy/reference.py). C and NumPy are printed from the same
statements by different printers. Thus a wrong line of C, a wrong compilation or an outdated library is found before
anything is simulated.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import make_given_parameters
from gudgeon.errors import AuditError

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array, CompiledModel

STORED_DIGITS_TOL = 1e-6  # of the largest value of an array: stored values have seven digits
# fields of an Evaluation that are compared
COMPARED_FIELDS = ("a", "multipliers", "reactions", "torques", "series", "energy", "power")


def check_reference_values(compiled: CompiledModel) -> None:
    """Compare the library's functions with the stored values. AuditError names the function that differs.

    Compared are parameter values, also for two sets of given parameters, and the functions of t, q and v at stored
    states. Nothing is compared if the source has no reference values.
    """
    reference = compiled.source.reference
    if not reference:
        return
    p = _compute_parameter_values(compiled, {})
    _compare_parameter_values(compiled, reference["p"], p)
    for parity, stored_values in enumerate(reference["given"]):
        _compare_parameter_values(
            compiled,
            stored_values,
            _compute_parameter_values(compiled, make_given_parameters(compiled.source.parameters, parity)),
        )
    for state in reference["states"]:
        values = state["values"]
        for name, values_of_function in _evaluate_library(compiled, state, p).items():
            library_values = np.ravel(values_of_function)[
                : len(values[name])
            ]  # guides with play follow, with the sums of their corners
            _compare_values(compiled, name, values[name], library_values, float(state["t"]))


def _compute_parameter_values(compiled: CompiledModel, values_by_index: Mapping[int, float]) -> Array:
    """Return the parameter values p, computed by C's `prepare` from given parameters.

    `values_by_index` maps indices to values (SI).
    """
    values, is_given = (
        np.zeros(len(compiled.source.parameters)),
        np.zeros(len(compiled.source.parameters), dtype=np.uint8),
    )
    for k, value in values_by_index.items():
        values[k], is_given[k] = value, 1
    return compiled.prepare(values, is_given)


def _compare_parameter_values(compiled: CompiledModel, stored_values: Sequence[float | None], p: Array) -> None:
    """Compare parameter values with stored ones, each relative to its own size; unknown ones (None) are skipped.

    Raises AuditError, which names the parameter's index.
    """
    expected = np.array(stored_values, dtype=float)
    is_known = np.isfinite(expected)
    if not (np.abs(p - expected)[is_known] <= STORED_DIGITS_TOL * np.abs(expected[is_known]) + 1e-300).all():
        for k in np.flatnonzero(is_known).tolist():
            _compare_values(compiled, f"parameter {k}", [stored_values[k]], p[k : k + 1], 0.0)


def _evaluate_library(compiled: CompiledModel, state: dict[str, Any], p: Array) -> dict[str, Array]:
    """Return the values of the library's functions at a stored state by name.

    They are the fields COMPARED_FIELDS of an Evaluation, the first two columns of `clearance`, Φ, ν, γ and M.
    state: {"t", "q", "v", "memory"}; p: parameter values.
    """
    t, q, v = float(state["t"]), np.array(state["q"]), np.array(state["v"])
    discrete_states = np.array([np.nan if x is None else x for x in state["memory"]], dtype=float)
    evaluation = compiled.evaluate([t], [q], [v], discrete_states[None, :], p, lambda: None)
    values = {name: getattr(evaluation, name) for name in COMPARED_FIELDS}
    values["clearance"] = evaluation.clearance[:, :, :2]
    values["phi"], values["nu"] = compiled.closed_phi(t, q, p), compiled.closed_nu(t, q, p)
    values["gamma"], values["mass"] = compiled.closed_gamma(t, q, v, p), compiled.mass(p)
    return values


def _compare_values(
    compiled: CompiledModel, name: str, stored_values: Sequence[float | None], values: Array, t: float
) -> None:
    """Raise AuditError if values differ by more than their stored digits; unknown values are not compared.

    The difference is relative to the largest stored value. NaN of C is accepted where masses are missing or forces are
    indeterminate.
    """
    expected = np.array(stored_values, dtype=float)  # None is NaN
    is_known = np.isfinite(expected) & (
        np.isfinite(values) if compiled.source.massless_bodies or compiled.source.indeterminate else True
    )
    scale = np.abs(expected[is_known]).max(initial=0.0)
    differences = np.abs(values[is_known] - expected[is_known])
    if (differences <= STORED_DIGITS_TOL * scale + 1e-300).all():
        return
    k = int(np.flatnonzero(is_known)[np.nan_to_num(differences, nan=np.inf).argmax()])
    mechanism, scene = compiled.source.mechanism, compiled.source.scene
    raise AuditError(
        f"the compiled library of {mechanism}/{scene} is wrong: {name}[{k}] is {values[k]:.7g}, expected"
        f" {expected[k]:.7g}\n  gudgeon.load(…, regenerate=True) or --regenerate compiles it again",
        t,
    )

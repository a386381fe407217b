"""Compare a compiled library with values that the NumPy target computed when the scene was derived.

The values are stored with the emitted C (generator/targets/numpy/reference.py). C and NumPy are printed from the same
statements by different printers. Thus a wrong line of C, a wrong compilation or an outdated library is found before
anything is simulated.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import given_parameters
from gudgeon.errors import AuditError

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array, CompiledModel

SHARE = 1e-6  # of the largest value of an array: stored values have seven digits
# fields of an Evaluation that are compared
EVALUATED = ("a", "multipliers", "reactions", "torques", "series", "energy", "power")


def check_reference(compiled: CompiledModel) -> None:
    """Compare the library's functions with the stored values. AuditError names the function that differs."""
    reference = compiled.source.reference
    if not reference:
        return
    p = _parameters(compiled, {})
    _compare_each(compiled, reference["p"], p)
    for first, stored in enumerate(reference["given"]):
        _compare_each(compiled, stored, _parameters(compiled, given_parameters(compiled.source.slots, first)))
    for state in reference["states"]:
        values = state["values"]
        for name, found in _library_values(compiled, state, p).items():
            own = np.ravel(found)[: len(values[name])]  # guides with play follow, with the sums of their corners
            _compare(compiled, name, values[name], own, float(state["t"]))


def _parameters(compiled: CompiledModel, given: Mapping[int, float]) -> Array:
    """Return the parameter values by C's `prepare` for given parameters, by index."""
    values, is_given = np.zeros(len(compiled.source.slots)), np.zeros(len(compiled.source.slots), dtype=np.uint8)
    for k, value in given.items():
        values[k], is_given[k] = value, 1
    return compiled.prepare(values, is_given)


def _compare_each(compiled: CompiledModel, stored: Sequence[float | None], p: Array) -> None:
    """Compare parameter values, each relative to its own size. Raise AuditError."""
    expected = np.array(stored, dtype=float)
    known = np.isfinite(expected)
    if not (np.abs(p - expected)[known] <= SHARE * np.abs(expected[known]) + 1e-300).all():
        for k in np.flatnonzero(known).tolist():
            _compare(compiled, f"parameter {k}", [stored[k]], p[k : k + 1], 0.0)


def _library_values(compiled: CompiledModel, state: dict[str, Any], p: Array) -> dict[str, Array]:
    """Return the values of the library's functions at a stored state, by name."""
    t, q, v = float(state["t"]), np.array(state["q"]), np.array(state["v"])
    memory = np.array([np.nan if x is None else x for x in state["memory"]], dtype=float)
    row = compiled.evaluate([t], [q], [v], memory[None, :], p, lambda: None)
    found = {name: getattr(row, name) for name in EVALUATED}
    found["clearance"] = row.clearance[:, :, :2]
    found["phi"], found["nu"] = compiled.closed_phi(t, q, p), compiled.closed_nu(t, q, p)
    found["gamma"], found["mass"] = compiled.closed_gamma(t, q, v, p), compiled.mass(p)
    return found


def _compare(compiled: CompiledModel, name: str, stored: Sequence[float | None], found: Array, t: float) -> None:
    """Raise AuditError if values differ by more than their stored digits; unknown values are not compared."""
    expected = np.array(stored, dtype=float)  # None is NaN
    known = np.isfinite(expected) & (
        np.isfinite(found) if compiled.source.massless or compiled.source.indeterminate else True
    )
    scale = np.abs(expected[known]).max(initial=0.0)
    off = np.abs(found[known] - expected[known])
    if (off <= SHARE * scale + 1e-300).all():
        return
    k = int(np.flatnonzero(known)[np.nan_to_num(off, nan=np.inf).argmax()])
    mechanism, scene = compiled.source.mechanism, compiled.source.scene
    raise AuditError(
        f"the compiled library of {mechanism}/{scene} is wrong: {name}[{k}] is {found[k]:.7g}, expected"
        f" {expected[k]:.7g}\n  gudgeon.load(…, regenerate=True) or --regenerate compiles it anew",
        t,
    )

"""Resume a run from the `final` state of another run (restart): check the state, and merge the parameter values.

A state of another mechanism, scene, version of the file or other overrides is refused. The resumed run uses the state's
parameter values unless it is given others; then a note says so. The formulation does not matter: a state has the
coordinates of all bodies.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import AssemblyError, BadValueError
from gudgeon.language.argument_checks import check_mapping, check_number, check_text, raise_bad_value
from gudgeon.language.text_output import format_count
from gudgeon.model.arrays import CODE, FLOAT, as_c_array
from gudgeon.model.cached_values import cache_selected_values
from gudgeon.model.choices import format_parameter, make_choice_notes
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import set_contours
from gudgeon.model.parameters import compute_run_values, read_given_parameters
from gudgeon.results.results import State

MAX_VIOLATION = 1e-6  # rad, or relative to the mechanism's size: largest constraint violation that a run leaves
# code of an open contact, and a hint for messages
FREE, HINT_FINAL = 0, "the `final` of a run has consistent contact codes and discrete states"
STATE_ARRAYS = {"q": FLOAT, "v": FLOAT, "state": CODE, "memory": FLOAT}  # arrays of a State and their types
MAX_REPORTED = 6  # largest number of parameters or constraint equations that a message names


def copy_checked_state(source: KernelSource, start: Any) -> State:
    """Check the argument `start` and return a copy of the state with arrays as C needs them.

    Raises BadValueError if it is not a State of the scene, ArrayError for wrong shapes or values.
    """
    if not isinstance(start, State):
        hint = "the `final` of a run" if not hasattr(start, "final") else "its `final`"
        raise BadValueError(f"start is a {type(start).__name__}: expected a State", hint=f"give {hint}")
    _check_state_origin(source, start)
    n, clearances = len(source.coordinates), len(source.clearances)
    state = as_c_array(start.state, "start.state", (clearances,), dtype=CODE, always_copy=True)
    if state.size and (state.min() < 0 or state.max() > 2):
        raise BadValueError("start.state: expected 0 (free), 1 (impact) or 2 (contact) for each joint with play")
    discrete_states = as_c_array(start.memory, "start.memory", (source.n_discrete_states,), always_copy=True)
    _check_discrete_states(source, state, discrete_states)
    return replace(
        start,
        t=check_number(start.t, "start.t"),
        q=as_c_array(start.q, "start.q", (n,), require_finite=True, always_copy=True),
        v=as_c_array(start.v, "start.v", (n,), require_finite=True, always_copy=True),
        state=state,
        memory=discrete_states,
    )


def copy_checked_states(source: KernelSource, start: Any, n_runs: int) -> list[State]:
    """Return the checked states of a batch, one per run, from one state for all of `n_runs` runs or one each.

    Return [] without a start. Raises BadValueError if their number does not fit, or if their times differ.
    """
    if start is None:
        return []
    single = isinstance(start, State) or not isinstance(start, Iterable) or getattr(start, "ndim", 1) == 0
    if single or hasattr(start, "final"):
        return [copy_checked_state(source, start)] * n_runs
    given_states: list[State] = []
    for given_state in start:  # it may be long: an error ends the loop at the first wrong entry
        given_states.append(given_state if isinstance(given_state, State) else copy_checked_state(source, given_state))
    states = _copy_similar_states(source, given_states) or [copy_checked_state(source, x) for x in given_states]
    if n_runs not in (1, len(states)) or not states:
        message = f"start has {format_count(len(states), 'state')} for {format_count(n_runs, 'run')}"
        raise BadValueError(message, hint="one state, or one for every run")
    times = sorted({state.t for state in states})
    if len(times) > 1:
        message = f"start: states at {times[0]:.9g} s and {times[-1]:.9g} s: the runs of a batch start at one time"
        raise BadValueError(message, hint="states at the same time, or a batch for each time")
    return states


def _copy_similar_states(source: KernelSource, given_states: list[Any]) -> list[State]:
    """Return checked copies of two or more states that differ in their arrays only, checked together to save time.

    Return [] for other states, and if an array has another type or shape or is not finite: the caller then checks
    state by state. Raises the errors of `copy_checked_state` for the first state, and BadValueError for contradicting
    discrete states.
    """
    if len(given_states) < 2 or any(type(given_state) is not State for given_state in given_states):
        return []
    shared = [(name, value) for name, value in vars(given_states[0]).items() if name not in STATE_ARRAYS]
    for name, value in shared:
        values = [vars(x)[name] for x in given_states]
        is_equal = all(x is value for x in values) or (
            {type(x) for x in values} in ({str}, {float}, {tuple}) and values.count(value) == len(values)
        )
        if not is_equal:
            return []
    stacked = []
    for name, dtype in STATE_ARRAYS.items():
        arrays = [vars(x)[name] for x in given_states]
        if {type(array) for array in arrays} != {np.ndarray} or {(a.dtype, a.shape) for a in arrays} != {
            (dtype, arrays[0].shape)
        }:
            return []
        stacked.append(np.array(arrays))
    q, v, codes, discrete_states = stacked
    checked = vars(copy_checked_state(source, given_states[0]))
    if not (np.isfinite(q).all() and np.isfinite(v).all() and ((codes >= 0) & (codes <= 2)).all()):
        return []
    if codes.any() or not np.isnan(discrete_states).all():
        for code, memory in zip(codes, discrete_states, strict=True):
            _check_discrete_states(source, code, memory)
    copies = []
    for rows in zip(*stacked, strict=True):
        copies.append(State.__new__(State))
        vars(copies[-1]).update(checked, **dict(zip(STATE_ARRAYS, rows, strict=True)))
    return copies


def _check_discrete_states(source: KernelSource, contact_codes: Array, discrete_states: Array) -> None:
    """Raise BadValueError if contact codes and discrete states of a state contradict each other.

    `contact_codes` and `discrete_states` are the arrays `state` and `memory` of a State. Closed contacts need a finite
    approach speed, open ones NaN. Internal states must be finite, or NaN while their joint is free. Friction modes must
    not be infinite; nothing else of them is checked.
    """
    for k, (joint, code, rate) in enumerate(
        zip(source.clearances, contact_codes.tolist(), discrete_states.tolist(), strict=False)
    ):
        if code == FREE and not math.isnan(rate):
            message, expected = f"is {rate:g} m/s while start.state[{k}] is 0 (free)", "NaN, or state 1 or 2"
        elif code != FREE and not math.isfinite(rate):
            message, expected = f"is {rate:g} while start.state[{k}] is {code}", "the approach speed (m/s) of its onset"
        else:
            continue
        raise BadValueError(f"start.memory[{k}] of joint {joint.name} {message}: expected {expected}", hint=HINT_FINAL)
    first = len(discrete_states) - len(source.internal_states)
    for k, (name, z) in enumerate(zip(source.internal_states, discrete_states[first:].tolist(), strict=True), first):
        joint_of = (k - first) * len(contact_codes) // max(len(source.internal_states), 1)
        if name and not math.isfinite(z) and not (math.isnan(z) and contact_codes[joint_of] == FREE):
            message = f"start.memory[{k}], the internal state {name}, is {z:g}: expected a length (m), NaN while free"
            raise BadValueError(message, hint=HINT_FINAL)
    if np.isinf(discrete_states).any():
        k = int(np.isinf(discrete_states).argmax())
        message = f"start.memory[{k}] is {discrete_states[k]:g}: expected the mode of a friction, or NaN"
        raise BadValueError(message, hint=HINT_FINAL)


def _check_state_origin(source: KernelSource, start: State) -> None:
    """Raise BadValueError if a state belongs to another mechanism, scene, file or overrides, or its fields have wrong
    types.

    Fields that are empty, as in a state made by hand, are not compared.
    """
    for name in ("mechanism", "scene", "sha256", "formulation"):
        check_text(getattr(start, name), f"start.{name}")
    overrides = start.overrides
    if not isinstance(overrides, tuple) or not all(isinstance(x, tuple) and len(x) == 2 for x in overrides):
        raise_bad_value("start.overrides", overrides, "a tuple of pairs (address, value)")
    if start.mechanism not in ("", source.mechanism) or start.scene not in ("", source.scene):
        raise BadValueError(
            f"start: this state belongs to another mechanism or scene, {start.mechanism} / {start.scene};"
            f" this is {source.mechanism} / {source.scene}"
        )
    if start.sha256 not in ("", source.whole_sha256):
        changed = _list_changed_laws_and_tables(source, start)
        if changed:
            message = f"start: this state was computed with another {' and another '.join(changed)}"
            hint = "resume with the laws and tables of the state, or run this simulation from its own start"
            raise BadValueError(message, hint=hint)
        raise BadValueError(
            f"start: this state belongs to another mechanism: the file of {source.mechanism} has changed"
            f" (SHA-256 {start.sha256[:12]}…, now {source.whole_sha256[:12]}…)",
            hint="resume with the file of the state, or run this simulation from its own start",
        )
    if start.sha256 and tuple(start.overrides) != source.overrides:
        raise BadValueError(
            f"start: this state was computed with overrides {dict(start.overrides)},"
            f" this simulation has {dict(source.overrides)}",
            hint="load the mechanism with the state's overrides",
        )


def _list_changed_laws_and_tables(source: KernelSource, start: State) -> list[str]:
    """Return the laws and tables that differ from those of the state, as "law x" or "table y".

    Return [] if the mechanism file itself differs.
    """
    keys_of_state, present_keys = dict(start.beside), dict(source.external_files)
    if replace(source, tables=start.beside, laws=()).whole_sha256 != start.sha256:
        return []
    kinds = {name: "law" for name, _ in source.laws} | {name: "table" for name, _ in source.tables}
    return [f"{kinds[name]} {name}" for name in kinds if keys_of_state.get(name) != present_keys[name]]


class FileParameters(NamedTuple):
    """Hold the parameters of a run that begins at the file's start; callers must not change the arrays."""

    given: Array  # (n_parameters,) values of the parameters that are given
    is_given: Array  # (n_parameters,) mask
    p: Array  # (2, n_p) values of the run, and those without Baumgarte gains
    notes: tuple[str, ...]


def _build_parameters_key(compiled: CompiledModel, parameters: Any) -> tuple[Any, ...]:
    """Return the cache key of given parameters: names and bytes of the values of a dictionary of floats, () for None.

    Other arguments get a key without a hash, so that their values are not cached.
    """
    if parameters is None:
        return ()
    if type(parameters) is dict and {float}.issuperset(map(type, parameters.values())):
        return tuple(parameters), array("d", parameters.values()).tobytes()
    return ([],)


@cache_selected_values(_build_parameters_key)
def read_file_parameters(compiled: CompiledModel, parameters: Mapping[str, Any] | None) -> FileParameters:
    """Return the parameters of a run from the file's start, cached for equal floats. Raises InputError."""
    given, is_given, notes = merge_parameters(compiled, None, parameters)
    return FileParameters(given, is_given, compute_run_values(compiled, given, is_given), notes)


def merge_parameters(
    compiled: CompiledModel,
    start: State | None,
    parameters: Mapping[str, Any] | None,
    contour: Mapping[str, Array] = MappingProxyType({}),
) -> tuple[Array, Array, tuple[str, ...]]:
    """Return values and mask (n_parameters,) of the parameters given by state, arguments and contours, and notes.

    Parameters of the state hold unless `parameters` or `contour` set them again; a note then lists those that changed.
    Notes on choices are returned too.
    """
    given, is_given = read_given_parameters(compiled.source, parameters)
    set_contours(compiled.source, contour, given, is_given)
    if start is None:
        notes = make_choice_notes(compiled.source, given, is_given) if compiled.has_choices else ()
        return given, is_given, notes
    if not check_mapping(start.parameters, "start.parameters"):
        values_of_state, is_given_by_state = np.zeros_like(given), np.zeros_like(is_given)
    else:
        values_of_state, is_given_by_state = read_given_parameters(
            compiled.source, start.parameters, "start.parameters"
        )
    values, mask = np.where(is_given, given, values_of_state), np.logical_or(is_given, is_given_by_state)
    selected = make_choice_notes(compiled.source, values, mask)
    if not is_given.any():
        return values, mask, selected
    p_before, p = compiled.prepare(values_of_state, is_given_by_state), compiled.prepare(values, mask)
    changed = [k for k in np.flatnonzero(is_given).tolist() if p_before[k] != p[k]]
    if not changed:
        return values, mask, selected
    changes = [
        f"{parameter.address} {_format_value(p[k], parameter)} (before {_format_value(p_before[k], parameter)})"
        for k, parameter in ((k, compiled.source.parameters[k]) for k in changed[:MAX_REPORTED])
    ]
    omission_text = f" and {len(changed) - MAX_REPORTED} more" if len(changed) > MAX_REPORTED else ""
    return (
        values,
        mask,
        (
            *selected,
            f"resumed at t = {start.t:.9g} s with other parameter values: {', '.join(changes)}{omission_text}",
        ),
    )


def check_resumed_state(compiled: CompiledModel, start: State, p: Array) -> None:
    """Raise AssemblyError if the state to resume from violates the constraint equations with parameter values p."""
    if message := _format_violated_equations(compiled, p, compiled.phi(start.t, start.q, p)):
        raise AssemblyError(
            f"start: the state at t = {start.t:.9g} s violates constraint equations with these parameter values:"
            f" {message}\n"
            "  other lengths have another assembly, and a drive that depends on t and a changed parameter has another"
            " value at that time: write it so that it continues from the state, or run from the scene's own start"
        )


def build_violation_notes(compiled: CompiledModel, p: Array, t: float, q: Array, v: Array) -> tuple[str, ...]:
    """Return a note if the state q, v (n,) at t (s) to resume from violates the constraints; else ().

    Positions must satisfy Φ(t, q) = 0, velocities Φ_q q̇ = ν, up to MAX_VIOLATION of size and terms. Final states of
    runs do; states made by hand may not.
    """
    source = compiled.source
    with np.errstate(all="ignore"):  # the run itself reports values that are not finite
        message = _format_violated_equations(compiled, p, compiled.phi(t, q, p))
        if not message:
            phi_q, nu = compiled.phi_q(t, q, p), compiled.nu(t, q, p)
            message = _format_violated_equations(
                compiled, p, phi_q @ v - nu, np.abs(phi_q) @ np.abs(v) + np.abs(nu), "/s"
            )
    if not message:
        return ()
    used = "the run begins with its integrated coordinates, and solves the constraint equations for the others"
    if source.formulation == "full":
        used = "the run begins with this state unchanged"
    if not source.degrees_of_freedom:
        used = "the run begins at the position of its drives"
    return (f"the state at t = {t:.9g} s violates constraint equations {message}: {used}",)


def _format_violated_equations(
    compiled: CompiledModel, p: Array, residuals: Array, terms: Array | float = 0.0, unit_suffix: str = ""
) -> str:
    """Return the constraint equations violated by more than MAX_VIOLATION, as "rod.length (0.1 m)"; "" if none.

    The limit is relative to the mechanism's size for lengths, plus `terms` (m,), the sizes of the terms. At most
    MAX_REPORTED are named. `unit_suffix`: "/s" for velocities.
    """
    rows, size = compiled.source.equations, compute_mechanism_size(compiled, p)
    allowed = MAX_VIOLATION * (np.array([size if row.unit == "m" else 1.0 for row in rows]) + terms)
    violated = [
        f"{row.name} ({x:.3g} {row.unit}{unit_suffix})"
        for row, x, limit in zip(rows, residuals, allowed, strict=True)
        if not abs(x) <= limit
    ]
    omission_text = f" and {len(violated) - MAX_REPORTED} more" if len(violated) > MAX_REPORTED else ""
    return f"{', '.join(violated[:MAX_REPORTED])}{omission_text}" if violated else ""


def _format_value(value: float, parameter: RuntimeParameter) -> str:
    """Return a parameter value as text with its unit, or the word that it represents for a choice."""
    return (
        str(format_parameter(parameter, float(value))) if parameter.words else f"{value:.6g} {parameter.unit}".strip()
    )

"""Going on from the `final` of another run: whose state it is, and with which numbers.

A state of another mechanism, another scene, another version of the file or other overrides is refused, whatever its
size; so is one whose arrays have another length. Its run-time numbers are those of the further run unless that is
given others, and then the run says so. The formulation does not matter: a state has the coordinates of all bodies.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from gudgeon.assembly.linkage import mechanism_size
from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import AssemblyError, BadValueError
from gudgeon.language.shown import counted
from gudgeon.language.wanted import mapping, number_of, refuse, text
from gudgeon.model.arrays import CODE, taken
from gudgeon.model.choices import said, told_choices
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import put
from gudgeon.model.parameters import given_slots
from gudgeon.results.results import State

OPEN = 1e-6  # rad, or share of the mechanism's size: a row that is open further was not left so by a run
FREE, AS_IT_WAS = 0, "the `final` of a run has both as they belong together"
MOST_TOLD = 6  # numbers that a note names


def own(source: KernelSource, start: Any) -> State:
    """The state with its arrays as C reads them, copied. Raises BadValueError for one that is not this scene's."""
    if not isinstance(start, State):
        hint = "the `final` of a run" if not hasattr(start, "final") else "its `final`"
        raise BadValueError(f"start is a {type(start).__name__}: expected a State", hint=f"give {hint}")
    _check_origin(source, start)
    n, clearances = len(source.coordinates), len(source.clearances)
    state = taken(start.state, "start.state", (clearances,), dtype=CODE, own=True)
    if state.size and (state.min() < 0 or state.max() > 2):
        raise BadValueError("start.state: expected 0 (free), 1 (impact) or 2 (contact) for each joint with play")
    memory = taken(start.memory, "start.memory", (source.n_memory,), own=True)
    _check_memory(source, state, memory)
    return replace(
        start,
        t=number_of(start.t, "start.t"),
        q=taken(start.q, "start.q", (n,), finite=True, own=True),
        v=taken(start.v, "start.v", (n,), finite=True, own=True),
        state=state,
        memory=memory,
    )


def own_each(source: KernelSource, start: Any, rows: int) -> list[State]:
    """States of a batch: one for all of `rows` runs or one a run, at one time; empty where none is given."""
    if start is None:
        return []
    single = isinstance(start, State) or not isinstance(start, Iterable) or getattr(start, "ndim", 1) == 0
    if single or hasattr(start, "final"):
        return [own(source, start)] * rows
    states = [own(source, one) for one in start]
    if len(states) != rows and 1 not in (rows, len(states)) or not states:
        told = f"start has {counted(len(states), 'state')} for {counted(rows, 'run')}"
        raise BadValueError(told, hint="one state, or one for every run")
    times = sorted({state.t for state in states})
    if len(times) > 1:
        told = f"start: states at {times[0]:.9g} s and {times[-1]:.9g} s: the runs of a batch have their times together"
        raise BadValueError(told, hint="states at the same time, or a batch for each time")
    return states * rows if len(states) == 1 else states


def _check_memory(source: KernelSource, state: Array, memory: Array) -> None:
    """BadValueError for a contact that is both open and closed: what remembers a rate is closed, what has none open."""
    for k, (joint, code, rate) in enumerate(zip(source.clearances, state.tolist(), memory.tolist(), strict=False)):
        if code == FREE and not math.isnan(rate):
            told, expected = f"remembers {rate:g} m/s while start.state[{k}] is 0 (free)", "NaN, or state 1 or 2"
        elif code != FREE and not math.isfinite(rate):
            told, expected = f"is {rate:g} while start.state[{k}] is {code}", "the rate (m/s) with which it closed"
        else:
            continue
        raise BadValueError(f"start.memory[{k}] of joint {joint.name} {told}: expected {expected}", hint=AS_IT_WAS)
    first = len(memory) - len(source.states)
    for k, (name, z) in enumerate(zip(source.states, memory[first:].tolist(), strict=True), first):
        joint_of = (k - first) * len(state) // max(len(source.states), 1)
        if name and not math.isfinite(z) and not (math.isnan(z) and state[joint_of] == FREE):
            told = f"start.memory[{k}], the inner state {name}, is {z:g}: expected a length (m), or NaN while free"
            raise BadValueError(told, hint=AS_IT_WAS)
    if np.isinf(memory).any():
        k = int(np.isinf(memory).argmax())
        told = f"start.memory[{k}] is {memory[k]:g}: expected the mode of a friction, or NaN"
        raise BadValueError(told, hint=AS_IT_WAS)


def _check_origin(source: KernelSource, start: State) -> None:
    """What is empty in a state made by hand is not compared."""
    for name in ("mechanism", "scene", "sha256", "formulation"):
        text(getattr(start, name), f"start.{name}")
    overrides = start.overrides
    if not isinstance(overrides, tuple) or not all(isinstance(x, tuple) and len(x) == 2 for x in overrides):
        refuse("start.overrides", overrides, "a tuple of pairs (address, value)")
    if start.mechanism not in ("", source.mechanism) or start.scene not in ("", source.scene):
        raise BadValueError(
            f"start: this state belongs to another mechanism or scene, {start.mechanism} / {start.scene};"
            f" this is {source.mechanism} / {source.scene}"
        )
    if start.sha256 not in ("", source.whole_sha256):
        changed = _changed(source, start)
        if changed:
            told = f"start: this state was computed with another {' and another '.join(changed)}"
            hint = "go on with what it was computed with, or run this one from its start"
            raise BadValueError(told, hint=hint)
        raise BadValueError(
            f"start: this state belongs to another mechanism: the file of {source.mechanism} was another one"
            f" (SHA-256 {start.sha256[:12]}…, now {source.whole_sha256[:12]}…)",
            hint="go on with the file that it was computed with, or run this one from its start",
        )
    if start.sha256 and tuple(start.overrides) != source.overrides:
        raise BadValueError(
            f"start: this state was computed with overrides {dict(start.overrides)},"
            f" this simulation has {dict(source.overrides)}",
            hint="load the mechanism with the state's overrides",
        )


def _changed(source: KernelSource, start: State) -> list[str]:
    """Laws and tables that say something else now, where the file itself is the same."""
    then, now = dict(start.beside), dict(source.beside)
    if replace(source, tables=start.beside, laws=()).whole_sha256 != start.sha256:
        return []
    kinds = {name: "law" for name, _ in source.laws} | {name: "table" for name, _ in source.tables}
    return [f"{kinds[name]} {name}" for name in kinds if then.get(name) != now[name]]


def numbers(
    compiled: CompiledModel,
    start: State | None,
    parameters: Mapping[str, Any] | None,
    contour: Mapping[str, Array] = MappingProxyType({}),
) -> tuple[Array, Array, tuple[str, ...]]:
    """Values and mask of the slots, (n_slots,) each: the state's, and over them those given; what to say of it."""
    given, is_given = given_slots(compiled.source, parameters)
    put(compiled.source, contour, given, is_given)
    if start is None:
        return given, is_given, told_choices(compiled.source, given, is_given)
    if not mapping(start.parameters, "start.parameters"):
        before, was_given = np.zeros_like(given), np.zeros_like(is_given)
    else:
        before, was_given = given_slots(compiled.source, start.parameters, "start.parameters")
    both, mask = np.where(is_given, given, before), np.logical_or(is_given, was_given)
    chosen = told_choices(compiled.source, both, mask)
    if not is_given.any():
        return both, mask, chosen
    had, has = compiled.prepare(before, was_given), compiled.prepare(both, mask)
    changed = [k for k in np.flatnonzero(is_given).tolist() if had[k] != has[k]]
    if not changed:
        return both, mask, chosen
    slots = compiled.source.slots
    told = [
        f"{slots[k].address} {_quantity(has[k], slots[k])} (before {_quantity(had[k], slots[k])})"
        for k in changed[:MOST_TOLD]
    ]
    more = f" and {len(changed) - MOST_TOLD} more" if len(changed) > MOST_TOLD else ""
    return (
        both,
        mask,
        (
            *chosen,
            f"goes on from t = {start.t:.9g} s with other numbers: {', '.join(told)}{more}",
        ),
    )


def check_fits(compiled: CompiledModel, start: State, p: Array) -> None:
    """AssemblyError where the numbers p of a further run leave rows open at the state that it goes on from."""
    if told := _open(compiled, p, compiled.phi(start.t, start.q, p)):
        raise AssemblyError(
            f"start: the state at t = {start.t:.9g} s does not fit the numbers given: rows {told} are open by so much\n"
            "  other lengths close elsewhere, and a drive whose value hangs on t and a changed number stands elsewhere"
            " at that time: write it so that it goes on from there, or run from the scene's own start"
        )


def off_constraints(compiled: CompiledModel, p: Array, t: float, q: Array, v: Array) -> tuple[str, ...]:
    """A remark on a state to go on from, q, v (n,) at t (s), that is off the constraints: one that was made by hand.

    Positions Φ(t, q) = 0 and velocities Φ_q q̇ = ν; of these what rounds away beside their terms is no matter.
    """
    source = compiled.source
    with np.errstate(all="ignore"):  # the run itself tells what is not finite
        told = _open(compiled, p, compiled.phi(t, q, p))
        if not told:
            phi_q, nu = compiled.phi_q(t, q, p), compiled.nu(t, q, p)
            told = _open(compiled, p, phi_q @ v - nu, np.abs(phi_q) @ np.abs(v) + np.abs(nu), "/s")
    if not told:
        return ()
    taken = "the run takes the coordinates that it integrates, and closes the others anew"
    if source.formulation == "full":
        taken = "the run begins with it as it stands"
    if not source.degrees_of_freedom:
        taken = "the run begins where its drives put it"
    return (f"the state at t = {t:.9g} s is off the constraints, rows {told}: {taken}",)


def _open(compiled: CompiledModel, p: Array, by: Array, terms: Array | float = 0.0, rate: str = "") -> str:
    """Rows that are open `by` more than a run leaves them, beside `terms` (m,) of theirs: "rod.length (0.1 m)"."""
    rows, size = compiled.source.rows, mechanism_size(compiled, p)
    allowed = OPEN * (np.array([size if row.unit == "m" else 1.0 for row in rows]) + terms)
    told = [
        f"{row.name} ({x:.3g} {row.unit}{rate})"
        for row, x, most in zip(rows, by, allowed, strict=True)
        if not abs(x) <= most
    ]
    more = f" and {len(told) - MOST_TOLD} more" if len(told) > MOST_TOLD else ""
    return f"{', '.join(told[:MOST_TOLD])}{more}" if told else ""


def _quantity(value: float, slot: Slot) -> str:
    return str(said(slot, float(value))) if slot.words else f"{value:.6g} {slot.unit}".strip()

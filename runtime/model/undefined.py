"""Numbers that are undefined as the file writes them, where simplified formulas have a value.

C has d for cos(acos(d)). With the file's own numbers that was looked at when it was read; here with those of a run.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.defined import is_defined_everywhere, may_be_undefined, undefined_part
from gudgeon.language.tree import Expr, from_json, names
from gudgeon.model.compiled import Array

REMEDY = "expected finite numbers: is there a division by zero, or a root of a negative number?"


@dataclass(frozen=True)
class Partial:
    """An expression that may be undefined: its own slot, -1 of one that has none, and those of the names in it."""

    address: str
    tree: Expr
    slot: int
    slots: Mapping[str, int]


def undefined_rows(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> NDArray[np.bool_]:
    """Which runs, (n,) of p (n, n_slots + n_derived), may have an undefined number; undefined_number is exact."""
    found = np.zeros(len(p), dtype=np.bool_)
    for one in _concerned(source, p):
        known = {name: p[:, k] for name, k in one.slots.items()}
        undefined = may_be_undefined(one.tree, known)
        found |= undefined & ~is_given[:, one.slot].astype(bool) if one.slot >= 0 else undefined
    return found


def undefined_number(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> str:
    """What is said of the first undefined number of one run; "" where there is none."""
    for one in _concerned(source, p[np.newaxis]):
        known = {name: float(p[k]) for name, k in one.slots.items()}
        if one.slot >= 0 and is_given[one.slot]:
            continue
        if (value := undefined_part(one.tree, known)) is not None:
            by = ", ".join(f"{name} = {number:.6g}" for name, number in known.items())
            return f"{one.address} has a part that is {value} with {by}\n  {REMEDY}"
    return ""


def _concerned(source: KernelSource, p: Array) -> list[Partial]:
    """The expressions that name a slot which differs in some run from the file's."""
    kept = vars(source)
    if "partial_slots" not in kept:
        kept["partial_slots"] = sorted({k for one in partials(source) for k in one.slots.values()})
        kept["partial_defaults"] = np.array([source.slots[k].default for k in kept["partial_slots"]])
    slots = kept["partial_slots"]
    if not slots:
        return []
    differ = (p[:, slots] != kept["partial_defaults"]).any(axis=0)
    if not differ.any():
        return []
    changed = {slots[k] for k in np.flatnonzero(differ).tolist()}
    return [one for one in partials(source) if not changed.isdisjoint(one.slots.values())]


def partials(source: KernelSource) -> list[Partial]:
    """Return the expressions of parameters, drives and forces that may be undefined; read once for each source."""
    kept = vars(source)
    if "partials" not in kept:
        kept["partials"] = _read_partials(source)
    found: list[Partial] = kept["partials"]
    return found


def _read_partials(source: KernelSource) -> list[Partial]:
    place, found = source.place, []
    trees = [(slot.address, slot.tree, k) for k, slot in enumerate(source.slots) if slot.tree]
    for address, tree, k in [*trees, *((one.address, one.tree, -1) for one in source.written)]:
        expr = from_json(json.loads(tree))
        used = dict.fromkeys(name.path for name in names(expr))
        slots = {name: place.get(f"parameters.{name}", place.get(name, -1)) for name in used}
        if not is_defined_everywhere(expr):
            found.append(Partial(address, expr, k, {name: at for name, at in slots.items() if at >= 0}))
    return found

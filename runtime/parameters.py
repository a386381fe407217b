"""Run-time numbers: addresses to slots, units, and the conditions that every value must satisfy."""

from __future__ import annotations

import difflib
import math
import operator
import re
from collections.abc import Mapping

import numpy as np

from gudgeon.compiled import Array, CompiledModel
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.kernel_source import KernelSource, Slot

# a number and a unit without the space that the file format wants between them: nothing else can be meant
_GLUED = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-zµμ°].*)")
RELATIONS = {">": operator.gt, ">=": operator.ge, "<": operator.lt, "<=": operator.le}


def given_slots(source: KernelSource, parameters: Mapping[str, float | str]) -> tuple[Array, Array]:
    """Values and mask, (n_slots,) each, from {address or parameter name: float or '0.5 mm'}."""
    place = {slot.address: k for k, slot in enumerate(source.slots)}
    values, mask = np.zeros(len(place)), np.zeros(len(place), dtype=bool)
    for name, value in parameters.items():
        address = name if name in place else f"parameters.{name}"
        if address not in place:
            raise _unknown(name, list(place))
        k = place[address]
        values[k], mask[k] = number(value, source.slots[k]), True
    return values, mask


def number(value: float | str, slot: Slot) -> float:
    """A float, or a text with a unit as in the YAML file; SI."""
    if isinstance(value, str):
        from gudgeon.generator.quantity_text import number_of_text  # no SymPy in it

        value = number_of_text(spaced(value), slot.address, slot.dimension)
    result = float(value)
    if not math.isfinite(result):
        raise BadValueError(f"{slot.address}: {value!r} is not a finite number")
    return result


def spaced(text: str) -> str:
    """A space before the unit of a number: "0.5mm" is "0.5 mm"."""
    glued = _GLUED.fullmatch(text.strip())
    return f"{glued[1]} {glued[2]}" if glued else text.strip()


def prepare(compiled: CompiledModel, parameters: Mapping[str, float | str]) -> tuple[Array, Array, Array]:
    """(p, given, is_given), checked: see CompiledModel.prepare. Raises BadValueError, UnknownNameError."""
    given, is_given = given_slots(compiled.source, parameters)
    p = compiled.prepare(given, is_given)
    check(compiled.source, p)
    return p, given, is_given


def without_baumgarte(compiled: CompiledModel, given: Array, is_given: Array) -> Array:
    """p with both gains zero: for methods that project onto the constraints instead."""
    place = {slot.address: k for k, slot in enumerate(compiled.source.slots)}
    gains = [place[name] for name in ("baumgarte.alpha", "baumgarte.beta") if name in place]
    values, mask = given.copy(), is_given.copy()
    values[gains], mask[gains] = 0.0, True
    return compiled.prepare(values, mask)


def check(source: KernelSource, p: Array) -> None:
    """Every condition of the file again, on the values of this run."""
    value = {slot.address: float(p[k]) for k, slot in enumerate(source.slots)}
    for slot in source.slots:
        if not math.isfinite(value[slot.address]):
            raise BadValueError(f"{slot.address} is {value[slot.address]}: not finite with these parameters")
    for condition in source.conditions:
        bound = value[condition.bound] if isinstance(condition.bound, str) else condition.bound
        if not RELATIONS[condition.relation](value[condition.address], bound):
            raise BadValueError(
                f"{condition.address} is {value[condition.address]:.6g}: {condition.message}"
                + (f" ({condition.bound} is {bound:.6g})" if isinstance(condition.bound, str) else "")
                + f"; expected {_range(source, condition.address)}"
            )
    for name, number in zip(source.derived, p[len(source.slots) :].tolist(), strict=True):
        if not math.isfinite(number):
            raise BadValueError(f"{name}, which follows from the parameters, is {number}: not finite with these values")


def _range(source: KernelSource, address: str) -> str:
    """All that the file's conditions ask of a number: "> 0 and <= 1"."""
    asked = [condition for condition in source.conditions if condition.address == address]
    told = (c.bound if isinstance(c.bound, str) else f"{c.bound:g}" for c in asked)
    return " and ".join(f"{c.relation} {bound}" for c, bound in zip(asked, told, strict=True))


def _unknown(name: str, addresses: list[str]) -> UnknownNameError:
    short = [a.removeprefix("parameters.") for a in addresses]
    near = difflib.get_close_matches(name, addresses + short, n=3)
    hint = f"did you mean {', '.join(dict.fromkeys(near))}?" if near else "see run.parameters for all addresses."
    return UnknownNameError(
        f"no run-time number has the address {name!r} in this scene", None,
        f"{hint} Structural choices go to gudgeon.load(..., overrides={{...}}).",
    )  # fmt: skip

"""Own the axes of a map or box of `gudgeon map`: a step, a tolerance, a run-time parameter, or several together."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import listed, numbers, text
from gudgeon.model.choices import index_of_word, specified
from gudgeon.model.compiled import Array
from gudgeon.model.parameters import GAINS, given_slots, number, prepare
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.runs import Parameters

SETTINGS = {"step": "s", "rtol": ""}  # axes of the method, not of the mechanism
COUNT, MOST = 5, 1000  # values of a range: by default, at most
_COUNT = re.compile(r"[0-9]{1,6}")
# Axes that move every such number of the scene, each by its ratio to the first.
GROUPS: dict[str, Callable[[str], bool]] = {
    "stiffness": lambda address: address.startswith("materials.") and address.endswith(".E"),
    "viscosity": lambda address: address.startswith("contacts.") and address.endswith(".viscosity"),
    "gains": lambda address: address in GAINS,
}


@dataclass(frozen=True)
class Axis:
    """An axis with its values (SI, ascending) and the addresses that it sets, each to the value times its ratio.

    `words`: the names of a choice, such as a material; the values are indices into it.
    """

    name: str
    values: tuple[float, ...]
    unit: str
    ratios: tuple[tuple[str, float], ...] = ()
    words: tuple[str, ...] = ()

    @property
    def of_method(self) -> bool:
        """Whether the axis is the step or the tolerance."""
        return self.name in SETTINGS

    def parameters(self, value: float) -> dict[str, float | str]:
        """Return the parameters of `simulate` for a value; empty for an axis of the method or a scene without play."""
        if self.words:
            return {address: self.words[int(value)] for address, _ in self.ratios}
        return {address: value * ratio for address, ratio in self.ratios}


def axis(
    simulation: Simulation, name: str, values: Sequence[float | str], parameters: Parameters | None = None
) -> Axis:
    """Return an axis by name: step, rtol, clearance, stiffness, viscosity, gains, or the address of a run-time
    parameter or choice.

    values: numbers (SI), or names for a choice. Raises UnknownNameError for an unknown name, BadValueError for a name
    without a parameter in the scene.
    """
    if (slot := _find_choice(simulation.source, text(name, "axis"))) is not None:
        names = listed(values, f"axis {name}", str, f"a list of names, of {', '.join(slot.words)}")
        places = sorted({index_of_word(one, slot) for one in names})
        return Axis(name, tuple(places), "", ((name, 1.0),), slot.words)
    values = numbers(values, f"axis {name}")
    if name in SETTINGS:
        return Axis(name, tuple(sorted(values)), SETTINGS[name])
    source, p = simulation.source, prepare(simulation.compiled, parameters)[0]
    slots = _drop_unused_materials(source, p, _axis_parameters(source, name))
    first = float(p[slots[0]])
    if len(slots) > 1 and first == 0.0:
        raise BadValueError(f"axis {name}: {source.slots[slots[0]].address} is zero, there is no ratio to it")
    ratios = tuple((source.slots[k].address, float(p[k]) / first if len(slots) > 1 else 1.0) for k in slots)
    return Axis(name, tuple(sorted(values)), source.slots[slots[0]].unit, ratios)


def typed(simulation: Simulation, written: str, parameters: Parameters | None = None) -> Axis:
    """Return the axis of a command-line text: "c=.05mm..1mm:5" (logarithmic), "omega=3,6,9", "rtol=1e-4..1e-10:4"."""
    name, _, message = text(written, "axis").partition("=")
    if not message:
        raise BadValueError(f"axis {written!r}: expected name=low..high:count or name=a,b,c")
    if (choice := _find_choice(simulation.source, name.strip())) is not None:
        if ".." in message or ":" in message:
            names = ",".join(choice.words)
            raise BadValueError(f"axis {written!r}: its values are names, there is none between: {name}={names}")
        return axis(simulation, name.strip(), message.split(","), parameters)
    ends, colon, count = message.partition(":")
    slot = _first_parameter(simulation.source, name.strip())
    values = [number(_parse_value(part), slot) for part in (ends.split("..") if ".." in ends else ends.split(","))]
    if ".." in ends:
        if len(values) != 2 or not 0 < values[0] < values[1]:
            raise BadValueError(f"axis {written!r}: expected 0 < low < high")
        expected = COUNT if not colon else int(count) if _COUNT.fullmatch(count) else 0
        if not 2 <= expected <= MOST:
            raise BadValueError(f"axis {written!r}: expected a whole number of values after ':', from 2 to {MOST}")
        values = np.geomspace(values[0], values[1], expected).tolist()
    elif colon:
        raise BadValueError(f"axis {written!r}: only a range low..high takes a number of values after ':'")
    return axis(simulation, name.strip(), [float(f"{x:.6g}") for x in values], parameters)


def clearances(simulation: Simulation, values: Sequence[float], parameters: Parameters | None = None) -> Axis:
    """Return the axis `clearance`; its only value is NaN in a scene without play."""
    if not simulation.source.clearances:
        return Axis("clearance", (math.nan,), "m")
    return axis(simulation, "clearance", values, parameters)


def _find_choice(source: KernelSource, name: str) -> Slot | None:
    """Return the parameter of an address if it is a choice by name, else None."""
    return next((slot for slot in source.slots if slot.address == name and slot.words), None)


def _axis_parameters(source: KernelSource, name: str) -> list[int]:
    """Return the indices of the parameters that an axis sets; the first has the axis's values."""
    if name == "clearance":
        found = list(dict.fromkeys(j.clearance for j in source.clearances if j.clearance < len(source.slots)))
    elif name in GROUPS:
        found = [k for k, slot in enumerate(source.slots) if GROUPS[name](slot.address)]
    else:
        return [int(np.flatnonzero(given_slots(source, {name: 1.0})[1])[0])]
    if not found:
        raise BadValueError(f"axis {name}: scene {source.scene!r} has no such number")
    return found


def _drop_unused_materials(source: KernelSource, p: Array, slots: list[int]) -> list[int]:
    """Return the indices without stiffnesses of materials that runs may choose but do not with p."""
    of = [(slot, specified(slot, float(x))) for slot, x in zip(source.slots, p, strict=False) if slot.words]
    of = [(slot, name) for slot, name in of if slot.address.startswith(("bearings.", "guides."))]
    offered = {f"materials.{word}.E" for slot, _ in of for word in slot.words}
    selected = {f"materials.{name}.E" for _, name in of}
    return slots if len(slots) < 2 else [k for k in slots if source.slots[k].address not in offered - selected]


def _first_parameter(source: KernelSource, name: str) -> Slot:
    """Return the parameter whose values an axis has."""
    if name in SETTINGS:
        return Slot(name, SETTINGS[name], 0.0, False, (0, 0, 1 if name == "step" else 0))
    return source.slots[_axis_parameters(source, name)[0]]


def _parse_value(text: str) -> float | str:
    """Return the number of a text with unit such as "1mm"."""
    from gudgeon.model.parameters import value

    return value(text)

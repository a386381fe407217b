"""What a map or a box of `gudgeon map` varies: a step, a tolerance, a run-time number, or several together."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError
from gudgeon.language.wanted import listed, numbers, text
from gudgeon.model.choices import place_of_word, said
from gudgeon.model.compiled import Array
from gudgeon.model.parameters import GAINS, given_slots, number, prepare
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.runs import Parameters

SETTINGS = {"step": "s", "rtol": ""}  # axes of the method, not of the mechanism
COUNT, MOST = 5, 1000  # values of a range that does not say; of any
_COUNT = re.compile(r"[0-9]{1,6}")
# Axes that move every such number of the scene, each by its ratio to the first.
GROUPS: dict[str, Callable[[str], bool]] = {
    "stiffness": lambda address: address.startswith("materials.") and address.endswith(".E"),
    "viscosity": lambda address: address.startswith("contacts.") and address.endswith(".viscosity"),
    "gains": lambda address: address in GAINS,
}


@dataclass(frozen=True)
class Axis:
    """A name, its values (SI, ascending), and the addresses that get them, each times its ratio.

    `words`: of a choice, a material; its values are their places.
    """

    name: str
    values: tuple[float, ...]
    unit: str
    ratios: tuple[tuple[str, float], ...] = ()
    words: tuple[str, ...] = ()

    @property
    def of_method(self) -> bool:
        """Whether it is the step or the tolerance."""
        return self.name in SETTINGS

    def parameters(self, value: float) -> dict[str, float | str]:
        """What `simulate` is given for a value; nothing for an axis of the method or of a scene without play."""
        if self.words:
            return {address: self.words[int(value)] for address, _ in self.ratios}
        return {address: value * ratio for address, ratio in self.ratios}


def axis(
    simulation: Simulation, name: str, values: Sequence[float | str], parameters: Parameters | None = None
) -> Axis:
    """`name`: step, rtol, clearance, stiffness, viscosity, gains, or the address of any run-time number or choice.

    values: numbers (SI); of a choice, a material, names. Raises UnknownNameError for a name that is none,
    BadValueError for one that the scene has no number for.
    """
    if (slot := _choice(simulation.source, text(name, "axis"))) is not None:
        names = listed(values, f"axis {name}", str, f"a list of names, of {', '.join(slot.words)}")
        places = sorted({place_of_word(one, slot) for one in names})
        return Axis(name, tuple(places), "", ((name, 1.0),), slot.words)
    values = numbers(values, f"axis {name}")
    if name in SETTINGS:
        return Axis(name, tuple(sorted(values)), SETTINGS[name])
    source, p = simulation.source, prepare(simulation.compiled, parameters)[0]
    slots = _in_use(source, p, _slots(source, name))
    first = float(p[slots[0]])
    if len(slots) > 1 and first == 0.0:
        raise BadValueError(f"axis {name}: {source.slots[slots[0]].address} is zero, there is no ratio to it")
    ratios = tuple((source.slots[k].address, float(p[k]) / first if len(slots) > 1 else 1.0) for k in slots)
    return Axis(name, tuple(sorted(values)), source.slots[slots[0]].unit, ratios)


def typed(simulation: Simulation, written: str, parameters: Parameters | None = None) -> Axis:
    """From the command line: "c=.05mm..1mm:5" (logarithmic), "omega=3,6,9", "rtol=1e-4..1e-10:4"."""
    name, _, told = text(written, "axis").partition("=")
    if not told:
        raise BadValueError(f"axis {written!r}: expected name=low..high:count or name=a,b,c")
    if (choice := _choice(simulation.source, name.strip())) is not None:
        if ".." in told or ":" in told:
            names = ",".join(choice.words)
            raise BadValueError(f"axis {written!r}: its values are names, there is none between: {name}={names}")
        return axis(simulation, name.strip(), told.split(","), parameters)
    ends, colon, count = told.partition(":")
    slot = _slot(simulation.source, name.strip())
    values = [number(_spaced(part), slot) for part in (ends.split("..") if ".." in ends else ends.split(","))]
    if ".." in ends:
        if len(values) != 2 or not 0 < values[0] < values[1]:
            raise BadValueError(f"axis {written!r}: expected 0 < low < high")
        wanted = COUNT if not colon else int(count) if _COUNT.fullmatch(count) else 0
        if not 2 <= wanted <= MOST:
            raise BadValueError(f"axis {written!r}: expected a whole number of values after ':', from 2 to {MOST}")
        values = np.geomspace(values[0], values[1], wanted).tolist()
    elif colon:
        raise BadValueError(f"axis {written!r}: only a range low..high takes a number of values after ':'")
    return axis(simulation, name.strip(), [float(f"{x:.6g}") for x in values], parameters)


def clearances(simulation: Simulation, values: Sequence[float], parameters: Parameters | None = None) -> Axis:
    """The axis `clearance`, (NaN,) in a scene without play."""
    if not simulation.source.clearances:
        return Axis("clearance", (math.nan,), "m")
    return axis(simulation, "clearance", values, parameters)


def _choice(source: KernelSource, name: str) -> Slot | None:
    """What a run chooses by name, under its address."""
    return next((slot for slot in source.slots if slot.address == name and slot.words), None)


def _slots(source: KernelSource, name: str) -> list[int]:
    """Which numbers an axis moves; the first gives it its values."""
    if name == "clearance":
        found = list(dict.fromkeys(j.clearance for j in source.clearances if j.clearance < len(source.slots)))
    elif name in GROUPS:
        found = [k for k, slot in enumerate(source.slots) if GROUPS[name](slot.address)]
    else:
        return [int(np.flatnonzero(given_slots(source, {name: 1.0})[1])[0])]
    if not found:
        raise BadValueError(f"axis {name}: scene {source.scene!r} has no such number")
    return found


def _in_use(source: KernelSource, p: Array, slots: list[int]) -> list[int]:
    """Without the stiffness of materials that a run with p might choose and does not."""
    of = [(slot, said(slot, float(x))) for slot, x in zip(source.slots, p, strict=False) if slot.words]
    of = [(slot, name) for slot, name in of if slot.address.startswith(("bearings.", "guides."))]
    offered = {f"materials.{word}.E" for slot, _ in of for word in slot.words}
    chosen = {f"materials.{name}.E" for _, name in of}
    return slots if len(slots) < 2 else [k for k in slots if source.slots[k].address not in offered - chosen]


def _slot(source: KernelSource, name: str) -> Slot:
    if name in SETTINGS:
        return Slot(name, SETTINGS[name], 0.0, False, (0, 0, 1 if name == "step" else 0))
    return source.slots[_slots(source, name)[0]]


def _spaced(text: str) -> float | str:
    from gudgeon.model.parameters import value

    return value(text)

"""The numbers of a file as a page offers them: by section, in the unit that the file has, with a range of a slider."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from typing import Any

from gudgeon.assembly.linkage import mechanism_size
from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import GudgeonError, Location
from gudgeon.language.output_units import angle_power
from gudgeon.language.parser import parse
from gudgeon.language.plot_units import drawn, pretty
from gudgeon.language.quantities import number_of_text
from gudgeon.language.units import TIME, UNITS, dimension
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import in_contours
from gudgeon.model.parameters import prepare
from gudgeon.simulation.simulation import Simulation

SECTIONS = {
    "parameters": "Parameters",
    "bodies": "Bodies",
    "ground": "Ground",
    "gravity": "Gravity",
    "joints": "Joints",
    "drives": "Drives",
    "forces": "Forces",
    "bearings": "Bearings",
    "guides": "Guides",
    "contacts": "Contacts",
    "materials": "Materials",
    "baumgarte": "Baumgarte's terms",
    "start": "Start",
}
MORE, TURN = 4.0, 3.141592653589793  # how many times a positive number, how far an angle goes either way
SMALL = 0.05  # share of the mechanism's size below which a length is none of its links
STAY = ("bodies", "bearings", "guides", "contacts", "materials", "baumgarte")  # whose positive numbers keep their sign
HALVINGS = 30  # of what lies between a number and an end that is refused
EDGE = 1e-3  # share of the range that a slider keeps from a bound that is out of reach
WRITTEN = re.compile(r".*?(?:[\d.)]|\bpi)\s+([A-Za-zµΩ°%][\w*/^.()µ°-]*)$")  # "2*pi rad/s": the unit at its end
ANGLES = ("deg", "rad", "°")


def groups(simulation: Simulation, p: Array) -> list[dict[str, Any]]:
    """Sections of numbers, the parameters first: [{title, numbers: [{k, name, unit, factor, low, high}]}]."""
    source, units = simulation.source, _Units(simulation)
    size, found = mechanism_size(simulation.compiled, p), dict[str, list[dict[str, Any]]]()
    worn = in_contours(source)
    for k, slot in ((k, slot) for k, slot in enumerate(source.slots) if k not in worn):
        section, _, name = slot.address.partition(".")
        told: dict[str, Any] = {"k": k, "name": name or section}
        if not slot.words:
            unit, factor = units.of(slot)
            angle = unit in ANGLES or slot.address.endswith((".theta", ".angle"))
            low, high = _range(source, slot, p, size, angle)
            low, high = (_allowed(simulation.compiled, slot, float(p[k]), end) for end in (low, high))
            told |= {"unit": pretty(unit), "factor": factor, "low": low, "high": high}
        found.setdefault(section, []).append(told)
    order = [*(name for name in SECTIONS if name in found), *(name for name in found if name not in SECTIONS)]
    return [{"title": SECTIONS.get(name, name.capitalize()), "numbers": _together(found[name])} for name in order]


def _together(numbers: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those of one body, bearing, … beside each other."""
    owners = list(dict.fromkeys(one["name"].partition(".")[0] for one in numbers))
    return sorted(numbers, key=lambda one: owners.index(one["name"].partition(".")[0]))


def units(source: KernelSource) -> dict[str, dict[str, float]]:
    """What may be typed behind a number, by its unit in SI: units of the same dimension, and how many of SI each is."""
    kinds = {"s": TIME} | {slot.unit: dimension(*slot.dimension) for slot in source.slots if not slot.words}
    return {
        si: {name: factor for name, (factor, of) in UNITS.items() if of == own and name.isascii()}
        for si, own in kinds.items()
    }


def _allowed(compiled: CompiledModel, slot: Slot, value: float, end: float) -> float:
    """The end of a slider; where what follows from the number breaks a condition, the last one before that."""

    def refused(at: float) -> bool:
        try:
            prepare(compiled, {slot.address: at})
        except GudgeonError:
            return True
        return False

    if not refused(end) or refused(value):
        return end
    good, bad = value, end
    for _ in range(HALVINGS):
        middle = 0.5 * (good + bad)
        good, bad = (good, middle) if refused(middle) else (middle, bad)
    return 0.0 if abs(good) < EDGE * abs(value) and not refused(0.0) else good + EDGE * (value - good)


class _Units:
    """Units as the file writes them; of what it does not write those that it has for the like, or as figures have."""

    def __init__(self, simulation: Simulation) -> None:
        from gudgeon.generator.yaml import parse_yaml

        try:
            tree: Any = parse_yaml(simulation.file.read_bytes(), str(simulation.file))
        except (GudgeonError, OSError):  # it is not there any more
            tree = {}
        self.written, counts = dict[str, tuple[str, float]](), dict[str, Counter[tuple[str, float]]]()
        for slot in simulation.source.slots:
            if (unit := _unit_at(tree, slot)) is not None:
                self.written[slot.address] = unit
                counts.setdefault(slot.unit, Counter())[unit] += 1
        self.usual: Mapping[str, tuple[str, float]] = {si: most.most_common(1)[0][0] for si, most in counts.items()}

    def of(self, slot: Slot) -> tuple[str, float]:
        """The unit, and how many of SI it is."""
        if slot.address in self.written:
            return self.written[slot.address]
        if slot.unit in self.usual and (slot.unit == "m" or slot.follows):  # 1/s may be a rate, a gain, a speed
            return self.usual[slot.unit]
        if slot.address.endswith((".theta", ".angle")):
            return "deg", number_of_text("1 deg", slot.address, (0, 0, 0))
        factor, unit = drawn(slot.default, slot.unit) if slot.unit != "1/s" else (1.0, "1/s")
        return unit, 1.0 / factor


def _unit_at(tree: Any, slot: Slot) -> tuple[str, float] | None:
    """The unit that stands at an address of the file: of a scalar, or of a coordinate of a point."""
    node = tree
    for key in slot.address.split("."):
        if isinstance(node, list):
            node = node["xy".index(key)] if key in ("x", "y") and len(node) == 2 else None
        else:
            node = node.get(key) if isinstance(node, dict) else None
    found = WRITTEN.match(node.strip()) if isinstance(node, str) else None
    try:
        if found is None:  # pi/6
            written = parse(node, Location(slot.address, 1, 1)) if isinstance(node, str) and not slot.unit else None
            return ("deg", UNITS["deg"][0]) if written is not None and angle_power(written) == 1 else None
        return found[1], number_of_text(f"1 {found[1]}", slot.address, slot.dimension)
    except GudgeonError:
        return None


def _range(source: KernelSource, slot: Slot, p: Array, size: float, angle: bool) -> tuple[float, float]:
    """Of a slider, SI: within the conditions that are numbers; four times a positive number, twice a length, half a
    turn about an angle, once its size about a place, twice either way what may turn round."""
    value = float(p[[other.address for other in source.slots].index(slot.address)])
    mine = [one for one in source.conditions if one.address == slot.address and not one.addresses]
    lower = [(float(one.bound), one.relation) for one in mine if one.relation in (">", ">=")]
    upper = [(float(one.bound), one.relation) for one in mine if one.relation in ("<", "<=")]
    section, place = slot.address.partition(".")[0], slot.unit == "m"
    small = place and abs(value) < SMALL * size  # a clearance, a film's width: no place
    if value > 0.0 and (lower or small or (section in STAY and not place)):
        low, high = 0.0, (2.0 if place and not small else MORE) * value
    elif angle:
        low, high = value - TURN, value + TURN
    elif value == 0.0:
        reach = {"m": 0.5 * size, "m/s^2": 20.0, "": 1.0}.get(slot.unit, 1.0)
        low, high = -reach, reach
    elif place:
        low, high = value - abs(value), value + abs(value)
    else:
        low, high = -2.0 * abs(value), 2.0 * abs(value)
    low = max([low, *(bound for bound, _ in lower)])
    high = min([high, *(bound for bound, _ in upper)])
    edge = EDGE * (high - low)
    low += edge if (low, ">") in lower else 0.0
    return low, high - (edge if (high, "<") in upper else 0.0)

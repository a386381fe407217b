"""Arrange the parameters of a file for the panel of a page: sections, units of the file, ranges of sliders."""

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
from gudgeon.model.contours import contour_parameters
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
MORE, TURN = 4.0, 3.141592653589793  # range of a positive number over its value, half range of an angle in rad
SMALL = 0.05  # lengths below this fraction of the mechanism's size are not link lengths
STAY = ("bodies", "bearings", "guides", "contacts", "materials", "baumgarte")  # whose positive numbers keep their sign
HALVINGS = 30  # bisections between a valid value and a refused end
EDGE = 1e-3  # distance of a slider from an open bound, over its range
WRITTEN = re.compile(r".*?(?:[\d.)]|\bpi)\s+([A-Za-zµΩ°%][\w*/^.()µ°-]*)$")  # "2*pi rad/s": the unit at its end
ANGLES = ("deg", "rad", "°")


def groups(simulation: Simulation, p: Array) -> list[dict[str, Any]]:
    """Return the sections of parameters, with `parameters` first: [{title, numbers: [{k, name, unit, factor, low,
    high}]}].
    """
    source, units = simulation.source, _Units(simulation)
    size, found = mechanism_size(simulation.compiled, p), dict[str, list[dict[str, Any]]]()
    worn = contour_parameters(source)
    for k, slot in ((k, slot) for k, slot in enumerate(source.slots) if k not in worn):
        section, _, name = slot.address.partition(".")
        message: dict[str, Any] = {"k": k, "name": name or section}
        if not slot.words:
            unit, factor = units.of(slot)
            angle = unit in ANGLES or slot.address.endswith((".theta", ".angle"))
            low, high = _slider_range(source, slot, p, size, angle)
            low, high = (_limit_range(simulation.compiled, slot, float(p[k]), end) for end in (low, high))
            message |= {"unit": pretty(unit), "factor": factor, "low": low, "high": high}
        found.setdefault(section, []).append(message)
    order = [*(name for name in SECTIONS if name in found), *(name for name in found if name not in SECTIONS)]
    return [{"title": SECTIONS.get(name, name.capitalize()), "numbers": _sort_by_owner(found[name])} for name in order]


def _sort_by_owner(numbers: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the parameters sorted so that those of one body, bearing, … follow each other."""
    owners = list(dict.fromkeys(one["name"].partition(".")[0] for one in numbers))
    return sorted(numbers, key=lambda one: owners.index(one["name"].partition(".")[0]))


def units(source: KernelSource) -> dict[str, dict[str, float]]:
    """Return the units that may be typed after a number, by SI unit: name and value in SI."""
    kinds = {"s": TIME} | {slot.unit: dimension(*slot.dimension) for slot in source.slots if not slot.words}
    return {
        si: {name: factor for name, (factor, of) in UNITS.items() if of == own and name.isascii()}
        for si, own in kinds.items()
    }


def _limit_range(compiled: CompiledModel, slot: Slot, value: float, end: float) -> float:
    """Return the end of a slider; if a derived condition refuses it, the last value before by bisection."""

    def is_step_refused(at: float) -> bool:
        """Return whether the value breaks a condition."""
        try:
            prepare(compiled, {slot.address: at})
        except GudgeonError:
            return True
        return False

    if not is_step_refused(end) or is_step_refused(value):
        return end
    good, bad = value, end
    for _ in range(HALVINGS):
        middle = 0.5 * (good + bad)
        good, bad = (good, middle) if is_step_refused(middle) else (middle, bad)
    return 0.0 if abs(good) < EDGE * abs(value) and not is_step_refused(0.0) else good + EDGE * (value - good)


class _Units:
    """Units of parameters as the file writes them, or as it writes similar ones, or as figures have them."""

    def __init__(self, simulation: Simulation) -> None:
        """Read the units from the mechanism file; if it does not exist any more, none are known."""
        from gudgeon.generator.yaml import parse_yaml

        try:
            tree: Any = parse_yaml(simulation.file.read_bytes(), str(simulation.file))
        except (GudgeonError, OSError):  # the file does not exist any more
            tree = {}
        self.written, counts = dict[str, tuple[str, float]](), dict[str, Counter[tuple[str, float]]]()
        for slot in simulation.source.slots:
            if (unit := _read_unit(tree, slot)) is not None:
                self.written[slot.address] = unit
                counts.setdefault(slot.unit, Counter())[unit] += 1
        self.usual: Mapping[str, tuple[str, float]] = {si: most.most_common(1)[0][0] for si, most in counts.items()}

    def of(self, slot: Slot) -> tuple[str, float]:
        """Return the unit of a parameter and its value in SI."""
        if slot.address in self.written:
            return self.written[slot.address]
        if slot.unit in self.usual and (slot.unit == "m" or slot.follows):  # 1/s may be a rate or a gain
            return self.usual[slot.unit]
        if slot.address.endswith((".theta", ".angle")):
            return "deg", number_of_text("1 deg", slot.address, (0, 0, 0))
        factor, unit = drawn(slot.default, slot.unit) if slot.unit != "1/s" else (1.0, "1/s")
        return unit, 1.0 / factor


def _read_unit(tree: Any, slot: Slot) -> tuple[str, float] | None:
    """Return the unit written at an address of the file, and its value in SI; None if there is none."""
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


def _slider_range(source: KernelSource, slot: Slot, p: Array, size: float, angle: bool) -> tuple[float, float]:
    """Return the range of a slider in SI, within the constant conditions.

    Positive numbers: 0 to four times the value; lengths: 0 to twice the value; angles: half a turn in both directions;
    positions: zero to twice the value; other numbers: twice the value in both directions.
    """
    value = float(p[[other.address for other in source.slots].index(slot.address)])
    mine = [one for one in source.conditions if one.address == slot.address and not one.addresses]
    lower = [(float(one.bound), one.relation) for one in mine if one.relation in (">", ">=")]
    upper = [(float(one.bound), one.relation) for one in mine if one.relation in ("<", "<=")]
    section, place = slot.address.partition(".")[0], slot.unit == "m"
    small = place and abs(value) < SMALL * size  # a clearance or a bearing width, not a position
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

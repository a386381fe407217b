"""Arrange the parameters of a file as input fields of a simulator page: groups, units, ranges of sliders."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from typing import Any

from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import GudgeonError, Location
from gudgeon.language.output_units import find_angle_power
from gudgeon.language.parser import parse
from gudgeon.language.plot_units import choose_plot_unit, format_unit
from gudgeon.language.quantities import parse_quantity
from gudgeon.language.units import TIME, UNITS, make_dimension
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import find_contour_parameters
from gudgeon.model.parameters import compute_parameter_values
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
MAX_FACTOR = 4.0  # largest value of the slider of a positive number, over the present value
HALF_TURN = 3.141592653589793  # half the range of an angle, rad
MIN_LINK_FRACTION = 0.05  # lengths below this fraction of the mechanism's size are not link lengths
# sections whose positive parameters have no negative values on the slider
SIGNED_SECTIONS = ("bodies", "bearings", "guides", "contacts", "materials", "baumgarte")
N_BISECTIONS = 30  # bisections between a valid value and a refused end
BOUND_MARGIN = 1e-3  # distance of a slider from an open bound, over its range
UNIT_PATTERN = re.compile(r".*?(?:[\d.)]|\bpi)\s+([A-Za-zµΩ°%][\w*/^.()µ°-]*)$")  # "2*pi rad/s": the unit at its end
ANGLE_UNITS = ("deg", "rad", "°")


def build_parameter_sections(simulation: Simulation, p: Array) -> list[dict[str, Any]]:
    """Return the sections of parameters for the panel, `parameters` first: [{title, numbers: [{k, name, unit, factor,
    low, high}]}].

    k is the parameter's index in `p`, the file's values; factor is the unit's value in SI. low and high (SI) are the
    slider's range. Choices have k and name only; points of contours are left out.
    """
    source, units = simulation.source, _Units(simulation)
    mechanism_length, entries_by_section = (
        compute_mechanism_size(simulation.compiled, p),
        dict[str, list[dict[str, Any]]](),
    )
    contour_indices = find_contour_parameters(source)
    for k, parameter in ((k, parameter) for k, parameter in enumerate(source.parameters) if k not in contour_indices):
        section, _, name = parameter.address.partition(".")
        entry: dict[str, Any] = {"k": k, "name": name or section}
        if not parameter.words:
            unit, factor = units.find_unit(parameter)
            is_angle = unit in ANGLE_UNITS or parameter.address.endswith((".theta", ".angle"))
            low, high = _compute_slider_range(source, parameter, p, mechanism_length, is_angle)
            low, high = (_limit_range_end(simulation.compiled, parameter, float(p[k]), end) for end in (low, high))
            entry |= {"unit": format_unit(unit), "factor": factor, "low": low, "high": high}
        entries_by_section.setdefault(section, []).append(entry)
    sections = [
        *(name for name in SECTIONS if name in entries_by_section),
        *(name for name in entries_by_section if name not in SECTIONS),
    ]
    return [
        {"title": SECTIONS.get(name, name.capitalize()), "numbers": _sort_by_owner(entries_by_section[name])}
        for name in sections
    ]


def _sort_by_owner(entries: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the entries of parameters sorted so that those of one body, bearing, … follow each other."""
    owners = list(dict.fromkeys(entry["name"].partition(".")[0] for entry in entries))
    return sorted(entries, key=lambda entry: owners.index(entry["name"].partition(".")[0]))


def list_units(source: KernelSource) -> dict[str, dict[str, float]]:
    """Return the units that may be typed after a number, by SI unit: {name: value in SI}."""
    dimensions = {"s": TIME} | {
        parameter.unit: make_dimension(*parameter.dimension) for parameter in source.parameters if not parameter.words
    }
    return {
        si: {
            name: factor
            for name, (factor, unit_dimension) in UNITS.items()
            if unit_dimension == si_dimension and name.isascii()
        }
        for si, si_dimension in dimensions.items()
    }


def _limit_range_end(compiled: CompiledModel, parameter: RuntimeParameter, current_value: float, end: float) -> float:
    """Return the end of a slider's range, or if `end` is not allowed, the allowed value nearest to it, by bisection.

    The bisection begins at the current `value`; a margin of BOUND_MARGIN is kept. `end` is also returned if the current
    value is not allowed.
    """

    def is_value_invalid(new_value: float) -> bool:
        """Return whether a value of the parameter violates a condition."""
        try:
            compute_parameter_values(compiled, {parameter.address: new_value})
        except GudgeonError:
            return True
        return False

    if not is_value_invalid(end) or is_value_invalid(current_value):
        return end
    valid_value, invalid_value = current_value, end
    for _ in range(N_BISECTIONS):
        middle = 0.5 * (valid_value + invalid_value)
        valid_value, invalid_value = (valid_value, middle) if is_value_invalid(middle) else (middle, invalid_value)
    return (
        0.0
        if abs(valid_value) < BOUND_MARGIN * abs(current_value) and not is_value_invalid(0.0)
        else valid_value + BOUND_MARGIN * (current_value - valid_value)
    )


class _Units:
    """Units of parameters: those in the file, else those of similar parameters in the file, else those of plots."""

    def __init__(self, simulation: Simulation) -> None:
        """Read the unit of each parameter from the mechanism file and count units by SI unit; a file that cannot be
        read has none.
        """
        from gudgeon.generator.yaml import parse_yaml

        try:
            document: Any = parse_yaml(simulation.file.read_bytes(), str(simulation.file))
        except (GudgeonError, OSError):  # the file does not exist any more
            document = {}
        self.units_in_file, unit_counts = dict[str, tuple[str, float]](), dict[str, Counter[tuple[str, float]]]()
        for parameter in simulation.source.parameters:
            if (unit := _read_unit(document, parameter)) is not None:
                self.units_in_file[parameter.address] = unit
                unit_counts.setdefault(parameter.unit, Counter())[unit] += 1
        self.most_frequent_units: Mapping[str, tuple[str, float]] = {
            si: counter.most_common(1)[0][0] for si, counter in unit_counts.items()
        }

    def find_unit(self, parameter: RuntimeParameter) -> tuple[str, float]:
        """Return the unit of a parameter and its value in SI.

        It is the unit in the file, else the most frequent one of similar parameters, else degrees or a unit of suitable
        size.
        """
        if parameter.address in self.units_in_file:
            return self.units_in_file[parameter.address]
        if parameter.unit in self.most_frequent_units and (
            parameter.unit == "m" or parameter.follows
        ):  # 1/s may be a rate or a gain
            return self.most_frequent_units[parameter.unit]
        if parameter.address.endswith((".theta", ".angle")):
            return "deg", parse_quantity("1 deg", parameter.address, (0, 0, 0))
        factor, unit = choose_plot_unit(parameter.default, parameter.unit) if parameter.unit != "1/s" else (1.0, "1/s")
        return unit, 1.0 / factor


def _read_unit(document: Any, parameter: RuntimeParameter) -> tuple[str, float] | None:
    """Return the unit written at a parameter's address in the file, and its value in SI; None if there is none.

    An expression with π of a dimensionless parameter, such as pi/6, is an angle: ("deg", π/180).
    """
    node = document
    for key in parameter.address.split("."):
        if isinstance(node, list):
            node = node["xy".index(key)] if key in ("x", "y") and len(node) == 2 else None
        else:
            node = node.get(key) if isinstance(node, dict) else None
    match = UNIT_PATTERN.match(node.strip()) if isinstance(node, str) else None
    try:
        if match is None:  # pi/6
            expression = (
                parse(node, Location(parameter.address, 1, 1)) if isinstance(node, str) and not parameter.unit else None
            )
            return ("deg", UNITS["deg"][0]) if expression is not None and find_angle_power(expression) == 1 else None
        return match[1], parse_quantity(f"1 {match[1]}", parameter.address, parameter.dimension)
    except GudgeonError:
        return None


def _compute_slider_range(
    source: KernelSource, parameter: RuntimeParameter, p: Array, mechanism_length: float, is_angle: bool
) -> tuple[float, float]:
    """Return the range (low, high) of a parameter's slider in SI, within the constant conditions.

    Positive parameters (bounded below, small lengths, SIGNED_SECTIONS): 0 to four times the value, lengths to twice.
    Angles: ±π about the value. Zeros: a range by unit. Other lengths: 0 to twice the value. Others: ± twice the value.
    """
    value = float(p[[other_slot.address for other_slot in source.parameters].index(parameter.address)])
    own_conditions = [
        condition
        for condition in source.conditions
        if condition.address == parameter.address and not condition.addresses
    ]
    lower = [
        (float(condition.bound), condition.relation)
        for condition in own_conditions
        if condition.relation in (">", ">=")
    ]
    upper = [
        (float(condition.bound), condition.relation)
        for condition in own_conditions
        if condition.relation in ("<", "<=")
    ]
    section, is_length = parameter.address.partition(".")[0], parameter.unit == "m"
    # a small length is a clearance or a bearing width, not a position
    is_small = is_length and abs(value) < MIN_LINK_FRACTION * mechanism_length
    if value > 0.0 and (lower or is_small or (section in SIGNED_SECTIONS and not is_length)):
        low, high = 0.0, (2.0 if is_length and not is_small else MAX_FACTOR) * value
    elif is_angle:
        low, high = value - HALF_TURN, value + HALF_TURN
    elif value == 0.0:
        half_range = {"m": 0.5 * mechanism_length, "m/s^2": 20.0, "": 1.0}.get(parameter.unit, 1.0)
        low, high = -half_range, half_range
    elif is_length:
        low, high = value - abs(value), value + abs(value)
    else:
        low, high = -2.0 * abs(value), 2.0 * abs(value)
    low = max([low, *(bound for bound, _ in lower)])
    high = min([high, *(bound for bound, _ in upper)])
    edge = BOUND_MARGIN * (high - low)
    low += edge if (low, ">") in lower else 0.0
    return low, high - (edge if (high, "<") in upper else 0.0)

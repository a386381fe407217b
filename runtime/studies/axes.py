"""Define the axes of `gudgeon map`, a parameter sweep: step, tolerance or run-time parameters with their values."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_list, check_numbers, check_text
from gudgeon.model.choices import find_word_index, format_parameter
from gudgeon.model.compiled import Array
from gudgeon.model.parameters import GAINS, compute_parameter_values, read_given_parameters, read_parameter_value
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.runs import Parameters

SETTINGS = {"step": "s", "rtol": ""}  # axes of the method, not of the mechanism
DEFAULT_COUNT, MAX_COUNT = 5, 1000  # number of values of a range: by default, at most
_COUNT = re.compile(r"[0-9]{1,6}")
# Axes that vary all parameters of a kind together; each keeps its ratio to the first.
GROUPS: dict[str, Callable[[str], bool]] = {
    "stiffness": lambda address: address.startswith("materials.") and address.endswith(".E"),
    "viscosity": lambda address: address.startswith("contacts.") and address.endswith(".viscosity"),
    "gains": lambda address: address in GAINS,
}


@dataclass(frozen=True)
class Axis:
    """An axis with its values (SI, ascending) and the addresses that it sets, each to the value times its ratio.

    `option_names`: the names of a choice, such as a material; the values are indices into it.
    """

    name: str
    values: tuple[float, ...]
    unit: str
    ratios: tuple[tuple[str, float], ...] = ()
    option_names: tuple[str, ...] = ()

    @property
    def is_method_setting(self) -> bool:
        """Return whether the axis varies a setting of the method, `step` or `rtol`, and not a parameter of the
        mechanism.
        """
        return self.name in SETTINGS

    def build_parameters(self, value: float) -> dict[str, float | str]:
        """Return the parameters, address to value, that `simulate` needs for one value of the axis.

        Each address gets the value times its ratio. For a choice, the value is an index and each address gets the name
        at that index. The result is empty for `step`, `rtol`, and the axis of clearances of a scene without play.
        """
        if self.option_names:
            return {address: self.option_names[int(value)] for address, _ in self.ratios}
        return {address: value * ratio for address, ratio in self.ratios}


def make_axis(
    simulation: Simulation, name: str, values: Sequence[float | str], parameters: Parameters | None = None
) -> Axis:
    """Return the axis with this name and these values, ascending.

    name: step, rtol, clearance, stiffness, viscosity, gains, or the address of a run-time parameter or choice. values:
    numbers (SI), or words for a choice, which become indices. parameters: values as in `simulate`, from which a group
    takes the ratios of its members to the first one. Raises UnknownNameError for an unknown name, BadValueError for
    invalid values, a name without a parameter in the scene, or a group whose first member is 0.
    """
    if (choice := _find_choice_parameter(simulation.source, check_text(name, "axis"))) is not None:
        names = check_list(values, f"axis {name}", str, f"a list of names, of {', '.join(choice.words)}")
        word_indices = sorted({find_word_index(word, choice) for word in names})
        return Axis(name, tuple(word_indices), "", ((name, 1.0),), choice.words)
    values = check_numbers(values, f"axis {name}")
    if name in SETTINGS:
        return Axis(name, tuple(sorted(values)), SETTINGS[name])
    source, p = simulation.source, compute_parameter_values(simulation.compiled, parameters)[0]
    indices = _drop_unused_materials(source, p, _find_parameter_indices(source, name))
    first_value = float(p[indices[0]])
    if len(indices) > 1 and first_value == 0.0:
        raise BadValueError(
            f"axis {name}: {source.parameters[indices[0]].address} is 0: expected another value, for the ratios to it"
        )
    ratios = tuple(
        (source.parameters[k].address, float(p[k]) / first_value if len(indices) > 1 else 1.0) for k in indices
    )
    return Axis(name, tuple(sorted(values)), source.parameters[indices[0]].unit, ratios)


def parse_axis(simulation: Simulation, axis_text: str, parameters: Parameters | None = None) -> Axis:
    """Return the axis that a command-line text describes: "c=.05mm..1mm:5", "omega=3,6,9", "rtol=1e-4..1e-10:4".

    A range low..high:count gives geometrically spaced values, 5 without a count, at most 1000. The values of a choice
    are words separated by commas. Numbers may have units and are rounded to six digits. Raises BadValueError for a text
    of another form, and the errors of `make_axis`.
    """
    name, _, value_list = check_text(axis_text, "axis").partition("=")
    if not value_list:
        raise BadValueError(f"axis {axis_text!r}: expected name=low..high:count or name=a,b,c")
    if (choice := _find_choice_parameter(simulation.source, name.strip())) is not None:
        if ".." in value_list or ":" in value_list:
            names = ",".join(choice.words)
            raise BadValueError(f"axis {axis_text!r}: a choice by name has no range: expected {name}={names}")
        return make_axis(simulation, name.strip(), value_list.split(","), parameters)
    ends, colon, count = value_list.partition(":")
    parameter = _find_axis_parameter(simulation.source, name.strip())
    values = [
        read_parameter_value(_parse_quantity(part), parameter)
        for part in (ends.split("..") if ".." in ends else ends.split(","))
    ]
    if ".." in ends:
        if len(values) != 2 or not 0 < values[0] < values[1]:
            raise BadValueError(f"axis {axis_text!r}: expected 0 < low < high")
        n_values = DEFAULT_COUNT if not colon else int(count) if _COUNT.fullmatch(count) else 0
        if not 2 <= n_values <= MAX_COUNT:
            raise BadValueError(
                f"axis {axis_text!r}: expected a whole number of values after ':', from 2 to {MAX_COUNT}"
            )
        values = np.geomspace(values[0], values[1], n_values).tolist()
    elif colon:
        raise BadValueError(f"axis {axis_text!r}: ':' and a number of values are allowed after a range low..high only")
    return make_axis(simulation, name.strip(), [float(f"{x:.6g}") for x in values], parameters)


def make_clearance_axis(simulation: Simulation, values: Sequence[float], parameters: Parameters | None = None) -> Axis:
    """Return the axis `clearance`: values (m) of the first joint's clearance, to which the others keep their ratios.

    parameters: values as in `simulate`, from which the ratios follow. In a scene without play, `values` are ignored and
    the only value is NaN.
    """
    if not simulation.source.clearances:
        return Axis("clearance", (math.nan,), "m")
    return make_axis(simulation, "clearance", values, parameters)


def _find_choice_parameter(source: KernelSource, name: str) -> RuntimeParameter | None:
    """Return the run-time parameter with this address if it is a choice by name, such as a material, else None."""
    return next((parameter for parameter in source.parameters if parameter.address == name and parameter.words), None)


def _find_parameter_indices(source: KernelSource, name: str) -> list[int]:
    """Return the indices into the scene's parameter vector that the axis `name` sets.

    The values of the axis are those of the first parameter; the others keep their ratio to it (`make_axis`). name:
    "clearance", a group (stiffness, viscosity, gains) or an address: then the list has one index. Raises BadValueError
    if the scene has no parameter of the group, UnknownNameError for an unknown address.
    """
    if name == "clearance":
        indices = list(dict.fromkeys(j.clearance for j in source.clearances if j.clearance < len(source.parameters)))
    elif name in GROUPS:
        indices = [k for k, parameter in enumerate(source.parameters) if GROUPS[name](parameter.address)]
    else:
        return [int(np.flatnonzero(read_given_parameters(source, {name: 1.0})[1])[0])]
    if not indices:
        raise BadValueError(f"axis {name}: scene {source.scene!r} has no such parameter")
    return indices


def _drop_unused_materials(source: KernelSource, p: Array, indices: list[int]) -> list[int]:
    """Return the parameter indices without Young's moduli of materials that no bearing or guide uses with p.

    p: parameter vector. indices: into p; a single index is returned unchanged. Only materials that a choice of a
    bearing or guide offers can be removed.
    """
    choices = [
        (parameter, format_parameter(parameter, float(entry)))
        for parameter, entry in zip(source.parameters, p, strict=False)
        if parameter.words
    ]
    choices = [
        (parameter, name) for parameter, name in choices if parameter.address.startswith(("bearings.", "guides."))
    ]
    selectable = {f"materials.{word}.E" for parameter, _ in choices for word in parameter.words}
    selected = {f"materials.{name}.E" for _, name in choices}
    return (
        indices
        if len(indices) < 2
        else [k for k in indices if source.parameters[k].address not in selectable - selected]
    )


def _find_axis_parameter(source: KernelSource, name: str) -> RuntimeParameter:
    """Return the parameter whose unit and dimension the values of the axis `name` have.

    It is a new RuntimeParameter for `step` (s) and `rtol` (no dimension), else the first parameter that the axis sets.
    """
    if name in SETTINGS:
        return RuntimeParameter(name, SETTINGS[name], 0.0, False, (0, 0, 1 if name == "step" else 0))
    return source.parameters[_find_parameter_indices(source, name)[0]]


def _parse_quantity(text: str) -> float | str:
    """Return the value in SI of a text such as "1mm" or "3"; a text that is not a quantity is returned unchanged."""
    from gudgeon.model.parameters import parse_typed_number

    return parse_typed_number(text)

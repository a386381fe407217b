"""Write the XML descriptions of an FMU: variables with their value references, units, states, compiled files.

https://fmi-standard.org/docs/3.0.2/
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from hashlib import sha256
from xml.sax.saxutils import quoteattr

from gudgeon.contract.boundary import (
    N_CLEARANCE_COLUMNS,
    N_FRICTION_COLUMNS,
    N_REACTION_COLUMNS,
    VR_INDICATORS,
    VR_OUTPUTS,
    VR_PARAMETERS,
    VR_RATES,
    VR_RTOL,
    VR_STATES,
    VR_TIME,
    WORK_NAMES,
)
from gudgeon.contract.kernel_source import HEADER, KernelSource
from gudgeon.integrators.adaptive import RTOL, find_integrated_angles
from gudgeon.language.units import DIMENSIONLESS, parse_unit
from gudgeon.loading.engine import parse_sizes
from gudgeon.model.parameters import format_conditions, list_conditions
from gudgeon.results.series import get_catalogue

# Arrays of which outputs are columns, in the order of `parts` in engine/fmi/instance.c.
PARTS = (
    "q",
    "v",
    "work",
    "memory",
    "a",
    "multipliers",
    "reactions",
    "torques",
    "clearance",
    "series",
    "friction",
    "energy",
    "power",
    "drift",
)
WIDTHS = {"reactions": N_REACTION_COLUMNS, "clearance": N_CLEARANCE_COLUMNS, "friction": N_FRICTION_COLUMNS}
UNITS = ("scene.c", "engine/engine.c", "engine/fmi/fmi3.c")  # C files that are compiled


def iterate_outputs(source: KernelSource) -> Iterator[tuple[str, str, int, int, str]]:
    """Yield name, unit, array, column and meaning of each series that is a column of an array.

    array: index into PARTS, or -1 for the states of contacts. Series that redundancy leaves indeterminate are left out.
    """
    indeterminate_names = {
        f"{name}.{component}" for name in source.indeterminate for component in ("Fx", "Fy", "M", "torque", "force")
    }
    indeterminate_names |= {f"lambda.{row.name}" for row in source.equations if row.owner in source.indeterminate}
    for name, series in get_catalogue(source).items():
        if name in indeterminate_names:
            continue
        if series.stored is not None:
            array, column = series.stored
        elif series.evaluated is not None:
            array, index = series.evaluated
            row, column = index if len(index) == 2 else (0, index[0])
            column += row * WIDTHS.get(array, 0)
        else:
            continue
        yield name, series.unit, -1 if array == "state" else PARTS.index(array), column, series.meaning


def _format_bound_attributes(source: KernelSource, address: str) -> str:
    """Return the XML attributes of a parameter: description of all its conditions, and min and max of constant ones.

    Strict (<, >) and variable bounds are in the description only. Returns "" without conditions.
    """
    condition_text = format_conditions(source, address)
    attributes = f" description={quoteattr(f'expected {condition_text}')}" if condition_text else ""
    for name, relation, tightest in (("min", ">=", max), ("max", "<=", min)):
        bounds = [
            condition.bound
            for condition in list_conditions(source)
            if condition.address == address and condition.relation == relation
        ]
        constant_bounds = [bound for bound in bounds if not isinstance(bound, str)]
        attributes += f' {name}="{tightest(constant_bounds)!r}"' if constant_bounds else ""
    return attributes


def iterate_parameters(source: KernelSource) -> Iterator[tuple[int, str, str, float]]:
    """Yield index, address, unit and default of each parameter that an FMU can set; choices of a name are left out."""
    for k, parameter in enumerate(source.parameters):
        if not parameter.words:
            yield k, parameter.address, parameter.unit, parameter.default


def explain_exchange_obstacle(source: KernelSource) -> str:
    """Return the reason why a scene supports co-simulation only, or "" if an importer may integrate it too.

    Obstacles: no degrees of freedom, friction elements or rigid contacts with modes, drives whose rate jumps, internal
    states of laws, kinematically determined loops, and a scene without Jacobian.
    """
    if source.degrees_of_freedom == 0:
        return "no degrees of freedom: drives determine the motion"
    if source.frictions or source.rigid_joints:
        names = ", ".join((*source.frictions, *source.rigid_joints))
        return f"{names}: modes that only the time loops of the engine switch"
    if source.rate_jumps:
        return f"impulses where the rate of {', '.join(source.rate_jumps)} jumps"
    if source.internal_states:
        return f"internal states of laws ({', '.join(source.internal_states)})"
    if source.driven_loop_coordinates:
        return "kinematic loops that only drives determine"
    return source.reason_without_jacobian


def list_states(source: KernelSource) -> list[tuple[str, str]]:
    """Return (name, unit) of each state of model exchange: coordinates, their velocities, the works.

    The list is empty for a scene that supports co-simulation only.
    """
    if explain_exchange_obstacle(source):
        return []
    names = source.tree_coordinates if source.formulation == "reduced" else source.coordinates
    angles = find_integrated_angles(source)
    position_states = [
        (f"state.{name}", "rad" if is_angle else "m") for name, is_angle in zip(names, angles, strict=True)
    ]
    position_states += [
        (f"der(state.{name})", "rad/s" if is_angle else "m/s") for name, is_angle in zip(names, angles, strict=True)
    ]
    return position_states + [(f"state.work.{kind}", "J") for kind in WORK_NAMES]


def compute_instantiation_token(source: KernelSource) -> str:
    """Return the instantiation token (FMI 3) that ties the library to its description.

    It is a hash of mechanism, scene and generated C: 32 hexadecimal digits in braces.
    """
    texts = [source.mechanism, source.scene, *(text for item in sorted(source.files.items()) for text in item)]
    return "{" + sha256("\0".join(texts).encode()).hexdigest()[:32] + "}"


def _find_rate_unit(unit: str) -> str:
    """Return the unit of the time derivative of a quantity: "m" → "m/s", "m/s" → "m/s^2", "J" → "W"."""
    return {"J": "W", "m/s": "m/s^2", "rad/s": "rad/s^2"}.get(unit, f"{unit}/s")


def _format_unit_attribute(unit: str) -> str:
    """Return the XML attribute of a unit, "" without one."""
    return f" unit={quoteattr(unit)}" if unit else ""


def _format_unit_elements(names: set[str]) -> list[str]:
    """Return an XML element of each unit, with the exponents of kg, m, s and rad; without a unit "" is left out.

    A unit with fractional exponents has its name only.
    """
    elements = []
    for name in sorted(names - {""}):
        parsed_unit = parse_unit(name)
        dimension = parsed_unit[0].dimension if parsed_unit else DIMENSIONLESS
        exponents = {
            "kg": dimension.mass,
            "m": dimension.length,
            "s": dimension.time,
            "rad": Fraction(name.startswith("rad")),
        }
        base_attributes = "".join(f' {si_unit}="{exponent}"' for si_unit, exponent in exponents.items() if exponent)
        is_integral = all(exponent.denominator == 1 for exponent in exponents.values())
        elements.append(
            f"    <Unit name={quoteattr(name)}>{f'<BaseUnit{base_attributes}/>' if is_integral else ''}</Unit>"
        )
    return elements


def _iterate_variable_elements(source: KernelSource) -> Iterator[str]:
    """Yield the XML element of each variable, with its value reference.

    The order is time, tolerance, parameters, outputs, states with their rates, event indicators.
    """
    yield (
        f'    <Float64 name="time" valueReference="{VR_TIME}" causality="independent" variability="continuous"'
        ' unit="s"/>'
    )
    yield (
        f'    <Float64 name="relative_tolerance" valueReference="{VR_RTOL}" causality="parameter" variability="fixed"'
        f' min="1e-14" max="1.0" start="{RTOL!r}" description="error tolerance of a step in co-simulation, instead of'
        ' the tolerance of the importer; docs/error_control.md of gudgeon defines it"/>'
    )
    for k, address, unit, default in iterate_parameters(source):
        bounds = _format_bound_attributes(source, address)
        yield (
            f'    <Float64 name={quoteattr(address)} valueReference="{VR_PARAMETERS + k}" causality="parameter"'
            f' variability="fixed" start="{float(default)!r}"{_format_unit_attribute(unit)}{bounds}/>'
        )
    for k, (name, unit, _, _, meaning) in enumerate(iterate_outputs(source)):
        yield (
            f'    <Float64 name={quoteattr(name)} valueReference="{VR_OUTPUTS + k}" causality="output"'
            f' variability="continuous" initial="calculated"{_format_unit_attribute(unit)}'
            f" description={quoteattr(meaning)}/>"
        )
    for k, (name, unit) in enumerate(list_states(source)):
        yield _format_local_variable(name, VR_STATES + k, unit)
        yield _format_local_variable(
            f"rate of {name}", VR_RATES + k, _find_rate_unit(unit), f' derivative="{VR_STATES + k}"'
        )
    for k, (name, unit) in enumerate(list_event_indicators(source)):
        yield _format_local_variable(name, VR_INDICATORS + k, unit)


def _format_local_variable(name: str, reference: int, unit: str, attributes: str = "") -> str:
    """Return the element <Float64> (FMI 3) of a local variable: continuous, with initial="calculated".

    `reference`: its value reference; `unit`: "" for none; `attributes`: further XML attributes, with a leading space.
    """
    return (
        f'    <Float64 name={quoteattr(name)} valueReference="{reference}" causality="local" variability="continuous"'
        f' initial="calculated"{attributes}{_format_unit_attribute(unit)}/>'
    )


def find_discontinuous_switches(source: KernelSource) -> list[int]:
    """Return the indices of the switching functions across which an expression may be discontinuous.

    They are those with 0 in the array is_continuous_switch[] of the scene's header. Empty for a scene that supports
    co-simulation only.
    """
    if explain_exchange_obstacle(source):
        return []
    continuity_flags = re.findall(r" is_continuous_switch\[\] = \{(.*?)\}", source.files[HEADER], re.DOTALL)[0].split(
        ","
    )
    return [k for k in range(parse_sizes(source)["N_SWITCHES"]) if int(continuity_flags[k]) == 0]


def list_event_indicators(source: KernelSource) -> list[tuple[str, str]]:
    """Return (name, unit) of each event indicator: penetrations of joints with play, then switching functions.

    The list is empty for a scene that supports co-simulation only.
    """
    if explain_exchange_obstacle(source):
        return []
    switching_functions = [(f"corner {k + 1}", "") for k in range(len(find_discontinuous_switches(source)))]
    return [(f"{joint.name}.indicator", "m") for joint in source.clearances] + switching_functions


def _iterate_structure_elements(source: KernelSource) -> Iterator[str]:
    """Yield the XML elements of the model structure: outputs, derivatives, initial unknowns, event indicators.

    Each has the value reference of a variable. Initial unknowns are the outputs, the states and the derivatives.
    States, derivatives and indicators exist only for scenes with model exchange.
    """
    n_outputs, n_states = len(list(iterate_outputs(source))), len(list_states(source))
    rate_references = range(VR_RATES, VR_RATES + n_states)
    references_by_kind = {
        "Output": range(VR_OUTPUTS, VR_OUTPUTS + n_outputs),
        "ContinuousStateDerivative": rate_references,
    }
    for kind, references in references_by_kind.items():
        yield from (f'    <{kind} valueReference="{reference}"/>' for reference in references)
    for references in (
        references_by_kind["Output"],
        range(VR_STATES, VR_STATES + n_states),
        references_by_kind["ContinuousStateDerivative"],
    ):
        yield from (f'    <InitialUnknown valueReference="{reference}"/>' for reference in references)
    yield from (
        f'    <EventIndicator valueReference="{VR_INDICATORS + k}"/>' for k in range(len(list_event_indicators(source)))
    )


def build_model_description(source: KernelSource, name: str) -> str:
    """Return the text of modelDescription.xml; `name` is the model identifier.

    Model exchange is left out for a scene that supports co-simulation only.
    """
    state_units = {unit for _, unit in list_states(source)}
    units = (
        {unit for _, unit, *_ in iterate_outputs(source)}
        | {unit for _, _, unit, _ in iterate_parameters(source)}
        | {"s"}
    )
    units |= state_units | {_find_rate_unit(unit) for unit in state_units}
    title = quoteattr(source.title or source.mechanism)
    derivative_attribute = ' providesDirectionalDerivatives="true"'
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<fmiModelDescription fmiVersion="3.0" modelName={quoteattr(name)} '
            f'instantiationToken="{compute_instantiation_token(source)}"',
            f'  description={title} generationTool="gudgeon" variableNamingConvention="flat">',
            *(
                [
                    f'  <ModelExchange modelIdentifier="{name}" needsCompletedIntegratorStep="true"',
                    f'    canGetAndSetFMUState="true" canSerializeFMUState="true"{derivative_attribute}/>',
                ]
                if state_units
                else []
            ),
            f'  <CoSimulation modelIdentifier="{name}" canHandleVariableCommunicationStepSize="true"',
            '    canGetAndSetFMUState="true" canSerializeFMUState="true"/>',
            "  <UnitDefinitions>",
            *_format_unit_elements(units),
            "  </UnitDefinitions>",
            f'  <DefaultExperiment startTime="0" tolerance="{RTOL!r}"/>',
            "  <ModelVariables>",
            *_iterate_variable_elements(source),
            "  </ModelVariables>",
            "  <ModelStructure>",
            *_iterate_structure_elements(source),
            "  </ModelStructure>",
            "</fmiModelDescription>",
            "",
        ]
    )


def build_fmu_build_description(name: str) -> str:
    """Return the text of sources/buildDescription.xml, from which an importer compiles the C files.

    It names the compilation units, the language C11, the option -ffp-contract=off and the library m. `name` is the
    model identifier.
    """
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            '<fmiBuildDescription fmiVersion="3.0">',
            f'  <BuildConfiguration modelIdentifier="{name}">',
            '    <SourceFileSet language="C11" compilerOptions="-ffp-contract=off">',
            *(f'      <SourceFile name="{unit}"/>' for unit in UNITS),
            '      <IncludeDirectory name="."/>',
            "    </SourceFileSet>",
            '    <Library name="m" external="true"/>',
            "  </BuildConfiguration>",
            "</fmiBuildDescription>",
            "",
        ]
    )

"""Read run-time parameters: paths such as `joints.A.clearance`, units, and conditions that values must satisfy."""

from __future__ import annotations

import json
import math
import operator
import re
import sys
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import Condition, KernelSource, RuntimeParameter
from gudgeon.errors import BadValueError, UnitError, UnknownNameError
from gudgeon.language.argument_checks import check_mapping, check_not_subnormal, check_number
from gudgeon.language.names import find_near_names
from gudgeon.language.tree import from_json, iterate_names
from gudgeon.model.arrays import FLAG
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.choices import explain_law_choice, explain_named_expression, find_word_index
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.file_expressions import describe_undefined_part, list_possibly_undefined_expressions
from gudgeon.model.sizes import describe_unresolved_clearance, describe_zero_inertia, has_unresolved_clearance

# a number as files have it, in ASCII digits without '_'; float() accepts more
_NUMBER = r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
# the same in a form that files always accept: whole parts begin with one zero at most, exponents are below 400
_MANTISSA, _EXPONENT = r"[0-9]{1,400}\.?[0-9]{0,400}|\.[0-9]{1,400}", r"[eE][-+]?[0-3]?[0-9]{1,2}"
_PLAIN_NUMBER = re.compile(rf"[-+]?(?!0[0-9])(?P<mantissa>{_MANTISSA})(?:{_EXPONENT})?")
# a number and a unit without the space that the file format needs between them
_NUMBER_WITH_UNIT = re.compile(rf"({_NUMBER})\s*(?![eE][-+]?[0-9])([A-Za-zµμ°].*)")
GAINS = ("baumgarte.alpha", "baumgarte.beta")  # Baumgarte's gains, which only rk4 in the full formulation uses
PARAMETER_GROUPS = {"gains": GAINS}  # one name for several parameters
ZERO = "0.0"  # a literal zero of the file, as JSON
MAX_GAIN = 1e150  # 1/s: its square is still a double
# powers of ten from 1 beyond which a value makes others overflow; and how many such values are listed
MAX_DECADES, MAX_REPORTED = 60.0, 3
RELATIONS = {">": operator.gt, ">=": operator.ge, "<": operator.lt, "<=": operator.le}


def read_given_parameters(
    source: KernelSource, parameters: Mapping[str, float | str] | None, mapping_name: str = "parameters"
) -> tuple[Array, Array]:
    """Return values and mask (n_parameters,) from {address or parameter name: float or '0.5 mm'}.

    None is an empty mapping; a pandas Series is accepted. A name of a group (`gains`) sets all its parameters.
    `mapping_name` is its name in messages. Raises UnknownNameError, and BadValueError for a parameter given twice.
    """
    parameters = check_mapping(parameters, mapping_name, "{address or parameter name: a float in SI, or '0.5 mm'}")
    index_by_address, n = source.parameter_indices, len(source.parameters)
    values, mask, spellings = np.zeros(n), np.zeros(n, dtype=bool), dict[int, str]()
    for name, value in parameters.items():
        address = name if name in index_by_address else f"parameters.{name}"
        addresses = (address,) if address in index_by_address else PARAMETER_GROUPS.get(name, ())
        if not addresses or addresses[0] not in index_by_address:
            raise _make_unknown_parameter_error(name, source)
        for address_of_parameter in addresses:
            k = index_by_address[address_of_parameter]
            if k in spellings:
                raise BadValueError(
                    f"{address_of_parameter} is given twice: as {spellings[k]!r} and as {name!r}", hint="give it once"
                )
            values[k], mask[k], spellings[k] = read_parameter_value(value, source.parameters[k]), True, name
    return values, mask


def list_addresses(source: KernelSource) -> list[str]:
    """Return all names of run-time parameters: addresses, short names of parameters, and names of groups."""
    full_addresses = [parameter.address for parameter in source.parameters]
    group_names = [
        name
        for name, members in PARAMETER_GROUPS.items()
        if members[0] in full_addresses and f"parameters.{name}" not in full_addresses
    ]
    return [address.removeprefix("parameters.") for address in full_addresses] + full_addresses + group_names


def explain_address(source: KernelSource, address: str) -> tuple[str, str]:
    """Return (message, hint) that explain why an address of the file cannot be set in a run.

    ("", "") for other addresses. Explained are options of a run, expressions of t or motion, literal zeros,
    eccentricities, materials, results of the motion and laws.
    """
    if (option_explanation := _explain_run_option(address))[0]:
        return option_explanation
    expressions = source.file_expressions
    candidates = (address, *(info.address for info in expressions if info.address.partition(".")[2] == address))
    address = candidates[-1]  # "motor.value" too
    expression = next((info for info in expressions if info.address == address), None)
    if expression is None and address.removeprefix("outputs.") not in source.outputs:
        explanations = (
            explain_named_expression,
            _explain_missing_start_position,
            _explain_single_material,
            _explain_motion_result,
            explain_law_choice,
        )
        return next(
            (message_and_hint for info in explanations if (message_and_hint := info(source, address))[0]), ("", "")
        )
    key = address.rpartition(".")[2]
    if expression is not None and expression.tree == ZERO:
        return _explain_literal_zero(address, key)
    message = f"{address} is a compiled expression of t or motion: it is not a parameter that can be set"
    return message, (
        f"write a number in it as a parameter, parameters: {{phase: … deg}}, {key}: phase + …,"
        " then set phase; overrides= of gudgeon.load compiles another expression"
    )


def _explain_run_option(address: str) -> tuple[str, str]:
    """Return (message, hint) for the address of an option in a scene's `simulate`; ("", "") for others.

    An example is "scenes.dry.simulate.t_end"; arguments of the run replace it.
    """
    section, _, key = address.rpartition(".simulate.")
    if not section.startswith("scenes.") or key not in ("t_end", "output", "step"):
        return "", ""
    message = f"{address} is an option of runs, not a parameter of the mechanism"
    return message, f"set it for the run: --{key.replace('_', '-')} of the command, {key}= of simulate"


def _explain_motion_result(source: KernelSource, address: str) -> tuple[str, str]:
    """Return (message, hint) for the address of a coordinate or velocity, which is a result; ("", "") for others.

    The hint names the drive that determines it, or the start's value, or how to write one.
    """
    body, _, component = address.rpartition(".")
    if body not in (info.name for info in source.bodies) or component not in ("x", "y", "theta", "vx", "vy", "omega"):
        return "", ""
    message = f"{address} is a result of the motion, not a parameter of the file"
    is_velocity = component in ("vx", "vy", "omega")
    parameter_addresses = {parameter.address for parameter in source.parameters}
    is_driven_velocity = is_velocity and source.degrees_of_freedom <= 0
    if (
        driving_text := _describe_driving_parameters(source, body)
        or is_driven_velocity
        and _describe_driving_parameters(source, "")
    ):
        return message, driving_text
    start_addresses = [
        name
        for name in (f"start.{section}.{address}" for section in ("rates", "set", "guess"))
        if name in parameter_addresses
    ]
    unit = {"omega": "rad/s", "theta": "deg"}.get(component, "m/s" if is_velocity else "mm")
    section = "rates" if is_velocity else "set"
    example = f"start: {{{section}: {{{address}: 0 {unit}}}}}, then start.{section}.{address} can be set"
    hint = f"its start is {start_addresses[0]}" if start_addresses else f"write {example}"
    return message, hint


def _describe_driving_parameters(source: KernelSource, body: str) -> str:
    """Return a text on the drives whose points or angles are on a body, and on their parameters; "" if there are none.

    With body "", all drives count. Example: "motor drives crank: its motion is in drives.motor.value, here by omega…".
    """
    sentences = []
    for part in source.parts:
        ends = part.ends[:1] if part.kind in ("angle", "coordinate") else part.ends  # without the reference body
        if part.section != "drives" or body and body not in (end.rpartition(".")[0] for end in ends):
            continue
        address = f"drives.{part.name}.value"
        values = [from_json(json.loads(info.tree)) for info in source.file_expressions if info.address == address]
        parameter_names = dict.fromkeys(
            name.path for tree in values for name in iterate_names(tree) if name.path != "t"
        )
        moved = body or "the linkage, which has no degree of freedom"
        sentences.append(f"{part.name} drives {moved}: its motion is in {address}")
        sentences[-1] += (
            f", here by {', '.join(parameter_names)}: set that"
            if parameter_names
            else ": write a parameter there, and set that"
        )
    return "; ".join(sentences)


def _explain_missing_start_position(source: KernelSource, address: str) -> tuple[str, str]:
    """Return (message, hint) for a start position (start.play.A.e.x, start.play.A.offset) that the file does not give.

    ("", "") for other addresses, and if the file's start gives any value of the joint.
    """
    section, subsection, joint, *component = [*address.split("."), "", "", ""][:4]
    is_slider_by_joint = {clearance.joint: clearance.is_corner for clearance in source.clearances}
    has_start = any(parameter.address.startswith(f"start.play.{joint}.") for parameter in source.parameters)
    if (section, subsection) != ("start", "play") or joint not in is_slider_by_joint or has_start:
        return "", ""
    example = f"start: {{play: {{{joint}: {{{'offset: 0 mm' if is_slider_by_joint[joint] else 'e: [0 mm, 0 mm]'}}}}}}}"
    return f"{address}: the file's start gives no position of {joint}", f"write {example}, then it can be set"


def _explain_single_material(source: KernelSource, address: str) -> tuple[str, str]:
    """Return (message, hint) for the choice of a material, if the file has only one; ("", "") for others."""
    owner, _, key = address.rpartition(".")
    has_parameters = any(parameter.address.startswith(f"{owner}.") for parameter in source.parameters)
    if not (key.endswith("material") and has_parameters):
        return "", ""
    message = (
        f"{address}: the file has only one material with the values that are needed there, so none can be selected"
    )
    return message, "write a second one among its materials; values of materials can be set: materials.<name>.E"


def read_parameter_value(value: float | str, parameter: RuntimeParameter) -> float:
    """Return a value in SI from a float, or a text as in files ('0.5 mm', '1e-9'); of a choice, its index.

    Raises BadValueError for values that are not numbers, UnitError for another dimension, UnknownNameError for an
    unknown word of a choice.
    """
    if parameter.words:
        return find_word_index(value, parameter)
    if type(value) is float and sys.float_info.min <= abs(value) < math.inf:
        return value
    if isinstance(value, str):
        parsed_number = parse_plain_number(value)
        if parsed_number is not None:
            return parsed_number
        from gudgeon.language.quantities import parse_quantity

        try:
            value = parse_quantity(insert_space_before_unit(value), parameter.address, parameter.dimension)
        except UnitError as error:
            if not any(parameter.dimension) and parameter.address.startswith("parameters.") and not error.hint:
                hint = f"the file has no unit for {parameter.address}: write one there, or leave it out here, too"
                raise UnitError(error.message, error.where, hint) from None
            raise
    return check_not_subnormal(check_number(value, parameter.address), parameter.address)


def parse_plain_number(text: str) -> float | None:
    """Return the number that a text without a unit writes; None for other texts, or if it is out of range.

    Spaces around it are ignored.
    """
    match = _PLAIN_NUMBER.fullmatch(text.strip(" "))
    if match is None:
        return None
    value = float(match[0])
    is_in_range = sys.float_info.min <= abs(value) < math.inf or (
        not value and not re.search("[1-9]", match["mantissa"])
    )
    return value if is_in_range else None


def insert_space_before_unit(text: str) -> str:
    """Return the text with a space before the unit of a number ("0.5mm" becomes "0.5 mm"), without spaces around it."""
    match = _NUMBER_WITH_UNIT.fullmatch(text.strip())
    return f"{match[1]} {match[2]}" if match else text.strip()


def compute_parameter_values(
    compiled: CompiledModel, parameters: Mapping[str, float | str] | None
) -> tuple[Array, Array, Array]:
    """Return the checked values p (n_p,) of a run, and given values and their mask (n_parameters,).

    parameters: None for the file's values; see `read_given_parameters`. Raises BadValueError, UnknownNameError.
    """
    given_values, is_given = read_given_parameters(compiled.source, parameters)
    return compute_cached_run_values(compiled, given_values, is_given)[0], given_values, is_given


def compute_cached_run_values(compiled: CompiledModel, given_values: Array, is_given: Array) -> Array:
    """Return the values (2, n_p) of `compute_run_values`: a copy of the result that is cached for equal arguments."""
    return _prepare_run(compiled, given_values, is_given).copy()


def compute_run_values(compiled: CompiledModel, given_values: Array, is_given: NDArray[np.generic]) -> Array:
    """Return the checked values p for given parameters and mask, and those without Baumgarte gains, (2, n_p).

    The second are for methods that project; see `compute_values_without_baumgarte`. Raises BadValueError.
    """
    source, shape = compiled.source, (2, len(given_values))
    pair, masks, values = np.empty(shape), np.empty(shape, FLAG), np.empty((2, compiled.n_p))
    pair[:], masks[:] = given_values, is_given
    for k in find_gain_indices(source):
        pair[1, k], masks[1, k] = 0.0, 1
    compiled.prepare_runs_in_place(pair, masks, values)
    if not has_valid_values(source, values[0], is_given):
        check_parameter_values(source, values[0], is_given)
    return values


_prepare_run = cache_by_values(compute_run_values)  # callers must not change the values


def compute_values_without_baumgarte(
    compiled: CompiledModel, given_values: Array, is_given: NDArray[np.generic]
) -> Array:
    """Return the values p of one or n runs with both Baumgarte gains zero, for methods that project.

    given_values, is_given: (n_parameters,) or (n, n_parameters); they are not changed.
    """
    if given_values.ndim == 2:
        return compiled.prepare_parameters_of_runs(given_values, is_given, find_gain_indices(compiled.source))
    return _prepare_run(compiled, given_values, is_given)[1].copy()


@cache_by_values
def find_gain_indices(source: KernelSource) -> list[int]:
    """Return the indices of the parameters that are Baumgarte gains; the list must not be changed."""
    return [source.parameter_indices[name] for name in GAINS if name in source.parameter_indices]


def has_valid_values(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> bool:
    """Return whether the values p (n_p,) of a run pass `check_parameter_values`, by fast comparisons without texts."""
    lower, upper, relations = collect_conditions(source)
    if b"\0" in ((lower <= p) & (p <= upper)).tobytes():  # quicker than all()
        return False
    for k, terms, is_satisfied in relations:
        if not is_satisfied(p.item(k), sum(map(p.item, terms))):
            return False
    return not (
        has_unresolved_clearance(source, p)
        or list_possibly_undefined_expressions(source)
        and describe_undefined_part(source, p, is_given)
    )


Relation: TypeAlias = tuple[int, list[int], Callable[[Any, Any], Any]]


@cache_by_values
def collect_conditions(source: KernelSource) -> tuple[Array, Array, list[Relation]]:
    """Return the conditions of the file as limits (n_p,), both included, and relations to sums of parameters.

    Each relation is (index, indices of the terms of its bound, operator). Values without a condition are finite.
    """
    n_p, relations = len(source.parameters) + len(source.derived), list[Relation]()
    lower, upper = np.full(n_p, -sys.float_info.max), np.full(n_p, sys.float_info.max)
    for condition in list_conditions(source):
        k, relation = source.parameter_indices[condition.address], condition.relation
        if condition.addresses:
            relations.append((k, [source.parameter_indices[term] for term in condition.addresses], RELATIONS[relation]))
            continue
        bound = float(condition.bound)
        if relation in (">", ">="):
            lower[k] = max(lower[k], np.nextafter(bound, np.inf) if relation == ">" else bound)
        else:
            upper[k] = min(upper[k], np.nextafter(bound, -np.inf) if relation == "<" else bound)
    return lower, upper, relations


def check_parameter_values(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> None:
    """Raise BadValueError if the values p of a run violate a condition or are not finite.

    Conditions are tested first, then parameters, derived values, undefined expressions and clearances. `is_given`: mask
    of the given parameters, whose expressions in the file are not used.
    """
    value_by_address = {parameter.address: float(p[k]) for k, parameter in enumerate(source.parameters)}
    for condition in list_conditions(source):  # first: lengths that form no triangle give a point of NaN
        bound = (
            sum(value_by_address[address] for address in condition.addresses)
            if condition.addresses
            else float(condition.bound)
        )
        is_known = math.isfinite(value_by_address[condition.address]) and math.isfinite(bound)
        if is_known and not RELATIONS[condition.relation](value_by_address[condition.address], bound):
            unit = next(parameter.unit for parameter in source.parameters if parameter.address == condition.address)
            raise BadValueError(
                f"{condition.address} is {_format_value(value_by_address[condition.address], unit)}"
                f"{_format_changed_parameters(source, condition, value_by_address)}: {condition.message}"
                + (f" ({condition.bound} is {_format_value(bound, unit)})" if isinstance(condition.bound, str) else "")
                + f"; expected {format_conditions(source, condition.address)}"
            )
    for parameter in source.parameters:
        if not math.isfinite(value_by_address[parameter.address]):
            raise BadValueError(
                f"{parameter.address} is {value_by_address[parameter.address]}: not finite with these parameters"
            )
    for k, derived_value in enumerate(p[len(source.parameters) :].tolist()):
        if not math.isfinite(derived_value):
            raise BadValueError(
                describe_zero_inertia(value_by_address, source.derived[k])
                or _format_overflow_message(source, value_by_address, k, derived_value)
            )
    if message := describe_undefined_part(source, p, is_given) or describe_unresolved_clearance(source, p):
        raise BadValueError(message)


def _format_overflow_message(
    source: KernelSource, value_by_address: Mapping[str, float], derived_index: int, derived_value: float
) -> str:
    """Return a message on a derived value that overflows, with the parameters that cause it.

    value_by_address: parameters; derived_index: index in source.derived; derived_value: infinite or NaN.
    """
    index, name = len(source.parameters) + derived_index, source.derived[derived_index]
    constant_names = (
        f"{joint.name}.{constant_name}"
        for joint in source.clearances
        for constant_name, constant_index in joint.constants.items()
        if constant_index == index
    )
    extreme_parameters = [
        parameter
        for parameter in source.parameters
        if not parameter.words and abs(math.log10(abs(value_by_address[parameter.address]) or 1.0)) > MAX_DECADES
    ]
    message = ", ".join(
        f"{parameter.address} is {value_by_address[parameter.address]:g} {parameter.unit}".rstrip()
        for parameter in extreme_parameters[:MAX_REPORTED]
    )
    subject = f"{next(constant_names, f'{name} of the equations')}, which follows"
    sentence = (
        f"{message}, too far from 1 for doubles: {subject} from that," if message else f"{subject} from these values,"
    )
    return f"{sentence} is {derived_value}"


@cache_by_values
def list_conditions(source: KernelSource) -> tuple[Condition, ...]:
    """Return the conditions of the file, those of Baumgarte's gains, and those of velocity floors.

    A velocity floor must be positive, also where the file has no condition for it.
    """
    addresses = [parameter.address for parameter in source.parameters]
    gains = [address for address in addresses if address.startswith("baumgarte.")]
    gain_limits = ((">=", 0.0, "a negative gain increases drift"), ("<=", MAX_GAIN, "its square overflows"))
    floor_addresses = {address for address in addresses if address.endswith(".velocity_floor")}
    unconditioned_floors = sorted(floor_addresses - {condition.address for condition in source.conditions})
    floor_limit = (">", 0.0, "the least impact velocity is positive")
    return (
        *source.conditions,
        *(Condition(gain, *limit) for gain in gains for limit in gain_limits),
        *(Condition(floor, *floor_limit) for floor in unconditioned_floors),
    )


def _format_value(value: float, unit: str) -> str:
    """Return a number in SI with six digits and its unit."""
    return f"{value:.6g} {unit}".strip()


def _format_changed_parameters(
    source: KernelSource, condition: Condition, value_by_address: Mapping[str, float]
) -> str:
    """Return the changed parameters that a value follows: " with c = 0.008 m"; "" if it follows none.

    value_by_address: parameters in SI. Changed are those that differ from the file's values.
    """
    if not any(parameter.address == condition.address and parameter.follows for parameter in source.parameters):
        return ""
    changed = [
        f"{parameter.address.removeprefix('parameters.')} = {_format_value(value, parameter.unit)}"
        for parameter in source.parameters
        if parameter.address.startswith("parameters.")
        and (value := value_by_address[parameter.address]) != parameter.default
    ]
    return f" with {', '.join(changed)}" if changed else ""


def format_conditions(source: KernelSource, address: str) -> str:
    """Return the conditions on a parameter as text: "> 0 and <= 1"; "" if there are none."""
    relations_and_bounds = [
        (condition.relation, condition.bound) for condition in list_conditions(source) if condition.address == address
    ]
    return " and ".join(
        f"{relation} {bound if isinstance(bound, str) else f'{bound:g}'}" for relation, bound in relations_and_bounds
    )


def _explain_literal_zero(address: str, key: str) -> tuple[str, str]:
    """Return (message, hint) for the address of a literal 0, which is not part of the equations.

    `key` is its last part.
    """
    message = f"{address} is 0 in the file or left out, and in no equation: it is not a parameter that can be set"
    hint = f"write a parameter there (parameters: {{own: 0 …}} with its unit, {key}: own) and set that"
    return message, f"{hint}; or write a number other than 0 there, which can be set, also to 0"


def _make_unknown_parameter_error(name: str, source: KernelSource) -> UnknownNameError:
    """Return the error for an address that is not a run-time parameter, with the best hint.

    The hint explains why it cannot be set, or names similar addresses.
    """
    message, hint = explain_address(source, name)
    if message:
        return UnknownNameError(message, None, hint)
    section, _, coordinate = name.partition(".")[2].partition(".")
    if section in ("guess", "set", "rates") and name.startswith("start.") and coordinate.count(".") == 1:
        hint = f"expected a coordinate in the file's start; gudgeon.load(..., overrides={{{name!r}: ...}}) adds it"
        return UnknownNameError(f"start.{section} of the file does not have {coordinate}", None, hint)
    similar_addresses = find_near_names(name, list_addresses(source))
    hint = (
        f"did you mean {', '.join(similar_addresses)}?"
        if similar_addresses
        else "see run.parameters for all addresses."
    )
    hint += " Structural choices go to gudgeon.load(..., overrides={...})."
    return UnknownNameError(f"no run-time number has the address {name!r} in this scene", None, hint)


def parse_typed_number(text: str) -> float | str:
    """Parse a typed number: return a float in SI, or a text with a space before its unit ("0.5 mm" for "0.5mm")."""
    number = parse_plain_number(text)
    return insert_space_before_unit(text) if number is None else number

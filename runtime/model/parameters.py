"""Read run-time parameters: addresses, units, and the conditions that every value must satisfy."""

from __future__ import annotations

import json
import math
import operator
import re
import sys
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import Condition, KernelSource, Slot
from gudgeon.errors import BadValueError, UnitError, UnknownNameError
from gudgeon.language.argument_checks import mapping, number_of, whole_digits
from gudgeon.language.names import near
from gudgeon.language.tree import from_json, names
from gudgeon.model.choices import explain_law_choice, explain_named_expression, index_of_word
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import unresolved_clearance_message, zero_inertia_message
from gudgeon.model.written import undefined_number

# a number as files have it, in ASCII digits without '_'; float() accepts more
_NUMBER = r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
# such a number where a file is sure to take it: whole parts begin with one zero at most, exponents are below 400
_MANTISSA, _EXPONENT = r"[0-9]{1,400}\.?[0-9]{0,400}|\.[0-9]{1,400}", r"[eE][-+]?[0-3]?[0-9]{1,2}"
_PLAIN = re.compile(rf"[-+]?(?!0[0-9])(?P<mantissa>{_MANTISSA})(?:{_EXPONENT})?")
# a number and a unit without the space that the file format wants between them: nothing else can be meant
_GLUED = re.compile(rf"({_NUMBER})\s*(?![eE][-+]?[0-9])([A-Za-zµμ°].*)")
GAINS = ("baumgarte.alpha", "baumgarte.beta")  # Baumgarte's gains, which only rk4 in the full formulation uses
TOGETHER = {"gains": GAINS}  # one name for several parameters
ZERO = "0.0"  # a literal zero of the file, as JSON
MOST_GAIN = 1e150  # 1/s: its square is still a double
# powers of ten from 1 beyond which a value makes others overflow; and how many such values are listed
FAR, MAX_REPORTED = 60.0, 3
RELATIONS = {">": operator.gt, ">=": operator.ge, "<": operator.lt, "<=": operator.le}


def given_slots(
    source: KernelSource, parameters: Mapping[str, float | str] | None, what: str = "parameters"
) -> tuple[Array, Array]:
    """Return values and mask (n_slots,) from {address or parameter name: float or '0.5 mm'}.

    None is an empty mapping; a pandas Series is accepted. `what` names the mapping in messages. Raises
    UnknownNameError, and BadValueError for a parameter given twice, by two spellings of its address.
    """
    parameters = mapping(parameters, what, "{address or parameter name: a float in SI, or '0.5 mm'}")
    place = source.place
    values, mask, spelled = np.zeros(len(place)), np.zeros(len(place), dtype=bool), dict[int, str]()
    for name, value in parameters.items():
        address = name if name in place else f"parameters.{name}"
        several = TOGETHER.get(name, ()) if address not in place else (address,)
        if not several or several[0] not in place:
            raise _unknown_parameter(name, source)
        for own in several:
            k = place[own]
            if k in spelled:
                raise BadValueError(f"{own} is given twice: as {spelled[k]!r} and as {name!r}", hint="give it once")
            values[k], mask[k], spelled[k] = number(value, source.slots[k]), True, name
    return values, mask


def addresses(source: KernelSource) -> list[str]:
    """Return all names of run-time parameters: addresses, short names of parameters, and names of groups."""
    found = [slot.address for slot in source.slots]
    together = [name for name, several in TOGETHER.items() if several[0] in found and f"parameters.{name}" not in found]
    return [address.removeprefix("parameters.") for address in found] + found + together


def as_parameter(source: KernelSource, address: str) -> tuple[str, str]:
    """Return message and hint for an address with an expression of t or motion, or a 0; "" for others."""
    if (found := _explain_run_option(address))[0]:
        return found
    meant = (address, *(one.address for one in source.written if one.address.partition(".")[2] == address))
    address = meant[-1]  # "motor.value" too
    written = next((one for one in source.written if one.address == address), None)
    if written is None and address.removeprefix("outputs.") not in source.outputs:
        several = (
            explain_named_expression,
            _explain_eccentricity,
            _explain_material,
            _explain_motion,
            explain_law_choice,
        )
        return next((words for one in several if (words := one(source, address))[0]), ("", ""))
    key = address.rpartition(".")[2]
    if written is not None and written.tree == ZERO:
        return _explain_zero(address, key)
    message = f"{address} is an expression of t or motion, compiled as it stands: it is no number that can be set"
    return message, (
        f"a number in it can be, once it is a parameter: parameters: {{phase: … deg}}, {key}: phase + …,"
        " then set phase; overrides= of gudgeon.load compiles anew with another expression"
    )


def _explain_run_option(address: str) -> tuple[str, str]:
    """Return message and hint for the address of a scene's `simulate`, which options of the run set; else ""."""
    section, _, key = address.rpartition(".simulate.")
    if not section.startswith("scenes.") or key not in ("t_end", "output", "step"):
        return "", ""
    message = f"{address} is how a run goes unless it is told otherwise, and no number of the mechanism"
    return message, f"tell the run: --{key.replace('_', '-')} of the command, {key}= of simulate"


def _explain_motion(source: KernelSource, address: str) -> tuple[str, str]:
    """Return message and hint for the address of a coordinate or velocity, which is a result; else ""."""
    body, _, part = address.rpartition(".")
    if body not in (one.name for one in source.bodies) or part not in ("x", "y", "theta", "vx", "vy", "omega"):
        return "", ""
    message = f"{address} is a result of the motion, and no number of the file"
    rate, own = part in ("vx", "vy", "omega"), {slot.address for slot in source.slots}
    held = rate and source.degrees_of_freedom <= 0
    if by := _driving_parameters(source, body) or held and _driving_parameters(source, ""):
        return message, by
    specified = [
        name for name in (f"start.{section}.{address}" for section in ("rates", "set", "guess")) if name in own
    ]
    unit = {"omega": "rad/s", "theta": "deg"}.get(part, "m/s" if rate else "mm")
    section = "rates" if rate else "set"
    expected = f"start: {{{section}: {{{address}: 0 {unit}}}}}, then start.{section}.{address} can be set"
    hint = f"its start is {specified[0]}" if specified else f"write {expected}"
    return message, hint


def _driving_parameters(source: KernelSource, body: str) -> str:
    """Return a text on the drives that determine how a body moves ("": any body), and their parameters; else ""."""
    message = []
    for part in source.parts:
        ends = part.ends[:1] if part.kind in ("angle", "coordinate") else part.ends  # then a reference, which it leaves
        if part.section != "drives" or body and body not in (end.rpartition(".")[0] for end in ends):
            continue
        address = f"drives.{part.name}.value"
        values = [from_json(json.loads(one.tree)) for one in source.written if one.address == address]
        by = dict.fromkeys(name.path for tree in values for name in names(tree) if name.path != "t")
        moves = body or "the linkage, which has no freedom left"
        message.append(f"{part.name} drives {moves}: how it moves is in {address}")
        message[-1] += f", here by {', '.join(by)}: set that" if by else ": write a parameter there, and set that"
    return "; ".join(message)


def _explain_eccentricity(source: KernelSource, address: str) -> tuple[str, str]:
    """Return message and hint for an eccentricity at the start that the file does not give; else ""."""
    start, play, joint, *part = [*address.split("."), "", "", ""][:4]
    able = {clearance.joint: clearance.at_wall for clearance in source.clearances}
    placed = any(slot.address.startswith(f"start.play.{joint}.") for slot in source.slots)
    if (start, play) != ("start", "play") or joint not in able or placed:
        return "", ""
    expected = f"start: {{play: {{{joint}: {{{'offset: 0 mm' if able[joint] else 'e: [0 mm, 0 mm]'}}}}}}}"
    return f"{address}: the file's start does not say where {joint} begins", f"write {expected}, then it can be set"


def _explain_material(source: KernelSource, address: str) -> tuple[str, str]:
    """Return message and hint for the choice of a material, if the file has only one; else ""."""
    owner, _, key = address.rpartition(".")
    if not key.endswith("material") or not any(slot.address.startswith(f"{owner}.") for slot in source.slots):
        return "", ""
    message = (
        f"{address}: the file has only one material with the numbers that are wanted there, and no other to choose"
    )
    return message, "write a second one among its materials; their numbers can be set, materials.<name>.E"


def number(value: float | str, slot: Slot) -> float:
    """Return a value in SI from a float, or a text as in files ('0.5 mm', '1e-9'); of a choice, its index."""
    if slot.words:
        return index_of_word(value, slot)
    if type(value) is float and sys.float_info.min <= abs(value) < math.inf:
        return value
    if isinstance(value, str):
        found = plain_number(value)
        if found is not None:
            return found
        from gudgeon.language.quantities import number_of_text

        try:
            value = number_of_text(spaced(value), slot.address, slot.dimension)
        except UnitError as error:
            if not any(slot.dimension) and slot.address.startswith("parameters.") and not error.hint:
                hint = f"the file has no unit for {slot.address}: write one there, or leave it out here, too"
                raise UnitError(error.message, error.where, hint) from None
            raise
    return whole_digits(number_of(value, slot.address), slot.address)


def plain_number(text: str) -> float | None:
    """Return the number that a text without a unit writes; None for other texts, or if it is out of range."""
    found = _PLAIN.fullmatch(text.strip(" "))
    if found is None:
        return None
    value = float(found[0])
    whole = sys.float_info.min <= abs(value) < math.inf or (not value and not re.search("[1-9]", found["mantissa"]))
    return value if whole else None


def spaced(text: str) -> str:
    """Return the text with a space before the unit of a number: "0.5mm" becomes "0.5 mm"."""
    glued = _GLUED.fullmatch(text.strip())
    return f"{glued[1]} {glued[2]}" if glued else text.strip()


def prepare(compiled: CompiledModel, parameters: Mapping[str, float | str] | None) -> tuple[Array, Array, Array]:
    """Return (p, given, is_given), checked: see CompiledModel.prepare. Raise BadValueError, UnknownNameError."""
    given, is_given = given_slots(compiled.source, parameters)
    return prepare_slots(compiled, given, is_given), given, is_given


def prepare_slots(compiled: CompiledModel, given: Array, is_given: Array) -> Array:
    """Return the checked values p of given parameters and mask. Raise BadValueError."""
    check(compiled.source, p := compiled.prepare(given, is_given), is_given)
    return p


def without_baumgarte(compiled: CompiledModel, given: Array, is_given: NDArray[np.generic]) -> Array:
    """Return the values p of one or n runs with both Baumgarte gains zero, for methods that project."""
    place = compiled.source.place
    gains = [place[name] for name in GAINS if name in place]
    if given.ndim == 2:
        return compiled.prepare_each(given, is_given, gains)
    values, mask = given.copy(), is_given.copy()
    values[gains], mask[gains] = 0.0, True
    return compiled.prepare(values, mask)


def check(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> None:
    """Raise BadValueError if the values p of a run violate a condition or are not finite.

    `is_given`: parameters that are given, so that they do not follow others.
    """
    value = {slot.address: float(p[k]) for k, slot in enumerate(source.slots)}
    for condition in conditions(source):  # first: sides that make no triangle leave a point that is NaN
        bound = sum(value[a] for a in condition.addresses) if condition.addresses else float(condition.bound)
        known = math.isfinite(value[condition.address]) and math.isfinite(bound)
        if known and not RELATIONS[condition.relation](value[condition.address], bound):
            unit = next(slot.unit for slot in source.slots if slot.address == condition.address)
            raise BadValueError(
                f"{condition.address} is {_format_value(value[condition.address], unit)}"
                f"{_changed_parameters(source, condition, value)}: {condition.message}"
                + (f" ({condition.bound} is {_format_value(bound, unit)})" if isinstance(condition.bound, str) else "")
                + f"; expected {expected(source, condition.address)}"
            )
    for slot in source.slots:
        if not math.isfinite(value[slot.address]):
            raise BadValueError(f"{slot.address} is {value[slot.address]}: not finite with these parameters")
    for k, number in enumerate(p[len(source.slots) :].tolist()):
        if not math.isfinite(number):
            raise BadValueError(
                zero_inertia_message(value, source.derived[k]) or _overflow_message(source, value, k, number)
            )
    if message := undefined_number(source, p, is_given) or unresolved_clearance_message(source, p):
        raise BadValueError(message)


def _overflow_message(source: KernelSource, value: Mapping[str, float], k: int, number: float) -> str:
    """Return a message on derived value k that overflows, with the parameters that cause it."""
    place, name = len(source.slots) + k, source.derived[k]
    own = (f"{joint.name}.{one}" for joint in source.clearances for one, at in joint.constants.items() if at == place)
    far = [slot for slot in source.slots if not slot.words and abs(math.log10(abs(value[slot.address]) or 1.0)) > FAR]
    message = ", ".join(
        f"{slot.address} is {value[slot.address]:g} {slot.unit}".rstrip() for slot in far[:MAX_REPORTED]
    )
    whose = f"{next(own, f'{name} of the equations')}, which follows"
    blamed = f"{message}, too far from 1 for doubles: {whose} from that," if message else f"{whose} from these values,"
    return f"{blamed} is {number}"


def conditions(source: KernelSource) -> tuple[Condition, ...]:
    """Return the conditions of the file, those of Baumgarte's gains, and those of velocity floors."""
    gains = [slot.address for slot in source.slots if slot.address.startswith("baumgarte.")]
    requested = ((">=", 0.0, "a negative gain drives rows apart"), ("<=", MOST_GAIN, "its square is no number"))
    floors = {slot.address for slot in source.slots if slot.address.endswith(".velocity_floor")}
    left = sorted(floors - {condition.address for condition in source.conditions})
    least = (Condition(floor, ">", 0.0, "the least impact velocity is positive") for floor in left)
    return (*source.conditions, *(Condition(gain, *one) for gain in gains for one in requested), *least)


def _format_value(value: float, unit: str) -> str:
    """Return a number in SI with its unit."""
    return f"{value:.6g} {unit}".strip()


def _changed_parameters(source: KernelSource, condition: Condition, value: Mapping[str, float]) -> str:
    """Return the changed parameters that a value follows: " with c = 0.008 m"; "" if it follows none."""
    if not any(slot.address == condition.address and slot.follows for slot in source.slots):
        return ""
    changed = [
        f"{slot.address.removeprefix('parameters.')} = {_format_value(value[slot.address], slot.unit)}"
        for slot in source.slots
        if slot.address.startswith("parameters.") and value[slot.address] != slot.default
    ]
    return f" with {', '.join(changed)}" if changed else ""


def expected(source: KernelSource, address: str) -> str:
    """Return the conditions on a parameter as text: "> 0 and <= 1"."""
    requested = [(c.relation, c.bound) for c in conditions(source) if c.address == address]
    return " and ".join(f"{one} {bound if isinstance(bound, str) else f'{bound:g}'}" for one, bound in requested)


def _explain_zero(address: str, key: str) -> tuple[str, str]:
    """Return message and hint for the address of a literal 0, which is not part of the equations."""
    message = f"{address} is 0, written so or left out, and stands in no equation: it is no number that can be set"
    hint = f"write a parameter there (parameters: {{own: 0 …}} with its unit, {key}: own) and set that"
    return message, f"{hint}; or write another number than 0 there, which can be set, to 0 too"


def _unknown_parameter(name: str, source: KernelSource) -> UnknownNameError:
    """Return the error for an address that is not a run-time parameter, with the best hint."""
    message, hint = as_parameter(source, name)
    if message:
        return UnknownNameError(message, None, hint)
    start, _, coordinate = name.partition(".")[2].partition(".")
    if start in ("guess", "set", "rates") and name.startswith("start.") and coordinate.count(".") == 1:
        hint = f"expected one that the file's start has; gudgeon.load(..., overrides={{{name!r}: ...}}) brings it in"
        return UnknownNameError(f"start.{start} of the file does not have {coordinate}", None, hint)
    found = near(name, addresses(source))
    hint = f"did you mean {', '.join(found)}?" if found else "see run.parameters for all addresses."
    hint += " Structural choices go to gudgeon.load(..., overrides={...})."
    return UnknownNameError(f"no run-time number has the address {name!r} in this scene", None, hint)


def value(text: str) -> float | str:
    """Return a typed number: a float in SI, or text with a space before its unit ("0.5 mm" for "0.5mm")."""
    number = plain_number(text)
    return spaced(text) if number is None else number

"""Checks that every number is finite and within its bounds, with the file's parameters and with those of each scene."""

from __future__ import annotations

import math
import sys
from collections.abc import Container, Iterable, Mapping, Sequence

from gudgeon.errors import BadValueError, InputError, Location
from gudgeon.generator.field import RELATIONS
from gudgeon.generator.mechanism import Condition, Quantity, SceneSpec
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.parameters import parameter_values
from gudgeon.language.defined import find_undefined_part
from gudgeon.language.tree import Binary, Call, Expr, Name, Number, Unary, calls, evaluate, names
from gudgeon.language.units import si_unit

EXPRESSIONS = "expressions."  # how the addresses of expressions by name begin
FINITE = (
    "expected finite numbers: is there a division by zero, a root of a negative number, or a curve beyond its ends?"
)
MASSLESS = (
    ", for the equations divide by it; a massless rod with a load is one body: the load's mass, com: where the load is,"
    " inertia: 0"
)


def check_values(reader: Reader, parameters: Mapping[str, Quantity], scenes: Mapping[str, SceneSpec]) -> None:
    """Collect a BadValueError at the location of each number that is not finite or violates a condition."""
    wrong = _check_with(reader, parameters, None)
    for scene in scenes.values():
        if scene.parameters:
            _check_with(reader, parameters, scene, wrong)
    lasts = dict.fromkeys(
        call.arguments[2] for quantity in reader.quantities.values() for call in _ramp_calls(quantity)
    )
    for name in {lasting.path for lasting in lasts if isinstance(lasting, Name)}.intersection(parameters):
        reader.require(
            parameters[name], ">", 0.0, "a ramp or smooth_step takes that long"
        )  # also for run-time overrides


def _check_with(
    reader: Reader, parameters: Mapping[str, Quantity], scene: SceneSpec | None, before: Container[str] = ()
) -> Container[str]:
    """Check all numbers with the file's parameters or a scene's, and return the addresses of the wrong ones.

    Numbers in `before`, and numbers that follow from an unreadable one, are not reported again.
    """
    own = scene.parameters if scene else {}
    context = f" in scene {scene.name}" if scene else ""
    try:
        known = parameter_values({**parameters, **own})
    except InputError:
        return ()  # a cycle, reported already
    unread = _find_unreadable(reader, {**parameters, **own}, known) if reader.errors else ()
    values = _evaluate_all(reader, known)
    errors: dict[str, list[tuple[str, str]]] = {}

    def record(address: str, message: str, hint: str) -> None:
        """Record an error for the number at `address`."""
        if address not in before:
            errors.setdefault(address, []).append((message, hint))

    for address, value in values.items():
        if not math.isfinite(value) and address not in unread:
            record(address, f"is {value}{context}", FINITE)
        elif address in reader.wholes and math.isfinite(value) and value != math.floor(value):
            record(address, f"is {value:.6g}{context}", f"expected a whole {reader.wholes[address]}")
    for address, quantity in reader.quantities.items():
        if address in unread or quantity.of or isinstance(quantity.value, Number):
            continue
        if ".parameters." not in address or address in values:
            message, hint = _find_invalid_part(quantity, known, not math.isfinite(values.get(address, 0.0)))
            if message:
                record(address, f"{message}{context}", hint)
    for condition in reader.conditions:
        violation = _violation(condition, values)
        if violation:
            unit = si_unit(reader.quantities[condition.address].dimension)
            found, hint = violation
            message = f"is {found} {unit}".rstrip() + f"{context}: {condition.message}"
            is_massless = condition.address.endswith(".mass") and values[condition.address] == 0.0
            record(condition.address, message, f"{hint} {unit}".rstrip() + MASSLESS * is_massless)
    for vector in reader.vectors_not_zero:
        if all(values.get(component.address) == 0.0 for component in vector):
            record(vector[0].address, f"and .y are both 0{context}", "expected a direction, such as [1, 0]")
    _report(reader, errors, own)
    return errors.keys()


def _find_unreadable(reader: Reader, parameters: Mapping[str, Quantity], order: Iterable[str]) -> set[str]:
    """Return parameters and addresses of numbers that could not be read, or that depend on such a number."""
    unread: set[str] = set()
    for path, quantity in (*((name, parameters[name]) for name in order), *reader.quantities.items()):
        is_broken = isinstance(quantity.value, Number) and math.isnan(quantity.value.value)
        if is_broken or any(name.path in unread for name in names(quantity.value)):
            unread.add(path)
    return unread


def _report(reader: Reader, wrong: Mapping[str, Sequence[tuple[str, str]]], own: Mapping[str, Quantity]) -> None:
    """Collect the errors (message, hint) by address, except those of numbers that are wrong because another one is."""
    for address, messages in wrong.items():
        quantity = reader.quantities[address]
        if not _follows_from_error(reader, quantity, wrong):
            place, users = _location_of_cause(quantity, own), _describe_users(reader, address)
            reader.errors += [BadValueError(f"{address} {message}{users}", place, hint) for message, hint in messages]


def _follows_from_error(reader: Reader, quantity: Quantity, wrong: Container[str]) -> bool:
    """Return whether a number is wrong because another number, or a named expression that it contains, is wrong."""
    return any(part.address in wrong or _follows_from_error(reader, part, wrong) for part in quantity.of) or any(
        f"{EXPRESSIONS}{name}" in wrong for name in reader.made_of.get(quantity.address, ())
    )


def _describe_users(reader: Reader, address: str) -> str:
    """Return a phrase that names the users of a named expression; "" for the address of another number."""
    name = address.removeprefix(EXPRESSIONS)
    users = [user for user, names in reader.made_of.items() if name in names and not user.startswith(EXPRESSIONS)]
    if name == address or not users:
        return ""
    return f", and {users[0]} and {len(users) - 1} more use it" if len(users) > 1 else f", and {users[0]} uses it"


def _find_invalid_part(quantity: Quantity, known: Mapping[str, float], is_wrong: bool) -> tuple[str, str]:
    """Return (message, hint) about a part of an expression that cannot be intended; ("", "") if there is none.

    Examples are an underflow or a negative duration. Nothing is returned if the whole value is already wrong.
    """
    wrong = None if is_wrong else find_undefined_part(quantity.value, known)
    if wrong is not None:
        return f"has a part that is {wrong}", FINITE
    if (small := _find_underflow(quantity.value, known)) is not None:
        hint = "expected products and powers from 2.3e-308: (0.01*x)**161, not 0.01**161 * x**161"
        return f"has a part that is {small:g}, too small for its digits", hint
    for call in _ramp_calls(quantity):
        duration = call.arguments[2]
        if all(name.path in known for name in names(duration)):
            lasts = float(evaluate(duration, known.__getitem__))
            if lasts < 0.0:
                message = f"has a {call.function} that lasts {lasts:.6g}: it would end before it begins"
                return message, f"expected {call.function}(t, start, duration), its duration above zero"
    return "", ""


def _ramp_calls(quantity: Quantity) -> list[Call]:
    """Return the calls of ramp and smooth_step in an expression."""
    return [call for function in ("ramp", "smooth_step") for call in calls(quantity.value, function)]


def _find_underflow(expr: Expr, known: Mapping[str, float]) -> float | None:
    """Return the first factor of an expression that underflows in binary64, None if there is none.

    Products of numbers, and powers in products, are tested.
    """
    match expr:
        case Unary(operand=operand):
            return _find_underflow(operand, known)
        case Call(arguments=inner):
            pass
        case Binary(operator=operator, left=left, right=right):
            inner = (left, right)
            for part in (expr, left, right) if operator in ("*", "/") else ():
                if (value := _underflowing_value(part, known)) is not None:
                    return value
        case _:
            return None
    return next((value for part in inner if (value := _find_underflow(part, known)) is not None), None)


def _underflowing_value(part: Expr, known: Mapping[str, float]) -> float | None:
    """Return the value of a product, quotient or power of nonzero numbers if it underflows, else None."""
    if not isinstance(part, Binary) or part.operator in ("+", "-") or any(n.path not in known for n in names(part)):
        return None
    value, left, right = (float(evaluate(x, known.__getitem__)) for x in (part, part.left, part.right))
    return value if abs(value) < sys.float_info.min and all(math.isfinite(x) and x for x in (left, right)) else None


def _evaluate_all(reader: Reader, known: dict[str, float]) -> dict[str, float]:
    """Return all numbers (SI) that parameters alone determine, by address; `known` gets those that others follow."""
    for part in (part for quantity in reader.quantities.values() for part in quantity.of):
        known[part.address] = float(evaluate(part.value, known.__getitem__))  # in their order: parts come first
    return {
        address: float(evaluate(quantity.value, known.__getitem__))
        for address, quantity in reader.quantities.items()
        if not (address.startswith("scenes.") and ".parameters." in address)  # they are parameters of their scene
        and all(name.path in known for name in names(quantity.value))  # neither t nor a result
    }


def _location_of_cause(quantity: Quantity, own: Mapping[str, Quantity]) -> Location:
    """Return where a wrong value comes from: the scene's parameter if the number uses one, else the number itself."""
    return next((own[name.path].where for name in names(quantity.value) if name.path in own), quantity.where)


def _violation(condition: Condition, values: Mapping[str, float]) -> tuple[str, str] | None:
    """Return the value and the expected bound as texts if a condition is violated, else None; also None for NaN."""
    value = values.get(condition.address, math.nan)
    bound = condition.bound
    if isinstance(bound, str):
        bound = sum(values.get(address, math.nan) for address in bound.split(" + "))
    if math.isnan(value) or math.isnan(bound) or RELATIONS[condition.relation](value, bound):
        return None
    limit = f"{condition.bound} = {bound:.6g}" if isinstance(condition.bound, str) else f"{bound:.6g}"
    return f"{value:.6g}", f"expected {condition.relation} {limit}"

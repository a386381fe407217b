"""Every number is finite and within its bounds: with the file's parameters, and with every scene's."""

from __future__ import annotations

import math
import sys
from collections.abc import Container, Iterable, Mapping, Sequence

from gudgeon.errors import BadValueError, InputError, Location
from gudgeon.generator.field import RELATIONS
from gudgeon.generator.mechanism import Condition, Quantity, SceneSpec
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.parameters import parameter_values
from gudgeon.language.defined import undefined_part
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
    """Collect a BadValueError at the place of each number that is not finite or breaks a condition."""
    wrong = _check_with(reader, parameters, None)
    for scene in scenes.values():
        if scene.parameters:
            _check_with(reader, parameters, scene, wrong)
    lasts = dict.fromkeys(call.arguments[2] for quantity in reader.quantities.values() for call in _steps(quantity))
    for name in {lasting.path for lasting in lasts if isinstance(lasting, Name)}.intersection(parameters):
        reader.require(parameters[name], ">", 0.0, "a ramp or smooth_step takes that long")  # of numbers given later


def _check_with(
    reader: Reader, parameters: Mapping[str, Quantity], scene: SceneSpec | None, before: Container[str] = ()
) -> Container[str]:
    """Check all numbers with the file's parameters, or with a scene's, and return the addresses of wrong ones.

    Nothing is told of numbers that were wrong before, or that follow one that could not be read.
    """
    own = scene.parameters if scene else {}
    context = f" in scene {scene.name}" if scene else ""
    try:
        known = parameter_values({**parameters, **own})
    except InputError:
        return ()  # a cycle, told already
    unread = _unread(reader, {**parameters, **own}, known) if reader.errors else ()
    values = _values(reader, known)
    told: dict[str, list[tuple[str, str]]] = {}

    def complain(address: str, message: str, hint: str) -> None:
        if address not in before:
            told.setdefault(address, []).append((message, hint))

    for address, value in values.items():
        if not math.isfinite(value) and address not in unread:
            complain(address, f"is {value}{context}", FINITE)
        elif address in reader.wholes and math.isfinite(value) and value != math.floor(value):
            complain(address, f"is {value:.6g}{context}", f"expected a whole {reader.wholes[address]}")
    for address, quantity in reader.quantities.items():
        if address in unread or quantity.of or isinstance(quantity.value, Number):
            continue
        if ".parameters." not in address or address in values:
            message, hint = _wrong_part(quantity, known, not math.isfinite(values.get(address, 0.0)))
            if message:
                complain(address, f"{message}{context}", hint)
    for condition in reader.conditions:
        broken = _broken(condition, values)
        if broken:
            unit = si_unit(reader.quantities[condition.address].dimension)
            found, hint = broken
            message = f"is {found} {unit}".rstrip() + f"{context}: {condition.message}"
            is_massless = condition.address.endswith(".mass") and values[condition.address] == 0.0
            complain(condition.address, message, f"{hint} {unit}".rstrip() + MASSLESS * is_massless)
    for vector in reader.vectors_not_zero:
        if all(values.get(component.address) == 0.0 for component in vector):
            complain(vector[0].address, f"and .y are both 0{context}", "expected a direction, such as [1, 0]")
    _tell(reader, told, own)
    return told.keys()


def _unread(reader: Reader, parameters: Mapping[str, Quantity], order: Iterable[str]) -> set[str]:
    """Return names of parameters and addresses of numbers that could not be read, or that follow such a number."""
    unread: set[str] = set()
    for path, quantity in (*((name, parameters[name]) for name in order), *reader.quantities.items()):
        is_broken = isinstance(quantity.value, Number) and math.isnan(quantity.value.value)
        if is_broken or any(name.path in unread for name in names(quantity.value)):
            unread.add(path)
    return unread


def _tell(reader: Reader, wrong: Mapping[str, Sequence[tuple[str, str]]], own: Mapping[str, Quantity]) -> None:
    """Errors of (what, hint) by address; nothing of a number that is wrong because another is."""
    for address, told in wrong.items():
        quantity = reader.quantities[address]
        if not _follows(reader, quantity, wrong):
            place, users = _place(quantity, own), _users(reader, address)
            reader.errors += [BadValueError(f"{address} {message}{users}", place, hint) for message, hint in told]


def _follows(reader: Reader, quantity: Quantity, wrong: Container[str]) -> bool:
    """Whether a number is wrong because another is, or an expression by name that is a part of it."""
    return any(part.address in wrong or _follows(reader, part, wrong) for part in quantity.of) or any(
        f"{EXPRESSIONS}{name}" in wrong for name in reader.made_of.get(quantity.address, ())
    )


def _users(reader: Reader, address: str) -> str:
    """Who uses an expression by name, in words; "" of another number."""
    name = address.removeprefix(EXPRESSIONS)
    users = [user for user, names in reader.made_of.items() if name in names and not user.startswith(EXPRESSIONS)]
    if name == address or not users:
        return ""
    return f", and {users[0]} and {len(users) - 1} more use it" if len(users) > 1 else f", and {users[0]} uses it"


def _wrong_part(quantity: Quantity, known: Mapping[str, float], is_wrong: bool) -> tuple[str, str]:
    """(message, hint) about a part of an expression that cannot be meant; "" if none, or the whole is wrong."""
    wrong = None if is_wrong else undefined_part(quantity.value, known)
    if wrong is not None:
        return f"has a part that is {wrong}", FINITE
    if (small := _lost_factor(quantity.value, known)) is not None:
        hint = "expected products and powers from 2.3e-308: (0.01*x)**161, not 0.01**161 * x**161"
        return f"has a part that is {small:g}, too small for its digits", hint
    for call in _steps(quantity):
        duration = call.arguments[2]
        if all(name.path in known for name in names(duration)):
            lasts = float(evaluate(duration, known.__getitem__))
            if lasts < 0.0:
                told = f"has a {call.function} that lasts {lasts:.6g}: it would end before it begins"
                return told, f"expected {call.function}(t, start, duration), its duration above zero"
    return "", ""


def _steps(quantity: Quantity) -> list[Call]:
    """The ramps and smooth_steps of an expression."""
    return [call for function in ("ramp", "smooth_step") for call in calls(quantity.value, function)]


def _lost_factor(expr: Expr, known: Mapping[str, float]) -> float | None:
    """The value of a product of numbers, or a power in a product, that binary64 has without digits or not at all."""
    match expr:
        case Unary(operand=operand):
            return _lost_factor(operand, known)
        case Call(arguments=inner):
            pass
        case Binary(operator=operator, left=left, right=right):
            inner = (left, right)
            for part in (expr, left, right) if operator in ("*", "/") else ():
                if (value := _lost(part, known)) is not None:
                    return value
        case _:
            return None
    return next((value for part in inner if (value := _lost_factor(part, known)) is not None), None)


def _lost(part: Expr, known: Mapping[str, float]) -> float | None:
    """The value of a product, quotient or power of numbers other than 0 if it is below what has all its digits."""
    if not isinstance(part, Binary) or part.operator in ("+", "-") or any(n.path not in known for n in names(part)):
        return None
    value, left, right = (float(evaluate(x, known.__getitem__)) for x in (part, part.left, part.right))
    return value if abs(value) < sys.float_info.min and all(math.isfinite(x) and x for x in (left, right)) else None


def _values(reader: Reader, known: dict[str, float]) -> dict[str, float]:
    """Every number that parameters alone determine (SI), by address; `known` gets those that others follow."""
    for part in (part for quantity in reader.quantities.values() for part in quantity.of):
        known[part.address] = float(evaluate(part.value, known.__getitem__))  # in their order: parts come first
    return {
        address: float(evaluate(quantity.value, known.__getitem__))
        for address, quantity in reader.quantities.items()
        if not (address.startswith("scenes.") and ".parameters." in address)  # they are parameters of their scene
        and all(name.path in known for name in names(quantity.value))  # neither t nor a result
    }


def _place(quantity: Quantity, own: Mapping[str, Quantity]) -> Location:
    """Where a wrong number comes from: from the scene, if it uses one of the scene's own parameters."""
    return next((own[name.path].where for name in names(quantity.value) if name.path in own), quantity.where)


def _broken(condition: Condition, values: Mapping[str, float]) -> tuple[str, str] | None:
    """The value and what was expected, if a condition does not hold; a number that is NaN was told already."""
    value = values.get(condition.address, math.nan)
    bound = condition.bound
    if isinstance(bound, str):
        bound = sum(values.get(address, math.nan) for address in bound.split(" + "))
    if math.isnan(value) or math.isnan(bound) or RELATIONS[condition.relation](value, bound):
        return None
    limit = f"{condition.bound} = {bound:.6g}" if isinstance(condition.bound, str) else f"{bound:.6g}"
    return f"{value:.6g}", f"expected {condition.relation} {limit}"

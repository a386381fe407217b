"""Checks that every number is finite and within its bounds, with the file's parameters and with those of each scene."""

from __future__ import annotations

import math
import sys
from collections.abc import Container, Iterable, Mapping, Sequence

from gudgeon.errors import BadValueError, InputError, Location
from gudgeon.generator.field import RELATIONS
from gudgeon.generator.mechanism import Condition, Quantity, SceneSpec
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.parameters import evaluate_parameters
from gudgeon.language.tree import Binary, Call, Expr, Name, Number, Unary, evaluate, iterate_calls, iterate_names
from gudgeon.language.undefined_parts import find_undefined_part
from gudgeon.language.units import find_si_unit

EXPRESSIONS = "expressions."  # how the addresses of expressions by name begin
FINITE = (
    "expected finite numbers: check for a division by zero, a root of a negative number, or a curve outside its range"
)
MASSLESS = (
    ", because the equations divide by it; a massless rod with a load is one body: mass of the load, com: at the load,"
    " inertia: 0"
)


def check_values(reader: Reader, parameters: Mapping[str, Quantity], scenes: Mapping[str, SceneSpec]) -> None:
    """Collect a BadValueError at the location of each number that is not finite or violates a condition.

    Numbers are checked with the file's parameters, then with those of each scene that sets parameters. Durations of
    ramps that are parameters get the condition > 0, which run-time overrides must satisfy too.
    """
    addresses_of_errors = _check_with_parameters(reader, parameters, None)
    for scene in scenes.values():
        if scene.parameters:
            _check_with_parameters(reader, parameters, scene, addresses_of_errors)
    durations = dict.fromkeys(
        call.arguments[2] for quantity in reader.quantities.values() for call in _find_ramp_calls(quantity)
    )
    for name in {duration.path for duration in durations if isinstance(duration, Name)}.intersection(parameters):
        reader.add_condition(
            parameters[name], ">", 0.0, "the duration of a ramp or smooth_step is positive"
        )  # also for run-time overrides


def _check_with_parameters(
    reader: Reader, parameters: Mapping[str, Quantity], scene: SceneSpec | None, reported_addresses: Container[str] = ()
) -> Container[str]:
    """Check all numbers with the file's parameters or a scene's, and return the addresses of the wrong ones.

    Errors are collected. `scene` None: with the file's parameters. Numbers in `reported_addresses`, numbers that
    follow from an unreadable one, and errors that follow from another error are not reported. () is returned for
    parameters in a cycle, which was reported already.
    """
    scene_parameters = scene.parameters if scene else {}
    context = f" in scene {scene.name}" if scene else ""
    try:
        parameter_values = evaluate_parameters({**parameters, **scene_parameters})
    except InputError:
        return ()  # a cycle, reported already
    unreadable = (
        _find_unreadable_numbers(reader, {**parameters, **scene_parameters}, parameter_values) if reader.errors else ()
    )
    values = _evaluate_constant_numbers(reader, parameter_values)
    errors: dict[str, list[tuple[str, str]]] = {}

    def record_error(address: str, message: str, hint: str) -> None:
        """Add an error, message and hint, for the number at `address`, unless it was reported before."""
        if address not in reported_addresses:
            errors.setdefault(address, []).append((message, hint))

    for address, value in values.items():
        if not math.isfinite(value) and address not in unreadable:
            record_error(address, f"is {value}{context}", FINITE)
        elif address in reader.meaning_of_integers and math.isfinite(value) and value != math.floor(value):
            record_error(address, f"is {value:.6g}{context}", f"expected a whole {reader.meaning_of_integers[address]}")
    for address, quantity in reader.quantities.items():
        if address in unreadable or quantity.operands or isinstance(quantity.value, Number):
            continue
        if ".parameters." not in address or address in values:
            message, hint = _find_invalid_part(quantity, parameter_values, not math.isfinite(values.get(address, 0.0)))
            if message:
                record_error(address, f"{message}{context}", hint)
    for condition in reader.conditions:
        violation = _describe_violation(condition, values)
        if violation:
            unit = find_si_unit(reader.quantities[condition.address].dimension)
            value_text, hint = violation
            message = f"is {value_text} {unit}".rstrip() + f"{context}: {condition.message}"
            is_massless = condition.address.endswith(".mass") and values[condition.address] == 0.0
            record_error(condition.address, message, f"{hint} {unit}".rstrip() + MASSLESS * is_massless)
    for vector in reader.nonzero_vectors:
        if all(values.get(component.address) == 0.0 for component in vector):
            record_error(vector[0].address, f"and .y are both 0{context}", "expected a direction, such as [1, 0]")
    _report_errors(reader, errors, scene_parameters)
    return errors.keys()


def _find_unreadable_numbers(
    reader: Reader, parameters: Mapping[str, Quantity], ordered_names: Iterable[str]
) -> set[str]:
    """Return parameters and addresses of numbers that could not be read (NaN), or that depend on such a number.

    `ordered_names`: names of the parameters, each after those that it depends on.
    """
    unreadable: set[str] = set()
    for path, quantity in (*((name, parameters[name]) for name in ordered_names), *reader.quantities.items()):
        is_broken = isinstance(quantity.value, Number) and math.isnan(quantity.value.value)
        if is_broken or any(name.path in unreadable for name in iterate_names(quantity.value)):
            unreadable.add(path)
    return unreadable


def _report_errors(
    reader: Reader, errors: Mapping[str, Sequence[tuple[str, str]]], scene_parameters: Mapping[str, Quantity]
) -> None:
    """Collect the errors (message, hint) by address, except those that follow from another error.

    `scene_parameters`: the parameters of the scene, at which an error is located if the number depends on one; {} for
    the file's.
    """
    for address, messages_and_hints in errors.items():
        quantity = reader.quantities[address]
        if not _is_caused_by_error(reader, quantity, errors):
            location, description_of_users = (
                _find_location_of_cause(quantity, scene_parameters),
                _describe_users_of_expression(reader, address),
            )
            reader.errors += [
                BadValueError(f"{address} {message}{description_of_users}", location, hint)
                for message, hint in messages_and_hints
            ]


def _is_caused_by_error(reader: Reader, quantity: Quantity, wrong_addresses: Container[str]) -> bool:
    """Return whether a number is wrong because another number, or a named expression that it contains, is wrong.

    `wrong_addresses` contains the addresses of wrong numbers.
    """
    return any(
        operand.address in wrong_addresses or _is_caused_by_error(reader, operand, wrong_addresses)
        for operand in quantity.operands
    ) or any(
        f"{EXPRESSIONS}{name}" in wrong_addresses for name in reader.named_expressions_used.get(quantity.address, ())
    )


def _describe_users_of_expression(reader: Reader, address: str) -> str:
    """Return a phrase that names the values that use a named expression, such as ", and forces.coil.value uses it".

    "" for the address of another number, and for an expression that only other expressions use.
    """
    name = address.removeprefix(EXPRESSIONS)
    users = [
        user
        for user, names in reader.named_expressions_used.items()
        if name in names and not user.startswith(EXPRESSIONS)
    ]
    if name == address or not users:
        return ""
    return f", and {users[0]} and {len(users) - 1} more use it" if len(users) > 1 else f", and {users[0]} uses it"


def _find_invalid_part(
    quantity: Quantity, parameter_values: Mapping[str, float], is_not_finite: bool
) -> tuple[str, str]:
    """Return (message, hint) about a part of an expression that cannot be intended; ("", "") if there is none.

    Tested are undefined parts, underflows, and ramps with a negative duration. `parameter_values`: values of
    parameters. `is_not_finite`: the whole value is not finite, which was reported; its undefined parts are then not
    searched.
    """
    undefined_part = None if is_not_finite else find_undefined_part(quantity.value, parameter_values)
    if undefined_part is not None:
        return f"has a part that is {undefined_part}", FINITE
    if (underflow := _find_underflow(quantity.value, parameter_values)) is not None:
        hint = "expected products and powers of at least 2.3e-308: (0.01*x)**161, not 0.01**161 * x**161"
        return f"has a part that is {underflow:g}, which loses digits by underflow", hint
    for call in _find_ramp_calls(quantity):
        duration = call.arguments[2]
        if all(name.path in parameter_values for name in iterate_names(duration)):
            duration_s = float(evaluate(duration, parameter_values.__getitem__))
            if duration_s < 0.0:
                message = f"has a {call.function} with the negative duration {duration_s:.6g}"
                return message, f"expected {call.function}(t, start, duration) with a duration above zero"
    return "", ""


def _find_ramp_calls(quantity: Quantity) -> list[Call]:
    """Return the calls of ramp and smooth_step in an expression; their third argument is the duration."""
    return [call for function in ("ramp", "smooth_step") for call in iterate_calls(quantity.value, function)]


def _find_underflow(expr: Expr, parameter_values: Mapping[str, float]) -> float | None:
    """Return the first product, quotient or factor in an expression that underflows in binary64; None if there is none.

    Sums are searched for them, but are not tested themselves. `parameter_values`: values of parameters by name.
    """
    match expr:
        case Unary(operand=operand):
            return _find_underflow(operand, parameter_values)
        case Call(arguments=inner):
            pass
        case Binary(operator=operator, left=left, right=right):
            inner = (left, right)
            for part in (expr, left, right) if operator in ("*", "/") else ():
                if (value := _find_underflowing_value(part, parameter_values)) is not None:
                    return value
        case _:
            return None
    return next((value for part in inner if (value := _find_underflow(part, parameter_values)) is not None), None)


def _find_underflowing_value(expression: Expr, parameter_values: Mapping[str, float]) -> float | None:
    """Return the value of a product, quotient or power of nonzero finite numbers if it underflows, else None.

    An underflow is a magnitude below the smallest normal number. None also for other expressions, and if the expression
    contains names without a known value.
    """
    if (
        not isinstance(expression, Binary)
        or expression.operator in ("+", "-")
        or any(n.path not in parameter_values for n in iterate_names(expression))
    ):
        return None
    value, left, right = (
        float(evaluate(x, parameter_values.__getitem__)) for x in (expression, expression.left, expression.right)
    )
    return value if abs(value) < sys.float_info.min and all(math.isfinite(x) and x for x in (left, right)) else None


def _evaluate_constant_numbers(reader: Reader, values_by_name: dict[str, float]) -> dict[str, float]:
    """Return all numbers (SI) that parameters alone determine, by address.

    Numbers that other numbers depend on are added to `values_by_name`, the values of parameters. Expressions of t or
    motion, and parameters of scenes, are left out.
    """
    for part in (part for quantity in reader.quantities.values() for part in quantity.operands):
        values_by_name[part.address] = float(
            evaluate(part.value, values_by_name.__getitem__)
        )  # in their order: parts come first
    return {
        address: float(evaluate(quantity.value, values_by_name.__getitem__))
        for address, quantity in reader.quantities.items()
        if not (address.startswith("scenes.") and ".parameters." in address)  # they are parameters of their scene
        and all(name.path in values_by_name for name in iterate_names(quantity.value))  # neither t nor a result
    }


def _find_location_of_cause(quantity: Quantity, scene_parameters: Mapping[str, Quantity]) -> Location:
    """Return where a wrong value comes from: the scene's parameter if the number uses one, else the number itself."""
    return next(
        (scene_parameters[name.path].where for name in iterate_names(quantity.value) if name.path in scene_parameters),
        quantity.where,
    )


def _describe_violation(condition: Condition, values: Mapping[str, float]) -> tuple[str, str] | None:
    """Return the value and the expected bound as texts if a condition is violated, else None.

    None also if the value or the bound is NaN or unknown. `values`: numbers in SI by address.
    """
    value = values.get(condition.address, math.nan)
    bound = condition.bound
    if isinstance(bound, str):
        bound = sum(values.get(address, math.nan) for address in bound.split(" + "))
    if math.isnan(value) or math.isnan(bound) or RELATIONS[condition.relation](value, bound):
        return None
    limit = f"{condition.bound} = {bound:.6g}" if isinstance(condition.bound, str) else f"{bound:.6g}"
    return f"{value:.6g}", f"expected {condition.relation} {limit}"

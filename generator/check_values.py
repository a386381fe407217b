"""Every number is finite and within its bounds: with the file's parameters, and with every scene's."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping

from gudgeon.errors import BadValueError, InputError
from gudgeon.expression_tree import evaluate, names
from gudgeon.generator.mechanism import Condition, Quantity, SceneSpec
from gudgeon.generator.parameters import parameter_values
from gudgeon.generator.reading import Reader
from gudgeon.generator.units import si_unit

RELATIONS: Mapping[str, Callable[[float, float], bool]] = {
    ">": operator.gt, ">=": operator.ge, "<": operator.lt, "<=": operator.le,
}  # fmt: skip


def check_values(reader: Reader, parameters: Mapping[str, Quantity], scenes: Mapping[str, SceneSpec]) -> None:
    """Collect a BadValueError at the place of each number that is not finite or breaks a condition."""
    before = len(reader.errors)
    _check_with(reader, parameters, "", broken_is_told=before > 0)
    if len(reader.errors) > before:
        return  # the same would be told of every scene
    for scene in scenes.values():
        if scene.parameters:
            own = {key: scene.parameters.get(key, quantity) for key, quantity in parameters.items()}
            _check_with(reader, own, f" in scene {scene.name}", broken_is_told=before > 0)


def _check_with(reader: Reader, parameters: Mapping[str, Quantity], context: str, broken_is_told: bool) -> None:
    try:
        known = parameter_values(parameters)
    except InputError:
        return  # a cycle, told already
    values: dict[str, float] = {}
    for address, quantity in reader.quantities.items():
        if address.startswith("scenes.") and ".parameters." in address:
            continue  # they are the parameters of their scene
        if all(name.path in known for name in names(quantity.value)):  # not t, not a result
            values[address] = float(evaluate(quantity.value, known.__getitem__))
            if not math.isfinite(values[address]) and not broken_is_told:
                hint = "expected a finite number: is there a division by zero or a root of a negative number?"
                reader.errors.append(BadValueError(f"{address} is {values[address]}{context}", quantity.where, hint))
    for condition in reader.conditions:
        with reader.collect():
            _check(condition, reader.quantities, values, context)
    for vector in reader.vectors_not_zero:
        if all(values.get(component.address) == 0.0 for component in vector):
            owner = vector[0].address.rpartition(".")[0]
            hint = "expected a direction, such as [1, 0]"
            reader.errors.append(
                BadValueError(f"{owner} has no direction{context}: it is [0, 0]", vector[0].where, hint)
            )
    for address, value in values.items():
        if address.endswith(".simulate.output") and math.isfinite(value) and value != int(value):
            hint = "expected a whole number of equal intervals"
            reader.errors.append(
                BadValueError(f"{address} is {value:.6g}{context}", reader.quantities[address].where, hint)
            )


def _check(condition: Condition, quantities: Mapping[str, Quantity], values: Mapping[str, float], context: str) -> None:
    """Raise BadValueError if a condition does not hold; a number that is NaN was told already."""
    value = values.get(condition.address, math.nan)
    bound = values.get(condition.bound, math.nan) if isinstance(condition.bound, str) else condition.bound
    if math.isnan(value) or math.isnan(bound) or RELATIONS[condition.relation](value, bound):
        return
    quantity = quantities[condition.address]
    unit = si_unit(quantity.dimension)
    limit = f"{condition.bound} = {bound:.6g}" if isinstance(condition.bound, str) else f"{bound:.6g}"
    raise BadValueError(
        f"{condition.address} is {value:.6g}{' ' if unit else ''}{unit}{context}: {condition.message}",
        quantity.where,
        f"expected {condition.relation} {limit}{' ' if unit else ''}{unit}",
    )

"""Convert texts of a study file to parameter values in SI, with locations for errors, and evaluate its expressions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError, ExpressionError, InputError, Location
from gudgeon.language.dimension_check import names_over_units
from gudgeon.language.names import unknown_name
from gudgeon.language.parser import at, check_dimension, parse
from gudgeon.language.tree import Expr, evaluate, names
from gudgeon.language.units import Dimension, dimension
from gudgeon.model.choices import index_of_word
from gudgeon.model.parameters import TOGETHER, addresses, given_slots, spaced
from gudgeon.results.batch import Array
from gudgeon.simulation.arguments import MOST_OUTPUT

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Numbers, StudyFile, Written
    from gudgeon.generator.yaml import Text

GEOMETRIC = "geometric"
ROUNDING = 1e-12  # relative tolerance of times at the ends of a window


def slot_of(source: KernelSource, name: str) -> Slot | None:
    """Return the parameter of a scene with this address, short name or group name; None if the scene lacks it.

    Of a group it is the first member.
    """
    by_address = {slot.address: slot for slot in source.slots}
    called = (name, f"parameters.{name}", *TOGETHER.get(name, ()))
    return next((by_address[one] for one in called if one in by_address), None)


def key_of(source: KernelSource, name: str) -> str:
    """Return the name by which runs of a scene are given a parameter: a group name or an address; "" if the scene
    lacks it.
    """
    slot = slot_of(source, name)
    return "" if slot is None else name if name in TOGETHER and slot.address in TOGETHER[name] else slot.address


def known_slot(sources: Sequence[KernelSource], name: Text) -> Slot:
    """Return the parameter of a name in the first of several scenes that has it. Raises UnknownNameError at the name.
    """
    for source in sources:
        if (found := slot_of(source, name)) is not None:
            return found
    every = tuple(dict.fromkeys(address for source in sources for address in addresses(source)))
    try:
        given_slots(sources[0], {str(name): 0.0})  # its message is more specific, for example for an expression of t
    except InputError as error:
        if "has the address" not in error.message:
            raise type(error)(error.message, name.where, error.hint) from None
    raise unknown_name("number", name, every, name.where)


def in_si(text: Text, slot: Slot) -> float | str:
    """Return the value of a text for a parameter in SI, or the stripped text for a choice.

    Raises an InputError at the text for an unknown word, a wrong dimension, a name in the expression, or a value that
    is not finite.
    """
    if slot.words:
        try:
            index_of_word(str(text), slot)
        except InputError as error:
            raise type(error)(error.message, text.where, error.hint) from None
        return text.strip()
    expr = parse(spaced(text), text.where)
    if (name := next(names(expr), None)) is not None:
        hint = "expected a number with its unit; what follows other numbers is written in the mechanism's file"
        raise BadValueError(f"{name.path!r} stands in a number of a study", at(text.where, name.offset), hint)
    check_dimension(expr, dimension(*slot.dimension), lambda path: None, text.where)
    value = float(evaluate(expr, lambda path: None))
    if not math.isfinite(value):
        raise BadValueError(f"{str(text)[:60]!r} is {value}", text.where, "expected a finite number")
    return value


def real_value(text: Text, slot: Slot) -> float:
    """Return the value in SI of a text for a parameter. Raises BadValueError at the text if it is a choice."""
    value = in_si(text, slot)
    if isinstance(value, str):
        hint = "list the names that it takes, under parameters:"
        raise BadValueError(f"{slot.address} is a choice by name, there is nothing between", text.where, hint)
    return value


def values(numbers: Numbers, slot: Slot, may_repeat: bool) -> Array:
    """Return all values of a dimension, (n,), in SI or as words: a list of texts, or a count of spaced values between
    two.

    may_repeat: whether listed values may be equal. Raises an InputError at the text for equal ends, repeated values,
    or ends of different sign with geometric spacing.
    """
    if not numbers.count:
        found = [in_si(text, slot) for text in numbers.texts]
        first_of = {value: k for k, value in reversed(list(enumerate(found)))}
        repeated = next((k for k, value in enumerate(found) if first_of[value] < k and not may_repeat), None)
        if repeated is not None:
            text = numbers.texts[repeated]
            raise BadValueError(f"{str(text)[:60]!r} stands there twice", text.where, "expected each value once")
        return np.array(found, dtype=object if slot.words else float)
    first, last = (real_value(text, slot) for text in numbers.texts)
    if numbers.spacing == GEOMETRIC and not first * last > 0.0:
        message = f"a geometric row from {first:g} to {last:g}"
        raise BadValueError(message, numbers.texts[0].where, "expected both ends positive, or both negative")
    if first == last:
        raise BadValueError(f"a row from {first:g} to {last:g}", numbers.texts[1].where, "expected two ends")
    spaced_values = np.geomspace if numbers.spacing == GEOMETRIC else np.linspace
    with np.errstate(over="ignore", invalid="ignore"):
        return check_finite(np.asarray(spaced_values(first, last, numbers.count)), numbers.texts[1])


def check_finite(values: Array, text: Text) -> Array:
    """Return the array `values` unchanged. Raises BadValueError at `text`, the second end, unless all are finite."""
    if not np.isfinite(values).all():
        raise BadValueError("the values between are beyond the largest double", text.where, "expected ends closer by")
    return values


def check_expression(
    source: KernelSource, written: Written, expected: Dimension, extra_dimensions: Mapping[str, Dimension]
) -> None:
    """Raise an InputError at its location for an expression of a study with another dimension than expected.

    extra_dimensions: names besides parameters of the scene, such as t_end, with their dimensions. Unknown names,
    choices and units that are also parameters are refused, too.
    """

    def dimension_of(path: str) -> Dimension | None:
        """Return the dimension of a name in the expression; None for an unknown name."""
        if path in extra_dimensions:
            return extra_dimensions[path]
        slot = slot_of(source, path)
        return None if slot is None else dimension(*slot.dimension)

    for name in names(written.expr):
        slot = slot_of(source, name.path)
        if name.path not in extra_dimensions and (slot is None or slot.words):
            known = [*extra_dimensions, *addresses(source)]
            place: Location = at(written.text.where, name.offset)
            raise unknown_name(f"name (in scene {source.scene})", name.path, known, place)
    _check_ambiguous_units(
        written, [*extra_dimensions, *(one.removeprefix("parameters.") for one in addresses(source))]
    )
    check_dimension(written.expr, expected, dimension_of, written.text.where)


def _check_ambiguous_units(written: Written, known_names: Sequence[str]) -> None:
    """Raise ExpressionError for a unit in a product that is also the name of a parameter: `2 rad/s` with a parameter
    s.
    """
    text, by_name = written.text, parse(written.text, written.text.where, known_names)
    for name in names_over_units(by_name) if by_name != written.expr else ():
        message = f"{str(text)!r} can mean two things: {name} is a unit, and a number of the scene"
        raise ExpressionError(message, text.where, f"write {name}^1 for the unit, ({name}) for the number")


def constant_value(written: Written | None, known_values: Mapping[str, float]) -> float | None:
    """Return the value of an expression that is the same in all runs; None for None or an unknown name in it.

    known_values: values of names, such as t_end.
    """
    if written is None or any(name.path not in known_values for name in names(written.expr)):
        return None
    return float(evaluate(written.expr, known_values.get))


def find_impossible(name: str, values: Array) -> tuple[Array, str]:
    """Return a flag for each value of t_end, step or (rounded) output that no run can have, and a text of what is
    expected.
    """
    if name == "output":
        expected = f"a number of intervals from 1 to {MOST_OUTPUT:.0e}"
        return ~((values >= 1.0) & (values <= MOST_OUTPUT)), expected
    return ~((values > 0.0) & np.isfinite(values)), "a positive time (s)"


def check_constants(study: StudyFile) -> None:
    """Raise BadValueError at its location for an end, output, step or window of a study that no run can have.

    Only expressions that are the same in all runs are checked here.
    """
    known: dict[str, float] = {}
    for name, written in (("t_end", study.t_end), ("output", study.output), ("step", study.step)):
        if written is None or (value := constant_value(written, known)) is None:
            continue
        wrong, expected = find_impossible(name, np.rint([value]) if name == "output" else np.array([value]))
        if wrong.any():
            raise BadValueError(f"{name} is {value:g}", written.text.where, f"expected {expected}")
        known |= {name: value} if name == "t_end" else {}
    last = known.get("t_end", np.inf)
    for name, window in study.windows.items():
        begin, end = (constant_value(one, known) for one in (window.begin, window.end))
        begin, end = 0.0 if window.begin is None else begin, last if window.end is None else end
        if begin is not None and end is not None and not (begin <= end and begin <= last * (1 + ROUNDING) and end >= 0):
            of = window.begin or window.end
            message = f"window {name} goes from {begin:g} s to {end:g} s"
            raise BadValueError(message, of.text.where if of else None, f"expected a part of the run, to {last:g} s")


def evaluate_for_runs(source: KernelSource, expr: Expr, p: Array, extra_values: Mapping[str, Any]) -> Array:
    """Return the values of an expression for all runs, (n,), from their parameter vectors p (n, n_p).

    extra_values: values of further names, scalar or (n,). Values are NaN or infinite where the expression is
    undefined.
    """
    index_of_address = {slot.address: k for k, slot in enumerate(source.slots)}

    def value_of(path: str) -> Any:
        """Return the value or values of a name in the expression."""
        if path in extra_values:
            return extra_values[path]
        slot = slot_of(source, path)
        assert slot is not None, path
        return p[:, index_of_address[slot.address]]

    return np.array(np.broadcast_to(np.asarray(evaluate(expr, value_of), dtype=float), (len(p),)))

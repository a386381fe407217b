"""Convert texts of a study file to parameter values in SI, and check and evaluate its expressions for all runs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import BadValueError, ExpressionError, InputError, Location
from gudgeon.language.dimension_check import find_unit_shadowing_names
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.parser import check_dimension, offset_location, parse
from gudgeon.language.tree import Expr, evaluate, iterate_names
from gudgeon.language.units import Dimension, make_dimension
from gudgeon.model.choices import find_word_index
from gudgeon.model.parameters import PARAMETER_GROUPS, insert_space_before_unit, list_addresses, read_given_parameters
from gudgeon.results.batch import Array
from gudgeon.simulation.arguments import MAX_OUTPUT

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import ParameterValues, ParsedExpression, StudyFile
    from gudgeon.generator.yaml import Text

GEOMETRIC = "geometric"
ROUNDING = 1e-12  # relative tolerance of times at the ends of a window


def find_parameter(source: KernelSource, name: str) -> RuntimeParameter | None:
    """Return the parameter of a scene with this address, short name or group name; None if the scene lacks it.

    "c" is short for "parameters.c". Of a group (PARAMETER_GROUPS) it is the first member that the scene has.
    """
    by_address = {parameter.address: parameter for parameter in source.parameters}
    candidate_addresses = (name, f"parameters.{name}", *PARAMETER_GROUPS.get(name, ()))
    return next((by_address[address] for address in candidate_addresses if address in by_address), None)


def find_parameter_key(source: KernelSource, name: str) -> str:
    """Return the key by which `simulate` sets a parameter: the name of a group, or the full address.

    "c" becomes "parameters.c". "" if the scene lacks the parameter.
    """
    parameter = find_parameter(source, name)
    return (
        ""
        if parameter is None
        else name
        if name in PARAMETER_GROUPS and parameter.address in PARAMETER_GROUPS[name]
        else parameter.address
    )


def find_parameter_in_scenes(sources: Sequence[KernelSource], name: Text) -> RuntimeParameter:
    """Return the parameter with this name from the first of several scenes that has it.

    Raises UnknownNameError at the name if no scene has it, with the nearest address.
    """
    for source in sources:
        if (parameter := find_parameter(source, name)) is not None:
            return parameter
    addresses = tuple(dict.fromkeys(address for source in sources for address in list_addresses(source)))
    try:
        read_given_parameters(
            sources[0], {str(name): 0.0}
        )  # its message is more specific, for example for an expression of t
    except InputError as error:
        if "has the address" not in error.message:
            raise type(error)(error.message, name.where, error.hint) from None
    raise make_unknown_name_error("parameter", name, addresses, name.where)


def parse_parameter_value(text: Text, parameter: RuntimeParameter) -> float | str:
    """Return the value in SI of a text such as "0.3 mm" for a parameter; for a choice by name the text itself,
    stripped.

    Raises an InputError at the text for an unknown word, a wrong dimension, a name in the expression, or a value that
    is not finite.
    """
    if parameter.words:
        try:
            find_word_index(str(text), parameter)
        except InputError as error:
            raise type(error)(error.message, text.where, error.hint) from None
        return text.strip()
    expr = parse(insert_space_before_unit(text), text.where)
    if (name := next(iterate_names(expr), None)) is not None:
        hint = "expected a number with its unit; expressions of parameters are possible in the mechanism's file"
        raise BadValueError(
            f"the name {name.path!r} in a value of a study", offset_location(text.where, name.offset), hint
        )
    check_dimension(expr, make_dimension(*parameter.dimension), lambda path: None, text.where)
    value = float(evaluate(expr, lambda path: None))
    if not math.isfinite(value):
        raise BadValueError(f"{str(text)[:60]!r} is {value}", text.where, "expected a finite number")
    return value


def parse_real_value(text: Text, parameter: RuntimeParameter) -> float:
    """Return the value in SI of a text for a numeric parameter.

    Raises BadValueError at the text if the parameter is a choice by name, and the errors of `parse_parameter_value`.
    """
    value = parse_parameter_value(text, parameter)
    if isinstance(value, str):
        hint = "list its names under parameters:"
        raise BadValueError(f"{parameter.address} is a choice by name: it has no range", text.where, hint)
    return value


def parse_dimension_values(parameter_values: ParameterValues, parameter: RuntimeParameter, may_repeat: bool) -> Array:
    """Return all values of a parameter along a dimension, (n,), in SI or as words of a choice.

    parameter_values: a list of texts, or two ends with a count (a range, linear or geometric). may_repeat: whether
    listed values may be equal. Raises an InputError at the text for equal ends, repeated values, ends of different sign
    with geometric spacing, or values that are not finite.
    """
    if not parameter_values.count:
        values = [parse_parameter_value(text, parameter) for text in parameter_values.texts]
        first_of = {value: k for k, value in reversed(list(enumerate(values)))}
        repeated = next((k for k, value in enumerate(values) if first_of[value] < k and not may_repeat), None)
        if repeated is not None:
            text = parameter_values.texts[repeated]
            raise BadValueError(f"the value {str(text)[:60]!r} is repeated", text.where, "expected each value once")
        return np.array(values, dtype=object if parameter.words else float)
    first, last = (parse_real_value(text, parameter) for text in parameter_values.texts)
    if parameter_values.spacing == GEOMETRIC and not first * last > 0.0:
        message = f"a geometric range from {first:g} to {last:g}"
        raise BadValueError(message, parameter_values.texts[0].where, "expected both ends positive, or both negative")
    if first == last:
        raise BadValueError(
            f"a range from {first:g} to {last:g}", parameter_values.texts[1].where, "expected two different ends"
        )
    spaced_values = np.geomspace if parameter_values.spacing == GEOMETRIC else np.linspace
    with np.errstate(over="ignore", invalid="ignore"):
        return check_finite_values(
            np.asarray(spaced_values(first, last, parameter_values.count)), parameter_values.texts[1]
        )


def check_finite_values(values: Array, text: Text) -> Array:
    """Return the array `values` unchanged; raise BadValueError at `text` if any value is not finite (overflow)."""
    if not np.isfinite(values).all():
        message = "values of the range exceed the largest floating-point number"
        raise BadValueError(message, text.where, "expected ends of smaller magnitude")
    return values


def check_expression(
    source: KernelSource,
    expression: ParsedExpression,
    expected_dimension: Dimension,
    extra_dimensions: Mapping[str, Dimension],
) -> None:
    """Raise an InputError at its location for an expression of a study with a wrong dimension or an invalid name.

    extra_dimensions: further names that are allowed, such as t_end, with their dimensions. Invalid are unknown names,
    choices by name, and units that are also names of parameters.
    """

    def find_dimension(path: str) -> Dimension | None:
        """Return the dimension of a name in the expression; None for an unknown name."""
        if path in extra_dimensions:
            return extra_dimensions[path]
        parameter = find_parameter(source, path)
        return None if parameter is None else make_dimension(*parameter.dimension)

    for name in iterate_names(expression.expr):
        parameter = find_parameter(source, name.path)
        if name.path not in extra_dimensions and (parameter is None or parameter.words):
            known_names = [*extra_dimensions, *list_addresses(source)]
            location: Location = offset_location(expression.text.where, name.offset)
            raise make_unknown_name_error(f"name (in scene {source.scene})", name.path, known_names, location)
    _check_ambiguous_units(
        expression, [*extra_dimensions, *(address.removeprefix("parameters.") for address in list_addresses(source))]
    )
    check_dimension(expression.expr, expected_dimension, find_dimension, expression.text.where)


def _check_ambiguous_units(expression: ParsedExpression, known_names: Sequence[str]) -> None:
    """Raise ExpressionError for a unit of an expression that is also a parameter: "2 rad/s" with a parameter s."""
    text, by_name = expression.text, parse(expression.text, expression.text.where, known_names)
    for name in find_unit_shadowing_names(by_name) if by_name != expression.expr else ():
        message = f"{str(text)!r} can mean two things: {name} is a unit, and a parameter of the scene"
        raise ExpressionError(message, text.where, f"write {name}^1 for the unit, ({name}) for the parameter")


def evaluate_constant(expression: ParsedExpression | None, known_values: Mapping[str, float]) -> float | None:
    """Return the value of an expression that is the same in all runs; None if it depends on a name without a value.

    known_values: values of names, such as t_end. None for the expression None.
    """
    if expression is None or any(name.path not in known_values for name in iterate_names(expression.expr)):
        return None
    return float(evaluate(expression.expr, known_values.get))


def find_out_of_range_values(name: str, values: Array) -> tuple[Array, str]:
    """Return a flag for each value that is outside the range of a setting, and a text with the expected range.

    name: of the setting, "t_end", "step" or "output". The values of output must be rounded.
    """
    if name == "output":
        expected = f"a number of intervals from 1 to {MAX_OUTPUT:.0e}"
        return ~((values >= 1.0) & (values <= MAX_OUTPUT)), expected
    return ~((values > 0.0) & np.isfinite(values)), "a positive time (s)"


def check_constant_settings(study: StudyFile) -> None:
    """Raise BadValueError at its location for an impossible t_end, output, step or window that is the same in all runs.

    Expressions that depend on parameters are checked for each run later.
    """
    constants: dict[str, float] = {}
    for name, expression in (("t_end", study.t_end), ("output", study.output), ("step", study.step)):
        if expression is None or (value := evaluate_constant(expression, constants)) is None:
            continue
        is_impossible, expected = find_out_of_range_values(
            name, np.rint([value]) if name == "output" else np.array([value])
        )
        if is_impossible.any():
            raise BadValueError(f"{name} is {value:g}", expression.text.where, f"expected {expected}")
        constants |= {name: value} if name == "t_end" else {}
    last = constants.get("t_end", np.inf)
    for name, window in study.windows.items():
        begin, end = (evaluate_constant(bound, constants) for bound in (window.begin, window.end))
        begin, end = 0.0 if window.begin is None else begin, last if window.end is None else end
        if begin is not None and end is not None and not (begin <= end and begin <= last * (1 + ROUNDING) and end >= 0):
            limit = window.begin or window.end
            message = f"window {name} is from {begin:g} s to {end:g} s"
            raise BadValueError(
                message, limit.text.where if limit else None, f"expected a part of the run, to {last:g} s"
            )


def evaluate_expression_for_runs(source: KernelSource, expr: Expr, p: Array, extra_values: Mapping[str, Any]) -> Array:
    """Return the values of an expression for all runs, (n,), from their parameter vectors p (n, n_p).

    extra_values: values of further names, scalar or (n,). A value is NaN or infinite where the expression is undefined.
    """
    index_of_address = {parameter.address: k for k, parameter in enumerate(source.parameters)}

    def get_values(path: str) -> Any:
        """Return the values (n,) of a name in the expression, or a scalar."""
        if path in extra_values:
            return extra_values[path]
        parameter = find_parameter(source, path)
        assert parameter is not None, path
        return p[:, index_of_address[parameter.address]]

    return np.array(np.broadcast_to(np.asarray(evaluate(expr, get_values), dtype=float), (len(p),)))


def to_python_value(value: Any) -> float | str:
    """Return an entry of an array of parameter values as a Python float; a text unchanged."""
    return value if isinstance(value, str) else float(value)

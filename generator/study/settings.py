"""Converts a study given in Python to a tree of texts, and applies values of `--set` over those of the file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.study.spec import Axis, Draw, ParameterValues
from gudgeon.generator.yaml import Items, Map, Text
from gudgeon.language.argument_checks import is_integer, shorten_value

MAX_DEPTH, MAX_VALUES = 16, 1_000_000


def build_tree(value: Any, address: str = "", depth: int = 0) -> Any:
    """Return a file's tree for mappings, lists, arrays, numbers and texts in Python; locations are addresses.

    None becomes an empty text, a bool "true" or "false"; any iterable is read as a list. Raises BadValueError for
    other types, keys that are not texts, more than MAX_DEPTH levels and more than MAX_VALUES values in a list.
    """
    location = Location(f"value of {address}" if address else "the study", 1, 1)
    if depth > MAX_DEPTH:
        raise BadValueError(f"{address} is nested too deeply", location, f"expected at most {MAX_DEPTH} levels")
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise BadValueError(f"{address or 'the study'}: its key {shorten_value(key)} is not a text", location)
        addresses = {key: f"{address}.{key}" if address else key for key in value}
        pairs = (
            (Text.make_text(key, Location(f"value of {name}", 1, 1)), value[key]) for key, name in addresses.items()
        )
        return Map.make_map(
            ((key, build_tree(inner_value, addresses[key], depth + 1)) for key, inner_value in pairs), location
        )
    if isinstance(value, str):
        return Text.make_text(value, location, one_line="\n" not in value)
    if isinstance(value, bool) or value is None:
        return Text.make_text({True: "true", False: "false", None: ""}[value], location)
    if isinstance(value, Iterable):
        values = value.tolist() if hasattr(value, "tolist") else list(value)
        if not isinstance(values, list):  # an array without a dimension
            return build_tree(values, address, depth + 1)
        if len(values) > MAX_VALUES:
            raise BadValueError(f"{address} has {len(values)} values", location, f"expected at most {MAX_VALUES}")
        return Items.make_items(
            (build_tree(item, f"{address}[{k}]", depth + 1) for k, item in enumerate(values)), location
        )
    try:
        return Text.make_text(repr(int(value)) if is_integer(value) else repr(float(value)), location)
    except (TypeError, ValueError, OverflowError):
        hint = "expected a number, a text, a list or a mapping"
        raise BadValueError(f"{address or 'the study'} is {shorten_value(value)}", location, hint) from None


def convert_to_texts(node: Any) -> Any:
    """Return a tree as JSON values that contain texts only: mappings, lists, and texts with single spaces."""
    if isinstance(node, Map):
        return {str(key): convert_to_texts(inner_node) for key, inner_node in node.items()}
    if isinstance(node, Items):
        return [convert_to_texts(inner_node) for inner_node in node]
    return " ".join(str(node).split())


DRAW = "draw"


class VariedParameters(NamedTuple):
    """Contain the values of all runs, the dimensions, the draw, and the dimensions that `--set` removed."""

    fixed: Mapping[Text, Text]
    axes: tuple[Axis, ...]
    draw: Draw | None
    left_out: tuple[Axis, ...] = ()


def remove_section_name(name: str) -> str:
    """Return a parameter's name without the section `parameters.`."""
    return name.removeprefix("parameters.")


def apply_set_options(
    fixed_parameters: Mapping[Text, Text], axes: Sequence[Axis], draw: Draw | None, settings: Mapping[str, str]
) -> VariedParameters:
    """Return the parameters after the options `--set c=0.2mm`, whose values replace the file's, fixed or varied.

    Parameters that vary together with them, in a zip or a draw, are not changed. For each axis that loses parameters,
    `VariedParameters.left_out` has an axis with these parameters alone; those of the draw form one grouped axis there.
    An axis or draw without any other parameter is removed.
    """
    set_names = {remove_section_name(name) for name in settings}
    set_values = build_tree({f"--set {name}": value for name, value in settings.items()})
    fixed_values = {key: value for key, value in fixed_parameters.items() if remove_section_name(key) not in set_names}
    fixed_values |= {Text.make_text(key.removeprefix("--set "), key.where): value for key, value in set_values.items()}
    axes_with_removed_columns = [
        (axis, {key: numbers for key, numbers in axis.columns.items() if remove_section_name(key) in set_names})
        for axis in axes
    ]
    remaining_axes = (
        replace(axis, columns={key: numbers for key, numbers in axis.columns.items() if key not in removed})
        for axis, removed in axes_with_removed_columns
    )
    removed_axes = [replace(axis, columns=removed) for axis, removed in axes_with_removed_columns if removed]
    if draw is not None and (
        drawn := {
            key: distribution
            for key, distribution in draw.distributions.items()
            if remove_section_name(key) in set_names
        }
    ):
        columns = {key: ParameterValues(distribution.ends, draw.count) for key, distribution in drawn.items()}
        removed_axes.append(Axis(DRAW, next(iter(drawn)).where, columns, grouped=True))
        others = {key: distribution for key, distribution in draw.distributions.items() if key not in drawn}
        draw = replace(draw, distributions=others) if others else None
    return VariedParameters(
        fixed_values, tuple(axis for axis in remaining_axes if axis.columns), draw, tuple(removed_axes)
    )

"""Converts a study given in Python to a tree of texts, and applies values of `--set` over those of the file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.study.spec import Axis, Draw, Numbers
from gudgeon.generator.yaml import Items, Map, Text
from gudgeon.language.argument_checks import is_whole, message

MOST_DEPTH, MOST_VALUES = 16, 1_000_000


def tree_of(value: Any, address: str = "", depth: int = 0) -> Any:
    """Return a file's tree for mappings, lists, arrays, numbers and texts; locations are addresses.

    Raises BadValueError for other types.
    """
    where = Location(f"value of {address}" if address else "the study", 1, 1)
    if depth > MOST_DEPTH:
        raise BadValueError(f"{address} is nested too deeply", where, f"expected at most {MOST_DEPTH} levels")
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise BadValueError(f"{address or 'the study'}: its key {message(key)} is no text", where)
        names = {key: f"{address}.{key}" if address else key for key in value}
        pairs = ((Text.make(key, Location(f"value of {name}", 1, 1)), value[key]) for key, name in names.items())
        return Map.make(((key, tree_of(below, names[key], depth + 1)) for key, below in pairs), where)
    if isinstance(value, str):
        return Text.make(value, where, one_line="\n" not in value)
    if isinstance(value, bool) or value is None:
        return Text.make({True: "true", False: "false", None: ""}[value], where)
    if isinstance(value, Iterable):
        every = value.tolist() if hasattr(value, "tolist") else list(value)
        if not isinstance(every, list):  # an array without a dimension
            return tree_of(every, address, depth + 1)
        if len(every) > MOST_VALUES:
            raise BadValueError(f"{address} has {len(every)} values", where, f"expected at most {MOST_VALUES}")
        return Items.make((tree_of(one, f"{address}[{k}]", depth + 1) for k, one in enumerate(every)), where)
    try:
        return Text.make(repr(int(value)) if is_whole(value) else repr(float(value)), where)
    except (TypeError, ValueError, OverflowError):
        hint = "expected a number, a text, a list or a mapping"
        raise BadValueError(f"{address or 'the study'} is {message(value)}", where, hint) from None


def plain_texts(node: Any) -> Any:
    """Return a tree as JSON values that contain texts only."""
    if isinstance(node, Map):
        return {str(key): plain_texts(below) for key, below in node.items()}
    if isinstance(node, Items):
        return [plain_texts(below) for below in node]
    return " ".join(str(node).split())


DRAW = "draw"


class Varied(NamedTuple):
    """Contain the values of all runs, the dimensions, the draw, and the dimensions that `--set` removed."""

    fixed: Mapping[Text, Text]
    axes: tuple[Axis, ...]
    draw: Draw | None
    left_out: tuple[Axis, ...] = ()


def short_name(name: str) -> str:
    """Return a parameter's name without the section `parameters.`."""
    return name.removeprefix("parameters.")


def apply_settings(
    fixed: Mapping[Text, Text], axes: Sequence[Axis], draw: Draw | None, settings: Mapping[str, str]
) -> Varied:
    """Apply values of `--set`: they replace the file's values of these parameters, fixed or varied.

    Parameters that vary together with them, in a zip or a draw, are not changed.
    """
    given = {short_name(name) for name in settings}
    own = tree_of({f"--set {name}": value for name, value in settings.items()})
    found = {key: value for key, value in fixed.items() if short_name(key) not in given}
    found |= {Text.make(key.removeprefix("--set "), key.where): value for key, value in own.items()}
    split = [
        (axis, {key: numbers for key, numbers in axis.columns.items() if short_name(key) in given}) for axis in axes
    ]
    kept = (
        replace(axis, columns={key: numbers for key, numbers in axis.columns.items() if key not in removed})
        for axis, removed in split
    )
    left_out = [replace(axis, columns=removed) for axis, removed in split if removed]
    if draw is not None and (drawn := {key: one for key, one in draw.numbers.items() if short_name(key) in given}):
        columns = {key: Numbers(spread.ends, draw.count) for key, spread in drawn.items()}
        left_out.append(Axis(DRAW, next(iter(drawn)).where, columns, grouped=True))
        others = {key: spread for key, spread in draw.numbers.items() if key not in drawn}
        draw = replace(draw, numbers=others) if others else None
    return Varied(found, tuple(axis for axis in kept if axis.columns), draw, tuple(left_out))

"""A study as a tree of texts: from a mapping of Python, and back to plain texts that can be compared."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.yaml.tree import Items, Map, Text
from gudgeon.language.wanted import is_whole, told

MOST_DEPTH, MOST_VALUES = 16, 1_000_000


def tree_of(value: Any, address: str = "", depth: int = 0) -> Any:
    """Mappings, lists, arrays, numbers and texts as a file would have them; their places are their addresses.

    Raises BadValueError for anything else.
    """
    where = Location(f"value of {address}" if address else "the study", 1, 1)
    if depth > MOST_DEPTH:
        raise BadValueError(f"{address} is nested too deeply", where, f"expected at most {MOST_DEPTH} levels")
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise BadValueError(f"{address or 'the study'}: its key {told(key)} is no text", where)
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
        raise BadValueError(f"{address or 'the study'} is {told(value)}", where, hint) from None


def plain(node: Any) -> Any:
    """The tree as JSON has it, of texts alone."""
    if isinstance(node, Map):
        return {str(key): plain(below) for key, below in node.items()}
    if isinstance(node, Items):
        return [plain(below) for below in node]
    return " ".join(str(node).split())

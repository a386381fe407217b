"""Overrides of a file before it is read: an address such as contacts.dry.normal.geometry gets another text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gudgeon.errors import BadValueError, InputError, Location
from gudgeon.generator.yaml.shapes import OVERRIDE, FileShape
from gudgeon.generator.yaml.tree import Items, Map, Text, kind_of
from gudgeon.language.suggestions import unknown_name

# What the file must name itself: an override changes it and makes no new one.
_COLLECTIONS = frozenset(
    ("parameters", "materials", "bodies", "ground", "joints", "drives")
    + ("forces", "bearings", "contacts", "events", "scenes", "outputs")
)
_AXES = {"x": 0, "y": 1}


def apply_overrides(root: Map, overrides: Mapping[str, str | float | bool]) -> Map:
    """The tree with other texts at the given addresses; `root` itself stays as it is.

    A parameter may be called by its name alone. Raises UnknownNameError for an address that the file
    has not, with the nearest; a key that a shape or a law does not know is told when it is read.
    """
    for address, value in overrides.items():
        parts = _parts(root, address)
        text = Text.make(_write(value, address), Location(OVERRIDE + address, 1, 1))
        root = _put(root, parts, text, address, root, 0)
    return root


def _parts(root: Map, address: str) -> list[str]:
    if address in root.get("parameters", ()):
        return ["parameters", address]
    parts = address.split(".")
    if parts[0] == "start" and len(parts) > 2:  # the key is the name of a coordinate: L7.theta
        return [*parts[:2], ".".join(parts[2:])]
    return parts


def _write(value: object, address: str) -> str:
    """A value as it would stand in the file."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    try:
        return repr(float(value))  # type: ignore[arg-type]
    except (TypeError, ValueError):
        message = f"the override of {address} is of type {type(value).__name__}"
        raise BadValueError(message, None, "expected a number, a text or a bool") from None


def _put(node: Any, parts: list[str], text: Text, address: str, root: Map, depth: int) -> Any:
    """A copy of `node` with `text` at `parts`; what is not on the way is shared."""
    if not parts:
        if isinstance(node, (Map, Items)):
            raise BadValueError(f"{address} is {kind_of(node)}", None, _inside(address, node))
        return text
    head, rest = parts[0], parts[1:]
    if isinstance(node, Items):
        if head not in _AXES or _AXES[head] >= len(node):
            raise _unknown(address, root)
        i = _AXES[head]
        return Items.make([*node[:i], _put(node[i], rest, text, address, root, depth + 1), *node[i + 1 :]], node.where)
    if not isinstance(node, Map):
        raise _unknown(address, root)
    if head in node:
        key, below = node.key(head), node[head]
    else:
        if not _may_add(parts, depth, address):
            raise _unknown(address, root)
        key, below = Text.make(head, text.where), _new(rest, text.where)
    return Map.make({**node, key: _put(below, rest, text, address, root, depth + 1)}, node.where)


def _may_add(parts: list[str], depth: int, address: str) -> bool:
    """Whether an override may bring in a key that the file has not: a default, an inherited number, an axis."""
    section = address.partition(".")[0]
    if depth == 0:
        return parts[0] in FileShape.model_fields and parts[0] not in _COLLECTIONS
    return depth > 1 or section not in _COLLECTIONS or (section == "scenes" and parts[0] == "ideal")


def _new(rest: list[str], where: Location) -> Any:
    """What holds a new text: a vector of zeros for .x and .y, else a mapping."""
    if rest and rest[0] in _AXES:
        return Items.make([Text.make("0", where), Text.make("0", where)], where)
    return Map.make((), where) if rest else Text.make("", where)


def _addresses(node: Any, prefix: str = "") -> Iterator[str]:
    if isinstance(node, Map):
        for key, below in node.items():
            yield from _addresses(below, f"{prefix}.{key}" if prefix else str(key))
    elif isinstance(node, Items):
        for axis, below in zip(_AXES, node, strict=False):
            yield from _addresses(below, f"{prefix}.{axis}")
    else:
        yield prefix


def _inside(address: str, node: Map | Items) -> str:
    return f"expected one of: {', '.join(list(_addresses(node, address))[:8])}"


def _unknown(address: str, root: Map) -> InputError:
    return unknown_name("address", address, [*_addresses(root), *root.get("parameters", ())], None)

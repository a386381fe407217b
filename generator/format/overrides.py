"""Applies overrides to a file's tree before it is read: values at addresses such as contacts.dry.normal.geometry."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from numbers import Integral
from typing import Any

from gudgeon.errors import BadValueError, InputError, Location
from gudgeon.generator.field import DEPTHS, MAPPING, POINTS, RESULTS, SCALARS, VECTOR, Field
from gudgeon.generator.format.sections import FILE
from gudgeon.generator.format.shapes import OVERRIDE
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.names import unknown_name

WHOLE = 2.0**53  # smaller whole numbers are exact in binary64
_AXES = {"x": 0, "y": 1}


def apply_overrides(root: Map, overrides: Mapping[str, str | float | bool]) -> Map:
    """Return the file's tree with other texts at the given addresses; `root` itself is not changed.

    The name of a parameter alone is an address, too. Raises UnknownNameError, with the nearest address, for one that
    the file does not have; keys that a law or shape does not know are reported when they are read.
    """
    for address, value in overrides.items():
        parts = _split_address(root, address)
        text = Text.make(_as_file_text(value, address), Location(OVERRIDE + address, 1, 1))
        root = _put_text(root, parts, text, _Address(address, root), FILE, 0)
    return root


def _split_address(root: Map, address: str) -> list[str]:
    """Split an address into the keys on its path; names of coordinates and points stay whole."""
    if address in root.get("parameters", ()):
        return ["parameters", address]
    field: Field | None = FILE
    parts = address.split(".")
    for i, part in enumerate(parts):
        if field is not None and field.addresses:
            return [*parts[:i], ".".join(parts[i:])]
        if field is not None and field.keys is not None:  # the rest is the name of a coordinate: L7.theta
            axis = parts[-1:] if len(parts) - i > 2 and parts[-1] in _AXES else []  # of a point: upper.P.x
            return [*parts[:i], ".".join(parts[i : len(parts) - len(axis)]), *axis]
        field = field and field.below(part)
    return parts


def _as_file_text(value: object, address: str) -> str:
    """Return a value as text, as it would stand in the file. Raises BadValueError for other types."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    try:
        if isinstance(value, Integral) and abs(float(value)) < WHOLE:
            return str(int(value))
        return repr(float(value))  # type: ignore[arg-type]
    except (TypeError, ValueError):
        message = f"the override of {address} is of type {type(value).__name__}"
        raise BadValueError(message, None, "expected a number, a text or a bool") from None


@dataclass(frozen=True)
class _Address:
    """Represent the address of an override and the file's tree in which it is resolved."""

    text: str
    root: Map

    def unknown(self) -> InputError:
        """Return the UnknownNameError for an address that the file does not have."""
        known = [*_addresses(self.root), *self.root.get("parameters", ())]
        return unknown_name("address", self.text, known, None)


def _put_text(node: Any, parts: list[str], text: Text, address: _Address, field: Field | None, depth: int) -> Any:
    """Return a copy of `node`, which `field` declares, with `text` at the path `parts`; other subtrees are shared."""
    if not parts:
        if isinstance(node, (Map, Items)) and not (field is not None and field.kind == RESULTS):
            raise BadValueError(f"{address.text} is {kind_of(node)}", None, _inner_addresses_hint(address.text, node))
        return text
    head, rest = parts[0], parts[1:]
    if field is not None and field.kind == POINTS:
        message = f"{address.text} is a number of a curve, which is a part of the compiled scene"
        raise BadValueError(message, None, "scale the curve by a parameter, or write another one into the file")
    if field is not None and field.kind == DEPTHS:
        message = f"{address.text} is a depth of a contour: it is no part of the file's structure"
        raise BadValueError(message, None, "give it to the run: contour={joint: depths} of simulate")
    if isinstance(node, Items):
        if head not in _AXES or _AXES[head] >= len(node):
            raise address.unknown()
        i = _AXES[head]
        return Items.make(
            [*node[:i], _put_text(node[i], rest, text, address, None, depth + 1), *node[i + 1 :]], node.where
        )
    if not isinstance(node, Map):
        raise address.unknown()
    inner = field and field.below(head, node)
    if head in node:
        key, below = node.key(head), node[head]
    else:
        if not _may_add(field, inner, parts, depth) or rest and inner is not None and inner.kind in SCALARS:
            raise address.unknown()
        key, below = Text.make(head, text.where), _new_node(inner, rest, text.where)
    return Map.make({**node, key: _put_text(below, rest, text, address, inner, depth + 1)}, node.where)


def _may_add(field: Field | None, inner: Field | None, parts: list[str], depth: int) -> bool:
    """Return whether an override may add a key to the file: one with a default, an inherited number, a component.

    Entries of a section must exist in the file. Unknown keys deeper in the tree are reported when they are read.
    """
    if depth == 0:
        return inner is not None and (inner.kind != MAPPING or len(parts) > 1 and parts[1] in inner.given)
    return depth > 1 or field is None or field.kind != MAPPING or parts[0] in field.given


def _new_node(field: Field | None, rest: list[str], where: Location) -> Any:
    """Return the node in which a new text is put: a vector of zeros, a mapping, or an empty text."""
    if rest and field is not None and field.kind == VECTOR:
        return Items.make([Text.make("0", where), Text.make("0", where)], where)
    return Map.make((), where) if rest else Text.make("", where)


def _addresses(node: Any, prefix: str = "") -> Iterator[str]:
    """Yield the addresses of all texts in a subtree."""
    if isinstance(node, Map):
        for key, below in node.items():
            yield from _addresses(below, f"{prefix}.{key}" if prefix else str(key))
    elif isinstance(node, Items):
        for axis, below in zip(_AXES, node, strict=False):
            yield from _addresses(below, f"{prefix}.{axis}")
    else:
        yield prefix


def _inner_addresses_hint(address: str, node: Map | Items) -> str:
    """Return the hint that names addresses inside a mapping or list."""
    return f"expected one of: {', '.join(list(_addresses(node, address))[:8])}"

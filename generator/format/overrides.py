"""Overrides of a file before it is read: an address such as contacts.dry.normal.geometry gets another text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from gudgeon.errors import BadValueError, InputError, Location
from gudgeon.generator.field import DEPTHS, MAPPING, POINTS, RESULTS, SCALARS, VECTOR, Field
from gudgeon.generator.format.sections import FILE
from gudgeon.generator.format.shapes import OVERRIDE
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.names import unknown_name

_AXES = {"x": 0, "y": 1}


def apply_overrides(root: Map, overrides: Mapping[str, str | float | bool]) -> Map:
    """The tree with other texts at the given addresses; `root` itself stays as it is.

    A parameter may be called by its name alone. Raises UnknownNameError for an address that the file
    has not, with the nearest; a key that a shape or a law does not know is told when it is read.
    """
    for address, value in overrides.items():
        parts = _parts(root, address)
        text = Text.make(_write(value, address), Location(OVERRIDE + address, 1, 1))
        root = _put(root, parts, text, _Address(address, root), FILE, 0)
    return root


def _parts(root: Map, address: str) -> list[str]:
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


@dataclass(frozen=True)
class _Address:
    """What an override is called, and the file in which it is looked for."""

    text: str
    root: Map

    def unknown(self) -> InputError:
        known = [*_addresses(self.root), *self.root.get("parameters", ())]
        return unknown_name("address", self.text, known, None)


def _put(node: Any, parts: list[str], text: Text, address: _Address, field: Field | None, depth: int) -> Any:
    """A copy of `node`, which `field` declares, with `text` at `parts`; what is not on the way is shared."""
    if not parts:
        if isinstance(node, (Map, Items)) and not (field is not None and field.kind == RESULTS):
            raise BadValueError(f"{address.text} is {kind_of(node)}", None, _inside(address.text, node))
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
        return Items.make([*node[:i], _put(node[i], rest, text, address, None, depth + 1), *node[i + 1 :]], node.where)
    if not isinstance(node, Map):
        raise address.unknown()
    inner = field and field.below(head, node)
    if head in node:
        key, below = node.key(head), node[head]
    else:
        if not _may_add(field, inner, parts, depth) or rest and inner is not None and inner.kind in SCALARS:
            raise address.unknown()
        key, below = Text.make(head, text.where), _new(inner, rest, text.where)
    return Map.make({**node, key: _put(below, rest, text, address, inner, depth + 1)}, node.where)


def _may_add(field: Field | None, inner: Field | None, parts: list[str], depth: int) -> bool:
    """Whether an override may bring in a key that the file has not: a default, an inherited number, an axis.

    What a section names, the file must name itself. Deeper in, a key that nothing declares is told when it is read.
    """
    if depth == 0:
        return inner is not None and (inner.kind != MAPPING or len(parts) > 1 and parts[1] in inner.given)
    return depth > 1 or field is None or field.kind != MAPPING or parts[0] in field.given


def _new(field: Field | None, rest: list[str], where: Location) -> Any:
    """What holds a new text: a vector of zeros, or a mapping."""
    if rest and field is not None and field.kind == VECTOR:
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

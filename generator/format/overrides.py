"""Replaces values in a YAML tree before it is read, by paths such as contacts.dry.normal.geometry."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from gudgeon.errors import BadValueError, InputError, Location
from gudgeon.generator.field import DEPTHS, MAPPING, POINTS, RESULTS, SCALARS, VECTOR, Field
from gudgeon.generator.format.sections import MECHANISM_FILE
from gudgeon.generator.format.shapes import OVERRIDE
from gudgeon.generator.yaml import Items, Map, Text, describe_node
from gudgeon.language.names import make_unknown_name_error

MAX_EXACT_INTEGER = 2.0**53  # smaller whole numbers are exact in binary64
_AXES = {"x": 0, "y": 1}


def apply_overrides(root: Map, overrides: Mapping[str, str | float | bool]) -> Map:
    """Return the file's tree with other texts at the given addresses; `root` itself is not changed.

    `overrides` maps an address, or the name of a parameter alone, to a number, a text or a bool:
    {"contacts.dry.normal.exponent": 1.5, "omega": "20 rad/s"}. Raises UnknownNameError, with the nearest address, for
    one that the file does not have. Keys that a law or shape does not know are reported when they are read.
    """
    for address, value in overrides.items():
        keys = _split_address(root, address)
        text = Text.make_text(_format_as_file_text(value, address), Location(OVERRIDE + address, 1, 1))
        root = _replace_text(root, keys, text, _Address(address, root), MECHANISM_FILE, 0)
    return root


def _split_address(root: Map, address: str) -> list[str]:
    """Return the keys on the path of an address: "start.guess.L7.theta" gives ["start", "guess", "L7.theta"].

    Names of coordinates and points stay whole. The name of a parameter alone is a path in `parameters`.
    """
    if address in root.get("parameters", ()):
        return ["parameters", address]
    field: Field | None = MECHANISM_FILE
    keys = address.split(".")
    for i, key in enumerate(keys):
        if field is not None and field.addresses:
            return [*keys[:i], ".".join(keys[i:])]
        if field is not None and field.keys is not None:  # the rest is the name of a coordinate: L7.theta
            component = keys[-1:] if len(keys) - i > 2 and keys[-1] in _AXES else []  # of a point: upper.P.x
            return [*keys[:i], ".".join(keys[i : len(keys) - len(component)]), *component]
        field = field and field.find_field(key)
    return keys


def _format_as_file_text(value: object, address: str) -> str:
    """Return a value as text, as it would stand in the file.

    Raises BadValueError for other types; `address` is for messages.
    """
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    try:
        if isinstance(value, int) and abs(float(value)) < MAX_EXACT_INTEGER:
            return str(value)
        return repr(float(value))  # type: ignore[arg-type]
    except (TypeError, ValueError):
        message = f"the override of {address} is of type {type(value).__name__}"
        raise BadValueError(message, None, "expected a number, a text or a bool") from None


@dataclass(frozen=True)
class _Address:
    """Represent the address of an override and the file's tree in which it is resolved."""

    text: str
    root: Map

    def make_error(self) -> InputError:
        """Return the UnknownNameError for an address that the file does not have, with the nearest addresses."""
        known_addresses = [*_iterate_addresses(self.root), *self.root.get("parameters", ())]
        return make_unknown_name_error("address", self.text, known_addresses, None)


def _replace_text(node: Any, keys: list[str], text: Text, address: _Address, field: Field | None, depth: int) -> Any:
    """Return a copy of `node`, which `field` declares, with `text` at the path `keys`; other subtrees are shared.

    `field` is None below a list. A key that may be added is created. Raises an InputError for an address that does not
    exist, that of a whole mapping, and a number of a curve or contour.
    """
    if not keys:
        if isinstance(node, (Map, Items)) and not (field is not None and field.kind == RESULTS):
            raise BadValueError(
                f"{address.text} is {describe_node(node)}", None, _format_inner_addresses(address.text, node)
            )
        return text
    first_key, other_keys = keys[0], keys[1:]
    if field is not None and field.kind == POINTS:
        message = f"{address.text} is a number of a curve, and the compiled scene contains its curves"
        raise BadValueError(message, None, "scale the curve by a parameter, or change the curve in the file")
    if field is not None and field.kind == DEPTHS:
        message = f"{address.text} is a depth of a contour: overrides of the structure cannot change depths"
        raise BadValueError(message, None, "pass the depths to the run: contour={joint: depths} of simulate")
    if isinstance(node, Items):
        if first_key not in _AXES or _AXES[first_key] >= len(node):
            raise address.make_error()
        component = _AXES[first_key]
        return Items.make_items(
            [
                *node[:component],
                _replace_text(node[component], other_keys, text, address, None, depth + 1),
                *node[component + 1 :],
            ],
            node.where,
        )
    if not isinstance(node, Map):
        raise address.make_error()
    field_of_child = field and field.find_field(first_key, node)
    if first_key in node:
        key, child = node.find_key(first_key), node[first_key]
    else:
        if (
            not _may_add_key(field, field_of_child, keys, depth)
            or other_keys
            and field_of_child is not None
            and field_of_child.kind in SCALARS
        ):
            raise address.make_error()
        key, child = Text.make_text(first_key, text.where), _make_empty_node(field_of_child, other_keys, text.where)
    return Map.make_map(
        {**node, key: _replace_text(child, other_keys, text, address, field_of_child, depth + 1)}, node.where
    )


def _may_add_key(field: Field | None, field_of_child: Field | None, keys: list[str], depth: int) -> bool:
    """Return whether an override may add the key `keys[0]`, which the file does not have.

    `field` declares the mapping and `field_of_child` its key `keys[0]`; None: not declared. `depth`: number of keys
    before `keys[0]` on the path. At the top of the file, a declared section may be added; a section of named entries
    (`MAPPING`) only if `keys[1]` is an entry that always exists (`given`). Of the named entries of a section only these
    may be added. All keys deeper in the tree may be added; unknown ones are reported when they are read.
    """
    if depth == 0:
        return field_of_child is not None and (
            field_of_child.kind != MAPPING or len(keys) > 1 and keys[1] in field_of_child.given
        )
    return depth > 1 or field is None or field.kind != MAPPING or keys[0] in field.given


def _make_empty_node(field: Field | None, other_keys: list[str], location: Location) -> Any:
    """Return the node in which a new text is put: a vector of zeros, an empty mapping or an empty text.

    `other_keys`: the keys that follow on the path; without any, the node is an empty text. `field` declares the node,
    None for an unknown key; a vector of zeros is made for the component of a vector. `location`: location of the
    override.
    """
    if other_keys and field is not None and field.kind == VECTOR:
        return Items.make_items([Text.make_text("0", location), Text.make_text("0", location)], location)
    return Map.make_map((), location) if other_keys else Text.make_text("", location)


def _iterate_addresses(node: Any, prefix: str = "") -> Iterator[str]:
    """Yield the addresses of all texts in a subtree; `prefix` is the address of its root, "" for the file."""
    if isinstance(node, Map):
        for key, child in node.items():
            yield from _iterate_addresses(child, f"{prefix}.{key}" if prefix else str(key))
    elif isinstance(node, Items):
        for axis, child in zip(_AXES, node, strict=False):
            yield from _iterate_addresses(child, f"{prefix}.{axis}")
    else:
        yield prefix


def _format_inner_addresses(address: str, node: Map | Items) -> str:
    """Return the hint that names addresses inside a mapping or list, at most eight."""
    return f"expected one of: {', '.join(list(_iterate_addresses(node, address))[:8])}"

"""Checks the structure of a mechanism file: which keys exist, and which values are texts, lists or mappings.

Findings are reported as errors at their location. Entries of joints, drives, forces and laws are checked by the reader
once it knows their kind.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from gudgeon.errors import BadValueError, InputError, Location, MissingKeyError, UnknownKeyError, combine_errors
from gudgeon.generator.field import (
    CORNERS,
    DEPTHS,
    KINDS,
    LAW,
    MAPPING,
    PLACE,
    POINTS,
    RECORD,
    RESULTS,
    SCALARS,
    VECTOR,
    Field,
)
from gudgeon.generator.format.sections import FORMAT, MECHANISM_FILE, SECTIONS
from gudgeon.generator.yaml import Items, Map, Text, describe_node
from gudgeon.language.names import find_nearest_name, format_name_hint, make_unknown_name_error

MAX_FINDINGS = 50
OVERRIDE = "override of "  # the "file" of a text that comes from an override
ANY_NAME = "*"  # in `removed_names`: a section was left out whose names are not known

Path = tuple[str | int, ...]
_FOREIGN_SECTIONS = {  # names of other programs for a section
    "links": "bodies",
    "parts": "bodies",
    "constraints": "joints",
    "connections": "joints",
    "motors": "drives",
    "actuators": "drives",
    "springs": "forces",
    "loads": "forces",
    "initial": "start",
    "variables": "parameters",
}
_RUN_OPTIONS = ("method", "rtol", "formulation")  # options of a run, which a file does not contain


@dataclass(frozen=True)
class CheckedTree:
    """Contain the file's tree without the wrong entries, the `errors`, and the names of the entries left out."""

    root: Map
    errors: tuple[InputError, ...] = ()
    removed_names: frozenset[str] = frozenset()


def check_tree_structure(root: Map) -> CheckedTree:
    """Return the valid part of a file's tree and the errors of the rest.

    Empty optional sections count as absent. Entries with errors are removed until no error remains. Raises
    UnknownKeyError, MissingKeyError or BadValueError, or several at once, if a required section is wrong or there are
    too many errors.
    """
    check_format(root)
    # an empty section, for example with all lines commented out, counts as absent
    sections = {
        name: value
        for name, value in root.items()
        if not (isinstance(value, Text) and value.is_null and name in _OPTIONAL_SECTIONS)
    }
    document = Map.make_map(sections, root.where)
    errors: list[InputError] = []
    removed_names: set[str] = set()
    while len(errors) < MAX_FINDINGS:
        structure_errors = list(islice(_find_errors(MECHANISM_FILE, document, ()), MAX_FINDINGS))
        if not structure_errors:
            return CheckedTree(document, tuple(errors), frozenset(removed_names))
        errors += _make_errors(structure_errors, document)
        if any(
            structure_error.path[0] in _REQUIRED_SECTIONS and len(structure_error.path) == 1
            for structure_error in structure_errors
        ):
            break
        for structure_error in structure_errors:
            document = _remove_wrong_entry(document, structure_error, removed_names)
    raise combine_errors(errors)


STUDIES = "gudgeon-study/"  # prefix of the format of study files
_REQUIRED_SECTIONS = frozenset(field.name for field in MECHANISM_FILE.fields if field.required)
_OPTIONAL_SECTIONS = frozenset(
    field.name for field in MECHANISM_FILE.fields if not field.required and field.kind not in SCALARS
)


def check_format(root: Map) -> None:
    """Raise an InputError unless the file's `format` is this version; the message names study files."""
    file_format = root.get("format")
    if file_format is None:
        raise MissingKeyError("no format", root.where, f"expected the key format: {FORMAT}")
    if file_format != FORMAT:
        is_study = isinstance(file_format, Text) and file_format.startswith(STUDIES)
        remark = "; this file is a study: run it with `gudgeon study FILE`" if is_study else ""
        raise BadValueError(f"format is {describe_node(file_format)}", file_format.where, f"expected {FORMAT}{remark}")


@dataclass(frozen=True)
class _StructureError:
    """Represent an error at `path`: a missing key, an unknown key, or a node that is not what was `expected`."""

    path: Path
    expected: str = ""
    known_keys: tuple[str, ...] | None = None  # of an unknown key: those that are allowed instead
    is_missing: bool = False


_TWO_COMPONENTS = "two: [x, y]"


def _find_errors(field: Field, node: Any, path: Path) -> Iterator[_StructureError]:
    """Yield the errors in the shape of a node, in the order of the declaration.

    `field` declares the node at `path`. Inner nodes are checked recursively. Entries whose kind decides on their keys
    (KINDS, LAW) are not checked.
    """
    if field.kind in SCALARS:
        if not isinstance(node, Text):
            yield _StructureError(path, "a number or a text")
    elif field.kind == VECTOR or field.kind == PLACE and isinstance(node, Items):
        yield from _find_errors_in_vector(node, path)
    elif field.kind == POINTS:
        yield from _find_errors_in_points(node, path)
    elif field.kind == DEPTHS:
        if not all(isinstance(item, Text) for item in (node if isinstance(node, Items) else [node])):
            yield _StructureError(path, "depths at equal angles: [0 mm, 0.1 mm, …], or the number of depths")
    elif field.kind == RESULTS:
        if not all(isinstance(item, Text) for item in (node if isinstance(node, Items) else [node])):
            yield _StructureError(path, "a list of names of results: [S9.ay, A.F]")
    elif field.kind == PLACE:
        if not isinstance(node, Text):
            yield _StructureError(path, "a number, or of a point [x, y]")
    elif field.kind == CORNERS:
        if not isinstance(node, Items) or len(node) != 3 or not all(isinstance(item, Text) for item in node):
            yield _StructureError(path, "three points of the body: [P, Q, R]")
    elif not isinstance(node, Map):
        needed = ", ".join(
            f"{inner_field.name}: …"
            for inner_field in field.fields
            if inner_field.required or inner_field.alternative_key
        )
        yield _StructureError(path, f"a mapping: {{{needed}}}" if path and needed else "a mapping")
    elif field.kind == RECORD:
        for inner_field in field.fields:
            if inner_field.name in node:
                yield from _find_errors(inner_field, node[inner_field.name], (*path, inner_field.name))
            elif inner_field.required:
                yield _StructureError((*path, inner_field.name), is_missing=True)
        known_keys = tuple(inner_field.name for inner_field in field.fields)
        yield from (_StructureError((*path, key), known_keys=known_keys) for key in node if key not in known_keys)
    elif field.kind == MAPPING and field.entry is not None:
        for name, entry in node.items():
            yield from _find_errors(field.entry, entry, (*path, name))
    else:
        assert field.kind in (KINDS, LAW)


def _find_errors_in_vector(node: Any, path: Path) -> Iterator[_StructureError]:
    """Yield the errors of a node that must be a list of two texts."""
    if not isinstance(node, Items):
        yield _StructureError(path, "a list of two: [x, y]")
    elif len(node) != 2:
        yield _StructureError(path, _TWO_COMPONENTS)
    else:
        yield from (_StructureError((*path, i), "a number or a text") for i in (0, 1) if not isinstance(node[i], Text))


def _find_errors_in_points(node: Any, path: Path) -> Iterator[_StructureError]:
    """Yield the errors of a node that must be a list of points, each a list of two texts."""
    if not isinstance(node, Items):
        yield _StructureError(path, "a list of points: [[x, y], …]")
    else:
        for i, point in enumerate(node):
            yield from _find_errors_in_vector(point, (*path, i))


def _remove_wrong_entry(document: Map, structure_error: _StructureError, removed_names: set[str]) -> Map:
    """Return the tree without an unknown key, or without the entry that contains an error.

    Names of removed entries are added to `removed_names`; ANY_NAME is added if a section was removed that is not a
    mapping.
    """
    path, section = structure_error.path, SECTIONS.get(str(structure_error.path[0]))
    has_names = section is None or section.kind == MAPPING
    if structure_error.known_keys is None:
        path = path[:2] if section is not None and has_names else path[:1]
        if len(path) == 2:
            removed_names.add(str(path[1]))
    if len(path) == 1 and has_names:
        removed_section = document.get(str(path[0]))
        removed_names.update(removed_section if isinstance(removed_section, Map) else (ANY_NAME,))
    return _remove_node(document, path)


def _remove_node(node: Map, path: Path) -> Map:
    """Return a copy of the mapping without the node at `path`; the mapping itself if there is no such node."""
    first_key, other_keys = str(path[0]), path[1:]
    if first_key not in node or other_keys and not isinstance(node[first_key], Map):
        return node
    if other_keys:
        return Map.make_map({**node, node.find_key(first_key): _remove_node(node[first_key], other_keys)}, node.where)
    return Map.make_map({key: value for key, value in node.items() if key != first_key}, node.where)


def _make_errors(structure_errors: Sequence[_StructureError], document: Map) -> list[InputError]:
    """Return the errors of the structure as input errors with locations.

    A missing key is not reported if the mapping has a key that resembles it.
    """
    paths_of_mistyped_keys = {
        (*structure_error.path[:-1], find_nearest_name(str(structure_error.path[-1]), structure_error.known_keys))
        for structure_error in structure_errors
        if structure_error.known_keys is not None
    }
    return [
        _make_error(structure_error, document)
        for structure_error in structure_errors
        if not (structure_error.is_missing and structure_error.path in paths_of_mistyped_keys)
    ]


def _make_error(structure_error: _StructureError, document: Map) -> InputError:
    """Return the input error of one error of the structure: an unknown key, a missing key, or else a wrong value.

    An empty node has no location; the error has that of its key.
    """
    path, parent_path = structure_error.path, structure_error.path[:-1]
    if structure_error.known_keys is not None:
        key = _find_node(document, parent_path).find_key(str(path[-1]))
        return make_unknown_key_error(
            key,
            structure_error.known_keys,
            _format_address(parent_path),
            _make_hint_for_foreign_key(parent_path, key.lower()),
        )
    if structure_error.is_missing:
        return make_missing_key_error(
            str(path[-1]), _find_node(document, parent_path).where, _format_address(parent_path)
        )
    node = _find_node(document, path)
    location = node.where
    if isinstance(node, Text) and node.is_null and path and isinstance(path[-1], str):
        location = (
            _find_node(document, parent_path).find_key(path[-1]).where
        )  # an empty node has no location: the key's is used
    fault = (
        f"has {len(node)} component{'s' * (len(node) != 1)}"
        if structure_error.expected == _TWO_COMPONENTS
        else f"is {describe_node(node)}"
    )
    return BadValueError(f"{_format_address(path)} {fault}", location, f"expected {structure_error.expected}")


def _make_hint_for_foreign_key(parent_path: Path, key: str) -> str:
    """Return a hint about a key of another program ("links" is called bodies here); "" for any other key.

    `parent_path` is the path of the mapping: sections by other names, and options of a run in `simulate`, have hints.
    """
    if not parent_path and key in _FOREIGN_SECTIONS:
        return f"{key!r} is called {_FOREIGN_SECTIONS[key]} here"
    if parent_path and parent_path[-1] == "simulate" and key in _RUN_OPTIONS:
        return f"{key!r} is an option of gudgeon run, --{key}, and an argument of simulate, not a key of a file"
    return ""


def make_unknown_key_error(key: Text, known_keys: Iterable[str], owner_address: str, hint: str = "") -> InputError:
    """Return the error for a key that its mapping does not know; for the address of an override, UnknownNameError.

    `known_keys` are the allowed keys, `owner_address` is the mapping's address. `hint` replaces the list of the nearest
    keys.
    """
    if key.where.file.startswith(OVERRIDE):
        address = key.where.file.removeprefix(OVERRIDE)
        return make_unknown_name_error(
            "address", address, [f"{address.rpartition('.')[0]}.{name}" for name in known_keys], None
        )
    return UnknownKeyError(
        f"unknown key {str(key)[:60]!r} in {owner_address}", key.where, hint or format_name_hint(key, known_keys, 20)
    )


def make_missing_key_error(name: str, location: Location, owner_address: str) -> MissingKeyError:
    """Return the error for a key that a mapping needs.

    `location` and `owner_address` are the mapping's location and address.
    """
    return MissingKeyError(f"{owner_address} has no {name}", location, f"expected the key {name!r}")


def _format_address(path: Path) -> str:
    """Return a path as an address for messages; "the file" for the root."""
    return ".".join(str(key) for key in path) or "the file"


def _find_node(node: Any, path: Path) -> Any:
    """Return the node at a path, or the text at which the path ends early."""
    for key in path:
        if not isinstance(node, (Map, Items)):
            return node
        node = node[key]  # type: ignore[index]
    return node

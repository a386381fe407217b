"""Checks the shape of a file's tree: which keys exist, and which nodes are texts, lists or mappings.

Findings are reported as errors at their location. Entries of joints, drives, forces and laws are checked by the reader
once it knows their kind.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from gudgeon.errors import BadValueError, InputError, Location, MissingKeyError, UnknownKeyError, together
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
from gudgeon.generator.format.sections import FILE, FORMAT, SECTIONS
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.names import known_hint, nearest, unknown_name

MAX_FINDINGS = 50
OVERRIDE = "override of "  # the "file" of a text that comes from an override
ANY_NAME = "*"  # in `left_out`: a section was left out whose names are not known

Path = tuple[str | int, ...]
_SECTIONS = {  # names of other programs for a section
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
_OPTIONS = ("method", "rtol", "formulation")  # options of a run, which a file does not contain


@dataclass(frozen=True)
class Checked:
    """Contain the file's tree without the wrong entries, the `errors`, and the names of entries that were left out."""

    root: Map
    errors: tuple[InputError, ...] = ()
    left_out: frozenset[str] = frozenset()


def check_shape(root: Map) -> Checked:
    """Return the valid part of a file's tree and the errors of the rest.

    Raises UnknownKeyError, MissingKeyError or BadValueError, or several at once, if nothing can be read.
    """
    check_format(root)
    # an empty section, for example with all lines commented out, counts as absent
    sections = {k: v for k, v in root.items() if not (isinstance(v, Text) and v.is_nothing and k in _MAY_BE_EMPTY)}
    document = Map.make(sections, root.where)
    errors: list[InputError] = []
    left_out: set[str] = set()
    while len(errors) < MAX_FINDINGS:
        findings = list(islice(_findings(FILE, document, ()), MAX_FINDINGS))
        if not findings:
            return Checked(document, tuple(errors), frozenset(left_out))
        errors += _errors(findings, document)
        if any(found.path[0] in _NEEDED and len(found.path) == 1 for found in findings):
            break
        for found in findings:
            document = _leave_out(document, found, left_out)
    raise together(errors)


STUDIES = "gudgeon-study/"  # prefix of the format of study files
_NEEDED = frozenset(field.name for field in FILE.fields if field.required)
_MAY_BE_EMPTY = frozenset(field.name for field in FILE.fields if not field.required and field.kind not in SCALARS)


def check_format(root: Map) -> None:
    """Raise an InputError unless the file's `format` is this version."""
    found = root.get("format")
    if found is None:
        raise MissingKeyError("no format", root.where, f"expected the key format: {FORMAT}")
    if found != FORMAT:
        is_study = isinstance(found, Text) and found.startswith(STUDIES)
        more = "; this file is a study, whose runs `gudgeon study FILE` makes" if is_study else ""
        raise BadValueError(f"format is {kind_of(found)}", found.where, f"expected {FORMAT}{more}")


@dataclass(frozen=True)
class _Finding:
    """Represent an error at `path`: a missing key, an unknown key, or a node that is not what was `expected`."""

    path: Path
    expected: str = ""
    unknown: tuple[str, ...] | None = None  # the keys that are known instead
    missing: bool = False


_TWO = "two: [x, y]"


def _findings(field: Field, node: Any, path: Path) -> Iterator[_Finding]:
    """Yield the errors in the shape of a node, in the order of the declaration."""
    if field.kind in SCALARS:
        if not isinstance(node, Text):
            yield _Finding(path, "a number or a text")
    elif field.kind == VECTOR or field.kind == PLACE and isinstance(node, Items):
        yield from _findings_in_vector(node, path)
    elif field.kind == POINTS:
        yield from _findings_in_points(node, path)
    elif field.kind == DEPTHS:
        if not all(isinstance(item, Text) for item in (node if isinstance(node, Items) else [node])):
            yield _Finding(path, "depths at equal angles: [0 mm, 0.1 mm, …], or how many of them there are")
    elif field.kind == RESULTS:
        if not all(isinstance(item, Text) for item in (node if isinstance(node, Items) else [node])):
            yield _Finding(path, "a list of names of results: [S9.ay, A.F]")
    elif field.kind == PLACE:
        if not isinstance(node, Text):
            yield _Finding(path, "a number, or of a point [x, y]")
    elif field.kind == CORNERS:
        if not isinstance(node, Items) or len(node) != 3 or not all(isinstance(item, Text) for item in node):
            yield _Finding(path, "three points of the body: [P, Q, R]")
    elif not isinstance(node, Map):
        needed = ", ".join(f"{below.name}: …" for below in field.fields if below.required or below.either)
        yield _Finding(path, f"a mapping: {{{needed}}}" if path and needed else "a mapping")
    elif field.kind == RECORD:
        for below in field.fields:
            if below.name in node:
                yield from _findings(below, node[below.name], (*path, below.name))
            elif below.required:
                yield _Finding((*path, below.name), missing=True)
        known = tuple(below.name for below in field.fields)
        yield from (_Finding((*path, key), unknown=known) for key in node if key not in known)
    elif field.kind == MAPPING and field.entry is not None:
        for name, entry in node.items():
            yield from _findings(field.entry, entry, (*path, name))
    else:
        assert field.kind in (KINDS, LAW)


def _findings_in_vector(node: Any, path: Path) -> Iterator[_Finding]:
    """Yield the errors of a node that must be a list of two texts."""
    if not isinstance(node, Items):
        yield _Finding(path, "a list of two: [x, y]")
    elif len(node) != 2:
        yield _Finding(path, _TWO)
    else:
        yield from (_Finding((*path, i), "a number or a text") for i in (0, 1) if not isinstance(node[i], Text))


def _findings_in_points(node: Any, path: Path) -> Iterator[_Finding]:
    """Yield the errors of a node that must be a list of points."""
    if not isinstance(node, Items):
        yield _Finding(path, "a list of points: [[x, y], …]")
    else:
        for i, pair in enumerate(node):
            yield from _findings_in_vector(pair, (*path, i))


def _leave_out(document: Map, finding: _Finding, left_out: set[str]) -> Map:
    """Return the tree without an unknown key, or without the entry that contains an error; names go to `left_out`."""
    path, section = finding.path, SECTIONS.get(str(finding.path[0]))
    has_names = section is None or section.kind == MAPPING
    if finding.unknown is None:
        path = path[:2] if section is not None and has_names else path[:1]
        if len(path) == 2:
            left_out.add(str(path[1]))
    if len(path) == 1 and has_names:
        whole = document.get(str(path[0]))
        left_out.update(whole if isinstance(whole, Map) else (ANY_NAME,))
    return _remove(document, path)


def _remove(node: Map, path: Path) -> Map:
    """Return the mapping without the node at `path`."""
    head, rest = str(path[0]), path[1:]
    if head not in node or rest and not isinstance(node[head], Map):
        return node
    if rest:
        return Map.make({**node, node.key(head): _remove(node[head], rest)}, node.where)
    return Map.make({key: value for key, value in node.items() if key != head}, node.where)


def _errors(findings: Sequence[_Finding], document: Map) -> list[InputError]:
    """Return the findings as errors; a missing key is not reported if a mistyped one stands in its place."""
    mistyped = {(*f.path[:-1], nearest(str(f.path[-1]), f.unknown)) for f in findings if f.unknown is not None}
    return [_error(f, document) for f in findings if not (f.missing and f.path in mistyped)]


def _error(finding: _Finding, document: Map) -> InputError:
    """Return one finding as an error at its location."""
    path, owner = finding.path, finding.path[:-1]
    if finding.unknown is not None:
        key = _node_at(document, owner).key(str(path[-1]))
        return unknown_key(key, finding.unknown, _address(owner), _hint_from_other_programs(owner, key.lower()))
    if finding.missing:
        return missing_key(str(path[-1]), _node_at(document, owner).where, _address(owner))
    node = _node_at(document, path)
    place = node.where
    if isinstance(node, Text) and node.is_nothing and path and isinstance(path[-1], str):
        place = _node_at(document, owner).key(path[-1]).where  # an empty node has no location: the key's is used
    what = f"has {len(node)} component{'s' * (len(node) != 1)}" if finding.expected == _TWO else f"is {kind_of(node)}"
    return BadValueError(f"{_address(path)} {what}", place, f"expected {finding.expected}")


def _hint_from_other_programs(owner: Path, key: str) -> str:
    """Return a hint about a key that other programs use there; "" for a mistyped one."""
    if not owner and key in _SECTIONS:
        return f"{key!r} is called {_SECTIONS[key]} here"
    if owner and owner[-1] == "simulate" and key in _OPTIONS:
        return f"a file has no {key}: it is an option of gudgeon run, --{key}, and an argument of simulate"
    return ""


def unknown_key(key: Text, known: Iterable[str], owner: str, hint: str = "") -> InputError:
    """Return the error for a key that its mapping does not know; for the address of an override, UnknownNameError.

    `hint` replaces the list of the nearest keys.
    """
    if key.where.file.startswith(OVERRIDE):
        address = key.where.file.removeprefix(OVERRIDE)
        return unknown_name("address", address, [f"{address.rpartition('.')[0]}.{name}" for name in known], None)
    return UnknownKeyError(f"unknown key {str(key)[:60]!r} in {owner}", key.where, hint or known_hint(key, known, 20))


def missing_key(name: str, where: Location, owner: str) -> MissingKeyError:
    """Return the error for a key that a mapping needs."""
    return MissingKeyError(f"{owner} has no {name}", where, f"expected the key {name!r}")


def _address(path: Path) -> str:
    """Return a path as an address for messages."""
    return ".".join(str(part) for part in path) or "the file"


def _node_at(node: Any, path: Path) -> Any:
    """Return the node at a path, or the text at which the path ends early."""
    for part in path:
        if not isinstance(node, (Map, Items)):
            return node
        node = node[part]  # type: ignore[index]
    return node

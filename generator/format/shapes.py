"""The check of a file's shape by its declaration: which keys there are, and what is text, list or mapping.

Findings come out as our errors, at the place in the file. What is open to new files (joints, drives, forces, laws)
is some mapping here: the reader checks it, once it knows the kind.
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

MOST_FINDINGS = 50
OVERRIDE = "override of "  # the "file" of a text that comes from an override
ANY_NAME = "*"  # left out is a section whose names nobody knows

Path = tuple[str | int, ...]
_SECTIONS = {  # what others call a section
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
_OPTIONS = ("method", "rtol", "formulation")  # of a run, no part of a file


@dataclass(frozen=True)
class Checked:
    """The file without the entries that are wrong in `errors`; `left_out` are their names."""

    root: Map
    errors: tuple[InputError, ...] = ()
    left_out: frozenset[str] = frozenset()


def check_shape(root: Map) -> Checked:
    """What can be read of a file, and what is wrong with the shape of the rest.

    Raises UnknownKeyError, MissingKeyError, BadValueError, or several at once, if nothing can be read.
    """
    check_format(root)
    # a section with nothing in it (all of it commented out) is as good as none
    sections = {k: v for k, v in root.items() if not (isinstance(v, Text) and v.is_nothing and k in _MAY_BE_EMPTY)}
    document = Map.make(sections, root.where)
    errors: list[InputError] = []
    left_out: set[str] = set()
    while len(errors) < MOST_FINDINGS:
        findings = list(islice(_findings(FILE, document, ()), MOST_FINDINGS))
        if not findings:
            return Checked(document, tuple(errors), frozenset(left_out))
        errors += _errors(findings, document)
        if any(found.path[0] in _NEEDED and len(found.path) == 1 for found in findings):
            break
        for found in findings:
            document = _without(document, found, left_out)
    raise together(errors)


STUDIES = "gudgeon-study/"  # begins the format of files that are read elsewhere
_NEEDED = frozenset(field.name for field in FILE.fields if field.required)
_MAY_BE_EMPTY = frozenset(field.name for field in FILE.fields if not field.required and field.kind not in SCALARS)


def check_format(root: Map) -> None:
    """Raise unless the file says that it is of this format: another version has other keys."""
    found = root.get("format")
    if found is None:
        raise MissingKeyError("no format", root.where, f"expected the key format: {FORMAT}")
    if found != FORMAT:
        is_study = isinstance(found, Text) and found.startswith(STUDIES)
        more = "; this file is a study, whose runs `gudgeon study FILE` makes" if is_study else ""
        raise BadValueError(f"format is {kind_of(found)}", found.where, f"expected {FORMAT}{more}")


@dataclass(frozen=True)
class _Finding:
    """Something wrong at `path`: a key that is missing, one that is unknown, or not what was `wanted`."""

    path: Path
    wanted: str = ""
    unknown: tuple[str, ...] | None = None  # the keys that are known instead
    missing: bool = False


_TWO = "two: [x, y]"


def _findings(field: Field, node: Any, path: Path) -> Iterator[_Finding]:
    """What is wrong in the shape of a node, in the order of the declaration."""
    if field.kind in SCALARS:
        if not isinstance(node, Text):
            yield _Finding(path, "a number or a text")
    elif field.kind == VECTOR or field.kind == PLACE and isinstance(node, Items):
        yield from _in_vector(node, path)
    elif field.kind == POINTS:
        yield from _in_points(node, path)
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


def _in_vector(node: Any, path: Path) -> Iterator[_Finding]:
    if not isinstance(node, Items):
        yield _Finding(path, "a list of two: [x, y]")
    elif len(node) != 2:
        yield _Finding(path, _TWO)
    else:
        yield from (_Finding((*path, i), "a number or a text") for i in (0, 1) if not isinstance(node[i], Text))


def _in_points(node: Any, path: Path) -> Iterator[_Finding]:
    if not isinstance(node, Items):
        yield _Finding(path, "a list of points: [[x, y], …]")
    else:
        for i, pair in enumerate(node):
            yield from _in_vector(pair, (*path, i))


def _without(document: Map, finding: _Finding, left_out: set[str]) -> Map:
    """The file without an unknown key, or without the whole entry in which something is wrong."""
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
    head, rest = str(path[0]), path[1:]
    if head not in node or rest and not isinstance(node[head], Map):
        return node
    if rest:
        return Map.make({**node, node.key(head): _remove(node[head], rest)}, node.where)
    return Map.make({key: value for key, value in node.items() if key != head}, node.where)


def _errors(findings: Sequence[_Finding], document: Map) -> list[InputError]:
    """Our errors; a missing key is not told where a mistyped one stands in its place."""
    mistyped = {(*f.path[:-1], nearest(str(f.path[-1]), f.unknown)) for f in findings if f.unknown is not None}
    return [_error(f, document) for f in findings if not (f.missing and f.path in mistyped)]


def _error(finding: _Finding, document: Map) -> InputError:
    """One finding as an error at its place."""
    path, owner = finding.path, finding.path[:-1]
    if finding.unknown is not None:
        key = _walk(document, owner).key(str(path[-1]))
        return unknown_key(key, finding.unknown, _title(owner), _meant(owner, key.lower()))
    if finding.missing:
        return missing_key(str(path[-1]), _walk(document, owner).where, _title(owner))
    node = _walk(document, path)
    place = node.where
    if isinstance(node, Text) and node.is_nothing and path and isinstance(path[-1], str):
        place = _walk(document, owner).key(path[-1]).where  # nothing has no place of its own
    what = f"has {len(node)} component{'s' * (len(node) != 1)}" if finding.wanted == _TWO else f"is {kind_of(node)}"
    return BadValueError(f"{_title(path)} {what}", place, f"expected {finding.wanted}")


def _meant(owner: Path, key: str) -> str:
    """A hint about a key that other programs have there; "" for what is mistyped."""
    if not owner and key in _SECTIONS:
        return f"{key!r} is called {_SECTIONS[key]} here"
    if owner and owner[-1] == "simulate" and key in _OPTIONS:
        return f"a file has no {key}: it is an option of gudgeon run, --{key}, and an argument of simulate"
    return ""


def unknown_key(key: Text, known: Iterable[str], owner: str, hint: str = "") -> InputError:
    """The error for a key that its mapping does not know; for an override's address, UnknownNameError.

    `hint` says more than the nearest key would.
    """
    if key.where.file.startswith(OVERRIDE):
        address = key.where.file.removeprefix(OVERRIDE)
        return unknown_name("address", address, [f"{address.rpartition('.')[0]}.{name}" for name in known], None)
    return UnknownKeyError(f"unknown key {str(key)[:60]!r} in {owner}", key.where, hint or known_hint(key, known, 20))


def missing_key(name: str, where: Location, owner: str) -> MissingKeyError:
    """The error for a key that a mapping needs."""
    return MissingKeyError(f"{owner} has no {name}", where, f"expected the key {name!r}")


def _title(path: Path) -> str:
    return ".".join(str(part) for part in path) or "the file"


def _walk(node: Any, path: Path) -> Any:
    for part in path:
        if not isinstance(node, (Map, Items)):
            return node
        node = node[part]  # type: ignore[index]
    return node

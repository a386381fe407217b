"""The shapes of a mechanism file: which keys there are, and what is text, list or mapping.

pydantic checks the shapes; its findings come out as our errors, at the place in the file. What is
open to new files (joints, drives, force laws) is a Map here: their own fields say what they hold.
"""

from __future__ import annotations

import types
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, ValidationError, model_validator

from gudgeon.errors import BadValueError, InputError, InputErrors, Location, MissingKeyError, UnknownKeyError
from gudgeon.generator.yaml.tree import Items, Map, Text, kind_of
from gudgeon.language.suggestions import known_hint, nearest, unknown_name

FORMAT = "gudgeon/1"
MOST_FINDINGS = 50
OVERRIDE = "override of "  # the "file" of a text that comes from an override

Pair = Annotated[list[Text], Field(min_length=2, max_length=2)]


class Shape(BaseModel):
    """A mapping with known keys; `where` is its place."""

    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True, frozen=True)
    _where: Location = PrivateAttr()

    @property
    def where(self) -> Location:
        return self._where

    @model_validator(mode="wrap")
    @classmethod
    def _keep_place(cls, data: Any, handler: Callable[[Any], Any]) -> Any:
        made = handler(data)
        if isinstance(data, Map):
            made._where = data.where
        return made


class MaterialShape(Shape):
    E: Text
    nu: Text


class BodyShape(Shape):
    length: Text | None = None
    mass: Text
    inertia: Text
    com: Pair | None = None
    points: dict[Text, Pair] = {}


class StartShape(Shape):
    guess: dict[Text, Text] = {}
    set: dict[Text, Text] = {}
    rates: dict[Text, Text] = {}


class BearingShape(Shape):
    radius: Text
    clearance: Text
    length: Text
    bearing_material: Text
    journal_material: Text


class ContactShape(Shape):
    extends: Text | None = None
    normal: Map | None = None
    friction: Map | None = None
    film: Map | None = None
    transition: Text | None = None
    clip_ratio: Text | None = None
    velocity_floor: Text | None = None


class PlayShape(Shape):
    bearing: Text
    contact: Text


class SimulateShape(Shape):
    t_end: Text | None = None
    output: Text | None = None
    step: Text | None = None


class EventShape(Shape):
    zero: Text
    direction: Text | None = None
    action: Text | None = None


class SceneShape(Shape):
    extends: Text | None = None
    play: dict[Text, PlayShape] = {}
    parameters: dict[Text, Text] = {}
    events: dict[Text, EventShape] = {}
    simulate: SimulateShape | None = None


class FileShape(Shape):
    """The whole file."""

    format: Text
    name: Text
    title: Text | None = None
    gravity: Pair | None = None
    parameters: dict[Text, Text] = {}
    materials: dict[Text, MaterialShape] = {}
    bodies: dict[Text, BodyShape]
    ground: dict[Text, Pair] = {}
    joints: dict[Text, Map] = {}
    drives: dict[Text, Map] = {}
    forces: dict[Text, Map] = {}
    start: StartShape | None = None
    bearings: dict[Text, BearingShape] = {}
    contacts: dict[Text, ContactShape] = {}
    events: dict[Text, EventShape] = {}
    scenes: dict[Text, SceneShape] = {}
    outputs: dict[Text, Text] = {}


@dataclass(frozen=True)
class Checked:
    """The file as typed shapes, without the entries that are wrong in `errors`; `left_out` are their names."""

    shape: FileShape
    errors: tuple[InputError, ...] = ()
    left_out: frozenset[str] = frozenset()


def check_shape(root: Map) -> Checked:
    """What can be read of a file, and what is wrong with the shape of the rest.

    Raises UnknownKeyError, MissingKeyError, BadValueError, or several at once, if nothing can be read.
    """
    check_format(root)
    # a section with nothing in it (all of it commented out) is as good as none
    sections = {k: v for k, v in root.items() if not (isinstance(v, Text) and v.is_nothing and k in _SECTIONS)}
    document = Map.make(sections, root.where)
    errors: list[InputError] = []
    left_out: set[str] = set()
    while len(errors) < MOST_FINDINGS:
        try:
            return Checked(FileShape.model_validate(document), tuple(errors), frozenset(left_out))
        except ValidationError as found:
            findings = _findings(found)
        errors += _errors(findings, document)
        if any(path[0] in _NEEDED and len(path) == 1 for path in (f.path for f in findings) if path):
            break
        for finding in findings:
            document = _without(document, finding, left_out)
    raise errors[0] if len(errors) == 1 else InputErrors(errors)


_NEEDED = ("format", "name", "bodies")
ANY_NAME = "*"  # left out is a section whose names nobody knows


def _without(document: Map, finding: _Finding, left_out: set[str]) -> Map:
    """The file without an unknown key, or without the whole entry in which something is wrong."""
    path = finding.path
    if finding.kind != "extra_forbidden":
        path = path[:2] if get_origin(_annotation(str(path[0]))) is dict else path[:1]
        if len(path) == 2:
            left_out.add(str(path[1]))
    if len(path) == 1:
        section = document.get(str(path[0]))
        left_out.update(section if isinstance(section, Map) else (ANY_NAME,))
    return _remove(document, path)


def _remove(node: Map, path: tuple[Any, ...]) -> Map:
    head, rest = path[0], path[1:]
    if head not in node or rest and not isinstance(node[head], Map):
        return node
    if rest:
        return Map.make({**node, node.key(head): _remove(node[head], rest)}, node.where)
    return Map.make({key: value for key, value in node.items() if key != head}, node.where)


_SECTIONS = frozenset(FileShape.model_fields) - {"format", "name", "title", "bodies"}


def check_format(root: Map) -> None:
    """Raise unless the file says that it is of this format: another version has other keys."""
    found = root.get("format")
    if found is None:
        raise MissingKeyError("no format", root.where, f"expected the key format: {FORMAT}")
    if found != FORMAT:
        raise BadValueError(f"format is {kind_of(found)}", found.where, f"expected {FORMAT}")


@dataclass(frozen=True)
class _Finding:
    """One of pydantic's; `wanted` is the class that it looked for."""

    kind: str
    path: tuple[Any, ...]
    wanted: str


def _findings(found: ValidationError) -> list[_Finding]:
    return [
        _Finding(
            one["type"], tuple(part for part in one["loc"] if part != "[key]"), str(one.get("ctx", {}).get("class", ""))
        )
        for one in found.errors(include_url=False)[:MOST_FINDINGS]
    ]


def _errors(findings: Sequence[_Finding], document: Map) -> list[InputError]:
    """Our errors; a missing key is not told where a mistyped one stands in its place."""
    mistyped = {
        (*f.path[:-1], nearest(str(f.path[-1]), _fields(f.path[:-1]))) for f in findings if f.kind == "extra_forbidden"
    }
    return [
        _translate(f.kind, f.path, f.wanted, document)
        for f in findings
        if not (f.kind == "missing" and f.path in mistyped)
    ]


def _translate(kind: str, path: tuple[Any, ...], wanted: str, document: Map) -> InputError:
    """One finding of pydantic as our error at its place."""
    if kind == "extra_forbidden":
        key = _walk(document, path[:-1]).key(str(path[-1]))
        return unknown_key(key, _fields(path[:-1]), _title(path[:-1]))
    if kind == "missing":
        return missing_key(str(path[-1]), _walk(document, path[:-1]).where, _title(path[:-1]))
    node = _walk(document, path)
    place = node.where
    if isinstance(node, Text) and node.is_nothing and path and isinstance(path[-1], str):
        place = _walk(document, path[:-1]).key(path[-1]).where  # nothing has no place of its own
    what = f"{_title(path)} is {kind_of(node)}"
    if kind in ("too_short", "too_long"):
        return BadValueError(f"{_title(path)} has {len(node)} components", place, "expected two: [x, y]")
    expected = {"dict_type": "a mapping", "model_type": "a mapping", "list_type": "a list of two: [x, y]"}.get(kind)
    if expected is None:  # is_instance_of: Text or Map
        expected = "a mapping" if "Map" in wanted else "a number or a text"
    return BadValueError(what, place, f"expected {expected}")


def unknown_key(key: Text, known: Iterable[str], owner: str) -> InputError:
    """The error for a key that its mapping does not know; for an override's address, UnknownNameError."""
    if key.where.file.startswith(OVERRIDE):
        address = key.where.file.removeprefix(OVERRIDE)
        return unknown_name("address", address, [f"{address.rpartition('.')[0]}.{name}" for name in known], None)
    return UnknownKeyError(f"unknown key {str(key)[:60]!r} in {owner}", key.where, known_hint(key, known, 20))


def missing_key(name: str, where: Location, owner: str) -> MissingKeyError:
    """The error for a key that a mapping needs."""
    return MissingKeyError(f"{owner} has no {name}", where, f"expected the key {name!r}")


def _title(path: tuple[Any, ...]) -> str:
    return ".".join(str(part) for part in path) or "the file"


def _walk(node: Any, path: tuple[Any, ...]) -> Any:
    for part in path:
        if not isinstance(node, (Map, Items)):
            return node
        node = node[part]
    return node


def _fields(path: tuple[Any, ...]) -> list[str]:
    """The keys that the shape at `path` knows."""
    shape: Any = FileShape
    for part in path:
        if isinstance(shape, type) and issubclass(shape, Shape):
            shape = inner(shape.model_fields[part].annotation)
        else:
            shape = inner(get_args(shape)[-1])  # dict[Text, X] -> X
    return list(shape.model_fields) if isinstance(shape, type) and issubclass(shape, Shape) else []


def _annotation(section: str) -> Any:
    field = FileShape.model_fields.get(section)
    return inner(field.annotation) if field else None


def inner(annotation: Any) -> Any:
    """X of `X | None`."""
    if get_origin(annotation) in (Union, types.UnionType):
        return next(a for a in get_args(annotation) if a is not type(None))
    return annotation

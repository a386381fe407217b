"""Drives: an angle, a coordinate or a distance along an expression of t."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from gudgeon.errors import BadValueError, JoinError, Location
from gudgeon.generator.format.sections import COORDINATES
from gudgeon.generator.kinds.drives import DRIVES
from gudgeon.generator.mechanism import GROUND, Drive, PointRef
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import Around, places_of, read_fields, read_kind, refuse_same_body
from gudgeon.generator.reader.places import Places, coordinate_of
from gudgeon.generator.yaml import Map, Text, kind_of
from gudgeon.language.tree import functions
from gudgeon.language.units import Dimension


@dataclass(frozen=True)
class _Target:
    """What a drive prescribes; the same `key` is the same thing."""

    body: str
    reference: str | None
    coordinate: str
    points: tuple[PointRef, ...]
    dimension: Dimension | None  # of its value, where the kind alone does not say it
    key: tuple[str, frozenset[str]]


def read_drives(reader: Reader, root: Map, places: Places) -> dict[str, Drive]:
    """All drives that can be read; no two may prescribe the same thing."""
    drives: dict[str, Drive] = {}
    driven: dict[tuple[str, frozenset[str]], Drive] = {}
    for name, node in root.part("drives").pairs():
        with reader.collect():
            found = _drive(reader, name, node, places)
            if found is None:
                continue
            drive, key = found
            if key in driven:
                other = driven[key]
                message = f"drive {name} prescribes what drive {other.name} at {other.where} prescribes"
                raise JoinError(message, name.where, "expected one drive for one thing")
            drives[str(name)] = driven[key] = drive
    return drives


def _drive(reader: Reader, name: Text, node: Map, places: Places) -> tuple[Drive, tuple[str, frozenset[str]]] | None:
    """A drive and what it prescribes; None if either cannot be read."""
    owner = f"drives.{name}"
    kind, mistyped = read_kind(reader, node, DRIVES, owner)
    target = None
    with reader.collect():
        target = _TARGETS[kind](reader, node, kind, places)
    of = target.dimension if target else None
    fields = [replace(f, dimension=of) if f.any_dimension else f for f in DRIVES[kind].fields]
    value = read_fields(reader, node, fields, Around(owner, mistyped=mistyped)).quantities.get("value")
    if target is None or value is None:
        return None
    if "sign" in functions(value.value):
        raise BadValueError(
            f"{owner}.value jumps where the argument of sign changes its sign",
            value.where,
            "a drive moves without jumps: abs, min, max, ramp, smooth_step and a where whose branches meet have none",
        )
    drive = Drive(
        str(name), str(kind), target.body, target.reference, value, name.where, target.coordinate, target.points
    )
    return drive, target.key


def _angle(reader: Reader, node: Map, kind: Text, places: Places) -> _Target:
    """`L1`, or `[L1, L2]` for the angle of L1 relative to L2."""
    refs = places_of(reader, node, kind, DRIVES[kind].targets, DRIVES[kind].counts, places)
    body, reference = refs[0].body, refs[-1].body if len(refs) == 2 else GROUND
    hint = "expected a body, or a body and its reference"
    if body == GROUND:
        raise JoinError("a drive cannot turn the ground", refs[-1].where, hint)
    if body == reference:
        raise JoinError(f"{body} cannot be driven against itself", refs[-1].where, hint)
    key = ("theta", frozenset((body, reference)))
    return _Target(body, None if reference == GROUND else reference, "theta", (), None, key)


def _coordinate(reader: Reader, node: Map, kind: Text, places: Places) -> _Target:
    """`S9.y`: of the centre of mass, in ground axes."""
    text = node[kind]
    if not isinstance(text, Text) or "." not in text:
        hint = "expected a coordinate: BODY.x, BODY.y or BODY.theta"
        raise BadValueError(f"{kind} is {kind_of(text)}", _place(text, kind), hint)
    dimension = coordinate_of(text, COORDINATES, places, text.where)
    body, _, coordinate = text.partition(".")
    return _Target(body, None, coordinate, (), dimension, (coordinate, frozenset((body, GROUND))))


def _distance(reader: Reader, node: Map, kind: Text, places: Places) -> _Target:
    """`[L1.head, S9.origin]`: of two points of different bodies."""
    refs = places_of(reader, node, kind, DRIVES[kind].targets, DRIVES[kind].counts, places)
    refuse_same_body("a driven distance", refs)
    body = next(ref.body for ref in refs if ref.body != GROUND)
    key = ("distance", frozenset(f"{ref.body}.{ref.point}" for ref in refs))
    return _Target(body, None, "", refs, None, key)


def _place(node: object, kind: Text) -> Location:
    return node.where if isinstance(node, Text) else kind.where


_TARGETS: Mapping[str, Callable[[Reader, Map, Text, Places], _Target]] = {
    "angle": _angle,
    "coordinate": _coordinate,
    "distance": _distance,
}

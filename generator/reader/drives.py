"""Reads drives: a prescribed angle, coordinate or distance as an expression of t."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from gudgeon.errors import BadValueError, JoinError, Location
from gudgeon.generator.format.sections import COORDINATES
from gudgeon.generator.kinds.drives import DRIVES
from gudgeon.generator.mechanism import GROUND, Drive, PointRef
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, check_different_bodies, read_fields, read_kind, read_targets
from gudgeon.generator.reader.point_names import PointNames, find_coordinate_dimension
from gudgeon.generator.yaml import Map, Text, describe_node
from gudgeon.language.tree import list_functions
from gudgeon.language.units import Dimension


@dataclass(frozen=True)
class _Target:
    """Represent what a drive prescribes; two drives with equal `key` prescribe the same quantity."""

    body: str
    reference: str | None
    coordinate: str
    points: tuple[PointRef, ...]
    dimension: Dimension | None  # of the value, if the kind of drive does not determine it
    key: tuple[str, frozenset[str]]


def read_drives(reader: Reader, root: Map, point_names: PointNames) -> dict[str, Drive]:
    """Return all drives by name; drives with errors are left out.

    An error is collected for a drive that prescribes the same quantity as one before it.
    """
    drives: dict[str, Drive] = {}
    drives_by_target: dict[tuple[str, frozenset[str]], Drive] = {}
    for name, node in root.get_mapping("drives").list_entries():
        with reader.collect_errors():
            drive_and_key = _read_drive(reader, name, node, point_names)
            if drive_and_key is None:
                continue
            drive, key = drive_and_key
            if key in drives_by_target:
                other_drive = drives_by_target[key]
                message = (
                    f"drive {name} prescribes the same quantity as drive {other_drive.name} at {other_drive.where}"
                )
                raise JoinError(message, name.where, "expected one drive per quantity")
            drives[str(name)] = drives_by_target[key] = drive
    return drives


def _read_drive(
    reader: Reader, name: Text, node: Map, point_names: PointNames
) -> tuple[Drive, tuple[str, frozenset[str]]] | None:
    """Return one drive with the key of its target, which identifies the prescribed quantity; None if it cannot be read.

    Errors are collected. Raises BadValueError for a value with `sign`, which jumps.
    """
    address = f"drives.{name}"
    kind, mistyped = read_kind(reader, node, DRIVES, address)
    target = None
    with reader.collect_errors():
        target = _TARGET_READERS[kind](reader, node, kind, point_names)
    dimension = target.dimension if target else None
    fields = [replace(f, dimension=dimension) if f.accepts_any_dimension else f for f in DRIVES[kind].fields]
    value = read_fields(reader, node, fields, FieldContext(address, mistyped_keys=mistyped)).quantities.get("value")
    if target is None or value is None:
        return None
    if "sign" in list_functions(value.value):
        raise BadValueError(
            f"{address}.value jumps where the argument of sign changes its sign",
            value.where,
            "expected a value without jumps: abs, min, max, ramp, smooth_step, or a where whose branches meet",
        )
    drive = Drive(
        str(name), str(kind), target.body, target.reference, value, name.where, target.coordinate, target.points
    )
    return drive, target.key


def _read_angle_target(reader: Reader, node: Map, kind: Text, point_names: PointNames) -> _Target:
    """Return the target of an angle drive: `L1`, or `[L1, L2]` for the angle of L1 relative to L2.

    Raises JoinError for the ground and for a body relative to itself.
    """
    references = read_targets(reader, node, kind, DRIVES[kind].targets, DRIVES[kind].counts, point_names)
    body, reference = references[0].body, references[-1].body if len(references) == 2 else GROUND
    hint = "expected a body, or a body and its reference"
    if body == GROUND:
        raise JoinError("a drive cannot turn the ground", references[-1].where, hint)
    if body == reference:
        raise JoinError(f"{body} cannot be driven relative to itself", references[-1].where, hint)
    key = ("theta", frozenset((body, reference)))
    return _Target(body, None if reference == GROUND else reference, "theta", (), None, key)


def _read_coordinate_target(reader: Reader, node: Map, kind: Text, point_names: PointNames) -> _Target:
    """Return the target of a coordinate drive: `S9.y`, of the centre of mass in ground axes.

    Raises BadValueError for a text without a dot, UnknownNameError for an unknown body or coordinate.
    """
    node_of_target = node[kind]
    if not isinstance(node_of_target, Text) or "." not in node_of_target:
        hint = "expected a coordinate: BODY.x, BODY.y or BODY.theta"
        raise BadValueError(f"{kind} is {describe_node(node_of_target)}", _find_location(node_of_target, kind), hint)
    dimension = find_coordinate_dimension(node_of_target, COORDINATES, point_names, node_of_target.where)
    body, _, coordinate = node_of_target.partition(".")
    return _Target(body, None, coordinate, (), dimension, (coordinate, frozenset((body, GROUND))))


def _read_distance_target(reader: Reader, node: Map, kind: Text, point_names: PointNames) -> _Target:
    """Return the target of a distance drive: two points of different bodies, `[L1.head, S9.origin]`.

    The target's body is the first that is not the ground. Raises an InputError for points of the same body.
    """
    references = read_targets(reader, node, kind, DRIVES[kind].targets, DRIVES[kind].counts, point_names)
    check_different_bodies("a driven distance", references)
    body = next(ref.body for ref in references if ref.body != GROUND)
    key = ("distance", frozenset(f"{ref.body}.{ref.point}" for ref in references))
    return _Target(body, None, "", references, None, key)


def _find_location(node: object, key: Text) -> Location:
    """Return the location of a node, or of its key if the node is not a text."""
    return node.where if isinstance(node, Text) else key.where


_TARGET_READERS: Mapping[str, Callable[[Reader, Map, Text, PointNames], _Target]] = {
    "angle": _read_angle_target,
    "coordinate": _read_coordinate_target,
    "distance": _read_distance_target,
}

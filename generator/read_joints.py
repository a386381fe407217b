"""Joints, drives and the start. What a joint's own keys hold is said by its file in generator/joints."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from gudgeon.errors import BadValueError, InputError, JoinError, Location, MissingKeyError, UnknownKeyError
from gudgeon.generator.joints.joint_type import JointField, JointType, joint_types
from gudgeon.generator.mechanism import GROUND, Drive, Joint, PointRef, Quantity, Start, Vector
from gudgeon.generator.names import Namespace, known_hint, unknown_name
from gudgeon.generator.read_bodies import Places
from gudgeon.generator.reading import Reader
from gudgeon.generator.schema import FileShape, missing_key, unknown_key
from gudgeon.generator.units import DIMENSIONLESS, LENGTH, RATE, VELOCITY, Dimension
from gudgeon.generator.yaml_tree import Items, Map, Text, kind_of

DRIVES: Mapping[str, Dimension] = {"angle": DIMENSIONLESS}  # kind -> dimension of `value`
_COORDINATES: Mapping[str, Dimension] = {"x": LENGTH, "y": LENGTH, "theta": DIMENSIONLESS}
_RATES: Mapping[str, Dimension] = {"vx": VELOCITY, "vy": VELOCITY, "omega": RATE}


def read_joints(reader: Reader, shape: FileShape, places: Places, namespace: Namespace) -> dict[str, Joint]:
    """All joints that can be read; the others' errors are collected."""
    joints = {}
    for name, node in shape.joints.items():
        with reader.collect():
            namespace.add(name, "joint", name.where)
        with reader.collect():
            joints[str(name)] = _joint(reader, name, node, places)
    return joints


def _kind(node: Map, known: Iterable[str], also: Iterable[str], owner: str) -> Text:
    """The key that says what kind of thing a mapping is: exactly one."""
    found = [key for key in node.names() if key in known]
    if len(found) == 1:
        return found[0]
    if found:
        raise UnknownKeyError(f"{owner} is both {found[0]} and {found[1]}", found[1].where, "expected one kind")
    strange = next((key for key in node.names() if key not in also), None)
    if strange is None:
        raise MissingKeyError(f"{owner} has no kind", node.where, known_hint("", known))
    raise unknown_key(strange, known, owner)


def _joint(reader: Reader, name: Text, node: Map, places: Places) -> Joint:
    types, owner = joint_types(), f"joints.{name}"
    kind = _kind(node, types, {field.name for of in types.values() for field in of.fields}, owner)
    joint_type = types[kind]
    for key in node.names():
        if key != kind and key not in (field.name for field in joint_type.fields):
            raise unknown_key(key, [kind, *(field.name for field in joint_type.fields)], owner)
    first, second = _points(reader, node[kind], kind, places)
    quantities, vectors, options = _fields(reader, node, joint_type, owner)
    return Joint(str(name), str(kind), first, second, quantities, vectors, options, name.where)


def _points(reader: Reader, node: object, kind: Text, places: Places) -> tuple[PointRef, PointRef]:
    """The two points that a joint joins; both are looked at before an error is raised."""
    if not isinstance(node, Items) or len(node) != 2:
        found = f"{len(node)} points" if isinstance(node, Items) else kind_of(node)
        place = node.where if isinstance(node, Items) else kind.where
        raise BadValueError(f"{kind} joins {found}", place, "expected two points: [L1.head, L2.tail]")
    refs: list[PointRef] = []
    errors: list[InputError] = []
    for item in node:
        try:
            refs.append(places.point(item, item.where))
        except InputError as error:
            errors.append(error)
    if errors:
        reader.errors.extend(errors[:-1])
        raise errors[-1]
    first, second = refs
    if first.body == second.body:
        what = "the ground to the ground" if first.body == GROUND else f"body {first.body} to itself"
        raise JoinError(f"{kind} joins {what}", second.where, "expected points of two different bodies")
    return first, second


def _fields(
    reader: Reader, node: Map, joint_type: JointType, owner: str
) -> tuple[dict[str, Quantity], dict[str, Vector], dict[str, str]]:
    """The joint type's own keys; options are filled in with their defaults."""
    quantities: dict[str, Quantity] = {}
    vectors: dict[str, Vector] = {}
    options: dict[str, str] = {}
    for field in joint_type.fields:
        with reader.collect():
            if field.name not in node:
                if field.required:
                    raise missing_key(field.name, node.where, owner)
                if field.kind == "option":
                    options[field.name] = field.values[0]
            elif field.kind == "quantity":
                text = _text(node[field.name], node.key(field.name), owner)
                quantities[field.name] = reader.quantity(text, f"{owner}.{field.name}", field.dimension)
            elif field.kind == "vector":
                vectors[field.name] = _vector(reader, node, field, owner)
            else:
                text = _text(node[field.name], node.key(field.name), owner)
                if text not in field.values:
                    raise BadValueError(f"{field.name} is {kind_of(text)}", text.where, known_hint(text, field.values))
                options[field.name] = str(text)
    return quantities, vectors, options


def _text(node: object, key: Text, owner: str) -> Text:
    if not isinstance(node, Text):
        raise BadValueError(f"{owner}.{key} is {kind_of(node)}", key.where, "expected a number or a text")
    return node


def _vector(reader: Reader, node: Map, field: JointField, owner: str) -> Vector:
    pair = node[field.name]
    if not isinstance(pair, Items) or len(pair) != 2 or not all(isinstance(item, Text) for item in pair):
        message = f"{owner}.{field.name} is {kind_of(pair)}"
        raise BadValueError(message, node.key(field.name).where, "expected a list of two: [x, y]")
    vector = reader.vector(pair, f"{owner}.{field.name}", field.dimension)
    if field.nonzero:
        reader.vectors_not_zero.append(vector)
    return vector


def read_drives(reader: Reader, shape: FileShape, places: Places, namespace: Namespace) -> dict[str, Drive]:
    """All drives that can be read; no two may prescribe the same angle."""
    drives: dict[str, Drive] = {}
    for name, node in shape.drives.items():
        with reader.collect():
            namespace.add(name, "drive", name.where)
        with reader.collect():
            drive = _drive(reader, name, node, places)
            for other in drives.values():
                if {drive.body, drive.reference} == {other.body, other.reference}:
                    message = f"drive {name} prescribes what drive {other.name} at {other.where} prescribes"
                    raise JoinError(message, name.where, "expected one drive for an angle")
            drives[str(name)] = drive
    return drives


def _drive(reader: Reader, name: Text, node: Map, places: Places) -> Drive:
    owner = f"drives.{name}"
    kind = _kind(node, DRIVES, ("value",), owner)
    for key in node.names():
        if key not in (kind, "value"):
            raise unknown_key(key, (kind, "value"), owner)
    if "value" not in node:
        raise missing_key("value", node.where, owner)
    target = node[kind]
    bodies = target if isinstance(target, Items) else [target]
    if not 1 <= len(bodies) <= 2 or not all(isinstance(body, Text) for body in bodies):
        raise BadValueError(f"{owner}.{kind} is {kind_of(target)}", kind.where, "expected a body, or [body, reference]")
    for body in bodies:
        places.check_body(body, body.where)
    if bodies[0] == GROUND or len({str(body) for body in bodies}) < len(bodies):
        message = (
            "a drive cannot turn the ground" if bodies[0] == GROUND else f"{bodies[0]} cannot be driven against itself"
        )
        raise JoinError(message, bodies[-1].where, "expected a body, or a body and its reference")
    value = reader.quantity(_text(node["value"], node.key("value"), owner), f"{owner}.value", DRIVES[kind], time=True)
    reference = str(bodies[1]) if len(bodies) == 2 and bodies[1] != GROUND else None
    return Drive(str(name), str(kind), str(bodies[0]), reference, value, name.where)


def read_start(reader: Reader, shape: FileShape, places: Places) -> Start:
    """Guesses, exact values and rates of coordinates."""
    if shape.start is None:
        return Start()
    guess = _coordinates(reader, shape.start.guess, "guess", _COORDINATES, places)
    fixed = _coordinates(reader, shape.start.set, "set", _COORDINATES, places)
    rates = _coordinates(reader, shape.start.rates, "rates", _RATES, places)
    for key in shape.start.set:
        if key in guess:
            hint = f"it is guessed at {guess[key].where}; expected one of the two"
            reader.errors.append(BadValueError(f"{str(key)} is set and guessed", key.where, hint))
    return Start(guess, fixed, rates)


def _coordinates(
    reader: Reader, section: Mapping[Text, Text], name: str, known: Mapping[str, Dimension], places: Places
) -> dict[str, Quantity]:
    found = {}
    for key, text in section.items():
        with reader.collect():
            dimension = _coordinate(key, known, places, key.where)
            found[str(key)] = reader.quantity(text, f"start.{name}.{key}", dimension)
    return found


def _coordinate(key: str, known: Mapping[str, Dimension], places: Places, where: Location) -> Dimension:
    """The dimension of "L7.theta"."""
    body, _, coordinate = key.partition(".")
    if body not in places.bodies:
        raise unknown_name("body", body, places.bodies, where)
    if coordinate not in known:
        place = Location(where.file, where.line, where.column + len(body) + 1)
        raise unknown_name(f"coordinate of {body}", coordinate, known, place)
    return known[coordinate]

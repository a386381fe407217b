"""Reads bodies and their points, the ground's points, gravity and the start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from gudgeon.errors import BadValueError
from gudgeon.generator.field import PLACE, Field
from gudgeon.generator.format.sections import BODY, PLAY_START, POINT, POINT_OF_GROUND, SECTIONS, START
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import GROUND, Body, JournalStart, Quantity, Start, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, read_fields, read_vector
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.point_names import PointNames, find_coordinate_dimension
from gudgeon.generator.reader.shapes import MassProperties, read_triangle_points
from gudgeon.generator.yaml import Items, Map, Text
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.tree import Number
from gudgeon.language.units import DIMENSIONLESS, LENGTH

_JOURNAL_KEYS = ("e", "rate")  # keys of the start of a journal in play
_SLIDER_KEYS = ("offset", "tilt", "offset_rate", "tilt_rate")


def read_gravity(reader: Reader, root: Map) -> Vector | None:
    """Return gravity in ground axes (m/s²) as two quantities; None if the file has none."""
    if "gravity" not in root:
        return None
    return read_vector(reader, root["gravity"], root.find_key("gravity"), SECTIONS["gravity"], "gravity")


def read_bodies(reader: Reader, root: Map, materials: Materials) -> dict[str, Body]:
    """Read all bodies by name in the order of the file, which is the order of the coordinates.

    An error is collected if the section is empty; errors of single values are collected as well.
    """
    if not root["bodies"] and not reader.removed_names:
        reader.errors.append(BadValueError("bodies is empty", root.where, "expected at least one body"))
    return {str(name): _read_body(reader, name, body, materials) for name, body in root["bodies"].list_entries()}


def _read_body(reader: Reader, name: Text, node: Map, materials: Materials) -> Body:
    """Return one body: its points, mass, moment of inertia and centre of mass, from numbers or from a shape.

    `inertia: auto` is the moment of inertia of a slender bar. Errors are collected.
    """
    address = f"bodies.{name}"
    is_slender = node.get("inertia") == "auto"
    values = read_fields(
        reader, node, [f for f in BODY.fields if not (is_slender and f.name == "inertia")], FieldContext(address)
    )
    points = read_triangle_points(reader, node, address)
    for point, point_node in node.get_mapping("points").list_entries():
        points[str(point)] = read_vector(reader, point_node, point, POINT, f"{address}.points.{point}")
    mass_properties = MassProperties(reader, address, values, materials)
    with reader.collect_errors():
        if is_slender:
            mass_properties.set_slender_inertia(node["inertia"].where)
        if "shape" in node:
            implied_points = _make_implied_points(mass_properties.length, address, name)
            mass_properties.set_properties_from_shape(
                node.get_mapping("shape"), node.find_key("shape"), {**points, **implied_points}, "inertia" in node
            )
    return Body(
        str(name),
        mass_properties.mass,
        mass_properties.inertia,
        mass_properties.length,
        mass_properties.com,
        points,
        name.where,
        mass_properties.missing_keys,
    )


def _make_implied_points(length: Quantity | None, address: str, name: Text) -> dict[str, Vector]:
    """Return the points that a body has without naming them: {name: vector in the body's frame}.

    Every body has `origin` at (0, 0). A bar also has `tail` at (0, 0) and `head` at (length, 0). `length` is None for a
    body that is not a bar.
    """
    zero = Quantity(f"{address}.origin", Number(0.0, "0"), LENGTH, name.where)
    bar_points = {} if length is None else {"tail": (zero, zero), "head": (length, zero)}
    return {"origin": (zero, zero), **bar_points}


def read_ground(reader: Reader, root: Map) -> dict[str, Vector]:
    """Return the ground's points in ground axes (m) by name."""
    return {
        str(point): read_vector(reader, point_node, point, POINT_OF_GROUND, f"ground.{point}")
        for point, point_node in root.get_mapping("ground").list_entries()
    }


def read_start(reader: Reader, root: Map, point_names: PointNames) -> Start:
    """Return guesses, exact values and rates of coordinates, and the start of journals and sliders in their play.

    An error is collected for a coordinate that is both set and guessed.
    """
    node = root.get_mapping("start")
    fields = [field for field in START.fields if field.keys is not None]
    guesses, fixed, rates = (
        _read_coordinates(reader, node.get_mapping(field.name), field, point_names) for field in fields
    )
    for key, _ in node.get_mapping("set").list_entries():
        if key in guesses:
            hint = f"the guess is at {guesses[key].where}; expected one of the two"
            reader.errors.append(BadValueError(f"{str(key)} is both set and guessed", key.where, hint))
    return Start(guesses, fixed, rates, _read_play_starts(reader, root))


def _read_play_starts(reader: Reader, root: Map) -> dict[str, JournalStart]:
    """Return where journals and sliders with play begin, by joint; every component becomes a run-time parameter.

    A journal begins at an eccentricity, a slider at an offset and a tilt. An error is collected for a joint that does
    not exist or has no play in any scene.
    """
    starts: dict[str, JournalStart] = {}
    joints_with_play = dict.fromkeys(
        name for scene in root.get_mapping("scenes").values() for name in scene.get_mapping("play")
    )
    for joint, node in root.get_mapping("start").get_mapping("play").list_entries():
        with reader.collect_errors():
            if joint not in root.get_mapping("joints"):
                raise make_unknown_name_error("joint", joint, root.get_mapping("joints"), joint.where)
            if (
                joint not in joints_with_play and reader.removed_names
            ):  # the scene that gives it play may have been left out
                continue
            if joint not in joints_with_play:
                hint = (
                    f"expected one of: {', '.join(joints_with_play)}"
                    if joints_with_play
                    else "expected a scene with play: no joint has play"
                )
                raise BadValueError(f"start.play.{joint}: no scene gives {joint} play", joint.where, hint)
            address = f"start.play.{joint}"
            is_slider = _is_slider(root.get_mapping("joints")[joint])
            _check_play_start_keys(joint, node, is_slider)
            values = read_fields(reader, node, PLAY_START.fields, FieldContext(address))
            if is_slider:
                offset, tilt, offset_rate, tilt_rate = (
                    _make_slider_start(reader, values.quantities, name, address, joint) for name in _SLIDER_KEYS
                )
                starts[str(joint)] = JournalStart((offset, tilt), (offset_rate, tilt_rate))
                continue
            fields = (field for field in PLAY_START.fields if field.name in _JOURNAL_KEYS)
            e, rate = (
                _make_journal_start(reader, values.vectors, field, f"{address}.{field.name}", joint) for field in fields
            )
            starts[str(joint)] = JournalStart(e, rate)
    return starts


def _is_slider(node: Map) -> bool:
    """Return whether a joint, given by its node, is of a type whose play is that of a slider in its guide."""
    return any(joint_type.play == "guide" and key in node for key, joint_type in find_joint_types().items())


def _check_play_start_keys(joint: Text, node: Map, is_slider: bool) -> None:
    """Raise BadValueError if a journal's start has a key of a slider's, or the reverse.

    `node` is the start of the joint; `is_slider`: the joint is a slider in a guide.
    """
    for key in node.list_keys():
        if (key in _JOURNAL_KEYS) == is_slider:
            allowed_keys = [field.name for field in PLAY_START.fields if (field.name in _JOURNAL_KEYS) != is_slider]
            phrase = "a slider in its guide" if is_slider else "a journal in its bearing"
            hint = f"expected {', '.join(allowed_keys)}"
            raise BadValueError(f"start.play.{joint}.{key}: {joint} has the play of {phrase}", key.where, hint)


def _make_slider_start(
    reader: Reader, quantities: Mapping[str, Quantity], name: str, address: str, key: Text
) -> Quantity:
    """Return a number of a slider's start as a run-time parameter; 0 if the file does not give it.

    `quantities` are the numbers that the file gives; `address` and `key` are the address and key of the joint's start.
    """
    dimension = next(field.dimension for field in PLAY_START.fields if field.name == name) or DIMENSIONLESS
    zero = Quantity(f"{address}.{name}", Number(0.0, "0"), dimension, key.where)
    return reader.register_quantity(replace(quantities.get(name, zero), is_always_parameter=True))


def _make_journal_start(reader: Reader, vectors: Mapping[str, Vector], field: Field, address: str, key: Text) -> Vector:
    """Return a vector of a journal's start as two run-time parameters; 0 if the file does not give it.

    `vectors` are the vectors that the file gives; `address` is the vector's address, `key` locates a default.
    """
    zero = Quantity("", Number(0.0, "0"), field.dimension or DIMENSIONLESS, key.where)
    x, y = vectors.get(field.name, (replace(zero, address=f"{address}.x"), replace(zero, address=f"{address}.y")))
    return reader.register_quantity(replace(x, is_always_parameter=True)), reader.register_quantity(
        replace(y, is_always_parameter=True)
    )


def _is_point_of_body(key: Text, point_names: PointNames) -> bool:
    """Return whether a key such as "upper.P" names a point of a body."""
    body, _, point = key.partition(".")
    return body in point_names.bodies and point in point_names.list_points(body)


def _read_guessed_point(
    reader: Reader, key: Text, node: Items, address: str, point_names: PointNames
) -> dict[str, Quantity]:
    """Return the guess of a point's position as two coordinates, "upper.P.x" and "upper.P.y", both run-time parameters.

    Raises an InputError for a point of the ground or an unknown name.
    """
    point = point_names.resolve_point(key, key.where)
    if point.body == GROUND:
        raise BadValueError(
            f"{key} is a point of the ground",
            key.where,
            "expected a point of a body: points of the ground need no guess",
        )
    x, y = read_vector(reader, node, key, POINT, address)
    return {
        f"{key}.{axis}": reader.register_quantity(replace(quantity, is_always_parameter=True))
        for axis, quantity in (("x", x), ("y", y))
    }


def _make_hints_for_other_start_keys(key: Text, node: object, field_of_part: Field) -> dict[str, str]:
    """Return hints for coordinates of another part of start: velocities under rates, positions under guess.

    `field_of_part` is the part in which `key` with the node `node` was found; coordinates of that part have no hint.
    """
    body = key.partition(".")[0]
    value = str(node)[:60] if isinstance(node, Text) else "…"
    return {
        coordinate: f"{phrase} under {other_part.name}: start: {{{other_part.name}: {{{body}.{coordinate}: {value}}}}}"
        for other_part, phrase in ((START.fields[2], "velocities belong"), (START.fields[1], "coordinates belong"))
        if other_part.keys != field_of_part.keys
        for coordinate in other_part.keys or {}
    }


def _read_coordinates(reader: Reader, section: Map, field: Field, point_names: PointNames) -> dict[str, Quantity]:
    """Return a part of start, coordinates or velocities of bodies, by key, each as a run-time parameter.

    `field` declares the part. A list [x, y] is the guess of a point. Errors are collected, also for an unknown
    coordinate.
    """
    coordinates: dict[str, Quantity] = {}
    for key, node in section.list_entries():
        with reader.collect_errors():
            if isinstance(node, Items):
                coordinates |= _read_guessed_point(reader, key, node, f"start.{field.name}.{key}", point_names)
                continue
            if field.entry and field.entry.kind == PLACE and _is_point_of_body(key, point_names):
                raise BadValueError(f"{key} is a point", node.where, "expected an approximate position: [x, y]")
            dimension = find_coordinate_dimension(
                key, field.keys or {}, point_names, key.where, _make_hints_for_other_start_keys(key, node, field)
            )
            value = reader.read_quantity(node, f"start.{field.name}.{key}", dimension)
            coordinates[str(key)] = reader.register_quantity(
                replace(value, is_always_parameter=True)
            )  # a literal 0 is a parameter too: no term depends on it
    return coordinates

"""Reads bodies and their points, the ground's points, gravity and the start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from gudgeon.errors import BadValueError
from gudgeon.generator.field import PLACE, Field
from gudgeon.generator.format.sections import BODY, PLAY_START, POINT, POINT_OF_GROUND, SECTIONS, START
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import GROUND, Body, JournalStart, Quantity, Start, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, read_fields, read_vector
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.point_names import PointNames, coordinate_of
from gudgeon.generator.reader.shapes import MassProperties, read_sides
from gudgeon.generator.yaml import Items, Map, Text
from gudgeon.language.names import unknown_name
from gudgeon.language.tree import Number
from gudgeon.language.units import DIMENSIONLESS, LENGTH

_JOURNAL_KEYS = ("e", "rate")  # keys of the start of a journal in play
_OF_SLIDER = ("offset", "tilt", "offset_rate", "tilt_rate")


def read_gravity(reader: Reader, root: Map) -> Vector | None:
    """Return gravity in ground axes (m/s²); None if the file has none."""
    if "gravity" not in root:
        return None
    return read_vector(reader, root["gravity"], root.key("gravity"), SECTIONS["gravity"], "gravity")


def read_bodies(reader: Reader, root: Map, materials: Materials) -> dict[str, Body]:
    """Read all bodies in the order of the file, which is the order of the coordinates."""
    if not root["bodies"] and not reader.left_out:
        reader.errors.append(BadValueError("bodies is empty", root.where, "expected one body at least"))
    return {str(name): _read_body(reader, name, body, materials) for name, body in root["bodies"].pairs()}


def _read_body(reader: Reader, name: Text, node: Map, materials: Materials) -> Body:
    """Read one body: its points, mass, moment of inertia and centre of mass, from numbers or from a shape."""
    address = f"bodies.{name}"
    auto = node.get("inertia") == "auto"
    own = read_fields(
        reader, node, [f for f in BODY.fields if not (auto and f.name == "inertia")], FieldContext(address)
    )
    points = read_sides(reader, node, address)
    for point, pair in node.part("points").pairs():
        points[str(point)] = read_vector(reader, pair, point, POINT, f"{address}.points.{point}")
    mass_properties = MassProperties(reader, address, own, materials)
    with reader.collect():
        if auto:
            mass_properties.set_slender_inertia(node["inertia"].where)
        if "shape" in node:
            implied = _implied_points(mass_properties.length, address, name)
            mass_properties.set_shape(node.part("shape"), node.key("shape"), {**points, **implied}, "inertia" in node)
    return Body(
        str(name),
        mass_properties.mass,
        mass_properties.inertia,
        mass_properties.length,
        mass_properties.com,
        points,
        name.where,
        mass_properties.lacks,
    )


def _implied_points(length: Quantity | None, address: str, name: Text) -> dict[str, Vector]:
    """Return the implied points that a shape may name: the origin, and tail and head of a bar."""
    zero = Quantity(f"{address}.origin", Number(0.0, "0"), LENGTH, name.where)
    bar = {} if length is None else {"tail": (zero, zero), "head": (length, zero)}
    return {"origin": (zero, zero), **bar}


def read_ground(reader: Reader, root: Map) -> dict[str, Vector]:
    """Read the ground's points in ground axes (m) by name."""
    return {
        str(point): read_vector(reader, pair, point, POINT_OF_GROUND, f"ground.{point}")
        for point, pair in root.part("ground").pairs()
    }


def read_start(reader: Reader, root: Map, point_names: PointNames) -> Start:
    """Read guesses, exact values and rates of coordinates, and the start of journals and sliders in their play."""
    node = root.part("start")
    parts = [field for field in START.fields if field.keys is not None]
    guess, fixed, rates = (_read_coordinates(reader, node.part(field.name), field, point_names) for field in parts)
    for key, _ in node.part("set").pairs():
        if key in guess:
            hint = f"it is guessed at {guess[key].where}; expected one of the two"
            reader.errors.append(BadValueError(f"{str(key)} is set and guessed", key.where, hint))
    return Start(guess, fixed, rates, _read_play_starts(reader, root))


def _read_play_starts(reader: Reader, root: Map) -> dict[str, JournalStart]:
    """Read where journals and sliders with play begin, by joint; every component becomes a run-time parameter."""
    found: dict[str, JournalStart] = {}
    able = dict.fromkeys(name for scene in root.part("scenes").values() for name in scene.part("play"))
    for joint, node in root.part("start").part("play").pairs():
        with reader.collect():
            if joint not in root.part("joints"):
                raise unknown_name("joint", joint, root.part("joints"), joint.where)
            if joint not in able and reader.left_out:  # the scene that gives it play may have been left out
                continue
            if joint not in able:
                hint = f"expected one of: {', '.join(able)}" if able else "expected scenes with play: no joint has any"
                raise BadValueError(f"start.play.{joint}: no scene gives {joint} play", joint.where, hint)
            address = f"start.play.{joint}"
            slides = _is_slider(root.part("joints")[joint])
            _check_play_keys(joint, node, slides)
            own = read_fields(reader, node, PLAY_START.fields, FieldContext(address))
            if slides:
                offset, tilt, offset_rate, tilt_rate = (
                    _start_number(reader, own.quantities, name, address, joint) for name in _OF_SLIDER
                )
                found[str(joint)] = JournalStart((offset, tilt), (offset_rate, tilt_rate))
                continue
            fields = (field for field in PLAY_START.fields if field.name in _JOURNAL_KEYS)
            e, rate = (_start_vector(reader, own.vectors, field, f"{address}.{field.name}", joint) for field in fields)
            found[str(joint)] = JournalStart(e, rate)
    return found


def _is_slider(node: Map) -> bool:
    """Return whether the play of a joint is that of a slider in its guide."""
    return any(kind.play == "guide" and key in node for key, kind in joint_types().items())


def _check_play_keys(joint: Text, node: Map, slides: bool) -> None:
    """Raise BadValueError if a journal's start has a key of a slider's, or the reverse."""
    for key in node.names():
        if (key in _JOURNAL_KEYS) == slides:
            expected = [field.name for field in PLAY_START.fields if (field.name in _JOURNAL_KEYS) != slides]
            what = "a slider in its guide" if slides else "a journal in its bearing"
            hint = f"expected {', '.join(expected)}"
            raise BadValueError(f"start.play.{joint}.{key}: {joint} has the play of {what}", key.where, hint)


def _start_number(reader: Reader, own: Mapping[str, Quantity], name: str, address: str, key: Text) -> Quantity:
    """Return a number of a slider's start as a run-time parameter; 0 if the file does not give it."""
    dimension = next(field.dimension for field in PLAY_START.fields if field.name == name) or DIMENSIONLESS
    zero = Quantity(f"{address}.{name}", Number(0.0, "0"), dimension, key.where)
    return reader.keep(replace(own.get(name, zero), kept=True))


def _start_vector(reader: Reader, own: Mapping[str, Vector], field: Field, address: str, key: Text) -> Vector:
    """Return a vector of a journal's start as two run-time parameters; 0 if the file does not give it."""
    zero = Quantity("", Number(0.0, "0"), field.dimension or DIMENSIONLESS, key.where)
    x, y = own.get(field.name, (replace(zero, address=f"{address}.x"), replace(zero, address=f"{address}.y")))
    return reader.keep(replace(x, kept=True)), reader.keep(replace(y, kept=True))


def _is_point(key: Text, point_names: PointNames) -> bool:
    """Return whether a key such as "upper.P" names a point of a body."""
    body, _, point = key.partition(".")
    return body in point_names.bodies and point in point_names.points(body)


def _read_guessed_point(
    reader: Reader, key: Text, pair: Items, address: str, point_names: PointNames
) -> dict[str, Quantity]:
    """Return the guess of a point's position as two coordinates, "upper.P.x" and "upper.P.y"."""
    ref = point_names.point(key, key.where)
    if ref.body == GROUND:
        raise BadValueError(f"{key} rests", key.where, "expected a point of a body: those of the ground need no guess")
    x, y = read_vector(reader, pair, key, POINT, address)
    return {f"{key}.{axis}": reader.keep(replace(part, kept=True)) for axis, part in (("x", x), ("y", y))}


def _hints_for_other_parts(key: Text, text: object, declared: Field) -> dict[str, str]:
    """Return hints for coordinates of another part of start: velocities under rates, positions under guess."""
    body = key.partition(".")[0]
    value = str(text)[:60] if isinstance(text, Text) else "…"
    return {
        coordinate: f"{what} under {part.name}: start: {{{part.name}: {{{body}.{coordinate}: {value}}}}}"
        for part, what in ((START.fields[2], "velocities stand"), (START.fields[1], "coordinates stand"))
        if part.keys != declared.keys
        for coordinate in part.keys or {}
    }


def _read_coordinates(reader: Reader, section: Map, declared: Field, point_names: PointNames) -> dict[str, Quantity]:
    """Read a part of start: coordinates or velocities of bodies by key, each as a run-time parameter."""
    found: dict[str, Quantity] = {}
    for key, text in section.pairs():
        with reader.collect():
            if isinstance(text, Items):
                found |= _read_guessed_point(reader, key, text, f"start.{declared.name}.{key}", point_names)
                continue
            if declared.entry and declared.entry.kind == PLACE and _is_point(key, point_names):
                raise BadValueError(f"{key} is a point", text.where, "expected where it is about: [x, y]")
            dimension = coordinate_of(
                key, declared.keys or {}, point_names, key.where, _hints_for_other_parts(key, text, declared)
            )
            value = reader.quantity(text, f"start.{declared.name}.{key}", dimension)
            found[str(key)] = reader.keep(
                replace(value, kept=True)
            )  # a literal 0 is a parameter too: no term depends on it
    return found

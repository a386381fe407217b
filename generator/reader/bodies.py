"""Bodies, their points, the ground's points and gravity; the start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from gudgeon.errors import BadValueError
from gudgeon.generator.field import PLACE, Field
from gudgeon.generator.format.sections import APART, BODY, POINT, POINT_OF_GROUND, SECTIONS, START
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import GROUND, Body, JournalStart, Quantity, Start, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import Around, read_fields, read_vector
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.places import Places, coordinate_of
from gudgeon.generator.reader.shapes import Weighed, read_sides
from gudgeon.generator.yaml import Items, Map, Text
from gudgeon.language.names import unknown_name
from gudgeon.language.tree import Number
from gudgeon.language.units import DIMENSIONLESS, LENGTH

_OF_JOURNAL = ("e", "rate")  # keys of a start in play
_OF_SLIDER = ("offset", "tilt", "offset_rate", "tilt_rate")


def read_gravity(reader: Reader, root: Map) -> Vector | None:
    """Gravity in ground axes; None if the file has none."""
    if "gravity" not in root:
        return None
    return read_vector(reader, root["gravity"], root.key("gravity"), SECTIONS["gravity"], "gravity")


def read_bodies(reader: Reader, root: Map, materials: Materials) -> dict[str, Body]:
    """All bodies, in the order of the file: it is the order of the coordinates."""
    if not root["bodies"] and not reader.left_out:
        reader.errors.append(BadValueError("bodies is empty", root.where, "expected one body at least"))
    return {str(name): _body(reader, name, body, materials) for name, body in root["bodies"].pairs()}


def _body(reader: Reader, name: Text, node: Map, materials: Materials) -> Body:
    address = f"bodies.{name}"
    auto = node.get("inertia") == "auto"
    own = read_fields(reader, node, [f for f in BODY.fields if not (auto and f.name == "inertia")], Around(address))
    points = read_sides(reader, node, address)
    for point, pair in node.part("points").pairs():
        points[str(point)] = read_vector(reader, pair, point, POINT, f"{address}.points.{point}")
    weighed = Weighed(reader, address, own, materials)
    with reader.collect():
        if auto:
            weighed.slender(node["inertia"].where)
        if "shape" in node:
            implied = _implied(weighed.length, address, name)
            weighed.shaped(node.part("shape"), node.key("shape"), {**points, **implied}, "inertia" in node)
    return Body(
        str(name), weighed.mass, weighed.inertia, weighed.length, weighed.com, points, name.where, weighed.lacks
    )


def _implied(length: Quantity | None, address: str, name: Text) -> dict[str, Vector]:
    """The points that a shape may name beside the file's: all but the centre of mass."""
    zero = Quantity(f"{address}.origin", Number(0.0, "0"), LENGTH, name.where)
    bar = {} if length is None else {"tail": (zero, zero), "head": (length, zero)}
    return {"origin": (zero, zero), **bar}


def read_ground(reader: Reader, root: Map) -> dict[str, Vector]:
    """The ground's points, in ground axes."""
    return {
        str(point): read_vector(reader, pair, point, POINT_OF_GROUND, f"ground.{point}")
        for point, pair in root.part("ground").pairs()
    }


def read_start(reader: Reader, root: Map, places: Places) -> Start:
    """Guesses, exact values and rates of coordinates, and where journals begin."""
    node = root.part("start")
    parts = [field for field in START.fields if field.keys is not None]
    guess, fixed, rates = (_coordinates(reader, node.part(field.name), field, places) for field in parts)
    for key, _ in node.part("set").pairs():
        if key in guess:
            hint = f"it is guessed at {guess[key].where}; expected one of the two"
            reader.errors.append(BadValueError(f"{str(key)} is set and guessed", key.where, hint))
    return Start(guess, fixed, rates, _journals(reader, root))


def _journals(reader: Reader, root: Map) -> dict[str, JournalStart]:
    """Where journals begin, of joints that some scene gives play. Every component is a number of the run."""
    found: dict[str, JournalStart] = {}
    able = dict.fromkeys(name for scene in root.part("scenes").values() for name in scene.part("play"))
    for joint, node in root.part("start").part("play").pairs():
        with reader.collect():
            if joint not in root.part("joints"):
                raise unknown_name("joint", joint, root.part("joints"), joint.where)
            if joint not in able and reader.left_out:  # it may be its scene whose shape is wrong
                continue
            if joint not in able:
                hint = f"expected one of: {', '.join(able)}" if able else "expected scenes with play: no joint has any"
                raise BadValueError(f"start.play.{joint}: no scene gives {joint} play", joint.where, hint)
            address = f"start.play.{joint}"
            slides = _slides(root.part("joints")[joint])
            _check_apart(joint, node, slides)
            own = read_fields(reader, node, APART.fields, Around(address))
            if slides:
                offset, tilt, offset_rate, tilt_rate = (
                    _kept_number(reader, own.quantities, name, address, joint) for name in _OF_SLIDER
                )
                found[str(joint)] = JournalStart((offset, tilt), (offset_rate, tilt_rate))
                continue
            fields = (field for field in APART.fields if field.name in _OF_JOURNAL)
            e, rate = (_kept(reader, own.vectors, field, f"{address}.{field.name}", joint) for field in fields)
            found[str(joint)] = JournalStart(e, rate)
    return found


def _slides(node: Map) -> bool:
    """Whether a joint's play is that of a slider in its guide."""
    return any(kind.play == "guide" and key in node for key, kind in joint_types().items())


def _check_apart(joint: Text, node: Map, slides: bool) -> None:
    """Raise for a journal's key of a slider, and the other way round."""
    for key in node.names():
        if (key in _OF_JOURNAL) == slides:
            expected = [field.name for field in APART.fields if (field.name in _OF_JOURNAL) != slides]
            what = "a slider in its guide" if slides else "a journal in its bearing"
            hint = f"expected {', '.join(expected)}"
            raise BadValueError(f"start.play.{joint}.{key}: {joint} has the play of {what}", key.where, hint)


def _kept_number(reader: Reader, own: Mapping[str, Quantity], name: str, address: str, key: Text) -> Quantity:
    """A number of the run; 0 where the file has none."""
    dimension = next(field.dimension for field in APART.fields if field.name == name) or DIMENSIONLESS
    zero = Quantity(f"{address}.{name}", Number(0.0, "0"), dimension, key.where)
    return reader.keep(replace(own.get(name, zero), kept=True))


def _kept(reader: Reader, own: Mapping[str, Vector], field: Field, address: str, key: Text) -> Vector:
    """Two numbers of the run; 0 where the file has none."""
    zero = Quantity("", Number(0.0, "0"), field.dimension or DIMENSIONLESS, key.where)
    x, y = own.get(field.name, (replace(zero, address=f"{address}.x"), replace(zero, address=f"{address}.y")))
    return reader.keep(replace(x, kept=True)), reader.keep(replace(y, kept=True))


def _is_point(key: Text, places: Places) -> bool:
    body, _, point = key.partition(".")
    return body in places.bodies and point in places.points(body)


def _guessed_point(reader: Reader, key: Text, pair: Items, address: str, places: Places) -> dict[str, Quantity]:
    """A point of a body as two guesses, "upper.P.x" and "upper.P.y"."""
    ref = places.point(key, key.where)
    if ref.body == GROUND:
        raise BadValueError(f"{key} rests", key.where, "expected a point of a body: those of the ground need no guess")
    x, y = read_vector(reader, pair, key, POINT, address)
    return {f"{key}.{axis}": reader.keep(replace(part, kept=True)) for axis, part in (("x", x), ("y", y))}


def _in_other_parts(key: Text, text: object, declared: Field) -> dict[str, str]:
    """What to write for coordinates that stand in another part of start: velocities under rates, and back."""
    body = key.partition(".")[0]
    value = str(text)[:60] if isinstance(text, Text) else "…"
    return {
        coordinate: f"{what} under {part.name}: start: {{{part.name}: {{{body}.{coordinate}: {value}}}}}"
        for part, what in ((START.fields[2], "velocities stand"), (START.fields[1], "coordinates stand"))
        if part.keys != declared.keys
        for coordinate in part.keys or {}
    }


def _coordinates(reader: Reader, section: Map, declared: Field, places: Places) -> dict[str, Quantity]:
    found: dict[str, Quantity] = {}
    for key, text in section.pairs():
        with reader.collect():
            if isinstance(text, Items):
                found |= _guessed_point(reader, key, text, f"start.{declared.name}.{key}", places)
                continue
            if declared.entry and declared.entry.kind == PLACE and _is_point(key, places):
                raise BadValueError(f"{key} is a point", text.where, "expected where it is about: [x, y]")
            dimension = coordinate_of(key, declared.keys or {}, places, key.where, _in_other_parts(key, text, declared))
            value = reader.quantity(text, f"start.{declared.name}.{key}", dimension)
            found[str(key)] = reader.keep(replace(value, kept=True))  # it stands in no equation that 0 would shorten
    return found

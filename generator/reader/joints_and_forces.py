"""Joints and force elements. What a joint's own keys hold is said by its file in generator/kinds/joints."""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import BadNameError, BadValueError, ExpressionError, JoinError
from gudgeon.generator.field import BODY, OF_CAM_ANGLE
from gudgeon.generator.kinds.forces.force_type import element_types
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import ForceElement, Joint, Quantity
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import Around, places_of, read_fields, read_kind, refuse_same_body
from gudgeon.generator.reader.places import Places
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.functions import PIECEWISE
from gudgeon.language.parser import at
from gudgeon.language.tree import Number, functions, names


def read_joints(reader: Reader, root: Map, places: Places) -> dict[str, Joint]:
    """All joints that can be read; the others' errors are collected."""
    joints = {}
    for name, node in root.part("joints").pairs():
        with reader.collect():
            joints[str(name)] = _joint(reader, name, node, places, _in_scenes(name, node, root))
    return joints


def _in_scenes(joint: Text, node: Map, root: Map) -> Mapping[str, str]:
    """What to write for a joint's play, which stands in scenes, by the keys that one may try."""
    slides = any(kind.play == "guide" and key in node for key, kind in joint_types().items())
    measured = "guide" if slides else "bearing"
    measures, contact = (next(iter(root.part(f"{what}s")), _PLAY[what]) for what in (measured, "contact"))
    line = f"scenes: {{worn: {{play: {{{joint}: {{{measured}: {measures}, contact: {contact}}}}}}}}}"
    return dict.fromkeys(("play", "clearance", "bearing", "guide", "contact"), f"play stands in scenes: {line}")


_PLAY = {"bearing": "pin", "guide": "way", "contact": "metal"}


def _joint(reader: Reader, name: Text, node: Map, places: Places, elsewhere: Mapping[str, str]) -> Joint:
    owner = f"joints.{name}"
    kind, mistyped = read_kind(reader, node, joint_types(), owner, elsewhere)
    joint_type = joint_types()[kind]
    values = read_fields(reader, node, joint_type.fields, Around(owner, mistyped=mistyped, places=places))
    first, second = places_of(reader, node, kind, joint_type.joins, (2,), places)
    refuse_same_body(kind, (first, second))
    for field in joint_type.fields:
        if field.varies == OF_CAM_ANGLE and field.name in values.quantities:
            with reader.collect():
                _check_profile(reader, values.quantities[field.name])
    for field in joint_type.fields:
        if field.kind == BODY and values.options.get(field.name) in (first.body, second.body):
            body = values.options[field.name]
            place = node[field.name].where if field.name in node else kind.where
            raise JoinError(f"{body} is one of the two bodies and their {field.name}", place, "expected a third one")
    return Joint(str(name), str(kind), first, second, values.quantities, values.vectors, values.words(), name.where)


def _check_profile(reader: Reader, profile: Quantity) -> None:
    """Raise unless a cam's profile is a function of phi without jumps of its slope."""
    if isinstance(profile.value, Number) and profile.value.value != profile.value.value:
        return  # NaN: an error was collected already
    used = {name.path: at(profile.where, name.offset) for name in names(profile.value)}
    if OF_CAM_ANGLE in reader.parameters and OF_CAM_ANGLE in used:
        hint = "give the parameter another name"
        raise BadNameError("'phi' is the cam's angle here, and a parameter of this file", used[OF_CAM_ANGLE], hint)
    strange = next((path for path in used if path not in (OF_CAM_ANGLE, *reader.parameters)), None)
    if strange is not None:
        hint = "expected phi, the cam's angle, parameters and curves"
        raise ExpressionError(f"{strange!r} cannot stand in the profile of a cam", profile.where, hint)
    if OF_CAM_ANGLE not in used:
        hint = "expected an expression such as 30 mm + lift(phi)"
        raise ExpressionError(f"{profile.address} does not follow phi, the cam's angle", profile.where, hint)
    if jumps := sorted(PIECEWISE.intersection(functions(profile.value))):
        hint = "expected curves (extrapolate: none, or ends: periodic) and smooth functions: the slope is a speed"
        raise BadValueError(f"{profile.address} has a slope that may jump, by {jumps[0]}", profile.where, hint)


def read_forces(reader: Reader, root: Map, places: Places) -> dict[str, ForceElement]:
    """All force elements that can be read."""
    forces = {}
    for name, node in root.part("forces").pairs():
        with reader.collect():
            forces[str(name)] = _force(reader, name, node, places)
    return forces


def _force(reader: Reader, name: Text, node: Map, places: Places) -> ForceElement:
    owner = f"forces.{name}"
    kind, mistyped = read_kind(reader, node, element_types(), owner)
    element = element_types()[kind]
    values = read_fields(reader, node, element.fields, Around(owner, mistyped=mistyped, places=places))
    targets = places_of(reader, node, kind, element.targets, element.counts, places)
    refuse_same_body(kind, targets)
    return ForceElement(str(name), str(kind), targets, values.quantities, values.vectors, values.words(), name.where)

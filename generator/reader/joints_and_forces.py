"""Reads joints and force elements; the keys of a joint type are declared in its file in generator/kinds/joints."""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import BadNameError, BadValueError, ExpressionError, JoinError
from gudgeon.generator.field import BODY, OF_CAM_ANGLE
from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import ForceElement, Joint, Quantity
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, check_different_bodies, read_fields, read_kind, read_targets
from gudgeon.generator.reader.point_names import PointNames
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.functions import PIECEWISE
from gudgeon.language.parser import offset_location
from gudgeon.language.tree import Number, iterate_names, list_functions


def read_joints(reader: Reader, root: Map, point_names: PointNames) -> dict[str, Joint]:
    """Return the section `joints:` by name; errors are collected in the reader, and joints with errors are left out."""
    joints = {}
    for name, node in root.get_mapping("joints").list_entries():
        with reader.collect_errors():
            joints[str(name)] = _read_joint(reader, name, node, point_names, _make_play_hints(name, node, root))
    return joints


def _make_play_hints(joint: Text, node: Map, root: Map) -> Mapping[str, str]:
    """Return the hint for each of the keys `clearance`, `bearing`, … in a joint: the play that belongs into a scene.

    The hint is an example with the file's first bearing, or guide for a slider, and its first contact.
    """
    is_slider = any(joint_type.play == "guide" and key in node for key, joint_type in find_joint_types().items())
    dimensions_key = "guide" if is_slider else "bearing"
    dimensions_name, contact = (
        next(iter(root.get_mapping(f"{section}s")), _EXAMPLE_NAMES[section]) for section in (dimensions_key, "contact")
    )
    example = f"scenes: {{worn: {{play: {{{joint}: {{{dimensions_key}: {dimensions_name}, contact: {contact}}}}}}}}}"
    return dict.fromkeys(("play", "clearance", "bearing", "guide", "contact"), f"play belongs in scenes: {example}")


_EXAMPLE_NAMES = {"bearing": "pin", "guide": "way", "contact": "metal"}


def _read_joint(reader: Reader, name: Text, node: Map, point_names: PointNames, hints: Mapping[str, str]) -> Joint:
    """Return one joint; `hints` maps keys that belong into other sections to hints.

    Errors of its numbers are collected. Raises an InputError if its bodies or its profile are not allowed.
    """
    address = f"joints.{name}"
    kind, mistyped = read_kind(reader, node, find_joint_types(), address, hints)
    joint_type = find_joint_types()[kind]
    values = read_fields(
        reader, node, joint_type.fields, FieldContext(address, mistyped_keys=mistyped, point_names=point_names)
    )
    first, second = read_targets(reader, node, kind, joint_type.joins, (2,), point_names)
    check_different_bodies(kind, (first, second))
    for field in joint_type.fields:
        if field.varies == OF_CAM_ANGLE and field.name in values.quantities:
            with reader.collect_errors():
                _check_cam_profile(reader, values.quantities[field.name])
    for field in joint_type.fields:
        if field.kind == BODY and values.options.get(field.name) in (first.body, second.body):
            body = values.options[field.name]
            location = node[field.name].where if field.name in node else kind.where
            raise JoinError(
                f"{body} is one of the two bodies and also their {field.name}", location, "expected a third body"
            )
    return Joint(
        str(name), str(kind), first, second, values.quantities, values.vectors, values.format_options(), name.where
    )


def _check_cam_profile(reader: Reader, profile: Quantity) -> None:
    """Raise an InputError unless a cam's profile is a function of phi with a continuous slope.

    Nothing is checked if the profile could not be read. Raises BadNameError if a parameter of the file is called phi.
    """
    if isinstance(profile.value, Number) and profile.value.value != profile.value.value:
        return  # NaN: reported already
    locations = {name.path: offset_location(profile.where, name.offset) for name in iterate_names(profile.value)}
    if OF_CAM_ANGLE in reader.parameters and OF_CAM_ANGLE in locations:
        hint = "give the parameter another name"
        raise BadNameError("'phi' is the cam's angle here, and a parameter of this file", locations[OF_CAM_ANGLE], hint)
    unknown = next((path for path in locations if path not in (OF_CAM_ANGLE, *reader.parameters)), None)
    if unknown is not None:
        hint = "expected phi, the cam's angle, parameters and curves"
        raise ExpressionError(f"{unknown!r} is not allowed in the profile of a cam", profile.where, hint)
    if OF_CAM_ANGLE not in locations:
        hint = "expected an expression such as 30 mm + lift(phi)"
        raise ExpressionError(f"{profile.address} does not depend on phi, the cam's angle", profile.where, hint)
    if piecewise_functions := sorted(PIECEWISE.intersection(list_functions(profile.value))):
        hint = (
            "expected curves (extrapolate: none, or ends: periodic) and smooth functions: a jump of the "
            "slope is a jump of the speed"
        )
        raise BadValueError(
            f"{profile.address} has a slope that may jump, because of {piecewise_functions[0]}", profile.where, hint
        )


def read_forces(reader: Reader, root: Map, point_names: PointNames) -> dict[str, ForceElement]:
    """Return the section `forces:` by name; errors are collected in the reader, elements with errors are left out."""
    forces = {}
    for name, node in root.get_mapping("forces").list_entries():
        with reader.collect_errors():
            forces[str(name)] = _read_force(reader, name, node, point_names)
    return forces


def _read_force(reader: Reader, name: Text, node: Map, point_names: PointNames) -> ForceElement:
    """Return one force element; errors of its numbers are collected.

    Raises an InputError if its targets are not allowed.
    """
    address = f"forces.{name}"
    kind, mistyped = read_kind(reader, node, find_element_types(), address)
    element_type = find_element_types()[kind]
    values = read_fields(
        reader, node, element_type.fields, FieldContext(address, mistyped_keys=mistyped, point_names=point_names)
    )
    targets = read_targets(reader, node, kind, element_type.targets, element_type.counts, point_names)
    check_different_bodies(kind, targets)
    return ForceElement(
        str(name), str(kind), targets, values.quantities, values.vectors, values.format_options(), name.where
    )

"""Joints. What a joint's own keys hold is said by its file in generator/joints."""

from __future__ import annotations

from gudgeon.errors import JoinError
from gudgeon.generator.joints.joint_type import joint_types
from gudgeon.generator.mechanism import Joint
from gudgeon.generator.names import Namespace
from gudgeon.generator.read_bodies import Places
from gudgeon.generator.read_fields import (
    all_names,
    check_keys,
    field_names,
    kind_key,
    places_of,
    read_fields,
    refuse_same_body,
)
from gudgeon.generator.reading import Reader
from gudgeon.generator.schema import FileShape
from gudgeon.generator.yaml_tree import Map, Text


def read_joints(reader: Reader, shape: FileShape, places: Places, namespace: Namespace) -> dict[str, Joint]:
    """All joints that can be read; the others' errors are collected."""
    joints = {}
    for name, node in shape.joints.items():
        with reader.collect():
            namespace.add(name, "joint", name.where)
        with reader.collect():
            joints[str(name)] = _joint(reader, name, node, places)
    return joints


def _joint(reader: Reader, name: Text, node: Map, places: Places) -> Joint:
    types, owner = joint_types(), f"joints.{name}"
    kind = kind_key(node, types, all_names({k: of.fields for k, of in types.items()}), owner)
    joint_type = types[kind]
    mistyped = check_keys(reader, node, [kind, *field_names(joint_type.fields)], owner)
    first, second = places_of(reader, node, kind, joint_type.joins, (2,), places)
    refuse_same_body(kind, (first, second))
    values = read_fields(reader, node, joint_type.fields, owner, places, mistyped)
    for field in joint_type.fields:
        if field.kind == "body" and values.options.get(field.name) in (first.body, second.body):
            body = values.options[field.name]
            place = node[field.name].where if field.name in node else kind.where
            raise JoinError(f"{body} is one of the two bodies and their {field.name}", place, "expected a third one")
    return Joint(str(name), str(kind), first, second, values.quantities, values.vectors, values.options, name.where)

"""Force elements. What an element's own keys hold is said by its file in generator/force_elements."""

from __future__ import annotations

from gudgeon.generator.force_elements.element_type import element_types
from gudgeon.generator.mechanism import ForceElement
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
from gudgeon.generator.reading import Reader, ResultDimension
from gudgeon.generator.schema import FileShape
from gudgeon.generator.yaml_tree import Map, Text


def read_forces(
    reader: Reader, shape: FileShape, places: Places, namespace: Namespace, motion: ResultDimension
) -> dict[str, ForceElement]:
    """All force elements that can be read; `motion` knows the names that their expressions may use."""
    forces = {}
    for name, node in shape.forces.items():
        with reader.collect():
            namespace.add(name, "force", name.where)
        with reader.collect():
            forces[str(name)] = _force(reader, name, node, places, motion)
    return forces


def _force(reader: Reader, name: Text, node: Map, places: Places, motion: ResultDimension) -> ForceElement:
    types, owner = element_types(), f"forces.{name}"
    kind = kind_key(node, types, all_names({k: of.fields for k, of in types.items()}), owner)
    element = types[kind]
    mistyped = check_keys(reader, node, [kind, *field_names(element.fields)], owner)
    targets = places_of(reader, node, kind, element.targets, element.counts, places)
    refuse_same_body(kind, targets)
    values = read_fields(reader, node, element.fields, owner, places, mistyped, motion)
    for field in element.fields:
        if field.at_least and {field.name, field.at_least} <= values.quantities.keys():
            number, bound = values.quantities[field.name], values.quantities[field.at_least]
            reader.require(number, ">=", bound, f"{field.name} is at least {field.at_least}")
    return ForceElement(str(name), str(kind), targets, values.quantities, values.vectors, values.options, name.where)

"""Materials, bearings and contacts. What a law's own keys hold is said by its file in generator/forces."""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import BadValueError, MissingKeyError
from gudgeon.generator.kinds.laws.law import Law, LawOption, laws
from gudgeon.generator.mechanism.mechanism import Bearing, Contact, LawUse, Material, Quantity
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.extends import parents_first
from gudgeon.generator.yaml.shapes import BearingShape, ContactShape, FileShape, missing_key, unknown_key
from gudgeon.generator.yaml.tree import Map, Text, kind_of
from gudgeon.language.names import check_label
from gudgeon.language.suggestions import known_hint, nearest, unknown_name
from gudgeon.language.tree import Number
from gudgeon.language.units import DIMENSIONLESS, LENGTH, PRESSURE, VELOCITY

ROLES = ("normal", "friction", "film")


def read_materials(reader: Reader, shape: FileShape) -> dict[str, Material]:
    """Young's modulus and Poisson's ratio of each material."""
    found = {}
    for name, material in shape.materials.items():
        with reader.collect():
            check_label(name, "material", name.where)
        modulus = reader.quantity(material.E, f"materials.{name}.E", PRESSURE)
        poisson = reader.quantity(material.nu, f"materials.{name}.nu", DIMENSIONLESS)
        reader.require(modulus, ">", 0.0, "Young's modulus is positive")
        reader.require(poisson, ">", -1.0, "Poisson's ratio is above -1")
        reader.require(poisson, "<", 0.5, "Poisson's ratio is below 0.5")
        found[str(name)] = Material(str(name), modulus, poisson)
    return found


def read_bearings(reader: Reader, shape: FileShape, materials: Mapping[str, Material]) -> dict[str, Bearing]:
    """All bearings whose materials are known."""
    found = {}
    for name, bearing in shape.bearings.items():
        with reader.collect():
            check_label(name, "bearing", name.where)
        with reader.collect():
            found[str(name)] = _bearing(reader, name, bearing, materials)
    return found


def _bearing(reader: Reader, name: Text, bearing: BearingShape, materials: Mapping[str, Material]) -> Bearing:
    address = f"bearings.{name}"
    radius = reader.quantity(bearing.radius, f"{address}.radius", LENGTH)
    clearance = reader.quantity(bearing.clearance, f"{address}.clearance", LENGTH)
    length = reader.quantity(bearing.length, f"{address}.length", LENGTH)
    reader.require(radius, ">", 0.0, "a bearing's radius is positive")
    reader.require(clearance, ">", 0.0, "a clearance is positive")
    reader.require(clearance, "<", radius, "a clearance is smaller than the bearing's radius")
    reader.require(length, ">", 0.0, "a bearing's length is positive")
    pair = []
    for text in (bearing.bearing_material, bearing.journal_material):
        if text not in materials:
            reader.errors.append(unknown_name("material", text, materials, text.where))
        pair.append(materials.get(text))
    if pair[0] is None or pair[1] is None:
        raise reader.errors.pop()
    return Bearing(str(name), radius, clearance, length, pair[0], pair[1])


def read_contacts(reader: Reader, shape: FileShape) -> dict[str, Contact]:
    """All contacts, `extends` followed: each has its own addresses for what it inherits."""
    merged: dict[str, ContactShape] = {}
    found: dict[str, Contact] = {}
    for name, contact in parents_first(reader, "contact", shape.contacts):
        if contact.extends is not None:
            contact = _merge(merged[contact.extends], contact)
        merged[str(name)] = contact
        with reader.collect():
            check_label(name, "contact", name.where)
        with reader.collect():
            found[str(name)] = _contact(reader, name, contact)
    return {str(name): found[name] for name in shape.contacts if name in found}


def _merge(parent: ContactShape, child: ContactShape) -> ContactShape:
    """The child's keys over the parent's; a role that names another law starts afresh."""
    changes = {key: getattr(child, key) for key in child.model_fields_set if getattr(child, key) is not None}
    for role in ROLES:
        above, own = getattr(parent, role), getattr(child, role)
        if above is not None and own is not None and own.get("law", above.get("law")) == above.get("law"):
            changes[role] = Map.make({**above, **own}, own.where)
    return parent.model_copy(update=changes)


def _contact(reader: Reader, name: Text, contact: ContactShape) -> Contact:
    address = f"contacts.{name}"
    _check_parts(name, contact)
    uses: dict[str, LawUse | None] = {}
    for role in ROLES:
        uses[role] = None
        if getattr(contact, role) is not None:
            with reader.collect():
                uses[role] = _law_use(reader, f"{address}.{role}", role, getattr(contact, role))
    transition = floor = None
    if contact.transition is not None:
        transition = reader.quantity(contact.transition, f"{address}.transition", LENGTH)
        reader.require(transition, ">", 0.0, "the width of a transition is positive")
    if contact.velocity_floor is not None:
        floor = reader.quantity(contact.velocity_floor, f"{address}.velocity_floor", VELOCITY)
        reader.require(floor, ">", 0.0, "the least impact velocity is positive")
    clip = contact.clip_ratio is not None and _flag(contact.clip_ratio, f"{address}.clip_ratio")
    return Contact(str(name), uses["normal"], uses["friction"], uses["film"], transition, clip, floor)


def _check_parts(name: Text, contact: ContactShape) -> None:
    """Raise unless the contact's parts make sense together."""
    if contact.normal is None and contact.film is None:
        raise MissingKeyError(f"contact {name} has no law", name.where, "expected normal: or film:, or both")
    if contact.normal is None:
        for part in ("friction", "transition", "velocity_floor", "clip_ratio"):
            if getattr(contact, part) is not None:
                message = f"contact {name} has {part} but no normal law"
                raise MissingKeyError(message, getattr(contact, part).where, "expected the key 'normal'")
    both = contact.normal is not None and contact.film is not None
    if both and contact.transition is None:
        hint = (
            "expected the key 'transition': the length over which the film hands over to the dry contact, such as 5 um"
        )
        raise MissingKeyError(f"contact {name} has no transition", name.where, hint)
    if contact.transition is not None and contact.film is None:
        raise MissingKeyError(
            f"contact {name} has a transition but no film", contact.transition.where, "expected the key 'film'"
        )


def _flag(text: Text, address: str) -> bool:
    if text not in ("true", "false"):
        raise BadValueError(f"{address} is {kind_of(text)}", text.where, "expected true or false")
    return text == "true"


def _law_use(reader: Reader, address: str, role: str, node: Map) -> LawUse:
    """A law with its numbers and options, the law's own defaults filled in."""
    if not isinstance(node.get("law"), Text):
        raise missing_key("law", node.where, address)
    text = node["law"]
    fitting = [law.name for law in laws().values() if law.role == role]
    if text not in laws():
        raise unknown_name(f"{role} law", text, fitting, text.where)
    law = laws()[text]
    if law.role != role:
        raise BadValueError(f"{law.name} is a {law.role} law", text.where, known_hint(text, fitting))
    known = ["law", *(p.name for p in law.parameters), *(o.name for o in law.options)]
    strange = [key for key in node.names() if key not in known]
    reader.errors.extend(unknown_key(key, known, address) for key in strange)
    quantities = _numbers(reader, address, law, node, {nearest(key, known) for key in strange})
    options = {}
    for option in law.options:
        with reader.collect():
            options[option.name] = _option(option, node, address)
    return LawUse(law.name, quantities, options)


def _numbers(reader: Reader, address: str, law: Law, node: Map, mistyped: set[str | None]) -> dict[str, Quantity]:
    """The law's numbers; one that is missing because its key is `mistyped` was told already."""
    quantities: dict[str, Quantity] = {}
    for parameter in law.parameters:
        own = f"{address}.{parameter.name}"
        value = node.get(parameter.name)
        if value is None and parameter.default is not None:
            number = Number(parameter.default, repr(parameter.default))
            quantities[parameter.name] = reader.keep(Quantity(own, number, parameter.dimension, node["law"].where))
        elif value is None:
            if parameter.name not in mistyped:
                reader.errors.append(missing_key(parameter.name, node.where, address))
        elif not isinstance(value, Text):
            reader.errors.append(BadValueError(f"{own} is {kind_of(value)}", value.where, "expected a number"))
        else:
            quantities[parameter.name] = reader.quantity(
                value, own, None if parameter.any_dimension else parameter.dimension
            )
    for parameter in law.parameters:
        for relation, bound in parameter.bounds:
            limit = quantities.get(bound) if isinstance(bound, str) else bound
            if parameter.name in quantities and limit is not None:
                reader.require(quantities[parameter.name], relation, limit, f"{parameter.meaning} ({law.name})")
    return quantities


def _option(option: LawOption, node: Map, address: str) -> str | bool:
    text = node.get(option.name)
    if text is None:
        return option.default
    words = {str(value).lower() if isinstance(value, bool) else value: value for value in option.values}
    if not isinstance(text, Text) or text not in words:
        place = text.where if isinstance(text, (Text, Map)) else node.where
        raise BadValueError(f"{address}.{option.name} is {kind_of(text)}", place, known_hint(str(text), words))
    return words[text]

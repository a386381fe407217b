"""Reads the sections `bearings`, `guides` and `contacts`, and resolves entries that extend others by `extends:`.

The keys of a force law are declared in the law's file in generator/kinds/laws.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

from gudgeon.errors import BadNameError, BadValueError, CycleError, ExpressionError, MissingKeyError, UnknownNameError
from gudgeon.generator.field import LAW, OF_PENETRATION, Field, resolve_dimensions
from gudgeon.generator.format.sections import BEARING, CONTACT, GUIDE
from gudgeon.generator.format.shapes import make_missing_key_error
from gudgeon.generator.kinds.laws.law import USER_LAWS, find_all_laws, find_laws_of_role
from gudgeon.generator.kinds.laws.registered import find_law_key
from gudgeon.generator.mechanism import (
    Bearing,
    Contact,
    Guide,
    LawUse,
    Material,
    Quantity,
    make_force_at_zero_penetration,
)
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, list_field_names, read_fields, report_unknown_keys
from gudgeon.generator.reader.materials import ELASTIC_KEYS, Materials
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import format_name_hint, make_unknown_name_error
from gudgeon.language.parser import offset_location
from gudgeon.language.tree import Number, iterate_names


def order_by_inheritance(
    reader: Reader, kind: str, section: Map, outside_parents: Iterable[str] = ()
) -> Iterator[tuple[Text, Map]]:
    """Yield the entries (name, node) of a section in topological order: each after the entry that it extends.

    The sections are `contacts` and `scenes`. `kind` names the kind of entry in messages; `outside_parents` are parents
    outside the section. Errors are collected for entries that extend an unknown name, or themselves through others;
    these and their descendants are left out.
    """
    by_name = {str(name): (name, entry) for name, entry in section.list_entries()}
    ordered = dict.fromkeys(
        name for name in outside_parents if name not in by_name
    )  # a dict keeps the order for messages
    refused: set[str] = set()
    for start in by_name:
        path: list[str] = []
        current: str | None = start
        while current is not None and current not in ordered and current not in refused:
            entry = by_name[current][1]
            if current in path:
                cycle = [*path[path.index(current) :], current]
                location = entry["extends"].where if "extends" in entry else by_name[current][0].where
                message = f"{kind}s extend each other: {' → '.join(cycle)}"
                reader.errors.append(CycleError(message, location, "expected at least one of them without extends"))
                refused.update(path)
                break
            path.append(current)
            parent = entry.get("extends")
            if parent is not None and parent not in by_name and parent not in ordered:
                reader.errors.append(
                    make_unknown_name_error(kind, parent, dict.fromkeys([*ordered, *by_name]), parent.where)
                )
                refused.update(path)
                break
            current = str(parent) if parent is not None else None
        if current in refused:
            refused.update(path)
        for name in reversed(path):
            if name not in refused:
                ordered[name] = None
                yield by_name[name]


ZERO_FORCE_TOL = 1e-9  # N: largest rounding error of a force that is 0
_ROLES = tuple(field.name for field in CONTACT.fields if field.kind == LAW)


def read_bearings_and_guides(
    reader: Reader, root: Map, materials: Materials
) -> dict[str, Mapping[str, Bearing | Guide]]:
    """Read bearings and guides and return them by name, under the keys "bearing" and "guide" of a scene's `play`.

    Entries with an unknown material are left out; their errors are collected.
    """
    return {
        "bearing": {
            name: Bearing(name, quantities["radius"], quantities["clearance"], quantities["length"], *material_pair)
            for name, quantities, material_pair in _read_entries_with_materials(
                reader, root.get_mapping("bearings"), BEARING, ("bearing_material", "journal_material"), materials
            )
        },
        "guide": {
            name: Guide(
                name,
                quantities["gap"],
                quantities["half_length"],
                quantities["half_height"],
                quantities.get("corner_radius"),
                *material_pair,
            )
            for name, quantities, material_pair in _read_entries_with_materials(
                reader, root.get_mapping("guides"), GUIDE, ("guide_material", "slider_material"), materials
            )
        },
    }


def _read_entries_with_materials(
    reader: Reader, section: Map, declaration: Field, material_keys: tuple[str, str], materials: Materials
) -> Iterator[tuple[str, Mapping[str, Quantity], list[Material]]]:
    """Yield name, numbers and both materials of each entry of a section whose materials are known.

    `material_keys` are the keys of the two materials: of bearing and journal, or of guide and slider; `declaration`
    declares an entry.
    """
    for name, node in section.list_entries():
        address = f"{declaration.name}s.{name}"
        quantities = read_fields(reader, node, declaration.fields, FieldContext(address)).quantities
        material_pair = _read_material_pair(reader, node, address, material_keys, materials)
        if len(material_pair) == 2:
            yield str(name), quantities, material_pair


def _read_material_pair(
    reader: Reader, node: Map, address: str, material_keys: tuple[str, str], materials: Materials
) -> list[Material]:
    """Return the materials at the keys `material_keys` of an entry; errors of unknown ones are collected.

    The list is shorter than `material_keys` if a material is unknown. The materials have the properties E and nu at
    addresses of this entry.
    """
    material_pair = []
    for material_key in material_keys:
        with reader.collect_errors():
            material_pair.append(
                Material(
                    str(node[material_key]),
                    materials.read_properties(f"{address}.{material_key}", node[material_key], ELASTIC_KEYS),
                )
            )
    return material_pair


def read_contacts(reader: Reader, root: Map) -> dict[str, Contact]:
    """Read all contacts by name with `extends` resolved; contacts with errors are left out.

    Inherited numbers get addresses of the contact that inherits them.
    """
    merged: dict[str, Map] = {}
    contacts: dict[str, Contact] = {}
    for name, node in order_by_inheritance(reader, "contact", root.get_mapping("contacts")):
        merged[str(name)] = contact = _merge_contacts(merged[node["extends"]], node) if "extends" in node else node
        with reader.collect_errors():
            contacts[str(name)] = _read_contact(reader, name, contact)
    return {str(name): contacts[name] for name in root.get_mapping("contacts") if name in contacts}


def _merge_contacts(parent: Map, child: Map) -> Map:
    """Return the parent's keys overridden by the child's; a law of another name replaces the parent's law entirely.

    A law of the same name, or without a name, overrides single keys of the parent's law.
    """
    changes = dict(child)
    for role in _ROLES:
        parent_law, child_law = parent.get(role), child.get(role)
        if (
            parent_law is not None
            and child_law is not None
            and child_law.get("law", parent_law.get("law")) == parent_law.get("law")
        ):
            changes[role] = Map.make_map({**parent_law, **child_law}, child_law.where)
    return Map.make_map({**parent, **changes}, child.where)


def _read_contact(reader: Reader, name: Text, node: Map) -> Contact:
    """Return one contact, whose `extends` was resolved before.

    A contact has up to four laws (`normal`, `friction`, `film`, `mixed`), the length of its transition, `clip_ratio`
    and `velocity_floor`. Errors of its laws are collected. Raises an InputError if the keys contradict each other
    (`_check_contact_keys`), for friction with a normal law that has the option `pulls`, and for `mixed` with a film
    that has the option `as_printed`.
    """
    address = f"contacts.{name}"
    law_uses: dict[str, LawUse | None] = dict.fromkeys(_ROLES)
    for role in _ROLES:
        if role in node:
            with reader.collect_errors():
                law_uses[role] = _read_law(reader, f"{address}.{role}", role, node[role])
    _check_contact_keys(name, node)
    if law_uses["normal"] and law_uses["friction"] and law_uses["normal"].options.get("pulls") is True:
        hint = "expected one of the two: friction of a force that pulls would drive the slip"
        raise BadValueError(f"contact {name} has friction, and a normal law that pulls", node["friction"].where, hint)
    if law_uses["mixed"] and law_uses["film"] and law_uses["film"].options.get("as_printed") is True:
        hint = (
            "expected one of the two: as_printed drives motion that a film damps, and is for the paper's "
            "transition only"
        )
        raise BadValueError(
            f"contact {name} has a film with as_printed, and mixed lubrication", node["mixed"].where, hint
        )
    values = read_fields(reader, node, CONTACT.fields, FieldContext(address))
    clip = values.options.get("clip_ratio", False) is True
    transition, floor = values.quantities.get("transition"), values.quantities.get("velocity_floor")
    return Contact(
        str(name),
        law_uses["normal"],
        law_uses["friction"],
        law_uses["film"],
        transition,
        clip,
        floor,
        law_uses["mixed"],
    )


def _check_contact_keys(name: Text, node: Map) -> None:
    """Raise an InputError if the contact lacks a law, or combines keys that contradict each other.

    It needs a normal law or a film; with both it needs a transition or mixed lubrication.
    """
    if "normal" not in node and "film" not in node:
        raise MissingKeyError(f"contact {name} has no law", name.where, "expected normal: or film:, or both")
    if "normal" not in node:
        for part in ("friction", "mixed", "transition", "velocity_floor", "clip_ratio"):
            if part in node:
                message = f"contact {name} has {part} but no normal law"
                raise MissingKeyError(message, node[part].where, "expected the key 'normal'")
    if "normal" in node and isinstance(law := node["normal"].get("law"), Text) and law in _find_rigid_laws():
        _check_rigid_contact(name, law, node)
    if "transition" in node and "mixed" in node:
        hint = "expected one of the two: a length of the transition from film to contact, or a law of mixed lubrication"
        raise BadValueError(f"contact {name} has both transition and mixed", node.find_key("mixed").where, hint)
    if "normal" in node and "film" in node and not ("transition" in node or "mixed" in node):
        hint = (
            "expected the key 'transition', the length of the transition from film to dry contact, such as 5 um;"
            " or 'mixed', a law of mixed lubrication"
        )
        raise MissingKeyError(f"contact {name} has no transition", name.where, hint)
    for part, phrase in (("transition", "a transition"), ("mixed", "mixed lubrication")):
        if part in node and "film" not in node:
            message = f"contact {name} has {phrase} but no film"
            raise MissingKeyError(message, node[part].where, "expected the key 'film'")


def _check_rigid_contact(name: Text, law: Text, node: Map) -> None:
    """Raise BadValueError if a contact of rigid surfaces has keys or a friction law that impacts cannot use.

    Friction in an impact must be F_n times a coefficient of the slip, without internal states, and not a user-defined
    law. `law` is the normal law's name.
    """
    for part in ("film", "mixed", "velocity_floor", "clip_ratio"):
        if part in node:
            hint = "expected only friction in addition to this law: its surfaces are rigid"
            raise BadValueError(f"contact {name} has {law} and {part}", node.find_key(part).where, hint)
    friction = node["friction"].get("law") if "friction" in node else None
    friction_law = find_laws_of_role("friction").get(friction) if isinstance(friction, Text) else None
    if (
        isinstance(friction, Text)
        and friction_law is not None
        and (friction_law.states or friction_law.name in USER_LAWS)
    ):
        allowed_laws = sorted(
            friction_law_type.name
            for friction_law_type in find_laws_of_role("friction").values()
            if not friction_law_type.states and friction_law_type.name not in USER_LAWS
        )
        reason = (
            "an impact is too short for bristles to bend"
            if friction_law.states
            else "an impact needs F_n times a function of the slip"
        )
        hint = f"expected one of {', '.join(allowed_laws)}: {reason}"
        raise BadValueError(f"contact {name} has {law} and friction by {friction_law.name}", friction.where, hint)


def _check_penetration_force(reader: Reader, force: Quantity) -> None:
    """Raise an InputError unless a force law's expression depends on delta; require that it is 0 at delta = 0.

    Raises BadNameError if a parameter of the file is called delta. Nothing is checked if the expression could not be
    read.
    """
    locations = {name.path: offset_location(force.where, name.offset) for name in iterate_names(force.value)}
    if "delta" in reader.parameters and "delta" in locations:
        hint = "give the parameter another name"
        raise BadNameError("'delta' is the penetration here, and a parameter of this file", locations["delta"], hint)
    if isinstance(force.value, Number) and math.isnan(force.value.value):
        return  # reported already
    if "delta" not in locations:
        hint = "expected an expression such as 1e8 N/m * delta"
        raise ExpressionError(f"{force.address} does not depend on delta, the penetration", force.where, hint)
    force_at_onset = reader.register_quantity(make_force_at_zero_penetration(force))
    for relation, bound in ((">=", -ZERO_FORCE_TOL), ("<=", ZERO_FORCE_TOL)):
        reader.add_condition(
            force_at_onset, relation, bound, "a force that is not 0 at delta = 0 would jump at every onset"
        )


def _find_rigid_laws() -> set[str]:
    """Return the names of the normal laws of rigid surfaces."""
    return {name for name, law in find_laws_of_role("normal").items() if law.rigid}


def _read_law(reader: Reader, address: str, role: str, node: Map) -> LawUse:
    """Return a force law of the given role with its numbers and options; defaults of the law are filled in.

    Errors of its numbers are collected. Raises an InputError if the law is missing, unknown or of another role, or for
    an option that has an effect only without a number that is given. A name that is an alias of a law sets the options
    of the alias. The key of a user-defined law is recorded in `reader.laws`.
    """
    if not isinstance(node.get("law"), Text):
        raise make_missing_key_error("law", node.where, address)
    text = node["law"]
    laws_of_role = find_laws_of_role(role)
    if text not in laws_of_role:
        other_role = next((other_role for other_role in _ROLES if text in find_laws_of_role(other_role)), None)
        if other_role is not None:
            raise BadValueError(f"{text} is a {other_role} law", text.where, format_name_hint(text, laws_of_role))
        hint = format_name_hint(text, laws_of_role)
        hint += "\n  register a user-defined law with --laws FILE.py or gudgeon.register"
        raise UnknownNameError(f"unknown {role} law {str(text)[:200]!r}", text.where, hint)
    law, fields = laws_of_role[text], laws_of_role[text].list_fields_of_name(text)
    if law.name in USER_LAWS:
        reader.laws[law.name] = find_law_key(law.name)
    mistyped = report_unknown_keys(reader, node, ["law", *list_field_names(fields)], address)
    context = FieldContext(address, str(text), text.where, mistyped)
    values = read_fields(reader, node, resolve_dimensions(fields, node), context)
    for declaration in fields:
        if declaration.varies == OF_PENETRATION and declaration.name in values.quantities:
            with reader.collect_errors():
                _check_penetration_force(reader, values.quantities[declaration.name])
    for option, number_name in law.instead.items():
        if number_name in values.quantities:
            if option in node:
                hint = f"expected one of the two: {option} has an effect only without {number_name}"
                raise BadValueError(f"{address} has both {number_name} and {option}", node.find_key(option).where, hint)
            values.options.pop(option, None)
    return LawUse(law.name, values.quantities, {**values.options, **law.also.get(text, {})})


def check_contact_in_guide(joint: str, guide: Guide, contact: Contact, play_node: Map) -> None:
    """Raise an InputError unless the contact fits a slider in a guide: no film, no contour, a law of corners on walls.

    A law that takes its stiffness from the geometry needs the guide's corner radius. `play_node` is the entry of the
    scene's `play` for the joint.
    """
    location = play_node["contact"].where
    if "contour" in play_node:
        message = f"{joint} has a contour and a guide: only bearings can have contours"
        raise BadValueError(message, play_node.find_key("contour").where, "expected no contour")
    if contact.film is not None:
        message = f"contact {contact.name} of {joint} has a film: laws of films describe a journal in its bearing"
        raise BadValueError(message, location, "expected a contact without a film: guides have dry contact only")
    normal = contact.normal
    if normal is None:
        return
    if find_all_laws()[normal.law].in_hole:
        allowed_laws = sorted(name for name, law in find_laws_of_role("normal").items() if not law.in_hole)
        message = f"contact {contact.name} of {joint} has {normal.law}, a law of a pin in a hole"
        raise BadValueError(
            message, location, f"expected a law of a corner on a wall, one of: {', '.join(allowed_laws)}"
        )
    if "geometry" in normal.options and guide.corner_radius is None:
        message = f"guide {guide.name} of {joint} has no corner_radius, from which {normal.law} computes its stiffness"
        has_stiffness = any(declaration.name == "stiffness" for declaration in find_all_laws()[normal.law].fields)
        alternative = (
            "stiffness"
            if has_stiffness
            else f"a law that needs none ({', '.join(sorted(_describe_laws_of_sharp_corners()))})"
        )
        hint = f"expected corner_radius in guides.{guide.name}, or {alternative} in contacts.{contact.name}.normal"
        raise MissingKeyError(message, play_node["guide"].where, hint)


def _describe_laws_of_sharp_corners() -> Iterator[str]:
    """Yield the normal laws for guides that need no corner radius: they use no radii, or a given stiffness instead.

    Each is a text for a hint: the law's name, and "with stiffness" where it needs one.
    """
    for name, law in find_all_laws().items():
        if law.role == "normal" and not law.in_hole and law.name == name:
            if "geometry" in law.instead:
                yield f"{name} with {law.instead['geometry']}"
            elif all(declaration.name != "geometry" for declaration in law.fields):
                yield name

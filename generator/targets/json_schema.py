"""Writes the format of mechanism files as a JSON Schema (draft 2020-12) for editors, from the reader's declarations.

A schema covers names, kinds and shapes; units, references and ranges are checked by the reader only.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from gudgeon.generator.field import (
    BODY,
    CORNERS,
    DEPTHS,
    FLAG,
    KINDS,
    LAW,
    MAPPING,
    NAME,
    NUMBER,
    PLACE,
    POINTS,
    RECORD,
    RESULTS,
    TEXT,
    VECTOR,
    WORD,
    Field,
    Kind,
)
from gudgeon.generator.format.sections import CONTACT, COORDINATES, FORMAT, MECHANISM_FILE, SECTIONS
from gudgeon.language.names import IDENTIFIER
from gudgeon.language.names import MAX_LENGTH as MAX_NAME_LENGTH
from gudgeon.language.parser import MAX_LENGTH as MAX_EXPRESSION_LENGTH

Json = dict[str, Any]

_NAME = f"{IDENTIFIER.pattern}"
_FLAG: Json = {"enum": [True, False, "true", "false"]}
_NUMBER: Json = {
    "description": "a number, or an expression: 80 mm, 2*pi rad/s, r + 5 mm",
    "anyOf": [
        {"type": "number"},
        {"type": "string", "minLength": 1, "maxLength": MAX_EXPRESSION_LENGTH, "pattern": r"^[^\n]*$"},
    ],
}


def make_schema() -> Json:
    """Return the JSON Schema of a mechanism file, with definitions of all names, numbers, kinds and laws.

    `gudgeon schema` prints it.
    """
    families = (SECTIONS[name].entry for name in ("joints", "drives", "forces"))
    roles = [field for field in CONTACT.fields if field.kind == LAW]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"mechanism file, {FORMAT}",
        **_make_record_schema(MECHANISM_FILE),
        "$defs": {
            "name": {"type": "string", "pattern": f"^{_NAME}$", "maxLength": MAX_NAME_LENGTH},
            "number": _NUMBER,
            "vector": _make_list_schema(_make_reference("number"), 2),
            "bodies": {"type": "string", "pattern": f"^{_NAME}$"},
            "points": {"type": "string", "pattern": f"^{_NAME}\\.{_NAME}$"},
            "coordinates": _make_body_key_schema("string", COORDINATES),
            **{
                family.name: {"oneOf": [_make_kind_schema(*kind) for kind in _list_kinds(family)]}
                for family in families
                if family
            },
            **{
                f"{role.name}_{use}": _make_law_schema(role, use == "whole")
                for role in roles
                for use in ("whole", "part")
            },
        },
    }


def _make_reference(name: str) -> Json:
    """Return the reference to the definition `name` under $defs."""
    return {"$ref": f"#/$defs/{name}"}


def _make_list_schema(item_schema: Json, count: int) -> Json:
    """Return the schema of a list with a fixed number of items."""
    return {"type": "array", "items": item_schema, "minItems": count, "maxItems": count}


def _make_body_key_schema(json_type: str, keys: Mapping[str, object]) -> Json:
    """Return the schema of strings "BODY.KEY" with one of `keys`, such as "crank.theta".

    json_type: "string"; "" leaves the type out, for property names, which are always strings.
    """
    pattern = {"pattern": f"^{_NAME}\\.({'|'.join(keys)})$"}
    return {"type": json_type, **pattern} if json_type else pattern


def _make_object_schema(properties: Mapping[str, Any], required: Sequence[str] = ()) -> Json:
    """Return the schema of a mapping that has only known keys, of which some are required."""
    return {
        "type": "object",
        "properties": dict(properties),
        "required": list(required),
        "additionalProperties": False,
    }


def _list_required_keys(fields: Sequence[Field]) -> list[str]:
    """Return the keys that are required."""
    return [field.name for field in fields if field.required]


def _make_field_schemas(fields: Sequence[Field], with_defaults: bool = True) -> dict[str, Json]:
    """Return {key: JSON Schema with the meaning as description} of fields.

    with_defaults: whether fields have their defaults in the schema; False if missing keys are inherited.
    """
    schemas = {field.name: {**_make_field_schema(field), "description": field.meaning} for field in fields}
    if not with_defaults:
        return schemas
    return schemas | {f.name: {**schemas[f.name], "default": f.default} for f in fields if f.default is not None}


def _make_field_schema(field: Field) -> Json:
    """Return the JSON Schema of a field's values.

    A word is a constant or an enumeration. A record or mapping has its keys in place, a field of several kinds (KINDS)
    becomes a reference. All others have the schema of _SCHEMA_BY_KIND.
    """
    if field.kind == RECORD:
        return _make_record_schema(field)
    if field.kind == MAPPING:
        return _make_mapping_schema(field)
    if field.kind == WORD:
        return {"const": field.values[0]} if len(field.values) == 1 else {"enum": list(field.values)}
    return _make_reference(field.name) if field.kind == KINDS else _SCHEMA_BY_KIND[field.kind]


_SCHEMA_BY_KIND: Mapping[str, Json] = {
    NUMBER: _make_reference("number"),
    VECTOR: _make_reference("vector"),
    FLAG: _FLAG,
    POINTS: {"type": "array", "items": _make_list_schema({"type": ["number", "string"]}, 2), "minItems": 2},
    DEPTHS: {"type": ["array", "number", "string"], "items": {"type": ["number", "string"]}, "minItems": 8},
    RESULTS: {"type": ["array", "string", "null"], "items": {"type": "string"}},
    TEXT: {"type": ["string", "number"]},
    NAME: _make_reference("name"),
    BODY: _make_reference("name"),
    CORNERS: _make_list_schema(_make_reference("name"), 3),
    LAW: {"type": "object"},  # the required keys depend on `extends`: see _make_record_schema
}


def _make_record_schema(field: Field) -> Json:
    """Return the schema of a mapping with known keys.

    In the file itself, optional sections may be null, and required ones need an entry. Two keys of which exactly one is
    expected become `oneOf`. In a contact that extends another one, no key of its laws is required.
    """
    properties = _make_field_schemas(field.fields, field.find_field("extends") is None)
    for inner in field.fields if field is MECHANISM_FILE else ():
        if inner.kind in (MAPPING, RECORD) and not inner.required:
            properties[inner.name]["type"] = ["object", "null"]
        elif inner.kind == MAPPING:
            properties[inner.name]["minProperties"] = 1
    record = _make_object_schema(properties, _list_required_keys(field.fields))
    if alternatives := [inner for inner in field.fields if inner.alternative_key]:
        record["oneOf"] = [
            {"required": [name]} for inner in alternatives for name in (inner.name, inner.alternative_key)
        ]
    roles = [inner.name for inner in field.fields if inner.kind == LAW]
    if roles:  # an inherited key is not required
        record["if"] = {"required": ["extends"]}
        record["then"] = {"properties": {role: _make_reference(f"{role}_part") for role in roles}}
        record["else"] = {"properties": {role: _make_reference(f"{role}_whole") for role in roles}}
    return record


def _make_mapping_schema(field: Field) -> Json:
    """Return the schema of a mapping whose keys are user-defined names, "BODY.KEY", or addresses of known forms.

    All values have the schema of `field.entry`; for places, a coordinate is a number and a point a vector.
    """
    assert field.entry is not None
    keys = _make_reference("name") if field.keys is None else _make_body_key_schema("", field.keys)
    if field.addresses:
        addresses_pattern = "|".join(address.replace(".", "\\.").replace("NAME", _NAME) for address in field.addresses)
        keys = {"pattern": f"^({addresses_pattern})$"}
    if field.entry.kind == PLACE and field.keys:  # a coordinate has a number, any other name of a body a point
        points = {f"^{_NAME}\\.(?!({'|'.join(field.keys)})$){_NAME}$": _make_reference("vector")}
        numbers = {str(keys["pattern"]): _make_reference("number")}
        return {"type": "object", "patternProperties": numbers | points, "additionalProperties": False}
    return {"type": "object", "propertyNames": keys, "additionalProperties": _make_field_schema(field.entry)}


def _list_kinds(family: Field) -> list[tuple[str, Kind]]:
    """Return (name, kind) of each kind of a family of entries; [] if it has none."""
    return list(family.kinds().items()) if family.kinds else []


def _make_kind_schema(name: str, kind: Kind) -> Json:
    """Return the schema of one kind of a joint, drive or force: its targets under the kind's name, then its fields.

    One target is a string, two are a list.
    """
    target_schema = _make_reference(kind.targets)
    target_schemas = [target_schema if count == 1 else _make_list_schema(target_schema, count) for count in kind.counts]
    targets = target_schemas[0] if len(target_schemas) == 1 else {"anyOf": target_schemas}
    entry_schema = _make_object_schema(
        {name: targets, **_make_field_schemas(kind.fields)}, [name, *_list_required_keys(kind.fields)]
    )
    return {"title": kind.title, **entry_schema}


def _make_law_schema(role: Field, is_complete: bool) -> Json:
    """Return the schema of the law of one role, such as friction, in a contact.

    The key `law` selects the law, on which the allowed keys depend. is_complete: whether `law` and the required keys
    must be present. False: they may be inherited from another contact.
    """
    laws = _list_kinds(role)
    all_keys: dict[str, Json] = {field.name: {} for _, law in laws for field in law.fields}
    law_schema = _make_object_schema(
        {**all_keys, "law": {"enum": [name for name, _ in laws]}}, ["law"] if is_complete else []
    )
    law_schema["allOf"] = [
        {
            "if": {"properties": {"law": {"const": name}}, "required": ["law"]},
            "then": {
                **_make_object_schema({"law": True, **_make_field_schemas(law.fields, is_complete)}),
                "required": _list_required_keys(law.fields) if is_complete else [],
            },
        }
        for name, law in laws
    ]
    return law_schema

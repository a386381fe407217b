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
from gudgeon.generator.format.sections import CONTACT, COORDINATES, FILE, FORMAT, SECTIONS
from gudgeon.language.names import IDENTIFIER
from gudgeon.language.names import MAX_LENGTH as LONGEST_NAME
from gudgeon.language.parser import MAX_LENGTH

Json = dict[str, Any]

_NAME = f"{IDENTIFIER.pattern}"
_FLAG: Json = {"enum": [True, False, "true", "false"]}
_NUMBER: Json = {
    "description": "a number, or an expression: 80 mm, 2*pi rad/s, r + 5 mm",
    "anyOf": [{"type": "number"}, {"type": "string", "minLength": 1, "maxLength": MAX_LENGTH, "pattern": r"^[^\n]*$"}],
}


def make_schema() -> Json:
    """Return the JSON Schema of a mechanism file, with definitions of all names, numbers, kinds and laws."""
    families = (SECTIONS[name].entry for name in ("joints", "drives", "forces"))
    roles = [field for field in CONTACT.fields if field.kind == LAW]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"mechanism file, {FORMAT}",
        **_describe_record(FILE),
        "$defs": {
            "name": {"type": "string", "pattern": f"^{_NAME}$", "maxLength": LONGEST_NAME},
            "number": _NUMBER,
            "vector": _describe_list(_make_reference("number"), 2),
            "bodies": {"type": "string", "pattern": f"^{_NAME}$"},
            "points": {"type": "string", "pattern": f"^{_NAME}\\.{_NAME}$"},
            "coordinates": _describe_body_keys("string", COORDINATES),
            **{
                family.name: {"oneOf": [_describe_kind(*kind) for kind in _list_kinds(family)]}
                for family in families
                if family
            },
            **{
                f"{role.name}_{use}": _describe_law(role, use == "whole") for role in roles for use in ("whole", "part")
            },
        },
    }


def _make_reference(name: str) -> Json:
    """Return the reference to a definition of the schema."""
    return {"$ref": f"#/$defs/{name}"}


def _describe_list(item_schema: Json, count: int) -> Json:
    """Return the schema of a list with a fixed number of items."""
    return {"type": "array", "items": item_schema, "minItems": count, "maxItems": count}


def _describe_body_keys(json_type: str, keys: Mapping[str, object]) -> Json:
    """Return the schema of texts BODY.key with one of the keys; without `json_type` that of property names."""
    pattern = {"pattern": f"^{_NAME}\\.({'|'.join(keys)})$"}
    return {"type": json_type, **pattern} if json_type else pattern


def _describe_object(properties: Mapping[str, Any], required: Sequence[str] = ()) -> Json:
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


def _describe_fields(fields: Sequence[Field], with_defaults: bool = True) -> dict[str, Json]:
    """Return {key: JSON Schema with the meaning as description} of fields.

    with_defaults: add the defaults of fields that have one; not for a mapping whose missing keys are inherited.
    """
    schemas = {field.name: {**_describe_field(field), "description": field.meaning} for field in fields}
    if not with_defaults:
        return schemas
    return schemas | {f.name: {**schemas[f.name], "default": f.default} for f in fields if f.default is not None}


def _describe_field(field: Field) -> Json:
    """Return the JSON Schema of a field's values.

    A word is a constant or a choice of words. A record or a mapping is described with its keys. A field whose keys
    depend on its kind becomes a reference, and all others have the schema of their kind.
    """
    if field.kind == RECORD:
        return _describe_record(field)
    if field.kind == MAPPING:
        return _describe_mapping(field)
    if field.kind == WORD:
        return {"const": field.values[0]} if len(field.values) == 1 else {"enum": list(field.values)}
    return _make_reference(field.name) if field.kind == KINDS else _SIMPLE[field.kind]


_SIMPLE: Mapping[str, Json] = {
    NUMBER: _make_reference("number"),
    VECTOR: _make_reference("vector"),
    FLAG: _FLAG,
    POINTS: {"type": "array", "items": _describe_list({"type": ["number", "string"]}, 2), "minItems": 2},
    DEPTHS: {"type": ["array", "number", "string"], "items": {"type": ["number", "string"]}, "minItems": 8},
    RESULTS: {"type": ["array", "string", "null"], "items": {"type": "string"}},
    TEXT: {"type": ["string", "number"]},
    NAME: _make_reference("name"),
    BODY: _make_reference("name"),
    CORNERS: _describe_list(_make_reference("name"), 3),
    LAW: {"type": "object"},  # what it holds depends on `extends`: see _record
}


def _describe_record(field: Field) -> Json:
    """Return the schema of a mapping with known keys; an empty optional section of the file is null.

    Keys of which exactly one is expected become `oneOf`. In a contact that extends another one, no key of its laws is
    required.
    """
    properties = _describe_fields(field.fields, field.find_field("extends") is None)
    for inner in field.fields if field is FILE else ():
        if inner.kind in (MAPPING, RECORD) and not inner.required:
            properties[inner.name]["type"] = ["object", "null"]
        elif inner.kind == MAPPING:
            properties[inner.name]["minProperties"] = 1
    record = _describe_object(properties, _list_required_keys(field.fields))
    if alternatives := [inner for inner in field.fields if inner.either]:
        record["oneOf"] = [{"required": [name]} for inner in alternatives for name in (inner.name, inner.either)]
    roles = [inner.name for inner in field.fields if inner.kind == LAW]
    if roles:  # an inherited key is not required
        record["if"] = {"required": ["extends"]}
        record["then"] = {"properties": {role: _make_reference(f"{role}_part") for role in roles}}
        record["else"] = {"properties": {role: _make_reference(f"{role}_whole") for role in roles}}
    return record


def _describe_mapping(field: Field) -> Json:
    """Return the schema of a mapping with user-defined names, or with addresses that have a known form."""
    assert field.entry is not None
    keys = _make_reference("name") if field.keys is None else _describe_body_keys("", field.keys)
    if field.addresses:
        addresses_pattern = "|".join(address.replace(".", "\\.").replace("NAME", _NAME) for address in field.addresses)
        keys = {"pattern": f"^({addresses_pattern})$"}
    if field.entry.kind == PLACE and field.keys:  # a coordinate has a number, any other name of a body a point
        points = {f"^{_NAME}\\.(?!({'|'.join(field.keys)})$){_NAME}$": _make_reference("vector")}
        numbers = {str(keys["pattern"]): _make_reference("number")}
        return {"type": "object", "patternProperties": numbers | points, "additionalProperties": False}
    return {"type": "object", "propertyNames": keys, "additionalProperties": _describe_field(field.entry)}


def _list_kinds(family: Field) -> list[tuple[str, Kind]]:
    """Return (name, kind) of each kind of a family of entries; [] if it has none."""
    return list(family.kinds().items()) if family.kinds else []


def _describe_kind(name: str, kind: Kind) -> Json:
    """Return the schema of one kind of entry: its targets and its fields; one target is a text, two are a list."""
    item = _make_reference(kind.targets)
    target_schemas = [item if count == 1 else _describe_list(item, count) for count in kind.counts]
    targets = target_schemas[0] if len(target_schemas) == 1 else {"anyOf": target_schemas}
    entry_schema = _describe_object(
        {name: targets, **_describe_fields(kind.fields)}, [name, *_list_required_keys(kind.fields)]
    )
    return {"title": kind.title, **entry_schema}


def _describe_law(role: Field, is_complete: bool) -> Json:
    """Return the schema of the law of one role in a contact; the keys allowed depend on the name of the law.

    is_complete: the law and its required keys must be given; otherwise they may be inherited from another contact.
    """
    laws = _list_kinds(role)
    all_keys: dict[str, Json] = {field.name: {} for _, law in laws for field in law.fields}
    law_schema = _describe_object(
        {**all_keys, "law": {"enum": [name for name, _ in laws]}}, ["law"] if is_complete else []
    )
    law_schema["allOf"] = [
        {
            "if": {"properties": {"law": {"const": name}}, "required": ["law"]},
            "then": {
                **_describe_object({"law": True, **_describe_fields(law.fields, is_complete)}),
                "required": _list_required_keys(law.fields) if is_complete else [],
            },
        }
        for name, law in laws
    ]
    return law_schema

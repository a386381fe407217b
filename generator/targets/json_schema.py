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


def schema() -> Json:
    """Return the JSON Schema of a mechanism file."""
    families = (SECTIONS[name].entry for name in ("joints", "drives", "forces"))
    roles = [field for field in CONTACT.fields if field.kind == LAW]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"mechanism file, {FORMAT}",
        **_record(FILE),
        "$defs": {
            "name": {"type": "string", "pattern": f"^{_NAME}$", "maxLength": LONGEST_NAME},
            "number": _NUMBER,
            "vector": _list(_reference("number"), 2),
            "bodies": {"type": "string", "pattern": f"^{_NAME}$"},
            "points": {"type": "string", "pattern": f"^{_NAME}\\.{_NAME}$"},
            "coordinates": _of_bodies("string", COORDINATES),
            **{family.name: {"oneOf": [_kind(*one) for one in _kinds(family)]} for family in families if family},
            **{f"{role.name}_{use}": _law(role, use == "whole") for role in roles for use in ("whole", "part")},
        },
    }


def _reference(name: str) -> Json:
    """Return a reference to a definition."""
    return {"$ref": f"#/$defs/{name}"}


def _list(item: Json, count: int) -> Json:
    """Return the schema of a list with a fixed number of items."""
    return {"type": "array", "items": item, "minItems": count, "maxItems": count}


def _of_bodies(kind: str, keys: Mapping[str, object]) -> Json:
    """Return the schema of keys or texts BODY.key."""
    pattern = {"pattern": f"^{_NAME}\\.({'|'.join(keys)})$"}
    return {"type": kind, **pattern} if kind else pattern


def _object(properties: Mapping[str, Any], required: Sequence[str] = ()) -> Json:
    """Return the schema of a mapping with known keys, of which some are required."""
    return {
        "type": "object",
        "properties": dict(properties),
        "required": list(required),
        "additionalProperties": False,
    }


def _required(fields: Sequence[Field]) -> list[str]:
    """Return the keys that are required."""
    return [field.name for field in fields if field.required]


def _described(fields: Sequence[Field], filled_in: bool = True) -> dict[str, Json]:
    """Return the schema of each key with its meaning, and its default if `filled_in` (nothing is inherited)."""
    found = {field.name: {**_field(field), "description": field.meaning} for field in fields}
    if not filled_in:
        return found
    return found | {f.name: {**found[f.name], "default": f.default} for f in fields if f.default is not None}


def _field(field: Field) -> Json:
    """Return the schema of a field's values."""
    if field.kind == RECORD:
        return _record(field)
    if field.kind == MAPPING:
        return _mapping(field)
    if field.kind == WORD:
        return {"const": field.values[0]} if len(field.values) == 1 else {"enum": list(field.values)}
    return _reference(field.name) if field.kind == KINDS else _SIMPLE[field.kind]


_SIMPLE: Mapping[str, Json] = {
    NUMBER: _reference("number"),
    VECTOR: _reference("vector"),
    FLAG: _FLAG,
    POINTS: {"type": "array", "items": _list({"type": ["number", "string"]}, 2), "minItems": 2},
    DEPTHS: {"type": ["array", "number", "string"], "items": {"type": ["number", "string"]}, "minItems": 8},
    RESULTS: {"type": ["array", "string", "null"], "items": {"type": "string"}},
    TEXT: {"type": ["string", "number"]},
    NAME: _reference("name"),
    BODY: _reference("name"),
    CORNERS: _list(_reference("name"), 3),
    LAW: {"type": "object"},  # what it holds depends on `extends`: see _record
}


def _record(field: Field) -> Json:
    """Return the schema of a mapping with known keys; an empty optional section is null."""
    properties = _described(field.fields, field.below("extends") is None)
    for below in field.fields if field is FILE else ():
        if below.kind in (MAPPING, RECORD) and not below.required:
            properties[below.name]["type"] = ["object", "null"]
        elif below.kind == MAPPING:
            properties[below.name]["minProperties"] = 1
    made = _object(properties, _required(field.fields))
    if either := [below for below in field.fields if below.either]:
        made["oneOf"] = [{"required": [name]} for below in either for name in (below.name, below.either)]
    roles = [below.name for below in field.fields if below.kind == LAW]
    if roles:  # an inherited key is not required
        made["if"] = {"required": ["extends"]}
        made["then"] = {"properties": {role: _reference(f"{role}_part") for role in roles}}
        made["else"] = {"properties": {role: _reference(f"{role}_whole") for role in roles}}
    return made


def _mapping(field: Field) -> Json:
    """Return the schema of a mapping with user-defined names."""
    assert field.entry is not None
    keys = _reference("name") if field.keys is None else _of_bodies("", field.keys)
    if field.addresses:
        known = "|".join(address.replace(".", "\\.").replace("NAME", _NAME) for address in field.addresses)
        keys = {"pattern": f"^({known})$"}
    if field.entry.kind == PLACE and field.keys:  # a coordinate has a number, any other name of a body a point
        points = {f"^{_NAME}\\.(?!({'|'.join(field.keys)})$){_NAME}$": _reference("vector")}
        numbers = {str(keys["pattern"]): _reference("number")}
        return {"type": "object", "patternProperties": numbers | points, "additionalProperties": False}
    return {"type": "object", "propertyNames": keys, "additionalProperties": _field(field.entry)}


def _kinds(family: Field) -> list[tuple[str, Kind]]:
    """Return the kinds of a family of entries by name."""
    return list(family.kinds().items()) if family.kinds else []


def _kind(name: str, kind: Kind) -> Json:
    """Return the schema of one kind of entry: its targets and its fields; one target is a text, two are a list."""
    item = _reference(kind.targets)
    forms = [item if count == 1 else _list(item, count) for count in kind.counts]
    targets = forms[0] if len(forms) == 1 else {"anyOf": forms}
    own = _object({name: targets, **_described(kind.fields)}, [name, *_required(kind.fields)])
    return {"title": kind.title, **own}


def _law(role: Field, whole: bool) -> Json:
    """Return the schema of a law of a contact; `whole` requires all its numbers, since nothing is inherited."""
    own = _kinds(role)
    known: dict[str, Json] = {field.name: {} for _, law in own for field in law.fields}
    made = _object({**known, "law": {"enum": [name for name, _ in own]}}, ["law"] if whole else [])
    made["allOf"] = [
        {
            "if": {"properties": {"law": {"const": name}}, "required": ["law"]},
            "then": {
                **_object({"law": True, **_described(law.fields, whole)}),
                "required": _required(law.fields) if whole else [],
            },
        }
        for name, law in own
    ]
    return made

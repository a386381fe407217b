"""The format as a JSON Schema (draft 2020-12), for editors: written from what the reader itself reads by.

The shapes are those of schema.py; what joints, drives, forces and laws hold is what their files declare. A schema
sees names, kinds and shapes; units, references and ranges are told by the reader alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, get_args, get_origin

from pydantic import BaseModel

from gudgeon.generator.kinds.forces.force_type import element_types
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.kinds.laws.law import Law, LawOption, laws
from gudgeon.generator.reader.bodies import COORDINATES, RATES
from gudgeon.generator.reader.contacts import ROLES
from gudgeon.generator.reader.drives import DRIVES
from gudgeon.generator.reader.fields import Field
from gudgeon.generator.reader.scenes import ACTIONS, DIRECTIONS
from gudgeon.generator.yaml.shapes import FORMAT, ContactShape, FileShape, Shape, inner
from gudgeon.generator.yaml.tree import Map, Text
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
_TEXT: Json = {"type": ["string", "number"]}
_WORDS = {  # fields of the shapes whose text is no number
    "format": {"const": FORMAT},
    "name": {"$ref": "#/$defs/name"},
    "title": _TEXT,
    "extends": {"$ref": "#/$defs/name"},
    "bearing": {"$ref": "#/$defs/name"},
    "contact": {"$ref": "#/$defs/name"},
    "bearing_material": {"$ref": "#/$defs/name"},
    "journal_material": {"$ref": "#/$defs/name"},
    "clip_ratio": _FLAG,
    "direction": {"enum": list(DIRECTIONS)},
    "action": {"enum": list(ACTIONS)},
}  # fmt: skip


def schema() -> Json:
    """The schema of a mechanism file, as JSON."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"mechanism file, {FORMAT}",
        **_shape(FileShape),
        "$defs": {
            "name": {"type": "string", "pattern": f"^{_NAME}$", "maxLength": LONGEST_NAME},
            "number": _NUMBER,
            "vector": _list(_reference("number"), 2),
            "bodies": {"type": "string", "pattern": f"^{_NAME}$"},
            "points": {"type": "string", "pattern": f"^{_NAME}\\.{_NAME}$"},
            "coordinates": {"type": "string", "pattern": f"^{_NAME}\\.({'|'.join(COORDINATES)})$"},
            "joint": _kinds({
                kind: (of.title, of.joins, (2,), of.fields) for kind, of in joint_types().items()
            }),
            "drive": {"oneOf": [
                _entry(kind, "", _targets(of.targets, of.counts), {"value": _reference("number")}, ["value"])
                for kind, of in DRIVES.items()
            ]},
            "force": _kinds({
                kind: (of.title, of.targets, of.counts, of.fields) for kind, of in element_types().items()
            }),
            **{f"{role}_{use}": _role(role, use == "whole") for role in ROLES for use in ("whole", "part")},
        },
    }  # fmt: skip


def _reference(name: str) -> Json:
    return {"$ref": f"#/$defs/{name}"}


def _list(item: Json, count: int) -> Json:
    return {"type": "array", "items": item, "minItems": count, "maxItems": count}


def _object(properties: Mapping[str, Any], required: Sequence[str] = ()) -> Json:
    return {
        "type": "object", "properties": dict(properties), "required": list(required), "additionalProperties": False,
    }  # fmt: skip


def _shape(shape: type[BaseModel]) -> Json:
    """A shape of schema.py."""
    properties = {name: _field(shape, name, field.annotation) for name, field in shape.model_fields.items()}
    made = _object(properties, [name for name, field in shape.model_fields.items() if field.is_required()])
    if shape is ContactShape:  # what a contact inherits it need not give itself
        made["if"] = {"required": ["extends"]}
        made["then"] = {"properties": {role: _reference(f"{role}_part") for role in ROLES}}
        made["else"] = {"properties": {role: _reference(f"{role}_whole") for role in ROLES}}
    return made


_SECTIONS_OF_KINDS = {"joints": "joint", "drives": "drive", "forces": "force"}
_KEYS = {"guess": COORDINATES, "set": COORDINATES, "rates": RATES}


def _field(shape: type[BaseModel], name: str, annotation: Any) -> Json:
    """One field of a shape; a section with nothing in it is null."""
    of = inner(annotation)
    if get_origin(of) is dict:
        keys: Json = _reference("name")
        if name in _KEYS:
            keys = {"pattern": f"^{_NAME}\\.({'|'.join(_KEYS[name])})$"}
        entry = _reference(_SECTIONS_OF_KINDS[name]) if name in _SECTIONS_OF_KINDS else _value(get_args(of)[1], "")
        made: Json = {"type": "object", "propertyNames": keys, "additionalProperties": entry}
    else:
        made = _value(of, name)
    if name == "bodies":
        return {**made, "minProperties": 1}
    is_section = shape is FileShape and isinstance(made.get("type"), str) and made["type"] == "object"
    return {**made, "type": ["object", "null"]} if is_section else made


def _value(of: Any, name: str) -> Json:
    """What a type of the shapes stands for."""
    if of is Text:
        return _WORDS.get(name, _reference("number"))
    if of is Map:
        return {"type": "object"}
    if isinstance(of, type) and issubclass(of, Shape):
        return _shape(of)
    return _reference("vector")  # Pair


def _kinds(kinds: Mapping[str, tuple[str, str, Sequence[int], Sequence[Field]]]) -> Json:
    """One entry a kind: its targets and its own fields."""
    return {
        "oneOf": [
            _entry(
                kind, title, _targets(targets, counts), {field.name: _own(field) for field in fields},
                [field.name for field in fields if field.required],
            )
            for kind, (title, targets, counts, fields) in kinds.items()
        ]
    }  # fmt: skip


def _entry(kind: str, title: str, targets: Json, fields: Mapping[str, Json], required: Sequence[str]) -> Json:
    made = _object({kind: targets, **fields}, [kind, *required])
    return {"title": title, **made} if title else made


def _targets(what: str, counts: Sequence[int]) -> Json:
    """One target is written alone, two as a list."""
    forms = [_reference(what) if count == 1 else _list(_reference(what), count) for count in counts]
    return forms[0] if len(forms) == 1 else {"anyOf": forms}


def _own(field: Field) -> Json:
    """A field that a joint's or a force element's file declares."""
    of: Json
    if field.kind == "option":
        of = _FLAG if field.values == ("false", "true") else {"enum": list(field.values)}
    else:
        of = _reference({"vector": "vector", "quantity": "number", "body": "name"}[field.kind])
    return {**of, "description": field.meaning}


def _role(role: str, whole: bool) -> Json:
    """A law of a contact; `whole`: with all its numbers, since nothing is inherited."""
    own = [law for law in laws().values() if law.role == role]
    names = {"law": {"enum": [law.name for law in own]}}
    known: dict[str, Json] = {name: {} for law in own for name in _law_keys(law)}
    made = _object({**known, **names}, ["law"] if whole else [])
    made["allOf"] = [
        {
            "if": {"properties": {"law": {"const": law.name}}, "required": ["law"]},
            "then": {
                **_object({"law": True, **_law_keys(law)}),
                "required": [p.name for p in law.parameters if p.default is None] if whole else [],
            },
        }
        for law in own
    ]
    return made


def _law_keys(law: Law) -> dict[str, Json]:
    numbers = {p.name: {**_reference("number"), "description": p.meaning} for p in law.parameters}
    return numbers | {option.name: _option(option) for option in law.options}


def _option(option: LawOption) -> Json:
    flag = all(isinstance(value, bool) for value in option.values)
    return {**(_FLAG if flag else {"enum": list(option.values)}), "description": option.meaning}

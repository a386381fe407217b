"""Writes the format of study files as a JSON Schema (draft 2020-12) for editors.

The schema covers keys, kinds and shapes; units, names and ranges are checked by the reader only.
"""

from __future__ import annotations

from typing import Any

from gudgeon.contract.methods import KINEMATIC, OFFERED
from gudgeon.generator.study.claims import DESCRIPTIVE_KEYS, STATEMENT_KEYS
from gudgeon.generator.study.parts import MAX_COUNT, MAX_ROUNDS, MAX_SEED, MAX_TEXT_LENGTH, MAX_TITLE_LENGTH
from gudgeon.generator.study.read import MAX_TITLE, SERIES_STATISTICS, WINDOW_STATISTICS
from gudgeon.generator.study.spec import (
    COUNTED_PARTS,
    DEPRECATED_STATISTICS,
    DEVIATIONS,
    FORMAT,
    GEOMETRIC,
    LINEAR,
    NORMAL,
    SAMPLING_METHODS,
    STATISTICS,
    UNIFORM,
    WEAR_LAWS,
)
from gudgeon.language.names import LABEL

Json = dict[str, Any]

_NUMBER: Json = {"type": ["number", "string"]}
_TEXT: Json = {"type": "string", "minLength": 1}
_LIST: Json = {"anyOf": [_NUMBER, {"type": "array", "items": _NUMBER, "minItems": 1}]}
_SPACING: Json = {"enum": [LINEAR, GEOMETRIC]}


def make_study_schema() -> Json:
    """Return the JSON Schema of a study file, with or without parts."""
    value_range = _make_object_schema(
        {"from": _NUMBER, "to": _NUMBER, "count": _make_count_schema(2), "spacing": _SPACING}, "from", "to", "count"
    )
    values = {"anyOf": [*_LIST["anyOf"], value_range]}
    names = {"anyOf": [_TEXT, {"type": "array", "items": _TEXT}]}
    part_properties = {
        "title": {"type": "string", "maxLength": MAX_TITLE},
        "mechanism": _TEXT | {"description": "a file next to this one, or the name of a shipped mechanism"},
        "scenes": names,
        "choices": _make_map_schema({"anyOf": [*_LIST["anyOf"], _make_map_schema(_make_map_schema(_NUMBER))]}),
        "parameters": _make_map_schema(values),
        "zip": _make_map_schema(_make_map_schema(values)),
        "draw": _make_draw_schema(),
        "starts": _make_starts_schema(),
        "t_end": _NUMBER,
        "output": _NUMBER,
        "step": _NUMBER,
        "method": {"enum": [*OFFERED, KINEMATIC]},
        "rtol": _NUMBER,
        "stop": {"enum": [True, False, "true", "false"]},
        "windows": _make_map_schema(_make_object_schema({"from": _NUMBER, "to": _NUMBER}), LABEL),
        "measures": _make_map_schema(_make_measure_schema(), LABEL),
        "keep": names,
        "wear": _make_wear_schema(),
    }
    parts = _make_map_schema(_make_object_schema(part_properties), LABEL) | {"minProperties": 1}
    titles = _make_map_schema(_TEXT | {"maxLength": MAX_TITLE_LENGTH})
    file_properties = {
        "format": {"const": FORMAT},
        "parts": parts,
        "claims": _make_claims_schema(),
        "titles": titles,
        "about": _make_about_schema(),
    }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"study file, {FORMAT}",
        **_make_object_schema(file_properties | part_properties, "format"),
        "anyOf": [{"required": ["mechanism"]}, {"required": ["parts"]}],
    }


def _make_object_schema(properties: Json, *required: str) -> Json:
    """Return the schema of a mapping with known keys, of which those in `required` must be present."""
    return {"type": "object", "properties": properties, "required": list(required), "additionalProperties": False}


def _make_map_schema(values: Json, name_pattern: str = "") -> Json:
    """Return the schema of a mapping of names to values of one schema.

    `name_pattern` is a pattern of the names, "" for any.
    """
    schema_of_map = {"type": "object", "additionalProperties": values}
    return schema_of_map | {"propertyNames": {"pattern": f"^{name_pattern}$"}} if name_pattern else schema_of_map


def _make_count_schema(minimum: int) -> Json:
    """Return the schema of a whole number from `minimum` to MAX_COUNT."""
    return {"type": "integer", "minimum": minimum, "maximum": MAX_COUNT}


def _make_draw_schema() -> Json:
    """Return the schema of `draw`: count, seed, method, and a distribution for each parameter."""
    normal_distribution = _make_object_schema({"mean": _NUMBER, "std": _NUMBER}, "mean", "std")
    range_distribution = _make_object_schema({"from": _NUMBER, "to": _NUMBER, "spacing": _SPACING}, "from", "to")
    seed = {"type": "integer", "minimum": 0, "maximum": MAX_SEED}
    spreads = _make_map_schema({"anyOf": [normal_distribution, range_distribution]}) | {"minProperties": 1}
    properties = {
        "count": _make_count_schema(1),
        "seed": seed,
        "method": {"enum": list(SAMPLING_METHODS)},
        "parameters": spreads,
    }
    return _make_object_schema(properties, "count", "parameters")


def _make_wear_schema() -> Json:
    """Return the schema of `wear`: joints, rounds, the wear law and its numbers."""
    numbers = dict.fromkeys(("k", "hardness", "scale"), _NUMBER)
    joints = {"anyOf": [_TEXT, {"type": "array", "items": _TEXT, "minItems": 1}]}
    rounds = {"type": "integer", "minimum": 1, "maximum": MAX_ROUNDS}
    properties = {"joints": joints, "rounds": rounds, "law": {"enum": list(WEAR_LAWS)}}
    return _make_object_schema(properties | numbers, "joints", "rounds", "k")


def _make_starts_schema() -> Json:
    """Return the schema of `starts`: count, seed, distribution and deviations.

    The deviations may be grouped in named ensembles.
    """
    sizes = {"relative": _make_map_schema(_NUMBER), "absolute": _make_map_schema(_NUMBER)}
    seed = {"type": "integer", "minimum": 0, "maximum": MAX_SEED}
    properties = {"count": _make_count_schema(1), "seed": seed, "distribution": {"enum": [UNIFORM, NORMAL]}}
    return _make_object_schema(
        properties | sizes | {"ensembles": _make_map_schema(_make_object_schema(sizes), LABEL)}, "count"
    )


def _make_about_schema() -> Json:
    """Return the schema of `about`: a paragraph or a nonempty list of paragraphs."""
    paragraph = {"type": "string", "minLength": 1, "maxLength": MAX_TEXT_LENGTH}
    return {"anyOf": [paragraph, {"type": "array", "items": paragraph, "minItems": 1}]}


def _make_claims_schema() -> Json:
    """Return the schema of `claims`: an object with the keys `source`, `numbers` and `trends`.

    `numbers` and `trends` map labels to a number or a trend. A trend has one statement, a list of them under `all`, or
    the reason `not_computed`.
    """
    coordinate_values, texts = (
        _make_map_schema(_NUMBER),
        {"anyOf": [_TEXT, {"type": "array", "items": _TEXT, "minItems": 1}]},
    )
    descriptive = {key: {"type": "string", "maxLength": MAX_TEXT_LENGTH} for key in DESCRIPTIVE_KEYS}
    number = _make_object_schema(
        descriptive | {"measure": _TEXT, "part": _TEXT, "at": coordinate_values, "value": _NUMBER, "beside": _TEXT},
        "measure",
    )
    counts = {
        "type": "object",
        "properties": {name: {"type": "integer", "minimum": 0} for name in COUNTED_PARTS},
        "additionalProperties": False,
    }
    statement_properties: Json = dict.fromkeys(STATEMENT_KEYS, _NUMBER) | dict.fromkeys(
        ("larger", "than", "from", "to", "at"), coordinate_values
    )
    statement_properties |= {
        "measure": texts,
        "more_than": texts,
        "most_lowered": texts,
        "counts": counts,
        "part": _TEXT,
    }
    trend_properties = {
        "all": {"type": "array", "items": _make_object_schema(statement_properties), "minItems": 1},
        "not_computed": _TEXT,
    }
    trend = _make_object_schema(descriptive | statement_properties | trend_properties)
    source = {"type": "string", "maxLength": MAX_TEXT_LENGTH}
    return _make_object_schema(
        {"source": source, "numbers": _make_map_schema(number, LABEL), "trends": _make_map_schema(trend, LABEL)}
    )


def _make_measure_schema() -> Json:
    """Return the schema of a measure: one statistic, with a window or another scene where the statistic allows it."""
    alternatives = []
    for name in (*STATISTICS, *DEPRECATED_STATISTICS):
        properties = {name: _TEXT} | {
            key: _TEXT
            for key, statistics in (("window", WINDOW_STATISTICS), ("from", SERIES_STATISTICS))
            if DEPRECATED_STATISTICS.get(name, (name,))[0] in statistics
        }
        alternatives.append(_make_object_schema(properties, name, *(["from"] if name in DEVIATIONS else [])))
    return {"oneOf": alternatives}

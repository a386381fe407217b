"""Writes the format of study files as a JSON Schema (draft 2020-12) for editors.

The schema covers keys, kinds and shapes; units, names and ranges are checked by the reader only.
"""

from __future__ import annotations

from typing import Any

from gudgeon.contract.methods import KINEMATIC, OFFERED
from gudgeon.generator.study.claims import MESSAGES, TRIAL
from gudgeon.generator.study.parts import MAX_COUNT, MAX_SEED, MOST, MOST_ROUNDS, MOST_TEXT
from gudgeon.generator.study.read import MAX_TITLE, OF_SERIES, WINDOWED
from gudgeon.generator.study.spec import (
    COUNTED,
    DEVIATIONS,
    DRAWN,
    FORMAT,
    GEOMETRIC,
    LINEAR,
    NORMAL,
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


def schema() -> Json:
    """Return the JSON Schema of a study file."""
    row = _record({"from": _NUMBER, "to": _NUMBER, "count": _count(2), "spacing": _SPACING}, "from", "to", "count")
    values = {"anyOf": [*_LIST["anyOf"], row]}
    names = {"anyOf": [_TEXT, {"type": "array", "items": _TEXT}]}
    own = {
        "title": {"type": "string", "maxLength": MAX_TITLE},
        "mechanism": _TEXT | {"description": "a file beside this one, or the name of a shipped mechanism"},
        "scenes": names,
        "choices": _map({"anyOf": [*_LIST["anyOf"], _map(_map(_NUMBER))]}),
        "parameters": _map(values),
        "zip": _map(_map(values)),
        "draw": _draw(),
        "starts": _starts(),
        "t_end": _NUMBER,
        "output": _NUMBER,
        "step": _NUMBER,
        "method": {"enum": [*OFFERED, KINEMATIC]},
        "rtol": _NUMBER,
        "stop": {"enum": [True, False, "true", "false"]},
        "windows": _map(_record({"from": _NUMBER, "to": _NUMBER}), LABEL),
        "measures": _map(_measure(), LABEL),
        "keep": names,
        "wear": _wear(),
    }
    parts = _map(_record(own), LABEL) | {"minProperties": 1}
    titles = _map(_TEXT | {"maxLength": MOST})
    whole = {"format": {"const": FORMAT}, "parts": parts, "claims": _claims(), "titles": titles, "about": _about()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"study file, {FORMAT}",
        **_record(whole | own, "format"),
        "anyOf": [{"required": ["mechanism"]}, {"required": ["parts"]}],
    }


def _record(properties: Json, *required: str) -> Json:
    """Return the schema of a mapping with known keys, of which some are required."""
    return {"type": "object", "properties": properties, "required": list(required), "additionalProperties": False}


def _map(values: Json, names: str = "") -> Json:
    """Return the schema of a mapping of names to values of one schema; `names` is a pattern of the names."""
    found = {"type": "object", "additionalProperties": values}
    return found | {"propertyNames": {"pattern": f"^{names}$"}} if names else found


def _count(least: int) -> Json:
    """Return the schema of a whole number of at least `least`."""
    return {"type": "integer", "minimum": least, "maximum": MAX_COUNT}


def _draw() -> Json:
    """Return the schema of `draw`."""
    normal = _record({"mean": _NUMBER, "std": _NUMBER}, "mean", "std")
    between = _record({"from": _NUMBER, "to": _NUMBER, "spacing": _SPACING}, "from", "to")
    seed = {"type": "integer", "minimum": 0, "maximum": MAX_SEED}
    spreads = _map({"anyOf": [normal, between]}) | {"minProperties": 1}
    own = {"count": _count(1), "seed": seed, "method": {"enum": list(DRAWN)}, "parameters": spreads}
    return _record(own, "count", "parameters")


def _wear() -> Json:
    """Return the schema of `wear`."""
    numbers = dict.fromkeys(("k", "hardness", "scale"), _NUMBER)
    joints = {"anyOf": [_TEXT, {"type": "array", "items": _TEXT, "minItems": 1}]}
    rounds = {"type": "integer", "minimum": 1, "maximum": MOST_ROUNDS}
    own = {"joints": joints, "rounds": rounds, "law": {"enum": list(WEAR_LAWS)}}
    return _record(own | numbers, "joints", "rounds", "k")


def _starts() -> Json:
    """Return the schema of `starts`."""
    sizes = {"relative": _map(_NUMBER), "absolute": _map(_NUMBER)}
    seed = {"type": "integer", "minimum": 0, "maximum": MAX_SEED}
    own = {"count": _count(1), "seed": seed, "distribution": {"enum": [UNIFORM, NORMAL]}}
    return _record(own | sizes | {"ensembles": _map(_record(sizes), LABEL)}, "count")


def _about() -> Json:
    """Return the schema of `about`."""
    paragraph = {"type": "string", "minLength": 1, "maxLength": MOST_TEXT}
    return {"anyOf": [paragraph, {"type": "array", "items": paragraph, "minItems": 1}]}


def _claims() -> Json:
    """Return the schema of `claims`: numbers, and trends with one trial, several or none."""
    at, texts = _map(_NUMBER), {"anyOf": [_TEXT, {"type": "array", "items": _TEXT, "minItems": 1}]}
    descriptive = {key: {"type": "string", "maxLength": MOST_TEXT} for key in MESSAGES}
    number = _record(
        descriptive | {"measure": _TEXT, "part": _TEXT, "at": at, "value": _NUMBER, "beside": _TEXT}, "measure"
    )
    counts = {
        "type": "object",
        "properties": {name: {"type": "integer", "minimum": 0} for name in COUNTED},
        "additionalProperties": False,
    }
    own: Json = dict.fromkeys(TRIAL, _NUMBER) | dict.fromkeys(("larger", "than", "from", "to", "at"), at)
    own |= {"measure": texts, "more_than": texts, "most_lowered": texts, "counts": counts, "part": _TEXT}
    several = {"all": {"type": "array", "items": _record(own), "minItems": 1}, "not_computed": _TEXT}
    trend = _record(descriptive | own | several)
    source = {"type": "string", "maxLength": MOST_TEXT}
    return _record({"source": source, "numbers": _map(number, LABEL), "trends": _map(trend, LABEL)})


def _measure() -> Json:
    """Return the schema of a measure: one statistic, with a window or another scene where the statistic allows it."""
    each = []
    for name in STATISTICS:
        own = {name: _TEXT} | {key: _TEXT for key, of in (("window", WINDOWED), ("from", OF_SERIES)) if name in of}
        each.append(_record(own, name, *(["from"] if name in DEVIATIONS else [])))
    return {"oneOf": each}

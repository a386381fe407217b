"""Convert a scene's description to and from its stored form, which leaves out all that follows from the rest.

`shorten` and `complete` work on the plain data of a KernelSource, and are inverse to each other.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

Data = dict[str, Any]
_UNITS = ("kg", "m", "s")


def base_units(dimension: tuple[float, float, float]) -> str:
    """Return SI base units for exponents of m, kg, s: "kg*m^2/s^2", "kg/m^0.5/s^2"; "" for a pure number."""
    length, mass, time = dimension
    pairs = list(zip(_UNITS, (mass, length, time), strict=True))
    above = "*".join(u if n == 1 else f"{u}^{n}" for u, n in pairs if n > 0)
    below = "".join(f"/{u}" if n == -1 else f"/{u}^{-n}" for u, n in pairs if n < 0)
    return (above or ("1" if below else "")) + below


def shorten(data: Data, defaults: Mapping[str, Any]) -> Data:
    """Return the data without the values that `complete` restores. `data` is changed."""
    for name, follows in _OF_STORY.items():
        _drop_if_equal(data["story"], name, follows(data))
    for name, parts in _OF_PARTS.items():
        for item in data[name]:
            for part, of_item in parts.items():
                _drop_if_equal(item, part, of_item(data, item))
    for name, follows in _FOLLOWING.items():
        _drop_if_equal(data, name, follows(data))
    data["rows"] = [_index_or_row(data["start_rows"], row) for row in data["rows"]]
    usual = {name: value for name, value in defaults.items() if name not in _FOLLOWING}
    return {name: value for name, value in data.items() if name not in usual or _lists_of_tuples(value) != usual[name]}


def complete(data: Data, defaults: Mapping[str, Any]) -> Data:
    """Return the data with all values that follow from the rest. `data` is changed."""
    for name, usual in defaults.items():
        if name not in _FOLLOWING:
            data.setdefault(name, usual)
    data["rows"] = [data["start_rows"][row] if isinstance(row, int) else row for row in data["rows"]]
    for name, parts in _OF_PARTS.items():
        for item in data[name]:
            for part, of_item in parts.items():
                if part not in item:
                    item[part] = of_item(data, item)
    for name, follows in _FOLLOWING.items():
        if name not in data:
            data[name] = follows(data)
    data["story"] = dict(data["story"])
    for name, follows in _OF_STORY.items():
        data["story"].setdefault(name, follows(data))
    return data


def as_text(data: Data) -> str:
    """Return the data as JSON, one line for each name and each item of a list."""
    return "{\n" + ",\n".join(f" {_dumps(name)}: {_format_value(value)}" for name, value in data.items()) + "\n}"


def _format_value(value: Any) -> str:
    """Return a value as JSON, with lists of objects in one line per item."""
    of_parts = isinstance(value, (list, tuple)) and any(isinstance(item, (dict, list, tuple)) for item in value)
    return "[\n" + ",\n".join(f"  {_dumps(item)}" for item in value) + "\n ]" if of_parts else _dumps(value)


def _dumps(value: Any) -> str:
    """Return a value as JSON on one line."""
    return json.dumps(value, ensure_ascii=False)


def _drop_if_equal(data: Data, name: str, value: Any) -> None:
    """Remove a name whose value equals the one that follows from the rest; lists and tuples are equal here."""
    if name in data and _lists_of_tuples(data[name]) == _lists_of_tuples(value):
        del data[name]


def _lists_of_tuples(value: Any) -> Any:
    """Return a value with tuples converted to lists."""
    return [_lists_of_tuples(item) for item in value] if isinstance(value, (list, tuple)) else value


def _index_or_row(rows: list[Data], row: Data) -> Any:
    """Return the index of an equation of the motion among those of the closed linkage; else the equation itself."""
    return rows.index(row) if row in rows else row


def _index_of_row(data: Data, name: str) -> int:
    """Return the index of the equation with this name, or −1."""
    names = [row["name"] for row in data["rows"]]
    return names.index(name) if name in names else -1


def _unit_of_row(data: Data, name: str) -> str:
    """Return the unit of the equation with this name."""
    return next((row["unit"] for row in data["start_rows"] if row["name"] == name), "")


# values of the description that follow from the rest
_FOLLOWING: dict[str, Callable[[Data], Any]] = {
    "coordinates": lambda data: [f"{body['name']}.{c}" for body in data["bodies"] for c in ("x", "y", "theta")],
    "motion_pivots": lambda data: data["pivots"],
}
# values of its items that follow
_OF_PARTS: dict[str, dict[str, Callable[[Data, Data], Any]]] = {
    "bodies": {"index": lambda data, body: 3 * [b["name"] for b in data["bodies"]].index(body["name"])},
    "joints": {
        "rows": lambda data, joint: [r for r, row in enumerate(data["rows"]) if row["owner"] == joint["name"]],
    },
    "drives": {
        "row": lambda data, drive: _index_of_row(data, drive["name"]),
        "unit": lambda data, drive: _unit_of_row(data, drive["name"]),
    },
    "parts": {"options": lambda data, part: {}},
    "slots": {
        "unit": lambda data, slot: base_units(slot["dimension"]),
        "words": lambda data, slot: [],
        "tree": lambda data, slot: "",
    },
}
# values of the reduction record that follow
_OF_STORY: dict[str, Callable[[Data], Any]] = {
    "coordinates": lambda data: data["coordinates"],
    "rows": lambda data: [row["name"] for row in data["start_rows"]],
}


def tuples(item: dict[str, Any]) -> dict[str, Any]:
    """Return JSON data with lists converted to tuples."""
    return {key: tuple(value) if isinstance(value, list) else value for key, value in item.items()}

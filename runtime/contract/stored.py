"""The stored form of a scene's description, in which nothing is said twice: what follows from the rest is left out.

`shorten` and `complete` work on the plain data of a KernelSource; what was given as something else than follows stays,
so that each undoes the other.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

Data = dict[str, Any]
_UNITS = ("kg", "m", "s")


def base_units(dimension: tuple[float, float, float]) -> str:
    """SI base units of exponents of m, kg, s: "kg*m^2/s^2", "kg/m^0.5/s^2"; "" for a pure number."""
    length, mass, time = dimension
    pairs = list(zip(_UNITS, (mass, length, time), strict=True))
    above = "*".join(u if n == 1 else f"{u}^{n}" for u, n in pairs if n > 0)
    below = "".join(f"/{u}" if n == -1 else f"/{u}^{-n}" for u, n in pairs if n < 0)
    return (above or ("1" if below else "")) + below


def shorten(data: Data, defaults: Mapping[str, Any]) -> Data:
    """Without what `complete` puts in again. `data` is changed."""
    for name, follows in _OF_STORY.items():
        _drop(data["story"], name, follows(data))
    for name, parts in _OF_PARTS.items():
        for item in data[name]:
            for part, of_item in parts.items():
                _drop(item, part, of_item(data, item))
    for name, follows in _FOLLOWING.items():
        _drop(data, name, follows(data))
    data["rows"] = [_place(data["start_rows"], row) for row in data["rows"]]
    usual = {name: value for name, value in defaults.items() if name not in _FOLLOWING}
    return {name: value for name, value in data.items() if name not in usual or _plain(value) != usual[name]}


def complete(data: Data, defaults: Mapping[str, Any]) -> Data:
    """With everything that follows. `data` is changed."""
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
    """JSON with a line for each name, and for each item of what is made of parts."""
    return "{\n" + ",\n".join(f" {_dumps(name)}: {_value(value)}" for name, value in data.items()) + "\n}"


def _value(value: Any) -> str:
    of_parts = isinstance(value, (list, tuple)) and any(isinstance(item, (dict, list, tuple)) for item in value)
    return "[\n" + ",\n".join(f"  {_dumps(item)}" for item in value) + "\n ]" if of_parts else _dumps(value)


def _dumps(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


def _drop(data: Data, name: str, value: Any) -> None:
    """What follows anyway; lists and tuples are one thing here."""
    if name in data and _plain(data[name]) == _plain(value):
        del data[name]


def _plain(value: Any) -> Any:
    return [_plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def _place(rows: list[Data], row: Data) -> Any:
    """A row of the motion is one of the closed linkage's: its number there, else itself."""
    return rows.index(row) if row in rows else row


def _row_of(data: Data, name: str) -> int:
    names = [row["name"] for row in data["rows"]]
    return names.index(name) if name in names else -1


def _unit(data: Data, name: str) -> str:
    return next((row["unit"] for row in data["start_rows"] if row["name"] == name), "")


_FOLLOWING: dict[str, Callable[[Data], Any]] = {
    "coordinates": lambda data: [f"{body['name']}.{c}" for body in data["bodies"] for c in ("x", "y", "theta")],
    "motion_pivots": lambda data: data["pivots"],
}
_OF_PARTS: dict[str, dict[str, Callable[[Data, Data], Any]]] = {
    "bodies": {"index": lambda data, body: 3 * [b["name"] for b in data["bodies"]].index(body["name"])},
    "joints": {
        "rows": lambda data, joint: [r for r, row in enumerate(data["rows"]) if row["owner"] == joint["name"]],
    },
    "drives": {
        "row": lambda data, drive: _row_of(data, drive["name"]),
        "unit": lambda data, drive: _unit(data, drive["name"]),
    },
    "parts": {"options": lambda data, part: {}},
    "slots": {
        "unit": lambda data, slot: base_units(slot["dimension"]),
        "words": lambda data, slot: [],
        "tree": lambda data, slot: "",
    },
}
_OF_STORY: dict[str, Callable[[Data], Any]] = {
    "coordinates": lambda data: data["coordinates"],
    "rows": lambda data: [row["name"] for row in data["start_rows"]],
}


def tuples(item: dict[str, Any]) -> dict[str, Any]:
    """JSON knows lists only: the fields of our values are tuples."""
    return {key: tuple(value) if isinstance(value, list) else value for key, value in item.items()}

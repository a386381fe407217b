"""Convert the description of a compiled scene to and from its stored form, without the values that can be derived.

`remove_derived_values` and `restore_derived_values` work on the plain data of a KernelSource, and are inverse to each
other.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

Data = dict[str, Any]
_UNITS = ("kg", "m", "s")


def format_base_units(dimension: tuple[float, float, float]) -> str:
    """Return SI base units for exponents of m, kg, s: "kg*m^2/s^2", "kg/m^0.5/s^2"; "" for a pure number."""
    length, mass, time = dimension
    units_and_exponents = list(zip(_UNITS, (mass, length, time), strict=True))
    numerator = "*".join(
        unit if exponent == 1 else f"{unit}^{exponent}" for unit, exponent in units_and_exponents if exponent > 0
    )
    denominator = "".join(
        f"/{unit}" if exponent == -1 else f"/{unit}^{-exponent}"
        for unit, exponent in units_and_exponents
        if exponent < 0
    )
    return (numerator or ("1" if denominator else "")) + denominator


def remove_derived_values(data: Data, defaults: Mapping[str, Any]) -> Data:
    """Return the data without the values that `restore_derived_values` restores; `data` is changed in place.

    Values that follow from others or equal `defaults` are removed. Constraint equations of the motion that the start
    has too are replaced by their indices in "start_rows".
    """
    for name, derive_value in _DERIVED_IN_LOG.items():
        _drop_if_equal(data["story"], name, derive_value(data))
    for name, derived_parts in _DERIVED_IN_ITEMS.items():
        for item in data[name]:
            for part_name, derive_part in derived_parts.items():
                _drop_if_equal(item, part_name, derive_part(data, item))
    for name, derive_value in _DERIVED_VALUES.items():
        _drop_if_equal(data, name, derive_value(data))
    data["rows"] = [_replace_row_by_index(data["start_rows"], row) for row in data["rows"]]
    other_defaults = {name: value for name, value in defaults.items() if name not in _DERIVED_VALUES}
    return {
        name: value
        for name, value in data.items()
        if name not in other_defaults or _convert_tuples_to_lists(value) != other_defaults[name]
    }


def restore_derived_values(data: Data, defaults: Mapping[str, Any]) -> Data:
    """Return the data with the values that `remove_derived_values` removed; `data` is changed in place.

    Values that are present are kept. Defaults are added first, then indices of constraint equations are replaced by the
    equations, then values that follow from others are computed.
    """
    for name, default in defaults.items():
        if name not in _DERIVED_VALUES:
            data.setdefault(name, default)
    data["rows"] = [data["start_rows"][row] if isinstance(row, int) else row for row in data["rows"]]
    for name, derived_parts in _DERIVED_IN_ITEMS.items():
        for item in data[name]:
            for part_name, derive_part in derived_parts.items():
                if part_name not in item:
                    item[part_name] = derive_part(data, item)
    for name, derive_value in _DERIVED_VALUES.items():
        if name not in data:
            data[name] = derive_value(data)
    data["story"] = dict(data["story"])
    for name, derive_value in _DERIVED_IN_LOG.items():
        data["story"].setdefault(name, derive_value(data))
    return data


def format_json(data: Data) -> str:
    """Return the data as JSON text, one line for each name and each item of a list."""
    return (
        "{\n"
        + ",\n".join(f" {_serialize_json(name)}: {_format_json_value(value)}" for name, value in data.items())
        + "\n}"
    )


def _format_json_value(value: Any) -> str:
    """Return a value as JSON, with lists of objects or lists in one line per item."""
    is_list_of_records = isinstance(value, (list, tuple)) and any(
        isinstance(item, (dict, list, tuple)) for item in value
    )
    return (
        "[\n" + ",\n".join(f"  {_serialize_json(item)}" for item in value) + "\n ]"
        if is_list_of_records
        else _serialize_json(value)
    )


def _serialize_json(value: Any) -> str:
    """Return a value as JSON on one line."""
    return json.dumps(value, ensure_ascii=False)


def _drop_if_equal(data: Data, name: str, value: Any) -> None:
    """Remove a name from `data` if its value equals `value`; lists and tuples are equal here."""
    if name in data and _convert_tuples_to_lists(data[name]) == _convert_tuples_to_lists(value):
        del data[name]


def _convert_tuples_to_lists(value: Any) -> Any:
    """Return a value with tuples converted to lists, recursively; other values are returned as they are."""
    return [_convert_tuples_to_lists(item) for item in value] if isinstance(value, (list, tuple)) else value


def _replace_row_by_index(rows: list[Data], row: Data) -> Any:
    """Return the index of an equation of the motion among those of the start (`rows`); else the equation itself."""
    return rows.index(row) if row in rows else row


def _find_row_index(data: Data, name: str) -> int:
    """Return the index of the constraint equation with this name among those of the motion, −1 if there is none."""
    names = [row["name"] for row in data["rows"]]
    return names.index(name) if name in names else -1


def _find_row_unit(data: Data, name: str) -> str:
    """Return the unit of the constraint equation with this name; "" if there is none."""
    return next((row["unit"] for row in data["start_rows"] if row["name"] == name), "")


# values of the description that are derived from the rest
_DERIVED_VALUES: dict[str, Callable[[Data], Any]] = {
    "coordinates": lambda data: [f"{body['name']}.{c}" for body in data["bodies"] for c in ("x", "y", "theta")],
    "motion_pivots": lambda data: data["pivots"],
}
# derived values of the items in lists of the description, by list
_DERIVED_IN_ITEMS: dict[str, dict[str, Callable[[Data, Data], Any]]] = {
    "bodies": {"index": lambda data, body: 3 * [b["name"] for b in data["bodies"]].index(body["name"])},
    "joints": {
        "rows": lambda data, joint: [r for r, row in enumerate(data["rows"]) if row["owner"] == joint["name"]],
    },
    "drives": {
        "row": lambda data, drive: _find_row_index(data, drive["name"]),
        "unit": lambda data, drive: _find_row_unit(data, drive["name"]),
    },
    "parts": {"options": lambda data, part: {}},
    "slots": {
        "unit": lambda data, slot: format_base_units(slot["dimension"]),
        "words": lambda data, slot: [],
        "tree": lambda data, slot: "",
    },
}
# derived values of the reduction record
_DERIVED_IN_LOG: dict[str, Callable[[Data], Any]] = {
    "coordinates": lambda data: data["coordinates"],
    "rows": lambda data: [row["name"] for row in data["start_rows"]],
}


def convert_lists_to_tuples(item: dict[str, Any]) -> dict[str, Any]:
    """Return a mapping of JSON data with its lists converted to tuples; inner lists stay."""
    return {key: tuple(value) if isinstance(value, list) else value for key, value in item.items()}

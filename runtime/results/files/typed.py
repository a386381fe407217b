"""Are the fields of a frozen dataclass what they are declared to be? For what was read from a file of anybody's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints


def check_typed(value: Any, kind: Any, where: str) -> None:
    """TypeError that says where, unless `value` is of `kind`: a dataclass, tuple, mapping, union, str or number."""
    if kind is Any:
        return
    origin = get_origin(kind)
    if origin is tuple:
        _check_tuple(value, get_args(kind), where)
    elif isinstance(origin, type) and issubclass(origin, Mapping):
        _check_class(value, Mapping, where)
        for key, item in value.items():
            _check_class(key, str, where)
            check_typed(item, get_args(kind)[1], f"{where}.{key}")
    elif isinstance(kind, UnionType):
        if not any(_is_typed(value, one) for one in get_args(kind)):
            raise TypeError(f"{where} is {type(value).__name__}, expected {kind}")
    elif isinstance(kind, type) and is_dataclass(kind):
        _check_class(value, kind, where)
        for name, one in _hints(kind).items():
            check_typed(getattr(value, name), one, f"{where}.{name}")
    else:
        _check_class(value, {float: (float, int)}.get(kind, kind), where)


def _is_typed(value: Any, kind: Any) -> bool:
    try:
        check_typed(value, kind, "")
    except TypeError:
        return False
    return True


def _check_tuple(value: Any, kinds: tuple[Any, ...], where: str) -> None:
    _check_class(value, tuple, where)
    if len(kinds) == 2 and kinds[1] is Ellipsis:
        kinds = kinds[:1] * len(value)
    if len(kinds) != len(value):
        raise TypeError(f"{where} has {len(value)} entries, expected {len(kinds)}")
    for k, (item, kind) in enumerate(zip(value, kinds, strict=True)):
        check_typed(item, kind, f"{where}[{k}]")


def _check_class(value: Any, kind: Any, where: str) -> None:
    is_bool = isinstance(value, bool) and kind is not bool
    if is_bool or not isinstance(value, NoneType if kind is None else kind):
        raise TypeError(f"{where} is {type(value).__name__}, expected {kind}")


@cache
def _hints(kind: Any) -> dict[str, Any]:
    hints = get_type_hints(kind)
    return {field.name: hints[field.name] for field in fields(kind)}

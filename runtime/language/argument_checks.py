"""Check arguments other than arrays: texts, flags, functions, mappings, counts, files.

Each function returns the checked value or raises BadValueError with its name, the given and the expected value.
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NoReturn, TypeGuard, TypeVar

import numpy as np

from gudgeon.errors import BadValueError

One = TypeVar("One")  # type of the items of a checked list
IN_RANGE = "expected a magnitude from 2.3e-308 to 1.7e308"


def message(value: object) -> str:
    """Return a short text of any value for a message."""
    if isinstance(value, (str, bytes)):
        return repr(value[:60])
    try:
        text = repr(value)
    except Exception:  # an integer of thousands of digits, an object's own mistake
        text = ""
    if value is None or (isinstance(value, (int, float)) and text):
        return text[:60]
    return f"{type(value).__name__} {text[:60]}".strip()


def refuse(name: str, value: object, expected: str, hint: str = "") -> NoReturn:
    """Raise BadValueError: the argument `name` has a value other than expected."""
    raise BadValueError(f"{name} is {message(value)}: expected {expected}", hint=hint)


def flag(value: object, name: str) -> bool:
    """Return a flag as bool. Only True and False of Python or NumPy are accepted."""
    if not isinstance(value, (bool, np.bool_)):
        refuse(name, value, "True or False")
    return bool(value)


def text(value: object, name: str, expected: str = "a text") -> str:
    """Return a text that can be encoded as UTF-8."""
    if not isinstance(value, str):
        refuse(name, value, expected)
    try:
        value.encode()
    except UnicodeEncodeError:
        refuse(name, value, f"{expected} of whole characters")
    return value


def function(value: Any, name: str) -> Any:
    """Return a callable, or None."""
    if value is not None and not callable(value):
        refuse(name, value, "a function, or None")
    return value


def path(value: Any, name: str) -> str | os.PathLike[str]:
    """Return the name of a file."""
    if not isinstance(value, (str, os.PathLike)) or not isinstance(os.fspath(value), str):
        refuse(name, value, "the name of a file: a text or a Path")
    try:
        known = b"\0" not in os.fsencode(value)
    except UnicodeEncodeError:
        known = False
    if not known:
        refuse(name, value, "a name that a file can have")
    return value


def is_whole(value: object) -> TypeGuard[int]:
    """Return whether a value is an integer of Python or NumPy, but neither a boolean nor a timedelta."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, (bool, np.timedelta64))


def whole(value: Any, name: str, least: int, most: int) -> int:
    """Return an integer between bounds."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if not is_whole(value) or not least <= value <= most:
        refuse(name, value, f"a whole number from {least} to {most}")
    return int(value)


def number_of(value: Any, name: str) -> float:
    """Return a finite float from any real number, but not from a text or boolean. Raise BadValueError."""
    try:
        if isinstance(value, (str, bytes, bool, np.bool_)) or np.ndim(value) or np.iscomplexobj(value):
            raise TypeError
        if isinstance(value, np.ndarray) and value.dtype.kind in "mMb":  # of a time without a unit NumPy makes a number
            raise TypeError
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        shown = value if isinstance(value, str) else message(value)
        raise BadValueError(f"{name}: {shown[:60]!r} is not one real number") from None
    if not math.isfinite(result):
        raise BadValueError(f"{name}: {value!r} is not a finite number")
    return result


def whole_digits(value: float, name: str) -> float:
    """Return a number unless it is subnormal, since such numbers have lost digits. Raise BadValueError."""
    if value and abs(value) < sys.float_info.min:
        raise BadValueError(f"{name}: {value!r} is out of range", hint=IN_RANGE)
    return value


def time(value: Any) -> float:
    """Return a time (s) as float. NaN and infinities are kept for C to handle."""
    return value if isinstance(value, float) else number_of(value, "t")


def mapping(value: Any, name: str, hint: str = "") -> Mapping[str, Any]:
    """Return a mapping with texts as keys; a pandas Series is accepted, None is an empty mapping."""
    if value is None:
        return {}
    found = value
    if not isinstance(value, Mapping) and getattr(value, "ndim", 0) == 1 and callable(getattr(value, "items", None)):
        found = dict(value.items())
        if len(found) != len(value):
            raise BadValueError(f"{name}: its index has a name twice", hint="give each number once")
    if not isinstance(found, Mapping):
        raise BadValueError(f"{name} is a {type(value).__name__}: expected a mapping", hint=hint)
    for key in found:
        if not isinstance(key, str):
            raise BadValueError(f"{name}: its key {message(key)} is no text", hint=hint)
    return found


def listed(value: Any, name: str, kind: type[One], expected: str) -> list[One]:
    """Return a list of items of one type from any sequence but a text; arrays and table columns are accepted."""
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable) or getattr(value, "ndim", 1) != 1:
        refuse(name, value, expected)
    if isinstance(value, Sequence) or len(getattr(value, "shape", ())) == 0 or len(value) < 10**6:  # type: ignore[arg-type]
        found = list(value)
        if all(isinstance(one, kind) for one in found):
            return found
    refuse(name, value, expected)


def names(value: Any, name: str, expected: str) -> list[str]:
    """Return one name or several names in any sequence or set as a list of plain texts."""
    every = [value] if isinstance(value, str) else listed(value, name, str, expected)
    return [str.__str__(text(one, name, expected)) for one in every]


def instance(value: Any, name: str, kind: type[One]) -> One:
    """Return an instance of a class."""
    if not isinstance(value, kind):
        refuse(name, value, f"a {kind.__name__}")
    return value


def optional(value: Any, name: str, kind: type[One]) -> One | None:
    """Return an instance of a class, or None."""
    return None if value is None else instance(value, name, kind)


def positive(value: Any, name: str) -> float:
    """Return a positive number."""
    number = number_of(value, name)
    if not number > 0.0:
        refuse(name, value, "a number above zero")
    return number


def optional_positive(value: Any, name: str) -> float | None:
    """Return a positive number, or None."""
    return None if value is None else positive(value, name)


def numbers(values: Any, name: str) -> list[float]:
    """Return the finite numbers of a list, an array or a column; [] for None."""
    every: list[Any] = [] if values is None else listed(values, name, object, "a list of numbers")
    return [number_of(value, f"{name}[{k}]") for k, value in enumerate(every)]

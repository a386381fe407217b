"""Arguments that are no arrays: texts, flags, functions, mappings, counts, files.

Each is what it should be, or refused: a BadValueError with its name, what was given and what was expected.
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NoReturn, TypeGuard, TypeVar

import numpy as np

from gudgeon.errors import BadValueError

One = TypeVar("One")
IN_RANGE = "expected a magnitude from 2.3e-308 to 1.7e308"


def told(value: object) -> str:
    """A value in a message: short, and whatever it is."""
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
    """BadValueError."""
    raise BadValueError(f"{name} is {told(value)}: expected {expected}", hint=hint)


def flag(value: object, name: str) -> bool:
    """True or False, of Python or NumPy: "no" and 0.0 would count as either."""
    if not isinstance(value, (bool, np.bool_)):
        refuse(name, value, "True or False")
    return bool(value)


def text(value: object, name: str, expected: str = "a text") -> str:
    """A text that can be written as UTF-8."""
    if not isinstance(value, str):
        refuse(name, value, expected)
    try:
        value.encode()
    except UnicodeEncodeError:
        refuse(name, value, f"{expected} of whole characters")
    return value


def function(value: Any, name: str) -> Any:
    """Something that can be called, or None."""
    if value is not None and not callable(value):
        refuse(name, value, "a function, or None")
    return value


def path(value: Any, name: str) -> str | os.PathLike[str]:
    """The name of a file."""
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
    """Whether it is a whole number of Python or NumPy: no truth, and no lapse of time, which NumPy counts as one."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, (bool, np.timedelta64))


def whole(value: Any, name: str, least: int, most: int) -> int:
    """A whole number between bounds."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if not is_whole(value) or not least <= value <= most:
        refuse(name, value, f"a whole number from {least} to {most}")
    return int(value)


def number_of(value: Any, name: str) -> float:
    """A finite float, of any kind of real number but text and truth. Raises BadValueError that names it."""
    try:
        if isinstance(value, (str, bytes, bool, np.bool_)) or np.ndim(value) or np.iscomplexobj(value):
            raise TypeError
        if isinstance(value, np.ndarray) and value.dtype.kind in "mMb":  # of a time without a unit NumPy makes a number
            raise TypeError
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        shown = value if isinstance(value, str) else told(value)
        raise BadValueError(f"{name}: {shown[:60]!r} is not one real number") from None
    if not math.isfinite(result):
        raise BadValueError(f"{name}: {value!r} is not a finite number")
    return result


def whole_digits(value: float, name: str) -> float:
    """A number that has all its digits: below the smallest normal one they are lost. Raises BadValueError."""
    if value and abs(value) < sys.float_info.min:
        raise BadValueError(f"{name}: {value!r} is out of range", hint=IN_RANGE)
    return value


def time(value: Any) -> float:
    """A time (s); NaN and infinities stay: C says what becomes of them."""
    return value if isinstance(value, float) else number_of(value, "t")


def mapping(value: Any, name: str, hint: str = "") -> Mapping[str, Any]:
    """A mapping by texts, as which a Series of pandas counts; None is an empty one."""
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
            raise BadValueError(f"{name}: its key {told(key)} is no text", hint=hint)
    return found


def listed(value: Any, name: str, kind: type[One], expected: str) -> list[One]:
    """A list of one kind, of any sequence but a text; arrays and columns of a table count."""
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable) or getattr(value, "ndim", 1) != 1:
        refuse(name, value, expected)
    if isinstance(value, Sequence) or len(getattr(value, "shape", ())) == 0 or len(value) < 10**6:  # type: ignore[arg-type]
        found = list(value)
        if all(isinstance(one, kind) for one in found):
            return found
    refuse(name, value, expected)


def names(value: Any, name: str, expected: str) -> list[str]:
    """One name, or names in any sequence or set, as plain texts."""
    every = [value] if isinstance(value, str) else listed(value, name, str, expected)
    return [str.__str__(text(one, name, expected)) for one in every]


def instance(value: Any, name: str, kind: type[One]) -> One:
    """An object of a class."""
    if not isinstance(value, kind):
        refuse(name, value, f"a {kind.__name__}")
    return value


def optional(value: Any, name: str, kind: type[One]) -> One | None:
    """An object of a class, or None."""
    return None if value is None else instance(value, name, kind)


def positive(value: Any, name: str) -> float:
    """A number above zero."""
    number = number_of(value, name)
    if not number > 0.0:
        refuse(name, value, "a number above zero")
    return number


def optional_positive(value: Any, name: str) -> float | None:
    """A number above zero, or None."""
    return None if value is None else positive(value, name)


def numbers(values: Any, name: str) -> list[float]:
    """Numbers of a list, an array or a column; None is an empty list."""
    every: list[Any] = [] if values is None else listed(values, name, object, "a list of numbers")
    return [number_of(value, f"{name}[{k}]") for k, value in enumerate(every)]

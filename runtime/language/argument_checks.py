"""Check arguments other than arrays: texts, flags, functions, mappings, whole numbers, files.

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

Item = TypeVar("Item")  # type of the items of a checked list
IN_RANGE = "expected a magnitude from 2.3e-308 to 1.7e308"


def shorten_value(value: object) -> str:
    """Return a text of at most about 60 characters that shows any value in an error message.

    Texts and bytes are quoted; objects other than numbers and None have their type before the value. It never raises,
    even if `repr` does.
    """
    if isinstance(value, (str, bytes)):
        return repr(value[:60])
    try:
        representation = repr(value)
    except Exception:  # an integer of thousands of digits, an object's own mistake
        representation = ""
    if value is None or (isinstance(value, (int, float)) and representation):
        return representation[:60]
    return f"{type(value).__name__} {representation[:60]}".strip()


def raise_bad_value(name: str, value: object, expected: str, hint: str = "") -> NoReturn:
    """Raise BadValueError: the argument `name` has this value, and `expected` says what it should be."""
    raise BadValueError(f"{name} is {shorten_value(value)}: expected {expected}", hint=hint)


def check_flag(value: object, name: str) -> bool:
    """Return a flag as bool. Raises BadValueError unless it is True or False of Python or NumPy."""
    if not isinstance(value, (bool, np.bool_)):
        raise_bad_value(name, value, "True or False")
    return bool(value)


def check_text(value: object, name: str, expected: str = "a text") -> str:
    """Return the value if it is a str that can be encoded as UTF-8, else raise BadValueError with `expected`."""
    if not isinstance(value, str):
        raise_bad_value(name, value, expected)
    try:
        value.encode()
    except UnicodeEncodeError:
        raise_bad_value(name, value, f"{expected} that can be encoded as UTF-8")
    return value


def check_callable(value: Any, name: str) -> Any:
    """Return the value if it is a callable or None, else raise BadValueError."""
    if value is not None and not callable(value):
        raise_bad_value(name, value, "a function, or None")
    return value


def check_path(value: Any, name: str) -> str | os.PathLike[str]:
    """Return a file name (str or PathLike) unchanged; raise BadValueError for other types and invalid names.

    Invalid are names with a zero byte or characters that cannot be encoded. The file need not exist.
    """
    if not isinstance(value, (str, os.PathLike)) or not isinstance(os.fspath(value), str):
        raise_bad_value(name, value, "the name of a file: a text or a Path")
    try:
        is_possible = b"\0" not in os.fsencode(value)
    except UnicodeEncodeError:
        is_possible = False
    if not is_possible:
        raise_bad_value(name, value, "a valid file name")
    return value


def is_integer(value: object) -> TypeGuard[int]:
    """Return whether a value is an integer of Python or NumPy, but neither a boolean nor a timedelta."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, (bool, np.timedelta64))


def check_integer(value: Any, name: str, minimum: int, maximum: int) -> int:
    """Return a value as int if it is an integer with minimum ≤ value ≤ maximum, else raise BadValueError.

    Arrays without dimensions are accepted.
    """
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if not is_integer(value) or not minimum <= value <= maximum:
        raise_bad_value(name, value, f"a whole number from {minimum} to {maximum}")
    return int(value)


def check_number(value: Any, name: str) -> float:
    """Return any one real number as a finite float.

    Raises BadValueError for texts, booleans, complex numbers, times, arrays with dimensions, NaN and infinity.
    """
    try:
        if isinstance(value, (str, bytes, bool, np.bool_)) or np.ndim(value) or np.iscomplexobj(value):
            raise TypeError
        if isinstance(value, np.ndarray) and value.dtype.kind in "mMb":  # NumPy converts times without a unit to float
            raise TypeError
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        shown = value if isinstance(value, str) else shorten_value(value)
        raise BadValueError(f"{name}: {shown[:60]!r} is not one real number") from None
    if not math.isfinite(result):
        raise BadValueError(f"{name}: {value!r} is not a finite number")
    return result


def check_not_subnormal(number: float, name: str) -> float:
    """Return the number unchanged. Raises BadValueError if it is subnormal, since such numbers have fewer digits."""
    if number and abs(number) < sys.float_info.min:
        raise BadValueError(f"{name}: {number!r} is out of range", hint=IN_RANGE)
    return number


def check_time(value: Any) -> float:
    """Return a time (s) as float; a float is returned unchanged, also NaN and infinity, which C handles.

    Raises BadValueError for anything that is not a number.
    """
    return value if isinstance(value, float) else check_number(value, "t")


def check_mapping(value: Any, name: str, hint: str = "") -> Mapping[str, Any]:
    """Return a mapping with texts as keys; None gives an empty mapping, a pandas Series becomes a dict.

    Raises BadValueError with `hint` for other values, keys that are not texts, or a Series with repeated names.
    """
    if value is None:
        return {}
    mapping = value
    if type(value) is dict and all(type(key) is str for key in value):
        return value
    if not isinstance(value, Mapping) and getattr(value, "ndim", 0) == 1 and callable(getattr(value, "items", None)):
        mapping = dict(value.items())
        if len(mapping) != len(value):
            raise BadValueError(f"{name}: its index repeats a name", hint="give each value once")
    if not isinstance(mapping, Mapping):
        raise BadValueError(f"{name} is a {type(value).__name__}: expected a mapping", hint=hint)
    for key in mapping:
        if not isinstance(key, str):
            raise BadValueError(f"{name}: its key {shorten_value(key)} is not a text", hint=hint)
    return mapping


def check_list(value: Any, name: str, item_type: type[Item], expected: str) -> list[Item]:
    """Return a list of the items of a sequence, one-dimensional array or table column, all of type `item_type`.

    Raises BadValueError with `expected` for other values, also for a single text, a mapping, a set, whose order is not
    defined, or a column of 10⁶ or more items.
    """
    if isinstance(value, (set, frozenset)):
        raise_bad_value(name, value, f"{expected}: a set has no order", "sorted(…) makes a list of it")
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable) or getattr(value, "ndim", 1) != 1:
        raise_bad_value(name, value, expected)
    if isinstance(value, Sequence) or len(getattr(value, "shape", ())) == 0 or len(value) < 10**6:  # type: ignore[arg-type]
        items = list(value)
        if all(isinstance(item, item_type) for item in items):
            return items
    raise_bad_value(name, value, expected)


def check_names(value: Any, name: str, expected: str) -> list[str]:
    """Return one name, or several in any sequence, as a list of plain str.

    Raises BadValueError with `expected` for other values, and for a name that is given twice.
    """
    items = [value] if isinstance(value, str) else check_list(value, name, str, expected)
    texts = [str.__str__(check_text(text, name, expected)) for text in items]
    if len({*texts}) < len(texts):
        repeated = next(text for text in texts if texts.count(text) > 1)
        raise BadValueError(f"{name}: {repeated!r} is given twice", hint="give it once")
    return texts


def check_instance(value: Any, name: str, item_type: type[Item]) -> Item:
    """Return the value if it is an instance of the class `item_type`, else raise BadValueError."""
    if not isinstance(value, item_type):
        raise_bad_value(name, value, f"a {item_type.__name__}")
    return value


def check_optional_instance(value: Any, name: str, item_type: type[Item]) -> Item | None:
    """Return the value if it is None or an instance of the class `item_type`, else raise BadValueError."""
    return None if value is None else check_instance(value, name, item_type)


def check_positive(value: Any, name: str) -> float:
    """Return any real number above zero as a finite float, else raise BadValueError."""
    number = check_number(value, name)
    if not number > 0.0:
        raise_bad_value(name, value, "a number above zero")
    return number


def check_optional_positive(value: Any, name: str) -> float | None:
    """Return None for None, any real number above zero as a finite float, else raise BadValueError."""
    return None if value is None else check_positive(value, name)


def check_numbers(values: Any, name: str) -> list[float]:
    """Return the finite numbers of a list, array or column as floats; [] for None. Raises BadValueError."""
    values_list: list[Any] = [] if values is None else check_list(values, name, object, "a list of numbers")
    return [check_number(value, f"{name}[{k}]") for k, value in enumerate(values_list)]

"""Read a number with its unit from the command line or a Python call: '0.5 mm'."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from gudgeon.errors import BadValueError, InputError, Location, UnknownNameError
from gudgeon.language.names import unknown_name
from gudgeon.language.parser import at, check_dimension, parse
from gudgeon.language.tree import evaluate, names
from gudgeon.language.unit_remedies import unit_remedies
from gudgeon.language.units import dimension


def number_of_text(text: str, address: str, exponents: Sequence[float]) -> float:
    """Return the number (SI) that `text` writes for the parameter at `address`.

    exponents: of m, kg, s; a bare number fits any. An expression of numbers is allowed: '2*pi rad/s'. Raises the errors
    of the same text in a file, at "value of <address>:1:column".
    """
    where, expected = Location(f"value of {address}", 1, 1), dimension(*exponents)

    def read(value: str) -> float:
        """Return the value of a text without names, after checking its dimension."""
        expr = parse(value, where)
        name = next(names(expr), None)
        if name is not None:
            hint = "expected a number such as '0.5 mm'; what follows other parameters is written in the file"
            raise UnknownNameError(f"{text!r} holds the name {name.path!r}", at(where, name.offset), hint)
        check_dimension(expr, expected, lambda path: None, where)
        return float(evaluate(expr, lambda path: None))

    try:
        with unit_remedies(text.strip(), where, read, expected):
            return read(text.strip())
    except UnknownNameError as error:  # a number has no names: it is the value that is wrong
        raise BadValueError(error.message, where, error.hint) from None


def holds_names(text: str) -> bool:
    """Return whether a text is an expression that contains names."""
    try:
        return next(names(parse(text.strip(), Location("", 1, 1))), None) is not None
    except InputError:
        return False


def number_of_names(
    text: str, what: str, exponents: Sequence[int], known: Mapping[str, tuple[float, Sequence[float]]]
) -> float:
    """Return the number (SI) of an expression of `known` names, each with value and exponents: '2*pi/omega'.

    Raises the errors of the same text in a file.
    """
    where = Location(f"value of {what}", 1, 1)
    expr = parse(text.strip(), where, known)
    for name in names(expr):
        if name.path not in known:
            raise unknown_name("name", name.path, known, where)
    check_dimension(expr, dimension(*exponents), lambda path: dimension(*known[path][1]), where)
    return float(evaluate(expr, lambda path: np.float64(known[path][0])))

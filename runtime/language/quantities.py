"""Read a number with its unit from the command line or a Python call: '0.5 mm'."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from gudgeon.errors import BadValueError, InputError, Location, UnknownNameError
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.parser import check_dimension, offset_location, parse
from gudgeon.language.tree import evaluate, iterate_names
from gudgeon.language.unit_remedies import add_unit_hints
from gudgeon.language.units import make_dimension


def parse_quantity(text: str, address: str, exponents: Sequence[float]) -> float:
    """Return the number (SI) that `text`, such as '0.5 mm' or '2*pi rad/s', specifies for the parameter at `address`.

    exponents: of m, kg, s; a bare number fits any. Raises BadValueError for names in the text, otherwise the errors of
    the same text in a file with hints on units, at "value of <address>:1:column".
    """
    where, expected = Location(f"value of {address}", 1, 1), make_dimension(*exponents)

    def parse_text(value: str) -> float:
        """Return the value of a text after checking its dimension; raise UnknownNameError if it contains a name."""
        expr = parse(value, where)
        name = next(iterate_names(expr), None)
        if name is not None:
            hint = "expected a number such as '0.5 mm'; expressions of other parameters are written in the file"
            location = offset_location(where, name.offset)
            raise UnknownNameError(f"{text!r} contains the name {name.path!r}", location, hint)
        check_dimension(expr, expected, lambda path: None, where)
        return float(evaluate(expr, lambda path: None))

    try:
        with add_unit_hints(text.strip(), where, parse_text, expected):
            return parse_text(text.strip())
    except UnknownNameError as error:  # a name makes the value invalid
        raise BadValueError(error.message, where, error.hint) from None


def has_names(text: str) -> bool:
    """Return whether a text is a valid expression that contains names; False if it cannot be parsed."""
    try:
        return next(iterate_names(parse(text.strip(), Location("", 1, 1))), None) is not None
    except InputError:
        return False


def evaluate_expression(
    text: str, item: str, exponents: Sequence[int], known_values: Mapping[str, tuple[float, Sequence[float]]]
) -> float:
    """Return the number (SI) of an expression of `known_values` names, such as '2*pi/omega'.

    item: for messages. exponents: expected ones of m, kg, s. known_values: value and exponents by name. Raises
    UnknownNameError and the errors of the same text in a file.
    """
    where = Location(f"value of {item}", 1, 1)
    expr = parse(text.strip(), where, known_values)
    for name in iterate_names(expr):
        if name.path not in known_values:
            raise make_unknown_name_error("name", name.path, known_values, where)
    check_dimension(expr, make_dimension(*exponents), lambda path: make_dimension(*known_values[path][1]), where)
    return float(evaluate(expr, lambda path: np.float64(known_values[path][0])))

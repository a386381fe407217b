"""Example: an expression is parsed and evaluated; a wrong one is refused at its column."""

from __future__ import annotations

import pytest

from gudgeon.errors import InputError, Location
from gudgeon.language.parser import parse
from gudgeon.language.tree import evaluate

HERE = Location("example", 1, 1)


def test_units_are_converted() -> None:
    assert evaluate(parse("2 * 80 mm + 4 cm", HERE), str) == pytest.approx(0.2)


def test_an_open_bracket_is_refused() -> None:
    with pytest.raises(InputError):
        parse("2 * (80 mm", HERE)

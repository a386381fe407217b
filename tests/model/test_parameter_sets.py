"""Numbers of many runs read at once: what they are read one by one."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.model.parameter_sets import each_of, given_each, plain_each
from gudgeon.model.parameters import given_slots
from tests.programs import needs_compiler

pytestmark = needs_compiler
PLAIN: list[dict[str, Any]] = [{"c": 3e-4, "omega": -0.0}, {"omega": np.float64(2.0), "c": 4e-4}]
ALONE: dict[str, list[dict[Any, Any]]] = {
    "a text": [{"c": "0.3 mm"}, {"c": 3e-4}], "an integer": [{"omega": 3}],
    "another set": [{"c": 3e-4}, {"omega": 3.0}], "an unknown name": [{"clearance": 3e-4}],
    "twice": [{"c": 3e-4, "parameters.c": 3e-4}], "too small": [{"c": 1e-310}],
    "several": [{"gains": 3.0}], "no text": [{3: 3.0}],
}  # fmt: skip


def test_plain_numbers_are_read_at_once() -> None:
    source = gudgeon.load("nine_bar_press", "dry").source
    found, mask = given_each(source, PLAIN)
    one_by_one = each_of(PLAIN, lambda _, row: given_slots(source, row))
    assert found.tobytes() == one_by_one[0].tobytes() and (mask == one_by_one[1]).all() and mask.sum() == 4


@pytest.mark.parametrize("name", ALONE)
def test_others_are_read_one_by_one(name: str) -> None:
    assert plain_each(gudgeon.load("nine_bar_press", "dry").source, ALONE[name]) is None

"""Numbers of many runs read at once: what they are read one by one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import InputError, UnitError
from gudgeon.model.compiled import RUNS_PER_CALL
from gudgeon.model.parameter_sets import (
    Columns,
    read_given_parameters_of_runs,
    read_parameter_sets,
    read_parameters_of_runs,
    read_runs_with_equal_names,
)
from gudgeon.model.parameters import GAINS, compute_values_without_baumgarte, read_given_parameters
from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
PLAIN: list[dict[str, Any]] = [{"c": 3e-4, "omega": -0.0}, {"omega": np.float64(2.0), "c": 4e-4}]
ALONE: dict[str, list[dict[Any, Any]]] = {
    "a text": [{"c": "0.3 mm"}, {"c": 3e-4}],
    "an integer": [{"omega": 3}],
    "another set": [{"c": 3e-4}, {"omega": 3.0}],
    "an unknown name": [{"clearance": 3e-4}],
    "twice": [{"c": 3e-4, "parameters.c": 3e-4}],
    "too small": [{"c": 1e-310}],
    "several": [{"gains": 3.0}],
    "no text": [{3: 3.0}],
}


def test_plain_numbers_are_read_at_once() -> None:
    source = gudgeon.load("nine_bar_press", "dry").source
    found, mask = read_given_parameters_of_runs(source, PLAIN)
    one_by_one = read_parameters_of_runs(PLAIN, lambda _, row: read_given_parameters(source, row))
    assert found.tobytes() == one_by_one[0].tobytes() and (mask == one_by_one[1]).all() and mask.sum() == 4


@pytest.mark.parametrize("name", ALONE)
def test_others_are_read_one_by_one(name: str) -> None:
    assert read_runs_with_equal_names(gudgeon.load("nine_bar_press", "dry").source, ALONE[name]) is None


CLEARANCES = [3e-4, 4e-4, 5e-4]
COLUMNS: dict[str, tuple[dict[str, Any], bool]] = {  # and whether all runs are read at once
    "floats": ({"c": CLEARANCES, "omega": -0.0}, True),
    "arrays": ({"c": np.array(CLEARANCES), "omega": np.array([1, 2, 3]), "l5": np.array([0.2, 0.25, 0.3], "f4")}, True),
    "one value of each kind": ({"c": "0.3 mm", "omega": 3, "l5": np.float32(0.25), "gravity.y": [0.0] * 3}, True),
    "a view": ({"c": np.linspace(3e-4, 8e-4, 6)[::2]}, True),
    "no numbers": ({"c": np.array([3e-4, np.nan, np.inf]), "omega": [1.0, -np.inf, 2.0], "l5": 0.25}, True),
    "texts": ({"c": ["0.3 mm", "4e-4 m", 5e-4], "omega": [1.0, 2.0, np.nan]}, False),
    "integers": ({"omega": [1, 2, 3], "c": np.array([3e-4, np.nan, 5e-4], "f4")}, False),
    "too small": ({"omega": [1.0, 1e-310, 2.0]}, False),
    "too small for all": ({"c": CLEARANCES, "l5": 1e-310}, False),
    "a truth": ({"c": CLEARANCES, "omega": True}, False),
    "none": ({"c": CLEARANCES, "omega": None}, False),
    "an unknown name": ({"c": CLEARANCES, "clearance": 1.0}, False),
    "several": ({"c": CLEARANCES, "gains": 3.0}, False),
    "twice": ({"c": CLEARANCES, "parameters.c": 3e-4}, False),
}


def message(read: Callable[[], tuple[Any, Any]]) -> tuple[Any, ...]:
    """Values and mask, or what is said instead."""
    try:
        values, mask = read()
    except InputError as error:
        return type(error), str(error)
    return values.tobytes(), mask.tobytes()


@pytest.mark.parametrize("name", COLUMNS)
def test_columns_are_read_as_their_rows_are(name: str) -> None:
    """Of a mapping for each run nothing is known but these: numbers, runs that have none, words on mistakes."""
    source, (columns, at_once) = gudgeon.load("nine_bar_press", "dry").source, COLUMNS[name]
    whole = {key: one.tolist() if isinstance(one, np.ndarray) and one.ndim else one for key, one in columns.items()}
    every = [{key: one[i] if isinstance(one, list) else one for key, one in whole.items()} for i in range(3)]
    (rows, bad, _), (plain, plain_bad, _) = read_parameter_sets(columns), read_parameter_sets(every)
    assert isinstance(rows, Columns) and isinstance(plain, list) and len(rows) == 3
    assert [*rows] == plain and rows[-1] == plain[2] and rows[1:] == plain[1:]
    assert [(i, str(error)) for i, error in bad.items()] == [(i, str(error)) for i, error in plain_bad.items()]
    one_by_one = message(lambda: read_parameters_of_runs(plain, lambda _, row: read_given_parameters(source, row)))
    assert (
        message(lambda: read_given_parameters_of_runs(source, rows))
        == one_by_one
        == message(lambda: read_given_parameters_of_runs(source, plain))
    )
    assert (read_runs_with_equal_names(source, rows) is not None) == at_once


def test_a_run_of_columns_that_there_is_not() -> None:
    with pytest.raises(IndexError):
        Columns({"c": [3e-4, 4e-4]}, 2)[2]


@pytest.mark.parametrize("scene", ["dry", "lubricated"])
def test_runs_prepared_together_are_those_prepared_alone(scene: str) -> None:
    compiled = gudgeon.load("nine_bar_press", scene).compiled
    columns: dict[str, Any] = {"c": np.linspace(3e-4, 5e-4, RUNS_PER_CALL + 3), "omega": 3.0, GAINS[0]: "5 1/s"}
    given, is_given = read_given_parameters_of_runs(compiled.source, read_parameter_sets(columns)[0])
    before = given.tobytes(), is_given.tobytes()
    together, free = (
        compiled.prepare_parameters_of_runs(given, is_given),
        compute_values_without_baumgarte(compiled, given, is_given),
    )
    for i in (0, 1, RUNS_PER_CALL - 1, RUNS_PER_CALL, RUNS_PER_CALL + 2):
        assert together[i].tobytes() == compiled.prepare(given[i], is_given[i]).tobytes()
        assert free[i].tobytes() == compute_values_without_baumgarte(compiled, given[i], is_given[i]).tobytes()
    assert (given.tobytes(), is_given.tobytes()) == before and together.tobytes() != free.tobytes()


@needs_compiler
def test_a_unit_that_the_file_leaves_out_is_told(tmp_path: Path) -> None:
    text = """
parameters: {speed: 62.8}
bodies: {disc: {mass: 2 kg, inertia: 3 kg*m^2}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, disc.origin]}}
drives: {motor: {angle: disc, value: speed*t}}
"""
    with pytest.raises(UnitError, match="(?s)got a rate.*the file has no unit for parameters.speed"):
        loader(tmp_path)(text).simulate(1e-3, parameters={"speed": "600 rev/min"})

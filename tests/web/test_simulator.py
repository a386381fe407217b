"""The simulator of pages beside the native one: the same C, compiled by another compiler and run by V8."""

from __future__ import annotations

import base64
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BuildError, SolverError
from gudgeon.results.results import Result
from gudgeon.web.description import description
from gudgeon.web.module import simulator
from gudgeon.web.page import script
from tests.web.node import Answer, in_node, node

pytest.importorskip("ziglang", reason="the extra web is not installed: no compiler for pages")
needs_node = pytest.mark.skipif(node() is None, reason="Node is not installed")

# Runs whose numbers the native run gives too
RUNS: dict[tuple[str, str], list[dict[str, Any]]] = {
    ("pendulum", "ideal"): [
        {"t_end": 2, "output": 50, "method": "dop853"}, {"t_end": 2, "output": 50, "method": "rodas5p"},
        {"t_end": 2, "output": 50, "method": "rk4", "step": 1e-3},
    ],
    ("four_bar", "ideal"): [{"t_end": 1, "output": 100}],
    ("slider_crank", "dry"): [{"t_end": 0.2, "output": 100}, {"t_end": 0.02, "output": 20, "method": "rk4"}],
    ("nine_bar_press", "lubricated"): [{"t_end": 0.3, "output": 100}, {"t_end": 0.01, "output": 9, "step": 5e-6}],
    ("andrews_squeezer", "ideal"): [{"t_end": 0.03, "output": 60}],
}  # fmt: skip


def same_bits(found: Answer, run: Result) -> bool:
    """Whether positions, velocities, works and memories are the native run's to the last bit."""
    pairs = {name: np.ravel(getattr(run, name)) for name in ("t", "q", "v", "work")}
    return all(np.array_equal(found.arrays[name].view("i8"), x.view("i8")) for name, x in pairs.items())


def check_series(found: Answer, run: Result, share: float) -> None:
    """Each series within a share of the largest value of those with its unit; names and units are the same."""
    assert found.units == dict(run.names)
    largest: dict[str, float] = {}
    for name, unit in run.names.items():
        largest[unit] = max(largest.get(unit, 0.0), float(np.nanmax(np.abs(run[name]), initial=0.0)))
    for name, unit in run.names.items():
        assert np.allclose(found.series[name], run[name], rtol=0.0, atol=share * largest[unit], equal_nan=True), name


@needs_node
@pytest.mark.parametrize("scene", RUNS, ids="/".join)
def test_numbers_are_those_of_the_native_run(scene: tuple[str, str], tmp_path: Path) -> None:
    simulation = gudgeon.load(*scene)
    native = [simulation.simulate(**options) for options in RUNS[scene]]
    names = [{"options": options, "names": [*run.names]} for options, run in zip(RUNS[scene], native, strict=True)]
    for found, run in zip(in_node(simulation, tmp_path, names), native, strict=True):
        assert found.error == ""
        assert found.counts["steps"] == run.diagnostics.steps
        assert same_bits(found, run)
        check_series(found, run, 1e-13)
        assert len(found.impacts) == len(run.impacts)


@needs_node
def test_numbers_of_a_page_and_what_it_refuses(tmp_path: Path) -> None:
    """A choice brings numbers of its own; conditions of the file hold; another scene's methods are not taken."""
    press = gudgeon.load("nine_bar_press", "lubricated")
    parameters = {"bearings.pin.bearing_material": "steel_45", "bearings.pin.clearance": 4e-4}
    options = {"t_end": 0.05, "output": 20}
    given = [k for k in parameters if k not in press.simulate(**options).parameters]
    assert not given, given
    wrong: list[dict[str, Any]] = [{"bearings.pin.clearance": -1e-4}, {"bearings.pon.clearance": 1.0}, {"bearings.pin.clearance": "1 mm"}]
    runs = [{"parameters": parameters, "options": options}, *({"parameters": one, "options": options} for one in wrong)]
    runs += [{"options": options | more} for more in ({"method": "kinematic"}, {"t_end": 0}, {"rtol": 2}, {"output": 0})]
    right, *refused = in_node(press, tmp_path, runs)
    assert same_bits(right, press.simulate(parameters=parameters, **options))
    told = ("bearings.pin.clearance is -0.0001", "bearings.pon.clearance", "expected a number", "method is", "t_end is", "rtol is",
            "output is")  # fmt: skip
    for found, text in zip(refused, told, strict=True):
        assert text in found.error

"""Batches that go on from states, and columns in which one number is none."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError
from gudgeon.results.results import Result, State
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
C = (3e-4, 4e-4, 5e-4)


@cache
def press(scene: str = "dry", formulation: str = "reduced") -> Simulation:
    return gudgeon.load("nine_bar_press", scene, formulation=formulation)


@cache
def begun(scene: str = "dry") -> tuple[State, ...]:
    """States at one time, of other clearances, one of them in contact."""
    runs = [press(scene).simulate(0.0072, output=10, parameters={"c": c}) for c in C]
    if scene == "dry":
        assert any(run.final.state.any() for run in runs)
    return tuple(run.final for run in runs)


def same(one: Result, other: Result) -> None:
    assert one.impacts.tobytes() == other.impacts.tobytes()
    for name in ("t", "q", "v", "work", "memory", "state"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


METHODS: list[dict[str, Any]] = [
    {"method": "dop853"},
    {"method": "auto"},
    {"method": "rk4", "step": 2e-6},
    {"method": "rk4", "step": 2e-6, "side_by_side": False},
]


@pytest.mark.parametrize("options", METHODS)
@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_each_goes_on_as_it_would_alone(options: dict[str, Any], formulation: str) -> None:
    simulation, starts = press("dry", formulation), begun()
    batch = simulation.simulate_many({}, 0.0092, output=20, start=starts, **options)
    alone = {name: value for name, value in options.items() if name != "side_by_side"}
    assert not batch.failures
    for i, state in enumerate(starts):
        run = simulation.simulate(0.0092, output=20, start=state, **alone)
        same(batch[i], run)
        np.testing.assert_array_equal(batch.q[i], run.q)
        assert batch[i].parameters == run.parameters


def test_one_state_for_many_numbers() -> None:
    """The state's own numbers hold but for those of the columns, which is told."""
    speeds = [6.0, 6.2, 6.4]
    state = press().simulate(0.004, output=4).final
    batch = press().simulate_many({"contacts.dry.friction.mu": [0.1, 0.15, 0.2]}, 0.006, output=4, start=state)
    assert not batch.failures and batch.q.shape[0] == len(speeds)
    for i, mu in enumerate((0.1, 0.15, 0.2)):
        run = press().simulate(0.006, output=4, start=state, parameters={"contacts.dry.friction.mu": mu})
        same(batch[i], run)
        assert batch[i].diagnostics.notes == run.diagnostics.notes


def test_without_freedom_too() -> None:
    ideal = press("ideal")
    states = [ideal.simulate(0.1, output=4).final] * 2
    batch = ideal.simulate_many({}, 0.2, output=4, start=states)
    np.testing.assert_array_equal(batch.q[1], ideal.simulate(0.2, output=4, start=states[0]).q)


def test_numbers_that_a_state_does_not_fit_fail_their_run() -> None:
    state = press().simulate(0.004, output=4).final
    batch = press().simulate_many({"bodies.L7.length": [0.2, 0.21]}, 0.006, output=4, start=state)
    assert {failure.run for failure in batch.failures} == {0, 1}
    assert all("violates constraint equations" in str(failure.error) for failure in batch.failures)


@pytest.mark.parametrize(
    ("starts", "message"),
    [
        (lambda: begun()[:2], "start has 2 states for 3 runs"),
        (lambda: begun()[:1], "start has 1 state for 3 runs"),
        (lambda: [*begun()[:2], replace(begun()[2], t=0.1)], "start at one time"),
        (lambda: [], "start has 0 states"),
        (lambda: [1.0, 2.0, 3.0], "start is a float: expected a State"),
        (lambda: press().simulate(0.001, output=2), "give its `final`"),
    ],
)
def test_what_is_no_start_is_refused(starts: Any, message: str) -> None:
    with pytest.raises(BadValueError, match=message):
        press().simulate_many({"c": list(C)}, 0.1, start=starts())


@pytest.mark.parametrize("odd", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("scene", ["dry", "ideal"])
def test_a_number_that_is_none_fails_its_own_run(odd: float, scene: str) -> None:
    batch = press(scene).simulate_many({"omega": np.array([6.0, odd, 6.2])}, 0.004, output=4)
    assert [failure.run for failure in batch.failures] == [1] and "omega" in str(batch.failures[0].error)
    plain = press(scene).simulate_many({"omega": [6.0, 6.2]}, 0.004, output=4)
    np.testing.assert_array_equal(batch.q[[0, 2]], plain.q)
    with pytest.raises(BadValueError, match="is not a finite number"):
        press(scene).simulate_many({"omega": odd}, 0.004)


def test_an_end_may_hang_on_numbers() -> None:
    """One turn, whatever the speed; a batch whose runs all end then has common times."""
    for omega in (6.0, 7.0):
        run = press("ideal").simulate("2*pi/omega", output=4, parameters={"omega": omega})
        assert run.t[-1] == 2.0 * math.pi / omega
    batch = press("ideal").simulate_many({"omega": 6.0, "bodies.L7.mass": [1.0, 2.0]}, "2*pi/omega", output=2)
    assert batch.t[-1] == 2.0 * math.pi / 6.0
    batch = press("ideal").simulate_many({"omega": [6.0, 7.0]}, "2*pi/omega", output=2)
    np.testing.assert_array_equal(batch.t[:, -1], 2.0 * math.pi / np.array([6.0, 7.0]))
    with pytest.raises(gudgeon.errors.InputError, match="unknown name 'omga'"):
        press("ideal").simulate("2*pi/omga")
    with pytest.raises(gudgeon.errors.InputError, match=r"expected a time \(s\)"):
        press("ideal").simulate("2*pi*omega")

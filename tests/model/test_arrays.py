"""The door of arrays into C: what it refuses, that nobody walks round it, and that nothing is read out of bounds."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pytest

import gudgeon
from gudgeon.errors import ArrayError, BadValueError, SolverError
from gudgeon.model.arrays import CODE, FLAG, as_c_array
from gudgeon.model.compiled import CompiledModel
from tests.programs import needs_compiler

RUNTIME = Path(__file__).parents[2] / "runtime"


def test_no_other_place_asks_an_array_where_it_lies() -> None:
    asks = re.compile(r"\.ctypes\b|from_buffer|__array_interface__|data_as|\.data\.(ptr|obj)|addressof")
    files = [*RUNTIME.rglob("*.py")]
    found = [file.name for file in files if asks.search(file.read_text(encoding="utf-8"))]
    assert found == ["arrays.py"] and len(files) > 60


def test_the_array_itself_where_it_is_as_c_reads_it() -> None:
    plain = np.arange(4.0)
    assert as_c_array(plain, "x", (4,)) is plain
    copy = as_c_array(plain, "x", (None,), always_copy=True)
    assert copy is not plain and not np.shares_memory(copy, plain)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.ma.array([1.0, 2.0], mask=[False, True]), r"x\[1\] is masked"),
        ([1.0, np.ma.masked], r"x\[1\] is masked"),
        (np.array([1.0, 1j]), "complex128"),
        (np.array(["1", "2"]), "expected real numbers"),
        (["1", "2"], "expected real numbers"),
        ([1.0, None], r"x\[1\] is NoneType"),
        (np.array(["2020-01-01", "2020-01-02"], "M8[D]"), "datetime64"),
        ([[1.0, 2.0]], r"x has shape \(1, 2\), expected \(2,\)"),
        (np.zeros(0), r"x has shape \(0,\), expected \(2,\)"),
        (3.0, r"x has shape \(\), expected \(2,\)"),
        ([[1.0], [1.0, 2.0]], "no array of numbers"),
        ([0.0, np.inf], r"x\[1\] is inf: expected finite"),
        (pandas.Series([1.0, None]), r"x\[1\] is nan"),
        (np.array([(1.0,), (2.0,)], dtype=[("a", "f8")]), "expected real numbers"),
        ("12", "expected real numbers"),
        (iter([1.0, 2.0]), "expected real numbers"),
        ([Fraction(10**400), 1.0], "x"),
    ],
)
def test_what_is_no_array_of_numbers(values: Any, message: str) -> None:
    with pytest.raises(ArrayError, match=message):
        as_c_array(values, "x", (2,), require_finite=True)


def test_codes_and_flags_are_whole_numbers_that_fit() -> None:
    assert as_c_array([0.0, 2.0], "x", dtype=CODE).tolist() == [0, 2]
    assert as_c_array(np.array([True, False]), "x", dtype=FLAG).tolist() == [1, 0]
    for wrong in ([0.5], [300], [np.nan]):
        with pytest.raises(ArrayError, match=r"x\[0\]"), np.errstate(invalid="ignore"):
            as_c_array(wrong, "x", dtype=CODE)


@pytest.fixture(scope="module")
def ball() -> gudgeon.Simulation:
    return gudgeon.load("bouncing_ball", scene="damped")


def odd(n: int) -> Any:
    return np.zeros(8 * n + 1, np.uint8)[1:].view(np.float64)


@needs_compiler
@pytest.mark.parametrize(
    ("array", "kind"),
    [
        (np.zeros(8)[::2], "double *"),
        (np.zeros((3, 3)).T, "double *"),
        (np.zeros(4, np.float32), "double *"),
        (np.zeros(4, ">f8"), "double *"),
        (odd(4), "double *"),
        (np.zeros(4, np.int64), "double *"),
        (np.zeros(4), "long *"),
        (np.zeros(4, np.int32), "long *"),
        (np.zeros(4, np.int8), "void *"),
        (np.zeros((4, 4), np.uint8)[:, 1], "void *"),
        (np.zeros(4, np.uint8), "signed char *"),
    ],
)
def test_a_pointer_is_given_of_nothing_else(ball: gudgeon.Simulation, array: Any, kind: str) -> None:
    with pytest.raises(ArrayError):
        ball.compiled.pointer(array, kind)


@needs_compiler
def test_a_pointer_keeps_its_array_and_is_not_given_to_write_what_is_read_only(ball: gudgeon.Simulation) -> None:
    found = ball.compiled.pointer(np.arange(3.0))
    assert list(found) == [0.0, 1.0, 2.0]
    fixed = np.arange(3.0)
    fixed.flags.writeable = False
    assert list(ball.compiled.pointer(fixed)) == [0.0, 1.0, 2.0]
    with pytest.raises(ArrayError):
        ball.compiled.pointer(fixed, is_written=True)


def lengths(model: CompiledModel, p: Any) -> dict[str, tuple[int, Callable[[Any], Any]]]:
    """argument -> its length (last axis) and a call with it."""
    y, q, r = np.zeros(2 * model.n), np.zeros(model.n), np.zeros(2 * model.n + 3)
    t, rows, latched = np.zeros(2), np.zeros((2, model.n)), np.full((2, model.n_discrete_states), np.nan)
    slots = len(model.source.parameters)
    return {
        "y": (2 * model.n, lambda x: model.rhs(0.0, x, p)),
        "p": (len(p), lambda x: model.rhs(0.0, y, x)),
        "memory": (model.n_discrete_states, lambda x: model.rhs(0.0, y, p, x)),
        "jacobian y": (2 * model.n, lambda x: model.jacobian(0.0, x, p)),
        "jacobian p": (len(p), lambda x: model.jacobian(0.0, y, x)),
        "jacobian memory": (model.n_discrete_states, lambda x: model.jacobian(0.0, y, p, x)),
        "newton r": (len(r), lambda x: model.solve_newton_system(0.0, y, p, 0.1, 1.0, x)),
        "newton memory": (model.n_discrete_states, lambda x: model.solve_newton_system(0.0, y, p, 0.1, 1.0, r, x)),
        "given": (slots, lambda x: model.prepare(x, np.zeros(slots))),
        "is_given": (slots, lambda x: model.prepare(np.zeros(slots), x)),
        "mass": (len(p), model.mass),
        "start_values": (len(p), model.start_values),
        "close": (len(p), lambda x: model.close_linkage(0.0, x, 1.0)),
        "phi q": (model.n, lambda x: model.phi(0.0, x, p)),
        "phi p": (len(p), lambda x: model.phi(0.0, q, x)),
        "phi_q q": (model.n, lambda x: model.phi_q(0.0, x, p)),
        "phi_q p": (len(p), lambda x: model.phi_q(0.0, q, x)),
        "nu q": (model.n, lambda x: model.nu(0.0, x, p)),
        "nu p": (len(p), lambda x: model.nu(0.0, q, x)),
        "gamma q": (model.n, lambda x: model.gamma(0.0, x, q, p)),
        "gamma v": (model.n, lambda x: model.gamma(0.0, q, x, p)),
        "gamma p": (len(p), lambda x: model.gamma(0.0, q, q, x)),
        "evaluate p": (len(p), lambda x: model.evaluate(t, rows, rows, latched, x)),
        "evaluate t": (2, lambda x: model.evaluate(x, rows, rows, latched, p)),
        "evaluate q": (model.n, lambda x: model.evaluate(t, np.tile(x, (2, 1)), rows, latched, p)),
        "evaluate v": (model.n, lambda x: model.evaluate(t, rows, np.tile(x, (2, 1)), latched, p)),
        "evaluate memory": (model.n_discrete_states, lambda x: model.evaluate(t, rows, rows, np.tile(x, (2, 1)), p)),
        "memory_array": (model.n_discrete_states, model.as_discrete_states),
    }


@needs_compiler
def test_no_other_length_reaches_c(ball: gudgeon.Simulation) -> None:
    """`rhs(…, memory=np.zeros(0))` read what lay behind the array."""
    model = ball.full.compiled
    for name, (length, call) in lengths(model, ball.full.p).items():
        with suppress(SolverError):  # zeros are numbers, if singular ones
            call(np.zeros(length))
        for wrong in (0, length - 1, length + 1, length + 2):
            if wrong != length and not (wrong == 2 * model.n + 3 and "y" in name):
                with pytest.raises(ArrayError, match="has shape"):
                    call(np.zeros(wrong))


@needs_compiler
@pytest.mark.parametrize("method", ["auto", "rk4", "rodas5p", "scipy:DOP853"])
def test_no_other_length_of_a_start(ball: gudgeon.Simulation, method: str) -> None:
    start = replace(ball.simulate(0.05, output=1).final, t=0.0)

    def begin(**changes: Any) -> None:
        ball.simulate(0.01, start=replace(start, **changes), **options)

    options: dict[str, Any] = {"method": method, "output": 1} | ({"step": 1e-3} if method == "rk4" else {})
    for name in ("q", "v", "memory", "state"):
        values = getattr(start, name)
        for wrong in (values[:-1], np.append(values, values[:1]), values[None], values[:0]):
            with pytest.raises(ArrayError, match=rf"start\.{name} has shape"):
                begin(**{name: wrong})
    for name, bad in (("q", np.nan), ("v", np.inf)):
        wrong = getattr(start, name).copy()
        wrong[1] = bad
        with pytest.raises(ArrayError, match=rf"start\.{name}\[1\]"):
            begin(**{name: wrong})
    for code in (-1, 3, 0.5):
        with pytest.raises(BadValueError, match="start.state"):
            begin(state=np.array([code]))
    for t in (np.nan, "0", None):
        with pytest.raises(BadValueError, match=r"start\.t"):
            begin(t=t)


@needs_compiler
@pytest.mark.parametrize(
    ("output", "message"),
    [
        ([0.0, 0.2, 0.1], "increasing times.*0.1 s after 0.2 s"),
        ([0.0, 0.0], "increasing"),
        ([], "at least one"),
        ([-0.1, 0.1], "begin at 0.0 s, got -0.1 s"),
        ([0.0, np.nan], r"output\[1\] is nan"),
        (True, "output is True"),
        ([0.0, np.inf], r"output\[1\] is inf"),
        ([[[0.0, 0.1]]], "has shape"),
        ("10", "expected real numbers"),
        (np.ma.array([0.0, 0.1], mask=[False, True]), r"output\[1\] is masked"),
        (0, "output is 0"),
        (2.0, "output is 2.0: expected a whole number"),
    ],
)
def test_output_times_that_are_none(ball: gudgeon.Simulation, output: Any, message: str) -> None:
    for call in (ball.simulate, lambda *given, **named: ball.simulate_many({}, *given, **named)):
        with pytest.raises(BadValueError, match=message):
            call(0.1, output=output)


@needs_compiler
def test_columns_that_hide_a_value(ball: gudgeon.Simulation) -> None:
    hidden = np.ma.array([1.0, 2.0], mask=[False, True])
    wrong: list[Any] = [{"height": hidden}, {"height": [1.0, None]}, {"height": np.array([1j, 1.0])}]
    for columns in wrong:
        with pytest.raises(BadValueError):
            ball.simulate_many(columns, 0.01, output=1)
    table = pandas.DataFrame({"n": [1, 2], "height": [1.0, 1.5]})[["height"]]
    plain = ball.simulate_many({"height": [1.0, 1.5]}, 0.01, output=1)
    assert ball.simulate_many(table, 0.01, output=1).q.tobytes() == plain.q.tobytes()


@needs_compiler
@pytest.mark.parametrize("method", ["auto", "rk4", "scipy:DOP853", "kinematic"])
def test_what_a_caller_does_later_changes_no_result(method: str) -> None:
    """Not even while the run goes on: Python comes to its turn between chunks of steps."""
    simulation = gudgeon.load("slider_crank" if method == "kinematic" else "pendulum")
    options: dict[str, Any] = {"method": method} | ({"step": 1e-5} if method == "rk4" else {})
    times = np.linspace(0.0, 0.05, 6)
    plain = simulation.simulate(output=times.copy(), **options)
    batch = simulation.simulate_many({}, output=times, threads=1, **options)

    def spoil(*_: Any) -> None:
        times[:] = -1.0

    run = simulation.simulate(output=times, progress=spoil, **options)
    assert (times == -1.0).all()
    for other in (run, batch[0]):
        assert other.t.tobytes() == plain.t.tobytes() and other.q.tobytes() == plain.q.tobytes()
    assert batch.t.tobytes() == plain.t.tobytes()
    state = plain.final
    going = simulation.simulate(0.06, output=2, start=state, **options)
    state.q[:], state.v[:] = 0.0, 0.0
    assert going.q[0].tobytes() == plain.q[-1].tobytes() and going.v[0].tobytes() == plain.v[-1].tobytes()


@needs_compiler
def test_the_shipped_pendulum_at_every_second_time() -> None:
    """It said x = −.986 at 2 s, its value at 1 s."""
    pendulum = gudgeon.load("pendulum")
    run = pendulum.simulate(output=np.linspace(0.0, 2.0, 21)[::2])
    whole = pendulum.simulate(output=np.linspace(0.0, 2.0, 21))
    assert run["bob.x"][-1] == pytest.approx(0.794, abs=1e-3)
    np.testing.assert_allclose(run["bob.x"], whole["bob.x"][::2], rtol=0, atol=1e-9)


@needs_compiler
def test_the_numbers_of_a_simulation_are_its_own() -> None:
    pendulum = gudgeon.load("pendulum")
    before = pendulum.rhs(0.0, np.ones(6))
    pendulum.p[:] = 0.0
    assert pendulum.rhs(0.0, np.ones(6)).tobytes() == before.tobytes()

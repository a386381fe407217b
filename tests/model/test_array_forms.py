"""Every public argument that takes an array gives the same bits for the same numbers, however they are laid out.

An argument is sent as a plain array and then in every form that NumPy, a list or a table may have it: strided,
reversed, Fortran, other real types, other byte order, read-only, masked (nothing hidden), unaligned. Values are
multiples of 1/1024, which float32 holds exactly, or whole numbers for the integer forms. `python -m
tests.model.test_array_forms` counts the combinations.
"""

from __future__ import annotations

import array
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from functools import cache, partial
from typing import Any

import numpy as np
import pandas
import pytest
import xarray

import gudgeon
from gudgeon.errors import SolverError
from gudgeon.integrators.peers import driver as python_driver
from gudgeon.results.results import Result, State
from gudgeon.simulation.arguments import METHODS
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
Numbers = np.ndarray[Any, Any]
JUNK = 7.0


def strided(a: Numbers) -> Numbers:
    out = np.full([2 * n for n in a.shape], JUNK)[tuple(slice(1, None, 2) for _ in a.shape)]
    out[...] = a
    return out


def backwards(a: Numbers) -> Numbers:
    turn = (slice(None, None, -1),) * a.ndim
    return a[turn].copy()[turn]


def unaligned(a: Numbers) -> Numbers:
    memory = np.zeros(a.nbytes + 3, np.uint8)
    out = memory[3:].view(a.dtype).reshape(a.shape)
    out[...] = a
    assert not out.flags.aligned or not a.size
    return out


def read_only(a: Numbers) -> Numbers:
    out = a.copy()
    out.flags.writeable = False
    return out


def column(a: Numbers) -> Numbers:
    """Of a table: of shape (N, 3) the middle one, a trailing axis for more dimensions."""
    return np.stack([np.full_like(a, JUNK), a, np.full_like(a, -JUNK)], axis=-1)[..., 1]


def nested(a: Numbers, kind: Callable[[Any], Any]) -> Any:
    return kind(nested(row, kind) for row in a) if a.ndim else a.item()


FORMS: dict[str, Callable[[Numbers], Any]] = {
    "strided": strided,
    "reversed": backwards,
    "column": column,
    "Fortran": lambda a: np.asfortranarray(np.stack([a, a + JUNK]))[0],
    "transposed": lambda a: np.ascontiguousarray(a.T).T,
    "float32": lambda a: a.astype(np.float32),
    "strided float32": lambda a: strided(a).astype(np.float32)[::1],
    "longdouble": lambda a: a.astype(np.longdouble),
    "big-endian": lambda a: a.astype(">f8"),
    "big-endian float32": lambda a: a.astype(">f4"),
    "little-endian": lambda a: a.astype("<f8"),
    "read-only": read_only,
    "masked": lambda a: np.ma.masked_invalid(a.copy()) if np.isfinite(a).all() else a,
    "masked without a mask": lambda a: np.ma.array(a),
    "list": lambda a: nested(a, list),
    "tuple": lambda a: nested(a, tuple),
    "unaligned": unaligned,
    "objects": lambda a: a.astype(object),
    "fractions": lambda a: np.frompyfunc(lambda x: x if np.isnan(x) else Fraction(x), 1, 1)(a),
    "xarray": lambda a: xarray.DataArray(a),
}
ROWS: dict[str, Callable[[Numbers], Any]] = {  # of one dimension only
    "pandas column": lambda a: pandas.DataFrame({"x": a * 0.0, "a": a, "n": np.arange(len(a))})["a"],
    "pandas every second": lambda a: pandas.Series(np.repeat(a, 2))[::2],
    "pandas nullable": lambda a: pandas.Series(a, dtype="Float64"),
    "pandas float32": lambda a: pandas.Series(a.astype(np.float32)),
    "pandas index": lambda a: pandas.Index(a),
    "array.array": lambda a: array.array("d", a.tolist()),
    "memoryview": lambda a: memoryview(a.copy().data),
}
WHOLE: dict[str, Callable[[Numbers], Any]] = {
    "int64": lambda a: a.astype(np.int64),
    "int32": lambda a: a.astype(np.int32),
    "int8": lambda a: a.astype(np.int8),
    "big-endian int": lambda a: a.astype(">i4"),
    "strided int": lambda a: strided(a).astype(np.int64),
    "list of int": lambda a: nested(a.astype(int), list),
    "float16": lambda a: a.astype(np.float16) if (np.abs(a) < 2048).all() else a,
}


@dataclass(frozen=True)
class Argument:
    """`fine` and `whole` are plain arrays of its shape; `call` gives bytes."""

    name: str
    fine: Numbers
    whole: Numbers
    call: Callable[[Any], bytes]

    def forms(self) -> Iterator[tuple[str, Numbers, Callable[[Numbers], Any]]]:
        """(form, plain array, how it is sent)."""
        for form, make in {**FORMS, **(ROWS if self.fine.ndim == 1 else {})}.items():
            yield form, self.fine, make
        if np.isfinite(self.whole).all():
            for form, make in WHOLE.items():
                yield form, self.whole, make


def raw(*found: Any) -> bytes:
    """All bits of arrays, results, evaluations."""
    out = b""
    for item in found:
        if isinstance(item, Result):
            names = ("t", "q", "v", "a", "state", "memory", "work", "impacts", "events", "p", "given", "is_given")
            item = [getattr(item, name) for name in names]
        elif hasattr(item, "__dataclass_fields__"):
            item = [getattr(item, each.name) for each in fields(item)]
        out += raw(*item) if isinstance(item, (list, tuple)) else np.asarray(item).tobytes()
    return out


def message(call: Callable[[Any], bytes], values: Any) -> bytes:
    """What a call gives, or the error of a state that has no accelerations."""
    try:
        return call(values)
    except SolverError as error:
        return raw(error.partial) + str(error).encode() if error.partial else str(error).encode()


def fine(*numbers: float) -> Numbers:
    return np.round(np.array(numbers, dtype=float) * 1024) / 1024 + 0.0  # no integer is −0


def at_half(
    function: Callable[..., Any], *values: Numbers | None, then: Callable[[Any], Any] = lambda x: x
) -> Callable[[Any], Any]:
    """A call at t = 0.5 s with what is sent in the place of None."""
    return lambda x: then(function(0.5, *(x if value is None else value for value in values)))


def compiled_arguments(simulation: gudgeon.Simulation, y: Numbers, whole: Numbers) -> Iterator[Argument]:
    """Of CompiledModel, at a state y and another one of whole numbers."""
    model, n = simulation.compiled, simulation.compiled.n
    p, ones = simulation.p.astype(np.float32).astype(np.float64), np.ones(len(simulation.p))
    nothing, one = np.full(model.n_discrete_states, np.nan), np.ones(model.n_discrete_states)
    given, mask = p[: len(simulation.source.parameters)], np.arange(len(simulation.source.parameters)) % 2.0

    def argument(name: str, values: Numbers, others: Numbers, call: Callable[[Any], Any]) -> Argument:
        return Argument(f"compiled.{name}", values, others, lambda x: raw(call(x)))

    yield argument("prepare given", given, np.ones(len(given)), lambda x: model.prepare(x, mask))
    yield argument("prepare is_given", mask, 1 - mask, lambda x: model.prepare(given, x))
    yield argument("mass p", p, ones, model.mass)
    yield argument("start_values p", p, ones, model.start_values)
    yield argument("close p", p, ones, lambda x: model.close_linkage(0.0, x, 1.0) or ())
    for name in ("closed_phi", "closed_phi_q", "closed_nu", "phi", "phi_q", "nu"):
        function = getattr(model, name)
        yield argument(f"{name} q", y[:n], whole[:n], at_half(function, None, p))
        yield argument(f"{name} p", p, ones, at_half(function, y[:n], None))
    yield argument("gamma q", y[:n], whole[:n], lambda x: model.gamma(0.5, x, y[n:], p))
    yield argument("gamma v", y[n:], whole[n:], lambda x: model.gamma(0.5, y[:n], x, p))
    N, t = 4, fine(0, 0.25, 0.5, 0.75)
    rows, others = np.tile(y, (N, 1)) + fine(0, 0.5, 0.25, 0.125)[:, None], np.tile(whole, (N, 1))
    q, v, memory = rows[:, :n], rows[:, n:], np.tile(nothing, (N, 1))
    yield argument("evaluate t", t, np.arange(4.0), lambda x: model.evaluate(x, q, v, memory, p))
    yield argument("evaluate q", q.copy(), others[:, :n].copy(), lambda x: model.evaluate(t, x, v, memory, p))
    yield argument("evaluate v", v.copy(), others[:, n:].copy(), lambda x: model.evaluate(t, q, x, memory, p))
    yield argument("evaluate p", p, ones, lambda x: model.evaluate(t, q, v, memory, x))
    if model.n_discrete_states:
        yield argument("memory_array", one, one, model.as_discrete_states)
        yield argument("evaluate memory", memory + 0, memory + 1, lambda x: model.evaluate(t, q, v, x, p))
    if not hasattr(model.lib, "gudgeon_rhs"):
        return
    yield argument("rhs y", y, whole, lambda x: model.rhs(0.5, x, p))
    yield argument("rhs p", p, ones, lambda x: model.rhs(0.5, y, x))
    if model.n_discrete_states:
        yield argument("rhs memory", one / 2, one, lambda x: model.rhs(0.5, y, p, x))
    if hasattr(model.lib, "gudgeon_jacobian"):
        r = np.arange(2.0 * n + 3)
        yield argument("jacobian y", y, whole, lambda x: model.jacobian(0.5, x, p))
        yield argument("jacobian p", p, ones, lambda x: model.jacobian(0.5, y, x))
        yield argument("newton y", y, whole, lambda x: model.solve_newton_system(0.5, x, p, 0.1, 1.0, r))
        yield argument("newton p", p, ones, lambda x: model.solve_newton_system(0.5, y, x, 0.1, 1.0, r))
        yield argument("newton r", r / 8, r, lambda x: model.solve_newton_system(0.5, y, p, 0.1, 1.0, x))
        if model.n_discrete_states:
            yield argument("jacobian memory", one / 2, one, lambda x: model.jacobian(0.5, y, p, x))
            yield argument(
                "newton memory", one / 2, one, lambda x: model.solve_newton_system(0.5, y, p, 0.1, 1.0, r, x)
            )


def simulation_arguments(simulation: gudgeon.Simulation, y: Numbers, whole: Numbers) -> Iterator[Argument]:
    """Of Simulation, but for its runs."""
    n = simulation.compiled.n
    for name in ("phi", "phi_q", "nu"):
        function = getattr(simulation, name)
        yield Argument(f"{name} q", y[:n], whole[:n], at_half(function, None, then=raw))
    yield Argument("gamma q", y[:n], whole[:n], lambda x: raw(simulation.gamma(0.5, x, y[n:])))
    yield Argument("gamma v", y[n:], whole[n:], lambda x: raw(simulation.gamma(0.5, y[:n], x)))
    if simulation.source.degrees_of_freedom:
        yield Argument("rhs y", y, whole, lambda x: raw(simulation.rhs(0.5, x)))
        yield Argument("jacobian y", y, whole, lambda x: raw(simulation.jacobian(0.5, x)))
        if simulation.compiled.n_discrete_states:
            one = np.ones(simulation.compiled.n_discrete_states)
            yield Argument("rhs memory", one / 2, one, lambda x: raw(simulation.rhs(0.5, y, x)))
            yield Argument("jacobian memory", one / 2, one, lambda x: raw(simulation.jacobian(0.5, y, x)))


def run_arguments(
    simulation: gudgeon.Simulation, method: str, times: Numbers, parameter: str, state: State
) -> Iterator[Argument]:
    """Of simulate and simulate_many with one method; the state is for `start`."""
    options: dict[str, Any] = {"method": method} | ({"step": 2.0**-11} if method == "rk4" else {})
    whole = np.arange(2.0)
    if "scipy" in method:  # slow: Python at each step
        options["rtol"], times = 1e-2, times / 16
    yield Argument("output", times, whole, lambda x: raw(simulation.simulate(output=x, **options)))

    def many(values: Any, **more: Any) -> bytes:
        batch = simulation.simulate_many({parameter: values}, threads=1, **options, **more)
        return raw(batch.t, batch.q, batch.v, batch.work, batch.state, *batch.parameters.values(), batch[0])

    if "scipy" in method and method != "scipy:DOP853":  # all of them have one driver
        return
    yield Argument("many output", times, whole, lambda x: many([2.0, 3.0], output=x))
    yield Argument("many column", fine(2.0, 2.5, 3.25), np.array([2.0, 3.0, 4.0]), lambda x: many(x, output=times))

    rows, ends = fine(0.0, 0.25, 0.5, 0.0, 0.375, 0.5).reshape(2, 3) / (16 if "scipy" in method else 1), fine(0.25, 0.5)
    yield Argument("many rows", rows, np.array([[0.0, 1.0], [0.0, 2.0]]), lambda x: many([2.0, 3.0], output=x))
    if "scipy" not in method:
        yield Argument("many t_end", ends, whole + 1.0, lambda x: many([2.0, 3.0], t_end=x, output=2))
    if method == "rk4":
        steps, given = fine(2.0**-9, 2.0**-10), {**options}
        given.pop("step")
        yield Argument(
            "many step",
            steps,
            whole + 1.0,
            lambda x: raw(
                simulation.simulate_many({parameter: [2.0, 3.0]}, threads=1, output=times, step=x, **given).q
            ),
        )

    def going_on(name: str, values: Any) -> bytes:
        return raw(simulation.simulate(output=times, start=replace(state, **{name: values}), **options))

    for name in ("q",) if "scipy" in method else ("q", "v", "memory", "state"):
        plain = np.array(getattr(state, name), dtype=float)
        if plain.size:
            yield Argument(f"start.{name}", plain, np.round(plain) + 0.0, partial(going_on, name))


PENDULUM = fine(1.0, 0.0, 0.25, 0.0, 0.5, 1.0), np.array([0.0, -1.0, 0.0, 1.0, 0.0, 2.0])
BALL = fine(0.0, -1.0, 0.5, 0.0, 0.5, 1.5), np.array([0.0, -1.0, 1.0, 0.0, 1.0, 2.0])
TIMES = fine(0.0, 0.25, 0.375, 0.5)
OWN = ("auto", "rk4", "dop853", "dopri5", "rodas5p", "radau5", "radau9")
CHECKS = tuple(name for name in python_driver.NAMES if name.startswith("scipy:"))


def a_state(y: Numbers, memory: Numbers, codes: Numbers) -> State:
    n = len(y) // 2
    return State("", "", 0.0, y[:n].copy(), y[n:].copy(), codes, memory, {})


@cache
def arguments(group: str) -> tuple[Argument, ...]:
    """The arguments of a group: a scene, its model or a method."""
    name, _, what = group.partition(" ")
    if name == "crank":  # no degree of freedom: kinematic
        crank = gudgeon.load("slider_crank")
        start = crank.start()
        y = fine(*start.q, *start.v)
        if what != "model":
            return tuple(run_arguments(crank, what, TIMES / 16, "omega", a_state(y, np.zeros(0), np.zeros(0))))
        return (*compiled_arguments(crank, y, np.ones(len(y))), *simulation_arguments(crank, y, np.ones(len(y))))
    play = name.startswith("ball")
    scene = "damped" if play else "ideal"
    mechanism, (y, whole) = ("bouncing_ball", BALL) if play else ("pendulum", PENDULUM)
    formulation = "full" if name.endswith("full") else "reduced"
    simulation = gudgeon.load(mechanism, scene=scene, formulation=formulation)
    if what == "model":
        return (*compiled_arguments(simulation, y, whole), *simulation_arguments(simulation, y, whole))
    memory, codes = (np.array([0.5]), np.array([2.0])) if play else (np.zeros(0), np.zeros(0))
    return tuple(run_arguments(simulation, what, TIMES, "gravity.y" if play else "g", a_state(y, memory, codes)))


GROUPS = (
    "pendulum model",
    "pendulum-full model",
    "ball model",
    "ball-full model",
    "crank model",
    *(f"pendulum {method}" for method in (*OWN, *CHECKS)),
    "pendulum-full auto",
    "ball auto",
    "ball rk4",
    "ball rodas5p",
    "pendulum taylor",
    "crank auto",
    "crank kinematic",
)


# what the others are sent through is what these are sent through
DIFFERENT = (*GROUPS[2:5], "ball auto", "ball rk4", "crank kinematic")


@pytest.mark.parametrize("group", slow_but(DIFFERENT, GROUPS))
def test_the_same_numbers_give_the_same_bits(group: str) -> None:
    wrong = []
    for argument in arguments(group):
        plain: dict[int, bytes] = {}
        for form, numbers, make in argument.forms():
            if id(numbers) not in plain:
                plain[id(numbers)] = message(argument.call, numbers)
            before, sent = numbers.copy(), make(numbers)
            if message(argument.call, sent) != plain[id(numbers)]:
                wrong.append(f"{argument.name}: {form}")
            assert np.array_equal(numbers, before, equal_nan=True)  # nobody writes into what was handed in
    assert not wrong


def test_every_method_is_among_them() -> None:
    tried = {group.partition(" ")[2] for group in GROUPS}
    assert {name for name in METHODS if not name.startswith("sundials:")} - {"adaptive"} <= tried


def combinations() -> int:
    """How many (argument, form) pairs are compared."""
    return sum(sum(1 for _ in argument.forms()) for group in GROUPS for argument in arguments(group))


def test_their_number() -> None:
    assert len(arguments("pendulum auto")[0].fine) and combinations() > 7000


if __name__ == "__main__":
    print(combinations(), "combinations of", sum(len(arguments(group)) for group in GROUPS), "arguments")

"""Values computed once for equal parameters: repeated runs are equal, changed parameters count, nothing leaks."""

import pickle

import numpy as np
import pytest

import gudgeon
from gudgeon.assembly.guess_warnings import find_guess_deviations
from gudgeon.assembly.start import assemble_start
from gudgeon.contract.kernel_source import CACHED_VALUES
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.model.cached_values import MAX_BYTES, MAX_ENTRIES, cache_by_values, cache_selected_values
from gudgeon.simulation.file_start import assemble_file_start


class Owner:
    """An object with attributes, as a scene is one."""


def test_functions_are_called_once_for_equal_values_and_the_oldest_results_are_dropped() -> None:
    """Arrays are compared by their bytes and shapes; large arrays and exceptions are not cached."""
    calls: list[float] = []

    @cache_by_values
    def compute_sum(owner: Owner, values: np.ndarray, factor: float = 1.0) -> float:
        calls.append(factor)
        if factor < 0.0:
            raise ValueError(factor)
        return float(values.sum() * factor)

    owner, other = Owner(), Owner()
    for _ in range(2):
        assert compute_sum(owner, np.array([1.0, 2.0]), 2.0) == 6.0
        assert compute_sum(owner, np.array([[1.0, 2.0]]), 2.0) == 6.0  # another shape: another call
        assert compute_sum(other, np.array([1.0, 2.0]), 2.0) == 6.0  # another owner, too
    assert len(calls) == 3
    for _ in range(2):
        with pytest.raises(ValueError):
            compute_sum(owner, np.zeros(1), -1.0)
        compute_sum(owner, np.zeros(MAX_BYTES), 3.0)
    assert calls[3:] == [-1.0, 3.0, -1.0, 3.0]
    for k in range(2 * MAX_ENTRIES):
        compute_sum(owner, np.array([float(k)]))
    assert len(vars(owner)[CACHED_VALUES]) == MAX_ENTRIES


def test_repeated_runs_are_equal_and_a_changed_result_does_not_change_the_next_run() -> None:
    """The start is computed once; arrays of a result belong to the caller."""
    simulation = gudgeon.load("four_bar")
    first = simulation.simulate(t_end=0.01, output=4)
    start = first.q[0].copy()
    for array in (first.q, first.v, first.p):
        if array.flags.writeable:
            array[:] = 0.0
    second = simulation.simulate(t_end=0.01, output=4)
    assert (second.q[0] == start).all()
    fresh = gudgeon.load("four_bar").simulate(t_end=0.01, output=4)
    assert all((getattr(second, name) == getattr(fresh, name)).all() for name in ("t", "q", "v", "p"))


def test_other_parameters_are_checked_and_closed_anew() -> None:
    """Parameters in turns: each run has the start and the errors of its own values."""
    simulation = gudgeon.load("slider_crank", scene="ideal")
    lengths = (0.05, 0.045, 0.05, 0.045)
    parameter_sets = [{"bodies.crank.length": length} for length in lengths]
    starts = [simulation.simulate(t_end=1e-3, output=1, parameters=values).q[0] for values in parameter_sets]
    assert (starts[0] == starts[2]).all() and (starts[1] == starts[3]).all() and (starts[0] != starts[1]).any()
    for _ in range(2):
        with pytest.raises(BadValueError):
            simulation.simulate(t_end=1e-3, parameters={"bodies.rod.mass": -1.0})


def test_cached_values_are_not_pickled() -> None:
    """A pickled result is no larger after many runs than after one."""
    simulation = gudgeon.load("four_bar")
    size = len(pickle.dumps(simulation.simulate(t_end=1e-3, output=1)))
    for k in range(20):
        simulation.simulate(t_end=1e-3 * (1 + k), output=1)
    assert abs(len(pickle.dumps(simulation.simulate(t_end=1e-3, output=1))) - size) < 200


def test_equal_values_of_other_types_are_other_arguments_and_lists_are_not_cached() -> None:
    """True is not 1: a check of types would otherwise depend on the calls before."""
    calls: list[object] = []

    @cache_by_values
    def describe(owner: Owner, value: object) -> str:
        calls.append(value)
        return type(value).__name__

    owner = Owner()
    assert [describe(owner, value) for value in (1, True, 1.0, np.float64(1.0), 1, True)] == [
        "int",
        "bool",
        "float",
        "float64",
        "int",
        "bool",
    ]
    assert len(calls) == 4
    assert describe(owner, [1]) == describe(owner, [1]) == "list" and len(calls) == 6


def test_results_that_depend_on_the_scene_alone_stay() -> None:
    """Many parameter values do not remove them, so that they are computed once."""
    calls: list[int] = []

    @cache_by_values
    def measure(owner: Owner) -> int:
        calls.append(1)
        return 1

    @cache_by_values
    def double(owner: Owner, value: float) -> float:
        return 2.0 * value

    owner = Owner()
    for k in range(2 * MAX_ENTRIES):
        assert measure(owner) == 1 and double(owner, float(k)) == 2.0 * k
    assert len(calls) == 1


def test_selected_values_are_the_key() -> None:
    """Only what `select` returns is compared; without a hash, nothing is cached."""
    calls: list[float] = []

    @cache_selected_values(lambda owner, values: (values[:1],) if values[0] > 0.0 else ([],))
    def compute_first(owner: Owner, values: np.ndarray) -> float:
        calls.append(float(values[0]))
        return float(values[0])

    owner = Owner()
    for second in (1.0, 2.0, 3.0):
        assert compute_first(owner, np.array([5.0, second])) == 5.0
        assert compute_first(owner, np.array([-5.0, second])) == -5.0
    assert calls == [5.0, -5.0, -5.0, -5.0]


@pytest.mark.parametrize("name", ["pendulum", "slider_crank", "four_bar", "nine_bar_press", "andrews_squeezer"])
def test_a_cached_start_is_that_of_its_own_parameters(name: str) -> None:
    """Each parameter is changed in turn after a start was cached: each start has the bits of a fresh assembly."""
    simulation = gudgeon.load(name)
    compiled, n_reused = simulation.compiled, 0
    first = assemble_file_start(compiled, simulation.p)
    for k, slot in enumerate(compiled.source.parameters):
        if slot.words:
            continue
        given, is_given = np.zeros(len(compiled.source.parameters)), np.zeros(len(compiled.source.parameters), bool)
        given[k], is_given[k] = 1.001 * slot.default + 1e-4 * (slot.default == 0.0), True
        p = compiled.prepare(given, is_given)
        try:
            start = assemble_start(compiled, p)
        except GudgeonError:
            with pytest.raises(GudgeonError):
                assemble_file_start(compiled, p)
            continue
        cached = assemble_file_start(compiled, p)
        assert cached.q.tobytes() == start.q.tobytes() and cached.v.tobytes() == start.v.tobytes(), slot.address
        assert cached.guess_deviations == find_guess_deviations(compiled, p, start.q)
        n_reused += cached.q is first.q
    assert n_reused > 0 or compiled.source.methods == ("kinematic",)

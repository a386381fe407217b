"""Short runs: their audit is decided at the call, what their diagnostics say is computed when it is read."""

from __future__ import annotations

import copy
import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.contract.boundary import AUDIT_FAILS, N_CHECKS, N_WORK
from gudgeon.errors import AuditError
from gudgeon.integrators.single_run import MAX_UNUSED_RUNS
from gudgeon.model.deferred_fields import find_deferred_function
from gudgeon.results.results import Result
from gudgeon.simulation.audit import BODY_LIMIT, MIN_CALLS_OF_LONG_RUN, has_failed_finding
from gudgeon.simulation.newton_euler import compute_newton_euler_residuals
from gudgeon.simulation.simulation import Simulation

SCENES = (
    ("nine_bar_press", "dry", "c"),
    ("nine_bar_press", "lubricated", "c"),
    ("andrews_squeezer", "ideal", "bodies.OF.mass"),
    ("bouncing_ball", "hertz", None),
    ("belt_block", "driven", None),
)
ARRAYS = ("t", "q", "v", "a", "state", "memory", "work", "impacts", "events", "p")
OF_TIME = ("seconds", "seconds_per_simulated_second")  # fields of diagnostics that no two runs share


def load(mechanism: str, scene: str) -> Simulation:
    """The scene, or the first of the file if it has none of that name."""
    try:
        return gudgeon.load(mechanism, scene)
    except gudgeon.InputError:
        return gudgeon.load(mechanism)


def describe(run: Result) -> str:
    """The diagnostics as text, without times of the computer."""
    without_times: dict[str, Any] = dict.fromkeys(OF_TIME, 0.0)
    return replace(run.diagnostics, **without_times).to_json()


def is_deferred(run: Result) -> bool:
    """Whether nothing has computed the diagnostics yet."""
    return find_deferred_function(run, "diagnostics") is not None


def same(one: Result, other: Result) -> bool:
    """Whether two runs have the same bits and diagnostics."""
    arrays = all(getattr(one, name).tobytes() == getattr(other, name).tobytes() for name in ARRAYS)
    parts = zip(vars(one.evaluation).values(), vars(other.evaluation).values(), strict=True)
    return arrays and all(a.tobytes() == b.tobytes() for a, b in parts) and describe(one) == describe(other)


@pytest.mark.parametrize(("mechanism", "scene", "name"), SCENES)
@pytest.mark.parametrize(
    "settings", [{"output": 1}, {"output": 7}, {"output": 60}, {"output": [2e-4, 5e-4]}, {"audit": "full"}]
)
def test_deferred_diagnostics_are_those_of_a_run_that_is_checked_at_once(
    mechanism: str, scene: str, name: str | None, settings: dict[str, Any]
) -> None:
    """A callback for progress has all samples checked within the call; it changes no number."""
    simulation = load(mechanism, scene)
    arguments: dict[str, Any] = {"t_end": 5e-4, "output": 3} | settings
    lazy = simulation.simulate(**arguments)
    at_once = simulation.simulate(**arguments, progress=lambda *_: None)
    assert not is_deferred(at_once)
    assert same(lazy, at_once) and not is_deferred(lazy)
    assert lazy.provenance.keys() == at_once.provenance.keys()


def test_a_quiet_short_run_is_deferred_and_a_run_of_many_samples_is_not() -> None:
    """Otherwise the test above would compare two equal paths."""
    simulation = gudgeon.load("andrews_squeezer")
    assert is_deferred(simulation.simulate(1e-4, output=2))
    assert is_deferred(simulation.simulate(1e-4, output=60))
    assert not is_deferred(simulation.simulate(1e-4, output=400))
    assert not is_deferred(simulation.simulate(1e-4, output=2, audit="full"))


def test_later_runs_and_changed_arrays_do_not_change_a_result() -> None:
    """The memory of a run is used again; its result has copies, also for diagnostics that are read later."""
    simulation, runs, masses = gudgeon.load("nine_bar_press", "dry"), [], (40.0, 41.0, 42.0)
    for mass in masses:
        runs.append(simulation.simulate(1e-4, output=2, parameters={"bodies.S9.mass": mass}))
    fresh = [
        gudgeon.load("nine_bar_press", "dry").simulate(1e-4, output=2, parameters={"bodies.S9.mass": mass})
        for mass in masses
    ]
    assert len({run.q.tobytes() + run.v.tobytes() for run in runs}) == len(masses)
    changed = simulation.simulate(1e-4, output=2, parameters={"bodies.S9.mass": masses[0]})
    for array in (changed.t, changed.q, changed.v, changed.work, changed.p):
        array[...] = np.nan
    assert describe(changed) == describe(fresh[0])
    assert all(same(one, other) for one, other in zip(runs, fresh, strict=True))


def test_results_with_unread_diagnostics_are_pickled_copied_and_replaced() -> None:
    """Each copy has the diagnostics, and the original still has them to compute."""
    simulation = gudgeon.load("andrews_squeezer")
    expected = simulation.simulate(1e-4, output=2, progress=lambda *_: None)
    for make in (
        lambda run: pickle.loads(pickle.dumps(run)),
        copy.copy,
        copy.deepcopy,
        lambda run: replace(run, stored={}),
    ):
        run = simulation.simulate(1e-4, output=2)
        assert is_deferred(run) and same(make(run), expected) and same(run, expected)


FAULTS = {  # what is changed in the arrays that C checks, which have rows of q, q̇ and works
    "none": lambda y, n, audited, start: None,
    "position": lambda y, n, audited, start: y.__setitem__((1, 0), y[1, 0] + 1e-6),
    "velocity": lambda y, n, audited, start: y.__setitem__((1, n + 2), 1.001 * y[1, n + 2] + 1e-3),
    "start": lambda y, n, audited, start: start.__setitem__(0, start[0] + 1e-6),
    "rates of the start": lambda y, n, audited, start: start.__setitem__(n + 2, start[n + 2] + 1e-3),
    "a step": lambda y, n, audited, start: audited.__setitem__(0, 2.0 * AUDIT_FAILS),
    "not a number": lambda y, n, audited, start: y.__setitem__((2, 3), np.nan),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_c_finds_known_faults_in_samples(fault: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Samples pass as they are, and do not if one number of a sample, of the start or of the audit is wrong."""
    simulation, decisions = gudgeon.load("andrews_squeezer"), list[int]()
    compiled, check = simulation.compiled, simulation.compiled.lib.gudgeon_check_samples

    def view(pointer: Any, *shape: int) -> np.ndarray:
        size = 8 * int(np.prod(shape))
        return np.frombuffer(compiled.ffi.buffer(compiled.ffi.cast("char *", pointer), size)).reshape(shape)

    def change_and_check(n_samples: int, *arguments: Any) -> int:
        y, audited = view(arguments[1], n_samples, 2 * compiled.n + N_WORK), view(arguments[6], N_CHECKS)
        arrays = y, audited, view(arguments[9], 2 * compiled.n)
        copies = [array.copy() for array in arrays]
        FAULTS[fault](y, compiled.n, *arrays[1:])
        decisions.append(check(n_samples, *arguments))
        for array, values in zip(arrays, copies, strict=True):
            array[...] = values
        return decisions[-1]

    monkeypatch.setitem(vars(compiled.lib), "gudgeon_check_samples", change_and_check)
    run = simulation.simulate(1e-4, output=2)
    assert decisions == [int(fault == "none")] and is_deferred(run) == (fault == "none")
    assert not run.diagnostics.notes  # the samples are right: the findings say so


@pytest.mark.parametrize(("scene", "t_end"), [("dry", 0.1), ("lubricated", 0.5)])
def test_long_runs_with_forces_in_joints_are_deferred(scene: str, t_end: float) -> None:
    """Their findings on contact forces and on the equations of single bodies are those of a run checked at once."""
    simulation = gudgeon.load("nine_bar_press", scene)
    lazy = simulation.simulate(t_end, output=200)
    at_once = simulation.simulate(t_end, output=200, progress=lambda *_: None)
    assert lazy["A.F"].max() > 0.0 and is_deferred(lazy)
    assert lazy.diagnostics.right_hand_sides > MIN_CALLS_OF_LONG_RUN
    assert same(lazy, at_once) and {"body", "power"} <= {one.check for one in lazy.diagnostics.audit}


def test_c_finds_a_force_without_a_contact(monkeypatch: pytest.MonkeyPatch) -> None:
    """The discrete state of a sample in contact says that the joint is open."""
    simulation = gudgeon.load("nine_bar_press", "dry")
    compiled, check = simulation.compiled, simulation.compiled.lib.gudgeon_check_samples

    def open_joints_and_check(n_samples: int, *arguments: Any) -> int:
        size = 8 * n_samples * compiled.n_discrete_states
        discrete = np.frombuffer(compiled.ffi.buffer(compiled.ffi.cast("char *", arguments[2]), size))
        stored = discrete.copy()
        discrete[...] = np.nan
        result: int = check(n_samples, *arguments)
        discrete[...] = stored
        return result

    assert is_deferred(simulation.simulate(0.02, output=200))
    monkeypatch.setitem(vars(compiled.lib), "gudgeon_check_samples", open_joints_and_check)
    run = simulation.simulate(0.02, output=200)
    assert not is_deferred(run)
    assert not has_failed_finding(run.diagnostics.audit)  # the samples are right: the findings say so


@pytest.mark.parametrize("part", ["a", "reactions", "clearance"])
def test_c_finds_an_error_in_the_equations_of_single_bodies(part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A limit that no run fulfils is exceeded; and the residuals of C are those of the run's evaluation."""
    monkeypatch.setitem(BODY_LIMIT, "body", 1e-25)
    simulation = gudgeon.load("nine_bar_press", "dry")
    with pytest.raises(AuditError, match="check body"):
        simulation.simulate(0.1, output=200)
    run = simulation.simulate(0.1, output=200, audit=False)
    assert run.compiled is not None
    evaluation = run.evaluation
    changed = replace(evaluation, **{part: 1.001 * getattr(evaluation, part)})
    residuals = [compute_newton_euler_residuals(run.compiled, run.p, run.q, x).max() for x in (evaluation, changed)]
    assert residuals[0] < 1e-12 and residuals[1] > 1e-5


def test_a_failed_check_of_samples_is_an_error_of_the_call(monkeypatch: pytest.MonkeyPatch) -> None:
    """An error of power far above its limit, which C reports for the second sample."""
    simulation = gudgeon.load("andrews_squeezer")
    compiled, simulate = simulation.compiled, simulation.simulate
    simulate(1e-4, output=2)
    audit_samples = compiled.lib.gudgeon_audit_samples

    def report_error(n: int, *arguments: Any) -> None:
        audit_samples(n, *arguments)
        arguments[-1][4] = 1.0

    monkeypatch.setitem(vars(compiled.lib), "gudgeon_audit_samples", report_error)
    monkeypatch.setitem(vars(compiled.lib), "gudgeon_check_samples", lambda *_: 0)
    with pytest.raises(AuditError, match="check power"):
        simulate(1e-4, output=2)
    assert simulate(1e-4, output=2, audit=False).diagnostics.audit == ()
    monkeypatch.undo()
    assert is_deferred(simulate(1e-4, output=2))


def test_an_energy_that_is_not_balanced_is_an_error_of_the_call(monkeypatch: pytest.MonkeyPatch) -> None:
    """The kinetic energy of one sample is wrong by 1 kJ in what C evaluates."""
    simulation = gudgeon.load("andrews_squeezer")
    assert is_deferred(simulation.simulate(2e-3, output=60))
    functions = vars(simulation.compiled.lib)
    check, evaluate = simulation.compiled.lib.gudgeon_check_samples, simulation.compiled.lib.gudgeon_evaluate

    def change_energies(n: int, *arguments: Any) -> int:
        status: int = check(n, *arguments)
        arguments[4][2 * (n - 1)] += 1e3
        return status

    def change_energy(n: int, *arguments: Any) -> int:
        status: int = evaluate(n, *arguments)
        arguments[12][2 * (n - 1)] += 1e3
        return status

    monkeypatch.setitem(functions, "gudgeon_check_samples", change_energies)
    assert not is_deferred(simulation.simulate(2e-3, output=60))
    monkeypatch.setitem(functions, "gudgeon_evaluate", change_energy)
    with pytest.raises(AuditError, match="check energy"):
        simulation.simulate(2e-3, output=60)


def test_threads_have_memory_of_their_own_and_little_of_it_is_kept() -> None:
    """Runs of several threads at once are those of one thread, whatever ran in the memory before."""
    simulation = gudgeon.load("nine_bar_press", "dry")

    def run(k: int) -> bytes:
        result = simulation.simulate(2e-3, output=1 + k % 3, parameters={"bodies.S9.mass": 40.0 + k % 5})
        return result.q.tobytes() + describe(result).encode()

    expected = [run(k) for k in range(30)]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(run, range(30))) == expected
    for k in range(2 * MAX_UNUSED_RUNS):
        simulation.simulate(1e-4, output=1 + k)
    free = simulation.compiled.unused_runs
    assert len(free) <= MAX_UNUSED_RUNS and all(len(runs) <= MAX_UNUSED_RUNS for runs in free.values())

"""Kinematic runs of a batch, which C computes without Python: the bits of `simulate`, failures and notes included."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators import lanes
from gudgeon.model import cached_values
from gudgeon.results.batch import Batch
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = [needs_compiler, pytest.mark.filterwarnings("ignore:.*guess")]
LINKAGE = """
gravity: [0, -9.81 m/s^2]
parameters: {w: 2*pi rad/s, power: 2}
bodies:
  a: {length: 0.15 m, mass: 1 kg, inertia: 0.01 kg*m^2}
  b: {length: 0.5 m, mass: 1 kg, inertia: 0.02 kg*m^2}
  c: {length: 0.4 m, mass: 1 kg, inertia: 0.01 kg*m^2}
ground: {O: [0, 0], P: [0.45 m, 0]}
joints:
  O: {revolute: [ground.O, a.tail]}
  A: {revolute: [a.head, b.tail]}
  B: {revolute: [b.head, c.head]}
  P: {revolute: [ground.P, c.tail]}
drives: {turn: {angle: a, value: 20 deg + w*t}}
start: {guess: {b.theta: 20 deg, c.theta: 80 deg}}
outputs: {between: c.theta - b.theta}
"""
STATES = ("q", "v", "work")
MOTION = ("c.theta", "b.x", "c.omega", "c.alpha", "b.head.x", "b.head.vy", "b.head.ax", "c.head.ay", "ground.P.x")
SERIES = ("c.theta", "c.alpha", "B.F", "turn.torque", "work.drives", "energy.residual", "between", "Phi.max")


@pytest.fixture(params=["reduced", pytest.param("full", marks=pytest.mark.slow)])
def linkage(tmp_path: Path, request: pytest.FixtureRequest) -> Simulation:
    return loader(tmp_path, request.param)(LINKAGE)


def draw_lengths(n: int, spread: float) -> list[dict[str, float]]:
    """Return lengths of n linkages; with a large spread, some do not close, and some cannot turn."""
    rng = np.random.default_rng(2)
    nominal = {"a": 0.15, "b": 0.5, "c": 0.4}
    return [
        {f"bodies.{name}.length": length * (1.0 + spread * rng.uniform(-1.0, 1.0)) for name, length in nominal.items()}
        for _ in range(n)
    ]


def assert_runs_are_single_runs(batch: Batch, linkage: Simulation, parameters: list[dict[str, float]]) -> None:
    """Compare states, notes and errors of each run with `simulate`, bit for bit."""
    failures = {failure.run: str(failure.error) for failure in batch.failures}
    for i, values in enumerate(parameters):
        try:
            alone = linkage.simulate(1.0, output=batch.t.shape[-1] - 1, parameters=values)
        except GudgeonError as error:
            assert failures.pop(i) == str(error)
            partial = getattr(error, "partial", None)
            if partial is None:
                assert batch.samples[i] == 0
                continue
            alone = partial
        n = int(batch.samples[i])
        assert n == len(alone.t)
        for name in STATES:
            assert getattr(batch, name)[i, :n].tobytes() == getattr(alone, name).tobytes()
        assert batch.diagnostics["phi_max"][i] == alone.diagnostics.phi_max
        assert batch.diagnostics["steps"][i] == alone.diagnostics.steps
        run = batch.partial(i)
        assert run is not None
        assert run.diagnostics.notes == alone.diagnostics.notes
        assert run.a.tobytes() == alone.a.tobytes()
    assert not failures


@pytest.mark.parametrize("samples", [3, 40])
def test_runs_are_those_of_simulate(linkage: Simulation, samples: int) -> None:
    parameters = draw_lengths(40, 0.5)
    batch = linkage.simulate_many(parameters, 1.0, output=samples)
    kinds = {str(failure.error)[:20] for failure in batch.failures}
    assert 5 < len(batch.failures) < 35
    assert len(kinds) > 1
    assert_runs_are_single_runs(batch, linkage, parameters)


def test_stored_series_are_those_of_runs(linkage: Simulation) -> None:
    parameters = draw_lengths(40, 0.5)
    kept = linkage.simulate_many(parameters, 1.0, output=30, keep=SERIES)
    whole = linkage.simulate_many(parameters, 1.0, output=30)
    assert kept.failures == whole.failures
    for i in range(len(kept)):
        run, n = whole.partial(i), int(kept.samples[i])
        for name in SERIES if run else ():
            assert run is not None
            assert kept[name][i, :n].tobytes() == run[name].tobytes(), name
        assert np.isnan(kept["c.theta"][i, n:]).all()


@pytest.mark.parametrize("n", [12, 40])
def test_series_of_motion_are_those_of_runs(linkage: Simulation, n: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """C stores them, without works and states; few runs are computed alone, and others in lanes."""
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    parameters = draw_lengths(n, 0.5)
    for samples, threads in ((3, 1), (30, 2)):
        kept = linkage.simulate_many(parameters, 1.0, output=samples, keep=MOTION, threads=threads)
        whole = linkage.simulate_many(parameters, 1.0, output=samples)
        assert kept.failures == whole.failures and kept.failures
        assert kept.result.notes() == whole.result.notes()
        for name, values in kept.diagnostics.items():
            assert name == "seconds" or values.tobytes() == whole.diagnostics[name].tobytes(), name
        for name in ("t", *MOTION):
            for i in range(n):
                run = whole.partial(i)
                assert run is not None or np.isnan(kept[name][i]).all()
                found = kept[name][i, : int(kept.samples[i])]
                assert run is None or found.tobytes() == run[name].tobytes(), (name, i)
                assert np.isnan(kept[name][i, int(kept.samples[i]) :]).all()


def test_runs_that_python_checks_have_their_works(linkage: Simulation, monkeypatch: pytest.MonkeyPatch) -> None:
    """C computes a run with a finding of the audit again, with states and works, before Python evaluates it."""
    from gudgeon.simulation import audit, suspect_runs

    tight = {check: 2e-17 for check in audit.LIMITS}
    for module in (audit, suspect_runs):
        monkeypatch.setattr(module, "LIMITS", tight)
    parameters = draw_lengths(24, 0.05)
    kept = linkage.simulate_many(parameters, 1.0, output=30, keep=["c.theta", "b.head.ay"])
    whole = linkage.simulate_many(parameters, 1.0, output=30)
    assert len(kept.failures) > 5
    assert kept.failures == whole.failures
    assert kept["b.head.ay"].tobytes() == whole["b.head.ay"].tobytes()


def test_a_power_that_is_undefined_between_samples_fails(tmp_path: Path) -> None:
    """Series of the motion do not need the power of a force, but the run fails as it does alone."""
    push = "forces: {push: {force: b.head, value: [1 N * sqrt(0.5 + t/(1 s) - where(t < 0.52 s, 0, 9)), 0]}}\n"
    linkage = loader(tmp_path)(LINKAGE.replace("outputs:", push + "outputs:"))
    batch = linkage.simulate_many({"w": [3.0, 4.0]}, 1.0, output=2, keep=["c.theta"])
    with pytest.raises(SolverError) as caught:
        linkage.simulate(1.0, output=2, parameters={"w": 3.0})
    assert [failure.run for failure in batch.failures] == [0, 1]
    assert str(batch.failures[0].error) == str(caught.value)


@pytest.mark.parametrize("first", ["20 deg", "20 deg + 2e5 rad"])
def test_points_follow_their_bodies(tmp_path: Path, first: str) -> None:
    """r = r_C + A(theta) s and its time derivatives, by NumPy; sines of large angles are those of the C library."""
    linkage = loader(tmp_path)(LINKAGE.replace("20 deg + w", f"{first} + w"))
    run = linkage.simulate(1.0, output=40)
    theta, omega, alpha = (run[f"a.{name}"] for name in ("theta", "omega", "alpha"))
    arm = 0.5 * 0.15 * np.exp(1j * theta)
    for axis, part in (("x", np.real), ("y", np.imag)):
        velocity, acceleration = 1j * omega * arm, (1j * alpha - omega**2) * arm
        for name, points in ((axis, arm), (f"v{axis}", velocity), (f"a{axis}", acceleration)):
            found, expected = run[f"a.head.{name}"], run[f"a.{name}"] + part(points)
            np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-14 * np.abs(points).max())
    assert (run["ground.P.x"] == 0.45).all()


def test_more_series_than_c_stores(linkage: Simulation, monkeypatch: pytest.MonkeyPatch) -> None:
    """Series beyond the capacity of C are stored from states."""
    from gudgeon.simulation import stored_series

    parameters = draw_lengths(20, 0.05)
    all_in_c = linkage.simulate_many(parameters, 1.0, output=10, keep=MOTION)
    monkeypatch.setattr(stored_series, "MAX_MOTION_SERIES", 4)
    some_in_c = linkage.simulate_many(parameters, 1.0, output=10, keep=MOTION)
    for name in MOTION:
        assert all_in_c[name].tobytes() == some_in_c[name].tobytes()


def test_threads_and_order_change_nothing(linkage: Simulation) -> None:
    parameters = draw_lengths(70, 0.1)
    one = linkage.simulate_many(parameters, 1.0, output=20, threads=1)
    other = linkage.simulate_many(parameters[::-1], 1.0, output=20, threads=3)
    for name in STATES:
        assert getattr(one, name).tobytes() == getattr(other, name)[::-1].tobytes()


def test_runs_of_different_times(linkage: Simulation) -> None:
    times = [np.linspace(0.0, end, n) for end, n in ((0.5, 7), (1.0, 30), (0.2, 3), (0.9, 11))]
    batch = linkage.simulate_many({"w": [3.0, 4.0, 5.0, 6.0]}, output=times)
    for i, (t, w) in enumerate(zip(times, (3.0, 4.0, 5.0, 6.0), strict=True)):
        alone = linkage.simulate(output=t, parameters={"w": w})
        assert batch.q[i, : len(t)].tobytes() == alone.q.tobytes()
        assert np.isnan(batch.q[i, len(t) :]).all()


def test_regular_runs_are_not_checked_in_python(linkage: Simulation, monkeypatch: pytest.MonkeyPatch) -> None:
    from gudgeon.simulation import simulate_many

    def refuse(*_: object) -> None:
        raise AssertionError("a regular run was evaluated in Python")

    monkeypatch.setattr(simulate_many, "build_result", refuse)
    batch = linkage.simulate_many(draw_lengths(20, 0.05), 1.0, output=30, keep=["B.F"])
    assert not batch.failures
    with pytest.raises(AssertionError):
        linkage.simulate_many(draw_lengths(2, 0.05), 1.0, output=30, audit="full")


def test_errors_beyond_a_limit_of_the_audit_fail(linkage: Simulation, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a limit below rounding, C finds the runs, and Python builds the error of `simulate`."""
    from gudgeon.simulation import audit, suspect_runs

    tight = {check: 1e-22 for check in audit.LIMITS}
    for module in (audit, suspect_runs):
        monkeypatch.setattr(module, "LIMITS", tight)
    batch = linkage.simulate_many(draw_lengths(3, 0.05), 1.0, output=30)
    assert len(batch.failures) == 3
    with pytest.raises(SolverError) as caught:
        linkage.simulate(1.0, output=30, parameters=draw_lengths(3, 0.05)[0])
    assert str(caught.value) == str(batch.failures[0].error)


def test_notes_of_runs_at_change_points_and_steep_drives(tmp_path: Path) -> None:
    """Of a parallelogram, and of a drive t^1.5, whose second rate is unbounded at the start."""
    load = loader(tmp_path)
    flat = load(
        LINKAGE.replace("length: 0.15 m", "length: 0.4 m")
        .replace("length: 0.5 m", "length: 0.45 m")
        .replace("b.theta: 20 deg, c.theta: 80 deg", "b.theta: 0, c.theta: 20 deg")
    )
    w = [2 * np.pi, 4 * np.pi, 6.0]
    batch = flat.simulate_many({"w": w}, 1.0, output=36)
    notes = batch.result.notes()
    assert "change point" in notes[0][0]
    assert "change point" in notes[1][0]
    for i in range(3):
        alone = flat.simulate(1.0, output=36, parameters={"w": w[i]})
        assert batch.q[i].tobytes() == alone.q.tobytes()
        assert notes.get(i, ()) == alone.diagnostics.notes
    steep = load(LINKAGE.replace("20 deg + w*t", "20 deg + 1 rad * (t/(1 s))**power"))
    batch = steep.simulate_many({"power": [1.5, 2.0]}, 1.0, output=30)
    assert "unbounded" in batch.result.notes()[0][0]
    assert 1 not in batch.result.notes()


def test_ctrl_c_ends_all_runs_where_they_are(linkage: Simulation) -> None:
    """Runs that are over stay; others are interrupted, and no run of the rest begins."""
    calls = 0

    def stop(fraction: float, text: str) -> None:
        nonlocal calls
        calls += 1
        raise KeyboardInterrupt

    w = np.linspace(1.0, 2.0, 64)
    batch = linkage.simulate_many({"w": w}, 1.0, output=50_000, threads=2, progress=stop, keep=[])
    assert batch.interrupted
    assert calls == 1
    assert 0 < len(batch.failures) <= 64
    assert all("interrupted" in str(failure.error) for failure in batch.failures)


LANE_DRIVES = {
    "uniform": "20 deg + w*t",
    "piecewise": "20 deg + w * 0.5 s * smooth_step(t, 0.1 s, 0.7 s) + 0.2 rad * abs(sin(w*t))",
    "pulse": "20 deg + w*t + 0.3 rad * exp(-((t - 0.4 s)/(0.004 s))**2)",
}


@pytest.mark.parametrize("drive", LANE_DRIVES.values(), ids=LANE_DRIVES)
def test_lanes_give_the_bits_of_single_runs(drive: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Few samples halve steps; some runs fail at their start or on the way, and their lanes take other runs."""
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    linkage = loader(tmp_path)(LINKAGE.replace("20 deg + w*t", drive))
    assert linkage.source.lane_file
    parameters = draw_lengths(45, 0.4)
    for samples in (3, 50):
        alone = linkage.simulate_many(parameters, 1.0, output=samples, side_by_side=False)
        beside = linkage.simulate_many(parameters, 1.0, output=samples)
        assert 5 < len(alone.failures) < 40
        assert_equal_batches(alone, beside)


def test_lanes_pass_change_points(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Steps at change points are made by the runs, and the lanes go on from there, at times of their own."""
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    text = LINKAGE.replace("length: 0.15 m", "length: 0.4 m").replace("length: 0.5 m", "length: 0.45 m")
    linkage = loader(tmp_path)(text.replace("b.theta: 20 deg, c.theta: 80 deg", "b.theta: 0, c.theta: 20 deg"))
    times = [np.linspace(0.0, 1.0 + 0.1 * k, 37 + k) for k in range(20)]
    parameters = {"w": 2 * np.pi * np.linspace(1.0, 1.1, 20)}
    alone = linkage.simulate_many(parameters, output=times, side_by_side=False)
    beside = linkage.simulate_many(parameters, output=times)
    assert not alone.failures
    assert len(alone.result.notes()) > 0
    assert_equal_batches(alone, beside)


def assert_equal_batches(one: Batch, other: Batch) -> None:
    """Compare two batches bit for bit, with failures, notes and counts."""
    for name in (*STATES, "samples", "t_last"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    for name, values in one.diagnostics.items():
        assert name == "seconds" or values.tobytes() == other.diagnostics[name].tobytes(), name
    assert one.failures == other.failures
    assert one.result.notes() == other.result.notes()


@pytest.mark.parametrize("step", [-1.0, float("nan"), "abc"])
def test_a_step_that_is_not_positive_is_an_error_although_it_is_not_used(step: object) -> None:
    four_bar = gudgeon.load("four_bar")
    with pytest.raises(gudgeon.InputError, match="step"):
        four_bar.simulate(0.01, output=2, step=step)  # type: ignore[arg-type]


def test_a_long_single_run_is_left_to_the_loop_that_polls() -> None:
    """C ends a run without polls for Ctrl-C after a short time; the loop in Python has the same bits."""
    four_bar = gudgeon.load("four_bar")
    long, polls = four_bar.simulate(300.0, output=2), []
    observed = four_bar.simulate(300.0, output=2, progress=lambda fraction, stage: polls.append(fraction))
    assert polls and np.array_equal(long.q, observed.q) and np.array_equal(long.work, observed.work)


def test_a_forked_process_has_a_lock_of_its_own() -> None:
    """A thread of the parent may hold the lock of cached values at the fork."""
    with cached_values._LOCK:
        child = os.fork()
        if not child:
            os._exit(0 if cached_values._LOCK.acquire(timeout=1.0) else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0

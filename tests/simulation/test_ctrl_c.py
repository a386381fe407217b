"""Ctrl-C at any question that C asks: what is returned is what was reached, and equal to the whole run's.

C asks at every right-hand side here (EVERY = 0), and the signal is noted at one of them: inside steps, searches for
events, first right-hand sides, dense solves.
"""

from __future__ import annotations

import math
import os
import signal
import sys
import tempfile
import threading
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, InputError, SolverError
from gudgeon.integrators import lanes
from gudgeon.integrators.threads import POLL_INTERVAL_S
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.mechanisms.n_four_bar import text as n_four_bar
from gudgeon.model import evaluation
from gudgeon.results.results import Result
from gudgeon.simulation import result_builder
from gudgeon.simulation.simulation import Simulation
from gudgeon.waiting import cancellation
from gudgeon.waiting.ctrl_c import DelayedCtrlC
from gudgeon.waiting.programs import Programs
from tests.programs import needs_compiler
from tests.simulation.kept import check_kept
from tests.slow import slow_rows_but

pytestmark = needs_compiler
MECHANISMS = Path(gudgeon.__file__).resolve().parents[1] / "mechanisms"
RK4: dict[str, Any] = {"method": "rk4", "step": 2e-6}
EVENTS = "\nevents: {top: {zero: crank.theta - 100 deg, direction: both}, turn: {zero: crank.theta - 200 deg}}\n"


def signal_at(number: int) -> Callable[[float, str], None]:
    """A progress that gets SIGINT at its call `number`."""
    count = 0

    def progress(fraction: float, text: str) -> None:
        nonlocal count
        count += 1
        if count == number:
            signal.raise_signal(signal.SIGINT)

    return progress


@cache
def press(scene: str) -> Simulation:
    return gudgeon.load("nine_bar_press", scene=scene)


@cache
def four_bar(value: str = "90 deg + omega * t") -> Simulation:
    """With two events, and a motor of one's own."""
    folder = Path(tempfile.mkdtemp())
    given = (MECHANISMS / "four_bar.yaml").read_text(encoding="utf-8")
    file = folder / "four_bar.yaml"
    file.write_text(given.replace("90 deg + omega * t", value) + EVENTS, encoding="utf-8")
    return gudgeon.load(file)


@cache
def whole(name: str, method: str) -> Result:
    simulation, options = case(name, method)
    return simulation.simulate(**options)


def case(name: str, method: str) -> tuple[Simulation, dict[str, Any]]:
    if method.startswith("scipy"):
        return press(name), {"t_end": 3e-4, "output": 25, "method": method}
    if name == "four_bar":
        return four_bar(), {"t_end": 1.0, "output": 40}
    t_end, step = {"dry": (0.05, 5e-5), "lubricated": (0.004, 2e-5)}[name]
    fixed = {"step": step} if method == "rk4" else {}
    return press(name), {"t_end": t_end, "output": 25, "method": method, **fixed}


STRIDES = [
    ("dry", "auto", 661),
    ("dry", "dop853", 509),
    ("dry", "rk4", 397),
    ("lubricated", "auto", 83),
    ("lubricated", "rodas5p", 29),
    ("lubricated", "scipy:DOP853", 47),
    ("four_bar", "auto", 211),
]


RARE = [("dry", "dop853", 509), ("lubricated", "scipy:DOP853", 47)]
USUAL = [one for one in STRIDES if one not in RARE]
PLAIN = pytest.param("lubricated", "scipy:DOP853", 331, marks=pytest.mark.plain)


@pytest.mark.parametrize(("name", "method", "stride"), [*slow_rows_but(USUAL, STRIDES), PLAIN])
def test_what_is_kept_is_the_whole_run_s(name: str, method: str, stride: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cancellation, "POLL_INTERVAL_S", 0.0)
    simulation, options = case(name, method)
    number, cut = 1, 0
    while True:
        try:
            run = simulation.simulate(progress=signal_at(number), **options)
        except KeyboardInterrupt:  # nothing was reached yet
            assert number < 20
        else:
            if not run.diagnostics.interrupted:
                break
            check_kept(run, whole(name, method))
            cut += len(run.t) < len(whole(name, method).t)
        number += 1 if number < 4 else stride
    assert cut >= 3


@pytest.mark.parametrize(("name", "method"), [("lubricated", "dop853"), ("lubricated", "rodas5p"), ("dry", "rk4")])
def test_the_last_sample_is_a_state_to_go_on_from(name: str, method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The state when Ctrl-C came is that of the run at that time, and leads to the same end."""
    monkeypatch.setattr(cancellation, "POLL_INTERVAL_S", 0.0)
    simulation, options = case(name, method)
    options["t_end"] = 0.006 if name == "dry" else options["t_end"]
    run, t_end = simulation.simulate(progress=signal_at(200), **options), options.pop("t_end")
    assert run.diagnostics.interrupted and 0.0 < run.t[-1] < t_end
    assert [note for note in run.diagnostics.notes if note.startswith("interrupted")] != []
    del options["output"]
    there = simulation.simulate(output=[run.t[-1], t_end], **options)
    scale = np.abs(there.v[0]).max()
    np.testing.assert_allclose(run.v[-1], there.v[0], rtol=0.0, atol=1e-9 * scale)
    np.testing.assert_allclose(run.work[-1], there.work[0], rtol=1e-7, atol=1e-12)
    rest = simulation.simulate(t_end, start=run.final, **options)
    np.testing.assert_allclose(rest.v[-1], there.v[-1], rtol=0.0, atol=1e-4 * scale)
    np.testing.assert_allclose(rest.q[-1], there.q[-1], rtol=0.0, atol=1e-7)


@pytest.mark.parametrize(("name", "number"), [("dry", 700), ("four_bar", 250)])
def test_what_follows_from_the_samples_can_wait(name: str, number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """After Ctrl-C nothing is evaluated that takes long; asked for later it is the whole run's."""
    monkeypatch.setattr(cancellation, "POLL_INTERVAL_S", 0.0)
    monkeypatch.setattr(result_builder, "MAX_BALANCE_TIME_S", 0.0)
    simulation, options = case(name, "auto")
    run, complete = simulation.simulate(progress=signal_at(number), **options), whole(name, "auto")
    assert run.diagnostics.interrupted and math.isnan(run.diagnostics.energy_residual)
    assert not math.isnan(complete.diagnostics.energy_residual)
    check_kept(run, complete)
    kept = len(run.t) - 1
    assert kept >= 3 and "evaluation" not in run.__dict__
    np.testing.assert_array_equal(run.a[:kept], complete.a[:kept])
    series = "A.F" if name == "dry" else "crank.alpha"
    np.testing.assert_array_equal(run[series][:kept], complete[series][:kept])


@pytest.mark.parametrize("look", [1, 2, 4])
def test_ctrl_c_while_the_energy_is_balanced(look: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """All samples are there, and their accelerations are found when they are asked for."""
    monkeypatch.setattr(result_builder, "POLL_INTERVAL_S", -1.0)
    monkeypatch.setattr(evaluation, "FIRST_CHUNK_SAMPLES", 1)
    simulation, options = case("dry", "auto")
    looks = 0

    def progress(fraction: float, text: str) -> None:
        nonlocal looks
        looks += text == "balancing energy"
        if looks == look and text == "balancing energy":
            signal.raise_signal(signal.SIGINT)

    run, complete = simulation.simulate(progress=progress, **options), whole("dry", "auto")
    assert looks >= look and run.diagnostics.interrupted and len(run.t) == len(complete.t)
    check_kept(run, complete)
    np.testing.assert_array_equal(run.a, complete.a)


def test_ctrl_c_while_rows_left_out_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """A contradiction is told of an interrupted run too."""
    real = result_builder.find_constraint_violation
    calls: list[int] = []

    def contradiction(problem: Problem, trajectory: Trajectory) -> SolverError | None:
        if not calls:
            signal.raise_signal(signal.SIGINT)
        calls.append(trajectory.interrupted)
        problem.poll_cancellation()
        return real(problem, trajectory)

    monkeypatch.setattr(result_builder, "find_constraint_violation", contradiction)
    run = press("dry").simulate(0.01, output=5)
    assert calls == [False, True] and run.diagnostics.interrupted and len(run.t) == 6


def test_a_signal_that_waits_is_raised_only_where_it_is_asked_for() -> None:
    """Not between the call of C and the note of what it did."""
    heard = []
    before = signal.getsignal(signal.SIGINT)
    with DelayedCtrlC() as ctrl_c:
        signal.raise_signal(signal.SIGINT)
        heard.append("computed")
        with pytest.raises(KeyboardInterrupt):
            ctrl_c.raise_delayed()
        ctrl_c.raise_delayed()  # once only
    assert heard and signal.getsignal(signal.SIGINT) is before


def test_a_handler_of_somebody_else_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that raises nothing ends nothing."""
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: heard.append(number))
    try:
        run = press("dry").simulate(0.01, output=5, progress=signal_at(1))
    finally:
        signal.signal(signal.SIGINT, before)
    assert heard == [signal.SIGINT] and not run.diagnostics.interrupted and len(run.t) == 6


def test_in_another_thread_progress_ends_a_run() -> None:
    found: list[Result] = []

    def progress(fraction: float, text: str) -> None:
        if fraction > 0.2:
            raise KeyboardInterrupt

    def work() -> None:
        found.append(press("dry").simulate(3.0, output=5000, progress=progress))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert found[0].diagnostics.interrupted and 0.5 < found[0].t[-1] < 3.0


def test_ctrl_c_in_a_dense_solve(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """At its singular position, where each right-hand side takes the dense way: between its rows, the state unhurt."""
    monkeypatch.setattr(cancellation, "POLL_INTERVAL_S", 0.0)
    file = tmp_path / "bars.yaml"
    file.write_text(n_four_bar(1), encoding="utf-8")
    bars = gudgeon.load(file, formulation="full")
    complete, requested = bars.simulate(1.0, output=30, rtol=1e-12), []
    bars.simulate(1.0, output=30, rtol=1e-12, progress=lambda fraction, text: requested.append(fraction))
    assert len(requested) > complete.diagnostics.right_hand_sides + 20  # rows of dense systems asked too
    for number in range(40, len(requested), len(requested) // 6):
        check_kept(bars.simulate(1.0, output=30, rtol=1e-12, progress=signal_at(number)), complete)


@pytest.mark.parametrize("options", [{}, RK4, pytest.param(RK4 | {"side_by_side": False}, marks=pytest.mark.slow)])
def test_a_batch_keeps_of_each_run_what_it_reached(options: dict[str, Any]) -> None:
    sets = {"c": np.linspace(0.3e-3, 0.6e-3, 4)}
    dry, t_end = press("dry"), 1.0 if "step" in options else 60.0  # not over before it is interrupted
    batch = dry.simulate_many(sets, t_end, output=2000, threads=2, progress=signal_at(2), **options)
    assert batch.interrupted and batch.failures
    one = {name: value for name, value in options.items() if name != "side_by_side"}
    for failure in batch.failures:
        run = batch.partial(failure.run)
        if run is None:
            continue
        assert "interrupted" in str(failure.error) and batch.t_last[failure.run] == run.t[-1]
        parameters = {"c": float(sets["c"][failure.run])}
        check_kept(run, dry.simulate(t_end, output=2000, parameters=parameters, **one))


def test_what_a_batch_compiles_meanwhile_ends_with_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The compiler of runs side by side, in a thread of its own, is killed; what is over is kept."""
    press, begun = gudgeon.load("nine_bar_press", scene="dry"), list[Any]()

    def compiled(*_: Any) -> lanes.Lanes:
        with Programs() as programs:
            begun.append(programs.start([sys.executable, "-c", "import time; time.sleep(60)"], None, dict(os.environ)))
            programs.wait(begun[0])
        raise AssertionError("nobody had given it up")

    def progress(_: float, __: str) -> None:
        if begun:
            raise KeyboardInterrupt

    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 1e-9)
    monkeypatch.setattr(lanes, "_loaded_lanes", WeakKeyDictionary())
    monkeypatch.setattr(lanes, "_is_compiled", lambda *_: False)
    monkeypatch.setattr(lanes, "_load_lanes", compiled)
    batch = press.simulate_many({"c": np.full(40, 3e-4)}, 0.01, output=2, rtol=1e-4, threads=1, progress=progress)
    assert batch.interrupted and begun[0].returncode == -signal.SIGKILL
    assert 0 < (batch.samples == 3).sum() < 40


@pytest.mark.slow
def test_a_run_that_no_longer_advances_ends(tmp_path: Path) -> None:
    """The printed sign of the film's force jumps where the journal turns back: steps get stuck there."""
    given = (MECHANISMS / "nine_bar_press.yaml").read_text(encoding="utf-8")
    file = tmp_path / "printed.yaml"
    file.write_text(given.replace("viscosity: 100 cP}", "viscosity: 100 cP, as_printed: true}"), encoding="utf-8")
    message = r"no longer advances at t = 0\.212(.|\n)*changes its form \(a switching point of a law\)(.|\n)*is stored"
    with pytest.raises(SolverError, match=message) as caught:
        gudgeon.load(file, "lubricated").simulate(0.5, output=500, parameters={"c": "0.6 mm", "omega": 3 * math.pi})
    run = caught.value.partial
    assert isinstance(run, Result) and 0.21 < run.t[-1] < 0.213 and len(run.t) == 214


OUTRUN = [
    ("1 rad/(t/(1 s) - 0.5)", 0.499, 0.5),
    ("1 rad * exp(exp(exp(t/(0.3 s))))", 0.2, 0.6),
    ("1 rad * tan(3*t/(1 s))", 0.52, 0.53),
]


@pytest.mark.parametrize(("value", "least", "most"), slow_rows_but(OUTRUN[:1], OUTRUN))
def test_a_drive_that_cannot_be_followed(value: str, least: float, most: float) -> None:
    """A pole through which the rate comes back is a jump: it is told where it is, as of what its form does not show."""
    message = r"no longer advances at t = (.|\n)*drive motor is at .* rad, its rate|drive motor: it jumps by .* at t = "
    with pytest.raises(SolverError, match=message) as caught:
        four_bar(value).simulate(1.0, output=20)
    t = float(str(caught.value).split("t = ")[1].split(" s")[0])
    run = caught.value.partial
    assert least < t < most and isinstance(run, Result) and t - 0.05 <= run.t[-1] <= t


@pytest.mark.parametrize("t_end", [5e-324, 1e-310, "5e-324 s", 1e300])
def test_an_end_that_is_none(t_end: float | str) -> None:
    for simulation in (press("dry"), four_bar()):
        with pytest.raises(InputError, match="expected"):
            simulation.simulate(t_end)


def test_an_end_within_the_rounding_of_the_start() -> None:
    final = press("dry").simulate(0.01, output=1).final
    with pytest.raises(BadValueError, match="are equal after rounding"):
        press("dry").simulate(float(np.nextafter(0.01, 1.0)), start=final)
    with pytest.raises(BadValueError, match="are equal after rounding"):
        press("dry").simulate(output=[0.01, float(np.nextafter(0.01, 1.0))], start=final)


@pytest.mark.parametrize("simulation", ["dry", "ideal", "pendulum"])
def test_an_end_that_nobody_lives_to_see(simulation: str) -> None:
    """1e11 s: the steps that it takes are told, not why a step is too short."""
    scene = gudgeon.load("pendulum") if simulation == "pendulum" else press(simulation)
    with pytest.raises(SolverError, match=r"at the pace of its last 32768 steps .* e?.*take .*e\+1[1-9] more"):
        scene.simulate(1e11, output=10)


def test_glances_are_short() -> None:
    """Ctrl-C is answered within half a second: these are the longest waits that are built in."""
    assert max(cancellation.POLL_INTERVAL_S, POLL_INTERVAL_S) <= 0.1

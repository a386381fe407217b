"""Threads of the caller's: no lock is held while a run is in C, neither Python's nor one of ours."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.waiting import cancellation
from tests.programs import needs_compiler

pytestmark = needs_compiler
Calls = list[tuple[str, int]]


@contextmanager
def other_thread() -> Iterator[list[int]]:
    """A counter that another thread moves on whenever it may: Python's lock is handed over of free will alone."""
    count, over, usual = [0], threading.Event(), sys.getswitchinterval()

    def go_on() -> None:
        while not over.is_set():
            count[0] += 1
            time.sleep(0)  # hands the lock over

    thread = threading.Thread(target=go_on)
    sys.setswitchinterval(1e3)
    thread.start()
    try:
        yield count
    finally:
        sys.setswitchinterval(usual)
        over.set()
        thread.join()


class Watched:
    """A library whose calls are noted, each with how far the other thread came meanwhile."""

    def __init__(self, lib: Any, count: list[int], calls: Calls) -> None:
        self.lib, self.count, self.calls = lib, count, calls

    def __getattr__(self, name: str) -> Any:
        found = getattr(self.lib, name)
        return self._noted(name, found) if name.startswith("gudgeon_") and callable(found) else found

    def _noted(self, name: str, function: Callable[..., Any]) -> Any:
        def call(*arguments: Any) -> Any:
            before = self.count[0]
            try:
                return function(*arguments)
            finally:
                self.calls.append((name, self.count[0] - before))

        return call


def simulate(options: dict[str, Any], output: int = 200) -> Callable[[Simulation], object]:
    return lambda simulation: simulation.simulate(0.05, output=output, **options)


def many(options: dict[str, Any], n_runs: int = 4) -> Callable[[Simulation], object]:
    def work(simulation: Simulation) -> object:
        slot = next(slot for slot in simulation.source.parameters if slot.default)
        columns = {slot.address: slot.default * np.linspace(1.0, 1.1, n_runs)}
        return simulation.simulate_many(columns, 0.05, output=200, threads=1, **options)["energy.kinetic"]

    return work


CASES = [
    ("dry", simulate({"method": "rk4", "step": 2e-6}), "gudgeon_ensemble"),
    ("dry", simulate({"method": "dop853", "rtol": 1e-9}), "gudgeon_ensemble"),
    ("ideal", simulate({}, 1900), "gudgeon_kinematic"),
    ("ideal", many({}, 400), "gudgeon_kinematic_ensemble"),
    ("dry", simulate({}), "gudgeon_check_samples"),
    ("dry", simulate({}, 400), "gudgeon_evaluate"),
    ("dry", many({"rtol": 1e-9}), "gudgeon_ensemble"),
    ("dry", many({"rtol": 1e-9}), "gudgeon_evaluate"),
    ("dry", many({"rtol": 1e-9, "keep": ["S9.ay", "energy.kinetic"]}), "gudgeon_evaluate"),
]


@pytest.mark.parametrize(("scene", "work", "function"), CASES)
def test_python_goes_on_while_a_run_is_in_c(
    scene: str, work: Callable[[Simulation], object], function: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    simulation, calls = gudgeon.load("nine_bar_press", scene), Calls()
    with other_thread() as count:
        lib = simulation.compiled.lib
        monkeypatch.setitem(simulation.compiled.__dict__, "lib", Watched(lib, count, calls))
        end = time.monotonic() + 60.0
        while time.monotonic() < end:  # a call may be over before the other thread is awake
            work(simulation)
            if any(moved for name, moved in calls if name == function):
                break
    assert any(moved for name, moved in calls if name == function)


@pytest.mark.parametrize("options", [{"method": "rk4", "step": 2e-6}, {"rtol": 1e-8}])
def test_two_runs_are_in_c_at_once(options: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Each waits, asked from within its loop, until the other one is asked from within its own."""
    both, waited = threading.Barrier(2, timeout=60.0), threading.local()
    plain = cancellation.CancellationPoll.poll_from_c

    def answer(self: cancellation.CancellationPoll) -> int:
        if not getattr(waited, "once", False):
            waited.once = True
            both.wait()
        return plain(self)

    press = gudgeon.load("nine_bar_press", "dry")
    alone = [press.simulate(0.02, output=20, parameters={"c": c}, **options) for c in (4e-4, 5e-4)]
    press.compiled.unused_runs.clear()  # reused runs poll at the interval at which they were created
    monkeypatch.setattr(cancellation, "POLL_INTERVAL_S", 0.0)
    monkeypatch.setattr(cancellation.CancellationPoll, "poll_from_c", answer)

    def one(c: float) -> Result:
        return press.simulate(0.02, output=20, parameters={"c": c}, **options)

    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(one, (4e-4, 5e-4)))
    assert not both.broken
    for run, other in zip(together, alone, strict=True):
        assert run.q.tobytes() == other.q.tobytes() and run.impacts.tobytes() == other.impacts.tobytes()

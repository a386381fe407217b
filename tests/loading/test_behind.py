"""A first start runs with a library that was compiled quickly; the optimized one comes from behind, bit for bit."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.integrators import batch as many
from gudgeon.loading import build, optimized_library
from gudgeon.loading.build import compile_kernels
from gudgeon.loading.cache import Cache, get_private_cache
from gudgeon.loading.optimized_library import OptimizedLibrary, may_compile_in_background
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation

pytestmark = pytest.mark.optimized  # two libraries of one scene, by their flags

ROD = """\
format: gudgeon/1
name: rod
gravity: [0, -9.81]
bodies: {rod: {length: 0.3, mass: 1, inertia: 0.01}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, rod.tail]}}
start: {set: {rod.theta: 0.3}}
"""
FAILS = "raise SystemExit(1)"


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Cache:
    """An empty one; nothing is loaded yet."""
    monkeypatch.setattr(build, "_libraries", {})
    monkeypatch.setattr(optimized_library, "_started_processes", [])
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("GUDGEON_QUICK", "1")
    return Cache(tmp_path / "cache")


@pytest.fixture
def nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    """No other process: what it makes is still to come."""
    monkeypatch.setattr(OptimizedLibrary, "start_process", lambda *given: True)


def loaded(file: Path | str = "pendulum", quick: bool = True) -> Simulation:
    """As a new process loads it."""
    build._libraries.clear()
    return gudgeon.load(file, quick=quick)


def made(cache: Cache, kind: str) -> int:
    folder = cache.root / kind
    return len(list(folder.iterdir())) if folder.exists() else 0


def libraries(simulation: Simulation) -> int:
    """How many have been called."""
    return len(simulation.compiled.lib._libraries)


def same(a: Result, b: Result) -> bool:
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in ("t", "q", "v", "work"))


@pytest.mark.usefixtures("nobody")
@pytest.mark.parametrize("method", ["rodas5p", pytest.param("rk4", marks=pytest.mark.slow)])
def test_a_run_goes_on_with_the_optimized_library(cache: Cache, method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(many, "MAX_STEPS_PER_CALL", 7)
    step = {"step": 1e-2} if method == "rk4" else {}
    simulation, called = loaded(), list[int]()

    def progress(share: float, doing: str) -> None:
        if share > 0.3 and not made(cache, "libraries"):
            build._libraries.clear()
            compile_kernels(simulation.source)
        called.append(libraries(simulation))

    def run(**more: object) -> Result:
        return simulation.simulate(2.0, output=50, method=method, **step, **more)  # type: ignore[arg-type]

    before = run()
    during = run(progress=progress)
    assert called[0] == 1 and called[-1] == 2
    assert same(before, during) and same(before, run())
    first = simulation.source.parameters[0]
    batch = simulation.simulate_many({first.address: [first.default]}, 2.0, output=50, method=method, **step)  # type: ignore[arg-type]
    assert np.array_equal(batch.q[0], before.q)


def test_the_other_process_makes_it(cache: Cache) -> None:
    """Of a file that is derived, whose parts are compiled meanwhile."""
    file = cache.root.parent / "rod.yaml"
    file.write_text(ROD)
    simulation = loaded(file)
    before = simulation.simulate(0.5, output=5)
    simulation.compiled.lib.wait_for_optimized_library()
    assert (made(cache, "quick"), made(cache, "libraries"), libraries(simulation)) == (1, 1, 2)
    again = loaded(file)
    assert libraries(again) == 1 and again.compiled.lib._pending_library is None
    assert same(before, simulation.simulate(0.5, output=5)) and same(before, again.simulate(0.5, output=5))


@pytest.mark.slow
def test_where_the_other_process_is_killed_it_is_made_here(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    simulation = loaded()
    other = simulation.compiled.lib._pending_library
    assert isinstance(other, OptimizedLibrary) and other._process is not None
    monkeypatch.setattr(optimized_library, "MAX_PROCESSES", 1)
    assert not may_compile_in_background(cache)  # a second one at the same time
    os.killpg(other._process.pid, signal.SIGKILL)
    simulation.compiled.lib.wait_for_optimized_library()
    assert libraries(simulation) == 2 and simulation.simulate(0.1, output=2)


def test_where_the_other_process_fails_the_next_start_makes_it(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(optimized_library, "PROGRAM", FAILS)
    simulation = loaded()
    other = simulation.compiled.lib._pending_library
    assert isinstance(other, OptimizedLibrary) and other._process is not None and other._process.wait() == 1
    before = simulation.simulate(0.5, output=5)
    assert simulation.compiled.lib._pending_library is None and (libraries(simulation), made(cache, "libraries")) == (
        1,
        0,
    )
    again = loaded()
    assert (libraries(again), made(cache, "libraries")) == (1, 1) and same(before, again.simulate(0.5, output=5))


@pytest.mark.usefixtures("nobody")
def test_who_asks_for_the_optimized_one_waits_for_it(cache: Cache) -> None:
    simulation = loaded()
    assert (libraries(simulation), made(cache, "libraries")) == (1, 0)
    gudgeon.load("pendulum", quick=False)
    assert (libraries(simulation), made(cache, "libraries")) == (2, 1)


def test_the_switch_waits_for_the_optimized_one(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GUDGEON_QUICK", "0")
    assert (libraries(loaded()), made(cache, "quick"), made(cache, "libraries")) == (1, 0, 1)


def test_a_process_is_left_behind_only_where_what_it_makes_is_kept(
    cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nor by a program that has Python inside, which would begin anew. Root may write everywhere: access() is asked."""
    access = os.access
    assert may_compile_in_background(cache) and not may_compile_in_background(get_private_cache())
    with monkeypatch.context() as now:
        now.setattr(os, "access", lambda path, mode: mode != os.W_OK and access(path, mode))
        assert not may_compile_in_background(cache)
    with monkeypatch.context() as now:
        now.setattr(sys, "executable", "/usr/bin/program")
        assert not may_compile_in_background(cache)
    with monkeypatch.context() as now:
        now.setattr(sys, "frozen", True, raising=False)
        assert not may_compile_in_background(cache)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_fork_waits_for_no_thread_that_it_has_not(tmp_path: Path) -> None:
    """A thread of the parent was compiling: its lock, held by nobody there, held the child for good."""
    behind = OptimizedLibrary(Cache(tmp_path), "key", lambda _: None, lambda _: None)  # type: ignore[arg-type, return-value]
    with behind._get_lock():
        child = os.fork()
        if child == 0:
            os._exit(0 if behind._get_lock().acquire(timeout=20.0) else 1)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0

"""Integrate pendulums of 2, 6 and 64 links (chain_equations.py) by heyoka, jitcode and gudgeon; the motion is smooth.

heyoka and jitcode get the accelerations as expressions. In a batch the first link of each run has another initial
angle.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import replace
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers import heyoka_runs, own_scenes
from benchmarks.peers.andrews import Steps
from benchmarks.peers.chain_equations import RECURSIVE, T_END, G, J, L, M, equations, error, reference, starts
from benchmarks.peers.timing import CallTimer, Measured
from gudgeon.integrators.lanes import announce_later_runs
from gudgeon.results.state import State

RUNS = 64  # of a batch
ATOL = 1e-2  # of rtol


@cache
def heyoka_of(n: int, runs: int, tolerance: float) -> Any:
    """Return heyoka's compiled integrator for a number of runs."""
    hy = import_module(heyoka_runs.NAME)
    y = heyoka_runs.variables(*(f"{kind}{k}" for kind in ("theta", "omega") for k in range(n)))
    rates = [*y[n:], *equations(y[:n], y[n:], hy.sin, hy.cos)]
    start = starts(n, runs)
    compact = n >= RECURSIVE  # otherwise LLVM takes minutes
    return heyoka_runs.integrator(y, rates, start if runs > 1 else start[:, 0], tolerance, compact)


def heyoka(n: int, tolerance: float) -> Measured:
    """Run heyoka's Taylor method once."""
    run, start = heyoka_of(n, 1, tolerance), starts(n)[:, 0]
    timer = CallTimer()
    state = heyoka_runs.propagate(run, start, T_END[n], timer)
    return timer.measured(lambda: error(n, state[:n]))


def heyoka_batch(n: int, tolerance: float) -> Measured:
    """Run RUNS pendulums by heyoka in its recommended SIMD width; the time is that of a run."""
    width, start = heyoka_runs.beside(), starts(n, RUNS)
    run = heyoka_of(n, width, tolerance)
    timer = CallTimer()
    parts = [heyoka_runs.propagate(run, start[:, k : k + width], T_END[n], timer)[:n] for k in range(0, RUNS, width)]
    angles = np.hstack(parts)
    return timer.measured(lambda: float(np.abs(angles - reference(n, RUNS)).max())).per(RUNS)


@cache
def jitcode_of(n: int) -> Any:
    """Return jitcode's object with compiled C."""
    sys.setrecursionlimit(max(sys.getrecursionlimit(), 100 * n * n))  # of SymEngine's searches through long expressions
    jit, symengine, step = import_module("jitcode"), import_module("symengine"), Steps()
    y = [jit.y(i) for i in range(2 * n)]
    rates = [*y[n:], *equations(y[:n], y[n:], symengine.sin, symengine.cos, step)]
    ode = jit.jitcode(rates, helpers=step.all, verbose=False)
    ode.compile_C(extra_compile_args=["-O3", "-march=native", "-w"])
    return ode


def by_jitcode(n: int, rtol: float) -> Measured:
    """Integrate by jitcode's "dop853", SciPy's compiled code."""
    ode, start = jitcode_of(n), starts(n)[:, 0]
    timer = CallTimer()
    ode.set_integrator("dop853", rtol=rtol, atol=ATOL * rtol, nsteps=10**6)
    ode.set_initial_value(start, 0.0)
    with timer.engine:
        y = ode.integrate(T_END[n])
    return timer.measured(lambda: error(n, y[:n]))


def written(n: int, start: tuple[float, ...]) -> str:
    """Return the pendulum as a mechanism file of gudgeon, at rest at the angles `start`."""
    names = [f"L{k}" for k in range(n)]
    joints = ["ground.O", *(f"{name}.head" for name in names)]
    angles = ", ".join(f"{name}.theta: {value!r}" for name, value in zip(names, start, strict=True))
    rates = ", ".join(f"{name}.omega: 0" for name in names)
    return "\n".join(
        [
            "format: gudgeon/1",
            f"name: links_{n}",
            f"gravity: [0, -{G} m/s^2]",
            "bodies:",
            *(f"  {name}: {{length: {L} m, mass: {M} kg, inertia: {J} kg*m^2}}" for name in names),
            "ground: {O: [0, 0]}",
            "joints:",
            *(f"  J{k}: {{revolute: [{joints[k]}, {name}.tail]}}" for k, name in enumerate(names)),
            "start:",
            f"  set: {{{angles}}}",
            f"  rates: {{{rates}}}",
            "",
        ]
    )


@cache
def loaded(n: int, taylor: bool, start: tuple[float, ...] = ()) -> Any:
    """Return the compiled simulation, at rest at the angles `start`; Taylor series need functions of their own."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "links.yaml")
        file.write_text(written(n, start or tuple(starts(n)[:n, 0].tolist())), encoding="utf-8")
        return own_scenes.load(file).of_method("taylor" if taylor else "dop853")


def own(n: int, method: str, rtol: float) -> Measured:
    """Run gudgeon once."""
    simulation = loaded(n, method == "taylor")
    timer = CallTimer()
    run = simulation.simulate(T_END[n], output=1, method=method, rtol=rtol)
    angles = run.q[-1][2::3]
    timer.stop()
    found = run.diagnostics
    return timer.measured(lambda: error(n, angles), found.right_hand_sides, found.seconds)


@cache
def states(n: int) -> list[State]:
    """Return the initial states of a batch: centres and angles of the links, at rest."""
    final = loaded(n, True).simulate(T_END[n], output=1, method="taylor").final
    angles = starts(n, RUNS)[:n]
    joints = L * np.cumsum([np.cos(angles), np.sin(angles)], axis=1)
    middles = joints - 0.5 * L * np.array([np.cos(angles), np.sin(angles)])
    q = np.stack([*middles, angles], axis=1).reshape(3 * n, RUNS)
    return [replace(final, t=0.0, q=column, v=np.zeros(3 * n)) for column in q.T]


def own_batch(n: int, method: str, rtol: float) -> Measured:
    """Run gudgeon's batch in SIMD lanes in one thread; the time is that of a run."""
    with announce_later_runs(10**9):  # its library is worth being compiled
        start, timer = states(n), CallTimer()
        batch = loaded(n, method == "taylor").simulate_many(
            {}, T_END[n], start=start, output=1, method=method, rtol=rtol, threads=1
        )
        angles = batch.q[:, -1, 2::3].T
        timer.stop()
        found = batch.diagnostics
    cost = timer.measured(
        lambda: float(np.abs(angles - reference(n, RUNS)).max()),
        round(float(found["right_hand_sides"].mean())),
        float(found["seconds"].sum()),
    )
    return cost.per(RUNS)

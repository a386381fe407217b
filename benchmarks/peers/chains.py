"""Integrate pendulums of two and of six links by heyoka and by gudgeon; the motion is smooth.

Links of length l, mass m and moment of inertia J about their middles hang from each other, theta from the x axis:

    sum_j c_ij cos(theta_i - theta_j) theta_j'' + c_ij sin(theta_i - theta_j) theta_j'^2 = -g w_i cos theta_i,

c_ij = m l^2 (n - max(i, j) - 1/2) for i != j, c_ii = J + m l^2 (n - i - 3/4), w_i = m l (n - i - 1/2), i = 0 ... n - 1.
heyoka gets the accelerations by L D L^T of that matrix as its expressions. In a batch the first link of each run has
another initial angle. Error: the largest error of an angle at the end, over all runs. Reference: Gragg's midpoint rule
extrapolated to order 16, in long double. With another number of steps it agrees to 1e-15
(`python -m benchmarks.peers.chains`).
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterable
from dataclasses import replace
from functools import cache, reduce
from importlib import import_module
from operator import add
from pathlib import Path
from typing import Any

import numpy as np

import gudgeon
from benchmarks.peers import heyoka_runs
from gudgeon.integrators.lanes import announce_later_runs
from gudgeon.results.state import State

LINKS = {"double pendulum": 2, "six links": 6}
T_END = {2: 3.0, 6: 1.5}
M, L, J, G = 1.0, 1.0, 0.1, 9.81
STEPS = 200  # of the reference
RUNS, SPREAD = 64, 1e-3  # of a batch; rad
Measured = tuple[float, float, int]  # error, seconds of integration only, right-hand sides (-1: unknown)


def starts(n: int, runs: int = 1) -> np.ndarray:
    """Return initial angles, then velocities (2n, runs)."""
    y = np.repeat([[0.5 * k] for k in range(n)] + [[0.0]] * n, runs, axis=1)
    y[0] += SPREAD * np.arange(runs)
    return y


def coefficients(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return c (n, n) and w (n,)."""
    i = np.arange(n)
    c = M * L**2 * (n - np.maximum.outer(i, i) - 0.5)
    np.fill_diagonal(c, J + M * L**2 * (n - i - 0.75))
    return c, M * L * (n - i - 0.5)


def accelerations(theta: Any, omega: Any, sin: Any, cos: Any) -> list[Any]:
    """Return the accelerations by L D L^T of the matrix, for numbers or expressions."""
    n = len(theta)
    c, w = (some.tolist() for some in coefficients(n))
    x = [-G * w[i] * cos(theta[i]) for i in range(n)]
    for i in range(n):
        for j in range(n):
            if i != j:
                x[i] = x[i] - c[i][j] * sin(theta[i] - theta[j]) * (omega[j] * omega[j])
    low: dict[tuple[int, int], Any] = {}
    own: list[Any] = []
    for i in range(n):
        row: list[Any] = []
        for j in range(i):
            row.append(c[i][j] * cos(theta[i] - theta[j]) - sum_of(row[k] * low[j, k] for k in range(j)))
            low[i, j] = row[j] / own[j]
        own.append(c[i][i] - sum_of(row[k] * low[i, k] for k in range(i)))
        x[i] = x[i] - sum_of(low[i, k] * x[k] for k in range(i))
    for i in reversed(range(n)):
        x[i] = x[i] / own[i] - sum_of(low[k, i] * x[k] for k in range(i + 1, n))
    return x


def sum_of(terms: Iterable[Any]) -> Any:
    """Return the sum of terms; 0.0 without terms."""
    return reduce(add, terms) if (terms := list(terms)) else 0.0


@cache
def reference(n: int, runs: int = 1, steps: int = STEPS) -> np.ndarray:
    """Return the angles at the end (n, runs)."""
    y = starts(n, runs).astype(np.longdouble)
    h = np.longdouble(T_END[n]) / steps

    def rate(y: np.ndarray) -> np.ndarray:
        """Return y'."""
        return np.array([*y[n:], *accelerations(y[:n], y[n:], np.sin, np.cos)], dtype=np.longdouble)

    for _ in range(steps):
        rows: list[list[np.ndarray]] = []
        for count in range(2, 17, 2):
            before, now, part = y, y + h / count * rate(y), h / count
            for _ in range(count - 1):
                before, now = now, before + 2 * part * rate(now)
            row = [(before + now + part * rate(now)) / 2]
            for k, last in enumerate(rows[-1] if rows else [], 1):
                row.append(row[-1] + (row[-1] - last) / ((count / np.longdouble(count - 2 * k)) ** 2 - 1))
            rows.append(row)
        y = rows[-1][-1]
    return y[:n].astype(float)


@cache
def heyoka_of(n: int, runs: int, tolerance: float) -> Any:
    """Return heyoka's compiled integrator for a number of runs."""
    hy = import_module(heyoka_runs.NAME)
    y = heyoka_runs.variables(*(f"{kind}{k}" for kind in ("theta", "omega") for k in range(n)))
    rates = [*y[n:], *accelerations(y[:n], y[n:], hy.sin, hy.cos)]
    start = starts(n, runs)
    return heyoka_runs.integrator(y, rates, start if runs > 1 else start[:, 0], tolerance)


def heyoka(n: int, tolerance: float) -> Measured:
    """Run heyoka's Taylor method once."""
    run = heyoka_of(n, 1, tolerance)
    seconds = heyoka_runs.timed(run, starts(n)[:, 0], T_END[n])
    return float(np.abs(run.state[:n] - reference(n)[:, 0]).max()), seconds, -1


def heyoka_batch(n: int, tolerance: float) -> Measured:
    """Run RUNS pendulums by heyoka in its recommended SIMD width; the time is that of a run."""
    width = heyoka_runs.beside()
    run, seconds, error = heyoka_of(n, width, tolerance), 0.0, 0.0
    for k in range(0, RUNS, width):
        seconds += heyoka_runs.timed(run, starts(n, RUNS)[:, k : k + width], T_END[n])
        error = max(error, float(np.abs(run.state[:n] - reference(n, RUNS)[:, k : k + width]).max()))
    return error, seconds / RUNS, -1


def written(n: int) -> str:
    """Return the pendulum as a mechanism file of gudgeon."""
    names = [f"L{k}" for k in range(n)]
    joints = ["ground.O", *(f"{name}.head" for name in names)]
    angles = ", ".join(f"{name}.theta: {value!r}" for name, value in zip(names, starts(n)[:n, 0].tolist(), strict=True))
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
def loaded(n: int) -> Any:
    """Return the compiled simulations by method."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "links.yaml")
        file.write_text(written(n), encoding="utf-8")
        simulation = gudgeon.load(file, quick=False)
        return {name: simulation.of_method(name) for name in ("dop853", "taylor")}


def own(n: int, method: str, rtol: float) -> Measured:
    """Run gudgeon once."""
    simulation = loaded(n)["taylor" if method == "taylor" else "dop853"]
    run = simulation.simulate(T_END[n], output=1, method=method, rtol=rtol)
    error = float(np.abs(run.q[-1][2::3] - reference(n)[:, 0]).max())
    return error, run.diagnostics.seconds, run.diagnostics.right_hand_sides


@cache
def states(n: int) -> list[State]:
    """Return the initial states of a batch: centres and angles of the links, at rest."""
    final = loaded(n)["taylor"].simulate(T_END[n], output=1, method="taylor").final
    angles = starts(n, RUNS)[:n]
    joints = L * np.cumsum([np.cos(angles), np.sin(angles)], axis=1)
    middles = joints - 0.5 * L * np.array([np.cos(angles), np.sin(angles)])
    q = np.stack([*middles, angles], axis=1).reshape(3 * n, RUNS)
    return [replace(final, t=0.0, q=column, v=np.zeros(3 * n)) for column in q.T]


def own_batch(n: int, method: str, rtol: float) -> Measured:
    """Run gudgeon's batch in SIMD lanes in one thread; the time is that of a run."""
    with announce_later_runs(10**9):  # its library is worth being compiled
        batch = loaded(n)["taylor" if method == "taylor" else "dop853"].simulate_many(
            {}, T_END[n], start=states(n), output=1, method=method, rtol=rtol, threads=1
        )
    error = float(np.abs(batch.q[:, -1, 2::3].T - reference(n, RUNS)).max())
    found = batch.diagnostics
    return error, float(found["seconds"].mean()), round(float(found["right_hand_sides"].mean()))


def main() -> None:
    """Print the difference of the reference from that with more steps."""
    for name, n in LINKS.items():
        print(f"{name}: {np.abs(reference(n) - reference(n, steps=STEPS * 3 // 2)).max():.1e}")


if __name__ == "__main__":
    main()

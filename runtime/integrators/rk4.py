"""Classical Runge–Kutta of order 4 with fixed step: the loop is in C (templates/c/rk4.c.jinja).

Python is called once a chunk of steps: it moves the progress bar, fetches impacts and samples, and
sees Ctrl-C. Constraints are stabilised by Baumgarte's terms (physics.md, section 1).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gudgeon.compiled import N_WORK
from gudgeon.errors import NonFiniteError, SingularError, SolverError
from gudgeon.integrators.trajectory import Counts, Problem, Trajectory

NAME, ORDER, SOURCE = "rk4", 4, "W. Kutta, Z. Math. Phys. 46 (1901) 435-453"

CHUNK = 20_000  # steps between two looks of Python: some 50 ms
NOT_FINITE, EVENTS_FULL, CHATTERING = -2, -3, -4
N_EVENTS = 256


def run(problem: Problem) -> Trajectory:
    """Integrate over the output times; each interval is divided evenly into steps ≤ problem.step."""
    session = _Session(problem)
    interrupted, stopped = False, None
    session.sample(0)
    try:
        for i in range(1, len(problem.t)):
            session.advance(i)
            session.sample(i)
            if problem.progress:
                problem.progress(i / (len(problem.t) - 1), "integrating")
    except KeyboardInterrupt:
        interrupted = True
    except SolverError as error:
        stopped = error
    return session.trajectory(interrupted, stopped)


class _Session:
    """The C struct of one run and the arrays that its samples go to."""

    def __init__(self, problem: Problem) -> None:
        from gudgeon.results import IMPACT_DTYPE

        self.problem, self.compiled = problem, problem.compiled
        self.lib, self.pointer = self.compiled.lib, self.compiled.pointer
        n, nc, N = self.compiled.n, len(self.compiled.source.clearances), len(problem.t)
        self.n, self.nc, self.done = n, nc, 0
        self.y, self.a = np.zeros((N, 2 * n + N_WORK)), np.zeros((N, n))
        self.memory, self.state = np.full((N, self.compiled.n_memory), np.nan), np.zeros((N, nc), dtype=np.int8)
        self.impacts = [np.zeros(0, dtype=IMPACT_DTYPE)]
        self.run = np.zeros(self.lib.gudgeon_run_size(), dtype=np.uint8)
        start = np.concatenate([problem.q, problem.v, np.zeros(N_WORK)])
        latched = self.compiled.memory_array(problem.memory if self.compiled.n_memory else None)
        self.lib.gudgeon_run_start(self._run, problem.t[0], self.pointer(start), self.pointer(latched))
        if problem.state is not None and nc:
            codes = np.ascontiguousarray(problem.state, dtype=np.int8)
            self.lib.gudgeon_run_codes(self._run, self.pointer(codes, "signed char *"))
        self._steps(float(problem.t[0]), float(problem.t[0]), 1, 0, 0)  # the first right-hand side

    @property
    def _run(self) -> Any:
        return self.pointer(self.run, "void *")

    def advance(self, i: int) -> None:
        """From output time i − 1 to i."""
        t0, t1 = (float(t) for t in self.problem.t[i - 1 : i + 1])
        total = max(1, math.ceil((t1 - t0) / self.problem.step * (1.0 - 1e-12)))
        first = 0
        while first < total:
            first += self._steps(t0, t1, total, first, min(CHUNK, total - first))
            if total > CHUNK and self.problem.progress:
                done = (i - 1 + first / total) / (len(self.problem.t) - 1)
                self.problem.progress(done, "integrating")

    def _steps(self, t0: float, t1: float, total: int, first: int, count: int) -> int:
        """Up to `count` steps in C; the number that was made. Raises SolverError."""
        taken = self.compiled.ffi.new("long *")
        p = self.pointer(self.problem.p)
        status = self.lib.gudgeon_run_steps(self._run, p, t0, t1, total, first, count, taken)
        if status == EVENTS_FULL:
            self._fetch_impacts(last=False)
        elif status:
            self._raise(status, t0 + (first + taken[0]) * (t1 - t0) / total)
        return int(taken[0])

    def _raise(self, status: int, t: float) -> None:
        if status == NOT_FINITE:
            raise NonFiniteError(
                f"the motion is no longer finite at t = {t:.9g} s\n"
                f"  the step {self.problem.step:.3g} s is too long for this scene: take a smaller one",
                t,
            )
        if status == CHATTERING:
            raise SolverError(f"friction changes between stick and slip without end near t = {t:.9g} s", t)
        try:
            self.compiled.check_pivot(status, t)
        except SingularError as error:
            y = np.zeros(2 * self.n + N_WORK)
            a, latched = np.zeros(self.n), self.compiled.memory_array(None)
            state = np.zeros(max(self.nc, 1), dtype=np.int8)
            self.lib.gudgeon_run_sample(
                self._run, self.pointer(y), self.pointer(a), self.pointer(latched), self.pointer(state, "signed char *")
            )
            if np.isfinite(y).all() and np.abs(y).max() < 1e12:
                raise
            raise NonFiniteError(
                f"the motion diverged before t = {t:.9g} s (constraint row {error.pivot})\n"
                f"  the step {self.problem.step:.3g} s is too long for this scene: take a smaller one",
                t,
                error.pivot,
            ) from None

    def sample(self, i: int) -> None:
        """Store the present state as output i."""
        latched, state = self.compiled.memory_array(None), np.zeros(max(self.nc, 1), dtype=np.int8)
        self.lib.gudgeon_run_sample(
            self._run, self.pointer(self.y[i]), self.pointer(self.a[i]), self.pointer(latched),
            self.pointer(state, "signed char *"),
        )  # fmt: skip
        self.memory[i], self.state[i] = latched[: self.compiled.n_memory], state[: self.nc]
        self.done = i + 1

    def _fetch_impacts(self, last: bool) -> None:
        numbers, joints = np.zeros((N_EVENTS, 5)), np.zeros(N_EVENTS, dtype=np.intc)
        count = self.lib.gudgeon_run_impacts(self._run, int(last), self.pointer(numbers), self.pointer(joints, "int *"))
        fetched = np.zeros(count, dtype=self.impacts[0].dtype)
        fetched["joint"] = joints[:count]
        for column, name in enumerate(("t_on", "t_off", "deltadot", "F_peak", "t_peak")):
            fetched[name] = numbers[:count, column]
        self.impacts.append(fetched)

    def trajectory(self, interrupted: bool, stopped: SolverError | None) -> Trajectory:
        """What was stored, and the run's counts."""
        self._fetch_impacts(last=True)
        t = np.zeros(1)
        counts, numbers, peaks = np.zeros(6, dtype=np.int_), np.zeros(4), np.zeros((max(self.nc, 1), 3))
        self.lib.gudgeon_run_report(
            self._run, self.pointer(t), self.pointer(counts, "long *"), self.pointer(numbers), self.pointer(peaks)
        )
        impacts = np.concatenate(self.impacts)
        impacts = impacts[np.argsort(impacts["t_on"], kind="stable")]
        n, y = self.n, self.y[: self.done]
        phi, phi_dot, least, most = (float(x) if np.isfinite(x) else math.nan for x in numbers)
        steps, evaluations, onsets, grazes, outside, _ = (int(c) for c in counts)
        return Trajectory(
            self.problem.t[: self.done].copy(), y[:, :n].copy(), y[:, n : 2 * n].copy(), self.a[: self.done],
            self.memory[: self.done], self.state[: self.done], y[:, 2 * n :].copy(), impacts, peaks[: self.nc],
            Counts(steps, evaluations, onsets, grazes, phi, phi_dot, least, most, outside),
            interrupted, stopped,
        )  # fmt: skip

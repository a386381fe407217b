"""The C struct of one run: started, driven by a method, and read out (templates/c/run.c.jinja)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gudgeon.compiled import N_WORK, Array
from gudgeon.errors import NonFiniteError, SingularError, SolverError
from gudgeon.integrators.trajectory import EVENT_DTYPE, Counts, Problem, Trajectory, no_events

NOT_FINITE, EVENTS_FULL, CHATTERING, TOO_SMALL, LOST, ENDED = -2, -3, -4, -5, -6, -7
N_IMPACTS, N_COUNTS = 256, 9
RESOLUTION = 1e-11  # s, to which an event and a sample are told apart
REPORT = ("steps", "right_hand_sides", "onsets", "grazes", "ratio_outside", "switches", "rejected", "jacobians",
          "stiff_steps")  # fmt: skip


class RunEnded(Exception):
    """An event of the user ends the run; its sample is stored."""


class Session:
    """Samples by row: y (N, 2n + 3), memory, contact codes; `done` rows are filled."""

    def __init__(self, problem: Problem, p: Array | None = None) -> None:
        from gudgeon.results import IMPACT_DTYPE

        self.problem, self.compiled = problem, problem.compiled
        self.lib, self.pointer = self.compiled.lib, self.compiled.pointer
        n, nc, N = self.compiled.n, len(self.compiled.source.clearances), len(problem.t) + 1  # one for an early end
        self.n, self.nc, self.done = n, nc, 0
        self.seconds = 0.0  # spent in C
        self.t, self.events = problem.t, [no_events()]
        self.p = problem.p if p is None else p
        self.y = np.zeros((N, 2 * n + N_WORK))
        self.memory = np.full((N, max(self.compiled.n_memory, 1)), np.nan)
        self.state = np.zeros((N, max(nc, 1)), dtype=np.int8)
        self.impacts = [np.zeros(0, dtype=IMPACT_DTYPE)]
        self.struct = np.zeros(self.lib.gudgeon_run_size(), dtype=np.uint8)
        start = np.concatenate([problem.q, problem.v, np.zeros(N_WORK)])
        latched = self.compiled.memory_array(problem.memory if self.compiled.n_memory else None)
        p_run, y = self.pointer(self.p), self.pointer(start)
        self.lib.gudgeon_run_start(self.run, p_run, problem.t[0], y, self.pointer(latched))
        self.lib.gudgeon_run_stop(self.run, int(problem.stop))
        if problem.state is not None and nc:
            codes = np.ascontiguousarray(problem.state, dtype=np.int8)
            self.lib.gudgeon_run_codes(self.run, self.pointer(codes, "signed char *"))

    @property
    def run(self) -> Any:
        """The struct as C takes it."""
        return self.pointer(self.struct, "void *")

    def rows(self, i: int) -> tuple[Any, ...]:
        """Pointers to row i of the samples: y, memory, codes."""
        return self.pointer(self.y[i:]), self.pointer(self.memory[i:]), self.pointer(self.state[i:], "signed char *")

    def sample(self, i: int) -> None:
        """Store the present state as output i."""
        self.lib.gudgeon_run_sample(self.run, self.pointer(self.p), *self.rows(i))
        self.done = i + 1

    def end(self) -> None:
        """Stores the present state as the last sample, in place of those that are as late. Raises RunEnded."""
        t = self.report()[0]
        self.done = int(np.searchsorted(self.problem.t[: self.done], t - RESOLUTION))
        self.t = np.append(self.problem.t[: self.done], t)
        self.sample(self.done)
        raise RunEnded

    def fetch_events(self) -> None:
        """Take over the list of user events from C."""
        t, event = np.zeros(N_IMPACTS), np.zeros(N_IMPACTS, dtype=np.intc)
        count = self.lib.gudgeon_run_events(self.run, self.pointer(t), self.pointer(event, "int *"))
        fetched = np.zeros(count, dtype=EVENT_DTYPE)
        fetched["event"], fetched["t"] = event[:count], t[:count]
        self.events.append(fetched[fetched["t"] > self.problem.t[0] + RESOLUTION])

    def fetch_impacts(self, last: bool) -> None:
        """Take over the list of contacts from C; with `last` those that still go on too."""
        numbers, joints = np.zeros((N_IMPACTS, 5)), np.zeros(N_IMPACTS, dtype=np.intc)
        count = self.lib.gudgeon_run_impacts(self.run, int(last), self.pointer(numbers), self.pointer(joints, "int *"))
        fetched = np.zeros(count, dtype=self.impacts[0].dtype)
        fetched["joint"] = joints[:count]
        for column, name in enumerate(("t_on", "t_off", "deltadot", "F_peak", "t_peak")):
            fetched[name] = numbers[:count, column]
        self.impacts.append(fetched)

    def report(self) -> tuple[float, dict[str, int], Array, Array]:
        """The present time, counts by name, (max |Φ|, max |Φ̇|, least and largest ratio), peaks by joint."""
        t, counts = np.zeros(1), np.zeros(N_COUNTS, dtype=np.int_)
        numbers, peaks = np.zeros(4), np.zeros((max(self.nc, 1), 3))
        self.lib.gudgeon_run_report(
            self.run, self.pointer(t), self.pointer(counts, "long *"), self.pointer(numbers), self.pointer(peaks)
        )
        return float(t[0]), dict(zip(REPORT, counts.tolist(), strict=True)), numbers, peaks[: self.nc]

    def trajectory(self, interrupted: bool, stopped: SolverError | None) -> Trajectory:
        """What was stored, and the run's counts."""
        self.fetch_impacts(last=True)
        self.fetch_events()
        events = np.concatenate(self.events)
        _, counts, numbers, peaks = self.report()
        impacts = np.concatenate(self.impacts)
        impacts = impacts[np.argsort(impacts["t_on"], kind="stable")]
        n, y = self.n, self.y[: self.done]
        phi, phi_dot, least, most = (float(x) if np.isfinite(x) else math.nan for x in numbers)
        return Trajectory(
            self.t[: self.done].copy(), y[:, :n].copy(), y[:, n : 2 * n].copy(), None,
            self.memory[: self.done, : self.compiled.n_memory], self.state[: self.done, : self.nc],
            y[:, 2 * n :].copy(), impacts, peaks,
            Counts(**counts, phi_max=phi, phi_dot_max=phi_dot, ratio_min=least, ratio_max=most),
            interrupted, stopped, seconds=self.seconds, events=events[np.argsort(events["t"], kind="stable")],
        )  # fmt: skip

    def fail(self, status: int, t: float, advice: str) -> None:
        """Raises what a status of C stands for."""
        if status == NOT_FINITE:
            raise NonFiniteError(f"the motion is no longer finite at t = {t:.9g} s\n  {advice}", t)
        if status == CHATTERING:
            raise SolverError(
                f"a friction or another corner of the forces changes its side without end near t = {t:.9g} s\n"
                "  a force that jumps where the motion comes to rest holds it there: use a dry_friction element", t
            )  # fmt: skip
        if status == TOO_SMALL:
            raise SolverError(f"no step is small enough at t = {t:.9g} s{self._tightest()}\n  {advice}", t)
        if status == LOST:
            raise SolverError(f"a contact was lost at t = {t:.9g} s: a free journal lies outside its bearing", t)
        try:
            self.compiled.check_pivot(status, t, self.compiled.source.motion_pivots)
        except SingularError as error:
            y, memory, state = (array[:1].copy() for array in (self.y, self.memory, self.state))
            out = (self.pointer(y), self.pointer(memory), self.pointer(state, "signed char *"))
            self.lib.gudgeon_run_sample(self.run, self.pointer(self.p), *out)
            if np.isfinite(y).all() and np.abs(y).max() < 1e12:
                raise
            raise NonFiniteError(
                f"the motion diverged before t = {t:.9g} s (constraint row {error.pivot})\n  {advice}", t, error.pivot
            ) from None

    def _tightest(self) -> str:
        """How far the journals are from their bearings: what usually leaves a method no step."""
        _, _, _, peaks = self.report()
        joints = self.compiled.source.clearances
        if not joints:
            return ""
        ratio = [float(e) / float(self.p[joint.clearance]) for joint, (_, _, e) in zip(joints, peaks, strict=True)]
        worst = int(np.argmax(ratio))
        return f" (joint {joints[worst].name} came to e/c = {ratio[worst]:.7g})"

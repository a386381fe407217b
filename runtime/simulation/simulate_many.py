"""`Simulation.simulate_many`: many parameter sets of one scene, in threads."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.assembly.journals import parting
from gudgeon.assembly.redundant_rows import left_out
from gudgeon.contract.methods import ADAPTIVE, INTEGRATORS
from gudgeon.errors import AssemblyError, BadValueError, SolverError
from gudgeon.integrators import adaptive
from gudgeon.integrators import batch as many
from gudgeon.integrators.trajectory import Counts, Problem, Progress
from gudgeon.language.wanted import flag, function, text, told
from gudgeon.model.compiled import Array
from gudgeon.model.parameter_sets import ParameterSets, each_of, prepare_sets, rows_of
from gudgeon.results.batch import Batch, as_failures, given_values, peaks_of
from gudgeon.results.results import Result, State
from gudgeon.simulation.arguments import MAX_STEPS, end_of, method_of, output_times, step_of
from gudgeon.simulation.conclusion import conclude
from gudgeon.simulation.hidden_jumps import any_in_batch
from gudgeon.simulation.restart import check_fits, numbers, own_each
from gudgeon.simulation.single_runs import run_singly

if TYPE_CHECKING:
    from gudgeon.simulation.simulation import Simulation

COUNTS = tuple(field.name for field in fields(Counts))


def available_threads() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def simulate_many(
    simulation: Simulation, parameters: ParameterSets, t_end: float | str | None, output: int | ArrayLike | None,
    method: str, rtol: float | str | None, step: float | str | None, threads: int | None, progress: Progress | None,
    stop: bool, side_by_side: bool = True, start: State | Sequence[State] | None = None,
) -> Batch:  # fmt: skip
    """See Simulation.simulate_many."""
    starts = _Starts(simulation, parameters, start)
    given, is_given, t0 = starts.given, starts.is_given, starts.t
    method, progress = text(method, "method"), function(progress, "progress")
    stop, side_by_side = flag(stop, "stop"), flag(side_by_side, "side_by_side")
    workers = available_threads() if threads is None else threads
    if isinstance(workers, bool) or not isinstance(workers, (int, np.integer)) or workers < 1:
        raise BadValueError(f"threads is {told(threads)}: expected a number of threads, 1 or more")
    workers = int(min(workers, max(len(given), 1)))  # no more than there is to do
    if isinstance(t_end, str):
        good = [k for k in range(len(given)) if k not in starts.bad]
        t_end = end_of(simulation.source, t_end, [simulation.compiled.prepare(given[k], is_given[k]) for k in good])
    times = output_times(simulation.source, t0, t_end, output)
    chosen = method_of(simulation.source, method, step is not None)
    tolerance = adaptive.tolerance(rtol, chosen, step is not None)
    in_c = chosen in (*INTEGRATORS, ADAPTIVE) and not left_out(simulation.compiled)
    if in_c:
        p, motion, bad = prepare_sets(simulation.compiled, given, is_given, chosen != "rk4")
        bad |= starts.bad | starts.unfit(p, bad)
        fine = np.delete(p, list(bad), axis=0)
        in_c = not any_in_batch(simulation.source, fine, t0, float(times[-1]))  # else each run looks for its own
    if in_c:
        steps = np.array([step_of(simulation.compiled, step, chosen, row, float(times[-1] - t0)) for row in p])
        if ((times[-1] - t0) / steps).max() > MAX_STEPS:
            raise BadValueError(f"step {steps.min():.3g} s means more than {MAX_STEPS:.0e} steps")
        runs = many.Runs(simulation.compiled, p, motion, times, chosen, steps, tolerance, stop, side_by_side)
        runs.begin(starts.states)
        runs.leave_out(bad)
        before = time.perf_counter()
        runs.run(workers, progress)
        batch = _of_runs(_Results(simulation, runs, starts, tolerance, stop, chosen))
        return replace(batch, seconds=time.perf_counter() - before, threads=workers)
    options = {"t_end": t_end, "output": output, "method": method, "rtol": rtol, "step": step, "stop": stop}
    return run_singly(simulation, given, is_given, times, options, workers, progress, starts.states, starts.bad)


class _Starts:
    """Numbers of all runs, (n_runs, n_slots), states from which they go on (none: from t = 0), what cannot begin."""

    def __init__(self, simulation: Simulation, parameters: ParameterSets, start: Any) -> None:
        self.compiled = simulation.compiled
        rows, self.bad = rows_of(parameters)
        self.states = own_each(simulation.source, start, len(rows))
        if len(rows) == 1:
            rows = rows * max(1, len(self.states))
        self.t = self.states[0].t if self.states else 0.0
        self.remarks: list[tuple[str, ...]] = []
        self.given, self.is_given = each_of(rows, self._slots)

    def _slots(self, i: int, row: Mapping[str, Any]) -> tuple[Array, Array]:
        given, is_given, remarks = numbers(self.compiled, self.states[i] if self.states else None, row)
        self.remarks.append(remarks)
        return given, is_given

    def unfit(self, p: Array, bad: Mapping[int, Any]) -> dict[int, Any]:
        """Runs whose numbers leave rows open at the state that they go on from."""
        found: dict[int, Any] = {}
        for i, state in enumerate(self.states):
            if self.remarks[i] and i not in bad:
                try:
                    check_fits(self.compiled, state, p[i])
                except AssemblyError as error:
                    found[i] = error
        return found


@dataclass
class _Results:
    """The Result of run i from what C has stored."""

    simulation: Simulation
    runs: many.Runs
    starts: _Starts
    rtol: float
    stop: bool
    method: str

    def __call__(self, i: int) -> Result:
        """Raises the error of a run that failed, with what it reached."""
        runs, compiled, x, n = self.runs, self.simulation.compiled, self.runs.arrays, self.simulation.compiled.n
        error = runs.failures.get(i)
        if error is not None and not x["done"][i]:
            raise error
        begin = x["start"][i, :n], x["start"][i, n:], x["remembered"][i, : compiled.n_memory]
        remarks = self.starts.remarks[i] + parting(compiled, x["p"][i], self.starts.t, *begin)
        problem = Problem(
            compiled, x["p"][i], runs.times, *begin, float(x["step"][i]), method=self.method, rtol=self.rtol,
            p_free=None if self.method == "rk4" else x["p_motion"][i], stop=self.stop, remarks=remarks,
        )  # fmt: skip
        trajectory, seconds = runs.trajectory(i), float(x["seconds"][i])
        given = (self.starts.given[i], self.starts.is_given[i], seconds)
        made = conclude(compiled, self.method, problem, trajectory, *given, soon=False)
        if isinstance(error, SolverError):
            error.partial = made
        if error is not None:
            raise error
        return made


def _of_runs(results: _Results) -> Batch:
    """What C has stored, without a copy."""
    runs, source = results.runs, results.simulation.source
    x, n, y, joints = runs.arrays, results.simulation.compiled.n, runs.arrays["y"], len(source.clearances)
    impacts = tuple(runs.impacts_of(i) for i in range(runs.n))
    counts = [runs.counts(i) for i in range(runs.n)]
    numbers = {name: np.array([getattr(c, name) for c in counts]) for name in COUNTS} | {"seconds": x["seconds"]}
    return Batch(
        source=source, t=runs.times, q=y[:, :, :n], v=y[:, :, n : 2 * n], work=y[:, :, 2 * n :],
        state=x["state"][:, :, :joints], samples=x["done"], t_last=x["t_last"],
        parameters=given_values(source, x["p"], results.starts.is_given), impacts=impacts,
        events=tuple(runs.events_of(i) for i in range(runs.n)),
        peaks=peaks_of(x["peaks"][:, :joints], impacts), diagnostics=numbers, failures=as_failures(runs.failures),
        seconds=math.nan, threads=0, interrupted=runs.interrupted, result=results,
    )  # fmt: skip

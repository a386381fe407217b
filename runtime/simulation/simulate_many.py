"""`Simulation.simulate_many`: many parameter sets of one scene, in threads."""

from __future__ import annotations

import math
import os
import time
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.assembly.redundant_rows import left_out
from gudgeon.contract.methods import ADAPTIVE, INTEGRATORS
from gudgeon.errors import BadValueError, SolverError
from gudgeon.integrators import adaptive
from gudgeon.integrators import batch as many
from gudgeon.integrators.trajectory import Counts, Problem, Progress
from gudgeon.language.wanted import flag, function, text, told
from gudgeon.model.compiled import Array
from gudgeon.model.parameter_sets import Mask, ParameterSets, given_sets, prepare_sets
from gudgeon.results.batch import Batch, as_failures, given_values, peaks_of
from gudgeon.results.results import Result
from gudgeon.simulation.arguments import MAX_STEPS, method_of, output_times, step_of
from gudgeon.simulation.conclusion import conclude
from gudgeon.simulation.hidden_jumps import any_in_batch
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
    stop: bool, side_by_side: bool = True,
) -> Batch:  # fmt: skip
    """See Simulation.simulate_many."""
    given, is_given = given_sets(simulation.source, parameters)
    method, progress = text(method, "method"), function(progress, "progress")
    stop, side_by_side = flag(stop, "stop"), flag(side_by_side, "side_by_side")
    workers = available_threads() if threads is None else threads
    if isinstance(workers, bool) or not isinstance(workers, (int, np.integer)) or workers < 1:
        raise BadValueError(f"threads is {told(threads)}: expected a number of threads, 1 or more")
    workers = int(min(workers, max(len(given), 1)))  # no more than there is to do
    times = output_times(simulation.source, 0.0, t_end, output)
    chosen = method_of(simulation.source, method, step is not None)
    tolerance = adaptive.tolerance(rtol, chosen, step is not None)
    in_c = chosen in (*INTEGRATORS, ADAPTIVE) and not left_out(simulation.compiled)
    if in_c:
        p, motion, bad = prepare_sets(simulation.compiled, given, is_given, chosen != "rk4")
        fine = np.delete(p, list(bad), axis=0)
        in_c = not any_in_batch(simulation.source, fine, 0.0, float(times[-1]))  # else each run looks for its own
    if in_c:
        steps = np.array([step_of(simulation.compiled, step, chosen, row, float(times[-1])) for row in p])
        if (times[-1] / steps).max() > MAX_STEPS:
            raise BadValueError(f"step {steps.min():.3g} s means more than {MAX_STEPS:.0e} steps")
        runs = many.Runs(simulation.compiled, p, motion, times, chosen, steps, tolerance, stop, side_by_side)
        runs.leave_out(bad)
        before = time.perf_counter()
        runs.run(workers, progress)
        batch = _of_runs(_Results(simulation, runs, given, is_given, tolerance, stop, chosen))
        return replace(batch, seconds=time.perf_counter() - before, threads=workers)
    options = {"t_end": t_end, "output": output, "method": method, "rtol": rtol, "step": step, "stop": stop}
    return run_singly(simulation, given, is_given, times, options, workers, progress)


@dataclass
class _Results:
    """The Result of run i from what C has stored."""

    simulation: Simulation
    runs: many.Runs
    given: Array
    is_given: Mask
    rtol: float
    stop: bool
    method: str

    def __call__(self, i: int) -> Result:
        """Raises the error of a run that failed, with what it reached."""
        runs, compiled, x, n = self.runs, self.simulation.compiled, self.runs.arrays, self.simulation.compiled.n
        error = runs.failures.get(i)
        if error is not None and not x["done"][i]:
            raise error
        problem = Problem(
            compiled, x["p"][i], runs.times, x["start"][i, :n], x["start"][i, n:], np.full(compiled.n_memory, np.nan),
            float(x["step"][i]), method=self.method, rtol=self.rtol,
            p_free=None if self.method == "rk4" else x["p_motion"][i], stop=self.stop,
        )  # fmt: skip
        trajectory, seconds = runs.trajectory(i), float(x["seconds"][i])
        numbers = (self.given[i], self.is_given[i], seconds)
        made = conclude(compiled, self.method, problem, trajectory, *numbers, soon=False)
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
        parameters=given_values(source, x["p"], results.is_given), impacts=impacts,
        events=tuple(runs.events_of(i) for i in range(runs.n)),
        peaks=peaks_of(x["peaks"][:, :joints], impacts), diagnostics=numbers, failures=as_failures(runs.failures),
        seconds=math.nan, threads=0, interrupted=runs.interrupted, result=results,
    )  # fmt: skip

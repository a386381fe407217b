"""Measure what one call costs beyond the integration in C: `simulate`, `simulate_many`, a prepared run, a step.

    python -m benchmarks.calls      # from the repository's root, with gudgeon installed

All runs are so short that they integrate next to nothing (`t_end` → 0). Times are processor times in µs, the least of
several rounds in turns. The parameter values of calls take turns; those of column "new" have not been used before.
Column "many" is a run of a batch of 1,000 runs with different values in one thread.

"in C" is the time of the function of C that starts and integrates the run of such a call; the rest is "beyond". It
includes the audit of samples, which is C too. Prepared runs and steps are one call of C: the function is measured in
runs that are repeated without the rest. Runs of a batch share no vectors where it is measured.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count, cycle
from time import process_time, thread_time

import numpy as np

import gudgeon
from gudgeon.contract.boundary import NEW
from gudgeon.integrators.reusable_run import ReusableRun
from gudgeon.simulation.simulation import Simulation

# mechanism, scene, parameter, series, length of a step (s)
SCENES = (
    ("nine_bar_press", "dry", "bodies.S9.mass", "S9.y", 1e-4),
    ("nine_bar_press", "dry", "c", "S9.y", 1e-4),
    ("andrews_squeezer", "ideal", "bodies.OF.mass", "OF.theta", 1e-4),
    ("pendulum", "ideal", "g", "bob.x", 1e-3),
)
ROUNDS, CALLS, CALLS_OF_SIMULATE = 50, 100, 20
BATCHES, RUNS = 8, 1000  # batches that are measured, and runs of each
T_END = 1e-9  # s
VALUES = 5  # parameter values that take turns


def measure(function: Callable[[], object], n: int, rounds: int = ROUNDS) -> float:
    """Return the least time of one call of a function in µs, over rounds of n calls, of all threads together."""
    best = np.inf
    for _ in range(rounds):
        begin = process_time()
        for _ in range(n):
            function()
        best = min(best, (process_time() - begin) / n)
    return 1e6 * best


def measure_in_c(simulation: Simulation, function: Callable[[], object], n: int, rounds: int = ROUNDS) -> float:
    """Return the least time that one call of `function` spends in gudgeon_ensemble, in µs, over rounds of n calls."""
    functions, spent = vars(simulation.compiled.lib), 0.0
    in_c = simulation.compiled.lib.gudgeon_ensemble

    def integrate(*arguments: object) -> object:
        nonlocal spent
        begin = thread_time()
        result = in_c(*arguments)
        spent += thread_time() - begin
        return result

    best, of_clock = np.inf, measure(thread_time, n)
    functions["gudgeon_ensemble"] = integrate
    try:
        for _ in range(rounds):
            spent = 0.0
            for _ in range(n):
                function()
            best = min(best, spent / n)
    finally:
        functions["gudgeon_ensemble"] = in_c
    return 1e6 * best - of_clock


def measure_integration(run: ReusableRun, rows: Sequence[int], dt: float = 0.0) -> float:
    """Return the least time of gudgeon_ensemble for the runs in these rows, which take turns, in µs.

    dt: length (s) of steps, each of which begins at the end of the one before; 0: runs begin at their own starts.
    """
    lib, current, turns, arrays = run.compiled.lib, run.compiled.ffi.new("long *"), cycle(rows), run.arrays
    phase, done, checked, t = arrays["phase"], arrays["done"], arrays["checked"], run.times.t

    def repeat(integrates: bool) -> None:
        k = next(turns)
        phase[k], done[k], checked[k] = NEW, 0 if integrates else len(t), 0
        current[0] = k
        if dt:
            t[0], t[1] = t[1], t[1] + dt
        if integrates:
            lib.gudgeon_ensemble(run.struct, run._integrator, current, k + 1)
        if dt:
            lib.gudgeon_resume_from_end(run.repeated)

    return measure(lambda: repeat(True), CALLS) - measure(lambda: repeat(False), CALLS)


def take_turns(function: Callable[[np.ndarray], object], values: Sequence[np.ndarray]) -> Callable[[], object]:
    """Return a function without arguments that calls `function` with one of the values after the other."""
    position = 0

    def call() -> object:
        nonlocal position
        position = (position + 1) % len(values)
        return function(values[position])

    return call


def measure_batch(simulation: Simulation, name: str, default: float) -> list[float]:
    """Return the time of one run of a batch, and its time beyond C where runs share no vectors, in µs."""
    values = {name: default * (1.0 + 1e-6 * np.arange(RUNS))}

    def simulate_many(side_by_side: bool = True) -> object:
        return simulation.simulate_many(values, T_END, output=1, threads=1, side_by_side=side_by_side)

    def simulate_alone() -> object:
        return simulate_many(False)

    simulate_many()  # compiles what lanes need
    whole, alone = measure(simulate_many, 1, BATCHES), measure(simulate_alone, 1, BATCHES)
    return [whole / RUNS, (alone - measure_in_c(simulation, simulate_alone, 1, BATCHES)) / RUNS]


def measure_scene(simulation: Simulation, name: str, series: str, dt: float) -> list[float]:
    """Return the times of simulate with known values and beyond C in it, of simulate with new values, of a run of a
    batch and beyond C in it, of a prepared run and of C in it, and of a step and of C in it, in µs.
    """
    address = name if name in simulation.source.parameter_indices else f"parameters.{name}"
    default = simulation.source.parameters[simulation.source.parameter_indices[address]].default
    values = [np.array([default * (1.0 + 1e-6 * k)]) for k in range(VALUES)]
    prepared, stepper = simulation.prepare(name, series, T_END, output=1), simulation.stepper(name, series)

    def simulate(x: np.ndarray) -> object:
        return simulation.simulate(T_END, output=1, parameters={name: float(x[0])})

    numbers = count(1)

    def simulate_new() -> object:
        return simulate(np.array([default * (1.0 + 1e-9 * next(numbers))]))

    known = take_turns(simulate, values)
    times = [measure(known, CALLS_OF_SIMULATE)]
    times.append(times[0] - measure_in_c(simulation, known, CALLS_OF_SIMULATE))
    times.append(measure(simulate_new, CALLS_OF_SIMULATE))
    times += measure_batch(simulation, name, default)
    assert prepared._run and stepper._run
    times += [measure(take_turns(prepared, values), CALLS), measure_integration(prepared._run, (0, 1))]
    stepper.reset(values[0])
    times.append(measure(take_turns(lambda x: stepper.step(dt, x), values), CALLS))
    stepper.reset(values[0])
    stepper.step(dt, values[0])
    return [*times, measure_integration(stepper._run, (0,), dt)]


def main() -> None:
    """Print a row for each scene."""
    print(f"{'µs':34}{'simulate':>9}{'beyond':>7}{'new':>7}{'many':>8}{'beyond':>7}", end="")
    print(f"{'prepared':>9}{'in C':>7}{'beyond':>7}{'step':>8}{'in C':>7}{'beyond':>7}")
    for mechanism, scene, name, series, dt in SCENES:
        simulation = gudgeon.load(mechanism, scene, quick=False)
        whole, beyond, new, run, run_beyond, call, in_c, step, step_in_c = measure_scene(simulation, name, series, dt)
        title = f"{mechanism}/{scene}, {name.removeprefix('bodies.')}"
        print(f"{title:34}{whole:9.1f}{beyond:7.1f}{new:7.1f}{run:8.1f}{run_beyond:7.1f}", end="")
        print(f"{call:9.1f}{in_c:7.1f}{call - in_c:7.1f}{step:8.1f}{step_in_c:7.1f}{step - step_in_c:7.1f}")


if __name__ == "__main__":
    main()

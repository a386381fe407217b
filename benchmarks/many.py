"""Measure ensembles of 200 runs of the lubricated press over clearance and speed: threads, SIMD lanes, Taylor series.

    python -m benchmarks.many [--clearances 10] [--speeds 20] [--beside | --outside | --series]

The press of the race (l5 = 0.25 m, no gravity) is run with c = 0.3 ... 0.8 mm and omega = pi ... 8 pi for 0.4 s, with
201 outputs. The loosest tolerance whose worst slider error over all runs is at most 1e-6 of the ideal stroke is timed.
The reference is the stiff method at 1e-10. At the race's clearance and speed it is compared with the race's reference,
which is independent of gudgeon. Times are those of whole batches: assembly of starts, runs, arrays.

Further tables:

- rk4 with one step for all runs in one thread: runs in SIMD lanes against single runs, with equal bits.
- Whole calls of `simulate` in two threads of the caller (a ThreadPool) against calls one after the other, and
  `simulate_many` with two threads against one. `besides` is the processor time of a call less that of a run of the
  batch. `waiting` is the fraction of time in the pool in which a call waits for Python's lock.
- A series of 1,000 runs of 201 samples, against series taken from each run's result.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from hashlib import sha256
from pathlib import Path
from threading import Thread
from time import perf_counter, process_time

import numpy as np

import gudgeon
from benchmarks.peers import press
from gudgeon.results.batch import Batch
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation

BATCH = 64  # runs in SIMD lanes
RUNS_OUTSIDE = 24
# mechanism, scene, columns (address, from, to), end and step in s
BESIDE: tuple[tuple[str, str, dict[str, tuple[float, float]], float, float], ...] = (
    ("andrews_squeezer", "ideal", {"bodies.OF.mass": (0.03, 0.06)}, 0.03, 1e-5),
    ("nine_bar_press", "lubricated", {"c": (3e-4, 8e-4), "omega": (3.0, 20.0)}, 0.1, 2e-5),
    ("nine_bar_press", "dry", {"c": (3e-4, 8e-4), "omega": (3.0, 20.0)}, 0.1, 2e-5),
    ("n_four_bar", "ideal", {"gravity.y": (-12.0, -3.0)}, 0.5, 1e-4),
    ("slider_crank_spring", "ideal", {"forces.coil.stiffness": (100.0, 5000.0)}, 0.5, 1e-4),
)
TOLERANCES = (1e-5, 5e-6, 2e-6, 1e-6)
REQUIRED_ERROR = 1e-6  # required accuracy, over the stroke
SLIDER = "S9.y"


def grid(clearances: int, speeds: int) -> dict[str, float | np.ndarray]:
    """Return the parameter columns of all pairs of clearance and speed."""
    c, omega = np.meshgrid(np.linspace(0.3e-3, 0.8e-3, clearances), np.pi * np.linspace(1.0, 8.0, speeds))
    return {"l5": 0.25, "gravity.y": 0.0, "c": c.ravel(), "omega": omega.ravel()}


def run(simulation: Simulation, parameters: dict[str, float | np.ndarray], **options: object) -> Batch:
    """Run one batch with the race's output times. Raises SystemExit if a run fails."""
    work = press.work("lubricated")
    batch = simulation.simulate_many(parameters, output=work.times, **options)  # type: ignore[arg-type]
    if batch.failures:
        raise SystemExit(str(batch.failures[0]))
    return batch


def worst(batch: Batch, reference: Batch) -> float:
    """Return the largest slider error of all runs, over the ideal stroke."""
    column = batch.source.coordinates.index(SLIDER)
    return float(np.abs(batch.q[:, :, column] - reference.q[:, :, column]).max() / press.work("lubricated").stroke)


def confirm(simulation: Simulation) -> float:
    """Return the difference of the reference method from the race's reference, over the stroke."""
    work = press.work("lubricated")
    own = run(simulation, dict(work.parameters), method="rodas5p", rtol=1e-10).q[0]
    return press.errors(work, press.Samples(own, (np.zeros(0), np.zeros(0))), press.reference("lubricated")).slider


def least(simulation: Simulation, parameters: dict[str, float | np.ndarray], rtol: float, repeats: int) -> list[float]:
    """Return the smallest wall times of a batch with one and two threads, then the processor times, in s."""
    found = [math.inf] * 4
    for _ in range(repeats):
        for k in (0, 1):
            before = process_time()
            wall = run(simulation, parameters, rtol=rtol, threads=k + 1).seconds
            found[k], found[2 + k] = min(found[k], wall), min(found[2 + k], process_time() - before)
    return found


def machine(repeats: int) -> float:
    """Return the speedup of two independent threads on this machine, limited by other work on the second core."""
    data, found = bytes(1 << 25), [math.inf, math.inf]
    for _ in range(repeats):
        for k in (0, 1):
            threads = [Thread(target=lambda: sha256(data).digest()) for _ in range(k + 1)]
            before = perf_counter()
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            found[k] = min(found[k], perf_counter() - before)
    return 2.0 * found[0] / found[1]


def side_by_side(repeats: int) -> None:
    """Print the time of a step and run of rk4, for single runs and in SIMD lanes."""
    print("\n  rk4, one thread                 us a step and run: alone  side by side  ratio")
    for name, scene, columns, t_end, step in BESIDE:
        simulation = gudgeon.load(name, scene=scene, quick=False)
        parameters = {address: np.linspace(*ends, BATCH) for address, ends in columns.items()}
        found, samples = [math.inf, math.inf], [b"", b""]
        for _ in range(repeats + 1):  # the first compiles
            for k in (0, 1):
                batch = simulation.simulate_many(
                    parameters, t_end, output=20, method="rk4", step=step, threads=1, side_by_side=bool(k)
                )
                found[k], samples[k] = min(found[k], batch.seconds), batch.q.tobytes()
        if samples[0] != samples[1]:
            raise SystemExit(f"{name}, {scene}: not the same bits")
        alone, beside = (1e6 * seconds / BATCH / (t_end / step) for seconds in found)
        print(f"  {name + ', ' + scene:<48} {alone:9.3f} {beside:13.3f} {alone / beside:6.1f}")


def in_turns(works: dict[str, Callable[[], object]], repeats: int) -> dict[str, float]:
    """Return the smallest wall time of each work in s; the works take turns."""
    found = dict.fromkeys(works, math.inf)
    for _ in range(repeats):
        for name, work in works.items():
            before = perf_counter()
            work()
            found[name] = min(found[name], perf_counter() - before)
    return found


def waiting_fraction(work: Callable[[float], object], values: list[float], threads: int) -> float:
    """Return the fraction of a call's wall time in which its thread waits for a lock; NaN if not on Linux.

    Other work on the machine increases it, because the holder of the lock waits for a core.
    """

    def clocks() -> tuple[float, float]:
        """Return wall time, and running plus runnable time of the thread, in s."""
        ran, ready, _ = map(int, Path("/proc/thread-self/schedstat").read_text().split())
        return perf_counter(), 1e-9 * (ran + ready)

    def one(value: float) -> tuple[float, float]:
        """Return wall time and busy time of one call."""
        before = clocks()
        work(value)
        (wall, busy), (wall_0, busy_0) = clocks(), before
        return wall - wall_0, busy - busy_0

    if not Path("/proc/thread-self/schedstat").exists():
        return math.nan
    with ThreadPoolExecutor(threads) as pool:
        times = np.array(list(pool.map(one, values)))
    wall, busy = times.sum(axis=0).tolist()
    return float(1.0 - busy / wall)


def outside(repeats: int) -> None:
    """Print how whole calls in threads of the caller scale, compared with the batch's own threads."""
    print("\n  two threads against one          CPU ms: a run  besides  in a pool  in a batch  that only hash  waiting")
    for scene, t_end in (("lubricated", 1.0), ("dry", 0.2)):
        _measure_outside(gudgeon.load("nine_bar_press", scene=scene, quick=False), t_end, repeats)


def _measure_outside(simulation: Simulation, t_end: float, repeats: int) -> None:
    """Print the scaling of one scene."""
    clearances = np.linspace(4e-4, 8e-4, RUNS_OUTSIDE).tolist()

    def one(c: float) -> Result:
        """Run one simulation."""
        return simulation.simulate(t_end, output=200, parameters={"c": c})

    def pool() -> None:
        """Run all simulations in two threads."""
        with ThreadPoolExecutor(2) as threads:
            list(threads.map(one, clearances))

    def batch(threads: int) -> None:
        """Run all simulations as a batch."""
        simulation.simulate_many({"c": clearances}, t_end, output=200, threads=threads)

    one(4e-4)
    before = process_time()
    batch(1)
    in_c = process_time() - before
    before = process_time()
    list(map(one, clearances))
    other = process_time() - before - in_c
    works: dict[str, Callable[[], object]] = {
        "one": lambda: list(map(one, clearances)),
        "pool": pool,
        "batch 1": lambda: batch(1),
        "batch 2": lambda: batch(2),
    }
    found = in_turns(works, repeats)
    ratios = found["one"] / found["pool"], found["batch 1"] / found["batch 2"], machine(repeats)
    message = "".join(f"{x:{width}.2f}" for x, width in zip(ratios, (11, 12, 16), strict=True))
    message += f"{100.0 * waiting_fraction(one, 4 * clearances, 2):8.1f} %"
    ms = 1e3 / RUNS_OUTSIDE
    print(f"  {'nine_bar_press, ' + simulation.source.scene:<36} {ms * in_c:10.2f} {ms * other:8.2f}{message}")


def series(repeats: int) -> None:
    """Print the time of a series of many runs: from the states in threads, and from whole results one by one."""
    simulation = gudgeon.load("nine_bar_press", scene="dry", quick=False)
    batch = simulation.simulate_many({"c": np.linspace(3e-4, 8e-4, 1000)}, 0.02, output=200)
    print(f"\n  a series of {len(batch)} runs of {len(batch.t)} samples, ms: in threads  run by run   ratio")
    for name in ("S9.y", "S9.ay", "A.F"):
        quick, slow = math.inf, math.inf
        for k in range(repeats):
            before = perf_counter()
            _ = batch[name]
            quick = min(quick, perf_counter() - before)
            if k == 0:  # it takes seconds
                before = perf_counter()
                _ = [batch[i][name] for i in range(len(batch))]
                slow = perf_counter() - before
        print(f"  {name:<42} {1e3 * quick:12.1f} {1e3 * slow:11.0f} {slow / quick:7.0f}")


def main() -> None:
    """Run the benchmark from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--clearances", type=int, default=10)
    parser.add_argument("--speeds", type=int, default=20)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--beside", action="store_true", help="only rk4's runs side by side")
    parser.add_argument("--outside", action="store_true", help="only threads of the caller's")
    parser.add_argument("--series", action="store_true", help="only series of a batch")
    options = parser.parse_args()
    parts = {side_by_side: options.beside, outside: options.outside, series: options.series}
    if any(parts.values()):
        for part in (part for part, expected in parts.items() if expected):
            part(options.repeats)
        return
    simulation = gudgeon.load("nine_bar_press", scene="lubricated", quick=False)
    parameters = grid(options.clearances, options.speeds)
    reference = run(simulation, parameters, method="rodas5p", rtol=1e-10)
    print(f"reference differs from the race's by {confirm(simulation):.1e} of the stroke")
    print(f"{len(reference)} lubricated runs of {press.work('lubricated').t_end:g} s\n")
    print("  rtol    worst error of the slider")
    for rtol in TOLERANCES:
        error = worst(run(simulation, parameters, rtol=rtol), reference)
        print(f"  {rtol:<7.0e} {error:.1e}")
        if error <= REQUIRED_ERROR:
            break
    one, two, cpu_one, cpu_two = least(simulation, parameters, rtol, options.repeats)
    n = len(reference)
    print("\n             ms a run   CPU ms a run")
    print(f"  1 thread   {1e3 * one / n:8.2f}   {1e3 * cpu_one / n:12.2f}")
    print(f"  2 threads  {1e3 * two / n:8.2f}   {1e3 * cpu_two / n:12.2f}")
    print(f"  two threads are {one / two:.2f} times as fast as one; two that only hash: {machine(options.repeats):.2f}")
    for part in parts:
        part(options.repeats)


if __name__ == "__main__":
    main()

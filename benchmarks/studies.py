"""Measure a study of 10,000 runs of a lubricated mechanism, stored on disk: time per run, two threads, memory.

    python -m benchmarks.studies [--repeats 3] [--batches | --large]

studies/lubricated_10000.yaml and a tenth of it (fewer viscosities) run in separate processes. The tenth runs by one and
by two threads in turns, and the smallest times are printed with the speedup of two independent threads. The whole study
runs by one and by two threads. `alone` is the processor time of the same runs as one batch without
samples; the rest is
the cost of the study: series, measures and files. On a loaded machine, compare that ratio and processor times. Memory
is the maximum of a process.

--batches: batches without a study in one thread; the smallest processor time of --repeats, per run of whole calls. Dry
presses of 0.05 s at one speed with c = 0.3 mm within 1 %, and over clearance x speed; lubricated ones of 0.4 s. Runs in
SIMD lanes and single runs take turns.

--large: 100,000 presses in a batch on two threads, wall time of the whole call: dry ones of .05 s, lubricated ones of
.4 s, each --repeats times.
"""

from __future__ import annotations

import argparse
import json
import math
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter, process_time
from typing import NamedTuple

import numpy as np
from ruamel.yaml import YAML

import gudgeon
from benchmarks.many import machine
from gudgeon.integrators import lanes
from gudgeon.studies.ensemble.study import resolve_plans, run_plans

FILE = Path(__file__).parents[1] / "studies" / "lubricated_10000.yaml"
PRESS = {"l5": 0.25, "gravity.y": 0.0, "omega": 2.0 * np.pi}  # of all batches
LARGE = {"dry": (0.05, 15.0), "lubricated": (0.4, 35.0)}  # batches of 100,000: length of a run, required time, s
VISCOSITY, TENTH, WHOLE = "contacts.oil.film.viscosity", 2, 20  # how many of them


def one(viscosities: int, threads: int) -> dict[str, float]:
    """Run a study in this process; return runs, failures, times in s (wall, processor, runs alone), and memory in
    MB."""
    study = YAML(typ="safe").load(FILE)
    study["parameters"][VISCOSITY]["count"] = viscosities
    plans, alone = resolve_plans(study), math.nan
    (plan,) = plans.by_part.values()
    if viscosities == TENTH:
        simulation, columns = plan.parts[0].simulation, plan.make_job(0, 0, np.arange(plan.runs), 1).columns
        before = process_time()
        simulation.simulate_many(dict(columns), study["t_end"], output=1, rtol=study["rtol"], threads=1, keep=[])
        alone = process_time() - before
    before = peak_memory()
    with tempfile.TemporaryDirectory() as folder:
        wall, cpu = perf_counter(), process_time()
        found = run_plans(plans, Path(folder), threads)
        wall, cpu = perf_counter() - wall, process_time() - cpu
        runs, failed = found.runs, found.failed
    document = {"runs": runs, "failed": failed, "wall": wall, "cpu": cpu, "alone": alone, "before": before}
    return document | {"most": peak_memory()}


def draw_clearances(runs: int) -> np.ndarray:
    """Return random clearances in m: 0.3 mm within 1 %."""
    return 3e-4 * np.random.default_rng(0).uniform(0.99, 1.01, runs)


def large(scene: str) -> float:
    """Return the wall time of a batch of 100,000 presses in s."""
    simulation, t_end = gudgeon.load("nine_bar_press", scene=scene), LARGE[scene][0]
    lanes.MIN_REMAINING_S = 0.0  # compiled by the first few
    for runs in (64, 100_000):
        before = perf_counter()
        simulation.simulate_many({**PRESS, "c": draw_clearances(runs)}, t_end, output=2, rtol=1e-4, threads=2)
    return perf_counter() - before


class Presses(NamedTuple):
    """A batch of presses: title, scene, parameters of each run, length of a run (s)."""

    title: str
    scene: str
    columns: dict[str, np.ndarray]
    t_end: float


def presses() -> list[Presses]:
    """Return the batches that are measured."""
    c, omega = (x.ravel() for x in np.meshgrid(np.linspace(0.3e-3, 0.8e-3, 50), np.pi * np.linspace(1.0, 8.0, 80)))
    return [
        Presses("dry, .05 s, c = .3 mm within 1 %", "dry", {"c": draw_clearances(4000)}, 0.05),
        Presses("dry, .05 s, clearance x speed", "dry", {"c": c, "omega": omega}, 0.05),
        Presses("lubricated, .4 s, c = .3 mm within 1 %", "lubricated", {"c": draw_clearances(4000)[:1000]}, 0.4),
    ]


def batches(repeats: int) -> None:
    """Print the processor time of runs in batches."""
    print("  nine_bar_press, rtol 1e-4                   runs   CPU ms a run: beside  alone")
    for message, scene, columns, t_end in presses():
        simulation, n = gudgeon.load("nine_bar_press", scene=scene), len(columns["c"])
        least = {True: math.inf, False: math.inf}
        lanes.MIN_REMAINING_S = 0.0  # however short a batch is
        for beside in (True, False) * (repeats + 1):  # the first ones compile
            before = process_time()
            simulation.simulate_many(
                {**PRESS, **columns},
                t_end,
                output=2,
                rtol=1e-4,
                threads=1,
                side_by_side=beside,
            )
            least[beside] = min(least[beside], process_time() - before)
        print(f"  {message:<40} {n:7d}{1e3 * least[True] / n:22.3f}{1e3 * least[False] / n:7.3f}", flush=True)


def peak_memory() -> float:
    """Return the largest memory of this process so far in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1024 if sys.platform == "linux" else 1 << 20)


def run_separately(viscosities: int, threads: int) -> dict[str, float]:
    """Run a study in a process of its own; return the results of `one`."""
    call = [sys.executable, "-m", "benchmarks.studies", "--one", str(viscosities), str(threads)]
    found: dict[str, float] = json.loads(subprocess.run(call, check=True, capture_output=True, text=True).stdout)
    return found


def main() -> None:
    """Run the benchmark from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--one", type=int, nargs=2, help=argparse.SUPPRESS)
    parser.add_argument("--batches", action="store_true", help="runs in batches, without a study")
    parser.add_argument("--large", action="store_true", help="batches of 100,000 on two threads")
    options = parser.parse_args()
    for scene, (t_end, required) in (*LARGE.items(),) * options.repeats if options.large else ():
        print(f"  100,000 {scene} presses of {t_end} s: {large(scene):.1f} s (asked: at most {required:g})", flush=True)
    if options.batches:
        batches(options.repeats)
    if options.batches or options.large:
        return
    if options.one:
        print(json.dumps(one(*options.one)))
        return
    least = {of: {1: math.inf, 2: math.inf} for of in (TENTH, WHOLE)}
    print("  threads    runs  failed   ms a run: wall    CPU  alone    MB: before  most")
    for of, threads in [(TENTH, 1), (TENTH, 2)] * options.repeats + [(WHOLE, 1), (WHOLE, 2)]:
        found = run_separately(of, threads)
        each = [1e3 * found[name] / found["runs"] for name in ("wall", "cpu", "alone")]
        text = f"{each[0]:16.3f}{each[1]:7.3f}{each[2]:7.3f}{found['before']:14.0f}{found['most']:6.0f}"
        print(f"  {threads:7d}{found['runs']:8.0f}{found['failed']:8.0f}{text}", flush=True)
        least[of][threads] = min(least[of][threads], found["wall"])
    times = " and ".join(f"{least[of][1] / least[of][2]:.2f}" for of in (TENTH, WHOLE))
    print(f"  two threads are {times} times as fast as one (a tenth, the whole); two that only hash: {machine(10):.2f}")


if __name__ == "__main__":
    main()

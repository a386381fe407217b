"""Measure how derivation, size of the C, compilation and run time grow with the number of joints of an N-four-bar.

    python -m benchmarks.scaling [--largest 128] [--long 40] [--formulation reduced full]
    python -m benchmarks.scaling --largest 0 --long 0 --tight 5 10 20 40
    python -m benchmarks.scaling --page                     # chains too, docs/scaling.md (growth.py)

Prints for both formulations a row for each N and the exponent of each column, fitted over all N ≥ 4 on logarithmic
axes (a straight line through the smallest systems would fit what is constant, the start of SymPy and gcc). Derive,
emit and compile are processor time, ours and gcc's, so that other work on the machine hardly shows. `rhs` is the least
time of a run of rk4 over its right-hand sides: closures, projection and all that a user pays for.
`--long N` then runs N four-bars through their singular positions for 20 s, `--tight` some of them by tolerance.
"""

from __future__ import annotations

import argparse
import resource
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from sympy.core.cache import clear_cache

import gudgeon
from benchmarks import growth
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.loading.build import compile_kernels
from gudgeon.loading.kernel_sources import FORMULATIONS
from gudgeon.mechanisms.n_four_bar import text as yaml_text
from gudgeon.model.compiled import CompiledModel
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation

COLUMNS = ("derive [s]", "emit [s]", "operations", "C [kB]", "compile [s]", "rhs [us]")
BAR = 1.15  # largest allowed exponent
STEP, STEPS = 1e-3, 200
GRAVITY, BAR_INERTIA = 9.81, 1.0 / 12.0
TOLERANCES = (1e-6, 1e-9, 1e-11, 1e-12)
DRIFT, PARALLEL = 1e-3, 1e-6  # J, rad: limits for the long run


def processor_time() -> float:
    """Return the processor time of this process and of its finished children, in s."""
    return time.process_time() + sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def least(call: Callable[[], object], repeats: int) -> float:
    """Return the processor time of the fastest of some calls; SymPy's cache is cleared before each."""
    times = []
    for _ in range(repeats):
        clear_cache()
        before = processor_time()
        call()
        times.append(processor_time() - before)
    return min(times)


def measure(n: int, formulation: str, folder: Path) -> tuple[float, ...]:
    """Return one row of the table."""
    data, file = yaml_text(n).encode(), folder / f"n_four_bar_{n}.yaml"
    file.write_bytes(data)
    repeats = 2 if n <= 16 else 1
    derived = least(lambda: derive_scene(data, file.name, "ideal"), 3)
    model = derive_scene(data, file.name, "ideal")
    emitted = least(lambda: generate_c(model, formulation), repeats)
    source = generate_c(model, formulation)
    compiled = least(lambda: compile_kernels(source, rebuild=True), repeats)
    simulation = Simulation(CompiledModel(source, compile_kernels(source)), file)
    kernel = "reduced_dynamics" if formulation == "reduced" else "dynamics"
    size = sum(map(len, source.files.values())) / 1000
    return derived, emitted, source.operations[kernel], size, compiled, 1e6 * rhs_seconds(simulation)


def rhs_seconds(simulation: Simulation) -> float:
    """Return the time of a run of rk4 over its right-hand sides, the smallest of 7 runs."""
    runs = [simulation.simulate(STEPS * STEP, output=1, method="rk4", step=STEP).diagnostics for _ in range(7)]
    return min(d.seconds / d.right_hand_sides for d in runs)


def table(formulation: str, sizes: list[int]) -> None:
    """Print the rows and the fitted exponents."""
    print(f"\n{formulation}\n{'N':>9}" + "".join(f"{name:>14}" for name in COLUMNS))
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for n in sizes:
            rows.append(measure(n, formulation, Path(folder)))
            print(f"{n:>9}" + "".join(f"{value:>14.4g}" for value in rows[-1]), flush=True)
    fitted = [k for k, n in enumerate(sizes) if n >= 4]
    if len(fitted) < 2:
        return
    exponents = np.polyfit(np.log([sizes[k] for k in fitted]), np.log(np.array(rows)[fitted]), 1)[0]
    print("exponents" + "".join(f"{value:>14.2f}" for value in exponents))
    beyond = [name for name, value in zip(COLUMNS, exponents, strict=True) if value > BAR]
    print(f"asked: at most {BAR}; beyond it: {', '.join(beyond) or 'none'}")


def load_chain(n: int, formulation: str) -> Simulation:
    """Load N four-bars."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"n_four_bar_{n}.yaml"
        file.write_text(yaml_text(n), encoding="utf-8")
        return gudgeon.load(file, formulation=formulation, quick=False)


def drifts(run: Result, n: int) -> tuple[float, float]:
    """Return the largest change of the energy in J, and the largest angle between two cranks in rad."""
    bars = [f"crank{i}" for i in range(n + 1)] + [f"coupler{i}" for i in range(1, n + 1)]
    energy = sum(
        0.5 * (run[f"{bar}.vx"] ** 2 + run[f"{bar}.vy"] ** 2 + BAR_INERTIA * run[f"{bar}.omega"] ** 2)
        + GRAVITY * run[f"{bar}.y"]
        for bar in bars
    )
    cranks = np.stack([run[f"crank{i}.theta"] for i in range(n + 1)])
    return float(np.abs(energy - energy[0]).max()), float(np.abs(cranks - cranks[0]).max())


def tight_runs(formulation: str, sizes: list[int]) -> None:
    """Print runs of 20 s by tolerance, with the smallest processor time of 3 runs."""
    print(f"\n{formulation}, 20 s\n{'rtol':>9}{'N':>5}{'s':>10}{'s/N':>12}{'steps':>9}{'rhs':>9}{'energy [J]':>12}")
    simulations = {n: load_chain(n, formulation) for n in sizes}
    for rtol in TOLERANCES:
        for n, simulation in simulations.items():
            times = []
            for _ in range(3):
                before = time.thread_time()
                run = simulation.simulate(20.0, output=200, rtol=rtol)
                times.append(time.thread_time() - before)
            d, (drift, _) = run.diagnostics, drifts(run, n)
            print(f"{rtol:>9.0e}{n:>5}{min(times):>10.4f}{min(times) / n:>12.5f}", end="")
            print(f"{d.steps:>9}{d.right_hand_sides:>9}{drift:>12.1e}", flush=True)


def long_run(n: int) -> None:
    """Print the energy drift and the parallelism of the cranks over 20 s with all singular positions."""
    run = load_chain(n, "reduced").simulate(20.0, output=2000)
    drift, apart = drifts(run, n)
    turned = float(np.ptp(run["crank0.theta"]) / (2.0 * np.pi))
    print(f"\nN = {n}, 20 s, {turned:.1f} turns, in {run.diagnostics.seconds:.2f} s: ", end="")
    print(f"energy drifts by {drift:.1e} J (asked {DRIFT:.0e}), ", end="")
    print(f"cranks parallel to {apart:.1e} rad (asked {PARALLEL:.0e})")


def main() -> None:
    """Run the benchmark from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--largest", type=int, default=128)
    parser.add_argument("--long", type=int, default=40, help="0: leave it out")
    parser.add_argument("--tight", nargs="+", type=int, default=[], metavar="N", help="20 s by tolerance")
    parser.add_argument("--page", action="store_true", help="measure chains and four-bars, write docs/scaling.md")
    parser.add_argument("--formulation", nargs="+", choices=FORMULATIONS, default=["reduced", "full"])
    options = parser.parse_args()
    if options.page:
        growth.measure_page(options.largest)
        return
    for formulation in options.formulation:
        if options.largest:
            table(formulation, [n for n in (2, 4, 8, 16, 32, 64) if n <= options.largest])
        if options.tight:
            tight_runs(formulation, options.tight)
    if options.long:
        long_run(options.long)


if __name__ == "__main__":
    main()

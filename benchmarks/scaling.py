"""How derivation, emitted code and right-hand side grow with the number of joints: the N-four-bar.

    python benchmarks/scaling.py [--largest 64]

Prints a row for each N and the exponent of each column, fitted over all N ≥ 4 on logarithmic axes
(a straight line through the smallest systems would fit what is constant, the start of SymPy and gcc).
Times are minima of a few runs.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from sympy.core.cache import clear_cache

from gudgeon.build import compile_kernels
from gudgeon.compiled import CompiledModel
from gudgeon.generator.pipeline import derive
from gudgeon.generator.targets.c.emit import emit
from gudgeon.mechanisms.n_four_bar import text as yaml_text
from gudgeon.simulation import Simulation

COLUMNS = ("derive [s]", "emit [s]", "operations", "C [kB]", "compile [s]", "rhs [us]")


def minimum(call: Callable[[], object], repeats: int) -> float:
    """Seconds of the fastest of some runs; SymPy's cache is emptied, or small systems would be in it whole."""
    times = []
    for _ in range(repeats):
        clear_cache()
        before = time.perf_counter()
        call()
        times.append(time.perf_counter() - before)
    return min(times)


def measure(n: int, folder: Path) -> tuple[float, ...]:
    """One row of the table."""
    data, file = yaml_text(n).encode(), folder / f"n_four_bar_{n}.yaml"
    file.write_bytes(data)
    repeats = 3 if n <= 16 else 2
    derived = minimum(lambda: derive(data, file.name, "ideal"), repeats)
    model = derive(data, file.name, "ideal")
    emitted = minimum(lambda: emit(derive(data, file.name, "ideal")), repeats) - derived
    source = emit(model)
    compiled = minimum(lambda: compile_kernels(source, rebuild=True), 1)
    simulation = Simulation(CompiledModel(source, compile_kernels(source)), file)
    size = sum(map(len, source.files.values())) / 1000
    return derived, emitted, source.operations["dynamics"], size, compiled, 1e6 * rhs_seconds(simulation)


def rhs_seconds(simulation: Simulation) -> float:
    """One right-hand side at the start, minimum of 5 batches."""
    model, start = simulation.compiled, simulation.start()
    y = np.concatenate([start.q, start.v, np.zeros(3)])
    memory, count = model.memory_array(None), 20_000

    def batch() -> None:
        pointers = (model.pointer(x) for x in (y, memory, simulation.p))
        model.lib.gudgeon_time_rhs(count, 0.0, *pointers)

    return minimum(batch, 5) / count


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--largest", type=int, default=64)
    largest = parser.parse_args().largest
    sizes = [n for n in (2, 4, 8, 16, 32, 64) if n <= largest]
    print(f"{'N':>4}" + "".join(f"{name:>14}" for name in COLUMNS))
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for n in sizes:
            rows.append(measure(n, Path(folder)))
            print(f"{n:>4}" + "".join(f"{value:>14.4g}" for value in rows[-1]), flush=True)
    fitted = [k for k, n in enumerate(sizes) if n >= 4]
    logs = np.log(np.array(rows)[fitted])
    exponents = np.polyfit(np.log([sizes[k] for k in fitted]), logs, 1)[0]
    print("exponents" + "".join(f"{value:>14.2f}" for value in exponents)[5:])


if __name__ == "__main__":
    main()

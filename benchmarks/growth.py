"""Measure how set-up, right-hand side and run grow with the number of bodies; write docs/scaling.md.

    python -m benchmarks.scaling --page [--largest 128]     # measure, store benchmarks/scaling.csv, write the page
    python -m benchmarks.growth                             # write the page from benchmarks/scaling.csv

Two families: chains of N links (benchmarks/peers/chain_equations.py) and N four-bars side by side (mechanisms/
n_four_bar.py). The reduced formulation is loaded with an empty cache. The text between the marks
`<!-- scaling: name -->` and `<!-- end -->` is generated here; a test compares it with the CSV.
"""

from __future__ import annotations

import csv
import math
import re
import resource
import sys
import tempfile
import time
from dataclasses import astuple, dataclass, fields
from pathlib import Path

import numpy as np
from sympy.core.cache import clear_cache

from benchmarks.peers import chains
from benchmarks.rhs import machine
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.loading.build import compile_kernels
from gudgeon.mechanisms.n_four_bar import text as four_bars_text
from gudgeon.model.compiled import CompiledModel
from gudgeon.simulation.simulation import Simulation
from gudgeon.waiting.imports import pause_garbage_collector

FOLDER = Path(__file__).resolve().parent
CSV, PAGE, FIGURE = FOLDER / "scaling.csv", FOLDER.parent / "docs" / "scaling.md", FOLDER / "figures" / "scaling.png"
SIZES = {"chain": (8, 16, 32, 64, 128), "four_bars": (2, 4, 8, 16, 32, 64)}
T_END, RTOL = 10.0, 1e-8  # of a run, s
STEP, STEPS, RUNS = 1e-3, 100, 5  # runs of rk4 in which a right-hand side is timed
FITTED = 8  # bodies: exponents are fitted from here on


@dataclass(frozen=True)
class Size:
    """Figures of one size: processor times in s (`rhs` in µs), emitted C in kB, arithmetic operations."""

    family: str
    n: int
    bodies: int
    derive: float
    emit: float
    compile: float
    code: float
    operations: int
    rhs: float
    run: float
    steps: int

    @property
    def load(self) -> float:
        """Return the time of the whole load in s."""
        return self.derive + self.emit + self.compile


HEAD = (
    "N",
    "bodies",
    "derive, s",
    "emit, s",
    "compile, s",
    "load, s",
    "C, kB",
    "operations",
    "rhs, µs",
    "run, ms",
    "steps",
)


def processor_time() -> float:
    """Return the processor time of this process and of its finished children, in s."""
    return time.process_time() + sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def text_of(family: str, n: int) -> str:
    """Return the mechanism file of a size."""
    if family == "four_bars":
        return four_bars_text(n)
    wave = [0.4 * math.sin(2.0 * math.pi * (k + 0.5) / 16.0) - 0.5 * math.pi for k in range(n)]
    return chains.written(n, tuple(wave))


def measure(family: str, n: int, folder: Path) -> Size:
    """Return the figures of a size."""
    file = folder / f"{family}_{n}.yaml"
    data = text_of(family, n).encode()
    file.write_bytes(data)
    clear_cache()
    with pause_garbage_collector():  # as in a load
        begin = processor_time()
        model = derive_scene(data, file.name, "ideal")
        derived = processor_time()
        source = generate_c(model, "reduced")
        emitted = processor_time()
    library = compile_kernels(source, rebuild=True)
    compiled = processor_time()
    simulation = Simulation(CompiledModel(source, library), file)
    times, rhs = [], math.inf
    for _ in range(RUNS):
        short = simulation.simulate(STEPS * STEP, output=1, method="rk4", step=STEP).diagnostics
        rhs = min(rhs, short.seconds / short.right_hand_sides)
    for _ in range(RUNS):
        before = time.thread_time()
        run = simulation.simulate(T_END, output=1, rtol=RTOL)
        times.append(time.thread_time() - before)
    return Size(
        family,
        n,
        len(run.source.coordinates) // 3,
        derived - begin,
        emitted - derived,
        compiled - emitted,
        sum(map(len, source.files.values())) / 1000,
        source.operations["reduced_dynamics"],
        1e6 * rhs,
        min(times),
        run.diagnostics.steps,
    )


def measure_page(largest: int) -> None:
    """Measure all sizes with at most so many links or four-bars, store them, write the page."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        measure("chain", min(SIZES["chain"]), Path(folder))  # imports SymPy, starts the compiler: not counted
        for family, sizes in SIZES.items():
            for n in (n for n in sizes if n <= largest):
                rows.append(measure(family, n, Path(folder)))
                print(rows[-1], flush=True)
    facts = {"machine": machine(), "python": sys.version.split()[0]}
    write(facts, rows)
    main()


def write(facts: dict[str, str], rows: list[Size]) -> None:
    """Write the CSV file."""
    with CSV.open("w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {name}: {value}\n" for name, value in facts.items())
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([field.name for field in fields(Size)])
        for row in rows:
            writer.writerow([f"{x:.4g}" if isinstance(x, float) else x for x in astuple(row)])


def read() -> tuple[dict[str, str], list[Size]]:
    """Return facts and rows of the CSV file."""
    lines = CSV.read_text(encoding="utf-8").splitlines()
    facts = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    kinds = {"str": str, "int": int, "float": float}
    return facts, [
        Size(*(kinds[str(field.type)](cells[field.name]) for field in fields(Size)))
        for cells in csv.DictReader(line for line in lines if not line.startswith("# "))
    ]


def cells(row: Size) -> list[float]:
    """Return the figures of a row in the order of HEAD."""
    times = (row.derive, row.emit, row.compile, row.load)
    return [row.n, row.bodies, *times, row.code, row.operations, row.rhs, 1e3 * row.run, row.steps]


def table(rows: list[Size]) -> list[str]:
    """Return the table of a family, with the exponents of each column over the number of bodies as the last row.

    The column `bodies` is left out if each N is the number of bodies.
    """
    from benchmarks.race.page import grid, number

    body = [[f"{x:,}" if isinstance(x, int) else number(x) for x in cells(row)] for row in rows]
    fitted = [row for row in rows if row.bodies >= FITTED]
    if len(fitted) > 1:
        logs = np.log([[*cells(row)[2:]] for row in fitted])
        slopes = np.polyfit(np.log([row.bodies for row in fitted]), logs, 1)[0]
        body.append(["exponent", "", *(f"{round(slope, 2) + 0.0:.2f}" for slope in slopes)])
    columns = [k for k, name in enumerate(HEAD) if name != "bodies" or any(row.n != row.bodies for row in rows)]
    return grid([HEAD[k] for k in columns], [[row[k] for k in columns] for row in body])


def filled(page: str) -> str:
    """Return the page with the texts between its marks replaced."""
    facts, rows = read()
    texts = {family: table([row for row in rows if row.family == family]) for family in SIZES}
    texts["machine"] = [f"- {name}: {value}" for name, value in facts.items()]

    def put(found: re.Match[str]) -> str:
        """Return the text of a mark."""
        return f"<!-- scaling: {found[1]} -->\n{chr(10).join(texts[found[1]])}\n<!-- end -->"

    return re.sub(r"<!-- scaling: (\w+) -->\n.*?<!-- end -->", put, page, flags=re.S)


def draw() -> None:
    """Draw load, right-hand side and run over the number of bodies, log-log."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    _, rows = read()
    figure, axes = plt.subplots(1, 3, figsize=(10.0, 3.4), layout="constrained")
    titles = ("load, s", "right-hand side, µs", "run of 10 s, ms")
    for axis, title, column in zip(axes, titles, (5, 8, 9), strict=True):
        for family in SIZES:
            own = [row for row in rows if row.family == family]
            axis.loglog([r.bodies for r in own], [cells(r)[column] for r in own], "o-", label=family.replace("_", "-"))
        axis.set(title=title, xlabel="bodies")
        axis.grid(True, which="major", alpha=0.3)
    axes[0].legend()
    figure.savefig(FIGURE, dpi=100, metadata={"Software": None})
    plt.close(figure)


def main() -> None:
    """Write the page and its figure from the CSV."""
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    draw()


if __name__ == "__main__":
    main()

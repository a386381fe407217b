"""`gudgeon bench` and `gudgeon stress`: scenes from the command line, measured, shown, written."""

from __future__ import annotations

from pathlib import Path

from gudgeon.bench import SceneBench, bench
from gudgeon.commands.common import chosen_scenes, value
from gudgeon.commands.progress import progress_bar
from gudgeon.errors import BadValueError
from gudgeon.kernel_source import Slot
from gudgeon.loading import load
from gudgeon.measure.show import show_bench, show_stress
from gudgeon.parameters import number
from gudgeon.simulation import Simulation
from gudgeon.stress import StressMap, default_steps, stress

INTERRUPTED = 130


def bench_file(
    file: str, scenes: tuple[str, ...] = (), out: Path = Path("out"), quick: bool = False, mark: str | None = None
) -> int:
    """Measure, print, write `<mechanism>_bench.csv` and `.png`; the exit code."""
    step, loaded = _step(mark), _load(file, scenes)
    found: list[SceneBench] = []
    code = 0
    with progress_bar() as bar:
        try:
            for simulation in loaded:
                found.append(bench(simulation, quick=quick, progress=bar(simulation.source.scene)))
        except KeyboardInterrupt:  # the scenes that are complete are shown
            code = INTERRUPTED
    if found:
        show_bench(loaded[0].source, found, out, step)
    return code


def stress_file(
    file: str, scenes: tuple[str, ...] = (), out: Path = Path("out"), quick: bool = False, mark: str | None = None
) -> int:
    """Judge, print, write `<mechanism>_stress.csv` and `.png`; the exit code."""
    step, loaded = _step(mark), _load(file, scenes)
    moving = [simulation for simulation in loaded if simulation.source.degrees_of_freedom != 0]
    for simulation in loaded:
        if simulation not in moving:
            print(f"{simulation.source.scene}: no degree of freedom, nothing is integrated, no step to choose")
    found: list[StressMap] = []
    code = 0
    with progress_bar() as bar:
        try:
            for simulation in moving:
                bar_of_scene = bar(simulation.source.scene)
                found.append(stress(simulation, default_steps(moving, quick), quick=quick, progress=bar_of_scene))
        except KeyboardInterrupt:
            code = INTERRUPTED
    if found:
        show_stress(moving[0].source, found, out, step)
    return code


def _load(file: str, scenes: tuple[str, ...]) -> list[Simulation]:
    return [load(file, scene) for scene in chosen_scenes(file, scenes)]


def _step(mark: str | None) -> float | None:
    if mark is None:
        return None
    step = number(value(mark), Slot("--mark-step", "s", 0.0, False, (0, 0, 1)))
    if not step > 0:
        raise BadValueError(f"--mark-step is {step:g} s: expected a positive time")
    return step

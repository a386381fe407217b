"""`gudgeon bench` and `gudgeon stress`: scenes from the command line, measured, shown, written."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from gudgeon.bench import SceneBench, bench
from gudgeon.commands.common import chosen_scenes, need_suffix, unknown, value
from gudgeon.commands.progress import Report, progress_bar
from gudgeon.commands.run import addresses
from gudgeon.errors import BadValueError
from gudgeon.kernel_source import Slot
from gudgeon.loading import load
from gudgeon.measure.axes import axis, typed
from gudgeon.measure.box import Range
from gudgeon.measure.show_bench import show_bench
from gudgeon.measure.show_stress import show_box, show_stress
from gudgeon.measure.work import FIXED, Setting, natural_step
from gudgeon.parameters import number, prepare
from gudgeon.simulation import Simulation
from gudgeon.stress import USUAL, StressBox, StressMap, default_steps, stress, stress_box

INTERRUPTED = 130
METHODS = ("auto", "dop853", "rodas5p", "rk4")
Found = TypeVar("Found")


@dataclass(frozen=True)
class Request:
    """What both commands are asked for, as typed."""

    file: str
    scenes: tuple[str, ...] = ()
    sets: tuple[str, ...] = ()
    t_end: str | None = None
    out: Path = Path("out")
    csv: Path | None = None
    quick: bool = False
    mark: str | None = None
    json: bool = False

    @property
    def parameters(self) -> dict[str, float | str]:
        """--set ADDRESS=VALUE."""
        found = {}
        for text in self.sets:
            name, _, told = text.partition("=")
            if not (name.strip() and told.strip()):
                raise BadValueError(f"--set {text}: expected ADDRESS=VALUE")
            found[name.strip()] = value(told)
        return found

    def of(self, simulation: Simulation) -> dict[str, float | str]:
        """The settings that a scene knows: an ideal scene has no viscosity."""
        known = set(addresses(simulation))
        return {name: told for name, told in self.parameters.items() if name in known}

    def seconds(self, option: str, text: str | None) -> float | None:
        """A positive time (s) that was typed, or None."""
        if text is None:
            return None
        found = number(value(text), Slot(option, "s", 0.0, False, (0, 0, 1)))
        if not found > 0:
            raise BadValueError(f"{option} is {found:g} s: expected a positive time")
        return found

    def table(self, mechanism: str, what: str) -> Path:
        """Where the CSV goes; pictures go beside it."""
        if self.csv is not None:
            need_suffix(self.csv, (".csv",))
        return self.csv or self.out / f"{mechanism}_{what}.csv"


@dataclass(frozen=True)
class Stress:
    """What only `stress` is asked for."""

    method: str = "auto"
    at: str | None = None  # a step or a tolerance, where no axis is one
    axes: tuple[str, ...] = ()
    box: int | None = None
    ranges: tuple[str, ...] = ()


def bench_file(request: Request) -> int:
    """Measure, print, write the table and the picture; the exit code."""
    step, t_end = request.seconds("--mark-step", request.mark), request.seconds("--t-end", request.t_end)
    loaded = _load(request)
    table = request.table(loaded[0].source.mechanism, "bench")

    def one(simulation: Simulation, report: Report | None) -> SceneBench:
        return bench(simulation, t_end=t_end, parameters=request.of(simulation), quick=request.quick, progress=report)

    found, code = _each(loaded, one, request.json)
    if found:
        show_bench(loaded[0].source, found, table, step, request.json)
    return code


def stress_file(request: Request, asked: Stress) -> int:
    """Judge, print, write the table and the picture; the exit code."""
    step, t_end = request.seconds("--mark-step", request.mark), request.seconds("--t-end", request.t_end)
    if asked.method not in METHODS:
        raise BadValueError(f"--method {asked.method!r}: expected {', '.join(METHODS)}")
    loaded = _load(request)
    moving = [simulation for simulation in loaded if simulation.source.degrees_of_freedom != 0]
    if not request.json:
        for simulation in loaded:
            if simulation not in moving:
                print(f"{simulation.source.scene}: no degree of freedom, nothing is integrated, no step to choose")
    if not moving:
        return 0
    source = moving[0].source
    table = request.table(source.mechanism, "stress")
    if asked.box is not None:
        return _box(request, asked, moving, t_end, table)
    wanted, steps = _value(asked), default_steps(moving, request.quick)

    def one(simulation: Simulation, report: Report | None) -> StressMap:
        parameters = request.of(simulation)
        axes = [typed(simulation, text, parameters) for text in asked.axes]
        if asked.method in FIXED and not any(a.of_method for a in axes) and len(axes) < 2:
            axes = [axis(simulation, "step", steps), *axes]
        return stress(
            simulation, axes, method=asked.method, value=wanted, t_long=t_end, parameters=parameters,
            quick=request.quick, progress=report,
        )  # fmt: skip

    found, code = _each(moving, one, request.json)
    if found:
        show_stress(source, found, table, step, request.json)
    return code


def _box(request: Request, asked: Stress, moving: Sequence[Simulation], t_end: float | None, table: Path) -> int:
    wanted = _value(asked)

    def one(simulation: Simulation, report: Report | None) -> StressBox:
        parameters = request.of(simulation)
        axes = {a.name: a for a in (typed(simulation, text, parameters) for text in asked.ranges)}
        ranges = [Range(a.name, a.values[0], a.values[-1]) for a in axes.values()]
        usual = natural_step(simulation, parameters) if asked.method in FIXED else USUAL
        return stress_box(
            simulation, ranges, asked.box or 0, setting=Setting(asked.method, wanted or usual), t_long=t_end,
            parameters=parameters, addresses=axes, progress=report,
        )  # fmt: skip

    found, code = _each(moving, one, request.json)
    if found:
        show_box(moving[0].source, found, table, request.json)
    return code


def _value(asked: Stress) -> float | None:
    """The step (s) or tolerance of --at."""
    if asked.at is None:
        return None
    fixed = asked.method in FIXED
    found = number(value(asked.at), Slot("--at", "s" if fixed else "", 0.0, False, (0, 0, 1 if fixed else 0)))
    if not 0 < found < (float("inf") if fixed else 1):
        raise BadValueError(f"--at {asked.at}: expected a positive step, or a tolerance between 0 and 1")
    return found


def _each(
    loaded: Sequence[Simulation], one: Callable[[Simulation, Report | None], Found], quiet: bool
) -> tuple[list[Found], int]:
    """Scene by scene; after Ctrl-C those that are complete."""
    found: list[Found] = []
    with progress_bar(quiet) as bar:
        try:
            for simulation in loaded:
                found.append(one(simulation, bar(simulation.source.scene)))
        except KeyboardInterrupt:
            return found, INTERRUPTED
    return found, 0


def _load(request: Request) -> list[Simulation]:
    """All scenes, and their parameters checked once before anything runs."""
    loaded = [load(request.file, scene) for scene in chosen_scenes(request.file, request.scenes)]
    known = tuple(dict.fromkeys(address for simulation in loaded for address in addresses(simulation)))
    for name in request.parameters:
        if name not in known:
            raise unknown(f"--set: no scene has a number {name!r}", name, known)
    for simulation in loaded:
        prepare(simulation.compiled, request.of(simulation))
    return loaded

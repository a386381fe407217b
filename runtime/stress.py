"""`gudgeon stress`: step × clearance, each cell stable, inaccurate, diverged or outside the model.

Each cell is two questions. Does a run over a good part of the motion stay sane (finite, closed, its
energy accounted for)? And does it agree with a ten times shorter step over the first few contacts?
`cells.Limits` has the numbers, every cell its reason.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass

from gudgeon.errors import BadValueError
from gudgeon.measure.cells import Cell, Limits, Status, judge
from gudgeon.measure.work import NAN, Attempt, Parameters, Work, natural_step, round_numbers, window
from gudgeon.parameters import prepare
from gudgeon.simulation import Simulation
from gudgeon.step import scene_end

LONG, SHORT = 300_000, 1_000_000  # steps of the two windows with the shortest step (of the reference)
COARSEST = 200  # the longest step, of the shortest scene's
CLEARANCES = (1 / 6, 10 / 3)  # the axis, of the file's clearance
FINER = 10

Report = Callable[[float, str], None]


@dataclass(frozen=True)
class StressMap:
    """The cells of one scene, column by column (ascending clearance), ascending step."""

    scene: str
    joint: str  # whose clearance the axis shows; "" without play
    cells: tuple[Cell, ...]
    t_long: float  # s, over which stability is judged
    limits: Limits

    @property
    def steps(self) -> tuple[float, ...]:
        """The step axis, s."""
        return tuple(dict.fromkeys(cell.step for cell in self.cells))

    @property
    def clearances(self) -> tuple[float, ...]:
        """The clearance axis, m; (NaN,) without play."""
        return tuple(dict.fromkeys(cell.clearance for cell in self.cells))

    def cell(self, step: float, clearance: float) -> Cell:
        """One cell; KeyError if it is not in the map."""
        for cell in self.cells:
            if cell.step == step and (cell.clearance == clearance or clearance != clearance):
                return cell
        raise KeyError((step, clearance))

    def largest_stable(self, clearance: float) -> float:
        """The largest step with which it and every shorter step of the grid is stable; NaN: none."""
        best = NAN
        for step in self.steps:
            if self.cell(step, clearance).status is not Status.STABLE:
                break
            best = step
        return best


def stress(
    simulation: Simulation, steps: Sequence[float] | None = None, clearances: Sequence[float] | None = None, *,
    t_long: float | None = None, t_short: float | None = None, parameters: Parameters | None = None,
    limits: Limits | None = None, quick: bool = False, progress: Report | None = None,
) -> StressMap:  # fmt: skip
    """Judge every pair. `clearances` (m) are the first joint's with play; the others keep their ratio to it.

    `t_long` (s) is the run over which a step has to stay stable, `t_short` bounds the window in which it
    is compared with a tenth of itself (see `window`); `parameters` as in `simulate`; `quick` takes a few
    pairs. Raises BadValueError for a scene in which nothing is integrated.
    """
    if simulation.source.degrees_of_freedom == 0:
        raise BadValueError(
            f"scene {simulation.source.scene!r} has no degree of freedom: there is no step to choose"
        )
    limits, report = limits or Limits(), progress or (lambda fraction, text: None)
    usual = natural_step(simulation, parameters)
    steps = tuple(sorted(steps or default_steps([simulation], quick)))
    if not steps or not steps[0] > 0:
        raise BadValueError("steps: expected positive times (s)")
    columns = _columns(simulation, clearances, parameters or {}, quick)
    t_long = t_long or min(scene_end(simulation.source), LONG * steps[0] / (10 if quick else 1))
    longest = t_short or SHORT * steps[0] / FINER / (10 if quick else 1)
    with _Pool(report, len(columns)) as pool:
        found = pool.map(
            lambda column, tick: _column(simulation, column, steps, usual, t_long, longest, limits, tick), columns
        )
    first = simulation.source.clearances[0].name if simulation.source.clearances else ""
    return StressMap(simulation.source.scene, first, tuple(c for cells in found for c in cells), t_long, limits)


def default_steps(simulations: Sequence[Simulation], quick: bool = False) -> tuple[float, ...]:
    """1, 2, 5 · 10^k from the shortest step of a plain run of any of the scenes."""
    usual = min(natural_step(simulation) for simulation in simulations)
    steps = round_numbers(usual, COARSEST * usual)
    return steps[3::2] if quick else steps


def default_clearances(c: float, quick: bool = False) -> tuple[float, ...]:
    """1, 2, 5 · 10^k m around the file's clearance, and that itself."""
    if quick:
        return (c,)
    return tuple(sorted({*round_numbers(CLEARANCES[0] * c, CLEARANCES[1] * c), float(f"{c:.6g}")}))


@dataclass(frozen=True)
class _Column:
    clearance: float
    parameters: dict[str, float | str]


def _columns(
    simulation: Simulation, clearances: Sequence[float] | None, parameters: Parameters, quick: bool
) -> list[_Column]:
    """The values that the file's conditions allow (a clearance stays below its bearing's radius)."""
    source, p = simulation.source, prepare(simulation.compiled, parameters)[0]
    joints = source.clearances
    if not joints:
        return [_Column(NAN, dict(parameters))]
    own = {source.slots[j.clearance].address: float(p[j.clearance]) for j in joints if j.clearance < len(source.slots)}
    usual = float(p[joints[0].clearance])
    found = []
    for c in clearances or default_clearances(usual, quick):
        column = _Column(c, {**parameters, **{address: value * c / usual for address, value in own.items()}})
        try:
            prepare(simulation.compiled, column.parameters)
        except BadValueError:
            if clearances:
                raise
            continue
        found.append(column)
    return found


def _column(
    simulation: Simulation, column: _Column, steps: Sequence[float], usual: float, t_long: float, longest: float,
    limits: Limits, tick: Report,
) -> list[Cell]:  # fmt: skip
    """All steps of one clearance: long runs, and short ones that serve as references for each other."""
    short = window(simulation, longest, min(usual, steps[0]), column.parameters)
    long = Work(simulation, t_long, column.parameters)
    every = sorted({_key(x) for step in steps for x in (step, step / FINER)}, reverse=True)
    jobs = [(work, step) for work, wanted in ((short, every), (long, steps)) for step in wanted]
    cost, done = sum(work.t_end / step for work, step in jobs), 0.0
    found: dict[tuple[Work, float], Attempt] = {}
    for work, step in jobs:
        share = work.t_end / step / cost
        found[work, _key(step)] = work.run(step, _part(tick, done, share))
        done += share
    cells = []
    for step in steps:
        own, tenth = _key(step), _key(step / FINER)
        pairs = [(found[short, own], found[short, tenth])]
        fine = found.get((long, tenth))
        if fine is not None and fine.run is not None and not len(fine.run.impacts):
            pairs.append((found[long, own], fine))  # without contact errors mean something for longer
        cells.append(judge(step, column.clearance, found[long, own], pairs, limits))
    return cells


def _key(step: float) -> float:
    """A step as its few digits, so that it is found again after a division."""
    return float(f"{step:.6g}")


def _part(tick: Report, done: float, share: float) -> Report:
    """A run's progress as a part of its column's."""
    return lambda fraction, text: tick(done + share * fraction, text)


class _Pool:
    """Columns on as many threads as there are cores; Ctrl-C ends them at their next report."""

    def __init__(self, report: Report, count: int) -> None:
        self.report, self.fractions, self.stop = report, [0.0] * count, threading.Event()
        self.lock = threading.Lock()

    def __enter__(self) -> _Pool:
        self.executor = ThreadPoolExecutor(min(len(self.fractions), os.cpu_count() or 1))
        return self

    def __exit__(self, *_: object) -> None:
        self.stop.set()
        self.executor.shutdown(wait=True, cancel_futures=True)

    def map(self, function: Callable[[_Column, Report], list[Cell]], columns: Sequence[_Column]) -> list[list[Cell]]:
        """Like the built-in, in order."""
        futures = [self.executor.submit(function, column, self._tick(i)) for i, column in enumerate(columns)]
        for future in as_completed(futures):
            future.result()
        return [future.result() for future in futures]

    def _tick(self, i: int) -> Report:
        def tick(fraction: float, text: str) -> None:
            if self.stop.is_set():
                raise KeyboardInterrupt
            with self.lock:
                self.fractions[i] = fraction
                self.report(sum(self.fractions) / len(self.fractions), "")

        return tick

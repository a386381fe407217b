"""Judge a map or a box of runs, each stable, inaccurate, diverged or outside the model: `gudgeon map`.

Two criteria apply to a run. It must remain valid over a good part of the motion: finite, closed, energy accounted for,
no contact lost. It must also agree with a finer run, a tenth of the step or a hundredth of the tolerance, over the
first few contacts. `verdicts.Limits` has the numbers; every cell has its reason.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import (
    flag,
    function,
    instance,
    listed,
    mapping,
    optional,
    optional_positive,
    text,
    whole,
)
from gudgeon.model.default_step import plain_end
from gudgeon.model.parameters import prepare
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.axes import GAINS, Axis, axis, clearances
from gudgeon.studies.box import Range, corners, judge_point, sobol
from gudgeon.studies.runs import FIXED, NAN, Attempt, Parameters, Setting, Work, natural_step, round_numbers, window
from gudgeon.studies.threads import Pool, Report
from gudgeon.studies.verdicts import Cell, Limits, Status, check_room, judge, not_judged

LONG, SHORT = 300_000, 1_000_000  # steps of the two windows with the shortest step (of the reference)
COARSEST = 200  # the longest step, of the shortest scene's
CLEARANCES = (1 / 6, 10 / 3)  # the axis, of the file's clearance
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
USUAL = 1e-8  # tolerance where neither axis is one
FINER = 10
MOST_POINTS = 10**6
LIMIT = 120.0  # s of processor time of a run


class _Verdicts:
    """Base class of maps and boxes that Ctrl-C may leave incomplete."""

    cells: tuple[Cell, ...]

    @property
    def done(self) -> tuple[int, int]:
        """Number of judged cells, and of all cells."""
        return _count_judged(self.cells)

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C left cells that are not judged."""
        return any(cell.status is Status.MISSING for cell in self.cells)


@dataclass(frozen=True)
class VerdictMap(_Verdicts):
    """The cells of one scene over two axes, column by column; both axes ascend."""

    scene: str
    setting: Setting  # its value counts where neither axis is the method's
    rows: Axis
    columns: Axis
    cells: tuple[Cell, ...]
    t_long: float  # s, over which stability is judged
    full: bool = False  # whether the full formulation is used, in which Baumgarte's gains act

    def cell(self, row: float, column: float) -> Cell:
        """Return the cell at values of both axes. Raises KeyError if the map does not have it."""
        if row not in self.rows.values or (column not in self.columns.values and column == column):
            raise KeyError((row, column))
        place = self.columns.values.index(column) if column == column else 0
        return self.cells[place * len(self.rows.values) + self.rows.values.index(row)]

    def largest_stable(self, column: float) -> float:
        """Return the largest row value up to which every cell of the column is stable; NaN if there is none."""
        best = NAN
        for row in self.rows.values:
            if self.cell(row, column).status is not Status.STABLE:
                break
            best = row
        return best


@dataclass(frozen=True)
class VerdictBox(_Verdicts):
    """The cells of all corners of a box, then of Sobol points in it."""

    scene: str
    setting: Setting
    ranges: tuple[Range, ...]
    points: tuple[Mapping[str, float], ...]  # of the cells: range -> value
    cells: tuple[Cell, ...]
    t_long: float
    full: bool = False


def verdict_map(
    simulation: Simulation,
    axes: Sequence[Axis] = (),
    *,
    method: str = "auto",
    value: float | None = None,
    t_long: float | None = None,
    t_short: float | None = None,
    parameters: Parameters | None = None,
    limits: Limits | None = None,
    quick: bool = False,
    progress: Report | None = None,
) -> VerdictMap:
    """Judge every pair of values of at most two axes (`gudgeon.measure.axes`), by default tolerance (rk4: step) ×
    clearance.

    `value`: the step or tolerance if neither axis is one. `t_long` (s) is the run over which a cell must remain valid;
    `t_short` bounds the window in which a step is compared with a tenth of itself (see `window`). `parameters` as in
    `simulate`; `quick` judges a few pairs. After Ctrl-C the cells so far are returned, the others as Status.MISSING.
    Raises BadValueError for a scene that is not integrated or axes that do not fit, MemoryError for too many cells.
    """
    _check_dynamic(simulation)
    axes, method = listed(axes, "axes", Axis, "a list of Axis"), text(method, "method")
    limits, quick = optional(limits, "limits", Limits), flag(quick, "quick")
    t_long, t_short = optional_positive(t_long, "t_long"), optional_positive(t_short, "t_short")
    value, progress = optional_positive(value, "value"), function(progress, "progress")
    given, full = dict(mapping(parameters, "parameters")), needs_full(axes, method)
    simulation = simulation.full if full else simulation
    rows, columns = arrange(simulation, axes, method, given, quick)
    usual = Setting(method, value or (natural_step(simulation, given) if method in FIXED else USUAL))
    check_room(len(rows.values) * len(columns.values))
    jobs = _make_jobs(simulation, rows, columns, usual, given)
    least = min(setting.value for job in jobs for setting in job.settings) if usual.fixed else math.inf
    t_long = t_long or min(plain_end(simulation.compiled, given), LONG * least) / (10 if quick else 1)
    longest = t_short or SHORT * least / FINER / (10 if quick else 1)
    with Pool[_Job, list[Cell]](progress or (lambda fraction, text: None), len(jobs)) as pool:
        found = pool.map(lambda job, tick: _judge_job(simulation, job, t_long, longest, limits, tick), jobs)
    missing = ([not_judged(job.parameters, setting) for setting in job.settings] for job in jobs)
    cells = tuple(cell for own, none in zip(found, missing, strict=True) for cell in own or none)
    return VerdictMap(simulation.source.scene, usual, rows, columns, cells, t_long, full)


def arrange(
    simulation: Simulation, axes: Sequence[Axis], method: str, parameters: Parameters, quick: bool = False
) -> tuple[Axis, Axis]:
    """Return rows and columns of the map: the method's own axis is the rows; missing axes have defaults."""
    own, others = [a for a in axes if a.of_method], [a for a in axes if not a.of_method]
    expected = "step" if method in FIXED else "rtol"
    if len(axes) > 2 or len(own) > 1 or len({a.name for a in axes}) < len(axes):
        raise BadValueError(f"axes {', '.join(a.name for a in axes)}: expected two different ones, step or rtol once")
    if own and own[0].name != expected:
        raise BadValueError(f"axis {own[0].name} does not fit: method {method} takes a {expected}")
    if any(not value > 0 for a in own for value in a.values):
        raise BadValueError(f"axis {expected}: expected positive values")
    if len(others) == 2:
        return others[1], others[0]
    if not own:
        tolerances = TOLERANCES[1:3] if quick else TOLERANCES
        own = [axis(simulation, expected, default_steps([simulation], quick) if method in FIXED else tolerances)]
    return own[0], others[0] if others else _usual_clearances(simulation, parameters, quick)


def verdict_box(
    simulation: Simulation,
    ranges: Sequence[Range],
    count: int,
    *,
    setting: Setting | None = None,
    t_long: float | None = None,
    parameters: Parameters | None = None,
    limits: Limits | None = None,
    addresses: Mapping[str, Axis] | None = None,
    quick: bool = False,
    progress: Report | None = None,
) -> VerdictBox:
    """Judge all corners of the box and `count` Sobol points.

    `addresses`: axes for names that are groups; `quick`: over a tenth of the time. Other arguments are as in
    `verdict_map`.
    """
    _check_dynamic(simulation)
    ranges, count = listed(ranges, "ranges", Range, "a list of Range"), whole(count, "count", 0, MOST_POINTS)
    limits, quick = optional(limits, "limits", Limits), flag(quick, "quick")
    t_long, parameters = optional_positive(t_long, "t_long"), mapping(parameters, "parameters")
    progress, setting = function(progress, "progress"), optional(setting, "setting", Setting) or Setting("auto", USUAL)
    if not ranges:
        raise BadValueError("a box wants ranges: --range name=low..high")
    t_long = t_long or plain_end(simulation.compiled, parameters) / (10 if quick else 1)
    known = {name: instance(edge, f"addresses: {name}", Axis) for name, edge in mapping(addresses, "addresses").items()}
    full = needs_full([known.get(edge.name) or axis(simulation, edge.name, ()) for edge in ranges], setting.method)
    simulation = simulation.full if full else simulation

    def moved(point: Mapping[str, float]) -> dict[str, float | str]:
        """Return the parameters of `simulate` at a point."""
        own = (known[name].parameters(x) if name in known else {name: x} for name, x in point.items())
        return dict(parameters) | {address: x for part in own for address, x in part.items()}

    def one(point: Mapping[str, float], tick: Report) -> Cell:
        """Judge one point."""
        return judge_point(simulation, moved(point), t_long, setting, limits, LIMIT, tick)

    check_room(2.0 ** len(ranges) + count)
    points = [*corners(ranges), *sobol(ranges, count)]
    for point in points:
        prepare(simulation.compiled, moved(point))
    with Pool[Mapping[str, float], Cell](progress or (lambda fraction, text: None), len(points)) as pool:
        found = pool.map(one, points)
    cells = tuple(cell or not_judged(moved(point), setting) for cell, point in zip(found, points, strict=True))
    return VerdictBox(simulation.source.scene, setting, tuple(ranges), tuple(points), cells, t_long, full)


def needs_full(axes: Sequence[Axis], method: str) -> bool:
    """Return whether an axis sets Baumgarte's gains, which act in the full formulation with rk4 only.

    Raises BadValueError for gains with another method, since those project onto the constraints.
    """
    moved = next((a.name for a in axes if any(address in GAINS for address, _ in a.ratios)), "")
    if moved and method != "rk4":
        raise BadValueError(f"axis {moved}: method {method!r} projects and has no gains", hint="take --method rk4")
    return bool(moved)


def _count_judged(cells: Sequence[Cell]) -> tuple[int, int]:
    """Return the number of judged cells, and of all cells."""
    return sum(cell.status is not Status.MISSING for cell in cells), len(cells)


def default_steps(simulations: Sequence[Simulation], quick: bool = False) -> tuple[float, ...]:
    """Return steps 1, 2, 5 · 10^k from the shortest step of a plain run of any of the scenes."""
    usual = min(natural_step(simulation) for simulation in simulations)
    steps = round_numbers(usual, COARSEST * usual)
    return steps[3::2] if quick else steps


def default_clearances(c: float, quick: bool = False) -> tuple[float, ...]:
    """Return clearances 1, 2, 5 · 10^k m around the clearance c of the file, and c itself."""
    if quick:
        return (c,)
    return tuple(sorted({*round_numbers(CLEARANCES[0] * c, CLEARANCES[1] * c), float(f"{c:.6g}")}))


def _usual_clearances(simulation: Simulation, parameters: Parameters, quick: bool) -> Axis:
    """Return the default axis of clearances, without those that violate conditions of the file.

    A clearance must stay below its bearing's radius.
    """
    if not simulation.source.clearances:
        return clearances(simulation, ())
    p = prepare(simulation.compiled, parameters)[0]
    usual = float(p[simulation.source.clearances[0].clearance])
    found = clearances(simulation, default_clearances(usual, quick), parameters)
    allowed = []
    for c in found.values:
        try:
            prepare(simulation.compiled, {**parameters, **found.parameters(c)})
        except BadValueError:
            continue
        allowed.append(c)
    return replace(found, values=tuple(allowed))


@dataclass(frozen=True)
class _Job:
    """One set of parameters with all settings to judge."""

    parameters: dict[str, float | str]
    settings: tuple[Setting, ...]


def _check_dynamic(simulation: Simulation) -> None:
    """Raise BadValueError for a scene without degrees of freedom."""
    if simulation.source.degrees_of_freedom == 0:
        raise BadValueError(f"scene {simulation.source.scene!r} has no degree of freedom: there is no step to choose")


def _make_jobs(
    simulation: Simulation, rows: Axis, columns: Axis, usual: Setting, given: dict[str, float | str]
) -> list[_Job]:
    """Return the jobs column by column; their cells in order are those of the map. Raises BadValueError for a bad
    value.
    """
    found = []
    for x in columns.values:
        if rows.of_method:
            settings = tuple(Setting(usual.method, y) for y in rows.values)
            moved = {**given, **columns.parameters(x)}
            # fixed steps are references for each other, tolerances are judged alone
            found += [_Job(moved, settings)] if usual.fixed else [_Job(moved, (setting,)) for setting in settings]
            continue
        for y in rows.values:
            found.append(_Job({**given, **columns.parameters(x), **rows.parameters(y)}, (usual,)))
    for job in found:
        prepare(simulation.compiled, job.parameters)
    return found


def _judge_job(
    simulation: Simulation, job: _Job, t_long: float, longest: float, limits: Limits | None, tick: Report
) -> list[Cell]:
    """Return the cells of a job; a tolerance is judged like a point of a box."""
    if job.settings[0].fixed:
        return _judge_steps(simulation, job, t_long, longest, limits, tick)
    return [judge_point(simulation, job.parameters, t_long, job.settings[0], limits, LIMIT, tick)]


def _judge_steps(
    simulation: Simulation, job: _Job, t_long: float, longest: float, limits: Limits | None, tick: Report
) -> list[Cell]:
    """Return the cells of a job with fixed steps, from long runs and short ones over the first contacts."""
    steps = [setting.finer(1) for setting in job.settings]
    usual = min(natural_step(simulation), *(setting.value for setting in steps))
    short = window(simulation, longest, Setting("rk4", usual), job.parameters)
    long = Work(simulation, t_long, job.parameters)
    every = sorted({x for step in steps for x in (step, step.finer(FINER))}, key=lambda x: -x.value)
    pieces = [(work, step) for work, expected in ((short, every), (long, steps)) for step in expected]
    cost, done = sum(work.t_end / step.value for work, step in pieces), 0.0
    found: dict[tuple[Work, Setting], Attempt] = {}
    for work, step in pieces:
        share = work.t_end / step.value / cost
        found[work, step] = work.run(step, _partial_progress(tick, done, share))
        done += share
    cells = []
    for step in steps:
        tenth = step.finer(FINER)
        pairs = [(found[short, step], found[short, tenth])]
        fine = found.get((long, tenth))
        if fine is not None and fine.run is not None and not len(fine.run.impacts):
            pairs.append((found[long, step], fine))  # without contact errors mean something for longer
        cells.append(judge(job.parameters, found[long, step], pairs, limits))
    return cells


def _partial_progress(tick: Report, done: float, share: float) -> Report:
    """Return a progress function for a run that is a fraction `share` of its job, after `done`."""
    return lambda fraction, text: tick(done + share * fraction, text)

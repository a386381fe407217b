"""Sweep parameters over a grid or a box, and classify the runs as stable, inaccurate, diverged or outside the model.

Two criteria apply to a run. It must remain valid over a long part of the motion: finite, constraints satisfied, energy
balanced, no contact missed. It must also agree with a finer run, a tenth of the step or a hundredth of the tolerance,
over the first few contacts. `verdicts.Limits` has the numbers; every cell has its reason.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import (
    check_callable,
    check_flag,
    check_instance,
    check_integer,
    check_list,
    check_mapping,
    check_optional_instance,
    check_optional_positive,
    check_text,
)
from gudgeon.model.default_step import evaluate_file_end_time
from gudgeon.model.parameters import compute_parameter_values
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.axes import GAINS, Axis, make_axis, make_clearance_axis
from gudgeon.studies.box import Range, judge_point, list_corners, sample_sobol_points
from gudgeon.studies.runs import (
    FIXED_STEP_METHODS,
    NAN,
    Attempt,
    Parameters,
    SceneWindow,
    Setting,
    find_comparison_window,
    find_default_step,
    list_round_numbers,
)
from gudgeon.studies.threads import ReportProgress, TaskPool
from gudgeon.studies.verdicts import Cell, Limits, Status, check_memory_of_cells, classify_runs, make_missing_cell

MAX_LONG_RUN_STEPS = 300_000  # default length of the long runs, in steps of the smallest step
MAX_COMPARISON_STEPS = 1_000_000  # maximum length of the comparison window, in steps of the smallest reference step
MAX_STEP_FACTOR = 200  # the longest step on the axis, as a multiple of the smallest default step of the scenes
CLEARANCE_FACTORS = (1 / 6, 10 / 3)  # range of the default axis, as multiples of the clearance in the file
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
DEFAULT_RTOL = 1e-8  # tolerance of the runs if no axis is the tolerance
REFERENCE_STEP_DIVISOR = 10  # a step h is compared with h/10
MAX_BOX_POINTS = 10**6
CPU_LIMIT_S = 120.0  # s, maximum processor time of a run


class _Verdicts:
    """Base class of the results of a parameter sweep, which Ctrl-C may leave incomplete."""

    cells: tuple[Cell, ...]

    @property
    def done(self) -> tuple[int, int]:
        """Return the number of judged cells, and the number of all cells."""
        return _count_judged(self.cells)

    @property
    def interrupted(self) -> bool:
        """Return whether Ctrl-C left cells without a verdict."""
        return any(cell.status is Status.MISSING for cell in self.cells)


@dataclass(frozen=True)
class VerdictMap(_Verdicts):
    """Verdicts on the runs of one scene over two axes, column by column; both axes ascend."""

    scene: str
    setting: Setting  # its value applies if no axis is the step or tolerance
    rows: Axis
    columns: Axis
    cells: tuple[Cell, ...]
    t_long: float  # s, length of the long runs
    full: bool = False  # whether the full formulation is used, in which Baumgarte's gains act

    def get_cell(self, row_value: float, column_value: float) -> Cell:
        """Return the cell at a value of the row axis and a value of the column axis, compared exactly.

        A column of NaN, as in a scene without play, means the first one. Raises KeyError for a value that is not on the
        axes.
        """
        if row_value not in self.rows.values or (
            column_value not in self.columns.values and column_value == column_value
        ):
            raise KeyError((row_value, column_value))
        column_index = self.columns.values.index(column_value) if column_value == column_value else 0
        return self.cells[column_index * len(self.rows.values) + self.rows.values.index(row_value)]

    def find_stability_limit(self, column_value: float) -> float:
        """Return the stability limit of a column: the largest row value up to which all cells of the column are stable.

        NaN if the cell at the smallest row value is not stable. Raises KeyError for a column value that is not on the
        axis.
        """
        largest = NAN
        for row in self.rows.values:
            if self.get_cell(row, column_value).status is not Status.STABLE:
                break
            largest = row
        return largest


@dataclass(frozen=True)
class VerdictBox(_Verdicts):
    """Verdicts on the runs of one scene at all corners of a box, then at Sobol points in it."""

    scene: str
    setting: Setting
    ranges: tuple[Range, ...]
    points: tuple[Mapping[str, float], ...]  # one for each cell: name of a range -> value
    cells: tuple[Cell, ...]
    t_long: float
    full: bool = False


def compute_verdict_map(
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
    progress: ReportProgress | None = None,
) -> VerdictMap:
    """Judge every pair of values of at most two axes, by default tolerance (rk4: step) × clearance, and return the map.

    `value`: the step or tolerance if neither axis is one. `t_long` (s) is the run over which a cell must remain valid;
    `t_short` bounds the window in which a step is compared with a tenth of itself (see `find_comparison_window`).
    `parameters` as in `simulate`; `quick` judges a few pairs. After Ctrl-C the cells so far are returned, the others as
    Status.MISSING. Raises BadValueError for a scene that is not integrated or axes that do not fit, MemoryError for too
    many cells.
    """
    _check_dynamic(simulation)
    axes, method = check_list(axes, "axes", Axis, "a list of Axis"), check_text(method, "method")
    limits, quick = check_optional_instance(limits, "limits", Limits), check_flag(quick, "quick")
    t_long, t_short = check_optional_positive(t_long, "t_long"), check_optional_positive(t_short, "t_short")
    value, progress = check_optional_positive(value, "value"), check_callable(progress, "progress")
    parameter_values, full = dict(check_mapping(parameters, "parameters")), is_full_formulation_needed(axes, method)
    simulation = simulation.full if full else simulation
    rows, columns = arrange_axes(simulation, axes, method, parameter_values, quick)
    default_setting = Setting(
        method,
        value or (find_default_step(simulation, parameter_values) if method in FIXED_STEP_METHODS else DEFAULT_RTOL),
    )
    check_memory_of_cells(len(rows.values) * len(columns.values))
    jobs = _build_jobs(simulation, rows, columns, default_setting, parameter_values)
    shortest_step = (
        min(setting.value for job in jobs for setting in job.settings) if default_setting.has_fixed_step else math.inf
    )
    t_long = t_long or min(
        evaluate_file_end_time(simulation.compiled, parameter_values), MAX_LONG_RUN_STEPS * shortest_step
    ) / (10 if quick else 1)
    max_window = t_short or MAX_COMPARISON_STEPS * shortest_step / REFERENCE_STEP_DIVISOR / (10 if quick else 1)
    with TaskPool[_MapJob, list[Cell]](progress or (lambda fraction, text: None), len(jobs)) as pool:
        cell_lists = pool.map_in_threads(
            lambda job, progress: _judge_job(simulation, job, t_long, max_window, limits, progress), jobs
        )
    missing = ([make_missing_cell(job.parameters, setting) for setting in job.settings] for job in jobs)
    cells = tuple(
        cell
        for judged_cells, missing_cells in zip(cell_lists, missing, strict=True)
        for cell in judged_cells or missing_cells
    )
    return VerdictMap(simulation.source.scene, default_setting, rows, columns, cells, t_long, full)


def arrange_axes(
    simulation: Simulation, axes: Sequence[Axis], method: str, parameters: Parameters, quick: bool = False
) -> tuple[Axis, Axis]:
    """Return the axis of the rows and the axis of the columns of a map from at most two axes, with defaults for others.

    The axis of the method (step or rtol) is always the rows; of two parameter axes, the second one is. Defaults: the
    steps or tolerances of the method, and the clearance. quick: fewer default values. Raises BadValueError for more
    than two axes, equal axes, an axis that does not fit the method, or steps or tolerances that are not positive.
    """
    method_axes, parameter_axes = [a for a in axes if a.is_method_setting], [a for a in axes if not a.is_method_setting]
    expected = "step" if method in FIXED_STEP_METHODS else "rtol"
    if len(axes) > 2 or len(method_axes) > 1 or len({a.name for a in axes}) < len(axes):
        raise BadValueError(f"axes {', '.join(a.name for a in axes)}: expected two different ones, step or rtol once")
    if method_axes and method_axes[0].name != expected:
        raise BadValueError(f"axis {method_axes[0].name} does not fit: method {method} has the setting {expected}")
    if any(not value > 0 for a in method_axes for value in a.values):
        raise BadValueError(f"axis {expected}: expected positive values")
    if len(parameter_axes) == 2:
        return parameter_axes[1], parameter_axes[0]
    if not method_axes:
        tolerances = TOLERANCES[1:3] if quick else TOLERANCES
        method_axes = [
            make_axis(
                simulation,
                expected,
                list_map_steps([simulation], quick) if method in FIXED_STEP_METHODS else tolerances,
            )
        ]
    return method_axes[0], parameter_axes[0] if parameter_axes else _build_clearance_axis(simulation, parameters, quick)


def compute_verdict_box(
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
    progress: ReportProgress | None = None,
) -> VerdictBox:
    """Judge all corners of the box of parameters `ranges` and `count` Sobol points in it, and return the verdicts.

    `setting`: by default method auto at tolerance DEFAULT_RTOL. `addresses`: axes for names of ranges that are groups.
    `quick`: over a tenth of the time. Other arguments are as in `compute_verdict_map`. After Ctrl-C the cells so far
    are returned. Raises BadValueError for invalid arguments or a point outside the valid parameters, MemoryError for
    too many points.
    """
    _check_dynamic(simulation)
    ranges, count = (
        check_list(ranges, "ranges", Range, "a list of Range"),
        check_integer(count, "count", 0, MAX_BOX_POINTS),
    )
    limits, quick = check_optional_instance(limits, "limits", Limits), check_flag(quick, "quick")
    t_long, parameters = check_optional_positive(t_long, "t_long"), check_mapping(parameters, "parameters")
    progress, setting = (
        check_callable(progress, "progress"),
        check_optional_instance(setting, "setting", Setting) or Setting("auto", DEFAULT_RTOL),
    )
    if not ranges:
        raise BadValueError("a box needs at least one range: --range name=low..high")
    t_long = t_long or evaluate_file_end_time(simulation.compiled, parameters) / (10 if quick else 1)
    group_axes = {
        name: check_instance(range_, f"addresses: {name}", Axis)
        for name, range_ in check_mapping(addresses, "addresses").items()
    }
    full = is_full_formulation_needed(
        [group_axes.get(range_.name) or make_axis(simulation, range_.name, ()) for range_ in ranges], setting.method
    )
    simulation = simulation.full if full else simulation

    def build_point_parameters(point: Mapping[str, float]) -> dict[str, float | str]:
        """Return the parameters of `simulate` at a point of the box, on top of `parameters`.

        A range of a group sets all addresses of the group.
        """
        settings = (
            group_axes[name].build_parameters(value) if name in group_axes else {name: value}
            for name, value in point.items()
        )
        return dict(parameters) | {
            address: value for parameter_values in settings for address, value in parameter_values.items()
        }

    def classify_one_point(point: Mapping[str, float], progress: ReportProgress) -> Cell:
        """Run and judge one point of the box in a worker thread, and return its cell."""
        return judge_point(simulation, build_point_parameters(point), t_long, setting, limits, CPU_LIMIT_S, progress)

    check_memory_of_cells(2.0 ** len(ranges) + count)
    points = [*list_corners(ranges), *sample_sobol_points(ranges, count)]
    for point in points:
        compute_parameter_values(simulation.compiled, build_point_parameters(point))
    with TaskPool[Mapping[str, float], Cell](progress or (lambda fraction, text: None), len(points)) as pool:
        cells_or_none = pool.map_in_threads(classify_one_point, points)
    cells = tuple(
        cell or make_missing_cell(build_point_parameters(point), setting)
        for cell, point in zip(cells_or_none, points, strict=True)
    )
    return VerdictBox(simulation.source.scene, setting, tuple(ranges), tuple(points), cells, t_long, full)


def is_full_formulation_needed(axes: Sequence[Axis], method: str) -> bool:
    """Return whether an axis varies the gains of Baumgarte's stabilization, which only the full formulation has.

    Raises BadValueError for such an axis with a method other than rk4: other methods project onto the constraints.
    """
    gains_axis = next((a.name for a in axes if any(address in GAINS for address, _ in a.ratios)), "")
    if gains_axis and method != "rk4":
        raise BadValueError(f"axis {gains_axis}: method {method!r} projects and has no gains", hint="use --method rk4")
    return bool(gains_axis)


def _count_judged(cells: Sequence[Cell]) -> tuple[int, int]:
    """Return the number of cells with another status than MISSING, and the number of all cells."""
    return sum(cell.status is not Status.MISSING for cell in cells), len(cells)


def list_map_steps(simulations: Sequence[Simulation], quick: bool = False) -> tuple[float, ...]:
    """Return the steps 1, 2, 5 · 10^k s, ascending, from the smallest default step of the scenes to 200 times that.

    With `quick` it is every second of them from the fourth on.
    """
    min_step = min(find_default_step(simulation) for simulation in simulations)
    steps = list_round_numbers(min_step, MAX_STEP_FACTOR * min_step)
    return steps[3::2] if quick else steps


def list_default_clearances(c: float, quick: bool = False) -> tuple[float, ...]:
    """Return clearances 1, 2, 5 · 10^k m from c/6 to 10/3 c, and c itself, ascending; with `quick` only c.

    c is the clearance in the file, m.
    """
    if quick:
        return (c,)
    return tuple(sorted({*list_round_numbers(CLEARANCE_FACTORS[0] * c, CLEARANCE_FACTORS[1] * c), float(f"{c:.6g}")}))


def _build_clearance_axis(simulation: Simulation, parameters: Parameters, quick: bool) -> Axis:
    """Return the default axis of clearances, without values with which the parameters are invalid.

    For example, a clearance must be less than the radius of its bearing. In a scene without play the only value is NaN.
    """
    if not simulation.source.clearances:
        return make_clearance_axis(simulation, ())
    p = compute_parameter_values(simulation.compiled, parameters)[0]
    file_clearance = float(p[simulation.source.clearances[0].clearance])
    axis = make_clearance_axis(simulation, list_default_clearances(file_clearance, quick), parameters)
    allowed = []
    for c in axis.values:
        try:
            compute_parameter_values(simulation.compiled, {**parameters, **axis.build_parameters(c)})
        except BadValueError:
            continue
        allowed.append(c)
    return replace(axis, values=tuple(allowed))


@dataclass(frozen=True)
class _MapJob:
    """Task of one worker thread: parameters of a run, and all settings that are judged with them."""

    parameters: dict[str, float | str]
    settings: tuple[Setting, ...]


def _check_dynamic(simulation: Simulation) -> None:
    """Raise BadValueError if the scene has no degree of freedom, so that it has no step or tolerance to judge."""
    if simulation.source.degrees_of_freedom == 0:
        raise BadValueError(f"scene {simulation.source.scene!r} has no degree of freedom: no motion is integrated")


def _build_jobs(
    simulation: Simulation,
    rows: Axis,
    columns: Axis,
    default_setting: Setting,
    fixed_parameters: dict[str, float | str],
) -> list[_MapJob]:
    """Return the jobs of a map column by column; the cells of all jobs, in order, are those of the map.

    If the rows are steps, a job has all steps of a column, since a run with a tenth of a step may also be a row.
    Otherwise each job has one cell. All parameters are checked here: raises BadValueError for an invalid value.
    """
    jobs = []
    for column_value in columns.values:
        if rows.is_method_setting:
            settings = tuple(Setting(default_setting.method, row_value) for row_value in rows.values)
            parameters = {**fixed_parameters, **columns.build_parameters(column_value)}
            # runs of fixed steps are shared as references, tolerances are judged one by one
            jobs += (
                [_MapJob(parameters, settings)]
                if default_setting.has_fixed_step
                else [_MapJob(parameters, (setting,)) for setting in settings]
            )
            continue
        for row_value in rows.values:
            jobs.append(
                _MapJob(
                    {**fixed_parameters, **columns.build_parameters(column_value), **rows.build_parameters(row_value)},
                    (default_setting,),
                )
            )
    for job in jobs:
        compute_parameter_values(simulation.compiled, job.parameters)
    return jobs


def _judge_job(
    simulation: Simulation,
    job: _MapJob,
    t_long: float,
    max_window: float,
    limits: Limits | None,
    progress: ReportProgress,
) -> list[Cell]:
    """Run and judge a job in a worker thread and return its cells, one for each setting.

    Fixed steps are judged together, a tolerance is judged like a point of a box. t_long (s): end of the long runs.
    max_window (s): maximum length of the comparison window, for fixed steps only. limits: None means those of the
    setting.
    """
    if job.settings[0].has_fixed_step:
        return _judge_steps(simulation, job, t_long, max_window, limits, progress)
    return [judge_point(simulation, job.parameters, t_long, job.settings[0], limits, CPU_LIMIT_S, progress)]


def _judge_steps(
    simulation: Simulation,
    job: _MapJob,
    t_long: float,
    max_window: float,
    limits: Limits | None,
    progress: ReportProgress,
) -> list[Cell]:
    """Return the cells of a job with fixed steps, each from a long run and a comparison with a tenth of the step.

    The comparison is over the first contacts, or over at most `max_window` (s). If a tenth of the step is a setting of
    the job, too, and its long run has no contact, the long runs are compared as well. The progress is weighted by the
    number of steps of each run.
    """
    steps = [setting.refine(1) for setting in job.settings]
    shortest = min(find_default_step(simulation), *(setting.value for setting in steps))
    short_window = find_comparison_window(simulation, max_window, Setting("rk4", shortest), job.parameters)
    long_window = SceneWindow(simulation, t_long, job.parameters)
    all_steps = sorted(
        {x for step in steps for x in (step, step.refine(REFERENCE_STEP_DIVISOR))}, key=lambda x: -x.value
    )
    runs = [
        (window, step)
        for window, window_steps in ((short_window, all_steps), (long_window, steps))
        for step in window_steps
    ]
    total_cost, completed = sum(window.t_end / step.value for window, step in runs), 0.0
    attempts: dict[tuple[SceneWindow, Setting], Attempt] = {}
    for window, step in runs:
        fraction = window.t_end / step.value / total_cost
        attempts[window, step] = window.run(step, _scale_progress(progress, completed, fraction))
        completed += fraction
    cells = []
    for step in steps:
        reference = step.refine(REFERENCE_STEP_DIVISOR)
        pairs = [(attempts[short_window, step], attempts[short_window, reference])]
        fine_long_run = attempts.get((long_window, reference))
        if fine_long_run is not None and fine_long_run.run is not None and not len(fine_long_run.run.impacts):
            pairs.append(
                (attempts[long_window, step], fine_long_run)
            )  # without contacts, errors are meaningful for longer
        cells.append(classify_runs(job.parameters, attempts[long_window, step], pairs, limits))
    return cells


def _scale_progress(progress: ReportProgress, begin: float, length: float) -> ReportProgress:
    """Return a progress function for one run of a job, which maps fractions 0 … 1 to begin … begin + length.

    progress: the progress function of the whole job, which it calls.
    """
    return lambda fraction, text: progress(begin + length * fraction, text)

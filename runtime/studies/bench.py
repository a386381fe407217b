"""Measure work-precision diagrams, run time against error of every method, scene by scene: `gudgeon bench`.

The error of a run is its difference from a reference solution by another method at a much tighter tolerance. There are
two references by different methods; a run is compared with the one whose method it does not use. Their difference is
reported, and errors below twenty times it are not resolved. Times are the minimum of several runs on one thread.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.integrators.peers import driver as python_driver
from gudgeon.language.argument_checks import check_callable, check_flag, check_mapping, check_numbers, check_positive
from gudgeon.model.default_step import evaluate_file_end_time
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.methods import ADAPTIVE, RhsTime, measure_rhs_time, select_methods
from gudgeon.studies.runs import (
    NAN,
    Attempt,
    Error,
    Parameters,
    SceneWindow,
    Setting,
    compare_runs,
    find_comparison_window,
    find_default_step,
    find_mechanism_size,
    list_round_numbers,
)

MIN_STEP_FACTOR, MAX_STEP_FACTOR = 1 / 5, 200  # range of the tested steps, as multiples of the scene's default step
MAX_REFERENCE_STEPS = 200_000  # maximum length of the window, in steps of the smallest tested step
REFERENCE_STEP_DIVISORS = (4, 8)  # for fixed steps only: steps of the references, as fractions of the smallest step
REFERENCES = (Setting("dop853", 1e-13), Setting("rodas5p", 1e-12))
SECOND_REFERENCE_RTOL = 1e-12  # tolerance of the second reference if both use the same method
TOLERANCES = tuple(float(f"1e-{k}") for k in range(3, 12))
KINEMATIC_SAMPLE_COUNTS = (10, 100, 1_000, 10_000)  # sample intervals that are tested with dof = 0
MAX_CROSS_CHECK_S, CROSS_CHECK_LIMIT_S = (
    2.0,
    5.0,
)  # s: run time after which a cross-check gets no tighter tolerance; after which it is stopped
QUICK_TIMING_BUDGET_S = 0.02  # s, total time of the repetitions of one timed run with `quick`
RESOLUTION_FACTOR = 20  # errors below this multiple of the references' difference are not resolved
MAX_ORDER_ERROR = 1e-3  # maximum error of a point that counts for the order of convergence
MAX_LINE_DEVIATION = math.log(2.5)  # maximum standard deviation of the points from the regression line, in log(error)


@dataclass(frozen=True)
class Row:
    """Measurements of one method with one step or tolerance, or one number of samples of the kinematic method."""

    setting: Setting
    seconds: float  # run time per simulated second; NaN if the run failed
    right_hand_sides: int
    error: Error
    jacobians: int = 0
    samples: int = 0  # of a kinematic run
    reference: Setting | None = None  # None: none, the error is max |Φ| by the mechanism's size
    failure: str = ""
    failed_at: float = NAN  # s


@dataclass(frozen=True)
class SceneBench:
    """All rows of one scene, method by method, from the longest step or loosest tolerance on."""

    scene: str
    t_end: float
    end_reason: str  # reason for the end of the window, for display
    rows: tuple[Row, ...]
    references: tuple[Setting, ...]
    reference_difference: Error  # difference of the two references
    contact: float  # s, the shortest contact in the window; NaN: none
    rhs: tuple[RhsTime, ...]
    left_out: tuple[str, ...] = ()  # sentences: omitted cross-checks, or omitted tight tolerances of them
    missing: int = 0  # settings without a row after Ctrl-C

    @property
    def interrupted(self) -> bool:
        """Return whether Ctrl-C ended the measurement before all rows were measured."""
        return self.missing > 0

    @property
    def done(self) -> tuple[int, int]:
        """Return the number of measured rows, and the number of requested rows."""
        return len(self.rows), len(self.rows) + self.missing

    @property
    def methods(self) -> tuple[str, ...]:
        """Return the names of the measured methods without repetitions, in the order of the rows."""
        return tuple(dict.fromkeys(row.setting.method for row in self.rows))

    def list_rows(self, method: str) -> list[Row]:
        """Return all rows of a method, including failed ones, from the longest step or loosest tolerance on."""
        return [row for row in self.rows if row.setting.method == method]

    def estimate_order(self, error_name: str, method: str = "rk4") -> float:
        """Return the observed order of convergence of a method: the slope of log(error) over log(step or tolerance).

        error_name: "motion", "path" or "force". Only resolved errors below MAX_ORDER_ERROR count. NaN for fewer than
        three of them, or if their standard deviation from the regression line is MAX_LINE_DEVIATION or more, as for a
        stiff scene at its stability limit.
        """
        points = [
            (row.setting.value, getattr(row.error, error_name)) for row in self.list_rows(method) if not row.failure
        ]
        log_points = np.log([(h, e) for h, e in points if self.is_resolved(error_name, e) and e < MAX_ORDER_ERROR])
        if len(log_points) < 3:
            return NAN
        polynomial = np.polyfit(log_points[:, 0], log_points[:, 1], 1)
        return (
            float(polynomial[0])
            if np.std(np.polyval(polynomial, log_points[:, 0]) - log_points[:, 1]) < MAX_LINE_DEVIATION
            else NAN
        )

    def is_resolved(self, error_name: str, error: float) -> bool:
        """Return whether an error exceeds the uncertainty: RESOLUTION_FACTOR times the difference of the references.

        error_name: "motion", "path" or "force". False for NaN.
        """
        return error > RESOLUTION_FACTOR * getattr(self.reference_difference, error_name)

    def find_row(self, setting: Setting) -> Row | None:
        """Return the row with the method and, to rounding, the value of `setting`; None if it was not measured."""
        return next((r for r in self.list_rows(setting.method) if math.isclose(r.setting.value, setting.value)), None)

    def find_run_time_for_error(self, error: float, method: str) -> float:
        """Return the minimum run time (s per simulated second) with which a method has an error of at most `error`.

        The largest of the three error measures counts. NaN if no successful row of the method is as accurate, or if
        RESOLUTION_FACTOR times the difference of the references exceeds `error`.
        """
        if any(RESOLUTION_FACTOR * getattr(self.reference_difference, m) > error for m in ("motion", "path", "force")):
            return NAN
        return min(
            (r.seconds for r in self.list_rows(method) if not r.failure and r.error.largest <= error), default=NAN
        )


ReportProgress = Callable[[float, str], None]


def measure_scene(
    simulation: Simulation,
    steps: Sequence[float] | None = None,
    tolerances: Sequence[float] | None = None,
    *,
    t_end: float | None = None,
    parameters: Parameters | None = None,
    quick: bool = False,
    methods: Sequence[str] | None = None,
    progress: ReportProgress | None = None,
) -> SceneBench:
    """Measure run time and error of one scene with every method and setting, against two reference solutions.

    steps (s) of rk4: by default 1, 2, 5 · 10^k around the step of a plain run. tolerances: by default 1e-3 … 1e-11.
    methods: names, or patterns such as "scipy:*"; by default all that fit. t_end (s): by default the end of the first
    few contacts or, without contact, as many of the shortest steps as are affordable. quick: fewer settings over a
    tenth of the window, without cross-checks. A scene without degrees of freedom is measured by its kinematic method
    alone. After Ctrl-C the rows so far are returned. Raises BadValueError for invalid steps, tolerances or methods.
    """
    parameters, progress = dict(check_mapping(parameters, "parameters")), check_callable(progress, "progress")
    t_end, quick = None if t_end is None else check_positive(t_end, "t_end"), check_flag(quick, "quick")
    if simulation.source.degrees_of_freedom == 0:
        return _measure_kinematic_scene(
            simulation, parameters, KINEMATIC_SAMPLE_COUNTS[:3] if quick else KINEMATIC_SAMPLE_COUNTS, t_end, progress
        )
    selected, left_out = select_methods(simulation, methods, quick)
    default_steps = list_bench_steps(simulation, parameters, quick)
    steps = sorted(check_numbers(steps, "steps") or default_steps, reverse=True)
    tolerances = sorted(
        check_numbers(tolerances, "tolerances") or (TOLERANCES[1::3] if quick else TOLERANCES), reverse=True
    )
    if not steps[-1] > 0 or not 0 < tolerances[-1] <= tolerances[0] < 1:
        raise BadValueError("expected positive steps (s) and tolerances between 0 and 1")
    max_window = max(MAX_REFERENCE_STEPS * steps[-1] / (10 if quick else 1), 2 * steps[0])
    pilot = Setting("rk4", find_default_step(simulation, parameters))
    window = (
        SceneWindow(simulation, t_end, parameters)
        if t_end
        else find_comparison_window(simulation, max_window, pilot, parameters)
    )
    window = replace(window, timing_budget=QUICK_TIMING_BUDGET_S if quick else window.timing_budget)
    settings = [Setting("rk4", step) for step in steps if "rk4" in selected]
    settings += [Setting(method, x) for method in selected if method in ADAPTIVE for x in tolerances]
    checks = [method for method in selected if method in python_driver.NAMES]
    if checks:
        _ = simulation.full  # derived and compiled before any of them is timed
    settings += [Setting(method, x) for method in checks for x in tolerances[::2]]
    reference_settings = select_references(simulation, settings)
    scene_bench = _measure_settings(window, settings, reference_settings, progress or (lambda fraction, text: None))
    return replace(scene_bench, left_out=(*left_out, *scene_bench.left_out))


def list_bench_steps(
    simulation: Simulation, parameters: Parameters | None = None, quick: bool = False
) -> tuple[float, ...]:
    """Return the steps 1, 2, 5 · 10^k s, ascending, from MIN_STEP_FACTOR to MAX_STEP_FACTOR times the default step.

    With `quick` they begin at the default step of the scene itself. `parameters` None: the values of the file.
    """
    default_step = find_default_step(simulation, parameters)
    return list_round_numbers(default_step * (1 if quick else MIN_STEP_FACTOR), default_step * MAX_STEP_FACTOR)


def select_references(simulation: Simulation, settings: Sequence[Setting]) -> tuple[Setting, Setting]:
    """Return the settings of both reference runs: the methods of REFERENCES that the scene supports.

    With one such method, it is used at two tolerances. In a scene that allows only fixed steps, the steps are the
    smallest of the tested `settings` divided by 4 and by 8 (REFERENCE_STEP_DIVISORS).
    """
    fitting = [setting for setting in REFERENCES if setting.method in simulation.source.methods]
    if fitting:
        return fitting[0], fitting[1] if len(fitting) > 1 else replace(fitting[0], value=SECOND_REFERENCE_RTOL)
    finest = min(settings, key=lambda setting: setting.value)
    return finest.refine(REFERENCE_STEP_DIVISORS[0]), finest.refine(REFERENCE_STEP_DIVISORS[1])


def _measure_settings(
    window: SceneWindow, settings: Sequence[Setting], reference_settings: Sequence[Setting], progress: ReportProgress
) -> SceneBench:
    """Run the two references, then measure every setting against them, and return the rows of the scene.

    The shortest contact is that of the first successful reference. If a reference failed, the reference_difference is
    infinite, so no error counts as resolved. Ctrl-C during the references raises KeyboardInterrupt; later it leaves out
    the remaining settings and the times of the right-hand side.
    """
    count = len(settings) + len(reference_settings)

    def run_setting(index: int, setting: Setting) -> Attempt:
        """Run one setting over the window, report progress, and return the outcome.

        index: number among references and settings, for the progress. Cross-checks, which are solvers called from
        Python, are stopped after CROSS_CHECK_LIMIT_S seconds.
        """
        text = f"{setting.method} {setting}"
        limited = replace(window, limit=CROSS_CHECK_LIMIT_S) if setting.method in python_driver.NAMES else window
        return limited.run(setting, lambda fraction, _: progress((index + fraction) / count, text))

    reference_attempts = [run_setting(index, setting) for index, setting in enumerate(reference_settings)]
    successful = [a for a in reference_attempts if a.run is not None and not a.failure]
    reference_difference, contact = Error(math.inf, math.inf, math.inf), NAN
    if successful and successful[0].run is not None:
        lengths = successful[0].run.impacts["t_off"] - successful[0].run.impacts["t_on"]
        contact = float(np.nanmin(lengths)) if np.isfinite(lengths).any() else NAN
    if len(successful) == 2 and successful[0].run is not None and successful[1].run is not None:
        reference_difference = compare_runs(successful[0].run, successful[1].run)
    rows, left_out, missing = _measure_rows(
        window, settings, successful, lambda k, one: run_setting(len(reference_settings) + k, one)
    )
    rhs = () if missing else tuple(measure_rhs_time(window.simulation, window.t_end))
    name = window.simulation.source.scene
    return SceneBench(
        name,
        window.t_end,
        window.end_reason,
        tuple(rows),
        tuple(reference_settings),
        reference_difference,
        contact,
        rhs,
        tuple(left_out),
        missing,
    )


def _measure_rows(
    window: SceneWindow,
    settings: Sequence[Setting],
    references: Sequence[Attempt],
    run_setting: Callable[[int, Setting], Attempt],
) -> tuple[list[Row], list[str], int]:
    """Measure the settings in order; return rows, reasons for omitted settings, and the number left out by Ctrl-C.

    run_setting: function that runs the k-th setting and returns its outcome. A run that is stopped at its limit has no
    row. If a cross-check is stopped, or takes longer than MAX_CROSS_CHECK_S seconds, its tighter tolerances are left
    out. settings: of one method from the loosest tolerance on.
    """
    rows: list[Row] = []
    omissions: dict[str, str] = {}
    for k, setting in enumerate(settings):
        if setting.method in omissions:
            continue
        try:
            outcome = run_setting(k, setting)
            if outcome.slow:
                omissions[setting.method] = f"{setting.method}: {setting} and tighter left out: {outcome.failure}"
                continue
            rows.append(_measure_row(window, outcome, references))
        except KeyboardInterrupt:
            return (
                rows,
                list(omissions.values()),
                sum(setting_left.method not in omissions for setting_left in settings[k:]),
            )
        if (
            setting.method in python_driver.NAMES
            and _read_run_time(outcome) > MAX_CROSS_CHECK_S
            and k + 1 < len(settings)
        ):
            next_setting = settings[k + 1]
            if next_setting.method == setting.method:
                reason = f"{setting} took {_read_run_time(outcome):.2g} s"
                omissions[setting.method] = f"{setting.method}: {next_setting} and tighter left out: {reason}"
    return rows, list(omissions.values()), 0


def _read_run_time(attempt: Attempt) -> float:
    """Return the wall time (s) of the integration of a run; 0 for an outcome without a result."""
    return attempt.run.diagnostics.seconds if attempt.run is not None else 0.0


def _measure_row(window: SceneWindow, attempt: Attempt, references: Sequence[Attempt]) -> Row:
    """Return the row of a run: its error against a reference by another method, and its run time by repeated runs.

    A failed run gets a row with the failure, and is not timed. The error is NaN without references. A cross-check that
    took longer than `window.timing_budget` is not repeated.
    """
    if attempt.failure or attempt.run is None:
        return Row(
            attempt.setting,
            NAN,
            0,
            Error(),
            0,
            0,
            None,
            attempt.failure or "no result",
            attempt.failed_at,
        )
    diagnostics = attempt.run.diagnostics
    method_names = diagnostics.method.split("+")
    reference = find_independent_reference(
        [*method_names, method_names[0].rpartition(":")[2].lower()], references
    )  # nor by the same method of another library
    error = compare_runs(attempt.run, reference.run) if reference is not None and reference.run is not None else Error()
    known_seconds = diagnostics.seconds if attempt.setting.method in python_driver.NAMES else 0.0
    seconds = known_seconds if known_seconds > window.timing_budget else window.measure_run_time(attempt.setting)
    return Row(
        attempt.setting,
        seconds / window.t_end,
        diagnostics.right_hand_sides,
        error,
        diagnostics.jacobians,
        0,
        None if reference is None else reference.setting,
    )


def find_independent_reference(methods: Iterable[str], references: Sequence[Attempt]) -> Attempt | None:
    """Return the first reference run whose method is not in `methods`, else the last one; None without references."""
    return next(
        (attempt for attempt in references if attempt.setting.method not in methods),
        references[-1] if references else None,
    )


def _measure_kinematic_scene(
    simulation: Simulation,
    parameters: Parameters,
    sample_counts: Sequence[int],
    t_end: float | None,
    progress: ReportProgress | None,
) -> SceneBench:
    """Measure the kinematic analysis of a scene with dof = 0 for each number of sample intervals in `sample_counts`.

    The error is the largest residual of the constraint equations divided by the size of the mechanism; there are no
    references. t_end (s): None or 0 means the end of the scene's run. A failed run gets a row with the failure. Returns
    a SceneBench.
    """
    window = SceneWindow(simulation, t_end or evaluate_file_end_time(simulation.compiled, parameters), parameters)
    rows = []
    for index, count in enumerate(sample_counts):
        if progress:
            progress(index / len(sample_counts), f"{count} samples")
        setting = Setting("kinematic", window.t_end / count)
        attempt = window.run_at_times(setting, np.linspace(0.0, window.t_end, count + 1))
        if attempt.run is None or attempt.failure:
            failure = attempt.failure or "no result"
            rows.append(Row(setting, NAN, 0, Error(), 0, count, None, failure, attempt.failed_at))
            continue
        seconds = window.measure_run_time(setting, count) / window.t_end
        error = Error(attempt.run.diagnostics.phi_max / find_mechanism_size(attempt.run))
        rows.append(Row(setting, seconds, 0, error, samples=count))
    rhs = tuple(measure_rhs_time(simulation, window.t_end))
    return SceneBench(simulation.source.scene, window.t_end, "", tuple(rows), (), Error(), NAN, rhs)

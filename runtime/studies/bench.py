"""Measure run time against error of every method, scene by scene: `gudgeon bench`.

The error of a run is its difference from a reference by another method at a much tighter tolerance. There are two
references by different methods; a run is compared with the one whose method it does not use. Their difference is
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
from gudgeon.model.default_step import evaluate_end
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies import runs as measured
from gudgeon.studies.methods import ADAPTIVE, RhsTime, measure_rhs_time, select_methods
from gudgeon.studies.runs import (
    NAN,
    Attempt,
    Error,
    Parameters,
    SceneWindow,
    Setting,
    compare_runs,
    find_default_step,
    find_mechanism_size,
)

FINEST, COARSEST = 1 / 5, 200  # steps that are tested, of the step that a plain run takes
REFERENCE_STEPS = 200_000  # of the finest step: what bounds a smooth scene's window
FINER = (4, 8)  # where nothing but a fixed step fits: the references' steps, the finest tested one divided by these
REFERENCES = (Setting("dop853", 1e-13), Setting("rodas5p", 1e-12))
SECOND = 1e-12  # tolerance of the second reference if one method is both
TOLERANCES = tuple(float(f"1e-{k}") for k in range(3, 12))
KINEMATIC = (10, 100, 1_000, 10_000)  # samples of a scene without a degree of freedom
MAX_CROSS_CHECK_S, CROSS_CHECK_LIMIT_S = (
    2.0,
    5.0,
)  # s: run time after which a cross-check gets no tighter tolerance; after which it is stopped
QUICK = 0.02  # s of timed runs
RESOLUTION_FACTOR = 20  # times the references' difference: smaller errors are not resolved
MAX_ORDER_ERROR = 1e-3  # the largest error from which an order is determined
MAX_LINE_DEVIATION = math.log(2.5)  # the largest deviation of points from a line that determines an order


@dataclass(frozen=True)
class Row:
    """Measurements of one method with one step or tolerance, or one number of samples of the kinematic method."""

    setting: Setting
    seconds: float  # a simulated second; NaN if the run failed
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
    why: str  # this window
    rows: tuple[Row, ...]
    references: tuple[Setting, ...]
    agreement: Error  # of the two references
    contact: float  # s, the shortest contact in the window; NaN: none
    rhs: tuple[RhsTime, ...]
    left_out: tuple[str, ...] = ()  # sentences: cross-checks that were not run, or not so tightly
    missing: int = 0  # settings that Ctrl-C cut short or left out

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

    def estimate_order(self, measure: str, method: str = "rk4") -> float:
        """Return the order of convergence of a method: the slope of log(error) over log(step or tolerance).

        measure: "motion", "path" or "force". Errors that the references do not resolve, or of MAX_ORDER_ERROR or more,
        are left out. NaN for fewer than three points, or points that are not on a line (a stiff scene at its stability
        limit).
        """
        points = [(row.setting.value, getattr(row.error, measure)) for row in self.list_rows(method) if not row.failure]
        log_points = np.log([(h, e) for h, e in points if self.is_resolved(measure, e) and e < MAX_ORDER_ERROR])
        if len(log_points) < 3:
            return NAN
        polynomial = np.polyfit(log_points[:, 0], log_points[:, 1], 1)
        return (
            float(polynomial[0])
            if np.std(np.polyval(polynomial, log_points[:, 0]) - log_points[:, 1]) < MAX_LINE_DEVIATION
            else NAN
        )

    def is_resolved(self, measure: str, error: float) -> bool:
        """Return whether an error is large enough to be measured: more than RESOLUTION_FACTOR times the difference of
        the two references.

        measure: "motion", "path" or "force".
        """
        return error > RESOLUTION_FACTOR * getattr(self.agreement, measure)

    def find_row(self, setting: Setting) -> Row | None:
        """Return the row with the method and the step or tolerance of `setting`, equal to rounding; None if it was not
        measured.
        """
        return next((r for r in self.list_rows(setting.method) if math.isclose(r.setting.value, setting.value)), None)

    def find_run_time_for_error(self, error: float, method: str) -> float:
        """Return the least run time (s per simulated second) of the rows of a method whose largest error is at most
        `error`.

        NaN if no such row exists, or if the references differ so much that `error` is not resolved.
        """
        if any(RESOLUTION_FACTOR * getattr(self.agreement, m) > error for m in ("motion", "path", "force")):
            return NAN
        return min(
            (r.seconds for r in self.list_rows(method) if not r.failure and r.error.largest <= error), default=NAN
        )


Report = Callable[[float, str], None]


def measure_scene(
    simulation: Simulation,
    steps: Sequence[float] | None = None,
    tolerances: Sequence[float] | None = None,
    *,
    t_end: float | None = None,
    parameters: Parameters | None = None,
    quick: bool = False,
    methods: Sequence[str] | None = None,
    progress: Report | None = None,
) -> SceneBench:
    """Measure run time and error of one scene with every method and setting, against two references.

    steps (s) of rk4: by default 1, 2, 5 · 10^k around the step of a plain run. tolerances: by default 1e-3 … 1e-11.
    methods: names, or patterns such as "scipy:*"; by default all that fit. t_end (s): by default the end of the first
    few contacts or, without contact, as many of the shortest steps as are affordable. quick: fewer settings over a
    tenth of the window, without cross-checks. A scene without degrees of freedom is measured by its kinematic method
    alone. After Ctrl-C the rows so far are returned. Raises BadValueError for invalid steps, tolerances or methods.
    """
    parameters, progress = dict(check_mapping(parameters, "parameters")), check_callable(progress, "progress")
    t_end, quick = None if t_end is None else check_positive(t_end, "t_end"), check_flag(quick, "quick")
    if simulation.source.degrees_of_freedom == 0:
        return _measure_kinematic_scene(simulation, parameters, KINEMATIC[:3] if quick else KINEMATIC, t_end, progress)
    selected, left_out = select_methods(simulation, methods, quick)
    usual = list_default_steps(simulation, parameters, quick)
    steps = sorted(check_numbers(steps, "steps") or usual, reverse=True)
    tolerances = sorted(
        check_numbers(tolerances, "tolerances") or (TOLERANCES[1::3] if quick else TOLERANCES), reverse=True
    )
    if not steps[-1] > 0 or not 0 < tolerances[-1] <= tolerances[0] < 1:
        raise BadValueError("expected positive steps (s) and tolerances between 0 and 1")
    max_window = max(REFERENCE_STEPS * steps[-1] / (10 if quick else 1), 2 * steps[0])
    pilot = Setting("rk4", find_default_step(simulation, parameters))
    window = (
        SceneWindow(simulation, t_end, parameters)
        if t_end
        else measured.find_comparison_window(simulation, max_window, pilot, parameters)
    )
    window = replace(window, timing_budget=QUICK if quick else window.timing_budget)
    settings = [Setting("rk4", step) for step in steps if "rk4" in selected]
    settings += [Setting(method, x) for method in selected if method in ADAPTIVE for x in tolerances]
    checks = [method for method in selected if method in python_driver.NAMES]
    if checks:
        _ = simulation.full  # derived and compiled before any of them is timed
    settings += [Setting(method, x) for method in checks for x in tolerances[::2]]
    reference_settings = select_references(simulation, settings)
    scene_bench = _measure_settings(window, settings, reference_settings, progress or (lambda fraction, text: None))
    return replace(scene_bench, left_out=(*left_out, *scene_bench.left_out))


def list_default_steps(
    simulation: Simulation, parameters: Parameters | None = None, quick: bool = False
) -> tuple[float, ...]:
    """Return the steps 1, 2, 5 · 10^k s, ascending, from a fifth to 200 times the step of a plain run.

    With `quick` they begin at the step of a plain run itself. `parameters` None: the values of the file.
    """
    usual = find_default_step(simulation, parameters)
    return measured.list_round_numbers(usual * (1 if quick else FINEST), usual * COARSEST)


def select_references(simulation: Simulation, settings: Sequence[Setting]) -> tuple[Setting, Setting]:
    """Return the settings of both reference runs: two methods at much tighter tolerances, or one method at two
    tolerances.

    In a scene that allows only fixed steps, they are the finest of the tested `settings` divided by 4 and by 8.
    """
    fitting = [setting for setting in REFERENCES if setting.method in simulation.source.methods]
    if fitting:
        return fitting[0], fitting[1] if len(fitting) > 1 else replace(fitting[0], value=SECOND)
    finest = min(settings, key=lambda setting: setting.value)
    return finest.refine(FINER[0]), finest.refine(FINER[1])


def _measure_settings(
    window: SceneWindow, settings: Sequence[Setting], reference_settings: Sequence[Setting], progress: Report
) -> SceneBench:
    """Run the two references, then measure every setting against them, and return the bench of the scene.

    The shortest contact is taken from the first successful reference. If a reference failed, the agreement is infinite,
    so that no error counts as resolved. After Ctrl-C the times of the right-hand side are left out.
    """
    count = len(settings) + len(reference_settings)

    def run_setting(index: int, setting: Setting) -> Attempt:
        """Run one setting and report progress; `index` is its number among references and settings.

        Cross-checks by solvers in Python are stopped after CROSS_CHECK_LIMIT_S seconds. Returns the attempt.
        """
        text = f"{setting.method} {setting}"
        limited = replace(window, limit=CROSS_CHECK_LIMIT_S) if setting.method in python_driver.NAMES else window
        return limited.run(setting, lambda fraction, _: progress((index + fraction) / count, text))

    reference_attempts = [
        run_setting(index, setting) for index, setting in enumerate(reference_settings)
    ]  # without them there is nothing to say
    successful = [a for a in reference_attempts if a.run is not None and not a.failure]
    agreement, contact = Error(math.inf, math.inf, math.inf), NAN
    if successful and successful[0].run is not None:
        lengths = successful[0].run.impacts["t_off"] - successful[0].run.impacts["t_on"]
        contact = float(np.nanmin(lengths)) if np.isfinite(lengths).any() else NAN
    if len(successful) == 2 and successful[0].run is not None and successful[1].run is not None:
        agreement = compare_runs(successful[0].run, successful[1].run)
    rows, left_out, missing = _measure_rows(
        window, settings, successful, lambda k, one: run_setting(len(reference_settings) + k, one)
    )
    rhs = () if missing else tuple(measure_rhs_time(window.simulation, window.t_end))
    name = window.simulation.source.scene
    return SceneBench(
        name,
        window.t_end,
        window.why,
        tuple(rows),
        tuple(reference_settings),
        agreement,
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
    """Measure the settings in order; return their rows, reasons for omitted settings, and how many Ctrl-C left out.

    run_setting: runs the k-th setting and returns its attempt. If a cross-check is stopped, or takes longer than
    MAX_CROSS_CHECK_S seconds, its tighter settings are left out.
    """
    rows: list[Row] = []
    slow: dict[str, str] = {}
    for k, setting in enumerate(settings):
        if setting.method in slow:
            continue
        try:
            outcome = run_setting(k, setting)
            if outcome.slow:
                slow[setting.method] = f"{setting.method}: {setting} and tighter left out: {outcome.failure}"
                continue
            rows.append(_measure_row(window, outcome, references))
        except KeyboardInterrupt:
            return rows, list(slow.values()), sum(setting_left.method not in slow for setting_left in settings[k:])
        if (
            setting.method in python_driver.NAMES
            and _read_run_time(outcome) > MAX_CROSS_CHECK_S
            and k + 1 < len(settings)
        ):
            next_setting = settings[k + 1]
            if next_setting.method == setting.method:
                reason = f"{setting} took {_read_run_time(outcome):.2g} s"
                slow[setting.method] = f"{setting.method}: {next_setting} and tighter left out: {reason}"
    return rows, list(slow.values()), 0


def _read_run_time(attempt: Attempt) -> float:
    """Return the wall time (s) that the run of an attempt needed; 0 if the attempt has no result."""
    return attempt.run.diagnostics.seconds if attempt.run is not None else 0.0


def _measure_row(window: SceneWindow, attempt: Attempt, references: Sequence[Attempt]) -> Row:
    """Return the row of an attempt: its error against a reference by another method, and its run time by repeated runs.

    A failed attempt gets a row with the failure, and is not timed. A cross-check that took longer than
    `window.timing_budget` is not repeated.
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
    )  # nor by the same from elsewhere
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
    """Return the first reference whose method is not among `methods`, else the last one; None without references."""
    return next(
        (attempt for attempt in references if attempt.setting.method not in methods),
        references[-1] if references else None,
    )


def _measure_kinematic_scene(
    simulation: Simulation,
    parameters: Parameters,
    sample_counts: Sequence[int],
    t_end: float | None,
    progress: Report | None,
) -> SceneBench:
    """Measure the kinematic method of a scene without degrees of freedom for each number of samples in `sample_counts`.

    The error is the residual of the constraint equations after Newton's method, divided by the size of the mechanism.
    t_end (s): by default the end of a plain run; None or 0 mean the default. A failed run gets a row with the failure.
    Returns a SceneBench.
    """
    window = SceneWindow(simulation, t_end or evaluate_end(simulation.compiled, parameters), parameters)
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

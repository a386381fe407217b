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
from gudgeon.language.argument_checks import flag, function, mapping, numbers, positive
from gudgeon.model.default_step import plain_end
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies import runs as measured
from gudgeon.studies.methods import ADAPTIVE, RhsTime, choice, time_rhs
from gudgeon.studies.runs import NAN, Attempt, Error, Parameters, Setting, Work, difference, natural_step, size

FINEST, COARSEST = 1 / 5, 200  # steps that are tested, of the step that a plain run takes
REFERENCE_STEPS = 200_000  # of the finest step: what bounds a smooth scene's window
FINER = (4, 8)  # where nothing but a fixed step fits: the references' steps, the finest tested one divided by these
REFERENCES = (Setting("dop853", 1e-13), Setting("rodas5p", 1e-12))
SECOND = 1e-12  # tolerance of the second reference if one method is both
TOLERANCES = tuple(float(f"1e-{k}") for k in range(3, 12))
KINEMATIC = (10, 100, 1_000, 10_000)  # samples of a scene without a degree of freedom
LONG, LIMIT = 2.0, 5.0  # s: run time after which a cross-check gets no tighter tolerance; after which it is stopped
QUICK = 0.02  # s of timed runs
TRUSTED = 20  # times the references' difference: smaller errors are not resolved
SMALL = 1e-3  # the largest error from which an order is determined
STRAIGHT = math.log(2.5)  # the largest deviation of points from a line that determines an order


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
        """Whether Ctrl-C left rows out."""
        return self.missing > 0

    @property
    def done(self) -> tuple[int, int]:
        """Number of measured rows, and of requested rows."""
        return len(self.rows), len(self.rows) + self.missing

    @property
    def methods(self) -> tuple[str, ...]:
        """Names of the measured methods in order."""
        return tuple(dict.fromkeys(row.setting.method for row in self.rows))

    def of(self, method: str) -> list[Row]:
        """Return the rows of a method."""
        return [row for row in self.rows if row.setting.method == method]

    def order(self, measure: str, method: str = "rk4") -> float:
        """Return the order of convergence: the slope of log(error) over log(step), over errors neither rounding nor
        large.

        NaN for fewer than three points, or points that are not on a line (a stiff scene at its stability limit).
        """
        points = [(row.setting.value, getattr(row.error, measure)) for row in self.of(method) if not row.failure]
        kept = np.log([(h, e) for h, e in points if self.resolved(measure, e) and e < SMALL])
        if len(kept) < 3:
            return NAN
        line = np.polyfit(kept[:, 0], kept[:, 1], 1)
        return float(line[0]) if np.std(np.polyval(line, kept[:, 0]) - kept[:, 1]) < STRAIGHT else NAN

    def resolved(self, measure: str, error: float) -> bool:
        """Return whether an error exceeds the uncertainty of the references."""
        return error > TRUSTED * getattr(self.agreement, measure)

    def row(self, setting: Setting) -> Row | None:
        """Return the row of a setting, None if it was not measured."""
        return next((r for r in self.of(setting.method) if math.isclose(r.setting.value, setting.value)), None)

    def seconds_to(self, error: float, method: str) -> float:
        """Return the least run time (s per simulated second) with every error at most `error`; NaN if no row has it.

        NaN also if the uncertainty of the references exceeds the error.
        """
        if any(TRUSTED * getattr(self.agreement, m) > error for m in ("motion", "path", "force")):
            return NAN
        return min((r.seconds for r in self.of(method) if not r.failure and r.error.largest <= error), default=NAN)


Report = Callable[[float, str], None]


def bench(
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
    """Measure one scene. `steps` (s) of rk4 default to 1, 2, 5 · 10^k around the step of a plain run.

    `methods`: as in `choice`, by default all that fit. `tolerances` default to 1e-3 … 1e-11. `t_end` (s) defaults to
    the first few contacts or, without contact, to as many of the shortest steps as are affordable. `quick` measures
    fewer of both over a tenth of the window, for a shorter time, without cross-checks. After Ctrl-C the rows so far are
    returned.
    """
    parameters, progress = dict(mapping(parameters, "parameters")), function(progress, "progress")
    t_end, quick = None if t_end is None else positive(t_end, "t_end"), flag(quick, "quick")
    if simulation.source.degrees_of_freedom == 0:
        return _measure_kinematic(simulation, parameters, KINEMATIC[:3] if quick else KINEMATIC, t_end, progress)
    selected, left_out = choice(simulation, methods, quick)
    usual = usual_steps(simulation, parameters, quick)
    steps = sorted(numbers(steps, "steps") or usual, reverse=True)
    tolerances = sorted(numbers(tolerances, "tolerances") or (TOLERANCES[1::3] if quick else TOLERANCES), reverse=True)
    if not steps[-1] > 0 or not 0 < tolerances[-1] <= tolerances[0] < 1:
        raise BadValueError("expected positive steps (s) and tolerances between 0 and 1")
    longest = max(REFERENCE_STEPS * steps[-1] / (10 if quick else 1), 2 * steps[0])
    pilot = Setting("rk4", natural_step(simulation, parameters))
    work = Work(simulation, t_end, parameters) if t_end else measured.window(simulation, longest, pilot, parameters)
    work = replace(work, enough=QUICK if quick else work.enough)
    settings = [Setting("rk4", step) for step in steps if "rk4" in selected]
    settings += [Setting(method, x) for method in selected if method in ADAPTIVE for x in tolerances]
    checks = [method for method in selected if method in python_driver.NAMES]
    if checks:
        _ = simulation.full  # derived and compiled before any of them is timed
    settings += [Setting(method, x) for method in checks for x in tolerances[::2]]
    expected = references(simulation, settings)
    found = _measure(work, settings, expected, progress or (lambda fraction, text: None))
    return replace(found, left_out=(*left_out, *found.left_out))


def usual_steps(simulation: Simulation, parameters: Parameters | None = None, quick: bool = False) -> tuple[float, ...]:
    """Return steps 1, 2, 5 · 10^k s around the step of a plain run."""
    usual = natural_step(simulation, parameters)
    return measured.round_numbers(usual * (1 if quick else FINEST), usual * COARSEST)


def references(simulation: Simulation, settings: Sequence[Setting]) -> tuple[Setting, Setting]:
    """Return the settings of both references: two methods at much tighter tolerance, or one method at two tolerances.

    In a scene that allows only fixed steps, they are the finest step divided by FINER.
    """
    fitting = [setting for setting in REFERENCES if setting.method in simulation.source.methods]
    if fitting:
        return fitting[0], fitting[1] if len(fitting) > 1 else replace(fitting[0], value=SECOND)
    finest = min(settings, key=lambda setting: setting.value)
    return finest.finer(FINER[0]), finest.finer(FINER[1])


def _measure(
    work: Work, settings: Sequence[Setting], wanted_references: Sequence[Setting], progress: Report
) -> SceneBench:
    """Run the references, then every setting: once to compare and several times to measure the time."""
    count = len(settings) + len(wanted_references)

    def attempt(done: int, setting: Setting) -> Attempt:
        """Run one setting, cross-checks with a time limit."""
        text = f"{setting.method} {setting}"
        limited = replace(work, limit=LIMIT) if setting.method in python_driver.NAMES else work
        return limited.run(setting, lambda fraction, _: progress((done + fraction) / count, text))

    found = [
        attempt(done, setting) for done, setting in enumerate(wanted_references)
    ]  # without them there is nothing to say
    good = [a for a in found if a.run is not None and not a.failure]
    agreement, contact = Error(math.inf, math.inf, math.inf), NAN
    if good and good[0].run is not None:
        lengths = good[0].run.impacts["t_off"] - good[0].run.impacts["t_on"]
        contact = float(np.nanmin(lengths)) if np.isfinite(lengths).any() else NAN
    if len(good) == 2 and good[0].run is not None and good[1].run is not None:
        agreement = difference(good[0].run, good[1].run)
    rows, left_out, missing = _make_rows(work, settings, good, lambda k, one: attempt(len(wanted_references) + k, one))
    rhs = () if missing else tuple(time_rhs(work.simulation, work.t_end))
    name = work.simulation.source.scene
    return SceneBench(
        name,
        work.t_end,
        work.why,
        tuple(rows),
        tuple(wanted_references),
        agreement,
        contact,
        rhs,
        tuple(left_out),
        missing,
    )


def _make_rows(
    work: Work, settings: Sequence[Setting], good: Sequence[Attempt], attempt: Callable[[int, Setting], Attempt]
) -> tuple[list[Row], list[str], int]:
    """Return the rows from loose to tight, the reasons for rows left out, and the number of rows that Ctrl-C left out.

    If a cross-check was slow, its tighter settings are left out.
    """
    rows: list[Row] = []
    slow: dict[str, str] = {}
    for k, setting in enumerate(settings):
        if setting.method in slow:
            continue
        try:
            found = attempt(k, setting)
            if found.slow:
                slow[setting.method] = f"{setting.method}: {setting} and tighter left out: {found.failure}"
                continue
            rows.append(_make_row(work, found, good))
        except KeyboardInterrupt:
            return rows, list(slow.values()), sum(other.method not in slow for other in settings[k:])
        if setting.method in python_driver.NAMES and _run_time(found) > LONG and k + 1 < len(settings):
            following = settings[k + 1]
            if following.method == setting.method:
                took = f"{setting} took {_run_time(found):.2g} s"
                slow[setting.method] = f"{setting.method}: {following} and tighter left out: {took}"
    return rows, list(slow.values()), 0


def _run_time(measured_run: Attempt) -> float:
    """Return the run time of an attempt, s; 0 without a result."""
    return measured_run.run.diagnostics.seconds if measured_run.run is not None else 0.0


def _make_row(work: Work, measured_run: Attempt, good: Sequence[Attempt]) -> Row:
    """Return the row of an attempt, with error and timed runs."""
    if measured_run.failure or measured_run.run is None:
        return Row(
            measured_run.setting,
            NAN,
            0,
            Error(),
            0,
            0,
            None,
            measured_run.failure or "no result",
            measured_run.failed_at,
        )
    diagnostics = measured_run.run.diagnostics
    names = diagnostics.method.split("+")
    other = reference_by_other_method(
        [*names, names[0].rpartition(":")[2].lower()], good
    )  # nor by the same from elsewhere
    error = difference(measured_run.run, other.run) if other is not None and other.run is not None else Error()
    known = diagnostics.seconds if measured_run.setting.method in python_driver.NAMES else 0.0
    seconds = known if known > work.enough else work.seconds(measured_run.setting)
    return Row(
        measured_run.setting,
        seconds / work.t_end,
        diagnostics.right_hand_sides,
        error,
        diagnostics.jacobians,
        0,
        None if other is None else other.setting,
    )


def reference_by_other_method(methods: Iterable[str], good: Sequence[Attempt]) -> Attempt | None:
    """Return the first reference by none of these methods, else the last (the finest step); None without references."""
    return next((a for a in good if a.setting.method not in methods), good[-1] if good else None)


def _measure_kinematic(
    simulation: Simulation,
    parameters: Parameters,
    counts: Sequence[int],
    t_end: float | None,
    progress: Report | None,
) -> SceneBench:
    """Measure the kinematic method; its error is the residual of the constraints after Newton's method."""
    work = Work(simulation, t_end or plain_end(simulation.compiled, parameters), parameters)
    rows = []
    for done, count in enumerate(counts):
        if progress:
            progress(done / len(counts), f"{count} samples")
        setting = Setting("kinematic", work.t_end / count)
        found = work.sampled(setting, np.linspace(0.0, work.t_end, count + 1))
        if found.run is None or found.failure:
            failed = found.failure or "no result"
            rows.append(Row(setting, NAN, 0, Error(), 0, count, None, failed, found.failed_at))
            continue
        seconds = work.seconds(setting, count) / work.t_end
        error = Error(found.run.diagnostics.phi_max / size(found.run))
        rows.append(Row(setting, seconds, 0, error, samples=count))
    rhs = tuple(time_rhs(simulation, work.t_end))
    return SceneBench(simulation.source.scene, work.t_end, "", tuple(rows), (), Error(), NAN, rhs)

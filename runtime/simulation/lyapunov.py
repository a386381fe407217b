"""Compute the largest Lyapunov exponent of a scene's motion, and of its returns to a Poincaré section.

The run proceeds in intervals, together with a neighbouring state. The neighbour is a second run (neighbours.py), or a
tangent vector (tangent.py) where the Jacobian describes all that neighbours do. At a section of an autonomous scene,
differences along the motion are removed, since they neither grow nor decay. What remains is the exponent of the return
map. If drives or forces depend on t, or the section is a period, nothing is removed.

Returns to a section are states at an event of the file, or once per period. A point of the section contains lengths
over the mechanism's size, cosine and sine of angles, and velocities over their largest rms. Joints with play add e/c,
because motion within a clearance is too small for the mechanism's size to show.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.linkage import find_angles
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, InputError
from gudgeon.integrators.adaptive import parse_tolerance
from gudgeon.language.argument_checks import check_text, raise_bad_value
from gudgeon.language.deprecations import TWIN, warn_deprecated
from gudgeon.language.functions import JUMPING
from gudgeon.language.tree import iterate_names, list_functions
from gudgeon.model.compiled import Array
from gudgeon.model.file_expressions import read_expression_trees
from gudgeon.model.parameters import compute_cached_run_values
from gudgeon.model.sizes import compute_mechanism_sizes
from gudgeon.results.lyapunov import Lyapunov, Section
from gudgeon.results.results import Result
from gudgeon.simulation.arguments import evaluate_end_time, parse_seconds
from gudgeon.simulation.neighbours import INITIAL_DISTANCE, DifferenceNorm, SecondRun
from gudgeon.simulation.predictability_horizon import build_repeat_settings, build_start_state, check_simulation_of_run
from gudgeon.simulation.restart import copy_checked_state, merge_parameters
from gudgeon.simulation.tangent import Flow, Tangent

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.results import State
    from gudgeon.results.samples import AtEvents
    from gudgeon.simulation.simulation import Simulation


METHODS = ("auto", "tangent", "two_trajectory")  # methods for the growth of differences
RTOL = 1e-12  # default tolerance of the runs: far below the distance of neighbours
# largest tolerance of a second run: if the steps of both runs differ, the runs differ by the error of a step
MAX_RTOL_OF_SECOND_RUN = 1e-10
N_SAMPLES = 1000  # samples by which the motion is measured
MIN_INTERVALS = 60  # number of intervals of the time; at least one per period
MIN_INTERVAL = 2.0**-12  # shortest interval, relative to the longest
PERIOD_TOL = 1e-6  # of a period: by which a time may differ from a multiple of it


def explain_invalid_variational_equation(source: KernelSource) -> str:
    """Return why the variational equation does not describe the motions of neighbouring states; "" where it does.

    It has no Jacobian, or misses internal states of laws, sticking, impulses of drives or jumps of forces.
    """
    if source.reason_without_jacobian:
        return source.reason_without_jacobian
    if source.internal_states:
        return f"a law has an internal state, {next(filter(None, source.internal_states))}, which is not a coordinate"
    if source.frictions:
        return f"{source.frictions[0]} sticks and slips: its constraint equations change"
    if source.rate_jumps:
        return f"the rate of the drive {source.rate_jumps[0]} may jump: the linkage follows by an impulse"
    if source.laws:
        return f"the law {source.laws[0][0]} is user-defined: its jumps are not known"
    for info, tree in read_expression_trees(source, ("forces",)):
        if function_names := sorted(list_functions(tree) & JUMPING):
            return f"{info.address} calls {function_names[0]}, which may jump"
    return ""


def compute_lyapunov_exponent(
    simulation: Simulation,
    end_or_run: float | str | Result,
    section: str | float | None,
    by: str,
    skip: float | str,
    settings: dict[str, Any],
    parameters: Mapping[str, float | str] | None,
    start: State | None,
    progress: Progress | None,
) -> Lyapunov:
    """Compute the largest Lyapunov exponent of a motion, and its returns to a section; arguments as in
    Simulation.lyapunov.

    `settings`: method, rtol and step of all runs. Raises BadValueError without degrees of freedom, for arguments, and
    for a span that is too short. Ctrl-C is passed on.
    """
    source = simulation.source
    t_end: float | str
    if isinstance(end_or_run, Result):
        t_end, start, settings = _read_run_settings(simulation, end_or_run, parameters, start, settings)
    else:
        t_end = end_or_run
    if source.degrees_of_freedom <= 0:
        raise BadValueError("without a degree of freedom no difference can grow: drives determine the motion")
    reason = _find_reason_for_second_run(source, check_text(by, "by"))
    settings = _add_default_rtol(settings, reason is not None)
    arguments_of_start = _compute_settled_start(simulation, skip, settings, parameters, start)
    measured_run = simulation.simulate(
        t_end, output=N_SAMPLES, stop=False, peaks=(), progress=progress, **arguments_of_start, **settings
    )
    if measured_run.diagnostics.interrupted:
        raise KeyboardInterrupt
    returns = SectionReturns.from_run(measured_run, section)
    norm = DifferenceNorm.from_run(measured_run, simulation.compiled)
    _require_sufficient_motion(measured_run, norm)
    transverse = bool(returns.event) and not _has_time_dependence(source)
    arguments = (simulation, norm, settings, build_start_state(measured_run), transverse)
    neighbour = (
        SecondRun(*arguments) if reason is not None else Tangent(*arguments, Flow(simulation.compiled, measured_run))
    )
    t, log_growths = [float(measured_run.t[0])], []
    for run, log_growth in _yield_intervals(neighbour, t[0], float(measured_run.t[-1]), returns.period, progress):
        t.append(float(run.t[-1]))
        log_growths.append(log_growth)
        returns.append_run(run)
    return Lyapunov(
        "tangent" if reason is None else "two_trajectory",
        reason or "",
        np.array(t),
        np.array(log_growths),
        neighbour.growth_error / (t[-1] - t[0]),
        neighbour.n_coincidences,
        transverse,
        returns.build_section(),
        neighbour.state,
    )


def explain_slow_variational_equation(source: KernelSource) -> str:
    """Return why by="auto" uses a second run although the variational equation is valid; "" where that is fast.

    The reason is a film, which is stiff: the collocation of the variational equation needs as many panels as the run
    has steps.
    """
    films = [joint.name for joint in source.clearances if joint.film]
    return f"the film of {films[0]} is stiff: the mesh of the tangent is as fine as its steps" if films else ""


def _require_sufficient_motion(run: Result, norm: DifferenceNorm) -> None:
    """Raise BadValueError if the motion hardly changes in the run, so that its mean growth is not an exponent."""
    if norm.is_run_too_short(run):
        span = float(run.t[-1] - run.t[0])
        message = f"a span of {span:.3g} s is too short for a Lyapunov exponent: it has no swing, turn or contact"
        raise BadValueError(message, hint="expected a span of several swings, turns or contacts: an exponent is a mean")


def _read_run_settings(
    simulation: Simulation,
    run: Result,
    parameters: Mapping[str, float | str] | None,
    start: State | None,
    settings: dict[str, Any],
) -> tuple[float, State, dict[str, Any]]:
    """Return end (s), start and settings of simulate for the exponent of a given run.

    Method and step are those of the run unless `settings` has others; its tolerance is not used. Raises
    BadValueError for a run of another scene, or if parameters or a start are given too. `parameters` and `start` must
    be None.
    """
    check_simulation_of_run(simulation, run, "lyapunov")
    if parameters is not None or start is not None:
        hint = "leave out parameters and start"
        raise BadValueError("lyapunov of a run: start and parameters are those of the run", hint=hint)
    run_settings = {name: value for name, value in build_repeat_settings(run)[0].items() if name in ("method", "step")}
    requested = {name: value for name, value in settings.items() if value is not None and value != "auto"}
    return float(run.t[-1]), build_start_state(run), settings | run_settings | requested


def _yield_intervals(
    neighbour: SecondRun | Tangent, begin: float, end: float, period: float, progress: Progress | None
) -> Iterator[tuple[Result, float]]:
    """Yield the run of each interval from `begin` to `end` (s), and ln of the growth of the difference in it.

    Intervals are halved where the difference grows too much, then lengthened again. Ends of periods are ends of
    intervals; `period` is 0 without one. `progress` is called after each.
    """
    longest = (end - begin) / MIN_INTERVALS
    if period:
        longest = period / math.ceil(period / longest)
    t, h = begin, longest
    while t < end:
        interval_end = min(begin + (math.floor((t - begin) / longest * (1.0 + 1e-12) + 1e-6) + 1) * longest, end)
        interval_end = end if end - interval_end < 1e-6 * longest else interval_end
        t_next = interval_end if t + h > interval_end - 1e-3 * h else t + h
        advanced = neighbour.advance_to(t_next, h <= MIN_INTERVAL * longest)
        if advanced is None:
            h = 0.5 * (t_next - t)
            continue
        t, h = t_next, min(2.0 * h, longest) if abs(advanced[1]) < 1.0 else h
        yield advanced
        if progress:
            progress((t - begin) / (end - begin), "integrating a neighbouring state")


def _find_reason_for_second_run(source: KernelSource, method: str) -> str | None:
    """Return the reason for a second run ("" if the user requested it); None if the tangent is used.

    `method`: argument `by` of Simulation.lyapunov. Raises BadValueError for an unknown one, and for "tangent" where the
    Jacobian does not suffice.
    """
    if method == "twin":
        warn_deprecated(TWIN)
        method = "two_trajectory"
    if method not in METHODS:
        raise_bad_value("by", method, f"one of {', '.join(METHODS)}")
    reason = explain_invalid_variational_equation(source)
    if method == "tangent" and reason:
        raise BadValueError(f"no exponent by the tangent: {reason}", hint='by="two_trajectory" uses a second run')
    reason = reason or (explain_slow_variational_equation(source) if method == "auto" else "")
    return None if method == "tangent" or (method == "auto" and not reason) else reason


def _add_default_rtol(settings: dict[str, Any], has_second_run: bool) -> dict[str, Any]:
    """Return the arguments of simulate for all runs: those of `settings` that are not None, and an rtol by default.

    The default is RTOL; it is not added with a fixed step (`step`, or method rk4). Raises BadValueError for an rtol
    above MAX_RTOL_OF_SECOND_RUN if a second run is integrated (`has_second_run`).
    """
    given = {name: value for name, value in settings.items() if value is not None}
    if given.get("step") is not None or str(given.get("method")) == "rk4":
        return given
    given = {"rtol": RTOL} | given
    if has_second_run and parse_tolerance(given["rtol"], "auto", False) > MAX_RTOL_OF_SECOND_RUN:
        message = (
            f"rtol is {given['rtol']}: errors of steps would change the distance of the second run,"
            f" {INITIAL_DISTANCE:g} at first"
        )
        raise BadValueError(message, hint=f"expected {MAX_RTOL_OF_SECOND_RUN:g} or less; the default is {RTOL:g}")
    return given


def limit_rtol_of_neighbours(source: KernelSource, rtol: float | None) -> float | None:
    """Return the relative tolerance of runs that are compared with a neighbour: `rtol`, limited; None stays None.

    It is at most MAX_RTOL_OF_SECOND_RUN where by="auto" integrates a second run.
    """
    return (
        min(rtol, MAX_RTOL_OF_SECOND_RUN)
        if rtol is not None
        and (explain_invalid_variational_equation(source) or explain_slow_variational_equation(source))
        else rtol
    )


def _compute_settled_start(
    simulation: Simulation,
    skip: float | str,
    settings: dict[str, Any],
    parameters: Mapping[str, float | str] | None,
    start: State | None,
) -> dict[str, Any]:
    """Run the scene for `skip` (s) and return the arguments `start` and, if needed, `parameters` of the run after that.

    With skip 0 nothing is run, and the given arguments are returned. Raises BadValueError for a negative or infinite
    time, KeyboardInterrupt after Ctrl-C. `parameters` and `start` None: those of the file.
    """
    state = None if start is None else copy_checked_state(simulation.source, start)
    given, is_given, _ = merge_parameters(simulation.compiled, state, parameters)
    p, _ = compute_cached_run_values(simulation.compiled, given, is_given)
    start_time = evaluate_end_time(simulation.source, skip, p)
    duration = parse_seconds("skip", 0.0 if start_time is None else start_time)
    if not (math.isfinite(duration) and duration >= 0.0):
        raise BadValueError(f"skip is {duration:g} s: expected a time of zero or more")
    arguments: dict[str, Any] = {"start": start, "parameters": parameters}
    if duration == 0.0:
        return arguments
    t = duration + (0.0 if state is None else state.t)
    run = simulation.simulate(t, output=1, stop=False, peaks=(), **arguments, **settings)
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt
    return {"start": run.final}


def _has_time_dependence(source: KernelSource) -> bool:
    """Return whether the expression of a drive or a force contains the time t."""
    return any(
        name.path == "t"
        for _, tree in read_expression_trees(source, ("drives", "forces"))
        for name in iterate_names(tree)
    )


@dataclass(eq=False)
class SectionReturns:
    """Collect the returns of a run to a Poincaré section.

    The section is an `event` of the file, or the end of each `period` (s; 0: none) from `begin` (s).
    """

    event: str
    period: float
    begin: float
    size: float
    speed: float  # m/s, and 1/s of angles times the size
    extent: float  # rms distance of the motion's points from their mean
    t: list[float] = field(default_factory=list)
    points: list[Array] = field(default_factory=list)

    @staticmethod
    def from_run(run: Result, section: str | float | None) -> SectionReturns:
        """Create an empty collection of returns, with scales from `run`, which spans the whole motion.

        Raises InputError for an invalid section. `section`: an event, a period (s), or None for no section.
        """
        event, period = _parse_section(run, section)
        size = float(compute_mechanism_sizes(run.source, run.p))
        per = np.where(find_angles(run.source), 1.0, size)
        speed = float(np.sqrt(np.mean(np.square(run.v / per), axis=0)).max(initial=0.0)) * size
        returns = SectionReturns(event, period, float(run.t[0]), size, speed or size, 0.0)
        points = returns._compute_points(run)
        returns.extent = float(np.sqrt(np.mean(np.sum(np.square(points - points.mean(axis=0)), axis=1))))
        return returns

    def append_run(self, run: Result) -> None:
        """Append the returns in `run`, the next part of the motion, to `t` and `points`.

        They are its events, or its end if that is a multiple of the period.
        """
        if self.event:
            events = run.at_events(self.event)
            self.t += events.t.tolist()
            self.points += list(self._compute_points(events)) if len(events) else []
        elif self.period:
            turns = (float(run.t[-1]) - self.begin) / self.period
            if round(turns) > 0 and abs(turns - round(turns)) < PERIOD_TOL:
                self.t.append(float(run.t[-1]))
                self.points.append(self._compute_points(run)[-1])

    def build_section(self) -> Section | None:
        """Return the collected times and points as a Section; None without an event or a period."""
        if not (self.event or self.period):
            return None
        points = np.array(self.points) if self.points else np.zeros((0, 1))
        return Section(self.event or f"every {self.period:.6g} s", np.array(self.t), points, self.extent)

    def _compute_points(self, run: Result | AtEvents) -> Array:
        """Return the dimensionless points (k, d) of all samples of a run, or of its states at events.

        They contain scaled positions, cosines and sines of angles, scaled velocities, and e/c of each joint with play.
        """
        source = run.source if not hasattr(run, "all") else run.all.source
        p = run.p if not hasattr(run, "all") else run.all.p
        angle = find_angles(source)
        scale = np.where(angle, 1.0, self.size)
        columns = [
            run.q[:, ~angle] / self.size,
            np.cos(run.q[:, angle]),
            np.sin(run.q[:, angle]),
            run.v / scale * (self.size / self.speed),
        ]
        columns += [
            (run[f"{joint.name}.{axis}"] / p[joint.clearance])[:, None]
            for joint in source.clearances
            for axis in ("ex", "ey")
        ]
        return np.concatenate(columns, axis=1)


def _parse_section(run: Result, section: str | float | None) -> tuple[str, float]:
    """Return the event's name and the period (s) of the requested section; "" or 0.0 for the part that does not apply.

    Both are empty if `section` is None. Raises BadValueError for a period outside the run, UnknownNameError for an
    unknown event.
    """
    if section is None:
        return "", 0.0
    events = [event.name for event in run.source.events]
    if isinstance(section, str) and section in events:
        return section, 0.0
    try:
        section_time = evaluate_end_time(run.source, section, run.p)
        period = parse_seconds("section", 0.0 if section_time is None else section_time)
    except InputError as error:
        if isinstance(section, str) and section.isidentifier():
            run.events_of(section)  # UnknownNameError names the nearest
        raise error
    if not (math.isfinite(period) and 0.0 < period < run.t[-1] - run.t[0]):
        message = f"section is {period:g} s: expected an event of the file, or a period within the run"
        raise BadValueError(message, hint=f"its events: {', '.join(events) or 'none'}; a period as '2*pi/omega'")
    return "", period

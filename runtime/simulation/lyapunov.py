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

from gudgeon.assembly.linkage import angles
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, InputError
from gudgeon.integrators.adaptive import tolerance
from gudgeon.language.argument_checks import refuse, text
from gudgeon.language.functions import JUMPING
from gudgeon.language.tree import functions, names
from gudgeon.model.compiled import Array
from gudgeon.model.parameters import prepare_slots
from gudgeon.model.sizes import mechanism_sizes
from gudgeon.model.written import trees
from gudgeon.results.lyapunov import Lyapunov, Section
from gudgeon.results.results import Result
from gudgeon.simulation.arguments import end_of, seconds
from gudgeon.simulation.horizon import check_simulation_of_run, repeat_settings, start_of_run
from gudgeon.simulation.neighbours import NEAR, Neighbours, SecondRun
from gudgeon.simulation.restart import numbers, own
from gudgeon.simulation.tangent import Flow, Tangent

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.results import State
    from gudgeon.results.samples import AtEvents
    from gudgeon.simulation.simulation import Simulation


WAYS = ("auto", "tangent", "twin")  # methods for the growth of differences
RTOL = 1e-12  # default tolerance of the runs: far below the distance of neighbours
# loosest tolerance of a second run: if only one run takes another step, they differ by the error of the step
LOOSEST = 1e-10
LOOKED = 1000  # samples by which the motion is measured
INTERVALS = 60  # number of intervals of the time; at least one per period
SHORTEST = 2.0**-12  # shortest interval, relative to the longest
ON_TIME = 1e-6  # of a period: by which a time may differ from a multiple of it


def reason_without_tangent(source: KernelSource) -> str:
    """Return why the Jacobian does not describe all motions of neighbours; "" where it does."""
    if source.no_slopes:
        return source.no_slopes
    if source.states:
        return f"a law has an inner state, {next(filter(None, source.states))}, which is no coordinate"
    if source.frictions:
        return f"{source.frictions[0]} sticks and slips: its rows come and go"
    if source.rate_jumps:
        return f"the rate of the drive {source.rate_jumps[0]} may jump: the linkage follows by an impulse"
    if source.laws:
        return f"the law {source.laws[0][0]} is of one's own: where it jumps is not known"
    for info, tree in trees(source, ("forces",)):
        if found := sorted(functions(tree) & JUMPING):
            return f"{info.address} calls {found[0]}, which may jump"
    return ""


def lyapunov(
    simulation: Simulation,
    until: float | str | Result,
    section: str | float | None,
    by: str,
    skip: float | str,
    settings: dict[str, Any],
    parameters: Mapping[str, float | str] | None,
    start: State | None,
    progress: Progress | None,
) -> Lyapunov:
    """Return the Lyapunov exponent of the motion; arguments as in Simulation.lyapunov."""
    source = simulation.source
    t_end: float | str
    if isinstance(until, Result):
        t_end, start, settings = _of_run(simulation, until, parameters, start, settings)
    else:
        t_end = until
    if source.degrees_of_freedom <= 0:
        raise BadValueError("without a degree of freedom no difference can grow: drives determine the motion")
    why = _reason_for_twin(source, text(by, "by"))
    settings = _run_settings(settings, why is not None)
    begin = _settled_start(simulation, skip, settings, parameters, start)
    looked = simulation.simulate(t_end, output=LOOKED, stop=False, peaks=(), progress=progress, **begin, **settings)
    if looked.diagnostics.interrupted:
        raise KeyboardInterrupt
    returns = Returns.of(looked, section)
    measure = Neighbours.of(looked, simulation.compiled)
    _refuse_short(looked, measure)
    transverse = bool(returns.event) and not _depends_on_time(source)
    arguments = (simulation, measure, settings, start_of_run(looked), transverse)
    pair = SecondRun(*arguments) if why is not None else Tangent(*arguments, Flow(simulation.compiled, looked))
    t, growth = [float(looked.t[0])], []
    for run, grown in _intervals(pair, t[0], float(looked.t[-1]), returns.period, progress):
        t.append(float(run.t[-1]))
        growth.append(grown)
        returns.note(run)
    return Lyapunov(
        "tangent" if why is None else "twin",
        why or "",
        np.array(t),
        np.array(growth),
        pair.unresolved / (t[-1] - t[0]),
        pair.merged,
        transverse,
        returns.section(),
        pair.state,
    )


def reason_against_tangent(source: KernelSource) -> str:
    """Return why `auto` follows a second run although the tangent would do; "" where the tangent is fast."""
    films = [joint.name for joint in source.clearances if joint.film]
    return f"the film of {films[0]} is stiff: the mesh of the tangent is as fine as its steps" if films else ""


def _refuse_short(run: Result, measure: Neighbours) -> None:
    """Raise BadValueError for a span in which the motion hardly changes: no mean over it is a rate of growth."""
    if measure.is_short(run):
        span = float(run.t[-1] - run.t[0])
        message = f"a span of {span:.3g} s is too short for a Lyapunov exponent: nothing turns or strikes in it"
        raise BadValueError(message, hint="expected a span of several swings, turns or contacts: an exponent is a mean")


def _of_run(
    simulation: Simulation,
    run: Result,
    parameters: Mapping[str, float | str] | None,
    start: State | None,
    settings: dict[str, Any],
) -> tuple[float, State, dict[str, Any]]:
    """Return end, start and settings of simulate for the exponent of a given run, with the tolerance of neighbours.

    Raises BadValueError for a run of another scene, or if parameters or a start are given too.
    """
    check_simulation_of_run(simulation, run, "lyapunov")
    if parameters is not None or start is not None:
        hint = "leave out parameters and start"
        raise BadValueError("lyapunov of a run: it has its own start and numbers", hint=hint)
    usual = {name: value for name, value in repeat_settings(run)[0].items() if name in ("method", "step")}
    message = {name: value for name, value in settings.items() if value is not None and value != "auto"}
    return float(run.t[-1]), start_of_run(run), settings | usual | message


def _intervals(
    pair: SecondRun | Tangent, begin: float, end: float, period: float, progress: Progress | None
) -> Iterator[tuple[Result, float]]:
    """Yield the run of each interval and ln of the growth of the difference in it.

    Intervals are halved where the difference grows too much; ends of periods are ends of intervals.
    """
    longest = (end - begin) / INTERVALS
    if period:
        longest = period / math.ceil(period / longest)
    t, h = begin, longest
    while t < end:
        goal = min(begin + (math.floor((t - begin) / longest * (1.0 + 1e-12) + 1e-6) + 1) * longest, end)
        goal = end if end - goal < 1e-6 * longest else goal
        aim = goal if t + h > goal - 1e-3 * h else t + h
        done = pair.advance(aim, h <= SHORTEST * longest)
        if done is None:
            h = 0.5 * (aim - t)
            continue
        t, h = aim, min(2.0 * h, longest) if abs(done[1]) < 1.0 else h
        yield done
        if progress:
            progress((t - begin) / (end - begin), "following a neighbour")


def _reason_for_twin(source: KernelSource, by: str) -> str | None:
    """Return None if the tangent is used, else the reason for a second run. Raises BadValueError."""
    if by not in WAYS:
        refuse("by", by, f"one of {', '.join(WAYS)}")
    why = reason_without_tangent(source)
    if by == "tangent" and why:
        raise BadValueError(f"no exponent by the tangent: {why}", hint='by="twin" takes a second run')
    why = why or (reason_against_tangent(source) if by == "auto" else "")
    return None if by == "tangent" or (by == "auto" and not why) else why


def _run_settings(settings: dict[str, Any], is_twin: bool) -> dict[str, Any]:
    """Return the arguments of simulate for all runs. Raise BadValueError for a tolerance too loose for a second run."""
    given = {name: value for name, value in settings.items() if value is not None}
    if given.get("step") is not None or str(given.get("method")) == "rk4":
        return given
    given = {"rtol": RTOL} | given
    if is_twin and tolerance(given["rtol"], "auto", False) > LOOSEST:
        message = f"rtol is {given['rtol']}: a twin is {NEAR:g} apart, and would measure what steps err by"
        raise BadValueError(message, hint=f"expected {LOOSEST:g} or less; without one it is {RTOL:g}")
    return given


def neighbours_rtol(source: KernelSource, rtol: float | None) -> float | None:
    """Return the tolerance of runs with a neighbour, where that of other runs is `rtol`.

    It is at most LOOSEST where a second run is followed.
    """
    return (
        min(rtol, LOOSEST)
        if rtol is not None and (reason_without_tangent(source) or reason_against_tangent(source))
        else rtol
    )


def _settled_start(
    simulation: Simulation,
    skip: float | str,
    settings: dict[str, Any],
    parameters: Mapping[str, float | str] | None,
    start: State | None,
) -> dict[str, Any]:
    """Return the start and parameters of the measured run, which begins after the motion has settled for `skip` (s)."""
    state = None if start is None else own(simulation.source, start)
    given, is_given, _ = numbers(simulation.compiled, state, parameters)
    p = prepare_slots(simulation.compiled, given, is_given)
    found = end_of(simulation.source, skip, p)
    wait = seconds("skip", 0.0 if found is None else found)
    if not (math.isfinite(wait) and wait >= 0.0):
        raise BadValueError(f"skip is {wait:g} s: expected a time of zero or more")
    arguments: dict[str, Any] = {"start": start, "parameters": parameters}
    if wait == 0.0:
        return arguments
    t = wait + (0.0 if state is None else state.t)
    run = simulation.simulate(t, output=1, stop=False, peaks=(), **arguments, **settings)
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt
    return {"start": run.final}


def _depends_on_time(source: KernelSource) -> bool:
    """Return whether a drive or a force depends on t."""
    return any(name.path == "t" for _, tree in trees(source, ("drives", "forces")) for name in names(tree))


@dataclass(eq=False)
class Returns:
    """Collect the returns of a run to a section: at `event`, or after each `period` (s; 0: none) from `begin` (s)."""

    event: str
    period: float
    begin: float
    size: float
    speed: float  # m/s, and 1/s of angles times the size
    extent: float  # rms distance of the motion's points from their mean
    t: list[float] = field(default_factory=list)
    points: list[Array] = field(default_factory=list)

    @staticmethod
    def of(run: Result, section: str | float | None) -> Returns:
        """Prepare the returns from a run that shows the whole motion. Raise InputError for an invalid section."""
        event, period = _parse_section(run, section)
        size = float(mechanism_sizes(run.source, run.p))
        per = np.where(angles(run.source), 1.0, size)
        speed = float(np.sqrt(np.mean(np.square(run.v / per), axis=0)).max(initial=0.0)) * size
        found = Returns(event, period, float(run.t[0]), size, speed or size, 0.0)
        whole = found._points_of(run)
        found.extent = float(np.sqrt(np.mean(np.sum(np.square(whole - whole.mean(axis=0)), axis=1))))
        return found

    def note(self, run: Result) -> None:
        """Add the returns of a part of the run."""
        if self.event:
            at = run.at_events(self.event)
            self.t += at.t.tolist()
            self.points += list(self._points_of(at)) if len(at) else []
        elif self.period:
            turns = (float(run.t[-1]) - self.begin) / self.period
            if round(turns) > 0 and abs(turns - round(turns)) < ON_TIME:
                self.t.append(float(run.t[-1]))
                self.points.append(self._points_of(run)[-1])

    def section(self) -> Section | None:
        """Return the collected section, or None if no section was requested."""
        if not (self.event or self.period):
            return None
        points = np.array(self.points) if self.points else np.zeros((0, 1))
        return Section(self.event or f"every {self.period:.6g} s", np.array(self.t), points, self.extent)

    def _points_of(self, run: Result | AtEvents) -> Array:
        """Return the points (k, d) of all samples of a run, or of its states at events."""
        source = run.source if not hasattr(run, "all") else run.all.source
        p = run.p if not hasattr(run, "all") else run.all.p
        angle = angles(source)
        per = np.where(angle, 1.0, self.size)
        parts = [
            run.q[:, ~angle] / self.size,
            np.cos(run.q[:, angle]),
            np.sin(run.q[:, angle]),
            run.v / per * (self.size / self.speed),
        ]
        parts += [
            (run[f"{joint.name}.{axis}"] / p[joint.clearance])[:, None]
            for joint in source.clearances
            for axis in ("ex", "ey")
        ]
        return np.concatenate(parts, axis=1)


def _parse_section(run: Result, section: str | float | None) -> tuple[str, float]:
    """Return the event and the period (s) of the requested section; "" and 0.0 if there is none."""
    if section is None:
        return "", 0.0
    events = [event.name for event in run.source.events]
    if isinstance(section, str) and section in events:
        return section, 0.0
    try:
        found = end_of(run.source, section, run.p)
        period = seconds("section", 0.0 if found is None else found)
    except InputError as error:
        if isinstance(section, str) and section.isidentifier():
            run.events_of(section)  # UnknownNameError names the nearest
        raise error
    if not (math.isfinite(period) and 0.0 < period < run.t[-1] - run.t[0]):
        message = f"section is {period:g} s: expected an event of the file, or a period within the run"
        raise BadValueError(message, hint=f"its events: {', '.join(events) or 'none'}; a period as '2*pi/omega'")
    return "", period

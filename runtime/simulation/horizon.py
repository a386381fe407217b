"""How far a run can be trusted: impacts multiply small differences until two honest runs have nothing in common.

`simulate(..., horizon=True)` repeats the run, with a tolerance a hundred times tighter (a step four times smaller), and
from a start that is moved by 1e-12. While they agree, the trace belongs to the scene; beyond, it is one of many that
the same numbers allow, and only its statistics mean anything. The horizon is the last of the compared times before the
run and one of its repetitions part by a quarter: of the radial clearance, in the path of a journal (orbits part for the
eye); in a scene without play of the mechanism's size, of 1 rad in an angle.

Neither t_end nor the output of the run enter. Steps do not depend on them, but for one that an end cuts short, and what
is compared lies on a ladder of times that is the same for every run: 4,000 between 4^k s and 4^(k + 1) s after the
start, from the bottom up, until the runs part. So the resolution is 2e-4 of the horizon or better. Runs that part on
the rung that t_end cuts off are compared again on all of it.

It is a figure of the run, not of the scene alone: each digit of tolerance buys some time, until rounding is what grows.
What all runs may be believed to on the average is ln(apart/error)/λ, where λ is known: Lyapunov.believable.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from gudgeon.assembly.linkage import mechanism_size, project
from gudgeon.errors import BadValueError, SolverError
from gudgeon.integrators.adaptive import SMALLEST, lengths
from gudgeon.language.wanted import instance
from gudgeon.model.compiled import Array

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.results import Result, State
    from gudgeon.results.wear import Rubbing
    from gudgeon.simulation.simulation import Simulation

APART = 0.25  # see above: of the clearance, where orbits part for the eye; dry motion is on a plateau below it
MOVED = 1e-12  # a relative tolerance (integrators/adaptive.py): as much as one step of such a run may err
TIGHTER, SHORTER = 100.0, 4.0  # tolerance, step
UNFINISHED = "interrupted while its horizon was sought: the run is complete, how far to trust it is not known"
TIMES = 4000  # compared times on a rung of the ladder: the horizon's resolution
SHORTEST = 1.0 / 256.0  # of the run's length, about: the ladder's lowest rung


def with_horizon(simulation: Simulation, run: Result, progress: Progress | None = None) -> Result:
    """The run with diagnostics.horizon; see `horizon`. After Ctrl-C the run itself, complete, and a note."""
    try:
        found, interrupted = horizon(simulation, run, progress), False
    except KeyboardInterrupt:
        found, interrupted = math.nan, True
    diagnostics = replace(run.diagnostics, horizon=found)
    if interrupted:
        diagnostics = replace(diagnostics, interrupted=True, notes=(*diagnostics.notes, UNFINISHED))
    return replace(run, diagnostics=diagnostics)


def horizon(simulation: Simulation, run: Result, progress: Progress | None = None, apart: float = APART) -> float:
    """Time (s) up to which a run agrees with its repetitions; inf: to its end.

    The runs are those of `run.diagnostics.method`, from the run's start to its last sample. A repetition that
    ends early (an error) is compared as far as it came. Ctrl-C is passed on. `apart`: see above.
    """
    begin, t1 = begin_of(run), float(run.t[-1])
    t0 = begin.t
    if simulation.source.degrees_of_freedom == 0 or not t1 > t0:
        return math.inf
    usual, tighter = settings_of(run)
    variants = ((begin, usual), (begin, tighter), (_moved(simulation, run, begin), usual))
    known = t0
    for times in _ladder(t0, t1):
        cut = times[-1] > t1
        within = np.append(times[times < t1], t1) if cut else times
        found = _parting(simulation, within, variants, progress, apart)
        if cut and found is not None:
            longer = _parting(simulation, times, variants, progress, apart)
            found = longer if longer is not None and known < longer <= t1 else found
        if found is not None:
            return max(known, found)
        known = float(times[-1])
    return math.inf


def _ladder(t0: float, t1: float) -> Iterator[Array]:
    """Times to compare, rung by rung: each TIMES long and four times as far as the one before; t1 is on the last."""
    top = 4.0 ** math.floor(math.log(SHORTEST * (t1 - t0), 4.0))
    low, last = 0.0, False
    while not last:
        last = not t0 + top < t1
        yield t0 + np.linspace(low, top, TIMES + 1)[1:]
        low, top = top, 4.0 * top


def _parting(
    simulation: Simulation,
    times: Array,
    variants: Iterable[tuple[State, dict[str, Any]]],
    progress: Progress | None,
    apart: float,
) -> float | None:
    """Of runs from these starts with these settings: the last of the times (s) before they part; None: they do not."""
    runs = []
    for start, settings in variants:
        other = repeated(simulation, times, start, settings, progress)
        if other is None:
            return -math.inf
        if other.diagnostics.interrupted:
            raise KeyboardInterrupt
        runs.append(other)
    agreed, parted = _agreement(simulation, runs, apart)
    return agreed if parted else None


def repeated(
    simulation: Simulation,
    times: Array,
    start: State | None,
    settings: dict[str, Any],
    progress: Progress | None,
    peaks: tuple[str | Rubbing, ...] = (),
    stop: bool = False,
) -> Result | None:
    """A run through `times`, as far as it goes, None: not even from the start; `stop`: whether events may end it."""
    try:
        return simulation.simulate(output=times, start=start, progress=progress, stop=stop, peaks=peaks, **settings)
    except SolverError as error:
        return cast("Result | None", error.partial)


def _agreement(simulation: Simulation, runs: list[Result], limit: float) -> tuple[float, bool]:
    """The last compared time (s) at which the first run is no further than `limit` from each of the others, and whether
    that is where they part or one of them ends."""
    count = min(len(run.t) for run in runs)
    paths = [_path(simulation, run)[:count] for run in runs]
    gaps = [np.abs(path - paths[0]).max(axis=1) for path in paths[1:]]
    apart = np.flatnonzero(~(np.maximum(*gaps) <= limit))
    last = int(apart[0]) - 1 if len(apart) else count - 1
    agreed = float(runs[0].t[last]) if last >= 0 else begin_of(runs[0]).t
    return agreed, bool(len(apart)) or any(len(run.t) > count for run in runs)


def _path(simulation: Simulation, run: Result) -> Array:
    """What is compared, (N, …): e/c of all journals, or all coordinates of a scene without play."""
    if run.source.clearances:
        scaled = [
            run[f"{joint.name}.{axis}"] / run.p[joint.clearance]
            for joint in run.source.clearances
            for axis in ("ex", "ey")
        ]
        return np.stack(scaled, axis=1)
    return np.asarray(run.q / np.where(_angles(run), 1.0, mechanism_size(simulation.compiled, run.p)))


def _angles(run: Result) -> Any:
    return np.array([name.endswith(".theta") for name in run.source.coordinates])


def check_own(simulation: Simulation, run: Result, asked: str) -> None:
    """BadValueError for a run of another scene, or a file of it that has no scene, and for what is neither."""
    from gudgeon.results.results import Result
    from gudgeon.simulation.simulation import Simulation

    instance(simulation, "simulation", Simulation)
    instance(run, "run", Result)
    if run.source.whole_sha256 != simulation.source.whole_sha256 or run.source.scene != simulation.source.scene:
        raise BadValueError(f"{asked}: expected the simulation whose run it is")


def settings_of(run: Result) -> tuple[dict[str, Any], dict[str, Any]]:
    """Arguments of simulate for the run as it was, and for the more exact one."""
    from gudgeon.simulation.arguments import METHODS

    d = run.diagnostics
    method = d.method if d.method in METHODS else "adaptive"  # what its steps were made with is not one name
    usual = {"method": method, "parameters": dict(run.final.parameters)}
    if math.isfinite(d.step):
        return usual | {"step": d.step}, usual | {"step": d.step / SHORTER}
    # at the tightest tolerance that there is, the other run is the looser one
    other = d.rtol / TIGHTER if d.rtol >= TIGHTER * SMALLEST else d.rtol * TIGHTER
    return usual | {"rtol": d.rtol}, usual | {"rtol": other}


def _tolerances(simulation: Simulation, run: Result) -> Array:
    """As integrators/adaptive.py has them at MOVED, of all bodies: coordinates, then velocities a unit of speed."""
    length, size = lengths(simulation.compiled, run.p)
    of_q = MOVED * np.where(_angles(run), length / size, length)
    return np.concatenate([of_q, np.full(len(of_q), MOVED)])


def begin_of(run: Result) -> State:
    """The start of a run, as a state to start from: the one that it was given, or its first sample."""
    if run.begun is not None:
        return replace(run.begun, parameters=run.final.parameters)
    run = run.start_row or run
    return replace(run.final, t=float(run.t[0]), q=run.q[0], v=run.v[0], state=run.state[0], memory=run.memory[0])


def _moved(simulation: Simulation, run: Result, start: State) -> State:
    """The start moved by MOVED in a direction drawn once and for all, and back onto the constraints."""
    angle, n = _angles(run), len(start.q)
    draw = np.random.default_rng(1).uniform(-1.0, 1.0, 2 * n)
    speed = [np.abs(start.v[angle == kind]).max(initial=0.0) for kind in (False, True)]
    scale = draw * _tolerances(simulation, run)
    q, v = start.q + scale[:n], start.v + scale[n:] * np.where(angle, speed[1], speed[0])
    q, v = project(simulation.compiled, start.t, q, v, run.p)
    return replace(start, q=q, v=v)

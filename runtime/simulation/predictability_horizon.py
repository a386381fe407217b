"""Compute the predictability horizon of a run: the time up to which it agrees with perturbed repetitions.

`simulate(..., horizon=True)` repeats the run unchanged, with a tolerance a hundred times tighter (or a step four times
smaller), and from a start that is moved by 1e-12. Impacts amplify such differences. Beyond the horizon, the trajectory
is one of many that the same parameters allow, and only its statistics are meaningful. The horizon is the last compared
time before a perturbed repetition differs from the unchanged one by a quarter of the radial clearance, in the path of
a journal. Without play, the limit is a quarter of the mechanism's size, and of 1 rad for angles.

The output of the run does not enter. Repetitions are compared at 4,000 times between 4^k s and 4^(k + 1) s after the
start, for increasing k, until they differ. The resolution is thus 8e-4 of the horizon or better. Only the end of the
first interval, which begins at the start, depends on t_end (MIN_INTERVAL). If the repetitions differ in the interval
that t_end cuts off, that whole interval is compared again.

The horizon belongs to the run, not to the scene: each digit of tolerance extends it, until rounding dominates. With
the Lyapunov exponent λ, its mean over all runs is ln(max_difference/error)/λ: Lyapunov.mean_horizon.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from gudgeon.assembly.linkage import compute_mechanism_size, project_state
from gudgeon.errors import BadValueError, SolverError
from gudgeon.integrators.adaptive import MIN_RTOL, compute_error_lengths
from gudgeon.language.argument_checks import check_instance
from gudgeon.model.compiled import Array

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.results import Result, State
    from gudgeon.results.wear import SlidingRequest
    from gudgeon.simulation.simulation import Simulation

MAX_PATH_DIFFERENCE = 0.25  # of the clearance: difference at which runs count as parted
# relative change of the start: about the error of one step at this tolerance (integrators/adaptive.py)
PERTURBATION = 1e-12
RTOL_RATIO, STEP_RATIO = 100.0, 4.0  # factors of tolerance and of step between the run and the more accurate one
UNFINISHED = "interrupted during the search of its horizon: the run is complete, its predictability horizon is unknown"
N_COMPARED_TIMES = 4000  # compared times between 4^k s and 4^(k + 1) s: the horizon's resolution
MIN_INTERVAL = 1.0 / 256.0  # of the run's length, about: the end of the first compared interval


def add_horizon(simulation: Simulation, run: Result, progress: Progress | None = None) -> Result:
    """Return the run with diagnostics.horizon; after Ctrl-C, with a horizon of NaN, a note, and marked as interrupted.

    `progress` None: nothing is reported.
    """
    try:
        horizon, interrupted = compute_horizon(simulation, run, progress), False
    except KeyboardInterrupt:
        horizon, interrupted = math.nan, True
    diagnostics = replace(run.diagnostics, horizon=horizon)
    if interrupted:
        diagnostics = replace(diagnostics, interrupted=True, notes=(*diagnostics.notes, UNFINISHED))
    return replace(run, diagnostics=diagnostics)


def compute_horizon(
    simulation: Simulation, run: Result, progress: Progress | None = None, max_difference: float = MAX_PATH_DIFFERENCE
) -> float:
    """Return the time (s) up to which three repetitions of a run agree; infinity if they do so to its end.

    The repetitions are compared with each other, not with the samples of `run`:

    - the same settings and start;
    - a tighter tolerance, or a shorter step (RTOL_RATIO, STEP_RATIO);
    - a start perturbed by PERTURBATION.

    The repetitions use `run.diagnostics.method`, from the run's start to its last sample. The compared times are those
    of `_yield_compared_times`. A repetition that an error ends is compared as far as it came. Kinematic scenes have
    infinity. `max_difference`: largest difference, as in the
    head of this file. Ctrl-C is passed on. `progress` None: nothing is reported.
    """
    begin, t1 = build_start_state(run), float(run.t[-1])
    t0 = begin.t
    if simulation.source.degrees_of_freedom == 0 or not t1 > t0:
        return math.inf
    settings, tighter = build_repeat_settings(run)
    variants = ((begin, settings), (begin, tighter), (_perturb_start(simulation, run, begin), settings))
    agreed_until = t0
    for times in _yield_compared_times(t0, t1):
        is_cut = times[-1] > t1
        compared_times = np.append(times[times < t1], t1) if is_cut else times
        agreement = _find_last_agreement(simulation, compared_times, variants, progress, max_difference)
        if is_cut and agreement is not None:
            longer = _find_last_agreement(simulation, times, variants, progress, max_difference)
            agreement = longer if longer is not None and agreed_until < longer <= t1 else agreement
        if agreement is not None:
            return max(agreed_until, agreement)
        agreed_until = float(times[-1])
    return math.inf


def _yield_compared_times(t0: float, t1: float) -> Iterator[Array]:
    """Yield arrays of N_COMPARED_TIMES equidistant times (s), each ending four times as far from t0 as the previous.

    An array covers the interval from the end of the one before, or t0, which it excludes, to its own end. The first
    ends at t0 + 4^k s, with the largest k for which 4^k ≤ MIN_INTERVAL (t1 − t0). The last reaches t1 or beyond.
    """
    top = 4.0 ** math.floor(math.log(MIN_INTERVAL * (t1 - t0), 4.0))
    low, last = 0.0, False
    while not last:
        last = not t0 + top < t1
        yield t0 + np.linspace(low, top, N_COMPARED_TIMES + 1)[1:]
        low, top = top, 4.0 * top


def _find_last_agreement(
    simulation: Simulation,
    times: Array,
    variants: Iterable[tuple[State, dict[str, Any]]],
    progress: Progress | None,
    max_difference: float,
) -> float | None:
    """Run the variants (start, settings) through `times` and return the last time (s) at which they agree.

    They agree within `max_difference`. Return None if they do so to the end, −infinity if a variant fails at its start.
    Raises KeyboardInterrupt after Ctrl-C.
    """
    runs = []
    for start, settings in variants:
        run = repeat_run(simulation, times, start, settings, progress)
        if run is None:
            return -math.inf
        if run.diagnostics.interrupted:
            raise KeyboardInterrupt
        runs.append(run)
    agreed, is_different = _compare_runs(simulation, runs, max_difference)
    return agreed if is_different else None


def repeat_run(
    simulation: Simulation,
    times: Array,
    start: State | None,
    settings: dict[str, Any],
    progress: Progress | None,
    peaks: tuple[str | SlidingRequest, ...] = (),
    stop: bool = False,
) -> Result | None:
    """Return a run of `simulation` through `times` (s), or its part before an error; None if it fails at its start.

    `start`: state to resume from, or None for the file's. `stop`: whether events may end it.
    """
    try:
        return simulation.simulate(output=times, start=start, progress=progress, stop=stop, peaks=peaks, **settings)
    except SolverError as error:
        return cast("Result | None", error.partial)


def _compare_runs(simulation: Simulation, runs: list[Result], max_difference: float) -> tuple[float, bool]:
    """Return the last time (s) at which the second and third run agree with the first, and whether they differ later.

    Runs agree within `max_difference`, and are compared at the samples that all have. A run that ends early differs. If
    the first samples differ, the time is that of the start.
    """
    count = min(len(run.t) for run in runs)
    paths = [_compute_compared_coordinates(simulation, run)[:count] for run in runs]
    gaps = [np.abs(path - paths[0]).max(axis=1) for path in paths[1:]]
    differing_samples = np.flatnonzero(~(np.maximum(*gaps) <= max_difference))
    last = int(differing_samples[0]) - 1 if len(differing_samples) else count - 1
    agreed = float(runs[0].t[last]) if last >= 0 else build_start_state(runs[0]).t
    return agreed, bool(len(differing_samples)) or any(len(run.t) > count for run in runs)


def _compute_compared_coordinates(simulation: Simulation, run: Result) -> Array:
    """Return the dimensionless coordinates (N, …) of a run that are compared.

    They are e/c of all journals. In a scene without play they are lengths over the mechanism's size, and angles.
    """
    if run.source.clearances:
        scaled = [
            run[f"{joint.name}.{axis}"] / run.p[joint.clearance]
            for joint in run.source.clearances
            for axis in ("ex", "ey")
        ]
        return np.stack(scaled, axis=1)
    return np.asarray(run.q / np.where(_get_angle_mask(run), 1.0, compute_mechanism_size(simulation.compiled, run.p)))


def _get_angle_mask(run: Result) -> Any:
    """Return a mask (n,) of the coordinates that are angles."""
    return np.array([name.endswith(".theta") for name in run.source.coordinates])


def check_simulation_of_run(simulation: Simulation, run: Result, function_name: str) -> None:
    """Raise BadValueError unless `run` is a Result of the file and scene of `simulation`.

    `function_name`: name of the caller's function, for the message.
    """
    from gudgeon.results.results import Result
    from gudgeon.simulation.simulation import Simulation

    check_instance(simulation, "simulation", Simulation)
    check_instance(run, "run", Result)
    if run.source.whole_sha256 != simulation.source.whole_sha256 or run.source.scene != simulation.source.scene:
        raise BadValueError(f"{function_name}: the run is of another file or scene: expected the simulation of the run")


def build_repeat_settings(run: Result) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return two sets of arguments of simulate: one that repeats a run, and one of a more accurate run.

    The second has a shorter step or a tighter tolerance. At the tightest tolerance that is allowed, it is looser
    instead.
    """
    from gudgeon.simulation.arguments import METHODS

    d = run.diagnostics
    method = d.method if d.method in METHODS else "adaptive"  # the methods of a run by "auto" are joined by "+"
    settings = {"method": method, "parameters": dict(run.final.parameters)}
    if math.isfinite(d.step):
        return settings | {"step": d.step}, settings | {"step": d.step / STEP_RATIO}
    # at the tightest allowed tolerance, the other run has the looser one
    rtol = d.rtol / RTOL_RATIO if d.rtol >= RTOL_RATIO * MIN_RTOL else d.rtol * RTOL_RATIO
    return settings | {"rtol": d.rtol}, settings | {"rtol": rtol}


def _compute_perturbation_sizes(simulation: Simulation, run: Result) -> Array:
    """Return the size (2n,) of the perturbation of each coordinate, and of each velocity per unit of speed.

    It is the error tolerance at the relative tolerance PERTURBATION.
    """
    length, size = compute_error_lengths(simulation.compiled, run.p)
    of_q = PERTURBATION * np.where(_get_angle_mask(run), length / size, length)
    return np.concatenate([of_q, np.full(len(of_q), PERTURBATION)])


def build_start_state(run: Result) -> State:
    """Return the start of a run as a state to resume from: the state that it resumed, else its first sample."""
    if run.given_start is not None:
        return replace(run.given_start, parameters=run.final.parameters)
    run = run.start_row or run
    return replace(run.final, t=float(run.t[0]), q=run.q[0], v=run.v[0], state=run.state[0], memory=run.memory[0])


def _perturb_start(simulation: Simulation, run: Result, start: State) -> State:
    """Return a copy of the start moved by the relative distance PERTURBATION in a fixed pseudo-random direction.

    It is projected onto the constraints.
    """
    angle, n = _get_angle_mask(run), len(start.q)
    random = np.random.default_rng(1).uniform(-1.0, 1.0, 2 * n)
    speed = [np.abs(start.v[angle == kind]).max(initial=0.0) for kind in (False, True)]
    displacement = random * _compute_perturbation_sizes(simulation, run)
    q, v = start.q + displacement[:n], start.v + displacement[n:] * np.where(angle, speed[1], speed[0])
    q, v = project_state(simulation.compiled, start.t, q, v, run.p)
    return replace(start, q=q, v=v)

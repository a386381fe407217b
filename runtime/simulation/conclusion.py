"""Build the Result of a finished run from samples and counts, with diagnostics and notes; quickly after Ctrl-C."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from time import monotonic
from typing import Any

import numpy as np

from gudgeon.assembly.journals import eccentricity
from gudgeon.assembly.linkage import mechanism_size
from gudgeon.assembly.rank import contradiction, dependent_rows
from gudgeon.contract.boundary import AT_REST, MODE_HELD, PEAK_F, PEAK_e_max, PEAK_t
from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import ADAPTIVE, EXPLICIT
from gudgeon.errors import SolverError
from gudgeon.integrators.adaptive import stiff_method
from gudgeon.integrators.failure import audit_failure, notes_of
from gudgeon.integrators.times import last_step
from gudgeon.integrators.trajectory import Counts, Problem, Trajectory
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import corner_gap, widest
from gudgeon.model.evaluation import Evaluation
from gudgeon.model.left_limit import evaluation_times
from gudgeon.model.seams import curve_seam_notes
from gudgeon.model.written import unbounded_drive, with_notes_on_undefined
from gudgeon.results.diagnostics import Diagnostics, Peak, provenance_of
from gudgeon.results.peaks import find_zeno_points, first_contact_force
from gudgeon.results.results import Result
from gudgeon.results.samples import without_start
from gudgeon.results.series import without_masses
from gudgeon.simulation.audit import audit_samples, failed
from gudgeon.waiting.asking import EVERY
from gudgeon.waiting.ctrl_c import CtrlC

INTERRUPTED_NOTE = "interrupted: samples after the last one, and what is computed from all of them, are missing"
COARSE = 1e-4  # of the energy throughput: a larger residual of rk4 is reported
BLOCK = 1 << 16  # samples of the energy balance between two polls for cancellation
APART = 0.01  # of the mechanism's size: constraint violations that are too large for drift
MANY = 10_000  # steps of an explicit method that indicate a stiff film
THIN = 0.9999  # e/c at which a film's law is capped (generator/equations/contact_steps.py)
DEEP_CLEARANCE, DEEP_RADIUS = 0.5, 0.01  # penetrations beyond these fractions of c and of R are outside the model
KEPT = 20_000  # samples up to which the evaluation made for the energy balance is cached
AFTER_CTRL_C = 0.1  # s: time limit for the energy balance of an interrupted run; without it the residual is NaN


def diagnose(problem: Problem, trajectory: Trajectory, balance: tuple[float, float]) -> Diagnostics:
    """Return the diagnostics of a run, from its trajectory and its energy `balance` (residual, throughput; J)."""
    compiled, method, x, counts = problem.compiled, problem.method, trajectory, trajectory.counts
    worst, turned = balance
    duration, used, last = float(problem.t[-1] - problem.t[0]), problem.step, math.nan
    if math.isfinite(used) and duration > 0.0:
        last = last_step(duration, used)
        used = max(last, min(used, duration))
    simulated = float(x.t[-1] - x.t[0]) if len(x.t) else 0.0
    if method == ADAPTIVE:
        both = EXPLICIT, stiff_method(compiled.source, problem.rtol)
        method = "+".join(both) if 0 < counts.stiff_steps < counts.steps else both[counts.stiff_steps > 0]
    return Diagnostics(
        method=method,
        step=used if math.isfinite(problem.step) else math.nan,
        steps=counts.steps,
        last_step=last if last != used else math.nan,
        t_end=float(problem.t[-1]) if len(x.t) and x.t[-1] < problem.t[-1] else math.nan,
        rtol=problem.rtol if math.isinf(problem.step) and method != "kinematic" else math.nan,
        rejected=counts.rejected,
        stiff_steps=counts.stiff_steps,
        jacobians=counts.jacobians,
        right_hand_sides=counts.right_hand_sides,
        onsets=counts.onsets,
        phi_max=counts.phi_max,
        phi_dot_max=counts.phi_dot_max,
        energy_residual=worst,
        energy_turned_over=turned,
        ratio_min=counts.ratio_min,
        ratio_max=counts.ratio_max,
        ratio_outside=counts.ratio_outside,
        peaks=_peaks(compiled, x),
        seconds=x.seconds,
        seconds_per_simulated_second=x.seconds / simulated if simulated > 0 else math.nan,
        interrupted=x.interrupted,
        notes=_notes(compiled, problem, trajectory),
        audit=x.audit,
    )


def energy_balance(energy: Array, work: Array, look: Callable[[], object]) -> tuple[float, float]:
    """Return the largest residual of energies (N, 2) and works (N, 3), and the energy throughput; both in J.

    Both are NaN without samples. An impact at the very start has done its work before the first sample. `look` polls
    for cancellation between blocks; its exceptions are passed on.
    """
    if not len(energy):  # not even the start has accelerations
        return math.nan, math.nan
    worst = turned = 0.0
    for first in range(0, len(energy), BLOCK):
        rows = slice(first, first + BLOCK)
        with np.errstate(invalid="ignore", over="ignore"):  # infinities: reported by `unbalanced_note`
            residual = energy[rows].sum(axis=1) - energy[0].sum() - (work[rows].sum(axis=1) - work[0].sum())
        worst = float(np.maximum(worst, np.abs(residual).max()))  # NaN stays NaN
        turned += float(np.abs(np.diff(work[first : first + BLOCK + 1], axis=0)).sum())
        look()
    with np.errstate(invalid="ignore"):
        return worst, turned + float(np.ptp(energy[:, 0]))


def coarse(problem: Problem, worst: float, turned: float) -> tuple[str, ...]:
    """Return a note on a fixed step whose energy does not balance: other methods control the error."""
    if math.isinf(problem.step) or not worst > COARSE * turned:
        return ()
    return (
        f"energy balances to {worst:.3g} J of {turned:.3g} J turned over: a step of {problem.step:.3g} s is too"
        " long for these forces; compare with a shorter one or with method auto",
    )


def unbalanced_note(t: Array, energy: Array, work: Array, worst: float) -> tuple[str, ...]:
    """Return a note that the energy balance is not a number, with the time of the first such sample; else ()."""
    if math.isfinite(worst) or not len(t):
        return ()
    with np.errstate(invalid="ignore"):
        known = np.isfinite(energy.sum(axis=1) + work.sum(axis=1))
    k = int(known.argmin()) if not known.all() else 0
    what = "the energy" if not np.isfinite(energy[k]).all() else "the work"
    return (f"energy is not balanced: {what} is no finite number at t = {t[k]:.9g} s: the residual says nothing",)


def _notes(compiled: CompiledModel, problem: Problem, trajectory: Trajectory) -> tuple[str, ...]:
    """Return the notes of a run: warnings that a reader should know before trusting it."""
    p, notes, counts = problem.p, list(problem.remarks), trajectory.counts
    if problem.state is None and (tied := dependent_rows(compiled, p, float(problem.t[0]), problem.q)):
        notes.append(
            f"the start is a dead centre: rows {', '.join(tied)} tie each other there; velocities that drives and"
            " start.rates leave open were taken least: give a rate of each body that may move"
        )
    if why := without_masses(compiled.source):
        notes.append(f"{why}: reactions, torques, energies and works are not known")
    if problem.stop and len(trajectory.events):
        last = compiled.source.events[trajectory.events["event"][-1]]
        if last.action == "stop":
            notes.append(f"event {last.name} ended the run at t = {trajectory.events['t'][-1]:.9g} s")
    if trajectory.interrupted:
        notes.append(INTERRUPTED_NOTE)
    for event, t in trajectory.no_number:
        name = compiled.source.events[event].name
        notes.append(f"event {name} is no number (NaN) at t = {t:.9g} s: where it is none it has no zeros")
    if compiled.source.events and ":" in problem.method:
        notes.append(f"events are not watched by method {problem.method}")
    passed, first = trajectory.change_points
    if passed and not without_masses(compiled.source):
        notes.append(
            f"{passed} samples lie at or near a change point (the first at t = {first:.9g} s): positions and rates"
            " pass on the smooth branch; forces and torques there are not determined by the rows"
        )
    notes += unbounded_sample_note(compiled, problem, trajectory)
    notes += curve_seam_notes(compiled.source, p, float(problem.t[0]), float(trajectory.t[-1]))
    notes += range_notes(compiled, p, float(problem.t[0]), problem.q, counts, trajectory.peaks)
    if compiled.source.rigid:
        notes += find_zeno_points([joint.name for joint in compiled.source.clearances], trajectory.impacts)
        notes += stiff_film_note(compiled.source, problem, counts)
    notes += notes_of(trajectory.audit)
    notes += indeterminate(compiled.source)
    return tuple(notes)


def indeterminate(source: KernelSource) -> Iterator[str]:
    """Yield a note on redundant constraints, if the scene has any."""
    if source.indeterminate:
        owners = ", ".join(source.indeterminate)
        yield f"constraints are redundant: the reactions of {owners} are not determined by rigid bodies (NaN)"


def stiff_film_note(source: KernelSource, problem: Problem, counts: Counts) -> Iterator[str]:
    """Yield a note on many steps of a stiff film in a scene with rigid contacts: no implicit method fits."""
    films = [joint.name for joint in source.clearances if joint.film]
    if films and counts.steps > MANY and math.isinf(problem.step):
        yield (
            f"{counts.steps} steps: the film in {', '.join(films)} is stiff, and no implicit method fits a scene whose"
            f" contact in {source.rigid[0]} is a constraint (newton_restitution): a contact law that gives there"
            " (hertz with a stiffness) lets method auto take long steps"
        )


def unbounded_sample_note(compiled: CompiledModel, problem: Problem, trajectory: Trajectory) -> Iterator[str]:
    """Yield a note on the sample of a kinematic run at which the second rate of a drive is unbounded."""
    if compiled.source.methods != ("kinematic",) or not len(trajectory.t) or trajectory.a is None:
        return
    largest = np.abs(np.nan_to_num(trajectory.a, nan=math.inf)).max(axis=1)
    t = float(trajectory.t[largest.argmax()])
    if largest.max() > 100.0 * np.median(largest) and (drive := unbounded_drive(compiled, problem.p, t)):
        yield (
            f"the second rate of drive {drive} is unbounded at t = {t:.9g} s: accelerations, forces and torques of that"
            " sample mean nothing: write the drive with powers of 2 and more, or take samples at other times"
        )


def may_leave_range(source: KernelSource, p: Array, size: Array, phi_max: Array, peaks: Array) -> Any:
    """Return a mask (n,) of the runs for which `range_notes` may yield a note. Shapes: parameter values p (n, ...),
    peaks (n, n_clearances, 3).
    """
    c, e_max = p[:, [joint.clearance for joint in source.clearances]], peaks[:, :, PEAK_e_max]
    least = np.array([THIN if joint.film and not joint.dry else 1.0 for joint in source.clearances])
    return (phi_max > APART * size) | (e_max > least * c).any(axis=1)


def range_notes(compiled: CompiledModel, p: Array, t0: float, q0: Array, counts: Counts, peaks: Array) -> Iterator[str]:
    """Yield notes on a run that left its model: a linkage that came apart, or joints outside their contact laws. `q0`
    is the start, `peaks` (n_clearances, 3).
    """
    if counts.phi_max > APART * mechanism_size(compiled, p):
        yield (
            f"the linkage came apart: constraints are violated by up to {counts.phi_max:.3g}: nothing after that means"
            " anything; a step too long does this, or a drive that pushes the links through a dead centre"
        )
    yield from _note_range_of_laws(compiled, p, t0, q0, peaks)


def _note_range_of_laws(compiled: CompiledModel, p: Array, t0: float, q0: Array, peaks: Array) -> Iterator[str]:
    """Yield a note for each joint with play whose eccentricity left the range of its contact or film law."""
    for k, (joint, e_max) in enumerate(zip(compiled.source.clearances, peaks[:, PEAK_e_max], strict=True)):
        c, radius = float(p[joint.clearance]), float(p[joint.constants["R_i"]])
        deepest = float(e_max) - widest(compiled.source, p, joint)
        ratio = float(e_max) / float(p[joint.film_clearance])
        if joint.film and not joint.dry and ratio > THIN:
            yield (
                f"{joint.name}: the film is squeezed out, e/c = {ratio:.7g}: its law, singular at e = c, is"
                " capped there: a dry contact beyond it, or a thicker oil, keeps the surfaces apart"
            )
        elif joint.film and not joint.dry and deepest > (1.0 - THIN) * c:
            yield (
                f"{joint.name}: the journal is up to {1e3 * deepest:.3g} mm within its bearing (c = {1e3 * c:.3g} mm),"
                " where a film with extra_clearance still carries it: a dry contact takes its force there"
            )
        if deepest > (most := min(DEEP_CLEARANCE * c, DEEP_RADIUS * radius)):
            begun = _penetration_at(compiled, p, t0, q0, k, joint) > most
            into = "corner goes {} mm into its wall (gap" if joint.at_wall else "journal goes {} mm into its bearing (c"
            yield (
                f"{joint.name}: the {into.format(f'{1e3 * deepest:.3g}')} {1e3 * c:.3g} mm,"
                f" {'half the width' if joint.at_wall else 'radius'} {1e3 * radius:.3g} mm): outside what contact laws"
                " hold for; " + ("it lies so deep from the start on" if begun else "a step too long does this too")
            )


def _penetration_at(compiled: CompiledModel, p: Array, t: float, q: Array, k: int, joint: ClearanceInfo) -> float:
    """Return the penetration (m) of joint k at the positions q: journal in bearing, or corner in wall."""
    if joint.at_wall:
        return corner_gap(compiled, p, t, q, np.zeros_like(q), k)[0]
    return float(np.hypot(*eccentricity(compiled, p, t, q, joint)[1])) - float(p[joint.clearance])


def _peaks(compiled: CompiledModel, trajectory: Trajectory) -> tuple[Peak, ...]:
    """Return the peak force and eccentricity of each joint with play, with its first contact."""
    peaks = []
    for i, joint in enumerate(compiled.source.clearances):
        own = trajectory.impacts[trajectory.impacts["joint"] == i]
        first = (float(own["t_on"][0]), first_contact_force(own)) if len(own) else (math.nan, math.nan)
        F, t, e_max = (float(trajectory.peaks[i, k]) for k in (PEAK_F, PEAK_t, PEAK_e_max))
        peaks.append(Peak(joint.name, F, t, e_max, *first))
    return tuple(peaks)


class _TimeLimitReached(Exception):
    """Signal that the rest of an interrupted evaluation is left for later."""


def build_result(problem: Problem, trajectory: Trajectory, given: Array, is_given: Array, soon: bool = True) -> Result:
    """Return the Result of a run with its diagnostics, after evaluating all samples for the energy balance.

    The evaluation is postponed if Ctrl-C comes meanwhile, or if it ended the run and, with `soon`, takes too long.
    """
    compiled = problem.compiled
    x, evaluation, failed, balance = without_works(compiled, trajectory), None, False, (math.nan, math.nan)
    look = _make_poll(problem, x.interrupted, soon)
    try:
        times = evaluation_times(compiled, x.t, x.q, x.v, problem.p)
        evaluation = compiled.evaluate(times, x.q, x.v, x.memory, problem.p, look)
        balance = energy_balance(evaluation.energy, x.work, look)
    except SolverError:
        failed = True
    except (
        _TimeLimitReached,
        MemoryError,
    ):  # the samples are there; what follows from them is evaluated on request
        pass
    except KeyboardInterrupt:
        x = replace(x, interrupted=True)
    a = x.a if evaluation is None else _accelerations(x, evaluation, times)
    if a is None and failed:
        a = np.full_like(x.q, np.nan)
    if evaluation is not None:
        x = replace(x, audit=(*x.audit, *audit_samples(compiled, problem, x, evaluation, balance)))
    result = Result(
        compiled=compiled,
        source=compiled.source,
        p=problem.p,
        given=given,
        is_given=is_given,
        t=x.t,
        q=x.q,
        v=x.v,
        accelerations=a,
        state=x.state,
        memory=x.memory,
        work=x.work,
        impacts=x.impacts,
        diagnostics=diagnose(problem, x, balance),
        events=x.events,
        event_states=x.event_states,
        trace=x.trace,
        provenance=provenance_of(compiled),
        begun=problem.begun,
    )
    if evaluation is not None:
        message = unbalanced_note(x.t, evaluation.energy, x.work, balance[0]) + coarse(problem, *balance)
        result = result if compiled.source.massless else _with_notes(result, message)
        result.__dict__["evaluation"] = evaluation  # a cached property: not computed again
    result = result if problem.start_is_sample else without_start(result)
    if evaluation is not None:
        evaluation = result.evaluation
        result = with_undetermined(with_notes_on_undefined(result, evaluation), evaluation)
        result.__dict__.pop("evaluation", None)
        if len(x.t) <= KEPT:
            result.__dict__["evaluation"] = evaluation
    return result


def with_undetermined(run: Result, evaluation: Evaluation) -> Result:
    """Return the run with notes on frictions that drives or other frictions hold at rest over samples."""
    first, found = len(run.source.clearances), list[str]()
    for k, name in enumerate(run.source.frictions):
        mode, slip = run.memory[:, first + k], evaluation.friction[:, k, 1]
        rests = (mode != 0.0) & ((mode == MODE_HELD) | (np.abs(slip) <= AT_REST))
        lasts = rests[1:] & rests[:-1]
        static = run.source.place.get(f"forces.{name}.static")  # None: the file has 0 N, which no parameter changes
        if lasts.any() and static is not None and run.p[static] > 0.0:
            t, count = float(run.t[lasts.argmax()]), f"{int(rests.sum())} of {len(rests)} samples"
            found.append(
                f"friction {name} is at rest by drives or by other friction from t = {t:.9g} s on, in {count}: any"
                " force within its static limit fits there, so its force, what drives give and reactions are not"
                " determined; the run has the last force of sliding, or 0"
            )
    return _with_notes(run, found)


def _with_notes(run: Result, message: Sequence[str]) -> Result:
    """Return the run with more notes; the same object if there are none."""
    notes = (*run.diagnostics.notes, *message)
    return replace(run, diagnostics=replace(run.diagnostics, notes=notes)) if message else run


def _accelerations(x: Trajectory, evaluation: Evaluation, times: Array) -> Array:
    """Return q̈ (N, n) from the method, else from the evaluation; at the last instant the left limit."""
    if x.a is None:
        return evaluation.a
    return np.append(x.a[:-1], evaluation.a[-1:], axis=0) if times[-1] < x.t[-1] else x.a


def without_works(compiled: CompiledModel, trajectory: Trajectory) -> Trajectory:
    """Return the trajectory, with works of NaN if the scene has no masses."""
    if not compiled.source.massless:
        return trajectory
    return replace(trajectory, work=np.full_like(trajectory.work, np.nan))


def _make_poll(problem: Problem, interrupted: bool, soon: bool) -> Callable[[], None]:
    """Return the function that the evaluation calls every few milliseconds: it polls Ctrl-C and reports progress."""
    begun = message = monotonic()

    def look() -> None:
        """Poll for Ctrl-C and report progress. Raise _TimeLimitReached if an interrupted run takes too long."""
        nonlocal message
        problem.take()
        now = monotonic()
        if problem.progress and not interrupted and now - message > EVERY:
            message = now
            problem.progress(1.0, "balancing energy")
        if interrupted and soon and now - begun > AFTER_CTRL_C:
            raise _TimeLimitReached

    return look


def check_result(problem: Problem, trajectory: Trajectory, result: Result) -> tuple[Result, SolverError | None]:
    """Return the run, and the error that ends it after its samples, or None.

    Such errors are the failure of the time loop, contradictory constraints, or a failed audit of the samples. If
    Ctrl-C comes meanwhile, the run is marked as interrupted.
    """
    found = result.diagnostics.audit
    try:
        failure = contradiction(problem, trajectory) or (audit_failure(found) if failed(found) else None)
    except KeyboardInterrupt:
        result, failure = _mark_interrupted(result), contradiction(problem, replace(trajectory, interrupted=True))
    return result, trajectory.stopped or failure


def late(ctrl_c: CtrlC, result: Result) -> Result:
    """Return the result, marked as interrupted if Ctrl-C came while it was being built."""
    try:
        ctrl_c.take()
    except KeyboardInterrupt:
        return _mark_interrupted(result)
    return result


def _mark_interrupted(result: Result) -> Result:
    """Return the result marked as interrupted, with a note."""
    message = _with_notes(result, () if result.diagnostics.interrupted else (INTERRUPTED_NOTE,))
    return replace(message, diagnostics=replace(message.diagnostics, interrupted=True))

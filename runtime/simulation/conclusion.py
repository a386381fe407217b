"""The end of a run: its samples and counts, put together as a Result, and soon where Ctrl-C ended it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from time import monotonic

import numpy as np

from gudgeon.assembly.rank import contradiction
from gudgeon.errors import SolverError
from gudgeon.integrators.failure import audit_failure
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import Evaluation
from gudgeon.model.left_limit import evaluation_times
from gudgeon.model.written import with_undefined
from gudgeon.results.diagnostics import provenance_of
from gudgeon.results.results import Result
from gudgeon.results.samples import without_start
from gudgeon.simulation.audit import audit_samples, failed
from gudgeon.simulation.diagnose import diagnose, energy_balance, unbalanced
from gudgeon.waiting.asking import EVERY
from gudgeon.waiting.ctrl_c import CtrlC

KEPT = 20_000  # samples whose reactions are kept at hand: they were computed for the energy balance
AT_REST = 1e-9  # m/s, of a slip (engine/run/friction.c)
HELD = 2.0  # the mode of a friction that others hold at rest, the same
AFTER_CTRL_C = 0.1  # s that the energy balance of an interrupted run may take; without it its residual is NaN


class _TooLong(Exception):
    """What is left can wait until somebody asks for it."""


def conclude(
    problem: Problem, trajectory: Trajectory, given: Array, is_given: Array, soon: bool = True
) -> Result:  # fmt: skip
    """A run with its diagnostics, from its samples. Everything that follows from them is evaluated for its balance.

    Where Ctrl-C comes meanwhile, or ended the run and (with `soon`) the samples are many, that is left for later.
    """
    compiled = problem.compiled
    x, evaluation, failed, balance = without_works(compiled, trajectory), None, False, (math.nan, math.nan)
    look = _look(problem, x.interrupted, soon)
    try:
        times = evaluation_times(compiled, x.t, x.q, x.v, problem.p)
        evaluation = compiled.evaluate(times, x.q, x.v, x.memory, problem.p, look)
        balance = energy_balance(evaluation.energy, x.work, look)
    except SolverError:
        failed = True
    except (_TooLong, MemoryError):  # the samples are there; what follows from them is evaluated when asked for
        pass
    except KeyboardInterrupt:
        x = replace(x, interrupted=True)
    a = x.a if evaluation is None else _accelerations(x, evaluation, times)
    if a is None and failed:
        a = np.full_like(x.q, np.nan)
    if evaluation is not None:
        x = replace(x, audit=(*x.audit, *audit_samples(compiled, problem, x, evaluation, balance)))
    result = Result(
        compiled=compiled, source=compiled.source, p=problem.p, given=given, is_given=is_given, t=x.t, q=x.q, v=x.v,
        accelerations=a, state=x.state, memory=x.memory, work=x.work, impacts=x.impacts,
        diagnostics=diagnose(problem, x, balance), events=x.events,
        event_states=x.event_states, trace=x.trace, provenance=provenance_of(compiled), begun=problem.begun,
    )  # fmt: skip
    if evaluation is not None:
        if not compiled.source.massless and (told := unbalanced(x.t, evaluation.energy, x.work, balance[0])):
            notes = (*result.diagnostics.notes, *told)
            result = replace(result, diagnostics=replace(result.diagnostics, notes=notes))
        result.__dict__["evaluation"] = evaluation  # a cached property: nobody computes it again
    result = result if problem.start_is_sample else without_start(result)
    if evaluation is not None:
        evaluation = result.evaluation
        result = with_undetermined(with_undefined(result, evaluation), evaluation)
        result.__dict__.pop("evaluation", None)
        if len(x.t) <= KEPT:
            result.__dict__["evaluation"] = evaluation
    return result


def with_undetermined(run: Result, evaluation: Evaluation) -> Result:
    """Return the run, its notes with frictions that drives or other frictions hold at rest from sample to sample."""
    first, found = len(run.source.clearances), list[str]()
    for k, name in enumerate(run.source.frictions):
        mode, slip = run.memory[:, first + k], evaluation.friction[:, k, 1]
        rests = (mode != 0.0) & ((mode == HELD) | (np.abs(slip) <= AT_REST))
        lasts = rests[1:] & rests[:-1]
        if lasts.any():
            t, count = float(run.t[lasts.argmax()]), f"{int(rests.sum())} of {len(rests)} samples"
            found.append(
                f"friction {name} is at rest by drives or by other friction from t = {t:.9g} s on, in {count}: any"
                " force within its static limit fits there, so its force, what drives give and reactions are not"
                " determined; the run has the last force of sliding, or 0"
            )
    notes = (*run.diagnostics.notes, *found)
    return replace(run, diagnostics=replace(run.diagnostics, notes=notes)) if found else run


def _accelerations(x: Trajectory, evaluation: Evaluation, times: Array) -> Array:
    """Return q̈ (N, n) as the method found it, else as evaluated; of the last instant the left limit."""
    if x.a is None:
        return evaluation.a
    return np.append(x.a[:-1], evaluation.a[-1:], axis=0) if times[-1] < x.t[-1] else x.a


def without_works(compiled: CompiledModel, trajectory: Trajectory) -> Trajectory:
    """The same, whose works are NaN where there are no masses to tell them by."""
    if not compiled.source.massless:
        return trajectory
    return replace(trajectory, work=np.full_like(trajectory.work, np.nan))


def _look(problem: Problem, interrupted: bool, soon: bool) -> Callable[[], None]:
    """What the evaluation calls each few milliseconds."""
    begun = told = monotonic()

    def look() -> None:
        nonlocal told
        problem.take()
        now = monotonic()
        if problem.progress and not interrupted and now - told > EVERY:
            told = now
            problem.progress(1.0, "balancing energy")
        if interrupted and soon and now - begun > AFTER_CTRL_C:
            raise _TooLong

    return look


def contradicted(problem: Problem, trajectory: Trajectory, result: Result) -> tuple[Result, SolverError | None]:
    """Return the run, marked as interrupted where Ctrl-C comes meanwhile, and what ends it after all, if anything.

    That is what the time loop met, a contradiction of its constraints, or a check of its samples that failed.
    """
    found = result.diagnostics.audit
    try:
        failure = contradiction(problem, trajectory) or (audit_failure(found) if failed(found) else None)
    except KeyboardInterrupt:
        result, failure = _interrupted(result), contradiction(problem, replace(trajectory, interrupted=True))
    return result, trajectory.stopped or failure


def late(ctrl_c: CtrlC, result: Result) -> Result:
    """The result; marked as interrupted where Ctrl-C came while it was put together."""
    try:
        ctrl_c.take()
    except KeyboardInterrupt:
        return _interrupted(result)
    return result


def _interrupted(result: Result) -> Result:
    return replace(result, diagnostics=replace(result.diagnostics, interrupted=True))

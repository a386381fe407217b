"""What a status of the C time loops stands for (templates/c/run.c.jinja), in words."""

from __future__ import annotations

import numpy as np

from gudgeon.compiled import Array, CompiledModel
from gudgeon.errors import NonFiniteError, SingularError, SolverError

NOT_FINITE, CHATTERING, TOO_SMALL, LOST = -2, -4, -5, -6


def failure(
    compiled: CompiledModel, status: int, t: float, advice: str, last: Array, e_max: Array, p: Array
) -> SolverError:
    """The error for a status at time t (s): `last` state, largest eccentricities (n_clearances,), parameters."""
    if status == NOT_FINITE:
        return NonFiniteError(f"the motion is no longer finite at t = {t:.9g} s\n  {advice}", t)
    if status == CHATTERING:
        return SolverError(
            f"a friction or another corner of the forces changes its side without end near t = {t:.9g} s\n"
            "  a force that jumps where the motion comes to rest holds it there: use a dry_friction element", t
        )  # fmt: skip
    if status == TOO_SMALL:
        tightest = _tightest(compiled, e_max, p)
        return SolverError(f"no step is small enough at t = {t:.9g} s{tightest}\n  {advice}", t)
    if status == LOST:
        return SolverError(f"a contact was lost at t = {t:.9g} s: a free journal lies outside its bearing", t)
    try:
        compiled.check_pivot(status, t, compiled.source.motion_pivots)
    except SingularError as error:
        if np.isfinite(last).all() and np.abs(last).max() < 1e12:
            return error
        where = f"t = {t:.9g} s (constraint row {error.pivot})"
        return NonFiniteError(f"the motion diverged before {where}\n  {advice}", t, error.pivot)
    raise AssertionError(f"status {status} stands for no failure")


def _tightest(compiled: CompiledModel, e_max: Array, p: Array) -> str:
    """How far the journals are from their bearings: what usually leaves a method no step."""
    joints = compiled.source.clearances
    if not joints:
        return ""
    ratio = [float(e) / float(p[joint.clearance]) for joint, e in zip(joints, e_max, strict=True)]
    worst = int(np.argmax(ratio))
    return f" (joint {joints[worst].name} came to e/c = {ratio[worst]:.7g})"

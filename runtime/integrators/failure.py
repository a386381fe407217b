"""What a status of the C time loops stands for (templates/c/run.c.jinja), in words."""

from __future__ import annotations

import numpy as np

from gudgeon.compiled import Array, CompiledModel
from gudgeon.dead_centre import nearly_dependent_rows
from gudgeon.errors import NonFiniteError, SingularError, SolverError
from gudgeon.start import mechanism_size
from gudgeon.written import rate_reason, reason

NOT_FINITE, CHATTERING, TOO_SMALL, LOST, OUTSIDE = -2, -4, -5, -6, -8
NO_NUMBER = "end the run before that, or write it so that it is a number at every time"
NEARLY_CLOSED = 0.99  # e/c of a film, beyond which its law is what fails


def failure(
    compiled: CompiledModel, status: int, t: float, advice: str, last: Array, e_max: Array, p: Array
) -> SolverError:
    """The error for a status at time t (s): `last` state, largest eccentricities (n_clearances,), parameters."""
    if status in (NOT_FINITE, TOO_SMALL) or status > 0:
        q, v = np.ravel(last)[: compiled.n], np.ravel(last)[compiled.n : 2 * compiled.n]
        why = reason(compiled.source, p, t, q, v)
        if why or (why := rate_reason(compiled, p, np.array([t, t + 1e-13 * max(1.0, abs(t))]), np.zeros_like(q))[0]):
            return NonFiniteError(f"{why}\n  {NO_NUMBER}", t)
    if status == NOT_FINITE:
        return NonFiniteError(f"the motion is no longer finite at t = {t:.9g} s\n  {advice}", t)
    if status == CHATTERING:
        return SolverError(
            f"a friction or another corner of the forces changes its side without end near t = {t:.9g} s\n"
            "  a force that jumps where the motion comes to rest holds it there: use a dry_friction element", t
        )  # fmt: skip
    if status == TOO_SMALL:
        known = _closed_film(compiled, e_max, p, t) or _dead_centre(compiled, last, p, t)
        return known or SolverError(f"no step is small enough at t = {t:.9g} s\n  {advice}", t)
    if status == LOST:
        return SolverError(f"a contact was lost at t = {t:.9g} s: a free journal lies outside its bearing", t)
    if status == OUTSIDE:
        return _too_deep(compiled, e_max, p, t)
    row = compiled.source.motion_pivots[status - 1]
    if row in compiled.source.chain_rows:
        return SingularError(
            f"the linkage reaches a dead centre at t = {t:.9g} s: where its drives want it, nothing closes constraint"
            f" row {row}\n  the lengths do not let the drives move on from there; end the run before it, or change the"
            " drive", t, row
        )  # fmt: skip
    try:
        compiled.check_pivot(status, t, compiled.source.motion_pivots)
    except SingularError as error:
        finite = bool(np.isfinite(last).all())
        if finite and np.abs(last).max() < 1e12:
            return error
        # at a dead centre speeds grow until a pivot drowns in them, while everything stays where it is
        dead = _dead_centre(compiled, last, p, t) if finite and _is_in_place(compiled, last, p) else None
        if dead:
            return dead
        where = f"t = {t:.9g} s (constraint row {error.pivot})"
        return NonFiniteError(f"the motion diverged before {where}\n  {advice}", t, error.pivot)
    raise AssertionError(f"status {status} stands for no failure")


def _too_deep(compiled: CompiledModel, e_max: Array, p: Array, t: float) -> SolverError:
    """A journal a tenth of its bearing's radius or more inside the metal."""
    deepest, name = max(
        (float(e - p[joint.clearance]), joint.name) for joint, e in zip(compiled.source.clearances, e_max, strict=True)
    )
    error = SolverError(
        f"the journal of {name} lies {deepest:.3g} m deep in its bearing, beyond a tenth of its radius, at"
        f" t = {t:.9g} s\n"
        "  laws of contact and film hold for far less: a stiffer material, a thicker oil or less speed, and in rk4 a"
        " shorter step", t
    )  # fmt: skip
    error.outside_model = True
    return error


def _is_in_place(compiled: CompiledModel, last: Array, p: Array) -> bool:
    """Whether no body has flown off."""
    places = [k for k, name in enumerate(compiled.source.coordinates) if not name.endswith(".theta")]
    return bool(np.abs(np.ravel(last)[places]).max(initial=0.0) < 1e4 * max(mechanism_size(compiled, p), 1e-3))


def _dead_centre(compiled: CompiledModel, last: Array, p: Array, t: float) -> SolverError | None:
    """A drive that pushes links through the line in which they lie: their speeds grow beyond all bounds."""
    rows = nearly_dependent_rows(compiled, p, t, np.ravel(last)[: compiled.n])
    if not rows:
        return None
    advice = (
        "the lengths do not let the drives move on from there; end the run before it, or change the drive"
        if compiled.source.drives
        else "links stand in one line there, and which way they go on is undetermined; another rtol may step over it"
    )
    return SolverError(
        f"the linkage reaches a dead centre at t = {t:.9g} s: constraint rows {', '.join(rows)} depend on each other\n"
        f"  {advice}", t
    )  # fmt: skip


def _closed_film(compiled: CompiledModel, e_max: Array, p: Array, t: float) -> SolverError | None:
    """What usually leaves a method no step: a film that is squeezed out, where its law is singular."""
    for joint, e in zip(compiled.source.clearances, e_max, strict=True):
        ratio = float(e) / float(p[joint.clearance])
        if joint.film and ratio > NEARLY_CLOSED:
            error = SolverError(
                f"the film in joint {joint.name} is squeezed out at t = {t:.9g} s: e/c = {ratio:.7g}\n"
                "  its law is singular at e = c: a thicker oil, or a dry contact beyond it, keeps the surfaces apart",
                t,
            )  # fmt: skip
            error.outside_model = True
            return error
    return None

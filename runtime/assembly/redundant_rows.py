"""Rows that were left out as redundant (generator/redundancy.py) must go on saying nothing new.

They did so with the file's numbers; other lengths, or drives that part later, may make them count again.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.assembly.linkage import mechanism_size
from gudgeon.assembly.rank import rank
from gudgeon.errors import AssemblyError, SolverError
from gudgeon.model.compiled import Array, CompiledModel

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Problem, Trajectory

MOST = 2_000  # samples of an interrupted run at which that is looked at: Ctrl-C is to be answered
OPEN = 1e-3  # rad, or share of the mechanism's size: a row left out that opens further contradicts the others


def left_out(compiled: CompiledModel) -> list[int]:
    """Rows of the closed linkage that are neither kept nor those of a joint with play."""
    source = compiled.source
    kept, with_play = {row.name for row in source.rows}, {joint.joint for joint in source.clearances}
    return [k for k, row in enumerate(source.start_rows) if row.name not in kept and row.owner not in with_play]


def check_start(compiled: CompiledModel, p: Array, t: float, q: Array) -> None:
    """AssemblyError where a row that was left out would take a degree of freedom at the start."""
    extra = left_out(compiled)
    if not extra:
        return
    rows, kept = compiled.closed_phi_q(t, q, p), compiled.phi_q(t, q, p)
    if rank(kept) == len(kept) and rank(np.concatenate([kept, rows[extra]])) > len(kept):
        raise AssemblyError(
            f"{_named(compiled, extra)} said nothing new with the file's numbers and"
            " would hold the linkage with these\n"
            "  give the numbers in the file or as overrides of load(), so that the constraints are counted anew"
        )


def contradiction(problem: Problem, trajectory: Trajectory) -> SolverError | None:
    """The error for the first sample at which a row that was left out is open.

    Of a run that was interrupted, for the first of MOST samples, the last one among them. KeyboardInterrupt.
    """
    compiled, p = problem.compiled, problem.p
    extra = left_out(compiled)
    if not extra:
        return None
    size = mechanism_size(compiled, p)
    scale = np.array([size if compiled.source.start_rows[k].unit == "m" else 1.0 for k in extra])
    stride = math.ceil(len(trajectory.t) / MOST) if trajectory.interrupted else 1
    for k in range((len(trajectory.t) - 1) % stride, len(trajectory.t), stride):
        if k % 256 == 0:
            problem.take()
        t = float(trajectory.t[k])
        far = np.abs(compiled.closed_phi(t, trajectory.q[k], p)[extra]) > OPEN * scale
        if far.any():
            names = _named(compiled, [row for row, is_far in zip(extra, far, strict=True) if is_far])
            return SolverError(
                f"the constraints contradict each other by t = {t:.9g} s: {names} depended on the others and is open"
                " now\n  check the values of the drives and the lengths of links that run side by side",
                t,
            )
    return None


def _named(compiled: CompiledModel, rows: list[int]) -> str:
    found = [compiled.source.start_rows[k] for k in rows]
    owners = dict.fromkeys([*(row.owner for row in found), *compiled.source.indeterminate])
    return f"row {', '.join(row.name for row in found)} (with {', '.join(owners)})"

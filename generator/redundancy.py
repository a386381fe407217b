"""Rows of Φ that say nothing new: found by rank at the start and near it, named, and left out.

A row may depend on the others everywhere (a second hinge on the same axis) or only where links stand in
one line for a moment. So the rank is taken at the assembled start and at configurations near it on the
same branch; the largest counts. Contradictory rows do not assemble: the run tells them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import scaled_rows
from gudgeon.assembly.mobility import check_freedoms, find_mobility
from gudgeon.assembly.rank import RANK, SAMPLES, configurations, rank, tied
from gudgeon.assembly.start import search
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model, Redundancy
from gudgeon.generator.targets.numpy.linkage import NumPyLinkage
from gudgeon.language.tree import Number
from gudgeon.model.compiled import Array


def find_redundancy(model: Model, source: KernelSource) -> Redundancy:
    """Rows of the scene (joints with play open) that depend on the others at every configuration."""
    if not model.rows:
        return Redundancy()
    numeric = NumPyLinkage(model, source)
    names = {row.name for row in model.rows}
    kept = [r for r, row in enumerate(model.all_rows) if row.name in names]
    try:
        with np.errstate(all="ignore"):
            q = search(numeric, numeric.p).q
            start = scaled_rows(numeric, numeric.p, numeric.closed_phi_q(0.0, q, numeric.p)[kept])
            near = configurations(numeric, numeric.p, q, kept, SAMPLES if rank(start) < len(kept) else 0)
            matrices = [scaled_rows(numeric, numeric.p, numeric.closed_phi_q(0.0, x, numeric.p)[kept]) for x in near]
        ranks = [rank(matrix) for matrix in matrices]
    except (GudgeonError, ArithmeticError, ValueError):  # not assembled, or not finite: the run will say why
        return Redundancy()
    wanted = model.scene.mechanism.freedoms
    if wanted is not None and isinstance(wanted.value, Number):
        check_freedoms(wanted.value.value, wanted.where, find_mobility(numeric, numeric.p, q))
    best = int(np.argmax(ranks))
    if ranks[best] == len(kept):
        return Redundancy()
    return _name_rows([model.all_rows[r] for r in kept], matrices[best], ranks[best])


def refuse_singular_masses(model: Model, source: KernelSource) -> None:
    """Raise a BadValueError where bodies without moment of inertia can turn against nothing: M is singular there.

    That is looked for at the start and near it; a motion that the rows determine needs no inertia.
    """
    bodies = model.scene.mechanism.bodies
    light = {body.name: body.index + 2 for body in model.bodies if not model.slots.default(body.inertia)}
    if not light or model.degrees_of_freedom <= 0:
        return
    numeric = NumPyLinkage(model, source)
    names = {row.name for row in model.rows}
    kept = [r for r, row in enumerate(model.all_rows) if row.name in names]
    try:
        near = configurations(numeric, numeric.p, search(numeric, numeric.p).q, kept, SAMPLES)
        heavy = numeric.mass(numeric.p) > 0.0
        matrices = [scaled_rows(numeric, numeric.p, numeric.closed_phi_q(0.0, q, numeric.p)[kept]) for q in near]
        found = [_lightest_motion(matrix, heavy) for matrix in matrices]
    except (GudgeonError, ArithmeticError, ValueError):  # as above
        return
    if all(share <= RANK for share, _ in found):
        motion = found[-1][1]
        name = max(light, key=lambda body: abs(motion[light[body]]))
        inertia = bodies[name].inertia
        where = inertia.where if inertia is not None else bodies[name].where
        raise BadValueError(
            f"body {name} has no moment of inertia, and nothing else resists its turning: its motion is not determined",
            where,
            f"expected bodies.{name}.inertia > 0, or its centre of mass (com) away from the joint about which it"
            " turns, or a drive that turns it",
        )


def _lightest_motion(phi_q: Array, heavy: NDArray[np.bool_]) -> tuple[float, Array]:
    """Of the motions (n,) that the rows leave free that with the least share in coordinates which have mass."""
    _, values, right = np.linalg.svd(phi_q) if len(phi_q) else (None, np.zeros(0), np.eye(len(heavy)))
    free = right[int((values > RANK * values.max(initial=0.0)).sum()) :].T
    _, shares, motions = np.linalg.svd(free[heavy])
    return float(shares[-1]) if len(shares) == free.shape[1] else 0.0, free @ motions[-1]


def _name_rows(rows: Sequence[Row], matrix: Array, independent: int) -> Redundancy:
    """Drives are kept first, then rows in the order of the file; a dependent one is dropped."""
    order = sorted(range(len(rows)), key=lambda r: (rows[r].kind != "drive", r))
    basis = np.zeros((0, matrix.shape[1]))
    dropped = []
    for r in order:
        rest = matrix[r] - (basis @ matrix[r]) @ basis
        rest = rest - (basis @ rest) @ basis
        if len(basis) < independent and np.linalg.norm(rest) > 10 * RANK * np.linalg.norm(matrix[r]):
            basis = np.vstack([basis, rest / np.linalg.norm(rest)])
        else:
            dropped.append(r)
    free = tied(matrix) > 1e-7
    owners = dict.fromkeys(rows[r].owner for r in range(len(rows)) if free[r])
    return Redundancy(tuple(rows[r].name for r in sorted(dropped)), tuple(owners))

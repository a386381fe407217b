"""Finds redundant constraint equations by the rank of the Jacobian at the start and near it.

An equation may depend on others everywhere (a second hinge on the same axis) or only while links are in line. The
largest rank at the assembled start and at configurations near it counts. Contradictory equations do not assemble, which
the run reports.
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
    """Return the constraint equations of a scene, its joints with play open, that are redundant everywhere."""
    if not model.rows:
        return Redundancy()
    numeric = NumPyLinkage(model, source)
    names = {row.name for row in model.rows}
    open_rows = [r for r, row in enumerate(model.all_rows) if row.name in names]
    try:
        with np.errstate(all="ignore"):
            q = search(numeric, numeric.p).q
            start = scaled_rows(numeric, numeric.p, numeric.closed_phi_q(0.0, q, numeric.p)[open_rows])
            near = configurations(numeric, numeric.p, q, open_rows, SAMPLES if rank(start) < len(open_rows) else 0)
            matrices = [
                scaled_rows(numeric, numeric.p, numeric.closed_phi_q(0.0, x, numeric.p)[open_rows]) for x in near
            ]
        ranks = [rank(matrix) for matrix in matrices]
    except (GudgeonError, ArithmeticError, ValueError):  # not assembled, or not finite: the run reports the reason
        return Redundancy()
    expected_freedoms = model.scene.mechanism.freedoms
    if expected_freedoms is not None and isinstance(expected_freedoms.value, Number):
        check_freedoms(expected_freedoms.value.value, expected_freedoms.where, find_mobility(numeric, numeric.p, q))
    best = int(np.argmax(ranks))
    if ranks[best] == len(open_rows):
        return Redundancy()
    return _name_rows([model.all_rows[r] for r in open_rows], matrices[best], ranks[best])


def refuse_singular_masses(model: Model, source: KernelSource) -> None:
    """Raise BadValueError if bodies without moment of inertia can turn freely, so that the mass matrix is singular.

    The motion is tested at the start and near it; a motion that constraints determine needs no inertia.
    """
    bodies = model.scene.mechanism.bodies
    massless = {body.name: body.index + 2 for body in model.bodies if not model.slots.default(body.inertia)}
    if not massless or model.degrees_of_freedom <= 0:
        return
    numeric = NumPyLinkage(model, source)
    names = {row.name for row in model.rows}
    open_rows = [r for r, row in enumerate(model.all_rows) if row.name in names]
    try:
        near = configurations(numeric, numeric.p, search(numeric, numeric.p).q, open_rows, SAMPLES)
        heavy = numeric.mass(numeric.p) > 0.0
        matrices = [scaled_rows(numeric, numeric.p, numeric.closed_phi_q(0.0, q, numeric.p)[open_rows]) for q in near]
        found = [_lightest_motion(matrix, heavy) for matrix in matrices]
    except (GudgeonError, ArithmeticError, ValueError):  # as above
        return
    if all(fraction <= RANK for fraction, _ in found):
        motion = found[-1][1]
        name = max(massless, key=lambda body: abs(motion[massless[body]]))
        inertia = bodies[name].inertia
        where = inertia.where if inertia is not None else bodies[name].where
        raise BadValueError(
            f"body {name} has no moment of inertia, and nothing else resists its turning: its motion is not determined",
            where,
            f"expected bodies.{name}.inertia > 0, or its centre of mass (com) away from the joint about which it"
            " turns, or a drive that turns it",
        )


def _lightest_motion(phi_q: Array, heavy: NDArray[np.bool_]) -> tuple[float, Array]:
    """Return (fraction, motion (n,)) of the motion that satisfies the constraints and moves the least mass.

    The fraction is the norm of its part in coordinates with mass."""
    _, values, right = np.linalg.svd(phi_q) if len(phi_q) else (None, np.zeros(0), np.eye(len(heavy)))
    free = right[int((values > RANK * values.max(initial=0.0)).sum()) :].T
    _, fractions, motions = np.linalg.svd(free[heavy])
    return float(fractions[-1]) if len(fractions) == free.shape[1] else 0.0, free @ motions[-1]


def _name_rows(rows: Sequence[Row], matrix: Array, independent: int) -> Redundancy:
    """Select independent rows, drives first, then in the order of the file, and return the others as redundant.

    Pivoting is a Gram–Schmidt orthogonalization of the Jacobian's rows.
    """
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

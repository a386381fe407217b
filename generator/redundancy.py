"""Finds redundant constraint equations by the rank of the Jacobian at the start and near it.

An equation may depend on others everywhere (a second hinge on the same axis) or only while links are in line. The
largest rank at the assembled start and at configurations near it counts. Contradictory equations do not assemble, which
the run reports.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import normalize_jacobian_rows
from gudgeon.assembly.mobility import check_degrees_of_freedom, find_mobility
from gudgeon.assembly.rank import (
    N_NEARBY_CONFIGURATIONS,
    RANK_TOL,
    compute_left_null_maxima,
    compute_rank,
    find_nearby_configurations,
)
from gudgeon.assembly.start import search_start
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model, Redundancy
from gudgeon.generator.targets.numpy.linkage import NumPyLinkage
from gudgeon.language.tree import Number
from gudgeon.model.compiled import Array


def find_redundancy(model: Model, source: KernelSource) -> Redundancy:
    """Return the constraint equations of the scene that are redundant at all tested configurations, and their owners.

    Equations of joints with play do not count. The rank is the largest one at the start and at configurations near it.
    The result is empty if no equation is redundant, or if the linkage does not assemble, which the run reports. Raises
    BadValueError if the file gives the degrees of freedom as a number and those of the closed linkage differ.
    """
    if not model.rows:
        return Redundancy()
    linkage = NumPyLinkage(model, source)
    names = {row.name for row in model.rows}
    rows_of_scene = [r for r, row in enumerate(model.all_rows) if row.name in names]
    try:
        with np.errstate(all="ignore"):
            q = search_start(linkage, linkage.p).q
            start = normalize_jacobian_rows(linkage, linkage.p, linkage.closed_phi_q(0.0, q, linkage.p)[rows_of_scene])
            configurations_near_start = find_nearby_configurations(
                linkage,
                linkage.p,
                q,
                rows_of_scene,
                N_NEARBY_CONFIGURATIONS if compute_rank(start) < len(rows_of_scene) else 0,
            )
            matrices = [
                normalize_jacobian_rows(
                    linkage, linkage.p, linkage.closed_phi_q(0.0, configuration, linkage.p)[rows_of_scene]
                )
                for configuration in configurations_near_start
            ]
        ranks = [compute_rank(matrix) for matrix in matrices]
    except (GudgeonError, ArithmeticError, ValueError):  # not assembled, or not finite: the run reports the reason
        return Redundancy()
    expected_freedoms = model.scene.mechanism.freedoms
    index_of_largest_rank = int(np.argmax(ranks))
    if expected_freedoms is not None and isinstance(expected_freedoms.value, Number):
        has_independent_rows = ranks[index_of_largest_rank] == len(model.all_rows)  # no joint with play either
        if not (has_independent_rows and expected_freedoms.value.value == linkage.n - len(model.all_rows)):
            check_degrees_of_freedom(
                expected_freedoms.value.value, expected_freedoms.where, find_mobility(linkage, linkage.p, q)
            )
    if ranks[index_of_largest_rank] == len(rows_of_scene):
        return Redundancy()
    return _select_redundant_rows(
        [model.all_rows[r] for r in rows_of_scene], matrices[index_of_largest_rank], ranks[index_of_largest_rank]
    )


def check_mass_matrix(model: Model, source: KernelSource) -> None:
    """Raise BadValueError if bodies without moment of inertia can turn freely, so that the mass matrix is singular.

    That is the case if at the start and at all tested configurations near it some motion moves no mass. Nothing is
    tested if all moments of inertia are nonzero or the scene has no degree of freedom. Nothing is raised if the linkage
    does not assemble.
    """
    bodies = model.scene.mechanism.bodies
    bodies_without_inertia = {
        body.name: body.index + 2 for body in model.bodies if not model.parameter_table.compute_default(body.inertia)
    }
    if not bodies_without_inertia or model.degrees_of_freedom <= 0:
        return
    linkage = NumPyLinkage(model, source)
    names = {row.name for row in model.rows}
    rows_of_scene = [r for r, row in enumerate(model.all_rows) if row.name in names]
    try:
        configurations_near_start = find_nearby_configurations(
            linkage, linkage.p, search_start(linkage, linkage.p).q, rows_of_scene, N_NEARBY_CONFIGURATIONS
        )
        has_mass = linkage.mass(linkage.p) > 0.0
        matrices = [
            normalize_jacobian_rows(linkage, linkage.p, linkage.closed_phi_q(0.0, q, linkage.p)[rows_of_scene])
            for q in configurations_near_start
        ]
        motions_of_min_mass = [_find_motion_of_min_mass(matrix, has_mass) for matrix in matrices]
    except (GudgeonError, ArithmeticError, ValueError):  # as above
        return
    if all(fraction <= RANK_TOL for fraction, _ in motions_of_min_mass):
        motion = motions_of_min_mass[-1][1]
        name = max(bodies_without_inertia, key=lambda body: abs(motion[bodies_without_inertia[body]]))
        inertia = bodies[name].inertia
        location = inertia.where if inertia is not None else bodies[name].where
        raise BadValueError(
            f"body {name} has no moment of inertia, and no other part resists its rotation: the motion is not "
            "determined",
            location,
            f"expected bodies.{name}.inertia > 0, or its centre of mass (com) away from the joint about which it"
            " turns, or a drive that turns it",
        )


def _find_motion_of_min_mass(phi_q: Array, has_mass: NDArray[np.bool_]) -> tuple[float, Array]:
    """Return (fraction, motion (n,)) of the motion that satisfies the constraints and moves the least mass.

    phi_q: the scaled Jacobian (rows, n), possibly without rows; has_mass: mask (n,) of coordinates with mass. The
    motion has norm 1. The fraction is the norm of its part in coordinates with mass; 0: some motion moves no mass. The
    method is two singular value decompositions.
    """
    _, singular_values, right_vectors = (
        np.linalg.svd(phi_q) if len(phi_q) else (None, np.zeros(0), np.eye(len(has_mass)))
    )
    motions_without_constraint = right_vectors[
        int((singular_values > RANK_TOL * singular_values.max(initial=0.0)).sum()) :
    ].T
    _, fractions, motions = np.linalg.svd(motions_without_constraint[has_mass])
    return float(fractions[-1]) if len(fractions) == motions_without_constraint.shape[
        1
    ] else 0.0, motions_without_constraint @ motions[-1]


def _select_redundant_rows(rows: Sequence[Row], matrix: Array, rank_of_matrix: int) -> Redundancy:
    """Return the redundant constraint equations after selection of independent ones: drives first, then in file order.

    `matrix`: the Jacobian (rows, n) of the equations `rows`, of rank `rank_of_matrix`. The result has the names of the
    redundant equations, and the joints and drives whose multipliers are undetermined. The method is Gram–Schmidt.
    """
    order = sorted(range(len(rows)), key=lambda r: (rows[r].kind != "drive", r))
    basis = np.zeros((0, matrix.shape[1]))
    redundant = []
    for r in order:
        remainder = matrix[r] - (basis @ matrix[r]) @ basis
        remainder = remainder - (basis @ remainder) @ basis
        if len(basis) < rank_of_matrix and np.linalg.norm(remainder) > 10 * RANK_TOL * np.linalg.norm(matrix[r]):
            basis = np.vstack([basis, remainder / np.linalg.norm(remainder)])
        else:
            redundant.append(r)
    is_undetermined = compute_left_null_maxima(matrix) > 1e-7
    owners = dict.fromkeys(rows[r].owner for r in range(len(rows)) if is_undetermined[r])
    return Redundancy(tuple(rows[r].name for r in sorted(redundant)), tuple(owners))

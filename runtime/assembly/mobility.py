"""Compute the mobility of a linkage without play: degrees of freedom by Grübler's count and by rank.

Grübler's count is 3 bodies − equations; the rank of Φ_q is right also with redundant equations. It is evaluated at the
assembled start and near it, and the largest counts: links that are in line for a moment are not a degree of freedom.
Coordinates that describe the degrees of freedom are selected.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.assembly.linkage import Linkage, compute_mechanism_size, find_angles, normalize_jacobian_rows
from gudgeon.assembly.rank import N_NEARBY_CONFIGURATIONS, RANK_TOL, find_nearby_configurations
from gudgeon.errors import BadValueError, Location
from gudgeon.model.compiled import Array

MIN_INDEPENDENT_MOTION = 1e-6  # of a coordinate's largest motion: smallest motion that remains if others are held


@dataclass(frozen=True)
class Mobility:
    """Hold the mobility of a linkage without play, whose constraint equations include its drives.

    `freedoms` by rank, `gruebler` by count (n − equations); `independent_coordinates`: names of coordinates that
    describe the degrees of freedom; `unconnected_bodies`: bodies not connected to the ground; `redundant`: number of
    redundant equations; `n_dependent_at_start`: how many more equations are dependent at the start only, where links
    are in line.
    """

    coordinates: int
    rows: int
    freedoms: int
    independent_coordinates: tuple[str, ...]
    unconnected_bodies: tuple[str, ...]
    n_dependent_at_start: int

    @property
    def gruebler(self) -> int:
        """Return Grübler's count: the number of coordinates less that of constraint equations."""
        return self.coordinates - self.rows

    @property
    def redundant(self) -> int:
        """Return the number of redundant constraint equations, by which rank and count differ."""
        return self.freedoms - self.gruebler


def find_mobility(
    linkage: Linkage, p: Array, q: Array, equation_indices: Sequence[int] | None = None, t: float = 0.0
) -> Mobility:
    """Return the mobility of a linkage assembled at q (n,), from the largest rank of Φ_q at q and near it.

    It contains the numbers of coordinates, equations and degrees of freedom, coordinates that describe the motion, and
    unconnected bodies. `n_dependent_at_start` is by how much the rank at q itself is lower (links in line).
    equation_indices: those of the equations that count, None for all. t: time of the drives, s. Raises ValueError if no
    Jacobian is finite.
    """
    row_indices = (
        list(range(len(linkage.source.start_equations))) if equation_indices is None else list(equation_indices)
    )
    with np.errstate(all="ignore"):
        near_q = find_nearby_configurations(linkage, p, q, row_indices, N_NEARBY_CONFIGURATIONS, t)
        matrices = [normalize_jacobian_rows(linkage, p, linkage.closed_phi_q(t, x, p)[row_indices]) for x in near_q]
    null_spaces = [_compute_null_space(matrix) for matrix in matrices if np.isfinite(matrix).all()]
    regular = min(
        reversed(range(len(null_spaces))), key=lambda k: null_spaces[k].shape[1]
    )  # not the start, where links may align
    names, motions = linkage.source.coordinates, null_spaces[regular]
    coordinate_names = tuple(names[k] for k in _select_independent_coordinates(motions, _list_preferred_order(names)))
    n_dependent_at_start = null_spaces[0].shape[1] - motions.shape[1]
    return Mobility(
        len(names),
        len(row_indices),
        motions.shape[1],
        coordinate_names,
        _find_unconnected_bodies(linkage, matrices[regular]),
        n_dependent_at_start,
    )


def compute_admissible_velocities(linkage: Linkage, p: Array, q: Array, t: float = 0.0) -> Array:
    """Return an orthonormal basis (n, dof) of the velocities that all equations allow at q.

    Angles count as arcs at the mechanism's size. It has no columns if the Jacobian is not finite.
    """
    scale = np.where(find_angles(linkage.source), 1.0 / compute_mechanism_size(linkage, p), 1.0)
    with np.errstate(all="ignore"):
        matrix = normalize_jacobian_rows(linkage, p, linkage.closed_phi_q(t, q, p))
    return _compute_null_space(matrix) * scale[:, None] if np.isfinite(matrix).all() else np.zeros((len(q), 0))


def check_degrees_of_freedom(expected_dof: float, location: Location, mobility: Mobility) -> None:
    """Raise BadValueError at `location` if the file states another number of degrees of freedom than was found."""
    if mobility.freedoms != expected_dof:
        directions_text = f": {', '.join(mobility.independent_coordinates)}" if mobility.independent_coordinates else ""
        message = (
            f"freedoms is {expected_dof:g}, but with all joints closed there are {mobility.freedoms}{directions_text}"
        )
        hint = "look for a joint or a drive that is missing or too many, or correct the number"
        raise BadValueError(message, location, f"expected {mobility.freedoms}, if that is meant; {hint}")


def _compute_null_space(matrix: Array) -> Array:
    """Return an orthonormal basis (n, dof) of the null space: singular values below RANK_TOL of the largest are 0."""
    if not len(matrix):
        return np.eye(matrix.shape[1])
    _, values, right = np.linalg.svd(matrix)
    rank = int((values > RANK_TOL * values[0]).sum()) if values[0] > 0.0 else 0
    return np.asarray(right[rank:].T, dtype=np.float64)


def _list_preferred_order(names: tuple[str, ...]) -> list[int]:
    """Return the indices of coordinates in order of preference: by body as in the file, the angle before x and y."""
    return [k + shift for k in range(0, len(names), 3) for shift in (2, 0, 1)]


def _select_independent_coordinates(admissible_velocities: Array, preferred_order: list[int]) -> list[int]:
    """Return the indices of dof independent coordinates, whose velocities determine all `admissible_velocities`.

    They are selected in the order `preferred_order` by Gram–Schmidt. In a first pass, a tenth or more of a coordinate's
    motion must be independent of the coordinates already selected; in a second pass, any motion above
    MIN_INDEPENDENT_MOTION.
    """
    basis, selected = np.zeros((0, admissible_velocities.shape[1])), list[int]()
    for independent_part in (0.1, 0.0):  # smallest independent fraction of a coordinate's motion
        for k in preferred_order:
            remainder = admissible_velocities[k] - (basis @ admissible_velocities[k]) @ basis
            length = float(np.linalg.norm(remainder))
            if (
                len(selected) < admissible_velocities.shape[1]
                and length > MIN_INDEPENDENT_MOTION
                and length > independent_part * float(np.linalg.norm(admissible_velocities[k]))
            ):
                basis, selected = np.vstack([basis, remainder / length]), [*selected, k]
    return selected


def _find_unconnected_bodies(linkage: Linkage, matrix: Array) -> tuple[str, ...]:
    """Return the names of the bodies that no joint or drive connects to the ground, not even through other bodies.

    matrix: rows of Φ_q, one for each equation.
    """
    bodies = linkage.source.bodies
    bodies_of_row = [{k for k, body in enumerate(bodies) if np.any(row[body.index : body.index + 3])} for row in matrix]
    # an equation of one body connects it to the ground, equations of several bodies connect these
    connected = {k for row in bodies_of_row if len(row) == 1 for k in row}
    is_growing = True
    while is_growing:
        is_growing = False
        for row in bodies_of_row:
            if row & connected and not row <= connected:
                connected, is_growing = connected | row, True
    return tuple(body.name for k, body in enumerate(bodies) if k not in connected)

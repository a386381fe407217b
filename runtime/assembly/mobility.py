"""Compute the mobility of a closed linkage: degrees of freedom by count and by rank, and coordinates that describe
them.

Grübler's count is 3 bodies − equations; the rank of Φ_q is right also with redundant equations. It is evaluated at the
assembled start and near it, and the largest counts: links that are in line for a moment are not a degree of freedom.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.assembly.linkage import Linkage, angles, mechanism_size, scaled_rows
from gudgeon.assembly.rank import RANK, SAMPLES, configurations
from gudgeon.errors import BadValueError, Location
from gudgeon.model.compiled import Array

INDEPENDENT = 1e-6  # of a coordinate's largest motion: smallest motion that remains if others are held


@dataclass(frozen=True)
class Mobility:
    """Hold the mobility of the closed linkage, whose constraint equations include its drives.

    `freedoms` by rank, `gruebler` by count (n − equations); `along`: coordinates that describe the degrees of freedom;
    `loose`: bodies not connected to the ground; `redundant`: number of redundant equations; `aligned`: how many more
    equations are dependent at the start only, where links are in line.
    """

    coordinates: int
    rows: int
    freedoms: int
    along: tuple[str, ...]
    loose: tuple[str, ...]
    aligned: int

    @property
    def gruebler(self) -> int:
        """Return the number of coordinates less that of constraint equations."""
        return self.coordinates - self.rows

    @property
    def redundant(self) -> int:
        """Return the number of redundant constraint equations."""
        return self.freedoms - self.gruebler


def find_mobility(linkage: Linkage, p: Array, q: Array, rows: Sequence[int] | None = None, t: float = 0.0) -> Mobility:
    """Return the mobility of a linkage assembled at q (n,), optionally of some of its equations only."""
    kept = list(range(len(linkage.source.start_rows))) if rows is None else list(rows)
    with np.errstate(all="ignore"):
        near = configurations(linkage, p, q, kept, SAMPLES, t)
        matrices = [scaled_rows(linkage, p, linkage.closed_phi_q(t, x, p)[kept]) for x in near]
    spaces = [_null_space(matrix) for matrix in matrices if np.isfinite(matrix).all()]
    least = min(reversed(range(len(spaces))), key=lambda k: spaces[k].shape[1])  # not the start, where links may align
    names, free = linkage.source.coordinates, spaces[least]
    along = tuple(names[k] for k in _describing_coordinates(free, _preferred_order(names)))
    aligned = spaces[0].shape[1] - free.shape[1]
    return Mobility(len(names), len(kept), free.shape[1], along, _loose_bodies(linkage, matrices[least]), aligned)


def free_motions(linkage: Linkage, p: Array, q: Array, t: float = 0.0) -> Array:
    """Return an orthonormal basis (n, freedoms) of the velocities that all equations allow at q.

    Angles count as arcs at the mechanism's size.
    """
    scale = np.where(angles(linkage.source), 1.0 / mechanism_size(linkage, p), 1.0)
    with np.errstate(all="ignore"):
        matrix = scaled_rows(linkage, p, linkage.closed_phi_q(t, q, p))
    return _null_space(matrix) * scale[:, None] if np.isfinite(matrix).all() else np.zeros((len(q), 0))


def check_freedoms(expected: float, where: Location, found: Mobility) -> None:
    """Raise BadValueError if the file states another number of degrees of freedom of its closed linkage."""
    if found.freedoms != expected:
        along = f": {', '.join(found.along)}" if found.along else ""
        message = f"freedoms is {expected:g}, but with all joints closed there are {found.freedoms}{along}"
        hint = "look for a joint or a drive that is missing or too many, or correct the number"
        raise BadValueError(message, where, f"expected {found.freedoms}, if that is meant; {hint}")


def _null_space(matrix: Array) -> Array:
    """Return an orthonormal basis (n, freedoms) of the null space of a matrix."""
    if not len(matrix):
        return np.eye(matrix.shape[1])
    _, values, right = np.linalg.svd(matrix)
    rank = int((values > RANK * values[0]).sum()) if values[0] > 0.0 else 0
    return np.asarray(right[rank:].T, dtype=np.float64)


def _preferred_order(names: tuple[str, ...]) -> list[int]:
    """Return the order in which coordinates are tried: by body as in the file, the angle before x and y."""
    return [k + shift for k in range(0, len(names), 3) for shift in (2, 0, 1)]


def _describing_coordinates(free: Array, order: list[int]) -> list[int]:
    """Return the first coordinates in this order that distinguish all free motions."""
    basis, selected = np.zeros((0, free.shape[1])), list[int]()
    for share in (0.1, 0.0):  # of a coordinate's motion that is its own; then those that only go with others
        for k in order:
            rest = free[k] - (basis @ free[k]) @ basis
            own = float(np.linalg.norm(rest))
            if len(selected) < free.shape[1] and own > INDEPENDENT and own > share * float(np.linalg.norm(free[k])):
                basis, selected = np.vstack([basis, rest / own]), [*selected, k]
    return selected


def _loose_bodies(linkage: Linkage, matrix: Array) -> tuple[str, ...]:
    """Return the bodies that no joint or drive connects to the ground, not even through other bodies."""
    bodies = linkage.source.bodies
    touched = [{k for k, body in enumerate(bodies) if np.any(row[body.index : body.index + 3])} for row in matrix]
    # a row of one body ties it to the ground, and with it those that rows join to it
    held = {k for row in touched if len(row) == 1 for k in row}
    grown = True
    while grown:
        grown = False
        for row in touched:
            if row & held and not row <= held:
                held, grown = held | row, True
    return tuple(body.name for k, body in enumerate(bodies) if k not in held)

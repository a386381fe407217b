"""What of a closed linkage can move: degrees of freedom by counting and by rank, and along which coordinates.

Grübler's count is 3 bodies − rows; the rank of Φ_q tells the truth where rows say the same twice. It is taken at the
assembled start and near it, where the largest counts: links that stand in one line for a moment are no freedom.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.assembly.linkage import Linkage, angles, mechanism_size, scaled_rows
from gudgeon.assembly.rank import RANK, SAMPLES, configurations
from gudgeon.errors import BadValueError, Location
from gudgeon.model.compiled import Array

INDEPENDENT = 1e-6  # of a coordinate's largest motion: what is left of it when others are held


@dataclass(frozen=True)
class Mobility:
    """Of the closed linkage, its drives among the rows.

    `freedoms` by rank, `gruebler` by counting (n − rows); `along` are coordinates that describe the freedoms, as many,
    `loose` bodies that no row ties to the ground, `redundant` the number of rows that say nothing new, `aligned` how
    many more do so at the start alone: links lie in one line there.
    """

    coordinates: int
    rows: int
    freedoms: int
    along: tuple[str, ...]
    loose: tuple[str, ...]
    aligned: int

    @property
    def gruebler(self) -> int:
        """Coordinates less rows."""
        return self.coordinates - self.rows

    @property
    def redundant(self) -> int:
        """Rows that say nothing new."""
        return self.freedoms - self.gruebler


def find_mobility(linkage: Linkage, p: Array, q: Array, rows: Sequence[int] | None = None, t: float = 0.0) -> Mobility:
    """Of a linkage that is assembled at q (n,); of some of its rows where those of joints with play are left out."""
    kept = list(range(len(linkage.source.start_rows))) if rows is None else list(rows)
    with np.errstate(all="ignore"):
        near = configurations(linkage, p, q, kept, SAMPLES, t)
        matrices = [scaled_rows(linkage, p, linkage.closed_phi_q(t, x, p)[kept]) for x in near]
    spaces = [_free_motions(matrix) for matrix in matrices if np.isfinite(matrix).all()]
    least = min(reversed(range(len(spaces))), key=lambda k: spaces[k].shape[1])  # not the start, where links may align
    names, free = linkage.source.coordinates, spaces[least]
    along = tuple(names[k] for k in _describing(free, _order(names)))
    aligned = spaces[0].shape[1] - free.shape[1]
    return Mobility(len(names), len(kept), free.shape[1], along, _loose(linkage, matrices[least]), aligned)


def free_motions(linkage: Linkage, p: Array, q: Array, t: float = 0.0) -> Array:
    """An orthonormal basis of the velocities that all rows of the closed linkage let pass at q, (n, freedoms); angles
    count as arcs at the mechanism's size."""
    scale = np.where(angles(linkage.source), 1.0 / mechanism_size(linkage, p), 1.0)
    with np.errstate(all="ignore"):
        matrix = scaled_rows(linkage, p, linkage.closed_phi_q(t, q, p))
    return _free_motions(matrix) * scale[:, None] if np.isfinite(matrix).all() else np.zeros((len(q), 0))


def check_freedoms(wanted: float, where: Location, found: Mobility) -> None:
    """BadValueError where a file says that its closed linkage has another number of degrees of freedom."""
    if found.freedoms != wanted:
        along = f": {', '.join(found.along)}" if found.along else ""
        told = f"freedoms is {wanted:g}, but with all joints closed there are {found.freedoms}{along}"
        hint = "look for a joint or a drive that is missing or too many, or correct the number"
        raise BadValueError(told, where, f"expected {found.freedoms}, if that is meant; {hint}")


def _free_motions(matrix: Array) -> Array:
    """An orthonormal basis of what the rows let move, (n, freedoms)."""
    if not len(matrix):
        return np.eye(matrix.shape[1])
    _, values, right = np.linalg.svd(matrix)
    rank = int((values > RANK * values[0]).sum()) if values[0] > 0.0 else 0
    return np.asarray(right[rank:].T, dtype=np.float64)


def _order(names: tuple[str, ...]) -> list[int]:
    """Body by body as in the file, its angle before its place: a crank that turns is told by its angle."""
    return [k + shift for k in range(0, len(names), 3) for shift in (2, 0, 1)]


def _describing(free: Array, order: list[int]) -> list[int]:
    """Coordinates, the first that do in this order, that tell all free motions apart."""
    basis, chosen = np.zeros((0, free.shape[1])), list[int]()
    for share in (0.1, 0.0):  # of a coordinate's motion that is its own; then those that only go with others
        for k in order:
            rest = free[k] - (basis @ free[k]) @ basis
            own = float(np.linalg.norm(rest))
            if len(chosen) < free.shape[1] and own > INDEPENDENT and own > share * float(np.linalg.norm(free[k])):
                basis, chosen = np.vstack([basis, rest / own]), [*chosen, k]
    return chosen


def _loose(linkage: Linkage, matrix: Array) -> tuple[str, ...]:
    """Bodies that no joint and no drive ties to the ground, not even over other bodies."""
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

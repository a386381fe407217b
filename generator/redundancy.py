"""Rows of Φ that say nothing new: found by rank at the start and near it, named, and left out.

A row may depend on the others everywhere (a second hinge on the same axis) or only where links stand in
one line for a moment. So the rank is taken at the assembled start and at configurations near it on the
same branch; the largest counts. Contradictory rows do not assemble: the run tells them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gudgeon.assembly.mobility import SAMPLES, check_freedoms, configurations, find_mobility
from gudgeon.assembly.rank import RANK, rank, tied
from gudgeon.assembly.search import search
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError
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
            more = SAMPLES if rank(numeric.closed_phi_q(0.0, q, numeric.p)[kept]) < len(kept) else 0
            near = configurations(numeric, numeric.p, q, kept, more)
            matrices = [numeric.closed_phi_q(0.0, x, numeric.p)[kept] for x in near]
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

"""The exact start on the branch nearest the guess: positions by Newton, then velocities.

A scene with play starts from its closed linkage (e = 0, ideal velocities), but where the file's `start.play` says e
and ė of a journal: rows of its joint are held apart by so much. Angles weigh most: a step moves guessed angles least,
then the other angles, and positions follow. The ordinary case is one call of C (engine/scene/start.c); what it cannot
close, or not near the guess, is looked for in search.py.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gudgeon.assembly.journals import check_places
from gudgeon.assembly.large import LARGE
from gudgeon.assembly.linkage import mechanism_size
from gudgeon.model.compiled import Array, CompiledModel


@dataclass(frozen=True)
class Start:
    """q, q̇ (n,) at time t, with the residual max |Φ| that is left."""

    q: Array
    v: Array
    residual: float


def assemble(compiled: CompiledModel, p: Array, t: float = 0.0) -> Start:
    """The start of a scene. Raises AssemblyError with rows, joints and residual."""
    check_places(compiled, p)
    closed = compiled.close(t, p, mechanism_size(compiled, p)) if compiled.n < LARGE else None
    if closed is not None and np.isfinite(closed[1]).all():
        return Start(*closed)
    from gudgeon.assembly.search import search  # with all that is said where it fails: seldom wanted

    return search(compiled, p, t)

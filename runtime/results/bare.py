"""Samples of a run without what it says of itself: for series that are evaluated of many runs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, cast

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError
from gudgeon.integrators.trajectory import IMPACT_DTYPE
from gudgeon.model.evaluation import PARTS, Evaluation
from gudgeon.model.left_limit import evaluation_times_of
from gudgeon.results.results import Array, Result

if TYPE_CHECKING:
    from gudgeon.model.compiled import CompiledModel
    from gudgeon.results.diagnostics import Diagnostics


@dataclass(eq=False)
class Bare(Result):
    """A Result whose series are computed from `parts` of an Evaluation, and no more; it has no diagnostics."""

    parts: frozenset[str] = PARTS

    @cached_property
    def evaluation(self) -> Evaluation:
        """These parts, the others without a row. Raises SingularError."""
        if self.compiled is None:
            raise GudgeonError("there is no library to evaluate samples with")
        times = evaluation_times_of(self, self.compiled)
        return self.compiled.evaluate(times, self.q, self.v, self.memory, self.p, parts=self.parts)


def bare(
    source: KernelSource, compiled: CompiledModel | None, p: Array, t: Array, q: Array, v: Array, work: Array,
    memory: Array, state: Array, parts: frozenset[str],
) -> Bare:  # fmt: skip
    """From samples as C stores them; works that no masses tell are NaN."""
    slots = len(source.slots)
    return Bare(
        compiled=compiled, source=source, p=p, given=np.zeros(slots), is_given=np.zeros(slots, bool), t=t, q=q, v=v,
        accelerations=None, state=state, memory=memory, work=np.full_like(work, np.nan) if source.massless else work,
        impacts=np.zeros(0, IMPACT_DTYPE), diagnostics=cast("Diagnostics", None), parts=parts,
    )  # fmt: skip


def blank(source: KernelSource) -> Bare:
    """No samples at all: it knows names and units."""
    n, joints = len(source.coordinates), len(source.clearances)
    p = np.full(len(source.slots) + len(source.derived), np.nan)
    empty = np.zeros((0, n)), np.zeros((0, n)), np.zeros((0, 3)), np.zeros((0, source.n_memory))
    return bare(source, None, p, np.zeros(0), *empty, np.zeros((0, joints), np.int8), PARTS)

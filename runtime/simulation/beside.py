"""Another scene of the mechanism at the very times of a run's steps: what errors over all steps are taken from."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.assembly.start import assemble
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.integrators.steps import Steps
from gudgeon.integrators.trajectory import Problem
from gudgeon.language.wanted import refuse
from gudgeon.model.choices import said
from gudgeon.model.compiled import Array
from gudgeon.model.parameters import prepare, without_baumgarte
from gudgeon.results.series import catalogue
from gudgeon.simulation.arguments import integrate, method_of

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.simulation.simulation import Simulation


class Beside:
    """A scene that begins at t = 0 as its file says, with the numbers of the run where it has them too."""

    def __init__(self, simulation: Simulation, source: KernelSource, p: Array, rtol: float) -> None:
        self.compiled = simulation.compiled
        self.scene, self.names = simulation.source.scene, frozenset(catalogue(simulation.source))
        own = {slot.address for slot in self.compiled.source.slots}
        values = {slot.address: said(slot, float(p[k])) for k, slot in enumerate(source.slots) if slot.address in own}
        self.numbers = prepare(self.compiled, values)
        self.lost = ""  # why it is followed no further
        self.problem: Problem | None = None  # from where it goes on
        self.last: Steps | None = None  # the state there
        self.rtol = rtol

    def follow(self, t: Array) -> Steps | None:
        """Its states at times t (k,), not before those of the last call; None once it cannot be followed."""
        if self.lost:
            return None
        try:
            return self._follow(t)
        except GudgeonError as error:
            self.lost = str(error)
            return None

    def _follow(self, t: Array) -> Steps:
        problem = self.problem or self._begin()
        times = np.union1d(problem.t[:1], t)
        if self.last is not None and len(times) == 1:
            return self.last[np.zeros(len(t), dtype=int)]
        x = integrate(replace(problem, t=times))
        if x.stopped is not None:
            raise x.stopped
        work = x.work if self.last is None else x.work + self.last.work  # each part begins with none
        steps = Steps(x.t, x.q, x.v, work, x.memory, x.state, np.zeros(len(x.t), dtype=bool))
        self.last = steps[-1:]
        state = x.state[-1] if x.state.shape[1] else None
        self.problem = replace(problem, t=times[-1:], q=x.q[-1], v=x.v[-1], memory=x.memory[-1], state=state)
        return steps[np.searchsorted(x.t, t)]

    def _begin(self) -> Problem:
        p, given, is_given = self.numbers
        assembled, method = assemble(self.compiled, p), method_of(self.compiled.source, "auto", False)
        memory = np.full(self.compiled.n_memory, np.nan)
        return Problem(
            self.compiled, p, np.zeros(1), assembled.q, assembled.v, memory, math.inf, method=method, rtol=self.rtol,
            p_free=without_baumgarte(self.compiled, given, is_given), stop=False,
        )  # fmt: skip


def check_beside(source: KernelSource, against: Simulation | None) -> Simulation | None:
    """BadValueError for what is no loaded scene of the same mechanism."""
    if against is None:
        return None
    if not hasattr(against, "compiled") or not hasattr(against, "simulate"):
        refuse("against", against, "a loaded scene, gudgeon.load(file)")
    if against.source.mechanism != source.mechanism:
        told = f"against is a scene of {against.source.mechanism}: this is a scene of {source.mechanism}"
        raise BadValueError(told, hint="errors are taken against another scene of the same mechanism")
    return against

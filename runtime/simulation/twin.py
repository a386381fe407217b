"""The growth of differences by a twin: two runs from neighbouring states, led back to each other time after time.

After G. Benettin, L. Galgani, J.-M. Strelcyn, Phys. Rev. A 14:2338, 1976. Both runs go on together, in two threads;
contacts, corners, friction that sticks and inner states are those of each. Where at the end of an interval only one of
them is in contact, the difference is measured and left as it is until they are alike again.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.model.compiled import Array
from gudgeon.simulation.neighbours import NEAR, Neighbours, alike, flat, moved

if TYPE_CHECKING:
    from gudgeon.results.results import Result, State
    from gudgeon.simulation.simulation import Simulation

FURTHEST = 1e3  # times NEAR: beyond it an interval is taken again, shorter
ONE = 1e-8  # times NEAR: both runs are one, as where friction sticks; a new neighbour is drawn


@dataclass(eq=False)
class Twin:
    """`state` of the run, and what its neighbour is."""

    simulation: Simulation
    measure: Neighbours
    settings: dict[str, Any]
    state: State
    transverse: bool
    unresolved: float = 0.0
    merged: int = 0  # how often both became one

    def __post_init__(self) -> None:
        first = self.measure.drawn(self.state.t, flat(self.state))
        self.other = moved(self.state, first, self.state.memory.copy())
        self.distance = self.measure.apart(first - flat(self.state))

    def advance(self, t: float, shortest: bool) -> tuple[Result, float] | None:
        """To t (s): the run there and the logarithm of the growth; None: too much of it, unless it is the shortest."""
        begin = [self.state, self.other]
        batch = self.simulation.simulate_many(
            [{}, {}], output=[t], start=begin, stop=False, peaks=(), side_by_side=False, **self.settings
        )
        if batch.failures:
            raise batch.failures[0].error
        if any(run.diagnostics.interrupted for run in (batch[0], batch[1])):
            raise KeyboardInterrupt
        run, other = batch[0], batch[1].final
        difference = flat(other) - flat(run.final)
        if self.transverse:
            flow = np.concatenate([run.v[-1], run.a[-1]])
            difference -= self.measure.along(difference, flow) * flow
        distance = self.measure.apart(difference)
        if distance <= ONE * NEAR:
            grown = math.log(ONE * NEAR / self.distance)
            self.state, self.merged = run.final, self.merged + 1
            self.__post_init__()
            return run, grown
        far = not 1.0 / FURTHEST < distance / self.distance < FURTHEST or distance > FURTHEST * NEAR
        if far and not shortest:
            return None
        grown = math.log(distance / self.distance)
        self.state, self.other, self.distance = run.final, other, distance
        if alike(run.final, other):
            self._led_back(difference)
        return run, grown

    def _led_back(self, difference: Array) -> None:
        """The neighbour NEAR apart again, in the direction in which it is."""
        s, y = NEAR / self.distance, flat(self.state)
        ahead = self.measure.onto(self.state.t, y + s * difference)
        memory = self.state.memory + s * (self.other.memory - self.state.memory)
        self.other = moved(self.other, ahead, memory)
        self.distance = self.measure.apart(ahead - y)

"""Two neighbouring states of one scene: how far they are apart, differences that the constraints allow, their growth.

A difference (δq, δv) of all bodies is measured without units: lengths by the smallest clearance (without play by the
mechanism's size), angles by the same over the size, velocities by these and the time in which the motion crosses the
size. No exponent hangs on it; how soon it is reached does.

A difference grows between two runs that are led back to each other time after time, after G. Benettin, L. Galgani,
J.-M. Strelcyn, Phys. Rev. A 14:2338, 1976. Both runs go on together, in two threads; contacts, corners, friction that
sticks and inner states are those of each. Where at the end of an interval only one of them is in contact, the
difference is measured and left as it is until they are alike again.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.linkage import angles, project
from gudgeon.integrators.adaptive import lengths
from gudgeon.model.compiled import Array, CompiledModel

if TYPE_CHECKING:
    from gudgeon.results.results import Result, State
    from gudgeon.simulation.simulation import Simulation


NEAR = 1e-6  # how far neighbours begin apart: far above what an integrator errs by, far below what is non-linear
TURNED = 0.2  # of the rms acceleration: it changes by less in a span in which nothing turns
DRAW = 1  # seed of the first difference
FURTHEST = 1e3  # times NEAR: beyond it an interval is taken again, shorter
ONE = 1e-8  # times NEAR: both runs are one, as where friction sticks; a new neighbour is drawn


@dataclass(frozen=True, eq=False)
class Neighbours:
    """What measures differences of states of one run."""

    compiled: CompiledModel
    p: Array  # (n_slots + n_derived,)
    weights: Array  # (2n,) what counts as 1
    size: float  # m, the mechanism's
    crossing: float  # s, in which the motion crosses the mechanism's size

    @staticmethod
    def of(run: Result, compiled: CompiledModel) -> Neighbours:
        """By the numbers and the speeds of a run."""
        length, size = (float(x) for x in lengths(compiled, run.p))
        angle = angles(compiled.source)
        speeds = np.sqrt(np.mean(np.square(run.v / np.where(angle, 1.0, size)), axis=0))
        crossing = 1.0 / speeds.max(initial=0.0) if speeds.max(initial=0.0) > 0.0 else 1.0
        of_q = np.where(angle, length / size, length)
        return Neighbours(compiled, run.p, np.concatenate([of_q, of_q / crossing]), size, crossing)

    def is_short(self, run: Result) -> bool:
        """Return whether a run is over before anything turns: it has no contact, does not cross the mechanism's size,
        and ends before its accelerations could stop it (rms speed over rms acceleration), or before they change.
        """
        span, q = float(run.t[-1] - run.t[0]), self.weights[: self.n]
        if span >= self.crossing or (run.impacts["t_on"] > run.t[0]).any():
            return False
        speed, acceleration, change = (
            float(np.sqrt(np.mean(np.square(x / q)))) for x in (run.v, run.a, run.a - run.a.mean(axis=0))
        )
        return span * acceleration < speed or change <= TURNED * acceleration

    @property
    def n(self) -> int:
        """Coordinates of all bodies."""
        return len(self.weights) // 2

    def apart(self, difference: Array) -> float:
        """How far, of a difference (2n,) of (q, q̇)."""
        return float(np.linalg.norm(difference / self.weights))

    def onto(self, t: float, y: Array) -> Array:
        """(q, q̇) moved back onto the constraints."""
        n = len(y) // 2
        return np.concatenate(project(self.compiled, t, y[:n], y[n:], self.p))

    def drawn(self, t: float, y: Array) -> Array:
        """A neighbour of y, NEAR apart, in a direction drawn once and for all."""
        ahead = self.weights * np.random.default_rng(DRAW).standard_normal(len(y))
        for _ in range(2):  # what is left of it by the constraints, then as long as is wanted
            ahead *= NEAR / self.apart(ahead)
            ahead = self.onto(t, y + ahead) - self.onto(t, y)
        return y + ahead

    def along(self, difference: Array, flow: Array) -> float:
        """How much of the motion's direction (2n,), (q̇, q̈), is in a difference."""
        w = self.weights
        length = float(np.sum(np.square(flow / w)))
        return float((difference / w) @ (flow / w)) / length if length > 0.0 else 0.0


def flat(state: State) -> Array:
    """(q, q̇), (2n,)."""
    return np.concatenate([state.q, state.v])


def moved(state: State, y: Array, memory: Array) -> State:
    """The same with other coordinates, velocities and memory."""
    n = len(state.q)
    return replace(state, q=y[:n].copy(), v=y[n:].copy(), memory=memory)


def alike(one: State, other: State) -> bool:
    """Whether the same contacts are closed and the same frictions stick."""
    clearances = len(one.state)
    modes = (one.memory[clearances:], other.memory[clearances:])
    closed = np.array_equal(one.state > 0, other.state > 0)
    return closed and np.array_equal(np.isnan(modes[0]), np.isnan(modes[1]))


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

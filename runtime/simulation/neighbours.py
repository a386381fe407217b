"""Measure the distance of two neighbouring states of one scene, and its growth between two runs (Benettin's
method).

A difference (δq, δv) of all bodies is dimensionless: lengths are divided by the smallest clearance, or without play by
the mechanism's size. Angles are divided by that length over the size, velocities by these scales over the time in which
the motion crosses the size. The exponent does not depend on the scales.

The second run is scaled back towards the first one after each interval (G. Benettin, L. Galgani, J.-M. Strelcyn, Phys.
Rev. A 14:2338, 1976). Both runs proceed in two threads, each with its own contacts, switching points, friction modes
and inner states. If only one of them is in contact at the end of an interval, the difference is measured but not scaled
until both are alike again.
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


NEAR = 1e-6  # initial distance of neighbours: far above integration errors, far below non-linear effects
TURNED = 0.2  # of the rms acceleration: it changes by less in a span in which nothing turns
DRAW = 1  # random seed of the first difference
FURTHEST = 1e3  # times NEAR: if the distance is larger, the interval is repeated with half its length
ONE = 1e-8  # times NEAR: closer runs count as merged, as where friction sticks; a new neighbour is drawn


@dataclass(frozen=True, eq=False)
class Neighbours:
    """Measure differences of states of one run, with scales from that run."""

    compiled: CompiledModel
    p: Array  # (n_slots + n_derived,)
    weights: Array  # (2n,) scales of q and q̇: differences that count as 1
    size: float  # m, of the mechanism
    crossing: float  # s, time in which the motion crosses the mechanism's size

    @staticmethod
    def of(run: Result, compiled: CompiledModel) -> Neighbours:
        """Take the scales from the parameter values and the speeds of a run."""
        length, size = (float(x) for x in lengths(compiled, run.p))
        angle = angles(compiled.source)
        speeds = np.sqrt(np.mean(np.square(run.v / np.where(angle, 1.0, size)), axis=0))
        crossing = 1.0 / speeds.max(initial=0.0) if speeds.max(initial=0.0) > 0.0 else 1.0
        of_q = np.where(angle, length / size, length)
        return Neighbours(compiled, run.p, np.concatenate([of_q, of_q / crossing]), size, crossing)

    def is_short(self, run: Result) -> bool:
        """Return whether a run ends before anything turns, so that an exponent would be meaningless.

        Such a run has no contact and does not cross the mechanism's size. It ends before its accelerations could stop
        it (rms speed over rms acceleration), or before they change.
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
        """Return the number of coordinates of all bodies."""
        return len(self.weights) // 2

    def apart(self, difference: Array) -> float:
        """Return the scaled norm of a difference (2n,) of (q, q̇)."""
        return float(np.linalg.norm(difference / self.weights))

    def onto(self, t: float, y: Array) -> Array:
        """Return y = (q, q̇), (2n,), projected onto the constraints at time t."""
        n = len(y) // 2
        return np.concatenate(project(self.compiled, t, y[:n], y[n:], self.p))

    def drawn(self, t: float, y: Array) -> Array:
        """Return a neighbour of y at distance NEAR on the constraints, in a fixed random direction."""
        ahead = self.weights * np.random.default_rng(DRAW).standard_normal(len(y))
        for _ in range(2):  # project onto the constraints, then scale to the length
            ahead *= NEAR / self.apart(ahead)
            ahead = self.onto(t, y + ahead) - self.onto(t, y)
        return y + ahead

    def along(self, difference: Array, flow: Array) -> float:
        """Return the component of a difference (2n,) along the motion's direction `flow` = (q̇, q̈)."""
        w = self.weights
        length = float(np.sum(np.square(flow / w)))
        return float((difference / w) @ (flow / w)) / length if length > 0.0 else 0.0


def flat(state: State) -> Array:
    """Return (q, q̇), (2n,), of a state."""
    return np.concatenate([state.q, state.v])


def moved(state: State, y: Array, memory: Array) -> State:
    """Return the state with coordinates and velocities y (2n,) and discrete states `memory`."""
    n = len(state.q)
    return replace(state, q=y[:n].copy(), v=y[n:].copy(), memory=memory)


def alike(one: State, other: State) -> bool:
    """Return whether two states have the same closed contacts and the same sticking frictions."""
    clearances = len(one.state)
    modes = (one.memory[clearances:], other.memory[clearances:])
    closed = np.array_equal(one.state > 0, other.state > 0)
    return closed and np.array_equal(np.isnan(modes[0]), np.isnan(modes[1]))


@dataclass(eq=False)
class SecondRun:
    """Follow a second run next to the `state` of the first one, and measure how their distance grows."""

    simulation: Simulation
    measure: Neighbours
    settings: dict[str, Any]
    state: State
    transverse: bool
    unresolved: float = 0.0
    merged: int = 0  # number of times that both runs became one

    def __post_init__(self) -> None:
        """Draw the neighbour."""
        first = self.measure.drawn(self.state.t, flat(self.state))
        self.other = moved(self.state, first, self.state.memory.copy())
        self.distance = self.measure.apart(first - flat(self.state))

    def advance(self, t: float, shortest: bool) -> tuple[Result, float] | None:
        """Advance both runs to t (s); return the first run and ln of the growth of the distance.

        Return None if the distance grew too much, unless the interval is the `shortest`.
        """
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
            self._rescale(difference)
        return run, grown

    def _rescale(self, difference: Array) -> None:
        """Scale the neighbour back to the distance NEAR, in its present direction."""
        s, y = NEAR / self.distance, flat(self.state)
        ahead = self.measure.onto(self.state.t, y + s * difference)
        memory = self.state.memory + s * (self.other.memory - self.state.memory)
        self.other = moved(self.other, ahead, memory)
        self.distance = self.measure.apart(ahead - y)

"""Measure the distance of two neighbouring states of one scene, and its growth between two runs (Benettin's
method).

A difference (δq, δv) of all bodies is dimensionless: lengths are divided by the smallest clearance, or without play by
the mechanism's size. Angles are divided by that length over the size, velocities by these scales over the time in which
the motion crosses the size. The exponent does not depend on the scales.

The second run is scaled back towards the first one after each interval (G. Benettin, L. Galgani, J.-M. Strelcyn, Phys.
Rev. A 14:2338, 1976). Both runs proceed in two threads, each with its own contacts, switching points, friction modes
and internal states. If only one of them is in contact at the end of an interval, the difference is measured but not
scaled until both are alike again.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.linkage import find_angles, project_state
from gudgeon.integrators.adaptive import compute_error_lengths
from gudgeon.model.compiled import Array, CompiledModel

if TYPE_CHECKING:
    from gudgeon.results.results import Result, State
    from gudgeon.simulation.simulation import Simulation


INITIAL_DISTANCE = 1e-6  # initial distance of neighbours: far above integration errors, far below non-linear effects
MAX_CHANGE_AT_REST = 0.2  # of the rms acceleration: it changes by less in a span in which nothing turns
SEED = 1  # random seed of the first difference
MAX_GROWTH = 1e3  # times INITIAL_DISTANCE: if the distance is larger, the interval is repeated with half its length
# times INITIAL_DISTANCE: closer runs count as equal, as where friction sticks; a new neighbour is drawn
MERGED_DISTANCE = 1e-8


@dataclass(frozen=True, eq=False)
class DifferenceNorm:
    """Measure differences between states of one run in dimensionless form, with scales taken from that run."""

    compiled: CompiledModel
    p: Array  # (n_parameters + n_derived,)
    scales: Array  # (2n,) scales of q and q̇: differences that count as 1
    size: float  # m, of the mechanism
    crossing_time: float  # s, time in which the motion crosses the mechanism's size

    @staticmethod
    def from_run(run: Result, compiled: CompiledModel) -> DifferenceNorm:
        """Build the scales from the parameter values and the rms speeds of a run; a run at rest counts as crossing
        in 1 s.
        """
        length, size = (float(x) for x in compute_error_lengths(compiled, run.p))
        angle = find_angles(compiled.source)
        speeds = np.sqrt(np.mean(np.square(run.v / np.where(angle, 1.0, size)), axis=0))
        crossing = 1.0 / speeds.max(initial=0.0) if speeds.max(initial=0.0) > 0.0 else 1.0
        of_q = np.where(angle, length / size, length)
        return DifferenceNorm(compiled, run.p, np.concatenate([of_q, of_q / crossing]), size, crossing)

    def is_run_too_short(self, run: Result) -> bool:
        """Return whether a run ends before the motion could reverse, so that its Lyapunov exponent has no meaning.

        Such a run has no contact and does not cross the mechanism's size. It ends before its accelerations could stop
        it (rms speed over rms acceleration), or before they change.
        """
        span, q = float(run.t[-1] - run.t[0]), self.scales[: self.n]
        if span >= self.crossing_time or (run.impacts["t_on"] > run.t[0]).any():
            return False
        speed, acceleration, change = (
            float(np.sqrt(np.mean(np.square(x / q)))) for x in (run.v, run.a, run.a - run.a.mean(axis=0))
        )
        return span * acceleration < speed or change <= MAX_CHANGE_AT_REST * acceleration

    @property
    def n(self) -> int:
        """Return the number of coordinates of all bodies."""
        return len(self.scales) // 2

    def compute_norm(self, difference: Array) -> float:
        """Return the scaled Euclidean norm of a difference (2n,) of (q, q̇)."""
        return float(np.linalg.norm(difference / self.scales))

    def project_state(self, t: float, y: Array) -> Array:
        """Project a state y = (q, q̇), (2n,), onto the constraints at time t (s) and return it."""
        n = len(y) // 2
        return np.concatenate(project_state(self.compiled, t, y[:n], y[n:], self.p))

    def draw_neighbour(self, t: float, y: Array) -> Array:
        """Return a neighbour (2n,) of the state y = (q, q̇) at t (s), in a fixed pseudo-random direction.

        It lies at INITIAL_DISTANCE and satisfies the constraints.
        """
        difference = self.scales * np.random.default_rng(SEED).standard_normal(len(y))
        for _ in range(2):  # project onto the constraints, then scale to the length
            difference *= INITIAL_DISTANCE / self.compute_norm(difference)
            difference = self.project_state(t, y + difference) - self.project_state(t, y)
        return y + difference

    def project_on_flow(self, difference: Array, flow: Array) -> float:
        """Return the coefficient of the motion's direction `flow` = (q̇, q̈) in a difference (2n,), 0 without motion.

        The difference less the coefficient times `flow` is perpendicular to `flow` in scaled variables.
        """
        w = self.scales
        length = float(np.sum(np.square(flow / w)))
        return float((difference / w) @ (flow / w)) / length if length > 0.0 else 0.0


def flatten_state(state: State) -> Array:
    """Return the vector (q, q̇), (2n,), of a state."""
    return np.concatenate([state.q, state.v])


def _replace_state_vector(state: State, y: Array, discrete_states: Array) -> State:
    """Return a copy of the state with (q, q̇) replaced by y (2n,), and the discrete states by `discrete_states`."""
    n = len(state.q)
    return replace(state, q=y[:n].copy(), v=y[n:].copy(), memory=discrete_states)


def _have_equal_modes(first: State, second: State) -> bool:
    """Return whether two states have the same closed contacts and the same sticking frictions."""
    clearances = len(first.state)
    modes = (first.memory[clearances:], second.memory[clearances:])
    closed = np.array_equal(first.state > 0, second.state > 0)
    return closed and np.array_equal(np.isnan(modes[0]), np.isnan(modes[1]))


@dataclass(eq=False)
class SecondRun:
    """Integrate a second run next to the first one, whose state is `state`, and measure the growth of their
    distance.
    """

    simulation: Simulation
    norm: DifferenceNorm
    settings: dict[str, Any]
    state: State
    transverse: bool
    growth_error: float = 0.0
    n_coincidences: int = 0  # number of times that both runs became one

    def __post_init__(self) -> None:
        """Draw a neighbour of the current state; store it in `neighbour_state`, and its distance in `distance`.

        Called again after both runs have become equal.
        """
        first = self.norm.draw_neighbour(self.state.t, flatten_state(self.state))
        self.neighbour_state = _replace_state_vector(self.state, first, self.state.memory.copy())
        self.distance = self.norm.compute_norm(first - flatten_state(self.state))

    def advance_to(self, t: float, is_shortest_interval: bool) -> tuple[Result, float] | None:
        """Advance both runs to t (s); return the first run and ln of the growth of their distance.

        Return None, with nothing changed, if the distance changes by more than the factor MAX_GROWTH or exceeds
        MAX_GROWTH INITIAL_DISTANCE, unless `is_shortest_interval`. After merging, a new neighbour is drawn. The
        neighbour is scaled back if both have the same modes. Raises the error of a failed run, and KeyboardInterrupt.
        """
        begin = [self.state, self.neighbour_state]
        batch = self.simulation.simulate_many(
            [{}, {}], output=[t], start=begin, stop=False, peaks=(), side_by_side=False, **self.settings
        )
        if batch.failures:
            raise batch.failures[0].error
        if any(run.diagnostics.interrupted for run in (batch[0], batch[1])):
            raise KeyboardInterrupt
        run, neighbour = batch[0], batch[1].final
        difference = flatten_state(neighbour) - flatten_state(run.final)
        if self.transverse:
            flow = np.concatenate([run.v[-1], run.a[-1]])
            difference -= self.norm.project_on_flow(difference, flow) * flow
        distance = self.norm.compute_norm(difference)
        if distance <= MERGED_DISTANCE * INITIAL_DISTANCE:
            log_growth = math.log(MERGED_DISTANCE * INITIAL_DISTANCE / self.distance)
            self.state, self.n_coincidences = run.final, self.n_coincidences + 1
            self.__post_init__()
            return run, log_growth
        is_too_far = (
            not 1.0 / MAX_GROWTH < distance / self.distance < MAX_GROWTH or distance > MAX_GROWTH * INITIAL_DISTANCE
        )
        if is_too_far and not is_shortest_interval:
            return None
        log_growth = math.log(distance / self.distance)
        self.state, self.neighbour_state, self.distance = run.final, neighbour, distance
        if _have_equal_modes(run.final, neighbour):
            self._rescale_neighbour(difference)
        return run, log_growth

    def _rescale_neighbour(self, difference: Array) -> None:
        """Move `neighbour_state` to INITIAL_DISTANCE from the first state, along the current `difference` (2n,).

        Internal states are scaled alike, and the new state is projected onto the constraints.
        """
        s, y = INITIAL_DISTANCE / self.distance, flatten_state(self.state)
        neighbour = self.norm.project_state(self.state.t, y + s * difference)
        discrete_states = self.state.memory + s * (self.neighbour_state.memory - self.state.memory)
        self.neighbour_state = _replace_state_vector(self.neighbour_state, neighbour, discrete_states)
        self.distance = self.norm.compute_norm(neighbour - y)

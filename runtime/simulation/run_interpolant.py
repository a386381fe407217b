"""Interpolate a run between the states of its steps: evaluate any series at those states and between neighbours."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial.legendre import legder, legfit, leggauss, legint, legval, legvander
from numpy.typing import NDArray

from gudgeon.contract.boundary import N_WORK
from gudgeon.contract.methods import KINEMATIC
from gudgeon.errors import SolverError
from gudgeon.integrators.kinematic import compute_motion_at
from gudgeon.integrators.steps import Steps
from gudgeon.integrators.trajectory import IMPACT_DTYPE
from gudgeon.model.compiled import Array, CompiledModel, Evaluation
from gudgeon.model.evaluation import FIELD_NAMES, compute_rounding_distance
from gudgeon.results.batch import depends_on_works, find_evaluation_fields
from gudgeon.results.diagnostics import Diagnostics
from gudgeon.results.results import Result
from gudgeon.results.series import get_catalogue

NODES = 0.5 * (leggauss(6)[0] + 1.0)  # fractions of an interval between two states at which powers are evaluated
# fraction of an interval: no multiple of it is near the period of a force that a step could hide
INNER_FRACTION = 0.381966
MAX_CACHED = 256  # largest number of evaluated places that are cached for the next series
# of the speed: in shorter intervals, differences of positions are too rounded to check the speed
MAX_SPEED_ERROR = 1e-7
MAX_MOTION_AT_REST = 1e-9  # of the positions: a block that moves by less is at rest
# of the largest acceleration: interpolated states whose accelerations err by more are left out
MAX_ACCELERATION_ERROR = 1e-3
# diagnostics of a block of states, in which nothing is known
UNKNOWN_DIAGNOSTICS = Diagnostics(
    method="",
    step=math.nan,
    steps=0,
    right_hand_sides=0,
    onsets=0,
    phi_max=math.nan,
    phi_dot_max=math.nan,
    energy_residual=math.nan,
    energy_turned_over=math.nan,
    ratio_min=math.nan,
    ratio_max=math.nan,
    ratio_outside=0,
    peaks=(),
    seconds=math.nan,
    seconds_per_simulated_second=math.nan,
)


class _RatePolynomial(NamedTuple):
    """Represent a polynomial of q̇ in Legendre form, with its integral over s = (t − middle)/half_width."""

    error: float  # estimate
    middle: float  # s
    half_width: float  # s
    coefficients: Any  # (n_coefficients, n)
    integral: Any  # (n_coefficients + 1, n)


class RunInterpolant:
    """Hold the current block of a run's states, and evaluate series at and between them.

    Two states of the previous block precede it. `names`: the only series that will be evaluated; None: any.
    `parameter_arrays`: parameter values, given values and their mask, as in a Result.
    """

    def __init__(
        self, compiled: CompiledModel, parameter_arrays: tuple[Array, Array, Array], names: Iterable[str] | None = None
    ) -> None:
        self.compiled, self.source = compiled, compiled.source
        self.p, self.given, self.is_given = parameter_arrays  # as in a Result
        self.catalogue = get_catalogue(self.source)
        requested = self.catalogue.keys() if names is None else [name for name in names if name in self.catalogue]
        self.evaluation_fields = (
            FIELD_NAMES if names is None else find_evaluation_fields(self.source, requested) | {"a"}
        )
        self.needs_works = any(depends_on_works(self.source, name) for name in requested)
        self.is_kinematic = self.source.methods == (KINEMATIC,)
        self.has_films = any(joint.film for joint in self.source.clearances)
        self.has_elastic_contact = any(joint.joint not in self.source.rigid_joints for joint in self.source.clearances)
        self.first: Steps | None = None  # first state of the run: energies count from it
        self.n_without_accelerations = 0  # number of states without accelerations
        self.cached: dict[tuple[int, int, float, float], tuple[Result, Array]] = {}  # cached evaluations between states
        # k, polynomial of the rates between states k and k + 1, and its integral
        self.rates_cache: tuple[int, Any] = (-1, None)
        self.works_cache: tuple[int, Any] = (-1, None)  # k, integral of the powers between states k and k + 1
        self.inner_cache: Result | None = None  # run evaluated at INNER_FRACTION of every interval
        self.steps: Steps
        self.run: Result
        self.is_within_step: NDArray[np.bool_]  # (K − 1,) whether k and k + 1 are the ends of a part of a step

    def load_states(self, steps: Steps) -> None:
        """Replace the block by the next states of the run, and evaluate the equations at them.

        The last two states of the old block stay in front. Cached evaluations are dropped. States without accelerations
        are counted in `n_without_accelerations`.
        """
        self.first = steps[:1] if self.first is None else self.first
        self.steps = self.steps[-2:].concatenate(steps) if hasattr(self, "steps") else steps
        self.run, has_accelerations = self._build_evaluated_result(self.steps)
        self.rates_cache, self.works_cache, self.cached, self.inner_cache = (-1, None), (-1, None), {}, None
        self.n_without_accelerations += int((~has_accelerations[len(has_accelerations) - len(steps) :]).sum())
        self.is_within_step = ~self.steps.is_after_jump[1:] & (
            np.diff(self.steps.t) > (0.0 if self.is_kinematic else _compute_shortest_interval(self.steps))
        )

    def evaluate_series_at_states(self, name: str) -> Array:
        """Return a series at the states of the block, (K,); NaN where the equations cannot be solved."""
        return self.run[name][1:]

    def evaluate_series_between_states(self, k: int, t: Array, name: str) -> Array:
        """Return a series at times t (T,) between states k and k + 1; NaN where the interpolation is too inaccurate.

        The evaluated states are cached for the next series, MAX_CACHED of them at most.
        """
        key = (k, len(t), float(t[0]), float(t[-1]))
        if key not in self.cached:
            if len(self.cached) >= MAX_CACHED:
                self.cached.clear()
            result = self._build_evaluated_result(self._interpolate_states(k, t))[0]
            self.cached[key] = (
                result,
                self._compute_interpolation_error(k, t, result.a[1:]) if self.has_elastic_contact else np.zeros(len(t)),
            )
        result, errors = self.cached[key]
        return np.where(errors <= MAX_ACCELERATION_ERROR, result[name][1:], np.nan)

    def evaluate_series_at_inner_fraction(self, name: str) -> Array:
        """Return a series at the fraction INNER_FRACTION of each interval between successive states, (K − 1,).

        The value is NaN across jumps and where it is unknown. The motion there is Hermite's polynomial of order 5
        through positions, velocities and accelerations. Its evaluation is cached for the block.
        """
        if self.inner_cache is None:
            steps, a, s = self.steps, self.run.a[1:], INNER_FRACTION
            h, q = np.diff(steps.t)[:, None], np.diff(steps.q, axis=0)
            r0, r1, c0, c1 = h * steps.v[:-1], h * steps.v[1:], h**2 * a[:-1], h**2 * a[1:]
            with np.errstate(invalid="ignore", divide="ignore"):
                remainders = q - r0 - 0.5 * c0, r1 - r0 - c0, c1 - c0  # what the powers 3 to 5 add at the end
                third = 10.0 * remainders[0] - 4.0 * remainders[1] + 0.5 * remainders[2]
                fourth = -15.0 * remainders[0] + 7.0 * remainders[1] - remainders[2]
                fifth = 6.0 * remainders[0] - 3.0 * remainders[1] + 0.5 * remainders[2]
                q_inside = steps.q[:-1] + s * (r0 + s * (0.5 * c0 + s * (third + s * (fourth + s * fifth))))
                v_inside = (r0 + s * (c0 + s * (3.0 * third + s * (4.0 * fourth + s * 5.0 * fifth)))) / h
            q_inside[~self.is_within_step] = v_inside[~self.is_within_step] = np.nan
            t, works = steps.t[:-1] + s * h[:, 0], np.full((len(h), N_WORK), np.nan)
            self.inner_cache = self._build_evaluated_result(
                Steps(t, q_inside, v_inside, works, steps.memory[:-1], steps.state[:-1], steps.is_after_jump[:-1])
            )[0]
        return self.inner_cache[name][1:]

    def _compute_interpolation_error(self, k: int, t: Array, a: Array) -> Array:
        """Return the relative error (T,) of the accelerations a (T, n) against those of the interpolant at times t.

        The interval is that after state k. The error is relative to the largest acceleration of its kind (lengths or
        angles). The forces of films and of stiff friction depend steeply on the speed. Interpolated speeds within the
        tolerance may therefore give wrong forces.
        """
        rates = self._interpolate_rates(k)
        nodes = (t - rates.middle) / rates.half_width
        slopes = legval(nodes, legder(rates.coefficients)).T / rates.half_width
        differences = np.abs(a - slopes).reshape(len(t), -1, 3)
        largest = np.abs(self.run.a[1:][k : k + 2]).reshape(2, -1, 3)
        errors = [
            differences[..., kind].max(axis=(1, 2)) / largest[..., kind].max(initial=1e-300) for kind in ([0, 1], [2])
        ]
        return np.maximum(*errors)

    def _build_evaluated_result(self, steps: Steps) -> tuple[Result, NDArray[np.bool_]]:
        """Return a Result of the run's first state and the states `steps`, and a mask of those with accelerations.

        The Result has evaluated equations, no impacts and empty diagnostics. Series count energies from the first
        state.
        """
        assert self.first is not None
        states = self.first.concatenate(steps)
        evaluation, has_accelerations = self._evaluate_states(states)
        run = Result(
            compiled=self.compiled,
            source=self.source,
            p=self.p,
            given=self.given,
            is_given=self.is_given,
            t=states.t,
            q=states.q,
            v=states.v,
            accelerations=evaluation.a,
            state=states.state,
            memory=states.memory,
            work=states.work,
            impacts=np.zeros(0, IMPACT_DTYPE),
            diagnostics=UNKNOWN_DIAGNOSTICS,
        )
        run.__dict__.update(evaluation=evaluation, _catalogue=self.catalogue)
        return run, has_accelerations

    def _evaluate_states(self, steps: Steps) -> tuple[Evaluation, NDArray[np.bool_]]:
        """Return the Evaluation of the equations at K states, and a mask (K,) of the states where they can be solved.

        The Evaluation is NaN at the other states. A state that fails is removed, and the rest is evaluated again.
        """
        is_solvable = np.asarray(np.isfinite(steps.q).all(axis=1) & np.isfinite(steps.v).all(axis=1))
        t = steps.t
        while True:
            try:
                states = (
                    (t, steps.q, steps.v, steps.memory)
                    if is_solvable.all()
                    else (t[is_solvable], steps.q[is_solvable], steps.v[is_solvable], steps.memory[is_solvable])
                )
                evaluation = self.compiled.evaluate(*states, self.p, field_names=self.evaluation_fields)
                break
            except SolverError as error:
                remaining = is_solvable & (np.abs(t - error.time) > 4.0 * compute_rounding_distance(t))
                is_solvable = remaining if (remaining != is_solvable).any() else np.zeros_like(is_solvable)
        if is_solvable.all():
            return evaluation, is_solvable
        columns = {name: np.full((len(steps), *array.shape[1:]), np.nan) for name, array in vars(evaluation).items()}
        for name in self.evaluation_fields:
            columns[name][is_solvable] = getattr(evaluation, name)
        return Evaluation(**columns), is_solvable

    def _interpolate_states(self, k: int, t: Array) -> Steps:
        """Return interpolated states at times t (T,) between states k and k + 1, as Steps for evaluation.

        Contact codes and modes are those of state k, and internal states vary linearly. Works are NaN unless a
        requested series needs them. `is_after_jump` is set in the first half of the interval.
        """
        steps = self.steps
        s = ((t - steps.t[k]) / (steps.t[k + 1] - steps.t[k]))[:, None]
        q, v = self._interpolate_motion(k, t, s)
        discrete_states = np.repeat(steps.memory[k : k + 1], len(t), axis=0)
        states = slice(discrete_states.shape[1] - len(self.source.internal_states), None)
        discrete_states[:, states] += s * (steps.memory[k + 1, states] - steps.memory[k, states])
        codes = np.repeat(steps.state[k : k + 1], len(t), axis=0)
        works = self._interpolate_works(k, s) if self.needs_works else np.full((len(t), N_WORK), np.nan)
        return Steps(t, q, v, works, discrete_states, codes, s[:, 0] < 0.5)

    def _interpolate_motion(self, k: int, t: Array, s: Array) -> tuple[Array, Array]:
        """Return q and q̇ (T, n) at times t and fractions s (T, 1) between states k and k + 1.

        They follow from the interpolating polynomial of q̇, whose integral is corrected linearly to meet state k + 1,
        or from the drives where the scene has no degrees of freedom.
        """
        steps = self.steps
        if self.is_kinematic:
            q, v = compute_motion_at(
                self.compiled, self.p, np.concatenate([steps.t[k : k + 1], t]), steps.q[k], steps.v[k]
            )
            return q[1:], v[1:]
        rates = self._interpolate_rates(k)
        nodes = (np.concatenate([steps.t[k : k + 2], t]) - rates.middle) / rates.half_width
        displacement = rates.half_width * legval(nodes, rates.integral).T
        correction = steps.q[k + 1] - steps.q[k] - (displacement[1] - displacement[0])  # error of the integrated rates
        return steps.q[k] + (displacement[2:] - displacement[0]) + s * correction, legval(
            nodes[2:], rates.coefficients
        ).T

    def _interpolate_rates(self, k: int) -> _RatePolynomial:
        """Return the polynomial of q̇ between states k and k + 1.

        It also passes through neighbouring states where these reduce its estimated error; across a kink of a force they
        do not. The result of the last k is cached.
        """
        if self.rates_cache[0] != k:
            h, max_count = np.diff(self.steps.t), 2 if self.has_films else 1  # neighbours on each side
            before, after = (self._count_neighbours(h, k, direction, max_count) for direction in (-1, 1))
            ranges = {(k - i, k + 2 + j) for i in range(before, -1, -1) for j in range(after, -1, -1)}
            fits = (self._fit_rates(slice(*rows)) for rows in sorted(ranges))
            fit = min(fits, key=lambda fit_of_range: fit_of_range.error)
            self.rates_cache = k, fit._replace(integral=legint(fit.coefficients))
        polynomial: _RatePolynomial = self.rates_cache[1]
        return polynomial

    def _count_neighbours(self, h: Array, k: int, direction: int, max_count: int) -> int:
        """Return how many states before k or after k + 1 the polynomial may pass through, 0 to `max_count`.

        `direction`: −1 before, 1 after. Counting ends at a jump, at an interval more than eight times longer or
        shorter, and at a state without accelerations. `h`: lengths (s) of all intervals.
        """
        a = self.run.a[1:]
        for count in range(max_count):
            j = k + direction * (count + 1)
            if not (0 <= j < len(h) and self.is_within_step[j] and 0.125 < h[j] / h[k] < 8.0):
                return count
            if not np.isfinite(a[j if direction < 0 else j + 1]).all():
                return count
        return max_count

    def _fit_rates(self, state_range: slice) -> _RatePolynomial:
        """Fit the polynomial of q̇ to the states in the slice `state_range` and their accelerations.

        Its error is estimated from the last two coefficients; its integral is left out (None). With films,
        accelerations are not used: they amplify the errors of velocities.
        """
        steps, a = self.steps, self.run.a[1:]
        t, n = steps.t[state_range], len(steps.t[state_range]) * (1 if self.has_films else 2)
        middle, half_width = float(0.5 * (t[0] + t[-1])), float(0.5 * (t[-1] - t[0]))
        s = (t - middle) / half_width
        matrix, values = legvander(s, n - 1), steps.v[state_range]
        if not self.has_films:
            matrix = np.concatenate([matrix, legval(s, _differentiate_legendre(n)).T])
            values = np.concatenate([values, half_width * a[state_range]])
        coefficients = np.linalg.solve(matrix, values)
        last, second_last = np.abs(coefficients[-1]).max(), np.abs(coefficients[-2]).max()
        error = float(last * min(1.0, last / max(second_last, 1e-300)))
        return _RatePolynomial(error, middle, half_width, coefficients, None)

    def _interpolate_works(self, k: int, s: Array) -> Array:
        """Return the works (T, 3) in J at fractions s (T, 1) between states k and k + 1.

        They are the integral of the polynomial through the powers at six Gauss points, corrected linearly so that state
        k + 1 is met. The integral of the last k is cached.
        """
        steps = self.steps
        if self.works_cache[0] != k:
            h = steps.t[k + 1] - steps.t[k]
            t = steps.t[k] + h * NODES
            q, v = self._interpolate_motion(k, t, NODES[:, None])
            power = self.compiled.evaluate(t, q, v, np.repeat(steps.memory[k : k + 1], len(t), axis=0), self.p).power
            self.works_cache = k, legint(legfit(2.0 * NODES - 1.0, 0.5 * h * power, len(NODES) - 1), lbnd=-1.0)
        work = legval(2.0 * s[:, 0] - 1.0, self.works_cache[1]).T
        correction = steps.work[k + 1] - steps.work[k] - legval(1.0, self.works_cache[1])
        corrected_work: Array = steps.work[k] + work + s * correction
        return corrected_work


@cache
def _differentiate_legendre(n: int) -> Any:
    """Return the Legendre coefficients of the derivatives of the first n Legendre polynomials."""
    return legder(np.eye(n))


def _compute_shortest_interval(steps: Steps) -> float:
    """Return the length (s) of the shortest interval in which differences of positions still determine speeds.

    It is 40 ε max|q| / (MAX_SPEED_ERROR max|q̇|), the largest of x, y and angles; 0 at rest. Blocks at rest are not
    limited, though forces may vary there.
    """
    shortest = 0.0
    for kind in (slice(0, None, 3), slice(1, None, 3), slice(2, None, 3)):  # x, y, angles of all bodies
        q, v = (np.abs(values[:, kind][np.isfinite(values[:, kind])]).max(initial=0.0) for values in (steps.q, steps.v))
        if v * float(steps.t[-1] - steps.t[0]) > MAX_MOTION_AT_REST * q:
            shortest = max(shortest, 40.0 * np.finfo(float).eps * float(q) / (MAX_SPEED_ERROR * float(v)))
    return shortest

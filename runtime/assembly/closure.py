"""Close a linkage: find the closed configuration nearest to the guess by Newton's method, from other starts if
needed.

Angles have the largest weights: a step changes guessed angles and points least, then other angles, then positions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.guess_warnings import MIN_DIFFERENCE
from gudgeon.assembly.large import MIN_SPARSE_COORDINATES, solve_damped_least_squares, solve_minimum_norm
from gudgeon.assembly.linkage import Linkage, compute_mechanism_size, compute_point_position, find_angles
from gudgeon.contract.kernel_source import PointInfo
from gudgeon.model.compiled import Array, CompiledModel

MAX_STEPS = 60
# rad: if a guessed angle turns further, or a point moves by MIN_DIFFERENCE, more starts are tried
MAX_GUESS_ERROR_RAD = 0.5
MIN_MIRRORED_ERROR = 0.1  # of these limits: if a guess has a larger error, starts mirrored in the guess are tried
# random starts; coordinates above which a quarter of them is tried; number of searches if all results are far
N_RANDOM_STARTS, MANY_COORDINATES, N_SEARCHES = 24, 60, 5
# of the size that drives and start require, and at least the number of bodies: a body further from the origin is lost
MAX_RELATIVE_DISTANCE = 1e3
CLOSURE_TOL = 1e-10  # a residual above this fraction of the mechanism's size is not an assembly
ROUNDING_TOL = 1e-14  # the same, relative to the largest distance from the origin
# norm below which a Jacobian is reused in the next steps, as long as the norm falls to a tenth (closing.c)
MAX_REUSE_NORM = 1e-6
MIN_RELATIVE_GAIN = 1e-5  # smallest relative difference of distance at which another configuration counts as nearer

# Weights of a coordinate in the norm of a Newton step: a guess is held most firmly.
GUESS_WEIGHT, ANGLE_WEIGHT, POSITION_WEIGHT = 1.0, 1e-2, 1e-4
NO_VALUES: Mapping[str, float] = {}


class AssemblyProblem:
    """Hold the assembly of a linkage: constraint equations (all joints without play), `start.set`, and weights."""

    def __init__(self, linkage: Linkage, p: Array, t: float, held_values: Mapping[str, float] = NO_VALUES) -> None:
        source = linkage.source
        self.linkage, self.p, self.t = linkage, p, t
        self.coordinate_index = {name: k for k, name in enumerate(source.coordinates)}
        guess, file_values, rates = linkage.start_values(p)
        file_values, self.start_eccentricities = (
            file_values[: len(source.start_set)],
            file_values[len(source.start_set) :],
        )
        self.rates, self.start_eccentricity_rates = rates[: len(source.start_rates)], rates[len(source.start_rates) :]
        self.set_values, self.has_held_values = np.array([*file_values, *held_values.values()]), bool(held_values)
        set_names = [*source.start_set, *held_values]
        self.set_indices = [self.coordinate_index[name] for name in set_names]
        self.names = [row.name for row in source.start_equations] + [f"set {name}" for name in set_names]
        self.eccentricity_rows = [self.names.index(name) for name in source.eccentricity_equations]
        self.owners = [row.owner for row in source.start_equations] + ["start"] * len(set_names)
        self.is_angle = find_angles(source)
        self.size = self.max_distance = compute_mechanism_size(linkage, p)
        self.units = [row.unit for row in source.start_equations]
        self.units += ["rad" if self.is_angle[k] else "m" for k in self.set_indices]
        self.row_scale = np.array([self.size if unit == "m" else 1.0 for unit in self.units])
        self.weight = np.where(self.is_angle, ANGLE_WEIGHT, POSITION_WEIGHT / self.size)
        guess_values = dict(zip(source.start_guess, guess.tolist(), strict=True))
        self.guess = {name: value for name, value in guess_values.items() if name in self.coordinate_index}
        self.guessed_indices = [self.coordinate_index[name] for name in self.guess]
        self.is_guessed = np.isin(np.arange(len(source.coordinates)), self.guessed_indices)
        self.guessed_points = [
            (point, np.array([guess_values[f"{point.name}.x"], guess_values[f"{point.name}.y"]]))
            for point in source.points
            if f"{point.name}.x" in guess_values
        ]
        self.first_guess = np.zeros(len(self.coordinate_index))  # set by build_first_guess
        self.weight[self.guessed_indices] = np.where(
            self.is_angle[self.guessed_indices], GUESS_WEIGHT, GUESS_WEIGHT / self.size
        )

    def compute_residual(self, q: Array, p: Array | None = None) -> Array:
        """Return the residuals of all equations (constraint equations, then set coordinates) in m or rad.

        Joints with play are closed, except those with an eccentricity in the file's start: they are held open by it.
        p: other parameter values than those of the problem, or None.
        """
        phi = self.linkage.closed_phi(self.t, q, self.p if p is None else p)
        phi[self.eccentricity_rows] += self.start_eccentricities  # Φ of these joints is −e
        return np.concatenate([phi, q[self.set_indices] - self.set_values])

    def compute_jacobian(self, q: Array, p: Array | None = None) -> Array:
        """Return the Jacobian of the residuals of `compute_residual` with respect to q, (m, n).

        Its rows are those of the constraint equations, then one unit row for each coordinate of `start.set`. p: other
        parameter values than those of the problem, or None.
        """
        extra = np.zeros((len(self.set_indices), len(q)))
        extra[np.arange(len(self.set_indices)), self.set_indices] = 1.0
        return np.concatenate([self.linkage.closed_phi_q(self.t, q, self.p if p is None else p), extra])

    def find_least_squares_configuration(self, q: Array, p: Array) -> Array:
        """Return the configuration of least squared residuals for parameter values p, by Levenberg–Marquardt from q."""
        return self._minimize_residual(
            q,
            lambda x: self.compute_residual(x, p) / self.row_scale,
            lambda x: self.compute_jacobian(x, p) / self.row_scale[:, None],
        )

    def compute_norm(self, q: Array) -> float:
        """Return the norm of the residuals, with lengths relative to the mechanism's size."""
        return float(np.linalg.norm(self._compute_scaled_residual(q)))

    def _compute_scaled_residual(self, q: Array) -> Array:
        """Return the residuals without units: lengths are divided by the mechanism's size."""
        return self.compute_residual(q) / self.row_scale

    def _compute_newton_step(
        self, q: Array, scaled_residual: Array, columns: NDArray[np.bool_] | slice = slice(None)
    ) -> Array:
        """Return the Newton step (n,) of least weighted norm for the equations linearized at q, with these residuals.

        columns: mask of the coordinates that may change. The step is 0 if a number is not finite; with dependent
        equations it is a least-squares step.
        """
        weight = self.weight[columns]
        matrix = self.compute_jacobian(q)[:, columns] / self.row_scale[:, None] / weight
        target, step = -scaled_residual, np.zeros_like(q)
        if np.isfinite(matrix).all() and np.isfinite(target).all():  # a driven distance has no direction at zero
            use_nearest_step = len(self.coordinate_index) >= MIN_SPARSE_COORDINATES and len(matrix) > matrix.shape[1]
            step[columns] = (solve_damped_least_squares if use_nearest_step else solve_minimum_norm)(
                matrix, target
            ) / weight
        return step

    def build_first_guess(self) -> Array:
        """Return the guessed configuration (n,), from which Newton's method starts.

        Guessed coordinates and those of `start.set` have the file's values. Angles follow where equations that contain
        angles alone determine them. Other coordinates are 0. With guessed points, the configuration is fitted to them.
        Sets `first_guess` (before the fit) and `max_distance`.
        """
        q = np.zeros(len(self.coordinate_index))
        q[self.guessed_indices] = list(self.guess.values())
        q[self.set_indices] = self.set_values
        self.first_guess = q = self.determine_angles(q)
        self.max_distance = self._compute_max_distance(q)
        return self._fit_guessed_points(q) if self.guessed_points else q

    def find_nearest_configuration(self) -> tuple[Array, bool]:
        """Return the closed configuration nearest to the guess and True; or that of least residual and False.

        Newton's result may not be the nearest. If it is far from the guess, a start mirrored in the guess is tried. If
        all results are far from the guess or not closed, random starts are tried. True is returned also if all closed
        results are far from the guess. The guess and False are returned if no result has its bodies in range.
        """
        guess = self.build_first_guess()
        first_result = self.solve_newton(guess)
        if self._is_assembly(first_result) and self._compute_relative_guess_error(first_result) < 1.0:
            best = self._search_mirrored_starts(first_result, guess)
            if self._compute_relative_guess_error(best) < 1.0:
                return best, True
        results = [first_result]
        for spread in (1.0, np.pi) if self.guess else (np.pi,):
            results += [self.close(other) for other in self._draw_random_starts(guess, spread)]
            near_results = [q for q in results if self.has_bodies_in_range(q)]
            closed_results = [self.unwind_angles(q) for q in near_results if self.is_closed(q)]
            if (
                closed_results
                and self._compute_relative_guess_error(best := min(closed_results, key=self.compute_distance)) < 1.0
            ):
                return best, True
        if closed_results:  # none is near enough: more starts
            results = [
                self.close(other)
                for seed in range(1, N_SEARCHES)
                for other in self._draw_random_starts(guess, 1.0, seed)
            ]
            more = (self.unwind_angles(q) for q in results if self._is_assembly(q))
            return min([best, *more], key=self.compute_distance), True
        return min(near_results, key=self.compute_norm, default=guess), False

    def _is_assembly(self, q: Array) -> bool:
        """Return whether a configuration is closed with all bodies in range (`is_closed`, `has_bodies_in_range`)."""
        return self.is_closed(q) and self.has_bodies_in_range(q)

    def _search_mirrored_starts(self, closed_configuration: Array, guess: Array) -> Array:
        """Return `closed_configuration`, or one nearer to the guess, found from starts mirrored in the guess.

        Two starts are closed by Newton's method: 2 guess − configuration for the guessed coordinates only, then for
        all. A result replaces the configuration if it is an assembly, and its distance from the guess is smaller by the
        fraction MIN_RELATIVE_GAIN. Nothing is searched if the error of the guess is below MIN_MIRRORED_ERROR of the
        limits for more starts.
        """
        if self._compute_relative_guess_error(closed_configuration) < MIN_MIRRORED_ERROR:
            return closed_configuration
        beyond, mixed = 2.0 * guess - closed_configuration, closed_configuration.copy()
        mixed[self.guessed_indices] = beyond[self.guessed_indices]
        for mirrored in (mixed, beyond):
            mirrored[self.set_indices] = self.set_values
            other = self.close(mirrored)
            if not self._is_assembly(other):
                continue
            other = self.unwind_angles(other)
            if self.compute_distance(other) < (1.0 - MIN_RELATIVE_GAIN) * self.compute_distance(closed_configuration):
                closed_configuration = other
        return closed_configuration

    def compute_distance(self, q: Array) -> float:
        """Return the weighted norm of a configuration's distance from the guess; points count relative to the size.

        With guessed points only guessed coordinates count.
        """
        point_errors = [
            self.compute_point_error(q, point, target) * (GUESS_WEIGHT / self.size)
            for point, target in self.guessed_points
        ]
        is_counted = np.where(self.is_guessed, 1.0, 0.0 if self.guessed_points else 1.0)
        return float(np.linalg.norm(np.concatenate([(q - self.first_guess) * self.weight * is_counted, *point_errors])))

    def compute_point_error(self, q: Array, point: PointInfo, target: Array) -> Array:
        """Return the vector (2,) in m from the guessed position `target` of a point to its position at q."""
        return compute_point_position(self.linkage.source, self.p, q, point) - target

    def _fit_guessed_points(self, q: Array) -> Array:
        """Return the configuration (n,) of least squared residuals, found from q by Levenberg–Marquardt.

        Residuals are those of the equations, and the differences from q in guessed coordinates and from the file's
        positions in guessed points.
        """
        guess_rows = np.diag(self.weight)[self.guessed_indices]

        def compute_residuals(x: Array) -> Array:
            """Return the residuals of equations, guessed coordinates and guessed points."""
            off = [self.compute_point_error(x, point, target) / self.size for point, target in self.guessed_points]
            return np.concatenate([self.compute_residual(x) / self.row_scale, guess_rows @ (x - q), *off])

        def compute_jacobian(x: Array) -> Array:
            """Return the Jacobian of these residuals."""
            rows = self.compute_jacobian(x) / self.row_scale[:, None]
            return np.concatenate([rows, guess_rows, self._compute_guessed_points_jacobian(x) / self.size])

        return self._minimize_residual(q, compute_residuals, compute_jacobian)

    def _minimize_residual(
        self, q: Array, compute_residuals: Callable[[Array], Array], compute_jacobian: Callable[[Array], Array]
    ) -> Array:
        """Return the configuration that minimizes the sum of squares of residuals, by Levenberg–Marquardt steps from q.

        `compute_residuals` and `compute_jacobian` are functions of the configuration (n,). Coordinates are scaled by
        the mechanism's size. The damping falls after a step that reduces the norm and grows after another, which is
        discarded. The last improved configuration is returned after 2 MAX_STEPS steps, or where a value is not finite
        or no further improvement is found.
        """
        damping, residual = 1e-3, compute_residuals(q)
        scale = np.where(self.is_angle, 1.0, self.size)
        for _ in range(2 * MAX_STEPS):
            J = compute_jacobian(q) * scale
            if not (np.isfinite(J).all() and np.isfinite(residual).all()):
                break
            step = scale * np.linalg.solve(J.T @ J + damping * np.eye(len(q)), -J.T @ residual)
            trial = compute_residuals(q + step)
            norm, trial_norm = float(np.linalg.norm(residual)), float(np.linalg.norm(trial))
            if trial_norm < norm:
                q, residual, damping = q + step, trial, max(1e-12, 0.1 * damping)
                if norm - trial_norm < 1e-12 * norm:
                    break
            elif damping < 1e6:
                damping *= 10.0
            else:
                break
        return q

    def _compute_guessed_points_jacobian(self, q: Array) -> Array:
        """Return the Jacobian of the positions (x, y) of the guessed points with respect to q, (2 · points, n)."""
        J, source = np.zeros((2 * len(self.guessed_points), len(q))), self.linkage.source
        for k, (point, _) in enumerate(self.guessed_points):
            i = source.bodies[point.body].index
            arm = compute_point_position(source, self.p, q, point) - q[i : i + 2]
            J[2 * k, i], J[2 * k, i + 2], J[2 * k + 1, i + 1], J[2 * k + 1, i + 2] = 1.0, -arm[1], 1.0, arm[0]
        return J

    def _compute_max_distance(self, guess: Array) -> float:
        """Return the largest length (m) in the residuals and positions of the guess; at least the mechanism's size."""
        requested = np.abs(self.compute_residual(guess))[: len(self.linkage.source.start_equations)]
        lengths = [row.unit == "m" for row in self.linkage.source.start_equations]
        return float(
            max(self.size, requested[lengths].max(initial=0.0), np.abs(guess[~self.is_angle]).max(initial=0.0))
        )

    def is_closed(self, q: Array) -> bool:
        """Return whether the norm of the residuals at q is below CLOSURE_TOL plus rounding."""
        return self.compute_norm(q) < CLOSURE_TOL + ROUNDING_TOL * self.max_distance / self.size

    def has_bodies_in_range(self, q: Array) -> bool:
        """Return whether no coordinate x, y at q exceeds MAX_RELATIVE_DISTANCE times `max_distance`.

        Far away, rounding would satisfy every equation. A chain may be as long as all its bodies together.
        """
        limit = max(MAX_RELATIVE_DISTANCE, float(len(self.linkage.source.bodies)))
        return bool(np.abs(q[~self.is_angle]).max(initial=0.0) < limit * self.max_distance)

    def _compute_relative_guess_error(self, q: Array) -> float:
        """Return the largest error of guessed angles, positions and points at q, relative to the limits for more
        starts.

        The limits are MAX_GUESS_ERROR_RAD for angles, and MIN_DIFFERENCE of the mechanism's size for lengths (for
        positions of the distance from the origin, if larger). It is 0 without guesses.
        """
        differences = np.where(self.is_guessed, q - self.first_guess, 0.0)
        position_errors = np.hypot(differences[0::3], differences[1::3]) / np.maximum(
            self.size, np.hypot(self.first_guess[0::3], self.first_guess[1::3])
        )
        point_errors = [
            np.linalg.norm(self.compute_point_error(q, *point)) / (MIN_DIFFERENCE * self.size)
            for point in self.guessed_points
        ]
        return float(
            max(
                [*position_errors / MIN_DIFFERENCE, *np.abs(differences[2::3]) / MAX_GUESS_ERROR_RAD, *point_errors],
                default=0.0,
            )
        )

    def _draw_random_starts(self, guess: Array, angle_range: float, seed: int = 0) -> Iterator[Array]:
        """Yield random starts around the guess, the same in every run; driven and set coordinates keep their values.

        angle_range: largest change of guessed angles, rad. Guessed positions change by at most angle_range/π of the
        mechanism's size, other coordinates by π or by the size. Each start is followed by its mirror image in the axes
        of the bodies, so that a linkage that is turned or mirrored with its guess finds the same assembly. The change
        is needed if every search from the guess ends in a minimum of the residual above zero.
        """
        rng = np.random.default_rng(seed)
        spread = np.where(self.is_angle, np.pi, self.size)
        spread[self.guessed_indices] *= angle_range / np.pi
        body_axes = np.exp(
            1j * np.where(spread[0::3] == spread[1::3], guess[2::3], 0.0)
        )  # deviations of positions are in the axes of their body
        for _ in range((N_RANDOM_STARTS if len(guess) <= MANY_COORDINATES else N_RANDOM_STARTS // 4) // 2):
            deviations = spread * rng.uniform(-1.0, 1.0, len(guess))
            for mirror in (1.0, -1.0):
                position_steps = body_axes * (deviations[0::3] + 1j * mirror * deviations[1::3])
                q = guess.copy()
                q[0::3] += position_steps.real
                q[1::3] += position_steps.imag
                q[2::3] += mirror * deviations[2::3]
                q[self.set_indices] = self.set_values
                yield q

    def unwind_angles(self, q: Array) -> Array:
        """Return q with each angle within half a turn of the guess by whole turns, unless this violates an equation."""
        for k in np.flatnonzero(self.is_angle & (np.abs(q - self.first_guess) > np.pi)):
            reduced = q.copy()
            reduced[k] -= 2.0 * np.pi * np.round((q[k] - self.first_guess[k]) / (2.0 * np.pi))
            q = reduced if self.is_closed(reduced) else q
        return q

    def close(self, q: Array) -> Array:
        """Return the result of Newton's method from q, in which equations of angles alone are solved first.

        By C if the linkage is compiled and has fewer than MIN_SPARSE_COORDINATES coordinates, except for problems with
        held values and dependent equations. The result may not be closed: callers test it.
        """
        closed = None
        if isinstance(self.linkage, CompiledModel) and not self.has_held_values and len(q) < MIN_SPARSE_COORDINATES:
            closed = self.linkage.close_configuration(self.t, self.p, self.size, self.max_distance, q)
        return self.solve_newton(self.determine_angles(q)) if closed is None else closed

    def solve_newton(self, q: Array) -> Array:
        """Return the result of Newton's method with line search from q; q itself if it is closed already.

        The first step changes positions only. A Jacobian is reused while the norm falls to a tenth in each step. It
        ends after MAX_STEPS steps or without a shorter step that reduces the norm. The result may not be closed:
        callers test it.
        """
        scaled_residual, rounding = self._compute_scaled_residual(q), ROUNDING_TOL * self.max_distance / self.size
        if float(np.linalg.norm(scaled_residual)) < rounding:
            return q
        q = q + self._compute_newton_step(q, scaled_residual, ~self.is_angle)
        linearized_at, is_reused, scaled_residual = (
            q,
            False,
            self._compute_scaled_residual(q),
        )  # configuration at which the equations are linearized
        for _ in range(MAX_STEPS):
            step, step_length, norm = (
                self._compute_newton_step(linearized_at, scaled_residual),
                1.0,
                float(np.linalg.norm(scaled_residual)),
            )
            while step_length > (0.5 if is_reused else 1e-4):
                trial = self._compute_scaled_residual(q + step_length * step)
                if float(np.linalg.norm(trial)) < (1.0 - 1e-4 * step_length) * norm:
                    break
                step_length *= 0.5
            else:
                if not is_reused or norm < rounding:
                    break
                linearized_at, is_reused = q, False
                continue
            q, scaled_residual = q + step_length * step, trial
            new_norm = float(np.linalg.norm(scaled_residual))
            is_reused = new_norm < MAX_REUSE_NORM and (new_norm < 0.1 * norm or new_norm < rounding)
            linearized_at = linearized_at if is_reused else q
        return q

    def determine_angles(self, q: Array) -> Array:
        """Return a copy of q in which the equations that contain angles alone are solved for the angles.

        These are equations of drives and sliders. They are linear in the angles: one Newton step of least weighted norm
        solves them. Without such equations the copy is equal to q.
        """
        rows = np.abs(self.compute_jacobian(q)[:, ~self.is_angle]).max(axis=1, initial=0.0) == 0.0
        matrix = self.compute_jacobian(q)[rows][:, self.is_angle] / self.weight[self.is_angle]
        q = q.copy()
        if rows.any():
            solution = solve_minimum_norm(matrix, -self.compute_residual(q)[rows])
            q[self.is_angle] += solution / self.weight[self.is_angle]
        return q

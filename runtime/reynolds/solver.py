"""Solve Reynolds' equation for one state of a film: check arguments, refine the grid, return forces and their error."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_instance, check_number
from gudgeon.reynolds.bearing import (
    CAVITATIONS,
    ENDS,
    Bearing,
    Film,
    check_cells,
    check_choice,
    check_eccentricity,
    check_finite,
    check_vector,
)
from gudgeon.reynolds.cavitation import Flags, Motion, Pressure, solve_pressure
from gudgeon.reynolds.equation import FULL_TURN, Array, Equation, Grid, make_grid

DEFAULT_CELLS = (192, 24)  # around, from the middle to an end
MAX_COARSE_CELLS = 64  # cells around, up to which the active-set iteration needs no initial guess
WIDEST_GAP = "widest"  # value of the argument groove
Groove = float | str | None


def solve(
    bearing: Bearing,
    eccentricity: ArrayLike,
    rate: ArrayLike = (0.0, 0.0),
    *,
    omega_journal: float = 0.0,
    omega_bearing: float = 0.0,
    cavitation: str = "reynolds",
    ends: str = "open",
    groove: Groove = None,
    cells: tuple[int, int] = DEFAULT_CELLS,
) -> Film:
    """Solve the film between a journal and its bearing: pressure, forces, torques, leakage, error of the forces.

    eccentricity: (2,) of the journal's centre from the bearing's, m, |e| < c. rate: (2,) its rate, m/s. Both rates of
    rotation in rad/s, in one frame with the rate: only ω_i + ω_j − 2ψ̇ and ε̇ make pressure.
    cavitation: half_sommerfeld, reynolds or elrod_adams (cavitation.py defines them). elrod_adams is quasi-static:
    θ does not change in time in the frame of the line of centres. That is exact in a steady state and in whirl, and
    an approximation where ε̇ ≠ 0; it needs ω_s ≠ 0.
    ends: open, p = 0 there; sealed, nothing leaves: the equation of an infinitely long bearing, the forces of this
    length.
    groove: p = 0 along an axial line in this direction from the bearing's centre (rad), or "widest": where the gap is
    widest, as textbooks begin their films. None: no groove; if the source of oil must be defined (sealed,
    elrod_adams), "widest".
    cells: around and from the middle to an end, multiples of 4. They gather where the film is thin and at the ends.

    Raises BadValueError for invalid arguments, GudgeonError if an active set does not converge.
    """
    check_instance(bearing, "bearing", Bearing)
    check_choice(cavitation, "cavitation", CAVITATIONS)
    sealed = check_choice(ends, "ends", ENDS) == "sealed"
    around, axial = check_cells(cells, sealed)
    e, v = np.array(check_vector(eccentricity, "eccentricity")), np.array(check_vector(rate, "rate"))
    speeds = check_number(omega_journal, "omega_journal"), check_number(omega_bearing, "omega_bearing")
    distance = math.hypot(*e)
    check_eccentricity(distance / bearing.clearance)
    n = _find_line_of_centres(e, v)
    t = np.array([-n[1], n[0]])
    omega_s = sum(speeds) - (2.0 * float(v @ t) / distance if distance > 0.0 else 0.0)
    eps, c = distance / bearing.clearance, bearing.clearance
    motion = Motion(float(v @ n) / c, (float(v @ t) - 0.5 * sum(speeds) * distance) / c, 0.5 * omega_s)
    groove_angle = _find_groove_angle(groove, n, sealed, cavitation)
    problem = Problem(eps, bearing.l_over_d, sealed, cavitation, groove_angle, motion)
    with np.errstate(over="ignore", invalid="ignore"):
        coarse, fine = solve_on_two_grids(problem, around, axial)
        film = _build_film(bearing, ends, e, n, omega_s, speeds[0] - speeds[1], fine, coarse)
    check_finite(film.force, film.pressure)
    return film


def _find_line_of_centres(eccentricity: Array, velocity: Array) -> Array:
    """Return the unit vector (2,) of the line of centres; of the velocity if e = 0, else (1, 0)."""
    for vector in (eccentricity, velocity, np.array([1.0, 0.0])):
        if (size := math.hypot(*vector)) > 0.0:
            return np.asarray(vector / size)
    raise AssertionError


def _find_groove_angle(groove: Groove, direction: Array, sealed: bool, cavitation: str) -> float | None:
    """Return the angle φ (rad) of the groove, counted from the widest gap; None without a groove.

    direction: unit vector of the line of centres. A sealed bearing and elrod_adams need a source of oil: without
    `groove` they have one at the widest gap. Raises BadValueError for an invalid `groove`.
    """
    if groove is None:
        return 0.0 if sealed or cavitation == "elrod_adams" else None
    if isinstance(groove, str):
        check_choice(groove, "groove", ("a direction in rad", WIDEST_GAP))
        return 0.0
    phi = check_number(groove, "groove") - math.atan2(-direction[1], -direction[0])
    return math.remainder(phi, FULL_TURN)


@dataclass(frozen=True)
class Problem:
    """Dimensionless film problem; only the rates in `motion` have units (1/s)."""

    eps: float
    l_over_d: float
    sealed: bool
    cavitation: str
    groove: float | None
    motion: Motion

    def __post_init__(self) -> None:
        """Raise BadValueError for elrod_adams without rotation, since no oil is then convected."""
        if self.cavitation == "elrod_adams" and self.motion.half_speed == 0.0:
            raise BadValueError(
                "elrod_adams: no oil is convected for omega_s = 0",
                hint="θ would depend on the history; cavitation='reynolds' does not use θ",
            )


@dataclass(frozen=True)
class Solution:
    """A problem solved on one grid."""

    equation: Equation
    problem: Problem
    pressure: Pressure

    @property
    def grid(self) -> Grid:
        """Return the grid on which the problem was solved."""
        return self.equation.grid

    @cached_property
    def p(self) -> Array:
        """Return the pressure at the nodes (n, m), without the end; with half_sommerfeld it may be negative."""
        return self._reshape_to_grid(self.pressure.unknown)[:, : len(self.grid.zeta)]

    @cached_property
    def end_flow(self) -> Array:
        """Return the flow over one end at each angle (n,), positive outwards; 0 for a sealed bearing."""
        unknowns = self._reshape_to_grid(self.pressure.unknown)
        return np.zeros(len(unknowns)) if self.grid.sealed else unknowns[:, -1]

    @cached_property
    def filled(self) -> Array:
        """Return the filled fraction θ of the gap at the nodes (n, n_rows)."""
        return self._reshape_to_grid(self.pressure.filled)

    @cached_property
    def force(self) -> Array:
        """Return (F_r, F_t) on the journal of both halves, in units of 12 μ (R/c)² R².

        Only p > 0 contributes. In an interval in which p changes its sign, the trapezoidal rule is corrected to the
        part with p > 0.
        """
        p, grid = self.p, self.grid
        carrying_pressure = np.maximum(p, 0.0)
        after, before = np.roll(p, -1, axis=0), np.roll(p, 1, axis=0)
        for neighbour in (after, before):
            is_end = (p > 0.0) & (neighbour < 0.0)
            carrying_pressure[is_end] += 0.5 * p[is_end] * (p[is_end] / (p[is_end] - neighbour[is_end]) - 1.0)
        load = 2.0 * (carrying_pressure @ grid.weight_along) * grid.weight
        return np.array([load @ np.cos(grid.phi), load @ np.sin(grid.phi)])

    @cached_property
    def flows(self) -> tuple[float, float, float]:
        """Return leakage, supply and stored flow of both halves, in units of c R².

        A sealed bearing has no leakage. The supply is the inflow over the ends, and the outflow minus squeeze flow of
        cells at nodes with p = 0 (elrod_adams: of the groove). Only elrod_adams has a stored flow.
        """
        end_flow, gain = self.end_flow, self._reshape_to_grid(self.pressure.gain)
        outflow, inflow = float(end_flow[end_flow > 0.0].sum()), -float(end_flow[end_flow < 0.0].sum())
        grid = self.grid
        closing = self.equation.compute_squeeze_flow(self.problem.motion.w_n, 0.0).reshape(gain.shape)
        stored = -float((closing * self.filled).sum()) if self.problem.cavitation == "elrod_adams" else 0.0
        has_source = self.pressure.unknown.reshape(gain.shape) == 0.0  # elsewhere the gain is rounding error
        if self.problem.cavitation == "elrod_adams":
            has_source = np.zeros_like(has_source)
            has_source[0] = True
        source = float(gain[has_source].sum())
        if grid.sealed:
            return 0.0, 2.0 * source, 2.0 * stored
        return 2.0 * outflow, 2.0 * (source + inflow), 2.0 * stored

    def _reshape_to_grid(self, values: Array) -> Array:
        """Return values at all unknowns, (n·n_rows,), as an array (n, n_rows)."""
        return values.reshape(len(self.grid.phi), self.equation.n_rows)


def solve_on_two_grids(
    problem: Problem, n_around: int, n_along: int, equations: dict[int, Equation] | None = None
) -> list[Solution]:
    """Return the solutions of a problem on half as many cells in both directions, and on all cells.

    n_around: cells around. n_along: cells from the middle to an end, 0 for a sealed bearing. The active set is
    computed first on coarser grids, down to MAX_COARSE_CELLS, and interpolated. equations: cached equations of this
    eccentricity by number of cells around; new ones are added.
    """
    levels = [(n_around, n_along), (n_around // 2, n_along // 2)]
    while levels[-1][0] > MAX_COARSE_CELLS and not levels[-1][0] % 4 and not levels[-1][1] % 4:
        levels.append((levels[-1][0] // 2, levels[-1][1] // 2))
    equations_by_size = {} if equations is None else equations
    solutions: list[Solution] = []
    for n, m in reversed(levels):
        if n not in equations_by_size:
            equations_by_size[n] = Equation(make_grid(problem.eps, problem.l_over_d, n, m, problem.groove or 0.0))
        equation = equations_by_size[n]
        free_nodes = np.ones((n, equation.n_rows), dtype=bool)
        if problem.groove is not None:
            free_nodes[0] = False
        start = _interpolate_unknowns(solutions[-1]) if solutions else None
        pressure = solve_pressure(problem.cavitation, equation, problem.motion, _flatten_to_vector(free_nodes), start)
        solutions.append(Solution(equation, problem, pressure))
    return solutions[-2:]


def _flatten_to_vector(flags: Flags) -> Flags:
    """Return flags (n, n_rows) as a vector (n·n_rows,), one for each unknown."""
    return np.asarray(flags.ravel())


def _interpolate_unknowns(coarse_solution: Solution) -> Array:
    """Return the unknowns of a coarse solution, interpolated linearly to twice as many cells in both directions.

    Only their signs are used, as the initial active set of the fine grid. At an open end they have the values of the
    neighbouring nodes, since the unknown there is the outflow.
    """
    p = coarse_solution.p
    if not coarse_solution.grid.sealed:
        p = np.concatenate([p, np.zeros((len(p), 1))], axis=1)
    n, m = p.shape
    rows = np.empty((2 * n, m))
    rows[::2], rows[1::2] = p, 0.5 * (p + np.roll(p, -1, axis=0))
    if coarse_solution.grid.sealed:
        return rows.ravel()
    fine = np.empty((2 * n, 2 * m - 1))
    fine[:, ::2], fine[:, 1::2] = rows, 0.5 * (rows[:, :-1] + rows[:, 1:])
    fine[:, -1] = fine[:, -2]  # outflow over the end: positive where the neighbouring node has pressure
    return fine.ravel()


def _build_film(
    bearing: Bearing,
    ends: str,
    e: Array,
    direction: Array,
    omega_s: float,
    slip: float,
    fine_solution: Solution,
    coarse_solution: Solution,
) -> Film:
    """Return the film of the fine solution in SI units and the caller's frame.

    e: eccentricity (2,) in m. direction: unit vector of the line of centres. omega_s, slip: ω_s and ω_i − ω_j in
    rad/s. Its error is the difference of the forces of both solutions.
    """
    grid, problem = fine_solution.grid, fine_solution.problem
    pressure_unit, c, widest = bearing.pressure_unit, bearing.clearance, math.atan2(-direction[1], -direction[0])
    radial, tangential = (pressure_unit * bearing.radius**2 * fine_solution.force).tolist()
    p = pressure_unit * np.maximum(fine_solution.p, 0.0)
    filled = fine_solution.filled
    if not grid.sealed:
        p = np.concatenate([p, np.zeros((len(p), 1))], axis=1)
    zeta = np.array([0.0, problem.l_over_d]) if grid.sealed else np.append(grid.zeta, problem.l_over_d)
    if grid.sealed:
        p, filled = np.repeat(p, 2, axis=1), np.repeat(filled, 2, axis=1)
    drag = 2.0 * float(((fine_solution.filled @ grid.height) / grid.h) @ grid.weight)
    drag *= bearing.viscosity * bearing.radius**4 / c * slip
    eccentric_torque = 0.5 * math.hypot(*e) * tangential
    leakage, supply, stored = (c * bearing.radius**2 * flow for flow in fine_solution.flows)
    return Film(
        bearing,
        problem.cavitation,
        ends,
        (float(e[0]), float(e[1])),
        omega_s,
        None if problem.groove is None else widest + problem.groove,
        grid.phi + widest,
        bearing.radius * np.concatenate([-zeta[:0:-1], zeta]),
        c * grid.h,
        _mirror_half(p),
        _mirror_half(filled),
        radial * direction + tangential * np.array([-direction[1], direction[0]]),
        radial,
        tangential,
        pressure_unit * bearing.radius**2 * float(np.hypot(*(fine_solution.force - coarse_solution.force))),
        -drag - eccentric_torque,
        drag - eccentric_torque,
        leakage,
        supply,
        stored,
        supply - leakage - stored,
        _find_pressure_extent(p[:, 0], grid.phi + widest),
    )


def _mirror_half(half_values: Array) -> Array:
    """Return the values along the whole bearing, (n, 2m − 1), from those of the half from the middle to an end, (n,
    m).
    """
    return np.concatenate([half_values[:, :0:-1], half_values], axis=1)


def _find_pressure_extent(p: Array, angle: Array) -> tuple[float, float] | None:
    """Return the angles (rad, rising) of the first and last node of the pressure region that contains the maximum.

    None if all nodes or no nodes have pressure. p, angle: (n,) around the bearing.
    """
    has_pressure, peak, n = p > 0.0, int(np.argmax(p)), len(p)
    if has_pressure.all() or not has_pressure.any():
        return None
    first = next(k for k in range(n) if not has_pressure[peak - k - 1])
    last = next(k for k in range(n) if not has_pressure[(peak + k + 1) % n])
    begins, ends = float(angle[peak - first]), float(angle[(peak + last) % n])
    return begins, ends + (FULL_TURN if ends < begins else 0.0)

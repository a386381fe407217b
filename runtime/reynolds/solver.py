"""Solve the film of one state: check arguments, refine the grid, return forces, flows and their error."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import instance, number_of
from gudgeon.reynolds.bearing import (
    CAVITATIONS,
    ENDS,
    Bearing,
    Film,
    cells_of,
    check_eccentricity,
    check_finite,
    choice,
    pair,
)
from gudgeon.reynolds.cavitation import Flags, Motion, Pressure, solve_pressure
from gudgeon.reynolds.equation import TURN, Array, Equation, Grid, make_grid

CELLS = (192, 24)  # around, from the middle to an end
COARSEST = 64  # cells around, up to which the active set needs no start
WIDEST = "widest"
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
    cells: tuple[int, int] = CELLS,
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
    instance(bearing, "bearing", Bearing)
    choice(cavitation, "cavitation", CAVITATIONS)
    sealed = choice(ends, "ends", ENDS) == "sealed"
    around, along = cells_of(cells, sealed)
    e, v = np.array(pair(eccentricity, "eccentricity")), np.array(pair(rate, "rate"))
    turning = number_of(omega_journal, "omega_journal"), number_of(omega_bearing, "omega_bearing")
    size = math.hypot(*e)
    check_eccentricity(size / bearing.clearance)
    n = _centre_direction(e, v)
    t = np.array([-n[1], n[0]])
    omega_s = sum(turning) - (2.0 * float(v @ t) / size if size > 0.0 else 0.0)
    eps, c = size / bearing.clearance, bearing.clearance
    motion = Motion(float(v @ n) / c, (float(v @ t) - 0.5 * sum(turning) * size) / c, 0.5 * omega_s)
    at = _groove_angle(groove, n, sealed, cavitation)
    problem = Problem(eps, bearing.l_over_d, sealed, cavitation, at, motion)
    with np.errstate(over="ignore", invalid="ignore"):
        coarse, fine = solve_refined(problem, around, along)
        film = _make_film(bearing, ends, e, n, omega_s, turning[0] - turning[1], fine, coarse)
    check_finite(film.force, film.pressure)
    return film


def _centre_direction(e: Array, v: Array) -> Array:
    """Return the unit vector of the line of centres, or of the motion if the centres coincide."""
    for vector in (e, v, np.array([1.0, 0.0])):
        if (size := math.hypot(*vector)) > 0.0:
            return np.asarray(vector / size)
    raise AssertionError


def _groove_angle(groove: Groove, n: Array, sealed: bool, cavitation: str) -> float | None:
    """Return the angle φ of the groove, counted from the widest gap, or None."""
    if groove is None:
        return 0.0 if sealed or cavitation == "elrod_adams" else None
    if isinstance(groove, str):
        choice(groove, "groove", ("a direction in rad", WIDEST))
        return 0.0
    phi = number_of(groove, "groove") - math.atan2(-n[1], -n[0])
    return math.remainder(phi, TURN)


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
        """Raise BadValueError for elrod_adams without rotation."""
        if self.cavitation == "elrod_adams" and self.motion.half_speed == 0.0:
            raise BadValueError(
                "elrod_adams: nothing carries the oil round, for omega_s = 0",
                hint="θ would hang on what was before; cavitation='reynolds' does not know θ",
            )


@dataclass(frozen=True)
class Solution:
    """A problem solved on one grid."""

    equation: Equation
    problem: Problem
    pressure: Pressure

    @property
    def grid(self) -> Grid:
        """Return the grid."""
        return self.equation.grid

    @cached_property
    def p(self) -> Array:
        """Return the pressure (n, m), signed."""
        return self._as_grid(self.pressure.unknown)[:, : len(self.grid.zeta)]

    @cached_property
    def over_the_end(self) -> Array:
        """Return the flow over one end at each angle (n,), positive outwards."""
        shown = self._as_grid(self.pressure.unknown)
        return np.zeros(len(shown)) if self.grid.sealed else shown[:, -1]

    @cached_property
    def filled(self) -> Array:
        """Return the filled fraction θ (n, rows)."""
        return self._as_grid(self.pressure.filled)

    @cached_property
    def force(self) -> Array:
        """Return (F_r, F_t) in units of 12 μ (R/c)² R².

        The trapezoidal rule counts a half of the interval in which p changes its sign. The correction takes the part
        with p > 0 instead.
        """
        p, grid = self.p, self.grid
        share = np.maximum(p, 0.0)
        after, before = np.roll(p, -1, axis=0), np.roll(p, 1, axis=0)
        for other in (after, before):
            ends = (p > 0.0) & (other < 0.0)
            share[ends] += 0.5 * p[ends] * (p[ends] / (p[ends] - other[ends]) - 1.0)
        load = 2.0 * (share @ grid.weight_along) * grid.weight
        return np.array([load @ np.cos(grid.phi), load @ np.sin(grid.phi)])

    @cached_property
    def flows(self) -> tuple[float, float, float]:
        """Return leakage, supply and stored flow of both halves, in units of c R²."""
        end, gain = self.over_the_end, self._as_grid(self.pressure.gain)
        out, back = float(end[end > 0.0].sum()), -float(end[end < 0.0].sum())
        grid = self.grid
        closing = self.equation.closing(self.problem.motion.w_n, 0.0).reshape(gain.shape)
        used = -float((closing * self.filled).sum()) if self.problem.cavitation == "elrod_adams" else 0.0
        held = self.pressure.unknown.reshape(gain.shape) == 0.0  # where the equation holds the gain is rounding
        if self.problem.cavitation == "elrod_adams":
            held = np.zeros_like(held)
            held[0] = True
        source = float(gain[held].sum())
        if grid.sealed:
            return 0.0, 2.0 * source, 2.0 * used
        return 2.0 * out, 2.0 * (source + back), 2.0 * used

    def _as_grid(self, values: Array) -> Array:
        """Return the unknowns as an array (n, rows)."""
        return values.reshape(len(self.grid.phi), self.equation.rows)


def solve_refined(
    problem: Problem, around: int, along: int, equations: dict[int, Equation] | None = None
) -> list[Solution]:
    """Solve on half as many cells in both directions, and on all; return both solutions.

    Each grid starts from the active set of the coarser one. equations: cached equations of this eccentricity by number
    of cells around; new ones are added.
    """
    levels = [(around, along), (around // 2, along // 2)]
    while levels[-1][0] > COARSEST and not levels[-1][0] % 4 and not levels[-1][1] % 4:
        levels.append((levels[-1][0] // 2, levels[-1][1] // 2))
    known = {} if equations is None else equations
    found: list[Solution] = []
    for n, m in reversed(levels):
        if n not in known:
            known[n] = Equation(make_grid(problem.eps, problem.l_over_d, n, m, problem.groove or 0.0))
        equation = known[n]
        free = np.ones((n, equation.rows), dtype=bool)
        if problem.groove is not None:
            free[0] = False
        start = _interpolate_unknowns(found[-1]) if found else None
        pressure = solve_pressure(problem.cavitation, equation, problem.motion, _as_vector(free), start)
        found.append(Solution(equation, problem, pressure))
    return found[-2:]


def _as_vector(flags: Flags) -> Flags:
    """Return the flags as a vector."""
    return np.asarray(flags.ravel())


def _interpolate_unknowns(coarse: Solution) -> Array:
    """Return the unknowns, interpolated linearly to twice as many cells; only their signs are used."""
    p = coarse.p
    if not coarse.grid.sealed:
        p = np.concatenate([p, np.zeros((len(p), 1))], axis=1)
    n, m = p.shape
    rows = np.empty((2 * n, m))
    rows[::2], rows[1::2] = p, 0.5 * (p + np.roll(p, -1, axis=0))
    if coarse.grid.sealed:
        return rows.ravel()
    fine = np.empty((2 * n, 2 * m - 1))
    fine[:, ::2], fine[:, 1::2] = rows, 0.5 * (rows[:, :-1] + rows[:, 1:])
    fine[:, -1] = fine[:, -2]  # oil leaves over the end where there is pressure next to it
    return fine.ravel()


def _make_film(
    bearing: Bearing, ends: str, e: Array, n: Array, omega_s: float, slip: float, fine: Solution, coarse: Solution
) -> Film:
    """Return the film in SI units from the solutions on both grids.

    e: eccentricity in m. n: direction of the line of centres. slip: ω_i − ω_j in rad/s.
    """
    grid, problem = fine.grid, fine.problem
    unit, c, widest = bearing.pressure_unit, bearing.clearance, math.atan2(-n[1], -n[0])
    radial, tangential = (unit * bearing.radius**2 * fine.force).tolist()
    p = unit * np.maximum(fine.p, 0.0)
    filled = fine.filled
    if not grid.sealed:
        p = np.concatenate([p, np.zeros((len(p), 1))], axis=1)
    zeta = np.array([0.0, problem.l_over_d]) if grid.sealed else np.append(grid.zeta, problem.l_over_d)
    if grid.sealed:
        p, filled = np.repeat(p, 2, axis=1), np.repeat(filled, 2, axis=1)
    drag = 2.0 * float(((fine.filled @ grid.height) / grid.h) @ grid.weight)
    drag *= bearing.viscosity * bearing.radius**4 / c * slip
    turn = 0.5 * math.hypot(*e) * tangential
    leakage, supply, used = (c * bearing.radius**2 * flow for flow in fine.flows)
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
        radial * n + tangential * np.array([-n[1], n[0]]),
        radial,
        tangential,
        unit * bearing.radius**2 * float(np.hypot(*(fine.force - coarse.force))),
        -drag - turn,
        drag - turn,
        leakage,
        supply,
        used,
        supply - leakage - used,
        _pressure_extent(p[:, 0], grid.phi + widest),
    )


def _mirror_half(half: Array) -> Array:
    """Return the values of both halves of the bearing from those of one (n, m)."""
    return np.concatenate([half[:, :0:-1], half], axis=1)


def _pressure_extent(p: Array, angle: Array) -> tuple[float, float] | None:
    """Return the angles of the first and last node of the pressure region with the maximum, rising; None if there is
    none.
    """
    carries, most, n = p > 0.0, int(np.argmax(p)), len(p)
    if carries.all() or not carries.any():
        return None
    first = next(k for k in range(n) if not carries[most - k - 1])
    last = next(k for k in range(n) if not carries[(most + k + 1) % n])
    begins, ends = float(angle[most - first]), float(angle[(most + last) % n])
    return begins, ends + (TURN if ends < begins else 0.0)

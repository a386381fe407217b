"""Compute the forces of many states of one bearing, from which tables of film laws are made."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_instance
from gudgeon.model.arrays import as_c_array
from gudgeon.reynolds.bearing import (
    CAVITATIONS,
    ENDS,
    Bearing,
    check_cells,
    check_choice,
    check_eccentricity,
    check_finite,
)
from gudgeon.reynolds.cavitation import Motion
from gudgeon.reynolds.equation import Array, Equation
from gudgeon.reynolds.solver import DEFAULT_CELLS, WIDEST_GAP, Problem, solve_on_two_grids

MAX_STATES = 1_000_000  # about a day of run time


@dataclass(frozen=True, eq=False)
class Table:
    """Forces of `table`; the arrays have the broadcast shape of the states.

    eps, eps_rate (1/s), omega_s (rad/s): the states. force: (…, 2) F_r along e and F_t along ẑ × e on the journal, N.
    error: of the force as for a film, N.
    """

    eps: Array
    eps_rate: Array
    omega_s: Array
    force: Array
    error: Array

    def __repr__(self) -> str:
        """Return the shape of the states in one line."""
        return f"<Table of the forces at {self.eps.shape} states>"


def table(
    bearing: Bearing,
    eps: ArrayLike,
    eps_rate: ArrayLike = 0.0,
    omega_s: ArrayLike = 0.0,
    *,
    cavitation: str = "reynolds",
    ends: str = "open",
    groove: str | None = None,
    cells: tuple[int, int] = DEFAULT_CELLS,
) -> Table:
    """Return the forces over eccentricity ratio ε in [0, 1), its rate ε̇ (1/s) and ω_s = ω_i + ω_j − 2ψ̇ (rad/s).

    The three arrays are broadcast together. Other arguments are those of `solve`; groove is None or "widest". States of
    equal ε share their grid, and equal states are solved once. Raises as `solve`.
    """
    check_instance(bearing, "bearing", Bearing)
    check_choice(cavitation, "cavitation", CAVITATIONS)
    sealed = check_choice(ends, "ends", ENDS) == "sealed"
    around, axial = check_cells(cells, sealed)
    if groove is not None:
        check_choice(groove, "groove", ("None", WIDEST_GAP))
    states = _broadcast_states(eps, eps_rate, omega_s)
    groove_angle = 0.0 if sealed or groove or cavitation == "elrod_adams" else None
    unique_states, inverse = np.unique(np.stack([x.ravel() for x in states], axis=1), axis=0, return_inverse=True)
    inverse, unit = inverse.reshape(states[0].shape), bearing.pressure_unit * bearing.radius**2
    force, error = np.zeros((len(unique_states), 2)), np.zeros(len(unique_states))
    cached: tuple[float, dict[int, Equation]] = (-1.0, {})
    with np.errstate(over="ignore", invalid="ignore"):
        for k, (e, closing, speed) in enumerate(unique_states.tolist()):
            cached = cached if cached[0] == e else (e, {})
            motion = Motion(closing, -0.5 * e * speed, 0.5 * speed)
            problem = Problem(e, bearing.l_over_d, sealed, cavitation, groove_angle, motion)
            coarse, fine = solve_on_two_grids(problem, around, axial, cached[1])
            force[k], error[k] = unit * fine.force, unit * np.hypot(*(fine.force - coarse.force))
    check_finite(force)
    e_all, closing_all, speed_all = (x.copy() for x in states)
    return Table(e_all, closing_all, speed_all, force[inverse], error[inverse])


def _broadcast_states(eps: ArrayLike, eps_rate: ArrayLike, omega_s: ArrayLike) -> tuple[Array, ...]:
    """Return the three arrays, broadcast to one shape (views).

    Raises BadValueError for values that are not finite, incompatible shapes, more than MAX_STATES states, or ε outside
    [0, 1).
    """
    arguments = ((eps, "eps"), (eps_rate, "eps_rate"), (omega_s, "omega_s"))
    arrays = [as_c_array(x, name, require_finite=True, max_entries=MAX_STATES) for x, name in arguments]
    try:
        count = math.prod(np.broadcast_shapes(*(x.shape for x in arrays)))
    except ValueError:
        shapes = ", ".join(str(x.shape) for x in arrays)
        raise BadValueError(f"eps, eps_rate and omega_s have the shapes {shapes}: they cannot be broadcast") from None
    if count > MAX_STATES:  # before any array of that size is created
        raise BadValueError(f"eps, eps_rate and omega_s are {count} states together: expected at most {MAX_STATES}")
    states = np.broadcast_arrays(*arrays)
    if (states[0] < 0.0).any():
        raise BadValueError(f"eps is {states[0].min():g}: expected 0 or more")
    check_eccentricity(float(states[0].max(initial=0.0)))
    return tuple(states)

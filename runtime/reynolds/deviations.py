"""Compare a film law with Reynolds' equation over eccentricity and over the direction of motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError, MissingKeyError, UnknownKeyError
from gudgeon.language.argument_checks import check_number, check_positive, check_text
from gudgeon.language.names import make_unknown_name_error
from gudgeon.model.arrays import as_c_array
from gudgeon.reynolds.bearing import Bearing, check_finite
from gudgeon.reynolds.equation import Array
from gudgeon.reynolds.solver import DEFAULT_CELLS
from gudgeon.reynolds.tables import table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DEFAULT_EPS = tuple(0.05 * k for k in range(1, 20))
DEFAULT_MOTIONS = tuple(math.pi / 12 * k for k in range(13))
RADIUS, CLEARANCE, VISCOSITY = 0.01, 1e-5, 0.1  # m, m, Pa·s; the deviations do not depend on them
LawForce = Callable[[Array, Array, Array], Array]


@dataclass(frozen=True, eq=False)
class Deviation:
    """Forces of a law and of the solver at n eccentricity ratios and m motions, over μ R³ L/c² at a rate W of 1/s.

    motion: (m,) angle α in rad with ε̇ = W cos α, ½ ε ω_s = W sin α: 0 the gap closes, π/2 the journal turns, π it
    leaves the wall. Both forces are proportional to W; those at −ω_s follow by symmetry. force, law_force:
    (n, m, 2) radial and tangential, by the solver and by the law. error: (n, m) of the solver's.
    """

    law: str
    l_over_d: float
    cavitation: str
    eps: Array
    motion: Array
    force: Array
    law_force: Array
    error: Array

    @property
    def share(self) -> Array:
        """Return the deviation (n, m): |F_law − F| over the largest |F| at that ε."""
        largest = np.hypot(self.force[..., 0], self.force[..., 1]).max(axis=1, keepdims=True)
        difference = self.law_force - self.force
        return np.asarray(np.hypot(difference[..., 0], difference[..., 1]) / largest)

    def __repr__(self) -> str:
        """Return law, L/D, cavitation condition and the largest deviation."""
        worst = f"{self.share.max():.2%} at most"
        return f"<Deviation of {self.law} at L/D = {self.l_over_d:g}, {self.cavitation}: {worst}>"

    def of(self, law: str, **keys: float | str | bool) -> Deviation:
        """Return the deviation of another law, with its other keys, at the same states; the solver's forces are
        reused.
        """
        return replace(self, law=law, law_force=_evaluate_law(law, self.l_over_d, self.eps, self.motion, keys))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the deviation in percent as a map on `ax`, None for new axes, and return the axes; needs matplotlib."""
        from gudgeon.reynolds.plot import draw_deviation_map

        return draw_deviation_map(self, ax)


def deviation(
    law: str,
    l_over_d: float,
    *,
    eps: ArrayLike = DEFAULT_EPS,
    motion: ArrayLike = DEFAULT_MOTIONS,
    cavitation: str = "reynolds",
    groove: str | None = None,
    cells: tuple[int, int] = DEFAULT_CELLS,
    **keys: float | str | bool,
) -> Deviation:
    """Compare a film law (`gudgeon.generator.kinds.laws`, or a registered one) with the solver, and return the
    deviation.

    l_over_d: length over diameter. eps: (n,) in (0, 1). motion: (m,) rad, see Deviation. cavitation, groove, cells: as
    for `table`. keys: the law's other keys, in SI, without the viscosity. Raises BadValueError, and the errors of
    `table` and of the law.
    """
    ratio = check_positive(l_over_d, "l_over_d")
    bearing = _make_bearing(ratio)
    ratios, alpha = (
        as_c_array(eps, "eps", (None,), require_finite=True),
        as_c_array(motion, "motion", (None,), require_finite=True),
    )
    if not ratios.size or not alpha.size or ratios.min() <= 0.0 or ratios.max() >= 1.0:
        raise BadValueError("eps and motion: expected at least one value each, eps above 0 and below 1")
    law_forces = _evaluate_law(law, ratio, ratios, alpha, keys)
    eps, closing, turning = _build_states(ratios, alpha)
    solver_table = table(bearing, eps, closing, 2.0 * turning / eps, cavitation=cavitation, groove=groove, cells=cells)
    unit = _compute_force_unit(bearing)
    return Deviation(
        law, ratio, cavitation, ratios, alpha, solver_table.force / unit, law_forces, solver_table.error / unit
    )


def _make_bearing(l_over_d: float) -> Bearing:
    """Return the bearing with this length over diameter, on which relative deviations depend only."""
    return Bearing(RADIUS, 2.0 * RADIUS * l_over_d, CLEARANCE, VISCOSITY)


def _compute_force_unit(bearing: Bearing) -> float:
    """Return the unit of the forces in N: μ R³ L/c² times 1/s."""
    return VISCOSITY * RADIUS**3 * bearing.length / CLEARANCE**2


def _build_states(eps: Array, motion: Array) -> tuple[Array, Array, Array]:
    """Return ε (n, 1), ε̇ (n, m) and ½ ε ω_s (n, m) for a rate W = 1/s.

    eps (n,): eccentricity ratios. motion (m,): angles of motion in rad, see Deviation.
    """
    return eps[:, None], np.cos(motion) + 0.0 * eps[:, None], np.sin(motion) + 0.0 * eps[:, None]


def _evaluate_law(
    law: str, l_over_d: float, eps: Array, motion: Array, keys: Mapping[str, float | str | bool]
) -> Array:
    """Return radial and tangential force of the law (n, m, 2) over μ R³ L/c² at W = 1/s. Raises BadValueError if not
    finite.
    """
    bearing, (ratios, closing, turning) = _make_bearing(l_over_d), _build_states(eps, motion)
    with np.errstate(over="ignore", invalid="ignore"):
        force = make_law_force(law, bearing, keys)(ratios + 0.0 * closing, closing, -turning) / _compute_force_unit(
            bearing
        )
    check_finite(force)
    return force


def make_law_force(name: str, bearing: Bearing, keys: Mapping[str, float | str | bool]) -> LawForce:
    """Return a function of ε, w_n and w_t (1/s) that computes the law's forces F_r and F_t (…, 2) in N.

    name: of a film law. keys: its keys, in SI; the viscosity is that of the bearing. Raises UnknownNameError,
    UnknownKeyError, MissingKeyError or BadValueError for a wrong name, key or value.
    """
    from gudgeon.generator.kinds.laws.built import PAIR_QUANTITIES, make_law_function
    from gudgeon.generator.kinds.laws.law import find_laws_of_role

    laws, name = find_laws_of_role("film"), check_text(name, "law")
    if name not in laws:
        raise make_unknown_name_error("film law", name, laws, None)
    law, values = laws[name], {"viscosity": bearing.viscosity, **keys}
    if unknown_keys := set(values) - {option.name for option in law.fields} - {"viscosity"}:
        raise UnknownKeyError(f"film law {name}: no key {sorted(unknown_keys)[0]!r}")
    field_values = {option.name: values.get(option.name, option.default) for option in law.fields}
    if missing := [option.name for option in law.fields if option.required and field_values[option.name] is None]:
        raise MissingKeyError(f"film law {name}: {missing[0]} is missing")
    parameter_values = {
        option.name: check_number(x, option.name)
        for option in law.parameters
        if (x := field_values[option.name]) is not None
    }
    law.check_bounds(parameter_values)
    selected: dict[str, Any] = {option.name: field_values[option.name] for option in law.options} | dict(
        law.also.get(name, {})
    )
    for option in law.options:
        if not isinstance(selected[option.name], (str, bool)) or selected[option.name] not in option.values:
            expected = " or ".join(map(str, option.values))
            raise BadValueError(f"film law {name}: {option.name} is {selected[option.name]!r}: expected {expected}")
    r, c = bearing.radius, bearing.clearance
    dimensions = dict(zip(PAIR_QUANTITIES, (r + c, r, c, bearing.length, 1e11, 0.3, 1e11, 0.3), strict=True))
    function = make_law_function(law, parameter_values, selected, dimensions)

    def force(eps: Array, w_n: Array, w_t: Array) -> Array:
        """Return F_r and F_t (…, 2) in N at eccentricity ratio ε and effective velocities w_n, w_t over c (1/s)."""
        forces = function(eps, w_n, w_t)
        return np.stack([forces["F_r"], forces["F_t"]], axis=-1)

    return force

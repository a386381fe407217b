"""Compare a film law with Reynolds' equation over eccentricity and over the direction of motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError, MissingKeyError, UnknownKeyError
from gudgeon.language.argument_checks import number_of, positive, text
from gudgeon.language.names import unknown_name
from gudgeon.model.arrays import as_c_array
from gudgeon.reynolds.bearing import Bearing, check_finite
from gudgeon.reynolds.equation import Array
from gudgeon.reynolds.solver import CELLS
from gudgeon.reynolds.tables import table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

EPS = tuple(0.05 * k for k in range(1, 20))
MOTIONS = tuple(math.pi / 12 * k for k in range(13))
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
        off = self.law_force - self.force
        return np.asarray(np.hypot(off[..., 0], off[..., 1]) / largest)

    def __repr__(self) -> str:
        """Return law, L/D, cavitation condition and the largest deviation."""
        worst = f"{self.share.max():.2%} at most"
        return f"<Deviation of {self.law} at L/D = {self.l_over_d:g}, {self.cavitation}: {worst}>"

    def of(self, law: str, **keys: float | str | bool) -> Deviation:
        """Return the deviation of another law, with its other keys, at the same states; the solver's results are
        reused.
        """
        return replace(self, law=law, law_force=_evaluate_law(law, self.l_over_d, self.eps, self.motion, keys))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the deviation in percent as a map; needs matplotlib."""
        from gudgeon.reynolds.plot import deviation_map

        return deviation_map(self, ax)


def deviation(
    law: str,
    l_over_d: float,
    *,
    eps: ArrayLike = EPS,
    motion: ArrayLike = MOTIONS,
    cavitation: str = "reynolds",
    groove: str | None = None,
    cells: tuple[int, int] = CELLS,
    **keys: float | str | bool,
) -> Deviation:
    """Compare a film law (`gudgeon.generator.kinds.laws`, or a registered one) with the solver.

    l_over_d: length over diameter. eps: (n,) in (0, 1). motion: (m,) rad, see Deviation. cavitation, groove, cells: as
    `table` takes them. keys: the law's other keys, numbers in SI; the viscosity is given.
    """
    ratio = positive(l_over_d, "l_over_d")
    own = _make_bearing(ratio)
    at, alpha = as_c_array(eps, "eps", (None,), finite=True), as_c_array(motion, "motion", (None,), finite=True)
    if not at.size or not alpha.size or at.min() <= 0.0 or at.max() >= 1.0:
        raise BadValueError("eps and motion: expected at least one each, eps above 0 and below 1")
    by_law = _evaluate_law(law, ratio, at, alpha, keys)
    eps, closing, turning = _make_states(at, alpha)
    found = table(own, eps, closing, 2.0 * turning / eps, cavitation=cavitation, groove=groove, cells=cells)
    unit = _force_unit(own)
    return Deviation(law, ratio, cavitation, at, alpha, found.force / unit, by_law, found.error / unit)


def _make_bearing(l_over_d: float) -> Bearing:
    """Return the bearing in which forces are compared; ratios do not depend on its dimensions."""
    return Bearing(RADIUS, 2.0 * RADIUS * l_over_d, CLEARANCE, VISCOSITY)


def _force_unit(own: Bearing) -> float:
    """Return the unit of the forces, μ R³ L/c² times 1/s, in N."""
    return VISCOSITY * RADIUS**3 * own.length / CLEARANCE**2


def _make_states(eps: Array, motion: Array) -> tuple[Array, Array, Array]:
    """Return ε (n, 1), ε̇ (n, m) and ½ ε ω_s (n, m) at W = 1/s."""
    return eps[:, None], np.cos(motion) + 0.0 * eps[:, None], np.sin(motion) + 0.0 * eps[:, None]


def _evaluate_law(
    law: str, l_over_d: float, eps: Array, motion: Array, keys: Mapping[str, float | str | bool]
) -> Array:
    """Return the force of the law (n, m, 2) over μ R³ L/c²."""
    own, (at, closing, turning) = _make_bearing(l_over_d), _make_states(eps, motion)
    with np.errstate(over="ignore", invalid="ignore"):
        force = law_force(law, own, keys)(at + 0.0 * closing, closing, -turning) / _force_unit(own)
    check_finite(force)
    return force


def law_force(name: str, bearing: Bearing, keys: Mapping[str, float | str | bool]) -> LawForce:
    """Return a function of ε, w_n and w_t (1/s) that gives the law's forces F_r and F_t (…, 2) in N.

    keys: the law's keys. Raises UnknownNameError, UnknownKeyError, MissingKeyError, BadValueError.
    """
    from gudgeon.generator.kinds.laws.built import PAIR, alone
    from gudgeon.generator.kinds.laws.law import called

    known, name = called("film"), text(name, "law")
    if name not in known:
        raise unknown_name("film law", name, known, None)
    law, values = known[name], {"viscosity": bearing.viscosity, **keys}
    if strange := set(values) - {own.name for own in law.fields} - {"viscosity"}:
        raise UnknownKeyError(f"film law {name}: no key {sorted(strange)[0]!r}")
    given = {own.name: values.get(own.name, own.default) for own in law.fields}
    if lacking := [own.name for own in law.fields if own.required and given[own.name] is None]:
        raise MissingKeyError(f"film law {name}: {lacking[0]} is missing")
    numbers = {own.name: number_of(x, own.name) for own in law.parameters if (x := given[own.name]) is not None}
    law.check(numbers)
    selected: dict[str, Any] = {own.name: given[own.name] for own in law.options} | dict(law.also.get(name, {}))
    for own in law.options:
        if not isinstance(selected[own.name], (str, bool)) or selected[own.name] not in own.values:
            expected = " or ".join(map(str, own.values))
            raise BadValueError(f"film law {name}: {own.name} is {selected[own.name]!r}: expected {expected}")
    r, c = bearing.radius, bearing.clearance
    pair = dict(zip(PAIR, (r + c, r, c, bearing.length, 1e11, 0.3, 1e11, 0.3), strict=True))
    function = alone(law, numbers, selected, pair)

    def force(eps: Array, w_n: Array, w_t: Array) -> Array:
        """Return F_r and F_t (…, 2) in N."""
        found = function(eps, w_n, w_t)
        return np.stack([found["F_r"], found["F_t"]], axis=-1)

    return force

"""How far a film law is from Reynolds' equation, over eccentricity and over how the journal moves."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError, MissingKeyError, UnknownKeyError
from gudgeon.language.names import unknown_name
from gudgeon.language.wanted import number_of, positive, text
from gudgeon.model.arrays import taken
from gudgeon.reynolds.bearing import Bearing, check_finite
from gudgeon.reynolds.equation import Array
from gudgeon.reynolds.solver import CELLS
from gudgeon.reynolds.tables import table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

EPS = tuple(0.05 * k for k in range(1, 20))
MOTIONS = tuple(math.pi / 12 * k for k in range(13))
RADIUS, CLEARANCE, VISCOSITY = 0.01, 1e-5, 0.1  # of the bearing that is looked at: ratios do not hang on them
LawForce = Callable[[Array, Array, Array], Array]


@dataclass(frozen=True, eq=False)
class Deviation:
    """A law beside the solver at n eccentricity ratios and m motions; forces over μ R³ L/c² at a rate W of 1/s.

    motion: (m,) angle α in rad with ε̇ = W cos α, ½ ε ω_s = W sin α: 0 the gap closes, π/2 the journal turns, π it
    leaves the wall. Both forces hang on W in proportion, and on the sign of ω_s by symmetry. force, law_force:
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
        """(n, m) |F_law − F| over the largest |F| at that ε."""
        largest = np.hypot(self.force[..., 0], self.force[..., 1]).max(axis=1, keepdims=True)
        off = self.law_force - self.force
        return np.asarray(np.hypot(off[..., 0], off[..., 1]) / largest)

    def __repr__(self) -> str:
        worst = f"{self.share.max():.2%} at most"
        return f"<Deviation of {self.law} at L/D = {self.l_over_d:g}, {self.cavitation}: {worst}>"

    def of(self, law: str, **keys: float | str | bool) -> Deviation:
        """Another law, with its other keys, at the same states; what the solver found of them is not sought again."""
        return replace(self, law=law, law_force=_by_law(law, self.l_over_d, self.eps, self.motion, keys))

    def plot(self, ax: Axes | None = None) -> Axes:
        """The share in percent as a map; needs matplotlib."""
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
    """A film law (`gudgeon.generator.kinds.laws`, or one of your own that is registered) against the solver.

    l_over_d: length over diameter. eps: (n,) in (0, 1). motion: (m,) rad, see Deviation. cavitation, groove, cells: as
    `table` takes them. keys: the law's other keys, numbers in SI; the viscosity is given.
    """
    ratio = positive(l_over_d, "l_over_d")
    own = _bearing(ratio)
    at, alpha = taken(eps, "eps", (None,), finite=True), taken(motion, "motion", (None,), finite=True)
    if not at.size or not alpha.size or at.min() <= 0.0 or at.max() >= 1.0:
        raise BadValueError("eps and motion: expected at least one each, eps above 0 and below 1")
    by_law = _by_law(law, ratio, at, alpha, keys)
    eps, closing, turning = _states(at, alpha)
    found = table(own, eps, closing, 2.0 * turning / eps, cavitation=cavitation, groove=groove, cells=cells)
    unit = _unit(own)
    return Deviation(law, ratio, cavitation, at, alpha, found.force / unit, by_law, found.error / unit)


def _bearing(l_over_d: float) -> Bearing:
    return Bearing(RADIUS, 2.0 * RADIUS * l_over_d, CLEARANCE, VISCOSITY)


def _unit(own: Bearing) -> float:
    return VISCOSITY * RADIUS**3 * own.length / CLEARANCE**2


def _states(eps: Array, motion: Array) -> tuple[Array, Array, Array]:
    """(n, 1) ε, (n, m) ε̇ and ½ ε ω_s at W = 1/s."""
    return eps[:, None], np.cos(motion) + 0.0 * eps[:, None], np.sin(motion) + 0.0 * eps[:, None]


def _by_law(law: str, l_over_d: float, eps: Array, motion: Array, keys: Mapping[str, float | str | bool]) -> Array:
    """(n, m, 2) over μ R³ L/c²."""
    own, (at, closing, turning) = _bearing(l_over_d), _states(eps, motion)
    with np.errstate(over="ignore", invalid="ignore"):
        force = law_force(law, own, keys)(at + 0.0 * closing, closing, -turning) / _unit(own)
    check_finite(force)
    return force


def law_force(name: str, bearing: Bearing, keys: Mapping[str, float | str | bool]) -> LawForce:
    """The law's (…, 2) F_r and F_t (N) as a function of ε, w_n and w_t (1/s)."""
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
    chosen: dict[str, Any] = {own.name: given[own.name] for own in law.options} | dict(law.also.get(name, {}))
    for own in law.options:
        if not isinstance(chosen[own.name], (str, bool)) or chosen[own.name] not in own.values:
            expected = " or ".join(map(str, own.values))
            raise BadValueError(f"film law {name}: {own.name} is {chosen[own.name]!r}: expected {expected}")
    r, c = bearing.radius, bearing.clearance
    pair = dict(zip(PAIR, (r + c, r, c, bearing.length, 1e11, 0.3, 1e11, 0.3), strict=True))
    function = alone(law, numbers, chosen, pair)

    def force(eps: Array, w_n: Array, w_t: Array) -> Array:
        found = function(eps, w_n, w_t)
        return np.stack([found["F_r"], found["F_t"]], axis=-1)

    return force

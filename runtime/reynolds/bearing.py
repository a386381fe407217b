"""A bearing with its oil, checked when it is made, and its solved film in the units and the frame of the caller."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError
from gudgeon.language.wanted import is_whole, positive, told
from gudgeon.model.arrays import taken

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gudgeon.reynolds.equation import Array

CAVITATIONS = ("half_sommerfeld", "reynolds", "elrod_adams")
ENDS = ("open", "sealed")
LARGEST = 2_000_000  # unknowns


@dataclass(frozen=True)
class Bearing:
    """A plain bearing and its journal, in SI.

    radius: of the journal, m. length: m, 1e-6 to 1e6 diameters. clearance: radial, m; the curvature of the film is
    neglected, so it must be below a tenth of the radius. viscosity: dynamic, Pa·s. Raises BadValueError for numbers
    that are none of this.
    """

    radius: float
    length: float
    clearance: float
    viscosity: float

    def __post_init__(self) -> None:
        for field in fields(self):
            object.__setattr__(self, field.name, positive(getattr(self, field.name), field.name))
        if self.clearance >= 0.1 * self.radius:
            much = f"clearance is {self.clearance:g} m, radius {self.radius:g} m"
            raise BadValueError(f"{much}: expected a clearance below a tenth of the radius")
        if not 1e-6 <= self.l_over_d <= 1e6:
            raise BadValueError(f"length over diameter is {self.l_over_d:g}: expected 1e-6 to 1e6")

    @property
    def l_over_d(self) -> float:
        """Length over diameter."""
        return self.length / (2.0 * self.radius)

    @property
    def pressure_unit(self) -> float:
        """12 μ (R/c)², Pa·s: by it and a rate pressures are numbers of order one."""
        return 12.0 * self.viscosity * (self.radius / self.clearance) ** 2


def pair(values: ArrayLike, name: str) -> tuple[float, float]:
    """Two finite components."""
    x, y = taken(values, name, (2,), finite=True)
    return float(x), float(y)


def check_eccentricity(ratio: float) -> None:
    if ratio >= 1.0:
        much = f"the eccentricity is {ratio:.6g} times the clearance: expected less than 1"
        raise BadValueError(much, hint="beyond it there is no film")


def choice(value: object, name: str, known: Sequence[str]) -> str:
    if not isinstance(value, str) or value not in known:
        raise BadValueError(f"{name} is {told(value)}: expected {', '.join(known[:-1])} or {known[-1]}")
    return value


def cells_of(cells: object, sealed: bool) -> tuple[int, int]:
    """How many around, and how many from the middle to an end; both can be halved, for the error."""
    if not isinstance(cells, Sequence) or len(cells) != 2 or not all(map(is_whole, cells)):
        raise BadValueError(f"cells is {told(cells)}: expected two whole numbers, around and from the middle to an end")
    around, along = map(int, cells)
    if around < 32 or along < 4 or around % 4 or along % 4 or around * along > LARGEST:
        wanted = f"expected multiples of 4, at least (32, 4), of {LARGEST} cells at most"
        raise BadValueError(f"cells is ({around}, {along}): {wanted}")
    return around, (0 if sealed else along)


@dataclass(frozen=True, eq=False)
class Film:
    """The film of a bearing at one moment. n angles, 2m + 1 places along it; SI, vectors in the caller's frame.

    bearing: its dimensions. cavitation, ends: as asked. eccentricity: (2,) journal's centre from the bearing's, m.
    omega_s: ω_i + ω_j − 2ψ̇, rad/s. groove: direction in which it lies, rad, None: there is none.
    angle: (n,) directions from the bearing's centre, rad, rising from the widest gap or the groove by a turn.
    z: (2m + 1,) from −L/2 to L/2, m. thickness: (n,) of the gap, m. pressure: (n, 2m + 1) Pa over that of the ends,
    at which the film cavitates. content: (n, 2m + 1) share of the gap that oil fills; 1 but with elrod_adams.
    force: (2,) on the journal, N; the bearing's is its opposite, and acts at the bearing's centre.
    radial, tangential: its parts along e and along ẑ × e, N.
    error: N, between these forces and those of half as many cells either way: Roache's index of two grids of a second
    order with the safety factor 3 (P. J. Roache, ASME J. Fluids Eng. 116 (1994) 405–413); what is not in the
    equation it does not know. Where elrod_adams lets a film form again the order is the first, and all of it is left.
    attitude: rad, from the line of centres to the load, atan2(F_t, −F_r); with ω_s < 0 it is negative.
    torque_journal, torque_bearing: of the film's shear on each, N·m, about its own centre: ∓T0 − ½ e F_t with
    T0 = μ R³ (ω_j − ω_i) ∬ θ/h dφ dz: where the film is ruptured the gap drags as if it were full, unless
    elrod_adams knows θ. At ends and grooves p = 0.
    leakage: oil that leaves over both ends, m³/s. supply: oil that comes in, net, m³/s: with elrod_adams from the
    groove, with half_sommerfeld over the ends where p < 0 (and from a groove), with reynolds what the film takes up
    where it forms, for outside of the film that condition asks nothing. taken_up: what the gap holds more each second,
    m³/s (elrod_adams with ė·e ≠ 0). balance: supply − leakage − taken_up, m³/s: rounding.
    extent: directions between which there is pressure in the middle, rad, to a cell, rising; None: nowhere, or all
    round.
    """

    bearing: Bearing
    cavitation: str
    ends: str
    eccentricity: tuple[float, float]
    omega_s: float
    groove: float | None
    angle: Array
    z: Array
    thickness: Array
    pressure: Array
    content: Array
    force: Array
    radial: float
    tangential: float
    error: float
    torque_journal: float
    torque_bearing: float
    leakage: float
    supply: float
    taken_up: float
    balance: float
    extent: tuple[float, float] | None

    @property
    def attitude(self) -> float:
        """rad, from the line of centres to the load; 0 where there is no load."""
        return math.atan2(self.tangential, -self.radial) if self.force.any() else 0.0

    @property
    def eccentricity_ratio(self) -> float:
        """|e|/c."""
        return math.hypot(*self.eccentricity) / self.bearing.clearance

    def __repr__(self) -> str:
        force = f"{math.hypot(*self.force):.4g} N at {math.degrees(self.attitude):.4g}°"
        return f"<Film {self.cavitation}: ε = {self.eccentricity_ratio:.4g}, ω_s = {self.omega_s:.4g} rad/s, {force}>"

    def plot(self) -> Figure:
        """Pressure over the unrolled bearing, and in its middle plane round the journal; needs matplotlib."""
        from gudgeon.reynolds.plot import picture

        return picture(self)


def check_finite(*found: Array) -> None:
    """Raises BadValueError where something overflowed."""
    if not all(np.isfinite(some).all() for some in found):
        raise BadValueError("the film's forces are no numbers: bearing and motion are too far from 1 for doubles")

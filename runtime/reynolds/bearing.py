"""Define a journal bearing with its oil, and its solved film in SI units and in the axes of the caller."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_positive, is_integer, shorten_value
from gudgeon.model.arrays import as_c_array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gudgeon.reynolds.equation import Array

CAVITATIONS = ("half_sommerfeld", "reynolds", "elrod_adams")
ENDS = ("open", "sealed")
MAX_CELLS = 2_000_000  # cells


@dataclass(frozen=True)
class Bearing:
    """A plain bearing and its journal, in SI.

    radius: of the journal, m. length: m, 1e-6 to 1e6 diameters. clearance: radial, m; the curvature of the film is
    neglected, so it must be below a tenth of the radius. viscosity: dynamic, Pa·s. Raises BadValueError for numbers
    outside these ranges.
    """

    radius: float
    length: float
    clearance: float
    viscosity: float

    def __post_init__(self) -> None:
        """Convert all values to floats and raise BadValueError for values outside the ranges of the class."""
        for field in fields(self):
            object.__setattr__(self, field.name, check_positive(getattr(self, field.name), field.name))
        if self.clearance >= 0.1 * self.radius:
            values_text = f"clearance is {self.clearance:g} m, radius {self.radius:g} m"
            raise BadValueError(f"{values_text}: expected a clearance below a tenth of the radius")
        if not 1e-6 <= self.l_over_d <= 1e6:
            raise BadValueError(f"length over diameter is {self.l_over_d:g}: expected 1e-6 to 1e6")

    @property
    def l_over_d(self) -> float:
        """Return the length over the diameter of the journal."""
        return self.length / (2.0 * self.radius)

    @property
    def pressure_unit(self) -> float:
        """Return 12 μ (R/c)² in Pa·s: pressures divided by it and by a rate are of order one."""
        return 12.0 * self.viscosity * (self.radius / self.clearance) ** 2


def check_vector(vector: ArrayLike, name: str) -> tuple[float, float]:
    """Return two finite components (x, y) of an array-like argument. Raises BadValueError with its `name`."""
    x, y = as_c_array(vector, name, (2,), require_finite=True)
    return float(x), float(y)


def check_eccentricity(ratio: float) -> None:
    """Raise BadValueError unless the eccentricity ratio |e|/c is below 1, where the film thickness is positive."""
    if ratio >= 1.0:
        message = f"the eccentricity is {ratio:.6g} times the clearance: expected less than 1"
        raise BadValueError(message, hint="at 1 the film thickness is 0")


def check_choice(value: object, name: str, allowed_values: Sequence[str]) -> str:
    """Return the value if it is one of the allowed texts, else raise BadValueError with the `name` of the argument."""
    if not isinstance(value, str) or value not in allowed_values:
        raise BadValueError(
            f"{name} is {shorten_value(value)}: expected {', '.join(allowed_values[:-1])} or {allowed_values[-1]}"
        )
    return value


def check_cells(cells: object, sealed: bool) -> tuple[int, int]:
    """Return the numbers of cells around the bearing and from the middle to an end; the second is 0 if it is sealed.

    Raises BadValueError unless `cells` has two integers that are large enough, multiples of 4, and at most MAX_CELLS
    together. They can then be halved for the estimate of the error.
    """
    if not isinstance(cells, Sequence) or len(cells) != 2 or not all(map(is_integer, cells)):
        raise BadValueError(
            f"cells is {shorten_value(cells)}: expected two whole numbers, around and from the middle to an end"
        )
    n_around, n_axial = map(int, cells)
    if n_around < 32 or n_axial < 4 or n_around % 4 or n_axial % 4 or n_around * n_axial > MAX_CELLS:
        expected = f"expected multiples of 4, at least (32, 4), and at most {MAX_CELLS} cells"
        raise BadValueError(f"cells is ({n_around}, {n_axial}): {expected}")
    return n_around, (0 if sealed else n_axial)


@dataclass(frozen=True, eq=False)
class Film:
    """The film of a bearing at one time, at n angles and 2m + 1 axial positions; SI, vectors in the caller's frame.

    bearing: its dimensions. cavitation, ends: as specified. eccentricity: (2,) journal's centre from the bearing's, m.
    omega_s: ω_i + ω_j − 2ψ̇, rad/s. groove: its direction, rad, or None.
    angle: (n,) directions from the bearing's centre, rad, rising from the widest gap or the groove by a turn.
    z: (2m + 1,) from −L/2 to L/2, m. thickness: (n,) of the gap, m. pressure: (n, 2m + 1) Pa over that of the ends,
    at which the film cavitates. content: (n, 2m + 1) fraction of the gap that oil fills; 1 except with elrod_adams.
    force: (2,) on the journal, N; the bearing's is its opposite, and acts at the bearing's centre.
    radial, tangential: its parts along e and along ẑ × e, N.
    error: N, between these forces and those of half as many cells either way: Roache's index of two grids of a second
    order with the safety factor 3 (P. J. Roache, ASME J. Fluids Eng. 116 (1994) 405–413); errors of the model are not
    included. With elrod_adams and reformation of the film the order is 1, and the safety factor is 1.
    attitude: rad, from the line of centres to the load, atan2(F_t, −F_r); with ω_s < 0 it is negative.
    torque_journal, torque_bearing: of the film's shear on each, N·m, about its own centre: ∓T0 − ½ e F_t with
    T0 = μ R³ (ω_j − ω_i) ∬ θ/h dφ dz: the ruptured film has the drag of a full gap, except with elrod_adams, which
    computes θ. At ends and grooves p = 0.
    leakage: outflow of oil over both ends, m³/s. supply: net inflow of oil, m³/s: with elrod_adams from the groove,
    with half_sommerfeld over the ends where p < 0 (and from a groove), with reynolds at the reformation of the film,
    where this condition does not conserve oil. taken_up: rate of the oil stored in the gap, m³/s
    (elrod_adams with ė·e ≠ 0). balance: supply − leakage − taken_up, m³/s: rounding error.
    extent: rising directions between which there is pressure in the middle plane, rad, within one cell; None: nowhere,
    or everywhere.
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
        """Return the attitude angle in rad, from the line of centres to the load; 0 without a load."""
        return math.atan2(self.tangential, -self.radial) if self.force.any() else 0.0

    @property
    def eccentricity_ratio(self) -> float:
        """Return the eccentricity |e| over the clearance c."""
        return math.hypot(*self.eccentricity) / self.bearing.clearance

    def __repr__(self) -> str:
        """Return cavitation condition, ε, ω_s and force with attitude angle in one line."""
        force = f"{math.hypot(*self.force):.4g} N at {math.degrees(self.attitude):.4g}°"
        return f"<Film {self.cavitation}: ε = {self.eccentricity_ratio:.4g}, ω_s = {self.omega_s:.4g} rad/s, {force}>"

    def plot(self) -> Figure:
        """Return a figure of the pressure over the unrolled bearing, and around the journal in the middle plane; needs
        matplotlib.
        """
        from gudgeon.reynolds.plot import draw_film

        return draw_film(self)


def check_finite(*arrays: Array) -> None:
    """Raise BadValueError if any value of the arrays is NaN or infinite."""
    if not all(np.isfinite(array).all() for array in arrays):
        raise BadValueError(
            "the film's forces are not finite: values of bearing or motion are out of range for doubles"
        )

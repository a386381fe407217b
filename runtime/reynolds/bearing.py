"""A bearing with its oil, and what may be asked of its film: numbers that make sense, or an error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError
from gudgeon.language.wanted import is_whole, positive, told
from gudgeon.model.arrays import taken

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

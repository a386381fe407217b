"""What a joint with play wears off: Archard's volume or Reye's, as depth over both circumferences.

J. F. Archard, J. Appl. Phys. 24 (1953) 981: V = k F_n s/H, of a normal force F_n over a sliding distance s, a
hardness H and a pure number k. T. Reye, Der Civilingenieur 4 (1860) 235: a volume in proportion to the work of
friction, here k/H of it. Both hold for a wear that changes no geometry: clearance and shape stay those of the file.
`Worn` is what wear makes of bearings round by round, of many runs whose contours change (simulation/wear_loop.py).
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.results.state import Array

POINTS = 3600  # cells of a circumference
SHARE = 0.9  # of the volume, that lies in the worn arc
HOUR = 3600.0  # s
LAWS = ("archard", "reye")


@dataclass(frozen=True)
class Rubbing:
    """What is asked of a run: how the surfaces of a joint with play rub from one time (s) to another."""

    joint: str
    points: int = POINTS
    begin: float = -np.inf
    end: float = np.inf
    overlap: bool = False  # spread over the arc in which the circles overlap; else at the contact's point


@dataclass(frozen=True, eq=False)
class Rubbed:
    """What a run said to it; cells count from angle 0 of the body's own frame, counterclockwise."""

    asked: Rubbing
    load: Array  # (2, points) ∫ F_n |v_t| dt, N·m, of the bearing's cells and of the journal's
    friction: Array  # (2, points) ∫ |F_t v_t| dt, J
    slip: float  # m, ∫ |v_t| dt in contact
    begin: float  # s, of what was seen
    end: float
    radii: tuple[float, float]  # m, of bearing and journal
    length: float  # m

    def depth(self, side: int, law: str = "archard", rate: float = 1.0) -> Array:
        """(points,) m, of the bearing (0) or the journal (1), by k/H (1/Pa)."""
        area = self.radii[side] * 2.0 * np.pi / self.asked.points * self.length
        return np.asarray(rate * (self.load if law == "archard" else self.friction)[side] / area)


@dataclass(frozen=True, eq=False)
class Surface:
    """One side's wear: of the bearing in the bearing's frame, of the journal in the journal's."""

    depth: Array  # (points,) m, over the middles of the cells, `Wear.angle`
    radius: float  # m
    length: float  # m
    hours: float  # of the run

    @property
    def volume(self) -> float:
        """m³."""
        return float(self.depth.sum()) * self.length * self.radius * 2.0 * np.pi / len(self.depth)

    @property
    def deepest(self) -> float:
        """m."""
        return float(self.depth.max())

    @property
    def deepest_angle(self) -> float:
        """Of the middle of the deepest cell, rad within 0 and 2π; NaN where nothing is worn."""
        return float(middles(len(self.depth))[self.depth.argmax()]) if self.deepest > 0.0 else np.nan

    @property
    def depth_per_hour(self) -> Array:
        """(points,) m/h, as if all hours were like the run."""
        return self.depth / self.hours

    @property
    def volume_per_hour(self) -> float:
        """m³/h."""
        return self.volume / self.hours

    def arc(self, share: float = SHARE) -> float:
        """Of the shortest arc that holds this share of the volume, rad, whole cells; NaN where nothing is worn."""
        return arc(self.depth, share)


@dataclass(frozen=True, eq=False)
class Wear:
    """Of one joint over a run: `bearing` and `journal`, depths over `angle`, (points,) rad."""

    joint: str
    law: str
    angle: Array
    bearing: Surface
    journal: Surface
    slip: float  # m, that the surfaces slid on each other in contact
    t: tuple[float, float]  # s, from and to
    title: str

    def __repr__(self) -> str:
        bearing, journal = (f"{surface.depth.max():.3g} m" for surface in (self.bearing, self.journal))
        return f"<Wear of {self.joint} by {self.law}: bearing {bearing}, journal {journal} at most>"

    def to_xarray(self) -> xarray.Dataset:
        """Depths of both sides (m) over the angle (rad), volumes and arcs as attributes."""
        import xarray

        sides = {"bearing": self.bearing, "journal": self.journal}
        told = {
            f"{name}_{key}": value
            for name, side in sides.items()
            for key, value in (("volume", side.volume), ("arc", side.arc()), ("deepest_angle", side.deepest_angle))
        }
        columns = {
            name: ("angle", side.depth, {"units": "m", "long_name": f"wear's depth, {name}'s frame"})
            for name, side in sides.items()
        }
        own = {"joint": self.joint, "law": self.law, "t_begin": self.t[0], "t_end": self.t[1], "slip": self.slip}
        return xarray.Dataset(columns, {"angle": ("angle", self.angle, {"units": "rad"})}, own | told)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row a cell: angle (rad) as index, depth of the bearing and of the journal (m)."""
        table: pandas.DataFrame = self.to_xarray().to_dataframe()
        return table

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Angle (rad) and both depths (m), a row a cell, with all digits."""
        from gudgeon.files.writing import write_bytes
        from gudgeon.language.wanted import path as named

        rows = zip(self.angle.tolist(), self.bearing.depth.tolist(), self.journal.depth.tolist(), strict=True)
        text = "".join(f"{angle!r},{bearing!r},{journal!r}\n" for angle, bearing, journal in rows)
        write_bytes(named(path, "path"), f"angle,bearing,journal\n{text}".encode())

    def plot(self, ax: Axes | None = None) -> Axes:
        """Depth over the angle in each body's own frame."""
        from gudgeon.results.figures.run_plots import plot_wear

        return plot_wear(self, ax)


@dataclass(frozen=True, eq=False)
class WornJoint:
    """The bearing of one joint over r rounds of n runs; NaN from where a run failed on."""

    contour: Array  # (r + 1, n, slots) m: before each round, and what the last one leaves
    depth: Array  # (r, n, points) m that a round wears, times `scale`, over the middles of the cells
    work: Array  # (r, n) N m: ∫ F_n ds of Archard's law, or of Reye's what friction took, of the runs themselves
    peak: Array  # (r, n) N, largest force
    radius: Array  # (n,) m
    length: Array  # (n,) m
    journal: Array  # (r, n, points) m that a round wears off the journal, times `scale`, in the journal's own frame
    journal_radius: Array  # (n,) m

    @property
    def journal_volume(self) -> Array:
        """(r, n) m³ that each round wore off the journal; no contour is deeper by it."""
        return np.asarray(self.journal.mean(axis=2) * 2.0 * np.pi * self.journal_radius * self.length)

    @property
    def volume(self) -> Array:
        """(r, n) m³ that each round wore off the bearing."""
        return np.asarray(self.depth.mean(axis=2) * 2.0 * np.pi * self.radius * self.length)

    @property
    def contour_volume(self) -> Array:
        """(r + 1, n) m³ that the contours are deeper than the circle: depths keep what was worn."""
        return np.asarray(self.contour.mean(axis=2) * 2.0 * np.pi * self.radius * self.length)


@dataclass(frozen=True, eq=False)
class Worn:
    """What came of `gudgeon.wear_loop`: by joint, with the laws that it was worn by."""

    joints: Mapping[str, WornJoint]
    law: str
    rate: float  # k/H, 1/Pa
    scale: float  # runs that each run stands for
    failures: Mapping[int, str]  # run -> why, in the round in which it failed
    title: str

    def __repr__(self) -> str:
        rounds, runs = next(iter(self.joints.values())).work.shape
        return f"<Worn {', '.join(self.joints)} by {self.law}: {rounds} rounds of {runs} runs>"

    def to_xarray(self) -> xarray.Dataset:
        """Contours over round, joint, run and slot; depths over the cells; volumes, works and peak forces."""
        import xarray

        names, several = list(self.joints), list(self.joints.values())
        slots = max((one.contour.shape[2] for one in several), default=0)
        contour = np.full((len(names), *several[0].contour.shape[:2], slots), np.nan)
        for k, one in enumerate(several):
            contour[k, :, :, : one.contour.shape[2]] = one.contour
        of_round, told = ("joint", "round", "run"), "of the bearing, beyond its circle, before each round"
        columns = {
            "contour": (("joint", "state", "run", "slot"), contour, {"units": "m", "long_name": f"depth {told}"}),
            "depth": ((*of_round, "angle"), np.stack([one.depth for one in several]), {"units": "m"}),
            "journal": ((*of_round, "angle"), np.stack([one.journal for one in several]), {"units": "m"}),
            "journal_volume": (of_round, np.stack([one.journal_volume for one in several]), {"units": "m^3"}),
            "volume": (of_round, np.stack([one.volume for one in several]), {"units": "m^3"}),
            "work": (of_round, np.stack([one.work for one in several]), {"units": "N*m"}),
            "peak": (of_round, np.stack([one.peak for one in several]), {"units": "N"}),
        }
        points = several[0].depth.shape[2]
        places = {"joint": names, "angle": ("angle", middles(points), {"units": "rad"})}
        own = {"law": self.law, "rate": self.rate, "scale": self.scale, "title": self.title}
        return xarray.Dataset(columns, places, own)

    def save(self, path: str | os.PathLike[str]) -> None:
        """The dataset as NetCDF, whole or not at all; `xarray.open_dataset` reads it."""
        from gudgeon.files.writing import write_bytes
        from gudgeon.language.wanted import path as named

        write_bytes(named(path, "path"), bytes(self.to_xarray().to_netcdf(engine="h5netcdf")))


def middles(points: int) -> Array:
    """Of the cells of a circumference, (points,) rad."""
    return (np.arange(points) + 0.5) * (2.0 * np.pi / points)


def arc(worn: Array, share: float = SHARE) -> float:
    """The shortest arc (rad, whole cells) around a circle that holds so much of what its cells (points,) hold."""
    total, n = float(worn.sum()), len(worn)
    if not total > 0.0:
        return np.nan
    before = np.concatenate([[0.0], np.cumsum(np.concatenate([worn, worn]))])
    wanted = before[:n] + share * total * (1.0 - 1e-12)
    ends = np.searchsorted(before, wanted, "left")
    return float((ends - np.arange(n)).min()) * 2.0 * np.pi / n


def bearing_of(source: KernelSource, joint: str) -> tuple[int, int, int]:
    """Where p has the radii of bearing and journal and the pin's length, m."""
    own = next(one for one in source.clearances if one.name == joint)
    radius = own.constants["R_i"]
    owner = source.slots[radius].address.rpartition(".")[0]
    length = next(k for k, slot in enumerate(source.slots) if slot.address == f"{owner}.length")
    return radius, own.constants["R_j"], length


def spread(points: int, low: Array, high: Array, loads: Array, half: Array | None = None) -> Array:
    """Loads (r, K) laid evenly on arcs from low to high (K,) rad; (r, points).

    `half` (K,) rad: each place of an arc is a parabola, which is 0 so far from it on both sides. Angles may be of any
    turn; what falls into a cell is the integral over it, so that sums stay those of the loads.
    """
    per_cell = 2.0 * np.pi / points
    wide = np.zeros(len(low)) if half is None else half / per_cell
    a, b = low / per_cell, high / per_cell
    b = np.maximum(b, a + np.maximum(1e-9, 1e-6 * wide))
    first = np.floor(a - wide).astype(np.int64)
    count = np.floor(b + wide).astype(np.int64) - first + 1
    arcs = np.repeat(np.arange(len(a)), count)
    cell = first[arcs] + np.arange(len(arcs)) - np.repeat(np.cumsum(count) - count, count)
    left, right = (_below(edge, a[arcs], b[arcs], None if half is None else wide[arcs]) for edge in (cell, cell + 1))
    return np.stack([np.bincount(cell % points, load[arcs] * (right - left), points) for load in loads])


def _below(x: Array, a: Array, b: Array, half: Array | None) -> Array:
    """What share of an arc from a to b lies below x; with parabolas of this half width over all of its places."""
    if half is None:
        return np.asarray(np.clip((x - a) / (b - a), 0.0, 1.0))
    half = np.maximum(half, 1e-9)
    return np.asarray((_parabolas((x - a) / half) - _parabolas((x - b) / half)) * half / (b - a))


def _parabolas(s: Array) -> Array:
    """Twice the integral of 3/4 (1 − s²) from −1 on, which has the area 1 within ±1."""
    inside = np.clip(s, -1.0, 1.0)
    return np.asarray((0.75 + inside * (2.0 + inside * (1.5 - 0.25 * inside**2))) / 4.0 + np.maximum(s - 1.0, 0.0))

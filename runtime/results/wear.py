"""Define the computed wear of a joint with play: volume by Archard's or Reye's law, and depth along both surfaces.

J. F. Archard, J. Appl. Phys. 24 (1953) 981: V = k F_n s/H, with the normal force F_n, the sliding distance s, the
hardness H and a pure number k. T. Reye, Der Civilingenieur 4 (1860) 235: a volume proportional to the work of friction,
here with the factor k/H. Both assume that wear changes no geometry: clearance and shape remain those of the file.
`WearRoundsResult` is the result of rounds of wear that do change the contours of bearings (simulation/wear_loop.py).
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

POINTS = 3600  # default number of cells of a circumference
WORN_FRACTION = 0.9  # fraction of the volume that lies in the worn arc
HOUR = 3600.0  # s
LAWS = ("archard", "reye")


@dataclass(frozen=True)
class SlidingRequest:
    """Request to accumulate the sliding loads of a joint with play over the interval from `begin` to `end` (s)."""

    joint: str
    points: int = POINTS
    begin: float = -np.inf
    end: float = np.inf
    overlap: bool = False  # spread over the arc in which the circles overlap; else at the contact's point


@dataclass(frozen=True, eq=False)
class SlidingLoads:
    """The accumulated sliding loads of a joint, by cells of both circumferences.

    Cells count counterclockwise from angle 0 of the body's own frame.
    """

    requested: SlidingRequest  # the request
    load: Array  # (2, points) ∫ F_n |v_t| dt, N·m, by cells of the bearing and of the journal
    friction: Array  # (2, points) ∫ |F_t v_t| dt, J
    slip: float  # m, ∫ |v_t| dt in contact
    begin: float  # s, accumulated interval
    end: float
    radii: tuple[float, float]  # m, of bearing and journal
    length: float  # m

    def compute_depth(self, side: int, law: str = "archard", rate: float = 1.0) -> Array:
        """Return the wear depth in m of each cell, (points,), of the bearing (side 0) or the journal (side 1).

        `law` is "archard" or "reye"; `rate` is k/H in 1/Pa.
        """
        cell_area = self.radii[side] * 2.0 * np.pi / self.requested.points * self.length
        return np.asarray(rate * (self.load if law == "archard" else self.friction)[side] / cell_area)


@dataclass(frozen=True, eq=False)
class Surface:
    """Wear of one surface in its own frame: the bearing's or the journal's."""

    depth: Array  # (points,) m, over the middles of the cells, `Wear.angle`
    radius: float  # m
    length: float  # m
    hours: float  # of the run

    @property
    def volume(self) -> float:
        """Return the worn volume, m³."""
        return float(self.depth.sum()) * self.length * self.radius * 2.0 * np.pi / len(self.depth)

    @property
    def deepest(self) -> float:
        """Return the largest wear depth, m."""
        return float(self.depth.max())

    @property
    def deepest_angle(self) -> float:
        """Return the angle of the middle of the deepest cell, rad, within 0 and 2π; NaN without wear."""
        return float(compute_cell_angles(len(self.depth))[self.depth.argmax()]) if self.deepest > 0.0 else np.nan

    @property
    def depth_per_hour(self) -> Array:
        """Return the wear depth per hour of such running, (points,) m/h."""
        return self.depth / self.hours

    @property
    def volume_per_hour(self) -> float:
        """Return the worn volume per hour of such running, m³/h."""
        return self.volume / self.hours

    def arc(self, share: float = WORN_FRACTION) -> float:
        """Return the length in rad of the shortest arc of whole cells that contains the fraction `share` of the worn
        volume.

        Returns NaN without wear.
        """
        return compute_shortest_arc(self.depth, share)


@dataclass(frozen=True, eq=False)
class Wear:
    """Wear of one joint over a run: `bearing` and `journal`, with depths over `angle`, (points,) rad."""

    joint: str
    law: str
    angle: Array
    bearing: Surface
    journal: Surface
    slip: float  # m, sliding distance in contact
    t: tuple[float, float]  # s, from and to
    title: str

    def __repr__(self) -> str:
        """Return joint, law and the largest depths of both surfaces in one line."""
        bearing, journal = (f"{surface.depth.max():.3g} m" for surface in (self.bearing, self.journal))
        return f"<Wear of {self.joint} by {self.law}: bearing {bearing}, journal {journal} at most>"

    def to_xarray(self) -> xarray.Dataset:
        """Return a Dataset of the depths of both surfaces (m), `bearing` and `journal`, over `angle` (rad).

        Its attributes are joint, law, t_begin, t_end, slip, and of each surface volume, arc and deepest_angle, for
        example bearing_volume.
        """
        import xarray

        surfaces = {"bearing": self.bearing, "journal": self.journal}
        attributes_of_surfaces = {
            f"{name}_{key}": value
            for name, surface in surfaces.items()
            for key, value in (
                ("volume", surface.volume),
                ("arc", surface.arc()),
                ("deepest_angle", surface.deepest_angle),
            )
        }
        columns = {
            name: ("angle", surface.depth, {"units": "m", "long_name": f"wear depth, {name}'s frame"})
            for name, surface in surfaces.items()
        }
        attributes = {"joint": self.joint, "law": self.law, "t_begin": self.t[0], "t_end": self.t[1], "slip": self.slip}
        return xarray.Dataset(
            columns, {"angle": ("angle", self.angle, {"units": "rad"})}, attributes | attributes_of_surfaces
        )

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a table with a row for each cell: angle (rad) as index, depth of the bearing and of the journal
        (m).
        """
        table: pandas.DataFrame = self.to_xarray().to_dataframe()
        return table

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write angle (rad) and both depths (m) as CSV, with a line for each cell and all digits."""
        from gudgeon.files.writing import write_bytes
        from gudgeon.language.argument_checks import check_path

        rows = zip(self.angle.tolist(), self.bearing.depth.tolist(), self.journal.depth.tolist(), strict=True)
        text = "".join(f"{angle!r},{bearing!r},{journal!r}\n" for angle, bearing, journal in rows)
        write_bytes(check_path(path, "path"), f"angle,bearing,journal\n{text}".encode())

    def plot(self, ax: Axes | None = None) -> Axes:
        """Plot the depth over the angle in each body's own frame.

        Returns the axes, new ones if `ax` is None.
        """
        from gudgeon.results.figures.run_plots import plot_wear

        return plot_wear(self, ax)


@dataclass(frozen=True, eq=False)
class JointWearResult:
    """Wear of one joint over r rounds of n runs; NaN from the round on in which a run failed."""

    contour: Array  # (r + 1, n, slots) m: depths of the contour's points before each round and after the last one
    depth: Array  # (r, n, points) m, wear depth of a round, times `scale`, at the middles of the cells
    work: Array  # (r, n) N m: ∫ F_n ds of Archard's law, or the dissipation by friction of Reye's, without `scale`
    peak: Array  # (r, n) N, largest force
    radius: Array  # (n,) m
    length: Array  # (n,) m
    journal: Array  # (r, n, points) m, wear depth of the journal in a round, times `scale`, in the journal's own frame
    journal_radius: Array  # (n,) m

    @property
    def journal_volume(self) -> Array:
        """Volume that each round wore off the journal, (r, n), m³; it does not deepen the contours."""
        return np.asarray(self.journal.mean(axis=2) * 2.0 * np.pi * self.journal_radius * self.length)

    @property
    def volume(self) -> Array:
        """Volume that each round wore off the bearing, (r, n), m³."""
        return np.asarray(self.depth.mean(axis=2) * 2.0 * np.pi * self.radius * self.length)

    @property
    def contour_volume(self) -> Array:
        """Volume between each contour and the circle, (r + 1, n), m³: depths preserve the worn volume."""
        return np.asarray(self.contour.mean(axis=2) * 2.0 * np.pi * self.radius * self.length)


@dataclass(frozen=True, eq=False)
class WearRoundsResult:
    """Result of `gudgeon.wear_loop` by joint, with the wear law and its factors."""

    joints: Mapping[str, JointWearResult]
    law: str
    rate: float  # k/H, 1/Pa
    scale: float  # number of runs that each run represents
    failures: Mapping[int, str]  # run -> why, in the round in which it failed
    title: str

    def __repr__(self) -> str:
        """Return joints, law, and the numbers of rounds and runs in one line."""
        rounds, runs = next(iter(self.joints.values())).work.shape
        return f"<WearRoundsResult {', '.join(self.joints)} by {self.law}: {rounds} rounds of {runs} runs>"

    def to_xarray(self) -> xarray.Dataset:
        """Return a Dataset of contours over round, joint, run and slot, of depths over the cells, and of volumes, works
        and peak forces.

        The dimension "slot" counts the points of a contour; contours with fewer points are filled with NaN.
        """
        import xarray

        names, joints = list(self.joints), list(self.joints.values())
        max_slots = max((joint.contour.shape[2] for joint in joints), default=0)
        contour = np.full((len(names), *joints[0].contour.shape[:2], max_slots), np.nan)
        for joint_index, joint in enumerate(joints):
            contour[joint_index, :, :, : joint.contour.shape[2]] = joint.contour
        dimensions, description = ("joint", "round", "run"), "of the bearing, beyond its circle, before each round"
        columns = {
            "contour": (
                ("joint", "state", "run", "slot"),
                contour,
                {"units": "m", "long_name": f"depth {description}"},
            ),
            "depth": ((*dimensions, "angle"), np.stack([joint.depth for joint in joints]), {"units": "m"}),
            "journal": ((*dimensions, "angle"), np.stack([joint.journal for joint in joints]), {"units": "m"}),
            "journal_volume": (dimensions, np.stack([joint.journal_volume for joint in joints]), {"units": "m^3"}),
            "volume": (dimensions, np.stack([joint.volume for joint in joints]), {"units": "m^3"}),
            "work": (dimensions, np.stack([joint.work for joint in joints]), {"units": "N*m"}),
            "peak": (dimensions, np.stack([joint.peak for joint in joints]), {"units": "N"}),
        }
        n_cells = joints[0].depth.shape[2]
        coordinates = {"joint": names, "angle": ("angle", compute_cell_angles(n_cells), {"units": "rad"})}
        attributes = {"law": self.law, "rate": self.rate, "scale": self.scale, "title": self.title}
        return xarray.Dataset(columns, coordinates, attributes)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the Dataset of `to_xarray` as one complete NetCDF file, which `xarray.open_dataset` reads."""
        from gudgeon.files.writing import write_bytes
        from gudgeon.language.argument_checks import check_path

        write_bytes(check_path(path, "path"), bytes(self.to_xarray().to_netcdf(engine="h5netcdf")))


def compute_cell_angles(n_cells: int) -> Array:
    """Return the angles of the middles of `n_cells` equal cells of a circumference, (n_cells,), rad."""
    return (np.arange(n_cells) + 0.5) * (2.0 * np.pi / n_cells)


def compute_shortest_arc(depths: Array, fraction: float = WORN_FRACTION) -> float:
    """Return the length in rad of the shortest arc of whole cells that contains a `fraction` of the sum of `depths`
    (n_cells,).

    Arcs may pass angle 0. Returns NaN if the sum is zero.
    """
    total_depth, n_cells = float(depths.sum()), len(depths)
    if not total_depth > 0.0:
        return np.nan
    cumulated = np.concatenate([[0.0], np.cumsum(np.concatenate([depths, depths]))])
    targets = cumulated[:n_cells] + fraction * total_depth * (1.0 - 1e-12)
    end_cells = np.searchsorted(cumulated, targets, "left")
    return float((end_cells - np.arange(n_cells)).min()) * 2.0 * np.pi / n_cells


def find_bearing_parameters(source: KernelSource, joint: str) -> tuple[int, int, int]:
    """Return the indices in p of bearing radius, journal radius and bearing length of a joint with play.

    Raises StopIteration for another name.
    """
    clearance = next(joint_info for joint_info in source.clearances if joint_info.name == joint)
    radius = clearance.constants["R_i"]
    address_of_bearing = source.parameters[radius].address.rpartition(".")[0]
    length = next(
        k for k, parameter in enumerate(source.parameters) if parameter.address == f"{address_of_bearing}.length"
    )
    return radius, clearance.constants["R_j"], length


def distribute_loads(
    n_cells: int, begin_angles: Array, end_angles: Array, loads: Array, half_widths: Array | None = None
) -> Array:
    """Return the sums by cell, (r, n_cells), of loads (r, K) that are distributed over arcs of a circumference.

    Load k of each row is spread evenly from `begin_angles[k]` to `end_angles[k]` (K,), rad, of any turn. With
    `half_widths` (K,), rad, it is also convolved with a parabola of that half width (Hertzian pressure). A cell
    receives the integral over it, so that sums of loads are preserved.
    """
    per_cell = 2.0 * np.pi / n_cells
    half_width_cells = np.zeros(len(begin_angles)) if half_widths is None else half_widths / per_cell
    begin, end = begin_angles / per_cell, end_angles / per_cell
    end = np.maximum(end, begin + np.maximum(1e-9, 1e-6 * half_width_cells))
    first_cells = np.floor(begin - half_width_cells).astype(np.int64)
    cell_counts = np.floor(end + half_width_cells).astype(np.int64) - first_cells + 1
    arc_indices = np.repeat(np.arange(len(begin)), cell_counts)
    cell = (
        first_cells[arc_indices]
        + np.arange(len(arc_indices))
        - np.repeat(np.cumsum(cell_counts) - cell_counts, cell_counts)
    )
    fraction_left, fraction_right = (
        _compute_load_fraction_below(
            edge, begin[arc_indices], end[arc_indices], None if half_widths is None else half_width_cells[arc_indices]
        )
        for edge in (cell, cell + 1)
    )
    return np.stack(
        [
            np.bincount(cell % n_cells, load_row[arc_indices] * (fraction_right - fraction_left), n_cells)
            for load_row in loads
        ]
    )


def _compute_load_fraction_below(x: Array, begin: Array, end: Array, half_width: Array | None) -> Array:
    """Return the fraction of the load of an arc from `begin` to `end` that lies below x, element by element.

    With `half_width` the uniform load is convolved with a parabola of that half width. None: uniform load.
    """
    if half_width is None:
        return np.asarray(np.clip((x - begin) / (end - begin), 0.0, 1.0))
    half_width = np.maximum(half_width, 1e-9)
    return np.asarray(
        (_integrate_parabola((x - begin) / half_width) - _integrate_parabola((x - end) / half_width))
        * half_width
        / (end - begin)
    )


def _integrate_parabola(s: Array) -> Array:
    """Return the second antiderivative of 3/4 (1 − s²) within ±1 (0 outside), from −1; it is s for s ≥ 1."""
    inside = np.clip(s, -1.0, 1.0)
    return np.asarray((0.75 + inside * (2.0 + inside * (1.5 - 0.25 * inside**2))) / 4.0 + np.maximum(s - 1.0, 0.0))

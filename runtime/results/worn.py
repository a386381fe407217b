"""What wear makes of bearings round by round: contours, depths and volumes of many runs (simulation/wear_loop.py)."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.results.wear import middles

if TYPE_CHECKING:
    import xarray

    from gudgeon.results.state import Array


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

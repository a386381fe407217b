"""Describe joints with play, and bearings that are not circular, for the runtime."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class ClearanceInfo:
    """Describe a joint with play: journal on the second body, bearing on the first.

    Each corner of a slider in its guide is one: "guide.front_upper".
    """

    name: str
    first: int
    second: int
    point: str  # the journal's point
    dry: bool
    film: bool
    clearance: int  # index into p of c
    constants: Mapping[str, int]  # name -> index into p of constants of its laws: K, S, radius …

    @property
    def joint(self) -> str:
        """Return the name of the file's joint."""
        return self.name.partition(".")[0]

    @property
    def film_clearance(self) -> int:
        """Return the index into p of the film's clearance: c plus the film's extra clearance."""
        return self.constants.get("film_clearance", self.clearance)

    @property
    def is_corner(self) -> bool:
        """Return whether it is a slider's corner at a wall of its guide."""
        return "." in self.name


@dataclass(frozen=True)
class ContourInfo:
    """Describe the depths of a bearing beyond its circle: `count` parameters from index `first` on."""

    joint: str
    first: int
    count: int

"""A joint with play, and a bearing that is not a circle, as the runtime knows them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class ClearanceInfo:
    """A joint with play: journal on the second body, bearing on the first.

    Of a guide each corner of its slider is one: "guide.front_upper".
    """

    name: str
    first: int
    second: int
    point: str  # the journal's point
    dry: bool
    film: bool
    clearance: int  # index into p of c
    constants: Mapping[str, int]  # name -> index into p of what is worth printing: K, S, radius …

    @property
    def joint(self) -> str:
        """The file's joint."""
        return self.name.partition(".")[0]

    @property
    def film_clearance(self) -> int:
        """Index into p of the clearance that its film has: c, and what a film adds to it."""
        return self.constants.get("film_clearance", self.clearance)

    @property
    def at_wall(self) -> bool:
        """Whether it is a slider's corner at a wall of its guide."""
        return "." in self.name


@dataclass(frozen=True)
class ContourInfo:
    """The depths of a joint's bearing beyond its circle: `count` slots from the slot `first` on."""

    joint: str
    first: int
    count: int

"""A bearing that is no circle, as the runtime knows it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ContourInfo:
    """The depths of a joint's bearing beyond its circle: `count` slots from the slot `first` on."""

    joint: str
    first: int
    count: int

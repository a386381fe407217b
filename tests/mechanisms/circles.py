"""Linkages by intersections of circles: points are complex numbers or arrays of them, x + iy."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.results.results import Result

Points = Any
Array = NDArray[np.float64]


def point(of: Result, name: str) -> Points:
    """A point of a run."""
    return np.asarray(of[f"{name}.x"] + 1j * of[f"{name}.y"])


def meet(one: Points, r1: float, two: Points, r2: float, side: float) -> Points:
    """Where two circles meet: left of the way from the first centre to the second (side 1), or right of it."""
    d = abs(two - one)
    along = (r1**2 - r2**2 + d**2) / (2 * d)
    return np.asarray(one + (two - one) / d * (along + side * 1j * np.sqrt(r1**2 - along**2)))


def beside(tail: Points, head: Points, x: float, y: float) -> Points:
    """A point of a bar, in its frame."""
    return np.asarray(tail + (head - tail) / abs(head - tail) * (x + 1j * y))


def smooth(t: Array, duration: float) -> Array:
    """smooth_step of the format: 10 s³ − 15 s⁴ + 6 s⁵."""
    s = np.clip(t / duration, 0.0, 1.0)
    return np.asarray(s**3 * (10 - 15 * s + 6 * s**2))

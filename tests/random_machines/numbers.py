"""The numbers of a design: each a parameter with a unit, and how it changes if the machine is seen in another way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

GROUND = "ground"
Dims = tuple[float, float, float]  # exponents of length, mass and time
NONE, LENGTH, MASS, INERTIA = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (2.0, 1.0, 0.0)
TIME, RATE, SPEED = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, -1.0)
FORCE, MOMENT = (1.0, 1.0, -2.0), (2.0, 1.0, -2.0)
ACCELERATION, PRESSURE, VISCOSITY = (1.0, 0.0, -2.0), (-1.0, 1.0, -2.0), (-1.0, 1.0, -1.0)
SYMBOLS = ("m", "kg", "s")


@dataclass(frozen=True)
class Number:
    """A value in SI. `flips`: a mirror changes its sign. `turns`: so many times the angle of a rotation is added."""

    value: float
    dims: Dims = NONE
    flips: bool = False
    turns: int = 0


@dataclass
class Numbers:
    """All numbers of a design by name; pairs of them are vectors, in axes of the ground or of a body."""

    values: dict[str, Number] = field(default_factory=dict)
    vectors: list[tuple[str, str, str, bool]] = field(default_factory=list)  # x, y, whose axes, whether it is a point

    def add(self, value: float, dims: Dims = NONE, flips: bool = False, turns: int = 0, stem: str = "p") -> str:
        """A number; returns the name of its parameter."""
        name = f"{stem}{len(self.values)}"
        self.values[name] = Number(float(value), dims, flips, turns)
        return name

    def vector(self, at: np.ndarray, dims: Dims, axes: str = GROUND, point: bool = False) -> list[str]:
        """Two numbers; `point`: a place in its axes, which depends on where their origin is."""
        pair = [self.add(at[0], dims, stem="x"), self.add(at[1], dims, flips=True, stem="y")]
        self.vectors.append((pair[0], pair[1], axes, point))
        return pair

    def plain(self) -> dict[str, float]:
        return {name: number.value for name, number in self.values.items()}

    def mirrored(self) -> dict[str, float]:
        """As it is seen in a mirror along x."""
        return {name: -n.value if n.flips else n.value for name, n in self.values.items()}

    def rotated(self, angle: float) -> dict[str, float]:
        """Everything in ground axes, gravity too, is turned about the origin."""
        found = {name: n.value + n.turns * angle for name, n in self.values.items()}
        c, s = np.cos(angle), np.sin(angle)
        for x, y, axes, _ in self.vectors:
            if axes == GROUND:
                u, v = self.values[x].value, self.values[y].value
                found |= {x: c * u - s * v, y: s * u + c * v}
        return found

    def scaled(self, units: Dims) -> dict[str, float]:
        """The same machine if lengths, masses and times are counted in units so much smaller."""
        return {
            name: float(n.value * np.prod([u**k for u, k in zip(units, n.dims, strict=True)]))
            for name, n in self.values.items()
        }

    def moved(self, shifts: Mapping[str, np.ndarray]) -> dict[str, float]:
        """The origins of bodies lie elsewhere on them: all points of a body move by its shift."""
        found = self.plain()
        for x, y, axes, point in self.vectors:
            if point and axes in shifts:
                found[x] += float(shifts[axes][0])
                found[y] += float(shifts[axes][1])
        return found

    def section(self) -> dict[str, str]:
        """The file's parameters, with units."""
        return {name: f"{n.value!r}{_unit(n.dims)}" for name, n in self.values.items()}


def _unit(dims: Dims) -> str:
    parts = [symbol if k == 1 else f"{symbol}^{k:g}" for symbol, k in zip(SYMBOLS, dims, strict=True) if k > 0]
    below = [symbol if k == -1 else f"{symbol}^{-k:g}" for symbol, k in zip(SYMBOLS, dims, strict=True) if k < 0]
    if not parts and not below:
        return ""
    return " " + "/".join(["*".join(parts) or "1", *below])

"""Dimensions and the published list of units; pint converts the unit token and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Dimension:
    """Exponents of metre, kilogram and second; an angle has none (rad = 1)."""

    length: Fraction = Fraction(0)
    mass: Fraction = Fraction(0)
    time: Fraction = Fraction(0)


def dimension(length: int = 0, mass: int = 0, time: int = 0) -> Dimension:
    return Dimension(Fraction(length), Fraction(mass), Fraction(time))


DIMENSIONLESS = dimension()
LENGTH = dimension(length=1)
MASS = dimension(mass=1)
TIME = dimension(time=1)
INERTIA = dimension(length=2, mass=1)
ACCELERATION = dimension(length=1, time=-2)
VELOCITY = dimension(length=1, time=-1)
PRESSURE = dimension(length=-1, mass=1, time=-2)
VISCOSITY = dimension(length=-1, mass=1, time=-1)

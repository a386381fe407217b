"""Solve Reynolds' equation of a journal bearing of finite length; the film laws are compared with this solver.

>>> from gudgeon.reynolds import Bearing, solve
>>> pin = Bearing(radius=15e-3, length=30e-3, clearance=30e-6, viscosity=0.03)
>>> film = solve(pin, eccentricity=(18e-6, 0.0), omega_journal=100.0)
>>> film.force, film.error, film.leakage, film.pressure.max()
"""

from gudgeon.reynolds.bearing import Bearing, Film
from gudgeon.reynolds.deviations import Deviation, deviation
from gudgeon.reynolds.solver import solve
from gudgeon.reynolds.tables import Table, table

__all__ = ["Bearing", "Deviation", "Film", "Table", "deviation", "solve", "table"]

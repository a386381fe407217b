"""Butenschön's tables of a bearing of finite length, rotation and squeeze: every valid entry within 1 %."""

from __future__ import annotations

import numpy as np
import pytest

from gudgeon.reynolds import Bearing, Table, table
from tests.oracles.butenschoen import ATTITUDE, ROTATION, SLIPS, SQUEEZE, WIDTHS
from tests.slow import slow_rows_but

CELLS = (128, 16)
COLUMNS = list(enumerate(WIDTHS))


def bearing(width: float) -> Bearing:
    """The fixture's: d = 10 mm, ψ = 1e-3, η = 1e-3 Pa·s."""
    return Bearing(radius=5e-3, length=width * 1e-2, clearance=5e-6, viscosity=1e-3)


def so(found: Table, own: Bearing, rate: float) -> np.ndarray:
    load = np.hypot(*np.moveaxis(found.force, -1, 0))
    return load * (own.clearance / own.radius) ** 2 / (2.0 * own.radius * own.length * own.viscosity * rate)


@pytest.mark.parametrize(("column", "width"), slow_rows_but([COLUMNS[0], COLUMNS[2]], COLUMNS))
def test_rotation(column: int, width: float) -> None:
    """His film begins where the gap is widest. So and β; half of the last digit printed is not counted."""
    own, omega = bearing(width), 2.0 * np.pi * 50.0
    found = table(own, list(ROTATION), 0.0, omega, groove="widest", cells=CELLS)
    want, attitude = (np.array([row[column] for row in rows.values()]) for rows in (ROTATION, ATTITUDE))
    assert (abs(so(found, own, omega) - want) < 0.01 * want + 5e-5).all()
    beta = np.degrees(np.arctan2(found.force[:, 1], -found.force[:, 0]))
    assert (abs(beta - attitude) < 0.01 * attitude).all()


@pytest.mark.parametrize(("column", "width"), slow_rows_but([COLUMNS[0], COLUMNS[2]], COLUMNS))
def test_squeeze(column: int, width: float) -> None:
    own, rate = bearing(width), 100.0
    eps = np.array(list(SQUEEZE))
    found = table(own, abs(eps), np.where(eps < 0.0, -rate, rate), 0.0, cells=CELLS)
    want = np.array([row[column] for row in SQUEEZE.values()])
    valid = np.array([(value, width) not in SLIPS for value in SQUEEZE])
    got = so(found, own, rate)
    assert (abs(got - want) < 0.01 * want + 5e-5)[valid].all()
    assert (abs(got - want) > 0.03 * want)[~valid].all()  # the slips are none of the solver's
    assert abs(found.force[:, 1]).max() < 1e-9 * abs(found.force[:, 0]).max()


@pytest.mark.parametrize(("eps", "width"), sorted(SLIPS))
def test_slips_stay_when_the_grid_is_refined(eps: float, width: float) -> None:
    own = bearing(width)
    load = [so(table(own, abs(eps), np.sign(eps), 0.0, cells=cells), own, 1.0) for cells in (CELLS, (384, 48))]
    assert load[0] == pytest.approx(load[1], rel=1e-3)
    assert abs(load[1] / SQUEEZE[eps][WIDTHS.index(width)] - 1.0) > 0.03

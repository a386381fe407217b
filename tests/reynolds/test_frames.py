"""What must not matter: the frame, who turns, which way; what must: viscosity, in proportion. And what is refused."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

from gudgeon.errors import ArrayError, BadValueError
from gudgeon.reynolds import Bearing, solve, table

BEARING = Bearing(radius=15e-3, length=20e-3, clearance=30e-6, viscosity=0.03)
E, V, OMEGA = np.array([15e-6, 9e-6]), np.array([3e-4, -5e-4]), 80.0
CELLS = (96, 12)
KINDS = ["half_sommerfeld", "reynolds", "elrod_adams"]


def turned(vector: np.ndarray, angle: float) -> np.ndarray:
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]) @ vector


@pytest.mark.parametrize("cavitation", KINDS)
def test_the_frame_does_not_matter(cavitation: str) -> None:
    """Turned, mirrored, and seen from one that turns: the same film."""
    one = solve(BEARING, E, V, omega_journal=OMEGA, cavitation=cavitation, groove=2.0, cells=CELLS)
    other = solve(
        BEARING, turned(E, 1.0), turned(V, 1.0), omega_journal=OMEGA, cavitation=cavitation, groove=3.0, cells=CELLS
    )
    size = float(np.hypot(*one.force))
    assert other.force == pytest.approx(turned(one.force, 1.0), abs=1e-9 * size)
    mirror = np.array([1.0, -1.0])
    other = solve(
        BEARING, mirror * E, mirror * V, omega_journal=-OMEGA, cavitation=cavitation, groove=-2.0, cells=CELLS
    )
    assert other.force == pytest.approx(mirror * one.force, abs=1e-9 * size)
    assert other.attitude == pytest.approx(-one.attitude, abs=1e-9)
    assert other.torque_journal == pytest.approx(-one.torque_journal, rel=1e-9)
    assert other.leakage == pytest.approx(one.leakage, rel=1e-9)
    spin = 37.0
    other = solve(
        BEARING,
        E,
        V + spin * np.array([-E[1], E[0]]),
        omega_journal=OMEGA + spin,
        omega_bearing=spin,
        cavitation=cavitation,
        groove=2.0,
        cells=CELLS,
    )
    assert other.force == pytest.approx(one.force, abs=1e-9 * size) and other.omega_s == pytest.approx(one.omega_s)


@pytest.mark.parametrize("cavitation", KINDS)
def test_turning_back_mirrors_a_steady_film(cavitation: str) -> None:
    one, back = (solve(BEARING, E, omega_journal=w, cavitation=cavitation, cells=CELLS) for w in (OMEGA, -OMEGA))
    assert (back.radial, back.tangential) == pytest.approx((one.radial, -one.tangential), rel=1e-10)
    assert one.pressure[1:] == pytest.approx(back.pressure[:0:-1], abs=1e-9 * one.pressure.max())
    assert one.pressure == pytest.approx(one.pressure[:, ::-1], abs=0.0)


@pytest.mark.parametrize("cavitation", KINDS)
def test_viscosity_and_rates_in_proportion(cavitation: str) -> None:
    one = solve(BEARING, E, V, omega_journal=OMEGA, cavitation=cavitation, cells=CELLS)
    thick = Bearing(BEARING.radius, BEARING.length, BEARING.clearance, 2.5 * BEARING.viscosity)
    twice = solve(thick, E, 2.0 * V, omega_journal=2.0 * OMEGA, cavitation=cavitation, cells=CELLS)
    assert twice.force == pytest.approx(5.0 * one.force, rel=1e-11)
    assert twice.torque_bearing == pytest.approx(5.0 * one.torque_bearing, rel=1e-11)
    assert twice.leakage == pytest.approx(2.0 * one.leakage, rel=1e-11)


def test_half_the_rate_of_whirl_carries_nothing() -> None:
    """ω_s = 0 at a whirl of half the speed: the film does not wedge."""
    whirl = 0.5 * OMEGA * np.array([-E[1], E[0]])
    still = solve(BEARING, E, whirl, omega_journal=OMEGA)
    steady = solve(BEARING, E, omega_journal=OMEGA)
    assert still.omega_s == pytest.approx(0.0, abs=1e-12)
    assert np.hypot(*still.force) < 1e-12 * np.hypot(*steady.force)


def test_a_film_says_where_it_is() -> None:
    """In the middle a steady film begins about the widest gap and ends behind the thinnest."""
    one = solve(BEARING, E, omega_journal=OMEGA, groove="widest")
    thinnest = math.atan2(E[1], E[0])
    assert one.extent is not None
    begins, ends = (x - thinnest for x in one.extent)
    assert begins == pytest.approx(-math.pi, abs=0.1) and 0.1 < ends < 1.0
    assert one.thickness.min() == pytest.approx(BEARING.clearance - math.hypot(*E), rel=1e-12)
    assert one.angle[np.argmin(one.thickness)] == pytest.approx(thinnest, abs=1e-12)
    assert one.z[[0, -1]] == pytest.approx([-0.01, 0.01]) and one.pressure.shape == (len(one.angle), len(one.z))
    nothing = solve(BEARING, (0.0, 0.0))
    assert nothing.extent is None and not nothing.force.any() and nothing.attitude == nothing.error == 0.0
    assert (pickle.loads(pickle.dumps(one)).force == one.force).all()


def test_a_table_is_what_solve_finds() -> None:
    eps, rates = np.array([0.3, 0.6]), np.array([[0.0], [20.0], [-20.0]])
    found = table(BEARING, eps, rates, OMEGA, cells=CELLS)
    assert found.force.shape == (3, 2, 2) and found.error.shape == found.eps.shape == found.omega_s.shape == (3, 2)
    c = BEARING.clearance
    for at in np.ndindex(3, 2):
        e, v = (float(x[at]) * c for x in (found.eps, found.eps_rate))
        one = solve(BEARING, (e, 0.0), (v, 0.0), omega_journal=OMEGA, cells=CELLS)
        assert found.force[at] == pytest.approx([one.radial, one.tangential], rel=1e-9)
        assert found.error[at] == pytest.approx(one.error, rel=1e-6)
    assert table(BEARING, 0.5, cells=CELLS).force.shape == (2,)


def test_the_picture() -> None:
    one = solve(BEARING, E, omega_journal=OMEGA, cavitation="elrod_adams", groove=2.0, cells=CELLS)
    left, right = one.plot().axes[:2]
    assert left.get_xlim()[0] == pytest.approx(math.degrees(one.angle[0])) and right.get_title()
    assert solve(BEARING, (0.0, 0.0)).plot().axes


SHAPE = {"radius": 0.01, "length": 0.02, "clearance": 1e-5, "viscosity": 0.1}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"length": -0.02}, "length is -0.02: expected a number above zero"),
        ({"radius": 0}, "above zero"),
        ({"viscosity": math.nan}, "finite"),
        ({"clearance": "1e-5"}, "clearance: '1e-5'"),
        ({"viscosity": True}, "True"),
        ({"clearance": 2e-3}, "tenth of the radius"),
        ({"length": math.inf}, "finite"),
        ({"radius": 10**400}, "radius"),
        ({"length": np.timedelta64(3, "s")}, "length"),
    ],
)
def test_bearings_that_are_none(change: dict[str, Any], message: str) -> None:
    with pytest.raises(BadValueError, match=message):
        Bearing(**{**SHAPE, **change})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"eccentricity": (30e-6, 0.0)}, "1 times the clearance"),
        ({"eccentricity": (1.0, 2.0, 3.0)}, "eccentricity"),
        ({"eccentricity": (math.nan, 0.0)}, "eccentricity"),
        ({"rate": (math.inf, 0.0)}, "rate"),
        ({"omega_journal": math.inf}, "omega_journal"),
        ({"omega_bearing": "1"}, "omega_bearing"),
        ({"cavitation": "gumbel"}, "half_sommerfeld, reynolds or elrod_adams"),
        ({"ends": None}, "open or sealed"),
        ({"groove": "top"}, "groove"),
        ({"groove": math.nan}, "groove"),
        ({"cells": (100, 10)}, "multiples of 4"),
        ({"cells": 100}, "cells"),
        ({"cells": (96.0, 12)}, "cells"),
        ({"cells": (2**20, 2**10)}, "2000000 cells"),
        ({"omega_journal": 10**400}, "omega_journal"),
        ({"bearing": {"radius": 1.0}}, "bearing is dict"),
        ({"omega_journal": 1e308, "cells": CELLS}, "out of range for doubles"),
    ],
)
def test_questions_that_are_none(change: dict[str, Any], message: str) -> None:
    with pytest.raises(BadValueError, match=message):
        solve(**{"bearing": BEARING, "eccentricity": (1e-6, 0.0), **change})


def test_tables_that_are_none() -> None:
    for eps, message in ((1.0, "less than 1"), (-0.1, "expected 0 or more"), (math.nan, "eps")):
        with pytest.raises(BadValueError, match=message):
            table(BEARING, [0.5, eps], omega_s=1.0)
    with pytest.raises(BadValueError, match="cannot be broadcast"):
        table(BEARING, [0.5, 0.6], [1.0, 2.0, 3.0])
    with pytest.raises(BadValueError, match="4000000 states together"):
        table(BEARING, np.full((2000, 1), 0.5), np.zeros(2000))
    with pytest.raises(BadValueError, match="bearing is None"):
        table(None, 0.5)  # type: ignore[arg-type]
    with pytest.raises(ArrayError):
        table(BEARING, "half")
    with pytest.raises(BadValueError, match="groove"):
        table(BEARING, 0.5, groove=1.0)  # type: ignore[arg-type]

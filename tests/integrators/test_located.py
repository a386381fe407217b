"""How near their zeros events are located: as the tolerance asks."""

from __future__ import annotations

import math

import pytest

import gudgeon


@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
@pytest.mark.parametrize("rtol", [1e-3, 1e-5, 1e-9])
def test_a_contact_begins_as_near_its_zero_as_the_tolerance_asks(method: str, rtol: float) -> None:
    """A fall is a parabola, which a step meets to rounding: what t_on is late by is its location alone."""
    fall = math.sqrt(2.0 / 9.81)
    run = gudgeon.load("bouncing_ball", "elastic").simulate(0.46, output=1, method=method, rtol=rtol)
    (onset,) = run.impacts["t_on"]
    assert -1e-14 < onset - fall < max(min(1e-9, rtol**2) * fall, 1e-12)

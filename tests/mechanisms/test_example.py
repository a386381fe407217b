"""Example: a shipped mechanism against its closed form. An invalid file is a row in `invalid.py` instead."""

from __future__ import annotations

import numpy as np
import pytest

import gudgeon
from tests.programs import needs_compiler

pytestmark = [needs_compiler, pytest.mark.plain]


def test_the_scotch_yoke_moves_as_a_cosine() -> None:
    """The slot holds the crank pin, r = 40 mm from the pivot: x = r cos θ."""
    run = gudgeon.load("scotch_yoke").simulate(output=100)
    np.testing.assert_allclose(run["yoke.x"], 0.04 * np.cos(run["crank.theta"]), atol=1e-12)

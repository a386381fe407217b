"""Example: a result without a compiler. `make_items` gives a Result of a slider whose motion has a closed form."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gudgeon.results.results import Result


def test_a_derivative_is_the_rate_of_its_series(make: Callable[..., Result]) -> None:
    """Central differences of the crank's x against its velocity, of order 2."""
    run = make("ideal", samples=2001)
    x, vx = run["L1.x"], run["L1.vx"]
    differences = (x[2:] - x[:-2]) / (run.t[2:] - run.t[:-2])
    np.testing.assert_allclose(differences, vx[1:-1], atol=1e-5)

"""Example: forces of a film against a property that holds exactly: they are linear in the viscosity."""

from __future__ import annotations

import numpy as np

from gudgeon.reynolds import Bearing, table


def test_forces_are_proportional_to_the_viscosity() -> None:
    shape = {"radius": 0.02, "length": 0.02, "clearance": 4e-5}
    thin, thick = (
        table(Bearing(viscosity=mu, **shape), [0.3, 0.6], 0.0, 10.0, cells=(32, 4)).force for mu in (0.01, 0.03)
    )
    np.testing.assert_allclose(thick, 3.0 * thin, rtol=1e-10)

"""The number that a vanished pivot returns: which row depends on those before it."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from gudgeon.generator.pipeline import derive_scene
from gudgeon.loading.shipped import find_shipped_file
from tests.slow import slow_but

LEAST = {"slider_crank": 1, "four_bar": 2, "n_four_bar": 4}  # so many rows at least


@pytest.mark.parametrize("name", slow_but(["slider_crank", "four_bar"], LEAST))
def test_a_status_names_the_first_row_that_depends_on_those_before_it(name: str) -> None:
    """One to three bodies turned level, upright or slanting, so in one line; against ranks of Φ_q M^(-1/2)."""
    model = derive_scene(find_shipped_file(name).read_bytes(), name, "ideal").numpy()
    p, rng, found = model.prepare(), np.random.default_rng(1), set()
    names = [row.name for row in model.model.all_rows]
    numbered = [(k, names.index(pivot)) for k, pivot in enumerate(model.program.kkt.pivots, 1) if pivot in names]
    numbers, places = zip(*numbered, strict=True)  # other pivots are those of light coordinates
    bodies = range(model.n // 3)
    for angle in (0.0, 0.7, np.pi / 2):
        for turned in (k for count in (1, 2, 3) for k in combinations(bodies, count)):
            q, v = rng.uniform(-1.0, 1.0, (2, model.n))
            q[[3 * k + 2 for k in turned]] = angle
            rows = (model.phi_q(0.0, q, p) / np.sqrt(model.mass(p)))[list(places)]
            ranks = [np.linalg.matrix_rank(rows[:k], tol=1e-6) for k in range(1, len(rows) + 1)]
            first = next((numbers[k - 1] for k, rank in enumerate(ranks, 1) if rank < k), 0)
            assert model.dynamics(0.0, q, v, p).status == first
            found.add(first)
    assert len(found - {0}) >= LEAST[name]

"""Large mechanisms: what is sparse agrees with LAPACK, and nothing dense is asked, which keeps Ctrl-C waiting."""

from __future__ import annotations

import numpy as np
import pytest

from gudgeon.assembly import large, rank
from gudgeon.assembly.large import solve_minimum_norm
from gudgeon.model.compiled import Array

N = 30  # squares: 183 coordinates


def squares(angle: float, n: int = N) -> Array:
    """Φ_q of n four-bars side by side, bars of 1 m, cranks at an angle (rad), couplers along the ground.

    Rows: a crank's tail on the ground, a coupler's ends on the heads of two cranks. Columns: x, y, θ of n + 1 cranks,
    then of n couplers.
    """
    bars, rows = [angle] * (n + 1) + [0.0] * n, []

    def row(ends: list[tuple[int, float]]) -> None:
        """One point, the end (−½ or ½ m) of a bar, minus the next."""
        for axis in range(2):
            row = np.zeros(3 * len(bars))
            for sign, (bar, end) in zip((1.0, -1.0), ends, strict=False):
                row[3 * bar + axis] += sign
                row[3 * bar + 2] += sign * end * (-np.sin(bars[bar]), np.cos(bars[bar]))[axis]
            rows.append(row)

    for crank in range(n + 1):
        row([(crank, -0.5)])
    for coupler in range(n):
        row([(coupler, 0.5), (n + 1 + coupler, -0.5)])
        row([(n + 1 + coupler, 0.5), (coupler + 1, 0.5)])
    return np.array(rows)


@pytest.mark.parametrize("angle", [1.5, 0.05, 0.0])
@pytest.mark.parametrize("least", [1e-9, 1e-6, 1e-4])
def test_rank_and_tied_rows_are_those_of_a_dense_decomposition(angle: float, least: float) -> None:
    matrix = squares(angle)
    assert matrix.shape[1] >= large.MIN_SPARSE_COORDINATES
    assert (
        rank.compute_rank(matrix, least)
        == rank._compute_rank_by_svd(matrix, least)
        == len(matrix) - (N if angle == 0.0 else 0)
    )
    dense = rank._compute_left_null_maxima_by_svd(matrix, least) > 1e-6
    assert (rank.compute_left_null_maxima(matrix, least) > 1e-6).tolist() == dense.tolist()
    assert dense.any() == (angle == 0.0)


def test_rows_beyond_the_columns_or_no_numbers_are_not_taken_for_independent() -> None:
    matrix = squares(1.5)
    assert large.has_independent_rows(matrix, 1e-9)
    assert not large.has_independent_rows(np.vstack([matrix, matrix[:3]]), 1e-9)
    assert not large.has_independent_rows(np.where(matrix == 1.0, np.nan, matrix), 1e-9)
    assert not large.estimate_left_null_maxima(np.where(matrix == 1.0, np.nan, matrix), 1e-6).any()


@pytest.mark.parametrize("angle", [1.5, 0.0])
def test_steps_are_those_of_least_squares(angle: float) -> None:
    matrix, rng = squares(angle), np.random.default_rng(0)
    target = matrix @ rng.standard_normal(matrix.shape[1])
    expected = np.linalg.lstsq(matrix, target, rcond=1e-12)[0]
    assert solve_minimum_norm(matrix, target) == pytest.approx(expected, abs=1e-7)
    places = matrix[:, np.arange(matrix.shape[1]) % 3 != 2]  # more rows than columns: as Newton begins
    assert len(places) > places.shape[1]
    target = rng.standard_normal(len(places))
    expected = np.linalg.lstsq(places, target, rcond=1e-12)[0]
    assert large.solve_damped_least_squares(places, target) == pytest.approx(expected, abs=1e-5)


def test_no_configuration_costs_a_dense_decomposition(monkeypatch: pytest.MonkeyPatch) -> None:
    """Seconds on busy cores, after each run and while Ctrl-C waits."""

    def dense(*_: object, **__: object) -> None:
        raise AssertionError("LAPACK was asked")

    matrix, flat = squares(1.5), squares(0.0)
    redundant, target = np.vstack([matrix, matrix[:3]]), matrix @ np.ones(matrix.shape[1])
    monkeypatch.setattr(np.linalg, "svd", dense)
    monkeypatch.setattr(np.linalg, "lstsq", dense)
    assert rank.compute_rank(matrix) == len(matrix) and rank.compute_left_null_maxima(matrix).max() < 1e-12
    assert rank.compute_left_null_maxima(flat, 1e-6).any()  # of a dead centre too
    assert rank.compute_rank(redundant) == len(matrix) and (rank.compute_left_null_maxima(redundant) > 1e-6).sum() >= 6
    assert redundant @ solve_minimum_norm(redundant, np.append(target, target[:3])) == pytest.approx(
        np.append(target, target[:3]), abs=1e-12
    )

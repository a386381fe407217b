"""Kinds of motion, of maps whose motion is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gudgeon.results.motion import N_FREQUENCIES, classify_motion, compute_zero_one_test


def logistic(r: float, count: int = 600) -> np.ndarray:
    x, found = 0.3, []
    for k in range(1000 + count):
        x = r * x * (1.0 - x)
        if k >= 1000:
            found.append(x)
    return np.array(found)[:, None]


def turning(share: float, count: int = 600) -> np.ndarray:
    angle = 2.0 * math.pi * share * np.arange(count)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


@pytest.mark.parametrize(("r", "period", "rate"), [(2.8, 1, math.log(0.8)), (3.2, 2, -0.9163), (3.5, 4, -0.8725)])
def test_the_logistic_map_doubles_its_period(r: float, period: int, rate: float) -> None:
    found = classify_motion(logistic(r), 0.3, rate, 0.01)
    assert (found.kind, found.period) == ("periodic", period) and found.confidence > 0.99
    assert (classify_motion(logistic(r), 0.3).kind, found.nearest) == ("periodic", period)


def test_at_four_it_is_chaotic() -> None:
    found = classify_motion(logistic(4.0), 0.3, math.log(2.0), 0.02)
    assert found.kind == "chaotic" and found.period == 0 and found.K > 0.9
    assert "chaotic, confidence" in repr(found)
    assert classify_motion(logistic(4.0), 0.3).kind == "chaotic"


def test_a_turn_by_the_golden_section_is_quasi_periodic() -> None:
    found = classify_motion(turning((math.sqrt(5.0) - 1.0) / 2.0), 1.0, 1e-4, 1e-3)
    assert found.kind == "quasi-periodic" and abs(found.K) < 0.1
    assert classify_motion(turning(3.0 / 7.0), 1.0, 0.0, 1e-3).period == 7


def henon(a: float, x: float, count: int) -> tuple[np.ndarray, float, float]:
    """Points of x ← 1 − a x² + y, y ← .3 x, the exponent by its tangent, and a standard error of ten blocks."""
    y, z, points, logs = 0.0, np.array([1.0, 0.0]), [], []
    for _ in range(500 + count):
        z = np.array([[-2.0 * a * x, 1.0], [0.3, 0.0]]) @ z
        x, y = 1.0 - a * x * x + y, 0.3 * x
        points.append((x, y))
        logs.append(math.log(np.linalg.norm(z)))
        z /= np.linalg.norm(z)
    blocks = np.array(logs[500:]).reshape(10, -1).mean(axis=1)
    return np.array(points[500:]), float(blocks.mean()), float(np.std(blocks, ddof=1) / math.sqrt(10.0))


def test_chaos_in_narrow_bands_is_no_torus() -> None:
    """Hénon's map at a = 1.06: points go from band to band in turn, λ = .046; at 1.4 (λ = .419) there is one band."""
    for x in (-0.09, -0.05, 0.0, 0.03, 0.06, 0.1):
        points, rate, error = henon(1.06, x, 150)
        assert classify_motion(points, 1.0, rate, error).kind in ("undecided", "chaotic")
        points, rate, error = henon(1.4, x, 150)
        assert abs(rate - 0.419) < 4.0 * error and classify_motion(points, 1.0, rate, error).kind == "chaotic"


def test_what_signs_do_not_agree_on_is_undecided() -> None:
    """Random points that do not grow apart, turns that do, too few points, and an exponent of either sign."""
    draws = np.random.default_rng(3).standard_normal((600, 1))
    for points, rate, error in (
        (draws, -0.5, 0.01),
        (turning(0.618034), 0.5, 0.01),
        (logistic(4.0, 30), 0.69, 0.01),
        (logistic(4.0), 0.2, 0.4),
    ):
        found = classify_motion(points, 1.0, rate, error)
        assert found.kind == "undecided" and found.period == 0


def test_the_0_1_test_is_that_of_gottwald_and_melbourne() -> None:
    """r from 3.5 to 4: 0 in windows of periods, 1 in chaos (their figure 2)."""
    assert abs(compute_zero_one_test(logistic(3.55)[:, 0])) < 0.1
    assert compute_zero_one_test(logistic(3.97, 2000)[:, 0]) > 0.95
    assert abs(compute_zero_one_test(turning(math.sqrt(2.0), 2000)[:, 0])) < 0.1
    assert math.isnan(compute_zero_one_test(np.arange(39.0)))


def test_the_0_1_test_written_in_loops() -> None:
    """In loops, as G. A. Gottwald and I. Melbourne (2009) have it: p, q, M(n), D(n), the median of correlations."""
    x, found = logistic(3.97, 120)[:, 0], []
    N, most = len(x), len(x) // 10
    for c in np.random.default_rng(1).uniform(math.pi / 5, 4 * math.pi / 5, N_FREQUENCIES):
        p = [sum(x[j - 1] * math.cos(j * c) for j in range(1, n + 1)) for n in range(1, N + 1)]
        q = [sum(x[j - 1] * math.sin(j * c) for j in range(1, n + 1)) for n in range(1, N + 1)]
        D = []
        for n in range(1, most + 1):
            M = sum((p[j + n] - p[j]) ** 2 + (q[j + n] - q[j]) ** 2 for j in range(N - most)) / (N - most)
            D.append(M - x.mean() ** 2 * (1.0 - math.cos(n * c)) / (1.0 - math.cos(c)))
        found.append(np.corrcoef(range(1, most + 1), D)[0, 1])
    assert compute_zero_one_test(x) == pytest.approx(np.median(found), rel=1e-10)

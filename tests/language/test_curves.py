"""Splines: against SciPy's, outside their range, stored and read again."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from gudgeon.language.curves import ENDS, MIN_POINTS, Curve, compute_spline, make_even_pieces
from gudgeon.language.tree import CurveCall, Name, evaluate, from_json, list_functions, to_json

SCIPY = {"natural": "natural", "clamped": "clamped", "periodic": "periodic", "not_a_knot": "not-a-knot"}


def points(n: int, ends: str) -> tuple[list[float], list[float]]:
    rng = np.random.default_rng(n)
    x, y = np.cumsum(rng.uniform(0.2, 1.8, n)).tolist(), rng.normal(size=n).tolist()
    return x, [*y[:-1], y[0] if ends == "periodic" else y[-1]]


@pytest.mark.parametrize(("n", "ends"), [(n, e) for n in (2, 3, 4, 5, 40, 1000) for e in ENDS if n >= MIN_POINTS[e]])
def test_values_and_derivatives_are_those_of_scipy(n: int, ends: str) -> None:
    x, y = points(n, ends)
    knots, pieces = (
        make_even_pieces(x, compute_spline(x, y, ends))
        if ends == "periodic"
        else (tuple(x), compute_spline(x, y, ends))
    )
    curve, theirs = Curve("c", knots, pieces, ends), CubicSpline(x, y, bc_type=SCIPY[ends])
    far = 3.0 * (x[-1] - x[0]) if ends == "periodic" else 0.0
    at = np.random.default_rng(1).uniform(x[0] - far, x[-1] + far, 500)
    for order in range(4):
        want = theirs(at, order)
        assert np.abs(curve.evaluate(at, order) - want).max() < 1e-13 * max(1.0, np.abs(want).max()) * (1.0 + far)


@pytest.mark.parametrize(
    ("extrapolate", "down", "up"),
    [("none", np.nan, np.nan), ("hold", 1.0, 4.0), ("line", 1.0 - 2.0 * 0.5, 4.0 + 3.0 * 0.5)],
)
def test_outside_its_range(extrapolate: str, down: float, up: float) -> None:
    """2 and 3 are the slopes at both ends."""
    x, slopes = (0.0, 1.0), (2.0, 3.0)
    pieces = ((1.0, slopes[0], 3.0 * 3.0 - 2.0 * 2.0 - 3.0, 2.0 + 3.0 - 2.0 * 3.0),)
    curve = Curve("c", x, pieces, extrapolate=extrapolate)
    np.testing.assert_allclose(curve.evaluate(np.array([-0.5, 0.0, 1.0, 1.5])), [down, 1.0, 4.0, up], rtol=1e-15)
    assert curve.evaluate(1.0 + 1e-10) == pytest.approx(4.0)
    if extrapolate != "none":
        step = 1e-6
        for at in (-0.5, 0.4, 1.5):
            risen = (curve.evaluate(at + step) - curve.evaluate(at - step)) / (2 * step)
            assert curve.evaluate(at, 1) == pytest.approx(risen, abs=1e-8)


def test_a_stored_call_is_read_again_to_the_bit() -> None:
    x, y = points(9, "natural")
    curve = Curve("lift", tuple(x), compute_spline(x, y, "natural"), extrapolate="hold", unit="m")
    call = CurveCall("lift", (Name("t"),), curve=curve)
    again = from_json(json.loads(json.dumps(to_json(call))))
    assert again == call
    assert list_functions(again) == {"min", "max"}  # its rate jumps at both ends
    at = np.linspace(x[0] - 1.0, x[-1] + 1.0, 100)
    assert (evaluate(again, lambda _: at) == curve.evaluate(at)).all()

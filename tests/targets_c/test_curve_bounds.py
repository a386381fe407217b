"""Bounds of curves in C: no value, slope or knot lies outside them, and they are not much wider than need be."""

from __future__ import annotations

import ctypes
import subprocess
from pathlib import Path

import numpy as np
import pytest

from gudgeon.generator.targets.c.curves import print_curve_tables
from gudgeon.language.curves import Curve, compute_spline, make_even_pieces
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import build_include_flags
from tests.slow import slow_but

_HEAD = """#include <math.h>
#include <stddef.h>
enum { RATE_JUMPS = 0 };
#include <float.h>
#include "engine/scene/numbers.h"
#include "engine/watch/ranges.h"
"""
_CALLS = """
double value(int order, double x, double side) { return curve_on(CURVE_c_, order, x, side); }
double knot(double x) { return knots(CURVE_c_, x); }
void bounds(int order, double lo, double hi, double side, double *out)
{
    const Interval x = {lo, hi, 1.0, 1.0, 0};
    const Interval y = order < 0 ? interval_knots(CURVE_c_, x)
        : interval_curve_on(CURVE_c_, order, x, make_interval(side));
    out[0] = y.lo, out[1] = y.hi, out[2] = y.min_slope, out[3] = y.max_slope;
}
"""


def compiled(curve: Curve, folder: Path) -> ctypes.CDLL:
    text = print_curve_tables({"c": curve}, ["curve(CURVE_c_, 0, x)"])
    (folder / "c.c").write_text(_HEAD + text + _CALLS)
    line = [*find_compiler(), "-O1", "-std=c11", "-fPIC", "-shared", *build_include_flags(), "c.c", "-lm", "-o", "c.so"]
    subprocess.run(line, cwd=folder, check=True)
    library = ctypes.CDLL(str(folder / "c.so"))
    library.value.restype = library.knot.restype = ctypes.c_double
    return library


@pytest.mark.parametrize("ends", slow_but(["periodic"], ["natural", "periodic"]))
def test_values_and_slopes_lie_within(ends: str, tmp_path: Path) -> None:
    rng = np.random.default_rng(7)
    x = np.cumsum(rng.uniform(0.3, 2.0, 8)).tolist()
    y = rng.normal(size=8).tolist()
    y[-1] = y[0]
    knots, pieces = (
        make_even_pieces(x, compute_spline(x, y, ends))
        if ends == "periodic"
        else (tuple(x), compute_spline(x, y, ends))
    )
    curve = Curve("c", knots, pieces, ends)
    library, number = compiled(curve, tmp_path), ctypes.c_double
    length, wide, out = x[-1] - x[0], [], (ctypes.c_double * 4)()
    for _ in range(300):
        room = length if ends == "periodic" else 0.0
        lo = rng.uniform(x[0] - room, x[-1] + room)
        hi = min(lo + rng.uniform(0, 1) ** 3 * 1.2 * length, np.inf if room else x[-1])
        at = np.linspace(lo, hi, 200)
        for order in range(-1, 3):
            for side in (0.0,) if order < 0 else (0.0, 1.0, -1.0):
                natural = [library.knot(number(z)) for z in at]
                held = side == 0.0 or all(np.sign(natural) * side >= 0)  # in pieces of that side, as steps are
                if not held:
                    continue
                found = [
                    library.value(order, number(z), number(side)) if order >= 0 else n
                    for z, n in zip(at, natural, strict=True)
                ]
                library.bounds(order, number(lo), number(hi), number(side), out)
                assert out[0] - 1e-12 <= min(found) and max(found) <= out[1] + 1e-12
                rises = np.diff(found) / np.maximum(np.diff(at), 1e-300)
                assert out[2] - 1e-6 <= rises.min(initial=np.inf) and rises.max(initial=-np.inf) <= out[3] + 1e-6
                if side == 0.0 and order >= 0:
                    np.testing.assert_allclose(found, curve.evaluate(at, order), atol=1e-13)
                    wide.append((out[1] - out[0]) / max(np.ptp(found), 1e-9))
    assert np.median(wide) < 1.01


def test_beyond_a_knot_the_polynomial_goes_on(tmp_path: Path) -> None:
    """Held on one side the third derivative does not jump; not held, it does."""
    x = [0.0, 1.0, 2.0, 3.0, 4.0]
    for ends, y in (("natural", [0.0, 1.0, -1.0, 2.0, 0.5]), ("periodic", [0.0, 1.0, -1.0, 2.0, 0.0])):
        folder = tmp_path / ends
        folder.mkdir()
        curve = Curve("c", tuple(x), compute_spline(x, y, ends), ends)
        library, number = compiled(curve, folder), ctypes.c_double
        for knot in (1.0, 2.0, 3.0, *([4.0, 8.0] if ends == "periodic" else [])):
            side = np.sign(library.knot(number(knot - 0.1)))
            before, held = (library.value(3, number(knot + d), number(side)) for d in (-0.1, 0.1))
            assert before == held != library.value(3, number(knot + 0.1), number(0.0))
            assert library.knot(number(knot)) == 0.0

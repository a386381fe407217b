"""mod in C: NumPy's remainder; on a side it goes on smoothly; nothing lies outside its bounds, which are close."""

from __future__ import annotations

import ctypes
import subprocess

import numpy as np
import pytest

from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import build_include_flags

_TEXT = """#include <float.h>
#include <math.h>
#include <stddef.h>
enum { RATE_JUMPS = 0 };
#include "engine/scene/numbers.h"
#include "engine/watch/ranges.h"
double value(double a, double b, double side)
{
    return side == 2.0 ? mod_switching_function(a, b) : mod_on_branch(a, b, side);
}
void bounds(double lo, double hi, double b, double side, double *out)
{
    const Interval a = {lo, hi, 1.0, 1.0, 0};
    const Interval y = side == 2.0 ? interval_mod_switching_function(a, make_interval(b))
        : interval_mod_on_branch(a, make_interval(b), make_interval(side));
    out[0] = y.lo, out[1] = y.hi, out[2] = y.min_slope, out[3] = y.max_slope;
}
"""
PERIODS = 2.0  # in place of a side: the function that tells sides


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    folder = tmp_path_factory.mktemp("periods")
    (folder / "m.c").write_text(_TEXT)
    line = [*find_compiler(), "-O1", "-std=c11", "-fPIC", "-shared", *build_include_flags(), "m.c", "-lm", "-o", "m.so"]
    subprocess.run(line, cwd=folder, check=True)
    found = ctypes.CDLL(str(folder / "m.so"))
    found.value.restype, found.value.argtypes = ctypes.c_double, [ctypes.c_double] * 3
    found.bounds.argtypes = [*[ctypes.c_double] * 4, ctypes.c_void_p]
    return found


def test_values(library: ctypes.CDLL) -> None:
    rng = np.random.default_rng(3)
    for a, b in rng.uniform(-5.0, 5.0, (500, 2)):
        natural, k = np.mod(a, b), np.floor(a / b)
        own = 1.0 if k % 2 == 0 else -1.0
        for side in (0.0, own):
            assert abs(library.value(a, b, side) - natural) < 1e-13
        beyond = natural + b if a / b - k < 0.5 else natural - b  # in the neighbour whose side it is
        assert abs(library.value(a, b, -own) - beyond) < 1e-13
        assert np.sign(library.value(a, b, PERIODS)) == own
    for k in range(-4, 5):
        assert abs(library.value(0.3 * k, 0.3, PERIODS)) < 1e-14
        at_end = library.value(2.0 * k, 2.0, PERIODS)  # of the period that begins there
        assert library.value(2.0 * k, 2.0, 0.0) == 0.0 and (at_end < 0.0) == (k % 2 == 1) and abs(at_end) < 1e-300
    for b in (2.0, -2.0):  # so little behind an end that mod is rounded to it
        assert library.value(-1e-20 * b, b, 0.0) == b and library.value(-1e-20 * b, b, PERIODS) < 0.0


@pytest.mark.parametrize("side", [0.0, 1.0, -1.0, PERIODS])
def test_bounds(library: ctypes.CDLL, side: float) -> None:
    rng, wide = np.random.default_rng(11), []
    out = np.zeros(4)
    for _ in range(400):
        b, lo = rng.choice([-1.0, 1.0]) * rng.uniform(0.2, 2.0), rng.uniform(-6.0, 6.0)
        hi = lo + (0.01 + rng.uniform(0.0, 1.0) ** 3 * 5.0) * abs(b)
        at = np.linspace(lo, hi, 300)
        found = np.array([library.value(a, b, side) for a in at])
        library.bounds(lo, hi, b, side, out.ctypes.data)
        assert out[0] - 1e-12 <= found.min() and found.max() <= out[1] + 1e-12
        rises = np.diff(found) / np.maximum(np.diff(at), 1e-300)
        assert out[2] - 1e-6 <= rises.min() and rises.max() <= out[3] + 1e-6
        wide.append((out[1] - out[0]) / max(np.ptp(found), 1e-9))
    assert np.median(wide) < 1.01

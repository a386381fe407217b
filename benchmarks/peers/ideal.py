"""Solve the press without clearance by hand-written C (press_ideal.c): Newton's method at every sample.

A revolution at ω = 2π in 1001 samples. Error: the largest |Δy9| over the stroke, or, if that is greater, |Δv9| and
|Δa9| over their largest values, against the closed form (intersections of circles).
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from cffi import FFI

from benchmarks.peers import press
from benchmarks.peers.timing import CallTimer, Measured
from tests.oracles import ideal_press, press_dense

SAMPLES, T_END = 1001, 1.0
DECLARATIONS = press.DECLARATIONS[: press.DECLARATIONS.index("typedef struct { Press press;")]
DECLARATIONS += "int ideal_run(const Press *, double, long, const double *, double *);"


@cache
def library() -> tuple[FFI, Any]:
    """Return cffi's FFI and the library of press_ideal.c."""
    return press.compile_library("press_ideal.c", DECLARATIONS)


@cache
def exact() -> np.ndarray:
    """Return y9, v9, a9 (SAMPLES, 3) by the closed form; l5 = 0.25 m as in the other problems."""
    motion = ideal_press.motion(np.linspace(0.0, T_END, SAMPLES), press.work("dry").press.geometry)
    return np.stack([motion.q[:, 22], motion.v[:, 22], motion.a[:, 22]], axis=1)


def error(found: np.ndarray) -> float:
    """Return the error as defined above; found: (SAMPLES, 3), or without accelerations (SAMPLES, 2)."""
    true = exact()[:, : found.shape[1]]
    scale = np.array([np.ptp(true[:, 0]), *np.abs(true[:, 1:]).max(axis=0)])
    return float((np.abs(found - true).max(axis=0) / scale).max())


def dense(_: float) -> Measured:
    """Solve all samples; times are those of a sample. Raises FloatingPointError."""
    ffi, c = library()
    data = press.work("dry").press
    timer = CallTimer()
    struct = ffi.new("Press *")
    raw = bytes(press_dense._struct(data))
    ffi.memmove(struct, raw, len(raw))
    guess, rows = press_dense.start(data)[:24].copy(), np.empty((SAMPLES, 72))
    arguments = (struct, T_END / (SAMPLES - 1), SAMPLES, ffi.from_buffer("double[]", guess))
    out = ffi.from_buffer("double[]", rows)
    with timer.engine:
        bad = c.ideal_run(*arguments, out)
    timer.stop()
    if bad:
        raise FloatingPointError(f"ideal press: {bad}")
    return timer.measured(lambda: error(rows[:, [22, 46, 70]])).per(SAMPLES)

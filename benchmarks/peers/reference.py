"""Compute a reference solution of the dry press in long double (press_reference.c): outputs, contact onsets.

python -m benchmarks.peers.reference     # writes press_dry_onsets.json, with two steps' difference
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from cffi import FFI

from benchmarks.peers import press
from tests.oracles import press_dense

ONSETS = Path(__file__).with_name("press_dry_onsets.json")
MOST = 256
STEPS = 25  # between two outputs: 1e-5 s, less at every bend; 12 to 40 differ by 1e-12 s
DECLARATIONS = "int reference_run(const double *, const double *, double, int, int, double *, double *, int);"


@cache
def library() -> tuple[FFI, Any]:
    """Return cffi's FFI and the library of press_reference.c."""
    return press.compile_library("press_reference.c", DECLARATIONS)


@cache
def run(name: str = "dry", steps: int = STEPS) -> tuple[np.ndarray, np.ndarray]:
    """Return y (OUTPUTS, 48) and onsets (K, 3): joint 0 or 1, t (s), δ̇⁻ (m/s). Raises FloatingPointError."""
    ffi, c = library()
    work = press.work(name)
    data = np.frombuffer(bytes(press_dense._struct(work.press)))
    y0, rows, onsets = press_dense.start(work.press), np.empty((press.OUTPUTS, 48)), np.empty((MOST, 3))
    cast = ffi.from_buffer
    count = c.reference_run(
        cast("double[]", data),
        cast("double[]", y0),
        work.t_end,
        press.OUTPUTS,
        steps,
        cast("double[]", rows),
        cast("double[]", onsets),
        MOST,
    )
    if count < 0:
        raise FloatingPointError("reference: no pivot")
    return rows, onsets[:count]


def samples(name: str = "dry", steps: int = STEPS) -> press.Samples:
    """Return the outputs and onsets for the race."""
    rows, onsets = run(name, steps)
    times = [onsets[onsets[:, 0] == joint, 1] for joint in (0, 1)]
    return press.Samples(np.ascontiguousarray(rows[:, :24]), (times[0], times[1]))


def main() -> None:
    """Write the onsets, and the difference of two steps."""
    rows, onsets = run()
    coarse_rows, coarse = run(steps=STEPS // 2)
    gap = {"onset": float(np.abs(onsets - coarse)[:, 1].max()), "y": float(np.abs(rows - coarse_rows).max())}
    about = (
        "Onsets of the dry press of the race (l5 = .25 m, no gravity, c = .3 mm, omega = 2 pi, 0.05 s), SI units: "
        "joint, t, stored impact velocity; last: slider y at t = 0.05. Long double, order 12; see press_reference.c."
    )
    data = {
        "about": about,
        "differs_from_twice_the_step_by": gap,
        "onsets": [["AB"[int(k)], t, v] for k, t, v in onsets.tolist()],
        "S9.y": float(rows[-1, 22]),
    }
    ONSETS.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(data, indent=1))


if __name__ == "__main__":
    main()

"""Writes tests/data/golden.json with the oracles: `python -m tests.oracles.golden` from the repository's root.

The figures that the product must reach. Ten digits are kept; `tolerance` in the file says what to ask for, relative
unless its name ends in _s (seconds).
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from . import ideal_press, press_dense
from .press_dense import Press

FILE = Path(__file__).resolve().parents[1] / "data" / "golden.json"
FILM = replace(Press(), film=True, clearance=0.6e-3, transition=1e-6).at_speed(3.0 * np.pi)
DRY = Press()
STEEL = replace(DRY, young=206e9, clearance=0.5e-3).at_speed(3.0 * np.pi)
CONFORMAL = replace(DRY, conformal=True)


def _digits(value: float) -> float:
    return float(f"{value:.10g}")


def ideal() -> dict[str, Any]:
    """Extremes over one turn at 2π, and the slider at a few times."""
    times = [0.0, 0.1, 0.25, 0.5, 0.9]
    m, fine = ideal_press.motion(times), ideal_press.motion(np.linspace(0.0, 1.0, 20001))
    y, v, a = fine.q[:, 22], fine.v[:, 22], fine.a[:, 22]
    return {
        "omega": _digits(2.0 * np.pi),
        "y_min": _digits(y.min()),
        "y_max": _digits(y.max()),
        "stroke": _digits(np.ptp(y)),
        "v_max": _digits(abs(v).max()),
        "a_min": _digits(a.min()),
        "a_max": _digits(a.max()),
        "t": times,
        "y9": [_digits(x) for x in m.q[:, 22]],
        "v9": [_digits(x) for x in m.v[:, 22]],
        "a9": [_digits(x) for x in m.a[:, 22]],
    }


def film(step: float = 2.5e-6) -> dict[str, Any]:
    """3π, c = .6 mm, e0 = 1 µm."""
    run = press_dense.rk4(FILM, 0.5, step, every=round(0.1 / step))
    force = np.hypot(run.force[:, :, 0], run.force[:, :, 1])
    return {
        "omega": _digits(3.0 * np.pi),
        "c": 0.6e-3,
        "transition": 1e-6,
        "step": 5e-6,
        "t": [_digits(t) for t in run.t[1:]],
        **{k: [_digits(x) for x in column[1:, 22]] for k, column in (("y9", run.q), ("v9", run.v), ("a9", run.a))},
        "F_A": [_digits(x) for x in force[1:, 0]],
        "F_B": [_digits(x) for x in force[1:, 1]],
        "tolerance": {"y9": 1e-6, "v9": 1e-6, "force": 1e-4},
    }


def dry(press: Press, t_end: float, step: float = 2.5e-7) -> dict[str, Any]:
    """First contact (s) and first peak (N) of A and B, forces at one common point."""
    a, b = press_dense.rk4(replace(press, common_point=True), t_end, step, every=1000).watch
    return {
        "omega": _digits(press.geometry.omega1),
        "c": press.clearance,
        "young": press.young,
        "conformal": press.conformal,
        "t_end": t_end,
        "step": 1e-6,
        "first_contact": {"A": _digits(a.first_contact), "B": _digits(b.first_contact)},
        "first_peak": {"A": _digits(a.first_peak), "B": _digits(b.first_peak)},
        "tolerance": {"first_contact_s": 2e-6, "first_peak": 2e-3},
    }


def main() -> None:
    """Compute everything and write it."""
    data = {
        "ideal": ideal(),
        "lubricated": film(),
        "dry": dry(DRY, 9.0e-3),
        "dry_steel": dry(STEEL, 9.0e-3),
        "dry_conformal": dry(CONFORMAL, 9.0e-3),
    }
    FILE.parent.mkdir(exist_ok=True)
    FILE.write_text(json.dumps(data, indent=1, allow_nan=False) + "\n")


def load() -> dict[str, Any]:
    """What `main` wrote."""
    data: dict[str, Any] = json.loads(FILE.read_text())
    return data


if __name__ == "__main__":
    main()

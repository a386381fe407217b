"""The sweep's peer: CVODE's BDF from C on the hand-written press, one run after the other, one thread."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from benchmarks.peers import cvode, press


def works(c: np.ndarray, omega: np.ndarray) -> list[press.Work]:
    """A lubricated work for each pair."""
    plain = press.work("lubricated")
    return [
        replace(plain, press=replace(plain.press.at_speed(float(speed)), clearance=float(gap)))
        for gap, speed in zip(c, omega, strict=True)
    ]


def run(all_works: list[press.Work], rtol: float) -> tuple[np.ndarray, float]:
    """(slider's y (runs, OUTPUTS), m; seconds of integration of all)."""
    y, seconds = np.empty((len(all_works), press.OUTPUTS)), 0.0
    for k, work in enumerate(all_works):
        samples, spent, _ = cvode.in_c(work, rtol)
        y[k], seconds = samples.q[:, 22], seconds + spent
    return y, seconds

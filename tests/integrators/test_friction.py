"""Friction that sticks: the belt's limit cycle against its closed form, a block at rest, a block between two."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.loading.shipped import shipped_file

PERIOD, STICK = 0.8008322171201989, 0.3924  # k = 100 N/m, m = 1 kg, Fs = .6 m g, Fk = .4 m g, belt .1 m/s


@pytest.mark.parametrize(("step", "error"), [(1e-2, 4e-7), (5e-3, 4e-8), (1e-3, 1e-9)])
def test_stick_slip_period(step: float, error: float) -> None:
    """In stick x = x0 + v (t − t0): each cycle's t0 follows from any of its stick samples."""
    belt = gudgeon.load("belt_block")
    run = belt.simulate(20.0, step=step, output=20_000)
    mode, x = run["rub.mode"], run["block.x"]
    begins = np.flatnonzero((mode[1:] == 0) & (mode[:-1] != 0)) + 1
    offsets = [run.t[i + 10] - x[i + 10] / 0.1 for i in begins]
    assert len(begins) > 20
    assert np.diff(offsets)[1:] == pytest.approx(PERIOD, abs=error)
    ends = np.flatnonzero((mode[1:] != 0) & (mode[:-1] == 0)) + 1
    assert np.median([run.t[j] - run.t[i] for i, j in zip(begins[1:-1], ends[ends > begins[1]], strict=False)]) == (
        pytest.approx(STICK, abs=2e-3)  # two samples
    )
    assert np.abs(run["rub.F"]).max() <= 5.886 * (1 + 1e-12)
    assert run.diagnostics.energy_residual < max(1e-8, error)


def test_a_block_at_rest_does_not_creep() -> None:
    belt = gudgeon.load("belt_block")
    run = belt.simulate(10.0, step=1e-2, output=100, parameters={"belt_speed": 0.0, "start_at": 0.05})
    assert np.ptp(run["block.x"]) < 1e-12  # 5 N of spring against 5.886 N at most
    assert run["rub.F"] == pytest.approx(5.0, abs=1e-9)
    assert (run["rub.mode"] == 0).all()


def test_a_block_slides_to_rest(tmp_path: Path) -> None:
    """Without spring and belt: x = v0²/(2 μ g) after v0/(μ g), then nothing."""
    text = shipped_file("belt_block").read_text(encoding="utf-8")
    file = tmp_path / "block.yaml"
    file.write_text(text.replace("block.x: start_at", "block.x: start_at\n  rates: {block.vx: 1 m/s}"))
    block = gudgeon.load(file)
    values = {"belt_speed": 0.0, "forces.spring.stiffness": 0.0}
    run = block.simulate(1.0, step=1e-2, output=[0.0, 0.1, 0.5, 1.0], parameters=values)
    stop = 1.0 / 3.924
    assert run["block.x"][1:] == pytest.approx([0.1 - 0.5 * 3.924 * 0.01, 0.5 * stop, 0.5 * stop], abs=1e-12)
    assert run["work.forces"][-1] == pytest.approx(-0.5, abs=1e-12)
    assert math.isclose(run["block.vx"][-1], 0.0, abs_tol=1e-15)

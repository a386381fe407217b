"""A run in two parts is the run in one part, bit for bit: in free flight, in contact, in stick and slip."""

from __future__ import annotations

import numpy as np
import pytest

import gudgeon

CASES: list[tuple[str, str, float, float | None, int]] = [
    ("nine_bar_press", "dry", 0.012, 2e-6, 400),
    ("belt_block", "ideal", 3.0, 1e-2, 60),
    ("bouncing_ball", "damped", 0.46, 1e-5, 2300),
    ("slider_crank", "ideal", 0.2, None, 20),
]


@pytest.mark.parametrize(("name", "scene", "t_end", "step", "samples"), CASES)
def test_restart(name: str, scene: str, t_end: float, step: float | None, samples: int) -> None:
    simulation, times = gudgeon.load(name, scene=scene), np.linspace(0.0, t_end, samples + 1)
    whole = simulation.simulate(output=times, step=step)
    busy = np.flatnonzero(whole.state.any(axis=1) if whole.state.size else np.arange(len(times)) % 7 == 3)
    assert len(busy)
    for k in {*busy[:: max(1, len(busy) // 5)].tolist(), samples // 2} - {0, samples}:
        first = simulation.simulate(output=times[: k + 1], step=step)
        second = simulation.simulate(output=times[k:], step=step, start=first.final)
        for part in ("q", "v", "a", "memory", "state"):
            one, other = getattr(second, part), getattr(whole, part)[k:]
            np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-12)  # an end is one number beside the grid's
        assert first.work[-1] + second.work[-1] == pytest.approx(whole.work[-1], abs=1e-12)

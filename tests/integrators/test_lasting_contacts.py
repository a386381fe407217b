"""Between the ends of steps in a lasting contact: sampled forces and peaks are those of the motion at loose tolerances.

Such a motion is chaotic: the same run with a smaller tolerance soon is another one. So the reference begins with the
run's own state, a millisecond before its largest force.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import gudgeon
from tests.programs import needs_compiler

pytestmark = needs_compiler
DATA = Path(__file__).parents[1] / "data"
AHEAD = 1e-3  # s
# Over a millisecond the distance of two motions may grow so much at rtol 1e-4.
WITHIN = 0.1


@pytest.mark.parametrize(
    ("name", "method", "rtol", "t_end"),
    [
        ("slider_crank", "auto", 1e-4, 0.4313),
        ("slider_crank", "rodas5p", 1e-4, 0.4313),
        ("four_bar", "rodas5p", 1e-5, 0.3),
        ("four_bar", "auto", 1e-4, 0.3),
    ],
)
def test_the_largest_force_is_that_of_a_precise_run_from_shortly_before(
    name: str, method: str, rtol: float, t_end: float
) -> None:
    scene = gudgeon.load(DATA / f"lasting_contact_{name}.yaml", "dry")
    run = scene.simulate(t_end, method=method, rtol=rtol, output=20_000)
    peak = run.diagnostics.peak("crankpin")
    before = scene.simulate(peak.t - AHEAD, method=method, rtol=rtol, output=20)
    precise = scene.simulate(peak.t + AHEAD, method="dop853", rtol=1e-10, output=1000, start=before.final)
    assert pytest.approx(precise.diagnostics.peak("crankpin").F, rel=WITHIN) == peak.F
    assert run["crankpin.F"].max() <= peak.F * (1.0 + 1e-9)

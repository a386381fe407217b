"""Peaks over all steps are never less than samples of the same run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import gudgeon
from tests.programs import needs_compiler

pytestmark = needs_compiler


@pytest.mark.parametrize("share", [0.9, 1.0])
def test_no_sample_lies_beyond(share: float) -> None:
    """`share` of the extremes were found: what samples have is the more, if it is; of a run and of a batch."""
    crank = gudgeon.load("slider_crank", "ideal")
    run = crank.simulate(0.2, output=101, peaks=["slider.vx"])
    found = run.diagnostics.extremes[0]
    lower = replace(found, max=share * found.max, min=share * found.min)
    run.diagnostics = replace(run.diagnostics, extremes=(lower,))
    batch = crank.simulate_many([{}, {}], t_end=0.2, output=101, peaks=["slider.vx"])
    batch.extremes = ((lower,), (lower,))
    samples = run["slider.vx"]
    one, many = run.peak("slider.vx"), batch.peak("slider.vx")
    assert one.max == max(lower.max, samples.max()) and one.min == min(lower.min, samples.min())
    if share < 1.0:
        assert one.t_max == run.t[samples.argmax()] and one.t_min == run.t[samples.argmin()]
    np.testing.assert_array_equal(many.max, one.max)
    np.testing.assert_array_equal(many.t_min, one.t_min)

"""What an interrupted run must have kept, compared with the whole run."""

from __future__ import annotations

import numpy as np

from gudgeon.results.results import Result

ROWS = ("q", "v", "work", "state", "memory")


def check_kept(run: Result, whole: Result) -> None:
    """Samples but the last bit for bit; the last one between its neighbours; contacts and events up to it, no more."""
    assert run.diagnostics.interrupted
    kept, end = len(run.t) - 1, float(run.t[-1])
    if end == whole.t[kept]:
        kept += 1
    else:
        assert kept == 0 or whole.t[kept - 1] < end
        assert end < whole.t[kept]
    assert (run.t[:kept] == whole.t[:kept]).all()
    for name in ROWS:
        np.testing.assert_array_equal(getattr(run, name)[:kept], getattr(whole, name)[:kept], err_msg=name)
    begun, ended = whole.impacts["t_on"] <= end, whole.impacts["t_off"] <= end
    assert len(run.impacts) == begun.sum()
    is_over = run.impacts["t_off"] <= end
    np.testing.assert_array_equal(run.impacts[is_over], whole.impacts[begun & ended])
    for name in ("joint", "t_on", "deltadot"):
        np.testing.assert_array_equal(run.impacts[~is_over][name], whole.impacts[begun & ~ended][name])
    assert (run.impacts[~is_over]["F_peak"] <= whole.impacts[begun & ~ended]["F_peak"]).all()
    np.testing.assert_array_equal(run.events, whole.events[whole.events["t"] <= end])
    assert run.diagnostics.onsets <= whole.diagnostics.onsets and run.diagnostics.steps <= whole.diagnostics.steps

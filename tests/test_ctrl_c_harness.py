"""`python -m tests.ctrl_c` runs, and what Ctrl-C leaves is right at each of its moments. Times are not looked at."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests import ctrl_c
from tests.programs import needs_compiler


@needs_compiler
@pytest.mark.slow
def test_every_activity_at_some_moments(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cache"))  # put back: one activity changes it
    monkeypatch.setattr(ctrl_c, "BAR", np.inf)
    rng = np.random.default_rng(0)
    made = [*ctrl_c.activities(tmp_path), *ctrl_c.large(tmp_path)]
    assert all([ctrl_c.measure(activity, 3, rng) for activity in made])
    assert capsys.readouterr().out.count("0 wrong") == len(made) > 15

"""`python -m tests.ctrl_c` and `tests.ctrl_c_commands` run, and Ctrl-C leaves what is right. Nobody looks at times."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests import ctrl_c, ctrl_c_commands
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


@needs_compiler
@pytest.mark.slow
def test_every_command_at_some_moments(capsys: pytest.CaptureFixture[str]) -> None:
    assert ctrl_c_commands.main(["--moments", "4"]) == 0
    assert capsys.readouterr().out.count(" 0 wrong\n") == len(ctrl_c_commands.COMMANDS)

"""What a shell proposes: asked as bash asks, by the variables of its completion."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

from gudgeon.cli import app
from tests.pump import TEXT


def proposed(line: str) -> list[str]:
    """For the last word of a line, as the shell's own script asks."""
    words = line.split(" ")
    message = {"_GUDGEON_COMPLETE": "complete_bash", "COMP_WORDS": line, "COMP_CWORD": str(len(words) - 1)}
    return CliRunner().invoke(app, [], env=message, prog_name="gudgeon").stdout.split()


def test_names_files_scenes_and_methods(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pump.yaml").write_text(TEXT, encoding="utf-8")
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts/pin.yaml").write_text("nothing: [", encoding="utf-8")
    (tmp_path / "notes.txt").touch()
    assert proposed("gudgeon run four") == ["four_bar"]
    assert proposed("gudgeon check p") == ["parts/", "peaucellier", "pendulum", "pump.yaml"]
    assert proposed("gudgeon draw parts/") == ["parts/pin.yaml"]
    assert proposed("gudgeon run nine_bar_press --scene ") == ["dry", "ideal", "lubricated"]
    assert proposed("gudgeon run pump.yaml --scene w") == ["worn"]
    assert proposed("gudgeon run parts/pin.yaml --scene ") == ["ideal"]
    assert proposed("gudgeon run four_bar --method r") == ["rodas5p", "radau5", "radau9", "rk4"]
    assert proposed("gudgeon laws f") == ["finite_length", "flores"]
    assert proposed("gudgeon exer") == ["exercise"]

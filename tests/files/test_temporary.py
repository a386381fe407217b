"""Temporary folders: gone when their process ends, and swept by a later one where it was killed."""

from __future__ import annotations

import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from gudgeon.files import temporary
from gudgeon.files.temporary import TemporaryFolder

HOLDS = """\
import time
from gudgeon.files.temporary import TemporaryFolder
folder = TemporaryFolder()
(folder.path / "half.o").write_text("x")
print(folder.path, flush=True)
time.sleep(60)
"""


@pytest.fixture(autouse=True)
def apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(temporary, "GRACE_S", 0.0)


def test_a_killed_process_leaves_its_folder_until_the_next_one(tmp_path: Path) -> None:
    other = tmp_path / "gudgeon-tmp-is not ours"  # no name that mkdtemp gives
    other.mkdir()
    with subprocess.Popen(
        [sys.executable, "-c", HOLDS], stdout=subprocess.PIPE, text=True, env={"TMPDIR": str(tmp_path)}
    ) as held:
        assert held.stdout is not None
        left = Path(held.stdout.readline().strip())
        first = TemporaryFolder()
        assert left.exists() and left.parent == tmp_path  # it is locked
        held.send_signal(signal.SIGKILL)
        held.wait()
    assert left.exists()
    second = TemporaryFolder()
    assert not left.exists() and first.path.exists() and other.exists()
    for folder in (first, second, second):
        folder.remove_folder()
    assert list(tmp_path.iterdir()) == [other]


def test_what_is_young_is_left_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A process may be between making its folder and locking it."""
    monkeypatch.setattr(temporary, "GRACE_S", 60.0)
    young = tmp_path / "gudgeon-tmp-abcdefgh"
    young.mkdir()
    TemporaryFolder().remove_folder()
    assert young.exists()

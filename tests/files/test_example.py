"""Example: a user's file is written whole, or it stays as it was."""

from __future__ import annotations

from pathlib import Path

import pytest

from gudgeon.errors import OutputError
from gudgeon.files.writing import write_text


def test_a_file_in_the_place_of_a_folder_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(OutputError):
        write_text(tmp_path / "out" / "table.csv", "t,x\n")
    assert (tmp_path / "out").read_text() == "a file"

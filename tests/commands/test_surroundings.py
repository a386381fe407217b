"""A run does not hang on what surrounds it: locale, time zone, umask, home, the order of Python's sets."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from gudgeon.results.results import Result
from tests.programs import needs_compiler

pytestmark = needs_compiler
STRANGE = {
    "LC_ALL": "POSIX",
    "LANG": "tr_TR.ISO-8859-9",
    "PYTHONUTF8": "0",
    "PYTHONCOERCECLOCALE": "0",
    "HOME": "/nowhere",
    "TZ": "Pacific/Auckland",
    "SOURCE_DATE_EPOCH": "315532800",
    "PYTHONHASHSEED": "20231",
    "COLUMNS": "40",
}


def without_times(message: object) -> object:
    """But for what the machine took."""
    if isinstance(message, dict):
        return {key: without_times(value) for key, value in message.items() if "seconds" not in key}
    return [without_times(value) for value in message] if isinstance(message, list) else message


def run(folder: Path, around: dict[str, str], umask: int) -> tuple[object, dict[str, np.ndarray]]:
    """What a run prints, and all series of its file."""
    command = [sys.executable, "-m", "gudgeon", "run", "slider_crank", "--scene", "dry", "--t-end", "0.05", "--json"]
    found = subprocess.run(
        [*command, "--out", "out"],
        env={**os.environ, **around},
        cwd=folder,
        umask=umask,
        check=True,
        capture_output=True,
    )
    result = Result.load(folder / "out" / "slider_crank_dry.nc")
    return without_times(json.loads(found.stdout)), {name: np.asarray(result[name]) for name in result.names}


@pytest.mark.slow
def test_a_run_is_the_same_in_strange_surroundings(tmp_path: Path) -> None:
    folders = tmp_path / "here", tmp_path / 'ölçüm & "s"'
    for folder in folders:
        folder.mkdir()
    (message, series), (told_there, series_there) = run(folders[0], {}, 0o022), run(folders[1], STRANGE, 0o077)
    assert message == told_there
    assert series.keys() == series_there.keys() and len(series) > 20
    assert [name for name in series if not np.array_equal(series[name], series_there[name], equal_nan=True)] == []
    assert (folders[1] / "out" / "slider_crank_dry.nc").stat().st_mode & 0o777 == 0o600

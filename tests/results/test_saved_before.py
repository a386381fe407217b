"""Files that were saved by an earlier gudgeon are read: `tests/data/saved-*.zip`, which are never written again.

Each holds the same work: a ball that falls from rest by its `height` onto an elastic floor (scene `elastic` of
bouncing_ball). What it must be is known: y = −g t²/2 until it lands, once within a second, at √(2 g h).
"""

from __future__ import annotations

import math
import zipfile
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import gudgeon

SAVED = sorted((Path(__file__).resolve().parents[1] / "data").glob("saved-*.zip"))
G, HEIGHTS = 9.81, (1.0, 2.0)
# free fall is a polynomial of the second degree: methods have it to rounding
near = partial(np.allclose, rtol=0.0, atol=1e-12)


@pytest.fixture(scope="module", params=SAVED, ids=lambda path: path.stem)
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What a zip holds."""
    where = tmp_path_factory.mktemp("saved")
    with zipfile.ZipFile(request.param) as file:
        file.extractall(where)
    return where


def test_there_are_files_of_an_earlier_gudgeon() -> None:
    """Else the others would be skipped."""
    assert [path.name for path in SAVED][:1] == ["saved-0.1.0.zip"]


def test_a_saved_result_is_what_it_was(folder: Path) -> None:
    """result.nc: six samples of a second, one impact."""
    run = gudgeon.Result.load(folder / "result.nc")
    fell = run.t <= math.sqrt(2.0 / G)
    assert near(run.t, np.linspace(0.0, 1.0, 6)) and fell.sum() == 3
    assert near(run["ball.y"][fell], -G * run.t[fell] ** 2 / 2.0)
    assert near(run["ball.vy"][fell], -G * run.t[fell])
    assert len(run.impacts) == 1 and (run.source.mechanism, run.source.scene) == ("bouncing_ball", "elastic")
    assert run.parameters["height"] == 1.0


def test_a_saved_batch_is_what_it_was(folder: Path) -> None:
    """batch.nc: two heights."""
    batch = gudgeon.Batch.load(folder / "batch.nc")
    expected = np.array(HEIGHTS)[:, None] - G * batch.t**2 / 2.0
    assert near(batch.t, np.linspace(0.0, 0.4, 6))
    assert near(batch["height_above_floor"], expected)


def test_a_saved_study_is_what_it_was(folder: Path) -> None:
    """study: the two heights once more, what is measured at the end and what was kept."""
    data = gudgeon.load_study(folder / "study").dataset.sel(scene="elastic")
    assert data["height"].values.tolist() == list(HEIGHTS)
    assert near(data["y"], np.array(HEIGHTS) - G * 0.4**2 / 2.0)
    assert near(data["ball.vy"], np.tile(-G * data["time"].values, (2, 1)))

"""Studies whose blocks are single runs, and what nobody disturbed."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import xarray as xr

import gudgeon
from gudgeon.studies.ensemble import resolve


@pytest.fixture
def blocks_of_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the tests of a module that asks for it."""
    monkeypatch.setattr(resolve, "MAX_BLOCK_RUNS", 1)


@pytest.fixture(scope="module")
def quiet(request: pytest.FixtureRequest) -> Iterator[xr.Dataset]:
    """The dataset of the module's own STUDY."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(resolve, "MAX_BLOCK_RUNS", 1)
        yield gudgeon.study(request.module.STUDY).dataset

"""Example: C text becomes a library; `tiny` is a source of three lines that needs no generator."""

from __future__ import annotations

from pathlib import Path

import pytest

from gudgeon.loading import build
from gudgeon.loading.build import compile_kernels
from tests.programs import needs_compiler
from tests.tiny import tiny

pytestmark = [needs_compiler, pytest.mark.plain]


def test_sources_that_differ_give_libraries_that_differ(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(build, "_libraries", {})
    assert [compile_kernels(tiny(factor)).lib.scale(4.0) for factor in (2, 3)] == [8.0, 12.0]

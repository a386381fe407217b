"""Load gudgeon's scenes for the comparison of docs/race.md, optimized; to measure set-up, derive and compile anew."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import gudgeon

regenerate = False  # set by benchmarks/race/setup.py


def load(mechanism: str | os.PathLike[str] | Path, scene: str | None = None) -> Any:
    """Return the loaded scene with its optimized library."""
    return gudgeon.load(mechanism, scene, quick=False, regenerate=regenerate)

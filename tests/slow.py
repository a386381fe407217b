"""Of many variants of a test those that differ in kind; all others are slow."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def slow_but(kept: Iterable[Any], every: Iterable[Any]) -> list[Any]:
    """All values for `parametrize`, in their order: what is not kept is marked. Each kept one must be there."""
    kept, every = list(kept), list(every)
    assert all(value in every for value in kept), kept
    return [value if value in kept else pytest.param(value, marks=pytest.mark.slow) for value in every]

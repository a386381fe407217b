"""Of many variants of a test those that differ in kind; all others are slow."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def slow_but(kept: Iterable[Any], every: Iterable[Any]) -> list[Any]:
    """All values for `parametrize`, in their order: what is not kept is marked. Each kept one must be there."""
    return slow_rows_but([(value,) for value in kept], [(value,) for value in every])


def slow_rows_but(kept: Iterable[tuple[Any, ...]], every: Iterable[tuple[Any, ...]]) -> list[Any]:
    """The same where each is a row of values, for several arguments."""
    kept, every = list(kept), list(every)
    assert all(row in every for row in kept), kept
    return [pytest.param(*row, marks=[] if row in kept else pytest.mark.slow) for row in every]

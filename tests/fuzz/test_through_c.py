"""Random files through the compiler; `python -m tests.fuzz compile` goes on for longer."""

from __future__ import annotations

import pytest

from tests.fuzz.through_c import try_files


def test_three_hundred_files() -> None:
    """In one formulation each, in turn; some in both, with numbers, and run by every method."""
    tally = try_files(range(300), compared=60, ran=150)
    assert tally.counts["files"] > 250
    assert tally.counts["with numbers"] >= 3
    assert tally.counts["runs"] > 0


@pytest.mark.parametrize("seed", [1, 6, 13, 16, 41, 1140, 1300, 6020, 6140])
def test_files_that_failed_once(seed: int) -> None:
    """Warnings, names of the C, numbers where there are none: all of them with numbers."""
    assert try_files([seed], compared=1, ran=1).counts["files"] == 1

"""Define the durations of the long problems of docs/race.md; a test of the code shortens them."""

from __future__ import annotations

periods = 100_000  # of the pendulum
turns = 10_000  # of the crank of Andrews' squeezer
swings = 10_000  # of the double pendulum
four_bars = 2_000  # linkages of the kinematic ensemble


def shorten() -> None:
    """Make the problems a hundred times as short."""
    global periods, turns, swings, four_bars
    periods, turns, swings, four_bars = periods // 100, turns // 100, swings // 100, four_bars // 40

"""Measure a call of a solver from Python: the whole call in processor time, and the integration within the call.

timer = CallTimer()                 # the whole call begins
solver.set_state(start)
with timer.engine:                  # the integration
    solver.integrate(t_end)
y = np.array(solver.state)
return timer.measured(lambda: error(y), calls)    # the whole call has ended; the error is not part of the call
"""

from __future__ import annotations

from collections.abc import Callable
from time import process_time
from typing import NamedTuple


class Measured(NamedTuple):
    """Error and cost of a run: `seconds` of the integration, `call` of the whole call (processor time, s)."""

    error: float
    seconds: float
    call: float
    right_hand_sides: int = -1  # -1: unknown

    def per(self, runs: int) -> Measured:
        """Return the same with the times of one of `runs` runs."""
        return self._replace(seconds=self.seconds / runs, call=self.call / runs)


class EngineTimer:
    """Sum the processor time of the blocks that it surrounds."""

    seconds = 0.0

    def __enter__(self) -> None:
        """Begin a block."""
        self._begin = process_time()

    def __exit__(self, *_: object) -> None:
        """End a block."""
        self.seconds += process_time() - self._begin


class CallTimer:
    """Measure a whole call from the construction to `stop`, and the blocks of its integration."""

    def __init__(self) -> None:
        """Begin the whole call."""
        self.engine, self.call = EngineTimer(), 0.0
        self._begin = process_time()

    def stop(self) -> CallTimer:
        """End the whole call."""
        self.call = process_time() - self._begin
        return self

    def measured(
        self, error: Callable[[], float], right_hand_sides: int = -1, seconds: float | None = None
    ) -> Measured:
        """End the whole call, compute the error, return both; `seconds`: integration as the solver reports it."""
        if not self.call:
            self.stop()
        return Measured(error(), self.engine.seconds if seconds is None else seconds, self.call, right_hand_sides)

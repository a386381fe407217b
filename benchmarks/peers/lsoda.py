"""SciPy's LSODA on the hand-written press: from located event to located event where there is contact.

`plain` lets LSODA difference the right-hand side; `jacobian` gives it all 48 columns by one call of C.
Each takes (work, rtol) and returns (samples, seconds of integration only, right-hand sides).
"""

from __future__ import annotations

from time import perf_counter
from typing import Any

from benchmarks.peers.press import Kernel, Samples, Work, with_events

ATOL = 1e-3  # of rtol, as for CVODE


def plain(work: Work, rtol: float, with_jacobian: bool = False) -> tuple[Samples, float, int]:
    """See the module's head."""
    kernel = Kernel(work)
    options: dict[str, Any] = {"jac": kernel.jacobian} if with_jacobian else {}
    kernel.peer.calls = 0
    begin = perf_counter()
    samples = with_events(kernel, work, method="LSODA", rtol=rtol, atol=ATOL * rtol, **options)
    return samples, perf_counter() - begin, int(kernel.peer.calls)


def jacobian(work: Work, rtol: float) -> tuple[Samples, float, int]:
    """See the module's head."""
    return plain(work, rtol, with_jacobian=True)

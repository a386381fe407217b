"""Forecast the time and memory of a derivation from the number of bodies, before a long derivation begins."""

from __future__ import annotations

import sys

SECONDS_PER_BODY, BODIES_OF_DOUBLE_COST = 0.09, 3000  # measured on chains and on separate four-bars
MEGABYTES, MEGABYTES_PER_BODY = 150.0, 2.0
MIN_ANNOUNCED_S = 10.0  # shorter derivations are not announced


def forecast_derivation(n_bodies: int) -> tuple[float, float]:
    """Return the processor time (s) and the memory (MB) that the derivation of a scene with n_bodies bodies needs.

    Chains of 128 to 2,048 links and 64 separate four-bars were within a factor of 1.3 on an idle machine. Joints with
    play were not measured.
    """
    seconds = SECONDS_PER_BODY * n_bodies * (1.0 + n_bodies / BODIES_OF_DOUBLE_COST)
    return seconds, MEGABYTES + MEGABYTES_PER_BODY * n_bodies


def announce_long_derivation(name: str, n_bodies: int) -> None:
    """Print the forecast of a derivation to the standard error if the derivation takes MIN_ANNOUNCED_S or more."""
    seconds, megabytes = forecast_derivation(n_bodies)
    if seconds >= MIN_ANNOUNCED_S:
        time_text = f"{seconds:.0f} s" if seconds < 100.0 else f"{seconds / 60.0:.0f} min"
        print(
            f"note: deriving {name} with {n_bodies} bodies takes about {time_text} and {megabytes:,.0f} MB of memory;"
            " the result is cached",
            file=sys.stderr,
            flush=True,
        )

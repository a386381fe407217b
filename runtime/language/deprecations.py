"""List the deprecated features, and warn about their use until they are removed (CHANGELOG.md)."""

from __future__ import annotations

import sys
import warnings
from dataclasses import dataclass


@dataclass(frozen=True)
class Deprecation:
    """A call, a key or a command that works but will be removed. `what`: its name for users."""

    what: str
    since: str  # version
    date: str  # of that version or, if it is not released yet, of the decision: YYYY-MM-DD
    instead: str
    gone: str  # version that removes it, half a year later at the earliest

    def __str__(self) -> str:
        """Return the warning: what is deprecated since when, until when it works, and what replaces it."""
        return (
            f"{self.what} is deprecated since gudgeon {self.since} ({self.date}) and will be removed in {self.gone}: "
            f"use {self.instead}"
        )


STRESS = Deprecation("gudgeon stress", "0.1.0", "2026-11-26", "gudgeon map", "0.3.0")
TWIN = Deprecation('by="twin"', "0.1.0", "2026-11-30", 'by="two_trajectory"', "0.3.0")
BELIEVABLE = Deprecation("Lyapunov.believable", "0.1.0", "2026-11-30", "Lyapunov.mean_horizon", "0.3.0")
MERGED = Deprecation("Lyapunov.merged", "0.1.0", "2026-11-30", "Lyapunov.coincidences", "0.3.0")
BELIEVABLE_MEASURE = Deprecation("the statistic believable", "0.1.0", "2026-11-30", "mean_horizon", "0.3.0")
CARRIED = Deprecation("gudgeon.web.page.carried", "0.1.0", "2026-11-30", "gudgeon.web.page.embed_scene", "0.3.0")
DEPRECATIONS = (STRESS, TWIN, BELIEVABLE, MERGED, BELIEVABLE_MEASURE, CARRIED)


def warn_deprecated(deprecation: Deprecation) -> None:
    """Issue a DeprecationWarning that points to the line of the user's code that called gudgeon."""
    warnings.warn(str(deprecation), DeprecationWarning, stacklevel=find_user_stack_level())


def find_user_stack_level() -> int:
    """Return the stack level of the first caller outside gudgeon, as `warnings.warn` counts it."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "gudgeon":
        level, frame = level + 1, frame.f_back
    return level

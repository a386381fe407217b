"""List the deprecated features, and warn about their use until they are removed (CHANGELOG.md)."""

from __future__ import annotations

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
DEPRECATIONS = (STRESS,)


def warn_deprecated(deprecation: Deprecation) -> None:
    """Issue a DeprecationWarning that points to the line from which the caller of this function was called."""
    warnings.warn(str(deprecation), DeprecationWarning, stacklevel=3)

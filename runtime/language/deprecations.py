"""What is going to go: told whenever it is used, until the version from which on it is gone (CHANGELOG.md)."""

from __future__ import annotations

import warnings
from dataclasses import dataclass


@dataclass(frozen=True)
class Deprecation:
    """A call, a key or a command that still works: `what`, in a user's words."""

    what: str
    since: str  # version
    date: str  # of that, or where that is not released yet, of the decision: YYYY-MM-DD
    instead: str
    gone: str  # version, half a year later at the earliest

    def __str__(self) -> str:
        return (
            f"{self.what} is deprecated since gudgeon {self.since} ({self.date}) and gone from {self.gone} on: "
            f"use {self.instead}"
        )


STRESS = Deprecation("gudgeon stress", "0.1.0", "2026-11-26", "gudgeon map", "0.3.0")
DEPRECATIONS = (STRESS,)


def deprecated(one: Deprecation) -> None:
    """Told as a DeprecationWarning, at the line that called the caller."""
    warnings.warn(str(one), DeprecationWarning, stacklevel=3)

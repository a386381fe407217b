"""Masses, or moments of inertia, so far apart that no double holds a sum of both."""

from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource

MOST_APART = 1e14  # times, that one may be another: a sum of both still knows the lighter one


def far_masses(source: KernelSource, mass: NDArray[Any]) -> str:
    """What is said of them, mass (n,) being the diagonal of M; "" where a double knows both."""
    for what, unit, row in (("masses", "kg", 0), ("inertias", "kg*m^2", 2)):
        of = {body.name: float(mass[body.index + row]) for body in source.bodies}
        least, most = min(of, key=of.__getitem__), max(of, key=of.__getitem__)
        if of[most] >= MOST_APART * of[least]:
            told = f"the {what} of {most} ({of[most]:g} {unit}) and {least} ({of[least]:g} {unit}) are too far apart"
            return f"{told} for doubles\n  expected none {MOST_APART:g} times another one; check their units"
    return ""

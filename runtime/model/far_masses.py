"""Masses, or moments of inertia, so far apart that no double holds a sum of both."""

from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource

MOST_APART = 1e14  # times, that one may be another: a sum of both still knows the lighter one
MAX_RATIO_OF_POINTS = 1e12  # the same of masses if an inertia is 0: its body's rotation has the inertia m l^2 alone


def far_masses(source: KernelSource, mass: NDArray[Any]) -> str:
    """Return which masses or inertias are too far apart for doubles, "" if none are.

    mass (n,): the diagonal of M, kg and kg*m^2. An inertia of 0 is allowed by the format, and is compared with none.
    """
    points = any(mass[body.index + 2] == 0.0 for body in source.bodies)
    for what, unit, row, limit in (
        ("masses", "kg", 0, MAX_RATIO_OF_POINTS if points else MOST_APART), ("inertias", "kg*m^2", 2, MOST_APART),
    ):  # fmt: skip
        of = {body.name: float(x) for body in source.bodies if (x := mass[body.index + row]) > 0.0}
        if not of:
            continue
        least, most = min(of, key=of.__getitem__), max(of, key=of.__getitem__)
        if of[most] >= limit * of[least]:
            told = f"the {what} of {most} ({of[most]:g} {unit}) and {least} ({of[least]:g} {unit}) are too far apart"
            beside = " where a body has an inertia of 0" if limit < MOST_APART else ""
            return f"{told} for doubles\n  expected none {limit:g} times another one{beside}; check their units"
    return ""

"""Numbers as the tables and maps say them."""

from __future__ import annotations

import math


def share(value: float) -> str:
    """A share: 12 %, 0.30 %, 4e-7."""
    if math.isnan(value):
        return "–"
    if 1e-4 <= value < 100:
        return f"{100 * value:.{0 if value >= 0.1 else 1 if value >= 0.01 else 2}f} %"
    return f"{value:.0e}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def rough_share(value: float) -> str:
    """The same in a cell of a map, where what is small is just small."""
    return "< 0.01 %" if value < 1e-4 else share(value)


def seconds(value: float) -> str:
    """A step or a short time: below 1 ms in µs, so that a column of steps reads in one unit."""
    for factor, unit in ((1e9, "ns"), (1e6, "µs"), (1e3, "ms"), (1.0, "s")):
        if abs(value) * factor < 999.5:
            return f"{value * factor:.3g} {unit}"
    return f"{value:.3g} s" if math.isfinite(value) else "–"


def clearance(value: float) -> str:
    """A radial clearance in mm, as drawings have it; "no play" for NaN."""
    return "no play" if math.isnan(value) else f"{value * 1e3:.3g} mm"

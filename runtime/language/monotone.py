"""Slopes of monotone cubics: C¹, and never beyond the points on either side.

F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238–246; F. N. Fritsch, J. Butland, SIAM J. Sci. Stat.
Comput. 5 (1984) 300–304.
"""

from __future__ import annotations

from collections.abc import Sequence


def monotone_slopes(h: Sequence[float], rises: Sequence[float], repeats: bool, flat_ends: bool) -> list[float]:
    """Return the slopes at the knots: weighted harmonic means of the rises on both sides, 0 at extremes.

    h, rises: lengths and rises of the pieces, (n,). `repeats`: the end is the beginning; `flat_ends`: no slope there.
    """
    if repeats:
        inner = [_mean(*of) for of in zip([h[-1], *h[:-1]], h, [rises[-1], *rises[:-1]], rises, strict=True)]
        return [*inner, inner[0]]
    inner = [_mean(*of) for of in zip(h, h[1:], rises, rises[1:], strict=False)]
    if flat_ends:
        return [0.0, *inner, 0.0]
    if not inner:
        return [rises[0], rises[0]]
    first, last = _end_slope(*h[:2], *rises[:2]), _end_slope(*h[:-3:-1], *rises[:-3:-1])
    return [first, *inner, last]


def _mean(a: float, b: float, p: float, q: float) -> float:
    """The slope between pieces of lengths a, b and rises p, q."""
    if p * q <= 0.0:
        return 0.0
    w, v = 2.0 * b + a, b + 2.0 * a
    return (w + v) / (w / p + v / q)


def _end_slope(a: float, b: float, p: float, q: float) -> float:
    """The slope at the end of the outer piece (a, p) by the parabola through it and its neighbour (b, q), limited."""
    slope = ((2.0 * a + b) * p - a * q) / (a + b)
    if slope * p <= 0.0:
        return 0.0
    return 3.0 * p if p * q <= 0.0 and abs(slope) > 3.0 * abs(p) else slope

"""Squares but for the rounding of their coefficients: t² − 0.4404 t + 0.04848804 is (t − 0.2202)²."""

from __future__ import annotations

import math
import sys
from collections import defaultdict
from collections.abc import Sequence

import sympy as sp

_ROUNDING = 8 * sys.float_info.epsilon  # of a coefficient, as a share of what is added up to it
_MOST = 16  # terms of a root

_Powers = tuple[int, ...]


def near_square_root(polynomial: sp.Expr, names: Sequence[sp.Symbol]) -> sp.Expr | None:
    """r with r² = polynomial, in some names, within the rounding of its numbers; None where there is none."""
    found = sp.Poly(polynomial, *names)
    if not all(c.is_Number for c in found.coeffs()):
        return None
    wanted = {powers: float(c) for powers, c in found.terms()}
    root = _root_of(wanted)
    if root is None:
        return None
    return sp.Add(*(
        (sp.Integer(int(c)) if c == int(c) else sp.Float(c, 17)) * sp.prod(map(sp.Pow, names, powers))
        for powers, c in root.items()
    ))  # fmt: skip


def _root_of(wanted: dict[_Powers, float]) -> dict[_Powers, float] | None:
    """Term by term from the highest one on, each from what the square of those before leaves of it."""
    first, highest = max(wanted), wanted[max(wanted)]
    if any(k % 2 for k in first) or not highest > 0.0:
        return None
    root = {tuple(k // 2 for k in first): math.sqrt(highest)}
    lead, scale = next(iter(root.items()))
    while (left := _left(wanted, root)) and len(root) < _MOST:
        powers = tuple(a - b for a, b in zip(max(left), lead, strict=True))
        if min(powers) < 0 or powers in root:
            return None
        root[powers] = left[max(left)] / (2.0 * scale)
    return None if left else root


def _left(wanted: dict[_Powers, float], root: dict[_Powers, float]) -> dict[_Powers, float]:
    """What is left of the coefficients beyond rounding, less those of the square."""
    difference, size = defaultdict(float, wanted), defaultdict(float, {k: abs(c) for k, c in wanted.items()})
    for a, x in root.items():
        for b, y in root.items():
            powers = tuple(i + j for i, j in zip(a, b, strict=True))
            difference[powers] -= x * y
            size[powers] += abs(x * y)
    return {powers: c for powers, c in difference.items() if abs(c) > _ROUNDING * size[powers]}

"""The tables of a file's curves as Python, and what evaluates them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gudgeon.generator.symbols.curves import c_name
from gudgeon.generator.targets.numpy.layout import remark
from gudgeon.language.curves import MARGIN, Curve

_CURVE = f'''def curve(of, order, x):
    """A cubic spline (order 0) or a derivative of it: NaN outside its range, or repeated there."""
    knots, c, repeats = of
    first, last = knots[0], knots[-1]
    margin = {MARGIN} * (last - first)
    inside = repeats | ((x >= first - margin) & (x <= last + margin))
    x = x - (last - first) * np.floor((x - first) / (last - first)) if repeats else x
    k = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, len(c) - 1)
    h, (c0, c1, c2, c3) = x - knots[k], np.moveaxis(c[k], -1, 0)
    value = (c0 + h * (c1 + h * (c2 + h * c3)), c1 + h * (2.0 * c2 + h * (3.0 * c3)),
             2.0 * c2 + h * (6.0 * c3), 6.0 * c3)[order]
    return np.where(inside, value, np.nan)[()]


def knots(of, x):
    """By its sign, whether x is in a piece with an even number or an odd one; 0 at knots."""
    of, _, repeats = of
    x = x - (of[-1] - of[0]) * np.floor((x - of[0]) / (of[-1] - of[0])) if repeats else x
    k = np.clip(np.searchsorted(of, x, side="right") - 1, 0, len(of) - 2)
    return np.where(k % 2, -1.0, 1.0) * np.where(x == of[k], 0.0, 1.0)'''


def with_curves(curves: Mapping[str, Curve], text: str, before: str = "") -> str:
    """What the functions of a text read of curves, without what stands before it; "" where they call none."""
    called = [curve for curve in curves.values() if f"({c_name(curve.name)}," in text]
    parts = [_CURVE, *map(_table, called)] if called else []
    return "".join(f"{part}\n\n\n" for part in parts if part not in before)


def _table(curve: Curve) -> str:
    if curve.is_long:
        x, c = (np.asarray(table, "<f8").tobytes().hex() for table in (curve.x, curve.coefficients))
        return "\n".join([
            *remark(f"{curve.name}: {curve.told()}"), f"{c_name(curve.name)} = (",
            f'    np.frombuffer(bytes.fromhex("{x}"), "<f8"),',
            f'    np.frombuffer(bytes.fromhex("{c}"), "<f8").reshape(-1, 4),', f"    {curve.repeats},", ")",
        ])  # fmt: skip
    knots = [", ".join(map(repr, curve.x[k : k + 3])) for k in range(0, len(curve.x), 3)]
    pieces = [f"        [{', '.join(map(repr, piece))}]," for piece in curve.coefficients]
    return "\n".join([
        *remark(f"{curve.name}: {curve.told()}"), f"{c_name(curve.name)} = (",
        "    np.array([", *(f"        {line}," for line in knots), "    ]),",
        "    np.array([", *pieces, "    ]),", f"    {curve.repeats},", ")",
    ])  # fmt: skip

"""Where a drive runs through a curve again and again by `mod`: whether the curve's end meets its beginning."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.curves import Curve
from gudgeon.language.tree import Call, CurveCall, curve_calls, from_json, names
from gudgeon.model.compiled import Array
from gudgeon.model.written import of_time

SAMPLES = 1025  # of a run's time, at which is looked whether it passes such a place
SAME = 1e-9  # of what a curve has in all: derivatives that differ by less meet
_ORDERS = ("value", "slope", "second derivative")
_SO = ("it", "its rate", "its acceleration")  # of the drive


def seams(source: KernelSource, p: Array, t0: float = 0.0, t1: float = math.inf) -> Iterator[str]:
    """A remark on each drive that jumps, or its rate, or its acceleration, where `mod` begins anew in t0 < t < t1."""
    for info in source.written:
        if not (info.address.startswith("drives.") and '"curve"' in info.tree and '"mod"' in info.tree):
            continue
        for call in curve_calls(from_json(json.loads(info.tree))):
            inner = call.arguments[0]
            if isinstance(inner, Call) and inner.function == "mod" and _passes(source, p, inner, t0, t1):
                period = float(of_time(source, p, inner.arguments[1], np.array([t0]))[0])
                yield from _seam(call, period, info.address.split(".")[1])


def _passes(source: KernelSource, p: Array, inner: Call, t0: float, t1: float) -> bool:
    """Whether it begins anew within a run, by a period that does not change."""
    of, period = inner.arguments
    if any(name.path == "t" for name in names(period)):
        return False
    with np.errstate(all="ignore"):
        times = np.linspace(t0, t1, SAMPLES)[1:-1] if math.isfinite(t1) else np.zeros(0)
        turns = np.floor(of_time(source, p, of, times) / of_time(source, p, period, times))
    return not math.isfinite(t1) or bool(np.ptp(turns) != 0.0)


def _seam(call: CurveCall, period: float, drive: str) -> Iterator[str]:
    """The first derivative that jumps from the period's end to 0."""
    curve: Curve = call.curve
    for order, (what, so) in enumerate(zip(_ORDERS, _SO, strict=True)):
        end, begin = float(curve.at(period, order)), float(curve.at(0.0, order))
        most = float(np.abs(curve.at(np.array(curve.x), order)).max())
        if not abs(end - begin) <= SAME * most and math.isfinite(end + begin):
            yield (
                f"drive {drive}: where mod begins curve {curve.name} anew its {what} jumps from {end:.4g} to"
                f" {begin:.4g} (SI), and so does {so}: {_remedy(curve, period, order)}"
            )
            return


def _remedy(curve: Curve, period: float, order: int) -> str:
    whole = abs(period - (curve.x[-1] - curve.x[0])) <= SAME * abs(period) and abs(curve.x[0]) <= SAME * abs(period)
    if not whole:
        return f"mod's period is {period:.6g}, and the curve goes {curve.range_text}"
    if not order:
        return "give it a last point whose y is that of the first, and ends: periodic"
    return f"ends: periodic in curves.{curve.name} makes it smooth there"

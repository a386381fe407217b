"""Check drives that repeat a curve by `mod`: whether the curve's end continues in its beginning."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.curves import Curve
from gudgeon.language.tree import Call, CurveCall, curve_calls, from_json, names
from gudgeon.model.compiled import Array
from gudgeon.model.written import values_of_time

SAMPLES = 1025  # times at which the run is tested for passing the end of a period
SAME = 1e-9  # relative difference up to which derivatives count as equal
_ORDERS = ("value", "slope", "second derivative")
_SO = ("it", "its rate", "its acceleration")  # quantities of the drive


def curve_seam_notes(source: KernelSource, p: Array, t0: float = 0.0, t1: float = math.inf) -> Iterator[str]:
    """Yield a note on each drive whose value, rate or acceleration jumps where `mod` restarts in t0 < t < t1."""
    for info in source.written:
        if not (info.address.startswith("drives.") and '"curve"' in info.tree and '"mod"' in info.tree):
            continue
        for call in curve_calls(from_json(json.loads(info.tree))):
            inner = call.arguments[0]
            if isinstance(inner, Call) and inner.function == "mod" and _restarts_within(source, p, inner, t0, t1):
                period = float(values_of_time(source, p, inner.arguments[1], np.array([t0]))[0])
                yield from _note_jump(call, period, info.address.split(".")[1])


def _restarts_within(source: KernelSource, p: Array, inner: Call, t0: float, t1: float) -> bool:
    """Return whether mod restarts within a run, with a constant period."""
    of, period = inner.arguments
    if any(name.path == "t" for name in names(period)):
        return False
    with np.errstate(all="ignore"):
        times = np.linspace(t0, t1, SAMPLES)[1:-1] if math.isfinite(t1) else np.zeros(0)
        turns = np.floor(values_of_time(source, p, of, times) / values_of_time(source, p, period, times))
    return not math.isfinite(t1) or bool(np.ptp(turns) != 0.0)


def _note_jump(call: CurveCall, period: float, drive: str) -> Iterator[str]:
    """Yield a note on the first derivative of the curve that jumps from the period's end to 0."""
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
    """Return the remedy for a jump of the derivative of the given order."""
    whole = abs(period - (curve.x[-1] - curve.x[0])) <= SAME * abs(period) and abs(curve.x[0]) <= SAME * abs(period)
    if not whole:
        return f"mod's period is {period:.6g}, and the curve goes {curve.range_text}"
    if not order:
        return "give it a last point whose y is that of the first, and ends: periodic"
    return f"ends: periodic in curves.{curve.name} makes it smooth there"

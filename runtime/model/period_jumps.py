"""Check periodic drives (a curve repeated by `mod`): whether value or derivatives jump at the end of a period."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator

import numpy as np

from gudgeon.contract.kernel_source import ExpressionInfo, KernelSource
from gudgeon.language.curves import Curve
from gudgeon.language.tree import Call, CurveCall, from_json, iterate_curve_calls, iterate_names
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array
from gudgeon.model.file_expressions import evaluate_at_times

N_TEST_TIMES = 1025  # times at which the run is tested for passing the end of a period
DERIVATIVE_TOL = 1e-9  # relative difference up to which derivatives count as equal
_ORDERS = ("value", "slope", "second derivative")
_DRIVE_QUANTITIES = ("it", "its rate", "its acceleration")  # quantities of the drive


def iterate_period_jump_warnings(
    source: KernelSource, p: Array, t0: float = 0.0, t1: float = math.inf
) -> Iterator[str]:
    """Yield a warning for each drive whose value, rate or acceleration jumps where `mod` restarts in t0 < t < t1.

    p: parameter values of the run; t0, t1: begin and end of the run (s). Periods that depend on time give none.
    """
    for info in list_periodic_drives(source):
        for call in iterate_curve_calls(from_json(json.loads(info.tree))):
            mod_call = call.arguments[0]
            if isinstance(mod_call, Call) and mod_call.function == "mod" and _has_restart(source, p, mod_call, t0, t1):
                period = float(evaluate_at_times(source, p, mod_call.arguments[1], np.array([t0]))[0])
                yield from _describe_jump(call, period, info.address.split(".")[1])


@cache_by_values
def list_periodic_drives(source: KernelSource) -> tuple[ExpressionInfo, ...]:
    """Return the expressions of drives with a curve and `mod`."""
    drives = (info for info in source.file_expressions if info.address.startswith("drives."))
    return tuple(info for info in drives if '"curve"' in info.tree and '"mod"' in info.tree)


def _has_restart(source: KernelSource, p: Array, mod_call: Call, t0: float, t1: float) -> bool:
    """Return whether mod restarts at a time t0 < t < t1; False for a period that depends on time.

    Without an end (t1 = ∞) it is assumed to restart. The quotient is sampled at N_TEST_TIMES times.
    """
    dividend, period = mod_call.arguments
    if any(name.path == "t" for name in iterate_names(period)):
        return False
    with np.errstate(all="ignore"):
        times = np.linspace(t0, t1, N_TEST_TIMES)[1:-1] if math.isfinite(t1) else np.zeros(0)
        quotients = np.floor(
            evaluate_at_times(source, p, dividend, times) / evaluate_at_times(source, p, period, times)
        )
    return not math.isfinite(t1) or bool(np.ptp(quotients) != 0.0)


def _describe_jump(call: CurveCall, period: float, drive: str) -> Iterator[str]:
    """Yield a note on the first derivative of the curve that jumps from the period's end to 0; nothing if none jumps.

    period: of `mod`, in the unit (SI) of the curve's argument; drive: the drive's name.
    """
    curve: Curve = call.curve
    for order, (derivative_name, drive_quantity) in enumerate(zip(_ORDERS, _DRIVE_QUANTITIES, strict=True)):
        end, begin = float(curve.evaluate(period, order)), float(curve.evaluate(0.0, order))
        largest_value = float(np.abs(curve.evaluate(np.array(curve.x), order)).max())
        if not abs(end - begin) <= DERIVATIVE_TOL * largest_value and math.isfinite(end + begin):
            yield (
                f"drive {drive}: where mod restarts curve {curve.name}, its {derivative_name} jumps from {end:.4g} to"
                f" {begin:.4g} (SI), and so does {drive_quantity}: {_format_jump_hint(curve, period, order)}"
            )
            return


def _format_jump_hint(curve: Curve, period: float, order: int) -> str:
    """Return the hint for a jump of the curve's derivative of the given order (0: of its value).

    It is only the reason of the jump if mod's period differs from the curve's length, or the curve does not begin at 0.
    """
    is_curve_length = abs(period - (curve.x[-1] - curve.x[0])) <= DERIVATIVE_TOL * abs(period) and abs(
        curve.x[0]
    ) <= DERIVATIVE_TOL * abs(period)
    if not is_curve_length:
        return f"mod's period is {period:.6g}, and the curve is defined {curve.range_text}"
    if not order:
        return "give it a last point whose y is that of the first, and ends: periodic"
    return f"ends: periodic in curves.{curve.name} makes it smooth there"

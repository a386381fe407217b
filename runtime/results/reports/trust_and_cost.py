"""Rows of a table of runs: how far they may be trusted, and what they cost."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from gudgeon.language.plot_units import quantity

AUDIT_SHOWN = 1e-3  # limits, from which on a check of the audit has a row of its own

if TYPE_CHECKING:
    from gudgeon.results.reports.comparison import SceneReport


def trust_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    every = [report.diagnostics for report in reports]
    play = [bool(d.peaks) for d in every]
    ratio = [f"{d.ratio_min:.3g} … {d.ratio_max:.3g}" if math.isfinite(d.ratio_min) else "–" for d in every]
    return [
        ("max |Φ|", [f"{r.diagnostics.phi_max:.2e}" if r.constrained else "no row is left" for r in reports]),
        ("max |Φ̇|", [f"{r.diagnostics.phi_dot_max:.2e}" if r.constrained else "–" for r in reports]),
        ("energy residual", [quantity(d.energy_residual, "J", 3) for d in every]),
        ("energy turned over", [quantity(d.energy_turned_over, "J", 3) for d in every]),
        ("trusted until", [_until(d.horizon) for d in every]),
        ("contacts that began", [str(d.onsets) if p else "–" for d, p in zip(every, play, strict=True)]),
        ("grazes", [str(d.grazes) if p and d.grazes else "–" for d, p in zip(every, play, strict=True)]),
        ("δ̇/δ̇⁻ while latched", ratio),
        ("steps with it outside ±1", [str(d.ratio_outside) if math.isfinite(d.ratio_min) else "–" for d in every]),
        *_audit_rows(reports),
    ]


def _audit_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """The largest value of each check of the audit, in its limits, as far as it is above rounding."""
    found = [{one.check: one.worst for one in report.diagnostics.audit} for report in reports]
    checks = dict.fromkeys(check for one in found for check, worst in one.items() if worst >= AUDIT_SHOWN)
    largest = [max(one.values(), default=math.nan) for one in found]
    return [
        ("audit, in limits", [f"{worst:.1e}" if math.isfinite(worst) else "–" for worst in largest]),
        *((f"audit of {check}", [f"{one[check]:.1e}" if check in one else "–" for one in found]) for check in checks),
    ]


def _until(horizon: float) -> str:
    """See predictability.py; NaN: nobody asked."""
    return "to the end" if horizon == math.inf else quantity(horizon, "s", 3)


def cost_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    every = [report.diagnostics for report in reports]
    return [
        ("method", [d.method for d in every]),
        ("step", [quantity(d.step, "s") for d in every]),
        ("last step", [quantity(d.last_step, "s") for d in every]),
        ("tolerance of a step", [f"{d.rtol:.3g}" if math.isfinite(d.rtol) else "–" for d in every]),
        ("steps", [f"{d.steps:,}" if d.steps else "–" for d in every]),
        ("right-hand sides", [f"{d.right_hand_sides:,}" if d.right_hand_sides else "–" for d in every]),
        ("s per simulated s", [f"{d.seconds_per_simulated_second:.3g}" for d in every]),
    ]

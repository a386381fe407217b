"""What C's audit of a run found (engine/run/audit.c), with names, as an error or as notes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.audit import CHECKS, SAMPLE_CHECKS, Check, Finding
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import AuditError
from gudgeon.model.compiled import Array

REMEDY = (
    "the result cannot be trusted: compare with another method, a smaller rtol or formulation full; audit=False runs"
    " without this check"
)


def as_findings(source: KernelSource, worst: Array, t: Array, where: NDArray[np.intc]) -> tuple[Finding, ...]:
    """Return the findings from values, times and places (n_checks,) as a run reports them.

    What was not checked, and has a negative value, has none.
    """
    rows = zip(CHECKS, worst.tolist(), t.tolist(), where.tolist(), strict=True)
    return tuple(Finding(check.name, value, at, _place(source, check, k)) for check, value, at, k in rows
                 if value >= 0.0)  # fmt: skip


def _place(source: KernelSource, check: Check, k: int) -> str:
    if k < 0 or not check.place:
        return ""
    if check.place == "joint":
        return source.clearances[k].name
    if check.place == "row":
        return source.start_rows[k].name
    if check.place == "event":
        return source.events[k].name
    return source.coordinates[k] if check.place == "coordinate" else f"{check.place} {k}"


def audit_failure(findings: tuple[Finding, ...]) -> AuditError:
    """Return the error for a run that a check of its audit ended."""
    worst = max(findings, key=lambda one: one.worst)
    return AuditError(f"{describe(worst)}\n  {REMEDY}", worst.t)


def notes_of(findings: tuple[Finding, ...]) -> tuple[str, ...]:
    """Return a note for each check above its limit."""
    return tuple(describe(one) for one in findings if not one.worst <= 1.0)


def describe(finding: Finding) -> str:
    """Return a finding in words: the check, the value, the time and the place."""
    check = next(one for one in (*CHECKS, *SAMPLE_CHECKS) if one.name == finding.check)
    place = f" at {check.place} {finding.place}" if finding.place else ""
    return (
        f"audit: check {check.name} of {check.compares} exceeds its limit {finding.worst:.3g} times at"
        f" t = {finding.t:.9g} s{place}"
    )

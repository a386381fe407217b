"""Keep the former names of the functions of `gudgeon.studies.map`, so that older programs still run."""

from __future__ import annotations

from gudgeon.studies.map import VerdictBox as StressBox
from gudgeon.studies.map import VerdictMap as StressMap
from gudgeon.studies.map import compute_verdict_box as stress_box
from gudgeon.studies.map import compute_verdict_map as stress

__all__ = ["StressBox", "StressMap", "stress", "stress_box"]

"""Test the robustness of runs at the corners of a box of parameters and at Sobol points (quasi-random) in it.

Two criteria apply to a point. A run over the whole time must remain valid: finite, constraints satisfied, energy
balanced, no contact missed. It must also agree with a hundred times tighter tolerance over a window that ends half-way
between the fourth onset of a contact and the next.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.integrators.trajectory import Progress
from gudgeon.language.argument_checks import check_number
from gudgeon.model.compiled import Array
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.runs import N_ONSETS, Attempt, Parameters, SceneWindow, Setting, compute_differences
from gudgeon.studies.verdicts import Cell, Limits, Pair, classify_runs, select_limits

REFERENCE_TOLERANCE_RATIO = 100.0
SOBOL_SEED = 20  # seed of the scrambling of the Sobol sequence
N_SAMPLES = 1000  # intervals between the samples of the comparison window
N_LONG_RUN_INTERVALS = 10_000  # intervals between the samples of the long run, short enough to show a missed contact
PREDICTABILITY_RTOL = 1e-10  # maximum tolerance of the two runs that determine how long runs are predictable
ERROR_SAFETY_FACTOR = 10.0  # errors of finer runs may exceed proportionality to the tolerance by this factor
CPU_LIMIT_FACTOR = 10.0  # limit of processor time of the finer runs, as a multiple of that of the long run


@dataclass(frozen=True)
class Range:
    """One edge of the box: a parameter, or a group of parameters, that varies from `low` to `high` on a log scale (SI).

    name: address of the parameter, or name of a group such as "stiffness". unit: for display only.
    """

    name: str
    low: float
    high: float
    unit: str = ""

    def __post_init__(self) -> None:
        """Raise BadValueError unless both ends are numbers with 0 < low ≤ high."""
        if not 0.0 < check_number(self.low, f"range {self.name}") <= check_number(self.high, f"range {self.name}"):
            raise BadValueError(f"range {self.name}={self.low:g}..{self.high:g}: expected 0 < low ≤ high")

    def interpolate(self, fraction: float) -> float:
        """Return low · (high/low)^fraction, exactly `low` at fraction 0 and `high` at 1."""
        if fraction in (0.0, 1.0):
            return (self.low, self.high)[int(fraction)]
        return self.low * (self.high / self.low) ** fraction


def list_corners(ranges: Sequence[Range]) -> list[dict[str, float]]:
    """Return the parameter values at all 2^n corners of the box, range name to value (SI); the last range varies
    fastest.
    """
    return [_interpolate_point(ranges, fractions) for fractions in itertools.product((0.0, 1.0), repeat=len(ranges))]


def sample_sobol_points(ranges: Sequence[Range], count: int) -> list[dict[str, float]]:
    """Return the values at the first `count` scrambled Sobol points of the box, range name to value (SI).

    The points are the same in every call, since the seed is fixed (A. B. Owen, J. Complexity 14, 1998). The list is
    empty for a count below 1 or without ranges.
    """
    from scipy.stats import qmc

    if count < 1 or not ranges:
        return []
    fractions = qmc.Sobol(len(ranges), seed=SOBOL_SEED).random_base2(max(0, math.ceil(math.log2(count))))
    return [_interpolate_point(ranges, row) for row in fractions[:count].tolist()]


def _interpolate_point(ranges: Sequence[Range], fractions: Sequence[float]) -> dict[str, float]:
    """Return the values at a point of the box, range name to value, from its fraction (0 to 1) along each range."""
    return {range_.name: range_.interpolate(fraction) for range_, fraction in zip(ranges, fractions, strict=True)}


def judge_point(
    simulation: Simulation,
    parameters: Parameters,
    t_end: float,
    setting: Setting,
    limits: Limits | None = None,
    cpu_limit: float = math.inf,
    progress: Progress | None = None,
) -> Cell:
    """Return the verdict on one point of a box from a long run over [0, t_end] (s) and two runs over the first
    contacts.

    limits: None means those of the setting. cpu_limit (s): processor time of the long run; the other runs may take
    CPU_LIMIT_FACTOR times longer. A failed long run is judged alone. If the two runs differ by more than the limits,
    both are run and compared again over the predictable samples only (`_count_predictable_samples`). `progress`
    receives the progress of the long run; None: nothing is reported.
    """
    window, limits = SceneWindow(simulation, t_end, parameters, limit=cpu_limit), limits or select_limits(setting)
    long_run = window.run_at_times(setting, np.linspace(0.0, t_end, N_LONG_RUN_INTERVALS + 1), progress)
    if long_run.failure or long_run.run is None:
        return classify_runs(parameters, long_run, [], limits)
    refined_window = replace(window, limit=CPU_LIMIT_FACTOR * cpu_limit)
    times = choose_comparison_times(long_run.run)
    run_pair = _run_coarse_and_fine(refined_window, setting, times)
    cell = classify_runs(parameters, long_run, [run_pair], limits)
    if cell.failed and cell.error.exceeds_limits(limits.motion, limits.path, limits.force):
        predictable_samples = times[: _count_predictable_samples(refined_window, run_pair[1], limits)]
        cell = classify_runs(
            parameters,
            long_run,
            [_run_coarse_and_fine(refined_window, setting, predictable_samples)]
            if len(predictable_samples) > 1
            else [],
            limits,
        )
    return cell


def choose_comparison_times(run: Result) -> Array:
    """Return N_SAMPLES + 1 evenly spaced times (s) from 0 at which two runs are compared.

    The last time is half-way between the fourth onset of a contact (N_ONSETS) and the next, or the end of a run with
    four onsets or fewer.
    """
    onsets = np.sort(run.impacts["t_on"])
    end = float(onsets[N_ONSETS - 1] + onsets[N_ONSETS]) / 2 if len(onsets) > N_ONSETS else float(run.t[-1])
    return np.linspace(0.0, end, N_SAMPLES + 1)


def _run_coarse_and_fine(window: SceneWindow, setting: Setting, times: Array) -> Pair:
    """Return the outcomes of two runs at the same times (s): with the setting, and with a 100 times tighter tolerance.

    The ratio of the tolerances is REFERENCE_TOLERANCE_RATIO.
    """
    return window.run_at_times(setting, times), window.run_at_times(setting.refine(REFERENCE_TOLERANCE_RATIO), times)


def _count_predictable_samples(window: SceneWindow, fine_run: Attempt, limits: Limits) -> int:
    """Return the number of samples of `fine_run` that are predictable: a run can agree with them within the limits.

    Two further runs, at tolerances of at most PREDICTABILITY_RTOL and a hundredth of it, are compared. The first sample
    at which they differ by more than limit/(ERROR_SAFETY_FACTOR · REFERENCE_TOLERANCE_RATIO) ends the predictable
    samples, since contacts amplify differences. The result is N_SAMPLES + 1 if no sample does, or if a run failed.
    """
    if fine_run.run is None:
        return N_SAMPLES + 1
    tightest = replace(fine_run.setting, value=min(fine_run.setting.value, PREDICTABILITY_RTOL))
    settings = (tightest, tightest.refine(REFERENCE_TOLERANCE_RATIO))
    a, b = (window.run_at_times(setting, fine_run.run.t) for setting in settings)
    if a.run is None or b.run is None or a.failure or b.failure:
        return N_SAMPLES + 1
    bounds = (limits.motion, limits.path, limits.force)
    exceeds = np.any(
        [
            differences > limit / (ERROR_SAFETY_FACTOR * REFERENCE_TOLERANCE_RATIO)
            for differences, limit in zip(compute_differences(a.run, b.run), bounds, strict=True)
        ],
        axis=0,
    )
    return int(np.argmax(exceeds)) if exceeds.any() else N_SAMPLES + 1

"""Own peaks of series: over all steps of a run where they were requested, `run.peak("S9.ay")`, and over its samples.

Also peaks as rows of a table, and the largest forces in joints with play of many runs. An impact of rigid surfaces is a
record of a run's impacts with zero duration, whose F_peak is an impulse.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import PEAK_F, PEAK_e_max, PEAK_t
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.series import check_series

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array
    from gudgeon.results.results import Result

PEAK_DTYPE = np.dtype([(name, "f8") for name in ("F", "t", "e_max", "first_contact", "first_peak")])
ENDS = ("max", "t_max", "min", "t_min")
FEW, MESSAGES = 3, 3  # smallest number of impacts of a Zeno point; Zeno points that are reported one by one


@dataclass(frozen=True)
class Extreme:
    """Smallest and largest value of a series over the samples of a run, and value and time of the largest magnitude."""

    name: str
    unit: str
    low: float
    high: float
    peak: float
    t: float


def sample_extreme(name: str, unit: str, t: Array, values: Array) -> Extreme:
    """Return the extremes of a series over its samples (N,); NaN if no value is finite."""
    if not np.isfinite(values).any():
        return Extreme(name, unit, math.nan, math.nan, math.nan, math.nan)
    at = int(np.nanargmax(np.abs(values)))
    return Extreme(name, unit, float(np.nanmin(values)), float(np.nanmax(values)), float(values[at]), float(t[at]))


def over_all_steps(run: Result, name: str, error: bool) -> Extremes:
    """Return the extremes of a series of a run, or of its error against another scene, over all steps.

    Raises UnknownNameError for a series that the run does not have, BadValueError for one whose peaks were not
    requested.
    """
    if not isinstance(name, str) or name not in run.names:
        raise run.unknown(name)
    for one in run.diagnostics.extremes:
        if one.name == name and bool(one.against) == error:
            return one if error else _with_samples(one, run)
    raise _not_requested(name, error)


def _with_samples(extremes: Extremes, run: Result) -> Extremes:
    """Extend the extremes over all steps so that no sample lies beyond them.

    Between the ends of a step its polynomial is only as accurate as the tolerance.
    """
    try:
        values = run[extremes.name]
    except GudgeonError:  # a sample has none
        return extremes
    ends = ((extremes.max, extremes.t_max), (extremes.min, extremes.t_min))
    (high, at_high), (low, at_low) = (
        _extend_extremes(end, run.t[None], values[None], sign) for end, sign in zip(ends, (1.0, -1.0), strict=True)
    )
    return replace(extremes, max=float(high[0]), t_max=float(at_high[0]), min=float(low[0]), t_min=float(at_low[0]))


def _extend_extremes(
    end: tuple[Array | float, Array | float], t: Array, values: Array, sign: float
) -> tuple[Array, Array]:
    """Return extremes (n,) and their times, replaced by samples (n, N) at times (n, N) that lie beyond; sign −1 for
    minima.
    """
    found, at = (np.atleast_1d(np.asarray(x, dtype=float)) for x in end)
    if not values.shape[1]:
        return found, at
    known = np.where(np.isfinite(values), sign * values, -np.inf)
    best, runs = known.argmax(axis=1), np.arange(len(known))
    beyond = np.isfinite(known[runs, best]) & ~(sign * found >= known[runs, best])
    return np.where(beyond, values[runs, best], found), np.where(beyond, t[runs, best], at)


def _not_requested(name: str, error: bool) -> BadValueError:
    """Return the error for a peak that was not requested, with the call that requests it."""
    if error:
        message = f"the error of {name} over all steps is not known"
        return BadValueError(
            message, hint=f'simulate(…, peaks=["{name}"], against=ideal), where ideal is a loaded scene'
        )
    message = f"the peak of {name} over all steps was not asked for, and samples do not know it"
    return BadValueError(message, hint=f'simulate(…, peaks=["{name}"]), or peaks: [{name}] in the scene of the file')


def table_rows(
    scenes: Sequence[Sequence[Extremes]], cells: Sequence[Callable[[float, str, float], str]], errors: bool
) -> list[tuple[str, list[str]]]:
    """Return rows (name, one cell a scene) of a table of extremes.

    `cells` format value, unit and time of each scene. A row of errors has the largest magnitude; other series have a
    row for the largest and one for the smallest value.
    """
    found = [{one.name: one for one in extremes if bool(one.against) == errors} for extremes in scenes]
    rows = []
    for name in dict.fromkeys(name for one in found for name in one):
        for end in ("",) if errors else ("max", "min"):
            ends = [_extreme_cell(one[name], end) if name in one else None for one in found]
            texts = [cell(*at) if at else "–" for cell, at in zip(cells, ends, strict=True)]
            rows.append((f"{name} {end}".strip(), texts))
    return rows


def _extreme_cell(extremes: Extremes, end: str) -> tuple[float, str, float]:
    """Return value, unit and time of an extreme: "max", "min", or "" for the largest magnitude."""
    end = end or ("min" if -extremes.min > extremes.max else "max")
    return (
        (extremes.max, extremes.unit, extremes.t_max) if end == "max" else (extremes.min, extremes.unit, extremes.t_min)
    )


@dataclass(frozen=True, eq=False)
class BatchPeaks:
    """Extremes of a series of n runs, (n,) each; NaN for a run that did not begin."""

    name: str
    unit: str
    max: Array
    t_max: Array  # s
    min: Array
    t_min: Array  # s
    against: str = ""  # the scene whose series was subtracted; "": none

    @property
    def abs(self) -> Array:
        """The largest magnitude of each run, (n,)."""
        return np.maximum(self.max, -self.min)

    @property
    def t_abs(self) -> Array:
        """Time of the largest magnitude of each run, (n,), s."""
        return np.where(-self.min > self.max, self.t_min, self.t_max)


def batch_extremes(
    source: KernelSource,
    runs: Sequence[Sequence[Extremes]],
    name: str,
    error: bool,
    samples: Callable[[], tuple[Array, Array]],
) -> BatchPeaks:
    """Return the extremes of a series over all steps of each run.

    `samples` returns times and values (n, N); the extremes are extended so that no sample lies beyond. Raises
    UnknownNameError, BadValueError.
    """
    check_series(source, [name])
    found = [next((x for x in own if x.name == name and bool(x.against) == error), None) for own in runs]
    known = next(filter(None, found), None)
    if known is None:
        raise _not_requested(name, error)
    values = {key: np.array([getattr(x, key) if x else np.nan for x in found]) for key in ENDS}
    if not error:
        t, sampled = samples()
        for end, sign in (("max", 1.0), ("min", -1.0)):
            values[end], values[f"t_{end}"] = _extend_extremes((values[end], values[f"t_{end}"]), t, sampled, sign)
    return BatchPeaks(name, known.unit, **values, against=known.against)


def run_columns(runs: Sequence[Sequence[Extremes]]) -> Iterator[tuple[str, str, Array]]:
    """Yield name, unit and values (n,) of each extreme for tables: "S9.ay.peak.max", "S9.ay.error.max" and so on."""
    for one in dict.fromkeys((x.name, x.unit, x.against) for own in runs for x in own):
        found = [next((x for x in own if (x.name, x.unit, x.against) == one), None) for own in runs]
        for key in ENDS:
            values = np.array([getattr(x, key) if x else np.nan for x in found])
            yield f"{one[0]}.{'error' if one[2] else 'peak'}.{key}", "s" if key.startswith("t_") else one[1], values


def peaks_of(peaks: Array, contacts: NDArray[Any], count: NDArray[np.int_]) -> NDArray[Any]:
    """Return the peak forces of all runs as PEAK_DTYPE (n, n_clearances).

    `peaks` holds F, t, e_max (n, n_clearances, N_PEAK); `contacts` those of all runs one after the other, `count` how
    many each run has.
    """
    out = np.full(peaks.shape[:2], np.nan, dtype=PEAK_DTYPE)
    for k, name in ((PEAK_F, "F"), (PEAK_t, "t"), (PEAK_e_max, "e_max")):
        out[name] = peaks[:, :, k]
    runs = np.repeat(np.arange(len(count)), count)
    for joint in range(peaks.shape[1]):
        own = np.flatnonzero(contacts["joint"] == joint)
        own = own[np.flatnonzero(np.diff(runs[own], prepend=-1))]  # the first of each run
        run, begun = runs[own], contacts[own]
        out["first_contact"][run, joint] = begun["t_on"]
        out["first_peak"][run, joint] = np.where(is_rigid_impact(begun), np.nan, begun["F_peak"])
    return out


def is_rigid_impact(impacts: NDArray[Any]) -> NDArray[np.bool_]:
    """Return which of the impacts (k,) have zero duration: impacts of rigid surfaces."""
    found: NDArray[np.bool_] = impacts["t_off"] == impacts["t_on"]
    return found


def first_contact_force(impacts: NDArray[Any]) -> float:
    """Return the largest force of a joint's first contact, N; NaN for an impact of rigid surfaces, which has an impulse
    instead.
    """
    return math.nan if is_rigid_impact(impacts[:1])[0] else float(impacts["F_peak"][0])


def find_zeno_points(joints: Sequence[str], impacts: NDArray[Any]) -> Iterator[str]:
    """Yield a sentence for each Zeno point: impacts in ever shorter intervals until the contact closes."""
    for k, name in enumerate(joints):
        own = impacts[impacts["joint"] == k]
        closings = [(n, float(own["t_on"][i])) for i in range(len(own)) if (n := _bounces_before(own, i)) >= FEW]
        for count, t in closings[:MESSAGES]:
            yield (
                f"{name}: {count} bounces piled up until t = {t:.9g} s, where the contact is closed: they part slower"
                " than the law's threshold there"
            )
        if len(closings) > MESSAGES:
            yield f"{name}: bounces piled up {len(closings)} times, the last until t = {closings[-1][1]:.9g} s"


def _bounces_before(impacts: NDArray[Any], i: int) -> int:
    """Return how many impacts of a joint, each slower than the one before, end in its lasting contact i; 0 for an
    impact.
    """
    if bool(is_rigid_impact(impacts[i : i + 1])[0]):
        return 0
    count, slower = 0, 0.0
    for impact in impacts[:i][::-1]:
        ends_here = count > 0 or impact["t_on"] == impacts["t_on"][i]
        if not (ends_here and impact["t_off"] == impact["t_on"] and impact["deltadot"] > slower):
            break
        count, slower = count + 1, float(impact["deltadot"])
    return count

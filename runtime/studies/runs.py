"""Define the runs that `gudgeon bench` and `gudgeon map` compare: method, step or tolerance, times, error norms."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators.adaptive import MIN_RTOL
from gudgeon.integrators.trajectory import Progress
from gudgeon.model.compiled import Array
from gudgeon.model.default_step import evaluate_file_end_time, evaluate_scene_end_time, evaluate_scene_step
from gudgeon.model.parameters import compute_parameter_values
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.show.tables import format_seconds

NAN = math.nan
Parameters: TypeAlias = Mapping[str, float | str]  # as in `simulate`
N_ONSETS = 4  # onsets of contacts in a comparison window: after more of them, dry contact is chaotic
N_PILOT_HALVINGS = 6  # the first pilot run has 2^-6 of the length of the longest window
MIN_SAMPLES = 100  # minimum number of sample intervals in a window
FIXED_STEP_METHODS = ("rk4", "kinematic")  # methods whose setting is a step (s), not a tolerance
MAX_REPEATS, TIMING_BUDGET_S = (
    25,
    0.5,
)  # a timed run is repeated up to MAX_REPEATS times, or for TIMING_BUDGET_S seconds in total


@dataclass(frozen=True)
class Error:
    """Scaled maximum norms of the difference of two runs over their common samples; NaN where a quantity is missing."""

    motion: float = NAN  # of the coordinates: lengths divided by the mechanism's size, angles by 1 rad
    path: float = NAN  # of the journals' centres, divided by the clearance
    force: float = NAN  # of the joint forces, or of their peaks over all steps, divided by the peak force

    @property
    def largest(self) -> float:
        """Return the largest of the three measures that are not NaN; NaN if all are."""
        return max((x for x in (self.motion, self.path, self.force) if not math.isnan(x)), default=NAN)

    def exceeds_limits(self, motion: float, path: float, force: float) -> bool:
        """Return whether any of the three measures exceeds its limit; NaN never does."""
        return self.motion > motion or self.path > path or self.force > force


@dataclass(frozen=True)
class Setting:
    """A method with its step (s) for rk4 and kinematic, else with its tolerance."""

    method: str
    value: float  # the step (s) or the tolerance

    @property
    def has_fixed_step(self) -> bool:
        """Return whether the value is a fixed step (s), and not a tolerance."""
        return self.method in FIXED_STEP_METHODS

    def refine(self, factor: float) -> Setting:
        """Return the same method with the step or tolerance divided by `factor` and rounded to six digits.

        Rounding makes equal settings compare equal; a factor of 1 only rounds. A tolerance is at least MIN_RTOL, the
        minimum of the integrator.
        """
        min_value = 0.0 if self.has_fixed_step else MIN_RTOL
        return Setting(self.method, max(float(f"{self.value / factor:.6g}"), min_value))

    def __str__(self) -> str:
        """Return the step with its unit, such as "10 µs", or the tolerance, such as "1e-8"."""
        return format_seconds(self.value) if self.has_fixed_step else f"{self.value:.0e}".replace("e-0", "e-")


@dataclass(frozen=True)
class Attempt:
    """Outcome of one run: its result, which ends at `failed_at` if the run failed, and the reason ("" for none)."""

    setting: Setting
    run: Result | None
    failure: str = ""
    failed_at: float = NAN  # s
    slow: bool = False  # stopped at the limit of processor time
    outside: bool = False  # stopped with an error that reports a state outside the validity of the model
    cpu: float = NAN  # s, processor time of the thread, with the evaluation of samples


@dataclass(frozen=True, eq=False)
class SceneWindow:
    """A scene with parameters and a time window [0, t_end]; runs are sampled every max(step, sample_interval)."""

    simulation: Simulation
    t_end: float
    parameters: Parameters = field(default_factory=dict)
    end_reason: str = ""  # reason for the end of the window, for display: "the first 4 contacts", "no contact" or ""
    limit: float = math.inf  # s, maximum processor time of a run
    timing_budget: float = TIMING_BUDGET_S  # s, in total for the repetitions of a timed run

    @property
    def sample_interval(self) -> float:
        """Return the interval between samples (s): the largest power of ten that gives at least MIN_SAMPLES intervals.

        Steps 1, 2, 5 · 10^k then divide it or are multiples of it.
        """
        return 10.0 ** math.floor(math.log10(self.t_end / MIN_SAMPLES) + 1e-9)

    def run(self, setting: Setting, progress: Progress | None = None) -> Attempt:
        """Simulate the window with a setting, sampled on a grid that runs of several steps share; return the outcome.

        Samples are at multiples of the sample interval, or of the largest multiple of it within a longer fixed step.
        The last sample may lie before the end of the window. A failed run does not raise. `progress` None: nothing is
        reported.
        """
        stride = max(1, math.floor(setting.value / self.sample_interval * (1 + 1e-9))) if setting.has_fixed_step else 1
        count = max(1, math.floor(self.t_end / (stride * self.sample_interval) * (1 + 1e-9)))
        return self.run_at_times(
            setting, np.arange(count + 1, dtype=np.float64) * (stride * self.sample_interval), progress
        )

    def measure_run_time(self, setting: Setting, output: int = 1, progress: Progress | None = None) -> float:
        """Return the wall time of the integration (s): the minimum of up to MAX_REPEATS equal runs.

        output: number of sample intervals, 1 stores the two ends only. Repetition ends after `timing_budget` seconds in
        total. NaN if a run fails. `progress` receives the progress of each run; None: nothing is reported.
        """
        shortest, total = math.inf, 0.0
        for _ in range(MAX_REPEATS):
            attempt = self.run_at_times(setting, np.linspace(0.0, self.t_end, output + 1), progress)
            if attempt.run is None or attempt.failure:
                return NAN
            shortest = min(shortest, attempt.run.diagnostics.seconds)
            total += attempt.run.diagnostics.seconds
            if total > self.timing_budget:
                break
        return shortest

    def run_at_times(self, setting: Setting, times: Array, progress: Progress | None = None) -> Attempt:
        """Simulate with a setting and samples at these times (s) from the first to the last, and return the outcome.

        The processor time is limited to `limit` seconds. A failed run does not raise; Ctrl-C raises KeyboardInterrupt.
        """
        return attempt_run(self.simulation, times, setting, self.parameters, progress, self.limit)


class _TooSlowError(Exception):
    """A run exceeded its limit of processor time."""


def attempt_run(
    simulation: Simulation,
    times: Array,
    setting: Setting,
    parameters: Parameters,
    progress: Progress | None = None,
    limit: float = math.inf,
) -> Attempt:
    """Simulate a scene with one setting and return the outcome; a failed run has its reason and does not raise.

    times (s): samples. After `limit` seconds of processor time of this thread the run is stopped, has no result and is
    marked as slow. Events do not stop the run. After Ctrl-C it raises KeyboardInterrupt, where `simulate` would return
    the part of the run.
    """
    start_time = time.thread_time()
    reached_fraction = 0.0

    def report_and_check_limit(fraction: float, text: str) -> None:
        """Report the progress of the run; raise _TooSlowError after the limit of processor time.

        The fraction is stored, from which the time of the stop follows.
        """
        nonlocal reached_fraction
        reached_fraction = fraction
        if time.thread_time() - start_time > limit:
            raise _TooSlowError
        if progress:
            progress(fraction, text)

    options: dict[str, Any] = {"rtol": setting.value}
    if setting.has_fixed_step:
        options = {} if setting.method == "kinematic" else {"step": setting.value}
    try:
        run = simulation.simulate(
            output=times,
            method=setting.method,
            parameters=parameters,
            progress=report_and_check_limit,
            stop=False,
            peaks=(),
            **options,
        )
    except _TooSlowError:
        message, stop_time = (
            f"more than {limit:.3g} s of processor time",
            float(times[0] + reached_fraction * (times[-1] - times[0])),
        )
        return Attempt(setting, None, message, stop_time, slow=True, cpu=limit)
    except SolverError as error:
        outside_model = bool(getattr(error, "outside_model", False))
        first_line = str(error).partition("\n")[0]
        return Attempt(
            setting, error.partial, first_line, error.time, False, outside_model, time.thread_time() - start_time
        )
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt
    return Attempt(setting, run, cpu=time.thread_time() - start_time)


def list_round_numbers(low: float, high: float) -> tuple[float, ...]:
    """Return the numbers 1, 2, 5 · 10^k from low to high (both positive, included to rounding), ascending."""
    min_exponent, max_exponent = math.floor(math.log10(low)), math.ceil(math.log10(high))
    candidates = (float(f"{mantissa}e{k}") for k in range(min_exponent, max_exponent + 1) for mantissa in (1, 2, 5))
    return tuple(candidate for candidate in candidates if low * (1 - 1e-9) <= candidate <= high * (1 + 1e-9))


def find_default_step(simulation: Simulation, parameters: Parameters | None = None) -> float:
    """Return the fixed step (s) of a run with these parameters: the step of the scene in the file, or the default step.

    parameters: as in `simulate`; None: the values of the file.
    """
    p = compute_parameter_values(simulation.compiled, parameters)[0]
    return evaluate_scene_step(simulation.compiled, p, evaluate_scene_end_time(simulation.source, p))


def find_comparison_window(
    simulation: Simulation, max_window: float, setting: Setting, parameters: Parameters | None = None
) -> SceneWindow:
    """Return a time window over the first N_ONSETS contacts, or over `max_window` (s) with fewer contacts.

    It ends half-way between onset N_ONSETS and the next, rounded to two digits. Pilot runs with `setting`, each twice
    as long as the previous one, find these onsets; a failed pilot run ends the search. After many dry contacts any two
    runs differ, so errors are not meaningful there. `max_window` is limited to the end of the scene's run. parameters:
    None means the values of the file.
    """
    parameters = dict(parameters or {})
    max_window = min(max_window, evaluate_file_end_time(simulation.compiled, parameters))
    for power in range(N_PILOT_HALVINGS, -1, -1) if simulation.source.clearances else ():
        duration = max_window / 2**power
        pilot = attempt_run(simulation, np.linspace(0.0, duration, 3), setting, parameters)
        onsets = np.zeros(0) if pilot.run is None else np.sort(pilot.run.impacts["t_on"])
        if len(onsets) > N_ONSETS:
            end = float(onsets[N_ONSETS - 1] + onsets[N_ONSETS]) / 2
            return SceneWindow(simulation, float(f"{end:.2g}"), parameters, f"the first {N_ONSETS} contacts")
        if pilot.failure:
            break
    return SceneWindow(simulation, max_window, parameters, "no contact" if simulation.source.clearances else "")


def compare_runs(run: Result, reference: Result) -> Error:
    """Return the scaled maximum norms of the difference of two runs in motion, journal path and joint force.

    The sample interval of `run` is a whole multiple of that of `reference`. If both end at the same time, the peak
    forces over all steps are compared, too. All measures are NaN if a run has fewer than two samples; the path is NaN
    without play, the force NaN if `reference` has no force.
    """
    if len(run.t) < 2 or len(reference.t) < 2:
        return Error()
    motion, path, force = compute_differences(run, reference)
    peak_force = _find_peak_force(reference)
    largest_force = float(force.max()) if peak_force > 0 else NAN
    if abs(run.t[-1] - reference.t[-1]) < 0.5 * (run.t[1] - run.t[0]):  # the same window: compare peaks over all steps
        for peak, reference_peak in zip(run.diagnostics.peaks, reference.diagnostics.peaks, strict=True):
            largest_force = (
                max(largest_force, abs(peak.F - reference_peak.F) / peak_force) if peak_force > 0 else largest_force
            )
    return Error(float(motion.max()), float(path.max()) if run.source.clearances else NAN, largest_force)


def compute_differences(run: Result, reference: Result) -> tuple[Array, Array, Array]:
    """Return the differences in motion, path and force, scaled as in `Error`, at every common sample, (N,) each.

    - motion: of coordinates, lengths divided by the mechanism's size;
    - path: of eccentricity vectors, divided by the clearance; 0 without play;
    - force: of joint forces, divided by the peak force of `reference`; 0 if `reference` has no force.

    Each is the maximum over the coordinates or joints. The sample interval of `run` is a whole multiple of that of
    `reference`.
    """
    stride = round((run.t[1] - run.t[0]) / (reference.t[1] - reference.t[0]))
    count = min(len(run.t), (len(reference.t) - 1) // stride + 1)
    run_slice, reference_slice = slice(0, count), slice(0, (count - 1) * stride + 1, stride)
    source, peak_force = run.source, _find_peak_force(reference)
    scale = np.array(
        [1.0 if name.endswith(".theta") else find_mechanism_size(reference) for name in source.coordinates]
    )
    motion: Array = np.abs((run.q[run_slice] - reference.q[reference_slice]) / scale).max(axis=1)
    path, force = np.zeros(count), np.zeros(count)
    for joint in source.clearances or source.joints:
        force = np.maximum(
            force, _compute_vector_difference(run, reference, f"{joint.name}.F", run_slice, reference_slice)
        )
    for clearance in source.clearances:
        distance = _compute_vector_difference(run, reference, f"{clearance.name}.e", run_slice, reference_slice)
        path = np.maximum(path, distance / float(reference.p[clearance.clearance]))
    return motion, path, force / peak_force if peak_force > 0 else np.zeros(count)


def _compute_vector_difference(
    run: Result, reference: Result, name: str, run_samples: slice, reference_samples: slice
) -> Array:
    """Return the Euclidean norm of the difference of a joint's vector in two runs at every sample, (N,).

    name: of the series without the axis, such as "A.F" for A.Fx and A.Fy. run_samples, reference_samples: slices of
    the same length that select the compared samples of each run.
    """
    return np.hypot(
        *(run[f"{name}{axis}"][run_samples] - reference[f"{name}{axis}"][reference_samples] for axis in "xy")
    )


def _find_peak_force(run: Result) -> float:
    """Return the largest force (N) of a run over its samples and its peaks over all steps; 0 without joints.

    The samples are those of the joints with play or, in a scene without play, of all joints.
    """
    joints = run.source.clearances or run.source.joints
    sampled_peak = max((float(np.abs(run[f"{joint.name}.F"]).max()) for joint in joints), default=0.0)
    return max([sampled_peak, *(peak.F for peak in run.diagnostics.peaks)])


def find_mechanism_size(run: Result) -> float:
    """Return the characteristic length of the mechanism of a run (m), the scale of lengths and residuals.

    Raises GudgeonError for a result that was read from a file, which has no compiled scene.
    """
    if run.compiled is None:
        raise GudgeonError("a result that was read from a file cannot be compared: run the scene again")
    return compute_mechanism_size(run.compiled, run.p)

"""Compute the reference of deviations: series of another scene with the same parameters and sample times."""

from __future__ import annotations

import json
from collections import OrderedDict
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.start import assemble_start
from gudgeon.errors import GudgeonError, InputError
from gudgeon.integrators.kinematic import compute_motion_at
from gudgeon.integrators.threads import count_available_threads
from gudgeon.language.tree import from_json, iterate_names
from gudgeon.model.parameter_sets import compute_parameter_values_of_runs, read_given_parameters_of_runs
from gudgeon.results.batch import Array, find_evaluation_fields
from gudgeon.results.results import make_evaluated_samples
from gudgeon.results.series import get_catalogue
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble.libraries import get_method_for_scene, load_library
from gudgeon.studies.ensemble.measures import STEP_STATISTICS
from gudgeon.studies.ensemble.parameter_values import find_parameter_key, to_python_value

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.generator.study.spec import Measure
    from gudgeon.results.batch import Batch
    from gudgeon.studies.ensemble.block import Job, RunTable

MAX_CACHE_BYTES = 1 << 26  # maximum size of the cache of series, which later blocks of a process may need


def list_reference_scenes(measures: Iterable[Measure], excluded_scene: str = "") -> tuple[str, ...]:
    """Return the reference scenes of these measures, whose series they subtract (key `from`), without repetitions.

    excluded_scene: a scene that is left out, such as the measured scene itself.
    """
    return tuple(
        dict.fromkeys(
            str(measure.reference_scene)
            for measure in measures
            if measure.reference_scene is not None and measure.reference_scene != excluded_scene
        )
    )


def find_reference_scene_of_steps(measures: Sequence[Measure], source: KernelSource) -> str:
    """Return the scene that measures over all steps (`deviation_of_steps`) subtract in scene `source`; "" for none.

    A study has at most one such scene.
    """
    step_measures = (
        measure
        for measure in measures
        if measure.statistic in STEP_STATISTICS and measure.measured_name in get_catalogue(source)
    )
    return next(iter(list_reference_scenes(step_measures, source.scene)), "")


def load_reference_scene(job: Job, scene: str) -> Simulation:
    """Load the library of another scene with the mechanism and overrides of a job, and return its simulation."""
    return load_library(job.mechanism, scene, job.overrides, job.sha256)


def find_ineffective_parameters(source: KernelSource) -> Array:
    """Return a flag for each entry of the parameter vector p, (n_p,): whether it does not affect the motion or outputs.

    Such an entry is a named parameter that no expression of time, of the motion or of an output contains. Quantities
    that depend on it, such as lengths, are entries of p themselves, so their own flags are False.
    """
    trees = [json.loads(expression.tree) for expression in source.file_expressions] + list(source.outputs.values())
    used_addresses = {
        f"parameters.{name.path.removeprefix('parameters.')}"
        for tree in trees
        for name in iterate_names(from_json(tree))
    }
    is_unused = [
        parameter.address.startswith("parameters.") and parameter.address not in used_addresses
        for parameter in source.parameters
    ]
    return np.array(is_unused + [False] * len(source.derived), dtype=bool)


@dataclass(frozen=True, eq=False)
class RunInputs:
    """Inputs of runs of another scene, with keys by which equal runs are recognised (memoization)."""

    columns: Mapping[str, Array]  # parameters of the other scene, (n,)
    full_p: Array  # (n, n_p)
    p: Array  # full_p with 0 for parameters that do not affect the motion
    t: tuple[Array, ...]  # sample times of each run
    step: Array | None

    def build_key(self, i: int) -> tuple[bytes, bytes, float]:
        """Return the hashable key of run i: bytes of its parameters and sample times, and its step (0 without one)."""
        return self.p[i].tobytes(), self.t[i].tobytes(), 0.0 if self.step is None else float(self.step[i])


class SeriesCache:
    """Thread-safe LRU cache of the series of runs, limited to MAX_CACHE_BYTES."""

    def __init__(self) -> None:
        """Create an empty cache with its lock."""
        self._cached: OrderedDict[Any, Mapping[str, Array]] = OrderedDict()
        self._bytes, self._lock = 0, Lock()

    def get(self, key: Any) -> Mapping[str, Array] | None:
        """Return the series of a key and mark them as most recently used; None if they are not in the cache."""
        with self._lock:
            if key in self._cached:
                self._cached.move_to_end(key)
            return self._cached.get(key)

    def put(self, key: Any, series: Mapping[str, Array]) -> None:
        """Store the series of a key, and remove the least recently used ones beyond MAX_CACHE_BYTES bytes; an existing
        key is left as it is.
        """
        with self._lock:
            if key in self._cached:
                return
            self._cached[key] = series
            self._bytes += sum(array.nbytes for array in series.values())
            while self._bytes > MAX_CACHE_BYTES:
                self._bytes -= sum(array.nbytes for array in self._cached.popitem(last=False)[1].values())


_recent, _computing = SeriesCache(), Lock()


def compute_reference_series(
    job: Job, table: RunTable, runs: Array, batch: Batch, failures: list[str]
) -> dict[str, dict[str, Array]]:
    """Run the scenes that measures subtract, and return their series at the samples of a batch: {scene: {name: (n,
    N)}}.

    runs: indices of the batch's runs in the job. Values are NaN where the batch has no sample. A run that fails in the
    other scene, or has parameters that are invalid there, is entered in `failures`. Measures over all steps are left
    out, since the batch itself runs their scene.
    """
    series_by_scene: dict[str, dict[str, Array]] = {}
    sample_measures = [measure for measure in job.run_settings.measures if measure.statistic not in STEP_STATISTICS]
    for scene in list_reference_scenes(sample_measures, batch.source.scene):
        simulation = load_reference_scene(job, scene)
        common_names = get_catalogue(simulation.source).keys() & get_catalogue(batch.source).keys()
        names = dict.fromkeys(
            str(measure.measured_name)
            for measure in sample_measures
            if measure.reference_scene == scene and measure.measured_name in common_names
        )
        if names:
            series_by_scene[scene] = _compute_series_at_samples(
                job, simulation, table, runs, batch, list(names), failures
            )
    return series_by_scene


def _compute_series_at_samples(
    job: Job, simulation: Simulation, table: RunTable, runs: Array, batch: Batch, names: list[str], failures: list[str]
) -> dict[str, Array]:
    """Return the series `names` of a subtracted scene at the samples of these runs, (n, N) each, NaN where missing.

    runs: indices of the batch's runs in the job. Equal runs are computed once, and series are taken from a cache of the
    process if possible. Kinematically driven scenes are evaluated from the motion alone, others, and those that fail,
    are simulated. Failures are entered in `failures`; runs that failed before are left out.
    """
    times = batch.kept["t"]
    series_by_name = {name: np.full(times.shape, np.nan) for name in names}
    valid_runs = [i for i in range(len(runs)) if not failures[runs[i]] and np.isfinite(times[i]).sum() > 1]
    run_inputs = _build_run_inputs(simulation, table, runs, [row[np.isfinite(row)] for row in times])
    common_key = (
        job.mechanism,
        job.overrides,
        job.sha256,
        simulation.source.scene,
        job.run_settings.method,
        job.run_settings.rtol,
        tuple(names),
    )
    keys = [(common_key, run_inputs.build_key(i)) for i in range(len(runs))]
    with _computing:  # a block in another thread may need the same series
        cached = {keys[i]: _recent.get(keys[i]) for i in valid_runs}
        missing = [i for i in {keys[i]: i for i in reversed(valid_runs)}.values() if cached[keys[i]] is None]
        computed = _compute_kinematic_series(job, simulation, run_inputs, sorted(missing), names)
        for i, series in (
            computed | _simulate_reference_series(job, simulation, run_inputs, sorted({*missing} - {*computed}), names)
        ).items():
            if isinstance(series, str):
                for k in (k for k in valid_runs if keys[k] == keys[i]):
                    failures[runs[k]] = f"scene {simulation.source.scene}: {series}"
            else:
                cached[keys[i]] = series
                _recent.put(keys[i], series)
    for i in valid_runs:
        for name, values in (cached[keys[i]] or {}).items():
            series_by_name[name][i, np.isfinite(times[i])] = values
    return series_by_name


def _build_run_inputs(simulation: Simulation, table: RunTable, runs: Array, times: list[Array]) -> RunInputs:
    """Return the inputs of these runs of a job as runs of another scene (`simulation`); equal keys mean equal motions.

    runs: indices in the job. times: sample times, one array each. Parameters that the other scene lacks are left out,
    and those that do not affect the motion are 0 in the key. The step is None for a scene without degrees of freedom.
    """
    source = simulation.source
    columns = {key: values[runs] for name, values in table.columns.items() if (key := find_parameter_key(source, name))}
    rows = [{name: to_python_value(values[i]) for name, values in columns.items()} for i in range(len(runs))]
    given, is_given = read_given_parameters_of_runs(source, rows)
    p, _, _ = compute_parameter_values_of_runs(simulation.compiled, given, is_given, False)
    step = table.step[runs] if table.step is not None and source.degrees_of_freedom else None
    return RunInputs(columns, p, np.where(find_ineffective_parameters(source), 0.0, p), tuple(times), step)


def _compute_kinematic_series(
    job: Job, simulation: Simulation, run_inputs: RunInputs, runs: list[int], series_names: list[str]
) -> dict[int, Mapping[str, Array] | str]:
    """Return the series of kinematically driven runs by run, evaluated from the motion alone without a simulation.

    Runs that fail are left out, and are simulated for their reason. Empty for a scene with degrees of freedom. A
    simulation would spend two thirds of its time on the energy balance, which is not used.
    """
    source, compiled, field_names = (
        simulation.source,
        simulation.compiled,
        find_evaluation_fields(simulation.source, series_names),
    )
    if source.degrees_of_freedom or not runs:
        return {}

    def compute_series(i: int) -> Mapping[str, Array] | None:
        """Return the series of run i at its sample times; None if the motion cannot be computed or a value is not
        finite.

        The first sample time must be 0, else the result is None.
        """
        t, p = run_inputs.t[i], run_inputs.full_p[i]
        try:
            start = assemble_start(compiled, p)
            q, v = compute_motion_at(compiled, p, t, start.q, start.v)
            no_states = np.zeros((len(t), 0))
            run = make_evaluated_samples(
                source,
                compiled,
                p,
                t,
                q,
                v,
                np.full((len(t), 3), np.nan),
                no_states,
                no_states.astype(np.int8),
                field_names,
            )
            series_by_run = (
                {name: np.array(run[name]) for name in series_names} if np.isfinite(q).all() and t[0] == 0.0 else {}
            )
        except GudgeonError:  # the simulation of the run reports the reason
            return None
        return (
            series_by_run
            if series_by_run and all(np.isfinite(values).all() for values in series_by_run.values())
            else None
        )

    with ThreadPoolExecutor(job.threads or count_available_threads(), thread_name_prefix="gudgeon") as pool:
        series_by_run = dict(zip(runs, pool.map(compute_series, runs), strict=True))
    return {i: series for i, series in series_by_run.items() if series is not None}


def _simulate_reference_series(
    job: Job, simulation: Simulation, run_inputs: RunInputs, runs: list[int], names: list[str]
) -> dict[int, Mapping[str, Array] | str]:
    """Simulate runs of a subtracted scene as one batch; return by run its series, or the reason (a text) of a failure.

    run_inputs: parameters and sample times of all runs. runs: indices of those that are simulated.
    If the parameters of a run are invalid, each run is simulated alone to find it. Raises KeyboardInterrupt if Ctrl-C
    ended a run.
    """
    if not runs:
        return {}
    source, is_dynamic = simulation.source, bool(simulation.source.degrees_of_freedom)
    t = [run_inputs.t[i] for i in runs]
    has_common_times = all(np.array_equal(times, t[0]) for times in t)
    try:
        batch = simulation.simulate_many(
            {name: [to_python_value(values[i]) for i in runs] for name, values in run_inputs.columns.items()}
            or [{}] * len(runs),
            output=t[0] if has_common_times else t,
            method=get_method_for_scene(source, job.run_settings.method),
            rtol=job.run_settings.rtol if is_dynamic else None,
            step=None if run_inputs.step is None else run_inputs.step[runs],
            threads=job.threads,
            stop=False,
            keep=names,
            peaks=[],
        )
    except InputError as error:
        if len(runs) == 1:
            return {runs[0]: str(error)}
        series_by_single_run = [_simulate_reference_series(job, simulation, run_inputs, [i], names) for i in runs]
        return {i: series for series_by_run in series_by_single_run for i, series in series_by_run.items()}
    if batch.interrupted:
        raise KeyboardInterrupt
    failed = {failure.run: str(failure.error) for failure in batch.failures}
    return {
        i: failed[k] if k in failed else {name: batch.kept[name][k, : len(t[k])].copy() for name in names}
        for k, i in enumerate(runs)
    }

"""Define `Batch`, the results of many runs of one scene: arrays over the runs, and a Result of each run on request.

A series of a batch is read from the stored series. If states are stored instead, it is evaluated from them in C and in
threads.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, Protocol, TypeAlias, overload

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError
from gudgeon.integrators.threads import count_available_threads
from gudgeon.language import tree
from gudgeon.language.argument_checks import check_names, is_integer, raise_bad_value, shorten_value
from gudgeon.language.text_output import format_count
from gudgeon.model.choices import format_values_of_runs
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.peaks import BatchPeaks, find_batch_extremes
from gudgeon.results.results import Result, make_empty_result
from gudgeon.results.series import get_catalogue
from gudgeon.results.state import Array

if TYPE_CHECKING:
    import pandas
    import xarray

    from gudgeon.results.samples import AtEvents
    from gudgeon.results.wear import SlidingLoads

STATES = "states"
RUNS_PER_BLOCK = 8  # runs that one thread evaluates at once
BLOCKS_IN_ADVANCE = 4  # blocks per thread that are evaluated before the caller reads them
RunSeries: TypeAlias = tuple[int, Array, dict[str, Array]]


@dataclass(frozen=True, eq=False)
class Failure:
    """The error of a run that did not reach its end.

    Two failures are equal if number and text are equal, so that a loaded batch equals the saved one.
    """

    run: int
    error: GudgeonError

    def __eq__(self, other: object) -> bool:
        """Return whether another failure has the same run number and the same text of the error."""
        return isinstance(other, Failure) and (self.run, str(self.error)) == (other.run, str(other.error))

    def __hash__(self) -> int:
        """Return the hash of the run number and the text of the error."""
        return hash((self.run, str(self.error)))

    def __str__(self) -> str:
        """Return "run 3: " and the text of the error."""
        return f"run {self.run}: {self.error}"


class ResultOf(Protocol):
    """Source of the results of a batch's runs: the simulation that made the batch, or a file."""

    def __call__(self, i: int, /) -> Result:
        """Return the full Result of run i. Raises the error of a failed run, with the partial result as `partial`."""

    def notes(self) -> Mapping[int, tuple[str, ...]]:
        """Return the notes of the runs by run number."""

    def build_run_samples(self, i: int, field_names: frozenset[str], /) -> Result | None:
        """Return the samples of run i as a Result without diagnostics, or None for a run without samples.

        Only the fields `field_names` of an Evaluation can be computed from it.
        """


@dataclass(frozen=True, eq=False)
class States:
    """Samples of n runs at N times each, SI; NaN (codes: 0) where a run has none."""

    q: Array  # (n, N, n_q)
    v: Array
    work: Array  # (n, N, 3) J: drives, applied forces, joints with play
    state: Array  # (n, N, n_clearances) int8: 0 free, 1 impact, 2 contact


@dataclass(eq=False, repr=False)
class Batch:
    """Results of n runs with at most N samples each, in SI; NaN at samples that a run did not reach.

    `batch[i]` is the full Result of run i, made anew at each request and equal to that of the run alone. For a failed
    run it raises the error, whose `partial` is the result up to the failure. `batch["S9.y"]` is that series of all
    runs, (n, N), evaluated in threads. A batch can be pickled, as a Result can.

    `t` are the requested output times: (N,) if all runs have the same. Runs that end at different times or have output
    times of their own have `t` (n, N), NaN after a run's last sample. `times` is always (n, N). `batch["t"]` holds the
    times at which samples were taken: for a run that an event or Ctrl-C ended, the last is its end.

    `q`, `v` (n, N, n_q), `work` (n, N, 3; J) and `state` (n, N, n_clearances) are the states at the samples. A batch
    that stores only some series has no states and no `batch[i]`: a request for them raises GudgeonError.
    """

    source: KernelSource
    t: Array  # (N,) s, or (n, N)
    states: States | None  # None: only some series were stored
    samples: Array  # (n,) number of samples; the last is the end of a run that an event or Ctrl-C ended
    t_last: Array  # (n,) s, where each run ended
    parameters: Mapping[str, Array]  # address -> (n,) values, or names, of parameters that any run was given
    impacts: tuple[Array, ...]  # IMPACT_DTYPE of each run, a record for each onset
    events: tuple[Array, ...]  # EVENT_DTYPE of each run
    peaks: Array  # (n, n_clearances) PEAK_DTYPE: N, s, m; the first contact and its peak force, NaN: no contact
    diagnostics: Mapping[str, Array]  # (n,) each: counts and maxima, named and meant as in Diagnostics
    failures: tuple[Failure, ...]
    seconds: float  # wall time of all runs
    threads: int
    interrupted: bool
    result: ResultOf = field(repr=False)
    kept: Mapping[str, Array] = field(default_factory=dict)  # series (n, N) instead of states, and "t"
    extremes: tuple[tuple[Extremes, ...], ...] = ()  # of each run, over all steps, of the series in `peaks`
    sliding_loads: tuple[
        tuple[SlidingLoads, ...], ...
    ] = ()  # loads of the surfaces for wear, where a study needs them; not saved

    def __len__(self) -> int:
        """Return the number of runs."""
        return len(self.samples)

    def __repr__(self) -> str:
        """Return mechanism, scene, and the numbers of runs, samples and failures in one line."""
        failed = f", {len(self.failures)} failed" if self.failures else ""
        samples = f"{format_count(len(self), 'run')} of {format_count(self.t.shape[-1], 'sample')}"
        stored_text = (
            "" if self.states else f", {', '.join(name for name in self.kept if name != 't') or 'no series stored'}"
        )
        return f"<Batch {self.source.mechanism}/{self.source.scene}: {samples}{failed}{stored_text}>"

    @property
    def times(self) -> Array:
        """The requested output times, (n, N), s, read-only."""
        return np.broadcast_to(self.t, (len(self), self.t.shape[-1]))

    @property
    def q(self) -> Array:
        """Coordinates, (n, N, n_q)."""
        return self._states.q

    @property
    def v(self) -> Array:
        """Velocities q̇ of the coordinates, (n, N, n_q)."""
        return self._states.v

    @property
    def work(self) -> Array:
        """Works of drives, applied forces and clearance forces, (n, N, 3), J."""
        return self._states.work

    @property
    def state(self) -> Array:
        """Contact codes, (n, N, n_clearances): 0 free, 1 impact, 2 contact."""
        return self._states.state

    @property
    def _states(self) -> States:
        """Return the states of all runs, from which `q`, `v`, `work` and `state` are read.

        Raises GudgeonError if only series were stored.
        """
        if self.states is None:
            raise GudgeonError(f"the states of these runs were not stored: {describe_stored_series(self)}")
        return self.states

    @overload
    def __getitem__(self, key: str) -> Array: ...
    @overload
    def __getitem__(self, key: int) -> Result: ...
    def __getitem__(self, key: int | str) -> Result | Array:
        """Return a series of all runs, (n, N), read-only, for a name, or the full Result of a run for its number."""
        if isinstance(key, str):
            values = collect_series(self, [key])[key][:]
            values.flags.writeable = False
            return values
        if not is_integer(key):
            raise_bad_value("a run of a batch", key, "its number, or the name of a series")
        if not -len(self) <= key < len(self):
            raise IndexError(f"run {shorten_value(key)}: there are {len(self)}")
        _ = self._states
        return self.result(int(key) % len(self))

    @property
    def onsets(self) -> Array:
        """Return the number of contacts that began at each joint with play, (n, n_clearances)."""
        joints = range(len(self.source.clearances))
        counts = [[int((impacts["joint"] == k).sum()) for k in joints] for impacts in self.impacts]
        return np.array(counts, dtype=np.int_).reshape(len(self), len(joints))

    def partial(self, i: int) -> Result | None:
        """Return the result of run i up to its end or its failure; None for a run that did not begin.

        Raises BadValueError unless i is a whole number, IndexError beyond the runs, GudgeonError for a batch without
        states.
        """
        _ = self._states
        if not is_integer(i):
            raise_bad_value("a run of a batch", i, "its number")
        try:
            return self[i]
        except GudgeonError as error:
            partial_result = getattr(error, "partial", None)
            return partial_result if isinstance(partial_result, Result) else None

    def at_events(self, name: str) -> tuple[AtEvents | None, ...]:
        """Return for each run the states at the times of an event; None for a run that did not begin.

        A run that failed gives its states up to the failure, as `partial` returns them. `name` is an event of the
        file; see Result.at_events. Raises GudgeonError for a batch without states.
        """
        runs = map(self.partial, range(len(self)))
        return tuple(None if run is None else run.at_events(name) for run in runs)

    def peak(self, name: str) -> BatchPeaks:
        """Return the largest and smallest value of a series over all steps, (n,) each: see Result.peak."""
        return find_batch_extremes(self.source, self.extremes, name, False, lambda: self._read_samples(name))

    def peak_error(self, name: str) -> BatchPeaks:
        """Return the extremes of the difference between a series and that of another scene, (n,) each: see
        Result.peak_error.
        """
        return find_batch_extremes(self.source, self.extremes, name, True, lambda: self._read_samples(name))

    def _read_samples(self, name: str) -> tuple[Array, Array]:
        """Return sample times and values of a series, (n, N) each, or arrays (n, 0) if the series is not available.

        Called by `peak` and `peak_error`, whose extremes the samples may exceed.
        """
        try:
            return np.broadcast_to(self["t"], (len(self), self.t.shape[-1])), self[name]
        except GudgeonError:
            return np.zeros((len(self), 0)), np.zeros((len(self), 0))

    def to_xarray(self, names: Iterable[str] | str = (), part: str = "series") -> xarray.Dataset:
        """Return an xarray Dataset over `run` and `time` with every series by its name in a Result, and the series of
        `names`.

        If the output times of runs differ, the variable `t` over `run` and `time` contains them, and `time` is a
        counter. Variables over `run` alone are the number of samples, the end, failures, diagnostics, parameters, peaks
        ("A.peak.F") and extremes over all steps ("S9.ay.peak.max", "S9.ay.error.max"). `.to_dataframe()` has a row for
        each run and time. `part`: "impacts", "events" or another table of a Result, with a row for each record and the
        number of its `run`. A text as the only argument is a part, as in Result.to_xarray.
        """
        from gudgeon.results.files import netcdf_batch

        return netcdf_batch.build_batch_dataset(self, names, part)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write everything to one NetCDF file: every series of every run, or those that were stored.

        Raises OutputError if that fails.
        """
        from gudgeon.results.files import netcdf_batch

        netcdf_batch.save(self, path)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Batch:
        """Return the batch that `save` wrote, bit for bit, without a compiled library. Raises InputError for any other
        file.
        """
        from gudgeon.results.files import netcdf_batch

        return netcdf_batch.load(path)

    def to_dataframe(self, names: Iterable[str] | None = None) -> pandas.DataFrame:
        """Return a long pandas table with a row for each reached sample: run, given parameters, t, and the series
        `names`, or all for None.

        SI, units in `attrs["units"]`.
        """
        from gudgeon.results.files import export

        return export.build_batch_dataframe(self, names)

    def to_csv(self, path: str | os.PathLike[str], names: Iterable[str] | None = None) -> None:
        """Write the table of `to_dataframe` as CSV, run by run, with all digits of each number.

        `names` None: all series.
        """
        from gudgeon.results.files import export

        export.write_batch_csv(self, path, names)

    def to_mat(self, path: str | os.PathLike[str], names: Iterable[str] | None = None) -> None:
        """Write a MATLAB file: `t` and the series `names`, or all, n × N each, and given parameters n × 1; see
        Result.to_mat.
        """
        from gudgeon.results.files import export

        export.write_batch_mat(self, path, names)


def collect_given_values(source: KernelSource, p: Array, is_given: NDArray[np.bool_]) -> dict[str, Array]:
    """Return the values (n,) of the parameters that any run was given, by address; choices as names.

    `p` (n, n_parameters + n_derived): parameters of all runs; `is_given` (n, n_parameters): mask of those given.
    """
    given_parameters = [(source.parameters[k], p[:, k]) for k in np.flatnonzero(is_given.any(axis=0)).tolist()]
    return {parameter.address: format_values_of_runs(parameter, values) for parameter, values in given_parameters}


def make_failures(errors: Mapping[int, GudgeonError]) -> tuple[Failure, ...]:
    """Return the Failures of a batch, sorted by run number, from errors by run number."""
    return tuple(Failure(i, errors[i]) for i in sorted(errors))


def check_series_names(source: KernelSource, names: str | Iterable[str], argument_name: str = "names") -> list[str]:
    """Return the names of series as a list, in their order.

    `names` is one name or several, "t" among them; `argument_name` names the argument in errors. Raises
    UnknownNameError with the nearest name, BadValueError for a name that is given twice.
    """
    checked, empty_result = check_names(names, argument_name, "a list of names of series"), make_empty_result(source)
    for name in checked:
        empty_result.unit(name)
    return checked


def find_evaluation_fields(source: KernelSource, names: Iterable[str]) -> frozenset[str]:
    """Return the fields of an Evaluation that the series `names` need; "t" needs none."""
    all_series = get_catalogue(source)
    return frozenset(field for name in names if name != "t" for field in all_series[name].evaluation_fields)


def depends_on_works(source: KernelSource, name: str) -> bool:
    """Return whether a series of a scene is computed from the works of drives, forces or joints with play.

    An output depends on works if a series in its expression does.
    """
    series_entry = get_catalogue(source)[name]
    if name in source.outputs:
        used_names = tree.iterate_names(tree.from_json(source.outputs[name]))
        return any(
            depends_on_works(source, used_name.path)
            for used_name in used_names
            if used_name.path in get_catalogue(source)
        )
    return name == "energy.residual" or (series_entry.stored is not None and series_entry.stored[0] == "work")


def check_series_stored(batch: Batch, names: Iterable[str]) -> None:
    """Raise GudgeonError for the first of `names` that a batch without states did not store.

    A batch with states can evaluate every series, so that nothing is raised.
    """
    if batch.states is None and (missing_names := [name for name in names if name not in batch.kept]):
        raise GudgeonError(f"{missing_names[0]!r} was not stored in this batch: {describe_stored_series(batch)}")


def describe_stored_series(batch: Batch) -> str:
    """Return a text for errors of a batch without states: the stored series, and how to store others."""
    names = [name for name in batch.kept if name != "t"]
    hint = 'simulate_many(…, keep=[…]) stores the named series; keep="states" stores all'
    return f"it has {', '.join(names) or 'no series'}\n  {hint}"


def name_series_column(name: str) -> str:
    """Return the column name of a series in tables of a batch: the name itself, but "output.run" for "run".

    The column `run` is the number of the run.
    """
    return f"output.{name}" if name == "run" else name


def collect_given_columns(batch: Batch) -> dict[str, Array]:
    """Return the values (n,) of the parameters that runs were given, by column of a table.

    The column is the address, or "given.ADDRESS" if a series has the same name.
    """
    all_series = get_catalogue(batch.source)
    return {f"given.{name}" if name in all_series else name: values for name, values in batch.parameters.items()}


def collect_series(batch: Batch, names: Sequence[str]) -> dict[str, Array]:
    """Return the named series of all runs, (n, N) each, by name; NaN where a run has no sample.

    Series that the batch stores are returned without a copy, columns of states are copied, and other series are
    evaluated in threads. Called by `Batch[name]` and for the export to NetCDF and MAT files. Raises UnknownNameError,
    GudgeonError for a series that was not stored, SingularError.
    """
    names = check_series_names(batch.source, names)
    check_series_stored(batch, names)
    values_by_series = {
        name: stored_values for name in names if (stored_values := _find_stored_series(batch, name)) is not None
    }
    evaluated_names = [name for name in names if name not in values_by_series]
    values_by_series |= {name: np.full((len(batch), batch.t.shape[-1]), np.nan) for name in evaluated_names}
    for i, sample_times, values_by_name in iterate_run_series(batch, evaluated_names) if evaluated_names else ():
        for name, values in values_by_name.items():
            values_by_series[name][i, : len(sample_times)] = values
    return {name: values_by_series[name] for name in names}


def _find_stored_series(batch: Batch, name: str) -> Array | None:
    """Return a stored series (n, N), or a copy of a column of the stored q, v, work or state.

    Stored series are those that `simulate_many` kept (batch.kept). Contact states are NaN after the last sample of a
    run. Returns None for any other series, and for "t" in a batch with states.
    """
    if name in batch.kept:
        return batch.kept[name]
    array_and_column = None if name == "t" else get_catalogue(batch.source)[name].stored
    if array_and_column is None or array_and_column[0] not in ("q", "v", "work", "state"):
        return None
    array, column = array_and_column
    values = np.array(getattr(batch, array)[:, :, column], dtype=float)
    if array == "state":
        values[np.arange(values.shape[1]) >= batch.samples[:, None]] = np.nan
    return values


def iterate_run_series(batch: Batch, names: Sequence[str]) -> Iterator[RunSeries]:
    """Yield (run number, sample times, {name: values}) for each run that has samples, in order of the runs.

    Series are evaluated by threads, a few blocks of runs in advance. Raises GudgeonError for a series that was not
    stored.
    """
    check_series_stored(batch, names)
    get_run_series = _read_stored_run_series if batch.states is None else _evaluate_run_series
    evaluation_fields = find_evaluation_fields(batch.source, names)

    def make_block(first_run: int) -> list[RunSeries]:
        """Return the series of RUNS_PER_BLOCK runs from `first_run` on; runs without samples are left out."""
        rows = (
            get_run_series(batch, i, names, evaluation_fields)
            for i in range(first_run, min(first_run + RUNS_PER_BLOCK, len(batch)))
        )
        return [row for row in rows if row is not None]

    yield from _evaluate_blocks_in_order(
        make_block, range(0, len(batch), RUNS_PER_BLOCK), min(batch.threads, count_available_threads())
    )


def _evaluate_blocks_in_order(
    evaluate_block: Callable[[int], list[RunSeries]], first_runs: range, n_threads: int
) -> Iterator[RunSeries]:
    """Yield the rows of all blocks of runs in their order, evaluated in `n_threads` threads.

    `evaluate_block` returns the rows of the block that begins at a run. At most BLOCKS_IN_ADVANCE blocks a thread are
    evaluated in advance; those not begun are cancelled if the caller stops.
    """
    futures: deque[Future[list[RunSeries]]] = deque()
    remaining_runs = iter(first_runs)
    with ThreadPoolExecutor(max(1, min(n_threads, len(first_runs))), thread_name_prefix="gudgeon") as executor:
        try:
            while True:
                next_runs = islice(remaining_runs, BLOCKS_IN_ADVANCE * max(1, n_threads) - len(futures))
                futures.extend(executor.submit(evaluate_block, first_run) for first_run in next_runs)
                if not futures:
                    return
                yield from futures.popleft().result()
        finally:
            executor.shutdown(cancel_futures=True)


def _evaluate_run_series(
    batch: Batch, i: int, names: Sequence[str], evaluation_fields: frozenset[str]
) -> RunSeries | None:
    """Return run number, sample times and {name: values} of run i, evaluated from its states; None if it has no
    samples.
    """
    run: Result | None = batch.result.build_run_samples(i, evaluation_fields)
    return None if run is None else (i, run.t, {name: run[name] for name in names})


def _read_stored_run_series(batch: Batch, i: int, names: Sequence[str], _: frozenset[str]) -> RunSeries | None:
    """Return run number, sample times and {name: values} of run i from the stored series; None if it has no samples.

    The last argument is not used; it makes the signature that of `_evaluate_run_series`.
    """
    n_samples = int(batch.samples[i])
    return (
        (i, batch.kept["t"][i, :n_samples], {name: batch.kept[name][i, :n_samples] for name in names})
        if n_samples
        else None
    )

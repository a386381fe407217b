"""Write a batch of runs as one NetCDF 4 file, and read it bit for bit; each table row has its run's number.

The group `runs` has a row for each run; `series`, `impacts` and others are long tables; `given` has the parameters.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon import errors
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError, UnknownNameError
from gudgeon.integrators.trajectory import STORED_COUNTS
from gudgeon.language.argument_checks import check_text
from gudgeon.results.batch import (
    Batch,
    States,
    check_series_names,
    collect_given_columns,
    collect_series,
    make_failures,
    name_series_column,
)
from gudgeon.results.diagnostics import Extremes, convert_extremes_from_json, convert_extremes_to_json
from gudgeon.results.files import netcdf
from gudgeon.results.files.hdf5 import Table, Variable
from gudgeon.results.files.untrusted import File, check_type, open_result_file
from gudgeon.results.peaks import PEAK_DTYPE, build_extreme_columns
from gudgeon.results.results import Array, Result, make_empty_result
from gudgeon.results.series import MOTION_UNITS, find_rate_names, get_catalogue

if TYPE_CHECKING:
    import xarray

FORMATS = ("gudgeon-batch/2", "gudgeon-batch/1")  # the written format; the former one, with common times of all runs
RUNS, GIVEN, EXTREMES, NUMBER = "runs", "given", "extremes", "number"
TIMES, STORED, RUN_COLUMN = "times", "kept", "run"
COUNTS = (*STORED_COUNTS, "seconds")


def save(batch: Batch, path: str | os.PathLike[str]) -> None:
    """Write a batch to a file. See Batch.save."""
    netcdf.write_tables(build_batch_tables(batch), path)


def build_batch_tables(batch: Batch) -> Iterator[Table]:
    """Yield all tables of the file of a batch: runs, given parameters, times, and the long tables of all runs. A batch
    without states has the table `kept` of its stored series instead of all series.
    """
    runs_with_states = range(len(batch) if batch.states else 0)
    runs = {i: run for i in runs_with_states if (run := batch.partial(i)) is not None}
    tables_by_run = [(i, table) for i, run in runs.items() for table in netcdf.build_tables(run)]
    batch_values = {"seconds": repr(batch.seconds), "threads": batch.threads, "interrupted": batch.interrupted}
    batch_values |= {"own_times": batch.t.ndim == 2} | ({} if batch.states else {"kept": [*batch.kept]})
    attributes = {
        "gudgeon": FORMATS[0],
        "title": batch.source.title,
        "mechanism": batch.source.mechanism,
        "scene": batch.source.scene,
        "batch": json.dumps(batch_values),
    }
    yield Table("", "run", (Variable("run", np.arange(len(batch)), "", "number of the run"),), attributes)
    yield build_times_table(batch)
    if not batch.states:
        tables_by_run += build_stored_series_tables(batch)
        yield build_long_table(STORED, [(i, table) for i, table in tables_by_run if table.group == STORED], {})
    yield Table(RUNS, NUMBER, tuple(_iterate_run_variables(batch, runs)), {})
    units = {parameter.address: parameter.unit for parameter in batch.source.parameters}
    given_variables = (
        Variable(name, values, units.get(name, ""), "given") for name, values in batch.parameters.items()
    )
    yield Table(GIVEN, NUMBER, tuple(given_variables), {})
    for group in ("", *netcdf.PARTS, netcdf.START, netcdf.GIVEN_START, netcdf.COMPILED):
        filled_tables = [(i, table) for i, table in tables_by_run if table.group == group and table.length]
        source = {"source": batch.source.to_json()} if group == netcdf.COMPILED else {}
        yield build_long_table(group or netcdf.SERIES, filled_tables, source)
    yield Table(netcdf.PROVENANCE_GROUP, "", (), next((run.provenance for run in runs.values()), {}))


def build_long_table(group: str, tables_by_run: list[tuple[int, Table]], attributes: dict[str, str]) -> Table:
    """Return the concatenated tables of several runs, whose first column is the number of the run.

    `tables_by_run` has (run, table) of each run with rows; without any, the result has no variables.
    """
    run_numbers = [np.full(table.length, i, np.int32) for i, table in tables_by_run]
    variables = [Variable(RUN_COLUMN, np.concatenate(run_numbers), "", "number of the run")] if tables_by_run else []
    for k, first in enumerate(tables_by_run[0][1].variables if tables_by_run else ()):
        values = np.concatenate([table.variables[k].values for _, table in tables_by_run])
        variables.append(Variable(name_column(first.name), values, first.unit, first.meaning))
    return Table(group, "row", tuple(variables), attributes)


def name_column(name: str) -> str:
    """Return the column name of a series in a long table: the name itself, or "output.NAME" for "run" and "row"."""
    return f"output.{name}" if name in (RUN_COLUMN, "row") else name


def _format_stored_name(name: str) -> str:
    """Return the name of a series in the table `kept`."""
    return "time" if name == "t" else netcdf.name_variable(name)


def build_times_table(batch: Batch) -> Table:
    """Return the table of requested times: (N,) if all runs have the same; else a long table with those of each run."""
    meaning = "requested output time"
    if batch.t.ndim == 1:
        return Table(TIMES, "time", (Variable("time", batch.t, "s", meaning),), {})
    variables = (
        (i, Variable("time", run_times[~np.isnan(run_times)], "s", meaning)) for i, run_times in enumerate(batch.t)
    )
    return build_long_table(TIMES, [(i, Table(TIMES, "row", (variable,), {})) for i, variable in variables], {})


def build_stored_series_tables(batch: Batch) -> Iterator[tuple[int, Table]]:
    """Yield (run, table) for the stored series, impacts and events of a batch without states; no empty tables."""
    source, empty_result = batch.source, make_empty_result(batch.source)
    joints, events = [joint.name for joint in source.clearances], [event.name for event in source.events]
    for i, n_samples in enumerate(batch.samples.tolist()):
        stored_columns = ((name, values[i, :n_samples]) for name, values in batch.kept.items())
        variables = (
            Variable(_format_stored_name(column), x, empty_result.unit(column), empty_result.meaning(column))
            for column, x in stored_columns
        )
        run_tables = (
            Table(STORED, "row", tuple(variables), {}),
            Table(
                "impacts", "impact", tuple(netcdf.build_record_variables(batch.impacts[i], netcdf.IMPACTS, joints)), {}
            ),
            Table(
                "events", "occurrence", tuple(netcdf.build_record_variables(batch.events[i], netcdf.EVENTS, events)), {}
            ),
        )
        yield from ((i, table) for table in run_tables if table.length)


def build_batch_dataset(batch: Batch, names: Iterable[str] | str = (), part: str = netcdf.SERIES) -> xarray.Dataset:
    """Return a batch as an xarray Dataset over run and time, or the table `part` over rows; see Batch.to_xarray.

    A text as `names` is the name of a part. Raises UnknownNameError.
    """
    names, part = ((), names) if isinstance(names, str) else (names, part)
    xarray = netcdf.import_xarray()
    if check_text(part, "part", "the name of a table") != netcdf.SERIES:
        variables = {
            variable.name: ("row", variable.values, variable.attributes)
            for variable in _build_table_of_runs(batch, part).variables
        }
        return xarray.Dataset(variables)
    failure_texts = dict((failure.run, str(failure.error)) for failure in batch.failures)
    columns: dict[str, Any] = {
        "samples": ("run", batch.samples),
        "t_last": ("run", batch.t_last, {"units": "s"}),
        "failure": ("run", np.array([failure_texts.get(i, "") for i in range(len(batch))])),
    }
    columns |= {name: ("run", values) for name, values in batch.diagnostics.items()}
    for k, joint in enumerate(batch.source.clearances):
        columns |= {f"{joint.name}.peak.{name}": ("run", batch.peaks[name][:, k]) for name in PEAK_DTYPE.names or ()}
    columns |= {name: ("run", values, {"units": unit}) for name, unit, values in build_extreme_columns(batch.extremes)}
    columns |= _collect_sample_variables(batch, names)
    coordinates: dict[str, Any] = {"time": ("time", batch.t, {"units": "s"})} if batch.t.ndim == 1 else {}
    coordinates |= {name: ("run", values) for name, values in collect_given_columns(batch).items()}
    attributes = {"mechanism": batch.source.mechanism, "scene": batch.source.scene, "title": batch.source.title}
    return xarray.Dataset(columns, coordinates, attributes)


def _collect_sample_variables(batch: Batch, names: Iterable[str]) -> dict[str, Any]:
    """Return xarray variables (dimensions, values) or (dimensions, values, attributes) by name, of values (n, N).

    They are coordinates, velocities and works of a batch with states, the stored series, and the series `names`.
    """
    dimensions, variables, source = ("run", "time"), dict[str, Any](), batch.source
    if batch.t.ndim == 2:
        variables["t"] = dimensions, batch.t, {"units": "s"}
    for k, name in enumerate(batch.source.coordinates if batch.states else ()):
        for order, (column, values) in enumerate(((name, batch.q), (find_rate_names(name)[0], batch.v))):
            variables[column] = dimensions, values[:, :, k], {"units": MOTION_UNITS[k % 3][order]}
    for k, name in enumerate(() if source.massless_bodies or not batch.states else ("drives", "forces", "clearances")):
        variables[f"work.{name}"] = dimensions, batch.work[:, :, k], {"units": "J"}
    names = [*dict.fromkeys([*(name for name in batch.kept if name != "t"), *check_series_names(batch.source, names)])]
    return variables | {
        name_series_column(name): (dimensions, values) for name, values in collect_series(batch, names).items()
    }


def _build_table_of_runs(batch: Batch, group: str) -> Table:
    """Return a table of netcdf.PARTS of all runs that began, with a column of run numbers. Raises UnknownNameError."""
    if group not in netcdf.PARTS:
        raise UnknownNameError(f"a batch has no part {group!r}", hint=f"there are: series, {', '.join(netcdf.PARTS)}")
    if batch.states is None and group in ("impacts", "events"):
        filled_tables = [(i, table) for i, table in build_stored_series_tables(batch) if table.group == group]
    else:
        begun_runs = [(i, run) for i in range(len(batch)) if (run := batch.partial(i)) is not None]
        filled_tables = [
            (i, table)
            for i, run in begun_runs
            for table in netcdf.build_tables(run)
            if table.group == group and table.length
        ]
    return build_long_table(group, filled_tables, {})


def _iterate_run_variables(batch: Batch, runs: Mapping[int, Result]) -> Iterator[Variable]:
    """Yield the columns of the table `runs`, one row a run. `runs` are the results of the runs that began."""
    errors_by_run = {failure.run: failure.error for failure in batch.failures}
    if batch.states:
        texts = [runs[i].diagnostics.to_json() if i in runs else "" for i in range(len(batch))]
        yield Variable("diagnostics", np.array(texts, dtype=object), "", "diagnostics of the run, JSON")
    elif batch.extremes:
        texts = [convert_extremes_to_json(run_extremes) for run_extremes in batch.extremes]
        yield Variable(EXTREMES, np.array(texts, dtype=object), "", "peaks over all steps, JSON")
    texts = [_convert_error_to_json(errors_by_run[i]) if i in errors_by_run else "" for i in range(len(batch))]
    yield Variable("failure", np.array(texts, dtype=object), "", "error of a failed run, JSON")
    yield Variable("samples", batch.samples.astype(np.int64), "", "number of samples")
    yield Variable("t_last", batch.t_last, "s", "time at which the run ended")
    for name in COUNTS:
        yield Variable(name, batch.diagnostics[name], "", "see Diagnostics")
    for k, joint in enumerate(batch.source.clearances):
        for name in PEAK_DTYPE.names or ():
            yield Variable(f"{joint.name}.peak.{name}", np.ascontiguousarray(batch.peaks[name][:, k]), "", "peak")


def _convert_error_to_json(error: GudgeonError) -> str:
    """Return an error as JSON: class, text, time (NaN if it has none), `pivot` ("") and `outside_model` (False)."""
    time = repr(float(getattr(error, "time", math.nan)))
    other_fields = {"pivot": getattr(error, "pivot", ""), "outside_model": bool(getattr(error, "outside_model", False))}
    return json.dumps(
        {"kind": type(error).__name__, "text": str(error), "time": time, **other_fields}, ensure_ascii=False
    )


def _parse_error_json(text: str, partial_result: Result | None) -> GudgeonError:
    """Return the error in the JSON of `_convert_error_to_json`; raise ValueError for an unknown class of errors."""
    data = json.loads(text)
    cls = getattr(errors, str(data["kind"]), None)
    if not (isinstance(cls, type) and issubclass(cls, GudgeonError)):
        raise ValueError(f"unknown class of an error: {data['kind']!r}")
    error = cls.__new__(cls, str(data["text"]))
    error.__dict__ |= {"time": float(data["time"]), "pivot": str(data["pivot"]), "partial": partial_result}
    error.__dict__ |= {"outside_model": bool(data["outside_model"]), "message": str(data["text"]), "where": None}
    return error


def load(path: str | os.PathLike[str]) -> Batch:
    """Return the batch in a file. See Batch.load."""
    return open_result_file(path, _read_batch)


class _RunRows(File):
    """Adapter that reads the rows of one run in the long tables through the interface of a single run's file."""

    def __init__(self, long_tables: LongTables, run: int) -> None:
        """Store the file of the batch and the number of the run."""
        self.long_tables, self.run, self.is_old = long_tables, run, False

    def has_entry(self, group: str) -> bool:
        """Return whether the run has rows in a group, or the file has a series of that name."""
        tables = self.long_tables
        return tables.count_rows(group, self.run) > 0 or tables.file.has_entry(f"{netcdf.SERIES}/{group}")

    def read_text_attribute(self, key: str, group: str = "") -> str:
        """Return the diagnostics of the run, JSON; `key` and `group` are not used."""
        return self.long_tables.diagnostics[self.run]

    def read_array(self, name: str, length: int | None = None, dtype: str = "f8") -> Array:
        """Return the run's rows of a numeric column."""
        rows = self.long_tables.find_rows(name, self.run)
        return self._check_length(name, length, self.long_tables.read_column(name, dtype)[rows])

    def read_texts(self, name: str, length: int | None = None) -> list[str]:
        """Return the run's rows of a text column."""
        rows = self.long_tables.find_rows(name, self.run)
        return list(self._check_length(name, length, self.long_tables.read_column(name, "")[rows]))

    def _check_length(self, name: str, length: int | None, values: Array) -> Array:
        """Return the values unchanged. Raises ValueError unless their number is `length`; None allows any number."""
        if length is not None and len(values) != length:
            raise ValueError(f"run {self.run} has {len(values)} values of {name}, expected {length}")
        return values


class LongTables:
    """Columns of the long tables of a file, read once each, and the first row of each run."""

    def __init__(self, file: File, n_runs: int, has_states: bool) -> None:
        """Read the first row of each run in each group and, if `has_states`, the diagnostics. Raises ValueError."""
        has_diagnostics = n_runs and has_states
        self.file = file
        self.diagnostics = file.read_texts(f"{RUNS}/diagnostics", n_runs) if has_diagnostics else [""] * n_runs
        self.columns: dict[str, Array] = {}
        self.begins: dict[str, Array] = {}
        for group in (netcdf.SERIES, *netcdf.PARTS, netcdf.START, netcdf.GIVEN_START, netcdf.COMPILED, STORED, TIMES):
            run_numbers, needs_run_numbers = np.zeros(0, np.int32), group not in (netcdf.COMPILED, TIMES)
            if file.has_entry(group) and (needs_run_numbers or file.has_entry(f"{group}/{RUN_COLUMN}")):
                run_numbers = file.read_array(f"{group}/{RUN_COLUMN}", None, "i4")
            if len(run_numbers) and (
                run_numbers[0] < 0 or run_numbers[-1] >= n_runs or (np.diff(run_numbers) < 0).any()
            ):
                raise ValueError(f"the rows of {group} have invalid run numbers")
            self.begins[group] = np.searchsorted(run_numbers, np.arange(n_runs + 1))

    def count_rows(self, group: str, run: int) -> int:
        """Return the number of rows of a run in a group; 0 for an unknown group."""
        begins = self.begins.get(group, np.zeros(run + 2, np.int64))
        return int(begins[run + 1] - begins[run])

    def find_rows(self, name: str, run: int) -> slice:
        """Return the rows of a run in the table of a column ("group/name", or the name of a series)."""
        begins = self.begins[name.rpartition("/")[0] or netcdf.SERIES]
        return slice(int(begins[run]), int(begins[run + 1]))

    def read_column(self, name: str, dtype: str) -> Array:
        """Return a column of all runs by "group/name" or name of a series, read on first access (dtype "": texts)."""
        name = f"{name.rpartition('/')[0] or netcdf.SERIES}/{name_column(name.rpartition('/')[2])}"
        if name not in self.columns:
            n_rows = int(self.begins[name.rpartition("/")[0]][-1])
            texts = np.array(self.file.read_texts(name, n_rows), dtype=object) if not dtype else None
            self.columns[name] = self.file.read_array(name, n_rows, dtype) if texts is None else texts
        return self.columns[name]


@dataclass
class _StoredResults:
    """Results and errors of a loaded batch by the number of the run."""

    runs: dict[int, Result]
    errors: dict[int, GudgeonError]

    def __call__(self, i: int) -> Result:
        """Return the result of run i. Raises its error."""
        if i in self.errors:
            raise self.errors[i]
        return self.runs[i]

    def build_run_samples(self, i: int, field_names: frozenset[str]) -> Result | None:
        """Return run i, of which every series is stored; None if it did not begin."""
        return self.runs.get(i)

    def notes(self) -> dict[int, tuple[str, ...]]:
        """Return the notes of the runs by number."""
        return {i: run.diagnostics.notes for i, run in self.runs.items()}


def _read_batch(opened_file: Any, size: int) -> Batch:
    """Return the batch of an open HDF5 file of `size` bytes. Raises ValueError, TypeError or KeyError if invalid."""
    file = File(opened_file, size, FORMATS)
    source, count = netcdf.read_source(file), len(file.read_array(RUN_COLUMN, None, "i8"))
    batch_values = json.loads(file.read_text_attribute("batch"))
    stored_names = batch_values.get("kept")
    series_names, long_tables = tuple(get_catalogue(source)), LongTables(file, count, stored_names is None)
    begun_runs = [i for i in range(count) if long_tables.diagnostics[i]]
    runs = {i: netcdf.read_result(_RunRows(long_tables, i), source, series_names) for i in begun_runs}
    provenance = netcdf.read_provenance(file)
    for run in runs.values():
        run.provenance = provenance
    failure_texts = file.read_texts(f"{RUNS}/failure", count)
    errors_by_run = {i: _parse_error_json(text, runs.get(i)) for i, text in enumerate(failure_texts) if text}
    if missing_runs := [i for i in range(count) if stored_names is None and i not in runs and i not in errors_by_run]:
        raise ValueError(f"run {missing_runs[0]} has neither a result nor a failure")
    t = read_times(long_tables, count, bool(batch_values.get("own_times")))
    counts = {name: file.read_integers_or_floats(f"{RUNS}/{name}", count) for name in COUNTS}
    run_files = [_RunRows(long_tables, i) for i in range(count)]
    samples = file.read_array(f"{RUNS}/samples", count, "i8")
    padded = [_pad_samples(runs, name, count, t.shape[-1], source) for name in ("q", "v", "work", "state")]
    return Batch(
        source=source,
        t=t,
        states=States(*padded) if stored_names is None else None,
        samples=samples,
        kept={}
        if stored_names is None
        else read_stored_series(long_tables, stored_names, series_names, samples, t.shape[-1]),
        t_last=file.read_array(f"{RUNS}/t_last", count),
        parameters=_read_parameters(file, source, count, runs),
        impacts=tuple(netcdf.read_impacts(run, source) for run in run_files),
        events=tuple(netcdf.read_events(run, source) for run in run_files),
        peaks=_read_peaks(file, source, count),
        diagnostics=counts,
        failures=make_failures(errors_by_run),
        seconds=float(batch_values["seconds"]),
        threads=int(batch_values["threads"]),
        interrupted=bool(batch_values["interrupted"]),
        result=_StoredResults(runs, errors_by_run),
        extremes=_read_extremes(file, source, count, runs if stored_names is None else None),
    )


def read_times(long_tables: LongTables, n_runs: int, has_times_by_run: bool) -> Array:
    """Return the requested times: (N,), or (n, N) padded with NaN where each run has its own. Raises ValueError."""
    t = long_tables.file.read_array(f"{TIMES}/time")
    if not has_times_by_run:
        netcdf.check_times(t)
        return t
    for i in range(n_runs):
        netcdf.check_times(t[long_tables.begins[TIMES][i] : long_tables.begins[TIMES][i + 1]])
    n_columns = max((long_tables.count_rows(TIMES, i) for i in range(n_runs)), default=0)
    return _arrange_column(long_tables, TIMES, t, n_runs, n_columns)


def _arrange_column(long_tables: LongTables, group: str, column: Array, n_runs: int, n_columns: int) -> Array:
    """Return a column of a long table as (n, N), a row for each run padded with NaN. Raises ValueError."""
    values = np.full((n_runs, n_columns), np.nan)
    if len(column) != long_tables.begins[group][-1]:
        raise ValueError(f"{group} has {len(column)} values, expected {long_tables.begins[group][-1]}")
    for i in range(n_runs):
        run_values = column[long_tables.begins[group][i] : long_tables.begins[group][i + 1]]
        values[i, : len(run_values)] = run_values
    return values


def read_stored_series(
    long_tables: LongTables, stored_names: Any, names: tuple[str, ...], samples: Array, n_columns: int
) -> dict[str, Array]:
    """Return the stored series of a batch without states, (n, `n_columns`) each, by name, padded by NaN.

    `stored_names`: names in the file; `names`: all series of the scene; `samples` (n,): number of samples of each run.
    Raises ValueError for unknown names, or if the numbers of rows are not those of `samples`.
    """
    is_valid = (
        isinstance(stored_names, list) and "t" in stored_names and all(name in ("t", *names) for name in stored_names)
    )
    if not is_valid or [long_tables.count_rows(STORED, i) for i in range(len(samples))] != samples.tolist():
        raise ValueError("the stored series do not match its runs")
    series_by_name = {}
    for name in stored_names:
        dataset_name = f"{STORED}/{name_column(_format_stored_name(name))}"
        column = long_tables.file.read_array(dataset_name) if long_tables.file.has_entry(STORED) else np.zeros(0)
        series_by_name[name] = _arrange_column(long_tables, STORED, column, len(samples), n_columns)
    return series_by_name


def _read_extremes(file: File, source: KernelSource, n_runs: int, runs: Mapping[int, Result] | None) -> Any:
    """Return the extremes over all steps as a tuple of Extremes for each run.

    They are read from the diagnostics of `runs`, with () for a run that it lacks. If `runs` is None they are read from
    the table `runs` of the file; () if it has none.
    """
    if runs is not None:
        return tuple(runs[i].diagnostics.extremes if i in runs else () for i in range(n_runs))
    if not file.has_entry(f"{RUNS}/{EXTREMES}"):
        return ()
    extremes = tuple(map(convert_extremes_from_json, file.read_texts(f"{RUNS}/{EXTREMES}", n_runs)))
    check_type(extremes, tuple[tuple[Extremes, ...], ...], EXTREMES)
    return tuple(netcdf.check_extremes(run_extremes, get_catalogue(source)) for run_extremes in extremes)


def _pad_samples(runs: Mapping[int, Result], name: str, n_runs: int, n_samples: int, source: KernelSource) -> Array:
    """Return "q", "v", "work" or "state" of all runs as (n, N, width), NaN (codes: 0) where a run has no sample."""
    dtype = np.int8 if name == "state" else np.float64
    width = {"work": 3, "state": len(source.clearances)}.get(name, len(source.coordinates))
    padded = np.full((n_runs, n_samples, width), 0 if name == "state" else np.nan, dtype=dtype)
    for i, run in runs.items():
        values = getattr(run, name)
        padded[i, : len(values)] = values
    return padded


def _read_parameters(file: File, source: KernelSource, n_runs: int, runs: Mapping[int, Result]) -> dict[str, Array]:
    """Return the given parameters of the runs, (n,) each, by address.

    Raises ValueError for an unknown parameter or choice, and for a value other than that in the run's result.
    """
    if not file.has_entry(GIVEN):
        return {}
    given_parameters = {
        parameter.address: parameter
        for parameter in source.parameters
        if file.has_entry(f"{GIVEN}/{parameter.address}")
    }
    if unknown_names := sorted({*file.list_names(GIVEN)} - {*given_parameters, NUMBER}):
        raise ValueError(f"{unknown_names[0][:64]!r} was given, but its scene has no such parameter")
    given = {
        address: np.array(file.read_texts(f"{GIVEN}/{address}", n_runs), dtype=object)
        if parameter.words
        else file.read_array(f"{GIVEN}/{address}", n_runs)
        for address, parameter in given_parameters.items()
    }
    for address, values in given.items():
        for i, value in enumerate(values.tolist()):
            if given_parameters[address].words and value not in given_parameters[address].words:
                raise ValueError(f"run {i}: {address} is {value[:64]!r}, which is not a choice")
            if i in runs and value != runs[i].parameters[address]:
                actual = runs[i].parameters[address]
                raise ValueError(f"run {i}: {address} is {actual!r}, but was given as {value!r}")
    return given


def _read_peaks(file: File, source: KernelSource, n_runs: int) -> Array:
    """Return the peak forces of all runs from the table `runs`, PEAK_DTYPE (n, n_clearances). Raises ValueError."""
    peaks = np.full((n_runs, len(source.clearances)), np.nan, dtype=PEAK_DTYPE)
    for k, joint in enumerate(source.clearances):
        for name in PEAK_DTYPE.names or ():
            peaks[name][:, k] = file.read_array(f"{RUNS}/{joint.name}.peak.{name}", n_runs)
    return peaks

"""Export results in SI to other programs: pandas tables, xarray Datasets of several scenes, CSV, MATLAB files.

A batch is a long table with a row for each reached sample: number of the run, given parameters, t and the series.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.files.free_space import check_disk, check_memory
from gudgeon.files.writing import open_atomic
from gudgeon.language.argument_checks import check_list, check_names, check_path, raise_bad_value
from gudgeon.language.text_output import escape_for_spreadsheet
from gudgeon.results.batch import (
    Batch,
    check_series_names,
    collect_given_columns,
    collect_series,
    iterate_run_series,
    name_series_column,
)
from gudgeon.results.files.netcdf import import_xarray
from gudgeon.results.results import Array, Result
from gudgeon.results.series import get_catalogue

if TYPE_CHECKING:
    import pandas
    import xarray

Columns: TypeAlias = "dict[str, Array]"  # name -> (rows,)

ROWS_PER_WRITE = 4096  # rows of a CSV file that are formatted at once
N_SAMPLE_ROWS = 64  # rows of a run from which the size of the file is estimated
MATLAB_HEADER_TEXT_BYTES = 116  # text at the start of a MATLAB file, in which SciPy writes the date
MATLAB_HEADER = b"MATLAB 5.0 MAT-file, written by gudgeon"
MAX_MATLAB_NAME = 63  # characters of a name in MATLAB
KEYWORDS = frozenset(
    {
        "break",
        "case",
        "catch",
        "classdef",
        "continue",
        "else",
        "elseif",
        "end",
        "for",
        "function",
        "global",
        "if",
        "otherwise",
        "parfor",
        "persistent",
        "return",
        "spmd",
        "switch",
        "try",
        "while",
    }
)


def list_requested_series(run: Result, names: Iterable[str] | None) -> list[str]:
    """Return the names of the series to export, without t; all for None.

    Raises UnknownNameError for an unknown name, BadValueError for a text instead of a list and for a repeated name.
    """
    if names is None:
        return list(run.names)
    if isinstance(names, str):
        raise_bad_value("names", names, "a list of names of series")
    checked = check_names(names, "names", "a list of names of series")
    for name in checked:
        run.unit(name)
    return [name for name in checked if name != "t"]


def build_dataframe(run: Result, names: Iterable[str] | None) -> pandas.DataFrame:
    """Return series of a run as a pandas table with t (s) as index; see Result.to_dataframe.

    Units and origin are in `attrs`. `names` None: all series.
    """
    pandas_module = _import_pandas()
    series = list_requested_series(run, names)
    table: pandas.DataFrame = pandas_module.DataFrame(
        {name: run[name] for name in series}, index=pandas_module.Index(run.t, name="t"), copy=True
    )
    table.attrs = {"units": {"t": "s"} | {name: run.unit(name) for name in series}} | _get_origin_attributes(run)
    return table


def build_batch_dataframe(batch: Batch, names: Iterable[str] | None) -> pandas.DataFrame:
    """Return series of a batch as a long pandas table with a row for each reached sample; see Batch.to_dataframe.

    Its columns are the number of the run, the given parameters, t and the series; its `attrs` have the units, and
    mechanism, scene and title. Without runs it is empty. `names` None: all series. Raises MemoryError if the table
    would exceed the free memory.
    """
    pandas_module = _import_pandas()
    n_columns = len(_select_batch_series(batch, names)) + len(batch.parameters) + 2
    check_memory(2 * 8.0 * n_columns * _count_rows(batch), f"a table of {len(batch)} runs")
    columns_by_run = list(_iterate_columns_by_run(batch, names))
    columns = (
        {name: np.concatenate([run_columns[name] for run_columns in columns_by_run]) for name in columns_by_run[0]}
        if columns_by_run
        else {}
    )
    units = {"t": "s"} | {name: series.unit for name, series in get_catalogue(batch.source).items()}
    units |= {parameter.address: parameter.unit for parameter in batch.source.parameters}
    table: pandas.DataFrame = pandas_module.DataFrame(columns)
    table.attrs = {"units": {name: units.get(name, "") for name in columns}} | _get_origin_attributes(batch)
    return table


def _get_origin_attributes(result: Result | Batch) -> dict[str, str]:
    """Return mechanism, scene and title of a result as attributes of a table."""
    return {"mechanism": result.source.mechanism, "scene": result.source.scene, "title": result.source.title}


def _import_pandas() -> Any:
    """Return the module pandas. Raises GudgeonError with the command that installs it if it is missing."""
    try:
        import pandas
    except ModuleNotFoundError as error:
        raise GudgeonError("tables need pandas: pip install 'gudgeon[xarray]'") from error
    return pandas


def _select_batch_series(batch: Batch, names: Iterable[str] | None) -> list[str]:
    """Return the names of the series of a batch to export, without t; None selects all."""
    available_names = batch.kept if batch.states is None else get_catalogue(batch.source)
    return [
        name for name in (available_names if names is None else check_series_names(batch.source, names)) if name != "t"
    ]


def _iterate_columns_by_run(batch: Batch, names: Iterable[str] | None) -> Iterator[Columns]:
    """Yield for each run that has samples its columns by name: run, given parameters, t, series."""
    columns = collect_given_columns(batch)
    for i, t, series_by_name in iterate_run_series(batch, _select_batch_series(batch, names)):
        given_values = {name: values[i] for name, values in columns.items()}
        constant_columns = {"run": np.full(len(t), i)} | {
            name: np.full(len(t), value) for name, value in given_values.items()
        }
        yield (
            constant_columns | {"t": t} | {name_series_column(name): values for name, values in series_by_name.items()}
        )


def _count_rows(batch: Batch) -> float:
    """Return the number of samples of all runs."""
    return float(batch.samples.sum())


def write_csv(run: Result, path: str | os.PathLike[str], names: Iterable[str] | None) -> None:
    """Write series of a run as CSV. See Result.to_csv."""
    series = list_requested_series(run, names)
    _write_csv(path, iter([{"t": run.t} | {name: run[name] for name in series}]), len(run.t))


def write_batch_csv(batch: Batch, path: str | os.PathLike[str], names: Iterable[str] | None) -> None:
    """Write series of a batch as CSV. See Batch.to_csv."""
    _write_csv(path, _iterate_columns_by_run(batch, names), _count_rows(batch))


def _write_csv(path: str | os.PathLike[str], columns_by_run: Iterator[Columns], n_rows: float) -> None:
    """Write a line of names, then a line for each row, with the shortest digits that read back as the same number.

    Raises OutputError before the first row if `n_rows` lines of the average length of a few rows of the first run do
    not fit on the disk.
    """
    with open_atomic(check_path(path, "path")) as file:
        for k, run_columns in enumerate(columns_by_run):
            columns = list(run_columns.values())
            if k == 0:
                sample_lines = _format_csv_lines(
                    [column[:: max(1, len(column) // N_SAMPLE_ROWS)] for column in columns]
                )
                check_disk(
                    Path(path).parent, n_rows * len("".join(sample_lines)) / max(1, len(sample_lines)), "it", path
                )
                file.write((",".join(run_columns) + "\n").encode())
            for start in range(0, len(columns[0]), ROWS_PER_WRITE):
                file.write(
                    "".join(_format_csv_lines([column[start : start + ROWS_PER_WRITE] for column in columns])).encode()
                )


def _format_csv_lines(columns: Sequence[Array]) -> list[str]:
    """Return the lines of a CSV file for columns of equal length.

    Columns of texts are escaped for spreadsheets.
    """
    format_value = _format_cell if any(column.dtype.kind in "OU" for column in columns) else repr
    return [
        ",".join(map(format_value, row)) + "\n" for row in zip(*(column.tolist() for column in columns), strict=True)
    ]


def _format_cell(value: object) -> str:
    """Return a cell of a CSV file: a number with all digits, or a text escaped for spreadsheets (without commas)."""
    return str(escape_for_spreadsheet(value)) if isinstance(value, str) else repr(value)


def write_mat(run: Result, path: str | os.PathLike[str], names: Iterable[str] | None) -> None:
    """Write series of a run as a MATLAB file. See Result.to_mat.

    `names` None: all series.
    """
    series = ["t", *list_requested_series(run, names)]
    descriptions = [(name, run.unit(name), run.meaning(name)) for name in series]
    _write_mat(path, run, descriptions, {name: np.asarray(run[name], dtype=float) for name in series})


def write_batch_mat(batch: Batch, path: str | os.PathLike[str], names: Iterable[str] | None) -> None:
    """Write series of a batch as a MATLAB file; see Batch.to_mat.

    Raises MemoryError if the series would exceed the free memory. `names` None: all series.
    """
    all_series, parameters = (
        get_catalogue(batch.source),
        {parameter.address: parameter for parameter in batch.source.parameters},
    )
    names_of_series = _select_batch_series(batch, names)
    descriptions = [
        ("t", "s", "time"),
        *((name, all_series[name].unit, all_series[name].meaning) for name in names_of_series),
    ]
    given = collect_given_columns(batch)
    columns_and_addresses = zip(given, batch.parameters, strict=True)
    descriptions += [
        (column, parameters[name].unit, "given value of each run") for column, name in columns_and_addresses
    ]
    size = 8.0 * (len(names_of_series) + 1) * len(batch) * batch.t.shape[-1]
    check_memory(size, f"{len(names_of_series)} series of {len(batch)} runs")
    _write_mat(path, batch, descriptions, collect_series(batch, ["t", *names_of_series]) | given)


def _write_mat(
    path: str | os.PathLike[str], result: Result | Batch, descriptions: Sequence[tuple[str, str, str]], columns: Columns
) -> None:
    """Write columns under MATLAB's names to a file, with `descriptions` (name, unit, meaning) as cells.

    The header has no date. Raises OutputError if the columns do not fit on the disk.
    """
    from scipy.io import savemat

    matlab_names = _make_matlab_names([name for name, *_ in descriptions])
    contents: dict[str, Any] = {matlab_names[name]: columns[name] for name in matlab_names}
    contents["variables"] = np.array(list(matlab_names.values()), dtype=object)
    for column, cell_name in enumerate(("names", "units", "meanings")):
        contents[cell_name] = np.array([row[column] for row in descriptions], dtype=object)
    contents |= {"mechanism": result.source.mechanism, "scene": result.source.scene}
    path = check_path(path, "path")
    check_disk(Path(path).parent, sum(float(column.nbytes) for column in columns.values()), "it", path)
    with open_atomic(path) as file:
        savemat(file, contents, long_field_names=True, oned_as="column")
        file.seek(0)
        file.write(MATLAB_HEADER.ljust(MATLAB_HEADER_TEXT_BYTES))  # the same run gives the same bytes


def _make_matlab_names(names: Sequence[str]) -> dict[str, str]:
    """Return a valid and unique MATLAB name for each name: "S9.y" → "S9_y".

    Keywords get a final underscore, names that begin with no letter an "x", and repetitions a number. Names are cut to
    MAX_MATLAB_NAME characters.
    """
    matlab_names: dict[str, str] = {}
    used = {"variables", "names", "units", "meanings", "mechanism", "scene"}
    for name in names:
        valid_name = re.sub(r"\W", "_", name, flags=re.ASCII)
        valid_name = (
            f"{valid_name}_" if valid_name in KEYWORDS else valid_name if valid_name[0].isalpha() else f"x{valid_name}"
        )[:MAX_MATLAB_NAME]
        candidate, number = valid_name, 2
        while candidate in used:
            suffix = f"_{number}"
            candidate, number = valid_name[: MAX_MATLAB_NAME - len(suffix)] + suffix, number + 1
        used.add(candidate)
        matlab_names[name] = candidate
    return matlab_names


def join(runs: Iterable[Result | Batch]) -> xarray.Dataset:
    """Return a Dataset of series over `scene` and `time` (and `run` for batches) from results of scenes of one
    mechanism.

    NaN marks series that a scene lacks and times of other scenes only. Raises BadValueError for two results of one
    scene, which are a batch, for results of two mechanisms, and for results mixed with batches.
    """
    classes: Any = (Result, Batch)
    results: list[Result | Batch] = check_list(runs, "runs", classes, "a list of results, one a scene")
    scenes = [run.source.scene for run in results]
    if not scenes or len({*map(type, results)}) > 1:
        raise BadValueError("join: expected results, or batches, of one scene or more")
    if repeated_scenes := [scene for scene in scenes if scenes.count(scene) > 1]:
        hint = "use simulate_many for runs of one scene with different parameters"
        raise BadValueError(f"join: two results are of the scene {repeated_scenes[0]!r}", hint=hint)
    if len(names := list(dict.fromkeys(run.source.mechanism for run in results))) > 1:
        hint = "join results of one mechanism"
        raise BadValueError(f"join: {names[0]!r} and {names[1]!r} are two mechanisms", hint=hint)
    xarray = import_xarray()
    _check_output_times(results)
    datasets, scene_index = [run.to_xarray() for run in results], _import_pandas().Index(scenes, name="scene")
    attributes = {"mechanism": names[0], "title": results[0].source.title}
    joined: Any = xarray.concat(
        datasets,
        scene_index,
        data_vars="all",
        coords="different",
        compat="equals",
        join="outer",
        combine_attrs="drop_conflicts",
    )
    return joined.assign_attrs(attributes)


def _check_output_times(results: list[Result | Batch]) -> None:
    """Raise BadValueError for batches whose runs have different numbers of output times, or common times and times of
    their own.
    """
    shapes = {run.t.shape[1:] for run in results}
    if len(shapes) > 1:
        run_with_own_times = next(run for run in results if run.t.ndim == 2)
        raise BadValueError(
            f"join: the runs of scene {run_with_own_times.source.scene!r} have times of their own,"
            " in a different number than those of other scenes",
            hint="join batches with common times, or with equal numbers of samples",
        )

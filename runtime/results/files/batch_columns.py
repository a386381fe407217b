"""What the file of a batch has beside its runs' own tables: times of each run, and series that were kept."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.results.bare import blank
from gudgeon.results.files import netcdf
from gudgeon.results.files.hdf5 import Table, Variable
from gudgeon.results.files.netcdf_read import check_times
from gudgeon.results.results import Array

if TYPE_CHECKING:
    from gudgeon.results.batch import Batch
    from gudgeon.results.files.netcdf_batch import Whole

TIMES, KEPT, OWNER = "times", "kept", "run"


def long_table(group: str, parts: list[tuple[int, Table]], attributes: dict[str, str]) -> Table:
    """The same table of several runs as one, whose first column is the run."""
    rows = [np.full(table.length, i, np.int32) for i, table in parts]
    found = [Variable(OWNER, np.concatenate(rows), "", "number of the run")] if parts else []
    for k, first in enumerate(parts[0][1].variables if parts else ()):
        values = np.concatenate([table.variables[k].values for _, table in parts])
        found.append(Variable(beside_owner(first.name), values, first.unit, first.meaning))
    return Table(group, "row", tuple(found), attributes)


def beside_owner(name: str) -> str:
    """An output may be called like the column of runs, or like the dimension."""
    return f"output.{name}" if name in (OWNER, "row") else name


def _stored_name(name: str) -> str:
    return "time" if name == "t" else netcdf.variable(name)


def times(batch: Batch) -> Table:
    """(N,) where they are those of all runs; else a long table."""
    told = "time that was asked for"
    if batch.t.ndim == 1:
        return Table(TIMES, "time", (Variable("time", batch.t, "s", told),), {})
    own = ((i, Variable("time", row[~np.isnan(row)], "s", told)) for i, row in enumerate(batch.t))
    return long_table(TIMES, [(i, Table(TIMES, "row", (variable,), {})) for i, variable in own], {})


def kept_tables(batch: Batch) -> Iterator[tuple[int, Table]]:
    """Series that were kept of each run, its contacts and events."""
    source, known = batch.source, blank(batch.source)
    joints, events = [joint.name for joint in source.clearances], [event.name for event in source.events]
    for i, done in enumerate(batch.samples.tolist()):
        columns = ((name, values[i, :done]) for name, values in batch.kept.items())
        own = (Variable(_stored_name(n), x, known.unit(n), known.meaning(n)) for n, x in columns)
        tables = (
            Table(KEPT, "row", tuple(own), {}),
            Table("impacts", "impact", tuple(netcdf.records(batch.impacts[i], netcdf.IMPACTS, joints)), {}),
            Table("events", "occurrence", tuple(netcdf.records(batch.events[i], netcdf.EVENTS, events)), {}),
        )
        yield from ((i, table) for table in tables if table.length)


def read_times(whole: Whole, count: int, own: bool) -> Array:
    """(N,), or (n, N) where each run has its own."""
    t = whole.file.numbers(f"{TIMES}/time")
    if not own:
        check_times(t)
        return t
    for i in range(count):
        check_times(t[whole.begins[TIMES][i] : whole.begins[TIMES][i + 1]])
    return _spread(whole, TIMES, t, count, max(whole.count(TIMES, i) for i in range(count)))


def _spread(whole: Whole, group: str, column: Array, count: int, samples: int) -> Array:
    """A column of a long table as (n, N), NaN where a run has no row."""
    out = np.full((count, samples), np.nan)
    if len(column) != whole.begins[group][-1]:
        raise ValueError(f"{group} has {len(column)} values, expected {whole.begins[group][-1]}")
    for i in range(count):
        own = column[whole.begins[group][i] : whole.begins[group][i + 1]]
        out[i, : len(own)] = own
    return out


def read_kept(whole: Whole, kept: Any, names: tuple[str, ...], samples: Array, most: int) -> dict[str, Array]:
    """The series that were kept, each (n, N)."""
    known = isinstance(kept, list) and "t" in kept and all(name in ("t", *names) for name in kept)
    if not known or [whole.count(KEPT, i) for i in range(len(samples))] != samples.tolist():
        raise ValueError("the series that were kept are not those of its runs")
    found = {}
    for name in kept:
        stored = f"{KEPT}/{beside_owner(_stored_name(name))}"
        column = whole.file.numbers(stored) if whole.file.has(KEPT) else np.zeros(0)
        found[name] = _spread(whole, KEPT, column, len(samples), most)
    return found

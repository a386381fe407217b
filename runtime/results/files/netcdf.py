"""Results as NetCDF 4 files, and as xarray's Datasets.

A file holds every series under its own name over `time`, so that any NetCDF tool can read it, and in groups what has
other rows: `impacts`, `events`, the series `at_events`, `parameters`, `trace` (trace.py) and `peaks` over all steps
(peaks.py), for people; `compiled`, the kernel source and what was derived from the parameters, so that gudgeon reads
all of it back bit for bit without a compiled library; `provenance` (provenance.py). What has no row is not there. The
only date is that of the run, in `provenance`: a result that is saved twice gives the same bytes.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.files.room import check_disk
from gudgeon.files.writing import written
from gudgeon.language.wanted import mapping, text, told
from gudgeon.language.wanted import path as named
from gudgeon.model.choices import said
from gudgeon.results import peaks, trace
from gudgeon.results.files.hdf5 import Table, Variable, pieces
from gudgeon.results.provenance import GROUP
from gudgeon.results.results import Array, Result
from gudgeon.results.series import DRIFT
from gudgeon.waiting.ctrl_c import CtrlC

if TYPE_CHECKING:
    import xarray

FORMAT = "gudgeon-result/2"
LONGEST = 200  # characters of the name of an attribute
SERIES, TRACE, STATES, COMPILED, PEAKS = "series", "trace", "at_events", "compiled", "peaks"
START = "start_row"  # series at the start of a run, where that is not a sample
PARTS = ("impacts", "events", STATES, "parameters", TRACE, PEAKS)
IMPACTS = {
    "joint": ("", "joint with play"),
    "t_on": ("s", "onset of the contact"),
    "t_off": ("s", "separation, NaN: still closed; of a blow between surfaces that do not give its onset"),
    "deltadot": ("m/s", "rate of the penetration at the onset"),
    "F_peak": ("N", "largest force of the contact; of a blow its impulse, N s"),
    "t_peak": ("s", "time of the largest force"),
}
EVENTS = {"event": ("", "event of the mechanism's file"), "t": ("s", "time of the event")}


def tables(run: Result) -> Iterator[Table]:
    """All that a file holds: series over `time` at its root, groups over their own dimensions."""
    yield Table("", "time", tuple(_series(run)), attributes(run))
    yield Table(START, "time", () if run.start_row is None else tuple(_series(run.start_row)), {})
    joints = [joint.name for joint in run.source.clearances]
    yield Table("impacts", "impact", tuple(records(run.impacts, IMPACTS, joints)), {})
    events = [event.name for event in run.source.events]
    yield Table("events", "occurrence", tuple(records(run.events, EVENTS, events)), {})
    yield Table(STATES, "occurrence", tuple(_states(run, events)), {})
    yield Table("parameters", "address", tuple(_parameters(run)), {})
    traced = (Variable(name, *of) for name, of in trace.variables(run).items())
    yield Table(TRACE, "t", tuple(traced), {})
    extremes = peaks.columns(run.diagnostics.extremes)
    yield Table(PEAKS, "row", tuple(Variable(name, x, *peaks.COLUMNS[name]) for name, x in extremes.items()), {})
    derived = Variable("value", run.p[len(run.given) :], "", "what was derived from the parameters, SI")
    yield Table(COMPILED, "derived", (derived,), {"source": run.source.to_json()})
    yield Table(GROUP, "", (), run.provenance)


def _series(run: Result) -> Iterator[Variable]:
    yield Variable("time", run.t, "s", "time")
    older = () if run.compiled or DRIFT[0] in run.stored else DRIFT  # read from a file that lacks it
    for name, unit in run.names.items():
        if name in older:
            continue
        yield Variable(variable(name), run[name], unit, run.meaning(name))


def _states(run: Result, events: list[str]) -> Iterator[Variable]:
    """Every series at the events, beside their names and times; nothing where they are not known."""
    try:
        at = run.states_at_events if len(run.events) else None
        names = [name for name in run.names if at is not None and (at.compiled or name in at.stored)]
        found = {name: at[name][1:] for name in names} if at is not None else {}
    except GudgeonError:  # an older file, a motion that cannot be followed or evaluated there: the samples are whole
        return
    if found:
        yield from list(records(run.events, EVENTS, events))
    for name, values in found.items():
        yield Variable(at_event(name), values, run.unit(name), run.meaning(name))


def at_event(name: str) -> str:
    """The same beside the names and times of events."""
    return f"output.{name}" if name in (*EVENTS, "occurrence") else name


def records(rows: Array, columns: dict[str, tuple[str, str]], names: list[str]) -> Iterator[Variable]:
    """Columns of impacts or events; the first one's numbers as the names that they stand for."""
    for k, (name, (unit, meaning)) in enumerate(columns.items()):
        yield Variable(name, _texts([names[i] for i in rows[name]]) if k == 0 else rows[name], unit, meaning)


def _parameters(run: Result) -> Iterator[Variable]:
    slots = run.source.slots
    yield Variable("address", _texts([slot.address for slot in slots]), "", "where the number stands in the file")
    yield Variable("value", run.p[: len(slots)], "", "what the run had, SI")
    yield Variable("unit", _texts([slot.unit for slot in slots]), "", "of the value")
    yield Variable("given", run.given, "", "overridden value, SI")
    yield Variable("is_given", run.is_given.astype(np.int8), "", "1 where it was overridden")
    if any(slot.words for slot in slots):
        told = [str(said(slot, float(x))) if slot.words else "" for slot, x in zip(slots, run.p, strict=False)]
        yield Variable("name", _texts(told), "", "of what was chosen where the value is its place")


def _texts(values: list[str]) -> Array:
    return np.array(values, dtype=object)


def attributes(run: Result) -> dict[str, str]:
    """Of the whole file."""
    return {
        "gudgeon": FORMAT,
        "title": run.source.title,
        "mechanism": run.source.mechanism,
        "scene": run.source.scene,
        "diagnostics": run.diagnostics.to_json(),
    }


def variable(name: str) -> str:
    """An output may be called like what else stands at the root; no other name can, for they all have a dot."""
    return f"output.{name}" if name in ("time", *PARTS, START, COMPILED, GROUP) else name


def dataset(run: Result, part: str = SERIES) -> xarray.Dataset:
    """A table of the file as an xarray Dataset: the series, or one of PARTS."""
    try:
        import xarray
    except ModuleNotFoundError as error:
        raise GudgeonError("Datasets need xarray: pip install 'gudgeon[xarray]'") from error
    part = text(part, "part", "the name of a table")
    group = "" if part == SERIES else part
    if part not in (SERIES, *PARTS):
        from gudgeon.errors import UnknownNameError

        raise UnknownNameError(f"a result has no part {part!r}", hint=f"there are: {', '.join((SERIES, *PARTS))}")
    table = next(table for table in tables(run) if table.group == group)
    found: dict[str, Any] = {v.name: (table.dimension, v.values, v.attributes) for v in table.variables}
    return xarray.Dataset(found, attrs=dict(table.attributes))


def save(run: Result, path: str | os.PathLike[str], more: Mapping[str, str] = MappingProxyType({})) -> None:
    """Write `run` to `path`, with more attributes. OutputError where that fails; an older file is then as it was."""
    root, *others = tables(run)
    write(iter([replace(root, attributes={**root.attributes, **_more(more, root)}), *others]), path)


def _more(given: Any, root: Table) -> dict[str, str]:
    """Attributes of the user's; those that a result is read back by are not written over. BadValueError."""
    found = {}
    for name, value in mapping(given, "attributes", "{name: text}").items():
        if not 0 < len(name) <= LONGEST or not name.isprintable() or name in root.attributes:
            hint = f"expected a name other than {', '.join(root.attributes)}"
            raise BadValueError(f"attributes: {told(name)} is no name for one of your own", hint=hint)
        found[name] = text(value, f"attributes: {name}")
    return found


def write(tables: Iterator[Table], path: str | os.PathLike[str]) -> None:
    """A file with these tables; they are made one after the other, and Ctrl-C is taken in between."""
    try:
        import h5py  # noqa: F401
    except ModuleNotFoundError as error:
        raise GudgeonError("NetCDF files need h5py: pip install 'gudgeon[xarray]'") from error
    path, found = named(path, "path"), []
    with CtrlC() as ctrl_c:  # Python drops what is raised in callbacks of weak references, Ctrl-C too
        for table in tables:
            found.append(table)
            ctrl_c.take()
        size = sum(one.values.nbytes for table in found for one in table.variables)
        check_disk(Path(path).parent, size, "it", path)
        with written(path) as file:
            for piece in pieces(found):
                file.write(piece)
                ctrl_c.take()
    ctrl_c.take()

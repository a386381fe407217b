"""Write and read results as NetCDF 4 files, and convert them to xarray Datasets.

A file contains every series under its own name over `time`, so that any NetCDF tool can read it. Groups contain tables
with other rows: `impacts`, `events`, the series `at_events`, `parameters`, `trace` and `peaks` over all steps
(peaks.py), for readers. `compiled` has the kernel source and derived parameters, from which gudgeon restores the result
bit for bit without a compiled library; `provenance` is described in diagnostics.py. Empty tables are left out. The only
date is that of the run, in `provenance`: a result that is saved twice gives the same bytes.
"""

from __future__ import annotations

import os
import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.integrators.trajectory import EVENT_DTYPE, IMPACT_DTYPE, TRACE_COLUMNS, TRACED, Trace
from gudgeon.language.argument_checks import mapping, message, text
from gudgeon.model.choices import specified
from gudgeon.results.diagnostics import PROVENANCE, Diagnostics, Extremes
from gudgeon.results.files.hdf5 import Table, Variable, write
from gudgeon.results.files.untrusted import OLD_FORMAT, File, check_typed, open_result_file
from gudgeon.results.results import Array, Result
from gudgeon.results.series import DRIFT, MOTION, catalogue
from gudgeon.results.state import State

if TYPE_CHECKING:
    import xarray

FORMAT = "gudgeon-result/2"
LONGEST = 200  # characters of the name of an attribute
SERIES, TRACE, STATES, COMPILED, PEAKS = "series", "trace", "at_events", "compiled", "peaks"
START = "start_row"  # series at the start of a run, where that is not a sample
GIVEN_START = "given_start"  # the state that a run was given as `start`
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
PROVENANCE_GROUP = "provenance"
TRACE_TIME = ("s", "end of the last step that the row tells of")
EXTREMES = {
    "name": ("", "series"),
    "against": ("", "scene whose series was subtracted"),
    "unit": ("", "unit of the values"),
    "max": ("", "largest value over all steps, SI"),
    "t_max": ("s", "its time"),
    "min": ("", "smallest value over all steps, SI"),
    "t_min": ("s", "its time"),
}
OLD_NAMES = ("time", "impact", "event", "slot", "prepared")  # of the root of an old file, over dimensions of their own
NAME, UNIT = re.compile(r"[A-Za-z][\w.]*", re.ASCII), re.compile(r"[\w^*/. ()-]*", re.ASCII)


def tables(run: Result) -> Iterator[Table]:
    """Yield all tables of a file: series over `time` at its root, groups over their own dimensions."""
    yield Table("", "time", tuple(_series_variables(run)), attributes(run))
    yield Table(START, "time", () if run.start_row is None else tuple(_series_variables(run.start_row)), {})
    yield Table(GIVEN_START, "row", tuple(_given_start_variables(run)), {})
    joints = [joint.name for joint in run.source.clearances]
    yield Table("impacts", "impact", tuple(records(run.impacts, IMPACTS, joints)), {})
    events = [event.name for event in run.source.events]
    yield Table("events", "occurrence", tuple(records(run.events, EVENTS, events)), {})
    yield Table(STATES, "occurrence", tuple(_event_state_variables(run, events)), {})
    yield Table("parameters", "address", tuple(_parameter_variables(run)), {})
    yield Table(TRACE, "t", tuple(_envelope_variables(run)), {})
    yield Table(PEAKS, "row", tuple(_peak_variables(run)), {})
    derived = Variable("value", run.p[len(run.given) :], "", "what was derived from the parameters, SI")
    yield Table(COMPILED, "derived", (derived,), {"source": run.source.to_json()})
    yield Table(PROVENANCE_GROUP, "", (), run.provenance)


def _series_variables(run: Result) -> Iterator[Variable]:
    """Yield the time and every series of a run."""
    yield Variable("time", run.t, "s", "time")
    older = () if run.compiled or DRIFT[0] in run.stored else DRIFT  # read from a file that lacks it
    for name, unit in run.names.items():
        if name in older:
            continue
        yield Variable(variable(name), run[name], unit, run.meaning(name))


def _given_start_variables(run: Result) -> Iterator[Variable]:
    """Yield the given start state as one column; nothing if the run was given none."""
    if run.begun is not None:
        parts = ([run.begun.t], run.begun.q, run.begun.v, run.begun.state, run.begun.memory)
        values = np.concatenate([np.asarray(part, dtype=np.float64) for part in parts])
        yield Variable("value", values, "", "time, coordinates, velocities, contact codes, memory, SI")


def _event_state_variables(run: Result, events: list[str]) -> Iterator[Variable]:
    """Yield every series at the events, with their names and times; nothing where the states are not known."""
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
    """Return the name of a series in the table of events, other than the columns of that table."""
    return f"output.{name}" if name in (*EVENTS, "occurrence") else name


def records(rows: Array, columns: dict[str, tuple[str, str]], names: list[str]) -> Iterator[Variable]:
    """Yield the columns of impacts or events; the first column as the names for its numbers."""
    for k, (name, (unit, meaning)) in enumerate(columns.items()):
        yield Variable(name, _as_text_array([names[i] for i in rows[name]]) if k == 0 else rows[name], unit, meaning)


def _parameter_variables(run: Result) -> Iterator[Variable]:
    """Yield the columns of the table of run-time parameters."""
    slots = run.source.slots
    yield Variable(
        "address", _as_text_array([slot.address for slot in slots]), "", "where the number stands in the file"
    )
    yield Variable("value", run.p[: len(slots)], "", "what the run had, SI")
    yield Variable("unit", _as_text_array([slot.unit for slot in slots]), "", "of the value")
    yield Variable("given", run.given, "", "overridden value, SI")
    yield Variable("is_given", run.is_given.astype(np.int8), "", "1 where it was overridden")
    if any(slot.words for slot in slots):
        choice_names = [
            str(specified(slot, float(x))) if slot.words else "" for slot, x in zip(slots, run.p, strict=False)
        ]
        yield Variable("name", _as_text_array(choice_names), "", "of what was chosen where the value is its place")


def _as_text_array(values: list[str]) -> Array:
    """Return texts as an array of objects."""
    return np.array(values, dtype=object)


def _envelope_variables(run: Result) -> Iterator[Variable]:
    """Yield the envelope over the steps: extreme forces and positions of the journals; nothing if the run has none."""
    if run.trace is None:
        return
    yield Variable("t", run.trace.t, *TRACE_TIME)
    for k, joint in enumerate(run.source.clearances):
        for column, (name, (unit, meaning)) in enumerate(TRACED.items()):
            yield Variable(f"{joint.name}.{name}", run.trace.joints[:, k, column], unit, meaning)


def _peak_variables(run: Result) -> Iterator[Variable]:
    """Yield the columns of peaks over all steps, for readers; `diagnostics` restores them."""
    for name, (unit, meaning) in EXTREMES.items():
        values = [getattr(one, name) for one in run.diagnostics.extremes]
        yield Variable(
            name, _as_text_array(values) if name in ("name", "against", "unit") else np.array(values), unit, meaning
        )


def attributes(run: Result) -> dict[str, str]:
    """Return the attributes of the whole file."""
    return {
        "gudgeon": FORMAT,
        "title": run.source.title,
        "mechanism": run.source.mechanism,
        "scene": run.source.scene,
        "diagnostics": run.diagnostics.to_json(),
    }


def variable(name: str) -> str:
    """Return the name of a series in the file: an output with the name of a group or of the time gets a prefix."""
    return f"output.{name}" if name in ("time", *PARTS, START, GIVEN_START, COMPILED, PROVENANCE_GROUP) else name


def import_xarray() -> Any:
    """Return the module xarray. Raises GudgeonError if it is not installed."""
    try:
        import xarray
    except ModuleNotFoundError as error:
        raise GudgeonError("Datasets need xarray: pip install 'gudgeon[xarray]'") from error
    return xarray


def dataset(run: Result, part: str = SERIES) -> xarray.Dataset:
    """Return a table of the file as an xarray Dataset: the series, or one of PARTS."""
    xarray = import_xarray()
    part = text(part, "part", "the name of a table")
    group = "" if part == SERIES else part
    if part not in (SERIES, *PARTS):
        from gudgeon.errors import UnknownNameError

        raise UnknownNameError(f"a result has no part {part!r}", hint=f"there are: {', '.join((SERIES, *PARTS))}")
    table = next(table for table in tables(run) if table.group == group)
    found: dict[str, Any] = {v.name: (table.dimension, v.values, v.attributes) for v in table.variables}
    return xarray.Dataset(found, attrs=dict(table.attributes))


def save(run: Result, path: str | os.PathLike[str], user_attributes: Mapping[str, str] = MappingProxyType({})) -> None:
    """Write a run to a file with additional attributes.

    Raises OutputError if that fails, and leaves an older file unchanged.
    """
    root, *others = tables(run)
    write(
        iter([replace(root, attributes={**root.attributes, **_check_attributes(user_attributes, root)}), *others]), path
    )


def _check_attributes(given: Any, root: Table) -> dict[str, str]:
    """Return checked attributes of the user. Raises BadValueError for names that the format itself uses."""
    found = {}
    for name, value in mapping(given, "attributes", "{name: text}").items():
        if not 0 < len(name) <= LONGEST or not name.isprintable() or name in root.attributes:
            hint = f"expected a name other than {', '.join(root.attributes)}"
            raise BadValueError(f"attributes: {message(name)} is no name for one of your own", hint=hint)
        found[name] = text(value, f"attributes: {name}")
    return found


def read(path: str | os.PathLike[str]) -> Result:
    """Return the result in a file that `save` wrote. Raises InputError for any other file."""
    return open_result_file(path, lambda file, size: _read_result(File(file, size, (FORMAT, OLD_FORMAT))))


def source_of(file: File) -> KernelSource:
    """Return the checked kernel source of a file."""
    source = KernelSource.from_json(file.text("source", "" if file.is_old else COMPILED))
    check_typed(source, KernelSource, "source")
    _check_names(source)
    return source


def _read_result(file: File) -> Result:
    """Return the result of an open file."""
    source = source_of(file)
    run = result_of(file, source, tuple(catalogue(source)))
    run.provenance = read_provenance(file)
    return run


def result_of(file: File, source: KernelSource, names: tuple[str, ...]) -> Result:
    """Return the result of an open file with the named series."""
    diagnostics = Diagnostics.from_json(file.text("diagnostics"))
    check_typed(diagnostics, Diagnostics, "diagnostics")
    t = file.numbers("time")
    if not len(t):
        raise ValueError("it has no sample")
    check_times(t)
    stored = {name: _read_series(file, name, len(t)) for name in names if _has_series(file, name)}
    p, given, is_given = _read_parameters(file, source)
    run = Result(
        compiled=None,
        source=source,
        p=p,
        given=given,
        is_given=is_given,
        t=t,
        **samples_of(source, stored, len(t)),
        impacts=impacts_of(file, source),
        diagnostics=diagnostics,
        events=events_of(file, source),
        stored=stored,
        trace=_read_trace(file, source),
    )
    if file.has(START):
        run.start_row = start_row(file, run)
        check_times(np.append(run.start_row.t, t[0]))
    if file.has(GIVEN_START):
        run.begun = _read_given_start(file, run.final)
    if file.has(STATES):
        run.__dict__["states_at_events"] = states_at_events(file, run)
    _ = run.names, run.parameters, run.constants, run.final  # what these need is there, or it is no result
    check_extremes(diagnostics.extremes, run.names)
    return run


def check_times(t: Array) -> None:
    """Raise ValueError unless sample times are finite and ascend."""
    if not (np.isfinite(t).all() and (np.diff(t) > 0.0).all()):
        raise ValueError("the times of samples do not ascend")


def _check_given(source: KernelSource, p: Array, given: Array, is_given: Array) -> None:
    """Raise ValueError unless given values equal the values of the run."""
    for slot, x, given_value, was_given in zip(
        source.slots, p.tolist(), given.tolist(), is_given.tolist(), strict=False
    ):
        if was_given not in (0, 1) or was_given and not given_value == x:
            raise ValueError(f"{slot.address} is {x!r}, and was given as {given_value!r}")


def check_extremes(extremes: tuple[Extremes, ...], names: Container[str]) -> tuple[Extremes, ...]:
    """Return the extremes. Raises ValueError unless they belong to known series."""
    for one in extremes:
        if one.name not in names or not UNIT.fullmatch(one.unit) or one.against and not NAME.fullmatch(one.against):
            raise ValueError(f"peaks of {one.name[:64]!r} are of no series")
    return extremes


def _check_names(source: KernelSource) -> None:
    """Raise ValueError unless names are identifiers with dots, since they occur in tables, figures and paths."""
    named: list[Any] = [*source.bodies, *source.joints, *source.clearances, *source.drives, *source.events]
    named += source.points
    words = [word for slot in source.slots for word in slot.words]
    units = [slot.unit for slot in source.slots] + [series.unit for series in source.series]
    names = [thing.name for thing in named] + [slot.address for slot in source.slots] + [*source.outputs]
    for name in (source.mechanism, source.scene, *names, *words, *(series.name for series in source.series)):
        if not NAME.fullmatch(name):
            raise ValueError(f"{name[:64]!r} is no name")
    if wrong := [unit for unit in units if not UNIT.fullmatch(unit)]:
        raise ValueError(f"{wrong[0][:64]!r} is no unit")


def _has_series(file: File, name: str) -> bool:
    """Return whether a series is in the file; older files lack the drift."""
    return name not in DRIFT or file.has(name)


def _read_series(file: File, name: str, length: int) -> Array:
    """Return a series of the file, read-only."""
    stored = f"output.{name}" if file.is_old and name in OLD_NAMES else name if file.is_old else variable(name)
    stored = stored if file.has(stored) else name  # an output that is called like a group that older files have not
    values = file.numbers(stored, length, "i1" if name.endswith(".state") else "f8")
    values.flags.writeable = False
    return values


def _read_parameters(file: File, source: KernelSource) -> tuple[Array, Array, Array]:
    """Return p, given and is_given of the file."""
    slots, derived = len(source.slots), len(source.derived)
    if file.is_old:
        p, given = file.numbers("parameters.prepared", slots + derived), file.numbers("parameters.given", slots)
        is_given = file.numbers("parameters.is_given", slots, "i1")
        _check_given(source, p, given, is_given)
        return p, given, is_given.astype(bool)
    values, given = (file.numbers(f"parameters/{name}", slots) if slots else np.zeros(0) for name in ("value", "given"))
    is_given = file.numbers("parameters/is_given", slots, "i1") if slots else np.zeros(0)
    prepared = file.numbers(f"{COMPILED}/value", derived) if derived else np.zeros(0)
    _check_given(source, values, given, is_given)
    return np.concatenate([values, prepared]), given, is_given.astype(bool)


def impacts_of(file: File, source: KernelSource) -> Array:
    """Return the contacts of the file's run, IMPACT_DTYPE."""
    return _read_records(file, "impact", IMPACT_DTYPE, [joint.name for joint in source.clearances])


def events_of(file: File, source: KernelSource) -> Array:
    """Return the events of the file's run, EVENT_DTYPE."""
    return _read_records(file, "event", EVENT_DTYPE, [event.name for event in source.events])


def _read_records(file: File, kind: str, dtype: np.dtype[Any], names: list[str]) -> Array:
    """Return impacts or events from their columns, the first of which names the joint or event; empty without a
    group.
    """
    first, *others = dtype.names or ()
    if not file.has(f"{kind}.{first}" if file.is_old else f"{kind}s"):
        return np.zeros(0, dtype)
    if file.is_old:
        owner = file.numbers(f"{kind}.{first}", None, "i4")
    else:
        index: Mapping[str, int] = {name: k for k, name in enumerate(names)}
        owner = np.array([index[name] for name in file.texts(f"{kind}s/{first}")], "i4")
    if len(owner) and not (owner.min() >= 0 and owner.max() < len(names)):
        raise ValueError(f"the {kind}s are of something that the scene does not have")
    table = np.empty(len(owner), dtype)
    table[first] = owner
    for name in others:
        table[name] = file.numbers(f"{kind}.{name}" if file.is_old else f"{kind}s/{name}", len(owner))
    return table


def _read_trace(file: File, source: KernelSource) -> Trace | None:
    """Return the envelope over the steps; None where the run had none or the file is older."""
    if not file.has(TRACE):
        return None
    t = file.numbers(f"{TRACE}/t")
    names = [[f"{TRACE}/{joint.name}.{name}" for name in TRACE_COLUMNS] for joint in source.clearances]
    joints = [[file.numbers(name, len(t)) for name in row] for row in names]
    return Trace(t, np.moveaxis(np.array(joints).reshape(len(joints), len(TRACE_COLUMNS), len(t)), 2, 0).copy())


def samples_of(source: KernelSource, stored: Mapping[str, Array], length: int) -> dict[str, Any]:
    """Return the arrays that the integrator stores, rebuilt from their series, by their names in a Result."""
    q, v, a = (_read_motion(source, stored, length, order) for order in range(3))
    return {
        "q": q,
        "v": v,
        "accelerations": a,
        "state": _read_columns(stored, [f"{joint.name}.state" for joint in source.clearances], length, np.int8),
        "memory": _read_columns(stored, _memory_names(source), length),
        "work": _read_works(source, stored, length),
    }


def _read_motion(source: KernelSource, stored: Mapping[str, Array], samples: int, order: int) -> Array:
    """Return q, q̇ or q̈ (order 0, 1, 2), (N, n), from the series of the bodies."""
    if sorted(body.index for body in source.bodies) != list(range(0, 3 * len(source.bodies), 3)):
        raise ValueError("the bodies' places in q are not theirs")
    values = np.empty((samples, 3 * len(source.bodies)))
    for body in source.bodies:
        for axis, names in enumerate(MOTION):
            values[:, body.index + axis] = stored[f"{body.name}.{names[order]}"]
    return values


def _read_columns(stored: Mapping[str, Array], names: list[str], samples: int, dtype: Any = float) -> Array:
    """Return the named series as the columns of an array; 0 for an empty name."""
    values = np.empty((samples, len(names)), dtype)
    for column, name in enumerate(names):
        values[:, column] = stored[name] if name else 0.0  # a place that no law's state has
    return values


def _read_works(source: KernelSource, stored: Mapping[str, Array], samples: int) -> Array:
    """Return the works (N, 3); NaN without masses."""
    if source.massless:
        return np.full((samples, 3), np.nan)
    return _read_columns(stored, ["work.drives", "work.forces", "work.clearances"], samples)


def _memory_names(source: KernelSource) -> list[str]:
    """Return the names of the series that contain the discrete states and friction states of a scene."""
    latches = [f"{joint.name}.deltadot_minus" for joint in source.clearances]
    return [*latches, *(f"{f}.mode" for f in source.frictions), *source.states]


def states_at_events(file: File, run: Result) -> Result:
    """Return the result whose samples are the start of the run and then its events."""
    stored, count, first = {}, len(run.events), run.start_row or run
    for name in run.stored:
        at = file.numbers(f"{STATES}/{at_event(name)}", count, "i1" if name.endswith(".state") else "f8")
        stored[name] = np.concatenate([first.stored[name][:1], at])
        stored[name].flags.writeable = False
    t, rows = np.concatenate([first.t[:1], run.events["t"]]), samples_of(run.source, stored, 1 + count)
    return replace(run, t=t, **rows, trace=None, stored=stored, start_row=None)


def start_row(file: File, run: Result) -> Result:
    """Return the start of a run whose samples begin later."""
    t = file.numbers(f"{START}/time", 1)
    own = {name: (f"{START}/{variable(name)}", values.dtype.str) for name, values in run.stored.items()}
    stored = {name: file.numbers(at, 1, dtype) for name, (at, dtype) in own.items()}
    for values in stored.values():
        values.flags.writeable = False
    return replace(run, t=t, **samples_of(run.source, stored, 1), trace=None, stored=stored)


def _read_given_start(file: File, final: State) -> State:
    """Return the state that a run was given as `start`, of the scene of its final state."""
    ends = np.cumsum([1, len(final.q), len(final.v), len(final.state), len(final.memory)])
    t, q, v, state, memory = np.split(file.numbers(f"{GIVEN_START}/value", int(ends[-1])), ends[:-1])
    return replace(final, t=float(t[0]), q=q, v=v, state=state.astype(np.int8), memory=memory)


def read_provenance(file: File) -> dict[str, str]:
    """Return the provenance in a file; empty for an older file, in which an output may have the group's name."""
    try:
        return {name: file.text(name, PROVENANCE_GROUP) for name in PROVENANCE}
    except (KeyError, ValueError):
        return {}

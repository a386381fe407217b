"""Write and read results as NetCDF 4 files, and convert them to xarray Datasets.

A file contains every series over `time`, so any NetCDF tool can read it, and groups with other tables. `compiled` has
the kernel source, from which gudgeon restores the result bit for bit without a compiled library.
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
from gudgeon.integrators.trajectory import EVENT_DTYPE, IMPACT_DTYPE, TRACE_COLUMNS, TRACED, Envelope
from gudgeon.language.argument_checks import check_mapping, check_text, shorten_value
from gudgeon.model.choices import format_parameter
from gudgeon.results.diagnostics import PROVENANCE, Diagnostics, Extremes
from gudgeon.results.files.hdf5 import Table, Variable, write_tables
from gudgeon.results.files.untrusted import OLD_FORMAT, File, check_type, open_result_file
from gudgeon.results.results import Array, Result
from gudgeon.results.series import DRIFT, MOTION, get_catalogue
from gudgeon.results.state import State

if TYPE_CHECKING:
    import xarray

FORMAT = "gudgeon-result/2"
MAX_ATTRIBUTE_NAME = 200  # characters
SERIES, ENVELOPE, EVENT_STATES, COMPILED, PEAKS = "series", "trace", "at_events", "compiled", "peaks"
START = "start_row"  # series at the start of a run, where that is not a sample
GIVEN_START = "given_start"  # the state that a run was given as `start`
PARTS = ("impacts", "events", EVENT_STATES, "parameters", ENVELOPE, PEAKS)
IMPACTS = {
    "joint": ("", "joint with play"),
    "t_on": ("s", "onset of the contact"),
    "t_off": ("s", "separation, NaN: still closed; of an impact of rigid surfaces its onset"),
    "deltadot": ("m/s", "rate of the penetration at the onset"),
    "F_peak": ("N", "largest force of the contact; of an impact of rigid surfaces its impulse, N s"),
    "t_peak": ("s", "time of the largest force"),
}
EVENTS = {"event": ("", "event of the mechanism's file"), "t": ("s", "time of the event")}
PROVENANCE_GROUP = "provenance"
ENVELOPE_TIME = ("s", "end of the last step of the row")
EXTREMES = {
    "name": ("", "series"),
    "against": ("", "scene whose series was subtracted"),
    "unit": ("", "unit of the values"),
    "max": ("", "largest value over all steps, SI"),
    "t_max": ("s", "its time"),
    "min": ("", "smallest value over all steps, SI"),
    "t_min": ("s", "its time"),
}
OLD_NAMES = ("time", "impact", "event", "slot", "prepared")  # dimensions at the root of a file in OLD_FORMAT
NAME, UNIT = re.compile(r"[A-Za-z][\w.]*", re.ASCII), re.compile(r"[\w^*/. ()-]*", re.ASCII)


def build_tables(run: Result) -> Iterator[Table]:
    """Yield all tables of the file of a run, also empty ones: series over `time` at its root, then groups."""
    yield Table("", "time", tuple(_iterate_series_variables(run)), build_attributes(run))
    yield Table(START, "time", () if run.start_row is None else tuple(_iterate_series_variables(run.start_row)), {})
    yield Table(GIVEN_START, "row", tuple(_iterate_start_variables(run)), {})
    joints = [joint.name for joint in run.source.clearances]
    yield Table("impacts", "impact", tuple(build_record_variables(run.impacts, IMPACTS, joints)), {})
    events = [event.name for event in run.source.events]
    yield Table("events", "occurrence", tuple(build_record_variables(run.events, EVENTS, events)), {})
    yield Table(EVENT_STATES, "occurrence", tuple(_iterate_event_variables(run, events)), {})
    yield Table("parameters", "address", tuple(_iterate_parameter_variables(run)), {})
    yield Table(ENVELOPE, "t", tuple(_iterate_envelope_variables(run)), {})
    yield Table(PEAKS, "row", tuple(_iterate_peak_variables(run)), {})
    derived = Variable("value", run.p[len(run.given) :], "", "value derived from the parameters, SI")
    yield Table(COMPILED, "derived", (derived,), {"source": run.source.to_json()})
    yield Table(PROVENANCE_GROUP, "", (), run.provenance)


def _iterate_series_variables(run: Result) -> Iterator[Variable]:
    """Yield the time and every series of a run as variables; without the drift if an older file lacks it."""
    yield Variable("time", run.t, "s", "time")
    missing_names = () if run.compiled or DRIFT[0] in run.stored else DRIFT  # read from a file that lacks it
    for name, unit in run.names.items():
        if name in missing_names:
            continue
        yield Variable(name_variable(name), run[name], unit, run.meaning(name))


def _iterate_start_variables(run: Result) -> Iterator[Variable]:
    """Yield the given `start` of a run as one column: t, q, v, contact codes, discrete states; nothing without one."""
    if (start := run.given_start) is not None:
        fields = ([start.t], start.q, start.v, start.state, start.memory)
        values = np.concatenate([np.asarray(values_of_field, dtype=np.float64) for values_of_field in fields])
        yield Variable("value", values, "", "time, coordinates, velocities, contact codes, memory, SI")


def _iterate_event_variables(run: Result, events: list[str]) -> Iterator[Variable]:
    """Yield the columns of events and every series at the events; `events` are the names of the scene's events.

    Yields nothing without events, or if the states at the events cannot be evaluated.
    """
    try:
        states = run.states_at_events if len(run.events) else None
        names = [name for name in run.names if states is not None and (states.compiled or name in states.stored)]
        values_by_name = {name: states[name][1:] for name in names} if states is not None else {}
    except GudgeonError:  # an older file, or no states can be computed at the events: the samples are complete
        return
    if values_by_name:
        yield from list(build_record_variables(run.events, EVENTS, events))
    for name, values in values_by_name.items():
        yield Variable(name_event_column(name), values, run.unit(name), run.meaning(name))


def name_event_column(name: str) -> str:
    """Return the column name of a series in the table of events: the name itself, or "output.NAME" if it is used."""
    return f"output.{name}" if name in (*EVENTS, "occurrence") else name


def build_record_variables(table: Array, columns: dict[str, tuple[str, str]], names: list[str]) -> Iterator[Variable]:
    """Yield the columns of a table of impacts or events as variables; `columns` has (unit, meaning) of each by name.

    The first column contains indices of joints or events, which are replaced by the `names`.
    """
    for k, (name, (unit, meaning)) in enumerate(columns.items()):
        yield Variable(
            name,
            _convert_to_text_array([names[index] for index in table[name]]) if k == 0 else table[name],
            unit,
            meaning,
        )


def _iterate_parameter_variables(run: Result) -> Iterator[Variable]:
    """Yield the columns of the table of run-time parameters: address, value, unit, given value, name of a choice."""
    parameters = run.source.parameters
    addresses = [parameter.address for parameter in parameters]
    yield Variable("address", _convert_to_text_array(addresses), "", "address in the mechanism's file")
    yield Variable("value", run.p[: len(parameters)], "", "value in this run, SI")
    yield Variable("unit", _convert_to_text_array([parameter.unit for parameter in parameters]), "", "of the value")
    yield Variable("given", run.given, "", "overridden value, SI")
    yield Variable("is_given", run.is_given.astype(np.int8), "", "1 where it was overridden")
    if any(parameter.words for parameter in parameters):
        choice_names = [
            str(format_parameter(parameter, float(value))) if parameter.words else ""
            for parameter, value in zip(parameters, run.p, strict=False)
        ]
        yield Variable("name", _convert_to_text_array(choice_names), "", "name of the choice if the value is its index")


def _convert_to_text_array(values: list[str]) -> Array:
    """Return texts as a NumPy array of dtype object, as h5py needs them."""
    return np.array(values, dtype=object)


def _iterate_envelope_variables(run: Result) -> Iterator[Variable]:
    """Yield times, extreme forces and positions of journals of the envelope over the steps; nothing without an
    envelope.
    """
    if run.trace is None:
        return
    yield Variable("t", run.trace.t, *ENVELOPE_TIME)
    for k, joint in enumerate(run.source.clearances):
        for column, (name, (unit, meaning)) in enumerate(TRACED.items()):
            yield Variable(f"{joint.name}.{name}", run.trace.joints[:, k, column], unit, meaning)


def _iterate_peak_variables(run: Result) -> Iterator[Variable]:
    """Yield the columns of peaks over all steps, for readers of the file; `diagnostics` restores them."""
    for name, (unit, meaning) in EXTREMES.items():
        values = [getattr(extremes, name) for extremes in run.diagnostics.extremes]
        yield Variable(
            name,
            _convert_to_text_array(values) if name in ("name", "against", "unit") else np.array(values),
            unit,
            meaning,
        )


def build_attributes(run: Result) -> dict[str, str]:
    """Return the attributes of the whole file: format, title, mechanism, scene, and the diagnostics as JSON."""
    return {
        "gudgeon": FORMAT,
        "title": run.source.title,
        "mechanism": run.source.mechanism,
        "scene": run.source.scene,
        "diagnostics": run.diagnostics.to_json(),
    }


def name_variable(name: str) -> str:
    """Return the name of a series in the file; an output named like a group or "time" becomes "output.NAME"."""
    return f"output.{name}" if name in ("time", *PARTS, START, GIVEN_START, COMPILED, PROVENANCE_GROUP) else name


def import_xarray() -> Any:
    """Return the module xarray. Raises GudgeonError if it is not installed."""
    try:
        import xarray
    except ModuleNotFoundError as error:
        raise GudgeonError("Datasets need xarray: pip install 'gudgeon[xarray]'") from error
    return xarray


def build_dataset(run: Result, part: str = SERIES) -> xarray.Dataset:
    """Return a table of a run as an xarray Dataset: "series" or one of PARTS. Raises UnknownNameError, GudgeonError."""
    xarray = import_xarray()
    part = check_text(part, "part", "the name of a table")
    group = "" if part == SERIES else part
    if part not in (SERIES, *PARTS):
        from gudgeon.errors import UnknownNameError

        raise UnknownNameError(f"a result has no part {part!r}", hint=f"there are: {', '.join((SERIES, *PARTS))}")
    table = next(table for table in build_tables(run) if table.group == group)
    variables: dict[str, Any] = {item.name: (table.dimension, item.values, item.attributes) for item in table.variables}
    return xarray.Dataset(variables, attrs=dict(table.attributes))


def save(run: Result, path: str | os.PathLike[str], user_attributes: Mapping[str, str] = MappingProxyType({})) -> None:
    """Write a run to a NetCDF file, with `user_attributes` {name: text} in addition to its own. Raises OutputError if
    that fails, and leaves an older file unchanged; BadValueError for invalid attributes.
    """
    root, *others = build_tables(run)
    write_tables(
        iter([replace(root, attributes={**root.attributes, **_check_attributes(user_attributes, root)}), *others]), path
    )


def _check_attributes(user_attributes: Any, root: Table) -> dict[str, str]:
    """Return the user's attributes; raise BadValueError for a value that is not a text, and for an invalid name."""
    checked = {}
    for name, value in check_mapping(user_attributes, "attributes", "{name: text}").items():
        if not 0 < len(name) <= MAX_ATTRIBUTE_NAME or not name.isprintable() or name in root.attributes:
            hint = f"expected a name other than {', '.join(root.attributes)}"
            raise BadValueError(f"attributes: {shorten_value(name)} is not a valid name", hint=hint)
        checked[name] = check_text(value, f"attributes: {name}")
    return checked


def read(path: str | os.PathLike[str]) -> Result:
    """Return the result in a file that `save` wrote. Raises InputError for any other file."""
    return open_result_file(path, lambda file, size: _read_result(File(file, size, (FORMAT, OLD_FORMAT))))


def read_source(file: File) -> KernelSource:
    """Return the kernel source of a file. Raises ValueError or TypeError for wrong types and names."""
    source = KernelSource.from_json(file.read_text_attribute("source", "" if file.is_old else COMPILED))
    check_type(source, KernelSource, "source")
    _check_names_and_units(source)
    return source


def _read_result(file: File) -> Result:
    """Return the result of an open file."""
    source = read_source(file)
    run = read_result(file, source, tuple(get_catalogue(source)))
    run.provenance = read_provenance(file)
    return run


def read_result(file: File, source: KernelSource, series_names: tuple[str, ...]) -> Result:
    """Return the checked result of an open file. Raises ValueError, TypeError or KeyError for an invalid file."""
    diagnostics = Diagnostics.from_json(file.read_text_attribute("diagnostics"))
    check_type(diagnostics, Diagnostics, "diagnostics")
    t = file.read_array("time")
    if not len(t):
        raise ValueError("it has no samples")
    check_times(t)
    stored = {name: _read_series(file, name, len(t)) for name in series_names if _has_series(file, name)}
    p, given, is_given = _read_parameters(file, source)
    run = Result(
        compiled=None,
        source=source,
        p=p,
        given=given,
        is_given=is_given,
        t=t,
        **rebuild_samples(source, stored, len(t)),
        impacts=read_impacts(file, source),
        diagnostics=diagnostics,
        events=read_events(file, source),
        stored=stored,
        trace=_read_envelope(file, source),
    )
    if file.has_entry(START):
        run.start_row = read_start_row(file, run)
        check_times(np.append(run.start_row.t, t[0]))
    if file.has_entry(GIVEN_START):
        run.given_start = _read_given_start(file, run.final)
    if file.has_entry(EVENT_STATES):
        run.__dict__["states_at_events"] = read_states_at_events(file, run)
    _ = run.names, run.parameters, run.constants, run.final  # raise an error if the file lacks their data
    check_extremes(diagnostics.extremes, run.names)
    return run


def check_times(t: Array) -> None:
    """Raise ValueError unless sample times are finite and strictly ascending."""
    if not (np.isfinite(t).all() and (np.diff(t) > 0.0).all()):
        raise ValueError("the times of samples do not ascend")


def _check_given_values(source: KernelSource, p: Array, given_values: Array, is_given: Array) -> None:
    """Raise ValueError unless overridden values equal the values of the run, and flags are 0 or 1."""
    for parameter, value, overriding_value, was_overridden in zip(
        source.parameters, p.tolist(), given_values.tolist(), is_given.tolist(), strict=False
    ):
        if was_overridden not in (0, 1) or was_overridden and not overriding_value == value:
            raise ValueError(f"{parameter.address} is {value!r}, but was given as {overriding_value!r}")


def check_extremes(extremes: tuple[Extremes, ...], names: Container[str]) -> tuple[Extremes, ...]:
    """Return the extremes unchanged. Raises ValueError unless they belong to series in `names` and have valid units."""
    for series_extremes in extremes:
        if (
            series_extremes.name not in names
            or not UNIT.fullmatch(series_extremes.unit)
            or series_extremes.against
            and not NAME.fullmatch(series_extremes.against)
        ):
            raise ValueError(f"peaks of {series_extremes.name[:64]!r}: the scene has no such series")
    return extremes


def _check_names_and_units(source: KernelSource) -> None:
    """Raise ValueError unless all names of a source are identifiers with dots and all units are valid."""
    components: list[Any] = [*source.bodies, *source.joints, *source.clearances, *source.drives, *source.events]
    components += source.points
    choices = [choice for slot in source.parameters for choice in slot.words]
    units = [slot.unit for slot in source.parameters] + [series.unit for series in source.series]
    names = (
        [component.name for component in components] + [slot.address for slot in source.parameters] + [*source.outputs]
    )
    for name in (source.mechanism, source.scene, *names, *choices, *(series.name for series in source.series)):
        if not NAME.fullmatch(name):
            raise ValueError(f"{name[:64]!r} is not a valid name")
    if invalid_units := [unit for unit in units if not UNIT.fullmatch(unit)]:
        raise ValueError(f"{invalid_units[0][:64]!r} is not a unit")


def _has_series(file: File, name: str) -> bool:
    """Return whether a series is to be read: always, except the drift if an older file lacks it."""
    return name not in DRIFT or file.has_entry(name)


def _read_series(file: File, name: str, n_samples: int) -> Array:
    """Return a series of the file, read-only, with `n_samples` values; contact states are int8."""
    stored_name = (
        f"output.{name}" if file.is_old and name in OLD_NAMES else name if file.is_old else name_variable(name)
    )
    # the plain name, for an output named like a group that older versions did not write
    stored_name = stored_name if file.has_entry(stored_name) else name
    values = file.read_array(stored_name, n_samples, "i1" if name.endswith(".state") else "f8")
    values.flags.writeable = False
    return values


def _read_parameters(file: File, source: KernelSource) -> tuple[Array, Array, Array]:
    """Return p with derived parameters, given and is_given. Raises ValueError if a given value differs from p."""
    n_parameters, n_derived = len(source.parameters), len(source.derived)
    if file.is_old:
        p = file.read_array("parameters.prepared", n_parameters + n_derived)
        given = file.read_array("parameters.given", n_parameters)
        is_given = file.read_array("parameters.is_given", n_parameters, "i1")
        _check_given_values(source, p, given, is_given)
        return p, given, is_given.astype(bool)
    values, given = (
        file.read_array(f"parameters/{name}", n_parameters) if n_parameters else np.zeros(0)
        for name in ("value", "given")
    )
    is_given = file.read_array("parameters/is_given", n_parameters, "i1") if n_parameters else np.zeros(0)
    derived_values = file.read_array(f"{COMPILED}/value", n_derived) if n_derived else np.zeros(0)
    _check_given_values(source, values, given, is_given)
    return np.concatenate([values, derived_values]), given, is_given.astype(bool)


def read_impacts(file: File, source: KernelSource) -> Array:
    """Return the contacts of the file's run, IMPACT_DTYPE."""
    return _read_records(file, "impact", IMPACT_DTYPE, [joint.name for joint in source.clearances])


def read_events(file: File, source: KernelSource) -> Array:
    """Return the events of the file's run, EVENT_DTYPE."""
    return _read_records(file, "event", EVENT_DTYPE, [event.name for event in source.events])


def _read_records(file: File, kind: str, dtype: np.dtype[Any], names: list[str]) -> Array:
    """Return impacts or events as an array of `dtype`; empty without a group. Raises ValueError for unknown names."""
    owner_column, *other_columns = dtype.names or ()
    if not file.has_entry(f"{kind}.{owner_column}" if file.is_old else f"{kind}s"):
        return np.zeros(0, dtype)
    if file.is_old:  # files of the old format store the indices in `names`, others store names
        owner_indices = file.read_array(f"{kind}.{owner_column}", None, "i4")
    else:
        index: Mapping[str, int] = {name: k for k, name in enumerate(names)}
        owner_indices = np.array([index.get(name, -1) for name in file.read_texts(f"{kind}s/{owner_column}")], "i4")
    if len(owner_indices) and not (owner_indices.min() >= 0 and owner_indices.max() < len(names)):
        raise ValueError(f"the {kind}s refer to a name that the scene does not have")
    table = np.empty(len(owner_indices), dtype)
    table[owner_column] = owner_indices
    for name in other_columns:
        table[name] = file.read_array(f"{kind}.{name}" if file.is_old else f"{kind}s/{name}", len(owner_indices))
    return table


def _read_envelope(file: File, source: KernelSource) -> Envelope | None:
    """Return the envelope over the steps, TRACE_COLUMNS of each joint with play; None without one or in older files."""
    if not file.has_entry(ENVELOPE):
        return None
    t = file.read_array(f"{ENVELOPE}/t")
    names = [[f"{ENVELOPE}/{joint.name}.{name}" for name in TRACE_COLUMNS] for joint in source.clearances]
    columns = [[file.read_array(name, len(t)) for name in joint_columns] for joint_columns in names]
    return Envelope(t, np.moveaxis(np.array(columns).reshape(len(columns), len(TRACE_COLUMNS), len(t)), 2, 0).copy())


def rebuild_samples(source: KernelSource, stored_series: Mapping[str, Array], n_samples: int) -> dict[str, Any]:
    """Return q, v, accelerations, state (contact codes), memory (discrete states), work of a Result by name."""
    q, v, a = (_read_motion(source, stored_series, n_samples, order) for order in range(3))
    return {
        "q": q,
        "v": v,
        "accelerations": a,
        "state": _read_columns(
            stored_series, [f"{joint.name}.state" for joint in source.clearances], n_samples, np.int8
        ),
        "memory": _read_columns(stored_series, _list_discrete_state_series(source), n_samples),
        "work": _read_works(source, stored_series, n_samples),
    }


def _read_motion(source: KernelSource, stored_series: Mapping[str, Array], n_samples: int, order: int) -> Array:
    """Return q, q̇ or q̈ (order 0, 1, 2), (N, n), from series of bodies. Raises ValueError for wrong indices."""
    if sorted(body.index for body in source.bodies) != list(range(0, 3 * len(source.bodies), 3)):
        raise ValueError("the bodies have wrong indices in q")
    values = np.empty((n_samples, 3 * len(source.bodies)))
    for body in source.bodies:
        for axis, names in enumerate(MOTION):
            values[:, body.index + axis] = stored_series[f"{body.name}.{names[order]}"]
    return values


def _read_columns(stored_series: Mapping[str, Array], names: list[str], n_samples: int, dtype: Any = float) -> Array:
    """Return the named series as the columns of an array (N, k); the column of an empty name is 0."""
    values = np.empty((n_samples, len(names)), dtype)
    for column, name in enumerate(names):
        values[:, column] = stored_series[name] if name else 0.0  # an unnamed state
    return values


def _read_works(source: KernelSource, stored_series: Mapping[str, Array], n_samples: int) -> Array:
    """Return the works of drives, forces and joints with play, (N, 3); NaN for a scene without masses."""
    if source.massless_bodies:
        return np.full((n_samples, 3), np.nan)
    return _read_columns(stored_series, ["work.drives", "work.forces", "work.clearances"], n_samples)


def _list_discrete_state_series(source: KernelSource) -> list[str]:
    """Return the names of the series of the discrete states, in the order of Result.memory; "" for unnamed ones."""
    approach_speeds = [f"{joint.name}.deltadot_minus" for joint in source.clearances]
    return [*approach_speeds, *(f"{friction}.mode" for friction in source.frictions), *source.internal_states]


def read_states_at_events(file: File, run: Result) -> Result:
    """Return the result whose samples are the start of the run and then its events, read from the file."""
    stored, count, start_row = {}, len(run.events), run.start_row or run
    for name in run.stored:
        values = file.read_array(
            f"{EVENT_STATES}/{name_event_column(name)}", count, "i1" if name.endswith(".state") else "f8"
        )
        stored[name] = np.concatenate([start_row.stored[name][:1], values])
        stored[name].flags.writeable = False
    t, arrays = np.concatenate([start_row.t[:1], run.events["t"]]), rebuild_samples(run.source, stored, 1 + count)
    return replace(run, t=t, **arrays, trace=None, stored=stored, start_row=None)


def read_start_row(file: File, run: Result) -> Result:
    """Return the start of a run whose samples begin later: a result of one sample, read from the file."""
    t = file.read_array(f"{START}/time", 1)
    datasets = {name: (f"{START}/{name_variable(name)}", values.dtype.str) for name, values in run.stored.items()}
    stored = {name: file.read_array(dataset_name, 1, dtype) for name, (dataset_name, dtype) in datasets.items()}
    for values in stored.values():
        values.flags.writeable = False
    return replace(run, t=t, **rebuild_samples(run.source, stored, 1), trace=None, stored=stored)


def _read_given_start(file: File, final_state: State) -> State:
    """Return the state that a run was given as `start`; identity and parameters are those of its final state."""
    offsets = np.cumsum([1, len(final_state.q), len(final_state.v), len(final_state.state), len(final_state.memory)])
    t, *motion, state, memory = np.split(file.read_array(f"{GIVEN_START}/value", int(offsets[-1])), offsets[:-1])
    return replace(final_state, t=float(t[0]), q=motion[0], v=motion[1], state=state.astype(np.int8), memory=memory)


def read_provenance(file: File) -> dict[str, str]:
    """Return the provenance in a file by the keys of PROVENANCE; empty for an older file."""
    try:
        return {name: file.read_text_attribute(name, PROVENANCE_GROUP) for name in PROVENANCE}
    except (KeyError, ValueError):
        return {}

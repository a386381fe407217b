"""Results as NetCDF 4 files, and as xarray's Datasets.

A file holds every series under its own name, so that any NetCDF tool can read it, and as attributes the
kernel source and the diagnostics, so that gudgeon reads all of it back bit for bit without a compiled
library. It holds no date: the same run gives the same bytes.

NetCDF 4 is HDF5 with dimension scales. Files are written with h5py itself: through xarray and h5netcdf the
same file takes ten times as long (4 ms for each of some 350 series).
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon import trace
from gudgeon.diagnostics import Diagnostics
from gudgeon.errors import GudgeonError, InputError
from gudgeon.integrators.trajectory import EVENT_DTYPE
from gudgeon.kernel_source import KernelSource
from gudgeon.results import IMPACT_DTYPE, Array, Result
from gudgeon.series import MOTION

if TYPE_CHECKING:
    import xarray

FORMAT = "gudgeon-result/1"
TRACE = "trace"
DIMENSIONS = ("time", "impact", "event", "slot", "prepared")
IMPACTS = {
    "joint": ("", "index of the joint with play"),
    "t_on": ("s", "onset of the contact"),
    "t_off": ("s", "separation, NaN: still closed"),
    "deltadot": ("m/s", "rate of the penetration at the onset"),
    "F_peak": ("N", "largest force of the contact"),
    "t_peak": ("s", "time of the largest force"),
}
EVENTS = {"event": ("", "index of the event"), "t": ("s", "time of the event")}
NUMBERS = {
    "parameters.prepared": ("prepared", "slots, then what was derived from them, SI"),
    "parameters.given": ("slot", "overridden slots, SI"),
    "parameters.is_given": ("slot", "1 where a slot was overridden"),
}
# what a dimension without a coordinate variable is called in the file: NetCDF's own words
NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable.%10d"


@dataclass(frozen=True)
class Variable:
    """One array of a file; it has one dimension."""

    name: str
    dimension: str
    values: Array
    unit: str
    meaning: str

    @property
    def attributes(self) -> dict[str, str]:
        return {"units": self.unit or "1", "long_name": self.meaning}


def variables(run: Result) -> Iterator[Variable]:
    """All series of a run over `time`, impacts over `impact`, events over `event`, run-time numbers over `slot`."""
    yield Variable("time", "time", run.t, "s", "time")
    for name, unit in run.names.items():
        yield Variable(_variable(name), "time", run[name], unit, run.meaning(name))
    for name, (unit, meaning) in IMPACTS.items():
        yield Variable(f"impact.{name}", "impact", run.impacts[name], unit, meaning)
    for name, (unit, meaning) in EVENTS.items():
        yield Variable(f"event.{name}", "event", run.events[name], unit, meaning)
    for name, values in zip(NUMBERS, (run.p, run.given, run.is_given.astype(np.int8)), strict=True):
        yield Variable(name, NUMBERS[name][0], values, "", NUMBERS[name][1])


def attributes(run: Result) -> dict[str, str]:
    """Of the whole file."""
    return {
        "gudgeon": FORMAT,
        "title": run.source.title,
        "mechanism": run.source.mechanism,
        "scene": run.source.scene,
        "joints_with_play": " ".join(joint.name for joint in run.source.clearances),
        "events": " ".join(event.name for event in run.source.events),
        "diagnostics": run.diagnostics.to_json(),
        "source": run.source.to_json(),
    }


def dataset(run: Result) -> xarray.Dataset:
    """The same as an xarray Dataset."""
    try:
        import xarray
    except ModuleNotFoundError as error:
        raise GudgeonError("Datasets need xarray: pip install 'gudgeon[xarray]'") from error
    found = {v.name: xarray.Variable(v.dimension, v.values, v.attributes) for v in variables(run)}
    return xarray.Dataset(found, attrs=attributes(run))


def save(run: Result, path: str | os.PathLike[str]) -> None:
    """Write `run` to `path`; a run that is killed while writing leaves an older file as it was."""
    h5py = _h5py()
    path = Path(path)
    aside = path.with_name(f".{path.name}.{os.getpid()}.{threading.get_ident()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with h5py.File(aside, "w", track_order=True) as file:
            _write(file, run)
        os.replace(aside, path)
    except OSError as error:
        raise GudgeonError(f"cannot write {path}: {error.strerror or error}") from error
    finally:
        with suppress(OSError):
            aside.unlink()


def _write(file: Any, run: Result) -> None:
    """Dimensions first, then everything over them."""
    sizes = {
        "time": len(run.t), "impact": len(run.impacts), "event": len(run.events), "slot": len(run.given),
        "prepared": len(run.p),
    }  # fmt: skip
    for index, name in enumerate(DIMENSIONS):
        is_time = name == "time"
        scale = file.create_dataset(name, data=run.t if is_time else np.zeros(sizes[name], ">f4"))
        scale.make_scale(name if is_time else NO_VARIABLE % sizes[name])
        scale.attrs["_Netcdf4Dimid"] = np.int32(index)
    for variable in variables(run):
        if variable.name != "time":
            stored = file.create_dataset(variable.name, data=np.ascontiguousarray(variable.values))
            stored.dims[0].attach_scale(file[variable.dimension])
        for key, text in variable.attributes.items():
            file[variable.name].attrs[key] = text
    for key, text in attributes(run).items():
        file.attrs[key] = text
    _write_trace(file, run)


def _write_trace(file: Any, run: Result) -> None:
    """In a group of its own, over its own rows: no series has their times."""
    for name, (values, unit, meaning) in trace.variables(run).items():
        stored = file.require_group(TRACE).create_dataset(name, data=np.ascontiguousarray(values))
        if name == "t":
            stored.make_scale(name)
        else:
            stored.dims[0].attach_scale(file[TRACE]["t"])
        stored.attrs["units"], stored.attrs["long_name"] = unit, meaning


def read(path: str | os.PathLike[str]) -> Result:
    """The result in a file that `save` wrote; InputError for a missing file or one that is not a result."""
    h5py = _h5py()
    if not Path(path).is_file():
        raise InputError(f"there is no file {os.fspath(path)}")
    try:
        with h5py.File(path, "r") as file:
            found = file.attrs.get("gudgeon")
            if found != FORMAT:
                hint = f"expected the attribute gudgeon = {FORMAT!r}, found {found!r}"
                raise InputError(f"{os.fspath(path)} holds no result of gudgeon", hint=hint)
            data = {name: item[...] for name, item in file.items() if name != TRACE}
            return _result(data, dict(file.attrs), {name: item[...] for name, item in file.get(TRACE, {}).items()})
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise InputError(f"{os.fspath(path)} cannot be read as a result: {error}") from error


def _h5py() -> Any:
    try:
        import h5py
    except ModuleNotFoundError as error:
        raise GudgeonError("NetCDF files need h5py: pip install 'gudgeon[xarray]'") from error
    return h5py


def _result(data: dict[str, Array], attributes: dict[str, str], traced: dict[str, Array]) -> Result:
    source = KernelSource.from_json(attributes["source"])
    t = data.pop("time")
    apart = {*DIMENSIONS, *NUMBERS, *(f"impact.{name}" for name in IMPACTS), *(f"event.{name}" for name in EVENTS)}
    stored = {name.removeprefix("output."): _read_only(data[name]) for name in data if name not in apart}
    impacts, events = _table(data, "impact", IMPACT_DTYPE), _table(data, "event", EVENT_DTYPE)
    q, v, a = (_motion(source, stored, len(t), order) for order in range(3))
    return Result(
        compiled=None,
        source=source,
        p=data["parameters.prepared"],
        given=data["parameters.given"],
        is_given=data["parameters.is_given"].astype(bool),
        t=t,
        q=q,
        v=v,
        a=a,
        state=_columns(stored, [f"{joint.name}.state" for joint in source.clearances], len(t), np.int8),
        memory=_columns(stored, _memory_names(source), len(t)),
        work=_columns(stored, ["work.drives", "work.forces", "work.clearances"], len(t)),
        impacts=impacts,
        diagnostics=Diagnostics.from_json(attributes["diagnostics"]),
        events=events,
        stored=stored,
        trace=trace.from_variables(source, traced),
    )


def _table(data: dict[str, Array], what: str, dtype: np.dtype[Any]) -> Array:
    """Impacts or events from their variables; none, where an older file has none."""
    columns = {name: data.get(f"{what}.{name}", np.zeros(0)) for name in dtype.names or ()}
    table = np.empty(len(next(iter(columns.values()))), dtype)
    for name, values in columns.items():
        table[name] = values
    return table


def _motion(source: KernelSource, stored: dict[str, Array], samples: int, order: int) -> Array:
    """q, q̇ or q̈ (order 0, 1, 2) from the bodies' series."""
    values = np.empty((samples, 3 * len(source.bodies)))
    for body in source.bodies:
        for axis, names in enumerate(MOTION):
            values[:, body.index + axis] = stored[f"{body.name}.{names[order]}"]
    return values


def _columns(stored: dict[str, Array], names: list[str], samples: int, dtype: Any = float) -> Array:
    values = np.empty((samples, len(names)), dtype)
    for column, name in enumerate(names):
        values[:, column] = stored[name]
    return values


def _variable(name: str) -> str:
    """An output may be called like a dimension; no other name can, for they all have a dot."""
    return f"output.{name}" if name in DIMENSIONS else name


def _read_only(values: Array) -> Array:
    values.flags.writeable = False
    return values


def _memory_names(source: KernelSource) -> list[str]:
    """The series that hold what the right-hand side remembers."""
    return [f"{joint.name}.deltadot_minus" for joint in source.clearances] + [f"{f}.mode" for f in source.frictions]

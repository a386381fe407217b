"""Results from NetCDF files that anybody may have written, damaged or cut short: a whole Result, or an InputError.

Nothing in a file is believed: that a seal holds, types, lengths and names are looked at before anything is read, links
out of the file are not followed, and no more is read than the file can hold. Files of gudgeon-result/1 are read too.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Container, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError, InputError, in_a_line
from gudgeon.files.reading import check_regular
from gudgeon.integrators.trace import COLUMNS, Trace
from gudgeon.integrators.trajectory import EVENT_DTYPE, IMPACT_DTYPE
from gudgeon.language.wanted import path as named
from gudgeon.results.diagnostics import Diagnostics, Extremes
from gudgeon.results.files.hdf5 import is_damaged
from gudgeon.results.files.netcdf import COMPILED, FORMAT, START, STATES, TRACE, variable
from gudgeon.results.files.netcdf_samples import samples_of, start_row, states_at_events
from gudgeon.results.files.typed import check_typed
from gudgeon.results.provenance import read_provenance
from gudgeon.results.results import Array, Result
from gudgeon.results.series import DRIFT, catalogue

OLD_FORMAT = "gudgeon-result/1"  # impacts, events and parameters beside the series, over dimensions of their own
OLD_NAMES = ("time", "impact", "event", "slot", "prepared")
NAME, UNIT = re.compile(r"[A-Za-z][\w.]*", re.ASCII), re.compile(r"[\w^*/. ()-]*", re.ASCII)
DEFLATE = 1100  # no filter of HDF5's own makes data this many times smaller
LOADERS = {"gudgeon-result": ("a single run", "gudgeon.Result.load"),
           "gudgeon-batch": ("a batch of runs", "gudgeon.Batch.load")}  # fmt: skip
Made = TypeVar("Made")
AGAIN = "it is no result of gudgeon, or was damaged or cut short; run the scene again"


def read(path: str | os.PathLike[str]) -> Result:
    """The result in a file that `save` wrote; InputError for a missing file or one that is not a whole result."""
    return opened(path, lambda file, size: _result(File(file, size, (FORMAT, OLD_FORMAT))))


def opened(path: str | os.PathLike[str], make: Callable[[Any, int], Made]) -> Made:
    """What `make` has from an open file and its size in bytes; InputError for whatever is wrong with that."""
    try:
        import h5py
    except ModuleNotFoundError as error:
        raise GudgeonError("NetCDF files need h5py: pip install 'gudgeon[xarray]'") from error
    path, shown = Path(named(path, "path")), in_a_line(os.fspath(path))
    try:
        found = path.stat()
    except OSError:  # a name that is too long, too
        raise InputError(f"there is no file {shown}") from None
    check_regular(found, shown)
    try:
        if is_damaged(path):
            raise InputError(f"{shown} is not as it was written: it was damaged", hint="run the scene again")
        with h5py.File(path, "r") as file:
            return make(file, found.st_size)
    except InputError:
        raise
    except Exception as error:  # whatever HDF5, JSON or NumPy make of what should not be
        told = str(error).partition("\n")[0][:200] or type(error).__name__
        raise InputError(f"{shown} cannot be read as a result: {told}", hint=AGAIN) from error


class File:
    """Arrays and texts of an open file by name ("S9.y", "impacts/t_on"); ValueError for what is not as expected."""

    def __init__(self, file: Any, size: int, formats: tuple[str, ...]) -> None:
        self._file, self._left = file, float(size)
        found = self.text("gudgeon")
        kind = found.partition("/")[0]
        if kind in LOADERS and not formats[0].startswith(f"{kind}/"):
            what, loader = LOADERS[kind]
            raise InputError(f"{in_a_line(file.filename)} holds {what} ({found})", hint=f"read it with {loader}")
        if found not in formats:
            raise ValueError(f"expected the attribute gudgeon = {formats[0]!r}, found {found!r}")
        self.is_old = found == OLD_FORMAT

    def has(self, group: str) -> bool:
        return group in self._file

    def names(self, group: str) -> list[str]:
        """What lies in a group."""
        return list(self._group(group))

    def text(self, key: str, group: str = "") -> str:
        """An attribute of the file or of a group."""
        found = (self._group(group) if group else self._file).attrs[key]
        if isinstance(found, bytes):
            found = found.decode()
        if not isinstance(found, str):
            raise ValueError(f"the attribute {key!r} is no text")
        return str(found)

    def numbers(self, name: str, length: int | None = None, dtype: str = "f8") -> Array:
        """(length,) of that kind, or as long as it is for None."""
        item = self._dataset(name, length)
        if item.dtype.newbyteorder("=") != np.dtype(dtype):
            raise ValueError(f"{name} has numbers of type {item.dtype}, expected {dtype}")
        values: Array = item[...].astype(dtype, copy=False)
        return values

    def either(self, name: str, length: int) -> Array:
        """Numbers that may be whole."""
        return self.numbers(name, length, "i8" if self._dataset(name, length).dtype.kind == "i" else "f8")

    def texts(self, name: str, length: int | None = None) -> list[str]:
        import h5py

        item = self._dataset(name, length)
        if h5py.check_string_dtype(item.dtype) is None:
            raise ValueError(f"{name} has numbers, expected texts")
        return [str(text) for text in item.asstr()[...]]

    def _dataset(self, name: str, length: int | None) -> Any:
        """One of one dimension, with its data in this file, and no more of it than the file has room for."""
        import h5py
        from h5py import h5d

        group, _, last = name.rpartition("/")
        item = _own(self._group(group) if group else self._file, last)
        if not isinstance(item, h5py.Dataset) or len(item.shape or ()) != 1:
            raise ValueError(f"{name} is no variable over one dimension")
        if length is not None and item.shape[0] != length:
            raise ValueError(f"{name} has {item.shape[0]} values, expected {length}")
        settings, size = item.id.get_create_plist(), item.shape[0] * item.dtype.itemsize
        if settings.get_layout() == h5d.VIRTUAL or settings.get_external_count():
            raise ValueError(f"{name} is in another file")
        packed = DEFLATE if settings.get_nfilters() else 1
        self._left -= size / packed
        if self._left < 0 or item.id.get_storage_size() * packed < size:
            raise ValueError(f"{name} has more values than the file has room for")
        return item

    def _group(self, name: str) -> Any:
        import h5py

        item = _own(self._file, name)
        if not isinstance(item, h5py.Group):
            raise ValueError(f"{name} is no group")
        return item


def _own(group: Any, name: str) -> Any:
    """What is itself in the file; a link may lead to another one."""
    import h5py

    if not isinstance(group.get(name, getlink=True), h5py.HardLink):
        raise ValueError(f"there is no {name}")
    return group[name]


def source_of(file: File) -> KernelSource:
    """What a file says of its scene."""
    source = KernelSource.from_json(file.text("source", "" if file.is_old else COMPILED))
    check_typed(source, KernelSource, "source")
    _check_names(source)
    return source


def _result(file: File) -> Result:
    source = source_of(file)
    run = result_of(file, source, tuple(catalogue(source)))
    run.provenance = read_provenance(file)
    return run


def result_of(file: File, source: KernelSource, names: tuple[str, ...]) -> Result:
    """The result with these series."""
    diagnostics = Diagnostics.from_json(file.text("diagnostics"))
    check_typed(diagnostics, Diagnostics, "diagnostics")
    t = file.numbers("time")
    if not len(t):
        raise ValueError("it has no sample")
    check_times(t)
    stored = {name: _series(file, name, len(t)) for name in names if _is_there(file, name)}
    p, given, is_given = _numbers(file, source)
    run = Result(
        compiled=None, source=source, p=p, given=given, is_given=is_given, t=t, **samples_of(source, stored, len(t)),
        impacts=impacts_of(file, source), diagnostics=diagnostics, events=events_of(file, source), stored=stored,
        trace=_trace(file, source),
    )  # fmt: skip
    if file.has(START):
        run.start_row = start_row(file, run)
        check_times(np.append(run.start_row.t, t[0]))
    if file.has(STATES):
        run.__dict__["states_at_events"] = states_at_events(file, run)
    _ = run.names, run.parameters, run.constants, run.final  # what these need is there, or it is no result
    check_extremes(diagnostics.extremes, run.names)
    return run


def check_times(t: Array) -> None:
    """Raise unless times of samples are numbers that ascend."""
    if not (np.isfinite(t).all() and (np.diff(t) > 0.0).all()):
        raise ValueError("the times of samples do not ascend")


def _check_given(source: KernelSource, p: Array, given: Array, is_given: Array) -> None:
    """Raise unless what a run was given is what it had."""
    for slot, x, own, told in zip(source.slots, p.tolist(), given.tolist(), is_given.tolist(), strict=False):
        if told not in (0, 1) or told and not own == x:
            raise ValueError(f"{slot.address} is {x!r}, and was given as {own!r}")


def check_extremes(extremes: tuple[Extremes, ...], names: Container[str]) -> tuple[Extremes, ...]:
    """Raise unless they are of series that there are."""
    for one in extremes:
        if one.name not in names or not UNIT.fullmatch(one.unit) or one.against and not NAME.fullmatch(one.against):
            raise ValueError(f"peaks of {one.name[:64]!r} are of no series")
    return extremes


def _check_names(source: KernelSource) -> None:
    """They will stand in tables, figures and paths: identifiers with dots, as the reader of mechanisms has them."""
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


def _is_there(file: File, name: str) -> bool:
    """Files of before the drift was a series lack it."""
    return name not in DRIFT or file.has(name)


def _series(file: File, name: str, length: int) -> Array:
    stored = f"output.{name}" if file.is_old and name in OLD_NAMES else name if file.is_old else variable(name)
    stored = stored if file.has(stored) else name  # an output that is called like a group that older files have not
    values = file.numbers(stored, length, "i1" if name.endswith(".state") else "f8")
    values.flags.writeable = False
    return values


def _numbers(file: File, source: KernelSource) -> tuple[Array, Array, Array]:
    """p, given and is_given."""
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
    """IMPACT_DTYPE, the contacts of the file's run."""
    return _records(file, "impact", IMPACT_DTYPE, [joint.name for joint in source.clearances])


def events_of(file: File, source: KernelSource) -> Array:
    """EVENT_DTYPE, its events."""
    return _records(file, "event", EVENT_DTYPE, [event.name for event in source.events])


def _records(file: File, what: str, dtype: np.dtype[Any], names: list[str]) -> Array:
    """Impacts or events from their columns, the first of which says whose they are; none, where there is no group."""
    first, *others = dtype.names or ()
    if not file.has(f"{what}.{first}" if file.is_old else f"{what}s"):
        return np.zeros(0, dtype)
    if file.is_old:
        owner = file.numbers(f"{what}.{first}", None, "i4")
    else:
        index: Mapping[str, int] = {name: k for k, name in enumerate(names)}
        owner = np.array([index[name] for name in file.texts(f"{what}s/{first}")], "i4")
    if len(owner) and not (owner.min() >= 0 and owner.max() < len(names)):
        raise ValueError(f"the {what}s are of something that the scene does not have")
    table = np.empty(len(owner), dtype)
    table[first] = owner
    for name in others:
        table[name] = file.numbers(f"{what}.{name}" if file.is_old else f"{what}s/{name}", len(owner))
    return table


def _trace(file: File, source: KernelSource) -> Trace | None:
    """None where the run had none, or the file is from before there were any."""
    if not file.has(TRACE):
        return None
    t = file.numbers(f"{TRACE}/t")
    joints = [[file.numbers(f"{TRACE}/{joint.name}.{name}", len(t)) for name in COLUMNS] for joint in source.clearances]
    return Trace(t, np.moveaxis(np.array(joints).reshape(len(joints), len(COLUMNS), len(t)), 2, 0).copy())

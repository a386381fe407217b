"""Tables as the bytes of an HDF5 file that any NetCDF 4 tool reads: laid out by h5py in memory, streamed to a file.

HDF5 never has a file to write to: one that is full leaves it with handles that it cannot close, and at exit it dies
of them. It lays out what describes the arrays (some 70 kB) and says where each is to stand; the arrays themselves go
straight to the file. It works in a thread of its own, where no signal reaches Python: Ctrl-C in the midst of its
calls would be lost.

The last line of a file is a seal, behind what HDF5 calls its end: a program that changes the file drops it, what
merely damages the file does not.
"""

from __future__ import annotations

import io
import os
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.errors import GudgeonError
from gudgeon.files.room import check_disk
from gudgeon.files.writing import written
from gudgeon.language.wanted import path as named
from gudgeon.waiting.asking import apart
from gudgeon.waiting.ctrl_c import CtrlC

Array: TypeAlias = NDArray[Any]

# what a dimension without a coordinate variable is called in the file: NetCDF's own words
NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable.%10d"
LONGEST = 60_000  # bytes of an attribute beside its object; longer ones lie in a heap
PAGE = 4096
SEAL = b"\ngudgeon crc32 %08x\n"
SEAL_SIZE = len(SEAL % 0)


@dataclass(frozen=True)
class Variable:
    """One array; `values` (n,) numbers or, as objects, texts."""

    name: str
    values: Array
    unit: str
    meaning: str

    @property
    def is_text(self) -> bool:
        return bool(self.values.dtype == object)

    @property
    def attributes(self) -> dict[str, str]:
        return {"units": self.unit or "1", "long_name": self.meaning}


@dataclass(frozen=True)
class Table:
    """Variables over one dimension: the root of the file ("") or a group; the first may be its coordinate."""

    group: str
    dimension: str
    variables: tuple[Variable, ...]
    attributes: Mapping[str, str]

    @property
    def length(self) -> int:
        """Of the dimension; 0: it is not in the file."""
        return len(self.variables[0].values) if self.variables else 0


def pieces(tables: Sequence[Table]) -> Iterator[Any]:
    """The bytes of a file with these tables, piece by piece in their order, its seal last."""
    image, places = apart(partial(_lay_out, tables))
    total = at = 0
    for offset, values in sorted(places, key=lambda place: place[0]):
        for piece in (image.between(at, offset), np.ascontiguousarray(values).data.cast("B")):
            total = zlib.crc32(piece, total)
            yield piece
        at = offset + values.nbytes
    end = image.between(at, image.size)
    yield end
    yield SEAL % zlib.crc32(end, total)


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


def is_damaged(path: Path) -> bool:
    """Whether a file that has a seal is not what was sealed; a file without one may be."""
    with open(path, "rb") as file:
        size = file.seek(0, io.SEEK_END) - SEAL_SIZE
        if size <= 0:
            return False
        file.seek(size)
        seal, total = file.read(), 0
        if not seal.startswith(SEAL.partition(b"%")[0]):
            return False
        file.seek(0)
        while size > 0 and (piece := file.read(min(size, 1 << 20))):
            total = zlib.crc32(piece, total)
            size -= len(piece)
        return seal != SEAL % total


class _Image(io.RawIOBase):
    """A file in memory that keeps the pages that were written, so that the arrays' places cost nothing."""

    def __init__(self) -> None:
        self._pages: dict[int, bytearray] = {}
        self._at = self.size = 0

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        self._at = offset + {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: self.size}[whence]
        return self._at

    def write(self, data: Any) -> int:
        begin, count = self._at, len(data)
        while self._at < begin + count:
            page, offset = divmod(self._at, PAGE)
            part = data[self._at - begin :][: PAGE - offset]
            self._pages.setdefault(page, bytearray(PAGE))[offset : offset + len(part)] = part
            self._at += len(part)
        self.size = max(self.size, self._at)
        return count

    def readinto(self, buffer: Any) -> int:
        buffer[:] = self.between(self._at, self._at + len(buffer))
        self._at += len(buffer)
        return len(buffer)

    def truncate(self, size: int | None = None) -> int:
        self.size = self._at if size is None else size
        return self.size

    def between(self, begin: int, end: int) -> bytes:
        """Bytes [begin, end): zeros where nothing was written."""
        nothing, first = bytes(PAGE), begin // PAGE
        pages = (self._pages.get(page, nothing) for page in range(first, -(-end // PAGE)))
        return b"".join(pages)[begin - first * PAGE : end - first * PAGE]


def _lay_out(tables: Sequence[Table]) -> tuple[_Image, list[tuple[int, Array]]]:
    """The image without the numbers, and where these go."""
    import h5py

    image, places = _Image(), []
    with h5py.File(image, "w", track_order=True) as file:
        for number, table in enumerate(table for table in tables if table.length or table.attributes):
            group = file.create_group(table.group, track_order=True) if table.group else file
            for dataset, variable in _lay_out_table(group, table, number) if table.length else ():
                for key, text in variable.attributes.items():
                    _write_text(dataset, key, text)
                if not variable.is_text:
                    places.append((dataset.id.get_offset(), variable.values))
            for key, text in table.attributes.items():
                _write_text(group, key, text)
    return image, places


def _lay_out_table(group: Any, table: Table, number: int) -> Iterator[tuple[Any, Variable]]:
    """Its dataset for each variable; a dimension without a coordinate has one of numbers that nobody reads."""
    from h5py import h5ds

    own = table.variables[0].name == table.dimension
    first = table.variables[0] if own else Variable(table.dimension, np.zeros(table.length, ">f4"), "", "")
    scale = _create(group, first)
    h5ds.set_scale(scale.id, (table.dimension if own else NO_VARIABLE % table.length).encode())
    scale.attrs["_Netcdf4Dimid"] = np.int32(number)
    if own:
        yield scale, first
    for variable in table.variables[own:]:
        dataset = _create(group, variable)
        h5ds.attach_scale(dataset.id, scale.id, 0)
        yield dataset, variable


def _create(group: Any, variable: Variable) -> Any:
    """A dataset that has its place in the file, and nothing written there; of texts the whole, for HDF5 places them."""
    import h5py
    from h5py import h5d, h5p, h5s, h5t

    if variable.is_text:
        return group.create_dataset(variable.name, data=variable.values, dtype=h5py.string_dtype(), track_order=True)
    settings = h5p.create(h5p.DATASET_CREATE)
    settings.set_alloc_time(h5d.ALLOC_TIME_EARLY)
    settings.set_fill_time(h5d.FILL_TIME_NEVER)
    settings.set_obj_track_times(False)
    settings.set_attr_creation_order(h5p.CRT_ORDER_TRACKED | h5p.CRT_ORDER_INDEXED)
    kind, space = h5t.py_create(variable.values.dtype), h5s.create_simple(variable.values.shape)
    return h5py.Dataset(h5d.create(group.id, variable.name.encode(), kind, space, settings))


def _write_text(where: Any, key: str, text: str) -> None:
    """An attribute beside its object, as NetCDF's own texts are, if it is short enough; ten times quicker too."""
    from h5py import h5a, h5s, h5t

    data = text.encode()
    if len(data) > LONGEST:
        where.attrs[key] = text
        return
    kind = h5t.C_S1.copy()
    kind.set_size(max(len(data), 1))
    kind.set_cset(h5t.CSET_UTF8)
    h5a.create(where.id, key.encode(), kind, h5s.create(h5s.SCALAR)).write(np.array(data), mtype=kind)

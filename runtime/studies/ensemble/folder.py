"""Manage the folder of a study on disk (checkpoints): manifest, blocks of finished runs, a lock for a single writer.

A kill at any moment loses at most the unfinished blocks.
"""

from __future__ import annotations

import io
import json
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import GudgeonError, InputError, escape_line_breaks, shorten_path
from gudgeon.files.writing import PART, convert_os_errors, open_atomic, read_regular_file
from gudgeon.language.argument_checks import shorten_value
from gudgeon.language.names import LABEL
from gudgeon.studies.ensemble.block import Block
from gudgeon.studies.ensemble.notes import Note
from gudgeon.studies.ensemble.plan import FOLDER_FORMAT

if TYPE_CHECKING:
    from gudgeon.studies.ensemble.plan import Plan

MANIFEST, DATASET, LOCK = "study.json", "study.nc", ".lock"
_BLOCK = re.compile(r"block-[0-9]{6,9}\.nc")
_MAX_LISTED = 6
MAX_RECENT_BYTES = 4 << 20  # maximum size of the written blocks that stay in memory


class StudyFolder:
    """A folder of a study that one process writes to; use it within `open_locked`."""

    def __init__(self, path: str | os.PathLike[str], plan: Plan) -> None:
        """Store path and plan without access to the disk."""
        self.path, self.plan = Path(path), plan
        self.recent_blocks: dict[int, Block] = {}  # written blocks in memory, for the dataset
        self.recent_bytes = 0

    @contextmanager
    def open_locked(self, restart: bool) -> Iterator[StudyFolder]:
        """Create and lock the folder, check that it belongs to the plan, and yield it; the lock is released at the end.

        restart: remove the blocks of an earlier study first. Raises InputError if another process has the lock, or for
        a folder with other contents or another study; OutputError.
        """
        from filelock import FileLock, Timeout

        lock = FileLock(self.path / LOCK)
        with convert_os_errors(self.path):
            self.path.mkdir(parents=True, exist_ok=True)
            try:
                lock.acquire(timeout=0)
            except Timeout:
                message = f"another process writes to {shorten_path(self.path)}"
                raise InputError(message, hint="wait until it ends, or name another folder") from None
        try:
            self._prepare_contents(restart)
            yield self
        finally:
            lock.release()

    def _prepare_contents(self, restart: bool) -> None:
        """Check the contents of the folder, remove temporary files, and write the manifest of a new study.

        Existing blocks stay if the manifest has the same inputs and block sizes. With `restart`, or for other block
        sizes, blocks, dataset and manifest are removed first. Raises InputError for a folder with other files or
        another study.
        """
        file_names = sorted(name for name in os.listdir(self.path) if name != LOCK)
        old_manifest = read_manifest(self.path)
        other_files = [name for name in file_names if not (_BLOCK.fullmatch(name) or PART.fullmatch(name))]
        if old_manifest is None and other_files:
            message = f"{shorten_path(self.path)} is not a study folder: it contains {other_files[0]}"
            raise InputError(message, hint="name another folder")
        for name in file_names:
            if PART.fullmatch(name):  # of a process that was killed
                (self.path / name).unlink(missing_ok=True)
        blocks = [part.block_runs for part in self.plan.parts]
        if old_manifest is not None and not restart:
            if old_manifest.get("said") != self.plan.input_description:
                differences_text = "\n  ".join(
                    _describe_differences(old_manifest.get("said"), self.plan.input_description)
                )
                hint = "start the study again with --restart (restart=True), or name another folder"
                raise InputError(f"{shorten_path(self.path)} contains another study:\n  {differences_text}", hint=hint)
            if old_manifest.get("blocks") == blocks:
                return
        for name in [name for name in file_names if name in (MANIFEST, DATASET) or _BLOCK.fullmatch(name)]:
            with convert_os_errors(self.path / name):
                (self.path / name).unlink(missing_ok=True)
        text = json.dumps({"said": self.plan.input_description, "blocks": blocks, "plan": self.plan.identity}, indent=1)
        with open_atomic(self.path / MANIFEST, sync=True) as file:
            file.write(text.encode())

    def has_block(self, number: int) -> bool:
        """Return whether a block exists, is undamaged, and belongs to this plan; the whole block is read."""
        return self.read_block(number) is not None

    def count_block_files(self) -> int:
        """Return the number of block files, also damaged ones, for messages; 0 if the folder cannot be listed."""
        try:
            return sum(bool(_BLOCK.fullmatch(name)) for name in os.listdir(self.path))
        except OSError:
            return 0

    def write_block(self, block: Block) -> None:
        """Write a block atomically as one file, which is on the disk (fsync) on return. Raises OutputError.

        The block also stays in memory if all such blocks together do not exceed MAX_RECENT_BYTES.
        """
        data = encode_block(block, self.plan.digest)
        with open_atomic(self._get_block_path(block.number), sync=True) as file:
            file.write(data)
        if self.recent_bytes + block.nbytes <= MAX_RECENT_BYTES:
            self.recent_blocks[block.number] = block
            self.recent_bytes += block.nbytes

    def read_block(self, number: int) -> Block | None:
        """Return a block from memory or its file; None for a missing or damaged file, or one of another plan.

        The caller then runs the block again.
        """
        path = self._get_block_path(number)
        if number in self.recent_blocks and path.exists():
            return self.recent_blocks[number]
        with suppress(OSError, ValueError, KeyError, TypeError, RuntimeError):
            if (data := read_regular_file(path)) is not None:
                return decode_block(data, self.plan, number)
        return None

    def _get_block_path(self, number: int) -> Path:
        """Return the path of the file of a block: block-000012.nc."""
        return self.path / f"block-{number:06d}.nc"


def read_manifest(folder: Path) -> dict[str, Any] | None:
    """Return the manifest study.json of a folder as a mapping; None if it is missing, unreadable or not a mapping."""
    try:
        data = read_regular_file(folder / MANIFEST)
        manifest = None if data is None else json.loads(data)
    except (OSError, ValueError, RecursionError):
        return None
    return manifest if isinstance(manifest, dict) else None


def create_parts_folder(path: Path, part_names: Sequence[str], restart: bool) -> None:
    """Create the folder of a study with parts and write its manifest; the parts create their subfolders later.

    restart: replace the manifest of a study without parts. Raises InputError for a folder with other contents, or
    without `restart` with a study without parts; OutputError.
    """
    with convert_os_errors(path):
        path.mkdir(parents=True, exist_ok=True)
        file_names = [name for name in sorted(os.listdir(path)) if not PART.fullmatch(name)]
    old_manifest = read_manifest(path)
    if file_names and old_manifest is None:
        raise InputError(
            f"{shorten_path(path)} is not a study folder: it contains {file_names[0]}", hint="name another folder"
        )
    if old_manifest is not None and "parts" not in old_manifest and not restart:
        hint = "start the study again with --restart (restart=True), or name another folder"
        raise InputError(f"{shorten_path(path)} contains a study without parts", hint=hint)
    with open_atomic(path / MANIFEST, sync=True) as file:
        file.write(json.dumps({"format": FOLDER_FORMAT, "parts": list(part_names)}, indent=1).encode())


def list_part_names(manifest: Mapping[str, Any]) -> list[str]:
    """Return the names of the parts in a manifest; invalid names are left out. Empty for a study without parts."""
    names = manifest.get("parts")
    part_names = names if isinstance(names, list) else []
    return [name for name in part_names if isinstance(name, str) and re.fullmatch(LABEL, name)]


def check_dataset(folder: Path, plan_digest: Any) -> None:
    """Raise InputError if the dataset study.nc of a folder cannot be opened or was written for another plan.

    plan_digest: digest of the plan, as the manifest has it.
    """
    path = folder / DATASET
    with convert_read_errors(path), import_h5py().File(path, "r") as file:
        is_complete = file.attrs["plan"] == plan_digest and len(file["failure"].shape) >= 0
    if not is_complete:
        raise InputError(f"{shorten_path(path)} belongs to another study", hint="remove the file: it is written again")


@contextmanager
def convert_read_errors(path: Path) -> Iterator[None]:
    """Convert errors of HDF5 within this context, such as those of a damaged file, to InputError with the path."""
    try:
        yield
    except (OSError, KeyError, ValueError, RuntimeError) as error:
        message = f"{shorten_path(path)} cannot be read: {escape_line_breaks(str(error))[:200]}"
        hint = "remove the file: gudgeon study FILE --out FOLDER writes it again"
        raise InputError(message, hint=hint) from error


def _describe_differences(old_inputs: Any, new_inputs: Any) -> list[str]:
    """Return a line for each input that differs between two studies: "t_end was '20 ms', is '30 ms'".

    Arguments are nested JSON data. After _MAX_LISTED lines, a last one has the number of further differences.
    """
    old, new = dict(_iterate_leaves(old_inputs)), dict(_iterate_leaves(new_inputs))
    lines = []
    for key in dict.fromkeys([*old, *new]):
        if old.get(key) != new.get(key):
            old_text, new_text = (
                shorten_value(inputs[key]) if key in inputs else "not specified" for inputs in (old, new)
            )
            lines.append(f"{key.removeprefix('study.')} was {old_text}, is {new_text}")
    last_line = [f"and {len(lines) - _MAX_LISTED} further differences"] if len(lines) > _MAX_LISTED else []
    return lines[:_MAX_LISTED] + last_line


def _iterate_leaves(node: Any, key: str = "") -> Iterator[tuple[str, Any]]:
    """Yield path ("a.b[2]") and value of all leaves of nested mappings and lists; `key` is the path of `node`.

    Empty mappings and lists yield nothing.
    """
    if isinstance(node, Mapping):
        for name, child in node.items():
            yield from _iterate_leaves(child, f"{key}.{name}" if key else str(name))
    elif isinstance(node, list):
        for k, child in enumerate(node):
            yield from _iterate_leaves(child, f"{key}[{k}]")
    else:
        yield key, node


@cache
def import_h5py() -> Any:
    """Import h5py and return it (cached). Raises GudgeonError if h5py, xarray or h5netcdf is not installed."""
    if not all(map(find_spec, ("h5py", "xarray", "h5netcdf"))):
        raise GudgeonError("studies need xarray and h5py: pip install 'gudgeon[xarray]'")
    import h5py

    return h5py


def encode_block(block: Block, digest: str) -> bytes:
    """Serialize a block as the bytes of an HDF5 file with checksums and the plan's digest.

    To save time, measures and end times are one array, and failures and notes one array of JSON text.
    """
    h5py, buffer = import_h5py(), io.BytesIO()
    with h5py.File(buffer, "w") as file:
        file.attrs["digest"], file.attrs["number"] = digest, block.number
        notes = {kind: (note.runs, note.run, note.text) for kind, note in block.notes.items()}
        text_bytes = np.frombuffer(json.dumps((block.failures, notes)).encode(), np.uint8)
        arrays = {"runs": np.array([block.t_last, *block.measures.values()]), "words": text_bytes}
        if block.series:
            arrays |= {"t": block.t, "series": np.array([*block.series.values()])}
        for name, values in arrays.items():
            file.create_dataset(name, data=values, **({"fletcher32": True} if values.size else {}))
    return buffer.getvalue()


def decode_block(data: bytes, plan: Plan, number: int) -> Block | None:
    """Deserialize the bytes of `encode_block` and return the block; None if digest or number belong to another plan.

    Raises OSError, ValueError, KeyError, TypeError or RuntimeError for damaged bytes.
    """
    h5py = import_h5py()
    description = plan.blocks[number]
    with h5py.File(io.BytesIO(data), "r") as file:
        if file.attrs["digest"] != plan.digest or file.attrs["number"] != number:
            return None
        names, keep = [measure.name for measure in plan.run_settings.measures], plan.run_settings.keep
        t_last, *measures = _read_array(file, "runs", (1 + len(names), description.runs))
        t, series = np.zeros(0), np.zeros((0, description.runs, 0))
        if keep:
            t, series = (
                np.asarray(file["t"], dtype=float),
                _read_array(file, "series", (len(keep), description.runs, None)),
            )
        failures, notes_json = json.loads(bytes(np.asarray(file["words"], np.uint8)))
    notes = {kind: Note(*note) for kind, note in notes_json.items()}
    if len(failures) != description.runs or not all(isinstance(notes_json, str) for notes_json in failures):
        raise ValueError(f"block {number}: expected {description.runs} runs")
    by_name = dict(zip(names, measures, strict=True)), dict(zip(keep, series, strict=True))
    return Block(
        number,
        description.part * plan.runs_per_part + description.first_run,
        by_name[0],
        tuple(failures),
        t_last,
        t,
        by_name[1],
        notes,
    )


def _read_array(file: Any, name: str, shape: tuple[int | None, ...]) -> Any:
    """Return an array of an open HDF5 file as floats. Raises ValueError for another shape; None in it: any length."""
    array = np.asarray(file[name], dtype=float)
    if len(array.shape) != len(shape) or any(
        n not in (None, length) for n, length in zip(shape, array.shape, strict=True)
    ):
        raise ValueError(f"{name} has shape {array.shape}")
    return array

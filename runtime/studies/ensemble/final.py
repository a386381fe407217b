"""Merge the files of a study's blocks (batches of runs) into one NetCDF 4 file, one by one, so that memory suffices."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, BinaryIO

import numpy as np

from gudgeon.files.writing import open_atomic
from gudgeon.results.batch import Array
from gudgeon.studies.ensemble.block import Block
from gudgeon.studies.ensemble.folder import DATASET, StudyFolder, import_h5py
from gudgeon.studies.ensemble.measures import describe_measure
from gudgeon.studies.ensemble.notes import MAX_NOTES, Note, get_message_kind, merge_notes
from gudgeon.studies.ensemble.plan import Coordinate, Plan

JOINED_BYTES = 1 << 20  # approximate size of joined blocks that are written at once
MAX_LISTED_COORDINATES = 6  # coordinates that identify the run of a note
MAX_FAILURE_KINDS, MAX_TEXT_LENGTH = (
    50,
    50_000,
)  # kinds of failures, characters of an attribute: HDF5 has no longer ones


def write_dataset(folder: StudyFolder) -> None:
    """Merge all blocks of a study into `study.nc` in its folder, which is replaced atomically when it is complete.

    Called once all blocks are finished. Raises OutputError, or LookupError for a missing block.
    """
    t, common = _find_common_times(folder)
    with open_atomic(folder.path / DATASET, sync=True) as file:
        _write_blocks(file, folder, t, common)


def _read_blocks(folder: StudyFolder) -> Iterator[Block]:
    """Yield all blocks of a study in order, read from its folder. Raises LookupError for a missing or damaged one."""
    for description in folder.plan.blocks:
        block = folder.read_block(description.number)
        if block is None:
            raise LookupError(f"block {description.number} is missing")
        yield block


def _join_small_blocks(blocks: Iterable[Block]) -> Iterator[Block]:
    """Yield the blocks, consecutive ones concatenated to about JOINED_BYTES bytes, since each write has a fixed cost.

    Blocks with different numbers of samples are not concatenated.
    """
    pending, pending_bytes = list[Block](), 0
    for block in blocks:
        if pending and (pending_bytes > JOINED_BYTES or block.t.shape[-1] != pending[0].t.shape[-1]):
            yield _concatenate_blocks(pending)
            pending, pending_bytes = [], 0
        pending.append(block)
        pending_bytes += block.nbytes
    if pending:
        yield _concatenate_blocks(pending)


def _concatenate_blocks(blocks: Sequence[Block]) -> Block:
    """Return consecutive blocks with the same number of samples as one block; a single block is returned unchanged.

    Sample times stay (N,) if all blocks share them, else they become (n, N).
    """
    first = blocks[0]
    if len(blocks) == 1:
        return first
    t = first.t
    if t.ndim > 1 or not all(np.array_equal(block.t, t) for block in blocks):
        t = np.concatenate([np.broadcast_to(block.t, (len(block.t_last), t.shape[-1])) for block in blocks])
    measures, series = (
        {name: np.concatenate([getattr(block, group)[name] for block in blocks]) for name in getattr(first, group)}
        for group in ("measures", "series")
    )
    failures = tuple(message for block in blocks for message in block.failures)
    t_last, notes = np.concatenate([block.t_last for block in blocks]), merge_notes(block.notes for block in blocks)
    return Block(first.number, first.first_run, measures, failures, t_last, t, series, notes)


def _find_common_times(folder: StudyFolder) -> tuple[Array, bool]:
    """Return the sample times (N,) and True if all runs share them; else N values of NaN and False.

    N is then the largest number of samples of a run. All blocks are read if the study stores series; otherwise N is 0.
    """
    common: Array | None = None
    is_common, max_samples = True, 0
    for block in _read_blocks(folder) if folder.plan.run_settings.keep else ():
        max_samples = max(max_samples, block.t.shape[-1])
        if not block.t.size:  # no run began
            continue
        is_common = is_common and block.t.ndim == 1 and (common is None or np.array_equal(common, block.t))
        common = block.t if common is None else common
    return (common, True) if is_common and common is not None else (np.full(max_samples, np.nan), False)


def _write_blocks(binary_file: BinaryIO, folder: StudyFolder, t: Array, has_common_times: bool) -> None:
    """Write coordinates, variables, notes and counts of failures of all blocks to an open binary file.

    t (N,): common sample times. If `has_common_times` is False, only its length is used: the dimension is then
    `sample`, and the variable `t` has the times of each run. Raises LookupError for a missing block.
    """
    h5py, plan = import_h5py(), folder.plan
    counts_by_kind: Counter[str] = Counter()
    first_run_by_kind: dict[str, int] = {}
    notes: dict[str, Note] = {}
    with h5py.File(binary_file, "w", libver=("earliest", "v110")) as file:
        _write_attributes(file, plan)
        scales = {
            coordinate.name: coordinate for coordinate in plan.coordinates if coordinate.over == (coordinate.name,)
        }
        for coordinate in [
            *scales.values(),
            *(coordinate for coordinate in plan.coordinates if coordinate.name not in scales),
        ]:
            _write_coordinate(h5py, file, coordinate)
        if plan.run_settings.keep:
            sample_values = np.arange(len(t)) if not has_common_times else t
            sample_coordinate = (
                ("time", "s", "time of the sample") if has_common_times else ("sample", "", "number of the sample")
            )
            _write_coordinate(
                h5py,
                file,
                Coordinate(sample_coordinate[0], (sample_coordinate[0],), sample_values, *sample_coordinate[1:]),
            )
        variables = _create_variables(h5py, file, plan, len(t), has_common_times)
        for block in _join_small_blocks(_read_blocks(folder)):
            _write_values(variables, plan, block, has_common_times)
            notes = merge_notes((notes, block.notes))
            for run, reason in enumerate(block.failures, block.first_run):
                if reason:
                    counts_by_kind[kind := get_message_kind(reason)] += 1
                    first_run_by_kind.setdefault(kind, run)
        frequent = sorted(notes.values(), key=lambda note: (-note.runs, note.run, note.text))[:MAX_NOTES]
        lines = (*plan.notes, *(_format_note(plan, note) for note in frequent))
        file.attrs["notes"] = "\n".join(lines)[: MAX_TEXT_LENGTH // 4]
        file.attrs["failed"] = sum(counts_by_kind.values())
        file.attrs["failure_kinds"] = json.dumps(most_frequent := dict(counts_by_kind.most_common(MAX_FAILURE_KINDS)))
        file.attrs["failure_first"] = json.dumps([first_run_by_kind[kind] for kind in most_frequent])


def _format_note(plan: Plan, note: Note) -> str:
    """Return a note as one line: "3 of 4 runs, such as run 0 (c=1e-06): text"."""
    indices = dict(zip(plan.dims, np.unravel_index(note.run, plan.shape) if plan.shape else (), strict=True))
    coordinates = (
        coordinate
        for coordinate in plan.coordinates
        if coordinate.over and set(coordinate.over) <= {*indices} and coordinate.over == coordinate.over[:1]
    )
    values = [
        f"{coordinate.name}={_format_coordinate_value(coordinate.values[indices[coordinate.over[0]]])}"
        for coordinate in coordinates
    ][:MAX_LISTED_COORDINATES]
    coordinates_text = f" ({', '.join(values)})" if values else ""
    return f"{note.runs} of {plan.runs} runs, such as run {note.run}{coordinates_text}: {' '.join(note.text.split())}"


def _format_coordinate_value(value: Any) -> str:
    """Return a value of a coordinate as text: a word unchanged, a number with six digits."""
    return str(value) if isinstance(value, str) else f"{value:.6g}"


def _write_attributes(file: Any, plan: Plan) -> None:
    """Write title, mechanism, version, digests and the study (as JSON) as global attributes of an open dataset.

    A study of MAX_TEXT_LENGTH characters or more becomes "".
    """
    import gudgeon

    source = plan.parts[0].simulation.source
    study_json = json.dumps(plan.study.specified)  # a longer one is in the manifest of the folder only
    attributes = {
        "title": plan.study.title or source.title,
        "mechanism": source.mechanism,
        "gudgeon": gudgeon.__version__,
        "sha256": source.whole_sha256,
        "study": study_json if len(study_json) < MAX_TEXT_LENGTH else "",
        "plan": plan.identity,
        "runs": plan.runs,
    }
    for name, value in attributes.items():
        file.attrs[name] = value


def _write_coordinate(h5py: Any, file: Any, coordinate: Coordinate) -> None:
    """Write a coordinate with unit and description to an open dataset.

    A coordinate along the dimension of the same name becomes its dimension scale. Any other is attached to the existing
    scales of its dimensions.
    """
    values = np.asarray(coordinate.values)
    kind = h5py.string_dtype() if values.dtype.kind in "OU" else values.dtype
    dataset = file.create_dataset(
        coordinate.name, data=values.astype(object) if kind != values.dtype else values, dtype=kind
    )
    _set_attributes(dataset, coordinate.unit, coordinate.meaning)
    if coordinate.over == (coordinate.name,):
        dataset.make_scale(coordinate.name)
    else:
        for k, name in enumerate(coordinate.over):
            dataset.dims[k].attach_scale(file[name])


def _set_attributes(variable: Any, unit: str, meaning: str) -> None:
    """Set the attributes `units` and `long_name` of a variable; empty texts are left out."""
    if unit:
        variable.attrs["units"] = unit
    if meaning:
        variable.attrs["long_name"] = meaning


def _create_variables(h5py: Any, file: Any, plan: Plan, n_samples: int, has_common_times: bool) -> dict[str, Any]:
    """Create the variables of measures, end times, failures and series over all dimensions, and return them by name.

    has_common_times: whether series are over `time`; otherwise they are over `sample`, with a variable `t`. Floats are
    filled with NaN.
    """
    variables: dict[str, Any] = {}

    def add_variable(name: str, dimensions: tuple[str, ...], dtype: Any, unit: str, description: str) -> None:
        """Create one variable over these dimensions, filled with NaN if its type is float."""
        shape = tuple(len(file[dimension]) for dimension in dimensions)
        options = {} if dtype is not float else {"fillvalue": np.nan}
        variables[name] = file.create_dataset(name, shape, dtype=dtype, **options)
        _set_attributes(variables[name], unit, description)
        for k, dimension in enumerate(dimensions):
            variables[name].dims[k].attach_scale(file[dimension])

    for measure in plan.run_settings.measures:
        add_variable(measure.name, plan.dims, float, plan.units[measure.name], describe_measure(measure))
    add_variable("t_last", plan.dims, float, "s", "end time of the run")
    add_variable("failure", plan.dims, h5py.string_dtype(), "", "reason of a failed run, empty for any other run")
    auxiliary = " ".join(measure.name for measure in plan.coordinates if measure.over != (measure.name,))
    over = (*plan.dims, "time" if has_common_times else "sample")
    for name in plan.run_settings.keep:
        add_variable(name, over, float, plan.units[name], f"series {name}")
    if plan.run_settings.keep and not has_common_times:
        add_variable("t", over, float, "s", "time of the sample")
    for variable in variables.values() if auxiliary else ():
        variable.attrs["coordinates"] = auxiliary  # convention of CF
    return variables


def _write_values(variables: dict[str, Any], plan: Plan, block: Block, has_common_times: bool) -> None:
    """Write measures, end times, failures and series of a block into the variables, at the indices of its runs."""
    n = len(block.t_last)
    values: dict[str, Any] = {**block.measures, "t_last": block.t_last, "failure": np.array(block.failures, object)}
    values |= block.series
    if plan.run_settings.keep and not has_common_times:
        began = ~np.isnan(block.t_last)[:, None]
        values["t"] = np.where(began, np.broadcast_to(block.t, (n, block.t.shape[-1])), np.nan)
    for name, column in values.items():
        for index, rows in split_into_boxes(plan.shape, block.first_run, block.first_run + n):
            column_part = column[rows.start - block.first_run : rows.stop - block.first_run]
            shape = _compute_slice_shape(plan.shape, index)
            if column.ndim == 2:
                variables[name][(*index, slice(0, column.shape[1]))] = column_part.reshape(*shape, column.shape[1])
            else:
                variables[name][index] = column_part.reshape(shape) if shape or name == "failure" else column_part[0]


def _compute_slice_shape(shape: tuple[int, ...], index: tuple[Any, ...]) -> tuple[int, ...]:
    """Return the shape of array[index] for an array of this shape; index: integers and slices, as in
    `split_into_boxes`.
    """
    slices = (range(length)[part] for part, length in zip(index, shape, strict=True) if isinstance(part, slice))
    return tuple(len(part) for part in slices)


def split_into_boxes(shape: tuple[int, ...], first: int, last: int) -> Iterable[tuple[tuple[Any, ...], slice]]:
    """Yield the rectangular boxes of an array of this shape that make up its elements first … last − 1 in C order.

    Each is a pair: the index of the box (integers and slices), and the slice of the flat element numbers in it. For
    example, elements 1 … 5 of shape (2, 3) are ((0, slice(1, 3)), slice(1, 3)) and ((slice(1, 2), slice(0, 3)),
    slice(3, 6)). An array of shape () has one empty index.
    """
    if not shape:
        yield (), slice(first, last)
        return
    inner = math.prod(shape[1:])
    (i, low), (j, high) = divmod(first, inner), divmod(last, inner)
    full_slices = tuple(slice(0, length) for length in shape[1:])
    if i == j:
        partial_rows = [(i, low, high)]
    else:
        partial_rows = [(i, low, inner)] if low else []
        if i + bool(low) < j:
            yield (slice(i + bool(low), j), *full_slices), slice((i + bool(low)) * inner, j * inner)
        partial_rows += [(j, 0, high)] if high else []
    for row, a, b in partial_rows:
        for index, elements in split_into_boxes(shape[1:], a, b):
            yield (row, *index), slice(row * inner + elements.start, row * inner + elements.stop)

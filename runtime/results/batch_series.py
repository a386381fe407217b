"""Series of a batch: those that were kept, or each run's from its states, evaluated in C and in threads."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import islice
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.integrators.batch import available_threads
from gudgeon.language import tree
from gudgeon.language.wanted import names as plain_names
from gudgeon.results.bare import blank
from gudgeon.results.results import Array, Result
from gudgeon.results.series import catalogue

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.results.batch import Batch

STATES = "states"
BLOCK, AHEAD = 8, 4  # runs that a thread takes at once; blocks a thread that wait to be taken over
Row: TypeAlias = tuple[int, Array, dict[str, Array]]


def wanted_names(source: KernelSource, names: str | Iterable[str], what: str = "names") -> list[str]:
    """These names of series, each once; UnknownNameError names the nearest."""
    found, known = list(dict.fromkeys(plain_names(names, what, "a list of names of series"))), blank(source)
    for name in found:
        known.unit(name)
    return found


def parts_of(source: KernelSource, names: Iterable[str]) -> frozenset[str]:
    """Of an Evaluation, all that these series need."""
    known = catalogue(source)
    return frozenset(part for name in names if name != "t" for part in known[name].parts)


def reads_works(source: KernelSource, name: str) -> bool:
    """Whether a series of a scene follows from works."""
    own = catalogue(source)[name]
    if name in source.outputs:
        used = tree.names(tree.from_json(source.outputs[name]))
        return any(reads_works(source, one.path) for one in used if one.path in catalogue(source))
    return name == "energy.residual" or (own.stored is not None and own.stored[0] == "work")


def check_kept(batch: Batch, names: Iterable[str]) -> None:
    """GudgeonError for a series that neither was kept nor can be evaluated."""
    if batch.states is None and (lost := [name for name in names if name not in batch.kept]):
        raise GudgeonError(f"{lost[0]!r} was not kept in this batch: {kept_text(batch)}")


def kept_text(batch: Batch) -> str:
    """What there is instead of states."""
    named = [name for name in batch.kept if name != "t"]
    hint = 'simulate_many(…, keep=[…]) names what is kept; keep="states" keeps everything'
    return f"it has {', '.join(named) or 'no series'}\n  {hint}"


def series_column(name: str) -> str:
    """Return the column of a series in tables of a batch, in which `run` is the number of the run."""
    return f"output.{name}" if name == "run" else name


def given_columns(batch: Batch) -> dict[str, Array]:
    """Return what was given to the runs, (n,) by its column: "given.NAME" where a series is called NAME, too."""
    known = catalogue(batch.source)
    return {f"given.{name}" if name in known else name: values for name, values in batch.parameters.items()}


def series(batch: Batch, names: Sequence[str]) -> dict[str, Array]:
    """These series of all runs, (n, N) each, NaN where a run has no sample. Raises SingularError."""
    names = wanted_names(batch.source, names)
    check_kept(batch, names)
    found = {name: column for name in names if (column := _at_hand(batch, name)) is not None}
    left = [name for name in names if name not in found]
    found |= {name: np.full((len(batch), batch.t.shape[-1]), np.nan) for name in left}
    for i, t, own in rows(batch, left) if left else ():
        for name, values in own.items():
            found[name][i, : len(t)] = values
    return {name: found[name] for name in names}


def _at_hand(batch: Batch, name: str) -> Array | None:
    """A series that is a column of what is stored, (n, N); a copy."""
    if name in batch.kept:
        return batch.kept[name].copy()
    stored = None if name == "t" else catalogue(batch.source)[name].stored
    if stored is None or stored[0] not in ("q", "v", "work", "state"):
        return None
    array, column = stored
    values = np.array(getattr(batch, array)[:, :, column], dtype=float)
    if array == "state":
        values[np.arange(values.shape[1]) >= batch.samples[:, None]] = np.nan
    return values


def rows(batch: Batch, names: Sequence[str]) -> Iterator[Row]:
    """Number, sample times and these series of each run that began, in order; evaluated a few runs ahead."""
    check_kept(batch, names)
    one = _kept_row if batch.states is None else _evaluated_row
    parts = parts_of(batch.source, names)

    def block(first: int) -> list[Row]:
        each = (one(batch, i, names, parts) for i in range(first, min(first + BLOCK, len(batch))))
        return [row for row in each if row is not None]

    yield from _in_order(block, range(0, len(batch), BLOCK), min(batch.threads, available_threads()))


def _in_order(make: Callable[[int], list[Row]], pieces: range, threads: int) -> Iterator[Row]:
    waiting: deque[Future[list[Row]]] = deque()
    left = iter(pieces)
    with ThreadPoolExecutor(max(1, min(threads, len(pieces))), thread_name_prefix="gudgeon") as pool:
        try:
            while True:
                more = islice(left, AHEAD * max(1, threads) - len(waiting))
                waiting.extend(pool.submit(make, piece) for piece in more)
                if not waiting:
                    return
                yield from waiting.popleft().result()
        finally:
            pool.shutdown(cancel_futures=True)


def _evaluated_row(batch: Batch, i: int, names: Sequence[str], parts: frozenset[str]) -> Row | None:
    run: Result | None = batch.result.bare(i, parts)
    return None if run is None else (i, run.t, {name: run[name] for name in names})


def _kept_row(batch: Batch, i: int, names: Sequence[str], _: frozenset[str]) -> Row | None:
    done = int(batch.samples[i])
    return (i, batch.kept["t"][i, :done], {name: batch.kept[name][i, :done] for name in names}) if done else None

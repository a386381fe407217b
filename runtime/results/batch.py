"""The results of many runs of one scene: arrays over the runs, each run as a Result when it is asked for.

Series of a batch are those that were kept, or each run's from its states, evaluated in C and in threads.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, Protocol, TypeAlias, overload

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError
from gudgeon.integrators.threads import available_threads
from gudgeon.language import tree
from gudgeon.language.shown import counted
from gudgeon.language.wanted import is_whole, refuse, told
from gudgeon.language.wanted import names as plain_names
from gudgeon.model.choices import of_runs as chosen_of_runs
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.peaks import BatchPeaks, of_runs
from gudgeon.results.results import Result, blank
from gudgeon.results.series import catalogue
from gudgeon.results.state import Array

if TYPE_CHECKING:
    import pandas
    import xarray

    from gudgeon.results.samples import AtEvents
    from gudgeon.results.wear import Rubbed

STATES = "states"
BLOCK, AHEAD = 8, 4  # runs that a thread takes at once; blocks a thread that wait to be taken over
Row: TypeAlias = tuple[int, Array, dict[str, Array]]


@dataclass(frozen=True, eq=False)
class Failure:
    """A run that did not come to its end; equal to another one that says the same, as one does that was saved."""

    run: int
    error: GudgeonError

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Failure) and (self.run, str(self.error)) == (other.run, str(other.error))

    def __hash__(self) -> int:
        return hash((self.run, str(self.error)))

    def __str__(self) -> str:
        return f"run {self.run}: {self.error}"


class ResultOf(Protocol):
    """Where a batch has its runs from."""

    def __call__(self, i: int, /) -> Result:
        """The full result; raises the error of a run that failed, with what it reached."""

    def notes(self) -> Mapping[int, tuple[str, ...]]:
        """What runs say of themselves, by their number."""

    def bare(self, i: int, parts: frozenset[str], /) -> Result | None:
        """Its samples for series that need at most these parts of an Evaluation; None where there is none."""


@dataclass(frozen=True, eq=False)
class States:
    """Samples of n runs at N times each, SI; NaN (codes: 0) where a run has none."""

    q: Array  # (n, N, n_q)
    v: Array
    work: Array  # (n, N, 3) J: drives, applied forces, joints with play
    state: Array  # (n, N, n_clearances) int8: 0 free, 1 impact, 2 contact


@dataclass(eq=False, repr=False)
class Batch:
    """n runs, each with at most N samples; SI. What a run did not reach is NaN.

    `batch[i]` is the full Result of run i, made when it is asked for (and anew each time), the same as that of
    the run alone; of a run that failed it raises the error, whose `partial` is the result up to there.
    `batch["S9.y"]` is that series of all runs, (n, N), evaluated in threads. It may be pickled, as a Result may.

    `t` are the output times that were asked for: (N,) where they are those of all runs, which is so unless runs end
    at different times or were given times of their own; then (n, N), NaN behind a run's last. `times` is (n, N)
    always, and `batch["t"]` when the samples were taken: where an event or Ctrl-C ended a run, its end is the last.
    `q`, `v` (n, N, n_q), `work` (n, N, 3; J) and `state` (n, N, n_clearances) are the states at the samples. A batch
    of which only some series were kept has none, and no `batch[i]`: asking for them is a GudgeonError.
    """

    source: KernelSource
    t: Array  # (N,) s, or (n, N)
    states: States | None  # None: only some series were kept
    samples: Array  # (n,) output times that were reached; where an event or Ctrl-C ended a run, the last is its end's
    t_last: Array  # (n,) s, where each run ended
    parameters: Mapping[str, Array]  # address -> (n,) values, or names, of what was given to any run
    impacts: tuple[Array, ...]  # IMPACT_DTYPE, one an onset, of each run
    events: tuple[Array, ...]  # EVENT_DTYPE of each run
    peaks: Array  # (n, n_clearances) PEAK_DTYPE: N, s, m; the first contact and its peak force, NaN: none
    diagnostics: Mapping[str, Array]  # (n,) each: counts and maxima, named and meant as in Diagnostics
    failures: tuple[Failure, ...]
    seconds: float  # wall time of all runs
    threads: int
    interrupted: bool
    result: ResultOf = field(repr=False)
    kept: Mapping[str, Array] = field(default_factory=dict)  # series (n, N) instead of states, and "t"
    extremes: tuple[tuple[Extremes, ...], ...] = ()  # of each run, over all steps, where `peaks` asked for them
    rubbed: tuple[tuple[Rubbed, ...], ...] = ()  # the same of what a study asked for; no file has it

    def __len__(self) -> int:
        return len(self.samples)

    def __repr__(self) -> str:
        failed = f", {len(self.failures)} failed" if self.failures else ""
        samples = f"{counted(len(self), 'run')} of {counted(self.t.shape[-1], 'sample')}"
        kept = "" if self.states else f", {', '.join(name for name in self.kept if name != 't') or 'no series kept'}"
        return f"<Batch {self.source.mechanism}/{self.source.scene}: {samples}{failed}{kept}>"

    @property
    def times(self) -> Array:
        """Output times that were asked for, (n, N), s; not to be written."""
        return np.broadcast_to(self.t, (len(self), self.t.shape[-1]))

    @property
    def q(self) -> Array:
        """Coordinates, (n, N, n_q)."""
        return self._states.q

    @property
    def v(self) -> Array:
        """Their velocities, (n, N, n_q)."""
        return self._states.v

    @property
    def work(self) -> Array:
        """Works of drives, applied forces, clearance forces, (n, N, 3), J."""
        return self._states.work

    @property
    def state(self) -> Array:
        """0 free, 1 impact, 2 contact, (n, N, n_clearances)."""
        return self._states.state

    @property
    def _states(self) -> States:
        if self.states is None:
            raise GudgeonError(f"the states of these runs were not kept: {kept_text(self)}")
        return self.states

    @overload
    def __getitem__(self, key: str) -> Array: ...
    @overload
    def __getitem__(self, key: int) -> Result: ...
    def __getitem__(self, key: int | str) -> Result | Array:
        if isinstance(key, str):
            return series(self, [key])[key]
        if not is_whole(key):
            refuse("a run of a batch", key, "its number, or the name of a series")
        if not -len(self) <= key < len(self):
            raise IndexError(f"run {told(key)}: there are {len(self)}")
        _ = self._states
        return self.result(int(key) % len(self))

    @property
    def onsets(self) -> Array:
        """How many contacts began at each joint with play, (n, n_clearances)."""
        joints = range(len(self.source.clearances))
        counts = [[int((impacts["joint"] == k).sum()) for k in joints] for impacts in self.impacts]
        return np.array(counts, dtype=np.int_).reshape(len(self), len(joints))

    def partial(self, i: int) -> Result | None:
        """The result of run i as far as it came; None where it did not begin."""
        _ = self._states
        if not is_whole(i):
            refuse("a run of a batch", i, "its number")
        try:
            return self[i]
        except GudgeonError as error:
            found = getattr(error, "partial", None)
            return found if isinstance(found, Result) else None

    def at_events(self, name: str) -> tuple[AtEvents | None, ...]:
        """The states at the times of an event, run by run; None for one that did not begin. See Result.at_events."""
        runs = map(self.partial, range(len(self)))
        return tuple(None if run is None else run.at_events(name) for run in runs)

    def peak(self, name: str) -> BatchPeaks:
        """Largest and smallest value of a series over all steps, (n,) each: see Result.peak."""
        return of_runs(self.source, self.extremes, name, False, lambda: self._samples_of(name))

    def peak_error(self, name: str) -> BatchPeaks:
        """The same of the series less that of another scene: see Result.peak_error."""
        return of_runs(self.source, self.extremes, name, True, lambda: self._samples_of(name))

    def _samples_of(self, name: str) -> tuple[Array, Array]:
        """Times and values, (n, N) each; N is 0 where the series was not kept."""
        try:
            return np.broadcast_to(self["t"], (len(self), self.t.shape[-1])), self[name]
        except GudgeonError:
            return np.zeros((len(self), 0)), np.zeros((len(self), 0))

    def to_xarray(self, names: Iterable[str] | str = (), part: str = "series") -> xarray.Dataset:
        """A Dataset over `run` and `time`, every series by its name in a Result, those of `names` too.

        Runs with times of their own have them as `t` over both; `time` then only counts. Over `run` alone: samples,
        ends, failures, diagnostics, parameters and, as "A.peak.F", the peaks; those over all steps as "S9.ay.peak.max",
        "S9.ay.error.max".
        `.to_dataframe()` has a row for each run and time. part: "impacts", "events" and what else a Result has as a
        table of its own: a row each, with its `run`; a text alone names such a part, as it does of a Result.
        """
        from gudgeon.results.files import netcdf_batch

        return netcdf_batch.dataset(self, names, part)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write everything to one NetCDF file, every series of every run (those that were kept); OutputError where
        that fails."""
        from gudgeon.results.files import netcdf_batch

        netcdf_batch.save(self, path)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Batch:
        """The batch that `save` wrote, bit for bit; it needs no compiled library. InputError for any other file."""
        from gudgeon.results.files import netcdf_batch

        return netcdf_batch.load(path)

    def to_dataframe(self, names: Iterable[str] | None = None) -> pandas.DataFrame:
        """A long table of pandas: run, what was given to it, t, and these series, or all there are for None; a row each
        sample reached.

        SI, units in `attrs["units"]`.
        """
        from gudgeon.results.files import export

        return export.batch_dataframe(self, names)

    def to_csv(self, path: str | os.PathLike[str], names: Iterable[str] | None = None) -> None:
        """Write the same table as CSV, run by run; every bit of a number."""
        from gudgeon.results.files import export

        export.batch_csv(self, path, names)

    def to_mat(self, path: str | os.PathLike[str], names: Iterable[str] | None = None) -> None:
        """Write for MATLAB `t` and these series, or all, each n × N, and what was given to runs, n × 1; see Result."""
        from gudgeon.results.files import export

        export.batch_mat(self, path, names)


def given_values(source: KernelSource, p: Array, is_given: NDArray[np.bool_]) -> dict[str, Array]:
    """{address: (n,)} of what was given to any run, from the parameters (n, n_slots + n_derived) of all."""
    some = [(source.slots[k], p[:, k]) for k in np.flatnonzero(is_given.any(axis=0)).tolist()]
    return {slot.address: chosen_of_runs(slot, values) for slot, values in some}


def as_failures(errors: Mapping[int, GudgeonError]) -> tuple[Failure, ...]:
    """By the number of the run."""
    return tuple(Failure(i, errors[i]) for i in sorted(errors))


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

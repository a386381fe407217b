"""Store the results of runs: arrays that C or Python fills, lists of contacts and events, and each run read back."""

from __future__ import annotations

import math
from itertools import pairwise
from threading import get_ident
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.audit import Finding
from gudgeon.contract.boundary import (
    COUNT_NAMES,
    ENDED,
    IMPACT_COLUMN_NAMES,
    MAX_LISTED,
    N_IMPACT_COLUMNS,
    N_WORK,
    OVER,
    RESIDUAL_NAMES,
    STALLED,
    STOPPED,
    IMPACT_t_on,
)
from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators.adaptive import find_integrated_angles
from gudgeon.integrators.failure import build_findings
from gudgeon.integrators.run_arrays import RunSizes, SingleRunArrays, make_run_arrays
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import (
    IMPACT_DTYPE,
    MAX_ENVELOPE_ROWS,
    NO_CHANGE_POINTS,
    Counts,
    Envelope,
    Trajectory,
    compute_envelope_width,
    compute_time_resolution,
    convert_counts,
    fetch_events,
    join_contacts,
    make_empty_event_states,
    make_empty_events,
    remove_event_states,
    split_undefined_events,
)
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.deferred_fields import make_with_deferred_fields

# contacts that are stored in the first block, and in later ones
FIRST_BLOCK_CONTACTS, BLOCK_CONTACTS = MAX_LISTED, 16 * MAX_LISTED
AUDIT_ARRAYS = "audit_values", "audit_times", "audit_locations"  # largest value of each check, its time, its location


def _convert_contacts(numbers: Array, joints: NDArray[np.intc]) -> NDArray[Any]:
    """Convert contacts from C's values (n, N_IMPACT_COLUMNS) and joint indices (n,) to an array (IMPACT_DTYPE)."""
    impacts = np.empty(len(joints), dtype=IMPACT_DTYPE)
    impacts["joint"] = joints
    for name in (IMPACT_DTYPE.names or ())[1:]:
        impacts[name] = numbers[:, IMPACT_COLUMN_NAMES.index(name)]
    return impacts


class Contacts:
    """Collect the contacts of the runs of a batch; each thread has its own lists."""

    def __init__(self, compiled: CompiledModel) -> None:
        self.compiled, self.thread_contacts = compiled, list[_ThreadContacts]()
        self.of_thread: dict[int, _ThreadContacts] = {}  # by the thread's identity

    def fetch_contacts(self, i: int, run: Any, is_over: bool) -> None:
        """Fetch and clear C's list of ended contacts of run i; with `is_over` also the contacts that are still closed.

        `run`: C's integrator. The contacts are stored in lists of the calling thread.
        """
        fetched = self.of_thread.get(get_ident())
        if fetched is None:
            fetched = self.of_thread[get_ident()] = _ThreadContacts(self.compiled)
            self.thread_contacts.append(fetched)
        fetched.fetch_contacts(i, run, is_over)

    def join_contacts(self, n_runs: int) -> tuple[NDArray[Any], NDArray[np.int_]]:
        """Return the contacts (IMPACT_DTYPE) of all n runs sorted by run and onset, and the first index of each run.

        The contacts were fetched by several threads. The indices have the shape (n + 1,). Called once, after all
        threads have ended: the lists are cleared.
        """
        if not self.thread_contacts:
            return np.zeros(0, IMPACT_DTYPE), np.zeros(n_runs + 1, np.int_)
        runs = np.array([i for each in self.thread_contacts for i in each.runs], np.int_)
        counts = np.array([count for each in self.thread_contacts for count in each.counts], np.int_)
        begins, by_run = np.cumsum(counts) - counts, np.argsort(runs, kind="stable")
        begins, counts = begins[by_run], counts[by_run]
        run_of_contact = np.repeat(runs[by_run], counts)
        row = np.repeat(begins - (np.cumsum(counts) - counts), counts) + np.arange(len(run_of_contact))
        blocks = [block for each in self.thread_contacts for block in each.list_blocks()]
        values = np.concatenate([np.zeros((0, N_IMPACT_COLUMNS)), *(values for values, _ in blocks)])
        joints = np.concatenate([np.zeros(0, np.intc), *(joints for _, joints in blocks)])
        self.thread_contacts.clear()
        # sort by run, then onset: complex numbers are ordered by real parts first; faster than lexsort here, since the
        # rows are nearly sorted
        row = row[np.argsort(run_of_contact + 1j * values[row, IMPACT_t_on], kind="stable")]
        return _convert_contacts(values[row], joints[row]), np.searchsorted(run_of_contact, np.arange(n_runs + 1))


class _ThreadContacts:
    """Collect the contacts fetched by one thread: runs, number of contacts of each, and the contacts in blocks."""

    def __init__(self, compiled: CompiledModel) -> None:
        self.compiled, self.runs, self.counts = compiled, list[int](), list[int]()
        self.full_blocks: list[tuple[NDArray[Any], NDArray[Any]]] = []
        self._allocate_block(FIRST_BLOCK_CONTACTS)

    def _allocate_block(self, capacity: int) -> None:
        """Allocate an empty block for `capacity` contacts, with C pointers to it."""
        self.values, self.joints, self.n = np.empty((capacity, N_IMPACT_COLUMNS)), np.empty(capacity, np.intc), 0
        pointer = self.compiled.pointer
        self.pointers = pointer(self.values, is_written=True), pointer(self.joints, "int *", is_written=True)

    def fetch_contacts(self, i: int, run: Any, is_over: bool) -> None:
        """Fetch the ended contacts of run i from C into blocks, allocated as needed; with `is_over` all contacts.

        Appends i to `runs` and the number of contacts to `counts`. `run`: C's integrator, whose list is then empty.
        """
        self.runs.append(i)
        self.counts.append(0)
        while True:
            (values_pointer, joints_pointer), n_free = self.pointers, len(self.joints) - self.n
            to = values_pointer + N_IMPACT_COLUMNS * self.n, joints_pointer + self.n
            count = self.compiled.lib.gudgeon_run_impacts(run, is_over, n_free, *to)
            self.counts[-1] += count
            self.n += count
            if count < n_free:
                return
            self.full_blocks = self.list_blocks()
            self._allocate_block(BLOCK_CONTACTS)

    def list_blocks(self) -> list[tuple[NDArray[Any], NDArray[Any]]]:
        """Return all blocks, the last cut to its length: values (n, N_IMPACT_COLUMNS) and joint indices (n,)."""
        return [*self.full_blocks, (self.values[: self.n], self.joints[: self.n])]


Samples: TypeAlias = tuple[Array, Array, Array, NDArray[Any]]


class _PythonLists(NamedTuple):
    """Hold the lists of a run with a time loop in Python."""

    impacts: NDArray[Any]
    events: NDArray[Any]
    undefined_events: NDArray[Any]


class StoredRuns:
    """Store the results of runs in arrays with a row per run, or per block of samples; unreached values are NaN."""

    struct: Any  # pointers to the arrays, for C
    is_reused = False  # whether the arrays of a single run are reused by the next one

    def __init__(
        self,
        compiled: CompiledModel,
        method: str,
        p: Array,
        p_motion: Array,
        times: Times,
        step: Array,
        n_rows: int,
        in_python: bool,
    ) -> None:
        self.compiled, self.method, self.times, self.n = compiled, method, times, len(p)
        n, N, nc = self.n, times.max_count, len(compiled.source.clearances)
        n_integrated = 0 if in_python else len(find_integrated_angles(compiled.source))
        sizes = RunSizes(compiled.n, compiled.n_discrete_states, nc, compiled.n_p, n_integrated, N)
        self.arrays: dict[str, NDArray[Any]]
        if n == 1:
            self.arrays = x = SingleRunArrays.allocate(sizes)
            x["p"][0], x["p_motion"][0], x["step"][0] = p[0], p_motion[0], step[0]
        else:
            self.arrays = make_run_arrays(n, sizes) | {
                "p": p,
                "p_motion": p_motion,
                "step": step,
                "y": np.empty((n_rows, N, 2 * compiled.n + N_WORK)),
                "discrete_states": np.empty((n_rows, N, max(compiled.n_discrete_states, 1))),
                "state": np.zeros((n_rows, N, max(nc, 1)), np.int8),
            }
            self.arrays["sample_block"][:] = np.arange(n) % n_rows
        self.arrays["t_last"].fill(times.start)
        if in_python:
            self.arrays["a"] = np.full((n_rows, N, compiled.n), np.nan)
        self.python_lists: dict[int, _PythonLists] = {}
        self.fetched = Contacts(compiled)
        self.events: dict[int, list[NDArray[Any]]] = {}  # lists of events with states, of runs that have any
        # contacts by run once all are over, and each run's first index
        self.contacts, self.first_contact_indices = np.zeros(0, IMPACT_DTYPE), np.zeros(self.n + 1, np.int_)
        self.failures: dict[int, GudgeonError] = {}
        self.interrupted = False

    def allocate_envelope(self) -> None:
        """Allocate the envelope of forces and paths, and register it with C, so that new runs record it for plots."""
        joints, x = len(self.compiled.source.clearances), self.arrays
        x["envelope"] = np.empty((self.n, MAX_ENVELOPE_ROWS, compute_envelope_width(joints)))
        self.struct.envelope, self.struct.envelope_capacity = (
            self.compiled.pointer(x["envelope"], is_written=True),
            MAX_ENVELOPE_ROWS,
        )

    def _join_contacts(self) -> None:
        """Join the contacts of all runs to one array sorted by run and onset, after all runs have ended.

        They are stored in `contacts`, the index of the first contact of each run in `first_contact_indices`.
        """
        if not self.python_lists:
            if not self.fetched.thread_contacts:
                return  # they are empty already
            self.contacts, self.first_contact_indices = self.fetched.join_contacts(self.n)
            return
        each = [self.python_lists[i].impacts if i in self.python_lists else self.contacts for i in range(self.n)]
        self.contacts, self.first_contact_indices = join_contacts(each), np.cumsum([0, *map(len, each)])

    def store_trajectory(self, i: int, trajectory: Trajectory) -> None:
        """Copy the Trajectory of run i, which a time loop in Python computed, into the arrays.

        The run is marked as over. Its status tells whether it ended before its last time or was interrupted; an error
        is recorded in `failures`. Contacts and events are stored as lists.
        """
        x, k, N, n = self.arrays, int(self.arrays["sample_block"][i]), len(trajectory.t), self.compiled.n
        for columns, values in (
            (slice(n), trajectory.q),
            (slice(n, 2 * n), trajectory.v),
            (slice(2 * n, None), trajectory.work),
        ):
            x["y"][k, :N, columns] = values
        x["discrete_states"][k, :N, : self.compiled.n_discrete_states] = trajectory.memory
        x["state"][k, :N, : trajectory.state.shape[1]] = trajectory.state
        if trajectory.a is not None:
            x["a"][k, :N] = trajectory.a
        x["done"][i], x["t_last"][i], x["seconds"][i], x["phase"][i] = N, trajectory.t[-1], trajectory.seconds, OVER
        ended = ENDED if len(self.times.get_times(i)) > N or trajectory.t[-1] < self.times.get_times(i)[-1] else 0
        x["status"][i] = STOPPED if trajectory.interrupted else ended
        x["counts"][i] = [getattr(trajectory.counts, name, 0) for name in COUNT_NAMES]
        x["residuals"][i] = [getattr(trajectory.counts, name, math.nan) for name in RESIDUAL_NAMES]
        x["peaks"][i, : len(trajectory.peaks)] = trajectory.peaks
        if "n_interpolated" in x:
            x["n_interpolated"][i], x["t_interpolated"][i] = trajectory.change_points
        self.python_lists[i] = _PythonLists(trajectory.impacts, trajectory.events, trajectory.undefined_events)
        if trajectory.stopped is not None:
            self.failures[i] = trajectory.stopped

    def fetch_contacts_and_events(self, i: int, run: Any, is_over: bool) -> None:
        """Fetch, store and clear C's lists of ended contacts and of events of run i; with `is_over` all contacts."""
        if self.compiled.source.clearances:
            self.fetched.fetch_contacts(i, run, is_over)
        if self.compiled.source.events and self.compiled.lib.gudgeon_run_count_listed(run):
            self.events.setdefault(i, []).append(fetch_events(self.compiled, run, self.times.get_times(i)))

    def build_findings(self, i: int) -> tuple[Finding, ...]:
        """Return the audit findings of run i; () for runs of a time loop in Python."""
        if i in self.python_lists:
            return ()
        return build_findings(self.compiled.source, *(self.arrays[x][i] for x in AUDIT_ARRAYS))

    def get_contacts(self, i: int) -> NDArray[Any]:
        """Return the contacts (IMPACT_DTYPE) of run i, sorted by onset; a copy for runs in C."""
        if i in self.python_lists:
            return self.python_lists[i].impacts
        if not len(self.contacts):
            return np.empty(0, IMPACT_DTYPE)
        return self.contacts[self.first_contact_indices[i] : self.first_contact_indices[i + 1]].copy()

    def list_contacts(self) -> tuple[NDArray[Any], ...]:
        """Return the contacts (IMPACT_DTYPE) of each run, as views of one array; called after all runs have ended."""
        if not len(self.contacts):
            return (self.contacts,) * self.n
        return tuple(self.contacts[a:b] for a, b in pairwise(self.first_contact_indices.tolist()))

    def list_events(self) -> tuple[NDArray[Any], ...]:
        """Return the user events (EVENT_DTYPE) of each run, by time."""
        events = [make_empty_events()] * self.n
        for i in (*self.events, *self.python_lists):
            events[i] = remove_event_states(self._get_events(i)[0])
        return tuple(events)

    def _get_events(self, i: int) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return the user events of run i by time, and the times from which events are not numbers; both may be empty.

        For runs in C both contain the states there (build_event_dtype), and events after the last sample are dropped.
        """
        if i in self.python_lists:
            return self.python_lists[i].events, self.python_lists[i].undefined_events
        if i not in self.events:
            return (empty := make_empty_event_states(self.compiled)), empty
        x, times = self.arrays, self.times.get_times(i)
        events, undefined = split_undefined_events(self.compiled, np.concatenate(self.events[i]))
        if x["status"][i] not in (0, ENDED, STOPPED) or not x["done"][i]:
            return events, undefined
        t_last = self.get_reached_times(i)[-1] + compute_time_resolution(times)
        return events[events["t"] <= t_last], undefined[undefined["t"] <= t_last]

    def is_complete(self, i: int) -> bool:
        """Return whether run i has a sample at the last of its output times and was not interrupted."""
        reached = self.get_reached_times(i)
        return self.arrays["status"][i] != STOPPED and len(reached) > 0 and reached[-1] >= self.times.get_times(i)[-1]

    def get_counts(self, i: int) -> Counts:
        """Return the counts, sums and maxima over the steps of run i."""
        return convert_counts(self.arrays["counts"][i], self.arrays["residuals"][i])

    def get_samples(self, i: int) -> Samples:
        """Return the reached sample times (k,) of run i in s, and views of states, discrete states and contact codes.

        States are (k, 2n + 3): q, q̇ and works.
        """
        return self._get_samples(i, self.arrays)

    def _get_samples(self, i: int, arrays: dict[str, NDArray[Any]]) -> Samples:
        """Return the samples of run i as `get_samples`, as views of `arrays`, which may be a copy of the arrays."""
        compiled, k, t = self.compiled, self.arrays["sample_block"].item(i), self.get_reached_times(i)
        N, joints = len(t), len(compiled.source.clearances)
        memory, state = arrays["discrete_states"][k, :N, : compiled.n_discrete_states], arrays["state"][k, :N, :joints]
        return t, arrays["y"][k, :N], memory, state

    def get_accelerations(self, i: int) -> Array | None:
        """Return a view of q̈ (k, n) at the samples of run i if a time loop in Python computed it; else None."""
        a: Array | None = self.arrays.get("a")
        return None if a is None else a[self.arrays["sample_block"][i], : self.arrays["done"][i]]

    def get_reached_times(self, i: int) -> Array:
        """Return a copy of the sample times (s) that run i reached.

        If an event, Ctrl-C or a stall ended it, the last one is the time of its end.
        """
        done = self.arrays["done"].item(i)
        t = self.times.get_times(i)[:done].copy()
        if done and self.arrays["status"].item(i) in (ENDED, STOPPED, STALLED):
            t[-1] = self.arrays["t_last"][i]
        return t

    def build_trajectory(self, i: int) -> Trajectory:
        """Return run i as a Trajectory: copies of its rows, or views if it is the only run without reused arrays.

        Arrays of a single run are made at their first use. `stopped` of an interrupted run is None.
        """
        x, driven = self.arrays, i in self.python_lists
        kept = x.copy_block() if self.is_reused and isinstance(x, SingleRunArrays) else x
        a, error, status = self.get_accelerations(i), self.failures.get(i), x["status"].item(i)
        is_stopped = status == STOPPED or (self.n == 1 and self.interrupted)
        values: dict[str, Any] = {
            "t": self.get_reached_times(i),
            "a": a.copy() if a is not None and self.n > 1 else a,
            "interrupted": is_stopped,
            "stopped": error if isinstance(error, SolverError) and not is_stopped else None,
            "seconds": x["seconds"].item(i),
            "change_points": self._get_change_points(i),
            "block": kept if isinstance(kept, SingleRunArrays) and a is None and not driven else None,
        }
        envelope = x["envelope"][i, : x["n_envelope_rows"].item(i)].copy() if "envelope" in x else None
        events = self._get_events(i) if driven or i in self.events else None
        impacts = self.get_contacts(i) if driven or len(self.contacts) else None
        k = 0 if self.n == 1 else x["sample_block"].item(i)
        samples = kept, i, k, len(values["t"])
        later = _TrajectoryParts(self.compiled, samples, driven, a is None, impacts, events, envelope)
        if self.n > 1:
            later.copy_rows()
            return Trajectory(**values, **{name: getattr(later, name)() for name in later.fields})
        return make_with_deferred_fields(Trajectory, values, later)

    def _get_change_points(self, i: int) -> tuple[int, float]:
        """Return the number of samples of run i at or near a change point, and the time (s) of the first."""
        if "n_interpolated" not in self.arrays:
            return NO_CHANGE_POINTS
        return int(self.arrays["n_interpolated"][i]), float(self.arrays["t_interpolated"][i])


class _TrajectoryParts:
    """Build fields of a run's Trajectory at their first access, from arrays that do not change later.

    `samples`: the arrays, the run's row, its row of samples and their number N. `impacts`, `events`: contacts; user
    events, and the times from which events are not numbers; None: there are none. `envelope`: rows as C writes them.
    """

    fields: tuple[str, ...] = (
        *("q", "v", "memory", "state", "work", "peaks", "counts", "impacts"),
        *("events", "event_states", "undefined_events", "trace", "audit"),
    )

    def __init__(
        self,
        compiled: CompiledModel,
        samples: tuple[dict[str, NDArray[Any]], int, int, int],
        is_driven: bool,
        has_event_states: bool,
        impacts: NDArray[Any] | None,
        events: tuple[NDArray[Any], NDArray[Any]] | None,
        envelope: Array | None,
    ) -> None:
        self.compiled, self.is_driven, self.has_event_states = compiled, is_driven, has_event_states
        self.arrays, self.i, self.k, self.n_samples = samples
        self.contacts, self.found, self.envelope = impacts, events, envelope

    def copy_rows(self) -> None:
        """Copy the run's rows of all arrays, so that its fields are not views of the arrays of a batch."""
        x, k, i = self.arrays, self.k, self.i
        self.arrays = {name: x[name][k : k + 1, : self.n_samples].copy() for name in ("y", "discrete_states", "state")}
        names = "peaks", "counts", "residuals", "audit_values", "audit_times", "audit_locations"
        self.arrays |= {name: x[name][i : i + 1].copy() for name in names}
        self.k = self.i = 0

    def _view_motion(self, first: int, end: int) -> Array:
        """Return columns of the samples: q, q̇ (n each) and works."""
        return self.arrays["y"][self.k, : self.n_samples, first:end]

    def q(self) -> Array:
        """Return the coordinates (N, n)."""
        return self._view_motion(0, self.compiled.n)

    def v(self) -> Array:
        """Return the velocities (N, n)."""
        return self._view_motion(self.compiled.n, 2 * self.compiled.n)

    def work(self) -> Array:
        """Return the works (N, 3)."""
        return self._view_motion(2 * self.compiled.n, 2 * self.compiled.n + N_WORK)

    def memory(self) -> Array:
        """Return the discrete states (N, n_discrete_states)."""
        return self.arrays["discrete_states"][self.k, : self.n_samples, : self.compiled.n_discrete_states]

    def state(self) -> NDArray[Any]:
        """Return the contact codes (N, n_clearances)."""
        return self.arrays["state"][self.k, : self.n_samples, : len(self.compiled.source.clearances)]

    def peaks(self) -> Array:
        """Return the peaks (n_clearances, 3)."""
        return self.arrays["peaks"][self.i, : len(self.compiled.source.clearances)]

    def counts(self) -> Counts:
        """Return the counts, sums and maxima over the steps."""
        return convert_counts(self.arrays["counts"][self.i], self.arrays["residuals"][self.i])

    def impacts(self) -> NDArray[Any]:
        """Return the contacts (IMPACT_DTYPE)."""
        return np.empty(0, IMPACT_DTYPE) if self.contacts is None else self.contacts

    def _get_events(self, k: int) -> NDArray[Any]:
        """Return the events (k = 0), or those that are not numbers (k = 1)."""
        return make_empty_event_states(self.compiled) if self.found is None else self.found[k]

    def events(self) -> NDArray[Any]:
        """Return the events without states."""
        return remove_event_states(self._get_events(0))

    def event_states(self) -> NDArray[Any] | None:
        """Return the events with states; None for a kinematic run."""
        return self._get_events(0) if self.has_event_states else None

    def undefined_events(self) -> NDArray[Any]:
        """Return the times from which on events are not numbers."""
        return remove_event_states(self._get_events(1))

    def trace(self) -> Envelope | None:
        """Return the envelope of forces and paths; None if none was recorded."""
        joints = len(self.compiled.source.clearances)
        return None if self.envelope is None else Envelope.from_rows(self.envelope, joints)

    def audit(self) -> tuple[Finding, ...]:
        """Return the findings of the audit of steps; () for a run of a time loop in Python."""
        rows = (self.arrays[x][self.i] for x in AUDIT_ARRAYS)
        return () if self.is_driven else build_findings(self.compiled.source, *rows)

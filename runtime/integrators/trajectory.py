"""Define the input and output of every integration method: initial value problem, trajectory, step counts, events."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cache
from operator import itemgetter
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.audit import Finding
from gudgeon.contract.boundary import (
    COUNT_NAMES,
    ENVELOPE_COLUMN_NAMES,
    MAX_LISTED,
    N_ENVELOPE_COLUMNS,
    N_WORK,
    RESIDUAL_NAMES,
)
from gudgeon.errors import SolverError
from gudgeon.integrators.steps import StepCallback
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.deferred_fields import defer_fields

if TYPE_CHECKING:
    from gudgeon.integrators.run_arrays import SingleRunArrays
    from gudgeon.results.state import State

IMPACT_DTYPE = np.dtype(
    [("joint", "i4"), ("t_on", "f8"), ("t_off", "f8"), ("deltadot", "f8"), ("F_peak", "f8"), ("t_peak", "f8")]
)

NO_CHANGE_POINTS = 0, float("nan")
Progress: TypeAlias = Callable[[float, str], None]  # called with the fraction done, and what is being done
EVENT_DTYPE = np.dtype([("event", "i4"), ("t", "f8")])  # index into KernelSource.events, time in s
MAX_ENVELOPE_ROWS = 4096  # largest number of rows of an envelope; it is even
TRACED = {
    "F_low": ("N", "smallest force since the previous row"),
    "t_F_low": ("s", "time of F_low"),
    "F_high": ("N", "largest force since the previous row"),
    "t_F_high": ("s", "time of F_high"),
    "ex_out": ("m", "eccentricity of largest magnitude since the previous row, x"),
    "ey_out": ("m", "eccentricity of largest magnitude since the previous row, y"),
    "t_out": ("s", "time of ex_out and ey_out"),
    "ex": ("m", "eccentricity at the row's end, x"),
    "ey": ("m", "eccentricity at the row's end, y"),
}
TRACE_COLUMNS = tuple(TRACED)
_TRACE_POSITIONS = np.array([ENVELOPE_COLUMN_NAMES.index(name) for name in TRACE_COLUMNS])  # in a row that C writes
EPSILON = float(np.finfo(np.float64).eps)


@cache
def build_event_dtype(n: int, n_discrete_states: int, n_clearances: int) -> np.dtype[Any]:
    """Return NumPy's type of a user event with its state; cached by sizes (functools).

    Fields: `event` (its number), `t` (s), `y` (q and v, n each, and the works), `memory` (discrete states), `state`
    (contact code of each joint with play).
    """
    state_fields = [
        ("y", "f8", (2 * n + N_WORK,)),
        ("memory", "f8", (n_discrete_states,)),
        ("state", "i1", (n_clearances,)),
    ]
    return np.dtype([("event", "i4"), ("t", "f8"), *state_fields])


def remove_event_states(events_with_states: NDArray[Any]) -> NDArray[Any]:
    """Return a copy of events without their states (EVENT_DTYPE): index and time."""
    events = np.zeros(len(events_with_states), dtype=EVENT_DTYPE)
    if not len(events):
        return events
    events["event"], events["t"] = events_with_states["event"], events_with_states["t"]
    return events


def make_empty_events() -> NDArray[Any]:
    """Return an empty array of events (EVENT_DTYPE)."""
    return np.zeros(0, dtype=EVENT_DTYPE)


def join_contacts(lists: Iterable[NDArray[Any]]) -> NDArray[Any]:
    """Return arrays of contacts (IMPACT_DTYPE) concatenated, through their bytes: faster than numpy.concatenate."""
    return np.frombuffer(bytearray().join(lists), IMPACT_DTYPE)  # type: ignore[arg-type]


@dataclass(eq=False)  # not frozen: setting the fields of a frozen one takes longer
class Problem:
    """Define a run: a scene with parameter values, a start, and the times of the samples (the first is the start)."""

    compiled: CompiledModel
    p: Array
    t: Array  # (N,), increasing
    q: Array  # (n,)
    v: Array
    memory: Array  # (n_clearances + n_frictions,) δ̇⁻ of closed contacts, modes of friction; NaN: free, unknown
    step: float  # s, of a method with fixed step; inf: the method controls it
    progress: Progress | None = None
    state: NDArray[Any] | None = None  # (n_clearances,) int8 codes of the run that this one resumes
    method: str = "rk4"
    rtol: float = 0.0  # tolerance of methods that control their step
    p_motion: Array | None = None  # p without Baumgarte's gains; None: p, for methods that use them
    stop: bool = True  # whether events may end the run; else they are recorded only
    remarks: tuple[str, ...] = ()  # notes on the start, which come first in the run's notes
    start_is_sample: bool = True  # False: t[0] was not requested
    audit: int = 1  # level of the audit (contract/audit.py)
    resumed_state: State | None = None  # state that the run resumes from
    observer: StepCallback | None = None  # observer of all steps
    poll_cancellation: Callable[[], object] = lambda: None  # raises KeyboardInterrupt after Ctrl-C (cancellation.py)

    @property
    def values_of_motion(self) -> Array:
        """Return the parameter values with which the method integrates and the samples are evaluated."""
        return self.p if self.p_motion is None else self.p_motion


class Counts(NamedTuple):
    """Sums and maxima over all accepted steps; see Diagnostics for the meaning of each."""

    steps: int
    right_hand_sides: int
    onsets: int = 0
    phi_max: float = 0.0
    phi_dot_max: float = 0.0
    ratio_min: float = float("nan")
    ratio_max: float = float("nan")
    ratio_outside: int = 0
    switches: int = 0
    rejected: int = 0
    jacobians: int = 0
    stiff_steps: int = 0
    speed_max: float = float("nan")  # m/s, of the integrated lengths at the ends of steps; NaN: not recorded
    omega_max: float = float("nan")  # rad/s, of the integrated angles


# names of the counts that batches and files store; the largest speeds are used by the audit of single runs only
STORED_COUNTS = tuple(name for name in Counts._fields if name not in ("speed_max", "omega_max"))
_select_counts = itemgetter(*map((*COUNT_NAMES, *RESIDUAL_NAMES).index, Counts._fields))


def convert_counts(counts: NDArray[Any], residual_values: Array) -> Counts:
    """Convert C's arrays (N_COUNTS,) and (N_RESIDUALS,) of a run to Counts; infinite residuals become NaN."""
    values = counts.tolist()
    values += [x if -math.inf < x < math.inf else math.nan for x in residual_values.tolist()]
    return Counts._make(_select_counts(values))


def convert_counts_of_runs(counts: NDArray[Any], residual_values: Array) -> dict[str, NDArray[Any]]:
    """Return arrays (n,) by the names STORED_COUNTS, from C's (n, N_COUNTS) and (n, N_RESIDUALS) of n runs.

    Residuals that are not finite become NaN.
    """
    counts_by_name = dict(zip(COUNT_NAMES, counts.T.copy(), strict=True))
    finite = np.where(np.isfinite(residual_values), residual_values, math.nan)
    counts_by_name |= dict(zip(RESIDUAL_NAMES, finite.T.copy(), strict=True))
    return {name: counts_by_name[name] for name in STORED_COUNTS}


@defer_fields(
    *("q", "v", "memory", "state", "work", "impacts", "peaks", "counts"),
    *("audit", "trace", "events", "event_states", "undefined_events"),
)
@dataclass(frozen=True)
class Trajectory:
    """Hold the N samples of a run or, when it was stopped or interrupted, those that were reached.

    If an event ended the run, the last sample and the last of `events` are at its time. After Ctrl-C, or if the run no
    longer advanced, the last sample is the state reached then.
    """

    t: Array
    q: Array  # (N, n)
    v: Array
    a: Array | None  # (N, n); None: the method does not compute them
    memory: Array  # (N, n_clearances + n_frictions)
    state: NDArray[Any]  # (N, n_clearances) int8
    work: Array  # (N, 3) J: drives, applied forces, joints with play
    impacts: NDArray[Any]  # results.IMPACT_DTYPE
    peaks: Array  # (n_clearances, 3): F, t, e_max
    counts: Counts
    interrupted: bool = False
    stopped: SolverError | None = None
    seconds: float = 0.0  # spent in the time loop
    events: NDArray[Any] = field(default_factory=make_empty_events)  # EVENT_DTYPE, by time
    event_states: NDArray[Any] | None = None  # events with states (build_event_dtype); None: the method stores none
    trace: Envelope | None = None  # forces and paths from the steps; None: the method stores none
    audit: tuple[Finding, ...] = ()  # largest value of each check
    # EVENT_DTYPE: times from which on an event is not a number
    undefined_events: NDArray[Any] = field(default_factory=make_empty_events)
    change_points: tuple[int, float] = NO_CHANGE_POINTS  # samples at or near one, and the time of the first (s)
    block: SingleRunArrays | None = None  # of a single run in C: the arrays of which the samples are views


@dataclass(frozen=True, eq=False)
class Envelope:
    """Hold the envelope of forces and paths: R rows, each of the same number of steps except the last."""

    t: Array  # (R,) s, the end of the row's last step
    joints: Array  # (R, n_clearances, 9) as TRACE_COLUMNS has them, SI

    @staticmethod
    def from_rows(rows: Array, clearances: int) -> Envelope:
        """Build the envelope from the rows (R, width) that C writes, keeping only TRACE_COLUMNS."""
        joints = rows[:, 1:].reshape(len(rows), clearances, N_ENVELOPE_COLUMNS)
        return Envelope(rows[:, 0].copy(), joints[:, :, _TRACE_POSITIONS])


def compute_envelope_width(clearances: int) -> int:
    """Return the number of values in a row of the envelope."""
    return 1 + N_ENVELOPE_COLUMNS * clearances


def compute_time_resolution(t: Array) -> float:
    """Return the time difference (s) up to which an event and a sample coincide in a run with output times t (N,)."""
    return max(32 * EPSILON * float(abs(t[[0, -1]]).max()), min(1e-11, 1e-10 * float(t[-1] - t[0])))


def make_empty_event_states(compiled: CompiledModel) -> NDArray[Any]:
    """Return an empty array of events with states (build_event_dtype)."""
    return np.zeros(0, dtype=build_event_dtype(compiled.n, compiled.n_discrete_states, len(compiled.source.clearances)))


def fetch_events(compiled: CompiledModel, run: Any, times: Array) -> NDArray[Any]:
    """Fetch and clear C's list of user events of a run, and return them with states (build_event_dtype).

    The fields are the event's index, its time t (s), the state y, the discrete states (field "memory") and the contact
    codes (field "state"). Events at the start are left out. `run`: C's integrator; `times`: output times of the run. An
    index k beyond the scene's n events means that event k − n is not a number from that time on.
    """
    n_joints, n_rows = len(compiled.source.clearances), MAX_LISTED if compiled.source.events else 1
    t, event = np.zeros(n_rows), np.zeros(n_rows, dtype=np.intc)
    y, discrete_states = (
        np.zeros((n_rows, max(width, 1))) for width in (2 * compiled.n + N_WORK, compiled.n_discrete_states)
    )
    state = np.zeros((n_rows, max(n_joints, 1)), dtype=np.int8)
    arrays = (
        compiled.pointer(t),
        compiled.pointer(event, "int *"),
        compiled.pointer(y),
        compiled.pointer(discrete_states),
        compiled.pointer(state, "signed char *"),
    )
    blocks, count = [make_empty_event_states(compiled)], n_rows
    while count == n_rows:
        count = compiled.lib.gudgeon_run_events(run, n_rows, *arrays)
        block = np.zeros(count, dtype=blocks[0].dtype)
        block["event"], block["t"], block["y"] = event[:count], t[:count], y[:count]
        block["memory"] = discrete_states[:count, : compiled.n_discrete_states]
        block["state"] = state[:count, :n_joints]
        blocks.append(block)
    fetched = np.concatenate(blocks)
    is_undefined = fetched["event"] >= len(compiled.source.events)
    return fetched[is_undefined | (fetched["t"] > times[0] + compute_time_resolution(times))]


def split_undefined_events(compiled: CompiledModel, events: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Split events as C lists them into events sorted by time, and those that are undefined from a time on.

    C lists the latter with indices from the number of events on, which is subtracted here. Both have the type of
    `events`.
    """
    ordered = events[np.argsort(events["t"], kind="stable")]
    number = ordered["event"] < len(compiled.source.events)
    undefined = ordered[~number]
    undefined["event"] -= len(compiled.source.events)
    return ordered[number], undefined

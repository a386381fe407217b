"""Define the lubricated and the dry nine-bar press for other solvers, by hand-written dense C (press_peer.c).

Press there: l5 = .25 m, no gravity, forces at one point in the middle of the penetration, K with "+".

- *lubricated*: c = .6 mm, ω = 5π, T = .4 s.
- *dry*: c = .3 mm, ω = 2π, T = .05 s, every onset and separation located.

Errors, the same for every method, over 201 equally spaced outputs against the reference:

- *slider*: the largest |Δy9| over the stroke of the ideal press;
- *path*: the largest deviation of a journal's path |Δe| over the clearance;
- *onset*: the largest difference of an onset's time (s), infinite where the number of onsets differs.

References come from the hand-written C and nothing of gudgeon: lubricated SciPy's DOP853 at rtol 1e-13, dry a method
of order 12 in long double that ends a step at every bend (reference.py); `reference_gap` is what a second method says.
"""

from __future__ import annotations

import math
import shutil
import subprocess
import tempfile
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from cffi import FFI

from benchmarks.peers.timing import CallTimer
from tests.oracles import ideal_press, press_dense

FOLDER = Path(__file__).resolve().parent
FLAGS = ("-std=gnu11", "-O3", "-march=native", "-shared", "-fPIC")
OUTPUTS = 201
DECLARATIONS = """
typedef struct {
    double length[8], mass[8], inertia[8];
    double l5, hx, hy, gravity, theta1, theta4, omega1, omega4, alpha, beta, radius, clearance, width;
    double young, poisson, exponent, restitution, mu, v0, v1, floor, viscosity, transition;
    double conformal, film, common_point;
} Press;
typedef struct { Press press; double stored[2]; long calls; double *(*array)(void *); double *(*matrix)(void *); } Peer;
int peer_rhs(Peer *, double, const double *, double *);
int peer_jacobian(Peer *, double, const double *, const double *, double *);
void peer_gaps(const Peer *, const double *, double *);
double peer_seconds_per_rhs(const Peer *, double, const double *, int, int);
int peer_cvode_rhs(double, void *, void *, void *);
int peer_cvode_jacobian(double, void *, void *, void *, void *, void *, void *, void *);
int peer_cvode_gaps(double, void *, double *, void *);
"""
LSODA_ATOL = 1e-3  # of rtol, as for CVODE


def compile_library(source: str, declarations: str) -> tuple[FFI, Any]:
    """Compile a C file of this folder and open the library. Raises RuntimeError without a compiler."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        raise RuntimeError("the peers need a C compiler")
    folder = tempfile.mkdtemp(prefix="peer_")
    target = Path(folder) / (Path(source).stem + ".so")
    subprocess.run([compiler, *FLAGS, str(FOLDER / source), "-o", str(target), "-lm"], check=True)
    ffi = FFI()
    ffi.cdef(declarations)
    library = ffi.dlopen(str(target))
    shutil.rmtree(folder)  # the opened library stays mapped
    return ffi, library


@cache
def library() -> tuple[FFI, Any]:
    """Return cffi's FFI and the library of press_peer.c."""
    return compile_library("press_peer.c", DECLARATIONS)


@dataclass(frozen=True)
class Work:
    """A problem of the race: data of the press, end (s), and parameters of gudgeon for the same problem."""

    name: str
    press: press_dense.Press
    t_end: float

    @property
    def times(self) -> np.ndarray:
        """Return the output times (OUTPUTS,) in s."""
        return np.linspace(0.0, self.t_end, OUTPUTS)

    @property
    def stroke(self) -> float:
        """Return the stroke of the ideal press over a revolution in m."""
        geometry = self.press.geometry
        y = ideal_press.motion(np.linspace(0.0, 2.0 * math.pi / geometry.omega1, 2001), geometry).q[:, 22]
        return float(np.ptp(y))

    @property
    def parameters(self) -> dict[str, float]:
        """Return the parameters for `Simulation.simulate`."""
        p = self.press
        return {"l5": p.geometry.l5, "c": p.clearance, "omega": p.geometry.omega1, "gravity.y": -p.gravity}


@dataclass(frozen=True)
class Samples:
    """Outputs of a run: q (N, 24), m and rad; times of onset (s) of A and of B."""

    q: np.ndarray
    onsets: tuple[np.ndarray, np.ndarray]


Run = tuple[Samples, CallTimer, int]  # outputs, cost, right-hand sides


@dataclass(frozen=True)
class Errors:
    """Errors as defined above: slider and path are ratios, onset is in s."""

    slider: float
    path: float
    onset: float


def work(name: str) -> Work:
    """Return one of the two problems by its name, "lubricated" or "dry"."""
    film = name == "lubricated"
    c, omega, t_end = (0.6e-3, 5.0 * math.pi, 0.4) if film else (0.3e-3, 2.0 * math.pi, 0.05)
    press = press_dense.Press(clearance=c, gravity=0.0, film=film, common_point=True).at_speed(omega)
    return Work(name, replace(press, geometry=replace(press.geometry, l5=0.25)), t_end)


class Kernel:
    """Right-hand side for Python's solvers, with minimal overhead of cffi."""

    def __init__(self, work: Work) -> None:
        """Copy the data of the press to C."""
        self.ffi, self.c = library()
        self.peer = self.ffi.new("Peer *")
        data = bytes(press_dense._struct(work.press))
        self.ffi.memmove(self.ffi.addressof(self.peer.press), data, len(data))
        self.y0 = press_dense.start(work.press)
        self.gaps_buffer = np.empty(6)
        self._gaps = self.ffi.from_buffer("double[]", self.gaps_buffer)

    def rhs(self, t: float, y: np.ndarray) -> np.ndarray:
        """Return ẏ as a new array, since solvers store the arrays that they get."""
        dy = np.empty(48)
        self.c.peer_rhs(self.peer, t, self.ffi.from_buffer("double[]", y), self.ffi.from_buffer("double[]", dy))
        return dy

    def into(self, t: float, y: np.ndarray, dy: np.ndarray) -> None:
        """Write ẏ into dy."""
        self.c.peer_rhs(self.peer, t, self.ffi.from_buffer("double[]", y), self.ffi.from_buffer("double[]", dy))

    def jacobian(self, t: float, y: np.ndarray) -> np.ndarray:
        """Return ∂ẏ/∂y (48, 48) by forward differences in C."""
        columns, cast = np.empty((48, 48)), self.ffi.from_buffer
        f = self.rhs(t, y)
        self.c.peer_jacobian(self.peer, t, cast("double[]", y), cast("double[]", f), cast("double[]", columns))
        return columns.T

    def gaps(self, y: np.ndarray) -> np.ndarray:
        """Return δ (m), δ̇ and slip (m/s), each of A and B, in a buffer that the next call overwrites."""
        self.c.peer_gaps(self.peer, self.ffi.from_buffer("double[]", y), self._gaps)
        return self.gaps_buffer

    @property
    def seconds_per_rhs(self) -> float:
        """Return the smallest time of one right-hand side at the start in C, in s."""
        y = self.ffi.from_buffer("double[]", self.y0)
        return float(self.c.peer_seconds_per_rhs(self.peer, 0.0, y, 5000, 7))


def errors(work: Work, found: Samples, exact: Samples) -> Errors:
    """Return the errors as defined above."""
    slider = float(np.abs(found.q[:, 22] - exact.q[:, 22]).max()) / work.stroke
    path = float(np.hypot(*np.moveaxis(paths(work, found.q) - paths(work, exact.q), 2, 0)).max())
    onset = 0.0
    for mine, true in zip(found.onsets, exact.onsets, strict=True):
        same = len(mine) == len(true)
        onset = max(onset, float(np.abs(mine - true).max(initial=0.0)) if same else math.inf)
    return Errors(slider, path / work.press.clearance, onset)


def paths(work: Work, q: np.ndarray) -> np.ndarray:
    """Return the eccentricities e of A and B (N, 2, 2) in m, in ground axes."""
    geometry, out = work.press.geometry, []
    for i, j, li, lj in ((0, 1, geometry.l1, geometry.l2), (3, 2, geometry.l4, geometry.l3)):
        bearing, journal = q[:, 3 * i : 3 * i + 3], q[:, 3 * j : 3 * j + 3]
        ends = [
            body[:, :2] + side * length / 2.0 * np.stack([np.cos(body[:, 2]), np.sin(body[:, 2])], axis=1)
            for body, side, length in ((bearing, 1.0, li), (journal, -1.0, lj))
        ]
        out.append(ends[1] - ends[0])
    return np.stack(out, axis=1)


def with_events(kernel: Kernel, work: Work, kinks: bool = False, **options: Any) -> Samples:
    """Integrate by SciPy's solve_ivp from event to event: onsets and separations are located, δ̇⁻ is stored there.

    Every event ends a piece; the next piece starts there with the right-hand value. A joint is monitored only for its
    next possible event (onset when open, separation when closed), so that a restart on either side of zero is harmless.
    `kinks`: a piece also ends where the slip of a closed joint passes ±v0 or ±v1, so that error estimates of high order
    are valid (for the reference only).
    """
    from scipy.integrate import solve_ivp

    times, t, y, closed = work.times, 0.0, kernel.y0, [False, False]
    kernel.peer.stored = [0.0, 0.0]
    onsets: tuple[list[float], list[float]] = ([], [])
    rows = np.empty((len(times), 24))
    rows[0] = y[:24]
    while t < work.t_end:
        left = times > t
        events = [_crossing(kernel, k, 0.0, -1.0 if closed[k] else 1.0) for k in (0, 1)]
        if kinks:
            events += _bends(kernel, work, y, closed)
        s = solve_ivp(kernel.rhs, (t, work.t_end), y, t_eval=times[left], events=events, **options)
        if s.status < 0:
            raise FloatingPointError(s.message)
        if len(s.t):
            rows[np.flatnonzero(left)[: len(s.t)]] = s.y[:24].T
        if s.status == 0:
            break
        found = next(k for k in range(len(events)) if len(s.t_events[k]))
        t, y = float(s.t_events[found][-1]), s.y_events[found][-1].copy()
        if found < 2:
            switch(kernel, work, y, found, closed, onsets[found], t)
    return Samples(rows, (np.array(onsets[0]), np.array(onsets[1])))


def switch(
    kernel: Kernel, work: Work, y: np.ndarray, joint: int, closed: list[bool], onsets: list[float], t: float
) -> None:
    """Open or close a joint: an onset stores δ̇⁻ and its time, a separation deletes δ̇⁻."""
    closed[joint] = not closed[joint]
    if closed[joint]:
        onsets.append(t)
    kernel.peer.stored[joint] = max(kernel.gaps(y)[2 + joint], work.press.floor) if closed[joint] else 0.0


def _crossing(kernel: Kernel, index: int, level: float, direction: float) -> Any:
    """Return a terminal event of solve_ivp: entry `index` of the gaps passes `level`."""

    def function(_: float, y: np.ndarray) -> float:
        """Return the distance from the level."""
        return float(kernel.gaps(y)[index]) - level

    function.terminal, function.direction = True, direction  # type: ignore[attr-defined]
    return function


def _bends(kernel: Kernel, work: Work, y: np.ndarray, closed: list[bool]) -> list[Any]:
    """Return events at the levels ±v0, ±v1 of each closed joint's slip, with the direction from the present slip.

    A slip within rounding of a level has just reached it and is not monitored.
    """
    events, slip = [], kernel.gaps(y)[4:].copy()
    for joint in (0, 1):
        for level in (-work.press.v1, -work.press.v0, work.press.v0, work.press.v1):
            if closed[joint] and abs(slip[joint] - level) > 1e-12:
                events.append(_crossing(kernel, 4 + joint, level, 1.0 if slip[joint] < level else -1.0))
    return events


@cache
def reference(name: str) -> Samples:
    """Return the reference solution as defined above."""
    if name == "dry":
        from benchmarks.peers import reference as long_double

        return long_double.samples()
    return dop853(name)


def dop853(name: str) -> Samples:
    """Integrate by SciPy's DOP853 on the hand-written C at rtol 1e-13; dry with short steps for accurate events."""
    task = work(name)
    options: dict[str, Any] = {} if task.press.film else {"kinks": True, "max_step": 1e-6}
    return with_events(Kernel(task), task, method="DOP853", rtol=1e-13, atol=1e-15, **options)


def reference_gap(name: str) -> Errors:
    """Return the errors of a second method: dry DOP853, lubricated RK4 with a step of 2e-6 s."""
    task = work(name)
    if name == "dry":
        return errors(task, dop853(name), reference(name))
    run = press_dense.rk4(task.press, task.t_end, 2e-6, every=1000)
    return errors(task, Samples(run.q, (np.empty(0), np.empty(0))), reference(name))


def lsoda(work: Work, rtol: float, with_jacobian: bool = False) -> Run:
    """Return a run of SciPy's LSODA, from event to event.

    LSODA differences the right-hand side, or gets all 48 columns by one call of C.
    """
    kernel = Kernel(work)
    options: dict[str, Any] = {"jac": kernel.jacobian} if with_jacobian else {}
    kernel.peer.calls = 0
    timer = CallTimer()
    with timer.engine:
        samples = with_events(kernel, work, method="LSODA", rtol=rtol, atol=LSODA_ATOL * rtol, **options)
    return samples, timer.stop(), int(kernel.peer.calls)


def lsoda_with_jacobian(work: Work, rtol: float) -> Run:
    """Return a run of LSODA with the Jacobian from C."""
    return lsoda(work, rtol, with_jacobian=True)


def rk4(work: Work, step: float) -> Run:
    """Return a run of classical RK4 with a fixed step (s) in C, which lists no onsets."""
    every = max(1, round(work.t_end / (OUTPUTS - 1) / step))
    h = work.t_end / ((OUTPUTS - 1) * every)
    timer = CallTimer()
    with timer.engine:
        found = press_dense.rk4(work.press, work.t_end, h, every=every)
    nothing = np.full(0, np.nan)
    return Samples(found.q, (nothing, nothing)), timer.stop(), 4 * every * (OUTPUTS - 1)

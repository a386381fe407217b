"""Measure one evaluation of the right-hand side, full, reduced and hand-written: time and operations.

    python -m benchmarks.rhs                # from the repository's root, with gudgeon installed
    python -m benchmarks.rhs --callgrind    # instructions too, counted by valgrind

Each problem is timed at one state of its motion. The results there are printed: a checksum, a few accelerations, |Φ|
and |Φ̇|, and the differences of reduced, full and hand-written right-hand sides. The reference code for the press is the
dense C of tests/oracles (44 × 44, Gaussian elimination). For Andrews' squeezer it is jitcode's C, called from Python,
if that is installed.
"""

from __future__ import annotations

import argparse
import math
import os
import platform
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter

import numpy as np

import gudgeon
from benchmarks import callgrind
from gudgeon.contract.boundary import N_WORK
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.methods import count_rhs_operations
from tests.oracles import press_dense
from tests.oracles.press_dense import Press

BAR = 0.15  # µs, required time of a reduced right-hand side
ROUNDS, BATCH = 12, 20_000  # rounds in which all take turns (the smallest time counts), calls in a round
SHOWN = 3  # accelerations that are printed
# Widest first, by the flag that Linux has for each
VECTORS = {"avx512f": "AVX-512", "avx2": "AVX2", "avx": "AVX", "sse2": "SSE2", "sve": "SVE", "asimd": "Neon"}
DENSE = "double press_seconds_per_rhs(const void *p, double t, const double *y, int batch, int repeats);"


@dataclass(frozen=True)
class Work:
    """A state of a run: t (s), q and v (n,), stored contact states; `closed` are the joints in contact."""

    name: str
    simulation: Simulation
    t: float
    q: np.ndarray
    v: np.ndarray
    memory: np.ndarray
    closed: tuple[str, ...]
    peer: Press | None  # the same press for the dense C

    @cached_property
    def tree(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the state in tree coordinates: s and its rate."""
        model, n = self.simulation.compiled, len(self.simulation.source.tree_coordinates)
        s, rate = np.zeros(n + 1), np.zeros(n + 1)
        model.lib.gudgeon_reduce(self.t, *map(model.pointer, (self.q, self.v, self.simulation.p, s, rate)))
        return s, rate

    @cached_property
    def state(self) -> np.ndarray:
        """Return the state y of the full formulation."""
        return np.concatenate([self.q, self.v, np.zeros(N_WORK)])

    @property
    def operations(self) -> tuple[int, int]:
        """Return the operations of the full and of the reduced right-hand side at this state, with force laws."""
        counts = self.simulation.source.operations
        full = count_rhs_operations(self.simulation, list(self.closed))
        return full, full - counts["dynamics"] + counts["reduced_dynamics"]


def works() -> list[Work]:
    """Return the problems: press dry (free, and at the first contact's peak), lubricated, and Andrews' squeezer."""
    dry, oil = (gudgeon.load("nine_bar_press", scene=scene, quick=False) for scene in ("dry", "lubricated"))
    peak = float(dry.simulate(0.01).impacts[0]["t_peak"])
    peer = Press(common_point=True)  # contact forces act where gudgeon's do
    return [
        _work_at("press dry, free", dry, 0.005, peer),
        _work_at("press dry, contact", dry, peak, peer),
        _work_at("press lubricated", oil, 0.1, replace(peer, film=True)),
        _work_at("Andrews", gudgeon.load("andrews_squeezer", quick=False), 0.01, None),
    ]


def _work_at(name: str, simulation: Simulation, t: float, peer: Press | None) -> Work:
    """Return the state of a scene at the time t."""
    run = simulation.simulate(t, output=1, rtol=1e-10)
    joints = simulation.source.clearances
    closed = tuple(j.name for j, code in zip(joints, run.state[-1], strict=True) if code) if joints else ()
    memory = simulation.compiled.as_discrete_states(run.memory[-1] if joints else None)
    return Work(name, simulation, t, run.q[-1].copy(), run.v[-1].copy(), memory, closed, peer)


@dataclass(frozen=True)
class Result:
    """Result of a right-hand side: s̈ in tree coordinates; max |Φ|, max |Φ̇|; relative differences from other codes."""

    accelerations: np.ndarray
    phi: float
    phi_dot: float
    from_full: float
    from_peer: float  # NaN without one


def result(work: Work) -> Result:
    """Evaluate a problem; the reference code is compared with the full right-hand side. Raises RuntimeError."""
    model, p = work.simulation.compiled, work.simulation.p
    s, rate = work.tree
    n, t = len(s) - 1, work.t
    a, multipliers, power = np.zeros(n + 1), np.zeros(n + 1), np.zeros(N_WORK)
    if model.lib.gudgeon_reduced_rhs(t, *map(model.pointer, (s, rate, work.memory, p, a, multipliers, power))):
        raise RuntimeError(f"{work.name}: a pivot vanished")
    full = model.rhs(t, work.state, p, work.memory)[len(work.q) : 2 * len(work.q)]
    source = work.simulation.source
    angles = [k for k, name in enumerate(source.tree_coordinates) if f"{name}.theta" in source.coordinates]
    same = full[[source.coordinates.index(f"{source.tree_coordinates[k]}.theta") for k in angles]]
    from_peer = math.nan
    if work.peer is not None:
        stored = np.nan_to_num(work.memory)
        dense, _, _ = press_dense.rhs(work.peer, t, work.state[:-N_WORK], (float(stored[0]), float(stored[1])))
        from_peer = _relative_difference(dense[len(work.q) :], full)
    rates = model.phi_q(t, work.q, p) @ work.v - model.nu(t, work.q, p)
    phi = model.phi(t, work.q, p)
    return Result(
        a[:n], float(abs(phi).max()), float(abs(rates).max()), _relative_difference(a[angles], same), from_peer
    )


def _relative_difference(got: np.ndarray, want: np.ndarray) -> float:
    """Return the largest difference over the largest value."""
    return float(abs(got - want).max() / abs(want).max())


def timers(work: Work) -> list[Callable[[], float]]:
    """Return functions that return the seconds of one call in C: full, reduced, reference code (NaN without one)."""
    model, p = work.simulation.compiled, work.simulation.p
    full = tuple(map(model.pointer, (work.state, work.memory, p)))
    reduced = tuple(map(model.pointer, (*work.tree, work.memory, p)))

    def seconds(function: Callable[..., float], pointers: tuple[object, ...]) -> float:
        """Return the seconds of one call."""
        before = perf_counter()
        function(BATCH, work.t, *pointers)
        return (perf_counter() - before) / BATCH

    return [
        lambda: seconds(model.lib.gudgeon_time_rhs, full),
        lambda: seconds(model.lib.gudgeon_time_reduced, reduced),
        lambda: _peer_seconds(work),
    ]


def _peer_seconds(work: Work) -> float:
    """Return the seconds of one call of the reference code; NaN without one."""
    if work.peer is not None:
        return press_dense.seconds_per_rhs(work.peer, BATCH // 10, 1, work.t, [*work.q, *work.v])
    if find_spec("jitcode") is None:
        return math.nan
    from benchmarks.peers import andrews

    return andrews.seconds_per_rhs(repeats=1)


def calls(work: Work) -> list[callgrind.Call | None]:
    """Return the three calls for callgrind; None without C code, as for jitcode."""
    source, p, t = work.simulation.source, work.simulation.p, work.t.hex()
    s, rate = work.tree
    full = {"y": work.state, "memory": work.memory, "p": p}
    reduced = {"s": s, "rate": rate, "memory": work.memory, "p": p}
    own = [
        callgrind.of_scene(source, f"gudgeon_time_rhs(count, {t}, y, memory, p)", full),
        callgrind.of_scene(source, f"gudgeon_time_reduced(count, {t}, s, rate, memory, p)", reduced),
    ]
    return [*own, _dense(work.peer, work) if work.peer else None]


def _dense(peer: Press, work: Work) -> callgrind.Call:
    """Return the call of the dense C for callgrind."""
    arrays = {"press": press_dense.numbers(peer), "y": work.state[:-N_WORK]}
    call = f"0.0 * press_seconds_per_rhs(press, {work.t.hex()}, y, (int)count, 1)"
    files = {press_dense.SOURCE.name: press_dense.SOURCE.read_text(encoding="utf-8")}
    native = ("-march=native", "-shared", "-fPIC")
    flags = (*(flag for flag in press_dense.FLAGS if flag not in native), *callgrind.PORTABLE)
    return callgrind.Call(files, (press_dense.SOURCE.name,), DENSE, call, arrays, flags)


def machine() -> str:
    """Return the processor's name, its number of cores and its widest SIMD instruction set, as far as known."""
    model, vectors = platform.processor() or platform.machine(), ""
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        message = dict(_split_line(line) for line in cpuinfo.read_text(encoding="utf-8", errors="replace").splitlines())
        model, vectors = (
            message.get("model name", model),
            widest(message.get("flags", message.get("Features", "")).split()),
        )
    return f"{model}, {os.cpu_count()} cores" + f", {vectors}" * bool(vectors)


def _split_line(line: str) -> tuple[str, str]:
    """Return key and value of a line of /proc/cpuinfo."""
    name, _, value = line.partition(":")
    return name.strip(), value.strip()


def widest(flags: Sequence[str]) -> str:
    """Return the widest SIMD instruction set among a processor's flags; "" if unknown."""
    return next((name for flag, name in VECTORS.items() if flag in flags), "")


def _cell(value: float, width: int, digits: int = 0) -> str:
    """Return a number as a cell; a dash for NaN."""
    return f"{'–':>{width}}" if math.isnan(value) else f"{value:{width},.{digits}f}"


def show_times(all_works: list[Work]) -> None:
    """Print times in µs with operations; the ratio is that of the reference code over the reduced one."""
    print(
        f"{'work':<20}{'full [µs]':>10}{'oper.':>7}{'reduced [µs]':>14}{'oper.':>7}{f'≤ {BAR}':>8}{'peer [µs]':>11}"
        f"{'ratio':>8}"
    )
    for work in all_works:
        some = timers(work)
        rounds = np.array([[timer() for timer in some] for _ in range(ROUNDS)])
        full, reduced, peer = map(float, 1e6 * rounds.min(axis=0))
        before, after = work.operations
        verdict = "yes" if reduced <= BAR else "no"
        print(
            f"{work.name:<20}{full:10.3f}{before:7,}{reduced:14.3f}{after:7,}{verdict:>8}{_cell(peer, 11, 3)}"
            f"{_cell(peer / reduced, 8, 1)}",
            flush=True,
        )


def show_instructions(all_works: list[Work]) -> None:
    """Print the instructions of a call, and per operation of the reduced one."""
    print(f"\ninstructions ({' '.join(callgrind.FLAGS)})")
    print(f"{'work':<20}{'full':>10}{'reduced':>10}{'an oper.':>10}{'peer':>10}{'ratio':>8}")
    for work in all_works:
        full, reduced, peer = (callgrind.instructions(c) if c else math.nan for c in calls(work))
        print(
            f"{work.name:<20}{full:10,.0f}{reduced:10,.0f}{reduced / work.operations[1]:10.2f}{_cell(peer, 10)}"
            f"{_cell(peer / reduced, 8, 1)}",
            flush=True,
        )


def show_results(all_works: list[Work]) -> None:
    """Print what was computed, so that a NaN is not timed unnoticed."""
    print("\nresults: accelerations in tree coordinates; |Φ|, |Φ̇|; reduced off full, full off peer (shares)")
    for work in all_works:
        found, names = result(work), work.simulation.source.tree_coordinates
        some = ", ".join(f"{n} {x:.9g}" for n, x in zip(names[:SHOWN], found.accelerations, strict=False))
        peer = "" if math.isnan(found.from_peer) else f", {found.from_peer:.1e}"
        print(
            f"{work.name}, t = {work.t:.9g} s: sum {found.accelerations.sum():.12g}; {some}\n    |Φ| {found.phi:.1e},"
            f" |Φ̇| {found.phi_dot:.1e}; {found.from_full:.1e}{peer}"
        )


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.rhs", description="One right-hand side.")
    parser.add_argument("--callgrind", action="store_true", help="count instructions too, by valgrind")
    options = parser.parse_args()
    print(f"{machine()}; least of {ROUNDS} batches, one thread\n")
    all_works = works()
    show_times(all_works)
    if options.callgrind:
        try:
            show_instructions(all_works)
        except RuntimeError as error:
            raise SystemExit(f"error: {error}") from None
    show_results(all_works)


if __name__ == "__main__":
    main()

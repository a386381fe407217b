"""Random files through the compiler: their C compiles without a warning, both formulations say the same, methods run.

What is refused must be refused with a place; whatever else goes wrong is a `Fault`, which carries the file's seed.
"""

from __future__ import annotations

import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np

from gudgeon.assembly.start import assemble_start
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import AssemblyError, GudgeonError, InputError, InputErrors
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.tree import Expr, evaluate
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import UNIT, build_include_flags, select_declarations
from gudgeon.loading.library import open_library
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.simulation.simulation import Simulation
from tests.fuzz.scenes import RandomFile, random_file
from tests.reduction.reduced import Reduced

WARNINGS = ("-std=c11", "-Wall", "-Wextra", "-Werror")
STATES = 3
SAFETY = 1e5  # what a change of 1e-10 of the state changes covers rounding so many times
LONGEST = 3.0  # s, that a run may take
MOST_TIME, MOST_MEMORY = 120, 4 << 30  # s of the processor, bytes: beyond these a file of a few lines is a fault
_PARTS = ("x", "y", "theta", "vx", "vy", "omega")
BOTH = """
int fuzz_both(double t, const double *s, const double *rate, const double *memory, const double *parameters,
    double *tree_a, double *q, double *v, double *all_a, double *tree_event, double *all_event, double *rescued)
{
    const Parameters *p = (const Parameters *)parameters;
    DiscreteState now = {0};
    RhsOutputs tree, all;
    read_discrete_state(memory, &now);
    %s
    expand(t, %s, p, q, v);
    int failed = reduced_dynamics(t, %s, &now, p, tree_a, &tree);
    failed |= dynamics(t, q, v, &now, p, all_a, &all);
    %s
    for (int i = 0; i < N_USER_EVENTS; i++) {
        tree_event[i] = tree.event[i];
        all_event[i] = all.event[i];
    }
    return failed;
}
"""
MESSAGES = BOTH[1 : BOTH.index(")\n{") + 1] + ";\n"


class Fault(AssertionError):
    """What must not happen."""


@dataclass
class Tally:
    """How many files were compiled in how many formulations, refused, compared and run; and why not."""

    counts: Counter[str]
    faults: list[str]

    def __str__(self) -> str:
        return ", ".join(f"{count} {what}" for what, count in sorted(self.counts.items()))


def try_files(seeds: Iterable[int], compared: int, ran: int, patient: bool = False) -> Tally:
    """Each file in one formulation, one after the other; every `compared`-th in both, every `ran`-th by each method.

    `patient`: go on after a fault.
    """
    tally = Tally(Counter(), [])
    with tempfile.TemporaryDirectory() as folder:
        for k, seed in enumerate(seeds):
            try:
                signal.setitimer(signal.ITIMER_PROF, MOST_TIME if patient else 0)
                _try(seed, k % 2 == 0, k % compared == 0, k % ran == 0, Path(folder), tally.counts)
                signal.setitimer(signal.ITIMER_PROF, 0)
            except Exception as error:
                fault = f"file {seed}: {type(error).__name__}: {error}"
                if not patient:
                    raise Fault(f"{fault}\n{random_file(seed).text}") from error
                tally.faults.append(fault)
    return tally


def _try(seed: int, reduced: bool, compared: bool, ran: bool, folder: Path, counts: Counter[str]) -> None:
    file = random_file(seed)
    formulations = ("reduced", "full") if compared or ran else ("reduced" if reduced else "full",)
    sources = {}
    for formulation in formulations:
        try:
            sources[formulation] = generate_kernel_source(file.text.encode(), "f", file.scene, None, formulation)
        except InputError as error:
            check_refusal(error)
            counts["refused"] += 1
            return
    for source in sources.values():
        check_syntax(source, folder)
        counts["scenes"] += 1
    counts["files"] += 1
    if not compared and not ran:
        return
    libraries = {name: library(source, folder, f"{name}_{seed}") for name, source in sources.items()}
    counts["with numbers" if compare(file, libraries["reduced"], seed) else "without a start"] += 1
    if ran:
        counts["runs"] += run(libraries, Path(f"{seed}.yaml"))


def check_refusal(error: InputError) -> None:
    """It has a place in the file, and words."""
    for one in error.errors if isinstance(error, InputErrors) else (error,):
        if one.where is None or one.where.file != "f" or not one.message:
            raise Fault(f"refused without a place: {one}")


def write(source: KernelSource, folder: Path) -> None:
    for name, text in source.files.items():
        (folder / name).write_text(text, encoding="utf-8")


def check_syntax(source: KernelSource, folder: Path) -> None:
    """No error, no warning."""
    write(source, folder)
    files = [source.main, str(UNIT), *([source.lane_file] if source.lane_file else [])]
    _compile([*WARNINGS, "-fsyntax-only", *build_include_flags(), *files], folder)


def library(source: KernelSource, folder: Path, name: str) -> CompiledModel:
    """Compiled with all warnings on, and loaded; what it has no use for is not compiled."""
    write(source, folder)
    text, message = f'#include "{source.main}"\n#include "engine/engine.c"\n', select_declarations(source)
    if source.formulation == "reduced":
        chained = bool(source.driven_loop_coordinates)
        state = "at.q, at.v" if chained else "s, rate"
        seat = (
            "TreeState at;\n    if (build_tree_state_from_call(t, s, rate, &now, p, &at))\n        return 1;"
            if chained
            else ""
        )
        rescue = "reduce_accelerations(t, q, v, all_a, p, rescued);"
        has_rescue = "gudgeon_accelerations_by_absolute_equations" in message
        text += BOTH % (seat, state, state, rescue if has_rescue else "(void)rescued;")
        message += MESSAGES
    (folder / "library.c").write_text(text, encoding="utf-8")
    file = folder / f"{name}.so"
    _compile(
        [*WARNINGS, "-O1", "-fPIC", "-shared", *build_include_flags(), "library.c", "-o", file.name, "-lm"], folder
    )
    return CompiledModel(source, open_library(file, message))


def _compile(flags: list[str], folder: Path) -> None:
    done = subprocess.run([*find_compiler(), *flags], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        message = [line for line in done.stderr.splitlines() if "error" in line]
        raise Fault("\n".join(message[:6] or done.stderr.splitlines()[:6]))


def compare(file: RandomFile, compiled: CompiledModel, seed: int) -> bool:
    """Tree and absolute equations at states near a start, the events against their text; False: nothing starts."""
    rng, t = np.random.default_rng(seed), 0.37
    slots = len(compiled.source.parameters)
    reduced = Reduced(compiled, compiled.prepare(np.zeros(slots), np.zeros(slots, dtype=bool)))
    try:
        start = assemble_start(compiled, reduced.p, t)
    except AssemblyError:
        return False
    s, rate = reduced.reduce(t, start.q, start.v)
    message = False
    for _ in range(STATES):
        near = s + rng.normal(0.0, 0.05, len(s))
        here = near, rate + rng.normal(0.0, 0.5, len(s))
        if compiled.source.closures:
            with np.errstate(all="ignore"):
                here = _closed(reduced, t, *here)
        memory = np.where(rng.random(compiled.n_discrete_states) < 0.5, 0.1, np.nan)
        memory[len(compiled.source.clearances) :] = 1.0
        found = _both(reduced, t, *here, memory)
        moved = [_both(reduced, t + e, here[0] * (1 + e) + e, here[1] * (1 + e) + e, memory) for e in (1e-10, -1e-10)]
        if found is not None and None not in moved:
            _check(compiled, file, reduced, t, found, cast(Any, moved))
            message = True
    return message


def _closed(reduced: Reduced, t: float, s: Array, rate: Array) -> tuple[Array, Array]:
    try:
        return reduced.close(t, s, rate)
    except AssertionError:  # a singular place
        return np.full_like(s, np.nan), rate


def _both(reduced: Reduced, t: float, s: Array, rate: Array, memory: Array) -> tuple[Array, ...] | None:
    """ṡ̇, q, v, q̈, events of the tree, of all bodies; ṡ̇ from q̈. None where the equations cannot be solved."""
    if not np.isfinite([*s, *rate]).all():
        return None
    compiled, pointer = reduced.library, reduced.library.pointer
    n, events = compiled.n, max(len(compiled.source.events), 1)
    sizes = (reduced.n + 1, n, n, n, events, events, reduced.n + 1)
    out = tuple(np.zeros(size) for size in sizes)
    given = [np.ascontiguousarray(np.append(x, 0.0)) for x in (s, rate, memory)]
    failed = compiled.lib.fuzz_both(t, *map(pointer, given), pointer(reduced.p), *map(pointer, out))
    return None if failed else out


def _check(
    compiled: CompiledModel,
    file: RandomFile,
    reduced: Reduced,
    t: float,
    found: tuple[Array, ...],
    moved: list[tuple[Array, ...]],
) -> None:
    """As near as what an error of the state in its tenth digit changes."""
    source = compiled.source
    tree, q, v, everything, of_tree, of_all, rescued = found
    with np.errstate(invalid="ignore"):
        slack = [
            SAFETY * 1e-5 * np.max([abs(a - b) for a in other], axis=0)
            for b, other in zip(found, zip(*moved, strict=True), strict=True)
        ]
    _agree("events", of_tree, of_all, slack[4])
    if hasattr(compiled.lib, "gudgeon_accelerations_by_absolute_equations"):
        size = np.max(abs(tree), initial=1.0)
        _agree("accelerations", tree[:-1] / size, rescued[:-1] / size, np.full(1, np.max(slack[0]) / size + 1e-7))
    else:
        place = {name: k for k, name in enumerate(source.coordinates)}
        angles = [
            (k, place[f"{name}.theta"]) for k, name in enumerate(source.tree_coordinates) if f"{name}.theta" in place
        ]
        mine, theirs = [k for k, _ in angles], [k for _, k in angles]
        _agree("accelerations", tree[mine], everything[theirs], slack[0][mine] + 1e-9 * np.max(abs(everything)))
    _agree("events and their text", of_all, _as_written(compiled, file, reduced, t, q, v), slack[5])


def _agree(what: str, a: Array, b: Array, slack: Array) -> None:
    good = np.isfinite(a) & np.isfinite(b) & np.isfinite(slack)
    with np.errstate(invalid="ignore"):
        wrong = good & (abs(a - b) > 1e-9 * np.maximum(1e-6, abs(b)) + slack)
    if wrong.any() or (np.isfinite(a) != np.isfinite(b)).any() and np.isfinite(slack).all():
        raise Fault(f"{what} differ: {a} and {b}, slack {slack}")


def _as_written(compiled: CompiledModel, file: RandomFile, reduced: Reduced, t: float, q: Array, v: Array) -> Array:
    """Values of the events by NumPy from the file's text, at absolute coordinates."""
    mechanism = read_mechanism(file.text.encode(), "f")
    source, p = compiled.source, reduced.p
    slots = {slot.address: p[k] for k, slot in enumerate(source.parameters)}
    known: dict[str, float] = {}
    for k, body in enumerate(mechanism.bodies):
        values = (*q[3 * k : 3 * k + 3], *v[3 * k : 3 * k + 3])
        known |= {f"{body}.{part}": x for part, x in zip(_PARTS, values, strict=True)}
    for point in source.points:
        if point.body < 0:
            continue
        x, y, theta = q[3 * point.body : 3 * point.body + 3]
        vx, vy, omega = v[3 * point.body : 3 * point.body + 3]
        a, b = (0.0 if k < 0 else sign * p[k] for k, sign in ((point.x, point.sign_x), (point.y, point.sign_y)))
        dx, dy = a * np.cos(theta) - b * np.sin(theta), a * np.sin(theta) + b * np.cos(theta)
        known |= {f"{point.name}.x": x + dx, f"{point.name}.y": y + dy}
        known |= {f"{point.name}.vx": vx - omega * dy, f"{point.name}.vy": vy + omega * dx}
    known["t"] = np.float64(t)
    known |= {address.removeprefix("parameters."): value for address, value in slots.items()}
    trees = [spec.zero.value for spec in mechanism.scenes[file.scene].events.values()]
    return np.array([_value(tree, known) for tree in trees])


def _value(tree: Expr, known: dict[str, float]) -> float:
    """Of real numbers; where these are none, of complex ones if they lead back: sqrt(x)**2 is x below zero too."""
    value = float(evaluate(tree, known.__getitem__))
    if not np.isnan(value):
        return value
    try:
        turned = complex(evaluate(tree, lambda path: np.complex128(known[path])))
    except TypeError:  # a function of real numbers alone
        return value
    return turned.real if abs(turned.imag) < 1e-9 * abs(turned.real) else value


def run(libraries: dict[str, CompiledModel], path: Path) -> int:
    """A few steps by each method in both formulations; how many ended. Those that end agree.

    Wild drives and forces may lead nowhere: that is told as an error of ours, or takes too long.
    """
    ended = 0
    ends = []
    for compiled in libraries.values():
        simulation = Simulation(compiled, path)
        for method in ("auto", *compiled.source.methods):
            arguments: dict[str, Any] = {"step": 1e-4} if method == "rk4" else {}
            try:
                with np.errstate(all="ignore"):
                    result = simulation.simulate(0.005, output=4, method=method, progress=_Patience(), **arguments)
            except GudgeonError:
                continue
            ended += 1
            if not result.diagnostics.interrupted and method == "auto":
                ends.append(result.q[-1])
    if len(ends) == 2 and np.isfinite(ends).all():
        size = np.max(abs(ends[0]), initial=1.0)
        if np.max(abs(ends[0] - ends[1])) > 1e-5 * size:
            raise Fault(f"runs differ: {ends[0]} and {ends[1]}")
    return ended


class _Patience:
    """Ends a run that takes too long, as Ctrl-C does."""

    def __init__(self) -> None:
        self._begin = time.perf_counter()

    def __call__(self, fraction: float, what: str) -> None:
        if time.perf_counter() - self._begin > LONGEST:
            raise KeyboardInterrupt


def _too_long(*_: object) -> None:
    raise Fault(f"it takes longer than {MOST_TIME} s")


def main(count: int, seed: int) -> None:
    """Tell every 200 files how it goes."""
    total = Tally(Counter(), [])
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))
    signal.signal(signal.SIGPROF, _too_long)
    for first in range(0, count, 200):
        part = try_files(range(seed + first, seed + min(first + 200, count)), 20, 100, patient=True)
        total.counts += part.counts
        total.faults += part.faults
        print(f"{total}; {len(total.faults)} faults", *part.faults, sep="\n  ", flush=True)
    sys.exit(1 if total.faults else 0)

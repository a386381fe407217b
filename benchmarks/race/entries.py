"""List the solvers that docs/race.md compares: other programs, and gudgeon with each of its methods.

A solver that is not installed is left out with a message.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib.util import find_spec
from typing import Any

import numpy as np

from benchmarks import many
from benchmarks.peers import (
    andrews,
    casadi_runs,
    chains,
    cvode,
    diffrax_runs,
    drake_runs,
    dry_chain,
    exudyn_andrews,
    exudyn_press,
    heyoka_runs,
    ideal,
    long_runs,
    mujoco_runs,
    own_scenes,
    pinocchio_runs,
    press,
    pydy_andrews,
    sizes,
)
from benchmarks.peers import four_bar_closed_form as four_bars
from benchmarks.peers.chain_equations import RECURSIVE
from benchmarks.peers.chain_equations import WORKS as WORKS_OF_CHAINS
from benchmarks.peers.timing import CallTimer, Measured
from benchmarks.race.record import MEASURES
from gudgeon.contract.methods import STAGED

ANGLES = ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon")
BODIES = ("L1", "L2", "L3", "L4", "L6", "L7", "L8", "S9")
TOLERANCES = tuple(10.0**-k for k in range(3, 13))
WORKS = tuple(MEASURES)
LONG_TOLERANCES = (1e-12, 1e-13, 1e-14)
ENGINE_TOLERANCES = tuple(10.0**-k for k in range(4, 13))
SLOW_TO_COMPILE = 6  # links: from here on, gcc takes more than ten minutes for the C of jitcode
CHAIN_TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)  # of heyoka, which compiles 64 links anew for each of them
RK4_STEPS = {
    "lubricated": (2e-5, 1e-5, 5e-6),
    "dry": (1e-5, 5e-6, 2e-6, 1e-6, 5e-7),
    "andrews": (2e-4, 1e-4, 5e-5, 2e-5, 1e-5),
}
EXUDYN_STEPS = (3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1.5e-7)  # below it rounding grows
HEYOKA, HEYOKAS = tuple(10.0**-k for k in range(2, 16)), (heyoka_runs.NAME,)
CVODE_SWEEP = (1e-7, 1e-8)  # neighbours of a worst error of 1e-6
SWEEP = (10, 20)  # clearances, speeds


@dataclass(frozen=True)
class Found:
    """Errors by measure (see `press.errors`; andrews and ideal have "angle" and "motion") and cost of one run."""

    errors: dict[str, float]
    seconds: float  # of the integration
    call: float  # of the whole call
    right_hand_sides: int  # −1: unknown

    def least(self, other: Found) -> Found:
        """Return the result with the smaller of each time."""
        return replace(self, seconds=min(self.seconds, other.seconds), call=min(self.call, other.call))


@dataclass(frozen=True)
class Entry:
    """One method on one work; `controls` are its tolerances or steps (s), loosest first."""

    work: str
    name: str
    run: Callable[[float], Found]
    controls: tuple[float, ...]
    needs: tuple[str, ...] = ()  # modules
    method: str = ""  # gudgeon's own; "" for a peer
    runs: int = 1  # number of runs over which `seconds` is averaged
    same: str = ""  # name of what is set up; entries with the same name share one measurement of set-up

    @property
    def model(self) -> str:
        """Return what is set up: gudgeon's scene, with or without Taylor series, or the entry itself."""
        own = "gudgeon taylor" if "taylor" in self.name else "gudgeon"
        return own if self.method else self.same or self.name

    @property
    def missing(self) -> str:
        """Return the modules that are not installed; "" if there are none."""
        return ", ".join(module for module in self.needs if find_spec(module) is None)


Press = Callable[[press.Work, float], press.Run]
Plain = Callable[[float], Measured]


def on_press(run: Press, name: str) -> Callable[[float], Found]:
    """Return a function that runs a reference solver on a press with play, with errors."""

    def found(control: float) -> Found:
        """Return errors and cost."""
        samples, timer, calls = run(press.work(name), control)
        return Found(press_errors(name, samples), timer.engine.seconds, timer.call, calls)

    return found


def press_errors(name: str, samples: press.Samples) -> dict[str, float]:
    """Return the errors by measure; that of the onset is NaN without a list of contacts."""
    errors = press.errors(press.work(name), samples, press.reference(name))
    return {"slider": errors.slider, "path": errors.path, "onset": errors.onset}


def plain(run: Plain, measure: str) -> Callable[[float], Found]:
    """Return a function for a run that has one error."""

    def found(control: float) -> Found:
        """Return error and cost."""
        cost = run(control)
        return Found({measure: cost.error}, cost.seconds, cost.call, cost.right_hand_sides)

    return found


@cache
def loaded(mechanism: str, scene: str) -> Any:
    """Load a scene once."""
    return own_scenes.load(mechanism, scene)


def own_press(name: str, method: str, control: str) -> Callable[[float], Found]:
    """Return a function that runs gudgeon on a press with play; `control`: "step" or "rtol"."""

    def found(value: float) -> Found:
        """Return errors and cost."""
        work = press.work(name)
        simulation, timer = loaded("nine_bar_press", name), CallTimer()
        run = simulation.simulate(
            work.t_end, output=work.times, method=method, parameters=work.parameters, **{control: value}
        )
        q = np.stack([run[f"{body}.{c}"] for body in BODIES for c in ("x", "y", "theta")], axis=1)
        onsets = [run.impacts["t_on"][run.impacts["joint"] == joint] for joint in (0, 1)]
        call = timer.stop().call
        errors = press_errors(name, press.Samples(q, (onsets[0], onsets[1])))
        return Found(errors, run.diagnostics.seconds, call, run.diagnostics.right_hand_sides)

    return found


def own_andrews(method: str, control: str) -> Callable[[float], Found]:
    """Return a function that runs gudgeon on Andrews' squeezer."""

    def found(value: float) -> Found:
        """Return error and cost."""
        simulation, timer = loaded("andrews_squeezer", "ideal"), CallTimer()
        run = simulation.simulate(andrews.T_END, output=1, method=method, **{control: value})
        angles = np.array([run[name][-1] for name in ANGLES])
        call = timer.stop().call
        return Found({"angle": andrews.error(angles)}, run.diagnostics.seconds, call, run.diagnostics.right_hand_sides)

    return found


def own_ideal(_: float) -> Found:
    """Run gudgeon on the ideal press; the time is that of a sample."""
    parameters = {k: v for k, v in press.work("dry").parameters.items() if k != "c"}
    simulation, timer = loaded("nine_bar_press", "ideal"), CallTimer()
    run = simulation.simulate(ideal.T_END, output=ideal.SAMPLES - 1, parameters=parameters)
    motion = np.stack([run["S9.y"], run["S9.vy"], run["S9.ay"]], axis=1)
    timer.stop()
    cost = timer.measured(lambda: ideal.error(motion), seconds=run.diagnostics.seconds).per(ideal.SAMPLES)
    return Found({"motion": cost.error}, cost.seconds, cost.call, -1)


@cache
def sweep_reference() -> np.ndarray:
    """Return the slider's y (runs, OUTPUTS) by the stiff method at 1e-10; `many.confirm` checks it."""
    batch = many.run(loaded("nine_bar_press", "lubricated"), many.grid(*SWEEP), method="rodas5p", rtol=1e-10)
    return batch.q[:, :, batch.source.coordinates.index(many.SLIDER)]


def sweep_found(y: np.ndarray, seconds: float, call: float) -> Found:
    """Return the worst slider error over all runs, and seconds per run."""
    error = float(np.abs(y - sweep_reference()).max() / press.work("lubricated").stroke)
    return Found({"worst": error}, seconds / len(y), call / len(y), -1)


def own_sweep(threads: int) -> Callable[[float], Found]:
    """Return a function that runs gudgeon on all runs of the sweep as a batch: starts, runs and arrays."""

    def found(rtol: float) -> Found:
        """Return error and cost."""
        simulation, timer = loaded("nine_bar_press", "lubricated"), CallTimer()
        batch = many.run(simulation, many.grid(*SWEEP), rtol=rtol, threads=threads)
        y = batch.q[:, :, batch.source.coordinates.index(many.SLIDER)]
        return sweep_found(y, batch.seconds, timer.stop().call)

    return found


def peer_sweep(rtol: float) -> Found:
    """Run CVODE on all runs of the sweep."""
    columns = many.grid(*SWEEP)
    c, omega = np.asarray(columns["c"]), np.asarray(columns["omega"])
    return sweep_found(*cvode.sweep(cvode.sweep_works(c, omega), rtol))


def entries() -> list[Entry]:
    """Return all entries, those of gudgeon first in each problem."""
    return [
        *press_entries(),
        *andrews_entries(),
        *chain_entries(),
        *long_entries(),
        *ideal_entries(),
        *ensemble_entries(),
        *sixteen_entries(),
        *sweep_entries(),
    ]


def own_methods(work: str) -> list[tuple[str, str, tuple[float, ...]]]:
    """Return gudgeon's methods, their control and its values; the default method is the first."""
    names = ("auto", "dop853", "rodas5p", *(STAGED if work == "lubricated" else ()))
    adaptive = [(method, "rtol", TOLERANCES) for method in names]
    return [*adaptive, ("rk4", "step", RK4_STEPS[work])]


def press_entries() -> list[Entry]:
    """Return the entries of the press with play."""
    found, sundae = [], ("sksundae",)
    for work in ("lubricated", "dry"):
        for method, control, values in own_methods(work):
            found.append(Entry(work, f"gudgeon {method}", own_press(work, method, control), values, (), method))
        found += [
            Entry(work, "CVODE BDF from C", on_press(cvode.in_c, work), TOLERANCES, sundae, same="press in C"),
            Entry(work, "LSODA (SciPy)", on_press(press.lsoda, work), TOLERANCES, same="press in C"),
            Entry(work, "LSODA, J in C", on_press(press.lsoda_with_jacobian, work), TOLERANCES, same="press in C"),
            Entry(work, "RK4 in dense C", on_press(press.rk4, work), RK4_STEPS[work], same="press in C"),
        ]
    for name, run in (("scikit-sundae", cvode.sundae), ("scikit-sundae, J in C", cvode.sundae_jacobian)):
        found.append(Entry("lubricated", name, on_press(run, "lubricated"), TOLERANCES[:9], sundae, same="press in C"))
    return found


def andrews_entries() -> list[Entry]:
    """Return the entries of Andrews' squeezer."""
    found, jit = [], ("jitcode",)
    for method, control, values in own_methods("andrews"):
        found.append(Entry("andrews", f"gudgeon {method}", own_andrews(method, control), values, (), method))
    return [
        *found,
        Entry("andrews", "gudgeon taylor", own_andrews("taylor", "rtol"), TOLERANCES, (), "taylor"),
        Entry("andrews", "heyoka", plain(heyoka_runs.of_andrews, "angle"), HEYOKA[1:9], HEYOKAS),
        Entry("andrews", "jitcode dop853", plain(andrews.by_jitcode, "angle"), TOLERANCES, jit),
        Entry("andrews", "SciPy DOP853", plain(andrews.by_scipy, "angle"), TOLERANCES, jit, same="jitcode dop853"),
        Entry("andrews", "SciPy LSODA", plain(andrews.by_lsoda, "angle"), TOLERANCES, jit, same="jitcode dop853"),
        Entry("andrews", "PyDy, DOP853", plain(pydy_andrews.run, "angle"), TOLERANCES[1:8], ("pydy", "Cython")),
        Entry("andrews", "Exudyn gen.-alpha", plain(exudyn_andrews.run, "angle"), EXUDYN_STEPS, ("exudyn",)),
        *engine_entries("andrews", mujoco_runs.ANDREWS_STEPS),
    ]


def engine_entries(work: str, steps: tuple[float, ...]) -> list[Entry]:
    """Return the entries of rigid-body engines and of solvers of expressions; `steps` of MuJoCo, s."""
    n = WORKS_OF_CHAINS.get(work)

    def entry(name: str, module: Any, needs: tuple[str, ...], controls: tuple[float, ...]) -> Entry:
        """Return the entry of a program."""
        run = module.run_andrews if n is None else partial(module.run_chain, n)
        return Entry(work, name, plain(run, "angle"), controls, needs)

    found = [
        entry("MuJoCo RK4", mujoco_runs, ("mujoco",), steps),
        entry("Pinocchio, DOP853", pinocchio_runs, ("pinocchio",), ENGINE_TOLERANCES),
        entry("CasADi CVODES", casadi_runs, ("casadi",), ENGINE_TOLERANCES[::2] if n else ENGINE_TOLERANCES),
        entry("diffrax Dopri8", diffrax_runs, ("diffrax", "jax"), ENGINE_TOLERANCES),
    ]
    if n is not None:  # Drake closes no loops in a continuous plant
        found.append(entry("Drake RK5", drake_runs, ("pydrake",), ENGINE_TOLERANCES))
    return found


def chain_entries() -> list[Entry]:
    """Return the entries of pendulums with several links: single runs and batches, Taylor methods included."""
    found = []
    for work, n in WORKS_OF_CHAINS.items():
        batches, tolerances = n < RECURSIVE, HEYOKA if n < RECURSIVE else CHAIN_TOLERANCES
        for method in ("auto", "dop853", "taylor"):
            run = plain(partial(chains.own, n, method), "angle")
            found.append(Entry(work, f"gudgeon {method}", run, TOLERANCES, (), method))
        for method in ("auto", "taylor") if batches else ():
            run = plain(partial(chains.own_batch, n, method), "angle")
            found.append(Entry(work, f"gudgeon {method}, a batch", run, TOLERANCES, (), method, chains.RUNS))
        for name, peer, runs in (("", chains.heyoka, 1), (", a batch", chains.heyoka_batch, chains.RUNS)):
            if batches or not name:
                run = plain(partial(peer, n), "angle")
                found.append(Entry(work, f"heyoka{name}", run, tolerances, HEYOKAS, "", runs))
        if n < SLOW_TO_COMPILE:
            run = plain(partial(chains.by_jitcode, n), "angle")
            found.append(Entry(work, "jitcode dop853", run, TOLERANCES[1:], ("jitcode",)))
        found += engine_entries(work, mujoco_runs.STEPS[n])
    return found


def long_entries() -> list[Entry]:
    """Return the entries of long conservative motion."""
    found = []
    for work in ("long", "turns", "swings"):
        for method in ("auto", "dop853", "taylor"):
            run = plain(partial(long_runs.own, work, method), "energy")
            found.append(Entry(work, f"gudgeon {method}", run, LONG_TOLERANCES, (), method))
        run = plain(partial(long_runs.heyoka, work), "energy")
        found.append(Entry(work, "heyoka", run, (*LONG_TOLERANCES, 1e-15), HEYOKAS))
        run = plain(partial(long_runs.by_jitcode, work), "energy")
        found.append(Entry(work, "jitcode dop853", run, LONG_TOLERANCES[: 1 if work == "long" else 2], ("jitcode",)))
    return found


def ensemble_entries() -> list[Entry]:
    """Return the entries of a kinematic ensemble of four-bars."""
    n = sizes.four_bars
    return [
        Entry("ensemble", "gudgeon kinematic", plain(four_bars.own, "motion"), (math.nan,), (), "kinematic", n),
        Entry("ensemble", "closed form in NumPy", plain(four_bars.by_numpy, "motion"), (math.nan,), (), "", n),
    ]


def sixteen_entries() -> list[Entry]:
    """Return the entries of sixteen joints with dry contact."""
    found = []
    for method in ("auto", "dop853", "rodas5p"):
        run = plain(partial(dry_chain.own, method), "path")
        found.append(Entry("sixteen", f"gudgeon {method}", run, TOLERANCES[:9], (), method))
    run = plain(dry_chain.by_numpy, "path")
    return [*found, Entry("sixteen", "NumPy, DOP853", run, dry_chain.TOLERANCES)]


def ideal_entries() -> list[Entry]:
    """Return the entries of the press without play."""
    steps, n = (1e-3, 1e-4), ideal.SAMPLES  # a step a sample, and ten
    return [
        Entry("ideal", "gudgeon kinematic", own_ideal, (math.nan,), (), "kinematic", n),
        Entry("ideal", "Newton in dense C", plain(ideal.dense, "motion"), (math.nan,), (), "", n),
        Entry("ideal", "Exudyn gen.-alpha", plain(exudyn_press.run, "motion"), steps, ("exudyn",), "", n),
    ]


def sweep_entries() -> list[Entry]:
    """Return the entries of 200 lubricated runs over clearance and speed."""
    n, sundae = SWEEP[0] * SWEEP[1], ("sksundae",)
    own = [
        Entry("sweep", f"gudgeon auto, {k} thread{'s' * (k > 1)}", own_sweep(k), many.TOLERANCES, (), "auto", n)
        for k in (1, 2)
    ]
    return [*own, Entry("sweep", "CVODE BDF from C, 1 thread", peer_sweep, CVODE_SWEEP, sundae, "", n)]

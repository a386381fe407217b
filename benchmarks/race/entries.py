"""List the solvers that docs/race.md compares: other programs, and gudgeon with each of its methods.

A solver that is not installed is left out with a message.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from importlib.util import find_spec
from typing import Any

import numpy as np

import gudgeon
from benchmarks import many
from benchmarks.peers import (
    andrews,
    chains,
    cvode,
    exudyn_andrews,
    exudyn_press,
    heyoka_runs,
    ideal,
    press,
    pydy_andrews,
)
from gudgeon.contract.methods import STAGED

BODIES = ("L1", "L2", "L3", "L4", "L6", "L7", "L8", "S9")
TOLERANCES = tuple(10.0**-k for k in range(3, 13))
WORKS = ("andrews", "double", "links", "ideal", "dry", "lubricated", "sweep")
CHAINS = {"double": 2, "links": 6}  # pendulums, of so many links
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
    seconds: float
    right_hand_sides: int  # −1: unknown


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

    @property
    def missing(self) -> str:
        """Return the modules that are not installed; "" if there are none."""
        return ", ".join(module for module in self.needs if find_spec(module) is None)


Press = Callable[[press.Work, float], tuple[press.Samples, float, int]]
Plain = Callable[[float], tuple[float, float, int]]


def on_press(run: Press, name: str) -> Callable[[float], Found]:
    """Return a function that runs a reference solver on a press with play, with errors."""

    def found(control: float) -> Found:
        """Return errors and cost."""
        samples, seconds, calls = run(press.work(name), control)
        return Found(press_errors(name, samples), seconds, calls)

    return found


def press_errors(name: str, samples: press.Samples) -> dict[str, float]:
    """Return the errors by measure; that of the onset is NaN without a list of contacts."""
    errors = press.errors(press.work(name), samples, press.reference(name))
    return {"slider": errors.slider, "path": errors.path, "onset": errors.onset}


def plain(run: Plain, measure: str) -> Callable[[float], Found]:
    """Return a function for a run that has one error."""

    def found(control: float) -> Found:
        """Return error and cost."""
        error, seconds, calls = run(control)
        return Found({measure: error}, seconds, calls)

    return found


@cache
def loaded(mechanism: str, scene: str) -> Any:
    """Load a scene once."""
    return gudgeon.load(mechanism, scene=scene, quick=False)


def own_press(name: str, method: str, control: str) -> Callable[[float], Found]:
    """Return a function that runs gudgeon on a press with play; `control`: "step" or "rtol"."""

    def found(value: float) -> Found:
        """Return errors and cost."""
        work = press.work(name)
        run = loaded("nine_bar_press", name).simulate(
            work.t_end, output=work.times, method=method, parameters=work.parameters, **{control: value}
        )
        q = np.stack([run[f"{body}.{c}"] for body in BODIES for c in ("x", "y", "theta")], axis=1)
        onsets = [run.impacts["t_on"][run.impacts["joint"] == joint] for joint in (0, 1)]
        errors = press_errors(name, press.Samples(q, (onsets[0], onsets[1])))
        return Found(errors, run.diagnostics.seconds, run.diagnostics.right_hand_sides)

    return found


def own_andrews(method: str, control: str) -> Callable[[float], Found]:
    """Return a function that runs gudgeon on Andrews' squeezer."""

    def found(value: float) -> Found:
        """Return error and cost."""
        run = loaded("andrews_squeezer", "ideal").simulate(andrews.T_END, output=1, method=method, **{control: value})
        names = ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon")
        error = andrews.error(np.array([run[name][-1] for name in names]))
        return Found({"angle": error}, run.diagnostics.seconds, run.diagnostics.right_hand_sides)

    return found


def own_ideal(_: float) -> Found:
    """Run gudgeon on the ideal press; the time is that of a sample."""
    parameters = {k: v for k, v in press.work("dry").parameters.items() if k != "c"}
    run = loaded("nine_bar_press", "ideal").simulate(ideal.T_END, output=ideal.SAMPLES - 1, parameters=parameters)
    error = ideal.error(np.stack([run["S9.y"], run["S9.vy"], run["S9.ay"]], axis=1))
    return Found({"motion": error}, run.diagnostics.seconds / ideal.SAMPLES, -1)


@cache
def sweep_reference() -> np.ndarray:
    """Return the slider's y (runs, OUTPUTS) by the stiff method at 1e-10; `many.confirm` checks it."""
    batch = many.run(loaded("nine_bar_press", "lubricated"), many.grid(*SWEEP), method="rodas5p", rtol=1e-10)
    return batch.q[:, :, batch.source.coordinates.index(many.SLIDER)]


def sweep_found(y: np.ndarray, seconds: float) -> Found:
    """Return the worst slider error over all runs, and seconds per run."""
    error = float(np.abs(y - sweep_reference()).max() / press.work("lubricated").stroke)
    return Found({"worst": error}, seconds / len(y), -1)


def own_sweep(threads: int) -> Callable[[float], Found]:
    """Return a function that runs gudgeon on all runs of the sweep as a batch: starts, runs and arrays."""

    def found(rtol: float) -> Found:
        """Return error and cost."""
        batch = many.run(loaded("nine_bar_press", "lubricated"), many.grid(*SWEEP), rtol=rtol, threads=threads)
        return sweep_found(batch.q[:, :, batch.source.coordinates.index(many.SLIDER)], batch.seconds)

    return found


def peer_sweep(rtol: float) -> Found:
    """Run CVODE on all runs of the sweep."""
    columns = many.grid(*SWEEP)
    c, omega = np.asarray(columns["c"]), np.asarray(columns["omega"])
    return sweep_found(*cvode.sweep(cvode.sweep_works(c, omega), rtol))


def entries() -> list[Entry]:
    """Return all entries, those of gudgeon first in each problem."""
    return [*press_entries(), *andrews_entries(), *chain_entries(), *ideal_entries(), *sweep_entries()]


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
            Entry(work, "CVODE BDF from C", on_press(cvode.in_c, work), TOLERANCES, sundae),
            Entry(work, "LSODA (SciPy)", on_press(press.lsoda, work), TOLERANCES),
            Entry(work, "LSODA, J in C", on_press(press.lsoda_with_jacobian, work), TOLERANCES),
            Entry(work, "RK4 in dense C", on_press(press.rk4, work), RK4_STEPS[work]),
        ]
    for name, run in (("scikit-sundae", cvode.sundae), ("scikit-sundae, J in C", cvode.sundae_jacobian)):
        found.append(Entry("lubricated", name, on_press(run, "lubricated"), TOLERANCES[:9], sundae))
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
        Entry("andrews", "SciPy DOP853", plain(andrews.by_scipy, "angle"), TOLERANCES, jit),
        Entry("andrews", "SciPy LSODA", plain(andrews.by_lsoda, "angle"), TOLERANCES, jit),
        Entry("andrews", "PyDy, DOP853", plain(pydy_andrews.run, "angle"), TOLERANCES[1:8], ("pydy", "Cython")),
        Entry("andrews", "Exudyn gen.-alpha", plain(exudyn_andrews.run, "angle"), EXUDYN_STEPS, ("exudyn",)),
    ]


def chain_entries() -> list[Entry]:
    """Return the entries of pendulums with several links: single runs and batches, Taylor methods included."""
    found = []
    for work, n in CHAINS.items():
        for method in ("auto", "dop853", "taylor"):
            run = plain(partial(chains.own, n, method), "angle")
            found.append(Entry(work, f"gudgeon {method}", run, TOLERANCES, (), method))
        for method in ("auto", "taylor"):
            run = plain(partial(chains.own_batch, n, method), "angle")
            found.append(Entry(work, f"gudgeon {method}, a batch", run, TOLERANCES, (), method, chains.RUNS))
        for name, peer, runs in (("", chains.heyoka, 1), (", a batch", chains.heyoka_batch, chains.RUNS)):
            found.append(Entry(work, f"heyoka{name}", plain(partial(peer, n), "angle"), HEYOKA, HEYOKAS, "", runs))
    return found


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

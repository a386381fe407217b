"""Who takes part in the race: the peers, and gudgeon with each of its methods. One line an entry.

A method of gudgeon that does not exist yet, or a peer that is not installed, is left out with a line that says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np

import gudgeon
from benchmarks.peers import andrews, cvode, dop853, exudyn_andrews, ideal, lsoda, press, rk4
from gudgeon.simulation import METHODS

BODIES = ("L1", "L2", "L3", "L4", "L6", "L7", "L8", "S9")
TOLERANCES = tuple(10.0**-k for k in range(3, 13))
WORKS = ("lubricated", "dry", "andrews", "ideal")


@dataclass(frozen=True)
class Found:
    """Of one run: errors by measure (see `press.errors`; andrews and ideal have "angle" and "motion"), its cost."""

    errors: dict[str, float]
    seconds: float
    right_hand_sides: int  # −1: not told


@dataclass(frozen=True)
class Entry:
    """One method on one work; `controls` are its tolerances or steps (s), loosest first."""

    work: str
    name: str
    run: Callable[[float], Found]
    controls: tuple[float, ...]
    needs: tuple[str, ...] = ()  # modules
    method: str = ""  # gudgeon's own; "" for a peer

    @property
    def missing(self) -> str:
        """What is not there; "" if all is."""
        lacking = [module for module in self.needs if find_spec(module) is None]
        if self.method and self.method not in METHODS:
            lacking.append(f"gudgeon's method {self.method!r}")
        return ", ".join(lacking)


Press = Callable[[press.Work, float], tuple[press.Samples, float, int]]
Plain = Callable[[float], tuple[float, float, int]]


def on_press(run: Press, name: str) -> Callable[[float], Found]:
    """A peer's run of a press with play, with its errors."""

    def found(control: float) -> Found:
        samples, seconds, calls = run(press.work(name), control)
        return Found(press_errors(name, samples), seconds, calls)

    return found


def press_errors(name: str, samples: press.Samples) -> dict[str, float]:
    """By measure; the onset's only where contacts were listed."""
    errors = press.errors(press.work(name), samples, press.reference(name))
    return {"slider": errors.slider, "path": errors.path, "onset": errors.onset}


def plain(run: Plain, measure: str) -> Callable[[float], Found]:
    """A run that tells one error."""

    def found(control: float) -> Found:
        error, seconds, calls = run(control)
        return Found({measure: error}, seconds, calls)

    return found


@cache
def loaded(mechanism: str, scene: str) -> Any:
    """Compiled once."""
    return gudgeon.load(mechanism, scene=scene)


def own_press(name: str, method: str, control: str) -> Callable[[float], Found]:
    """gudgeon on a press with play; `control`: "step" or "rtol"."""

    def found(value: float) -> Found:
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
    """gudgeon on Andrews' squeezer."""

    def found(value: float) -> Found:
        run = loaded("andrews_squeezer", "ideal").simulate(andrews.T_END, output=1, method=method, **{control: value})
        names = ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon")
        error = andrews.error(np.array([run[name][-1] for name in names]))
        return Found({"angle": error}, run.diagnostics.seconds, run.diagnostics.right_hand_sides)

    return found


def own_ideal(_: float) -> Found:
    """gudgeon on the ideal press, a sample."""
    parameters = {k: v for k, v in press.work("dry").parameters.items() if k != "c"}
    run = loaded("nine_bar_press", "ideal").simulate(ideal.T_END, output=ideal.SAMPLES - 1, parameters=parameters)
    error = ideal.error(np.stack([run["S9.y"], run["S9.vy"], run["S9.ay"]], axis=1))
    return Found({"motion": error}, run.diagnostics.seconds / ideal.SAMPLES, -1)


def entries() -> list[Entry]:
    """Everyone, gudgeon first in each work."""
    own = [("dop853", "rtol", TOLERANCES), ("rodas5p", "rtol", TOLERANCES), ("auto", "rtol", TOLERANCES)]
    rk4_steps = {
        "lubricated": (2e-5, 1e-5, 5e-6),
        "dry": (1e-5, 5e-6, 2e-6, 1e-6, 5e-7),
        "andrews": (2e-4, 1e-4, 5e-5, 2e-5, 1e-5),
    }
    sundae, jit = ("sksundae",), ("jitcode",)
    found = []
    for work in ("lubricated", "dry"):
        for method, control, values in [*own, ("rk4", "step", rk4_steps[work])]:
            found.append(Entry(work, f"gudgeon {method}", own_press(work, method, control), values, (), method))
        found += [
            Entry(work, "CVODE BDF from C", on_press(cvode.in_c, work), TOLERANCES, sundae),
            Entry(work, "LSODA (SciPy)", on_press(lsoda.plain, work), TOLERANCES),
            Entry(work, "LSODA, J in C", on_press(lsoda.jacobian, work), TOLERANCES),
            Entry(work, "RK4 in dense C", on_press(rk4.run, work), rk4_steps[work]),
        ]
    found += [
        Entry("lubricated", "scikit-sundae", on_press(cvode.sundae, "lubricated"), TOLERANCES[:9], sundae),
        Entry(
            "lubricated", "scikit-sundae, J in C", on_press(cvode.sundae_jacobian, "lubricated"), TOLERANCES[:9], sundae
        ),
    ]
    for method, control, values in [*own, ("rk4", "step", rk4_steps["andrews"])]:
        found.append(Entry("andrews", f"gudgeon {method}", own_andrews(method, control), values, (), method))
    exudyn_steps = (3e-5, 1e-5, 3e-6, 1e-6, 3e-7)
    found += [
        Entry("andrews", "jitcode dop853", plain(dop853.jitcode, "angle"), TOLERANCES, jit),
        Entry("andrews", "SciPy DOP853", plain(dop853.scipy, "angle"), TOLERANCES, jit),
        Entry("andrews", "SciPy LSODA", plain(dop853.scipy_lsoda, "angle"), TOLERANCES, jit),
        Entry("andrews", "Exudyn gen.-alpha", plain(exudyn_andrews.run, "angle"), exudyn_steps, ("exudyn",)),
        Entry("ideal", "gudgeon kinematic", own_ideal, (math.nan,), (), "kinematic"),
        Entry("ideal", "Newton in dense C", plain(ideal.dense, "motion"), (math.nan,)),
    ]
    return found

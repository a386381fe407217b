"""Integrate conservative motion for very long: a pendulum, Andrews' squeezer without torque, a double pendulum.

- *long*: 1e5 periods of 2 s of a pendulum, released horizontally: a link with its mass at the tip, whose coordinate
  is the angle as in the equations of the other programs;
- *turns*: 1e4 turns of the crank of Andrews' squeezer without torque; it begins with CRANK_SPEED and the spring acts;
- *swings*: 1e4 slow periods of a double pendulum (chain_equations.py) with small, regular motion, before chaos.

Error: the largest change of the energy at SAMPLES times over a scale: m g l of the pendulum, the energy at the start of
the squeezer, and for the double pendulum the energy above that of rest. The energy is computed from coordinates and
velocities by the same function for every program.
"""

from __future__ import annotations

import tempfile
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers import andrews, chain_equations, chains, heyoka_runs, own_scenes, sizes
from benchmarks.peers.timing import CallTimer, Measured
from gudgeon.loading.shipped import find_shipped_file

SAMPLES = 100
PERIOD, GRAVITY = 2.0, 13.750371636040745654980  # s, m/s^2; length and mass are one
CRANK_SPEED = 1000.0  # rad/s
TURN = 7.5e-3  # s, about the time of a turn from CRANK_SPEED
SWING = 2.36  # s, the slow period of small motion
SMALL = (-0.5 * np.pi + 0.2, -0.5 * np.pi + 0.3)  # rad, start of the double pendulum
ATOL = 1e-2  # of rtol
LINK = f"""\
format: gudgeon/1
name: link
gravity: [0, -{GRAVITY!r} m/s^2]
ground: {{O: [0, 0]}}
bodies:
  bob: {{length: 1 m, com: [1 m, 0], mass: 1 kg, inertia: 0}}
joints:
  pin: {{revolute: [ground.O, bob.tail]}}
start: {{set: {{bob.theta: 0}}, rates: {{bob.omega: 0}}}}
"""


def times(work: str) -> np.ndarray:
    """Return the times of the samples in s, with 0 first."""
    end = {"long": sizes.periods * PERIOD, "turns": sizes.turns * TURN, "swings": sizes.swings * SWING}[work]
    return np.linspace(0.0, end, SAMPLES + 1)


def start(work: str) -> np.ndarray:
    """Return angles, then velocities at the start."""
    if work == "long":
        return np.array([0.5 * np.pi, 0.0])
    return np.concatenate([andrews.START, crank_speeds()]) if work == "turns" else np.array([*SMALL, 0.0, 0.0])


@cache
def crank_speeds() -> np.ndarray:
    """Return the velocities (7,) of Andrews' squeezer that the constraints allow at CRANK_SPEED."""
    found = andrews.parts(np, lambda x: x, list(andrews.START), [0.0] * 7)
    G = np.array(found.G, dtype=float)
    return CRANK_SPEED * np.concatenate([[1.0], np.linalg.solve(G[:, 1:], -G[:, 0])])


def error(work: str, y: np.ndarray) -> float:
    """Return the largest relative change of the energy; y (N, 2n): angles, then velocities."""
    y = np.asarray(y).T
    if work == "long":
        energy, scale = 0.5 * y[1] ** 2 - GRAVITY * np.cos(y[0]), GRAVITY
    elif work == "turns":
        energy = squeezer_energy(y)
        scale = float(energy[0])
    else:
        energy = chain_equations.energy(y)
        scale = float(energy[0] - chain_equations.energy(np.array([-0.5 * np.pi, -0.5 * np.pi, 0.0, 0.0])))
    return float(np.abs(energy - energy[0]).max() / scale)


def squeezer_energy(y: np.ndarray) -> np.ndarray:
    """Return the energy of Andrews' squeezer in J; y (14, N)."""
    q, v = y[:7], y[7:]
    found = andrews.parts(np, lambda x: x, list(q), list(v))
    energy = 0.5 * found.m33 * v[2] ** 2
    for (i, j), (a, b, d) in found.blocks:
        energy = energy + 0.5 * (a * v[i] ** 2 + 2.0 * b * v[i] * v[j] + d * v[j] ** 2)
    c, s = np.cos(q[2]), np.sin(q[2])
    x, z = andrews.SD * c + andrews.SC * s + andrews.XB, andrews.SD * s - andrews.SC * c + andrews.YB
    return energy + 0.5 * andrews.C0 * (np.hypot(x - andrews.XC, z - andrews.YC) - andrews.L0) ** 2


@cache
def loaded(work: str, taylor: bool) -> Any:
    """Return gudgeon's compiled scene."""
    if work == "swings":
        return chains.loaded(2, taylor, SMALL)
    text = LINK if work == "long" else write_free_squeezer()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, f"{work}.yaml")
        file.write_text(text, encoding="utf-8")
        simulation = own_scenes.load(file)
        return simulation.of_method("taylor") if taylor else simulation


def write_free_squeezer() -> str:
    """Return Andrews' squeezer as a mechanism file, without torque and with CRANK_SPEED at the start."""
    text = find_shipped_file("andrews_squeezer").read_text(encoding="utf-8")
    motor = "  motor: {torque: OF, value: 0.033 N*m}\n"
    guess = "  guess:\n"
    if motor not in text or guess not in text:
        raise ValueError("andrews_squeezer.yaml has no motor or guess where it is expected")
    text = text.replace(motor, "").replace(guess, f"  rates: {{OF.omega: {CRANK_SPEED} rad/s}}\n{guess}", 1)
    return text.replace("name: andrews_squeezer", "name: free_squeezer", 1)


def own(work: str, method: str, rtol: float) -> Measured:
    """Run gudgeon."""
    simulation, at = loaded(work, method == "taylor"), times(work)
    timer = CallTimer()
    run = simulation.simulate(float(at[-1]), output=SAMPLES, method=method, rtol=rtol)
    y = own_states(work, run)
    timer.stop()
    return timer.measured(lambda: error(work, y), run.diagnostics.right_hand_sides, run.diagnostics.seconds)


def own_states(work: str, run: Any) -> np.ndarray:
    """Return angles and velocities (N, 2n) as in `start`."""
    if work == "long":
        return np.stack([run["bob.theta"] + 0.5 * np.pi, run["bob.omega"]], axis=1)
    if work == "swings":
        return np.concatenate([run.q[:, 2::3], run.v[:, 2::3]], axis=1)
    bodies = (("OF", ""), ("FE", "OF"), ("BDE", ""), ("EG", "AG"), ("AG", ""), ("HE", "AH"), ("AH", ""))
    return np.stack(
        [run[f"{a}.{name}"] - (run[f"{b}.{name}"] if b else 0.0) for name in ("theta", "omega") for a, b in bodies],
        axis=1,
    )


def equations(work: str, algebra: Any, keep: Any, y: list[Any]) -> list[Any]:
    """Return y' as expressions for another program."""
    n = len(y) // 2
    if work == "long":
        return [y[1], -GRAVITY * algebra.sin(y[0])]
    if work == "swings":
        return [*y[n:], *chain_equations.equations(y[:n], y[n:], algebra.sin, algebra.cos, keep)]
    found = andrews.parts(algebra, keep, y[:n], y[n:], 0.0)
    return [*y[n:], *andrews.eliminate(keep, found)]


@cache
def heyoka_of(work: str, tolerance: float) -> Any:
    """Return heyoka's compiled integrator."""
    y = heyoka_runs.variables(*(f"y{k}" for k in range(len(start(work)))))
    rates = equations(work, import_module(heyoka_runs.NAME), chain_equations.keep_expression, y)
    return heyoka_runs.integrator(y, rates, start(work), tolerance)


def heyoka(work: str, tolerance: float) -> Measured:
    """Run heyoka's Taylor method with dense output at the samples."""
    run, at, first = heyoka_of(work, tolerance), times(work), start(work)
    timer = CallTimer()
    run.time = 0.0
    run.state[:] = first
    with timer.engine:
        y = run.propagate_grid(at)[-1]
    return timer.measured(lambda: error(work, y))


@cache
def jitcode_of(work: str) -> Any:
    """Return jitcode's object with compiled C."""
    jit, step = import_module("jitcode"), andrews.Steps()
    y = [jit.y(i) for i in range(len(start(work)))]
    ode = jit.jitcode(equations(work, import_module("symengine"), step, y), helpers=step.all, verbose=False)
    ode.compile_C(extra_compile_args=["-O3", "-march=native", "-w"])
    return ode


def by_jitcode(work: str, rtol: float) -> Measured:
    """Run jitcode's "dop853", which stops at each sample."""
    ode, at, first = jitcode_of(work), times(work), start(work)
    timer = CallTimer()
    ode.set_integrator("dop853", rtol=rtol, atol=ATOL * rtol, nsteps=10**9)
    ode.set_initial_value(first, 0.0)
    y = np.empty((len(at), len(first)))
    y[0] = first
    with timer.engine:
        for k, t in enumerate(at[1:], 1):
            y[k] = ode.integrate(t)
    return timer.measured(lambda: error(work, y))

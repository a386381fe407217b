"""Integrate a chain of sixteen links whose sixteen joints have play and dry contact: gudgeon, and NumPy with DOP853.

Links of LENGTH hang in a zigzag, and each turns against its neighbours, so that all journals leave the centres of their
bearings and touch within T_END. Data of bearings and laws are those of the press (mechanisms/nine_bar_press.yaml).
No joint is ideal, so the equations in absolute coordinates have no constraints. With e the eccentricity of a joint,
n = e/|e| and delta = |e| - c, the force on the journal is

    F_n = K delta^1.5 (1 + a delta'/delta'_0) towards the centre, F_t = -mu c_d F_n along the slip,

in the middle of the penetration (H. M. Lankarani, P. E. Nikravesh, J. Mech. Des. 112, 1990; friction: J. Ambrosio).
delta'_0 is stored at each onset. The NumPy code evaluates all joints at once; SciPy's DOP853 calls it, ends a step at
each onset, separation and switching point of the friction, and begins again there, as gudgeon does.

Error: the largest deviation of a journal's path over the clearance at SAMPLES times. The reference is the NumPy code at
1e-12, stored in dry_chain.json by `python -m benchmarks.peers.dry_chain`.
"""

from __future__ import annotations

import json
import math
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers import own_scenes
from benchmarks.peers.timing import CallTimer, Measured
from tests.oracles import dry

PATHS = Path(__file__).with_name("dry_chain.json")
LINKS, LENGTH, MASS, INERTIA, GRAVITY = 16, 0.1, 0.1, 1e-4, 9.81  # m, kg, kg m^2, m/s^2
T_END, SAMPLES = 0.016, 8  # s
RADIUS, CLEARANCE, YOUNG, POISSON = 0.015, 0.3e-3, 70e9, 0.3  # m, Pa
RESTITUTION, MU, V0, V1, FLOOR = 0.9, 0.15, 1e-4, 1e-3, 1e-6  # speeds in m/s; FLOOR: the least stored speed
STIFFNESS = dry.stiffness(RADIUS, RADIUS - CLEARANCE, (YOUNG, YOUNG), (POISSON, POISSON))
DAMPING = dry.dissipation_factor(RESTITUTION)
MAX_STEP = 2e-5  # s, of DOP853, so that no contact lies within a step
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
SWITCHES = (-V1, -V0, V0, V1)


def angles() -> np.ndarray:
    """Return the initial angles of the links in rad."""
    return -0.5 * math.pi + np.where(np.arange(LINKS) % 2, 0.4, -0.4) + 0.01 * np.arange(LINKS)


def rates() -> np.ndarray:
    """Return the initial angular velocities of the links in rad/s."""
    return np.where(np.arange(LINKS) % 2, 8.0, -8.0) + 0.5 * np.arange(LINKS)


def start() -> np.ndarray:
    """Return coordinates, then velocities (6 LINKS,): x, y and angle of each link; journals are centred."""
    theta, omega = angles(), rates()
    arm = LENGTH * np.array([np.cos(theta), np.sin(theta)])
    turning = omega * np.array([-arm[1], arm[0]])
    middle = [np.cumsum(x, axis=1) - 0.5 * x for x in (arm, turning)]
    return np.concatenate([np.vstack([middle[0], theta]).T.ravel(), np.vstack([middle[1], omega]).T.ravel()])


class Chain:
    """Right-hand side and event functions of all joints; `stored`: the speed at the onset, 0 without contact."""

    def __init__(self) -> None:
        """Begin without contact."""
        self.stored, self.calls = np.zeros(LINKS), 0

    def joints(self, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """Return e and its rate (2, LINKS), angular velocities of bearing and journal, and half links (2, LINKS)."""
        q, v = y[: 3 * LINKS].reshape(LINKS, 3).T, y[3 * LINKS :].reshape(LINKS, 3).T
        half = 0.5 * LENGTH * np.array([np.cos(q[2]), np.sin(q[2])])
        turning = v[2] * np.array([-half[1], half[0]])
        e, rate = q[:2] - half, v[:2] - turning
        e[:, 1:] -= (q[:2] + half)[:, :-1]
        rate[:, 1:] -= (v[:2] + turning)[:, :-1]
        return e, rate, np.concatenate([[0.0], v[2, :-1]]), v[2], half

    def gaps(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return penetration, its rate and slip of each joint."""
        e, rate, first, second, _ = self.joints(y)
        size = np.hypot(*e)
        n = e / np.where(size > 0.0, size, 1.0)
        delta = size - CLEARANCE
        across = n[0] * rate[1] - n[1] * rate[0]
        slip = across + second * (RADIUS - CLEARANCE - 0.5 * delta) - first * (RADIUS + 0.5 * delta)
        return delta, (n * rate).sum(axis=0), slip

    def __call__(self, _: float, y: np.ndarray) -> np.ndarray:
        """Return y'."""
        self.calls += 1
        e, rate, first, second, half = self.joints(y)
        size = np.hypot(*e)
        n = e / np.where(size > 0.0, size, 1.0)
        delta, closed = size - CLEARANCE, self.stored > 0.0
        deep = np.where(closed, np.maximum(delta, 0.0), 0.0)
        ratio = (n * rate).sum(axis=0) / np.where(closed, self.stored, 1.0)
        normal = np.maximum(STIFFNESS * deep**1.5 * (1.0 + DAMPING * ratio), 0.0)
        arm_1, arm_2 = RADIUS + 0.5 * delta, RADIUS - CLEARANCE - 0.5 * delta
        slip = n[0] * rate[1] - n[1] * rate[0] + second * arm_2 - first * arm_1
        tangential = -MU * np.clip((np.abs(slip) - V0) / (V1 - V0), 0.0, 1.0) * normal * np.sign(slip)
        force = -normal * n + tangential * np.array([-n[1], n[0]])
        total = force.copy()  # on the tail of each link, and from the next link on its head
        total[:, :-1] -= force[:, 1:]
        moment = half[1] * force[0] - half[0] * force[1] + arm_2 * tangential
        moment[:-1] += -half[0, :-1] * force[1, 1:] + half[1, :-1] * force[0, 1:] - (arm_1 * tangential)[1:]
        a = np.vstack([total[0] / MASS, total[1] / MASS - GRAVITY, moment / INERTIA])
        return np.concatenate([y[3 * LINKS :], a.T.ravel()])

    def event(self, kind: int, joint: int, level: float, direction: float) -> Any:
        """Return a terminal event of solve_ivp: penetration (kind 0) or slip (kind 2) of a joint passes a level."""

        def function(_: float, y: np.ndarray) -> float:
            """Return the distance from the level."""
            return float(self.gaps(y)[kind][joint]) - level

        function.terminal, function.direction = True, direction  # type: ignore[attr-defined]
        return function

    def events(self, y: np.ndarray) -> list[tuple[Any, int, bool]]:
        """Return all possible next events with their joints; True for an onset or a separation."""
        found, slip = [], self.gaps(y)[2]
        for joint in range(LINKS):
            closed = bool(self.stored[joint] > 0.0)
            found.append((self.event(0, joint, 0.0, -1.0 if closed else 1.0), joint, True))
            for level in SWITCHES if closed else ():
                if abs(slip[joint] - level) > 1e-12:
                    direction = 1.0 if slip[joint] < level else -1.0
                    found.append((self.event(2, joint, level, direction), joint, False))
        return found

    def run(self, rtol: float) -> tuple[np.ndarray, int]:
        """Return the paths e (SAMPLES + 1, LINKS, 2) in m, and the number of onsets."""
        from scipy.integrate import solve_ivp

        at, t, y, onsets = times(), 0.0, start(), 0
        rows = [self.joints(y)[0].T]
        while len(rows) < len(at):
            # a trial of the first step may be far too long for a contact: SciPy then takes a shorter one
            events = self.events(y)
            with np.errstate(over="ignore", invalid="ignore"):
                s = solve_ivp(
                    self,
                    (t, at[-1]),
                    y,
                    "DOP853",
                    t_eval=at[len(rows) :],
                    events=[event for event, _, _ in events],
                    rtol=rtol,
                    atol=1e-3 * rtol,
                    max_step=MAX_STEP,
                )
            rows += [self.joints(state)[0].T for state in s.y.T] if len(s.t) else []
            if s.status < 0:
                raise FloatingPointError(s.message)
            if s.status == 0:
                break
            k = next(k for k, found in enumerate(s.t_events) if len(found))
            t, y, (_, joint, switched) = float(s.t_events[k][-1]), s.y_events[k][-1].copy(), events[k]
            if switched and self.stored[joint]:
                self.stored[joint] = 0.0
            elif switched:
                self.stored[joint], onsets = max(self.gaps(y)[1][joint], FLOOR), onsets + 1
        return np.array(rows), onsets


def times() -> np.ndarray:
    """Return the times of the samples in s."""
    return np.linspace(0.0, T_END, SAMPLES + 1)


@cache
def reference() -> np.ndarray:
    """Return the stored reference of the paths (SAMPLES + 1, LINKS, 2) in m."""
    return np.array(json.loads(PATHS.read_text())["paths"])


def error(paths: np.ndarray) -> float:
    """Return the largest deviation of a path over the clearance."""
    return float(np.hypot(*np.moveaxis(paths - reference(), 2, 0)).max() / CLEARANCE)


def by_numpy(rtol: float) -> Measured:
    """Run the NumPy code."""
    chain = Chain()
    timer = CallTimer()
    with timer.engine:
        paths, _ = chain.run(rtol)
    return timer.measured(lambda: error(paths), chain.calls)


def written() -> str:
    """Return the chain as a mechanism file of gudgeon."""
    names = [f"L{k}" for k in range(LINKS)]
    heads = ["ground.O", *(f"{name}.head" for name in names)]
    at, turning = angles().tolist(), rates().tolist()
    return "\n".join(
        [
            "format: gudgeon/1",
            "name: dry_chain",
            f"gravity: [0, -{GRAVITY} m/s^2]",
            f"materials: {{aluminium: {{E: {YOUNG:g} Pa, nu: {POISSON}}}}}",
            "bodies:",
            *(f"  {name}: {{length: {LENGTH} m, mass: {MASS} kg, inertia: {INERTIA} kg*m^2}}" for name in names),
            "ground: {O: [0, 0]}",
            "joints:",
            *(f"  J{k}: {{revolute: [{heads[k]}, {name}.tail]}}" for k, name in enumerate(names)),
            "bearings:",
            f"  pin: {{radius: {RADIUS} m, clearance: {CLEARANCE} m, length: 40 mm, bearing_material: aluminium, "
            "journal_material: aluminium}",
            "contacts:",
            "  dry:",
            f"    normal: {{law: lankarani_nikravesh, restitution: {RESTITUTION}, geometry: external}}",
            f"    friction: {{law: modified_coulomb, mu: {MU}, v0: {V0} m/s, v1: {V1} m/s}}",
            "start:",
            f"  set: {{{', '.join(f'{n}.theta: {x!r}' for n, x in zip(names, at, strict=True))}}}",
            f"  rates: {{{', '.join(f'{n}.omega: {x!r}' for n, x in zip(names, turning, strict=True))}}}",
            "scenes:",
            f"  dry: {{play: {{{', '.join(f'J{k}: {{bearing: pin, contact: dry}}' for k in range(LINKS))}}}}}",
            "",
        ]
    )


@cache
def loaded() -> Any:
    """Return gudgeon's compiled chain."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "dry_chain.yaml")
        file.write_text(written(), encoding="utf-8")
        return own_scenes.load(file, "dry")


def own(method: str, rtol: float) -> Measured:
    """Run gudgeon."""
    simulation = loaded()
    timer = CallTimer()
    run = simulation.simulate(T_END, output=SAMPLES, method=method, rtol=rtol)
    paths = own_paths(run)
    timer.stop()
    found = run.diagnostics
    return timer.measured(lambda: error(paths), found.right_hand_sides, found.seconds)


def own_paths(run: Any) -> np.ndarray:
    """Return the paths (SAMPLES + 1, LINKS, 2) of a run of gudgeon in m."""
    x, y, theta = np.moveaxis(run.q.reshape(len(run.q), LINKS, 3), 2, 0)
    half = 0.5 * LENGTH * np.stack([np.cos(theta), np.sin(theta)], axis=2)
    middle = np.stack([x, y], axis=2)
    e = middle - half
    e[:, 1:] -= (middle + half)[:, :-1]
    return e


def main() -> None:
    """Store the reference; print the number of onsets, and the differences of looser runs and of gudgeon."""
    paths, onsets = Chain().run(1e-12)
    gap = float(np.hypot(*np.moveaxis(Chain().run(1e-11)[0] - paths, 2, 0)).max() / CLEARANCE)
    own_gap = own_paths(loaded().simulate(T_END, output=SAMPLES, method="dop853", rtol=1e-12)) - paths
    about = f"Paths e (m) of {LINKS} journals at {SAMPLES + 1} times up to {T_END} s; see dry_chain.py."
    data = {"about": about, "onsets": onsets, "looser_tolerance_differs_by": gap, "paths": paths.tolist()}
    PATHS.write_text(json.dumps(data) + "\n", encoding="utf-8")
    print(f"{onsets} onsets; 1e-11 differs by {gap:.1e}, gudgeon by {np.abs(own_gap).max() / CLEARANCE:.1e} of c")


if __name__ == "__main__":
    main()

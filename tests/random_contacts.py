"""Random machines whose contacts are checked: `python -m tests.random_contacts --count 1000 --seed 1`.

Slider-cranks, cams, four-bars, six-bars with play in one to four joints, on the crank side too; 100 to 6000 rpm,
clearances of 0.02 to 1 mm, tolerances of 1e-4 to 1e-10, all methods, single runs, restarts and batches (in lanes). Each
run is checked at 20,000 samples (gudgeon/results/contact_check.py), and what is found is counted by class. A class is
compiled once; all of its machines differ by numbers alone.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

import gudgeon
from gudgeon.results.contact_check import ContactCheck, check_contact_samples

SAMPLES = 20_000
HEAD = """
format: gudgeon/1
name: {name}
gravity: [0, -9.81]
materials: {{steel: {{E: 207 GPa, nu: 0.3}}}}
parameters: {{omega: 600 rpm, c: 0.1 mm, ce: 0.5, mu: 0.05{numbers}}}
bearings: {{pin: {{radius: 10 mm, clearance: c, length: 20 mm, bearing_material: steel, journal_material: steel}}}}
guides:
  way: {{gap: c, half_length: 20 mm, half_height: 10 mm, corner_radius: 1 mm, guide_material: steel,
        slider_material: steel}}
contacts:
  dry:
    normal: {{law: {law}, restitution: ce, geometry: internal}}
    friction: {{law: modified_coulomb, mu: mu, v0: 1e-3 m/s, v1: 1e-2 m/s}}
scenes: {{dry: {{play: {{{play}}}}}}}
"""
SLIDER_CRANK = """
bodies:
  crank: {length: r, mass: m1, inertia: J1}
  rod: {length: L, mass: m2, inertia: J2}
  slider: {mass: m3, inertia: J3}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, slider.origin]}
  cylinder: {translational: [ground.O, slider.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: omega*t}}
start: {guess: {rod.theta: 0, slider.x: r + L}}
"""
FOUR_BAR = """
bodies:
  crank: {length: r, mass: m1, inertia: J1}
  rod: {length: L, mass: m2, inertia: J2}
  rocker: {length: R, mass: m3, inertia: J3}
ground: {O: [0, 0], C: [D, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  B: {revolute: [rod.head, rocker.head]}
  C: {revolute: [ground.C, rocker.tail]}
drives: {motor: {angle: crank, value: omega*t}}
start: {guess: {rod.theta: 1, rocker.theta: 2}}
"""
SIX_BAR = """
bodies:
  crank: {length: r, mass: m1, inertia: J1}
  rod: {length: L, mass: m2, inertia: J2}
  rocker: {length: R, mass: m3, inertia: J3}
  link: {length: Q, mass: m4, inertia: J4}
  slider: {mass: m5, inertia: J5}
ground: {O: [0, 0], C: [D, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  B: {revolute: [rod.head, rocker.head]}
  C: {revolute: [ground.C, rocker.tail]}
  P: {revolute: [rocker.head, link.tail]}
  wristpin: {revolute: [link.head, slider.origin]}
  cylinder: {translational: [ground.C, slider.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: omega*t}}
start: {guess: {rod.theta: 1, rocker.theta: 2, link.theta: 0, slider.x: D + Q}}
"""
CAM = """
bodies:
  follower: {mass: m1, inertia: J1}
  rod: {length: L, mass: m2, inertia: J2}
  slider: {mass: m3, inertia: J3}
ground: {O: [0, 0], W: [0, 0.6*L]}
joints:
  stem: {translational: [ground.W, follower.origin], axis: [0, 1]}
  crankpin: {revolute: [follower.origin, rod.tail]}
  wristpin: {revolute: [rod.head, slider.origin]}
  cylinder: {translational: [ground.O, slider.origin], axis: [1, 0]}
curves: {lift: {points: [[0, 0], [1, 0], [2, 0.6], [3, 1], [4, 0.8], [5, 0.2], [6.283185307179586, 0]], ends: periodic}}
drives: {cam: {coordinate: follower.y, value: 0.5*L + r*lift(omega*t)}}
start: {guess: {rod.theta: -30 deg, slider.x: 0.86*L}}
"""
KINDS = {"cam": (CAM, 3), "slider_crank": (SLIDER_CRANK, 3), "four_bar": (FOUR_BAR, 3), "six_bar": (SIX_BAR, 5)}
CLASSES = tuple(
    (kind, joints, law)
    for kind, joints, law in (
        ("slider_crank", "crankpin", "flores"),
        ("slider_crank", "wristpin", "lankarani_nikravesh"),
        ("slider_crank", "crankpin wristpin", "hunt_crossley"),
        ("slider_crank", "O crankpin wristpin", "flores"),
        ("slider_crank", "cylinder", "flores"),
        ("slider_crank", "crankpin cylinder", "flores"),
        ("four_bar", "crankpin", "flores"),
        ("four_bar", "B", "lankarani_nikravesh"),
        ("four_bar", "crankpin B C", "flores"),
        ("four_bar", "O crankpin B C", "hunt_crossley"),
        ("cam", "crankpin", "flores"),
        ("six_bar", "crankpin", "flores"),
        ("six_bar", "B", "flores"),
        ("six_bar", "P wristpin", "flores"),
        ("slider_crank", "crankpin", "flores film"),
        ("four_bar", "crankpin B", "flores film"),
        ("six_bar", "wristpin", "lankarani_nikravesh film"),
    )
)
FILM = """
    film: {law: pinkus_sternlicht, viscosity: eta}
    transition: 0.02*c"""
WAYS, BATCH = ("single", "single", "single", "restart", "batch"), 8
METHODS = ("auto", "auto", "auto", "dop853", "rodas5p", "radau5", "radau9", "rk4")


@dataclass(frozen=True)
class Machine:
    """Numbers of one run of a class."""

    parameters: dict[str, float]
    t_end: float
    method: str
    rtol: float  # of rk4 the step, s, so that its ends are no samples

    @property
    def how(self) -> dict[str, float]:
        """Tolerance or step, as `simulate` takes it."""
        return {"step" if self.method == "rk4" else "rtol": self.rtol}


def text_of(kind: str, joints: str, law: str) -> str:
    """The YAML of a class."""
    body, masses = KINDS[kind]
    sizes = {"r": "0.05 m", "L": "0.2 m", "R": "0.15 m", "D": "0.2 m", "Q": "0.3 m"}
    numbers = "".join(f", {name}: {value}" for name, value in sizes.items() if f" {name}" in body or f"{name}," in body)
    numbers += "".join(f", m{k}: 0.2 kg, J{k}: 1e-4 kg*m^2" for k in range(1, masses + 1))
    pairs = {joint: "guide: way" if joint == "cylinder" else "bearing: pin" for joint in joints.split()}
    play = ", ".join(f"{joint}: {{{pair}, contact: dry}}" for joint, pair in pairs.items())
    name = f"{kind}_{joints.replace(' ', '_')}"
    law, film = law.removesuffix(" film"), FILM if law.endswith(" film") else ""
    numbers += ", eta: 0.05 Pa*s" if film else ""
    return HEAD.format(name=name, numbers=numbers, law=law, play=play).replace("  dry:\n", f"  dry:{film}\n") + body


def drawn(kind: str, rng: np.random.Generator, method: str = "", film: bool = False) -> Machine:
    """A machine whose crank turns round, of a size of decimetres; `film`: in oil of 0.2 to 200 mPa s."""

    def log(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    rpm, r = log(100.0, 6000.0), log(0.02, 0.06)
    L = r * rng.uniform(2.2, 5.0)
    omega = rpm * 2.0 * np.pi / 60.0
    out = {
        "omega": omega,
        "c": log(2e-5, 1e-3),
        "ce": float(rng.choice([0.3, 0.5, 0.7, 0.9])),
        "mu": float(rng.choice([0.0, 0.03, 0.1])),
        "r": r,
        "L": L,
    }
    if kind == "cam":
        out["omega"] = omega = min(omega, 80.0)
    if kind in ("four_bar", "six_bar"):
        D, R = r * rng.uniform(2.5, 4.0), r * rng.uniform(2.0, 3.5)
        L = rng.uniform(max(D - R, R - D) + 1.3 * r, D + R - 1.3 * r)
        out |= {"L": L, "D": D, "R": R} | _closed(r, L, R, D)
        if kind == "six_bar":
            Q = 2.0 * R * rng.uniform(1.0, 2.0)
            x, y = D + R * np.cos(out["start.guess.rocker.theta"]), R * np.sin(out["start.guess.rocker.theta"])
            reach = np.sqrt(Q * Q - y * y)
            out |= {"Q": Q, "start.guess.slider.x": x + reach, "start.guess.link.theta": float(np.arctan2(-y, reach))}
    lengths = [out.get(key) for key in ("r", "L", "R", "Q")]
    for k in range(1, KINDS[kind][1] + 1):
        m = log(0.03, 2.0)
        long = (lengths[k - 1] if k <= 4 else None) or 0.05
        out |= {f"m{k}": m, f"J{k}": m * long * long / 12.0 * rng.uniform(0.7, 2.0)}
    out |= {"eta": log(2e-4, 0.2)} if film else {}
    turns, method = rng.uniform(0.5, 2.5), method or str(rng.choice(METHODS))
    rtol = 10.0 ** float(rng.integers(-10, -3)) if method != "rk4" else log(1e-6, 5e-6)
    return Machine(out, float(turns * 2.0 * np.pi / omega), method, rtol)


def _closed(r: float, L: float, R: float, D: float) -> dict[str, float]:
    """The four-bar at crank angle 0 by the cosine rule, its start's guess."""
    d = D - r
    a = np.arccos((L * L + d * d - R * R) / (2.0 * L * d))
    x, y = r + L * np.cos(a), L * np.sin(a)
    return {"start.guess.rod.theta": float(a), "start.guess.rocker.theta": float(np.arctan2(y, x - D))}


@dataclass
class Counted:
    """What the runs of a class came to."""

    runs: int = 0
    faulty: int = 0
    phantom: int = 0
    failed: int = 0
    contacts: int = 0

    def __str__(self) -> str:
        counts = f"runs {self.runs:6d}  contacts {self.contacts:8d}  with faults {self.faulty:4d}"
        return f"{counts}  with phantoms {self.phantom:4d}  failed {self.failed:4d}"


def checked(run: gudgeon.Result) -> tuple[ContactCheck, int]:
    """The check of a run's samples, and how many of its contacts have no force though they last (phantoms)."""
    own = run.impacts[run.impacts["t_off"] > run.impacts["t_on"]]
    resolved = own["deltadot"] <= 1.0001e-6
    return check_contact_samples(run), int((resolved & (own["F_peak"] == 0.0)).sum())


def runs_of(
    simulation: gudgeon.Simulation, machines: list[Machine], way: str
) -> Iterator[tuple[Machine, gudgeon.Result | gudgeon.GudgeonError]]:
    """The runs of machines: each for itself, cut in two and continued, or all in a batch by the first's settings."""
    if way == "batch":
        first = machines[0]
        columns = {name: [one.parameters[name] for one in machines] for name in first.parameters}
        ends = [one.t_end for one in machines]
        times = [np.linspace(0.0, t, SAMPLES + 1) for t in ends]
        how: dict[str, Any] = dict(first.how)
        batch = simulation.simulate_many(columns, ends, output=times, method=first.method, threads=1, **how)
    for i, one in enumerate(machines):
        try:
            yield one, batch[i] if way == "batch" else _run(simulation, one, way)
        except gudgeon.GudgeonError as error:
            yield one, error


def _run(simulation: gudgeon.Simulation, one: Machine, way: str) -> gudgeon.Result:
    settings: dict[str, Any] = {"method": one.method, "parameters": one.parameters} | one.how
    if way == "single":
        return simulation.simulate(one.t_end, output=SAMPLES, **settings)
    half = simulation.simulate(0.37 * one.t_end, output=50, **settings)
    return simulation.simulate(output=np.linspace(half.t[-1], one.t_end, SAMPLES + 1), start=half.final, **settings)


@dataclass
class Campaign:
    """Machines of all classes, and what they came to by class and way of running."""

    rng: np.random.Generator
    show: int = 5  # machines that are still to be shown in full
    found: dict[str, Counted] = field(default_factory=dict)
    failures: Counter[str] = field(default_factory=Counter)

    def run(self, count: int, classes: str = "", method: str = "", quiet: bool = False) -> None:
        """Draw and check so many machines of the classes whose words contain `classes`; with films by that word."""
        kinds = [one for one in CLASSES if classes in " ".join(one) and ("film" in classes or "film" not in one[2])]
        with tempfile.TemporaryDirectory() as folder:
            for n, (kind, joints, law) in enumerate(kinds):
                path = Path(folder) / f"{n}.yaml"
                path.write_text(text_of(kind, joints, law))
                simulation = gudgeon.load(path, "dry")
                many, film = max(1, (count + n) // len(kinds)), law.endswith(" film")
                machines = [drawn(kind, self.rng, method, film) for _ in range(many)]
                while machines:
                    way = WAYS[int(self.rng.integers(len(WAYS)))]
                    some = machines[: BATCH if way == "batch" else 1]
                    del machines[: len(some)]
                    for one, run in runs_of(simulation, some, way):
                        self.count(f"{kind} {joints} {way}", one, run)
                if not quiet:
                    print(kind, joints, flush=True)

    def count(self, key: str, one: Machine, run: gudgeon.Result | gudgeon.GudgeonError) -> None:
        """Check one run."""
        own = self.found.setdefault(key, Counted())
        own.runs += 1
        if isinstance(run, gudgeon.GudgeonError):
            own.failed += 1
            self.failures[str(run)[:90]] += 1
            if self.show > 0:
                self.show -= 1
                print(f"  {key} {one}\n{run}", flush=True)
            return
        check, phantoms = checked(run)
        own.contacts += len(run.impacts)
        own.faulty += not check
        own.phantom += phantoms > 0
        if (not check or phantoms) and self.show > 0:
            self.show -= 1
            print(f"  {key} {one}\n{check}\nphantoms {phantoms}", flush=True)

    @property
    def total(self) -> Counted:
        """The counts of all classes together."""
        return Counted(**{name: sum(vars(own)[name] for own in self.found.values()) for name in vars(Counted())})


def main() -> int:
    """Print counts by class; 1 where something was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--classes", default="", help="only classes whose words contain this; film: with films")
    parser.add_argument("--method", default="", help="only this method")
    parser.add_argument("--show", type=int, default=5, help="machines that are shown in full")
    arguments = parser.parse_args()
    begun, campaign = time.perf_counter(), Campaign(np.random.default_rng(arguments.seed), arguments.show)
    campaign.run(arguments.count, arguments.classes, arguments.method)
    for key, own in [*campaign.found.items(), ("all", campaign.total)]:
        print(f"{key:42s} {own}")
    for text, count in campaign.failures.most_common(8):
        print(f"failed {count}: {text}")
    print(f"{time.perf_counter() - begun:.0f} s")
    return 1 if campaign.total.faulty or campaign.total.phantom else 0


if __name__ == "__main__":
    sys.exit(main())

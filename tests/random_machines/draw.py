"""Random designs, and random numbers for each; `FAMILIES` by name, the knobs as in the package's docstring."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tests.oracles.random_mechanism import random_mechanism
from tests.random_machines.design import Design
from tests.random_machines.graph import Graph
from tests.random_machines.numbers import (
    ACCELERATION,
    FORCE,
    INERTIA,
    LENGTH,
    MASS,
    MOMENT,
    NONE,
    PRESSURE,
    RATE,
    SPEED,
    TIME,
    VISCOSITY,
    Numbers,
)

STEEL = (2.07e11, 0.3)
DISSIPATIONS = (
    "lankarani_nikravesh",
    "hunt_crossley",
    "flores",
    "gonthier",
    "lee_wang",
    "hu_guo",
    "zhiying_qishao",
    "herbert_mcwhannell",
)
FRICTIONS = ("modified_coulomb", "coulomb", "threlfall", "stribeck", "brown_mcphee", "dahl", "lugre", "bengisu_akay")
PROFILE = [[0, 0], [1, 0], [2, 0.6], [3, 1], [4, 0.8], [5, 0.2], [6.283185307179586, 0]]


def _u(rng: np.random.Generator, low: float, high: float, log: bool = False) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))) if log else rng.uniform(low, high))


def _some(rng: np.random.Generator, share: float) -> bool:
    return bool(rng.random() < share)


def graph(seed: int, rng: np.random.Generator) -> Design:
    """Any tree with loops of every joint, drive and force element."""
    return Graph(random_mechanism(seed), rng).design(seed)


class Crank:
    """Slider-cranks, four-bars and six-bars, driven, with play in some joints; or all ideal."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng, self.n = rng, Numbers()
        self.file: dict[str, Any] = {"gravity": self.n.vector(np.array([0.0, -9.81]), ACCELERATION), "bodies": {}}
        self.file |= {"ground": {}, "joints": {}, "drives": {}, "start": {"guess": {}}}

    def bar(self, name: str, length: float) -> None:
        mass = _u(self.rng, 0.05, 3.0, log=True)
        inertia = mass * length**2 * (1 / 12 if _some(self.rng, 0.8) else _u(self.rng, 1e-12, 1.0, log=True))
        sizes = {"length": (length, LENGTH), "mass": (mass, MASS), "inertia": (inertia, INERTIA)}
        self.file["bodies"][name] = {key: self.n.add(x, dims) for key, (x, dims) in sizes.items()}

    def block(self, name: str) -> None:
        mass = _u(self.rng, 0.05, 3.0, log=True)
        sizes = {"mass": (mass, MASS), "inertia": (mass * 1e-3, INERTIA)}
        self.file["bodies"][name] = {key: self.n.add(x, dims) for key, (x, dims) in sizes.items()}

    def pin(self, name: str, one: str, two: str) -> None:
        self.file["joints"][name] = {"revolute": [one, two]}

    def at(self, name: str, x: float, y: float) -> None:
        self.file["ground"][name] = self.n.vector(np.array([x, y]), LENGTH, point=True)

    def turned(self, name: str, angle: float) -> None:
        self.file["start"]["guess"][f"{name}.theta"] = self.n.add(angle, turns=1, flips=True)

    def motor(self, omega: float, angle: float = 0.3) -> None:
        a, w = self.n.add(angle, turns=1, flips=True), self.n.add(omega, RATE, flips=True)
        text, kind = f"{a} + {w}*t", self.rng.integers(4)
        if kind == 0:
            text += f" + {self.n.add(0.1, flips=True)}*sin({self.n.add(2.3 * abs(omega), RATE)}*t)"
        elif kind == 1:
            start, long = self.n.add(0.5 / abs(omega), TIME), self.n.add(2.0 / abs(omega), TIME)
            text += f" + {self.n.add(0.7, flips=True)}*smooth_step(t, {start}, {long})"
        elif kind == 2:  # a second rate without bounds
            text += f" + {self.n.add(0.2, flips=True)}*abs({self.n.add(omega, RATE)}*t - {self.n.add(1.7)})**1.5"
        self.file["drives"]["motor"] = {"angle": "crank", "value": text}

    def linkage(self, kind: int, omega: float) -> float:
        """Bodies and joints; returns the crank's length."""
        r = _u(self.rng, 0.02, 0.1)
        self.at("O", 0.0, 0.0)
        self.bar("crank", r)
        self.pin("O", "ground.O", "crank.tail")
        self.motor(omega)
        rod = r * _u(self.rng, 2.6, 4.5)
        self.bar("rod", rod)
        self.pin("crankpin", "crank.head", "rod.tail")
        tip = r * np.array([np.cos(0.3), np.sin(0.3)])
        if kind == 0:
            self._slider("rod", rod, tip)
            return r
        span, rocker = r * _u(self.rng, 3.2, 3.8), r * _u(self.rng, 2.6, 3.2)
        self.at("P", span, 0.0)
        self.bar("rocker", rocker)
        self.pin("rockerpin", "rod.head", "rocker.head")
        self.pin("P", "ground.P", "rocker.tail")
        base = np.array([span, 0.0])
        joint = _upper(tip, base, rod, rocker)
        self.turned("rod", np.arctan2(*(joint - tip)[::-1]))
        self.turned("rocker", np.arctan2(*(joint - base)[::-1]))
        if kind == 2:
            long = r * _u(self.rng, 5.0, 7.0)
            self.bar("link", long)
            self.pin("linkpin", "rocker.head", "link.tail")
            self._slider("link", long, joint, height=float(joint[1]))
        return r

    def _slider(self, rod: str, length: float, tip: np.ndarray, height: float = 0.0) -> None:
        self.block("slider")
        self.pin("wristpin", f"{rod}.head", "slider.origin")
        if height:
            self.at("W", 0.0, height)
        across = float(tip[1]) - height
        x = float(tip[0]) + np.sqrt(length**2 - across**2)
        place = "ground.W" if height else "ground.O"
        axis = self.n.vector(np.array([1.0, 0.0]), NONE)
        self.file["joints"]["cylinder"] = {"translational": [place, "slider.origin"], "axis": axis}
        at = self.n.vector(np.array([x, height]), LENGTH, point=True)
        self.file["start"]["guess"] |= {"slider.x": at[0], "slider.y": at[1]}
        self.turned(rod, -np.arcsin(across / length))

    def law(self) -> dict[str, Any]:
        law = str(self.rng.choice(["kelvin_voigt", "liu", "johnson", "hertz", *DISSIPATIONS[:4]]))
        if law == "kelvin_voigt":
            stiffness, damping = self.n.add(1e8, (0, 1, -2)), self.n.add(2e3, (0, 1, -1))
            return {"law": law, "stiffness": stiffness, "damping": damping}
        found = {"law": law, "restitution": self.n.add(_u(self.rng, 0.3, 0.95))}
        if law in ("hertz", "liu", "johnson"):
            found["dissipation"] = str(self.rng.choice([*DISSIPATIONS, "exact"]))
        if law not in ("liu", "johnson"):
            found["geometry"] = str(self.rng.choice(["external", "internal"]))
        return found

    def friction(self) -> dict[str, Any]:
        law, found = str(self.rng.choice(FRICTIONS)), {"mu": self.n.add(0.1)}
        speeds = {
            "coulomb": ("v0",),
            "stribeck": ("v0", "v_s"),
            "brown_mcphee": ("v0",),
            "threlfall": ("v_r",),
            "lugre": ("v_s",),
            "bengisu_akay": ("v0", "decay"),
        }.get(law, ())
        found |= {key: self.n.add(1e-2 if key != "v_s" else 5e-2, SPEED) for key in speeds}
        if law == "modified_coulomb":
            found |= {"v0": self.n.add(1e-3, SPEED), "v1": self.n.add(1e-2, SPEED)}
        if law in ("stribeck", "brown_mcphee", "lugre", "bengisu_akay"):
            found["mu_s"] = self.n.add(0.15)
        if law == "dahl":
            found["presliding"] = self.n.add(1e-5, LENGTH)
        if law == "lugre":
            found |= {"stiffness": self.n.add(1e5, (-1, 0, 0)), "damping": self.n.add(3.0, (-1, 0, 1))}
        return {"law": law, **found}

    def play(self, film: bool, rigid: bool) -> str:
        c = _u(self.rng, 5e-5, 5e-4, log=True)
        names = [n for n in ("crankpin", "rockerpin", "wristpin", "linkpin", "P") if n in self.file["joints"]]
        selected = [
            str(n) for n in self.rng.choice(names, min(len(names), int(self.rng.integers(1, 3))), replace=False)
        ]
        radius = _u(self.rng, 100.0, 3000.0, log=True) * c if film else _u(self.rng, 0.005, 0.02)
        radius = min(max(radius, 0.004), 0.05)
        c = min(c, radius / 20.0)
        self.file["materials"] = {"steel": {"E": self.n.add(STEEL[0], PRESSURE), "nu": self.n.add(STEEL[1])}}
        sizes = {"radius": radius, "clearance": c, "length": 1.5 * radius}
        both = {"bearing_material": "steel", "journal_material": "steel"}
        self.file["bearings"] = {"pin": {key: self.n.add(x, LENGTH) for key, x in sizes.items()} | both}
        if rigid:
            impact = {"law": "newton_restitution", "restitution": self.n.add(_u(self.rng, 0.2, 0.9))}
            contact: dict[str, Any] = {"normal": impact | {"threshold": self.n.add(1e-4, SPEED)}}
        else:
            contact = {"normal": self.law()} | ({"friction": self.friction()} if _some(self.rng, 0.7) else {})
        if film:
            law = str(self.rng.choice(["pinkus_sternlicht", "pinkus_sternlicht", "ocvirk", "finite_length"]))
            contact["film"] = {"law": law, "viscosity": self.n.add(0.05, VISCOSITY)}
            contact["transition"] = self.n.add(1e-2 * c, LENGTH)
        self.file["contacts"] = {"touch": contact}
        self.file["scenes"] = {"worn": {"play": {name: {"bearing": "pin", "contact": "touch"} for name in selected}}}
        return "worn"


def _upper(one: np.ndarray, two: np.ndarray, a: float, b: float) -> np.ndarray:
    """Where circles of radii a, b about two points meet, to the left of the way from the first to the second."""
    d = two - one
    apart = np.hypot(*d)
    along = (a**2 - b**2 + apart**2) / (2.0 * apart)
    return np.asarray(one + along * d / apart + np.sqrt(max(a**2 - along**2, 0.0)) * np.array([-d[1], d[0]]) / apart)


def crank(seed: int, rng: np.random.Generator) -> Design:
    """With dry or lubricated play, or rigid pins; events on rates."""
    make, omega = Crank(rng), _u(rng, 10.0, 300.0, log=True)
    make.linkage(int(rng.integers(3)), omega)
    film, rigid = _some(rng, 0.25), _some(rng, 0.15)
    scene = "ideal" if _some(rng, 0.15) else make.play(film, rigid and not film)
    make.file["events"] = {"turns": {"zero": "rod.omega"}}
    tags = {"film"} if film else {"rigid"} if rigid else set()
    return Design(
        "crank",
        seed,
        make.file,
        make.n,
        _u(rng, 0.2, 1.0) * 6.28 / omega,
        scene,
        float(10.0 ** -rng.uniform(7.0, 10.0)),
        size=0.2,
        tags=frozenset(tags),
    )


def parallelogram(seed: int, rng: np.random.Generator) -> Design:
    """Driven through its change points, where the branch that is smooth goes on."""
    make = Crank(rng)
    r, span = _u(rng, 0.1, 0.5), _u(rng, 0.6, 1.2)
    make.at("A", 0.0, 0.0)
    make.at("D", span, 0.0)
    for name, length in (("crank", r), ("coupler", span), ("rocker", r)):
        make.bar(name, length)
    make.file["bodies"]["rocker"]["length"] = make.file["bodies"]["crank"]["length"]
    make.file["bodies"]["coupler"]["length"] = make.file["ground"]["D"][0]
    for name, one, two in (
        ("A", "ground.A", "crank.tail"),
        ("B", "crank.head", "coupler.tail"),
        ("C", "coupler.head", "rocker.head"),
        ("D", "ground.D", "rocker.tail"),
    ):
        make.pin(name, one, two)
    start, omega = _u(rng, 0.3, 1.2), _u(rng, 2.0, 9.0)
    a, w = make.n.add(start, turns=1, flips=True), make.n.add(omega, RATE, flips=True)
    make.file["drives"]["motor"] = {"angle": "crank", "value": f"{a} + {w}*t"}
    make.turned("coupler", 0.0)
    make.turned("rocker", start)
    return Design(
        "parallelogram",
        seed,
        make.file,
        make.n,
        _u(rng, 1.1, 2.3) * 6.28 / omega,
        methods=("auto",),
        without=frozenset({"rotate", "cut"}),
        tags=frozenset({"change point"}),
    )


def cam(seed: int, rng: np.random.Generator) -> Design:
    """A follower that a curve drives, over time or over the angle of a shaft, and a slider-crank that it moves."""
    make, omega = Crank(rng), _u(rng, 5.0, 30.0)
    r, length = 0.02, _u(rng, 0.13, 0.2)
    make.at("O", 0.0, 0.0)
    make.at("W", 0.0, 0.6 * length)
    make.block("follower")
    make.bar("rod", length)
    make.block("slider")
    up, right = make.n.vector(np.array([0.0, 1.0]), NONE), make.n.vector(np.array([1.0, 0.0]), NONE)
    make.file["joints"]["stem"] = {"translational": ["ground.W", "follower.origin"], "axis": up}
    make.pin("crankpin", "follower.origin", "rod.tail")
    make.pin("wristpin", "rod.head", "slider.origin")
    make.file["joints"]["cylinder"] = {"translational": ["ground.O", "slider.origin"], "axis": right}
    make.file["curves"] = {"lift": {"points": PROFILE, "ends": "periodic"}}
    lift, base = (make.n.add(x, LENGTH, flips=True) for x in (r, 0.5 * length))
    w = make.n.add(omega, RATE)
    make.file["drives"]["cam"] = {"coordinate": "follower.y", "value": f"{base} + {lift}*lift({w}*t)"}
    x = make.n.add(0.86 * length, LENGTH)
    make.file["start"]["guess"] |= {"slider.x": x, "follower.y": base}
    make.turned("rod", -0.52)
    make.file["events"] = {"halt": {"zero": "slider.vx"}, "turns": {"zero": "rod.omega"}}
    scene = make.play(False, False) if _some(rng, 0.6) else "ideal"
    return Design(
        "cam",
        seed,
        make.file,
        make.n,
        _u(rng, 1.0, 2.0) * 6.28 / omega,
        scene,
        1e-8,
        size=0.2,
        without=frozenset({"rotate"}),
    )


def slide(seed: int, rng: np.random.Generator) -> Design:
    """A block with friction that sticks, a slider in a rigid guide, a particle on a hill, or a pulse of force."""
    n, kind = Numbers(), int(rng.integers(4))
    mass = _u(rng, 0.5, 3.0)
    body = {"mass": n.add(mass, MASS), "inertia": n.add(1e-2, INERTIA)}
    file: dict[str, Any] = {"bodies": {"block": body}, "ground": {"O": n.vector(np.zeros(2), LENGTH, point=True)}}
    axis = n.vector(np.array([1.0, 0.0]), NONE)
    way = {"translational": ["ground.O", "block.origin"], "axis": axis}
    if kind == 3:  # what a surface lets go
        file |= {"gravity": n.vector(np.array([0.0, -9.81]), ACCELERATION)}
        k, d, rho = n.add(_u(rng, 0.3e8, 3e8), (0, 1, -2)), n.add(_u(rng, 3e3, 3e4), (0, 1, -1)), n.add(1.1, LENGTH)
        file["expressions"] = {
            "far": "hypot(block.x, block.y)",
            "rate": "(block.vx*block.x + block.vy*block.y)/far",
            "push": f"max(0 N, {k}*({rho} - far) - {d}*rate)",
        }
        file["forces"] = {"surface": {"force": "block.origin", "value": ["push*block.x/far", "push*block.y/far"]}}
        at = n.vector(1.1 * np.array([np.sin(0.09), np.cos(0.09)]) - [0.0, 9.8e-8], LENGTH, point=True)
        turned = n.add(0.0, turns=1, flips=True)
        file["start"] = {"set": {"block.x": at[0], "block.y": at[1], "block.theta": turned}}
        file["events"] = {"leaves": {"zero": f"far - {rho}", "direction": "rising"}}
        return Design("slide", seed, file, n, 1.2, tags=frozenset({"hill"}), without=frozenset({"cut"}))
    file |= {"joints": {"way": way}, "freedoms": 1}
    speed = n.add(_u(rng, 0.3, 2.0), SPEED)
    file["start"] = {"rates": {"block.vx": speed}}
    without = frozenset({"rotate"})
    if kind == 0:
        kinetic = _u(rng, 3.0, 9.0)
        rub = {"dry_friction": ["ground.O", "block.origin"], "direction": axis, "kinetic": n.add(kinetic, FORCE)}
        file["forces"] = {"rub": {**rub, "static": n.add(1.3 * kinetic, FORCE)}}
        if _some(rng, 0.5):
            swing, rate = n.add(1.2 * kinetic, FORCE), n.add(_u(rng, 2.0, 9.0), RATE)
            file["forces"]["shake"] = {"force": "block.origin", "value": [f"{swing}*sin({rate}*t)", "0 N"]}
        file["events"] = {"halt": {"zero": "block.vx", "direction": "falling"}, "any": {"zero": "block.vx"}}
        return Design("slide", seed, file, n, _u(rng, 0.5, 2.5), tags=frozenset({"stick"}), without=without)
    if kind == 1:
        top, width, middle = n.add(1.0, (1, 1, -1)), n.add(0.3, TIME), n.add(_u(rng, 2.0, 9.0), TIME)
        value = f"{top}/{width}*exp(-((t - {middle})/{width})**2)/sqrt(pi)"
        file["forces"] = {"pulse": {"force": "block.origin", "value": [value, "0 N"]}}
        return Design("slide", seed, file, n, 12.0, tags=frozenset({"pulse"}), without=without)
    file["start"] = {
        "rates": {"block.vx": "0 m/s"},
        "play": {
            "way": {
                "offset": n.add(0.0, LENGTH, flips=True),
                "tilt": n.add(0.0, flips=True),
                "offset_rate": n.add(_u(rng, -0.02, 0.02), SPEED, flips=True),
                "tilt_rate": n.add(_u(rng, -1, 1), RATE, flips=True),
            }
        },
    }
    del file["freedoms"]
    file["materials"] = {"steel": {"E": n.add(STEEL[0], PRESSURE), "nu": n.add(STEEL[1])}}
    sizes = {"gap": 1e-4, "half_length": _u(rng, 0.005, 0.03), "half_height": 0.01}
    both = {"guide_material": "steel", "slider_material": "steel"}
    file["guides"] = {"slot": {key: n.add(x, LENGTH) for key, x in sizes.items()} | both}
    rigid = _some(rng, 0.7)
    law = {"law": "newton_restitution", "restitution": n.add(_u(rng, 0.1, 0.8)), "threshold": n.add(1e-4, SPEED)}
    if not rigid:
        law = {"law": "kelvin_voigt", "stiffness": n.add(1e7, (0, 1, -2)), "damping": n.add(1e3, (0, 1, -1))}
    file["contacts"] = {"hard": {"normal": law}}
    file["scenes"] = {"worn": {"play": {"way": {"guide": "slot", "contact": "hard"}}}}
    tags = frozenset({"rigid guide" if rigid else "guide"})
    return Design("slide", seed, file, n, _u(rng, 0.05, 0.2), "worn", tags=tags, without=without)


def swing(seed: int, rng: np.random.Generator) -> Design:
    """Pendulums of one to three bars, some at rest and horizontal, with springs; the motion's own series too."""
    make, count = Crank(rng), int(rng.integers(1, 4))
    make.at("O", 0.0, 0.0)
    before, flat = "ground.O", _some(rng, 0.4)
    for k in range(count):
        make.bar(f"bar{k}", _u(rng, 0.2, 1.0))
        make.pin(f"J{k}", before, f"bar{k}.tail")
        before = f"bar{k}.head"
        angle = 0.0 if flat else _u(rng, -1.0, 1.0)
        make.file["start"].setdefault("set", {})[f"bar{k}.theta"] = make.n.add(angle, turns=1, flips=True)
        if _some(rng, 0.5):
            names = ["bar0" if not k else f"bar{k - 1}", f"bar{k}"] if k else ["ground", "bar0"]
            free = make.n.add(_u(rng, -1.0, 1.0), turns=0 if k else 1, flips=True)
            spring = {"stiffness": make.n.add(_u(rng, 0.5, 20.0), MOMENT), "free_angle": free}
            make.file.setdefault("forces", {})[f"coil{k}"] = {"rotational_spring_damper": names, **spring}
    if _some(rng, 0.5):
        c = make.n.add(_u(rng, 0.01, 0.2), (2, 1, 0))
        drag = {"torque": "bar0", "value": f"-{c}*abs(bar0.omega)*bar0.omega"}
        make.file.setdefault("forces", {})["drag"] = drag
    smooth = "drag" not in make.file.get("forces", {})
    del make.file["drives"]
    methods = ("auto", "dop853", "radau5", *(["taylor"] if smooth else []))
    return Design("swing", seed, make.file, make.n, _u(rng, 0.5, 1.5), methods=methods, tags=frozenset({"smooth"}))


FAMILIES: Mapping[str, Callable[[int, np.random.Generator], Design]] = {
    "graph": graph,
    "crank": crank,
    "cam": cam,
    "slide": slide,
    "swing": swing,
    "parallelogram": parallelogram,
}
SHARES = {"graph": 0.3, "crank": 0.3, "cam": 0.08, "slide": 0.16, "swing": 0.11, "parallelogram": 0.05}


def draw(seed: int, family: str | None = None) -> Design:
    """The design of a seed."""
    rng = np.random.default_rng([2026, seed])
    selected = str(rng.choice(list(SHARES), p=list(SHARES.values())))
    return FAMILIES[family or selected](seed, rng)


def other_numbers(design: Design, rng: np.random.Generator) -> Design:
    """The same design with other numbers: each a few per cent off, so that it still assembles."""
    numbers = Numbers(dict(design.numbers.values), design.numbers.vectors)
    fixed = {name for x, y, _, _ in numbers.vectors for name in (x, y)}
    for name, number in numbers.values.items():
        if name not in fixed and number.value:
            numbers.values[name] = replace(number, value=number.value * float(rng.uniform(0.97, 1.03)))
    return replace(design, numbers=numbers)

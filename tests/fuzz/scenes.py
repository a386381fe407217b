"""Random mechanism files: small linkages of every sort with random expressions wherever the format takes one."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from gudgeon.language.units import DIMENSIONLESS, FORCE, LENGTH, RATE, TIME, TORQUE, VELOCITY, Dimension
from tests.fuzz.expressions import Writer

# names that emitted code has, or might have
NAMES = (
    "a_K",
    "k",
    "needs_scalar",
    "broadcast",
    "pick",
    "select_value",
    "angles_0",
    "sines_1",
    "sine_0",
    "cosine_0",
    "cosines_of",
    "value",
    "Lanes",
    "lanes_sin",
    "side_0",
    "side_1",
    "g1",
    "h",
    "time_1",
    "now",
    "lane",
    "run",
    "omega",
    "passed",
    "passed_",
    "share",
    "lambda_",
    "found",
    "width",
    "Four",
    "margin",
    "event",
    "aside_",
    "motion",
    "motor_value",
    "hold",
    "of",
    "LaneBits",
)
_BODY = {"x": LENGTH, "y": LENGTH, "theta": DIMENSIONLESS, "vx": VELOCITY, "vy": VELOCITY, "omega": RATE}
_POINT = {"x": LENGTH, "y": LENGTH, "vx": VELOCITY, "vy": VELOCITY}
_MATERIALS = """materials: {steel: {E: 206 GPa, nu: 0.3}}
bearings: {pin: {radius: 15 mm, clearance: 0.3 mm, length: 40 mm, bearing_material: steel, journal_material: steel}}
contacts:
  dry: {normal: {law: lankarani_nikravesh, restitution: 0.9}, friction: {law: modified_coulomb, mu: 0.1, v0: 1e-3 m/s, v1: 1e-2 m/s}}
  oil: {extends: dry, film: {law: pinkus_sternlicht, viscosity: 100 cP}, transition: 5 um}
"""  # noqa: E501
_MASS = "s: {mass: 1 kg, inertia: 1e-3 kg*m^2}"


@dataclass
class Linkage:
    """Sections of a file, what may be driven, where play may be."""

    bodies: list[str]
    iterate_points: list[str]
    ground: str
    joints: list[str]
    drives: list[tuple[str, Dimension]] = field(default_factory=list)  # "angle: a"
    play: list[str] = field(default_factory=list)
    start: str = ""
    forces: list[str] = field(default_factory=list)


def _bar(name: str, length: str = "0.2 m", more: str = "") -> str:
    return f"{name}: {{length: {length}, mass: 0.3 kg, inertia: 2e-3 kg*m^2{more}}}"


def _pendulum(rng: random.Random) -> Linkage:
    return Linkage(
        [_bar("a")], ["a.head"], "O: [0, 0]", ["O: {revolute: [ground.O, a.tail]}"], [("angle: a", DIMENSIONLESS)]
    )


def _double(rng: random.Random) -> Linkage:
    com = rng.choice(("", ", com: [0.1 m, 0.01 m]"))
    joints = ["O: {revolute: [ground.O, a.tail]}", "A: {revolute: [a.head, b.tail]}"]
    drives = [("angle: a", DIMENSIONLESS), ("angle: [b, a]", DIMENSIONLESS), ("angle: b", DIMENSIONLESS)]
    driven = drives[: rng.choice((1, 2))] if rng.random() < 0.7 else drives[2:]
    return Linkage([_bar("a"), _bar("b", more=com)], ["a.head", "b.head"], "O: [0, 0]", joints, driven, ["A", "O"])


def _four_bar(rng: random.Random) -> Linkage:
    joints = [
        "O: {revolute: [ground.O, a.tail]}",
        "A: {revolute: [a.head, b.tail]}",
        "B: {revolute: [b.head, c.head]}",
        "P: {revolute: [ground.P, c.tail]}",
    ]
    return Linkage(
        [_bar("a", "0.1 m"), _bar("b", "0.3 m"), _bar("c", "0.25 m")],
        ["b.com", "c.head"],
        "O: [0, 0], P: [0.3 m, 0]",
        joints,
        [("angle: a", DIMENSIONLESS)],
        ["A", "B"],
        "guess: {a.theta: 40 deg, b.theta: 30 deg, c.theta: 70 deg}",
    )


def _slider_crank(rng: random.Random) -> Linkage:
    joints = [
        "O: {revolute: [ground.O, a.tail]}",
        "A: {revolute: [a.head, b.tail]}",
        "W: {revolute: [b.head, s.origin]}",
        "G: {translational: [ground.O, s.origin], axis: [1, 0]}",
    ]
    drive = rng.choice((("angle: a", DIMENSIONLESS), ("coordinate: s.x", LENGTH), ("angle: [b, a]", DIMENSIONLESS)))
    bodies = [_bar("a", "0.1 m"), _bar("b", "0.3 m"), _MASS]
    guess = "guess: {a.theta: 40 deg, s.x: 0.35 m}"
    return Linkage(bodies, ["b.head", "a.com"], "O: [0, 0]", joints, [drive], ["A", "W"], guess)


def _shaker(rng: random.Random) -> Linkage:
    made = _slider_crank(rng)
    made.drives = [("angle: a", DIMENSIONLESS)]
    made.bodies.append(_bar("arm"))
    made.iterate_points.append("arm.head")
    made.joints.append("pivot: {revolute: [s.origin, arm.tail]}")
    made.play = ["pivot"]
    return made


def _block(rng: random.Random) -> Linkage:
    friction = "rub: {dry_friction: [ground.O, s.origin], direction: [1, 0], speed: 0.1 m/s, static: 5 N, kinetic: 4 N}"
    made = Linkage(
        [_MASS], ["s.origin"], "O: [0, 0]", ["G: {translational: [ground.O, s.origin], axis: [1, 0]}"], [], []
    )
    if rng.random() < 0.7:
        made.forces.append(friction)
    if rng.random() < 0.4:
        made.bodies.append(_bar("a"))
        made.joints.append("H: {revolute: [s.origin, a.tail]}")
        made.iterate_points.append("a.head")
        made.drives, made.play = [("angle: a", DIMENSIONLESS)], ["H"]
    return made


def _free(rng: random.Random) -> Linkage:
    made = Linkage(
        [_bar("a"), "s: {mass: 1 kg, inertia: 1e-3 kg*m^2, points: {p: [10 mm, 20 mm]}}"],
        ["a.head", "s.p"],
        "O: [0, 0]",
        [],
        [("coordinate: s.y", LENGTH)],
    )
    if rng.random() < 0.5:
        made.drives = [("distance: [a.head, ground.O]", LENGTH)]
    return made


def _gears(rng: random.Random) -> Linkage:
    joints = [
        "O: {revolute: [ground.O, a.tail]}",
        "P: {revolute: [ground.P, w.origin]}",
        "mesh: {gear: [a, w], radii: [40 mm, 60 mm], carrier: ground}",
    ]
    bodies, ground = [_bar("a"), "w: {mass: 1 kg, inertia: 1e-3 kg*m^2}"], "O: [0, 0], P: [100 mm, 0]"
    made = Linkage(bodies, ["a.head"], ground, joints, [("angle: w", DIMENSIONLESS)])
    if rng.random() < 0.5:
        made.bodies.append(_bar("b"))
        made.joints.append("J: {revolute: [a.head, b.tail]}")
        made.iterate_points.append("b.head")
        made.play = ["J"]
    return made


LINKAGES: tuple[Callable[[random.Random], Linkage], ...] = (
    *(_pendulum,) * 14,
    *(_block,) * 8,
    *(_free,) * 3,
    *(_gears,) * 2,
    *(_double,) * 2,
    _four_bar,
    _slider_crank,
    _shaker,
)


@dataclass(frozen=True)
class RandomFile:
    """A file, the names that its events may use with their dimensions, its scene."""

    text: str
    scene: str
    moving: Mapping[str, Dimension]


def random_file(seed: int) -> RandomFile:
    """The same for the same seed."""
    rng = random.Random(seed)
    made = rng.choice(LINKAGES)(rng)
    parameters = {name: rng.choice((DIMENSIONLESS, LENGTH, TIME, RATE)) for name in rng.sample(NAMES, 3)}
    alone: dict[str, Dimension] = {"t": TIME}
    names = [body.partition(":")[0] for body in made.bodies]
    moving = {f"{body}.{part}": of for body in names for part, of in _BODY.items()}
    moving |= {f"{point}.{part}": of for point in made.iterate_points for part, of in _POINT.items()}
    driving, watching = (
        Writer(rng, alone | parameters, alone, jumps=False),
        Writer(rng, alone | moving | parameters, alone | moving),
    )
    numbers = {DIMENSIONLESS: "1.3", LENGTH: "0.2 m", TIME: "0.7 s", RATE: "2.1 rad/s"}
    lines = ["format: gudgeon/1", "name: fuzz", "parameters:"]
    lines += [f"  {name}: {numbers[of]}" for name, of in parameters.items()]
    lines += ["gravity: [0, -9.81 m/s^2]"] * (rng.random() < 0.7)
    lines += ["bodies:", *(f"  {body}" for body in made.bodies), f"ground: {{{made.ground}}}"]
    lines += ["joints:", *(f"  {joint}" for joint in made.joints)] if made.joints else []
    driven = [drive for drive in made.drives if rng.random() < 0.6]
    lines += ["drives:"] if driven else []
    for k, (what, of) in enumerate(driven):
        lines.append(f"  d{k}: {{{what}, value: {_quoted(driving.write(of, rng.choice((1, 1, 2, 3))))}}}")
    lines += ["forces:", *(f"  {force}" for force in made.forces), *_forces(rng, watching, names, made.iterate_points)]
    lines += [f"start: {{{made.start}}}"] if made.start else []
    lines += ["events:"]
    for k in range(rng.choice((1, 2, 3))):
        zero = _quoted(watching.write(rng.choice((DIMENSIONLESS, LENGTH, RATE)), rng.choice((1, 1, 2, 3))))
        action = rng.choice(("", "", ", direction: rising", ", direction: falling, action: record"))
        lines.append(f"  e{k}: {{zero: {zero}{action}}}")
    lines += ["outputs:", f"  o: {_quoted(watching.write(rng.choice((DIMENSIONLESS, FORCE)), 2))}"]
    text = "\n".join(lines) + "\n"
    with_play = [joint for joint in made.play if rng.random() < 0.5][:1]
    if not with_play:
        return RandomFile(text, "ideal", moving)
    play = f"{{{with_play[0]}: {{bearing: pin, contact: {rng.choice(('dry', 'oil'))}}}}}"
    text += f"{_MATERIALS}scenes: {{loose: {{play: {play}}}}}\n"
    return RandomFile(text, "loose", moving)


def _forces(rng: random.Random, writer: Writer, bodies: list[str], points: list[str]) -> list[str]:
    lines = []
    if rng.random() < 0.8:
        torque = _quoted(writer.write(TORQUE, rng.choice((1, 1, 2))))
        lines.append(f"  f0: {{torque: {rng.choice(bodies)}, value: {torque}}}")
    if rng.random() < 0.6 or not lines:
        x, y = (_quoted(writer.write(FORCE, rng.choice((1, 1, 2)))) for _ in range(2))
        axes = rng.choice(("ground", "body"))
        lines.append(f"  f1: {{force: {rng.choice(points)}, value: [{x}, {y}], axes: {axes}}}")
    if rng.random() < 0.3:
        ends = f"[ground.O, {rng.choice(points)}]"
        lines.append(f"  f2: {{spring_damper: {ends}, stiffness: 10 N/m, free_length: 0.1 m, damping: 1 N*s/m}}")
    return lines


def _quoted(text: str) -> str:
    return f'"{text}"'

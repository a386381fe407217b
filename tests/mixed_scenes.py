"""Random scenes that mix what a step watches: driven chains, switches in time and in forces, play, films, friction.

A crank-rocker or a cylinder is driven, so that its links follow from the drives alone; an arm hangs on it, with play or
without, and a block beside it may stick. The same seed gives the same text.
"""

from __future__ import annotations

import random
from dataclasses import dataclass

HEAD = """format: gudgeon/1
name: mixed
gravity: [0, -9.81]
parameters: {w: %(w)s 1/s, pull: 3 N}
materials: {steel: {E: 207 GPa, nu: 0.3}}
bearings: {pin: {radius: 10 mm, clearance: 0.1 mm, length: 20 mm, bearing_material: steel, journal_material: steel}}
contacts:
  dry: {normal: {law: %(law)s, restitution: 0.7, geometry: internal}, friction: {law: modified_coulomb, mu: 0.1, v0: 1e-3 m/s, v1: 1e-2 m/s}}
  oil: {extends: dry, film: {law: pinkus_sternlicht, viscosity: 200 cP}, transition: 5 um}
curves: {prof: {points: [[0, 0], [1, 0.3], [2.5, 1], [4, 0.4], [6.283185307179586, 0]], ends: periodic}}
"""  # noqa: E501
CRANK = """bodies:
  crank: {length: 0.1 m, mass: 0.5 kg, inertia: 1e-3 kg*m^2}
  rod: {length: 0.3 m, mass: 0.5 kg, inertia: 5e-3 kg*m^2}
  rocker: {length: 0.25 m, mass: 0.5 kg, inertia: 4e-3 kg*m^2}
  arm: {length: 0.2 m, mass: 0.5 kg, inertia: 2e-3 kg*m^2}
%(block)sground: {O: [0, 0], P: [0.3 m, 0], R: [1 m, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  A: {revolute: [crank.head, rod.tail]}
  B: {revolute: [rod.head, rocker.head]}
  P: {revolute: [ground.P, rocker.tail]}
  pivot: {revolute: [rod.com, arm.tail]}
%(guide)sdrives: {d: {angle: crank, value: %(value)s}}
start: {guess: {crank.theta: 40 deg, rod.theta: 30 deg, rocker.theta: 70 deg, arm.theta: -90 deg}}
"""
CYLINDER = """bodies:
  boom: {length: 1 m, mass: 5 kg, inertia: auto, points: {lug: [0.4 m, -0.1 m]}}
  arm: {length: 0.2 m, mass: 0.5 kg, inertia: 2e-3 kg*m^2}
%(block)sground: {O: [0, 0.6 m], foot: [0.3 m, 0.1 m], R: [2 m, 0]}
joints:
  O: {revolute: [ground.O, boom.tail]}
  pivot: {revolute: [boom.head, arm.tail]}
%(guide)sdrives: {d: {distance: [ground.foot, boom.lug], value: %(length)s}}
start: {guess: {boom.theta: 20 deg, arm.theta: -90 deg}}
"""
TURNS = (
    "0.7 + w*t",
    "0.7 + 0.4*prof(w*t)",
    "0.7 + 0.5*smooth_step(t, 0.05 s, 0.2 s)",
    "0.7 + 0.6*ramp(t, 0.05 s, 0.1 s)",
    "0.7 + 0.2*abs(sin(w*t))",
    "0.7 + min(w*t, 1.0 - w*t/3)",
    "0.7 + where(t > 0.1 s, 0.3*(t/(1 s) - 0.1)**2, 0)",
    "0.7 + 0.1*prof(mod(2*w*t, 2*pi))",
    "0.7 + 0.3*max(0, sin(w*t))**2 + 0.1*prof(w*t + 1)",
)
LENGTHS = tuple(f"0.55 m + 0.1 m*({turn.removeprefix('0.7 + ')})" for turn in TURNS)
FORCES = (
    "f: {force: arm.head, value: ['pull*ramp(t, 0.05 s, 0.1 s)', 0 N]}",
    "f: {force: arm.head, value: ['-1 N*s/m*abs(arm.head.vx)', 'max(0 N, pull*sin(40/(1 s)*t))']}",
    "f: {torque: arm, value: '-0.01 N*m*s^2*arm.omega*abs(arm.omega) + 0.1 N*m*prof(20/(1 s)*t)'}",
    "f: {force: arm.com, value: ['exp(-((t/(1 s) - 0.15)/0.02)**2)*1 N', 'where(arm.vy > 0 m/s, -1 N, 0 N)']}",
)
EVENTS = (
    "e: {zero: arm.omega}",
    "e: {zero: 'sin(100/(1 s)*t)'}",
    "e: {zero: arm.theta + 90 deg, direction: rising}",
    "e: {zero: 't - 0.15 s'}, g: {zero: 'abs(arm.vx) - 0.1 m/s'}",
)
LAWS = ("lankarani_nikravesh", "flores", "hunt_crossley")


@dataclass(frozen=True)
class MixedScene:
    """The text of a file and the name of its scene."""

    text: str
    scene: str


def mixed_scene(seed: int) -> MixedScene:
    """The same for the same seed."""
    rng = random.Random(seed)
    block = rng.random() < 0.4
    numbers = {
        "w": f"{rng.uniform(3.0, 30.0):.6g}",
        "law": rng.choice(LAWS),
        "value": f"'{rng.choice(TURNS)}'",
        "length": f"'{rng.choice(LENGTHS)}'",
        "block": "  block: {mass: 1 kg, inertia: 1e-3 kg*m^2}\n" if block else "",
        "guide": "  guide: {translational: [ground.R, block.origin], axis: [1, 0]}\n" if block else "",
    }
    text = (HEAD + rng.choice((CRANK, CYLINDER))) % numbers
    forces = [rng.choice(FORCES)] if rng.random() < 0.8 else []
    if block:
        forces += [
            "spring: {spring_damper: [arm.head, block.origin], stiffness: 200 N/m, free_length: 0.5 m}",
            "rub: {dry_friction: [ground.R, block.origin], direction: [1, 0], static: 3 N, kinetic: 2 N}",
        ]
    text += "forces:\n" + "".join(f"  {force}\n" for force in forces) if forces else ""
    text += f"events: {{{rng.choice(EVENTS)}}}\n" if rng.random() < 0.7 else ""
    contact = rng.choice(("dry", "dry", "oil", ""))
    if not contact:
        return MixedScene(text, "ideal")
    return MixedScene(text + f"scenes: {{worn: {{play: {{pivot: {{bearing: pin, contact: {contact}}}}}}}}}\n", "worn")

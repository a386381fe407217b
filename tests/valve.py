"""A follower on a rotating eccentric with a spring: events that can be told in closed form, in either kind of scene."""

from __future__ import annotations

from pathlib import Path

import gudgeon
from gudgeon.simulation.simulation import Simulation

E = 0.03  # m, from the shaft to the pin
TEXT = """\
format: gudgeon/1
name: valve
parameters: {w: 7 rad/s, top: 25 mm}
gravity: [0, -9.81 m/s^2]
bodies:
  crank: {length: 30 mm, mass: 1 kg, inertia: 1e-2 kg*m^2}
  follower: {mass: 0.5 kg, inertia: 1e-3 kg*m^2}
  arm: {length: 0.4 m, mass: 0.5 kg, inertia: 7e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  guide: {translational: [ground.O, follower.origin], axis: [1, 0]}
  T: {revolute: [follower.origin, arm.tail]}
drives:
  shaft: {angle: crank, value: w * t}
  lifter: {coordinate: follower.x, value: 30 mm * sin(w * t)}
START
outputs: {lift: follower.x * 2}
events: {rising: {zero: follower.x - top, direction: rising}, turn: {zero: follower.vx}}
SCENES
"""
FREE = "start: {set: {arm.theta: -60 deg}}"
DRIVEN = "  sweep: {angle: arm, value: 2 rad/s * t - 1 rad}"


def valve(folder: Path, kinematic: bool = False, formulation: str = "reduced") -> Simulation:
    """The arm hangs freely from the follower, or is driven too: then nothing is free."""
    file = folder / f"valve_{int(kinematic)}.yaml"
    text = TEXT.replace("START", DRIVEN if kinematic else FREE).replace("SCENES\n", "")
    file.write_text(text, encoding="utf-8")
    return gudgeon.load(file, formulation=formulation)

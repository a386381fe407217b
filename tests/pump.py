"""A small mechanism for tests of the commands, and what they share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from typer.testing import Result

Gudgeon = Callable[..., Result]

# A crank-slider whose wrist pin has play: small enough to be derived and compiled in seconds.
TEXT = """\
format: gudgeon/1
name: pump
title: A pump with a worn wrist pin
parameters: {omega: 20 rad/s, c: 0.2 mm}
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies:
  crank: {length: 30 mm, mass: 0.2 kg, inertia: 1e-4 kg*m^2}
  rod: {length: 120 mm, mass: 0.3 kg, inertia: 4e-4 kg*m^2}
  piston: {mass: 0.25 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0], C: [0, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  A: {revolute: [crank.head, rod.tail]}
  B: {revolute: [rod.head, piston.origin]}
  bore: {translational: [ground.C, piston.origin], axis: [1, 0]}
drives:
  motor: {angle: crank, value: 20 deg + omega * t}
start:
  guess: {piston.x: 0.14}
bearings:
  pin: {radius: 10 mm, clearance: c, length: 20 mm, bearing_material: steel, journal_material: steel}
contacts:
  dry:
    normal: {law: lankarani_nikravesh, restitution: 0.9, geometry: external}
    friction: {law: modified_coulomb, mu: 0.1, v0: 1e-4 m/s, v1: 1e-3 m/s}
scenes:
  worn: {play: {B: {bearing: pin, contact: dry}}, simulate: {t_end: 0.02 s, step: 2e-6 s, output: 100}}
"""


def written(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()} - {"pump.yaml"}

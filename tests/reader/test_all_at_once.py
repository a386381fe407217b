"""Mistakes that have nothing to do with each other are told at once, whichever pass of the reader finds them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from gudgeon.errors import InputError, InputErrors
from gudgeon.generator.reader.read import read_mechanism
from tests.scenes import patched

ROOT = Path(__file__).resolve().parents[2]
TEXT = """format: gudgeon/1
name: m
gravity: [0, -9.81 m/s^2]
parameters: {c: 0.3 mm, zero: 0}
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies:
  L1: {length: 80 mm, mass: 0.1 kg, inertia: 1e-4 kg*m^2}
  L2: {length: 250 mm, mass: 0.3 kg, inertia: 1e-3 kg*m^2}
  S: {mass: 0.2 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, L1.tail]}
  A: {revolute: [L1.head, L2.tail]}
  B: {translational: [ground.O, S.origin], axis: [1, 0]}
drives: {crank: {angle: L1, value: 10 rad/s * t}}
forces: {f: {force: L2.head, value: [1 N, 2 N]}}
bearings: {pin: {radius: 15 mm, clearance: c, length: 40 mm, bearing_material: steel, journal_material: steel}}
contacts: {dry: {normal: {law: lankarani_nikravesh, restitution: 0.9}}}
scenes:
  dry: {play: {A: {bearing: pin, contact: dry}}}
  worn: {extends: dry, parameters: {c: 0.5 mm}}
"""
Patches = tuple[tuple[str, str], ...]

TOGETHER: list[tuple[Patches, tuple[str, ...]]] = [
    ((("1 N, 2 N", "speed * 1 N, 2 N * (load + speed)"),), ("'speed'", "'load'")),
    ((("axis: [1, 0]", "axis: [1 + load, 0]"), ("S.origin", "S.middle")), ("'middle'", "'load'")),
    ((("L2.head, value: [1 N", "L2.top, value: [1 m"),), ("'top'", "expected a force")),
    ((("L1, value: 10", "L3, value: load * 10"),), ("'L3'", "'load'")),
    ((("restitution: 0.9}", "restitution: high}, transition: 5 um"),), ("'high'", "has a transition but no film")),
    ((("A: {bearing: pin", "C: {bearing: pen, contour: many"),), ("joint 'C'", "bearing 'pen'", "contour is 'many'")),
    (
        (("0.3 mm, zero", "0.3 s, zero"), ("0.1 kg", "1 kg / zero"), ("0.3 kg", "-1 kg")),
        ("mass is inf", "mass is -1 kg", "expected a length"),
    ),
    ((("0.3 kg", "-1 kg"), ("c: 0.5 mm", "c: 20 mm")), ("mass is -1 kg", "clearance is 0.02 m in scene worn")),
    ((("[0, -9.81 m/s^2]", "[0, -9.81 m/s^2, 0]"), ("L1.tail", "L3.tail")), ("3 components", "'L3'")),
    (
        (("L1: {length: 80 mm", "L1: {<<: {length: 80 mm}"), ("L2.tail", "L3.tail"), ("0.3 kg", "-1 kg")),
        ("merge keys", "'L3'", "mass is -1 kg"),
    ),
    (
        (("S: {", "x y: {"), ("{dry: {normal", "{dry-oil: {normal"), ("{O: [0", "{'1': [0")),
        ("this body", "this point", "this contact"),
    ),
]


@pytest.mark.parametrize(("patches", "message"), TOGETHER)
def test_they_are_told_together(patches: Patches, message: tuple[str, ...]) -> None:
    read_mechanism(TEXT.encode(), "m.yaml")
    with pytest.raises(InputErrors) as caught:
        read_mechanism(patched(TEXT, *patches).encode(), "m.yaml")
    errors = caught.value.errors
    places = [(error.where.line, error.where.column) for error in errors if error.where]
    assert places == sorted(places) and len(places) == len(errors)
    for words in message:
        assert any(words in error.message for error in errors), str(caught.value)


@pytest.mark.parametrize(
    ("patches", "message"),
    [
        ((("0.3 mm, zero", "0.3 lengths, zero"),), "lengths"),  # and not the clearance, which follows it
        ((("0.3 kg", "-1 kg"),), "mass is -1 kg"),  # once, and not of each scene
        ((("name: m\n", "name: m\nexpressions: {e: foo * 1 N, g: 2*e}\n"), ("1 N, 2 N", "g, 2 N")), "'foo'"),
    ],
)
def test_what_follows_from_a_mistake_is_not_told(patches: Patches, message: str) -> None:
    text = TEXT
    for old, new in patches:
        text = text.replace(old, new)
    with pytest.raises(InputError, match=message) as caught:
        read_mechanism(text.encode(), "m.yaml")
    assert not isinstance(caught.value, InputErrors)


def test_the_way_of_a_mass_is_short() -> None:
    """From the bytes of a file to the mass matrix: 32 functions handed it on."""
    script = ROOT / "tools" / "trace_mass.py"
    specified = subprocess.run([sys.executable, str(script)], check=True, capture_output=True, text=True).stdout
    functions = specified.splitlines()[-1].split()
    assert int(functions[0]) <= 15, specified

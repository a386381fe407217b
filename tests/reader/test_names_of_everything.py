"""Each name of a series, function or keyword names each kind of thing, or is refused with its place and a remedy."""

from __future__ import annotations

import re

import pytest

from gudgeon.errors import InputError, InputErrors
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.names import RESERVED, WORDS
from gudgeon.results.series import CLEARANCE, MOTION

TEXT = """\
format: gudgeon/1
name: m
parameters: {PARAMETER: 2 kg}
curves: {CURVE: {points: [[0, 0], [1, 1], [2, 0.5]], x: s, y: N*m}}
expressions: {EXPRESSION: "PARAMETER*BODY.theta"}
bodies:
  BODY: {mass: PARAMETER, inertia: 0.1 kg*m^2, points: {POINT: [-1 m, 0]}}
ground: {PLACE: [0, 0]}
joints:
  JOINT: {revolute: [ground.PLACE, BODY.POINT]}
forces: {FORCE: {torque: [ground, BODY], value: "CURVE(t) - 1/(1 kg)*EXPRESSION*(1 N)*(1 m)"}}
events: {EVENT: {zero: "BODY.theta + 20 deg + 0*EXPRESSION/(1 kg)"}}
outputs: {OUTPUT: "BODY.x*PARAMETER + BODY.POINT.x*(1 kg) + JOINT.Fx*(1 kg)*(1 m)/(1 N)"}
"""
ROLES = ("PARAMETER", "CURVE", "EXPRESSION", "BODY", "POINT", "PLACE", "JOINT", "FORCE", "EVENT", "OUTPUT")
OTHERS = (
    "kinetic",
    "residual",
    "drives",
    "torque",
    "Phi",
    "Phi_dot",
    "max",
    "time",
    "run",
    "samples",
    "at_events",
    "start_row",
    "compiled",
    "provenance",
    "series",
    "origin",
    "com",
    "name",
    "output",
    "q",
    "v",
    "a",
    "E",
    "F",
    "Fx",
    "M",
    "I",
    "N",
    "S",
    "state",
    "mode",
    "step",
    "method",
    "parameters",
)
NAMES = sorted({*FUNCTIONS, *RESERVED, *WORDS, *CLEARANCE, *(x for row in MOTION for x in row), *OTHERS})

PLAY = """\
materials: {MATERIAL: {E: 207 GPa, nu: 0.3}}
bearings:
  BEARING: {radius: 10 mm, clearance: 1 mm, length: 20 mm, bearing_material: MATERIAL, journal_material: MATERIAL}
guides:
  GUIDE: {gap: 0.1 mm, half_length: 20 mm, half_height: 10 mm, corner_radius: 1 mm, guide_material: MATERIAL,
          slider_material: MATERIAL}
contacts: {CONTACT: {normal: {law: flores, restitution: 0.5, geometry: internal}}, other: {extends: CONTACT}}
scenes:
  SCENE: {play: {JOINT: {bearing: BEARING, contact: CONTACT}}, peaks: OUTPUT}
  another: {extends: SCENE, play: {way: {guide: GUIDE, contact: other}}, peaks: [OUTPUT, JOINT.F]}
drives: {DRIVE: {angle: [BODY, wheel], value: 1 rad/s*t}}
"""
BODIES = """\
  wheel: {mass: 1 kg, inertia: 0.1 kg*m^2}
  slide: {mass: 1 kg, inertia: 0.1 kg*m^2}
ground: {"""
JOINTS = """\
  axle: {revolute: [ground.PLACE, wheel.origin]}
  way: {translational: [ground.PLACE, slide.origin], axis: [1, 0]}
forces: {"""
WHOLE = TEXT.replace("ground: {", BODIES).replace("forces: {", JOINTS) + PLAY
LABELS = ("MATERIAL", "BEARING", "GUIDE", "CONTACT", "SCENE", "DRIVE")
YAML_WORDS = ("null", "Null", "NULL", "true", "TRUE", "Yes", "no", "ON", "Off", "y", "n")


def written(names: dict[str, str], text: str = TEXT) -> bytes:
    return re.sub("|".join(names), lambda found: names[found[0]], text).encode()


@pytest.mark.parametrize("role", ROLES)
def test_a_name_is_usable_or_refused_with_a_remedy(role: str) -> None:
    usual = {each: f"my_{each.lower()}" for each in ROLES}
    for name in NAMES:
        if name == "N" and role in ("PARAMETER", "EXPRESSION"):
            continue  # it takes the place of the unit, with a message (test_unit_or_name)
        try:
            read_mechanism(written(usual | {role: name}), "m.yaml")
        except InputError as error:
            every = error.errors if isinstance(error, InputErrors) else (error,)
            own = [one for one in every if f"{name!r} cannot name" in str(one)]
            assert own and own[0].where is not None and own[0].where.line > 1, (role, name, str(error))
            remedy = re.search(r"such as (\w+)", str(own[0])) if "such as" in str(own[0]) else None
            if remedy:
                read_mechanism(written(usual | {role: remedy[1]}), "m.yaml")


@pytest.mark.parametrize("role", [*ROLES, *LABELS])
def test_a_word_of_yaml_is_usable_as_a_name_or_refused(role: str) -> None:
    usual = {each: f"my_{each.lower()}" for each in (*ROLES, *LABELS)}
    expected = str(read_mechanism(written(usual, WHOLE), "m.yaml").scenes.keys())
    for word in YAML_WORDS:
        try:
            found = read_mechanism(written(usual | {role: word}, WHOLE), "m.yaml")
            assert str(found.scenes.keys()).replace(f"'{word}'", "'my_scene'") == expected
        except InputError as error:
            every = error.errors if isinstance(error, InputErrors) else (error,)
            own = [one for one in every if f"{word!r} cannot name" in str(one)]
            assert own and own[0].where is not None and own[0].where.line > 1, (role, word, str(error))
            remedy = re.search(r"such as (\w+)", own[0].hint)
            assert remedy or word == "y"
            if remedy:
                read_mechanism(written(usual | {role: remedy[1]}, WHOLE), "m.yaml")

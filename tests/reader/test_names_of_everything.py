"""Each name of a series, function or keyword names each kind of thing, or is refused with its place and a remedy."""

from __future__ import annotations

import re

import pytest

from gudgeon.errors import InputError, InputErrors
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.names import RESERVED, WORDS
from gudgeon.language.tree import FUNCTIONS
from gudgeon.results.series import CLEARANCE, MOTION

TEXT = """\
format: gudgeon/1
name: m
parameters: {PARAMETER: 2 kg}
curves: {CURVE: {points: [[0, 0], [1, 1], [2, 0.5]], x: s, y: N*m}}
expressions: {EXPRESSION: "PARAMETER*BODY.theta"}
bodies: {BODY: {mass: PARAMETER, inertia: 0.1 kg*m^2, points: {POINT: [-1 m, 0]}}}
ground: {PLACE: [0, 0]}
joints: {JOINT: {revolute: [ground.PLACE, BODY.POINT]}}
forces: {FORCE: {torque: [ground, BODY], value: "CURVE(t) - 1/(1 kg)*EXPRESSION*(1 N)*(1 m)"}}
events: {EVENT: {zero: "BODY.theta + 20 deg + 0*EXPRESSION/(1 kg)"}}
outputs: {OUTPUT: "BODY.x*PARAMETER + BODY.POINT.x*(1 kg) + JOINT.Fx*(1 kg)*(1 m)/(1 N)"}
"""
ROLES = ("PARAMETER", "CURVE", "EXPRESSION", "BODY", "POINT", "PLACE", "JOINT", "FORCE", "EVENT", "OUTPUT")
OTHERS = ("kinetic", "residual", "drives", "torque", "Phi", "Phi_dot", "max", "time", "run", "samples", "at_events",
          "start_row", "compiled", "provenance", "series", "origin", "com", "name", "output", "q", "v", "a", "E",
          "F", "Fx", "M", "I", "N", "S", "state", "mode", "step", "method", "parameters")  # fmt: skip
NAMES = sorted({*FUNCTIONS, *RESERVED, *WORDS, *CLEARANCE, *(x for row in MOTION for x in row), *OTHERS})


def written(names: dict[str, str]) -> bytes:
    return re.sub("|".join(ROLES), lambda found: names[found[0]], TEXT).encode()


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

"""The contract of a law, of gudgeon's and of a user's: a joint with play that has it is derived, compiled and run.

Each law has a disc of its own, which flies in its bearing until it meets the wall. All discs are one scene, so the
laws are compiled once. `tests/equations/test_every_law.py` tests each law as a function.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.field import POSITIVE, RELATIONS, Field, number
from gudgeon.generator.kinds.laws.law import Law, LawInputs, find_all_laws
from gudgeon.generator.kinds.laws.registered import register
from gudgeon.language.units import STIFFNESS
from tests.kinds.own import forgotten
from tests.programs import needs_compiler

MASS, INERTIA, CLEARANCE, SPEED, SPIN = 0.2, 1e-4, 0.2e-3, 0.05, 20.0
KNOWN = {
    "stiffness": "1e6",
    "damping": "50",
    "mu": "0.1",
    "mu_s": "0.2",
    "v0": "0.01",
    "v1": "0.4",
    "v_r": "0.2",
    "v_s": "0.2",
    "decay": "0.1",
    "viscosity": "0.01",
    "roughness": "4 um",
    "restitution": "0.7",
    "presliding": "20 um",
    "force": "1e6 N/m * delta",
}
SPRING, FILM = "{law: hertz, restitution: 0.7}", "{law: ocvirk, viscosity: 0.01}"


def build(s: LawInputs) -> dict[str, Any]:
    return {"F_n": s.parameters["slope"] * s.variables["delta"] * (1 + s.variables["ratio"] / 4)}


MADE_UP = Law(
    "made_up",
    "normal",
    "a spring that loses energy",
    "nobody",
    "anywhere",
    (number("slope", "force by penetration", STIFFNESS, required=True, bounds=POSITIVE),),
    build,
)


def value_of(field: Field) -> str:
    """Return a number that the field's own bounds allow."""
    for value in (KNOWN.get(field.name, "1e6"), "1e6", "1", "0.5"):
        limits = [(bound.relation, bound.limit) for bound in field.bounds if field.name not in KNOWN]
        numbers = [(relation, limit) for relation, limit in limits if not isinstance(limit, str)]
        if all(RELATIONS[relation](float(value), limit) for relation, limit in numbers):
            return value
    raise AssertionError(f"no number for {field.name}")


def contact(law: Law) -> str:
    """Return a contact in which the law has what its role needs beside it."""
    numbers = "".join(f", {own.name}: {value_of(own)}" for own in law.parameters if own.required)
    own = f"{law.role}: {{law: {law.name}{numbers}}}"
    return {
        "normal": own,
        "friction": f"normal: {SPRING}, {own}",
        "film": f"normal: {SPRING}, {own}, transition: 20 um",
        "mixed": f"normal: {SPRING}, film: {FILM}, {own}",
    }[law.role]


def discs() -> str:
    """Return a mechanism with a disc for each law that is known now, "J_<law>" its joint."""
    play = ", ".join(f"J_{name}: {{bearing: b, contact: {name}}}" for name in find_all_laws())
    measures = "radius: 15 mm, clearance: 0.2 mm, length: 20 mm, bearing_material: steel, journal_material: steel"
    return f"""format: gudgeon/1
name: discs
materials: {{steel: {{E: 206 GPa, nu: 0.3}}}}
bodies: {{{", ".join(f"{name}: {{mass: {MASS}, inertia: {INERTIA}}}" for name in find_all_laws())}}}
ground: {{O: [0, 0]}}
joints: {{{", ".join(f"J_{name}: {{revolute: [ground.O, {name}.com]}}" for name in find_all_laws())}}}
bearings: {{b: {{{measures}}}}}
contacts:
{"".join(f"  {name}: {{{contact(law)}}}{chr(10)}" for name, law in find_all_laws().items())}
start:
  rates: {{{", ".join(f"{name}.omega: {SPIN}" for name in find_all_laws())}}}
  play: {{{", ".join(f"J_{name}: {{e: [0.18 mm, 0], rate: [{SPEED}, 0]}}" for name in find_all_laws())}}}
scenes: {{all: {{play: {{{play}}}}}}}
"""


@pytest.fixture
def made_up() -> Iterator[Law]:
    with forgotten():
        yield register(MADE_UP)


@needs_compiler
def test_every_law_works_in_a_joint(made_up: Law, tmp_path: Path) -> None:
    """Each law acts on its disc, all numbers are finite, and no disc gains energy."""
    file = tmp_path / "discs.yaml"
    file.write_text(discs())
    run = gudgeon.load(file, "all").simulate(2e-3, output=41)
    assert np.isfinite(run.q).all() and np.isfinite(run.a).all()
    for name, law in find_all_laws().items():
        along, spin = run[f"{name}.vx"], run[f"{name}.omega"]
        energy = 0.5 * MASS * (along**2 + run[f"{name}.vy"] ** 2) + 0.5 * INERTIA * spin**2
        assert (energy <= energy[0] * (1.0 + 1e-9)).all(), name
        assert along[0] == pytest.approx(SPEED) and along[-1] < 0.9 * SPEED, name
        if law.role == "friction":
            assert spin[-1] < (1.0 - 1e-6) * SPIN, name
        elif law.role != "normal":
            assert run[f"J_{name}.F"][0] > 0.0, name  # the film, before anything touches

"""Lines of laws and of joints with play in JavaScript: at any state what the compiled C has there."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.javascript.module import print_equations_script
from gudgeon.generator.targets.latex.trace import HighlightIndex, make_highlight_index
from gudgeon.loading.kernel_sources import find_mechanism
from gudgeon.model.evaluation import CLEARANCE_COLUMNS
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.scenes import loader
from tests.web.node import needs_node, node

pytestmark = [needs_compiler, needs_node]
LIVE = resources.files("gudgeon.generator.targets.latex").joinpath("current_values.js")
PINS = """
bodies: {j: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}, k: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}}
ground: {O: [0, 0], Q: [50 mm, 0]}
joints: {A: {revolute: [ground.O, j.origin]}, B: {revolute: [ground.Q, k.origin]}}
materials: {s: {E: 207 GPa, nu: 0.3}}
bearings:
  p: {radius: 10 mm, clearance: 0.3 mm, length: 20 mm, bearing_material: s, journal_material: s}
contacts:
  c:
    normal: {law: kelvin_voigt, stiffness: 1e6 N/m, damping: 50 N*s/m}
    friction: {law: dahl, mu: 0.3, presliding: 20 um}
    film: {law: pinkus_sternlicht, viscosity: 0.05 Pa*s, shear: true}
    transition: 20 um
  d:
    normal: {law: hertz, restitution: 0.8}
    film: {law: ocvirk, viscosity: 0.05 Pa*s}
    mixed: {law: christensen, roughness: 5 um}
  e: {normal: {law: hertz, restitution: 0.8}}
scenes:
  m: {play: {A: {bearing: p, contact: c}, B: {bearing: p, contact: d}}}
  worn:
    play:
      A: {bearing: p, contact: e}
      B: {bearing: p, contact: e, contour: [0, 20 um, 5 um, 0, 0, 30 um, 9 um, 0]}
"""
SLOT = """
bodies: {j: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}, k: {mass: 0.2 kg, inertia: 1e-5 kg*m^2, com: [1 mm, 2 mm]}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, j.origin]}, S: {translational: [j.origin, k.origin], axis: [2, 1]}}
materials: {s: {E: 207 GPa, nu: 0.3}}
guides: {g: {gap: 0.3 mm, half_length: 9 mm, half_height: 5 mm, guide_material: s, slider_material: s}}
contacts:
  c: {normal: {law: hertz, stiffness: 1e8, restitution: 0.8}, friction: {law: dahl, mu: 0.3, presliding: 20 um}}
scenes: {slot: {play: {S: {guide: g, contact: c}}}}
"""
OWN = {"m": PINS, "worn": PINS, "slot": SLOT}
SCENES = (pytest.param("dry", marks=pytest.mark.slow), "lubricated", *OWN)
ASKED = """
const live = require(process.argv[2]);
live.setEquations((() => {%s return gudgeonEquations;})());
globalThis.gudgeonHighlighting = {isHighlighted: (token) => token === globalThis.highlighted};
const told = (name) => live.formatValue(live.getValue(`tmp.${name}`)) && live.getValue(`tmp.${name}`);
console.log(JSON.stringify(%s.map((state) => {
    live.setState({...state, run: {memory: Float64Array.from(state.memory), t: [0]}, k: 0});
    return Object.fromEntries(%s.map((joint) => {
        globalThis.highlighted = `joint-${joint}`;
        return [joint, Object.fromEntries(%s.map((name) => [name, told(name)]))];
    }));
})));
"""


@dataclass
class Case:
    """States of a scene (rows), what C has of each joint there, and each line's value by joint that is lit."""

    simulation: Simulation
    found: HighlightIndex
    memory: Any
    columns: dict[str, dict[str, Any]]
    message: list[dict[str, dict[str, float | None | str]]]


def derived(scene: str, folder: Path) -> tuple[Simulation, HighlightIndex]:
    if scene in OWN:
        simulation = loader(folder)(OWN[scene], scene)
        return simulation, make_highlight_index(simulation.model)
    file = find_mechanism("nine_bar_press")
    return gudgeon.load("nine_bar_press", scene), make_highlight_index(
        derive_scene(file.read_bytes(), str(file), scene)
    )


@pytest.fixture(scope="module", params=SCENES)
def case(request: Any, tmp_path_factory: pytest.TempPathFactory) -> Case:
    """Ever further from where the journals are centred, and just in touch: free, in contact, latched or not yet."""
    folder, rng = tmp_path_factory.mktemp("play"), np.random.default_rng(11)
    simulation, found = derived(request.param, folder)
    compiled, start, count = simulation.compiled, simulation.start(), 4000
    p = compiled.prepare(
        np.zeros(len(compiled.source.parameters)), np.zeros(len(compiled.source.parameters), dtype=bool)
    )
    q = start.q + np.geomspace(2e-5, 2e-3, count)[:, None] * rng.uniform(-1.0, 1.0, compiled.n)
    v = start.v + rng.normal(0.0, 0.2, (count, compiled.n))
    joints = [joint.label for joint in found.model.clearances]
    memory = rng.uniform(-1.5e-5, 1.5e-5, (count, compiled.n_discrete_states))
    memory[:, : len(joints)] = np.where(rng.random((count, len(joints))) < 0.5, np.nan, 0.3)
    table = compiled.evaluate(np.zeros(count), q, v, memory, p).clearance
    deep = table[:, :, CLEARANCE_COLUMNS.index("e")] - p[[one.clearance for one in compiled.source.clearances]]
    kept = np.unique([*range(0, count, count // 24), *np.argsort(np.abs(deep), axis=0)[:12].ravel()])
    q, v, memory, table = q[kept], v[kept], memory[kept], table[kept]
    columns = {joint: dict(zip(CLEARANCE_COLUMNS, table[:, k].T, strict=True)) for k, joint in enumerate(joints)}
    states = [
        {"t": 0.0, "q": a, "v": b, "p": p.tolist(), "memory": m}
        for a, b, m in zip(q.tolist(), v.tolist(), memory.tolist(), strict=True)
    ]
    names = sorted(set(found.values["clearance.c"].values()))
    script = ASKED % (print_equations_script(found.program), *map(json.dumps, (states, joints, names)))
    (folder / "ask.js").write_text(script, encoding="utf-8")
    program = node()
    assert program
    done = subprocess.run([program, str(folder / "ask.js"), str(LIVE)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return Case(simulation, found, memory, columns, json.loads(done.stdout))


def forces(case: Case, joint: str, message: dict[str, Any]) -> tuple[float, float]:
    """Along n and t, from the lines that say so last."""
    pin = next(pin for pin in case.found.program.joints if pin.clearance.label == joint)
    along = {role: f"law.{part}_{joint}_.F_{of}" for role, part, of in (("normal", "dry", "n"), ("film", "film", "r"))}
    blended = message.get(f"law.clearance_{joint}_.F.n")
    if blended is not None:
        return blended, message[f"law.clearance_{joint}_.F.t"]
    if "normal" in pin.laws and message[along["normal"]] is not None:
        pressed = message.get(f"law.dry_{joint}_.F_N", message[along["normal"]])
        return -pressed, message[f"law.dry_{joint}_.F_along_t_dry"]
    if "film" in pin.laws:
        return message[along["film"]], message[f"law.{pin.laws['film'].kernel.name}.F_t_out"]
    return 0.0, 0.0


def test_forces_are_those_of_the_compiled_scene(case: Case) -> None:
    """Free, in contact, latched or not, in the transition: each joint when it is lit."""
    met = set()
    for joint, want in case.columns.items():
        for k, message in enumerate(row[joint] for row in case.message):
            front = f"law.clearance_{joint}_."
            own = {name.rpartition(".")[2]: x for name, x in message.items() if name.startswith(front)}
            scale = float(np.abs(want["Fn"]).max())
            along_n, along_t = forces(case, joint, message)
            assert along_n == pytest.approx(-want["Fn"][k], rel=1e-11, abs=1e-13 * scale), (joint, k)
            assert along_t == pytest.approx(want["Ft"][k], rel=1e-9, abs=1e-13 * scale), (joint, k)
            assert own["e"] == pytest.approx(want["e"][k], rel=1e-9)
            assert own["deltadot"] == pytest.approx(want["deltadot"][k], rel=1e-9, abs=1e-12)
            slip = message.get(f"law.dry_{joint}_.v_t")
            assert (slip or 0.0) == pytest.approx(want["vt"][k], rel=1e-9, abs=1e-12)
            closed = bool(np.isfinite(case.memory[k, list(case.columns).index(joint)]))
            met.add((slip is not None, closed, message.get(f"law.clearance_{joint}_.F.n") is not None))
    has_transition = any(pin.has_transition for pin in case.found.program.joints)
    assert {(False, False, False), (True, True, False), (True, False, False)} <= met
    assert has_transition == any(blended for _, _, blended in met)


def test_of_a_branch_one_line_has_a_value_where_the_function_is_run(case: Case) -> None:
    values = case.found.values["clearance.c"]
    branches = {one.split("<")[0] for one in values.values() if "<" in one}
    assert branches or case.simulation.source.scene in OWN
    for row in case.message:
        for joint, message in row.items():
            for name in branches:
                sides = [message[one] for one in message if one.startswith((f"{name}<", f"{name}>"))]
                run = (
                    message[next(one for one in message if one.startswith(f"{name.rpartition('.')[0]}.side"))]
                    is not None
                )
                assert len(sides) == 2 and sum(x is not None for x in sides) == run, (joint, name)


def test_every_line_that_stores_has_a_value(case: Case) -> None:
    """Read as text: numbers that are assigned, or filled by a call; no whole structs, no switches that do not act."""
    values, message, within = case.found.values["clearance.c"], "", False
    for number, line in enumerate(case.found.source.files["clearance.c"].split("\n"), 1):
        code = re.sub(r"/[*].*?[*]/", "", line).strip()
        if line in ("{", "}"):
            within, message = line == "{", ""
            continue
        message = f"{message} {code}".strip() if within else ""
        if message.endswith((";", "{", "}", "else")) or message.startswith("if (") and message.endswith(")"):
            stores = re.fullmatch(r"(?:const double )?[*\w.]+ [+]?= (?!dry_|[(]Clearance).*;|.*[(].*&\w.*[)];", message)
            assert (number in values) == bool(stores), (number, message)
            message = ""

"""Names of a file equal to identifiers of emitted code, of the engine and of languages do not change a number."""

from __future__ import annotations

import json
import random
import re
import subprocess
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadNameError
from gudgeon.generator.kernels.program import make_program
from gudgeon.generator.pipeline import derive_scene, generate_c, generate_kernel_source
from gudgeon.generator.symbols.symbols import make_identifier
from gudgeon.generator.targets.javascript.module import print_equations_script
from gudgeon.language.names import check_name
from gudgeon.loading.engine import read_engine_files
from tests.slow import slow_but
from tests.targets_c.test_names_in_c import THINGS, TRIED, VALID
from tests.web.node import node

FOUND_BEFORE = ("k", "next", "share", "g_v", "root_far", "a_0_", "bent", "at", "sum", "part_1", "still_1", "k_inverse")
ROLES = 12  # names of a scene but parameters
EACH = 60  # parameters of a scene
ASKED = """
const {functions, argumentNames, parameterIndices} = (() => {SCRIPT return gudgeonEquations;})(), p = {};
for (const [name, k] of Object.entries(parameterIndices)) p[name] = 1 + k / 8;
const state = {t: 0.3, q: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], v: [1, -1, 2, -2, 3, -3], p};
const got = ["constraints", "acceleration_rhs", "jacobian"].map((name) =>
    Object.values(functions[name](...argumentNames[name].map((one) => state[one]))).flat());
console.log(JSON.stringify(got.flat().filter((x) => typeof x === "number")));
"""


def scene(names: list[str]) -> bytes:
    """A driven double pendulum with every kind of name; a parameter counts by its place in `names`."""
    a, b, upper, pin, drive, coil, push, out, curve, event, point, mean = names[:ROLES]
    parameters = names[ROLES:]
    defined = ", ".join(f"{name}: {1.0 + 0.125 * k} N*m" for k, name in enumerate(parameters))
    groups = [parameters[k : k + 10] for k in range(0, len(parameters), 10)]
    forces = "\n".join(
        f"  push_{k}: {{torque: {b}, value: -0.02*({' + '.join(f'{(3 + j) / 8}*{x}' for j, x in enumerate(group))})"
        f"*sin({b}.theta + {k + 1}*t/(4 s))}}"
        for k, group in enumerate(groups)
    )
    return f"""
format: gudgeon/1
name: clash
gravity: [0, -9.81 m/s^2]
parameters: {{{defined}}}
curves: {{{curve}: {{points: [[0, 0.1], [0.3, 0.3], [0.7, 0.2], [1, 0.4]], x: s, y: N*m}}}}
expressions: {{{mean}: 0.5*({a}.theta + {b}.theta)}}
bodies:
  {a}: {{length: 0.3 m, mass: 1 kg, inertia: 8e-3 kg*m^2, points: {{{point}: [0.1 m, 0.02 m]}}}}
  {b}: {{length: 0.2 m, mass: 0.5 kg, inertia: auto}}
ground: {{O: [0, 0]}}
joints: {{{upper}: {{revolute: [ground.O, {a}.tail]}}, {pin}: {{revolute: [{a}.head, {b}.tail]}}}}
forces:
  {coil}: {{spring_damper: [ground.O, {b}.head], stiffness: 30 N/m, free_length: 0.4 m, damping: 0.5 N*s/m}}
  {push}: {{torque: {a}, value: {curve}(t) - 0.1 N*m*{mean}}}
  {drive}: {{force: {a}.{point}, value: [1 N, -0.3 N*s/m*{a}.{point}.vx]}}
{forces}
start: {{set: {{{a}.theta: 0.4 rad, {b}.theta: -0.2 rad}}}}
outputs: {{{out}: {a}.theta + 2*{b}.omega*(1 s)}}
events: {{{event}: {{zero: {b}.theta}}}}
scenes: {{swing: {{simulate: {{t_end: 0.2 s, output: 8}}}}}}
""".encode()


def smooth(names: list[str]) -> bytes:
    """The same without what has no series."""
    text = scene(names).decode()
    return text.replace(f"{names[8]}(t) - ", "0.1 N*m*cos(t/(1 s)) - ").encode()


def accepted(name: str) -> bool:
    """Whether a file may give everything this name."""
    try:
        for what in ("parameter", "body", "output", "curve", "expression", "event"):
            check_name(name, what, None)
    except BadNameError:
        return False
    return name not in ("origin", "com", "tail", "head", "x", "y", "theta", "vx", "vy", "omega")


@cache
def vocabulary() -> tuple[str, ...]:
    """Every identifier of the C, JavaScript and Python of some scenes, of the engine and of the languages."""
    neutral = [f"n{k}" for k in range(ROLES + 10)]
    texts = [
        *generate_kernel_source(smooth(neutral), "f", "swing", formulation="taylor").files.values(),
        *read_engine_files().values(),
    ]
    for file, of in (("slider_crank", "oiled"), ("double_pendulum", "dry")):
        model = derive_scene((VALID / f"{file}.yaml").read_bytes(), "f", of)
        texts += [*generate_c(model).files.values(), print_equations_script(make_program(model)), model.numpy().source]
    words = {word for text in texts for word in re.findall(r"[A-Za-z]\w*", text)}
    words |= {word.rstrip("_") for word in words} | {*THINGS, *TRIED, *FOUND_BEFORE}
    return tuple(sorted(filter(accepted, words)))


def numbers(data: bytes, names: list[str], folder: Path, methods: tuple[str, ...]) -> dict[str, Any]:
    """What runs by each method give, lanes, the right-hand side in NumPy; by what it is."""
    (folder / "f.yaml").write_bytes(data)
    found: dict[str, Any] = {}
    loaded = gudgeon.load(folder / "f.yaml", scene="swing")
    for method in methods:
        run = loaded.simulate(method=method)
        found[method] = [run[f"{names[0]}.theta"], run[f"{names[1]}.omega"], run[names[7]], run.events["t"]]
    first = names[ROLES]
    batch = loaded.simulate_many({first: [0.5, 1.0, 1.5, 2.0]}, method="dop853")
    found["lanes"] = [batch[f"{names[1]}.theta"]]
    equations, (t, q, v) = loaded.model.numpy(), (0.3, np.linspace(0.1, 0.6, 6), np.linspace(-1.0, 1.0, 6))
    p = equations.prepare()
    found["numpy"] = [equations.phi(t, q, p), equations.gamma(t, q, v, p)]
    return found


def compare(one: dict[str, Any], other: dict[str, Any]) -> None:
    for what, values in one.items():
        for a, b in zip(values, other[what], strict=True):
            np.testing.assert_allclose(b, a, rtol=1e-9, atol=1e-10, err_msg=what)


def drawn(seed: int) -> list[str]:
    words = [word for word in vocabulary() if word not in FOUND_BEFORE]
    rng = random.Random(seed)
    names = [*rng.sample(words, EACH), *(word for word in FOUND_BEFORE if accepted(word))]
    rng.shuffle(names)
    return names


def test_the_vocabulary_holds_what_code_has() -> None:
    assert {"dynamics", "N_ROWS", "rhs", "k", "omega_i", "weight", "rodas5p", "Lanes"} <= set(vocabulary())
    assert len(vocabulary()) > 2000


def test_no_fixed_name_has_the_form_of_those_that_are_made() -> None:
    """What `make_identifier` returns ends in one underscore; no identifier of the engine and of the templates does."""
    templates = [
        one.read_text(encoding="utf-8")
        for one in resources.files("gudgeon.templates").joinpath("c").iterdir()
        if one.name.endswith(".jinja")
    ]
    code = [
        re.sub(r"/\*.*?\*/|\w+##\w*", " ", text, flags=re.S) for text in (*read_engine_files().values(), *templates)
    ]
    words = {word for text in code for word in re.findall(r"\b[A-Za-z]\w*", text)}
    assert not [word for word in words if make_identifier(word) == word]
    for expected in ("k", "k_", "A.x", "a__b", "é"):
        assert re.fullmatch(r"[A-Za-zé0-9]+(_[A-Za-z0-9]+)*_", make_identifier(expected))


@pytest.mark.parametrize("seed", slow_but([0], range(40)))
def test_runs_under_names_of_emitted_code(seed: int, tmp_path: Path) -> None:
    hostile = drawn(seed)
    neutral = [f"q{k:03}z" for k in range(len(hostile))]
    found = [numbers(scene(names), names, tmp_path, ("dop853", "rodas5p")) for names in (neutral, hostile)]
    compare(*found)


@pytest.mark.parametrize("seed", slow_but([1], range(1, 40)))
def test_series_under_names_of_emitted_code(seed: int, tmp_path: Path) -> None:
    """`taylor`: the order k, 1/k, sums and stored values of the series are no names of the file."""
    hostile = drawn(seed)
    neutral = [f"q{k:03}z" for k in range(len(hostile))]
    compare(*[numbers(smooth(names), names, tmp_path, ("taylor",)) for names in (neutral, hostile)])


@pytest.mark.skipif(node() is None, reason="Node is not installed")
@pytest.mark.parametrize("seed", slow_but([2], range(2, 20)))
def test_javascript_under_names_of_emitted_code(seed: int, tmp_path: Path) -> None:
    hostile, found = drawn(seed), []
    for names in ([f"q{k:03}z" for k in range(len(hostile))], hostile):
        script = print_equations_script(make_program(derive_scene(smooth(names), "f", "swing")))
        (tmp_path / "ask.js").write_text(ASKED.replace("SCRIPT", script), encoding="utf-8")
        done = subprocess.run([str(node()), str(tmp_path / "ask.js")], capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        found.append(json.loads(done.stdout))
    np.testing.assert_allclose(sorted(found[1]), sorted(found[0]), rtol=1e-12, atol=1e-12)


ROD = """
format: gudgeon/1
name: torsion_rod
parameters: {{{k}: 3 N*m}}
bodies: {{rod: {{length: 300 mm, mass: 1 kg, inertia: 8e-3 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{pin: {{revolute: [ground.O, rod.tail]}}}}
forces: {{twist: {{torque: rod, value: -{k}*sin(rod.theta)}}}}
start: {{set: {{rod.theta: 40 deg}}}}
"""


@pytest.mark.parametrize("name", ["k", "next", "share", "a_0_"])
def test_a_parameter_is_not_the_order_of_a_series(name: str, tmp_path: Path) -> None:
    (tmp_path / "rod.yaml").write_text(ROD.format(k=name), encoding="utf-8")
    run = gudgeon.load(tmp_path / "rod.yaml").simulate(2.0, output=1, method="taylor", rtol=1e-12)
    assert run["rod.theta"][-1] == pytest.approx(0.6484685601913911, abs=1e-10)  # SciPy's DOP853


TWO = """
format: gudgeon/1
name: two
parameters: {{c: 0.3 mm, {g}: 8 N}}
bodies: {{j: {{mass: 0.2 kg, inertia: 1e-5 kg*m^2}}, k: {{mass: 0.2 kg, inertia: 1e-5 kg*m^2}}}}
ground: {{O: [0, 0], Q: [50 mm, 0]}}
joints: {{A: {{revolute: [ground.O, j.origin]}}, B: {{revolute: [j.origin, k.origin]}}}}
forces:
  load: {{force: j.origin, value: [0, -{g}]}}
  other: {{force: k.origin, value: [4 N, 20 N]}}
  turn: {{torque: j, value: 1e-2 N*m}}
materials: {{s: {{E: 207 GPa, nu: 0.3}}}}
bearings: {{p: {{radius: 10 mm, clearance: c, length: 20 mm, bearing_material: s, journal_material: s}}}}
contacts:
  c: {{normal: {{law: {law}}}, friction: {{law: lugre, mu: 0.15, mu_s: 0.2, v_s: 1 cm/s,
      stiffness: 2e4 1/m, damping: 3 s/m}}}}
scenes: {{m: {{play: {{A: {{bearing: p, contact: c}}, B: {{bearing: p, contact: c}}}}}}}}
"""


@pytest.mark.parametrize(("name", "law"), [("g_v", "lankarani_nikravesh"), ("root_far", "johnson")])
def test_a_parameter_is_not_an_abbreviation_of_a_law(name: str, law: str, tmp_path: Path) -> None:
    found = []
    for called in ("neutral", name):
        keys = law if law == "johnson" else f"{law}, restitution: 0.8"
        text = TWO.format(g=called, law=keys)
        (tmp_path / "two.yaml").write_text(text, encoding="utf-8")
        loaded = gudgeon.load(tmp_path / "two.yaml", scene="m")
        found.append(loaded.simulate(5e-3, output=5)["k.x"])
    np.testing.assert_allclose(found[1], found[0], rtol=0, atol=1e-13)

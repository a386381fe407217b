"""No symbol of a document stands for two quantities: compared with a copy whose parameters have unique names."""

from __future__ import annotations

import re
from functools import cache

import pytest

from gudgeon.generator.equations.model import Model
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.latex import render_equations_html, render_equations_tex, render_equations_text
from gudgeon.generator.targets.latex.theory import find_sketch_symbols
from gudgeon.teaching.notebook import write_notebook
from tests.slow import slow_but
from tests.targets_latex.equations_reader import NAME, rows, sections
from tests.targets_latex.test_equations import SLIDER, model_of

# Each parameter is called like something that the documents of one of the scenes speak of; <n> is one of them.
FILE = """format: gudgeon/1
name: clash
gravity: [0, -<g>]
parameters: {<n>: 2 m, <M>: 1 kg, <g>: 9.81 m/s^2, <q>: 1 N, <v>: 2 m/s, <e>: 0.5, <Phi>: 1 m, <delta>: 1 mm,
  <lambda_1>: 2 N, <gamma>: 3 1/s, <R>: 10 mm, <R_i>: 1, <c>: 0.1 mm, <F>: 3 N, <mu>: 0.1, <K>: 100 N/m, <d>: 1 m,
  <omega>: 2 rad/s, <alpha>: 0.2, <nu>: 0.3, <i>: 1 kg, <F_x>: 1 N, <c_e>: 0.5, <Phi_1>: 1 m, <x_a>: 1 m, <w>: 1 m,
  <v_rub>: 1 m/s, <z_top>: 1 m, <L>: 20 mm, <r_P>: 1 m, <beta>: 1 N, <f>: 1 N, <W>: 1 N, <epsilon>: 1 N}
bodies:
  a: {length: <n>, mass: <M> + <i>, inertia: 1 kg*m^2, points: {p: [<Phi>, <delta>], z: [<x_a>, <r_P>]}}
  b: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2, points: {p: [<d>, <Phi_1>], z: [<w>, <z_top>]}}
ground: {O: [0, 0], P: [1 m, 0]}
joints: {A: {revolute: [ground.O, a.tail]}, B: {revolute: [a.head, b.tail]}}
materials: {steel: {E: 200 GPa, nu: <nu>}}
bearings: {pin: {radius: <R>, length: <L>, clearance: <c>, bearing_material: steel, journal_material: steel}}
contacts:
  dry:
    normal: {law: lankarani_nikravesh, restitution: <c_e>}
    friction: {law: coulomb, mu: <mu>, v0: 1 mm/s}
  oil: {extends: dry, film: {law: pinkus_sternlicht, viscosity: 100 cP}, transition: 1 um}
drives: {turn: {angle: a, value: "<omega>*t + <gamma>*t*<e> + <alpha>*<R_i>"}}
forces:
  coil: {spring_damper: [ground.P, b.p], stiffness: <K>, free_length: 77.85 mm, damping: 3}
  push: {force: b.z, value: ["<F> + <F_x> + <q> + <lambda_1>", "<beta> + <f> + <W> + <epsilon>"]}
  rub: {dry_friction: [ground.P, b.p], direction: [1, 2], speed: <v> + <v_rub>, static: 5 N, kinetic: 4 N}
  motor: {torque: b, value: "0.1 N*m*sin(<omega>*t)"}
events: {top: {zero: a.z.vy}}
scenes:
  dry: {play: {B: {bearing: pin, contact: dry}}}
  oiled: {play: {B: {bearing: pin, contact: oil}}}
"""
NAMES = re.findall(r"<(\w+)>: ", FILE)
ALWAYS = {
    "n'",
    "M'",
    "g'",
    "q'",
    "Φ'",
    "λ_1'",
    "γ'",
    "F'",
    "d'",
    "α'",
    "β'",
    "ν'",
    "Φ_1'",
    "x_a'",
    "v_rub'",
    "v'",
    "z_top'",
    "r_P'",
}
OF_PLAY = {"e'", "δ'", "R_i'", "c'", "K'", "i'", "F_x'", "c_e'", "L'"}
PRIMED = {"ideal": ALWAYS, "dry": ALWAYS | OF_PLAY, "oiled": ALWAYS | OF_PLAY | {"ε'", "f'", "W'", "μ'"}}


@cache
def clash(scene: str, twin: bool = False) -> Model:
    """The scene; its twin has parameters of which no document speaks."""
    called = {name: f"zz{chr(97 + k // 26)}{chr(97 + k % 26)}" if twin else name for k, name in enumerate(NAMES)}
    return derive_scene(re.sub(r"<(\w+)>", lambda m: called[m[1]], FILE).encode(), "clash.yaml", scene)


@pytest.mark.parametrize("scene", slow_but(["ideal", "oiled"], PRIMED))
def test_no_parameter_has_a_letter_of_the_document(scene: str) -> None:
    found = sections(render_equations_text(clash(scene)))
    letters = [cells[1] for cells in rows(found["Parameters"]) if cells[0] in NAMES]
    assert len(set(letters)) == len(letters) == len(NAMES)
    text = re.sub(r"\b[A-Z]\.(?= )", "", render_equations_text(clash(scene, twin=True)))  # initials of people
    others = set(NAME.findall(text))
    assert others & set(letters) == set()
    message = [cells for cells in rows(found["Symbols"]) if len(cells) == 4 and cells[1].startswith("parameters.")]
    assert {letter for letter in letters if "'" in letter} == {cells[0] for cells in message} == PRIMED[scene]
    assert all(cells[0] == f"{cells[2]}'" and cells[2] in others for cells in message)


def test_every_target_tells_of_its_primes() -> None:
    model, message = clash("dry"), "distinguishes two quantities with the same symbol"
    pytest.importorskip("latex2mathml")
    for text in (render_equations_tex(model), render_equations_html(model), write_notebook(model, "clash.yaml")):
        assert " ".join(text.split()).count(message) == 1
    assert "{\\\\gamma}'" in write_notebook(model, "clash.yaml")
    assert r"${\Phi_{1}}'$ & parameters.Phi\_1" in render_equations_tex(model)


def test_a_file_whose_letters_are_its_own_is_told_of_none() -> None:
    """A clearance c and a bearing's c are two things; where no joint has play, c is free."""
    assert "Symbols" not in sections(render_equations_text(model_of("press ideal")))
    dry = sections(render_equations_text(model_of("press dry")))
    assert [cells[:3] for cells in rows(dry["Symbols"])][2:] == [["c'", "parameters.c", "c"]]
    assert "Symbols" not in sections(render_equations_text(derive_scene(SLIDER.encode(), "slider.yaml", "ideal")))


def test_letters_of_a_sketch() -> None:
    """Words, initials, articles and corners of a drawing are none; what has a dot is told without it too."""
    lines = ["A force at a point  o--[=--o Q   F = k (l − l_0) + d l̇²", "L. C. Bo, ‖r_P‖ sgn v/v_s"]
    assert set(find_sketch_symbols(lines)) == {"Q", "F", "k", "l", "l_0", "d", "l\u0307", "r_P", "v", "v_s"}

"""The three formats: hostile text, names, determinism, and that each is well formed."""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
from dataclasses import replace
from importlib import resources
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gudgeon.generator.equations.model import Model
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.latex import (
    pictures,
    plots,
    render_equations_html,
    render_equations_tex,
    render_equations_text,
)
from gudgeon.generator.targets.latex.letters import make_name_from_latex, make_symbol_name, make_user_symbol_name
from gudgeon.generator.targets.latex.notation import make_notation
from gudgeon.generator.targets.latex.render import _MATH_COMMANDS, _TEXT_COMMANDS, escape_latex, escape_sketch_line
from tests.slow import slow_but
from tests.targets_latex.equations_reader import sections, width
from tests.targets_latex.test_equations import EVERY, SLIDER, WITH_ROWS, model_of
from tests.targets_latex.test_equations_play import BOB

SHIPPED = resources.files("gudgeon.mechanisms")
# the text of the others is read in test_equations.py
PROSE = slow_but(["slider oiled", "random 5"], EVERY)
FILES = slow_but(  # a chain, play, friction, belts
    [f"{name}.yaml" for name in ("slider_crank_spring", "bouncing_ball", "shaker", "belt_block")],
    sorted(file.name for file in SHIPPED.iterdir() if file.name.endswith(".yaml")),
)
PENDULUM = SHIPPED.joinpath("pendulum.yaml").read_bytes()
HOSTILE = r"\input{/etc/passwd} $x$ 100% {#1} a_b^c & ~ <script>alert('1')</script> <!-- \end{document}"
# What may stand in escaped LaTeX: plain characters, escaped signs, commands without arguments, accents, short formulas.
SAFE = re.compile(
    r"(?:[A-Za-z0-9 .,;:!?'`()*+/=@\[\]~-]|\\[{}$&#%_]|\\(?:text[a-z]+|ldots|ss|o|O|ae|AE|oe|l|L|i)\{\}"
    r"|\\rule\{1ex\}\{1ex\}|\\[`'^~=.\"a-zA-Z]\{(?:[A-Za-z]|\\i\{\})\}|\$(?:\\[A-Za-z]+|[-{}^0-9]|\{|\})+\$)*"
)


def titled(model: Model, title: str) -> Model:
    """The same model with another title; the reader refuses some that an embedding program may set."""
    return replace(model, scene=replace(model.scene, mechanism=replace(model.scene.mechanism, title=title)))


def test_a_hostile_title_is_only_text() -> None:
    model = titled(derive_scene(PENDULUM, "pendulum.yaml", "ideal"), HOSTILE)
    source = render_equations_tex(model)
    assert r"\input" not in source and source.count(r"\end{document}") == 1
    (line,) = [line for line in source.splitlines() if line.startswith(r"{\Large")]
    assert SAFE.fullmatch(line.removeprefix(r"{\Large ").removesuffix(r"\par}"))
    assert render_equations_text(model).splitlines()[0] == HOSTILE
    pytest.importorskip("latex2mathml")
    page = render_equations_html(model)
    assert "<!--" not in page and "<script>alert" not in page and "&lt;script&gt;" in page


@given(st.text(max_size=40))
@settings(derandomize=True, max_examples=300, deadline=None)
def test_any_text_becomes_harmless_latex(text: str) -> None:
    assert SAFE.fullmatch(escape_latex(text)), escape_latex(text)
    assert escape_latex(text).isascii() and escape_sketch_line(text).isascii()


@pytest.mark.parametrize("sign", [*_TEXT_COMMANDS, *_MATH_COMMANDS])
def test_every_sign_with_a_command_of_its_own(sign: str) -> None:
    """Random text meets few of them."""
    assert SAFE.fullmatch(escape_latex(sign)), escape_latex(sign)
    assert (
        escape_latex(sign) and escape_latex(sign).isascii() and escape_latex(f"a{sign}b") == f"a{escape_latex(sign)}b"
    )


@given(st.text(alphabet=st.characters(min_codepoint=32, max_codepoint=126), max_size=40))
@settings(derandomize=True, max_examples=200, deadline=None)
def test_ascii_is_kept_to_the_letter(text: str) -> None:
    """Undo the escapes: the text must come back."""
    names = {
        "backslash": "\\",
        "asciicircum": "^",
        "asciitilde": "~",
        "less": "<",
        "greater": ">",
        "bar": "|",
        "quoteleft": "`",
    }
    back = re.sub(r"\\text([a-z]+)\{\}|\\([{}$&#%_])", lambda m: names[m[1]] if m[1] else m[2], escape_latex(text))
    assert back == text.replace('"', "''")


def check_latex(source: str) -> None:
    """ASCII, one package, whose braces, environments and delimiters are closed."""
    assert source.isascii()
    packages = re.findall(r"\\usepackage(?:\[[^]]*\])?\{(\w+)\}", source)
    assert packages == ["amsmath"]
    bare = re.sub(r"\\[{}]", "", source)
    depth = 0
    for character in bare:
        depth += (character == "{") - (character == "}")
        assert depth >= 0
    assert depth == 0
    for environment in set(re.findall(r"\\begin\{(\w+)\}", source)):
        assert source.count(rf"\begin{{{environment}}}") == source.count(rf"\end{{{environment}}}")
    assert bare.count(r"\left(") == bare.count(r"\right)") and bare.count(r"\bigl(") == bare.count(r"\bigr)")
    assert not re.search(r"frac\{[^{}]*\}\{1\}", source)  # no integer as a fraction


@pytest.mark.parametrize("which", slow_but(["slider oiled", "random 5"], EVERY))
def test_latex_is_well_formed(which: str) -> None:
    check_latex(render_equations_tex(model_of(which)))


@pytest.mark.parametrize("which", PROSE)
def test_prose_and_equations_stay_within_their_columns(which: str) -> None:
    for line in render_equations_text(model_of(which)).splitlines():
        if re.match(r" {8}\S|  (?!Φ )\S+ = |\S", line):
            assert width(line) <= 100


@pytest.mark.parametrize("which", WITH_ROWS)
def test_every_symbol_has_a_name_of_its_own(which: str) -> None:
    model = model_of(which)
    notation = make_notation(model)
    texts = [name.text for name in notation.names.values()]
    assert len(set(texts)) == len(texts)
    latex = [name.latex for name in notation.names.values()]
    assert len(set(latex)) == len(latex)
    for row in model.rows:
        for value in (row.phi, row.nu, row.gamma, *row.phi_q.values()):
            assert notation.expand_symbols(value).free_symbols <= set(notation.names)


def test_letters() -> None:
    assert (
        make_symbol_name("theta", "L7").latex == r"\theta_{\text{L7}}"
        and make_symbol_name("theta", "L7").text == "θ_L7"
    )
    assert make_symbol_name("x", "my_bar", dots=1).latex == r"\dot{x}_{\text{my\_bar}}"
    assert [make_user_symbol_name(name).text for name in ("omega4", "l5", "v_max", "speed", "omega_in_2")] == [
        "ω_4",
        "l_5",
        "v_max",
        "speed",
        "ω_in_2",
    ]
    assert [make_name_from_latex(sign).text for sign in ("c_e", r"\mu", r"\sigma_{0}", r"v_{\mathrm{s}}")] == [
        "c_e",
        "μ",
        "σ_0",
        "v_s",
    ]


def test_the_same_bytes_under_another_hash_seed() -> None:
    code = (
        "import hashlib\n"
        "from gudgeon.generator.pipeline import derive_scene\n"
        "from gudgeon.generator.targets.latex import render_equations_tex, render_equations_text\n"
        f"m = derive_scene({BOB!r}.encode(), 'bob.yaml', 'lubricated')\n"
        "print(hashlib.sha256((render_equations_tex(m) + render_equations_text(m)).encode()).hexdigest())"
    )
    env = {**os.environ, "PYTHONHASHSEED": "1"}
    other = subprocess.run([sys.executable, "-c", code], env=env, check=True, capture_output=True, text=True).stdout
    model = derive_scene(BOB.encode(), "bob.yaml", "lubricated")
    assert (
        other.strip()
        == hashlib.sha256((render_equations_tex(model) + render_equations_text(model)).encode()).hexdigest()
    )


@pytest.mark.parametrize("which", slow_but(["slider oiled"], ["slider oiled", "press lubricated", "zoo"]))
def test_html_is_self_contained_mathml(which: str) -> None:
    pytest.importorskip("latex2mathml")
    page = render_equations_html(model_of(which))
    formulas = re.findall(r"<math.*?</math>", page, re.S)
    assert len(formulas) > 100
    for formula in formulas:
        assert len(ElementTree.fromstring(formula)) > 0
        assert "\\" not in formula  # no LaTeX is left over
    assert not re.search(r"https?://|<script[^>]* src|<link|<img|@import|url\(", page)


def test_html_tells_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    from gudgeon.errors import GudgeonError

    monkeypatch.setitem(sys.modules, "latex2mathml.converter", None)
    with pytest.raises(GudgeonError, match=r"gudgeon\[docs\]"):
        render_equations_html(derive_scene(PENDULUM, "pendulum.yaml", "ideal"))


def test_a_free_body_without_gravity() -> None:
    """No joint, no drive, no gravity, no parameter."""
    model = derive_scene(
        b"format: gudgeon/1\nname: stone\nbodies: {b: {mass: 1 kg, inertia: 1 kg*m^2}}\n", "s.yaml", "ideal"
    )
    document = sections(render_equations_text(model))
    text = render_equations_text(model)
    assert "Constraints" not in document and "Jacobian" not in document and "Drives" not in document
    assert "g is zero" in " ".join(document["Generalized forces"]) and "3 - 0 = 3" in text
    assert "No gravity" in " ".join(document["Left out of this scene"])
    assert r"M \ddot{q}" in render_equations_tex(model)


def test_without_gravity_nothing_of_it_is_shown() -> None:
    text = render_equations_text(
        derive_scene(SLIDER.replace("gravity: [0, -9.81 m/s^2]\n", "").encode(), "s.yaml", "ideal")
    )
    assert "g_y" not in text and "9.81" not in text and "No gravity" in text


@pytest.mark.parametrize("name", FILES)
def test_every_shipped_mechanism_and_scene(name: str) -> None:
    data = SHIPPED.joinpath(name).read_bytes()
    first = derive_scene(data, name, "ideal")
    for scene in first.scene.mechanism.scenes:
        model = derive_scene(data, name, scene)
        assert render_equations_text(model).count("Φ_1 = ") == bool(model.rows)
        check_latex(render_equations_tex(model))


def test_what_keeps_numbers_finite_is_not_shown() -> None:
    """A product that stays together, and a rate that is taken from differences where it is no number."""
    text = """format: gudgeon/1
name: steep
bodies: {a: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {o: [0, 0]}
joints: {g: {translational: [ground.o, a.origin], axis: [1, 0]}}
drives: {d: {coordinate: a.x, value: 1 m/(1 + exp(5000 - 10000*t/(1 s)))}}
forces: {f: {force: a.origin, value: ["1 N*(0.01*a.x/(1 m))**161", 0]}}
"""
    model = derive_scene(text.encode(), "f", "ideal")
    source, plain = render_equations_tex(model), render_equations_text(model)
    assert r"\left(0.01 \, x_{\text{a}}\right)^{161}" in source and "= (0.01·x_a)^161" in plain
    assert "10000·exp(5000 - 10000·t)/(exp(5000 - 10000·t) + 1)^2" in plain
    assert not any(word in source + plain for word in ("Unevaluated", "Slope", "Just"))


def test_small_matrices_are_large_enough_for_their_names() -> None:
    """The fewer columns, the larger an entry; never smaller than before."""
    sides = [pictures.compute_cell_side(columns, pictures.MIN_CELL_SIDE) for columns in (3, 9, 30, 150)]
    assert (
        sides == sorted(sides, reverse=True)
        and sides[1] == pictures.MAX_CELL_SIDE
        and sides[-1] == pictures.MIN_CELL_SIDE
    )


def test_axes_of_laws_have_units_that_suit_their_range() -> None:
    """1e-05 m is 10 µm, 4200 N are 4.2 kN; a letter's index is lowered, markup stays text."""
    curve = plots.Curve(np.array([0.0, 4200.0]), "F_n < 1")
    plot = plots.Plot(np.array([0.0, 1e-5]), (curve,), ("δ", "m"), ("F_n", "N"), ("clearance", "delta"), "")
    shown = plots.print_plot_svg(plot, {})
    assert ">δ [µm]<" in shown and ">10<" in shown and ">4.2<" in shown and "[kN]" in shown and "e-05" not in shown
    assert "F_n<" not in shown and 'F<tspan class="small" dy="3">n</tspan>' in shown and "&lt; 1" in shown

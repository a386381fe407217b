"""What notebooks show: of scenes, of runs, and of equations with the letters of the documents."""

from __future__ import annotations

import base64
import re
import subprocess
import sys
from pathlib import Path

import pytest
import sympy as sp

import gudgeon

TREE = re.compile(r"<td>(.*?)</td>")
KINDS = {"text/plain", "text/html", "text/latex"}
QUIET = """
import sys, gudgeon
simulation = gudgeon.load("four_bar")
told = simulation._repr_mimebundle_(), simulation.simulate(0.1)._repr_mimebundle_()
assert all(told)
print("sympy" in sys.modules)
"""


def test_a_run_is_a_drawing_and_a_table() -> None:
    pytest.importorskip("matplotlib")
    run = gudgeon.load("four_bar").simulate(1.0)
    message = run._repr_mimebundle_()
    assert set(message) == KINDS and message["text/plain"] == repr(run)
    cells = TREE.findall(message["text/html"])
    k = cells.index("transmission_angle")
    found = run["transmission_angle"]
    assert [float(x) for x in cells[k + 1 : k + 3]] == pytest.approx([found.min(), found.max()], rel=1e-4)
    picture = re.search(r"data:image/png;base64,([^\"]+)", message["text/html"])
    assert picture and base64.b64decode(picture[1]).startswith(b"\x89PNG")
    assert r"\mathrm{transmission\_angle}" in message["text/latex"] and message["text/latex"].count("{") > 10


def test_a_scene_is_what_it_is_made_of() -> None:
    message = gudgeon.load("nine_bar_press", "dry")._repr_html_()
    assert TREE.findall(message)[4:6] == ["joints with play", "2: A, B"] and "<script" not in message


def test_text_of_a_file_is_no_markup(tmp_path: Path) -> None:
    from gudgeon.loading.shipped import find_shipped_file

    text = find_shipped_file("pendulum").read_text("utf-8")
    file = tmp_path / "marked.yaml"
    file.write_text(re.sub(r"^title: .*$", "title: <b>$x_1$</b>", text, flags=re.MULTILINE))
    assert "&lt;b&gt;" in (html := gudgeon.load(file)._repr_html_()) and "<b>" not in html


def test_no_equation_is_derived_for_a_table() -> None:
    done = subprocess.run([sys.executable, "-c", QUIET], capture_output=True, text=True, check=True, timeout=120)
    assert done.stdout.strip() == "False"


def test_equations_have_the_letters_of_the_document() -> None:
    """Of Φ what prints is what the text says, row by row; what is computed of it is SymPy's as ever."""
    from gudgeon.generator.targets.latex import render_equations_text

    model = gudgeon.load("four_bar").model
    document = "".join(render_equations_text(model).split())
    rows = str(model.Phi).splitlines()
    assert len(rows) == 9 and all("".join(row.strip("[]").split()) in document.replace("½", "1/2") for row in rows[6:8])
    assert "θ_crank" in rows[8] and r"\theta_{\text{crank}}" in sp.latex(model.Phi)
    assert set(model._repr_mimebundle_()) == KINDS and "<math" in str(model._repr_html_())
    assert model.Phi.jacobian(list(model.q)) == model.Phi_q
    assert "crank_theta" in str(sp.Matrix(model.Phi)) and "crank_theta" in str(model.Phi[8:, :])

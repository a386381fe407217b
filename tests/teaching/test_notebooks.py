"""Notebooks: a document of nbformat 4, whose cells run in their order and assert that all three agree."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.pipeline import derive_scene
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.teaching.notebook import write_notebook
from gudgeon.teaching.sympy_text import format_number
from tests.programs import needs_compiler
from tests.pump import Gudgeon, written
from tests.teaching.test_sheets import PARALLEL, TURNING

pytestmark = needs_compiler


def executed(text: str, capsys: pytest.CaptureFixture[str]) -> tuple[dict[str, Any], str]:
    """Names that the code cells leave, and what they print; runs them in their order."""
    names: dict[str, Any] = {}
    for cell in json.loads(text)["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)
    return names, capsys.readouterr().out


# all joints closed; with play; free, with a spring; smooth steps; names that the notebook has for something else
@pytest.mark.parametrize(
    ("name", "scene"),
    [
        ("four_bar", "ideal"),
        ("slider_crank", "dry"),
        pytest.param("car_axis", "ideal", marks=pytest.mark.slow),
        pytest.param("toggle_clamp", "ideal", marks=pytest.mark.slow),
        pytest.param("n_four_bar", "ideal", marks=pytest.mark.slow),
        ("bouncing_ball", "elastic"),
    ],
)
def test_its_cells_run_and_agree(name: str, scene: str, capsys: pytest.CaptureFixture[str]) -> None:
    model = derive_scene(find_shipped_file(name).read_bytes(), name, scene)
    names, printed = executed(write_notebook(model, name), capsys)
    assert isinstance(names["run"], gudgeon.Result)
    if model.rows:
        assert printed.count("largest difference") == 5
        q, v = names["run"].q[-1], names["run"].v[-1]
        theirs = names["simulation"].gamma(float(names["run"].t[-1]), q, v)
        ours = names["derived"]["gamma"](float(names["run"].t[-1]), q, v)[:, 0]
        np.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-9 * (1 + np.abs(theirs).max()))


def test_rows_that_say_nothing_new_and_bodies_without_mass(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], call: Gudgeon
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("parallel.yaml").write_text(PARALLEL, encoding="utf-8")
    assert call("equations", "parallel.yaml", "-o", "x.ipynb").exit_code == 0
    names, printed = executed(Path("x.ipynb").read_text(encoding="utf-8"), capsys)
    assert len(names["Phi"]) == 12 and "M" not in names and "q̈ at 1 s" in printed


def test_it_is_a_notebook_and_always_the_same(call: Gudgeon, tmp_path: Path) -> None:
    for file in ("a.ipynb", "b.ipynb"):
        assert call("equations", "four_bar", "-o", file).exit_code == 0
    text = (tmp_path / "a.ipynb").read_text(encoding="utf-8")
    assert text == (tmp_path / "b.ipynb").read_text(encoding="utf-8")
    document = json.loads(text)
    assert (document["nbformat"], document["nbformat_minor"]) == (4, 5)
    assert len({cell["id"] for cell in document["cells"]}) == len(document["cells"])
    for cell in document["cells"]:
        keys = {"cell_type", "id", "metadata", "source"}
        assert set(cell) == keys | ({"outputs", "execution_count"} if cell["cell_type"] == "code" else set())
    derived = "".join("".join(cell["source"]) for cell in document["cells"]).partition("## The same functions")[0]
    assert "gudgeon" not in derived and str(tmp_path) not in text


def test_angles_are_shares_of_pi() -> None:
    assert [format_number(x) for x in (np.pi / 2, -np.pi, 3 * np.pi / 4, 1.5, 1.57)] == [
        "sp.pi/2",
        "-sp.pi",
        "3*sp.pi/4",
        "1.5",
        "1.57",
    ]
    text = write_notebook(derive_scene(TURNING.encode(), "turning.yaml", "ideal"), "turning.yaml")
    assert "sp.pi/2" in text and "1.5707963" not in text


def test_nbformat_takes_it() -> None:
    nbformat = pytest.importorskip("nbformat")
    nbformat.validate(
        json.loads(write_notebook(derive_scene(find_shipped_file("four_bar").read_bytes(), "x", "ideal"), "four_bar"))
    )


def test_curves_are_refused(call: Gudgeon, tmp_path: Path) -> None:
    text = find_shipped_file("scotch_yoke").read_text(encoding="utf-8")
    text = text.replace("value: omega * t", "value: lift(t)")
    text += "\ncurves:\n  lift: {points: [[0, 0], [1, 1], [2, 3]], x: s, y: rad, extrapolate: line}\n"
    (tmp_path / "cam.yaml").write_text(text, encoding="utf-8")
    done = call("equations", "cam.yaml", "-o", "x.ipynb")
    assert done.exit_code != 0 and "cannot contain curves" in done.stderr
    assert written(tmp_path) == {"cam.yaml"}


@needs_compiler
def test_a_run_that_fails_is_told(call: Gudgeon, tmp_path: Path) -> None:
    """A bar that does not reach: the equations are there, the run inside is none; a sheet has no numbers at all."""
    text = TURNING.replace("ground: {O: [0, 0]}", "ground: {O: [0, 0], P: [1 m, 0]}")
    text = text.replace("joints: {", "joints: {P: {revolute: [ground.P, arm.head]}, ")
    (tmp_path / "short.yaml").write_text(text, encoding="utf-8")
    done = call("equations", "short.yaml", "-o", "x.ipynb")
    assert done.exit_code == 1 and written(tmp_path) == {"short.yaml", "x.ipynb"}
    assert "x.ipynb is written, but the run in its last cells fails: " in done.stderr
    assert "cannot be assembled" in done.stderr
    done = call("exercise", "short.yaml", "-o", "x.md")
    assert done.exit_code == 1 and "no sheet: the run fails with drawn values" in done.stderr
    assert written(tmp_path) == {"short.yaml", "x.ipynb"}


def test_the_terminal_gets_the_text(call: Gudgeon, tmp_path: Path) -> None:
    printed = call("equations", "four_bar", "-o", "-").stdout
    assert call("equations", "four_bar", "-o", "x.txt").exit_code == 0
    assert printed == (tmp_path / "x.txt").read_text(encoding="utf-8")

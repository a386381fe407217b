"""Documents through the programs that read them: LaTeX by pdflatex, notebooks by a kernel of Jupyter's."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.latex import render_equations_tex
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.teaching.notebook import write_notebook
from tests.programs import missing, needs_compiler
from tests.pump import Gudgeon
from tests.slow import slow_but

LINE = ("pdflatex", "-interaction=nonstopmode", "-halt-on-error")


def compiled(file: Path) -> str:
    """What pdflatex complains of, and lines that run off the page; "" where it made a PDF of lines that fit."""
    if shutil.which(LINE[0]) is None:
        missing("no pdflatex: apt-get install texlive-latex-extra")
    line, folder = [*LINE, file.name], file.parent
    done = subprocess.run(line, cwd=folder, capture_output=True, text=True, errors="replace", timeout=120)
    if done.returncode != 0 or file.with_suffix(".pdf").stat().st_size <= 10_000:
        return done.stdout[-2000:]
    log = file.with_suffix(".log").read_text(errors="replace")
    wide = [line for pt, line in re.findall(r"Overfull .hbox \(([\d.]+)pt( .*)", log) if float(pt) > 5.0]
    return "\n".join(wide)


LONG_TABLE, SMOOTH_STEP = ("nine_bar_press", "lubricated"), ("toggle_clamp", "ideal")
SCENES = [LONG_TABLE, SMOOTH_STEP, ("four_bar", "ideal"), ("andrews_squeezer", "short"), ("bouncing_ball", "damped")]


@pytest.mark.parametrize("of", slow_but([LONG_TABLE, SMOOTH_STEP], SCENES), ids="/".join)
def test_equations(of: tuple[str, str], tmp_path: Path) -> None:
    """Neither a long table of numbers nor the second derivative of a smooth step runs off the page."""
    (name, scene), file = of, tmp_path / "equations.tex"
    file.write_text(
        render_equations_tex(derive_scene(find_shipped_file(name).read_bytes(), name, scene)), encoding="utf-8"
    )
    assert compiled(file) == ""


@pytest.mark.parametrize("name", slow_but(["scissor_lift"], ["four_bar", "jansen_leg", "scissor_lift"]))
def test_exercises(name: str, call: Gudgeon, tmp_path: Path) -> None:
    """Nothing runs off the page, plates by their sides neither; the sheet and its solutions have a drawing."""
    assert call("exercise", name, "-o", "sheet.tex", "--seed", "1").exit_code == 0
    for file in (tmp_path / "sheet.tex", tmp_path / "sheet-solutions.tex"):
        assert compiled(file) == ""
        assert file.read_text(encoding="ascii").count(r"\begin{tikzpicture}") == 1


@pytest.mark.slow  # test_notebooks.py runs its cells here
@needs_compiler
def test_a_notebook_runs_in_a_kernel() -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    text = write_notebook(derive_scene(find_shipped_file("four_bar").read_bytes(), "x", "ideal"), "four_bar")
    document = nbformat.reads(text, as_version=4)
    nbformat.validate(document)
    done = nbclient.NotebookClient(document, timeout=120, kernel_name="python3").execute()
    outputs = [out for cell in done.cells if cell.cell_type == "code" for out in cell.outputs]
    assert not [out for out in outputs if out.output_type == "error"]
    assert sum("largest difference" in out.get("text", "") for out in outputs) >= 1

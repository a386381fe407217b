"""What draws, where matplotlib is not installed: an error of ours that names what to install."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.programs import needs_compiler

WITHOUT = """\
import sys
sys.modules["matplotlib"] = None
import gudgeon
from gudgeon.results.wear import Surface, Wear
from gudgeon.reynolds import Bearing, solve
def run(): return gudgeon.load("four_bar").simulate(0.1)
def film(): return solve(Bearing(0.01, 0.02, 1e-5, 0.01), (5e-6, 0.0), omega_journal=1.0, cells=(32, 4))
def wear(): return Wear("A", "archard", *[None] * 6)
try:
    {}
except gudgeon.GudgeonError as error:
    print(type(error).__name__, error)
"""
DRAWING = (
    "run().plot",
    "run().plot('t')",
    "run().animate('x.gif')",
    "run().animate()",
    "gudgeon.load('four_bar').to_html()",
    "film().plot()",
    "wear().plot()",
    "import gudgeon.reynolds.plot",
    "import gudgeon.studies.show.study_plots",
    "import gudgeon.drawing.tikz",
    "import gudgeon.web.panel",
)


@needs_compiler
@pytest.mark.parametrize("drawing", DRAWING)
def test_what_draws_tells_what_to_install(drawing: str) -> None:
    code = WITHOUT.format(drawing)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "GudgeonError figures need matplotlib: pip install 'gudgeon[plot]'\n", done.stderr

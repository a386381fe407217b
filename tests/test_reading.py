"""docs/reading.md: its quotations are current, its figures are those of the scene, its Python prints what it shows."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest

import gudgeon
from tests.programs import needs_compiler

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "reading.md").read_text(encoding="utf-8")
QUOTES = runpy.run_path(str(ROOT / "tools" / "quotes.py"))


def test_its_quotations_are_current() -> None:
    """`make tables` renews them; every block of C or YAML is one."""
    assert QUOTES["renew_quotes"](PAGE) == PAGE
    assert len(QUOTES["QUOTE"].findall(PAGE)) == PAGE.count("```c\n") + PAGE.count("```yaml\n") > 8


def test_a_line_that_a_file_does_not_have_is_reported() -> None:
    with pytest.raises(SystemExit, match="no line with 'nothing of this'"):
        QUOTES["find_quoted_lines"]("README.md", "nothing of this", "end")
    with pytest.raises(SystemExit, match="to which a page quotes"):
        QUOTES["find_quoted_lines"]("README.md", "# gudgeon", "nothing of this")


@needs_compiler
def test_its_python_prints_what_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    kinds = ("python", "text")
    (python,), (text,) = (re.findall(rf"^```{kind}\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE) for kind in kinds)
    exec(compile(python, "reading.md", "exec"), {})
    assert capsys.readouterr().out == text


@needs_compiler
def test_its_figures_are_those_of_the_scene() -> None:
    simulation = gudgeon.load("slider_crank", "dry")
    operations = simulation.source.operations
    assert f"{operations['dynamics']} operations in `dynamics` and {operations['reduced_dynamics']} in" in PAGE
    stiffness = simulation.p[len(simulation.source.parameters) + simulation.source.derived.index("dry_pin_K")]
    assert f"{stiffness / 1e10:.3f}·10¹⁰ N/m^1.5" in PAGE

"""`gudgeon equations`: the equations of a scene as LaTeX, plain text, HTML or a notebook, or on the terminal."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.commands.common import check_file, chosen_scenes, need_suffix
from gudgeon.commands.progress import status_line
from gudgeon.files.writing import write_text
from gudgeon.loading.find import find_mechanism, read_bytes
from gudgeon.waiting.working import working

if TYPE_CHECKING:
    from gudgeon.generator.equations.model import Model

SUFFIXES = (".tex", ".txt", ".html", ".ipynb")
TERMINAL = Path("-")


def write_equations(mechanism: str, target: Path, scene: str) -> int:
    """Derive one scene and write its equations to x.tex, x.txt, x.html or x.ipynb; of "-" print the text."""
    if target != TERMINAL:
        need_suffix(target, SUFFIXES)
        check_file("--out", target)
    chosen_scenes(mechanism, (scene,))
    file = find_mechanism(mechanism)
    data = read_bytes(file)

    with status_line(), working(f"deriving {file.stem}, scene {scene}"):
        from gudgeon.generator.pipeline import derive

        text = _writer(target, mechanism)(derive(data, str(file), scene))
    if target == TERMINAL:
        print(text, end="")
        return 0
    write_text(target, text)
    print(f"wrote {target}")
    return 0


def _writer(target: Path, mechanism: str) -> Callable[[Model], str]:
    """What makes the text of a file by its suffix."""
    from gudgeon.generator.targets import latex
    from gudgeon.teaching.notebook import notebook

    return {
        ".tex": latex.equations_tex, ".txt": latex.equations_text, ".html": latex.equations_html,
        ".ipynb": lambda model: notebook(model, mechanism), "": latex.equations_text,
    }[target.suffix.lower()]  # fmt: skip

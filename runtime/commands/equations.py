"""`gudgeon equations`: a scene's equations as LaTeX, text, a notebook, a page that runs, or on the terminal."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.commands.common import check_file, chosen_scenes, need_suffix
from gudgeon.commands.progress import status_line
from gudgeon.files.writing import write_text
from gudgeon.language.shown import path_text
from gudgeon.loading.find import find_mechanism, read_bytes
from gudgeon.waiting.working import working

if TYPE_CHECKING:
    from gudgeon.generator.equations.model import Model

TERMINAL = Path("-")


def write_equations(mechanism: str, target: Path, scene: str) -> int:
    """Write one scene's equations to x.tex, x.txt, x.html or x.ipynb; of "-" print the text."""
    if target != TERMINAL:
        need_suffix(target, tuple(suffix for suffix in WRITERS if suffix))
        check_file("--out", target)
    chosen_scenes(mechanism, (scene,))
    with status_line(), working(f"deriving {find_mechanism(mechanism).stem}, scene {scene}"):
        text = WRITERS[target.suffix.lower()](mechanism, scene)
    if target == TERMINAL:
        print(text, end="")
        return 0
    write_text(target, text)
    print(f"wrote {path_text(target)}")
    return 0


def _model(mechanism: str, scene: str) -> Model:
    from gudgeon.generator.pipeline import derive

    file = find_mechanism(mechanism)
    return derive(read_bytes(file), str(file), scene)


def _tex(mechanism: str, scene: str) -> str:
    from gudgeon.generator.targets.latex import equations_tex

    return equations_tex(_model(mechanism, scene))


def _text(mechanism: str, scene: str) -> str:
    from gudgeon.generator.targets.latex import equations_text

    return equations_text(_model(mechanism, scene))


def _notebook(mechanism: str, scene: str) -> str:
    from gudgeon.teaching.notebook import notebook

    return notebook(_model(mechanism, scene), mechanism)


def _page(mechanism: str, scene: str) -> str:
    from gudgeon.simulation.from_file import load
    from gudgeon.web.page import write

    return write(load(mechanism, scene))


WRITERS: dict[str, Callable[[str, str], str]] = {
    ".tex": _tex, ".txt": _text, ".html": _page, ".ipynb": _notebook, "": _text,
}  # fmt: skip

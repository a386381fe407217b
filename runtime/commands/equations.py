"""`gudgeon equations`: the equations of a scene as LaTeX, plain text, or a page of HTML that runs."""

from __future__ import annotations

from pathlib import Path

from gudgeon.commands.common import check_file, chosen_scenes, need_suffix
from gudgeon.commands.progress import status_line
from gudgeon.files.writing import write_text
from gudgeon.loading.find import find_mechanism, read_bytes
from gudgeon.waiting.working import working


def write_equations(mechanism: str, target: Path, scene: str) -> int:
    """Derive one scene and write its equations to x.tex, x.txt or x.html."""
    need_suffix(target, (".tex", ".txt", ".html"))
    check_file("--out", target)
    chosen_scenes(mechanism, (scene,))
    file = find_mechanism(mechanism)
    data = read_bytes(file)

    with status_line(), working(f"deriving {file.stem}, scene {scene}"):
        if target.suffix.lower() == ".html":
            from gudgeon.simulation.from_file import load
            from gudgeon.web.page import write as write_page

            text = write_page(load(mechanism, scene))
        else:
            from gudgeon.generator.pipeline import derive
            from gudgeon.generator.targets import latex

            write = {".tex": latex.equations_tex, ".txt": latex.equations_text}
            text = write[target.suffix.lower()](derive(data, str(file), scene))
    write_text(target, text)
    print(f"wrote {target}")
    return 0

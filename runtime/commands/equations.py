"""`gudgeon equations`: the equations of a scene as LaTeX or plain text."""

from __future__ import annotations

from pathlib import Path

from gudgeon.commands.common import chosen_scenes, need_suffix, write_text
from gudgeon.loading import find_mechanism, read_bytes


def write_equations(mechanism: str, target: Path, scene: str) -> int:
    """Derive one scene and write its equations to x.tex or x.txt."""
    need_suffix(target, (".tex", ".txt"))
    chosen_scenes(mechanism, (scene,))
    file = find_mechanism(mechanism)
    data = read_bytes(file)

    from gudgeon.generator.pipeline import derive
    from gudgeon.generator.targets import latex

    model = derive(data, str(file), scene)
    write = latex.equations_tex if target.suffix == ".tex" else latex.equations_text
    write_text(target, write(model))
    print(f"wrote {target}")
    return 0

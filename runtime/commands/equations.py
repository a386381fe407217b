"""Run `gudgeon equations`: write a scene's equations as LaTeX, text, a notebook, a page with a simulator, or on
the terminal."""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.commands.common import check_output_file, require_suffix, select_scenes
from gudgeon.commands.outcome import report_text, report_written_file
from gudgeon.commands.progress import show_status_line
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.files.writing import write_text
from gudgeon.language.text_output import format_path
from gudgeon.loading.kernel_sources import find_mechanism, read_bytes
from gudgeon.waiting.cancellation import report_work

if TYPE_CHECKING:
    from gudgeon.generator.equations.model import Model

TERMINAL, DEFAULT_SCENE = Path("-"), "ideal"
SUFFIXES = (".tex", ".txt", ".html", ".ipynb")


def write_equations(mechanism: str, target: Path, scenes: tuple[str, ...]) -> int:
    """Run `gudgeon equations`: write the equations of a scene to a .tex, .txt, .html or .ipynb file; return the exit
    code.

    target: a folder (existing, or a name without suffix) gets an HTML page of each scene; "-" prints the text. Without
    `scenes` a file has the scene "ideal". Raises BadValueError for several scenes in a file.
    """
    if os.path.isdir(target) or not (target.suffix or target == TERMINAL):
        return _write_pages(mechanism, target, scenes)
    if target != TERMINAL:
        require_suffix(target, SUFFIXES)
        check_output_file("--out", target)
    if len(scenes) > 1:
        message = f"{format_path(target)}: a file contains the equations of one scene, not of {', '.join(scenes)}"
        raise BadValueError(message, hint="name a folder: -o pages/")
    (scene,) = select_scenes(mechanism, scenes or (DEFAULT_SCENE,))
    with show_status_line(), report_work(f"deriving {find_mechanism(mechanism).stem}, scene {scene}"):
        text = _format_equations(mechanism, scene, target)
    if target == TERMINAL:
        report_text("equations", text.removesuffix("\n"))
        return 0
    write_text(target, text)
    report_written_file("equations", target)
    if target.suffix.lower() == ".ipynb":
        _check_notebook_run(mechanism, scene, target)
    return 0


def _check_notebook_run(mechanism: str, scene: str, notebook: Path) -> None:
    """Load and run the scene as the last cells of the notebook do, so that a failure is reported now.

    Raises GudgeonError with the exit code of the failure, KeyboardInterrupt after Ctrl-C.
    """
    from gudgeon.simulation.from_file import load

    try:
        with show_status_line(), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # the notebook displays them
            simulation = load(mechanism, scene)
            with report_work(f"running {simulation.source.mechanism}, scene {scene}, as the notebook will"):
                run = simulation.simulate()
    except GudgeonError as error:
        failure = GudgeonError(f"{format_path(notebook)} is written, but the run in its last cells fails: {error}")
        failure.exit_code = error.exit_code
        raise failure from error
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt


def _write_pages(mechanism: str, folder: Path, scenes: tuple[str, ...]) -> int:
    """Write an HTML page of each scene into a folder, created if absent; pages have links to each other. Return 0.

    The files are NAME_SCENE.html; all are checked before the first scene is derived. Without `scenes`, all are written.
    """
    from gudgeon.simulation.from_file import load
    from gudgeon.web.page import build_page

    name = find_mechanism(mechanism).stem
    files = {scene: f"{name}_{scene}.html" for scene in select_scenes(mechanism, scenes)}
    for file in files.values():
        check_output_file("--out", folder / file)
    with show_status_line():
        for scene, file in files.items():
            with report_work(f"deriving {name}, scene {scene}"):
                text = build_page(load(mechanism, scene), files)
            folder.mkdir(parents=True, exist_ok=True)
            write_text(folder / file, text)
            report_written_file(scene, folder / file)
    return 0


def _derive_model(mechanism: str, scene: str) -> Model:
    """Derive the equations of a scene of a mechanism file in SymPy and return the model."""
    from gudgeon.generator.pipeline import derive_scene

    file = find_mechanism(mechanism)
    return derive_scene(read_bytes(file), str(file), scene)


def _format_equations(mechanism: str, scene: str, target: Path) -> str:
    """Return the equations of a scene as the text of a file in the format of the target's suffix.

    .html: a page with the running scene; .ipynb: a notebook; .tex: LaTeX; any other: plain text.
    """
    suffix = target.suffix.lower()
    if suffix == ".html":
        from gudgeon.simulation.from_file import load
        from gudgeon.web.page import build_page

        return build_page(load(mechanism, scene))
    from gudgeon.generator.targets.latex import render_equations_tex, render_equations_text

    model = _derive_model(mechanism, scene)
    if suffix == ".ipynb":
        from gudgeon.teaching.notebook import write_notebook

        return write_notebook(model, _find_mechanism_from_notebook(mechanism, target))
    return render_equations_tex(model) if suffix == ".tex" else render_equations_text(model)


def _find_mechanism_from_notebook(mechanism: str, target: Path) -> str:
    """Return the argument of `load` that finds the mechanism from the notebook's folder.

    It is the given text for a shipped mechanism or an absolute path, else a relative path with a slash or a suffix.
    """
    file = find_mechanism(mechanism)
    if file.is_absolute():  # a shipped mechanism or an absolute path
        return mechanism
    relative_path = os.path.relpath(file, target.parent)
    return relative_path if "/" in relative_path or relative_path.endswith((".yaml", ".yml")) else f"./{relative_path}"

"""Run `gudgeon exercise`: write an exercise sheet of a scene, and its solutions to a second file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.commands.common import check_file, require_suffix, select_scenes
from gudgeon.commands.outcome import wrote
from gudgeon.commands.progress import status_line
from gudgeon.errors import AssemblyError, GudgeonError, SolverError
from gudgeon.files.writing import AtomicFiles
from gudgeon.loading.find import find_mechanism, read_bytes
from gudgeon.waiting.asking import report_work

if TYPE_CHECKING:
    from gudgeon.drawing.shapes import Sketch
    from gudgeon.generator.targets.latex.document import Document
    from gudgeon.teaching.draw_numbers import Drawn

SUFFIXES = (".html", ".tex", ".txt", ".md")


def write_exercise(mechanism: str, target: Path, scene: str, seed: int, at: str | None) -> int:
    """Run `gudgeon exercise`: write an exercise sheet, and NAME-solutions next to it; return the exit code.

    The suffix is .html, .tex, .txt or .md. Both files are written or neither. `at`: text of the time, or None.
    """
    require_suffix(target, SUFFIXES)
    solutions = target.with_name(f"{target.stem}-solutions{target.suffix}")
    for file in (target, solutions):
        check_file("--out", file)
    select_scenes(mechanism, (scene,))
    with status_line():
        sheet, solved, drawn = make(mechanism, scene, seed, at)
        texts = [_format_document(document, target.suffix.lower(), drawn) for document in (sheet, solved)]
    with AtomicFiles(target.parent) as aside:  # both files or neither: a sheet needs its own solutions
        for file, text in zip((target, solutions), texts, strict=True):
            aside.write(file.name, text.encode())
        aside.move()
    wrote("exercise", target)
    wrote("solutions", solutions)
    return 0


def make(mechanism: str, scene: str, seed: int, at: str | None) -> tuple[Document, Document, Drawn]:
    """Return the exercise sheet, its solutions, and the drawn parameter values with their run.

    `at`: text of the time, or None for a drawn one. Raises GudgeonError if the run fails with the file's own values
    too.
    """
    from gudgeon.simulation.from_file import load
    from gudgeon.teaching.draw_numbers import draw_numbers

    file = find_mechanism(mechanism)
    data = read_bytes(file)
    simulation = load(mechanism, scene)
    from gudgeon.generator.reader.read import read_scene
    from gudgeon.teaching.sheet import make_sheets, make_subject, units_of

    with report_work(f"running {file.stem}, scene {scene}, with other numbers"):
        try:
            drawn = draw_numbers(simulation, seed, at, units_of(read_scene(data, str(file), scene)))
        except (AssemblyError, SolverError) as error:
            failure = GudgeonError(f"no sheet: the run that its numbers come from fails, the file's own too: {error}")
            failure.exit_code = error.exit_code
            raise failure from error
    with report_work(f"deriving {file.stem}, scene {scene}"):
        from gudgeon.generator.pipeline import derive
        from gudgeon.teaching.questions import make_questions

        subject = make_subject(derive(data, str(file), scene, drawn.numbers), simulation, drawn, seed)
        return *make_sheets(subject, make_questions(subject), seed), drawn


def _format_document(document: Document, suffix: str, drawn: Drawn) -> str:
    """Return a document in the format of a suffix; .html and .tex include a picture if matplotlib is installed."""
    from gudgeon.generator.targets.latex.render import render
    from gudgeon.teaching.notebook import markdown

    if suffix == ".md":
        return markdown(document)
    slots = {".html": _fill_page_slots, ".tex": _fill_tex_slots}.get(suffix, lambda _: {})(drawn)
    return render(document, suffix.removeprefix("."), **slots)


def _fill_page_slots(drawn: Drawn) -> dict[str, str]:
    """Return the texts for the slots of the HTML template by name; "app" has the sketch as SVG if matplotlib is
    installed.
    """
    found = {"head": "", "app": "", "scripts": ""}
    if (sketch := _make_sketch(drawn)) is not None:
        from gudgeon.drawing.picture import as_bytes, figure_of

        svg = as_bytes(figure_of([sketch], [""], f"at {drawn.t:g} s"), ".svg").decode()
        found["app"] = f"<figure>{svg[svg.index('<svg') :]}</figure>"
    return found


def _fill_tex_slots(drawn: Drawn) -> dict[str, str]:
    """Return the texts for the slots of the LaTeX template: the sketch as TikZ and its caption; {} without
    matplotlib.
    """
    if (sketch := _make_sketch(drawn)) is None:
        return {}
    from gudgeon.drawing.tikz import tikz_of
    from gudgeon.generator.targets.latex.render import tex

    return {"drawing": tikz_of(sketch, tex), "caption": f"at {drawn.t:g} s"}


def _make_sketch(drawn: Drawn) -> Sketch | None:
    """Return a sketch of the mechanism at the time of the sheet; None without matplotlib, which places the names."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        return None
    from gudgeon.results.figures.mechanism_plots import sketch_at

    return sketch_at(drawn.run, drawn.run.t[-1])

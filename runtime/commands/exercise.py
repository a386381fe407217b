"""Run `gudgeon exercise`: write an exercise sheet of a scene, and its solutions to a second file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.commands.common import check_output_file, require_suffix, select_scenes
from gudgeon.commands.outcome import report_written_file
from gudgeon.commands.progress import show_status_line
from gudgeon.errors import AssemblyError, GudgeonError, SolverError
from gudgeon.files.writing import AtomicFiles
from gudgeon.loading.kernel_sources import find_mechanism, read_bytes
from gudgeon.waiting.cancellation import report_work

if TYPE_CHECKING:
    from gudgeon.drawing.shapes import Sketch
    from gudgeon.generator.targets.latex.document import Document
    from gudgeon.teaching.draw_parameters import ExerciseData

SUFFIXES = (".html", ".tex", ".txt", ".md")


def write_exercise(mechanism: str, target: Path, scene: str, seed: int, at: str | None) -> int:
    """Run `gudgeon exercise`: write an exercise sheet, and NAME-solutions next to it; return the exit code.

    The suffix is .html, .tex, .txt or .md. Both files are written or neither. `at`: text of the time, or None.
    """
    require_suffix(target, SUFFIXES)
    solutions = target.with_name(f"{target.stem}-solutions{target.suffix}")
    for file in (target, solutions):
        check_output_file("--out", file)
    select_scenes(mechanism, (scene,))
    with show_status_line():
        sheet, solutions_sheet, exercise_data = make_exercise(mechanism, scene, seed, at)
        texts = [
            _format_document(document, target.suffix.lower(), exercise_data) for document in (sheet, solutions_sheet)
        ]
    with AtomicFiles(target.parent) as atomic_files:  # both files or neither: a sheet needs its own solutions
        for file, text in zip((target, solutions), texts, strict=True):
            atomic_files.write(file.name, text.encode())
        atomic_files.move_files()
    report_written_file("exercise", target)
    report_written_file("solutions", solutions)
    return 0


def make_exercise(mechanism: str, scene: str, seed: int, at: str | None) -> tuple[Document, Document, ExerciseData]:
    """Return the exercise sheet, its solutions, and the drawn parameter values with their run.

    `at`: text of the time, or None for a random one. Other values are drawn if a run fails; raises GudgeonError if the
    run fails with the values of the file too.
    """
    from gudgeon.simulation.from_file import load
    from gudgeon.teaching.draw_parameters import draw_parameters

    file = find_mechanism(mechanism)
    data = read_bytes(file)
    simulation = load(mechanism, scene)
    from gudgeon.generator.reader.read import read_scene
    from gudgeon.teaching.sheet import list_units, make_sheets, make_subject

    with report_work(f"running {file.stem}, scene {scene}, with other parameter values"):
        try:
            exercise_data = draw_parameters(simulation, seed, at, list_units(read_scene(data, str(file), scene)))
        except (AssemblyError, SolverError) as error:
            failure = GudgeonError(f"no sheet: the run fails with drawn values and with those of the file: {error}")
            failure.exit_code = error.exit_code
            raise failure from error
    with report_work(f"deriving {file.stem}, scene {scene}"):
        from gudgeon.generator.pipeline import derive_scene
        from gudgeon.teaching.questions import make_questions

        subject = make_subject(
            derive_scene(data, str(file), scene, exercise_data.parameters), simulation, exercise_data, seed
        )
        return *make_sheets(subject, make_questions(subject), seed), exercise_data


def _format_document(document: Document, suffix: str, exercise_data: ExerciseData) -> str:
    """Return a document as text in the format of a suffix (.html, .tex, .txt or .md).

    .html and .tex include a sketch of the mechanism if matplotlib is installed.
    """
    from gudgeon.generator.targets.latex.render import render_document
    from gudgeon.teaching.notebook import format_document

    if suffix == ".md":
        return format_document(document)
    variables = {".html": _build_html_variables, ".tex": _build_tex_variables}.get(suffix, lambda _: {})(exercise_data)
    return render_document(document, suffix.removeprefix("."), **variables)


def _build_html_variables(exercise_data: ExerciseData) -> dict[str, str]:
    """Return the variables of the HTML template; "app" contains the sketch as SVG if matplotlib is installed."""
    texts = {"head": "", "app": "", "scripts": ""}
    if (sketch := _make_sketch(exercise_data)) is not None:
        from gudgeon.drawing.picture import build_figure, encode_figure

        svg = encode_figure(build_figure([sketch], [""], f"at {exercise_data.t:g} s"), ".svg").decode()
        texts["app"] = f"<figure>{svg[svg.index('<svg') :]}</figure>"
    return texts


def _build_tex_variables(exercise_data: ExerciseData) -> dict[str, str]:
    """Return the variables of the LaTeX template: the sketch as TikZ and its caption; {} without matplotlib."""
    if (sketch := _make_sketch(exercise_data)) is None:
        return {}
    from gudgeon.drawing.tikz import format_tikz
    from gudgeon.generator.targets.latex.render import escape_latex

    return {"drawing": format_tikz(sketch, escape_latex), "caption": f"at {exercise_data.t:g} s"}


def _make_sketch(exercise_data: ExerciseData) -> Sketch | None:
    """Return a sketch of the mechanism at the time of the sheet; None without matplotlib, which places the labels."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        return None
    from gudgeon.results.figures.mechanism_plots import draw_sketch_at_time

    return draw_sketch_at_time(exercise_data.run, exercise_data.run.t[-1])

"""Run `gudgeon draw`: write a picture of a mechanism at its start, at a time of its motion, or in all its assemblies.

The start needs no compiler: the linkage is assembled in NumPy as by `gudgeon check`. A linkage that does not close is
drawn too, and its error is raised after the picture is written.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.commands.common import (
    apply_settings,
    check_addresses,
    check_output_file,
    parse_settings,
    require_suffix,
    select_scenes,
)
from gudgeon.commands.outcome import report_written_file
from gudgeon.commands.progress import show_progress_bars, show_status_line
from gudgeon.errors import AssemblyError, BadValueError, GudgeonError, SolverError, shorten_path
from gudgeon.files.writing import write_bytes
from gudgeon.language.plot_units import format_quantity
from gudgeon.language.quantities import parse_quantity
from gudgeon.loading.kernel_sources import find_mechanism, read_bytes
from gudgeon.model.parameters import insert_space_before_unit
from gudgeon.waiting.cancellation import report_work

if TYPE_CHECKING:
    from gudgeon.assembly.closure import AssemblyProblem
    from gudgeon.drawing.configuration import Configuration
    from gudgeon.drawing.shapes import Sketch
    from gudgeon.generator.mechanism import Mechanism
    from gudgeon.generator.targets.numpy.linkage import NumPyLinkage
    from gudgeon.model.compiled import Array

SUFFIXES = (".svg", ".png", ".pdf", ".dxf")


@dataclass(frozen=True)
class Picture:
    """Sketches of a picture in one row, with a title for each and a caption above them."""

    sketches: Sequence[Sketch]
    titles: Sequence[str]
    caption: str

    def encode_picture(self, suffix: str) -> bytes:
        """Return the picture as the bytes of a file; suffix: one of SUFFIXES, ".dxf" gives a drawing for CAD."""
        if suffix == ".dxf":
            from gudgeon.drawing.dxf import encode_dxf

            return encode_dxf(self.sketches, self.titles)
        from gudgeon.drawing.picture import build_figure, encode_figure

        return encode_figure(build_figure(self.sketches, self.titles, self.caption), suffix)


@dataclass(frozen=True)
class DrawRequest:
    """Arguments of the command line, as typed."""

    file: str
    scene: str
    at: str | None
    target: Path | None
    settings: tuple[str, ...]
    branches: bool


def draw_mechanism_file(request: DrawRequest) -> int:
    """Run `gudgeon draw`: draw the mechanism, write the picture, and return the exit code 0.

    It shows the start, the time of --at (> 0) after a run to it, or all assemblies (--branches). The default file is
    out/STEM_SCENE.svg. Raises BadValueError for arguments. For a linkage that does not close or has no velocities, the
    error of `check` is raised after the picture is written.
    """
    if request.at is not None and request.branches:
        raise BadValueError("--branches with --at: assemblies exist at the start only", hint="leave one of them out")
    values = parse_settings(request.settings)
    select_scenes(request.file, (request.scene,))
    file = find_mechanism(request.file)
    target = request.target or Path("out") / f"{file.stem}_{request.scene}.svg"
    require_suffix(target, SUFFIXES)
    check_output_file("--out", target)
    from gudgeon.results.figures import plots  # noqa: F401  (says where matplotlib is missing)

    if target.suffix.lower() == ".dxf":
        from gudgeon.drawing import dxf  # noqa: F401  (says where ezdxf is missing)

    draw_time = 0.0 if request.at is None else parse_quantity(insert_space_before_unit(request.at), "--at", (0, 0, 1))
    if draw_time < 0.0:
        raise BadValueError(f"--at is {draw_time:g} s: expected 0 s or more", hint="choose a time of the motion")
    with _convert_drawing_errors(target):
        if draw_time > 0.0:
            drawn, failure = _draw_at_time(request, draw_time, values), None
        else:
            with show_status_line(), report_work(f"deriving {file.stem}, scene {request.scene}"):
                drawn, failure = _draw_start(request, file, values)
        data = drawn.encode_picture(target.suffix.lower())
    write_bytes(target, data)
    report_written_file("picture", target)
    if failure is not None:
        raise failure
    return 0


@contextmanager
def _convert_drawing_errors(target: Path) -> Iterator[None]:
    """Convert a ValueError or ArithmeticError in the with block to a GudgeonError: values too large to be drawn.

    NumPy's warnings about such values are suppressed.
    """
    try:
        with np.errstate(all="ignore"):
            yield
    except (ValueError, ArithmeticError) as error:
        if isinstance(error, GudgeonError):
            raise
        message = f"no picture {shorten_path(target)}: its values cannot be drawn ({error})"
        raise GudgeonError(f"{message}\n  look for a length or a start that is far too large") from error


def _draw_at_time(request: DrawRequest, draw_time: float, values: Mapping[str, float | str]) -> Picture:
    """Run the scene to the time `draw_time` (s) and return the picture there.

    Raises SolverError if the run fails before, BadValueError for an impossible time, KeyboardInterrupt after Ctrl-C.
    """
    from gudgeon.results.figures.mechanism_plots import draw_sketch_at_time
    from gudgeon.simulation.from_file import load

    with show_status_line():
        simulation = load(request.file, request.scene)
    check_addresses(values, request.file, [simulation.source])
    with show_progress_bars() as make_bar:
        try:
            run = simulation.simulate(draw_time, parameters=values, progress=make_bar(request.scene), peaks=())
        except SolverError as error:  # its hint concerns results of runs
            reason, _, _ = str(error).partition("\n")
            hint = "draw an earlier time; gudgeon run shows the motion up to the failure"
            raise SolverError(f"{reason}\n  {hint}", error.time, error.pivot) from error
        except BadValueError as error:
            if not error.message.startswith("t_end is"):
                raise
            raise BadValueError(error.message.replace("t_end", "--at", 1), hint=error.hint) from error
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt
    source, t = run.source, float(run.t[-1])
    return Picture(
        [draw_sketch_at_time(run, t)], [""], _format_caption(source.title or source.mechanism, request.scene, t)
    )


def _format_caption(title: str, scene: str, t: float) -> str:
    """Return the text above a picture: title, scene, time t in s."""
    return f"{title}: {scene}, t = {format_quantity(t, 's', 6)}"


def _draw_start(
    request: DrawRequest, file: Path, values: Mapping[str, float | str]
) -> tuple[Picture, GudgeonError | None]:
    """Return the picture at the start, and the error of a linkage that does not close or has no velocities, else None.

    An open linkage is drawn at the position with the smallest residual. With --branches, all assemblies are drawn.
    """
    from gudgeon.assembly.closure import AssemblyProblem
    from gudgeon.generator.pipeline import build_closed_linkage
    from gudgeon.generator.reader.read import read_mechanism

    mechanism = read_mechanism(read_bytes(file), str(file))
    linkage, _ = build_closed_linkage(mechanism, request.scene)
    check_addresses(values, request.file, [linkage.source])
    linkage = apply_settings(mechanism, linkage, values)
    problem = AssemblyProblem(linkage, linkage.p, 0.0)
    with np.errstate(all="ignore"):
        q, closed = problem.find_nearest_configuration()
    caption = _format_caption(mechanism.title or mechanism.name, request.scene, 0.0)
    if not closed:
        return _draw_unclosed_linkage(mechanism, problem, q, caption)
    v, failure = _find_velocities(problem, q)
    if request.branches:
        sketches, titles = _draw_assemblies(mechanism, problem, q)
        return Picture(sketches, titles, caption), failure
    return Picture(_make_sketches(mechanism, problem, [_make_configuration(linkage, q, v)]), [""], caption), failure


def _find_velocities(problem: AssemblyProblem, q: Array) -> tuple[Array | None, AssemblyError | None]:
    """Return the velocities at the position q and None, or None and the AssemblyError if there are none."""
    from gudgeon.assembly.start import compute_start_velocities

    try:
        return compute_start_velocities(problem, q), None
    except AssemblyError as error:
        return None, error


def _make_configuration(linkage: NumPyLinkage, q: Array, v: Array | None) -> Configuration:
    """Return position q, velocities v and loads of a linkage as a Configuration for drawing; v may be None."""
    from gudgeon.drawing.configuration import Configuration
    from gudgeon.results.figures.configurations import evaluate_loads

    loads = evaluate_loads(linkage.source, linkage.p, q, np.zeros_like(q) if v is None else v)
    return Configuration(linkage.source, linkage.p, q, 0.0, v, loads)


def _make_sketches(
    mechanism: Mechanism, problem: AssemblyProblem, configurations: Sequence[Configuration]
) -> list[Sketch]:
    """Return a sketch of each configuration of a closed linkage, all with one scale and one bounding box.

    Free motions are marked if there are bodies that are not connected to the ground, or if there are degrees of freedom
    and the file does not declare `freedoms`. The mobility is that of the first configuration.
    """
    from gudgeon.assembly.mobility import find_mobility
    from gudgeon.drawing.failures import draw_degrees_of_freedom
    from gudgeon.drawing.layout import make_layout
    from gudgeon.drawing.sketch import compute_common_box, make_sketch

    with np.errstate(all="ignore"):
        mobility = find_mobility(problem.linkage, problem.p, configurations[0].q)
    layouts, sketches = [make_layout([configuration], configurations[0]) for configuration in configurations], []
    unit = min(layout.unit for layout in layouts)
    layouts = [replace(layout, unit=unit) for layout in layouts]
    box = compute_common_box(configurations, layouts)
    marked = mobility.unconnected_bodies or (mobility.freedoms and mechanism.freedoms is None)
    for configuration, layout in zip(configurations, layouts, strict=True):
        shapes, labels = (
            draw_degrees_of_freedom(problem, configuration, unit, mobility.unconnected_bodies) if marked else ([], [])
        )
        sketches.append(
            make_sketch(
                configuration,
                layout,
                shapes_on_top=shapes,
                labels=labels,
                unconnected_bodies=frozenset(mobility.unconnected_bodies),
                box=box,
            )
        )
    return sketches


def _draw_unclosed_linkage(
    mechanism: Mechanism, problem: AssemblyProblem, q: Array, caption: str
) -> tuple[Picture, GudgeonError]:
    """Return the picture of a linkage that does not close, with its gaps marked, and its AssemblyError.

    The error is raised at once if q or a residual is not finite.
    """
    from gudgeon.assembly.failures import make_closure_error
    from gudgeon.drawing.failures import draw_gaps
    from gudgeon.drawing.sketch import make_sketch

    failure = make_closure_error(problem, q)
    if not (np.isfinite(q).all() and np.isfinite(problem.compute_residual(q)).all()):
        raise failure
    configuration = _make_configuration(problem.linkage, q, None)  # type: ignore[arg-type]
    shapes, labels = draw_gaps(problem, configuration)
    sketch = make_sketch(configuration, shapes_on_top=shapes, labels=labels)
    return Picture([sketch], [""], f"{caption}: it does not close"), failure


def _draw_assemblies(mechanism: Mechanism, problem: AssemblyProblem, q: Array) -> tuple[list[Sketch], list[str]]:
    """Return a sketch of each assembly, and as its title the guess that selects it; the start q (n,) is the first.

    Titles are numbered, and that of the start is marked "(as in the file)".
    """
    from gudgeon.assembly.branches import find_assemblies
    from gudgeon.assembly.mobility import find_mobility
    from gudgeon.commands.assembly_report import format_guess

    linkage: Any = problem.linkage
    with np.errstate(all="ignore"):
        coordinate_names = find_mobility(linkage, linkage.p, q).independent_coordinates
    assemblies = find_assemblies(linkage, linkage.p, q, coordinate_names)
    configurations = [
        _make_configuration(linkage, assembly.q, _find_velocities(problem, assembly.q)[0]) for assembly in assemblies
    ]
    start_marks = {True: " (as in the file)", False: ""}
    titles = [
        f"{k}  {format_guess(assembly)}{start_marks[assembly.is_start]}" for k, assembly in enumerate(assemblies, 1)
    ]
    return _make_sketches(mechanism, problem, configurations), titles

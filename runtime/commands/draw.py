"""`gudgeon draw`: a mechanism at its start, at a time of its motion, or in all its assemblies, as a picture.

The start needs no compiler: the linkage is closed as `check` closes it. What would stop `check` is drawn, and raised
once the picture is written.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.commands.common import at_numbers, check_addresses, check_file, chosen_scenes, need_suffix, settings
from gudgeon.commands.progress import progress_bar, status_line
from gudgeon.commands.told import wrote
from gudgeon.errors import AssemblyError, BadValueError, GudgeonError, SolverError, shortened
from gudgeon.files.writing import write_bytes
from gudgeon.language.plot_units import quantity
from gudgeon.language.quantities import number_of_text
from gudgeon.loading.find import find_mechanism, read_bytes
from gudgeon.model.parameters import spaced
from gudgeon.waiting.asking import working

if TYPE_CHECKING:
    from gudgeon.assembly.closure import Closure
    from gudgeon.drawing.posture import Posture
    from gudgeon.drawing.shapes import Sketch
    from gudgeon.generator.mechanism import Mechanism
    from gudgeon.generator.targets.numpy.linkage import NumPyLinkage
    from gudgeon.model.compiled import Array

SUFFIXES = (".svg", ".png", ".pdf", ".dxf")


@dataclass(frozen=True)
class Drawn:
    """Sketches side by side, a title each, and what stands above."""

    sketches: Sequence[Sketch]
    titles: Sequence[str]
    caption: str

    def as_bytes(self, suffix: str) -> bytes:
        """A file of the kind that its suffix names."""
        if suffix == ".dxf":
            from gudgeon.drawing.dxf import as_dxf

            return as_dxf(self.sketches, self.titles)
        from gudgeon.drawing.picture import as_bytes, figure_of

        return as_bytes(figure_of(self.sketches, self.titles, self.caption), suffix)


@dataclass(frozen=True)
class Request:
    """The command line, as typed."""

    file: str
    scene: str
    at: str | None
    target: Path | None
    settings: tuple[str, ...]
    branches: bool


def draw_file(request: Request) -> int:
    """Draw and write; what `check` would complain of is raised afterwards."""
    if request.at is not None and request.branches:
        raise BadValueError("--branches with --at: assemblies are those of the start", hint="leave one of them out")
    wanted = settings(request.settings)
    chosen_scenes(request.file, (request.scene,))
    file = find_mechanism(request.file)
    target = request.target or Path("out") / f"{file.stem}_{request.scene}.svg"
    need_suffix(target, SUFFIXES)
    check_file("--out", target)
    from gudgeon.results.figures import plots  # noqa: F401  (says where matplotlib is missing)

    if target.suffix.lower() == ".dxf":
        from gudgeon.drawing import dxf  # noqa: F401  (says where ezdxf is missing)

    at = 0.0 if request.at is None else number_of_text(spaced(request.at), "--at", (0, 0, 1))
    if at < 0.0:
        raise BadValueError(f"--at is {at:g} s: the motion starts at 0 s", hint="take a time of the motion")
    with _drawable(target):
        if at > 0.0:
            drawn, failure = _moved(request, at, wanted), None
        else:
            with status_line(), working(f"deriving {file.stem}, scene {request.scene}"):
                drawn, failure = _start(request, file, wanted)
        data = drawn.as_bytes(target.suffix.lower())
    write_bytes(target, data)
    wrote("picture", target)
    if failure is not None:
        raise failure
    return 0


@contextmanager
def _drawable(target: Path) -> Iterator[None]:
    """Numbers near the largest one end in an error, and in no warnings of NumPy's."""
    try:
        with np.errstate(all="ignore"):
            yield
    except (ValueError, ArithmeticError) as error:
        if isinstance(error, GudgeonError):
            raise
        told = f"no picture {shortened(target)}: its numbers cannot be drawn ({error})"
        raise GudgeonError(f"{told}\n  look for a length or a start that is far too large") from error


def _moved(request: Request, at: float, wanted: Mapping[str, float | str]) -> Drawn:
    """At a time of the motion."""
    from gudgeon.results.figures.mechanism_plots import sketch_at
    from gudgeon.simulation.from_file import load

    with status_line():
        simulation = load(request.file, request.scene)
    check_addresses(wanted, request.file, [simulation.source])
    with progress_bar() as bar:
        try:
            run = simulation.simulate(at, parameters=wanted, progress=bar(request.scene), peaks=())
        except SolverError as error:  # its advice is for who keeps a run
            why, _, _ = str(error).partition("\n")
            hint = "draw an earlier time, or let gudgeon run show the motion until then"
            raise SolverError(f"{why}\n  {hint}", error.time, error.pivot) from error
        except BadValueError as error:
            if not error.message.startswith("t_end is"):
                raise
            raise BadValueError(error.message.replace("t_end", "--at", 1), hint=error.hint) from error
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt
    source, t = run.source, float(run.t[-1])
    return Drawn([sketch_at(run, t)], [""], _caption(source.title or source.mechanism, request.scene, t))


def _caption(title: str, scene: str, t: float) -> str:
    return f"{title}: {scene}, t = {quantity(t, 's', 6)}"


def _start(request: Request, file: Path, wanted: Mapping[str, float | str]) -> tuple[Drawn, GudgeonError | None]:
    """At the start, or as near to it as the linkage closes; with what is wrong with it."""
    from gudgeon.assembly.closure import Closure
    from gudgeon.generator.pipeline import closed_linkage
    from gudgeon.generator.reader.read import read_mechanism

    mechanism = read_mechanism(read_bytes(file), str(file))
    linkage, _ = closed_linkage(mechanism, request.scene)
    check_addresses(wanted, request.file, [linkage.source])
    linkage = at_numbers(mechanism, linkage, wanted)
    closure = Closure(linkage, linkage.p, 0.0)
    with np.errstate(all="ignore"):
        q, closed = closure.nearest()
    caption = _caption(mechanism.title or mechanism.name, request.scene, 0.0)
    if not closed:
        return _open(mechanism, closure, q, caption)
    v, failure = _velocities(closure, q)
    if request.branches:
        sketches, titles = _assemblies(mechanism, closure, q)
        return Drawn(sketches, titles, caption), failure
    return Drawn(_sketches(mechanism, closure, [_posture(linkage, q, v)]), [""], caption), failure


def _velocities(closure: Closure, q: Array) -> tuple[Array | None, AssemblyError | None]:
    from gudgeon.assembly.start import velocities

    try:
        return velocities(closure, q), None
    except AssemblyError as error:
        return None, error


def _posture(linkage: NumPyLinkage, q: Array, v: Array | None) -> Posture:
    from gudgeon.drawing.posture import Posture
    from gudgeon.results.figures.postures import loads_at

    loads = loads_at(linkage.source, linkage.p, q, np.zeros_like(q) if v is None else v)
    return Posture(linkage.source, linkage.p, q, 0.0, v, loads)


def _sketches(mechanism: Mechanism, closure: Closure, postures: Sequence[Posture]) -> list[Sketch]:
    """Closed linkages, with what may move without being meant to; all to one scale."""
    from gudgeon.assembly.mobility import find_mobility
    from gudgeon.drawing.failures import freedoms
    from gudgeon.drawing.plan import make_plan
    from gudgeon.drawing.sketch import make_sketch, room_of_all

    with np.errstate(all="ignore"):
        found = find_mobility(closure.linkage, closure.p, postures[0].q)
    plans, sketches = [make_plan([posture], postures[0]) for posture in postures], []
    unit = min(plan.unit for plan in plans)
    plans = [replace(plan, unit=unit) for plan in plans]
    box = room_of_all(postures, plans)
    marked = found.loose or (found.freedoms and mechanism.freedoms is None)
    for posture, plan in zip(postures, plans, strict=True):
        shapes, labels = freedoms(closure, posture, unit, found.loose) if marked else ([], [])
        loose = frozenset(found.loose)
        sketches.append(make_sketch(posture, plan, more=shapes, labels=labels, loose=loose, box=box))
    return sketches


def _open(mechanism: Mechanism, closure: Closure, q: Array, caption: str) -> tuple[Drawn, GudgeonError]:
    """As near to closing as it comes, with what does not reach."""
    from gudgeon.assembly.failures import not_closed
    from gudgeon.drawing.failures import gaps
    from gudgeon.drawing.sketch import make_sketch

    failure = not_closed(closure, q)
    if not (np.isfinite(q).all() and np.isfinite(closure.residual(q)).all()):
        raise failure
    posture = _posture(closure.linkage, q, None)  # type: ignore[arg-type]
    shapes, labels = gaps(closure, posture)
    sketch = make_sketch(posture, more=shapes, labels=labels)
    return Drawn([sketch], [""], f"{caption}: it does not close"), failure


def _assemblies(mechanism: Mechanism, closure: Closure, q: Array) -> tuple[list[Sketch], list[str]]:
    """Of each a sketch and what picks it, the start first."""
    from gudgeon.assembly.branches import find_assemblies
    from gudgeon.assembly.mobility import find_mobility
    from gudgeon.commands.assembly_story import guess_text

    linkage: Any = closure.linkage
    with np.errstate(all="ignore"):
        along = find_mobility(linkage, linkage.p, q).along
    found = find_assemblies(linkage, linkage.p, q, along)
    postures = [_posture(linkage, one.q, _velocities(closure, one.q)[0]) for one in found]
    here = {True: " (as the file has it)", False: ""}
    titles = [f"{k}  {guess_text(one)}{here[one.is_start]}" for k, one in enumerate(found, 1)]
    return _sketches(mechanism, closure, postures), titles

"""`gudgeon run`: simulate scenes, compare each with the ideal one, write and show what came out.

- `check_needs` asks whether there is memory and disk for all scenes, before the first of them begins.
- `verify` and `write_reports`: `--verify` checks the contacts of each run, `--report` writes its page. For a page each
  scene is run again, and its result is saved again with what that run showed.
- `origin_of` and `check_origin`: from which mechanism file a result is, so that none of another's is written over.
  Two files may have one name inside. A result notes a digest of its file's path and of its bytes: the same path,
  edited, or the same bytes, moved, is the same mechanism. A result that notes nothing may be replaced.
"""

from __future__ import annotations

import mmap
import os
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gudgeon.commands.common import check_addresses, check_folder, check_name, chosen_scenes, have, known_here, settings
from gudgeon.commands.progress import progress_bar, status_line
from gudgeon.errors import AssemblyError, GudgeonError, InputError, MemoryShortage, SolverError, shortened
from gudgeon.files.room import check_disk, check_memory
from gudgeon.files.writing import write_bytes
from gudgeon.language.names import unknown
from gudgeon.language.shown import path_text, print_json, visible
from gudgeon.loading.find import find_mechanism
from gudgeon.model.default_step import T_END, scene_end, scene_number
from gudgeon.model.evaluation import evaluated_bytes, sample_bytes
from gudgeon.model.parameters import prepare, value
from gudgeon.results.results import Result
from gudgeon.simulation.arguments import DEFAULT_OUTPUT
from gudgeon.simulation.from_file import load

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.model.compiled import Array
    from gudgeon.results.reports.comparison import SceneReport
    from gudgeon.simulation.simulation import Simulation

Settings: TypeAlias = Mapping[str, float | str]  # address -> SI, or text with a unit
Files: TypeAlias = dict[str, str]  # scene, or "picture" -> path

IDEAL = "ideal"
ORIGIN = "origin"  # attribute of the file
_NOTED = re.compile(rb"gudgeon-origin ([0-9a-f]{16}) ([0-9a-f]{16})")  # found without HDF5, which takes time to import


@dataclass(frozen=True)
class Request:
    """The command line, as typed."""

    file: str
    scenes: tuple[str, ...]
    settings: tuple[str, ...]
    t_end: str | None
    output: int | None
    step: str | None
    method: str
    rtol: str | None
    watch: tuple[str, ...]
    out: Path
    horizon: bool
    regenerate: bool
    json: bool
    formulation: str = "reduced"
    verbose: bool = False
    peaks: tuple[str, ...] = ()  # beside those that scenes ask for
    report: bool = False
    verify: bool = False


@dataclass
class Session:
    """What has been computed so far; it is complete enough to be shown at any time."""

    runs: dict[str, Result] = field(default_factory=dict)
    references: dict[str, Result] = field(default_factory=dict)
    failures: dict[str, GudgeonError] = field(default_factory=dict)
    files: Files = field(default_factory=dict)  # what was written
    unwritten: list[GudgeonError] = field(default_factory=list)
    haste: dict[str, str] = field(default_factory=dict)  # what each scene's library says of the times that it took
    shown: bool = False
    interrupted: bool = False


def run_scenes(request: Request) -> int:
    """Run, compare, save, show; the exit code."""
    wanted = settings(request.settings)
    check_folder("--out", request.out)
    names = dict.fromkeys([IDEAL, *chosen_scenes(request.file, request.scenes)])
    with status_line(quiet=request.json):
        renew, how = request.regenerate, request.formulation
        simulations = {name: load(request.file, name, regenerate=renew, formulation=how) for name in names}
    _check(request, wanted, simulations)
    for name, simulation in simulations.items():
        path = result_path(request.out, simulation.source.mechanism, name)
        check_name("--out", path)
        check_origin(path, origin_of(request.file, simulation.source.sha256))
        if request.report:
            check_name("--out", path.with_suffix(".html"))
    check_name("--out", request.out / f"{simulations[IDEAL].source.mechanism}.png")
    session = Session()
    try:
        _simulate(request, wanted, simulations, session)
    except KeyboardInterrupt:
        session.interrupted = True
    try:
        if session.runs:
            _hand_over(request, simulations, session)
    except KeyboardInterrupt:
        session.interrupted = True
    for scene, error in session.failures.items():
        print(f"error: scene {scene}: {visible(error)}", file=sys.stderr)
    for error in session.unwritten:
        print(f"error: {visible(error)}", file=sys.stderr)
    if session.interrupted:
        print(_interrupted(names, session), file=sys.stderr)
        return 130
    return max((error.exit_code for error in (*session.failures.values(), *session.unwritten)), default=0)


def _interrupted(names: Iterable[str], session: Session) -> str:
    """What Ctrl-C left, and what it left out."""
    from gudgeon.simulation.horizon import UNFINISHED

    if not session.runs:
        return "interrupted before anything was computed: nothing is shown or saved"
    unsaved = [name for name in session.runs if name not in session.files]
    kept = " and ".join(["shown"] * session.shown + ["saved"] * (not unsaved)) or "neither shown nor saved"
    told = f"interrupted: what was computed is {kept}"
    if unsaved and session.shown or 0 < len(unsaved) < len(session.runs):
        told += f"; not saved: {', '.join(unsaved)}"
    if any(UNFINISHED in run.diagnostics.notes for run in session.runs.values()):
        told += "; the search for the horizon was not finished"
    ended = [f"{name} ends at {run.t[-1]:.6g} s" for name, run in session.runs.items() if run.diagnostics.interrupted]
    left = [name for name in names if name not in session.runs and name not in session.failures]
    beside = {IDEAL: "was run as the reference alone"} if session.references else {}
    missing = [f"{name} {beside.get(name, 'was not begun')}" for name in left]
    return "; ".join([told, *ended, *missing])


def _check(request: Request, settings: Settings, simulations: Mapping[str, Simulation]) -> None:
    """Names that no scene has and values that are not valid are told before anything is run or written."""
    check_addresses(settings, request.file, [simulation.source for simulation in simulations.values()])
    for simulation in simulations.values():
        prepare(simulation.compiled, known_here(simulation.source, settings))
    if request.watch or request.peaks:
        from gudgeon.results.series import catalogue

        series = tuple(dict.fromkeys(name for s in simulations.values() for name in catalogue(s.source)))
        for option, names in (("--watch", request.watch), ("--peaks", request.peaks)):
            for name in names:
                if name not in series:
                    raise unknown(f"{option}: no scene has a series {name!r}", name, series)


def _peaks(request: Request, source: KernelSource) -> tuple[str, ...] | None:
    """The scene's own, and those asked for that it has; None: its own."""
    if not request.peaks:
        return None
    from gudgeon.results.series import catalogue

    known = catalogue(source)
    return tuple(dict.fromkeys([*source.peaks, *(name for name in request.peaks if name in known)]))


def _simulate(request: Request, settings: Settings, simulations: Mapping[str, Simulation], session: Session) -> None:
    """All scenes, the ideal one last: it lasts as long as the longest, and is to be had cheaply."""
    t_end, step = (None if text is None else value(text) for text in (request.t_end, request.step))
    own = {name: prepare(s.compiled, known_here(s.source, settings))[0] for name, s in simulations.items()}
    longest = max((scene_end(s.source, own[n]) for n, s in simulations.items() if n != IDEAL), default=T_END)
    check_needs(request, {name: (simulation, own[name]) for name, simulation in simulations.items()})
    with progress_bar(quiet=request.json) as bar:
        for name in sorted(simulations, key=lambda name: name == IDEAL):
            simulation, until = simulations[name], t_end
            method = "auto" if name == IDEAL and len(simulations) > 1 else request.method
            if until is None:
                until = scene_number(simulation.source, "t_end", own[name], longest if name == IDEAL else T_END)
            session.haste[name] = simulation.compiled.lib.haste
            try:
                run = simulation.simulate(
                    until,
                    output=request.output,
                    method=method,
                    step=step,
                    rtol=request.rtol,
                    horizon=request.horizon or request.report,
                    parameters=known_here(simulation.source, settings),
                    progress=bar(name),
                    against=simulations[IDEAL] if simulation.source.clearances else None,
                    peaks=_peaks(request, simulation.source),
                )
            except (AssemblyError, SolverError) as error:  # the other scenes are worth having
                session.failures[name] = error
                partial = getattr(error, "partial", None)
                if partial is not None and len(partial.t) > 1:
                    session.runs[name] = partial  # up to where it failed: that is where one looks
                continue
            except MemoryError as error:
                session.failures[name] = MemoryShortage(error)
                continue
            session.runs[name] = run
            if run.diagnostics.interrupted:
                session.interrupted = True
                return


def _hand_over(request: Request, simulations: Mapping[str, Simulation], session: Session) -> None:
    """Everything after the integration: the results are saved first, for nothing that follows may lose them."""
    from gudgeon.results.reports.comparison import compare
    from gudgeon.results.series import default_watch

    if request.verify:
        verify(session.runs, session.failures, request.json)
    runs = {scene: session.runs[scene] for scene in sorted(session.runs, key=lambda scene: scene != IDEAL)}
    _save(request, runs, session)
    _refer(simulations[IDEAL], session)
    if request.report:

        def save(some: Mapping[str, Result]) -> None:
            _save(request, some, session)

        told = session.files, session.unwritten, request.json
        write_reports(runs, simulations, session.references, request.out, save, *told)
    first = session.runs.get(IDEAL) or next(iter([*session.references.values(), *session.runs.values()]))
    watch = request.watch or default_watch(first)
    reports = [compare(run, session.references.get(scene), watch) for scene, run in runs.items()]
    try:
        _draw(request.out, runs, session, watch)
    finally:
        _show(request, first.source, reports, session)


def _refer(ideal: Simulation, session: Session) -> None:
    """An ideal run to compare with for each scene with play; one that Ctrl-C ended is none."""
    for scene, run in session.runs.items():
        if run.source.clearances:  # any other scene is the ideal one with its own numbers
            try:
                reference = _reference(ideal, run, session)
            except (GudgeonError, MemoryError) as error:
                told = MemoryShortage(error) if isinstance(error, MemoryError) else error
                session.failures.setdefault(IDEAL, told)
                continue
            if len(reference.t) < len(run.t):
                session.interrupted = True
                return
            session.references[scene] = reference


def _reference(ideal: Simulation, run: Result, session: Session) -> Result:
    """The ideal run at the run's times and with its parameters; shared by scenes with the same ones."""
    shared = {slot.address for slot in ideal.source.slots}
    values = {address: number for address, number in run.parameters.items() if address in shared}
    for other in (session.runs.get(IDEAL), *session.references.values()):
        if other and np.array_equal(other.t, run.t) and all(other.parameters[a] == v for a, v in values.items()):
            return other
    return ideal.simulate(output=run.t, parameters=values, stop=False, peaks=())


def _save(request: Request, runs: Mapping[str, Result], session: Session) -> None:
    """A NetCDF file a scene; what a full disk refuses goes to `session.unwritten`, and the others are written."""
    if not have("NetCDF files", "h5py"):
        return
    for scene, run in runs.items():
        path = result_path(request.out, run.source.mechanism, scene)
        try:
            run.save(path, {ORIGIN: origin_of(request.file, run.source.sha256)})
            session.files[scene] = str(path)
        except GudgeonError as error:
            session.unwritten.append(error)
        except MemoryError as error:
            session.unwritten.append(MemoryShortage(error))


def _draw(out: Path, runs: Mapping[str, Result], session: Session, watch: Sequence[str]) -> None:
    """One picture: it is smaller than results, and there may be room for it where there was none for them."""
    if not have("picture", "matplotlib"):
        return
    from gudgeon.results.figures.plots import figure, save_figure

    path = out / f"{next(iter(runs.values())).source.mechanism}.png"
    try:
        save_figure(figure(runs, session.references, watch), path)
        session.files["picture"] = str(path)
    except GudgeonError as error:
        session.unwritten.append(error)
    except MemoryError as error:
        session.unwritten.append(MemoryShortage(error))


def result_path(out: Path, mechanism: str, scene: str) -> Path:
    """Where the result of a scene goes."""
    return out / f"{mechanism}_{scene}.nc"


def _show(request: Request, source: KernelSource, reports: list[SceneReport], session: Session) -> None:
    """What was found and written: tables and notes, or JSON."""
    from gudgeon.language.shown import plain_console
    from gudgeon.results.reports.comparison import as_json, tables
    from gudgeon.results.reports.run_report import beyond

    if request.json:
        scenes = {name: told | {"beyond": beyond(session.runs[name])} for name, told in as_json(reports).items()}
        document = {"mechanism": source.mechanism, "scenes": scenes, "files": session.files}
        print_json(document)
    else:
        console = plain_console(None if sys.stdout.isatty() else 200)
        for table in tables(source.title or source.mechanism, reports, console.width, request.verbose):
            console.print(table)
        runs = [(r.scene, session.runs[r.scene]) for r in reports]
        told = [f"{name}: {note}" for name, run in runs for note in (*run.diagnostics.notes, *beyond(run))]
        told += [f"{name}: {note}" for name, note in session.haste.items() if note and name in session.runs]
        for note in dict.fromkeys(told):
            console.print(f"note: {visible(note)}")
        print("".join(f"wrote {path_text(path)}\n" for path in session.files.values()), end="")
    session.shown = True


def check_needs(request: Request, scenes: Mapping[str, tuple[Simulation, Array]]) -> None:
    """MemoryError where samples and all that follows from them do not fit, OutputError where their files do not.

    scenes: each with its numbers. Files hold every series, and take the places of older ones, one after the other; a
    disk is not asked where no file is written.
    """
    from gudgeon.results.series import catalogue

    given, counts = request.output, dict[str, float]()
    for name, (one, p) in scenes.items():
        counts[name] = 1.0 + (scene_number(one.source, "output", p, DEFAULT_OUTPUT) if given is None else given)
    most = f"{len(scenes)} scenes of {max(counts.values()):.0f} samples"
    each = {name: sample_bytes(one.compiled) + evaluated_bytes(one.compiled) for name, (one, _) in scenes.items()}
    check_memory(sum(counts[name] * each[name] for name in scenes), most)
    if find_spec("h5py"):
        files = [8.0 * counts[name] * (1 + len(catalogue(one.source))) for name, (one, _) in scenes.items()]
        older = sum(_size(request.out, one.source.mechanism, name) for name, (one, _) in scenes.items())
        check_disk(request.out, max(*files, sum(files) - older), f"the results, {most},")


def _size(out: Path, mechanism: str, scene: str) -> int:
    path = result_path(out, mechanism, scene)
    return path.stat().st_size if path.is_file() else 0


def report_path(out: Path, mechanism: str, scene: str) -> Path:
    """Where the page of a scene goes: beside its result."""
    return out / f"{mechanism}_{scene}.html"


def verify(runs: dict[str, Result], failures: dict[str, GudgeonError], quiet: bool) -> None:
    """Check the contacts of every run (Result.check); a run whose contacts are wrong goes to `failures` too."""
    for scene, run in runs.items():
        if not run.source.clearances:
            continue
        try:
            with status_line(quiet=quiet):
                found = run.check()
            notes = (
                *run.diagnostics.notes,
                *found.notes,
                f"{len(found.faults) or 'no'} faults of contacts at {found.samples} samples",
            )
            runs[scene] = replace(run, diagnostics=replace(run.diagnostics, notes=notes))
            found.raise_faults()
        except GudgeonError as error:
            failures.setdefault(scene, error)


def write_reports(
    runs: dict[str, Result],
    simulations: Mapping[str, Simulation],
    references: Mapping[str, Result],
    out: Path,
    save: Callable[[Mapping[str, Result]], None],
    files: dict[str, str],
    unwritten: list[GudgeonError],
    quiet: bool,
) -> None:
    """Fills `files` and `unwritten`; `runs` are then the examined ones. A run that Ctrl-C ended is told as it is."""
    from gudgeon.simulation.examine import examine

    for scene, run in runs.items():
        try:
            if not run.diagnostics.interrupted:
                with status_line(quiet=quiet):
                    runs[scene] = run = examine(simulations[scene], run, references.get(scene))
                save({scene: run})
            path = report_path(out, run.source.mechanism, scene)
            write_bytes(path, run.report().to_html().encode())
            files[f"report {scene}"] = str(path)
        except GudgeonError as error:
            unwritten.append(error)
        except MemoryError as error:
            unwritten.append(MemoryShortage(error))


def origin_of(mechanism: str, digest: str) -> str:
    """Of a mechanism as it was named on the command line, and the digest of its bytes."""
    place = sha256(os.fsencode(find_mechanism(mechanism).resolve())).hexdigest()
    return f"gudgeon-origin {place[:16]} {digest[:16]}"


def check_origin(path: Path, origin: str) -> None:
    """InputError where a result of another mechanism file stands at `path`."""
    ours = _NOTED.match(origin.encode())
    try:
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            noted = _NOTED.search(data)
            found = set(noted.groups()) if noted else set()
    except (OSError, ValueError):  # none there; what may be replaced is known when it is written
        return
    if ours and found and not found & set(ours.groups()):
        told = f"--out: {shortened(path)} is the result of another mechanism file that has the same name"
        raise InputError(told, hint="name another folder with --out, or remove it; or change `name:` in one of them")

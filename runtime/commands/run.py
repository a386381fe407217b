"""Run `gudgeon run`: simulate scenes, compare each with the ideal one, save and show the results.

- `check_memory_and_disk` checks memory and disk for all scenes before the first run.
- `verify_contacts` and `write_scene_reports` implement `--verify` and `--report`. For a report each scene is run again,
  and its result is saved again with the additional diagnostics.
- `format_origin` and `check_origin` prevent that a result of another mechanism file of the same name is replaced. A
  result stores hashes of its mechanism file's path and bytes; one equal hash is sufficient. A result without hashes may
  be replaced.
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

from gudgeon.commands.common import (
    check_addresses,
    check_output_folder,
    check_output_name,
    has_packages,
    parse_settings,
    select_known_settings,
    select_scenes,
)
from gudgeon.commands.progress import show_progress_bars, show_status_line
from gudgeon.errors import AssemblyError, GudgeonError, InputError, MemoryShortage, SolverError, shorten_path
from gudgeon.files.free_space import check_disk, check_memory
from gudgeon.files.writing import write_bytes
from gudgeon.language.names import make_missing_name_error
from gudgeon.language.text_output import escape_invisible, format_path, print_json
from gudgeon.loading.kernel_sources import find_mechanism
from gudgeon.model.default_step import T_END, evaluate_scene_end_time, evaluate_scene_option
from gudgeon.model.evaluation import compute_evaluation_bytes, compute_sample_bytes
from gudgeon.model.parameters import compute_parameter_values, parse_typed_number
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

IDEAL_SCENE = "ideal"
ORIGIN_ATTRIBUTE = "origin"  # attribute of the NetCDF file
_ORIGIN_PATTERN = re.compile(rb"gudgeon-origin ([0-9a-f]{16}) ([0-9a-f]{16})")  # found without HDF5, a slow import


@dataclass(frozen=True)
class RunRequest:
    """Arguments of the command line, as typed."""

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
    peaks: tuple[str, ...] = ()  # in addition to those of the scenes
    report: bool = False
    verify: bool = False


@dataclass
class RunOutcome:
    """Results, failures and written files of `gudgeon run` so far; it can be shown at any time, also after Ctrl-C."""

    runs: dict[str, Result] = field(default_factory=dict)
    references: dict[str, Result] = field(default_factory=dict)
    failures: dict[str, GudgeonError] = field(default_factory=dict)
    files: Files = field(default_factory=dict)  # what was written
    write_errors: list[GudgeonError] = field(default_factory=list)
    optimization_notes: dict[str, str] = field(
        default_factory=dict
    )  # notes on the optimization of each scene's library
    shown: bool = False
    interrupted: bool = False


def run_scenes(request: RunRequest) -> int:
    """Run `gudgeon run`: simulate the scenes and the ideal one, compare, save and show them, and return the exit code.

    Output files and parameters are checked before anything runs. Errors of single scenes are printed at the end. After
    Ctrl-C finished results are saved and shown, with exit code 130.
    """
    values = parse_settings(request.settings)
    check_output_folder("--out", request.out)
    names = dict.fromkeys([IDEAL_SCENE, *select_scenes(request.file, request.scenes)])
    with show_status_line(quiet=request.json):
        regenerate, formulation = request.regenerate, request.formulation
        simulations = {name: load(request.file, name, regenerate=regenerate, formulation=formulation) for name in names}
    _check_request(request, values, simulations)
    for name, simulation in simulations.items():
        path = _build_result_path(request.out, simulation.source.mechanism, name)
        check_output_name("--out", path)
        check_origin(path, format_origin(request.file, simulation.source.sha256))
        if request.report:
            check_output_name("--out", path.with_suffix(".html"))
    check_output_name("--out", request.out / f"{simulations[IDEAL_SCENE].source.mechanism}.png")
    outcome = RunOutcome()
    try:
        _simulate_scenes(request, values, simulations, outcome)
    except KeyboardInterrupt:
        outcome.interrupted = True
    try:
        if outcome.runs:
            _write_results(request, simulations, outcome)
    except KeyboardInterrupt:
        outcome.interrupted = True
    for scene, error in outcome.failures.items():
        print(f"error: scene {scene}: {escape_invisible(error)}", file=sys.stderr)
    for error in outcome.write_errors:
        print(f"error: {escape_invisible(error)}", file=sys.stderr)
    if outcome.interrupted:
        print(_format_interruption(names, outcome), file=sys.stderr)
        return 130
    return max((error.exit_code for error in (*outcome.failures.values(), *outcome.write_errors)), default=0)


def _format_interruption(names: Iterable[str], outcome: RunOutcome) -> str:
    """Return the message after Ctrl-C: which results are shown and saved, where runs ended, missing scenes."""
    from gudgeon.simulation.predictability_horizon import UNFINISHED

    if not outcome.runs:
        return "interrupted before any result was computed: nothing is shown or saved"
    unsaved = [name for name in outcome.runs if name not in outcome.files]
    state = " and ".join(["shown"] * outcome.shown + ["saved"] * (not unsaved)) or "neither shown nor saved"
    text = f"interrupted: the computed results are {state}"
    if unsaved and outcome.shown or 0 < len(unsaved) < len(outcome.runs):
        text += f"; not saved: {', '.join(unsaved)}"
    if any(UNFINISHED in run.diagnostics.notes for run in outcome.runs.values()):
        text += "; the search for the horizon was not finished"
    ended = [f"{name} ends at {run.t[-1]:.6g} s" for name, run in outcome.runs.items() if run.diagnostics.interrupted]
    missing = [name for name in names if name not in outcome.runs and name not in outcome.failures]
    reasons = {IDEAL_SCENE: "was run as the reference only"} if outcome.references else {}
    return "; ".join([text, *ended, *(f"{name} {reasons.get(name, 'was not started')}" for name in missing)])


def _check_request(request: RunRequest, settings: Settings, simulations: Mapping[str, Simulation]) -> None:
    """Raise InputError for unknown addresses of --set, invalid values, and unknown series of --watch and --peaks.

    Called before anything is run or written.
    """
    check_addresses(settings, request.file, [simulation.source for simulation in simulations.values()])
    for simulation in simulations.values():
        compute_parameter_values(simulation.compiled, select_known_settings(simulation.source, settings))
    if request.watch or request.peaks:
        from gudgeon.results.series import get_catalogue

        series = tuple(dict.fromkeys(name for s in simulations.values() for name in get_catalogue(s.source)))
        for option, names in (("--watch", request.watch), ("--peaks", request.peaks)):
            for name in names:
                if name not in series:
                    raise make_missing_name_error(f"{option}: no scene has a series {name!r}", name, series)


def _select_peak_series(request: RunRequest, source: KernelSource) -> tuple[str, ...] | None:
    """Return the names of series for the argument `peaks` of simulate: those of the scene's file and of `--peaks`.

    Names that the scene lacks are left out. None without `--peaks`: simulate then uses those of the file.
    """
    if not request.peaks:
        return None
    from gudgeon.results.series import get_catalogue

    catalogue = get_catalogue(source)
    return tuple(dict.fromkeys([*source.peaks, *(name for name in request.peaks if name in catalogue)]))


def _simulate_scenes(
    request: RunRequest, settings: Settings, simulations: Mapping[str, Simulation], outcome: RunOutcome
) -> None:
    """Run all scenes and store results and failures in `outcome`; after Ctrl-C, return with the partial result.

    The ideal scene is the last: by default it runs as long as the longest scene with play, by method auto. A failed run
    is stored up to its failure, and the next scene is run.
    """
    t_end, step = (None if text is None else parse_typed_number(text) for text in (request.t_end, request.step))
    p = {
        name: compute_parameter_values(s.compiled, select_known_settings(s.source, settings))[0]
        for name, s in simulations.items()
    }
    end_times = (evaluate_scene_end_time(s.source, p[n]) for n, s in simulations.items() if n != IDEAL_SCENE)
    max_end_time = max(end_times, default=T_END)
    check_memory_and_disk(request, {name: (simulation, p[name]) for name, simulation in simulations.items()})
    with show_progress_bars(quiet=request.json) as make_bar:
        for name in sorted(simulations, key=lambda name: name == IDEAL_SCENE):
            simulation, until = simulations[name], t_end
            method = "auto" if name == IDEAL_SCENE and len(simulations) > 1 else request.method
            if until is None:
                until = evaluate_scene_option(
                    simulation.source, "t_end", p[name], max_end_time if name == IDEAL_SCENE else T_END
                )
            outcome.optimization_notes[name] = simulation.compiled.lib.optimization_note
            try:
                run = simulation.simulate(
                    until,
                    output=request.output,
                    method=method,
                    step=step,
                    rtol=request.rtol,
                    horizon=request.horizon or request.report,
                    parameters=select_known_settings(simulation.source, settings),
                    progress=make_bar(name),
                    against=simulations[IDEAL_SCENE] if simulation.source.clearances else None,
                    peaks=_select_peak_series(request, simulation.source),
                )
            except (AssemblyError, SolverError) as error:  # the other scenes are still run
                outcome.failures[name] = error
                partial = getattr(error, "partial", None)
                if partial is not None and len(partial.t) > 1:
                    outcome.runs[name] = partial  # the results up to the failure
                continue
            except MemoryError as error:
                outcome.failures[name] = MemoryShortage(error)
                continue
            outcome.runs[name] = run
            if run.diagnostics.interrupted:
                outcome.interrupted = True
                return


def _write_results(request: RunRequest, simulations: Mapping[str, Simulation], outcome: RunOutcome) -> None:
    """Verify the results if requested, then save, compare, report, draw and show them.

    The contacts are verified first, since that adds notes to the runs; faults are stored as failures. Results are saved
    before the other steps, so that a later failure loses none; a report changes diagnostics and saves again.
    """
    from gudgeon.results.reports.comparison import compute_scene_report
    from gudgeon.results.series import choose_default_series

    if request.verify:
        verify_contacts(outcome.runs, outcome.failures, request.json)
    runs = {scene: outcome.runs[scene] for scene in sorted(outcome.runs, key=lambda scene: scene != IDEAL_SCENE)}
    _save_results(request, runs, outcome)
    _find_reference_runs(simulations[IDEAL_SCENE], outcome)
    if request.report:

        def save(some: Mapping[str, Result]) -> None:
            """Save these results again, after their diagnostics have changed."""
            _save_results(request, some, outcome)

        report_arguments = outcome.files, outcome.write_errors, request.json
        write_scene_reports(runs, simulations, outcome.references, request.out, save, *report_arguments)
    first = outcome.runs.get(IDEAL_SCENE) or next(iter([*outcome.references.values(), *outcome.runs.values()]))
    watch = request.watch or choose_default_series(first)
    reports = [compute_scene_report(run, outcome.references.get(scene), watch) for scene, run in runs.items()]
    try:
        _draw_picture(request.out, runs, outcome, watch)
    finally:
        _show_results(request, first.source, reports, outcome)


def _find_reference_runs(ideal: Simulation, outcome: RunOutcome) -> None:
    """Store the ideal run with which each scene with play is compared in `outcome.references`.

    After Ctrl-C, `outcome.interrupted` is set and the search ends. Errors are failures of the ideal scene.
    """
    for scene, run in outcome.runs.items():
        if run.source.clearances:  # other scenes are ideal ones with other parameters
            try:
                reference = _find_ideal_run(ideal, run, outcome)
            except (GudgeonError, MemoryError) as error:
                failure = MemoryShortage(error) if isinstance(error, MemoryError) else error
                outcome.failures.setdefault(IDEAL_SCENE, failure)
                continue
            if len(reference.t) < len(run.t):
                outcome.interrupted = True
                return
            outcome.references[scene] = reference


def _find_ideal_run(ideal: Simulation, run: Result, outcome: RunOutcome) -> Result:
    """Return the ideal run with times and parameter values of `run`, without stop and peaks; an equal one is reused."""
    common_addresses = {parameter.address for parameter in ideal.source.parameters}
    values = {address: number for address, number in run.parameters.items() if address in common_addresses}
    for other in (outcome.runs.get(IDEAL_SCENE), *outcome.references.values()):
        if other and np.array_equal(other.t, run.t) and all(other.parameters[a] == v for a, v in values.items()):
            return other
    return ideal.simulate(output=run.t, parameters=values, stop=False, peaks=())


def _save_results(request: RunRequest, runs: Mapping[str, Result], outcome: RunOutcome) -> None:
    """Write a NetCDF file for each scene and store its path in `outcome.files`.

    Errors, such as a full disk, are stored in `outcome.write_errors`. Without h5py nothing is written and a note is
    printed.
    """
    if not has_packages("NetCDF files", "h5py"):
        return
    for scene, run in runs.items():
        path = _build_result_path(request.out, run.source.mechanism, scene)
        try:
            run.save(path, {ORIGIN_ATTRIBUTE: format_origin(request.file, run.source.sha256)})
            outcome.files[scene] = str(path)
        except GudgeonError as error:
            outcome.write_errors.append(error)
        except MemoryError as error:
            outcome.write_errors.append(MemoryShortage(error))


def _draw_picture(out: Path, runs: Mapping[str, Result], outcome: RunOutcome, watch: Sequence[str]) -> None:
    """Write the picture of all runs and record its path; errors are stored in `outcome.write_errors`.

    Without matplotlib nothing is drawn and a note is printed. watch: names of the series shown.
    """
    if not has_packages("picture", "matplotlib"):
        return
    from gudgeon.results.figures.plots import draw_run_figure, save_figure

    path = out / f"{next(iter(runs.values())).source.mechanism}.png"
    try:
        save_figure(draw_run_figure(runs, outcome.references, watch), path)
        outcome.files["picture"] = str(path)
    except GudgeonError as error:
        outcome.write_errors.append(error)
    except MemoryError as error:
        outcome.write_errors.append(MemoryShortage(error))


def _build_result_path(out: Path, mechanism: str, scene: str) -> Path:
    """Return the path of the result of a scene."""
    return out / f"{mechanism}_{scene}.nc"


def _show_results(request: RunRequest, source: KernelSource, reports: list[SceneReport], outcome: RunOutcome) -> None:
    """Print tables, notes and written files, or the JSON document, and mark the outcome as shown."""
    from gudgeon.language.text_output import make_plain_console
    from gudgeon.results.reports.comparison import build_tables, convert_to_json_values
    from gudgeon.results.reports.run_report import find_exceeded_limits

    if request.json:
        scenes = {
            name: notes | {"beyond": find_exceeded_limits(outcome.runs[name])}
            for name, notes in convert_to_json_values(reports).items()
        }
        document = {"mechanism": source.mechanism, "scenes": scenes, "files": outcome.files}
        print_json(document)
    else:
        console = make_plain_console(None if sys.stdout.isatty() else 200)
        for table in build_tables(source.title or source.mechanism, reports, console.width, request.verbose):
            console.print(table)
        runs = [(r.scene, outcome.runs[r.scene]) for r in reports]
        notes = [
            f"{name}: {note}" for name, run in runs for note in (*run.diagnostics.notes, *find_exceeded_limits(run))
        ]
        notes += [
            f"{name}: {note}" for name, note in outcome.optimization_notes.items() if note and name in outcome.runs
        ]
        for note in dict.fromkeys(notes):
            console.print(f"note: {escape_invisible(note)}")
        print("".join(f"wrote {format_path(path)}\n" for path in outcome.files.values()), end="")
    outcome.shown = True


def check_memory_and_disk(request: RunRequest, scenes: Mapping[str, tuple[Simulation, Array]]) -> None:
    """Raise MemoryError if samples and evaluations do not fit into memory, OutputError if the files do not fit on disk.

    scenes: each simulation with its parameter values. A file contains every series and replaces an older one, so that
    at least the largest file must fit. The disk is not checked without h5py.
    """
    from gudgeon.results.series import get_catalogue

    requested_output, counts = request.output, dict[str, float]()
    for name, (simulation, p) in scenes.items():
        counts[name] = 1.0 + (
            evaluate_scene_option(simulation.source, "output", p, DEFAULT_OUTPUT)
            if requested_output is None
            else requested_output
        )
    samples_text = f"{len(scenes)} scenes of {max(counts.values()):.0f} samples"
    bytes_per_sample = {
        name: compute_sample_bytes(simulation.compiled) + compute_evaluation_bytes(simulation.compiled)
        for name, (simulation, _) in scenes.items()
    }
    check_memory(sum(counts[name] * bytes_per_sample[name] for name in scenes), samples_text)
    if find_spec("h5py"):
        files = [
            8.0 * counts[name] * (1 + len(get_catalogue(simulation.source))) for name, (simulation, _) in scenes.items()
        ]
        old_bytes = sum(
            _get_file_size(request.out, simulation.source.mechanism, name) for name, (simulation, _) in scenes.items()
        )
        check_disk(request.out, max(*files, sum(files) - old_bytes), f"the results, {samples_text},")


def _get_file_size(out: Path, mechanism: str, scene: str) -> int:
    """Return the size in bytes of an existing result, otherwise 0."""
    path = _build_result_path(out, mechanism, scene)
    return path.stat().st_size if path.is_file() else 0


def _build_report_path(out: Path, mechanism: str, scene: str) -> Path:
    """Return the path of the report of a scene, next to its result."""
    return out / f"{mechanism}_{scene}.html"


def verify_contacts(runs: dict[str, Result], failures: dict[str, GudgeonError], quiet: bool) -> None:
    """Check the contacts of every run with play (Result.check), and replace it in `runs` by a copy with notes.

    Faults and errors are stored in `failures`, unless the scene has one. quiet: without a status line.
    """
    for scene, run in runs.items():
        if not run.source.clearances:
            continue
        try:
            with show_status_line(quiet=quiet):
                findings = run.check()
            notes = (
                *run.diagnostics.notes,
                *findings.notes,
                f"contact check: {len(findings.faults) or 'no'} faults at {findings.samples} samples",
            )
            runs[scene] = replace(run, diagnostics=replace(run.diagnostics, notes=notes))
            findings.raise_faults()
        except GudgeonError as error:
            failures.setdefault(scene, error)


def write_scene_reports(
    runs: dict[str, Result],
    simulations: Mapping[str, Simulation],
    references: Mapping[str, Result],
    out: Path,
    save: Callable[[Mapping[str, Result]], None],
    files: dict[str, str],
    write_errors: list[GudgeonError],
    quiet: bool,
) -> None:
    """Run each scene again for the checks of the report, save the result and write the report as HTML.

    `examine` makes the additional runs; its results replace those in `runs` and are passed to `save` as {scene: run}.
    A run that Ctrl-C ended is only reported: it is neither examined nor saved again. `files` gets the path of each
    report, `write_errors` the error of a scene; the other scenes continue. `quiet`: no status line.
    """
    from gudgeon.simulation.examine import examine

    for scene, run in runs.items():
        try:
            if not run.diagnostics.interrupted:
                with show_status_line(quiet=quiet):
                    runs[scene] = run = examine(simulations[scene], run, references.get(scene))
                save({scene: run})
            path = _build_report_path(out, run.source.mechanism, scene)
            write_bytes(path, run.report().to_html().encode())
            files[f"report {scene}"] = str(path)
        except GudgeonError as error:
            write_errors.append(error)
        except MemoryError as error:
            write_errors.append(MemoryShortage(error))


def format_origin(mechanism: str, digest: str) -> str:
    """Return the attribute of a result file with hashes of the path and the bytes of the mechanism file.

    For example "gudgeon-origin 0123456789abcdef fedcba9876543210". digest: SHA-256 of the bytes.
    """
    path_hash = sha256(os.fsencode(find_mechanism(mechanism).resolve())).hexdigest()
    return f"gudgeon-origin {path_hash[:16]} {digest[:16]}"


def check_origin(path: Path, origin: str) -> None:
    """Raise InputError if the file `path` is the result of another mechanism file: both hashes differ from `origin`.

    Nothing is raised if the file is absent, unreadable or has no hashes. origin: text of `format_origin`.
    """
    expected_match = _ORIGIN_PATTERN.match(origin.encode())
    try:
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            stored_match = _ORIGIN_PATTERN.search(data)
            origins = set(stored_match.groups()) if stored_match else set()
    except (OSError, ValueError):  # no file; errors of writing are reported later
        return
    if expected_match and origins and not origins & set(expected_match.groups()):
        message = f"--out: {shorten_path(path)} is the result of another mechanism file with the same name"
        hint = "name another folder with --out, or remove the result; or change `name:` in one of the files"
        raise InputError(message, hint=hint)

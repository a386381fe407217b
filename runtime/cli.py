"""Define the command line: arguments and options of each command of `gudgeon`, which `gudgeon.commands` implements.

Only typer is imported with this module, so that commands start fast.
Exit codes: 0 success, 1 a run failed, 2 bad input, 130 interrupted.
"""

from __future__ import annotations

import sys
from copy import copy
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperGroup
from typer.models import CommandInfo

from gudgeon.commands import completion
from gudgeon.commands import options as opt
from gudgeon.commands.outcome import print_warnings_once, report_errors
from gudgeon.contract.methods import KINEMATIC, OFFERED, STEP_CONTROLLED_METHODS
from gudgeon.language.deprecations import STRESS

MAX_SENTENCE = 1000  # characters, more than in any first sentence


class Commands(TyperGroup):
    """Group of commands whose help lists each command with its complete first sentence, which typer would truncate."""

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the section "Commands" of the help text: each command that is not hidden, with its first sentence."""
        commands = ((name, self.get_command(ctx, name)) for name in self.list_commands(ctx))
        rows = [
            (name, command.get_short_help_str(MAX_SENTENCE))
            for name, command in commands
            if command and not command.hidden
        ]
        with formatter.section("Commands"):
            formatter.write_dl(rows)


app = typer.Typer(
    name="gudgeon",
    cls=Commands,
    help="Planar linkages whose joints may have play: from a YAML file to equations, C and a simulation.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # with rich, help and errors of options take 0.2 s more
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.callback()
def _define_root_options(version: opt.Version = False) -> None:
    """Define the options of the command without a subcommand."""
    pass


@app.command("run")
@report_errors
def simulate_file(
    file: opt.File,
    scene: opt.Scenes = None,
    set_: opt.Set = None,
    t_end: opt.Until = None,
    output: opt.Intervals = None,
    step: Annotated[str | None, typer.Option(help="Fixed step, in s or with a unit: 5us; auto uses rk4.")] = None,
    method: Annotated[
        str,
        typer.Option(
            help=f"{', '.join(OFFERED)}, {KINEMATIC}, scipy:Radau …", autocompletion=completion.complete_methods
        ),
    ] = "auto",
    rtol: Annotated[
        str | None, typer.Option(help=f"Tolerance of a step of auto, {', '.join(STEP_CONTROLLED_METHODS)}: 1e-8.")
    ] = None,
    watch: opt.Watch = None,
    peaks: opt.Peaks = None,
    verify: opt.Verify = False,
    formulation: Annotated[
        str, typer.Option(help="reduced (coordinates of a tree), or full: absolute ones, rk4 with Baumgarte's gains.")
    ] = "reduced",
    horizon: Annotated[
        bool, typer.Option("--horizon", help="Run three times more to find the predictability horizon.")
    ] = False,
    out: opt.Out = Path("out"),
    regenerate: Annotated[bool, typer.Option("--regenerate", help="Derive and compile again.")] = False,
    verbose: Annotated[
        bool, typer.Option("--verbose", "-v", help="Also show values that docs/runs_and_results.md explains.")
    ] = False,
    report: opt.Report = False,
    json: opt.Json = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
) -> int:
    """Simulate scenes and compare them with the ideal one: a table, a NetCDF file for each scene, one figure.

    The ideal scene (no play) is always run too, at the same times and with the same parameters.

    Example: gudgeon run engine.yaml --scene worn --set c=0.5mm --t-end 0.2
    """
    from gudgeon.commands.run import RunRequest, run_scenes

    return run_scenes(
        RunRequest(
            file,
            tuple(scene or ()),
            tuple(set_ or ()),
            t_end,
            output,
            step,
            method,
            rtol,
            tuple(watch or ()),
            out,
            horizon,
            regenerate,
            json,
            formulation,
            verbose,
            tuple(peaks or ()),
            report,
            verify,
        )
    )


@app.command("check")
@report_errors
def check_file(
    file: opt.File,
    verbose: Annotated[
        bool, typer.Option("--verbose", "-v", help="Also a table of counts and the reduction log of each scene.")
    ] = False,
    branches: opt.Branches = False,
    set_: opt.Set = None,
    json: opt.Json = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
) -> int:
    """Check a mechanism file: validity, assembly and degrees of freedom. Errors have line and column.

    Example: gudgeon check engine.yaml -v
    """
    from gudgeon.commands.check import check_mechanism

    return check_mechanism(file, verbose, json, branches, tuple(set_ or ()))


@app.command("emit")
@report_errors
def emit_code(
    file: opt.File,
    folder: Annotated[
        Path,
        typer.Option(
            "--out",
            "-o",
            parser=opt.parse_path,
            metavar="PATH",
            help="Folder for C with a folder for each scene; or x.fmu.",
        ),
    ],
    scene: opt.Scenes = None,
    files_as_json: opt.FilesJson = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
) -> int:
    """Write the generated C, to be read or compiled into other programs; to x.fmu as an FMU (FMI 3.0) of a scene.

    Example: gudgeon emit engine.yaml -o c --scene worn

    Example: gudgeon emit engine.yaml -o engine.fmu --scene worn
    """
    from gudgeon.commands.emit import emit_c

    return emit_c(file, folder, tuple(scene or ()))


@app.command("equations")
@report_errors
def write_equation_pages(
    file: opt.File,
    target: opt.Pages,
    scene: opt.ScenesOfPages = None,
    files_as_json: opt.FilesJson = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
) -> int:
    """Write the equations of a scene as LaTeX, text, HTML or a notebook that derives and runs them.

    Example: gudgeon equations engine.yaml -o engine.tex --scene worn
    """
    from gudgeon.commands.equations import write_equations

    return write_equations(file, target, tuple(scene or ()))


@app.command("laws")
@report_errors
def list_laws(
    name: opt.LawName = None,
    plot: opt.Plot = None,
    set_: opt.Set = None,
    json: opt.Json = False,
    laws: opt.Laws = None,
) -> int:
    """List the laws of contact, friction and film; print one law (equations, keys, validity, reference), or plot it.

    Example: gudgeon laws flores --plot flores.svg --set restitution=.5
    """
    from gudgeon.commands.laws import LawsRequest, show_laws

    return show_laws(LawsRequest(name, json, plot, tuple(set_ or ())))


@app.command("new")
@report_errors
def create_file(
    name: opt.Name,
    like: opt.Like = None,
    study: opt.OfStudy = False,
    files_as_json: opt.FilesJson = False,
    quiet: opt.Quiet = False,
) -> int:
    """Write a new mechanism file, NAME.yaml, or a study file, with comments that explain it.

    Example: gudgeon new engine --like slider_crank
    """
    from gudgeon.commands.new import create_mechanism_file, create_study_file

    return create_study_file(name, like) if study else create_mechanism_file(name, like)


@app.command("import")
@report_errors
def import_file(
    file: opt.Foreign, target: opt.Mechanism = None, files_as_json: opt.FilesJson = False, quiet: opt.Quiet = False
) -> int:
    """Convert a linkage of pylinkage or PMKS+ to a mechanism file.

    Example: gudgeon import four_bar.json -o four_bar.yaml
    """
    from gudgeon.commands.import_ import import_linkage

    return import_linkage(file, target)


@app.command("exercise")
@report_errors
def create_exercise(
    file: opt.File,
    target: opt.Sheet,
    scene: opt.OneScene = "ideal",
    seed: opt.Seed = 1,
    at: opt.Moment = None,
    files_as_json: opt.FilesJson = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
) -> int:
    """Write an exercise sheet for a mechanism, and its solutions in a second file.

    Tasks: write Φ, count the degrees of freedom, Φ_q at a position, γ, the force in a joint. The seed selects the
    parameter values.

    Example: gudgeon exercise engine.yaml -o sheet.html --seed 7
    """
    from gudgeon.commands.exercise import write_exercise

    return write_exercise(file, target, scene, seed, at)


@app.command("draw")
@report_errors
def draw_mechanism(
    file: opt.File,
    scene: opt.OneScene = "ideal",
    at: opt.At = None,
    target: opt.Picture = None,
    set_: opt.Set = None,
    branches: opt.Branches = False,
    files_as_json: opt.FilesJson = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
) -> int:
    """Draw a mechanism: bodies, joints, drives, forces, joints with play magnified.

    A linkage that does not close at the start is drawn with its gaps in red, then the error of `check` is printed.

    Example: gudgeon draw engine.yaml --scene worn --at 20ms -o engine.png
    """
    from gudgeon.commands.draw import DrawRequest, draw_mechanism_file

    return draw_mechanism_file(DrawRequest(file, scene, at, target, tuple(set_ or ()), branches))


@app.command("schema")
@report_errors
def print_json_schema(
    study: Annotated[bool, typer.Option("--study", help="The schema of study files.")] = False, laws: opt.Laws = None
) -> int:
    """Print the JSON Schema of mechanism files (with --study of study files), for editors that complete and check YAML.

    The schema contains the user-defined laws of --laws.

    Example: gudgeon schema > gudgeon.schema.json
    """
    from gudgeon.commands.schema import print_schema

    return print_schema(study)


@app.command("bench")
@report_errors
def benchmark_methods(
    file: opt.File,
    scene: opt.Scenes = None,
    set_: opt.Set = None,
    t_end: opt.End = None,
    out: opt.Out = Path("out"),
    csv: opt.Csv = None,
    quick: opt.Quick = False,
    mark: opt.Mark = None,
    methods: Annotated[
        list[str] | None,
        typer.Option(
            "--methods", metavar="NAMES", help=f"Only these methods: {','.join(OFFERED)},scipy:*,sundials:cvode."
        ),
    ] = None,
    json: opt.Json = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
) -> int:
    """Measure run time against error with every method, for each scene: a table, a CSV file, a figure.

    Errors are differences from another method at a much tighter tolerance. The cross-checks (scipy:*, sundials:*) run
    if a scene allows them, at fewer tolerances if they are slow, and not with --quick.

    Example: gudgeon bench engine.yaml --scene worn --mark-step 0.1ms
    """
    from gudgeon.commands.bench import benchmark_file
    from gudgeon.commands.studies import MeasurementRequest

    request = MeasurementRequest(file, tuple(scene or ()), tuple(set_ or ()), t_end, out, csv, quick, mark, json)
    return benchmark_file(request, tuple(methods or ()))


@app.command("stress", hidden=True)
@app.command("map")
@report_errors
def map_stability(
    context: typer.Context,
    file: opt.File,
    scene: opt.Scenes = None,
    set_: opt.Set = None,
    method: Annotated[
        str, typer.Option(help=f"{', '.join(OFFERED)}.", autocompletion=completion.complete_methods)
    ] = "auto",
    at: opt.Rest = None,
    axis: opt.Axis = None,
    box: opt.Box = None,
    range_: opt.Range = None,
    t_end: opt.End = None,
    out: opt.Out = Path("out"),
    csv: opt.Csv = None,
    quick: opt.Quick = False,
    mark: opt.Mark = None,
    json: opt.Json = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
) -> int:
    """Map stable and failed runs over parameters: tolerance (rk4: step) × clearance, or the axes of --axis or --box.

    Each run is stable, inaccurate, diverged or outside the model, with its reason. Failures have the command that
    repeats them.

    Example: gudgeon map engine.yaml --scene worn --method rk4 --mark-step 0.1ms

    Example: gudgeon map engine.yaml --box 64 --range c=.05mm..1mm --range stiffness=1GPa..400GPa
    """
    from gudgeon.commands.map import MapOptions, map_file
    from gudgeon.commands.studies import MeasurementRequest

    if context.info_name == "stress":
        typer.echo(f"warning: {STRESS}", err=True)
    request = MeasurementRequest(file, tuple(scene or ()), tuple(set_ or ()), t_end, out, csv, quick, mark, json)
    return map_file(request, MapOptions(method, at, tuple(axis or ()), box, tuple(range_ or ())))


@app.command("study")
@report_errors
def run_study(
    file: opt.StudyFile,
    finished: opt.Finished = None,
    out: opt.Folder = None,
    json: opt.Json = False,
    laws: opt.Laws = None,
    quiet: opt.Quiet = False,
    threads: opt.Threads = None,
    workers: opt.Workers = None,
    dask: opt.Cluster = None,
    restart: opt.Restart = False,
    set_: opt.Set = None,
    runs: opt.Runs = False,
    starts: opt.Starts = None,
    seed: opt.StartSeed = None,
) -> int:
    """Run a study: many runs of a mechanism over grids, random draws and perturbed starts, with one dataset of results.

    Finished blocks of runs are written to disk: after Ctrl-C, a kill or a full disk the same command resumes.

    Example: gudgeon study clearance.yaml --out clearance.study, then gudgeon study report clearance.study
    """
    from gudgeon.commands.study import StudyRequest, run_study_file

    return run_study_file(
        StudyRequest(file, out, threads, restart, set_, runs, json, finished, workers, dask, starts, seed)
    )


def get_command_name(command: CommandInfo) -> str:
    """Return the name by which a registered command is called: its explicit name, else the name of its function."""
    return str(command.name or getattr(command.callback, "__name__", ""))


def select_called_command(app: typer.Typer) -> typer.Typer:
    """Return a copy of the app with only the command that sys.argv[1] names, to save 30 ms for parsing all options.

    If it names no command, the copy has all commands.
    """
    called_commands = [command for command in app.registered_commands if sys.argv[1:2] == [get_command_name(command)]]
    app_copy = copy(app)
    app_copy.registered_commands = called_commands or app.registered_commands
    return app_copy


def main() -> None:
    """Run the command line: print each distinct warning once, and call the command that sys.argv names.

    Raises SystemExit with its exit code.
    """
    print_warnings_once()
    select_called_command(app)()

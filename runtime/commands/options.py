"""Declare command-line options and arguments that several commands share, for the library typer."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from gudgeon.commands import completion
from gudgeon.language.text_output import escape_invisible


def make_integer_parser(min_value: int) -> Callable[[str], int]:
    """Return a parser of option texts for whole numbers of at least `min_value`.

    Underscores and digits of other scripts are refused with typer.BadParameter.
    """

    def parse_integer(text: str) -> int:
        """Return the number, `min_value` or more. Raises typer.BadParameter."""
        stripped = str(text).strip()
        if (
            not (stripped.isascii() and stripped.removeprefix("-").isdigit())
            or len(stripped) > 18
            or int(stripped) < min_value
        ):
            raise typer.BadParameter(f"{escape_invisible(text)!r}: expected a whole number, {min_value} or more")
        return int(stripped)

    return parse_integer


def parse_path(text: str) -> Path:
    """Convert the text of an option to a path. Raise typer.BadParameter for an empty text."""
    if not str(text).strip():
        raise typer.BadParameter(f"{escape_invisible(str(text))!r}: expected a name")
    return Path(text)


def parse_file(text: str) -> Path:
    """Convert the text of an option to the path of a file. Raise typer.BadParameter if it ends with a slash."""
    if str(text).endswith("/"):
        raise typer.BadParameter(f"{escape_invisible(str(text))!r}: this is a folder, expected a file")
    return parse_path(text)


def parse_file_or_folder(text: str) -> Path:
    """Convert the text of an option to a path; a name with a suffix must be a file unless a folder has that name."""
    parsed_path = parse_path(text)
    return parse_file(text) if parsed_path.suffix and not os.path.isdir(parsed_path) else parsed_path


def _print_version(is_requested: bool) -> None:
    """Print the version and exit if `--version` is given; otherwise do nothing.

    Raises typer.Exit.
    """
    if is_requested:
        import gudgeon

        print(f"gudgeon {gudgeon.__version__}")
        raise typer.Exit


Version = Annotated[bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print it.")]
File = Annotated[
    str,
    typer.Argument(
        metavar="FILE",
        help="A YAML file, or the name of a shipped mechanism.",
        autocompletion=completion.complete_files,
    ),
]
Scenes = Annotated[
    list[str] | None,
    typer.Option(
        "--scene", "-s", help="A scene; may be repeated. [default: all]", autocompletion=completion.complete_scenes
    ),
]
OneScene = Annotated[str, typer.Option("--scene", "-s", help="Which scene.", autocompletion=completion.complete_scenes)]
Pages = Annotated[
    Path,
    typer.Option(
        "--out",
        "-o",
        parser=parse_file_or_folder,
        metavar="PATH",
        help="x.tex, .txt, .html or .ipynb; a folder: a page of each scene; - prints.",
    ),
]
ScenesOfPages = Annotated[
    list[str] | None,
    typer.Option(
        "--scene",
        "-s",
        help="A scene; in a folder several. [default: ideal; there all]",
        autocompletion=completion.complete_scenes,
    ),
]
Branches = Annotated[bool, typer.Option("--branches", help="Assemblies, and the guess that picks each.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON in SI units for a script, nothing else.")]
FilesJson = Annotated[bool, typer.Option("--json", help="Print JSON: which files were written, and notes.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but warnings and errors.")]
Out = Annotated[Path, typer.Option("--out", parser=parse_path, metavar="PATH", help="Folder for what is written.")]
At = Annotated[str | None, typer.Option("--at", metavar="TIME", help="Simulate to there: 0.2s. [default: the start]")]
Picture = Annotated[
    Path | None,
    typer.Option(
        "--out",
        "-o",
        parser=parse_file,
        metavar="PATH",
        help="x.svg, .png, .pdf or .dxf. [default: out/NAME_SCENE.svg]",
    ),
]
Laws = Annotated[
    list[str] | None,
    typer.Option("--laws", metavar="FILE.py", help="A force law of your own: the file is run as Python; repeatable."),
]
Plot = Annotated[
    Path | None,
    typer.Option(
        "--plot", parser=parse_file, metavar="PATH", help="Draw it: x.svg, .png or .pdf; its numbers by --set mu=.2."
    ),
]
LawName = Annotated[
    str | None,
    typer.Argument(
        metavar="[NAME]", help="Of a law, or what else it is called.", autocompletion=completion.complete_laws
    ),
]
# of what teaches
Name = Annotated[str, typer.Argument(metavar="NAME", help="Of the mechanism or the study; the file is NAME.yaml.")]
Like = Annotated[
    str | None,
    typer.Option("--like", metavar="NAME", help="A mechanism that comes with gudgeon: four_bar, jansen_leg …"),
]
OfStudy = Annotated[bool, typer.Option("--study", help="A study in place of a mechanism: many runs, what is measured.")]
Sheet = Annotated[
    Path, typer.Option("--out", "-o", parser=parse_file, metavar="PATH", help="x.html, .tex, .txt or .md.")
]
Seed = Annotated[
    int, typer.Option("--seed", parser=make_integer_parser(0), metavar="COUNT", help="Which numbers are drawn.")
]
Moment = Annotated[
    str | None, typer.Option("--at", metavar="TIME", help="When positions and forces are asked for. [default: drawn]")
]
# of studies
Peaks = Annotated[
    list[str] | None,
    typer.Option("--peaks", metavar="NAME", help="Largest and smallest value over all steps: S9.ay; repeatable."),
]
Quick = Annotated[bool, typer.Option("--quick", help="Fewer runs and a shorter window: seconds, not minutes.")]
Mark = Annotated[
    str | None, typer.Option("--mark-step", metavar="STEP", help="Show and tell what becomes of this step: 0.1ms.")
]
Set = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="ADDRESS=VALUE", help="Override a number: c=0.5mm, bodies.L2.mass='0.3 kg'."),
]
End = Annotated[str | None, typer.Option("--t-end", help="Length of the measured runs, in s or with a unit.")]
Csv = Annotated[
    Path | None,
    typer.Option("--csv", parser=parse_file, metavar="PATH", help="Where the table goes, the picture beside it."),
]
Rest = Annotated[
    str | None, typer.Option("--at", help="Step or tolerance where no axis is one. [default: 1e-8, or the scene's]")
]
Axis = Annotated[
    list[str] | None,
    typer.Option(
        "--axis",
        metavar="NAME=LOW..HIGH:COUNT",
        help="One or two axes of the map: rtol, step, clearance, stiffness, viscosity, gains or any address; also"
        " NAME=A,B,C.",
    ),
]
Box = Annotated[
    int | None,
    typer.Option(
        "--box",
        parser=make_integer_parser(0),
        metavar="COUNT",
        help="All corners of the box of --range and so many Sobol points.",
    ),
]
Range = Annotated[list[str] | None, typer.Option("--range", metavar="NAME=LOW..HIGH", help="An edge of the box.")]
Folder = Annotated[
    Path | None,
    typer.Option(
        "--out", parser=parse_path, metavar="PATH", help="Folder of blocks, or the page. [default: NAME.study]"
    ),
]
StudyFile = Annotated[
    str,
    typer.Argument(
        metavar="FILE",
        help="A study: a YAML file (docs/studies.md), or the name of one that comes with"
        " gudgeon, chen_2022 …; or the word report, for a page.",
    ),
]
Finished = Annotated[str | None, typer.Argument(metavar="[FOLDER]", help="The finished study of that page.")]
Threads = Annotated[
    int | None,
    typer.Option(
        parser=make_integer_parser(1), metavar="COUNT", help="Threads of runs. [default: the cores there are]"
    ),
]
Workers = Annotated[
    int | None,
    typer.Option(
        parser=make_integer_parser(1),
        metavar="COUNT",
        help="Processes of their own libraries, in place of threads; then --threads are those of each. [default: none]",
    ),
]
Cluster = Annotated[
    str | None,
    typer.Option("--dask", metavar="ADDRESS", help="A cluster of dask.distributed, at the address of its scheduler."),
]
Restart = Annotated[bool, typer.Option("--restart", help="Begin anew, whatever the folder holds of a study.")]
Report = Annotated[
    bool, typer.Option("--report", help="A page a scene: orbits, contacts, energy, trust. Runs each again.")
]
Verify = Annotated[
    bool, typer.Option("--verify", help="Check contacts at 20,000 times, by positions alone. Runs each again.")
]
Starts = Annotated[
    int | None,
    typer.Option(
        "--starts", parser=make_integer_parser(1), metavar="COUNT", help="So many perturbed starts of each run."
    ),
]
StartSeed = Annotated[
    int | None,
    typer.Option("--seed", parser=make_integer_parser(0), metavar="COUNT", help="By which these starts are drawn."),
]
Runs = Annotated[
    bool, typer.Option("--runs", help="Only tell how many runs, blocks, bytes and seconds, by a few on trial.")
]
Until = Annotated[
    str | None, typer.Option("--t-end", help="Until when, in s or with a unit. [default: the scene's, or 1 s]")
]
Intervals = Annotated[
    int | None,
    typer.Option(parser=make_integer_parser(1), metavar="COUNT", help="Output intervals. [default: the scene's]"),
]
Watch = Annotated[
    list[str] | None,
    typer.Option("--watch", "-w", metavar="NAME", help="What to compare with the ideal scene: S9.y, L1.head.x."),
]
Foreign = Annotated[
    Path, typer.Argument(parser=parse_file, metavar="FILE", help="JSON of pylinkage, or a text with a link of PMKS+.")
]
Mechanism = Annotated[
    Path | None, typer.Option("--out", "-o", parser=parse_file, metavar="PATH", help="Where to; else NAME.yaml.")
]

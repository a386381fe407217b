"""Declare command-line options and arguments of the commands, for the library typer, and their parsers."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from gudgeon.commands import completion
from gudgeon.language.text_output import escape_invisible


def make_integer_parser(min_value: int) -> Callable[[str], int]:
    """Return a parser of option texts for whole numbers of at least `min_value` and at most 18 digits.

    It raises typer.BadParameter for other texts, also for underscores and digits of other scripts.
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
    """Convert the text of an option to the path of a file.

    Raises typer.BadParameter for an empty text and for one that ends with a slash.
    """
    if str(text).endswith("/"):
        raise typer.BadParameter(f"{escape_invisible(str(text))!r}: this is a folder, expected a file")
    return parse_path(text)


def parse_file_or_folder(text: str) -> Path:
    """Convert the text of an option to a path of a file or folder.

    Raises typer.BadParameter for an empty text, and for "x.tex/" unless that is an existing folder.
    """
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


Version = Annotated[bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")]
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
OneScene = Annotated[str, typer.Option("--scene", "-s", help="The scene.", autocompletion=completion.complete_scenes)]
Pages = Annotated[
    Path,
    typer.Option(
        "--out",
        "-o",
        parser=parse_file_or_folder,
        metavar="PATH",
        help="x.tex, .txt, .html or .ipynb; a folder: a page for each scene; - prints.",
    ),
]
ScenesOfPages = Annotated[
    list[str] | None,
    typer.Option(
        "--scene",
        "-s",
        help="A scene; several for a folder. [default: ideal; for a folder all]",
        autocompletion=completion.complete_scenes,
    ),
]
Branches = Annotated[bool, typer.Option("--branches", help="Assembly branches, and the guess that selects each.")]
Json = Annotated[bool, typer.Option("--json", help="Print only JSON, in SI units.")]
FilesJson = Annotated[bool, typer.Option("--json", help="Print JSON: written files and notes.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but warnings and errors.")]
Out = Annotated[Path, typer.Option("--out", parser=parse_path, metavar="PATH", help="Folder for the written files.")]
At = Annotated[
    str | None, typer.Option("--at", metavar="TIME", help="Simulate to this time: 0.2s. [default: the start]")
]
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
    typer.Option("--laws", metavar="FILE.py", help="A user-defined force law: the file is run as Python; repeatable."),
]
Plot = Annotated[
    Path | None,
    typer.Option(
        "--plot", parser=parse_file, metavar="PATH", help="Plot the law: x.svg, .png or .pdf; values by --set mu=0.2."
    ),
]
LawName = Annotated[
    str | None,
    typer.Argument(
        metavar="[NAME]", help="Name or alternative name of a law.", autocompletion=completion.complete_laws
    ),
]
# of new and exercise
Name = Annotated[str, typer.Argument(metavar="NAME", help="Name of the mechanism or study; the file is NAME.yaml.")]
Like = Annotated[
    str | None,
    typer.Option("--like", metavar="NAME", help="A shipped mechanism: four_bar, jansen_leg …"),
]
OfStudy = Annotated[bool, typer.Option("--study", help="A study file instead of a mechanism file.")]
Sheet = Annotated[
    Path, typer.Option("--out", "-o", parser=parse_file, metavar="PATH", help="x.html, .tex, .txt or .md.")
]
Seed = Annotated[
    int,
    typer.Option("--seed", parser=make_integer_parser(0), metavar="COUNT", help="Seed of the random parameter values."),
]
Moment = Annotated[
    str | None,
    typer.Option("--at", metavar="TIME", help="Time of the requested positions and forces. [default: drawn]"),
]
# of studies
Peaks = Annotated[
    list[str] | None,
    typer.Option("--peaks", metavar="NAME", help="Largest and smallest value over all steps: S9.ay; repeatable."),
]
Quick = Annotated[bool, typer.Option("--quick", help="Fewer runs and a shorter window: seconds, not minutes.")]
Mark = Annotated[
    str | None, typer.Option("--mark-step", metavar="STEP", help="Mark and report the results of this step: 0.1ms.")
]
Set = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="ADDRESS=VALUE", help="Override a parameter: c=0.5mm, bodies.L2.mass='0.3 kg'."),
]
End = Annotated[str | None, typer.Option("--t-end", help="Length of the measured runs, in s or with a unit.")]
Csv = Annotated[
    Path | None,
    typer.Option("--csv", parser=parse_file, metavar="PATH", help="File of the table; the figure has the same name."),
]
Rest = Annotated[
    str | None, typer.Option("--at", help="Step or tolerance if no axis is one. [default: 1e-8, or the scene's]")
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
        help="Number of Sobol points in the box of --range; its corners are added.",
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
        help="A study: a YAML file (docs/studies.md), or the name of a shipped study,"
        " chen_2022 …; or the word report, for a page.",
    ),
]
Finished = Annotated[str | None, typer.Argument(metavar="[FOLDER]", help="The finished study, after the word report.")]
Threads = Annotated[
    int | None,
    typer.Option(
        parser=make_integer_parser(1), metavar="COUNT", help="Threads that run simulations. [default: all cores]"
    ),
]
Workers = Annotated[
    int | None,
    typer.Option(
        parser=make_integer_parser(1),
        metavar="COUNT",
        help="Worker processes instead of threads; --threads then applies to each process. [default: none]",
    ),
]
Cluster = Annotated[
    str | None,
    typer.Option("--dask", metavar="ADDRESS", help="A cluster of dask.distributed, at the address of its scheduler."),
]
Restart = Annotated[bool, typer.Option("--restart", help="Start again and discard the study in the folder.")]
Report = Annotated[
    bool, typer.Option("--report", help="A page for each scene: orbits, contacts, energy, accuracy. Runs each again.")
]
Verify = Annotated[
    bool, typer.Option("--verify", help="Check contacts at 20,000 times from positions only. Runs each again.")
]
Starts = Annotated[
    int | None,
    typer.Option(
        "--starts", parser=make_integer_parser(1), metavar="COUNT", help="Number of perturbed starts of each run."
    ),
]
StartSeed = Annotated[
    int | None,
    typer.Option("--seed", parser=make_integer_parser(0), metavar="COUNT", help="Random seed of these starts."),
]
Runs = Annotated[
    bool, typer.Option("--runs", help="Only estimate runs, blocks, bytes and seconds from a few trial runs.")
]
Until = Annotated[
    str | None, typer.Option("--t-end", help="End of the run, in s or with a unit. [default: the scene's, or 1 s]")
]
Intervals = Annotated[
    int | None,
    typer.Option(parser=make_integer_parser(1), metavar="COUNT", help="Output intervals. [default: the scene's]"),
]
Watch = Annotated[
    list[str] | None,
    typer.Option("--watch", "-w", metavar="NAME", help="Series to compare with the ideal scene: S9.y, L1.head.x."),
]
Foreign = Annotated[
    Path, typer.Argument(parser=parse_file, metavar="FILE", help="JSON of pylinkage, or a text with a link of PMKS+.")
]
Mechanism = Annotated[
    Path | None,
    typer.Option("--out", "-o", parser=parse_file, metavar="PATH", help="The mechanism file. [default: NAME.yaml]"),
]

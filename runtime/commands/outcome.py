"""Report the outcome of a command: an error as a line and an exit code, written files as lines or as JSON."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext, redirect_stdout
from dataclasses import dataclass, field
from functools import wraps
from pathlib import Path
from typing import Any, TypeVar

import typer

from gudgeon.errors import GudgeonError, MemoryShortage
from gudgeon.language.text_output import escape_invisible, format_path, print_json
from gudgeon.waiting.ctrl_c import INTERRUPTED, print_interrupted

Command = TypeVar("Command", bound=Callable[..., Any])


def print_error(error: GudgeonError) -> None:
    """Print `error: …` to stderr; in red on a terminal with colours, unless NO_COLOR is set (no-color.org)."""
    is_plain = os.environ.get("NO_COLOR") or os.environ.get("TERM", "").lower() in ("dumb", "unknown")
    red, plain = ("\033[31m", "\033[0m") if sys.stderr.isatty() and not is_plain else ("", "")
    print(f"{red}error:{plain} {escape_invisible(error)}", file=sys.stderr)


def report_errors(command: Command) -> Command:
    """Decorate a command: print gudgeon's errors, MemoryError and Ctrl-C as one line and exit with their codes.

    Other exceptions keep their traceback. The decorated command has further keyword arguments. `laws`: files of
    user-defined laws that are registered first. `files_as_json`: print the written files as JSON. `quiet`: print only
    warnings and errors.
    """

    @wraps(command)
    def wrapper(*args: Any, **kwargs: Any) -> None:
        """Run the command, without the keywords `laws`, `quiet` and `files_as_json`, and exit with its code.

        Files in `laws` are registered first. GudgeonError, MemoryError and Ctrl-C become a message and an exit code.
        Raises typer.Exit with any exit code other than 0.
        """
        listed = report_as_json(kwargs.pop("files_as_json", False))
        silence = suppress_output(keep_stdout=bool(kwargs.get("json"))) if kwargs.pop("quiet", False) else nullcontext()
        try:
            _register_law_files(kwargs.pop("laws", None) or ())
            with listed, silence:
                code = command(*args, **kwargs)
        except (GudgeonError, MemoryError) as error:
            print_error(known_error := error if isinstance(error, GudgeonError) else MemoryShortage(error))
            code = known_error.exit_code
        except KeyboardInterrupt:
            print_interrupted()
            code = INTERRUPTED
        if code:
            raise typer.Exit(code)

    return wrapper  # type: ignore[return-value]


@contextmanager
def suppress_output(keep_stdout: bool) -> Iterator[None]:
    """Suppress progress on stderr and, unless `keep_stdout`, results on stdout within the with block.

    Warnings and errors on stderr are still printed.
    """
    from gudgeon.commands import progress

    is_terminal, progress.is_terminal = progress.is_terminal, lambda: False
    try:
        with (
            open(os.devnull, "w", encoding="utf-8") as nothing,
            nullcontext() if keep_stdout else redirect_stdout(nothing),
        ):
            yield
    finally:
        progress.is_terminal = is_terminal


def _register_law_files(laws: Iterable[str]) -> None:
    """Register the user-defined laws in these files; their reader is imported only if there are some."""
    for file in laws:
        from gudgeon.generator.kinds.laws.registered import register

        register(file)


def print_warnings_once() -> None:
    """Replace Python's display of warnings: each text is printed once to stderr, without a line of source."""
    seen = set[str]()

    def print_once(message: Warning | str, *_: Any, **__: Any) -> None:
        """Print a warning that was not printed before."""
        if str(message) not in seen:
            seen.add(str(message))
            print(f"warning: {escape_invisible(message)}", file=sys.stderr)

    warnings.showwarning = print_once
    warnings.filterwarnings("default", ".* is deprecated since gudgeon", DeprecationWarning)


@dataclass
class Document:
    """Hold what a command reports as JSON: paths of files by kind, notes, and texts printed instead of written."""

    files: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    texts: dict[str, str] = field(default_factory=dict)


_document: Document | None = None  # of the running command, if JSON is requested


def report_written_file(kind: str, path: Path, suffix: str = "") -> None:
    """Print that a file or folder was written, or add it to the JSON document; kind: its key; suffix: text
    after its name.
    """
    if _document is None:
        print(f"wrote {format_path(path)}{suffix}")
    else:
        _document.files[kind] = str(path)
        _document.notes += [suffix.removeprefix(": ")] if suffix else []


def report_note(text: str) -> None:
    """Print a further fact in one line, or add it to the notes of the JSON document."""
    if _document is None:
        print(text)
    else:
        _document.notes.append(text)


def report_text(kind: str, text: str) -> None:
    """Print a text that would be written to a file if the target were not "-", or add it to the JSON document as
    `kind`.
    """
    if _document is None:
        print(text)
    else:
        _document.texts[kind] = text


@contextmanager
def report_as_json(is_requested: bool) -> Iterator[None]:
    """Collect the files, notes and texts that the with block reports, and print them at its end as JSON, also after an
    error.

    Nothing is changed unless `is_requested`; an empty document is not printed.
    """
    global _document
    if not is_requested:
        yield
        return
    _document = document = Document()
    try:
        yield
    finally:
        _document = None
        if document.files or document.notes or document.texts:
            print_json({"files": document.files, "notes": document.notes, **document.texts})

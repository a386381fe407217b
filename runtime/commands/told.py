"""How a command ends: what it raises is a line and an exit code; what it wrote a line for each file, or JSON."""

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
from gudgeon.language.shown import path_text, print_json, visible
from gudgeon.waiting.ctrl_c import INTERRUPTED, last_word

Command = TypeVar("Command", bound=Callable[..., Any])


def complain(error: GudgeonError) -> None:
    """Write `error: …` to stderr, in red on a terminal that has it, if NO_COLOR is not set (no-color.org)."""
    is_plain = os.environ.get("NO_COLOR") or os.environ.get("TERM", "").lower() in ("dumb", "unknown")
    red, plain = ("\033[31m", "\033[0m") if sys.stderr.isatty() and not is_plain else ("", "")
    print(f"{red}error:{plain} {visible(error)}", file=sys.stderr)


def told(command: Command) -> Command:
    """Our own errors are told in a line, without a traceback; others are bugs and keep theirs.

    `laws` of a command are known before it begins, `files_as_json` has it list what it wrote; of one that is `quiet`
    nothing is printed but warnings and errors.
    """

    @wraps(command)
    def wrapper(*args: Any, **kwargs: Any) -> None:
        listed = told_as_json(kwargs.pop("files_as_json", False))
        silence = silent(but_json=bool(kwargs.get("json"))) if kwargs.pop("quiet", False) else nullcontext()
        try:
            _know(kwargs.pop("laws", None) or ())
            with listed, silence:
                code = command(*args, **kwargs)
        except (GudgeonError, MemoryError) as error:
            complain(known := error if isinstance(error, GudgeonError) else MemoryShortage(error))
            code = known.exit_code
        except KeyboardInterrupt:
            last_word()
            code = INTERRUPTED
        if code:
            raise typer.Exit(code)

    return wrapper  # type: ignore[return-value]


@contextmanager
def silent(but_json: bool) -> Iterator[None]:
    """No result on stdout, but JSON where that is asked for, and nothing on stderr of what is under way."""
    from gudgeon.commands import progress

    looked_at, progress.looked_at = progress.looked_at, lambda: False
    try:
        with (
            open(os.devnull, "w", encoding="utf-8") as nothing,
            nullcontext() if but_json else redirect_stdout(nothing),
        ):
            yield
    finally:
        progress.looked_at = looked_at


def _know(laws: Iterable[str]) -> None:
    """Laws of the user's own; a mechanism that needs none does not wait for what reads them."""
    for file in laws:
        from gudgeon.generator.kinds.laws.registered import register

        register(file)


def tell_warnings() -> None:
    """Warnings are told once each, without a line of our code."""
    seen = set[str]()

    def tell(message: Warning | str, *_: Any, **__: Any) -> None:
        if str(message) not in seen:
            seen.add(str(message))
            print(f"warning: {visible(message)}", file=sys.stderr)

    warnings.showwarning = tell


@dataclass
class Document:
    """What JSON tells: names of files (and folders) by what they are, notes, and what has no file but was asked for."""

    files: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    texts: dict[str, str] = field(default_factory=dict)


_document: Document | None = None  # of the command that is under way, where JSON is asked for


def wrote(kind: str, path: Path, more: str = "") -> None:
    """Tell that a file (a folder) was written; `kind` is what it is, `more` stands behind its name in a line."""
    if _document is None:
        print(f"wrote {path_text(path)}{more}")
    else:
        _document.files[kind] = str(path)
        _document.notes += [more.removeprefix(": ")] if more else []


def note(text: str) -> None:
    """Tell what else there is to know, in a line."""
    if _document is None:
        print(text)
    else:
        _document.notes.append(text)


def show(kind: str, text: str) -> None:
    """What would have been written, where `-` was named: on the terminal as it is, in JSON under its kind."""
    if _document is None:
        print(text)
    else:
        _document.texts[kind] = text


@contextmanager
def told_as_json(wanted: bool) -> Iterator[None]:
    """What is told within is printed at the end, as JSON where that is wanted: what was written before an error too."""
    global _document
    if not wanted:
        yield
        return
    _document = told = Document()
    try:
        yield
    finally:
        _document = None
        if told.files or told.notes or told.texts:
            print_json({"files": told.files, "notes": told.notes, **told.texts})

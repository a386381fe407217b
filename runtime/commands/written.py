"""What a command that writes files tells: a line for each file, or all of it as one JSON document."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from gudgeon.language.shown import path_text, print_json


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

"""Lists the mechanism file and the C of a scene in a page, with highlighting tokens for each line."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from gudgeon.generator.equations.model import Model
from gudgeon.generator.targets.javascript.compression import compress_script
from gudgeon.generator.targets.javascript.module import print_equations_script
from gudgeon.generator.targets.latex.document import Block, EmbeddedHtml, Listing, Section, make_paragraph
from gudgeon.generator.targets.latex.trace import HighlightIndex, list_yaml_tokens

LISTED_C_FILES = ("parameters.c", "constraints.c", "clearance.c", "dynamics.c", "reduced.c", "positions.c")
MAX_C_CHARACTERS = 600_000  # of C in a page
MAX_FILE_BYTES = 1_000_000  # of a mechanism's file
_DATA_ID = "gudgeon-c"  # id of the element with compressed data


def make_listing_sections(model: Model, highlights: HighlightIndex) -> list[Section]:
    """Return the section with the listings of the mechanism's file and of its C, in a list.

    The listing of the file is left out if the file cannot be read or has changed (`_read_mechanism_file`).
    """
    blocks: list[Block] = []
    hint = make_paragraph("Select an equation, entry, line or part: everything related to it is highlighted.")
    if (text := _read_mechanism_file(model)) is not None:
        name = Path(model.scene.mechanism.file).name
        blocks.append(Listing(name, tuple(text.splitlines()), list_yaml_tokens(model, highlights)))
    return [Section("From the file to the C", (hint, *blocks, EmbeddedHtml(_print_c_listing(highlights))))]


def _read_mechanism_file(model: Model) -> str | None:
    """Return the text of the mechanism's file, with replacement characters for invalid UTF-8.

    None is returned if the file is missing, unreadable, larger than MAX_FILE_BYTES, or has another SHA-256 than the
    mechanism.
    """
    mechanism = model.scene.mechanism
    file = Path(mechanism.file)
    try:
        if not file.is_file() or file.stat().st_size > MAX_FILE_BYTES:
            return None
        data = file.read_bytes()
    except (OSError, ValueError):
        return None
    return data.decode("utf-8", "replace") if hashlib.sha256(data).hexdigest() == mechanism.sha256 else None


def _print_c_listing(highlights: HighlightIndex) -> str:
    """Return the HTML of the C listing: JSON, compressed by gzip, in a script element that highlighting.js unpacks.

    LISTED_C_FILES are included in this order, except files with which the total would exceed MAX_C_CHARACTERS. Files
    that are not included are named in a note.
    """
    texts, remaining_size = dict[str, str](), MAX_C_CHARACTERS
    for name in LISTED_C_FILES:
        text = highlights.source.files.get(name)
        if text is None or len(text) > remaining_size:
            continue
        remaining_size -= len(text)
        texts[name] = text
    data = json.dumps(
        {
            "of": {
                name: _list_line_texts(
                    text, {k: " ".join(sorted(marks)) for k, marks in highlights.lines.get(name, {}).items()}
                )
                for name, text in texts.items()
            },
            "values": {
                name: _list_line_texts(text, _shorten_value_names(text, highlights.values.get(name, {})))
                for name, text in texts.items()
            },
            "texts": texts,
            "equations": _print_equations_script(highlights),
        },
        ensure_ascii=False,
        separators=(",", ":"),
    )
    compressed = base64.b64encode(gzip.compress(data.encode(), 9, mtime=0)).decode("ascii")
    unlisted_files = sorted(
        name for name in highlights.source.files if name.endswith((".c", ".h")) and name not in texts
    )
    note = f" Not listed here: {', '.join(unlisted_files)}." if unlisted_files else ""
    return (
        f"<p>The emitted C. The foot of the page shows the lines that compute the selection.{note}</p>\n"
        "<noscript><p><code>gudgeon emit</code> writes these files.</p>"
        f'</noscript>\n<div id="{_DATA_ID}-files"></div>\n'
        f'<script type="text/plain" id="{_DATA_ID}">{compressed}</script>'
    )


def _list_line_texts(text: str, text_by_line: Mapping[int, str]) -> list[str]:
    """Return a list with an item for each line of `text`: its entry in `text_by_line`, or "".

    text_by_line: {line number from 1: text}. As JSON the list is smaller than the mapping.
    """
    return [text_by_line.get(k, "") for k in range(1, text.count("\n") + 2)]


def _shorten_value_names(text: str, values: Mapping[int, str]) -> dict[int, str]:
    """Return {line: name of its value}, without the last part of a name if the line of `text` assigns to that name.

    Example: "rhs.F_x" for the line "F_x = …" becomes "rhs.". values: {line number from 1: full name}. highlighting.js
    completes the names.
    """
    lines, shortened = text.split("\n"), dict[int, str]()
    for line_number, value in values.items():
        left_side = lines[line_number - 1].partition(" = ")[0].removesuffix(" +").split()
        name = left_side[-1].replace("->", ".").removeprefix("*") if left_side else ""
        shortened[line_number] = value.removesuffix(name) if value.endswith(f".{name}") else value
    return shortened


@cache
def _load_script(name: str) -> str:
    """Return a JavaScript file of this folder, minified for embedding; results are cached."""
    return compress_script(Path(__file__).with_name(name).read_text(encoding="utf-8"))


def _print_equations_script(highlights: HighlightIndex) -> str:
    """Return the JavaScript that computes the values of a page (javascript/module.py); "" for scenes with curves.

    Pages of scenes with curves show only the state.
    """
    try:
        return print_equations_script(highlights.program)
    except ValueError:
        return ""


def print_scripts() -> str:
    """Return the HTML element with the scripts of a page: cross-highlighting and current values."""
    return f'<script>\n"use strict";\n{_load_script("highlighting.js")}{_load_script("current_values.js")}</script>\n'

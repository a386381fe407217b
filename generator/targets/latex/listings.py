"""Lists the mechanism file and the C of a scene in a page, line by line with tokens."""

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

SHOWN = ("parameters.c", "constraints.c", "clearance.c", "dynamics.c", "reduced.c", "positions.c")
MOST_C = 600_000  # characters of C in a page
LARGEST_FILE = 1_000_000  # bytes of a mechanism's file
_CARRIED = "gudgeon-c"  # id of the element with compressed data


def make_listing_sections(model: Model, highlights: HighlightIndex) -> list[Section]:
    """Return the section with the listing of the mechanism's file and that of its C.

    The file is left out if it is missing or has changed.
    """
    blocks: list[Block] = []
    hint = make_paragraph("Select an equation, entry, line or part: everything related to it is highlighted.")
    if (text := _read_mechanism_file(model)) is not None:
        name = Path(model.scene.mechanism.file).name
        blocks.append(Listing(name, tuple(text.splitlines()), list_yaml_tokens(model, highlights)))
    return [Section("From the file to the C", (hint, *blocks, EmbeddedHtml(_print_c_listing(highlights))))]


def _read_mechanism_file(model: Model) -> str | None:
    """Return the text of the mechanism's file.

    None if it is missing, too large, unreadable or changed since it was read.
    """
    mechanism = model.scene.mechanism
    file = Path(mechanism.file)
    try:
        if not file.is_file() or file.stat().st_size > LARGEST_FILE:
            return None
        data = file.read_bytes()
    except (OSError, ValueError):
        return None
    return data.decode("utf-8", "replace") if hashlib.sha256(data).hexdigest() == mechanism.sha256 else None


def _print_c_listing(highlights: HighlightIndex) -> str:
    """Return the HTML of the C listing, compressed in a script element that highlighting.js unfolds.

    The files in SHOWN are included while they fit into MOST_C characters; all others are only named.
    """
    texts, remaining_size = dict[str, str](), MOST_C
    for name in SHOWN:
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
    packed = base64.b64encode(gzip.compress(data.encode(), 9, mtime=0)).decode("ascii")
    unlisted_files = sorted(
        name for name in highlights.source.files if name.endswith((".c", ".h")) and name not in texts
    )
    note = f" Not listed here: {', '.join(unlisted_files)}." if unlisted_files else ""
    return (
        f"<p>The emitted C. The foot of the page shows the lines that compute the selection.{note}</p>\n"
        "<noscript><p><code>gudgeon emit</code> writes these files.</p>"
        f'</noscript>\n<div id="{_CARRIED}-files"></div>\n'
        f'<script type="text/plain" id="{_CARRIED}">{packed}</script>'
    )


def _list_line_texts(text: str, text_by_line: Mapping[int, str]) -> list[str]:
    """Return the entries of `text_by_line` as a list with an item for each line of `text`, "" for lines without one.

    text_by_line: {line number from 1: text}. As JSON the list is smaller than the mapping.
    """
    return [text_by_line.get(k, "") for k in range(1, text.count("\n") + 2)]


def _shorten_value_names(text: str, values: Mapping[int, str]) -> dict[int, str]:
    """Return {line: name of its value}; a name's last part is left out where the line of `text` itself shows it.

    values: {line number from 1: full name}. highlighting.js completes the names.
    """
    lines, shortened = text.split("\n"), dict[int, str]()
    for line_number, value in values.items():
        left_side = lines[line_number - 1].partition(" = ")[0].removesuffix(" +").split()
        name = left_side[-1].replace("->", ".").removeprefix("*") if left_side else ""
        shortened[line_number] = value.removesuffix(name) if value.endswith(f".{name}") else value
    return shortened


@cache
def _load_script(name: str) -> str:
    """Return a script of this folder, compressed for embedding; it is read once."""
    return compress_script(Path(__file__).with_name(name).read_text(encoding="utf-8"))


def _print_equations_script(highlights: HighlightIndex) -> str:
    """Return the script that computes values; "" for scenes with curves, whose pages show only their state."""
    try:
        return print_equations_script(highlights.program)
    except ValueError:
        return ""


def print_scripts() -> str:
    """Return the scripts of a page: cross-highlighting and values."""
    return f'<script>\n"use strict";\n{_load_script("highlighting.js")}{_load_script("current_values.js")}</script>\n'

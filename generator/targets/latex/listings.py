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
from gudgeon.generator.targets.javascript.module import embedded_script, equations_script
from gudgeon.generator.targets.latex.document import Block, EmbeddedHtml, Listing, Section, paragraph
from gudgeon.generator.targets.latex.trace import Trace, yaml_tokens

SHOWN = ("parameters.c", "constraints.c", "clearance.c", "dynamics.c", "reduced.c", "positions.c")
MOST_C = 600_000  # characters of C that a page carries
LARGEST_FILE = 1_000_000  # bytes of a mechanism's file
_CARRIED = "gudgeon-c"  # id of what is not shown


def listing_sections(model: Model, found: Trace) -> list[Section]:
    """Return the sections with the mechanism's file, if it is unchanged, and the C."""
    blocks: list[Block] = []
    message = paragraph("Select any equation, entry, line or part: everything that has to do with it is lit.")
    if (text := _own_text(model)) is not None:
        name = Path(model.scene.mechanism.file).name
        blocks.append(Listing(name, tuple(text.splitlines()), yaml_tokens(model, found)))
    return [Section("From the file to the C", (message, *blocks, EmbeddedHtml(_c(found))))]


def _own_text(model: Model) -> str | None:
    """Return the text of the mechanism's file; None if it is missing or has changed."""
    mechanism = model.scene.mechanism
    file = Path(mechanism.file)
    try:
        if not file.is_file() or file.stat().st_size > LARGEST_FILE:
            return None
        data = file.read_bytes()
    except (OSError, ValueError):
        return None
    return data.decode("utf-8", "replace") if hashlib.sha256(data).hexdigest() == mechanism.sha256 else None


def _c(found: Trace) -> str:
    """Return the listing of the C, packed; light.js unfolds it."""
    texts, left = dict[str, str](), MOST_C
    for name in SHOWN:
        text = found.source.files.get(name)
        if text is None or len(text) > left:
            continue
        left -= len(text)
        texts[name] = text
    message = json.dumps(
        {
            "of": {
                name: _by_line(text, {k: " ".join(sorted(own)) for k, own in found.lines.get(name, {}).items()})
                for name, text in texts.items()
            },
            "values": {
                name: _by_line(text, _shorter(text, found.values.get(name, {}))) for name, text in texts.items()
            },
            "texts": texts,
            "equations": _equations(found),
        },
        ensure_ascii=False,
        separators=(",", ":"),
    )
    packed = base64.b64encode(gzip.compress(message.encode(), 9, mtime=0)).decode("ascii")
    others = sorted(name for name in found.source.files if name.endswith((".c", ".h")) and name not in texts)
    rest = f" Not listed here: {', '.join(others)}." if others else ""
    return (
        f"<p>The emitted C; what of it computes what was selected is shown at the foot of the page.{rest}</p>\n"
        "<noscript><p>It is listed by the page's own script; <code>gudgeon emit</code> writes the same files.</p>"
        f'</noscript>\n<div id="{_CARRIED}-files"></div>\n'
        f'<script type="text/plain" id="{_CARRIED}">{packed}</script>'
    )


def _by_line(text: str, message: Mapping[int, str]) -> list[str]:
    """Return texts by line number as one text a line, which is smaller than line numbers."""
    return [message.get(k, "") for k in range(1, text.count("\n") + 2)]


def _shorter(text: str, values: Mapping[int, str]) -> dict[int, str]:
    """Return values without their last part where the line itself shows what it stores, as light.js reads it."""
    lines, found = text.split("\n"), dict[int, str]()
    for k, value in values.items():
        stored = lines[k - 1].partition(" = ")[0].removesuffix(" +").split()
        name = stored[-1].replace("->", ".").removeprefix("*") if stored else ""
        found[k] = value.removesuffix(name) if value.endswith(f".{name}") else value
    return found


@cache
def _script(name: str) -> str:
    """Return a script of this folder for embedding."""
    return embedded_script(Path(__file__).with_name(name).read_text(encoding="utf-8"))


def _equations(found: Trace) -> str:
    """Return the script that computes values; "" for scenes with curves, which show only their state."""
    try:
        return equations_script(found.program)
    except ValueError:
        return ""


def scripts() -> str:
    """Return the scripts of a page: cross-highlighting and values."""
    return f'<script>\n"use strict";\n{_script("light.js")}{_script("live.js")}</script>\n'

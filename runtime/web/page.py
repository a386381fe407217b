"""What a page carries to simulate a scene itself: the script, and beside it description and module."""

from __future__ import annotations

import base64
from functools import cache
from pathlib import Path

from gudgeon.model.compiled import CompiledModel
from gudgeon.web.description import description
from gudgeon.web.module import simulator

FILES = ("run.js", "loops.js", "simulator.js")
DESCRIPTION, MODULE = "gudgeon-description", "gudgeon-module"  # ids of what is not shown


@cache
def script() -> str:
    """JavaScript that declares `gudgeon` with `gudgeon.load`: for a page's <script>, or a file that Node requires."""
    texts = [Path(__file__).with_name(name).read_text(encoding="utf-8") for name in FILES]
    return "\n".join((
        "const gudgeon = (() => {", '"use strict";', *texts, "return {load, Simulator, Run};", "})();",
        'if (typeof module !== "undefined") module.exports = gudgeon;', "",
    ))  # fmt: skip


def carried(compiled: CompiledModel) -> str:
    """HTML of all three, for a page that is one file: `gudgeon.load` of the texts of both elements.

    Raises BuildError where the compiler for pages is not installed.
    """
    module = base64.b64encode(simulator(compiled.source)).decode("ascii")
    told = description(compiled).replace("<", "\\u003c")  # no text of a file ends the element
    return (
        f"<script>\n{script()}</script>\n"
        f'<script type="application/json" id="{DESCRIPTION}">{told}</script>\n'
        f'<script type="text/plain" id="{MODULE}">{module}</script>\n'
    )

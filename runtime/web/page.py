"""What a page carries to simulate a scene itself: the script, and beside it description and module."""

from __future__ import annotations

from functools import cache
from pathlib import Path

FILES = ("run.js", "loops.js", "simulator.js")


@cache
def script() -> str:
    """JavaScript that declares `gudgeon`, with `gudgeon.load`: for a <script> of a page, or a file that Node requires."""
    texts = [Path(__file__).with_name(name).read_text(encoding="utf-8") for name in FILES]
    return "\n".join((
        "const gudgeon = (() => {", '"use strict";', *texts, "return {load, Simulator, Run};", "})();",
        'if (typeof module !== "undefined") module.exports = gudgeon;', "",
    ))  # fmt: skip

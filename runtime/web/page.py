"""Write the page of a scene: its equations and the simulator in one self-contained HTML file."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.deprecations import CARRIED, warn_deprecated
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.file_expressions import list_possibly_undefined_expressions
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.description import build_description
from gudgeon.web.module import compile_simulator

UNDEFINED_PARTS = "undefined_parts.js"
SIMULATOR_FILES = ("boundary.js", "run.js", UNDEFINED_PARTS, "time_loops.js", "start.js", "simulator.js")
DESCRIPTION_ID, MODULE_ID = "gudgeon-description", "gudgeon-module"  # ids of hidden elements


class Parts(NamedTuple):
    """HTML for the three slots of the equations' page: in its head, below its title, at its end."""

    head: str
    app: str
    scripts: str


def build_page(simulation: Simulation, scenes: Mapping[str, str] | None = None) -> str:
    """Return the HTML of a scene's page: equations, drawing, simulator.

    scenes: file names of the pages of all scenes by name, to which it links with its parameter values. Raises
    InputError if the file was edited since, GudgeonError without the extras `docs` and `plot`, BuildError if the C does
    not compile, SolverError if no start is found.
    """
    from gudgeon.generator.targets.latex import render_equations_html

    return render_equations_html(
        simulation.model, **build_page_parts(simulation, scenes)._asdict(), source=simulation.source
    )


def build_page_parts(simulation: Simulation, scenes: Mapping[str, str] | None = None) -> Parts:
    """Return the HTML parts that make the equations' page of a scene interactive.

    Without the compiler (extra `web`) they contain one recorded run at the file's values instead of a simulator. If the
    module of the simulator has at most MAX_MODULE_BYTES bytes, the parts also contain the full formulation, in which
    constraints drift. Raises GudgeonError without matplotlib. Other arguments and errors are those of `build_page`.
    """
    import gudgeon.results.figures.plots  # noqa: F401 (raises GudgeonError without matplotlib)
    from gudgeon.web.page_parts import build_simulator_parts

    return build_simulator_parts(simulation, scenes or {})


def build_script(source: KernelSource) -> str:
    """Return JavaScript that declares `gudgeon` with `gudgeon.load`, for a page's <script> or a file for Node.

    The check for undefined expressions is included if the scene needs it.
    """
    sources = [
        read_script(name)
        for name in SIMULATOR_FILES
        if name != UNDEFINED_PARTS or list_possibly_undefined_expressions(source)
    ]
    return "\n".join(
        (
            "const gudgeon = (() => {",
            '"use strict";',
            *sources,
            "return {load, unpack, Simulator, Run};",
            "})();",
            'if (typeof module !== "undefined") module.exports = gudgeon;',
            "",
        )
    )


def embed_scene(compiled: CompiledModel) -> str:
    """Return HTML of simulator, description and module for a user's page; `gudgeon.load` takes both elements' texts.

    Raises BuildError if the compiler for pages is not installed.
    """
    module = pack_module(compiled)
    return (
        f"<script>\n{build_script(compiled.source)}</script>\n"
        f"{build_json_element(DESCRIPTION_ID, build_description(compiled))}{module}"
    )


def carried(compiled: CompiledModel) -> str:
    """Return `embed_scene(compiled)`. Deprecated, see the changes."""
    warn_deprecated(CARRIED)
    return embed_scene(compiled)


def pack_module(compiled: CompiledModel, suffix: str = "") -> str:
    """Return the WebAssembly module of a scene as a hidden HTML element (gzip, base64); `suffix` ends its id."""
    return pack_element(f"{MODULE_ID}{suffix}", compile_simulator(compiled.source))


def pack_element(name: str, data: bytes) -> str:
    """Return bytes as a hidden HTML element with the id `name` (gzip, base64), which `gudgeon.unpack` reads."""
    encoded = base64.b64encode(gzip.compress(data, 9, mtime=0)).decode("ascii")
    return f'<script type="text/plain" id="{name}">{encoded}</script>\n'


def build_json_element(name: str, json_text: str) -> str:
    """Return a JSON text as a hidden HTML element with the id `name`; a text in it cannot end the element."""
    escaped = json_text.replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{escaped}</script>\n'


@cache
def read_script(name: str) -> str:
    """Return a JavaScript file of this folder, compressed for pages; cached."""
    from gudgeon.generator.targets.javascript.compression import compress_script

    return compress_script(read_file(name))


def read_file(name: str) -> str:
    """Return the text of a file of this folder."""
    return Path(__file__).with_name(name).read_text(encoding="utf-8")

"""A scene's page: its equations, and above them what runs, in one file that needs nothing else."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.written import partials
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.description import description
from gudgeon.web.module import simulator

UNDEFINED = "undefined.js"
FILES = ("boundary.js", "run.js", UNDEFINED, "loops.js", "start.js", "simulator.js")
DESCRIPTION, MODULE = "gudgeon-description", "gudgeon-module"  # ids of what is not shown


class Parts(NamedTuple):
    """HTML for the three slots of the equations' page: in its head, below its title, at its end."""

    head: str
    app: str
    scripts: str


def write(simulation: Simulation, scenes: Mapping[str, str] | None = None) -> str:
    """The page of a scene, HTML: its equations and all that runs. `scenes`: pages beside it by scene, itself among
    them; it leads to them with the numbers that it has.

    Raises InputError where the file was edited since, GudgeonError without the extras `docs` and `plot`, BuildError
    where the C does not compile, SolverError where not even a start is found.
    """
    from gudgeon.generator.targets.latex import equations_html

    return equations_html(simulation.model, **parts(simulation, scenes)._asdict(), source=simulation.source)


def parts(simulation: Simulation, scenes: Mapping[str, str] | None = None) -> Parts:
    """What a page runs. Without the compiler for pages (the extra `web`) it is one run of the file's numbers.

    A small simulator has that of the full formulation beside it, in which constraints drift. Raises as `write`.
    """
    import gudgeon.results.figures.plots  # noqa: F401 (without matplotlib it says what to install)
    from gudgeon.web.running import running_parts

    return running_parts(simulation, scenes or {})


def script(source: KernelSource) -> str:
    """JavaScript that declares `gudgeon` with `gudgeon.load`: for a page's <script>, or a file that Node requires.

    Whether expressions are defined is checked in scenes with expressions that may not be.
    """
    texts = [code(name) for name in FILES if name != UNDEFINED or partials(source)]
    return "\n".join(
        (
            "const gudgeon = (() => {",
            '"use strict";',
            *texts,
            "return {load, unpacked, Simulator, Run};",
            "})();",
            'if (typeof module !== "undefined") module.exports = gudgeon;',
            "",
        )
    )


def carried(compiled: CompiledModel) -> str:
    """HTML of simulator, description and module, for a page of your own: `gudgeon.load` of both elements' texts.

    Raises BuildError where the compiler for pages is not installed.
    """
    module = packed_module(compiled)
    return f"<script>\n{script(compiled.source)}</script>\n{element(DESCRIPTION, description(compiled))}{module}"


def packed_module(compiled: CompiledModel, which: str = "") -> str:
    """The module of a scene as an element that is not shown: gzip, base64."""
    return packed_element(f"{MODULE}{which}", simulator(compiled.source))


def packed_element(name: str, data: bytes) -> str:
    """Bytes that are not shown, for `gudgeon.unpacked`."""
    packed = base64.b64encode(gzip.compress(data, 9, mtime=0)).decode("ascii")
    return f'<script type="text/plain" id="{name}">{packed}</script>\n'


def element(name: str, told: str) -> str:
    """JSON that is not shown; no text of a file ends the element."""
    safe = told.replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{safe}</script>\n'


@cache
def code(name: str) -> str:
    """JavaScript of this room, as a page carries it."""
    from gudgeon.generator.targets.javascript.module import carried_script

    return carried_script(file_text(name))


def file_text(name: str) -> str:
    """A file of this room."""
    return Path(__file__).with_name(name).read_text(encoding="utf-8")

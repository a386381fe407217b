"""A scene's page: its equations, and above them what runs, in one file that needs nothing else."""

from __future__ import annotations

import base64
import gzip
import json
from dataclasses import replace
from functools import cache
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

from gudgeon.contract.methods import KINEMATIC
from gudgeon.drawing.page import PIXELS
from gudgeon.drawing.picture import size_of
from gudgeon.drawing.rig import Rig
from gudgeon.errors import BuildError, SolverError
from gudgeon.language.shown import one_line
from gudgeon.model.compiled import CompiledModel
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.description import description
from gudgeon.web.look import look, style
from gudgeon.web.module import simulator
from gudgeon.web.panel import NARROW, WIDE, looks_of, panel, recorded, rig_of

FILES = ("run.js", "loops.js", "simulator.js")
APP = ("drawing.js", "chart.js", "controls.js", "app.js", "carried.js")
DESCRIPTION, MODULE, PANEL = "gudgeon-description", "gudgeon-module", "gudgeon-panel"  # ids of what is not shown
ROOM = 62_000  # bytes of a module beside which there is room for the full formulation: constraints that drift
NO_SIMULATOR = (
    "This page carries one run, with the numbers of the file: it was written without the compiler for pages"
    " (pip install 'gudgeon[web]'), with which its numbers can be moved."
)


class Parts(NamedTuple):
    """HTML for the three slots of the equations' page: in its head, below its title, at its end."""

    head: str
    app: str
    scripts: str


def write(simulation: Simulation) -> str:
    """The page of a scene: equations and all that runs.

    Raises InputError where the file was edited since, GudgeonError without the extras `docs` and `plot`.
    """
    from gudgeon.generator.targets.latex import equations_html

    return equations_html(simulation.model, **parts(simulation)._asdict())


def parts(simulation: Simulation) -> Parts:
    """What a page runs; with one run in place of the simulator where the compiler for pages is not installed.

    Beside a small simulator it has that of the full formulation, in which constraints drift.
    """
    run = _run(simulation)
    rig = rig_of(run)
    told = panel(simulation, run, rig) | _scales(rig)
    try:
        module, note = _module(simulation.compiled), ""
    except BuildError:
        module, note = "", NO_SIMULATOR
        told["recorded"] = recorded(run, [*told["traces"], *told["values"]])
    title = one_line(simulation.source.title or simulation.source.mechanism)
    frame = _file("app.html").replace("@NOTE@", escape(note)).replace("@TITLE@", escape(title))
    shown = [_element(DESCRIPTION, description(simulation.compiled)), _element(PANEL, _json(told)), module]
    if 0 < len(module) < ROOM and simulation.source.methods != (KINEMATIC,) and simulation.full is not simulation:
        other = simulation.full.compiled
        shown += [_element(f"{DESCRIPTION}-full", description(other)), _module(other, "-full")]
    scripts = f"{''.join(shown)}<script>\n{script()}</script>\n<script>\n{app()}</script>"
    return Parts(f"<style>\n{style(*looks_of(rig))}</style>", frame, scripts)


def _run(simulation: Simulation) -> Result:
    """A plain run of the scene; up to where it fails, if it does."""
    try:
        return simulation.simulate()
    except SolverError as error:
        if error.partial is None or len(error.partial.t) < 2:
            raise
        return error.partial


def _scales(rig: Rig) -> dict[str, Any]:
    """Looks of the shapes, and how many pixels a metre has on a desk and on a phone."""
    pixels = []
    for inches in (WIDE, NARROW):
        size, sketch = size_of(rig.sketch, inches), replace(rig.sketch, labels=())
        pixels.append(PIXELS * min(a / b for a, b in zip(size, sketch.high - sketch.low, strict=True)))
    return {"looks": [look(one.shape.role, one.shape.tint) for one in rig.shapes], "pixels": pixels}


@cache
def script() -> str:
    """JavaScript that declares `gudgeon` with `gudgeon.load`: for a page's <script>, or a file that Node requires."""
    texts = [_file(name) for name in FILES]
    return "\n".join((
        "const gudgeon = (() => {", '"use strict";', *texts, "return {load, unpacked, Simulator, Run};", "})();",
        'if (typeof module !== "undefined") module.exports = gudgeon;', "",
    ))  # fmt: skip


@cache
def app() -> str:
    """JavaScript of what is seen, behind `script`."""
    return "\n".join(("(() => {", '"use strict";', *(_file(name) for name in APP), "})();", ""))


def carried(compiled: CompiledModel) -> str:
    """HTML of simulator, description and module, for a page of your own: `gudgeon.load` of both elements' texts.

    Raises BuildError where the compiler for pages is not installed.
    """
    module = _module(compiled)
    return f"<script>\n{script()}</script>\n{_element(DESCRIPTION, description(compiled))}{module}"


def _module(compiled: CompiledModel, which: str = "") -> str:
    packed = base64.b64encode(gzip.compress(simulator(compiled.source), 9, mtime=0)).decode("ascii")
    return f'<script type="text/plain" id="{MODULE}{which}">{packed}</script>\n'


def _element(name: str, told: str) -> str:
    """Text that is not shown; none of a file's ends the element."""
    safe = told.replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{safe}</script>\n'


def _json(told: dict[str, Any]) -> str:
    return json.dumps(told, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def _file(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")

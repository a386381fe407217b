"""Assemble the running part of a page in three strings: style, visible frame, scripts."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from html import escape
from typing import Any
from warnings import warn

from gudgeon.assembly.guess_warnings import outside
from gudgeon.contract.methods import KINEMATIC
from gudgeon.drawing.page import PIXELS
from gudgeon.drawing.picture import size_of
from gudgeon.drawing.rig import Rig
from gudgeon.errors import BuildError, SolverError
from gudgeon.language.shown import one_line
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.web import drift
from gudgeon.web.description import description
from gudgeon.web.look import look, style
from gudgeon.web.page import DESCRIPTION, Parts, code, file_text, packed_element, packed_module, script
from gudgeon.web.panel import NARROW, WIDE, looks_of, panel, recorded, rig_of

APP = ("names.js", "drawing.js", "chart.js", "controls.js", "app.js")
PANEL = "gudgeon-panel"
PROGRAM = "gudgeon-program"  # packed program that begin.js unpacks and runs
MAX_MODULE_BYTES = 62_000  # largest module, in bytes, that is accompanied by the full formulation
NO_SIMULATOR = (
    "This page carries one run, with the numbers of the file: it was written without the compiler for pages"
    " (pip install 'gudgeon[web]'), with which its numbers can be moved."
)


def running_parts(simulation: Simulation, scenes: Mapping[str, str]) -> Parts:
    """Return the parts of a page for `page.parts`."""
    run = _run_scene(simulation)
    rig = rig_of(run)
    message, note = panel(simulation, run, rig) | _drawing_scales(rig) | {"scenes": dict(scenes)}, ""
    carried = packed_element(DESCRIPTION, description(simulation.compiled, drift.seen_step(run)).encode())
    try:
        module = packed_module(simulation.compiled)
        carried += _pack_modules(simulation, module)
        message["drift"] = drift.message(simulation, run, len(module), MAX_MODULE_BYTES)
        message |= {"drifts": drift.drifts(simulation), "loaded": drift.loaded(simulation)}
    except BuildError as error:
        if error.__cause__ is None or not isinstance(error.__cause__, ImportError):
            raise
        message["recorded"], note = recorded(run, [*message["traces"], *message["values"]]), NO_SIMULATOR
        warn(f"{note[0].lower()}{note[1:]}", stacklevel=outside())
    text = json.dumps(message, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    carried += packed_element(PANEL, text.encode())
    title = one_line(simulation.source.title or simulation.source.mechanism)
    frame = file_text("app.html").replace("@NOTE@", escape(note)).replace("@TITLE@", escape(title))
    carried += packed_element(PROGRAM, app().encode())
    scripts = f"{carried}<script>\n{script(simulation.source)}</script>\n<script>\n{code('begin.js')}</script>"
    return Parts(f"<style>\n{style(*looks_of(rig))}</style>", frame, scripts)


def _pack_modules(simulation: Simulation, module: str) -> str:
    """Return the simulator as hidden elements; if it is small, that of the full formulation too."""
    reduced = simulation.source.formulation == "reduced" and simulation.source.methods != (KINEMATIC,)
    if not reduced or len(module) > MAX_MODULE_BYTES:
        return module
    full = simulation.full.compiled
    return module + packed_element(f"{DESCRIPTION}-full", description(full).encode()) + packed_module(full, "-full")


def _run_scene(simulation: Simulation) -> Result:
    """Return a run of the scene at the file's values, or the part before its failure with a warning."""
    try:
        return simulation.simulate()
    except SolverError as error:
        if error.partial is None or len(error.partial.t) < 2:
            raise
        warn(f"the page shows a run up to where it fails: {error}", stacklevel=outside())
        return error.partial


def _drawing_scales(rig: Rig) -> dict[str, Any]:
    """Return the CSS classes of the shapes, and the pixels per metre on wide and narrow screens."""
    pixels = []
    for inches in (WIDE, NARROW):
        size, sketch = size_of(rig.sketch, inches), replace(rig.sketch, labels=())
        pixels.append(PIXELS * min(a / b for a, b in zip(size, sketch.high - sketch.low, strict=True)))
    return {"looks": [look(one.shape.role, one.shape.tint) for one in rig.shapes], "pixels": pixels}


@cache
def app() -> str:
    """Return the JavaScript of the visible part, which follows `script` of page.py."""
    return "\n".join(("(() => {", '"use strict";', *(code(name) for name in APP), "})();", ""))

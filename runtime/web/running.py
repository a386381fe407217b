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
    """Return the HTML parts of a scene's interactive page: style, visible frame, scripts; see `page.parts`.

    `scenes` are pages of other scenes by name. Without the compiler the page has one recorded run, and a warning is
    issued.
    """
    run = _run_scene(simulation)
    rig = rig_of(run)
    contents, note = panel(simulation, run, rig) | _drawing_scales(rig) | {"scenes": dict(scenes)}, ""
    elements = packed_element(DESCRIPTION, description(simulation.compiled, drift.seen_step(run)).encode())
    try:
        module = packed_module(simulation.compiled)
        elements += _pack_modules(simulation, module)
        contents["drift"] = drift.message(simulation, run, len(module), MAX_MODULE_BYTES)
        contents |= {"drifts": drift.drifts(simulation), "loaded": drift.loaded(simulation)}
    except BuildError as error:
        if error.__cause__ is None or not isinstance(error.__cause__, ImportError):
            raise
        contents["recorded"], note = recorded(run, [*contents["traces"], *contents["values"]]), NO_SIMULATOR
        warn(f"{note[0].lower()}{note[1:]}", stacklevel=outside())
    text = json.dumps(contents, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    elements += packed_element(PANEL, text.encode())
    title = one_line(simulation.source.title or simulation.source.mechanism)
    frame = file_text("app.html").replace("@NOTE@", escape(note)).replace("@TITLE@", escape(title))
    elements += packed_element(PROGRAM, app().encode())
    scripts = f"{elements}<script>\n{script(simulation.source)}</script>\n<script>\n{code('begin.js')}</script>"
    return Parts(f"<style>\n{style(*looks_of(rig))}</style>", frame, scripts)


def _pack_modules(simulation: Simulation, module: str) -> str:
    """Return hidden elements of the simulator; for a small one of the reduced formulation also that of the full one."""
    is_reduced = simulation.source.formulation == "reduced" and simulation.source.methods != (KINEMATIC,)
    if not is_reduced or len(module) > MAX_MODULE_BYTES:
        return module
    full_model = simulation.full.compiled
    return (
        module
        + packed_element(f"{DESCRIPTION}-full", description(full_model).encode())
        + packed_module(full_model, "-full")
    )


def _run_scene(simulation: Simulation) -> Result:
    """Return a run of the scene at the file's values.

    If it fails after the start, the part before the failure is returned with a warning; otherwise SolverError is
    raised.
    """
    try:
        return simulation.simulate()
    except SolverError as error:
        if error.partial is None or len(error.partial.t) < 2:
            raise
        warn(f"the page shows a run up to where it fails: {error}", stacklevel=outside())
        return error.partial


def _drawing_scales(rig: Rig) -> dict[str, Any]:
    """Return {looks: CSS classes of the shapes, pixels: pixels per metre on a wide and on a narrow screen}."""
    pixels_per_metre = []
    for inches in (WIDE, NARROW):
        figure_size, sketch = size_of(rig.sketch, inches), replace(rig.sketch, labels=())
        pixels_per_metre.append(
            PIXELS
            * min(
                length_in_inches / length_in_metres
                for length_in_inches, length_in_metres in zip(figure_size, sketch.high - sketch.low, strict=True)
            )
        )
    return {
        "looks": [look(carried.shape.role, carried.shape.tint) for carried in rig.shapes],
        "pixels": pixels_per_metre,
    }


@cache
def app() -> str:
    """Return the JavaScript of the visible part, which follows `script` of page.py."""
    return "\n".join(("(() => {", '"use strict";', *(code(name) for name in APP), "})();", ""))

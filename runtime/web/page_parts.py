"""Build the simulator of a scene's HTML page: style sheet, HTML elements and scripts, as strings."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from html import escape
from typing import Any
from warnings import warn

from gudgeon.contract.methods import KINEMATIC
from gudgeon.drawing.page import PIXELS_PER_INCH
from gudgeon.drawing.picture import compute_figure_size
from gudgeon.drawing.rig import Rig
from gudgeon.errors import BuildError, SolverError
from gudgeon.language.deprecations import find_user_stack_level
from gudgeon.language.text_output import format_one_line
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.web import drift
from gudgeon.web.description import build_description
from gudgeon.web.page import DESCRIPTION_ID, Parts, build_script, pack_element, pack_module, read_file, read_script
from gudgeon.web.panel import NARROW_INCHES, WIDE_INCHES, build_panel, build_rig, list_styles, pack_run
from gudgeon.web.style_sheet import build_style_sheet, make_css_class

APP_FILES = ("labels.js", "drawing.js", "chart.js", "controls.js", "app.js")
PANEL_ID = "gudgeon-panel"
PROGRAM_ID = "gudgeon-program"  # packed program that loader.js unpacks and runs
MAX_MODULE_BYTES = 62_000  # largest module, in bytes, that is accompanied by the full formulation
NO_SIMULATOR_NOTE = (
    "This page contains one run with the parameters of the file. They can be changed in pages that are written with"
    " the compiler for pages (pip install 'gudgeon[web]')."
)


def build_simulator_parts(simulation: Simulation, scenes: Mapping[str, str]) -> Parts:
    """Return the HTML parts of a scene's interactive page: style, visible frame, scripts.

    `scenes` are pages of other scenes by name. Without the compiler the page has one recorded run, and a warning is
    issued.
    """
    run = _run_scene(simulation)
    rig = build_rig(run)
    contents, note = build_panel(simulation, run, rig) | _describe_drawing(rig) | {"scenes": dict(scenes)}, ""
    elements = pack_element(
        DESCRIPTION_ID, build_description(simulation.compiled, drift.compute_drift_step(run)).encode()
    )
    try:
        module = pack_module(simulation.compiled)
        elements += _pack_modules(simulation, module)
        contents["drift"] = drift.explain_missing_drift(simulation, run, len(module), MAX_MODULE_BYTES)
        contents |= {"drifts": drift.has_drift(simulation), "loaded": drift.format_load_arguments(simulation)}
    except BuildError as error:
        if error.__cause__ is None or not isinstance(error.__cause__, ImportError):
            raise
        contents["recorded"], note = pack_run(run, [*contents["traces"], *contents["values"]]), NO_SIMULATOR_NOTE
        warn(f"{note[0].lower()}{note[1:]}", stacklevel=find_user_stack_level())
    text = json.dumps(contents, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    elements += pack_element(PANEL_ID, text.encode())
    title = format_one_line(simulation.source.title or simulation.source.mechanism)
    frame = read_file("app.html").replace("@NOTE@", escape(note)).replace("@TITLE@", escape(title))
    elements += pack_element(PROGRAM_ID, (build_script(simulation.source) + build_app_script()).encode())
    scripts = f"{elements}<script>\n{read_script('loader.js')}</script>"
    return Parts(f"<style>\n{build_style_sheet(*list_styles(rig))}</style>", frame, scripts)


def _pack_modules(simulation: Simulation, module_element: str) -> str:
    """Return the hidden HTML element of the module, with those of the full formulation if the reduced one is small.

    Small: an element of up to MAX_MODULE_BYTES characters, of a scene with degrees of freedom.
    """
    is_reduced = simulation.source.formulation == "reduced" and simulation.source.methods != (KINEMATIC,)
    if not is_reduced or len(module_element) > MAX_MODULE_BYTES:
        return module_element
    full_model = simulation.full.compiled
    return (
        module_element
        + pack_element(f"{DESCRIPTION_ID}-full", build_description(full_model).encode())
        + pack_module(full_model, "-full")
    )


def _run_scene(simulation: Simulation) -> Result:
    """Return a run of the scene at the file's values.

    If it fails after the start, a warning is issued and the part before the failure is returned. SolverError is raised
    if there is no such part.
    """
    try:
        return simulation.simulate()
    except SolverError as error:
        if error.partial is None or len(error.partial.t) < 2:
            raise
        warn(f"the page shows the run up to its failure: {error}", stacklevel=find_user_stack_level())
        return error.partial


def _describe_drawing(rig: Rig) -> dict[str, Any]:
    """Return the JSON data of the drawing: {looks, pixels}.

    looks: CSS class of each shape. pixels: pixels per metre on a wide and on a narrow screen, so that it fits.
    """
    pixels_per_metre = []
    for inches in (WIDE_INCHES, NARROW_INCHES):
        figure_size, sketch = compute_figure_size(rig.sketch, inches), replace(rig.sketch, labels=())
        pixels_per_metre.append(
            PIXELS_PER_INCH
            * min(
                length_in_inches / length_in_metres
                for length_in_inches, length_in_metres in zip(figure_size, sketch.high - sketch.low, strict=True)
            )
        )
    return {
        "looks": [
            make_css_class(moving_shape.shape.role, moving_shape.shape.colour_index) for moving_shape in rig.shapes
        ],
        "pixels": pixels_per_metre,
    }


@cache
def build_app_script() -> str:
    """Return the JavaScript of the visible part, which follows `build_script` of page.py."""
    return "\n".join(("(() => {", '"use strict";', *(read_script(name) for name in APP_FILES), "})();", ""))

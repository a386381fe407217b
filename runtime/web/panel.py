"""Prepare the initial contents of a page's panel as JSON: drawing, parameters with ranges, traces, one run."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Iterator
from typing import Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.drawing.labels import Names
from gudgeon.drawing.page import PIXELS
from gudgeon.drawing.picture import draw_on, size_of
from gudgeon.drawing.plan import make_plan
from gudgeon.drawing.rig import Rig, make_rig
from gudgeon.drawing.shapes import Sketch
from gudgeon.results.figures.animation import QUICK, SHOWN, SLOW
from gudgeon.results.figures.postures import postures_of
from gudgeon.results.reports.comparison import NOISE
from gudgeon.results.results import Result
from gudgeon.results.series import default_watch, rates
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.look import look
from gudgeon.web.numbers import groups, units

WIDE, NARROW = 7.0, 3.6  # inches of a drawing on wide and narrow screens; names are placed for both
SHOWN_AT = 24  # number of postures from which the drawing is made
MORE = ("reaction", "reaction head", "path")  # roles that exist on pages only
KEPT, MOST = 400, 60  # samples and series of a recorded run


def rig_of(run: Result) -> Rig:
    """Return the drawing of a run."""
    motion = postures_of(run, SHOWN_AT)
    return make_rig(motion, make_plan(motion))


def panel(simulation: Simulation, run: Result, rig: Rig) -> dict[str, Any]:
    """Return the contents for a scene, from a run at the file's values."""
    source, span = run.source, float(run.t[-1] - run.t[0])
    ends = dict(_journals(source))
    return {
        "groups": groups(simulation, simulation.p),
        "units": units(source),
        "noise": NOISE,
        "rig": rig.json(),
        "names": list(_names(rig)),
        "joints": [[name, point] for name, point in ends.items() if f"{name}.Fx" in run.names],
        "traces": _first_traces(run),
        "values": _first_values(run),
        "seconds": span if SLOW <= span <= QUICK else SHOWN,
        "path": _first_path(rig),
    }


def _journals(source: KernelSource) -> list[tuple[str, str]]:
    """Return the joints, those with play first, and the points on which their forces act."""
    worn = [(joint.name, joint.point) for joint in source.clearances]
    return [*worn, *((joint.name, joint.point) for joint in source.joints)]


def _first_traces(run: Result) -> list[str]:
    """Return the traces shown at first: a watched series, a drive, a force, the drift; at most four."""
    source = run.source
    drives = [name for drive in source.drives for name in (f"{drive.name}.torque", f"{drive.name}.force")]
    joints = [f"{name}.F" for name, _ in _journals(source)]
    names = [*default_watch(run)[:1], *source.peaks[:1], *(name for name in drives if name in run.names)][:2]
    names += [name for name in joints if name in run.names and np.isfinite(run[name]).any()][:1]
    return [*dict.fromkeys(names), "Phi.max"]


def _first_values(run: Result) -> list[str]:
    """Return the live values: watched series with their rates, outputs, drives, eccentricities, forces of joints."""
    source, found = run.source, list[str]()
    for name in default_watch(run):
        found += [name, rates(name)[0]]
    found += [*source.outputs, *source.peaks]
    found += [f"{drive.name}.{what}" for drive in source.drives for what in ("torque", "force")]
    found += [f"{joint.name}.eps" for joint in source.clearances]
    found += [f"{name}.F" for name, _ in _journals(source)]
    return [name for name in dict.fromkeys(found) if name in run.names]


def _first_path(rig: Rig) -> str:
    """Return a point that no body, joint or force uses, for the path; "" if there is none."""
    marks = [one.shape.part.partition(" ")[2] for one in rig.shapes if one.shape.part.startswith("point ")]
    return marks[0] if marks else ""


def looks_of(rig: Rig) -> tuple[list[tuple[str, int]], list[tuple[str, int]]]:
    """Return the roles and tints of shapes and of names, each once."""
    shapes = dict.fromkeys((one.shape.role, one.shape.tint) for one in rig.shapes)
    unique = {look(role, tint): (role, tint) for role, tint in [*shapes, *((role, 0) for role in MORE)]}
    names = {look(role, tint): (role, tint) for role, tint in _name_looks(rig)}
    return list(unique.values()), list(names.values())


def _name_looks(rig: Rig) -> Iterator[tuple[str, int]]:
    """Yield role and tint of each name."""
    tints = {one.shape.part: one.shape.tint for one in rig.shapes}
    for label in rig.sketch.labels:
        yield label.role, tints.get(label.part, 0)


def _names(rig: Rig) -> Iterator[list[Any]]:
    """Yield [text, part, class, shift on a wide screen, on a narrow one, clear] of each name.

    Shifts in pixels with y down, None where the name is hidden; clear in m.
    """
    wide, narrow = _name_shifts(rig.sketch, WIDE), _name_shifts(rig.sketch, NARROW)
    for label, (role, tint) in zip(rig.sketch.labels, _name_looks(rig), strict=True):
        shifts = [[round(x, 1), round(-y, 1)] for x, y in (at.get(label.part, (0.0, 0.0)) for at in (wide, narrow))]
        hidden = [part not in at for part, at in ((label.part, wide), (label.part, narrow))]
        message: list[Any] = [None if gone else shift for shift, gone in zip(shifts, hidden, strict=True)]
        yield [label.text, label.part, f"{look(role, tint)}-name", *message, float(f"{label.clear:.3g}")]


def _name_shifts(sketch: Sketch, inches: float) -> dict[str, tuple[float, float]]:
    """Return the distances of names from their parts in pixels, at a figure width in inches."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=size_of(sketch, inches), dpi=PIXELS)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    draw_on(ax, sketch)
    figure.draw_without_rendering()
    names = next((artist for artist in ax.get_children() if isinstance(artist, Names)), None)
    return names.beside if names is not None else {}


def recorded(run: Result, named: list[str]) -> dict[str, Any]:
    """Return a run for a page without simulator: at most KEPT samples, float32, packed; the `named` series first."""
    rows = np.unique(np.linspace(0, len(run.t) - 1, KEPT).round().astype(int))
    drawn = [name for name in run.names if name.endswith((".Fx", ".Fy", ".ex", ".ey"))]
    names = list(dict.fromkeys(name for name in [*named, *drawn, *run.names] if name in run.names))[:MOST]
    table = np.column_stack([run.t[rows], run.q[rows], run.v[rows], *(run[name][rows] for name in names)])
    bits = gzip.compress(np.ascontiguousarray(table.T, dtype="<f4").tobytes(), 9, mtime=0)
    return {
        "rows": len(rows),
        "p": [float(x) for x in run.p],
        "series": {name: run.unit(name) for name in names},
        "bits": base64.b64encode(bits).decode("ascii"),
    }

"""Build the initial contents of a simulator page as JSON: drawing, parameters with ranges, curves, one run."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Iterator
from typing import Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.drawing.labels import NameLabels
from gudgeon.drawing.layout import make_layout
from gudgeon.drawing.page import PIXELS_PER_INCH
from gudgeon.drawing.picture import compute_figure_size, draw_sketch
from gudgeon.drawing.rig import Rig, make_rig
from gudgeon.drawing.shapes import Sketch
from gudgeon.results.figures.animation import DEFAULT_DURATION, MAX_REAL_TIME, MIN_REAL_TIME
from gudgeon.results.figures.configurations import select_configurations
from gudgeon.results.reports.comparison import ROUNDING_TOL
from gudgeon.results.results import Result
from gudgeon.results.series import choose_default_series, find_rate_names
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.parameter_panel import build_parameter_sections, list_units
from gudgeon.web.style_sheet import make_css_class

WIDE_INCHES, NARROW_INCHES = 7.0, 3.6  # inches of a drawing on wide and narrow screens; names are placed for both
N_CONFIGURATIONS = 24  # number of configurations from which the drawing is made
PAGE_ROLES = ("reaction", "reaction head", "path")  # roles that exist on pages only
MAX_SAMPLES, MAX_SERIES = 400, 60  # samples and series of a recorded run


def build_rig(run: Result) -> Rig:
    """Return the drawing of a run."""
    motion = select_configurations(run, N_CONFIGURATIONS)
    return make_rig(motion, make_layout(motion))


def build_panel(simulation: Simulation, run: Result, rig: Rig) -> dict[str, Any]:
    """Return the initial contents of a scene's panel for JSON, from a run at the file's values.

    They are parameters, units, drawing, names, traces, values to show, and the duration of the animation.
    """
    source, duration = run.source, float(run.t[-1] - run.t[0])
    points_by_joint = dict(_list_journals(source))
    return {
        "groups": build_parameter_sections(simulation, simulation.p),
        "units": list_units(source),
        "noise": ROUNDING_TOL,
        "rig": rig.to_json_data(),
        "names": list(_iterate_names(rig)),
        "joints": [[name, point] for name, point in points_by_joint.items() if f"{name}.Fx" in run.names],
        "traces": _choose_initial_chart_series(run),
        "values": _choose_initial_value_series(run),
        "seconds": duration if MIN_REAL_TIME <= duration <= MAX_REAL_TIME else DEFAULT_DURATION,
        "path": _choose_initial_path_point(rig),
    }


def _list_journals(source: KernelSource) -> list[tuple[str, str]]:
    """Return (joint, point on which its force acts) for all joints, those with play first."""
    joints_with_play = [(joint.name, joint.point) for joint in source.clearances]
    return [*joints_with_play, *((joint.name, joint.point) for joint in source.joints)]


def _choose_initial_chart_series(run: Result) -> list[str]:
    """Return the names of the series in the initial charts: two default series, peaks or drives, a force, Phi.max.

    A force without finite sample is left out.
    """
    source = run.source
    drive_series = [name for drive in source.drives for name in (f"{drive.name}.torque", f"{drive.name}.force")]
    force_series = [f"{name}.F" for name, _ in _list_journals(source)]
    names = [*choose_default_series(run)[:1], *source.peaks[:1], *(name for name in drive_series if name in run.names)][
        :2
    ]
    names += [name for name in force_series if name in run.names and np.isfinite(run[name]).any()][:1]
    return [*dict.fromkeys(names), "Phi.max"]


def _choose_initial_value_series(run: Result) -> list[str]:
    """Return the names of the live values: default series and rates, outputs, peaks, drives, eccentricities, forces.

    Names that the run lacks are left out.
    """
    source, candidates = run.source, list[str]()
    for name in choose_default_series(run):
        candidates += [name, find_rate_names(name)[0]]
    candidates += [*source.outputs, *source.peaks]
    candidates += [f"{drive.name}.{quantity}" for drive in source.drives for quantity in ("torque", "force")]
    candidates += [f"{joint.name}.eps" for joint in source.clearances]
    candidates += [f"{name}.F" for name, _ in _list_journals(source)]
    return [name for name in dict.fromkeys(candidates) if name in run.names]


def _choose_initial_path_point(rig: Rig) -> str:
    """Return the first named point that no joint or force element uses, whose path is drawn; "" if there is none."""
    points = [
        moving_shape.shape.part.partition(" ")[2]
        for moving_shape in rig.shapes
        if moving_shape.shape.part.startswith("point ")
    ]
    return points[0] if points else ""


def list_styles(rig: Rig) -> tuple[list[tuple[str, int]], list[tuple[str, int]]]:
    """Return two lists of (role, colour index), each CSS class once: of shapes, and of names.

    Roles that exist on pages only are included.
    """
    shape_styles = dict.fromkeys(
        (moving_shape.shape.role, moving_shape.shape.colour_index) for moving_shape in rig.shapes
    )
    unique_shape_styles = {
        make_css_class(role, colour_index): (role, colour_index)
        for role, colour_index in [*shape_styles, *((role, 0) for role in PAGE_ROLES)]
    }
    name_styles = {
        make_css_class(role, colour_index): (role, colour_index) for role, colour_index in _iterate_name_styles(rig)
    }
    return list(unique_shape_styles.values()), list(name_styles.values())


def _iterate_name_styles(rig: Rig) -> Iterator[tuple[str, int]]:
    """Yield (role, colour index) of each name of the drawing; the colour index is that of its part."""
    tints = {moving_shape.shape.part: moving_shape.shape.colour_index for moving_shape in rig.shapes}
    for label in rig.sketch.labels:
        yield label.role, tints.get(label.part, 0)


def _iterate_names(rig: Rig) -> Iterator[list[Any]]:
    """Yield [text, part, class, shift on a wide screen, on a narrow one, distance] of each name.

    Shifts are in pixels with y down, None where the name is hidden; the distance from the part is in m.
    """
    wide_shifts, narrow_shifts = (
        _compute_name_offsets(rig.sketch, WIDE_INCHES),
        _compute_name_offsets(rig.sketch, NARROW_INCHES),
    )
    for label, (role, colour_index) in zip(rig.sketch.labels, _iterate_name_styles(rig), strict=True):
        shifts = [
            [round(x, 1), round(-y, 1)]
            for x, y in (shifts_by_part.get(label.part, (0.0, 0.0)) for shifts_by_part in (wide_shifts, narrow_shifts))
        ]
        hidden_flags = [
            part not in shifts_by_part
            for part, shifts_by_part in ((label.part, wide_shifts), (label.part, narrow_shifts))
        ]
        visible_shifts: list[Any] = [
            None if is_hidden else shift for shift, is_hidden in zip(shifts, hidden_flags, strict=True)
        ]
        yield [
            label.text,
            label.part,
            f"{make_css_class(role, colour_index)}-name",
            *visible_shifts,
            float(f"{label.clearance:.3g}"),
        ]


def _compute_name_offsets(sketch: Sketch, width_in_inches: float) -> dict[str, tuple[float, float]]:
    """Return the offsets of names from their parts in pixels, y up, by part.

    width_in_inches: of the figure. matplotlib places the names; a name without a free position is left out.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=compute_figure_size(sketch, width_in_inches), dpi=PIXELS_PER_INCH)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    draw_sketch(ax, sketch)
    figure.draw_without_rendering()
    names = next((artist for artist in ax.get_children() if isinstance(artist, NameLabels)), None)
    return names.label_offsets if names is not None else {}


def pack_run(run: Result, first_names: list[str]) -> dict[str, Any]:
    """Return a run for a page without simulator as a dictionary for JSON; "bits" is gzip, base64 of float32 rows.

    It has at most MAX_SAMPLES samples of t, q, v and at most MAX_SERIES series: `first_names` first, then forces and
    eccentricities.
    """
    sample_indices = np.unique(np.linspace(0, len(run.t) - 1, MAX_SAMPLES).round().astype(int))
    drawn_series = [name for name in run.names if name.endswith((".Fx", ".Fy", ".ex", ".ey"))]
    names = list(dict.fromkeys(name for name in [*first_names, *drawn_series, *run.names] if name in run.names))[
        :MAX_SERIES
    ]
    table = np.column_stack(
        [
            run.t[sample_indices],
            run.q[sample_indices],
            run.v[sample_indices],
            *(run[name][sample_indices] for name in names),
        ]
    )
    packed_values = gzip.compress(np.ascontiguousarray(table.T, dtype="<f4").tobytes(), 9, mtime=0)
    return {
        "rows": len(sample_indices),
        "p": [float(x) for x in run.p],
        "series": {name: run.unit(name) for name in names},
        "bits": base64.b64encode(packed_values).decode("ascii"),
    }

"""Draw the mechanism in figures of a run: at a time, with arrows, and with paths of its points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.drawing.arrows import MAX_ARROW_LENGTH, Arrows, compute_velocities, draw_arrows
from gudgeon.drawing.configuration import Configuration, get_joint_type
from gudgeon.drawing.insets import find_contacts
from gudgeon.drawing.layout import Layout, make_layout
from gudgeon.drawing.picture import build_figure, draw_sketch, encode_figure
from gudgeon.drawing.shapes import Line, Sketch
from gudgeon.drawing.sketch import compute_common_box, make_sketch
from gudgeon.language.argument_checks import check_flag, check_names
from gudgeon.language.names import make_missing_name_error
from gudgeon.results.figures.configurations import (
    compute_configuration,
    evaluate_loads,
    read_time,
    select_configurations,
)
from gudgeon.results.figures.plots import choose_colours

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gudgeon.results.results import Result

Array = Any
POINTS = "the name of a point that moves, or a list of such names"
MAX_NAMES = 60  # names that fit in a panel


def draw_sketch_at_time(run: Result, t: Any, velocities: bool = False, forces: bool = False) -> Sketch:
    """Return the drawing of the mechanism at a time of the run, with arrows of velocities or forces if requested.

    `t` is a number in s or a text with a unit. Sizes and insets are those for the whole run; joints in contact are
    highlighted. Raises BadValueError, UnknownNameError.
    """
    velocities, forces = check_flag(velocities, "velocities"), check_flag(forces, "forces")
    configuration, motion = compute_configuration(run, read_time(run, t)), select_configurations(run)
    layout = make_layout(motion)
    layout, all_arrows = draw_requested_arrows(run, configuration, motion, layout, velocities, forces)
    return make_sketch(
        configuration, layout, arrows=all_arrows, contact_names=find_contacts_at_configuration(run, configuration)
    )


def find_contacts_at_configuration(run: Result, configuration: Configuration) -> frozenset[str]:
    """Return the names of joints and slider corners with play that are in contact at a configuration's time.

    At a sample the stored contact states are used, between samples the overlap of the surfaces in the drawing.
    """
    if (sample_indices := np.flatnonzero(run.t == configuration.t)).size:
        return frozenset(
            joint.name for k, joint in enumerate(run.source.clearances) if run.state[sample_indices[0], k] > 0
        )
    return find_contacts(configuration)


def draw_requested_arrows(
    run: Result,
    configuration: Configuration,
    motion: Sequence[Configuration],
    layout: Layout,
    velocities: bool,
    forces: bool,
) -> tuple[Layout, list[Arrows]]:
    """Return the layout, and a list of the requested arrows of velocities and forces.

    The scale of velocities is that of the whole run, from the configurations `motion`. With `forces` the returned
    layout draws applied forces to the scale of the reactions.
    """
    all_arrows = [draw_velocity_arrows(configuration, motion, layout)] if velocities else []
    if not forces:
        return layout, all_arrows
    reactions, force_scale = draw_force_arrows(run, configuration, layout)
    return replace(layout, metres_per_newton=force_scale), [*all_arrows, reactions]


def draw_velocity_arrows(configuration: Configuration, motion: Sequence[Configuration], layout: Layout) -> Arrows:
    """Return the velocity arrows of all points at a configuration, with the largest speed of the whole run as scale."""
    speeds = [
        float(np.hypot(*vector))
        for sample_configuration in (*motion, configuration)
        for _, (_, vector) in compute_velocities(sample_configuration)
    ]
    return draw_arrows(
        "velocity", dict(compute_velocities(configuration)), "m/s", layout.unit, max(speeds, default=0.0)
    )


def draw_force_arrows(run: Result, configuration: Configuration, layout: Layout) -> tuple[Arrows, float]:
    """Return the arrows of joint forces at a configuration, and the length of 1 N (m of the drawing; 0 without forces).

    Forces act on the second body, for a joint with play on the journal, and are interpolated between samples. The
    longest arrow is the largest force at this time, applied forces included: with a scale for the whole run, impacts
    would make most arrows invisible. Raises UnknownNameError without masses.
    """
    reactions = dict(_iterate_joint_forces(run, configuration))
    applied_forces = [configuration.loads[part.name] for part in configuration.iterate_parts("forces", "force")]
    magnitudes = [
        float(np.hypot(*vector)) for vector in (*(vector for _, vector in reactions.values()), *applied_forces)
    ]
    max_magnitude = max((magnitude for magnitude in magnitudes if np.isfinite(magnitude)), default=0.0)
    acting_on = " on the second body, applied force" if np.any(applied_forces) else " on the second body"
    reaction_arrows = replace(draw_arrows("reaction", reactions, "N", layout.unit, max_magnitude), on=acting_on)
    return reaction_arrows, MAX_ARROW_LENGTH * layout.unit / max_magnitude if max_magnitude > 0.0 else 0.0


def _iterate_joint_forces(run: Result, configuration: Configuration) -> Iterator[tuple[str, tuple[Array, Array]]]:
    """Yield name, position and force vector of each joint that connects points; (name, ((2,) in m, (2,) in N))."""
    for part in configuration.iterate_parts("joints"):
        joint_type = get_joint_type(part)
        if joint_type.joins == "points":
            vector = [float(np.interp(configuration.t, run.t, run[f"{part.name}.F{axis}"])) for axis in "xy"]
            position = configuration.get_position(part.ends[0 if joint_type.reaction_at == "first" else 1])
            yield part.name, (position, np.array(vector))


def draw_start_sketch(run: Result) -> Sketch:
    """Return the drawing at the start of the run, without insets.

    All labels are left out if there are more than MAX_NAMES.
    """
    motion = select_configurations(run)
    sketch = make_sketch(motion[0], make_layout(motion), shows_insets=False)
    return sketch if len(sketch.labels) <= MAX_NAMES else replace(sketch, labels=())


def draw_start_picture(scene_or_run: Any) -> bytes:
    """Return the PNG bytes that a notebook displays for a run or a scene: the mechanism at the start, with names and
    insets.

    The start of a scene is assembled first.
    """
    if hasattr(scene_or_run, "names"):
        sketch = draw_sketch_at_time(scene_or_run, float(scene_or_run.t[0]))
    else:
        start = scene_or_run.start()
        loads = evaluate_loads(scene_or_run.source, scene_or_run.p, start.q, start.v)
        configuration = Configuration(scene_or_run.source, scene_or_run.p, start.q, 0.0, start.v, loads)
        sketch = make_sketch(configuration, make_layout([configuration]))
    return encode_figure(build_figure([sketch], [""], ""), ".png", dpi=90)


def draw_path_sketch(run: Result) -> Sketch:
    """Return the drawing at the start of the run in a box that contains the whole motion.

    Its only label is that of the scale.
    """
    motion = select_configurations(run)
    layout = make_layout(motion)
    sketch = make_sketch(motion[0], layout, box=compute_common_box(motion, [layout]), shows_insets=False)
    return replace(sketch, labels=tuple(label for label in sketch.labels if label.role == "scale"))


def draw_path(run: Result, sketch: Sketch, points: Sequence[str], ax: Axes) -> None:
    """Draw the paths of points over the run on axes, with a ring at each start.

    The mechanism of `sketch` lies under them in grey.
    """
    draw_sketch(ax, sketch, is_background=True)
    for name, colour in zip(points, choose_colours(len(points)), strict=True):
        x, y = run[f"{name}.x"], run[f"{name}.y"]
        ax.plot(x, y, color=colour, lw=1.4, label=name, gid=f"path-{name}", zorder=5)
        ax.plot(x[:1], y[:1], "o", ms=4, mfc="white", mec=colour, mew=1.0, zorder=5.1)
    ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8)  # outside: it hides nothing


def build_path_lines(run: Result, points: Sequence[str]) -> list[Line]:
    """Return the paths of points over the run as lines of a drawing."""
    return [Line(f"path {name}", "path", np.column_stack([run[f"{name}.x"], run[f"{name}.y"]])) for name in points]


def check_points(run: Result, points: Iterable[Any]) -> list[str]:
    """Return names of moving points, such as "coupler.tracer", or of bodies for their centres of mass, without
    repetitions.

    `points` has names and lists of names. Raises BadValueError, UnknownNameError with the nearest name.
    """
    point_names = dict.fromkeys(
        name for names_argument in points for name in check_names(names_argument, "points", POINTS)
    )
    return [_check_point(run, name) for name in point_names]


def _check_point(run: Result, name: str) -> str:
    """Return the name unchanged if it is that of a moving point or a body.

    Raises UnknownNameError with the nearest name otherwise.
    """
    moving_points = [point.name for point in run.source.points if point.body >= 0]
    bodies = [body.name for body in run.source.bodies]
    if name in moving_points or name in bodies:
        return name
    raise make_missing_name_error(
        f"the scene {run.source.scene!r} has no point {name!r} that moves", name, (*moving_points, *bodies)
    )

"""Draw the mechanism in figures of a run: at a time, with arrows, and with paths of its points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.drawing.arrows import LONGEST, Arrows, arrows, velocities_of
from gudgeon.drawing.insets import in_contact
from gudgeon.drawing.picture import as_bytes, draw_on, figure_of
from gudgeon.drawing.plan import Plan, make_plan
from gudgeon.drawing.posture import Posture, type_of
from gudgeon.drawing.shapes import Line, Sketch
from gudgeon.drawing.sketch import make_sketch, room_of_all
from gudgeon.language.argument_checks import flag, names
from gudgeon.language.names import unknown
from gudgeon.results.figures.plots import cycle
from gudgeon.results.figures.postures import loads_at, posture_at, postures_of, time_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gudgeon.results.results import Result

Array = Any
POINTS = "the name of a point that moves, or a list of such names"
MANY = 60  # names for which a panel has no room


def sketch_at(run: Result, t: Any, velocities: bool = False, forces: bool = False) -> Sketch:
    """Return the drawing of the mechanism at a time of the run, with arrows if requested.

    Raises BadValueError, UnknownNameError.
    """
    velocities, forces = flag(velocities, "velocities"), flag(forces, "forces")
    posture, motion = posture_at(run, time_of(run, t)), postures_of(run)
    plan = make_plan(motion)
    plan, more = arrows_of(run, posture, motion, plan, velocities, forces)
    return make_sketch(posture, plan, arrows=more, touching=touching_at(run, posture))


def touching_at(run: Result, posture: Posture) -> frozenset[str]:
    """Return the joints with play whose surfaces are in contact at a posture's time.

    The contact state decides at a sample; between two samples, the overlap in the drawing.
    """
    if (at := np.flatnonzero(run.t == posture.t)).size:
        return frozenset(joint.name for c, joint in enumerate(run.source.clearances) if run.state[at[0], c] > 0)
    return in_contact(posture)


def arrows_of(
    run: Result, posture: Posture, motion: Sequence[Posture], plan: Plan, velocities: bool, forces: bool
) -> tuple[Plan, list[Arrows]]:
    """Return the plan and the requested arrows of velocities and forces.

    With forces the plan scales applied forces like reactions.
    """
    found = [velocity_arrows(posture, motion, plan)] if velocities else []
    if not forces:
        return plan, found
    reactions, newton = force_arrows(run, posture, plan)
    return replace(plan, newton=newton), [*found, reactions]


def velocity_arrows(posture: Posture, motion: Sequence[Posture], plan: Plan) -> Arrows:
    """Return the velocity arrows of all points, to a scale for the whole run."""
    speeds = [float(np.hypot(*vector)) for at in (*motion, posture) for _, (_, vector) in velocities_of(at)]
    return arrows("velocity", dict(velocities_of(posture)), "m/s", plan.unit, max(speeds, default=0.0))


def force_arrows(run: Result, posture: Posture, plan: Plan) -> tuple[Arrows, float]:
    """Return the arrows of joint forces at a posture, and the length of 1 N (m of the drawing).

    Forces act on the second body, for a joint with play on the journal, and are interpolated between samples. The
    longest arrow is the largest force of this moment, applied forces included, since a scale for the whole run would
    shrink most forces to nothing next to impacts. Raises UnknownNameError without masses.
    """
    found = dict(_joint_forces(run, posture))
    applied = [posture.loads[part.name] for part in posture.parts("forces", "force")]
    sizes = [float(np.hypot(*vector)) for vector in (*(vector for _, vector in found.values()), *applied)]
    largest = max((size for size in sizes if np.isfinite(size)), default=0.0)
    acting_on = " on the second body, applied force" if np.any(applied) else " on the second body"
    drawn = replace(arrows("reaction", found, "N", plan.unit, largest), on=acting_on)
    return drawn, LONGEST * plan.unit / largest if largest > 0.0 else 0.0


def _joint_forces(run: Result, posture: Posture) -> Iterator[tuple[str, tuple[Array, Array]]]:
    """Yield name, point and force vector of each joint that connects points."""
    for part in posture.parts("joints"):
        own = type_of(part)
        if own.joins == "points":
            vector = [float(np.interp(posture.t, run.t, run[f"{part.name}.F{axis}"])) for axis in "xy"]
            place = posture.place(part.ends[0 if own.reaction_at == "first" else 1])
            yield part.name, (place, np.array(vector))


def start_sketch(run: Result) -> Sketch:
    """Return the drawing at the start of the run, without insets; without names if there are very many."""
    motion = postures_of(run)
    sketch = make_sketch(motion[0], make_plan(motion), inset=False)
    return sketch if len(sketch.labels) <= MANY else replace(sketch, labels=())


def start_picture(shown: Any) -> bytes:
    """Return the PNG that a notebook displays for a run or a scene, with names and insets."""
    if hasattr(shown, "names"):
        sketch = sketch_at(shown, float(shown.t[0]))
    else:
        start = shown.start()
        loads = loads_at(shown.source, shown.p, start.q, start.v)
        posture = Posture(shown.source, shown.p, start.q, 0.0, start.v, loads)
        sketch = make_sketch(posture, make_plan([posture]))
    return as_bytes(figure_of([sketch], [""], ""), ".png", dpi=90)


def path_sketch(run: Result) -> Sketch:
    """Return the drawing at the start of the run without names, in a box that contains the whole motion."""
    motion = postures_of(run)
    plan = make_plan(motion)
    sketch = make_sketch(motion[0], plan, box=room_of_all(motion, [plan]), inset=False)
    return replace(sketch, labels=tuple(label for label in sketch.labels if label.role == "scale"))


def draw_path(run: Result, sketch: Sketch, points: Sequence[str], ax: Axes) -> None:
    """Draw the paths of points over the run with a ring at each start, and the mechanism in grey."""
    draw_on(ax, sketch, faint=True)
    for name, colour in zip(points, cycle(len(points)), strict=True):
        x, y = run[f"{name}.x"], run[f"{name}.y"]
        ax.plot(x, y, color=colour, lw=1.4, label=name, gid=f"path-{name}", zorder=5)
        ax.plot(x[:1], y[:1], "o", ms=4, mfc="white", mec=colour, mew=1.0, zorder=5.1)
    ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8)  # outside: it hides nothing


def path_lines(run: Result, points: Sequence[str]) -> list[Line]:
    """Return the paths of points over the run as lines of a drawing."""
    return [Line(f"path {name}", "path", np.column_stack([run[f"{name}.x"], run[f"{name}.y"]])) for name in points]


def points_of(run: Result, points: Iterable[Any]) -> list[str]:
    """Return the names of moving points, such as "coupler.tracer", or of bodies for their centres of mass, without
    repetitions.

    `points` has names and lists of names. Raises BadValueError, UnknownNameError with the nearest name.
    """
    every = dict.fromkeys(name for some in points for name in names(some, "points", POINTS))
    return [_check_point(run, name) for name in every]


def _check_point(run: Result, name: str) -> str:
    """Return the name if it is that of a moving point or a body. Raises UnknownNameError with the nearest name."""
    known = [point.name for point in run.source.points if point.body >= 0]
    bodies = [body.name for body in run.source.bodies]
    if name in known or name in bodies:
        return name
    raise unknown(f"the scene {run.source.scene!r} has no point {name!r} that moves", name, (*known, *bodies))

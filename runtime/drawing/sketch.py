"""Compose a whole drawing: bodies, joints, drives and forces, insets, gravity, a scale, and all names.

Symbols of joints are drawn by their declarations (generator/kinds/joints).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from gudgeon.drawing.arrows import Arrows, round_number
from gudgeon.drawing.bodies import BLOCK, bodies, labels_of_bodies
from gudgeon.drawing.insets import in_contact, insets
from gudgeon.drawing.joint_at import JointAt, gap_of, has_rail
from gudgeon.drawing.movers import HEAD, arcs, arrow, draw_drives_and_forces, gravity_of, labels_of_drives_and_forces
from gudgeon.drawing.pen import Pen
from gudgeon.drawing.plan import Plan, make_plan
from gudgeon.drawing.posture import Posture, type_of
from gudgeon.drawing.shapes import Label, Line, Shape, Sketch, box_of
from gudgeon.model.compiled import Array

MARGIN = 2.6  # units around all


def make_sketch(
    posture: Posture,
    plan: Plan | None = None,
    *,
    more: Sequence[Shape] = (),
    labels: Sequence[Label] = (),
    arrows: Sequence[Arrows] = (),
    loose: frozenset[str] = frozenset(),
    touching: frozenset[str] | None = None,
    touched: frozenset[str] = frozenset(),
    box: tuple[Array, Array] | None = None,
    inset: bool = True,
    still: bool = True,
) -> Sketch:
    """Return the drawing of a posture, with `more` shapes, their `labels`, and `arrows` with their scales on top.

    With a `box` from `room_of_all` the drawing has the same box as others of a motion; names of a picture that is not
    `still` contain no values that change. `touching`: joints with play in contact, None: those that overlap; `touched`:
    those in contact since the previous picture. `inset` False leaves insets out. `loose` bodies have no joint that
    holds them.
    """
    plan = plan or make_plan([posture])
    more = [*more, *(shape for kind in arrows for shape in kind.shapes)]
    shapes = [*bodies(posture, plan, loose), *joints(posture, plan), *draw_drives_and_forces(posture, plan), *more]
    low, high = box or room_of(shapes, plan)
    names = [*labels_of_bodies(posture, plan), *labels_of_joints(posture, plan, arcs(posture))]
    names = [*labels, *names, *labels_of_drives_and_forces(posture, plan, still)]
    touching = in_contact(posture) if touching is None else touching
    notes, corner, annotations = list[str](), high.copy(), list[Shape]()
    for own, label, note in insets(posture, plan.unit, low, high, touching, touched) if inset else ():
        annotations += own
        names, notes = [*names, label], [*notes, note]
        corner = np.maximum(corner, box_of(own)[1] + 1.5 * plan.unit)
        low = np.minimum(low, [low[0], float(box_of(own)[0][1]) - 3.0 * plan.unit])
    for own_shapes, label in _draw_references(posture, plan, low, high, arrows):
        annotations += own_shapes
        names.append(label)
    low = np.minimum(low, box_of(annotations)[0] - 0.8 * plan.unit)
    return Sketch((*shapes, *annotations), tuple(names), low, corner, plan.unit, tuple(notes))


def room_of(shapes: Sequence[Shape], plan: Plan) -> tuple[Array, Array]:
    """Return the box of shapes with a margin for names."""
    low, high = box_of(shapes)
    return low - MARGIN * plan.unit, high + MARGIN * plan.unit


def room_of_all(postures: Sequence[Posture], plans: Sequence[Plan]) -> tuple[Array, Array]:
    """Return the box of all positions of a motion, or of several assemblies, with one plan for all or one each."""
    each = zip(postures, plans if len(plans) > 1 else [plans[0]] * len(postures), strict=True)
    boxes = [room_of([*bodies(x, plan), *joints(x, plan), *draw_drives_and_forces(x, plan)], plan) for x, plan in each]
    return np.min([low for low, _ in boxes], axis=0), np.max([high for _, high in boxes], axis=0)


def _draw_references(
    posture: Posture, plan: Plan, low: Array, high: Array, arrows: Sequence[Arrows]
) -> Iterator[tuple[list[Shape], Label]]:
    """Yield shapes and label of gravity in the upper left corner, of the scale below, and of an arrow for each scale of
    arrows.
    """
    u = plan.unit
    if (down := gravity_of(posture)) is not None:
        middle = np.array([low[0] + 1.5 * u, high[1] - 2.5 * u])
        shapes = list(arrow("gravity", "gravity", middle - 2.0 * u * down, middle + 2.0 * u * down, HEAD * u))
        yield shapes, Label("gravity", "gravity", "g", middle, 0.6 * u, 0.0)
    across = high - low
    length = round_number(min(0.22 * float(across.max()), 0.6 * float(across[0])))
    begin = np.array([low[0] + 0.5 * u, low[1] - 1.0 * u])
    end = begin + [length, 0.0]
    tick = np.array([0.0, 0.5 * u])
    bar = np.array([begin + tick, begin - tick, begin, end, end + tick, end - tick])
    yield [Line("scale", "scale", bar)], Label("scale", "scale", length_text(length), end, 0.6 * u, 0.0)
    for k, kind in enumerate(kind for kind in arrows if kind.length > 0.0):
        tail = begin - [0.0, 2.6 * u * (k + 1)]
        tip = tail + [kind.length, 0.0]
        yield (
            list(arrow(f"scale {kind.role}", kind.role, tail, tip, HEAD * u)),
            Label(f"scale {kind.role}", "scale", f"{kind.role}{kind.on}: {kind.text}", tip, 0.6 * u, 0.0),
        )


def length_text(length: float) -> str:
    """Return a round length in mm or m."""
    return f"{1e3 * length:g} mm" if length < 1.0 else f"{length:g} m"


def joints(posture: Posture, plan: Plan) -> Iterator[Shape]:
    """Yield the shapes of all joints by their symbols."""
    for part in posture.parts("joints"):
        pen = Pen(posture, part, plan)
        type_of(part).symbol.draw(pen)
        yield from pen.shapes


def labels_of_joints(posture: Posture, plan: Plan, arcs: Mapping[str, float]) -> Iterator[Label]:
    """Yield the label of each joint, outside of the `arcs` of arrows around it: radii in units by joint."""
    for part in posture.parts("joints"):
        symbol = type_of(part).symbol
        place = symbol.place(JointAt(posture, part))
        clear, way = max(symbol.clear, arcs.get(part.name, 0.0)), 45.0
        if has_rail(part) and part.name in plan.ways:  # beyond the ground, where nothing slides
            x, y = plan.ways[part.name]
            clear, way = BLOCK[1] + 1.2, float(np.degrees(np.arctan2(y, x)))
            clear += gap_of(posture, part, plan.unit) / plan.unit
        yield Label(f"joint {part.name}", "joint", part.name, place, clear * plan.unit, way)

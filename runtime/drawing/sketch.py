"""Compose a whole drawing: bodies, joints, drives and forces, insets, gravity, a scale, and all names.

Symbols of joints are drawn by their declarations (generator/kinds/joints).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from gudgeon.drawing.arrows import Arrows, find_round_number
from gudgeon.drawing.bodies import BLOCK_HALF_SIZE, draw_bodies, label_bodies
from gudgeon.drawing.configuration import Configuration, get_joint_type
from gudgeon.drawing.drives_and_forces import (
    HEAD_LENGTH,
    compute_arrow_radii,
    draw_arrow,
    draw_drives_and_forces,
    find_gravity_direction,
    label_drives_and_forces,
)
from gudgeon.drawing.insets import draw_insets, find_contacts
from gudgeon.drawing.joint_geometry import JointGeometry, compute_wall_gap, has_rail
from gudgeon.drawing.layout import Layout, make_layout
from gudgeon.drawing.pen import Pen
from gudgeon.drawing.shapes import Label, Line, Shape, Sketch, compute_bounding_box
from gudgeon.model.compiled import Array

MARGIN = 2.6  # units around all


def make_sketch(
    configuration: Configuration,
    layout: Layout | None = None,
    *,
    shapes_on_top: Sequence[Shape] = (),
    labels: Sequence[Label] = (),
    arrows: Sequence[Arrows] = (),
    unconnected_bodies: frozenset[str] = frozenset(),
    contact_names: frozenset[str] | None = None,
    earlier_contact_names: frozenset[str] = frozenset(),
    box: tuple[Array, Array] | None = None,
    shows_insets: bool = True,
    shows_zero_loads: bool = True,
) -> Sketch:
    """Return the drawing of a configuration; `shapes_on_top` with `labels`, and `arrows` with scales, lie on top.

    With a `box` from `compute_common_box` the drawing has the same box as others of a motion. `shows_zero_loads`: label
    a zero force "NAME = 0". `contact_names`: joints with play in contact, None: those that overlap;
    `earlier_contact_names`: those in contact since the previous picture. `shows_insets` False leaves insets out. Bodies
    in `unconnected_bodies` have the colour of an error.
    """
    layout = layout or make_layout([configuration])
    shapes_on_top = [*shapes_on_top, *(shape for kind in arrows for shape in kind.shapes)]
    shapes = [
        *draw_bodies(configuration, layout, unconnected_bodies),
        *draw_joints(configuration, layout),
        *draw_drives_and_forces(configuration, layout),
        *shapes_on_top,
    ]
    low, high = box or compute_box(shapes, layout)
    all_labels = [
        *label_bodies(configuration, layout),
        *label_joints(configuration, layout, compute_arrow_radii(configuration)),
    ]
    all_labels = [*labels, *all_labels, *label_drives_and_forces(configuration, layout, shows_zero_loads)]
    contact_names = find_contacts(configuration) if contact_names is None else contact_names
    notes, upper_corner, annotations = list[str](), high.copy(), list[Shape]()
    for inset_shapes, label, note in (
        draw_insets(configuration, layout.unit, low, high, contact_names, earlier_contact_names) if shows_insets else ()
    ):
        annotations += inset_shapes
        all_labels, notes = [*all_labels, label], [*notes, note]
        upper_corner = np.maximum(upper_corner, compute_bounding_box(inset_shapes)[1] + 1.5 * layout.unit)
        low = np.minimum(low, [low[0], float(compute_bounding_box(inset_shapes)[0][1]) - 3.0 * layout.unit])
    for reference_shapes, label in _draw_references(configuration, layout, low, high, arrows):
        annotations += reference_shapes
        all_labels.append(label)
    low = np.minimum(low, compute_bounding_box(annotations)[0] - 0.8 * layout.unit)
    return Sketch((*shapes, *annotations), tuple(all_labels), low, upper_corner, layout.unit, tuple(notes))


def compute_box(shapes: Sequence[Shape], layout: Layout) -> tuple[Array, Array]:
    """Return the lower and upper corner of the box of shapes, with a margin of MARGIN units for names, in m."""
    lower_corner, upper_corner = compute_bounding_box(shapes)
    return lower_corner - MARGIN * layout.unit, upper_corner + MARGIN * layout.unit


def compute_common_box(configurations: Sequence[Configuration], layouts: Sequence[Layout]) -> tuple[Array, Array]:
    """Return the lower and upper corner of the bounding box of the drawings of several configurations, in m.

    `layouts` is one layout for all configurations, or one for each. The box has a margin for names; insets do not
    count.
    """
    configurations_and_layouts = zip(
        configurations, layouts if len(layouts) > 1 else [layouts[0]] * len(configurations), strict=True
    )
    boxes = [
        compute_box(
            [
                *draw_bodies(configuration, layout),
                *draw_joints(configuration, layout),
                *draw_drives_and_forces(configuration, layout),
            ],
            layout,
        )
        for configuration, layout in configurations_and_layouts
    ]
    return np.min([low for low, _ in boxes], axis=0), np.max([high for _, high in boxes], axis=0)


def _draw_references(
    configuration: Configuration, layout: Layout, lower_corner: Array, upper_corner: Array, arrows: Sequence[Arrows]
) -> Iterator[tuple[list[Shape], Label]]:
    """Yield shapes and label of each reference: gravity, the scale of lengths, and a reference arrow for each kind of
    arrow.

    Gravity is in the upper left corner of the box, if there is gravity. The scale is below the box, the arrows below
    the scale.
    """
    unit = layout.unit
    if (gravity := find_gravity_direction(configuration)) is not None:
        centre = np.array([lower_corner[0] + 1.5 * unit, upper_corner[1] - 2.5 * unit])
        shapes = list(
            draw_arrow(
                "gravity", "gravity", centre - 2.0 * unit * gravity, centre + 2.0 * unit * gravity, HEAD_LENGTH * unit
            )
        )
        yield shapes, Label("gravity", "gravity", "g", centre, 0.6 * unit, 0.0)
    box_size = upper_corner - lower_corner
    length = find_round_number(min(0.22 * float(box_size.max()), 0.6 * float(box_size[0])))
    start = np.array([lower_corner[0] + 0.5 * unit, lower_corner[1] - 1.0 * unit])
    end = start + [length, 0.0]
    tick = np.array([0.0, 0.5 * unit])
    bar = np.array([start + tick, start - tick, start, end, end + tick, end - tick])
    yield [Line("scale", "scale", bar)], Label("scale", "scale", format_length(length), end, 0.6 * unit, 0.0)
    for k, kind in enumerate(kind for kind in arrows if kind.length > 0.0):
        tail = start - [0.0, 2.6 * unit * (k + 1)]
        tip = tail + [kind.length, 0.0]
        yield (
            list(draw_arrow(f"scale {kind.role}", kind.role, tail, tip, HEAD_LENGTH * unit)),
            Label(f"scale {kind.role}", "scale", f"{kind.role}{kind.on}: {kind.text}", tip, 0.6 * unit, 0.0),
        )


def format_length(length: float) -> str:
    """Return a round length in mm or m."""
    return f"{1e3 * length:g} mm" if length < 1.0 else f"{length:g} m"


def draw_joints(configuration: Configuration, layout: Layout) -> Iterator[Shape]:
    """Yield the shapes of all joints, drawn by the symbols of their kinds."""
    for part in configuration.iterate_parts("joints"):
        pen = Pen(configuration, part, layout)
        get_joint_type(part).symbol.draw(pen)
        yield from pen.shapes


def label_joints(configuration: Configuration, layout: Layout, arrow_radii: Mapping[str, float]) -> Iterator[Label]:
    """Yield the label of each joint, outside of the arrows around it.

    `arrow_radii` are the radii in units of these arrows, by joint. The label of a joint on a rail lies beyond the rail.
    """
    for part in configuration.iterate_parts("joints"):
        symbol = get_joint_type(part).symbol
        position = symbol.find_name_position(JointGeometry(configuration, part))
        clearance, angle = max(symbol.name_distance, arrow_radii.get(part.name, 0.0)), 45.0
        if has_rail(part) and part.name in layout.ground_directions:  # beyond the rail, away from the slider
            x, y = layout.ground_directions[part.name]
            clearance, angle = BLOCK_HALF_SIZE[1] + 1.2, float(np.degrees(np.arctan2(y, x)))
            clearance += compute_wall_gap(configuration, part, layout.unit) / layout.unit
        yield Label(f"joint {part.name}", "joint", part.name, position, clearance * layout.unit, angle)

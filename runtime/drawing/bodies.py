"""Draw bodies: links between two pins, plates through more, blocks on their guides."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.configuration import Configuration, find_outline_points, get_body_name, remove_repeated_positions
from gudgeon.drawing.joint_geometry import (
    compute_guide_directions,
    compute_wall_gap,
    find_guide_and_slider,
    find_sliding_axis,
    is_block,
    iterate_sliding_joints,
)
from gudgeon.drawing.layout import Layout
from gudgeon.drawing.shapes import Disc, Label, Line, Shape, compute_rectangle, compute_rounded_outline
from gudgeon.model.compiled import Array

BLOCK_HALF_SIZE = (2.1, 1.25)  # half length and width of a slider, in units
SLOT_HALF_WIDTH, BAR_HALF_WIDTH = 1.0, 0.55  # half widths: of a slotted link, of a bar that guides


def draw_bodies(
    configuration: Configuration, layout: Layout, unconnected_bodies: frozenset[str] = frozenset()
) -> Iterator[Shape]:
    """Yield the outlines of every body of a scene, closed lines, and dots of its named points.

    Bodies in `unconnected_bodies` have the colour of an error.
    """
    for colour_index, body in enumerate(configuration.bodies):
        for role, outline in _iterate_outlines(configuration, layout, body):
            yield Line(
                f"body {body}",
                "loose" if body in unconnected_bodies and role == "body" else role,
                outline,
                True,
                colour_index,
            )
        yield from _draw_point_marks(configuration, layout, body, colour_index)


def _iterate_outlines(configuration: Configuration, layout: Layout, body: str) -> Iterator[tuple[str, Array]]:
    """Yield role and closed outline (N, 2) of a body: its link or plate, its guides for other bodies, its blocks.

    The role is "body"; a guide with a visible gap gives "guide" for its walls and "channel" for the space between them.
    A body with a guide or block whose points coincide has no link or plate.
    """
    unit, positions = layout.unit, remove_repeated_positions(find_outline_points(configuration, body).values())
    guide_parts, block_parts = [], []
    for part in iterate_sliding_joints(configuration):
        guide, slider = map(get_body_name, find_guide_and_slider(part))
        if guide == body:
            guide_parts.append(part)
        if slider == body and is_block(part):
            block_parts.append(part)
    if not ((block_parts or guide_parts) and _has_one_position(configuration, body)):
        yield "body", compute_rounded_outline(positions, unit if len(positions) > 1 else 1.6 * unit)
    for part in guide_parts:
        ends = compute_guide_ends(configuration, layout, part)
        if wall_gap := compute_wall_gap(configuration, part, unit):
            yield "guide", compute_rounded_outline(ends, BLOCK_HALF_SIZE[1] * unit + wall_gap + 0.55 * unit)
            yield "channel", compute_rounded_outline(ends, BLOCK_HALF_SIZE[1] * unit + wall_gap)
        else:
            yield (
                "body",
                compute_rounded_outline(ends, (BAR_HALF_WIDTH if is_block(part) else SLOT_HALF_WIDTH + 0.55) * unit),
            )
    for part in block_parts:
        yield (
            "body",
            compute_rectangle(
                find_sliding_axis(configuration, part)[2],
                compute_guide_directions(configuration, part)[1],
                BLOCK_HALF_SIZE[0] * unit,
                BLOCK_HALF_SIZE[1] * unit,
            ),
        )


def _has_one_position(configuration: Configuration, body: str) -> bool:
    """Return whether all joints and named points of a body are at one position."""
    names = [name for name in find_outline_points(configuration, body) if not name.endswith(".com")]
    return len(remove_repeated_positions(configuration.get_position(name) for name in names)) < 2


def compute_guide_ends(configuration: Configuration, layout: Layout, part: PartInfo) -> list[Array]:
    """Return both ends of a slot or guide bar, two points (2,) in m, as far as the slider travels.

    They extend to the guiding body's point on the line, except for a slot that lies on one of the body's links.
    """
    line_point, axis, _ = find_sliding_axis(configuration, part)
    low_coordinate, high_coordinate = layout.travel[part.name]
    overhang = (BLOCK_HALF_SIZE[0] + 0.6 if is_block(part) else 1.6) * layout.unit
    low_coordinate, high_coordinate = low_coordinate - overhang, high_coordinate + overhang
    guide = get_body_name(find_guide_and_slider(part)[0])
    if is_block(part) or not _is_on_link(
        configuration, guide, line_point + low_coordinate * axis, line_point + high_coordinate * axis
    ):
        low_coordinate, high_coordinate = min(low_coordinate, 0.0), max(high_coordinate, 0.0)
    return [line_point + low_coordinate * axis, line_point + high_coordinate * axis]


def _is_on_link(configuration: Configuration, body: str, *ends: Array) -> bool:
    """Return whether the ends of a slot lie on the straight link between two points of its body.

    The slot may extend beyond the link, but must overlap it.
    """
    positions = remove_repeated_positions(find_outline_points(configuration, body).values())
    for k, begin in enumerate(positions):
        for end_point in positions[:k]:
            span = end_point - begin
            fractions = [float((end - begin) @ span / (span @ span)) for end in ends]
            distances = [
                float(np.hypot(*(end - begin - fraction * span))) for end, fraction in zip(ends, fractions, strict=True)
            ]
            if max(distances) < 1e-3 * float(np.hypot(*span)) and min(fractions) < 1.0 and max(fractions) > 0.0:
                return True
    return False


def _draw_point_marks(configuration: Configuration, layout: Layout, body: str, colour_index: int) -> Iterator[Shape]:
    """Yield a small dot for each named point of a body that no joint, drive or force element uses.

    Points called head, tail, origin or com get none. `colour_index` is the index of the body's colour.
    """
    used_points = {end for part in configuration.source.parts for end in part.ends}
    for name in configuration.points:
        owner, _, point = name.partition(".")
        if owner == body and name not in used_points and point not in ("head", "tail", "origin", "com"):
            yield Disc(f"point {name}", "mark", configuration.get_position(name), 0.22 * layout.unit, colour_index)


def label_bodies(configuration: Configuration, layout: Layout) -> Iterator[Label]:
    """Yield the label of each body at the mean of its points, then the labels of named points that have a dot."""
    for body in configuration.bodies:
        positions = remove_repeated_positions(find_outline_points(configuration, body).values())
        mean_position = np.mean(positions, axis=0)
        yield Label(f"body {body}", "body", body, mean_position, 1.2 * layout.unit)
    for shape in (
        shape for body in configuration.bodies for shape in _draw_point_marks(configuration, layout, body, 0)
    ):
        yield Label(shape.part, "point", shape.part.rpartition(".")[2], shape.centre, 0.4 * layout.unit)  # type: ignore[union-attr]

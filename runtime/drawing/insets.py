"""Draw insets that magnify joints with play next to the mechanism: journal in bearing, slider in guide."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.drawing.configuration import Configuration
from gudgeon.drawing.joint_geometry import compute_corner_approaches, find_sliding_axis, find_touching_corners
from gudgeon.drawing.layout import is_visible_to_scale
from gudgeon.drawing.shapes import Disc, Label, Line, Shape, compute_rectangle, rotate_quarter_turn
from gudgeon.language.plot_units import choose_prefix
from gudgeon.model.compiled import Array

DASHED_NOTE = " (dashed: as far as the journal's centre may go)"
INSET_RADIUS, JOURNAL_FRACTION = 5.0, 0.4  # radius of an inset's hole in units; of the journal as a fraction of that
# fractions of the inset's radius
SLIDER_HALF_LENGTH, SLIDER_HALF_HEIGHT, GAP_FRACTION, WALL_HALF_THICKNESS, CORNER_RADIUS = 0.9, 0.34, 0.26, 0.06, 0.06


def compute_eccentricity(configuration: Configuration, joint: str) -> Array:
    """Return the vector from the bearing's centre to the journal's, (2,), m, ground axes."""
    first, second = next(configuration.find_parts(joint)).ends
    return configuration.get_position(second) - configuration.get_position(first)


def find_contacts(configuration: Configuration) -> frozenset[str]:
    """Return the joints and the slider corners with play whose surfaces overlap, by name.

    A joint overlaps if its eccentricity is at least its clearance. Joints that only have a film never do.
    """
    clearances = {
        name: float(configuration.p[joint.clearance]) for name, joint in configuration.clearances.items() if joint.dry
    }
    joints = (
        name
        for name, clearance in clearances.items()
        if float(np.hypot(*compute_eccentricity(configuration, name))) >= clearance
    )
    return frozenset(joints) | find_touching_corners(configuration)


def compute_magnification(configuration: Configuration, joint: str, unit: float) -> float:
    """Return the factor by which an inset magnifies the drawing, rounded down to two digits.

    With it, the clearance or gap of the joint fits the inset. `unit` is half a bar's width in m.
    """
    fraction = GAP_FRACTION if joint in configuration.guides else 1.0 - JOURNAL_FRACTION
    exact_factor = INSET_RADIUS * fraction * unit / configuration.get_clearance(joint)
    step = 10.0 ** (np.floor(np.log10(exact_factor)) - 1.0)
    return float(np.floor(exact_factor / step) * step)


def draw_insets(
    configuration: Configuration,
    unit: float,
    lower_corner: Array,
    upper_corner: Array,
    contact_names: frozenset[str] = frozenset(),
    earlier_contact_names: frozenset[str] = frozenset(),
) -> Iterator[tuple[list[Shape], Label, str]]:
    """Yield shapes, label and note of the inset of each joint with play that is not visible to scale.

    Insets are in columns to the right of the box, or in rows below it if more fit there. Gap and eccentricity are to
    scale; radii and a slider's lengths are not. `contact_names`: joints and corners in contact, drawn red;
    `earlier_contact_names`: others that were in contact since the previous picture, with a red bearing or wall.
    """
    radius = INSET_RADIUS * unit
    joint_names = dict.fromkeys(joint.joint for joint in configuration.source.clearances)
    inset_joints = [name for name in joint_names if not is_visible_to_scale(configuration, name, unit)]
    for joint, centre in zip(
        inset_joints, _place_insets(len(inset_joints), radius, lower_corner, upper_corner), strict=True
    ):
        clearance, factor = configuration.get_clearance(joint), compute_magnification(configuration, joint, unit)
        draw_inset = _draw_slider if joint in configuration.guides else _draw_journal
        shapes, eccentricity_ratio, label_distance = draw_inset(
            configuration, joint, centre, radius, contact_names, earlier_contact_names - contact_names
        )
        label_text = f"{joint} ×{factor:g}, e/c = {eccentricity_ratio:.2f}"
        unit_factor, unit_text = choose_prefix(clearance, "m")
        quantity, suffix = ("gap", " on each side") if joint in configuration.guides else ("clearance", "")
        note = f"{joint}: {quantity} {clearance * unit_factor:.4g} {unit_text}{suffix}, drawn ×{factor:g}"
        remark = DASHED_NOTE * (joint == next((name for name in inset_joints if name in configuration.clearances), ""))
        yield (
            shapes,
            Label(f"inset {joint}", "inset", label_text, centre - [0.0, label_distance], 0.0, 270.0),
            note + remark,
        )


def _draw_journal(
    configuration: Configuration,
    joint: str,
    centre: Array,
    radius: float,
    contact_names: frozenset[str],
    earlier_contact_names: frozenset[str],
) -> tuple[list[Shape], float, float]:
    """Return shapes of a journal in its bearing, the eccentricity ratio, and the distance of the label below the centre
    (m).

    `centre` and `radius` (m) are those of the inset. The bearing is red if `joint` is in `earlier_contact_names`, the
    journal if it is in `contact_names`. A line joins the centres of bearing and journal.
    """
    clearance, factor = (
        configuration.get_clearance(joint),
        compute_magnification(configuration, joint, radius / INSET_RADIUS),
    )
    eccentricity_vector = compute_eccentricity(configuration, joint)
    part, hole_radius = f"inset {joint}", clearance * factor + JOURNAL_FRACTION * radius
    journal_centre = centre + factor * eccentricity_vector
    shapes: list[Shape] = [
        Disc(part, "touched" if joint in earlier_contact_names else "bearing", centre, 1.16 * hole_radius),
        Disc(part, "hole", centre, hole_radius),
        Disc(part, "touching" if joint in contact_names else "journal", journal_centre, JOURNAL_FRACTION * radius),
        Disc(part, "clearance", centre, clearance * factor),
        Line(part, "scale", np.array([centre, journal_centre])),
    ]
    return shapes, float(np.hypot(*eccentricity_vector)) / clearance, 1.2 * hole_radius


def _draw_slider(
    configuration: Configuration,
    joint: str,
    centre: Array,
    radius: float,
    contact_names: frozenset[str],
    earlier_contact_names: frozenset[str],
) -> tuple[list[Shape], float, float]:
    """Return shapes of a slider in its guide, the largest e/c of its corners, and the distance of the label below the
    centre (m).

    The two walls are along the axis; a wall or corner in contact is red. Gaps between corners and walls are magnified.
    """
    clearance, factor = (
        configuration.get_clearance(joint),
        compute_magnification(configuration, joint, radius / INSET_RADIUS),
    )
    _, axis, _ = find_sliding_axis(configuration, next(configuration.find_parts(joint)))
    part, normal, corner_approaches = (
        f"inset {joint}",
        rotate_quarter_turn(axis),
        compute_corner_approaches(configuration, joint),
    )
    wall_distance = SLIDER_HALF_HEIGHT * radius + clearance * factor + WALL_HALF_THICKNESS * radius
    shapes: list[Shape] = []
    for sign, wall_name in ((1.0, "upper"), (-1.0, "lower")):
        is_red = any(name in earlier_contact_names for name in corner_approaches if wall_name in name)
        wall = compute_rectangle(
            centre + sign * wall_distance * normal, axis, 1.16 * radius, WALL_HALF_THICKNESS * radius
        )
        shapes.append(Line(part, "touched" if is_red else "bearing", wall, True))
    corner_positions = {
        name: centre
        + (SLIDER_HALF_LENGTH if "front" in name else -SLIDER_HALF_LENGTH) * radius * axis
        + (1.0 if "upper" in name else -1.0) * (SLIDER_HALF_HEIGHT * radius + factor * approach) * normal
        for name, approach in corner_approaches.items()
    }
    upper, lower = (
        [position for name, position in corner_positions.items() if wall_name in name]
        for wall_name in ("upper", "lower")
    )
    shapes.append(Line(part, "journal", np.array([*upper, *reversed(lower)]), True))
    for name, position in corner_positions.items():
        shapes.append(Disc(part, "touching" if name in contact_names else "journal", position, CORNER_RADIUS * radius))
    label_distance = (
        1.16 * abs(axis[1]) * radius + abs(normal[1]) * (wall_distance + WALL_HALF_THICKNESS * radius) + 0.2 * radius
    )
    return shapes, max(corner_approaches.values()) / clearance, float(label_distance)


def _place_insets(n: int, radius: float, lower_corner: Array, upper_corner: Array) -> Iterator[Array]:
    """Yield the centres of n insets of a radius (m) outside of the box from `lower_corner` to `upper_corner`.

    They are in columns to the right of the box; in rows below it if one column is not enough and a row holds more.
    """
    n_rows = max(1, int((upper_corner[1] - lower_corner[1]) / (3.1 * radius)))
    width = float(upper_corner[0] - lower_corner[0])
    spacing = max(3.6 * radius, min(5.5 * radius, width / max(n, 1)))
    n_columns = max(1, int(width / spacing))
    for k in range(n):
        if n > n_rows and n_columns > n_rows:
            row, column = divmod(k, n_columns)
            yield np.array(
                [lower_corner[0] + 1.8 * radius + spacing * column, lower_corner[1] - (1.6 + 3.1 * row) * radius]
            )
        else:
            column, row = divmod(k, n_rows)
            yield np.array(
                [upper_corner[0] + (2.0 + 3.2 * column) * radius, upper_corner[1] - (1.25 + 3.1 * row) * radius]
            )

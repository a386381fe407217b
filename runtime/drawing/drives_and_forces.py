"""Draw drives and force elements: springs, dampers, forces, torques, friction, gravity."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.bodies import BLOCK_HALF_SIZE
from gudgeon.drawing.configuration import GROUND, Configuration, get_body_name
from gudgeon.drawing.joint_geometry import find_pivot_joint, find_sliding_axis, has_rail, iterate_sliding_joints
from gudgeon.drawing.layout import Layout
from gudgeon.drawing.pen import PIN_RADIUS, draw_ground_wall
from gudgeon.drawing.shapes import (
    Disc,
    Label,
    Line,
    Shape,
    compute_arc,
    compute_arrow_head,
    compute_rectangle,
    compute_zigzag,
    rotate_quarter_turn,
    unit_vector,
)
from gudgeon.model.compiled import Array

ARROW_LENGTH, HEAD_LENGTH = 5.2, 1.3  # units: an arrow that is not to scale, and its head
DRIVE_RADIUS, TORQUE_RADIUS, SPIRAL_RADIUS = 2.3, 3.1, 1.9  # units: round arrows of drives and torques; spiral springs
RADIUS_BY_KIND = {
    "angle": DRIVE_RADIUS,
    "coordinate": DRIVE_RADIUS,
    "torque": TORQUE_RADIUS,
    "rotational_spring_damper": SPIRAL_RADIUS,
}
MIN_PARALLEL_COSINE = 0.5  # cosine above which a guide counts as parallel to a coordinate


def draw_drives_and_forces(configuration: Configuration, layout: Layout) -> Iterator[Shape]:
    """Yield the shapes of drives, then of force elements."""
    for part in configuration.iterate_parts("drives"):
        yield from _DRIVES[part.kind](configuration, layout, part)
    for part in configuration.iterate_parts("forces"):
        yield from _FORCES.get(part.kind, _draw_generic_element)(configuration, layout, part)


def label_drives_and_forces(configuration: Configuration, layout: Layout, shows_zero_loads: bool) -> Iterator[Label]:
    """Yield the label of each drive, then of each force element.

    With `shows_zero_loads`, a force or torque whose load is zero has the label "NAME = 0".
    """
    for part in (*configuration.iterate_parts("drives"), *configuration.iterate_parts("forces")):
        kind = part.section[:-1]
        direction = 45.0
        if part.kind in ("distance", "spring_damper"):
            position, clearance = (
                0.5 * (configuration.get_position(part.ends[0]) + configuration.get_position(part.ends[1])),
                1.2,
            )
        elif part.kind == "coordinate" and part.options["coordinate"] != "theta":
            (position, direction_vector), clearance = _find_arrow_position(configuration, layout, part), 0.5
            direction = float(np.degrees(np.arctan2(direction_vector[1], direction_vector[0])))
        elif part.kind == "force":
            arrow_vector = _compute_arrow_vector(configuration, layout, part)
            position, clearance = (
                configuration.get_position(part.ends[0]) + 0.5 * arrow_vector,
                0.5 if arrow_vector.any() else 1.2,
            )
            direction = (
                float(np.degrees(np.arctan2(arrow_vector[0], -arrow_vector[1]))) if arrow_vector.any() else direction
            )
        elif part.kind == "dry_friction":
            position, clearance = configuration.get_position(part.ends[1]), 2.0
        else:
            position = find_pivot(configuration, part)
            clearance = RADIUS_BY_KIND[part.kind]
        is_zero = (
            shows_zero_loads
            and part.kind in ("force", "torque")
            and not np.any(configuration.loads.get(part.name, 1.0))
        )
        text = f"{part.name} = 0" if is_zero else part.name
        yield Label(f"{kind} {part.name}", kind, text, position, clearance * layout.unit, direction)


def draw_arrow(part: str, role: str, tail: Array, tip: Array, head_length: float) -> Iterator[Shape]:
    """Yield line and head of a straight arrow from `tail` to `tip`; the line ends within the head.

    `head_length` is the length of the head in m. The head has the role "ROLE head".
    """
    direction = unit_vector(tip - tail)
    yield Line(part, role, np.array([tail, tip - 0.8 * head_length * direction]))
    yield Line(part, f"{role} head", compute_arrow_head(tip, direction, head_length), True)


def draw_round_arrow(
    part: str, role: str, centre: Array, radius: float, is_counterclockwise: bool, head_length: float
) -> Iterator[Shape]:
    """Yield line and head of an arrow along an arc of 220° around a point.

    It turns counterclockwise if `is_counterclockwise`, else clockwise. `radius` and `head_length` are in m.
    """
    start_angle, end_angle = np.radians([-25.0, 195.0]) if is_counterclockwise else np.radians([205.0, -15.0])
    points = compute_arc(centre, radius, float(start_angle), float(end_angle), 33)
    arc_end = compute_arc(centre, radius, float(end_angle), float(end_angle), 1)[0]
    tangent = rotate_quarter_turn(unit_vector(arc_end - centre)) * (1.0 if is_counterclockwise else -1.0)
    yield Line(part, role, points)
    yield Line(
        part, f"{role} head", compute_arrow_head(arc_end + 0.9 * head_length * tangent, tangent, head_length), True
    )


def find_pivot(configuration: Configuration, part: PartInfo) -> Array:
    """Return the point about which the body of a drive or force element turns, (2,), in m.

    It is a joint between the body and the other one or the ground, or else the body's centre of mass. For the ground
    without such a joint it is the origin.
    """
    joint, body = _find_pivot_joint_and_body(configuration, part)
    if joint is not None:
        return configuration.get_position(next(end for end in joint.ends if get_body_name(end) == body))
    return configuration.get_centre_of_mass(body) if body in configuration.bodies else np.zeros(2)


def compute_arrow_radii(configuration: Configuration) -> dict[str, float]:
    """Return the radius, in units, of the largest arrow or spiral spring around each joint that has one, by joint.

    Used to place the joints' names outside of them.
    """
    radii = dict[str, float]()
    for part in (*configuration.iterate_parts("drives"), *configuration.iterate_parts("forces")):
        if part.kind in RADIUS_BY_KIND and part.options.get("coordinate", "theta") == "theta":
            joint, _ = _find_pivot_joint_and_body(configuration, part)
            if joint is not None:
                radii[joint.name] = max(radii.get(joint.name, 0.0), RADIUS_BY_KIND[part.kind])
    return radii


def _find_pivot_joint_and_body(configuration: Configuration, part: PartInfo) -> tuple[PartInfo | None, str]:
    """Return the pivot joint and the name of the rotating body of a drive or force element; None without such a joint.

    The body is the first one that is not the ground; the joint connects it with the element's other body or the ground.
    """
    bodies = [get_body_name(end) for end in part.ends]
    turning_body = next((body for body in bodies if body != GROUND), bodies[0])
    other_body = next((body for body in bodies if body != turning_body), GROUND)
    return find_pivot_joint(configuration, turning_body, other_body), turning_body


def _draw_angle_drive(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield the arrow of a driven angle around its pivot, counterclockwise if the angle grows.

    The rate is that of the first body relative to the second, or to the ground; an unknown rate counts as growing.
    """
    rate = configuration.get_angular_velocity(get_body_name(part.ends[0]))
    rate -= configuration.get_angular_velocity(get_body_name(part.ends[1])) if len(part.ends) > 1 else 0.0
    centre, u = find_pivot(configuration, part), layout.unit
    yield from draw_round_arrow(f"drive {part.name}", "drive", centre, DRIVE_RADIUS * u, rate >= 0.0, HEAD_LENGTH * u)


def _draw_coordinate_drive(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield the arrow of a driven coordinate in the direction of its rate.

    An angle is drawn like an angle drive. An unknown rate counts as positive.
    """
    if (axis := part.options["coordinate"]) == "theta":
        yield from _draw_angle_drive(configuration, layout, part)
        return
    index = configuration.bodies[get_body_name(part.ends[0])].index + "xy".index(axis)
    direction = np.eye(2)["xy".index(axis)] * (
        -1.0 if configuration.v is not None and configuration.v[index] < 0.0 else 1.0
    )
    (middle, _), half_arrow = (
        _find_arrow_position(configuration, layout, part),
        0.5 * ARROW_LENGTH * layout.unit * direction,
    )
    yield from draw_arrow(
        f"drive {part.name}", "drive", middle - half_arrow, middle + half_arrow, HEAD_LENGTH * layout.unit
    )


def _find_arrow_position(configuration: Configuration, layout: Layout, part: PartInfo) -> tuple[Array, Array]:
    """Return the middle (2,), m, of the arrow of a driven coordinate x or y, and the unit vector of its offset.

    The arrow lies above the point (for y: left of it). For a body that slides on the ground along the coordinate, it
    lies next to the block, on the side away from the ground.
    """
    axis = np.eye(2)["xy".index(part.options["coordinate"])]
    position, normal = configuration.get_position(part.ends[0]), rotate_quarter_turn(axis)
    for joint in iterate_sliding_joints(configuration):
        if joint.name in layout.ground_directions and get_body_name(part.ends[0]) in map(get_body_name, joint.ends):
            _, line_direction, slider = find_sliding_axis(configuration, joint)
            if abs(float(line_direction @ axis)) > MIN_PARALLEL_COSINE:
                position, normal = (
                    slider,
                    -normal if float(layout.ground_directions[joint.name] @ normal) > 0.0 else normal,
                )
    return position + 2.0 * layout.unit * normal, normal


def _draw_cylinder(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield the symbol of a driven distance: a hydraulic cylinder with barrel, piston, rod, and a pin at each end.

    It joins both points of the drive; lengths along its axis are fractions of their distance. Ends on the ground get
    the symbol of the ground.
    """
    name, u = f"drive {part.name}", layout.unit
    begin, end = (configuration.get_position(point) for point in part.ends)
    axis, length = unit_vector(end - begin), float(np.hypot(*(end - begin)))
    yield from _draw_ground_ends(configuration, part, name, layout)
    yield Line(name, "piston", np.array([begin + 0.5 * length * axis, end]))
    yield Line(name, "barrel", compute_rectangle(begin + 0.34 * length * axis, axis, 0.27 * length, 0.85 * u), True)
    yield Line(name, "drive", np.array([begin, begin + 0.07 * length * axis]))
    head = begin + 0.5 * length * axis
    yield Line(
        name,
        "piston",
        np.array([head - 0.85 * u * rotate_quarter_turn(axis), head + 0.85 * u * rotate_quarter_turn(axis)]),
    )
    yield from (Disc(name, "pin", position, 0.8 * PIN_RADIUS * u) for position in (begin, end))


def _draw_ground_ends(configuration: Configuration, part: PartInfo, owner: str, layout: Layout) -> Iterator[Shape]:
    """Yield a hatched wall at each end of a drive or force element on the ground where no joint draws the ground.

    `owner` is the part to which the shapes belong, such as "force S1".
    """
    joint_ends = {end for joint in configuration.iterate_parts("joints") if not has_rail(joint) for end in joint.ends}
    for end in part.ends:
        if get_body_name(end) == GROUND and end not in joint_ends:
            yield from draw_ground_wall(
                owner, configuration.get_position(end), layout.ground_directions[part.name], layout.unit
            )


def _draw_spring_damper(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield a spring, a damper, or both in parallel, between the two points of an element.

    An element without stiffness and damping is drawn as a spring. Between coincident points only dots are drawn. If the
    element lies along a ground rail, both symbols are on the side away from the ground.
    """
    name, u = f"force {part.name}", layout.unit
    begin, end = (configuration.get_position(point) for point in part.ends)
    yield from _draw_ground_ends(configuration, part, name, layout)
    yield from (Disc(name, "mark", position, 0.26 * u) for position in (begin, end))
    if float(np.hypot(*(end - begin))) < 1e-6 * u:
        return
    has_spring, has_damper = (
        configuration.get_parameter(f"forces.{part.name}.{key}") != 0.0 for key in ("stiffness", "damping")
    )
    offset = 1.15 * u * rotate_quarter_turn(unit_vector(end - begin)) if has_spring and has_damper else np.zeros(2)
    ground_side = _find_ground_side(configuration, layout, part, begin, end)
    if has_spring and has_damper and ground_side is not None:  # both next to the rail
        offset = -1.15 * u * ground_side
        begin, end, attachments = begin + offset, end + offset, (begin, end)
    else:
        attachments = begin, end
    if has_spring or not has_damper:
        free_length = configuration.get_parameter(f"forces.{part.name}.free_length") or float(np.hypot(*(end - begin)))
        teeth = int(np.clip(round(0.35 * free_length / u), 4, 14))
        points = compute_zigzag(
            begin + 0.12 * (end - begin), begin + 0.88 * (end - begin), 0.9 * u, teeth, 0.12 if has_damper else 0.05
        )
        points = np.vstack([begin, points + offset, end]) if not has_damper else points + offset
        yield Line(name, "spring", points)
    if has_damper:
        yield from _draw_damper(name, begin + 0.12 * (end - begin) - offset, begin + 0.88 * (end - begin) - offset, u)
    if has_spring and has_damper:
        for attachment, fraction in zip(attachments, (0.12, 0.88), strict=True):
            beam_centre = begin + fraction * (end - begin)
            yield Line(name, "spring", np.array([beam_centre - offset, beam_centre + offset]))
            yield Line(name, "spring", np.array([attachment, attachments[0] + fraction * (end - begin)]))


def _find_ground_side(
    configuration: Configuration, layout: Layout, part: PartInfo, begin: Array, end: Array
) -> Array | None:
    """Return the direction of the ground, a unit vector, if an element lies along a ground rail; else None.

    The rail is that of a sliding joint between the bodies of the element. Both points `begin` and `end` must be within
    half a bar's width of its line.
    """
    bodies = {get_body_name(end) for end in part.ends}
    for joint in iterate_sliding_joints(configuration):
        if (
            has_rail(joint)
            and joint.name in layout.ground_directions
            and bodies == {get_body_name(end) for end in joint.ends}
        ):
            line_point, axis, _ = find_sliding_axis(configuration, joint)
            if (
                max(abs(float((point - line_point) @ rotate_quarter_turn(axis))) for point in (begin, end))
                < layout.unit
            ):
                return layout.ground_directions[joint.name]
    return None


def _draw_damper(owner: str, begin: Array, end: Array, unit: float) -> Iterator[Shape]:
    """Yield the symbol of a damper between two points: a piston in a cylinder that is open on one side.

    `owner` is the part to which the shapes belong, `unit` half a bar's width in m.
    """
    axis, middle = unit_vector(end - begin), 0.5 * (begin + end)
    half_width = 0.75 * unit * rotate_quarter_turn(axis)
    half_length = min(1.6 * unit, 0.3 * float(np.hypot(*(end - begin))))
    cylinder_bottom, cylinder_top = middle - half_length * axis, middle + half_length * axis
    yield Line(
        owner,
        "spring",
        np.array(
            [
                cylinder_top + half_width,
                cylinder_bottom + half_width,
                cylinder_bottom - half_width,
                cylinder_top - half_width,
            ]
        ),
    )
    yield Line(owner, "spring", np.array([begin, cylinder_bottom]))
    yield Line(owner, "spring", np.array([middle, end]))
    yield Line(owner, "piston", np.array([middle - 0.85 * half_width, middle + 0.85 * half_width]))


def _draw_spiral_spring(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield a spiral spring of 2.25 turns around the pivot of a rotational spring or damper."""
    angle, centre = np.linspace(0.0, 4.5 * np.pi, 90), find_pivot(configuration, part)
    radius = layout.unit * np.linspace(0.6, SPIRAL_RADIUS, len(angle))
    yield Line(
        f"force {part.name}", "spring", centre + np.column_stack([np.cos(angle), np.sin(angle)]) * radius[:, None]
    )


def _draw_torque(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield the round arrow of a torque around its pivot; clockwise only if the torque is negative."""
    is_counterclockwise = configuration.loads.get(part.name, (1.0, 0.0))[0] >= 0.0
    centre, unit = find_pivot(configuration, part), layout.unit
    yield from draw_round_arrow(
        f"force {part.name}", "force", centre, TORQUE_RADIUS * unit, is_counterclockwise, HEAD_LENGTH * unit
    )


def _draw_force(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield the arrow of a force that begins at its point; a ring if the force is zero or unknown."""
    name, unit, point = f"force {part.name}", layout.unit, configuration.get_position(part.ends[0])
    arrow_vector = _compute_arrow_vector(configuration, layout, part)
    if not arrow_vector.any():
        yield Disc(name, "no force", point, 0.9 * unit)
        return
    yield from draw_arrow(
        name, "force", point, point + arrow_vector, min(HEAD_LENGTH * unit, 0.6 * float(np.hypot(*arrow_vector)))
    )


def _compute_arrow_vector(configuration: Configuration, layout: Layout, part: PartInfo) -> Array:
    """Return the drawn vector of a force from tail to tip, (2,), in m of the drawing; 0 if the force is zero or
    unknown.

    Its length is proportional to the force if the layout has a scale, otherwise the same for all forces.
    """
    load = np.array(configuration.loads.get(part.name, (0.0, 0.0)))
    if not (np.isfinite(load).all() and load.any()):
        return np.zeros(2)
    return (
        load * layout.metres_per_newton
        if layout.metres_per_newton > 0.0
        else ARROW_LENGTH * layout.unit * unit_vector(load)
    )


def _draw_dry_friction(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield a zigzag line under the second body's point, and for a moving surface the arrow of its speed.

    The line is along the friction direction, half a block's height below the point. There is no arrow if the parameter
    `speed` is 0.
    """
    name, u = f"force {part.name}", layout.unit
    line_direction = configuration.compute_direction(part, "direction", get_body_name(part.ends[0]))
    down = (
        -rotate_quarter_turn(line_direction)
        if rotate_quarter_turn(line_direction)[1] >= 0.0
        else rotate_quarter_turn(line_direction)
    )
    centre = configuration.get_position(part.ends[1]) + BLOCK_HALF_SIZE[1] * u * down
    points = compute_zigzag(centre - 2.0 * u * line_direction, centre + 2.0 * u * line_direction, 0.3 * u, 7, 0.0)
    yield Line(name, "rough", points - 0.1 * u * down)
    if (speed := configuration.get_parameter(f"forces.{part.name}.speed")) != 0.0:
        direction, arrow_centre = line_direction * np.sign(speed), centre + 2.3 * u * down
        yield from draw_arrow(
            name,
            "force",
            arrow_centre - 0.5 * ARROW_LENGTH * u * direction,
            arrow_centre + 0.5 * ARROW_LENGTH * u * direction,
            HEAD_LENGTH * u,
        )


def _draw_generic_element(configuration: Configuration, layout: Layout, part: PartInfo) -> Iterator[Shape]:
    """Yield a line with a dot at each end, for a force element of a kind without a symbol."""
    positions = [configuration.get_position(end) for end in part.ends]
    yield Line(f"force {part.name}", "spring", np.array(positions))
    yield from (Disc(f"force {part.name}", "mark", position, 0.3 * layout.unit) for position in positions)


_DRIVES = {"angle": _draw_angle_drive, "coordinate": _draw_coordinate_drive, "distance": _draw_cylinder}
_FORCES = {
    "spring_damper": _draw_spring_damper,
    "rotational_spring_damper": _draw_spiral_spring,
    "torque": _draw_torque,
    "force": _draw_force,
    "dry_friction": _draw_dry_friction,
}


def find_gravity_direction(configuration: Configuration) -> Array | None:
    """Return the direction of gravity, a unit vector in ground axes; None without gravity."""
    g = np.array([configuration.get_parameter("gravity.x"), configuration.get_parameter("gravity.y")])
    return unit_vector(g) if float(np.hypot(*g)) > 0.0 else None

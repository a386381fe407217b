"""Draw drives and force elements: springs, dampers, forces, torques, friction, gravity."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.bodies import BLOCK
from gudgeon.drawing.joint_at import axis_of, has_rail, pivot_between, sliding
from gudgeon.drawing.pen import PIN, ground_wall
from gudgeon.drawing.plan import Plan
from gudgeon.drawing.posture import GROUND, Posture, body_of
from gudgeon.drawing.shapes import Disc, Label, Line, Shape, arc, arrow_head, rectangle, turned, unit_vector, zigzag
from gudgeon.model.compiled import Array

ARROW, HEAD = 5.2, 1.3  # lengths in units: of an arrow whose size means nothing, and of its head
DRIVEN, LOADED, WOUND = 2.3, 3.1, 1.9  # radii of arrows around a pin: a drive's, a torque's; of a spiral spring
RADII = {"angle": DRIVEN, "coordinate": DRIVEN, "torque": LOADED, "rotational_spring_damper": WOUND}
ALONG = 0.5  # cosine above which a guide counts as parallel to a coordinate


def draw_drives_and_forces(posture: Posture, plan: Plan) -> Iterator[Shape]:
    """Yield the shapes of drives, then of force elements."""
    for part in posture.parts("drives"):
        yield from _DRIVES[part.kind](posture, plan, part)
    for part in posture.parts("forces"):
        yield from _FORCES.get(part.kind, _draw_unknown)(posture, plan, part)


def labels_of_drives_and_forces(posture: Posture, plan: Plan, still: bool) -> Iterator[Label]:
    """Yield the label of each drive and force element; in a `still` picture a zero load says so."""
    for part in (*posture.parts("drives"), *posture.parts("forces")):
        kind = part.section[:-1]
        way = 45.0
        if part.kind in ("distance", "spring_damper"):
            place, clear = 0.5 * (posture.place(part.ends[0]) + posture.place(part.ends[1])), 1.2
        elif part.kind == "coordinate" and part.options["coordinate"] != "theta":
            (place, side), clear = _arrow_place(posture, plan, part), 0.5
            way = float(np.degrees(np.arctan2(side[1], side[0])))
        elif part.kind == "force":
            span = _force_vector(posture, plan, part)
            place, clear = posture.place(part.ends[0]) + 0.5 * span, 0.5 if span.any() else 1.2
            way = float(np.degrees(np.arctan2(span[0], -span[1]))) if span.any() else way
        elif part.kind == "dry_friction":
            place, clear = posture.place(part.ends[1]), 2.0
        else:
            place = pivot(posture, part)
            clear = RADII[part.kind]
        nothing = still and part.kind in ("force", "torque") and not np.any(posture.loads.get(part.name, 1.0))
        text = f"{part.name} = 0" if nothing else part.name
        yield Label(f"{kind} {part.name}", kind, text, place, clear * plan.unit, way)


def arrow(part: str, role: str, tail: Array, tip: Array, head: float) -> Iterator[Shape]:
    """Yield line and head of a straight arrow; the line ends within the head."""
    along = unit_vector(tip - tail)
    yield Line(part, role, np.array([tail, tip - 0.8 * head * along]))
    yield Line(part, f"{role} head", arrow_head(tip, along, head), True)


def round_arrow(part: str, role: str, centre: Array, radius: float, left: bool, head: float) -> Iterator[Shape]:
    """Yield line and head of an arrow around a point, counterclockwise if `left`."""
    begin, end = np.radians([-25.0, 195.0]) if left else np.radians([205.0, -15.0])
    bow = arc(centre, radius, float(begin), float(end), 33)
    at = arc(centre, radius, float(end), float(end), 1)[0]
    along = turned(unit_vector(at - centre)) * (1.0 if left else -1.0)
    yield Line(part, role, bow)
    yield Line(part, f"{role} head", arrow_head(at + 0.9 * head * along, along, head), True)


def pivot(posture: Posture, part: PartInfo) -> Array:
    """Return the point about which a body turns: its pin on the other body or the ground, else its centre of mass."""
    joint, turning = _find_pivot(posture, part)
    if joint is not None:
        return posture.place(next(end for end in joint.ends if body_of(end) == turning))
    return posture.centre(turning) if turning in posture.bodies else np.zeros(2)


def arcs(posture: Posture) -> dict[str, float]:
    """Return the radius in units of the arrow or spiral spring around each pin that has one."""
    found = dict[str, float]()
    for part in (*posture.parts("drives"), *posture.parts("forces")):
        if part.kind in RADII and part.options.get("coordinate", "theta") == "theta":
            joint, _ = _find_pivot(posture, part)
            if joint is not None:
                found[joint.name] = max(found.get(joint.name, 0.0), RADII[part.kind])
    return found


def _find_pivot(posture: Posture, part: PartInfo) -> tuple[PartInfo | None, str]:
    """Return the joint about which a body turns, None without one, and the body."""
    bodies = [body_of(end) for end in part.ends]
    turning = next((body for body in bodies if body != GROUND), bodies[0])
    other = next((body for body in bodies if body != turning), GROUND)
    return pivot_between(posture, turning, other), turning


def _draw_angle_drive(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield the arrow of a driven angle in the direction of its rate."""
    rate = posture.omega(body_of(part.ends[0]))
    rate -= posture.omega(body_of(part.ends[1])) if len(part.ends) > 1 else 0.0
    centre, u = pivot(posture, part), plan.unit
    yield from round_arrow(f"drive {part.name}", "drive", centre, DRIVEN * u, rate >= 0.0, HEAD * u)


def _draw_coordinate_drive(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield the arrow of a driven coordinate in the direction of its rate."""
    if (axis := part.options["coordinate"]) == "theta":
        yield from _draw_angle_drive(posture, plan, part)
        return
    k = posture.bodies[body_of(part.ends[0])].index + "xy".index(axis)
    along = np.eye(2)["xy".index(axis)] * (-1.0 if posture.v is not None and posture.v[k] < 0.0 else 1.0)
    (at, _), half = _arrow_place(posture, plan, part), 0.5 * ARROW * plan.unit * along
    yield from arrow(f"drive {part.name}", "drive", at - half, at + half, HEAD * plan.unit)


def _arrow_place(posture: Posture, plan: Plan, part: PartInfo) -> tuple[Array, Array]:
    """Return the middle of a driven coordinate's arrow, and its side (unit vector): above or to the left.

    For a body that the ground guides, the arrow is next to the block, away from the ground.
    """
    axis = np.eye(2)["xy".index(part.options["coordinate"])]
    place, side = posture.place(part.ends[0]), turned(axis)
    for joint in sliding(posture):
        if joint.name in plan.ways and body_of(part.ends[0]) in map(body_of, joint.ends):
            _, along, slider = axis_of(posture, joint)
            if abs(float(along @ axis)) > ALONG:
                place, side = slider, -side if float(plan.ways[joint.name] @ side) > 0.0 else side
    return place + 2.0 * plan.unit * side, side


def _draw_cylinder(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield barrel and piston rod of a driven distance."""
    name, u = f"drive {part.name}", plan.unit
    a, b = (posture.place(end) for end in part.ends)
    along, span = unit_vector(b - a), float(np.hypot(*(b - a)))
    yield from _draw_ground_ends(posture, part, name, plan)
    yield Line(name, "piston", np.array([a + 0.5 * span * along, b]))
    yield Line(name, "barrel", rectangle(a + 0.34 * span * along, along, 0.27 * span, 0.85 * u), True)
    yield Line(name, "drive", np.array([a, a + 0.07 * span * along]))
    head = a + 0.5 * span * along
    yield Line(name, "piston", np.array([head - 0.85 * u * turned(along), head + 0.85 * u * turned(along)]))
    yield from (Disc(name, "pin", place, 0.8 * PIN * u) for place in (a, b))


def _draw_ground_ends(posture: Posture, part: PartInfo, name: str, plan: Plan) -> Iterator[Shape]:
    """Yield a wall at each end on the ground that no joint draws."""
    joined = {end for joint in posture.parts("joints") if not has_rail(joint) for end in joint.ends}
    for end in part.ends:
        if body_of(end) == GROUND and end not in joined:
            yield from ground_wall(name, posture.place(end), plan.ways[part.name], plan.unit)


def _draw_spring_damper(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield a spring, a damper, or both in parallel, between two points."""
    name, u = f"force {part.name}", plan.unit
    a, b = (posture.place(end) for end in part.ends)
    yield from _draw_ground_ends(posture, part, name, plan)
    yield from (Disc(name, "mark", place, 0.26 * u) for place in (a, b))
    if float(np.hypot(*(b - a))) < 1e-6 * u:
        return
    springs, damps = (posture.number(f"forces.{part.name}.{what}") != 0.0 for what in ("stiffness", "damping"))
    aside = 1.15 * u * turned(unit_vector(b - a)) if springs and damps else np.zeros(2)
    ground = _ground_side(posture, plan, part, a, b)
    if springs and damps and ground is not None:  # both next to the rail
        aside = -1.15 * u * ground
        a, b, ends = a + aside, b + aside, (a, b)
    else:
        ends = a, b
    if springs or not damps:
        free = posture.number(f"forces.{part.name}.free_length") or float(np.hypot(*(b - a)))
        teeth = int(np.clip(round(0.35 * free / u), 4, 14))
        coil = zigzag(a + 0.12 * (b - a), a + 0.88 * (b - a), 0.9 * u, teeth, 0.12 if damps else 0.05)
        coil = np.vstack([a, coil + aside, b]) if not damps else coil + aside
        yield Line(name, "spring", coil)
    if damps:
        yield from _draw_damper(name, a + 0.12 * (b - a) - aside, a + 0.88 * (b - a) - aside, u)
    if springs and damps:
        for end, share in zip(ends, (0.12, 0.88), strict=True):
            beam = a + share * (b - a)
            yield Line(name, "spring", np.array([beam - aside, beam + aside]))
            yield Line(name, "spring", np.array([end, ends[0] + share * (b - a)]))


def _ground_side(posture: Posture, plan: Plan, part: PartInfo, a: Array, b: Array) -> Array | None:
    """Return the side of the ground (unit vector) if an element lies along the rail of its body; else None."""
    held = {body_of(end) for end in part.ends}
    for joint in sliding(posture):
        if has_rail(joint) and joint.name in plan.ways and held == {body_of(end) for end in joint.ends}:
            on, along, _ = axis_of(posture, joint)
            if max(abs(float((place - on) @ turned(along))) for place in (a, b)) < plan.unit:
                return plan.ways[joint.name]
    return None


def _draw_damper(name: str, a: Array, b: Array, u: float) -> Iterator[Shape]:
    """Yield a piston in a cylinder that is open on one side."""
    along, middle = unit_vector(b - a), 0.5 * (a + b)
    across = 0.75 * u * turned(along)
    deep = min(1.6 * u, 0.3 * float(np.hypot(*(b - a))))
    bottom, top = middle - deep * along, middle + deep * along
    yield Line(name, "spring", np.array([top + across, bottom + across, bottom - across, top - across]))
    yield Line(name, "spring", np.array([a, bottom]))
    yield Line(name, "spring", np.array([middle, b]))
    yield Line(name, "piston", np.array([middle - 0.85 * across, middle + 0.85 * across]))


def _draw_spiral_spring(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield a spiral spring around a pivot."""
    angle, centre = np.linspace(0.0, 4.5 * np.pi, 90), pivot(posture, part)
    radius = plan.unit * np.linspace(0.6, WOUND, len(angle))
    yield Line(
        f"force {part.name}", "spring", centre + np.column_stack([np.cos(angle), np.sin(angle)]) * radius[:, None]
    )


def _draw_torque(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield the arrow of a torque in its direction."""
    left = posture.loads.get(part.name, (1.0, 0.0))[0] >= 0.0
    centre, u = pivot(posture, part), plan.unit
    yield from round_arrow(f"force {part.name}", "force", centre, LOADED * u, left, HEAD * u)


def _draw_force(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield the arrow of a force that begins at its point; a ring if the force is zero or unknown."""
    name, u, place = f"force {part.name}", plan.unit, posture.place(part.ends[0])
    span = _force_vector(posture, plan, part)
    if not span.any():
        yield Disc(name, "no force", place, 0.9 * u)
        return
    yield from arrow(name, "force", place, place + span, min(HEAD * u, 0.6 * float(np.hypot(*span))))


def _force_vector(posture: Posture, plan: Plan, part: PartInfo) -> Array:
    """Return a force's arrow from tail to tip, m of the drawing; 0 if the force is zero or unknown."""
    load = np.array(posture.loads.get(part.name, (0.0, 0.0)))
    if not (np.isfinite(load).all() and load.any()):
        return np.zeros(2)
    return load * plan.newton if plan.newton > 0.0 else ARROW * plan.unit * unit_vector(load)


def _draw_dry_friction(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield a rough line under the second body's point, and an arrow along a moving surface."""
    name, u = f"force {part.name}", plan.unit
    along = posture.direction(part, "direction", body_of(part.ends[0]))
    down = -turned(along) if turned(along)[1] >= 0.0 else turned(along)
    at = posture.place(part.ends[1]) + BLOCK[1] * u * down
    rough = zigzag(at - 2.0 * u * along, at + 2.0 * u * along, 0.3 * u, 7, 0.0)
    yield Line(name, "rough", rough - 0.1 * u * down)
    if (speed := posture.number(f"forces.{part.name}.speed")) != 0.0:
        way, low = along * np.sign(speed), at + 2.3 * u * down
        yield from arrow(name, "force", low - 0.5 * ARROW * u * way, low + 0.5 * ARROW * u * way, HEAD * u)


def _draw_unknown(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Yield a line with a dot at each end for an element without a symbol."""
    places = [posture.place(end) for end in part.ends]
    yield Line(f"force {part.name}", "spring", np.array(places))
    yield from (Disc(f"force {part.name}", "mark", place, 0.3 * plan.unit) for place in places)


_DRIVES = {"angle": _draw_angle_drive, "coordinate": _draw_coordinate_drive, "distance": _draw_cylinder}
_FORCES = {
    "spring_damper": _draw_spring_damper,
    "rotational_spring_damper": _draw_spiral_spring,
    "torque": _draw_torque,
    "force": _draw_force,
    "dry_friction": _draw_dry_friction,
}


def gravity_of(posture: Posture) -> Array | None:
    """Return the direction of gravity; None without gravity."""
    g = np.array([posture.number("gravity.x"), posture.number("gravity.y")])
    return unit_vector(g) if float(np.hypot(*g)) > 0.0 else None

"""Symbols of joints: pins, pins on the ground, rails, slots, welds, wheels, rods."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.bodies import BLOCK, SLOT, guide_and_slider, guide_ends
from gudgeon.drawing.guides import axes_of, gap_of
from gudgeon.drawing.plan import Plan, axis_of, has_rail, is_wide
from gudgeon.drawing.posture import GROUND, Posture, body_of
from gudgeon.drawing.shapes import Disc, Label, Line, Shape, hatching, rectangle, rounded, turned, unit_vector
from gudgeon.model.compiled import Array

PIN, WORN = 0.46, 0.86  # radii in units: of a pin, of the hole around one that has play
STAND = 2.3  # how far below its pin the ground is
ROLLER = 0.95


def joints(posture: Posture, plan: Plan) -> Iterator[Shape]:
    """Those of a scene, by kind."""
    for part in posture.parts("joints"):
        yield from _SYMBOLS.get(part.kind, _other)(posture, plan, part)


def names_of_joints(posture: Posture, plan: Plan, arcs: Mapping[str, float]) -> Iterator[Label]:
    """Beside each, and beside the `arcs` of arrows around it: radii in units by joint."""
    for part in posture.parts("joints"):
        place = posture.place(part.ends[-1])
        if part.kind == "gear":
            place = _contact(posture, part)
        elif part.kind == "distance":
            place = 0.5 * (posture.place(part.ends[0]) + place)
        elif part.kind in ("translational", "point_on_line"):
            place = axis_of(posture, part)[2]
        clear = {"translational": 1.5, "distance": 0.5, "gear": 0.3}.get(part.kind, 0.8)
        clear, way = max(clear, arcs.get(part.name, 0.0)), 45.0
        if has_rail(part) and part.name in plan.ways:  # beyond the ground, where nothing slides
            x, y = plan.ways[part.name]
            clear, way = BLOCK[1] + 1.2, float(np.degrees(np.arctan2(y, x)))
            clear += gap_of(posture, part, plan.unit) / plan.unit
        yield Label(f"joint {part.name}", "joint", part.name, place, clear * plan.unit, way)


def ground_wall(part: str, place: Array, into: Array, u: float, half: float = 1.5) -> Iterator[Shape]:
    """A hatched line through a place: something is fixed here."""
    a, b = place - half * u * turned(into), place + half * u * turned(into)
    yield Line(part, "rail", np.array([a, b]))
    yield from (Line(part, "hatch", stroke) for stroke in hatching(a, b, into, 0.95 * u))


def _stand(part: str, place: Array, way: Array, u: float) -> Iterator[Shape]:
    """The triangle under a pin on the ground, and the ground."""
    foot, across = place + STAND * u * way, turned(way)
    yield Line(part, "stand", np.array([place, foot - 1.25 * u * across, foot + 1.25 * u * across]), True)
    yield from ground_wall(part, foot, way, u, 1.9)


def _revolute(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    name, u = f"joint {part.name}", plan.unit
    wide = part.name in posture.clearances and is_wide(posture, part.name, u)
    if wide:
        c = float(posture.p[posture.clearances[part.name].clearance])
        yield Disc(name, "clearance", posture.place(part.ends[0]), c)
    elif part.name in plan.ways:
        end = next(end for end in part.ends if body_of(end) == GROUND)
        yield from _stand(name, posture.place(end), plan.ways[part.name], u)
    if part.name in posture.clearances and not wide:
        yield Disc(name, "worn", posture.place(part.ends[0]), WORN * u)
    yield Disc(name, "pin", posture.place(part.ends[1]), PIN * u)


def _rail(posture: Posture, plan: Plan, part: PartInfo, below: float, side: float = 1.0) -> Iterator[Shape]:
    """The ground under what slides on it, `below` its line (m), hatched on the far side, as far as it goes; or above
    (`side` −1)."""
    on, along, _ = axis_of(posture, part)
    if part.name in posture.guides:
        along = axes_of(posture, part)[0]
    low, high = plan.travel[part.name]
    more, way = (2.0 * BLOCK[0] + 0.4) * plan.unit * along, side * plan.ways[part.name]
    a, b = on + low * along - more + below * way, on + high * along + more + below * way
    yield Line(f"joint {part.name}", "rail", np.array([a, b]))
    for stroke in hatching(a, b, way, 0.95 * plan.unit):
        yield Line(f"joint {part.name}", "hatch", stroke)


def _translational(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    if part.name in plan.ways:
        gap = gap_of(posture, part, plan.unit)
        for side in (1.0, -1.0) if gap else (1.0,):
            yield from _rail(posture, plan, part, BLOCK[1] * plan.unit + gap, side)
    else:  # the axis of the guide, where the block hides it
        a, b = guide_ends(posture, plan, part)
        yield Line(f"joint {part.name}", "axis", np.array([a, b]))


def _point_on_line(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    name, u, place = f"joint {part.name}", plan.unit, posture.place(part.ends[0])
    guide, slider = guide_and_slider(part)
    if guide == GROUND:
        yield from _rail(posture, plan, part, ROLLER * u)
        yield Disc(name, "roller", place, ROLLER * u)
    else:
        _, along, _ = axis_of(posture, part)
        yield Line(name, "slot", rounded(guide_ends(posture, plan, part), SLOT * u), True)
        yield Line(name, "block", rectangle(place, along, 1.25 * u, 0.8 * u), True)
        if slider == GROUND:
            yield from _stand(name, place, plan.ways[part.name], u)
    yield Disc(name, "pin", place, PIN * u)


def _rigid(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    name, u, place = f"joint {part.name}", plan.unit, posture.place(part.ends[1])
    if part.name in plan.ways:
        yield from ground_wall(name, posture.place(part.ends[0]), plan.ways[part.name], u, 2.0)
    angle = posture.theta(body_of(part.ends[0]))
    along = np.array([np.cos(angle), np.sin(angle)])
    yield Line(name, "weld", rectangle(place, along, 0.62 * u, 0.62 * u), True)


def wheels(posture: Posture, part: PartInfo) -> list[tuple[str, Array, float]]:
    """Of a pair of gears: body, where it turns on the carrier, pitch radius."""
    carrier, found = part.options["carrier"], []
    for end, axis in zip(part.ends, "xy", strict=True):
        body = body_of(end)
        pivots = [
            joint.ends[[body_of(e) for e in joint.ends].index(body)]
            for joint in posture.parts("joints", "revolute") if body in map(body_of, joint.ends)
            and carrier in map(body_of, joint.ends)
        ]  # fmt: skip
        centre = posture.place(pivots[0] if pivots else end)
        found.append((body, centre, posture.number(f"joints.{part.name}.radii.{axis}")))
    return found


def _contact(posture: Posture, part: PartInfo) -> Array:
    """The pitch point."""
    (_, one, r_1), (_, other, r_2) = wheels(posture, part)
    inside = part.options.get("internal") == "true"
    outer, ring = (other, r_2) if r_2 > r_1 or not inside else (one, r_1)
    inner = one if outer is other else other
    return outer + ring * unit_vector(inner - outer)


def _gear(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """Pitch circles, a spoke fixed in each wheel, a ring with its rim, the point of contact."""
    name, order, u = f"joint {part.name}", list(posture.bodies), plan.unit
    for k, (body, centre, radius) in enumerate(wheels(posture, part)):
        tint = order.index(body) if body in order else 0
        ring = k == 1 and part.options.get("internal") == "true"
        if ring:
            yield Disc(name, "rim", centre, radius + 1.2 * u, tint)
        yield Disc(name, "ring" if ring else "wheel", centre, radius, tint)
        angle = posture.theta(body)
        spoke = np.array([np.cos(angle), np.sin(angle)])
        reach = (radius, radius + 1.2 * u) if ring else (0.0, radius)
        yield Line(name, "spoke", np.array([centre + r * spoke for r in reach]), tint=tint)
    yield Disc(name, "mark", _contact(posture, part), 0.25 * u)


def _distance(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """A rod without mass; drawn to its length where it does not reach."""
    name, ends = f"joint {part.name}", [posture.place(end) for end in part.ends]
    for end, place in zip(part.ends, ends, strict=True):
        if body_of(end) == GROUND and part.name in plan.ways:
            yield from _stand(name, place, plan.ways[part.name], plan.unit)
    yield Line(name, "rod", np.array(ends))
    yield from (Disc(name, "pin", place, 0.8 * PIN * plan.unit) for place in ends)


def _other(posture: Posture, plan: Plan, part: PartInfo) -> Iterator[Shape]:
    """A joint that has no symbol of its own yet: a small square at either end."""
    for end in part.ends:
        square = rectangle(posture.place(end), np.array([1.0, 0.0]), 0.5 * plan.unit, 0.5 * plan.unit)
        yield Line(f"joint {part.name}", "block", square, True)


_SYMBOLS = {
    "revolute": _revolute, "translational": _translational, "point_on_line": _point_on_line, "rigid": _rigid,
    "gear": _gear, "distance": _distance,
}  # fmt: skip

"""Files of pylinkage (H. Farajallah and contributors): JSON of a `Linkage`, or of a `Mechanism`.

A Linkage is a list of joints, each placed by those before it; a Mechanism is joints and the links that hold them.
Neither has units, nor masses; a crank turns by an angle at each step of pylinkage's own, which is taken for one second.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from gudgeon.errors import InputError
from gudgeon.exchange.linkage import Body, Drive, Line, Linkage, Point

OLD = ("Static", "Crank", "Fixed", "Linear", "Prismatic", "Revolute")
STEPPED = "pylinkage counts steps: the crank turns by one step's angle in a second"
Entry = Mapping[str, Any]


def of_pylinkage(data: Any) -> Linkage:
    """A linkage from what JSON gives. Raises InputError for what pylinkage does not write."""
    joints = data.get("joints") if isinstance(data, dict) else None
    if not isinstance(joints, list) or not joints or not all(isinstance(joint, dict) for joint in joints):
        raise InputError("no joints in it", hint="save a Linkage or a Mechanism of pylinkage as JSON")
    linkage = Linkage(str(data.get("name") or "linkage"))
    if any(joint.get("type") in OLD for joint in joints):
        _by_joints(linkage, joints)
    else:
        _by_links(linkage, joints, data.get("links"))
    return linkage


def _number(entry: Entry, key: str) -> float:
    value = entry.get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise InputError(f"joint {entry.get('name', entry.get('id'))}: {key} is {value!r}, expected a number")
    return float(value)


def _position(entry: Entry, x: Any, y: Any) -> Point | None:
    if x is None or y is None:
        return None
    return _number({**entry, "x": x}, "x"), _number({**entry, "y": y}, "y")


def _by_joints(linkage: Linkage, joints: Sequence[Entry]) -> None:
    """In an order in which each joint's parents come before it."""
    known, waiting = set[str | None]([None]), list(joints)

    def is_placed(parent: str | None) -> bool:
        return parent in known or parent in linkage.ground

    while waiting:
        ready = [joint for joint in waiting if all(is_placed(_parent(linkage, joint, key)) for key in _PARENTS)]
        if not ready:
            names = ", ".join(str(joint.get("name")) for joint in waiting)
            raise InputError(f"joints {names} hang on joints that are not in the file")
        for joint in ready:
            _one(linkage, joint)
            known.add(str(joint.get("name")))
        waiting = [joint for joint in waiting if joint not in ready]


_PARENTS = ("joint0", "joint1", "joint2")


def _parent(linkage: Linkage, joint: Entry, key: str) -> str | None:
    """The name of a parent; one that stands within the joint is a point of the ground."""
    found = joint.get(key)
    if not isinstance(found, dict):
        return None
    if not found.get("inline"):
        return str(found.get("ref"))
    place = _number(found, "x"), _number(found, "y")
    name = next((name for name, other in linkage.ground.items() if other == place), "")
    if not name:
        name = f"O{len(linkage.ground) + 1}"
        linkage.ground[name] = linkage.positions[name] = place
    return name


def _one(linkage: Linkage, joint: Entry) -> None:
    """What a joint adds."""
    name, kind = str(joint.get("name")), joint.get("type")
    at = _position(joint, joint.get("x"), joint.get("y"))
    if at is not None:
        linkage.positions[name] = at
    parents = [_parent(linkage, joint, key) for key in _PARENTS]
    if kind == "Static":
        linkage.ground[name] = linkage.positions[name] = at or (0.0, 0.0)
    elif kind == "Crank":
        first = _needed(name, parents[0])
        linkage.bar(first, name, _number(joint, "distance"))
        linkage.drives.append(Drive(linkage.bodies[-1].name, first, _number(joint, "angle")))
        linkage.notes.append(STEPPED)
    elif kind == "Revolute":
        for key, parent in zip(("distance0", "distance1"), parents, strict=False):
            linkage.bar(_needed(name, parent), name, _number(joint, key))
    elif kind == "Fixed":
        _fixed(linkage, name, parents, _number(joint, "distance"), _number(joint, "angle"))
    elif kind in ("Linear", "Prismatic"):
        linkage.bar(_needed(name, parents[0]), name, _number(joint, "revolute_radius"))
        _on_line(linkage, name, _needed(name, parents[1]), _needed(name, parents[2]))
    else:
        raise InputError(f"joint {name}: {kind!r} is no joint of pylinkage; expected one of {', '.join(OLD)}")


def _needed(name: str, parent: str | None) -> str:
    if parent is None:
        raise InputError(f"joint {name}: it says too few joints that it hangs on")
    return parent


def _fixed(linkage: Linkage, name: str, parents: Sequence[str | None], distance: float, angle: float) -> None:
    """A point of the body, or of the ground, that holds both parents."""
    first, second = _needed(name, parents[0]), _needed(name, parents[1])
    if first in linkage.ground and second in linkage.ground:
        body = Body("ground", linkage.ground)
        linkage.ground[name] = linkage.positions[name] = body.placed(first, second, distance, angle)
    elif holder := linkage.holding(first, second):
        holder.local[name] = holder.placed(first, second, distance, angle)
    else:
        raise InputError(
            f"joint {name}: it is fixed to {first} and {second}, which nothing holds at a distance",
            hint="a rigid body has one: in gudgeon write what is meant as bodies and joints",
        )


def _on_line(linkage: Linkage, name: str, first: str, second: str) -> None:
    if first in linkage.ground and second in linkage.ground:
        (x, y), (u, v) = linkage.ground[first], linkage.ground[second]
        linkage.lines.append(Line(name, first, None, (u - x, v - y)))
    elif holder := linkage.holding(first, second):
        (x, y), (u, v) = holder.local[first], holder.local[second]
        linkage.lines.append(Line(name, first, holder.name, (u - x, v - y)))
    else:
        raise InputError(f"joint {name}: its line leads through {first} and {second}, which no body holds")


def _by_links(linkage: Linkage, joints: Sequence[Entry], links: Any) -> None:
    """Joints at their positions, links that hold them there."""
    if not isinstance(links, list) or not all(isinstance(link, dict) for link in links):
        raise InputError("no links in it", hint="a Mechanism of pylinkage has joints and links")
    for joint in joints:
        name, place = str(joint.get("id")), joint.get("position")
        at = _position(joint, *place) if isinstance(place, list) and len(place) == 2 else None
        if at is not None:
            linkage.positions[name] = at
        elif joint.get("type") != "tracker":
            raise InputError(f"joint {name}: it has no position, so that its links have no lengths")
        if joint.get("type") == "ground" and at:
            linkage.ground[name] = at
    for link in links:
        _link(linkage, link)
    for joint in joints:
        if joint.get("type") == "tracker":
            parents = [str(joint.get("ref_joint1_id")), str(joint.get("ref_joint2_id"))]
            _fixed(linkage, str(joint.get("id")), parents, _number(joint, "distance"), _number(joint, "angle"))
        if joint.get("type") == "prismatic":
            axis = joint.get("axis")
            x, y = axis if isinstance(axis, list) and len(axis) == 2 else (1.0, 0.0)
            name = str(joint.get("id"))
            direction = _position({"id": name}, x, y)
            through = joint.get("line_point")
            place = _position({"id": name}, *through) if isinstance(through, list) and len(through) == 2 else None
            linkage.ground[f"{name}_line"] = linkage.positions[name] if place is None else place
            linkage.lines.append(Line(name, f"{name}_line", None, direction or (1.0, 0.0)))


def _link(linkage: Linkage, link: Entry) -> None:
    name, kind = str(link.get("id")), link.get("type", "link")
    points = [str(point) for point in link.get("joints", []) if str(point) in linkage.positions]
    if kind == "ground" or len(points) < 2:
        return
    if kind == "arc_driver":
        raise InputError(
            f"link {name}: a driver that turns back at the ends of an arc is not read",
            hint="make it a driver, and write the drive's value as it is meant",
        )
    motor = str(link.get("motor_joint"))
    points.sort(key=lambda point: point != motor)
    linkage.bodies.append(Body(name, {point: linkage.positions[point] for point in points}))
    if kind == "driver":
        rate = _number({**link, "name": name}, "angular_velocity")
        linkage.drives.append(Drive(name, points[0], rate))
        linkage.notes.append(STEPPED)

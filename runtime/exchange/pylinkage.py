"""Read JSON files of pylinkage (H. Farajallah and contributors) with a `Linkage` or a `Mechanism`.

A Linkage is a list of joints; earlier joints determine the position of each. A Mechanism has joints and the links that
contain them. Neither has units or masses. A crank turns by an angle at each step of pylinkage; one step becomes one
second.
"""

from __future__ import annotations

import math
from collections.abc import Container, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from typing import Any

from gudgeon.errors import InputError
from gudgeon.exchange.linkage import MAX_NUMBER, Body, Drive, Line, Linkage, Point

OLD = ("Static", "Crank", "Fixed", "Linear", "Prismatic", "Revolute")
STEPPED = "pylinkage counts steps: the crank turns by one step's angle in a second"
DRIVERS = ("driver", "arc_driver")
_ARC = ("arc_start", "arc_end")
Entry = Mapping[str, Any]


def read_pylinkage(data: Any) -> Linkage:
    """Return the linkage of parsed JSON. Raises InputError for data that pylinkage does not write."""
    joints = data.get("joints") if isinstance(data, dict) else None
    if not isinstance(joints, list) or not joints or not all(isinstance(joint, dict) for joint in joints):
        raise InputError("no joints in it", hint="save a Linkage or a Mechanism of pylinkage as JSON")
    linkage = Linkage(str(data.get("name") or "linkage")[:200])
    if any(str(joint.get("type")) in OLD for joint in joints):
        _read_joints(linkage, joints)
    else:
        _read_links(linkage, joints, data.get("links"))
    return linkage


def _name(entry: Entry, key: str, what: str) -> str:
    """Return the name of an entry, by its key. Raises InputError if it has none."""
    name = entry.get(key)
    if isinstance(name, bool) or not isinstance(name, (str, int)) or name == "":
        raise InputError(f"a {what} of type {entry.get('type')!r}: {key} is {_short_text(name)}, expected a name")
    return str(name)


def _short_text(value: Any) -> str:
    """Return a value as short text for messages."""
    return repr(value)[:40] if not isinstance(value, int) or abs(value) < MAX_NUMBER else "a number above 1e12"


def _number(entry: Entry, key: str, whose: str) -> float:
    """Return a number of an entry. Raises InputError if it is missing or out of range."""
    value = entry.get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= MAX_NUMBER:
        raise InputError(f"{whose}: {key} is {_short_text(value)}, expected a number up to {MAX_NUMBER:g}")
    return float(value)


def _length(entry: Entry, key: str, whose: str) -> float:
    """Return a positive number of an entry. Raises InputError."""
    value = _number(entry, key, whose)
    if not value > 0.0:
        raise InputError(f"{whose}: {key} is {value:g}, expected a length above 0")
    return value


def _pair(value: Any, key: str, whose: str) -> Point | None:
    """Return two numbers, or None if the list or one of them is null. Raises InputError."""
    if value is None:
        return None
    if not isinstance(value, list) or len(value) != 2:
        raise InputError(f"{whose}: {key} is {_short_text(value)}, expected two numbers")
    if None in value:
        return None
    x, y = (_number({key: part}, key, whose) for part in value)
    return x, y


def _read_joints(linkage: Linkage, joints: Sequence[Entry]) -> None:
    """Read a Linkage: add its joints in an order in which the parents of each come before it. Raises InputError."""
    by_name: dict[str, Entry] = {}
    for joint in joints:
        name = _name(joint, "name", "joint")
        if name in by_name:
            raise InputError(f"two joints are called {name}", hint="each joint needs a name of its own")
        by_name[name] = joint
    fixed = _GroundPoints(linkage, by_name)
    parents = {name: [_parent(fixed, name, joint, key) for key in _PARENTS] for name, joint in by_name.items()}
    above = {name: {parent for parent in of if parent in by_name} for name, of in parents.items()}
    for name, of in parents.items():
        for parent in of:
            if parent is not None and parent not in by_name and parent not in linkage.ground:
                raise InputError(f"joint {name}: it hangs on {parent!r}, which is not in the file")
    try:
        for name in TopologicalSorter(above).static_order():
            _add_joint(linkage, name, by_name[name], parents[name])
    except CycleError as error:
        raise InputError(f"joints hang on each other: {', '.join(error.args[1])}"[:300]) from error


_PARENTS = ("joint0", "joint1", "joint2")


class _GroundPoints:
    """Points of the ground that stand within joints as their parents; equal positions share a point."""

    def __init__(self, linkage: Linkage, used: Container[str]) -> None:
        """Create an empty set; used: names of the file's joints."""
        self.linkage, self.used, self.names = linkage, used, dict[Point, str]()

    def name(self, place: Point) -> str:
        """Return the name of the ground point at a position."""
        if place not in self.names:
            name = f"O{len(self.names) + 1}"
            while name in self.used:
                name += "_"
            self.names[place] = name
            self.linkage.ground[name] = self.linkage.positions[name] = place
        return self.names[place]


def _parent(fixed: _GroundPoints, name: str, joint: Entry, key: str) -> str | None:
    """Return the name of a parent, or None; a parent within the joint becomes a point of the ground."""
    found = joint.get(key)
    if not isinstance(found, dict):
        return None
    whose = f"joint {name}: {key}"
    if not found.get("inline"):
        return _name({**found, "type": key}, "ref", f"parent of joint {name}")
    return fixed.name((_number(found, "x", whose), _number(found, "y", whose)))


def _add_joint(linkage: Linkage, name: str, joint: Entry, parents: Sequence[str | None]) -> None:
    """Add what one joint of a Linkage defines: a ground point, bars, a drive, a line. Raises InputError."""
    kind, whose = joint.get("type"), f"joint {name}"
    at = _pair([joint.get("x"), joint.get("y")], "x, y", whose)
    if at is not None:
        linkage.positions[name] = at
    if kind == "Static":
        linkage.ground[name] = linkage.positions[name] = at or (0.0, 0.0)
    elif kind == "Crank":
        body = linkage.bar(_require_parent(name, parents[0]), name, _length(joint, "distance", whose))
        if body is None:
            raise InputError(f"{whose}: a crank that the ground holds")
        linkage.drives.append(Drive(body, _number(joint, "angle", whose)))
        linkage.notes.append(STEPPED)
    elif kind == "Revolute":
        for key, parent in zip(("distance0", "distance1"), parents, strict=False):
            linkage.bar(_require_parent(name, parent), name, _length(joint, key, whose))
    elif kind == "Fixed":
        _add_fixed_point(linkage, name, parents, _number(joint, "distance", whose), _number(joint, "angle", whose))
    elif kind in ("Linear", "Prismatic"):
        linkage.bar(_require_parent(name, parents[0]), name, _length(joint, "revolute_radius", whose))
        _add_line(linkage, name, _require_parent(name, parents[1]), _require_parent(name, parents[2]))
    else:
        raise InputError(f"{whose}: {_short_text(kind)} is no joint of pylinkage; expected one of {', '.join(OLD)}")


def _require_parent(name: str, parent: str | None) -> str:
    """Return the parent. Raises InputError if there is none."""
    if parent is None:
        raise InputError(f"joint {name}: it says too few joints that it hangs on")
    return parent


def _add_fixed_point(linkage: Linkage, name: str, parents: Sequence[str | None], distance: float, angle: float) -> None:
    """Add a point to the body, or to the ground, that contains both parents. Raises InputError if there is none."""
    first, second = _require_parent(name, parents[0]), _require_parent(name, parents[1])
    if first in linkage.ground and second in linkage.ground:
        body = Body("ground", linkage.ground)
        linkage.ground[name] = linkage.positions[name] = body.placed(first, second, distance, angle)
    elif holder := linkage.holding(first, second):
        linkage.hold(holder, name, holder.placed(first, second, distance, angle))
    else:
        raise InputError(
            f"joint {name}: it is fixed to {first} and {second}, which nothing holds at a distance",
            hint="a rigid body has one: in gudgeon write what is meant as bodies and joints",
        )


def _add_line(linkage: Linkage, name: str, first: str, second: str) -> None:
    """Constrain a point to the line through two others, which the ground or a body contains. Raises InputError."""
    if first in linkage.ground and second in linkage.ground:
        held, body = linkage.ground, None
    elif body := linkage.holding(first, second):
        held = body.local
    else:
        raise InputError(f"joint {name}: its line leads through {first} and {second}, which no body holds")
    (x, y), (u, v) = held[first], held[second]
    linkage.lines.append(Line(name, first, body, (u - x, v - y)))


def _read_links(linkage: Linkage, joints: Sequence[Entry], links: Any) -> None:
    """Read a Mechanism: joints at their positions, and the links that contain them. Raises InputError."""
    if not isinstance(links, list) or not all(isinstance(link, dict) for link in links):
        raise InputError("no links in it", hint="a Mechanism of pylinkage has joints and links")
    named = [(_name(link, "id", "link"), link) for link in links]
    if len(dict(named)) < len(named):
        twice = next(name for name, link in named if dict(named)[name] is not link)
        raise InputError(f"two links are called {twice}", hint="each link needs an id of its own")
    held = {name: _joints_of_link(link, name) for name, link in named}
    # as in pylinkage, joints of a ground link and motor joints are fixed, independent of their type
    fixed = {joint for name, link in named if link.get("type") == "ground" for joint in held[name]}
    fixed |= {str(link.get("motor_joint")) for _, link in named if link.get("type") in DRIVERS}
    trackers = [joint for joint in joints if joint.get("type") == "tracker"]
    for joint in joints:
        if joint.get("type") != "tracker":
            _place_joint(linkage, joint, fixed)
    tracked = {_name(joint, "id", "joint") for joint in trackers}
    for name, link in named:
        if link.get("type") != "ground":
            _add_link(linkage, name, link, [joint for joint in held[name] if joint not in tracked])
    for joint in trackers:
        name = _name(joint, "id", "joint")
        if name in linkage.positions or name in linkage.holders:
            raise InputError(f"two joints are called {name}", hint="each joint needs an id of its own")
        parents = [_name(joint, key, f"tracker {name}") for key in ("ref_joint1_id", "ref_joint2_id")]
        whose = f"joint {name}"
        _add_fixed_point(linkage, name, parents, _number(joint, "distance", whose), _number(joint, "angle", whose))


def _place_joint(linkage: Linkage, joint: Entry, fixed: set[str]) -> None:
    """Add a joint with a position; for a prismatic joint also its line. Raises InputError."""
    name = _name(joint, "id", "joint")
    whose = f"joint {name}"
    if name in linkage.positions:
        raise InputError(f"two joints are called {name}", hint="each joint needs an id of its own")
    at = _pair(joint.get("position"), "position", whose)
    if at is None:
        raise InputError(f"{whose}: it has no position, so that its links have no lengths")
    linkage.positions[name] = at
    if joint.get("type") == "ground" or name in fixed:
        linkage.ground[name] = at
    if joint.get("type") == "prismatic":
        direction = _pair(joint.get("axis", [1.0, 0.0]), "axis", whose)
        if direction is None or not math.hypot(*direction) > 0.0:
            raise InputError(f"{whose}: axis is {_short_text(joint.get('axis'))}, expected a direction")
        through = f"{name}_line"
        while through in linkage.positions or through in linkage.ground:
            through += "_"
        linkage.ground[through] = _pair(joint.get("line_point"), "line_point", whose) or at
        linkage.lines.append(Line(name, through, None, direction))


def _joints_of_link(link: Entry, name: str) -> list[str]:
    """Return the joints of a link, each once. Raises InputError."""
    joints = link.get("joints")
    if not isinstance(joints, list):
        raise InputError(f"link {name}: joints is {_short_text(joints)}, expected a list of joints")
    return list(dict.fromkeys(_name({"id": joint, "type": "link"}, "id", f"joint of link {name}") for joint in joints))


def _add_link(linkage: Linkage, name: str, link: Entry, joints: list[str]) -> None:
    """Add the body of a link and its drive. Raises InputError."""
    whose, kind, motor = f"link {name}", link.get("type", "link"), str(link.get("motor_joint"))
    for joint in joints:
        if joint not in linkage.positions:
            raise InputError(f"{whose}: no joint is called {joint}")
    joints.sort(key=lambda joint: joint != motor)
    body = linkage.add(Body(name, {joint: linkage.positions[joint] for joint in joints}))
    if kind not in DRIVERS:
        return
    if joints[0] != motor:
        raise InputError(f"{whose}: it is driven at {motor}, expected one of its joints as motor_joint")
    rate, arc = _number({"angular_velocity": math.tau / 360.0, **link}, "angular_velocity", whose), None
    if kind == "arc_driver":
        low, high = (_number({"arc_start": 0.0, "arc_end": math.pi, **link}, key, whose) for key in _ARC)
        if not high > low:
            raise InputError(f"{whose}: its arc ends at {high:g} rad, where it begins or before ({low:g} rad)")
        arc = low, high
    linkage.drives.append(Drive(body, rate, None, arc))
    linkage.notes.append(STEPPED)

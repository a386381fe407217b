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

JOINT_TYPES = ("Static", "Crank", "Fixed", "Linear", "Prismatic", "Revolute")
STEP_NOTE = "pylinkage counts steps: the crank rotates by the angle of one step in a second"
DRIVERS = ("driver", "arc_driver")
_ARC_KEYS = ("arc_start", "arc_end")
Entry = Mapping[str, Any]


def read_pylinkage(parsed_json: Any) -> Linkage:
    """Return the linkage of parsed JSON, either a Linkage or a Mechanism of pylinkage.

    The types of the joints decide which. Raises InputError for data that pylinkage does not write.
    """
    joints = parsed_json.get("joints") if isinstance(parsed_json, dict) else None
    if not isinstance(joints, list) or not joints or not all(isinstance(joint, dict) for joint in joints):
        raise InputError("the file has no joints", hint="save a Linkage or a Mechanism of pylinkage as JSON")
    linkage = Linkage(str(parsed_json.get("name") or "linkage")[:200])
    if any(str(joint.get("type")) in JOINT_TYPES for joint in joints):
        _read_joints(linkage, joints)
    else:
        _read_links(linkage, joints, parsed_json.get("links"))
    return linkage


def _read_name(entry: Entry, key: str, description: str) -> str:
    """Return the name under a key of an entry as text: a non-empty text or an integer.

    `description` names the entry in the error. Raises InputError, with the entry's type, if the key is missing or has
    another value.
    """
    name = entry.get(key)
    if isinstance(name, bool) or not isinstance(name, (str, int)) or name == "":
        raise InputError(
            f"a {description} of type {entry.get('type')!r}: {key} is {_shorten_text(name)}, expected a name"
        )
    return str(name)


def _shorten_text(value: Any) -> str:
    """Return a value as short text for messages."""
    return repr(value)[:40] if not isinstance(value, int) or abs(value) < MAX_NUMBER else "a number above 1e12"


def _read_number(entry: Entry, key: str, owner: str) -> float:
    """Return a number of an entry as float; `owner` names the entry in the error.

    Raises InputError if it is missing, not a number or above MAX_NUMBER.
    """
    value = entry.get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= MAX_NUMBER:
        raise InputError(f"{owner}: {key} is {_shorten_text(value)}, expected a number up to {MAX_NUMBER:g}")
    return float(value)


def _read_length(entry: Entry, key: str, owner: str) -> float:
    """Return a positive number of an entry; `owner` names the entry in the error.

    Raises InputError if it is missing or not positive.
    """
    value = _read_number(entry, key, owner)
    if not value > 0.0:
        raise InputError(f"{owner}: {key} is {value:g}, expected a length above 0")
    return value


def _read_pair(value: Any, key: str, owner: str) -> Point | None:
    """Return a list of two numbers as a point, or None if the list or one of its numbers is null.

    Raises InputError for anything else; `key` and `owner` are used in the error.
    """
    if value is None:
        return None
    if not isinstance(value, list) or len(value) != 2:
        raise InputError(f"{owner}: {key} is {_shorten_text(value)}, expected two numbers")
    if None in value:
        return None
    x, y = (_read_number({key: component}, key, owner) for component in value)
    return x, y


def _read_joints(linkage: Linkage, joints: Sequence[Entry]) -> None:
    """Read a Linkage: add its joints in an order in which the parents of each come before it.

    Raises InputError for repeated names, missing parents and cycles.
    """
    by_name: dict[str, Entry] = {}
    for joint in joints:
        name = _read_name(joint, "name", "joint")
        if name in by_name:
            raise InputError(f"two joints are called {name}", hint="each joint needs a name of its own")
        by_name[name] = joint
    ground_points = _GroundPoints(linkage, by_name)
    parents = {
        name: [_find_parent(ground_points, name, joint, key) for key in _PARENTS] for name, joint in by_name.items()
    }
    parents_in_file = {
        name: {parent for parent in parent_names if parent in by_name} for name, parent_names in parents.items()
    }
    for name, parent_names in parents.items():
        for parent in parent_names:
            if parent is not None and parent not in by_name and parent not in linkage.ground:
                raise InputError(f"joint {name}: it depends on {parent!r}, which is not in the file")
    try:
        for name in TopologicalSorter(parents_in_file).static_order():
            _add_joint(linkage, name, by_name[name], parents[name])
    except CycleError as error:
        raise InputError(f"joints depend on each other: {', '.join(error.args[1])}"[:300]) from error


_PARENTS = ("joint0", "joint1", "joint2")


class _GroundPoints:
    """Ground points that joints define inline as their parents; equal positions have one point."""

    def __init__(self, linkage: Linkage, joint_names: Container[str]) -> None:
        """Create an empty set; `joint_names` are the names of the file's joints, which ground points must not have."""
        self.linkage, self.joint_names, self.name_by_position = linkage, joint_names, dict[Point, str]()

    def get_or_add_name(self, position: Point) -> str:
        """Return the name of the ground point at a position; a new point (O1, O2, …) is added to the linkage."""
        if position not in self.name_by_position:
            name = f"O{len(self.name_by_position) + 1}"
            while name in self.joint_names:
                name += "_"
            self.name_by_position[position] = name
            self.linkage.ground[name] = self.linkage.positions[name] = position
        return self.name_by_position[position]


def _find_parent(ground_points: _GroundPoints, joint_name: str, joint: Entry, key: str) -> str | None:
    """Return the name of a joint's parent under `key`, or None if there is none.

    A parent is {"ref": NAME}, or {"inline": true, "x": …, "y": …}, which becomes a point of the ground. Raises
    InputError.
    """
    parent = joint.get(key)
    if not isinstance(parent, dict):
        return None
    owner = f"joint {joint_name}: {key}"
    if not parent.get("inline"):
        return _read_name({**parent, "type": key}, "ref", f"parent of joint {joint_name}")
    return ground_points.get_or_add_name((_read_number(parent, "x", owner), _read_number(parent, "y", owner)))


def _add_joint(linkage: Linkage, name: str, joint: Entry, parents: Sequence[str | None]) -> None:
    """Add what one joint of a Linkage defines, by its type: a ground point, bars, a drive, a fixed point or a line.

    Static: a ground point; Crank: a driven bar; Revolute: bars to both parents; Fixed: a point of a body; Linear and
    Prismatic: a bar and a line. `parents` are the names of its parents, None where one is missing. Raises InputError.
    """
    joint_type, owner = joint.get("type"), f"joint {name}"
    position = _read_pair([joint.get("x"), joint.get("y")], "x, y", owner)
    if position is not None:
        linkage.positions[name] = position
    if joint_type == "Static":
        linkage.ground[name] = linkage.positions[name] = position or (0.0, 0.0)
    elif joint_type == "Crank":
        body = linkage.find_or_add_bar(_require_parent(name, parents[0]), name, _read_length(joint, "distance", owner))
        if body is None:
            raise InputError(f"{owner}: a crank cannot be fixed to the ground")
        linkage.drives.append(Drive(body, _read_number(joint, "angle", owner)))
        linkage.notes.append(STEP_NOTE)
    elif joint_type == "Revolute":
        for key, parent in zip(("distance0", "distance1"), parents, strict=False):
            linkage.find_or_add_bar(_require_parent(name, parent), name, _read_length(joint, key, owner))
    elif joint_type == "Fixed":
        _add_fixed_point(
            linkage, name, parents, _read_number(joint, "distance", owner), _read_number(joint, "angle", owner)
        )
    elif joint_type in ("Linear", "Prismatic"):
        linkage.find_or_add_bar(_require_parent(name, parents[0]), name, _read_length(joint, "revolute_radius", owner))
        _add_line(linkage, name, _require_parent(name, parents[1]), _require_parent(name, parents[2]))
    else:
        raise InputError(
            f"{owner}: {_shorten_text(joint_type)} is not a joint of pylinkage: expected {', '.join(JOINT_TYPES)}"
        )


def _require_parent(name: str, parent: str | None) -> str:
    """Return `parent`, a name. Raises InputError that names the joint `name` if it is None."""
    if parent is None:
        raise InputError(f"joint {name}: a joint on which it depends is missing")
    return parent


def _add_fixed_point(linkage: Linkage, name: str, parents: Sequence[str | None], distance: float, angle: float) -> None:
    """Add a point to the body, or to the ground, that contains both parents.

    It is at `distance` from the first parent, at `angle` (rad) from the direction to the second. Raises InputError if
    no body contains both. A parent that is None is refused, too.
    """
    first, second = _require_parent(name, parents[0]), _require_parent(name, parents[1])
    if first in linkage.ground and second in linkage.ground:
        body = Body("ground", linkage.ground)
        linkage.ground[name] = linkage.positions[name] = body.compute_position(first, second, distance, angle)
    elif parent_body := linkage.find_body(first, second):
        linkage.add_point(parent_body, name, parent_body.compute_position(first, second, distance, angle))
    else:
        raise InputError(
            f"joint {name}: it is fixed to {first} and {second}, which are not points of one rigid body",
            hint="write a mechanism file with bodies and joints instead",
        )


def _add_line(linkage: Linkage, point_name: str, first_point: str, second_point: str) -> None:
    """Constrain the point `point_name` to the line through two others, which the ground or a body contains.

    Raises InputError if no body contains both.
    """
    if first_point in linkage.ground and second_point in linkage.ground:
        points, body = linkage.ground, None
    elif body := linkage.find_body(first_point, second_point):
        points = body.point_positions
    else:
        raise InputError(
            f"joint {point_name}: its line passes through {first_point} and {second_point}, which no body contains"
        )
    (x_first, y_first), (x_second, y_second) = points[first_point], points[second_point]
    linkage.lines.append(Line(point_name, first_point, body, (x_second - x_first, y_second - y_first)))


def _read_links(linkage: Linkage, joints: Sequence[Entry], links: Any) -> None:
    """Read a Mechanism: add joints at their positions, the links that contain them, then trackers.

    Joints of ground links and motor joints are fixed. Raises InputError.
    """
    if not isinstance(links, list) or not all(isinstance(link, dict) for link in links):
        raise InputError("the file has no links", hint="a Mechanism of pylinkage has joints and links")
    named_links = [(_read_name(link, "id", "link"), link) for link in links]
    if len(dict(named_links)) < len(named_links):
        repeated_name = next(name for name, link in named_links if dict(named_links)[name] is not link)
        raise InputError(f"two links are called {repeated_name}", hint="each link needs an id of its own")
    joints_by_link = {name: _list_joints_of_link(link, name) for name, link in named_links}
    # as in pylinkage, joints of a ground link and motor joints are fixed, independent of their type
    fixed_joints = {
        joint for name, link in named_links if link.get("type") == "ground" for joint in joints_by_link[name]
    }
    fixed_joints |= {str(link.get("motor_joint")) for _, link in named_links if link.get("type") in DRIVERS}
    trackers = [joint for joint in joints if joint.get("type") == "tracker"]
    for joint in joints:
        if joint.get("type") != "tracker":
            _add_joint_at_position(linkage, joint, fixed_joints)
    tracker_names = {_read_name(joint, "id", "joint") for joint in trackers}
    for name, link in named_links:
        if link.get("type") != "ground":
            _add_link(linkage, name, link, [joint for joint in joints_by_link[name] if joint not in tracker_names])
    for joint in trackers:
        name = _read_name(joint, "id", "joint")
        if name in linkage.positions or name in linkage.bodies_by_point:
            raise InputError(f"two joints are called {name}", hint="each joint needs an id of its own")
        parents = [_read_name(joint, key, f"tracker {name}") for key in ("ref_joint1_id", "ref_joint2_id")]
        owner = f"joint {name}"
        _add_fixed_point(
            linkage, name, parents, _read_number(joint, "distance", owner), _read_number(joint, "angle", owner)
        )


def _add_joint_at_position(linkage: Linkage, joint: Entry, fixed_joints: set[str]) -> None:
    """Add a joint at its position, also to the ground if it is fixed; for a prismatic joint also its line.

    The line is fixed to the ground, through `line_point` or else the joint, along `axis` or else x. Raises InputError
    for a repeated name, and without a position or direction.
    """
    name = _read_name(joint, "id", "joint")
    owner = f"joint {name}"
    if name in linkage.positions:
        raise InputError(f"two joints are called {name}", hint="each joint needs an id of its own")
    position = _read_pair(joint.get("position"), "position", owner)
    if position is None:
        raise InputError(f"{owner}: it has no position, so that its links have no lengths")
    linkage.positions[name] = position
    if joint.get("type") == "ground" or name in fixed_joints:
        linkage.ground[name] = position
    if joint.get("type") == "prismatic":
        direction = _read_pair(joint.get("axis", [1.0, 0.0]), "axis", owner)
        if direction is None or not math.hypot(*direction) > 0.0:
            raise InputError(f"{owner}: axis is {_shorten_text(joint.get('axis'))}, expected a direction")
        line_point = f"{name}_line"
        while line_point in linkage.positions or line_point in linkage.ground:
            line_point += "_"
        linkage.ground[line_point] = _read_pair(joint.get("line_point"), "line_point", owner) or position
        linkage.lines.append(Line(name, line_point, None, direction))


def _list_joints_of_link(link: Entry, name: str) -> list[str]:
    """Return the names of the joints of a link in their order, each once.

    Raises InputError if they are not a list of names.
    """
    joints = link.get("joints")
    if not isinstance(joints, list):
        raise InputError(f"link {name}: joints is {_shorten_text(joints)}, expected a list of joints")
    return list(
        dict.fromkeys(_read_name({"id": joint, "type": "link"}, "id", f"joint of link {name}") for joint in joints)
    )


def _add_link(linkage: Linkage, name: str, link: Entry, joints: list[str]) -> None:
    """Add the body of a link at the positions of its joints, and the drive of a "driver" or "arc_driver".

    `joints` is sorted in place: the motor joint becomes the first. The default rate is 1° per step, the default arc 0
    to π. Raises InputError for an unknown joint, a motor joint that is not the link's, or an arc without length.
    """
    owner, link_type, motor = f"link {name}", link.get("type", "link"), str(link.get("motor_joint"))
    for joint in joints:
        if joint not in linkage.positions:
            raise InputError(f"{owner}: no joint is called {joint}")
    joints.sort(key=lambda joint: joint != motor)
    body = linkage.add_body(Body(name, {joint: linkage.positions[joint] for joint in joints}))
    if link_type not in DRIVERS:
        return
    if joints[0] != motor:
        raise InputError(f"{owner}: it is driven at {motor}, expected one of its joints as motor_joint")
    rate, arc = _read_number({"angular_velocity": math.tau / 360.0, **link}, "angular_velocity", owner), None
    if link_type == "arc_driver":
        begin, end = (_read_number({"arc_start": 0.0, "arc_end": math.pi, **link}, key, owner) for key in _ARC_KEYS)
        if not end > begin:
            raise InputError(f"{owner}: its arc ends at {end:g} rad, expected more than its start, {begin:g} rad")
        arc = begin, end
    linkage.drives.append(Drive(body, rate, None, arc))
    linkage.notes.append(STEP_NOTE)

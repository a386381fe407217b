"""Write a linkage of another program as a mechanism file of gudgeon."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Hashable
from itertools import islice

from gudgeon.errors import BadNameError, InputError
from gudgeon.exchange.linkage import Body, Drive, Linkage, Point
from gudgeon.language.names import check_name

LINE_MASS = 1.0  # kg/m, for bodies whose mass the file does not specify
ENDS = ("tail", "head")
NOT_POINTS = (*ENDS, "origin", "com", "x", "y", "theta", "vx", "vy", "omega", "ax", "ay", "alpha")
KINDS = ("body", "joint", "drive", "parameter")  # kinds that share one set of names
MAX_SUGGESTION = 40  # characters of another program's name that are used; a number, `_slot` or `_motor` may follow
HEAD = """\
# {title}: converted from a file of another program.
{notes}format: gudgeon/1
name: {name}
"""


class _UniqueNames:
    """Set of unique names that a mechanism file allows for elements of certain kinds."""

    def __init__(self, *kinds: str) -> None:
        """Create an empty set of names; kinds: see `check_name`."""
        self.kinds, self.name_by_key = kinds, dict[Hashable, str]()
        self.used_names, self.last_number = set[str](), dict[str, int]()

    def get_unique_name(self, key: Hashable, suggestion: str) -> str:
        """Return a unique valid name for the element `key`, as similar to `suggestion` as the format allows.

        The same key gives the same name. Other characters become "_", names are shortened to MAX_SUGGESTION, and a
        number is added to a used name.
        """
        if key not in self.name_by_key:
            ascii_name = (
                unicodedata.normalize("NFKD", suggestion[: 10 * MAX_SUGGESTION]).encode("ascii", "ignore").decode()
            )
            valid_name = re.sub(r"[\W_]+", "_", ascii_name)[:MAX_SUGGESTION].strip("_")
            if not self._is_valid_name(valid_name):
                valid_name = f"x_{valid_name}".rstrip("_")
            unused_name, number = valid_name, self.last_number.get(valid_name, 1)
            while unused_name in self.used_names or not self._is_valid_name(unused_name):
                number += 1
                unused_name = f"{valid_name}_{number}"
            self.last_number[valid_name] = number
            self.used_names.add(unused_name)
            self.name_by_key[key] = unused_name
        return self.name_by_key[key]

    def _is_valid_name(self, name: str) -> bool:
        """Return whether the format allows the name for all kinds of this set."""
        try:
            for kind in self.kinds:
                check_name(name, kind, None)
        except BadNameError:
            return False
        return "point" not in self.kinds or name not in NOT_POINTS


class _Writer:
    """Writer of the YAML text of one linkage."""

    def __init__(self, linkage: Linkage) -> None:
        """Reserve the names of all bodies and drives."""
        self.linkage, self.unit = linkage, linkage.unit
        self.points, self.names = _UniqueNames("point"), _UniqueNames(*KINDS)
        self.shapes = {id(body): _convert_to_bar_axes(body) for body in linkage.bodies}
        for body in linkage.bodies:
            self.get_body_name(body)
        self.rates = [self.names.get_unique_name(("rate", k), "omega") for k in range(len(linkage.drives))]

    def get_body_name(self, body: Body) -> str:
        """Return the name of a body."""
        return self.names.get_unique_name(id(body), body.name)

    def get_point_name(self, point: str) -> str:
        """Return the name of a point."""
        return self.points.get_unique_name(point, point)

    def format_length(self, x: float) -> str:
        """Return a length with its unit as text."""
        return f"{_format_number(x)} {self.unit}"

    def format_point_reference(self, body: Body, point: str) -> str:
        """Return how a joint refers to a point of a body: "rod.head"; the first two points are tail and head."""
        names_of_ends = dict(zip(islice(body.point_positions, 2), ENDS, strict=True))
        point_name = names_of_ends[point] if point in names_of_ends else self.get_point_name(point)
        return f"{self.get_body_name(body)}.{point_name}"

    def format_body(self, body: Body) -> str:
        """Return the line of a body: length, mass, inertia, centre of mass, points.

        Without a mass it is a bar of LINE_MASS. A moment of inertia that is not known is that of a slender bar.
        """
        length, points, com = self.shapes[id(body)]
        mass = body.mass if body.mass is not None else LINE_MASS * length * _convert_unit_to_metres(self.unit)
        inertia = body.inertia
        if inertia is None and com is not None:  # "auto" assumes the centre of mass in the middle
            inertia = mass * (length * _convert_unit_to_metres(self.unit)) ** 2 / 12.0
        inertia_text = "auto" if inertia is None else f"{_format_number(inertia)} kg*m^2"
        entries = [
            f"length: {self.format_length(length)}",
            f"mass: {_format_number(mass)} kg",
            f"inertia: {inertia_text}",
        ]
        if com is not None:
            entries.append(f"com: [{self.format_length(com[0])}, {self.format_length(com[1])}]")
        if points:
            point_entries = (
                f"{self.get_point_name(p)}: [{self.format_length(x)}, {self.format_length(y)}]"
                for p, (x, y) in points.items()
            )
            entries.append(f"points: {{{', '.join(point_entries)}}}")
        return f"  {self.get_body_name(body)}: {{{', '.join(entries)}}}"

    def format_joints(self) -> list[str]:
        """Return the lines of all joints.

        A revolute joint connects the first body of a point, or the ground, with every other body of the point. Points
        on lines become `point_on_line` joints. Raises InputError for a line without direction or body.
        """
        lines = []
        for point in self.linkage.iterate_points():
            ends_at_point = [
                self.format_point_reference(body, point) for body in self.linkage.bodies_by_point.get(point, [])
            ]
            if point in self.linkage.ground:
                ends_at_point.insert(0, f"ground.{self.get_point_name(point)}")
            for index, other_end in enumerate(ends_at_point[1:]):
                name = self.names.get_unique_name(
                    ("joint", point, index), point if index == 0 else f"{point}_{index + 1}"
                )
                lines.append(f"  {name}: {{revolute: [{ends_at_point[0]}, {other_end}]}}")
        for index, line in enumerate(self.linkage.lines):
            body, carrier = self.linkage.find_body(line.point), line.body
            if body is None:
                raise InputError(f"joint {line.point}: it slides on a line, but belongs to no link")
            line_point = (
                self.format_point_reference(carrier, line.through)
                if carrier
                else f"ground.{self.get_point_name(line.through)}"
            )
            x, y = _convert_direction(carrier, line.direction) if carrier else line.direction
            length = math.hypot(x, y)
            if not length > 0.0:
                raise InputError(f"joint {line.point}: the line on which it slides has no direction")
            direction = f"[{_format_number(x / length)}, {_format_number(y / length)}]"
            points = f"[{self.format_point_reference(body, line.point)}, {line_point}]"
            name = self.names.get_unique_name(("line", index), f"{line.point}_slot")
            lines.append(f"  {name}: {{point_on_line: {points}, direction: {direction}}}")
        return lines

    def compute_initial_angle(self, body: Body | None) -> float | None:
        """Return the initial angle of a bar in rad; 0 for the ground (None), None if a position is unknown."""
        if body is None:
            return 0.0
        ends = [self.linkage.positions.get(point) for point in islice(body.point_positions, 2)]
        if None in ends:
            return None
        (x_tail, y_tail), (x_head, y_head) = ends  # type: ignore[misc]
        return math.atan2(y_head - y_tail, x_head - x_tail)

    def format_file(self) -> str:
        """Return the whole text of the mechanism file.

        It has gravity, parameters (rates of the drives), bodies, ground points, joints, drives and guesses. Comments at
        its head list what was assumed: masses, units and the notes of the linkage.
        """
        linkage = self.linkage
        notes = list(dict.fromkeys(linkage.notes))
        if any(body.mass is None for body in linkage.bodies):
            notes.append(f"masses are not in the file: those of bars of {LINE_MASS:g} kg/m are used")
        if not linkage.has_unit:
            notes.append("the file has no units: lengths are assumed to be in metres")
        comments = "".join(f"# {note[0].upper()}{note[1:]}.\n" for note in map(_format_comment, notes))
        name = _UniqueNames("mechanism").get_unique_name("", linkage.name)
        texts = [HEAD.format(title=_format_comment(linkage.name), notes=comments, name=name)]
        if linkage.gravity is not None:
            texts.append(
                f"gravity: [{_format_number(linkage.gravity[0])}, {_format_number(linkage.gravity[1])} m/s^2]\n"
            )
        if linkage.drives:
            names_and_drives = zip(self.rates, linkage.drives, strict=True)
            rates = (f"  {name}: {_format_number(drive.rate)} 1/s" for name, drive in names_and_drives)
            texts += ["\nparameters:\n", *(f"{line}\n" for line in rates)]
        texts += ["\nbodies:\n", *(f"{self.format_body(body)}\n" for body in linkage.bodies)]
        joints = self.format_joints()
        if ground := self._list_ground_points():
            point_entries = (
                f"{self.get_point_name(point)}: [{self.format_length(x)}, {self.format_length(y)}]"
                for point, (x, y) in ground
            )
            texts += [f"\nground: {{{', '.join(point_entries)}}}\n"]
        if joints:
            texts += ["\njoints:\n", *(f"{line}\n" for line in joints)]
        return "".join([*texts, *self._format_motion()])

    def _list_ground_points(self) -> list[tuple[str, Point]]:
        """Return the points of the ground that bodies or lines use."""
        used = {*self.linkage.bodies_by_point, *(line.through for line in self.linkage.lines)}
        return [(p, position) for p, position in self.linkage.ground.items() if p in used]

    def _format_motion(self) -> list[str]:
        """Return the lines of the drives, which begin at the initial angles, and the guesses of the other bodies'
        angles.

        Bodies that are driven relative to another body, not to the ground, get a guess too if their angle is known.
        """
        lines, driven_ids = [], set[int]()
        for k, (rate, drive) in enumerate(zip(self.rates, self.linkage.drives, strict=True)):
            name, other_body = self.get_body_name(drive.body), drive.relative_to
            target = f"[{name}, {self.get_body_name(other_body)}]" if other_body else name
            if not other_body:
                driven_ids.add(id(drive.body))
            motor = self.names.get_unique_name(("drive", k), f"{name}_motor")
            lines.append(f"  {motor}: {{angle: {target}, value: {self._format_drive_expression(drive, rate)}}}\n")
        lines = ["\ndrives:\n", *lines] if lines else []
        guesses = [
            f"{self.get_body_name(body)}.theta: {_format_number(math.degrees(angle))} deg"
            for body in self.linkage.bodies
            if id(body) not in driven_ids and (angle := self.compute_initial_angle(body)) is not None
        ]
        return [*lines, *([f"\nstart:\n  guess: {{{', '.join(guesses)}}}\n"] if guesses else [])]

    def _format_drive_expression(self, drive: Drive, rate: str) -> str:
        """Return the expression of a drive: a constant rate, or a triangle wave between the ends of an arc.

        `rate` is the name of the parameter. The start angle is moved into the arc by whole turns; raises InputError if
        it lies outside.
        """
        ends = self.compute_initial_angle(drive.body), self.compute_initial_angle(drive.relative_to)
        start_angle = 0.0 if None in ends else ends[0] - ends[1]  # type: ignore[operator]
        if drive.arc is None:
            return f"{_format_number(math.degrees(start_angle))} deg + {rate} * t"
        low, high = drive.arc
        n_turns = math.ceil((low - start_angle) / math.tau - 1e-9)
        start_angle = max(start_angle + n_turns * math.tau, low)
        if start_angle > high + 1e-9:
            raise InputError(
                f"link {drive.body.name}: its angle {math.degrees(start_angle):g}° is outside its arc from"
                f" {math.degrees(low):g}° to {math.degrees(high):g}°"
            )
        high_text, width_text, offset_text = (
            _format_number(math.degrees(x)) for x in (high, high - low, start_angle - low)
        )
        return f"{high_text} deg - abs(mod({offset_text} deg + {rate} * t, 2 * {width_text} deg) - {width_text} deg)"


def write_mechanism_text(linkage: Linkage) -> str:
    """Return the YAML text of a linkage. Raises InputError for a linkage without bodies."""
    if not linkage.bodies:
        raise InputError("the linkage has no moving body: expected a link with two joints")
    return _Writer(linkage).format_file()


def _convert_to_bar_axes(body: Body) -> tuple[float, dict[str, Point], Point | None]:
    """Return length, other points and centre of mass of a body in the axes of the bar between its first two points.

    Coordinates are divided by the length of the bar. The centre of mass is None if the body has none.
    """
    (x_tail, y_tail), (x_head, y_head) = list(body.point_positions.values())[:2]
    length = math.hypot(x_head - x_tail, y_head - y_tail)

    def convert_to_bar_axes(position: Point) -> Point:
        """Return a position of the body's frame in the axes of the bar, divided by its length."""
        dx, dy = position[0] - x_tail, position[1] - y_tail
        longitudinal, transverse = (
            dx * (x_head - x_tail) + dy * (y_head - y_tail),
            dy * (x_head - x_tail) - dx * (y_head - y_tail),
        )
        return longitudinal / length, transverse / length

    other_points = {name: convert_to_bar_axes(point) for name, point in list(body.point_positions.items())[2:]}
    return length, other_points, None if body.com is None else convert_to_bar_axes(body.com)


def _convert_direction(body: Body, direction: Point) -> Point:
    """Return a direction of the body's frame in the axes of the bar, multiplied by its length."""
    (x_tail, y_tail), (x_head, y_head) = list(body.point_positions.values())[:2]
    return direction[0] * (x_head - x_tail) + direction[1] * (y_head - y_tail), direction[1] * (
        x_head - x_tail
    ) - direction[0] * (y_head - y_tail)


def _convert_unit_to_metres(unit: str) -> float:
    """Return the length of a unit in m."""
    return {"m": 1.0, "cm": 0.01, "mm": 0.001}[unit]


def _format_number(x: float) -> str:
    """Return a number as text with 15 significant digits; −0 becomes "0"."""
    return f"{x + 0.0:.15g}"


def _format_comment(text: str) -> str:
    """Return a text for a comment: its printable characters, at most 200."""
    return "".join(c for c in text if c.isprintable())[:200]

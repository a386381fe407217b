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
MAX_WISH = 40  # characters of another program's name that are kept: a number, `_slot` or `_motor` follows
HEAD = """\
# {title}: read from a file of another program.
{notes}format: gudgeon/1
name: {name}
"""


class _Names:
    """Unique names that a mechanism file allows, for things of certain kinds."""

    def __init__(self, *kinds: str) -> None:
        """Create an empty set of names; kinds: see `check_name`."""
        self.kinds, self.found = kinds, dict[Hashable, str]()
        self.used, self.tried = set[str](), dict[str, int]()

    def of(self, key: Hashable, wish: str) -> str:
        """Return the name of a thing, as similar to `wish` as the format allows; the same key gives the same name."""
        if key not in self.found:
            latin = unicodedata.normalize("NFKD", wish[: 10 * MAX_WISH]).encode("ascii", "ignore").decode()
            plain = re.sub(r"[\W_]+", "_", latin)[:MAX_WISH].strip("_")
            if not self._is_legal(plain):
                plain = f"x_{plain}".rstrip("_")
            free, k = plain, self.tried.get(plain, 1)
            while free in self.used or not self._is_legal(free):
                k += 1
                free = f"{plain}_{k}"
            self.tried[plain] = k
            self.used.add(free)
            self.found[key] = free
        return self.found[key]

    def _is_legal(self, name: str) -> bool:
        """Return whether the format allows the name."""
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
        self.points, self.names = _Names("point"), _Names(*KINDS)
        self.shapes = {id(body): _bar_axes(body) for body in linkage.bodies}
        for body in linkage.bodies:
            self.named(body)
        self.rates = [self.names.of(("rate", k), "omega") for k in range(len(linkage.drives))]

    def named(self, body: Body) -> str:
        """Return the name of a body."""
        return self.names.of(id(body), body.name)

    def point(self, point: str) -> str:
        """Return the name of a point."""
        return self.points.of(point, point)

    def length(self, x: float) -> str:
        """Return a length with its unit as text."""
        return f"{_number(x)} {self.unit}"

    def place(self, body: Body, point: str) -> str:
        """Return how a joint refers to a point of a body: "rod.head"."""
        ends = dict(zip(islice(body.local, 2), ENDS, strict=True))
        return f"{self.named(body)}.{ends[point] if point in ends else self.point(point)}"

    def body(self, body: Body) -> str:
        """Return the line of a body: length, mass, inertia, centre of mass, points."""
        length, points, com = self.shapes[id(body)]
        mass = body.mass if body.mass is not None else LINE_MASS * length * _unit_in_metres(self.unit)
        inertia = body.inertia
        if inertia is None and com is not None:  # "auto" is that of a bar whose centre of mass is in its middle
            inertia = mass * (length * _unit_in_metres(self.unit)) ** 2 / 12.0
        inertias = "auto" if inertia is None else f"{_number(inertia)} kg*m^2"
        parts = [f"length: {self.length(length)}", f"mass: {_number(mass)} kg", f"inertia: {inertias}"]
        if com is not None:
            parts.append(f"com: [{self.length(com[0])}, {self.length(com[1])}]")
        if points:
            own = (f"{self.point(p)}: [{self.length(x)}, {self.length(y)}]" for p, (x, y) in points.items())
            parts.append(f"points: {{{', '.join(own)}}}")
        return f"  {self.named(body)}: {{{', '.join(parts)}}}"

    def joints(self) -> list[str]:
        """Return the lines of all joints.

        A revolute joint connects the first body of a point, or the ground, with every other body of the point. Points
        on lines become `point_on_line` joints.
        """
        lines = []
        for point in self.linkage.points():
            holders = [self.place(body, point) for body in self.linkage.holders.get(point, [])]
            if point in self.linkage.ground:
                holders.insert(0, f"ground.{self.point(point)}")
            for k, other in enumerate(holders[1:]):
                name = self.names.of(("joint", point, k), point if k == 0 else f"{point}_{k + 1}")
                lines.append(f"  {name}: {{revolute: [{holders[0]}, {other}]}}")
        for k, line in enumerate(self.linkage.lines):
            body, carrier = self.linkage.holding(line.point), line.body
            if body is None:
                raise InputError(f"joint {line.point}: it keeps to a line, and no link holds it")
            on = self.place(carrier, line.through) if carrier else f"ground.{self.point(line.through)}"
            x, y = _turn_direction(carrier, line.direction) if carrier else line.direction
            size = math.hypot(x, y)
            if not size > 0.0:
                raise InputError(f"joint {line.point}: the line to which it keeps has no direction")
            direction = f"[{_number(x / size)}, {_number(y / size)}]"
            points = f"[{self.place(body, line.point)}, {on}]"
            name = self.names.of(("line", k), f"{line.point}_slot")
            lines.append(f"  {name}: {{point_on_line: {points}, direction: {direction}}}")
        return lines

    def angle(self, body: Body | None) -> float | None:
        """Return the initial angle of a bar in rad; 0 for the ground, None if a position is unknown."""
        if body is None:
            return 0.0
        ends = [self.linkage.positions.get(point) for point in islice(body.local, 2)]
        if None in ends:
            return None
        (x, y), (u, v) = ends  # type: ignore[misc]
        return math.atan2(v - y, u - x)

    def text(self) -> str:
        """Return the whole file."""
        linkage = self.linkage
        notes = list(dict.fromkeys(linkage.notes))
        if any(body.mass is None for body in linkage.bodies):
            notes.append(f"masses are not in it: bars of {LINE_MASS:g} kg/m stand for them")
        if not linkage.measured:
            notes.append("it has no units: lengths are taken for metres")
        message = "".join(f"# {note[0].upper()}{note[1:]}.\n" for note in map(_comment_text, notes))
        name = _Names("mechanism").of("", linkage.name)
        out = [HEAD.format(title=_comment_text(linkage.name), notes=message, name=name)]
        if linkage.gravity is not None:
            out.append(f"gravity: [{_number(linkage.gravity[0])}, {_number(linkage.gravity[1])} m/s^2]\n")
        if linkage.drives:
            driven = zip(self.rates, linkage.drives, strict=True)
            rates = (f"  {name}: {_number(drive.rate)} 1/s" for name, drive in driven)
            out += ["\nparameters:\n", *(f"{line}\n" for line in rates)]
        out += ["\nbodies:\n", *(f"{self.body(body)}\n" for body in linkage.bodies)]
        joints = self.joints()
        if ground := self._ground():
            places = (f"{self.point(p)}: [{self.length(x)}, {self.length(y)}]" for p, (x, y) in ground)
            out += [f"\nground: {{{', '.join(places)}}}\n"]
        if joints:
            out += ["\njoints:\n", *(f"{line}\n" for line in joints)]
        return "".join([*out, *self._motion()])

    def _ground(self) -> list[tuple[str, Point]]:
        """Return the points of the ground that bodies or lines use."""
        used = {*self.linkage.holders, *(line.through for line in self.linkage.lines)}
        return [(p, place) for p, place in self.linkage.ground.items() if p in used]

    def _motion(self) -> list[str]:
        """Return the lines of the drives, which begin at the initial angles, and the guesses of the other angles."""
        out, driven = [], set[int]()
        for k, (rate, drive) in enumerate(zip(self.rates, self.linkage.drives, strict=True)):
            name, other = self.named(drive.body), drive.relative_to
            target = f"[{name}, {self.named(other)}]" if other else name
            if not other:
                driven.add(id(drive.body))
            motor = self.names.of(("drive", k), f"{name}_motor")
            out.append(f"  {motor}: {{angle: {target}, value: {self._value(drive, rate)}}}\n")
        out = ["\ndrives:\n", *out] if out else []
        guesses = [
            f"{self.named(body)}.theta: {_number(math.degrees(angle))} deg"
            for body in self.linkage.bodies
            if id(body) not in driven and (angle := self.angle(body)) is not None
        ]
        return [*out, *([f"\nstart:\n  guess: {{{', '.join(guesses)}}}\n"] if guesses else [])]

    def _value(self, drive: Drive, rate: str) -> str:
        """Return the expression of a drive: a constant rate, or a triangle wave between the ends of an arc."""
        ends = self.angle(drive.body), self.angle(drive.relative_to)
        first = 0.0 if None in ends else ends[0] - ends[1]  # type: ignore[operator]
        if drive.arc is None:
            return f"{_number(math.degrees(first))} deg + {rate} * t"
        low, high = drive.arc
        turns = math.ceil((low - first) / math.tau - 1e-9)
        first = max(first + turns * math.tau, low)
        if first > high + 1e-9:
            raise InputError(
                f"link {drive.body.name}: at {math.degrees(first):g}° it lies outside its arc from"
                f" {math.degrees(low):g}° to {math.degrees(high):g}°"
            )
        to, width, over = (_number(math.degrees(x)) for x in (high, high - low, first - low))
        return f"{to} deg - abs(mod({over} deg + {rate} * t, 2 * {width} deg) - {width} deg)"


def mechanism_text(linkage: Linkage) -> str:
    """Return the YAML text of a linkage. Raises InputError for a linkage without bodies."""
    if not linkage.bodies:
        raise InputError("nothing in it moves: it has no link of two joints")
    return _Writer(linkage).text()


def _bar_axes(body: Body) -> tuple[float, dict[str, Point], Point | None]:
    """Return the length of the bar between the first two points, the other points and the centre of mass in its
    axes."""
    (x, y), (u, v) = list(body.local.values())[:2]
    length = math.hypot(u - x, v - y)

    def in_bar_axes(at: Point) -> Point:
        """Return a position of the body's frame in the axes of the bar."""
        dx, dy = at[0] - x, at[1] - y
        along, across = dx * (u - x) + dy * (v - y), dy * (u - x) - dx * (v - y)
        return along / length, across / length

    others = {name: in_bar_axes(at) for name, at in list(body.local.items())[2:]}
    return length, others, None if body.com is None else in_bar_axes(body.com)


def _turn_direction(body: Body, direction: Point) -> Point:
    """Return a direction of the body's frame in the axes of the bar, multiplied by its length."""
    (x, y), (u, v) = list(body.local.values())[:2]
    return direction[0] * (u - x) + direction[1] * (v - y), direction[1] * (u - x) - direction[0] * (v - y)


def _unit_in_metres(unit: str) -> float:
    """Return the length of a unit in m."""
    return {"m": 1.0, "cm": 0.01, "mm": 0.001}[unit]


def _number(x: float) -> str:
    """Return a number with 15 digits."""
    return f"{x + 0.0:.15g}"


def _comment_text(text: str) -> str:
    """Return a text that can stand in a comment: printable, at most 200 characters."""
    return "".join(c for c in text if c.isprintable())[:200]

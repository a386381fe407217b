"""A linkage as a mechanism file of gudgeon's."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

from gudgeon.errors import InputError
from gudgeon.exchange.linkage import Body, Linkage, Point
from gudgeon.language.names import RESERVED

LINE_MASS = 1.0  # kg/m, of bodies whose file says no mass
ENDS = ("tail", "head")
HEAD = """\
# {title}: read from a file of another program.
{notes}format: gudgeon/1
name: {name}
"""


class _Names:
    """Names that a mechanism file can have, one for each of theirs."""

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self.found: dict[str, str] = {}
        self.taken = {*RESERVED, *ENDS, *taken}

    def of(self, name: str) -> str:
        """Letters, digits and underlines, not met before."""
        if name not in self.found:
            plain = re.sub(r"\W", "_", name, flags=re.ASCII).strip("_") or "x"
            plain = plain if plain[0].isalpha() else f"x{plain}"
            free, k = plain, 2
            while free in self.taken or free in self.found.values():
                free, k = f"{plain}_{k}", k + 1
            self.found[name] = free
        return self.found[name]


class _Writer:
    def __init__(self, linkage: Linkage) -> None:
        self.linkage, self.unit = linkage, linkage.unit
        self.points, self.bodies = _Names(), _Names(["ground", "omega"])
        self.parameters = [f"omega{'' if k == 0 else k + 1}" for k in range(len(linkage.drives))]
        self.shapes = {body.name: _barred(body) for body in linkage.bodies}

    def length(self, x: float) -> str:
        return f"{_number(x)} {self.unit}"

    def place(self, body: Body, point: str) -> str:
        """How a joint names a point of a body."""
        names = list(body.local)
        k = names.index(point)
        return f"{self.bodies.of(body.name)}.{ENDS[k] if k < 2 else self.points.of(point)}"

    def body(self, body: Body) -> str:
        length, points, com = self.shapes[body.name]
        mass = body.mass if body.mass is not None else LINE_MASS * length * _metres(self.unit)
        inertia = "auto" if body.inertia is None else f"{_number(body.inertia)} kg*m^2"
        parts = [f"length: {self.length(length)}", f"mass: {_number(mass)} kg", f"inertia: {inertia}"]
        if com is not None:
            parts.append(f"com: [{self.length(com[0])}, {self.length(com[1])}]")
        if points:
            own = (f"{self.points.of(p)}: [{self.length(x)}, {self.length(y)}]" for p, (x, y) in points.items())
            parts.append(f"points: {{{', '.join(own)}}}")
        return f"  {self.bodies.of(body.name)}: {{{', '.join(parts)}}}"

    def joints(self) -> list[str]:
        """A revolute joint between a point's first body, or the ground, and every other one; pins in slots."""
        lines, names = [], _Names()
        for point in self.linkage.positions | {p: (0, 0) for body in self.linkage.bodies for p in body.local}:
            holders = [self.place(body, point) for body in self.linkage.bodies if point in body.local]
            if point in self.linkage.ground:
                holders.insert(0, f"ground.{self.points.of(point)}")
            for k, other in enumerate(holders[1:]):
                name = names.of(point if k == 0 else f"{point}_{k + 1}")
                lines.append(f"  {name}: {{revolute: [{holders[0]}, {other}]}}")
        for line in self.linkage.lines:
            body = self.linkage.holding(line.point)
            if body is None:
                raise InputError(f"point {line.point} keeps to a line, and no body holds it")
            carrier = next((b for b in self.linkage.bodies if b.name == line.body), None)
            on = self.place(carrier, line.through) if carrier else f"ground.{self.points.of(line.through)}"
            x, y = _turned(carrier, line.direction) if carrier else line.direction
            size = math.hypot(x, y)
            direction = f"[{_number(x / size)}, {_number(y / size)}]"
            points = f"[{self.place(body, line.point)}, {on}]"
            lines.append(f"  {names.of(f'{line.point}_slot')}: {{point_on_line: {points}, direction: {direction}}}")
        return lines

    def angle(self, body: Body) -> float | None:
        """In which a bar lies at first, rad; None: nobody says."""
        first, second = list(body.local)[:2]
        ends = [self.linkage.positions.get(point) for point in (first, second)]
        if None in ends:
            return None
        (x, y), (u, v) = ends  # type: ignore[misc]
        return math.atan2(v - y, u - x)

    def text(self) -> str:
        linkage = self.linkage
        notes = list(dict.fromkeys(linkage.notes))
        if any(body.mass is None for body in linkage.bodies):
            notes.append(f"masses are not in it: bars of {LINE_MASS:g} kg/m stand for them")
        if not linkage.measured:
            notes.append("it has no units: lengths are taken for metres")
        told = "".join(f"# {note[0].upper()}{note[1:]}.\n" for note in notes)
        out = [HEAD.format(title=_comment(linkage.name), notes=told, name=_Names().of(linkage.name))]
        if linkage.gravity is not None:
            out.append(f"gravity: [{_number(linkage.gravity[0])}, {_number(linkage.gravity[1])} m/s^2]\n")
        if linkage.drives:
            driven = zip(self.parameters, linkage.drives, strict=True)
            rates = (f"  {name}: {_number(drive.rate)} 1/s" for name, drive in driven)
            out += ["\nparameters:\n", *(f"{line}\n" for line in rates)]
        out += ["\nbodies:\n", *(f"{self.body(body)}\n" for body in linkage.bodies)]
        if linkage.ground:
            places = (f"{self.points.of(p)}: [{self.length(x)}, {self.length(y)}]" for p, (x, y) in self._ground())
            out += [f"\nground: {{{', '.join(places)}}}\n"]
        if joints := self.joints():
            out += ["\njoints:\n", *(f"{line}\n" for line in joints)]
        return "".join([*out, *self._motion()])

    def _ground(self) -> list[tuple[str, Point]]:
        used = {p for body in self.linkage.bodies for p in body.local} | {line.through for line in self.linkage.lines}
        return [(p, place) for p, place in self.linkage.ground.items() if p in used]

    def _motion(self) -> list[str]:
        """Drives from where they stand, and where the other bodies are at first."""
        out, driven = [], set[str]()
        for name, drive in zip(self.parameters, self.linkage.drives, strict=True):
            body = next(body for body in self.linkage.bodies if body.name == drive.body)
            driven.add(body.name)
            first = math.degrees(self.angle(body) or 0.0)
            value = f"{_number(first)} deg + {name} * t"
            out.append(f"  {self.bodies.of(body.name)}_motor: {{angle: {self.bodies.of(body.name)}, value: {value}}}\n")
        out = ["\ndrives:\n", *out] if out else []
        guesses = [
            f"{self.bodies.of(body.name)}.theta: {_number(math.degrees(angle))} deg"
            for body in self.linkage.bodies if body.name not in driven and (angle := self.angle(body)) is not None
        ]  # fmt: skip
        return [*out, *([f"\nstart:\n  guess: {{{', '.join(guesses)}}}\n"] if guesses else [])]


def mechanism_text(linkage: Linkage) -> str:
    """The YAML. Raises InputError for a linkage without bodies."""
    if not linkage.bodies:
        raise InputError("nothing in it moves: it has no link of two joints")
    return _Writer(linkage).text()


def _barred(body: Body) -> tuple[float, dict[str, Point], Point | None]:
    """Length of the bar of its first two points; the others, and its centre of mass, in the bar's axes."""
    (x, y), (u, v) = list(body.local.values())[:2]
    length = math.hypot(u - x, v - y)
    if not length > 0.0:
        raise InputError(f"link {body.name}: its first two joints are at one place")

    def seen(at: Point) -> Point:
        dx, dy = at[0] - x, at[1] - y
        along, across = dx * (u - x) + dy * (v - y), dy * (u - x) - dx * (v - y)
        return along / length, across / length

    others = {name: seen(at) for name, at in list(body.local.items())[2:]}
    return length, others, None if body.com is None else seen(body.com)


def _turned(body: Body, direction: Point) -> Point:
    """A direction of the frame in which a body's points are given, in the bar's axes."""
    (x, y), (u, v) = list(body.local.values())[:2]
    return direction[0] * (u - x) + direction[1] * (v - y), direction[1] * (u - x) - direction[0] * (v - y)


def _metres(unit: str) -> float:
    return {"m": 1.0, "cm": 0.01, "mm": 0.001}[unit]


def _number(x: float) -> str:
    return f"{x + 0.0:.15g}"


def _comment(text: str) -> str:
    return "".join(c for c in text if c.isprintable())[:100]

"""A linkage of numpy_linkage.py as the text of a mechanism file, so that the product can be given the same data.

The centres of mass are put away from the bodies' origins (seeded), to try that too; numbers are
written with all digits.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .linkage_joints import CoordinateDrive, Distance, DistanceDrive, Gear, PointOnLine, Rigid
from .linkage_loads import Force, RotationalSpring, Signal, Spring, Term, Torque
from .numpy_linkage import GROUND, Drive, End, Law, Revolute, Translational, Wave
from .random_linkage import Case


class _Writer:
    """Gives every end a point name on its body."""

    def __init__(self, case: Case) -> None:
        rng = np.random.default_rng(case.seed + 1_000_003)
        self.com = rng.uniform(-0.1, 0.1, (len(case.linkage.bodies), 2))
        self.points: dict[int, list[str]] = {i: [] for i in range(GROUND, len(case.linkage.bodies))}

    def end(self, end: End) -> str:
        offset = np.zeros(2) if end.body == GROUND else self.com[end.body]
        name = f"p{len(self.points[end.body])}"
        x, y = (float(a + b) for a, b in zip(end.at, offset, strict=True))
        self.points[end.body].append(f"{name}: [{x!r}, {y!r}]")
        return f"{body(end.body)}.{name}"

    def ends(self, part: Any) -> str:
        return f"[{self.end(part.first)}, {self.end(part.second)}]"

    def joint(self, joint: Any) -> str:
        """What stands behind a joint's name."""
        if isinstance(joint, Gear):
            (r1, r2), carrier = joint.radii, body(joint.carrier)
            bodies = f"[{body(joint.first.body)}, {body(joint.second.body)}]"
            return f"gear: {bodies}, radii: [{r1!r}, {abs(r2)!r}], carrier: {carrier}, internal: {str(r2 < 0).lower()}"
        ends = self.ends(joint)
        if isinstance(joint, Revolute):
            return f"revolute: {ends}"
        if isinstance(joint, Rigid):
            return f"rigid: {ends}, angle: {joint.angle!r}"
        if isinstance(joint, Distance):
            return f"distance: {ends}, length: {joint.length!r}"
        if isinstance(joint, PointOnLine):
            return f"point_on_line: {ends}, direction: {pair(*joint.direction)}"
        assert isinstance(joint, Translational)
        return f"translational: {ends}, axis: {pair(*joint.axis)}, angle: {joint.angle!r}"

    def drive(self, drive: Any) -> str:
        value = f"value: {law(drive.law)}"
        if isinstance(drive, Drive):
            alone = drive.reference == GROUND
            return f"angle: {body(drive.body) if alone else f'[{body(drive.body)}, {body(drive.reference)}]'}, {value}"
        if isinstance(drive, CoordinateDrive):
            return f"coordinate: {body(drive.body)}.{('x', 'y', 'theta')[drive.which]}, {value}"
        assert isinstance(drive, DistanceDrive)
        return f"distance: {self.ends(drive)}, {value}"

    def load(self, load: Any) -> str:
        if isinstance(load, Spring):
            numbers = f"free_length: {load.free_length!r}, damping: {load.damping!r}"
            return f"spring_damper: {self.ends(load)}, stiffness: {load.stiffness!r}, {numbers}"
        if isinstance(load, RotationalSpring):
            numbers = f"free_angle: {load.free_angle!r}, damping: {load.damping!r}"
            bodies = f"[{body(load.first)}, {body(load.second)}]"
            return f"rotational_spring_damper: {bodies}, stiffness: {load.stiffness!r}, {numbers}"
        if isinstance(load, Force):
            value, axes = [self.signal(x, "N") for x in (load.x, load.y)], "body" if load.in_body else "ground"
            return f"force: {self.end(load.at)}, value: [{', '.join(value)}], axes: {axes}"
        assert isinstance(load, Torque)
        alone = load.second == GROUND
        bodies = body(load.first) if alone else f"[{body(load.first)}, {body(load.second)}]"
        return f"torque: {bodies}, value: {self.signal(load.value, 'N*m')}"

    def signal(self, signal: Signal, unit: str) -> str:
        """Every number with the unit that its term asks for."""
        text = f"{signal.constant!r} {unit}"
        if signal.swing:
            text += f" + {signal.swing!r} {unit} * sin({signal.w!r} rad/s * t)"
        return text + "".join(self.term(term, unit) for term in signal.terms)

    def term(self, term: Term, unit: str) -> str:
        names = ("vx", "vy", "omega") if term.rate else ("x", "y", "theta")
        owner = body(term.at) if isinstance(term.at, int) else self.end(term.at)
        unit += ("*s" if term.rate else "") + ("/m" if term.which < 2 else "")
        return f" + {term.factor!r} {unit} * {owner}.{names[term.which]}"


def body(index: int) -> str:
    return "ground" if index == GROUND else f"b{index}"


def pair(x: float, y: float) -> str:
    return f"[{x!r}, {y!r}]"


def law(of: Law) -> str:
    assert isinstance(of, Wave)
    return f"{of.a!r} + {of.b!r} * t + {of.c!r} * sin({of.w!r} * t)"


def _section(name: str, letter: str, entries: Sequence[str]) -> list[str]:
    return [f"{name}:", *(f"  {letter}{i}: {{{entry}}}" for i, entry in enumerate(entries))] if entries else []


def to_yaml(case: Case, name: str = "random_linkage", extra: Sequence[str] = ()) -> str:
    """The file's text; the guess is the case's own configuration. `extra`: more lines."""
    linkage, writer = case.linkage, _Writer(case)
    sections = _section("joints", "j", [writer.joint(joint) for joint in linkage.joints])
    sections += _section("drives", "d", [writer.drive(drive) for drive in linkage.drives])
    sections += _section("forces", "f", [writer.load(load) for load in linkage.loads])
    lines = ["format: gudgeon/1", f"name: {name}"]
    if any(linkage.gravity):
        lines.append(f"gravity: {pair(*linkage.gravity)}")
    lines.append("bodies:")
    for i, part in enumerate(linkage.bodies):
        com, points = pair(*(float(x) for x in writer.com[i])), ", ".join(writer.points[i])
        lines.append(f"  b{i}: {{mass: {part.mass!r}, inertia: {part.inertia!r}, com: {com}, points: {{{points}}}}}")
    if writer.points[GROUND]:
        lines.append(f"ground: {{{', '.join(writer.points[GROUND])}}}")
    guess = [f"b{k // 3}.{['x', 'y', 'theta'][k % 3]}: {float(x)!r}" for k, x in enumerate(case.q)]
    return "\n".join([*lines, *sections, f"start: {{guess: {{{', '.join(guess)}}}}}", *extra]) + "\n"

"""A linkage of numpy_linkage.py as the text of a mechanism file, so that the product can be given the same data.

The centres of mass are put away from the bodies' origins (seeded), to try that too; numbers are
written with all digits.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .numpy_linkage import GROUND, Drive, End, Revolute, Wave
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
        return f"{'ground' if end.body == GROUND else f'b{end.body}'}.{name}"


def _drive(index: int, drive: Drive) -> str:
    law = drive.law
    assert isinstance(law, Wave)
    angle = f"b{drive.body}" if drive.reference == GROUND else f"[b{drive.body}, b{drive.reference}]"
    return f"  d{index}: {{angle: {angle}, value: {law.a!r} + {law.b!r} * t + {law.c!r} * sin({law.w!r} * t)}}"


def _joint(index: int, joint: object, writer: _Writer) -> str:
    ends = f"[{writer.end(joint.first)}, {writer.end(joint.second)}]"  # type: ignore[attr-defined]
    if isinstance(joint, Revolute):
        return f"  j{index}: {{revolute: {ends}}}"
    axis, angle = joint.axis, joint.angle  # type: ignore[attr-defined]
    return f"  j{index}: {{translational: {ends}, axis: [{axis[0]!r}, {axis[1]!r}], angle: {angle!r}}}"


def to_yaml(case: Case, name: str = "random_linkage", extra: Sequence[str] = ()) -> str:
    """The file's text; the guess is the case's own configuration, the rates its own velocities. `extra`: more lines."""
    linkage, writer = case.linkage, _Writer(case)
    joints = [_joint(i, joint, writer) for i, joint in enumerate(linkage.joints)]
    drives = [_drive(i, drive) for i, drive in enumerate(linkage.drives)]
    lines = [
        "format: gudgeon/1",
        f"name: {name}",
        f"gravity: [{linkage.gravity[0]!r}, {linkage.gravity[1]!r}]",
        "bodies:",
    ]
    for i, body in enumerate(linkage.bodies):
        com = f"[{float(writer.com[i, 0])!r}, {float(writer.com[i, 1])!r}]"
        points = ", ".join(writer.points[i])
        lines.append(f"  b{i}: {{mass: {body.mass!r}, inertia: {body.inertia!r}, com: {com}, points: {{{points}}}}}")
    if writer.points[GROUND]:
        lines.append(f"ground: {{{', '.join(writer.points[GROUND])}}}")
    lines += ["joints:", *joints]
    if drives:
        lines += ["drives:", *drives]
    guess = [f"b{k // 3}.{['x', 'y', 'theta'][k % 3]}: {float(x)!r}" for k, x in enumerate(case.q)]
    lines.append(f"start: {{guess: {{{', '.join(guess)}}}}}")
    return "\n".join([*lines, *extra]) + "\n"

"""Draw the faults that `check` reports: joints that do not close, loose bodies, undriven motions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.assembly.closure import Closure
from gudgeon.assembly.failures import lengths_text
from gudgeon.assembly.mobility import free_motions
from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.joint_at import JointAt
from gudgeon.drawing.movers import HEAD, arrow, pivot, round_arrow
from gudgeon.drawing.posture import Posture, type_of
from gudgeon.drawing.shapes import Label, Line, Shape, unit_vector
from gudgeon.model.compiled import Array

OPEN = 1e-3  # fraction of the largest residual above which a residual is reported
REACH = 4.0  # units, of an arrow to where a body may go
MOVES = 1e-6  # fraction of the largest motion below which there is none


def gaps(closure: Closure, posture: Posture) -> tuple[list[Shape], list[Label]]:
    """Return red lines across the gaps of a linkage that does not close, with their lengths; open angles as text
    only.
    """
    residual = closure.residual(posture.q)
    scaled = np.abs(residual / closure.row_scale)
    worst = float(scaled.max(initial=0.0))
    open_rows: dict[str, list[int]] = {}
    for k, owner in enumerate(closure.owners):
        if worst > 0.0 and scaled[k] > OPEN * worst:
            open_rows.setdefault(owner, []).append(k)
    shapes, labels = list[Shape](), list[Label]()
    for owner, rows in open_rows.items():
        for part in posture.parts_named(owner):
            lengths = [residual[k] for k in rows if closure.units[k] == "m"]
            angles = [residual[k] for k in rows if closure.units[k] == "rad"]
            line = _gap_line(posture, part, lengths) if lengths else None
            if line is not None:
                shapes.append(Line(f"gap {owner}", "gap", line))
                lengths, place = [float(np.hypot(*(line[1] - line[0])))], line.mean(axis=0)
            elif lengths:
                place = type_of(part).symbol.place(JointAt(posture, part))
            else:
                place = pivot(posture, part)
            texts = [lengths_text(length) for length in lengths] + [f"{np.degrees(angle):.3g}°" for angle in angles]
            labels.append(Label(f"gap {owner}", "gap", f"{owner}: {', '.join(texts)}", place, way=90.0))
    return shapes, labels


def _gap_line(posture: Posture, part: PartInfo, lengths: list[float]) -> Array | None:
    """Return the line from the actual to the required end of a joint or driven length, (2, 2); None if no line shows
    it.
    """
    if part.section == "joints":
        gap = type_of(part).symbol.gap
        return np.array(gap(JointAt(posture, part), lengths)) if gap else None
    if part.kind == "coordinate":
        k = "xy".index(part.options["coordinate"])
        place = posture.place(part.ends[0])
        return np.array([place, place - lengths[0] * np.eye(2)[k]])
    a, b = (posture.place(end) for end in part.ends)
    return np.array([a + (float(np.hypot(*(b - a))) - lengths[0]) * unit_vector(b - a), b])


def freedoms(
    closure: Closure, posture: Posture, unit: float, loose: tuple[str, ...]
) -> tuple[list[Shape], list[Label]]:
    """Return arrows along the free motions of bodies of the closed linkage, and labels for `loose` bodies."""
    motions = free_motions(closure.linkage, closure.p, posture.q, closure.t)
    size = float(np.abs(motions * np.where(closure.is_angle, closure.size, 1.0)[:, None]).max(initial=0.0))
    shapes, labels = list[Shape](), list[Label]()
    for body, info in posture.bodies.items():
        own = motions[info.index : info.index + 3]
        found = list(_motion_arrows(own, posture.centre(body), body, unit, MOVES * size, closure.size))
        shapes += found
        if body in loose:
            labels.append(Label(f"free {body}", "free", f"nothing holds {body}", posture.centre(body), 1.5 * unit))
    return shapes, labels


def _motion_arrows(motions: Array, centre: Array, body: str, unit: float, least: float, size: float) -> Iterator[Shape]:
    """Yield double arrows along each direction in which the centre of a body is free, and around it if the body can
    rotate.
    """
    part, head = f"free {body}", HEAD * unit
    directions, values, _ = np.linalg.svd(motions[:2], full_matrices=False)
    moving = [way for way, value in zip(directions.T, values, strict=True) if value > least]
    if len(moving) > 1:
        moving = [np.array([1.0, 0.0]), np.array([0.0, 1.0])]
    for way in moving:
        for sign in (1.0, -1.0):
            yield from arrow(part, "free", centre + sign * unit * way, centre + sign * REACH * unit * way, head)
    alone = not moving or len(moving) > 1
    if alone and float(np.abs(motions[2]).max(initial=0.0)) * size > least:
        yield from round_arrow(part, "free", centre, 3.4 * unit, True, head)

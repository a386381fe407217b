"""Draw bodies: links between two pins, plates through more, blocks on their guides."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.joint_at import axes_of, axis_of, gap_of, guide_and_slider, is_block, sliding
from gudgeon.drawing.plan import Plan
from gudgeon.drawing.posture import Posture, anchors, body_of, distinct
from gudgeon.drawing.shapes import Disc, Label, Line, Shape, rectangle, rounded
from gudgeon.model.compiled import Array

BLOCK = (2.1, 1.25)  # half length and width of a slider, in units
SLOT, STRIP = 1.0, 0.55  # half widths: of a slotted link, of a bar that guides


def bodies(posture: Posture, plan: Plan, loose: frozenset[str] = frozenset()) -> Iterator[Shape]:
    """Yield the shapes of every body of a scene; `loose` bodies have a different colour."""
    for tint, body in enumerate(posture.bodies):
        for role, outline in _outlines(posture, plan, body):
            yield Line(f"body {body}", "loose" if body in loose and role == "body" else role, outline, True, tint)
        yield from _point_marks(posture, plan, body, tint)


def _outlines(posture: Posture, plan: Plan, body: str) -> Iterator[tuple[str, Array]]:
    """Yield role and closed outline of a body: its link or plate, its guides for other bodies, its blocks."""
    u, places = plan.unit, distinct(anchors(posture, body).values())
    guided, blocks = [], []
    for part in sliding(posture):
        guide, slider = map(body_of, guide_and_slider(part))
        if guide == body:
            guided.append(part)
        if slider == body and is_block(part):
            blocks.append(part)
    if not ((blocks or guided) and _is_held_once(posture, body)):
        yield "body", rounded(places, u if len(places) > 1 else 1.6 * u)
    for part in guided:
        ends = guide_ends(posture, plan, part)
        if gap := gap_of(posture, part, u):
            yield "guide", rounded(ends, BLOCK[1] * u + gap + 0.55 * u)
            yield "channel", rounded(ends, BLOCK[1] * u + gap)
        else:
            yield "body", rounded(ends, (STRIP if is_block(part) else SLOT + 0.55) * u)
    for part in blocks:
        yield "body", rectangle(axis_of(posture, part)[2], axes_of(posture, part)[1], BLOCK[0] * u, BLOCK[1] * u)


def _is_held_once(posture: Posture, body: str) -> bool:
    """Return whether a body has joints and named points at one place only."""
    names = [name for name in anchors(posture, body) if not name.endswith(".com")]
    return len(distinct(posture.place(name) for name in names)) < 2


def guide_ends(posture: Posture, plan: Plan, part: PartInfo) -> list[Array]:
    """Return both ends of a slot or guide bar, as far as the slider travels.

    A bar extends to the body's own point, as does a slot that is not on one of the body's links.
    """
    on, along, _ = axis_of(posture, part)
    low, high = plan.travel[part.name]
    more = (BLOCK[0] + 0.6 if is_block(part) else 1.6) * plan.unit
    low, high = low - more, high + more
    guide = body_of(guide_and_slider(part)[0])
    if is_block(part) or not _lies_on_link(posture, guide, on + low * along, on + high * along):
        low, high = min(low, 0.0), max(high, 0.0)
    return [on + low * along, on + high * along]


def _lies_on_link(posture: Posture, body: str, *ends: Array) -> bool:
    """Return whether a slot lies on the link between two points of its body."""
    places = distinct(anchors(posture, body).values())
    for k, a in enumerate(places):
        for b in places[:k]:
            span = b - a
            shares = [float((end - a) @ span / (span @ span)) for end in ends]
            away = [float(np.hypot(*(end - a - s * span))) for end, s in zip(ends, shares, strict=True)]
            if max(away) < 1e-3 * float(np.hypot(*span)) and min(shares) < 1.0 and max(shares) > 0.0:
                return True
    return False


def _point_marks(posture: Posture, plan: Plan, body: str, tint: int) -> Iterator[Shape]:
    """Yield a small dot for each named point that no joint or element uses."""
    held = {end for part in posture.source.parts for end in part.ends}
    for name in posture.points:
        owner, _, point = name.partition(".")
        if owner == body and name not in held and point not in ("head", "tail", "origin", "com"):
            yield Disc(f"point {name}", "mark", posture.place(name), 0.22 * plan.unit, tint)


def labels_of_bodies(posture: Posture, plan: Plan) -> Iterator[Label]:
    """Yield the labels of bodies at the middle of their points, and of marked points."""
    for body in posture.bodies:
        places = distinct(anchors(posture, body).values())
        middle = np.mean(places, axis=0)
        yield Label(f"body {body}", "body", body, middle, 1.2 * plan.unit)
    for shape in (shape for body in posture.bodies for shape in _point_marks(posture, plan, body, 0)):
        yield Label(shape.part, "point", shape.part.rpartition(".")[2], shape.centre, 0.4 * plan.unit)  # type: ignore[union-attr]

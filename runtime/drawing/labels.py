"""Place names next to the parts of a sketch, without overlap and with as few crossings of lines as possible.

Positions are searched when the figure is drawn, in pixels: greedily, in the order of the names, on rings around each
part. The same figure gives the same positions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.drawing.roles import NAMES, colour_of
from gudgeon.drawing.shapes import Disc, Label, Shape, Sketch, arc
from gudgeon.errors import GudgeonError
from gudgeon.language.shown import one_line
from gudgeon.model.compiled import Array

try:  # here, because everything that draws imports this module before matplotlib
    from matplotlib.artist import Artist
    from matplotlib.lines import Line2D
    from matplotlib.text import Text
except ModuleNotFoundError as error:
    raise GudgeonError("figures need matplotlib: pip install 'gudgeon[plot]'") from error

RINGS = (2.0, 6.0, 11.0, 17.0, 25.0, 35.0, 48.0, 64.0, 84.0, 110.0, 145.0, 190.0)  # points from the named part
ORDER = (45.0, 0.0, 90.0, 180.0, 270.0, 135.0, 315.0, 225.0, *(22.5 + 45.0 * k for k in range(8)))  # on a ring, degrees
LED = 15.0  # points from its part, beyond which a name has a leader line
GAP = 1.2  # points between names
CROSSED = 2.0  # cost of a crossing of a leader line, in crossings of other lines
LEFT_FREE = 3.0  # points between a name and the leader line of another one


class Names(Artist):
    """All names of a sketch; `boxes` are their boxes after drawing, (left, low, right, high) in pixels by part.

    `beside` is then the offset of each name's middle from its part. `held` has the offsets of the previous picture of a
    motion, which are kept while there is room.
    """

    def __init__(self, sketch: Sketch, size: float) -> None:
        """Create the texts of a sketch with a font size."""
        super().__init__()
        self.set_zorder(6.0)
        self.set_in_layout(False)
        self.sketch, self.boxes = sketch, dict[str, tuple[float, float, float, float]]()
        self.beside, self.held = dict[str, tuple[float, float]](), dict[str, tuple[float, float]]()
        self.order = {shape.part: shape.tint for shape in sketch.shapes if shape.part.startswith("body ")}
        self.texts = [self._make_text(label, size) for label in sketch.labels]

    def _make_text(self, label: Label, size: float) -> Text:
        """Return the text artist of a label."""
        word, weight = NAMES[label.role]
        colour = colour_of(word, self.order.get(label.part, 0)) if word in ("edge",) else word
        text = Text(
            0.0,
            0.0,
            one_line(label.text),
            size=size,
            color=colour,
            weight=weight,
            ha="center",
            va="center",
            transform=None,
            parse_math=False,
            style="italic" if label.role == "joint" else "normal",
        )
        text.set_gid(gid("name", label.part))
        return text

    def draw(self, renderer: Any) -> None:
        """Place and paint the names."""
        if not self.get_visible() or self.axes is None:
            return
        self.place(renderer)
        renderer.open_group("names")
        for line in self.leads:
            line.draw(renderer)
        for text in self.texts:
            text.draw(renderer)
        if left := sum(not text.get_visible() for text in self.texts):
            self._omission_note(left).draw(renderer)
        renderer.close_group("names")
        self.stale = False

    def place(self, renderer: Any) -> None:
        """Find a position for each name, and a leader line for distant ones."""
        axes: Any = self.axes
        figure, to_pixels = axes.get_figure(root=True), axes.transData.transform
        point = figure.dpi / 72.0
        room = np.array(axes.get_window_extent(renderer).extents)
        metre = float(np.hypot(*(to_pixels((1.0, 0.0)) - to_pixels((0.0, 0.0)))))
        halves = {}
        for text, label in zip(self.texts, self.sketch.labels, strict=True):
            text.set_figure(figure)
            text.set_position((0.0, 0.0))
            extent = text.get_window_extent(renderer)
            halves[label.part] = 0.5 * np.array([extent.width, extent.height])
        self.beside = place_names(self.sketch, halves, self.held, to_pixels, metre, point, room)
        self.leads, self.boxes = [], {}
        for text, label in zip(self.texts, self.sketch.labels, strict=True):
            text.set_visible(label.part in self.beside)
            if label.part not in self.beside:
                continue
            at, half, clear = to_pixels(label.place), halves[label.part], label.clear * metre
            middle = at + self.beside[label.part]
            text.set_position((float(middle[0]), float(middle[1])))
            self.boxes[label.part] = tuple([*(middle - half), *(middle + half)])
            if needs_leader(at, middle, half, clear, point):
                self.leads.append(self._lead_line(at, middle, half, clear))

    def _omission_note(self, count: int) -> Text:
        """Return a text for the upper right corner that names were left out."""
        axes: Any = self.axes
        message = f"{count} name{'' if count == 1 else 's'} left out: there is no room"
        text = Text(1.0, 1.0, message, size=7.0, color="#888888", ha="right", va="bottom", transform=axes.transAxes)
        text.set_figure(axes.get_figure(root=True))
        return text

    def _lead_line(self, at: Array, middle: Array, half: Array, clear: float) -> Line2D:
        """Return the leader line of a name."""
        axes: Any = self.axes
        ends = leader_line(at, middle, half, clear).reshape(2, 2)
        line = Line2D(*ends.T, color="#999999", lw=0.5, transform=None)
        line.set_figure(axes.get_figure(root=True))
        return line


def place_names(
    sketch: Sketch,
    halves: Mapping[str, Array],
    held: Mapping[str, tuple[float, float]],
    to_pixels: Any,
    metre: float,
    point: float,
    room: Array,
) -> dict[str, tuple[float, float]]:
    """Return the offset of the middle of each name from its part, in pixels; without names that find no position.

    halves: half of each name's width and height. held: offsets of the previous picture, which a name keeps while it
    overlaps no other name and is within the `room`. metre, point: their size in pixels.
    """
    offsets, boxes_so_far, leads = dict[str, tuple[float, float]](), np.zeros((0, 4)), np.zeros((0, 4))
    lines: Array | None = None
    for label in sketch.labels:
        at, half, clear = to_pixels(label.place), halves[label.part], label.clear * metre
        middle = at + held.get(label.part, (0.0, 0.0))
        box = np.array([[*(middle - half), *(middle + half)]])
        if label.part not in held or overlapping(box, boxes_so_far).any() or not _is_within(box, room)[0]:
            lines = obstacles(sketch.shapes, to_pixels) if lines is None else lines
            found = best_place(at, half, label.way, clear, point, lines, boxes_so_far, room, leads)
            if found is None:
                continue
            middle = found
            box = np.array([[*(middle - half), *(middle + half)]])
            if needs_leader(at, middle, half, clear, point):
                leads = np.vstack([leads, leader_line(at, middle, half, clear)])  # which later names avoid
        offsets[label.part] = float(middle[0] - at[0]), float(middle[1] - at[1])
        boxes_so_far = np.vstack([boxes_so_far, box])
    return offsets


def leader_line(at: Array, middle: Array, half: Array, clear: float) -> Array:
    """Return the leader line from the edge of a part to that of its name, a segment (1, 4)."""
    edge = np.clip(at, middle - half, middle + half)
    begin = at + clear * (edge - at) / max(float(np.hypot(*(edge - at))), clear, 1e-300)
    return np.array([[*begin, *edge]])


def needs_leader(at: Array, middle: Array, half: Array, clear: float, point: float) -> bool:
    """Return whether a name is so far from its part that it needs a leader line."""
    edge = np.clip(at, middle - half, middle + half)
    return float(np.hypot(*(edge - at))) - clear > LED * point


def gid(kind: str, part: str) -> str:
    """Return the identifier of a part in a picture: "joint A" is "joint-A", its name "name-joint-A"."""
    return "-".join([*([kind] if kind else []), *part.split()])


def obstacles(shapes: Sequence[Shape], to_pixels: Any) -> Array:
    """Return all lines of shapes as segments in pixels, (S, 4)."""
    found = [to_pixels(points) for points in _outlines(shapes)]
    return np.vstack([np.hstack([points[:-1], points[1:]]) for points in found]) if found else np.zeros((0, 4))


def _outlines(shapes: Sequence[Shape]) -> Iterator[Array]:
    """Yield the outline of each shape as points."""
    for shape in shapes:
        if isinstance(shape, Disc):
            yield arc(shape.centre, shape.radius, 0.0, 2.0 * np.pi, 17)
        else:
            yield np.vstack([shape.points, shape.points[:1]]) if shape.closed else shape.points


def best_place(
    at: Array,
    half: Array,
    direction: float,
    clear: float,
    point: float,
    lines: Array,
    boxes_so_far: Array,
    room: Array,
    leads: Array,
) -> Array | None:
    """Return the best position of the middle of a name, pixels; None if there is none.

    It is the nearest one on no line and no other name, with a leader line that crosses no name or leader line;
    otherwise the one with the fewest crossings. `half` is half the name's size, `room` the picture's box, `leads` the
    leader lines so far.
    """
    angles = np.radians([direction, *ORDER])
    ways = np.column_stack([np.cos(angles), np.sin(angles)])
    fallback, fewest = at, np.inf
    for ring in RINGS:
        reach = clear + ring * point
        middles = at + ways * (reach + half)
        if ring == RINGS[0] and clear * point > 0.0:
            middles = np.vstack([at, middles])
        boxes = np.hstack([middles - half - GAP * point, middles + half + GAP * point])
        free = ~overlapping(boxes, boxes_so_far).any(axis=1) & _is_within(boxes, room)
        hits = np.array(
            [
                crossing(box, lines) + CROSSED * crossing(box, leads) if ok else np.inf
                for box, ok in zip(boxes, free, strict=True)
            ]
        )
        for j in np.flatnonzero(free):
            if len(boxes_so_far) and needs_leader(at, middles[j], half, clear, point):
                back = leader_line(at, middles[j], half, clear)
                under = sum(crossing(box, back) for box in boxes_so_far + LEFT_FREE * point * np.array([-1, -1, 1, 1]))
                hits[j] += CROSSED * (under + sum(_segments_cross(back[0], one) for one in leads))
        costs = hits + 0.02 * ring
        k = int(np.argmin(costs))
        if hits[k] == 0.0:
            return middles[k]
        if costs[k] < fewest:
            fallback, fewest = middles[k], costs[k]
    return fallback if np.isfinite(fewest) else None


def overlapping(boxes: Array, others: Array) -> NDArray[np.bool_]:
    """Return which boxes (B, 4) overlap which others (T, 4), (B, T)."""
    a, b = boxes[:, None], others[None]
    across = (a[..., 0] < b[..., 2]) & (b[..., 0] < a[..., 2])
    return np.asarray(across & (a[..., 1] < b[..., 3]) & (b[..., 1] < a[..., 3]), dtype=bool)


def _is_within(boxes: Array, room: Array) -> NDArray[np.bool_]:
    """Return which boxes (B, 4) are within the room (4,)."""
    return np.asarray((boxes[:, :2] >= room[:2]).all(axis=1) & (boxes[:, 2:] <= room[2:]).all(axis=1), dtype=bool)


def _segments_cross(one: Array, other: Array) -> bool:
    """Return whether two segments, (4,), cross."""

    def side(line: Array, point: Array) -> float:
        """Return the signed area that a point and a line span."""
        along, to = line[2:] - line[:2], point - line[:2]
        return float(along[0] * to[1] - along[1] * to[0])

    return all(side(a, b[:2]) * side(a, b[2:]) < 0.0 for a, b in ((one, other), (other, one)))


def crossing(box: Array, lines: Array) -> float:
    """Return the number of segments (S, 4) that meet a box (Liang and Barsky)."""
    start, span = lines[:, :2], lines[:, 2:] - lines[:, :2]
    with np.errstate(all="ignore"):
        one, other = (box[:2] - start) / span, (box[2:] - start) / span
    near, far = np.minimum(one, other), np.maximum(one, other)
    still = span == 0.0
    within = (start >= box[:2]) & (start <= box[2:])
    near = np.where(still, np.where(within, -np.inf, np.inf), near)
    far = np.where(still, np.where(within, np.inf, -np.inf), far)
    enters, leaves = np.maximum(near.max(axis=1), 0.0), np.minimum(far.min(axis=1), 1.0)
    return float((enters <= leaves).sum())

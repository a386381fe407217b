"""Names beside what they belong to, so that none lies on another one and as few as can be on lines.

Places are sought when the picture is drawn, in its own pixels: greedily, in the order of the names, on rings around
each. The same picture gives the same places.
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

RINGS = (2.0, 6.0, 11.0, 17.0, 25.0, 35.0, 48.0, 64.0, 84.0, 110.0, 145.0, 190.0)  # points from what is named
ORDER = (45.0, 0.0, 90.0, 180.0, 270.0, 135.0, 315.0, 225.0, *(22.5 + 45.0 * k for k in range(8)))  # on a ring, degrees
LED = 15.0  # points; further off than that a thin line leads back
GAP = 1.2  # points between names
CROSSED = 2.0  # lines that a crossing of two thin lines, or of one and a name, counts for beside its own
LEFT_FREE = 3.0  # points between a name and what leads to another one


class Names(Artist):
    """All names of a sketch; `boxes` are where they are after drawing, (left, low, right, high) in pixels by part.

    `beside` is then how far the middle of each is from what it names; `held`, the same of the picture before of a
    motion, keeps them there while there is room.
    """

    def __init__(self, sketch: Sketch, size: float) -> None:
        super().__init__()
        self.set_zorder(6.0)
        self.set_in_layout(False)
        self.sketch, self.boxes = sketch, dict[str, tuple[float, float, float, float]]()
        self.beside, self.held = dict[str, tuple[float, float]](), dict[str, tuple[float, float]]()
        self.order = {shape.part: shape.tint for shape in sketch.shapes if shape.part.startswith("body ")}
        self.texts = [self._text(label, size) for label in sketch.labels]

    def _text(self, label: Label, size: float) -> Text:
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
        """Place and paint."""
        if not self.get_visible() or self.axes is None:
            return
        self.place(renderer)
        renderer.open_group("names")
        for line in self.leads:
            line.draw(renderer)
        for text in self.texts:
            text.draw(renderer)
        if left := sum(not text.get_visible() for text in self.texts):
            self._told(left).draw(renderer)
        renderer.close_group("names")
        self.stale = False

    def place(self, renderer: Any) -> None:
        """Find a place for each."""
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
        self.beside = settled(self.sketch, halves, self.held, to_pixels, metre, point, room)
        self.leads, self.boxes = [], {}
        for text, label in zip(self.texts, self.sketch.labels, strict=True):
            text.set_visible(label.part in self.beside)
            if label.part not in self.beside:
                continue
            at, half, clear = to_pixels(label.place), halves[label.part], label.clear * metre
            middle = at + self.beside[label.part]
            text.set_position((float(middle[0]), float(middle[1])))
            self.boxes[label.part] = tuple([*(middle - half), *(middle + half)])
            if is_led(at, middle, half, clear, point):
                self.leads.append(self._lead(at, middle, half, clear))

    def _told(self, left: int) -> Text:
        """That names are missing, in the upper right corner."""
        axes: Any = self.axes
        told = f"{left} name{'' if left == 1 else 's'} left out: there is no room"
        text = Text(1.0, 1.0, told, size=7.0, color="#888888", ha="right", va="bottom", transform=axes.transAxes)
        text.set_figure(axes.get_figure(root=True))
        return text

    def _lead(self, at: Array, middle: Array, half: Array, clear: float) -> Line2D:
        axes: Any = self.axes
        ends = lead(at, middle, half, clear).reshape(2, 2)
        line = Line2D(*ends.T, color="#999999", lw=0.5, transform=None)
        line.set_figure(axes.get_figure(root=True))
        return line


def settled(
    sketch: Sketch,
    halves: Mapping[str, Array],
    held: Mapping[str, tuple[float, float]],
    to_pixels: Any,
    metre: float,
    point: float,
    room: Array,
) -> dict[str, tuple[float, float]]:
    """How far the middle of each name is from what it names, by part, pixels; without those that have no place.

    halves: half of each name's width and height. held: the same of the picture before, which a name keeps while it
    lies on no other name and within the `room`. metre, point: their pixels.
    """
    beside, taken, leads = dict[str, tuple[float, float]](), np.zeros((0, 4)), np.zeros((0, 4))
    lines: Array | None = None
    for label in sketch.labels:
        at, half, clear = to_pixels(label.place), halves[label.part], label.clear * metre
        middle = at + held.get(label.part, (0.0, 0.0))
        box = np.array([[*(middle - half), *(middle + half)]])
        if label.part not in held or overlapping(box, taken).any() or not _inside(box, room)[0]:
            lines = obstacles(sketch.shapes, to_pixels) if lines is None else lines
            found = best_place(at, half, label.way, clear, point, lines, taken, room, leads)
            if found is None:
                continue
            middle = found
            box = np.array([[*(middle - half), *(middle + half)]])
            if is_led(at, middle, half, clear, point):
                leads = np.vstack([leads, lead(at, middle, half, clear)])  # which the names behind it leave free
        beside[label.part] = float(middle[0] - at[0]), float(middle[1] - at[1])
        taken = np.vstack([taken, box])
    return beside


def lead(at: Array, middle: Array, half: Array, clear: float) -> Array:
    """From the edge of what is named to that of its name, a segment (1, 4)."""
    edge = np.clip(at, middle - half, middle + half)
    begin = at + clear * (edge - at) / max(float(np.hypot(*(edge - at))), clear, 1e-300)
    return np.array([[*begin, *edge]])


def is_led(at: Array, middle: Array, half: Array, clear: float, point: float) -> bool:
    """Whether a name is so far from what it names that a line leads back."""
    edge = np.clip(at, middle - half, middle + half)
    return float(np.hypot(*(edge - at))) - clear > LED * point


def gid(kind: str, part: str) -> str:
    """An identifier of a part in a picture: "joint A" is "joint-A", its name "name-joint-A"."""
    return "-".join([*([kind] if kind else []), *part.split()])


def obstacles(shapes: Sequence[Shape], to_pixels: Any) -> Array:
    """All lines as segments in pixels, (S, 4)."""
    found = [to_pixels(points) for points in _outlines(shapes)]
    return np.vstack([np.hstack([points[:-1], points[1:]]) for points in found]) if found else np.zeros((0, 4))


def _outlines(shapes: Sequence[Shape]) -> Iterator[Array]:
    for shape in shapes:
        if isinstance(shape, Disc):
            yield arc(shape.centre, shape.radius, 0.0, 2.0 * np.pi, 17)
        else:
            yield np.vstack([shape.points, shape.points[:1]]) if shape.closed else shape.points


def best_place(
    at: Array,
    half: Array,
    way: float,
    clear: float,
    point: float,
    lines: Array,
    taken: Array,
    room: Array,
    leads: Array,
) -> Array | None:
    """The middle of a name: the nearest place on no line and no other name, to which no line leads under another name
    or across another such line; where every place has a line, the one with the fewest; None where there is no place.
    Pixels; `half` its size, `room` the picture's box, `leads` the lines that lead to names."""
    angles = np.radians([way, *ORDER])
    ways = np.column_stack([np.cos(angles), np.sin(angles)])
    fallback, fewest = at, np.inf
    for ring in RINGS:
        reach = clear + ring * point
        middles = at + ways * (reach + half)
        if ring == RINGS[0] and clear * point > 0.0:
            middles = np.vstack([at, middles])
        boxes = np.hstack([middles - half - GAP * point, middles + half + GAP * point])
        free = ~overlapping(boxes, taken).any(axis=1) & _inside(boxes, room)
        hits = np.array(
            [
                crossing(box, lines) + CROSSED * crossing(box, leads) if ok else np.inf
                for box, ok in zip(boxes, free, strict=True)
            ]
        )
        for j in np.flatnonzero(free):
            if len(taken) and is_led(at, middles[j], half, clear, point):
                back = lead(at, middles[j], half, clear)
                under = sum(crossing(box, back) for box in taken + LEFT_FREE * point * np.array([-1, -1, 1, 1]))
                hits[j] += CROSSED * (under + sum(_cross(back[0], one) for one in leads))
        costs = hits + 0.02 * ring
        k = int(np.argmin(costs))
        if hits[k] == 0.0:
            return middles[k]
        if costs[k] < fewest:
            fallback, fewest = middles[k], costs[k]
    return fallback if np.isfinite(fewest) else None


def overlapping(boxes: Array, taken: Array) -> NDArray[np.bool_]:
    """Which boxes (B, 4) overlap which others (T, 4), (B, T)."""
    a, b = boxes[:, None], taken[None]
    across = (a[..., 0] < b[..., 2]) & (b[..., 0] < a[..., 2])
    return np.asarray(across & (a[..., 1] < b[..., 3]) & (b[..., 1] < a[..., 3]), dtype=bool)


def _inside(boxes: Array, room: Array) -> NDArray[np.bool_]:
    return np.asarray((boxes[:, :2] >= room[:2]).all(axis=1) & (boxes[:, 2:] <= room[2:]).all(axis=1), dtype=bool)


def _cross(one: Array, other: Array) -> bool:
    """Whether two segments, (4,), cross."""

    def side(line: Array, point: Array) -> float:
        along, to = line[2:] - line[:2], point - line[:2]
        return float(along[0] * to[1] - along[1] * to[0])

    return all(side(a, b[:2]) * side(a, b[2:]) < 0.0 for a, b in ((one, other), (other, one)))


def crossing(box: Array, lines: Array) -> float:
    """How many segments (S, 4) meet a box (Liang and Barsky)."""
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

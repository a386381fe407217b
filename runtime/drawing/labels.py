"""Place names (labels) next to the parts of a sketch, without overlap and with as few crossings of lines as possible.

Positions are searched when the figure is drawn, in pixels: greedily, in the order of the names, on rings around each
part. The same figure gives the same positions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.drawing.roles import NAMES, resolve_colour
from gudgeon.drawing.shapes import Disc, Label, Shape, Sketch, compute_arc
from gudgeon.errors import GudgeonError
from gudgeon.language.text_output import format_one_line
from gudgeon.model.compiled import Array

try:  # here, because all drawing modules import this module before matplotlib
    from matplotlib.artist import Artist
    from matplotlib.lines import Line2D
    from matplotlib.text import Text
except ModuleNotFoundError as error:
    raise GudgeonError("figures need matplotlib: pip install 'gudgeon[plot]'") from error

RING_DISTANCES = (2.0, 6.0, 11.0, 17.0, 25.0, 35.0, 48.0, 64.0, 84.0, 110.0, 145.0, 190.0)  # points from the named part
ANGLES_DEG = (
    45.0,
    0.0,
    90.0,
    180.0,
    270.0,
    135.0,
    315.0,
    225.0,
    *(22.5 + 45.0 * k for k in range(8)),
)  # on a ring, degrees
MIN_LEADER_DISTANCE = 15.0  # points from its part, beyond which a name has a leader line
NAME_GAP = 1.2  # points between names
LEADER_CROSSING_COST = 2.0  # of a crossing of a leader line, as a multiple of a crossing of another line
MIN_LEADER_GAP = 3.0  # points between a name and the leader line of another one


class NameLabels(Artist):
    """All names of a sketch; `boxes` are their boxes after drawing, (left, low, right, high) in pixels by part.

    `label_offsets` then has the offset of each name's middle from its part. `previous_offsets` has those of the
    previous picture of a motion, which names keep while they overlap no other name.
    """

    def __init__(self, sketch: Sketch, size: float) -> None:
        """Create the texts of a sketch with a font size."""
        super().__init__()
        self.set_zorder(6.0)
        self.set_in_layout(False)
        self.sketch, self.boxes = sketch, dict[str, tuple[float, float, float, float]]()
        self.label_offsets, self.previous_offsets = dict[str, tuple[float, float]](), dict[str, tuple[float, float]]()
        self.body_tints = {shape.part: shape.colour_index for shape in sketch.shapes if shape.part.startswith("body ")}
        self.texts = [self._make_text(label, size) for label in sketch.labels]

    def _make_text(self, label: Label, size: float) -> Text:
        """Return the text artist of a label, centred and without position, in the style of its role.

        `size` is the font size in points. The artist has an identifier of the label's part for SVG.
        """
        colour_name, weight = NAMES[label.role]
        colour = (
            resolve_colour(colour_name, self.body_tints.get(label.part, 0)) if colour_name in ("edge",) else colour_name
        )
        text = Text(
            0.0,
            0.0,
            format_one_line(label.text),
            size=size,
            color=colour,
            weight=weight,
            ha="center",
            va="center",
            transform=None,
            parse_math=False,
            style="italic" if label.role == "joint" else "normal",
        )
        text.set_gid(make_identifier("name", label.part))
        return text

    def draw(self, renderer: Any) -> None:
        """Place and paint all names, their leader lines, and a note if names were left out.

        matplotlib calls it when it draws the figure. Nothing is painted without axes or if the artist is hidden.
        """
        if not self.get_visible() or self.axes is None:
            return
        self.place_texts(renderer)
        renderer.open_group("names")
        for line in self.leader_lines:
            line.draw(renderer)
        for text in self.texts:
            text.draw(renderer)
        if n_omitted := sum(not text.get_visible() for text in self.texts):
            self._create_omission_note(n_omitted).draw(renderer)
        renderer.close_group("names")
        self.stale = False

    def place_texts(self, renderer: Any) -> None:
        """Find a position for each name in pixels, and create leader lines for distant names.

        Sets `label_offsets` (pixels from the part), `boxes` and `leader_lines`, and hides texts without a free
        position. Names keep their `previous_offsets` if these are free.
        """
        axes: Any = self.axes
        figure, to_pixels = axes.get_figure(root=True), axes.transData.transform
        point = figure.dpi / 72.0
        picture_box = np.array(axes.get_window_extent(renderer).extents)
        metre = float(np.hypot(*(to_pixels((1.0, 0.0)) - to_pixels((0.0, 0.0)))))
        half_sizes = {}
        for text, label in zip(self.texts, self.sketch.labels, strict=True):
            text.set_figure(figure)
            text.set_position((0.0, 0.0))
            extent = text.get_window_extent(renderer)
            half_sizes[label.part] = 0.5 * np.array([extent.width, extent.height])
        self.label_offsets = place_names(
            self.sketch, half_sizes, self.previous_offsets, to_pixels, metre, point, picture_box
        )
        self.leader_lines, self.boxes = [], {}
        for text, label in zip(self.texts, self.sketch.labels, strict=True):
            text.set_visible(label.part in self.label_offsets)
            if label.part not in self.label_offsets:
                continue
            anchor, half_size, clear = to_pixels(label.position), half_sizes[label.part], label.clearance * metre
            middle = anchor + self.label_offsets[label.part]
            text.set_position((float(middle[0]), float(middle[1])))
            self.boxes[label.part] = tuple([*(middle - half_size), *(middle + half_size)])
            if is_leader_needed(anchor, middle, half_size, clear, point):
                self.leader_lines.append(self._create_leader_line(anchor, middle, half_size, clear))

    def _create_omission_note(self, count: int) -> Text:
        """Return a text for the upper right corner that names were left out."""
        axes: Any = self.axes
        note = f"{count} name{'' if count == 1 else 's'} omitted: not enough space"
        text = Text(1.0, 1.0, note, size=7.0, color="#888888", ha="right", va="bottom", transform=axes.transAxes)
        text.set_figure(axes.get_figure(root=True))
        return text

    def _create_leader_line(self, anchor: Array, text_centre: Array, half_size: Array, clearance: float) -> Line2D:
        """Return the leader line of a name as an artist in pixels, with the arguments of `compute_leader_line`."""
        axes: Any = self.axes
        ends = compute_leader_line(anchor, text_centre, half_size, clearance).reshape(2, 2)
        line = Line2D(*ends.T, color="#999999", lw=0.5, transform=None)
        line.set_figure(axes.get_figure(root=True))
        return line


def place_names(
    sketch: Sketch,
    half_sizes: Mapping[str, Array],
    previous_offsets: Mapping[str, tuple[float, float]],
    to_pixels: Any,
    metre_size: float,
    point_size: float,
    picture_box: Array,
) -> dict[str, tuple[float, float]]:
    """Return the offset of the middle of each name from its part, in pixels, by part.

    `half_sizes`: half of each name's width and height. `previous_offsets`: offsets of the previous picture, which a
    name keeps while it overlaps no other name and is within `picture_box`. `metre_size`, `point_size`: size of a metre
    and of a typographic point in pixels. A name without a free position is left out.
    """
    offsets, occupied_boxes, leader_lines = dict[str, tuple[float, float]](), np.zeros((0, 4)), np.zeros((0, 4))
    shape_segments: Array | None = None
    for label in sketch.labels:
        anchor, half_size, clearance = to_pixels(label.position), half_sizes[label.part], label.clearance * metre_size
        text_centre = anchor + previous_offsets.get(label.part, (0.0, 0.0))
        box = np.array([[*(text_centre - half_size), *(text_centre + half_size)]])
        if (
            label.part not in previous_offsets
            or find_overlaps(box, occupied_boxes).any()
            or not _are_boxes_within(box, picture_box)[0]
        ):
            shape_segments = (
                collect_outline_segments(sketch.shapes, to_pixels) if shape_segments is None else shape_segments
            )
            position = find_best_position(
                anchor,
                half_size,
                label.direction,
                clearance,
                point_size,
                shape_segments,
                occupied_boxes,
                picture_box,
                leader_lines,
            )
            if position is None:
                continue
            text_centre = position
            box = np.array([[*(text_centre - half_size), *(text_centre + half_size)]])
            if is_leader_needed(anchor, text_centre, half_size, clearance, point_size):
                leader_lines = np.vstack(
                    [leader_lines, compute_leader_line(anchor, text_centre, half_size, clearance)]
                )  # which later names avoid
        offsets[label.part] = float(text_centre[0] - anchor[0]), float(text_centre[1] - anchor[1])
        occupied_boxes = np.vstack([occupied_boxes, box])
    return offsets


def compute_leader_line(anchor: Array, text_centre: Array, half_size: Array, clearance: float) -> Array:
    """Return the leader line from the edge of a part to the box of its name, a segment (1, 4) in pixels.

    The part is a circle of radius `clearance` around `anchor`, the name a box of `half_size` around `text_centre`.
    """
    edge = np.clip(anchor, text_centre - half_size, text_centre + half_size)
    start = anchor + clearance * (edge - anchor) / max(float(np.hypot(*(edge - anchor))), clearance, 1e-300)
    return np.array([[*start, *edge]])


def is_leader_needed(anchor: Array, text_centre: Array, half_size: Array, clearance: float, point_size: float) -> bool:
    """Return whether a name needs a leader line: its box is more than MIN_LEADER_DISTANCE points from its part.

    The part is a circle of radius `clearance` around `anchor`. Arguments as for `compute_leader_line`, in pixels;
    `point_size` is the size of a typographic point.
    """
    edge = np.clip(anchor, text_centre - half_size, text_centre + half_size)
    return float(np.hypot(*(edge - anchor))) - clearance > MIN_LEADER_DISTANCE * point_size


def make_identifier(kind: str, part: str) -> str:
    """Return the identifier of a part in a picture: "joint A" is "joint-A", its name "name-joint-A"."""
    return "-".join([*([kind] if kind else []), *part.split()])


def collect_outline_segments(shapes: Sequence[Shape], to_pixels: Any) -> Array:
    """Return the outlines of all shapes as segments in pixels, (S, 4); circles as 16 segments."""
    polylines = [to_pixels(points) for points in _iterate_polylines(shapes)]
    return np.vstack([np.hstack([points[:-1], points[1:]]) for points in polylines]) if polylines else np.zeros((0, 4))


def _iterate_polylines(shapes: Sequence[Shape]) -> Iterator[Array]:
    """Yield the outline of each shape as points (N, 2) in m: a closed line or a disc ends at its first point."""
    for shape in shapes:
        if isinstance(shape, Disc):
            yield compute_arc(shape.centre, shape.radius, 0.0, 2.0 * np.pi, 17)
        else:
            yield np.vstack([shape.points, shape.points[:1]]) if shape.closed else shape.points


def find_best_position(
    anchor: Array,
    half_size: Array,
    direction: float,
    clearance: float,
    point_size: float,
    shape_segments: Array,
    occupied_boxes: Array,
    picture_box: Array,
    leader_lines: Array,
) -> Array | None:
    """Return the best position of the middle of a name in pixels; None if all overlap a name or leave the picture.

    Positions on rings around `anchor` are searched outwards, `direction` (degrees) first. The first one without
    crossings is returned, else the one with the smallest cost of crossings. `half_size` is half the name's size,
    `leader_lines` (L, 4) those of earlier names.
    """
    angles = np.radians([direction, *ANGLES_DEG])
    unit_vectors = np.column_stack([np.cos(angles), np.sin(angles)])
    fallback, fewest = anchor, np.inf
    for ring in RING_DISTANCES:
        radius = clearance + ring * point_size
        middles = anchor + unit_vectors * (radius + half_size)
        if ring == RING_DISTANCES[0] and clearance * point_size > 0.0:
            middles = np.vstack([anchor, middles])
        boxes = np.hstack([middles - half_size - NAME_GAP * point_size, middles + half_size + NAME_GAP * point_size])
        is_free = ~find_overlaps(boxes, occupied_boxes).any(axis=1) & _are_boxes_within(boxes, picture_box)
        crossings = np.array(
            [
                count_crossings(box, shape_segments) + LEADER_CROSSING_COST * count_crossings(box, leader_lines)
                if is_allowed
                else np.inf
                for box, is_allowed in zip(boxes, is_free, strict=True)
            ]
        )
        for j in np.flatnonzero(is_free):
            if len(occupied_boxes) and is_leader_needed(anchor, middles[j], half_size, clearance, point_size):
                leader = compute_leader_line(anchor, middles[j], half_size, clearance)
                n_crossed = sum(
                    count_crossings(box, leader)
                    for box in occupied_boxes + MIN_LEADER_GAP * point_size * np.array([-1, -1, 1, 1])
                )
                crossings[j] += LEADER_CROSSING_COST * (
                    n_crossed + sum(_have_intersection(leader[0], other_line) for other_line in leader_lines)
                )
        costs = crossings + 0.02 * ring
        k = int(np.argmin(costs))
        if crossings[k] == 0.0:
            return middles[k]
        if costs[k] < fewest:
            fallback, fewest = middles[k], costs[k]
    return fallback if np.isfinite(fewest) else None


def find_overlaps(boxes: Array, other_boxes: Array) -> NDArray[np.bool_]:
    """Return a matrix (B, T) that is true where a box of `boxes` (B, 4) overlaps one of `other_boxes` (T, 4).

    A box is (left, low, right, high); boxes that only touch do not overlap.
    """
    a, b = boxes[:, None], other_boxes[None]
    overlaps_in_x = (a[..., 0] < b[..., 2]) & (b[..., 0] < a[..., 2])
    return np.asarray(overlaps_in_x & (a[..., 1] < b[..., 3]) & (b[..., 1] < a[..., 3]), dtype=bool)


def _are_boxes_within(boxes: Array, picture_box: Array) -> NDArray[np.bool_]:
    """Return which boxes (B, 4) are entirely within `picture_box` (4,), as (B,)."""
    return np.asarray(
        (boxes[:, :2] >= picture_box[:2]).all(axis=1) & (boxes[:, 2:] <= picture_box[2:]).all(axis=1), dtype=bool
    )


def _have_intersection(first_segment: Array, second_segment: Array) -> bool:
    """Return whether two segments (4,) cross in their interiors.

    A segment is (x, y) of its start, then of its end. Common ends and parallel segments do not count.
    """

    def compute_signed_area(line: Array, point: Array) -> float:
        """Return the signed area of the parallelogram of a segment and the vector from its start to a point."""
        direction, offset = line[2:] - line[:2], point - line[:2]
        return float(direction[0] * offset[1] - direction[1] * offset[0])

    return all(
        compute_signed_area(a, b[:2]) * compute_signed_area(a, b[2:]) < 0.0
        for a, b in ((first_segment, second_segment), (second_segment, first_segment))
    )


def count_crossings(box: Array, segments: Array) -> float:
    """Return the number of segments (S, 4) that meet a box (4,), by the method of Liang and Barsky.

    Rows are x and y of both ends; the box is its lower and upper corner. Segments inside the box count.
    """
    start, span = segments[:, :2], segments[:, 2:] - segments[:, :2]
    with np.errstate(all="ignore"):
        t_low, t_high = (box[:2] - start) / span, (box[2:] - start) / span
    t_enter, t_leave = np.minimum(t_low, t_high), np.maximum(t_low, t_high)
    is_parallel = span == 0.0
    is_inside = (start >= box[:2]) & (start <= box[2:])
    t_enter = np.where(is_parallel, np.where(is_inside, -np.inf, np.inf), t_enter)
    t_leave = np.where(is_parallel, np.where(is_inside, np.inf, -np.inf), t_leave)
    entry, exits = np.maximum(t_enter.max(axis=1), 0.0), np.minimum(t_leave.min(axis=1), 1.0)
    return float((entry <= exits).sum())

"""Define `Rig`, a drawing for animation (rigging): each point of a shape is attached to a moving frame of a body.

The position of a point follows from a reference point, an angle and a length:

    x = r_P(p, q) + A(φ) (c₀ + s c₁)

r_P: a point of the mechanism, or the origin; φ: 0, a body's angle, or the direction from P to Q, of a part's axis, of
gravity or of a load; s: the distance of P and Q, or a parameter (a gear's radius). The frame and c₀, c₁ of each point
are fitted to drawings at several configurations. Symbols are drawn by Python only; a page moves them (drawing.js).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from typing import Any

import numpy as np

from gudgeon.drawing.configuration import GROUND, Configuration, get_body_name, list_direction_keys
from gudgeon.drawing.layout import Layout, make_layout
from gudgeon.drawing.roles import ROLES
from gudgeon.drawing.shapes import Disc, Shape, Sketch
from gudgeon.drawing.sketch import compute_common_box, make_sketch
from gudgeon.model.compiled import Array

FRAME_TOL = 1e-9  # tolerance of a moved point as a fraction of the drawing's size
TRIAL_CHANGES = ((0.25, 0.03, 14), (0.02, 0.003, 8))  # (change of q, relative change of p, number) of configurations
RANDOM_SEED = 20261123
MIN_CONFIGURATIONS = 5  # drawings of a shape with the same number of points that a fit needs


@dataclass(frozen=True)
class MovingFrame:
    """A moving frame: origin at the point P ("": the origin of the ground), angle φ and length s.

    φ: () for 0, ("body", k) for q[k], ("pair", Q) for the direction from P to Q, ("axis", k, k, j) for parameters and
    q[j] (−1: none), ("load", name). s: −1: none, −2: the distance of P and Q, else an index in p. In drawing.js
    it is a carrier.
    """

    point: str = ""
    turn: tuple[Any, ...] = ()
    length_index: int = -1

    def compute_frame(self, configuration: Configuration) -> tuple[Array, Array, float]:
        """Return origin r_P (2,) in m, rotation matrix A(φ) (2, 2) and length s of the moving frame at a configuration.

        s is the distance of P and Q or a parameter (m), 0 without one. A is the identity if the direction of φ is a
        zero vector.
        """
        origin, q, p = (
            configuration.get_position(self.point) if self.point else np.zeros(2),
            configuration.q,
            configuration.p,
        )
        x, y = 1.0, 0.0
        kind, *arguments = self.turn or ("",)
        if kind == "body":
            x, y = np.cos(q[arguments[0]]), np.sin(q[arguments[0]])
        elif kind == "axis":
            x, y = (float(p[k]) if k >= 0 else 0.0 for k in arguments[:2])
            if arguments[2] >= 0:
                c, s = np.cos(q[arguments[2]]), np.sin(q[arguments[2]])
                x, y = c * x - s * y, s * x + c * y
        elif kind == "pair":
            x, y = configuration.get_position(arguments[0]) - origin
        elif kind == "load":
            x, y = configuration.loads.get(arguments[0], (0.0, 0.0))
        length = float(np.hypot(x, y))
        c, s = (x / length, y / length) if length > 0.0 else (1.0, 0.0)
        return (
            origin,
            np.array([[c, -s], [s, c]]),
            0.0 if self.length_index == -1 else length if self.length_index == -2 else float(p[self.length_index]),
        )


@dataclass(frozen=True, eq=False)
class MovingShape:
    """A shape with the moving frame of each point and its c₀, c₁, (N, 4); for a disc also its radius r₀ + r₁ p[k]."""

    shape: Shape
    moving_frames: tuple[MovingFrame, ...]
    offsets: Array
    radius: tuple[float, float, int] = (0.0, 0.0, -1)
    max_error: float = 0.0  # m, largest error of a point at the tried configurations

    def move_to(self, configuration: Configuration) -> Shape:
        """Return the shape moved to a configuration: points of a line, or centre and radius of a disc.

        x = r_P + A (c₀ + s c₁) with the moving frame of each point; the radius is r₀ + r₁ p[k].
        """
        positions = np.empty((len(self.moving_frames), 2))
        for moving_frame in dict.fromkeys(self.moving_frames):
            origin, rotation, s = moving_frame.compute_frame(configuration)
            point_indices = [k for k, other in enumerate(self.moving_frames) if other == moving_frame]
            positions[point_indices] = (
                origin + (self.offsets[point_indices, :2] + s * self.offsets[point_indices, 2:]) @ rotation.T
            )
        if isinstance(self.shape, Disc):
            r0, r1, k = self.radius
            return replace(
                self.shape, centre=positions[0], radius=r0 + (r1 * float(configuration.p[k]) if k >= 0 else 0.0)
            )
        return replace(self.shape, points=positions)


@dataclass(frozen=True, eq=False)
class Rig:
    """All shapes in the order of painting, names, and the box and unit of the drawing (m)."""

    shapes: tuple[MovingShape, ...]
    sketch: Sketch  # of the first configuration: its labels, its box

    labels: tuple[MovingFrame, ...]
    label_offsets: Array  # of labels, (L, 4)

    @property
    def size(self) -> float:
        """Return the larger side of the box, m."""
        return float((self.sketch.high - self.sketch.low).max())

    def to_json_data(self, resolution: float = 1e-2 * FRAME_TOL) -> dict[str, Any]:
        """Return the data for drawing.js as a dictionary that JSON can hold.

        Lengths are integers in units of `resolution` times the size of the drawing. Successive points of a shape with
        one moving frame are joined to one list.
        """
        step = resolution * self.size
        frame_indices = {
            moving_frame: k
            for k, moving_frame in enumerate(
                dict.fromkeys(
                    [*(moving_frame for shape in self.shapes for moving_frame in shape.moving_frames), *self.labels]
                )
            )
        }
        return {
            "step": step,
            "low": self.sketch.low.tolist(),
            "high": self.sketch.high.tolist(),
            "unit": self.sketch.unit,
            "carriers": [
                [moving_frame.point, list(moving_frame.turn), moving_frame.length_index]
                for moving_frame in frame_indices
            ],
            "shapes": [_encode_shape(shape, frame_indices, step) for shape in self.shapes],
            "labels": [
                [frame_indices[moving_frame], *_round_to_integers(offset, step)]
                for moving_frame, offset in zip(self.labels, self.label_offsets, strict=True)
            ],
        }


def _encode_shape(moving_shape: MovingShape, frame_indices: dict[MovingFrame, int], step: float) -> list[Any]:
    """Return a shape for JSON: [part, role, colour index, closed or radius, frame index, [integers], frame index, …].

    `frame_indices` are the indices of the moving frames in the JSON. A line has 0 or 1 for closed, a disc [r₀, r₁, k].
    Integers are offsets in units of `step` (m).
    """
    shape, encoded_points, previous_frame = moving_shape.shape, list[Any](), None
    for moving_frame, offset in zip(moving_shape.moving_frames, moving_shape.offsets, strict=True):
        if moving_frame != previous_frame:
            encoded_points += [frame_indices[moving_frame], []]
        encoded_points[-1] += _round_to_integers(offset if moving_frame.length_index != -1 else offset[:2], step)
        previous_frame = moving_frame
    r0, r1, k = moving_shape.radius
    closed: Any = [round(r0 / step), r1, k] if isinstance(shape, Disc) else int(shape.closed)
    return [shape.part, shape.role, shape.colour_index, closed, *encoded_points]


def _round_to_integers(lengths: Array, step: float) -> list[int]:
    """Return lengths as integers in units of `step`, rounded."""
    return [round(float(x) / step) for x in lengths]


def make_rig(configurations: Sequence[Configuration], layout: Layout | None = None) -> Rig:
    """Return the rig for the configurations of a motion: the drawing of the first, with a moving frame for each point.

    Insets are left out, and drives' arrows keep their direction of the first configuration. A point that no moving
    frame reproduces to FRAME_TOL gets the nearest moving frame; the error is stored as `max_error`.
    """
    layout = layout or make_layout(configurations)
    configurations = [replace(configuration, v=configurations[0].v) for configuration in configurations]
    box = compute_common_box(configurations, [layout])
    sketches = [make_sketch(configurations[0], layout, box=box, shows_insets=False, shows_zero_loads=False)]
    motion_configurations = list(configurations[:: max(1, len(configurations) // 6)][:8])
    trial_configurations = [
        *motion_configurations,
        *_vary_configurations(motion_configurations, float((box[1] - box[0]).max())),
    ]
    sketches += [
        make_sketch(configuration, layout, box=box, shows_insets=False, shows_zero_loads=False)
        for configuration in trial_configurations[1:]
    ]
    shapes_by_key = [{key: shape for key, shape in _number_shapes(sketch)} for sketch in sketches]
    size, moving_shapes_by_key = float((box[1] - box[0]).max()), dict[tuple[str, int], MovingShape]()
    parts = dict.fromkeys(shape.part for shape in sketches[0].shapes)
    for part in parts:
        part_shapes = [(key, shape) for key, shape in _number_shapes(sketches[0]) if shape.part == part]
        search = _FrameSearch(
            trial_configurations,
            list(_iterate_candidate_frames(trial_configurations[0], part)),
            FRAME_TOL * size,
            len(motion_configurations),
        )
        for key, shape in part_shapes:
            moving_shapes_by_key[key] = search.attach_shape(
                shape, [shapes_of_configuration.get(key) for shapes_of_configuration in shapes_by_key]
            )
    shapes = sorted(
        (moving_shapes_by_key[key] for key, _ in _number_shapes(sketches[0])),
        key=lambda moving_shape: ROLES[moving_shape.shape.role].order,
    )
    label_frames = [
        _find_label_frame(trial_configurations, sketches, k, FRAME_TOL * size, len(motion_configurations))
        for k in range(len(sketches[0].labels))
    ]
    labels, offsets = (
        tuple(moving_frame for moving_frame, _ in label_frames),
        np.array([offset for _, offset in label_frames]),
    )
    return Rig(tuple(shapes), sketches[0], labels, offsets.reshape(-1, 4))


def _find_label_frame(
    configurations: Sequence[Configuration], sketches: Sequence[Sketch], k: int, tolerance: float, n_motion: int
) -> tuple[MovingFrame, Array]:
    """Return the moving frame of the k-th label of the drawings, one of its part, and its offsets c₀, c₁ as (4,).

    `sketches` are the drawings of `configurations`, of which the first `n_motion` belong to the motion. `tolerance` is
    in m.
    """
    label = sketches[0].labels[k]
    search = _FrameSearch(
        configurations, list(_iterate_candidate_frames(configurations[0], label.part)), tolerance, n_motion
    )
    label_positions = [Disc(label.part, "mark", sketch.labels[k].position, 1.0) for sketch in sketches]
    moving_shape = search.attach_shape(label_positions[0], list(label_positions))
    return moving_shape.moving_frames[0], moving_shape.offsets[0]


def _number_shapes(sketch: Sketch) -> Iterator[tuple[tuple[str, int], Shape]]:
    """Yield (key, shape) for each shape of a sketch; the key is (part, number of the shape within the part), from 0."""
    counts = dict[str, int]()
    for shape in sketch.shapes:
        counts[shape.part] = counts.get(shape.part, -1) + 1
        yield (shape.part, counts[shape.part]), shape


def _vary_configurations(configurations: Sequence[Configuration], size: float) -> Iterator[Configuration]:
    """Yield randomly changed configurations, by which moving frames that agree in the motion are distinguished.

    Coordinates, parameters in m and loads change by TRIAL_CHANGES with a fixed seed; constraints are violated. `size`
    is that of the drawing in m.
    """
    source, random_generator = configurations[0].source, np.random.default_rng(RANDOM_SEED)
    length_parameters = {i for point in source.points for i in (point.x, point.y) if i >= 0}
    length_parameters |= {
        i
        for i, parameter in enumerate(source.parameters)
        if parameter.unit == "m" or parameter.address.endswith((".x", ".y"))
    }
    is_angle = np.zeros(len(source.coordinates), dtype=bool)
    is_angle[[body.index + 2 for body in source.bodies]] = True
    for position_change, length_change, count in TRIAL_CHANGES:
        for i in range(count):
            configuration, length_indices = (
                configurations[i % len(configurations)],
                np.array(sorted(length_parameters), dtype=int),
            )
            q, p = configuration.q.copy(), configuration.p.copy()
            q += position_change * random_generator.uniform(-1.0, 1.0, len(q)) * np.where(is_angle, 2.0, size)
            p[length_indices] *= 1.0 + length_change * random_generator.uniform(-1.0, 1.0, len(length_indices))
            loads = {
                name: (
                    x + position_change * random_generator.normal() * abs(x + y),
                    y + position_change * random_generator.normal() * abs(x + y),
                )
                for name, (x, y) in configuration.loads.items()
            }
            yield Configuration(source, p, q, configuration.t, configuration.v, loads)


def _iterate_candidate_frames(configuration: Configuration, part: str) -> Iterator[MovingFrame]:
    """Yield the possible moving frames of a part's shapes, the simplest first.

    `part` is a kind and a name, such as "body L1". The order is: fixed points, points with a rotation, pairs of points
    with their distance, then moving frames with a length of the file.
    """
    source, kind = configuration.source, part.partition(" ")[0]
    name = part.partition(" ")[2]
    parts = [
        item
        for item in source.parts
        if (name in map(get_body_name, item.ends) if kind == "body" else item.name == name)
    ]
    parts = parts if kind in ("body", "joint", "drive", "force", "point") else []
    ends = list(
        dict.fromkeys(end for item in parts for end in item.ends if kind != "body" or get_body_name(end) == name)
    )
    bodies = list(dict.fromkeys([get_body_name(end) for end in ends] + ([name] if kind == "body" else [])))
    if kind == "point":
        bodies, ends = [get_body_name(name)], [name]
    outline_points = [end for body in bodies for end in configuration.outline_points.get(body, ()) if body != GROUND]
    points = [
        name
        for name in dict.fromkeys([*ends, *outline_points, *(f"{body}.com" for body in bodies)])
        if name in configuration.points
    ]
    turns: list[tuple[Any, ...]] = [()]
    turns += [("body", configuration.bodies[body].index + 2) for body in bodies if body in configuration.bodies]
    turns += _list_axis_directions(configuration, parts) + [
        ("load", item.name) for item in parts if item.kind == "force"
    ]
    parameter_indices = {parameter.address: k for k, parameter in enumerate(source.parameters)}
    turns += (
        [("axis", parameter_indices.get("gravity.x", -1), parameter_indices.get("gravity.y", -1), -1)]
        if kind == "gravity"
        else []
    )
    yield from (MovingFrame("", turn) for turn in turns)
    yield from (MovingFrame(point, turn) for turn in turns for point in points)
    yield from (MovingFrame(item, ("pair", second), -2) for item, second in permutations(points, 2))
    length_indices = [
        k
        for address, k in parameter_indices.items()
        for item in parts
        if address.startswith(f"{item.section}.{item.name}.") and source.parameters[k].unit == "m"
    ]
    length_indices += [
        item.clearance
        for item in source.clearances
        if item.is_corner and item.joint in (item_part.name for item_part in parts)
    ]
    for k in dict.fromkeys(length_indices):
        yield from (MovingFrame(point, turn, k) for turn in turns for point in points)
        yield from (MovingFrame(item, ("pair", second), k) for item, second in permutations(points, 2))


def _list_axis_directions(configuration: Configuration, parts: Sequence[Any]) -> list[tuple[Any, ...]]:
    """Return the angles φ of moving frames along parts' axes: ("axis", index of x, index of y, index in q).

    A part is a joint or a force element (PartInfo). The first two indices are those of the
    direction's components in p, −1 for a component that is no parameter. The last is that of the body's angle, −1 for
    the ground. There is one φ in the frame of each of a part's bodies; equal ones are listed once. Directions without a
    parameter are left out.
    """
    parameter_indices, axis_directions = (
        {parameter.address: k for k, parameter in enumerate(configuration.source.parameters)},
        list[tuple[Any, ...]](),
    )
    for part in parts:
        for key in list_direction_keys(part):
            component_indices = [parameter_indices.get(f"{part.section}.{part.name}.{key}.{axis}", -1) for axis in "xy"]
            if max(component_indices) >= 0:
                indices = [
                    configuration.bodies[body].index + 2 if body in configuration.bodies else -1
                    for body in map(get_body_name, part.ends)
                ]
                axis_directions += [("axis", *component_indices, index) for index in dict.fromkeys(indices)]
    return axis_directions


class _FrameSearch:
    """Least-squares search for the moving frame of each point of a part's shapes, among candidate frames.

    The first `n_motion` configurations belong to the motion and have the file's parameters; the others are changed at
    random.
    """

    def __init__(
        self,
        configurations: Sequence[Configuration],
        moving_frames: Sequence[MovingFrame],
        tolerance: float,
        n_motion: int,
    ) -> None:
        """Evaluate the frames at all configurations; the first `n_motion` belong to the motion, `tolerance` is in m."""
        self.configurations, self.moving_frames, self.tolerance, self.n_motion = (
            configurations,
            moving_frames,
            tolerance,
            n_motion,
        )
        self.evaluated_frames = [
            [moving_frame.compute_frame(configuration) for configuration in configurations]
            for moving_frame in moving_frames
        ]

    def attach_shape(self, shape: Shape, shapes_by_configuration: Sequence[Shape | None]) -> MovingShape:
        """Return the shape with a moving frame for each point: the first that reproduces it within the tolerance.

        Without one it is the frame of the smallest penalized error (see `_fit_frame`). `shapes_by_configuration` are
        its drawings at all configurations, None where it is absent. If fewer than MIN_CONFIGURATIONS have the same
        number of points, only the first is used.
        """
        points = _get_shape_points(shape)
        indices = [
            k
            for k, candidate in enumerate(shapes_by_configuration)
            if candidate is not None
            and type(candidate) is type(shape)
            and len(_get_shape_points(candidate)) == len(points)
        ]
        indices = indices if len(indices) >= MIN_CONFIGURATIONS else list(range(1))
        positions = np.array([_get_shape_points(shapes_by_configuration[k]) for k in indices])  # type: ignore[arg-type]
        best_frame_indices, best_errors = np.zeros(len(points), dtype=int), np.full(len(points), np.inf)
        offsets, best_penalized_errors = np.zeros((len(points), 4)), np.full(len(points), np.inf)
        for index in range(len(self.moving_frames)):
            if not (best_penalized_errors > self.tolerance).any():
                break
            fitted, penalized_errors, errors = self._fit_frame(index, positions, indices)
            is_better = (best_penalized_errors > self.tolerance) & (
                penalized_errors < (1.0 - 1e-6) * best_penalized_errors
            )
            best_frame_indices[is_better], best_penalized_errors[is_better], best_errors[is_better] = (
                index,
                penalized_errors[is_better],
                errors[is_better],
            )
            offsets[is_better] = fitted[is_better]
        moving_frames = tuple(self.moving_frames[index] for index in best_frame_indices)
        return MovingShape(
            shape,
            moving_frames,
            offsets,
            self._fit_radius(shape, shapes_by_configuration),
            float(best_errors.max(initial=0.0)),
        )

    def _fit_frame(
        self, frame_index: int, positions: Array, configuration_indices: Sequence[int]
    ) -> tuple[Array, Array, Array]:
        """Fit points in the axes of one moving frame: c₀ + s c₁, with s the length coordinate of the frame.

        c₁ is the slope of a linear regression over the configurations; 0 if the frame has no length or s is constant.
        c₀ follows from the first configuration. Returns c₀ and c₁ (N, 4), penalized errors (N,) and largest errors
        (N,) in m. A penalized error is the largest error plus 1000 times that at configurations of the motion, if the
        latter exceeds the tolerance. `positions` (K, N, 2) of the points belong to `configuration_indices`.
        """
        frames = [self.evaluated_frames[frame_index][k] for k in configuration_indices]
        local_points = np.array(
            [
                (points_at_configuration - origin) @ rotation
                for points_at_configuration, (origin, rotation, _) in zip(positions, frames, strict=True)
            ]
        )
        s = np.array([s for *_, s in frames])
        slope = np.zeros_like(local_points[0])
        if self.moving_frames[frame_index].length_index != -1 and np.ptp(s) > 0.0:
            slope = np.tensordot(s - s.mean(), local_points - local_points.mean(axis=0), 1) / float(
                ((s - s.mean()) ** 2).sum()
            )
        offset = local_points[0] - s[0] * slope
        errors = np.linalg.norm(local_points - offset - s[:, None, None] * slope, axis=2)
        is_of_motion = np.array(configuration_indices) < self.n_motion
        max_errors, motion_errors = errors.max(axis=0), errors[is_of_motion].max(axis=0)
        # if no frame fits at other parameters, prefer one that fits at the file's parameters
        return (
            np.hstack([offset, slope]),
            np.where(motion_errors > self.tolerance, 1e3 * motion_errors, 0.0) + max_errors,
            max_errors,
        )

    def _fit_radius(self, shape: Shape, shapes_by_configuration: Sequence[Shape | None]) -> tuple[float, float, int]:
        """Return r₀, r₁ and parameter index k of a disc's radius r₀ + r₁ p[k]; index −1 for a constant radius.

        The constant radius is also returned if the radius is not linear in any single parameter. For a line the result
        is (0, 0, −1). `shapes_by_configuration`: the shape in each configuration; None counts with the radius of
        `shape`.
        """
        if not isinstance(shape, Disc):
            return 0.0, 0.0, -1
        radii = np.array(
            [
                drawn_shape.radius if isinstance(drawn_shape, Disc) else shape.radius
                for drawn_shape in shapes_by_configuration
            ]
        )
        if np.ptp(radii) <= self.tolerance:
            return shape.radius, 0.0, -1
        p = np.array([configuration.p for configuration in self.configurations])
        for k in np.flatnonzero(np.ptp(p[:, : len(self.configurations[0].source.parameters)], axis=0) > 0.0):
            slope = (radii[-1] - radii[0]) / (p[-1, k] - p[0, k]) if p[-1, k] != p[0, k] else 0.0
            if np.abs(radii - radii[0] - slope * (p[:, k] - p[0, k])).max() <= self.tolerance:
                return float(radii[0] - slope * p[0, k]), float(slope), int(k)
        return shape.radius, 0.0, -1


def _get_shape_points(shape: Shape) -> Array:
    """Return the points of a line, or the centre of a disc, (N, 2)."""
    return shape.centre[None] if isinstance(shape, Disc) else shape.points

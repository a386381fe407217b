"""Own `Rig`, a drawing that moves without being drawn again: a carrier for each point, found from drawings of postures.

A point moves with another point, with an angle about that, and with a length:

    x = r_P(p, q) + A(φ) (c₀ + s c₁)

r_P: a point of the mechanism, or the origin; φ: 0, a body's angle, the direction from P to Q, that of a part's axis or
gravity, or of a load; s: the distance of P and Q, or a number of the file (a gear's radius). Bars, plates, pins, blocks
on their guides, springs, cylinders and pitch circles are that, whatever symbol they have; so symbols are drawn by
Python alone, and a page moves them (drawing.js).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from typing import Any

import numpy as np

from gudgeon.drawing.plan import Plan, make_plan
from gudgeon.drawing.posture import GROUND, Posture, body_of, directions
from gudgeon.drawing.roles import ROLES
from gudgeon.drawing.shapes import Disc, Shape, Sketch
from gudgeon.drawing.sketch import make_sketch, room_of_all
from gudgeon.model.compiled import Array

EXACT = 1e-9  # tolerance of a carried point as a fraction of the drawing's size
TRIED = ((0.25, 0.03, 14), (0.02, 0.003, 8))  # additional postures: changes of q and p, and their number
SEED = 20261123
FEW = 5  # postures that show the same shape, at least


@dataclass(frozen=True)
class Carrier:
    """A moving frame of points: P ("": the origin), an angle φ and a length s.

    φ: () for 0, ("body", k) for q[k], ("pair", Q) for the direction from P to Q, ("axis", k, k, j) for parameters and
    q[j] (−1: none), ("load", name). s: −1: none, −2: the distance of P and Q, else an index in p.
    """

    point: str = ""
    turn: tuple[Any, ...] = ()
    by: int = -1

    def frame(self, posture: Posture) -> tuple[Array, Array, float]:
        """Return r_P (2,), A (2, 2) and s at a posture."""
        at, q, p = posture.place(self.point) if self.point else np.zeros(2), posture.q, posture.p
        x, y = 1.0, 0.0
        kind, *which = self.turn or ("",)
        if kind == "body":
            x, y = np.cos(q[which[0]]), np.sin(q[which[0]])
        elif kind == "axis":
            x, y = (float(p[k]) if k >= 0 else 0.0 for k in which[:2])
            if which[2] >= 0:
                c, s = np.cos(q[which[2]]), np.sin(q[which[2]])
                x, y = c * x - s * y, s * x + c * y
        elif kind == "pair":
            x, y = posture.place(which[0]) - at
        elif kind == "load":
            x, y = posture.loads.get(which[0], (0.0, 0.0))
        size = float(np.hypot(x, y))
        c, s = (x / size, y / size) if size > 0.0 else (1.0, 0.0)
        return at, np.array([[c, -s], [s, c]]), 0.0 if self.by == -1 else size if self.by == -2 else float(p[self.by])


@dataclass(frozen=True, eq=False)
class Carried:
    """A shape with the carrier of each point and its c₀, c₁, (N, 4); for a disc also its radius r₀ + r₁ p[k]."""

    shape: Shape
    carriers: tuple[Carrier, ...]
    offsets: Array
    radius: tuple[float, float, int] = (0.0, 0.0, -1)
    off: float = 0.0  # m: how far it is off at the worst posture that was tried

    def at(self, posture: Posture) -> Shape:
        """Return the shape at a posture."""
        places = np.empty((len(self.carriers), 2))
        for carrier in dict.fromkeys(self.carriers):
            at, turn, s = carrier.frame(posture)
            own = [k for k, one in enumerate(self.carriers) if one == carrier]
            places[own] = at + (self.offsets[own, :2] + s * self.offsets[own, 2:]) @ turn.T
        if isinstance(self.shape, Disc):
            r0, r1, k = self.radius
            return replace(self.shape, centre=places[0], radius=r0 + (r1 * float(posture.p[k]) if k >= 0 else 0.0))
        return replace(self.shape, points=places)


@dataclass(frozen=True, eq=False)
class Rig:
    """All shapes in the order of painting, names, and the box and unit of the drawing (m)."""

    shapes: tuple[Carried, ...]
    sketch: Sketch  # of the first posture: its labels, its box

    labels: tuple[Carrier, ...]
    places: Array  # of labels, (L, 4)

    @property
    def size(self) -> float:
        """Larger side of the box, m."""
        return float((self.sketch.high - self.sketch.low).max())

    def json(self, digits: float = 1e-2 * EXACT) -> dict[str, Any]:
        """Return the data for drawing.js; numbers are integers in units of `digits` of the size, and runs of one
        carrier are joined.
        """
        step = digits * self.size
        order = {
            carrier: k
            for k, carrier in enumerate(
                dict.fromkeys([*(one for shape in self.shapes for one in shape.carriers), *self.labels])
            )
        }
        return {
            "step": step,
            "low": self.sketch.low.tolist(),
            "high": self.sketch.high.tolist(),
            "unit": self.sketch.unit,
            "carriers": [[carrier.point, list(carrier.turn), carrier.by] for carrier in order],
            "shapes": [_encode_shape(one, order, step) for one in self.shapes],
            "labels": [
                [order[carrier], *_as_integers(place, step)]
                for carrier, place in zip(self.labels, self.places, strict=True)
            ],
        }


def _encode_shape(carried: Carried, order: dict[Carrier, int], step: float) -> list[Any]:
    """Return a shape as [part, role, tint, closed or radius, carrier, [numbers], carrier, [numbers], …]."""
    shape, runs, before = carried.shape, list[Any](), None
    for carrier, offset in zip(carried.carriers, carried.offsets, strict=True):
        if carrier != before:
            runs += [order[carrier], []]
        runs[-1] += _as_integers(offset if carrier.by != -1 else offset[:2], step)
        before = carrier
    r0, r1, k = carried.radius
    closed: Any = [round(r0 / step), r1, k] if isinstance(shape, Disc) else int(shape.closed)
    return [shape.part, shape.role, shape.tint, closed, *runs]


def _as_integers(numbers: Array, step: float) -> list[int]:
    """Return numbers as integers in units of `step`."""
    return [round(float(x) / step) for x in numbers]


def make_rig(postures: Sequence[Posture], plan: Plan | None = None) -> Rig:
    """Return the rig for the postures of a motion; the first is drawn, and insets are left out.

    It has every shape of the first posture, and drives' arrows in their direction there. A point that no carrier
    reproduces to EXACT has the nearest one, with the error `off`.
    """
    plan = plan or make_plan(postures)
    postures = [replace(posture, v=postures[0].v) for posture in postures]
    box = room_of_all(postures, [plan])
    drawn = [make_sketch(postures[0], plan, box=box, inset=False, still=False)]
    real = list(postures[:: max(1, len(postures) // 6)][:8])
    tried = [*real, *_vary_postures(real, float((box[1] - box[0]).max()))]
    drawn += [make_sketch(posture, plan, box=box, inset=False, still=False) for posture in tried[1:]]
    places = [{key: shape for key, shape in _numbered_shapes(sketch)} for sketch in drawn]
    size, found = float((box[1] - box[0]).max()), dict[tuple[str, int], Carried]()
    parts = dict.fromkeys(shape.part for shape in drawn[0].shapes)
    for part in parts:
        mine = [(key, shape) for key, shape in _numbered_shapes(drawn[0]) if shape.part == part]
        ways = _CarrierSearch(tried, list(_candidates(tried[0], part)), EXACT * size, len(real))
        for key, shape in mine:
            found[key] = ways.carry(shape, [at.get(key) for at in places])
    shapes = sorted((found[key] for key, _ in _numbered_shapes(drawn[0])), key=lambda one: ROLES[one.shape.role].order)
    names = [_carry_label(tried, drawn, k, EXACT * size, len(real)) for k in range(len(drawn[0].labels))]
    labels, offsets = tuple(carrier for carrier, _ in names), np.array([offset for _, offset in names])
    return Rig(tuple(shapes), drawn[0], labels, offsets.reshape(-1, 4))


def _carry_label(
    tried: Sequence[Posture], drawn: Sequence[Sketch], k: int, exact: float, real: int
) -> tuple[Carrier, Array]:
    """Return carrier and offsets of a name, which moves with its part."""
    label = drawn[0].labels[k]
    ways = _CarrierSearch(tried, list(_candidates(tried[0], label.part)), exact, real)
    spots = [Disc(label.part, "mark", sketch.labels[k].place, 1.0) for sketch in drawn]
    carried = ways.carry(spots[0], list(spots))
    return carried.carriers[0], carried.offsets[0]


def _numbered_shapes(sketch: Sketch) -> Iterator[tuple[tuple[str, int], Shape]]:
    """Yield the shapes with their part and number in the part."""
    counts = dict[str, int]()
    for shape in sketch.shapes:
        counts[shape.part] = counts.get(shape.part, -1) + 1
        yield (shape.part, counts[shape.part]), shape


def _vary_postures(real: Sequence[Posture], size: float) -> Iterator[Posture]:
    """Yield postures with separated bodies and other lengths, which show the carrier of each shape."""
    source, chance = real[0].source, np.random.default_rng(SEED)
    lengths = {k for point in source.points for k in (point.x, point.y) if k >= 0}
    lengths |= {k for k, slot in enumerate(source.slots) if slot.unit == "m" or slot.address.endswith((".x", ".y"))}
    angle = np.zeros(len(source.coordinates), dtype=bool)
    angle[[body.index + 2 for body in source.bodies]] = True
    for far, share, count in TRIED:
        for k in range(count):
            posture, moved = real[k % len(real)], np.array(sorted(lengths), dtype=int)
            q, p = posture.q.copy(), posture.p.copy()
            q += far * chance.uniform(-1.0, 1.0, len(q)) * np.where(angle, 2.0, size)
            p[moved] *= 1.0 + share * chance.uniform(-1.0, 1.0, len(moved))
            loads = {
                name: (x + far * chance.normal() * abs(x + y), y + far * chance.normal() * abs(x + y))
                for name, (x, y) in posture.loads.items()
            }
            yield Posture(source, p, q, posture.t, posture.v, loads)


def _candidates(posture: Posture, part: str) -> Iterator[Carrier]:
    """Yield the possible carriers of a part's shapes, the simplest first."""
    source, kind = posture.source, part.partition(" ")[0]
    name = part.partition(" ")[2]
    about = [one for one in source.parts if (name in map(body_of, one.ends) if kind == "body" else one.name == name)]
    about = about if kind in ("body", "joint", "drive", "force", "point") else []
    ends = list(dict.fromkeys(end for one in about for end in one.ends if kind != "body" or body_of(end) == name))
    bodies = list(dict.fromkeys([body_of(end) for end in ends] + ([name] if kind == "body" else [])))
    if kind == "point":
        bodies, ends = [body_of(name)], [name]
    held = [end for body in bodies for end in posture.held.get(body, ()) if body != GROUND]
    points = [
        name for name in dict.fromkeys([*ends, *held, *(f"{body}.com" for body in bodies)]) if name in posture.points
    ]
    turns: list[tuple[Any, ...]] = [()]
    turns += [("body", posture.bodies[body].index + 2) for body in bodies if body in posture.bodies]
    turns += _axis_directions(posture, about) + [("load", one.name) for one in about if one.kind == "force"]
    place = {slot.address: k for k, slot in enumerate(source.slots)}
    turns += [("axis", place.get("gravity.x", -1), place.get("gravity.y", -1), -1)] if kind == "gravity" else []
    yield from (Carrier("", turn) for turn in turns)
    yield from (Carrier(point, turn) for turn in turns for point in points)
    yield from (Carrier(one, ("pair", other), -2) for one, other in permutations(points, 2))
    numbers = [
        k
        for address, k in place.items()
        for one in about
        if address.startswith(f"{one.section}.{one.name}.") and source.slots[k].unit == "m"
    ]
    numbers += [one.clearance for one in source.clearances if one.at_wall and one.joint in (x.name for x in about)]
    for k in dict.fromkeys(numbers):
        yield from (Carrier(point, turn, k) for turn in turns for point in points)
        yield from (Carrier(one, ("pair", other), k) for one, other in permutations(points, 2))


def _axis_directions(posture: Posture, parts: Sequence[Any]) -> list[tuple[Any, ...]]:
    """Return the directions of the parts' axes in the frames of both of their bodies."""
    place, found = {slot.address: k for k, slot in enumerate(posture.source.slots)}, list[tuple[Any, ...]]()
    for part in parts:
        for key in directions(part):
            which = [place.get(f"{part.section}.{part.name}.{key}.{axis}", -1) for axis in "xy"]
            if max(which) >= 0:
                indices = [posture.bodies[b].index + 2 if b in posture.bodies else -1 for b in map(body_of, part.ends)]
                found += [("axis", *which, index) for index in dict.fromkeys(indices)]
    return found


class _CarrierSearch:
    """Possible carriers of a part with their frames at all postures; the first `real` postures have the file's
    parameters.
    """

    def __init__(self, postures: Sequence[Posture], carriers: Sequence[Carrier], exact: float, real: int) -> None:
        """Evaluate the frames of the carriers at all postures."""
        self.postures, self.carriers, self.exact, self.real = postures, carriers, exact, real
        self.frames = [[carrier.frame(posture) for posture in postures] for carrier in carriers]

    def carry(self, shape: Shape, seen: Sequence[Shape | None]) -> Carried:
        """Return the shape with the first carrier of each point that reproduces it, or the nearest one."""
        first = _points_of(shape)
        same = [
            k
            for k, other in enumerate(seen)
            if other is not None and type(other) is type(shape) and len(_points_of(other)) == len(first)
        ]
        same = same if len(same) >= FEW else list(range(1))
        x = np.array([_points_of(seen[k]) for k in same])  # type: ignore[arg-type]
        best, off = np.zeros(len(first), dtype=int), np.full(len(first), np.inf)
        offsets, rank = np.zeros((len(first), 4)), np.full(len(first), np.inf)
        for c in range(len(self.carriers)):
            if not (rank > self.exact).any():
                break
            found, missed, worst = self._fit_carrier(c, x, same)
            better = (rank > self.exact) & (missed < (1.0 - 1e-6) * rank)
            best[better], rank[better], off[better] = c, missed[better], worst[better]
            offsets[better] = found[better]
        carriers = tuple(self.carriers[c] for c in best)
        return Carried(shape, carriers, offsets, self._fit_radius(shape, seen), float(off.max(initial=0.0)))

    def _fit_carrier(self, c: int, x: Array, same: Sequence[int]) -> tuple[Array, Array, Array]:
        """Return c₀ and c₁ (N, 4) of all points for a carrier, its rank, and its error (N,), m."""
        frames = [self.frames[c][k] for k in same]
        y = np.array([(here - at) @ turn for here, (at, turn, _) in zip(x, frames, strict=True)])
        s = np.array([s for *_, s in frames])
        slope = np.zeros_like(y[0])
        if self.carriers[c].by != -1 and np.ptp(s) > 0.0:
            slope = np.tensordot(s - s.mean(), y - y.mean(axis=0), 1) / float(((s - s.mean()) ** 2).sum())
        offset = y[0] - s[0] * slope
        away = np.linalg.norm(y - offset - s[:, None, None] * slope, axis=2)
        worst, real = away.max(axis=0), away[[k for k, which in enumerate(same) if which < self.real]].max(axis=0)
        # where nothing explains it at other lengths, it is right at least at the file's
        return np.hstack([offset, slope]), np.where(real > self.exact, 1e3 * real, 0.0) + worst, worst

    def _fit_radius(self, shape: Shape, seen: Sequence[Shape | None]) -> tuple[float, float, int]:
        """Return r₀, r₁ and the index k of the parameter that a disc's radius depends on."""
        if not isinstance(shape, Disc):
            return 0.0, 0.0, -1
        radii = np.array([other.radius if isinstance(other, Disc) else shape.radius for other in seen])
        if np.ptp(radii) <= self.exact:
            return shape.radius, 0.0, -1
        p = np.array([posture.p for posture in self.postures])
        for k in np.flatnonzero(np.ptp(p[:, : len(self.postures[0].source.slots)], axis=0) > 0.0):
            one = (radii[-1] - radii[0]) / (p[-1, k] - p[0, k]) if p[-1, k] != p[0, k] else 0.0
            if np.abs(radii - radii[0] - one * (p[:, k] - p[0, k])).max() <= self.exact:
                return float(radii[0] - one * p[0, k]), float(one), int(k)
        return shape.radius, 0.0, -1


def _points_of(shape: Shape) -> Array:
    """Return the points of a line, or the centre of a disc, (N, 2)."""
    return shape.centre[None] if isinstance(shape, Disc) else shape.points

"""Bodies and points in tree coordinates: r = Σ_T value_T A(θ_T) w_T, a sum of turning arms and slides.

Each term T is a frame with, or without, a slide along a direction fixed in it; w_T is constant. So every
derivative of a position is again such a sum: ∂r/∂s_k = Σ_T (∂θ_T/∂s_k value_T ẑ + ∂value_T/∂s_k) A(θ_T) w_T.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from gudgeon.generator.equations.fields import JointFields
from gudgeon.generator.equations.geometry import BodySymbols, Geometry, PointFrame
from gudgeon.generator.equations.model import Model
from gudgeon.generator.mechanism import GROUND, PointRef
from gudgeon.generator.reduction.frames import CONSTANT, ONE, ZERO, Affine, Coordinate, Frame, Motions, Pair
from gudgeon.generator.reduction.tree import Link, Tree
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.storage import Place
from gudgeon.generator.symbols.symbols import Symbols

Term = tuple[str, str]  # frame, slide ("" without)
Terms = Mapping[Term, Pair]
GROUND_FRAME = Frame(GROUND, ZERO, ZERO, ONE, ZERO, {})


@dataclass(frozen=True)
class TreePoint(PointFrame):
    """A point with its terms, relative to the body that carries it; `place` is (x, y), `speed` (ẋ, ẏ)."""

    terms: Terms
    place: Pair
    speed: Pair

    @property
    def x(self) -> sp.Expr:
        """Return the x coordinate in the ground frame."""
        return self.place[0]

    @property
    def y(self) -> sp.Expr:
        """Return the y coordinate in the ground frame."""
        return self.place[1]

    @property
    def velocity(self) -> Pair:
        """Return the velocity (ẋ, ẏ)."""
        return self.speed

    @cached_property
    def columns(self) -> Mapping[str, Pair]:
        """Return ∂(x, y)/∂z by coordinate."""
        geometry: TreeGeometry = self.geometry  # type: ignore[assignment]
        return geometry.columns(self.terms)

    @property
    def turns(self) -> Mapping[str, sp.Expr]:
        """Return ∂θ/∂z of the point's body by coordinate."""
        geometry: TreeGeometry = self.geometry  # type: ignore[assignment]
        return geometry.frame_of[self.body.name].turns if self.body else {}

    def flat(self) -> TreePoint:
        """Return the same point as one sum of arms: in differences of two points, common arms cancel."""
        geometry: TreeGeometry = self.geometry  # type: ignore[assignment]
        rate = geometry.motions.coordinates
        speed = [sp.Add(*(c[i] * rate[k].v for k, c in self.columns.items())) for i in range(2)]
        return replace(self, place=geometry.position(self.terms), speed=(speed[0], speed[1]))


class TreeGeometry(Geometry):
    """Makes the symbols of bodies and points from a tree, for functions that also take a `Geometry`."""

    def __init__(self, model: Model, tree: Tree, symbols: Symbols, slots: ParameterTable) -> None:
        """Begin with the ground; `place` adds the bodies."""
        self.symbols, self.slots, self.mechanism = symbols, slots, model.scene.mechanism
        self.local, self.tree, self._model = model.geometry.local, tree, model
        self.bodies: dict[str, BodySymbols] = {}
        self.frames: dict[str, Frame] = {GROUND: GROUND_FRAME}
        self.frame_of: dict[str, Frame] = {GROUND: GROUND_FRAME}
        self.slides: dict[str, Affine] = {}
        self._offset: dict[str, sp.Expr] = {GROUND: ZERO}  # θ of a body less that of its frame
        self._base: dict[str, tuple[TreePoint, Pair]] = {}  # who carries a body, and at which of its own points
        self._points: dict[tuple[str, str], TreePoint] = {}
        self._coms: dict[str, TreePoint] = {}

    def place(self, motions: Motions, slides: Mapping[str, Affine]) -> None:
        """Make coordinates and frames, then position body by body along the tree.

        `slides`: slides that are functions of other coordinates.
        """
        self.motions = motions
        state = 0
        free = set(self.tree.free)
        for link in self.tree.links:
            for name in link.coordinates:
                self.slides[name] = motions.hoisted(name, slides.get(name, {name: ONE}))
                state += self._coordinate(name, state) if name not in slides else 0
            if link.body in free:
                state += self._coordinate(link.body, state)
        for link in self.tree.links:
            self._turn_with(link.body)
        for link in self.tree.links:
            self._carry(link)

    def _coordinate(self, name: str, state: int) -> int:
        """Add an unknown coordinate with index `state`; return how many were added: 1."""
        new, owner = self.symbols.new, name.replace(".", "_")
        names = (f"{owner}_theta", f"{owner}_omega") if name in self.tree.free else (owner, f"{owner}_rate")
        q, v = (new(n, Place(letter)[state], name) for n, letter in zip(names, "qv", strict=True))
        self.motions.coordinates[name] = Coordinate(name, q, v)
        return 1

    def _turn_with(self, body: str) -> None:
        """Set the frame of a body: that of a body with a constant angle to it, else a new one."""
        affine = self.motions.hoisted(f"{body}_theta", self.tree.angles[body])
        constant = affine.get(CONSTANT, ZERO)
        turns = {k: c for k, c in affine.items() if k != CONSTANT}
        frame = next((f for f in self.frames.values() if f.turns == turns), None)
        if frame is None:
            single = next((b for b in turns if len(turns) == 1 and turns[b] == 1 and b in self.tree.free), None)
            name, own = (single, {single: ONE}) if single else (body, affine)
            frame = self.frames[name] = self.motions.frame(name, own)
        else:
            name = frame.name
        zero = ZERO if not turns or name in self.tree.free else self.tree.angles[name].get(CONSTANT, ZERO)
        self._offset[body] = sp.expand(constant - zero)
        self.frame_of[body] = frame

    def in_frame(self, body: str, s: Pair, expected: str) -> Pair:
        """Return a vector of a body in its frame's axes; `expected`: base of the names of derived parameters."""
        offset = self._offset[body]
        if offset == 0 or s == (ZERO, ZERO):
            return s
        derive = self.slots.derive
        cos = derive(f"cos_{body}_offset", sp.cos(offset), f"angle of {body} in its frame")
        sin = derive(f"sin_{body}_offset", sp.sin(offset), f"angle of {body} in its frame")
        turned = (cos * s[0] - sin * s[1], sin * s[0] + cos * s[1])
        return self.motions.constant_vector(expected, turned, f"{expected}_in_frame")

    def _carry(self, link: Link) -> None:
        """Set where a body is, from its parent; then make its symbols."""
        body = link.body
        if link.joint is None:
            units = ((ONE, ZERO), (ZERO, ONE))
            terms = {(GROUND, name): unit for name, unit in zip(link.coordinates, units, strict=True)}
            base, own = self._free(terms), (ZERO, ZERO)
        else:
            first, second = link.joint.first, link.joint.second
            parent, child, sign = (first, second, 1) if second.body == body else (second, first, -1)
            base, own = self.point(parent), self.local[body, child.point]
            if link.slides:
                axis = JointFields(link.joint, self._model.geometry).direction("axis")
                w = self.in_frame(first.body, axis, f"{link.joint.name}_axis")
                base = self._slid(base, first.body, link.coordinates[0], (sign * w[0], sign * w[1]))
        self._base[body] = base, self.in_frame(body, own, f"{body}_base")
        self._body_symbols(body)

    def _free(self, terms: Terms) -> TreePoint:
        """Return the base point of a body that moves freely, at its two slides."""
        place = tuple(self.motions.value(self.slides[name]) for _, name in terms)
        speed = tuple(self.motions.rate(self.slides[name]) for _, name in terms)
        return TreePoint(self, None, (ZERO, ZERO), terms, (place[0], place[1]), (speed[0], speed[1]))

    def _slid(self, base: TreePoint, body: str, slide: str, w: Pair) -> TreePoint:
        """Return the base point moved along an axis w of a body."""
        frame, value, rate = self.frame_of[body], self.value(slide), self.rate(slide)
        u_x, u_y = self.motions.arm(frame, w, f"axis_{slide}")
        terms = self._sum(base.terms, {(frame.name, slide): w}, slide)
        place = base.x + value * u_x, base.y + value * u_y
        speed = (
            base.velocity[0] + rate * u_x - frame.omega * value * u_y,
            base.velocity[1] + rate * u_y + frame.omega * value * u_x,
        )
        return TreePoint(self, None, (ZERO, ZERO), terms, place, speed)

    def value(self, slide: str) -> sp.Expr:
        """Return the value of a slide; 1 for a term without one."""
        return self.motions.value(self.slides[slide]) if slide else ONE

    def rate(self, slide: str) -> sp.Expr:
        """Return the rate of a slide; 0 for a term without one."""
        return self.motions.rate(self.slides[slide]) if slide else ZERO

    def _sum(self, terms: Terms, more: Terms, expected: str) -> Terms:
        """Return the sum of terms; those with the same frame and slide are added."""
        out = dict(terms)
        for key, w in more.items():
            if key in out:
                w = self.motions.constant_vector(f"{expected}_and", (out[key][0] + w[0], out[key][1] + w[1]))
            out[key] = w
        return {key: w for key, w in out.items() if w != (ZERO, ZERO)}

    def position(self, terms: Terms) -> Pair:
        """Return the position Σ value A(θ) w of terms."""
        x, y = ZERO, ZERO
        for (frame, slide), w in terms.items():
            a_x, a_y = self.motions.arm(self.frames[frame], w, f"arm_{frame}")
            x, y = x + self.value(slide) * a_x, y + self.value(slide) * a_y
        return x, y

    def columns(self, terms: Terms) -> dict[str, Pair]:
        """Return ∂r/∂z of terms by coordinate."""
        out: dict[str, Pair] = {}
        for (name, slide), w in terms.items():
            frame, value = self.frames[name], self.value(slide)
            a_x, a_y = self.motions.arm(frame, w, f"arm_{name}")
            along = self.along(slide)
            for k in dict.fromkeys((*frame.turns, *along)):
                x, y = out.get(k, (ZERO, ZERO))
                turn, c = frame.turns.get(k, ZERO) * value, along.get(k, ZERO)
                out[k] = x - turn * a_y + c * a_x, y + turn * a_x + c * a_y
        return out

    def bias(self, terms: Terms) -> Pair:
        """Return r̈ of terms if no coordinate accelerates: Σ (−θ̇² value + 2 θ̇ rate ẑ) A w."""
        x, y = ZERO, ZERO
        for (name, slide), w in terms.items():
            frame = self.frames[name]
            a_x, a_y = self.motions.arm(frame, w, f"arm_{name}")
            toward, across = -(frame.omega**2) * self.value(slide), 2 * frame.omega * self.rate(slide)
            x, y = x + toward * a_x - across * a_y, y + toward * a_y + across * a_x
        return x, y

    def along(self, slide: str) -> dict[str, sp.Expr]:
        """Return ∂value/∂z of a slide by coordinate."""
        return {k: c for k, c in self.slides[slide].items() if k != CONSTANT} if slide else {}

    def _at(self, body: str, s: Pair, expected: str, names: tuple[str, str, str, str]) -> TreePoint:
        """Return the point s of a body (from its centre of mass).

        `names`: those of its symbols for (x, y, ẋ, ẏ).
        """
        base, own = self._base[body]
        frame, local = self.frame_of[body], self.in_frame(body, s, expected)
        w = self.motions.constant_vector(f"{expected}_span", (local[0] - own[0], local[1] - own[1]))
        a_x, a_y = self.motions.arm(frame, w, f"span_{expected}")
        terms = self._sum(base.terms, {(frame.name, ""): w} if w != (ZERO, ZERO) else {}, expected)
        columns, named = self.columns(terms), self.motions.named
        values = [base.x + a_x, base.y + a_y]
        rates = [base.velocity[0] - frame.omega * a_y, base.velocity[1] + frame.omega * a_x]
        for i in range(2):
            moving = {k: c[i] for k, c in columns.items() if c[i] != 0}
            if not self.is_short(values[i]):
                values[i] = named(names[i], values[i], moving)
            if not self.is_short(rates[i]):
                rates[i] = self.motions.named_rate(names[2 + i], rates[i], moving)
        arm = self.turn(self.bodies[body], s, f"arm_{expected}") if body in self.bodies else (ZERO, ZERO)
        place, speed = (values[0], values[1]), (rates[0], rates[1])
        return TreePoint(self, self.bodies.get(body), arm, terms, place, speed)

    def is_short(self, value: sp.Expr) -> bool:
        """Return whether a value is a symbol, its negative, or a number, which needs no local."""
        return bool(value.is_Symbol or (-value).is_Symbol or value.is_Number)

    def _body_symbols(self, body: str) -> None:
        """Make the symbols (x, y, θ) of a body and of its rates, as functions of the coordinates."""
        of, frame, motions = self._model.geometry.bodies[body], self.frame_of[body], self.motions
        at = self._at(body, (ZERO, ZERO), f"{body}_com", (f"{body}_x", f"{body}_y", f"{body}_vx", f"{body}_vy"))
        theta, omega = frame.theta + self._offset[body], frame.omega

        def symbol(expected: str, value: sp.Expr, columns: Mapping[str, sp.Expr], rate: bool = False) -> sp.Symbol:
            """Return a symbol as it is, or a new one for a longer value."""
            name = motions.named_rate if rate else motions.named
            return value if value.is_Symbol else name(expected, value, columns)

        x, y = (
            symbol(f"{body}_{c}", v, {k: w[i] for k, w in at.columns.items()})
            for i, (c, v) in enumerate(zip("xy", at.place, strict=True))
        )
        vx, vy = (
            symbol(f"{body}_v{c}", v, {k: w[i] for k, w in at.columns.items()}, True)
            for i, (c, v) in enumerate(zip("xy", at.speed, strict=True))
        )
        self.bodies[body] = BodySymbols(
            body,
            of.index,
            x,
            y,
            symbol(f"{body}_theta", theta, frame.turns),
            vx,
            vy,
            symbol(f"{body}_omega", omega, frame.turns, True),
            of.mass,
            of.inertia,
        )
        self._coms[body] = replace(at, body=self.bodies[body])

    def com(self, body: str) -> TreePoint:
        """Return the centre of mass of a body as a point."""
        return self._coms[body]

    def angle(self, body: BodySymbols) -> tuple[sp.Expr, sp.Expr]:
        """Return cos θ and sin θ of a body."""
        x, y = self.turn(body, (ONE, ZERO), f"axis_{body.name}")
        return x, y

    def turn(self, body: BodySymbols, s: Pair, expected: str, point: str = "") -> Pair:
        """Return A(θ) s of a vector of a body."""
        return self.motions.arm(self.frame_of[body.name], self.in_frame(body.name, s, expected), expected)

    def beside(self, ref: PointRef, offset: Pair, expected: str) -> TreePoint:
        """Return the frame of a point at an offset from a named point, given in its body's frame."""
        s = self._offset_vector(ref, offset, expected)
        if ref.body == GROUND:
            return TreePoint(self, None, s, {(GROUND, ""): s}, s, (ZERO, ZERO))
        names = (f"{expected}_x", f"{expected}_y", f"{expected}_vx", f"{expected}_vy")
        return self._at(ref.body, s, expected, names)

    def point(self, ref: PointRef) -> TreePoint:
        """Return the frame of a named point, made once."""
        key = ref.body, ref.point
        if key not in self._points:
            if ref.body == GROUND:
                at = self.ground_vector(self.mechanism.ground[ref.point]) if ref.point else (ZERO, ZERO)
                terms = {(GROUND, ""): at} if at != (ZERO, ZERO) else {}
                self._points[key] = TreePoint(self, None, at, terms, at, (ZERO, ZERO))
            else:
                name = f"{ref.body}_{ref.point}"
                names = (f"{name}_x", f"{name}_y", f"{name}_vx", f"{name}_vy")
                self._points[key] = self._at(ref.body, self.local[ref.body, ref.point], name, names)
        return self._points[key]

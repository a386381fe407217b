"""Positions of bodies and points in tree coordinates (forward kinematics): sums of rotated vectors and displacements.

A slide is a translational coordinate: the displacement s along a direction fixed in a frame, of a translational joint
or of a free body. Each term T is a frame with, or without, a slide; w_T is constant. So every derivative of a position
is again such a sum: ∂r/∂s_k = Σ_T (∂θ_T/∂s_k value_T ẑ + ∂value_T/∂s_k) A(θ_T) w_T.
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
from gudgeon.generator.reduction.tree import Tree, TreeEdge
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.storage import StorageLocation
from gudgeon.generator.symbols.symbol_sums import is_signed_symbol
from gudgeon.generator.symbols.symbols import Symbols

Term = tuple[str, str]  # frame, slide ("" without)
Terms = Mapping[Term, Pair]
GROUND_FRAME = Frame(GROUND, ZERO, ZERO, ONE, ZERO, {})


@dataclass(frozen=True)
class TreePoint(PointFrame):
    """A point with its terms, relative to the body that carries it; `position_xy` is (x, y), `speed` is (ẋ, ẏ).

    `terms`: vectors w by (frame, slide), whose sum Σ value A(θ) w is the position.
    """

    terms: Terms
    position_xy: Pair
    speed: Pair

    @property
    def x(self) -> sp.Expr:
        """Return the x coordinate in the ground frame."""
        return self.position_xy[0]

    @property
    def y(self) -> sp.Expr:
        """Return the y coordinate in the ground frame."""
        return self.position_xy[1]

    @property
    def velocity(self) -> Pair:
        """Return the velocity (ẋ, ẏ)."""
        return self.speed

    @cached_property
    def columns(self) -> Mapping[str, Pair]:
        """Return ∂(x, y)/∂z of the point by coordinate z, prescribed ones included, computed once."""
        geometry: TreeGeometry = self.geometry  # type: ignore[assignment]
        return geometry.compute_jacobian_columns(self.terms)

    @property
    def angle_coefficients(self) -> Mapping[str, sp.Expr]:
        """Return ∂θ/∂z of the point's body by coordinate z; empty for a point of the ground."""
        geometry: TreeGeometry = self.geometry  # type: ignore[assignment]
        return geometry.frame_of[self.body.name].angle_coefficients if self.body else {}

    def expand_arms(self) -> TreePoint:
        """Return the point with position and velocity as sums of rotated vectors, not as one symbol for each component.

        In the difference of two points, common terms then cancel.
        """
        geometry: TreeGeometry = self.geometry  # type: ignore[assignment]
        rate = geometry.motions.coordinates
        speed = [sp.Add(*(c[i] * rate[k].v for k, c in self.columns.items())) for i in range(2)]
        return replace(self, position_xy=geometry.compute_position(self.terms), speed=(speed[0], speed[1]))


class TreeGeometry(Geometry):
    """Makes the symbols of bodies and points from a tree, for functions that also take a `Geometry`."""

    def __init__(self, model: Model, tree: Tree, symbols: Symbols, parameter_table: ParameterTable) -> None:
        """Begin with the frame of the ground; `build_bodies` adds the coordinates and bodies.

        `tree`: the spanning tree; `symbols`, `parameter_table`: tables for new symbols and derived parameters.
        """
        self.symbols, self.parameter_table, self.mechanism = symbols, parameter_table, model.scene.mechanism
        self.local_vectors, self.tree, self._model = model.geometry.local_vectors, tree, model
        self.bodies: dict[str, BodySymbols] = {}
        self.frames: dict[str, Frame] = {GROUND: GROUND_FRAME}
        self.frame_of: dict[str, Frame] = {GROUND: GROUND_FRAME}
        self.slides: dict[str, Affine] = {}
        self._offset: dict[str, sp.Expr] = {GROUND: ZERO}  # θ of a body less that of its frame
        self._base: dict[
            str, tuple[TreePoint, Pair]
        ] = {}  # point of the parent that carries a body, and the body's own vector to it
        self._points: dict[tuple[str, str], TreePoint] = {}
        self._coms: dict[str, TreePoint] = {}

    def build_bodies(self, motions: Motions, slides: Mapping[str, Affine]) -> None:
        """Make coordinates and frames, then position body by body along the tree. Called once.

        `motions` makes the symbols of coordinates and frames, and derived parameters of coefficients. It gets an entry
        in `coordinates` for each independent coordinate, numbered in q and v along the tree. `slides`: slides that
        drives or other slides determine; they get no coordinate.
        """
        self.motions = motions
        n_coordinates = 0
        free_bodies = set(self.tree.free)
        for tree_edge in self.tree.edges:
            for name in tree_edge.coordinates:
                self.slides[name] = motions.derive_coefficients(name, slides.get(name, {name: ONE}))
                n_coordinates += self._add_unknown_coordinate(name, n_coordinates) if name not in slides else 0
            if tree_edge.body in free_bodies:
                n_coordinates += self._add_unknown_coordinate(tree_edge.body, n_coordinates)
        for tree_edge in self.tree.edges:
            self._set_frame(tree_edge.body)
        for tree_edge in self.tree.edges:
            self._set_base_point(tree_edge)

    def _add_unknown_coordinate(self, name: str, index: int) -> int:
        """Add an unknown coordinate to `motions`, with symbols at an index in q and v; return 1.

        The result is the number of added coordinates. `name`: a body for an angle, else that of a slide.
        """
        new, owner = self.symbols.add_symbol, name.replace(".", "_")
        names = (f"{owner}_theta", f"{owner}_omega") if name in self.tree.free else (owner, f"{owner}_rate")
        q, v = (new(n, StorageLocation(array)[index], name) for n, array in zip(names, "qv", strict=True))
        self.motions.coordinates[name] = Coordinate(name, q, v)
        return 1

    def _set_frame(self, body: str) -> None:
        """Set the frame of a body: an existing one at a constant angle to the body, else a new one.

        The constant angle from the frame to the body is stored in `_offset`. The frame of a body whose angle is
        another body's free angle is named after the latter.
        """
        affine = self.motions.derive_coefficients(f"{body}_theta", self.tree.angles[body])
        constant = affine.get(CONSTANT, ZERO)
        angle_coefficients = {k: c for k, c in affine.items() if k != CONSTANT}
        frame = next((f for f in self.frames.values() if f.angle_coefficients == angle_coefficients), None)
        if frame is None:
            single_body = next(
                (
                    b
                    for b in angle_coefficients
                    if len(angle_coefficients) == 1 and angle_coefficients[b] == 1 and b in self.tree.free
                ),
                None,
            )
            name, frame_affine = (single_body, {single_body: ONE}) if single_body else (body, affine)
            frame = self.frames[name] = self.motions.make_frame(name, frame_affine)
        else:
            name = frame.name
        frame_constant = (
            ZERO if not angle_coefficients or name in self.tree.free else self.tree.angles[name].get(CONSTANT, ZERO)
        )
        self._offset[body] = sp.expand(constant - frame_constant)
        self.frame_of[body] = frame

    def rotate_to_frame(self, body: str, vector: Pair, base_name: str) -> Pair:
        """Return the components of a vector of a body in its frame, in which the body has a constant angle.

        They are derived parameters; `base_name`: base of their names. Without an angle the vector is returned
        unchanged.
        """
        offset = self._offset[body]
        if offset == 0 or vector == (ZERO, ZERO):
            return vector
        derive = self.parameter_table.derive_parameter
        cos = derive(f"cos_{body}_offset", sp.cos(offset), f"angle of {body} in its frame")
        sin = derive(f"sin_{body}_offset", sp.sin(offset), f"angle of {body} in its frame")
        rotated = (cos * vector[0] - sin * vector[1], sin * vector[0] + cos * vector[1])
        return self.motions.add_derived_vector(base_name, rotated, f"{base_name}_in_frame")

    def _set_base_point(self, tree_edge: TreeEdge) -> None:
        """Set the base point of a body, the point of its parent that positions it, then make the body's symbols.

        `tree_edge`: the edge of the spanning tree. Without a joint the base point moves along the axes of the ground. A
        joint with a slide moves it along its axis.
        """
        body = tree_edge.body
        if tree_edge.joint is None:
            unit_vectors = ((ONE, ZERO), (ZERO, ONE))
            terms = {(GROUND, name): unit for name, unit in zip(tree_edge.coordinates, unit_vectors, strict=True)}
            base, body_point = self._make_free_body_base(terms), (ZERO, ZERO)
        else:
            first, second = tree_edge.joint.first, tree_edge.joint.second
            parent, child, sign = (first, second, 1) if second.body == body else (second, first, -1)
            base, body_point = self.find_point(parent), self.local_vectors[body, child.point]
            if tree_edge.slides:
                axis = JointFields(tree_edge.joint, self._model.geometry).direction("axis")
                w = self.rotate_to_frame(first.body, axis, f"{tree_edge.joint.name}_axis")
                base = self._make_sliding_base(base, first.body, tree_edge.coordinates[0], (sign * w[0], sign * w[1]))
        self._base[body] = base, self.rotate_to_frame(body, body_point, f"{body}_base")
        self._derive_body_symbols(body)

    def _make_free_body_base(self, terms: Terms) -> TreePoint:
        """Return the base point of a body that moves freely: the point (x, y) of the ground given by its two slides.

        `terms`: unit vectors along x and y, each with its slide.
        """
        position = tuple(self.motions.compute_value(self.slides[name]) for _, name in terms)
        speed = tuple(self.motions.compute_rate(self.slides[name]) for _, name in terms)
        return TreePoint(self, None, (ZERO, ZERO), terms, (position[0], position[1]), (speed[0], speed[1]))

    def _make_sliding_base(self, base: TreePoint, body: str, slide: str, w: Pair) -> TreePoint:
        """Return the base point moved by `slide` along an axis w, given in the frame of the body `body`.

        Position, velocity and terms of the result contain the slide.
        """
        frame, value, rate = self.frame_of[body], self.get_slide_value(slide), self.get_slide_rate(slide)
        u_x, u_y = self.motions.rotate_vector(frame, w, f"axis_{slide}")
        terms = self._add_terms(base.terms, {(frame.name, slide): w}, slide)
        position = base.x + value * u_x, base.y + value * u_y
        speed = (
            base.velocity[0] + rate * u_x - frame.omega * value * u_y,
            base.velocity[1] + rate * u_y + frame.omega * value * u_x,
        )
        return TreePoint(self, None, (ZERO, ZERO), terms, position, speed)

    def get_slide_value(self, slide: str) -> sp.Expr:
        """Return the value in m of a slide (a translational coordinate); 1 for the name "", a term without slide."""
        return self.motions.compute_value(self.slides[slide]) if slide else ONE

    def get_slide_rate(self, slide: str) -> sp.Expr:
        """Return the rate in m/s of a slide (a translational coordinate); 0 for the name "", a term without slide."""
        return self.motions.compute_rate(self.slides[slide]) if slide else ZERO

    def _add_terms(self, terms: Terms, added_terms: Terms, base_name: str) -> Terms:
        """Return the sum of two sums of terms: vectors with the same key are added, zero vectors are left out.

        `terms`, `added_terms`: vectors w by (frame, slide), of which a position is the sum. Added vectors become
        derived parameters; `base_name`: base of their names.
        """
        result = dict(terms)
        for key, w in added_terms.items():
            if key in result:
                w = self.motions.add_derived_vector(f"{base_name}_and", (result[key][0] + w[0], result[key][1] + w[1]))
            result[key] = w
        return {key: w for key, w in result.items() if w != (ZERO, ZERO)}

    def compute_position(self, terms: Terms) -> Pair:
        """Return the position (x, y) = Σ value A(θ) w of a sum of terms; value is that of the slide, 1 without one.

        `terms`: vectors w by (frame, slide).
        """
        x, y = ZERO, ZERO
        for (frame, slide), w in terms.items():
            a_x, a_y = self.motions.rotate_vector(self.frames[frame], w, f"arm_{frame}")
            x, y = x + self.get_slide_value(slide) * a_x, y + self.get_slide_value(slide) * a_y
        return x, y

    def compute_jacobian_columns(self, terms: Terms) -> dict[str, Pair]:
        """Return ∂r/∂z of the position r of a sum of terms, as pairs (x, y) by coordinate z, prescribed ones included.

        A column is Σ (∂θ/∂z value ẑ × A w + ∂value/∂z A w). `terms`: vectors w by (frame, slide); value is that of the
        slide.
        """
        result: dict[str, Pair] = {}
        for (name, slide), w in terms.items():
            frame, value = self.frames[name], self.get_slide_value(slide)
            a_x, a_y = self.motions.rotate_vector(frame, w, f"arm_{name}")
            along = self.find_slide_coefficients(slide)
            for k in dict.fromkeys((*frame.angle_coefficients, *along)):
                x, y = result.get(k, (ZERO, ZERO))
                angular, linear = frame.angle_coefficients.get(k, ZERO) * value, along.get(k, ZERO)
                result[k] = x - angular * a_y + linear * a_x, y + angular * a_x + linear * a_y
        return result

    def compute_bias(self, terms: Terms) -> Pair:
        """Return r̈ of a sum of terms for z̈ = 0: Σ (−θ̇² value A w + 2 θ̇ rate ẑ × A w), as (x, y).

        `terms`: vectors w by (frame, slide); A(θ) is the rotation of the frame, value and rate are those of the slide.
        ẑ × turns a vector by +90°. z are all coordinates.
        """
        x, y = ZERO, ZERO
        for (name, slide), w in terms.items():
            frame = self.frames[name]
            a_x, a_y = self.motions.rotate_vector(frame, w, f"arm_{name}")
            radial, tangential = (
                -(frame.omega**2) * self.get_slide_value(slide),
                2 * frame.omega * self.get_slide_rate(slide),
            )
            x, y = x + radial * a_x - tangential * a_y, y + radial * a_y + tangential * a_x
        return x, y

    def find_slide_coefficients(self, slide: str) -> dict[str, sp.Expr]:
        """Return ∂value/∂z of a slide by coordinate z, which are constants; empty for "", a term without slide."""
        return {k: c for k, c in self.slides[slide].items() if k != CONSTANT} if slide else {}

    def _make_point(self, body: str, vector: Pair, base_name: str, names: tuple[str, str, str, str]) -> TreePoint:
        """Return a point of a body; `vector` leads from the body's centre of mass to the point, in the body's frame.

        `base_name`: base of the names of derived parameters and rotated vectors. `names`: names for (x, y, ẋ, ẏ); a
        value that is not a number or ± a symbol becomes a symbol of that name.
        """
        base, body_base = self._base[body]
        frame, local = self.frame_of[body], self.rotate_to_frame(body, vector, base_name)
        w = self.motions.add_derived_vector(f"{base_name}_span", (local[0] - body_base[0], local[1] - body_base[1]))
        a_x, a_y = self.motions.rotate_vector(frame, w, f"span_{base_name}")
        terms = self._add_terms(base.terms, {(frame.name, ""): w} if w != (ZERO, ZERO) else {}, base_name)
        columns, define_symbol = self.compute_jacobian_columns(terms), self.motions.define_value
        values = [base.x + a_x, base.y + a_y]
        rates = [base.velocity[0] - frame.omega * a_y, base.velocity[1] + frame.omega * a_x]
        for i in range(2):
            point_columns = {k: c[i] for k, c in columns.items() if c[i] != 0}
            if not self.is_number_or_signed_symbol(values[i]):
                values[i] = define_symbol(names[i], values[i], point_columns)
            if not self.is_number_or_signed_symbol(rates[i]):
                rates[i] = self.motions.define_rate(names[2 + i], rates[i], point_columns)
        arm = self.rotate_vector(self.bodies[body], vector, f"arm_{base_name}") if body in self.bodies else (ZERO, ZERO)
        position, speed = (values[0], values[1]), (rates[0], rates[1])
        return TreePoint(self, self.bodies.get(body), arm, terms, position, speed)

    def is_number_or_signed_symbol(self, value: sp.Expr) -> bool:
        """Return whether a value is a symbol, its negative, or a number, so that it needs no symbol of its own."""
        return bool(value.is_Number) or is_signed_symbol(value)

    def _derive_body_symbols(self, body: str) -> None:
        """Make the symbols (x, y, θ) of a body and of its rates, as functions of the coordinates.

        Mass and inertia are those of the model; the centre of mass is stored as a point.
        """
        body_symbols, frame, motions = self._model.geometry.bodies[body], self.frame_of[body], self.motions
        com = self._make_point(
            body, (ZERO, ZERO), f"{body}_com", (f"{body}_x", f"{body}_y", f"{body}_vx", f"{body}_vy")
        )
        theta, omega = frame.theta + self._offset[body], frame.omega

        def get_or_define_symbol(
            base_name: str, value: sp.Expr, partials: Mapping[str, sp.Expr], is_rate: bool = False
        ) -> sp.Symbol:
            """Return a value unchanged if it is a symbol, else a new symbol for it with derivative rules.

            `partials`: its derivatives by the tree coordinates. With `is_rate` the value is a velocity, and `partials`
            are those of the quantity whose velocity it is.
            """
            define_symbol = motions.define_rate if is_rate else motions.define_value
            return value if value.is_Symbol else define_symbol(base_name, value, partials)

        x, y = (
            get_or_define_symbol(f"{body}_{axis}", component, {k: w[i] for k, w in com.columns.items()})
            for i, (axis, component) in enumerate(zip("xy", com.position_xy, strict=True))
        )
        vx, vy = (
            get_or_define_symbol(f"{body}_v{axis}", component, {k: w[i] for k, w in com.columns.items()}, True)
            for i, (axis, component) in enumerate(zip("xy", com.speed, strict=True))
        )
        self.bodies[body] = BodySymbols(
            body,
            body_symbols.index,
            x,
            y,
            get_or_define_symbol(f"{body}_theta", theta, frame.angle_coefficients),
            vx,
            vy,
            get_or_define_symbol(f"{body}_omega", omega, frame.angle_coefficients, True),
            body_symbols.mass,
            body_symbols.inertia,
        )
        self._coms[body] = replace(com, body=self.bodies[body])

    def centre_of_mass(self, body: str) -> TreePoint:
        """Return the centre of mass of a body as a point in tree coordinates, made with the body's symbols."""
        return self._coms[body]

    def find_cos_and_sin(self, body: BodySymbols) -> tuple[sp.Expr, sp.Expr]:
        """Return cos θ and sin θ of a body; they become new symbols if the body has a constant angle to its frame."""
        x, y = self.rotate_vector(body, (ONE, ZERO), f"axis_{body.name}")
        return x, y

    def rotate_vector(self, body: BodySymbols, vector: Pair, base_name: str, point: str = "") -> Pair:
        """Return A(θ) s in ground axes, for the components s of a vector in a body's own frame.

        `base_name`: base of the names of new symbols; `point` is not used.
        """
        return self.motions.rotate_vector(
            self.frame_of[body.name], self.rotate_to_frame(body.name, vector, base_name), base_name
        )

    def find_point_at_offset(self, ref: PointRef, offset: Pair, base_name: str) -> TreePoint:
        """Return the frame of the point at an offset from a named point; the offset is in the body's own frame.

        `base_name`: base of the names of symbols.
        """
        s = self._find_offset_vector(ref, offset, base_name)
        if ref.body == GROUND:
            return TreePoint(self, None, s, {(GROUND, ""): s}, s, (ZERO, ZERO))
        names = (f"{base_name}_x", f"{base_name}_y", f"{base_name}_vx", f"{base_name}_vy")
        return self._make_point(ref.body, s, base_name, names)

    def find_point(self, ref: PointRef) -> TreePoint:
        """Return the frame of a named point of a body or of the ground, made at the first call.

        An empty name at the ground is its origin. Raise KeyError for an unknown point.
        """
        key = ref.body, ref.point
        if key not in self._points:
            if ref.body == GROUND:
                position = self.ground_vector(self.mechanism.ground[ref.point]) if ref.point else (ZERO, ZERO)
                terms = {(GROUND, ""): position} if position != (ZERO, ZERO) else {}
                self._points[key] = TreePoint(self, None, position, terms, position, (ZERO, ZERO))
            else:
                name = f"{ref.body}_{ref.point}"
                names = (f"{name}_x", f"{name}_y", f"{name}_vx", f"{name}_vy")
                self._points[key] = self._make_point(ref.body, self.local_vectors[ref.body, ref.point], name, names)
        return self._points[key]

"""Reduced equations: tree coordinates along a spanning tree of joints, closure equations for the other joints.

Angles that drives prescribe are functions of t; the other angles and slides along the tree are the unknowns s.
Joints, laws and force elements are derived a second time, by the same functions, on the geometry of the tree, so
that they are expressed in s. The parameters are those of the absolute formulation: one `prepare` serves both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from gudgeon.generator.equations.constraints import Constraints, Row
from gudgeon.generator.equations.geometry import BodySymbols, PointFrame
from gudgeon.generator.equations.loads import PointLoad, make_applied_element, make_friction
from gudgeon.generator.equations.model import Model, make_event
from gudgeon.generator.equations.play import make_clearances
from gudgeon.generator.equations.system import Motion, PrescribedCoordinate, System
from gudgeon.generator.mechanism import PointRef
from gudgeon.generator.reduction.driven_loops import (
    DrivenLoops,
    add_directions,
    find_dependent_coordinates,
    prescribe_coordinates,
)
from gudgeon.generator.reduction.frames import CONSTANT, ONE, ZERO, Affine, Coordinate, Motions, substitute_coordinate
from gudgeon.generator.reduction.geometry import TreeGeometry, TreePoint
from gudgeon.generator.reduction.inertia import Inertia
from gudgeon.generator.reduction.tree import Tree, choose_tree, is_impulsive_drive


@dataclass(frozen=True)
class TreeSystem(System):
    """A system in tree coordinates; `tree` defines them, `unknowns` are their names."""

    tree: Tree
    unknowns: tuple[str, ...]
    slides: Mapping[str, Affine]  # slides that drives or other slides determine
    slide_rows: tuple[str, ...]  # the equations that determine them, one per slide
    driven_loops: DrivenLoops | None = None  # what the drives determine through loops (driven_loops.py)
    in_tree = True

    @cached_property
    def _rotating_bodies(self) -> dict[str, dict[str, sp.Expr]]:
        """Return for each coordinate the bodies that turn with it, each with ∂θ/∂coordinate, in model order."""
        geometry, rotating_bodies = self.model.geometry, dict[str, dict[str, sp.Expr]]()
        assert isinstance(geometry, TreeGeometry)
        for body in geometry.bodies:
            for name, rate in geometry.frame_of[body].angle_coefficients.items():
                if rate != 0:
                    rotating_bodies.setdefault(name, {})[body] = rate
        return rotating_bodies

    def _find_rotating_bodies(self, k: int) -> dict[str, sp.Expr]:
        """Return the bodies that turn with coordinate k, each with ∂θ/∂coordinate; empty for a slide."""
        return self._rotating_bodies.get(self.unknowns[k], {})

    def compute_inertia_of_unit_mass(self, k: int) -> sp.Expr:
        """Return the inertia of an angle k for bodies of 1 kg: Σ (∂θ/∂k)² s² over their joint points; 1 for a slide."""
        turned = self._find_rotating_bodies(k).items()
        return (
            sp.Add(*(c**2 * s for body, c in turned for s in self.model.compute_squared_arms(body))) if turned else ONE
        )

    def compute_inertia_about_joints(self, k: int) -> sp.Expr:
        """Return the moment of inertia to which the pivot of coordinate k in M is compared; 0 for a slide.

        For an angle it is Σ (∂θ/∂k)² (J + Σ m s²) over the bodies that turn with it, as a derived parameter. s leads
        from the centre of mass to each point of a joint.
        """
        name = self.unknowns[k]
        inertia = sp.Add(
            *(c**2 * self.model.compute_inertia_about_joints(body) for body, c in self._find_rotating_bodies(k).items())
        )
        return self.model.parameter_table.derive_parameter(
            f"{name.replace('.', '_')}_turning", inertia, "J and m s^2 of what turns with it"
        )

    def compute_generalized_forces(self, loads: Sequence[PointLoad]) -> tuple[list[sp.Expr], dict[str, sp.Expr]]:
        """Return the generalized forces of loads by tree coordinate, and those on prescribed coordinates by name.

        A generalized force is Σ (∂r/∂z · F + ∂θ/∂z M) over the `loads` (point, F_x, F_y, M). Forces with the same, or
        the opposite, ∂r/∂z are added first.
        """
        levers: dict[str, dict[tuple[sp.Expr, sp.Expr], list[sp.Expr]]] = {}
        moments: dict[str, sp.Expr] = {}
        for point, x, y, moment in loads:
            assert isinstance(point, TreePoint)
            for k, lever in point.columns.items():
                forces_by_lever = levers.setdefault(k, {})
                opposite = (-lever[0], -lever[1])
                key, sign = (opposite, -1) if opposite in forces_by_lever else (lever, 1)
                lever_force = forces_by_lever.setdefault(key, [ZERO, ZERO])
                lever_force[0] += sign * x
                lever_force[1] += sign * y
            for k, rate in point.angle_coefficients.items():
                moments[k] = moments.get(k, ZERO) + rate * moment
        forces = dict(moments)
        for k, forces_by_lever in levers.items():
            for (lever_x, lever_y), (x, y) in forces_by_lever.items():
                forces[k] = forces.get(k, ZERO) + lever_x * x + lever_y * y
        unknown = [forces.get(name, ZERO) for name in self.unknowns]
        return unknown, {coordinate.name: forces.get(coordinate.name, ZERO) for coordinate in self.prescribed}


class TreeConstraints(Constraints):
    """Constraint equations in tree coordinates: the same joints on the tree's geometry."""

    geometry: TreeGeometry

    def _find_point_frame(self, ref: PointRef) -> PointFrame:
        """Return the frame of a named point with position and velocity as sums of rotated vectors (`expand_arms`)."""
        return self.geometry.find_point(ref).expand_arms()

    def _find_coordinate_pairs(self, bodies: list[BodySymbols]) -> list[tuple[sp.Symbol, sp.Symbol]]:
        """Return the pairs (coordinate, rate) of the unknowns that move the bodies, without prescribed coordinates."""
        geometry = self.geometry
        names = {
            k
            for body in bodies
            for k in (*geometry.centre_of_mass(body.name).columns, *geometry.frame_of[body.name].angle_coefficients)
        }
        return [
            (c.q, c.v) for name, c in geometry.motions.coordinates.items() if name in names and c.acceleration is None
        ]


def reduce_model(model: Model) -> TreeSystem:
    """Return the system of a model in tree coordinates; redundant equations must have been left out already.

    Slides that linear equations give in other slides or drives are eliminated one by one; then loops that drives
    determine.
    """
    tree = choose_tree(model)
    slides: dict[str, Affine] = {}
    slide_rows: tuple[str, ...] = ()
    while True:
        geometry, constraints = _make_tree_geometry(model, tree, slides)
        rows = _derive_closures(model, tree, constraints)
        elimination = _find_determined_slide(model, geometry, constraints, rows)
        if elimination is None:
            return _eliminate_driven_loops(
                model, _make_system(model, tree, (slides, slide_rows), geometry, constraints, rows)
            )
        row, name, value = elimination
        slides = {slide: substitute_coordinate(affine, name, value) for slide, affine in slides.items()} | {name: value}
        slide_rows += (row,)
        tree = replace(tree, satisfied_rows=tree.satisfied_rows | {row})


def _eliminate_driven_loops(model: Model, system: TreeSystem) -> TreeSystem:
    """Return the system with the coordinates that drives determine through loops as functions of t.

    The system is returned unchanged without degrees of freedom, closures or such coordinates. A drive whose rate may
    jump determines nothing.
    """
    if model.degrees_of_freedom <= 0 or not system.rows:
        return system
    excluded = {row.name for row in system.rows if is_impulsive_drive(model, row)}
    columns, rows = find_dependent_coordinates(system, excluded)
    if not columns:
        return system
    free = tuple(name for k, name in enumerate(system.unknowns) if k not in columns)
    reduced, driven_loops = prescribe_coordinates(system, system.unknowns, columns, rows)
    geometry: TreeGeometry = reduced.model.geometry  # type: ignore[assignment]
    prescribed_names = {
        name for name, coordinate in geometry.motions.coordinates.items() if coordinate.acceleration is not None
    }
    driven_loops = add_directions(driven_loops, reduced, geometry.frames.values(), prescribed_names)
    return replace(reduced, unknowns=free, driven_loops=driven_loops)


def _make_tree_geometry(model: Model, tree: Tree, slides: Mapping[str, Affine]) -> tuple[TreeGeometry, TreeConstraints]:
    """Return the geometry of a tree, with new symbols for coordinates, bodies and points, and its constraints.

    `slides`: the slides that are affine functions of other slides and drives.
    """
    symbols = model.symbols.copy_parameters_only()
    parameter_table = model.parameter_table.copy_for_symbols(symbols)
    geometry = TreeGeometry(model, tree, symbols, parameter_table)
    constraints = TreeConstraints(geometry)
    motions = Motions(symbols, parameter_table, constraints.t)
    used_names = {name for affine in (*tree.angles.values(), *slides.values()) for name in affine}
    for drive in model.scene.mechanism.drives.values():
        if drive.name in used_names:
            constraints.define_drive_value(drive)
            motions.coordinates[drive.name] = Coordinate(drive.name, *constraints.drive_functions[drive.name])
    geometry.build_bodies(motions, slides)
    return geometry, constraints


def _derive_closures(model: Model, tree: Tree, constraints: TreeConstraints) -> tuple[Row, ...]:
    """Return the loop-closure equations, which the tree does not satisfy by itself, in the order of the model.

    Equations of the pairs of bodies that close shared points (multiple joints) follow.
    """
    mechanism = model.scene.mechanism
    closure_names = [row.name for row in model.rows if row.name not in tree.satisfied_rows]
    owners = {row.owner for row in model.rows if row.name in closure_names}
    row_by_name: dict[str, Row] = {}
    for joint in mechanism.joints.values():
        if joint.name in owners:
            row_by_name |= {row.name: row for row in constraints.derive_joint_rows(joint)}
    for drive in mechanism.drives.values():
        if drive.name in owners:
            row_by_name |= {row.name: row for row in constraints.derive_drive_rows(drive)}
    shared_point_rows = [row for joint in tree.closing_pairs for row in constraints.derive_joint_rows(joint)]
    return (*(row_by_name[name] for name in closure_names), *shared_point_rows)


def _find_determined_slide(
    model: Model, geometry: TreeGeometry, constraints: TreeConstraints, rows: Sequence[Row]
) -> tuple[str, str, Affine] | None:
    """Return (equation, slide, value) for an equation that gives a slide by other slides and drives.

    The equation is linear in slides with constant coefficients, and is solved for a slide with the coefficient ±1 if
    there is one; the value is affine. Names stand for the first two. Return None if there is no such equation; that of
    a drive whose rate may jump does not count.
    """
    names = {c.q: name for name, c in geometry.motions.coordinates.items()}
    drives = {c.q: name for name, c in geometry.motions.coordinates.items() if c.acceleration is not None}
    drives |= {value: name for name, (value, *_) in constraints.drive_functions.items()}
    is_constant = geometry.parameter_table.is_constant
    for row in rows:
        if is_impulsive_drive(model, row):
            continue
        if not row.phi_q or not all(names[q] in geometry.slides and is_constant(c) for q, c in row.phi_q.items()):
            continue
        coefficients: dict[str, sp.Expr] = {names[q]: c for q, c in row.phi_q.items()}
        remainder = sp.expand(row.phi - sum(c * q for q, c in row.phi_q.items()))
        for value in sorted(remainder.free_symbols & set(drives), key=lambda s: s.name):
            coefficients[drives[value]] = remainder.coeff(value)
            remainder = remainder - remainder.coeff(value) * value
        if is_constant(sp.expand(remainder)):
            coefficients[CONSTANT] = sp.expand(remainder)
            name = max((names[q] for q in row.phi_q), key=lambda k: abs(coefficients[k]) == 1)
            return row.name, name, {k: -c / coefficients[name] for k, c in coefficients.items() if k != name and c != 0}
    return None


def _make_system(
    model: Model,
    tree: Tree,
    slides: tuple[Mapping[str, Affine], tuple[str, ...]],
    geometry: TreeGeometry,
    constraints: TreeConstraints,
    rows: tuple[Row, ...],
) -> TreeSystem:
    """Return the system of the equations of motion on the tree: joints with play, force elements, M and applied forces.

    `slides`: the slides that are functions of others, and the names of the equations that give them; `rows`: the
    closures. M and forces are those of the unknown coordinates; prescribed accelerations are on the right-hand side.
    """
    reduced = _make_tree_model(model, geometry, constraints, rows)
    coordinates = geometry.motions.coordinates
    unknowns = {name: coordinate for name, coordinate in coordinates.items() if coordinate.acceleration is None}
    prescribed = {name: coordinate for name, coordinate in coordinates.items() if coordinate.acceleration is not None}
    index_of = {name: k for k, name in enumerate(unknowns)}
    inertia = Inertia(geometry, model.gravity)
    velocity_terms, weights = inertia.derive_velocity_terms(), inertia.derive_weights()

    def compute_applied_force(name: str) -> sp.Expr:
        """Return the generalized force on a coordinate of gravity, of velocity terms and of prescribed accelerations.

        The velocity terms (inertia forces) and M times the prescribed accelerations are subtracted from the weight.
        """
        prescribed_forces = sum(
            (inertia.mass.get((name, k), ZERO) * coordinate.acceleration for k, coordinate in prescribed.items()), ZERO
        )
        return weights.get(name, ZERO) - velocity_terms.get(name, ZERO) - prescribed_forces

    mass = {
        (index_of[k], index_of[j]): value
        for (k, j), value in inertia.mass.items()
        if k in index_of and j in index_of and index_of[k] >= index_of[j]
    }
    drives = tuple(
        PrescribedCoordinate(
            name,
            coordinate.v,
            {index_of[k]: inertia.mass[name, k] for k in unknowns if (name, k) in inertia.mass},
            compute_applied_force(name),
        )
        for name, coordinate in prescribed.items()
    )
    return TreeSystem(
        reduced,
        tuple(coordinate.q for coordinate in unknowns.values()),
        tuple(coordinate.v for coordinate in unknowns.values()),
        {body: _derive_body_motion(geometry, body, index_of) for body in model.geometry.bodies},
        mass,
        tuple(compute_applied_force(name) for name in unknowns),
        drives,
        rows,
        reduced.frictions,
        tree,
        tuple(unknowns),
        *slides,
    )


def _make_tree_model(
    model: Model, geometry: TreeGeometry, constraints: TreeConstraints, rows: tuple[Row, ...]
) -> Model:
    """Return the model for the tree's kernels: the same scene on the geometry of the tree.

    Joints with play, force elements, friction and events are derived again; `rows` replace the constraint equations.
    The bodies of `geometry` are sorted in the order of the file.
    """
    mechanism, symbols, t = model.scene.mechanism, geometry.symbols, constraints.t
    clearances = tuple(
        clearance
        for name, play in model.scene.play.items()
        for clearance in make_clearances(mechanism.joints[name], play, geometry, geometry.parameter_table)
    )
    elements = {e.name: make_applied_element(e, geometry, t) for e in mechanism.forces.values()}
    coordinate_pairs = [(c.q, c.v) for c in geometry.motions.coordinates.values() if c.acceleration is None]
    frictions = tuple(
        make_friction(name, e.loads.slip, coordinate_pairs, t, symbols) for name, e in elements.items() if e.loads.slip
    )
    events = tuple(make_event(event, geometry, t) for event in model.scene.events.values())
    bodies = {name: geometry.bodies[name] for name in model.geometry.bodies}
    geometry.bodies.clear()
    geometry.bodies.update(bodies)  # in the order of the file again
    return replace(
        model,
        symbols=symbols,
        parameter_table=geometry.parameter_table,
        geometry=geometry,
        constraints=constraints,
        all_rows=rows,
        rows=rows,
        clearances=clearances,
        elements=elements,
        frictions=frictions,
        events=events,
    )


def _derive_body_motion(geometry: TreeGeometry, body: str, index_of: Mapping[str, int]) -> Motion:
    """Return the Jacobian and bias of a body's centre of mass and angle: r̈ = J s̈ + bias for the unknowns s.

    `index_of`: index of each unknown; the accelerations of prescribed coordinates are in the bias.
    """
    com, angle_coefficients = geometry.centre_of_mass(body), geometry.frame_of[body].angle_coefficients
    coordinates = geometry.motions.coordinates
    columns = [{k: column_pair[i] for k, column_pair in com.columns.items()} for i in range(2)] + [
        dict(angle_coefficients)
    ]
    bias = [*geometry.compute_bias(com.terms), ZERO]
    for i, column in enumerate(columns):
        for k, entry in column.items():
            if (acceleration := coordinates[k].acceleration) is not None:
                bias[i] += entry * acceleration
    rows = tuple({index_of[k]: entry for k, entry in column.items() if k in index_of} for column in columns)
    return Motion(rows, tuple(bias))

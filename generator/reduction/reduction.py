"""The reduced formulation: the same motion in the coordinates of a tree, with loop closures for the other joints.

Angles that drives prescribe are functions of t; the other angles and slides along the tree are the unknowns s.
Joints, laws and force elements are derived a second time, by the same functions, on the geometry of the tree, so
that they are expressed in s. The parameters are those of the absolute formulation: one `prepare` serves both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations.constraints import Constraints, Row
from gudgeon.generator.equations.geometry import BodySymbols, PointFrame
from gudgeon.generator.equations.loads import PointLoad, apply_element, make_friction
from gudgeon.generator.equations.model import Model, make_event
from gudgeon.generator.equations.play import make_clearances
from gudgeon.generator.equations.system import Motion, PrescribedCoordinate, System
from gudgeon.generator.mechanism import PointRef
from gudgeon.generator.reduction.driven_chains import Chain, determined, prescribe, with_directions
from gudgeon.generator.reduction.frames import CONSTANT, ONE, ZERO, Affine, Coordinate, Motions, substitute
from gudgeon.generator.reduction.geometry import TreeGeometry, TreePoint
from gudgeon.generator.reduction.inertia import Inertia
from gudgeon.generator.reduction.tree import Tree, choose_tree, stays_constraint


@dataclass(frozen=True)
class TreeSystem(System):
    """A system in tree coordinates; `tree` defines them, `unknowns` are their names."""

    tree: Tree
    unknowns: tuple[str, ...]
    slides: Mapping[str, Affine]  # slides that drives or other slides determine
    sliding: tuple[str, ...]  # the equations that determine them, one per slide
    chain: Chain | None = None  # what the drives determine through loops (driven_chains.py)
    in_tree = True

    def _turned_by(self, k: int) -> dict[str, sp.Expr]:
        """Return the bodies that turn with an angle k, and their rates by it; none for a slide."""
        geometry, name = self.model.geometry, self.unknowns[k]
        assert isinstance(geometry, TreeGeometry)
        turns = {body: geometry.frame_of[body].turns.get(name, ZERO) for body in geometry.bodies}
        return {body: c for body, c in turns.items() if c != 0}

    def inertia_of_unit_mass(self, k: int) -> sp.Expr:
        """Return the inertia about an angle k of all bodies that turn with it, each of 1 kg; 1 of a slide."""
        turned = self._turned_by(k).items()
        return sp.Add(*(c**2 * s for body, c in turned for s in self.model.squared_arms(body))) if turned else ONE

    def turning_inertia(self, k: int) -> sp.Expr:
        """Return the inertia about an angle k of all bodies that turn with it; 0 of a slide."""
        name = self.unknowns[k]
        total = sp.Add(*(c**2 * self.model.turning_inertia(body) for body, c in self._turned_by(k).items()))
        return self.model.slots.derive(f"{name.replace('.', '_')}_turning", total, "J and m s^2 of what turns with it")

    def generalized(self, loads: Sequence[PointLoad]) -> tuple[list[sp.Expr], dict[str, sp.Expr]]:
        """Return the generalized forces of loads; forces with the same lever arm are added first."""
        levers: dict[str, dict[tuple[sp.Expr, sp.Expr], list[sp.Expr]]] = {}
        moments: dict[str, sp.Expr] = {}
        for point, x, y, moment in loads:
            assert isinstance(point, TreePoint)
            for k, lever in point.columns.items():
                of = levers.setdefault(k, {})
                opposite = (-lever[0], -lever[1])
                key, sign = (opposite, -1) if opposite in of else (lever, 1)
                force = of.setdefault(key, [ZERO, ZERO])
                force[0] += sign * x
                force[1] += sign * y
            for k, turn in point.turns.items():
                moments[k] = moments.get(k, ZERO) + turn * moment
        total = dict(moments)
        for k, of in levers.items():
            for (lever_x, lever_y), (x, y) in of.items():
                total[k] = total.get(k, ZERO) + lever_x * x + lever_y * y
        unknown = [total.get(name, ZERO) for name in self.unknowns]
        return unknown, {g.name: total.get(g.name, ZERO) for g in self.given}


class TreeConstraints(Constraints):
    """Constraint equations in tree coordinates: the same joints on the tree's geometry."""

    geometry: TreeGeometry

    def _point(self, ref: PointRef) -> PointFrame:
        """Return the frame of a named point as one sum of arms."""
        return self.geometry.point(ref).flat()

    def _pairs(self, bodies: list[BodySymbols]) -> list[tuple[sp.Symbol, sp.Symbol]]:
        """Return the pairs (coordinate, rate) of the unknowns that move the bodies."""
        geometry = self.geometry
        names = {k for body in bodies for k in (*geometry.com(body.name).columns, *geometry.frame_of[body.name].turns)}
        return [
            (c.q, c.v) for name, c in geometry.motions.coordinates.items() if name in names and c.acceleration is None
        ]


def reduce(model: Model) -> TreeSystem:
    """Return the system of a model in tree coordinates; redundant equations have been left out already."""
    tree = choose_tree(model)
    slides: dict[str, Affine] = {}
    sliding: tuple[str, ...] = ()
    while True:
        geometry, constraints = _place(model, tree, slides)
        rows = _closures(model, tree, constraints)
        found = _known_slide(model, geometry, constraints, rows)
        if found is None:
            return _without_chains(model, _system(model, tree, (slides, sliding), geometry, constraints, rows))
        row, name, value = found
        slides = {k: substitute(v, name, value) for k, v in slides.items()} | {name: value}
        sliding += (row,)
        tree = replace(tree, rows=tree.rows | {row})


def _without_chains(model: Model, system: TreeSystem) -> TreeSystem:
    """Return the system with coordinates that drives determine as functions of t.

    A scene without degrees of freedom is returned as it is, since nothing is integrated.
    """
    if model.degrees_of_freedom <= 0 or not system.rows:
        return system
    held = {row.name for row in system.rows if stays_constraint(model, row)}
    columns, rows = determined(system, held)
    if not columns:
        return system
    free = tuple(name for k, name in enumerate(system.unknowns) if k not in columns)
    reduced, chain = prescribe(system, system.unknowns, columns, rows)
    geometry: TreeGeometry = reduced.model.geometry  # type: ignore[assignment]
    driven = {name for name, c in geometry.motions.coordinates.items() if c.acceleration is not None}
    chain = with_directions(chain, reduced, geometry.frames.values(), driven)
    return replace(reduced, unknowns=free, chain=chain)


def _place(model: Model, tree: Tree, slides: Mapping[str, Affine]) -> tuple[TreeGeometry, TreeConstraints]:
    """Return the geometry of a tree, with symbols, coordinates and bodies, and its constraints."""
    symbols = model.symbols.beside()
    slots = model.slots.beside(symbols)
    geometry = TreeGeometry(model, tree, symbols, slots)
    constraints = TreeConstraints(geometry)
    motions = Motions(symbols, slots, constraints.t)
    used = {k for affine in (*tree.angles.values(), *slides.values()) for k in affine}
    for drive in model.scene.mechanism.drives.values():
        if drive.name in used:
            constraints.drive_value(drive)
            motions.coordinates[drive.name] = Coordinate(drive.name, *constraints.drive_angles[drive.name])
    geometry.place(motions, slides)
    return geometry, constraints


def _closures(model: Model, tree: Tree, constraints: TreeConstraints) -> tuple[Row, ...]:
    """Return the constraint equations that the tree does not satisfy by itself, in the order of the model."""
    mechanism = model.scene.mechanism
    expected = [row.name for row in model.rows if row.name not in tree.rows]
    owners = {row.owner for row in model.rows if row.name in expected}
    derived: dict[str, Row] = {}
    for joint in mechanism.joints.values():
        if joint.name in owners:
            derived |= {row.name: row for row in constraints.joint_rows(joint)}
    for drive in mechanism.drives.values():
        if drive.name in owners:
            derived |= {row.name: row for row in constraints.drive_rows(drive)}
    pairs = [row for joint in tree.closing for row in constraints.joint_rows(joint)]
    return (*(derived[name] for name in expected), *pairs)


def _known_slide(
    model: Model, geometry: TreeGeometry, constraints: TreeConstraints, rows: Sequence[Row]
) -> tuple[str, str, Affine] | None:
    """Return an equation that is linear in slides with constant coefficients, one of its slides, and its value.

    None if there is no such equation.
    """
    names = {c.q: name for name, c in geometry.motions.coordinates.items()}
    drives = {c.q: name for name, c in geometry.motions.coordinates.items() if c.acceleration is not None}
    drives |= {value: name for name, (value, *_) in constraints.drive_angles.items()}
    constant = geometry.slots.is_constant
    for row in rows:
        if stays_constraint(model, row):
            continue
        if not row.phi_q or not all(names[q] in geometry.slides and constant(c) for q, c in row.phi_q.items()):
            continue
        total: dict[str, sp.Expr] = {names[q]: c for q, c in row.phi_q.items()}
        rest = sp.expand(row.phi - sum(c * q for q, c in row.phi_q.items()))
        for value in sorted(rest.free_symbols & set(drives), key=lambda s: s.name):
            total[drives[value]] = rest.coeff(value)
            rest = rest - rest.coeff(value) * value
        if constant(sp.expand(rest)):
            total[CONSTANT] = sp.expand(rest)
            name = max((names[q] for q in row.phi_q), key=lambda k: abs(total[k]) == 1)
            return row.name, name, {k: -c / total[name] for k, c in total.items() if k != name and c != 0}
    return None


def _system(
    model: Model,
    tree: Tree,
    slides: tuple[Mapping[str, Affine], tuple[str, ...]],
    geometry: TreeGeometry,
    constraints: TreeConstraints,
    rows: tuple[Row, ...],
) -> TreeSystem:
    """Return the system on the tree: joints with play, force elements, M and the applied forces."""
    reduced = _model(model, geometry, constraints, rows)
    coordinates = geometry.motions.coordinates
    unknowns = {name: c for name, c in coordinates.items() if c.acceleration is None}
    given = {name: c for name, c in coordinates.items() if c.acceleration is not None}
    place = {name: k for k, name in enumerate(unknowns)}
    inertia = Inertia(geometry, model.gravity)
    h, weights = inertia.velocity_terms(), inertia.weights()

    def applied(name: str) -> sp.Expr:
        """Return weight minus velocity terms and minus M times prescribed accelerations."""
        pushed = sum((inertia.mass.get((name, k), ZERO) * c.acceleration for k, c in given.items()), ZERO)
        return weights.get(name, ZERO) - h.get(name, ZERO) - pushed

    mass = {
        (place[k], place[j]): value
        for (k, j), value in inertia.mass.items()
        if k in place and j in place and place[k] >= place[j]
    }
    drives = tuple(
        PrescribedCoordinate(
            name, c.v, {place[k]: inertia.mass[name, k] for k in unknowns if (name, k) in inertia.mass}, applied(name)
        )
        for name, c in given.items()
    )
    return TreeSystem(
        reduced,
        tuple(c.q for c in unknowns.values()),
        tuple(c.v for c in unknowns.values()),
        {body: _motion(geometry, body, place) for body in model.geometry.bodies},
        mass,
        tuple(applied(name) for name in unknowns),
        drives,
        rows,
        reduced.frictions,
        tree,
        tuple(unknowns),
        *slides,
    )


def _model(model: Model, geometry: TreeGeometry, constraints: TreeConstraints, rows: tuple[Row, ...]) -> Model:
    """Return the model for the tree's kernels: the same scene on the geometry of the tree."""
    mechanism, symbols, t = model.scene.mechanism, geometry.symbols, constraints.t
    clearances = tuple(
        clearance
        for name, play in model.scene.play.items()
        for clearance in make_clearances(mechanism.joints[name], play, geometry, geometry.slots)
    )
    elements = {e.name: apply_element(e, geometry, t) for e in mechanism.forces.values()}
    pairs = [(c.q, c.v) for c in geometry.motions.coordinates.values() if c.acceleration is None]
    frictions = tuple(
        make_friction(name, e.loads.slip, pairs, t, symbols) for name, e in elements.items() if e.loads.slip
    )
    events = tuple(make_event(event, geometry, t) for event in model.scene.events.values())
    bodies = {name: geometry.bodies[name] for name in model.geometry.bodies}
    geometry.bodies.clear()
    geometry.bodies.update(bodies)  # in the order of the file again
    return replace(
        model,
        symbols=symbols,
        slots=geometry.slots,
        geometry=geometry,
        constraints=constraints,
        all_rows=rows,
        rows=rows,
        clearances=clearances,
        elements=elements,
        frictions=frictions,
        events=events,
    )


def _motion(geometry: TreeGeometry, body: str, place: Mapping[str, int]) -> Motion:
    """Return J and bias of a body's centre of mass and angle."""
    at, turns = geometry.com(body), geometry.frame_of[body].turns
    coordinates = geometry.motions.coordinates
    columns = [{k: c[i] for k, c in at.columns.items()} for i in range(2)] + [dict(turns)]
    bias = [*geometry.bias(at.terms), ZERO]
    for i, column in enumerate(columns):
        for k, entry in column.items():
            if (acceleration := coordinates[k].acceleration) is not None:
                bias[i] += entry * acceleration
    rows = tuple({place[k]: entry for k, entry in column.items() if k in place} for column in columns)
    return Motion(rows, tuple(bias))

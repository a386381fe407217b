"""The names of everything in the emitted C, for the runtime: a KernelSource."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from types import MappingProxyType

import sympy as sp

from gudgeon.contract.clearance_info import ClearanceInfo, ContourInfo
from gudgeon.contract.kernel_source import (
    BodyInfo,
    Condition,
    DriveInfo,
    EventInfo,
    JointInfo,
    KernelSource,
    PartInfo,
    PointInfo,
    RowInfo,
    SeriesInfo,
    Slot,
    WrittenInfo,
)
from gudgeon.contract.ledger import Story
from gudgeon.contract.stored import base_units
from gudgeon.generator.equations.constraints import Row, rate_jumps
from gudgeon.generator.equations.model import Model, apart_rows
from gudgeon.generator.equations.notes import scene_notes
from gudgeon.generator.kernels.outputs import element_series, kept_joints
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import GROUND, Mechanism, PointRef, Quantity, quantities
from gudgeon.generator.reduction.driven_chains import Chain
from gudgeon.language.defined import is_defined_everywhere
from gudgeon.language.tree import Expr, names, to_json
from gudgeon.language.units import Dimension

UNTOLD = Story()


def describe(
    model: Model,
    *,
    files: Mapping[str, str] = MappingProxyType({}),
    main: str = "",
    units: tuple[int, ...] = (),
    pivots: tuple[str, ...] = (),
    start_pivots: tuple[str, ...] = (),
    operations: Mapping[str, int] = MappingProxyType({}),
    tree: tuple[str, ...] = (),
    closures: tuple[str, ...] = (),
    motion_pivots: tuple[str, ...] = (),
    formulation: str = "full",
    story: Story = UNTOLD,
    lanes: str = "",
    chain: Chain | None = None,
    stages: bool = False,
) -> KernelSource:
    """Everything that the runtime must know of a scene; the code's own facts are empty before it is emitted."""
    scene, mechanism = model.scene, model.scene.mechanism
    place = {symbol: k for k, symbol in enumerate(_prepared(model))}
    body_of = {name: k for k, name in enumerate(model.geometry.bodies)} | {GROUND: -1}
    row_of = {row.name: r for r, row in enumerate(model.rows)}
    unit_of = {row.name: row.unit for row in model.all_rows}
    start = mechanism.start
    return KernelSource(
        mechanism=mechanism.name,
        scene=scene.name,
        title=mechanism.title,
        sha256=mechanism.sha256,
        files=files,
        main=main,
        units=units,
        stages=stages,
        coordinates=tuple(model.symbols.info[q].meaning for q in model.q),
        bodies=tuple(BodyInfo(body.name, body.index) for body in model.bodies),
        points=_points(model, place, body_of),
        rows=tuple(map(_row, model.rows)),
        joints=_joints(model, body_of, row_of),
        drives=tuple(DriveInfo(name, row_of.get(name, -1), unit_of[name]) for name in mechanism.drives),
        clearances=_clearances(model, place, body_of),
        series=tuple(SeriesInfo(name, unit) for name, (_, unit) in element_series(model).items()),
        start_rows=tuple(map(_row, model.all_rows)),
        start_guess=tuple(start.guess),
        start_set=tuple(start.set),
        start_rates=tuple(start.rates),
        frictions=tuple(friction.name for friction in model.frictions),
        pivots=pivots,
        start_pivots=start_pivots,
        indeterminate=model.redundancy.indeterminate,
        rate_jumps=tuple(drive.name for drive in model.scene.mechanism.drives.values() if rate_jumps(drive)),
        slots=tuple(_slots(model)),
        derived=tuple(symbol.name.removesuffix("_") for symbol in model.slots.derived),
        conditions=_conditions(model),
        outputs={name: to_json(quantity.value) for name, quantity in mechanism.outputs.items()},
        simulate=_simulate(model),
        operations=dict(operations),
        notes=scene_notes(model),
        gravity=any(c != 0 for c in model.gravity),
        tree=tree,
        closures=closures,
        motion_pivots=motion_pivots,
        formulation=formulation,
        chain=chain.names if chain else (),
        chain_rows=tuple(row.name for row in chain.rows) if chain else (),
        events=tuple(EventInfo(event.name, event.action, event.direction) for event in model.events),
        lines=_lines(mechanism),
        massless=tuple(body.name for body in mechanism.bodies.values() if body.lacks),
        tables=tuple(mechanism.tables.items()),
        laws=tuple(sorted(mechanism.laws.items())),
        start_apart=tuple(model.all_rows[k].name for k, _, _ in apart_rows(model)),
        peaks=tuple(map(str, model.scene.peaks)),
        written=tuple(_written(model)),
        expressions=tuple(_info(one, one.written) for one in mechanism.expressions.values()),
        simulate_written=tuple(_simulate_written(model)),
        states=_states(model),
        story=story,
        lanes=lanes,
        parts=tuple(_parts(mechanism)),
        rigid=model.rigid,
        contours=tuple(_contours(model)),
    )


def _slots(model: Model) -> Iterator[Slot]:
    for e in model.slots.entries.values():
        exponents = _exponents(e.dimension)
        tree = "" if e.written is None or is_defined_everywhere(e.written) else json.dumps(to_json(e.written))
        yield Slot(e.address, base_units(exponents), e.default, e.follows, exponents, e.words, tree)


def _lines(mechanism: Mechanism) -> tuple[tuple[str, int], ...]:
    """Where joints and drives stand in the file."""
    joints = [(name, joint.where.line) for name, joint in mechanism.joints.items()]
    return (*joints, *((name, drive.where.line) for name, drive in mechanism.drives.items()))


def _parts(mechanism: Mechanism) -> Iterator[PartInfo]:
    """What the file joins, drives and loads, and where."""
    for joint in mechanism.joints.values():
        yield PartInfo("joints", joint.name, joint.kind, _ends(joint.first, joint.second), dict(joint.options))
    for drive in mechanism.drives.values():
        ends = _ends(*drive.points) or tuple(f"{body}.com" for body in (drive.body, drive.reference) if body)
        options = {"coordinate": drive.coordinate} if drive.kind == "coordinate" else {}
        yield PartInfo("drives", drive.name, drive.kind, ends, options)
    for force in mechanism.forces.values():
        yield PartInfo("forces", force.name, force.kind, _ends(*force.targets), dict(force.options))


def _ends(*points: PointRef) -> tuple[str, ...]:
    return tuple(f"{point.body}.{point.point}" for point in points)


def _states(model: Model) -> tuple[str, ...]:
    """As C has them in discrete, as many for each joint: "" is none."""
    return tuple(
        f"{c.name}.{c.states[k].name}" if k < len(c.states) else ""
        for c in model.clearances
        for k in range(model.law_states)
    )


def _joints(model: Model, body_of: Mapping[str, int], row_of: Mapping[str, int]) -> tuple[JointInfo, ...]:
    """Joints without play."""
    return tuple(
        JointInfo(
            joint.name,
            joint.kind,
            body_of[joint.first.body],
            body_of[joint.second.body],
            _ends(joint.first if joint_types()[joint.kind].reaction_at == "first" else joint.second)[0],
            tuple(row_of[row.name] for row in model.rows if row.owner == joint.name),
        )
        for joint in kept_joints(model)
    )


def _conditions(model: Model) -> tuple[Condition, ...]:
    """The file's, of numbers that this scene has; and of signs that its equations take for granted."""
    used = set(model.slots.entries)
    return tuple(
        Condition(c.address, c.relation, c.bound, c.message)
        for c in model.scene.mechanism.conditions
        if c.address in used and (not isinstance(c.bound, str) or used.issuperset(c.bound.split(" + ")))
    ) + tuple(
        Condition(address, relation, 0.0, "a direction along an axis turns round with load(overrides=...) only")
        for address, relation in model.slots.signs.items()
    )


def _written(model: Model) -> Iterator[WrittenInfo]:
    """Expressions of t and motion, and literal zeros, for what a run says of one that is no number."""
    mechanism, scene = model.scene.mechanism, model.scene
    found = [drive.value for drive in mechanism.drives.values()]
    for force in mechanism.forces.values():
        found += [*force.quantities.values(), *(x for pair in force.vectors.values() for x in pair)]
    found += [event.zero for event in scene.events.values()]
    for quantity in found:
        if any(name.path == "t" or "." in name.path for name in names(quantity.value)):
            yield _info(quantity)
    zeros = {one.address: one for one in quantities(scene) if one.is_zero and one.address not in model.slots.entries}
    yield from map(_info, zeros.values())


def _info(quantity: Quantity, tree: Expr | None = None) -> WrittenInfo:
    where, tree = quantity.where, tree or quantity.value
    return WrittenInfo(quantity.address, json.dumps(to_json(tree)), where.line, where.column)


def _prepared(model: Model) -> list[sp.Symbol]:
    """The members of `Parameters` in their order."""
    return [entry.symbol for entry in model.slots.entries.values()] + list(model.slots.derived)


def _row(row: Row) -> RowInfo:
    return RowInfo(row.name, row.owner, row.kind, row.unit)


def _index(place: Mapping[sp.Symbol, int], value: sp.Expr) -> tuple[int, int]:
    """(index into p, sign) of a number that is a symbol, its negative, or zero (−1)."""
    if value == 0:
        return -1, 1
    return (place[value], 1) if value in place else (place[-value], -1)


def _points(model: Model, place: Mapping[sp.Symbol, int], body_of: Mapping[str, int]) -> tuple[PointInfo, ...]:
    points = []
    for (body, name), (x, y) in model.geometry.local.items():
        (ix, sx), (iy, sy) = _index(place, x), _index(place, y)
        points.append(PointInfo(f"{body}.{name}", body_of[body], ix, iy, sx, sy))
    for name, vector in model.scene.mechanism.ground.items():
        x, y = model.geometry.ground_vector(vector)
        if all(value == 0 or value in place for value in (x, y)):
            points.append(PointInfo(f"{GROUND}.{name}", -1, _index(place, x)[0], _index(place, y)[0], 1, 1))
    return tuple(points)


def _clearances(model: Model, place: Mapping[sp.Symbol, int], body_of: Mapping[str, int]) -> tuple[ClearanceInfo, ...]:
    return tuple(
        ClearanceInfo(
            c.name,
            body_of[c.joint.first.body],
            body_of[c.joint.second.body],
            f"{c.joint.second.body}.{c.joint.second.point}",
            c.normal is not None,
            c.film is not None,
            place[c.pair.c],
            {name: place[value] for name, value in c.constants.items() if value in place},
        )
        for c in model.clearances
    )


def _contours(model: Model) -> Iterator[ContourInfo]:
    place = {entry.symbol: k for k, entry in enumerate(model.slots.entries.values())}
    for clearance in model.clearances:
        if clearance.contour:
            first = model.slots.tables[clearance.contour.table][0]
            yield ContourInfo(clearance.name, place[first], clearance.contour.count)


def _simulate(model: Model) -> dict[str, float]:
    from gudgeon.language.tree import evaluate

    defaults = {e.address: e.default for e in model.slots.entries.values()}
    return {
        name: float(evaluate(quantity.value, lambda path: defaults[f"parameters.{path}"]))
        for name, quantity in model.scene.simulate.items()
    }


def _simulate_written(model: Model) -> Iterator[WrittenInfo]:
    """What of the scene's own t_end, output and step follows parameters."""
    for quantity in model.scene.simulate.values():
        if next(names(quantity.value), None) is not None:
            yield _info(quantity)


def _exponents(dimension: Dimension) -> tuple[float, float, float]:
    """Exponents of m, kg, s: whole, or halves (N/m^1.5); a number with another one takes bare numbers only."""
    if not dimension.has_halves_at_most:
        return 0, 0, 0
    length, mass, time = (int(x) if x.denominator == 1 else float(x) for x in vars(dimension).values())
    return length, mass, time

"""Describes the contents of the emitted C for the runtime: a KernelSource."""

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
from gudgeon.contract.reduction_log import ReductionLog
from gudgeon.contract.stored import base_units
from gudgeon.generator.equations.constraints import Row, rate_jumps
from gudgeon.generator.equations.model import Model, eccentricity_rows
from gudgeon.generator.equations.notes import scene_notes
from gudgeon.generator.kernels.outputs import constraining_joints, element_series
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import GROUND, Mechanism, PointRef, Quantity, quantities
from gudgeon.generator.reduction.driven_chains import Chain
from gudgeon.language.defined import is_total_expression
from gudgeon.language.tree import Expr, names, to_json
from gudgeon.language.units import Dimension

EMPTY_STORY = ReductionLog()


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
    story: ReductionLog = EMPTY_STORY,
    lanes: str = "",
    chain: Chain | None = None,
    stages: bool = False,
) -> KernelSource:
    """Return everything that the runtime must know of a scene; facts about the code are empty before it is emitted."""
    scene, mechanism = model.scene, model.scene.mechanism
    place = {symbol: k for k, symbol in enumerate(_parameter_symbols(model))}
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
        points=_point_infos(model, place, body_of),
        rows=tuple(map(_row_info, model.rows)),
        joints=_joint_infos(model, body_of, row_of),
        drives=tuple(DriveInfo(name, row_of.get(name, -1), unit_of[name]) for name in mechanism.drives),
        clearances=_clearance_infos(model, place, body_of),
        series=tuple(SeriesInfo(name, unit) for name, (_, unit) in element_series(model).items()),
        start_rows=tuple(map(_row_info, model.all_rows)),
        start_guess=tuple(start.guess),
        start_set=tuple(start.set),
        start_rates=tuple(start.rates),
        frictions=tuple(friction.name for friction in model.frictions),
        pivots=pivots,
        start_pivots=start_pivots,
        indeterminate=model.redundancy.indeterminate,
        rate_jumps=tuple(drive.name for drive in model.scene.mechanism.drives.values() if rate_jumps(drive)),
        slots=tuple(_parameter_slots(model)),
        derived=tuple(symbol.name.removesuffix("_") for symbol in model.slots.derived),
        conditions=_conditions(model),
        outputs={name: to_json(quantity.value) for name, quantity in mechanism.outputs.items()},
        simulate=_default_settings(model),
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
        lines=_file_lines(mechanism),
        massless=tuple(body.name for body in mechanism.bodies.values() if body.lacks),
        tables=tuple(mechanism.tables.items()),
        laws=tuple(sorted(mechanism.laws.items())),
        start_apart=tuple(model.all_rows[k].name for k, _, _ in eccentricity_rows(model)),
        peaks=tuple(map(str, model.scene.peaks)),
        written=tuple(_written_expressions(model)),
        expressions=tuple(_written_info(one, one.written) for one in mechanism.expressions.values()),
        simulate_written=tuple(_written_settings(model)),
        states=_inner_states(model),
        story=story,
        lanes=lanes,
        parts=tuple(_connections(mechanism)),
        rigid=model.rigid,
        contours=tuple(_contour_infos(model)),
    )


def _parameter_slots(model: Model) -> Iterator[Slot]:
    """Yield the run-time parameters with address, unit, default and their expression if it may be undefined."""
    for e in model.slots.entries.values():
        exponents = _exponents(e.dimension)
        tree = "" if e.written is None or is_total_expression(e.written) else json.dumps(to_json(e.written))
        yield Slot(e.address, base_units(exponents), e.default, e.follows, exponents, e.words, tree)


def _file_lines(mechanism: Mechanism) -> tuple[tuple[str, int], ...]:
    """Return the lines of joints and drives in the file."""
    joints = [(name, joint.where.line) for name, joint in mechanism.joints.items()]
    return (*joints, *((name, drive.where.line) for name, drive in mechanism.drives.items()))


def _connections(mechanism: Mechanism) -> Iterator[PartInfo]:
    """Yield joints, drives and forces with the points that they connect."""
    for joint in mechanism.joints.values():
        yield PartInfo("joints", joint.name, joint.kind, _point_names(joint.first, joint.second), dict(joint.options))
    for drive in mechanism.drives.values():
        ends = _point_names(*drive.points) or tuple(f"{body}.com" for body in (drive.body, drive.reference) if body)
        options = {"coordinate": drive.coordinate} if drive.kind == "coordinate" else {}
        yield PartInfo("drives", drive.name, drive.kind, ends, options)
    for force in mechanism.forces.values():
        yield PartInfo("forces", force.name, force.kind, _point_names(*force.targets), dict(force.options))


def _point_names(*points: PointRef) -> tuple[str, ...]:
    """Return points as "body.point"."""
    return tuple(f"{point.body}.{point.point}" for point in points)


def _inner_states(model: Model) -> tuple[str, ...]:
    """Return the inner states of laws in the order of DiscreteState, equally many for each joint; "" for none."""
    return tuple(
        f"{c.name}.{c.states[k].name}" if k < len(c.states) else ""
        for c in model.clearances
        for k in range(model.law_states)
    )


def _joint_infos(model: Model, body_of: Mapping[str, int], row_of: Mapping[str, int]) -> tuple[JointInfo, ...]:
    """Return the joints without play, with their bodies and constraint equations."""
    return tuple(
        JointInfo(
            joint.name,
            joint.kind,
            body_of[joint.first.body],
            body_of[joint.second.body],
            _point_names(joint.first if joint_types()[joint.kind].reaction_at == "first" else joint.second)[0],
            tuple(row_of[row.name] for row in model.rows if row.owner == joint.name),
        )
        for joint in constraining_joints(model)
    )


def _conditions(model: Model) -> tuple[Condition, ...]:
    """Return the file's conditions on parameters of this scene, and those on signs that its equations assume."""
    used = set(model.slots.entries)
    return tuple(
        Condition(c.address, c.relation, c.bound, c.message)
        for c in model.scene.mechanism.conditions
        if c.address in used and (not isinstance(c.bound, str) or used.issuperset(c.bound.split(" + ")))
    ) + tuple(
        Condition(address, relation, 0.0, "a direction along an axis turns round with load(overrides=...) only")
        for address, relation in model.slots.signs.items()
    )


def _written_expressions(model: Model) -> Iterator[WrittenInfo]:
    """Yield expressions of t and motion and literal zeros, for messages about addresses that are not parameters."""
    mechanism, scene = model.scene.mechanism, model.scene
    found = [drive.value for drive in mechanism.drives.values()]
    for force in mechanism.forces.values():
        found += [*force.quantities.values(), *(x for pair in force.vectors.values() for x in pair)]
    found += [event.zero for event in scene.events.values()]
    for quantity in found:
        if any(name.path == "t" or "." in name.path for name in names(quantity.value)):
            yield _written_info(quantity)
    zeros = {one.address: one for one in quantities(scene) if one.is_zero and one.address not in model.slots.entries}
    yield from map(_written_info, zeros.values())


def _written_info(quantity: Quantity, tree: Expr | None = None) -> WrittenInfo:
    """Return an expression of the file with its location."""
    where, tree = quantity.where, tree or quantity.value
    return WrittenInfo(quantity.address, json.dumps(to_json(tree)), where.line, where.column)


def _parameter_symbols(model: Model) -> list[sp.Symbol]:
    """Return the members of `Parameters` in their order."""
    return [entry.symbol for entry in model.slots.entries.values()] + list(model.slots.derived)


def _row_info(row: Row) -> RowInfo:
    """Return the description of a constraint equation."""
    return RowInfo(row.name, row.owner, row.kind, row.unit)


def _parameter_index(place: Mapping[sp.Symbol, int], value: sp.Expr) -> tuple[int, int]:
    """Return (index in p, sign) of a value that is a parameter, its negative, or zero (index −1)."""
    if value == 0:
        return -1, 1
    return (place[value], 1) if value in place else (place[-value], -1)


def _point_infos(model: Model, place: Mapping[sp.Symbol, int], body_of: Mapping[str, int]) -> tuple[PointInfo, ...]:
    """Return the points of bodies and ground with the indices of their coordinates in p."""
    points = []
    for (body, name), (x, y) in model.geometry.local.items():
        (ix, sx), (iy, sy) = _parameter_index(place, x), _parameter_index(place, y)
        points.append(PointInfo(f"{body}.{name}", body_of[body], ix, iy, sx, sy))
    for name, vector in model.scene.mechanism.ground.items():
        x, y = model.geometry.ground_vector(vector)
        if all(value == 0 or value in place for value in (x, y)):
            points.append(
                PointInfo(f"{GROUND}.{name}", -1, _parameter_index(place, x)[0], _parameter_index(place, y)[0], 1, 1)
            )
    return tuple(points)


def _clearance_infos(
    model: Model, place: Mapping[sp.Symbol, int], body_of: Mapping[str, int]
) -> tuple[ClearanceInfo, ...]:
    """Return the joints with play, with their bodies, laws and constants."""
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


def _contour_infos(model: Model) -> Iterator[ContourInfo]:
    """Yield the contours of bearings with the index of their first depth in p."""
    place = {entry.symbol: k for k, entry in enumerate(model.slots.entries.values())}
    for clearance in model.clearances:
        if clearance.contour:
            first = model.slots.tables[clearance.contour.table][0]
            yield ContourInfo(clearance.name, place[first], clearance.contour.count)


def _default_settings(model: Model) -> dict[str, float]:
    """Return the default values of t_end, output and step."""
    from gudgeon.language.tree import evaluate

    defaults = {e.address: e.default for e in model.slots.entries.values()}
    return {
        name: float(evaluate(quantity.value, lambda path: defaults[f"parameters.{path}"]))
        for name, quantity in model.scene.simulate.items()
    }


def _written_settings(model: Model) -> Iterator[WrittenInfo]:
    """Yield the scene's t_end, output and step that depend on parameters."""
    for quantity in model.scene.simulate.values():
        if next(names(quantity.value), None) is not None:
            yield _written_info(quantity)


def _exponents(dimension: Dimension) -> tuple[float, float, float]:
    """Return the exponents of m, kg and s; zeros for exponents finer than halves, which accept bare numbers only."""
    if not dimension.has_halves_at_most:
        return 0, 0, 0
    length, mass, time = (int(x) if x.denominator == 1 else float(x) for x in vars(dimension).values())
    return length, mass, time

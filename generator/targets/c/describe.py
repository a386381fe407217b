"""Describes the model and the emitted C of a scene for the runtime: names, units, indices (a KernelSource)."""

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
    EquationInfo,
    EventInfo,
    ExpressionInfo,
    JointInfo,
    KernelSource,
    PartInfo,
    PointInfo,
    RuntimeParameter,
    SeriesInfo,
)
from gudgeon.contract.reduction_log import ReductionLog
from gudgeon.contract.stored import format_base_units
from gudgeon.generator.equations.constraints import Row, has_jumping_rate
from gudgeon.generator.equations.model import Model, find_eccentricity_rows
from gudgeon.generator.equations.notes import write_scene_notes
from gudgeon.generator.kernels.outputs import find_constraining_joints, list_force_element_series
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import GROUND, Mechanism, PointRef, Quantity, iterate_quantities
from gudgeon.generator.reduction.driven_loops import DrivenLoops
from gudgeon.language.tree import Expr, iterate_names, to_json
from gudgeon.language.undefined_parts import is_defined_everywhere
from gudgeon.language.units import Dimension

EMPTY_REDUCTION_LOG = ReductionLog()


def describe_scene(
    model: Model,
    *,
    files: Mapping[str, str] = MappingProxyType({}),
    main: str = "",
    units: tuple[int, ...] = (),
    pivots: tuple[str, ...] = (),
    start_pivots: tuple[str, ...] = (),
    operations: Mapping[str, int] = MappingProxyType({}),
    tree_coordinates: tuple[str, ...] = (),
    closures: tuple[str, ...] = (),
    integrated_pivots: tuple[str, ...] = (),
    formulation: str = "full",
    reduction_log: ReductionLog = EMPTY_REDUCTION_LOG,
    lane_file: str = "",
    driven_loops: DrivenLoops | None = None,
    has_complex_stages: bool = False,
) -> KernelSource:
    """Return the KernelSource of a scene: everything that the runtime must know of the model and of its emitted C.

    Facts about the code (files, pivots, lane_file, operations) are arguments. They stay empty while only the model is
    known.
    """
    scene, mechanism = model.scene, model.scene.mechanism
    parameter_index = {symbol: k for k, symbol in enumerate(_list_parameter_symbols(model))}
    body_index = {name: k for k, name in enumerate(model.geometry.bodies)} | {GROUND: -1}
    row_index = {row.name: r for r, row in enumerate(model.rows)}
    unit_of = {row.name: row.unit for row in model.all_rows}
    start_values = mechanism.start
    return KernelSource(
        mechanism=mechanism.name,
        scene=scene.name,
        title=mechanism.title,
        sha256=mechanism.sha256,
        files=files,
        main=main,
        compilation_units=units,
        has_stage_matrices=has_complex_stages,
        coordinates=tuple(model.symbols.info[q].meaning for q in model.q),
        bodies=tuple(BodyInfo(body.name, body.index) for body in model.bodies),
        points=_describe_points(model, parameter_index, body_index),
        equations=tuple(map(_describe_constraint, model.rows)),
        joints=_describe_joints(model, body_index, row_index),
        drives=tuple(DriveInfo(name, row_index.get(name, -1), unit_of[name]) for name in mechanism.drives),
        clearances=_describe_clearances(model, parameter_index, body_index),
        series=tuple(SeriesInfo(name, unit) for name, (_, unit) in list_force_element_series(model).items()),
        start_equations=tuple(map(_describe_constraint, model.all_rows)),
        start_guess=tuple(start_values.guess),
        start_set=tuple(start_values.set),
        start_rates=tuple(start_values.rates),
        frictions=tuple(friction.name for friction in model.frictions),
        pivots=pivots,
        start_pivots=start_pivots,
        indeterminate=model.redundancy.indeterminate,
        rate_jumps=tuple(drive.name for drive in model.scene.mechanism.drives.values() if has_jumping_rate(drive)),
        parameters=tuple(_describe_parameters(model)),
        derived=tuple(symbol.name.removesuffix("_") for symbol in model.parameter_table.derived),
        conditions=_select_conditions(model),
        outputs={name: to_json(quantity.value) for name, quantity in mechanism.outputs.items()},
        simulate=_evaluate_settings(model),
        operations=dict(operations),
        notes=write_scene_notes(model),
        gravity=any(c != 0 for c in model.gravity),
        tree_coordinates=tree_coordinates,
        closures=closures,
        integrated_pivots=integrated_pivots,
        formulation=formulation,
        driven_loop_coordinates=driven_loops.names if driven_loops else (),
        driven_loop_equations=tuple(row.name for row in driven_loops.rows) if driven_loops else (),
        events=tuple(EventInfo(event.name, event.action, event.direction) for event in model.events),
        lines=_find_file_lines(mechanism),
        massless_bodies=tuple(body.name for body in mechanism.bodies.values() if body.missing_keys),
        tables=tuple(mechanism.tables.items()),
        laws=tuple(sorted(mechanism.laws.items())),
        eccentricity_equations=tuple(model.all_rows[k].name for k, _, _ in find_eccentricity_rows(model)),
        peaks=tuple(map(str, model.scene.peaks)),
        file_expressions=tuple(_describe_file_expressions(model)),
        named_expressions=tuple(
            _describe_file_expression(expression, expression.source_tree)
            for expression in mechanism.expressions.values()
        ),
        simulate_expressions=tuple(_describe_settings(model)),
        internal_states=_name_internal_states(model),
        reduction_log=reduction_log,
        lane_file=lane_file,
        parts=tuple(_describe_connections(mechanism)),
        rigid_joints=model.rigid,
        contours=tuple(_describe_contours(model)),
    )


def _describe_parameters(model: Model) -> Iterator[RuntimeParameter]:
    """Yield the run-time parameters in the order of the struct: address, SI unit, default, dependency, choices.

    The expression of the default is added as JSON only if some parameter values leave it undefined; else it is "".
    """
    for entry in model.parameter_table.entries.values():
        exponents = _get_unit_exponents(entry.dimension)
        expression = (
            ""
            if entry.expression is None or is_defined_everywhere(entry.expression)
            else json.dumps(to_json(entry.expression))
        )
        yield RuntimeParameter(
            entry.address,
            format_base_units(exponents),
            entry.default,
            entry.depends_on_parameters,
            exponents,
            entry.choice_words,
            expression,
        )


def _find_file_lines(mechanism: Mechanism) -> tuple[tuple[str, int], ...]:
    """Return (name, line in the mechanism's file) of each joint, then of each drive."""
    joints = [(name, joint.where.line) for name, joint in mechanism.joints.items()]
    return (*joints, *((name, drive.where.line) for name, drive in mechanism.drives.items()))


def _describe_connections(mechanism: Mechanism) -> Iterator[PartInfo]:
    """Yield a PartInfo of each joint, drive and force: its kind, its options and the points that it connects.

    A drive without points has the centres of mass of its bodies instead; only a drive of a coordinate has an option.
    """
    for joint in mechanism.joints.values():
        yield PartInfo(
            "joints", joint.name, joint.kind, _format_point_names(joint.first, joint.second), dict(joint.options)
        )
    for drive in mechanism.drives.values():
        ends = _format_point_names(*drive.points) or tuple(
            f"{body}.com" for body in (drive.body, drive.reference) if body
        )
        options = {"coordinate": drive.coordinate} if drive.kind == "coordinate" else {}
        yield PartInfo("drives", drive.name, drive.kind, ends, options)
    for force in mechanism.forces.values():
        yield PartInfo("forces", force.name, force.kind, _format_point_names(*force.targets), dict(force.options))


def _format_point_names(*points: PointRef) -> tuple[str, ...]:
    """Return each point as the text "body.point"."""
    return tuple(f"{point.body}.{point.point}" for point in points)


def _name_internal_states(model: Model) -> tuple[str, ...]:
    """Return the names "JOINT.STATE" of the internal states of laws, such as "A.z", in the order of DiscreteState.

    Each joint with play has `model.law_states` entries; those that its law does not use are "".
    """
    return tuple(
        f"{c.name}.{c.states[k].name}" if k < len(c.states) else ""
        for c in model.clearances
        for k in range(model.law_states)
    )


def _describe_joints(
    model: Model, body_index: Mapping[str, int], row_index: Mapping[str, int]
) -> tuple[JointInfo, ...]:
    """Return a JointInfo of each joint without play.

    It contains the name, the kind, the indices of both bodies, the point of the reaction and the indices of its rows.
    """
    return tuple(
        JointInfo(
            joint.name,
            joint.kind,
            body_index[joint.first.body],
            body_index[joint.second.body],
            _format_point_names(joint.first if find_joint_types()[joint.kind].reaction_at == "first" else joint.second)[
                0
            ],
            tuple(row_index[row.name] for row in model.rows if row.owner == joint.name),
        )
        for joint in find_constraining_joints(model)
    )


def _select_conditions(model: Model) -> tuple[Condition, ...]:
    """Return the conditions on run-time parameters that apply to this scene: those of the file, then fixed signs.

    A condition of the file is left out if its parameter or its bound, such as "a + b", is not in the scene. A sign is
    fixed where the equations assume that a direction lies along an axis.
    """
    addresses = set(model.parameter_table.entries)
    return tuple(
        Condition(c.address, c.relation, c.bound, c.message)
        for c in model.scene.mechanism.conditions
        if c.address in addresses and (not isinstance(c.bound, str) or addresses.issuperset(c.bound.split(" + ")))
    ) + tuple(
        Condition(address, relation, 0.0, "only load(overrides=...) can reverse a direction along an axis")
        for address, relation in model.parameter_table.signs.items()
    )


def _describe_file_expressions(model: Model) -> Iterator[ExpressionInfo]:
    """Yield file expressions that are not run-time parameters, for error messages about their addresses.

    These are values of drives, forces and events that depend on time or motion, and numbers that are 0 in the file.
    """
    mechanism, scene = model.scene.mechanism, model.scene
    expressions = [drive.value for drive in mechanism.drives.values()]
    for force in mechanism.forces.values():
        expressions += [*force.quantities.values(), *(x for pair in force.vectors.values() for x in pair)]
    expressions += [event.zero for event in scene.events.values()]
    for quantity in expressions:
        if any(name.path == "t" or "." in name.path for name in iterate_names(quantity.value)):
            yield _describe_file_expression(quantity)
    zeros = {
        zero_quantity.address: zero_quantity
        for zero_quantity in iterate_quantities(scene)
        if zero_quantity.is_zero and zero_quantity.address not in model.parameter_table.entries
    }
    yield from map(_describe_file_expression, zeros.values())


def _describe_file_expression(quantity: Quantity, expression: Expr | None = None) -> ExpressionInfo:
    """Return a file expression as JSON with its address, line and column.

    `expression` replaces the quantity's value; None: the value itself.
    """
    location, expression = quantity.where, expression or quantity.value
    return ExpressionInfo(quantity.address, json.dumps(to_json(expression)), location.line, location.column)


def _list_parameter_symbols(model: Model) -> list[sp.Symbol]:
    """Return the symbols of the struct `Parameters` in order: entries of the file, then derived ones."""
    return [entry.symbol for entry in model.parameter_table.entries.values()] + list(model.parameter_table.derived)


def _describe_constraint(row: Row) -> EquationInfo:
    """Return name, owner, kind and unit of a constraint equation."""
    return EquationInfo(row.name, row.owner, row.kind, row.unit)


def _find_parameter_index(parameter_index: Mapping[sp.Symbol, int], value: sp.Expr) -> tuple[int, int]:
    """Return (index in p, sign) of a value that is a parameter or its negative; (−1, 1) for zero.

    Raises KeyError for any other expression.
    """
    if value == 0:
        return -1, 1
    return (parameter_index[value], 1) if value in parameter_index else (parameter_index[-value], -1)


def _describe_points(
    model: Model, parameter_index: Mapping[sp.Symbol, int], body_index: Mapping[str, int]
) -> tuple[PointInfo, ...]:
    """Return a PointInfo of each point of a body, then of the ground: body, indices and signs of x and y in p.

    A point of the ground is left out if one of its coordinates is neither zero nor a parameter.
    """
    points = []
    for (body, name), (x, y) in model.geometry.local_vectors.items():
        (ix, sx), (iy, sy) = _find_parameter_index(parameter_index, x), _find_parameter_index(parameter_index, y)
        points.append(PointInfo(f"{body}.{name}", body_index[body], ix, iy, sx, sy))
    for name, vector in model.scene.mechanism.ground.items():
        x, y = model.geometry.ground_vector(vector)
        if all(value == 0 or value in parameter_index for value in (x, y)):
            points.append(
                PointInfo(
                    f"{GROUND}.{name}",
                    -1,
                    _find_parameter_index(parameter_index, x)[0],
                    _find_parameter_index(parameter_index, y)[0],
                    1,
                    1,
                )
            )
    return tuple(points)


def _describe_clearances(
    model: Model, parameter_index: Mapping[sp.Symbol, int], body_index: Mapping[str, int]
) -> tuple[ClearanceInfo, ...]:
    """Return a ClearanceInfo of each joint with play.

    It contains both bodies, the point of the journal, and whether there are dry contact and film. The clearance and
    constants of laws that are parameters are given by their indices in p.
    """
    return tuple(
        ClearanceInfo(
            c.name,
            body_index[c.joint.first.body],
            body_index[c.joint.second.body],
            f"{c.joint.second.body}.{c.joint.second.point}",
            c.normal is not None,
            c.film is not None,
            parameter_index[c.pair.c],
            {name: parameter_index[value] for name, value in c.constants.items() if value in parameter_index},
        )
        for c in model.clearances
    )


def _describe_contours(model: Model) -> Iterator[ContourInfo]:
    """Yield a ContourInfo of each bearing with a contour: joint, index in p of the first depth, number of depths."""
    parameter_index = {entry.symbol: k for k, entry in enumerate(model.parameter_table.entries.values())}
    for clearance in model.clearances:
        if clearance.contour:
            first = model.parameter_table.tables[clearance.contour.table][0]
            yield ContourInfo(clearance.name, parameter_index[first], clearance.contour.count)


def _evaluate_settings(model: Model) -> dict[str, float]:
    """Return the settings under `simulate` of the scene by key, evaluated with the default parameters.

    Keys are t_end (s), output (samples) and step (s), as far as the file gives them.
    """
    from gudgeon.language.tree import evaluate

    defaults = {e.address: e.default for e in model.parameter_table.entries.values()}
    return {
        name: float(evaluate(quantity.value, lambda path: defaults[f"parameters.{path}"]))
        for name, quantity in model.scene.simulate.items()
    }


def _describe_settings(model: Model) -> Iterator[ExpressionInfo]:
    """Yield the scene's t_end, output and step whose expressions contain parameters; plain numbers are left out."""
    for quantity in model.scene.simulate.values():
        if next(iterate_names(quantity.value), None) is not None:
            yield _describe_file_expression(quantity)


def _get_unit_exponents(dimension: Dimension) -> tuple[float, float, float]:
    """Return the exponents of m, kg and s of a dimension, integers where they are whole.

    Zeros are returned for exponents finer than halves; such parameters accept only numbers without a unit.
    """
    if not dimension.has_halves_at_most:
        return 0, 0, 0
    length, mass, time = (int(x) if x.denominator == 1 else float(x) for x in vars(dimension).values())
    return length, mass, time

"""Describe a scene for simulator.js as JSON: names, units, parameters, methods, columns of arrays."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from gudgeon.assembly.large import MIN_SPARSE_COORDINATES
from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.assembly.rank import MAX_REDUNDANT_VIOLATION, list_redundant_equations
from gudgeon.assembly.start import assemble_start
from gudgeon.contract.kernel_source import KernelSource, PointInfo, RuntimeParameter
from gudgeon.contract.methods import EXPLICIT, KINEMATIC, TAYLOR
from gudgeon.integrators.adaptive import (
    MAX_FILM_SPEED_ERROR,
    RTOL,
    find_integrated_angles,
    select_first_method,
    select_stiff_method,
)
from gudgeon.integrators.kinematic import MAX_CORRECTION
from gudgeon.language.tree import to_json
from gudgeon.language.undefined_parts import DIVIDING
from gudgeon.model.baumgarte import has_baumgarte_terms
from gudgeon.model.choices import format_parameter
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.default_step import MAX_STEP_FRACTION, T_END, estimate_default_step
from gudgeon.model.file_expressions import list_possibly_undefined_expressions
from gudgeon.model.parameters import compute_parameter_values, find_gain_indices, list_conditions
from gudgeon.model.sizes import find_size_indices
from gudgeon.results.series import get_catalogue
from gudgeon.simulation.arguments import DEFAULT_OUTPUT
from gudgeon.simulation.hidden_jumps import needs_jump_search

DRIFT_STEP_FRACTION = 1.0 / 60.0  # step of rk4 at which constraints drift visibly, over the length of the run
HIDDEN_JUMPS_NOTE = "jumps that a drive's expression does not show are located in Python only"


def build_description(compiled: CompiledModel, drift_step: float | None = None) -> str:
    """Return the JSON of a scene for simulator.js, with the start at the file's values if a page cannot assemble it.

    drift_step (s): step of rk4 for scenes without degrees of freedom, at which constraints drift visibly. None: such a
    scene has no default step.
    """
    source = compiled.source
    values = {
        "mechanism": source.mechanism,
        "scene": source.scene,
        "title": source.title,
        "coordinates": source.coordinates,
        "bodies": [body.name for body in source.bodies],
        "slots": [_format_parameter_json(parameter) for parameter in source.parameters],
        "derived": source.derived,
        "conditions": [[item.address, item.relation, item.bound, item.message] for item in list_conditions(source)],
        "partials": [
            {
                "address": item.address,
                "tree": to_json(item.tree),
                "slot": item.parameter_index,
                "slots": dict(item.indices_by_name),
            }
            for item in list_possibly_undefined_expressions(source)
        ],
        "divides": sorted(DIVIDING),
        "gains": find_gain_indices(source),
        "methods": _list_page_methods(source),
        "begins": _select_first_page_method(source),
        "stiff": select_stiff_method(source, RTOL),
        "automatic": not source.is_explicit,
        "pivots": source.integrated_pivots,
        "start_pivots": source.start_pivots,
        "evaluation_pivots": source.pivots,
        "angles": find_integrated_angles(source).tolist(),
        "sizes": find_size_indices(source),
        "clearances": [[joint.name, joint.clearance] for joint in source.clearances],
        **({"contours": {item.joint: [item.first, item.count] for item in source.contours}} if source.contours else {}),
        "film": any(joint.film for joint in source.clearances),
        "rk4_has_gains": has_baumgarte_terms(source, "rk4"),
        "rtol": RTOL,
        "felt_by_films": MAX_FILM_SPEED_ERROR,
        "reach": MAX_CORRECTION,
        "memory": source.n_discrete_states,
        "events": [[event.name, event.action] for event in source.events],
        "widths": _count_array_columns(source),
        "unknown": _list_indeterminate_series(source),
        "left_out": _list_redundant_rows(compiled),
        "open": MAX_REDUNDANT_VIOLATION,
        "rows": [[row.owner, row.unit] for row in source.start_equations],
        "simulate": _collect_default_options(source),
        "step": _compute_default_step(compiled, drift_step),
        "start": _compute_stored_start(compiled),
        "columns": dict(_iterate_series_columns(source)),
        "points": {point.name: _format_point_json(source, point) for point in source.points},
        "outputs": {
            name: [series.unit, source.outputs[name]]
            for name, series in get_catalogue(source).items()
            if name in source.outputs
        },
        "notes": [HIDDEN_JUMPS_NOTE] if needs_jump_search(source) else [],
    }
    return json.dumps(values, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def _select_first_page_method(source: KernelSource) -> str:
    """Return the name of the method with which `auto` begins on a page, which has no Taylor series."""
    first_method = select_first_method(source)
    return EXPLICIT if first_method == TAYLOR else first_method


def _list_page_methods(source: KernelSource) -> list[str]:
    """Return the names of the methods of a page: those of Python, and rk4 for driven scenes without events."""
    is_driven = source.methods == (KINEMATIC,)
    return [*source.methods, *(["rk4"] if is_driven and not source.events else [])]


def _format_parameter_json(parameter: RuntimeParameter) -> dict[str, Any]:
    """Return a parameter as JSON: address, unit, default; names of choices, and whether it follows another one."""
    values: dict[str, Any] = {
        "address": parameter.address,
        "unit": parameter.unit,
        "default": format_parameter(parameter, parameter.default),
    }
    return (
        values
        | ({"words": parameter.words} if parameter.words else {})
        | ({"follows": True} if parameter.follows else {})
    )


def _count_array_columns(source: KernelSource) -> dict[str, int]:
    """Return the number of columns of each array that gudgeon_evaluate fills, in the order of its arguments."""
    return {
        "a": len(source.coordinates),
        "multipliers": len(source.equations),
        "reactions": 3 * (len(source.joints) + len(source.guides)),
        "torques": len(source.drives),
        "clearance": 10 * len(source.clearances),
        "series": len(source.series),
        "friction": 2 * len(source.frictions),
        "energy": 2,
        "power": 3,
        "drift": 2,
    }


def _list_indeterminate_series(source: KernelSource) -> list[str]:
    """Return the names of the series that redundancy leaves indeterminate; they are NaN in a page as in Python."""
    owners = set(source.indeterminate)
    joint_series = {f"{name}.{component}" for name in owners for component in ("Fx", "Fy", "M", "torque", "force")}
    multiplier_series = {f"lambda.{row.name}" for row in source.equations if row.owner in owners}
    return sorted((joint_series | multiplier_series) & {*get_catalogue(source)})


def _iterate_series_columns(source: KernelSource) -> Iterator[tuple[str, list[Any]]]:
    """Yield the name of each series that is a column of an array, and [unit, array, column]: ["m", "q", 4].

    simulator.js computes the other series.
    """
    widths = {"reactions": 3, "clearance": 10, "friction": 2}
    for name, series in get_catalogue(source).items():
        if series.stored is not None:
            yield name, [series.unit, *series.stored]
        elif series.evaluated is not None:
            field, index = series.evaluated
            row, column = index if len(index) == 2 else (0, index[0])
            yield name, [series.unit, field, row * widths.get(field, 0) + column]


def _format_point_json(source: KernelSource, point: PointInfo) -> list[int]:
    """Return a point: index of its body in q (-1: ground), indices of its coordinates in p (-1: zero), their signs."""
    body = source.bodies[point.body].index if point.body >= 0 else -1
    return [body, point.x, point.y, point.sign_x, point.sign_y]


def _list_redundant_rows(compiled: CompiledModel) -> list[list[Any]]:
    """Return redundant constraint equations of the start: index, owner, whether the residual is a length."""
    equations = compiled.source.start_equations
    return [[k, equations[k].owner, equations[k].unit == "m"] for k in list_redundant_equations(compiled)]


def _collect_default_options(source: KernelSource) -> dict[str, Any]:
    """Return the scene's t_end, output and step by name: numbers, or expression trees of parameters."""
    trees = {option.address.rpartition(".")[2]: json.loads(option.tree) for option in source.simulate_expressions}
    return {"t_end": T_END, "output": DEFAULT_OUTPUT, **source.simulate, **trees}


def _compute_default_step(compiled: CompiledModel, drift_step: float | None) -> list[float] | None:
    """Return the default step of rk4 as [fraction of the run's duration, upper bound in s at the file's values].

    drift_step: default step (s) with which the page integrates a scene that rk4 does not integrate in Python; the
    fraction is then DRIFT_STEP_FRACTION. None without such a step.
    """
    if "rk4" not in compiled.source.methods:
        return None if drift_step is None else [DRIFT_STEP_FRACTION, drift_step]
    return [MAX_STEP_FRACTION, estimate_default_step(compiled, compute_parameter_values(compiled, {})[0], math.inf)]


def _compute_stored_start(compiled: CompiledModel) -> dict[str, Any] | None:
    """Return q, q̇ and array sizes of the start at the file's values as JSON; None if C finds the start in a page.

    For mechanisms of MIN_SPARSE_COORDINATES or more coordinates it is always returned, with "large", since C cannot
    assemble them.
    """
    p = compute_parameter_values(compiled, {})[0]
    if compiled.n < MIN_SPARSE_COORDINATES:
        start_position = compiled.close_linkage(0.0, p, compute_mechanism_size(compiled, p))
        if start_position is not None and np.isfinite(start_position[1]).all():
            return None
    start, is_large = assemble_start(compiled, p), compiled.n >= MIN_SPARSE_COORDINATES
    array_sizes = [max(len(array), 1) for array in compiled.start_values(p)]
    start_json = {
        "q": start.q.tolist(),
        "v": start.v.tolist(),
        "rows": len(compiled.source.start_equations),
        "values": array_sizes,
    }
    return start_json | ({"large": True} if is_large else {})

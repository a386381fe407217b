"""Describe a scene for simulator.js as JSON: names, units, parameters, methods, columns of arrays."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from gudgeon.assembly.large import LARGE
from gudgeon.assembly.linkage import mechanism_size
from gudgeon.assembly.rank import OPEN, left_out
from gudgeon.assembly.start import assemble
from gudgeon.contract.kernel_source import KernelSource, PointInfo, Slot
from gudgeon.contract.methods import KINEMATIC
from gudgeon.integrators.adaptive import FELT_BY_FILMS, RTOL, first_method, integrated_angles, stiff_method
from gudgeon.integrators.kinematic import REACH
from gudgeon.language.defined import DIVIDING
from gudgeon.language.tree import to_json
from gudgeon.model.choices import specified
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.default_step import SMOOTH, T_END, default_step
from gudgeon.model.parameters import GAINS, conditions, prepare
from gudgeon.model.sizes import size_places
from gudgeon.model.written import partials
from gudgeon.results.series import catalogue
from gudgeon.simulation.arguments import DEFAULT_OUTPUT
from gudgeon.simulation.hidden_jumps import may_jump

SEEN = 1.0 / 60.0  # step of rk4 at which constraints drift visibly, over the length of the run
NOT_SEEN = "jumps of drives that their form does not show are looked for in Python only"


def description(compiled: CompiledModel, drift_step: float | None = None) -> str:
    """Return the JSON of a scene, with the start at the file's values if a page cannot find it.

    seen_step (s): step of rk4 for scenes without degrees of freedom, at which constraints drift visibly.
    """
    source = compiled.source
    parameter_indices = {parameter.address: k for k, parameter in enumerate(source.slots)}
    values = {
        "mechanism": source.mechanism,
        "scene": source.scene,
        "title": source.title,
        "coordinates": source.coordinates,
        "bodies": [body.name for body in source.bodies],
        "slots": [_parameter_json(parameter) for parameter in source.slots],
        "derived": source.derived,
        "conditions": [[item.address, item.relation, item.bound, item.message] for item in conditions(source)],
        "partials": [
            {"address": item.address, "tree": to_json(item.tree), "slot": item.slot, "slots": dict(item.slots)}
            for item in partials(source)
        ],
        "divides": sorted(DIVIDING),
        "gains": [parameter_indices[name] for name in GAINS if name in parameter_indices],
        "methods": _page_methods(source),
        "begins": first_method(source),
        "stiff": stiff_method(source, RTOL),
        "automatic": not source.explicit,
        "pivots": source.motion_pivots,
        "start_pivots": source.start_pivots,
        "evaluation_pivots": source.pivots,
        "angles": integrated_angles(source).tolist(),
        "sizes": size_places(source),
        "clearances": [[joint.name, joint.clearance] for joint in source.clearances],
        **({"contours": {item.joint: [item.first, item.count] for item in source.contours}} if source.contours else {}),
        "film": any(joint.film for joint in source.clearances),
        "beyond": compiled.beyond,
        "rtol": RTOL,
        "felt_by_films": FELT_BY_FILMS,
        "reach": REACH,
        "memory": source.n_memory,
        "events": [[event.name, event.action] for event in source.events],
        "widths": _array_widths(source),
        "unknown": _indeterminate_series(source),
        "left_out": _redundant_rows(compiled),
        "open": OPEN,
        "rows": [[row.owner, row.unit] for row in source.start_rows],
        "simulate": _default_options(source),
        "step": _default_step(compiled, drift_step),
        "start": _stored_start(compiled),
        "columns": dict(_series_columns(source)),
        "points": {point.name: _point_json(source, point) for point in source.points},
        "outputs": {
            name: [series.unit, source.outputs[name]]
            for name, series in catalogue(source).items()
            if name in source.outputs
        },
        "notes": [NOT_SEEN] if may_jump(source) else [],
    }
    return json.dumps(values, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def _page_methods(source: KernelSource) -> list[str]:
    """Return the names of the methods of a page: those of Python, and rk4 for driven scenes without events."""
    is_driven = source.methods == (KINEMATIC,)
    return [*source.methods, *(["rk4"] if is_driven and not source.events else [])]


def _parameter_json(parameter: Slot) -> dict[str, Any]:
    """Return a parameter as JSON: address, unit, default; names of choices, and whether it follows another one."""
    values: dict[str, Any] = {
        "address": parameter.address,
        "unit": parameter.unit,
        "default": specified(parameter, parameter.default),
    }
    return (
        values
        | ({"words": parameter.words} if parameter.words else {})
        | ({"follows": True} if parameter.follows else {})
    )


def _array_widths(source: KernelSource) -> dict[str, int]:
    """Return the number of columns of each array that gudgeon_evaluate fills, in the order of its arguments."""
    return {
        "a": len(source.coordinates),
        "multipliers": len(source.rows),
        "reactions": 3 * (len(source.joints) + len(source.guides)),
        "torques": len(source.drives),
        "clearance": 10 * len(source.clearances),
        "series": len(source.series),
        "friction": 2 * len(source.frictions),
        "energy": 2,
        "power": 3,
        "drift": 2,
    }


def _indeterminate_series(source: KernelSource) -> list[str]:
    """Return the names of the series that redundancy leaves indeterminate; they are NaN in a page as in Python."""
    owners = set(source.indeterminate)
    joint_series = {f"{name}.{component}" for name in owners for component in ("Fx", "Fy", "M", "torque", "force")}
    multiplier_series = {f"lambda.{row.name}" for row in source.rows if row.owner in owners}
    return sorted((joint_series | multiplier_series) & {*catalogue(source)})


def _series_columns(source: KernelSource) -> Iterator[tuple[str, list[Any]]]:
    """Yield the name of each series that is a column of an array, and [unit, array, column].

    simulator.js derives the other series.
    """
    widths = {"reactions": 3, "clearance": 10, "friction": 2}
    for name, series in catalogue(source).items():
        if series.stored is not None:
            yield name, [series.unit, *series.stored]
        elif series.evaluated is not None:
            part, index = series.evaluated
            row, column = index if len(index) == 2 else (0, index[0])
            yield name, [series.unit, part, row * widths.get(part, 0) + column]


def _point_json(source: KernelSource, point: PointInfo) -> list[int]:
    """Return a point: index of its body in q (-1: ground), indices of its coordinates in p (-1: zero), their signs."""
    body = source.bodies[point.body].index if point.body >= 0 else -1
    return [body, point.x, point.y, point.sign_x, point.sign_y]


def _redundant_rows(compiled: CompiledModel) -> list[list[Any]]:
    """Return redundant constraint equations of the start: index, owner, whether the residual is a length."""
    equations = compiled.source.start_rows
    return [[k, equations[k].owner, equations[k].unit == "m"] for k in left_out(compiled)]


def _default_options(source: KernelSource) -> dict[str, Any]:
    """Return the scene's t_end, output and step by name: numbers, or expression trees of parameters."""
    trees = {option.address.rpartition(".")[2]: json.loads(option.tree) for option in source.simulate_written}
    return {"t_end": T_END, "output": DEFAULT_OUTPUT, **source.simulate, **trees}


def _default_step(compiled: CompiledModel, drift_step: float | None) -> list[float] | None:
    """Return the default step of rk4: fraction of the run's length, and its bound (s) at the file's values.

    For a scene that rk4 does not integrate in Python, the bound is `drift_step`; None without it.
    """
    if "rk4" not in compiled.source.methods:
        return None if drift_step is None else [SEEN, drift_step]
    return [SMOOTH, default_step(compiled, prepare(compiled, {})[0], math.inf)]


def _stored_start(compiled: CompiledModel) -> dict[str, Any] | None:
    """Return q, q̇ and array sizes at the file's values as JSON if C alone does not find the start; otherwise None.

    Large mechanisms are always stored, since a page cannot solve them.
    """
    p = prepare(compiled, {})[0]
    if compiled.n < LARGE:
        closure = compiled.close(0.0, p, mechanism_size(compiled, p))
        if closure is not None and np.isfinite(closure[1]).all():
            return None
    start, is_large = assemble(compiled, p), compiled.n >= LARGE  # neither a page nor Python calls C then
    array_sizes = [max(len(array), 1) for array in compiled.start_values(p)]
    start_json = {
        "q": start.q.tolist(),
        "v": start.v.tolist(),
        "rows": len(compiled.source.start_rows),
        "values": array_sizes,
    }
    return start_json | ({"large": True} if is_large else {})

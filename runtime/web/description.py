"""What simulator.js must know of a scene beside its module: names, units, numbers, as JSON; no more than it reads."""

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
from gudgeon.integrators.adaptive import FELT_BY_FILMS, RTOL, begins_with, integrated_angles, stiff_of
from gudgeon.integrators.kinematic import REACH
from gudgeon.language.defined import DIVIDING
from gudgeon.language.tree import to_json
from gudgeon.model.choices import said
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.default_step import SMOOTH, T_END, default_step
from gudgeon.model.parameters import GAINS, conditions, prepare
from gudgeon.model.sizes import size_places
from gudgeon.model.written import partials
from gudgeon.results.series import catalogue
from gudgeon.simulation.arguments import DEFAULT_OUTPUT
from gudgeon.simulation.hidden_jumps import may_jump

SEEN = 1.0 / 60.0  # share of a run, of a step of rk4 at which rows are seen to drift
NOT_SEEN = "jumps of drives that their form does not show are looked for in Python only"


def description(compiled: CompiledModel, seen_step: float | None = None) -> str:
    """The JSON of a scene; with the start of the file's own numbers where a page cannot find it.

    seen_step (s): of rk4, where the drives leave no freedom and rows drift.
    """
    source = compiled.source
    place = {slot.address: k for k, slot in enumerate(source.slots)}
    found = {
        "mechanism": source.mechanism,
        "scene": source.scene,
        "title": source.title,
        "coordinates": source.coordinates,
        "bodies": [body.name for body in source.bodies],
        "slots": [_slot(slot) for slot in source.slots],
        "derived": source.derived,
        "conditions": [[one.address, one.relation, one.bound, one.message] for one in conditions(source)],
        "partials": [
            {"address": one.address, "tree": to_json(one.tree), "slot": one.slot, "slots": dict(one.slots)}
            for one in partials(source)
        ],
        "divides": sorted(DIVIDING),
        "gains": [place[name] for name in GAINS if name in place],
        "methods": _methods(source),
        "begins": begins_with(source),
        "stiff": stiff_of(source, RTOL),
        "automatic": not source.explicit,
        "pivots": source.motion_pivots,
        "start_pivots": source.start_pivots,
        "evaluation_pivots": source.pivots,
        "angles": integrated_angles(source).tolist(),
        "sizes": size_places(source),
        "clearances": [[joint.name, joint.clearance] for joint in source.clearances],
        **({"contours": {one.joint: [one.first, one.count] for one in source.contours}} if source.contours else {}),
        "film": any(joint.film for joint in source.clearances),
        "beyond": compiled.beyond,
        "rtol": RTOL,
        "felt_by_films": FELT_BY_FILMS,
        "reach": REACH,
        "memory": source.n_memory,
        "events": [[event.name, event.action] for event in source.events],
        "widths": _widths(source),
        "unknown": _unknown(source),
        "left_out": _left_out(compiled),
        "open": OPEN,
        "rows": [[row.owner, row.unit] for row in source.start_rows],
        "simulate": _simulate(source),
        "step": _step(compiled, seen_step),
        "start": _start(compiled),
        "columns": dict(_columns(source)),
        "points": {point.name: _point(source, point) for point in source.points},
        "outputs": {
            name: [series.unit, source.outputs[name]]
            for name, series in catalogue(source).items()
            if name in source.outputs
        },
        "notes": [NOT_SEEN] if may_jump(source) else [],
    }
    return json.dumps(found, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def _methods(source: KernelSource) -> list[str]:
    """Python's; where the drives leave no freedom, rows that are kept may be integrated too, events not looked for."""
    driven = source.methods == (KINEMATIC,)
    return [*source.methods, *(["rk4"] if driven and not source.events else [])]


def _slot(slot: Slot) -> dict[str, Any]:
    told: dict[str, Any] = {"address": slot.address, "unit": slot.unit, "default": said(slot, slot.default)}
    return told | ({"words": slot.words} if slot.words else {}) | ({"follows": True} if slot.follows else {})


def _widths(source: KernelSource) -> dict[str, int]:
    """Columns of what gudgeon_evaluate fills, in its order."""
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


def _unknown(source: KernelSource) -> list[str]:
    """Names that redundancy leaves open, NaN in a page as in Python."""
    owners = set(source.indeterminate)
    joints = {f"{name}.{last}" for name in owners for last in ("Fx", "Fy", "M", "torque", "force")}
    rows = {f"lambda.{row.name}" for row in source.rows if row.owner in owners}
    return sorted((joints | rows) & {*catalogue(source)})


def _columns(source: KernelSource) -> Iterator[tuple[str, list[Any]]]:
    """Series that are a column of an array: [unit, array, column]; others follow from these (simulator.js)."""
    widths = {"reactions": 3, "clearance": 10, "friction": 2}
    for name, series in catalogue(source).items():
        if series.stored is not None:
            yield name, [series.unit, *series.stored]
        elif series.evaluated is not None:
            part, index = series.evaluated
            row, column = index if len(index) == 2 else (0, index[0])
            yield name, [series.unit, part, row * widths.get(part, 0) + column]


def _point(source: KernelSource, point: PointInfo) -> list[int]:
    """Its body's place in q (−1: ground), places in p of both coordinates (−1: zero) and their signs."""
    body = source.bodies[point.body].index if point.body >= 0 else -1
    return [body, point.x, point.y, point.sign_x, point.sign_y]


def _left_out(compiled: CompiledModel) -> list[list[Any]]:
    """Rows that were redundant: number among the rows of the closed linkage, owner, whether it is a length."""
    rows = compiled.source.start_rows
    return [[k, rows[k].owner, rows[k].unit == "m"] for k in left_out(compiled)]


def _simulate(source: KernelSource) -> dict[str, Any]:
    """The scene's t_end, output and step: numbers, or trees of parameters."""
    trees = {one.address.rpartition(".")[2]: json.loads(one.tree) for one in source.simulate_written}
    return {"t_end": T_END, "output": DEFAULT_OUTPUT, **source.simulate, **trees}


def _step(compiled: CompiledModel, seen_step: float | None) -> list[float] | None:
    """Of rk4 where nobody says a step: share of a run's length, and its bound (s) with the file's numbers."""
    if "rk4" not in compiled.source.methods:
        return None if seen_step is None else [SEEN, seen_step]
    return [SMOOTH, default_step(compiled, prepare(compiled, {})[0], math.inf)]


def _start(compiled: CompiledModel) -> dict[str, Any] | None:
    """q and q̇ of the file's numbers where C alone does not find them; None where it does."""
    p = prepare(compiled, {})[0]
    if compiled.n < LARGE:
        closed = compiled.close(0.0, p, mechanism_size(compiled, p))
        if closed is not None and np.isfinite(closed[1]).all():
            return None
    found, large = assemble(compiled, p), compiled.n >= LARGE  # no page asks C then, as Python does not
    values = [max(len(array), 1) for array in compiled.start_values(p)]
    told = {"q": found.q.tolist(), "v": found.v.tolist(), "rows": len(compiled.source.start_rows), "values": values}
    return told | ({"large": True} if large else {})

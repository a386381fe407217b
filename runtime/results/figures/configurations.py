"""Compute configurations of a mechanism during a run for its drawings: at samples, or interpolated between samples."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.linkage import project_state
from gudgeon.drawing.configuration import Configuration
from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_number, raise_bad_value

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.results.results import Array, Result

N_PROJECTIONS = 4  # Newton corrections that project a position between samples onto Φ = 0
N_MOTION_CONFIGURATIONS = 24  # positions of a motion from which the box of a drawing is computed


def read_time(run: Result, t: Any) -> float:
    """Return a time of the run in s from a number or a text such as '0.2 s'.

    Raises BadValueError for None, another unit, or a time outside the run.
    """
    if t is None:
        raise_bad_value("t", t, "a time")
    if isinstance(t, str):
        from gudgeon.language.quantities import parse_quantity
        from gudgeon.model.parameters import insert_space_before_unit

        t = parse_quantity(insert_space_before_unit(t), "t", (0, 0, 1))
    time, begin, end = check_number(t, "t"), float(run.t[0]), float(run.t[-1])
    if not begin <= time <= end:
        raise BadValueError(
            f"t is {time:g} s: expected a time of the run, {begin:g} s to {end:g} s",
            hint="choose a time within the run",
        )
    return time


def compute_configuration(run: Result, t: float) -> Configuration:
    """Return the configuration of the mechanism at t (s), with its forces and torques.

    At a sample the stored state is used. Between samples the state is interpolated by a Hermite cubic and projected
    onto the constraints if the compiled scene is available. Loads are interpolated linearly.
    """
    k = int(np.clip(np.searchsorted(run.t, t), 1, max(len(run.t) - 1, 1)))
    neighbours = slice(max(k - 1, 0), k + 1)
    loads = {
        name: (
            float(np.interp(t, run.t[neighbours], x[neighbours])),
            float(np.interp(t, run.t[neighbours], y[neighbours])),
        )
        for name, x, y in _iterate_load_series(run)
    }
    if (sample_indices := np.flatnonzero(run.t == t)).size:
        q, v = run.q[sample_indices[0]], run.v[sample_indices[0]]
    else:
        q, v = _interpolate_cubic(run, k, t)
        if run.compiled is not None:  # between coarse samples the cubic violates the constraints
            for _ in range(N_PROJECTIONS):
                q, v = project_state(run.compiled, t, q, v, run.p)
    return Configuration(run.source, run.p, q, t, v, loads)


def select_configurations(run: Result, count: int = N_MOTION_CONFIGURATIONS) -> list[Configuration]:
    """Return up to `count` configurations of the mechanism at samples spread evenly over the run, the start first.

    Each has the coordinates, velocities, parameters and applied loads of its sample.
    """
    sample_indices = np.unique(np.linspace(0, len(run.t) - 1, count).round().astype(int))
    series = [*_iterate_load_series(run)]
    loads = [{name: (float(x[k]), float(y[k])) for name, x, y in series} for k in sample_indices]
    samples = zip(sample_indices, loads, strict=True)
    return [
        Configuration(run.source, run.p, run.q[k], float(run.t[k]), run.v[k], loads_there) for k, loads_there in samples
    ]


def _iterate_load_series(run: Result) -> Iterator[tuple[str, Any, Any]]:
    """Yield the name and two series (N,) of each force and torque element: Fx and Fy of a force; M and zeros of a
    torque.
    """
    for part in run.source.parts:
        if part.kind == "force":
            yield part.name, run[f"{part.name}.Fx"], run[f"{part.name}.Fy"]
        elif part.kind == "torque":
            yield part.name, run[f"{part.name}.M"], np.zeros(len(run.t))


def _interpolate_cubic(run: Result, k: int, t: float) -> tuple[Any, Any]:
    """Return q and q̇ at time t of the Hermite cubic through the positions and velocities of samples k − 1 and k."""
    h = float(run.t[k] - run.t[k - 1])
    s = (t - float(run.t[k - 1])) / h
    q_0, q_1, v_0, v_1 = run.q[k - 1], run.q[k], run.v[k - 1], run.v[k]
    q = (1 + 2 * s) * (1 - s) ** 2 * q_0 + s**2 * (3 - 2 * s) * q_1 + h * s * (1 - s) * ((1 - s) * v_0 - s * v_1)
    v = 6 * s * (1 - s) * (q_1 - q_0) / h + (1 - s) * (1 - 3 * s) * v_0 + s * (3 * s - 2) * v_1
    return q, v


def evaluate_loads(source: KernelSource, p: Array, q: Array, v: Array) -> dict[str, tuple[float, float]]:
    """Return the loads of the file's force and torque elements at t = 0, by name, for the state q, v (n,).

    p: values of the parameters, in the order of `source.parameters`. A force has its components in ground axes (N),
    also if the file gives them in the axes of a body; a torque has its value and 0 (N·m). Used for drawings without a
    run.
    """
    from gudgeon.language.tree import evaluate, from_json
    from gudgeon.model.file_expressions import make_value_function

    expressions = {entry.address: entry.tree for entry in source.file_expressions}
    parameters = {parameter.address: float(x) for parameter, x in zip(source.parameters, p, strict=False)}
    get_value = make_value_function(source, p, 0.0, q, v)

    def evaluate_address(address: str) -> float:
        """Return the value of an address of the file at the state, from its expression or its parameter; 0 if it has
        neither.
        """
        if address not in expressions:
            return parameters.get(address, 0.0)
        return float(evaluate(from_json(json.loads(expressions[address])), get_value))

    loads = {}
    for part in source.parts:
        if part.kind == "torque":
            loads[part.name] = evaluate_address(f"forces.{part.name}.value"), 0.0
        elif part.kind == "force":
            x, y = (evaluate_address(f"forces.{part.name}.value.{axis}") for axis in "xy")
            axes_body = part.options["axes"] == "body" and part.ends[0].partition(".")[0]
            angle = get_value(f"{axes_body}.theta") if axes_body in {body.name for body in source.bodies} else 0.0
            c, s = np.cos(angle), np.sin(angle)
            loads[part.name] = float(c * x - s * y), float(s * x + c * y)
    return loads

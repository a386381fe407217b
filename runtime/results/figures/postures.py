"""Compute the positions of a run for its drawings: a stored sample, or a point of the cubic between two samples."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.linkage import project
from gudgeon.drawing.posture import Posture
from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import number_of, refuse

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.results.results import Array, Result

CLOSING = 4  # times that a position between samples is led to Φ = 0
OF_MOTION = 24  # positions that stand for a motion where a drawing makes room for it


def time_of(run: Result, t: Any) -> float:
    """Return a time of the run (s) from a number or a text such as '0.2 s'. Raises BadValueError."""
    if t is None:
        refuse("t", t, "a time")
    if isinstance(t, str):
        from gudgeon.language.quantities import number_of_text
        from gudgeon.model.parameters import spaced

        t = number_of_text(spaced(t), "t", (0, 0, 1))
    at, begin, end = number_of(t, "t"), float(run.t[0]), float(run.t[-1])
    if not begin <= at <= end:
        raise BadValueError(f"t is {at:g} s: the run goes from {begin:g} s to {end:g} s", hint="take a time within it")
    return at


def posture_at(run: Result, t: float) -> Posture:
    """Return the posture at t (s), with loads interpolated linearly between samples."""
    k = int(np.clip(np.searchsorted(run.t, t), 1, max(len(run.t) - 1, 1)))
    near = slice(max(k - 1, 0), k + 1)
    loads = {
        name: (float(np.interp(t, run.t[near], x[near])), float(np.interp(t, run.t[near], y[near])))
        for name, x, y in _load_series(run)
    }
    if (at := np.flatnonzero(run.t == t)).size:
        q, v = run.q[at[0]], run.v[at[0]]
    else:
        q, v = _interpolate_cubic(run, k, t)
        if run.compiled is not None:  # between coarse samples the cubic takes joints apart
            for _ in range(CLOSING):
                q, v = project(run.compiled, t, q, v, run.p)
    return Posture(run.source, run.p, q, t, v, loads)


def postures_of(run: Result, count: int = OF_MOTION) -> list[Posture]:
    """Return up to `count` postures over the whole run, the start first."""
    places = np.unique(np.linspace(0, len(run.t) - 1, count).round().astype(int))
    series = [*_load_series(run)]
    loads = [{name: (float(x[k]), float(y[k])) for name, x, y in series} for k in places]
    at = zip(places, loads, strict=True)
    return [Posture(run.source, run.p, run.q[k], float(run.t[k]), run.v[k], own) for k, own in at]


def _load_series(run: Result) -> Iterator[tuple[str, Any, Any]]:
    """Yield the name and two series of each force and torque element: components of a force; a torque and 0."""
    for part in run.source.parts:
        if part.kind == "force":
            yield part.name, run[f"{part.name}.Fx"], run[f"{part.name}.Fy"]
        elif part.kind == "torque":
            yield part.name, run[f"{part.name}.M"], np.zeros(len(run.t))


def _interpolate_cubic(run: Result, k: int, t: float) -> tuple[Any, Any]:
    """Return q and q̇ of the cubic through samples k − 1 and k and their rates, at time t."""
    h = float(run.t[k] - run.t[k - 1])
    s = (t - float(run.t[k - 1])) / h
    q_0, q_1, v_0, v_1 = run.q[k - 1], run.q[k], run.v[k - 1], run.v[k]
    q = (1 + 2 * s) * (1 - s) ** 2 * q_0 + s**2 * (3 - 2 * s) * q_1 + h * s * (1 - s) * ((1 - s) * v_0 - s * v_1)
    v = 6 * s * (1 - s) * (q_1 - q_0) / h + (1 - s) * (1 - 3 * s) * v_0 + s * (3 * s - 2) * v_1
    return q, v


def loads_at(source: KernelSource, p: Array, q: Array, v: Array) -> dict[str, tuple[float, float]]:
    """Return forces (N, ground axes) and torques (N·m, 0) of the file at t = 0, by its expressions of q and v (n,)."""
    from gudgeon.results.results import bare

    none = np.zeros((1, 0))
    state = np.zeros((1, len(source.clearances)), np.int8)
    run = bare(source, None, p, np.zeros(1), q[None], v[None], none, none, state, frozenset())
    written = {one.address: one.tree for one in source.written}
    slots = {slot.address: float(x) for slot, x in zip(source.slots, p, strict=False)}

    def number(address: str) -> float:
        """Return the value of an address of the file at the posture, from its expression or its parameter."""
        from gudgeon.language.tree import evaluate, from_json

        if address not in written:
            return slots.get(address, 0.0)
        return float(np.ravel(evaluate(from_json(json.loads(written[address])), run.value_of))[0])

    loads = {}
    for part in source.parts:
        if part.kind == "torque":
            loads[part.name] = number(f"forces.{part.name}.value"), 0.0
        elif part.kind == "force":
            x, y = (number(f"forces.{part.name}.value.{axis}") for axis in "xy")
            turn = part.options["axes"] == "body" and part.ends[0].partition(".")[0]
            angle = float(run[f"{turn}.theta"][0]) if turn in {body.name for body in source.bodies} else 0.0
            c, s = np.cos(angle), np.sin(angle)
            loads[part.name] = float(c * x - s * y), float(s * x + c * y)
    return loads

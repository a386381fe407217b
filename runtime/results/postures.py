"""Positions of a run for its drawings: at a sample as it was stored, between two on the cubic through both, closed."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.drawing.posture import Posture
from gudgeon.errors import BadValueError
from gudgeon.integrators.projection import project
from gudgeon.language.wanted import number_of, refuse

if TYPE_CHECKING:
    from gudgeon.results.results import Result

CLOSING = 4  # times that a position between samples is led to Φ = 0
OF_MOTION = 24  # positions that stand for a motion where a drawing makes room for it


def time_of(run: Result, t: Any) -> float:
    """A time of the run (s), a number or '0.2 s'. Raises BadValueError."""
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
    """Where everything is at t (s); loads are those of the samples beside it, linear between."""
    k = int(np.clip(np.searchsorted(run.t, t), 1, max(len(run.t) - 1, 1)))
    loads = {name: (_between(run, k, t, x), _between(run, k, t, y)) for name, x, y in _loads(run)}
    if (at := np.flatnonzero(run.t == t)).size:
        q, v = run.q[at[0]], run.v[at[0]]
    else:
        q, v = _hermite(run, k, t)
        if run.compiled is not None:  # between coarse samples the cubic takes joints apart
            for _ in range(CLOSING):
                q, v = project(run.compiled, t, q, v, run.p)
    return Posture(run.source, run.p, q, t, v, loads)


def postures_of(run: Result, count: int = OF_MOTION) -> list[Posture]:
    """The start, and samples of the whole run."""
    places = np.unique(np.linspace(0, len(run.t) - 1, count).round().astype(int))
    return [Posture(run.source, run.p, run.q[k], float(run.t[k]), run.v[k]) for k in places]


def _loads(run: Result) -> Iterable[tuple[str, str, str]]:
    """Of forces and torques: name, and its series."""
    for part in run.source.parts:
        if part.kind == "force":
            yield part.name, f"{part.name}.Fx", f"{part.name}.Fy"
        elif part.kind == "torque":
            yield part.name, f"{part.name}.M", ""


def _between(run: Result, k: int, t: float, name: str) -> float:
    if not name:
        return 0.0
    near = slice(max(k - 1, 0), k + 1)
    return float(np.interp(t, run.t[near], run[name][near]))


def _hermite(run: Result, k: int, t: float) -> tuple[Any, Any]:
    """q and q̇ of the cubic through both neighbours and their rates."""
    h = float(run.t[k] - run.t[k - 1])
    s = (t - float(run.t[k - 1])) / h
    q_0, q_1, v_0, v_1 = run.q[k - 1], run.q[k], run.v[k - 1], run.v[k]
    q = (1 + 2 * s) * (1 - s) ** 2 * q_0 + s**2 * (3 - 2 * s) * q_1 + h * s * (1 - s) * ((1 - s) * v_0 - s * v_1)
    v = 6 * s * (1 - s) * (q_1 - q_0) / h + (1 - s) * (1 - 3 * s) * v_0 + s * (3 * s - 2) * v_1
    return q, v

"""Describe the shapes of bearings and guides: contour depths by joint and angle, and corners of a slider in its
guide.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, SingularError, UnknownNameError
from gudgeon.language.argument_checks import mapping, message
from gudgeon.model.arrays import as_c_array
from gudgeon.model.evaluation import CLEARANCE_COLUMNS

if TYPE_CHECKING:
    from gudgeon.model.compiled import CompiledModel

Array: TypeAlias = NDArray[np.float64]
Contours = Mapping[str, ArrayLike]
_WANTED = "{joint: depths (m) at equal angles}"  # expected form of the argument `contour`
Number = TypeVar("Number", float, Array)
_DEPTH, _RATE = (CLEARANCE_COLUMNS.index(name) for name in ("delta", "deltadot"))


def read_contours(source: KernelSource, contour: Any, runs: bool = False) -> dict[str, Array]:
    """Return the checked depths of the given joints, (n,) each as in the file; with `runs` also (N, n).

    Raises UnknownNameError for a joint without a contour, ArrayError for another number of depths, BadValueError for
    different numbers of runs.
    """
    known, found = {one.joint: one for one in source.contours}, dict[str, Array]()
    for joint, depths in mapping(contour, "contour", _WANTED).items():
        if joint not in known:
            hint = f"joints with a contour: {', '.join(known)}" if known else "contour: 128 in the play of a joint"
            raise UnknownNameError(f"contour: no contour at {message(joint)}", hint=hint)
        many = runs and np.ndim(depths) == 2
        shape = (None, known[joint].count) if many else (known[joint].count,)
        found[joint] = as_c_array(depths, f"contour[{joint!r}]", shape, finite=True)
    rows = {joint: len(own) for joint, own in found.items() if own.ndim == 2}
    if len(set(rows.values())) > 1 or 0 in rows.values():
        several = ", ".join(f"{joint} has {count}" for joint, count in rows.items())
        raise BadValueError(f"contour: rows of runs: {several}", hint="one contour, or one for every run")
    return found


def of_run(contours: Mapping[str, Array], i: int) -> dict[str, Array]:
    """Return the contours of run i."""
    return {joint: own[i] if own.ndim == 2 else own for joint, own in contours.items()}


def put(source: KernelSource, contour: Mapping[str, Array], given: Array, is_given: NDArray[Any]) -> None:
    """Write the depths (n,) by joint into values and mask (n_slots,). Raise BadValueError for depths given twice."""
    for one in source.contours:
        if one.joint in contour:
            own = slice(one.first, one.first + one.count)
            if is_given[own].any():
                raise BadValueError(f"the contour of {one.joint} is given twice: by addresses too", hint="give it once")
            given[own], is_given[own] = contour[one.joint], True


def contour_of(source: KernelSource, p: Array, joint: str) -> Array | None:
    """Return the depths (..., n) of a joint from p (..., n_slots + n_derived); None if its bearing is a circle."""
    for one in source.contours:
        if one.joint == joint:
            return np.asarray(p[..., one.first : one.first + one.count])
    return None


def widest(source: KernelSource, p: Array, joint: ClearanceInfo) -> float:
    """Return the radial clearance (m) of a joint with play, at the deepest point of its contour."""
    depths, c = contour_of(source, p, joint.name), float(p[joint.clearance])
    return c if depths is None else c + float(depths.max())


def depth_at(depths: ArrayLike, angle: ArrayLike, order: int = 0) -> Any:
    """Return the contour depth (m) or its first or second derivative at angles (rad) in the bearing's frame.

    The contour passes through depths (n,). As in engine/scene/contour.h, it consists of polynomials of degree five,
    with slopes and second derivatives at their ends by central differences.
    """
    w, count = np.asarray(depths, float), len(np.asarray(depths))
    turns = np.asarray(angle, float) / (2.0 * np.pi)
    x = count * (turns - np.floor(turns))
    k = np.minimum(x.astype(int), count - 1)
    a, b, c, d = (w[(k + shift) % count] for shift in (-1, 0, 1, 2))
    s, slope, bend, rest = x - k, 0.5 * (c - a), (a - b) + (c - b), 3.0 * (c - b) + (a - d)
    per_angle = count / (2.0 * np.pi)
    if order == 0:
        return b + s * (slope + s * (0.5 * bend + s * rest * (1.5 + s * (s - 2.5))))
    if order == 1:
        return per_angle * (slope + s * (bend + s * rest * (4.5 + s * (5.0 * s - 10.0))))
    return per_angle**2 * (bend + s * rest * (9.0 + s * (20.0 * s - 30.0)))


def narrowest_clearances(source: KernelSource, p: Array) -> Array:
    """Return the radial clearances (m), at the shallowest point of contours: (..., n_clearances) of p."""
    own = p[..., [joint.clearance for joint in source.clearances]]
    for one in source.contours:
        place = next(k for k, joint in enumerate(source.clearances) if joint.name == one.joint)
        own[..., place] += p[..., one.first : one.first + one.count].min(axis=-1)
    return own


def contour_parameters(source: KernelSource) -> frozenset[int]:
    """Return the indices of the parameters that are contour depths; a run sets them together."""
    return frozenset(k for one in source.contours for k in range(one.first, one.first + one.count))


def corner_gap(compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, number: int) -> tuple[float, float]:
    """Return penetration δ (m) and δ̇ (m/s) of the slider corner that is joint `number`, at q, v (n,).

    They are NaN where the equations of motion have no solution.
    """
    memory = np.zeros(compiled.n_memory)
    memory[: len(compiled.source.clearances)] = math.nan
    try:
        found = compiled.evaluate([t], [q], [v], [memory], p, parts=("clearance",)).clearance[0, number]
    except SingularError:
        return math.nan, math.nan
    return float(found[_DEPTH]), float(found[_RATE])


def corner_approach(source: KernelSource, p: Array, joint: ClearanceInfo, offset: Number, tilt: Number) -> Number:
    """Return how much nearer to its wall a corner is than in the middle of the guide, m; for one or many positions.

    With the slider's offset o across the guide (m), its tilt φ (rad), half length a, half height b and corner radius r
    it is ±(o ± (a − r) sin φ) + (b − r) (cos φ − 1).
    """
    _, a, b, radius = slider_of(source, p, joint)
    front, upper = (1.0 if word in joint.name.rpartition(".")[2] else -1.0 for word in ("front", "upper"))
    across = offset + front * (a - radius) * np.sin(tilt)
    return upper * across + (b - radius) * (np.cos(tilt) - 1.0)


def slider_of(source: KernelSource, p: Array, joint: ClearanceInfo) -> tuple[str, float, float, float]:
    """Return a guide's address, half length and half height of the slider, and the radius of its corners, m."""
    guide = source.slots[joint.clearance].address.rpartition(".")[0]
    a, b, radius = (
        float(p[source.place[address]]) if (address := f"{guide}.{what}") in source.place else 0.0
        for what in ("half_length", "half_height", "corner_radius")
    )
    return guide, a, b, radius

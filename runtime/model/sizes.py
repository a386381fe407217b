"""Measure the size of a mechanism, and find clearances too small for doubles at that size."""

from __future__ import annotations

import sys
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.model.compiled import Array
from gudgeon.model.contours import contour_of, narrowest_clearances

_LENGTH = (1, 0, 0)  # exponents of m, kg, s
SMALL_INERTIA = 1e-9  # of m size²: smaller moments of inertia are replaced by it in norms
LEAST_CLEARANCE = 64 * sys.float_info.epsilon  # of the size: from ten roundings down contacts are detected twice


def mechanism_sizes(source: KernelSource, p: Array) -> Array:
    """Return the size (m) of the mechanism: the largest distance of a point from its body's origin.

    The origin is the centre of mass, or that of the ground; lengths of joints count too. It scales lengths against
    angles, and so does not depend on the directions of axes. The shape is (...,) for p (..., n_slots + n_derived).
    """
    x, y, has_y = _size_columns(source)
    if not len(x):
        return np.ones(p.shape[:-1])
    size = np.sqrt(p[..., x] ** 2 + (p[..., y] * has_y) ** 2).max(axis=-1)  # as in JavaScript and C, to the bit
    return np.where(size > 0.0, size, 1.0)


def metric(source: KernelSource, p: Array, mass: Array) -> Array:
    """Return the norm's weights of coordinates, (n,): the diagonal `mass` of M, with a lower limit for inertias.

    A point mass on a link has no moment of inertia. Its motion is regular, but M alone is not a norm for it.
    """
    measure = np.array(mass)
    least = SMALL_INERTIA * measure[1::3] * mechanism_sizes(source, p) ** 2
    measure[2::3] = np.maximum(measure[2::3], least)
    return measure


def size_places(source: KernelSource) -> list[tuple[int, int]]:
    """Return the indices into p of x and y of the points, and of joint lengths as x; −1 stands for 0."""
    pairs = [(max(point.x, point.y), min(point.x, point.y)) for point in source.points]
    lengths = [slot.dimension == _LENGTH and slot.address.startswith("joints.") for slot in source.slots]
    pairs += [(k, -1) for k, is_length in enumerate(lengths) if is_length]
    return [pair for pair in pairs if pair[0] >= 0]


def _size_columns(source: KernelSource) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
    """Return arrays of these indices, with x for a missing y, and 1 or 0 for whether there is a y."""
    kept: dict[str, tuple[NDArray[np.intp], NDArray[np.intp], Array]] = source.__dict__  # as cached properties
    if "size_columns" not in kept:
        x, y = np.array(size_places(source), dtype=np.intp).reshape(-1, 2).T.copy()
        kept["size_columns"] = x, np.where(y < 0, x, y), np.where(y < 0, 0.0, 1.0)
    return kept["size_columns"]


def unresolved_clearances(source: KernelSource, p: Array) -> Array:
    """Return a mask (..., n_clearances) of clearances too small for doubles, from p (..., n_slots + n_derived).

    The eccentricity is a difference of coordinates, each of which is rounded to 2^-52 of its value.
    """
    return np.asarray(narrowest_clearances(source, p) < LEAST_CLEARANCE * mechanism_sizes(source, p)[..., np.newaxis])


def unresolved_clearance_message(source: KernelSource, p: Array) -> str:
    """Return a message on the first clearance too small for doubles in one run; "" if there is none."""
    for joint, is_far in zip(source.clearances, unresolved_clearances(source, p).tolist(), strict=True):
        if is_far:
            size, own = float(mechanism_sizes(source, p)), contour_of(source, p, joint.name)
            c = float(p[joint.clearance]) + (0.0 if own is None else float(own.min()))
            where = " at its contour" * (own is not None)
            return (
                f"the clearance of {joint.name} is {c:g} m{where}, below what doubles tell apart at the"
                f" mechanism's size ({size:.3g} m)\n  expected {LEAST_CLEARANCE * size:.2g} m at least; leave the joint"
                " out of the scene's play for none"
            )
    return ""


def zero_inertia_message(value: Mapping[str, float], derived: str) -> str:
    """Return a message on a derived value that is not finite because a moment of inertia is 0; else ""."""
    zero = next((a for a in value if a.startswith("bodies.") and a.endswith(".inertia") and value[a] == 0.0), "")
    hint = "expected > 0, or 0 in the file, from which equations without it are derived"
    return f"{zero} is 0, by which the equations divide ({derived})\n  {hint}" if zero else ""

"""Measure the size of a mechanism, and find clearances that double precision cannot resolve at that size."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array
from gudgeon.model.contours import compute_min_clearances, find_contour_parameters, get_contour_depths

_LENGTH = (1, 0, 0)  # exponents of m, kg, s
MIN_RELATIVE_INERTIA = 1e-9  # of m size²: smaller moments of inertia are replaced by it in norms
# of the size: with clearances below ten roundings, contacts are detected twice
MIN_RELATIVE_CLEARANCE = 64 * sys.float_info.epsilon


def compute_mechanism_sizes(source: KernelSource, p: Array) -> Array:
    """Return the size (m) of the mechanism: the largest distance of a point from its body's origin; 1 if it is 0.

    The origin is the centre of mass, or that of the ground; lengths of joints count too. The size scales lengths
    against angles, and does not depend on the directions of axes. Its shape is (...,) for p (..., n_parameters +
    n_derived).
    """
    x, y, has_y = _get_size_indices(source)
    if not len(x):
        return np.ones(p.shape[:-1])
    first, second = p.take(x, axis=-1), p.take(y, axis=-1) * has_y
    with np.errstate(over="ignore", invalid="ignore"):  # runs with such values fail later, one by one
        size = np.sqrt(first * first + second * second).max(axis=-1)  # as in JavaScript and C, to the bit
    return np.where(size > 0.0, size, 1.0)


def compute_size_of_run(index_pairs: Sequence[tuple[int, int]], values: Sequence[float]) -> float:
    """Return the size (m) of the mechanism for one run, bit for bit as `compute_mechanism_sizes`, but with floats.

    index_pairs: those of `find_size_indices`; values: parameter values (n_parameters + n_derived,).
    """
    largest = 0.0 if index_pairs else 1.0
    for i, j in index_pairs:
        square = values[i] * values[i] + (values[j] * values[j] if j >= 0 else 0.0)
        if square > largest:
            largest = square
    return math.sqrt(largest) or 1.0


@cache_by_values
def find_length_indices(source: KernelSource) -> NDArray[np.intp]:
    """Return the indices into p of all values on which the size and the clearances depend, contours among them."""
    clearances = {joint.clearance for joint in source.clearances}
    lengths = {k for pair in find_size_indices(source) for k in pair if k >= 0}
    return np.array(sorted(clearances | lengths | find_contour_parameters(source)), dtype=np.intp)


@cache_by_values
def find_size_parameters(source: KernelSource) -> NDArray[np.intp]:
    """Return the indices into p of all values on which the size of the mechanism depends."""
    return np.array(sorted({k for pair in find_size_indices(source) for k in pair if k >= 0}), dtype=np.intp)


def select_lengths(source: KernelSource, p: Array) -> Array:
    """Return the values of one run on which the size and the clearances depend, for caches with them as keys."""
    return p.take(find_length_indices(source))


def scatter_lengths(source: KernelSource, lengths: Array) -> Array:
    """Return parameter values (n_p,) from the result of `select_lengths`; all others are NaN."""
    p = np.full(len(source.parameters) + len(source.derived), np.nan)
    p[find_length_indices(source)] = lengths
    return p


def compute_size(source: KernelSource, p: Array) -> float:
    """Return the size (m) of the mechanism with the parameter values p (n_parameters + n_derived,) of one run."""
    return _measure_lengths(source, select_lengths(source, p))[0]


def has_unresolved_clearance(source: KernelSource, p: Array) -> bool:
    """Return whether a clearance of one run is below MIN_RELATIVE_CLEARANCE of the mechanism's size."""
    return _measure_lengths(source, select_lengths(source, p))[1]


@cache_by_values
def _measure_lengths(source: KernelSource, lengths: Array) -> tuple[float, bool]:
    """Return the size (m), and whether a clearance is below MIN_RELATIVE_CLEARANCE of it; cached for equal lengths."""
    p = scatter_lengths(source, lengths)
    size = compute_size_of_run(find_size_indices(source), p.tolist())
    return size, any(c < MIN_RELATIVE_CLEARANCE * size for c in compute_min_clearances(source, p).tolist())


def compute_norm_weights(source: KernelSource, p: Array, mass: Array) -> Array:
    """Return the norm's weights of coordinates, (n,): the diagonal `mass` of M, with a lower limit for inertias.

    The limit of each body is MIN_RELATIVE_INERTIA m S², with its mass m and the mechanism's size S. A point mass on a
    link has no moment of inertia. Its motion is regular, but M alone is not a norm for it. `mass` is not changed.
    """
    weights = np.array(mass)
    lower_limit = MIN_RELATIVE_INERTIA * weights[1::3] * compute_size(source, p) ** 2
    weights[2::3] = np.maximum(weights[2::3], lower_limit)
    return weights


@cache_by_values
def find_size_indices(source: KernelSource) -> list[tuple[int, int]]:
    """Return a pair (larger index, smaller index) into p for the coordinates of each point and for each joint length.

    Indices of x and y are in this order, whichever is larger. −1 is the index of a coordinate that is 0; joint lengths
    are (index, −1). Points without any coordinate in p are left out.
    """
    index_pairs = [(max(point.x, point.y), min(point.x, point.y)) for point in source.points]
    lengths = [
        parameter.dimension == _LENGTH and parameter.address.startswith("joints.") for parameter in source.parameters
    ]
    index_pairs += [(k, -1) for k, is_length in enumerate(lengths) if is_length]
    return [pair for pair in index_pairs if pair[0] >= 0]


def _get_size_indices(source: KernelSource) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
    """Return arrays of the indices of `find_size_indices`, with x for a missing y, and 1 or 0 for whether there is a y.

    They are cached in the source.
    """
    cache: dict[str, tuple[NDArray[np.intp], NDArray[np.intp], Array]] = source.__dict__  # as cached properties
    if "size_columns" not in cache:
        x, y = np.array(find_size_indices(source), dtype=np.intp).reshape(-1, 2).T.copy()
        cache["size_columns"] = x, np.where(y < 0, x, y), np.where(y < 0, 0.0, 1.0)
    return cache["size_columns"]


def find_unresolved_clearances(source: KernelSource, p: Array) -> Array:
    """Return a mask (..., n_clearances) of clearances too small for doubles, from p (..., n_parameters + n_derived).

    The eccentricity is a difference of coordinates, each of which is rounded to 2^-52 of its value.
    """
    if not source.clearances:
        return np.zeros((*p.shape[:-1], 0), bool)
    return np.asarray(
        compute_min_clearances(source, p) < MIN_RELATIVE_CLEARANCE * compute_mechanism_sizes(source, p)[..., np.newaxis]
    )


def describe_unresolved_clearance(source: KernelSource, p: Array) -> str:
    """Return a message on the first clearance too small for doubles in one run; "" if there is none. p: (n_p,).

    The limit is MIN_RELATIVE_CLEARANCE of the mechanism's size. With a contour, the smallest depth is added.
    """
    for joint, is_unresolved in zip(source.clearances, find_unresolved_clearances(source, p).tolist(), strict=True):
        if is_unresolved:
            size, depths = compute_size(source, p), get_contour_depths(source, p, joint.name)
            c = float(p[joint.clearance]) + (0.0 if depths is None else float(depths.min()))
            phrase = " at its contour" * (depths is not None)
            return (
                f"the clearance of {joint.name} is {c:g} m{phrase}, below the rounding of doubles at the"
                f" mechanism's size ({size:.3g} m)\n  expected {MIN_RELATIVE_CLEARANCE * size:.2g} m at "
                "least; for no clearance, leave the joint out of the scene's play"
            )
    return ""


def describe_zero_inertia(values: Mapping[str, float], derived_name: str) -> str:
    """Return a message on the derived value named `derived_name`, which is not finite because a moment of inertia is 0.

    "" if no inertia is 0. values: parameter values by address.
    """
    address = next((a for a in values if a.startswith("bodies.") and a.endswith(".inertia") and values[a] == 0.0), "")
    hint = "expected > 0, or 0 in the file, from which equations without it are derived"
    return f"{address} is 0, by which the equations divide ({derived_name})\n  {hint}" if address else ""

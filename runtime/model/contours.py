"""Describe bearings that are not circular, and the corners of a slider in its guide."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, SingularError, UnknownNameError
from gudgeon.language.argument_checks import check_mapping, shorten_value
from gudgeon.model.arrays import as_c_array
from gudgeon.model.evaluation import CLEARANCE_COLUMNS

if TYPE_CHECKING:
    from gudgeon.model.compiled import CompiledModel

Array: TypeAlias = NDArray[np.float64]
Contours = Mapping[str, ArrayLike]
_EXPECTED_FORM = "{joint: depths (m) at equal angles}"  # expected form of the argument `contour`
Number = TypeVar("Number", float, Array)
_DEPTH, _RATE = (CLEARANCE_COLUMNS.index(name) for name in ("delta", "deltadot"))


def read_contours(source: KernelSource, contour: Any, allows_runs: bool = False) -> dict[str, Array]:
    """Return the checked argument `contour`, {joint: depths (m)}, as arrays (n,); {} for None.

    n is the number of depths in the file. With `allows_runs`, depths may also be (N, n) for N runs. Raises
    UnknownNameError for a joint without a contour, ArrayError for another number of depths or values that are not
    finite, BadValueError for different numbers of runs.
    """
    if contour is None:
        return {}
    contours_by_joint, depths_by_joint = {info.joint: info for info in source.contours}, dict[str, Array]()
    for joint, depths in check_mapping(contour, "contour", _EXPECTED_FORM).items():
        if joint not in contours_by_joint:
            hint = (
                f"joints with a contour: {', '.join(contours_by_joint)}"
                if contours_by_joint
                else "contour: 128 in the play of a joint"
            )
            raise UnknownNameError(f"contour: no contour at {shorten_value(joint)}", hint=hint)
        is_for_each_run = allows_runs and np.ndim(depths) == 2
        shape = (None, contours_by_joint[joint].count) if is_for_each_run else (contours_by_joint[joint].count,)
        depths_by_joint[joint] = as_c_array(depths, f"contour[{joint!r}]", shape, require_finite=True)
    n_runs_by_joint = {
        joint: len(depths_of_joint) for joint, depths_of_joint in depths_by_joint.items() if depths_of_joint.ndim == 2
    }
    if len(set(n_runs_by_joint.values())) > 1 or 0 in n_runs_by_joint.values():
        text = ", ".join(f"{joint} has {count}" for joint, count in n_runs_by_joint.items())
        raise BadValueError(f"contour: rows of runs: {text}", hint="one contour, or one for every run")
    return depths_by_joint


def select_contours_of_run(contours: Mapping[str, Array], i: int) -> dict[str, Array]:
    """Return the contours (n,) of run i by joint; a contour for all runs is returned as it is."""
    return {joint: depths[i] if depths.ndim == 2 else depths for joint, depths in contours.items()}


def set_contours(source: KernelSource, contour: Mapping[str, Array], values: Array, is_given: NDArray[Any]) -> None:
    """Write the depths (n,) by joint into values and mask (n_parameters,), which are changed.

    Raises BadValueError for depths given twice.
    """
    for info in source.contours:
        if info.joint in contour:
            contour_slice = slice(info.first, info.first + info.count)
            if is_given[contour_slice].any():
                raise BadValueError(
                    f"the contour of {info.joint} is given twice: in contour and by addresses", hint="give it once"
                )
            values[contour_slice], is_given[contour_slice] = contour[info.joint], True


def get_contour_depths(source: KernelSource, p: Array, joint: str) -> Array | None:
    """Return the depths (..., n) of a joint from p (..., n_parameters + n_derived); None if its bearing is a circle."""
    for info in source.contours:
        if info.joint == joint:
            return np.asarray(p[..., info.first : info.first + info.count])
    return None


def compute_max_clearance(source: KernelSource, p: Array, joint: ClearanceInfo) -> float:
    """Return the radial clearance (m) of a joint with play, at the deepest point of its contour.

    p: (n_parameters + n_derived,).
    """
    depths, c = get_contour_depths(source, p, joint.name), float(p[joint.clearance])
    return c if depths is None else c + float(depths.max())


def interpolate_depth(depths: ArrayLike, angle: ArrayLike, order: int = 0) -> Any:
    """Return the contour depth (m), or its derivative of order 1 or 2, at angles (rad) in the bearing's frame.

    The contour passes through depths (n,) at equal angles from 0 on. As in engine/scene/contour.h, it consists of
    polynomials of degree five, with slopes and second derivatives at their ends by central differences. The shape is
    that of `angle`.
    """
    w, n_depths = np.asarray(depths, float), len(np.asarray(depths))
    turns = np.asarray(angle, float) / (2.0 * np.pi)
    x = n_depths * (turns - np.floor(turns))
    k = np.minimum(x.astype(int), n_depths - 1)
    a, b, c, d = (w[(k + shift) % n_depths] for shift in (-1, 0, 1, 2))
    s, slope, curvature, difference = x - k, 0.5 * (c - a), (a - b) + (c - b), 3.0 * (c - b) + (a - d)
    per_angle = n_depths / (2.0 * np.pi)
    if order == 0:
        return b + s * (slope + s * (0.5 * curvature + s * difference * (1.5 + s * (s - 2.5))))
    if order == 1:
        return per_angle * (slope + s * (curvature + s * difference * (4.5 + s * (5.0 * s - 10.0))))
    return per_angle**2 * (curvature + s * difference * (9.0 + s * (20.0 * s - 30.0)))


def compute_min_clearances(source: KernelSource, p: Array) -> Array:
    """Return the radial clearance (m) of each joint with play, at the shallowest point of its contour.

    p: (..., n_parameters + n_derived); the result has the shape (..., n_clearances).
    """
    clearances = p[..., [joint.clearance for joint in source.clearances]]
    for info in source.contours:
        index = next(k for k, joint in enumerate(source.clearances) if joint.name == info.joint)
        clearances[..., index] += p[..., info.first : info.first + info.count].min(axis=-1)
    return clearances


def find_contour_parameters(source: KernelSource) -> frozenset[int]:
    """Return the indices of the parameters that are contour depths; a run sets them together."""
    return frozenset(k for info in source.contours for k in range(info.first, info.first + info.count))


def compute_corner_penetration(
    compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, clearance_index: int
) -> tuple[float, float]:
    """Return penetration δ (m) and δ̇ (m/s) of the slider corner that is joint `clearance_index`, at q, v (n,).

    All contacts are open there. Both are NaN where the equations of motion have no solution.
    """
    discrete_states = np.zeros(compiled.n_discrete_states)
    discrete_states[: len(compiled.source.clearances)] = math.nan
    try:
        columns = compiled.evaluate([t], [q], [v], [discrete_states], p, field_names=("clearance",)).clearance[
            0, clearance_index
        ]
    except SingularError:
        return math.nan, math.nan
    return float(columns[_DEPTH]), float(columns[_RATE])


def compute_corner_approach(
    source: KernelSource, p: Array, joint: ClearanceInfo, offset: Number, tilt: Number
) -> Number:
    """Return the approach (m) of a slider's corner to its wall, relative to the centred slider; floats or arrays.

    With the slider's offset o across the guide (m), its tilt φ (rad), half length a, half height b and corner radius r
    it is ±(o ± (a − r) sin φ) + (b − r) (cos φ − 1). The signs follow from the corner's name: upper, front.
    """
    _, a, b, radius = find_slider_dimensions(source, p, joint)
    front_sign, upper_sign = (1.0 if word in joint.name.rpartition(".")[2] else -1.0 for word in ("front", "upper"))
    offset_of_corner = offset + front_sign * (a - radius) * np.sin(tilt)
    return upper_sign * offset_of_corner + (b - radius) * (np.cos(tilt) - 1.0)


def find_slider_dimensions(source: KernelSource, p: Array, joint: ClearanceInfo) -> tuple[str, float, float, float]:
    """Return a guide's address, half length and half height of the slider, and the radius of its corners, m.

    Values that the file does not give are 0.
    """
    guide = source.parameters[joint.clearance].address.rpartition(".")[0]
    a, b, radius = (
        float(p[source.parameter_indices[address]])
        if (address := f"{guide}.{key}") in source.parameter_indices
        else 0.0
        for key in ("half_length", "half_height", "corner_radius")
    )
    return guide, a, b, radius

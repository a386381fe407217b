"""How a point of a body moves in a result."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import PointInfo

if TYPE_CHECKING:
    from gudgeon.results.results import Result

Array: TypeAlias = NDArray[Any]


def point_motion(run: Result, point: PointInfo, axis: int, order: int) -> Array:
    """r_P = r + A(θ) s, its first and second time derivatives; s = (x, y) in the body's frame."""
    x = point.sign_x * float(run.p[point.x]) if point.x >= 0 else 0.0
    y = point.sign_y * float(run.p[point.y]) if point.y >= 0 else 0.0
    if point.body < 0:
        return np.full(run.t.shape, (x, y)[axis])
    i = run.source.bodies[point.body].index
    sin, cos = np.sin(run.q[:, i + 2]), np.cos(run.q[:, i + 2])
    arm = (cos * x - sin * y, sin * x + cos * y)
    turned = (-arm[1], arm[0])[axis]  # d arm / dθ
    if order == 0:
        return run.q[:, i + axis] + arm[axis]
    if order == 1:
        return run.v[:, i + axis] + run.v[:, i + 2] * turned
    return run.a[:, i + axis] + run.a[:, i + 2] * turned - run.v[:, i + 2] ** 2 * arm[axis]

r"""Points at one height in the second body's axes: a joint that declares nothing but its row.

first o - - - - o second       Φ = n · (r_P − r_Q),  n: the second body's y axis
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.joints.joint_type import JointType


def rows(first: Any, second: Any, fields: Any) -> list[Any]:
    """Return one row: the difference of height (m)."""
    u_x, u_y = second.direction((1, 0))
    return [u_x * (first.y - second.y) - u_y * (first.x - second.x)]


JOINT = JointType("level", "points at one height", (), "", ("height",), ("m",), rows, __doc__)

"""Points at one height: a joint that declares nothing but its row. Φ = y_first − y_second"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.joints.joint_type import JointType


def rows(first: Any, second: Any, fields: Any) -> list[Any]:
    return [first.y - second.y]


JOINT = JointType("level", "points at one height", (), "", ("height",), ("m",), rows, __doc__)

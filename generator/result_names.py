"""Names that an output may use: what a result has, and its dimension (the names are design.md's)."""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import Location
from gudgeon.expression_tree import Name
from gudgeon.generator.mechanism import GROUND, Drive, Joint
from gudgeon.generator.names import unknown_name
from gudgeon.generator.read_bodies import Places
from gudgeon.generator.units import (
    ACCELERATION,
    ANGULAR_ACCELERATION,
    DIMENSIONLESS,
    FORCE,
    LENGTH,
    RATE,
    TORQUE,
    VELOCITY,
    Dimension,
)

_POINT: Mapping[str, Dimension] = {
    "x": LENGTH, "y": LENGTH, "vx": VELOCITY, "vy": VELOCITY, "ax": ACCELERATION, "ay": ACCELERATION,
}  # fmt: skip
_BODY: Mapping[str, Dimension] = {**_POINT, "theta": DIMENSIONLESS, "omega": RATE, "alpha": ANGULAR_ACCELERATION}
_JOINT: Mapping[str, Dimension] = {"Fx": FORCE, "Fy": FORCE, "F": FORCE, "M": TORQUE}
_PLAY: Mapping[str, Dimension] = {
    "Fn": FORCE, "Ft": FORCE, "e": LENGTH, "ex": LENGTH, "ey": LENGTH, "delta": LENGTH, "eps": DIMENSIONLESS,
    "deltadot": VELOCITY, "vt": VELOCITY, "state": DIMENSIONLESS, "deltadot_minus": VELOCITY,
}  # fmt: skip
_DRIVE: Mapping[str, Dimension] = {"torque": TORQUE}
_TOTALS: Mapping[str, Mapping[str, Dimension]] = {
    "energy": {"kinetic": TORQUE, "potential": TORQUE, "residual": TORQUE},
    "work": {"drives": TORQUE, "forces": TORQUE, "clearances": TORQUE},
}


class ResultNames:
    """Dimensions of a mechanism's results. Names with play count too: a scene without it tells at run time."""

    def __init__(
        self, places: Places, joints: Mapping[str, Joint], drives: Mapping[str, Drive], parameters: object
    ) -> None:
        self.owners: dict[str, Mapping[str, Dimension]] = dict(_TOTALS)
        self.owners |= dict.fromkeys(places.bodies, _BODY) | dict.fromkeys(drives, _DRIVE)
        self.owners |= dict.fromkeys(places.names(), _POINT)
        for name in places.ground:
            self.owners[f"{GROUND}.{name}"] = {"x": LENGTH, "y": LENGTH}
        self.owners |= dict.fromkeys(joints, {**_JOINT, **_PLAY})
        self.parameters = parameters

    def __call__(self, name: Name, where: Location) -> Dimension:
        """The dimension of a name. Raises UnknownNameError at the part that is wrong."""
        owner, dot, last = name.path.rpartition(".")
        if not dot:
            known = [f"{own}.{part}" for own in self.owners for part in self.owners[own] if own == name.path]
            raise unknown_name("name", name.path, known or [*self.parameters], where)  # type: ignore[misc]
        if owner not in self.owners:
            raise unknown_name(
                "name", name.path, [f"{own}.{part}" for own in self.owners for part in self.owners[own]], where
            )
        if last not in self.owners[owner]:
            place = Location(where.file, where.line, where.column + len(owner) + 1)
            raise unknown_name(f"result of {owner}", last, self.owners[owner], place)
        return self.owners[owner][last]

"""Names of what a result has, with their dimensions: all of them for outputs, motion alone for forces."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping

from gudgeon.errors import BadValueError, ExpressionError, Location, UnknownNameError
from gudgeon.generator.field import OF_CAM_ANGLE
from gudgeon.generator.kinds.drives import DRIVES
from gudgeon.generator.kinds.forces.force_type import element_types
from gudgeon.generator.kinds.joints.joint_type import CORNERS, joint_types
from gudgeon.generator.mechanism import GROUND
from gudgeon.generator.reader.places import Places
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import unknown_name
from gudgeon.language.tree import Name
from gudgeon.language.units import (
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

ResultDimension = Callable[[Name, Location], Dimension | None]  # None: fits any

_POINT: Mapping[str, Dimension] = {
    "x": LENGTH,
    "y": LENGTH,
    "vx": VELOCITY,
    "vy": VELOCITY,
    "ax": ACCELERATION,
    "ay": ACCELERATION,
}
_BODY: Mapping[str, Dimension] = {**_POINT, "theta": DIMENSIONLESS, "omega": RATE, "alpha": ANGULAR_ACCELERATION}
_JOINT: Mapping[str, Dimension] = {"Fx": FORCE, "Fy": FORCE, "F": FORCE, "M": TORQUE}
_PLAY: Mapping[str, Dimension] = {
    "Fn": FORCE,
    "Ft": FORCE,
    "e": LENGTH,
    "ex": LENGTH,
    "ey": LENGTH,
    "delta": LENGTH,
    "eps": DIMENSIONLESS,
    "deltadot": VELOCITY,
    "vt": VELOCITY,
    "state": DIMENSIONLESS,
    "deltadot_minus": VELOCITY,
}
_ALWAYS = ("Fx", "Fy", "F")  # of a joint, with play or without
_OF_CORNER: Mapping[str, Dimension] = {**{name: FORCE for name in _ALWAYS}, **_PLAY}
_RESULTS_OF_PLAY = f"expected one of: {', '.join((*_ALWAYS, *_PLAY))}"
_TOTALS: Mapping[str, Mapping[str, Dimension]] = {
    "energy": {"kinetic": TORQUE, "potential": TORQUE, "residual": TORQUE},
    "work": {"drives": TORQUE, "forces": TORQUE, "clearances": TORQUE},
}
LATER = ("lambda", "Phi", "Phi_dot")  # multipliers and drift: which there are the equations say
_ACCELERATIONS = ("ax", "ay", "alpha")


class ResultNames:
    """Dimensions of a mechanism's results. Names with play count too: a scene without it tells at run time.

    `numbers` say of names without a dot what they are: a parameter, an expression.
    `unread` are joints, drives and forces whose own errors were told: their results are taken as they come.
    """

    def __init__(self, places: Places, root: Map, numbers: Mapping[str, str], unread: Iterable[str]) -> None:
        joints, drives, forces = (
            {str(name): kind for name, node in root.part(section).pairs() for kind in kinds if kind in node}
            for section, kinds in (("joints", joint_types()), ("drives", DRIVES), ("forces", element_types()))
        )
        self.unread, self._joints = set(unread), frozenset(joints)
        self.owners: dict[str, Mapping[str, Dimension]] = dict(_TOTALS)
        self.owners |= dict.fromkeys(map(str, places.bodies), _BODY)
        self.owners |= {name: _of_drive(kind, root["drives"][name]) for name, kind in drives.items()}
        self.owners |= dict.fromkeys(places.names(), _POINT)
        self.owners |= {name: dict(element_types()[kind].results) for name, kind in forces.items()}
        for name in places.ground:
            self.owners[f"{GROUND}.{name}"] = {"x": LENGTH, "y": LENGTH}
        guides = [name for name, kind in joints.items() if joint_types()[kind].play == "guide"]
        self.owners |= dict.fromkeys(joints, {**_JOINT, **_PLAY}) | dict.fromkeys(guides, _JOINT)
        self.owners |= {f"{guide}.{corner}": _OF_CORNER for guide in guides for corner in CORNERS}
        self.numbers = numbers

    def __call__(self, name: Name, where: Location) -> Dimension | None:
        """The dimension of a name; None for one that fits any. Raises UnknownNameError at the part that is wrong."""
        owner, dot, last = name.path.rpartition(".")
        if owner in self.unread:
            return None
        if not dot:
            known = [path for path in self.paths() if path.partition(".")[0] == name.path]
            raise unknown_name("name", name.path, known or self.numbers, where)
        if owner not in self.owners:
            raise unknown_name("name", name.path, self.paths(), where)
        if last not in self.owners[owner]:
            place = Location(where.file, where.line, where.column + len(owner) + 1)
            raise unknown_name(f"result of {owner}", last, self.owners[owner], place)
        return self.owners[owner][last]

    def check_series(self, name: Text, outputs: Iterable[str]) -> None:
        """UnknownNameError for a name without a dot, which no series has but outputs: it tells the nearest series."""
        if "." in name:
            return
        if name in self.numbers:
            alike = [path for path in self.paths() if path.rpartition(".")[2] == name]
            hint = f"expected {', '.join(alike[:6])}" if alike else "expected a result: L1.omega, A.F, drive.torque"
            raise UnknownNameError(f"{str(name)!r} is {self.numbers[name]}, no series", name.where, hint)
        owned = [path for path in self.paths() if path.partition(".")[0] == name]
        raise unknown_name("series", name, owned or [*outputs, *self.paths()], name.where)

    def check_play(self, name: Text, scene: str, play: Container[str]) -> None:
        """BadValueError for what a joint has in other scenes alone: with play, or without."""
        owner, _, last = name.rpartition(".")
        joint, _, corner = owner.partition(".")
        if joint in self.unread:
            return
        if joint in self._joints and corner in CORNERS and joint not in play:
            hint = f"expected one of: {', '.join(f'{joint}.{one}' for one in _JOINT)}; or give it play there"
            raise BadValueError(f"{name}: joint {joint} has no play in scene {scene}", name.where, hint)
        if owner not in self._joints or last in _ALWAYS:
            return
        if owner in play and last in _JOINT and f"{owner}.{next(iter(CORNERS))}" not in self.owners:
            raise BadValueError(f"{name}: joint {owner} has play in scene {scene}", name.where, _RESULTS_OF_PLAY)
        if owner not in play and last in _PLAY:
            hint = f"expected one of: {', '.join(_JOINT)}; or give it play there"
            raise BadValueError(f"{name}: joint {owner} has no play in scene {scene}", name.where, hint)

    def paths(self) -> Iterator[str]:
        """Every name."""
        read = ((owner, parts) for owner, parts in self.owners.items() if owner not in self.unread)
        return (f"{owner}.{part}" for owner, parts in read for part in parts)


class MotionNames(ResultNames):
    """What a force may depend on: coordinates and velocities; accelerations and forces follow from it."""

    def __init__(self, places: Places, root: Map, numbers: Mapping[str, str]) -> None:
        moving = {"bodies": root["bodies"], "ground": root.part("ground")}
        super().__init__(places, Map.make(moving, root.where), numbers, ())
        for total in _TOTALS:
            del self.owners[total]
        self.owners = {
            owner: {part: of for part, of in parts.items() if part not in _ACCELERATIONS}
            for owner, parts in self.owners.items()
        }
        self._later = frozenset((*_TOTALS, *root.part("drives"), *root.part("joints"), *root.part("forces")))

    def __call__(self, name: Name, where: Location) -> Dimension | None:
        """The dimension of a name. Raises ExpressionError for what is known only once the forces are."""
        owner, _, last = name.path.rpartition(".")
        if owner in self._later or owner in self.owners and last in _ACCELERATIONS and last not in self.owners[owner]:
            what = "an acceleration" if last in _ACCELERATIONS else "a result"
            hint = (
                "expected t, parameters, and coordinates and velocities of bodies and points:"
                " L1.x .y .theta .vx .vy .omega, L1.head.x .y .vx .vy"
            )
            raise ExpressionError(f"{name.path!r} is {what} that follows from the forces", where, hint)
        return super().__call__(name, where)


class Penetration:
    """What the force of a contact may depend on."""

    def __init__(self, parameters: Iterable[str]) -> None:
        self._parameters = parameters

    def __call__(self, name: Name, where: Location) -> Dimension | None:
        """The dimension of delta. Raises ExpressionError for what else a contact has, UnknownNameError."""
        if name.path == "delta":
            return LENGTH
        if "." in name.path or name.path in _PLAY:
            hint = "expected delta, the penetration, and parameters; `dissipation` says what its rate does"
            raise ExpressionError(f"{name.path!r} cannot stand in a force of the penetration", where, hint)
        raise unknown_name("name", name.path, ("delta", *self._parameters), where)


class CamAngle:
    """What the profile of a cam may depend on."""

    def __init__(self, parameters: Iterable[str]) -> None:
        self._parameters = parameters

    def __call__(self, name: Name, where: Location) -> Dimension | None:
        """Return the dimension of phi. Raises ExpressionError for names of motion, UnknownNameError."""
        if name.path == OF_CAM_ANGLE:
            return DIMENSIONLESS
        if "." in name.path:
            hint = "expected phi, the cam's angle, parameters and curves"
            raise ExpressionError(f"{name.path!r} cannot stand in the profile of a cam", where, hint)
        raise unknown_name("name", name.path, (OF_CAM_ANGLE, *self._parameters), where)


def _of_drive(kind: str, node: Map) -> Mapping[str, Dimension]:
    """A drive of an angle needs a torque, a drive of a length a force."""
    turns = kind == "angle" or kind == "coordinate" and str(node[kind]).endswith(".theta")
    return {"torque": TORQUE} if turns else {"force": FORCE}

"""Contains the names that expressions may use, with their dimensions: results, motion, penetration, cam angle."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping

from gudgeon.errors import BadValueError, ExpressionError, Location, UnknownNameError
from gudgeon.generator.field import OF_CAM_ANGLE
from gudgeon.generator.kinds.drives import DRIVES
from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.kinds.joints.joint_type import CORNERS, find_joint_types
from gudgeon.generator.mechanism import GROUND
from gudgeon.generator.reader.point_names import PointNames
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import make_unknown_name_error
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

ResultDimension = Callable[[Name, Location], Dimension | None]  # None: fits any dimension

_POINT_RESULTS: Mapping[str, Dimension] = {
    "x": LENGTH,
    "y": LENGTH,
    "vx": VELOCITY,
    "vy": VELOCITY,
    "ax": ACCELERATION,
    "ay": ACCELERATION,
}
_BODY_RESULTS: Mapping[str, Dimension] = {
    **_POINT_RESULTS,
    "theta": DIMENSIONLESS,
    "omega": RATE,
    "alpha": ANGULAR_ACCELERATION,
}
_JOINT_RESULTS: Mapping[str, Dimension] = {"Fx": FORCE, "Fy": FORCE, "F": FORCE, "M": TORQUE}
_PLAY_RESULTS: Mapping[str, Dimension] = {
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
_COMMON_RESULTS = ("Fx", "Fy", "F")  # results of a joint with play or without
_CORNER_RESULTS: Mapping[str, Dimension] = {**{name: FORCE for name in _COMMON_RESULTS}, **_PLAY_RESULTS}
_PLAY_HINT = f"expected one of: {', '.join((*_COMMON_RESULTS, *_PLAY_RESULTS))}"
_TOTAL_RESULTS: Mapping[str, Mapping[str, Dimension]] = {
    "energy": {"kinetic": TORQUE, "potential": TORQUE, "residual": TORQUE},
    "work": {"drives": TORQUE, "forces": TORQUE, "clearances": TORQUE},
}
OWNERS_CHECKED_BY_RUN = ("lambda", "Phi", "Phi_dot")  # multipliers and drift: the equations determine which exist
_ACCELERATIONS = ("ax", "ay", "alpha")


class ResultNames:
    """Return the dimension of each result of a mechanism, with and without play.

    `kind_by_name` maps names of numbers, which have no dot, to phrases ("a parameter"). `unreadable_owners` are joints,
    drives and forces whose own errors were reported: their results are accepted without a check. `owners` maps the
    owner of results ("A", "L1.head", "energy") to the dimensions of its results by name.
    """

    def __init__(
        self, point_names: PointNames, root: Map, kind_by_name: Mapping[str, str], unreadable_owners: Iterable[str]
    ) -> None:
        """Collect the results of all bodies, points, joints, drives and forces that the file `root` declares."""
        joints, drives, forces = (
            {
                str(name): kind
                for name, node in root.get_mapping(section).list_entries()
                for kind in kinds
                if kind in node
            }
            for section, kinds in (("joints", find_joint_types()), ("drives", DRIVES), ("forces", find_element_types()))
        )
        self.unreadable_owners, self._joints = set(unreadable_owners), frozenset(joints)
        self.owners: dict[str, Mapping[str, Dimension]] = dict(_TOTAL_RESULTS)
        self.owners |= dict.fromkeys(map(str, point_names.bodies), _BODY_RESULTS)
        self.owners |= {name: _find_drive_results(kind, root["drives"][name]) for name, kind in drives.items()}
        self.owners |= dict.fromkeys(point_names.iterate_point_names(), _POINT_RESULTS)
        self.owners |= {name: dict(find_element_types()[kind].results) for name, kind in forces.items()}
        for name in point_names.ground:
            self.owners[f"{GROUND}.{name}"] = {"x": LENGTH, "y": LENGTH}
        guides = [name for name, kind in joints.items() if find_joint_types()[kind].play == "guide"]
        self.owners |= dict.fromkeys(joints, {**_JOINT_RESULTS, **_PLAY_RESULTS}) | dict.fromkeys(
            guides, _JOINT_RESULTS
        )
        self.owners |= {f"{guide}.{corner}": _CORNER_RESULTS for guide in guides for corner in CORNERS}
        self.kind_by_name = kind_by_name

    def __call__(self, name: Name, where: Location) -> Dimension | None:
        """Return the dimension of a result's name; None if its owner could not be read, so that any dimension fits.

        Raises UnknownNameError at the wrong part of the name, with the nearest known names.
        """
        owner, dot, result = name.path.rpartition(".")
        if owner in self.unreadable_owners:
            return None
        if not dot:
            candidates = [path for path in self.iterate_result_names() if path.partition(".")[0] == name.path]
            raise make_unknown_name_error("name", name.path, candidates or self.kind_by_name, where)
        if owner not in self.owners:
            raise make_unknown_name_error("name", name.path, self.iterate_result_names(), where)
        if result not in self.owners[owner]:
            location = Location(where.file, where.line, where.column + len(owner) + 1)
            raise make_unknown_name_error(f"result of {owner}", result, self.owners[owner], location)
        return self.owners[owner][result]

    def reject_name_without_dot(self, name: Text, outputs: Iterable[str]) -> None:
        """Raise UnknownNameError, with the nearest series, for any name without a dot; others are not checked here.

        A series of a result is named OWNER.RESULT. Series that the section `outputs` defines have no dot, so that
        callers must not pass their names. `outputs`: these names, for the hint. For a name in `kind_by_name`, such as
        that of a parameter, the hint lists results of this name; for the name of an owner it lists its results. Called
        for the entries of `peaks` in a scene.
        """
        if "." in name:
            return
        if name in self.kind_by_name:
            same_results = [path for path in self.iterate_result_names() if path.rpartition(".")[2] == name]
            hint = (
                f"expected {', '.join(same_results[:6])}"
                if same_results
                else "expected a result: L1.omega, A.F, drive.torque"
            )
            raise UnknownNameError(f"{str(name)!r} is {self.kind_by_name[name]}, not a series", name.where, hint)
        results_of_owner = [path for path in self.iterate_result_names() if path.partition(".")[0] == name]
        raise make_unknown_name_error(
            "series", name, results_of_owner or [*outputs, *self.iterate_result_names()], name.where
        )

    def check_result_availability(self, name: Text, scene: str, play: Container[str]) -> None:
        """Raise BadValueError for a result that a joint has only with play, or only without, in other scenes.

        `play` contains the joints that have play in the scene named `scene`. Names of other owners are accepted.
        """
        owner, _, result = name.rpartition(".")
        joint, _, corner = owner.partition(".")
        if joint in self.unreadable_owners:
            return
        if joint in self._joints and corner in CORNERS and joint not in play:
            hint = (
                f"expected one of: {', '.join(f'{joint}.{result}' for result in _JOINT_RESULTS)}; or play of {joint} "
                f"in scene {scene}"
            )
            raise BadValueError(f"{name}: joint {joint} has no play in scene {scene}", name.where, hint)
        if owner not in self._joints or result in _COMMON_RESULTS:
            return
        if owner in play and result in _JOINT_RESULTS and f"{owner}.{next(iter(CORNERS))}" not in self.owners:
            raise BadValueError(f"{name}: joint {owner} has play in scene {scene}", name.where, _PLAY_HINT)
        if owner not in play and result in _PLAY_RESULTS:
            hint = f"expected one of: {', '.join(_JOINT_RESULTS)}; or play of {joint} in scene {scene}"
            raise BadValueError(f"{name}: joint {owner} has no play in scene {scene}", name.where, hint)

    def iterate_result_names(self) -> Iterator[str]:
        """Return an iterator over the full name of every result, without those of unreadable owners."""
        readable = ((owner, results) for owner, results in self.owners.items() if owner not in self.unreadable_owners)
        return (f"{owner}.{result}" for owner, results in readable for result in results)


class MotionNames(ResultNames):
    """Return the dimension of each name on which a force may depend: coordinates and velocities."""

    def __init__(self, point_names: PointNames, root: Map, kind_by_name: Mapping[str, str]) -> None:
        """Collect coordinates and velocities of bodies and points; accelerations and results of forces are left out."""
        moving = {"bodies": root["bodies"], "ground": root.get_mapping("ground")}
        super().__init__(point_names, Map.make_map(moving, root.where), kind_by_name, ())
        for total in _TOTAL_RESULTS:
            del self.owners[total]
        self.owners = {
            owner: {part: of for part, of in parts.items() if part not in _ACCELERATIONS}
            for owner, parts in self.owners.items()
        }
        self._force_results = frozenset(
            (*_TOTAL_RESULTS, *root.get_mapping("drives"), *root.get_mapping("joints"), *root.get_mapping("forces"))
        )

    def __call__(self, name: Name, where: Location) -> Dimension | None:
        """Return the dimension of a name on which a force may depend; None if any fits.

        Raises ExpressionError for accelerations and results that follow from forces, UnknownNameError for other names.
        """
        owner, _, component = name.path.rpartition(".")
        if (
            owner in self._force_results
            or owner in self.owners
            and component in _ACCELERATIONS
            and component not in self.owners[owner]
        ):
            phrase = "an acceleration" if component in _ACCELERATIONS else "a result"
            hint = (
                "expected t, parameters, and coordinates and velocities of bodies and points:"
                " L1.x .y .theta .vx .vy .omega, L1.head.x .y .vx .vy"
            )
            raise ExpressionError(f"{name.path!r} is {phrase} that follows from the forces", where, hint)
        return super().__call__(name, where)


class PenetrationNames:
    """Return the dimension of each name on which the force of a contact may depend: delta."""

    def __init__(self, parameters: Iterable[str]) -> None:
        self._parameters = parameters

    def __call__(self, name: Name, where: Location) -> Dimension | None:
        """Return the dimension of delta, the penetration (a length).

        Raises ExpressionError for other results of a contact, UnknownNameError otherwise.
        """
        if name.path == "delta":
            return LENGTH
        if "." in name.path or name.path in _PLAY_RESULTS:
            hint = "expected delta, the penetration, and parameters; `dissipation` sets the effect of its rate"
            raise ExpressionError(f"{name.path!r} is not allowed in a force of the penetration", where, hint)
        raise make_unknown_name_error("name", name.path, ("delta", *self._parameters), where)


class CamAngleNames:
    """Return the dimension of each name on which the profile of a cam may depend: phi."""

    def __init__(self, parameters: Iterable[str]) -> None:
        self._parameters = parameters

    def __call__(self, name: Name, where: Location) -> Dimension | None:
        """Return the dimension of phi, the cam's angle.

        Raises ExpressionError for names of motion, UnknownNameError otherwise.
        """
        if name.path == OF_CAM_ANGLE:
            return DIMENSIONLESS
        if "." in name.path:
            hint = "expected phi, the cam's angle, parameters and curves"
            raise ExpressionError(f"{name.path!r} is not allowed in the profile of a cam", where, hint)
        raise make_unknown_name_error("name", name.path, (OF_CAM_ANGLE, *self._parameters), where)


def _find_drive_results(kind: str, node: Map) -> Mapping[str, Dimension]:
    """Return the results of a drive by name: "torque" if it prescribes an angle, "force" if a length."""
    is_angle = kind == "angle" or kind == "coordinate" and str(node[kind]).endswith(".theta")
    return {"torque": TORQUE} if is_angle else {"force": FORCE}

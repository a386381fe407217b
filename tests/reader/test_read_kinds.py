"""Every kind of joint, drive and force element: what arrives in the Mechanism, and every mistake at its place."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

import pytest

from gudgeon.errors import (
    BadNameError,
    BadValueError,
    ExpressionError,
    InputError,
    JoinError,
    Location,
    MissingKeyError,
    UnitError,
    UnknownKeyError,
    UnknownNameError,
)
from gudgeon.generator.format.sections import DRIVES
from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import Mechanism, PointRef, Quantity
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.reader.parameters import evaluate_parameters
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.tree import Number, evaluate, iterate_names
from gudgeon.language.units import DIMENSIONLESS, FORCE, LENGTH, TORQUE, make_dimension

VALID = Path(__file__).resolve().parents[1] / "mechanisms" / "valid"
TEXT = (VALID / "every_kind.yaml").read_text()


@pytest.fixture(scope="module")
def machine() -> Mechanism:
    return read_mechanism(TEXT.encode(), "f")


def value(mechanism: Mechanism, quantity: Quantity) -> float:
    return float(evaluate(quantity.value, evaluate_parameters(mechanism.parameters).__getitem__))


def ends(refs: tuple[PointRef, ...]) -> list[tuple[str, str]]:
    return [(ref.body, ref.point) for ref in refs]


def test_every_kind_is_in_some_file() -> None:
    files = [*VALID.glob("*.yaml"), *Path(str(resources.files("gudgeon.mechanisms"))).glob("*.yaml")]
    mechanisms = [read_mechanism(path.read_bytes(), path.name) for path in files]
    assert {joint.kind for m in mechanisms for joint in m.joints.values()} == set(find_joint_types())
    assert {drive.kind for m in mechanisms for drive in m.drives.values()} == set(DRIVES)
    assert {force.kind for m in mechanisms for force in m.forces.values()} == set(find_element_types())


def test_joints(machine: Mechanism) -> None:
    mesh, epicycle = machine.joints["mesh"], machine.joints["epicycle"]
    assert ends((mesh.first, mesh.second)) == [("L1", "com"), ("L4", "com")]
    assert (mesh.options, epicycle.options) == (
        {"carrier": "ground", "internal": "false"},
        {"carrier": "L1", "internal": "true"},
    )
    assert [component.address for component in mesh.vectors["radii"]] == ["joints.mesh.radii.x", "joints.mesh.radii.y"]
    assert value(machine, mesh.vectors["radii"][0]) == 0.04
    assert value(machine, machine.joints["strut"].quantities["length"]) == 0.3
    assert value(machine, machine.joints["weld"].quantities["angle"]) == pytest.approx(0.5235987755982988, rel=1e-15)
    slot = machine.joints["slot"]
    assert ends((slot.first, slot.second)) == [("pin", "centre"), ("crank", "origin")]
    assert slot.vectors["direction"][1].is_zero


def test_drives(machine: Mechanism) -> None:
    found = {
        name: (drive.body, drive.reference, drive.coordinate, ends(drive.points), drive.value.dimension)
        for name, drive in machine.drives.items()
    }
    assert found == {
        "lift": ("pin", None, "y", [], LENGTH),
        "ramp": ("L1", None, "theta", [], DIMENSIONLESS),
        "turn": ("arm", "L1", "theta", [], DIMENSIONLESS),
        "stroke": ("rod", None, "", [("ground", "C"), ("rod", "tip")], LENGTH),
    }


def test_forces(machine: Mechanism) -> None:
    coil, band, twist = (machine.forces[name] for name in ("coil", "band", "twist"))
    assert ends(coil.targets) == [("ground", "C"), ("L3", "D")]
    assert coil.quantities["stiffness"].address == "forces.coil.stiffness" and coil.quantities["damping"].is_zero
    assert coil.quantities["stiffness"].dimension == make_dimension(mass=1, time=-2)
    assert set(band.quantities) == {"stiffness"}  # what is left out is absent
    assert ends(twist.targets) == [("ground", ""), ("L1", "com")]
    assert ends(machine.forces["brake"].targets) == [("rod", "com"), ("L3", "com")]
    assert {name.path for name in iterate_names(machine.forces["brake"].quantities["value"].value)} == {
        "drag",
        "rod.omega",
        "L3.omega",
        "t",
        "S9.y",
        "r1",
    }
    push, gust = machine.forces["push"], machine.forces["gust"]
    assert [component.address for component in push.vectors["value"]] == ["forces.push.value.x", "forces.push.value.y"]
    assert push.vectors["value"][0].dimension == FORCE
    assert (push.options["axes"], gust.options["axes"]) == ("ground", "body")


def test_conditions(machine: Mechanism) -> None:
    found = {(c.address, c.relation, c.bound) for c in machine.conditions}
    assert ("joints.strut.length", ">", 0.0) in found
    assert ("joints.mesh.radii.y", ">", 0.0) in found
    assert ("forces.coil.stiffness", ">=", 0.0) in found
    assert not any(address.startswith("forces.motor") for address, _, _ in found)


def test_results_of_drives_and_forces(machine: Mechanism) -> None:
    assert machine.outputs["lift_force"].dimension == FORCE
    assert machine.outputs["ramp_torque"].dimension == TORQUE
    assert machine.outputs["moments"].dimension == TORQUE


def test_results_are_those_that_the_elements_build() -> None:
    """`results` of an element's file against what its `build` returns, name by name and unit by unit."""
    units = {"N": FORCE, "N*m": TORQUE, "m": LENGTH}
    model = derive_scene(TEXT.encode(), "f", "ideal")
    for name, applied in model.elements.items():
        built = {what: units[unit] for what, (_, unit) in applied.loads.series.items()}
        assert built == dict(find_element_types()[model.scene.mechanism.forces[name].kind].results)


def test_overrides() -> None:
    changed = read_mechanism(
        TEXT.encode(),
        "f",
        {
            "forces.coil.stiffness": "5 N/mm",
            "forces.push.value.x": 3,
            "forces.band.damping": 0.5,
            "joints.epicycle.internal": False,
            "joints.mesh.radii.x": "41 mm",
            "forces.push.axes": "body",
        },
    )
    assert value(changed, changed.forces["coil"].quantities["stiffness"]) == 5000.0
    assert changed.forces["push"].vectors["value"][0].value == Number(3.0, "3")
    assert value(changed, changed.forces["band"].quantities["damping"]) == 0.5  # the file has no such key
    assert changed.joints["epicycle"].options["internal"] == "false"
    assert changed.forces["push"].options["axes"] == "body"
    with pytest.raises(UnknownNameError, match="did you mean 'forces.coil.stiffness'"):
        read_mechanism(TEXT.encode(), "f", {"forces.coil.stifness": 1})
    with pytest.raises(BadValueError, match="stiffness is not negative"):
        read_mechanism(TEXT.encode(), "f", {"forces.coil.stiffness": -1})


# (what the file says, what it says instead, the error); ‸ stands before the place of the error
MISTAKES: list[tuple[str, str, type[InputError]]] = [
    # joints
    ("gear: [L1, L4]", "gear: [L1.head, L4]", UnknownNameError),
    ("gear: [L1, L4]", "gear: [L1, ‸L1]", JoinError),
    ("gear: [L1, L4]", "gear: ‸[L1, L4, S9]", BadValueError),
    ("gear: [L1, L4]", "‸gear: L1", BadValueError),
    ("gear: [L1, L4]", "gear: [L1, ‸[L4]]", BadValueError),
    ("carrier: L1,", "carrier: ‸ring,", JoinError),
    ("carrier: L1,", "carrier: ‸L9,", UnknownNameError),
    ("internal: true", "internal: ‸yes", BadValueError),
    ("internal: true", "‸internal: [true]", BadValueError),
    ("radii: [r1, 60 mm]", "radii: [r1, ‸-60 mm]", BadValueError),
    ("radii: [r1, 60 mm]", "radii: [r1, ‸60 deg]", UnitError),
    (", radii: [r1, 60 mm]", "", MissingKeyError),
    ("radii: [r1, 60 mm]", "‸radius: [r1, 60 mm]", UnknownKeyError),
    ("direction: [1, 0]", "direction: [‸0, 0]", BadValueError),
    ("length: 300 mm}", "length: ‸0 mm}", BadValueError),
    (", length: 300 mm}", "}", MissingKeyError),
    ("angle: 30 deg", "angle: ‸30 mm", UnitError),
    ("angle: 30 deg", "angle: ‸t", ExpressionError),
    ("rigid: [plate.a, arm.b]", "rigid: [plate.a, ‸plate.a]", JoinError),
    ("rigid: [plate.a, arm.b]", "rigid: [plate.a, ‸arm]", BadValueError),
    ("{rigid: [plate.a, arm.b]", "{‸ridgid: [plate.a, arm.b]", UnknownKeyError),
    # drives
    ("coordinate: pin.y", "coordinate: pin.‸z", UnknownNameError),
    ("coordinate: pin.y", "coordinate: ‸pn.y", UnknownNameError),
    ("coordinate: pin.y", "coordinate: ‸pin", BadValueError),
    ("coordinate: pin.y", "‸coordinate: [pin.y]", BadValueError),
    ("coordinate: pin.y", "coordinate: ‸ground.y", UnknownNameError),
    ("10 mm * sin(2*pi*t)", "‸10 deg * sin(2*pi*t)", UnitError),
    ("distance: [ground.C, rod.tip]", "distance: [ground.C, ‸ground.O]", JoinError),
    ("distance: [ground.C, rod.tip]", "distance: [rod.head, ‸rod.tip]", JoinError),
    ("distance: [ground.C, rod.tip]", "distance: ‸[ground.C]", BadValueError),
    ("value: 150 mm + 5 mm", "value: 150 deg + ‸5 mm", UnitError),
    ("turn: {angle: [arm, L1]", "‸turn: {angle: L1", JoinError),
    ("turn: {angle: [arm, L1]", "‸turn: {angle: [L1, ground]", JoinError),
    ("turn: {angle: [arm, L1]", "‸turn: {coordinate: L1.theta", JoinError),
    ("turn: {angle: [arm, L1]", "turn: {angle: [arm, ‸arm]", JoinError),
    ("turn: {angle: [arm, L1]", "turn: {‸velocity: [arm, L1]", UnknownKeyError),
    ("turn: {angle: [arm, L1]", "turn: {angle: [arm, L1], ‸distance: [rod.tip, ground.C]", UnknownKeyError),
    ("turn: {angle: [arm, L1]", "turn: {angle: [arm, L1], ‸unit: deg", UnknownKeyError),
    ("ramp(t, 1 s, 1 s)", "‸ramp(t, 1 s)", ExpressionError),
    ("ramp(t, 1 s, 1 s)", "ramp(t, 1 s, 1 s‸", ExpressionError),
    # forces
    ("spring_damper: [ground.C, L3.D]", "spring_damper: [ground.C, L3.‸E]", UnknownNameError),
    ("spring_damper: [ground.C, L3.D]", "spring_damper: [ground.C, ‸ground.O]", JoinError),
    ("spring_damper: [ground.C, L3.D]", "spring_damper: [L3.head, ‸L3.D]", JoinError),
    ("spring_damper: [ground.C, L3.D]", "‸spring_damper: L3.D", BadValueError),
    ("{spring_damper: [ground.C, L3.D]", "{‸spring: [ground.C, L3.D]", UnknownKeyError),
    ("stiffness: k,", "stiffness: ‸-k,", BadValueError),
    ("stiffness: k,", "‸stiffnes: k,", UnknownKeyError),
    ("stiffness: k,", "stiffness: ‸drag,", UnitError),
    ("stiffness: k,", "stiffness: ‸t,", ExpressionError),
    ("stiffness: k,", "stiffness: ‸L1.x,", ExpressionError),
    ("spring_damper: [ground, L1]", "spring_damper: [ground, ‸L1.head]", UnknownNameError),
    ("spring_damper: [ground, L1]", "spring_damper: [ground, ‸ground]", JoinError),
    ("motor: {torque: L1", "motor: {torque: ‸ground", JoinError),
    ("motor: {torque: L1", "motor: {torque: [L1, ‸L1]", JoinError),
    ("motor: {torque: L1", "motor: {torque: ‸[L1]", BadValueError),
    ("value: 0.033 N*m}", "value: ‸0.033 N}", UnitError),
    (", value: 0.033 N*m}", "}", MissingKeyError),
    ("value: 0.033 N*m}", "value: 1 N*m*s * ‸L1.alpha}", ExpressionError),
    ("value: 0.033 N*m}", "value: 1 m * ‸coil.F}", ExpressionError),
    ("value: 0.033 N*m}", "value: ‸ramp.torque}", ExpressionError),
    ("value: 0.033 N*m}", "value: 1 m * ‸weld.Fx}", ExpressionError),
    ("value: 0.033 N*m}", "value: ‸energy.kinetic}", ExpressionError),
    ("value: 0.033 N*m}", "value: 1 N * ‸rod.tip.ax}", ExpressionError),
    ("value: 0.033 N*m}", "value: 1 N * rod.tip.‸z}", UnknownNameError),
    ("value: 0.033 N*m}", "value: 1 N * ‸rot.x}", UnknownNameError),
    ("value: 0.033 N*m}", "value: ‸1 N * rod.tip.vx}", UnitError),
    ("value: 0.033 N*m}", "value: 1 N * ground.C.‸vx}", UnknownNameError),
    ("push: {force: rod.tip", "push: {force: ‸ground.C", JoinError),
    ("push: {force: rod.tip", "push: {force: ‸rod", BadValueError),
    ("push: {force: rod.tip", "push: {force: ‸[rod.tip, L3.D]", BadValueError),
    ("value: [1 N, 0]", "‸value: 1 N", BadValueError),
    ("value: [1 N, 0]", "value: [1 N, ‸1 m]", UnitError),
    ("axes: ground", "axes: ‸bodies", BadValueError),
    ("  push: {", "  ‸lift: {", BadNameError),
    ("  push: {", "  ‸ground: {", BadNameError),
    ("lift.force", "lift.‸torque", UnknownNameError),
    ("twist.M", "twist.‸F", UnknownNameError),
    ("coil.length", "coil.‸lenght", UnknownNameError),
]


@pytest.mark.parametrize(("right", "wrong", "kind"), MISTAKES, ids=[wrong or "left out" for _, wrong, _ in MISTAKES])
def test_mistake(right: str, wrong: str, kind: type[InputError]) -> None:
    assert TEXT.count(right) >= 1
    text = TEXT.replace(right, wrong, 1)
    before, mark, after = text.partition("‸")
    with pytest.raises(InputError) as caught:
        read_mechanism((before + after if mark else text).encode(), "f")
    error = caught.value
    assert type(error) is kind, str(error)  # one mistake, one error
    if mark:
        place = Location("f", before.count("\n") + 1, len(before.rpartition("\n")[2]) + 1)
        assert error.where == place, str(error)


def test_what_a_force_may_use_is_said() -> None:
    text = TEXT.replace("value: 0.033 N*m}", "value: 1 N*m*s * L1.alpha}")
    with pytest.raises(ExpressionError, match=r"t, parameters, and coordinates and velocities.*L1\.head\.x"):
        read_mechanism(text.encode(), "f")

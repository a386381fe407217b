"""Reading whole files: what a file says arrives in the Mechanism, in SI, with addresses and places."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from gudgeon.errors import BadValueError, InputError, InputErrors, Location, UnknownNameError
from gudgeon.generator.mechanism import Mechanism, Quantity, make_scene
from gudgeon.generator.reader.parameters import evaluate_parameters
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.tree import Number, evaluate
from gudgeon.language.units import ACCELERATION, DIMENSIONLESS, INERTIA, LENGTH, RATE, TORQUE

HERE = Path(__file__).resolve().parents[1]
VALID = HERE / "mechanisms" / "valid"
PRESS = HERE.parent / "mechanisms" / "nine_bar_press.yaml"


def read(name: str, **kwargs: object) -> Mechanism:
    path = VALID / f"{name}.yaml"
    return read_mechanism(path.read_bytes(), path.name, **kwargs)  # type: ignore[arg-type]


def value(mechanism: Mechanism, quantity: Quantity | None) -> float:
    assert quantity is not None
    return float(evaluate(quantity.value, evaluate_parameters(mechanism.parameters).__getitem__))


@pytest.fixture(scope="module")
def press() -> Mechanism:
    return read_mechanism(PRESS.read_bytes(), "press.yaml")


@pytest.fixture(scope="module")
def slider() -> Mechanism:
    return read("slider_crank")


def test_press_in_figures(press: Mechanism) -> None:
    assert list(press.bodies) == ["L1", "L2", "L3", "L4", "L6", "L7", "L8", "S9"]
    assert len(press.joints) == 11 and len(press.drives) == 2
    assert value(press, press.bodies["L7"].mass) == 0.277
    assert value(press, press.bodies["L1"].inertia) == 3.030e-4
    inertia = press.bodies["L7"].inertia
    assert inertia is not None and inertia.dimension == INERTIA
    assert press.bodies["S9"].length is None
    assert press.gravity is not None and press.gravity[0].is_zero and value(press, press.gravity[1]) == -9.81
    assert press.gravity[1].dimension == ACCELERATION
    assert value(press, press.ground["O4"][1]) == -0.3 and not press.ground["O4"][1].is_zero
    assert evaluate_parameters(press.parameters) == {"omega": math.tau, "omega4": -math.tau, "l5": 0.3, "c": 0.0003}


def test_press_scenes(press: Mechanism) -> None:
    assert list(press.scenes) == ["ideal", "dry", "lubricated"]
    assert not press.scenes["ideal"].play
    oil = press.scenes["lubricated"].play["B"].contact
    assert oil.film is not None and oil.normal is not None and oil.friction is not None
    assert oil.film.options["as_printed"] is False
    assert value(press, oil.film.quantities["viscosity"]) == 0.1
    assert oil.transition is not None and value(press, oil.transition) == 5e-6
    assert value(press, press.scenes["dry"].simulate["step"]) == 1e-6


def test_addresses_and_places(press: Mechanism) -> None:
    mass = press.bodies["L2"].mass
    assert mass is not None and mass.address == "bodies.L2.mass"
    line = PRESS.read_text().splitlines()[mass.where.line - 1]
    assert line[mass.where.column - 1 :].startswith("0.284 kg")
    assert press.joints["guide"].vectors["axis"][1].address == "joints.guide.axis.y"
    assert press.drives["crank1"].value.address == "drives.crank1.value"
    assert press.start.guess["L7.theta"].address == "start.guess.L7.theta"
    assert press.outputs["lift"].address == "outputs.lift"


def test_what_is_inherited_has_its_own_address(press: Mechanism) -> None:
    oil, dry = (press.scenes[name].play["A"].contact for name in ("lubricated", "dry"))
    assert oil.normal is not None and dry.normal is not None
    own, parents = oil.normal.quantities["restitution"], dry.normal.quantities["restitution"]
    assert own.address == "contacts.oil.normal.restitution"
    assert (own.value, own.where) == (parents.value, parents.where)


def test_slider_crank(slider: Mechanism) -> None:
    rod = slider.bodies["rod"]
    assert value(slider, rod.inertia) == pytest.approx(0.2 * 0.15**2 / 12, rel=1e-15)
    assert rod.points["eye"][1].address == "bodies.rod.points.eye.y"
    assert value(slider, rod.points["eye"][1]) == -0.01
    com = slider.bodies["crank"].com
    assert com is not None and value(slider, com[0]) == 0.0125 and com[1].is_zero
    assert slider.drives["motor"].reference is None  # against the ground is absolute
    assert slider.title.startswith("Slider-crank; ")
    assert slider.outputs["lift"].dimension == LENGTH
    assert slider.outputs["power"].dimension == TORQUE * RATE
    assert value(slider, slider.joints["guide"].quantities["angle"]) == 0.0


def test_parameter_without_unit_takes_the_dimension_of_its_use(slider: Mechanism) -> None:
    assert slider.parameters["offset"].dimension == LENGTH
    assert slider.parameters["play"].dimension == LENGTH
    assert slider.parameters["speed"].dimension == RATE


def test_contacts_extend_law_by_law(slider: Mechanism) -> None:
    wet = slider.scenes["oiled"].play["pin"].contact
    assert wet.normal is not None and wet.film is not None and wet.friction is None
    assert value(slider, wet.normal.quantities["restitution"]) == 0.5  # softer's
    assert value(slider, wet.normal.quantities["exponent"]) == 1.4  # hard's
    assert wet.normal.options["geometry"] == "internal" and wet.clip_ratio
    assert wet.velocity_floor is not None and value(slider, wet.velocity_floor) == 1e-5
    assert wet.film.options == {"as_printed": False, "shear": True, "angular_velocity": "relative"}
    hard = read("slider_crank", overrides={"scenes.knock.play.pin.contact": "hard"}).scenes["knock"].play["pin"].contact
    assert hard.velocity_floor is None and hard.normal is not None
    assert value(slider, hard.normal.quantities["restitution"]) == 0.8


def test_law_defaults_are_filled_in(press: Mechanism) -> None:
    normal = press.scenes["dry"].play["A"].contact.normal
    assert normal is not None and normal.quantities["exponent"].value == Number(1.5, "1.5")
    assert normal.quantities["exponent"].address == "contacts.dry.normal.exponent"


def test_scene_puts_its_parameters_in(slider: Mechanism) -> None:
    scene = make_scene(slider, "oiled")
    assert scene.parameters["speed"].address == "parameters.speed"
    assert evaluate_parameters(scene.parameters)["speed"] == pytest.approx(6 * math.pi, rel=1e-15)
    assert list(scene.parameters) == list(slider.parameters)
    assert make_scene(slider, "ideal").parameters == slider.parameters
    assert value(slider, make_scene(slider, "ideal").simulate["output"]) == 200
    with pytest.raises(UnknownNameError, match="did you mean 'oiled'.*ideal, knock, oiled"):
        make_scene(slider, "oild")


def test_conditions_go_to_run_time(press: Mechanism) -> None:
    found = {(c.address, c.relation, c.bound) for c in press.conditions}
    assert ("bodies.L2.mass", ">", 0.0) in found
    assert ("bearings.pin.clearance", "<", "bearings.pin.radius") in found
    assert ("contacts.oil.friction.v1", ">", "contacts.oil.friction.v0") in found
    assert ("materials.steel_45.nu", "<", 0.5) in found


@pytest.mark.parametrize("path", [PRESS, *sorted(VALID.glob("*.yaml"))], ids=lambda p: p.stem)
def test_same_bytes_same_mechanism(path: Path) -> None:
    assert read_mechanism(path.read_bytes(), "f") == read_mechanism(path.read_bytes(), "f")


def test_overrides_in_every_voice() -> None:
    overrides: dict[str, str | float | bool] = {
        "contacts.hard.normal.geometry": "external",
        "contacts.wet.film.as_printed": True,
        "contacts.wet.normal.restitution": 0.25,  # inherited: the file has no such key
        "bodies.crank.length": "2 * r",
        "bodies.crank.com.x": "10 mm",
        "bodies.slider.com.y": 1e-5,
        "start.guess.rod.theta": "-5 deg",
        "start.rates.rod.omega": 1,
        "gravity.x": "1 m/s^2",
        "r": 0.06,
        "scenes.knock.simulate.t_end": "3 s",
        "ground.rail.y": 0,
    }
    changed = read("slider_crank", overrides=overrides)
    wet = changed.scenes["oiled"].play["pin"].contact
    assert wet.normal is not None and wet.film is not None
    assert wet.normal.options["geometry"] == "external" and wet.film.options["as_printed"] is True
    assert value(changed, wet.normal.quantities["restitution"]) == 0.25
    crank, com = changed.bodies["crank"], changed.bodies["slider"].com
    assert crank.length is not None and value(changed, crank.length) == 0.12
    assert crank.com is not None and value(changed, crank.com[0]) == 0.01
    assert com is not None and (value(changed, com[0]), value(changed, com[1])) == (0.005, 1e-5)
    assert value(changed, changed.start.guess["rod.theta"]) == pytest.approx(-math.pi / 36, rel=1e-15)
    assert value(changed, changed.start.rates["rod.omega"]) == 1.0
    assert changed.gravity is not None and value(changed, changed.gravity[0]) == 1.0
    assert value(changed, changed.scenes["oiled"].simulate["t_end"]) == 3.0
    assert changed.ground["rail"][1].is_zero
    assert changed.sha256 == read("slider_crank").sha256


def test_override_leaves_an_anchored_twin_alone() -> None:
    changed = read("slider_crank", overrides={"materials.steel_too.nu": 0.2})
    bearing = changed.scenes["knock"].play["pin"].bearing
    (followed,) = bearing.journal_material.numbers["nu"].operands
    assert followed.address == "materials.steel_too.nu"
    assert value(changed, followed) == 0.2
    twin = read("slider_crank", overrides={"materials.steel.nu": 0.2})
    assert value(twin, twin.materials["steel_too"].numbers["nu"]) == 0.3


@pytest.mark.parametrize(
    ("address", "nearest"),
    [
        ("bodies.crnak.mass", "bodies.crank.mass"),
        ("bodies.crank.maas", "bodies.crank.mass"),
        ("contacts.wet.film.viscocity", "contacts.wet.film.viscosity"),
        ("speeed", "speed"),
        ("gravity.z", "gravity.y"),
        ("bodies.crank.mass.x", "bodies.crank.mass"),
        ("", None),
        ("...", None),
    ],
)
def test_unknown_address_names_the_nearest(address: str, nearest: str | None) -> None:
    with pytest.raises(UnknownNameError) as caught:
        read("slider_crank", overrides={address: 1.0})
    assert nearest is None or f"did you mean {nearest!r}" in caught.value.hint


def test_override_is_checked_like_the_file() -> None:
    with pytest.raises(InputError, match="override of bodies.crank.mass:1:1: .*expected a mass"):
        read("slider_crank", overrides={"bodies.crank.mass": "1 m"})
    with pytest.raises(BadValueError, match="a mass is positive"):
        read("slider_crank", overrides={"bodies.crank.mass": -1})
    with pytest.raises(BadValueError, match="is a mapping"):
        read("slider_crank", overrides={"bodies.crank": 1})
    with pytest.raises(InputError):
        read("slider_crank", overrides={"bodies.crank.mass": math.nan})
    with pytest.raises(BadValueError, match="of type NoneType"):
        read("slider_crank", overrides={"bodies.crank.mass": None})


def test_all_errors_of_a_file_at_once() -> None:
    text = (VALID / "double_pendulum.yaml").read_text()
    for right, wrong in (("142 kg", "142 m"), ("L2.tail", "L9.tail"), ("angle: L1", "angle: L0"), ("0.15", "-1")):
        assert right in text
        text = text.replace(right, wrong)
    with pytest.raises(InputErrors) as caught:
        read_mechanism(text.encode(), "many.yaml")
    kinds = [type(error).__name__ for error in caught.value.errors]
    assert kinds == ["UnitError", "UnknownNameError", "UnknownNameError", "BadValueError"]
    places = [error.where for error in caught.value.errors]
    assert places == sorted(p for p in places if isinstance(p, Location))
    assert caught.value.exit_code == 2 and str(caught.value).count("many.yaml:") == 4


def test_wrong_shapes_do_not_hide_other_mistakes() -> None:
    """A wrong shape leaves out its entry alone, and no error follows from that."""
    text = (VALID / "double_pendulum.yaml").read_text()
    for right, wrong in (
        ("L2: {length: 250 mm, mass", "L2: {length: [250 mm], mas"),  # L2 is used in A, start, outputs
        ("steel: {E: 206 GPa, nu: 0.3}", "steel: 7"),  # and steel in pin
        ("omega: 2*pi rad/s", "omega: 2*pi rad/s\n  omega: 1"),  # twice
        ("  crank: {angle: L1, value: omega * t}", "  crank: {angle: L1, value: omega}"),
        ("ground: {O1: [0, 0]}", "ground: {O1: [0, 1 kg]}"),
        ("friction: {law: modified_coulomb, mu: 0.15", "friction: {law: modified_coulomb, mu: -1"),
        ("gravity: [0, -9.81 m/s^2]", "gravity: 9.81"),
        ("outputs: {tip: L2.head.x}", "outputs: {tip: L2.head.x, top: L1.head.z}\nextra: {a: 1}"),
    ):
        assert right in text
        text = text.replace(right, wrong)
    with pytest.raises(InputErrors) as caught:
        read_mechanism(text.encode(), "many.yaml")
    found = [(type(error).__name__, str(error.where)) for error in caught.value.errors]
    assert found == [
        ("BadValueError", "many.yaml:3:10"),
        ("UnknownKeyError", "many.yaml:6:3"),
        ("BadValueError", "many.yaml:9:10"),
        ("BadValueError", "many.yaml:12:16"),
        ("UnknownKeyError", "many.yaml:12:26"),
        ("UnitError", "many.yaml:13:18"),
        ("UnitError", "many.yaml:18:29"),
        ("BadValueError", "many.yaml:26:43"),
        ("UnknownKeyError", "many.yaml:34:1"),
    ]


def test_where_nothing_can_be_read_the_shape_alone_is_told() -> None:
    for text in ("format: gudgeon/1\nname: n\nbodies: 3\njoints: 4", "format: gudgeon/1\njoints: {A: {b: 1}}"):
        with pytest.raises(InputErrors) as caught:
            read_mechanism(text.encode(), "f")
        assert len(caught.value.errors) == 2


def test_a_file_of_mistakes_is_left_after_fifty() -> None:
    bodies = "".join(f"  B{i}: {{mass: 1 m, inertia: x{i}}}\n" for i in range(1000))
    with pytest.raises(InputErrors) as caught:
        read_mechanism(f"format: gudgeon/1\nname: wrong\nbodies:\n{bodies}".encode(), "f")
    assert len(caught.value.errors) == 50


def test_empty_sections_are_no_sections() -> None:
    text = (VALID / "double_pendulum.yaml").read_text()
    mechanism = read_mechanism(text.replace("outputs: {tip: L2.head.x}", "outputs:").encode(), "f")
    assert mechanism.outputs == {}


def test_dimension_of_angles_is_none(press: Mechanism) -> None:
    assert press.drives["crank1"].value.dimension == DIMENSIONLESS


def test_a_massless_body_is_refused_with_what_to_write() -> None:
    text = """format: gudgeon/1
name: m
bodies: {rod: {length: 1 m, MASS, inertia: 0}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, rod.tail]}}
"""
    message = r"(?s)m.yaml:3:35: .*a mass is positive\n.*equations divide.*com:.*inertia: 0"
    with pytest.raises(BadValueError, match=message):
        read_mechanism(text.replace("MASS", "mass: 0 kg").encode(), "m.yaml")
    read_mechanism(text.replace("MASS", "mass: 2 kg, com: [1 m, 0]").encode(), "m.yaml")

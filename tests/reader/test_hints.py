"""What newcomers write first, and what they are told: the word that is used here, the section, the line to write."""

from __future__ import annotations

import pytest

from gudgeon.errors import (
    BadNameError,
    BadValueError,
    ExpressionError,
    InputError,
    InputErrors,
    MissingKeyError,
    UnitError,
    UnknownKeyError,
    UnknownNameError,
)
from gudgeon.generator.format.sections import MECHANISM_FILE
from gudgeon.generator.mechanism import Mechanism
from gudgeon.generator.reader.materials import EXAMPLE_SECTION
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.units import INERTIA
from tests.scenes import patched

TEXT = """
format: gudgeon/1
name: plain
bodies:
  crank: {length: 50 mm, mass: 0.3 kg, inertia: 1e-4 kg*m^2}
  rod: {length: 120 mm, mass: 0.21 kg, inertia: 2.5e-4 kg*m^2}
  piston: {mass: 0.14 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, piston.origin]}
  cylinder: {translational: [ground.O, piston.origin], axis: [1, 0]}
drives:
  motor: {angle: crank, value: 30 deg + 5 rad/s * t}
forces:
  coil: {spring_damper: [ground.O, piston.origin], stiffness: 3 N/m}
start: {guess: {piston.x: 160 mm}}
materials: {steel: {E: 207 GPa, nu: 0.3}}
bearings: {bush: {radius: 10 mm, clearance: 0.2 mm, length: 20 mm, bearing_material: steel, journal_material: steel}}
contacts:
  dry: {normal: {law: hertz, stiffness: 1e9, restitution: 0.8, dissipation: flores}}
scenes: {worn: {play: {wristpin: {bearing: bush, contact: dry}}}}
""".lstrip()


def read(old: str, new: str) -> Mechanism:
    return read_mechanism(patched(TEXT, (old, new)).encode(), "f.yaml")


def refused(old: str, new: str) -> InputError:
    """The error, which stands where ‸ is in `new`."""
    text = TEXT.replace(old, new)
    line, rest = text[: text.index("‸")].count("\n") + 1, text[: text.index("‸")].rpartition("\n")[2]
    with pytest.raises(InputError) as caught:
        read(old, new.replace("‸", ""))
    error = caught.value
    assert error.where is not None and (error.where.line, error.where.column) == (line, len(rest) + 1), error
    return error


KINDS = [
    (section, other, kind)
    for section in ("joints", "drives", "forces")
    for kind, of in next(f for f in MECHANISM_FILE.fields if f.name == section).entry.kinds().items()  # type: ignore[union-attr, misc]
    for other in of.foreign_names
]


def test_kinds_that_people_call_otherwise_are_known() -> None:
    called = {(other, kind) for _, other, kind in KINDS}
    expected = (
        "pin revolute",
        "hinge revolute",
        "prismatic translational",
        "slider translational",
        "weld rigid",
        "fixed rigid",
        "link distance",
        "rod distance",
        "moment torque",
        "spring spring_damper",
    )
    assert {tuple(pair.split()) for pair in expected} <= called
    for section in ("joints", "drives", "forces"):
        names = [other for where, other, _ in KINDS if where == section]
        kinds = {kind for where, _, kind in KINDS if where == section}
        assert len(names) == len(set(names)) and not kinds & set(names)


OLD = {
    "joints": "{revolute: [ground.O, crank.tail]}",
    "drives": "{angle: crank,",
    "forces": "{spring_damper: [ground.O, ",
}


@pytest.mark.parametrize(("section", "other", "kind"), KINDS)
def test_the_kind_that_is_meant_is_told(section: str, other: str, kind: str) -> None:
    head, _, tail = OLD[section].partition(":")
    error = refused(OLD[section], f"{{‸{other}:{tail}")
    assert type(error) is UnknownKeyError and error.hint == f"{other!r} is called {kind} here"


def test_a_kind_in_capitals_is_told_too() -> None:
    assert "called revolute here" in refused("{revolute: [ground.O,", "{‸Pin: [ground.O,").hint


@pytest.mark.parametrize("key", ["play", "clearance", "bearing", "contact"])
def test_play_inside_a_joint_points_to_scenes(key: str) -> None:
    error = refused("[ground.O, crank.tail]}", f"[ground.O, crank.tail], ‸{key}: 0.2 mm}}")
    assert type(error) is UnknownKeyError
    line = "scenes: {worn: {play: {shaft: {bearing: bush, contact: dry}}}}"
    assert error.hint == f"play belongs in scenes: {line}"
    read("scenes: {worn: {play: {wristpin: {bearing: bush, contact: dry}}}}", line)  # it can be written


def test_three_points_in_a_revolute_are_two_joints() -> None:
    error = refused("[crank.head, rod.tail]", "‸[crank.head, rod.tail, piston.origin]")
    assert type(error) is BadValueError and "revolute has 3 points" in error.message
    pairs = "A: {revolute: [crank.head, rod.tail]}, B: {revolute: [crank.head, piston.origin]}"
    assert error.hint.endswith(f"write 3 bodies on one pin as 2 joints: {pairs}")
    read(
        "shaft: {revolute: [ground.O, crank.tail]}",
        "\n  ".join(["shaft: {revolute: [ground.O, crank.tail]}", *pairs.replace("}, B", "}|B").split("|")]),
    )


@pytest.mark.parametrize(
    ("start", "hint"),
    [
        ("set: {crank.‸omega: 3 rad/s}", "velocities belong under rates: start: {rates: {crank.omega: 3 rad/s}}"),
        ("guess: {piston.‸vx: 1 m/s}", "velocities belong under rates: start: {rates: {piston.vx: 1 m/s}}"),
        ("rates: {crank.‸theta: 30 deg}", "coordinates belong under set: start: {set: {crank.theta: 30 deg}}"),
    ],
)
def test_a_rate_under_set_points_to_rates(start: str, hint: str) -> None:
    error = refused("start: {guess: {piston.x: 160 mm}}", f"start: {{{start}}}")
    assert type(error) is UnknownNameError and error.hint == hint
    read("start: {guess: {piston.x: 160 mm}}", hint.partition("under ")[2].partition(": ")[2])


def test_units_without_a_space_and_as_people_write_them() -> None:
    for text in ("120mm", "0.12m", "12cm"):
        assert read("length: 120 mm", f"length: {text}").bodies["rod"].length.value.value == 0.12  # type: ignore[union-attr]
    inertia = read("2.5e-4 kg*m^2", "2.5e-4 kg m²").bodies["rod"].inertia
    assert inertia.value.value == 2.5e-4 and inertia.dimension == INERTIA  # type: ignore[union-attr]


@pytest.mark.parametrize("number", ["60 rmp", "60rmp"])
def test_a_mistyped_unit_is_told_with_a_space_and_without(number: str) -> None:
    assert "rpm'?" in refused("5 rad/s", number.replace("r", "‸r", 1)).hint


def test_a_play_that_is_a_number_is_told_once_and_what_it_holds() -> None:
    key = "{bearing: bush, contact: dry}"
    text = TEXT.replace("start: {guess", "start: {play: {wristpin: {e: [0.1 mm, 0]}}, guess").replace(key, "0.2 mm")
    with pytest.raises(BadValueError, match=r"scenes\.worn\.play\.wristpin is '0\.2 mm'") as caught:
        read_mechanism(text.encode(), "f.yaml")
    assert caught.value.hint == "expected a mapping: {bearing: …, contact: …}"


def test_a_unit_that_is_a_parameter_too_is_refused_where_it_stands() -> None:
    head = "name: plain\n"
    with pytest.raises(InputError, match=r"f.yaml:3:\d+: '2m' can mean two things: m is a unit, and a parameter here"):
        read(head, f"{head}parameters: {{m: 3 kg, M: 2m}}\n")
    read(head, f"{head}parameters: {{m: 3 kg, M: 2 m}}\n")


# --- laws ---------------------------------------------------------------------------------------------------------

HERTZ = "{law: hertz, stiffness: 1e9, restitution: 0.8, dissipation: flores}"


def normal(mechanism: Mechanism) -> object:
    law = mechanism.scenes["worn"].play["wristpin"].contact.normal
    assert law is not None
    return law.law, {name: q.value.value for name, q in law.quantities.items()}, law.options  # type: ignore[union-attr]


@pytest.mark.parametrize("name", ["flores", "hunt_crossley", "gonthier", "hu_guo"])
def test_a_damping_names_a_law(name: str) -> None:
    """`law: flores` is Hertz' with that damping, and K follows from materials unless it is given."""
    own = read(HERTZ, f"{{law: {name}, restitution: 0.8, geometry: internal}}")
    written = read(HERTZ, f"{{law: hertz, restitution: 0.8, geometry: internal, dissipation: {name}}}")
    assert normal(own) == normal(written)
    assert normal(own) == (
        "hertz",
        {"exponent": 1.5, "restitution": 0.8},
        {"dissipation": name, "geometry": "internal", "pulls": False},
    )
    given = normal(read(HERTZ, f"{{law: {name}, restitution: 0.8, stiffness: 1e9}}"))
    assert given == (
        "hertz",
        {"stiffness": 1e9, "exponent": 1.5, "restitution": 0.8},
        {"dissipation": name, "pulls": False},
    )


def test_a_damping_asks_for_its_restitution() -> None:
    """Hertz' own default, 1, would be no damping at all."""
    error = refused(HERTZ, "‸{law: flores}")
    assert type(error) is MissingKeyError and "no restitution" in error.message
    assert "dissipation" in refused(HERTZ, "{law: flores, restitution: 0.8, ‸dissipation: hu_guo}").message


def test_geometry_beside_a_stiffness_says_nothing() -> None:
    error = refused(HERTZ, "{law: hertz, stiffness: 1e9, ‸geometry: internal}")
    assert type(error) is BadValueError and "both stiffness and geometry" in error.message


@pytest.mark.parametrize("unit", ["N/m^1.5", "N/m^(3/2)"])
def test_units_of_a_stiffness(unit: str) -> None:
    law = read(HERTZ, f"{{law: flores, restitution: 0.8, stiffness: 2 k{unit}}}")
    assert normal(law)[1]["stiffness"] == 2000.0  # type: ignore[index]
    read("name: plain\n", f"name: plain\nparameters: {{K: 1e9 {unit}}}\n")


@pytest.mark.parametrize(
    ("unit", "more"), [("N/m", ""), ("kg", ""), ("N/m^1.5", ", exponent: 2"), ("N/m", ", exponent: 3/2")]
)
def test_a_stiffness_by_another_power_than_the_exponent(unit: str, more: str) -> None:
    """It would be taken as SI of the law's power, silently."""
    error = refused(HERTZ, f"{{law: flores, restitution: 0.8, stiffness: ‸1e9 {unit}{more}}}")
    assert type(error) is UnitError and "expected a" in error.message


@pytest.mark.parametrize(
    "more", ["N/m^2, exponent: 2", "N/m, exponent: 1.0", "N/m^1.5, exponent: 1.2", ", exponent: 2"]
)
def test_a_stiffness_by_the_power_of_its_exponent(more: str) -> None:
    """1.2: no unit can be written for it, and none is asked for."""
    law = read(HERTZ, f"{{law: flores, restitution: 0.8, stiffness: 1e9 {more}}}")
    assert normal(law)[1]["stiffness"] == 1e9  # type: ignore[index]


def test_none_is_no_law() -> None:
    with pytest.raises((InputError, InputErrors), match="unknown normal law 'none'"):
        read(HERTZ, "{law: none, restitution: 0.8}")


@pytest.mark.parametrize(
    ("old", "new", "kind", "message"),
    [
        ("name: plain", "name: ‸plain-one", BadNameError, "such as plain_one"),
        ("forces:\n", "‸springs:\n", UnknownKeyError, "'springs' is called forces here"),
        ("{guess: {piston.x: 160 mm}}", "{guess: {‸piston: 160 mm}}", UnknownNameError, "piston.x, piston.y"),
        ("5 rad/s * t}", "5 rad/s * ‸time}", ExpressionError, "the time is written t"),
        ("name: plain\n", "name: plain\nparameters: {‸é: 1}\n", BadNameError, "in ASCII"),
        ("mass: 0.21 kg", "‸<<: {mass: 1 kg}", UnknownKeyError, "write the keys out; a contact or a scene"),
        ("restitution: 0.8", "restitution: 80 ‸%", ExpressionError, "90 % as 0.9"),
        ("contact: dry}}}", "contact: dry}}, simulate: {‸method: rk4}}", UnknownKeyError, "gudgeon run, --method"),
    ],
)
def test_words_and_signs_of_elsewhere(old: str, new: str, kind: type[InputError], message: str) -> None:
    error = refused(old, new)
    assert type(error) is kind and message in error.hint


@pytest.mark.parametrize("name", ["lambda", "sin", "None", "1a", "a-b", "é"])
def test_a_name_that_is_refused_is_told_once(name: str) -> None:
    """Where it is defined, and not where it is used; what is wrong elsewhere is told all the same."""
    text = TEXT.replace("clearance: 0.2 mm", f"clearance: 2 * {name} - 1 mm")
    text = text.replace("name: plain\n", f"name: plain\nparameters: {{{name}: 0.2 mm}}\n")
    with pytest.raises(BadNameError, match=f"'{name}' cannot name this parameter"):
        read_mechanism(text.encode(), "f.yaml")
    with pytest.raises(InputErrors) as caught:
        read_mechanism(text.replace("length: 20 mm", "length: sine(1) m").encode(), "f.yaml")
    assert [type(e) for e in caught.value.errors] == [BadNameError, ExpressionError]


def test_a_decimal_comma_and_an_equals_sign() -> None:
    error = refused("length: 120 mm", 'length: "0‸,12 m"')
    assert isinstance(error, ExpressionError) and error.hint == "a number is written with a point: 0.12"
    assert "expected an operator" in refused("length: 120 mm", 'length: "L‸, 2"').hint
    error = refused("scenes: {", "parameters: {‸omega = 600 rpm}\nscenes: {")
    assert isinstance(error, BadNameError) and error.hint == "a value follows a colon: omega: 600 rpm"


def test_a_material_where_there_is_none() -> None:
    with pytest.raises(InputErrors) as caught:
        read("materials: {steel: {E: 207 GPa, nu: 0.3}}\n", "")
    assert [str(e.hint) for e in caught.value.errors] == [f"add it: {EXAMPLE_SECTION}"] * 2
    read("materials: {steel: {E: 207 GPa, nu: 0.3}}", EXAMPLE_SECTION)

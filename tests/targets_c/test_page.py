"""The emitted C as a page that is read: its blemishes by name, laws once a scene, a README that names each file."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from hashlib import sha256
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import gudgeon
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.targets import line_breaks
from gudgeon.generator.targets.c import printer
from gudgeon.generator.targets.c.parameter_fields import format_dimension
from gudgeon.generator.targets.c.printer import WIDTH, break_code, wrap_file
from gudgeon.language import units
from gudgeon.loading.shipped import read_committed_source
from tests.slow import slow_but

SHIPPED = Path(str(resources.files("gudgeon.mechanisms")))
VALID = Path(__file__).resolve().parents[1] / "mechanisms" / "valid"
FILES = {path.stem: path for folder in (VALID, SHIPPED) for path in sorted(folder.glob("*.yaml"))}
SCENES = [(name, scene) for name, path in FILES.items() for scene in read_mechanism(path.read_bytes(), name).scenes]
# not far from others, and large
RARE = [*(("every_kind", scene) for scene in ("latest", "sooner")), *(of for of in SCENES if "designed" in of[0])]

KERNELS = ("parameters.c", "constraints.c", "clearance.c", "dynamics.c", "reduced.c", "newton.c", "lanes.c")
# What a reader stumbles over; in every file, or in what is printed from equations.
ANYWHERE = {
    "an empty statement behind a jump": r"goto \w+; *\};",
    "a number in brackets as a factor": r"\(\d+\.\d+\)\*",
    "a number compared with a share of itself": r"\b(\w+)\)? > [\d.e-]+ \* (?:lanes_)?(?:fabs\()?\1\b",
    "pi by its digits": r"(?<!PI )\b3\.14159\d+",
    "a share of pi by its digits": r"\b(?:1\.5707963|4\.7123889|6\.2831853|0\.5235987|1\.0471975|0\.7853981)\d+",
    "a threshold by its digits": r" (?:1e-\d+|3\.16\d+e-07) \* \w*(?:scale|size|bound|pivot)_",
    "a type and its name on two lines": r"\b(?:const|double|int|Lanes|ContactState|Parameters|DiscreteState|RhsOutputs)"
    r" *\n *\w+[,)]",
    "a row of a table on two lines": r"\{\d+,\n",
    "something behind a comment that ends": r"\*/static",
    "a loop over nothing": r"int k = (\d+); k < \1;",
    "a number that is set and set again": r"(\*\w+) = (?:broadcast\()?0\.0\)?;\n *\1 = ",
    "a name that another has taken": r"\b\w+_[xy]_2_\b",
}
IN_KERNELS = {
    "a copy of an argument": r"const (?:double|Lanes|Interval) (?:(\w+) = p->\1|\w+ = t);",
    "a conditional in a conditional": r"\?[^;?{,]*\?[^;]*;",
    "a number of the run copied before it is kept": r"const double (\w+) = [^;]*;[^\n]*\n    p->\1 = \1;",
}


@cache
def emitted(name: str, scene: str) -> KernelSource:
    """A shipped one as it is committed: tests/test_generated.py says that it is what is generated."""
    data = FILES[name].read_bytes()
    return read_committed_source(name, scene, sha256(data).hexdigest()) or generate_kernel_source(data, name, scene)


def c_files(name: str, scene: str) -> dict[str, str]:
    return {file: text for file, text in emitted(name, scene).files.items() if file.endswith((".c", ".h"))}


@pytest.mark.parametrize("of", slow_but([of for of in SCENES if of not in RARE], SCENES), ids="-".join)
def test_every_scene(of: tuple[str, str]) -> None:
    """Each is printed once, and looked at for all."""
    name, scene = of
    no_line_is_too_long(name, scene)
    no_blemish(name, scene)
    each_number_has_a_line_that_says_what_it_is(name, scene)
    a_law_stands_once(name, scene)
    readme_names_every_file(name, scene)


def no_line_is_too_long(name: str, scene: str) -> None:
    for file, text in c_files(name, scene).items():
        assert [line for line in text.split("\n") if len(line) > WIDTH] == [], file


def no_blemish(name: str, scene: str) -> None:
    for file, text in c_files(name, scene).items():
        bare = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
        anywhere = {} if file == "curves.c" else ANYWHERE  # a table holds what the file says, multiples of pi too
        if file in ("taylor.c", "lanes.c") and "taylor.c" in c_files(name, scene):  # the motion is derived again
            anywhere = {k: pattern for k, pattern in anywhere.items() if k != "a name that another has taken"}
        for blemish, pattern in (anywhere | (IN_KERNELS if file in KERNELS else {})).items():
            found = re.search(pattern, bare)
            assert found is None, f"{file}: {blemish}: {found[0]}"


def each_number_has_a_line_that_says_what_it_is(name: str, scene: str) -> None:
    source = emitted(name, scene)
    struct = re.search(r"struct Parameters \{\n([^}]*)\};", source.files["model.h"])
    assert struct
    fields = re.sub(r"^( *)/\* (.*) \*/\n( *double \w+;)$", r"\3  /* \2 */", struct[1], flags=re.M)
    lines = [re.fullmatch(r"    double \w+;  /\* (.+) \*/", line) for line in fields.splitlines()]
    assert len(lines) == len(source.parameters) + len(source.derived) and all(lines)
    for slot, line in zip(source.parameters, lines, strict=False):
        message = line and re.fullmatch(re.escape(slot.address) + r", (?:[\w ]+, )?([\w^/()*.]+)", line[1])
        assert message and not re.search(r"kg.*s", message[1]), "units have names"


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("steel_E", "Pa"),
        ("steel_nu", "1"),
        ("crank_mass", "kg"),
        ("crank_inertia", "kg*m^2"),
        ("dry_pin_K", "N/m^1.5"),
        ("velocity_floor", "m/s"),
        ("dry_pin_friction_slope", "s/m"),
        ("two_alpha", "1/s"),
        ("beta_squared", "1/s^2"),
        ("pin_length", "m"),
        ("guess_slider_x", "m"),
    ],
)
def test_units_as_people_write_them(name: str, unit: str) -> None:
    header = emitted("slider_crank", "dry").files["model.h"]
    assert re.search(rf"double {name}_;  /\* .*, {re.escape(unit)} \*/", header)


@pytest.mark.parametrize(
    ("of", "unit"),
    [
        (units.FORCE, "N"),
        (units.TORQUE, "N*m"),
        (units.POWER, "W"),
        (units.STIFFNESS, "N/m"),
        (units.DAMPING, "N*s/m"),
        (units.VISCOSITY, "Pa*s"),
        (units.DAMPING * units.LENGTH, "N*s"),
        (units.TORQUE * units.TIME, "N*m*s"),
        (units.DAMPING / units.LENGTH ** Fraction(3, 2), "N*s/m^2.5"),
        (units.ACCELERATION, "m/s^2"),
        (units.LENGTH ** Fraction(-1, 3), "1/m^(1/3)"),
    ],
)
def test_units_of_every_kind(of: units.Dimension, unit: str) -> None:
    assert format_dimension(of) == unit


def test_a_law_says_the_unit_that_hangs_on_an_exponent() -> None:
    header = emitted("bouncing_ball", "elastic").files["model.h"]
    assert "/* contacts.elastic.normal.stiffness, force at unit penetration, N/m^n */" in header


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (math.pi, "PI"),
        (-math.pi / 2, "-PI/2.0"),
        (20 * math.pi, "20.0*PI"),
        (math.pi / 6, "PI/6.0"),
        (math.radians(7), "7.0*PI/180.0"),
        (3.4814082589530893, "3.4814082589530893"),
        (0.5, "0.5"),
        (1e9, "1000000000.0"),
        (math.nextafter(math.pi / 6, 1), repr(math.nextafter(math.pi / 6, 1))),
    ],
)
def test_pi_by_name_to_the_bit(number: float, text: str) -> None:
    """And in a product as one number."""
    x, one = sp.Symbol("x"), sp.Float(number, 17)
    assert printer.print_expression(one) == text
    assert float(eval(text, {"PI": math.pi})) == number
    product = printer.print_expression(one * x)
    sign, size = ("-" if number < 0 else ""), text.removeprefix("-")
    assert product == f"{sign}({size})*x" if "/" in text or "*" in text else f"{text}*x"
    assert eval(product, {"PI": math.pi, "x": 0.7}) == number * 0.7
    assert eval(printer.print_expression(x + one), {"PI": math.pi, "x": 0.7}) == 0.7 + number


def test_a_ratio_of_pi_is_one_number() -> None:
    assert printer.print_expression(sp.pi / 2) == "PI/2.0" and printer.print_expression(-3 * sp.pi / 4) == "-3.0*PI/4.0"
    with_x = printer.print_expression(sp.pi * sp.Symbol("x") / 2)
    assert eval(with_x, {"PI": math.pi, "x": 0.7}) == 0.5 * math.pi * 0.7


def test_angles_and_speeds_of_the_file() -> None:
    numbers = {scene: emitted(*scene).files["parameters.c"] for scene in (("slider_crank", "dry"), ("shaker", "ideal"))}
    assert "20.0*PI;" in numbers["slider_crank", "dry"] and "60.0*PI;" in numbers["shaker", "ideal"]


def test_the_place_of_every_unit_of_lanes_is_said() -> None:
    text = emitted("pendulum", "ideal").files["lanes.c"]
    assert re.search(r"/\* [^/]*meanings and units of Parameters in model\.h\. \*/\ntypedef struct L", text)


@pytest.mark.parametrize("scene", ["ideal", "elastic", "damped"])
def test_a_function_of_nothing_says_so(scene: str) -> None:
    """A body of `(void)` alone has one line of them, and a word."""
    text = emitted("bouncing_ball", scene).files["reduced.c"]
    assert re.search(r"^void closures\([^{]*\{\n    \(void\)t, .*;\n    /\* this scene has none \*/\n\}", text, re.M)
    assert not re.search(r"\(void\)\w+;\n *\(void\)", text)


def a_law_stands_once(name: str, scene: str) -> None:
    """What joints differ in are its numbers: no function of a law has a joint's name."""
    source = emitted(name, scene)
    for file in ("clearance.c", "newton.c", "lanes.c"):
        text = source.files.get(file, "")
        bodies = re.findall(r"static inline void (\w+)\((?:[^{]*)\)\n(\{.*?^\})", text, flags=re.S | re.M)
        assert len(dict(bodies)) == len(bodies) == len({body for _, body in bodies}), file
        for joint in source.clearances:
            assert not [function for function, _ in bodies if re.search(rf"_{joint.name}(_|$)", function)], file


def test_two_joints_call_the_same_law() -> None:
    text = emitted("nine_bar_press", "lubricated").files["clearance.c"]
    firsts = {"lankarani_nikravesh": (0, 8), "modified_coulomb": (1, 9), "pinkus_sternlicht": (5, 13)}
    for law, corners in firsts.items():
        assert len(re.findall(rf"static inline void {law}\(", text)) == 1
        called = re.findall(rf"^    {law}\(([^;]*)\);", text, flags=re.M)
        assert [int(k) for call in called for k in re.findall(r"g,\s+(\d+),\s+&", call)] == list(corners)
        assert all("p->oil_" in call for call in called)


def test_joints_with_other_bearings_and_contacts_share_a_law(tmp_path: Path) -> None:
    """Each is given its own numbers: with those of the first ones the motion is that of the shipped scene."""
    text = FILES["nine_bar_press"].read_text(encoding="utf-8")
    pin, oil = re.search(r"  pin: (.*)\n", text), re.search(r"  dry:\n(    .*\n)+", text)
    assert pin and oil
    able = oil[0].replace("  dry:", "  able:") + (
        "    film: {law: pinkus_sternlicht, viscosity: 100 cP}\n    transition: 5 um\n"
    )
    text = text.replace("contacts:\n", f"  wide: {pin[1]}\n\ncontacts:\n{able}")
    text = text.replace("B: {bearing: pin, contact: oil}", "B: {bearing: wide, contact: able}")
    path = tmp_path / "press.yaml"
    path.write_text(text, encoding="utf-8")
    other, shipped = gudgeon.load(path, "lubricated"), gudgeon.load("nine_bar_press", "lubricated")
    code = other.source.files["clearance.c"]
    for law in ("lankarani_nikravesh", "modified_coulomb", "pinkus_sternlicht"):
        first, second = re.findall(rf"^    {law}\(([^;]*)\);", code, flags=re.M)
        assert len(re.findall(rf"void {law}\w*\(", code)) == 1
        assert "p->oil_" in first and "p->able_" in second and not re.search("p->(oil|pin)_", second)
    rng, start = np.random.default_rng(7), shipped.start()
    for _ in range(8):
        away = [scale * rng.normal(size=24) for scale in (3e-4, 0.1)]  # A and B in the film and in contact
        y = np.concatenate([start.q + away[0], start.v + away[1]])
        np.testing.assert_allclose(other.rhs(0.0, y), shipped.rhs(0.0, y), rtol=1e-9, atol=1e-9)


def test_laws_of_other_options_are_other_functions() -> None:
    text = VALID.joinpath("slider_crank.yaml").read_text(encoding="utf-8")
    assert text.count("shear: true") == 1
    shear, plain = (
        generate_kernel_source(x.encode(), "f", "oiled").files["clearance.c"]
        for x in (text, text.replace("shear: true", "shear: false"))
    )
    assert "void pinkus_sternlicht_shear_relative(" in shear and "void pinkus_sternlicht_relative(" in plain


def readme_names_every_file(name: str, scene: str) -> None:
    source = emitted(name, scene)
    text = source.files["README.md"]
    message = re.findall(r"^- `([\w.]+)`: \S.*$", text, flags=re.M)
    assert sorted(message) == sorted({*source.files, "kernel.json"} - {"README.md"})
    assert text.startswith("# ") and "Read `model.h` first" in text
    integrates = "`positions.c`" not in text
    assert integrates == ("Integrated: nothing" not in text)
    assert ("`positions.c`, which a run evaluates" in text) != integrates
    assert integrates == ("`reduced.c`, which a run evaluates" in text or "reduced.c" not in text)


def test_long_lines_are_broken_where_the_fewest_brackets_are_open() -> None:
    line = "    x = " + " + ".join(f"a{k}*(b{k} - c{k})" for k in range(12)) + ";"
    lines = break_code(line)
    assert max(map(len, lines)) <= WIDTH and all(part.startswith("        + ") for part in lines[1:])
    assert "".join(part.strip() + " " for part in lines).split() == line.split()
    number = f"    y = a*{'9' * 150}.0*(b + c);"
    assert "".join(break_code(number)).replace(" ", "") == number.replace(" ", "")


def test_comments_are_wrapped_and_code_in_front_of_them_is_not() -> None:
    words = "word " * 40
    text = f"/*\n * {words}\n */\nint a;  /* {words}*/\n    * 1{'0' * 150}.0;\n"
    fitted = wrap_file(text)
    assert re.sub(r"[\s*]", "", fitted).count("word") == 80 and f"    * 1{'0' * 150}.0;\n" in fitted
    assert [line for line in fitted.split("\n") if len(line) > WIDTH] == [f"    * 1{'0' * 150}.0;"]


def test_a_line_of_a_megabyte_is_read_a_few_times_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each break looks at places up to the width, not at all that follows."""
    looked, places = 0, line_breaks._list_breaks

    def counted(line: str) -> Iterator[tuple[float, int]]:
        nonlocal looked
        for place in places(line):
            looked += 1
            yield place

    monkeypatch.setattr(line_breaks, "_list_breaks", counted)
    terms = 100_000
    lines = break_code("    y = " + " + ".join(f"x_{k}" for k in range(terms)) + ";")
    assert max(map(len, lines)) <= WIDTH and looked < 3 * terms

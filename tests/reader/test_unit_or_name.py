"""A name of the file that is also the symbol of a unit takes precedence in products, whatever the white space."""

from __future__ import annotations

import random
import re

import pytest

from gudgeon.errors import ExpressionError, InputError, UnitError
from gudgeon.generator.reader.parameters import evaluate_parameters
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.tree import evaluate

FILE = """
format: gudgeon/1
name: brake
parameters: {{{parameters}}}
bodies: {{s: {{mass: 2 kg, inertia: 0.05 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{O: {{revolute: [ground.O, s.origin]}}}}
forces: {{brake: {{torque: s, value: {value}}}}}
freedoms: 1
"""


def torque(parameters: str, value: str, **motion: float) -> float:
    """The torque of the file's only force, in N m."""
    mechanism = read_mechanism(FILE.format(parameters=parameters, value=value).encode(), "f.yaml")
    known = {**evaluate_parameters(mechanism.parameters), **{name.replace("_", "."): x for name, x in motion.items()}}
    return float(evaluate(mechanism.forces["brake"].quantities["value"].value, known.__getitem__))


def parameter(parameters: str, name: str) -> float:
    mechanism = read_mechanism(FILE.format(parameters=parameters, value="0").encode(), "f.yaml")
    return evaluate_parameters(mechanism.parameters)[name]


FRICTION = "N: 25 N, mu: 0.3, r: 0.1 m"


@pytest.mark.parametrize(
    "value",
    [
        "-0.1 m*N*mu",
        "-N*0.1 m*mu",
        "-r*N*mu",
        "-0.1 m * N * mu",
        "-(0.1 m)*N*mu",
        "-0.1 m *N* mu",
        "-0.1m*N*mu",
        "-mu*0.1 m*N*1",
    ],
)
def test_a_parameter_precedes_a_unit_in_a_product(value: str) -> None:
    assert torque(FRICTION, value) == pytest.approx(-0.75, rel=1e-15)


@pytest.mark.parametrize(
    ("parameters", "value", "right"),
    [
        ("c: 1 m", "-4 N*s/m*s.omega*1 m^2", -8.0),
        ("c: 1 m", "-4 N*s/m * s.omega * 1 m^2", -8.0),
        ("m: 2 kg, a: 1 m", "-3 m/s^2*m*a", -6.0),
        ("m: 2 kg, a: 1 m", "-3 m/s^2 * m * a", -6.0),
        ("g: 9.81 m/s^2, a: 1 m", "-2 kg*g*a", -19.62),
        ("g: 9.81 m/s^2, a: 1 m", "-2 kg * g * a", -19.62),
        ("m: 2 kg", "3 N*m^1 * s.theta", 9.0),
        ("m: 2 kg", "3 N·m * s.theta", 9.0),
        ("m: 2 kg", "3 N*m*s/rad * s.omega", 6.0),  # s is a body's name alone: nothing but a unit can stand there
    ],
)
def test_products_with_units_and_names(parameters: str, value: str, right: float) -> None:
    assert torque(parameters, value, s_omega=2.0, s_theta=3.0) == pytest.approx(right, rel=1e-15)


def test_a_number_with_its_unit_is_a_quantity() -> None:
    """The textbook's letters: m is a mass, s a length, g an acceleration."""
    letters = "m: 2 kg, s: 0.3 m, g: 9.81 m/s^2, k: 400 N/m, c: 4 N * s / m, v: 5 m/s, J: 1e-4 kg*m^2, w: 2*pi rad/s"
    for name, right in (("k", 400.0), ("c", 4.0), ("v", 5.0), ("J", 1e-4), ("g", 9.81), ("w", 6.283185307179586)):
        assert parameter(letters, name) == right
    assert torque("m: 2 kg", "3 N*m") == torque("m: 2 kg", "3 N * m") == 3.0
    assert parameter("g: 9.81 m/s^2, W: 2 kg*g", "W") == parameter("g: 9.81 m/s^2, W: 2 kg * g", "W") == 19.62
    assert parameter("s: 2 m/s", "s") == 2.0
    assert torque("N: 6 N, m: 2 m", "0.5 m*N") == 3.0  # m*N is not a usual unit


AMBIGUOUS = [
    ("m: 0.5 m", "3 N*m"),
    ("m: 0.5 m", "3 N * m"),
    ("m: 0.5", "-3 N*m"),
    ("s: 2", "3 N*m*s*s.omega"),
    ("m: 2", "(3 N*m) * s.theta"),
]


@pytest.mark.parametrize(("parameters", "value"), AMBIGUOUS)
def test_what_no_dimension_can_decide_is_refused_and_both_remedies_are_accepted(parameters: str, value: str) -> None:
    with pytest.raises(ExpressionError, match="can mean two things") as caught:
        torque(parameters, value)
    found = re.fullmatch(r"write (.*) for the name, (.*) for the unit", caught.value.hint)
    assert found is not None
    other = re.sub(r"\b([mNs])\b:", r"\1_:", parameters)
    named = re.sub(rf"([*/] ?)({parameters[0]})(?![\w.])", r"\1\2_", value)
    assert torque(parameters, found[1], s_omega=2.0, s_theta=3.0) == torque(other, named, s_omega=2.0, s_theta=3.0)
    assert torque(parameters, found[2], s_omega=2.0, s_theta=3.0) == torque("q: 1", value, s_omega=2.0, s_theta=3.0)


def test_a_name_of_another_dimension_is_refused_with_the_reason() -> None:
    with pytest.raises(InputError, match="expected a torque") as caught:
        torque("m: 2 kg", "3 N*m*s.theta")
    assert caught.value.hint == "m is a name of this file: the unit is written m^1"


UNITS = {
    "N": "m*kg/s^2",
    "m": "m",
    "s": "s",
    "g": "g",
    "rad": "rad",
    "J": "kg*m^2/s^2",
    "W": "kg*m^2/s^3",
    "Pa": "Pa",
    "P": "Pa*s",
    "kg": "kg",
    "t_": "s",
    "h": "m",
    "bar": "Pa",
    "mm": "mm",
    "rev": "rad",
    "lb": "kg",
}


def random_product(rng: random.Random, names: list[str], depth: int = 0) -> str:
    """A product of numbers, quantities, names, powers and brackets, without white space round its operators."""
    parts = []
    for k in range(rng.randint(2, 5)):
        kind = rng.random()
        if kind < 0.4:
            unit = rng.choice(["m", "N", "kg", "s", "mm", "rad/s^2", "kg*m^2", "N^1", "m/s^1", "Pa"])
            parts.append(f"{rng.randint(1, 99)}{rng.choice([' ', '.5 '])}{unit}")
        elif kind < 0.75 or depth > 1:
            parts.append(rng.choice(names))
        elif kind < 0.85:
            parts.append(f"{rng.choice(names)}**2")
        elif kind < 0.93:
            parts.append(f"abs({random_product(rng, names, depth + 1)})")
        else:
            parts.append(f"({random_product(rng, names, depth + 1)})")
        parts.append(rng.choice(["*", "*", "/"]) if k else "*")
    return ("-" if rng.random() < 0.2 else "") + "".join(parts[:-1])


def spaced(rng: random.Random, text: str) -> str:
    return re.sub(r"(?<!\*)[*/](?!\*)", lambda x: rng.choice(["", " "]) + x[0] + rng.choice(["", " "]), text)


def renamed(text: str, names: list[str]) -> str:
    """The same product with names that are no units; units stand after a space, a power or the `/` of another unit."""
    return re.sub(rf"(?<![\w.^ ])({'|'.join(names)})(?![\w^])", r"q_\1", text)


@pytest.mark.parametrize("seed", range(6))
def test_random_products_do_not_depend_on_what_parameters_are_called(seed: int) -> None:
    rng, equal, refused = random.Random(seed), 0, 0
    while equal < 40:
        names = rng.sample(sorted(UNITS), 4)
        own = {name: f"{rng.randint(1, 9)}.25 {rng.choice(list(UNITS.values()))}" for name in names}
        text = random_product(rng, names) + "*mu"  # a name of no unit: not a quantity alone
        plain = ", ".join(f"q_{name}: {value}" for name, value in own.items())
        try:
            right = parameter(f"mu: 0.5, {plain}, out: {renamed(text, names)}", "out")
        except UnitError:  # an exponent above 24
            continue
        defined = ", ".join(f"{name}: {powered(value)}" for name, value in own.items())
        for written in (text, spaced(rng, text)):
            try:
                found = parameter(f"mu: 0.5, {defined}, out: {written}", "out")
            except ExpressionError as error:
                assert "can mean two things" in error.message, (written, error)
                refused += 1
                continue
            assert found == right, (defined, written)
            equal += 1
    assert refused < 10


def powered(value: str) -> str:
    """A quantity whose unit holds no symbol that could be a name."""
    return re.sub(r"(?<=[*/])([A-Za-z]+)(?![A-Za-z^])", r"\1^1", value)

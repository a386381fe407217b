"""The NumPy functions against the compiled ones, function by function; and as a user gets them."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import ArrayError, BadValueError, UnitError, UnknownNameError
from gudgeon.generator.kernels.closed_linkage import make_constraint_kernels
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.targets.latex.write import render_equations_text
from gudgeon.generator.targets.numpy import printer
from gudgeon.loading.shipped import find_shipped_file, list_generated_scenes
from gudgeon.simulation.simulation import Simulation
from tests.oracles.linkage_yaml import to_yaml
from tests.oracles.random_linkage import random_case
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
SCENES = [
    (name, scene)
    for name in list_generated_scenes()
    for scene in read_mechanism(find_shipped_file(name).read_bytes(), name, None).scenes
]


@cache
def load(name: str, scene: str) -> Simulation:
    return gudgeon.load(name, scene)


def states(simulation: Simulation, count: int = 4) -> list[tuple[float, np.ndarray, np.ndarray]]:
    """Near the start, journals up to a third of a millimetre out of their centres."""
    rng, start = np.random.default_rng(7), simulation.start()
    return [
        (float(rng.uniform()), start.q + rng.normal(0, 3e-4, start.q.size), start.v + rng.normal(0, 0.1, start.v.size))
        for _ in range(count)
    ]


def close(got: np.ndarray, want: np.ndarray, share: float) -> None:
    np.testing.assert_allclose(got, want, rtol=0, atol=share * max(np.abs(want).max(initial=0.0), 1e-300))


# Film and contact, friction, joints without play; the others have nothing else.
APART = [
    ("nine_bar_press", "lubricated"),
    ("belt_block", "ideal"),
    ("slider_crank_spring", "ideal"),
    ("bouncing_ball", "damped"),
]


@pytest.mark.parametrize("of", slow_but(APART, SCENES), ids="-".join)
def test_shipped_scenes(of: tuple[str, str]) -> None:
    check(load(*of))


def check(simulation: Simulation) -> None:
    """Parameters, start, rows and right-hand side at a few states, in contact and without, in stick and in slip."""
    model, c, p = simulation.model.numpy(), simulation.compiled, simulation.p
    joints, frictions = len(simulation.source.clearances), len(simulation.source.frictions)
    numbers = model.prepare()
    slots = model.model.parameter_table
    names = [slots.find_member_name(slots.entries[slot.address].symbol) for slot in simulation.source.parameters]
    in_c = dict(zip([*names, *(f"{name}_" for name in simulation.source.derived)], p.tolist(), strict=True))
    shared = [name for name in vars(numbers) if name in in_c]
    assert set(names) <= set(shared)
    close(np.array([getattr(numbers, name) for name in shared]), np.array([in_c[name] for name in shared]), 1e-15)
    close(model.mass(numbers), c.mass(p), 1e-15)
    for got, want in zip(model.start_values(numbers), c.start_values(p), strict=True):
        close(got, want, 1e-15)
    for t, q, v in states(simulation):
        near = 4 * np.finfo(float).eps * np.abs(q).max()  # Φ is what is left of places; sines of both differ by an ulp
        np.testing.assert_allclose(model.phi(t, q, numbers), c.closed_phi(t, q, p), rtol=0, atol=near)
        close(model.phi_q(t, q, numbers), c.closed_phi_q(t, q, p), 1e-14)
        close(model.nu(t, q, numbers), c.closed_nu(t, q, p), 1e-14)
        close(model.gamma(t, q, v, numbers), c.closed_gamma(t, q, v, p), 1e-14)
        for rate, mode in ((np.nan, 1.0), (0.05, -1.0), (0.2, 0.0)) if joints or frictions else ((np.nan, 1.0),):
            latches, modes = np.full(joints, rate), np.full(frictions, mode)
            got = model.dynamics(t, q, v, numbers, latches, modes)
            want = c.rhs(t, np.concatenate([q, v]), p, discrete_states=np.concatenate([latches, modes]))
            assert got.status == 0
            close(got.a, want[q.size : 2 * q.size], 1e-12)


@pytest.mark.parametrize("seed", slow_but([5], [1, 5, 9]))
def test_random_linkages(seed: int, tmp_path: Path) -> None:
    file = tmp_path / "random.yaml"
    file.write_text(to_yaml(random_case(seed, bodies=2 + seed % 4, loops=seed % 3, drives=seed % 3)), encoding="utf-8")
    check(gudgeon.load(file))


def test_a_number_that_is_given() -> None:
    model = load("pendulum", "ideal").model.numpy()
    address = next(iter(model.model.parameter_table.entries))
    name = printer.print_name(model.model.parameter_table.entries[address].symbol.name)
    assert getattr(model.prepare({address: 0.125}), name) == 0.125 != getattr(model.prepare(), name)


def test_numbers_are_given_as_for_a_run() -> None:
    """By the parameter's name alone, too, and with units; what nobody has is told with the nearest."""
    simulation = load("slider_crank", "dry")
    model = simulation.model.numpy()
    for spelled in ("omega", "parameters.omega"):
        assert model.prepare({spelled: 1.5}).omega_ == 1.5
    assert model.prepare({"omega": "300 rpm", "c": "0.5 mm"}).c_ == 0.0005
    assert model.prepare({"c": 0.0003}).pin_clearance_ == 0.0003
    with pytest.raises(
        UnknownNameError, match=r"(?s)no parameter of this scene has the address 'omgea'.*nearest: omega"
    ):
        model.prepare({"omgea": 1.0})
    with pytest.raises(BadValueError, match=r"parameters\.omega is given twice"):
        model.prepare({"omega": 1.0, "parameters.omega": 2.0})
    with pytest.raises(BadValueError, match="not one real number"):
        model.prepare({"omega": None})
    with pytest.raises(UnitError):
        model.prepare({"omega": "3 kg"})


def test_a_stiffness_is_given_in_its_unit() -> None:
    """The file writes a bare number: what its unit is the law's exponent says."""
    model = load("bouncing_ball", "damped").model.numpy()
    address = "contacts.damped.normal.stiffness"
    name = printer.print_name(model.model.parameter_table.entries[address].symbol.name)
    assert getattr(model.prepare({address: "1e5 N/mm^1.5"}), name) == pytest.approx(1e5 * 1000**1.5, rel=1e-15)
    with pytest.raises(UnitError, match=r"N/m\^1\.5"):
        model.prepare({address: "1e5 N/mm"})


def test_modes_of_friction_must_be_given() -> None:
    """Without them the compiled right-hand side has no number either: stick would be a guess."""
    simulation = load("belt_block", "ideal")
    model, start, p = simulation.model.numpy(), simulation.start(), simulation.p
    y = np.concatenate([start.q, start.v])
    assert np.isnan(simulation.compiled.rhs(0.0, y, p)[start.q.size]).all()
    numbers = model.prepare()
    with pytest.raises(
        ArrayError, match=r"modes of shape \(0,\): expected \(1,\)\n.*expected one number for each of rub"
    ):
        model.dynamics(0.0, start.q, start.v, numbers)
    for mode in (-1.0, 0.0, 1.0):
        want = simulation.compiled.rhs(0.0, y, p, discrete_states=np.array([mode]))
        got = model.dynamics(0.0, start.q, start.v, numbers, modes=[mode])
        close(got.a, want[start.q.size : 2 * start.q.size], 1e-12)


def test_latches_are_one_each() -> None:
    """None given: every contact is open, as the compiled right-hand side has it."""
    simulation = load("slider_crank", "dry")
    model, numbers = simulation.model.numpy(), simulation.model.numpy().prepare()
    t, q, v = states(simulation)[1]
    want = simulation.compiled.rhs(t, np.concatenate([q, v]), simulation.p)
    close(model.dynamics(t, q, v, numbers).a, want[q.size : 2 * q.size], 1e-12)
    with pytest.raises(ArrayError, match=r"latches of shape \(2,\): expected \(1,\)"):
        model.dynamics(t, q, v, numbers, [0.1, 0.2])
    with pytest.raises(ArrayError, match="this scene has none"):
        model.dynamics(t, q, v, numbers, modes=[0.0])


@pytest.mark.parametrize("of", slow_but(APART, SCENES), ids="-".join)
def test_the_text_is_a_page(of: tuple[str, str]) -> None:
    """No long line, a head that says what this is, rows by their names and units, no power of minus one."""
    name, scene = of
    model = load(name, scene).model.numpy()
    lines = model.source.splitlines()
    assert max(map(len, lines)) <= 100 and not [line for line in lines if line != line.rstrip()]
    head = ast.get_docstring(ast.parse(model.source)) or ""
    plain = " ".join(head.split())
    assert f"scene {scene} of the mechanism {name}" in plain and "SI" in plain and "rad" in plain
    for k, body in enumerate(model.model.bodies):
        place = f"[{3 * k}:{3 * k + 3}]"
        assert f"q{place}, v{place}: {body.name}.x, {body.name}.y, {body.name}.theta" in head
    text = model.source
    for what, per in (("phi", ""), ("nu", "/s"), ("gamma_rows", "/s^2")):
        for r, row in enumerate(model.model.all_rows):
            message = re.escape(f"# {row.name}, {row.unit}{per}") + r"(?:; (?:open, \w+ has play|redundant\b.*))?"
            assert re.search(rf"^    {what}\[{r}\] = .*  {message}$|^    {message}\n    {what}\[{r}\] = ", text, re.M)
    assert "**(-1)" not in text and not re.search(r"> \d[\d.e-]+ \*|1/2\*np\.pi", text)
    assert "a pivot vanished" not in text


def test_names_of_thresholds_and_pi() -> None:
    text = load("slider_crank", "ideal").model.numpy().source
    assert "\nNEARLY_SINGULAR = 1e-08\n" in text and "> NEARLY_SINGULAR * " in text
    assert "else 20*np.pi  # parameters.omega\n" in text
    assert " - np.pi/2 " in load("nine_bar_press", "ideal").model.numpy().source


def test_long_lines_are_broken_within_brackets() -> None:
    value = " + ".join(f"a{k}*b{k}" for k in range(40))
    numbers = {f"{x}{k}": k + 1 for k in range(40) for x in "ab"}
    call = printer.print_assignment("y", f"max({value}, {value})", is_call=True)
    for lines in (printer.print_assignment("y", value), call, printer.print_assignment("y", value, "what it is")):
        text = "\n".join(lines)
        assert max(map(len, lines)) <= printer.WIDTH - 12
        found = dict(numbers)
        exec(text, {"max": max}, found)
        assert found["y"] == sum((k + 1) ** 2 for k in range(40))
    assert printer.print_assignment("y", "1", "what it is") == ["y = 1  # what it is"]
    assert printer.print_docstring(['a "b" \\ c\nd']) == ['"""a \'b\' / c d"""']


def test_the_equations_can_still_be_read() -> None:
    """Functions are derived once, and documents after them are those before them."""
    data = find_shipped_file("slider_crank").read_bytes()
    first, second = (derive_scene(data, "slider_crank.yaml", "dry") for _ in range(2))
    assert first.numpy() is first.numpy()
    assert render_equations_text(first) == render_equations_text(second)
    assert len(make_constraint_kernels(second)) == 4


def test_what_a_condition_leaves_out_may_be_divided_by_zero(tmp_path: Path) -> None:
    """As in C, where the quotient is infinite and not picked."""
    file = tmp_path / "bar.yaml"
    file.write_text("""\
format: gudgeon/1
name: bar
parameters: {e: 0, a: "where(e > 0, 1/e, 2)"}
bodies: {b: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, b.tail]}}
drives: {d: {angle: b, value: "1 rad/s*t"}}
""")
    model = gudgeon.load(file).model.numpy()
    assert (model.prepare().a_, model.prepare({"e": 0.5}).a_) == (2.0, 2.0)
    assert model.prepare({"e": 0.25}).a_ == 4.0

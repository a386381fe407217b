"""What a class reads is what is computed: the equations' text is read back and compared with model and library."""

from __future__ import annotations

import re
from functools import cache
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.program import make_program
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.latex import render_equations_text
from gudgeon.generator.targets.latex.letters import Formula, make_name_from_latex
from gudgeon.generator.targets.latex.notation import make_notation
from gudgeon.generator.targets.latex.to_html import convert_to_mathml
from tests.equations.models import numeric, random_model, random_state
from tests.slow import slow_but
from tests.targets_latex.equations_reader import (
    dots_apart,
    equations,
    evaluate,
    numbers,
    quantity,
    rows,
    sections,
    state,
    value,
)

SHIPPED = resources.files("gudgeon.mechanisms")
PRESS = SHIPPED.joinpath("nine_bar_press.yaml").read_text(encoding="utf-8")
VALID = Path(__file__).parents[1] / "mechanisms" / "valid"
SLIDER = (VALID / "slider_crank.yaml").read_text(encoding="utf-8")
RANDOM = [f"random {seed}" for seed in range(6)]

# Everything at once: points off the middle, all joint types, long drives, force elements, names that collide.
ZOO = """
format: gudgeon/1
name: zoo
parameters: {x_b1: 2 m, omega: 3 rad/s, alpha: 0.1, k_max: 40 N/m}
bodies:
  b1: {length: 80 mm, mass: 0.142 kg, inertia: 3.030e-4 kg*m^2, points: {eye: [x_b1, 5 mm]}, com: [30 mm, 1 mm]}
  my_bar: {length: x_b1, mass: 0.142 kg, inertia: 3.030e-4 kg*m^2}
  W1: {mass: 1 kg, inertia: 1 kg*m^2}
  W2: {mass: 1 kg, inertia: 2 kg*m^2}
  S: {mass: 1 kg, inertia: 1 kg*m^2}
ground: {O: [0, 0], P: [1 m, 2 m]}
joints:
  O: {revolute: [ground.O, b1.tail]}
  mesh: {gear: [W1, W2], radii: [40 mm, 60 mm], carrier: b1}
  rod: {distance: [b1.eye, my_bar.head], length: 300 mm}
  slot: {point_on_line: [my_bar.tail, b1.origin], direction: [1, 2]}
  weld: {rigid: [b1.head, W1.origin]}
  guide: {translational: [my_bar.head, S.origin], axis: [1, 3]}
drives:
  pull: {distance: [b1.eye, S.com], value: 0.3 m + 0.1 m * sin(3*t)}
  turn: {angle: [b1, my_bar], value: "smooth_step(t, 0, 0.5 s) * 10 deg + 5 deg * sin(2*pi*t)"}
forces:
  coil: {spring_damper: [ground.P, b1.eye], stiffness: k_max, free_length: 77.85 mm, damping: 3}
  twist: {rotational_spring_damper: [ground, b1], stiffness: 2 N*m/rad, free_angle: 10 deg}
  motor: {torque: [b1, my_bar], value: 0.033 N*m * sin(omega*t)}
  rub: {dry_friction: [b1.eye, S.com], direction: [1, 2], speed: 0.1 m/s, static: 5 N, kinetic: 4 N}
start: {guess: {W1.theta: 10 deg}}
"""


@cache
def model_of(which: str) -> Model:
    """ "press dry", "slider oiled", "zoo", "random 3"."""
    name, _, scene = which.partition(" ")
    if name == "random":
        return random_model(int(scene))[1]
    text = {"press": PRESS, "slider": SLIDER, "zoo": ZOO}[name]
    return derive_scene(text.encode(), f"{name}.yaml", scene or "ideal")


EVERY = ("press ideal", "press dry", "press lubricated", "slider ideal", "slider oiled", "zoo", *RANDOM)
WITH_ROWS = slow_but(["slider ideal", "slider oiled", "zoo", "random 1", "random 5"], EVERY)


@cache
def read(which: str) -> dict[str, list[str]]:
    return sections(render_equations_text(model_of(which)))


def given_numbers(which: str, t: float, q: np.ndarray, v: np.ndarray) -> dict[str, float]:
    """A state by the names that physics.md gives to coordinates, and the numbers in the tables."""
    known = {"t": t, **state([body.name for body in model_of(which).bodies], q, v)}
    for title in ("Bodies", "Ground", "Joints", "Force elements", "Generalized forces"):
        known |= numbers(read(which).get(title, []))
    for cells in rows(read(which).get("Parameters", []))[2:]:
        written, in_si = cells[2].split(" = ")[0], cells[2].split(" = ")[-1]
        exact = quantity(written)
        known[cells[1]] = value(in_si, {}) if exact is None else exact
        assert value(in_si, {}) == pytest.approx(known[cells[1]], rel=1e-5)
    return evaluate(read(which).get("Abbreviations", []), known)


def column(which: str, title: str, letter: str, known: dict[str, float]) -> np.ndarray:
    """A vector of the document by its components; those that are not shown are zero."""
    found = np.zeros(len(model_of(which).rows))
    for left, right in equations(read(which)[title]):
        if left.startswith(f"{letter}_"):
            found[int(left[2:]) - 1] = value(right, known)
    return found


@pytest.mark.parametrize("which", WITH_ROWS)
def test_every_row_is_shown_once_under_its_joint(which: str) -> None:
    model, lines = model_of(which), read(which)["Constraints"]
    shown = [left for left, _ in equations(lines) if left.startswith("Φ")]
    assert shown == [f"Φ_{k}" for k in range(1, len(model.rows) + 1)]
    text = " ".join(" ".join(lines).split())
    for owner in dict.fromkeys(row.owner for row in model.rows):
        named = [f"{row.name} ({row.unit})" for row in model.rows if row.owner == owner]
        kind = "Joint" if owner in model.scene.mechanism.joints else "Drive"
        mechanism = model.scene.mechanism
        line = (mechanism.joints[owner] if kind == "Joint" else mechanism.drives[owner]).where.line
        message = rf"{kind} {owner}\b[^:]*line {line} of the file[^:]*; rows? {re.escape(', '.join(named))}:"
        assert re.search(message, text)


@pytest.mark.parametrize("which", WITH_ROWS)
def test_rows_read_back_are_the_models(which: str) -> None:
    model = model_of(which)
    for seed in range(2):
        t, q, v = random_state(model, seed)
        known = given_numbers(which, t, q, v)
        for letter, matrix in (("Φ", model.Phi), ("ν", model.nu), ("γ", model.gamma)):
            want = numeric(model, matrix)(t, q, v)[:, 0]
            assert column(which, "Constraints", letter, known) == pytest.approx(want, rel=1e-10, abs=1e-10)


@pytest.mark.parametrize("which", WITH_ROWS)
def test_jacobian_read_back_is_the_models(which: str) -> None:
    """Blocks by joint, or entry by entry where a block would be too wide."""
    model = model_of(which)
    t, q, v = random_state(model, 1)
    known = given_numbers(which, t, q, v)
    place = {dots_apart(f"{c}_{b.name}"): b.index + k for b in model.bodies for k, c in enumerate("xyθ")}
    found = np.zeros((len(model.rows), len(model.q)))
    columns: list[int] = []
    for cells in rows(read(which)["Constraints"]):
        if all(cell in place for cell in cells):
            columns = [place[cell] for cell in cells]
        elif re.fullmatch(r"Φ_\d+", cells[0]):
            found[int(cells[0][2:]) - 1, columns] = [value(cell, known) for cell in cells[1:]]
    for left, right in equations(read(which)["Constraints"]):
        if not left.startswith("∂"):
            continue
        row, by = left.split("/")
        found[int(row[3:]) - 1, place[by[1:]]] = value(right, known)
    assert found == pytest.approx(numeric(model, model.Phi_q)(t, q, v), rel=1e-10, abs=1e-10)


def test_gamma_is_sorted_by_products_of_angular_velocities() -> None:
    """Nikravesh's translational joint: -2 θ̇ u · (ṙ_i - ṙ_j) and -θ̇² times the offset along u turned, no more."""
    (gamma,) = (right for left, right in equations(read("zoo")["Constraints"]) if left == "γ_9")
    rate = "θ\u0307_my_bar"
    turning, sliding = gamma.split(f" + 2·{rate}·")
    assert turning.startswith(f"{rate}^2·(") and rate not in turning.removeprefix(rate) + sliding
    x, y = dots_apart("ẋ"), dots_apart("ẏ")
    assert sliding == f"(u_x.my_bar·(-{x}_my_bar + {x}_S) + u_y.my_bar·(-{y}_my_bar + {y}_S))"


@pytest.mark.parametrize("which", slow_but(["zoo", "slider ideal"], ["press ideal", "zoo", "slider ideal"]))
def test_masses_and_forces_read_back_are_the_models(which: str) -> None:
    model = model_of(which)
    t, q, v = random_state(model, 2)
    known = given_numbers(which, t, q, v)
    if model.elements:
        known = evaluate(read(which)["Force elements"], known)
    masses = [value(cell, known) for row in rows(read(which)["Masses"])[2:] for cell in row[1:]]
    assert masses == pytest.approx(numeric(model, model.M)(t, q, v).diagonal())
    found = np.zeros(len(model.q))
    for left, right in equations(read(which)["Generalized forces"]):
        found[int(left[2:]) - 1] = value(right, known)
    assert found == pytest.approx(numeric(model, model.g)(t, q, v)[:, 0], rel=1e-10, abs=1e-12)


def test_friction_read_back_is_the_models() -> None:
    """Slip, the row of stick and the force of slip."""
    model, (friction,) = model_of("zoo"), model_of("zoo").frictions
    t, q, v = random_state(model, 3)
    known = evaluate(read("zoo")["Force elements"], given_numbers("zoo", t, q, v))
    explicit = model.symbols.expand_definitions
    columns = [explicit(sp.sympify(friction.jacobian.get(x, 0))) for x in model.q]
    J = numeric(model, sp.Matrix([columns]))(t, q, v)[0]
    slip, gamma = numeric(model, sp.Matrix([explicit(friction.slip.v), explicit(friction.gamma)]))(t, q, v)[:, 0]
    assert (known["v_rub"], known["γ_rub"]) == pytest.approx((slip, gamma), rel=1e-10)
    assert [known.get(f"J_rub.{k}", 0.0) for k in range(1, 1 + q.size)] == pytest.approx(J, rel=1e-10)
    assert [known.get(f"Δg_{k}", 0.0) for k in range(1, 1 + q.size)] == pytest.approx(-4.0 * J * np.sign(slip))


def test_masses_of_shapes_follow_from_what_the_tables_say() -> None:
    """A density, whose a material is too, a thickness, widths and radii, lengths of sides."""
    text = (VALID / "shapes.yaml").read_text(encoding="utf-8").replace("density: 2700 kg/m^3", "material: alloy")
    text += "materials: {alloy: {E: 70 GPa, nu: 0.3, density: 2700 kg/m^3}}\n"
    model = derive_scene(text.encode(), "shapes.yaml", "ideal")
    lines = sections(render_equations_text(model))["Bodies"]
    known = numbers(lines)
    of_rows = [cell.split(" = ") for row in rows(lines) for cell in row]
    follow = {parts[0]: parts[1] for parts in of_rows if len(parts) == 3 and parts[0][:2] in ("m_", "I_")}
    follow |= {left: right for left, right in equations(lines) if left[0] in "mI"}
    assert {"m_rod", "I_rod", "I_crank", "I_link", "I_slider", "m_plate", "I_plate"} == follow.keys()
    for left, right in follow.items():
        assert value(right, known) == pytest.approx(known[left], rel=1e-4), left
    assert known["ρ_alloy"] == 2700.0 and known["h_plate"] == 0.005


def test_a_number_is_a_joints_own_by_what_it_is_and_not_by_its_name() -> None:
    """A joint called "inverse" does not take 1/M of a body; its own number is called after it."""
    text = SHIPPED.joinpath("pendulum.yaml").read_text(encoding="utf-8")
    model = derive_scene(text.replace("  rod: {distance", "  inverse: {distance").encode(), "pendulum.yaml", "ideal")
    program = make_program(model, "full")  # which derives what the right-hand side needs
    names = {symbol.name: name.text for symbol, name in make_notation(program.model).names.items()}
    assert names["inverse_bob_mass_"] == "inverse_bob_mass"
    assert names["inverse_half_inverse_length_"] == "half_inverse_length_inverse"


@pytest.mark.parametrize(
    ("latex", "text"),
    [
        (r"\mu", "μ"),
        (r"\sigma_{0}", "σ_0"),
        ("c_e", "c_e"),
        (r"\mathrm{max}_{a b}", "max_ab"),
        (r"\varphi", "φ"),
    ],
)
def test_letters_that_are_given_in_latex(latex: str, text: str) -> None:
    assert make_name_from_latex(latex) == Formula(latex, text)


def test_a_space_stands_between_a_function_and_what_it_is_of() -> None:
    """Not between it and its power."""
    pytest.importorskip("latex2mathml")
    space, found = '<mspace width=".17em"/>', convert_to_mathml(r"\sin{\theta} + \cos^{2}{x}")
    assert f"<mi>sin</mi>{space}<mi>θ</mi>" in found and f"<mi>cos</mi>{space}" not in found and found.count(space) == 1

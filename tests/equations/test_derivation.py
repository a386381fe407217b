"""Φ, Φ_q, ν and γ as mathematics: against differences, complex steps and an oracle that knows no SymPy."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.pipeline import derive_scene
from tests.equations.models import numeric, press, random_model, random_state
from tests.oracles import ideal_press, numpy_linkage
from tests.slow import slow_but

SEEDS = slow_but([0, 1, 5], range(8))  # no loop, one, two
MODELS = [*slow_but(["ideal", "lubricated"], ["ideal", "dry", "lubricated"]), *SEEDS]


def model_of(which: str | int) -> Model:
    return press(which) if isinstance(which, str) else random_model(which)[1]


def close(got: np.ndarray, want: np.ndarray, relative: float) -> bool:
    """Relative to the largest entry: a sum of terms is known no better than its terms."""
    return bool(np.all(abs(got - want) <= relative * max(1.0, float(np.max(abs(want), initial=0.0)))))


def test_press_has_the_rows_of_the_source() -> None:
    """Eq. 19: 24 coordinates; 20 rows with play in A and B, 24 without; the play's joints have no rows."""
    ideal, dry = press("ideal"), press("dry")
    assert (len(ideal.q), len(ideal.rows), ideal.degrees_of_freedom) == (24, 24, 0)
    assert (len(dry.q), len(dry.rows), dry.degrees_of_freedom) == (24, 20, 4)
    assert {row.owner for row in ideal.rows} - {row.owner for row in dry.rows} == {"A", "B"}
    assert [clearance.name for clearance in dry.clearances] == ["A", "B"]
    assert len(dry.all_rows) == 24


def test_an_arm_is_that_of_the_point_whose_name_it_has() -> None:
    """A(θ) s, s from the body's centre of mass: documents say so by the name."""
    model = press("ideal")
    geometry = model.geometry
    named = {symbol: of for symbol, of in geometry.rotated_components.items() if of.point}
    assert len(named) > 10
    for symbol, of in named.items():
        cos, sin = geometry.find_cos_and_sin(geometry.bodies[of.body])
        x, y = geometry.local_vectors[of.body, of.point]
        want = cos * x - sin * y if of.axis == "x" else sin * x + cos * y
        assert sp.expand(model.symbols.definitions[symbol] - want) == 0


@pytest.mark.parametrize("which", MODELS)
def test_jacobian_against_finite_differences(which: str | int) -> None:
    model, h = model_of(which), 1e-5
    phi, phi_q = numeric(model, model.Phi), numeric(model, model.Phi_q)
    for seed in range(3):
        t, q, v = random_state(model, seed)
        differences = [(phi(t, q + s, v) - phi(t, q - s, v))[:, 0] / (2.0 * h) for s in h * np.eye(q.size)]
        assert close(phi_q(t, q, v), np.transpose(differences), 1e-7)


@pytest.mark.parametrize("which", MODELS)
def test_right_hand_sides_against_complex_steps(which: str | int) -> None:
    """ν = −∂Φ/∂t, and γ = −d/dt(Φ_q q̇ − ν) along the motion with q̈ = 0."""
    model, h = model_of(which), 1e-30
    phi, phi_q, nu, gamma = (numeric(model, m) for m in (model.Phi, model.Phi_q, model.nu, model.gamma))
    for seed in range(3):
        t, q, v = random_state(model, seed)
        assert close(nu(t, q, v), -phi(t + 1j * h, q, v).imag / h, 1e-12)
        later = t + 1j * h, q + 1j * h * v, v
        rate = phi_q(*later) @ v[:, None] - nu(*later)
        assert close(gamma(t, q, v), -rate.imag / h, 1e-12)


# f of T = t/s, then f′ and f″ before and after T = ½
Rates = Callable[[float], tuple[float, float]]
CORNERS: dict[str, tuple[str, Rates, Rates]] = {
    "size": ("abs(T - 0.5)", lambda x: (-1.0, 0.0), lambda x: (1.0, 0.0)),
    "cubed": ("abs(T - 0.5)**3", lambda x: (-3 * (x - 0.5) ** 2, 3 - 6 * x), lambda x: (3 * (x - 0.5) ** 2, 6 * x - 3)),
    "most": ("max(T**2, T/2)", lambda x: (0.5, 0.0), lambda x: (2 * x, 2.0)),
    "least": ("min(T**2, T/2)", lambda x: (2 * x, 2.0), lambda x: (0.5, 0.0)),
    "rises": ("ramp(t, 0.5 s, 1 s)", lambda x: (0.0, 0.0), lambda x: (1.0, 0.0)),
    "parts": ("where(T < 0.5, T**2, T**3)", lambda x: (2 * x, 2.0), lambda x: (3 * x * x, 6 * x)),
}


def test_drives_with_corners_have_the_rates_of_the_side_that_they_are_on() -> None:
    """ν and γ of a mass that is driven along each; |T − ½| at its corner has the rate that the motion goes on with."""
    bodies = "".join(f"  {name}: {{mass: 1 kg, inertia: 1 kg*m^2}}\n" for name in CORNERS)
    values = {name: form.replace("T", "(t/(1 s))") for name, (form, *_) in CORNERS.items()}
    drives = "".join(f'  by_{n}: {{coordinate: {n}.x, value: "1 m*({value})"}}\n' for n, value in values.items())
    text = f"format: gudgeon/1\nname: corners\nground: {{o: [0, 0]}}\nbodies:\n{bodies}drives:\n{drives}"
    model = derive_scene(text.encode(), "corners.yaml", "ideal").numpy()
    p, rest = model.prepare(), np.zeros(model.n)
    for T in (0.25, 0.4, 0.6, 0.75):
        want = np.array([(before if T < 0.5 else after)(T) for _, before, after in CORNERS.values()])
        assert close(model.nu(T, rest, p), want[:, 0], 1e-14)
        assert close(model.gamma(T, rest, rest, p), want[:, 1], 1e-14)
    assert model.nu(0.5, rest, p)[0] == 1.0


@pytest.mark.parametrize("which", MODELS)
def test_gamma_against_finite_differences(which: str | int) -> None:
    """The same with real numbers alone, fourth order in the step."""
    model, h = model_of(which), 2e-3
    phi_q, nu, gamma = (numeric(model, m) for m in (model.Phi_q, model.nu, model.gamma))
    t, q, v = random_state(model, 11)

    def rate(s: float) -> np.ndarray:
        return phi_q(t + s, q + s * v, v) @ v[:, None] - nu(t + s, q + s * v, v)

    first, second = (rate(h) - rate(-h)) / (2 * h), (rate(2 * h) - rate(-2 * h)) / (4 * h)
    third = (rate(3 * h) - rate(-3 * h)) / (6 * h)
    assert close(gamma(t, q, v), -(15.0 * first - 6.0 * second + third) / 10.0, 1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_random_linkages_against_the_oracle(seed: int) -> None:
    case, model = random_model(seed)
    assert [row.owner for row in model.rows][::1] == [
        owner for i in range(len(case.linkage.joints)) for owner in (f"j{i}", f"j{i}")
    ] + [f"d{i}" for i in range(len(case.linkage.drives))]
    functions = [numeric(model, m) for m in (model.Phi, model.Phi_q, model.nu, model.gamma)]
    states = [(0.0, case.q, case.v), *(random_state(model, s) for s in range(3))]
    for t, q, v in states:
        rows = numpy_linkage.rows(case.linkage, t, q, v)
        for function, want in zip(functions, (rows.phi, rows.phi_q, rows.nu, rows.gamma), strict=True):
            got = function(t, q, v)
            assert close(got if want.ndim == 2 else got[:, 0], want, 1e-13)
    numbers = {e.symbol: e.default for e in model.parameter_table.entries.values()}
    assert [float(m.subs(numbers)) for m in model.masses] == pytest.approx(numpy_linkage.mass(case.linkage), rel=1e-15)
    assert [float(g.subs(numbers)) for g in model.g] == pytest.approx(
        numpy_linkage.forces(case.linkage, case.q, case.v), rel=1e-14
    )


@pytest.mark.parametrize("scene", ["ideal", "dry"])
def test_press_equations_hold_on_its_closed_form(scene: str) -> None:
    model = press(scene)
    assert [str(q) for q in model.q][::3] == [f"{body}_x_" for body in ideal_press.BODIES]
    phi, phi_q, nu, gamma = (numeric(model, m) for m in (model.Phi, model.Phi_q, model.nu, model.gamma))
    m = ideal_press.motion([0.0, 0.2, 0.61])
    for t, q, v, a in zip((0.0, 0.2, 0.61), m.q, m.v, m.a, strict=True):
        assert abs(phi(t, q, v)).max() < 1e-15
        assert abs(phi_q(t, q, v) @ v[:, None] - nu(t, q, v)).max() < 1e-14
        assert abs(phi_q(t, q, v) @ a[:, None] - gamma(t, q, v)).max() < 1e-11


def test_only_driven_rows_depend_on_time() -> None:
    model = press("ideal")
    driven = {r for r, value in enumerate(model.nu) if value != 0}
    assert {model.rows[r].owner for r in driven} == {"crank1", "crank4"}
    assert all(sp.simplify(model.gamma[r]) == 0 for r in driven)  # both speeds are constant


def test_a_row_that_mixes_time_and_coordinates() -> None:
    """A row made of a coordinate and a drive's angle has ∂²Φ/∂q∂t, which γ counts twice."""
    model, h = press("ideal"), 1e-30
    body, angle = model.bodies[0], model.constraints.drive_functions["crank1"][0]
    cos, _ = model.geometry.find_cos_and_sin(body)
    phi = body.x * angle**2 + cos * body.y * angle
    row = model.constraints._derive_row("mixed", "mixed", "joint", "m", phi, [body])
    explicit = model.symbols.expand_definitions
    phi_q_v, nu, gamma = (numeric(model, sp.Matrix([explicit(e)])) for e in (row.phi_q_v, row.nu, row.gamma))
    t, q, v = random_state(model, 5)
    later = t + 1j * h, q + 1j * h * v, v
    rate = phi_q_v(*later) - nu(*later)
    assert gamma(t, q, v)[0, 0] == pytest.approx(-rate[0, 0].imag / h, rel=1e-12)
    assert nu(t, q, v)[0, 0] == pytest.approx(
        -numeric(model, sp.Matrix([explicit(phi)]))(t + 1j * h, q, v).imag[0, 0] / h
    )

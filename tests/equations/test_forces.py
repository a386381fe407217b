"""The force laws as mathematics: against the oracles, their limits, their dissipation."""

from __future__ import annotations

import math

import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gudgeon.generator.kinds.laws.law import RESULTS, LawInputs, PairSymbols, find_all_laws
from tests.equations.one_law import PAIR, Evaluator
from tests.oracles import dry, film

VISCOSITY = 0.1
UNIT = VISCOSITY * PAIR.R_j**3 * PAIR.L / PAIR.c**2  # μ R_j³ L / c²
FAST = settings(derandomize=True, max_examples=200, deadline=None)

rates = st.floats(-100.0, 100.0).filter(lambda x: x == 0.0 or abs(x) > 1e-9)
moving = rates.filter(bool)
ratios = st.floats(1e-6, 0.9999)


FILM = Evaluator("pinkus_sternlicht", {"viscosity": VISCOSITY})
PRINTED = Evaluator("pinkus_sternlicht", {"viscosity": VISCOSITY}, as_printed=True)
SHEAR = Evaluator("pinkus_sternlicht", {"viscosity": VISCOSITY}, shear=True)
NORMAL = {g: Evaluator("lankarani_nikravesh", {"restitution": 0.9}, geometry=g) for g in ("external", "internal")}
FLORES = {
    g: Evaluator("hertz", {"restitution": 0.9}, dissipation="flores", geometry=g) for g in ("external", "internal")
}
VOIGT = Evaluator("kelvin_voigt", {"stiffness": 1e6, "damping": 200.0})
FRICTION = Evaluator("modified_coulomb", {"mu": 0.15, "v0": 1e-4, "v1": 1e-3})


def test_every_law_is_built_of_smooth_pieces_and_known_symbols() -> None:
    """No Piecewise (common-subexpression elimination would hoist a division above its guard), no stray symbols."""
    assert {law.role for law in find_all_laws().values()} == set(RESULTS)
    for law in find_all_laws().values():
        symbols = {v: sp.Symbol(v, real=True) for v in law.variables}
        parameters = {p.name: sp.Symbol(p.name, positive=True) for p in law.parameters}
        pair = PairSymbols(**{k: sp.Symbol(k, positive=True) for k in vars(PAIR)})
        selected = {o.name: o.default_option for o in law.options}
        steps = law.build(LawInputs(parameters, selected, pair, symbols, lambda name, expression, meaning: expression))
        assert set(law.results) <= set(steps)
        known = {*symbols.values(), *parameters.values(), *vars(pair).values()}
        for name, expression in steps.items():
            assert not expression.has(sp.Piecewise), (law.name, name)
            assert expression.free_symbols <= known, (law.name, name)
            known.add(sp.Symbol(name, real=True))


@FAST
@given(ratios, moving, rates)
def test_film_is_pinkus_and_sternlicht(eps: float, eps_rate: float, omega_s: float) -> None:
    w_t = -0.5 * eps * omega_s
    got = FILM(eps, eps_rate, w_t)
    want = film.pinkus_sternlicht(eps, eps_rate, omega_s)
    tolerance = 1e-13 * UNIT * math.hypot(*want) / (1.0 - eps)  # 1 − ε² itself is only known to a rounding of ε
    assert got[:2] == pytest.approx([UNIT * x for x in want], rel=1e-13, abs=tolerance)


@FAST
@given(ratios, moving, rates)
def test_film_as_printed_differs_in_the_radial_sign_of_leaving(eps: float, eps_rate: float, omega_s: float) -> None:
    radial, tangential, _ = FILM(eps, eps_rate, -0.5 * eps * omega_s)
    assert PRINTED(eps, eps_rate, -0.5 * eps * omega_s)[:2] == (radial if eps_rate > 0 else -radial, tangential)
    want = film.pinkus_sternlicht(eps, eps_rate, omega_s, as_printed=True)[0]
    assert math.copysign(1.0, want) == math.copysign(1.0, PRINTED(eps, eps_rate, -0.5 * eps * omega_s)[0])


@pytest.mark.parametrize("eps", [0.05, 0.3, 0.9, 0.999])
def test_film_limits(eps: float) -> None:
    steady = film.steady(eps, 12.0)
    assert FILM(eps, 0.0, -6.0 * eps)[:2] == pytest.approx([UNIT * x for x in steady], rel=1e-12)
    for rate in (3.0, -3.0):
        assert FILM(eps, rate, 0.0)[0] == pytest.approx(UNIT * film.pure_squeeze(eps, rate), rel=1e-11)
        assert FILM(0.0, rate, 2.0)[:2] == pytest.approx((UNIT * film.centred(rate), UNIT * film.centred(2.0)))
    assert FILM(eps, 0.0, 0.0)[:2] == (0.0, 0.0)
    assert FILM(0.0, 0.0, 0.0)[:2] == (0.0, 0.0)


@FAST
@given(st.floats(0.0, 0.9999), rates, rates)
def test_film_only_dissipates(eps: float, w_n: float, w_t: float) -> None:
    """F·w − T0 (ω_j − ω_i)² ≤ 0, in the frame of the mean surface speed; and mirrored whirl mirrors the force."""
    radial, tangential, shear = SHEAR(eps, w_n, w_t)
    assert radial * w_n + tangential * w_t <= 0.0
    assert shear == pytest.approx(2.0 * math.pi * UNIT * PAIR.c / math.sqrt(1.0 - eps * eps), rel=1e-10)
    assert SHEAR(eps, w_n, -w_t) == (radial, -tangential, shear)
    assert FILM(eps, w_n, w_t)[2] == 0.0


@FAST
@given(st.floats(0.05, 0.95), st.floats(-0.5, 0.5), st.floats(50.0, 100.0))
def test_film_is_near_gumbel_where_it_may_be(eps: float, eps_rate: float, omega_s: float) -> None:
    assume(eps > 0.3)
    got = FILM(eps, eps_rate, -0.5 * eps * omega_s)[:2]
    want = film.gumbel_film(eps, eps_rate, omega_s, 4001)
    assert math.dist(got, [UNIT * x for x in want]) < 0.1 * UNIT * math.hypot(*want)


@FAST
@given(st.floats(1e-9, 1e-4), st.floats(-5.0, 5.0), st.sampled_from(["external", "internal"]))
def test_normal_force_is_lankarani_and_nikravesh(delta: float, ratio: float, geometry: str) -> None:
    sign = 1 if geometry == "external" else -1
    stiff = dry.stiffness(PAIR.R_i, PAIR.R_j, (PAIR.E_i, PAIR.E_j), (PAIR.nu_i, PAIR.nu_j), sign)
    want = dry.normal_force(delta, ratio, 1.0, stiff, 1.5, dry.dissipation_factor(0.9))
    assert NORMAL[geometry](delta, ratio)[0] == pytest.approx(want, rel=1e-13)


@FAST
@given(st.floats(1e-9, 1e-4), st.floats(-5.0, 5.0), st.sampled_from(["external", "internal"]))
def test_hertz_without_a_stiffness_has_that_of_the_pair(delta: float, ratio: float, geometry: str) -> None:
    sign = 1 if geometry == "external" else -1
    stiff = dry.stiffness(PAIR.R_i, PAIR.R_j, (PAIR.E_i, PAIR.E_j), (PAIR.nu_i, PAIR.nu_j), sign)
    want = dry.normal_force(delta, ratio, 1.0, stiff, 1.5, 8.0 * (1.0 - 0.9) / (5.0 * 0.9))
    assert FLORES[geometry](delta, ratio)[0] == pytest.approx(want, rel=1e-13)


def test_conformal_stiffness_is_ten_times_the_printed_one() -> None:
    internal, external = NORMAL["internal"](1e-5, 0.0)[0], NORMAL["external"](1e-5, 0.0)[0]
    assert internal / external == pytest.approx(math.sqrt(0.0297 / 0.0003), rel=1e-12)


@FAST
@given(st.floats(-0.01, 0.01), st.floats(0.0, 1e3))
def test_friction_is_modified_coulomb(slip: float, normal: float) -> None:
    (got,) = FRICTION(normal, slip)
    assert got == pytest.approx(dry.friction_force(slip, normal, 0.15, 1e-4, 1e-3), rel=1e-11, abs=1e-13)
    assert got * slip <= 0.0
    assert abs(got) <= 0.15 * normal * (1.0 + 1e-15)


@pytest.mark.parametrize(("given_restitution", "delivered"), [(0.9, 0.91318), (0.5, 0.72524)])
def test_restitution_of_the_normal_law(given_restitution: float, delivered: float) -> None:
    """The law's own damping factor, read from two forces, put into the identity a(1+e) = ln[(1+a)/(1−a e)]."""
    law = Evaluator("lankarani_nikravesh", {"restitution": given_restitution})
    factor = law(1e-5, 1.0)[0] / law(1e-5, 0.0)[0] - 1.0
    assert dry.delivered(factor) == pytest.approx(delivered, abs=5e-6)


@pytest.mark.parametrize(("name", "numbers"), [("hertz", {"stiffness": 1e9}), ("liu", {})])
@pytest.mark.parametrize("requested", [1e-3, 0.05, 0.3, 0.9, 0.9999, 1.0])
def test_the_exact_damping_is_the_identitys(name: str, numbers: dict[str, float], requested: float) -> None:
    """1 − a e = (1 + a) e^{−a(1 + e)}, which is the identity for a > 0."""
    law = Evaluator(name, {"restitution": requested, **numbers}, dissipation="exact")
    a = law(1e-5, 1.0)[0] / law(1e-5, 0.0)[0] - 1.0
    assert 1.0 - a * requested == pytest.approx((1.0 + a) * math.exp(-a * (1.0 + requested)), abs=4e-15)
    assert (a == 0.0) == (requested == 1.0) and (
        requested < 0.9 or a == pytest.approx(1.5 * (1.0 - requested) / requested, rel=2e-3)
    )


@FAST
@given(st.floats(1e-9, 1e-2), st.floats(-2.0, 2.0))
def test_liu_is_the_conforming_pair(delta: float, ratio: float) -> None:
    law = Evaluator("liu", {"restitution": 1.0})
    modulus = 1.0 / sum((1.0 - nu**2) / E for E, nu in ((PAIR.E_i, PAIR.nu_i), (PAIR.E_j, PAIR.nu_j)))
    expected = 0.5 * math.pi * PAIR.L * modulus * delta * math.sqrt(delta / (2.0 * (PAIR.c + delta)))
    assert law(delta, ratio)[0] == pytest.approx(expected, rel=1e-12)


@FAST
@given(st.floats(0.0, 1e-3), st.floats(-5.0, 5.0))
def test_kelvin_and_voigt_push_and_never_pull(delta: float, deltadot: float) -> None:
    (got,) = VOIGT(delta, 1.0, deltadot)
    assert got == pytest.approx(max(1e6 * delta + 200.0 * deltadot, 0.0), rel=1e-14)
    assert (got - 1e6 * delta) * deltadot >= -1e-9 or got == 0.0  # beside the spring it only dissipates

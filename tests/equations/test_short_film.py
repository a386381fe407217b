"""Ocvirk's film against the integral of the short bearing's pressure, and the textbooks' steady forces."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from tests.equations.one_law import PAIR, Evaluator

VISCOSITY = 0.1
UNIT = VISCOSITY * PAIR.R_j * PAIR.L**3 / PAIR.c**2  # μ R_j L³/c²
FILM = Evaluator("ocvirk", {"viscosity": VISCOSITY})
SHEAR = Evaluator("ocvirk", {"viscosity": VISCOSITY}, shear=True)


def integrated(eps: float, w_n: float, w_t: float) -> tuple[float, float]:
    """(F_r, F_t)/UNIT over the half in which the pressure is above zero, found from its sign."""
    first = math.atan2(w_n, -w_t)

    def part(along: float) -> float:
        def density(theta: float) -> float:
            pressure = (-w_t * math.sin(theta) - w_n * math.cos(theta)) / (1.0 + eps * math.cos(theta)) ** 3
            return pressure * math.cos(theta - along)

        return float(quad(density, first, first + math.pi, epsabs=0.0, epsrel=1e-12, limit=400)[0])

    return part(0.0), part(0.5 * math.pi)


def test_closed_form_of_the_integral() -> None:
    rng = np.random.default_rng(5)
    for eps in (0.0, 1e-9, *rng.uniform(0.0, 0.97, 60)):
        w_n, w_t = rng.normal(size=2)
        got = np.array(FILM(eps, w_n, w_t)[:2]) / UNIT
        expected = np.array(integrated(eps, w_n, w_t))
        np.testing.assert_allclose(got, expected, rtol=0, atol=1e-10 * np.hypot(*expected))


@pytest.mark.parametrize("eps", [0.05, 0.4, 0.8, 0.98])
def test_textbook_forces(eps: float) -> None:
    """Steady: W c²/(μ ω R L³) = ε √(π²(1−ε²) + 16ε²)/(4(1−ε²)²), tan φ = π √(1−ε²)/(4ε); and pure squeeze."""
    omega = 3.0
    radial, tangential, _ = FILM(eps, 0.0, -0.5 * eps * omega)  # the bearing stands, ψ̇ = 0
    root = math.sqrt(1.0 - eps**2)
    load = eps * math.hypot(math.pi * root, 4.0 * eps) / (4.0 * root**4)
    assert math.hypot(radial, tangential) / (UNIT * omega) == pytest.approx(load, rel=1e-13)
    assert tangential / -radial == pytest.approx(math.pi * root / (4.0 * eps), rel=1e-13)
    closing = math.pi + 2.0 * math.atan(eps / root)  # θ1 = π/2: all of the closing side
    squeeze = closing * (1.0 + 2.0 * eps**2) / (2.0 * root**5) + 3.0 * eps / root**4
    assert FILM(eps, 1.0, 0.0)[:2] == pytest.approx((-UNIT * squeeze, 0.0), rel=1e-13)


def test_a_full_film_is_the_integral_over_all_of_the_gap() -> None:
    """Sommerfeld's condition; in steady rotation the force is square to the eccentricity: π ε ω/(2 s³)."""
    full, rng = Evaluator("ocvirk", {"viscosity": VISCOSITY}, cavitation="full"), np.random.default_rng(7)
    for eps in (0.0, *rng.uniform(0.0, 0.95, 20)):
        w_n, w_t = rng.normal(size=2)

        def part(along: float, eps: float = eps, w: tuple[float, float] = (w_n, w_t)) -> float:
            def density(theta: float) -> float:
                pressure = (-w[1] * math.sin(theta) - w[0] * math.cos(theta)) / (1.0 + eps * math.cos(theta)) ** 3
                return pressure * math.cos(theta - along)

            return float(quad(density, -math.pi, math.pi, epsabs=1e-13, epsrel=1e-13, limit=400)[0])

        got = np.array(full(eps, w_n, w_t)[:2]) / UNIT
        np.testing.assert_allclose(got, (part(0.0), part(0.5 * math.pi)), rtol=1e-9, atol=1e-11)
        assert got @ (w_n, w_t) < 0.0
    radial, tangential, _ = full(0.6, 0.0, -0.5 * 0.6 * 3.0)
    assert radial == 0.0 and tangential == pytest.approx(UNIT * math.pi * 0.6 * 3.0 / (2.0 * 0.8**3), rel=1e-13)


def test_at_rest_and_concentric() -> None:
    assert FILM(0.3, 0.0, 0.0) == (0.0, 0.0, 0.0)
    for w_n, w_t in ((1.0, 0.0), (0.0, 1.0), (0.6, -0.8)):  # against w, half of the full film's π
        assert FILM(0.0, w_n, w_t)[:2] == pytest.approx((-0.5 * math.pi * UNIT * w_n, -0.5 * math.pi * UNIT * w_t))


def test_film_only_dissipates() -> None:
    """The power of force and shear torque on a journal that turns beside a bearing at rest."""
    rng = np.random.default_rng(6)
    for _ in range(300):
        eps, w_n, w_t = rng.uniform(0.0, 0.99), *rng.normal(size=2)
        radial, tangential, torque = SHEAR(eps, w_n, w_t)
        assert torque == pytest.approx(
            2.0 * math.pi * VISCOSITY * PAIR.R_j**3 * PAIR.L / PAIR.c / math.sqrt(1 - eps**2)
        )
        assert radial * w_n + tangential * w_t < 0.0

"""The solver against closed forms: a centred journal, the long bearing, the short one, Fourier series."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from gudgeon.errors import GudgeonError
from gudgeon.reynolds import Bearing, Film, solve, table
from tests.oracles import film, finite_bearing
from tests.oracles.spectral_film import half_film

SHAPE = {"radius": 0.02, "clearance": 4e-5, "viscosity": 0.05}
UNIT = SHAPE["viscosity"] * SHAPE["radius"] ** 3 / SHAPE["clearance"] ** 2  # times L: of forces per rate


def bearing(l_over_d: float) -> Bearing:
    return Bearing(length=2.0 * SHAPE["radius"] * l_over_d, **SHAPE)


def forces(eps: float, eps_rate: float, omega_s: float, l_over_d: float, **how: object) -> tuple[np.ndarray, float]:
    """(F_r, F_t) and their error over μ R³ L/c²."""
    own = bearing(l_over_d)
    found = table(own, eps, eps_rate, omega_s, **how)  # type: ignore[arg-type]
    return found.force / (UNIT * own.length), float(found.error) / (UNIT * own.length)


def orders(errors: list[float]) -> list[float]:
    return [math.log2(coarse / fine) for coarse, fine in pairwise(errors)]


def test_a_centred_journal_in_its_closed_form() -> None:
    """h = 1: p = −w cos φ (1 − cosh ζ/cosh Z). Of the second order in the force, the pressure and the leakage."""
    own, rate, z = bearing(1.0), 30.0, 1.0
    load = -12.0 * math.pi * (z - math.tanh(z)) / (2.0 * z) * rate  # half of the film carries
    found: list[Film] = [
        solve(own, (0.0, 0.0), (rate * own.clearance, 0.0), cavitation="half_sommerfeld", cells=cells)
        for cells in ((32, 4), (64, 8), (128, 16))
    ]
    for one in found:
        where = np.cos(one.angle)[:, None] * (1.0 - np.cosh(one.z / own.radius) / math.cosh(z))
        one.pressure[...] -= own.pressure_unit * rate * np.maximum(where, 0.0)
    unit = UNIT * own.length
    off = [abs(one.radial / unit - load) for one in found]
    flow = 4.0 * own.clearance * own.radius**2 * rate * math.tanh(z)
    assert orders(off) == pytest.approx([2.0] * 2, abs=0.15)
    assert orders([float(abs(one.pressure).max()) for one in found]) == pytest.approx([2.0] * 2, abs=0.15)
    assert orders([abs(one.leakage - flow) for one in found]) == pytest.approx([2.0] * 2, abs=0.15)
    assert off[-1] < found[-1].error / unit < 5.0 * off[-1]
    assert found[-1].force == pytest.approx([load * unit, 0.0], rel=1e-3, abs=1e-9 * unit)


STATES = [
    (0.1, 0.0, 1.0, 1.0),
    (0.6, 1.0, 2.0, 1.0),
    (0.8, -0.5, 3.0, 0.5),
    (0.9, 0.0, 1.0, 2.0),
    (0.5, 1.0, 0.0, 0.25),
]


@pytest.mark.parametrize("state", STATES)
def test_half_film_against_fourier_series(state: tuple[float, float, float, float]) -> None:
    """No grid along the bearing there; the error is what it is given as, at most, and of the second order."""
    eps, eps_rate, omega_s, l_over_d = state
    want = np.array(half_film(eps, eps_rate, -0.5 * eps * omega_s, l_over_d, modes=192))
    found = [forces(*state, cavitation="half_sommerfeld", cells=cells) for cells in ((96, 12), (192, 24))]
    off = [float(np.hypot(*(force - want))) for force, _ in found]
    assert off[1] < 1e-3 * np.hypot(*want) and off[1] < found[1][1]
    assert math.log2(off[0] / off[1]) == pytest.approx(2.0, abs=0.3)


@pytest.mark.parametrize(("thin", "around"), [(1e-3, 768), (1e-4, 768), (1e-5, 512), (1e-6, 768)])
def test_every_node_finds_its_place_where_the_gap_all_but_closes(thin: float, around: int) -> None:
    """Half film of the long bearing in rotation; Newton alone left nodes far from where they belong."""
    eps = 1.0 - thin
    force, error = forces(eps, 0.0, 1.0, 1.0, ends="sealed", cavitation="half_sommerfeld", cells=(around, 4))
    share = 6.0 / (2.0 + eps * eps)
    exact = np.array([-share * 2.0 * eps * eps / (1.0 - eps * eps), share * math.pi * eps / math.sqrt(1.0 - eps * eps)])
    assert np.hypot(*(force - exact)) < min(error, 3e-4 * np.hypot(*exact))


def test_a_gap_too_thin_for_doubles_says_so() -> None:
    own = bearing(1.0)
    with pytest.raises(GudgeonError, match="too thin for doubles"):
        solve(own, (own.clearance * (1.0 - 1e-10), 0.0), omega_journal=1.0, ends="sealed", groove=0.0, cells=(32, 4))


@pytest.mark.parametrize(
    ("eps", "sommerfeld", "attitude"),
    [
        (0.2, 0.12373275, 66.899936),
        (0.5, 0.04930789, 58.296184),
        (0.8, 0.02110349, 42.180955),
    ],
)
def test_long_bearing_with_reynolds_condition(eps: float, sommerfeld: float, attitude: float) -> None:
    """Values in eight digits, by Sommerfeld's substitution; what is sealed is infinitely long."""
    (radial, tangential), error = forces(eps, 0.0, 1.0, 0.7, ends="sealed", cells=(1536, 4))
    assert 1.0 / (math.pi * math.hypot(radial, tangential)) == pytest.approx(sommerfeld, rel=1e-4)
    assert math.degrees(math.atan2(tangential, -radial)) == pytest.approx(attitude, rel=1e-4)
    assert error < 1e-4 * math.hypot(radial, tangential)


@pytest.mark.parametrize("state", [(0.2, 0.0, 1.0), (0.9, 0.0, 1.0), (0.7, 1.0, 10.0), (0.7, -1.0, 10.0)])
def test_long_half_film(state: tuple[float, float, float]) -> None:
    force, error = forces(*state, 1.3, ends="sealed", cavitation="half_sommerfeld", cells=(768, 4))
    want = film.gumbel_film(*state)
    assert np.hypot(*(force - want)) < min(1e-4 * np.hypot(*want), error)
    if state[1] == 0.0:
        assert force == pytest.approx(film.steady(state[0], state[2]), rel=1e-4)


def test_sommerfelds_pressure() -> None:
    """p = 6 μ ω (R/c)² ε sin φ (2 + ε cos φ)/((2 + ε²)(1 + ε cos φ)²) where it is positive, to the second order."""
    own, eps, omega, off = bearing(1.0), 0.6, 50.0, []
    for around in (64, 128, 256):
        one = solve(
            own,
            (-eps * own.clearance, 0.0),
            omega_journal=omega,
            ends="sealed",
            cells=(around, 4),
            cavitation="half_sommerfeld",
        )
        x, y = np.cos(one.angle), np.sin(one.angle)
        want = 0.5 * own.pressure_unit * omega * eps * y * (2.0 + eps * x) / ((2.0 + eps**2) * (1.0 + eps * x) ** 2)
        off.append(float(abs(one.pressure[:, 1] - np.maximum(want, 0.0)).max() / want.max()))
    assert orders(off) == pytest.approx([2.0, 2.0], abs=0.1) and off[-1] < 1e-3


def ocvirk(eps: float, eps_rate: float, omega_s: float) -> tuple[float, float]:
    """Short half film over μ R L³/c²: the quadrature from θ1 to θ1 + π, θ1 = atan2(ε̇, ½ ω_s ε)."""
    begin = math.atan2(eps_rate, 0.5 * omega_s * eps)

    def of(direction: float) -> float:
        def p(a: float) -> float:
            closing = 0.5 * omega_s * eps * math.sin(a) - eps_rate * math.cos(a)
            return closing * math.cos(a - direction) / (1.0 + eps * math.cos(a)) ** 3

        return float(quad(p, begin, begin + math.pi, epsabs=1e-12, epsrel=1e-12)[0])

    return of(0.0), of(0.5 * math.pi)


@pytest.mark.parametrize("cavitation", ["half_sommerfeld", "reynolds"])
@pytest.mark.parametrize("state", [(0.5, 0.0, 1.0), (0.8, -1.0, 2.0), (0.6, 1.0, 2.0), (0.4, 1.0, 0.0)])
def test_ocvirks_short_bearing(state: tuple[float, float, float], cavitation: str) -> None:
    """Rotation and squeeze together; what is left goes with (L/D)², as that of the Fourier series does."""
    want = np.array(ocvirk(*state)) * 4.0  # (L/D)² = L²/4R²
    lengths, load = (1 / 8, 1 / 16, 1 / 32), float(np.hypot(*want))
    how = {"cavitation": cavitation, "cells": (192, 12)}
    off = [float(np.hypot(*(forces(*state, k, **how)[0] / k**2 - want))) / load for k in lengths]  # type: ignore[arg-type]
    assert off[-1] < 0.01 and off[2] < off[1] < off[0]
    if cavitation == "half_sommerfeld":
        w_t = -0.5 * state[0] * state[2]
        exact = [float(np.hypot(*(np.array(half_film(*state[:2], w_t, k)) / k**2 - want))) / load for k in lengths[:2]]
        assert math.log2(exact[0] / exact[1]) == pytest.approx(2.0, abs=0.3)
        assert off[:2] == pytest.approx(exact, rel=0.1, abs=2e-3)  # the grid's own


@pytest.mark.parametrize(("eps", "sommerfeld", "attitude"), [(0.2, 0.63178, 73.86), (0.6, 0.12094, 50.53)])
def test_as_long_as_wide(eps: float, sommerfeld: float, attitude: float) -> None:
    """Textbook values of L/D = 1, films that begin at the widest gap."""
    (radial, tangential), error = forces(eps, 0.0, 1.0, 1.0, groove="widest")
    load = math.hypot(radial, tangential)
    assert 1.0 / (math.pi * load) == pytest.approx(sommerfeld, rel=1e-3)
    assert math.degrees(math.atan2(tangential, -radial)) == pytest.approx(attitude, rel=1e-3)
    assert error < 1e-3 * load


@pytest.mark.parametrize("reynolds", [False, True])
@pytest.mark.parametrize("eps", [0.3, 0.8])
def test_another_grid_and_another_way_round(eps: float, reynolds: bool) -> None:
    """The oracle's even cells, which begin their film where they like, as the solver's do without a groove."""
    want = finite_bearing.load(eps, 1.2, reynolds, around=120, along=24) * 6.0 / (2.0 * 1.2)
    force, _ = forces(eps, 0.0, 1.0, 1.2, cavitation="reynolds" if reynolds else "half_sommerfeld")
    assert np.hypot(*force) == pytest.approx(want, rel=2.5e-3)


def test_the_default_cells_are_within_a_thousandth() -> None:
    """L/D = 1 to ε = .9, and never further off than the error says: against twice as many cells either way."""
    states = {"eps": [0.1, 0.5, 0.9, 0.9], "eps_rate": [0.0, 0.0, 0.0, 1.0], "omega_s": [1.0, 1.0, 1.0, 1.0]}
    rough = table(bearing(1.0), **states)  # type: ignore[arg-type]
    fine = table(bearing(1.0), **states, cells=(384, 48))  # type: ignore[arg-type]
    off, load = np.hypot(*(rough.force - fine.force).T), np.hypot(*fine.force.T)
    assert (off < 1e-3 * load).all() and (rough.error < 1.5e-3 * load).all() and (off < rough.error).all()

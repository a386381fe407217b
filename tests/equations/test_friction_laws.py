"""Friction laws against their printed formulas, written anew; what holds for all of them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from gudgeon.generator.kinds.laws.law import find_laws_of_role
from tests.equations.one_law import Evaluator

MU, MU_S, NORMAL = 0.12, 0.2, 37.0
LUGRE = {"mu": MU, "mu_s": MU_S, "v_s": 0.02, "stiffness": 2e4, "damping": 3.0}


def bengisu_akay(v: float) -> float:
    """c_d over u = |v|: a parabola to (v0, c_s), then a decay of 1/ξ = 5 mm/s."""
    return MU_S * (1.0 - (v / 1e-3 - 1.0) ** 2) if v < 1e-3 else MU + (MU_S - MU) * np.exp(-(v - 1e-3) / 5e-3)


# law -> (its numbers, c_d for a slip v > 0, slips at which its form changes)
PRINTED = {
    "modified_coulomb": (
        {"mu": MU, "v0": 1e-4, "v1": 1e-3},
        lambda v: MU * np.clip((v - 1e-4) / 9e-4, 0.0, 1.0),
        (1e-4, 1e-3),
    ),
    "coulomb": ({"mu": MU, "v0": 1e-3}, lambda v: MU * np.tanh(v / 1e-3), ()),
    "threlfall": (
        {"mu": MU, "v_r": 1e-3},
        lambda v: MU * (1.0 - np.exp(-3.0 * v / 1e-3)) if v < 1e-3 else MU * 0.950212931632136,
        (1e-3,),
    ),
    "bengisu_akay": ({"mu": MU, "mu_s": MU_S, "v0": 1e-3, "decay": 5e-3}, bengisu_akay, (1e-3,)),
    "stribeck": (
        {"mu": MU, "mu_s": MU_S, "v_s": 0.02, "v0": 1e-3},
        lambda v: (MU + (MU_S - MU) * np.exp(-(v**2) / 4e-4)) * np.tanh(v / 1e-3),
        (),
    ),
    "brown_mcphee": (
        {"mu": MU, "mu_s": MU_S, "v0": 1e-3},
        lambda v: MU * np.tanh(4e3 * v) + (MU_S - MU) * 1e3 * v / (0.25 * (1e3 * v) ** 2 + 0.75) ** 2,
        (),
    ),
}


def test_none_is_left_out() -> None:
    assert set(PRINTED) | {"dahl", "lugre"} == set(find_laws_of_role("friction"))


@pytest.mark.parametrize("name", sorted(PRINTED))
def test_the_force_is_the_printed_one(name: str) -> None:
    """Odd in the slip, against it, in proportion to the load, and no jump where its form changes."""
    numbers, coefficient, changes = PRINTED[name]
    law = Evaluator(name, numbers)
    for v in (0.0, 1e-6, 3e-5, 4e-4, 9.99e-4, 2.7e-3, 0.015, 0.3, 40.0):
        (got,) = law(NORMAL, v)
        assert got == pytest.approx(-NORMAL * coefficient(v), rel=1e-12, abs=1e-15)
        assert law(NORMAL, -v)[0] == pytest.approx(-got, rel=1e-14) and got <= 0.0
        assert law(2.0 * NORMAL, v)[0] == pytest.approx(2.0 * got, rel=1e-14)
        assert -got <= MU_S * NORMAL * (1.0 + 1e-12)
    for v in (0.0, *changes):
        below, above = (law(1.0, v + side * 1e-12)[0] for side in (-1.0, 1.0))
        assert above == pytest.approx(below, abs=2e-8)  # no law is steeper than 1e3 s/m here


def test_brown_and_mcphees_peak_is_static_friction() -> None:
    """At v0, where both of its parts are: tanh 4 = .99933."""
    law = Evaluator("brown_mcphee", PRINTED["brown_mcphee"][0])
    assert -law(1.0, 1e-3)[0] == pytest.approx(MU_S, rel=1e-3)
    slips = np.linspace(2e-4, 5e-3, 200)
    assert max(-law(1.0, float(v))[0] for v in slips) == pytest.approx(MU_S, rel=5e-3)


@cache
def lugre_law(damping: float) -> Evaluator:
    return Evaluator("lugre", LUGRE | {"damping": damping})


def lugre(v: float, z: float, damping: float = LUGRE["damping"]) -> tuple[float, float]:
    """The force at a load of 1 N, and the rate of the bristles."""
    law = lugre_law(damping)
    names = [name for name, _ in law._steps]
    values = [1.0, v, z]
    for _, step in law._steps:
        values.append(step(*values))
    named = dict(zip(names, values[3:], strict=True))
    return named["F_t"], named["z_rate"]


@pytest.mark.parametrize("v", [-0.3, -0.01, 1e-3, 0.05, 2.0])
def test_steady_lugre_is_stribecks_curve(v: float) -> None:
    """ż = 0 where σ0 z = g sgn v, and the force is g then, whatever σ1 is."""
    g = MU + (MU_S - MU) * np.exp(-((v / 0.02) ** 2))
    force, rate = lugre(v, float(np.sign(v)) * g / LUGRE["stiffness"])
    assert rate == pytest.approx(0.0, abs=1e-14 * abs(v)) and force == pytest.approx(-g * np.sign(v), rel=1e-13)


def test_lugre_against_its_own_equation_in_presliding() -> None:
    """Pushed slowly it is a spring σ0 and a dashpot σ1: F = −(σ0 x + σ1 ẋ) to first order in σ0 x/g."""
    z, v = 1e-9, 1e-5
    force, rate = lugre(v, z)
    assert rate == pytest.approx(v * (1.0 - LUGRE["stiffness"] * z / MU_S), rel=1e-7)
    assert force == pytest.approx(-(2e4 * z + 3.0 * v), rel=2e-4)


def test_lugre_stores_and_never_gives_more() -> None:
    """Over a slip that swings: work into it ≥ ½ σ0 z² at every time, |z| ≤ c_s/σ0; for σ1 at its bound 4 c_f/|v|."""
    peak = 0.4
    damping = 4.0 * MU / peak

    def slip(t: float) -> float:
        return peak * np.sin(9.0 * t) * np.cos(2.3 * t)

    def rates(t: float, y: np.ndarray) -> list[float]:
        force, rate = lugre(slip(t), float(y[0]), damping=damping)
        return [rate, -force * slip(t)]

    run = solve_ivp(rates, (0.0, 0.8), [0.0, 0.0], rtol=1e-7, atol=1e-12, method="LSODA", max_step=0.01)
    z, work = run.y
    assert abs(z).max() <= MU_S / LUGRE["stiffness"] * (1.0 + 1e-6)
    assert (work - 0.5 * LUGRE["stiffness"] * z**2).min() > -1e-9
    slid = quad(lambda t: abs(slip(t)), 0.0, 0.8, limit=200)[0]
    assert MU * slid * 0.9 < work[-1] < MU_S * slid

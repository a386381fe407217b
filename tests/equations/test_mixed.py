"""Mixed lubrication: the shares of film and dry contact against their integrals, their limits, what they conserve."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.integrate import quad

import gudgeon
from gudgeon.generator.kinds.laws.law import find_laws_of_role
from tests.equations.one_law import Evaluator
from tests.programs import needs_compiler

SIGMA = 0.8e-6
FIRST = {"christensen": 3.0, "greenwood_tripp": 4.0}  # Λ at which tips touch
LAST = {"christensen": -3.0, "greenwood_tripp": 0.0}


def share(law: str, ratio: float) -> float:
    """At a film thickness ratio."""
    return float(Evaluator(law, {"roughness": SIGMA})((FIRST[law] - ratio) * SIGMA)[0])


def test_none_is_left_out() -> None:
    assert set(FIRST) == set(find_laws_of_role("mixed"))


def test_christensens_share_is_the_area_in_which_heights_overlap() -> None:
    for ratio in np.linspace(-3.0, 3.0, 25):
        area = quad(lambda u: 35.0 / 96.0 * (1.0 - (u / 3.0) ** 2) ** 3, ratio, 3.0, epsabs=1e-14)[0]
        assert share("christensen", ratio) == pytest.approx(area, abs=1e-13)


def test_christensens_share_is_good_to_rounding() -> None:
    """Beside its polynomial in fractions: a difference of two shares is then as good as their distance lets it be."""
    own = Evaluator("christensen", {"roughness": SIGMA})
    for y in [*np.logspace(-7, -1, 60), *np.linspace(0.0, 1.0, 60)]:
        deep = float(y) * 6.0 * SIGMA
        x = Fraction(deep) / Fraction(6.0 * SIGMA)
        exact = x**4 * (35 - x * (84 - x * (70 - 20 * x)))
        assert own(deep)[0] == pytest.approx(float(exact), rel=2e-14, abs=0.0)  # that polynomial itself: 1e-14 of 1


def test_christensens_heights_have_the_roughness_that_is_named() -> None:
    square = quad(lambda u: u**2 * 35.0 / 96.0 * (1.0 - (u / 3.0) ** 2) ** 3, -3.0, 3.0)[0]
    assert square == pytest.approx(1.0, abs=1e-12)


def test_greenwood_and_tripps_share_is_their_integral() -> None:
    """Of normal heights, within what is said of the fit."""

    def load(ratio: float) -> float:
        return float(quad(lambda u: (u - ratio) ** 2.5 * math.exp(-u * u / 2.0), ratio, 12.0, epsabs=0.0)[0])

    for ratio in np.linspace(0.0, 4.0, 17):
        assert share("greenwood_tripp", ratio) == pytest.approx(load(ratio) / load(0.0), abs=0.014)


@pytest.mark.parametrize("law", sorted(FIRST))
def test_limits(law: str) -> None:
    """None where tips just touch, all where no film is left; it never falls."""
    own = Evaluator(law, {"roughness": SIGMA})
    assert own(0.0)[0] == 0.0 and own(1e-12)[0] < 1e-20
    deep = (FIRST[law] - LAST[law]) * SIGMA
    assert own(deep)[0] == pytest.approx(1.0, abs=1e-13) and own(10.0 * deep)[0] == 1.0
    found = [own(x)[0] for x in np.linspace(0.0, 1.2 * deep, 400)]
    assert (np.diff(found) >= -1e-13).all()


def test_christensens_share_has_three_derivatives_at_both_ends() -> None:
    """Off the end by h it differs from what stands beyond by O(h⁴): 35/6⁴ (h/σ)⁴."""
    for end, beyond in ((3.0, 0.0), (-3.0, 1.0)):
        for h in (0.02, 0.01):
            inside = share("christensen", end - math.copysign(h, end))
            assert abs(inside - beyond) == pytest.approx(35.0 * (h / 6.0) ** 4, rel=0.01, abs=1e-15)


DISC = """
format: gudgeon/1
name: disc
gravity: [0, -9.81]
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies: {disc: {mass: 0.2 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, disc.com]}}
start: {play: {A: {e: [0.02 mm, 0], rate: [0.05, -0.8]}}, rates: {disc.omega: 30}}
bearings: {b: {radius: 15 mm, clearance: 0.1 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts:
  mixed:
    normal: {law: liu, restitution: 0.8}
    friction: {law: stribeck, mu: 0.1, mu_s: 0.15, v_s: 0.02, v0: 2e-3}
    film: {law: finite_length, viscosity: 1e-4, shear: true}
    mixed: {law: christensen, roughness: 1 um}
scenes: {mixed: {play: {A: {bearing: b, contact: mixed}}}}
"""


@needs_compiler
def test_methods_agree_and_energy_is_only_lost(tmp_path) -> None:  # type: ignore[no-untyped-def]
    """A journal that falls through a thin film onto the tips, and comes to rest on both together."""
    path = tmp_path / "disc.yaml"
    path.write_text(DISC)
    scene = gudgeon.load(path, scene="mixed")
    runs = [scene.simulate(t_end=0.02, method=method, rtol=1e-10) for method in ("rodas5p", "dop853")]
    gap = [np.asarray(run["A.delta"]) for run in runs]
    assert (gap[0] > 0.0).any() and (gap[0] < 0.0).any()
    assert gap[1] == pytest.approx(gap[0], abs=1e-10)
    energy = runs[1]["energy.kinetic"] + runs[1]["energy.potential"]
    assert energy[-1] < energy[0]

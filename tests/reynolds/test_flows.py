"""What flows: leakage, supply and their balance, oil that is carried in a ruptured film, torques of shear."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gudgeon.errors import BadValueError
from gudgeon.reynolds import Bearing, Film, solve

BEARING = Bearing(radius=15e-3, length=30e-3, clearance=30e-6, viscosity=0.03)
E, RATE, OMEGA = (12e-6, -14e-6), (4e-4, 3e-4), 120.0  # ε̇ is positive or, for the opposite rate, negative
LARGE = BEARING.clearance * BEARING.radius**2 * OMEGA  # m³/s


def film(cavitation: str, **how: object) -> Film:
    return solve(BEARING, E, **{"omega_journal": OMEGA, "cavitation": cavitation, **how})  # type: ignore[arg-type]


@pytest.mark.parametrize("rate", [(0.0, 0.0), RATE, (-RATE[0], -RATE[1])])
@pytest.mark.parametrize("cavitation", ["half_sommerfeld", "reynolds", "elrod_adams"])
@pytest.mark.parametrize("groove", [None, "widest", 1.0])
def test_what_comes_in_goes_out(cavitation: str, groove: object, rate: tuple[float, float]) -> None:
    one = film(cavitation, rate=rate, groove=groove)
    assert abs(one.balance) < 1e-13 * LARGE
    assert one.leakage > 1e-3 * LARGE and (one.taken_up != 0.0) == (cavitation == "elrod_adams" and any(rate))
    assert not one.pressure[:, [0, -1]].any() and (one.pressure >= 0.0).all()


@pytest.mark.parametrize("cavitation", ["half_sommerfeld", "reynolds", "elrod_adams"])
def test_leakage_is_the_slope_of_the_pressure_at_the_ends(cavitation: str) -> None:
    """−2 ∫ h³/(12 μ) ∂p/∂z R dφ, the slope by a parabola through the last places."""
    one = film(cavitation, cells=(384, 48))
    a, b = one.z[-2] - one.z[-1], one.z[-3] - one.z[-1]
    slope = (one.pressure[:, -2] * b / a - one.pressure[:, -3] * a / b) / (b - a)
    flow = -2.0 * one.thickness**3 / (12.0 * BEARING.viscosity) * slope * BEARING.radius
    around = np.diff(np.append(one.angle, one.angle[0] + 2.0 * math.pi))
    assert one.leakage == pytest.approx(float(0.5 * (flow + np.roll(flow, -1)) @ around), rel=0.01)


def test_leakage_of_a_short_bearing() -> None:
    """ω R L c ε (F. W. Ocvirk's film), and more of it with Reynolds' condition."""
    short = Bearing(radius=15e-3, length=1.5e-3, clearance=30e-6, viscosity=0.03)
    one = solve(short, (20e-6, 0.0), omega_journal=OMEGA, cavitation="half_sommerfeld")
    assert one.leakage == pytest.approx(OMEGA * 15e-3 * 1.5e-3 * 20e-6, rel=3e-3)
    assert film("half_sommerfeld").leakage < film("reynolds", groove="widest").leakage < film("reynolds").leakage


@pytest.mark.parametrize("groove", ["widest", 1.0, 5.0])
@pytest.mark.parametrize("omega", [OMEGA, -OMEGA])
def test_oil_is_carried_through_the_ruptured_film(omega: float, groove: float | str) -> None:
    """Steady: the groove feeds what leaks, θ ≤ 1, p (1 − θ) = 0, and outside of films what flows round, ½ ω_s θ h, is
    one number."""
    one = film("elrod_adams", omega_journal=omega, groove=groove, cells=(384, 24))
    assert one.supply == pytest.approx(one.leakage, rel=1e-11) and one.leakage > 0.0
    assert (one.content <= 1.0).all() and (one.content > 0.0).all() and not (one.pressure * (1.0 - one.content)).any()
    middle = one.content[:, len(one.z) // 2]
    empty = (middle < 1.0) & (np.roll(middle, 1) < 1.0) & (np.roll(middle, -1) < 1.0)
    flow = middle * one.thickness
    both = empty[1:] & empty[:-1]
    assert both.sum() > 60
    assert abs(np.diff(flow) / flow[1:])[both].max() < 2e-3 and np.ptp(middle[empty]) > 0.1


def test_elrod_adams_with_a_groove_at_the_widest_gap_is_reynolds() -> None:
    """Rupture is the same, and the film begins where it is told: the same pressure, forces and leakage."""
    jakobsson, swift = film("elrod_adams"), film("reynolds", groove="widest")
    assert jakobsson.pressure == pytest.approx(swift.pressure, abs=1e-12 * swift.pressure.max())
    assert jakobsson.leakage == pytest.approx(swift.leakage, rel=1e-11)
    assert jakobsson.content.min() < 0.5 and (swift.content == 1.0).all()
    half = film("half_sommerfeld")
    assert abs(half.attitude - jakobsson.attitude) < math.radians(8.0) and half.leakage < jakobsson.leakage


def test_a_starved_film_carries_less() -> None:
    """A groove behind the thinnest place feeds less than one before it; Reynolds' condition feeds its film anyway."""
    thinnest = math.atan2(E[1], E[0])
    before, behind = (film("elrod_adams", groove=thinnest + x) for x in (-2.5, 0.6))
    assert behind.leakage < 0.3 * before.leakage and np.hypot(*behind.force) < 0.6 * np.hypot(*before.force)


@pytest.mark.parametrize("cavitation", ["half_sommerfeld", "reynolds", "elrod_adams"])
@pytest.mark.parametrize("ends", ["open", "sealed"])
def test_torques_are_those_of_the_shear_stress(cavitation: str, ends: str) -> None:
    """−∬ (h/2 ∂p/∂x ± μ R (ω_j − ω_i) θ/h) R dA by differences; no moment is left over: T_j + T_i + e × F = 0."""
    omega_i = -30.0
    one = film(cavitation, omega_bearing=omega_i, ends=ends, cells=(384, 24))
    angle, first = np.append(one.angle, one.angle[0] + 2.0 * math.pi), [*range(len(one.angle)), 0]
    p, theta, h = one.pressure[first], one.content[first], one.thickness[first, None]
    r, slip = BEARING.radius, OMEGA - omega_i
    push = np.diff(p, axis=0) * 0.5 * (h[1:] + h[:-1]) / 2.0
    drag = BEARING.viscosity * r**2 * slip * theta / h
    push_all = r * float(np.trapezoid(push.sum(axis=0), one.z))
    drag_all = r * float(np.trapezoid(np.trapezoid(drag, angle, axis=0), one.z))
    assert one.torque_journal == pytest.approx(-push_all - drag_all, rel=3e-3)
    assert one.torque_bearing == pytest.approx(drag_all - push_all, rel=3e-3)
    if cavitation != "elrod_adams":
        exact = 2.0 * math.pi * BEARING.viscosity * r**3 * BEARING.length * slip / BEARING.clearance
        exact /= math.sqrt(1.0 - one.eccentricity_ratio**2)
        assert 0.5 * (one.torque_bearing - one.torque_journal) == pytest.approx(exact, rel=1e-12)
    moment = E[0] * one.force[1] - E[1] * one.force[0]
    assert one.torque_journal + one.torque_bearing + moment == pytest.approx(0.0, abs=1e-12 * drag_all)


def test_elrod_adams_refuses_what_it_cannot_know() -> None:
    with pytest.raises(BadValueError, match="omega_s = 0"):
        film("elrod_adams", omega_bearing=-OMEGA)
    with pytest.raises(BadValueError, match="closes faster"):
        solve(BEARING, (27e-6, 0.0), (-0.5, 0.0), omega_journal=1.0, cavitation="elrod_adams")

"""What flows: leakage, supply and their balance, oil that is carried in a ruptured film, torques of shear."""

from __future__ import annotations

import math
import os
import signal
from threading import Event, Thread, current_thread, main_thread

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.reynolds import Bearing, Film, solve
from gudgeon.reynolds import cavitation as cavitations

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


def test_ctrl_c_does_not_wait_for_a_factorization(monkeypatch: pytest.MonkeyPatch) -> None:
    """Which another thread is in the middle of, for as long as a large one; what it raises itself is told as ever."""
    begun, over = list[Thread](), Event()

    def long(*_: object, **__: object) -> None:
        begun.append(current_thread())
        os.kill(os.getpid(), signal.SIGINT)
        over.wait(60.0)

    def singular(*_: object, **__: object) -> None:
        raise RuntimeError

    monkeypatch.setattr(cavitations, "MIN_THREADED_UNKNOWNS", 0)
    monkeypatch.setattr(cavitations, "splu", long)
    with pytest.raises(KeyboardInterrupt):
        film("reynolds")
    alive = begun[0].is_alive()
    over.set()
    assert alive and begun[0] is not main_thread()
    monkeypatch.setattr(cavitations, "splu", singular)
    with pytest.raises(GudgeonError, match="too thin for doubles"):
        film("reynolds")


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
    one = film("elrod_adams", omega_journal=omega, groove=groove, cells=(192, 24))
    assert one.supply == pytest.approx(one.leakage, rel=1e-11) and one.leakage > 0.0
    assert (one.content <= 1.0).all() and (one.content > 0.0).all() and not (one.pressure * (1.0 - one.content)).any()
    middle = one.content[:, len(one.z) // 2]
    empty = (middle < 1.0) & (np.roll(middle, 1) < 1.0) & (np.roll(middle, -1) < 1.0)
    flow = middle * one.thickness
    both = empty[1:] & empty[:-1]
    assert both.sum() > 30
    assert abs(np.diff(flow) / flow[1:])[both].max() < 4e-3 and np.ptp(middle[empty]) > 0.1


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


def test_a_film_without_oil_is_found_too() -> None:
    """A gap that opens at ε = .99, the groove far behind: films come and go while one is looked for, none is there."""
    turn = 0.2128813559322034
    dry = solve(
        Bearing(0.01, 0.0326, 1e-5, 0.1),
        (9.906e-6 * math.cos(turn), 9.906e-6 * math.sin(turn)),
        (-8.6e-6, 3.6e-6),
        omega_journal=2.2693,
        cavitation="elrod_adams",
        groove=6.2059,
    )
    assert abs(dry.balance) < 1e-13 * 2.27e-9 and dry.content.min() > 0.0 and (dry.pressure >= 0.0).all()


def test_where_a_film_forms_again() -> None:
    """Sealed and steady, the groove at φ_g behind the thinnest place: it feeds nothing, and ½ ω h_g flows everywhere.

    So p' = 6 (h − h_g)/h³ from where the film forms, ∫ p' dφ = 0 up to the groove says where, and θ h = h_g elsewhere.
    Where a film forms again the cells are of the first order.
    """
    eps, at = 0.6, math.radians(212.0)
    h_g = 1.0 + eps * math.cos(at)

    def slope(phi: float) -> float:
        h = 1.0 + eps * math.cos(phi)
        return 6.0 * (h - h_g) / h**3

    forms = brentq(lambda a: quad(slope, a, at)[0], 0.1, 2.0 * math.pi - at)
    x = np.linspace(forms, at, 1001)
    p = np.array([quad(slope, forms, a)[0] for a in x])
    want = np.array([np.trapezoid(p * np.cos(x), x), np.trapezoid(p * np.sin(x), x)])
    unit, off = BEARING.viscosity * BEARING.radius**3 * BEARING.length / BEARING.clearance**2 * OMEGA, []
    for around in (192, 768, 3072):
        one = solve(
            BEARING,
            (-eps * BEARING.clearance, 0.0),
            omega_journal=OMEGA,
            cavitation="elrod_adams",
            ends="sealed",
            groove=at,
            cells=(around, 4),
        )
        off.append(float(np.hypot(one.radial / unit - want[0], one.tangential / unit - want[1])))
        assert off[-1] < one.error / unit and abs(one.supply) < 1e-9 * LARGE
    assert off[-1] < 0.01 * np.hypot(*want)
    assert off[0] / off[1] == pytest.approx(4.0, rel=0.1) and off[1] / off[2] == pytest.approx(4.0, rel=0.1)
    assert one.extent is not None and one.extent[0] == pytest.approx(forms, abs=0.02)

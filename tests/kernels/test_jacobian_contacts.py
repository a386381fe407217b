"""The Jacobian in joints with play: film, transition, dry contact, every region of friction, the centre."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.simulation.simulation import Simulation
from tests.equations.subjects import NAN, Subject, assert_columns, make
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = [needs_compiler, pytest.mark.plain]
SHIPPED = find_shipped_file("nine_bar_press").read_text(encoding="utf-8")
# Bearings, contacts and scenes of the press in a linkage of three bodies: A turns with the crank, B stands still.
PRESS = (
    """
format: gudgeon/1
name: press
gravity: [0, -9.81 m/s^2]
parameters: {omega: 2*pi rad/s, c: 0.3 mm}
bodies:
  L1: {length: 80 mm, mass: 0.142 kg, inertia: 3.030e-4 kg*m^2}
  L2: {length: 250 mm, mass: 0.284 kg, inertia: 1.479e-3 kg*m^2}
  L3: {length: 350 mm, mass: 0.396 kg, inertia: 4.042e-3 kg*m^2}
ground: {O1: [0, 0], O4: [0, -300 mm]}
joints:
  O1: {revolute: [ground.O1, L1.tail]}
  A: {revolute: [L1.head, L2.tail]}
  B: {revolute: [ground.O4, L3.tail]}
  P: {revolute: [L2.head, L3.head]}
drives: {crank1: {angle: L1, value: -39.52 deg + omega * t}}
start: {guess: {L2.theta: -39.5 deg, L3.theta: 19.5 deg}}
"""
    + SHIPPED[SHIPPED.index("materials:") : SHIPPED.index("bodies:")]
    + SHIPPED[SHIPPED.index("bearings:") : SHIPPED.index("outputs:")]
).encode()
C = 0.3e-3  # clearance
OIL: dict[str, dict[str, object]] = {
    "plain": {},
    "as_printed": {"contacts__oil__film__as_printed": True},
    "shear": {"contacts__oil__film__shear": True},
    "relative": {"contacts__oil__film__angular_velocity": "relative"},
    "internal": {"contacts__oil__normal__geometry": "internal"},
    "clipped": {"contacts__oil__clip_ratio": True},
}
OIL["all but as printed"] = {key: x for name, one in OIL.items() if name != "as_printed" for key, x in one.items()}
KEPT = "plain", "as_printed", "all but as printed"


@cache
def oiled(option: str) -> Subject:
    return make(PRESS, "press", "lubricated", None, **OIL[option])


@cache
def start_of(bodies: int, scene: str) -> np.ndarray:
    if bodies == 3:
        start = Simulation(make(PRESS, "press", scene).library, Path("press.yaml")).start()
    else:
        start = gudgeon.load("nine_bar_press", scene).start()
    return np.concatenate([start.q, start.v])


def journal_at(subject: Subject, e: tuple[float, float], rate: tuple[float, float], spin: float) -> np.ndarray:
    """The linkage at its start, joint A's journal at e (m), moving at `rate` (m/s), L2 turning at `spin` (rad/s)."""
    n, bodies = subject.n, len(subject.model.bodies)
    y = start_of(bodies, subject.library.source.scene).copy()
    body = next(body.index for body in subject.model.bodies if body.name == "L2")
    y[n + body + 2] = spin
    other = next(body.index for body in subject.model.bodies if body.name == "L3")
    y[other : other + 2] += 0.2 * C, -0.1 * C  # joint B too is off its centre, where a film as printed has a kink
    y[n + other : n + other + 2] += 0.01, 0.02
    for first, expected, part in ((0, e, slice(0, 2)), (n, rate, slice(2, 4))):
        y[first + body : first + body + 2] += expected - subject.eccentricity(0.0, y[:n] + 0j, y[n:] + 0j).real[part]
    return y


@pytest.mark.parametrize("option", slow_but(KEPT, OIL))
@pytest.mark.parametrize("eps", [1e-3, 0.1, 0.5, 0.9, 0.99, 0.99995, 1.0005, 1.01, 1.03])
def test_film_transition_and_contact(option: str, eps: float) -> None:
    """Film at all eccentricities, its cap, the blend, beyond it: the journal comes, goes and whirls, latched or not."""
    subject, rng = oiled(option), np.random.default_rng(int(1e4 * eps))
    for memory in ((NAN, NAN), (0.02, NAN)):
        for _ in range(3):
            turn = rng.uniform(0.0, 2.0 * np.pi)
            e = (eps * C * np.cos(turn), eps * C * np.sin(turn))
            y = journal_at(subject, e, tuple(rng.uniform(-0.05, 0.05, 2)), float(rng.uniform(-20.0, 20.0)))
            subject.compare(0.0, y, np.array(memory))


SIGMA = 2e-6  # m, roughness


@cache
def mixed(law: str, film: str) -> Subject:
    """The linkage with a law of mixed lubrication in place of the paper's transition."""
    text = PRESS.replace(b"    transition: 5 um", f"    mixed: {{law: {law}, roughness: 2 um}}".encode())
    return make(text.replace(b"pinkus_sternlicht", film.encode()), "press", "lubricated")


# test_every_law has the slopes of the first pair too
MIXED = ("christensen", "finite_length", 3), ("greenwood_tripp", "ocvirk", 4)


@pytest.mark.parametrize("pair", slow_but(MIXED[1:], MIXED), ids="{0[0]}-{0[1]}".format)
@pytest.mark.parametrize("ratio", [60.0, 3.99, 2.5, 0.4, -1.0, -2.99, -3.5])
def test_mixed_lubrication(pair: tuple[str, str, int], ratio: float) -> None:
    """At film thickness ratios above, in and below what its laws share, latched or not."""
    law, film, first = pair
    subject, rng = mixed(law, film), np.random.default_rng(int(100.0 * (ratio + 4.0)))
    for memory in ((NAN, NAN), (0.02, NAN)):
        for _ in range(2):
            turn, e = rng.uniform(0.0, 2.0 * np.pi), C + (first - ratio) * SIGMA
            rate, spin = tuple(rng.uniform(-0.05, 0.05, 2)), float(rng.uniform(-20.0, 20.0))
            y = journal_at(subject, (e * np.cos(turn), e * np.sin(turn)), rate, spin)
            subject.compare(0.0, y, np.array(memory), 2e-9)  # e is a difference, of which a film that thin is steep


@pytest.mark.parametrize("latched", [NAN, 0.01])
@pytest.mark.parametrize("slip", [-0.5, -5e-4, -2e-5, 0.0, 2e-5, 5e-4, 0.5])
@pytest.mark.parametrize("rate", [0.02, -0.02, -0.5])
def test_every_region_of_dry_friction(slip: float, latched: float, rate: float) -> None:
    """No friction below v0, its rise to v1, all of it; compression, restitution, and where F_n would pull."""
    subject = make(PRESS, "press", "dry")
    delta, R_i, R_j = 2e-5, 15e-3, 14.7e-3
    omega_i = journal_at(subject, (0.0, 0.0), (0.0, 0.0), 0.0)[subject.n + 2]
    spin = (slip + (R_i + delta / 2) * omega_i) / (R_j - delta / 2)
    y = journal_at(subject, (C + delta, 0.0), (rate, 0.0), spin)
    assert abs(clearance(subject, y)[8] - slip) < 1e-12
    J = subject.compare(0.0, y, np.array([latched, NAN]))
    assert np.abs(J[subject.n : 2 * subject.n, : subject.n]).max() > (1e4 if rate > 0 else 0.0)


def clearance(subject: Subject, y: np.ndarray) -> np.ndarray:
    """Columns of joint A."""
    n = subject.n
    got = subject.library.evaluate([0.0], y[None, :n], y[None, n:], np.full((1, 2), NAN), subject.p)
    return np.asarray(got.clearance[0, 0])


# A disc in a bearing of the ground: its eccentricity is (x, y) itself, so that it may be exactly zero.
DISC = """
format: gudgeon/1
name: disc
materials: {{steel: {{E: 206 GPa, nu: 0.3}}}}
bodies: {{disc: {{mass: 0.2 kg, inertia: 1e-4 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{pin: {{revolute: [ground.O, disc.com]}}}}
bearings: {{b: {{radius: 15 mm, clearance: 0.3 mm, length: 40 mm, bearing_material: steel, journal_material: steel}}}}
contacts: {{oil: {{film: {{law: pinkus_sternlicht, viscosity: 0.1, {option}: {value}}}}}}}
scenes: {{oiled: {{play: {{pin: {{bearing: b, contact: oil}}}}}}}}
"""


@pytest.mark.parametrize("option", [("shear", "true"), ("as_printed", "true"), ("angular_velocity", "relative")])
@pytest.mark.parametrize("rate", [(0.03, -0.01), (0.0, 0.02), (1e-7, 0.0)])
def test_a_film_alone_and_its_centre(option: tuple[str, str], rate: tuple[float, float]) -> None:
    """Exact at e = 0 and elsewhere."""
    subject, memory = make(DISC.format(option=option[0], value=option[1]).encode(), "disc", "oiled"), np.array([NAN])
    for eps in (0.0, 1e-3, 0.5, 0.95):
        subject.compare(0.0, np.array([0.6 * eps * C, -0.8 * eps * C, 0.3, *rate, 3.0]), memory)


def test_a_film_next_to_its_centre() -> None:
    """As at the centre to O(e), and exact but for what cancels there."""
    subject, memory = make(DISC.format(option="shear", value="true").encode(), "disc", "oiled"), np.array([NAN])
    centred = subject.compare(0.0, np.array([0.0, 0.0, 0.3, 0.03, -0.01, 3.0]), memory)
    for eps, tolerance in ((1e-6, 1e-8), (2e-8, 1e-6), (1e-9, 1e-6)):
        y = np.array([0.6 * eps * C, -0.8 * eps * C, 0.3, 0.03, -0.01, 3.0])
        assert_columns(subject.compare(0.0, y, memory, tolerance), centred, 3, 100.0 * eps)


@pytest.mark.parametrize("e", [0.0, 0.5 * C])
def test_a_journal_at_rest_has_a_finite_jacobian(e: float) -> None:
    """Without any motion the film's force is none and not differentiable: one of its slopes, no 0/0."""
    subject = make(PRESS, "press", "lubricated", {"parameters.omega": 0.0})
    y = journal_at(subject, (e, 0.0), (0.0, 0.0), 0.0)
    y[subject.n :] = 0.0
    J, f_t = subject.library.jacobian(0.0, y, subject.p)
    assert np.isfinite(J).all()
    assert np.isfinite(f_t).all()


@pytest.mark.parametrize("dissipation", slow_but(["flores"], ["none", "flores"]))
def test_a_law_of_hertz_without_friction(dissipation: str) -> None:
    text = PRESS.replace(
        b"lankarani_nikravesh, restitution: 0.9",
        b"hertz, stiffness: 1e9, exponent: 1.3, restitution: 0.8, dissipation: " + dissipation.encode(),
    ).replace(b", geometry: external", b"")
    subject = make(text, "press", "dry")
    for memory in ((NAN, NAN), (0.02, NAN)):
        subject.compare(0.0, journal_at(subject, (0.0, 1.1 * C), (0.01, 0.03), 2.0), np.array(memory))


@pytest.mark.parametrize("scene", slow_but(["lubricated"], ["dry", "lubricated"]))
def test_a_law_of_the_rate_itself(scene: str) -> None:
    """Kelvin and Voigt's: slopes by δ̇, pushing and let go, alone and in the transition from a film."""
    text = PRESS.replace(b"lankarani_nikravesh, restitution: 0.9", b"kelvin_voigt, stiffness: 1e7, damping: 2e3")
    subject = make(text.replace(b", geometry: external", b""), "press", scene)
    for rate in (0.3, -0.02, -2.0):
        for memory in ((NAN, NAN), (0.02, NAN)):
            subject.compare(0.0, journal_at(subject, (0.3 * C, -1.05 * C), (0.0, -rate), 2.0), np.array(memory))


LAWS = "lankarani_nikravesh, restitution: 0.9", "kelvin_voigt, stiffness: 1e7, damping: 2e3"


@pytest.mark.parametrize("law", slow_but(LAWS[:1], LAWS))
@pytest.mark.parametrize("latched", [NAN, 0.02])
def test_a_bearing_that_is_no_circle(law: str, latched: float) -> None:
    """A contour of 16 depths, steep and turning with its body: exact by the angle, the bearing's too, with friction."""
    subject, rng = on_contour(law), np.random.default_rng(16)
    for _ in range(4):
        turn, depth = rng.uniform(0.0, 2.0 * np.pi), C + rng.uniform(30e-6, 60e-6)
        e, rate = (depth * np.cos(turn), depth * np.sin(turn)), tuple(rng.uniform(-0.05, 0.05, 2))
        y = journal_at(subject, e, rate, float(rng.uniform(-20.0, 20.0)))
        J = subject.compare(0.0, y, np.array([latched, NAN]))
        bearing = subject.model.clearances[0].first.body
        assert bearing is not None and np.abs(J[subject.n : 2 * subject.n, bearing.index + 2]).max() > 1e3


@cache
def on_contour(law: str) -> Subject:
    """The dry linkage, joint A's bearing 0 to 25 µm deeper than its circle."""
    text = PRESS.replace(b"{A: {bearing: pin, contact: dry}", b"{A: {bearing: pin, contact: dry, contour: 16}")
    text = text.replace(b"lankarani_nikravesh, restitution: 0.9, geometry: external", law.encode())
    depths = np.random.default_rng(3).uniform(0.0, 25e-6, 16)
    values = {f"scenes.dry.play.A.contour.{k}": float(x) for k, x in enumerate(depths)}
    return make(text, "press", "dry", values)


BRISTLES = {
    "dahl": b"{law: dahl, mu: 0.15, presliding: 20 um}",
    "lugre": b"{law: lugre, mu: 0.15, mu_s: 0.2, v_s: 1 cm/s, stiffness: 2e4 1/m, damping: 3 s/m}",
}


BENT = ("dahl", "dry"), ("lugre", "lubricated"), ("lugre", "dry"), ("dahl", "lubricated")


@pytest.mark.parametrize("of", slow_but(BENT[:2], BENT), ids="-".join)
def test_a_law_with_an_internal_state(of: tuple[str, str]) -> None:
    """Of forces by the state, of its rate by everything; A in contact, B beside it free, both; dry and blended."""
    law, scene = of
    before = PRESS if scene == "dry" else SHIPPED.encode()  # its bodies tell how far a solve within the blend goes
    text = before.replace(b"{law: modified_coulomb, mu: 0.15, v0: 1e-4 m/s, v1: 1e-3 m/s}", BRISTLES[law])
    assert text != before
    subject, rng = make(text, "press", scene), np.random.default_rng(8)
    for eps in (0.5, 1.0005, 1.05):
        for spin in (-20.0, 0.0, 3.0):
            y = journal_at(subject, (0.8 * eps * C, -0.6 * eps * C), tuple(rng.uniform(-0.05, 0.05, 2)), spin)
            for latched in (NAN, 0.02):
                memory = np.array([latched, NAN, *rng.uniform(-2e-5, 2e-5, 2)])
                J = subject.compare(0.0, y, memory)
                r = rng.normal(size=len(J)) * (abs(J).max(axis=1) + 1.0)
                for eta in (1e-6, 1e-3):
                    u = subject.library.solve_newton_system(0.0, y, subject.p, eta, 0.0, r, memory)
                    exact = np.linalg.solve(np.eye(len(J)) / eta - J, r)
                    assert abs(u - exact).max() < 1e-8 * abs(exact).max()
                assert J[subject.n : 2 * subject.n, -2].any() == (eps > 1.0)  # what bends in A moves the bodies
                assert not J[:, -1].any() and not J[-1].any()  # B is free

"""The oracles against each other, textbooks and the figures of the source: before they judge, they are judged."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.oracles import dry, film, finite_bearing, golden, ideal_press, numpy_linkage, press_dense, random_linkage
from tests.oracles.journal import Journal
from tests.oracles.numpy_linkage import Body, Drive, End, Linkage, Revolute, Translational, Wave
from tests.programs import needs_compiler


def test_ideal_press_has_the_stroke_and_speeds_of_the_source() -> None:
    m = ideal_press.motion(np.linspace(0.0, 1.0, 4001))
    y, v, a = m.q[:, 22], m.v[:, 22], m.a[:, 22]
    assert y[0] == pytest.approx(-0.48, abs=5e-7)
    assert (y.min(), y.max()) == pytest.approx((-0.480000, -0.383426), abs=5e-7)
    assert np.ptp(y) == pytest.approx(0.09657, abs=5e-6)
    assert abs(v).max() == pytest.approx(0.6448, abs=5e-5)
    assert (a.min(), a.max()) == pytest.approx((-5.29, 8.00), abs=5e-3)


@pytest.mark.parametrize("t", [0.0, 0.123, 0.5, 0.77])
def test_ideal_press_against_fifty_digits(t: float) -> None:
    m = ideal_press.motion(t)
    y, v, a = (float(x) for x in ideal_press.slider_mp(t))
    assert m.q[0, 22] == pytest.approx(y, abs=1e-15)
    assert m.v[0, 22] == pytest.approx(v, abs=1e-14)
    assert m.a[0, 22] == pytest.approx(a, abs=1e-12)


def test_ideal_press_derivatives_of_every_coordinate() -> None:
    h, t = 1e-5, np.linspace(0.0, 1.0, 37)
    before, now, after = (ideal_press.motion(t + s) for s in (-h, 0.0, h))
    assert np.allclose((after.q - before.q) / (2 * h), now.v, atol=2e-7)
    assert np.allclose((after.v - before.v) / (2 * h), now.a, atol=2e-6)


def press_linkage() -> Linkage:
    """The ideal press as data of the general oracle."""
    d = press_dense.Press()
    g = d.geometry
    bodies = tuple(Body(m, j) for m, j in zip(d.mass, d.inertia, strict=True))
    length = dict(zip(ideal_press.BODIES, (g.l1, g.l2, g.l3, g.l4, g.l6, g.l7, g.l8, 0.0), strict=True))

    def end(body: str, side: float) -> End:
        return End(ideal_press.BODIES.index(body), (side * length[body] / 2.0, 0.0))

    pins = [("L1", 1, "L2", -1), ("L4", 1, "L3", -1), ("L2", 1, "L7", -1), ("L3", 1, "L7", -1), ("L7", 1, "L6", 1)]
    pins += [("L7", 1, "L8", -1), ("L8", 1, "S9", 1)]
    ground = [((0.0, 0.0), "L1"), ((0.0, -g.l5), "L4"), ((g.hx, g.hy), "L6")]
    joints: list[Revolute | Translational] = [Revolute(end(a, i), end(b, j)) for a, i, b, j in pins]
    joints += [Revolute(End(-1, at), end(body, -1)) for at, body in ground]
    joints.append(Translational(End(-1, (g.hx, g.hy)), end("S9", 0), (0.0, 1.0), math.pi / 2.0))
    drives = (Drive(0, -1, Wave(g.theta1, g.omega1)), Drive(3, -1, Wave(g.theta4, g.omega4)))
    return Linkage(bodies, tuple(joints), drives, (), (0.0, -d.gravity))


def test_general_oracle_moves_the_ideal_press_as_its_closed_form() -> None:
    linkage, times = press_linkage(), np.linspace(0.0, 1.0, 11)
    m = ideal_press.motion(times)
    for t, q, v, a in zip(times, m.q, m.v, m.a, strict=True):
        r = numpy_linkage.rows(linkage, t, q, v)
        assert abs(r.phi).max() < 1e-15
        assert abs(r.phi_q @ v - r.nu).max() < 1e-14
        assert np.allclose(numpy_linkage.accelerations(linkage, t, q, v)[0], a, atol=1e-10)


@pytest.mark.parametrize("seed", range(12))
def test_general_oracle_differentiates_its_own_rows(seed: int) -> None:
    case = random_linkage.random_case(seed, bodies=2 + seed % 4, loops=seed % 3, drives=seed % 3)
    linkage, q, v, h = case.linkage, case.q, case.v, 1e-6
    r = numpy_linkage.rows(linkage, 0.0, q, v)
    assert abs(r.phi).max() < 1e-14
    assert abs(r.phi_q @ v - r.nu).max() < 1e-12
    difference = [
        (numpy_linkage.rows(linkage, 0.0, q + s, v).phi - numpy_linkage.rows(linkage, 0.0, q - s, v).phi) / (2 * h)
        for s in h * np.eye(q.size)
    ]
    assert np.allclose(np.transpose(difference), r.phi_q, atol=1e-9)

    def rate(t: float) -> np.ndarray:  # Φ_q v − ν along q + t v, v held: its derivative is −γ
        at = numpy_linkage.rows(linkage, t, q + t * v, v)
        return np.asarray(at.phi_q @ v - at.nu)

    assert np.allclose((rate(-h) - rate(h)) / (2 * h), r.gamma, atol=1e-8)


def test_random_linkages_are_reproducible() -> None:
    first, second = (random_linkage.random_case(7, bodies=5, loops=2, drives=2) for _ in range(2))
    assert first.linkage == second.linkage
    assert np.array_equal(first.q, second.q) and np.array_equal(first.v, second.v)


@pytest.mark.parametrize(
    ("state", "pressure", "formula"),
    [
        ((0.5, 1.0, 10.0), (-57.24, 67.94), (-55.23, 60.14)),
        ((0.7, 1.0, 10.0), (-114.27, 99.94), (-114.80, 95.55)),
        ((0.9, 1.0, 10.0), (-500.43, 196.49), (-505.56, 194.16)),
        ((0.7, -1.0, 10.0), (-10.76, 48.46), (-11.29, 52.85)),
    ],
)
def test_film_table(
    state: tuple[float, float, float], pressure: tuple[float, float], formula: tuple[float, float]
) -> None:
    assert film.gumbel_film(*state) == pytest.approx(pressure, abs=5e-3)
    assert film.pinkus_sternlicht(*state) == pytest.approx(formula, abs=5e-3)


@pytest.mark.parametrize("eps", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("omega_s", [-7.0, 7.0])
def test_film_limits(eps: float, omega_s: float) -> None:
    steady = film.steady(eps, omega_s)
    for eps_rate in (1e-12, -1e-12):
        assert film.pinkus_sternlicht(eps, eps_rate, omega_s) == pytest.approx(steady, rel=1e-9)
        assert film.pinkus_sternlicht(1e-12, eps_rate * 1e12, omega_s)[0] == pytest.approx(
            film.centred(eps_rate * 1e12), rel=1e-9
        )
        assert film.pinkus_sternlicht(eps, eps_rate, 0.0)[0] == pytest.approx(
            film.pure_squeeze(eps, eps_rate), rel=1e-12
        )
    assert film.gumbel_film(eps, 0.0, omega_s) == pytest.approx(steady, rel=1e-7)


@pytest.mark.slow
def test_the_long_film_overstates_a_finite_bearing() -> None:
    """Figures of docs/physics.md; a very long bearing carries what the long one does."""
    assert finite_bearing.overstated(0.9, False) == pytest.approx(1.44, abs=0.01)
    assert finite_bearing.overstated(0.9, True) == pytest.approx(1.19, abs=0.01)
    assert finite_bearing.overstated(0.5, False, 200.0) == pytest.approx(1.0, abs=0.01)


def test_film_as_printed_jumps_and_works_the_wrong_way() -> None:
    approach, leave = (film.pinkus_sternlicht(0.6, x, 10.0, as_printed=True)[0] for x in (1e-9, -1e-9))
    assert approach == pytest.approx(-leave, rel=1e-6)
    radial = film.pinkus_sternlicht(0.6, -1.0, 0.0, as_printed=True)[0]
    assert radial * -1.0 > 0.0  # power of the film in a pure squeeze: it must not be positive


@pytest.mark.parametrize(("given", "delivered"), [(0.9, 0.91318), (0.5, 0.72524)])
def test_restitution_that_lankarani_nikravesh_delivers(given: float, delivered: float) -> None:
    factor = dry.dissipation_factor(given)
    assert dry.delivered(factor) == pytest.approx(delivered, abs=5e-6)
    for exponent, stiff, mass, speed in ((1.5, 1e9, 0.1, 0.2), (1.0, 3e7, 2.0, 3.0), (2.2, 5e9, 0.4, 0.01)):
        assert dry.impact(factor, exponent, stiff, mass, speed) == pytest.approx(dry.delivered(factor), abs=1e-9)


@needs_compiler
def test_dense_press_starts_on_its_constraints() -> None:
    press = golden.FILM
    phi, rate = press_dense.constraints(press, 0.0, press_dense.start(press))
    assert abs(phi).max() < 1e-15 and abs(rate).max() < 1e-14


@needs_compiler
def test_dense_press_against_the_general_oracle() -> None:
    """Joint forces of the dense C press, given to the general oracle as applied wrenches: the same accelerations."""
    rng = np.random.default_rng(3)
    full = press_linkage()
    for press in (golden.DRY, golden.FILM, replace(golden.FILM, common_point=True)):
        y = press_dense.start(press)
        y += rng.normal(0.0, 2e-4, y.size) * np.r_[np.full(24, press.clearance / 6e-4), np.full(24, 100.0)]
        dy, _, contacts = press_dense.rhs(press, 0.0, y, (0.01, 0.02))
        q, v = y[:24], y[24:]
        drives = tuple(
            replace(d, law=Wave(a, w))
            for d, a, w in zip(
                (d for d in full.drives if isinstance(d, Drive)),
                (press.geometry.theta1, press.geometry.theta4),
                (press.geometry.omega1, press.geometry.omega4),
                strict=True,
            )
        )
        open_joints = Linkage(full.bodies, full.joints[2:], drives, (), full.gravity)
        r = numpy_linkage.rows(open_joints, 0.0, q, v)
        g = numpy_linkage.forces(open_joints, q, v)
        for (i, j), c in zip(((0, 1), (3, 2)), contacts, strict=True):
            g[3 * j : 3 * j + 3] += (c.fx, c.fy, c.moment_j)
            g[3 * i : 3 * i + 3] += (-c.fx, -c.fy, c.moment_i)
        kkt = np.block([[np.diag(numpy_linkage.mass(full)), r.phi_q.T], [r.phi_q, np.zeros((20, 20))]])
        phi_dot = r.phi_q @ v - r.nu
        x = np.linalg.solve(kkt, np.concatenate([g, r.gamma - 100.0 * phi_dot - 2500.0 * r.phi]))
        assert np.allclose(dy[24:], x[:24], rtol=1e-9, atol=1e-9 * abs(x[:24]).max())


@needs_compiler
def test_dry_forces_leave_a_couple_unless_they_share_a_point() -> None:
    """The pair of dry forces: with the forces at each surface's Q_k a couple δ F_t is left, with one point none."""
    y = press_dense.start(golden.DRY)
    y[3] += 0.32e-3  # journal of A pressed 20 µm into its bearing, along x
    y[27:30] += (0.01, 0.1, 3.0)
    for common, left in ((False, True), (True, False)):
        press = replace(golden.DRY, common_point=common)
        a = press_dense.rhs(press, 0.0, y, (1.0, 0.0))[2][0]
        between = np.array([y[3] - y[0], y[4] - y[1]])  # centre of L2 seen from the centre of L1
        couple = a.moment_i + a.moment_j + between[0] * a.fy - between[1] * a.fx
        assert a.delta > 1e-5 and abs(a.fy) > 1.0
        assert abs(couple) == pytest.approx(a.delta * abs(a.fy) if left else 0.0, rel=1e-9, abs=1e-12)


@needs_compiler
@pytest.mark.parametrize("push", [0.05e-3, 0.2999e-3, 0.302e-3, 0.32e-3])
@pytest.mark.parametrize("lubricated", [False, True])
def test_journal_against_the_dense_press(push: float, lubricated: bool) -> None:
    press = replace(golden.DRY, film=lubricated, common_point=True)
    y = press_dense.start(press)
    y[3:5] += push * np.array([0.6, -0.8])
    y[24:] += np.random.default_rng(5).normal(0.0, 0.05, 24)
    c = press_dense.rhs(press, 0.0, y, (0.7, 0.0))[2][0]
    one, two = End(0, (0.04, 0.0)), End(1, (-0.125, 0.0))
    law = Journal(viscosity=0.1 if lubricated else 0.0, stored=0.7)
    i, j = (numpy_linkage.place(end, y[:24], y[24:]) for end in (one, two))
    wrench = law(j.r - i.r, j.v - i.v, i.omega, j.omega)
    assert wrench.force == pytest.approx((c.fx, c.fy), rel=1e-9)
    moment_i = float(i.r_q[:, 2] @ -wrench.force) + wrench.moment_first
    moment_j = float(j.r_q[:, 5] @ wrench.force) + wrench.moment_second
    assert (moment_i, moment_j) == pytest.approx((c.moment_i, c.moment_j), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(
    "law",
    [Journal(stored=0.1), Journal(viscosity=0.1, stored=0.1), Journal(viscosity=0.1, stored=0.1, shear=True)],
    ids=["dry", "film", "shear"],
)
@pytest.mark.parametrize("size", [0.1e-3, 0.29e-3, 0.303e-3, 0.31e-3])
def test_journal_leaves_no_couple(law: Journal, size: float) -> None:
    """Force at the journal, −force at the bearing, and both moments: nothing is left about any point."""
    e = size * np.array([0.28, -0.96])
    wrench = law(e, np.array([0.02, 0.05]), 3.0, -7.0)
    couple = e[0] * wrench.force[1] - e[1] * wrench.force[0] + wrench.moment_first + wrench.moment_second
    assert couple == pytest.approx(0.0, abs=1e-14 * max(1.0, float(np.hypot(*wrench.force))))


@pytest.mark.slow
@needs_compiler
def test_golden_film_case_by_two_routes() -> None:
    """RK4 at 2e-5 s and Radau with its own step control: the same numbers as in golden.json."""
    want = golden.load()["lubricated"]

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        return press_dense.rhs(golden.FILM, t, y)[0]

    run = solve_ivp(rate, (0.0, 0.5), press_dense.start(golden.FILM), "Radau", t_eval=want["t"], rtol=1e-9, atol=1e-12)
    for i, (t, y) in enumerate(zip(run.t, run.y.T, strict=True)):
        dy, _, contacts = press_dense.rhs(golden.FILM, t, y)
        forces = [math.hypot(c.fx, c.fy) for c in contacts]
        assert (y[22], y[46], dy[46]) == pytest.approx((want["y9"][i], want["v9"][i], want["a9"][i]), rel=1e-8)
        assert forces == pytest.approx((want["F_A"][i], want["F_B"][i]), rel=1e-7)
    rk4 = press_dense.rk4(golden.FILM, 0.5, 2e-5, every=5000)
    assert rk4.q[1:, 22] == pytest.approx(want["y9"], rel=1e-8)
    assert want["y9"][1] == pytest.approx(-0.466634957, abs=5e-10)  # the figures that were agreed on beforehand
    assert want["y9"][4] == pytest.approx(-0.455865832, abs=5e-10)
    assert (want["v9"][1], want["v9"][4]) == pytest.approx((0.6556442, -0.5646981), abs=5e-8)
    assert (want["F_A"][1], want["F_B"][1]) == pytest.approx((12.2686, 3.4004), abs=5e-5)
    assert (want["F_A"][4], want["F_B"][4]) == pytest.approx((4.4986, 8.3592), abs=5e-5)


@needs_compiler
@pytest.mark.parametrize("common_point", [False, True])
def test_golden_dry_first_contacts(common_point: bool) -> None:
    want = golden.load()["dry"]
    a, b = press_dense.rk4(replace(golden.DRY, common_point=common_point), 8e-3, 1e-6, every=1000).watch
    assert (a.first_contact, b.first_contact) == pytest.approx((6.764e-3, 7.378e-3), abs=5e-7)
    assert (a.first_peak, b.first_peak) == pytest.approx((174.97, 175.94), abs=5e-3)
    assert (want["first_contact"]["A"], want["first_contact"]["B"]) == pytest.approx(
        (a.first_contact, b.first_contact), abs=2e-8
    )
    assert (want["first_peak"]["A"], want["first_peak"]["B"]) == pytest.approx((a.first_peak, b.first_peak), rel=3e-5)

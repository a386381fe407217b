"""One impact on a spring and a dashpot against closed forms, clipped and pulling.

With the mass m, ω = √(K/m), ζ = D/(2 m ω) = sin φ and the speed v of approach the force is, from the onset,
F = m v ω e^(−ζ ω t) sin(ω cos φ t + 2 φ)/cos φ. Clipped it ends at its zero, and the restitution is
e^(−tan φ (π − 2 φ)); pulling it goes on to δ = 0 at ω cos φ t = π, and the restitution is e^(−π tan φ). The largest
force is m v ω e^(−tan φ (π/2 − 3 φ)) while φ < π/6, then D v, at the onset.
T. Schwager, T. Pöschel, Granular Matter 9 (2007) 465-469.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import gudgeon
from gudgeon.results.results import Result, State
from tests.programs import needs_compiler

pytestmark = needs_compiler
TEXT = """\
format: gudgeon/1
name: disc
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies: {disc: {mass: 0.2 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
freedoms: 1
joints: {pin: {revolute: [ground.O, disc.com]}}
bearings: {b: {radius: 15 mm, clearance: 1 mm, length: 40 mm, bearing_material: steel, journal_material: steel}}
contacts:
  clipped: {normal: {law: kelvin_voigt, stiffness: 1e6 N/m, damping: 50 N*s/m}}
  pulling: {normal: {law: kelvin_voigt, stiffness: 1e6 N/m, damping: 50 N*s/m, pulls: true}}
scenes:
  clipped: {play: {pin: {bearing: b, contact: clipped}}}
  pulling: {play: {pin: {bearing: b, contact: pulling}}}
"""
MASS, K, C, SPEED = 0.2, 1e6, 1e-3, 0.8
OMEGA = math.sqrt(K / MASS)
Discs = dict[str, gudgeon.Simulation]


@pytest.fixture(scope="module")
def discs(tmp_path_factory: pytest.TempPathFactory) -> Discs:
    folder = tmp_path_factory.mktemp("discs")
    (folder / "disc.yaml").write_text(TEXT, encoding="utf-8")
    return {scene: gudgeon.load(folder / "disc.yaml", scene) for scene in ("clipped", "pulling")}


def impact(
    disc: gudgeon.Simulation, zeta: float, t_end: float = 4e-3, ahead: float = 1e-4, **how: float | str | None
) -> Result:
    """Straight outwards, first `ahead` (m) of the wall."""
    name, start = disc.source.scene, disc.start()
    q, v = start.q.copy(), np.array([0.6 * SPEED, -0.8 * SPEED, 0.0])
    q[:2] = 0.6 * (C - ahead), -0.8 * (C - ahead)
    state = State("", name, 0.0, q, v, np.zeros(1, np.int8), np.array([np.nan]), {})
    numbers = {f"contacts.{name}.normal.damping": 2.0 * zeta * MASS * OMEGA}
    return disc.simulate(t_end, output=4, start=state, parameters=numbers, **how)  # type: ignore[arg-type]


def restitution(run: Result) -> float:
    return -float(0.6 * run["disc.vx"][-1] - 0.8 * run["disc.vy"][-1]) / SPEED


def peak(zeta: float) -> float:
    phi = math.asin(zeta)
    return MASS * SPEED * OMEGA * (math.exp(-math.tan(phi) * (math.pi / 2 - 3 * phi)) if zeta < 0.5 else 2 * zeta)


@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
@pytest.mark.parametrize("zeta", [0.01, 0.2, 0.45, 0.7, 0.95])
def test_clipped(discs: Discs, method: str, zeta: float) -> None:
    run, phi = impact(discs["clipped"], zeta, method=method, rtol=1e-11), math.asin(zeta)
    expected = math.exp(-math.tan(phi) * (math.pi - 2 * phi))
    assert restitution(run) == pytest.approx(expected, rel=1e-8)
    (contact,) = run.impacts
    assert contact["t_on"] == pytest.approx(1e-4 / SPEED, abs=1e-12)
    ends = (math.pi - 2 * phi) / (OMEGA * math.cos(phi))  # then freely out, from the depth that is left
    left = 2 * zeta * expected * SPEED / OMEGA
    assert contact["t_off"] - contact["t_on"] == pytest.approx(ends + left / (expected * SPEED), rel=1e-7)
    assert contact["F_peak"] == pytest.approx(peak(zeta), rel=1e-6)
    lost = 0.5 * MASS * SPEED**2 * (1 - expected**2)
    assert run.work[-1].sum() == pytest.approx(-lost, rel=1e-7)  # onset's energy: what the force took, no more
    assert run["pin.Fn"].min() >= -1e-9


@pytest.mark.parametrize(("zeta", "tolerance"), [(0.3, 1e-3), (0.6, 1e-9), (5.0, 1e-9)])
def test_the_peak_of_a_contact_that_takes_one_step(discs: Discs, zeta: float, tolerance: float) -> None:
    """From the onset to where it ceases to push; overdamped too."""
    (contact,) = impact(discs["clipped"], zeta, method="dop853", rtol=1e-2).impacts
    expected = peak(zeta) if zeta < 1 else 2 * zeta * MASS * OMEGA * SPEED
    assert contact["F_peak"] == pytest.approx(expected, rel=tolerance)


@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
@pytest.mark.parametrize("zeta", [0.01, 0.3, 0.8])
def test_pulling(discs: Discs, method: str, zeta: float) -> None:
    """δ and δ̇ at will: a law that nothing clips is a linear half period."""
    run, phi = impact(discs["pulling"], zeta, method=method, rtol=1e-11), math.asin(zeta)
    assert restitution(run) == pytest.approx(math.exp(-math.pi * math.tan(phi)), rel=1e-8)
    (contact,) = run.impacts
    assert contact["t_off"] - contact["t_on"] == pytest.approx(math.pi / (OMEGA * math.cos(phi)), rel=1e-7)


@pytest.mark.parametrize("scene", ["clipped", "pulling"])
def test_rk4(discs: Discs, scene: str) -> None:
    """From the onset of order 4; over it, where no step of its ends, still near."""
    exact = impact(discs[scene], 0.3, t_end=8e-4, ahead=-1e-12, method="dop853", rtol=1e-13)
    steps = np.array([40, 80, 160])
    runs = [impact(discs[scene], 0.3, t_end=8e-4, ahead=-1e-12, step=8e-4 / n) for n in steps]
    errors = [np.abs(run.v[-1] - exact.v[-1]).max() for run in runs]
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(-4.0, abs=0.2)
    through, near = impact(discs[scene], 0.3, method="dop853"), impact(discs[scene], 0.3, step=2e-7)
    assert restitution(near) == pytest.approx(restitution(through), rel=1e-3)


def test_the_default_step_of_rk4_resolves_the_contact(discs: Discs) -> None:
    """A fiftieth of its half period, or one over the damper's rate."""
    short = impact(discs["clipped"], 0.3, t_end=1.0, method="rk4").diagnostics
    assert short.step <= 1.0001 * math.pi / OMEGA / 50
    assert impact(discs["clipped"], 20.0, t_end=1.0, method="rk4").diagnostics.step < 1.0001 / (40.0 * OMEGA)


def test_side_by_side(discs: Discs) -> None:
    """Bit for bit what each run is alone."""
    sets = [{"contacts.clipped.normal.damping": x} for x in (20.0, 300.0, 700.0, 900.0)]
    disc, start = discs["clipped"], impact(discs["clipped"], 0.3, t_end=1e-4, step=1e-6).final
    batch = disc.simulate_many(sets, t_end=2e-3, output=5, step=1e-6, start=start)
    for k, numbers in enumerate(sets):
        alone = disc.simulate(2e-3, output=5, step=1e-6, start=start, parameters=numbers)
        np.testing.assert_array_equal(batch[k].q, alone.q)
        np.testing.assert_array_equal(batch[k].v, alone.v)
        assert batch[k].impacts["F_peak"] == pytest.approx(alone.impacts["F_peak"], rel=0, abs=0)


@pytest.mark.parametrize("scene", ["clipped", "pulling"])
def test_the_functions_of_numpy(discs: Discs, scene: str) -> None:
    disc, rng = discs[scene], np.random.default_rng(5)
    model, p = disc.model.numpy(), disc.model.numpy().prepare()
    for _ in range(20):
        turn, deep = rng.uniform(0, 2 * math.pi), rng.uniform(-1e-5, 3e-4)
        q, v = np.array([(C + deep) * math.cos(turn), (C + deep) * math.sin(turn), 0.3]), rng.normal(0, 0.5, 3)
        want = disc.compiled.rhs(0.0, np.concatenate([q, v]), disc.p, discrete_states=[0.4])[3:6]
        np.testing.assert_allclose(model.dynamics(0.0, q, v, p, [0.4]).a, want, atol=1e-12 * (1 + abs(want).max()))

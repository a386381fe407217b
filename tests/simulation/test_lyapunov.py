"""Lyapunov exponents against closed forms, scipy's variational equation, published numbers; one way by the other."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gudgeon
from gudgeon.errors import BadValueError, InputError, UnknownNameError
from gudgeon.simulation.lyapunov import explain_invalid_variational_equation
from gudgeon.simulation.neighbours import DifferenceNorm
from gudgeon.simulation.predictability_horizon import build_start_state
from gudgeon.simulation.simulation import Simulation
from gudgeon.simulation.tangent import Flow, Tangent
from tests.programs import needs_compiler

pytestmark = needs_compiler
RAIL = """
format: gudgeon/1
name: rail
parameters: {{{parameters}}}
bodies: {{m: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{guide: {{translational: [ground.O, m.origin], axis: [1, 0], angle: 0}}}}
forces: {{f: {{force: m.origin, value: [{force}, 0]}}}}
start: {{set: {{m.x: x0}}, rates: {{m.vx: 0}}}}
events: {{up: {{zero: m.x, direction: rising}}}}
"""
DUFFING = (
    "k: 0 N/m, k3: 1 N/m^3, d: 0.05 kg/s, A: 7.5 N, w: 1 rad/s, x0: 1 m",
    ("A*cos(w*t) - d*m.vx - k*m.x - k3*m.x**3"),
)
VAN_DER_POL = "mu: 0.5 kg/s, l: 1 m, x0: 1 m", "mu*(1 - (m.x/l)**2)*m.vx - m.x * 1 N/m"
LINEAR = {"k3": 0.0, "A": 0.0, "d": 0.0}


def on_a_rail(folder: Path, text: tuple[str, str], **options: Any) -> Simulation:
    (folder / "rail.yaml").write_text(RAIL.format(parameters=text[0], force=text[1]), encoding="utf-8")
    return gudgeon.load(folder / "rail.yaml", **options)


@pytest.fixture(scope="module")
def duffing(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    return on_a_rail(tmp_path_factory.mktemp("duffing"), DUFFING)


@pytest.mark.parametrize("by", [pytest.param("tangent", marks=pytest.mark.slow), "two_trajectory"])
def test_linear_oscillators_to_a_percent(duffing: Simulation, by: str) -> None:
    """On a hill of stiffness −k: √(k/m). In a valley, damped: −d/2m, whatever the phase in which it ends."""
    hill = duffing.lyapunov(10.0, by=by, parameters=LINEAR | {"k": -4.0, "x0": 0.0})
    valley = duffing.lyapunov(27.0, by=by, parameters=LINEAR | {"k": 4.0, "d": 1.2})
    assert hill.exponent == pytest.approx(2.0, rel=1e-3) and hill.by == by and hill.sign == 1
    assert valley.exponent == pytest.approx(-0.6, rel=0.01) and valley.sign == -1
    assert valley.mean_horizon() == math.inf
    assert hill.mean_horizon(1e-8) == pytest.approx(math.log(0.25e8) / 2.0, rel=1e-3)


@pytest.mark.slow
def test_constraints_are_kept_in_the_full_formulation(tmp_path: Path) -> None:
    """Neighbours leave neither the rail nor its direction: rows that nothing drives back would show as 0 or more."""
    rail = on_a_rail(tmp_path, DUFFING, formulation="full")
    for by in ("tangent", "two_trajectory"):
        found = rail.lyapunov(10.0, by=by, parameters=LINEAR | {"k": 9.0, "d": 4.0})
        assert found.exponent == pytest.approx(-2.0, rel=0.01)


def test_the_growth_is_that_of_the_variational_equation(duffing: Simulation) -> None:
    """Ueda's oscillator: ln of the growth from the same first difference on, beside scipy's."""
    ends = (10.0, 20.0)
    run = duffing.simulate(ends[1], output=1000, rtol=1e-12)
    measure, y0 = DifferenceNorm.from_run(run, duffing.compiled), np.concatenate([run.q[0], run.v[0]])
    first = measure.draw_neighbour(0.0, y0) - y0
    x, v = (measure.scales[0], measure.scales[3])

    def rates(t: float, y: np.ndarray) -> list[float]:
        pull = 3.0 * y[0] ** 2
        return [y[1], 7.5 * math.cos(t) - 0.05 * y[1] - y[0] ** 3, y[3], -0.05 * y[3] - pull * y[2]]

    known = solve_ivp(rates, (0.0, ends[1]), [1.0, 0.0, *first[[0, 3]]], "DOP853", ends, rtol=1e-12, atol=1e-13)
    expected = np.log(np.hypot(known.y[2] / x, known.y[3] / v) / measure.compute_norm(first))
    for by in ("tangent", "two_trajectory"):
        found = duffing.lyapunov(ends[1], by=by)
        logs = np.interp(ends, found.t, np.concatenate([[0.0], np.cumsum(found.growth)]))
        np.testing.assert_allclose(logs, expected, atol=1e-3)


def test_ueda_s_oscillator_is_chaotic_as_published(duffing: Simulation) -> None:
    """k = .05, B = 7.5 (Y. Ueda, J. Stat. Phys. 20:181, 1979): λ = .1034 1/s (J. C. Sprott, Chaos and Time-Series
    Analysis, 2003, appendix A)."""
    found = duffing.lyapunov(1200.0, by="two_trajectory", section="2*pi/w", rtol=1e-10)
    assert abs(found.exponent - 0.1034) < 3.0 * found.uncertainty < 0.04
    assert found.per_return == pytest.approx(2 * math.pi * found.exponent, rel=0.1)
    motion = found.motion
    assert motion.kind == "chaotic" and motion.confidence > 0.8 and motion.K > 0.8 and motion.period == 0


@pytest.mark.slow
def test_returns_once_a_period(duffing: Simulation) -> None:
    """Linear and driven: damped it repeats the drive, undamped with half its frequency it returns to every second
    point, with √2 of it to none."""
    options: dict[str, Any] = {"section": "2*pi/w", "by": "two_trajectory", "rtol": 1e-10}
    given = {"k3": 0.0, "A": 1.0}
    damped = duffing.lyapunov(500.0, skip=150.0, parameters=given | {"k": 2.0, "d": 0.3}, **options)
    half = duffing.lyapunov(280.0, parameters=given | {"k": 0.25, "d": 0.0}, **options)
    torus = duffing.lyapunov(420.0, parameters=given | {"k": 2.0, "d": 0.0, "x0": 2.0}, **options)
    assert (damped.motion.kind, damped.motion.period) == ("periodic", 1)
    assert damped.per_return == pytest.approx(-0.15 * 2.0 * math.pi, rel=0.02)
    assert (half.motion.kind, half.motion.period) == ("periodic", 2)
    assert torus.motion.kind == "quasi-periodic" and torus.sign == 0 and abs(torus.motion.K) < 0.2


@pytest.mark.parametrize("by", ["two_trajectory", pytest.param("tangent", marks=pytest.mark.slow)])
def test_a_section_without_a_clock_leaves_out_the_motion_itself(by: str, tmp_path: Path) -> None:
    """Van der Pol's cycle: along it differences stay, from return to return they shrink by exp ∮ div f dt."""
    oscillator = on_a_rail(tmp_path, VAN_DER_POL)

    def rates(t: float, y: np.ndarray) -> list[float]:
        return [y[1], 0.5 * (1.0 - y[0] ** 2) * y[1] - y[0], 0.5 * (1.0 - y[0] ** 2)]

    def rising(t: float, y: np.ndarray) -> float:
        return float(y[0])

    rising.direction = 1.0  # type: ignore[attr-defined]
    known = solve_ivp(rates, (0.0, 100.0), [1.0, 0.0, 0.0], "DOP853", events=rising, rtol=1e-11, atol=1e-12)
    multiplier = np.diff(known.y_events[0][-2:, 2])[0]
    along = oscillator.lyapunov(120.0, skip=40.0, by="two_trajectory", rtol=1e-10)
    assert abs(along.exponent) < 0.01 and not along.transverse
    across = oscillator.lyapunov(360.0, skip=40.0, by=by, section="up", rtol=1e-10)
    assert across.transverse
    assert across.per_return == pytest.approx(multiplier, rel=0.01)
    assert (across.motion.kind, across.motion.period) == ("periodic", 1)


def ball(scene: str, folder: Path | None = None) -> Simulation:
    if folder is None:
        return gudgeon.load("bouncing_ball", scene=scene)
    text = (Path(gudgeon.__file__).parent / "mechanisms" / "bouncing_ball.yaml").read_text(encoding="utf-8")
    law = "kelvin_voigt, stiffness: 1e6 N/m, damping: 60 N*s/m}"
    text = text.replace("hertz, stiffness: 1.4e8, restitution: 1, dissipation: none}", law)
    (folder / "ball.yaml").write_text(text, encoding="utf-8")
    return gudgeon.load(folder / "ball.yaml", scene=scene)


def carried(simulation: Simulation, t: float, difference: Any) -> tuple[np.ndarray, np.ndarray]:
    """A difference of y at the start as the tangent has it at t, and ẏ there; `difference` of ẏ at the start."""
    run = simulation.simulate(t, output=4, rtol=1e-12)
    flow, start = Flow(simulation.compiled, run), build_start_state(run)
    pair = Tangent(simulation, DifferenceNorm.from_run(run, simulation.compiled), {"rtol": 1e-12}, start, False, flow)
    y, chain = flow.reduce_state(0.0, np.concatenate([start.q, start.v]))
    pair.z = np.append(difference(flow.compute_rates(0.0, y, chain, start.memory)), [0.0, 0.0])
    pair.distance = scale = pair._compute_tangent_norm(start, pair.z)
    ended = pair.advance_to(t, True)
    assert ended is not None
    run, grown = ended
    y, chain = flow.reduce_state(t, np.concatenate([run.q[-1], run.v[-1]]))
    return pair.z[:-2] * math.exp(grown) * scale, flow.compute_rates(t, y, chain, run.memory[-1])


@pytest.mark.parametrize("scene", ["elastic", "damped", "kelvin_voigt"])
def test_the_tangent_carries_the_motion_s_own_direction_through_contacts(scene: str, tmp_path: Path) -> None:
    """(v, a) at one time becomes (v, a) at a later one, also where the force jumps at the onset (Kelvin and Voigt)."""
    simulation = ball("elastic", tmp_path) if scene == "kelvin_voigt" else ball(scene)
    for t in (0.4517, 0.6):  # in the first contact, and behind it
        found, rates = carried(simulation, t, lambda rates: rates)
        within = 1e-2 if scene == "kelvin_voigt" else 2e-5  # what the corner at F_n = 0 leaves
        np.testing.assert_allclose(found, rates, rtol=within, atol=1e-6 * np.abs(rates).max())


def test_the_tangent_knows_that_a_contact_remembers_its_onset() -> None:
    """δ̇⁻ of a neighbour is another one: a ball thrown down faster, beside scipy's with Hunt and Crossley's law."""
    m, K, a, g = 0.092, 1.4e8, 1.5 * (1.0 - 0.8), 9.81

    def height(v0: float) -> np.ndarray:
        fall = (v0 + math.sqrt(v0**2 + 2.0 * g)) / g
        speed = g * fall - v0  # downwards, where it touches

        def rates(t: float, y: np.ndarray) -> list[float]:
            return [y[1], g - K * max(y[0], 0.0) ** 1.5 * (1.0 + a * y[1] / speed) / m]

        def leaves(t: float, y: np.ndarray) -> float:
            return float(y[0])

        leaves.terminal, leaves.direction = True, -1.0  # type: ignore[attr-defined]
        hit = solve_ivp(rates, (0.0, 1e-2), [0.0, speed], "DOP853", events=leaves, rtol=1e-12, atol=1e-16)
        left = 0.7 - fall - hit.t_events[0][0]
        up = -hit.y_events[0][0][1]
        return np.array([-1.0 + up * left - 0.5 * g * left**2, up - g * left])

    simulation, h = ball("damped"), 1e-4
    expected = (height(h) - height(-h)) / (2.0 * h)
    found, _ = carried(simulation, 0.7, lambda rates: np.eye(6)[4])
    np.testing.assert_allclose(found[[1, 4]], expected, rtol=1e-4)


@pytest.mark.parametrize("scene", [pytest.param("elastic", marks=pytest.mark.slow), "damped"])
def test_twin_and_tangent_agree_over_impacts(scene: str) -> None:
    twin, tangent = (ball(scene).lyapunov(2.0, by=by) for by in ("two_trajectory", "tangent"))
    assert tangent.exponent == pytest.approx(twin.exponent, rel=0.01)
    assert tangent.unresolved < 1e-5 * abs(tangent.exponent)


def test_the_tangent_goes_through_joints_with_play_and_friction() -> None:
    """The dry press over its first contact, in which differences of speed grow a thousandfold."""
    press = gudgeon.load("nine_bar_press", scene="dry")
    tangent, twin = (press.lyapunov(0.0073, skip=0.0066, by=by) for by in ("tangent", "two_trajectory"))
    assert tangent.growth.sum() == pytest.approx(twin.growth.sum(), rel=0.02) and twin.growth.sum() > 3.0


def test_films_are_followed_by_a_twin_and_spans_without_motion_are_refused() -> None:
    """The tangent's mesh is as fine as a film is stiff: a tenth of a second of it takes minutes."""
    press = gudgeon.load("nine_bar_press", scene="lubricated")
    found = press.lyapunov(0.25)
    assert found.by == "two_trajectory" and "the film of A is stiff" in found.why and found.exponent < 5.0
    with pytest.raises(BadValueError, match=r"a span of 0\.01 s is too short"):
        press.lyapunov(0.11, skip=0.1)
    with pytest.raises(BadValueError, match="too short"):
        gudgeon.load("pendulum").lyapunov(1e-3)


def test_what_cannot_be_given_is_refused(duffing: Simulation) -> None:
    with pytest.raises(BadValueError, match="no difference can grow"):
        gudgeon.load("nine_bar_press").lyapunov(1.0)
    with pytest.raises(BadValueError, match="sticks and slips"):
        gudgeon.load("belt_block").lyapunov(1.0, by="tangent")
    with pytest.raises(BadValueError, match=r"rtol is 1e-8: errors of steps[^$]*expected 1e-10 or less"):
        duffing.lyapunov(1.0, by="two_trajectory", rtol="1e-8")
    with pytest.warns(DeprecationWarning, match="use by="), pytest.raises(BadValueError, match="rtol is"):
        duffing.lyapunov(1.0, by="twin", rtol="1e-8")
    with pytest.raises(BadValueError, match="by is"):
        duffing.lyapunov(1.0, by="guess")
    with pytest.raises(UnknownNameError, match="no event named"):
        duffing.lyapunov(1.0, section="down")
    with pytest.raises(BadValueError, match="a period within the run"):
        duffing.lyapunov(1.0, section=2.0)
    for name in ("skip", "section", "method"):
        odd: dict[str, Any] = {name: np.zeros(2)}
        with pytest.raises(InputError, match=name):
            duffing.lyapunov(1.0, **odd)
    with pytest.raises(BadValueError, match="no section"):
        _ = duffing.lyapunov(1.0).motion
    assert explain_invalid_variational_equation(duffing.source) == ""


def test_a_scene_that_sticks_is_followed_by_a_twin() -> None:
    """A block on a belt: while it sticks, neighbours become one motion but for their phase."""
    found = gudgeon.load("belt_block").lyapunov(2.0)
    assert found.by == "two_trajectory" and "sticks" in found.why and found.exponent < 1.0

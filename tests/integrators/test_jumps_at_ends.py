"""A jump of a drive's rate at a run's start or end, at a sample, of two drives at once: what follows holds there."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from tests.slow import slow_but, slow_rows_but

CART = """format: gudgeon/1
name: j
gravity: [0, -9.81 m/s^2]
bodies:
  cart: {{mass: 1 kg, inertia: 1e-3 kg*m^2}}
  bob: {{length: 0.4 m, mass: 0.5 kg, inertia: 7e-3 kg*m^2}}
ground: {{O: [0, 0]}}
joints:
  rail: {{translational: [ground.O, cart.origin], axis: [1, 0]}}
  pin: {{revolute: [cart.origin, bob.tail]}}
start: {{set: {{bob.theta: -60 deg}}}}
drives: {{push: {{coordinate: cart.x, value: "{}"}}}}
"""
TWO = """format: gudgeon/1
name: j
gravity: [0, -9.81 m/s^2]
bodies:
  low: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  cart: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  bob: {length: 0.4 m, mass: 0.5 kg, inertia: 7e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  base: {translational: [ground.O, low.origin], axis: [1, 0]}
  rail: {translational: [low.origin, cart.origin], axis: [0, 1]}
  pin: {revolute: [cart.origin, bob.tail]}
start: {set: {bob.theta: -60 deg}}
parameters: {late: 0.3 s}
drives:
  along: {coordinate: low.x, value: "max(0 s, t - 0.3 s)*1 m/s"}
  up: {coordinate: cart.y, value: "min(late, t)*2 m/s"}
"""
CRANK = """format: gudgeon/1
name: j
bodies: {{crank: {{length: 0.2 m, mass: 1 kg, inertia: 1e-2 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{O: {{revolute: [ground.O, crank.tail]}}}}
drives: {{turn: {{angle: crank, value: "1 rad*({})"}}}}
"""
JUMP = 0.3  # s
VALUES = (
    "max(0 s, t - 0.3 s)*1 m/s",
    "max(0 s, 0.3 s - t)*1 m/s",
    "abs(t - 0.3 s)*1 m/s",
    "max(t, 0.1 s*3)*1 m/s",
)
METHODS = ("dop853", "rodas5p", "rk4")


def scene(text: str, folder: Path, formulation: str = "reduced") -> gudgeon.Simulation:
    file = folder / "jump.yaml"
    file.write_text(text, encoding="utf-8")
    return gudgeon.load(file, formulation=formulation)


def by(method: str, step: float = 2e-3) -> dict[str, Any]:
    return {"method": method} | ({"step": step} if method == "rk4" else {})


@pytest.mark.parametrize(
    ("value", "formulation"),
    slow_rows_but(
        [(VALUES[0], "reduced"), (VALUES[1], "full")],
        [
            (VALUES[0], "reduced"),
            (VALUES[0], "full"),
            (VALUES[1], "full"),
            (VALUES[2], "reduced"),
            (VALUES[3], "reduced"),
        ],
    ),
)
def test_two_runs_with_the_jump_on_their_seam_are_one(value: str, formulation: str, tmp_path: Path) -> None:
    """The adaptive methods ended with the state before it, and 0.57 J were in neither run; rk4 right before it too."""
    simulation = scene(CART.format(value), tmp_path, formulation)
    whole = simulation.simulate(0.6, output=2, rtol=1e-12)
    for seam in (np.nextafter(JUMP, 0.0), JUMP, np.nextafter(JUMP, 1.0), JUMP - 1e-13, JUMP + 1e-13):
        for method in METHODS:
            first = simulation.simulate(seam, output=[0.0, seam], **by(method))
            then = simulation.simulate(0.6, start=first.final, output=[seam, 0.6], **by(method))
            assert first.final.t == seam
            np.testing.assert_allclose(then.v[-1], whole.v[-1], rtol=0, atol=2e-6)
            np.testing.assert_allclose(first.work[-1] + then.work[-1], whole.work[-1], rtol=0, atol=2e-7)
            np.testing.assert_allclose(then["bob.omega"][0], first["bob.omega"][-1], rtol=0, atol=1e-9)
            assert max(first.diagnostics.energy_residual, then.diagnostics.energy_residual) < 2e-7


@pytest.mark.parametrize(
    ("value", "formulation"),
    slow_rows_but(
        [(VALUES[0], "full"), (VALUES[1], "reduced")],
        [
            (VALUES[0], "full"),
            (VALUES[1], "reduced"),
            (VALUES[1], "full"),
            ("abs(t/(1 s) - 0.3)*1 m", "reduced"),
        ],
    ),
)
def test_a_sample_at_a_jump_holds_what_follows(value: str, formulation: str, tmp_path: Path) -> None:
    """rk4 gave the state before and the work after where the branch before it reaches to the jump's own time."""
    simulation = scene(CART.format(value), tmp_path, formulation)
    moving = 0.0 if "0.3 s - t" in value else 1.0  # m/s, behind the jump
    exact = simulation.simulate(0.6, output=[0.0, JUMP, 0.6], rtol=1e-12)
    for kind in (*map(by, METHODS), by("rk4", 1.7e-3)):
        for end in (JUMP, 0.6):
            run = simulation.simulate(end, output=[0.0, JUMP, end][: 2 if end == JUMP else 3], **kind)
            assert run["cart.vx"][1] == pytest.approx(moving, abs=1e-12)
            np.testing.assert_allclose(run.v[1], exact.v[1], rtol=0, atol=1e-7)
            np.testing.assert_allclose(run.work[1], exact.work[1], rtol=0, atol=1e-8)


@pytest.mark.parametrize(
    ("value", "formulation"),
    slow_rows_but(
        [("abs(t)*1 m/s", "full")],
        [
            ("max(t, -t)*1 m/s", "reduced"),
            ("abs(t)*1 m/s", "full"),
            ("t*1 m/s + max(0 s, -t)*1 m/s", "full"),
        ],
    ),
)
def test_a_start_at_a_jump_holds_what_follows(value: str, formulation: str, tmp_path: Path) -> None:
    """From t = 0 on all of these are t. Written one way, the start was an impulse of 0.61 J."""
    plain = scene(CART.format("t*1 m/s"), tmp_path, formulation).simulate(0.4, output=9, rtol=1e-10)
    simulation = scene(CART.format(value), tmp_path, formulation)
    for method in METHODS:
        run = simulation.simulate(0.4, output=9, **by(method))
        np.testing.assert_allclose(run.v, plain.v, rtol=0, atol=2e-6)
        np.testing.assert_allclose(run.work, plain.work, rtol=0, atol=2e-7)
        assert run.diagnostics.energy_residual < 1e-6


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_two_drives_may_jump_at_once(formulation: str, tmp_path: Path) -> None:
    """By corners that are written otherwise: the impulse of the second one was none, and its work was missing."""
    simulation = scene(TWO, tmp_path, formulation)
    runs = [simulation.simulate(0.6, output=[0.0, JUMP, 0.6], **by(method)) for method in METHODS]
    for run in runs:
        np.testing.assert_allclose([run["low.vx"][1], run["cart.vy"][1]], [1.0, 0.0], rtol=0, atol=1e-9)
        np.testing.assert_allclose(run.v[-1], runs[0].v[-1], rtol=0, atol=5e-6)
        np.testing.assert_allclose(run.work[-1], runs[0].work[-1], rtol=0, atol=1e-6)
        assert run.diagnostics.energy_residual < 1e-6


@pytest.mark.parametrize("method", METHODS)
def test_an_event_of_the_impulse_at_the_end_counts(method: str, tmp_path: Path) -> None:
    text = CART.format(VALUES[0]) + "events: {fast: {zero: cart.vx - 0.5 m/s}}\n"
    simulation = scene(text, tmp_path)
    first = simulation.simulate(JUMP, output=2, **by(method))
    then = simulation.simulate(0.6, start=first.final, output=2, **by(method))
    np.testing.assert_allclose(first.events_of("fast"), [JUMP], rtol=0, atol=1e-12)
    assert not len(then.events_of("fast"))


def test_a_batch_whose_runs_end_at_their_jumps_is_that_of_single_runs(tmp_path: Path) -> None:
    text = CART.format("max(0 s, late - t)*1 m/s").replace("ground:", "parameters: {late: 0.3 s}\nground:")
    simulation = scene(text, tmp_path)
    late = np.array([0.3, 0.2, 0.1, np.nextafter(0.3, 0.0), np.nextafter(0.3, 1.0), 0.25, 0.3])
    for method in METHODS:
        batch = simulation.simulate_many({"late": late}, JUMP, output=[0.0, 0.1, 0.2, JUMP], **by(method, 0.021))
        for i, value in enumerate(late.tolist()):
            kind = by(method, 0.021) | {"parameters": {"late": value}}
            run = simulation.simulate(JUMP, output=[0.0, 0.1, 0.2, JUMP], **kind)
            for name in ("q", "v", "work"):
                assert getattr(batch[i], name).tobytes() == getattr(run, name).tobytes()


T, U = "(t/(1 s))", "(t/(1 s) - 0.3)"
# Corners within corners, which lie at the same time: U is 0 at 0.3 s, T at the start; the rate behind it.
NESTED = {
    "max(max(U, 2*U), 3*U)": 3.0,
    "max(0, max(U, 2*U))": 2.0,
    "abs(abs(U) - abs(2*U))": 1.0,
    "max(abs(U), abs(2*U))": 2.0,
    "max(U, 0) + max(max(U, 0), 2*U)": 3.0,
    "max(abs(U), 0.6*U)": 1.0,
    "min(abs(U), 0.6*U)": 0.6,
    "max(abs(U), 0.5*U + abs(0.1*U))": 1.0,
}


@pytest.mark.parametrize("value", slow_but([*NESTED][2::4], NESTED))
def test_corners_within_corners_at_one_time(value: str, tmp_path: Path) -> None:
    """The rate of max was the sum of its arguments' where they meet; a sample held a branch that is neither."""
    formulation = "full" if len(value) % 2 else "reduced"
    simulation = scene(CART.format(f"1 m*({value.replace('U', U)})"), tmp_path, formulation)
    for method in METHODS:
        whole = simulation.simulate(0.6, output=[0.0, JUMP, 0.6], **by(method, 1e-3))
        first = simulation.simulate(JUMP, output=2, **by(method, 1e-3))
        then = simulation.simulate(0.6, start=first.final, output=2, **by(method, 1e-3))
        for found in (whole["cart.vx"][1], first["cart.vx"][-1], then["cart.vx"][0]):
            assert found == pytest.approx(NESTED[value], abs=1e-9)
        np.testing.assert_allclose(first.work[-1] + then.work[-1], whole.work[-1], rtol=0, atol=1e-6)
        assert max(run.diagnostics.phi_dot_max for run in (whole, first, then)) < 1e-4


@pytest.mark.parametrize(
    ("value", "rate"),
    slow_rows_but(
        [("min(ramp(T, 0, 0.5), 2*T)", 2.0), ("abs(T - T*T)", 1.0), ("min(T, 20000*T**2)", 0.0)],
        [
            ("max(T, 0.5*T)", 1.0),
            ("max(ramp(T, 0, 0.5), ramp(T, 0, 0.4))", 2.5),
            ("min(ramp(T, 0, 0.5), 2*T)", 2.0),
            ("max(sin(T), T)", 1.0),
            ("max(sqrt(T**2), 0.6*T)", 1.0),
            ("max(T, -T)", 1.0),
            ("abs(T - T*T)", 1.0),
            ("min(T, 20000*T**2)", 0.0),
            ("0.4 - 2*min(T, 0)", 0.0),
        ],
    ),
)
def test_a_start_at_a_tie_has_the_rates_that_follow(value: str, rate: float, tmp_path: Path) -> None:
    """And the file's own: an impulse out of nothing changed them, and the sum of both branches tore the start."""
    given = ("-60 deg}}", "-60 deg}, rates: {bob.omega: 0.7 rad/s}}")
    text = CART.format(f"1 m*({value.replace('T', T)})").replace(*given)
    assert given[1] in text
    simulation = scene(text, tmp_path, "full" if len(value) % 2 else "reduced")
    for method in METHODS:
        run = simulation.simulate(0.05, output=3, **by(method, 1e-4))
        assert run["cart.vx"][0] == pytest.approx(rate, abs=1e-9)
        assert run["bob.omega"][0] == pytest.approx(0.7, abs=1e-9)
        assert run.diagnostics.energy_residual < 1e-6 and run.diagnostics.phi_dot_max < 1e-4


TIES = [
    ("min(2*T, T + 0.5)", 1.0),
    ("max(2*T, T + 0.5)", 2.0),
    ("max(sin(3*T - 1.5), 2*T - 1)", 3.0),
    ("abs(T - 0.5) + min(T, 1 - T)", 0.0),
    ("min(T, 0.5)", 0.0),
    ("ramp(T, 0.25, 0.25)", 0.0),
    ("abs(T - 0.5)", 1.0),
]


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
@pytest.mark.parametrize(("value", "rate"), slow_rows_but(TIES[1:6:2] + TIES[6:], TIES))
def test_without_freedom_too(value: str, rate: float, formulation: str, tmp_path: Path) -> None:
    text = CRANK.format(value.replace("T", T))
    simulation = scene(text, tmp_path, formulation)
    whole = simulation.simulate(1.0, output=[0.0, 0.5, 1.0])
    first = simulation.simulate(0.5, output=2)
    then = simulation.simulate(1.0, start=first.final, output=2)
    for found in (whole["crank.omega"][1], first["crank.omega"][-1], then["crank.omega"][0]):
        assert found == pytest.approx(rate, abs=1e-9)
    np.testing.assert_allclose(first.work[-1] + then.work[-1], whole.work[-1], rtol=0, atol=1e-9)
    assert whole.diagnostics.energy_residual < 1e-9 and whole.diagnostics.phi_dot_max < 1e-9


@pytest.mark.parametrize("jump", slow_but([0.17], [0.33, 0.17, 0.41]))
def test_an_event_of_the_impulse_and_the_one_after_it_are_found(jump: float, tmp_path: Path) -> None:
    """Between two ends of steps the expression went over its zero by the impulse and back: both were lost."""
    text = CART.format(f"1 m*(0.5*T + 0.5*max(T - {jump}, 0))".replace("T", T))
    simulation = scene(text + "events: {slow: {zero: bob.omega + 3 rad/s}}\n", tmp_path)
    expected = simulation.simulate(0.6, output=2, method="rk4", step=5e-4).events_of("slow")
    for method in ("dop853", "rodas5p"):
        found = simulation.simulate(0.6, output=2, rtol=1e-9, method=method).events_of("slow")
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6)

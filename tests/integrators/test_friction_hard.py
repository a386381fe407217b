"""Frictions that load each other, against event-driven integration by SciPy and against statics."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gudgeon.errors import BadValueError
from tests.scenes import Load, loader
from tests.slow import slow_but


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


STACK = """
bodies:
  low: {{mass: 2 kg, inertia: 1e-3 kg*m^2}}
  top: {{mass: 1 kg, inertia: 1e-3 kg*m^2}}
ground: {{o: [0, 0]}}
joints:
  under: {{translational: [ground.o, low.origin], axis: [1, 0]}}
  table: {{translational: [low.origin, top.origin], axis: [1, 0]}}
forces:
  rub_top: {{dry_friction: [low.origin, top.origin], direction: [1, 0], static: {top[0]} N, kinetic: {top[1]} N}}
  rub_low: {{dry_friction: [ground.o, low.origin], direction: [1, 0], static: {low[0]} N, kinetic: {low[1]} N}}
  push: {{force: top.origin, value: [{force}, 0]}}
"""


def test_stacked_blocks_stick_at_rest(load: Load) -> None:
    """3.5 N are below both limits: neither block moves, both joints pass the whole force on."""
    run = load(STACK.format(top=(4, 3), low=(6, 5), force="3.5 N")).simulate(1.0, step=1e-2, output=10)
    assert np.abs(run.q[:, [0, 3]]).max() < 1e-12
    assert (run["rub_top.mode"] == 0).all()
    assert (run["rub_low.mode"] == 0).all()
    assert run["rub_top.F"] == pytest.approx(-3.5)
    assert run["rub_low.F"] == pytest.approx(-3.5)


def test_stacked_blocks_go_together_where_only_the_lower_one_tears_loose(load: Load) -> None:
    """7 N against 5 N of the floor: both with (7 - 5)/3 m/s²; the table passes 5 + 2 (2/3) N on."""
    run = load(STACK.format(top=(20, 20), low=(6, 5), force="7 N")).simulate(1.0, step=1e-2, output=10)
    assert run["low.x"][-1] == pytest.approx(1 / 3, abs=1e-12)
    assert run["top.x"][-1] == pytest.approx(1 / 3, abs=1e-12)
    assert run["rub_top.F"] == pytest.approx(-(5 + 4 / 3))


def test_a_stick_that_is_overloaded_by_anothers_release_gives_way(load: Load) -> None:
    """8 N/s t tears the lower block loose at 6.4 N; then the ground bears 0.5 N, the table at most 5.5 N of 6.5 N."""
    text = STACK.format(top=(6.5, 1), low=(6.4, 0.5), force="8 N * t / (1 s)")
    run = load(text).simulate(1.0, step=1e-2, output=1000)
    begin = 0.8
    moved = (8 / 6 * (1 - begin**3) - 0.5 * 8 * begin**2 * (1 - begin) - 0.5 * 0.5 * (1 - begin) ** 2) / 3
    velocity = (0.5 * 8 * (1 - begin**2) - 0.5 * (1 - begin)) / 3
    assert run["low.vx"][-1] == pytest.approx(velocity, abs=1e-9)
    assert run["low.x"][-1] == pytest.approx(moved, abs=1e-9)
    assert run["top.x"][-1] == pytest.approx(moved, abs=1e-9)


def test_release_of_the_later_friction_overloads_the_earlier_one(load: Load) -> None:
    """A block between two walls that pull: when the pad behind lets go, the pad in front (listed first) must, too."""
    text = """
    bodies: {a: {mass: 1 kg, inertia: 1 kg*m^2}, b: {mass: 1 kg, inertia: 1 kg*m^2}}
    ground: {o: [0, 0]}
    joints:
      ga: {translational: [ground.o, a.origin], axis: [1, 0]}
      gb: {translational: [ground.o, b.origin], axis: [1, 0]}
      bar: {distance: [a.origin, b.origin], length: 1 m}
    start: {set: {a.x: 0}, guess: {b.x: 1 m}}
    forces:
      rub_a: {dry_friction: [ground.o, a.origin], direction: [1, 0], static: 3 N, kinetic: 2 N}
      rub_b: {dry_friction: [ground.o, b.origin], direction: [1, 0], static: 4 N, kinetic: 1 N}
      push: {force: b.origin, value: [10 N * t / (1 s), 0]}
    """
    run = load(text).simulate(1.0, step=1e-2, output=100)
    forces = np.abs(run["rub_a.F"]), np.abs(run["rub_b.F"])
    assert forces[0].max() <= 3 + 1e-9
    assert forces[1].max() <= 4 + 1e-9
    assert run["rub_a.mode"][-1] == 1
    assert run["rub_b.mode"][-1] == 1
    resting = run["a.vx"] == pytest.approx(0.0, abs=1e-9)
    assert not resting
    begin = run.t[np.flatnonzero(run["a.vx"] < 1e-9)[-1]]
    assert begin == pytest.approx(0.6, abs=0.011)  # one at its limit, the other helping with what it has: 4 + 2 N


DRIVES = ["sin(2*pi*t/(1 s))", "1 - cos(2*pi*t/(1 s))", "smooth_step(t, 0.2 s, 0.5 s)"]


@pytest.mark.parametrize("value", slow_but(DRIVES[:1], DRIVES))
def test_driven_slip_passes_zero(load: Load, value: str) -> None:
    """A drive that turns round: friction follows the sign of its velocity, and where it rests nobody can tell."""
    text = f"""
    bodies: {{b: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints: {{g: {{translational: [ground.o, b.origin], axis: [1, 0]}}}}
    drives: {{d: {{coordinate: b.x, value: 0.1 m * ({value})}}}}
    forces: {{rub: {{dry_friction: [ground.o, b.origin], direction: [1, 0], static: 6 N, kinetic: 5 N}}}}
    """
    run = load(text).simulate(1.0, step=1e-3, output=100)
    moves = np.abs(run["b.vx"]) > 1e-4
    assert run["rub.F"][moves] == pytest.approx(-5.0 * np.sign(run["b.vx"][moves]))
    assert run["d.force"] == pytest.approx(run["b.ax"] - run["rub.F"], abs=1e-9)
    assert run["work.forces"][-1] == pytest.approx(-5.0 * np.abs(np.diff(run["b.x"])).sum(), abs=2e-3)
    assert run.diagnostics.energy_residual < 1e-6


@pytest.mark.parametrize(("force", "moved"), [(1.0, 0.0), (4.0, 0.0), (5.5, 0.75), (7.0, 1.5)])
def test_two_pads_on_one_block(load: Load, force: float, moved: float) -> None:
    """Rigid bodies do not tell which pad bears what, but together they bear the load."""
    text = f"""
    bodies: {{b: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints: {{g: {{translational: [ground.o, b.origin], axis: [1, 0]}}}}
    forces:
      one: {{dry_friction: [ground.o, b.origin], direction: [1, 0], static: 3 N, kinetic: 2 N}}
      two: {{dry_friction: [ground.o, b.origin], direction: [1, 0], static: 3 N, kinetic: 2 N}}
      push: {{force: b.origin, value: [{force} N, 0]}}
    """
    run = load(text).simulate(1.0, step=1e-2, output=10)
    assert run["b.x"][-1] == pytest.approx(moved, abs=1e-12)
    assert run["one.F"] + run["two.F"] == pytest.approx(-min(force, 4.0) if moved else -force)


def test_friction_that_is_less_at_rest_is_refused(load: Load) -> None:
    """Static below kinetic has no solution at the onset of slip."""
    text = """
    bodies: {b: {mass: 1 kg, inertia: 1 kg*m^2}}
    ground: {o: [0, 0]}
    joints: {g: {translational: [ground.o, b.origin], axis: [1, 0]}}
    forces: {rub: {dry_friction: [ground.o, b.origin], direction: [1, 0], static: 1 N, kinetic: 2 N}}
    """
    with pytest.raises(BadValueError, match="static"):
        load(text)
    scene = load(text.replace("kinetic: 2", "kinetic: 0.5"))
    with pytest.raises(BadValueError, match="static"):
        scene.simulate(1.0, parameters={"forces.rub.kinetic": 3.0})


BELT, STATIC, KINETIC, STIFF, COUPLED = 0.1, (6.0, 4.0), (4.0, 3.0), 100.0, 60.0


def two_blocks(t_end: float) -> np.ndarray:
    """x1, x2, v1, v2 at t_end: each block sticks to the belt or slips; modes change at events of SciPy."""

    def spring(y: np.ndarray) -> np.ndarray:
        return np.array([-STIFF * y[0] + COUPLED * (y[1] - y[0]), -COUPLED * (y[1] - y[0])])

    def slide(now: tuple[int, ...]) -> Callable[[float, np.ndarray], np.ndarray]:
        moving = np.array(now) != 0

        def rates(_: float, y: np.ndarray) -> np.ndarray:
            return np.concatenate([y[2:], np.where(moving, spring(y) - np.array(now) * np.array(KINETIC), 0.0)])

        return rates

    def margin(i: int, now: tuple[int, ...]) -> Callable[[float, np.ndarray], float]:
        def event(_: float, y: np.ndarray) -> float:
            return float(now[i] * (y[2 + i] - BELT)) if now[i] else STATIC[i] - abs(float(spring(y)[i]))

        event.terminal, event.direction = True, -1.0  # type: ignore[attr-defined]
        return event

    t, y, modes = 0.0, np.zeros(4), [0, 0]
    y[2:] = BELT
    while t < t_end:
        now = tuple(modes)
        events = [margin(0, now), margin(1, now)]
        found = solve_ivp(slide(now), (t, t_end), y, "DOP853", events=events, rtol=1e-12, atol=1e-14, max_step=0.01)
        t, y = float(found.t[-1]), found.y[:, -1].copy()
        for i in range(2):
            if len(found.t_events[i]):
                if now[i] == 0:
                    modes[i] = int(np.sign(spring(y)[i]))
                else:
                    y[2 + i] = BELT
                    load = float(spring(y)[i])
                    modes[i] = 0 if abs(load) <= STATIC[i] else int(np.sign(load))
    return y


def test_two_blocks_on_a_belt_against_scipy(load: Load) -> None:
    """Coupled by a spring; many changes of both modes on the way."""
    text = f"""
    parameters: {{belt: {BELT} m/s}}
    bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}, b: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0], wall: [-1 m, 0]}}
    joints:
      ga: {{translational: [ground.o, a.origin], axis: [1, 0]}}
      gb: {{translational: [ground.o, b.origin], axis: [1, 0]}}
    forces:
      hold: {{spring_damper: [ground.wall, a.origin], stiffness: {STIFF} N/m, free_length: 1 m}}
      tie: {{spring_damper: [a.origin, b.origin], stiffness: {COUPLED} N/m, free_length: 1 m}}
      rub_a: {{dry_friction: [ground.o, a.origin], direction: [1, 0], speed: belt, static: {STATIC[0]} N,
              kinetic: {KINETIC[0]} N}}
      rub_b: {{dry_friction: [ground.o, b.origin], direction: [1, 0], speed: belt, static: {STATIC[1]} N,
              kinetic: {KINETIC[1]} N}}
    start: {{set: {{a.x: 0, b.x: 1 m}}, rates: {{a.vx: belt, b.vx: belt}}}}
    """
    run = load(text).simulate(4.0, step=1e-3, output=400)
    changes = sum(int(np.count_nonzero(np.diff(run[f"rub_{x}.mode"]))) for x in "ab")
    assert changes > 8
    want = two_blocks(4.0)
    got = [run["a.x"][-1], run["b.x"][-1] - 1.0, run["a.vx"][-1], run["b.vx"][-1]]
    assert got == pytest.approx(want, abs=1e-6)
    assert run.diagnostics.energy_residual < 1e-7


def test_block_on_a_turning_beam_against_scipy(load: Load) -> None:
    """A bead on a beam that turns at ω: r̈ = ω² r − g sin ωt − F sgn ṙ; it sticks, then slips."""
    omega, g, limit, kinetic, r0 = 0.8, 9.81, 6.0, 4.0, 0.4
    text = f"""
    gravity: [0, -{g} m/s^2]
    bodies: {{beam: {{mass: 2 kg, inertia: 0.3 kg*m^2}}, bead: {{mass: 1 kg, inertia: 0.01 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints:
      pivot: {{revolute: [ground.o, beam.origin]}}
      slot: {{translational: [beam.origin, bead.origin], axis: [1, 0]}}
    drives: {{turn: {{angle: beam, value: {omega} rad/s * t}}}}
    forces:
      rub: {{dry_friction: [beam.origin, bead.origin], direction: [1, 0], static: {limit} N, kinetic: {kinetic} N}}
    start: {{set: {{bead.x: {r0} m}}, rates: {{bead.vx: 0}}}}
    """
    run = load(text).simulate(1.2, step=1e-3, output=1200)
    begin = math.asin((limit + omega**2 * r0) / g) / omega
    slides = solve_ivp(
        lambda t, y: [y[1], omega**2 * y[0] - g * math.sin(omega * t) + kinetic],
        (begin, 1.2),
        [r0, 0.0],
        "DOP853",
        rtol=1e-12,
        atol=1e-14,
    )
    r = np.hypot(run["bead.x"], run["bead.y"])
    assert r[-1] == pytest.approx(slides.y[0, -1], abs=1e-8)
    stuck = run["rub.mode"] == 0
    assert run.t[stuck][-1] == pytest.approx(begin, abs=1.1e-3)
    rate = slides.y[1, -1]
    torque = 2 * r[-1] * rate * omega + g * r[-1] * math.cos(omega * 1.2)  # d(r² ω)/dt + weight
    assert run["turn.torque"][-1] == pytest.approx(torque, abs=1e-6)
    assert run.diagnostics.energy_residual < 1e-7


@pytest.mark.parametrize("seed", slow_but([0], range(4)))
def test_network_of_blocks_obeys_coulomb_everywhere(load: Load, seed: int) -> None:
    """Random blocks on each other, springs, pushes, belts: within the limit in stick, against the slip in slip."""
    rng, count = np.random.default_rng(seed), 4
    carriers = ["ground.o", *(f"b{rng.integers(0, i)}.origin" for i in range(1, count))]
    pads = [
        (
            int(i),
            int(rng.integers(-1, i)),
            float(rng.uniform(0.5, 4)),
            float(rng.uniform(0.5, 1)),
            float(rng.choice([0.0, 0.0, 0.1, -0.2])),
        )
        for i in range(count)
    ]
    lines = ["bodies:"]
    lines += [f"  b{i}: {{mass: {rng.uniform(0.3, 2)} kg, inertia: 1 kg*m^2}}" for i in range(count)]
    lines += ["ground: {o: [0, 0]}", "joints:"]
    lines += [f"  g{i}: {{translational: [{carriers[i]}, b{i}.origin], axis: [1, 0]}}" for i in range(count)]
    lines += ["forces:"]
    for k, (i, j, static, share, speed) in enumerate(pads):
        other = "ground.o" if j < 0 else f"b{j}.origin"
        limits = f"static: {static} N, kinetic: {static * share} N, speed: {speed} m/s"
        lines.append(f"  r{k}: {{dry_friction: [{other}, b{i}.origin], direction: [1, 0], {limits}}}")
        lines.append(f"  s{k}: {{spring_damper: [ground.o, b{i}.origin], stiffness: {rng.uniform(5, 80)} N/m}}")
        push = f"{rng.uniform(-4, 4)} N * sin({rng.uniform(0.5, 6)} * t / (1 s))"
        lines.append(f"  p{k}: {{force: b{i}.origin, value: [{push}, 0]}}")
    run = load("\n".join(lines) + "\n").simulate(5.0, step=2e-3, output=1000)
    changes = 0
    for k, (_, _, static, share, _) in enumerate(pads):
        mode, force, slip = (run[f"r{k}.{what}"] for what in ("mode", "F", "v"))
        assert set(np.unique(mode)) <= {-1.0, 0.0, 1.0}
        sticks = mode == 0
        assert (np.abs(force[sticks]) <= static * (1 + 1e-9)).all()
        assert np.abs(slip[sticks]).max(initial=0.0) < 1e-9
        assert force[~sticks] == pytest.approx(-static * share * mode[~sticks])
        assert (mode * slip)[~sticks].min(initial=0.0) > -1e-9
        changes += int(np.count_nonzero(np.diff(mode)))
    assert changes > 5
    assert run.diagnostics.energy_residual < 1e-9

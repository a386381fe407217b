"""Starts from bad guesses, at any size, against the circles' intersections."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.assembly.start import search_start
from gudgeon.errors import AssemblyError
from gudgeon.model.parameters import compute_parameter_values
from tests.scenes import Load, loader
from tests.slow import slow_but, slow_rows_but


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


FOUR_BAR = """
parameters: {{guess_b: 0, guess_c: 0}}
bodies:
  a: {{length: 0.4 {unit}, mass: 1 kg, inertia: 0.01 kg*m^2}}
  b: {{length: 1.2 {unit}, mass: 1 kg, inertia: 0.01 kg*m^2}}
  c: {{length: {rocker} {unit}, mass: 1 kg, inertia: 0.01 kg*m^2}}
ground: {{o: [0, 0], p: [1 {unit}, 0]}}
joints:
  O: {{revolute: [ground.o, a.tail]}}
  A: {{revolute: [a.head, b.tail]}}
  B: {{revolute: [b.head, c.head]}}
  P: {{revolute: [ground.p, c.tail]}}
drives: {{turn: {{angle: a, value: 70 deg + 1 rad/s * t}}}}
start: {{guess: {{b.theta: guess_b, c.theta: guess_c}}}}
"""


def both_branches() -> np.ndarray:
    """(2, 2): angles of coupler and rocker, the coupler's head left and right of the diagonal."""
    tip, pivot = 0.4 * np.array([np.cos(np.radians(70)), np.sin(np.radians(70))]), np.array([1.0, 0.0])
    span = np.hypot(*(pivot - tip))
    along = (pivot - tip) / span
    far = (1.2**2 - 0.8**2 + span**2) / (2 * span)
    across = np.sqrt(1.2**2 - far**2) * np.array([-along[1], along[0]])
    heads = [tip + far * along + sign * across for sign in (1, -1)]
    return np.array([[np.arctan2(*(head - foot)[::-1]) for foot in (tip, pivot)] for head in heads])


def away(angle: np.ndarray) -> np.ndarray:
    """Wrapped into half a turn."""
    return np.abs((angle + np.pi) % (2 * np.pi) - np.pi)


NEAR_A_FOLD = """
parameters: {a: 1 m, b: 1 m, c: 1 m, x: 1 m, y: 0 m, phi: 0 rad, guess_b: 0 rad, guess_c: 0 rad}
bodies:
  a: {length: a, mass: 1 kg, inertia: 0.01 kg*m^2}
  b: {length: b, mass: 1 kg, inertia: 0.01 kg*m^2}
  c: {length: c, mass: 1 kg, inertia: 0.01 kg*m^2}
ground: {o: [0, 0], p: [x, y]}
joints:
  O: {revolute: [ground.o, a.tail]}
  A: {revolute: [a.head, b.tail]}
  B: {revolute: [b.head, c.head]}
  P: {revolute: [ground.p, c.tail]}
drives: {turn: {angle: a, value: phi + 1 rad/s * t}}
start: {guess: {b.theta: guess_b, c.theta: guess_c}}
"""


@pytest.mark.parametrize("starts", [3, pytest.param(300, marks=pytest.mark.slow)])
def test_start_near_a_fold_from_a_guess_anywhere(load: Load, starts: int) -> None:
    """b + D = c but for 10⁻²…10⁻⁹ of it, and guesses all round: closed every time, as the lengths say."""
    scene, rng = load(NEAR_A_FOLD), np.random.default_rng(11)
    for _ in range(starts):
        a, c, phi, x, y = rng.uniform([0.05, 0.2, -np.pi, 0.05, -0.3], [0.5, 1.0, np.pi, 1.0, 0.3])
        tip = a * np.array([np.cos(phi), np.sin(phi)])
        span = np.hypot(*([x, y] - tip))
        if span >= c:
            continue
        b = (c - span) * (1 + 10.0 ** rng.uniform(-9, -2))
        guess = rng.uniform(-3, 3, 2)
        given = {"a": a, "b": b, "c": c, "x": x, "y": y, "phi": phi, "guess_b": guess[0], "guess_c": guess[1]}
        q = scene.start(given).q
        heads = [tip + b * np.array([np.cos(q[5]), np.sin(q[5])]), [x, y] + c * np.array([np.cos(q[8]), np.sin(q[8])])]
        np.testing.assert_allclose(heads[0], heads[1], rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("guesses", [2, pytest.param(200, marks=pytest.mark.slow)])
@pytest.mark.parametrize("unit", slow_but(["um"], ["um", "mm", "m", "km"]))
def test_branch_nearest_the_guess_from_anywhere(load: Load, unit: str, guesses: int) -> None:
    """Guesses all round: assembled every time, on the nearer branch, within half a turn of the guess."""
    scene, rng = load(FOUR_BAR.format(unit=unit, rocker=0.8)), np.random.default_rng(3)
    branches = both_branches()
    for guess in rng.uniform(-np.pi, np.pi, (guesses, 2)):
        q = scene.start({"guess_b": guess[0], "guess_c": guess[1]}).q[[5, 8]]
        distance = [np.linalg.norm(away(branch - guess)) for branch in branches]
        reached = [np.linalg.norm(away(branch - q)) for branch in branches]
        assert min(reached) < 1e-9
        assert abs(distance[0] - distance[1]) < 0.1 or np.argmin(reached) == np.argmin(distance)
        assert np.abs(q - guess).max() < np.pi + 1e-9


def test_turns_of_the_guess_are_kept(load: Load) -> None:
    q = load(FOUR_BAR.format(unit="m", rocker=0.8)).start({"guess_b": 4 * np.pi + 0.3, "guess_c": 2 * np.pi + 1}).q
    assert abs(q[5] - 4 * np.pi - 0.3) < 0.5
    assert abs(q[8] - 2 * np.pi - 1) < 0.5


@pytest.mark.slow
def test_lengths_that_cannot_meet_are_told(load: Load) -> None:
    with pytest.raises(AssemblyError, match="cannot be assembled"):
        load(FOUR_BAR.format(unit="m", rocker=0.1)).start()


@pytest.mark.parametrize("speed", [pytest.param(1.0, marks=pytest.mark.slow), 1e-7])
def test_rates_that_contradict_are_told(load: Load, speed: float) -> None:
    """A rate against a drive, and two rates of one degree of freedom, however slow: both are named."""
    driven = FOUR_BAR.format(unit="m", rocker=0.8).replace("1 rad/s", f"{speed} rad/s")
    guess = "guess: {b.theta: guess_b, c.theta: guess_c}"
    with pytest.raises(AssemblyError, match=r"turn, a\.omega"):
        load(driven.replace(guess, f"{guess}, rates: {{a.omega: {2 * speed} rad/s}}")).start({"guess_c": 1.4})
    free = "\n".join(line for line in driven.splitlines() if not line.startswith("drives"))
    rates = f"set: {{a.theta: 70 deg}}, {guess}, rates: {{a.omega: {speed} rad/s, c.omega: {speed} rad/s}}"
    with pytest.raises(AssemblyError, match=r"a\.omega, c\.omega"):
        load(free.replace(guess, rates)).start({"guess_c": 1.4})


def test_rate_that_agrees_with_a_drive(load: Load) -> None:
    text = FOUR_BAR.format(unit="m", rocker=0.8)
    text = text.replace("c.theta: guess_c}", "c.theta: guess_c}, rates: {a.omega: 1 rad/s}")
    assert load(text).start({"guess_c": 1.4}).v[2] == pytest.approx(1.0)


RODS = [
    (part, ends)
    for ends in ("ground.o, a.origin", "a.origin, ground.o")
    for part in (
        "joints: {rod: {distance: [{ends}], length: 2 mm}}",
        "drives: {rod: {distance: [{ends}], value: 2 mm}}",
    )
]


@pytest.mark.parametrize(("part", "ends"), slow_rows_but([RODS[0], RODS[3]], RODS))
def test_rod_whose_ends_coincide_in_the_guess(load: Load, part: str, ends: str) -> None:
    """No guess puts the two ends of a rod into one point, where its row has no direction."""
    text = "bodies: {a: {mass: 1 kg, inertia: 1 kg*m^2}}\nground: {o: [0, 0]}\n" + part.replace("{ends}", ends) + "\n"
    q = load(text).start().q
    assert np.hypot(q[0], q[1]) == pytest.approx(2e-3, rel=1e-12)


STRETCHED = """
format: gudgeon/1
name: stretched
bodies:
  crank: {length: 50 mm, mass: 0.3 kg, inertia: 1e-4 kg*m^2}
  rod: {length: 120 mm, mass: 0.21 kg, inertia: 2.5e-4 kg*m^2}
  piston: {mass: 0.14 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, piston.origin]}
  cylinder: {translational: [ground.O, piston.origin], axis: [1, 0]}
start: {set: {piston.x: X mm}, guess: {crank.theta: 40 deg, rod.theta: -10 deg}, rates: {piston.vx: 0 m/s}}
"""


@pytest.mark.parametrize(("x", "dead"), [("170", True), ("160", False)])
def test_a_dead_centre_is_told_even_where_the_rate_fits(x: str, dead: bool, tmp_path: Path) -> None:
    """Stretched, the piston's rate is zero whatever the crank does: it determines nothing."""
    file = tmp_path / "stretched.yaml"
    file.write_text(STRETCHED.replace("X", x))
    notes = gudgeon.load(file).simulate(1e-3, output=2).diagnostics.notes
    assert any("dead centre" in note and "piston.vx" in note for note in notes) == dead


def test_a_start_is_not_sought_where_parallels_meet(tmp_path: Path) -> None:
    """The pin's line is level and the crank is set at 40°: nothing closes, and the joints at fault are named."""
    file = tmp_path / "yoke.yaml"
    file.write_text("""
format: gudgeon/1
name: yoke
bodies:
  crank: {length: 100 mm, mass: 1 kg, inertia: 1e-3}
  yoke: {mass: 1 kg, inertia: 1e-3}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  pin: {point_on_line: [crank.head, yoke.origin], direction: [1, 0]}
  slide: {translational: [ground.O, yoke.origin], axis: [1, 0]}
start: {set: {crank.theta: 40 deg}}
""")
    with pytest.raises(AssemblyError, match="contradict each other") as caught:
        gudgeon.load(file).start()
    assert "pin" in str(caught.value) and "start.set" in str(caught.value)


@pytest.mark.parametrize("length", [0.3, 1.0, 7.0])
def test_a_double_root_at_the_guess_is_closed_in_c(length: float) -> None:
    """bob.x = length and |bob| = length have the double root bob.y = 0, where both equations depend on each other."""
    simulation = gudgeon.load("pendulum")
    compiled, p = simulation.compiled, compute_parameter_values(simulation.compiled, {"length": length})[0]
    closed = compiled.close_linkage(0.0, p, compute_mechanism_size(compiled, p))
    assert closed is not None
    sought = search_start(compiled, p)
    assert closed[0].tolist() == sought.q.tolist() == [length, 0.0, 0.0]
    assert closed[1].tolist() == sought.v.tolist() == [0.0, 0.0, 0.0]

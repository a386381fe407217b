"""Linkages without a degree of freedom: they keep their branch, and say where they cannot go on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import SolverError
from gudgeon.integrators import kinematic_ensemble
from tests.scenes import Load, loader


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


FOUR_BAR = """
bodies:
  a: {{length: {a}, mass: 1 kg, inertia: 0.01 kg*m^2}}
  b: {{length: {b}, mass: 1 kg, inertia: 0.01 kg*m^2}}
  c: {{length: {c}, mass: 1 kg, inertia: 0.01 kg*m^2}}
ground: {{o: [0, 0], p: [{d}, 0]}}
joints:
  O: {{revolute: [ground.o, a.tail]}}
  A: {{revolute: [a.head, b.tail]}}
  B: {{revolute: [b.head, c.head]}}
  P: {{revolute: [ground.p, c.tail]}}
drives: {{turn: {{angle: a, value: {value}}}}}
start: {{guess: {{b.theta: {guess_b}, c.theta: {guess_c}}}}}
"""


@pytest.mark.parametrize(
    "excess", [1e-2, pytest.param(1e-3, marks=pytest.mark.slow), pytest.param(1e-4, marks=pytest.mark.slow), 1e-5]
)
def test_branch_is_kept_near_a_change_point(load: Load, excess: float) -> None:
    """A parallelogram whose rocker is a little too long folds nearly flat: the coupler keeps its side."""
    text = FOUR_BAR.format(
        a="1 m", b="2 m", c=f"{1 + excess} m", d="2 m", value="20 deg + 6*pi rad/s * t", guess_b="0", guess_c="20 deg"
    )
    scene = load(text)
    for samples in (1, 3, 7, 20, 37, 100):
        run = scene.simulate(1.0, output=samples)
        b = np.array([run["b.head.x"] - run["a.head.x"], run["b.head.y"] - run["a.head.y"]])
        c = np.array([run["c.head.x"] - run["c.tail.x"], run["c.head.y"] - run["c.tail.y"]])
        side = b[0] * c[1] - b[1] * c[0]
        assert (np.sign(side) == np.sign(side[0])).all()
        assert np.abs(run["c.theta"]).max() < np.pi  # it swings: a crank-rocker


def test_hundred_revolutions_in_two_samples(load: Load) -> None:
    """A drag link: the follower has turned as often as the crank, and is where the fine run has it."""
    text = FOUR_BAR.format(
        a="0.9 m", b="0.8 m", c="1 m", d="0.3 m", value="90 deg + 200*pi rad/s * t", guess_b="10 deg", guess_c="80 deg"
    )
    scene = load(text)
    start, end = scene.simulate(1.0, output=2).q[[0, -1]]
    assert end[[2, 5, 8]] - start[[2, 5, 8]] == pytest.approx(200 * np.pi, abs=1e-9)


@pytest.mark.parametrize("unit", [pytest.param("mm", marks=pytest.mark.slow), "m", "km"])
def test_any_size_keeps_its_branch(load: Load, unit: str) -> None:
    """A pin on two rods whose far end is drawn out until the rods lie nearly flat: it stays above the line."""
    text = f"""
    bodies:
      pin: {{mass: 1 kg, inertia: 1 kg*m^2}}
      foot: {{mass: 1 kg, inertia: 1 kg*m^2}}
    ground: {{o: [0, 0]}}
    joints:
      slide: {{translational: [ground.o, foot.origin], axis: [1, 0]}}
      left: {{distance: [ground.o, pin.origin], length: 1 {unit}}}
      right: {{distance: [foot.origin, pin.origin], length: 1 {unit}}}
    drives:
      draw: {{coordinate: foot.x, value: 1 {unit} + 0.9995 {unit} * sin(2*pi*t/(1 s))}}
      hold: {{angle: pin, value: 0}}
    start: {{guess: {{pin.y: 1 {unit}, pin.x: 0.5 {unit}}}}}
    """
    scene = load(text)
    scale = {"mm": 1e-3, "m": 1.0, "km": 1e3}[unit]
    for samples in (1, 5, 16):
        run = scene.simulate(0.7, output=samples)
        half = run["foot.x"] / 2 / scale
        assert run["pin.y"] / scale == pytest.approx(np.sqrt(1 - half**2), abs=1e-9)


@pytest.mark.parametrize("samples", [13, 1300, 20_000])
def test_drive_beyond_the_reach_ends_with_an_error(load: Load, samples: int) -> None:
    """At t = 110 s the slider is 3 m away, as far as crank and rod reach: no endless halving at a large t."""
    text = """
    bodies:
      crank: {length: 1 m, mass: 1 kg, inertia: 0.01 kg*m^2}
      rod: {length: 2 m, mass: 1 kg, inertia: 0.01 kg*m^2}
      slider: {mass: 1 kg, inertia: 0.01 kg*m^2}
    ground: {o: [0, 0]}
    joints:
      O: {revolute: [ground.o, crank.tail]}
      A: {revolute: [crank.head, rod.tail]}
      B: {revolute: [rod.head, slider.origin]}
      G: {translational: [ground.o, slider.origin], axis: [1, 0]}
    drives: {push: {coordinate: slider.x, value: 1.9 m + 0.01 m/s * t}}
    start: {guess: {crank.theta: 80 deg, rod.theta: -20 deg}}
    """
    with pytest.raises(SolverError, match="dead centre") as caught:
        load(text).simulate(130.0, output=samples)
    partial = caught.value.partial
    assert 100.0 <= partial.t[-1] <= 110.0
    assert np.isfinite(partial.q).all()


@pytest.mark.parametrize(
    ("mechanism", "excess"), [("four_bar", None), ("parallelogram", 1e-3), ("parallelogram", 1e-5)]
)
def test_runs_at_once_and_in_chunks_are_equal_to_the_bit(
    load: Load, monkeypatch: pytest.MonkeyPatch, mechanism: str, excess: float | None
) -> None:
    """A short run is computed by one call of C, a longer one in chunks with polls: by the same steps."""
    text = FOUR_BAR.format(
        a="1 m", b="2 m", c=f"{1.0 + (excess or 0.0)} m", d="2 m", value="1.3 * t", guess_b="0 deg", guess_c="10 deg"
    )
    simulation = gudgeon.load(mechanism) if excess is None else load(text)
    at_once = simulation.simulate(2.0, output=257)
    monkeypatch.setattr(kinematic_ensemble, "MAX_SHORT_RUN_SAMPLES", 0)
    in_chunks = simulation.simulate(2.0, output=257)
    for name in ("t", "q", "v", "accelerations", "work"):
        np.testing.assert_array_equal(getattr(at_once, name), getattr(in_chunks, name))
    assert at_once.diagnostics.steps == in_chunks.diagnostics.steps
    assert at_once.diagnostics.notes == in_chunks.diagnostics.notes

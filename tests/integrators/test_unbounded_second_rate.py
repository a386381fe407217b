"""Drives whose second rate is unbounded at an instant: the linkage is followed through it, and no dead centre is told.

The linkage is a crank-rocker (0.15, 0.5, 0.4, ground 0.45 m) without singular positions.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import SingularError, SolverError
from tests.programs import needs_compiler

pytestmark = needs_compiler
FOUR_BAR = """format: gudgeon/1
name: four_bar
parameters: {a: 0.15 m, d: 0.45 m, b: 0.4 m, l: 0.5 m}
gravity: [0, -9.81 m/s^2]
bodies:
  crank: {length: a, mass: 1 kg, inertia: 0.01 kg*m^2}
  rod: {length: l, mass: 1 kg, inertia: 0.02 kg*m^2}
  rocker: {length: b, mass: 1 kg, inertia: 0.01 kg*m^2}
ground: {O: [0, 0], P: [d, 0]}
joints:
  j1: {revolute: [ground.O, crank.tail]}
  j2: {revolute: [crank.head, rod.tail]}
  j3: {revolute: [rod.head, rocker.head]}
  j4: {revolute: [ground.P, rocker.tail]}
drives: {m: {angle: crank, value: '%s'}}
start: {guess: {rod.theta: 0.5, rocker.theta: 1.3}}
"""
HANGS = (
    ("ground:", "  arm: {length: 0.2 m, mass: 0.5 kg, inertia: 0.002 kg*m^2}\nground:"),
    ("  j4:", "  j5: {revolute: [rod.com, arm.tail]}\n  j4:"),
)
Function = Callable[[np.ndarray], np.ndarray]
DRIVES: tuple[tuple[str, Function], ...] = (
    ("abs(t/(1 s) - 0.5)**1.5", lambda t: abs(t - 0.5) ** 1.5),
    ("abs(t/(1 s) - 0.5)**1.2", lambda t: abs(t - 0.5) ** 1.2),
    ("sqrt(abs(t/(1 s) - 0.5)**3)", lambda t: abs(t - 0.5) ** 1.5),
    ("((t/(1 s) - 0.5)**2)**0.8", lambda t: abs(t - 0.5) ** 1.6),
    ("0.3 + 2*abs(t/(1 s) - 0.37)**1.6", lambda t: 0.3 + 2.0 * abs(t - 0.37) ** 1.6),
    ("abs(t/(1 s))**1.5", lambda t: t**1.5),
    ("abs(sin(7*t/(1 s)))**1.5", lambda t: abs(np.sin(7.0 * t)) ** 1.5),
)


def rocker(theta: np.ndarray) -> np.ndarray:
    """Its angle: the upper point in which two circles meet."""
    x, y = 0.45 - 0.15 * np.cos(theta), -0.15 * np.sin(theta)
    distance = np.hypot(x, y)
    inner = np.arccos((distance**2 + 0.4**2 - 0.5**2) / (2.0 * 0.4 * distance))
    return np.asarray(np.arctan2(-y, -x) - inner, dtype=float)


def written(tmp_path: Path, value: str, *changes: tuple[str, str]) -> Path:
    text = FOUR_BAR % value
    for old, new in changes:
        text = text.replace(old, new, 1)
    file = tmp_path / "four_bar.yaml"
    file.write_text(text, encoding="utf-8")
    return file


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
@pytest.mark.parametrize(("value", "of"), DRIVES)
def test_a_linkage_follows(value: str, of: Function, formulation: str, tmp_path: Path) -> None:
    """On grids with a sample at the instant and without; works balance the energy, of an unbounded power roughly."""
    scene = gudgeon.load(written(tmp_path, value), formulation=formulation)
    for n in (10, 37, 100, 500):
        run = scene.simulate(1.0, output=n)
        assert np.abs(run["crank.theta"] - of(run.t)).max() < 1e-13
        turned = (run["rocker.theta"] - rocker(of(run.t))) / (2.0 * math.pi)
        assert np.abs(turned - np.rint(turned)).max() < 1e-13
        assert run.diagnostics.energy_residual < 5e-3


def test_the_sample_at_the_instant_is_noted(tmp_path: Path) -> None:
    scene = gudgeon.load(written(tmp_path, DRIVES[0][0]))
    specified = [
        [note for note in scene.simulate(1.0, output=n).diagnostics.notes if "unbounded" in note] for n in (10, 11)
    ]
    assert "drive m" in specified[0][0] and "t = 0.5 s" in specified[0][0]
    assert not specified[1]
    smooth = gudgeon.load(written(tmp_path, "abs(t/(1 s) - 0.5)**2.5"))
    assert not any("unbounded" in note for note in smooth.simulate(1.0, output=10).diagnostics.notes)


def test_no_dead_centre_where_something_hangs_on_it(tmp_path: Path) -> None:
    """A driven chain with a free arm: it is passed, or the drive is named."""
    for (value, of), method in itertools.product(DRIVES[:4], ("dop853", "rodas5p")):
        scene = gudgeon.load(written(tmp_path, value, *HANGS))
        try:
            run = scene.simulate(1.0, output=20, method=method)
            assert np.abs(run["crank.theta"] - of(run.t)).max() < 1e-13
        except SolverError as error:
            assert not isinstance(error, SingularError)
            assert "second rate of drive m" in str(error)

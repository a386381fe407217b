"""Switches of the drives of driven chains: the chain follows its drive through them, in every process alike.

Cams by a coordinate drive along a curve, and cylinders whose motion begins and ends, before something with play.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
PLAY = """materials: {steel: {E: 207 GPa, nu: 0.3}}
bearings: {pin: {radius: 35 mm, clearance: 0.3 mm, length: 80 mm, bearing_material: steel, journal_material: steel}}
contacts: {dry: {normal: {law: lankarani_nikravesh, restitution: 0.8}}}
"""
CYLINDER = (
    """format: gudgeon/1
name: cylinder
gravity: [0, -9.81]
bodies:
  boom: {length: 4 m, mass: 200 kg, inertia: auto, points: {lug: [1.2 m, -0.2 m]}}
  hook: {mass: 100 kg, inertia: 10 kg*m^2, com: [0, -0.5 m]}
ground: {O: [0, 1.5 m], foot: [0.8 m, 0.2 m]}
joints:
  O: {revolute: [ground.O, boom.tail]}
  wrist: {revolute: [boom.head, hook.origin]}
drives: {c1: {distance: [ground.foot, boom.lug], value: '1.35 m + 0.2 m*%s'}}
forces: {pull: {force: hook.com, value: [1 kN*ramp(t, 0.3 s, 0.1 s), 0 N]}}
start: {guess: {boom.theta: 20 deg}}
scenes: {worn: {play: {wrist: {bearing: pin, contact: dry}}}}
"""
    + PLAY
)
CAM = (
    """format: gudgeon/1
name: cam
gravity: [0, -9.81]
parameters: {w: 15 1/s, r: 0.02 m, L: 0.14 m}
bodies:
  follower: {mass: 0.04 kg, inertia: 3e-5 kg*m^2}
  rod: {length: L, mass: 0.6 kg, inertia: 1.3e-3 kg*m^2}
  slider: {mass: 0.4 kg, inertia: 8e-5 kg*m^2}
ground: {O: [0, 0], W: [0, 0.6*L]}
joints:
  stem: {translational: [ground.W, follower.origin], axis: [0, 1]}
  crankpin: {revolute: [follower.origin, rod.tail]}
  wristpin: {revolute: [rod.head, slider.origin]}
  cylinder: {translational: [ground.O, slider.origin], axis: [1, 0]}
curves: {prof: {points: [[0, 0], [1, 0], [2, 0.6], [3, 1], [4, 0.8], [5, 0.2], [6.283185307179586, 0]], ends: periodic}}
drives: {cam: {coordinate: follower.y, value: 0.5*L + r*prof(w*t)}}
start: {guess: {rod.theta: -30 deg, slider.x: 0.86*L}}
events: {e1: {zero: slider.vx}, e2: {zero: rod.omega}}
scenes: {worn: {play: {crankpin: {bearing: pin, contact: dry}}}}
"""
    + PLAY
)
MOTIONS = ("smooth_step(t, 0.1 s, 0.4 s)", "ramp(t, 0.1 s, 0.4 s)", "max(0, t - 0.15 s)/(1 s)", "abs(sin(4/(1 s)*t))")
METHODS = ("auto", "dop853", "rodas5p", "radau5")
SHOW = """
import sys, warnings, gudgeon
warnings.simplefilter("ignore")
run = gudgeon.load(sys.argv[1], "worn").simulate(0.6, output=50)
print(run.q.tobytes().hex(), run.v.tobytes().hex(), len(run.impacts))
"""


def written(tmp_path: Path, text: str) -> Path:
    file = tmp_path / "chain.yaml"
    file.write_text(text, encoding="utf-8")
    return file


def value(motion: str, t: np.ndarray) -> np.ndarray:
    s = np.clip((t - 0.1) / 0.4, 0.0, 1.0)
    of = {
        MOTIONS[0]: s**3 * (10.0 - 15.0 * s + 6.0 * s**2),
        MOTIONS[1]: s,
        MOTIONS[2]: np.maximum(0.0, t - 0.15),
        MOTIONS[3]: np.abs(np.sin(4.0 * t)),
    }
    return 1.35 + 0.2 * np.asarray(of[motion])


@pytest.mark.parametrize("method", slow_but(("auto",), METHODS))
@pytest.mark.parametrize("motion", slow_but(MOTIONS[:2], MOTIONS))
def test_a_cylinder_moves_when_its_drive_says(tmp_path: Path, motion: str, method: str) -> None:
    run = gudgeon.load(written(tmp_path, CYLINDER % motion), "worn").simulate(0.6, output=111, method=method)
    theta = run["boom.theta"]
    x, y = 1.2 * np.cos(theta) + 0.2 * np.sin(theta) - 0.8, 1.3 + 1.2 * np.sin(theta) - 0.2 * np.cos(theta)
    assert np.abs(np.hypot(x, y) - value(motion, run.t)).max() < 2e-11  # switches are located to 1e-12 s
    assert run["Phi.max"].max() < 2e-11


@pytest.mark.parametrize("method", slow_but(("auto", "rodas5p"), METHODS))
def test_a_cam_is_its_curve(tmp_path: Path, method: str) -> None:
    """Against SciPy's periodic spline; an event on a free coordinate is watched along with the curve's knots."""
    from scipy.interpolate import CubicSpline

    run = gudgeon.load(written(tmp_path, CAM), "worn").simulate(0.5, output=300, method=method)
    spline = CubicSpline([0, 1, 2, 3, 4, 5, 2.0 * np.pi], [0, 0, 0.6, 1, 0.8, 0.2, 0], bc_type="periodic")
    assert np.abs(run["follower.y"] - (0.07 + 0.02 * spline(15.0 * run.t % (2.0 * np.pi)))).max() < 1e-11
    assert run["Phi.max"].max() < 1e-11


@pytest.mark.parametrize("processes", slow_but([5], [5, 20]))
def test_equal_runs_in_fresh_processes(tmp_path: Path, processes: int) -> None:
    """Bit for bit: memory that nobody wrote differs from process to process."""
    file = written(tmp_path, CYLINDER % MOTIONS[0])
    gudgeon.load(file, "worn")
    specified = set()
    for k in range(processes):
        environment = os.environ | {"PYTHONHASHSEED": str(k), "MALLOC_PERTURB_": str(17 * k)}
        command = [sys.executable, "-c", SHOW, str(file)]
        specified.add(subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout)
    assert len(specified) == 1 and "" not in specified

"""Events that jump where a mod, a sign or the cut of atan2 inside them does, and poles, in scenes without bounds."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.simulation.simulation import Simulation
from tests.integrators.test_side_by_side import without_chain
from tests.scenes import Load, loader

METHODS = ["dop853", "rodas5p", "radau5", "radau9"]
# a driven four-bar with a pendulum: angles of a driven chain, of which no bounds over a step are known
LINKAGE = """
parameters: {om: 13 1/s}
gravity: [0, -9.81]
bodies:
  crank: {length: 0.1 m, mass: 1 kg, inertia: 0.01 kg*m^2}
  rod: {length: 0.35 m, mass: 0.5 kg, inertia: 0.008 kg*m^2}
  rocker: {length: 0.3 m, mass: 1 kg, inertia: 0.01 kg*m^2}
  bob: {length: 0.2 m, mass: 0.2 kg, inertia: 0.001 kg*m^2}
ground: {O: [0, 0], W: [0.38 m, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  A: {revolute: [crank.head, rod.tail]}
  B: {revolute: [rod.head, rocker.head]}
  C: {revolute: [ground.W, rocker.tail]}
  D: {revolute: [rod.head, bob.tail]}
freedoms: 1
drives: {mot: {angle: crank, value: om*t}}
start: {guess: {rod.theta: 40 deg, rocker.theta: 80 deg, bob.theta: -90 deg}}
events:
  cut: {zero: "atan2(mod(rod.theta, 1 rad)/(1 rad), sin(om*t*1.19299))", direction: rising}
  cut_and_mod: {zero: "atan2(mod(cos(2*rod.theta), 0.475) - 0.2, sin(rocker.theta) - 0.9)"}
  abs_of_cut: {zero: "abs(atan2(bob.omega/(10 rad/s), cos(2*bob.theta))) - abs(mod(rocker.theta, 1 rad)/(1 rad))"}
  mod_of_mod: {zero: "mod(mod(om*t, 1.72378), 0.340561) - 0.1", direction: falling}
  touching: {zero: "atan2(mod(cos(2*rod.theta), 0.475), cos(2*rocker.theta))", direction: rising}
  pole: {zero: "(2 + mod(rod.theta, 1 rad)/(1 rad))/(atan2(bob.y/(0.3 m), rocker.omega/(10 rad/s)) - 0.9)"}
"""


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    load: Load = loader(Path(tmp_path_factory.mktemp("jumps")))
    return load(LINKAGE)


def _crossings(scene: Simulation, t_end: float, om: float) -> dict[str, list[float]]:
    """Times at which each event function changes its sign, from samples of a tight run; poles left out."""
    run = scene.simulate(t_end, output=30_000, rtol=1e-12, audit=False, parameters={"om": om})
    t, rod, rocker, bob = run.t, run["rod.theta"], run["rocker.theta"], run["bob.theta"]
    mod_rod, cut = np.mod(rod, 1.0), np.arctan2(run["bob.y"] / 0.3, run["rocker.omega"] / 10)
    values = {
        "cut": np.arctan2(mod_rod, np.sin(om * t * 1.19299)),
        "cut_and_mod": np.arctan2(np.mod(np.cos(2 * rod), 0.475) - 0.2, np.sin(rocker) - 0.9),
        "abs_of_cut": np.abs(np.arctan2(run["bob.omega"] / 10, np.cos(2 * bob))) - np.mod(rocker, 1.0),
        "mod_of_mod": np.mod(np.mod(om * t, 1.72378), 0.340561) - 0.1,
        "touching": np.arctan2(np.mod(np.cos(2 * rod), 0.475), np.cos(2 * rocker)),
        "pole": (2 + mod_rod) / (cut - 0.9),
    }
    found = {}
    for name, f in values.items():
        way = {"cut": 1, "touching": 1, "mod_of_mod": -1}.get(name, 0)
        jumps = np.flatnonzero(f[1:] * f[:-1] < 0.0)
        keep = [k for k in jumps if way * f[k + 1] >= 0.0 and (name != "pole" or abs(cut[k + 1] - cut[k]) > 1.0)]
        found[name] = [float(t[k + 1]) for k in keep]
    return found


@pytest.mark.parametrize("om", [12.986102344783664, 9.761013022983613, 23.54471861271511])
def test_events_that_jump_end_no_run(scene: Simulation, om: float) -> None:
    """Steps before a jump became ever shorter until none was small enough; switches that jump together made events."""
    expected = _crossings(scene, 1.5, om)
    for method in METHODS:
        for rtol in (4e-8, 2e-6):
            run = scene.simulate(1.5, method=method, rtol=rtol, output=20, parameters={"om": om})
            assert run.diagnostics.steps < 1500
            for name, times in expected.items():
                found = run.events_of(name)
                assert len(found) == len(times), (method, rtol, name)
                np.testing.assert_allclose(found, times, atol=2e-4)


@pytest.mark.parametrize("method", METHODS)
def test_a_pole_at_the_start_is_no_event(method: str, tmp_path: Path) -> None:
    """A driven velocity is rounding at the start: its reciprocal changes its sign there, at a pole, and ended runs."""
    every_kind = gudgeon.load(without_chain(tmp_path), "ideal")
    for radius in (0.04, 0.04004, 0.0401, 0.05):
        for t_end in (1e-6, 1e-4, 1e-2):
            run = every_kind.simulate(t_end, output=2, method=method, parameters={"joints.mesh.radii.x": radius})
            assert run.t[-1] == t_end
            assert not len(run.events_of("noon"))

"""A run that is cut at its own events and continued lists each of them once."""

from __future__ import annotations

import numpy as np
import pytest

import gudgeon
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
T_END, SEEDS, NAMES = 0.6, 40, [f"e{k}" for k in range(1, 9)]
MASS = """
format: gudgeon/1
name: mass
parameters: {A: 3 N, w: 7 rad/s, T: 0.13 s, k: 40 N/m, cc: 0.3 N*s/m, v0: 0.2 m/s, x0: 0 m, X1: 3 mm, X2: -4 mm}
bodies:
  b: {mass: 0.5 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  g: {translational: [ground.O, b.origin], axis: [1, 0]}
forces:
  f:
    force: b.origin
    value: ["-k*b.x - cc*b.vx + where(mod(t, T) < T/3, A, 0 N) + max(min(A*sin(w*t), A/4), -A/6) + abs(b.x - X2)*k", 0]
start:
  set: {b.x: x0}
  rates: {b.vx: v0}
events:
  e1: {zero: b.x - X1}
  e2: {zero: b.vx, direction: rising}
  e3: {zero: "mod(t, T) - T/2", direction: rising}
  e4: {zero: "sin(w*t)*b.x"}
  e5: {zero: "min(b.x, X1) - max(b.vx*0.01 s, X2)"}
  e6: {zero: "where(b.vx > 0, 1, -1)"}
  e7: {zero: "t - T", direction: both}
  e8: {zero: "abs(b.x) - X1", direction: falling}
"""


@pytest.fixture(scope="module")
def mass(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    file = tmp_path_factory.mktemp("scene") / "mass.yaml"
    file.write_text(MASS, encoding="utf-8")
    return gudgeon.load(file)


def given(rng: np.random.Generator) -> dict[str, float]:
    values = {
        "A": rng.uniform(1, 5),
        "w": 10 ** rng.uniform(0, 2),
        "T": 10 ** rng.uniform(-1.5, -0.3),
        "k": 10 ** rng.uniform(1, 3),
        "v0": rng.uniform(-0.5, 0.5),
        "x0": rng.uniform(-0.02, 0.02),
        "X1": rng.uniform(0, 0.01),
        "X2": rng.uniform(-0.01, 0),
    }
    return {name: float(value) for name, value in values.items()}


@pytest.mark.parametrize(("method", "rtol"), [("auto", 1e-10), ("radau5", 1e-10), ("dop853", 1e-7)])
def test_each_event_is_listed_once(mass: Simulation, method: str, rtol: float) -> None:
    lost = []
    for seed in range(SEEDS):
        rng = np.random.default_rng(seed)
        parameters = given(rng)
        whole = mass.simulate(T_END, parameters=parameters, method=method, output=2, rtol=rtol)
        every = np.unique(np.concatenate([whole.events_of(name) for name in NAMES]))
        cuts = [*sorted(rng.choice(every, min(5, len(every)), replace=False).tolist()), T_END]
        run = mass.simulate(cuts[0], parameters=parameters, method=method, output=1, rtol=rtol)
        found = {name: list(run.events_of(name)) for name in NAMES}
        for cut in cuts[1:]:
            run = mass.simulate(cut, start=run.final, method=method, output=1, rtol=rtol)
            for name in NAMES:
                found[name] += list(run.events_of(name))
        lost += [(seed, name) for name in NAMES if len(found[name]) != len(whole.events_of(name))]
    assert lost == []

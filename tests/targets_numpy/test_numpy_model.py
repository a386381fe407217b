"""The NumPy functions against the compiled ones, function by function; and as a user gets them."""

from __future__ import annotations

import shutil
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.kernels.closed_linkage import row_kernels
from gudgeon.generator.pipeline import derive
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.targets.latex.write import equations_text
from gudgeon.generator.targets.numpy import printer
from gudgeon.loading.shipped import shipped, shipped_file
from gudgeon.simulation.simulation import Simulation
from tests.oracles.linkage_yaml import to_yaml
from tests.oracles.random_linkage import random_case

pytestmark = pytest.mark.skipif(not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler")
SCENES = [
    (name, scene) for name in shipped() for scene in read_mechanism(shipped_file(name).read_bytes(), name, None).scenes
]


@cache
def load(name: str, scene: str) -> Simulation:
    return gudgeon.load(name, scene)


def states(simulation: Simulation, count: int = 4) -> list[tuple[float, np.ndarray, np.ndarray]]:
    """Near the start, journals up to a third of a millimetre out of their centres."""
    rng, start = np.random.default_rng(7), simulation.start()
    return [
        (float(rng.uniform()), start.q + rng.normal(0, 3e-4, start.q.size), start.v + rng.normal(0, 0.1, start.v.size))
        for _ in range(count)
    ]


def close(got: np.ndarray, want: np.ndarray, share: float) -> None:
    np.testing.assert_allclose(got, want, rtol=0, atol=share * max(np.abs(want).max(initial=0.0), 1e-300))


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_shipped_scenes(name: str, scene: str) -> None:
    check(load(name, scene))


def check(simulation: Simulation) -> None:
    """Parameters, start, rows and right-hand side at a few states, in contact and without, in stick and in slip."""
    model, c, p = simulation.model.numpy(), simulation.compiled, simulation.p
    joints, frictions = len(simulation.source.clearances), len(simulation.source.frictions)
    numbers = model.prepare()
    slots = model.model.slots
    names = [slots.field(slots.entries[slot.address].symbol) for slot in simulation.source.slots]
    in_c = dict(zip([*names, *simulation.source.derived], p.tolist(), strict=True))
    shared = [name for name in vars(numbers) if name in in_c]
    assert set(names) <= set(shared)
    close(np.array([getattr(numbers, name) for name in shared]), np.array([in_c[name] for name in shared]), 1e-15)
    close(model.mass(numbers), c.mass(p), 1e-15)
    for got, want in zip(model.start_values(numbers), c.start_values(p), strict=True):
        close(got, want, 1e-15)
    for t, q, v in states(simulation):
        close(model.phi(t, q, numbers), c.closed_phi(t, q, p), 1e-14)
        close(model.phi_q(t, q, numbers), c.closed_phi_q(t, q, p), 1e-14)
        close(model.nu(t, q, numbers), c.closed_nu(t, q, p), 1e-14)
        close(model.gamma(t, q, v, numbers), c.closed_gamma(t, q, v, p), 1e-14)
        for rate, mode in ((np.nan, 1.0), (0.05, -1.0), (0.2, 0.0)) if joints or frictions else ((np.nan, 1.0),):
            latches, modes = np.full(joints, rate), np.full(frictions, mode)
            got = model.dynamics(t, q, v, numbers, latches, modes)
            want = c.rhs(t, np.concatenate([q, v]), p, memory=np.concatenate([latches, modes]))
            assert got.status == 0
            close(got.a, want[q.size : 2 * q.size], 1e-12)


@pytest.mark.parametrize("seed", [1, 5, 9])
def test_random_linkages(seed: int, tmp_path: Path) -> None:
    file = tmp_path / "random.yaml"
    file.write_text(to_yaml(random_case(seed, bodies=2 + seed % 4, loops=seed % 3, drives=seed % 3)), encoding="utf-8")
    check(gudgeon.load(file))


def test_a_number_that_is_given() -> None:
    model = load("pendulum", "ideal").model.numpy()
    address = next(iter(model.model.slots.entries))
    name = printer.name(model.model.slots.entries[address].symbol.name)
    assert getattr(model.prepare({address: 0.125}), name) == 0.125 != getattr(model.prepare(), name)
    with pytest.raises(KeyError, match="no number has the address 'nobody'"):
        model.prepare({"nobody": 1.0})


def test_the_equations_can_still_be_read() -> None:
    """Functions are derived once, and documents after them are those before them."""
    data = shipped_file("slider_crank").read_bytes()
    first, second = (derive(data, "slider_crank.yaml", "dry") for _ in range(2))
    assert first.numpy() is first.numpy()
    assert equations_text(first) == equations_text(second)
    assert len(row_kernels(second)) == 4

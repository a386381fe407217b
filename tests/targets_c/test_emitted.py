"""The emitted, compiled C against the model's own equations in 30 digits, and against the oracles."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from gudgeon.generator.equations.model import Model
from gudgeon.generator.pipeline import generate_c
from gudgeon.loading.build import compile_kernels
from gudgeon.model.compiled import CompiledModel
from tests.equations.models import press, random_model, random_state
from tests.equations.thirty_digits import Reference
from tests.oracles import golden, ideal_press, numpy_linkage, press_dense
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
SEEDS = (1, 3, 4, 6)
SCENES = ("ideal", "dry", "lubricated")
NAN = float("nan")


@cache
def compiled(which: str | int) -> tuple[Model, CompiledModel, np.ndarray]:
    """Model, library and the default numbers of a scene of the press, or of a random linkage."""
    model = press(which) if isinstance(which, str) else random_model(which)[1]
    source = generate_c(model)
    library = CompiledModel(source, compile_kernels(source))
    slots = len(source.parameters)
    return model, library, library.prepare(np.zeros(slots), np.zeros(slots, dtype=bool))


def press_state(seed: int, clearance: float = 0.3e-3) -> tuple[float, np.ndarray, np.ndarray]:
    """The press near its ideal motion: journals anywhere from the centre to well inside their bearings."""
    rng = np.random.default_rng(seed)
    t = float(rng.uniform(0.0, 1.0))
    m = ideal_press.motion(t)
    return t, m.q[0] + rng.normal(0.0, clearance / 2.0, 24), m.v[0] + rng.normal(0.0, 0.02, 24)


def close(got: np.ndarray, want: np.ndarray, relative: float) -> None:
    scale = max(float(np.max(abs(want), initial=0.0)), 1e-300)
    assert float(np.max(abs(got - want), initial=0.0)) <= relative * scale


@pytest.mark.parametrize("which", slow_but(["ideal", 1, 4], (*SCENES, *SEEDS)))  # the other rows are among these
def test_rows_against_thirty_digits(which: str | int) -> None:
    model, library, p = compiled(which)
    for seed in range(3):
        t, q, v = random_state(model, seed)
        reference = Reference(model, t, q, v)
        for got, matrix in (
            (library.phi(t, q, p), model.Phi),
            (library.nu(t, q, p), model.nu),
            (library.gamma(t, q, v, p), model.gamma),
        ):
            close(got, reference.vector(matrix)[:, 0], 1e-12)
        close(library.phi_q(t, q, p), reference.vector(model.Phi_q), 1e-12)
        close(library.mass(p), reference.vector(model.M).diagonal(), 1e-12)


@pytest.mark.parametrize("which", slow_but(["ideal", "lubricated", 1, 4], (*SCENES, *SEEDS)))
def test_dynamics_against_thirty_digits(which: str | int) -> None:
    """q̈ and λ; the random linkages at random states too, which do not satisfy their constraints."""
    model, library, p = compiled(which)
    for seed in range(3):
        t, q, v = press_state(seed) if isinstance(which, str) else random_state(model, seed)
        memory = [0.02, NAN][: len(model.clearances)]
        a, multipliers = Reference(model, t, q, v, memory).accelerations()
        got = library.evaluate([t], q[None], v[None], np.array([memory or [NAN]]), p)
        close(got.a[0], a, 1e-12)
        close(got.multipliers[0], multipliers, 1e-12)
        close(library.rhs(t, np.concatenate([q, v]), p, memory or None)[:48][: 2 * q.size], np.r_[v, a], 1e-12)


@pytest.mark.parametrize("seed", slow_but([1, 4], SEEDS))
def test_dynamics_against_the_dense_oracle(seed: int) -> None:
    case, _ = random_model(seed)
    _, library, p = compiled(seed)
    a, multipliers = numpy_linkage.accelerations(case.linkage, 0.0, case.q, case.v, 50.0, 50.0)
    got = library.evaluate([0.0], case.q[None], case.v[None], np.full((1, 1), NAN), p)
    close(got.a[0], a, 1e-11)
    close(got.multipliers[0], multipliers, 1e-11)


@pytest.mark.parametrize("scene", ["dry", "lubricated"])
@pytest.mark.parametrize("memory", [(NAN, NAN), (0.05, 0.01)])
def test_press_against_the_dense_hand_written_one(scene: str, memory: tuple[float, float]) -> None:
    from dataclasses import replace

    _, library, p = compiled(scene)
    peer = replace(golden.DRY, common_point=True, film=scene == "lubricated")
    first, second = (0.0 if np.isnan(m) else m for m in memory)
    touched = 0
    for seed in range(20):
        t, q, v = press_state(seed)
        dy, _, contacts = press_dense.rhs(peer, t, np.concatenate([q, v]), (first, second))
        got = library.evaluate([t], q[None], v[None], np.array([memory]), p)
        close(got.a[0], dy[24:], 1e-10)
        for columns, contact in zip(got.clearance[0], contacts, strict=True):
            assert columns[0] == pytest.approx(contact.fx, rel=1e-8, abs=1e-9)
            assert columns[1] == pytest.approx(contact.fy, rel=1e-8, abs=1e-9)
            assert columns[6] == pytest.approx(contact.e, rel=1e-11)
            n = columns[4:6] / columns[6]
            assert columns[2] == pytest.approx(-columns[:2] @ n, rel=1e-9, abs=1e-9)  # Fn > 0 pushes the journal back
            assert columns[3] == pytest.approx(columns[1] * n[0] - columns[0] * n[1], rel=1e-9, abs=1e-9)
            assert columns[7] == pytest.approx(contact.deltadot, rel=1e-9, abs=1e-12)
            touched += contact.delta > 0.0
    assert 5 < touched < 35  # the states are of both kinds


@pytest.mark.parametrize("seed", slow_but([1, 4, 5], range(9)))
def test_reactions_and_torques_move_the_bodies(seed: int) -> None:
    """Newton and Euler, body by body: weight, reactions at the joints' points, torques give m a and J α."""
    case, _ = random_model(seed)
    _, library, p = compiled(seed)
    linkage, q, v = case.linkage, case.q, case.v
    got = library.evaluate([0.0], q[None], v[None], np.full((1, 1), NAN), p)
    load = numpy_linkage.forces(linkage, q, v)
    scale = abs(got.reactions).max(initial=1.0)
    joints: Any = linkage.joints  # revolute and translational ones here, drives of angles
    drives: Any = linkage.drives
    for joint, (fx, fy, moment) in zip(joints, got.reactions[0], strict=True):
        at = numpy_linkage.place(joint.second, q, v).r  # the second body's point; the first body feels it there too
        for end, sign in ((joint.second, 1.0), (joint.first, -1.0)):
            if end.body != numpy_linkage.GROUND:
                k = 3 * end.body
                arm = at - q[k : k + 2]
                load[k : k + 3] += sign * np.array([fx, fy, moment + arm[0] * fy - arm[1] * fx])
        if isinstance(joint, numpy_linkage.Revolute):
            assert abs(moment) < 1e-12 * scale
        else:
            turned = np.array(joint.axis) / np.hypot(*joint.axis)
            angle = 0.0 if joint.first.body == numpy_linkage.GROUND else q[3 * joint.first.body + 2]
            along = numpy_linkage.rotation(angle) @ turned
            assert abs(fx * along[0] + fy * along[1]) < 1e-12 * scale  # nothing along the slide
    for drive, torque in zip(drives, got.torques[0], strict=True):
        load[3 * drive.body + 2] += torque
        if drive.reference != numpy_linkage.GROUND:
            load[3 * drive.reference + 2] -= torque
    assert abs(load - numpy_linkage.mass(linkage) * got.a[0]).max() < 1e-12 * max(
        scale, abs(got.torques).max(initial=0.0)
    )
    energy = 0.5 * numpy_linkage.mass(linkage) @ v**2
    assert got.energy[0, 0] == pytest.approx(energy, rel=1e-13)
    force = numpy_linkage.forces(linkage, q, v)
    assert got.energy[0, 1] == pytest.approx(-force @ q, rel=1e-12, abs=1e-12)

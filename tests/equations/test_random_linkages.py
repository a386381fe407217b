"""Random linkages of every joint, drive and force element: emitted C against a dense oracle in NumPy.

Six of the 500 run always, all of them with `-m slow`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.loading import compiler
from gudgeon.loading.build import compile_kernels
from gudgeon.model.compiled import CompiledModel, Evaluation
from gudgeon.results.results import State
from gudgeon.simulation.simulation import Simulation
from tests.oracles import numpy_linkage
from tests.oracles.linkage_joints import CoordinateDrive, Distance, DistanceDrive, Gear, PointOnLine
from tests.oracles.linkage_loads import turning
from tests.oracles.linkage_yaml import to_yaml
from tests.oracles.numpy_linkage import GROUND, Drive, End, Revolute, Translational
from tests.oracles.random_linkage import Case
from tests.oracles.random_mechanism import near, random_mechanism
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
ALWAYS, ALL = (3, 4, 5, 8), 500
GAINS = (50.0, 50.0)  # Baumgarte's, the defaults
NAN = np.full((1, 1), np.nan)


def compiled(case: Case, monkeypatch: pytest.MonkeyPatch) -> CompiledModel:
    """The case's library, not optimised: compiling would take longer than everything else."""
    source = generate_kernel_source(to_yaml(case).encode(), f"random_{case.seed}.yaml", "ideal")
    with monkeypatch.context() as patch:
        patch.setattr(compiler, "FLAGS", ("-O0", *(flag for flag in compiler.FLAGS if not flag.startswith("-O"))))
        return CompiledModel(source, compile_kernels(source))


def close(got: np.ndarray, want: np.ndarray, relative: float, least: float = 1e-3) -> bool:
    """Relative to the largest entry, or to `least`, below which nothing in these linkages matters."""
    return bool(np.all(abs(got - want) <= relative * max(least, float(np.max(abs(want), initial=0.0)))))


def check_dynamics(case: Case, library: CompiledModel, p: np.ndarray, t: float, q: np.ndarray, v: np.ndarray) -> None:
    """Φ, Φ_q, ν, γ, q̈ and λ at a state."""
    want = numpy_linkage.rows(case.linkage, t, q, v)
    assert close(library.phi(t, q, p), want.phi, 1e-12)
    assert close(library.phi_q(t, q, p), want.phi_q, 1e-12)
    assert close(library.nu(t, q, p), want.nu, 1e-12)
    assert close(library.gamma(t, q, v, p), want.gamma, 1e-12)
    a, multipliers = numpy_linkage.accelerations(case.linkage, t, q, v, *GAINS)
    got = library.evaluate([t], q[None], v[None], NAN, p)
    assert close(got.a[0], a, 1e-10, 1.0)
    assert close(got.multipliers[0], multipliers, 1e-10, 0.1)


def moved_by(case: Case, got: Evaluation, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """All that acts on the bodies by what the product reports: loads, reactions at their points, drives; (n,)."""
    load = numpy_linkage.forces(case.linkage, q, v, t)

    def push(body: int, at: np.ndarray, wrench: np.ndarray) -> None:
        if body != GROUND:
            arm = at - q[3 * body : 3 * body + 2]
            load[3 * body : 3 * body + 3] += [*wrench[:2], wrench[2] + arm[0] * wrench[1] - arm[1] * wrench[0]]

    for joint, wrench in zip(case.linkage.joints, got.reactions[0], strict=True):
        if isinstance(joint, Gear):  # moments as the radii; the carrier bears the rest
            mesh = wrench[2] / joint.radii[1]
            load += mesh * joint.coefficients(q.size)
            assert np.all(wrench[:2] == 0.0)
            continue
        at = joint.first if isinstance(joint, PointOnLine) else joint.second  # type: ignore[union-attr]
        point = numpy_linkage.place(at, q, v).r
        push(joint.second.body, point, wrench)  # type: ignore[union-attr]
        push(joint.first.body, point, -wrench)  # type: ignore[union-attr]
    for drive, value in zip(case.linkage.drives, got.torques[0], strict=True):
        if isinstance(drive, Drive):
            load += turning(q.size, drive.body, value) + turning(q.size, drive.reference, -value)
        elif isinstance(drive, CoordinateDrive):
            load[3 * drive.body + drive.which] += value
        elif isinstance(drive, DistanceDrive):  # positive: pushes the points apart
            one, two = (numpy_linkage.place(end, q, v) for end in (drive.first, drive.second))
            u = (two.r - one.r) / np.hypot(*(two.r - one.r))
            load += value * (u @ (two.r_q - one.r_q))
    return load


def check_newton_euler(case: Case, library: CompiledModel, p: np.ndarray) -> None:
    """Loads and reported reactions give m a and J α, body by body; each joint bears only what its kind can."""
    q, v = case.q, case.v
    got = library.evaluate([0.0], q[None], v[None], NAN, p)
    scale = max(1.0, abs(got.reactions).max(initial=0.0), abs(got.torques).max(initial=0.0))
    inertial = numpy_linkage.mass(case.linkage) * got.a[0]
    assert abs(moved_by(case, got, 0.0, q, v) - inertial).max() < 1e-11 * scale
    for joint, (fx, fy, moment) in zip(case.linkage.joints, got.reactions[0], strict=True):
        if isinstance(joint, Revolute | Distance | PointOnLine):
            assert abs(moment) < 1e-11 * scale
        for along, across in free_directions(joint, q, v):
            assert abs(fx * along + fy * across) < 1e-11 * scale


def free_directions(joint: object, q: np.ndarray, v: np.ndarray) -> list[tuple[float, float]]:
    """The direction (ground axes) along which a joint bears no force."""

    def turned(end: End, axis: tuple[float, float]) -> tuple[float, float]:
        x, y = numpy_linkage.rotation(numpy_linkage.place(end, q, v).angle) @ axis / np.hypot(*axis)
        return float(x), float(y)

    if isinstance(joint, Translational):
        return [turned(joint.first, joint.axis)]
    if isinstance(joint, PointOnLine):
        return [turned(joint.second, joint.direction)]
    if isinstance(joint, Distance):
        x, y = numpy_linkage.place(joint.second, q, v).r - numpy_linkage.place(joint.first, q, v).r
        return [(float(-y / joint.length), float(x / joint.length))]
    return []


def duration(case: Case) -> float:
    """0.02 s, or less where the motion is quick: a drive may soon ask for what the linkage cannot reach."""
    speed, hurry = abs(case.v).max(), abs(numpy_linkage.accelerations(case.linkage, 0.0, case.q, case.v)[0]).max()
    return float(min(0.02, 0.1 / max(speed, 1e-9), np.sqrt(0.1 / max(hurry, 1e-9))))


def drift(case: Case, library: CompiledModel, steps: int) -> tuple[float, float]:
    """Largest change of energy less work, by the oracle's energy and the product's work; the energies' size."""
    t_end, start = duration(case), State("", "", 0.0, case.q, case.v, np.zeros(0), np.zeros(0), {})
    scene = Simulation(library, Path(f"random_{case.seed}.yaml"))
    run = scene.simulate(t_end, output=8, step=t_end / steps, start=start)
    energy = np.array([numpy_linkage.energy(case.linkage, q, v) for q, v in zip(run.q, run.v, strict=True)])
    if case.seed % 3 == 0:  # springs and gravity only
        assert not run.work.any()
    kinetic = run.v**2 @ numpy_linkage.mass(case.linkage)
    size = float(kinetic.max() + np.abs(run.work).max() + np.abs(energy).max())
    return float(np.abs(energy - energy[0] - run.work.sum(axis=1)).max()), size


def check_energy(case: Case, library: CompiledModel) -> None:
    """Energy is conserved (or balances the work) to the method's order, or to rounding."""
    (coarse, size), (fine, _) = drift(case, library, 48), drift(case, library, 96)
    assert fine < max(coarse / 8.0, 2e-14 * (1.0 + size))  # 16 in the limit; rounding of terms of some 1 J
    assert fine < 1e-6 * size


@pytest.mark.parametrize("seed", slow_but(ALWAYS, range(ALL)))
def test_random_linkage(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    case = random_mechanism(seed)
    library = compiled(case, monkeypatch)
    slots = len(library.source.parameters)
    p = library.prepare(np.zeros(slots), np.zeros(slots, dtype=bool))
    check_dynamics(case, library, p, 0.0, case.q, case.v)
    for other in range(2):
        check_dynamics(case, library, p, *near(case, other))
    check_newton_euler(case, library, p)
    if library.source.degrees_of_freedom:
        check_energy(case, library)


def test_the_random_linkages_have_everything() -> None:
    """Every joint, drive and element, loops and trees, in the part that always runs."""
    cases = [random_mechanism(seed) for seed in ALWAYS]
    kinds = {type(part).__name__ for case in cases for part in (*case.linkage.joints, *case.linkage.drives)}
    kinds |= {type(load).__name__ for case in cases for load in case.linkage.loads}
    assert kinds >= {"Revolute", "Translational", "Rigid", "Distance", "PointOnLine", "Gear", "Drive"}
    assert kinds >= {"CoordinateDrive", "DistanceDrive", "Spring", "RotationalSpring", "Force", "Torque"}
    loops = [len(case.linkage.joints) > len(case.linkage.bodies) for case in cases]
    assert any(loops)
    assert not all(loops)

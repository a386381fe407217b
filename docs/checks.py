"""Prints README's table of what is checked against what, measured anew: `make checks`, some ten seconds.

    python -m docs.checks                   # from the repository's root: the oracles live with the tests

Each row is a test too, with the limit that is asserted; here one sees how far below the limit it stays.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np

import gudgeon
from gudgeon.diagnostics import Diagnostics
from tests.generator import models
from tests.generator.thirty_digits import Reference
from tests.oracles import dry, golden, ideal_press

PRESS = "nine_bar_press"
GOLDEN = golden.load()
Row = tuple[str, str, float, str, str]  # what, against what, found, asked, test


def worst(got: np.ndarray, want: np.ndarray) -> float:
    """Largest difference, relative to the largest value."""
    return float(np.max(abs(got - want)) / max(1.0, float(np.max(abs(want)))))


def ideal() -> Iterable[Row]:
    run = gudgeon.load(PRESS).simulate(1.0)
    want = ideal_press.motion(run.t)
    yield ("ideal press, positions (m, rad)", "closed form: intersections of circles", float(abs(run.q - want.q).max()),
           "1e-12", "test_golden.py::test_ideal_press_is_its_closed_form")  # fmt: skip


def lubricated() -> Iterable[Row]:
    want = GOLDEN["lubricated"]
    numbers = {"omega": want["omega"], "c": want["c"], "contacts.oil.transition": want["transition"]}
    press = gudgeon.load(PRESS, scene="lubricated")
    run = press.simulate(output=[0.0, *want["t"]], step=want["step"], parameters=numbers)
    test = "test_golden.py::test_lubricated_press_reaches_the_golden_figures"
    for what, pairs, asked in (
        ("y and v", (("S9.y", "y9"), ("S9.vy", "v9")), "1e-6"),
        ("forces", (("A.F", "F_A"), ("B.F", "F_B")), "1e-4"),
    ):
        found = max(float(abs(run[name][1:] / np.array(want[key]) - 1.0).max()) for name, key in pairs)
        yield f"lubricated press, {what} (relative)", "golden figures of two independent codes", found, asked, test


def first_contacts() -> Iterable[Row]:
    want = GOLDEN["dry"]
    run = gudgeon.load(PRESS, scene="dry").simulate(want["t_end"], output=9, step=want["step"])
    peaks = [(run.diagnostics.peak(joint), joint) for joint in ("A", "B")]
    test = "test_golden.py::test_dry_press_reaches_the_golden_first_contacts"
    times = max(abs(peak.first_contact - want["first_contact"][joint]) for peak, joint in peaks)
    forces = max(abs(peak.first_peak / want["first_peak"][joint] - 1.0) for peak, joint in peaks)
    yield "dry press, first contacts (s)", "golden figures", times, "2e-6", test
    yield "dry press, first peaks (relative)", "golden figures", forces, "2e-3", test


def energy() -> Iterable[Row]:
    for scene in ("dry", "lubricated"):
        d: Diagnostics = gudgeon.load(PRESS, scene=scene).simulate(1.0).diagnostics
        yield (f"{scene} press, 1 s: energy unaccounted for (of what was turned over)", "work of drives and contacts",
               d.energy_residual / d.energy_turned_over, "1e-8",
               "test_golden.py::test_energy_is_accounted_for")  # fmt: skip


def order() -> Iterable[Row]:
    pendulum = gudgeon.load(Path(__file__).parents[1] / "tests/mechanisms/valid/double_pendulum.yaml")
    ends = [pendulum.simulate(1.0, output=1, step=step).q[-1] for step in (4e-3, 2e-3, 1e-3)]
    coarse, fine = (float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(ends))
    yield ("RK4 on a smooth scene: observed order", "4", math.log2(coarse / fine), "4.0 ± .1",
           "test_free_bodies.py::test_observed_order_of_rk4")  # fmt: skip


def derivation() -> Iterable[Row]:
    jacobian = gamma = emitted = 0.0
    h = 1e-5
    for scene, seed in itertools.product(("dry", "lubricated"), range(3)):
        model, press = models.press(scene), gudgeon.load(PRESS, scene=scene)
        phi_q, nu = models.numeric(model, model.Phi_q), models.numeric(model, model.nu)
        t, q, v = models.random_state(model, seed)
        differences = [(press.phi(t, q + s) - press.phi(t, q - s)) / (2 * h) for s in h * np.eye(q.size)]
        jacobian = max(jacobian, worst(press.phi_q(t, q), np.transpose(differences)))
        later: Any = t + 1e-30j, q + 1e-30j * v, v
        rate = (phi_q(*later) @ v[:, None] - nu(*later)).imag[:, 0] / 1e-30
        gamma = max(gamma, worst(press.gamma(t, q, v), -rate))
        m = ideal_press.motion(t)
        q, v = m.q[0] + np.random.default_rng(seed).normal(0.0, 1.5e-4, q.size), m.v[0]
        a, _ = Reference(model, t, q, v, [math.nan, math.nan]).accelerations()
        got = press.rhs(t, np.concatenate([q, v]))[q.size :]
        emitted = max(emitted, float(abs(got - a).max() / abs(a).max()))
    yield ("Φ_q in C (relative)", "differences of Φ", jacobian, "1e-7",
           "test_derivation.py::test_jacobian_against_finite_differences")  # fmt: skip
    yield ("γ in C (relative)", "d/dt of Φ_q q̇ − ν by complex steps", gamma, "1e-9",
           "test_derivation.py::test_right_hand_sides_against_complex_steps")  # fmt: skip
    yield ("q̈ in C (relative)", "the same equations in 30 digits", emitted, "1e-12",
           "test_emitted.py::test_dynamics_against_thirty_digits")  # fmt: skip


def restitution() -> Iterable[Row]:
    found = dry.delivered(dry.dissipation_factor(0.9))
    yield ("restitution that Lankarani–Nikravesh delivers at c_e = .9", "a(1+e) = ln[(1+a)/(1−a e)]", found, ".91318",
           "test_forces.py::test_restitution_of_the_normal_law")  # fmt: skip


GROUPS: tuple[Callable[[], Iterable[Row]], ...] = (
    ideal, lubricated, first_contacts, energy, order, derivation, restitution,
)  # fmt: skip


def main() -> None:
    print("| what | against | found | asked | test |\n|---|---|---|---|---|")
    for group in GROUPS:
        for what, against, found, asked, test in group():
            number = f"{found:.5g}" if 0.1 < abs(found) < 100 else f"{found:.1e}"
            print(f"| {what} | {against} | {number} | {asked} | `{test}` |", flush=True)


if __name__ == "__main__":
    main()

"""Measure the differences of gudgeon from independent results and print the table of docs/checks.md: `make checks`.

    python -m tests.checks                   # in the root of the repository, about a minute

Each row is also a test, which asserts the limit. The table also shows how far below the limit the difference is.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from scipy.special import ellipj, ellipk

import gudgeon
from tests.equations import models
from tests.equations.subjects import shipped_subject
from tests.equations.thirty_digits import Reference
from tests.integrators import test_methods
from tests.kernels import test_jacobian
from tests.kernels.test_tree_jacobian import CASES, Tree
from tests.oracles import dry, golden, ideal_press
from tests.reduction.reduced import Reduced

PRESS = "nine_bar_press"
GOLDEN = golden.load()
Row = tuple[str, str, float, str, str]  # quantity, reference, difference, limit, test


def worst(got: np.ndarray, want: np.ndarray) -> float:
    """Largest difference, relative to the largest value."""
    return float(np.max(abs(got - want)) / max(1.0, float(np.max(abs(want)))))


def ideal() -> Iterable[Row]:
    run = gudgeon.load(PRESS).simulate(1.0)
    want = ideal_press.motion(run.t)
    yield (
        "ideal press, positions (m, rad)",
        "closed form: intersections of circles",
        float(abs(run.q - want.q).max()),
        "1e-12",
        "test_golden.py::test_ideal_press_is_its_closed_form",
    )


def lubricated() -> Iterable[Row]:
    want = GOLDEN["lubricated"]
    numbers = {"omega": want["omega"], "c": want["c"], "contacts.oil.transition": want["transition"]}
    press = gudgeon.load(PRESS, scene="lubricated")
    run = press.simulate(output=[0.0, *want["t"]], step=want["step"], parameters=numbers)
    test = "test_golden.py::test_lubricated_press_reaches_the_golden_figures"
    for what, pairs, requested in (
        ("y and v", (("S9.y", "y9"), ("S9.vy", "v9")), "1e-6"),
        ("forces", (("A.F", "F_A"), ("B.F", "F_B")), "1e-4"),
    ):
        found = max(float(abs(run[name][1:] / np.array(want[key]) - 1.0).max()) for name, key in pairs)
        yield f"lubricated press, {what} (relative)", "golden values", found, requested, test


def first_contacts() -> Iterable[Row]:
    want = GOLDEN["dry"]
    run = gudgeon.load(PRESS, scene="dry").simulate(want["t_end"], output=9, step=want["step"])
    peaks = [(run.diagnostics.peak(joint), joint) for joint in ("A", "B")]
    test = "test_golden.py::test_dry_press_reaches_the_golden_first_contacts"
    times = max(abs(peak.first_contact - want["first_contact"][joint]) for peak, joint in peaks)
    forces = max(abs(peak.first_peak / want["first_peak"][joint] - 1.0) for peak, joint in peaks)
    yield "dry press, first contacts (s)", "golden values", times, "2e-6", test
    yield "dry press, first peaks (relative)", "golden values", forces, "2e-3", test


def energy() -> Iterable[Row]:
    """With the fixed steps of the tests; then auto at its usual tolerance."""
    want = GOLDEN["lubricated"]
    numbers = {"omega": want["omega"], "c": want["c"], "contacts.oil.transition": want["transition"]}
    runs = {
        "dry press, rk4, 0.03 s": gudgeon.load(PRESS, scene="dry").simulate(0.03, step=1e-6),
        "lubricated press, rk4, 0.4 s": gudgeon.load(PRESS, scene="lubricated").simulate(
            output=[0.0, *want["t"]], step=want["step"], parameters=numbers
        ),
    }
    for what, run in runs.items():
        yield (
            f"{what}: energy residual (relative to the energy throughput)",
            "work of drives, contacts and films",
            run.diagnostics.energy_residual / run.diagnostics.energy_turned_over,
            "1e-8",
            "test_golden.py::test_energy_is_accounted_for",
        )
    runs = {method: test_methods.race(method, 1e-8) for method in test_methods.ADAPTIVE}
    worst_of = max(-run.diagnostics.energy_residual / run.work[-1, 2] for run in runs.values())
    yield (
        "dry press, 0.05 s at rtol 1e-8: energy residual (relative to the dissipated energy)",
        "work of drives and contacts",
        worst_of,
        "1e-5",
        "test_methods.py::test_energy_of_the_dry_press",
    )


def order() -> Iterable[Row]:
    """Slopes of error over step; an interpolant of order p errs by O(h^(p + 1)) between the ends of steps."""
    rodas, dop = "test_rodas5p_has_order_5_and_its_interpolant_4", "test_dop853_has_order_8_and_its_interpolant_7"
    for method, scene, steps, inside, requested, test in (
        ("rk4", "swing", (60, 4000, 12), False, "4 ± 0.15", "test_rk4_has_order_4"),
        ("rk4", "swing", (60, 4000, 12), True, "4 ± 0.15", "test_rk4_has_order_4"),
        ("rodas5p", "swing", (12, 1600, 14), False, "5 ± 0.15", rodas),
        ("rodas5p", "swing", (12, 1600, 14), True, "5 ± 0.15", rodas),
        ("dop853", "car_axis", (40, 400, 14), False, "8 ± 0.4", dop),
        ("dop853", "car_axis", (40, 400, 14), True, "8 ± 0.4", dop),
    ):
        found = test_methods.observed_order(scene, method, 1.0, steps, inside)
        what = f"observed order of {method}{', dense output' * inside}"
        yield what, "a run at rtol 1e-14", found, requested, f"test_methods.py::{test}"


def onsets() -> Iterable[Row]:
    exact = np.array([t for _, t, _ in test_methods.ONSETS["onsets"]])
    runs = [test_methods.race(*setting) for setting in (("dop853", 1e-13), ("rodas5p", 1e-14), ("auto", 1e-13))]
    yield (
        f"dry press, {len(exact)} onsets in 0.05 s: times, largest of dop853, rodas5p, auto (s)",
        "hand-written equations in long double",
        max(float(abs(run.impacts["t_on"] - exact).max()) for run in runs),
        "1e-10",
        "test_methods.py::test_every_onset_of_the_dry_press",
    )


def long_runs() -> Iterable[Row]:
    """Many digits, and many seconds."""
    andrews, known = test_methods.scene_of("andrews_squeezer"), "the same equations in 25 digits"
    runs = [andrews.simulate(0.03, output=1, method=m, rtol=r) for m, r in (("dop853", 1e-14), ("rodas5p", 1e-13))]
    yield (
        "Andrews' squeezer, seven angles, larger of dop853, rodas5p (relative)",
        known,
        10.0 ** -min(map(test_methods.digits, runs)),
        "1e-12",
        "test_methods.py::test_andrews_in_twelve_digits",
    )
    run = andrews.simulate(0.03, output=1, method="dop853", rtol=1e-10)
    yield (
        f"Andrews' squeezer, right-hand sides that dop853 evaluates for {test_methods.digits(run):.1f} digits (count)",
        known,
        run.diagnostics.right_hand_sides,
        "1600",
        "test_methods.py::test_andrews_in_ten_digits_with_few_right_hand_sides",
    )
    yield (
        "pendulum, angle after 2000 s (rad)",
        "elliptic functions",
        float(abs(phase()).max()),
        "1e-6",
        "test_methods.py::test_pendulum_keeps_its_phase_for_two_thousand_seconds",
    )
    press = test_methods.scene_of(PRESS, "lubricated")
    run = press.simulate(100.0, output=1001, rtol=1e-5, parameters=test_methods.LUBRICATED)
    phi, rate = run.diagnostics.phi_max, run.diagnostics.phi_dot_max  # of the closures, at every step
    for t, q, v in zip(run.t, run.q, run.v, strict=True):  # of all rows, at the samples
        phi = max(phi, float(abs(press.compiled.phi(t, q, run.p)).max()))
        nu = press.compiled.nu(t, q, run.p)
        rate = max(rate, float(abs(press.compiled.phi_q(t, q, run.p) @ v - nu).max()))
    test = "test_methods.py::test_constraints_hold_to_rounding"
    yield "lubricated press, 100 s: constraints Φ (m, rad)", "0", phi, "1e-15", test
    yield "lubricated press, 100 s: rates of the constraints Φ̇ (m/s, rad/s)", "0", rate, "1e-13", test


def phase() -> np.ndarray:
    """Error of the angle at 1999.5 s and 2000 s, from the horizontal: sin(θ/2) = k sn(K − ω t), k = sin 45°."""
    run = gudgeon.load("pendulum").simulate(2000.0, output=[0.0, 1999.5, 2000.0], method="dop853", rtol=1e-14)
    k2, period = 0.5, test_methods.KNOWN["pendulum"]["period"]
    argument = ellipk(k2) * (1.0 - 4.0 * np.fmod(run.t[1:], period) / period)
    theta = 2.0 * np.arcsin(math.sqrt(k2) * ellipj(argument, k2)[0])
    return np.asarray(np.arctan2(run["bob.x"][1:], -run["bob.y"][1:]) - theta)


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
    yield (
        "Φ_q in C (relative)",
        "finite differences of Φ",
        jacobian,
        "1e-7",
        "test_derivation.py::test_jacobian_against_finite_differences",
    )
    yield (
        "γ in C (relative)",
        "d/dt of Φ_q q̇ − ν by complex-step derivatives",
        gamma,
        "1e-9",
        "test_derivation.py::test_right_hand_sides_against_complex_steps",
    )
    yield (
        "q̈ in C (relative)",
        "the same equations in 30 digits",
        emitted,
        "1e-12",
        "test_emitted.py::test_dynamics_against_thirty_digits",
    )


def slopes() -> Iterable[Row]:
    """Exact Jacobians, column by column relative to its largest entry, as their tests have it."""
    found = 0.0
    for scene, seed in itertools.product(("dry", "lubricated"), range(3)):
        subject = shipped_subject(PRESS, scene)
        y, memory = test_jacobian.near_start(PRESS, scene, subject, seed)
        memory = memory[: max(subject.library.n_discrete_states, 1)]
        J, _ = subject.library.jacobian(0.1 + seed, y, subject.p, memory)
        want, _ = subject.exact.jacobian(0.1 + seed, y, memory)
        n = subject.n
        for block in (slice(0, n), slice(n, 2 * n), slice(2 * n, None)):
            size = abs(want[block])
            scale = np.maximum(size.max(axis=0), max(1e-4 * size.max(), 1e-2))
            found = max(found, float((abs(J[block, : 2 * n] - want[block]).max(axis=0) / scale).max()))
    yield (
        "∂ẏ/∂y in C, with friction and film (relative)",
        "complex-step derivatives of the model's equations",
        found,
        "1e-10",
        "test_jacobian.py::test_every_shipped_scene",
    )
    found = 0.0
    for name, scene, t in CASES:
        tree = Tree(gudgeon.load(name, scene=scene), t)
        J, f_t = tree.jacobian()
        r = np.random.default_rng(5).normal(size=len(tree.y)) * (abs(J).max(axis=1) + 1.0)
        for eta in (1e-7, 1e-5, 1e-3, 1e-2):
            exact = np.linalg.solve(np.eye(len(tree.y)) / eta - J, r + 0.3 * f_t)
            found = max(found, float(abs(tree.solve(eta, 0.3, r) - exact).max() / abs(exact).max()))
    yield (
        "linear systems of Newton's method in tree coordinates: solution (relative)",
        "solution by NumPy with the full matrix",
        found,
        "1e-8",
        "test_tree_jacobian.py::test_newton_solves_with_it",
    )


def reduction() -> Iterable[Row]:
    """Accelerations of the tree's angles at states that close the loops; journals free and in contact."""
    found = 0.0
    for name, scene in (*itertools.product([PRESS], ("ideal", "dry", "lubricated")), ("andrews_squeezer", "ideal")):
        simulation = gudgeon.load(name, scene=scene)
        library, start = simulation.compiled, simulation.start()
        reduced = Reduced(library, simulation.p)
        index = [library.source.coordinates.index(f"{body}.theta") for body in library.source.tree_coordinates]
        s, rate = reduced.reduce(0.0, start.q, start.v)
        for seed in range(4):
            rng = np.random.default_rng(seed)
            near = s + rng.normal(0.0, 1e-3 * seed, len(s))
            here = reduced.close(0.0, near, rate + rng.normal(0.0, 0.1 * seed, len(s)))
            memory = np.full(max(library.n_discrete_states, 1), math.nan if seed % 2 else 0.02)
            q, v = reduced.expand(0.0, *here)
            rows = memory[None, : library.n_discrete_states]
            want = library.evaluate([0.0], q[None], v[None], rows, simulation.p).a[0, index]
            found = max(found, worst(reduced.accelerations(0.0, *here, memory)[0], want))
    yield (
        "q̈ of the reduced formulation (relative)",
        "the full formulation",
        found,
        "1e-9",
        "test_reduction.py::test_shipped_mechanisms",
    )


def restitution() -> Iterable[Row]:
    found = dry.delivered(dry.dissipation_factor(0.9))
    yield (
        "coefficient of restitution that results from the law of Lankarani and Nikravesh at c_e = 0.9",
        "a(1+e_r) = ln[(1+a)/(1−a e_r)]",
        found,
        "0.91318",
        "test_forces.py::test_restitution_of_the_normal_law",
    )


GROUPS: tuple[Callable[[], Iterable[Row]], ...] = (
    ideal,
    lubricated,
    first_contacts,
    energy,
    onsets,
    order,
    long_runs,
    derivation,
    slopes,
    reduction,
    restitution,
)


def main() -> None:
    print("| quantity | reference | difference | limit | test |\n|---|---|---|---|---|")
    for group in GROUPS:
        for what, against, found, requested, test in group():
            number = f"{found:.1e}" if abs(found) < 0.1 else f"{found:.5g}"
            print(f"| {what} | {against} | {number} | {requested} | `{test}` |", flush=True)


if __name__ == "__main__":
    main()

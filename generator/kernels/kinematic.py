"""Kinematic analysis, for scenes without degrees of freedom in tree coordinates: Newton's step, rates, body motion."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder, remove_unused_locals
from gudgeon.generator.ir.signatures import PARAMETERS, STATE, make_output_argument
from gudgeon.generator.ir.statements import MaxMagnitude, Return
from gudgeon.generator.solvers.square_rows import SquareSystem
from gudgeon.generator.symbols.storage import StorageLocation


def make_kinematic_kernels(system: System, closures: SquareSystem) -> list[Kernel]:
    """Return the kernels of Newton's step with rates, and of accelerations with the motion of all bodies.

    `closures`: the loop closures of the tree as a square system, one equation for each tree coordinate. Sines and
    cosines are not yet paired in vectors.
    """
    kernels = (_make_newton_step_kernel(system, closures), _make_body_motion_kernel(system, closures))
    return [remove_unused_locals(kernel) for kernel in kernels]


def _make_newton_step_kernel(system: System, closures: SquareSystem) -> Kernel:
    """Return the kernel of Newton's step, Φ_q step = Φ (to subtract), and of the rates, Φ_q rates = ν.

    It also writes the largest |Φ|, and returns 0 or the number of an equation that depends on others there. `closures`:
    the closures of the tree as a square system.
    """
    builder = KernelBuilder(
        system.model.symbols,
        "close_step",
        [
            "Newton's step and the rates of the tree's coordinates q: Phi_q step = Phi, Phi_q rates = nu.",
            "`worst`: the largest |Phi|. Returns 0, or the number of a row that depends on others here.",
        ],
    )
    builder.begin_section("closures")
    phi = [builder.append_local(f"phi_{name}", row.phi) for name, row in zip(closures.names, system.rows, strict=True)]
    solvers = closures.factorize(builder)
    builder.begin_section("Newton's step")
    step = closures.solve(builder, solvers, phi, "step")
    builder.begin_section("rates")
    rates = closures.solve(builder, solvers, [row.nu for row in system.rows], "rate")
    builder.begin_section("results")
    for k, (component, rate) in enumerate(zip(step, rates, strict=True)):
        builder.append_store(StorageLocation("step")[k], component)
        builder.append_store(StorageLocation("rates")[k], rate)
    builder.append_instruction(MaxMagnitude("worst", tuple(phi)))
    builder.append_instruction(Return())
    outs = (make_output_argument(name) for name in ("step", "rates", "worst"))
    return builder.build_kernel((*STATE[:2], PARAMETERS, *outs), status=True)


def _make_body_motion_kernel(system: System, closures: SquareSystem) -> Kernel:
    """Return the kernel of the accelerations, Φ_q a = γ, and of position, velocity and acceleration of all bodies.

    It also writes the largest |Φ̇|, and returns 0 or the number of an equation that depends on others there.
    `closures`: the closures of the tree as a square system.
    """
    builder = KernelBuilder(
        system.model.symbols,
        "compute_body_motion",
        [
            "Accelerations a of the tree's coordinates q with rates v, and with them the motion of all bodies:",
            "all_q, all_v, all_a (N_Q). `worst`: the largest |Phi_q v - nu|.",
            "Returns 0, or the number of a row that depends on others here; all_q and all_v are written also then.",
        ],
    )
    bodies = system.model.bodies
    builder.begin_section("positions and velocities of the bodies")
    for body in bodies:
        for k, (q, v) in enumerate(zip(body.q, body.v, strict=True), body.index):
            builder.append_store(StorageLocation("all_q")[k], q)
            builder.append_store(StorageLocation("all_v")[k], v)
    builder.begin_section("rates of the closures")
    named_rows = zip(closures.names, system.rows, strict=True)
    phi_dot = [builder.append_local(f"phi_dot_{name}", row.phi_q_v - row.nu) for name, row in named_rows]
    builder.append_instruction(MaxMagnitude("worst", tuple(phi_dot)))
    solvers = closures.factorize(builder)
    builder.begin_section("accelerations")
    a = closures.solve(builder, solvers, [row.gamma for row in system.rows], "second")
    for k, value in enumerate(a):
        builder.append_store(StorageLocation("a")[k], value)
    for body in bodies:
        motion = system.motions[body.name]
        for k, (row_entries, bias) in enumerate(zip(motion.jacobian, motion.bias, strict=True), body.index):
            builder.append_store(
                StorageLocation("all_a")[k], sp.Add(bias, *(entry * a[j] for j, entry in row_entries.items()))
            )
    builder.append_instruction(Return())
    outs = (make_output_argument(name) for name in ("a", "all_q", "all_v", "all_a", "worst"))
    return builder.build_kernel((*STATE, PARAMETERS, *outs), status=True)

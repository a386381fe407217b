"""Projection of states onto the constraints: smallest changes of positions and velocities in the norm of M."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from gudgeon.generator.equations.constraints import Row, has_jumping_rate
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder, declare_branches
from gudgeon.generator.ir.signatures import DISCRETE, PARAMETERS, STATE, make_input_argument, make_output_argument
from gudgeon.generator.ir.statements import MaxMagnitude, Return
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.solvers.pivots import RUN_VANISHING
from gudgeon.generator.symbols.derivatives import find_symbols
from gudgeon.generator.symbols.storage import StorageLocation

MIN_MASS_FRACTION = 1e-4  # of the mass of all bodies: the least that a body counts in projections
FILM_MASS_FACTOR = 1e6  # times the mass of all bodies: what projections give to motions that squeeze a film


def make_projection_kernel(system: System, rows: tuple[Row, ...], name: str) -> tuple[Kernel, KKT]:
    """Return the kernel of x = M⁻¹Φ_qᵀ(Φ_q M⁻¹Φ_qᵀ)⁻¹ r, and the KKT elimination that it prints.

    x is the smallest in the metric of M with Φ_q x = r. `rows`: the equations; `name`: the function's name. The
    argument r has all equations of the closed linkage; those that are not in `rows` are ignored. In M, light bodies
    count with a least mass (`raise_small_masses`).
    """
    system = raise_small_masses(system)
    model, kkt = system.model, KKT(system, rows)
    builder = KernelBuilder(
        model.symbols,
        name,
        [
            "The smallest x (n) in the metric of M with Phi_q x = r, for Newton's step and velocities. r has all rows",
            "of the closed linkage; those of open joints and redundant ones are ignored.",
            "Returns 0, or the number of the pivot that vanished.",
        ],
    )
    builder.begin_section("right-hand side")
    row_index = {row.name: k for k, row in enumerate(model.all_rows)}
    r = {
        kkt.n + k: builder.append_local(f"r_{row.name.replace('.', '_')}", StorageLocation("r")[row_index[row.name]])
        for k, row in enumerate(kkt.rows)
    }
    x = kkt.solve(builder, kkt.factorize(builder), r, "step_")
    builder.begin_section("results")
    for k, _ in enumerate(system.q):
        builder.append_store(StorageLocation("x")[k], x[k])
    builder.append_instruction(Return())
    arguments = (*STATE[:2], make_input_argument("r"), PARAMETERS, make_output_argument("x"))
    return builder.build_kernel(arguments, status=True), kkt


def add_eccentricity_weights(system: System) -> System:
    """Return the system with the mass matrix M + κ Σ BᵀB for projections, B = ∂e/∂q of each joint with a film.

    κ is FILM_MASS_FACTOR times the mass of all bodies. Without films or equations the system itself is returned.
    """
    model = system.model
    films = [clearance for clearance in model.clearances if clearance.film is not None]
    if not films or not system.rows:
        return system
    kappa = model.parameter_table.derive_parameter(
        "film_mass", FILM_MASS_FACTOR * sp.Add(*(body.mass for body in model.bodies)), "of projections"
    )
    mass = dict(system.mass)
    for film in films:
        for unit_force in ((sp.S.One, sp.S.Zero), (sp.S.Zero, sp.S.One)):
            row, _ = system.compute_generalized_forces(film.list_point_loads(unit_force, (sp.S.Zero, sp.S.Zero)))
            for i, factor_i in enumerate(row):
                for j, factor_j in enumerate(row[: i + 1]):
                    if factor_i != 0 and factor_j != 0:
                        mass[i, j] = mass.get((i, j), sp.S.Zero) + kappa * factor_i * factor_j
    return replace(system, mass=mass)


def raise_small_masses(system: System) -> System:
    """Return the system with masses raised to at least MIN_MASS_FRACTION of the mass of all bodies, for projections.

    Each diagonal entry of M is raised to this mass times `compute_inertia_of_unit_mass`. In the metric of M the
    equations of both joints of a light body nearly depend on each other; constraint errors may be measured in any
    positive definite metric. Larger entries stay exactly the same, and entries that are not constant are not raised. A
    system with a drive whose rate jumps is returned unchanged: its projection is an impulse, which needs M.
    """
    model, derive = system.model, system.model.parameter_table.derive_parameter
    if any(has_jumping_rate(drive) for drive in model.scene.mechanism.drives.values()):
        return system
    # one symbol for the sum: SymPy compares the arguments of each Max by factoring them
    min_body_mass = MIN_MASS_FRACTION * derive(
        "mass_of_all", sp.Add(*(body.mass for body in model.bodies)), "of projections"
    )
    mass = dict(system.mass)
    for k, q in enumerate(system.q):
        mass_entry, min_mass = mass[k, k], min_body_mass * system.compute_inertia_of_unit_mass(k)
        if min_mass != 0 and model.parameter_table.is_constant(mass_entry):
            name = f"{'tree_' if system.in_tree else ''}metric_{q.name}"
            # SymPy cannot compare a mass with the sum of all masses, a symbol, and spends long on trying it
            is_undecided = not find_symbols(min_body_mass) <= find_symbols(mass_entry)
            is_undecided = is_undecided and not mass_entry.has(sp.Max, sp.Min)
            mass[k, k] = derive(name, sp.Max(mass_entry, min_mass, evaluate=not is_undecided), "of projections")
            model.parameter_table.internal_parameters.add(mass[k, k])
    return replace(system, mass=mass)


def make_constraint_correction_kernel(system: System, name: str = "compute_closure_step") -> Kernel:
    """Return the kernel of one Newton step dq onto Φ = 0 and one step dv onto Φ̇ = 0, both to be subtracted.

    Both use one factorization. Small masses are raised (`raise_small_masses`), and motions that squeeze a film are
    weighted with a large mass (`add_eccentricity_weights`), so that e and ė nearly keep their values. `name`: the
    function's name.
    """
    metric_system = raise_small_masses(system)
    kkt = KKT(add_eccentricity_weights(metric_system), system.rows)
    film_comment = (
        []
        if kkt.system is metric_system
        else ["Motions that squeeze a film have 1e6 times the mass of all bodies in M."]
    )
    builder = KernelBuilder(
        system.model.symbols,
        name,
        [
            "The smallest dq and dv (n) in the metric of M with Phi_q dq = Phi and Phi_q dv = Phi_dot; to subtract.",
            *film_comment,
            "`worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.",
        ],
    )
    builder.begin_section("Phi and Phi_dot")
    phi, phi_dot = {}, {}
    for r, row in enumerate(kkt.rows):
        row_name = row.name.replace(".", "_")
        phi[kkt.n + r] = builder.append_local(f"phi_{row_name}", row.phi)
        phi_dot[kkt.n + r] = builder.append_local(f"phi_dot_{row_name}", row.phi_q_v - row.nu)
    factor = kkt.factorize(
        builder, threshold=RUN_VANISHING, pair_threshold=RUN_VANISHING
    )  # nearer, rounding would be blown up
    x, velocity_step = kkt.solve(builder, factor, phi, "dq_"), kkt.solve(builder, factor, phi_dot, "dv_")
    builder.begin_section("results")
    for k, _ in enumerate(system.q):
        builder.append_store(StorageLocation("dq")[k], x[k])
        builder.append_store(StorageLocation("dv")[k], velocity_step[k])
    builder.append_instruction(MaxMagnitude("worst", tuple(phi.values())))
    builder.append_instruction(Return())
    outs = (make_output_argument(name) for name in ("dq", "dv", "worst"))
    # a switching function of lengths and parameters alone is not an event function, so its branch is not held
    kernel = builder.build_kernel((*STATE, DISCRETE, PARAMETERS, *outs), status=True, owner="", registered_only=True)
    return declare_branches(kernel)

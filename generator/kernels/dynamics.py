"""The right-hand side of a scene: accelerations and multipliers from the KKT system, as one straight-line function."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence

import sympy as sp

from gudgeon.generator.equations.contact_points import Wall
from gudgeon.generator.equations.loads import PointLoad
from gudgeon.generator.equations.model import Model, derive_stick_baumgarte_gain
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.branches import ReturnIfOnlyJoints
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder, declare_branches
from gudgeon.generator.ir.signatures import (
    DISCRETE,
    PARAMETERS,
    RHS,
    STATE,
    ZERO,
    make_contact_arguments,
    make_output_argument,
)
from gudgeon.generator.ir.statements import Call, Jump, Return, SolveDependentRows, Statement, Status, When
from gudgeon.generator.ir.values import Sum, Test
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.solvers.pivots import RUN_SINGULAR, RUN_VANISHING, append_friction_mode
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol

_DOC = (
    "Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from",
    "[M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).",
    "Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.",
)
_MAX_PIVOTS = 60  # listed in the comment
# Appends what solves the system where a pivot vanishes, to the kernel under construction.
AppendFallback = Callable[[KernelBuilder], None]


def make_dynamics_kernel(
    system: System,
    kkt: KKT,
    name: str = "dynamics",
    doc: Sequence[str] = _DOC,
    is_stabilized: bool = True,
    append_fallback: AppendFallback | None = None,
) -> Kernel:
    """Return the kernel of the right-hand side: q̈ and λ at a state, with the forces of joints with play.

    `kkt`: the elimination to print; `doc`: the function's comment. `append_fallback` appends the code for a vanishing
    pivot; None: the default, which finds the dependent equations. With `is_stabilized` Baumgarte's terms are added to
    γ; without, Φ and Φ̇ are not computed: for methods that project. With dry friction or rigid contacts a vanishing
    pivot is reported and `append_fallback` is not called.
    """
    model = system.model
    builder = KernelBuilder(model.symbols, name, (*doc, *describe_elimination(kkt)))
    if kkt.rows and not model.has_intermittent_constraints:
        builder.begin_section("status")
        builder.append_instruction(Status())
    _append_event_functions(model, builder)
    loads = [load for element in model.elements.values() for load in element.list_point_loads()]
    for index, clearance in enumerate(model.clearances):
        loads += _append_clearance_call(builder, index, clearance)
    if model.clearances and not is_stabilized:
        builder.begin_section("if a is NULL, only the joints with play are evaluated")
        builder.append_instruction(ReturnIfOnlyJoints())
    generalized_loads, prescribed_forces = system.compute_generalized_forces(loads)
    forces = [applied_force + load for applied_force, load in zip(system.applied, generalized_loads, strict=True)]
    stick_rhs = _append_slip_velocities(model, builder, kkt, forces)
    b: dict[int, sp.Expr] = {k: f for k, f in enumerate(forces) if f != 0}
    b.update(_append_constraint_rhs(model, builder, kkt, is_stabilized))
    b.update(stick_rhs)
    # with changing constraints a vanishing pivot is reported, not handled
    factor = (
        kkt.factorize(builder)
        if model.has_intermittent_constraints
        else kkt.factorize(builder, True, RUN_SINGULAR, RUN_VANISHING)
    )
    x = kkt.solve(builder, factor, b)
    builder.begin_section("results")
    for k, _ in enumerate(system.q):
        builder.append_store(StorageLocation("a")[k], x[k])
    for r, _ in enumerate(kkt.rows):
        builder.append_store(RHS["lambda"][r], x[kkt.n + r])
    _append_friction_forces(builder, kkt, x)
    _append_rigid_contact_accelerations(builder, kkt.system, x)
    if kkt.rows and not model.has_intermittent_constraints:
        if append_fallback:
            append_fallback(builder)
        else:
            _append_redundancy_handling(builder, kkt, b)
    _append_powers(builder, kkt, prescribed_forces)
    builder.append_instruction(Return(pivot=bool(kkt.rows and not model.has_intermittent_constraints)))
    arguments = (*STATE, DISCRETE, PARAMETERS, make_output_argument("a"), RHS)
    kernel = builder.build_kernel(arguments, status=True, owner="")
    return declare_branches(kernel, "rhs")


def describe_elimination(kkt: KKT) -> list[str]:
    """Return comment lines that name the unknowns in the order in which the pivots eliminate them.

    An unknown is an acceleration, by its coordinate, or a multiplier, by its constraint equation. Two unknowns with
    one 2 × 2 pivot are joined by "with". At most `_MAX_PIVOTS` pivots are listed; without pivots the list is empty.
    """
    names = [format_coordinate_name(kkt.system.model.symbols.info[q].meaning) for q in kkt.system.q]
    names += [f"lambda of {row.name}" for row in kkt.rows] + [
        f"lambda of {friction.name}" for friction in kkt.frictions
    ]
    blocks = [" with ".join(names[k] for k in block) for block in kkt.blocks]
    remainder = [f"and {len(blocks) - _MAX_PIVOTS} more"] if len(blocks) > _MAX_PIVOTS else []
    text = "; ".join(name_list.replace(" ", "\0") for name_list in (*blocks[:_MAX_PIVOTS], *remainder))
    heading = "Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:"
    return [heading, *("    " + line.replace("\0", " ") for line in textwrap.wrap(f"{text}.", 104))] if blocks else []


def format_coordinate_name(name_in_symbol_table: str) -> str:
    """Return the name of a coordinate for comments: "rod.x" unchanged, "rod" (a tree coordinate) as "rod.theta".

    `name_in_symbol_table`: the name under which the symbol table stores the coordinate.
    """
    return name_in_symbol_table if "." in name_in_symbol_table else f"{name_in_symbol_table}.theta"


def _append_event_functions(model: Model, builder: KernelBuilder) -> None:
    """Append the user's event functions, written to `rhs` at every state, also where a pivot vanishes later."""
    if model.events:
        builder.begin_section("events")
    for index, event in enumerate(model.events):
        builder.append_store(RHS["event"][index], event.expression, event.name)


def _append_clearance_call(builder: KernelBuilder, index: int, clearance: Clearance) -> list[PointLoad]:
    """Append the call of the force function of joint `index` with play and its power; return the loads on both bodies.

    They are the force and the moments that the call returns; a moment on the ground is 0.
    """
    name, out = clearance.label, RHS["clearance"][index]
    builder.begin_section(f"clearance {clearance.kind} {clearance.name}")
    e = [
        builder.append_local(f"e_{name}_{axis}", value)
        for axis, value in zip("xy", clearance.eccentricity, strict=True)
    ]
    edot = [
        builder.append_local(f"edot_{name}_{axis}", value)
        for axis, value in zip("xy", clearance.eccentricity_rate, strict=True)
    ]
    arguments = (clearance.first.omega, clearance.second.omega, *clearance.surface_arguments)
    builder.append_instruction(
        Call(f"clearance_{name}_", (*e, *edot, *arguments, *make_contact_arguments(index)), (out,))
    )
    F = [builder.append_local(f"F_{name}_{axis}", out[f"F{axis}"]) for axis in "xy"]
    moments = [
        ZERO if point.body is None else builder.append_local(f"M_{name}_{body_role}", out[f"moment_{body_role}"])
        for point, body_role in ((clearance.first, "first"), (clearance.second, "second"))
    ]
    builder.append_store(out["power"], clearance.compute_power(F, edot, moments))
    return clearance.list_point_loads(F, moments)


def _append_constraint_rhs(model: Model, builder: KernelBuilder, kkt: KKT, is_stabilized: bool) -> dict[int, sp.Expr]:
    """Return the right-hand side γ − 2αΦ̇ − β²Φ of each constraint equation; append its statements.

    Keys are the equations' numbers in the KKT matrix, after the n coordinates. Φ and Φ̇ are also written to `rhs`, for
    diagnostics. Without `is_stabilized` the right-hand side is γ and nothing else is computed.
    """
    if not is_stabilized:
        if kkt.rows:
            builder.begin_section("constraints: gamma")
        named_rhs = (builder.append_local(f"rhs_{row.name.replace('.', '_')}", row.gamma) for row in kkt.rows)
        return {kkt.n + index: rhs for index, rhs in enumerate(named_rhs)}
    alpha, beta = model.baumgarte
    two_alpha = model.parameter_table.derive_parameter("two_alpha", 2 * alpha, "2 alpha")
    beta_squared = model.parameter_table.derive_parameter("beta_squared", beta**2, "beta^2")
    rhs: dict[int, sp.Expr] = {}
    if kkt.rows:
        builder.begin_section("constraints: Phi, Phi_dot = Phi_q v - nu, gamma")
    for index, row in enumerate(kkt.rows):
        name = row.name.replace(".", "_")
        phi = builder.append_local(f"phi_{name}", row.phi)
        phi_dot = builder.append_local(f"phi_dot_{name}", row.phi_q_v - row.nu)
        rhs[kkt.n + index] = builder.append_local(f"rhs_{name}", row.gamma - two_alpha * phi_dot - beta_squared * phi)
        builder.append_store(RHS["phi"][index], phi)
        builder.append_store(RHS["phi_dot"][index], phi_dot)
    return rhs


def _append_slip_velocities(
    model: Model, builder: KernelBuilder, kkt: KKT, forces: list[sp.Expr]
) -> dict[int, sp.Expr]:
    """Append slip velocity, kinetic force and static limit of each friction element; return right-hand sides for stick.

    These are γ − 2α v by the element's number in the KKT matrix. The kinetic force is added to `forces`, the
    generalized forces by coordinate, in place; it is 0 at stick. Also sets `kkt.stick_symbols`.
    """
    stick_rhs: dict[int, sp.Expr] = {}
    if kkt.frictions:
        builder.begin_section("friction: slip, or stick as a constraint equation")
    coordinate_index = {q: k for k, q in enumerate(kkt.system.q)}
    two_alpha = derive_stick_baumgarte_gain(model) if kkt.frictions else ZERO
    for index, friction in enumerate(kkt.frictions):
        name, node = friction.name, kkt.first_friction + index
        v = builder.append_local(f"slip_{name}", friction.slip.v)
        kkt.stick_symbols[node], sign = append_friction_mode(builder, name, index)
        force = builder.append_local(f"kinetic_{name}", -sign * friction.slip.evaluate_kinetic_force(v))
        for q, entry in friction.jacobian.items():
            forces[coordinate_index[q]] += entry * force
        stick_rhs[node] = builder.append_local(f"rhs_{name}", friction.gamma - two_alpha * v)
        for key, value in (("v", v), ("static_limit", friction.slip.static), ("speed", friction.slip.speed)):
            builder.append_store(RHS["friction"][index][key], value)
        builder.append_store(RHS["friction"][index]["force"], force)
    return stick_rhs


def _append_friction_forces(builder: KernelBuilder, kkt: KKT, solution: dict[int, sp.Expr]) -> None:
    """Append the force −λ of each friction element that sticks, and the rate of slip J q̈ − γ of each element.

    `solution`: accelerations and multipliers by number in the KKT matrix (coordinates, equations, frictions).
    """
    coordinate_index = {q: k for k, q in enumerate(kkt.system.q)}
    for index, friction in enumerate(kkt.frictions):
        rate = sum((entry * solution[coordinate_index[q]] for q, entry in friction.jacobian.items()), -friction.gamma)
        builder.append_store(RHS["friction"][index]["rate"], rate)
        stick = kkt.stick_symbols[kkt.first_friction + index]
        target = RHS["friction"][index]["force"]
        force = Statement(target, -solution[kkt.first_friction + index], f"stick of {friction.name}")
        builder.append_instruction(When(Test(stick, "!=", (0.0,)), force))


def _append_rigid_contact_accelerations(
    builder: KernelBuilder, system: System, solution: Mapping[int, sp.Expr]
) -> None:
    """Append half the second derivative of e · e, which is e · ë + ė · ė, for joints with rigid surfaces; at a wall δ̈.

    A run determines the contact forces of these joints from it. `solution`: accelerations and multipliers by number in
    the KKT matrix; only the accelerations are read.
    """
    for index, clearance in enumerate(system.model.clearances):
        if clearance.rigid and clearance.wall:
            acceleration = _compute_wall_penetration_acceleration(system, clearance, clearance.wall, solution)
            builder.append_store(
                RHS["clearance"][index]["half_square_second_derivative"], acceleration, "at a wall delta'' itself"
            )
        elif clearance.rigid:
            journal_acceleration, bearing_acceleration = (
                system.compute_acceleration(point, solution) for point in (clearance.second, clearance.first)
            )
            e, edot = clearance.eccentricity, clearance.eccentricity_rate
            value = sp.Add(
                *(e[i] * (journal_acceleration[i] - bearing_acceleration[i]) + edot[i] ** 2 for i in range(2))
            )
            builder.append_store(RHS["clearance"][index]["half_square_second_derivative"], value, "e . e'' + e' . e'")


def _compute_wall_penetration_acceleration(
    system: System, clearance: Clearance, wall: Wall, solution: Mapping[int, sp.Expr]
) -> sp.Expr:
    """Return δ̈ at a wall of a guide, from the accelerations in `solution` by number of the coordinate.

    δ̈ = ë · n + ω̇_i along + 2 ω_i ė · t − ω_i² e · n, from δ̇ = ė · n + ω_i e · t. n is the wall's outward normal, t =
    n turned by +90°, along = e · t.
    """
    journal_acceleration, bearing_acceleration = (
        system.compute_acceleration(point, solution) for point in (clearance.second, clearance.first)
    )
    (n_x, n_y), e, edot = wall.normal, clearance.eccentricity, clearance.eccentricity_rate
    omega, angular_acceleration = clearance.first.omega, system.compute_angular_acceleration(clearance.first, solution)
    lever_arm, tangential_rate = e[1] * n_x - e[0] * n_y, edot[1] * n_x - edot[0] * n_y
    linear_acceleration = (journal_acceleration[0] - bearing_acceleration[0]) * n_x + (
        journal_acceleration[1] - bearing_acceleration[1]
    ) * n_y
    return (
        linear_acceleration
        + angular_acceleration * lever_arm
        + omega * (2 * tangential_rate - omega * (e[0] * n_x + e[1] * n_y))
    )


def _append_redundancy_handling(builder: KernelBuilder, kkt: KKT, right_sides: Mapping[int, sp.Expr]) -> None:
    """Append the label and the code for a vanishing pivot, which calls engine/scene/singular.c.

    There constraint equations depend on each other. Nothing is appended if no pivot may jump there. `right_sides`:
    generalized forces and right-hand sides of equations, by number in the KKT matrix.
    """
    if not builder.has_jumps:
        return
    builder.append_instruction(Jump())
    builder.begin_section("a pivot vanished: constraint equations depend on each other here")
    force, rhs = (
        tuple(right_sides.get(k, ZERO) for k in nodes) for nodes in (range(kkt.n), range(kkt.n, kkt.n + len(kkt.rows)))
    )
    builder.append_instruction(SolveDependentRows(force, rhs))


def _append_powers(builder: KernelBuilder, kkt: KKT, prescribed_forces: Mapping[str, sp.Expr]) -> None:
    """Append the powers in W of all drives, all force elements with their friction, and joints with play to `rhs`.

    A drive does −λᵀν, and in addition the power that inertia and loads need at a coordinate that it prescribes.
    `prescribed_forces`: the generalized loads on those coordinates by name.
    """
    model = kkt.system.model
    multipliers = {r: StoredSymbol(RHS["lambda"][r]) for r, row in enumerate(kkt.rows) if row.nu != 0}
    drive_power = sp.Add(*(-multiplier * kkt.rows[r].nu for r, multiplier in multipliers.items()))
    for prescribed in kkt.system.prescribed:
        effort = (
            sp.Add(*(m * StoredSymbol(StorageLocation("a")[k]) for k, m in prescribed.mass.items()))
            - prescribed.applied
        )
        for r, friction in enumerate(kkt.frictions):
            force = StoredSymbol(RHS["friction"][r]["force"])
            effort -= model.symbols.differentiate_definitions(friction.slip.v, prescribed.rate) * force
        drive_power += prescribed.rate * (effort - prescribed_forces.get(prescribed.name, ZERO))
    clearances = tuple(RHS["clearance"][i]["power"] for i in range(len(model.clearances)))
    builder.append_store(RHS["power"][0], drive_power)
    friction_symbols = [
        [StoredSymbol(RHS["friction"][r][field]) for field in ("force", "v", "speed")]
        for r in range(len(kkt.frictions))
    ]
    friction = sp.Add(*(force * (v + speed) for force, v, speed in friction_symbols))
    builder.append_store(
        RHS["power"][1], sp.Add(*(element.loads.power for element in model.elements.values())) + friction
    )
    builder.append_store(RHS["power"][2], Sum(clearances) if clearances else ZERO)

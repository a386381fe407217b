"""The right-hand side of a scene: accelerations and multipliers from the KKT system, as one straight-line function."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence

import sympy as sp

from gudgeon.generator.equations.contact_points import Wall
from gudgeon.generator.equations.loads import PointLoad
from gudgeon.generator.equations.model import Model, stick_gain
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.branches import JointsAlone
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder, declare_branches
from gudgeon.generator.ir.signatures import DISCRETE, PARAMETERS, RHS, STATE, ZERO, acting_on, result
from gudgeon.generator.ir.statements import Call, Jump, Rescue, Return, Statement, Status, When
from gudgeon.generator.ir.values import Sum, Test
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.solvers.pivots import LEAST, LEAST_SIZE, friction_mode
from gudgeon.generator.symbols.storage import Place, PlaceSymbol

_DOC = (
    "Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from",
    "[M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).",
    "Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.",
)
_MAX_PIVOTS = 60  # listed in the comment
# Appends what solves the system where a pivot vanishes, from generalized forces and right-hand sides by node.
OnDependence = Callable[[KernelBuilder, KKT, Mapping[int, sp.Expr]], None]


def dynamics_kernel(
    system: System,
    kkt: KKT,
    name: str = "dynamics",
    doc: Sequence[str] = _DOC,
    stabilised: bool = True,
    rescue: OnDependence | None = None,
) -> Kernel:
    """Return the C function of q̈ and λ at a state, with the forces of joints with play.

    `kkt`: the factorization to print; `rescue`: prints what is solved where a pivot vanishes.
    Without `stabilised` the right-hand sides are γ alone and Φ, Φ̇ are not computed: for methods that project.
    """
    model = system.model
    build = KernelBuilder(model.symbols, name, (*doc, *elimination_lines(kkt)))
    if kkt.rows and not model.has_changing_constraints:
        build.section("status")
        build.line(Status())
    _append_events(model, build)
    loads = [load for element in model.elements.values() for load in element.on_points()]
    for index, clearance in enumerate(model.clearances):
        loads += _append_clearance_call(build, index, clearance)
    if model.clearances and not stabilised:
        build.section("if a is NULL, only the joints with play are evaluated")
        build.line(JointsAlone())
    acting, on_given = system.generalized(loads)
    forces = [own + load for own, load in zip(system.applied, acting, strict=True)]
    slips = _append_slips(model, build, kkt, forces)
    b: dict[int, sp.Expr] = {k: f for k, f in enumerate(forces) if f != 0}
    b.update(_constraint_rhs(model, build, kkt, stabilised))
    b.update(slips)
    # with changing constraints a vanishing pivot is reported, not handled
    factor = kkt.factorize(build) if model.has_changing_constraints else kkt.factorize(build, True, LEAST, LEAST_SIZE)
    x = kkt.solve(build, factor, b)
    build.section("results")
    for k, _ in enumerate(system.q):
        build.out(Place("a")[k], x[k])
    for r, _ in enumerate(kkt.rows):
        build.out(RHS["lambda"][r], x[kkt.n + r])
    _append_friction_forces(build, kkt, x)
    _append_half_squares(build, kkt.system, x)
    if kkt.rows and not model.has_changing_constraints:
        (rescue or _append_dependent_rows)(build, kkt, b)
    _append_powers(build, kkt, on_given)
    build.line(Return(pivot=bool(kkt.rows and not model.has_changing_constraints)))
    arguments = (*STATE, DISCRETE, PARAMETERS, result("a"), RHS)
    kernel = build.build(arguments, status=True, owner="")
    return declare_branches(kernel, "rhs")


def elimination_lines(kkt: KKT) -> list[str]:
    """Return comment lines that name the unknowns in the order in which the pivots eliminate them.

    An unknown is an acceleration, by its coordinate, or a multiplier, by its constraint equation.
    """
    names = [coordinate_name(kkt.system.model.symbols.info[q].meaning) for q in kkt.system.q]
    names += [f"lambda of {row.name}" for row in kkt.rows] + [
        f"lambda of {friction.name}" for friction in kkt.frictions
    ]
    blocks = [" with ".join(names[k] for k in block) for block in kkt.blocks]
    more = [f"and {len(blocks) - _MAX_PIVOTS} more"] if len(blocks) > _MAX_PIVOTS else []
    listed = "; ".join(one.replace(" ", "\0") for one in (*blocks[:_MAX_PIVOTS], *more))
    head = "Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:"
    return [head, *("    " + line.replace("\0", " ") for line in textwrap.wrap(f"{listed}.", 104))] if blocks else []


def coordinate_name(meaning: str) -> str:
    """Return the name of a coordinate for comments: an angle of a tree has that of its body alone."""
    return meaning if "." in meaning else f"{meaning}.theta"


def _append_events(model: Model, build: KernelBuilder) -> None:
    """Append the user's event functions, which are known at every state, also where a pivot vanishes."""
    if model.events:
        build.section("events")
    for index, event in enumerate(model.events):
        build.out(RHS["event"][index], event.expression, event.name)


def _append_clearance_call(build: KernelBuilder, index: int, clearance: Clearance) -> list[PointLoad]:
    """Append the call of a joint's force function; return its force and moments as loads on both bodies."""
    name, out = clearance.label, RHS["clearance"][index]
    build.section(f"clearance {clearance.kind} {clearance.name}")
    e = [build.local(f"e_{name}_{axis}", value) for axis, value in zip("xy", clearance.eccentricity, strict=True)]
    edot = [
        build.local(f"edot_{name}_{axis}", value) for axis, value in zip("xy", clearance.eccentricity_rate, strict=True)
    ]
    given = (clearance.first.omega, clearance.second.omega, *clearance.also)
    build.line(Call(f"clearance_{name}_", (*e, *edot, *given, *acting_on(index)), (out,)))
    F = [build.local(f"F_{name}_{axis}", out[f"F{axis}"]) for axis in "xy"]
    moments = [
        ZERO if point.body is None else build.local(f"M_{name}_{which}", out[f"moment_{which}"])
        for point, which in ((clearance.first, "first"), (clearance.second, "second"))
    ]
    build.out(out["power"], clearance.power(F, edot, moments))
    return clearance.on_points(F, moments)


def _constraint_rhs(model: Model, build: KernelBuilder, kkt: KKT, stabilised: bool) -> dict[int, sp.Expr]:
    """Return the right-hand side γ − 2αΦ̇ − β²Φ of each constraint equation, by node of the KKT matrix.

    Φ and Φ̇ are also written to `rhs`, for diagnostics. Without `stabilised` the right-hand side is γ.
    """
    if not stabilised:
        if kkt.rows:
            build.section("constraints: gamma")
        named = (build.local(f"rhs_{row.name.replace('.', '_')}", row.gamma) for row in kkt.rows)
        return {kkt.n + r: rhs for r, rhs in enumerate(named)}
    alpha, beta = model.baumgarte
    two_alpha = model.slots.derive("two_alpha", 2 * alpha, "2 alpha")
    beta_squared = model.slots.derive("beta_squared", beta**2, "beta^2")
    rhs: dict[int, sp.Expr] = {}
    if kkt.rows:
        build.section("constraints: Phi, Phi_dot = Phi_q v - nu, gamma")
    for r, row in enumerate(kkt.rows):
        name = row.name.replace(".", "_")
        phi = build.local(f"phi_{name}", row.phi)
        phi_dot = build.local(f"phi_dot_{name}", row.phi_q_v - row.nu)
        rhs[kkt.n + r] = build.local(f"rhs_{name}", row.gamma - two_alpha * phi_dot - beta_squared * phi)
        build.out(RHS["phi"][r], phi)
        build.out(RHS["phi_dot"][r], phi_dot)
    return rhs


def _append_slips(model: Model, build: KernelBuilder, kkt: KKT, forces: list[sp.Expr]) -> dict[int, sp.Expr]:
    """Append the slip velocity and kinetic force of each dry friction element; return the right-hand sides for stick.

    The kinetic force is added to `forces`, the generalized forces by coordinate, in place.
    """
    rhs: dict[int, sp.Expr] = {}
    if kkt.frictions:
        build.section("friction: slip, or stick as a constraint equation")
    place = {q: k for k, q in enumerate(kkt.system.q)}
    two_alpha = stick_gain(model) if kkt.frictions else ZERO
    for r, friction in enumerate(kkt.frictions):
        name, node = friction.name, kkt.first_friction + r
        v = build.local(f"slip_{name}", friction.slip.v)
        kkt.sticks[node], sign = friction_mode(build, name, r)
        force = build.local(f"kinetic_{name}", -sign * friction.slip.kinetic_at(v))
        for q, entry in friction.jacobian.items():
            forces[place[q]] += entry * force
        rhs[node] = build.local(f"rhs_{name}", friction.gamma - two_alpha * v)
        for key, value in (("v", v), ("static_limit", friction.slip.static), ("speed", friction.slip.speed)):
            build.out(RHS["friction"][r][key], value)
        build.out(RHS["friction"][r]["force"], force)
    return rhs


def _append_friction_forces(build: KernelBuilder, kkt: KKT, x: dict[int, sp.Expr]) -> None:
    """Append the force of each friction element at stick, −λ of its equation, and the rate of slip J q̈ − γ."""
    place = {q: k for k, q in enumerate(kkt.system.q)}
    for r, friction in enumerate(kkt.frictions):
        rate = sum((entry * x[place[q]] for q, entry in friction.jacobian.items()), -friction.gamma)
        build.out(RHS["friction"][r]["rate"], rate)
        stick = kkt.sticks[kkt.first_friction + r]
        target = RHS["friction"][r]["force"]
        force = Statement(target, -x[kkt.first_friction + r], f"stick of {friction.name}")
        build.line(When(Test(stick, "!=", (0.0,)), force))


def _append_half_squares(build: KernelBuilder, system: System, x: Mapping[int, sp.Expr]) -> None:
    """Append half the second derivative of e · e in joints with rigid surfaces.

    A run determines the contact forces of these joints from it.
    """
    for index, clearance in enumerate(system.model.clearances):
        if clearance.rigid and clearance.wall:
            outward = _outward_rate(system, clearance, clearance.wall, x)
            build.out(RHS["clearance"][index]["half_square_rate"], outward, "at a wall delta'' itself")
        elif clearance.rigid:
            second, first = (system.acceleration(point, x) for point in (clearance.second, clearance.first))
            e, edot = clearance.eccentricity, clearance.eccentricity_rate
            half = sp.Add(*(e[i] * (second[i] - first[i]) + edot[i] ** 2 for i in range(2)))
            build.out(RHS["clearance"][index]["half_square_rate"], half, "e . e'' + e' . e'")


def _outward_rate(system: System, clearance: Clearance, wall: Wall, x: Mapping[int, sp.Expr]) -> sp.Expr:
    """Return δ̈ at a wall of a guide: ë · n + ω̇_i along + 2 ω_i ė · t − ω_i² e · n, from δ̇ = ė · n + ω_i e · t."""
    second, first = (system.acceleration(point, x) for point in (clearance.second, clearance.first))
    (n_x, n_y), e, edot = wall.normal, clearance.eccentricity, clearance.eccentricity_rate
    omega, turning = clearance.first.omega, system.turning(clearance.first, x)
    along, sliding = e[1] * n_x - e[0] * n_y, edot[1] * n_x - edot[0] * n_y
    straight = (second[0] - first[0]) * n_x + (second[1] - first[1]) * n_y
    return straight + turning * along + omega * (2 * sliding - omega * (e[0] * n_x + e[1] * n_y))


def _append_dependent_rows(build: KernelBuilder, kkt: KKT, b: Mapping[int, sp.Expr]) -> None:
    """Append the branch for a vanishing pivot, which calls engine/scene/singular.c; none if all pivots are constant."""
    if not build.has_jumps:
        return
    build.line(Jump())
    build.section("a pivot vanished: constraint equations depend on each other here")
    force, rhs = (tuple(b.get(k, ZERO) for k in nodes) for nodes in (range(kkt.n), range(kkt.n, kkt.n + len(kkt.rows))))
    build.line(Rescue(force, rhs))


def _append_powers(build: KernelBuilder, kkt: KKT, on_given: Mapping[str, sp.Expr]) -> None:
    """Append the powers in W of the drives, of the dissipative force elements and of the joints with play.

    A drive does −λᵀν, and in addition the power that inertia and loads need at a coordinate that it prescribes.
    """
    model = kkt.system.model
    multipliers = {r: PlaceSymbol(RHS["lambda"][r]) for r, row in enumerate(kkt.rows) if row.nu != 0}
    drives = sp.Add(*(-multiplier * kkt.rows[r].nu for r, multiplier in multipliers.items()))
    for given in kkt.system.given:
        needed = sp.Add(*(m * PlaceSymbol(Place("a")[k]) for k, m in given.mass.items())) - given.applied
        for r, friction in enumerate(kkt.frictions):
            force = PlaceSymbol(RHS["friction"][r]["force"])
            needed -= model.symbols.written_out(friction.slip.v, given.rate) * force
        drives += given.rate * (needed - on_given.get(given.name, ZERO))
    clearances = tuple(RHS["clearance"][i]["power"] for i in range(len(model.clearances)))
    build.out(RHS["power"][0], drives)
    rubs = [
        [PlaceSymbol(RHS["friction"][r][what]) for what in ("force", "v", "speed")] for r in range(len(kkt.frictions))
    ]
    friction = sp.Add(*(force * (v + speed) for force, v, speed in rubs))
    build.out(RHS["power"][1], sp.Add(*(element.loads.power for element in model.elements.values())) + friction)
    build.out(RHS["power"][2], Sum(clearances) if clearances else ZERO)

"""Functions of the reduced equations: right-hand side in tree coordinates, conversion to and from absolute ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.fields import JointFields
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder, remove_unused_locals
from gudgeon.generator.ir.signatures import PARAMETERS, STATE, Argument, make_input_argument, make_output_argument
from gudgeon.generator.ir.statements import Jump, SolveDependentRows
from gudgeon.generator.kernels.driven_loops import DrivenLoopKernels
from gudgeon.generator.kernels.dynamics import make_dynamics_kernel
from gudgeon.generator.kernels.event_functions import make_event_function_kernel, reads_coordinate_from_index
from gudgeon.generator.kernels.projection import make_projection_kernel
from gudgeon.generator.reduction.reduction import TreeSystem
from gudgeon.generator.reduction.tree import TreeEdge
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol

DYNAMICS = "reduced_dynamics"  # the right-hand side's name
_DOC = (
    "Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from",
    "[M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.",
    "Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.",
)


def has_singular_fallback(system: TreeSystem) -> bool:
    """Return whether the absolute formulation solves the equations of motion where a pivot vanishes.

    It does not in scenes without closures, or with dry friction or rigid contacts, where a vanishing pivot is reported.
    """
    return bool(system.rows and not system.model.has_intermittent_constraints)


def make_conversion_kernels(model: Model, system: TreeSystem) -> list[Kernel]:
    """Return the kernels that convert tree coordinates to absolute ones and back."""
    return [_make_forward_kinematics_kernel(system), *_make_reduce_kernels(model, system)]


def make_reduced_kernels(system: TreeSystem) -> tuple[list[Kernel], KKT, DrivenLoopKernels | None]:
    """Return closures, right-hand side, event functions and projection in tree coordinates, with the KKT elimination.

    The functions of driven loops are returned last, or None; their switching functions are among the event functions.
    Event functions are left out if drives determine the motion, or if they read dependent coordinates.
    """
    kkt = KKT(system, allow_early_pairs=has_singular_fallback(system))
    dynamics = make_dynamics_kernel(
        system, kkt, DYNAMICS, _DOC, is_stabilized=False, append_fallback=_append_absolute_fallback
    )
    projection, _ = make_projection_kernel(system, system.rows, "reduced_project")
    driven_loop_kernels = DrivenLoopKernels(system, system.driven_loops) if system.driven_loops else None
    is_driven = len(system.q) == len(system.rows) and not (system.model.clearances or system.frictions)
    loop_switches = driven_loop_kernels.switch_kernel if driven_loop_kernels else None
    event_kernel = (
        None if is_driven else make_event_function_kernel(dynamics, system.model, loop_switches)
    )  # a driven motion has no events here
    if event_kernel and system.driven_loops and reads_coordinate_from_index(event_kernel, len(system.q)):
        event_kernel = None  # rates() closes driven loops
    kernels = (*_make_closure_kernels(system), dynamics, *([event_kernel] if event_kernel else []), projection)
    return [remove_unused_locals(kernel) for kernel in kernels], kkt, driven_loop_kernels


def _append_absolute_fallback(builder: KernelBuilder) -> None:
    """Append the code for a vanishing pivot: the absolute formulation solves and finds the dependent equations.

    Nothing is appended if the kernel has no jump to this code: no pivot can vanish.
    """
    if not builder.has_jumps:
        return
    builder.append_instruction(Jump())
    builder.begin_section("a pivot vanished: constraint equations depend on each other here")
    builder.append_instruction(SolveDependentRows())


def _make_forward_kinematics_kernel(system: TreeSystem) -> Kernel:
    """Return the kernel `expand`: forward kinematics of all bodies in absolute coordinates at a state of the tree.

    They are written to `all_q` and `all_v`.
    """
    builder = KernelBuilder(
        system.model.symbols,
        "expand",
        [
            "Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.",
        ],
    )
    builder.begin_section("bodies")
    for body in system.model.bodies:
        for index, (q, v) in enumerate(zip(body.q, body.v, strict=True)):
            builder.append_store(StorageLocation("all_q")[body.index + index], q)
            builder.append_store(StorageLocation("all_v")[body.index + index], v)
    return builder.build_kernel((*STATE, PARAMETERS, make_output_argument("all_q"), make_output_argument("all_v")))


def _make_reduce_kernels(model: Model, system: TreeSystem) -> list[Kernel]:
    """Return the kernels that compute tree coordinates and rates, and their second rates, from absolute ones.

    The second kernel is left out if the absolute formulation is not a fallback (`has_singular_fallback`).
    """
    coordinate_pairs = list(zip(model.q, model.v, strict=True))
    differentiate, find_differentiation_variables = (
        model.symbols.differentiate,
        model.symbols.find_differentiation_variables,
    )
    names = (*system.unknowns, *(system.driven_loops.names if system.driven_loops else ()))
    positions = _express_tree_coordinates(model, system, names)

    def compute_rate(value: sp.Expr) -> sp.Expr:
        """Return the sum of the derivatives of a value by the coordinates, times their rates."""
        variables = find_differentiation_variables(value)
        return sp.Add(*(differentiate(value, q) * v for q, v in coordinate_pairs if q in variables))

    rates = [compute_rate(position) for position in positions]
    state = KernelBuilder(
        model.symbols,
        "reduce_state",
        [
            "Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.",
        ],
    )
    state.begin_section("tree coordinates")
    for k, (position, rate) in enumerate(zip(positions, rates, strict=True)):
        state.append_store(StorageLocation("s")[k], position, names[k])
        state.append_store(StorageLocation("s_rate")[k], rate)
    accelerations = KernelBuilder(
        model.symbols,
        "reduce_accelerations",
        ["Second rates a of the tree coordinates, from absolute accelerations all_a."],
    )
    accelerations.begin_section("tree coordinates")
    for k, (position, rate) in enumerate(zip(positions, rates, strict=True)):
        if k == len(system.unknowns):
            break
        variables = find_differentiation_variables(position)
        terms = [
            differentiate(position, q) * StoredSymbol(StorageLocation("all_a")[index])
            for index, q in enumerate(model.q)
            if q in variables
        ]
        accelerations.append_store(StorageLocation("a")[k], sp.Add(*terms, compute_rate(rate)), system.unknowns[k])
    kernels = [state.build_kernel((*STATE, PARAMETERS, make_output_argument("s"), make_output_argument("s_rate")))]
    if has_singular_fallback(system):
        kernels.append(
            accelerations.build_kernel((*STATE, make_input_argument("all_a"), PARAMETERS, make_output_argument("a")))
        )
    return kernels


def _express_tree_coordinates(model: Model, system: TreeSystem, names: Sequence[str]) -> list[sp.Expr]:
    """Return the tree coordinates `names` as expressions in absolute ones.

    They are angles of bodies, x and y of bodies that move freely, and displacements of slides along their axes.
    """
    slides: dict[str, sp.Expr] = {}
    for tree_edge in system.tree.edges:
        body = model.geometry.bodies[tree_edge.body]
        for name, value in zip(tree_edge.coordinates, (body.x, body.y), strict=False):
            slides[name] = value if tree_edge.joint is None else _compute_sliding_displacement(model, tree_edge)
    return [slides[name] if name in slides else model.geometry.bodies[name].theta for name in names]


def _compute_sliding_displacement(model: Model, tree_edge: TreeEdge) -> sp.Expr:
    """Return the displacement in m along a joint's axis: from its point on the first body to that on the second.

    The axis is fixed in the first body. `tree_edge`: the edge of the spanning tree that belongs to the joint; an edge
    without a joint fails an assertion.
    """
    assert tree_edge.joint is not None
    geometry = model.geometry
    first, second = geometry.find_point(tree_edge.joint.first), geometry.find_point(tree_edge.joint.second)
    u_x, u_y = first.direction(JointFields(tree_edge.joint, geometry).direction("axis"))
    return u_x * (second.x - first.x) + u_y * (second.y - first.y)


def _make_closure_kernels(system: TreeSystem) -> list[Kernel]:
    """Return the kernels of Φ of the loop closures (m and rad) and of its rate Φ̇ = Φ_q v − ν, in a list.

    Each writes one value for each closure to `out`.
    """

    def make_closure_kernel(
        name: str, doc: str, reads_velocity: bool, select_expression: Callable[[Row], sp.Expr]
    ) -> Kernel:
        """Return the kernel `name`, with the comment `doc`, that writes one value of each closure to `out`.

        `select_expression`: returns the value of a closure as an expression. `reads_velocity`: the value depends on v;
        without it the kernel has no argument v.
        """
        builder = KernelBuilder(system.model.symbols, name, [doc])
        builder.begin_section("rows")
        for r, row in enumerate(system.rows):
            builder.append_store(StorageLocation("out")[r], select_expression(row), row.name)
        arguments: Sequence[Argument] = STATE if reads_velocity else STATE[:2]
        return builder.build_kernel((*arguments, PARAMETERS, make_output_argument("out")))

    return [
        make_closure_kernel(
            "closures", "Phi of the loop closures in tree coordinates; m and rad.", False, lambda row: row.phi
        ),
        make_closure_kernel(
            "closure_rates",
            "Rate Phi_q v - nu of the loop closures in tree coordinates.",
            True,
            lambda row: row.phi_q_v - row.nu,
        ),
    ]

"""Every function of a scene before any text is printed: `make_program` derives them, generator/targets prints them.

The order of derivation decides names and the order of derived parameters, so all of it is in one place: first the
absolute formulation and what the closed linkage needs, then the joints with play, the tree, and last what the
methods read. A program has its own symbols, parameters and switches, those of the model first. They are frozen when
`make_program` returns, so that the parameter table depends on the scene and the formulation alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from gudgeon.contract.methods import STAGES
from gudgeon.generator.equations.model import Model, derive_stick_baumgarte_gain
from gudgeon.generator.equations.system import System, make_absolute_system
from gudgeon.generator.ir.kernels import Kernel, remove_unused_locals
from gudgeon.generator.ir.series import Series
from gudgeon.generator.ir.signatures import Number
from gudgeon.generator.ir.sine_groups import vectorize_sines
from gudgeon.generator.ir.statements import Declare
from gudgeon.generator.kernels import closed_linkage, outputs
from gudgeon.generator.kernels.driven_loops import DrivenLoopKernels
from gudgeon.generator.kernels.dynamics import make_dynamics_kernel
from gudgeon.generator.kernels.event_functions import (
    EVENT_FUNCTIONS,
    TimeTerms,
    find_time_terms,
    make_event_function_kernel,
)
from gudgeon.generator.kernels.kinematic import make_kinematic_kernels
from gudgeon.generator.kernels.play import JointFunctions, make_derivative_calls, make_joint_functions
from gudgeon.generator.kernels.projection import make_constraint_correction_kernel, make_projection_kernel
from gudgeon.generator.kernels.reduced import has_singular_fallback, make_conversion_kernels, make_reduced_kernels
from gudgeon.generator.kernels.shared import SharedFunctionCall, SharedFunctions
from gudgeon.generator.kernels.taylor import NAME as TAYLOR
from gudgeon.generator.kernels.taylor import choose_taylor_series, make_taylor_series
from gudgeon.generator.reduction.driven_loops import DrivenLoops
from gudgeon.generator.reduction.reduction import TreeSystem, reduce_model
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.solvers.newton import Newton, make_complex_kernels
from gudgeon.generator.solvers.sparsity import Block
from gudgeon.generator.solvers.square_rows import SquareSystem

MAX_COORDINATES_FOR_LANES = 900  # 192 take a compiler 50 s; for larger linkages the vector code takes too long


@dataclass(frozen=True)
class IntegratedSystem:
    """The system that is integrated, with its KKT elimination; `angles`: 1 for each angle, 0 for each length."""

    system: System
    kkt: KKT
    angles: tuple[int, ...]
    reduced: bool
    event_functions: Kernel | None  # event functions, if they do not depend on forces (event_functions.py)
    pivots: tuple[str, ...]  # equations to which a status number of motion() refers
    driven_loops: DrivenLoops | None = None

    @property
    def switch_indices(self) -> list[int]:
        """Return the sorted numbers of the scene's own switches, without those of joints with play."""
        return sorted(switch.index for switch in self.system.model.symbols.switches.list_switches(""))


@dataclass(frozen=True)
class TreeFunctions:
    """The functions of the reduced formulation; `conversions` to and from absolute coordinates.

    `unvectorized_kernels`: kernels of the motion before sines and cosines are paired in vectors, `kernels`: after.
    `has_fallback`: where a pivot vanishes, the absolute formulation solves.
    """

    system: TreeSystem
    conversions: tuple[Kernel, ...]
    unvectorized_kernels: tuple[Kernel, ...]
    kernels: tuple[Kernel, ...]
    has_fallback: bool
    driven_loop_kernels: DrivenLoopKernels | None

    @property
    def all_kernels(self) -> tuple[Kernel, ...]:
        """Return the kernels in tree coordinates in the order of printing: conversions, motion, driven loops."""
        return (
            *self.conversions,
            *self.kernels,
            *(self.driven_loop_kernels.kernels if self.driven_loop_kernels else ()),
        )


@dataclass(frozen=True)
class IntegratorFunctions:
    """Represent the functions of a scene for methods of integration, in addition to its right-hand side.

    `derivative_calls`: calls of the derivatives of contact forces by joint with play and part, of the functions
    `derivative_kernels`. `correction_kernel` computes a step of the projection onto the constraints, for the reduced
    formulation with sines and cosines in vectors; `unvectorized_correction_kernel` is the same without vectors.
    `gains`: gains of stabilization by name, 2α and β² of Baumgarte's terms and 2α of a sticking friction, as far as
    they exist.
    """

    newton: Newton
    derivative_calls: Mapping[str, Mapping[str, SharedFunctionCall]]
    derivative_kernels: tuple[Kernel, ...]
    correction_kernel: Kernel
    unvectorized_correction_kernel: Kernel
    gains: Mapping[str, sp.Expr]
    complex_kernels: tuple[Kernel, ...] = ()  # Newton's factor, substitute and solve once more

    @property
    def kernels(self) -> tuple[Kernel, ...]:
        """Return the functions of Newton's method, then those of the derivatives of contact forces."""
        newton = self.newton
        newton_kernels = (newton.linearize_kernel, newton.factor_kernel, newton.substitute_kernel, newton.solve_kernel)
        return (*newton_kernels, *self.derivative_kernels, *self.complex_kernels)


@dataclass(frozen=True)
class KinematicFunctions:
    """The functions of a kinematically driven scene (dof = 0), whose positions Newton's method determines.

    `rows`: blocks of equations in tree coordinates; None: absolute coordinates, with the pivots of `projection_kkt`.
    `pivots`: names of the equations to which a status number refers. `unvectorized_kernels`: those in tree coordinates
    before sines are paired.
    """

    kernels: tuple[Kernel, ...]
    pivots: tuple[str, ...]
    rows: SquareSystem | None
    projection_kkt: KKT | None
    unvectorized_kernels: tuple[Kernel, ...] = ()

    @property
    def groups(self) -> tuple[Block, ...]:
        """Return the blocks of equations that are solved one after the other."""
        return tuple(self.rows.blocks or ()) if self.rows else ()


@dataclass(frozen=True)
class Program:
    """The functions of one scene in one formulation.

    `closed_linkage`: those of the closed linkage, and the outputs; `dynamics` and `event_functions` in absolute
    coordinates, which both formulations have. `methods` is set if something is integrated, else `kinematics`.
    """

    model: Model
    formulation: str
    kkt: KKT
    closed_linkage: tuple[Kernel, ...]
    dynamics: Kernel
    event_functions: Kernel | None
    laws: tuple[Kernel, ...]  # of joints with play, each once
    joints: tuple[JointFunctions, ...]
    tree: TreeFunctions | None
    integrated: IntegratedSystem
    time_terms: TimeTerms  # of time alone, which may hide within a step
    methods: IntegratorFunctions | None
    kinematics: KinematicFunctions | None
    series: Series | None = None  # of Taylor's method
    taylor_below: float = 0.0  # tolerance below which `auto` integrates by the series; 0: never

    @cached_property
    def prepare(self) -> Kernel:
        """Return the kernel that fills the parameter table; call it when all parameters have been derived."""
        return closed_linkage.make_parameter_table_kernel(self.model)

    @property
    def integrates(self) -> bool:
        """Return whether anything is integrated; otherwise drives determine the motion, or nothing moves."""
        return self.methods is not None

    @property
    def has_complex_stages(self) -> bool:
        """Return whether methods have the complex functions with which they solve all stages together."""
        return bool(self.methods and self.methods.complex_kernels)

    @property
    def right_hand_side_kernels(self) -> list[Kernel]:
        """Return the kernel of the right-hand side in absolute coordinates, then that of its event functions if used.

        The latter is used in the full formulation of a scene that is integrated, unless the event functions depend on
        forces.
        """
        watches = self.event_functions is not None and self.formulation == "full" and self.integrates
        return [self.dynamics, self.event_functions] if watches and self.event_functions else [self.dynamics]

    @property
    def has_lanes(self) -> bool:
        """Return whether several runs of the scene can be integrated together, each in one SIMD lane of a vector.

        That needs the reduced formulation. Dry friction, rigid contacts, contours of bearings, driven loops and more
        than MAX_COORDINATES_FOR_LANES absolute coordinates exclude it. A kinematically driven scene has lanes unless
        it has user events or a block of equations whose rows are exchanged for pivots.
        """
        if self.kinematics:
            kernels = self.kinematics.unvectorized_kernels
            motion = self.tree.unvectorized_kernels if self.tree else ()
            return bool(kernels) and not self.model.events and not _has_pivoted_block((*kernels, *motion))
        has_contours = any(clearance.contour for clearance in self.model.clearances)
        is_large = len(self.model.q) > MAX_COORDINATES_FOR_LANES
        is_excluded = self.model.has_intermittent_constraints or has_contours or is_large
        return self.methods is not None and self.tree is not None and not (self.tree.driven_loop_kernels or is_excluded)


def _has_pivoted_block(kernels: Iterable[Kernel]) -> bool:
    """Return whether a kernel solves a dense block with row pivoting, whose order of rows may differ between lanes.

    The sign of it is a declared integer local, the index of the pivot row.
    """
    lines = (line for kernel in kernels for section in kernel.sections for line in section.statements)
    return any(isinstance(line, Declare) and line.type is Number.INTEGER for line in lines)


def make_program(model: Model, formulation: str = "reduced") -> Program:
    """Derive every function of a scene for a formulation: "reduced", "full", STAGES or TAYLOR.

    Starts and outputs are in absolute coordinates in all of them. STAGES is the reduced one with the functions of
    methods that solve their stages together; scenes with a film and the full formulation have them anyway. TAYLOR is
    the reduced one with the Taylor series of the motion; it raises BadValueError where the motion is not smooth. Where
    the series is small and `auto` often integrates by it, every reduced one has it (`choose_taylor_series`).
    """
    model, full, staged = model.copy_mutable(), formulation == "full", formulation == STAGES
    integrates = bool(model.degrees_of_freedom or model.clearances or model.frictions)
    system = make_absolute_system(model)
    kkt = KKT(system)
    dynamics = make_dynamics_kernel(system, kkt)
    closed = (
        closed_linkage.make_mass_kernel(model),
        *closed_linkage.make_constraint_kernels(model),
        closed_linkage.make_start_kernel(model),
        outputs.make_outputs_kernel(model),
    )
    laws = SharedFunctions()
    joint_functions = tuple(make_joint_functions(model, clearance, laws) for clearance in model.clearances)
    tree, in_tree = _derive_tree_functions(model, kkt.pivots) if not full else (None, None)
    event_kernel = make_event_function_kernel(dynamics, model)
    angles = tuple(int(model.symbols.info[q].meaning.endswith(".theta")) for q in model.q)
    absolute_system = IntegratedSystem(system, kkt, angles, False, event_kernel, kkt.pivots)
    integrated = in_tree or absolute_system
    program = Program(
        model,
        "full" if full else "reduced",
        kkt,
        closed,
        dynamics,
        event_kernel,
        tuple(laws.kernels),
        joint_functions,
        tree,
        integrated,
        find_time_terms(dynamics, motion_may_stop=bool(model.frictions or model.rigid)),
        methods=_derive_integrator_functions(model, integrated, staged or not integrated.reduced)
        if integrates
        else None,
        kinematics=None if integrates else _derive_kinematic_functions(model, kkt, integrated),
    )
    series, tolerance = choose_taylor_series(program)
    if formulation == TAYLOR:
        series = series or make_taylor_series(program)
    program = replace(program, series=series, taylor_below=tolerance)
    for model_ in (model, integrated.system.model):
        model_.freeze()
    return program


def _derive_tree_functions(model: Model, pivots: tuple[str, ...]) -> tuple[TreeFunctions, IntegratedSystem]:
    """Return the functions of the reduced formulation, and the system that is integrated with its elimination.

    `pivots`: names of the equations to which a status number of the absolute formulation refers.
    """
    system = reduce_model(model)
    conversions = tuple(
        vectorize_sines(remove_unused_locals(kernel)) for kernel in make_conversion_kernels(model, system)
    )
    unpaired, kkt, driven_loop_kernels = make_reduced_kernels(system)
    kernels, has_fallback = tuple(vectorize_sines(kernel) for kernel in unpaired), has_singular_fallback(system)
    tree = TreeFunctions(system, conversions, tuple(unpaired), kernels, has_fallback, driven_loop_kernels)
    pivots = pivots if has_fallback else kkt.pivots
    if system.driven_loops:
        pivots = (*pivots, *(row.name for row in system.driven_loops.rows))
    angles = tuple(int("." not in name) for name in system.unknowns)
    event_kernel = next((kernel for kernel in unpaired if kernel.name == EVENT_FUNCTIONS), None)
    return tree, IntegratedSystem(system, kkt, angles, True, event_kernel, pivots, system.driven_loops)


def _derive_integrator_functions(
    model: Model, integrated: IntegratedSystem, with_complex_kernels: bool
) -> IntegratorFunctions:
    """Return the functions that integrators need in addition to the right-hand side.

    They are Newton's method of implicit integrators, derivatives of contact forces, the correction that projects a
    state onto the constraints, and stabilization gains. The latter are those of Baumgarte's terms in the full
    formulation, and that of sticking friction. `with_complex_kernels`: also the complex variant of Newton's method, for
    methods that solve all stages together. A scene with a film has it anyway, one with rigid surfaces never.
    """
    derivatives = SharedFunctions()
    derivative_calls = {
        clearance.name: make_derivative_calls(model, clearance, derivatives) for clearance in model.clearances
    }
    newton = Newton(integrated.system)
    gains = {"stick": derive_stick_baumgarte_gain(model)} if model.frictions else {}
    if not integrated.reduced:
        alpha, beta = model.baumgarte
        gains["two_alpha"] = model.parameter_table.derive_parameter("two_alpha", 2 * alpha)
        gains["beta_squared"] = model.parameter_table.derive_parameter("beta_squared", beta**2)
    correction = make_constraint_correction_kernel(integrated.system)
    paired_correction = (
        vectorize_sines(remove_unused_locals(correction)) if integrated.reduced else remove_unused_locals(correction)
    )
    has_film = any(clearance.film is not None for clearance in model.clearances)
    complex_kernels = make_complex_kernels(newton) if (with_complex_kernels or has_film) and not model.rigid else ()
    return IntegratorFunctions(
        newton,
        derivative_calls,
        tuple(derivatives.kernels),
        paired_correction,
        remove_unused_locals(correction),
        gains,
        complex_kernels,
    )


def _derive_kinematic_functions(model: Model, kkt: KKT, integrated: IntegratedSystem) -> KinematicFunctions:
    """Return the functions of a kinematically driven scene (dof = 0), whose positions follow by Newton's method.

    They are in tree coordinates if the reduced formulation is chosen and the pattern of the closures determines all
    coordinates. Otherwise a projection in absolute coordinates replaces them.
    """
    rows = SquareSystem(integrated.system, [not angle for angle in integrated.angles])
    if integrated.reduced and rows.is_solvable:
        names = tuple(row.name for row in integrated.system.rows)
        unpaired = tuple(make_kinematic_kernels(integrated.system, rows))
        kernels = tuple(vectorize_sines(kernel) for kernel in unpaired)
        return KinematicFunctions(kernels, (*names, *kkt.pivots), rows, None, unpaired)
    projection, solved = make_projection_kernel(kkt.system, model.rows, "project")
    return KinematicFunctions((remove_unused_locals(projection),), (*solved.pivots, *kkt.pivots), None, solved)

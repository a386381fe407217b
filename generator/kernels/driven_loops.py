"""Functions for linkage loops that drives alone determine: Newton steps, and three time derivatives of coordinates.

With c the dependent coordinates and Φ_c the Jacobian of their closures, block by block
(generator/solvers/square_rows.py):
    Φ_c δ = Φ,    Φ_c ε = Φ_cc[δ, δ]/2,    Φ_c ċ = ν,    Φ_c c̈ = γ,    Φ_c c⃛ = d/dt (γ − Φ_c c̈) at the same c̈.
The step δ + ε is that of Chebyshev's method, of order 3 (J. F. Traub, Iterative Methods for the Solution of
Equations, 1964, section 5.2): a second solve costs less than new sines. ∂f/∂t of the equations of motion needs the
third rate; its last derivative is taken by forward differentiation, by t alone. Cosines and sines of the closures'
angles are computed once and read by all kernels of the motion.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.differentiation import Tangents
from gudgeon.generator.ir.kernels import (
    FROZEN_BRANCHES_TITLE,
    Kernel,
    KernelBuilder,
    Section,
    declare_branches,
    remove_unused_locals,
)
from gudgeon.generator.ir.signatures import DISCRETE, PARAMETERS, STATE, Number, make_output_argument
from gudgeon.generator.ir.sine_groups import vectorize_sines
from gudgeon.generator.ir.statements import DeclareBranches, MarkUnused, MaxMagnitudeRow, Return, Statement
from gudgeon.generator.reduction.driven_loops import DrivenLoops
from gudgeon.generator.solvers.square_rows import SquareSystem
from gudgeon.generator.symbols.storage import StorageLocation
from gudgeon.generator.symbols.switches import BranchOf

ZERO = sp.Integer(0)
STEP, RATES, THIRD, DIRECTIONS = (
    "compute_loop_step",
    "compute_loop_rates",
    "compute_third_loop_rates",
    "evaluate_loop_directions",
)
FROZEN_BRANCHES_SECTION = Section(FROZEN_BRANCHES_TITLE, (DeclareBranches(""),))


class DrivenLoopKernels:
    """Kernels of a system's kinematically determined loops: steps, rates, third rates, directions.

    `switch_kernel` evaluates the switching functions of their drives; None if they have none.
    """

    def __init__(self, system: System, loops: DrivenLoops) -> None:
        """Derive the kernels of the loops in `loops`, whose coordinates follow those of `system` in q.

        `size` is a length in m by which displacements are divided in the test of convergence; 0 without sliding
        joints.
        """
        self.system, self.loops, self.symbols = system, loops, system.model.symbols
        loop_system = replace(
            system,
            q=tuple(k.q for k in loops.coordinates),
            v=tuple(k.rate for k in loops.coordinates),
            rows=loops.rows,
            dependent=(),
        )
        self.square = SquareSystem(loop_system, ["." in name for name in loops.names])
        self.first = len(system.q)  # index of the loops' coordinates in q and v
        kernels = [vectorize_sines(remove_unused_locals(kernel)) for kernel in self._make_kernels()]
        branches = [
            statement.value
            for kernel in kernels
            for section in kernel.sections
            for statement in section.statements
            if isinstance(statement, Statement) and isinstance(statement.value, BranchOf)
        ]
        self.switch_kernel = self._make_switch_kernel(branches) if branches else None
        self.kernels = [*map(declare_branches, kernels), *([self.switch_kernel] if self.switch_kernel else [])]
        self.size = self._derive_length_scale() if any("." in name for name in loops.names) else ZERO

    def _make_kernels(self) -> list[Kernel]:
        """Return the kernels of the loops in the order of printing: directions, steps, rates, third rates."""
        return [
            self._make_direction_kernel(),
            self._make_step_kernel(),
            self._make_rate_kernel(),
            self._make_third_rate_kernel(),
        ]

    def _make_direction_kernel(self) -> Kernel:
        """Return the kernel that stores the cosines and sines of the loops' angles in q, after the coordinates.

        All other functions of the motion read them there.
        """
        builder = KernelBuilder(
            self.symbols,
            DIRECTIONS,
            [
                "Cosines and sines of all angles in the closures of dependent loops, stored in q after coordinates.",
            ],
        )
        builder.begin_section("directions")
        first_index = self.first + len(self.loops.names)
        symbols = [symbol for direction in self.loops.directions for symbol in (direction.cos, direction.sin)]
        for k, symbol in enumerate(symbols):
            builder.append_store(StorageLocation("out")[first_index + k], self.symbols.definitions[symbol], symbol.name)
        return builder.build_kernel((*STATE[:2], DISCRETE, PARAMETERS, make_output_argument("out")), owner="")

    def _derive_length_scale(self) -> sp.Expr:
        """Return the length scale (characteristic length) of the mechanism in m, which scales steps of sliding joints.

        It is the root of the sum of squares of all points' coordinates in their bodies' frames, also on the ground. It
        is added as the derived parameter "extent".
        """
        geometry, parameter_table = self.system.model.geometry, self.system.model.parameter_table
        ground = map(geometry.ground_vector, self.system.model.scene.mechanism.ground.values())
        squares = [x**2 for point in (*geometry.local_vectors.values(), *ground) for x in point]
        return parameter_table.derive_parameter("extent", sp.sqrt(sp.Add(*squares)), "extent of all points")

    def _make_step_kernel(self) -> Kernel:
        """Return the kernel of one step of Chebyshev's method onto the closures, to be subtracted from coordinates.

        It writes the whole step, its part of order 3 alone, and the number of the equation with the largest |Φ|, from
        1. It returns 0, or the number of an equation that depends on others there.
        """
        builder = KernelBuilder(
            self.symbols,
            STEP,
            [
                "Newton's step of the dependent coordinates, Phi_c newton = Phi, and Chebyshev's step of order 3,",
                "step = newton + bend, Phi_c bend = Phi_cc[newton, newton]/2. `row`: the number, from 1, of the row "
                "with",
                "the largest |Phi|. Returns 0, or the number of a row that depends on others here.",
            ],
        )
        builder.begin_section("closures of the chains")
        named_rows = zip(self.square.names, self.loops.rows, strict=True)
        phi = [builder.append_local(f"phi_{name}", row.phi) for name, row in named_rows]
        builder.begin_section("the largest")
        builder.append_instruction(MaxMagnitudeRow(tuple(phi)))
        solvers = self.square.factorize(builder)
        builder.begin_section("Newton's step")
        newton = self.square.solve(builder, solvers, phi, "newton")
        builder.begin_section("correction by the curvature of the constraints")
        correction_step = self.square.solve(
            builder, solvers, [self._compute_curvature(row, newton) / 2 for row in self.loops.rows], "bend"
        )
        for k, (newton_component, correction) in enumerate(zip(newton, correction_step, strict=True)):
            builder.append_store(StorageLocation("step")[k], newton_component + correction)
            builder.append_store(StorageLocation("bend")[k], correction)
        builder.append_instruction(Return())
        outs = (make_output_argument("step"), make_output_argument("bend"), make_output_argument("row", Number.INTEGER))
        return builder.build_kernel((*STATE[:2], DISCRETE, PARAMETERS, *outs), status=True, owner="", prune=True)

    def _compute_curvature(self, row: Row, step: Sequence[sp.Expr]) -> sp.Expr:
        """Return Φ_cc[step, step] of one constraint equation: its second derivative along `step`.

        c are the dependent coordinates; `step` has one component for each, in their order.
        """
        step_of = dict(zip([k.q for k in self.loops.coordinates], step, strict=True))
        slope = sp.Add(*(entry * step_of[q] for q, entry in row.phi_q.items()))
        return sp.expand(
            sp.Add(*(self.symbols.differentiate(slope, q) * component for q, component in step_of.items()))
        )

    def _make_rate_kernel(self) -> Kernel:
        """Return the kernel of the first and second rates ċ, c̈ at coordinates that close the loops.

        They are stored in v after the other rates. It returns 0, or the number of an equation that depends on others
        there.
        """
        builder = KernelBuilder(
            self.symbols,
            RATES,
            [
                "First and second rates of the dependent coordinates at positions that close their loops: "
                "Phi_c c' = nu,",
                "Phi_c c'' = gamma. They are stored after those of the other coordinates in v.",
                "Returns 0, or the number of a row that depends on others here.",
            ],
        )
        dependent, rows = self.loops.coordinates, self.loops.rows
        solvers = self.square.factorize(builder)
        builder.begin_section("rates")
        rates = self.square.solve(builder, solvers, [row.nu for row in rows], "rate")
        for k, value in zip(dependent, rates, strict=True):  # by the name under which all expressions know it
            builder.append_instruction(Statement(k.rate.name, value))
        for symbol in self._find_rate_symbols():
            builder.append_instruction(Statement(symbol.name, self.symbols.definitions[symbol]))
        builder.begin_section("second rates")
        second_rates = self.square.solve(builder, solvers, [row.gamma for row in rows], "second")
        builder.begin_section("results")
        for index, (coordinate, value) in enumerate(zip(dependent, second_rates, strict=True), self.first):
            builder.append_store(StorageLocation("v")[index], coordinate.rate)
            builder.append_store(StorageLocation("v")[index + len(dependent)], value)
        builder.append_instruction(Return())
        return builder.build_kernel(
            (*STATE[:2], DISCRETE, PARAMETERS, make_output_argument("v")), status=True, owner="", prune=True
        )

    def _make_third_rate_kernel(self) -> Kernel:
        """Return the kernel of the third rates of the loops' coordinates c: Φ_c c⃛ = d/dt (γ − Φ_c c̈).

        The derivative is by forward differentiation at constant c̈. The function returns 0, or the number of an
        equation that depends on others there.
        """
        builder = KernelBuilder(
            self.symbols,
            THIRD,
            [
                "Third rates of the dependent coordinates: Phi_c c''' = d/dt (gamma - Phi_c c'') at the same c''.",
                "Returns 0, or the number of a row that depends on others here.",
            ],
        )
        dependent, t = self.loops.coordinates, self.system.model.t
        solvers = self.square.factorize(builder)
        builder.begin_section("third rates")
        tangents = Tangents(self.symbols, builder, (t,))
        for k in dependent:
            tangents.store_tangent(k.q, {t: k.rate})
            tangents.store_tangent(k.rate, {t: k.second})
        residuals = [
            sp.Add(row.gamma, *(-row.phi_q.get(k.q, ZERO) * k.second for k in dependent)) for row in self.loops.rows
        ]
        residual_rates = [tangents.compute_gradient(value).get(t, ZERO) for value in residuals]
        for index, value in enumerate(self.square.solve(builder, solvers, residual_rates, "third")):
            builder.append_store(StorageLocation("out")[index], value)
        builder.append_instruction(Return())
        return builder.build_kernel(
            (*STATE, DISCRETE, PARAMETERS, make_output_argument("out")), status=True, owner="", prune=True
        )

    def _find_rate_symbols(self) -> list[sp.Symbol]:
        """Return the defined symbols that depend on rates of the loops, but not on the free coordinates and rates.

        Dependence through other definitions counts. The caller writes these definitions after the computed rates, not
        at the beginning of the function.
        """
        info, definitions = self.symbols.info, self.symbols.definitions
        varying = {k.rate for k in self.loops.coordinates}
        system_symbols = {*self.system.v, *self.system.q}
        result = []
        for symbol in [s for s in info if s in definitions and not info[s].storage_location]:
            read_symbols = definitions[symbol].free_symbols
            if read_symbols & system_symbols:
                system_symbols.add(symbol)
            elif read_symbols & varying:
                varying.add(symbol)
                result.append(symbol)
        return [symbol for symbol in result if symbol not in system_symbols]

    def _make_switch_kernel(self, branches: Sequence[BranchOf]) -> Kernel:
        """Return the kernel that writes the switching functions of the drives of driven loops to the output `g`.

        The other functions of the loops read the branches only, and do not evaluate the switching functions.
        `branches`: the branches (signs of switching functions) that these functions read. Repeated ones count once.
        Each branch is a local variable of the kernel, which is otherwise unused.
        """
        builder = KernelBuilder(
            self.symbols,
            "evaluate_loop_switching_functions",
            ["Switching functions of the drives of dependent loops."],
        )
        builder.begin_section("branches")
        for branch in dict.fromkeys(branches):
            name = f"side_{branch.args[0]}"
            builder.append_instruction(Statement(name, branch))
            builder.append_instruction(MarkUnused(name))
        kernel = builder.build_kernel((*STATE[:2], DISCRETE, PARAMETERS, make_output_argument("g")), owner="")
        return replace(kernel, sections=(FROZEN_BRANCHES_SECTION, *kernel.sections))

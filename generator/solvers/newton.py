"""Functions for implicit methods: Newton's matrix of the equations of motion, and solutions of linear systems with it.

J is the Jacobian of y' = f(t, y) with y = (q, v, works, internal states z) and η = h γ of the method. Eliminating
u_q = η (r_q + u_v) leaves, with the Jacobians of linearization.py and κ = 1 + 2αη + β²η² (1 + 2αη for a stick),
    [M + η R1_v + η² R1_q   Φ_qᵀ] [u_v ]   [ η (M r_v − η R1_q r_q − s R1_t)                         ]
    [Φ_q + η/κ (V + η Q)    0   ] [η μ ] = [ η/κ (Φ_q (r_v − η β² r_q) − η Q r_q − s R2_t)           ]
    u_w = η (r_w + P_q u_q + P_v u_v + P_z u_z + P_λ μ + s P_t),   μ the multipliers' own change.
Where laws have internal states, u_z is unknown as well: the first equations have the additional term η R1_z u_z, and
    (1 + η R3_z) u_z + η (R3_v + η R3_q) u_v = η (r_z − η R3_q r_q − s R3_t).
At η = 0 the matrix is the KKT matrix, with 1 in the rows of z. It is factorized as L U without pivoting in an order
chosen on its symmetric pattern, internal states first, a constraint equation only after the coordinates in it. A
coordinate that an equation gives by others (dependent_coordinates.py) is the unknown of that equation, and its
multiplier that of the coordinate's equation: both pivots are the constant entry. E. Hairer, G. Wanner, Solving
Ordinary Differential Equations II, Springer (1996), IV.8 and VII. L U is printed as statements.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import sympy as sp

from gudgeon.contract.boundary import N_WORK
from gudgeon.generator.equations.model import derive_stick_baumgarte_gain
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.complex_parts import convert_to_complex
from gudgeon.generator.ir.differentiation import Tangents
from gudgeon.generator.ir.kernels import LINEARIZATION, Kernel, KernelBuilder, Section, ValuePool, declare_branches
from gudgeon.generator.ir.signatures import (
    DISCRETE,
    PARAMETERS,
    RHS,
    STATE,
    Access,
    Argument,
    Number,
    make_input_argument,
    make_output_argument,
)
from gudgeon.generator.ir.statements import Call, Declare, DeclareParameters, Guard, Return, Statement
from gudgeon.generator.ir.values import Conditional, Test
from gudgeon.generator.solvers.dependent_coordinates import FirstPivots, is_unit
from gudgeon.generator.solvers.linearization import JacobianEntries, Linearization, Pair
from gudgeon.generator.solvers.pivots import SINGULAR, is_number_or_signed_symbol
from gudgeon.generator.solvers.sparsity import choose_elimination
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol
from gudgeon.generator.symbols.switches import ComparedMagnitude
from gudgeon.generator.symbols.symbol_sums import subtract_products

ZERO = sp.Integer(0)


class Newton:
    """The kernels of Newton's method for one system: linearize, factor, substitute and solve."""

    def __init__(self, system: System) -> None:
        """Derive the kernels linearize, factor, substitute and solve, in this order.

        Each reads values that the one before stores. `system`: the equations of motion that are integrated.
        """
        self.system, self.model = system, system.model
        self.n, self.m = len(system.q), len(system.rows)
        self.first_state = self.n + self.m + len(system.frictions)
        states = [f"{c.name}.{k}" for c in self.model.clearances for k in range(self.model.law_states)]
        self.nodes = self.first_state + len(states)
        names = [row.name for row in system.rows] + [friction.name for friction in system.frictions]
        self.first = FirstPivots(system, system.rows)
        partner = self.first.partner
        self.equation = {**partner, **{r: k for k, r in partner.items()}}  # by its unknown, if not its own
        self.names = [q.name for q in system.q] + [name.replace(".", "_") for name in names + states]
        self.linearization_argument = make_input_argument(LINEARIZATION, "Linear")
        self.values = ValuePool(system.model.symbols, self.linearization_argument["value"])
        self.factors = ValuePool(system.model.symbols, self.linearization_argument["lu"])
        self.linearize_kernel = self._make_linearize_kernel()
        self.factor_kernel = self._make_factor_kernel()
        self.substitute_kernel = self._make_substitute_kernel()
        self.solve_kernel = self._make_solve_kernel()

    def _begin_function(self, name: str, doc: Sequence[str]) -> KernelBuilder:
        """Return the builder of a function with a name and the lines of its comment."""
        return KernelBuilder(self.model.symbols, name, doc)

    def _make_linearize_kernel(self) -> Kernel:
        """Return the kernel `linearize`, which writes the entries of all Jacobians at a state to `lin->value`.

        It also copies the parameters to `lin`. Sets `jacobians` (entries as symbols that read `lin->value`),
        `stick_flags` (such symbols, 1 at stick and 0 at slip, by friction element) and `tables` (`_make_entry_tables`).
        """
        builder = self._begin_function(
            "linearize",
            [
                "The equations of motion linearized at a state, with the accelerations and multipliers that belong "
                "to it:",
                "non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.",
            ],
        )
        linearization = Linearization(self.system, builder)
        jacobians = linearization.derive_jacobian_entries()
        builder.begin_section("results")
        self.jacobians = self._store_entries(builder, jacobians, linearization.tangents)
        self.stick_flags = [
            self.values.store_value(builder, stick, f"is_{stick.name}") for stick in linearization.stick_flags
        ]
        self.tables = self._make_entry_tables(builder)
        builder.append_store(self.linearization_argument[PARAMETERS.name], StorageLocation(PARAMETERS.name))
        arguments = (
            *STATE,
            DISCRETE,
            PARAMETERS,
            make_input_argument("a"),
            make_input_argument(RHS.name, RHS.type),
            self._make_output_linearization(),
        )
        return declare_branches(builder.build_kernel(arguments, owner="", prune=True))

    def _store_entries(self, builder: KernelBuilder, entries: JacobianEntries, tangents: Tangents) -> JacobianEntries:
        """Return the entries of the Jacobians with each value stored in the array `lin->value`, once up to its sign.

        Values of the result are the symbols that read the array. `tangents` stores shared denominators and powers.
        """

        def store_value(value: sp.Expr, name: str) -> sp.Expr:
            """Return the symbol of a value that is stored in the pool; `name`: base of its name."""
            return self.values.store_value(builder, tangents.store_powers(value), name)

        def store_matrix(
            prefix: str,
            part: Mapping[Pair, sp.Expr],
            row_names: Sequence[str],
            column_names: Sequence[str] = self.names,
        ) -> dict[Pair, sp.Expr]:
            """Return the stored entries of one matrix, named `prefix` and its row and column."""
            return {
                (i, j): store_value(value, f"{prefix}_{row_names[i]}_{column_names[j]}")
                for (i, j), value in part.items()
            }

        states = self.names[self.first_state :]
        works = [str(w) for w in range(N_WORK)]
        return JacobianEntries(
            store_matrix("mass", entries.mass, self.names),
            store_matrix("phi", entries.phi_q, self.names),
            store_matrix("by_q", entries.by_q, self.names),
            store_matrix("by_v", entries.by_v, self.names),
            store_matrix("by_z", entries.by_z, self.names, states),
            {k: store_value(x, f"by_t_{self.names[k]}") for k, x in entries.by_t.items()},
            store_matrix("power_q", entries.power_q, works),
            store_matrix("power_v", entries.power_v, works),
            store_matrix("power_z", entries.power_z, works, states),
            store_matrix("power", entries.power_row, works),
            {w: store_value(x, f"power_t_{w}") for w, x in entries.power_t.items()},
        )

    def _make_entry_tables(self, builder: KernelBuilder) -> dict[str, list[tuple[int, int, int, int]]]:
        """Return, by part, the entries of the linearization as (row, column, index, sign).

        An entry is sign times element `index` of `lin->value`. Rows are nodes (coordinates, equations, frictions,
        internal states) or works; columns are those of y = (q, v, works, internal states).
        """
        entries, n, z = self.jacobians, self.n, 2 * self.n + N_WORK

        def make_table(part: Mapping[Pair, sp.Expr], first_column: int = 0) -> list[tuple[int, int, int, int]]:
            """Return (row, column, index, sign) of the entries of one part."""
            return [
                (i, first_column + k, *self.values.find_index_and_sign(builder, value))
                for (i, k), value in part.items()
            ]

        return {
            "phi_q": make_table(entries.phi_q),
            "residual": make_table(entries.by_q) + make_table(entries.by_v, n) + make_table(entries.by_z, z),
            "residual_t": make_table({(node, 0): value for node, value in entries.by_t.items()}),
            "power": make_table(entries.power_q) + make_table(entries.power_v, n) + make_table(entries.power_z, z),
            "power_row": make_table(entries.power_row),
            "power_t": make_table({(w, 0): value for w, value in entries.power_t.items()}),
        }

    def _make_matrix_entries(self, builder: KernelBuilder) -> dict[Pair, sp.Expr]:
        """Return the entries of Newton's matrix by (row, column), of both triangles, for the η of the method.

        Rows and columns are nodes: coordinates, constraint equations, frictions, internal states. An entry of the
        motion or constraint equations is M or Φ_q plus s (V + η Q), with the factor s of `_find_eta_factor`. Numbers
        and symbols stay, other entries become locals.
        """
        jacobians = self.jacobians
        self._append_eta_factors(builder, {self._find_eta_factor(i) for i, _ in {**jacobians.by_v, **jacobians.by_q}})
        first = self.first_state
        builder.begin_section("matrix")
        entries: dict[Pair, sp.Expr] = dict(jacobians.mass)
        for node, k in sorted({*jacobians.by_v, *jacobians.by_q, *jacobians.phi_q}):
            index = node, k
            coefficient = jacobians.by_v.get(index, ZERO) + ETA * jacobians.by_q.get(index, ZERO)
            value = jacobians.mass.get(index, ZERO) if node < self.n else jacobians.phi_q.get(index, ZERO)
            entries[index] = self._name_entry(builder, index, value + self._find_eta_factor(node) * coefficient)
        entries |= {(k, k): sp.Integer(1) for k in range(first, self.nodes)}
        for (node, state), derivative in jacobians.by_z.items():
            index = node, first + state
            entries[index] = self._name_entry(builder, index, sp.Integer(node == index[1]) + ETA * derivative)
        return entries | {(k, node): value for (node, k), value in jacobians.phi_q.items()}

    def _name_entry(self, builder: KernelBuilder, index: Pair, value: sp.Expr) -> sp.Expr:
        """Return an entry of Newton's matrix as a new local; a number or ± a symbol is returned unchanged.

        `index`: its row and column, from which the local is named.
        """
        name = f"n_{self.names[index[0]]}__{self.names[index[1]]}"
        return value if is_number_or_signed_symbol(value) else builder.append_local(name, value)

    def _find_eta_factor(self, node: int) -> sp.Symbol:
        """Return the symbol of the factor, η or η/κ, of the derivatives of the equation `node` in Newton's matrix.

        It is η for equations of coordinates and internal states, η/κ for constraints and sticks, whose κ differ.
        """
        if node < self.n or node >= self.first_state:
            return ETA
        return ETA_ROW if node < self.n + self.m else ETA_STICK

    def _append_eta_factors(self, builder: KernelBuilder, factors: Collection[sp.Symbol]) -> None:
        """Append the factors η/κ of constraints and of sticks to the function, those that are in `factors`.

        η = h γ of the method. κ = 1 + 2αη + β²η² for constraints (Baumgarte's α and β), 1 + 2αη for sticks, with α of
        `derive_stick_baumgarte_gain`. The section "eta/kappa" begins also without a factor.
        """
        alpha, beta = self.model.baumgarte
        derive = self.model.parameter_table.derive_parameter
        two_alpha, beta_squared = derive("two_alpha", 2 * alpha), derive("beta_squared", beta**2)
        builder.begin_section("eta/kappa")
        if ETA_ROW in factors:
            builder.append_instruction(Statement(ETA_ROW.name, ETA / (1 + ETA * (two_alpha + ETA * beta_squared))))
        if ETA_STICK in factors:
            builder.append_instruction(
                Statement(ETA_STICK.name, ETA / (1 + ETA * derive_stick_baumgarte_gain(self.model)))
            )

    def _make_factor_kernel(self) -> Kernel:
        """Return the kernel `newton_factor`, which factorizes Newton's matrix at η as L U, L with unit diagonal.

        Factors that are neither numbers nor ± symbols are stored in `lin->lu`. Sets `elimination`, `lower`, `upper`
        and `inverse`. The function returns 0, or the number of the node, from 1, whose pivot vanished.
        """
        states = range(self.first_state, self.nodes)
        note = ", internal states" if states else ""
        builder = self._begin_function(
            "newton_factor",
            [
                "L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the",
                f"number of the node (coordinates, rows, sticks{note}; from 1) whose pivot vanished or is not finite.",
            ],
        )
        entries = self._make_matrix_entries(builder)
        pattern: list[set[int]] = [set() for _ in range(self.nodes)]
        for i, j in entries:
            if i != j:
                pattern[i].add(j)
                pattern[j].add(i)
        self.elimination = choose_elimination(
            tuple(map(frozenset, pattern)),
            self.n,
            self.n + self.m,
            leading_nodes=(*states, *self.first.order),
            partner_by_node=self.first.partner,
        )
        builder.begin_section("L U")
        factors = Factors(self, builder, entries)
        for k in self.elimination.order:
            factors.eliminate_node(k, self.elimination.structure[k])
        self.lower, self.upper, self.inverse = factors.lower, factors.upper, factors.inverse
        builder.append_instruction(Return())
        return self._finish_function(builder, (Argument("eta"), self._make_output_linearization()), status=True)

    def _make_output_linearization(self) -> Argument:
        """Return the argument `linearization_argument` as one that the function writes."""
        return replace(self.linearization_argument, access=Access.WRITTEN)

    def _finish_function(self, builder: KernelBuilder, arguments: Sequence[Argument], status: bool = False) -> Kernel:
        """Return the built function, without locals that nothing reads.

        If it reads parameters of the run, they are declared first, read from the argument of the linearization.
        """
        kernel = builder.build_kernel(arguments, status, prune=True)
        parameter_section = Section("numbers of the run", (DeclareParameters(),))
        reads_parameters = any(PARAMETERS.name in s.reads for section in kernel.sections for s in section.statements)
        return replace(kernel, sections=(parameter_section, *kernel.sections)) if reads_parameters else kernel

    def _make_substitute_kernel(self) -> Kernel:
        """Return the kernel that overwrites x = b by the solution of N x = b, N Newton's matrix factorized as L U.

        x has one element for each node: coordinates, then equations, frictions and internal states.
        """
        builder = self._begin_function(
            "newton_substitute", ["x (all nodes) holds b and becomes the solution of N x = b."]
        )
        builder.begin_section("forward")
        order = self.elimination.order
        x: dict[int, sp.Symbol] = {}
        earlier_columns: dict[int, list[int]] = {k: [] for k in order}
        for i, j in self.lower:
            earlier_columns[i].append(j)
        for k in order:
            i = self.equation.get(k, k)
            factors = ((self.lower[i, j], x[j]) for j in earlier_columns[i])
            value = subtract_products(StoredSymbol(StorageLocation("x")[i]), factors)
            x[k] = builder.append_local(f"b_{self.names[k]}", value)
        builder.begin_section("backward")
        for k in reversed(order):
            factors = ((self.upper[k, j], x[j]) for j in self.elimination.structure[k])
            value = subtract_products(x[k], factors)
            x[k] = builder.append_local(f"x_{self.names[k]}", value * self.inverse[k])
            builder.append_store(StorageLocation("x")[k], x[k])
        return self._finish_function(builder, (self.linearization_argument, make_output_argument("x")))

    def _make_solve_kernel(self) -> Kernel:
        """Return the kernel that solves (1/η − J) u = r + s f_t for u.

        r and u are vectors (q, v, works, internal states); s is a number. It calls the function of
        `_make_substitute_kernel`.
        """
        n, jacobians = self.n, self.jacobians
        states = range(self.first_state, self.nodes)
        builder = self._begin_function(
            "newton_solve",
            [
                "(1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works"
                f"{', internal states' if states else ''}.",
            ],
        )
        self._append_eta_factors(builder, {self._find_eta_factor(node) for node in range(self.nodes)})
        builder.begin_section("right-hand side")
        builder.append_instruction(Declare(Number.REAL, "x", (self.nodes,)))
        beta_squared = self.model.parameter_table.derive_parameter("beta_squared", self.model.baumgarte[1] ** 2)
        r_q, r_v = ([StoredSymbol(StorageLocation("r")[first + k]) for k in range(n)] for first in (0, n))
        coordinates = sorted({k for node, k in jacobians.phi_q if node < n + self.m})
        shifted = {
            k: builder.append_local(f"shifted_{self.names[k]}", r_v[k] - ETA * beta_squared * r_q[k])
            for k in coordinates
        }
        b: list[list[sp.Expr]] = [[] for _ in range(self.nodes)]
        for (i, k), value in jacobians.mass.items():
            b[i].append(value * r_v[k])
        for (i, k), value in jacobians.phi_q.items():
            b[i].append(value * (shifted[k] if i < n + self.m else r_v[k]))
        for (i, k), value in jacobians.by_q.items():
            b[i].append(-ETA * value * r_q[k])
        for i, value in jacobians.by_t.items():
            b[i].append(-sp.Symbol("s") * value)
        for i in range(self.first_state, self.nodes):
            b[i].append(StoredSymbol(StorageLocation("r")[self._find_state_index(i)]))
        for i, terms in enumerate(b):
            builder.append_store(StorageLocation("x")[i], self._find_eta_factor(i) * sp.Add(*terms))
        builder.append_instruction(
            Call("newton_substitute", (StorageLocation(LINEARIZATION),), (StorageLocation("x"),))
        )
        builder.begin_section("solution")
        for k in range(n):
            builder.append_store(StorageLocation("u")[k], ETA * (r_q[k] + StoredSymbol(StorageLocation("x")[k])))
            builder.append_store(StorageLocation("u")[n + k], StoredSymbol(StorageLocation("x")[k]))
        for i in range(self.first_state, self.nodes):
            builder.append_store(StorageLocation("u")[self._find_state_index(i)], StoredSymbol(StorageLocation("x")[i]))
        for w in range(N_WORK):
            builder.append_store(StorageLocation("u")[2 * n + w], self._compute_work_change(w))
        scalars = (Argument("eta"), Argument("s"))
        vectors = (make_input_argument("r"), make_output_argument("u"))
        return self._finish_function(builder, (self.linearization_argument, *scalars, *vectors))

    def _find_state_index(self, state: int) -> int:
        """Return the index in y = (q, v, works, internal states) of the internal state whose node is `state`."""
        return 2 * self.n + N_WORK + state - self.first_state

    def _compute_work_change(self, w: int) -> sp.Expr:
        """Return u_w, the component of the solution u for work w, as an expression in r, the other u, and x.

        u_w = η (r_w + s P_t + P_q u_q + P_v u_v + P_z u_z) + P_a (x_v − η r_v) + P_λ x_λ. x is the result of the
        substitution: u_v by coordinate, followed by η μ by equation.
        """
        jacobians, n = self.jacobians, self.n
        terms = [StoredSymbol(StorageLocation("r")[2 * n + w]), sp.Symbol("s") * jacobians.power_t.get(w, ZERO)]
        for part, first in ((jacobians.power_q, 0), (jacobians.power_v, n), (jacobians.power_z, 2 * n + N_WORK)):
            terms += [value * StoredSymbol(StorageLocation("u")[first + k]) for (i, k), value in part.items() if i == w]
        changes = [ZERO]
        for (i, node), value in jacobians.power_row.items():
            start_rate = ETA * StoredSymbol(StorageLocation("r")[n + node]) if node < n else ZERO
            changes += [value * (StoredSymbol(StorageLocation("x")[node]) - start_rate)] if i == w else []
        return ETA * sp.Add(*terms) + sp.Add(*changes)


def make_complex_kernels(newton: Newton) -> tuple[Kernel, ...]:
    """Return the functions of Newton's matrix at complex η: factorization, substitution, and solution with s = 0.

    They are for methods that solve all stages together.
    """
    arrays = ("eta", "r", "u", "x", newton.linearization_argument["lu"])
    return tuple(
        convert_to_complex(kernel, arrays, ("s",))
        for kernel in (newton.factor_kernel, newton.substitute_kernel, newton.solve_kernel)
    )


ETA, ETA_ROW, ETA_STICK = (sp.Symbol(name, real=True) for name in ("eta", "eta_row", "eta_stick"))


class Factors:
    """L, U and inverse pivots of Newton's matrix, printed column by column."""

    def __init__(self, newton: Newton, builder: KernelBuilder, entries: Mapping[Pair, sp.Expr]) -> None:
        """Begin without pivots; `entries` are those of Newton's matrix by (row, column), statements go to `builder`."""
        self.newton, self.builder, self.entries = newton, builder, entries
        self.lower: dict[Pair, sp.Expr] = {}  # (later equation, earlier unknown)
        self.upper: dict[Pair, sp.Expr] = {}  # (earlier unknown, later unknown)
        self.inverse: dict[int, sp.Expr] = {}
        self._earlier_pivots: dict[int, list[int]] = {k: [] for k in range(newton.nodes)}

    def eliminate_node(self, k: int, later_nodes: Sequence[int]) -> None:
        """Append pivot k of Newton's matrix with its column of L and row of U; `later_nodes`: the nodes in them.

        If the unknown k has an equation that gives it (`newton.equation`), the row of that equation is the pivot row,
        and row k is eliminated later in its place, for the multiplier.
        """
        self.inverse[k] = self._invert_pivot(k)
        names, equation = self.newton.names, self.newton.equation.get(k, k)
        for i in later_nodes:
            target_row = k if i == equation else i  # the unknown's own equation stays for the multiplier
            column = self._subtract_products(self.entries.get((target_row, k), ZERO), target_row, k)
            row = self._subtract_products(self.entries.get((equation, i), ZERO), equation, i)
            self.lower[target_row, k] = self._store_factor(
                f"l_{names[target_row]}__{names[k]}", column * self.inverse[k]
            )
            self.upper[k, i] = self._store_factor(f"u_{names[k]}__{names[i]}", row)
        for i in later_nodes:
            self._earlier_pivots[k if i == equation else i].append(k)

    def _subtract_products(self, value: sp.Expr, i: int, k: int, pivots: Sequence[int] | None = None) -> sp.Expr:
        """Return `value` − Σ L U of earlier pivots for the entry of equation i in the unknown k.

        `pivots`: those that count; None: all.
        """
        columns = self._earlier_pivots[i] if pivots is None else pivots
        factors = ((self.lower[i, j], self.upper[j, k]) for j in columns if (j, k) in self.upper)
        return subtract_products(value, factors)

    def _invert_pivot(self, k: int) -> sp.Expr:
        """Return 1/pivot of node k, and append a test of the pivot, upon whose failure the function returns k + 1.

        The pivot of a constraint equation is compared with its value if the equation were independent of the others,
        any other one with its entry. Constant entries, missing internal states and masses need no test. The value of a
        friction element that slips is 0 at run time.
        """
        newton, builder, name = self.newton, self.builder, self.newton.names[k]
        entry = self.entries.get((newton.equation.get(k, k), k), ZERO)
        if k in newton.equation:
            return (
                entry
                if is_unit(entry)
                else newton.factors.store_local(builder, builder.append_local(f"inverse_pivot_{name}", 1 / entry))
            )
        if entry.is_Number and entry == 1:  # an internal state that this joint does not have
            return entry
        if not self._earlier_pivots[k] and entry in newton.model.masses:
            return newton.model.parameter_table.derive_parameter(f"inverse_{entry}", 1 / entry, "1/M")
        states = newton.first_state
        independent_pivots = [
            j
            for j in self._earlier_pivots[k]
            if j < newton.n or j in newton.equation or j >= states or k < newton.n or k >= states
        ]
        row_pivots = [j for j in self._earlier_pivots[k] if j not in independent_pivots]
        scale = builder.append_local(f"scale_{name}", self._subtract_products(entry, k, k, independent_pivots))
        pivot = (
            builder.append_local(f"pivot_{name}", self._subtract_products(scale, k, k, row_pivots))
            if row_pivots
            else scale
        )
        size = entry if k < newton.n or k >= states else scale
        stick = newton.stick_flags[k - newton.n - newton.m] if newton.n + newton.m <= k < states else None
        is_sticking = Test(stick, "!=", (0.0,)) if stick is not None else None
        builder.append_instruction(
            Guard(
                Test(pivot, ">", (SINGULAR, ComparedMagnitude(size)), compares_magnitude=True),
                k + 1,
                condition=is_sticking,
            )
        )
        # a row that slips is switched off: its multiplier is zero
        value = 1 / pivot if is_sticking is None else Conditional(is_sticking, 1 / pivot, ZERO)
        return newton.factors.store_local(builder, builder.append_local(f"inverse_pivot_{name}", value))

    def _store_factor(self, name: str, value: sp.Expr) -> sp.Expr:
        """Return a factor as a value that the other kernels can read, from `lin->lu` if necessary.

        A number or ± a symbol other than η and η/κ is unchanged. Any other value becomes the local `name`, which is
        stored in `lin->lu`.
        """
        is_stored_elsewhere = is_number_or_signed_symbol(value) and not value.free_symbols & {
            ETA,
            ETA_ROW,
            ETA_STICK,
        }  # not what every call is given
        return self.newton.factors.store_local(
            self.builder, value if is_stored_elsewhere else self.builder.append_local(name, value)
        )

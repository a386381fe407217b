"""Kernels of kinematically determined loops (driven chains): Newton steps onto their closures, and three rates.

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
from gudgeon.generator.ir.kernels import HELD, Kernel, KernelBuilder, Section, declare_branches, without_unused
from gudgeon.generator.ir.signatures import DISCRETE, PARAMETERS, STATE, Number, result
from gudgeon.generator.ir.sine_pairs import pair_sines
from gudgeon.generator.ir.statements import Branches, LargestRow, Return, Statement, Unread
from gudgeon.generator.reduction.driven_chains import Chain
from gudgeon.generator.solvers.square_rows import SquareRows
from gudgeon.generator.symbols.storage import Place
from gudgeon.generator.symbols.switches import BranchOf

ZERO = sp.Integer(0)
STEP, RATES, THIRD, DIRECTIONS = "chain_step", "chain_rates", "chain_third", "chain_directions"
TOLD_SIDES = Section(HELD, (Branches(""),))


class ChainKernels:
    """C functions of a system's kinematically determined loops: steps, rates, third rates, directions.

    `corners` is the function that evaluates the switching functions of their drives; None where there are none.
    """

    def __init__(self, system: System, chain: Chain) -> None:
        """Derive the functions of the loops in `chain`, whose coordinates follow those of `system` in q."""
        self.system, self.chain, self.symbols = system, chain, system.model.symbols
        own = replace(
            system, q=tuple(k.q for k in chain.known), v=tuple(k.rate for k in chain.known), rows=chain.rows, known=()
        )
        self.square = SquareRows(own, ["." in name for name in chain.names])
        self.first = len(system.q)  # of the chains' coordinates in q and v
        raw = [pair_sines(without_unused(kernel)) for kernel in self._all()]
        sides = [
            s.value
            for kernel in raw
            for section in kernel.sections
            for s in section.statements
            if isinstance(s, Statement) and isinstance(s.value, BranchOf)
        ]
        self.corners = self._corners(sides) if sides else None
        self.kernels = [*map(declare_branches, raw), *([self.corners] if self.corners else [])]
        self.size = self._extent() if any("." in name for name in chain.names) else ZERO

    def _all(self) -> list[Kernel]:
        """Return the functions of the loops in the order in which they are printed."""
        return [self._directions(), self._step(), self._rates(), self._third()]

    def _directions(self) -> Kernel:
        """Return the C function of the cosines and sines of the loops' angles, which all other functions read."""
        build = KernelBuilder(
            self.symbols,
            DIRECTIONS,
            [
                "Cosines and sines of all angles in the closures of dependent loops, stored in q after coordinates.",
            ],
        )
        build.section("directions")
        first = self.first + len(self.chain.names)
        symbols = [symbol for direction in self.chain.directions for symbol in (direction.cos, direction.sin)]
        for k, symbol in enumerate(symbols):
            build.out(Place("out")[first + k], self.symbols.definitions[symbol], symbol.name)
        return build.build((*STATE[:2], DISCRETE, PARAMETERS, result("out")), owner="")

    def _extent(self) -> sp.Expr:
        """Return the parameter that scales steps of a slide: the root of the sum of all points' squares, in m."""
        geometry, slots = self.system.model.geometry, self.system.model.slots
        ground = map(geometry.ground_vector, self.system.model.scene.mechanism.ground.values())
        squares = [x**2 for point in (*geometry.local.values(), *ground) for x in point]
        return slots.derive("extent", sp.sqrt(sp.Add(*squares)), "extent of all points")

    def _step(self) -> Kernel:
        """Return the C function of one step of Chebyshev's method towards the closures, at given coordinates."""
        build = KernelBuilder(
            self.symbols,
            STEP,
            [
                "Newton's step of the dependent coordinates, Phi_c newton = Phi, and Chebyshev's step of order 3,",
                "step = newton + bend, Phi_c bend = Phi_cc[newton, newton]/2. `row`: the number, from 1, of the row "
                "with",
                "the largest |Phi|. Returns 0, or the number of a row that depends on others here.",
            ],
        )
        build.section("closures of the chains")
        named = zip(self.square.names, self.chain.rows, strict=True)
        phi = [build.local(f"phi_{name}", row.phi) for name, row in named]
        build.section("the largest")
        build.line(LargestRow(tuple(phi)))
        solvers = self.square.factorize(build)
        build.section("Newton's step")
        newton = self.square.solve(build, solvers, phi, "newton")
        build.section("correction by the curvature of the constraints")
        bend = self.square.solve(build, solvers, [self._curvature(row, newton) / 2 for row in self.chain.rows], "bend")
        for k, (x, more) in enumerate(zip(newton, bend, strict=True)):
            build.out(Place("step")[k], x + more)
            build.out(Place("bend")[k], more)
        build.line(Return())
        outs = (result("step"), result("bend"), result("row", Number.INTEGER))
        return build.build((*STATE[:2], DISCRETE, PARAMETERS, *outs), status=True, owner="", prune=True)

    def _curvature(self, row: Row, x: Sequence[sp.Expr]) -> sp.Expr:
        """Return Φ_cc[x, x] of one constraint equation: its second derivative along the step x."""
        along = dict(zip([k.q for k in self.chain.known], x, strict=True))
        slope = sp.Add(*(entry * along[q] for q, entry in row.phi_q.items()))
        return sp.expand(sp.Add(*(self.symbols.diff(slope, q) * step for q, step in along.items())))

    def _rates(self) -> Kernel:
        """Return the C function of the first and second rates ċ, c̈ at coordinates that close the loops."""
        build = KernelBuilder(
            self.symbols,
            RATES,
            [
                "First and second rates of the dependent coordinates at positions that close their loops: "
                "Phi_c c' = nu,",
                "Phi_c c'' = gamma. They are stored after those of the other coordinates in v.",
                "Returns 0, or the number of a row that depends on others here.",
            ],
        )
        known, rows = self.chain.known, self.chain.rows
        solvers = self.square.factorize(build)
        build.section("rates")
        rates = self.square.solve(build, solvers, [row.nu for row in rows], "rate")
        for k, value in zip(known, rates, strict=True):  # by the name under which all expressions know it
            build.line(Statement(k.rate.name, value))
        for symbol in self._moving():
            build.line(Statement(symbol.name, self.symbols.definitions[symbol]))
        build.section("second rates")
        second = self.square.solve(build, solvers, [row.gamma for row in rows], "second")
        build.section("results")
        for at, (x, value) in enumerate(zip(known, second, strict=True), self.first):
            build.out(Place("v")[at], x.rate)
            build.out(Place("v")[at + len(known)], value)
        build.line(Return())
        return build.build((*STATE[:2], DISCRETE, PARAMETERS, result("v")), status=True, owner="", prune=True)

    def _third(self) -> Kernel:
        """Return the C function of the third rates, by forward differentiation: d/dt of γ − Φ_c c̈ at the same c̈."""
        build = KernelBuilder(
            self.symbols,
            THIRD,
            [
                "Third rates of the dependent coordinates: Phi_c c''' = d/dt (gamma - Phi_c c'') at the same c''.",
                "Returns 0, or the number of a row that depends on others here.",
            ],
        )
        known, t = self.chain.known, self.system.model.t
        solvers = self.square.factorize(build)
        build.section("third rates")
        tangents = Tangents(self.symbols, build, (t,))
        for k in known:
            tangents.know(k.q, {t: k.rate})
            tangents.know(k.rate, {t: k.second})
        left = [sp.Add(row.gamma, *(-row.phi_q.get(k.q, ZERO) * k.second for k in known)) for row in self.chain.rows]
        slopes = [tangents.gradient(value).get(t, ZERO) for value in left]
        for at, value in enumerate(self.square.solve(build, solvers, slopes, "third")):
            build.out(Place("out")[at], value)
        build.line(Return())
        return build.build((*STATE, DISCRETE, PARAMETERS, result("out")), status=True, owner="", prune=True)

    def _moving(self) -> list[sp.Symbol]:
        """Return the defined symbols that depend on the loops' rates but on no rate or coordinate of the system.

        Their definitions follow the computed rates instead of standing at the beginning of the function.
        """
        info, definitions = self.symbols.info, self.symbols.definitions
        moving = {k.rate for k in self.chain.known}
        others = {*self.system.v, *self.system.q}
        found = []
        for symbol in [s for s in info if s in definitions and not info[s].home]:
            reads = definitions[symbol].free_symbols
            if reads & others:
                others.add(symbol)
            elif reads & moving:
                moving.add(symbol)
                found.append(symbol)
        return [symbol for symbol in found if symbol not in others]

    def _corners(self, sides: Sequence[BranchOf]) -> Kernel:
        """Return the C function of the switching functions of the loops' drives.

        No other function evaluates these.
        """
        build = KernelBuilder(self.symbols, "loop_switches", ["Switching functions of the drives of dependent loops."])
        build.section("corners")
        for side in dict.fromkeys(sides):
            name = f"side_{side.args[0]}"
            build.line(Statement(name, side))
            build.line(Unread(name))
        kernel = build.build((*STATE[:2], DISCRETE, PARAMETERS, result("g")), owner="")
        return replace(kernel, sections=(TOLD_SIDES, *kernel.sections))

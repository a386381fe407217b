"""Pivots of a KKT system: thresholds, tests for small pivots, and which values become local variables of the C code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.ir.signatures import DISCRETE
from gudgeon.generator.ir.statements import Guard
from gudgeon.generator.ir.values import Conditional, Test, Threshold
from gudgeon.generator.symbols.symbol_sums import is_signed_symbol

ZERO = sp.Integer(0)

# A row counts as dependent when less than this fraction of its pivot is left after elimination: the fraction is the
# squared sine of the angle between the row and the others, rounding leaves some 1e-15.
SINGULAR = Threshold("SINGULAR", 1e-13)
# Below this fraction the row is nearly dependent: drift δ of the constraints would act as δ/fraction^(1/2) there.
# The rank-revealing factorization (engine/scene/singular.c) drops the row at this state if the others agree.
NEARLY_SINGULAR = Threshold("NEARLY_SINGULAR", 1e-8)
# Fraction of the size of a joint's two equations below which one of them counts as vanished. The fraction is the
# squared sine of the angle to the singular position, and within 1e-5 of it rounding errors decide.
VANISHING = Threshold("VANISHING", 1e-10)
# The same for a pair of equations eliminated before all of its coordinates: rounding grows by 1/fraction,
# and the alternative solution is exact.
EARLY = Threshold("EARLY", 1e-5)
# Fraction of the inertia about the joints that elimination must leave of an angle's entry of M: the rounding error of
# accelerations grows by the inverse of its square, from 5e-16 for a fraction of 1.
LIGHT_PIVOT = Threshold("LIGHT_PIVOT", 1e-3)
# SINGULAR and VANISHING where a run may need larger ones: the discrete state has the values
# (engine/motion/continuation.c).
RUN_SINGULAR = Threshold(NEARLY_SINGULAR.name, NEARLY_SINGULAR, DISCRETE["min_pivot"])
RUN_VANISHING = Threshold(VANISHING.name, VANISHING, DISCRETE["min_pivot_size"])


@dataclass(frozen=True)
class Factor:
    """Factorization of the KKT matrix: L by (row node, column node), D⁻¹ by nodes.

    D has blocks of one and of two nodes: two coupled nodes that follow each other need one division instead of two
    consecutive ones.
    """

    L: Mapping[tuple[int, int], sp.Expr]
    inverse: Mapping[int, Mapping[int, sp.Expr]]


def append_friction_mode(builder: KernelBuilder, name: str, index: int) -> tuple[sp.Symbol, sp.Symbol]:
    """Return two locals for the mode of a friction element: (1 at stick and else 0, sign of the slip).

    The sign is 1 or −1, and 0 without slip; both are 0 in mode 2 (held). `name`, `index`: the element and its number;
    the mode is read from the discrete state.
    """
    mode_place = DISCRETE["mode"][index]
    mode = builder.append_local(f"mode_{name}", mode_place, "0 stick, 1 or -1 the sign of the slip, 2 held")
    stick = builder.append_local(f"stick_{name}", Conditional(Test(mode, "==", (0.0,)), sp.Integer(1), ZERO))
    return stick, builder.append_local(
        f"sign_{name}", Conditional(Test(mode, ">", (1.0,), compares_magnitude=True), ZERO, mode)
    )


def make_pivot_guard(
    jumps_on_failure: bool,
    n_equations_before: int,
    pivot_number: int,
    value: sp.Expr,
    *bound_factors: sp.Expr | float,
) -> Guard:
    """Return the test that a pivot is greater than a bound, the product of `bound_factors`.

    `value`: the pivot. `pivot_number`: its number in the block, 1 or 2. If the test fails, the kernel sets the status
    to `n_equations_before` (the block) + `pivot_number`. With `jumps_on_failure` it then jumps to the code for
    dependent equations, otherwise it returns the status.
    """
    return Guard(Test(value, ">", bound_factors), n_equations_before + pivot_number, jumps_on_failure)


def is_number_or_signed_symbol(value: sp.Expr) -> bool:
    """Return whether a value is a number, a symbol or its negative, which needs no local."""
    return bool(value.is_Number) or is_signed_symbol(value)


def append_local_if_composite(builder: KernelBuilder, name: str, value: sp.Expr) -> sp.Expr:
    """Return the value as a new local of that name, or unchanged if it is a number, a symbol or its negative."""
    return value if is_number_or_signed_symbol(value) else builder.append_local(name, value)


def find_row_pairs(rows: Sequence[Row], n: int, pattern: Sequence[frozenset[int]]) -> dict[int, int]:
    """Return the pairs of successive equations of one joint that contain the same coordinates, more than two.

    The result maps the node of each equation to that of its partner. Nodes are coordinates, then from n on equations;
    `pattern` has the neighbours of each node in the graph of the KKT matrix.
    """
    partner_of_row: dict[int, int] = {}
    for node, (row, next_row) in enumerate(pairwise(rows), n):
        if (
            row.owner == next_row.owner
            and node not in partner_of_row
            and pattern[node] == pattern[node + 1]
            and len(pattern[node]) > 2
        ):
            partner_of_row |= {node: node + 1, node + 1: node}
    return partner_of_row

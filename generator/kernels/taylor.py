"""Taylor series of the motion in tree coordinates, for integration: which scenes have them, and why others do not."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import sympy as sp

from gudgeon.contract.boundary import TAYLOR_ORDERS_PER_E_FOLD, TAYLOR_TOLERANCE_RATIO
from gudgeon.errors import BadValueError
from gudgeon.generator.equations.notes import find_drives_with_jumps
from gudgeon.generator.ir.kernels import KernelBuilder, remove_unused_locals
from gudgeon.generator.ir.series import LinearSystem, Series, derive_taylor_series
from gudgeon.generator.ir.series_rules import NoTaylorSeries
from gudgeon.generator.ir.signatures import RHS
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.ir.values import Threshold
from gudgeon.generator.kernels.dynamics import make_dynamics_kernel
from gudgeon.generator.kernels.reduced import DYNAMICS, has_singular_fallback
from gudgeon.generator.reduction.reduction import TreeSystem
from gudgeon.generator.solvers.kkt import FACTORS, KKT
from gudgeon.generator.solvers.pivots import SINGULAR, VANISHING, ZERO, Factor
from gudgeon.generator.symbols.storage import StorageLocation

if TYPE_CHECKING:
    from gudgeon.generator.kernels.program import Program

NAME = "taylor"
MIN_TOL_EXPONENT, MAX_TOL_EXPONENT = 3, 14  # -log10 of the loosest and of the tightest tolerance that are compared
# -log10 of the loosest tolerance of runs that are usually single, such as references and long runs
SINGLE_RUN_EXPONENT = 10
MAX_SINGLE_RUN_TOL = 10.0 ** (0.5 - SINGLE_RUN_EXPONENT)
SINGLE_RUN_GAIN = 0.9  # there, `auto` uses the series if a single run needs less than this fraction of the time
# Step length of the series divided by that of dop853 at the tolerance 10^-MIN_TOL_EXPONENT, and the exponent of its
# growth. The step length of the series does not depend on the tolerance.
STEP_LENGTH_RATIO, STEP_LENGTH_GROWTH = 0.4, 0.1
TRANSIENT_LENGTH_FACTOR = 2.3  # on that ratio: at transient terms of time, dop853 rejects more steps
# Times in ns of a step in a single run, fitted to chains of 1 to 6 links and Andrews' squeezer: of dop853, in addition
# per closure equation and per square root of the operations of the right-hand side; of the series, in addition per
# closure equation, per order, and per order and operation
DOP853_STEP, DOP853_CLOSURE, DOP853_ROOT_OF_OPERATIONS = 750.0, 120.0, 88.0
SERIES_STEP, SERIES_CLOSURE, SERIES_ORDER, SERIES_OPERATION = 450.0, 200.0, 7.0, 0.67
# Costs of a step in eight SIMD lanes, fitted to the race for 2 and 6 links: of dop853, in addition per operation of the
# right-hand side; of the series, in addition per closure equation; per order: operations and products of the series
# per operation of the right-hand side. dop853 gains more there than in single runs.
LANES_DOP853_STEP, LANES_DOP853_OPERATION = 7700.0, 4.3
LANES_SERIES_STEP, LANES_SERIES_CLOSURE = 2900.0, 1500.0
SERIES_OPERATIONS, SERIES_PRODUCTS = 1.6, 0.32
# Functions of the state whose slope far away falls as a power of the distance, so that a series shows them there. Those
# left out, such as tanh and exp, may be constant to rounding where a step begins and act in its middle.
FUNCTIONS_SEEN_FROM_AFAR = (
    *(sp.sin, sp.cos, sp.tan, sp.asin, sp.acos, sp.atan, sp.atan2),
    *(sp.asinh, sp.acosh, sp.atanh, sp.log),
)
MAX_POWER = 4  # of the state: higher powers may vanish in rounding, and all orders of the series with them
MAX_BUNDLED_OPERATIONS = 200  # of the right-hand side: larger series are no part of the scene's library
MAX_RHS_OPERATIONS = 1500  # of larger right-hand sides the series takes too long to compile


def make_taylor_series(program: Program) -> Series:
    """Return the functions for the Taylor coefficients of accelerations and powers of a program.

    Raise BadValueError if the motion is not smooth.
    """
    try:
        return _derive_series(_get_smooth_system(program))
    except NoTaylorSeries as why:
        raise BadValueError(f"method 'taylor' needs smooth motion: {why}", hint="use auto") from None


def choose_taylor_series(program: Program) -> tuple[Series | None, float]:
    """Return the Taylor series in a program's library, and the tolerance below which `auto` integrates by series.

    The tolerance is 0.0 if `auto` always uses dop853: the motion is not smooth, or the series costs more. The series is
    None if its tolerance is at most MAX_SINGLE_RUN_TOL, so that usually only single runs need it, or if the right-hand
    side has more than MAX_BUNDLED_OPERATIONS. The returned tolerance is then at most MAX_SINGLE_RUN_TOL, and the series
    is compiled on request, as a second library of the scene: its variant NAME ("taylor").
    """
    try:
        system = _get_smooth_system(program)
        n_operations = _count_rhs_operations(program)
        tolerance = predict_crossover_tolerance(
            n_operations, len(program.integrated.system.rows), bool(program.time_terms.n_transients)
        )
        if n_operations <= MAX_BUNDLED_OPERATIONS and tolerance > MAX_SINGLE_RUN_TOL:
            return _derive_series(system), tolerance
        return None, min(tolerance, MAX_SINGLE_RUN_TOL)
    except NoTaylorSeries:
        return None, 0.0


def _count_rhs_operations(program: Program) -> int:
    """Return the number of operations of the right-hand side in tree coordinates."""
    assert program.tree
    return next(kernel.n_operations for kernel in program.tree.unvectorized_kernels if kernel.name == DYNAMICS)


def predict_crossover_tolerance(n_operations: int, n_rows: int, has_transients: bool) -> float:
    """Return the tolerance below which a cost model predicts less time for the series than for dop853; 0.0 for none.

    n_operations: of the right-hand side; n_rows: closure equations; has_transients: whether it has transient terms of
    time. From 10^-SINGLE_RUN_EXPONENT on, the ratio r_1 of the times of single runs must be below SINGLE_RUN_GAIN; also
    at looser ones with transients, which lanes do not accelerate. At other looser tolerances, at which batches are
    usual, min(1, r_1) r_8 must be below 1 with the ratio r_8 in eight lanes. The comparison is made at powers of ten
    from 10^-MIN_TOL_EXPONENT to 10^-MAX_TOL_EXPONENT. The result lies between two of them: 10^(0.5 − exponent).
    """
    tolerance = 0.0
    if n_operations > MAX_RHS_OPERATIONS:
        return tolerance
    for exponent in range(MIN_TOL_EXPONENT, MAX_TOL_EXPONENT + 1):
        single, lanes = _predict_ratios(exponent, n_operations, n_rows, has_transients)
        single_decides = has_transients or exponent >= SINGLE_RUN_EXPONENT
        is_cheaper = single < SINGLE_RUN_GAIN if single_decides else min(1.0, single) * lanes < 1.0
        tolerance = (tolerance or 10.0 ** (0.5 - exponent)) if is_cheaper else 0.0
    return tolerance


def _predict_ratios(exponent: int, n_operations: int, n_rows: int, has_transients: bool) -> tuple[float, float]:
    """Return the predicted times of the series over those of dop853 at the tolerance 10^-exponent of `auto`.

    The first is that of single runs, the second that of eight lanes. Other arguments as in
    `predict_crossover_tolerance`.
    """
    order = math.ceil(1.0 + TAYLOR_ORDERS_PER_E_FOLD * (exponent * math.log(10.0) + math.log(TAYLOR_TOLERANCE_RATIO)))
    length_ratio = STEP_LENGTH_RATIO * 10.0 ** (STEP_LENGTH_GROWTH * (exponent - MIN_TOL_EXPONENT))
    length_ratio *= TRANSIENT_LENGTH_FACTOR if has_transients else 1.0
    series = SERIES_STEP + SERIES_CLOSURE * n_rows + order * (SERIES_ORDER + SERIES_OPERATION * n_operations)
    dop853 = DOP853_STEP + DOP853_CLOSURE * n_rows + DOP853_ROOT_OF_OPERATIONS * math.sqrt(n_operations)
    lanes_series = (
        LANES_SERIES_STEP
        + LANES_SERIES_CLOSURE * n_rows
        + order * (SERIES_OPERATIONS + order * SERIES_PRODUCTS) * n_operations
    )
    lanes_dop853 = LANES_DOP853_STEP + LANES_DOP853_OPERATION * n_operations
    return series / (length_ratio * dop853), lanes_series / (length_ratio * lanes_dop853)


def _get_smooth_system(program: Program) -> TreeSystem:
    """Return the system in tree coordinates, or raise NoTaylorSeries with the first reason why it has no series.

    Reasons are play, friction that may stick, driven loops, switching points, jumps of a drive, functions of the state
    that act within a part of a step only, and that nothing is integrated.
    """
    model, tree = program.model, program.tree
    if tree is None or not program.integrates:
        raise NoTaylorSeries("the scene integrates no coordinates of a tree")
    if model.clearances:
        raise NoTaylorSeries(f"joint {model.clearances[0].name} has play, whose contacts begin and end")
    if model.frictions:
        raise NoTaylorSeries(f"the friction of {model.frictions[0].name} may stick")
    if tree.driven_loop_kernels:
        raise NoTaylorSeries("a loop is rigid, or drives determine its coordinates")
    if model.symbols.switches.count or program.integrated.system.model.symbols.switches.count:
        raise NoTaylorSeries("an expression has switching points (where, abs, min, max, sign, mod, ramp)")
    if find_drives_with_jumps(model):
        raise NoTaylorSeries("the rate of a drive may jump")
    dynamics = next(kernel for kernel in tree.unvectorized_kernels if kernel.name == DYNAMICS)
    if name := find_hidden_function(line for section in dynamics.sections for line in section.statements):
        raise NoTaylorSeries(f"{name} of coordinates or velocities may act within a part of a step only")
    return tree.system


def find_hidden_function(lines: Iterable[Instruction]) -> str:
    """Return the name of the first function of the state that a series may not show from afar; "" if there is none.

    `lines`: those of the right-hand side. A function is not shown where its value and all its derivatives are below
    rounding. FUNCTIONS_SEEN_FROM_AFAR and powers to MAX_POWER are; functions of time alone have searches of their own.
    """
    power_by_local: dict[str, float] = {}  # of locals that depend on the state; 1 for other values than powers

    def depends_on_state(value: sp.Basic) -> bool:
        """Return whether an expression contains a local that depends on the state."""
        return any(symbol.name in power_by_local for symbol in value.free_symbols)

    for line in lines:
        if not isinstance(line, Statement):
            continue
        if isinstance(line.value, StorageLocation):
            if line.value.base in ("q", "v"):
                power_by_local[line.declared_local] = 1.0
            continue
        if not depends_on_state(line.value):
            continue
        power_by_local[line.declared_local] = 1.0
        for node in sp.preorder_traversal(line.value):
            if isinstance(node, sp.Function) and depends_on_state(node):
                if not isinstance(node, FUNCTIONS_SEEN_FROM_AFAR):
                    return str(node.func.__name__)
            elif isinstance(node, sp.Pow) and depends_on_state(node):
                power = abs(node.exp) * power_by_local.get(getattr(node.base, "name", ""), 1.0)
                if not (power.is_number and power <= MAX_POWER):
                    return "a high power"
                if node == line.value:
                    power_by_local[line.declared_local] = float(power)
    return ""


def _derive_series(system: TreeSystem) -> Series:
    """Return the Taylor series of accelerations and powers, from a right-hand side derived again for it.

    The linear system of the right-hand side (KKT matrix, right-hand sides, unknowns) is passed on, so that all orders
    share its factors.
    """
    kkt = _RecordedKKT(system, allow_early_pairs=has_singular_fallback(system))
    dynamics = remove_unused_locals(
        make_dynamics_kernel(system, kkt, DYNAMICS, is_stabilized=False, append_fallback=_ignore_vanishing_pivot)
    )
    diagonal = {(k, k): system.mass[k, k] for k in range(kkt.n) if (k, k) in system.mass}
    linear = LinearSystem(FACTORS, {**kkt.entries, **diagonal}, kkt.right_hand_sides, kkt.unknowns)
    return derive_taylor_series(dynamics, _find_result_place, NAME, linear)


class _RecordedKKT(KKT):
    """A KKT system that records its right-hand sides as named locals, and the symbols of its unknowns, by node."""

    right_hand_sides: dict[str, int]
    unknowns: dict[int, sp.Symbol]

    def factorize(
        self,
        builder: KernelBuilder,
        jump_on_failure: bool = False,
        threshold: Threshold = SINGULAR,
        pair_threshold: Threshold = VANISHING,
    ) -> Factor:
        """Append the factorization of the KKT matrix, with the values of the thresholds as constants, and return it.

        Elsewhere C reads thresholds from the discrete state, which is not passed to the series. `jump_on_failure`: a
        vanishing pivot jumps to other code instead of returning its number.
        """
        threshold, pair_threshold = (Threshold(limit.name, limit) for limit in (threshold, pair_threshold))
        return super().factorize(builder, jump_on_failure, threshold, pair_threshold)

    def solve(
        self, builder: KernelBuilder, factor: Factor, b: Mapping[int, sp.Expr], prefix: str = ""
    ) -> dict[int, sp.Expr]:
        """Append the solution of the KKT system as `KKT.solve` does, and record its right-hand sides and unknowns.

        Called once per kernel of order 0; higher orders of the series follow from the record. The names of the
        right-hand sides go to `right_hand_sides`, the symbols of the unknowns to `unknowns`. Returned is the solution
        by node (number of coordinate, equation, friction). `factor`: the result of `factorize`. `b`: the right-hand
        side by node, absent ones zero; `prefix` begins the names of the locals.
        """
        builder.begin_section("right-hand side")
        right_hand_side_symbols = {
            k: builder.append_local(f"load_{self.names[k]}", b.get(k, ZERO)) for k in self.elimination.order
        }
        self.right_hand_sides = {symbol.name: k for k, symbol in right_hand_side_symbols.items()}
        x = super().solve(builder, factor, right_hand_side_symbols, prefix)
        self.unknowns = {k: symbol for k, symbol in x.items() if symbol.is_Symbol}
        return x


def _ignore_vanishing_pivot(builder: KernelBuilder) -> None:
    """Append nothing for a vanishing pivot: the `append_fallback` of `make_dynamics_kernel` for the series.

    At such a state another method takes the step.
    """


def _find_result_place(target: StorageLocation) -> StorageLocation | None:
    """Return where the functions of the series store a result: "a" unchanged, powers of `rhs` in "power".

    Return None for results that a series does not need. `target`: the storage location in the right-hand side.
    """
    match target:
        case StorageLocation("a"):
            return target
        case StorageLocation(RHS.name, ("power", int() as k)):
            return StorageLocation("power")[k]
    return None

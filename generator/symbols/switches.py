"""Switching functions: the zeros at which min, max, abs, sign, where and mod of the equations change branch.

Each switching point is the zero of a function g of the state. In emitted code its branch (the sign of g) is either
taken from g itself or frozen over a step, so that a method of high order sees a smooth right-hand side, and its
Jacobian the same branch; a zero of g then ends the step. The jumps of mod(a, b) = a − b⌊a/b⌋ at the ends of periods
are switching points too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import sympy as sp

from gudgeon.generator.symbols.curves import CurveOf, CurveOn, KnotsOf
from gudgeon.generator.symbols.derivatives import differentiate, find_operation_classes
from gudgeon.generator.symbols.storage import Freezable
from gudgeon.language.functions import mod


class _Remainder(sp.Function):
    """A remainder of a by b, with its derivative between jumps."""

    is_real = True

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the derivative by `s` between jumps: a′ − b′ ⌊a/b⌋ for the remainder of a by b.

        Called by SymPy.
        """
        a, b = self.args[:2]
        rate = differentiate(b, s)
        return differentiate(a, s) - (0 if rate == 0 else rate * (a - self) / b)


class ModOf(_Remainder):
    """ModOf(a, b): the remainder a − b⌊a/b⌋, between 0 and b, with the sign of b."""

    nargs = 2

    @classmethod
    def eval(cls, a: sp.Expr, b: sp.Expr) -> sp.Expr | None:
        """Return the remainder of two numbers, exactly or as binary64 has it; NaN for b = 0.

        Return None for other arguments, which stay unevaluated. Called by SymPy.
        """
        if not (a.is_number and b.is_number):
            return None
        if a.is_Rational and b.is_Rational and b != 0:
            return a - b * sp.floor(a / b)
        return sp.Float(mod(float(a), float(b)), 17) if b != 0 else sp.nan


class ModOn(_Remainder):
    """ModOn(a, b, side): the remainder on the periods of one frozen branch, continued beyond their ends."""

    nargs = 3


class PeriodsOf(sp.Function):
    """PeriodsOf(a, b): the switching function of mod, positive in even periods, negative in odd ones, 0 between."""

    nargs = 2
    is_real = True


class BranchOf(sp.Function):
    """BranchOf(k, g): the branch of switch k, −1 or 1 (0 only where g is 0 and no branch is frozen)."""

    nargs = 2
    is_real = True

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return 0: a branch is constant over a step."""
        return sp.Integer(0)


class Select(sp.Function):
    """Select(branch, a, b): b if the branch is below zero, else a.

    Branches are −1 or 1, as in `BranchOf`. `eval` replaces a negated branch, so that all values that depend on a branch
    read the same symbol.
    """

    nargs = 3
    is_real = True

    @classmethod
    def eval(cls, branch: sp.Expr, a: sp.Expr, b: sp.Expr) -> sp.Expr | None:
        """Return b if the branch is a number below 0, a if it is another number; `Select(s, b, a)` for `branch` = −s.

        Return None, no replacement, for all other branches. At s = 0 the replacement selects b, and so do all values
        that depend on s or −s. Called by SymPy.
        """
        if branch.is_Number:
            return b if branch < 0 else a
        return cls(-branch, b, a) if (-branch).is_Symbol else None

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the derivative by `s` on each branch, as a `Select` by the same branch.

        If both derivatives are equal, that value is returned. The derivative on the other branch may be infinite.
        Called by SymPy.
        """
        branch, a, b = self.args
        da, db = differentiate(a, s), differentiate(b, s)
        return da if da == db else Select(branch, da, db)


def select_extreme(
    arguments: Sequence[sp.Expr], find_branch: Callable[[sp.Expr], sp.Expr], is_maximum: bool
) -> sp.Expr:
    """Return the maximum (`is_maximum`) or minimum of expressions as nested conditional values (`Select`).

    `find_branch(g)` returns the branch, the sign of a switching function g, here the difference of two expressions. The
    result does not depend on the order of the arguments.
    """
    ordered = sorted(arguments, key=lambda a: (a.is_Number, str(a)))
    extreme = ordered[0]
    for argument in ordered[1:]:
        extreme = Select(find_branch(extreme - argument if is_maximum else argument - extreme), extreme, argument)
    return extreme


class BranchSign(sp.Function):
    """The sign of a difference that selects a branch: it is not part of a value and has derivative 0."""

    nargs = 1
    is_real = True


class _Extreme(sp.Function):
    """max or min while it is differentiated: its rate is that of one argument, also where several are equal."""

    is_real = True
    sympy_class: type[sp.Expr]

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the derivative by `s` of the active argument, as nested `Select` by the signs of differences.

        Called by SymPy.
        """
        slopes = {x: differentiate(x, s) for x in self.args}
        ordered = sorted(self.args, key=lambda a: (a.is_Number, str(a)))
        value, slope = ordered[0], slopes[ordered[0]]
        for argument in ordered[1:]:
            difference = value - argument if self.sympy_class is sp.Max else argument - value
            slope = slope if slope == slopes[argument] else Select(BranchSign(difference), slope, slopes[argument])
            value = type(self)(value, argument)
        return slope

    def _eval_is_nonnegative(self) -> bool | None:
        """Return whether the extreme is known to be non-negative."""
        return self.sympy_class(*self.args).is_nonnegative

    def _eval_is_positive(self) -> bool | None:
        """Return whether the extreme is known to be positive."""
        return self.sympy_class(*self.args).is_positive


class DifferentiableMax(_Extreme):
    """max while it is differentiated."""

    sympy_class = sp.Max


class DifferentiableMin(_Extreme):
    """min while it is differentiated."""

    sympy_class = sp.Min


class Magnitude(sp.Function):
    """|x| of an x that its branch keeps non-negative, except in stages beyond the switching point; never 0.

    It is the base of a power with a fractional exponent: x^1.5 would be NaN there, |x|^1.5 continues as smoothly.
    """

    nargs = 1
    is_real = True
    is_nonnegative = True

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return 1, the derivative on the active branch."""
        return sp.Integer(1)


class ComparedMagnitude(sp.Function):
    """|x| in a bound for comparisons, which is not part of the motion and has no switching point."""

    nargs = 1
    is_real = True


@dataclass(frozen=True)
class Switch:
    """One switching function g; `owner` is the joint with play that it belongs to, "" for the scene."""

    index: int
    owner: str
    g: sp.Expr


# classes whose branches are frozen over a step
_SWITCHING_CLASSES = frozenset((sp.Max, sp.Min, sp.Abs, sp.sign, sp.Heaviside, CurveOf, ModOf))


@dataclass
class Switches(Freezable):
    """The switching functions of a scene, each once."""

    switch_by_key: dict[tuple[str, sp.Expr], Switch] = field(default_factory=dict)
    unused_indices: list[int] = field(default_factory=list)  # numbers of the scene's own switches in the other table

    def copy_joint_switches(self) -> Switches:
        """Return a table with the switches of joints with play only, for other functions of the same scene.

        The switch objects are shared. The numbers of the scene's own switches are given to new ones.
        """
        joint_switches = {key: switch for key, switch in self.switch_by_key.items() if switch.owner}
        return Switches(joint_switches, sorted(switch.index for switch in self.list_switches("")))

    @property
    def count(self) -> int:
        """Return the number of switches in use: one more than the largest index."""
        return 1 + max([*(switch.index for switch in self.switch_by_key.values()), *self.unused_indices], default=-1)

    def find_switch(self, owner: str, g: sp.Expr) -> tuple[Switch, int] | None:
        """Return (switch, 1) of a switching function g, or (switch, −1) if it is stored for −g; None if there is none.

        `owner`: the joint with play to which it belongs, "" for the scene.
        """
        for sign in (1, -1):
            if (switch := self.switch_by_key.get((owner, sp.expand(sign * g)))) is not None:
                return switch, sign
        return None

    def get_or_add_switch(self, owner: str, g: sp.Expr) -> tuple[Switch, int]:
        """Return (switch, 1) of a switching function g, or (switch, −1) if it is stored for −g.

        A new switch is added if there is none; a frozen table raises AssertionError. `owner`: the joint with play to
        which it belongs, "" for the scene.
        """
        if (known_switch := self.find_switch(owner, g)) is not None:
            return known_switch
        assert not self.frozen, f"{g}: a switching point after the tables were frozen"
        switch = Switch(self.unused_indices.pop(0) if self.unused_indices and not owner else self.count, owner, g)
        self.switch_by_key[owner, sp.expand(g)] = switch
        return switch, 1

    def list_switches(self, owner: str) -> list[Switch]:
        """Return the switches of one joint with play, or of the scene (owner "").

        They are in the order in which they were added.
        """
        return [switch for switch in self.switch_by_key.values() if switch.owner == owner]

    def freeze_branches(
        self, expression: sp.Expr, owner: str, branches: dict[sp.Symbol, sp.Expr], registered_only: bool = False
    ) -> sp.Expr:
        """Return an expression in which max, min, abs, sign, Heaviside, curves and mod use frozen branches.

        Each branch is a symbol `side_<k>`; `branches` is extended in place by these symbols with their `BranchOf`.
        `owner`: joint with play, or "". `registered_only`: switching functions without a switch stay as they are, for a
        function next to the one that writes all of them.
        """
        if _SWITCHING_CLASSES.isdisjoint(find_operation_classes(expression)):
            return expression
        arguments = [self.freeze_branches(a, owner, branches, registered_only) for a in expression.args]

        def make_branch_symbol(g: sp.Expr) -> sp.Expr:
            """Return the symbol of the branch of g with its sign, and register it.

            With `registered_only`, a g without a switch gives sign(g).
            """
            if registered_only and self.find_switch(owner, g) is None:
                return sp.sign(g)
            switch, sign = self.get_or_add_switch(owner, g)
            symbol = sp.Symbol(f"side_{switch.index}", real=True)
            branches.setdefault(symbol, BranchOf(sp.Integer(switch.index), switch.g))
            return sign * symbol

        match expression:
            case CurveOf() if arguments[2].free_symbols:
                knots = KnotsOf(arguments[0], arguments[2])
                is_known = not registered_only or self.find_switch(owner, knots) is not None
                return CurveOn(*arguments, make_branch_symbol(knots)) if is_known else CurveOf(*arguments)
            case ModOf():
                periods = PeriodsOf(*arguments)
                is_known = not registered_only or self.find_switch(owner, periods) is not None
                return ModOn(*arguments, make_branch_symbol(periods)) if is_known else ModOf(*arguments)
            case sp.Abs():
                return make_branch_symbol(arguments[0]) * arguments[0]
            case sp.sign():
                return make_branch_symbol(arguments[0])
            case sp.Heaviside():
                return Select(make_branch_symbol(arguments[0]), sp.Integer(1), sp.Integer(0))
            case sp.Max() | sp.Min():
                return select_extreme(arguments, make_branch_symbol, is_maximum=isinstance(expression, sp.Max))
            case sp.Pow() if not expression.exp.is_integer and arguments[0] != expression.base:
                # a base that may be negative gives NaN there, and must not become a number
                base = Magnitude(arguments[0]) if expression.base.is_nonnegative else arguments[0]
                return base ** arguments[1]
        return expression.func(*arguments)

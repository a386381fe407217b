"""Terms of the equations that hang on time alone and may rise and fall between two looks: pulses, narrow bumps.

A step of a method sees forces and drives at its stages only. Polynomials, sines and exponentials of a linear argument
show there what they do; e^(−t²), 1/(1 + t²), tanh t or a sine of a sine may be at rest at all of them and act in
between. While friction sticks, or a rigid contact is closed, nothing may move, steps are long, and sines are among
those too. Such terms are known without the state, and so are their bounds over a part of a step
(engine/watch/time_terms.c, ranges.h).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.ir.finite_slopes import as_written
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.signatures import ASIDE, PARAMETERS, TIME
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.symbols.corners import Pick, SideOf
from gudgeon.generator.symbols.periods import ModOn, PeriodsOf
from gudgeon.generator.symbols.storage import Place
from gudgeon.generator.symbols.wholes import Whole

NAME = "time_terms"
MOST = 32  # terms of a scene
_DOC = ("Terms that hang on time alone and may rise and fall within a step.",)
_LINEAR = (sp.sin, sp.cos, sp.exp)  # what shows at the stages of a step, of a linear argument
_POWERS = range(1, 5)  # likewise, of what does


@dataclass(frozen=True)
class TimeTerms:
    """Terms of time alone: the first `pulses` of them may hide within a step of any motion, all within one of rest."""

    kernel: Kernel | None = None  # None: there are none
    pulses: int = 0

    @property
    def count(self) -> int:
        """How many there are."""
        statements = [s for section in self.kernel.sections for s in section.statements] if self.kernel else []
        return sum(isinstance(s, Statement) and not s.defines for s in statements)


def time_terms(dynamics: Kernel, rests: bool) -> TimeTerms:
    """What a right-hand side reads of time alone. rests: something may hold the motion while forces vary."""
    found = _read(dynamics, False)
    terms = list(found.terms)[:MOST]
    pulses = len(terms)
    if rests:
        found = _read(dynamics, True)
        terms = [*terms, *(term for term in found.terms if term not in terms)][:MOST]
    return TimeTerms(_kernel(dynamics, found, terms) if terms else None, pulses)


def _read(dynamics: Kernel, rests: bool) -> _Terms:
    found = _Terms(rests)
    for section in dynamics.sections:
        for statement in section.statements:
            if isinstance(statement, Statement):
                found.read(statement)
    return found


def _kernel(dynamics: Kernel, found: _Terms, terms: list[sp.Expr]) -> Kernel:
    outs = [Statement(Place("out")[k], term) for k, term in enumerate(terms)]
    sections = (Section("parameters and time", tuple(found.needed(terms))), Section("terms", tuple(outs)))
    arguments = (TIME, PARAMETERS, ASIDE)
    return replace(dynamics, name=NAME, doc=_DOC, arguments=arguments, sections=sections, status=False)


class _Terms:
    """Reads statements in their order; `terms` are in the order in which they are met."""

    def __init__(self, rests: bool) -> None:
        self.shows = (PeriodsOf, sp.exp) if rests else (PeriodsOf, *_LINEAR)
        self.known: dict[str, Statement] = {}  # locals that time and parameters determine
        self.timed: dict[str, sp.Expr] = {}  # those of them that hang on time, written out
        self.terms: dict[sp.Expr, None] = {}
        self.time = TIME.name
        self._tame: dict[sp.Expr, bool] = {}  # parts recur in the derivatives of what is nested
        self._names: dict[sp.Expr, frozenset[str]] = {}

    def read(self, statement: Statement) -> None:
        if isinstance(statement.value, sp.Expr):
            statement = replace(statement, value=as_written(statement.value))
        value, local = statement.value, statement.defines
        if not isinstance(value, sp.Basic):
            if local and isinstance(value, Place) and value.base in (TIME.name, PARAMETERS.name):
                self.known[local] = statement
            if value == Place(TIME.name):
                self.time = local
            return
        names = {symbol.name for symbol in value.free_symbols}
        if names <= self.known.keys():
            if local:
                self.known[local] = statement
            self.collect(value)
        else:
            for part in sp.preorder_traversal(value):
                if isinstance(part, (sp.Add, sp.Mul)):
                    part = part.func(*(factor for factor in part.args if self.is_timed(factor)))
                if isinstance(part, sp.Expr):
                    self.collect(part)
        if local in self.known and self.is_timed(value):
            self.timed[local] = self.written_out(value)

    def written_out(self, value: sp.Expr) -> sp.Expr:
        """With the locals that hang on time as what they are."""
        if self.names_in(value).isdisjoint(self.timed):
            return value
        inner = {s: self.timed[s.name] for s in value.free_symbols if s.name in self.timed}
        return value.xreplace(inner) if inner else value

    def names_in(self, value: sp.Expr) -> frozenset[str]:
        """Of its symbols; each part is looked at once."""
        if value not in self._names:
            parts = (self.names_in(part) for part in value.args)
            self._names[value] = frozenset({value.name}) if value.is_Symbol else frozenset().union(*parts)
        return self._names[value]

    def is_timed(self, value: sp.Expr) -> bool:
        """Whether it hangs on time, and on nothing but time and parameters."""
        names = self.names_in(value)
        return names <= self.known.keys() and (self.time in names or not names.isdisjoint(self.timed))

    def collect(self, value: sp.Expr) -> None:
        """The terms of a value, and those within them."""
        if not self.is_timed(value) or self.is_tame(value):
            return
        if isinstance(value, SideOf):
            return self.collect(value.args[1])
        parts = [part for part in value.args if self.is_timed(part) and not self.is_tame(part)]
        if isinstance(value, (sp.Add, sp.Mul, Pick, Whole)):
            if len(parts) > 1 and not isinstance(value, (Pick, Whole)):
                self.terms.setdefault(value.func(*parts))
        elif not value.is_Symbol:
            self.terms.setdefault(value)
        for part in parts:
            self.collect(part)
        return None

    def is_tame(self, value: sp.Expr) -> bool:
        """Whether it shows at the stages what it does between them. Corners end steps: their branches count."""
        if value not in self._tame:
            self._tame[value] = self._is_tame(self.written_out(value))
        return self._tame[value]

    def _is_tame(self, value: sp.Expr) -> bool:
        if self.time not in self.names_in(value):
            return True
        match value:
            case sp.Symbol():
                return True
            case SideOf():
                return self.is_tame(value.args[1])
            case sp.Add() | sp.Mul() | Pick() | Whole() | ModOn():
                return all(map(self.is_tame, value.args))
            case sp.Pow() if value.exp.is_Integer and int(value.exp) in _POWERS:
                return self.is_tame(value.base)
        return isinstance(value, self.shows) and self.is_linear(value.args[0])

    def is_linear(self, value: sp.Expr) -> bool:
        """Whether its form says that it is linear in time."""
        timed = [part for part in value.args if self.time in self.names_in(part)]
        if isinstance(value, (sp.Add, sp.Mul)):
            return (len(timed) < 2 or isinstance(value, sp.Add)) and all(map(self.is_linear, timed))
        return value.is_Symbol or not timed

    def needed(self, terms: list[sp.Expr]) -> list[Statement]:
        """The locals that the terms read, in their order."""
        waiting = [s.name for term in terms for s in term.free_symbols]
        read: set[str] = set()
        while waiting:
            name = waiting.pop()
            if name in self.known and name not in read:
                read.add(name)
                value = self.known[name].value
                waiting += [s.name for s in value.free_symbols] if isinstance(value, sp.Expr) else []
        return [_unheld(s) for name, s in self.known.items() if name in read]


def _unheld(statement: Statement) -> Statement:
    """A side as its function has it over a range: nothing is held where time alone is looked at."""
    if isinstance(statement.value, SideOf):
        return replace(statement, value=sp.sign(statement.value.args[1]))
    return statement

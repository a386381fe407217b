"""Event functions and transients of a scene, as functions of their own that the step search evaluates.

Event functions are the switching functions of the scene and the events of the user. Each is evaluated along a step
apart from the rest of the right-hand side, by bounds over parts of the step (engine/watch/watched.c): an expression
may change its sign many times in one step. The function printed here is the part of the right-hand side that they
need: mostly no more than the positions in them.
Transients (pulses) are terms that depend on time alone and may rise and fall between two stages of a step.
Polynomials, sines and exponentials of a linear argument show at the stages what they do between them. e^(−t²),
1/(1 + t²), tanh t or a sine of a sine may be at rest at all stages and act in between. While friction sticks or a
rigid contact is closed, steps may be long, so that sines count as transients too. Bounds of these terms over a part
of a step need no state (engine/watch/time_terms.c, ranges.h).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.finite_slopes import as_written
from gudgeon.generator.ir.kernels import Kernel, Section, declare_branches
from gudgeon.generator.ir.signatures import PARAMETERS, RHS, TIME
from gudgeon.generator.ir.statements import Branches, Line, Statement
from gudgeon.generator.symbols.storage import Place
from gudgeon.generator.symbols.switches import BranchOf, ModOn, PeriodsOf, Pick
from gudgeon.generator.symbols.unevaluated import Whole

WATCHED, _RANGES = "watched_functions", "watched_ranges"
_WATCHED_DOC = ("Event functions: the scene's own switching functions in rhs->g, the user's events in rhs->event.",)
_RANGES_DOC = ("Ranges of the scene's own switching functions and of the user's events over ranges of t, q and v.",)
_KNOWN_LATE = RHS.name  # what reads this is known only once forces or accelerations are


def event_function_kernel(dynamics: Kernel, model: Model, loop_switches: Kernel | None = None) -> Kernel | None:
    """Return the C function that evaluates the event functions alone; None if they depend on forces.

    It is the part of the right-hand side `dynamics` that the switching functions and user events read.
    `loop_switches`: the function of the switching functions of kinematically determined loops, which `dynamics` lacks.
    """
    corners = {switch.index for switch in model.symbols.switches.of("")}
    if not corners and not model.events:
        return None
    every = _merge_sections(loop_switches, dynamics)
    outs = {
        s: out
        for section in every
        for s in section.statements
        if isinstance(s, Statement) and (out := _output_statement(s, corners))
    }
    by_target = {
        s.defines: s for section in every for s in section.statements if isinstance(s, Statement) and s.defines
    }
    read: set[Statement] = set()
    waiting = list(outs.values())
    while waiting:
        found = {by_target[name] for name in waiting.pop().reads if name in by_target} - read
        read |= found
        waiting += found
    if any(_KNOWN_LATE in s.reads for s in read):
        return None
    sections = []
    for section in every:
        lines: list[Line] = []
        for s in section.statements:
            if isinstance(s, Statement):
                lines += [line for line in (s if s in read else None, outs.get(s)) if line]
        if lines:
            sections.append(Section(section.title, tuple(lines)))
    arguments = tuple(a for a in dynamics.arguments if a.name != "a")
    named = replace(dynamics, name=WATCHED, doc=_WATCHED_DOC)
    watched = replace(named, arguments=arguments, sections=tuple(sections), status=False)
    return declare_branches(watched, "rhs")


def _merge_sections(*kernels: Kernel | None) -> list[Section]:
    """Return the sections of several functions of one scene one after the other, each local defined once."""
    known: set[str] = set()
    merged = []
    for kernel in kernels:
        for section in kernel.sections if kernel else ():
            new = tuple(line for line in section.statements if line.defines not in known)
            merged.append(Section(section.title, new))
        known |= {line.defines for section in merged for line in section.statements if line.defines}
    return merged


def ranges_kernel(watched: Kernel, corners: Sequence[int], events: int) -> Kernel:
    """Return the C function of the ranges of all event functions over ranges of t, q and v.

    `watched`: the function of their values. Switching functions are written to `out` first, then `events` user events.
    """
    place: dict[Place, int] = {RHS["g"][k]: i for i, k in enumerate(corners)}
    place |= {RHS["event"][k]: i for k, i in enumerate(range(len(corners), len(corners) + events))}
    sections = []
    for section in watched.sections:
        kept: list[Line] = []
        for s in section.statements:
            if isinstance(s, Statement) and isinstance(s.target, Place):
                s = replace(s, target=Place("out")[place[s.target]])
            kept.append(Branches("") if isinstance(s, Branches) else s)
        sections.append(Section(section.title, tuple(kept)))
    return replace(watched, name=_RANGES, doc=_RANGES_DOC, sections=tuple(s for s in sections if s.statements))


def depends_on_state(kernel: Kernel) -> bool:
    """Return whether a function depends on the state, not on time and parameters only."""
    return reads_coordinate_beyond(kernel, 0)


def reads_coordinate_beyond(kernel: Kernel, count: int) -> bool:
    """Return whether a function reads a coordinate with an index of `count` or more, or the rate of one."""
    values = [s.value for section in kernel.sections for s in section.statements if isinstance(s, Statement)]
    places = [value for value in values if isinstance(value, Place) and value.base in ("q", "v")]
    return any(place.path >= (count,) for place in places)


def _output_statement(statement: Statement, corners: Collection[int]) -> Statement | None:
    """Return the statement that writes an event function if `statement` computes one, else None."""
    value = statement.value
    if isinstance(value, BranchOf) and int(value.args[0]) in corners:
        return Statement(RHS["g"][int(value.args[0])], value.args[1])
    target = statement.target
    return statement if isinstance(target, Place) and target.path[:1] == ("event",) else None


_TIME_TERMS = "time_terms"
MAX_TIME_TERMS = 32  # terms of a scene
_TIME_TERMS_DOC = ("Terms that depend on time alone and may rise and fall within a step (transients).",)
_LINEAR = (sp.sin, sp.cos, sp.exp)  # what shows at the stages of a step, of a linear argument
_POWERS = range(1, 5)  # likewise, of what does


@dataclass(frozen=True)
class TimeTerms:
    """Terms of time alone that may be transients. The first `pulses` may hide within a step of any motion.

    The others may do so only in steps during which the mechanism may be at rest.
    """

    kernel: Kernel | None = None  # None: there are none
    pulses: int = 0

    @property
    def count(self) -> int:
        """Return the number of terms."""
        statements = [s for section in self.kernel.sections for s in section.statements] if self.kernel else []
        return sum(isinstance(s, Statement) and not s.defines for s in statements)


def time_terms(dynamics: Kernel, rests: bool) -> TimeTerms:
    """Return the terms of time alone, read by a right-hand side, that the stages of a step may miss.

    rests: stick or a rigid contact may hold the motion while forces vary, so that sines count too.
    """
    found = _collect_terms(dynamics, False)
    terms = list(found.terms)[:MAX_TIME_TERMS]
    pulses = len(terms)
    if rests:
        found = _collect_terms(dynamics, True)
        terms = [*terms, *(term for term in found.terms if term not in terms)][:MAX_TIME_TERMS]
    return TimeTerms(_terms_kernel(dynamics, found, terms) if terms else None, pulses)


def _collect_terms(dynamics: Kernel, rests: bool) -> _TermCollector:
    """Return the reader of terms after it has read all statements of a right-hand side."""
    found = _TermCollector(rests)
    for section in dynamics.sections:
        for statement in section.statements:
            if isinstance(statement, Statement):
                found.read(statement)
    return found


def _terms_kernel(dynamics: Kernel, found: _TermCollector, terms: list[sp.Expr]) -> Kernel:
    """Return the C function that evaluates the collected terms at a time."""
    outs = [Statement(Place("out")[k], term) for k, term in enumerate(terms)]
    sections = (Section("parameters and time", tuple(found.needed(terms))), Section("terms", tuple(outs)))
    arguments = (TIME, PARAMETERS, RHS)
    named = replace(dynamics, name=_TIME_TERMS, doc=_TIME_TERMS_DOC)
    return replace(named, arguments=arguments, sections=sections, status=False)


class _TermCollector:
    """Collector of terms of time alone from statements; `terms` keeps the order in which they are found."""

    def __init__(self, rests: bool) -> None:
        """Begin without terms; with `rests`, sines and cosines count as terms too, exponentials do not."""
        self.shows = (PeriodsOf, sp.exp) if rests else (PeriodsOf, *_LINEAR)
        self.known: dict[str, Statement] = {}  # locals that time and parameters determine
        self.timed: dict[str, sp.Expr] = {}  # those of them that depend on time, with definitions inserted
        self.terms: dict[sp.Expr, None] = {}
        self.time = TIME.name
        self._tame: dict[sp.Expr, bool] = {}  # parts recur in the derivatives of what is nested
        self._names: dict[sp.Expr, frozenset[str]] = {}

    def read(self, statement: Statement) -> None:
        """Collect the terms of time in one statement; note whether its local depends on time and parameters alone."""
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
        """Return the expression with the locals that depend on time replaced by their definitions."""
        if self.names_in(value).isdisjoint(self.timed):
            return value
        inner = {s: self.timed[s.name] for s in value.free_symbols if s.name in self.timed}
        return value.xreplace(inner) if inner else value

    def names_in(self, value: sp.Expr) -> frozenset[str]:
        """Return the names of the symbols in an expression; the result is cached for each subexpression."""
        if value not in self._names:
            parts = (self.names_in(part) for part in value.args)
            self._names[value] = frozenset({value.name}) if value.is_Symbol else frozenset().union(*parts)
        return self._names[value]

    def is_timed(self, value: sp.Expr) -> bool:
        """Return whether an expression depends on time, and on nothing but time and parameters."""
        names = self.names_in(value)
        return names <= self.known.keys() and (self.time in names or not names.isdisjoint(self.timed))

    def collect(self, value: sp.Expr) -> None:
        """Add the terms of an expression that stages may miss, and such terms within them."""
        if not self.is_timed(value) or self.is_tame(value):
            return
        if isinstance(value, BranchOf):
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
        """Return whether the stages of a step show what an expression does between them.

        Steps end at switching points, so that each branch counts by itself.
        """
        if value not in self._tame:
            self._tame[value] = self._is_tame(self.written_out(value))
        return self._tame[value]

    def _is_tame(self, value: sp.Expr) -> bool:
        """Return is_tame of an expression without looking it up in the cache."""
        if self.time not in self.names_in(value):
            return True
        match value:
            case sp.Symbol():
                return True
            case BranchOf():
                return self.is_tame(value.args[1])
            case sp.Add() | sp.Mul() | Pick() | Whole() | ModOn():
                return all(map(self.is_tame, value.args))
            case sp.Pow() if value.exp.is_Integer and int(value.exp) in _POWERS:
                return self.is_tame(value.base)
        return isinstance(value, self.shows) and self.is_linear(value.args[0])

    def is_linear(self, value: sp.Expr) -> bool:
        """Return whether the form of an expression shows that it is linear in time."""
        timed = [part for part in value.args if self.time in self.names_in(part)]
        if isinstance(value, (sp.Add, sp.Mul)):
            return (len(timed) < 2 or isinstance(value, sp.Add)) and all(map(self.is_linear, timed))
        return value.is_Symbol or not timed

    def needed(self, terms: list[sp.Expr]) -> list[Statement]:
        """Return the definitions of the locals that the terms read, in their order."""
        waiting = [s.name for term in terms for s in term.free_symbols]
        read: set[str] = set()
        while waiting:
            name = waiting.pop()
            if name in self.known and name not in read:
                read.add(name)
                value = self.known[name].value
                waiting += [s.name for s in value.free_symbols] if isinstance(value, sp.Expr) else []
        return [_without_held_branch(s) for name, s in self.known.items() if name in read]


def _without_held_branch(statement: Statement) -> Statement:
    """Return a statement whose branch follows the sign of its switching function instead of the held branch.

    Over a range of time no branch is held.
    """
    if isinstance(statement.value, BranchOf):
        return replace(statement, value=sp.sign(statement.value.args[1]))
    return statement


_JUMPS_DOC = ("Switching functions that depend on time alone.",)

"""Event functions and transients of a scene, evaluated separately in the search for events in a step.

Event functions are the switching functions of the scene and the events of the user. Each is evaluated along a step
separately from the right-hand side, by bounds over parts of the step (engine/watch/watched.c): an expression may
change its sign many times in one step. The kernel made here is the part of the right-hand side that they need (program
slicing), usually only positions. Transients (pulses) are terms that depend on time alone and may rise and fall between
two stages of a step. The stages resolve polynomials, sines and exponentials of a linear argument. They may miss
e^(−t²), 1/(1 + t²), tanh t or a sine of a sine, which may be constant at all stages and act in between. While friction
sticks or a rigid contact is closed, steps may be long, so that sines count as transients too. Bounds of these terms
over a part of a step need no state (engine/watch/time_terms.c, ranges.h).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.finite_slopes import convert_to_heaviside_form
from gudgeon.generator.ir.kernels import Kernel, Section, declare_branches
from gudgeon.generator.ir.signatures import PARAMETERS, RHS, TIME
from gudgeon.generator.ir.statements import DeclareBranches, Instruction, Statement
from gudgeon.generator.symbols.derivatives import find_symbols
from gudgeon.generator.symbols.storage import StorageLocation
from gudgeon.generator.symbols.switches import BranchOf, ModOn, PeriodsOf, Select
from gudgeon.generator.symbols.unevaluated import Unevaluated

EVENT_FUNCTIONS, _RANGES = "monitored_functions", "bound_monitored_functions"
_EVENT_FUNCTIONS_DOC = (
    "Event functions: the scene's own switching functions in rhs->g, the user's events in rhs->event.",
)
_RANGES_DOC = ("Ranges of the scene's own switching functions and of the user's events over ranges of t, q and v.",)
_FORCE_OUTPUTS = RHS.name  # a statement that reads it depends on forces or accelerations


def make_event_function_kernel(dynamics: Kernel, model: Model, loop_switches: Kernel | None = None) -> Kernel | None:
    """Return the kernel that evaluates the event functions alone; None if there are none or one depends on forces.

    It is the part (slice) of the right-hand side `dynamics` that the scene's own switching functions and user events
    read. Switches of joints with play are excluded. `loop_switches`: the kernel of the switching functions of driven
    loops, which `dynamics` lacks, or None.
    """
    switch_indices = {switch.index for switch in model.symbols.switches.list_switches("")}
    if not switch_indices and not model.events:
        return None
    sections_in = _merge_sections(loop_switches, dynamics)
    output_by_statement = {
        statement: output
        for section in sections_in
        for statement in section.statements
        if isinstance(statement, Statement) and (output := _make_output_statement(statement, switch_indices))
    }
    statement_by_local = {
        statement.declared_local: statement
        for section in sections_in
        for statement in section.statements
        if isinstance(statement, Statement) and statement.declared_local
    }
    needed_statements: set[Statement] = set()
    pending = list(output_by_statement.values())
    while pending:
        new = {
            statement_by_local[name] for name in pending.pop().reads if name in statement_by_local
        } - needed_statements
        needed_statements |= new
        pending += new
    if any(_FORCE_OUTPUTS in statement.reads for statement in needed_statements):
        return None
    sections = []
    for section in sections_in:
        lines: list[Instruction] = []
        for statement in section.statements:
            if isinstance(statement, Statement):
                lines += [
                    line
                    for line in (
                        statement if statement in needed_statements else None,
                        output_by_statement.get(statement),
                    )
                    if line
                ]
        if lines:
            sections.append(Section(section.title, tuple(lines)))
    arguments = tuple(argument for argument in dynamics.arguments if argument.name != "a")
    renamed = replace(dynamics, name=EVENT_FUNCTIONS, doc=_EVENT_FUNCTIONS_DOC)
    watched = replace(renamed, arguments=arguments, sections=tuple(sections), status=False)
    return declare_branches(watched, "rhs")


def _merge_sections(*kernels: Kernel | None) -> list[Section]:
    """Return the sections of several functions of one scene, one after the other.

    A local that an earlier function defines is not defined again. None stands for a missing function.
    """
    defined_names: set[str] = set()
    merged = []
    for kernel in kernels:
        for section in kernel.sections if kernel else ():
            lines = tuple(line for line in section.statements if line.declared_local not in defined_names)
            merged.append(Section(section.title, lines))
        defined_names |= {
            line.declared_local for section in merged for line in section.statements if line.declared_local
        }
    return merged


def make_ranges_kernel(event_kernel: Kernel, switch_indices: Sequence[int], n_events: int) -> Kernel:
    """Return the kernel of the ranges of all event functions over ranges of t, q and v (interval arithmetic).

    `event_kernel`: the function of their values; `switch_indices`: the numbers of the switching functions. These are
    written to `out` first, in this order, then `n_events` user events.
    """
    output_index: dict[StorageLocation, int] = {RHS["g"][k]: index for index, k in enumerate(switch_indices)}
    output_index |= {
        RHS["event"][k]: index for k, index in enumerate(range(len(switch_indices), len(switch_indices) + n_events))
    }
    sections = []
    for section in event_kernel.sections:
        lines: list[Instruction] = []
        for statement in section.statements:
            if isinstance(statement, Statement) and isinstance(statement.target, StorageLocation):
                statement = replace(statement, target=StorageLocation("out")[output_index[statement.target]])
            lines.append(DeclareBranches("") if isinstance(statement, DeclareBranches) else statement)
        sections.append(Section(section.title, tuple(lines)))
    return replace(
        event_kernel,
        name=_RANGES,
        doc=_RANGES_DOC,
        sections=tuple(statement for statement in sections if statement.statements),
    )


def depends_on_state(kernel: Kernel) -> bool:
    """Return whether a function reads any coordinate or rate, not only time and parameters."""
    return reads_coordinate_from_index(kernel, 0)


def reads_coordinate_from_index(kernel: Kernel, first_index: int) -> bool:
    """Return whether a kernel copies an element of q or v with an index of at least `first_index` to a local."""
    values = [
        statement.value
        for section in kernel.sections
        for statement in section.statements
        if isinstance(statement, Statement)
    ]
    places = [value for value in values if isinstance(value, StorageLocation) and value.base in ("q", "v")]
    return any(place.path >= (first_index,) for place in places)


def _make_output_statement(statement: Statement, switch_indices: Collection[int]) -> Statement | None:
    """Return the statement that writes an event function to `rhs` if `statement` computes one, else None.

    A statement that reads the branch of a switching function gives that function's value; the store of a user event
    stays as it is. `switch_indices`: the numbers of the scene's own switches.
    """
    value = statement.value
    if isinstance(value, BranchOf) and int(value.args[0]) in switch_indices:
        return Statement(RHS["g"][int(value.args[0])], value.args[1])
    target = statement.target
    return statement if isinstance(target, StorageLocation) and target.path[:1] == ("event",) else None


_TIME_TERMS = "time_terms"
MAX_TIME_TERMS = 32  # terms of a scene
_TIME_TERMS_DOC = ("Terms that depend on time alone and may rise and fall within a step (transients).",)
_LINEAR = (sp.sin, sp.cos, sp.exp)  # what shows at the stages of a step, of a linear argument
_POWERS = range(1, 5)  # likewise, of what does


@dataclass(frozen=True)
class TimeTerms:
    """Terms of time alone that may be transients. The first `n_transients` may hide within a step of any motion.

    The others may do so only in steps during which the mechanism may be at rest.
    """

    kernel: Kernel | None = None  # None: there are none
    n_transients: int = 0

    @property
    def count(self) -> int:
        """Return the number of terms that the function evaluates; 0 without a function."""
        statements = [s for section in self.kernel.sections for s in section.statements] if self.kernel else []
        return sum(isinstance(s, Statement) and not s.declared_local for s in statements)


def find_time_terms(dynamics: Kernel, motion_may_stop: bool) -> TimeTerms:
    """Return the terms of time alone, read by a right-hand side, that the stages of a step may miss (transients).

    `motion_may_stop`: stick or a rigid contact may hold the motion while forces vary. Sines and cosines then count too;
    they come after the others. The result holds the number of the others, `n_transients`, and the kernel of the first
    MAX_TIME_TERMS terms, None if there are no terms.
    """
    collector = _collect_time_terms(dynamics, False)
    terms = list(collector.terms)[:MAX_TIME_TERMS]
    n_transients = len(terms)
    if motion_may_stop:
        collector = _collect_time_terms(dynamics, True)
        terms = [*terms, *(term for term in collector.terms if term not in terms)][:MAX_TIME_TERMS]
    return TimeTerms(_make_time_terms_kernel(dynamics, collector, terms) if terms else None, n_transients)


def _collect_time_terms(dynamics: Kernel, motion_may_stop: bool) -> _TermCollector:
    """Return the collector of terms of time alone after it has read all statements of a right-hand side.

    `motion_may_stop`: sines and cosines count as terms too (`find_time_terms`).
    """
    collector = _TermCollector(motion_may_stop)
    for section in dynamics.sections:
        for statement in section.statements:
            if isinstance(statement, Statement):
                collector.read_statement(statement)
    return collector


def _make_time_terms_kernel(dynamics: Kernel, collector: _TermCollector, terms: list[sp.Expr]) -> Kernel:
    """Return the kernel (arguments t, p, rhs) that evaluates the collected terms of time alone into `out`.

    `dynamics` supplies the other attributes of the kernel.
    """
    stores = [Statement(StorageLocation("out")[k], term) for k, term in enumerate(terms)]
    sections = (
        Section("parameters and time", tuple(collector.list_needed_definitions(terms))),
        Section("terms", tuple(stores)),
    )
    arguments = (TIME, PARAMETERS, RHS)
    renamed = replace(dynamics, name=_TIME_TERMS, doc=_TIME_TERMS_DOC)
    return replace(renamed, arguments=arguments, sections=sections, status=False)


class _TermCollector:
    """Collector of terms of time alone from statements; `terms` keeps the order in which they are found."""

    def __init__(self, motion_may_stop: bool) -> None:
        """Begin without terms and known locals.

        With `motion_may_stop`, sines and cosines count as terms too, also of a linear argument.
        """
        self.resolved_functions = (PeriodsOf, sp.exp) if motion_may_stop else (PeriodsOf, *_LINEAR)
        self.known: dict[str, Statement] = {}  # locals that time and parameters determine
        self.definition_by_local: dict[
            str, sp.Expr
        ] = {}  # those of them that depend on time, with definitions inserted
        self.terms: dict[sp.Expr, None] = {}
        self.time = TIME.name
        self._is_resolved: dict[sp.Expr, bool] = {}  # parts recur in the derivatives of what is nested
        self._names: dict[sp.Expr, frozenset[str]] = {}

    def read_statement(self, statement: Statement) -> None:
        """Add the terms of time in one statement to `terms`, and record a local that time and parameters determine.

        Such a local is stored in `known`, and if it depends on time in `definition_by_local`. A value that also depends
        on the state contributes those of its parts that do not. A value that is read from an array is recorded only if
        the array is the time or the parameters. Statements must come in the order of the function.
        """
        if isinstance(statement.value, sp.Expr):
            converted = convert_to_heaviside_form(statement.value)
            statement = statement if converted is statement.value else replace(statement, value=converted)
        value, local = statement.value, statement.declared_local
        if not isinstance(value, sp.Basic):
            if local and isinstance(value, StorageLocation) and value.base in (TIME.name, PARAMETERS.name):
                self.known[local] = statement
            if value == StorageLocation(TIME.name):
                self.time = local
            return
        names = {symbol.name for symbol in find_symbols(value)}
        if names <= self.known.keys():
            if local:
                self.known[local] = statement
            self.collect_terms(value)
        elif self.time in names or not names.isdisjoint(self.definition_by_local):
            for part in sp.preorder_traversal(value):
                if isinstance(part, (sp.Add, sp.Mul)):
                    part = part.func(*(factor for factor in part.args if self.depends_on_time_only(factor)))
                if isinstance(part, sp.Expr):
                    self.collect_terms(part)
        if local in self.known and self.depends_on_time_only(value):
            self.definition_by_local[local] = self.insert_time_definitions(value)

    def insert_time_definitions(self, expression: sp.Expr) -> sp.Expr:
        """Return the expression with each local that depends on time alone replaced by its definition."""
        if self.find_symbol_names(expression).isdisjoint(self.definition_by_local):
            return expression
        replacements = {
            symbol: self.definition_by_local[symbol.name]
            for symbol in expression.free_symbols
            if symbol.name in self.definition_by_local
        }
        return expression.xreplace(replacements) if replacements else expression

    def find_symbol_names(self, expression: sp.Expr) -> frozenset[str]:
        """Return the names of the symbols in an expression; the result is cached for each subexpression."""
        if expression not in self._names:
            parts = (self.find_symbol_names(part) for part in expression.args)
            self._names[expression] = (
                frozenset({expression.name}) if expression.is_Symbol else frozenset().union(*parts)
            )
        return self._names[expression]

    def depends_on_time_only(self, expression: sp.Expr) -> bool:
        """Return whether an expression depends on time, and on nothing but time and parameters; a constant does not."""
        names = self.find_symbol_names(expression)
        return names <= self.known.keys() and (self.time in names or not names.isdisjoint(self.definition_by_local))

    def collect_terms(self, expression: sp.Expr) -> None:
        """Add the transient terms of an expression to `terms`: those that may act between the stages of a step.

        Nothing is added for an expression that does not depend on time alone, or that is resolved by the stages. Of a
        sum or product only the unresolved parts are added, together and one by one. The parts of any other term are
        added too.
        """
        if not self.depends_on_time_only(expression) or self.is_resolved_by_stages(expression):
            return
        if isinstance(expression, BranchOf):
            return self.collect_terms(expression.args[1])
        parts = [
            part for part in expression.args if self.depends_on_time_only(part) and not self.is_resolved_by_stages(part)
        ]
        if isinstance(expression, (sp.Add, sp.Mul, Select, Unevaluated)):
            if len(parts) > 1 and not isinstance(expression, (Select, Unevaluated)):
                self.terms.setdefault(expression.func(*parts))
        elif not expression.is_Symbol:
            self.terms.setdefault(expression)
        for part in parts:
            self.collect_terms(part)
        return None

    def is_resolved_by_stages(self, expression: sp.Expr) -> bool:
        """Return whether the stages of a step cannot miss a change of an expression of time (the sampling resolves it).

        Resolved are constants, t, sums, products and powers up to 4 of resolved expressions, and sin, cos, exp of a
        linear argument. Each branch of a switch counts by itself, since steps end at switching points. The result is
        cached.
        """
        if expression not in self._is_resolved:
            self._is_resolved[expression] = self._is_resolved_by_stages_uncached(
                self.insert_time_definitions(expression)
            )
        return self._is_resolved[expression]

    def _is_resolved_by_stages_uncached(self, expression: sp.Expr) -> bool:
        """Return `is_resolved_by_stages` of an expression without reading the cache.

        The functions in `resolved_functions` count for an argument that is linear in time. Of a branch, the sign of a
        switching function, the switching function counts.
        """
        if self.time not in self.find_symbol_names(expression):
            return True
        match expression:
            case sp.Symbol():
                return True
            case BranchOf():
                return self.is_resolved_by_stages(expression.args[1])
            case sp.Add() | sp.Mul() | Select() | Unevaluated() | ModOn():
                return all(map(self.is_resolved_by_stages, expression.args))
            case sp.Pow() if expression.exp.is_Integer and int(expression.exp) in _POWERS:
                return self.is_resolved_by_stages(expression.base)
        return isinstance(expression, self.resolved_functions) and self.is_linear(expression.args[0])

    def is_linear(self, expression: sp.Expr) -> bool:
        """Return whether the form of an expression shows that it is constant or linear in time.

        Sums of such terms, and products with at most one factor that depends on time, count.
        """
        time_parts = [part for part in expression.args if self.time in self.find_symbol_names(part)]
        if isinstance(expression, (sp.Add, sp.Mul)):
            return (len(time_parts) < 2 or isinstance(expression, sp.Add)) and all(map(self.is_linear, time_parts))
        return expression.is_Symbol or not time_parts

    def list_needed_definitions(self, terms: list[sp.Expr]) -> list[Statement]:
        """Return the definitions of the locals that the terms read, directly or not, in the order of the function.

        A branch that is frozen over a step is replaced by the sign of its switching function.
        """
        pending = [symbol.name for term in terms for symbol in term.free_symbols]
        needed_names: set[str] = set()
        while pending:
            name = pending.pop()
            if name in self.known and name not in needed_names:
                needed_names.add(name)
                value = self.known[name].value
                pending += [symbol.name for symbol in value.free_symbols] if isinstance(value, sp.Expr) else []
        return [_replace_frozen_branch(symbol) for name, symbol in self.known.items() if name in needed_names]


def _replace_frozen_branch(statement: Statement) -> Statement:
    """Return a statement that reads a frozen branch with the sign of its switching function instead.

    Other statements are returned unchanged. Over a range of time no branch is frozen.
    """
    if isinstance(statement.value, BranchOf):
        return replace(statement, value=sp.sign(statement.value.args[1]))
    return statement

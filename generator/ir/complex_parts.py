"""A kernel at complex numbers, as a kernel of real ones: each statement becomes its real and its imaginary part.

Newton's matrix of a method whose stages are solved together is that of a single stage at complex h γ. Its kernels are
therefore derived once and printed twice, for single runs and for lanes. Statements without complex operands stay
single. Arrays hold real and imaginary parts alternately.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.kernels import LINEARIZATION, Kernel, Section, without_unused
from gudgeon.generator.ir.signatures import Access, Argument
from gudgeon.generator.ir.statements import Call, Declare, Guard, Line, Statement
from gudgeon.generator.ir.values import Conditional, Test, Value
from gudgeon.generator.symbols.storage import Key, Place, PlaceSymbol, key_of
from gudgeon.generator.symbols.switches import Size

SUFFIX, IMAGINARY = "_complex", "_i"
ZERO = sp.Integer(0)
Parts = tuple[sp.Expr, sp.Expr]


def at_complex(kernel: Kernel, arrays: Iterable[Key], zero: Iterable[str] = ()) -> Kernel:
    """Return the complex version of a kernel, its name with SUFFIX appended.

    arrays: which arguments are complex, with their elements; and arrays at places. `zero`: arguments that are 0 and are
    left out. Raises ValueError for a line that has no complex counterpart.
    """
    return _ComplexConverter(kernel, frozenset(arrays), frozenset(zero)).kernel()


class _ComplexConverter:
    """Converter of one kernel, line by line."""

    def __init__(self, kernel: Kernel, complex_: frozenset[Key], zero: frozenset[str]) -> None:
        """Begin with the names of complex and of vanishing arguments."""
        self.source, self.complex, self.locals, self.zero = kernel, complex_, set[str](), zero
        self.before: list[Line] = []  # what the next line reads
        self.counts = {"size": 0, "divisor": 0, "factor": 0}

    def kernel(self) -> Kernel:
        """Return the complex version of the kernel."""
        sections = tuple(
            Section(section.title, tuple(line for each in section.statements for line in self._lines(each)))
            for section in self.source.sections
        )
        arguments = tuple(a for each in self.source.arguments for a in self._argument(each))
        twin = replace(
            self.source,
            name=f"{self.source.name}{SUFFIX}",
            arguments=arguments,
            sections=sections,
            doc=(*self.source.doc, "At complex eta: real and imaginary parts alternate."),
        )
        return without_unused(twin)

    def _argument(self, argument: Argument) -> list[Argument]:
        """Return the arguments that replace one: none, the same, or real and imaginary part."""
        if argument.name in self.zero:
            return []
        if argument.name == LINEARIZATION:
            return [replace(argument, type=f"Complex{argument.type}")]
        if argument.name in self.complex and argument.access is Access.VALUE:
            return [argument, replace(argument, name=argument.name + IMAGINARY)]
        return [argument]

    def _lines(self, line: Line) -> list[Line]:
        """Return the lines that replace one, with the locals that they need before them."""
        after = self._counterparts(line)
        before, self.before = self.before, []
        return before + after

    def _local(self, kind: str, value: sp.Expr) -> sp.Symbol:
        """Return a new local of a kind for a value, declared before the next line."""
        self.counts[kind] += 1
        local = sp.Symbol(f"{kind}_{self.counts[kind]}", real=True)
        self.before.append(Statement(local.name, value))
        return local

    def _counterparts(self, line: Line) -> list[Line]:
        """Return the lines that replace one."""
        match line:
            case Statement():
                return self._statement(line)
            case Declare():
                self.complex |= {line.name}
                return [replace(line, sizes=tuple(2 * n for n in line.sizes))]
            case Guard(test=Test() as test):
                return self._guard(line, test)
            case Call():
                return [replace(line, function=f"{line.function}{SUFFIX}")]
            case _ if not self._is_complex(line):
                return [line]
        raise ValueError(f"a line of a kernel that has no complex counterpart: {line}")

    def _is_complex(self, line: Line) -> bool:
        """Return whether a line reads a complex number."""
        return any(self._pair(s) for x in line.expressions for s in x.free_symbols)

    def _statement(self, line: Statement) -> list[Line]:
        """Return the statements of the real and imaginary part."""
        real, imaginary = self._value(line.value)
        if local := line.defines:
            if imaginary == ZERO:
                return [replace(line, value=real)]
            self.locals.add(local)
            return [replace(line, value=real), replace(line, target=local + IMAGINARY, value=imaginary)]
        if both := self._places(line.target):
            return [replace(line, target=both[0], value=real), replace(line, target=both[1], value=imaginary)]
        return [replace(line, value=real)]

    def _value(self, value: Value) -> tuple[Value, Value]:
        """Return the real and imaginary part of the value of a statement."""
        match value:
            case Place():
                return self._places(value) or (value, ZERO)
            case Conditional():
                then, otherwise = self.parts(value.then), self.parts(value.otherwise)
                parts = [replace(value, then=a, otherwise=b) for a, b in zip(then, otherwise, strict=True)]
                return parts[0], parts[1]
            case sp.Basic():
                return self.parts(value)
        raise ValueError(f"a value of a kernel that has no complex counterpart: {value}")

    def _places(self, place: Key) -> tuple[Place, Place] | None:
        """Return the places of both parts of an array's element; None if it is real."""
        match place:
            case Place(base, (*of, int() as k)) if {base, Place(base, (*of,))} & self.complex:
                return Place(base, (*of, 2 * k)), Place(base, (*of, 2 * k + 1))
        return None

    def _pair(self, symbol: sp.Symbol) -> Parts | None:
        """Return the symbols of both parts of a symbol; None if it is real."""
        name = symbol.name
        if both := self._places(key_of(symbol)):
            return PlaceSymbol(both[0]), PlaceSymbol(both[1])
        return (symbol, sp.Symbol(name + IMAGINARY)) if name in self.locals or name in self.complex else None

    def parts(self, value: sp.Expr) -> Parts:
        """Return the real and imaginary part of an expression."""
        value = sp.sympify(value)
        if value.is_Symbol:
            if value.name in self.zero:
                return ZERO, ZERO
            return self._pair(value) or (value, ZERO)
        if not any(self._pair(s) or s.name in self.zero for s in value.free_symbols):
            return value, ZERO
        if value.is_Add:
            each = [self.parts(x) for x in value.args]
            return sp.Add(*(a for a, _ in each)), sp.Add(*(b for _, b in each))
        if value.is_Mul:
            return self._product(value)
        base, exponent = value.as_base_exp()
        if not (value.is_Pow and exponent.is_Integer):
            raise ValueError(f"no complex counterpart of {value}")
        found = times = self.parts(base)
        for _ in range(abs(int(exponent)) - 1):
            found = _times(found, times)
        if exponent > 0:
            return found
        real, imaginary = (x if x.is_Symbol else self._local("divisor", x) for x in found)
        share = self._local("divisor", 1 / (real**2 + imaginary**2))
        return real * share, -imaginary * share

    def _product(self, value: sp.Mul) -> Parts:
        """Return the parts of a product; real factors are multiplied last, once for each part."""
        found: Parts | None = None
        real: list[sp.Expr] = []
        for each in map(self.parts, value.args):
            if each[1] == ZERO:
                real.append(each[0])
            else:
                found = each if found is None else _times(self._simple(found), self._simple(each))
        factor = sp.Mul(*real)
        return (factor * found[0], factor * found[1]) if found else (factor, ZERO)

    def _simple(self, parts: Parts) -> Parts:
        """Return the parts as locals unless they are symbols or negatives: a product reads each twice."""
        real, imaginary = (x if (-x).is_Symbol or x.is_Symbol else self._local("factor", x) for x in parts)
        return real, imaginary

    def _guard(self, line: Guard, test: Test) -> list[Line]:
        """Return the test of a pivot with |real| + |imaginary| as its size."""
        real, imaginary = self.parts(test.value)
        if imaginary == ZERO:
            return [line]
        local = self._local("size", Size(real) + Size(imaginary))
        if test.of_itself:
            bound: tuple[sp.Basic | float, ...] = (test.bound[0], local)
        else:
            bound = tuple(self._bound(x) if isinstance(x, Size) else x for x in test.bound)
        return [replace(line, test=replace(test, value=local, bound=bound, size=False))]

    def _bound(self, size: sp.Expr) -> sp.Expr:
        """Return a size in a bound as |real| + |imaginary| if it is complex."""
        real, imaginary = self.parts(size.args[0])
        return self._local("size", Size(real) + Size(imaginary)) if imaginary != ZERO else size


def _times(a: Parts, b: Parts) -> Parts:
    """Return the product of two complex numbers."""
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]

"""Generated functions of complex numbers: each statement becomes its real and its imaginary part.

Newton's matrix of a method whose stages are solved together is that of a single stage at complex h γ. Its kernels are
therefore derived once and printed twice, for single runs and for lanes. Statements without complex operands stay
single. Arrays hold real and imaginary parts alternately.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.kernels import LINEARIZATION, Kernel, Section, remove_unused_locals
from gudgeon.generator.ir.signatures import Access, Argument
from gudgeon.generator.ir.statements import Call, Declare, Guard, Instruction, Statement
from gudgeon.generator.ir.values import Conditional, Test, Value
from gudgeon.generator.symbols.storage import Key, StorageLocation, StoredSymbol, find_value_key
from gudgeon.generator.symbols.switches import ComparedMagnitude

SUFFIX, IMAGINARY = "_complex", "_i"
ZERO = sp.Integer(0)
Parts = tuple[sp.Expr, sp.Expr]


def convert_to_complex(kernel: Kernel, complex_arrays: Iterable[Key], zero_arguments: Iterable[str] = ()) -> Kernel:
    """Return the kernel (generated function) for complex arguments, with "_complex" appended to its name.

    `complex_arrays`: names of the arguments and arrays, or their storage locations, that are complex. `zero_arguments`:
    names of arguments that are 0 there and are left out. Unused locals are removed. Raise ValueError for a line that
    has no complex counterpart. Used for the kernels that factorize and solve Newton's matrix of the Radau methods at a
    complex eigenvalue (solvers/newton.py).
    """
    return _ComplexConverter(kernel, frozenset(complex_arrays), frozenset(zero_arguments)).convert_kernel()


class _ComplexConverter:
    """Converter of one kernel, line by line."""

    def __init__(self, kernel: Kernel, complex_keys: frozenset[Key], zero_arguments: frozenset[str]) -> None:
        """Begin with the kernel, the keys of complex arguments and arrays, and the names of zero arguments."""
        self.source, self.complex_keys, self.zero_arguments = kernel, complex_keys, zero_arguments
        self.complex_locals: set[str] = set()
        self.pending_locals: list[Instruction] = []  # auxiliary locals that the next line reads
        self.counts = {"size": 0, "divisor": 0, "factor": 0}

    def convert_kernel(self) -> Kernel:
        """Return the complex version of the kernel: all sections and arguments converted, without unused locals.

        Raise ValueError for a line that cannot be converted.
        """
        sections = tuple(
            Section(
                section.title, tuple(new_line for line in section.statements for new_line in self._convert_line(line))
            )
            for section in self.source.sections
        )
        arguments = tuple(
            new_argument for argument in self.source.arguments for new_argument in self._convert_argument(argument)
        )
        converted = replace(
            self.source,
            name=f"{self.source.name}{SUFFIX}",
            arguments=arguments,
            sections=sections,
            doc=(*self.source.doc, "At complex eta: real and imaginary parts alternate."),
        )
        return remove_unused_locals(converted)

    def _convert_argument(self, argument: Argument) -> list[Argument]:
        """Return the list of arguments that replaces one in the complex kernel.

        It is empty for a zero argument. A complex number becomes a real and an imaginary argument, the latter with "_i"
        in its name. The linearization gets the type "Complex…"; arrays and other arguments stay.
        """
        if argument.name in self.zero_arguments:
            return []
        if argument.name == LINEARIZATION:
            return [replace(argument, type=f"Complex{argument.type}")]
        if argument.name in self.complex_keys and argument.access is Access.VALUE:
            return [argument, replace(argument, name=argument.name + IMAGINARY)]
        return [argument]

    def _convert_line(self, line: Instruction) -> list[Instruction]:
        """Return the lines of real numbers that replace a line, preceded by the locals that they read.

        These were collected in `pending_locals`, which is emptied.
        """
        lines = self._split_line(line)
        locals_, self.pending_locals = self.pending_locals, []
        return locals_ + lines

    def _make_local(self, kind: str, value: sp.Expr) -> sp.Symbol:
        """Return the symbol of a new local `<kind>_<k>` with a value.

        Its statement is inserted before the line that is being converted. kind: "size", "divisor" or "factor".
        """
        self.counts[kind] += 1
        local = sp.Symbol(f"{kind}_{self.counts[kind]}", real=True)
        self.pending_locals.append(Statement(local.name, value))
        return local

    def _split_line(self, line: Instruction) -> list[Instruction]:
        """Return the lines of real numbers that replace a line; locals that they read go to `pending_locals`.

        A statement becomes one for each part, the test of a pivot one of |real| + |imaginary|. A declared array gets
        twice its sizes and counts as complex from then on, a call gets the suffix "_complex", and other lines without
        complex operands stay. Raise ValueError for all others.
        """
        match line:
            case Statement():
                return self._split_statement(line)
            case Declare():
                self.complex_keys |= {line.name}
                return [replace(line, sizes=tuple(2 * n for n in line.sizes))]
            case Guard(test=Test() as test):
                return self._convert_guard(line, test)
            case Call():
                return [replace(line, function=f"{line.function}{SUFFIX}")]
            case _ if not self._is_complex(line):
                return [line]
        raise ValueError(f"a line of a kernel has no complex counterpart: {line}")

    def _is_complex(self, line: Instruction) -> bool:
        """Return whether any expression of a line contains a symbol with an imaginary part."""
        return any(self._split_symbol(s) for x in line.expressions for s in x.free_symbols)

    def _split_statement(self, line: Statement) -> list[Instruction]:
        """Return the assignments of the real and of the imaginary part of a statement.

        A local with imaginary part 0 stays single; otherwise it becomes complex for all later lines. An element of a
        real array gets the real part alone; the imaginary part is dropped.
        """
        real, imaginary = self._split_value(line.value)
        if local := line.declared_local:
            if imaginary == ZERO:
                return [replace(line, value=real)]
            self.complex_locals.add(local)
            return [replace(line, value=real), replace(line, target=local + IMAGINARY, value=imaginary)]
        if places := self._split_storage_location(line.target):
            return [replace(line, target=places[0], value=real), replace(line, target=places[1], value=imaginary)]
        return [replace(line, value=real)]

    def _split_value(self, value: Value) -> tuple[Value, Value]:
        """Return the real and the imaginary part of the value of a statement; the imaginary part of a real value is 0.

        The value is a storage location, a `Conditional` or an expression. Raise ValueError for other kinds of values.
        """
        match value:
            case StorageLocation():
                return self._split_storage_location(value) or (value, ZERO)
            case Conditional():
                then, otherwise = self.split_expression(value.then), self.split_expression(value.otherwise)
                parts = [replace(value, then=a, otherwise=b) for a, b in zip(then, otherwise, strict=True)]
                return parts[0], parts[1]
            case sp.Basic():
                return self.split_expression(value)
        raise ValueError(f"a value of a kernel has no complex counterpart: {value}")

    def _split_storage_location(self, place: Key) -> tuple[StorageLocation, StorageLocation] | None:
        """Return the places 2k and 2k + 1 of the real and imaginary part of element k of a complex array.

        Return None if `place` (a storage location or the name of a local) is not an element of a complex array.
        """
        match place:
            case StorageLocation(base, (*path, int() as k)) if {
                base,
                StorageLocation(base, (*path,)),
            } & self.complex_keys:
                return StorageLocation(base, (*path, 2 * k)), StorageLocation(base, (*path, 2 * k + 1))
        return None

    def _split_symbol(self, symbol: sp.Symbol) -> Parts | None:
        """Return the symbols of the real and of the imaginary part of a symbol, or None if the symbol is real.

        They are two elements of the array for a stored value, and (x, x with the suffix IMAGINARY) for a local x.
        """
        name = symbol.name
        if places := self._split_storage_location(find_value_key(symbol)):
            return StoredSymbol(places[0]), StoredSymbol(places[1])
        return (
            (symbol, sp.Symbol(name + IMAGINARY)) if name in self.complex_locals or name in self.complex_keys else None
        )

    def split_expression(self, value: sp.Expr) -> Parts:
        """Return the real and the imaginary part of an expression.

        Allowed are sums, products and integer powers; divisors and factors may become new locals. Symbols of zero
        arguments give (0, 0). Raise ValueError for other functions of complex arguments.
        """
        value = sp.sympify(value)
        if value.is_Symbol:
            if value.name in self.zero_arguments:
                return ZERO, ZERO
            return self._split_symbol(value) or (value, ZERO)
        if not any(self._split_symbol(s) or s.name in self.zero_arguments for s in value.free_symbols):
            return value, ZERO
        if value.is_Add:
            term_parts = [self.split_expression(x) for x in value.args]
            return sp.Add(*(real_ for real_, _ in term_parts)), sp.Add(*(imaginary_ for _, imaginary_ in term_parts))
        if value.is_Mul:
            return self._multiply_factors(value)
        base, exponent = value.as_base_exp()
        if not (value.is_Pow and exponent.is_Integer):
            raise ValueError(f"no complex counterpart of {value}")
        product = factor = self.split_expression(base)
        for _ in range(abs(int(exponent)) - 1):
            product = _multiply_complex(product, factor)
        if exponent > 0:
            return product
        real, imaginary = (x if x.is_Symbol else self._make_local("divisor", x) for x in product)
        reciprocal = self._make_local("divisor", 1 / (real**2 + imaginary**2))
        return real * reciprocal, -imaginary * reciprocal

    def _multiply_factors(self, value: sp.Mul) -> Parts:
        """Return the real and the imaginary part of a product; the imaginary part is 0 if all factors are real.

        Complex factors are multiplied first; the product of all real factors then multiplies each part once.
        """
        product: Parts | None = None
        real_factors: list[sp.Expr] = []
        for factor_parts in map(self.split_expression, value.args):
            if factor_parts[1] == ZERO:
                real_factors.append(factor_parts[0])
            else:
                product = (
                    factor_parts
                    if product is None
                    else _multiply_complex(self._store_long_parts(product), self._store_long_parts(factor_parts))
                )
        factor = sp.Mul(*real_factors)
        return (factor * product[0], factor * product[1]) if product else (factor, ZERO)

    def _store_long_parts(self, parts: Parts) -> Parts:
        """Return both parts as symbols or negative symbols.

        A longer part is stored in a new local, because a complex product reads each part twice.
        """
        real, imaginary = (x if (-x).is_Symbol or x.is_Symbol else self._make_local("factor", x) for x in parts)
        return real, imaginary

    def _convert_guard(self, line: Guard, test: Test) -> list[Instruction]:
        """Return the test of a pivot, in a list, with |real| + |imaginary| of the value in place of its magnitude.

        Complex magnitudes in the bound are replaced too. The line stays as it is if the tested value is real.
        """
        real, imaginary = self.split_expression(test.value)
        if imaginary == ZERO:
            return [line]
        local = self._make_local("size", ComparedMagnitude(real) + ComparedMagnitude(imaginary))
        if test.is_relative_to_value:
            bound: tuple[sp.Basic | float, ...] = (test.bound[0], local)
        else:
            bound = tuple(self._convert_bound(x) if isinstance(x, ComparedMagnitude) else x for x in test.bound)
        return [replace(line, test=replace(test, value=local, bound=bound, compares_magnitude=False))]

    def _convert_bound(self, magnitude: sp.Expr) -> sp.Expr:
        """Return the magnitude in a bound as a local with |real| + |imaginary|.

        The magnitude of a real value is returned unchanged.
        """
        real, imaginary = self.split_expression(magnitude.args[0])
        return (
            self._make_local("size", ComparedMagnitude(real) + ComparedMagnitude(imaginary))
            if imaginary != ZERO
            else magnitude
        )


def _multiply_complex(a: Parts, b: Parts) -> Parts:
    """Return the real and the imaginary part of the product of two complex expressions."""
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]

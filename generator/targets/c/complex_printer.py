"""Kernels a second time, for numbers of two parts: the same statements in C's complex arithmetic.

Newton's matrix of a method whose stages are solved together is that of a single stage at complex h γ. What hangs on
nothing complex stays real.
"""

from __future__ import annotations

from dataclasses import replace

from gudgeon.generator.ir.kernels import Argument, Kernel
from gudgeon.generator.ir.readable import readable
from gudgeon.generator.ir.split import cut
from gudgeon.generator.ir.statements import Call, Declare, Line, Statement
from gudgeon.generator.ir.values import Place, Test, Value, base_of
from gudgeon.generator.targets.c import functions
from gudgeon.generator.targets.c.printer import CPrinter

SUFFIX = "_complex"
CALLED_BY_ENGINE = frozenset({f"newton_factor{SUFFIX}", f"newton_solve{SUFFIX}"})
_TYPES = {
    "double": "Complex", "double *": "Complex *", "const double *": "const Complex *", "Linear *": "ComplexLinear *",
    "const Linear *": "const ComplexLinear *",
}  # fmt: skip
_FACTORS = "lin->lu"


class ComplexLines(functions.Lines):
    """Lines of a function whose arguments are complex, as are the factors of the matrix, but not what it is made of."""

    def __init__(self, printer: CPrinter, arguments: tuple[Argument, ...]) -> None:
        super().__init__(printer, "Complex")
        self.complex = {a.name for a in arguments if "Complex" in a.type and "Linear" not in a.type}

    def _is_complex(self, value: Value) -> bool:
        if isinstance(value, Place):
            return value.text.startswith(_FACTORS) or value.base in self.complex
        names = {symbol.name for x in Statement("", value).expressions for symbol in x.free_symbols}
        return any(name.startswith(_FACTORS) or base_of(name) in self.complex for name in names)

    def statement(self, item: Statement) -> str:
        """A local is real where all that it is made of is."""
        if item.local and self._is_complex(item.value):
            self.complex.add(item.target)
        self.number = "double" if item.local and item.target not in self.complex else "Complex"
        return super().statement(item)

    def _lines(self, item: Line) -> list[str]:
        if isinstance(item, Declare):
            self.complex.add(item.name)
            item = replace(item, type=_TYPES.get(item.type, item.type))
        if isinstance(item, Call):
            item = replace(item, function=f"{item.function}{SUFFIX}")
        return list(super()._lines(item))

    def test(self, item: Test) -> str:
        """Of sizes."""
        value = self.expression(item.value)
        if item.of_itself:
            return f"complex_size({value}) > 0.0 && complex_size({value}) <= DBL_MAX"
        return super().test(item).replace("fabs(", "complex_size(")


def kernel(item: Kernel) -> str:
    """The whole function, a long one behind its parts."""
    return "\n".join(map(_function, cut(item)))


def _function(part: Kernel) -> str:
    arguments = tuple(replace(a, type=_TYPES.get(a.type, a.type)) for a in part.arguments)
    twin = replace(part, name=f"{part.name}{SUFFIX}", arguments=arguments)
    own = readable(twin)
    return functions.function(
        twin, ComplexLines(CPrinter(own), arguments), own, called=twin.name in CALLED_BY_ENGINE
    )

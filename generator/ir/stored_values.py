"""Numbers that one emitted function keeps in an array for others, each once up to its sign."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.symbols.storage import Place
from gudgeon.generator.symbols.symbols import SymbolInfo, Symbols


class Pool:
    """`keep` stores a value and gives the symbol that reads it; what needs no storing stays as it is."""

    def __init__(self, symbols: Symbols, array: Place) -> None:
        self._symbols, self.array = symbols, array
        self._kept: dict[sp.Expr, sp.Symbol] = {}
        self._place: dict[sp.Expr, int] = {}
        self.size = 0

    def keep(self, build: KernelBuilder, value: sp.Expr, wanted: str) -> sp.Expr:
        """The value itself if it is a number or one of `prepare`, else ± the symbol of its place."""
        for sign in (1, -1):
            if value.is_Number or self._is_parameter(sign * value):
                return value
            if sign * value in self._kept:
                return sign * self._kept[sign * value]
        symbol = self._symbols.new(wanted, self.array[self._store(build, value)])
        self._kept[value], self._place[symbol] = symbol, self._place[value]
        return symbol

    def adopt(self, build: KernelBuilder, value: sp.Expr) -> sp.Expr:
        """Stores the local of which a value is ±, so that other functions read it under the same name."""
        symbol = next(iter(value.free_symbols), None)
        if symbol is not None and symbol not in self._symbols.info:
            self._symbols.info[symbol] = SymbolInfo(self.array[self._store(build, symbol)], "", "")
        return value

    def place(self, build: KernelBuilder, value: sp.Expr) -> tuple[int, int]:
        """(index, sign) of a value that `keep` gave; numbers and parameters are stored for it."""
        for sign in (1, -1):
            if sign * value in self._place:
                return self._place[sign * value], sign
        return self._store(build, value), 1

    def _store(self, build: KernelBuilder, value: sp.Expr) -> int:
        build.out(self.array[self.size], value)
        self._place[value] = self.size
        self.size += 1
        return self._place[value]

    def _is_parameter(self, value: sp.Expr) -> bool:
        return bool(value.is_Symbol and value in self._symbols.info and self._symbols.info[value].is_parameter)

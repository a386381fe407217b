"""Matrices of equations that print with letters, as a scene's documents have them; what follows from them does not."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp


class Lettered(sp.Matrix):
    """A matrix like any other; `str`, `repr`, `sympy.latex` and notebooks ask `letters` how its entries are written."""

    letters: Callable[[], Any] | None = None  # gives an object with latex(matrix) and text(matrix)

    def _latex(self, printer: Any) -> str:
        return str(self.letters().latex(self) if self.letters else printer._print_MatrixBase(self))

    def _sympystr(self, printer: Any) -> str:
        return str(self.letters().text(self) if self.letters else printer._print_MatrixBase(self))

    def __str__(self) -> str:
        return repr(self) if self.letters else super().__str__()


def lettered(matrix: sp.Matrix, letters: Callable[[], Any] | None) -> Lettered:
    """The same entries; without letters as SymPy prints them."""
    found = Lettered._fromrep(matrix._rep)
    found.letters = letters
    return found

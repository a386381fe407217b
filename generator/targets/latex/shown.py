"""A model's equations where a notebook or a terminal shows them: with the letters of its documents."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from gudgeon.errors import GudgeonError
from gudgeon.generator.equations.model import Model
from gudgeon.generator.targets.latex.letters import Name
from gudgeon.generator.targets.latex.notation import make_notation
from gudgeon.generator.targets.latex.to_html import mathml


class Letters:
    """How expressions of one model are written."""

    def __init__(self, model: Model) -> None:
        self.model, self.notation = model, make_notation(model)

    def latex(self, matrix: sp.Matrix) -> str:
        """A matrix as LaTeX."""
        rows = r" \\ ".join(map(" & ".join, self._rows(matrix, lambda name: name.latex)))
        return rf"\left[\begin{{array}}{{{'c' * matrix.cols}}}{rows}\end{{array}}\right]"

    def text(self, matrix: sp.Matrix) -> str:
        """A matrix as plain text, a line for each row."""
        return "\n".join(f"[{', '.join(row)}]" for row in self._rows(matrix, lambda name: name.text))

    def equation(self) -> Name:
        """Φ(q, t) = 0, row by row."""
        return Name(rf"\Phi(q, t) = {self.latex(self.model.Phi)} = 0", f"Φ(q, t) =\n{self.text(self.model.Phi)}")

    def html(self) -> str:
        """The same as MathML; LaTeX between dollar signs without the extra `docs`."""
        try:
            return mathml(self.equation().latex)
        except GudgeonError:
            return f"$${self.equation().latex}$$"

    def _rows(self, matrix: sp.Matrix, write: Callable[[Name], str]) -> list[list[str]]:
        return [[write(self.notation.math(matrix[r, c])) for c in range(matrix.cols)] for r in range(matrix.rows)]

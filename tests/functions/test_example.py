"""Example: each function of the table is computed in two ways at random arguments.

`every_function` gives a test each entry of `runtime/language/functions.py`; `draw` draws its arguments.
"""

from __future__ import annotations

import numpy as np
import sympy as sp

from gudgeon.language.functions import Function
from tests.functions.table import draw, every_function, in_sympy, names, values


@every_function
def test_values_are_those_of_sympy(function: Function) -> None:
    arguments = draw(function, count=3)
    expression, symbols = in_sympy(function), [sp.Symbol(name, real=True) for name in names(function)]
    exact = [float(expression.subs(dict(zip(symbols, row, strict=True))).evalf()) for row in arguments]
    np.testing.assert_allclose(values(function, arguments), exact, rtol=1e-12, atol=1e-14)

"""The C of the Taylor series of a motion: what its functions hand to each other, and the functions."""

from __future__ import annotations

from collections.abc import Sequence

from gudgeon.generator.ir.series import Series
from gudgeon.generator.ir.series_rules import WIDE
from gudgeon.generator.targets.c import functions

FILE = "taylor.c"
_HEAD = f"""\
/*
 * The Taylor series of the motion: its right-hand side at order 0, and at each higher order (engine/motion/taylor.c).
 */
typedef double Wide __attribute__((vector_size({8 * WIDE})));
"""


def taylor_code(series: Series) -> str:
    """The whole file."""
    products = [product.name for product in series.products]
    sizes = _struct("Factors of products, or their sums over lower orders.", "TaylorFactors", products)
    values = _struct("Coefficients of order 0.", "TaylorValues", series.kept)
    return "\n".join([_HEAD, values, sizes, functions.kernel(series.values), functions.kernel(series.terms)])


def _struct(meaning: str, name: str, fields: Sequence[str]) -> str:
    lines = [f"/* {meaning} */", "typedef struct {", *(f"    double {field};" for field in fields or ["none"])]
    return "\n".join([*lines, f"}} {name};", ""])

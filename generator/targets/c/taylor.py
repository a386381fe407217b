"""Writes the C of the Taylor series of a motion: its structs and its functions."""

from __future__ import annotations

from collections.abc import Sequence

from gudgeon.generator.ir.series import Series
from gudgeon.generator.ir.series_rules import WIDE
from gudgeon.generator.ir.sine_pairs import pair_sines
from gudgeon.generator.targets.c import functions, lanes_printer

FILE = "taylor.c"
_HEAD = f"""\
/*
 * The Taylor series of the motion: its right-hand side at order 0, and at each higher order (engine/motion/taylor.c).
 */
typedef double Wide __attribute__((vector_size({8 * WIDE}), aligned(16)));
"""


def taylor_code(series: Series) -> str:
    """Return the text of taylor.c."""
    kernels = (functions.kernel(pair_sines(series.values)), functions.kernel(series.terms))
    return "\n".join([_HEAD, _structs(series, "double"), *kernels])


def lanes_code(series: Series) -> str:
    """Return the same functions for several runs in SIMD lanes."""
    kernels = (lanes_printer.motion_kernel(series.values), lanes_printer.kernel(series.terms))
    return "\n".join([_structs(series, "Lanes"), *kernels])


def _structs(series: Series, number: str) -> str:
    """Return the structs of coefficients of order 0 and of factors of products."""
    products = [product.name for product in series.products]
    factors = _struct("Factors of products, or their sums over lower orders.", "TaylorFactors", products, number)
    return "\n".join([_struct("Coefficients of order 0.", "TaylorValues", series.kept, number), factors])


def _struct(meaning: str, name: str, fields: Sequence[str], number: str) -> str:
    """Return one struct with fields of one type."""
    lines = [f"/* {meaning} */", "typedef struct {", *(f"    {number} {field};" for field in fields or ["none"])]
    return "\n".join([*lines, f"}} {name};", ""])

"""Writes the C of the Taylor series of a motion: its structs and its functions."""

from __future__ import annotations

from collections.abc import Sequence

from gudgeon.generator.ir.series import Series
from gudgeon.generator.ir.series_rules import ROW_LENGTH
from gudgeon.generator.ir.sine_groups import vectorize_sines
from gudgeon.generator.targets.c import functions, lanes_printer

FILE = "taylor.c"
_HEAD = f"""\
/*
 * The Taylor series of the motion: its right-hand side at order 0, and at each higher order (engine/motion/taylor.c).
 */
typedef double Wide __attribute__((vector_size({8 * ROW_LENGTH}), aligned(16)));
"""


def print_taylor_file(series: Series) -> str:
    """Return the text of taylor.c: its structs, the function of order 0 and the recurrence of the higher orders."""
    kernels = (functions.print_kernel(vectorize_sines(series.values)), functions.print_kernel(series.terms))
    return "\n".join([_HEAD, _print_structs(series, "double"), *kernels])


def print_taylor_lanes(series: Series) -> str:
    """Return the structs and functions of the Taylor series for several runs in SIMD lanes."""
    kernels = (lanes_printer.print_motion_kernel(series.values), lanes_printer.print_lanes_kernel(series.terms))
    return "\n".join([_print_structs(series, "Lanes"), *kernels])


def _print_structs(series: Series, c_type: str) -> str:
    """Return the C structs TaylorValues (coefficients of order 0) and TaylorFactors (factors of products).

    c_type: the C type of their fields, "double" or "Lanes".
    """
    products = [product.name for product in series.products]
    factors = _print_struct("Factors of products, or their sums over lower orders.", "TaylorFactors", products, c_type)
    return "\n".join([_print_struct("Coefficients of order 0.", "TaylorValues", series.stored_names, c_type), factors])


def _print_struct(meaning: str, name: str, fields: Sequence[str], c_type: str) -> str:
    """Return one C struct with fields of one type and a comment; a struct without fields gets the field `none`."""
    lines = [f"/* {meaning} */", "typedef struct {", *(f"    {c_type} {field};" for field in fields or ["none"])]
    return "\n".join([*lines, f"}} {name};", ""])

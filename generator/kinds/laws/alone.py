"""A law alone, as a function of arrays: for its plot, and to hold it against something else."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.errors import LawError
from gudgeon.generator.kinds.laws.built import build
from gudgeon.generator.kinds.laws.law import Law, LawInputs, PairSymbols

Results = dict[str, NDArray[np.float64]]


def alone(
    law: Law, numbers: Mapping[str, Any], options: Mapping[str, str | bool], pair: Mapping[str, float]
) -> Callable[..., Results]:
    """Its results by name, SI, of arrays that broadcast: variables of its role, those that it reads besides, states.

    numbers: by key, those that may be left out left out; expressions of a variable as SymPy.
    pair: R_i, R_j, c, L, E_i, nu_i, E_j, nu_j. What it reads
    besides is given whether it reads it or not. Raises LawError for what is not computed here.
    """
    import sympy as sp

    symbols = {name: sp.Symbol(name, real=True) for name in law.variables}
    given = LawInputs(
        {name: x if isinstance(x, sp.Expr) else sp.Float(x) for name, x in numbers.items()}, options,
        PairSymbols(**{name: sp.Float(x) for name, x in pair.items()}), symbols, lambda _, expression, __: expression,
    )  # fmt: skip
    known, functions = list(symbols.values()), []
    for name, step in build(law, given).items():
        functions.append((name, sp.lambdify(known, step, "numpy")))
        known.append(sp.Symbol(name, real=True))

    def results(*state: ArrayLike) -> Results:
        arrays = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in state))
        values, found = list(arrays), dict[str, Any]()
        for name, function in functions:
            try:
                found[name] = function(*values) + 0.0 * arrays[0]
            except (NameError, TypeError) as error:
                raise LawError(f"{law.role} law {law.name}: {name} cannot be computed here: {error}") from error
            values.append(found[name])
        return {name: found[name] for name in law.results}

    return results


def reads_besides(law: Law) -> int:
    """How many variables stand between those of its role and its states."""
    return len(law.further)

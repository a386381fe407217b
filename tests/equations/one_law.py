"""A force law alone, as numbers: its own steps, one after the other."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from gudgeon.generator.kinds.laws.law import RESULTS, VARIABLES, LawInputs, PairSymbols, find_all_laws

PAIR = PairSymbols(R_i=0.015, R_j=0.0147, c=0.3e-3, L=0.04, E_i=70e9, nu_i=0.3, E_j=206e9, nu_j=0.28)


class Evaluator:
    """A law with numbers for everything but its state variables; calls give its results as floats."""

    def __init__(self, name: str, parameters: Mapping[str, float], **options: str | bool) -> None:
        self.law = find_all_laws()[name]
        values = {p.name: p.default for p in self.law.parameters} | dict(parameters)
        selected = {o.name: o.default_option for o in self.law.options} | options
        symbols = {v: sp.Symbol(v, real=True) for v in self.law.variables}
        pair = PairSymbols(**{k: sp.Float(v) for k, v in vars(PAIR).items()})
        numbers = {k: sp.Float(v) for k, v in values.items() if v is not None}

        def derive(name: str, expression: Any, meaning: str) -> Any:
            return expression

        steps = self.law.build(LawInputs(numbers, selected, pair, symbols, derive))
        read = {s.name for step in steps.values() for s in sp.sympify(step).free_symbols}
        known, self._steps = [s for name, s in symbols.items() if name in (*VARIABLES[self.law.role], *read)], []
        self.reads = tuple(symbol.name for symbol in known)
        for step, expression in steps.items():
            self._steps.append((step, sp.lambdify(known, expression, "math")))
            known.append(sp.Symbol(step, real=True))

    def __call__(self, *state: float) -> tuple[float, ...]:
        values, named = list(state), {}
        for step, function in self._steps:
            values.append(function(*values))
            named[step] = float(values[-1])
        return tuple(named[result] for result in RESULTS[self.law.role])

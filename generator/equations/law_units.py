"""Units of a law of the user's own: its results are what its role needs, and what it adds or compares is alike.

A number that stands in a law is a pure one, but for 0, which has any unit; what has a unit is a field of the law.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

import sympy as sp

from gudgeon.errors import LawError
from gudgeon.generator.kinds.laws.built import PAIR, probe
from gudgeon.generator.kinds.laws.law import Law
from gudgeon.generator.kinds.laws.registered import ORIGINS, prefix
from gudgeon.generator.mechanism.mechanism import LawUse
from gudgeon.generator.symbols.functions import classes_where
from gudgeon.language.functions import Units
from gudgeon.language.units import (
    DIMENSIONLESS,
    FORCE,
    LENGTH,
    PRESSURE,
    RATE,
    TIME,
    TORQUE,
    VELOCITY,
    Dimension,
    describe,
)  # fmt: skip

_VARIABLES: Mapping[str, Dimension] = {
    "delta": LENGTH, "ratio": DIMENSIONLESS, "deltadot": VELOCITY, "F_n": FORCE, "v_t": VELOCITY,
    "epsilon": DIMENSIONLESS, "w_n": RATE, "w_t": RATE,
}  # fmt: skip
_RESULTS: Mapping[str, Dimension] = {"F_n": FORCE, "F_t": FORCE, "F_r": FORCE, "T0": TORQUE * TIME,
                                    "share": DIMENSIONLESS}  # fmt: skip
_PAIR: Mapping[str, Dimension] = {"E_i": PRESSURE, "E_j": PRESSURE, "nu_i": DIMENSIONLESS, "nu_j": DIMENSIONLESS}
_SAME = classes_where(lambda f: f.units is Units.SAME)
_RATIO = classes_where(lambda f: f.units is Units.RATIO)


class _Flexible:
    """No dimension of its own: a number as it stands, or what has a number that the file may give any unit."""


_BARE, _ANY = _Flexible(), _Flexible()
_Found = Dimension | _Flexible


def check_units(law: Law, use: LawUse) -> None:
    """Raise LawError where a result of a law has another unit than its role needs, or unlike ones are added."""
    made = probe(law, use.options, use.quantities)
    known: dict[str, _Found] = {f"probe_{name}": _PAIR.get(name, LENGTH) for name in PAIR}
    known |= {f"probe_{name}": number.dimension or _ANY for name, number in use.quantities.items()}
    known |= {name: _VARIABLES[name] for name in law.variables if name in _VARIABLES}
    known |= {state.name: LENGTH for state in law.states}
    units = _Units(law, known)
    for name, value in made.derived.items():
        known[f"probe_{name}"] = units.of(name, value)
    for name, step in made.steps.items():
        found = units.of(name, step)
        known[name] = found
        wanted = VELOCITY if name.endswith("_rate") else _RESULTS.get(name)
        if name in law.results and wanted and isinstance(found, Dimension) and found != wanted:
            hint = "a number with a unit is one of its fields: number(name, meaning, DIMENSION, default=…)"
            raise LawError(f"{units.whose}{name} is {describe(found)}, expected {describe(wanted)}", hint=hint)


@dataclass
class _Units:
    law: Law
    known: Mapping[str, _Found]  # by names of symbols
    seen: dict[sp.Expr, _Found] = field(default_factory=dict)

    @property
    def whose(self) -> str:
        return prefix(self.law.name, ORIGINS.get(self.law.name))

    def of(self, name: str, e: sp.Expr) -> _Found:
        """The dimension of an expression in the step of that name. Raises LawError where it has none."""
        if e not in self.seen:
            self.seen[e] = self._of(name, e)
        return self.seen[e]

    def _of(self, name: str, e: sp.Expr) -> _Found:
        if e.is_number:
            return _BARE
        if e.is_Symbol:
            return self.known.get(e.name, _ANY)
        if e.is_Pow or isinstance(e, sp.exp):
            return self._power(name, *e.as_base_exp())
        found = [self.of(name, part) for part in e.args]
        if e.is_Mul:
            return self._product(found)
        if e.is_Add or isinstance(e, (*_SAME, *_RATIO)):
            one = self._one(name, e, found)
            return DIMENSIONLESS if isinstance(e, _RATIO) else one
        if type(e).__name__ == "Whole":
            return found[0]
        self._pure(name, type(e).__name__, found[0])
        return DIMENSIONLESS

    def _one(self, name: str, e: sp.Expr, found: list[_Found]) -> _Found:
        units = sorted({x for x in found if isinstance(x, Dimension)}, key=str)
        bare = next((part for part, x in zip(e.args, found, strict=True) if x is _BARE and not part.is_zero), None)
        unlike = describe(units[1]) if len(units) > 1 else ""
        if units and bare is not None and not unlike and units[0] != DIMENSIONLESS:
            unlike = f"{float(bare):g}, a pure number"
        if unlike:
            what = "adds" if e.is_Add else f"takes {type(e).__name__} of"
            raise LawError(
                f"{self.whose}{name} {what} {describe(units[0])} and {unlike}: {sp.sstr(_shown(e))[:120]}",
                hint="a number with a unit is one of the law's fields",
            )
        return units[0] if units else _ANY if _ANY in found else _BARE

    def _power(self, name: str, base: sp.Expr, exponent: sp.Expr) -> _Found:
        self._pure(name, "an exponent", self.of(name, exponent))
        found = self.of(name, base)
        if not isinstance(found, Dimension) or found == DIMENSIONLESS:
            return found
        return found ** Fraction(str(exponent)).limit_denominator(1000) if exponent.is_number else _ANY

    def _pure(self, name: str, what: str, found: _Found) -> None:
        if isinstance(found, Dimension) and found != DIMENSIONLESS:
            told = f"{self.whose}{name} has {what} of {describe(found)}, expected {describe(DIMENSIONLESS)}"
            raise LawError(told, hint="divide by a number of that unit: one of the law's fields")

    @staticmethod
    def _product(found: list[_Found]) -> _Found:
        if _ANY in found:
            return _ANY
        units = [x for x in found if isinstance(x, Dimension)]
        made = units[0] if units else None
        for unit in units[1:]:
            made = made * unit if made is not None else unit
        return _BARE if made is None else made


def _shown(e: sp.Expr) -> sp.Expr:
    """With numbers called as the law calls them."""
    return e.xreplace({s: sp.Symbol(s.name.removeprefix("probe_"), real=True) for s in e.free_symbols})

"""Checks of user-defined laws of a scene: forces as expressions of the penetration, and laws in Python.

A force must be a finite number that pushes. A name has one meaning. The results of a law have the units that its role
needs, and terms that are added or compared have the same unit.
A number that stands in a law is dimensionless, except 0, which has any unit; a value with a unit is a field of the law.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np
import sympy as sp

from gudgeon.errors import BadValueError, LawError
from gudgeon.generator.kinds.laws.built import PAIR, probe
from gudgeon.generator.kinds.laws.law import FURTHER, RESULTS, USER_LAWS, VARIABLES, Law, laws
from gudgeon.generator.kinds.laws.registered import ORIGINS, check_name, prefix
from gudgeon.generator.mechanism import LawUse, Quantity, Scene, value_at_onset
from gudgeon.generator.symbols.from_expressions import classes_where, quantity_to_sympy
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.language.functions import Units
from gudgeon.language.tree import evaluate
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
)

N_PENETRATIONS = 400  # penetrations at which a force is sampled
_SMALLEST = 1e-6  # of the largest of them


def force_of(force: Quantity, delta: sp.Symbol, most: float, slots: ParameterTable) -> sp.Expr:
    """Return a force of the file as an expression of `delta` and parameters, checked up to the penetration `most` (m).

    If SymPy does not see that the force at δ = 0 is 0, its value there becomes a parameter, which every run checks.
    Raises BadValueError for a force that is not finite, pulls, or has no slope at δ = 0.
    """

    def symbol(path: str) -> sp.Expr:
        """Return the symbol of a name in the expression: `delta` or a parameter."""
        if path == "delta":
            return delta
        known: sp.Symbol = slots.entries[f"parameters.{path}"].symbol
        slots.symbols.adopt(known)
        return known

    value = quantity_to_sympy(force, symbol)
    if not value.has(delta):
        hint = "expected an expression such as 1e8 N/m * delta: its terms cancel"
        raise BadValueError(f"{force.address} does not follow delta, the penetration", force.where, hint)
    _check_force(force, most, slots)
    _check_slope(force, value, delta, slots)
    if value.subs(delta, 0) != 0:
        slots.use(value_at_onset(force))
    return value


def _check_force(force: Quantity, most: float, slots: ParameterTable) -> None:
    """Raise BadValueError if the force is not finite or negative at sampled penetrations, with the scene's values."""
    depths = np.union1d(
        np.geomspace(_SMALLEST * most, most, N_PENETRATIONS // 2), np.linspace(0.0, most, N_PENETRATIONS // 2)[1:]
    )
    found = np.broadcast_to(
        evaluate(
            force.value,
            lambda path: depths if path == "delta" else np.float64(slots.entries[f"parameters.{path}"].default),
        ),
        depths.shape,
    )
    if len(wrong := np.flatnonzero(~(np.isfinite(found) & (found >= 0.0)))):
        depth, load = depths[wrong[0]], found[wrong[0]]
        hint = "expected a force that is not negative up to the clearance, or to the key 'deepest'"
        raise BadValueError(f"{force.address} is {load:.6g} N at delta = {depth:.6g} m", force.where, hint)


def _check_slope(force: Quantity, value: sp.Expr, delta: sp.Symbol, slots: ParameterTable) -> None:
    """Raise BadValueError if the slope at δ = 0 is infinite, so that no Jacobian exists."""
    numbers = {entry.symbol: sp.Float(entry.default, 17) for entry in slots.entries.values()}
    slope = sp.diff(value, delta).xreplace(numbers).subs(delta, 0)
    if slope.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
        hint = "expected a slope that is a number there: delta**n has one for n >= 1"
        raise BadValueError(f"{force.address} has no slope at delta = 0", force.where, hint)


_VARIABLES: Mapping[str, Dimension] = {
    "delta": LENGTH,
    "ratio": DIMENSIONLESS,
    "deltadot": VELOCITY,
    "F_n": FORCE,
    "v_t": VELOCITY,
    "epsilon": DIMENSIONLESS,
    "w_n": RATE,
    "w_t": RATE,
}
_RESULTS: Mapping[str, Dimension] = {
    "F_n": FORCE,
    "F_t": FORCE,
    "F_r": FORCE,
    "T0": TORQUE * TIME,
    "share": DIMENSIONLESS,
}
_PAIR: Mapping[str, Dimension] = {"E_i": PRESSURE, "E_j": PRESSURE, "nu_i": DIMENSIONLESS, "nu_j": DIMENSIONLESS}
_SAME = classes_where(lambda f: f.units is Units.SAME)
_RATIO = classes_where(lambda f: f.units is Units.RATIO)


class _Flexible:
    """A dimension that is not fixed: of a plain number, or of a value that may have any unit in the file."""


_BARE, _ANY = _Flexible(), _Flexible()
_DimensionOrFlexible = Dimension | _Flexible


def check_units(law: Law, use: LawUse) -> None:
    """Raise LawError if a result of a law has another unit than its role needs, or if unlike units are added."""
    made = probe(law, use.options, use.quantities)
    known: dict[str, _DimensionOrFlexible] = {f"probe_{name}": _PAIR.get(name, LENGTH) for name in PAIR}
    known |= {f"probe_{name}": number.dimension or _ANY for name, number in use.quantities.items()}
    known |= {name: _VARIABLES[name] for name in law.variables if name in _VARIABLES}
    known |= {state.name: LENGTH for state in law.states}
    units = _Units(law, known)
    for name, value in made.derived.items():
        known[f"probe_{name}"] = units.of(name, value)
    for name, step in made.steps.items():
        found = units.of(name, step)
        known[name] = found
        expected = VELOCITY if name.endswith("_rate") else _RESULTS.get(name)
        if name in law.results and expected and isinstance(found, Dimension) and found != expected:
            hint = "a number with a unit is one of its fields: number(name, meaning, DIMENSION, default=…)"
            raise LawError(f"{units.whose}{name} is {describe(found)}, expected {describe(expected)}", hint=hint)


@dataclass
class _Units:
    """Dimensions of a law's expressions, found from those of its symbols in `known`."""

    law: Law
    known: Mapping[str, _DimensionOrFlexible]  # by names of symbols
    seen: dict[sp.Expr, _DimensionOrFlexible] = field(default_factory=dict)

    @property
    def whose(self) -> str:
        """Return the beginning of a message: the law and the file that defines it."""
        return prefix(self.law.name, ORIGINS.get(self.law.name))

    def of(self, name: str, e: sp.Expr) -> _DimensionOrFlexible:
        """Return the dimension of an expression in the step `name`. Raise LawError if it has none."""
        if e not in self.seen:
            self.seen[e] = self._of(name, e)
        return self.seen[e]

    def _of(self, name: str, e: sp.Expr) -> _DimensionOrFlexible:
        """Return the dimension of an expression without looking it up in the cache."""
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

    def _one(self, name: str, e: sp.Expr, found: list[_DimensionOrFlexible]) -> _DimensionOrFlexible:
        """Return the common dimension of terms that are added or compared. Raise LawError if they differ."""
        units = sorted({x for x in found if isinstance(x, Dimension)}, key=str)
        bare = next((part for part, x in zip(e.args, found, strict=True) if x is _BARE and not part.is_zero), None)
        unlike = describe(units[1]) if len(units) > 1 else ""
        if units and bare is not None and not unlike and units[0] != DIMENSIONLESS:
            unlike = f"{float(bare):g}, a pure number"
        if unlike:
            what = "adds" if e.is_Add else f"takes {type(e).__name__} of"
            raise LawError(
                f"{self.whose}{name} {what} {describe(units[0])} and {unlike}: {sp.sstr(_with_law_names(e))[:120]}",
                hint="a number with a unit is one of the law's fields",
            )
        return units[0] if units else _ANY if _ANY in found else _BARE

    def _power(self, name: str, base: sp.Expr, exponent: sp.Expr) -> _DimensionOrFlexible:
        """Return the dimension of base**exponent. Raise LawError if the exponent has a unit."""
        self._pure(name, "an exponent", self.of(name, exponent))
        found = self.of(name, base)
        if not isinstance(found, Dimension) or found == DIMENSIONLESS:
            return found
        return found ** Fraction(str(exponent)).limit_denominator(1000) if exponent.is_number else _ANY

    def _pure(self, name: str, what: str, found: _DimensionOrFlexible) -> None:
        """Raise LawError if a value that must be dimensionless, described by `what`, has a unit."""
        if isinstance(found, Dimension) and found != DIMENSIONLESS:
            message = f"{self.whose}{name} has {what} of {describe(found)}, expected {describe(DIMENSIONLESS)}"
            raise LawError(message, hint="divide by a number of that unit: one of the law's fields")

    @staticmethod
    def _product(found: list[_DimensionOrFlexible]) -> _DimensionOrFlexible:
        """Return the dimension of a product of factors."""
        if _ANY in found:
            return _ANY
        units = [x for x in found if isinstance(x, Dimension)]
        made = units[0] if units else None
        for unit in units[1:]:
            made = made * unit if made is not None else unit
        return _BARE if made is None else made


def _with_law_names(e: sp.Expr) -> sp.Expr:
    """Return an expression with parameters named as in the law, for messages."""
    return e.xreplace({s: sp.Symbol(s.name.removeprefix("probe_"), real=True) for s in e.free_symbols})


# States at which forces are sampled: δ (m), ratios, δ̇ (m/s); F_n (N), slip (m/s); ε, 1/s. A state is a deflection (m).
_SAMPLES: Mapping[str, tuple[float, ...]] = {
    "delta": (0.0, 1e-9, 1e-6, 1e-4),
    "ratio": (1.0, 0.3, 0.0, -0.4, -1.0),
    "deltadot": (1.0, 1e-3, 0.0, -1e-3, -1.0),
    "F_n": (0.0, 1.0, 1e3),
    "v_t": (-1.0, -1e-4, 0.0, 1e-4, 1.0),
    "epsilon": (0.0, 0.5, 0.9999),
    "w_n": (-10.0, 0.0, 10.0),
    "w_t": (-10.0, 0.0, 10.0),
}
_STATE = (0.0, 1e-6, -1e-6)
_UNITS = {"delta": "m", "deltadot": "m/s", "F_n": "N", "v_t": "m/s", "w_n": "1/s", "w_t": "1/s"}


def check_own_laws(scene: Scene) -> None:
    """Raise LawError if a name in a user-defined law has two meanings, or if units do not fit."""
    for play in scene.play.values():
        some = [(laws()[use.law], use) for use in play.contact.laws]
        if any(law.name in USER_LAWS for law, _ in some):
            names = {law.name: _Names(law, use) for law, use in some}
            for law, use in (one for one in some if one[0].name in USER_LAWS):
                names[law.name].check()
                check_units(law, use)
            _check_together([names[law.name] for law, _ in some if law.role != "film"])


class _Names:
    """Names of the locals and parameters in the function of a law."""

    def __init__(self, law: Law, use: LawUse) -> None:
        """Collect the names by building the law with probe symbols."""
        made = probe(law, use.options, use.quantities)
        self.law = law
        self.locals = [*(state.name for state in law.states), *(name for name in made.steps if name not in law.results)]
        self.numbers = [*use.quantities, *made.derived]

    def check(self) -> None:
        """Raise LawError for a name that is not an identifier, or that the law is given for something else."""
        given = {*PAIR, "transition", *itertools.chain(*VARIABLES.values(), *FURTHER.values(), *RESULTS.values())}
        every = [*self.locals, *self.numbers]
        for name in every:
            try:
                check_name(name, "number or abbreviation")
            except LawError as error:
                raise LawError(f"{_law_prefix(self.law)}{error.message}", hint=error.hint) from None
            if name in given or every.count(name) > 1:
                hint = "call the number, state or abbreviation otherwise; a number's `symbol` may be any letter"
                raise LawError(f"{_law_prefix(self.law)}{name!r} is given to the law for something else", hint=hint)


def _check_together(dry: Sequence[_Names]) -> None:
    """Raise LawError if a local of one law has another meaning in the other law of a dry contact.

    The derivatives of a dry contact are one function, in which each local has one meaning.
    """
    for one, other in itertools.permutations(dry, 2):
        if both := {*one.locals} & {*other.locals, *other.numbers}:
            message = f"{min(both)!r} names something in the contact's other law, {other.law.name}, too"
            raise LawError(f"{_law_prefix(one.law)}{message}", hint="call the abbreviation of your own law otherwise")


def _law_prefix(law: Law) -> str:
    """Return the beginning of a message: the law and the file that defines it."""
    return prefix(law.name, ORIGINS.get(law.name))


def check_numbers(
    law: Law, variables: tuple[sp.Symbol, ...], steps: Mapping[str, sp.Expr], slots: ParameterTable
) -> None:
    """Raise LawError if a force is not a finite real number at sampled states, with the values of the file."""
    numbers = {symbol: np.float64(number_of(slots, symbol)) for symbol in _constants(steps, slots)}
    known, functions = [*numbers, *variables], {}
    for name, step in steps.items():
        functions[name] = sp.lambdify(
            known, step, "numpy"
        )  # contains symbols of known names only, as `build` has checked
        known.append(sp.Symbol(name, real=True))
    for state in itertools.product(*(_SAMPLES.get(symbol.name, _STATE) for symbol in variables)):
        values = [*numbers.values(), *map(np.float64, state)]
        for name, function in functions.items():
            with np.errstate(all="ignore"):
                try:
                    values.append(np.float64(function(*values)))
                except (ArithmeticError, TypeError, ValueError) as error:
                    message = f"{_law_prefix(law)}{name} cannot be computed: {type(error).__name__}: {error}"
                    raise LawError(message, hint="expected a finite real number for every δ > 0") from error
            if not math.isfinite(values[-1]):
                at = ", ".join(
                    f"{s.name} = {x:g} {_UNITS.get(s.name, '')}".strip() for s, x in zip(variables, state, strict=True)
                )
                message = f"{_law_prefix(law)}{name} is {values[-1]:g} at {at}"
                raise LawError(f"{message}, with the file's numbers", hint="expected a finite real number there")
            if name == "share" and not (0.0 <= values[-1] <= 1.0 and (state[0] > 0.0 or values[-1] == 0.0)):
                message = f"{_law_prefix(law)}share is {values[-1]:g} at δ = {state[0]:g} m"
                raise LawError(message, hint="expected a number between 0 and 1, and 0 at δ = 0, where film alone ends")


def _constants(steps: Mapping[str, sp.Expr], slots: ParameterTable) -> set[sp.Symbol]:
    """Return the parameters that the steps of a law read."""
    members = set(slots.members())
    return {symbol for step in steps.values() for symbol in step.free_symbols if symbol in members}


def number_of(slots: ParameterTable, symbol: sp.Symbol) -> float:
    """Return the file's value of a parameter or of a derived parameter; NaN if it is not real."""
    for entry in slots.entries.values():
        if entry.symbol == symbol:
            return entry.default
    value = slots.derived[symbol]
    number = value.xreplace({s: sp.Float(number_of(slots, s), 17) for s in value.free_symbols})
    return float(number) if number.is_real else math.nan

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
from gudgeon.generator.kinds.laws.built import PAIR_QUANTITIES, probe_law
from gudgeon.generator.kinds.laws.law import OPTIONAL_VARIABLES, RESULTS, USER_LAWS, VARIABLES, Law, find_all_laws
from gudgeon.generator.kinds.laws.registered import ORIGINS, check_law_name, format_law_prefix
from gudgeon.generator.mechanism import LawUse, Quantity, Scene, make_force_at_zero_penetration
from gudgeon.generator.symbols.from_expressions import convert_quantity_to_sympy, find_classes
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
    describe_dimension,
)

N_PENETRATIONS = 400  # penetrations at which a force is sampled
_MIN_RELATIVE_PENETRATION = 1e-6  # of the largest of them


def read_force_expression(
    force: Quantity, delta: sp.Symbol, max_penetration: float, parameter_table: ParameterTable
) -> sp.Expr:
    """Return a force of the file as an expression of `delta` and parameters, checked up to `max_penetration` in m.

    If SymPy does not see that the force at δ = 0 is 0, its value there becomes a parameter, which every run checks.
    Raise BadValueError for a force that does not depend on δ, is not finite, is negative, or has no slope at δ = 0.
    """

    def find_law_symbol(path: str) -> sp.Expr:
        """Return the symbol of a name in the expression: `delta` or a parameter.

        The parameter is copied to the symbol table if it belongs to the scene's other one
        (`Symbols.add_shared_parameter`).
        """
        if path == "delta":
            return delta
        parameter: sp.Symbol = parameter_table.entries[f"parameters.{path}"].symbol
        parameter_table.symbols.add_shared_parameter(parameter)
        return parameter

    value = convert_quantity_to_sympy(force, find_law_symbol)
    if not value.has(delta):
        hint = "expected an expression such as 1e8 N/m * delta: its terms cancel"
        raise BadValueError(f"{force.address} does not depend on delta, the penetration", force.where, hint)
    _check_force(force, max_penetration, parameter_table)
    _check_slope(force, value, delta, parameter_table)
    if value.subs(delta, 0) != 0:
        parameter_table.get_or_add_parameter(make_force_at_zero_penetration(force))
    return value


def _check_force(force: Quantity, max_penetration: float, parameter_table: ParameterTable) -> None:
    """Raise BadValueError if a force is not finite or is negative at a sampled δ from 0 to `max_penetration`.

    Penetrations are in m; parameters have the scene's default values.
    """
    depths = np.union1d(
        np.geomspace(_MIN_RELATIVE_PENETRATION * max_penetration, max_penetration, N_PENETRATIONS // 2),
        np.linspace(0.0, max_penetration, N_PENETRATIONS // 2)[1:],
    )
    forces = np.broadcast_to(
        evaluate(
            force.value,
            lambda path: (
                depths if path == "delta" else np.float64(parameter_table.entries[f"parameters.{path}"].default)
            ),
        ),
        depths.shape,
    )
    if len(invalid := np.flatnonzero(~(np.isfinite(forces) & (forces >= 0.0)))):
        first_depth, first_force = depths[invalid[0]], forces[invalid[0]]
        hint = "expected a force that is not negative up to the clearance, or to the key 'deepest'"
        raise BadValueError(f"{force.address} is {first_force:.6g} N at delta = {first_depth:.6g} m", force.where, hint)


def _check_slope(force: Quantity, value: sp.Expr, delta: sp.Symbol, parameter_table: ParameterTable) -> None:
    """Raise BadValueError if the derivative of the force by δ is not finite at δ = 0, so that no Jacobian exists.

    `value` is the force as an expression of `delta` and parameters, which get their defaults in `parameter_table`.
    """
    defaults = {entry.symbol: sp.Float(entry.default, 17) for entry in parameter_table.entries.values()}
    slope = sp.diff(value, delta).xreplace(defaults).subs(delta, 0)
    if slope.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
        hint = "expected a finite slope there: delta**n has one for n >= 1"
        raise BadValueError(f"{force.address} has no slope at delta = 0", force.where, hint)


_VARIABLE_DIMENSIONS: Mapping[str, Dimension] = {
    "delta": LENGTH,
    "ratio": DIMENSIONLESS,
    "deltadot": VELOCITY,
    "F_n": FORCE,
    "v_t": VELOCITY,
    "epsilon": DIMENSIONLESS,
    "w_n": RATE,
    "w_t": RATE,
}
_RESULT_DIMENSIONS: Mapping[str, Dimension] = {
    "F_n": FORCE,
    "F_t": FORCE,
    "F_r": FORCE,
    "T0": TORQUE * TIME,
    "share": DIMENSIONLESS,
}
_PAIR_DIMENSIONS: Mapping[str, Dimension] = {
    "E_i": PRESSURE,
    "E_j": PRESSURE,
    "nu_i": DIMENSIONLESS,
    "nu_j": DIMENSIONLESS,
}
_SAME_UNIT_FUNCTIONS = find_classes(lambda f: f.units is Units.SAME)
_RATIO_FUNCTIONS = find_classes(lambda f: f.units is Units.RATIO)


class _FlexibleDimension:
    """A dimension that is not fixed: of a plain number, or of a value that may have any unit in the file."""


_PLAIN_NUMBER, _ANY_UNIT = _FlexibleDimension(), _FlexibleDimension()
_DimensionOrFlexible = Dimension | _FlexibleDimension


def check_units(law: Law, law_use: LawUse) -> None:
    """Raise LawError if a result of a law has another unit than its role needs, or if unlike units are added.

    The role is normal, friction, film or mixed. `law_use`: the law as the file uses it, with options and quantities.
    """
    probed_law = probe_law(law, law_use.options, law_use.quantities)
    dimension_of_symbol: dict[str, _DimensionOrFlexible] = {
        f"probe_{name}": _PAIR_DIMENSIONS.get(name, LENGTH) for name in PAIR_QUANTITIES
    }
    dimension_of_symbol |= {
        f"probe_{name}": quantity.dimension or _ANY_UNIT for name, quantity in law_use.quantities.items()
    }
    dimension_of_symbol |= {name: _VARIABLE_DIMENSIONS[name] for name in law.variables if name in _VARIABLE_DIMENSIONS}
    dimension_of_symbol |= {state.name: LENGTH for state in law.states}
    dimension_finder = _DimensionFinder(law, dimension_of_symbol)
    for name, value in probed_law.derived.items():
        dimension_of_symbol[f"probe_{name}"] = dimension_finder.find_dimension(name, value)
    for name, step in probed_law.equations_by_name.items():
        dimension_found = dimension_finder.find_dimension(name, step)
        dimension_of_symbol[name] = dimension_found
        expected_dimension = VELOCITY if name.endswith("_rate") else _RESULT_DIMENSIONS.get(name)
        if (
            name in law.results
            and expected_dimension
            and isinstance(dimension_found, Dimension)
            and dimension_found != expected_dimension
        ):
            hint = "declare a number with a unit as a field of the law: number(name, meaning, DIMENSION, default=…)"
            raise LawError(
                f"{dimension_finder.message_prefix}{name} is {describe_dimension(dimension_found)}, expected "
                f"{describe_dimension(expected_dimension)}",
                hint=hint,
            )


@dataclass
class _DimensionFinder:
    """Dimensions of a law's expressions, found from those of its symbols in `dimension_of_symbol`."""

    law: Law
    dimension_of_symbol: Mapping[str, _DimensionOrFlexible]  # by names of symbols
    cache: dict[sp.Expr, _DimensionOrFlexible] = field(default_factory=dict)

    @property
    def message_prefix(self) -> str:
        """Return the beginning of a message: the law and the file that defines it."""
        return format_law_prefix(self.law.name, ORIGINS.get(self.law.name))

    def find_dimension(self, name: str, expression: sp.Expr) -> _DimensionOrFlexible:
        """Return the dimension of an expression, from a cache; `name`: the result or abbreviation of the law.

        Raise LawError, with that name, if terms of the expression have unlike units.
        """
        if expression not in self.cache:
            self.cache[expression] = self._compute_dimension(name, expression)
        return self.cache[expression]

    def _compute_dimension(self, name: str, expression: sp.Expr) -> _DimensionOrFlexible:
        """Return the dimension of an expression without reading the cache.

        A number gives `_PLAIN_NUMBER`, a symbol without a fixed unit `_ANY_UNIT`. Raise LawError if terms have unlike
        units, or if an exponent or the argument of a function such as sin has a unit.
        """
        if expression.is_number:
            return _PLAIN_NUMBER
        if expression.is_Symbol:
            return self.dimension_of_symbol.get(expression.name, _ANY_UNIT)
        if expression.is_Pow or isinstance(expression, sp.exp):
            return self._compute_power_dimension(name, *expression.as_base_exp())
        dimensions = [self.find_dimension(name, part) for part in expression.args]
        if expression.is_Mul:
            return self._multiply_dimensions(dimensions)
        if expression.is_Add or isinstance(expression, (*_SAME_UNIT_FUNCTIONS, *_RATIO_FUNCTIONS)):
            common = self._find_common_dimension(name, expression, dimensions)
            return DIMENSIONLESS if isinstance(expression, _RATIO_FUNCTIONS) else common
        if type(expression).__name__ == "Unevaluated":
            return dimensions[0]
        self._check_dimensionless(name, type(expression).__name__, dimensions[0])
        return DIMENSIONLESS

    def _find_common_dimension(
        self, name: str, expression: sp.Expr, dimensions: list[_DimensionOrFlexible]
    ) -> _DimensionOrFlexible:
        """Return the common dimension of terms that are added or compared; `dimensions` are theirs, in order.

        It is `_ANY_UNIT` or `_PLAIN_NUMBER` if no term has a fixed one. Raise LawError if two differ. A plain number
        other than 0 counts as dimensionless.
        """
        known_dimensions = sorted({dimension for dimension in dimensions if isinstance(dimension, Dimension)}, key=str)
        plain_number = next(
            (
                term
                for term, dimension in zip(expression.args, dimensions, strict=True)
                if dimension is _PLAIN_NUMBER and not term.is_zero
            ),
            None,
        )
        unlike_text = describe_dimension(known_dimensions[1]) if len(known_dimensions) > 1 else ""
        if known_dimensions and plain_number is not None and not unlike_text and known_dimensions[0] != DIMENSIONLESS:
            unlike_text = f"{float(plain_number):g}, a pure number"
        if unlike_text:
            operation = "adds" if expression.is_Add else f"takes {type(expression).__name__} of"
            text = sp.sstr(_restore_law_names(expression))[:120]
            raise LawError(
                f"{self.message_prefix}{name} {operation} {describe_dimension(known_dimensions[0])} and "
                f"{unlike_text}: {text}",
                hint="declare a number with a unit as a field of the law",
            )
        return known_dimensions[0] if known_dimensions else _ANY_UNIT if _ANY_UNIT in dimensions else _PLAIN_NUMBER

    def _compute_power_dimension(self, name: str, base: sp.Expr, exponent: sp.Expr) -> _DimensionOrFlexible:
        """Return the dimension of base**exponent; `name`: the law's result or abbreviation, for messages.

        A base that is dimensionless, a plain number or of any unit keeps its dimension. A base with a unit and an
        exponent that is not a number give `_ANY_UNIT`. Raise LawError if the exponent has a unit.
        """
        self._check_dimensionless(name, "an exponent", self.find_dimension(name, exponent))
        base_dimension = self.find_dimension(name, base)
        if not isinstance(base_dimension, Dimension) or base_dimension == DIMENSIONLESS:
            return base_dimension
        return base_dimension ** Fraction(str(exponent)).limit_denominator(1000) if exponent.is_number else _ANY_UNIT

    def _check_dimensionless(self, name: str, description: str, dimension: _DimensionOrFlexible) -> None:
        """Raise LawError if a value that must be dimensionless has a fixed dimension other than 1.

        `name`: the law's result or abbreviation; `description`: the value in the message, such as "an exponent".
        """
        if isinstance(dimension, Dimension) and dimension != DIMENSIONLESS:
            message = (
                f"{name} has {description} of {describe_dimension(dimension)}, expected "
                f"{describe_dimension(DIMENSIONLESS)}"
            )
            raise LawError(f"{self.message_prefix}{message}", hint="divide by a field of the law with that unit")

    @staticmethod
    def _multiply_dimensions(dimensions: list[_DimensionOrFlexible]) -> _DimensionOrFlexible:
        """Return the dimension of a product from those of its factors.

        Return `_ANY_UNIT` if one factor may have any unit. Otherwise plain numbers do not count; return `_PLAIN_NUMBER`
        if all factors are plain numbers.
        """
        if _ANY_UNIT in dimensions:
            return _ANY_UNIT
        known_dimensions = [dimension for dimension in dimensions if isinstance(dimension, Dimension)]
        product = known_dimensions[0] if known_dimensions else None
        for factor in known_dimensions[1:]:
            product = product * factor if product is not None else factor
        return _PLAIN_NUMBER if product is None else product


def _restore_law_names(expression: sp.Expr) -> sp.Expr:
    """Return an expression with parameters named as in the law, without the prefix "probe_", for messages."""
    return expression.xreplace(
        {symbol: sp.Symbol(symbol.name.removeprefix("probe_"), real=True) for symbol in expression.free_symbols}
    )


# States at which forces are sampled: δ (m), ratios, δ̇ (m/s); F_n (N), slip (m/s); ε, 1/s. A state is a deflection (m).
_SAMPLE_VALUES: Mapping[str, tuple[float, ...]] = {
    "delta": (0.0, 1e-9, 1e-6, 1e-4),
    "ratio": (1.0, 0.3, 0.0, -0.4, -1.0),
    "deltadot": (1.0, 1e-3, 0.0, -1e-3, -1.0),
    "F_n": (0.0, 1.0, 1e3),
    "v_t": (-1.0, -1e-4, 0.0, 1e-4, 1.0),
    "epsilon": (0.0, 0.5, 0.9999),
    "w_n": (-10.0, 0.0, 10.0),
    "w_t": (-10.0, 0.0, 10.0),
}
_STATE_SAMPLES = (0.0, 1e-6, -1e-6)
_UNIT_OF_VARIABLE = {"delta": "m", "deltadot": "m/s", "F_n": "N", "v_t": "m/s", "w_n": "1/s", "w_t": "1/s"}


def check_user_defined_laws(scene: Scene) -> None:
    """Raise LawError if a name in a user-defined law of the scene has two meanings, or if units do not fit."""
    for play in scene.play.values():
        laws_in_use = [(find_all_laws()[law_use.law], law_use) for law_use in play.contact.laws]
        if any(law.name in USER_LAWS for law, _ in laws_in_use):
            names = {law.name: _LawNames(law, law_use) for law, law_use in laws_in_use}
            for law, law_use in (pair for pair in laws_in_use if pair[0].name in USER_LAWS):
                names[law.name].check_law_names()
                check_units(law, law_use)
            _check_common_names([names[law.name] for law, _ in laws_in_use if law.role != "film"])


class _LawNames:
    """Names of the locals and parameters in the function of a law, for checks of duplicates."""

    def __init__(self, law: Law, law_use: LawUse) -> None:
        """Collect the names of locals and parameters by building the law with probe symbols."""
        probed_law = probe_law(law, law_use.options, law_use.quantities)
        self.law = law
        self.local_names = [
            *(state.name for state in law.states),
            *(name for name in probed_law.equations_by_name if name not in law.results),
        ]
        self.parameter_names = [*law_use.quantities, *probed_law.derived]

    def check_law_names(self) -> None:
        """Raise LawError for a name that is not an identifier, occurs twice, or has a fixed meaning for the law.

        Checked are the names of numbers, internal states and abbreviations of a user-defined law, when a scene uses it.
        """
        fixed_names = {
            *PAIR_QUANTITIES,
            "transition",
            *itertools.chain(*VARIABLES.values(), *OPTIONAL_VARIABLES.values(), *RESULTS.values()),
        }
        all_names = [*self.local_names, *self.parameter_names]
        for name in all_names:
            try:
                check_law_name(name, "number or abbreviation")
            except LawError as error:
                raise LawError(f"{_format_law_prefix(self.law)}{error.message}", hint=error.hint) from None
            if name in fixed_names or all_names.count(name) > 1:
                hint = (
                    "choose another name for the number, state or abbreviation; a number's `symbol` may be any letter"
                )
                raise LawError(
                    f"{_format_law_prefix(self.law)}{name!r} already has another meaning in the law", hint=hint
                )


def _check_common_names(dry_laws: Sequence[_LawNames]) -> None:
    """Raise LawError if a local of one law has the name of a local or parameter of another law of the same contact.

    `dry_laws`: all laws of the contact but the film. Their derivatives are one function, in which a name has one
    meaning.
    """
    for first_law, other_law in itertools.permutations(dry_laws, 2):
        if common_names := {*first_law.local_names} & {*other_law.local_names, *other_law.parameter_names}:
            message = f"{min(common_names)!r} is also a name in the contact's other law, {other_law.law.name}"
            raise LawError(
                f"{_format_law_prefix(first_law.law)}{message}",
                hint="choose another name for the abbreviation in the user-defined law",
            )


def _format_law_prefix(law: Law) -> str:
    """Return the beginning of a message: the law and the file that defines it."""
    return format_law_prefix(law.name, ORIGINS.get(law.name))


def check_sampled_values(
    law: Law,
    variables: tuple[sp.Symbol, ...],
    equations_by_name: Mapping[str, sp.Expr],
    parameter_table: ParameterTable,
) -> None:
    """Raise LawError if an equation of a law is not a finite real number at a sampled state, with the file's values.

    `variables`: the symbols that are sampled (`_SAMPLE_VALUES`); `equations_by_name`: in order. A fraction
    `share` of the dry contact must be between 0 and 1, and 0 at δ = 0.
    """
    parameter_values = {
        symbol: np.float64(find_default_value(parameter_table, symbol))
        for symbol in _find_parameters(equations_by_name, parameter_table)
    }
    arguments, function_by_name = [*parameter_values, *variables], {}
    for name, step in equations_by_name.items():
        function_by_name[name] = sp.lambdify(
            arguments, step, "numpy"
        )  # contains symbols of known names only, as `build` has checked
        arguments.append(sp.Symbol(name, real=True))
    for state in itertools.product(*(_SAMPLE_VALUES.get(symbol.name, _STATE_SAMPLES) for symbol in variables)):
        values = [*parameter_values.values(), *map(np.float64, state)]
        for name, function in function_by_name.items():
            with np.errstate(all="ignore"):
                try:
                    values.append(np.float64(function(*values)))
                except (ArithmeticError, TypeError, ValueError) as error:
                    message = f"{_format_law_prefix(law)}{name} cannot be computed: {type(error).__name__}: {error}"
                    raise LawError(message, hint="expected a finite real number for every δ > 0") from error
            if not math.isfinite(values[-1]):
                state_text = ", ".join(
                    f"{symbol.name} = {x:g} {_UNIT_OF_VARIABLE.get(symbol.name, '')}".strip()
                    for symbol, x in zip(variables, state, strict=True)
                )
                message = f"{_format_law_prefix(law)}{name} is {values[-1]:g} at {state_text}"
                raise LawError(
                    f"{message}, with the file's parameter values", hint="expected a finite real number there"
                )
            if name == "share" and not (0.0 <= values[-1] <= 1.0 and (state[0] > 0.0 or values[-1] == 0.0)):
                message = f"{_format_law_prefix(law)}share is {values[-1]:g} at δ = {state[0]:g} m"
                raise LawError(
                    message, hint="expected a number between 0 and 1, and 0 at δ = 0, where the film stops acting alone"
                )


def _find_parameters(equations_by_name: Mapping[str, sp.Expr], parameter_table: ParameterTable) -> set[sp.Symbol]:
    """Return the parameters, given and derived ones, that the equations of a law read."""
    members = set(parameter_table.list_symbols())
    return {symbol for step in equations_by_name.values() for symbol in step.free_symbols if symbol in members}


def find_default_value(parameter_table: ParameterTable, symbol: sp.Symbol) -> float:
    """Return the default value of a parameter, or of a derived parameter with all defaults; NaN if it is not real."""
    for entry in parameter_table.entries.values():
        if entry.symbol == symbol:
            return entry.default
    value = parameter_table.derived[symbol]
    result = value.xreplace(
        {symbol_: sp.Float(find_default_value(parameter_table, symbol_), 17) for symbol_ in value.free_symbols}
    )
    return float(result) if result.is_real else math.nan

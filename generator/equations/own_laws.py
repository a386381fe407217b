"""Laws of the user's own in a scene: whether their names have one meaning, and their forces are numbers."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence

import numpy as np
import sympy as sp

from gudgeon.errors import LawError
from gudgeon.generator.equations.law_units import check_units
from gudgeon.generator.kinds.laws.built import PAIR, probe
from gudgeon.generator.kinds.laws.law import FURTHER, OWN, RESULTS, VARIABLES, Law, laws
from gudgeon.generator.kinds.laws.registered import ORIGINS, check_name, prefix
from gudgeon.generator.mechanism.mechanism import LawUse
from gudgeon.generator.mechanism.scene import Scene
from gudgeon.generator.symbols.numbers import Slots

# Where forces are looked at: δ (m), ratios, δ̇ (m/s); F_n (N), slip (m/s); ε, 1/s. A state is a deflection (m).
_LOOKS: Mapping[str, tuple[float, ...]] = {
    "delta": (0.0, 1e-9, 1e-6, 1e-4), "ratio": (1.0, 0.3, 0.0, -0.4, -1.0), "deltadot": (1.0, 1e-3, 0.0, -1e-3, -1.0),
    "F_n": (0.0, 1.0, 1e3), "v_t": (-1.0, -1e-4, 0.0, 1e-4, 1.0),
    "epsilon": (0.0, 0.5, 0.9999), "w_n": (-10.0, 0.0, 10.0), "w_t": (-10.0, 0.0, 10.0),
}  # fmt: skip
_STATE = (0.0, 1e-6, -1e-6)
_UNITS = {"delta": "m", "deltadot": "m/s", "F_n": "N", "v_t": "m/s", "w_n": "1/s", "w_t": "1/s"}


def check_own_laws(scene: Scene) -> None:
    """Raise LawError where a name in a user-defined law has two meanings, and for units that do not fit."""
    for play in scene.play.values():
        some = [(laws()[use.law], use) for use in play.contact.laws]
        if any(law.name in OWN for law, _ in some):
            names = {law.name: _Names(law, use) for law, use in some}
            for law, use in (one for one in some if one[0].name in OWN):
                names[law.name].check()
                check_units(law, use)
            _check_together([names[law.name] for law, _ in some if law.role != "film"])


class _Names:
    """What a law calls the locals and the numbers of its function."""

    def __init__(self, law: Law, use: LawUse) -> None:
        made = probe(law, use.options, use.quantities)
        self.law = law
        self.locals = [*(state.name for state in law.states), *(name for name in made.steps if name not in law.results)]
        self.numbers = [*use.quantities, *made.derived]

    def check(self) -> None:
        """Raise LawError for a name that is no identifier, or that the law is given for something else."""
        given = {*PAIR, "transition", *itertools.chain(*VARIABLES.values(), *FURTHER.values(), *RESULTS.values())}
        every = [*self.locals, *self.numbers]
        for name in every:
            try:
                check_name(name, "number or abbreviation")
            except LawError as error:
                raise LawError(f"{_whose(self.law)}{error.message}", hint=error.hint) from None
            if name in given or every.count(name) > 1:
                hint = "call the number, state or abbreviation otherwise; a number's `symbol` may be any letter"
                raise LawError(f"{_whose(self.law)}{name!r} is given to the law for something else", hint=hint)


def _check_together(dry: Sequence[_Names]) -> None:
    """The slopes of a dry contact are one function: what is local there has one meaning."""
    for one, other in itertools.permutations(dry, 2):
        if both := {*one.locals} & {*other.locals, *other.numbers}:
            told = f"{min(both)!r} names something in the contact's other law, {other.law.name}, too"
            raise LawError(f"{_whose(one.law)}{told}", hint="call the abbreviation of your own law otherwise")


def _whose(law: Law) -> str:
    return prefix(law.name, ORIGINS.get(law.name))


def check_numbers(law: Law, variables: tuple[sp.Symbol, ...], steps: Mapping[str, sp.Expr], slots: Slots) -> None:
    """Raise LawError where a force is no finite real number, with the numbers that the file gives."""
    numbers = {symbol: np.float64(number_of(slots, symbol)) for symbol in _constants(steps, slots)}
    known, functions = [*numbers, *variables], {}
    for name, step in steps.items():
        functions[name] = sp.lambdify(known, step, "numpy")  # symbols of known names alone: build has looked
        known.append(sp.Symbol(name, real=True))
    for state in itertools.product(*(_LOOKS.get(symbol.name, _STATE) for symbol in variables)):
        values = [*numbers.values(), *map(np.float64, state)]
        for name, function in functions.items():
            with np.errstate(all="ignore"):
                try:
                    values.append(np.float64(function(*values)))
                except (ArithmeticError, TypeError, ValueError) as error:
                    told = f"{_whose(law)}{name} cannot be computed: {type(error).__name__}: {error}"
                    raise LawError(told, hint="expected a finite real number for every δ > 0") from error
            if not math.isfinite(values[-1]):
                at = ", ".join(f"{s.name} = {x:g} {_UNITS.get(s.name, '')}".strip()
                               for s, x in zip(variables, state, strict=True))  # fmt: skip
                told = f"{_whose(law)}{name} is {values[-1]:g} at {at}"
                raise LawError(f"{told}, with the file's numbers", hint="expected a finite real number there")
            if name == "share" and not (0.0 <= values[-1] <= 1.0 and (state[0] > 0.0 or values[-1] == 0.0)):
                told = f"{_whose(law)}share is {values[-1]:g} at δ = {state[0]:g} m"
                raise LawError(told, hint="expected a number between 0 and 1, and 0 at δ = 0, where film alone ends")


def _constants(steps: Mapping[str, sp.Expr], slots: Slots) -> set[sp.Symbol]:
    members = set(slots.members())
    return {symbol for step in steps.values() for symbol in step.free_symbols if symbol in members}


def number_of(slots: Slots, symbol: sp.Symbol) -> float:
    """The file's own value of a number, or of what is derived from such."""
    for entry in slots.entries.values():
        if entry.symbol == symbol:
            return entry.default
    value = slots.derived[symbol]
    number = value.xreplace({s: sp.Float(number_of(slots, s), 17) for s in value.free_symbols})
    return float(number) if number.is_real else math.nan

"""Laws of the user's own in a scene: their names in the emitted C, and whether their forces are numbers."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping

import numpy as np
import sympy as sp

from gudgeon.errors import LawError
from gudgeon.generator.kinds.laws.built import PAIR, probe
from gudgeon.generator.kinds.laws.law import OWN, RESULTS, VARIABLES, Law
from gudgeon.generator.kinds.laws.registered import ORIGINS, check_name, prefix
from gudgeon.generator.mechanism.mechanism import LawUse
from gudgeon.generator.mechanism.scene import Scene
from gudgeon.generator.symbols.numbers import Slots
from gudgeon.generator.symbols.symbols import is_in_code

_LETTERS = frozenset(("root", "W", "factor"))  # abbreviations of the house, which may be those of others
# Where forces are looked at: δ (m), ratios, δ̇ (m/s); F_n (N), slip (m/s); ε, 1/s. A state is a deflection (m).
_LOOKS: Mapping[str, tuple[float, ...]] = {
    "delta": (0.0, 1e-9, 1e-6, 1e-4), "ratio": (1.0, 0.3, 0.0, -0.4, -1.0), "deltadot": (1.0, 1e-3, 0.0, -1e-3, -1.0),
    "F_n": (0.0, 1.0, 1e3), "v_t": (-1.0, -1e-4, 0.0, 1e-4, 1.0),
    "epsilon": (0.0, 0.5, 0.9999), "w_n": (-10.0, 0.0, 10.0), "w_t": (-10.0, 0.0, 10.0),
}  # fmt: skip
_STATE = (0.0, 1e-6, -1e-6)
_UNITS = {"delta": "m", "deltadot": "m/s", "F_n": "N", "v_t": "m/s", "w_n": "1/s", "w_t": "1/s"}


def own_letters(scene: Scene) -> frozenset[str]:
    """What the scene's laws that are the user's own call their variables, results and abbreviations.

    In emitted code nothing else may be called so. Raises LawError for a name that something else has there.
    """
    return frozenset(name for law, use in _uses(scene) for name in _letters(law, use))


def _uses(scene: Scene) -> Iterator[tuple[Law, LawUse]]:
    for play in scene.play.values():
        for use in (play.contact.normal, play.contact.friction, play.contact.film):
            if use is not None and use.law in OWN:
                yield OWN[use.law], use


def _letters(law: Law, use: LawUse) -> set[str]:
    made = probe(law, use.options, use.quantities)
    own = [*(state.name for state in law.states), *(name for name in made.steps if name not in law.results)]
    numbers = [*use.quantities, *made.derived]
    reserved = {*PAIR, "transition", *itertools.chain(*VARIABLES.values(), *RESULTS.values()), "deltadot"}
    for name in (*own, *numbers):
        told = f"{prefix(law.name, ORIGINS.get(law.name))}"
        try:
            check_name(name, "number or abbreviation")
        except LawError as error:
            raise LawError(f"{told}{error.message}", hint=error.hint) from None
        taken = name not in _LETTERS and is_in_code(name)
        if taken or name in reserved or [*own, *numbers].count(name) > 1:
            hint = "call the number, state or abbreviation otherwise; its `symbol` may be any letter"
            raise LawError(f"{told}the emitted C has {name!r} for something else", hint=hint)
    return {*own, *law.variables, *law.results}


def check_numbers(law: Law, variables: tuple[sp.Symbol, ...], steps: Mapping[str, sp.Expr], slots: Slots) -> None:
    """Raise LawError where a force is no finite real number, with the numbers that the file gives."""
    numbers = {symbol: np.float64(_number(slots, symbol)) for symbol in _constants(steps, slots)}
    known, functions = [*numbers, *variables], {}
    for name, step in steps.items():
        functions[name] = sp.lambdify(known, step, "numpy")
        known.append(sp.Symbol(name, real=True))
    for state in itertools.product(*(_LOOKS.get(symbol.name, _STATE) for symbol in variables)):
        values = [*numbers.values(), *map(np.float64, state)]
        for name, function in functions.items():
            with np.errstate(all="ignore"):
                values.append(np.float64(function(*values)))
            if not math.isfinite(values[-1]):
                at = ", ".join(f"{s.name} = {x:g} {_UNITS.get(s.name, '')}".strip()
                               for s, x in zip(variables, state, strict=True))  # fmt: skip
                told = f"{prefix(law.name, ORIGINS.get(law.name))}{name} is {values[-1]:g} at {at}"
                raise LawError(f"{told}, with the file's numbers", hint="expected a finite real number there")


def _constants(steps: Mapping[str, sp.Expr], slots: Slots) -> set[sp.Symbol]:
    members = set(slots.members())
    return {symbol for step in steps.values() for symbol in step.free_symbols if symbol in members}


def _number(slots: Slots, symbol: sp.Symbol) -> float:
    """The file's own value of a number, or of what is derived from such."""
    for entry in slots.entries.values():
        if entry.symbol == symbol:
            return entry.default
    value = slots.derived[symbol]
    number = value.xreplace({s: sp.Float(_number(slots, s), 17) for s in value.free_symbols})
    return float(number) if number.is_real else math.nan

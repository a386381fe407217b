"""Random expressions of a wanted dimension, with all functions and operators of the language; valid, if seldom wise."""

from __future__ import annotations

import random
import re
from collections.abc import Collection, Mapping

from gudgeon.language.functions import FUNCTIONS, Units
from gudgeon.language.units import DIMENSIONLESS, LENGTH, RATE, TIME, Dimension, find_si_unit

OF_A_NUMBER = tuple(
    name for name, f in FUNCTIONS.items() if len(f.arguments) == 1 and f.units in (Units.PURE, Units.ROOT)
)
_NAME = re.compile(r"[A-Za-z_][\w.]*")
_NUMBERS = ("0.5", "2", "0.1", "3.7", "1e-3", "1", "12", "0.25", "1.5e2", "7")
_ANGLES = ("rad", "deg", "mrad", "rev")


class Writer:
    """Writes expressions in some names, one of `vary` at least. `jumps`: it may, by sign, where and mod."""

    def __init__(
        self, rng: random.Random, names: Mapping[str, Dimension], vary: Collection[str], jumps: bool = True
    ) -> None:
        self._rng, self._names, self._vary, self._jumps = rng, dict(names), tuple(vary), jumps

    def write(self, of: Dimension, depth: int = 3) -> str:
        """Text of an expression of this dimension that varies; alone as often as in company."""
        text = self._lone(of) if self._rng.random() < 0.25 else self._any(of, depth)
        if not set(_NAME.findall(text)).isdisjoint(self._vary):
            return text
        return f"{text} + {self._as(self._rng.choice(self._vary), of)}"

    def _lone(self, of: Dimension) -> str:
        """One function of one name, as one writes it first; of other than numbers with a factor."""
        inner = self._angle()
        if self._rng.random() < 0.3:
            inner = f"-{inner}"
        function = self._rng.choice(("sin", "cos", "sin", "cos", *OF_A_NUMBER))
        factor = "" if of == DIMENSIONLESS else f"{self._number(of)} * "
        return f"{factor}{function}({inner})"

    def _angle(self) -> str:
        """A name of no dimension, or t with a rate."""
        bare = [name for name, found in self._names.items() if found == DIMENSIONLESS]
        if bare and self._rng.random() < 0.7:
            return self._rng.choice(bare)
        return self._name(DIMENSIONLESS)

    def _number(self, of: Dimension) -> str:
        number = self._rng.choice(_NUMBERS)
        if of == DIMENSIONLESS:
            return number if self._rng.random() < 0.7 else f"{number} {self._rng.choice(_ANGLES)}"
        return f"{number} {find_si_unit(of)}" if of.is_whole else f"({number} {find_si_unit(of**2)})**0.5"

    def _name(self, of: Dimension) -> str:
        return self._as(self._rng.choice(tuple(self._names)), of)

    def _as(self, name: str, of: Dimension) -> str:
        """A name made into what is wanted."""
        found = self._names[name]
        if found == of:
            return name
        if found == TIME and of == DIMENSIONLESS:
            return self._rng.choice((f"{name} * 1 rad/s", f"2*pi*{name} / (1 s)", f"{name} / (0.3 s)"))
        return f"{name} * {self._factor(of / found)}"

    def _factor(self, of: Dimension) -> str:
        return self._number(of) if of.is_whole else f"({self._number(of**2)})**0.5"

    def _any(self, of: Dimension, depth: int) -> str:
        rng = self._rng
        if depth == 0:
            return self._name(of) if rng.random() < 0.7 else self._number(of)
        kind = rng.randrange(13 if of != DIMENSIONLESS else 22)
        a, one = (lambda: self._any(of, depth - 1)), (lambda: self._any(DIMENSIONLESS, depth - 1))
        if self._jumps and rng.random() < 0.08:
            return self._chosen(of, depth) if rng.random() < 0.6 else f"mod({a()}, {self._number(of)})"
        match kind:
            case 0 | 1:
                return f"{a()} {rng.choice('+-')} ({a()})"
            case 2:
                return f"-({a()})"
            case 3:
                return f"({a()}) * ({one()})"
            case 4:
                return f"({a()}) / (1.5 + ({one()})**2)"
            case 5:
                return f"abs({a()})"
            case 6:
                return f"{rng.choice(('min', 'max', 'hypot'))}({a()}, {a()})"
            case 7:
                return f"({rng.choice((f'({a()})**2', f'({a()})**2 + ({a()})**2', f'({a()}) * ({a()})'))})**0.5"
            case 8:
                return f"sqrt(({a()})**2{rng.choice(('', ' + 0', f' + ({a()})**2'))})"
            case 9 | 10:
                return self._name(of)
            case 11:
                return f"({a()}) * sin({self._angle()})"
            case 12:
                return f"{self._number(of)} * {one()}" if depth == 1 else f"({one()}) * {self._factor(of)}"
        return self._of_numbers(kind, depth)

    def _chosen(self, of: Dimension, depth: int) -> str:
        other = self._rng.choice((of, DIMENSIONLESS, LENGTH, TIME, RATE))
        compared = f" {self._rng.choice(('<', '<=', '>', '>='))} ".join(self._any(other, depth - 1) for _ in range(2))
        return f"where({compared}, {self._any(of, depth - 1)}, {self._any(of, depth - 1)})"

    def _of_numbers(self, kind: int, depth: int) -> str:
        """What a pure number may be besides."""
        rng = self._rng
        other = rng.choice((DIMENSIONLESS, LENGTH, TIME, RATE))
        x, one = (lambda: self._any(other, depth - 1)), (lambda: self._any(DIMENSIONLESS, depth - 1))
        if kind < 16:
            return f"{rng.choice(OF_A_NUMBER)}({one()})"
        if kind == 16:
            return f"({one()})**{rng.choice(('2', '3', '-1', '0.5', '(1/3)', '-2', '1.5', '5'))}"
        if kind == 17:
            return f"(1.5 + sin({self._angle()}))**({one()})"
        if kind == 18:
            return f"atan2({x()}, {x()})"
        if kind == 19 and self._jumps:
            return f"sign({x()})"
        if kind == 20:
            return f"{rng.choice(('ramp', 'smooth_step'))}({x()}, {self._number(other)}, {self._number(other)})"
        return f"({x()}) / ({self._number(other)})"

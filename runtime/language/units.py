"""Define dimensions and the published list of units, and parse units.

The list is closed, so that `t`, `c`, `k` are never tonnes, light or Boltzmann. A test compares every entry with pint.
Factors are exact fractions (times a power of π), so that `0.3 mm` is the binary64 number nearest to 3e-4. Roots of
factors, for units such as `N/mm^1.5`, have thirty digits.
"""

from __future__ import annotations

import math
import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache


@dataclass(frozen=True)
class Dimension:
    """Hold the exponents of metre, kilogram and second; an angle has none (rad = 1)."""

    length: Fraction = Fraction(0)
    mass: Fraction = Fraction(0)
    time: Fraction = Fraction(0)

    def __mul__(self, other: Dimension) -> Dimension:
        """Return the dimension of a product."""
        return Dimension(self.length + other.length, self.mass + other.mass, self.time + other.time)

    def __truediv__(self, other: Dimension) -> Dimension:
        """Return the dimension of a quotient."""
        return self * other**-1

    def __pow__(self, exponent: int | Fraction) -> Dimension:
        """Return the dimension of a power."""
        return Dimension(self.length * exponent, self.mass * exponent, self.time * exponent)

    @property
    def is_whole(self) -> bool:
        """Return whether all exponents are integers."""
        return all(e.denominator == 1 for e in (self.length, self.mass, self.time))

    @property
    def has_halves_at_most(self) -> bool:
        """Return whether all exponents are integers or halves, as numbers of a run may have (N/m^1.5)."""
        return (self**2).is_whole


def dimension(length: float = 0, mass: float = 0, time: float = 0) -> Dimension:
    """Return the dimension m^length kg^mass s^time."""
    return Dimension(Fraction(length), Fraction(mass), Fraction(time))


DIMENSIONLESS = dimension()
LENGTH = dimension(length=1)
MASS = dimension(mass=1)
TIME = dimension(time=1)
INERTIA = dimension(length=2, mass=1)
RATE = dimension(time=-1)  # an angular velocity, too
ANGULAR_ACCELERATION = dimension(time=-2)
VELOCITY = dimension(length=1, time=-1)
ACCELERATION = dimension(length=1, time=-2)
FORCE = dimension(length=1, mass=1, time=-2)
TORQUE = dimension(length=2, mass=1, time=-2)  # and energy
POWER = dimension(length=2, mass=1, time=-3)
STIFFNESS = dimension(mass=1, time=-2)
DAMPING = dimension(mass=1, time=-1)
PRESSURE = dimension(length=-1, mass=1, time=-2)
VISCOSITY = dimension(length=-1, mass=1, time=-1)
DENSITY = dimension(length=-3, mass=1)

# description and SI unit of known dimensions
_WORDS: Mapping[Dimension, tuple[str, str]] = {
    DIMENSIONLESS: ("a pure number or an angle", "rad"),
    LENGTH: ("a length", "m"),
    MASS: ("a mass", "kg"),
    TIME: ("a time", "s"),
    INERTIA: ("a moment of inertia", "kg*m^2"),
    RATE: ("a rate or an angular velocity", "rad/s"),
    ANGULAR_ACCELERATION: ("an angular acceleration", "rad/s^2"),
    VELOCITY: ("a velocity", "m/s"),
    ACCELERATION: ("an acceleration", "m/s^2"),
    FORCE: ("a force", "N"),
    TORQUE: ("a torque or an energy", "N*m"),
    POWER: ("a power", "W"),
    STIFFNESS: ("a stiffness", "N/m"),
    FORCE / LENGTH ** Fraction(3, 2): ("a stiffness by Hertz", "N/m^1.5"),
    DAMPING: ("a damping coefficient", "N*s/m"),
    PRESSURE: ("a pressure", "Pa"),
    VISCOSITY: ("a viscosity", "Pa*s"),
    DENSITY: ("a density", "kg/m^3"),
    LENGTH**2: ("an area", "m^2"),
    LENGTH**3: ("a volume", "m^3"),
}


def si_unit(of: Dimension) -> str:
    """Return the SI unit of a dimension as files write it: "m", "kg*m^2", "1/s"; "" for a pure number."""
    if of == DIMENSIONLESS:
        return ""
    if of == RATE:
        return "1/s"
    if of in _WORDS:
        return _WORDS[of][1]
    exponents = {"kg": of.mass, "m": of.length, "s": of.time}
    above = "*".join(_format_power(s, e) for s, e in exponents.items() if e > 0)
    below = "".join("/" + _format_power(s, -e) for s, e in exponents.items() if e < 0)
    return (above or "1") + below


def _format_power(symbol: str, exponent: Fraction) -> str:
    """Return a unit symbol with its exponent as text."""
    if exponent == 1:
        return symbol
    return f"{symbol}^{exponent}" if exponent.denominator == 1 else f"{symbol}^({exponent})"


def describe(of: Dimension) -> str:
    """Return a dimension in words: "a length (m)"."""
    word, unit = _WORDS.get(of, ("a quantity", si_unit(of)))
    return f"{word} ({unit})"


@dataclass(frozen=True)
class Unit:
    """Hold a unit in SI: `factor` · π^`pi_power` of the SI unit of `dimension`."""

    factor: Fraction
    pi_power: int
    dimension: Dimension

    def to_si(self, number: Fraction) -> float:
        """Return `number` of this unit in SI, rounded once."""
        return float(number * self.factor * Fraction(math.pi) ** self.pi_power)


def _unit(factor: str, of: Dimension, pi_power: int = 0) -> Unit:
    """Return a unit from its factor as text, its dimension and its power of π."""
    return Unit(Fraction(factor), pi_power, of)


# Hz is left out on purpose: read as 1/s it is 2π wrong for an angular velocity; rev/s and 1/s say which is meant.
_SYMBOLS: Mapping[str, Unit] = {
    "m": _unit("1", LENGTH),
    "km": _unit("1000", LENGTH),
    "cm": _unit("0.01", LENGTH),
    "mm": _unit("1e-3", LENGTH),
    "um": _unit("1e-6", LENGTH),
    "\u00b5m": _unit("1e-6", LENGTH),
    "\u03bcm": _unit("1e-6", LENGTH),
    "nm": _unit("1e-9", LENGTH),
    "in": _unit("0.0254", LENGTH),
    "inch": _unit("0.0254", LENGTH),
    "ft": _unit("0.3048", LENGTH),
    "kg": _unit("1", MASS),
    "g": _unit("1e-3", MASS),
    "mg": _unit("1e-6", MASS),
    "gram": _unit("1e-3", MASS),
    "grams": _unit("1e-3", MASS),
    "lb": _unit("0.45359237", MASS),
    "s": _unit("1", TIME),
    "ms": _unit("1e-3", TIME),
    "us": _unit("1e-6", TIME),
    "min": _unit("60", TIME),
    "rad": _unit("1", DIMENSIONLESS),
    "mrad": _unit("1e-3", DIMENSIONLESS),
    "deg": _unit("1/180", DIMENSIONLESS, 1),
    "rev": _unit("2", DIMENSIONLESS, 1),
    "rpm": _unit("1/30", RATE, 1),
    "N": _unit("1", FORCE),
    "mN": _unit("1e-3", FORCE),
    "kN": _unit("1000", FORCE),
    "MN": _unit("1e6", FORCE),
    "GN": _unit("1e9", FORCE),
    "mPa": _unit("1e-3", PRESSURE),
    "lbf": _unit("4.4482216152605", FORCE),
    "Pa": _unit("1", PRESSURE),
    "kPa": _unit("1e3", PRESSURE),
    "MPa": _unit("1e6", PRESSURE),
    "GPa": _unit("1e9", PRESSURE),
    "bar": _unit("1e5", PRESSURE),
    "P": _unit("0.1", VISCOSITY),
    "cP": _unit("1e-3", VISCOSITY),
    "J": _unit("1", TORQUE),
    "mJ": _unit("1e-3", TORQUE),
    "kJ": _unit("1e3", TORQUE),
    "W": _unit("1", POWER),
    "kW": _unit("1e3", POWER),
}

# Other spellings of units, and the symbols of this list.
OTHER_WORDS: Mapping[str, str] = {
    **dict.fromkeys(("inches", "Inch"), "in"),
    **dict.fromkeys(("foot", "feet"), "ft"),
    **dict.fromkeys(("lbs", "lbm", "pound", "pounds"), "lb"),
    **dict.fromkeys(("Gram", "gr", "gramm"), "g"),
    **dict.fromkeys(("kilogram", "kilograms", "KG", "Kg"), "kg"),
    **dict.fromkeys(("degree", "degrees", "Deg"), "deg"),
    **dict.fromkeys(("radian", "radians"), "rad"),
    **dict.fromkeys(("meter", "metre", "meters", "metres"), "m"),
    **dict.fromkeys(("MM", "millimeter", "millimeters"), "mm"),
    **dict.fromkeys(("sec", "secs", "second", "seconds"), "s"),
    **dict.fromkeys(("minute", "minutes"), "min"),
    **dict.fromkeys(("RPM", "Rpm", "U/min"), "rpm"),
    **dict.fromkeys(("newton", "newtons", "Newton"), "N"),
    "Nm": "N*m",
    "Nmm": "N*mm",
    "Ns": "N*s",
    "Pas": "Pa*s",
    "kgm^2": "kg*m^2",
    "kgm2": "kg*m^2",
    "lbft": "lbf*ft",
}

# compound units that are published with the list
_COMPOUNDS = """
    1/s 1/min rad/s deg/s rev/s rev/min rad/s^2 deg/s^2 m/s mm/s m/min m/s^2 mm/s^2 m^2 mm^2 m^3 mm^3
    kg*m^2 kg*mm^2 g*mm^2 kg/m^3 N*m N*mm kN*m N/m N/mm kN/m N*m/rad N*m/deg
    N*s/m N*s/mm N*m*s/rad N/m^2 N/mm^2 Pa*s
"""

_FACTOR = re.compile(
    r"([A-Za-z\u00b5\u03bc]+)"
    r"(?:\^(?P<power>-?(?:[1-9](?:\.5)?|0\.5)|\(-?[1-9]/2\))|(?P<raised>[\u00b2\u00b3]))?(?![\w^]|\.[A-Za-z_])"
)
_RAISED = {"\u00b2": "2", "\u00b3": "3"}
_BETWEEN = re.compile(r" *[*/\u00b7\u22c5] *| ")
_CALLED = re.compile(r" *\(")
_MOST_FACTORS = 8


def parse_unit(text: str, start: int = 0, names: Container[str] = ()) -> tuple[Unit, int] | None:
    """Return the longest unit that begins at text[start], and where it ends; None if none begins there.

    A unit is a listed symbol, or a product and quotient of such with powers from −9 to 9, halves too (`kg*m^2`, `kg
    m²`, `N*s/m`, `1/s`, `N/m^1.5`). After a `*` or `/`, unlisted symbols and functions belong to the expression: in `3
    mm*c` the unit is mm. So do the last factors that are `names`: a name of the file takes precedence over a unit in a
    product. `m^1` is always a unit, `s.vx` never is. A space multiplies above the `/` only, because `N/m s` would be
    ambiguous.
    """
    divide = divided = text.startswith("1/", start)
    position = start + 2 if divide else start
    total, found, between = Unit(Fraction(1), 0, DIMENSIONLESS), None, ""
    for _ in range(_MOST_FACTORS):
        match = _FACTOR.match(text, position)
        if not match or match[1] not in _SYMBOLS or found and _CALLED.match(text, match.end()):
            break
        is_name = bool(found) and match[0] in names and between in ("*", "/")
        power = Fraction((match["power"] or _RAISED.get(match["raised"]) or "1").strip("()"))
        raised = _power_of_unit(_SYMBOLS[match[1]], -power if divide else power)
        if raised is None:
            break
        total = Unit(total.factor * raised.factor, total.pi_power + raised.pi_power, total.dimension * raised.dimension)
        found = found if is_name else (total, match.end())
        operator = _BETWEEN.match(text, match.end())
        between = (operator[0].strip() or " ") if operator else ""
        if operator is None or between == " " and divided:
            break
        divide, position = between == "/", operator.end()
        divided = divided or divide
    return found


def _power_of_unit(of: Unit, power: Fraction) -> Unit | None:
    """Return a power of a unit; None for a root of π."""
    if power.denominator == 1:
        return Unit(of.factor ** int(power), of.pi_power * int(power), of.dimension**power)
    if of.pi_power:
        return None
    square = of.factor**power.numerator
    root = Fraction(math.isqrt(square.numerator * 10**120 // square.denominator), 10**60)
    return Unit(root, 0, of.dimension**power)


def factors(token: str) -> list[tuple[str, str]]:
    """Return the symbols without a power in a unit as it is written, each with the sign before it: "" of the first."""
    return re.findall(r"([*/ \u00b7\u22c5]|^)(?:1/)?([A-Za-z\u00b5\u03bc]+)(?![\w^])", token)


def symbol_dimension(name: str) -> Dimension | None:
    """Return the dimension of the unit that has the symbol `name`, None if no unit has it."""
    return _SYMBOLS[name].dimension if name in _SYMBOLS else None


@lru_cache(maxsize=1024)
def unit(token: str) -> Unit | None:
    """Return the unit that the whole of `token` names; None if it is not in the list."""
    found = parse_unit(token)
    return found[0] if found and found[1] == len(token) else None


def _list_units() -> Iterator[tuple[str, tuple[float, Dimension]]]:
    """Yield each published unit with its factor to SI and its dimension."""
    for token in (*_SYMBOLS, *_COMPOUNDS.split()):
        known = unit(token)
        assert known is not None, token
        yield token, (known.to_si(Fraction(1)), known.dimension)


# The published list: token -> (factor to SI, dimension). Further products of the symbols are units, too.
UNITS: Mapping[str, tuple[float, Dimension]] = dict(_list_units())

"""Define physical dimensions and the units that mechanism files may use, and parse units.

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
    """Exponents of metre, kilogram and second of a physical dimension; an angle has none (rad = 1)."""

    length: Fraction = Fraction(0)
    mass: Fraction = Fraction(0)
    time: Fraction = Fraction(0)

    def __mul__(self, other: Dimension) -> Dimension:
        """Return the dimension of a product of two quantities."""
        return Dimension(self.length + other.length, self.mass + other.mass, self.time + other.time)

    def __truediv__(self, other: Dimension) -> Dimension:
        """Return the dimension of a quotient of two quantities."""
        return self * other**-1

    def __pow__(self, exponent: int | Fraction) -> Dimension:
        """Return the dimension of a power of a quantity; the exponent may be a fraction."""
        return Dimension(self.length * exponent, self.mass * exponent, self.time * exponent)

    @property
    def is_whole(self) -> bool:
        """Return whether all exponents are integers."""
        return all(e.denominator == 1 for e in (self.length, self.mass, self.time))

    @property
    def has_halves_at_most(self) -> bool:
        """Return whether all exponents are integers or halves, as parameters of a run may have (N/m^1.5)."""
        return (self**2).is_whole


def make_dimension(length: float = 0, mass: float = 0, time: float = 0) -> Dimension:
    """Return the dimension m^length kg^mass s^time."""
    return Dimension(Fraction(length), Fraction(mass), Fraction(time))


DIMENSIONLESS = make_dimension()
LENGTH = make_dimension(length=1)
MASS = make_dimension(mass=1)
TIME = make_dimension(time=1)
INERTIA = make_dimension(length=2, mass=1)
RATE = make_dimension(time=-1)  # an angular velocity, too
ANGULAR_ACCELERATION = make_dimension(time=-2)
VELOCITY = make_dimension(length=1, time=-1)
ACCELERATION = make_dimension(length=1, time=-2)
FORCE = make_dimension(length=1, mass=1, time=-2)
TORQUE = make_dimension(length=2, mass=1, time=-2)  # and energy
POWER = make_dimension(length=2, mass=1, time=-3)
STIFFNESS = make_dimension(mass=1, time=-2)
DAMPING = make_dimension(mass=1, time=-1)
PRESSURE = make_dimension(length=-1, mass=1, time=-2)
VISCOSITY = make_dimension(length=-1, mass=1, time=-1)
DENSITY = make_dimension(length=-3, mass=1)

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


def find_si_unit(dimension: Dimension) -> str:
    """Return the SI unit of a dimension as files write it: "m", "kg*m^2", "1/s"; "" for a pure number.

    Common quantities of mechanics have their usual unit, such as N*m for a torque; others have base units.
    """
    if dimension == DIMENSIONLESS:
        return ""
    if dimension == RATE:
        return "1/s"
    if dimension in _WORDS:
        return _WORDS[dimension][1]
    exponents = {"kg": dimension.mass, "m": dimension.length, "s": dimension.time}
    numerator = "*".join(_format_power(s, e) for s, e in exponents.items() if e > 0)
    denominator = "".join("/" + _format_power(s, -e) for s, e in exponents.items() if e < 0)
    return (numerator or "1") + denominator


def _format_power(symbol: str, exponent: Fraction) -> str:
    """Return a unit symbol with its exponent as text: "m", "m^2", "m^(3/2)"."""
    if exponent == 1:
        return symbol
    return f"{symbol}^{exponent}" if exponent.denominator == 1 else f"{symbol}^({exponent})"


def describe_dimension(dimension_: Dimension) -> str:
    """Return a dimension in words with its SI unit: "a length (m)"."""
    description, unit = _WORDS.get(dimension_, ("a quantity", find_si_unit(dimension_)))
    return f"{description} ({unit})"


@dataclass(frozen=True)
class Unit:
    """A unit in SI: `factor` · π^`pi_power` of the SI unit of `dimension`."""

    factor: Fraction
    pi_power: int
    dimension: Dimension

    def to_si(self, number: Fraction) -> float:
        """Return `number` of this unit as a number in SI, rounded once from the exact product."""
        return float(number * self.factor * Fraction(math.pi) ** self.pi_power)


def _make_unit(factor: str, dimension_: Dimension, pi_power: int = 0) -> Unit:
    """Return a unit from its factor to SI as text, its dimension, and its power of π."""
    return Unit(Fraction(factor), pi_power, dimension_)


# Hz is left out: read as 1/s it would be wrong by 2π for an angular velocity; rev/s and 1/s are unambiguous.
_SYMBOLS: Mapping[str, Unit] = {
    "m": _make_unit("1", LENGTH),
    "km": _make_unit("1000", LENGTH),
    "cm": _make_unit("0.01", LENGTH),
    "mm": _make_unit("1e-3", LENGTH),
    "um": _make_unit("1e-6", LENGTH),
    "\u00b5m": _make_unit("1e-6", LENGTH),
    "\u03bcm": _make_unit("1e-6", LENGTH),
    "nm": _make_unit("1e-9", LENGTH),
    "in": _make_unit("0.0254", LENGTH),
    "inch": _make_unit("0.0254", LENGTH),
    "ft": _make_unit("0.3048", LENGTH),
    "kg": _make_unit("1", MASS),
    "g": _make_unit("1e-3", MASS),
    "mg": _make_unit("1e-6", MASS),
    "gram": _make_unit("1e-3", MASS),
    "grams": _make_unit("1e-3", MASS),
    "lb": _make_unit("0.45359237", MASS),
    "s": _make_unit("1", TIME),
    "ms": _make_unit("1e-3", TIME),
    "us": _make_unit("1e-6", TIME),
    "min": _make_unit("60", TIME),
    "rad": _make_unit("1", DIMENSIONLESS),
    "mrad": _make_unit("1e-3", DIMENSIONLESS),
    "deg": _make_unit("1/180", DIMENSIONLESS, 1),
    "rev": _make_unit("2", DIMENSIONLESS, 1),
    "rpm": _make_unit("1/30", RATE, 1),
    "N": _make_unit("1", FORCE),
    "mN": _make_unit("1e-3", FORCE),
    "kN": _make_unit("1000", FORCE),
    "MN": _make_unit("1e6", FORCE),
    "GN": _make_unit("1e9", FORCE),
    "mPa": _make_unit("1e-3", PRESSURE),
    "lbf": _make_unit("4.4482216152605", FORCE),
    "Pa": _make_unit("1", PRESSURE),
    "kPa": _make_unit("1e3", PRESSURE),
    "MPa": _make_unit("1e6", PRESSURE),
    "GPa": _make_unit("1e9", PRESSURE),
    "bar": _make_unit("1e5", PRESSURE),
    "P": _make_unit("0.1", VISCOSITY),
    "cP": _make_unit("1e-3", VISCOSITY),
    "J": _make_unit("1", TORQUE),
    "mJ": _make_unit("1e-3", TORQUE),
    "kJ": _make_unit("1e3", TORQUE),
    "W": _make_unit("1", POWER),
    "kW": _make_unit("1e3", POWER),
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
_MAX_FACTORS = 8


def parse_unit(text: str, start: int = 0, names: Container[str] = ()) -> tuple[Unit, int] | None:
    """Return the longest unit that begins at text[start], and the offset where it ends; None if none begins there.

    A unit is a listed symbol, or a product and quotient of at most _MAX_FACTORS with powers from −9 to 9, halves too
    (`kg*m^2`, `kg m²`, `N*s/m`, `1/s`, `N/m^1.5`). After a `*` or `/`, unlisted symbols and functions belong to the
    expression: in `3 mm*c` the unit is mm. So do the last factors that are `names` of the file, which precede units in
    a product. `m^1` is always a unit, `s.vx` never is. A space multiplies only before the first `/`, because `N/m s`
    would be ambiguous.
    """
    divide = divided = text.startswith("1/", start)
    position = start + 2 if divide else start
    total, unit, between = Unit(Fraction(1), 0, DIMENSIONLESS), None, ""
    for _ in range(_MAX_FACTORS):
        match = _FACTOR.match(text, position)
        if not match or match[1] not in _SYMBOLS or unit and _CALLED.match(text, match.end()):
            break
        is_name = bool(unit) and match[0] in names and between in ("*", "/")
        power = Fraction((match["power"] or _RAISED.get(match["raised"]) or "1").strip("()"))
        raised = _compute_unit_power(_SYMBOLS[match[1]], -power if divide else power)
        if raised is None:
            break
        total = Unit(total.factor * raised.factor, total.pi_power + raised.pi_power, total.dimension * raised.dimension)
        unit = unit if is_name else (total, match.end())
        operator = _BETWEEN.match(text, match.end())
        between = (operator[0].strip() or " ") if operator else ""
        if operator is None or between == " " and divided:
            break
        divide, position = between == "/", operator.end()
        divided = divided or divide
    return unit


def _compute_unit_power(base: Unit, power: Fraction) -> Unit | None:
    """Return a unit raised to a whole or half power; None for a root of a unit that contains π.

    The factor of a root is a fraction, rounded down to 60 decimals. The power of π in a unit is an integer, so that
    roots of π cannot be stored.
    """
    if power.denominator == 1:
        return Unit(base.factor ** int(power), base.pi_power * int(power), base.dimension**power)
    if base.pi_power:
        return None
    square = base.factor**power.numerator
    root = Fraction(math.isqrt(square.numerator * 10**120 // square.denominator), 10**60)
    return Unit(root, 0, base.dimension**power)


def list_factors(token: str) -> list[tuple[str, str]]:
    """Return (operator before it, symbol) of the symbols without a power: "N m/s" → [("", "N"), (" ", "m"), …]."""
    return re.findall(r"([*/ \u00b7\u22c5]|^)(?:1/)?([A-Za-z\u00b5\u03bc]+)(?![\w^])", token)


def find_symbol_dimension(name: str) -> Dimension | None:
    """Return the dimension of the unit with the symbol `name`; None if no listed unit has it."""
    return _SYMBOLS[name].dimension if name in _SYMBOLS else None


@lru_cache(maxsize=1024)
def find_unit(token: str) -> Unit | None:
    """Return the unit that the whole of `token` names; None if it is not in the list. Results are cached."""
    unit = parse_unit(token)
    return unit[0] if unit and unit[1] == len(token) else None


def _list_units() -> Iterator[tuple[str, tuple[float, Dimension]]]:
    """Yield each published unit as (text, (factor to SI, dimension))."""
    for token in (*_SYMBOLS, *_COMPOUNDS.split()):
        unit = find_unit(token)
        assert unit is not None, token
        yield token, (unit.to_si(Fraction(1)), unit.dimension)


# The published list: token -> (factor to SI, dimension). Further products of the symbols are units, too.
UNITS: Mapping[str, tuple[float, Dimension]] = dict(_list_units())

"""Units as people write them: a prefix that brings a number near one, m/s² for m/s^2."""

from __future__ import annotations

import math
import re

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}
_PREFIXABLE = re.compile(r"(m|N|J|W|Pa|s|rad|Hz)(?![\w^])")  # kg has its prefix already; m^2 would square it
_SUPERSCRIPTS = str.maketrans("0123456789-./", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻·ᐟ")


def scale(size: float, unit: str) -> tuple[float, str]:
    """(factor, text) so that a number of that size times factor reads well in the unit `text`.

    Between 0.1 and 3000 a unit stays as it is; zero, NaN and infinity too.
    """
    if not math.isfinite(size) or size == 0 or 0.1 <= abs(size) < 3000 or not _PREFIXABLE.match(unit):
        return 1.0, pretty(unit)
    exponent = 3 * math.floor((math.log10(abs(size)) + 1) / 3)
    exponent = min(max(exponent, min(PREFIXES)), max(PREFIXES))
    return 10.0**-exponent, PREFIXES[exponent] + pretty(unit)


def drawn(size: float, unit: str) -> tuple[float, str]:
    """The same for pictures and tables of runs, where angles are in degrees: rad, rad/s, rad/s²."""
    if unit == "rad" or unit.startswith("rad/"):
        return 180.0 / math.pi, "°" + pretty(unit.removeprefix("rad"))
    return scale(size, unit)


def pretty(unit: str) -> str:
    """ "kg*m^2" as "kg·m²"."""
    return re.sub(r"\^(-?[\d.]+)", lambda power: raised(power.group(1)), unit).replace("*", "·")


def raised(power: str) -> str:
    """ "-2" as "⁻²"."""
    return power.translate(_SUPERSCRIPTS)


def label(name: str, unit: str) -> str:
    """An axis label: "S9.y [mm]"."""
    return f"{name} [{unit}]".strip() if unit else name


def quantity(value: float, unit: str, digits: int = 4) -> str:
    """A number with its unit for a table: "0.3 mm", "175 N", "–" for NaN."""
    if math.isnan(value):
        return "–"
    factor, text = scale(value, unit)
    return f"{value * factor:.{digits}g} {text}".strip()


def told_apart(value: float, limit: float, digits: int = 4) -> tuple[str, str]:
    """Two numbers by the fewest digits, but no fewer than these, by which they differ."""
    while digits < 17 and value != limit and f"{value:.{digits}g}" == f"{limit:.{digits}g}":
        digits += 1
    return f"{value:.{digits}g}", f"{limit:.{digits}g}"

"""Format units for readers: with a prefix that brings a number near one, and m/s² for m/s^2."""

from __future__ import annotations

import math
import re

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}  # SI prefixes by power of ten
_PREFIXABLE = re.compile(r"(m|N|J|W|Pa|s|rad|Hz)(?![\w^])")  # kg has its prefix already; m^2 would square it
_SUPERSCRIPTS = str.maketrans("0123456789-./", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻·ᐟ")


def scale(size: float, unit: str) -> tuple[float, str]:
    """Return (factor, text): a number of this size times factor is readable in the unit `text`.

    Between 0.1 and 3000 a unit stays as it is; also for zero, NaN and infinity.
    """
    if not math.isfinite(size) or size == 0 or 0.1 <= abs(size) < 3000 or not _PREFIXABLE.match(unit):
        return 1.0, pretty(unit)
    exponent = 3 * math.floor((math.log10(abs(size)) + 1) / 3)
    exponent = min(max(exponent, min(PREFIXES)), max(PREFIXES))
    return 10.0**-exponent, PREFIXES[exponent] + pretty(unit)


def drawn(size: float, unit: str) -> tuple[float, str]:
    """Return (factor, text) as `scale`, with angles in degrees, for plots and tables of runs."""
    if unit == "rad" or unit.startswith("rad/"):
        return 180.0 / math.pi, "°" + pretty(unit.removeprefix("rad"))
    return scale(size, unit)


def pretty(unit: str) -> str:
    """Return a unit with raised powers: "kg·m²" for "kg*m^2"."""
    return re.sub(r"\^(-?[\d.]+)", lambda power: raised(power.group(1)), unit).replace("*", "·")


def raised(power: str) -> str:
    """Return a power in superscript digits: "⁻²" for "-2"."""
    return power.translate(_SUPERSCRIPTS)


def label(name: str, unit: str) -> str:
    """Return an axis label: "S9.y [mm]"."""
    return f"{name} [{unit}]".strip() if unit else name


def quantity(value: float, unit: str, digits: int = 4) -> str:
    """Return a number with its unit for a table: "0.3 mm", "175 N", "–" for NaN."""
    if math.isnan(value):
        return "–"
    factor, text = scale(value, unit)
    return f"{value * factor:.{digits}g} {text}".strip()


def distinct_texts(value: float, limit: float, digits: int = 4) -> tuple[str, str]:
    """Return two numbers as text, with at least `digits` digits and enough of them to differ."""
    while digits < 17 and value != limit and f"{value:.{digits}g}" == f"{limit:.{digits}g}":
        digits += 1
    return f"{value:.{digits}g}", f"{limit:.{digits}g}"

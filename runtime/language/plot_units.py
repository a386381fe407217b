"""Format units for plots: an SI prefix that brings values near 1, and m/s² for `m/s^2`."""

from __future__ import annotations

import math
import re

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}  # SI prefixes by power of ten
_PREFIXABLE = re.compile(r"(m|N|J|W|Pa|s|rad|Hz)(?![\w^])")  # kg has its prefix already; m^2 would square it
_SUPERSCRIPTS = str.maketrans("0123456789-./", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻·ᐟ")


def choose_prefix(magnitude: float, unit: str) -> tuple[float, str]:
    """Return factor and unit text with an SI prefix such that magnitude · factor is from 0.1 to 100: (1e3, "mm").

    The factor is 1 from 0.1 to 3000, for zero, NaN and infinity, and for units that cannot have a prefix.
    """
    if not math.isfinite(magnitude) or magnitude == 0 or 0.1 <= abs(magnitude) < 3000 or not _PREFIXABLE.match(unit):
        return 1.0, format_unit(unit)
    exponent = 3 * math.floor((math.log10(abs(magnitude)) + 1) / 3)
    exponent = min(max(exponent, min(PREFIXES)), max(PREFIXES))
    return 10.0**-exponent, PREFIXES[exponent] + format_unit(unit)


def choose_plot_unit(magnitude: float, unit: str) -> tuple[float, str]:
    """Return factor and unit text for a plot as `choose_prefix` does, with angles in degrees."""
    if unit == "rad" or unit.startswith("rad/"):
        return 180.0 / math.pi, "°" + format_unit(unit.removeprefix("rad"))
    return choose_prefix(magnitude, unit)


def format_unit(unit: str) -> str:
    """Return a unit in typographic form: "kg·m²" for "kg*m^2"."""
    return re.sub(r"\^(-?[\d.]+)", lambda power: format_superscript(power.group(1)), unit).replace("*", "·")


def format_superscript(power: str) -> str:
    """Return a power in superscript digits: "⁻²" for "-2"."""
    return power.translate(_SUPERSCRIPTS)


def format_label(name: str, unit: str) -> str:
    """Return an axis label such as "S9.y [mm]"; only the name if the unit is empty."""
    return f"{name} [{unit}]".strip() if unit else name


def format_quantity(value: float, unit: str, digits: int = 4) -> str:
    """Return a number with its unit and a suitable prefix, such as "0.3 mm" or "175 N"; "–" for NaN."""
    if math.isnan(value):
        return "–"
    factor, text = choose_prefix(value, unit)
    return f"{value * factor:.{digits}g} {text}".strip()


def format_distinct_numbers(value: float, other_value: float, digits: int = 4) -> tuple[str, str]:
    """Return two numbers as texts with the fewest digits, `digits` to 17, by which different numbers differ."""
    while digits < 17 and value != other_value and f"{value:.{digits}g}" == f"{other_value:.{digits}g}":
        digits += 1
    return f"{value:.{digits}g}", f"{other_value:.{digits}g}"

"""Define the symbols in equations of docs/laws.md, and find the symbols of an equation that a law declares."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

# Symbol in LaTeX, in the spelling of `_normalize_latex`: quantity and unit. Tables have this order.
_SYMBOLS: Mapping[str, tuple[str, str]] = {
    # forces
    r"F": ("force on the journal", "N"),
    r"F_n": ("normal force, positive in compression", "N"),
    r"F_t": ("tangential force on the journal", "N"),
    r"F_r": ("force of the film on the journal, along the eccentricity", "N"),
    r"F_{el}": ("elastic part of the normal force", "N"),
    r"F_{dry}": ("force of the dry contact", "N"),
    r"F_{film}": ("force of the film", "N"),
    r"M_\tau": ("shear torque of the film", "N·m"),
    r"V_f": ("potential of the film force", "W"),
    # motion
    r"\delta": ("penetration", "m"),
    r"\dot\delta": ("rate of the penetration", "m/s"),
    r"\dot\delta^{-}": ("approach speed: rate of the penetration at the onset of the contact", "m/s"),
    r"\dot\delta^{+}": ("rate of the penetration after the impact", "m/s"),
    r"\ddot\delta": ("second rate of the penetration", "m/s²"),
    r"v_t": ("slip of the journal's surface on the bearing's", "m/s"),
    r"z": ("state: deflection of the bristles, 0 at each onset of a contact", "m"),
    r"\dot z": ("rate of $z$", "m/s"),
    r"\varepsilon": ("eccentricity divided by the clearance of the film", "1"),
    r"\dot\varepsilon": ("rate of $\\varepsilon$", "1/s"),
    r"\omega_i": ("angular velocity of the bearing", "rad/s"),
    r"\omega_j": ("angular velocity of the journal", "rad/s"),
    r"\omega_s": ("effective angular velocity of the film, by the key `angular_velocity`", "rad/s"),
    r"w_n": (
        r"effective squeeze velocity divided by the clearance of the film, along the eccentricity:"
        r" $w_n = \dot\varepsilon$",
        "1/s",
    ),
    r"w_t": (
        r"effective squeeze velocity divided by the clearance of the film, across the eccentricity:"
        r" $w_t = -\tfrac12 \varepsilon \omega_s$",
        "1/s",
    ),
    r"w_\varepsilon": ("scaled squeeze velocity", "1/s"),
    r"W": ("magnitude of the squeeze velocity", "1/s"),
    # geometry
    r"R_i": ("radius of the bearing", "m"),
    r"R_j": ("radius of the journal", "m"),
    r"L": ("length of the bearing", "m"),
    r"c": ("radial clearance: radius of the bearing minus radius of the journal", "m"),
    r"c_{film}": (
        "clearance of the film: radial clearance plus $c_a$; with `mixed`, clearance between the mean surfaces plus"
        " $c_a$",
        "m",
    ),
    r"c_a": ("key `extra_clearance`", "m"),
    r"\varphi": ("angle from the widest gap", "rad"),
    r"\varphi_1": ("start of the half film", "rad"),
    r"\Lambda": (r"film thickness ratio: film thickness divided by $\sigma_r$", "1"),
    r"\eta": (r"height of the roughness divided by $\sigma_r$", "1"),
    # materials
    r"E^{*}": ("[contact modulus](#common-equations-and-keys)", "Pa"),
    r"E_i": ("Young's modulus of the bearing", "Pa"),
    r"E_j": ("Young's modulus of the journal", "Pa"),
    r"\nu_i": ("Poisson's ratio of the bearing", "1"),
    r"\nu_j": ("Poisson's ratio of the journal", "1"),
    r"\mu": ("dynamic viscosity, the key `viscosity`", "Pa·s"),
    # factors
    r"K": ("contact stiffness", "N/m$^n$"),
    r"a": ("[hysteresis damping factor](#the-dissipation-of-a-normal-force), by the key `dissipation`", "1"),
    r"c_d": ("coefficient of friction at the present slip", "1"),
    r"g_v": ("coefficient of friction in steady sliding", "1"),
    r"b": ("weight of the dry force", "1"),
    r"S": ("film factor", "N·s"),
    r"s_\varepsilon": (r"$\sqrt{1 - \varepsilon^2}$", "1"),
    r"f": ("correction of the squeeze motion", "1"),
    r"\xi": (r"$\varepsilon w_n/w_\varepsilon$", "1"),
    **dict.fromkeys(
        ("a_0", "a_1", "a_2", "a_3"),
        (r"coefficients of $V_f$, functions of $\varepsilon$ and $L/(2R_j)$ fitted to Reynolds' equation", "1"),
    ),
    r"D_s": (r"shear torque divided by $\omega_j - \omega_i$", "N·m·s"),
    r"D_0": ("$D_s$ of a centred journal", "N·m·s"),
    r"F_{5/2}": (
        r"$\int_\Lambda^\infty (\eta - \Lambda)^{5/2} f_{\text{N}}(\eta)\,d\eta$, with the height $\eta$ of an asperity"
        r" divided by $\sigma_r$ and its standard normal density $f_{\text{N}}$",
        "1",
    ),
}
# Symbols that share a row of a table: the first cell, and the quantity unless it is that of the first symbol.
_ROWS: Mapping[tuple[str, ...], tuple[str, str]] = {
    ("E_i", "E_j"): ("$E_i$, $E_j$", "Young's modulus of the bearing and of the journal"),
    (r"\nu_i", r"\nu_j"): (r"$\nu_i$, $\nu_j$", "Poisson's ratio of the bearing and of the journal"),
    ("R_i", "R_j"): ("$R_i$, $R_j$", "radius of the bearing and of the journal"),
    (r"\omega_i", r"\omega_j"): (
        r"$\omega_i$, $\omega_j$",
        "angular velocity of the bearing and of the journal",
    ),
    ("a_0", "a_1", "a_2", "a_3"): (r"$a_0$ … $a_3$", ""),
}
# Law, "" for the common equations: symbols that have another definition there.
_SYMBOLS_OF_LAW: Mapping[str, Mapping[str, tuple[str, str]]] = {
    "newton_restitution": {r"\dot\delta^{-}": ("rate of the penetration before the impact", "m/s")},
    "": {r"E^{*}": ("contact modulus of both surfaces", "Pa")},
}
# Functions, constants and layout in LaTeX: no symbols.
_LAYOUT = re.compile(
    r"\\(?:begin|end)\{pmatrix\}|\\text\{ ?in an? [^}]*\}|\\(?:operatorname|mathrm)\{(?:sgn|atan2)\}"
    r"|\\(?:frac|tfrac|sqrt|left|right|bigl|bigr|max|min|ln|exp|tanh|sin|cos|pi|quad|partial|int|le|ge|gg|lvert|rvert|perp|approx)"
    r"(?![A-Za-z])|d(?=\\varphi|\\eta)"
)


def _normalize_latex(latex: str) -> str:
    r"""Return LaTeX with one spelling of each symbol: F_{\mathrm{el}} → F_{el}, s_{\varepsilon} → s_\varepsilon."""
    latex = re.sub(r"_\{\\(?:mathrm|text)\{(\w+)\}\}|_\\mathrm\{(\w+)\}", _brace_index, latex)
    latex = re.sub(r"_\{(\w|\\[a-z]+)\}", r"_\1", latex)
    return re.sub(r"\\(d?dot)\{(\\?\w+)\}", r"\\\1\2", latex)


def _brace_index(match: re.Match[str]) -> str:
    """Return the index of a match in braces."""
    return f"_{{{match[1] or match[2]}}}"


def find_symbols(latex: str, symbols: Iterable[str]) -> list[str]:
    r"""Return the symbols of an equation, each once, in the order of their first use.

    `symbols`: the known symbols in the spelling of `_normalize_latex`. Raises ValueError for another letter.
    """
    names = sorted(map(_normalize_latex, symbols), key=len, reverse=True)
    known = "|".join(re.escape(name) + r"(?![A-Za-z])" * ("\\" in name) for name in names)
    tokens = re.compile(rf"(?P<layout>{_LAYOUT.pattern})|(?P<symbol>{known})|(?P<unknown>\\?[A-Za-z]\w*)")
    found: list[str] = []
    for match in tokens.finditer(_normalize_latex(latex)):
        if match["unknown"]:
            raise ValueError(f"law_symbols.py does not define the symbol {match[0]} of the equation {latex}")
        if match["symbol"] and match["symbol"] not in found:
            found.append(match["symbol"])
    return found


def find_symbols_of_law(equations: Iterable[str], law: str, keys: Iterable[str]) -> list[str]:
    """Return the symbols of a law's equations that have the common definition, without the symbols of its keys."""
    of_keys = {*map(_normalize_latex, keys)}
    names = find_symbols(r" \quad ".join(equations), [*_SYMBOLS, *of_keys])
    return [name for name in names if name not in of_keys and name not in _SYMBOLS_OF_LAW.get(law, {})]


def list_symbol_rows(
    equations: Iterable[str], law: str, keys: Iterable[str] = (), defined: Iterable[str] = ()
) -> Iterator[str]:
    """Yield the Markdown table of the symbols of declared equations in LaTeX, then an empty line.

    `law`: name of the law, "" for the common equations. `keys`: symbols of its keys, which are left out, as are those
    in `defined` without a definition of their own in the law. There are no lines without symbols. Raises ValueError for
    an undefined symbol.
    """
    of_keys, of_law = [*map(_normalize_latex, keys)], _SYMBOLS_OF_LAW.get(law, {})
    meanings = {**_SYMBOLS, **of_law}
    names = find_symbols(r" \quad ".join(equations), [*meanings, *of_keys])
    left_out = {*of_keys, *defined} - {*of_law}
    names = [name for name in meanings if name in names and name not in left_out]
    if names:
        yield from ("| symbol | quantity | unit |", "|---|---|---|")
    group_of = {group[0]: group for group in _ROWS if {*group} <= {*names}}
    later = {name for group in group_of.values() for name in group[1:]}
    for name in (one for one in names if one not in later):
        quantity, unit = meanings[name]
        shown = "$" + re.sub(r"_\{([a-z]+)\}", r"_{\\text{\1}}", name) + "$"
        if name in group_of:
            shown, quantity = _ROWS[group_of[name]][0], _ROWS[group_of[name]][1] or quantity
        yield f"| {shown} | {quantity} | {unit} |"
    if names:
        yield ""

"""Ocvirk's film of a short bearing with squeeze motion: the half film with positive pressure, or the full film.

    (F_r, F_t) = S ∫ (½ ω_s ε sin φ − ε̇ cos φ)(cos φ, sin φ)/(1 + ε cos φ)³ dφ,  φ₁ … φ₁ + π
    S = μ R_j L³/c²,   φ₁ = atan2(ε̇, ½ ω_s ε)

in closed form, with the angle φ from the widest gap. With W = √(w_n² + w_t²), cos φ₁ = −w_t/W, sin φ₁ = w_n/W,
s_ε = √(1 − ε²), D = 1 − ε² cos² φ₁ and P = π + 2 arctan(ε sin φ₁/s_ε), the three integrals of
(cos², sin cos, sin²)/(1 + ε cos φ)³ are

    cc = P (1 + 2 ε²)/(2 s_ε⁵) + 3 ε sin φ₁/(s_ε⁴ D) + 2 ε sin φ₁ cos² φ₁/(s_ε² D²)
    sc = −2 ε cos³ φ₁/D²
    ss = P/(2 s_ε³) + ε sin φ₁ (1 − 2 cos² φ₁ + ε² cos² φ₁)/(s_ε² D²)

by derivatives of ∫ dφ/(1 + ε cos φ) = P/s_ε with respect to ε: nothing is divided by ε or ε̇.
That is Guembel's condition: no pressure below that of the ends. With `cavitation: full`, Sommerfeld's, all of the gap
carries, the oil pulls where the surfaces part, and with P = 2π: F_r = −S π (1 + 2 ε²) w_n/s_ε⁵, F_t = −S π w_t/s_ε³.
F. W. Ocvirk, NACA TN 2808 (1952), half film; squeeze and the film's place as physics.md, section 4.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs, Limits
from gudgeon.generator.kinds.laws.roles import (
    CAVITATION,
    LARGE_ECCENTRICITY,
    OIL_FIELDS,
    TINY,
    make_film_clearance,
    make_shear_torque,
)
from gudgeon.generator.marked_text import MarkedText


def build_film_forces(inputs: LawInputs) -> dict[str, Any]:
    """Return the film forces F_r along n and F_t along t (N, on the journal), and T0.

    T0 is the shear torque per unit ω_j − ω_i (N·m·s). The results and their abbreviations are equations by name. The
    option `cavitation` selects the half film, or with "full" the complete film with its negative pressures.
    """
    import sympy as sp

    epsilon, w_n, w_t = (inputs.variables[name] for name in ("epsilon", "w_n", "w_t"))
    c = make_film_clearance(inputs)
    S = inputs.derive(
        "S", inputs.parameters["viscosity"] * inputs.pair.R_j * inputs.pair.L**3 / c**2, "film factor mu R_j L^3/c^2"
    )
    names = ("root", "W", "cosine", "sine", "D", "P", "cc", "sc", "ss")
    root, W, cosine, sine, D, P, cc, sc, ss = (sp.Symbol(name, real=True) for name in names)
    square = root**2
    if inputs.options["cavitation"] == "full":
        return {
            "root": sp.sqrt(1 - epsilon**2),
            "F_r": -sp.pi * S * w_n * (1 + 2 * epsilon**2) / (square**2 * root),
            "F_t": -sp.pi * S * w_t / (square * root),
            "T0": make_shear_torque(inputs, c, root),
        }
    return {
        "root": sp.sqrt(1 - epsilon**2),
        "W": sp.sqrt(w_n**2 + w_t**2) + sp.Float(TINY),
        "cosine": -w_t / W,
        "sine": w_n / W,
        "D": 1 - (epsilon * cosine) ** 2,
        "P": sp.pi + 2 * sp.atan(epsilon * sine / root),
        "cc": P * (1 + 2 * epsilon**2) / (2 * square**2 * root)
        + epsilon * sine / (square * D) * (3 / square + 2 * cosine**2 / D),
        "sc": -2 * epsilon * cosine**3 / D**2,
        "ss": P / (2 * square * root) + epsilon * sine * (1 + (epsilon**2 - 2) * cosine**2) / (square * D**2),
        "F_r": -S * (w_n * cc + w_t * sc),
        "F_t": -S * (w_n * sc + w_t * ss),
        "T0": make_shear_torque(inputs, c, root),
    }


LAW = Law(
    name="ocvirk",
    role="film",
    title="Ocvirk: short journal bearing, half film or full film, with squeeze",
    equation=(
        r"\begin{pmatrix} F_r \\ F_t \end{pmatrix} = -S \int_{\varphi_1}^{\varphi_1"
        r" + \pi} \frac{w_n \cos\varphi + w_t \sin\varphi}{(1"
        r" + \varepsilon \cos\varphi)^3} \begin{pmatrix} \cos\varphi \\ \sin\varphi \end{pmatrix} d\varphi",
        r"S = \frac{\mu R_j L^3}{c^2}, \quad \varphi_1 = \mathrm{atan2}(w_n, -w_t)",
    ),
    source="F. W. Ocvirk, NACA TN 2808 (1952), with squeeze",
    reference="F. W. Ocvirk, Short-bearing approximation for full journal bearings, NACA Technical Note 2808 (1952), "
    "with squeeze: the half film lies where the pressure is above that of the ends",
    validity=MarkedText(
        r"a short bearing ($L/(2R_j) < 1/2$); at $L/(2R_j)$ = 1 the law overestimates the load, by a factor of 2 and "
        r"more at large $\varepsilon$"
    ),
    properties=LARGE_ECCENTRICITY,
    limits=Limits(l_over_d=(0.0, 0.5)),
    fields=(*OIL_FIELDS, CAVITATION),
    build=build_film_forces,
)

"""Oil film of a bearing of finite length with open ends and no negative pressure: a potential with four fitted terms.

Under that condition the force is the gradient of half the power that the film takes, F = −∂V_f/∂w, with V_f of
the second degree in w. With s = √(1 − ε²) (s_ε in physics.md), w_ε = √(w_n² + s² w_t²), ξ = ε w_n/w_ε, Λ = L/D and
S = μ R_j³ L/c²

    V_f = c S w_ε² (a0 + a1 ξ + a2 ξ² + a3 ξ³),   F_r = −(1/c) ∂V_f/∂w_n,   F_t = −(1/c) ∂V_f/∂w_t
    F_r = −S [w_n (2 a0 + a1 ξ − a3 ξ³) + ε w_ε (a1 + 2 a2 ξ + 3 a3 ξ²)],   F_t = −S s² w_t (2 a0 + a1 ξ − a3 ξ³)

ξ lies between −ε and ε. a0 and a1 are what rotation makes of it, a2 and a3 what squeeze needs besides. A bearing leaks
at its ends and around, one path beside the other: each has the short bearing's limit and the long one's power of s,

    a0 = π Λ²/(s³ (s² + g0 Λ²)),  a1 = 8 Λ²/(s³ (s² + g1 Λ²)),  a3 = 4/3 Λ²/(s (s² + g3 Λ²)²),
    a2 = a1 + a3 − (1 − r) a0,    so that V_f = c S w_ε² [(1 + ξ)(a0 (1 − ξ) + a1 ξ + a3 ξ²) + r a0 ξ²]

with a small r > 0: next to nothing holds a journal that leaves the wall. Λ → 0 is Ocvirk's film, in rotation exactly.
g0, g1, g3 and r are fitted to tables of `gudgeon.reynolds` by tools/finite_length.py, which prints them, under the
condition that V_f > 0 for every ε < 1 and every Λ: then the film only dissipates.
That such a film has a potential, and its impedance: D. Childs, H. Moes, H. van Leeuwen, ASME J. Lubr. Technol. 99
(1977) 198–214; the four terms and the fit are this project's.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs, Limits
from gudgeon.generator.kinds.laws.roles import (
    LARGE_ECCENTRICITY,
    OIL_FIELDS,
    TINY,
    make_film_clearance,
    make_shear_torque,
)
from gudgeon.generator.marked_text import MarkedText

# g = n0 + s (n1/(Λ + n2 s) + n3 + n4 s + n5 Λ s); n0 is the narrow gap's, which is long whatever Λ
G0 = (0.4585, 2.3287, 2.7330, -0.3790, -0.4570, 0.0685)
G1 = (0.8320, 0.7485, 0.9568, -0.0110, -0.8023, 0.1461)
G3 = 0.7670
REST = 0.0084  # r


def compute_fitted_coefficient(s: Any, ratio: Any, n: Sequence[float]) -> Any:
    """Return g0 or g1, the fitted coefficients of the end leakage, for s = √(1 − ε²) and the ratio Λ = L/D.

    It is n_0 + s [n_1/(Λ + n_2 s) + n_3 + s (n_4 + n_5 Λ)]. `n`: the six fitted numbers, G0 or G1. Arguments are
    symbols, numbers or arrays.
    """
    return n[0] + s * (n[1] / (ratio + n[2] * s) + n[3] + s * (n[4] + n[5] * ratio))


def build_film_forces(inputs: LawInputs) -> dict[str, Any]:
    """Return the film forces F_r along n and F_t along t (N, on the journal), and T0.

    They are −∂V/∂w_n and −∂V/∂w_t of the potential V = S q² (a_0 + a_1 x + a_2 x² + a_3 x³), with q² = w_n² + (1 − ε²)
    w_t² and x = ε w_n/q. T0 is the shear torque per unit ω_j − ω_i (N·m·s). The results and their abbreviations are
    equations by name.
    """
    import sympy as sp

    epsilon, w_n, w_t = (inputs.variables[name] for name in ("epsilon", "w_n", "w_t"))
    c = make_film_clearance(inputs)
    S = inputs.derive(
        "S", inputs.parameters["viscosity"] * inputs.pair.R_j**3 * inputs.pair.L / c**2, "film factor mu R_j^3 L/c^2"
    )
    ratio = inputs.derive("Lambda", inputs.pair.L / (2 * inputs.pair.R_j), "length over diameter")
    names = ("root", "q", "x", "g0", "g1", "narrow", "a0", "a1", "a2", "a3", "turn")
    root, q, x, g0, g1, narrow, a0, a1, a2, a3, turn = (sp.Symbol(name, real=True) for name in names)
    square = root**2
    return {
        "root": sp.sqrt(1 - epsilon**2),
        "q": sp.sqrt(w_n**2 + square * w_t**2) + sp.Float(TINY),
        "x": epsilon * w_n / q,
        "g0": compute_fitted_coefficient(root, ratio, G0),
        "g1": compute_fitted_coefficient(root, ratio, G1),
        "narrow": ratio**2 / root**3,
        "a0": sp.pi * narrow / (square + g0 * ratio**2),
        "a1": 8 * narrow / (square + g1 * ratio**2),
        "a3": sp.Rational(4, 3) * narrow * (root / (square + G3 * ratio**2)) ** 2,
        "a2": a1 + a3 - (1 - REST) * a0,
        "turn": 2 * a0 + x * (a1 - a3 * x**2),
        "F_r": -S * (w_n * turn + epsilon * q * (a1 + x * (2 * a2 + 3 * a3 * x))),
        "F_t": -S * square * w_t * turn,
        "T0": make_shear_torque(inputs, c, root),
    }


LAW = Law(
    name="finite_length",
    role="film",
    title="Journal bearing of finite length, Reynolds' condition: fitted potential",
    equation=(
        r"V_f = c\, S\, w_\varepsilon^2 (a_0 + a_1 \xi + a_2 \xi^2 + a_3 \xi^3), \quad S = \frac{\mu R_j^3 L}{c^2}",
        r"w_\varepsilon = \sqrt{w_n^2 + s_\varepsilon^2 w_t^2}, \quad \xi = \varepsilon w_n/w_\varepsilon, \quad"
        r" s_\varepsilon = \sqrt{1 - \varepsilon^2}",
        r"F_r = -\frac{1}{c}\,\frac{\partial V_f}{\partial w_n}, \quad"
        r" F_t = -\frac{1}{c}\,\frac{\partial V_f}{\partial w_t}",
    ),
    source="fit to gudgeon.reynolds by tools/finite_length.py; limits: F. W. Ocvirk, NACA TN 2808 (1952)",
    reference="A potential of four terms, fitted to Reynolds' equation (p above 0, open ends); the impedance of short, "
    "long and finite bearings is that of D. Childs, H. Moes, H. van Leeuwen, ASME J. Lubr. Technol. 99 "
    "(1977) 198--214",
    validity=MarkedText(
        r"for $L/(2R_j)$ from 0.1 to 2 and $\varepsilon$ up to 0.95, the force deviates from Reynolds' equation by at "
        r"most 1.2 % of the largest force at that $\varepsilon$; in steady rotation, the force deviates from Reynolds' "
        r"equation by at most 2 % of its own value; up to $L/(2R_j)$ = 3 and $\varepsilon$ = 0.9985 these limits are "
        r"3 % and 4 %"
    ),
    properties=LARGE_ECCENTRICITY,
    limits=Limits(l_over_d=(0.1, 2.0), epsilon=0.95),
    fields=OIL_FIELDS,
    build=build_film_forces,
)

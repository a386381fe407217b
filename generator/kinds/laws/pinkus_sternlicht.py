"""Long-bearing film of Pinkus and Sternlicht in a form without branch, arctangent or division by ε.

    s_ε = √(1 − ε²),  W = √(w_n² + w_t²),  f = 1 + 1.5 ε w_n/(s_ε W + 1.5 ε |w_n|),  S = 6 μ R_j³ L/c²
    F_r = −(S/s_ε³)[4 ε s_ε W/(2 + ε²) + π w_n f],   F_t = −2π S w_t f/((2 + ε²) s_ε)

w is the effective squeeze velocity ė − ½(ω_i + ω_j) ẑ × e, over c: w_n = ε̇, w_t = −½ ε ω_s. It is the
formula of O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication (1961) with the sign of the
radial force for ε̇ < 0 corrected; option `as_printed` restores the sign that the paper prints.
With `shear` the film also transmits the shear torque M_τ = 2π μ R_j³ L (ω_j − ω_i)/(c s_ε).
"""

from __future__ import annotations

import math
from typing import Any

from gudgeon.generator.field import flag
from gudgeon.generator.kinds.laws.law import Law, LawInputs, Limits
from gudgeon.generator.kinds.laws.roles import (
    ANGULAR_VELOCITY,
    EXTRA_CLEARANCE,
    LARGE_ECCENTRICITY,
    SHEAR,
    TINY,
    VISCOUS,
    make_film_clearance,
    make_shear_torque,
)
from gudgeon.generator.marked_text import MarkedText


def build_film_forces(inputs: LawInputs) -> dict[str, Any]:
    """Return the film forces F_r along n and F_t along t (N, on the journal), and T0.

    T0 is the shear torque per unit ω_j − ω_i (N·m·s). The results and their abbreviations are equations by name. With
    the option `as_printed` the sign of F_r changes where w_n < 0.
    """
    import sympy as sp

    epsilon, w_n, w_t = (inputs.variables[name] for name in ("epsilon", "w_n", "w_t"))
    pair, viscosity = inputs.pair, inputs.parameters["viscosity"]
    c = make_film_clearance(inputs)
    S = inputs.derive("S", 6 * viscosity * pair.R_j**3 * pair.L / c**2, "film factor 6 mu R_j^3 L/c^2")
    root, W, f = sp.Symbol("root", real=True), sp.Symbol("W", real=True), sp.Symbol("factor", real=True)
    half = sp.Rational(3, 2) * epsilon
    F_r = -S / root**3 * (4 * epsilon * root * W / (2 + epsilon**2) + sp.pi * w_n * f)
    if inputs.options["as_printed"]:
        F_r = F_r * (1 - 2 * sp.Max(-sp.sign(w_n), 0))
    return {
        "root": sp.sqrt(1 - epsilon**2),
        "W": sp.sqrt(w_n**2 + w_t**2),
        "factor": 1 + half * w_n / (root * W + half * sp.Abs(w_n) + sp.Float(TINY)),
        "F_r": F_r,
        "F_t": -2 * sp.pi * S * w_t * f / ((2 + epsilon**2) * root),
        "T0": make_shear_torque(inputs, c, root),
    }


LAW = Law(
    name="pinkus_sternlicht",
    role="film",
    title="Pinkus and Sternlicht: long journal bearing, half film",
    equation=(
        r"F_r = -\frac{S}{s_\varepsilon^3} \left[\frac{4 \varepsilon s_\varepsilon W}{2 + \varepsilon^2}"
        r" + \pi w_n f\right]",
        r"F_t = -\frac{2 \pi S w_t f}{(2 + \varepsilon^2)\, s_\varepsilon}",
        r"f = 1 + \frac{3 \varepsilon w_n}{2 s_\varepsilon W + 3 \varepsilon |w_n|}",
        r"S = \frac{6 \mu R_j^3 L}{c^2}, \quad s_\varepsilon = \sqrt{1 - \varepsilon^2}, \quad W = \sqrt{w_n^2"
        r" + w_t^2}",
    ),
    source="O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication (1961), sign corrected",
    reference="O. Pinkus, B. Sternlicht, Theory of hydrodynamic lubrication, McGraw-Hill, New York (1961), sign "
    "corrected",
    validity=MarkedText(
        r"a long bearing ($L/(2R_j) \gg 1$); the law agrees with Gümbel's half film where "
        r"$\lvert\omega_s\rvert \gg \lvert\dot\varepsilon\rvert$"
    ),
    properties=LARGE_ECCENTRICITY,
    limits=Limits(l_over_d=(4.0, math.inf), slow_squeeze=True),  # at L/D = 4 it is off by 16 % in rotation
    fields=(
        VISCOUS,
        EXTRA_CLEARANCE,
        flag("as_printed", "use the wrong sign of the radial force that Eq. 12 of Chen, Gao and Wang (2022) prints"),
        SHEAR,
        ANGULAR_VELOCITY,
    ),
    build=build_film_forces,
)

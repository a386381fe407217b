"""Film of a bearing of finite length under Reynolds' condition, p ≥ 0 with open ends: a potential of four terms.

Under that condition the force is the gradient of half the power that the film takes, F = −∂V/∂w, with V convex and of
the second degree in w. With s = √(1 − ε²), q = √(w_n² + s² w_t²), x = ε w_n/q, Λ = L/D and S = μ R_j³ L/c²

    V = S q² (a0 + a1 x + a2 x² + a3 x³)
    F_r = −S [w_n (2 a0 + a1 x − a3 x³) + ε q (a1 + 2 a2 x + 3 a3 x²)],   F_t = −S s² w_t (2 a0 + a1 x − a3 x³)

a0 and a1 are what rotation makes of it, a2 and a3 what squeeze needs besides. A bearing leaks at its ends and around,
one path beside the other, so that each has the short bearing's limit and the long one's power of s:

    a0 = π Λ²/(s³ (s² + g0 Λ²)),  a1 = 8 Λ²/(s³ (s² + g1 Λ²)),  a2 = 2π Λ²/(s³ (s² + g2 Λ²)),
    a3 = 4/3 Λ²/(s (s² + g3 Λ²)²)

For Λ → 0 that is Ocvirk's film: a0, a1 and a2 exactly, a3 within 6 % of what is a tenth of the force. g0 … g3 are
fitted to tables of `gudgeon.reynolds` by tools/finite_length.py, which prints them.
The potential is that of D. Childs, H. Moes, H. van Leeuwen, ASME J. Lubr. Technol. 99 (1977) 198–214 (impedance of
short, long and finite bearings); the four terms and the fit are this project's.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.oil import FIELDS, TINY, film_clearance, shear_torque

# g = n0 + s (n1/(Λ + n2 s) + n3 + n4 s + n5 Λ s); n0 is the narrow gap's, which is long whatever Λ
G0 = (0.5555, 1.2235, 1.8326, -0.2852, -0.4402, 0.0509)
G1 = (0.8251, 0.8706, 1.3041, -0.0350, -0.7436, 0.1270)
G2 = (1.5515, -0.7609, 0.3159)  # g = n0 + s (n1 s + n2 Λ)
G3 = 0.7310


def leaks(s: Any, ratio: Any, n: Sequence[float]) -> Any:
    """g of a0 and a1 (six numbers), or of a2 (three): symbols, numbers or arrays, ratio = Λ."""
    if len(n) == 3:
        return n[0] + s * (n[1] * s + n[2] * ratio)
    return n[0] + s * (n[1] / (ratio + n[2] * s) + n[3] + s * (n[4] + n[5] * ratio))


def build(s: LawInputs) -> dict[str, Any]:
    """F_r along n, F_t along t (N, on the journal); T0 is the shear torque per unit ω_j − ω_i (N·m·s)."""
    import sympy as sp

    epsilon, w_n, w_t = (s.variables[name] for name in ("epsilon", "w_n", "w_t"))
    c = film_clearance(s)
    S = s.derive("S", s.parameters["viscosity"] * s.pair.R_j**3 * s.pair.L / c**2, "film factor mu R_j^3 L/c^2")
    ratio = s.derive("Lambda", s.pair.L / (2 * s.pair.R_j), "length over diameter")
    names = ("root", "q", "x", "g0", "g1", "g2", "a0", "a1", "a2", "a3", "turn")
    root, q, x, g0, g1, g2, a0, a1, a2, a3, turn = (sp.Symbol(name, real=True) for name in names)
    square, short = root**2, ratio**2 / root
    return {
        "root": sp.sqrt(1 - epsilon**2),
        "q": sp.sqrt(w_n**2 + square * w_t**2) + sp.Float(TINY),
        "x": epsilon * w_n / q,
        "g0": leaks(root, ratio, G0),
        "g1": leaks(root, ratio, G1),
        "g2": leaks(root, ratio, G2),
        "a0": sp.pi * short / (square * (square + g0 * ratio**2)),
        "a1": 8 * short / (square * (square + g1 * ratio**2)),
        "a2": 2 * sp.pi * short / (square * (square + g2 * ratio**2)),
        "a3": sp.Rational(4, 3) * short / (square + G3 * ratio**2) ** 2,
        "turn": 2 * a0 + x * (a1 - a3 * x**2),
        "F_r": -S * (w_n * turn + epsilon * q * (a1 + x * (2 * a2 + 3 * a3 * x))),
        "F_t": -S * square * w_t * turn,
        "T0": shear_torque(s, c, root),
    }


LAW = Law(
    name="finite_length",
    role="film",
    title="Journal bearing of finite length, Reynolds' condition: fitted potential",
    source="fit to gudgeon.reynolds by tools/finite_length.py; limits: F. W. Ocvirk, NACA TN 2808 (1952)",
    reference="A potential of four terms, fitted to Reynolds' equation (p above 0, open ends); the impedance of short, "
              "long and finite bearings is that of D. Childs, H. Moes, H. van Leeuwen, ASME J. Lubr. Technol. 99 "
              "(1977) 198--214",
    validity="L/D .1 to 2, epsilon to .95: within 1 % of the largest force at that epsilon, whatever the motion; within "
             "3 % to L/D = 3 and epsilon = .9985; steady rotation within 3 % of itself; epsilon capped at .9999",
    fields=FIELDS,
    build=build,
)  # fmt: skip

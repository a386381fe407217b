"""Kelvin and Voigt's contact, a spring and a damper in parallel; an option allows the force to pull.

    F_n = K δ + D δ̇,   never negative unless it `pulls`

The force begins with D δ̇⁻: it jumps at the onset. It ends where K δ = −D δ̇, before δ = 0, so that none is left to
jump at the separation. With the effective mass m, ω_0 = √(K/m) and ζ = D/(2 m ω_0) < 1 the restitution is

    e_r = exp(−(ζ/√(1 − ζ²)) (π − 2 arcsin ζ))

at any speed, and exp(−π ζ/√(1 − ζ²)) where it pulls until δ = 0 (T. Schwager, T. Pöschel, Granular Matter 9 (2007)
465–469); the model: W. Goldsmith, Impact (1960).
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.dissipation import PULLS
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import DAMPING, STIFFNESS


def build_normal_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the normal force F_n = K δ + D δ̇ (N) for δ > 0 as an equation by name, positive in compression.

    A negative force counts as 0 unless the option `pulls` allows it.
    """
    import sympy as sp

    K = inputs.derive("spring", inputs.parameters["stiffness"], "stiffness")
    D = inputs.derive("damper", inputs.parameters["damping"], "damping")
    force = K * inputs.variables["delta"] + D * inputs.variables["deltadot"]
    return {"F_n": force if inputs.options["pulls"] else sp.Max(force, 0)}


LAW = Law(
    name="kelvin_voigt",
    role="normal",
    title="Kelvin and Voigt: a linear spring and a damper side by side",
    equation=(r"F_n = \max(0, K \delta + D \dot\delta)",),
    source="W. Goldsmith, Impact (1960); T. Schwager, T. Poeschel, Granular Matter 9 (2007) 465-469",
    reference=MarkedText(
        "W. Goldsmith, Impact: the theory and physical behaviour of colliding solids, Edward Arnold, London "
        "(1960); T. Schwager, T. Pöschel, Coefficient of restitution and linear-dashpot model revisited, "
        "Granular Matter 9 (2007) 465–469"
    ),
    validity="the law has the same restitution at any speed",
    properties="the force begins with the damping times the approach speed; near the end of each contact the formula "
    "gives a negative force, which `pulls: false` sets to 0",
    fields=(
        number(
            "stiffness",
            "spring force divided by the penetration",
            STIFFNESS,
            symbol="K",
            required=True,
            bounds=(Bound(">", 0.0),),
        ),
        number(
            "damping",
            "damping force divided by the rate of the penetration",
            DAMPING,
            symbol="D",
            required=True,
            bounds=(Bound(">", 0.0),),
        ),
        PULLS,
    ),
    build=build_normal_force,
)

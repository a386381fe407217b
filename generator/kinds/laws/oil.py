"""What every film law asks of its oil, and what of it does not hang on the law: clearance, shear torque."""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, Field, flag, number, word
from gudgeon.generator.kinds.laws.law import LawInputs
from gudgeon.language.units import LENGTH, VISCOSITY

# Where W vanishes so does every numerator: this keeps 0/0 away, in the derivatives (its square) too, and
# changes no other value.
TINY = 1e-150

VISCOUS = number("viscosity", "dynamic viscosity", VISCOSITY, symbol=r"\mu", required=True, bounds=(Bound(">", 0.0),))
EXTRA_CLEARANCE = number(
    "extra_clearance", "added to c in the film alone", LENGTH, symbol="e_t", default=0.0, bounds=(Bound(">=", 0.0),),
)  # fmt: skip
SHEAR = flag("shear", "shear torque, and the film's resultant at each pin centre")
ANGULAR_VELOCITY = word(
    "angular_velocity",
    "omega_i + omega_j; relative is the paper's omega_j - omega_i, which depends on the observer",
    ("absolute", "relative"), "absolute",
)  # fmt: skip
CAVITATION = word(
    "cavitation", "half, Guembel's: no pressure below that of the ends; full, Sommerfeld's: it pulls as it pushes",
    ("half", "full"), "half",
)  # fmt: skip
FIELDS: tuple[Field, ...] = (VISCOUS, EXTRA_CLEARANCE, SHEAR, ANGULAR_VELOCITY)


def film_clearance(s: LawInputs) -> Any:
    """c + e_t (m)."""
    return s.derive("film_clearance", s.pair.c + s.parameters["extra_clearance"], "clearance of the film")


def shear_torque(s: LawInputs, c: Any, root: Any) -> Any:
    """T0 per unit ω_j − ω_i (N·m·s) of a gap that is full: 2π μ R_j³ L/(c √(1 − ε²)); 0 without `shear`."""
    import sympy as sp

    if not s.options["shear"]:
        return sp.Integer(0)
    still = 2 * sp.pi * s.parameters["viscosity"] * s.pair.R_j**3 * s.pair.L / c
    return s.derive("shear", still, "2 pi mu R_j^3 L/c") / root

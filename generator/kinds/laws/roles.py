"""Keys and equations that all laws of one role share: friction, film or mixed lubrication.

Friction: odd functions of the slip, without a switching point at v_t = 0. Films: keys of the oil, clearance and shear
torque. Mixed lubrication: the combined roughness, and the film thickness ratio at which asperities first touch. The
bearing's clearance c is measured between the tips of the asperities: at δ = 0 the highest of them touch. There the
mean surfaces are still Λ₀ σ_r apart, so that the film thickness ratio is Λ = h/σ_r = Λ₀ − δ/σ_r, h = c + Λ₀ σ_r − e.
The film fills the gap between the mean surfaces and has the clearance c + Λ₀ σ_r: it is finite where the tips touch.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gudgeon.generator.field import Bound, Field, flag, number, word
from gudgeon.generator.kinds.laws.law import MEAN_CLEARANCE, LawInputs
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import DIMENSIONLESS, LENGTH, VELOCITY, VISCOSITY

MU = number("mu", "coefficient of friction", DIMENSIONLESS, symbol="c_f", required=True, bounds=(Bound(">=", 0.0),))
MU_S = number(
    "mu_s",
    "coefficient of static friction",
    DIMENSIONLESS,
    symbol="c_s",
    required=True,
    bounds=(Bound(">=", "mu"),),
)

# Meaning of a characteristic slip of static friction.
EXCESS_DECAY = MarkedText(r"slip at which the excess over kinetic friction has fallen to $1/\mathrm{e}$")


def declare_slip_field(name: str, meaning: str, symbol: str) -> Field:
    """Declare a positive slip velocity (m/s) of a law, a required number."""
    return number(name, meaning, VELOCITY, symbol=symbol, required=True, bounds=(Bound(">", 0.0),))


def make_odd_function(v_t: Any, positive_branch: Callable[[Any], Any]) -> Any:
    """Return an odd function of the slip v_t from its values at positive slip.

    `positive_branch` returns the value at a slip max(v_t, 0), and 0 at 0.
    """
    import sympy as sp

    return positive_branch(sp.Max(v_t, 0)) - positive_branch(sp.Max(-v_t, 0))


def make_friction_force(inputs: LawInputs, coefficient: Any) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t, from an odd coefficient of the slip."""
    return {"F_t": -coefficient * inputs.variables["F_n"]}


# Added to denominators to avoid 0/0 where W vanishes, also in derivatives, which contain its square. It changes no
# other value.
TINY = 1e-150

VISCOUS = number("viscosity", "dynamic viscosity", VISCOSITY, symbol=r"\mu", required=True, bounds=(Bound(">", 0.0),))
EXTRA_CLEARANCE = number(
    "extra_clearance",
    "added to the radial clearance of the film",
    LENGTH,
    symbol="c_a",
    default=0.0,
    bounds=(Bound(">=", 0.0),),
)
SHEAR = flag(
    "shear", "add the shear torque of the film; the film force then acts midway between the centres of pin and hole"
)
ANGULAR_VELOCITY = word(
    "angular_velocity",
    MarkedText(
        r"rotation in $\omega_s$: absolute is $\omega_i + \omega_j$; relative is $\omega_j - \omega_i$ of Chen, Gao and"
        " Wang (2022), which depends on the observer"
    ),
    ("absolute", "relative"),
    "absolute",
)
CAVITATION = word(
    "cavitation",
    MarkedText(
        "half: Gümbel's condition, no pressure below that of the ends; full: Sommerfeld's, negative pressures pull"
    ),
    ("half", "full"),
    "half",
)
# A property of all films.
LARGE_ECCENTRICITY = MarkedText(r"above $\varepsilon$ = 0.9999 the force is evaluated at 0.9999")
OIL_FIELDS: tuple[Field, ...] = (VISCOUS, EXTRA_CLEARANCE, SHEAR, ANGULAR_VELOCITY)


def make_film_clearance(inputs: LawInputs) -> Any:
    """Return the clearance of the film (m), `inputs.pair.c` plus `extra_clearance`, as a derived constant.

    `inputs.pair.c` is the radial clearance; in mixed lubrication it is the clearance between the mean surfaces.
    """
    return inputs.derive(
        "film_clearance", inputs.pair.c + inputs.parameters["extra_clearance"], "clearance of the film"
    )


def make_shear_torque(inputs: LawInputs, film_clearance: Any, eccentricity_root: Any) -> Any:
    """Return the shear torque of a full gap per unit ω_j − ω_i (N·m·s), 0 without the option `shear`.

    film_clearance: clearance of the film (m); eccentricity_root: √(1 − ε²). It is D_s = 2π μ R_j³ L/(c √(1 − ε²)).
    """
    import sympy as sp

    if not inputs.options["shear"]:
        return sp.Integer(0)
    torque_at_centre = 2 * sp.pi * inputs.parameters["viscosity"] * inputs.pair.R_j**3 * inputs.pair.L / film_clearance
    return inputs.derive("shear", torque_at_centre, "2 pi mu R_j^3 L/c") / eccentricity_root


ROUGHNESS = number(
    "roughness",
    "combined roughness of both surfaces: the root of the sum of the squares of their rms roughness",
    LENGTH,
    symbol=r"\sigma_r",
    required=True,
    bounds=(Bound(">", 0.0),),
)


def make_overlap_fraction(inputs: LawInputs, tip_contact_ratio: int, full_contact_ratio: int) -> Any:
    """Return the fraction (at most 1) by which δ has closed the gap from first contact of the tips to full contact.

    It is min(1, δ/((Λ_t − Λ_f) σ_r)) with the penetration δ and the combined roughness σ_r. tip_contact_ratio,
    full_contact_ratio: film thickness ratios Λ_t at which the tips touch, and Λ_f at which no film is left. The
    distance and the clearance of the film between the mean surfaces, c + Λ_t σ_r (MEAN_CLEARANCE), become derived
    constants.
    """
    import sympy as sp

    sigma = inputs.parameters["roughness"]
    inputs.derive(MEAN_CLEARANCE, inputs.pair.c + tip_contact_ratio * sigma, "clearance between the mean surfaces")
    distance = inputs.derive(
        "overlap",
        (tip_contact_ratio - full_contact_ratio) * sigma,
        "distance from first contact of the tips to full contact",
    )
    return sp.Min(1, inputs.variables["delta"] / distance)

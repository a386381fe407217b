"""What happens in a joint with play around its force laws, as equations in the order of their use.

The emitted C holds the same steps in templates/c (gap, dry, film, transition); a test evaluates what
is written here and compares it with the compiled library.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.clearance import Clearance, LawEquations
from gudgeon.generator.targets.c.clearance_code import EPSILON_MAX
from gudgeon.generator.targets.latex.letters import Name, letter


@dataclass(frozen=True)
class Step:
    """symbol = value."""

    symbol: sp.Symbol
    value: sp.Expr


def _symbol(name: str) -> sp.Symbol:
    return sp.Symbol(name, real=True)


e_x, e_y, de_x, de_y, omega_i, omega_j = map(_symbol, ("e_x", "e_y", "de_x", "de_y", "omega_i", "omega_j"))
e, n_x, n_y, delta, deltadot, de_t = map(_symbol, ("e", "n_x", "n_y", "delta", "deltadot", "de_t"))
stored, ratio, a_i, a_j, v_t = map(_symbol, ("stored", "ratio", "a_i", "a_j", "v_t"))
epsilon, w_n, w_t, share = map(_symbol, ("epsilon", "w_n", "w_t", "share"))
F_e, F_q, F_x, F_y, M_i, M_j = map(_symbol, ("F_e", "F_q", "F_x", "F_y", "M_i", "M_j"))

# Parts of a joint with film and dry contact are told apart by d and f.
_PARTS = {"dry": "d", "film": "f"}

NAMES: Mapping[sp.Symbol, Name] = {
    e_x: letter("e", "x"), e_y: letter("e", "y"), de_x: letter("e", "x", dots=1), de_y: letter("e", "y", dots=1),
    omega_i: letter("omega", "i"), omega_j: letter("omega", "j"), e: letter("e"), n_x: letter("n", "x"),
    n_y: letter("n", "y"), delta: letter("delta"), deltadot: letter("delta", dots=1), de_t: letter("e", "t", dots=1),
    stored: Name(r"\dot{\delta}^{-}", "δ̇⁻"), a_i: letter("a", "i"), a_j: letter("a", "j"), v_t: letter("v", "t"),
    epsilon: letter("epsilon"), w_n: letter("w", "n"), w_t: letter("w", "t"), share: letter("b"),
    F_e: letter("F", "e"), F_x: letter("F", "x"), F_y: letter("F", "y"), _symbol("F_n"): letter("F", "n"),
    _symbol("F_r"): letter("F", "r"),
}  # fmt: skip
RATIO, CLIPPED = Name(r"\frac{\dot{\delta}}{\dot{\delta}^{-}}", "(δ̇/δ̇⁻)"), letter("r")


def of_part(symbol: sp.Symbol, part: str) -> sp.Symbol:
    """F_t, M_i, M_j of the dry contact or of the film."""
    return _symbol(f"{symbol.name}_{part}")


def names(clearance: Clearance) -> dict[sp.Symbol, Name]:
    """Names of the steps' symbols; a law's F_t belongs to its part."""
    found = {**NAMES, ratio: CLIPPED if clearance.clip_ratio else RATIO}
    parts = [part for part in _PARTS if getattr(clearance, "film" if part == "film" else "normal") is not None]
    for symbol, base, index in ((F_q, "F", "t"), (M_i, "M", "i"), (M_j, "M", "j")):
        for part in parts:
            found[of_part(symbol, part)] = letter(base, index + _PARTS[part] if len(parts) > 1 else index)
        if len(parts) > 1:
            found[symbol] = letter(base, index)
    return found


def gap(clearance: Clearance) -> list[Step]:
    """Eccentricity's length, normal, penetration and their rates; t is n turned by +90°."""
    return [
        Step(e, sp.sqrt(e_x**2 + e_y**2)),
        Step(n_x, e_x / e),
        Step(n_y, e_y / e),
        Step(delta, e - clearance.pair.c),
        Step(deltadot, de_x * n_x + de_y * n_y),
        Step(de_t, de_y * n_x - de_x * n_y),
    ]


def before_dry(clearance: Clearance) -> list[Step]:
    """Levers of the contact point, in the middle of the penetration, and the surfaces' slip."""
    pair = clearance.pair
    clipped = [Step(ratio, sp.Max(-1, sp.Min(1, deltadot / stored)))] if clearance.clip_ratio else []
    return [
        Step(a_i, pair.R_i + delta / 2),
        Step(a_j, pair.R_j - delta / 2),
        Step(v_t, de_t + omega_j * a_j - omega_i * a_i),
        *clipped,
    ]


def after_dry() -> list[Step]:
    """Moments about the centres of bearing i and journal j."""
    tangential = of_part(F_q, "dry")
    return [
        Step(of_part(M_i, "dry"), -a_i * tangential),
        Step(of_part(M_j, "dry"), a_j * tangential),
    ]


def before_film(clearance: Clearance, film: LawEquations) -> list[Step]:
    """Eccentricity ratio and the effective squeeze velocity over the film's clearance."""
    c = clearance.constants.get("film_clearance", clearance.pair.c)
    turning = omega_j - omega_i if film.options.get("angular_velocity") == "relative" else omega_i + omega_j
    return [
        Step(epsilon, sp.Min(e / c, sp.Float(EPSILON_MAX))),
        Step(w_n, deltadot / c),
        Step(w_t, (de_t - turning * e / 2) / c),
    ]


def after_film(film: LawEquations) -> list[Step]:
    """Without shear the resultant acts at the journal's centre; with shear at each pin's own."""
    tangential = of_part(F_q, "film")
    if not film.options.get("shear", False):
        return [Step(of_part(M_i, "film"), -e * tangential), Step(of_part(M_j, "film"), sp.Integer(0))]
    drag = _symbol("T0") * (omega_j - omega_i)
    return [
        Step(of_part(M_i, "film"), drag - e * tangential / 2),
        Step(of_part(M_j, "film"), -drag - e * tangential / 2),
    ]


def resultant(clearance: Clearance) -> list[Step]:
    """Force on the journal in ground axes and both moments, film and dry contact blended."""
    dry, film = clearance.normal is not None, clearance.film is not None
    normal, radial = -_symbol("F_n"), _symbol("F_r")
    steps: list[Step] = []
    if dry and film:
        steps.append(Step(share, sp.Max(0, sp.Min(1, delta / clearance.transition))))
        blend = {F_e: (normal, radial)} | {s: (of_part(s, "dry"), of_part(s, "film")) for s in (F_q, M_i, M_j)}
        steps += [Step(s, share * of_dry + (1 - share) * of_film) for s, (of_dry, of_film) in blend.items()]
        along = F_e
    else:
        along = normal if dry else radial
    tangential = F_q if dry and film else of_part(F_q, "dry" if dry else "film")
    return [*steps, Step(F_x, along * n_x - tangential * n_y), Step(F_y, along * n_y + tangential * n_x)]


def moments(clearance: Clearance) -> tuple[sp.Symbol, sp.Symbol]:
    """The symbols of the moments about both centres."""
    if clearance.normal is not None and clearance.film is not None:
        return M_i, M_j
    part = "film" if clearance.normal is None else "dry"
    return of_part(M_i, part), of_part(M_j, part)

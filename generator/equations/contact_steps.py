"""Equations of a contact in a joint with play, in order of evaluation: gap, penetration, slip, force.

They follow physics.md, sections 2 to 4. The emitted C and the printed equations both come from these steps. What is
not an equation is in engine/ and templates/c/play: the normal at e = 0, free or closed, the approach speed δ̇⁻ that
is stored at onset.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.equations.contact_points import Wall
from gudgeon.generator.equations.play import Clearance, Contour, LawEquations
from gudgeon.generator.kinds.laws.law import MEAN_CLEARANCE

EPSILON_MAX = 0.9999  # the film is evaluated with its eccentricity ratio capped here


@dataclass(frozen=True)
class Assignment:
    """One equation symbol = value, which emitted code evaluates in this order."""

    symbol: sp.Symbol
    value: sp.Expr


def _make_symbol(name: str) -> sp.Symbol:
    """Return the real symbol of a name."""
    return sp.Symbol(name, real=True)


e_x, e_y, de_x, de_y, omega_i, omega_j = map(_make_symbol, ("e_x", "e_y", "de_x", "de_y", "omega_i", "omega_j"))
e, n_x, n_y, delta, deltadot, de_t = map(_make_symbol, ("e", "n_x", "n_y", "delta", "deltadot", "de_t"))
stored_approach_speed, ratio, a_i, a_j, v_t = map(_make_symbol, ("stored", "ratio", "a_i", "a_j", "v_t"))
depth = _make_symbol("depth")  # max(δ, 0), the penetration in a law of the dry contact
epsilon, w_n, w_t, share = map(_make_symbol, ("epsilon", "w_n", "w_t", "share"))
F_along_n, F_along_t, F_x, F_y, M_i, M_j = map(_make_symbol, ("F_along_n", "F_along_t", "F_x", "F_y", "M_i", "M_j"))

# Of a bearing with a contour, whose surface lies a depth beyond its circle at each angle:
theta_i, beta_i, u_x, u_y, contour_depth, contour_slope = map(
    _make_symbol, ("theta_i", "beta_i", "u_x", "u_y", "worn", "worn_slope")
)
beta_rate, scaled_gradient_length, gradient_length, F_N = map(_make_symbol, ("beta_rate", "slant", "steep", "F_N"))
position_along_guide = _make_symbol("along")  # position of a slider's corner along its guide
de_n, rate_across_e, slope_over_e = map(_make_symbol, ("de_n", "across", "lean"))  # rates along e and across it, d′/e


def make_part_symbol(symbol: sp.Symbol, part: str) -> sp.Symbol:
    """Return the symbol of F_t, M_i or M_j of one part of the force: "dry" for the dry contact, "film" for the film."""
    return _make_symbol(f"{symbol.name}_{part}")


def make_gap_equations(clearance: Clearance) -> list[Assignment]:
    """Return the equations of the gap in order: e = |(e_x, e_y)|, its direction n, penetration δ = e − c, δ̇ and ė_t.

    ė_t is the component of ė along t, which is n turned by +90°. These are the equations of a circular bearing. A
    bearing with a contour has those of `_make_contour_gap`, a slider's corner at a wall those of `_make_wall_gap`.
    """
    if clearance.contour:
        return _make_contour_gap(clearance, clearance.contour)
    if clearance.wall:
        return _make_wall_gap(clearance, clearance.wall)
    return [
        Assignment(e, sp.sqrt(e_x**2 + e_y**2)),
        Assignment(n_x, e_x / e),
        Assignment(n_y, e_y / e),
        Assignment(delta, e - clearance.pair.c),
        Assignment(deltadot, de_x * n_x + de_y * n_y),
        Assignment(de_t, de_y * n_x - de_x * n_y),
    ]


def _make_contour_gap(clearance: Clearance, contour: Contour) -> list[Assignment]:
    """Return the equations of the gap of a bearing with a contour: δ = e − c − d(β_i), β_i the angle of e in it.

    d is the depth beyond the circle. The normal n is along the gradient of δ by e, u − d′/e u_⊥; u is along e and u_⊥
    across it. `gradient_length` is the length Γ of that gradient, `scaled_gradient_length` is e Γ. A force −F_δ times
    that gradient is conservative if the result F_δ of the normal law depends on δ alone; the bearing then also receives
    the moment −d′ F_δ.
    """
    return [
        Assignment(e, sp.sqrt(e_x**2 + e_y**2)),
        Assignment(u_x, e_x / e),
        Assignment(u_y, e_y / e),
        Assignment(beta_i, sp.atan2(e_y, e_x) - theta_i),
        Assignment(contour_depth, contour.compute_depth(beta_i, 0)),
        Assignment(contour_slope, contour.compute_depth(beta_i, 1)),
        Assignment(delta, e - clearance.pair.c - contour_depth),
        Assignment(beta_rate, (de_y * u_x - de_x * u_y) / e - omega_i),
        Assignment(deltadot, de_x * u_x + de_y * u_y - contour_slope * beta_rate),
        Assignment(scaled_gradient_length, sp.sqrt(e**2 + contour_slope**2)),
        Assignment(gradient_length, scaled_gradient_length / e),
        Assignment(n_x, (e_x + contour_slope * u_y) / scaled_gradient_length),
        Assignment(n_y, (e_y - contour_slope * u_x) / scaled_gradient_length),
        Assignment(de_t, de_y * n_x - de_x * n_y),
    ]


def _make_wall_gap(clearance: Clearance, wall: Wall) -> list[Assignment]:
    """Return the equations of the gap of a slider's corner at a wall of its guide.

    The outward normal n turns with the guide: ṅ = ω_i t. (e_x, e_y) leads from the guide's point to the centre of the
    corner's radius. e is the displacement of that centre towards the wall from the middle of the guide.
    """
    return [
        Assignment(position_along_guide, e_y * n_x - e_x * n_y),
        Assignment(e, e_x * n_x + e_y * n_y - wall.rise),
        Assignment(delta, e - clearance.pair.c),
        Assignment(deltadot, de_x * n_x + de_y * n_y + omega_i * position_along_guide),
        Assignment(de_t, de_y * n_x - de_x * n_y),
    ]


def make_penetration_equation(clearance: Clearance) -> Assignment:
    """Return the equation of the penetration δ of a joint; without a contour it reads only e and the clearance c."""
    return next(step for step in make_gap_equations(clearance) if step.symbol == delta)


def make_contour_gap_equations(clearance: Clearance) -> list[Assignment]:
    """Return the equations of δ, δ̇ and ė_t of a bearing with a contour, by components along e and across it.

    `de_n` and `rate_across_e` are the rates of e in these directions, `contour_depth` and `contour_slope` are d and d′.
    Also defined are `slope_over_e` = d′/e and `gradient_length` = Γ = √(1 + (d′/e)²), the length of the gradient of δ.
    """
    return [
        Assignment(delta, e - clearance.pair.c - contour_depth),
        Assignment(slope_over_e, contour_slope / e),
        Assignment(gradient_length, sp.sqrt(1 + slope_over_e**2)),
        Assignment(deltadot, de_n - slope_over_e * rate_across_e + contour_slope * omega_i),
        Assignment(de_t, (rate_across_e + slope_over_e * de_n) / gradient_length),
    ]


def make_lever_arm_equations(clearance: Clearance) -> list[Assignment]:
    """Return the equations before the laws of a dry contact: lever arms a_i, a_j of the contact point, and slip v_t.

    The contact point is at mid-penetration: a_i = R_i + δ/2, a_j = R_j − δ/2, v_t = ė_t + ω_j a_j − ω_i a_i. In a
    bearing with a contour, a_j = R_j − δ/(2Γ) and a_i = e/Γ + a_j. With `clip_ratio` the equation of `ratio` follows,
    δ̇/δ̇⁻ clipped to [−1, 1].
    """
    dimensions = clearance.pair
    clipped = (
        [Assignment(ratio, sp.Max(-1, sp.Min(1, deltadot / stored_approach_speed)))] if clearance.clip_ratio else []
    )
    if clearance.contour:
        levers = [
            Assignment(a_j, dimensions.R_j - delta / (2 * gradient_length)),
            Assignment(a_i, e / gradient_length + a_j),
        ]
        return [*levers, Assignment(v_t, de_t + omega_j * a_j - omega_i * a_i), *clipped]
    return [
        Assignment(a_i, dimensions.R_i + delta / 2),
        Assignment(a_j, dimensions.R_j - delta / 2),
        Assignment(v_t, de_t + omega_j * a_j - omega_i * a_i),
        *clipped,
    ]


def make_contour_normal_force(clearance: Clearance) -> list[Assignment]:
    """Return the equation of the normal force of a contour, F_n = Γ F_δ, on which friction depends.

    `F_N` is that normal force, and the symbol F_n of the code the result F_δ of the normal law. The list is empty
    without a contour.
    """
    return [Assignment(F_N, gradient_length * _make_symbol("F_n"))] if clearance.contour else []


def resolve_contour_force(F_n: sp.Expr, friction_force: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Return the force on the journal of a bearing with a contour, as components (along e, across e).

    `F_n`: the result of the normal law; the force −F_n times the gradient of δ acts along n. `friction_force`: the
    force along t.
    """
    return -F_n + friction_force * slope_over_e / gradient_length, F_n * slope_over_e + friction_force / gradient_length


def make_dry_moment_equations(clearance: Clearance) -> list[Assignment]:
    """Return the equations of the moments of the dry contact: M_i = −a_i F_t on the bearing, M_j = a_j F_t.

    M_i acts on the bearing and M_j on the journal, each about its own centre. With a contour −d′ F_δ is added to M_i.
    """
    tangential = make_part_symbol(F_along_t, "dry")
    moment = -contour_slope * _make_symbol("F_n") if clearance.contour else 0
    return [
        Assignment(make_part_symbol(M_i, "dry"), -a_i * tangential + moment),
        Assignment(make_part_symbol(M_j, "dry"), a_j * tangential),
    ]


def make_wall_moment_equation(F_n: sp.Expr) -> Assignment:
    """Return the equation of the moment about the guide's point at a wall: that of the dry contact less that of F_n.

    The lever arm of F_n is the position of the slider's corner along the guide (`along` in C).
    """
    return Assignment(M_i, make_part_symbol(M_i, "dry") - position_along_guide * F_n)


def make_film_input_equations(clearance: Clearance, film: LawEquations) -> list[Assignment]:
    """Return the equations of the film's inputs: ε = e/c, at most EPSILON_MAX, and w_n = δ̇/c, w_t, both in 1/s.

    w_t = (ė_t − Ω e/2)/c. Ω is ω_j − ω_i if the film's option `angular_velocity` is "relative", else ω_i + ω_j. c is
    the film's own clearance, in mixed lubrication that between the mean surfaces, otherwise the clearance of the joint.
    """
    c = clearance.constants.get("film_clearance", clearance.constants.get(MEAN_CLEARANCE, clearance.pair.c))
    angular_velocity = omega_j - omega_i if film.options.get("angular_velocity") == "relative" else omega_i + omega_j
    return [
        Assignment(epsilon, sp.Min(e / c, sp.Float(EPSILON_MAX))),
        Assignment(w_n, deltadot / c),
        Assignment(w_t, (de_t - angular_velocity * e / 2) / c),
    ]


def make_film_moment_equations(film: LawEquations) -> list[Assignment]:
    """Return the equations of the moments of the film, M_i about the bearing's and M_j about the journal's centre.

    Without the film's option `shear` the force acts at the journal's centre: M_i = −e F_t, M_j = 0. With `shear` it
    acts midway between the centres, and the shear torque M_τ = T0 (ω_j − ω_i) is added to M_i and subtracted from M_j.
    """
    tangential = make_part_symbol(F_along_t, "film")
    if not film.options.get("shear", False):
        return [
            Assignment(make_part_symbol(M_i, "film"), -e * tangential),
            Assignment(make_part_symbol(M_j, "film"), sp.Integer(0)),
        ]
    drag = _make_symbol("T0") * (omega_j - omega_i)
    return [
        Assignment(make_part_symbol(M_i, "film"), drag - e * tangential / 2),
        Assignment(make_part_symbol(M_j, "film"), -drag - e * tangential / 2),
    ]


def make_blend_equations(clearance: Clearance, is_closed: bool = False) -> list[Assignment]:
    """Return the equations of the fraction of the dry contact: 0 at e = c, 1 at e = c + e_0 (equation 17 of the paper).

    Between them it is δ/e_0. A law of mixed lubrication has its own equations instead, the last one of the fraction.
    For a closed contact (`is_closed`) there is no switching point at e = c. That law then reads `depth` = max(δ, 0),
    since it may be undefined at δ < 0, where samples before a separation lie.
    """
    if clearance.mixed is not None:
        replacement = {delta: depth if is_closed else sp.Max(0, delta)}
        return [
            Assignment(_make_symbol(name), sp.sympify(expression).xreplace(replacement))
            for name, expression in clearance.mixed.equations_by_name.items()
        ]
    fraction = sp.Min(1, delta / clearance.transition)
    return [Assignment(share, fraction if is_closed else sp.Max(0, fraction))]


def make_resultant_equations(clearance: Clearance) -> list[Assignment]:
    """Return the equations of the force (F_x, F_y) on the journal in ground axes, and of moments that are blended.

    With a film and a dry contact, force and moments are share · dry + (1 − share) · film. The equations of `share` come
    first, unless a law of mixed lubrication gives it. At a wall the moment of the normal force is added to M_i.
    """
    dry, film = clearance.normal is not None, clearance.film is not None
    normal, radial = -(F_N if clearance.contour else _make_symbol("F_n")), _make_symbol("F_r")
    equations: list[Assignment] = []
    if dry and film:
        equations += (
            make_blend_equations(clearance) if clearance.mixed is None else []
        )  # a law of mixed lubrication is printed by itself
        blended = {
            symbol: (make_part_symbol(symbol, "dry"), make_part_symbol(symbol, "film"))
            for symbol in (F_along_t, M_i, M_j)
        }
        blended = {F_along_n: (normal, radial), **blended}
        equations += [
            Assignment(symbol, share * dry_value + (1 - share) * film_value)
            for symbol, (dry_value, film_value) in blended.items()
        ]
        normal_force = F_along_n
    else:
        normal_force = normal if dry else radial
    tangential = F_along_t if dry and film else make_part_symbol(F_along_t, "dry" if dry else "film")
    equations += [make_wall_moment_equation(_make_symbol("F_n"))] if clearance.wall else []
    return [
        *equations,
        Assignment(F_x, normal_force * n_x - tangential * n_y),
        Assignment(F_y, normal_force * n_y + tangential * n_x),
    ]


def find_moment_symbols(clearance: Clearance) -> tuple[sp.Symbol, sp.Symbol]:
    """Return the symbols of the moments on bearing i and journal j of a joint with play.

    They are (M_i, M_j) for a film with a dry contact, (M_i, M_j_dry) at a wall, else both with "_film" or "_dry".
    """
    if clearance.normal is not None and clearance.film is not None:
        return M_i, M_j
    part = "film" if clearance.normal is None else "dry"
    if clearance.wall:
        return M_i, make_part_symbol(M_j, part)
    return make_part_symbol(M_i, part), make_part_symbol(M_j, part)

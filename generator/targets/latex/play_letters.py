"""Names the symbols of a joint with play: its steps (generator/equations/contact_steps.py), parameters and laws."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import sympy as sp

from gudgeon.generator.equations.contact_steps import (
    F_N,
    F_along_n,
    F_along_t,
    F_x,
    F_y,
    M_i,
    M_j,
    a_i,
    a_j,
    along,
    beta_i,
    beta_rate,
    de_t,
    de_x,
    de_y,
    delta,
    deltadot,
    e,
    e_x,
    e_y,
    epsilon,
    n_x,
    n_y,
    of_part,
    omega_i,
    omega_j,
    ratio,
    share,
    slant,
    steep,
    stored,
    theta_i,
    u_x,
    u_y,
    v_t,
    w_n,
    w_t,
    worn,
    worn_slope,
)
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations
from gudgeon.generator.field import Field
from gudgeon.generator.kinds.laws.law import HELD, RESULTS, Law
from gudgeon.generator.mechanism import LawUse, Quantity
from gudgeon.generator.symbols.parameter_table import ParameterEntry
from gudgeon.generator.targets.latex.letters import Name, distinct, letter, of_latex, word

# Parts of a joint with film and dry contact are told apart by d and f.
_PARTS = {"dry": "d", "film": "f"}

NAMES: Mapping[sp.Symbol, Name] = {
    e_x: letter("e", "x"),
    e_y: letter("e", "y"),
    de_x: letter("e", "x", dots=1),
    de_y: letter("e", "y", dots=1),
    omega_i: letter("omega", "i"),
    omega_j: letter("omega", "j"),
    e: letter("e"),
    n_x: letter("n", "x"),
    n_y: letter("n", "y"),
    delta: letter("delta"),
    deltadot: letter("delta", dots=1),
    de_t: letter("e", "t", dots=1),
    stored: Name(r"\dot{\delta}^{-}", "δ̇⁻"),
    a_i: letter("a", "i"),
    a_j: letter("a", "j"),
    v_t: letter("v", "t"),
    epsilon: letter("epsilon"),
    w_n: letter("w", "n"),
    w_t: letter("w", "t"),
    share: letter("b"),
    F_along_n: letter("F", "e"),
    along: letter("e", "t"),
    F_x: letter("F", "x"),
    F_y: letter("F", "y"),
    theta_i: letter("theta", "i"),
    beta_i: letter("beta", "i"),
    u_x: letter("u", "x"),
    u_y: letter("u", "y"),
    worn: letter("w"),
    worn_slope: Name("w'", "w'"),
    beta_rate: letter("beta", "i", dots=1),
    slant: letter("r"),
    steep: letter("zeta"),
    F_N: letter("F", "N"),
    sp.Symbol("F_n", real=True): letter("F", "n"),
    sp.Symbol("F_r", real=True): letter("F", "r"),
    sp.Symbol(HELD[0], real=True): letter("lambda"),
}
# What the laws call their abbreviations and constants, in the paper's letters.
LAW_LETTERS = {
    "root": letter("s"),
    "factor": letter("f"),
    "hysteresis": letter("a"),
    "film_clearance": letter("c", "film"),
    "friction_slope": letter("kappa"),
    "shear": letter("D", "0"),
    "T0": letter("D"),
    "spring": letter("K"),
    "damper": letter("D"),
    "mean_clearance": letter("c", "mean"),
    "share": letter("b"),
    "overlap": letter("l"),
    "deepest": letter("delta", "max"),
    "scale": letter("l"),
    "part": letter("y"),
    "gone": letter("x"),
    "left": letter("y"),
    "F_e": letter("F", "el"),
}
_LETTERS_AT_WALL = (("c", "c"), ("R_i", "h_i"))  # lengths of the slider, which points of bodies have too, keep theirs
GUIDE = (
    ("gap", "c", "gap on each side"),
    ("half_length", "a", "half the slider's length"),
    ("half_height", "b", "half the slider's height"),
    ("corner_radius", r"\rho", "radius of the slider's corners"),
)
RATIO, CLIPPED = Name(r"\frac{\dot{\delta}}{\dot{\delta}^{-}}", "(δ̇/δ̇⁻)"), letter("r")


def names(clearance: Clearance) -> dict[sp.Symbol, Name]:
    """Return {symbol: name} of the contact steps of a joint with play.

    Forces and moments have the index d or f if the joint has both dry contact and film. Corners at walls have their
    own moments.
    """
    step_names = {**NAMES, ratio: CLIPPED if clearance.clip_ratio else RATIO}
    parts = [part for part in _PARTS if getattr(clearance, "film" if part == "film" else "normal") is not None]
    for symbol, base, index in ((F_along_t, "F", "t"), (M_i, "M", "i"), (M_j, "M", "j")):
        for part in parts:
            step_names[of_part(symbol, part)] = letter(base, index + _PARTS[part] if len(parts) > 1 else index)
        if len(parts) > 1:
            step_names[symbol] = letter(base, index)
    if len(parts) < 2:
        del step_names[share]
    if clearance.wall:
        step_names |= {M_i: letter("M", "i"), of_part(M_i, "dry"): letter("M", "i", "t")}
    return step_names


def joint_letters(model: Model, clearance: Clearance) -> dict[sp.Symbol, Name]:
    """Return {symbol: unique letter} of one joint's sections: c, R_i, K, c_e stand for this joint only."""
    return distinct(_propose_letters(model, clearance))


def _propose_letters(model: Model, clearance: Clearance) -> Iterator[tuple[sp.Expr, Name]]:
    """Yield (symbol, letter) in the order in which symbols get their letters.

    Contact steps come first, then dimensions, elastic constants, numbers and constants of laws, and steps of laws.
    """
    pair, laws, wall = clearance.pair, laws_of(model, clearance), clearance.wall
    yield from names(clearance).items()
    lengths = _LETTERS_AT_WALL if wall else (("c", "c"), ("R_i", "R_i"), ("R_j", "R_j"), ("L", "L"))
    pairs = [(getattr(pair, attribute), latex) for attribute, latex in lengths]
    for symbol, latex in pairs:
        if symbol.is_Symbol:
            yield symbol, of_latex(latex)
    for constant in ("E", "nu"):
        i, j = getattr(pair, f"{constant}_i"), getattr(pair, f"{constant}_j")
        yield from [(i, letter(constant))] if i == j else [(i, letter(constant, "i")), (j, letter(constant, "j"))]
    if clearance.transition is not None:
        yield clearance.transition, letter("e", "0")
    for equations, use in laws:
        for parameter, quantity in given(equations, use):
            if entry := _find_parameter(model, quantity):
                yield entry.symbol, of_latex(sign_of(parameter))
    for name, value in clearance.constants.items():
        if not (wall and value == pair.R_j):
            yield value, LAW_LETTERS.get(name) or word(name)
    for equations, _ in laws:
        for name in equations.steps:
            yield result(equations, name), step_name(equations.law, name)


def _find_parameter(model: Model, quantity: Quantity | None) -> ParameterEntry | None:
    """Return the run-time parameter of a quantity; None if it has none, or if the quantity is None."""
    return None if quantity is None else model.slots.entries.get(quantity.address)


def laws_of(model: Model, clearance: Clearance) -> list[tuple[LawEquations, LawUse]]:
    """Return (equations, use in the file) of each law of a joint."""
    return list(zip(clearance.laws, model.scene.play[clearance.joint.name].contact.laws, strict=True))


def given(equations: LawEquations, use: LawUse) -> list[tuple[Field, Quantity]]:
    """Return (field, quantity) of the parameters of a law, without optional ones that the file leaves out."""
    return [
        (parameter, use.quantities[parameter.name])
        for parameter in equations.law.parameters
        if parameter.name in use.quantities
    ]


def result(equations: LawEquations, name: str) -> sp.Symbol:
    """Return the symbol of a law's step; a tangential force is that of its part of the joint, film or dry contact."""
    if name == "F_t" and name in RESULTS[equations.law.role]:
        return of_part(F_along_t, "film" if equations.law.role == "film" else "dry")
    return sp.Symbol(name, real=True)


def step_name(law: Law, name: str) -> Name:
    """Return the name of an abbreviation or result of a law; the rate of an inner state has a dot."""
    name = name.removesuffix("__")  # of a user-defined law
    rate_names = {f"{state.name}_rate": letter(state.name, dots=1) for state in law.states}
    return (LAW_LETTERS | rate_names).get(name) or word(name)


def sign_of(parameter: Field) -> str:
    """Return the letter of a law's parameter in LaTeX: its symbol, or else its name."""
    return parameter.symbol or word(parameter.name).latex

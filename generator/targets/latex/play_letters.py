"""Letters of the symbols that a joint with play is written in (generator/equations/contact_steps.py)."""

from __future__ import annotations

from collections.abc import Mapping

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
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.kinds.laws.law import HELD
from gudgeon.generator.targets.latex.letters import Name, letter

# Parts of a joint with film and dry contact are told apart by d and f.
_PARTS = {"dry": "d", "film": "f"}

NAMES: Mapping[sp.Symbol, Name] = {
    e_x: letter("e", "x"), e_y: letter("e", "y"), de_x: letter("e", "x", dots=1), de_y: letter("e", "y", dots=1),
    omega_i: letter("omega", "i"), omega_j: letter("omega", "j"), e: letter("e"), n_x: letter("n", "x"),
    n_y: letter("n", "y"), delta: letter("delta"), deltadot: letter("delta", dots=1), de_t: letter("e", "t", dots=1),
    stored: Name(r"\dot{\delta}^{-}", "δ̇⁻"), a_i: letter("a", "i"), a_j: letter("a", "j"), v_t: letter("v", "t"),
    epsilon: letter("epsilon"), w_n: letter("w", "n"), w_t: letter("w", "t"), share: letter("b"),
    F_along_n: letter("F", "e"), along: letter("e", "t"), F_x: letter("F", "x"), F_y: letter("F", "y"),
    theta_i: letter("theta", "i"), beta_i: letter("beta", "i"), u_x: letter("u", "x"), u_y: letter("u", "y"),
    worn: letter("w"), worn_slope: Name("w'", "w'"), beta_rate: letter("beta", "i", dots=1), slant: letter("r"),
    steep: letter("zeta"), F_N: letter("F", "N"),
    sp.Symbol("F_n", real=True): letter("F", "n"), sp.Symbol("F_r", real=True): letter("F", "r"),
    sp.Symbol(HELD[0], real=True): letter("lambda"),
}  # fmt: skip
RATIO, CLIPPED = Name(r"\frac{\dot{\delta}}{\dot{\delta}^{-}}", "(δ̇/δ̇⁻)"), letter("r")


def names(clearance: Clearance) -> dict[sp.Symbol, Name]:
    """Names of the steps' symbols; a law's F_t belongs to its part."""
    found = {**NAMES, ratio: CLIPPED if clearance.clip_ratio else RATIO}
    parts = [part for part in _PARTS if getattr(clearance, "film" if part == "film" else "normal") is not None]
    for symbol, base, index in ((F_along_t, "F", "t"), (M_i, "M", "i"), (M_j, "M", "j")):
        for part in parts:
            found[of_part(symbol, part)] = letter(base, index + _PARTS[part] if len(parts) > 1 else index)
        if len(parts) > 1:
            found[symbol] = letter(base, index)
    if clearance.wall:
        found |= {M_i: letter("M", "i"), of_part(M_i, "dry"): letter("M", "i", "t")}
    return found

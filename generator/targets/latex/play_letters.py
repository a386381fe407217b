"""Names the symbols of a joint with play in a document of equations: kinematics, parameters and force laws."""

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
    beta_i,
    beta_rate,
    contour_depth,
    contour_slope,
    de_t,
    de_x,
    de_y,
    delta,
    deltadot,
    e,
    e_x,
    e_y,
    epsilon,
    gradient_length,
    make_part_symbol,
    n_x,
    n_y,
    omega_i,
    omega_j,
    position_along_guide,
    ratio,
    scaled_gradient_length,
    share,
    stored_approach_speed,
    theta_i,
    u_x,
    u_y,
    v_t,
    w_n,
    w_t,
)
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations
from gudgeon.generator.field import Field
from gudgeon.generator.kinds.laws.law import CONSTRAINT_VARIABLES, RESULTS, Law
from gudgeon.generator.mechanism import LawUse, Quantity
from gudgeon.generator.symbols.parameter_table import ParameterEntry
from gudgeon.generator.targets.latex.letters import (
    Formula,
    assign_unique_names,
    make_name_from_latex,
    make_symbol_name,
    make_user_symbol_name,
)

# Indices of the parts of a joint with film and dry contact.
_PARTS = {"dry": "d", "film": "f"}

NAMES: Mapping[sp.Symbol, Formula] = {
    e_x: make_symbol_name("e", "x"),
    e_y: make_symbol_name("e", "y"),
    de_x: make_symbol_name("e", "x", dots=1),
    de_y: make_symbol_name("e", "y", dots=1),
    omega_i: make_symbol_name("omega", "i"),
    omega_j: make_symbol_name("omega", "j"),
    e: make_symbol_name("e"),
    n_x: make_symbol_name("n", "x"),
    n_y: make_symbol_name("n", "y"),
    delta: make_symbol_name("delta"),
    deltadot: make_symbol_name("delta", dots=1),
    de_t: make_symbol_name("e", "t", dots=1),
    stored_approach_speed: Formula(r"\dot{\delta}^{-}", "δ̇⁻"),
    a_i: make_symbol_name("a", "i"),
    a_j: make_symbol_name("a", "j"),
    v_t: make_symbol_name("v", "t"),
    epsilon: make_symbol_name("epsilon"),
    w_n: make_symbol_name("w", "n"),
    w_t: make_symbol_name("w", "t"),
    share: make_symbol_name("b"),
    F_along_n: make_symbol_name("F", "e"),
    position_along_guide: make_symbol_name("e", "t"),
    F_x: make_symbol_name("F", "x"),
    F_y: make_symbol_name("F", "y"),
    theta_i: make_symbol_name("theta", "i"),
    beta_i: make_symbol_name("beta", "i"),
    u_x: make_symbol_name("u", "x"),
    u_y: make_symbol_name("u", "y"),
    contour_depth: make_symbol_name("d"),
    contour_slope: Formula("d'", "d'"),
    beta_rate: make_symbol_name("beta", "i", dots=1),
    scaled_gradient_length: make_symbol_name("r"),
    gradient_length: make_symbol_name("Gamma"),
    sp.Symbol("F_n", real=True): make_symbol_name("F", "n"),
    sp.Symbol("F_r", real=True): make_symbol_name("F", "r"),
    sp.Symbol(CONSTRAINT_VARIABLES[0], real=True): make_symbol_name("lambda", "n"),
}
# Symbols of abbreviations and constants of laws, by their names in the laws' Python.
LAW_SYMBOL_NAMES = {
    "root": make_symbol_name("s", "epsilon"),
    "factor": make_symbol_name("f"),
    "hysteresis": make_symbol_name("a"),
    "film_clearance": make_symbol_name("c", "film"),
    "friction_slope": make_symbol_name("kappa"),
    "shear": make_symbol_name("D", "0"),
    "T0": make_symbol_name("D", "s"),
    "spring": make_symbol_name("K"),
    "damper": make_symbol_name("D"),
    "mean_clearance": make_symbol_name("c", "mean"),
    "share": make_symbol_name("b"),
    "overlap": make_symbol_name("l"),
    "deepest": make_symbol_name("delta", "max"),
    "scale": make_symbol_name("l"),
    "part": make_symbol_name("y"),
    "overlap_fraction": make_symbol_name("x"),
    "remainder": make_symbol_name("y"),
    "F_e": make_symbol_name("F", "el"),
}
# Symbols of physics.md for abbreviations of single laws: (law, name in its Python).
LAW_SPECIFIC_NAMES = {
    ("finite_length", "q"): make_symbol_name("w", "epsilon"),
    ("finite_length", "x"): make_symbol_name("xi"),
}
_LENGTHS_AT_WALL = (("c", "c"), ("R_i", "h_i"))  # the dimensions of the slider have the names of the notation
GUIDE = (
    ("gap", "c", "gap on each side"),
    ("half_length", "a_g", "half the slider's length"),
    ("half_height", "b_g", "half the slider's height"),
    ("corner_radius", r"\rho_g", "radius of the slider's corners"),
)
RATIO, CLIPPED = Formula(r"\frac{\dot{\delta}}{\dot{\delta}^{-}}", "(δ̇/δ̇⁻)"), make_symbol_name("r")


def name_contact_variables(clearance: Clearance) -> dict[sp.Symbol, Formula]:
    """Return {symbol: name} of the variables of a joint with play, from eccentricity to force (contact_steps.py).

    Forces and moments have the index d (dry) or f (film) if the joint has both; only such a joint has a name for
    `share`. With a contour, the normal force F_N is named F_n, and the result F_n of the normal law, along the gradient
    of δ, is named F_delta. At a corner of a slider at a wall, the moment of the dry contact on the guide is named M_i,t
    and the total moment M_i.
    """
    step_names = {**NAMES, ratio: CLIPPED if clearance.clip_ratio else RATIO}
    parts = [part for part in _PARTS if getattr(clearance, "film" if part == "film" else "normal") is not None]
    for symbol, base, index in ((F_along_t, "F", "t"), (M_i, "M", "i"), (M_j, "M", "j")):
        for part in parts:
            step_names[make_part_symbol(symbol, part)] = make_symbol_name(
                base, index + _PARTS[part] if len(parts) > 1 else index
            )
        if len(parts) > 1:
            step_names[symbol] = make_symbol_name(base, index)
    if len(parts) < 2:
        del step_names[share]
    if clearance.contour:  # friction depends on the normal force F_N; the normal law gives F_n along the gradient of δ
        step_names |= {F_N: make_symbol_name("F", "n"), sp.Symbol("F_n", real=True): make_symbol_name("F", "delta")}
    if clearance.wall:
        step_names |= {M_i: make_symbol_name("M", "i"), make_part_symbol(M_i, "dry"): make_symbol_name("M", "i", "t")}
    return step_names


def name_joint_symbols(model: Model, clearance: Clearance) -> dict[sp.Symbol, Formula]:
    """Return {symbol: unique name} of one joint's sections: c, R_i, K, c_e stand for this joint only."""
    return assign_unique_names(_propose_symbol_names(model, clearance))


def _propose_symbol_names(model: Model, clearance: Clearance) -> Iterator[tuple[sp.Expr, Formula]]:
    """Yield (symbol, proposed name) for a joint with play; names may repeat, and the first symbol keeps a name.

    Contact variables come first, then dimensions, elastic constants, the transition, parameters and constants of laws,
    and variables of laws.
    """
    pair, laws, wall = clearance.pair, list_joint_laws(model, clearance), clearance.wall
    yield from name_contact_variables(clearance).items()
    lengths = _LENGTHS_AT_WALL if wall else (("c", "c"), ("R_i", "R_i"), ("R_j", "R_j"), ("L", "L"))
    pairs = [(getattr(pair, attribute), latex) for attribute, latex in lengths]
    for symbol, latex in pairs:
        if symbol.is_Symbol:
            yield symbol, make_name_from_latex(latex)
    for constant in ("E", "nu"):
        i, j = getattr(pair, f"{constant}_i"), getattr(pair, f"{constant}_j")
        yield from (
            [(i, make_symbol_name(constant, "i"))]
            if i == j
            else [(i, make_symbol_name(constant, "i")), (j, make_symbol_name(constant, "j"))]
        )
    if clearance.transition is not None:
        yield clearance.transition, make_symbol_name("e", "0")
    for equations, use in laws:
        for parameter, quantity in list_specified_parameters(equations, use):
            if entry := _find_parameter(model, quantity):
                yield entry.symbol, make_name_from_latex(get_latex_symbol(parameter))
    for name, value in clearance.constants.items():
        if not (wall and value == pair.R_j):
            yield value, LAW_SYMBOL_NAMES.get(name) or make_user_symbol_name(name)
    for equations, _ in laws:
        for name in equations.equations_by_name:
            yield get_result_symbol(equations, name), name_law_variable(equations.law, name)


def _find_parameter(model: Model, quantity: Quantity | None) -> ParameterEntry | None:
    """Return the run-time parameter of a quantity; None if it has none, or if the quantity is None."""
    return None if quantity is None else model.parameter_table.entries.get(quantity.address)


def list_joint_laws(model: Model, clearance: Clearance) -> list[tuple[LawEquations, LawUse]]:
    """Return (equations, use in the file) of each law of a joint with play: normal, friction, film, mixed."""
    return list(zip(clearance.laws, model.scene.play[clearance.joint.name].contact.laws, strict=True))


def list_specified_parameters(equations: LawEquations, law_use: LawUse) -> list[tuple[Field, Quantity]]:
    """Return (field, quantity) of the parameters of a law that have a value: specified in the file, or a default.

    Optional parameters that the file leaves out are not in the list.
    """
    return [
        (parameter, law_use.quantities[parameter.name])
        for parameter in equations.law.parameters
        if parameter.name in law_use.quantities
    ]


def get_result_symbol(equations: LawEquations, name: str) -> sp.Symbol:
    """Return the symbol of an intermediate quantity or result of a law by its name in the law's Python.

    It is the real symbol of that name, except for a result F_t: the tangential force of the film (role film) or of the
    dry contact (other roles).
    """
    if name == "F_t" and name in RESULTS[equations.law.role]:
        return make_part_symbol(F_along_t, "film" if equations.law.role == "film" else "dry")
    return sp.Symbol(name, real=True)


def name_law_variable(law: Law, name: str) -> Formula:
    """Return the name of an abbreviation, constant or result of a law.

    The rate "STATE_rate" of an internal state has a dot; names without an entry in the tables become words.
    """
    name = name.removesuffix("__")  # of a user-defined law
    rate_names = {f"{state.name}_rate": make_symbol_name(state.name, dots=1) for state in law.states}
    specific_name = LAW_SPECIFIC_NAMES.get((law.name, name))
    return specific_name or (LAW_SYMBOL_NAMES | rate_names).get(name) or make_user_symbol_name(name)


def get_latex_symbol(parameter: Field) -> str:
    """Return the symbol of a law's parameter in LaTeX, or else its name."""
    return parameter.symbol or make_user_symbol_name(parameter.name).latex

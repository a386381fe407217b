"""Φ, Φ_q, ν, γ and how joints with play stand, as JavaScript: for the values that a page shows beside its equations."""

from __future__ import annotations

import json

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Step
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.dependence import slices
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder
from gudgeon.generator.ir.readable import readable
from gudgeon.generator.ir.signatures import PARAMETERS, STATE
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels import closed_linkage
from gudgeon.generator.targets.javascript.printer import PRELUDE, arguments, function

GAP = ("e", "delta", "deltadot", "v_t", "epsilon")  # of a joint with play; epsilon of one with a film
_GIVEN = (contact.e_x, contact.e_y, contact.de_x, contact.de_y, contact.omega_i, contact.omega_j)


def equations_script(model: Model, dynamics: Kernel | None = None) -> str:
    """JavaScript that declares `gudgeonEquations`, with what a page needs to know of them.

    `dynamics`: its lines up to the right-hand side of each row are among the functions.

    `functions` of t, q, v, p, as far as `given` names them, return their locals and arrays by name; `numbers` are
    places in a run's p by the name of the member of p; `rows` are the places of the scene's rows in the closed
    linkage's, `names` what they are called. Raises ValueError for curves.
    """
    kernels = [*closed_linkage.row_kernels(model), *([play_kernel(model)] if model.clearances else [])]
    read: set[str] = set()
    texts = [function(kernel, read) for kernel in kernels]
    if dynamics is not None:
        texts.append(function(dynamics, read, right_hand_sides(dynamics, model)))
        kernels.append(dynamics)
    text = ",\n".join(texts)
    members = map(model.slots.field, model.slots.members())
    place = {row.name: k for k, row in enumerate(model.all_rows)}
    told = {
        "numbers": {one: k for k, one in enumerate(members) if one in read},
        "rows": [place[row.name] for row in model.rows], "names": [row.name for row in model.rows],
        "given": {kernel.name: arguments(kernel) for kernel in kernels},
    }  # fmt: skip
    parts = ", ".join(f"{key}: {json.dumps(value, separators=(',', ':'))}" for key, value in told.items())
    return f"const gudgeonEquations = (() => {{\n{PRELUDE}return {{{parts}, functions: {{\n{text},\n}}}};\n}})();\n"


def right_hand_sides(dynamics: Kernel, model: Model) -> set[str]:
    """Locals of `dynamics` that the right-hand sides of the rows of its linear system hang on."""
    names = {f"rhs_{row.name.replace('.', '_')}" for row in model.rows}
    found = slices(readable(dynamics), lambda line: frozenset({"rhs"} if line.target in names else ()))
    return {name for name in found.stored if name.isidentifier()}


def gap_name(model: Model, index: int, of: str) -> str:
    """The local of `play` that holds something of a joint with play."""
    taken = {symbol.name for symbol in model.symbols.info}
    first = next(word for word in ("play", "joint", "with_play") if not any(one.startswith(word) for one in taken))
    return f"{first}_{index + 1}_{of}"


def play_kernel(model: Model) -> Kernel:
    """GAP of each joint with play at a state: the steps in front of its laws."""
    build = KernelBuilder(model.symbols, "play", ["Joints with play: eccentricity, penetration and rate, slip, e/c."])
    for i, clearance in enumerate(model.clearances):
        build.section(f"joint {clearance.name}")
        steps = _steps(clearance)
        own = {step.symbol: sp.Symbol(gap_name(model, i, step.symbol.name), real=True) for step in steps}
        for step in steps:
            build.line(Statement(own[step.symbol].name, step.value.xreplace(own)))
    return build.build((*STATE, PARAMETERS))


def _steps(clearance: Clearance) -> list[Step]:
    """From the coordinates to δ, δ̇, the slip and e/c."""
    values = (*clearance.eccentricity, *clearance.eccentricity_rate, clearance.first.omega, clearance.second.omega)
    steps = [Step(symbol, sp.sympify(value)) for symbol, value in zip(_GIVEN, values, strict=True)]
    steps += contact.gap(clearance)
    if clearance.normal is not None:
        steps += [step for step in contact.before_dry(clearance) if step.symbol != contact.ratio]
    if clearance.film is not None:
        steps += contact.before_film(clearance, clearance.film)
    return steps

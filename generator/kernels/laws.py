"""The force laws of joints with play as small functions of their own, each once a scene."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations, letter_of
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder
from gudgeon.generator.ir.reciprocals import hoisted, with_reciprocals
from gudgeon.generator.ir.signatures import PARAMETERS, SIDES, Argument, result
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels.shared import SharedCall, SharedFunctions, joint_numbers
from gudgeon.generator.kinds.laws.law import OWN
from gudgeon.generator.symbols.storage import Result


def law_calls(model: Model, clearance: Clearance, shared: SharedFunctions) -> dict[str, SharedCall]:
    """How a joint calls its laws, by role, as far as it has them."""
    found = {}
    for law in (clearance.normal, clearance.friction, clearance.film):
        if law is not None:
            kernel = _law_kernel(model, clearance, law)
            numbers = joint_numbers(model, clearance)
            found[law.law.role] = shared.call(kernel, numbers, clearance.label, _meanings(model, law))
    return found


def _meanings(model: Model, equations: LawEquations) -> dict[str, str]:
    """Of the law's numbers, by the names that they have in it."""
    info = model.symbols.info
    law = equations.law
    derived = {letter_of(law, name): info[one].meaning for name, one in equations.derived.items() if one in info}
    return derived | {letter_of(law, parameter.name): parameter.meaning for parameter in law.parameters}


def law_name(equations: LawEquations) -> str:
    """The law's own name, "own_" before it if it is the user's, with the options that are not the usual ones."""
    usual = {option.name: option.default for option in equations.law.options}
    chosen = {name: value for name, value in equations.options.items() if value != usual[name]}
    name = equations.law.name
    name = "_".join([name, *(option if value is True else str(value) for option, value in chosen.items())])
    return f"own_{name}__" if equations.law.name in OWN else name  # whatever the user calls it, no other function


def _law_kernel(model: Model, clearance: Clearance, equations: LawEquations) -> Kernel:
    """Abbreviations become locals, results go to `F_…_out`; the law says its source and validity."""
    results = equations.results
    build = KernelBuilder(model.symbols, law_name(equations), law_doc(equations))
    build.section("")
    for name, equation in equations.steps.items():
        value = hoisted(model.slots, sp.sympify(equation))
        if name in results:
            build.out(Result(f"{name}_out"), value)
        else:
            build.line(Statement(name, value))
    variables = (Argument(symbol.name) for symbol in equations.variables)
    outs = (result(f"{name}_out") for name in results)
    kernel = build.build((*variables, PARAMETERS, *SIDES, *outs), inline=True, owner=clearance.name)
    return with_reciprocals(kernel)


def law_doc(equations: LawEquations) -> list[str]:
    """What a comment says of a law: title, source, validity, options."""
    law = equations.law
    chosen = [f"{name}: {value}" for name, value in equations.options.items()]
    usual = {option.name: option.default for option in law.options}
    whose = [
        f"Of {value}: {source}."
        for option in law.options
        for value, source in (option.sources or {}).items()
        if value == equations.options.get(option.name) != usual[option.name]
    ]
    return [
        f"{law.title}.", f"Source: {law.source}.", f"Valid: {law.validity}.",
        *([f"Options: {', '.join(chosen)}."] if chosen else []), *whose,
    ]  # fmt: skip

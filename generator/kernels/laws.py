"""The force laws of each joint with play as small functions of their own."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations
from gudgeon.generator.ir.kernels import Argument, Kernel, KernelBuilder, Section
from gudgeon.generator.ir.reciprocals import hoisted, with_reciprocals
from gudgeon.generator.ir.signatures import PARAMETERS, SIDES
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kinds.laws.law import RESULTS


def law_kernels(model: Model, clearance: Clearance) -> list[Kernel]:
    """`normal_<joint>`, `friction_<joint>`, `film_<joint>`, as far as the joint has them."""
    kernels = []
    if clearance.normal is not None:
        kernels.append(_law_kernel(model, clearance, clearance.normal))
        kernels.append(
            _no_friction(clearance) if clearance.friction is None else _law_kernel(model, clearance, clearance.friction)
        )
    if clearance.film is not None:
        kernels.append(_law_kernel(model, clearance, clearance.film))
    return kernels


def _law_kernel(model: Model, clearance: Clearance, equations: LawEquations) -> Kernel:
    """Abbreviations become locals, results `*F_…` pointers; the law says its source and validity."""
    law = equations.law
    results = RESULTS[law.role]
    chosen = [f"{name}: {value}" for name, value in equations.options.items()]
    build = KernelBuilder(model.symbols, f"{law.role}_{clearance.name}_force", [
        f"{law.title}.", f"Source: {law.source}.", f"Valid: {law.validity}.",
        *([f"Options: {', '.join(chosen)}."] if chosen else []),
    ])  # fmt: skip
    build.section(f"law of joint {clearance.name}")
    for name, equation in equations.steps.items():
        value = hoisted(model.slots, sp.sympify(equation))
        if name in results:
            build.out(f"*{name}_out", value)
        else:
            # the law's own letters are reserved (symbols.py), so the local keeps its name
            build.line(Statement(name, value))
    variables = (Argument("double", symbol.name) for symbol in equations.variables)
    outs = (Argument("double *", f"{name}_out") for name in results)
    kernel = build.build((*variables, PARAMETERS, *SIDES, *outs), inline=True, owner=clearance.name)
    return with_reciprocals(kernel)


def _no_friction(clearance: Clearance) -> Kernel:
    variables = (Argument("double", "F_n"), Argument("double", "v_t"))
    arguments = (*variables, PARAMETERS, *SIDES, Argument("double *", "F_t_out"))
    none = Section("no friction law", (Statement("*F_t_out", sp.Integer(0), False),))
    return Kernel(f"friction_{clearance.name}_force", ("No friction in this joint.",), arguments, (none,), inline=True)

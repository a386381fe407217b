"""The C of the reduced formulation, beside the absolute one in the same library."""

from __future__ import annotations

from collections.abc import Callable

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.program import TreeFunctions
from gudgeon.generator.reduction.reduction import TreeSystem

Render = Callable[..., str]


def reduced_code(model: Model, tree: TreeFunctions, render: Render, print_kernels: Render) -> str:
    """The kernels in tree coordinates, the way there and back, and those of driven chains."""
    parts = [print_kernels(*tree.around), print_kernels(*tree.kernels)]
    if tree.rescued:
        parts.append(render("multipliers.c.jinja", multipliers=_multipliers(model, tree.system)))
    if chains := tree.chains:
        kernels = print_kernels(*chains.kernels)
        parts.append(render("chains.c.jinja", kernels=kernels, shares=chains.shares(), turned=chains.turned()))
    return "\n".join(parts)


def _multipliers(model: Model, system: TreeSystem) -> list[str]:
    """Each closure's multiplier in those of the absolute rows."""
    place = {row.name: r for r, row in enumerate(model.rows)}
    return [
        " ".join(f"{'+' if sign > 0 else '-'} lambda[{place[name]}]" for name, sign in shares.items())
        for shares in (system.tree.multiplier(row.name) for row in system.rows)
    ]

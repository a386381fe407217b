"""The C of the reduced formulation, beside the absolute one in the same library."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.driven_chains import ChainKernels
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
        parts.append(render("chains.c.jinja", kernels=kernels, shares=_shares(chains), turned=_turned(chains)))
    return "\n".join(parts)


def _shares(chains: ChainKernels) -> list[str]:
    """What a step of each coordinate is multiplied by to be a number: an angle is one, a slide goes by the size."""
    size = f"1.0 / (p->{chains.size} + DBL_MIN)" if chains.size.is_Symbol else "1.0"  # without one all points are one
    return ["1.0" if "." not in name else size for name in chains.chain.names]


def _turned(chains: ChainKernels) -> list[tuple[int, str]]:
    """Where each direction is in q that a step of the chains' coordinates turns, and how far it turns."""

    def factor(c: sp.Expr) -> str:
        if c == 1:
            return ""
        return f"{float(c)!r} * " if c.is_Number else f"-p->{-c} * " if (-c).is_Symbol else f"p->{c} * "

    first = chains.first + len(chains.chain.names)
    return [
        (first + 2 * k, " + ".join(f"{factor(c)}step[{j}]" for j, c in d.turns.items()))
        for k, d in enumerate(chains.chain.directions)
        if d.turns
    ]


def _multipliers(model: Model, system: TreeSystem) -> list[str]:
    """Each closure's multiplier in those of the absolute rows."""
    place = {row.name: r for r, row in enumerate(model.rows)}
    return [
        " ".join(f"{'+' if sign > 0 else '-'} lambda[{place[name]}]" for name, sign in shares.items())
        for shares in (system.tree.multiplier(row.name) for row in system.rows)
    ]

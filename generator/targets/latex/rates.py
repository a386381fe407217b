"""γ as textbooks write it: by products of angular velocities.

A translational joint's is then θ̇_i² (…) + 2 θ̇_i u · (ṙ_j − ṙ_i) + …, as P. E. Nikravesh, Computer-Aided Analysis of
Mechanical Systems, Prentice Hall 1988, has it, there with the angular velocities of both bodies as one.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.targets.latex.notation import Notation

MOST = 1000  # operations of what is sorted


def gamma_of(row: Row, model: Model, notation: Notation) -> sp.Expr:
    """γ of a row as documents write it; a drive's as it follows."""
    value = notation.expand(row.gamma)
    return by_rates(value, model) if row.kind == "joint" else value


def by_rates(value: sp.Expr, model: Model) -> sp.Expr:
    """The same value; as it is where it is no polynomial in the rates, and where it would become longer."""
    turning = [body.v[2] for body in model.bodies]
    if not value.has(*turning) or sp.count_ops(value) > MOST or not value.is_polynomial(*model.v):
        return value
    parts: dict[sp.Expr, sp.Expr] = {}
    for term in sp.Add.make_args(sp.expand(value)):
        rest, product = term.as_independent(*turning, as_Add=False)
        parts[product] = parts.get(product, sp.Integer(0)) + rest
    found = sp.Add(*(product * min(_forms(rest, model), key=sp.count_ops) for product, rest in parts.items()))
    return min(found, value, key=sp.count_ops)


def _forms(rest: sp.Expr, model: Model) -> Iterator[sp.Expr]:
    """Without common factors; by the axes of a direction that turns with a body, or by a body's sine and cosine."""
    if not rest.is_Add:
        yield rest
        return
    yield sp.factor_terms(rest)
    turned = sorted((s for s in rest.free_symbols if s in model.geometry.turned), key=lambda s: s.name)
    axes = [s for s in turned if not model.geometry.turned[s].point]
    pairs = [[sp.cos(body.theta), sp.sin(body.theta)] for body in model.bodies if rest.has(sp.cos(body.theta))]
    for by in (axes, turned, *pairs):
        if by:
            yield sp.factor_terms(sp.collect(rest, by))

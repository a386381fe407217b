"""Affine forms: a constant and a sum of coefficients times variables."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

Affine = Mapping[str, sp.Expr]  # coefficients by coordinate; the constant is under ""
CONSTANT = ""


def substitute(affine: Affine, name: str, value: Affine) -> Affine:
    """`affine` with the coordinate `name` replaced by what it is."""
    if name not in affine:
        return affine
    out = {k: c for k, c in affine.items() if k != name}
    for k, c in value.items():
        out[k] = sp.expand(out.get(k, sp.Integer(0)) + affine[name] * c)
    return {k: c for k, c in out.items() if c != 0}

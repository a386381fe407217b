"""What formulas of a sheet show by a letter of its own, explained in an order in which it can be read."""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from gudgeon.generator.symbols.corners import Pick
from gudgeon.generator.targets.latex.document import Block, Equation, paragraph
from gudgeon.generator.targets.latex.letters import Name
from gudgeon.teaching.sheet import Subject


def letters_of(subject: Subject, expressions: Iterable[sp.Expr]) -> list[sp.Symbol]:
    """Kept symbols of expressions, what a definition reads in front of it; the alphabet decides between others."""
    notation, definitions, found = subject.notation, subject.model.symbols.definitions, list[sp.Symbol]()

    def add(expression: sp.Expr) -> None:
        for symbol in sorted(notation.expand(expression).free_symbols, key=lambda s: notation.math(s).text):
            if symbol in notation.kept and symbol in definitions and symbol not in found:
                add(definitions[symbol])
                found.append(symbol)

    for expression in expressions:
        add(expression)
    order = {symbol: k for k, symbol in enumerate(subject.model.symbols.definitions)}
    return sorted(found, key=order.__getitem__)


def abbreviations(subject: Subject, symbols: list[sp.Symbol]) -> list[Block]:
    """Their definitions; nothing for none."""
    found = [block for symbol in symbols for block in _defined(subject, symbol)]
    return [paragraph("With"), *found] if found else []


def _defined(subject: Subject, symbol: sp.Symbol) -> list[Block]:
    """One of them; of a drive that goes in steps by how far they are, from 0 to 1."""
    value = subject.notation.expand(subject.model.symbols.definitions[symbol])
    for driven in subject.model.constraints.drive_angles.values():
        if symbol in driven:
            told = _by_steps(subject, symbol, driven)
            return told or [subject.equation(symbol, value)]
    return [subject.equation(symbol, value)]


def _by_steps(subject: Subject, symbol: sp.Symbol, driven: tuple[sp.Symbol, ...]) -> list[Block]:
    """s for min(max(…, 0), 1), and rates while it is between; nothing for other drives."""
    notation, t = subject.notation, subject.model.t
    value = notation.expand(subject.model.symbols.definitions[driven[0]])
    shares = {found: share for found in value.atoms(sp.Max) if (share := _share(found)) is not None}
    taken = {name.text for name in notation.names.values()}
    base = next(sign for sign in ("s", "u", "w", "z") if not {sign, f"{sign}_1"} & taken)
    steps = {found: sp.Symbol(base if len(shares) == 1 else f"{base}_{k}") for k, found in enumerate(shares, 1)}
    inside = value.xreplace(steps)
    if not steps or inside.has(sp.Max, sp.Min, Pick):
        return []
    rates = {steps[found]: sp.diff(share, t) for found, share in shares.items()}
    for _ in range(driven.index(symbol)):
        inside = sp.Add(*(_rate(term, rates, t) for term in sp.Add.make_args(inside)))
    names = {s: Name(s.name if "_" not in s.name else f"{base}_{{{s.name[2:]}}}", s.name) for s in rates}
    own = notation.called(names)
    shown = [Equation(own.math(steps[found]), own.terms(share)) for found, share in shares.items()]
    still = ", and is still before and behind" if driven.index(symbol) else ", before it 0 and behind it 1"
    terms = own.terms(sp.Add(*(_sorted(term, list(rates)) for term in sp.Add.make_args(inside))))
    return [*shown, paragraph(f"which goes from 0 to 1{still}:"), Equation(own.math(symbol), terms)]


def _share(expression: sp.Max) -> sp.Expr | None:
    """u of min(max(u, 0), 1)."""
    inner = [x for x in expression.args if isinstance(x, sp.Min)]
    if len(expression.args) != 2 or sp.Integer(0) not in expression.args or len(inner) != 1:
        return None
    others = [x for x in inner[0].args if x != 1]
    return others[0] if len(inner[0].args) == 2 and len(others) == 1 else None


def _rate(term: sp.Expr, rates: dict[sp.Symbol, sp.Expr], t: sp.Symbol) -> sp.Expr:
    """By time, numbers in front."""
    factor, rest = term.as_independent(*rates, as_Add=False)
    own = (factor * rate * sp.expand(sp.diff(rest, s)) for s, rate in rates.items())
    return sp.Add(sp.diff(factor, t) * rest, *own)


def _sorted(term: sp.Expr, steps: list[sp.Symbol]) -> sp.Expr:
    """A factor times a polynomial of how far steps are."""
    factor, rest = term.as_independent(*steps, as_Add=False)
    return sp.Mul(factor, sp.expand(rest), evaluate=False) if rest != 1 else term

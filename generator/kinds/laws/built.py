"""What a law's `build` gives, looked at: the results of its role, made of what it was given and of what C can have.

A law alone is a function of arrays (`alone`).
"""

from __future__ import annotations

import hashlib
import itertools
import os
import sys
import uuid
from collections.abc import Callable, Iterable, Iterator, Mapping, Set
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.errors import LawError
from gudgeon.generator.kinds.laws.law import Law, LawInputs, PairSymbols
from gudgeon.generator.kinds.laws.registered import ORIGINS, message, place_in, prefix
from gudgeon.language.functions import IN_SYMPY

PAIR = tuple(PairSymbols.__annotations__)
_CHOICES = 64  # combinations of a law's options and numbers that are tried


@dataclass(frozen=True)
class Probe:
    """Contain a law in symbols of its own: its steps, and the expressions of its derived constants."""

    steps: Mapping[str, Any]
    derived: Mapping[str, Any]


def build(law: Law, inputs: LawInputs) -> dict[str, Any]:
    """Return a law's abbreviations and results in SymPy, in order. Raises LawError for names or symbols not allowed."""
    import sympy as sp

    for name in (*(own.name for own in law.parameters), *(state.name for state in law.states)):
        _need_name(law, name)
    given = {symbol for x in (*inputs.parameters.values(), *vars(inputs.pair).values()) for symbol in _symbols(x)}
    given -= {*inputs.variables.values()}
    written = frozenset(type(part) for x in inputs.parameters.values() for part in _parts(x))  # in the file: C has them

    def derive(name: Any, expression: Any, meaning: Any) -> Any:
        """Check a derived constant and return its symbol."""
        if not isinstance(name, str) or not isinstance(meaning, str):
            raise _error(law, f"derive({name!r}, …) wants a name, an expression and its meaning")
        _need_name(law, name)
        value = _value(law, f"derive({name!r}, …)", expression)
        _check(law, f"derive({name!r}, …)", value, given, "its parameters and the pair's numbers alone", written)
        made = inputs.derive(name, value, meaning)
        given.update(_symbols(made))
        return made

    try:
        with redirect_stdout(sys.stderr):
            steps = law.build(replace(inputs, derive=derive))
    except (LawError, KeyboardInterrupt):
        raise
    except BaseException as error:
        place = place_in(error, ORIGINS[law.name].typed) if law.name in ORIGINS else None
        hint = f"it is given {_offered(law)}" if isinstance(error, KeyError) else ""
        raise _error(law, f"build raised {message(error)}", hint, place) from error
    results = _checked_names(law, steps)
    found, known = {}, given | {symbol for x in inputs.variables.values() for symbol in _symbols(x)}
    used = {*law.variables, *(own.name for own in law.parameters)}
    for name, step in steps.items():
        _need_name(law, name)
        if name in used:
            raise _error(law, f"build returns {name!r}, which it is given", "call the abbreviation otherwise")
        found[name] = value = _value(law, name, step)
        _check(law, name, value, known, f"{_offered(law)}, and abbreviations returned before", written)
        if name not in results:
            known.add(sp.Symbol(name, real=True))
    return found


def probe(law: Law, options: Mapping[str, str | bool], numbers: Iterable[str]) -> Probe:
    """Build a law by itself, to find the names that it uses and to compute its key."""
    import sympy as sp

    derived: dict[str, Any] = {}

    def derive(name: str, expression: Any, meaning: str) -> Any:
        """Record a derived constant and return its symbol."""
        derived[name] = expression
        return _real(f"probe_{name}")

    inputs = LawInputs(
        {name: _real(f"probe_{name}") for name in numbers},
        options,
        PairSymbols(**{name: _real(f"probe_{name}") for name in PAIR}),
        {name: sp.Symbol(name, real=True) for name in law.variables},
        derive,
    )
    return Probe(build(law, inputs), derived)


def key_of_law(law: Law) -> str:
    """Return the key of a law without a file: its declaration and its equations for every choice of its options.

    The key differs in each process if there are too many choices or one of them fails: nothing is then cached.
    """
    import sympy as sp

    declared = (law.name, law.role, law.title, law.source, law.validity, law.fields, law.states, law.also, law.instead)
    digest = hashlib.sha256(repr(declared).encode())
    choices = list(itertools.islice(_choices(law), _CHOICES + 1))
    if len(choices) > _CHOICES:
        return f"{os.getpid()} {uuid.uuid4()}"
    for options, numbers in choices:
        try:
            made = probe(law, options, numbers)
        except LawError as error:
            digest.update(str(error).encode())
            continue
        for name, value in (*made.derived.items(), *made.steps.items()):
            digest.update(f"{name} = {sp.srepr(value)}\n".encode())
    return digest.hexdigest()


def _choices(law: Law) -> Iterator[tuple[dict[str, str | bool], tuple[str, ...]]]:
    """Yield every combination of a law's options and of its optional numbers."""
    needed = [own.name for own in law.parameters if own.required or own.default is not None]
    free = [own.name for own in law.parameters if own.name not in needed]
    names = [own.name for own in law.options]
    for values in itertools.product(*(own.values for own in law.options)):
        for some in itertools.product((True, False), repeat=len(free)):
            left = [name for name, there in zip(free, some, strict=True) if there]
            yield dict(zip(names, values, strict=True)), (*needed, *left)


def _checked_names(law: Law, steps: Any) -> frozenset[str]:
    """Return the results by name. Raises LawError if one of the role's results is missing."""
    results = law.results
    expected = f"expected {{{', '.join(f'{name!r}: …' for name in results)}}}"
    if not isinstance(steps, Mapping) or not all(isinstance(name, str) for name in steps):
        raise _error(law, f"build returns {type(steps).__name__}, not forces by name", expected)
    if missing := [name for name in results if name not in steps]:
        raise _error(law, f"build returns no {', '.join(missing)}", expected)
    return frozenset(results)


def _need_name(law: Law, name: str) -> None:
    """Raise LawError for a name that only the generator may use (symbols.py)."""
    if name.endswith("_"):
        hint = f"write {name.rstrip('_') or 'x'}; a number's `symbol` may be any letter"
        raise _error(law, f"{name!r} ends in '_', as names of emitted code do", hint)


def _value(law: Law, what: str, value: Any) -> Any:
    """Return a value as a SymPy expression. Raises LawError for other types."""
    import sympy as sp

    if isinstance(value, (bool, str)) or not isinstance(value, (sp.Expr, int, float)):
        raise _error(law, f"{what} is of type {type(value).__name__}", "expected a SymPy expression or a number")
    return sp.sympify(value)


def _check(law: Law, what: str, value: Any, known: set[Any], may: str, written: Set[type]) -> None:
    """Raise LawError for an unknown symbol, a function that C does not have, or a value not finite or not real."""
    import sympy as sp

    if strange := sorted(str(symbol) for symbol in value.free_symbols - known):
        named = strange[0] in {str(symbol) for symbol in known}
        hint = "an abbreviation is sp.Symbol(name, real=True)" if named else f"it may use {may}"
        raise _error(law, f"{what} uses the symbol {strange[0]}", hint)
    functions = tuple(getattr(sp, name) for name in IN_SYMPY)
    for part in sp.preorder_traversal(value):
        if part in (sp.nan, sp.zoo, sp.oo, -sp.oo, sp.I):
            why = "is not real" if part == sp.I else "is not finite"
            raise _error(law, f"{what} {why}: {sp.sstr(value)[:80]}", "expected a real number for every δ > 0")
        plain = part.is_Number or part.is_NumberSymbol or part.is_Symbol or part.is_Add or part.is_Mul or part.is_Pow
        together = type(part).__name__ == "Whole"  # what `whole` makes, in a room above
        if not plain and not together and not isinstance(part, functions) and type(part) not in written:
            hint = f"expected + - * / **, sqrt, {', '.join(IN_SYMPY)}"
            raise _error(law, f"{what} uses {type(part).__name__}, which C is not given", hint)


def _offered(law: Law) -> str:
    """Return a phrase that lists what `build` may use."""
    numbers = ", ".join(own.name for own in law.parameters) or "none"
    return f"variables: {', '.join(law.variables)}; parameters: {numbers}; pair: {', '.join(PAIR)}"


def _error(law: Law, message: str, hint: str = "", place: Any = None) -> LawError:
    """Return the LawError about a law, with its file and name."""
    named = prefix(law.name, None if place else ORIGINS.get(law.name))
    return LawError(f"{named}{message}", place, hint)


def _symbols(value: Any) -> set[Any]:
    """Return the free symbols of a value."""
    return set(getattr(value, "free_symbols", ()))


def _parts(value: Any) -> Iterable[Any]:
    """Return the parts of an expression that the file gives; nothing for a number."""
    import sympy as sp

    return sp.preorder_traversal(value) if isinstance(value, sp.Expr) else ()


def _real(name: str) -> Any:
    """Return a real symbol."""
    import sympy as sp

    return sp.Symbol(name, real=True)


Results = dict[str, NDArray[np.float64]]


def alone(
    law: Law, numbers: Mapping[str, Any], options: Mapping[str, str | bool], pair: Mapping[str, float]
) -> Callable[..., Results]:
    """Return a law by itself as a function of arrays: variables of its role, further ones, inner states.

    The function returns the law's results by name in SI units.
    numbers: by key, without optional ones that are left out; expressions of a variable as SymPy.
    pair: R_i, R_j, c, L, E_i, nu_i, E_j, nu_j. Further variables are arguments whether the law reads them or not.
    Raises LawError if the law cannot be computed.
    """
    import sympy as sp

    symbols = {name: sp.Symbol(name, real=True) for name in law.variables}
    given = LawInputs(
        {name: x if isinstance(x, sp.Expr) else sp.Float(x) for name, x in numbers.items()},
        options,
        PairSymbols(**{name: sp.Float(x) for name, x in pair.items()}),
        symbols,
        lambda _, expression, __: expression,
    )
    known, functions = list(symbols.values()), []
    for name, step in build(law, given).items():
        functions.append((name, sp.lambdify(known, step, "numpy")))
        known.append(sp.Symbol(name, real=True))

    def results(*state: ArrayLike) -> Results:
        """Return the law's results for arrays of its variables."""
        arrays = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in state))
        values, found = list(arrays), dict[str, Any]()
        for name, function in functions:
            try:
                found[name] = function(*values) + 0.0 * arrays[0]
            except (NameError, TypeError) as error:
                raise LawError(f"{law.role} law {law.name}: {name} cannot be computed here: {error}") from error
            values.append(found[name])
        return {name: found[name] for name in law.results}

    return results


def reads_besides(law: Law) -> int:
    """Return the number of further variables between those of the role and the inner states."""
    return len(law.further)

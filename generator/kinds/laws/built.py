"""Check what a law's function `build` returns: the forces of its role, in given symbols, as expressions for C.

`make_law_function` evaluates a law alone as a function of arrays.
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
from gudgeon.generator.kinds.laws.registered import ORIGINS, find_error_location, format_exception, format_law_prefix
from gudgeon.language.functions import IN_SYMPY

PAIR_QUANTITIES = tuple(PairSymbols.__annotations__)
_MAX_CHOICES = 64  # combinations of a law's options and numbers that are tried


@dataclass(frozen=True)
class Probe:
    """Contain a law in probe symbols: its equations and its derived constants, expressions by name."""

    equations_by_name: Mapping[str, Any]
    derived: Mapping[str, Any]


def build_law(law: Law, inputs: LawInputs) -> dict[str, Any]:
    """Return a law's abbreviations and results in SymPy, in order, after checks of what `law.build` returns.

    Prints of the law go to stderr. Raises LawError for an exception in the law, names or symbols that are not allowed,
    functions that C does not have, and missing results.
    """
    import sympy as sp

    for name in (*(field_of_law.name for field_of_law in law.parameters), *(state.name for state in law.states)):
        _check_name_not_reserved(law, name)
    constants = {
        symbol for x in (*inputs.parameters.values(), *vars(inputs.pair).values()) for symbol in _find_symbols(x)
    }
    constants -= {*inputs.variables.values()}
    types_from_file = frozenset(
        type(part) for x in inputs.parameters.values() for part in _iterate_subexpressions(x)
    )  # in the file: C has them

    def derive(name: Any, expression: Any, meaning: Any) -> Any:
        """Check a derived constant and return its symbol, which later expressions may use. Raises LawError."""
        if not isinstance(name, str) or not isinstance(meaning, str):
            raise _make_law_error(law, f"derive({name!r}, …) needs a name, an expression and its meaning")
        _check_name_not_reserved(law, name)
        value = _convert_to_sympy(law, f"derive({name!r}, …)", expression)
        _check_expression(
            law,
            f"derive({name!r}, …)",
            value,
            constants,
            "the law's parameters and the pair's numbers only",
            types_from_file,
        )
        symbol = inputs.derive(name, value, meaning)
        constants.update(_find_symbols(symbol))
        return symbol

    try:
        with redirect_stdout(sys.stderr):
            equations_by_name = law.build(replace(inputs, derive=derive))
    except (LawError, KeyboardInterrupt):
        raise
    except BaseException as error:
        location = find_error_location(error, ORIGINS[law.name].display_path) if law.name in ORIGINS else None
        hint = f"build gets {_list_inputs_of_law(law)}" if isinstance(error, KeyError) else ""
        raise _make_law_error(law, f"build raised {format_exception(error)}", hint, location) from error
    results = _find_result_names(law, equations_by_name)
    expressions, known_symbols = (
        {},
        constants | {symbol for x in inputs.variables.values() for symbol in _find_symbols(x)},
    )
    reserved_names = {*law.variables, *(field_of_law.name for field_of_law in law.parameters)}
    for name, step in equations_by_name.items():
        _check_name_not_reserved(law, name)
        if name in reserved_names:
            raise _make_law_error(
                law, f"build returns {name!r}, which is an input", "choose another name for the abbreviation"
            )
        expressions[name] = value = _convert_to_sympy(law, name, step)
        _check_expression(
            law,
            name,
            value,
            known_symbols,
            f"{_list_inputs_of_law(law)}, and abbreviations returned before",
            types_from_file,
        )
        if name not in results:
            known_symbols.add(sp.Symbol(name, real=True))
    return expressions


def probe_law(law: Law, options: Mapping[str, str | bool], parameter_names: Iterable[str]) -> Probe:
    """Return a law's equations and derived constants by name, with a symbol `probe_<name>` for each of its parameters.

    `parameter_names` are the keys of the parameters that get a symbol; the others count as left out. Variables have
    symbols of their own names. Raises LawError as `build_law` does.
    """
    import sympy as sp

    derived: dict[str, Any] = {}

    def derive(name: str, expression: Any, meaning: str) -> Any:
        """Record a derived constant and return its symbol."""
        derived[name] = expression
        return _make_real_symbol(f"probe_{name}")

    inputs = LawInputs(
        {name: _make_real_symbol(f"probe_{name}") for name in parameter_names},
        options,
        PairSymbols(**{name: _make_real_symbol(f"probe_{name}") for name in PAIR_QUANTITIES}),
        {name: sp.Symbol(name, real=True) for name in law.variables},
        derive,
    )
    return Probe(build_law(law, inputs), derived)


def compute_law_key(law: Law) -> str:
    """Return the key of a law without a file, from its declaration and its equations for every choice of its options.

    It is a SHA-256 in hexadecimal digits. If `build` fails for a choice, its message is hashed instead. With more than
    `_MAX_CHOICES` choices the key is random, so that nothing is cached.
    """
    import sympy as sp

    declaration = (
        law.name,
        law.role,
        law.title,
        law.source,
        law.validity,
        law.properties,
        law.fields,
        law.states,
        law.also,
        law.instead,
    )
    digest = hashlib.sha256(repr(declaration).encode())
    choices = list(itertools.islice(_iterate_option_choices(law), _MAX_CHOICES + 1))
    if len(choices) > _MAX_CHOICES:
        return f"{os.getpid()} {uuid.uuid4()}"
    for options, parameter_names in choices:
        try:
            probed_law = probe_law(law, options, parameter_names)
        except LawError as error:
            digest.update(str(error).encode())
            continue
        for name, value in (*probed_law.derived.items(), *probed_law.equations_by_name.items()):
            digest.update(f"{name} = {sp.srepr(value)}\n".encode())
    return digest.hexdigest()


def _iterate_option_choices(law: Law) -> Iterator[tuple[dict[str, str | bool], tuple[str, ...]]]:
    """Yield every choice of a law: the values of its options by name, and the names of the given parameters.

    Every combination of options occurs with every subset of the optional parameters. Required parameters, and those
    with a default, are given in every choice.
    """
    required_names = [
        field_of_law.name
        for field_of_law in law.parameters
        if field_of_law.required or field_of_law.default is not None
    ]
    optional_names = [field_of_law.name for field_of_law in law.parameters if field_of_law.name not in required_names]
    names = [field_of_law.name for field_of_law in law.options]
    for values in itertools.product(*(field_of_law.values for field_of_law in law.options)):
        for is_given in itertools.product((True, False), repeat=len(optional_names)):
            given_names = [name for name, is_in_choice in zip(optional_names, is_given, strict=True) if is_in_choice]
            yield dict(zip(names, values, strict=True)), (*required_names, *given_names)


def _find_result_names(law: Law, equations_by_name: Any) -> frozenset[str]:
    """Return the names of a law's results.

    Raises LawError if `equations_by_name` is not a mapping with texts as keys, or lacks a result.
    """
    results = law.results
    hint = f"expected {{{', '.join(f'{name!r}: …' for name in results)}}}"
    if not isinstance(equations_by_name, Mapping) or not all(isinstance(name, str) for name in equations_by_name):
        raise _make_law_error(law, f"build returns {type(equations_by_name).__name__}, not forces by name", hint)
    if missing_results := [name for name in results if name not in equations_by_name]:
        raise _make_law_error(law, f"build returns no {', '.join(missing_results)}", hint)
    return frozenset(results)


def _check_name_not_reserved(law: Law, name: str) -> None:
    """Raise LawError if `name`, any name that `law` defines, ends in '_': such names are the generator's."""
    if name.endswith("_"):
        hint = f"write {name.rstrip('_') or 'x'}; a number's `symbol` may be any letter"
        raise _make_law_error(law, f"{name!r} ends in '_', as names of emitted code do", hint)


def _convert_to_sympy(law: Law, label: str, value: Any) -> Any:
    """Return a SymPy expression or a number as a SymPy expression; `label` names it in messages.

    Raises LawError for other types, also for bool and str.
    """
    import sympy as sp

    if isinstance(value, (bool, str)) or not isinstance(value, (sp.Expr, int, float)):
        raise _make_law_error(
            law, f"{label} is of type {type(value).__name__}", "expected a SymPy expression or a number"
        )
    return sp.sympify(value)


def _check_expression(
    law: Law, label: str, value: Any, known_symbols: set[Any], allowed_text: str, types_from_file: Set[type]
) -> None:
    """Raise LawError for an unknown symbol, a function that C does not have, or a value not finite or not real.

    known_symbols: symbols that may occur, which `allowed_text` lists in messages; types_from_file: types of the file's
    expressions, which C has; label: the value's name in messages.
    """
    import sympy as sp

    if unknown_symbols := sorted(str(symbol) for symbol in value.free_symbols - known_symbols):
        is_known_name = unknown_symbols[0] in {str(symbol) for symbol in known_symbols}
        hint = "an abbreviation is sp.Symbol(name, real=True)" if is_known_name else f"{label} may use {allowed_text}"
        raise _make_law_error(law, f"{label} uses the symbol {unknown_symbols[0]}", hint)
    functions = tuple(getattr(sp, name) for name in IN_SYMPY)
    for part in sp.preorder_traversal(value):
        if part in (sp.nan, sp.zoo, sp.oo, -sp.oo, sp.I):
            fault = "is not real" if part == sp.I else "is not finite"
            raise _make_law_error(
                law, f"{label} {fault}: {sp.sstr(value)[:80]}", "expected a real number for every δ > 0"
            )
        is_basic = part.is_Number or part.is_NumberSymbol or part.is_Symbol or part.is_Add or part.is_Mul or part.is_Pow
        is_unevaluated = type(part).__name__ == "Unevaluated"  # created by `keep_unevaluated` in a layer above
        if (
            not is_basic
            and not is_unevaluated
            and not isinstance(part, functions)
            and type(part) not in types_from_file
        ):
            hint = f"expected + - * / **, sqrt, {', '.join(IN_SYMPY)}"
            raise _make_law_error(law, f"{label} uses {type(part).__name__}, which has no counterpart in C", hint)


def _list_inputs_of_law(law: Law) -> str:
    """Return a phrase that lists what `build` may use: variables, parameters and the pair."""
    numbers = ", ".join(field_of_law.name for field_of_law in law.parameters) or "none"
    return f"variables: {', '.join(law.variables)}; parameters: {numbers}; pair: {', '.join(PAIR_QUANTITIES)}"


def _make_law_error(law: Law, message: str, hint: str = "", location: Any = None) -> LawError:
    """Return the LawError about a law, with its file and name before the message.

    `location` is a location in the file or None.
    """
    prefix_of_message = format_law_prefix(law.name, None if location else ORIGINS.get(law.name))
    return LawError(f"{prefix_of_message}{message}", location, hint)


def _find_symbols(value: Any) -> set[Any]:
    """Return the free symbols of a value; the empty set for a number."""
    return set(getattr(value, "free_symbols", ()))


def _iterate_subexpressions(value: Any) -> Iterable[Any]:
    """Yield the nodes of a SymPy expression in preorder; nothing for a number."""
    import sympy as sp

    return sp.preorder_traversal(value) if isinstance(value, sp.Expr) else ()


def _make_real_symbol(name: str) -> Any:
    """Return a real SymPy symbol."""
    import sympy as sp

    return sp.Symbol(name, real=True)


Results = dict[str, NDArray[np.float64]]


def make_law_function(
    law: Law, parameter_values: Mapping[str, Any], options: Mapping[str, str | bool], pair_values: Mapping[str, float]
) -> Callable[..., Results]:
    """Return a law by itself as a function of arrays: variables of its role, further ones, internal states.

    The function returns the law's results by name in SI units. parameter_values: by key, without optional ones that are
    left out; expressions of a variable as SymPy. pair_values: R_i, R_j, c, L, E_i, nu_i, E_j, nu_j. Further variables
    are arguments whether the law reads them or not. Raises LawError if the law cannot be computed.
    """
    import sympy as sp

    symbols = {name: sp.Symbol(name, real=True) for name in law.variables}
    inputs = LawInputs(
        {name: x if isinstance(x, sp.Expr) else sp.Float(x) for name, x in parameter_values.items()},
        options,
        PairSymbols(**{name: sp.Float(x) for name, x in pair_values.items()}),
        symbols,
        lambda _, expression, __: expression,
    )
    arguments, functions = list(symbols.values()), []
    for name, step in build_law(law, inputs).items():
        functions.append((name, sp.lambdify(arguments, step, "numpy")))
        arguments.append(sp.Symbol(name, real=True))

    def compute_results(*variables: ArrayLike) -> Results:
        """Return the law's results by name for arrays of its variables, which are broadcast to one shape.

        Raises LawError if a result cannot be computed.
        """
        arrays = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in variables))
        values, results_by_name = list(arrays), dict[str, Any]()
        for name, function in functions:
            try:
                results_by_name[name] = function(*values) + 0.0 * arrays[0]
            except (NameError, TypeError) as error:
                raise LawError(f"{law.role} law {law.name}: {name} cannot be computed: {error}") from error
            values.append(results_by_name[name])
        return {name: results_by_name[name] for name in law.results}

    return compute_results


def count_optional_variables(law: Law) -> int:
    """Return the number of variables outside the role, which lie between those of the role and internal states."""
    return len(law.optional_variables)

"""Handle choices of a run by name, such as materials: parameters whose values are indices into lists of words.

The address of a choice, "bearings.pin.journal_material", begins the addresses of the values that depend on it. These
are the values of the chosen material in this run ("materials.bronze.E"), unless they are given themselves. They are
filled in before C reads them, so that nothing is derived or compiled again.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import shorten_value
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.tree import from_json, iterate_names
from gudgeon.model.cached_values import cache_by_values

Array: TypeAlias = NDArray[Any]

SCENE_CHOICE = "the scene's is"  # phrase in notes on choices


def find_word_index(value: Any, parameter: RuntimeParameter) -> float:
    """Return the value of a parameter that has words: the index of a word, without spaces around it, as a float.

    Raises UnknownNameError for another word, BadValueError for a value that is not a text.
    """
    if not isinstance(value, str):
        raise BadValueError(
            f"{parameter.address} is {shorten_value(value)}: expected one of: {', '.join(parameter.words)}"
        )
    if value.strip() not in parameter.words:
        raise make_unknown_name_error(f"choice of {parameter.address}", value.strip(), parameter.words, None)
    return float(parameter.words.index(value.strip()))


def explain_law_choice(source: KernelSource, address: str) -> tuple[str, str]:
    """Return (message, hint) for the address of a contact's law or of an option of a law; ("", "") for others.

    Laws and their options select compiled equations, so that a run cannot set them.
    """
    from gudgeon.generator.kinds.laws.law import find_laws_of_role  # imports no SymPy

    section_name, name, role, key = [*address.split("."), "", "", "", ""][:4]
    contact = f"{section_name}.{name}."
    if section_name != "contacts" or not any(parameter.address.startswith(contact) for parameter in source.parameters):
        return "", ""
    if key not in ("law", *(option.name for law in find_laws_of_role(role).values() for option in law.options)):
        return "", ""
    return f"{address} selects compiled equations: it is not a parameter that can be set", (
        f"write a second contact, other: {{extends: {name}, {role}: {{{key}: …}}}}, and a scene with it, or a study's"
        f' choices; in Python gudgeon.load(…, overrides={{"{address}": "…"}})'
    )


def explain_named_expression(source: KernelSource, address: str) -> tuple[str, str]:
    """Return (message, hint) for the address of a named expression of the file, which is compiled; ("", "") for others.

    The hint names the parameters on which the expression depends.
    """
    full_address = f"expressions.{address.removeprefix('expressions.')}"
    expression = next(
        (expression for expression in source.named_expressions if expression.address == full_address), None
    )
    if expression is None:
        return "", ""
    names_in_expression = dict.fromkeys(name.path for name in iterate_names(from_json(json.loads(expression.tree))))
    parameter_addresses = {parameter.address for parameter in source.parameters}
    parameters_in_expression = ", ".join(
        name for name in names_in_expression if f"parameters.{name}" in parameter_addresses
    )
    return f"{full_address} is a compiled expression: it is not a parameter that can be set", (
        (f"set its parameters: {parameters_in_expression}; " if parameters_in_expression else "")
        + "overrides= of gudgeon.load compiles another expression"
    )


def format_parameter(parameter: RuntimeParameter, value: float) -> float | str:
    """Return a parameter's value as users write it: the word of a choice ("bronze"), else the number.

    Raises ValueError for an index without a word.
    """
    if not parameter.words:
        return float(value)
    if value not in range(len(parameter.words)):
        raise ValueError(f"{parameter.address} is {value!r}: expected an index from 0 to {len(parameter.words) - 1}")
    return parameter.words[int(value)]


def format_values_of_runs(parameter: RuntimeParameter, values: Array) -> Any:
    """Return the values (n,) of a parameter in n runs: a copy of the numbers, or an array of the words of a choice."""
    return (
        np.array([format_parameter(parameter, x) for x in values.tolist()], dtype=object)
        if parameter.words
        else values.copy()
    )


@cache_by_values
def find_choices(source: KernelSource) -> tuple[int, ...]:
    """Return the indices of the parameters that are choices: those with words."""
    return tuple(k for k, parameter in enumerate(source.parameters) if parameter.words)


def fill_in_chosen_values(
    source: KernelSource, choice_indices: Iterable[int], given_values: Array, is_given: Array, p: Array
) -> tuple[Any, Any]:
    """Return copies of values and mask (n_parameters,) with the values that depend on the choices `choice_indices`.

    These values are those of the chosen materials in p, unless they are given themselves: E of "bronze" for
    bearings.pin.journal_material.E.
    """
    index_by_address = {parameter.address: k for k, parameter in enumerate(source.parameters)}
    values, mask = given_values.copy(), is_given.copy()
    for k in choice_indices:
        material, prefix = (
            format_parameter(source.parameters[k], float(given_values[k])),
            f"{source.parameters[k].address}.",
        )
        for address, dependent in index_by_address.items():
            if address.startswith(prefix) and not is_given[dependent]:
                values[dependent], mask[dependent] = (
                    p[index_by_address[f"materials.{material}.{address.removeprefix(prefix)}"]],
                    True,
                )
    return values, mask


def make_choice_notes(source: KernelSource, given_values: Array, is_given: Array) -> tuple[str, ...]:
    """Return a note for each choice of a run that differs from its scene's: "x.material is steel (the scene's is tin)".

    given_values, is_given: values and mask (n_parameters,).
    """
    notes = []
    for k in find_choices(source):
        parameter = source.parameters[k]
        if is_given[k] and given_values[k] != parameter.default:
            word, scene_word = (
                format_parameter(parameter, float(given_values[k])),
                format_parameter(parameter, parameter.default),
            )
            notes.append(f"{parameter.address} is {word} ({SCENE_CHOICE} {scene_word})")
    return tuple(notes)


def is_choice_note(text: str) -> bool:
    """Return whether a note is one of `make_choice_notes`."""
    return f" ({SCENE_CHOICE} " in text

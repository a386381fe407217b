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

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import message
from gudgeon.language.names import unknown_name
from gudgeon.language.tree import from_json, names

Array: TypeAlias = NDArray[Any]

OTHERWISE = "the scene's is"  # phrase in notes on choices


def index_of_word(value: Any, slot: Slot) -> float:
    """Return the value of a parameter that has words: the index of a word. Raise UnknownNameError, BadValueError."""
    if not isinstance(value, str):
        raise BadValueError(f"{slot.address} is {message(value)}: expected one of: {', '.join(slot.words)}")
    if value.strip() not in slot.words:
        raise unknown_name(f"choice of {slot.address}", value.strip(), slot.words, None)
    return float(slot.words.index(value.strip()))


def explain_law_choice(source: KernelSource, address: str) -> tuple[str, str]:
    """Return message and hint for the address of a contact's law or its options, which are compiled; else ""."""
    from gudgeon.generator.kinds.laws.law import called  # imports no SymPy

    section, name, role, key = [*address.split("."), "", "", "", ""][:4]
    contact = f"{section}.{name}."
    if section != "contacts" or not any(slot.address.startswith(contact) for slot in source.slots):
        return "", ""
    if key not in ("law", *(option.name for law in called(role).values() for option in law.options)):
        return "", ""
    return f"{address} is a choice that C is made of, and no number that can be set", (
        f"write a second contact, other: {{extends: {name}, {role}: {{{key}: …}}}}, and a scene with it, or a study's"
        f' choices; in Python gudgeon.load(…, overrides={{"{address}": "…"}})'
    )


def explain_named_expression(source: KernelSource, address: str) -> tuple[str, str]:
    """Return message and hint for the address of a named expression of the file, which is compiled; else ""."""
    whole = f"expressions.{address.removeprefix('expressions.')}"
    one = next((one for one in source.expressions if one.address == whole), None)
    if one is None:
        return "", ""
    used = dict.fromkeys(name.path for name in names(from_json(json.loads(one.tree))))
    known = {slot.address for slot in source.slots}
    own = ", ".join(name for name in used if f"parameters.{name}" in known)
    return f"{whole} is an expression, compiled as it stands: it is no number that can be set", (
        (f"set what it is made of: {own}; " if own else "")
        + "overrides= of gudgeon.load compiles anew with another expression"
    )


def specified(slot: Slot, value: float) -> float | str:
    """Return a parameter's value as users see it: its word, or the number. Raise ValueError for an invalid index."""
    if not slot.words:
        return float(value)
    if value not in range(len(slot.words)):
        raise ValueError(f"{slot.address} is {value!r}, the place of no word")
    return slot.words[int(value)]


def of_runs(slot: Slot, values: Array) -> Any:
    """Return the values of a parameter in n runs, (n,): numbers, or words."""
    return np.array([specified(slot, x) for x in values.tolist()], dtype=object) if slot.words else values.copy()


def choices(source: KernelSource) -> tuple[int, ...]:
    """Return the indices of the parameters that are choices."""
    return tuple(k for k, slot in enumerate(source.slots) if slot.words)


def filled_in(
    source: KernelSource, selected: Iterable[int], given: Array, is_given: Array, p: Array
) -> tuple[Any, Any]:
    """Return values and mask (n_slots,) with the values that depend on the `selected` parameters, taken from p."""
    place = {slot.address: k for k, slot in enumerate(source.slots)}
    values, mask = given.copy(), is_given.copy()
    for k in selected:
        name, start = specified(source.slots[k], float(given[k])), f"{source.slots[k].address}."
        for address, own in place.items():
            if address.startswith(start) and not is_given[own]:
                values[own], mask[own] = p[place[f"materials.{name}.{address.removeprefix(start)}"]], True
    return values, mask


def choice_notes(source: KernelSource, given: Array, is_given: Array) -> tuple[str, ...]:
    """Return a note for each choice of a run that differs from its scene's."""
    return tuple(
        f"{slot.address} is {specified(slot, float(given[k]))} ({OTHERWISE} {specified(slot, slot.default)})"
        for k, slot in ((k, source.slots[k]) for k in np.flatnonzero(is_given).tolist())
        if slot.words and given[k] != slot.default
    )


def is_choice_note(text: str) -> bool:
    """Return whether a note is about a choice."""
    return f" ({OTHERWISE} " in text

"""Choices of a run by name, materials of bearings and of bodies' shapes: slots whose numbers are places of words.

What a choice is called, "bearings.pin.journal_material", begins the addresses of the numbers that follow it: those of
the chosen material, as the run has them ("materials.bronze.E"), unless they are given themselves. They are filled in
before C sees them, so that nothing is derived or compiled anew.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError
from gudgeon.language.names import unknown_name
from gudgeon.language.tree import from_json, names
from gudgeon.language.wanted import told

Array: TypeAlias = NDArray[Any]

OTHERWISE = "the scene's is"  # in remarks on what is chosen


def place_of_word(value: Any, slot: Slot) -> float:
    """The number of a slot that has words. Raises UnknownNameError with the nearest, BadValueError for no name."""
    if not isinstance(value, str):
        raise BadValueError(f"{slot.address} is {told(value)}: expected one of: {', '.join(slot.words)}")
    if value.strip() not in slot.words:
        raise unknown_name(f"choice of {slot.address}", value.strip(), slot.words, None)
    return float(slot.words.index(value.strip()))


def choice_of_a_law(source: KernelSource, address: str) -> tuple[str, str]:
    """(message, hint) about the address of a contact's law or of one of its options, which C is made of; else ""."""
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


def expression_by_name(source: KernelSource, address: str) -> tuple[str, str]:
    """The same of an expression that the file has by name."""
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


def said(slot: Slot, value: float) -> float | str:
    """What a slot's number is to be called: the word that it stands for, or itself. ValueError for no word's place."""
    if not slot.words:
        return float(value)
    if value not in range(len(slot.words)):
        raise ValueError(f"{slot.address} is {value!r}, the place of no word")
    return slot.words[int(value)]


def of_runs(slot: Slot, values: Array) -> Any:
    """Values of many runs, (n,): numbers, or texts."""
    return np.array([said(slot, x) for x in values.tolist()], dtype=object) if slot.words else values.copy()


def choices(source: KernelSource) -> tuple[int, ...]:
    """Which slots are choices."""
    return tuple(k for k, slot in enumerate(source.slots) if slot.words)


def filled_in(source: KernelSource, chosen: Iterable[int], given: Array, is_given: Array, p: Array) -> tuple[Any, Any]:
    """Values and mask, (n_slots,) each, with the numbers of what is chosen, as they are in p."""
    place = {slot.address: k for k, slot in enumerate(source.slots)}
    values, mask = given.copy(), is_given.copy()
    for k in chosen:
        name, start = said(source.slots[k], float(given[k])), f"{source.slots[k].address}."
        for address, own in place.items():
            if address.startswith(start) and not is_given[own]:
                values[own], mask[own] = p[place[f"materials.{name}.{address.removeprefix(start)}"]], True
    return values, mask


def told_choices(source: KernelSource, given: Array, is_given: Array) -> tuple[str, ...]:
    """A remark on what a run chooses otherwise than its scene does."""
    return tuple(
        f"{slot.address} is {said(slot, float(given[k]))} ({OTHERWISE} {said(slot, slot.default)})"
        for k, slot in ((k, source.slots[k]) for k in np.flatnonzero(is_given).tolist())
        if slot.words and given[k] != slot.default
    )


def tells_choice(text: str) -> bool:
    """Whether a remark is one of these."""
    return f" ({OTHERWISE} " in text

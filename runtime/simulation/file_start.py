"""Assemble the start that a mechanism file describes, once for equal parameter values, and check it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.guess_warnings import find_guess_deviations
from gudgeon.assembly.journals import check_journal_positions, describe_contacts_with_assumed_approach_speed
from gudgeon.assembly.rank import check_redundant_equations
from gudgeon.assembly.start import Start, assemble_start
from gudgeon.model.cached_values import cache_by_values, cache_selected_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import find_size_parameters


@dataclass(frozen=True)
class FileStart:
    """Hold the start that the file describes for some parameter values, at t = 0."""

    q: Array  # (n,)
    v: Array
    memory: Array  # (n_discrete_states,) discrete states: no contact, unknown modes
    guess_deviations: Mapping[str, float]  # as of find_guess_deviations
    notes: tuple[str, ...]  # on contacts without an onset


@cache_by_values
def assemble_file_start(compiled: CompiledModel, p: Array) -> FileStart:
    """Return the start that the file describes, cached for equal parameter values; callers must not change it.

    Notes name contacts that are closed without an onset. Raises AssemblyError if the linkage does not close, if a
    journal lies outside its bearing, or if an equation that was redundant is not with these values.
    """
    check_journal_positions(compiled, p)
    start, deviations = _assemble_cached_start(compiled, p)
    no_contacts, source = np.full(compiled.n_discrete_states, np.nan), compiled.source
    # a journal without a start position in the file begins in the centre of its bearing
    may_touch = bool(source.eccentricity_equations) or any(joint.is_corner for joint in source.clearances)
    check_redundant_equations(compiled, p, 0.0, start.q)
    notes = (
        describe_contacts_with_assumed_approach_speed(compiled, p, 0.0, start.q, start.v, no_contacts)
        if may_touch
        else ()
    )
    return FileStart(start.q, start.v, no_contacts, deviations, notes)


def _select_start_values(compiled: CompiledModel, p: Array) -> tuple[Array]:
    """Return the values that the assembly reads, which are the key of closed starts."""
    return (p.take(_find_start_indices(compiled)),)


@cache_selected_values(_select_start_values)
def _assemble_cached_start(compiled: CompiledModel, p: Array) -> tuple[Start, Mapping[str, float]]:
    """Return the assembled start and its deviations from guesses, cached for equal values of those that both read.

    Raises AssemblyError.
    """
    start = assemble_start(compiled, p)
    return start, find_guess_deviations(compiled, p, start.q)


@cache_by_values
def _find_start_indices(compiled: CompiledModel) -> NDArray[np.intp]:
    """Return the indices of the parameter values that the assembly of the start reads.

    C compares the values that its functions read, one after the other here. Guesses of points read others too: then,
    and in kinematic scenes, the indices are those of all values.
    """
    source, values = compiled.source, np.zeros(compiled.n_p)
    if source.methods == ("kinematic",) or any(name.count(".") > 1 for name in source.start_guess):
        return np.arange(compiled.n_p)
    other, indices = values.copy(), {*find_size_parameters(source).tolist()}
    pointers = compiled.pointer(values), compiled.pointer(other)
    for k in range(compiled.n_p):
        other[k] = 1.0
        if not compiled.lib.gudgeon_has_equal_start(*pointers):
            indices.add(k)
        other[k] = 0.0
    return np.array(sorted(indices), np.intp)

"""Assemble the start that a mechanism file describes, once for equal parameter values, and check it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gudgeon.assembly.guess_warnings import find_guess_deviations
from gudgeon.assembly.journals import describe_contacts_without_onset
from gudgeon.assembly.rank import check_redundant_equations
from gudgeon.assembly.start import assemble_start
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.simulation.audit import compute_allowed_start_error


@dataclass(frozen=True)
class FileStart:
    """Hold the start that the file describes for some parameter values, at t = 0."""

    q: Array  # (n,)
    v: Array
    memory: Array  # (n_memory,) discrete states: no contact, unknown modes
    guess_deviations: Mapping[str, float]  # as of find_guess_deviations
    notes: tuple[str, ...]  # on contacts without an onset
    allowed_error: Array  # (2, n) differences of the first sample from q and v up to which its audit passes


@cache_by_values
def assemble_file_start(compiled: CompiledModel, p: Array) -> FileStart:
    """Return the start that the file describes, cached for equal parameter values; callers must not change it.

    Raises AssemblyError if the linkage does not close, or if an equation that was redundant is not with these values.
    """
    start, no_contacts, source = assemble_start(compiled, p), np.full(compiled.n_memory, np.nan), compiled.source
    # a journal without a start position in the file begins in the centre of its bearing
    may_touch = bool(source.start_apart) or any(joint.is_corner for joint in source.clearances)
    check_redundant_equations(compiled, p, 0.0, start.q)
    return FileStart(
        start.q,
        start.v,
        no_contacts,
        find_guess_deviations(compiled, p, start.q),
        describe_contacts_without_onset(compiled, p, 0.0, start.q, start.v, no_contacts) if may_touch else (),
        compute_allowed_start_error(compiled.source, p, start.q, start.v),
    )

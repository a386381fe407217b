"""Aggregate the notes (warnings) of a study's runs: each kind once, with the number of runs and an example."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gudgeon.assembly.guess_warnings import (
    COLLECTED_GUESS_DEVIATIONS,
    LISTED,
    describe_missing_assembly,
    format_guess_difference,
)
from gudgeon.model.choices import is_choice_note

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gudgeon.contract.kernel_source import KernelSource

# numbers, but not the digits of a name or of a unit: S9, m/s^2, 1/s
_NUMBER = re.compile(r"(?<![\w.^])(?<!\^-)(?!1/[^\W\d_])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_WITH = re.compile(r" with [\w.]+ = [^:]*(?=:)")  # parameter values of one run
MAX_NOTES = 50  # kinds of notes that are reported


@dataclass(frozen=True)
class Note:
    """A kind of note: number of runs that have it, index of the first of them in the study, and its text there."""

    runs: int
    run: int
    text: str


def get_message_kind(message: str) -> str:
    """Return the kind of a message, the key by which equal messages of many runs are grouped.

    It is the first line, with "…" for numbers, without parameter values, and at most 200 characters long.
    """
    return _NUMBER.sub("…", _WITH.sub("", message.partition("\n")[0]))[:200]


def group_notes(texts_by_run: Iterable[tuple[int, Sequence[str]]]) -> dict[str, Note]:
    """Return the notes by kind, from pairs (run, texts): number of runs, and the first run with its text.

    Notes on choices by name are left out, since the coordinates of the dataset have them. A run that has two notes of
    one kind counts twice.
    """
    noted = ((run, text) for run, texts in texts_by_run for text in texts if not is_choice_note(text))
    return merge_notes({get_message_kind(text): Note(1, run, text)} for run, text in noted)


def merge_notes(note_tables: Iterable[Mapping[str, Note]]) -> dict[str, Note]:
    """Return the notes of several groups of runs as one table by kind: counts add up, the first run is the example."""
    merged_notes: dict[str, Note] = {}
    for kind, note in (kind_and_note for table in note_tables for kind_and_note in table.items()):
        before = merged_notes.get(kind)
        first = note if before is None or note.run < before.run else before
        merged_notes[kind] = Note(note.runs + (before.runs if before else 0), first.run, first.text)
    return merged_notes


@contextmanager
def collect_start_deviation_warnings(source: KernelSource, first_run: int) -> Iterator[dict[str, Note]]:
    """Collect the warnings about assembled starts that deviate from their guesses, in place of a warning for each
    block.

    The value of the context is an empty table, which is filled at the end of the context: a note for each coordinate.
    first_run: index of the first run of the block, which is the example of the notes.
    """
    deviations_by_run: list[Mapping[str, float]] = []
    notes: dict[str, Note] = {}
    token = COLLECTED_GUESS_DEVIATIONS.set(deviations_by_run)
    try:
        yield notes
    finally:
        COLLECTED_GUESS_DEVIATIONS.reset(token)
    for name in dict.fromkeys(name for deviation_by_name in deviations_by_run for name in deviation_by_name):
        deviations = [deviation_by_name[name] for deviation_by_name in deviations_by_run if name in deviation_by_name]
        text = (
            f"{name} begins {format_guess_difference(name, deviations[0])} from its guess: "
            f"{describe_missing_assembly(source)}; {LISTED}"
        )
        notes[get_message_kind(text)] = Note(len(deviations), first_run, text)

"""Tokens by which parts of a document belong together: what shares one is lit together (light.js)."""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance


def row_token(number: int) -> str:
    """Of a row of Φ, from 1; it stands for the row's entries too (light.js)."""
    return f"row-{number}"


def entry_token(row: int, column: int) -> str:
    """Of an entry of Φ_q, from 1."""
    return f"entry-{row}-{column}"


def sum_token(row: int) -> str:
    """Of the line of C that sums a row of Φ, from 1: lit with each of the row's terms (light.js)."""
    return f"sum-{row}"


def owner_token(row: Row) -> str:
    """Of the joint or drive that a row belongs to."""
    return f"{row.kind}-{row.owner}"


def entries_of(model: Model, number: int, row: Row) -> Iterator[str]:
    """Tokens of a row's entries of Φ_q."""
    place = {q: k for k, q in enumerate(model.q, 1)}
    return (entry_token(number, place[q]) for q in row.phi_q)


def joint_tokens(clearance: Clearance) -> list[str]:
    """What lights up with it: the joint, and of a slider's corner that alone."""
    return [*dict.fromkeys((f"joint-{clearance.label}", f"joint-{clearance.joint.name}"))]

"""Rows of a trace as the time loop writes them: of each joint with play the extremes over so many steps in a row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from gudgeon.contract.boundary import N_TRACE_COLUMNS, TRACE_COLUMN_NAMES

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array

ROWS = 4096  # even; a picture has fewer columns
JOINT = {
    "F_low": ("N", "least force since the row before"), "t_F_low": ("s", "its time"),
    "F_high": ("N", "largest force since the row before"), "t_F_high": ("s", "its time"),
    "ex_out": ("m", "where the journal was furthest out since the row before, x"), "ey_out": ("m", "the same, y"),
    "t_out": ("s", "time of that"), "ex": ("m", "where the journal is, x"), "ey": ("m", "the same, y"),
}  # fmt: skip
COLUMNS = tuple(JOINT)


@dataclass(frozen=True, eq=False)
class Trace:
    """R rows, each of as many steps as any other but the last one."""

    t: Array  # (R,) s, the end of the row's last step
    joints: Array  # (R, n_clearances, 9) as COLUMNS has them, SI

    @staticmethod
    def of_rows(rows: Array, clearances: int) -> Trace:
        """From the rows that C writes, (R, width)."""
        joints = rows[:, 1:].reshape(len(rows), clearances, N_TRACE_COLUMNS)
        return Trace(rows[:, 0].copy(), joints[:, :, [TRACE_COLUMN_NAMES.index(name) for name in COLUMNS]])


def width(clearances: int) -> int:
    """Numbers in a row."""
    return 1 + N_TRACE_COLUMNS * clearances

"""What both commands print and write with: tables, CSV."""

from __future__ import annotations

import csv
import io
import sys
from collections.abc import Callable, Iterable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.errors import OutputError
from gudgeon.files.writing import write_text
from gudgeon.language.shown import in_spreadsheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console
    from rich.table import Table

WIDTH = 100  # of everything that is printed


def console() -> Console:
    """As wide as the terminal; into a file 100 columns."""
    from gudgeon.language.shown import plain_console

    return plain_console(None if sys.stdout.isatty() else WIDTH)


def new_table(columns: Iterable[str], left: Iterable[str] = ()) -> Table:
    """Numbers to the right, the columns in `left` to the left and folded where they are long."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1))
    for column in columns:
        table.add_column(column, justify="left" if column in left else "right", no_wrap=column not in left)
    return table


def write_csv(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """A line a row, six digits."""
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({key: f"{x:.6g}" if isinstance(x, float) else in_spreadsheet(x) for key, x in row.items()})
    write_text(path, text.getvalue())


def write_files(
    table: Path, rows: Sequence[dict[str, Any]], draw: Callable[[], Figure]
) -> tuple[list[Path], OutputError | None]:
    """The table and beside it the picture, which `draw` draws: what was written, and an error for what was not.

    It is to be raised once all is shown: what took minutes to measure is not lost with a full disk.
    """
    written, failed = [], None

    def picture(path: Path) -> None:
        from gudgeon.results.figures.plots import save_figure

        save_figure(draw(), path)

    steps: list[tuple[Path, Callable[[Path], None]]] = [(table, lambda path: write_csv(path, rows))]
    if find_spec("matplotlib"):
        steps.append((table.with_suffix(".png"), picture))
    for path, write in steps:
        try:
            write(path)
            written.append(path)
        except OutputError as error:
            failed = failed or error
    return written, failed

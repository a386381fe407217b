"""Format tables, and write CSV files and figures, of `gudgeon bench` (time by error) and `gudgeon map` (sweeps)."""

from __future__ import annotations

import csv
import io
import math
import sys
from collections.abc import Callable, Iterable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.errors import OutputError
from gudgeon.files.writing import write_text
from gudgeon.language.text_output import escape_for_spreadsheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console
    from rich.table import Table

MAX_FILE_WIDTH = 100  # characters of a line that is printed to a file


def make_console() -> Console:
    """Return a rich console for standard output, as wide as the terminal; 100 columns and no colours for a file."""
    from gudgeon.language.text_output import make_plain_console

    return make_plain_console(None if sys.stdout.isatty() else MAX_FILE_WIDTH)


def make_rich_table(columns: Iterable[str], left_aligned: Iterable[str] = ()) -> Table:
    """Return an empty rich table with these column heads.

    Columns in `left_aligned` are left-aligned and wrapped, others right-aligned and not wrapped.
    """
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1))
    for column in columns:
        table.add_column(
            column, justify="left" if column in left_aligned else "right", no_wrap=column not in left_aligned
        )
    return table


def write_rows_as_csv(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """Write rows as CSV with a header line: floats with six digits, texts escaped so that a spreadsheet runs none.

    rows: column name to value; the first row decides the columns, and there must be one. Raises OutputError.
    """
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow(
            {key: f"{x:.6g}" if isinstance(x, float) else escape_for_spreadsheet(x) for key, x in row.items()}
        )
    write_text(path, text.getvalue())


def write_table_and_figure(
    table_path: Path, rows: Sequence[dict[str, Any]], draw_figure: Callable[[], Figure]
) -> tuple[list[Path], OutputError | None]:
    """Write the table as CSV and the figure of `draw_figure` as PNG next to it; without matplotlib only the table.

    Returns the written files, and the first OutputError or None instead of raising it: the caller raises it after
    printing, so that results are not lost with a full disk.
    """
    written_paths, first_error = [], None

    def save_png(path: Path) -> None:
        """Draw the figure and save it as PNG; matplotlib is imported here only."""
        from gudgeon.results.figures.plots import save_figure

        save_figure(draw_figure(), path)

    steps: list[tuple[Path, Callable[[Path], None]]] = [(table_path, lambda path: write_rows_as_csv(path, rows))]
    if find_spec("matplotlib"):
        steps.append((table_path.with_suffix(".png"), save_png))
    for path, write in steps:
        try:
            write(path)
            written_paths.append(path)
        except OutputError as error:
            first_error = first_error or error
    return written_paths, first_error


def format_fraction(fraction: float) -> str:
    """Return a fraction as text: 0.12 as "12 %", 0.003 as "0.30 %", 4e-7 as "4e-7"; "–" for NaN."""
    if math.isnan(fraction):
        return "–"
    if 1e-4 <= fraction < 100:
        return f"{100 * fraction:.{0 if fraction >= 0.1 else 1 if fraction >= 0.01 else 2}f} %"
    return f"{fraction:.0e}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def format_rough_fraction(fraction: float) -> str:
    """Return a fraction as text for a cell of a map, as `format_fraction`, but "< 0.01 %" for values below 1e-4."""
    return "< 0.01 %" if fraction < 1e-4 else format_fraction(fraction)


def format_seconds(seconds: float) -> str:
    """Return a time (s) as text with three digits and a suitable unit, "10 µs" for 1e-5; "–" for NaN or infinity."""
    for factor, unit in ((1e9, "ns"), (1e6, "µs"), (1e3, "ms"), (1.0, "s")):
        if abs(seconds) * factor < 999.5:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds:.3g} s" if math.isfinite(seconds) else "–"


def format_clearance(clearance: float) -> str:
    """Return a radial clearance (m) as text in mm, as in drawings; "no play" for NaN."""
    return "no play" if math.isnan(clearance) else f"{clearance * 1e3:.3g} mm"

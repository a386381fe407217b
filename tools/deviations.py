"""Write the figure and the table that compare each oil film law with Reynolds' equation (`make deviations`).

docs/film_deviation.png has a map for each law and L/D. The table in docs/reynolds.md has the worst motion at some ε.
About 800 solutions take one or two minutes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from gudgeon.generator.kinds.laws.law import find_laws_of_role
from gudgeon.reynolds import Deviation, deviation

DOCS = Path(__file__).resolve().parents[1] / "docs"
RATIOS = (0.25, 1.0, 2.0)
COLUMNS = (0.1, 0.3, 0.5, 0.7, 0.9)  # ε of the table
HEAD = "| film law, $L/(2R_j)$ | " + " | ".join(f"ε = {x:g}" for x in COLUMNS) + " |"


def compare_laws() -> Iterator[list[Deviation]]:
    """Yield the deviations of each law at all L/D; the solver runs once for each L/D."""
    laws = sorted(find_laws_of_role("film"))
    first = [deviation(laws[0], ratio) for ratio in RATIOS]
    return ([one.of(law) for one in first] for law in laws)


def format_table_row(one: Deviation) -> str:
    """Return a row of the Markdown table: the largest deviation over all motions at each ε, in percent."""
    places = [int(np.argmin(abs(one.eps - x))) for x in COLUMNS]
    worst = (100.0 * float(one.share[k].max()) for k in places)
    cells = [f"`{one.law}`, {one.l_over_d:g}", *(f"{x:.1f} %" if x < 9.95 else f"{x:.0f} %" for x in worst)]
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """Write the figure and the table."""
    laws = list(compare_laws())
    figure = Figure(figsize=(4.6 * len(RATIOS), 3.5 * len(laws)), dpi=80, layout="constrained")
    axes = figure.subplots(len(laws), len(RATIOS), squeeze=False)
    for own, line in zip(laws, axes, strict=True):
        for one, ax in zip(own, line, strict=True):
            one.plot(ax)
    figure.savefig(DOCS / "film_deviation.png", metadata={"Software": None})
    page = DOCS / "reynolds.md"
    rows = "\n".join([HEAD, "|---" * (1 + len(COLUMNS)) + "|", *(format_table_row(one) for own in laws for one in own)])
    text, count = re.subn(rf"^{re.escape(HEAD)}\n(?:\|.*\n)+", f"{rows}\n", page.read_text("utf-8"), flags=re.MULTILINE)
    assert count == 1, "the page has no such table"
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()

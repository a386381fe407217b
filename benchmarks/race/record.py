"""Store measured times and errors of all solvers that docs/race.md compares as a CSV file.

Lines that begin with "# " contain facts, `# name: value`: machine, versions, times of right-hand sides. The other lines
are rows for each control (tolerance or step) of every entry.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

MEASURES = {
    "andrews": ("angle",),
    "double": ("angle",),
    "links": ("angle",),
    "ideal": ("motion",),
    "dry": ("slider", "path", "onset"),
    "lubricated": ("slider", "path"),
    "sweep": ("worst",),
}
LEVELS = (1e-4, 1e-6, 1e-8)
ONSET_LEVELS = (1e-6, 1e-8, 1e-10)  # s
SMOOTH, SMOOTH_LEVELS = ("double", "links"), (1e-6, 1e-8, 1e-10)
PACKAGES = ("numpy", "scipy", "sympy", "cffi", "scikit-sundae", "jitcode", "heyoka", "exudyn", "pydy", "cython")
COLUMNS = ("work", "entry", "own", "control", "seconds", "right_hand_sides")


@dataclass(frozen=True)
class Row:
    """One control of one entry: seconds of integration (of one run, or one sample), errors by measure."""

    work: str
    entry: str
    own: bool  # gudgeon's
    control: float
    seconds: float
    right_hand_sides: int  # −1: unknown
    errors: dict[str, float]


@dataclass(frozen=True)
class Record:
    """Results of a whole race."""

    facts: dict[str, str] = field(default_factory=dict)
    rows: tuple[Row, ...] = ()

    def entries(self, work: str) -> list[str]:
        """Return the entries of a problem in the order of the rows."""
        return list(dict.fromkeys(row.entry for row in self.rows if row.work == work))

    def points(self, work: str, entry: str, measure: str) -> list[tuple[float, float]]:
        """Return (error, seconds) of an entry for all its controls."""
        return [(r.errors[measure], r.seconds) for r in self.rows if (r.work, r.entry) == (work, entry)]

    def is_own(self, work: str, entry: str) -> bool:
        """Return whether the entry is gudgeon."""
        return any(r.own for r in self.rows if (r.work, r.entry) == (work, entry))

    def time_to(self, work: str, entry: str, measure: str, level: float) -> float:
        """Return the seconds to an error; NaN if it is not reached."""
        return time_to(self.points(work, entry, measure), level)


def time_to(points: Iterable[tuple[float, float]], level: float) -> float:
    """Return the smallest time to reach an error, from points (error, seconds) and between neighbours that enclose it.

    NaN if no point reaches it. There is no extrapolation: if all points are better, the time is that of the loosest.
    """
    good = [(e, s) for e, s in points if math.isfinite(e)]
    times = [s for e, s in good if e <= level]
    for (e0, s0), (e1, s1) in zip(good, good[1:], strict=False):
        if min(e0, e1) > 0.0 and min(e0, e1) <= level < max(e0, e1):
            share = math.log(level / e0) / math.log(e1 / e0)
            times.append(s0 * (s1 / s0) ** share)
    return min(times, default=math.nan)


def versions() -> str:
    """Return the versions of the installed packages."""
    found = []
    for name in PACKAGES:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            continue
    return ", ".join(found)


def write(path: Path, record: Record) -> None:
    """Write the CSV file."""
    measures = sorted({m for names in MEASURES.values() for m in names})
    with path.open("w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {name}: {value}\n" for name, value in record.facts.items())
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([*COLUMNS, *measures])
        for r in record.rows:
            cells = [f"{r.errors[m]:.4g}" if m in r.errors else "" for m in measures]
            writer.writerow(
                [r.work, r.entry, int(r.own), f"{r.control:g}", f"{r.seconds:.4g}", r.right_hand_sides, *cells]
            )


def read(path: Path) -> Record:
    """Return the record of a CSV file."""
    lines = path.read_text(encoding="utf-8").splitlines()
    facts = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    rows = []
    for cells in csv.DictReader(line for line in lines if not line.startswith("# ")):
        errors = {m: float(cells[m]) for m in MEASURES[cells["work"]]}
        rows.append(
            Row(
                cells["work"],
                cells["entry"],
                cells["own"] == "1",
                float(cells["control"]),
                float(cells["seconds"]),
                int(cells["right_hand_sides"]),
                errors,
            )
        )
    return Record(facts, tuple(rows))

"""Store measured times and errors of all solvers that docs/race.md compares as a CSV file.

Lines that begin with "# " contain facts, `# name: value`: versions, times of right-hand sides, solvers that were not
installed. The other lines are rows for each control (tolerance or step) of every entry. The column `run` numbers the
run of the race in which all values of the row were measured; the facts `run K, ...` describe machine and day of run K.
Several runs stand in one file if only some of the problems were measured again.
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
    "chain": ("angle",),
    "long": ("energy",),
    "turns": ("energy",),
    "swings": ("energy",),
    "ideal": ("motion",),
    "ensemble": ("motion",),
    "dry": ("slider", "path", "onset"),
    "sixteen": ("path",),
    "lubricated": ("slider", "path"),
    "sweep": ("worst",),
}
LEVELS = (1e-4, 1e-6, 1e-8)
ONSET_LEVELS = (1e-6, 1e-8, 1e-10)  # s
SMOOTH_LEVELS, ENERGY_LEVELS = (1e-6, 1e-8, 1e-10), (1e-8, 1e-9, 1e-10)
LEVELS_OF = dict.fromkeys(("double", "links", "chain"), SMOOTH_LEVELS)
LEVELS_OF |= dict.fromkeys(("long", "turns", "swings"), ENERGY_LEVELS)
PACKAGES = (
    *("numpy", "scipy", "sympy", "cffi", "scikit-sundae", "jitcode", "heyoka", "exudyn", "pydy", "cython"),
    *("mujoco", "pin", "drake", "casadi", "diffrax", "jax"),
)
COLUMNS = ("work", "entry", "own", "control", "seconds", "call", "setup", "right_hand_sides", "run")


@dataclass(frozen=True)
class Row:
    """One control of one entry: times (of one run, or one sample) and errors by measure; NaN: not measured."""

    work: str
    entry: str
    own: bool  # gudgeon's
    control: float
    seconds: float  # of the integration
    right_hand_sides: int  # −1: unknown
    errors: dict[str, float]
    call: float = math.nan  # of the whole call
    setup: float = math.nan  # of the entry, s
    run: int = 1  # run of the race in which the row was measured


@dataclass(frozen=True)
class Record:
    """Results of a whole race."""

    facts: dict[str, str] = field(default_factory=dict)
    rows: tuple[Row, ...] = ()

    def entries(self, work: str) -> list[str]:
        """Return the entries of a problem in the order of the rows."""
        return list(dict.fromkeys(row.entry for row in self.rows if row.work == work))

    def of(self, work: str, entry: str) -> list[Row]:
        """Return the rows of an entry, one for each of its controls."""
        return [row for row in self.rows if (row.work, row.entry) == (work, entry)]

    def points(self, work: str, entry: str, measure: str, call: bool = False) -> list[tuple[float, float]]:
        """Return (error, seconds) of an entry for all its controls, of the integration or of the whole call."""
        return [(r.errors[measure], r.call if call else r.seconds) for r in self.of(work, entry)]

    def setup(self, work: str, entry: str) -> float:
        """Return the set-up time of an entry in s; NaN if it was not measured."""
        return min((r.setup for r in self.of(work, entry) if math.isfinite(r.setup)), default=math.nan)

    def runs(self, work: str = "") -> list[int]:
        """Return the numbers of the runs in which a problem, or any problem, was measured."""
        return sorted({row.run for row in self.rows if work in ("", row.work)})

    def merged(self, newer: Record) -> Record:
        """Return the record with the problems of a newer run instead of its own."""
        works = {row.work for row in newer.rows}
        rows = [row for row in self.rows if row.work not in works]
        order = {work: k for k, work in enumerate(MEASURES)}
        found = Record({}, tuple(sorted((*rows, *newer.rows), key=lambda row: order[row.work])))
        current = {f"run {k}" for k in found.runs()}
        for name, value in {**self.facts, **newer.facts}.items():
            about = name.partition(", ")[0]
            if about in current or (about in MEASURES and (name in newer.facts or about not in works)):
                found.facts[name] = value
        return found

    def is_own(self, work: str, entry: str) -> bool:
        """Return whether the entry is gudgeon."""
        return any(row.own for row in self.of(work, entry))

    def time_to(self, work: str, entry: str, measure: str, level: float, call: bool = False) -> float:
        """Return the seconds to an error, of the integration or of the whole call; NaN if it is not reached."""
        return time_to(self.points(work, entry, measure, call), level)


def time_to(points: Iterable[tuple[float, float]], level: float) -> float:
    """Return the smallest time to reach an error, from points (error, seconds) and between neighbours that enclose it.

    NaN if no point reaches it. There is no extrapolation: if all points are better, the time is that of the loosest.
    """
    good = [(e, s) for e, s in points if math.isfinite(e) and math.isfinite(s)]
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
            times = ["" if math.isnan(x) else f"{x:.4g}" for x in (r.seconds, r.call, r.setup)]
            writer.writerow([r.work, r.entry, int(r.own), f"{r.control:g}", *times, r.right_hand_sides, r.run, *cells])


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
                float(cells["call"] or "nan"),
                float(cells["setup"] or "nan"),
                int(cells["run"]),
            )
        )
    return Record(facts, tuple(rows))

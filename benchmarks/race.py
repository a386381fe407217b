"""The race: CPU time to reach a given error, gudgeon and its peers in one run of one process.

    python -m benchmarks.race [--work lubricated dry andrews ideal] [--csv race.csv] [--figure race.png]

Needs gudgeon; peers that are not installed (extra `bench`) are left out with a line. Every entry is swept over its
tolerances (or steps); a time is the least of at least five repeats after a warm-up, integration only. The table
interpolates along a sweep, log-log, between the two neighbours that enclose the error asked for. Works, errors and
references: benchmarks/peers.
"""

from __future__ import annotations

import argparse
import csv
import math
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from benchmarks.peers import andrews, press
from benchmarks.race_entries import WORKS, Entry, Found, entries
from benchmarks.rhs import machine

LEVELS = (1e-4, 1e-6, 1e-8)
ONSET_LEVELS = (1e-6, 1e-8, 1e-10)  # s
REPEATS = 5
LONG = 0.3  # s: a run so long needs no warm-up of its own
MEASURES = {
    "lubricated": ("slider", "path"),
    "dry": ("slider", "path", "onset"),
    "andrews": ("angle",),
    "ideal": ("motion",),
}


@dataclass(frozen=True)
class Point:
    """One control (tolerance or step) of one entry."""

    control: float
    found: Found


@dataclass(frozen=True)
class Sweep:
    """An entry with its points, loosest control first."""

    entry: Entry
    points: tuple[Point, ...]


def sweep(entry: Entry) -> Sweep:
    """Every control, least time of REPEATS; a control at which the method gives up is left out."""
    points = []
    for control in entry.controls:
        try:
            runs = [entry.run(control)]
            count = REPEATS - 1 if runs[0].seconds > LONG else REPEATS
            runs += [entry.run(control) for _ in range(count)]
        except (ArithmeticError, RuntimeError, ValueError) as problem:
            print(f"  {entry.name} at {control:.0e}: {str(problem).splitlines()[0]}")
            continue
        points.append(Point(control, min(runs, key=lambda run: run.seconds)))
    return Sweep(entry, tuple(points))


def time_to(points: Iterable[tuple[float, float]], level: float) -> float:
    """Seconds to reach an error: the least over points (error, seconds) that do, and over neighbours that enclose it.

    NaN where no point reaches it. Nothing is extrapolated: a sweep whose loosest point is better than asked for
    gives that point's time.
    """
    good = [(e, s) for e, s in points if math.isfinite(e)]
    times = [s for e, s in good if e <= level]
    for (e0, s0), (e1, s1) in zip(good, good[1:], strict=False):
        if min(e0, e1) > 0.0 and min(e0, e1) <= level < max(e0, e1):
            share = math.log(level / e0) / math.log(e1 / e0)
            times.append(s0 * (s1 / s0) ** share)
    return min(times, default=math.nan)


def errors_of(one: Sweep, measure: str) -> list[tuple[float, float]]:
    """(error, seconds) along a sweep."""
    return [(p.found.errors[measure], p.found.seconds) for p in one.points]


def table(sweeps: list[Sweep], measure: str) -> list[str]:
    """Milliseconds to each level, and over the best of gudgeon's."""
    levels = ONSET_LEVELS if measure == "onset" else LEVELS
    times = {s.entry.name: [time_to(errors_of(s, measure), level) for level in levels] for s in sweeps}
    ours = [
        [t for s in sweeps if s.entry.method and math.isfinite(t := times[s.entry.name][i])] for i in range(len(levels))
    ]
    best = [min(column, default=math.nan) for column in ours]
    unit = " s" if measure == "onset" else ""
    head = "".join(f"{f'{level:.0e}{unit}':>11}" for level in levels)
    lines = [f"  {measure + ', time in ms to':<24}{head}   | over gudgeon's best", "  " + "-" * 92]
    for name, row in times.items():
        cells = "".join(f"{t * 1e3:11.4g}" if math.isfinite(t) else f"{'–':>11}" for t in row)
        ratio = "".join(
            f"{t / b:9.3g}" if math.isfinite(t / b) else f"{'–':>9}" for t, b in zip(row, best, strict=True)
        )
        lines.append(f"  {name:<24}{cells}   |{ratio}")
    return lines


def head(work: str) -> list[str]:
    """What the work is judged by: the peers' right-hand side and how well the reference is confirmed."""
    if work == "andrews" and find_spec("jitcode") is None:
        return ["  no right-hand side of a peer: jitcode is not installed"]
    if work == "andrews":
        return [f"  right-hand side of jitcode, called from Python: {andrews.seconds_per_rhs() * 1e6:.2f} µs"]
    if work == "ideal":
        return ["  time of one sample"]
    task, gap = press.work(work), press.reference_gap(work)
    rhs = press.Kernel(task).seconds_per_rhs * 1e6
    onsets = [len(times) for times in press.reference(work).onsets]
    return [
        f"  right-hand side of the peers' dense C: {rhs:.2f} µs; onsets at A and B: {onsets}",
        f"  a second method differs from the reference by:"
        f" slider {gap.slider:.0e}, path {gap.path:.0e}, onset {gap.onset:.0e} s",
    ]


def write_csv(path: Path, sweeps: list[Sweep]) -> None:
    """A row a point."""
    measures = sorted({m for names in MEASURES.values() for m in names})
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["work", "entry", "control", "seconds", "right_hand_sides", *measures])
        for one in sweeps:
            for p in one.points:
                cells = [p.found.errors.get(m, "") for m in measures]
                writer.writerow(
                    [one.entry.work, one.entry.name, p.control, p.found.seconds, p.found.right_hand_sides, *cells]
                )


def draw(path: Path, sweeps: list[Sweep]) -> None:
    """Time against error, log-log, a panel a work; gudgeon's lines are the thick ones."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    works = [w for w in WORKS if w != "ideal" and any(s.entry.work == w for s in sweeps)]
    figure, axes = plt.subplots(1, len(works), figsize=(5.2 * len(works), 4.6), squeeze=False, layout="constrained")
    for axis, work in zip(axes[0], works, strict=True):
        measure = MEASURES[work][0]
        for one in (s for s in sweeps if s.entry.work == work):
            points = [(e, 1e3 * t) for e, t in errors_of(one, measure) if math.isfinite(e) and e > 0.0]
            width = 2.4 if one.entry.method else 1.0
            axis.loglog(*zip(*points, strict=True), "o-", markersize=3, linewidth=width, label=one.entry.name)
        axis.set(title=work, xlabel=f"error ({measure})", ylabel="time [ms]")
        axis.invert_xaxis()
        axis.grid(True, which="major", alpha=0.3)
        axis.legend(fontsize=7)
    figure.savefig(path, dpi=150)


def race(works: list[str]) -> list[Sweep]:
    """Run, print, return everything."""
    print(f"{machine()}; one thread, least of {REPEATS} or more")
    done = []
    for work in works:
        print(f"\n{work}")
        print("\n".join(head(work)))
        sweeps = []
        for entry in (e for e in entries() if e.work == work):
            if entry.missing:
                print(f"  {entry.name}: left out, without {entry.missing}")
            else:
                sweeps.append(sweep(entry))
        for measure in MEASURES[work]:
            print("\n".join(["", *table([s for s in sweeps if s.points], measure)]))
        done += sweeps
    return done


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--work", nargs="+", choices=WORKS, default=list(WORKS))
    parser.add_argument("--csv", type=Path, help="a row for every tolerance of every entry")
    parser.add_argument("--figure", type=Path, help="time against error")
    options = parser.parse_args()
    sweeps = race(options.work)
    if options.csv:
        write_csv(options.csv, sweeps)
    if options.figure:
        draw(options.figure, sweeps)


if __name__ == "__main__":
    main()

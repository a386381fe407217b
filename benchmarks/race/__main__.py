"""Compare the CPU time that gudgeon and other solvers need for a given error (docs/race.md).

    python -m benchmarks.race [--work andrews double links ideal dry lubricated sweep] [--write]

Solvers that are not installed (extra `bench`) are left out with a message. Every entry is run with its tolerances (or
steps). A time is the smallest of at least five repeats after a warm-up, of integration only. The tables interpolate
between two neighbouring tolerances, log-log. benchmarks/peers defines problems, errors and references. `--write` stores
the results in benchmarks/race.csv, and makes figures and docs/race.md from it.
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
from importlib.util import find_spec

from benchmarks.peers import andrews, press, pydy_andrews
from benchmarks.race import page as race_page
from benchmarks.race import record as race_record
from benchmarks.race.entries import WORKS, Entry, Found, entries
from benchmarks.race.record import MEASURES, Record, Row
from benchmarks.rhs import machine
from benchmarks.studies import LARGE, large
from gudgeon.loading import compiler

REPEATS = 5
LONG = 0.3  # s: longer runs need no warm-up
SHORT, MORE = 0.03, 4  # s: shorter runs are repeated this often in a round


class Best:
    """Smallest times of the entries of one problem. Each round runs all entries, so that other load affects all
    alike."""

    def __init__(self, taking_part: list[Entry]) -> None:
        """Collect all entries with their tolerances or steps."""
        self.found: dict[tuple[Entry, float], Found] = {}
        self.waiting = [(entry, control) for entry in taking_part for control in entry.controls]

    def warm_up(self) -> None:
        """Run every entry once; a long run counts, after a short one a second run does.

        Tolerances at which a method fails are left out.
        """
        for entry, control in list(self.waiting):
            try:
                run = entry.run(control)
            except (ArithmeticError, RuntimeError, ValueError) as problem:
                print(f"  {entry.name} at {control:.0e}: {str(problem).splitlines()[0]}")
                self.waiting.remove((entry, control))
                continue
            long = run.seconds * entry.runs > LONG
            self.found[entry, control] = run if long else entry.run(control)

    def round(self, last: bool) -> None:
        """Run every entry again; those whose first run counted are left out in the last round."""
        for entry, control in self.waiting:
            best = self.found[entry, control]
            if last and best.seconds * entry.runs > LONG:
                continue
            again = [entry.run(control) for _ in range(1 if best.seconds * entry.runs > SHORT else MORE)]
            self.found[entry, control] = min(best, *again, key=lambda found: found.seconds)

    def rows(self) -> list[Row]:
        """Return the rows for the record."""
        return [
            Row(e.work, e.name, bool(e.method), control, run.seconds, run.right_hand_sides, run.errors)
            for (e, control), run in self.found.items()
        ]


def machine_facts() -> dict[str, str]:
    """Return machine, compiler, versions and load to which the times belong."""
    command = compiler.find_compiler()
    specified = subprocess.run(
        [*command, "--version"], capture_output=True, text=True, env=compiler.build_environment()
    ).stdout
    return {
        "machine": f"{machine()}, {platform.system()}",
        "compiler": specified.splitlines()[0].strip() if specified else "unknown",
        "python": platform.python_version(),
        "load average over the minute before the race": f"{os.getloadavg()[0]:.1f}",
        "packages": race_record.versions(),
    }


def work_facts(work: str) -> dict[str, str]:
    """Return facts on a problem.

    They are the times of right-hand sides of other solvers, the confirmation of the reference, and times of large
    batches.
    """
    if work == "andrews":
        found = {}
        if find_spec("jitcode") is not None:
            found["right-hand side of jitcode, called from Python"] = f"{andrews.seconds_per_rhs() * 1e6:.2f} µs"
        if find_spec("pydy") is not None and find_spec("Cython") is not None:
            found["right-hand side of PyDy"] = f"{pydy_andrews.seconds_per_rhs() * 1e6:.1f} µs"
        return found
    if work == "sweep":
        return {
            f"100,000 {scene} presses of {t_end} s in a batch, two threads": (
                f"{large(scene):.1f} s (goal: at most {most:g} s)"
            )
            for scene, (t_end, most) in LARGE.items()
        }
    if work not in ("dry", "lubricated"):
        return {}
    gap, rhs = press.reference_gap(work), press.Kernel(press.work(work)).seconds_per_rhs * 1e6
    found = {
        "right-hand side of the reference solvers in dense C": f"{rhs:.2f} µs (goal: at most 5.5 µs)",
        "difference of a second method from the reference": f"slider {gap.slider:.0e}, path {gap.path:.0e}",
    }
    if work == "dry":
        found["difference of a second method from the reference"] += f", onset {gap.onset:.0e} s"
        found["onsets of contact at A and B"] = " and ".join(str(len(times)) for times in press.reference(work).onsets)
    return found


def race(works: list[str]) -> Record:
    """Run the problems, print the tables, and return the record."""
    facts, rows = machine_facts(), []
    print("\n".join(f"{name}: {value}" for name, value in facts.items()))
    for work in works:
        print(f"\n{work}", flush=True)
        taking_part: list[Entry] = []
        for entry in (e for e in entries() if e.work == work):
            if entry.missing:
                print(f"  {entry.name}: left out, without {entry.missing}")
            else:
                taking_part.append(entry)
        best = Best(taking_part)
        best.warm_up()
        for k in range(REPEATS):
            best.round(last=k == REPEATS - 1)
        facts |= {f"{work}, {name}": value for name, value in work_facts(work).items()}
        rows += best.rows()
        record = Record(facts, tuple(rows))
        print("\n".join(race_page.facts(record, work)))
        for measure in MEASURES[work]:
            print("\n".join(["", *race_page.table(record, work, measure)]), flush=True)
    return Record(facts, tuple(rows))


def main() -> None:
    """Run the race from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--work", nargs="+", action="extend", choices=WORKS, help="measure only these problems")
    parser.add_argument("--write", action="store_true", help="store CSV, figures and the page; needs all problems")
    options = parser.parse_args()
    options.work = options.work or list(WORKS)
    if options.write and set(options.work) != set(WORKS):
        parser.error("--write stores all problems: leave out --work")
    record = race(options.work)
    print("\nmeasured values; in brackets the ratio to the goal: 1 or more meets the goal\n")
    print("\n".join(race_page.bars(record)))
    if options.write:
        race_record.write(race_page.CSV, record)
        race_page.main()


if __name__ == "__main__":
    main()

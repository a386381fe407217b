"""The race: CPU time to reach a given error, gudgeon and its peers in one run of one process.

    python -m benchmarks.race [--work andrews double links ideal dry lubricated sweep] [--write]

Peers that are not installed (extra `bench`) are left out with a line. Every entry is swept over its tolerances (or
steps); a time is the least of at least five repeats after a warm-up, integration only. The tables interpolate along a
sweep, log-log, between the two neighbours that enclose the error asked for. Works, errors and references:
benchmarks/peers. `--write` keeps what was found: benchmarks/race.csv, and made from it figures and docs/race.md.
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
LONG = 0.3  # s: a run so long needs no warm-up of its own
SHORT, MORE = 0.03, 4  # s: runs so short are cheaply had again, this often a round


class Best:
    """The least times of a work's entries. Rounds go through all of them, so that whatever else the machine does for a
    while takes its share of everyone."""

    def __init__(self, taking_part: list[Entry]) -> None:
        self.found: dict[tuple[Entry, float], Found] = {}
        self.waiting = [(entry, control) for entry in taking_part for control in entry.controls]

    def warm_up(self) -> None:
        """The first run of everyone; it counts where it is long, else a second does.

        A control at which a method gives up is left out.
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
        """Once more everyone; those whose first run counted rest in the last round."""
        for entry, control in self.waiting:
            best = self.found[entry, control]
            if last and best.seconds * entry.runs > LONG:
                continue
            again = [entry.run(control) for _ in range(1 if best.seconds * entry.runs > SHORT else MORE)]
            self.found[entry, control] = min(best, *again, key=lambda found: found.seconds)

    def rows(self) -> list[Row]:
        """For the record."""
        return [
            Row(e.work, e.name, bool(e.method), control, run.seconds, run.right_hand_sides, run.errors)
            for (e, control), run in self.found.items()
        ]


def machine_facts() -> dict[str, str]:
    """What the times belong to."""
    command = compiler.find_compiler()
    said = subprocess.run([*command, "--version"], capture_output=True, text=True, env=compiler.plain()).stdout
    return {
        "machine": f"{machine()}, {platform.system()}",
        "compiler": said.splitlines()[0].strip() if said else "unknown",
        "python": platform.python_version(),
        "processes that wanted a core before the race began, a minute's mean": f"{os.getloadavg()[0]:.1f}",
        "packages": race_record.versions(),
    }


def work_facts(work: str) -> dict[str, str]:
    """What a work is judged by: the peers' right-hand side and how well the reference is confirmed; large batches."""
    if work == "andrews":
        found = {}
        if find_spec("jitcode") is not None:
            found["right-hand side of jitcode, called from Python"] = f"{andrews.seconds_per_rhs() * 1e6:.2f} µs"
        if find_spec("pydy") is not None and find_spec("Cython") is not None:
            found["right-hand side of PyDy"] = f"{pydy_andrews.seconds_per_rhs() * 1e6:.1f} µs"
        return found
    if work == "sweep":
        return {
            f"100,000 {scene} presses of {t_end} s in a batch, two threads": f"{large(scene):.1f} s (asked: {most:g})"
            for scene, (t_end, most) in LARGE.items()
        }
    if work not in ("dry", "lubricated"):
        return {}
    gap, rhs = press.reference_gap(work), press.Kernel(press.work(work)).seconds_per_rhs * 1e6
    found = {
        "right-hand side of the peers' dense C": f"{rhs:.2f} µs (asked: at most 5.5)",
        "a second method differs from the reference by": f"slider {gap.slider:.0e}, path {gap.path:.0e}",
    }
    if work == "dry":
        found["a second method differs from the reference by"] += f", onset {gap.onset:.0e} s"
        found["onsets at A and B"] = " and ".join(str(len(times)) for times in press.reference(work).onsets)
    return found


def race(works: list[str]) -> Record:
    """Run, print, return everything."""
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
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--work", nargs="+", action="extend", choices=WORKS, help="only these")
    parser.add_argument("--write", action="store_true", help="keep CSV, figures and the page; all works")
    options = parser.parse_args()
    options.work = options.work or list(WORKS)
    if options.write and set(options.work) != set(WORKS):
        parser.error("--write keeps whole races: leave out --work")
    record = race(options.work)
    print("\nfound, and in brackets over what is asked: 1 or more meets it\n")
    print("\n".join(race_page.bars(record)))
    if options.write:
        race_record.write(race_page.CSV, record)
        race_page.main()


if __name__ == "__main__":
    main()

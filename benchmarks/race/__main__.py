"""Compare the CPU time that gudgeon and other solvers need for a given error (docs/race.md).

    python -m benchmarks.race [--work andrews double ...] [--only heyoka auto] [--quick] [--write]

Solvers that are not installed (`make race` installs them) are left out with the message "not installed". Every entry
is run with its tolerances (or steps). A row has the time of the integration alone, the processor time of the whole call
from Python, both the smallest of several repeats after a warm-up, and the time of set-up in a new process (setup.py).
The tables interpolate between two neighbouring tolerances, log-log. benchmarks/peers defines problems, errors and
references. `--write` stores the measured problems in benchmarks/race.csv under the number of a new run, and makes
figures and docs/race.md from the file. `--quick` tests the code: short runs, three controls, one repeat, no set-up.
"""

from __future__ import annotations

import argparse
import math
import os
import platform
import subprocess
from datetime import UTC, datetime
from importlib.util import find_spec

from benchmarks.peers import andrews, press, pydy_andrews, sizes
from benchmarks.race import page as race_page
from benchmarks.race import record as race_record
from benchmarks.race import setup
from benchmarks.race.entries import WORKS, Entry, Found, entries
from benchmarks.race.record import MEASURES, Record, Row
from benchmarks.rhs import machine
from benchmarks.studies import LARGE, large
from gudgeon.loading import compiler

REPEATS = 5
LONG = 0.3  # s: longer runs need no warm-up
SHORT, MORE = 0.03, 4  # s: shorter runs are repeated this often in a round
ENOUGH = 3.0  # s: an entry that has run for so long at a control is not repeated
QUICK_CONTROLS = 3


class Best:
    """Smallest times of the entries of one problem. Each round runs all entries, so that other load affects all
    alike."""

    def __init__(self, taking_part: list[Entry], quick: bool) -> None:
        """Collect all entries with their tolerances or steps; of a quick race the first, a middle and the last."""
        self.found: dict[tuple[Entry, float], Found] = {}
        self.spent: dict[tuple[Entry, float], float] = {}
        self.waiting = [
            (entry, control) for entry in taking_part for control in (thin(entry.controls) if quick else entry.controls)
        ]

    def warm_up(self) -> None:
        """Run every entry once; a long run counts, after a short one a second run does.

        Tolerances at which a method fails are left out.
        """
        for entry, control in list(self.waiting):
            try:
                run = entry.run(control)
            except (ArithmeticError, RuntimeError, ValueError) as problem:
                print(f"  {entry.name} at {control:.0e}: {(str(problem).splitlines() or [''])[0]}", flush=True)
                self.waiting.remove((entry, control))
                continue
            long = run.call * entry.runs > LONG
            self.found[entry, control] = run if long else entry.run(control)
            self.spent[entry, control] = run.call * entry.runs

    def round(self, last: bool) -> None:
        """Run every entry again; those whose first run counted are left out in the last round."""
        for entry, control in self.waiting:
            best = self.found[entry, control]
            each = best.call * entry.runs
            if (last and each > LONG) or self.spent[entry, control] > ENOUGH:
                continue
            for _ in range(1 if each > SHORT else MORE):
                best = best.least(entry.run(control))
                self.spent[entry, control] += each
            self.found[entry, control] = best

    def rows(self, setups: dict[str, float], run: int) -> list[Row]:
        """Return the rows for the record."""
        return [
            Row(
                entry.work,
                entry.name,
                bool(entry.method),
                control,
                min(found.seconds, found.call),  # gudgeon reports wall time, which other work makes longer
                found.right_hand_sides,
                found.errors,
                found.call,
                setups.get(entry.name, math.nan),
                run,
            )
            for (entry, control), found in self.found.items()
        ]


def thin(controls: tuple[float, ...]) -> tuple[float, ...]:
    """Return at most QUICK_CONTROLS controls, the first and the last among them."""
    last = len(controls) - 1
    return tuple(controls[k] for k in sorted({round(last * i / (QUICK_CONTROLS - 1)) for i in range(QUICK_CONTROLS)}))


def machine_facts(run: int) -> dict[str, str]:
    """Return day, machine, compiler, versions and load to which the times of a run belong."""
    command = compiler.find_compiler()
    specified = subprocess.run(
        [*command, "--version"], capture_output=True, text=True, env=compiler.build_environment()
    ).stdout
    found = {
        "day": datetime.now(UTC).date().isoformat(),
        "machine": f"{machine()}, {platform.system()}",
        "compiler": specified.splitlines()[0].strip() if specified else "unknown",
        "python": platform.python_version(),
        "load average over the minute before the race": f"{os.getloadavg()[0]:.1f}",
        "packages": race_record.versions(),
    }
    return {f"run {run}, {name}": value for name, value in found.items()}


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
        "right-hand side of the other solvers in dense C": f"{rhs:.2f} µs (goal: at most 5.5 µs)",
        "difference of a second method from the reference": f"slider {gap.slider:.0e} of its stroke,"
        f" path {gap.path:.0e} of the clearance",
    }
    if work == "dry":
        found["difference of a second method from the reference"] += f", onset {gap.onset:.0e} s"
        found["onsets of contact at A and B"] = " and ".join(str(len(times)) for times in press.reference(work).onsets)
    return found


def race(options: argparse.Namespace, run: int, before: Record) -> Record:
    """Run the problems, print the tables, and return the record.

    With `options.write`, the CSV file is written after each problem: the values of `before`, and the new ones.
    """
    facts, rows = machine_facts(run), []
    print("\n".join(f"{name}: {value}" for name, value in facts.items()))
    for work in options.work:
        print(f"\n{work}", flush=True)
        taking_part, missing = [], []
        for entry in (e for e in entries() if e.work == work and any(text in e.name for text in options.only)):
            if entry.missing:
                print(f"  {entry.name}: not installed ({entry.missing})")
                missing.append(entry.name)
            else:
                taking_part.append(entry)
        best = Best(taking_part, options.quick)
        best.warm_up()
        for k in range(1 if options.quick else REPEATS):
            best.round(last=k == REPEATS - 1)
        if missing:
            facts[f"{work}, not installed"] = ", ".join(missing)
        if not options.quick:
            facts |= {f"{work}, {name}": value for name, value in work_facts(work).items()}
        rows += best.rows({} if options.quick else setup.measure(taking_part), run)
        record = Record(facts, tuple(rows))
        print("\n".join(race_page.facts(record, work)))
        for measure in MEASURES[work]:
            print("\n".join(["", *race_page.table(record, work, measure)]), flush=True)
        if options.write:
            race_record.write(race_page.CSV, before.merged(record))
    return Record(facts, tuple(rows))


def main() -> None:
    """Run the race from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--work", nargs="+", action="extend", choices=WORKS, help="measure only these problems")
    parser.add_argument("--only", nargs="+", default=[""], metavar="TEXT", help="only entries with one of these texts")
    parser.add_argument("--quick", action="store_true", help="short runs that test the code; times mean little")
    parser.add_argument("--write", action="store_true", help="store CSV, figures and the page")
    options = parser.parse_args()
    options.work = options.work or list(WORKS)
    if options.write and (options.quick or options.only != [""]):
        parser.error("--write stores whole problems: leave out --quick and --only")
    if options.quick:
        sizes.shorten()
    before = race_record.read(race_page.CSV) if race_page.CSV.exists() else Record()
    record = race(options, max(before.runs(), default=0) + 1, before)
    print("\n".join(["", *race_page.setups(record), "", *race_page.bars(record)]))
    if options.write:
        race_page.main()


if __name__ == "__main__":
    main()

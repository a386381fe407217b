"""The race: CPU time to reach a given error, gudgeon and its peers in one run of one process.

    python -m benchmarks.race [--work andrews ideal dry lubricated sweep] [--write]

Peers that are not installed (extra `bench`) are left out with a line. Every entry is swept over its tolerances (or
steps); a time is the least of at least five repeats after a warm-up, integration only. The tables interpolate along a
sweep, log-log, between the two neighbours that enclose the error asked for. Works, errors and references:
benchmarks/peers. `--write` keeps what was found: benchmarks/race.csv, and made from it figures and docs/race.md.
"""

from __future__ import annotations

import argparse
import platform
import subprocess
from importlib.util import find_spec

from benchmarks import race_page, race_record
from benchmarks.peers import andrews, press, pydy_andrews
from benchmarks.race_entries import WORKS, Entry, entries
from benchmarks.race_record import MEASURES, Record, Row
from benchmarks.rhs import machine
from gudgeon import compiler

REPEATS = 5
LONG = 0.3  # s: a run so long needs no warm-up of its own


def sweep(entry: Entry) -> list[Row]:
    """Every control, least time of REPEATS; a control at which the method gives up is left out."""
    rows = []
    for control in entry.controls:
        try:
            runs = [entry.run(control)]
            count = REPEATS - 1 if runs[0].seconds * entry.runs > LONG else REPEATS
            runs += [entry.run(control) for _ in range(count)]
        except (ArithmeticError, RuntimeError, ValueError) as problem:
            print(f"  {entry.name} at {control:.0e}: {str(problem).splitlines()[0]}")
            continue
        best = min(runs, key=lambda run: run.seconds)
        own = bool(entry.method)
        rows.append(Row(entry.work, entry.name, own, control, best.seconds, best.right_hand_sides, best.errors))
    return rows


def machine_facts() -> dict[str, str]:
    """What the times belong to."""
    command = compiler.find_compiler()
    said = subprocess.run([*command, "--version"], capture_output=True, text=True, env=compiler.plain()).stdout
    return {
        "machine": f"{machine()}, {platform.system()}",
        "compiler": said.splitlines()[0].strip() if said else "unknown",
        "python": platform.python_version(),
        "packages": race_record.versions(),
    }


def work_facts(work: str) -> dict[str, str]:
    """What a work is judged by: the peers' right-hand side and how well the reference is confirmed."""
    if work == "andrews":
        found = {}
        if find_spec("jitcode") is not None:
            found["right-hand side of jitcode, called from Python"] = f"{andrews.seconds_per_rhs() * 1e6:.2f} µs"
        if find_spec("pydy") is not None and find_spec("Cython") is not None:
            found["right-hand side of PyDy"] = f"{pydy_andrews.seconds_per_rhs() * 1e6:.1f} µs"
        return found
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
        facts |= {f"{work}, {name}": value for name, value in work_facts(work).items()}
        for entry in (e for e in entries() if e.work == work):
            if entry.missing:
                print(f"  {entry.name}: left out, without {entry.missing}")
            else:
                rows += sweep(entry)
        record = Record(facts, tuple(rows))
        print("\n".join(race_page.facts(record, work)))
        for measure in MEASURES[work]:
            print("\n".join(["", *race_page.table(record, work, measure)]), flush=True)
    return Record(facts, tuple(rows))


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--work", nargs="+", choices=WORKS, default=list(WORKS))
    parser.add_argument("--write", action="store_true", help="keep CSV, figures and the page; all works")
    options = parser.parse_args()
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

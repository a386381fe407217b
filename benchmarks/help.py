"""Measure the processor time of `--help` of each command beyond that of Python's own start.

python -m benchmarks.help [--starts 7]
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys

import typer.main

from gudgeon.cli import app

START = "from gudgeon.entry import main; main()"


def start_seconds(starts: int, *line: str) -> float:
    """Return the smallest processor time (user and system, s) of some starts of Python with these arguments."""
    found = []
    for _ in range(starts):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, *line], check=True, capture_output=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        found.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(found)


def main() -> None:
    """Print a line for each command."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--starts", type=int, default=7)
    starts = parser.parse_args().starts
    alone = start_seconds(starts, "-c", "pass")
    print(f"{'Python alone':>14} {alone:.3f} s")
    for name in ("", *getattr(typer.main.get_command(app), "commands", {})):
        took = start_seconds(starts, "-c", START, *name.split(), "--help") - alone
        print(f"{name or 'gudgeon':>14} {took:.3f} s", flush=True)


if __name__ == "__main__":
    main()

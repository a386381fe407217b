"""Compare this checkout with an earlier commit: cold starts and batches. Ratios hold on any machine.

    python -m benchmarks.since COMMIT [--repeats 3]

The commit is checked out and installed in a folder of its own, with the extras that are installed here. A cold start is
a process with an empty cache and an edited copy of the file, from its begin to its first result, wall; a batch
(benchmarks/studies.py) is processor time of `simulate_many` in one thread. The smallest counts. Both sides
are measured by the same short programs, of calls that both have.
"""

from __future__ import annotations

import argparse
import math
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter, sleep

import numpy as np

from benchmarks.studies import PRESS, Presses, presses

ROOT = Path(__file__).parents[1]
COMPILED = 30.0  # s: meanwhile the libraries that a first batch begins with give way to those compiled with -O2
COLD = (("four_bar", "ideal"), ("nine_bar_press", "ideal"), ("nine_bar_press", "dry"), ("nine_bar_press", "lubricated"))
START = """
import sys, gudgeon
gudgeon.load(sys.argv[1], scene=sys.argv[2]).simulate(1e-3, output=2)
print("done", flush=True)
"""
BATCH = """
import sys
from time import process_time
import numpy as np, gudgeon
from gudgeon.integrators import lanes
lanes.MIN_REMAINING_S = 0.0  # a library of runs side by side is worth being compiled, as for many more of them
file, scene, t_end = sys.argv[1:]
columns = dict(np.load(file))
simulation = gudgeon.load("nine_bar_press", scene=scene)
for _ in range(2):  # what has to be compiled is, in the first
    before = process_time()
    simulation.simulate_many(columns, float(t_end), output=2, rtol=1e-4, threads=1)
    took = process_time() - before
print(1e3 * took / len(columns["c"]))
"""


@contextmanager
def checked_out(commit: str) -> Iterator[Path]:
    """Check out a commit in a temporary folder, installed with the extras of this checkout; yield the folder."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "gudgeon"
        subprocess.run(["git", "worktree", "add", "--quiet", "--detach", str(place), commit], cwd=ROOT, check=True)
        try:
            here = {stamp.name.removeprefix("gudgeon-") for stamp in (ROOT / ".venv").glob("gudgeon-all*")}
            for extras in sorted({"all,test"} | here):  # installed packages change the time of a start too
                subprocess.run(["sh", "tools/setup", extras], cwd=place, check=True, stdout=subprocess.DEVNULL)
            yield place
        finally:
            subprocess.run(["git", "worktree", "remove", "--force", str(place)], cwd=ROOT, check=True)


def process_environment(cache: str) -> Mapping[str, str]:
    """Return the environment of a measured process."""
    kept = {k: v for k, v in os.environ.items() if k not in ("PYTHONDONTWRITEBYTECODE", "PYTHONPATH", "GUDGEON_CACHE")}
    return {**kept, "GUDGEON_CACHE": cache}


def cold(place: Path, name: str, scene: str) -> float:
    """Return the wall time from the start of a process to its first result in s. Raises SystemExit."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        file = Path(folder) / f"{name}.yaml"
        file.write_text((place / "mechanisms" / f"{name}.yaml").read_text(encoding="utf-8") + "\n# edited\n", "utf-8")
        begin = perf_counter()
        with subprocess.Popen(
            [str(place / ".venv/bin/python"), "-c", START, str(file), scene],
            env=process_environment(f"{folder}/cache"),
            cwd=place,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        ) as process:
            output = process.stdout.readline() if process.stdout else ""
            took = perf_counter() - begin
        if output != "done\n":
            raise SystemExit(f"{name}, {scene}: no result in {place}")
        return took


def batch(place: Path, of: Presses, cache: str) -> float:
    """Return the processor time of a run in a batch in ms."""
    file = Path(cache) / "columns.npz"
    file.parent.mkdir(exist_ok=True)
    runs = len(of.columns["c"])
    np.savez(file, **{name: np.broadcast_to(value, runs) for name, value in (PRESS | of.columns).items()})
    done = subprocess.run(
        [str(place / ".venv/bin/python"), "-c", BATCH, str(file), of.scene, str(of.t_end)],
        env=process_environment(cache),
        cwd=place,
        check=True,
        capture_output=True,
        text=True,
    )
    return float(done.stdout)


def main() -> None:
    """Run the benchmark from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("commit")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    shutil.which("git") or parser.error("git is not installed")
    with checked_out(options.commit) as before, tempfile.TemporaryDirectory() as caches:
        places = {"before": before, "now": ROOT}
        print(f"  {'':<44}{'before':>9}{'now':>9}{'ratio':>9}")
        for name, scene in COLD:
            least = dict.fromkeys(places, math.inf)
            for k in range(options.repeats + 1):  # the first writes Python's compiled modules
                for side, place in places.items():
                    took = cold(place, name, scene)
                    least[side] = min(least[side], took) if k else math.inf
            print_row(f"cold start, {name}, {scene}, s", least)
        for of in presses():
            least = dict.fromkeys(places, math.inf)
            for side, place in places.items():
                batch(place, of, f"{caches}/{side}")
            sleep(COMPILED)
            for _ in range(options.repeats):
                for side, place in places.items():
                    least[side] = min(least[side], batch(place, of, f"{caches}/{side}"))
            print_row(f"{of.title}, ms", least)


def print_row(title: str, least: Mapping[str, float]) -> None:
    """Print a line of the table."""
    ratio = least["now"] / least["before"]
    print(f"  {title:<44}{least['before']:9.3f}{least['now']:9.3f}{ratio:9.2f}", flush=True)


if __name__ == "__main__":
    main()

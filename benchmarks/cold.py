"""Cold and warm starts: what a scene costs from nothing to its first result, by stage.

    python -m benchmarks.cold [--repeats 3]

Each start is a process of its own. A cold one has an empty cache: it reads, derives, emits and compiles one scene of a
copy of a shipped file, whose engine is foreseen (`Ahead.foresee`), but for the first one, of which no C is kept. One
after an edit has the cache of the start before it, as a designer has who changes a file: it derives and compiles anew,
but what scenes share is there (loading/ahead.py). A warm one finds equations and library. `all` is from the start of
the process to its first result, `optimized` to when the optimized library is there, which another process makes
behind the first result (loading/behind.py; with GUDGEON_QUICK=0 it is waited for). The least wall time of a few is
told, and the processor time of Python and of the compiler up to the first result; before, one start is thrown away: it
leaves Python's compiled modules behind, which an installed gudgeon has.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from benchmarks.rhs import machine
from gudgeon.loading.shipped import shipped_file

# (scene, seconds that are asked for)
SCENES = (
    ("jansen_leg", "ideal", 3.0),
    ("andrews_squeezer", "ideal", 3.0),
    ("four_bar", "ideal", 1.0),
    ("nine_bar_press", "ideal", 1.5),
    ("nine_bar_press", "dry", 1.5),
    ("nine_bar_press", "lubricated", 1.5),
)
WARM = 0.3  # s
KINDS = ("cold", "edited", "warm")
START = """
import json, resource, sys
from time import process_time
import gudgeon
simulation = gudgeon.load(sys.argv[1], scene=sys.argv[2])
simulation.simulate(1e-3, output=2)
stages, children = simulation.loading, resource.getrusage(resource.RUSAGE_CHILDREN)
print(json.dumps({
    "source": stages.source, "compile": stages.compile,
    "python": process_time(), "compiler": children.ru_utime + children.ru_stime,
}), flush=True)
simulation.compiled.lib.best()
"""
COLUMNS = ("source", "compile", "all", "optimized", "asked", "python", "compiler")


def start(name: str, scene: str, kind: str, folder: str) -> dict[str, float]:
    """One process: its stages, "all" from before its start to its first result, "optimized" to its end (s)."""
    cache = tempfile.mkdtemp(dir=folder) if kind == "cold" else folder
    if kind != "warm":
        name = _edited(name, folder)
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"} | {"GUDGEON_CACHE": cache}
    begin = perf_counter()
    with subprocess.Popen(
        [sys.executable, "-c", START, name, scene], env=environment, stdout=subprocess.PIPE, text=True
    ) as process:
        told = process.stdout.readline() if process.stdout else ""
        first = perf_counter() - begin
        process.wait()
    if process.returncode:
        raise SystemExit(process.returncode)
    return {**json.loads(told), "all": first, "optimized": perf_counter() - begin}


def _edited(name: str, folder: str) -> str:
    """A copy of a shipped mechanism's file with a title that no other start has seen."""
    file = Path(tempfile.mkdtemp(dir=folder), f"{name}.yaml")
    text = shipped_file(name).read_text(encoding="utf-8")
    file.write_text(text.replace("title: ", f"title: {file.parent.name} ", 1), encoding="utf-8")
    return str(file)


def least(name: str, scene: str, kind: str, repeats: int) -> dict[str, float]:
    """The fastest of some, after one that is thrown away."""
    with tempfile.TemporaryDirectory() as folder:
        found = [start(name, scene, kind, folder) for _ in range(repeats + 1)]
    return min(found[1:], key=lambda found: found["all"])


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--repeats", type=int, default=3)
    repeats = parser.parse_args().repeats
    print(f"{machine()}; s, the fastest of {repeats}; wall, and processor time of Python and of the compiler\n")
    for kind in KINDS:
        print(f"{kind:<28}" + "".join(f"{name:>16}" for name in COLUMNS))
        for name, scene, asked in SCENES:
            row = {**least(name, scene, kind, repeats), "asked": WARM if kind == "warm" else asked}
            print(f"{name + ' ' + scene:<28}" + "".join(f"{row[c]:>16.2f}" for c in COLUMNS), flush=True)
        print()


if __name__ == "__main__":
    main()

"""Measure cold and warm starts: the time from the start of a process to the first result of a scene, by stage.

    python -m benchmarks.cold [--repeats 3]

Each start is a process of its own.

- A cold start has an empty cache: it reads, derives, emits and compiles one scene of a copy of a shipped file. The
  engine is compiled before it is needed.
- A start after an edit has the cache of the start before: it derives and compiles anew, but finds what scenes share.
- A warm start finds equations and library.

`all` is the time from the start of the process to the first result. `optimized` is the time until the optimized library
exists, which another process compiles in the background (with GUDGEON_QUICK=0 the start waits for it). The table has
the smallest wall time of some starts, and the processor times of Python and of the compiler until the first result.
One start before is not counted: it writes Python's compiled modules, which an installed gudgeon has.
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
from gudgeon.loading.shipped import find_shipped_file

# (mechanism, scene, required time in s)
SCENES = (
    ("jansen_leg", "ideal", 3.0),
    ("andrews_squeezer", "ideal", 3.0),
    ("four_bar", "ideal", 1.0),
    ("nine_bar_press", "ideal", 1.5),
    ("nine_bar_press", "dry", 1.5),
    ("nine_bar_press", "lubricated", 1.5),
)
WARM = 0.3  # required time of a warm start in s
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
simulation.compiled.lib.wait_for_optimized()
"""
COLUMNS = ("source", "compile", "all", "optimized", "asked", "python", "compiler")


def start(name: str, scene: str, kind: str, folder: str) -> dict[str, float]:
    """Run one start; return its stages, "all" until the first result, "optimized" until the process ends, in s."""
    cache = tempfile.mkdtemp(dir=folder) if kind == "cold" else folder
    if kind != "warm":
        name = _copy_edited(name, folder)
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"} | {"GUDGEON_CACHE": cache}
    begin = perf_counter()
    with subprocess.Popen(
        [sys.executable, "-c", START, name, scene], env=environment, stdout=subprocess.PIPE, text=True
    ) as process:
        message = process.stdout.readline() if process.stdout else ""
        first = perf_counter() - begin
        process.wait()
    if process.returncode:
        raise SystemExit(process.returncode)
    return {**json.loads(message), "all": first, "optimized": perf_counter() - begin}


def _copy_edited(name: str, folder: str) -> str:
    """Return a copy of a shipped mechanism's file with a title that no other start has used."""
    file = Path(tempfile.mkdtemp(dir=folder), f"{name}.yaml")
    text = find_shipped_file(name).read_text(encoding="utf-8")
    file.write_text(text.replace("title: ", f"title: {file.parent.name} ", 1), encoding="utf-8")
    return str(file)


def least(name: str, scene: str, kind: str, repeats: int) -> dict[str, float]:
    """Return the fastest of some starts, after one that is not counted."""
    with tempfile.TemporaryDirectory() as folder:
        found = [start(name, scene, kind, folder) for _ in range(repeats + 1)]
    return min(found[1:], key=lambda found: found["all"])


def main() -> None:
    """Run the benchmark from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--repeats", type=int, default=3)
    repeats = parser.parse_args().repeats
    print(f"{machine()}; s, the fastest of {repeats}; wall, and processor time of Python and of the compiler\n")
    for kind in KINDS:
        print(f"{kind:<28}" + "".join(f"{name:>16}" for name in COLUMNS))
        for name, scene, requested in SCENES:
            row = {**least(name, scene, kind, repeats), "asked": WARM if kind == "warm" else requested}
            print(f"{name + ' ' + scene:<28}" + "".join(f"{row[c]:>16.2f}" for c in COLUMNS), flush=True)
        print()


if __name__ == "__main__":
    main()

"""The C of every shipped scene, the gallery's too, under sanitizers: formulations, methods, batches, threads.

    python -m tests.sanitize [NAME ...] [--threads] [--quick]

Each mechanism is a process of its own, whose libraries are compiled with -fsanitize=address,undefined, or with
--threads -fsanitize=thread, in a cache of their own. What a sanitizer says is printed, and the exit status is 1 then.
Runs are short: what is looked for is memory out of bounds, arithmetic that C does not define, and races.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import gudgeon
from gudgeon.contract.methods import SMOOTH, STAGED
from gudgeon.errors import GudgeonError
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.integrators import lanes

MECHANISMS = Path(gudgeon.__file__).resolve().parents[1] / "mechanisms"
ALSO = tuple(sorted((MECHANISMS / "gallery").glob("*.yaml")))
KINDS = {"address,undefined": "libasan.so", "thread": "libtsan.so"}
SAID = re.compile(r"runtime error|Sanitizer")
OPTIONS = {"ASAN_OPTIONS": "detect_leaks=0", "TSAN_OPTIONS": "report_signal_unsafe=0"}  # Python never gives all back
STEPS, STEP, RUNS = 300, 1e-4, 19
FULL_TOO = 40  # coordinates, up to which a scene is tried in all of them as well


def settings(simulation: gudgeon.Simulation, quick: bool) -> Iterator[dict[str, Any]]:
    """Arguments of `simulate`: each method, with its tolerance and with a step."""
    step = simulation.source.simulate.get("step", STEP)
    plain: dict[str, Any] = {"t_end": STEPS * step, "output": 11}
    extra = () if quick or simulation.source.reason_without_jacobian else STAGED
    for method in dict.fromkeys(("auto", *simulation.source.methods, *extra)):
        yield plain | {"method": method} | ({"step": step} if method == "rk4" else {})
        if method not in ("auto", "rk4", "kinematic") and not quick:
            yield plain | {"method": method, "step": step}


def scenes(file: Path) -> Iterator[gudgeon.Simulation]:
    """Each scene, in few coordinates and in all."""
    for scene in read_mechanism(file.read_bytes(), file.name).scenes:
        simulation = gudgeon.load(file, scene)
        yield simulation
        if len(simulation.source.coordinates) <= FULL_TOO:
            yield gudgeon.load(file, scene, formulation="full")


def exercise(file: Path, threads: int, quick: bool) -> int:
    """How many runs and batches were made of a mechanism; a refusal counts as one."""
    made, lanes.MIN_REMAINING_S = 0, 0.0  # runs go side by side however short a batch is
    for simulation in scenes(file):
        for options in settings(simulation, quick):
            made += _tried(simulation.simulate, **options)
            made += _tried(simulation.simulate_many, [{}] * RUNS, threads=threads, **options)
        if not quick and simulation.source.formulation != "full":
            for method in SMOOTH:
                made += _tried(simulation.simulate, 0.05, output=5, method=method)
    return made


def _tried(work: Callable[..., object], *given: object, **options: object) -> int:
    with suppress(GudgeonError):
        work(*given, **options)
    return 1


def runtime(kind: str) -> str:
    """The sanitizer's library, which comes before everything else."""
    found = subprocess.run(["gcc", f"-print-file-name={KINDS[kind]}"], capture_output=True, text=True, check=True)
    return found.stdout.strip()


def watched(kind: str, cache: str, arguments: list[str]) -> tuple[int, list[str]]:
    """One process under a sanitizer: its exit status, and the lines that tell of something."""
    compiler = f"gcc -fsanitize={kind} -fno-omit-frame-pointer -g1"
    environment = os.environ | OPTIONS | {"CC": compiler, "LD_PRELOAD": runtime(kind), "GUDGEON_CACHE": cache}
    environment["GUDGEON_QUICK"] = "0"
    command = [sys.executable, "-m", "tests.sanitize", "--within", *arguments]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    lines = [line for line in done.stderr.splitlines() if SAID.search(line)]
    print(done.stdout, end="", flush=True)
    if done.returncode or lines:
        print(done.stderr, file=sys.stderr)
    return done.returncode, lines


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--threads", action="store_true", help="races between the threads of batches")
    parser.add_argument("--quick", action="store_true", help="each method once")
    parser.add_argument("--within", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    every = (*sorted(MECHANISMS.glob("*.yaml")), *ALSO)
    files = [file for file in every if not options.names or file.stem in options.names]
    if options.within:
        for file in files:
            made = exercise(file, 4 if options.threads else 1, options.quick or options.threads)
            print(f"{file.stem}: {made} runs and batches", flush=True)
        return 0
    found = 0
    flags = [flag for flag in ("threads", "quick") if getattr(options, flag)]
    with tempfile.TemporaryDirectory() as cache:
        for file in files:
            kind = "thread" if options.threads else "address,undefined"
            code, lines = watched(kind, cache, [file.stem, *(f"--{flag}" for flag in flags)])
            found += len(lines) + (code != 0)
    print(f"{found} findings" if found else "nothing was found")
    return int(found > 0)


if __name__ == "__main__":
    sys.exit(main())

"""Uninitialised memory: random scenes (tests/mixed_scenes.py) under valgrind, whose reads of it are failures.

    python -m tests.memcheck [--count N] [--seed S]

Each scene is run by all methods, in a batch and from a restart, in one process under valgrind's memcheck. Only what is
found in compiled scenes counts: a report whose stack has no frame of one is about Python. Needs valgrind and gcc.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import gudgeon
from gudgeon.contract.methods import SMOOTH, STAGED
from gudgeon.errors import GudgeonError
from gudgeon.integrators import lanes
from tests.mixed_scenes import mixed_scene

COUNT, T_END, RUNS = 12, 0.06, 5  # the first switches in time are at 0.05 s
COMPILER = "gcc -g1 -mno-avx512f"  # valgrind does not know wider registers
OPTIONS = ("--quiet", "--leak-check=no", "--num-callers=12", "--error-limit=no")
REPORT = re.compile(r"^==\d+== (?=\S)(?:(?!^==\d+== $).)*", re.MULTILINE | re.DOTALL)


def settings(simulation: gudgeon.Simulation) -> Iterator[dict[str, Any]]:
    """Arguments of `simulate`: each method; in all coordinates one."""
    extra = () if simulation.source.reason_without_jacobian else STAGED
    if simulation.source.formulation == "full":
        yield {"method": "auto", "output": 7}
        return
    for method in dict.fromkeys(("auto", *simulation.source.methods, *extra, *SMOOTH)):
        yield {"method": method, "output": 7} | ({"step": 2e-4} if method == "rk4" else {})


def exercise(seed: int, folder: Path) -> int:
    """How many runs and batches were made of a scene; a refusal counts as one."""
    scene = mixed_scene(seed)
    file = folder / "mixed.yaml"
    file.write_text(scene.text, encoding="utf-8")
    made, lanes.MIN_REMAINING_S = 0, 0.0  # runs go side by side however short a batch is
    for formulation in ("reduced", "full"):
        simulation = gudgeon.load(file, scene.scene, formulation=formulation)
        for options in settings(simulation):
            made += _tried(simulation.simulate, T_END, **options)
            made += _tried(_restarted, simulation, options)
        made += _tried(simulation.simulate_many, [{"pull": 1.0 + k} for k in range(RUNS)], T_END, output=5)
    return made


def _restarted(simulation: gudgeon.Simulation, options: dict[str, Any]) -> None:
    half = simulation.simulate(0.5 * T_END, **options)
    simulation.simulate(T_END, start=half.final, **options)


def _tried(work: Callable[..., object], *given: object, **options: Any) -> int:
    with suppress(GudgeonError):
        work(*given, **options)
    return 1


def reports(log: str, cache: str) -> list[str]:
    """Those of memcheck in which a compiled scene is, each once."""
    found = (re.sub(r"==\d+== |0x[0-9A-F]+", "", text) for text in REPORT.findall(log) if cache in text)
    return list(dict.fromkeys(found))


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--within", help=argparse.SUPPRESS)
    options = parser.parse_args()
    seeds = range(options.seed, options.seed + options.count)
    if options.within:
        warnings.simplefilter("ignore")
        for seed in seeds:
            print(f"scene {seed}: {exercise(seed, Path(options.within))} runs and batches", flush=True)
        return 0
    if not shutil.which("valgrind"):
        print("memcheck needs valgrind: apt-get install valgrind", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder:
        log, cache = Path(folder, "log"), str(Path(folder, "cache"))
        environment = os.environ | {
            "CC": COMPILER,
            "GUDGEON_CACHE": cache,
            "GUDGEON_QUICK": "0",
            "PYTHONMALLOC": "malloc",
        }
        command = [sys.executable, "-m", "tests.memcheck", "--within", folder, *sys.argv[1:]]
        subprocess.run(command, env=environment, stdout=subprocess.DEVNULL)  # derived and compiled at full speed
        done = subprocess.run(["valgrind", *OPTIONS, f"--log-file={log}", *command], env=environment)
        found = reports(log.read_text(encoding="utf-8", errors="replace"), cache)
    print("\n".join(found))
    print(f"{len(found)} findings" if found else "nothing was found")
    return int(bool(found) or done.returncode != 0)


if __name__ == "__main__":
    sys.exit(main())

"""Measure the set-up of a solver of docs/race.md in a new process: derivation, compilation, just-in-time code, model.

    python -m benchmarks.race.setup WORK ENTRY

Set-up is the processor time of the first run less that of the second, with that of child processes, such as compilers.
The packages are imported and the reference solution is computed before. gudgeon derives and compiles the scene anew,
in an empty cache, also if its C is shipped.
"""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable
from importlib import import_module
from time import process_time

from benchmarks.peers import chain_equations, own_scenes, press, sizes
from benchmarks.race import entries as race_entries
from benchmarks.race.entries import Entry

LIMIT = 120.0  # s, wall time: an entry whose set-up takes longer has no value
REFERENCES: dict[str, Callable[[], object]] = {
    **{name: lambda n=n: chain_equations.reference(n) for name, n in chain_equations.WORKS.items()},  # type: ignore[misc]
    "dry": lambda: press.reference("dry"),
    "lubricated": lambda: press.reference("lubricated"),
    "sweep": race_entries.sweep_reference,
}


def processor_time() -> float:
    """Return the processor time of this process and of its finished children, in s."""
    return process_time() + sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def measure(taking_part: Iterable[Entry]) -> dict[str, float]:
    """Return the time of set-up by the names of entries; entries of one `model` are measured once."""
    found: dict[str, float] = {}
    of_model: dict[str, float] = {}
    for entry in taking_part:
        if entry.model not in of_model:
            of_model[entry.model] = measure_in_process(entry)
        found[entry.name] = of_model[entry.model]
    return found


def measure_in_process(entry: Entry) -> float:
    """Return the set-up time of an entry in s, measured in a process with an empty cache; NaN if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            with subprocess.Popen(
                [sys.executable, "-m", "benchmarks.race.setup", entry.work, entry.name],
                env={**os.environ, "GUDGEON_CACHE": folder},
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                start_new_session=True,
            ) as process:
                try:
                    return float(process.communicate(timeout=LIMIT)[0].split()[-1])
                finally:  # also its compilers
                    with contextlib.suppress(ProcessLookupError):
                        os.killpg(process.pid, signal.SIGKILL)
        except (subprocess.SubprocessError, ValueError, IndexError) as problem:
            print(f"  {entry.name}: set-up not measured, {type(problem).__name__}", flush=True)
            return float("nan")


def main() -> None:
    """Print the set-up time of one entry in s."""
    work, name = sys.argv[1:]
    sizes.shorten()
    (entry,) = (e for e in race_entries.entries() if (e.work, e.name) == (work, name))
    for module in (*entry.needs, "scipy.integrate"):
        import_module(module)
    if work in REFERENCES:
        REFERENCES[work]()
    race_entries.loaded.cache_clear()  # the reference of the sweep is a run of gudgeon
    press.library.cache_clear()
    own_scenes.regenerate = bool(entry.method)
    times = []
    for _ in range(2):
        before = processor_time()
        entry.run(entry.controls[0])
        times.append(processor_time() - before)
    print(max(0.0, times[0] - times[1]))


if __name__ == "__main__":
    main()

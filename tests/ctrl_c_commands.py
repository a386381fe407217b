"""Ctrl-C at seeded moments of commands, as a terminal sends it: to the command and to all programs that it started.

    python -m tests.ctrl_c_commands [--moments 50] [--seed 0] [--only run study ...]

Every other moment falls into a cold start, whose file nobody has derived or compiled yet. A command that is interrupted
ends with 130 and a word, without a traceback; each file that is there is whole, nothing else is left, and the next one
finds a cache that works. What is printed: how many ended so, how many were over before, and what was wrong. Moments
before Python has come to gudgeon (an interpreter's first 30 ms) are Python's own and are counted apart.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path

import h5py
import numpy as np
from PIL import Image

import gudgeon
from gudgeon.files.writing import PART
from gudgeon.loading.cache import is_entry_complete
from gudgeon.results.files.hdf5 import is_damaged
from tests.pump import TEXT

INTERRUPTED = 130
STUDY = """\
format: gudgeon-study/1
mechanism: pump.yaml
scenes: [ideal, worn]
parameters: {omega: {from: 19 rad/s, to: 21 rad/s, count: 150}}
measures: {top: {peak: piston.ax}, low: {min: piston.x}}
keep: [piston.x]
t_end: 5 ms
output: 50
"""
COMMANDS = {
    "run": "run pump.yaml --t-end 0.1 --output 500 --out out",
    "study": "study study.yaml --out pump.study",
    "check": "check pump.yaml -v",
    "emit": "emit pump.yaml -o c",
}
PYTHON, DONE, STOPPED = "in Python's start", "over before", "interrupted"


@dataclass
class Found:
    """Of all moments of a command."""

    counts: dict[str, int] = field(default_factory=lambda: {STOPPED: 0, DONE: 0, PYTHON: 0})
    wrong: list[str] = field(default_factory=list)
    longest: float = 0.0  # s, from the signal to the end


def begin(folder: Path, words: str) -> subprocess.Popen[str]:
    """The command, in a group of its own; Ctrl-C is not ignored there whatever it is here."""
    code = "from gudgeon.entry import main; main()"
    environment = {**os.environ, "GUDGEON_CACHE": str(folder / "cache"), "MPLBACKEND": "agg", "GUDGEON_QUICK": "0"}
    return subprocess.Popen(
        [sys.executable, "-c", code, *words.split()],
        cwd=folder / "here",
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )


def write_files(folder: Path, number: int) -> None:
    """An empty folder with files that have a number: another one is another mechanism to the cache."""
    shutil.rmtree(folder / "here", ignore_errors=True)
    (folder / "here").mkdir(parents=True)
    (folder / "here/pump.yaml").write_text(f"{TEXT}# {number}\n", encoding="utf-8")
    (folder / "here/study.yaml").write_text(STUDY, encoding="utf-8")


def what_is_wrong(here: Path) -> list[str]:
    """Files that are not whole, or that nobody asked for."""
    wrong = [f"{path.name} is left" for path in here.rglob("*") if PART.fullmatch(path.name)]
    for path in here.rglob("*.nc"):
        try:
            with h5py.File(path) as file:
                read = len(file) > 0
            if path.parent.name == "out":
                gudgeon.Result.load(path)
            if not read or is_damaged(path):
                wrong.append(f"{path.name} is damaged")
        except Exception as error:
            wrong.append(f"{path.name}: {error}")
    for path in here.rglob("*.png"):
        Image.open(path).load()
    for path in here.rglob("*.[ch]"):  # the list is there first, and says of each what it is or will be
        listed = (path.parent / "emitted.sha256").read_text(encoding="utf-8")
        if f"{sha256(path.read_bytes()).hexdigest()}  {path.name}\n" not in listed:
            wrong.append(f"{path.name} is not what the list says")
    return wrong


def broken_cache(cache: Path) -> list[str]:
    """Entries that are not whole, and what is left of those that were not finished."""
    left = [f"cache/aside/{path.name} is left" for path in cache.glob("aside/*")]
    kinds = ("models", "libraries", "engines", "compilers")
    entries = [entry for kind in kinds for entry in cache.glob(f"{kind}/*")]
    return left + [
        f"{entry.parent.name}/{entry.name} is not whole" for entry in entries if not is_entry_complete(entry)
    ]


def interrupt(folder: Path, words: str, moment: float, found: Found) -> None:
    """Once; `found` hears of it."""
    process = begin(folder, words)
    try:
        process.wait(timeout=moment)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGINT)
    sent = time.perf_counter()
    _, specified = process.communicate()
    found.longest = max(found.longest, time.perf_counter() - sent)
    status, wrong = process.returncode, [*what_is_wrong(folder / "here"), *broken_cache(folder / "cache")]
    ours = "gudgeon/entry.py" in specified or "gudgeon:" in specified
    if status == -signal.SIGINT or (status and "Traceback" in specified and not ours):
        found.counts[PYTHON] += 1  # before its handler is there, or while it imports what every program does
        wrong += [] if moment < 0.5 else [f"ended with {status}: {specified[-300:]!r}"]
    else:
        found.counts[STOPPED if status else DONE] += 1
        if status not in (0, INTERRUPTED) or "Traceback" in specified or "Exception ignored" in specified:
            wrong.append(f"ended with {status}: {specified[-600:]!r}")
        if status == INTERRUPTED and "interrupted" not in specified:
            wrong.append(f"does not say that it was interrupted: {specified[-300:]!r}")
    found.wrong += [f"{moment:.3f} s: {text}" for text in wrong]


def lasts(folder: Path, words: str, number: int) -> float:
    """s, of the whole command on a file with this number, which must succeed."""
    write_files(folder, number)
    before = time.perf_counter()
    process = begin(folder, words)
    _, specified = process.communicate()
    assert process.returncode == 0, specified
    return time.perf_counter() - before


def measure(name: str, folder: Path, moments: int, rng: np.random.Generator) -> bool:
    """One line of the table; whether all is well."""
    words, found = COMMANDS[name], Found()
    cold, warm = lasts(folder, words, 0), lasts(folder, words, 0)
    for k, share in enumerate(rng.uniform(0.0, 1.0, moments).tolist()):
        is_cold = k % 2 == 0
        write_files(folder, k + 1 if is_cold else 0)
        interrupt(folder, words, share * (cold if is_cold else warm), found)
    for number in (moments, 0):  # files that were interrupted, and the first: all goes well from here on
        lasts(folder, words, number)
    counts = ", ".join(f"{count} {what}" for what, count in found.counts.items() if count)
    print(
        f"{name:>6}: {moments} moments within {cold:.1f} s cold and {warm:.1f} s warm: {counts}; at most"
        f" {found.longest:.2f} s from signal to end; {len(found.wrong)} wrong",
        flush=True,
    )
    for message in found.wrong[:8]:
        print(f"{'':>8}{message}", flush=True)
    return not found.wrong


def main(arguments: Sequence[str] | None = None) -> int:
    """Command line; 1 where something was wrong."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--moments", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", nargs="+", default=list(COMMANDS), choices=list(COMMANDS))
    options = parser.parse_args(arguments)
    rng, well = np.random.default_rng(options.seed), True
    for name in options.condition:
        with tempfile.TemporaryDirectory() as folder:
            well &= measure(name, Path(folder), options.moments, rng)
    return 0 if well else 1


if __name__ == "__main__":
    sys.exit(main())

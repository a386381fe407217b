"""The first start of a scene: a library that is compiled quickly serves, while the optimized one is made behind it.

The quick one has the same texts, without optimization: a third of the compiler's time, the same bits in every number,
and up to three times the time of a run. A process of its own (`make`), which outlives this one, compiles the optimized
one into the cache, where every later start finds it; runs that are under way go on with it as soon as it is there.
Where that process cannot be begun, where it failed once, where the cache is not kept, and with GUDGEON_QUICK=0, the
optimized one is waited for.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError
from gudgeon.files.trust import Untrusted
from gudgeon.loading.cache import LOCK_SECONDS, Cache, is_whole
from gudgeon.loading.library import Functions, Library
from gudgeon.waiting.ctrl_c import CtrlC

if TYPE_CHECKING:
    import subprocess

KIND = "quick"  # of entries of the cache: the library, and the source that the other process compiles
SOURCE = "source.json"
OTHER = "import sys; sys.path[:] = sys.argv[2:]; from gudgeon.loading.behind import make; make(sys.argv[1])"
NICE = 5  # the run that goes on meanwhile is what somebody waits for
MOST = 4  # processes at once: of many scenes in a row they would pile up
_begun: list[subprocess.Popen[bytes]] = []  # by this process


def is_allowed(cache: Cache) -> bool:
    """Whether a process may be left behind, and what it makes is kept."""
    if os.environ.get("GUDGEON_QUICK") == "0" or cache.private:
        return False
    if getattr(sys, "frozen", False) or not Path(sys.executable or "").name.startswith(("python", "pypy")):
        return False  # a program that has Python inside, and would begin anew
    if sum(process.poll() is None for process in _begun) >= MOST:
        return False
    there = next(folder for folder in (cache.root, *cache.root.parents) if os.path.exists(folder))
    return os.access(there, os.W_OK)


class Behind:
    """The optimized library `key` of a scene, while another process makes it. `build`: what makes it here."""

    def __init__(self, cache: Cache, key: str, build: Callable[[Path], None], open_: Callable[[Path], Library]) -> None:
        self._cache, self._key, self._build, self._open = cache, key, build, open_
        self._process: subprocess.Popen[bytes] | None = None
        self._owner, self._lock = os.getpid(), Lock()

    def begin(self, quick: Path, portable: bool) -> bool:
        """Starts the other process, which reads what it compiles in this entry of the cache; whether it could be."""
        import subprocess

        told = json.dumps([str(self._cache.root), str(quick), portable])
        line = [sys.executable, "-c", OTHER, told, *sys.path]
        nothing = subprocess.DEVNULL
        with CtrlC() as ctrl_c, suppress(OSError):
            self._process = subprocess.Popen(
                line, stdin=nothing, stdout=nothing, stderr=nothing, start_new_session=True
            )
            _begun.append(self._process)
        ctrl_c.take()
        return self._process is not None

    def look(self, functions: Functions) -> bool:
        """Takes the optimized library where it is there by now; whether it is still to come."""
        lock = self._own_lock()
        if not lock.acquire(blocking=False):
            return True  # another thread looks
        try:
            over = self._process is not None and self._process.poll() is not None
            if not self._cache.holds("libraries", self._key):
                return not over
            entry = self._cache.root / "libraries" / self._key
            with suppress(GudgeonError, OSError, Untrusted):  # the next start makes it anew, and tells
                if is_whole(entry):
                    self._take(functions, entry)
            return False
        finally:
            lock.release()

    def wait(self, functions: Functions) -> None:
        """The same when it is there; made here if the other process did not. BuildError."""
        with self._own_lock():
            self._take(functions, self._cache.fetch("libraries", self._key, self._build))

    def _own_lock(self) -> Lock:
        """In the child of a fork a new one: whoever held the other is not in it, and the process is not its own."""
        if os.getpid() != self._owner:
            self._owner, self._lock, self._process = os.getpid(), Lock(), None
        return self._lock

    def _take(self, functions: Functions, entry: Path) -> None:
        with suppress(ImportError):  # the next start tells
            functions.become(self._open(entry).lib)


def make(told: str) -> None:
    """In the other process. What goes wrong is told by the next start, which compiles it where it can be seen."""
    from filelock import FileLock

    from gudgeon.loading.build import compile_kernels

    root, quick, portable = json.loads(told)
    os.nice(NICE)
    if is_whole(Path(quick)):
        source = KernelSource.from_json(Path(quick, SOURCE).read_bytes().decode())
        with FileLock(Path(root, "locks", "behind.lock"), timeout=LOCK_SECONDS):  # one after the other
            compile_kernels(source, portable=portable, cache=Cache(root))

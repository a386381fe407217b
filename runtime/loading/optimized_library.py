"""Compile the optimized library of a new scene in another process, while runs use an unoptimized one.

The unoptimized library is compiled from the same texts. The compiler needs a third of the time; runs give the same bits
and take up to three times as long. A separate process (`compile_optimized_library`), which may outlive this one,
compiles the optimized library into the cache. Runs continue with it as soon as it exists.

The optimized library is awaited if that process cannot be started or has failed before, if the cache is temporary, or
with GUDGEON_QUICK=0.
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
from gudgeon.files.trust import UntrustedPathError
from gudgeon.loading.cache import LOCK_SECONDS, Cache, is_entry_complete
from gudgeon.loading.library import Functions, Library
from gudgeon.waiting.ctrl_c import DelayedCtrlC

if TYPE_CHECKING:
    import subprocess

UNOPTIMIZED_KIND = "quick"  # of cache entries: the unoptimized library, and the source that the other process compiles
SOURCE = "source.json"
# program of the other process
PROGRAM = (
    "import sys; sys.path[:] = sys.argv[2:]; from gudgeon.loading.optimized_library import "
    "compile_optimized_library; compile_optimized_library(sys.argv[1])"
)
NICENESS = 5  # lower priority of the other process, since the run is more urgent
MAX_PROCESSES = 4  # largest number of such processes at once
_started_processes: list[subprocess.Popen[bytes]] = []  # processes started by this process


def may_compile_in_background(cache: Cache) -> bool:
    """Return whether a background process may be started to build an optimized library, and the cache would store it.

    It may not with GUDGEON_QUICK=0, with a private or read-only cache, in programs that embed Python, or if
    MAX_PROCESSES are running.
    """
    if os.environ.get("GUDGEON_QUICK") == "0" or cache.private:
        return False
    if getattr(sys, "frozen", False) or not Path(sys.executable or "").name.startswith(("python", "pypy")):
        return False  # a program that embeds Python: the command line would start the program again
    if sum(process.poll() is None for process in _started_processes) >= MAX_PROCESSES:
        return False
    existing_folder = next(folder for folder in (cache.root, *cache.root.parents) if os.path.exists(folder))
    return os.access(existing_folder, os.W_OK)


class OptimizedLibrary:
    """Provide the optimized library `key` of a scene while another process builds it; `build` builds it here."""

    def __init__(
        self, cache: Cache, key: str, build: Callable[[Path], None], open_entry: Callable[[Path], Library]
    ) -> None:
        self._cache, self._key, self._build, self._open = cache, key, build, open_entry
        self._process: subprocess.Popen[bytes] | None = None
        self._owner, self._lock = os.getpid(), Lock()

    def start_process(self, unoptimized_entry: Path, portable: bool) -> bool:
        """Start the other process, which builds the optimized library; return False if it cannot be started.

        It reads the kernel source from the cache entry `unoptimized_entry`, without output and in a session of its own.
        portable: for any processor of this architecture.
        """
        import subprocess

        request = json.dumps([str(self._cache.root), str(unoptimized_entry), portable])
        line = [sys.executable, "-c", PROGRAM, request, *sys.path]
        nothing = subprocess.DEVNULL
        with DelayedCtrlC() as ctrl_c, suppress(OSError):
            self._process = subprocess.Popen(
                line, stdin=nothing, stdout=nothing, stderr=nothing, start_new_session=True
            )
            _started_processes.append(self._process)
        ctrl_c.raise_delayed()
        return self._process is not None

    def switch_if_library_is_ready(self, functions: Functions) -> bool:
        """Switch `functions` to the optimized library if the cache has it; return whether it is still expected.

        Return False after the switch, if the process has failed, and if the library cannot be used. Return True at once
        while another thread checks.
        """
        lock = self._get_lock()
        if not lock.acquire(blocking=False):
            return True  # another thread is checking
        try:
            has_ended = self._process is not None and self._process.poll() is not None
            if not self._cache.has_folder("libraries", self._key):
                return not has_ended
            entry = self._cache.root / "libraries" / self._key
            with suppress(GudgeonError, OSError, UntrustedPathError):  # the next start builds it again and reports
                if is_entry_complete(entry):
                    self._switch_functions(functions, entry)
            return False
        finally:
            lock.release()

    def wait_for_library_and_switch(self, functions: Functions) -> None:
        """Wait for the optimized library and switch `functions` to it; build it here if the other process did not.

        Raises BuildError.
        """
        with self._get_lock():
            self._switch_functions(functions, self._cache.fetch("libraries", self._key, self._build))

    def _get_lock(self) -> Lock:
        """Return the lock. In a forked child it is replaced by a new one, because the parent may hold the old one."""
        if os.getpid() != self._owner:
            self._owner, self._lock, self._process = os.getpid(), Lock(), None
        return self._lock

    def _switch_functions(self, functions: Functions, entry: Path) -> None:
        """Let `functions` call the library of a cache entry; if it cannot be opened, the current one stays in use."""
        with suppress(ImportError):  # the next start reports it
            functions.replace_functions(self._open(entry).lib)


def compile_optimized_library(request: str) -> None:
    """Compile the optimized library into the cache, with low priority; called in the other process.

    `request`: JSON of cache folder, cache entry of the unoptimized library and `portable`. Nothing is compiled if that
    entry is incomplete. One such process compiles at a time. Errors are reported at the next start.
    """
    from filelock import FileLock

    from gudgeon.loading.build import compile_kernels

    root, unoptimized_entry, portable = json.loads(request)
    os.nice(NICENESS)
    if is_entry_complete(Path(unoptimized_entry)):
        source = KernelSource.from_json(Path(unoptimized_entry, SOURCE).read_bytes().decode())
        with FileLock(Path(root, "locks", "behind.lock"), timeout=LOCK_SECONDS):  # one after the other
            compile_kernels(source, portable=portable, cache=Cache(root))

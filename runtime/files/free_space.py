"""Check free memory and disk space before a computation starts that needs more.

Linux grants memory that it lacks and later kills the process; a disk that fills up loses the results of a long run.
Small requests are not checked.
"""

from __future__ import annotations

import errno
import math
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from gudgeon.errors import OutputError

LEAST = 1 << 26  # bytes that are always assumed to be free
SHARE = 0.9  # largest fraction of the free memory that may be requested, as other programs need some
# files of limit and use in cgroups v2, v1
_GROUPS = ("memory.max", "memory.current"), ("memory.limit_in_bytes", "memory.usage_in_bytes")


def check_memory(size: float, what: str) -> None:
    """Raise MemoryError if `size` bytes exceed the free memory; `what` needs them."""
    if size > LEAST and size > SHARE * (free := free_memory()):
        raise MemoryError(f"{what} would take {size_text(size)}, and {size_text(free)} are free")


def check_disk(folder: str | os.PathLike[str], size: float, what: str, path: str | os.PathLike[str] = "") -> None:
    """Raise OutputError, of `path` or the folder, if `size` bytes exceed the free disk space there."""
    if size > (free := free_disk(folder)):
        message = f"{os.strerror(errno.ENOSPC)}: {what} would take {size_text(size)}, and {size_text(free)} are free"
        raise OutputError(path or folder, OSError(errno.ENOSPC, message))


def free_disk(folder: str | os.PathLike[str]) -> float:
    """Return the bytes that the user may write in a folder, or its nearest existing parent; infinite if unknown."""
    path = Path(folder).absolute()
    for place in (path, *path.parents):
        with suppress(OSError):
            found = os.statvfs(place)
            return float(found.f_bavail) * found.f_frsize if found.f_blocks else math.inf
    return math.inf


def free_memory(root: Path = Path("/")) -> float:
    """Return the bytes of memory that this process may still use: of machine, control groups and own limit."""
    return max(0.0, min(_free_in_machine(root), *_free_in_groups(root), _free_in_process(root)))


def _free_in_machine(root: Path) -> float:
    """Return the free memory of the machine in bytes."""
    with suppress(OSError, ValueError):
        for line in (root / "proc/meminfo").read_text().splitlines():
            if line.startswith("MemAvailable:"):
                return 1024.0 * int(line.split()[1])
    with suppress(OSError, ValueError):  # macOS says only how much there is
        return float(os.sysconf("SC_PHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE")
    return math.inf


def _free_in_groups(root: Path) -> Iterator[float]:
    """Yield the free memory of each control group with a limit; droppable file pages count as free."""
    yield math.inf
    lines: list[str] = []
    with suppress(OSError):
        lines = (root / "proc/self/cgroup").read_text().splitlines()
    for line in lines:
        _, kinds, name = [*line.split(":", 2), "", ""][:3]
        if kinds and "memory" not in kinds.split(","):
            continue
        top = root / "sys/fs/cgroup" / ("memory" if kinds else "")
        own = top / name.strip("/")
        for folder in (own, *(parent for parent in own.parents if parent.is_relative_to(top))):
            for limit, used in _GROUPS:
                with suppress(OSError, ValueError):  # "max": none
                    held = int((folder / used).read_text()) - _droppable_bytes(folder)
                    yield float(int((folder / limit).read_text()) - held)


def _droppable_bytes(folder: Path) -> int:
    """Return the bytes of file pages in a control group that can be dropped."""
    with suppress(OSError, ValueError):
        for line in (folder / "memory.stat").read_text().splitlines():
            name, _, number = line.partition(" ")
            if name in ("inactive_file", "total_inactive_file"):
                return int(number)
    return 0


def _free_in_process(root: Path) -> float:
    """Return the free memory within the process's own limit (`ulimit -v`)."""
    with suppress(ImportError, OSError, ValueError):
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        if limit != resource.RLIM_INFINITY:
            used = int((root / "proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
            return float(limit - used)
    return math.inf


def size_text(size: float) -> str:
    """Return a size as text: 1.2 GB."""
    for power, unit in ((12, "TB"), (9, "GB"), (6, "MB"), (3, "kB")):
        if size >= 10.0**power:
            return f"{size / 10.0**power:.3g} {unit}"
    return f"{size:.0f} bytes"

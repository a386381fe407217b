"""Check, before a computation starts, whether it has enough free memory and disk space.

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

MIN_CHECKED_BYTES = 1 << 26  # bytes that are always assumed to be free
MAX_MEMORY_FRACTION = 0.9  # largest fraction of the free memory that may be requested, as other programs need some
# files of limit and use in cgroups v2, v1
_GROUPS = ("memory.max", "memory.current"), ("memory.limit_in_bytes", "memory.usage_in_bytes")


def check_memory(size: float, purpose: str) -> None:
    """Raise MemoryError if `size` bytes exceed MAX_MEMORY_FRACTION of the free memory.

    Up to MIN_CHECKED_BYTES are always allowed. `purpose` is the subject of the message ("a table of 9 runs").
    """
    if size > MIN_CHECKED_BYTES and size > MAX_MEMORY_FRACTION * (free := read_free_memory()):
        raise MemoryError(f"{purpose} would take {format_size(size)}, and {format_size(free)} are free")


def check_disk(folder: str | os.PathLike[str], size: float, purpose: str, path: str | os.PathLike[str] = "") -> None:
    """Raise OutputError if `size` bytes exceed the free disk space of a folder.

    `purpose` is the subject of the message ("the results"); the error names `path`, or else the folder.
    """
    if size > (free := read_free_disk_space(folder)):
        description = (
            f"{os.strerror(errno.ENOSPC)}: {purpose} would take {format_size(size)}, and {format_size(free)} are free"
        )
        raise OutputError(path or folder, OSError(errno.ENOSPC, description))


def read_free_disk_space(folder: str | os.PathLike[str]) -> float:
    """Return the bytes that the user may write in a folder, or in its nearest existing parent; infinite if unknown."""
    path = Path(folder).absolute()
    for existing_folder in (path, *path.parents):
        with suppress(OSError):
            status = os.statvfs(existing_folder)
            return float(status.f_bavail) * status.f_frsize if status.f_blocks else math.inf
    return math.inf


def read_free_memory(root: Path = Path("/")) -> float:
    """Return the bytes of memory that this process may still use: the minimum of machine, control groups and ulimit.

    `root` is the folder with /proc and /sys. The result is at least 0, and infinite if nothing is known.
    """
    return max(
        0.0,
        min(_read_free_memory_of_machine(root), *_read_free_memory_of_groups(root), _read_free_memory_of_process(root)),
    )


def _read_free_memory_of_machine(root: Path) -> float:
    """Return the free memory of the machine in bytes, or on macOS all memory; infinite if unknown."""
    with suppress(OSError, ValueError):
        for line in (root / "proc/meminfo").read_text().splitlines():
            if line.startswith("MemAvailable:"):
                return 1024.0 * int(line.split()[1])
    with suppress(OSError, ValueError):  # macOS: total memory
        return float(os.sysconf("SC_PHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE")
    return math.inf


def _read_free_memory_of_groups(root: Path) -> Iterator[float]:
    """Yield infinity, then the free bytes of each control group (cgroup v1, v2) of the process with a limit.

    Free is the limit less the usage; file pages that can be dropped count as free. Parent groups are included. `root`:
    folder that contains proc and sys; groups that cannot be read are left out.
    """
    yield math.inf
    lines: list[str] = []
    with suppress(OSError):
        lines = (root / "proc/self/cgroup").read_text().splitlines()
    for line in lines:
        _, controllers, name = [*line.split(":", 2), "", ""][:3]
        if controllers and "memory" not in controllers.split(","):
            continue
        mount_folder = root / "sys/fs/cgroup" / ("memory" if controllers else "")
        group_folder = mount_folder / name.strip("/")
        for folder in (
            group_folder,
            *(parent for parent in group_folder.parents if parent.is_relative_to(mount_folder)),
        ):
            for limit, usage in _GROUPS:
                with suppress(OSError, ValueError):  # "max": none
                    used_bytes = int((folder / usage).read_text()) - _read_reclaimable_bytes(folder)
                    yield float(int((folder / limit).read_text()) - used_bytes)


def _read_reclaimable_bytes(folder: Path) -> int:
    """Return the bytes of file pages in a control group that can be dropped; 0 if unknown."""
    with suppress(OSError, ValueError):
        for line in (folder / "memory.stat").read_text().splitlines():
            name, _, number = line.partition(" ")
            if name in ("inactive_file", "total_inactive_file"):
                return int(number)
    return 0


def _read_free_memory_of_process(root: Path) -> float:
    """Return the free memory in bytes within the process's own limit (`ulimit -v`); infinite without one."""
    with suppress(ImportError, OSError, ValueError):
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        if limit != resource.RLIM_INFINITY:
            used_bytes = int((root / "proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
            return float(limit - used_bytes)
    return math.inf


def format_size(size: float) -> str:
    """Return a number of bytes as text with three digits: "1.2 GB"."""
    for power, unit in ((12, "TB"), (9, "GB"), (6, "MB"), (3, "kB")):
        if size >= 10.0**power:
            return f"{size / 10.0**power:.3g} {unit}"
    return f"{size:.0f} bytes"

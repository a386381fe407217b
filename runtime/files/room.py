"""How much memory and disk is free, asked before more is begun than there is room for.

Linux hands out memory that it does not have and kills who writes to it; a disk that fills after an hour's run loses the
hour. Of memory what is little is not asked about: it costs a comparison.
"""

from __future__ import annotations

import errno
import math
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from gudgeon.errors import OutputError

LEAST = 1 << 26  # bytes that are always taken to be there
SHARE = 0.9  # of what is free may be asked for: others ask too
_GROUPS = ("memory.max", "memory.current"), ("memory.limit_in_bytes", "memory.usage_in_bytes")  # cgroups v2, v1


def check_memory(size: float, what: str) -> None:
    """MemoryError where `size` bytes are more than is free; `what` will take them."""
    if size > LEAST and size > SHARE * (free := free_memory()):
        raise MemoryError(f"{what} would take {in_bytes(size)}, and {in_bytes(free)} are free")


def check_disk(folder: str | os.PathLike[str], size: float, what: str, path: str | os.PathLike[str] = "") -> None:
    """OutputError, of `path` or of the folder, where `size` bytes are more than is free where that is, or will be."""
    if size > (free := free_disk(folder)):
        told = f"{os.strerror(errno.ENOSPC)}: {what} would take {in_bytes(size)}, and {in_bytes(free)} are free"
        raise OutputError(path or folder, OSError(errno.ENOSPC, told))


def free_disk(folder: str | os.PathLike[str]) -> float:
    """Bytes that the user may write there, of the nearest folder above that is there; infinite where it is unknown."""
    path = Path(folder).absolute()
    for place in (path, *path.parents):
        with suppress(OSError):
            found = os.statvfs(place)
            return float(found.f_bavail) * found.f_frsize if found.f_blocks else math.inf
    return math.inf


def free_memory(root: Path = Path("/")) -> float:
    """Bytes that this process may take yet: of the machine, within its control group and its own limit."""
    return max(0.0, min(_of_the_machine(root), *_of_groups(root), _of_the_process(root)))


def _of_the_machine(root: Path) -> float:
    with suppress(OSError, ValueError):
        for line in (root / "proc/meminfo").read_text().splitlines():
            if line.startswith("MemAvailable:"):
                return 1024.0 * int(line.split()[1])
    with suppress(OSError, ValueError):  # macOS says only how much there is
        return float(os.sysconf("SC_PHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE")
    return math.inf


def _of_groups(root: Path) -> Iterator[float]:
    """Of each group that the process is in and that has a limit; pages of files that can be dropped are free."""
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
                    held = int((folder / used).read_text()) - _droppable(folder)
                    yield float(int((folder / limit).read_text()) - held)


def _droppable(folder: Path) -> int:
    with suppress(OSError, ValueError):
        for line in (folder / "memory.stat").read_text().splitlines():
            name, _, number = line.partition(" ")
            if name in ("inactive_file", "total_inactive_file"):
                return int(number)
    return 0


def _of_the_process(root: Path) -> float:
    """Within `ulimit -v`."""
    with suppress(ImportError, OSError, ValueError):
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        if limit != resource.RLIM_INFINITY:
            taken = int((root / "proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
            return float(limit - taken)
    return math.inf


def in_bytes(size: float) -> str:
    """As people read it: 1.2 GB."""
    for power, unit in ((12, "TB"), (9, "GB"), (6, "MB"), (3, "kB")):
        if size >= 10.0**power:
            return f"{size / 10.0**power:.3g} {unit}"
    return f"{size:.0f} bytes"

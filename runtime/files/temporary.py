"""Temporary folders that no killed process leaves for ever: each is locked by its process, and swept once it is not."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path

PREFIX = "gudgeon-tmp-"
GRACE_S = 60.0  # a younger folder may belong to a process that has not locked it yet
OURS = re.compile(rf"{PREFIX}[a-z0-9_]{{8}}")  # as mkdtemp names them


class TemporaryFolder:
    """A folder in $TMPDIR, of the user alone, until `remove` or until the process ends, however it ends.

    The lock (flock) of the folder ends with the process; who makes the next one removes folders that nobody locks.
    """

    def __init__(self) -> None:
        """Raises OSError where no folder can be made."""
        root = Path(tempfile.gettempdir())
        self.path = Path(tempfile.mkdtemp(prefix=PREFIX, dir=root))
        self._lock: int | None = _locked(self.path)
        _sweep(root, os.stat(self.path).st_ctime - GRACE_S)

    def remove(self) -> None:
        """Remove the folder and what is in it; nothing happens the second time."""
        shutil.rmtree(self.path, ignore_errors=True)
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None


def _locked(folder: Path) -> int | None:
    """An open folder that this process alone has locked; None where another one has, or locks do not work."""
    from fcntl import LOCK_EX, LOCK_NB, flock

    handle = None
    try:
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
        flock(handle, LOCK_EX | LOCK_NB)
    except OSError:
        if handle is not None:
            os.close(handle)
        return None
    return handle


def _sweep(root: Path, newest: float) -> None:
    """Remove folders of this user, older than `newest`, whose processes have ended."""
    with suppress(OSError):
        for entry in os.scandir(root):
            if not OURS.fullmatch(entry.name):
                continue
            with suppress(OSError):
                found = entry.stat(follow_symlinks=False)
                if found.st_uid != os.geteuid() or found.st_ctime > newest:
                    continue
                if (lock := _locked(Path(entry.path))) is not None:
                    shutil.rmtree(entry.path, ignore_errors=True)
                    os.close(lock)

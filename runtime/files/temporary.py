"""Create temporary folders that are removed even if their process is killed: each is locked by its process."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path

PREFIX = "gudgeon-tmp-"
GRACE_S = 60.0  # a younger folder may belong to a process that has not locked it yet
FOLDER_PATTERN = re.compile(rf"{PREFIX}[a-z0-9_]{{8}}")  # names of mkdtemp


class TemporaryFolder:
    """A folder in $TMPDIR, for this user only, until `remove_folder` or the end of the process.

    The lock (flock) of the folder ends with the process. The next TemporaryFolder removes folders without a lock.
    """

    def __init__(self) -> None:
        """Create and lock the folder, and remove abandoned ones. Raises OSError if it cannot be created."""
        root = Path(tempfile.gettempdir())
        self.path = Path(tempfile.mkdtemp(prefix=PREFIX, dir=root))
        self._lock: int | None = _lock_folder(self.path)
        _remove_abandoned_folders(root, os.stat(self.path).st_ctime - GRACE_S)

    def remove_folder(self) -> None:
        """Remove the folder and its contents; a second call does nothing."""
        shutil.rmtree(self.path, ignore_errors=True)
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None


def _lock_folder(folder: Path) -> int | None:
    """Return the file descriptor of a folder that this process has locked; the caller closes it to release the lock.

    Returns None if another process has locked the folder, or if locks do not work there.
    """
    from fcntl import LOCK_EX, LOCK_NB, flock

    descriptor = None
    try:
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
        flock(descriptor, LOCK_EX | LOCK_NB)
    except OSError:
        if descriptor is not None:
            os.close(descriptor)
        return None
    return descriptor


def _remove_abandoned_folders(root: Path, max_change_time: float) -> None:
    """Remove temporary folders of this user that changed before `max_change_time` (s since 1970) and have no lock.

    Their processes have ended. Errors are ignored.
    """
    with suppress(OSError):
        for entry in os.scandir(root):
            if not FOLDER_PATTERN.fullmatch(entry.name):
                continue
            with suppress(OSError):
                status = entry.stat(follow_symlinks=False)
                if status.st_uid != os.geteuid() or status.st_ctime > max_change_time:
                    continue
                if (lock := _lock_folder(Path(entry.path))) is not None:
                    shutil.rmtree(entry.path, ignore_errors=True)
                    os.close(lock)

"""Check whether another user could have written code in a folder, as ssh checks its keys.

Code in the cache runs with the rights of the user who loads it. The folder and its contents must belong to the user or
root, and group and others must not be able to write there. On the path to it, no one else may replace a folder. An
access list that grants writing shows in the bits of the group.
"""

from __future__ import annotations

import errno
import os
import stat
from functools import cache

LINKS = 40  # largest number of links on a path, as in the kernel


class Untrusted(Exception):
    """Signal that another user may have written a file; the text says which and who."""


def check_path(path: str | os.PathLike[str]) -> None:
    """Raise Untrusted if another user may write the folder or replace it; it need not exist yet."""
    passed, there = _path_components(os.fspath(path))
    for above, found in passed[:-1] if there else passed:
        _check_above(above, found)
    if there:
        check(*passed[-1])


def check(path: str | os.PathLike[str], found: os.stat_result) -> None:
    """Raise Untrusted if a file or folder is not the user's or root's, or if group or others may write it."""
    if found.st_uid not in (os.geteuid(), 0):
        raise Untrusted(f"{os.fspath(path)} belongs to another user (uid {found.st_uid})")
    if found.st_mode & 0o022 and not stat.S_ISLNK(found.st_mode):
        who = "everybody" if found.st_mode & 0o002 else f"the group (gid {found.st_gid})"
        raise Untrusted(f"{who} may write {os.fspath(path)}")


def check_folder(path: str | os.PathLike[str]) -> None:
    """Raise Untrusted as `check` for a folder that is not a link. Raise OSError for anything else."""
    found = os.lstat(path)
    if not stat.S_ISDIR(found.st_mode):
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), os.fspath(path))
    check(path, found)


def _check_above(path: str, found: os.stat_result) -> None:
    """Raise Untrusted if another user may replace a folder or link on the path.

    In folders whose files only their owners may rename (/tmp), all may write.
    """
    mine = (os.geteuid(), 0)
    if found.st_uid not in mine and not (found.st_uid == _overflow_user() and _root_has_no_name()):
        raise Untrusted(f"{path} belongs to another user (uid {found.st_uid})")
    if stat.S_ISLNK(found.st_mode) or found.st_mode & stat.S_ISVTX:
        return
    if found.st_mode & 0o002 or (found.st_mode & 0o020 and not _is_own_group(found.st_gid)):
        who = "everybody" if found.st_mode & 0o002 else f"the group (gid {found.st_gid})"
        raise Untrusted(f"{who} may write {path}")


def read(path: str | os.PathLike[str]) -> bytes:
    """Return the bytes of a trusted regular file; links are not followed. Raise Untrusted, OSError."""
    handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    with open(handle, "rb", buffering=0) as file:
        found = os.fstat(handle)
        if not stat.S_ISREG(found.st_mode):
            raise OSError(errno.EINVAL, "no regular file", os.fspath(path))
        check(path, found)
        return file.read()


def _path_components(path: str) -> tuple[list[tuple[str, os.stat_result]], bool]:
    """Return folders and links from / to the folder as the kernel passes them, and whether all of them exist."""
    names = [name for name in reversed(path.split("/")) if name not in ("", ".")]
    here = "/" if path.startswith("/") else os.getcwd()
    passed, links = [(here, os.lstat(here))], 0
    while names:
        name = names.pop()
        if name == "..":
            here = os.path.dirname(here)
            continue
        there = os.path.join(here, name)
        try:
            found = os.lstat(there)
        except FileNotFoundError:
            return passed, False
        passed.append((there, found))
        if not stat.S_ISLNK(found.st_mode):
            here = there
            continue
        links += 1
        if links > LINKS:
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), path)
        target = os.readlink(there)
        here = "/" if target.startswith("/") else here
        names += [part for part in reversed(target.split("/")) if part not in ("", ".")]
    return [*passed, (here, os.lstat(here))] if passed[-1][0] != here else passed, True


def _is_own_group(group: int) -> bool:
    """Return whether a group has the user's name and no other member, as many systems make one for each user."""
    import grp
    import pwd

    try:
        user, named = pwd.getpwuid(os.geteuid()), grp.getgrgid(group)
    except KeyError:
        return False
    return named.gr_name == user.pw_name and set(named.gr_mem) <= {user.pw_name}


@cache
def _overflow_user() -> int:
    """Return the user id that stands for unknown users."""
    try:
        with open("/proc/sys/kernel/overflowuid") as file:
            return int(file.read())
    except (OSError, ValueError):
        return 65534


@cache
def _root_has_no_name() -> bool:
    """Return whether this is a container without the machine's root, whose folders seem to be nobody's."""
    try:
        with open("/proc/self/uid_map") as file:
            return not any(int(line.split()[1]) == 0 for line in file)  # user inside, outside, how many
    except (OSError, ValueError, IndexError):
        return False

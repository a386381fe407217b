"""Whether code in a folder can be another user's, as ssh asks of its keys.

What is loaded from the cache runs with the rights of whoever loads it. So the folder and what is in it belong to the
user or to root, and neither group nor others may write there; on the way to it, nobody else may put another folder in
its place. An access list that lets somebody write shows in the bits of the group.
"""

from __future__ import annotations

import errno
import os
import stat
from functools import cache

LINKS = 40  # on the way to a folder, as the kernel counts


class Untrusted(Exception):
    """Somebody else may have written this; the text says what and who."""


def check_way(path: str | os.PathLike[str]) -> None:
    """Untrusted if another user may write the folder, or put another in its place; it need not be there yet."""
    passed, there = _way(os.fspath(path))
    for above, found in passed[:-1] if there else passed:
        _check_above(above, found)
    if there:
        check(*passed[-1])


def check(path: str | os.PathLike[str], found: os.stat_result) -> None:
    """Untrusted if a file or folder is neither the user's nor root's, or if group or others may write it."""
    if found.st_uid not in (os.geteuid(), 0):
        raise Untrusted(f"{os.fspath(path)} belongs to another user (uid {found.st_uid})")
    if found.st_mode & 0o022 and not stat.S_ISLNK(found.st_mode):
        who = "everybody" if found.st_mode & 0o002 else f"the group (gid {found.st_gid})"
        raise Untrusted(f"{who} may write {os.fspath(path)}")


def check_folder(path: str | os.PathLike[str]) -> None:
    """The same of a folder that is no link. Raises OSError if it is none."""
    found = os.lstat(path)
    if not stat.S_ISDIR(found.st_mode):
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), os.fspath(path))
    check(path, found)


def _check_above(path: str, found: os.stat_result) -> None:
    """The same of a folder, or a link, on the way: where names are kept by their owners (/tmp) all may write."""
    mine = (os.geteuid(), 0)
    if found.st_uid not in mine and not (found.st_uid == _nobody() and _root_has_no_name()):
        raise Untrusted(f"{path} belongs to another user (uid {found.st_uid})")
    if stat.S_ISLNK(found.st_mode) or found.st_mode & stat.S_ISVTX:
        return
    if found.st_mode & 0o002 or (found.st_mode & 0o020 and not _own_group(found.st_gid)):
        who = "everybody" if found.st_mode & 0o002 else f"the group (gid {found.st_gid})"
        raise Untrusted(f"{who} may write {path}")


def read(path: str | os.PathLike[str]) -> bytes:
    """A trusted regular file's bytes; no link is followed. Raises Untrusted, OSError."""
    handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    with open(handle, "rb", buffering=0) as file:
        found = os.fstat(handle)
        if not stat.S_ISREG(found.st_mode):
            raise OSError(errno.EINVAL, "no regular file", os.fspath(path))
        check(path, found)
        return file.read()


def _way(path: str) -> tuple[list[tuple[str, os.stat_result]], bool]:
    """Folders and links from / to the folder as the kernel passes them, and whether all of them are there."""
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


def _own_group(group: int) -> bool:
    """A group of the user alone, of the user's name, as many systems make one for each user."""
    import grp
    import pwd

    try:
        user, named = pwd.getpwuid(os.geteuid()), grp.getgrgid(group)
    except KeyError:
        return False
    return named.gr_name == user.pw_name and set(named.gr_mem) <= {user.pw_name}


@cache
def _nobody() -> int:
    """Who owns what an unknown user owns."""
    try:
        with open("/proc/sys/kernel/overflowuid") as file:
            return int(file.read())
    except (OSError, ValueError):
        return 65534


@cache
def _root_has_no_name() -> bool:
    """In a container whose users are numbered anew, without the machine's root: root's folders look like nobody's."""
    try:
        with open("/proc/self/uid_map") as file:
            return not any(int(line.split()[1]) == 0 for line in file)  # user inside, outside, how many
    except (OSError, ValueError, IndexError):
        return False

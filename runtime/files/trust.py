"""Check by owners and permissions whether another user could have written code in a folder, as ssh checks its keys.

Code in the cache runs with the rights of the user who loads it. The folder and its contents must belong to the user or
root, and group and others must have no write permission. On the path to it, no other user may replace a folder. Write
permissions in an access list appear in the bits of the group.
"""

from __future__ import annotations

import errno
import os
import stat
from functools import cache

MAX_LINKS = 40  # largest number of links on a path, as in the kernel


class UntrustedPathError(Exception):
    """Signal that another user may have written a file; the text names both."""


def check_trusted_path(path: str | os.PathLike[str]) -> None:
    """Raise UntrustedPathError if another user may write to the folder, or replace it or a folder above it.

    The folder need not exist: then only the existing folders above it are checked. Links are followed component by
    component.
    """
    components, is_complete = _find_path_components(os.fspath(path))
    for component, status in components[:-1] if is_complete else components:
        _check_path_component(component, status)
    if is_complete:
        check_owner_and_permissions(*components[-1])


def check_owner_and_permissions(path: str | os.PathLike[str], status: os.stat_result) -> None:
    """Raise UntrustedPathError if a file or folder is not the user's or root's, or if group or others may write it.

    `status` is the result of os.stat. The permissions of a link do not count.
    """
    if status.st_uid not in (os.geteuid(), 0):
        raise UntrustedPathError(f"{os.fspath(path)} belongs to another user (uid {status.st_uid})")
    if status.st_mode & 0o022 and not stat.S_ISLNK(status.st_mode):
        writer = "everybody" if status.st_mode & 0o002 else f"the group (gid {status.st_gid})"
        raise UntrustedPathError(f"{writer} may write to {os.fspath(path)}")


def check_trusted_folder(path: str | os.PathLike[str]) -> None:
    """Raise UntrustedPathError if a folder is not the user's or root's, or if group or others may write it.

    Raises NotADirectoryError for a link or a file, OSError if there is nothing.
    """
    status = os.lstat(path)
    if not stat.S_ISDIR(status.st_mode):
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), os.fspath(path))
    check_owner_and_permissions(path, status)


def _check_path_component(path: str, status: os.stat_result) -> None:
    """Raise UntrustedPathError if another user owns a folder or link on the path, or may replace entries of the folder.

    A folder with the sticky bit (/tmp), in which only owners rename their files, and links may be writable by all.
    """
    trusted_users = (os.geteuid(), 0)
    if status.st_uid not in trusted_users and not (status.st_uid == _read_overflow_user() and _is_root_unmapped()):
        raise UntrustedPathError(f"{path} belongs to another user (uid {status.st_uid})")
    if stat.S_ISLNK(status.st_mode) or status.st_mode & stat.S_ISVTX:
        return
    if status.st_mode & 0o002 or (status.st_mode & 0o020 and not _is_private_group(status.st_gid)):
        writer = "everybody" if status.st_mode & 0o002 else f"the group (gid {status.st_gid})"
        raise UntrustedPathError(f"{writer} may write to {path}")


def read_trusted_file(path: str | os.PathLike[str]) -> bytes:
    """Return the bytes of a regular file that only the user or root may write; links are not followed.

    Raises UntrustedPathError, and OSError for a file that cannot be opened or is not regular.
    """
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    with open(descriptor, "rb", buffering=0) as file:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "not a regular file", os.fspath(path))
        check_owner_and_permissions(path, status)
        return file.read()


def _find_path_components(path: str) -> tuple[list[tuple[str, os.stat_result]], bool]:
    """Return (path, status) of all folders and links through which the kernel resolves a path, and whether all exist.

    The list begins at / (or the current folder) and ends before the first folder that does not exist. Raises OSError
    for more than MAX_LINKS links.
    """
    names = [name for name in reversed(path.split("/")) if name not in ("", ".")]
    folder = "/" if path.startswith("/") else os.getcwd()
    components, n_links = [(folder, os.lstat(folder))], 0
    while names:
        name = names.pop()
        if name == "..":
            folder = os.path.dirname(folder)
            continue
        entry = os.path.join(folder, name)
        try:
            status = os.lstat(entry)
        except FileNotFoundError:
            return components, False
        components.append((entry, status))
        if not stat.S_ISLNK(status.st_mode):
            folder = entry
            continue
        n_links += 1
        if n_links > MAX_LINKS:
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), path)
        link_target = os.readlink(entry)
        folder = "/" if link_target.startswith("/") else folder
        names += [part for part in reversed(link_target.split("/")) if part not in ("", ".")]
    return [*components, (folder, os.lstat(folder))] if components[-1][0] != folder else components, True


def _is_private_group(group: int) -> bool:
    """Return whether a group is the user's private group: it has the user's name and no other member.

    `group` is its number; False for a group or user without an entry.
    """
    import grp
    import pwd

    try:
        user, group_entry = pwd.getpwuid(os.geteuid()), grp.getgrgid(group)
    except KeyError:
        return False
    return group_entry.gr_name == user.pw_name and set(group_entry.gr_mem) <= {user.pw_name}


@cache
def _read_overflow_user() -> int:
    """Return the user id that the kernel shows for unknown users; 65534 if it is not known. The result is cached."""
    try:
        with open("/proc/sys/kernel/overflowuid") as file:
            return int(file.read())
    except (OSError, ValueError):
        return 65534


@cache
def _is_root_unmapped() -> bool:
    """Return whether this is a user namespace (container) without the machine's root, who then has the overflow id.

    The result is cached; it is False if it cannot be read.
    """
    try:
        with open("/proc/self/uid_map") as file:
            return not any(int(line.split()[1]) == 0 for line in file)  # user inside, outside, how many
    except (OSError, ValueError, IndexError):
        return False

"""Define all errors that gudgeon raises on purpose, under one root class.

An error says where it is, what is wrong and what to do next. `exit_code` is what the command line returns for it (1 a
run failed, 2 bad input, 130 interrupted).
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, order=True)
class Location:
    """Location in a file; lines and columns count from 1."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        """Return "file:line:column"."""
        return f"{escape_line_breaks(self.file)}:{self.line}:{self.column}"


class GudgeonError(Exception):
    """Root class of gudgeon's errors."""

    exit_code = 1

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the pickled form, independent of the constructor, so that errors can cross processes."""
        return _unpickle_error, (type(self), self.args), dict(self.__dict__)


def _unpickle_error(kind: type[GudgeonError], arguments: tuple[Any, ...]) -> GudgeonError:
    """Return an error of a class with `args`, without calling its constructor; called by pickle."""
    return kind.__new__(kind, *arguments)


class InputError(GudgeonError):
    """Signal a mistake in a file or a call that the user can correct.

    `where` is None only when no file is involved (an argument of a Python call).
    """

    exit_code = 2

    def __init__(self, message: str, where: Location | None = None, hint: str = "") -> None:
        self.message, self.where, self.hint = message, where, hint
        location = f"{where}: " if where else ""
        super().__init__(f"{location}{message}" + (f"\n  {hint}" if hint else ""))


class NotYamlError(InputError):
    """Signal a file that is not YAML, is empty, is not a mapping or is not UTF-8."""


class LimitError(InputError):
    """Signal a file larger, deeper or more aliased than a mechanism ever needs."""


class UnknownKeyError(InputError):
    """Signal a key that the format does not know, or a key given twice."""


class MissingKeyError(InputError):
    """Signal that a required key is missing."""


class BadValueError(InputError):
    """Signal a value of the wrong kind, or outside its range (negative mass, clearance ≥ radius, …)."""


class ArrayError(BadValueError, ValueError):
    """Signal an array that C cannot read: wrong shape, masked entries, no real numbers, NaN for a time."""


class UnitError(InputError):
    """Signal an unknown unit, or a value with the wrong dimension."""


class ExpressionError(InputError):
    """Signal text that is not an expression: syntax, attribute access, unknown function."""


class UnknownNameError(InputError):
    """Signal a name that nothing defines: a body, point, joint, parameter, law, scene, address."""


class BadNameError(InputError):
    """Signal a name that is not an identifier, is reserved (C, Python, gudgeon) or is used twice."""


class CycleError(InputError):
    """Signal parameters, scenes or contacts that are defined through each other."""


class JoinError(InputError):
    """Signal an impossible joint or drive: a body joined to itself, ground to ground."""


class LawError(InputError):
    """Signal a user-defined force law that cannot be used: its file and name, what is wrong, what is allowed."""


class InputErrors(InputError):
    """Hold all errors of one file, in the order of their locations; errors without a location come last."""

    def __init__(self, errors: Sequence[InputError]) -> None:
        self.errors = tuple(sorted(errors, key=lambda e: (e.where is None, e.where or Location("", 0, 0))))
        first = self.errors[0]
        super().__init__(first.message, first.where, first.hint)
        self.args = ("\n".join(str(e) for e in self.errors),)


def combine_errors(errors: Iterable[InputError]) -> InputError:
    """Return several errors of one file as one InputErrors; a single error is returned unchanged."""
    error_list = list(errors)
    return error_list[0] if len(error_list) == 1 else InputErrors(error_list)


class AssemblyError(GudgeonError):
    """Signal a start that cannot be assembled: the worst equations, their joints and the residual are named."""


class SolverError(GudgeonError):
    """Signal that the equations could not be solved during a run, with the time and, if known, the pivot.

    `partial` is the result up to there (a gudgeon.Result), None outside `simulate`.
    """

    def __init__(self, message: str, time: float, pivot: str = "") -> None:
        self.time, self.pivot = time, pivot
        self.partial: Any = None
        self.outside_model = False  # whether the motion left the validity of the model, as where a film is squeezed out
        super().__init__(message)


class SingularError(SolverError):
    """Signal a vanishing pivot of the KKT system: a singular position, or redundant constraints."""


class NonFiniteError(SolverError):
    """Signal that the state or the right-hand side is no longer finite."""


class AuditError(SolverError):
    """Signal a failed audit: the result contradicts an equation that the integration does not use."""


class BuildError(GudgeonError):
    """Signal that the C code could not be compiled or loaded (compiler missing, …)."""


class MemoryShortage(GudgeonError):
    """Signal that memory does not suffice for a command; in Python it is a MemoryError."""

    def __init__(self, error: MemoryError) -> None:
        what = f": {error}" if str(error) else ""
        super().__init__(
            f"not enough memory{what}\n"
            "  request fewer samples (--output), scenes or runs at once, or raise the limit (ulimit -v)"
        )


FILE_SIZE_LIMIT_HINT = "a limit is set on the size of files (ulimit -f)"


class CacheError(GudgeonError):
    """Signal that the cache folder cannot be used."""


class OutputError(GudgeonError):
    """Signal a file that cannot be written: `path`, `reason`. An old file is unchanged.

    The exit code is 2 if another name or folder helps, 1 if the disk is the cause.
    """

    def __init__(self, path: str | os.PathLike[str], reason: str | OSError) -> None:
        code = reason.errno if isinstance(reason, OSError) else None
        self.path = os.fspath(path)
        self.reason = str(reason) if isinstance(reason, str) else reason.strerror or str(reason)
        self.exit_code = 2 if isinstance(reason, str) or code in _PATH_ERRORS else 1
        hint = _ERROR_HINTS.get(code or 0, "name another file or folder" if self.exit_code == 2 else "")
        if code in _FULL_ERRORS and os.path.isfile(self.path):
            hint = f"the old file is unchanged; {hint}"
        super().__init__(f"cannot write {shorten_path(path)}: {self.reason}" + (f"\n  {hint}" if hint else ""))


def escape_line_breaks(text: str) -> str:
    """Return a text with its line breaks escaped as \\n and \\r, so that it fits in one line of a message."""
    return text if text.isprintable() else text.replace("\n", "\\n").replace("\r", "\\r")


def shorten_path(path: str | os.PathLike[str]) -> str:
    """Return a path for one line of a message: the first and last 80 of 200 or more characters; "''" if empty."""
    text = escape_line_breaks(os.fspath(path)) or "''"
    return text if len(text) < 200 else f"{text[:80]}…{text[-80:]}"


# errors for which another name or folder helps
_PATH_ERRORS = {
    errno.ENOTDIR,
    errno.EISDIR,
    errno.EEXIST,
    errno.ENOENT,
    errno.ENAMETOOLONG,
    errno.ELOOP,
    errno.EACCES,
    errno.EPERM,
    errno.EROFS,
}
# errors while a file is written, under a temporary name
_FULL_ERRORS = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
# hints by error number
_ERROR_HINTS = {
    errno.ENOSPC: "free disk space or name another folder, and repeat the command",
    errno.EDQUOT: "free disk space or name another folder, and repeat the command",
    errno.EFBIG: FILE_SIZE_LIMIT_HINT,
    errno.ENAMETOOLONG: "choose a shorter name",
}

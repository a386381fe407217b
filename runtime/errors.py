"""Every error that gudgeon raises on purpose, under one root.

An error says where it is, what is wrong and what to do next; `exit_code` is what the
command line returns for it (1 a run failed, 2 bad input, 130 interrupted).
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, order=True)
class Location:
    """A place in a file; lines and columns count from 1."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{in_a_line(self.file)}:{self.line}:{self.column}"


class GudgeonError(Exception):
    """Root of all of gudgeon's errors."""

    exit_code = 1

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled as it is, whatever its constructor takes: an error comes back from another process."""
        return _again, (type(self), self.args), dict(self.__dict__)


def _again(kind: type[GudgeonError], arguments: tuple[Any, ...]) -> GudgeonError:
    return kind.__new__(kind, *arguments)


class InputError(GudgeonError):
    """Something in a file or a call that the user can mend.

    `where` is None only when no file is involved (an argument of a Python call).
    """

    exit_code = 2

    def __init__(self, message: str, where: Location | None = None, hint: str = "") -> None:
        self.message, self.where, self.hint = message, where, hint
        place = f"{where}: " if where else ""
        super().__init__(f"{place}{message}" + (f"\n  {hint}" if hint else ""))


class NotYamlError(InputError):
    """The file is no YAML, is empty, is no mapping or is not UTF-8."""


class LimitError(InputError):
    """The file is larger, deeper or more aliased than a mechanism ever needs."""


class UnknownKeyError(InputError):
    """A key that the format does not know, or a key given twice."""


class MissingKeyError(InputError):
    """A key that the format needs."""


class BadValueError(InputError):
    """A value of the wrong kind, or outside its range (negative mass, clearance ≥ radius, …)."""


class ArrayError(BadValueError, ValueError):
    """An array that C cannot read as it is meant: another shape, masked entries, no real numbers, NaN for a time."""


class UnitError(InputError):
    """An unknown unit, or a value with the wrong dimension."""


class ExpressionError(InputError):
    """Text that is no expression: syntax, attribute access, unknown function."""


class UnknownNameError(InputError):
    """A name that nothing defines: a body, point, joint, parameter, law, scene, address."""


class BadNameError(InputError):
    """A name that is no identifier, is reserved (C, Python, gudgeon) or is used twice."""


class CycleError(InputError):
    """Parameters, scenes or contacts that are defined through each other."""


class JoinError(InputError):
    """A joint or drive that cannot be: a body joined to itself, ground to ground."""


class LawError(InputError):
    """A force law of the user's own that cannot be used: its file and name, what is wrong, what it may have."""


class InputErrors(InputError):
    """All the errors of one file at once, in the order of their places."""

    def __init__(self, errors: Sequence[InputError]) -> None:
        self.errors = tuple(sorted(errors, key=lambda e: (e.where is None, e.where or Location("", 0, 0))))
        first = self.errors[0]
        super().__init__(first.message, first.where, first.hint)
        self.args = ("\n".join(str(e) for e in self.errors),)


def together(errors: Iterable[InputError]) -> InputError:
    """Return the only one of some errors as it is, or InputErrors of all."""
    found = list(errors)
    return found[0] if len(found) == 1 else InputErrors(found)


class AssemblyError(GudgeonError):
    """The start cannot be assembled: the worst rows, their joints and the residual are named."""


class SolverError(GudgeonError):
    """The equations could not be solved during a run; carries the time and, if known, the pivot.

    `partial` is the result up to there (a gudgeon.Result), None outside `simulate`.
    """

    def __init__(self, message: str, time: float, pivot: str = "") -> None:
        self.time, self.pivot = time, pivot
        self.partial: Any = None
        self.outside_model = False  # the physics broke the model, not the method: a film that is squeezed out
        super().__init__(message)


class SingularError(SolverError):
    """A pivot of the KKT system vanished: a singular position, or redundant constraints."""


class NonFiniteError(SolverError):
    """The state or the right-hand side is no longer finite."""


class AuditError(SolverError):
    """A check of the run's audit failed: the result contradicts an equation that the integration does not use."""


class BuildError(GudgeonError):
    """The C code could not be compiled or loaded (compiler missing, …)."""


class MemoryShortage(GudgeonError):
    """There is no memory for what the command line was asked; in Python it is a MemoryError."""

    def __init__(self, error: MemoryError) -> None:
        what = f": {error}" if str(error) else ""
        super().__init__(
            f"not enough memory{what}\n"
            "  ask for fewer samples (--output), scenes or runs at once, or raise the limit (ulimit -v)"
        )


LIMITED = "a limit is set on the size of files (ulimit -f)"


class CacheError(GudgeonError):
    """The cache folder cannot be used."""


class OutputError(GudgeonError):
    """A file that cannot be written: `path`, `reason`. What stood there is as it was.

    The exit code is 2 where another name or folder mends it, 1 where it is the disk.
    """

    def __init__(self, path: str | os.PathLike[str], reason: str | OSError) -> None:
        code = reason.errno if isinstance(reason, OSError) else None
        self.path = os.fspath(path)
        self.reason = str(reason) if isinstance(reason, str) else reason.strerror or str(reason)
        self.exit_code = 2 if isinstance(reason, str) or code in _NAMED else 1
        hint = _HINTS.get(code or 0, "name another file or folder" if self.exit_code == 2 else "")
        super().__init__(f"cannot write {shortened(path)}: {self.reason}" + (f"\n  {hint}" if hint else ""))


def in_a_line(text: str) -> str:
    """A name as Python writes what would end its line."""
    return text if text.isprintable() else text.replace("\n", "\\n").replace("\r", "\\r")


def shortened(path: str | os.PathLike[str]) -> str:
    """A path as it is told: in a line, of a long one both ends."""
    text = in_a_line(os.fspath(path)) or "''"
    return text if len(text) < 200 else f"{text[:80]}…{text[-80:]}"


_NAMED = {
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
_HINTS = {
    errno.ENOSPC: "what stood there is as it was; make room or name another folder, and do it again",
    errno.EDQUOT: "what stood there is as it was; make room or name another folder, and do it again",
    errno.EFBIG: f"what stood there is as it was; {LIMITED}",
    errno.ENAMETOOLONG: "choose a shorter name",
}

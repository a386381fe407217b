"""The provenance of a result: the version of gudgeon, platform, compiler, date and the text of the mechanism.

Nothing is computed from it and no comparison of results reads it. `SOURCE_DATE_EPOCH` (s since 1970) in the
environment replaces the date, so that runs can be repeated byte for byte.
"""

from __future__ import annotations

import os
import platform
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from gudgeon.model.compiled import CompiledModel

if TYPE_CHECKING:
    from gudgeon.results.files.netcdf_read import File

GROUP = "provenance"  # of a file
NAMES = ("version", "platform", "compiler", "date", "mechanism")


def provenance_of(compiled: CompiledModel) -> dict[str, str]:
    """Return the provenance of a run that ends now, by NAMES."""
    from gudgeon import __version__

    system = platform.uname()
    where = f"{system.system} {system.release} {system.machine}, Python {platform.python_version()}"
    return dict(zip(NAMES, (__version__, where, compiled.compiler, _date(), compiled.text), strict=True))


def read_provenance(file: File) -> dict[str, str]:
    """Return what a file records; nothing of an older one, in which an output may have the group's name."""
    try:
        return {name: file.text(name, GROUP) for name in NAMES}
    except (KeyError, ValueError):
        return {}


def _date() -> str:
    given = os.environ.get("SOURCE_DATE_EPOCH", "")
    now = datetime.fromtimestamp(int(given), UTC) if given.isdecimal() else datetime.now(UTC)
    return now.isoformat(timespec="seconds")

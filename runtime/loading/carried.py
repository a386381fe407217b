"""Libraries that a wheel carries, for machines without a compiler: scenes of shipped mechanisms, one run at a time.

`tools/wheels.py` compiles them when it makes a wheel for a platform, without instructions that only some processors
have; a clone has none. They are known by the texts that they were compiled from, so that an edited file, or another
engine, never gets them.
"""

from __future__ import annotations

import os
import sys

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.loading.cache import digest
from gudgeon.loading.engine import engine_digest, own_texts
from gudgeon.loading.library import Library, opened
from gudgeon.loading.shipped import PACKAGE

CARRIED = PACKAGE / "carried"


def carried(source: KernelSource) -> Library | None:
    """The library of this source; None where the wheel has none for this machine, or the user names a compiler."""
    if os.environ.get("CC"):
        return None
    path = CARRIED / platform(sys.platform, os.uname().machine) / file_name(source)
    try:
        return opened(path, source.cdef) if path.is_file() else None
    except ImportError:  # of another C library, as musl
        return None


def platform(system: str, machine: str) -> str:
    """The folder of such machines."""
    return f"{system}-{machine}"


def file_name(source: KernelSource) -> str:
    """By everything that it was compiled from."""
    return digest(["carried/1", source.main, source.cdef, engine_digest(), *own_texts(source)])[:32] + ".so"

"""The collector of garbage, where looking for it costs more than it finds: what is made there stays."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def at_rest() -> Iterator[None]:
    """Nothing is looked for within; what is garbage meanwhile is found when all objects are looked through next.

    All that was made is as old as can be when this ends: as new objects, they would be looked through at once.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects and not gc.get_freeze_count():  # somebody's frozen objects stay so
            gc.freeze()
            gc.unfreeze()
        if collects:
            gc.enable()

"""Packages that are imported late, each wholly: one that Ctrl-C left half imported would fail until Python ends.

They take a second and more, so they are imported in a thread of their own: Ctrl-C is raised at once in the main thread,
and what is being imported comes to its end beside it.

`at_rest` stops the collector of garbage meanwhile: what is made there stays.
"""

from __future__ import annotations

import gc
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module

RUNTIME = ("numpy", "gudgeon.simulation.simulation")
READER = ("numpy", "ruamel.yaml", "gudgeon.generator.reader.read")
GENERATOR = ("numpy", "mpmath", "sympy", "jinja2", "ruamel.yaml", "gudgeon.generator.pipeline")
CFFI = ("cffi", "pycparser", "cffi.cparser")
LOOK = 0.05  # s, after which a signal is looked for
SPARSE = ("numpy", "scipy.sparse", "scipy.sparse.linalg")
_frozen = False  # whether somebody's objects are known to be: to count a million of them takes ten milliseconds


def whole(*names: str) -> None:
    """Import modules; Ctrl-C is raised while they are, and leaves none half imported."""
    if all(map(_is_imported, names)):
        return
    failed: list[BaseException] = []
    done = threading.Event()
    threading.Thread(target=_import, args=(names, failed, done), name="imports", daemon=True).start()
    while not done.wait(LOOK):  # a signal may wake the other thread and not this one
        pass
    if failed:
        raise failed[0]


def _import(names: tuple[str, ...], failed: list[BaseException], done: threading.Event) -> None:
    try:
        with at_rest():  # what modules make stays: to look through it again and again takes a tenth of their time
            for name in names:
                import_module(name)
    except BaseException as error:
        failed.append(error)
    finally:
        done.set()


def _is_imported(name: str) -> bool:
    """To its end: not while another thread is still at it."""
    module = sys.modules.get(name)
    return module is not None and not getattr(getattr(module, "__spec__", None), "_initializing", False)


@contextmanager
def at_rest() -> Iterator[None]:
    """Nothing is looked for within; what is garbage meanwhile is found when all objects are looked through next.

    All that was made is as old as can be when this ends: as new objects, they would be looked through at once.
    """
    global _frozen
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            _frozen = _frozen or gc.get_freeze_count() > 0
            if not _frozen:  # somebody's frozen objects stay so
                gc.freeze()
                gc.unfreeze()
            gc.enable()

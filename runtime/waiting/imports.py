"""Import large packages on demand (lazy import) in a thread, so that Ctrl-C leaves no module partially imported.

A partially imported module could not be imported again. Ctrl-C is raised at once in the main thread, while the thread
completes the import. `pause_garbage_collector` stops the garbage collector meanwhile.
"""

from __future__ import annotations

import gc
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module

RUNTIME = ("numpy", "gudgeon.simulation.simulation")
READER = ("numpy", "ruamel.yaml", "gudgeon.generator.reader.read")
GENERATOR = ("numpy", "mpmath", "sympy", "jinja2", "ruamel.yaml", "gudgeon.generator.pipeline")
CFFI = ("cffi", "pycparser", "cffi.cparser")
CHECK_INTERVAL_S = 0.05  # s between two checks for signals
SPARSE = ("numpy", "scipy.sparse", "scipy.sparse.linalg")
SYMPY_CACHE_SIZE = "20000"  # entries; with the default, 1,000, a large scene rarely finds its earlier results
_frozen = False  # whether other code has called gc.freeze; counting the frozen objects takes 10 ms


def import_modules_in_thread(*module_names: str) -> None:
    """Import modules in another thread and wait for it; return at once if they are imported already.

    Ctrl-C is raised while waiting, and the thread completes the import. An error of the import is raised here.
    """
    if all(map(_is_imported, module_names)):
        return
    errors: list[BaseException] = []
    done = threading.Event()
    threading.Thread(target=_import_modules, args=(module_names, errors, done), name="imports", daemon=True).start()
    while not done.wait(CHECK_INTERVAL_S):  # a signal may wake the other thread and not this one
        pass
    if errors:
        raise errors[0]


def _import_modules(names: tuple[str, ...], errors: list[BaseException], finished_event: threading.Event) -> None:
    """Import modules in this thread; append an exception to `errors`, and set `finished_event` at the end."""
    try:
        # objects of modules are permanent: without the pause, collections take a tenth of the import time
        with pause_garbage_collector(), _enlarge_sympy_cache():
            for name in names:
                import_module(name)
    except BaseException as error:
        errors.append(error)
    finally:
        finished_event.set()


@contextmanager
def _enlarge_sympy_cache() -> Iterator[None]:
    """Set the environment variable SYMPY_CACHE_SIZE within a with block, in which SymPy may be imported.

    SymPy reads the size of its function caches at its import. A size that the user has set is not changed.
    """
    if "SYMPY_CACHE_SIZE" in os.environ:
        yield
        return
    os.environ["SYMPY_CACHE_SIZE"] = SYMPY_CACHE_SIZE
    try:
        yield
    finally:
        os.environ.pop("SYMPY_CACHE_SIZE", None)


def _is_imported(name: str) -> bool:
    """Return whether a module is completely imported, not just by another thread in progress."""
    module = sys.modules.get(name)
    return module is not None and not getattr(getattr(module, "__spec__", None), "_initializing", False)


@contextmanager
def pause_garbage_collector() -> Iterator[None]:
    """Disable the garbage collector within a with block, then move all objects to its oldest generation (gc.freeze).

    As young objects they would be searched at once. Nothing is moved if other code has frozen objects, or if the
    collector was disabled before.
    """
    global _frozen
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            _frozen = _frozen or gc.get_freeze_count() > 0
            if not _frozen:  # objects frozen by others stay frozen
                gc.freeze()
                gc.unfreeze()
            gc.enable()

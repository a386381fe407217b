"""Libraries of a study's scenes: made by two processes at once, and loaded in whichever process runs its blocks."""

from __future__ import annotations

import json
import os
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import lru_cache
from typing import TYPE_CHECKING

from gudgeon.errors import GudgeonError, InputError
from gudgeon.integrators.threads import available_threads
from gudgeon.loading.find import is_known
from gudgeon.simulation.from_file import load
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble.structures import Structure
from gudgeon.studies.ensemble.workers import begin_worker, law_files
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource

FEWEST = 3  # libraries to make, from which on a second process pays: it begins with loading SymPy
MOST = 64  # libraries that are left to it: more do not fit into its command line
OTHER = f"from {__name__} import make; make()"


@contextmanager
def made_beside(structures: Sequence[Structure]) -> Iterator[None]:
    """While this process loads the libraries from the first on, another one makes them from the last on.

    Who needs one that the other is at waits for it. Nothing but the cache is in common: where there is none, or the
    other process cannot be begun, this one makes them all.
    """
    new = [one for one in structures if not is_known(one.mechanism, one.scene, dict(one.overrides))]
    with Programs() as programs:
        process = None
        if len(new) >= FEWEST and available_threads() > 1:
            told = json.dumps([law_files(), new[: -MOST - 1 : -1]])
            try:
                process = programs.begin([sys.executable, "-c", OTHER, told], None, dict(os.environ))
            except OSError:
                process = None
        try:
            yield
        finally:
            if process is not None:
                process.terminate()
                programs.wait(process)


def make() -> None:
    """In the other process: what cannot be made is told by the process that needs it."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())  # compilers and folders of what is under way go with it
    laws, structures = json.loads(sys.argv[1])
    begin_worker(laws)
    try:
        for mechanism, scene, overrides in structures:
            with suppress(GudgeonError):
                load(mechanism, scene, overrides=dict(overrides), quick=False)
    except SystemExit:
        os._exit(1)  # Python takes .3 s to forget what SymPy made


@lru_cache(maxsize=16)
def loaded(mechanism: str, scene: str, overrides: tuple[tuple[str, str], ...], sha256: str) -> Simulation:
    """The library of a part, in a worker's own process. Raises InputError for a file that was edited since."""
    found = load(mechanism, scene, overrides=dict(overrides), quick=False)
    if found.source.whole_sha256 != sha256:
        told = f"{mechanism} was edited after the study began"
        raise InputError(told, hint="put it back as it was, or begin anew with --restart")
    return found


def method_in(source: KernelSource, method: str) -> str:
    """The method that a scene is run with: one without a degree of freedom follows its drives, whatever is asked."""
    return method if source.degrees_of_freedom else "auto"
